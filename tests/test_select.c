/* SPDX-License-Identifier: Apache-2.0
 *
 * The selection of faces (rtl/select.sv) against docs/refinement.md, section 4: quads, half-quads,
 * which have three vertices, and n-gons.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "select_shim.h"

static uint64_t random_state;

static uint32_t below(uint32_t n) {
    random_state ^= random_state << 13;
    random_state ^= random_state >> 7;
    random_state ^= random_state << 17;
    return (uint32_t)((random_state >> 32) % n);
}

/* --- The definition --------------------------------------------------------------------------- */

static bool is_selected(const select_generation *s, uint32_t face, uint32_t first, const uint8_t *v,
                        uint32_t n) {
    const uint32_t g = s->generation;
    bool in_view = false, silhouette = false;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t mark = s->mark[v[i]];
        in_view = in_view || (mark & SELECT_HITS);
        silhouette = silhouette || ((mark & SELECT_FRONT) && (mark & SELECT_BACK));
    }
    const bool wanted =
        in_view && !s->face[face].stop &&
        ((s->face[face].front && g < s->front_depth) || (silhouette && g < s->silhouette_depth));
    return s->item[first].candidate && (wanted || g < s->item[first].forced);
}

static select_verdicts by_definition(const select_generation *s) {
    select_verdicts out = {0};
    for (uint32_t first = 0; first < s->items; out.faces++) {
        uint8_t v[SELECT_ITEMS];
        uint32_t n = 0, last = first;
        if (s->quads) {
            n = s->item[first].half ? 3 : 4;
            memcpy(v, s->item[first].origin, n);
        } else {
            while (!s->item[last].last)
                last++;
            for (uint32_t i = first; i <= last; i++)
                v[n++] = s->item[i].origin[0];
        }
        const bool selected = is_selected(s, out.faces, first, v, n);
        out.verdict[out.faces] = selected;
        out.any = out.any || selected;
        for (uint32_t i = 0; i < n; i++) {
            out.read[v[i]] = true;
            out.chosen[v[i]] = out.chosen[v[i]] || selected;
        }
        first = last + 1;
    }
    return out;
}

/* --- Generations ------------------------------------------------------------------------------ */

/* Few vertices are marked, so that a vertex too many or too few is seen. */
static select_generation random_generation(bool quads) {
    select_generation s = {.quads = quads,
                           .generation = quads ? 1 + below(3) : 0,
                           .front_depth = below(4),
                           .silhouette_depth = below(4),
                           .items = 64 + below(SELECT_ITEMS - 64)};
    const uint32_t vertices = 8u << below(6);
    for (uint32_t v = 0; v < SELECT_VERTICES; v++)
        s.mark[v] = (uint8_t)(below(3) == 0 ? below(8) : 0);
    uint32_t left = 0; /* corners of an n-gon that are still to come */
    bool candidate = false;
    uint8_t forced = 0;
    for (uint32_t i = 0; i < s.items; i++) {
        if (left == 0) {
            left = quads ? 1 : 3 + below(6);
            if (s.items - i < left + 3) left = quads ? 1 : s.items - i;
            candidate = below(4) > 0;
            forced = (uint8_t)(below(4) == 0 ? below(4) : 0);
        }
        for (int lane = 0; lane < 4; lane++)
            s.item[i].origin[lane] = (uint8_t)below(vertices);
        s.item[i].half = below(2);
        s.item[i].candidate = candidate;
        s.item[i].forced = forced;
        s.item[i].last = --left == 0;
        s.face[i].front = below(2);
        s.face[i].stop = below(4) == 0;
    }
    return s;
}

/* --- The claims ------------------------------------------------------------------------------- */

static void verdicts_agree(bool quads) {
    random_state = quads ? 11 : 12;
    select_rtl *rtl = select_rtl_new(1);
    uint32_t faces = 0, selected = 0, none = 0;
    for (int run = 0; run < 2000; run++) {
        const select_generation s = random_generation(quads);
        const select_verdicts expected = by_definition(&s);
        select_verdicts out;
        assert_true(select_rtl_run(rtl, &s, &out));
        assert_int_equal(out.faces, expected.faces);
        assert_int_equal(out.any, expected.any);
        assert_memory_equal(out.verdict, expected.verdict, sizeof out.verdict);
        assert_memory_equal(out.read, expected.read, sizeof out.read);
        assert_memory_equal(out.chosen, expected.chosen, sizeof out.chosen);
        faces += out.faces;
        none += !out.any;
        for (uint32_t f = 0; f < out.faces; f++)
            selected += out.verdict[f];
    }
    assert_in_range(selected, faces / 20, faces / 2);
    assert_in_range(none, 5, 1000);
    select_rtl_free(rtl);
}

static void quads_and_half_quads_are_selected_by_their_own_vertices(void **state) {
    (void)state;
    verdicts_agree(true);
}

static void n_gons_are_selected_by_all_their_corners(void **state) {
    (void)state;
    verdicts_agree(false);
}

static void a_face_that_stops_is_selected_only_where_it_is_forced(void **state) {
    (void)state;
    select_rtl *rtl = select_rtl_new(2);
    select_generation s = {
        .quads = true, .generation = 2, .front_depth = 3, .silhouette_depth = 3, .items = 1};
    s.item[0].candidate = s.item[0].last = s.face[0].front = true;
    memset(s.mark, SELECT_FRONT | SELECT_BACK | SELECT_HITS, sizeof s.mark);
    for (uint8_t forced = 2; forced <= 3; forced++)
        for (int stop = 0; stop < 2; stop++) {
            select_verdicts out;
            s.item[0].forced = forced;
            s.face[0].stop = stop;
            assert_true(select_rtl_run(rtl, &s, &out));
            assert_int_equal(out.any, !stop || forced == 3);
        }
    select_rtl_free(rtl);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(quads_and_half_quads_are_selected_by_their_own_vertices),
        cmocka_unit_test(n_gons_are_selected_by_all_their_corners),
        cmocka_unit_test(a_face_that_stops_is_selected_only_where_it_is_forced),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
