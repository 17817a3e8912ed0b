/* SPDX-License-Identifier: Apache-2.0
 *
 * Are boundaries, creases and sharp vertices of the reference OpenSubdiv's? Poles and faces of up
 * to 255 sides among them; and the masks of docs/refinement.md, section 9, by hand.
 */
#include "reference_levels.h"
#include "reference_shapes.h"

/* --- Beside OpenSubdiv ------------------------------------------------------------------------ */

static uint32_t levels_for(const hs_mesh *mesh) {
    return mesh->halfedges < 400 ? 3 : 2;
}

static double compare_in_all_ways(const char *name, const hs_mesh *mesh) {
    double worst = 0;
    for (unsigned mode = 0; mode < 2; mode++) {
        for (unsigned direct = 0; direct < 2; direct++) {
            const double here = compare_with_opensubdiv(mesh, refined_modes[mode], levels_for(mesh),
                                                        direct ? one_level : two_steps);
            if (!(here <= 1e-12))
                fail_msg("%s, mode %u, %s: relative distance %g", name, refined_modes[mode],
                         direct ? "directly" : "in two steps", here);
            worst = fmax(worst, here);
        }
    }
    return worst;
}

static void tagged_and_open_meshes_refine_as_opensubdivs(void **state) {
    const samples *all = *state;
    double worst = 0;
    for (uint32_t i = 0; i < all->count; i++)
        worst = fmax(worst, compare_in_all_ways(all->item[i].name, &all->item[i].mesh));
    print_message("%u meshes, both modes, directly and in steps: worst relative distance %.2g\n",
                  all->count, worst);
}

static void cubes_with_random_tags_refine_as_opensubdivs(void **state) {
    (void)state;
    enum { SEEDS = 300 };
    double worst = 0;
    for (uint32_t seed = 1; seed <= SEEDS; seed++) {
        hs_mesh cube;
        char name[32];
        snprintf(name, sizeof name, "seed %u", seed);
        build_random_cube(&cube, seed * 2654435761u);
        worst = fmax(worst, compare_in_all_ways(name, &cube));
        hs_mesh_free(&cube);
    }
    print_message("%u cubes: worst relative distance %.2g\n", SEEDS, worst);
}

/* --- Masks by hand ---------------------------------------------------------------------------- */

static void expect_position(const hs_reference *r, uint32_t v, double x, double y, double z) {
    const double *p = r->vertex[v].position;
    if (!(fabs(p[0] - x) < 1e-15 && fabs(p[1] - y) < 1e-15 && fabs(p[2] - z) < 1e-15))
        fail_msg("vertex %u is at %g %g %g, expected %g %g %g", v, p[0], p[1], p[2], x, y, z);
}

static void a_corner_of_the_boundary_stays_or_moves_as_the_mode_says(void **state) {
    (void)state;
    const float position[] = {0, 0, 0, 1, 8, 0, 0, 1, 8, 8, 0, 1, 0, 8, 0, 1};
    const uint32_t sides[] = {4}, corner[] = {0, 1, 2, 3};
    hs_mesh square;
    build(&square, "square", 4, position, 1, sides, corner);
    for (unsigned mode = 0; mode < 3; mode++) {
        hs_reference r = new_reference(&square, NULL, (hs_boundary)mode);
        step(&r, NULL);
        if (mode == HS_BOUNDARY_EDGE_ONLY)
            expect_position(&r, 0, 1, 1, 0); /* (8 0 0 + 6 * 0 0 0 + 0 8 0)/8 */
        else
            expect_position(&r, 0, 0, 0, 0);
        assert_int_equal(r.faces, mode == HS_BOUNDARY_KEPT ? 0 : 4);
        assert_int_equal(r.finals, mode == HS_BOUNDARY_KEPT ? 4 : 0);
        if (mode != HS_BOUNDARY_KEPT) { /* side 0 -> 1: the half-quad 1, F, 0 at the middle */
            const uint32_t half[3] = {1, 4, 0};
            assert_int_equal(r.face[0].v.count, 3);
            assert_memory_equal(r.face_vertex, half, sizeof half);
            step(&r, NULL);
            expect_position(&r, 5, 4, 0, 0);
            assert_int_equal(r.faces, 4);
        }
        hs_reference_free(&r);
    }
    hs_mesh_free(&square);
}

/* Edge 5-7 of a cube and its neighbour 7-6 are sharp for two levels: vertex 7 is on a crease. */
static void a_crease_wears_off_a_level_at_a_time(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    crease_edge(&cube, 5, 7, 2);
    crease_edge(&cube, 7, 6, 2);
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    step(&r, NULL);
    expect_position(&r, 7, 0.75, 0.75, 1); /* ((1 -1 1) + 6 (1 1 1) + (-1 1 1))/8 */
    step(&r, NULL);
    uint32_t sharp = 0;
    for (uint32_t e = 0; e < r.edges; e++) {
        if (!r.edge[e].sharpness) continue;
        assert_int_equal(r.edge[e].sharpness, 1);
        sharp++;
    }
    assert_int_equal(sharp, 4);
    two_steps(&r);
    for (uint32_t e = 0; e < r.edges; e++)
        assert_int_equal(r.edge[e].sharpness, 0);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

static void a_sharp_vertex_stays_as_long_as_it_is_sharp(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    make_taggable(&cube);
    cube.vertex_sharpness[7] = 2;
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    for (int level = 0; level < 2; level++) {
        two_steps(&r);
        expect_position(&r, 7, 1, 1, 1);
    }
    two_steps(&r);
    assert_true(r.vertex[7].position[0] < 0.99);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* Three sharp edges make a corner; when one of them wears off, the two others are a crease. */
static void three_sharp_edges_hold_a_vertex(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    crease_edge(&cube, 5, 7, HS_SHARP_INFINITE);
    crease_edge(&cube, 7, 6, HS_SHARP_INFINITE);
    crease_edge(&cube, 7, 3, 1);
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    two_steps(&r);
    expect_position(&r, 7, 1, 1, 1);
    step(&r, NULL);
    expect_position(&r, 7, 0.875, 0.875, 1); /* ((1 0 1) + 6 (1 1 1) + (0 1 1))/8 */
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_corner_of_the_boundary_stays_or_moves_as_the_mode_says),
        cmocka_unit_test(a_crease_wears_off_a_level_at_a_time),
        cmocka_unit_test(a_sharp_vertex_stays_as_long_as_it_is_sharp),
        cmocka_unit_test(three_sharp_edges_hold_a_vertex),
        cmocka_unit_test(cubes_with_random_tags_refine_as_opensubdivs),
        cmocka_unit_test(tagged_and_open_meshes_refine_as_opensubdivs),
    };
    return cmocka_run_group_tests_name("reference creases", tests, make_sharp_samples,
                                       free_samples);
}
