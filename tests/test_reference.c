/* SPDX-License-Identifier: Apache-2.0
 *
 * Is the reference right? Its surface is compared with OpenSubdiv's, vertex by vertex, through a
 * correspondence that comes from the topology alone; its counts with closed forms; its refinement
 * of a part of a mesh with what a conforming mesh is.
 */
#include "reference_levels.h"

/* Enough levels to see irregular faces and vertices come and go, within a second. */
static uint32_t levels_for(const hs_mesh *mesh) {
    return mesh->halfedges < 8000 ? 3 : 2;
}

/* --- The surface, beside OpenSubdiv's --------------------------------------------------------- */

static void compare_all_with_opensubdiv(const samples *all, refine_level *refine) {
    for (unsigned mode = 0; mode < 2; mode++) {
        double worst = 0;
        for (uint32_t i = 0; i < all->count; i++) {
            const hs_mesh *mesh = &all->item[i].mesh;
            const double here =
                compare_with_opensubdiv(mesh, refined_modes[mode], levels_for(mesh), refine);
            if (!(here <= 1e-12)) fail_msg("%s: relative distance %g", all->item[i].name, here);
            worst = fmax(worst, here);
        }
        print_message("%u meshes, mode %u: worst relative distance %.2g\n", all->count,
                      refined_modes[mode], worst);
    }
}

static void two_m_steps_are_m_levels_of_opensubdiv(void **state) {
    compare_all_with_opensubdiv(*state, two_steps);
}

static void direct_catmull_clark_is_opensubdivs(void **state) {
    compare_all_with_opensubdiv(*state, one_level);
}

static void the_race_against_opensubdiv_counts_what_it_made(void **state) {
    const samples *all = *state;
    const hs_mesh *mesh = &all->item[2].mesh;
    osd_timing timing;
    hs_error err;
    assert_true(osd_time(&timing, mesh, 4, &err));
    assert_int_equal(timing.faces, mesh->halfedges * 64);
    assert_int_equal(timing.vertices, mesh->halfedges * 64); /* a torus: V = F */
    assert_true(timing.topology > 0 && timing.position > 0);
    assert_false(osd_time(&timing, mesh, OSD_MAX_LEVELS + 1, &err));
}

static void a_corner_of_a_cube_moves_to_five_ninths(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    step(&r, NULL);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(r.vertex[7].position[i] - 5.0 / 9) < 1e-15);
    assert_true(fabs(r.vertex[7].position[3] - 1) < 1e-15);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

static void direct_catmull_clark_refuses_a_boundary_that_is_kept(void **state) {
    (void)state;
    const float position[] = {0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1};
    const uint32_t sides[] = {3}, corner[] = {0, 1, 2};
    hs_mesh triangle;
    build(&triangle, "triangle", 3, position, 1, sides, corner);
    hs_reference r = new_reference(&triangle, NULL, HS_BOUNDARY_KEPT);
    hs_error err = {0};
    assert_false(hs_reference_catmull_clark(&r, &err));
    assert_int_equal(err.code, HS_EXIT_MESH);
    assert_non_null(strstr(err.text, "boundary"));
    hs_reference_free(&r);
    hs_mesh_free(&triangle);
}

/* --- Topology --------------------------------------------------------------------------------- */

static uint32_t count_boundary(const hs_reference *r) {
    uint32_t count = 0;
    for (uint32_t e = 0; e < r->edges; e++) {
        assert_int_equal(r->edge[e].boundary, r->edge[e].f1 == HS_REFERENCE_NONE);
        count += r->edge[e].boundary;
    }
    return count;
}

/* With C corners and B boundary edges: V' = V + F; of an odd step F' = E, E' = C + B, B' = B; of an
 * even one F' = E - B, E' = C, B' = 2B. */
static void uniform_steps_have_the_closed_forms_counts(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        hs_reference r = new_reference(&all->item[i].mesh, NULL, HS_BOUNDARY_SMOOTH);
        for (uint32_t g = 0; g < 4; g++) {
            const uint32_t vertices = r.vertices, faces = r.faces, edges = r.edges,
                           corners = r.corners, boundary = count_boundary(&r);
            const bool odd = g % 2 == 0;
            assert_int_equal(2 * r.edges, r.corners + boundary);
            step(&r, NULL);
            assert_int_equal(r.vertices, vertices + faces);
            assert_int_equal(r.faces, odd ? edges : edges - boundary);
            assert_int_equal(r.edges, odd ? corners + boundary : corners);
            assert_int_equal(count_boundary(&r), odd ? boundary : 2 * boundary);
            assert_int_equal(r.finals, 0);
            assert_int_equal(r.generation, g + 1);
        }
        hs_reference_free(&r);
    }
}

static const hs_boundary all_modes[] = {HS_BOUNDARY_KEPT, HS_BOUNDARY_SMOOTH,
                                        HS_BOUNDARY_EDGE_ONLY};

static void uniform_refinement_is_conforming_at_every_depth(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        for (uint32_t k = 0; k < 2 * 5; k++) {
            hs_reference r = new_reference(&all->item[i].mesh, NULL, all_modes[k / 5]);
            for (uint32_t g = 0; g < k % 5; g++)
                step(&r, NULL);
            finish(&r);
            assert_int_equal(r.faces, 0);
            check_conforming(&r, &all->item[i]);
            hs_reference_free(&r);
        }
    }
}

/* The step to the last generation gives what an ordinary one does, in another order of faces. */
static void a_last_step_gives_the_faces_of_an_ordinary_one(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        for (uint32_t depth = 1; depth <= 4; depth++) {
            hs_reference a = new_reference(&all->item[i].mesh, NULL, HS_BOUNDARY_SMOOTH), b;
            hs_error err;
            for (uint32_t g = 0; g + 1 < depth; g++)
                step(&a, NULL);
            assert_true(hs_reference_copy(&b, &a, &err));
            step(&a, NULL);
            finish(&a);
            assert_true(hs_reference_last_step(&b, NULL, &err));
            assert_int_equal(b.faces, 0);
            assert_int_equal(a.finals, b.finals);
            assert_int_equal(a.final_corners, b.final_corners);
            for (uint32_t f = 0; f < a.finals; f++)
                assert_int_equal(a.final[f].generation, b.final[f].generation);
            check_conforming(&b, &all->item[i]);
            hs_reference_free(&a);
            hs_reference_free(&b);
        }
    }
}

static uint8_t *new_decision(uint32_t faces, uint8_t value) {
    uint8_t *decision = malloc(faces + 1u);
    assert_non_null(decision);
    memset(decision, value, faces + 1u);
    return decision;
}

static void refining_every_face_equals_a_uniform_step(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        hs_reference a = new_reference(&all->item[i].mesh, NULL, HS_BOUNDARY_SMOOTH), b;
        hs_error err;
        assert_true(hs_reference_copy(&b, &a, &err));
        for (uint32_t g = 0; g < 4; g++) {
            uint8_t *decision = new_decision(b.faces, HS_REFERENCE_SELECTED | HS_REFERENCE_REFINED);
            step(&a, NULL);
            step(&b, decision);
            free(decision);
            assert_int_equal(a.vertices, b.vertices);
            assert_int_equal(a.faces, b.faces);
            assert_int_equal(a.finals, b.finals);
            assert_memory_equal(a.face_vertex, b.face_vertex, a.corners * sizeof(uint32_t));
            for (uint32_t v = 0; v < a.vertices; v++)
                assert_memory_equal(a.vertex[v].position, b.vertex[v].position,
                                    sizeof a.vertex[v].position);
        }
        hs_reference_free(&a);
        hs_reference_free(&b);
    }
}

static uint32_t random_number(uint32_t *seed) {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

/* Positions of the vertices that are held, before a step; others are NAN. */
static double *held_positions(const hs_reference *r) {
    double *x = malloc((r->vertices + 1u) * sizeof *x);
    assert_non_null(x);
    for (uint32_t v = 0; v < r->vertices; v++)
        x[v] = r->vertex[v].held ? r->vertex[v].position[0] : (double)NAN;
    return x;
}

static void refine_at_random(hs_reference *r, uint32_t generations, uint32_t *seed) {
    for (uint32_t g = 0; g < generations; g++) {
        uint8_t *decision = new_decision(r->faces, 0);
        for (uint32_t f = 0; f < r->faces; f++)
            if (random_number(seed) % 8 != 0) decision[f] = HS_REFERENCE_REFINED;
        const uint32_t vertices = r->vertices;
        double *held = held_positions(r);
        step(r, decision);
        for (uint32_t v = 0; v < vertices; v++)
            if (!isnan(held[v])) assert_true(held[v] == r->vertex[v].position[0]);
        free(held);
        free(decision);
    }
}

static void refining_any_faces_gives_a_conforming_mesh(void **state) {
    const samples *all = *state;
    uint32_t seed = 2463534242u;
    for (uint32_t i = 0; i < all->count; i++) {
        for (uint32_t run = 0; run < 6; run++) {
            hs_reference r = new_reference(&all->item[i].mesh, NULL, all_modes[run % 3]);
            refine_at_random(&r, 5, &seed);
            finish(&r);
            check_conforming(&r, &all->item[i]);
            hs_reference_free(&r);
        }
    }
}

/* Faces 0 and 2 of a cube are refined: their common edge becomes a quad; every other side leaves a
 * triangle in its place in the order of the faces. */
static void final_faces_leave_in_the_order_of_the_active_ones(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    const uint8_t decision[6] = {HS_REFERENCE_REFINED, 0, HS_REFERENCE_REFINED, 0, 0, 0};
    step(&r, decision);
    finish(&r);
    const uint32_t expected[11][4] = {{4, 5, 8},    {7, 6, 8},    {6, 4, 8},   {0, 2, 3, 1},
                                      {1, 3, 9},    {3, 7, 9},    {5, 1, 9},   {0, 4, 6, 2},
                                      {2, 6, 7, 3}, {0, 1, 5, 4}, {7, 8, 5, 9}};
    assert_int_equal(r.finals, 11);
    for (uint32_t f = 0; f < 11; f++) {
        const hs_reference_list v = r.final[f].v;
        assert_int_equal(v.count, expected[f][3] ? 4 : 3);
        assert_memory_equal(r.final_vertex + v.first, expected[f], v.count * sizeof(uint32_t));
        assert_int_equal(r.final[f].generation, f == 10 ? 1 : 0);
    }
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* --- Its own decisions ------------------------------------------------------------------------ */

static void decide(const hs_reference *r, const hs_settings *settings, uint8_t *decision) {
    hs_error err;
    if (!hs_reference_decide(r, settings, decision, &err)) fail_msg("%s", err.text);
}

/* Orthographic, along -z: of a cube's faces, the first looks at the eye, the second away, and the
 * others are seen edge on, which counts as back. */
static void only_the_front_face_of_a_cube_is_front(void **state) {
    (void)state;
    const double look[16] = {0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 1};
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, look, HS_BOUNDARY_SMOOTH);
    uint8_t decision[6];
    const hs_settings front = {.front_depth = 1}, guarded = {.front_depth = 1, .guard = true},
                      silhouette = {.silhouette_depth = 1};
    decide(&r, &front, decision);
    const uint8_t one[6] = {3, 0, 0, 0, 0, 0}, ring[6] = {3, 0, 2, 2, 2, 2},
                  edge[6] = {3, 0, 3, 3, 3, 3};
    assert_memory_equal(decision, one, 6);
    decide(&r, &guarded, decision);
    assert_memory_equal(decision, ring, 6);
    decide(&r, &silhouette, decision);
    assert_memory_equal(decision, edge, 6);
    hs_reference_free(&r);

    const double beside[16] = {0.5, 0, 0, 3, 0, 0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 1};
    r = new_reference(&cube, beside, HS_BOUNDARY_SMOOTH); /* out of view: x > w */
    decide(&r, &front, decision);
    assert_int_equal(decision[0], 0);
    cube.forced[1] = 1;
    hs_reference_free(&r);
    r = new_reference(&cube, beside, HS_BOUNDARY_SMOOTH);
    decide(&r, &front, decision);
    assert_int_equal(decision[1], HS_REFERENCE_SELECTED | HS_REFERENCE_REFINED);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* The cube's front is 1 wide and high in clip space of w = 1: half of the picture. */
static void a_face_stops_when_all_its_edges_are_short(void **state) {
    (void)state;
    const double look[16] = {0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 1};
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, look, HS_BOUNDARY_SMOOTH);
    uint8_t decision[6];
    static const struct {
        uint16_t width, height, min_edge;
        bool wanted;
    } cases[] = {
        {200, 200, 0, true},    {200, 200, 1600, true}, {200, 200, 1601, false},
        {201, 200, 1601, true}, {200, 201, 1601, true}, {200, 100, 1601, false},
        {100, 202, 1601, true},
    };
    for (size_t i = 0; i < sizeof cases / sizeof *cases; i++) {
        const hs_settings settings = {.front_depth = 1,
                                      .min_edge = cases[i].min_edge,
                                      .width = cases[i].width,
                                      .height = cases[i].height};
        decide(&r, &settings, decision);
        assert_int_equal(decision[0] & HS_REFERENCE_SELECTED, cases[i].wanted);
    }
    const hs_settings everything_is_short = {
        .front_depth = 1, .min_edge = 65535, .width = 1, .height = 1};
    r.vertex[4].position[3] = 0; /* a corner that is not before the eye */
    decide(&r, &everything_is_short, decision);
    assert_int_equal(decision[0], HS_REFERENCE_SELECTED | HS_REFERENCE_REFINED);
    hs_reference_free(&r);

    cube.forced[0] = 1; /* what is forced does not stop */
    r = new_reference(&cube, look, HS_BOUNDARY_SMOOTH);
    decide(&r, &everything_is_short, decision);
    assert_int_equal(decision[0], HS_REFERENCE_SELECTED | HS_REFERENCE_REFINED);
    assert_int_equal(decision[1], 0);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_corner_of_a_cube_moves_to_five_ninths),
        cmocka_unit_test(two_m_steps_are_m_levels_of_opensubdiv),
        cmocka_unit_test(direct_catmull_clark_is_opensubdivs),
        cmocka_unit_test(the_race_against_opensubdiv_counts_what_it_made),
        cmocka_unit_test(direct_catmull_clark_refuses_a_boundary_that_is_kept),
        cmocka_unit_test(uniform_steps_have_the_closed_forms_counts),
        cmocka_unit_test(uniform_refinement_is_conforming_at_every_depth),
        cmocka_unit_test(a_last_step_gives_the_faces_of_an_ordinary_one),
        cmocka_unit_test(refining_every_face_equals_a_uniform_step),
        cmocka_unit_test(refining_any_faces_gives_a_conforming_mesh),
        cmocka_unit_test(final_faces_leave_in_the_order_of_the_active_ones),
        cmocka_unit_test(only_the_front_face_of_a_cube_is_front),
        cmocka_unit_test(a_face_stops_when_all_its_edges_are_short),
    };
    return cmocka_run_group_tests_name("reference", tests, make_samples, free_samples);
}
