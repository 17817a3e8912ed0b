/* SPDX-License-Identifier: Apache-2.0
 *
 * Does a vertex stay where it was when the viewer comes nearer, or takes a longer lens? Refinement
 * stops at pixel size, so that what is nearer is refined more; but every vertex that two views have
 * at the same level is to be at the same place.
 */
#include "eye_views.h"
#include "render_parts.h"

/* --- Nearer and nearer -------------------------------------------------------------------------
 */

/* A vertex that left, known by what it was made of, and where it is in object space. */
typedef struct {
    uint64_t key; /* of the vertex and its level */
    double place[3];
} place;

typedef struct {
    uint64_t *key; /* per vertex number */
    size_t room;
    bool good;
} vertex_keys;

/* Steele, Lea and Flood's SplitMix64: keys of 64 bits never collide in these tests' lives. */
static uint64_t mix(uint64_t x) {
    x += 0x9e3779b97f4a7c15u;
    x = (x ^ x >> 30) * 0xbf58476d1ce4e5b9u;
    x = (x ^ x >> 27) * 0x94d049bb133111ebu;
    return x ^ x >> 31;
}

/* A new vertex is known by the corners of the face that it is made in. */
static void extend_keys(void *context, const hs_state *s) {
    vertex_keys *k = context;
    const size_t need = (size_t)s->vertices + s->faces;
    if (need > k->room) {
        uint64_t *grown = realloc(k->key, 2 * need * sizeof *grown);
        k->good = grown != NULL;
        if (!k->good) return;
        k->key = grown;
        k->room = 2 * need;
    }
    if (s->generation == 0)
        for (uint32_t v = 0; v < s->vertices; v++)
            k->key[v] = mix(v);
    uint32_t created = 0;
    for (uint32_t f = 0; f < s->faces && !s->finish; f++) {
        if (!(s->decision[f] & FACE_REFINED)) continue;
        uint64_t sum = 0;
        for (uint32_t i = 0; i < hs_face_sides(s, f); i++)
            sum += mix(k->key[s->origin[hs_face_first(s, f) + i]]);
        k->key[s->vertices + created++] = mix(sum);
    }
}

static int in_order(const void *a, const void *b) {
    const place *p = a, *q = b;
    return (p->key > q->key) - (p->key < q->key);
}

typedef struct {
    uint32_t count;
    place *place; /* in the order of keys */
} places;

/* Clip positions are M p with p = (x, y, z, 1), before refinement and after, as every mask's
 * weights add up to 1. So rows x, y and w are three equations for x, y and z. */
static void unproject(double result[3], const float *m, const uint32_t *w) {
    static const int row[3] = {0, 1, 3};
    float c[4];
    double a[3][3], b[3], cofactor[3];
    memcpy(c, w, sizeof c);
    for (int i = 0; i < 3; i++) {
        for (int k = 0; k < 3; k++)
            a[i][k] = (double)m[4 * row[i] + k];
        b[i] = (double)c[row[i]] - (double)m[4 * row[i] + 3];
    }
    memset(result, 0, 3 * sizeof *result);
    hs_cross(cofactor, a[1], a[2]);
    const double determinant = hs_dot(a[0], cofactor);
    for (int i = 0; i < 3; i++) {
        hs_cross(cofactor, a[(i + 1) % 3], a[(i + 2) % 3]);
        for (int k = 0; k < 3; k++)
            result[k] += b[i] * cofactor[k] / determinant;
    }
}

/* The vertices of a packet with the generation in which they leave, which hs_output has not; but
 * what leaves in the step to the last generation may have moved in it, and is at another level. */
static places places_of(const hs_packet *out, const vertex_keys *keys, const float matrix[16]) {
    places all = {0, malloc((out->words / 4 + 1) * sizeof(place))};
    assert_non_null(all.place);
    for (size_t at = 0; at < out->words; at += 4) {
        const uint32_t *w = &out->word[at];
        if ((w[0] >> 20 & 7) != HS_RECORD_VERTICES) continue;
        const uint32_t count = w[0] >> 16 & 15, level = ((w[0] & 255) + 1) / 2;
        const uint32_t number[4] = {w[1] & 0xffffff, w[1] >> 24 | (w[2] & 0xffff) << 8,
                                    w[2] >> 16 | (w[3] & 0xff) << 16, w[3] >> 8};
        for (uint32_t i = 0; i < count; i++, at += 4) {
            if ((w[0] & 255) >= DEPTH - 1) continue;
            place *p = &all.place[all.count++];
            p->key = mix(keys->key[number[i]] + level);
            unproject(p->place, matrix, w + 4 + 4 * (size_t)i);
        }
    }
    qsort(all.place, all.count, sizeof *all.place, in_order);
    return all;
}

static places see(hs_golden *golden, const hs_mesh *mesh, const hs_view *view) {
    const hs_settings settings = settings_for(4, HS_BOUNDARY_SMOOTH);
    vertex_keys keys = {.good = true};
    hs_packet out = {0};
    hs_golden_observe(golden, &(hs_observer){.context = &keys, .decided = extend_keys});
    run(golden, mesh, view->matrix, &settings, &out);
    hs_golden_observe(golden, NULL);
    assert_true(keys.good);
    const places all = places_of(&out, &keys, view->matrix);
    for (uint32_t i = 1; i < all.count; i++)
        assert_true(all.place[i - 1].key != all.place[i].key);
    free(keys.key);
    hs_packet_free(&out);
    return all;
}

/* Over the vertices that both have at the same level: the largest distance. */
static double compare_places(const places *a, const places *b, uint64_t *compared) {
    double largest = 0;
    for (uint32_t i = 0, j = 0; i < a->count && j < b->count;) {
        const int order = in_order(&a->place[i], &b->place[j]);
        if (order == 0) {
            for (int k = 0; k < 3; k++)
                largest = fmax(largest, fabs(a->place[i].place[k] - b->place[j].place[k]));
            ++*compared;
        }
        i += order <= 0;
        j += order >= 0;
    }
    return largest;
}

/* From view to view, each beside the one before it. */
static void compare_views(hs_golden *golden, const char *name, const hs_mesh *mesh,
                          const hs_view *view, size_t views, double box) {
    places before = {0};
    uint64_t compared = 0;
    double largest = 0;
    for (size_t k = 0; k < views; k++) {
        const places now = see(golden, mesh, &view[k]);
        uint64_t here = 0;
        const double moved = compare_places(&before, &now, &here) / box;
        if (!(moved <= 1e-6)) fail_msg("%s, view %zu: a vertex moves by %g", name, k, moved);
        largest = fmax(largest, moved);
        compared += here;
        free(before.place);
        before = now;
    }
    free(before.place);
    assert_true(compared > 500);
    print_message("%s: %llu vertices at the same level in two views, %.2g of the box apart at "
                  "most\n",
                  name, (unsigned long long)compared, largest);
}

static void coming_nearer_moves_no_vertex_that_stays_at_its_level(void **state) {
    const samples *all = *state;
    hs_golden *golden = new_golden();
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        const subject subject = look_at_surface(golden, mesh, directions[i % 3]);
        hs_view view[DISTANCES];
        for (size_t k = 0; k < DISTANCES; k++)
            view[k] = look(&subject, distances[k], 40);
        compare_views(golden, all->item[i].name, mesh, view, DISTANCES, subject.box);
    }
    hs_golden_free(golden);
}

/* From one place with longer and longer lenses; focal lengths span three decades. */
static void zooming_in_moves_no_vertex_that_stays_at_its_level(void **state) {
    static const double fovs[] = {150, 120, 60, 30, 15, 6, 3, 1.5, 0.8, 0.4};
    enum { ZOOMS = sizeof fovs / sizeof *fovs };
    const samples *all = *state;
    hs_golden *golden = new_golden();
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        const subject subject = look_at_surface(golden, mesh, directions[i % 3]);
        hs_view view[ZOOMS];
        for (size_t k = 0; k < ZOOMS; k++)
            view[k] = look(&subject, 3, fovs[k]);
        compare_views(golden, all->item[i].name, mesh, view, ZOOMS, subject.box);
    }
    hs_golden_free(golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(coming_nearer_moves_no_vertex_that_stays_at_its_level),
        cmocka_unit_test(zooming_in_moves_no_vertex_that_stays_at_its_level),
    };
    return cmocka_run_group_tests_name("zoom", tests, make_some_samples, free_samples);
}
