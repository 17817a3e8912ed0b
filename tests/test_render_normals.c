/* SPDX-License-Identifier: Apache-2.0
 *
 * Which way do the corners of a surface look, for light and for nothing else?
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "render.h"
#include "render_parts.h"
#include "run_pictures.h"
#include "shape.h"

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

static hs_mesh make_shape(const char *name, uint32_t size) {
    hs_error err;
    hs_mesh mesh;
    if (!hs_shape_make(&mesh, name, size, 1, &err)) fail_msg("%s", err.text);
    return mesh;
}

static float *normals_of(const hs_surface *surface) {
    float *normal = malloc(3 * (size_t)surface->first[surface->faces] * sizeof *normal);
    assert_non_null(normal);
    assert_true(hs_corner_normals(surface, normal));
    return normal;
}

/* The largest distance of a corner's normal from what it should be: of the face's own (sharp), or
 * of the direction of its vertex from the middle of a body around the origin. */
static double largest_distance(const hs_surface *surface, const float *normal, bool sharp) {
    double largest = 0;
    for (uint32_t f = 0; f < surface->faces; f++)
        for (uint32_t c = surface->first[f]; c < surface->first[f + 1]; c++) {
            double expected[3];
            memcpy(expected, &surface->object[3 * (size_t)surface->corner[c]], sizeof expected);
            hs_normalize(expected);
            if (sharp) hs_face_normal(surface, f, expected);
            for (uint32_t k = 0; k < 3; k++)
                largest = fmax(largest, fabs((double)normal[3 * (size_t)c + k] - expected[k]));
        }
    return largest;
}

/* The eight vertices of a cube look along its diagonals, unless it is refined: then what is left of
 * an angle of 90 degrees is a crease. */
static void a_cube_is_round_until_its_edges_are_known_to_be_creases(void **state) {
    (void)state;
    hs_error err;
    hs_mesh cube = make_shape("cube", 1);
    for (uint8_t generation = 0; generation < 4; generation++) {
        hs_surface surface;
        assert_true(hs_surface_of_mesh(&surface, &cube, identity, &err));
        memset(surface.generation, generation, surface.faces);
        float *normal = normals_of(&surface);
        assert_true(largest_distance(&surface, normal, generation >= 2) < 1e-6);
        free(normal);
        hs_surface_free(&surface);
    }
    hs_mesh_free(&cube);
}

static void gentle_angles_are_no_creases(void **state) {
    (void)state;
    hs_error err;
    hs_mesh torus = make_shape("torus", 24); /* 30 degrees from face to face */
    hs_surface surface;
    assert_true(hs_surface_of_mesh(&surface, &torus, identity, &err));
    float *initial = normals_of(&surface);
    memset(surface.generation, 8, surface.faces);
    float *refined = normals_of(&surface);
    assert_memory_equal(initial, refined, 3 * surface.first[surface.faces] * sizeof *initial);
    assert_true(largest_distance(&surface, refined, true) > 0.1);
    free(initial);
    free(refined);
    hs_surface_free(&surface);
    hs_mesh_free(&torus);
}

/* --- The reference surface's -------------------------------------------------------------------
 */

static hs_mesh make_sharp_cube(void) {
    hs_mesh cube = make_shape("cube", 1);
    cube.sharpness = malloc(cube.halfedges);
    assert_non_null(cube.sharpness);
    memset(cube.sharpness, HS_SHARP_INFINITE, cube.halfedges);
    return cube;
}

static void a_reference_surface_has_the_normals_of_its_limit(void **state) {
    (void)state;
    hs_error err;
    hs_mesh cube = make_sharp_cube();
    for (int limit = 0; limit < 2; limit++) {
        const hs_settings settings = {.boundary = HS_BOUNDARY_SMOOTH, .limit = limit};
        hs_reference_surface reference;
        hs_surface surface, turned;
        assert_true(hs_reference_surface_make(&reference, &cube, &settings, 2, &err));
        assert_non_null(reference.faces.normal);
        assert_true(hs_surface_of_faces(&surface, &reference.faces, identity, &err));
        float *normal = normals_of(&surface);
        assert_true(largest_distance(&surface, normal, true) < 1e-6);
        assert_true(hs_surface_turn(&turned, &surface, 30, 1, &err));
        assert_memory_equal(turned.normal, normal,
                            3 * surface.first[surface.faces] * sizeof(float));
        free(normal);
        hs_surface_free(&turned);
        hs_surface_free(&surface);
        hs_reference_surface_free(&reference);
    }
    hs_mesh_free(&cube);
}

/* The limit of a cube's corner is half way out, of its level-1 surface's corner as well. */
static void with_limit_positions_a_reference_surface_does_not_depend_on_its_level(void **state) {
    (void)state;
    hs_error err;
    hs_mesh cube = make_shape("cube", 1);
    for (int limit = 0; limit < 2; limit++) {
        const hs_settings settings = {.boundary = HS_BOUNDARY_SMOOTH, .limit = limit};
        hs_reference_surface one, three;
        assert_true(hs_reference_surface_make(&one, &cube, &settings, 1, &err));
        assert_true(hs_reference_surface_make(&three, &cube, &settings, 3, &err));
        double largest = 0;
        for (uint32_t i = 0; i < 4 * 8; i++) /* the initial vertices keep their numbers */
            largest = fmax(largest, fabs(one.position[i] - three.position[i]));
        assert_true(limit ? largest < 1e-14 : largest > 0.01);
        assert_true(!limit || fabs(fabs(one.position[0]) - 0.5) < 1e-14);
        hs_reference_surface_free(&one);
        hs_reference_surface_free(&three);
    }
    hs_mesh_free(&cube);
}

static void an_open_mesh_that_is_kept_has_no_normals_of_a_limit(void **state) {
    (void)state;
    hs_error err;
    hs_mesh grid = make_shape("grid", 2);
    hs_reference_surface surface;
    const hs_settings kept = {.boundary = HS_BOUNDARY_KEPT},
                      smooth = {.boundary = HS_BOUNDARY_SMOOTH};
    assert_true(hs_reference_surface_make(&surface, &grid, &kept, 2, &err));
    assert_null(surface.faces.normal);
    hs_reference_surface_free(&surface);
    assert_true(hs_reference_surface_make(&surface, &grid, &smooth, 2, &err));
    assert_non_null(surface.faces.normal);
    for (uint32_t i = 0; i < surface.first[surface.faces.faces]; i++)
        assert_true(fabs((double)surface.normal[3 * (size_t)i + 2] - 1) < 1e-6);
    hs_reference_surface_free(&surface);
    hs_mesh_free(&grid);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_is_round_until_its_edges_are_known_to_be_creases),
        cmocka_unit_test(gentle_angles_are_no_creases),
        cmocka_unit_test(a_reference_surface_has_the_normals_of_its_limit),
        cmocka_unit_test(with_limit_positions_a_reference_surface_does_not_depend_on_its_level),
        cmocka_unit_test(an_open_mesh_that_is_kept_has_no_normals_of_a_limit),
    };
    return cmocka_run_group_tests_name("normals of corners", tests, NULL, NULL);
}
