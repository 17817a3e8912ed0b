/* SPDX-License-Identifier: Apache-2.0
 *
 * Refinement that stops at pixel size (docs/refinement.md, section 11). From eye distances over
 * three decades: is nothing refined that is small enough, and is nothing left that is not?
 */
#include "eye_views.h"
#include "render_parts.h"

static uint32_t next_corner(uint32_t i, uint32_t sides) {
    return i + 1 < sides ? i + 1 : 0;
}

/* --- While it is refined, in integers ----------------------------------------------------------
 */

typedef struct {
    const hs_settings *settings;
    uint64_t selected, stopped; /* faces; stopped: for no other reason than being short */
    bool good;
    char error[200];
} decision_check;

/* Exactly: both ends before the eye, and apart by less than min_edge/16 pixels across and up. */
static bool is_short(const int32_t *p, const int32_t *q, const hs_settings *settings) {
    if (p[3] <= 0 || q[3] <= 0) return false;
    const uint32_t size[2] = {settings->width, settings->height};
    for (int k = 0; k < 2; k++) {
        __int128 apart = (__int128)p[k] * q[3] - (__int128)q[k] * p[3];
        if (apart < 0) apart = -apart;
        /* apart/(p_w q_w) is in [-1, 1] coordinates: size/2 pixels a unit. */
        if (apart * size[k] * HS_PIXEL_FRACTION >= 2 * (__int128)settings->min_edge * p[3] * q[3])
            return false;
    }
    return true;
}

static int64_t plane(const int32_t *p, int which) {
    return p[3] + (int64_t)(which % 2 ? -p[which / 2] : p[which / 2]);
}

static bool face_is_in_view(const hs_state *s, uint32_t h0, uint32_t n) {
    for (int which = 0; which < 6; which++) {
        bool inside = false;
        for (uint32_t i = 0; i < n; i++)
            inside |= plane(s->position[s->origin[h0 + i]], which) >= 0;
        if (!inside) return false;
    }
    return true;
}

static bool face_is_front(const hs_state *s, uint32_t h0, uint32_t n) {
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = next_corner(i, n), k = next_corner(j, n);
        const int32_t *a = s->position[s->origin[h0 + i]], *b = s->position[s->origin[h0 + j]],
                      *c = s->position[s->origin[h0 + k]];
        const __int128 x = (__int128)b[1] * c[3] - (__int128)b[3] * c[1],
                       y = (__int128)b[3] * c[0] - (__int128)b[0] * c[3],
                       w = (__int128)b[0] * c[1] - (__int128)b[1] * c[0];
        if (a[0] * x + a[1] * y + a[3] * w > 0) return true;
    }
    return false;
}

static void check_decisions(void *context, const hs_state *s) {
    decision_check *c = context;
    for (uint32_t f = 0; f < s->faces && c->good; f++) {
        const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
        bool all_short = true;
        for (uint32_t i = 0; i < n; i++)
            all_short &= is_short(s->position[s->origin[h0 + i]],
                                  s->position[s->origin[h0 + next_corner(i, n)]], c->settings);
        const bool selected = s->decision[f] & FACE_SELECTED;
        const bool wanted = s->candidate[f] && s->generation < s->depth &&
                            face_is_front(s, h0, n) && face_is_in_view(s, h0, n);
        c->selected += selected;
        c->stopped += wanted && all_short;
        if ((selected && all_short) || (wanted && !all_short && !selected)) {
            c->good = false;
            snprintf(c->error, sizeof c->error, "generation %u, face %u: %s", s->generation, f,
                     selected ? "selected, but all its edges are short"
                              : "front, in view, not small, and not selected");
        }
    }
}

/* --- What came out -----------------------------------------------------------------------------
 */

typedef struct {
    uint64_t checked, others, undecided, not_candidates,
        deepest; /* the latter: as deep as may be */
} output_count;

/* 1: front, -1: not, 0: too near to tell from numbers that were rounded to 24 bits, each of which
 * changes the determinant by its error times its cofactor. */
static int front_of_output(const hs_output *o, uint32_t f) {
    const uint32_t h0 = o->first[f], n = o->first[f + 1] - h0;
    int front = -1;
    for (uint32_t i = 0; i < n; i++) {
        double v[3][3], sum = 0, error = 0;
        for (uint32_t j = 0, at = i; j < 3; j++, at = next_corner(at, n))
            for (int k = 0; k < 3; k++)
                v[j][k] = (double)o->position[4 * o->corner[h0 + at] + (k < 2 ? (uint32_t)k : 3)];
        for (int j = 0; j < 3; j++) {
            double cofactor[3];
            hs_cross(cofactor, v[(j + 1) % 3], v[(j + 2) % 3]);
            sum = hs_dot(v[j], cofactor);
            for (int k = 0; k < 3; k++)
                error += ldexp(fabs(v[j][k] * cofactor[k]), -23);
        }
        if (sum > error) return 1;
        if (sum >= -error) front = 0;
    }
    return front;
}

static bool output_is_in_view(const hs_output *o, uint32_t f) {
    for (int which = 0; which < 6; which++) {
        bool inside = false;
        for (uint32_t i = o->first[f]; i < o->first[f + 1]; i++) {
            const float *p = &o->position[4 * o->corner[i]];
            inside |= p[3] + (which % 2 ? -p[which / 2] : p[which / 2]) > 0;
        }
        if (!inside) return false;
    }
    return true;
}

/* The longest edge in pixels, across or up; INFINITY with an end that is not before the eye. */
static double longest_edge(const hs_output *o, uint32_t f) {
    const uint32_t h0 = o->first[f], n = o->first[f + 1] - h0;
    const double half[2] = {WIDTH / 2.0, HEIGHT / 2.0};
    double longest = 0;
    for (uint32_t i = 0; i < n; i++) {
        const float *p = &o->position[4 * o->corner[h0 + i]],
                    *q = &o->position[4 * o->corner[h0 + next_corner(i, n)]];
        if (p[3] <= 0 || q[3] <= 0) return INFINITY;
        for (int k = 0; k < 2; k++)
            longest = fmax(
                longest, half[k] * fabs((double)p[k] / (double)p[3] - (double)q[k] / (double)q[3]));
    }
    return longest;
}

/* Binary32 has 24 bits, so a corner that is on the screen is known to 1/8000 of a pixel. */
static void check_output(const hs_output *o, double pixels, const char *name, output_count *count) {
    for (uint32_t f = 0; f < o->faces; f++) {
        if (!o->candidate[f]) {
            count->not_candidates++;
            continue;
        }
        if (o->generation[f] >= DEPTH) {
            count->deepest++;
            continue;
        }
        const int front = output_is_in_view(o, f) ? front_of_output(o, f) : -1;
        if (front <= 0) {
            count->undecided += front == 0;
            count->others += front < 0;
            continue;
        }
        const double longest = longest_edge(o, f);
        if (!(longest < pixels + 0.01))
            fail_msg("%s: output face %u of generation %u is front, in view, a candidate, and has "
                     "an edge of %g pixels; %g were asked for",
                     name, f, o->generation[f], longest, pixels);
        count->checked++;
    }
}

static output_count one_distance(hs_golden *golden, const char *name, const hs_mesh *mesh,
                                 const subject *subject, double distance, double pixels,
                                 hs_boundary boundary) {
    const hs_view view = look(subject, distance, 40);
    const hs_settings settings = settings_for(pixels, boundary);
    decision_check decisions = {.settings = &settings, .good = true};
    output_count count = {0};
    hs_packet out = {0};
    hs_output o;
    hs_error err;
    hs_golden_observe(golden, &(hs_observer){.context = &decisions, .decided = check_decisions});
    run(golden, mesh, view.matrix, &settings, &out);
    hs_golden_observe(golden, NULL);
    if (!decisions.good) fail_msg("%s, distance %g: %s", name, distance, decisions.error);
    if (!hs_output_decode(&o, &out, &err)) fail_msg("%s", err.text);
    check_output(&o, pixels, name, &count);
    print_message("%s, %g radii, %g px: %u faces, deepest %u; %llu small candidates in front, %llu "
                  "others, %llu unclear; %llu are no candidates; selected %llu times\n",
                  name, distance, pixels, o.faces, o.generations, (unsigned long long)count.checked,
                  (unsigned long long)count.others, (unsigned long long)count.undecided,
                  (unsigned long long)count.not_candidates, (unsigned long long)decisions.selected);
    assert_true(count.undecided * 500 <= o.faces);
    assert_true(decisions.stopped >= count.checked);
    assert_int_equal(count.checked + count.others + count.undecided + count.not_candidates +
                         count.deepest,
                     o.faces);
    hs_output_free(&o);
    hs_packet_free(&out);
    return count;
}

static void what_is_small_is_left_alone_and_nothing_else_is(void **state) {
    static const double pixels[] = {4, 4, 1.5, 16, 6.0625};
    const samples *all = *state;
    hs_golden *golden = new_golden();
    uint32_t turn = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        uint64_t checked = 0;
        for (uint32_t k = 0; k < DISTANCES; k++, turn++) {
            const subject subject = look_at_surface(golden, mesh, directions[turn % 3]);
            checked += one_distance(golden, all->item[i].name, mesh, &subject, distances[k],
                                    pixels[turn % 5], (hs_boundary)(turn % 3))
                           .checked;
        }
        assert_true(checked > 500);
    }
    hs_golden_free(golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_small_is_left_alone_and_nothing_else_is),
    };
    return cmocka_run_group_tests_name("least edge", tests, make_some_samples, free_samples);
}
