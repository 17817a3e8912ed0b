/* SPDX-License-Identifier: Apache-2.0
 *
 * Marks, selection, guard and inheritance, worked out once more, face by face, from the text of
 * docs/refinement.md, and compared with every decision that golden takes.
 */
#include "golden_state.h"
#include "reference_samples.h"
#include "view.h"

/* --- The definitions, once more
 * -------------------------------------------------------------------- */

/* What a run should have done, worked out face by face from the text. */
typedef struct {
    uint8_t *candidate, *forced; /* per active face: expected, from the generation before */
    uint64_t faces, silhouettes, selected, ring; /* looked at, to see that there was any */
} definition;

/* det[(x,y,w) of a, b, c] by the rule of Sarrus; marks_of in classify.c has it by cross products.
 */
static bool is_counter_clockwise(const int32_t *a, const int32_t *b, const int32_t *c) {
    const __int128 one = 1;
    return one * a[0] * b[1] * c[3] + one * a[1] * b[3] * c[0] + one * a[3] * b[0] * c[1] -
               one * a[3] * b[1] * c[0] - one * a[0] * b[3] * c[1] - one * a[1] * b[0] * c[3] >
           0;
}

typedef struct {
    bool front, back, hits;
} marks;

static marks marks_by_definition(const hs_state *s, uint32_t f) {
    const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
    marks m = {false, false, true};
    for (uint32_t i = 0; i < n; i++) {
        const int32_t *a = s->position[s->origin[h0 + i]];
        const int32_t *b = s->position[s->origin[h0 + (i + 1) % n]];
        const int32_t *c = s->position[s->origin[h0 + (i + 2) % n]];
        if (is_counter_clockwise(a, b, c))
            m.front = true;
        else
            m.back = true;
    }
    for (int half_space = 0; half_space < 6; half_space++) {
        bool all = true;
        for (uint32_t i = 0; i < n; i++) {
            const int32_t *p = s->position[s->origin[h0 + i]];
            const int64_t c = p[half_space / 2];
            all = all && (half_space % 2 ? c < -(int64_t)p[3] : c > p[3]);
        }
        if (all) m.hits = false;
    }
    return m;
}

static bool is_selected(const hs_state *s, const definition *d, const marks *vertex,
                        const marks *face, uint32_t f) {
    const uint32_t g = s->generation;
    if (s->settings.uniform) return true;
    bool in_view = false, silhouette = false;
    for (uint32_t i = 0; i < hs_face_sides(s, f); i++) {
        const marks *m = &vertex[s->origin[hs_face_first(s, f) + i]];
        in_view = in_view || m->hits;
        silhouette = silhouette || (m->front && m->back);
    }
    const bool wanted = in_view && ((face[f].front && g < s->settings.front_depth) ||
                                    (silhouette && g < s->settings.silhouette_depth));
    return d->candidate[f] && (wanted || g < d->forced[f]);
}

static void check_generation(void *context, const hs_state *s) {
    definition *d = context;
    marks *face = calloc(s->faces + 1u, sizeof *face),
          *vertex = calloc(s->vertices, sizeof *vertex);
    bool *chosen = calloc(s->vertices, sizeof *chosen);
    assert_true(face && vertex && chosen);
    if (s->generation == 0) {
        d->candidate = malloc(s->faces);
        d->forced = malloc(s->faces);
        memset(d->candidate, 1, s->faces);
        memcpy(d->forced, s->forced, s->faces);
    }
    if (s->faces) assert_memory_equal(d->candidate, s->candidate, s->faces);
    for (uint32_t f = 0; f < s->faces; f++) {
        face[f] = marks_by_definition(s, f);
        for (uint32_t i = 0; i < hs_face_sides(s, f); i++) {
            marks *m = &vertex[s->origin[hs_face_first(s, f) + i]];
            m->front |= face[f].front;
            m->back |= face[f].back;
            m->hits |= face[f].hits;
        }
        if (!s->settings.uniform) {
            assert_int_equal(d->forced[f], s->forced[f]);
            assert_int_equal(s->face_mark[f], (face[f].front ? MARK_FRONT : 0) |
                                                  (face[f].back ? MARK_BACK : 0) |
                                                  (face[f].hits ? MARK_HITS : 0));
            d->silhouettes += face[f].front && face[f].back;
        }
    }
    bool any = false;
    for (uint32_t f = 0; f < s->faces; f++) {
        const bool selected = is_selected(s, d, vertex, face, f);
        if (s->generation < s->depth) assert_int_equal(selected, s->decision[f] & FACE_SELECTED);
        any = any || selected;
        for (uint32_t i = 0; selected && i < hs_face_sides(s, f); i++)
            chosen[s->origin[hs_face_first(s, f) + i]] = true;
        d->selected += selected;
    }
    d->faces += s->faces;
    assert_int_equal(s->finish, !any || s->generation >= s->depth);

    bool *refined = calloc(s->faces + 1u, sizeof *refined);
    uint8_t *candidate = malloc(s->halfedges / 2 + 1u), *forced = malloc(s->halfedges / 2 + 1u);
    assert_true(refined && candidate && forced);
    for (uint32_t f = 0; f < s->faces && !s->finish; f++) {
        refined[f] = s->decision[f] & FACE_SELECTED;
        for (uint32_t i = 0; s->settings.guard && i < hs_face_sides(s, f); i++)
            refined[f] = refined[f] || chosen[s->origin[hs_face_first(s, f) + i]];
        assert_int_equal(refined[f], (s->decision[f] & FACE_REFINED) != 0);
        d->ring += refined[f] && !(s->decision[f] & FACE_SELECTED);
    }
    uint32_t quads = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        for (uint32_t i = 0; i < hs_face_sides(s, f); i++) {
            const uint32_t h = hs_face_first(s, f) + i, t = s->twin[h];
            if (t == HS_BORDER || t < h) continue;
            const uint32_t g = hs_face_of(s, t);
            if (!refined[f] || !refined[g]) continue;
            candidate[quads] = (s->decision[f] & FACE_SELECTED) && (s->decision[g] & FACE_SELECTED);
            forced[quads++] = d->forced[f] < d->forced[g] ? d->forced[f] : d->forced[g];
        }
    }
    free(d->candidate);
    free(d->forced);
    d->candidate = candidate;
    d->forced = forced;
    free(refined);
    free(face);
    free(vertex);
    free(chosen);
}

static void marks_decisions_and_inheritance_follow_their_definitions(void **state) {
    const samples *all = *state;
    static const hs_settings settings[] = {
        {.front_depth = 4, .silhouette_depth = 6, .guard = true},
        {.front_depth = 3, .silhouette_depth = 6, .guard = false},
        {.front_depth = 5, .silhouette_depth = 2, .guard = true},
        {.front_depth = 0, .silhouette_depth = 3, .guard = false},
        {.uniform = true, .uniform_depth = 3, .guard = true},
    };
    definition d = {0};
    hs_golden *golden = hs_golden_new((hs_limits){1 << 22, 1 << 22});
    assert_non_null(golden);
    hs_golden_observe(golden, &(hs_observer){.context = &d, .decided = check_generation});
    for (uint32_t i = 0; i < all->count; i++) {
        hs_mesh mesh = all->item[i].mesh; /* with forced depths of its own */
        uint8_t *forced = calloc(mesh.faces, 1);
        assert_non_null(forced);
        hs_view views[3] = {0};
        hs_error err;
        memcpy(views[0].matrix, perspective, sizeof perspective);
        for (int k = 0; k < 16; k += 5)
            views[1].matrix[k] = 1;
        assert_true(hs_view_look(&views[2], (const double[3]){0.1, 0.2, 0.9},
                                 (const double[3]){0.4, 0, 0}, (const double[3]){0, 1, 0}, 50, 1,
                                 0.01, 10, &err));
        for (size_t k = 0; k < 3 * sizeof settings / sizeof *settings; k++) {
            for (uint32_t f = 0; f < mesh.faces; f++)
                forced[f] = (uint8_t)(k % 2 && f % 11 ? 4 * f / mesh.faces + 1 : 0);
            mesh.forced = forced;
            hs_packet in = {0}, out = {0};
            hs_golden_report report;
            if (!hs_packet_encode(&in, 0, &mesh, views[k % 3].matrix, &settings[k / 3], &err) ||
                !hs_golden_run(golden, &in, &out, &report, &err))
                fail_msg("%s", err.text);
            assert_int_equal(report.status, HS_STATUS_OK);
            hs_packet_free(&in);
            hs_packet_free(&out);
            free(d.candidate);
            free(d.forced);
            d.candidate = d.forced = NULL;
        }
        free(forced);
    }
    hs_golden_free(golden);
    print_message("%llu faces, %llu both front and back, %llu selected, %llu in a guard ring\n",
                  (unsigned long long)d.faces, (unsigned long long)d.silhouettes,
                  (unsigned long long)d.selected, (unsigned long long)d.ring);
    assert_true(d.faces > 100000 && d.silhouettes > 100 && d.selected > 100000 && d.ring > 1000);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(marks_decisions_and_inheritance_follow_their_definitions),
    };
    return cmocka_run_group_tests_name("golden's rules", tests, make_samples, free_samples);
}
