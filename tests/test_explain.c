/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep explain: does what it says agree with what golden decided and sent, face by face?
 */
#include "cli.h"

#include <math.h>

#include "explain.h"
#include "pick.h"
#include "shape.h"
#include "view.h"

/* --- Material --------------------------------------------------------------------------------- */

/* A mesh in a view, golden's own report of it, and the history. */
typedef struct sample {
    hs_mesh mesh;
    hs_view view;
    hs_golden *golden;
    hs_packet in, out;
    hs_golden_report report;
    hs_history history;
    hs_output output;
} sample;

static sample make_sample(const char *shape, uint32_t size, uint32_t view, hs_settings settings,
                          hs_limits limits) {
    hs_error err = {0};
    sample s = {0};
    if (!hs_shape_make(&s.mesh, shape, size, 1, &err) ||
        !hs_view_choose(&s.view, view, NULL, 5, &s.mesh, 1, &err))
        fail_msg("%s", err.text);
    for (uint32_t f = 0; f < s.mesh.faces && settings.min_edge == 1; f++)
        s.mesh.forced[f] = (uint8_t)(f % 3 ? 3 : 0);
    s.golden = hs_golden_new(limits);
    if (!hs_packet_encode(&s.in, 0, &s.mesh, s.view.matrix, &settings, &err) ||
        !hs_golden_run(s.golden, &s.in, &s.out, &s.report, &err) ||
        !hs_history_record(&s.history, &s.output, &s.mesh, s.view.matrix, &settings, limits, &err))
        fail_msg("%s: %s", shape, err.text);
    return s;
}

static void free_sample(sample *s) {
    hs_history_free(&s->history);
    hs_output_free(&s->output);
    hs_packet_free(&s->in);
    hs_packet_free(&s->out);
    hs_golden_free(s->golden);
    hs_mesh_free(&s->mesh);
}

static const char *const SHAPE[] = {"cube", "hand", "grid", "spoon", "die", "mixed"};
static const hs_settings SETTINGS[] = {
    {.front_depth = 3, .silhouette_depth = 6, .guard = true, .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 2, .silhouette_depth = 5, .guard = false, .boundary = HS_BOUNDARY_KEPT},
    {.front_depth = 4, .silhouette_depth = 3, .guard = true, .boundary = HS_BOUNDARY_EDGE_ONLY},
    {.front_depth = 2,
     .silhouette_depth = 4,
     .guard = true,
     .limit = true,
     .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 5,
     .silhouette_depth = 6,
     .guard = true,
     .min_edge = 160,
     .width = 256,
     .height = 256},
    {.front_depth = 1,
     .silhouette_depth = 2,
     .guard = true,
     .min_edge = 1,
     .width = 256,
     .height = 256}, /* and forced depths */
    {.uniform = true, .uniform_depth = 3, .guard = true, .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 0, .silhouette_depth = 0, .guard = true},
};

/* Calls check on all shapes with all settings, from a view that changes with both. */
static void on_all(void (*check)(const sample *s)) {
    for (size_t i = 0; i < sizeof SHAPE / sizeof *SHAPE; i++)
        for (size_t k = 0; k < sizeof SETTINGS / sizeof *SETTINGS; k++) {
            sample s =
                make_sample(SHAPE[i], 0, (uint32_t)(i + k) % 5, SETTINGS[k], HS_DEFAULT_LIMITS);
            check(&s);
            free_sample(&s);
        }
}

/* --- Against golden --------------------------------------------------------------------------- */

/* By generation and vertices, which the output has, and by golden's own report. */
static void check_outputs(const sample *s) {
    const hs_history *history = &s->history;
    uint32_t final[HS_MAX_DEPTH + 2] = {0};
    assert_int_equal(history->outputs, s->output.faces);
    for (uint32_t i = 0; i < s->output.faces; i++) {
        const hs_origin *o = &history->origin[i];
        const hs_past *p = &history->past[o->generation];
        assert_int_equal(o->generation, s->output.generation[i]);
        assert_in_range(o->face, 0, p->faces - 1);
        const hs_outcome outcome = hs_outcome_of(history, o->generation, o->face);
        assert_int_equal(outcome <= HS_OUTCOME_GUARD, o->halfedge != HS_HISTORY_NONE);
        final[o->generation]++;
        const uint32_t first = s->output.first[i];
        const uint32_t h = o->halfedge == HS_HISTORY_NONE ? p->first[o->face] : o->halfedge;
        assert_int_equal(s->output.number[s->output.corner[first]], p->origin[h]);
    }
    assert_int_equal(history->generations, s->report.generations);
    for (uint32_t g = 0; g < history->generations; g++) {
        const hs_past *p = &history->past[g];
        assert_int_equal(p->faces, s->report.generation[g].active);
        assert_int_equal(final[g], s->report.generation[g].final);
        uint32_t count[HS_OUTCOME_LAST + 1] = {0};
        for (uint32_t f = 0; f < p->faces; f++) {
            const hs_outcome outcome = hs_outcome_of(history, g, f);
            count[outcome]++;
            assert_int_equal((s->report.decision[g][f] & FACE_REFINED) != 0,
                             outcome <= HS_OUTCOME_GUARD);
            assert_int_equal(p->output[f] == HS_HISTORY_NONE, outcome <= HS_OUTCOME_GUARD);
        }
        assert_int_equal(count[HS_OUTCOME_SELECTED] + count[HS_OUTCOME_GUARD],
                         s->report.generation[g].refined);
        assert_int_equal(count[HS_OUTCOME_SELECTED], s->report.generation[g].selected);
    }
}

static void every_output_face_is_explained_in_its_generation(void **state) {
    (void)state;
    on_all(check_outputs);
}

static uint32_t guarded, no_candidates;

static void check_words(const sample *s) {
    const hs_history *history = &s->history;
    for (uint32_t g = 0; g < history->generations; g++)
        for (uint32_t f = 0; f < history->past[g].faces; f += 1 + history->past[g].faces / 50) {
            const hs_past *p = &history->past[g];
            char why[600], terms[300];
            hs_explain_why(history, g, f, why, sizeof why);
            hs_explain_terms(history, g, f, terms, sizeof terms);
            assert_true(strstr(why, terms) != NULL && *terms);
            const hs_outcome outcome = hs_outcome_of(history, g, f);
            if (outcome == HS_OUTCOME_SELECTED) assert_memory_equal(why, "selected: ", 10);
            if (outcome >= HS_OUTCOME_FINAL) assert_memory_equal(why, "final: ", 7);
            if (strstr(why, "no candidate")) {
                uint32_t parent[2];
                assert_true(hs_history_parents(history, g, f, parent));
                const uint8_t *decision = history->past[g - 1].decision;
                assert_false(decision[parent[0]] & decision[parent[1]] & FACE_SELECTED);
                const char *cause = strstr(why, "no candidate (");
                assert_non_null(cause);
                for (int i = 0; i < 2; i++) {
                    char name[40];
                    snprintf(name, sizeof name, "%u:%u ", g - 1, parent[i]);
                    assert_int_equal(strstr(cause, name) == NULL,
                                     (decision[parent[i]] & FACE_SELECTED) != 0);
                }
                no_candidates++;
            }
            if (outcome != HS_OUTCOME_GUARD) continue;
            uint32_t vertex, selected;
            assert_true(hs_guard_witness(history, g, f, &vertex, &selected));
            assert_true(s->report.decision[g][selected] & FACE_SELECTED);
            bool mine = false, its = false;
            for (uint32_t i = 0; i < p->sides[f]; i++)
                mine = mine || p->origin[p->first[f] + i] == vertex;
            for (uint32_t i = 0; i < p->sides[selected]; i++)
                its = its || p->origin[p->first[selected] + i] == vertex;
            assert_true(mine && its);
            char begin[100];
            snprintf(begin, sizeof begin,
                     "guard ring: vertex %u is a corner of selected face %u:%u;", vertex, g,
                     selected);
            assert_memory_equal(why, begin, strlen(begin));
            guarded++;
        }
}

static void a_face_that_only_the_guard_ring_refines_is_told_so(void **state) {
    (void)state;
    on_all(check_words);
    assert_true(guarded > 100 && no_candidates > 100);
}

/* --- Where faces come from -------------------------------------------------------------------- */

/* In object space a face of an even generation lies where its initial face is: by vertices. Of a
 * quad of an initial face, one is the vertex of that face. */
static void check_lines(const sample *s) {
    const hs_history *history = &s->history;
    hs_error err = {0};
    for (uint32_t g = 0; g < history->generations; g++)
        for (uint32_t f = 0; f < history->past[g].faces; f += 1 + history->past[g].faces / 20) {
            const hs_past *p = &history->past[g];
            hs_ancestors a;
            if (!hs_ancestors_find(&a, history, g, f, &err)) fail_msg("%s", err.text);
            assert_int_equal(a.line[0], p->within[f][0]);
            for (uint32_t k = 0; k <= g; k++) {
                bool found = false;
                for (uint32_t i = 0; i < a.count[k]; i++) {
                    found = found || a.face[k][i] == a.line[k];
                    assert_true(i == 0 || a.face[k][i - 1] < a.face[k][i]);
                }
                assert_true(found);
            }
            hs_ancestors_free(&a);
            if (g != 2) continue;
            uint32_t inside = 0;
            for (uint32_t i = 0; i < p->sides[f]; i++)
                inside += p->origin[p->first[f] + i] == history->past[0].number[p->within[f][0]];
            assert_int_equal(inside, 1);
        }
    uint32_t quads = 0;
    for (uint32_t f = 0; f < history->past[0].faces; f++) {
        const hs_inside here = hs_inside_of(history, 0, f);
        assert_int_equal(here.faces, 1);
        if (history->generations > 2) quads += hs_inside_of(history, 2, f).faces;
    }
    if (history->generations > 2) assert_int_equal(quads, history->past[2].faces);
}

static void a_face_is_traced_to_the_initial_face_that_it_lies_in(void **state) {
    (void)state;
    on_all(check_lines);
}

static void a_capacity_that_stops_the_view_is_the_reason(void **state) {
    (void)state;
    sample s = make_sample("hand", 0, 0, SETTINGS[0], (hs_limits){4000, 4000});
    assert_int_equal(s.output.status, HS_STATUS_STOPPED);
    check_outputs(&s);
    const uint32_t last = s.history.generations - 1;
    char why[600];
    hs_explain_why(&s.history, last, 0, why, sizeof why);
    assert_non_null(strstr(why, "a capacity stopped the view"));
    free_sample(&s);
}

/* --- The pixel -------------------------------------------------------------------------------- */

/* All front faces of a convex body are seen: in a large picture, the pixel that a face's middle is
 * in shows that face. */
static void the_pixel_of_a_visible_face_s_middle_shows_that_face(void **state) {
    (void)state;
    sample s = make_sample("cube", 0, 1, SETTINGS[0], HS_DEFAULT_LIMITS);
    hs_surface surface;
    hs_error err = {0};
    assert_true(hs_surface_of_output(&surface, &s.output, s.view.matrix, &err));
    uint32_t seen = 0;
    for (uint32_t f = 0; f < surface.faces; f++) {
        if (surface.facing[f] != HS_FACING_FRONT) continue;
        const uint32_t begin = surface.first[f], sides = surface.first[f + 1] - begin;
        double mean[4] = {0};
        for (uint32_t i = 0; i < 4 * sides; i++)
            mean[i % 4] += (double)surface.clip[4 * (size_t)surface.corner[begin + i / 4] + i % 4];
        const double x = (mean[0] / mean[3] + 1) / 2 * 8000, y = (1 - mean[1] / mean[3]) / 2 * 8000;
        assert_int_equal(hs_pick(&surface, (uint32_t)x, (uint32_t)y, 8000, 8000), f);
        seen++;
    }
    assert_true(seen > 30);
    assert_int_equal(hs_pick(&surface, 0, 0, 8000, 8000), HS_PICK_NONE);
    hs_surface_free(&surface);
    free_sample(&s);
}

/* A triangle with a corner behind the eye is seen where it is before it, and not mirrored. */
static void a_triangle_that_reaches_behind_the_eye_is_seen_in_front_of_it_alone(void **state) {
    (void)state;
    float clip[] = {-1, 0, 0, 1, 1, 0, 0, 1, 0, -0.5f, 0, -1};
    uint32_t first[] = {0, 3}, corner[] = {0, 1, 2};
    const hs_surface surface = {
        .vertices = 3, .faces = 1, .clip = clip, .first = first, .corner = corner};
    assert_int_equal(hs_pick(&surface, 50, 5, 101, 101), HS_PICK_NONE);
    assert_int_equal(hs_pick(&surface, 50, 75, 101, 101), 0);
}

/* --- The command ------------------------------------------------------------------------------ */

/* Succeeds, says what it should, and stays within 80 columns. */
static void expect_text(const char *arguments, const char *what) {
    expect(HS_EXIT_OK, arguments, what);
    for (const char *c = output; *c; c += strcspn(c, "\n") + (c[strcspn(c, "\n")] == '\n'))
        if (strcspn(c, "\n") > 80) fail_msg("more than 80 columns: %.100s", c);
}

static void the_command_tells_it_in_80_columns(void **state) {
    (void)state;
    expect_text("explain shape:hand --face 77", "what lies in it");
    expect_text("explain shape:hand --orbit 5 --view 2 --output-face 1200", "half-edge");
    expect_text("explain shape:hand --pixel 384,384", "pixel 384,384: face ");
    expect_text("explain shape:spoon --output-face 500 --boundary smooth", "initial face");
    expect_text("explain shape:hand --uniform 4 --face 3", "uniform depth 4");
    expect_text("explain --help", "--pixel");
}

static void what_is_wrong_with_the_question_is_said(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "explain shape:cube", "give one of --face N");
    expect(HS_EXIT_USAGE, "explain shape:cube --face 1 --pixel 3,3", "give one of");
    expect(HS_EXIT_USAGE, "explain shape:cube --face 6", "generation 0 has 6 active faces");
    expect(HS_EXIT_USAGE, "explain shape:cube --face 99:0", "this view has generations 0 to");
    expect(HS_EXIT_USAGE, "explain shape:cube --face 1x", "GENERATION:NUMBER");
    expect(HS_EXIT_USAGE, "explain shape:cube --output-face 99999", "the output has faces 0 to");
    expect(HS_EXIT_USAGE, "explain shape:cube --pixel 0,0", "shows no face");
    expect(HS_EXIT_USAGE, "explain shape:cube --pixel 768,0", "pixels are 0,0 to 767,767");
}

/* The JSON of one guard-only face has the same facts as the history. */
static void json_has_the_facts(void **state) {
    (void)state;
    sample s = make_sample("hand", 0, 2, SETTINGS[0], HS_DEFAULT_LIMITS);
    const hs_history *history = &s.history;
    uint32_t face = HS_HISTORY_NONE;
    for (uint32_t f = 0; f < history->past[4].faces; f++)
        if (hs_outcome_of(history, 4, f) == HS_OUTCOME_GUARD) face = f;
    assert_true(face != HS_HISTORY_NONE);
    char arguments[200];
    snprintf(arguments, sizeof arguments,
             "explain shape:hand --orbit 5 --view 2 --front 3 --silhouette 6 --face 4:%u --json "
             "@/e.json",
             face);
    expect_text(arguments, "guard ring: vertex");
    json_t *root = read_json("e.json");
    json_t *faces = json_object_get(root, "faces");
    json_t *last = json_array_get(faces, json_array_size(faces) - 1);
    assert_int_equal(json_integer_value(json_object_get(last, "face")), face);
    assert_string_equal(json_string_value(json_object_get(last, "outcome")), "guard");
    assert_true(json_is_true(json_object_get(last, "refined")));
    assert_true(json_is_false(json_object_get(last, "selected")));
    uint32_t vertex, selected;
    assert_true(hs_guard_witness(history, 4, face, &vertex, &selected));
    const json_t *guard = json_object_get(last, "guard");
    assert_int_equal(json_integer_value(json_object_get(guard, "vertex")), vertex);
    assert_int_equal(json_integer_value(json_object_get(guard, "face")), selected);
    json_t *vertices = json_object_get(last, "vertices");
    for (uint32_t i = 0; i < history->past[4].sides[face]; i++) {
        const json_t *v = json_array_get(vertices, i);
        const uint32_t number = history->past[4].origin[history->past[4].first[face] + i];
        const uint8_t mark = history->past[4].mark[number];
        assert_int_equal(json_integer_value(json_object_get(v, "vertex")), number);
        assert_int_equal(json_is_true(json_object_get(v, "front")), (mark & MARK_FRONT) != 0);
        assert_int_equal(json_is_true(json_object_get(v, "back")), (mark & MARK_BACK) != 0);
        assert_int_equal(json_is_true(json_object_get(v, "chosen")), (mark & MARK_CHOSEN) != 0);
    }
    json_decref(root);
    free_sample(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_output_face_is_explained_in_its_generation),
        cmocka_unit_test(a_face_that_only_the_guard_ring_refines_is_told_so),
        cmocka_unit_test(a_face_is_traced_to_the_initial_face_that_it_lies_in),
        cmocka_unit_test(a_capacity_that_stops_the_view_is_the_reason),
        cmocka_unit_test(the_pixel_of_a_visible_face_s_middle_shows_that_face),
        cmocka_unit_test(a_triangle_that_reaches_behind_the_eye_is_seen_in_front_of_it_alone),
        cmocka_unit_test(the_command_tells_it_in_80_columns),
        cmocka_unit_test(what_is_wrong_with_the_question_is_said),
        cmocka_unit_test(json_has_the_facts),
    };
    return cmocka_run_group_tests_name("explain", tests, new_place, leave_place);
}
