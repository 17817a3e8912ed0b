/* SPDX-License-Identifier: Apache-2.0
 *
 * Are golden and the reference the same refinement? Golden's runs are replayed in doubles: the same
 * faces in the same order, positions within the documented bound; and a comparison that finds
 * everything that could be different.
 */
#include "golden.h"
#include "reference_shapes.h"

typedef struct {
    hs_output output;
    hs_reference reference;
    hs_reference_decisions decisions;
} replayed;

/* The pipeline's transform: binary32, every operation rounded. */
static void transform(const float m[16], const float p[4], float clip[4]) {
    for (size_t row = 0; row < 4; row++, m += 4)
        clip[row] = (m[0] * p[0] + m[1] * p[1]) + (m[2] * p[2] + m[3] * p[3]);
}

/* The reference from what the transform gives, so that only the refinement is compared. */
static hs_reference new_reference_in_clip_space(const hs_mesh *mesh, const float matrix[16],
                                                hs_boundary boundary) {
    hs_mesh clip = *mesh;
    clip.position = malloc(4 * mesh->vertices * sizeof(float));
    assert_non_null(clip.position);
    for (size_t v = 0; v < mesh->vertices; v++)
        transform(matrix, mesh->position + 4 * v, clip.position + 4 * v);
    const hs_reference r = new_reference(&clip, NULL, boundary);
    free(clip.position);
    return r;
}

static hs_reference new_reference_in_object_space(const hs_mesh *mesh, const float matrix[16],
                                                  hs_boundary boundary) {
    double m[16];
    for (int i = 0; i < 16; i++)
        m[i] = (double)matrix[i];
    return new_reference(mesh, m, boundary);
}

static replayed replay(hs_golden *golden, const sample *s, const float matrix[16],
                       const hs_settings *settings, bool from_clip_space) {
    replayed run = {0};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_error err;
    run.reference = from_clip_space
                        ? new_reference_in_clip_space(&s->mesh, matrix, settings->boundary)
                        : new_reference_in_object_space(&s->mesh, matrix, settings->boundary);
    if (!hs_packet_encode(&in, 0, &s->mesh, matrix, settings, &err) ||
        !hs_golden_run(golden, &in, &out, &report, &err) ||
        !hs_output_decode(&run.output, &out, &err) ||
        !hs_reference_replay(&run.reference, settings, &report, &run.decisions, &err))
        fail_msg("%s: %s", s->name, err.text);
    assert_int_equal(report.status, HS_STATUS_OK);
    hs_packet_free(&in);
    hs_packet_free(&out);
    return run;
}

static void free_replayed(replayed *run) {
    hs_output_free(&run->output);
    hs_reference_free(&run->reference);
}

static const hs_settings replayed_settings[] = {
    {.front_depth = 4, .silhouette_depth = 8, .guard = true},
    {.front_depth = 4, .silhouette_depth = 8, .guard = false},
    {.front_depth = 3, .silhouette_depth = 5, .guard = true},
    {.uniform = true, .uniform_depth = 5, .guard = true},
    {.front_depth = 4, .silhouette_depth = 7, .guard = true, .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 3, .silhouette_depth = 6, .guard = false, .boundary = HS_BOUNDARY_EDGE_ONLY},
    {.uniform = true, .uniform_depth = 4, .guard = true, .boundary = HS_BOUNDARY_EDGE_ONLY},
    {.uniform = true, .uniform_depth = 5, .guard = true, .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 4, .silhouette_depth = 6, .guard = true, .limit = true},
    {.front_depth = 3,
     .silhouette_depth = 5,
     .guard = true,
     .limit = true,
     .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 2,
     .silhouette_depth = 4,
     .guard = false,
     .limit = true,
     .boundary = HS_BOUNDARY_EDGE_ONLY},
    {.uniform = true,
     .uniform_depth = 3,
     .guard = true,
     .limit = true,
     .boundary = HS_BOUNDARY_SMOOTH},
    {.front_depth = 9,
     .silhouette_depth = 9,
     .guard = true,
     .boundary = HS_BOUNDARY_SMOOTH,
     .min_edge = 20 * HS_PIXEL_FRACTION,
     .width = 1024,
     .height = 768},
};

/* Sums over many comparisons. */
typedef struct {
    uint64_t faces, components, equal;
    double worst, pixels; /* share of the bound; at 1024 x 1024 */
    hs_reference_decisions decisions;
} totals;

static void add_run(totals *sum, const replayed *run, const hs_reference_comparison *c) {
    sum->faces += c->faces;
    sum->components += c->components;
    sum->equal += c->equal;
    sum->worst = fmax(sum->worst, c->largest_distance / c->bound);
    sum->pixels = fmax(sum->pixels, c->largest_pixels);
    sum->decisions.faces += run->decisions.faces;
    sum->decisions.selected_different += run->decisions.selected_different;
    sum->decisions.refined_different += run->decisions.refined_different;
}

static void print_totals(const totals *sum, uint32_t meshes) {
    print_message("%u meshes, %llu faces: distance at most %.2f of the bound, %.2g pixels; %.1f%% "
                  "of components bit-equal to doubles rounded once; of %llu decisions %llu "
                  "selected, %llu refined differ\n",
                  meshes, (unsigned long long)sum->faces, sum->worst, sum->pixels,
                  100 * (double)sum->equal / (double)sum->components,
                  (unsigned long long)sum->decisions.faces,
                  (unsigned long long)sum->decisions.selected_different,
                  (unsigned long long)sum->decisions.refined_different);
}

static void compare_all(const samples *all, bool from_clip_space) {
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_non_null(golden);
    totals sum = {0};
    for (uint32_t i = 0; i < all->count; i++) {
        for (unsigned k = 0; k < sizeof replayed_settings / sizeof *replayed_settings; k++) {
            const sample *s = &all->item[i];
            replayed run = replay(golden, s, perspective, &replayed_settings[k], from_clip_space);
            hs_reference_comparison c;
            if (!hs_reference_compare(&run.reference, &run.output, &c))
                fail_msg("%s, settings %u: %s", s->name, k, c.first);
            check_conforming(&run.reference, s);
            add_run(&sum, &run, &c);
            free_replayed(&run);
        }
    }
    hs_golden_free(golden);
    print_totals(&sum, all->count);
    assert_true(sum.decisions.selected_different * 1000 < sum.decisions.faces);
    assert_true(sum.worst > 0); /* integers are not doubles: a distance of 0 compares nothing */
}

static void golden_is_within_the_documented_bound_of_the_reference(void **state) {
    compare_all(*state, false);
}

static void from_the_same_clip_positions_the_bound_is_tighter_and_holds(void **state) {
    compare_all(*state, true);
}

/* A forced region has a rim inside the mesh whatever the view, and depths of its own. */
static void forced_faces_are_replayed(void **state) {
    const samples *all = *state;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    for (uint32_t i = 0; i < all->count; i++) {
        sample s = all->item[i];
        uint8_t *forced = calloc(s.mesh.faces, 1);
        assert_non_null(forced);
        for (uint32_t f = 0; f < s.mesh.faces; f++)
            forced[f] = (uint8_t)(6 * f / s.mesh.faces);
        s.mesh.forced = forced;
        const hs_settings nothing_else = {
            .guard = true, .limit = i % 2 == 1, .boundary = (hs_boundary)(i % 3)};
        replayed run = replay(golden, &s, perspective, &nothing_else, true);
        hs_reference_comparison c;
        if (!hs_reference_compare(&run.reference, &run.output, &c))
            fail_msg("%s: %s", s.name, c.first);
        assert_int_equal(run.decisions.selected_different, 0); /* no geometry decides here */
        assert_int_equal(run.decisions.refined_different, 0);
        check_conforming(&run.reference, &s);
        free_replayed(&run);
        free(forced);
    }
    hs_golden_free(golden);
}

/* What leaves at its limit is elsewhere than its level has it; all of a closed uniform run does. */
static void limit_positions_are_kept_apart_from_the_levels(void **state) {
    const samples *all = *state;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    const hs_settings deep = {.uniform = true, .uniform_depth = 3, .limit = true};
    replayed run = replay(golden, &all->item[2], perspective, &deep, true);
    assert_int_equal(run.reference.at_level, 0);
    for (uint32_t v = 0; v < run.reference.vertices; v++) {
        const hs_reference_vertex *vertex = &run.reference.vertex[v];
        assert_memory_not_equal(vertex->limit, vertex->position, sizeof vertex->limit);
    }
    free_replayed(&run);

    const hs_settings shallow = {.front_depth = 3, .guard = true, .limit = true};
    run = replay(golden, &all->item[2], perspective, &shallow, true);
    assert_true(run.reference.at_level > 0);
    assert_int_equal(run.output.at_level, run.reference.at_level);
    free_replayed(&run);
    hs_golden_free(golden);
}

/* Golden gives up before it exceeds a limit, and everything leaves as it is. */
static void a_view_that_was_stopped_is_replayed(void **state) {
    const samples *all = *state;
    const sample *torus = &all->item[2];
    const hs_settings deep = {.uniform = true, .uniform_depth = 8, .guard = true};
    hs_golden *golden = hs_golden_new((hs_limits){200, 200});
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_output output;
    hs_error err;
    assert_true(hs_packet_encode(&in, 0, &torus->mesh, perspective, &deep, &err));
    assert_true(hs_golden_run(golden, &in, &out, &report, &err));
    assert_int_equal(report.status, HS_STATUS_STOPPED);
    assert_true(hs_output_decode(&output, &out, &err));
    hs_reference r = new_reference_in_clip_space(&torus->mesh, perspective, HS_BOUNDARY_KEPT);
    hs_reference_decisions decisions;
    assert_true(hs_reference_replay(&r, &deep, &report, &decisions, &err));
    hs_reference_comparison c;
    assert_true(hs_reference_compare(&r, &output, &c));
    assert_int_equal(r.finals, 160); /* 20 quads, three steps; a fourth needs 320 vertices */
    assert_int_equal(decisions.selected_different, 0);
    hs_reference_free(&r);
    hs_output_free(&output);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_golden_free(golden);
}

static void a_comparison_finds_what_is_different(void **state) {
    const samples *all = *state;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    replayed run = replay(golden, &all->item[2], perspective, &replayed_settings[0], false);
    const hs_output *o = &run.output;
    hs_reference_comparison c;
    assert_true(hs_reference_compare(&run.reference, o, &c));
    assert_string_equal(c.first, "");

    const float position = o->position[6];
    o->position[6] += (float)(4 * c.bound * ldexp(1, o->exponent));
    assert_false(hs_reference_compare(&run.reference, o, &c));
    assert_int_equal(c.beyond_bound, 1);
    assert_int_equal(c.largest_vertex, o->number[1]);
    o->position[6] = NAN;
    assert_false(hs_reference_compare(&run.reference, o, &c));
    o->position[6] = position;

    const uint32_t corner = o->corner[0];
    o->corner[0] = o->corner[1];
    assert_false(hs_reference_compare(&run.reference, o, &c));
    assert_int_equal(c.different_faces, 1);
    o->corner[0] = corner;

    const uint32_t number = o->number[3];
    o->number[3] = o->number[2];
    assert_false(hs_reference_compare(&run.reference, o, &c));
    assert_int_equal(c.different_vertices, 2); /* one comes twice, one never */
    o->number[3] = number;

    o->generation[0]++;
    assert_false(hs_reference_compare(&run.reference, o, &c));
    assert_int_equal(c.different_faces, 1);
    assert_non_null(strstr(c.first, "generation of output face 0"));
    o->generation[0]--;

    o->candidate[0] ^= 1;
    assert_false(hs_reference_compare(&run.reference, o, &c));
    assert_int_equal(c.different_faces, 1);
    o->candidate[0] ^= 1;

    run.output.at_level = 3;
    assert_false(hs_reference_compare(&run.reference, o, &c));
    assert_int_equal(c.different_at_level, 3);
    assert_non_null(strstr(c.first, "at their level"));
    run.output.at_level = 0;
    assert_true(hs_reference_compare(&run.reference, o, &c));
    free_replayed(&run);
    hs_golden_free(golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(golden_is_within_the_documented_bound_of_the_reference),
        cmocka_unit_test(from_the_same_clip_positions_the_bound_is_tighter_and_holds),
        cmocka_unit_test(forced_faces_are_replayed),
        cmocka_unit_test(limit_positions_are_kept_apart_from_the_levels),
        cmocka_unit_test(a_view_that_was_stopped_is_replayed),
        cmocka_unit_test(a_comparison_finds_what_is_different),
    };
    return cmocka_run_group_tests_name("reference replay", tests, make_all_samples, free_samples);
}
