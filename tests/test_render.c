/* SPDX-License-Identifier: Apache-2.0
 *
 * The renderer: are the pictures right, repeatable, and the same whatever way a surface comes in?
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "golden.h"
#include "picture.h"
#include "render.h"
#include "shape.h"
#include "view.h"

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

/* --- Material --------------------------------------------------------------------------------- */

typedef struct hs_scene {
    hs_mesh mesh;
    hs_views views;
    hs_output output;
} hs_scene;

/* A shape, seen from the orbit's first viewpoint, refined by the golden model. */
static hs_scene make_scene(const char *shape, hs_settings settings) {
    hs_error err = {0};
    hs_scene scene = {0};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    assert_true(hs_shape_make(&scene.mesh, shape, 0, 1, &err));
    assert_true(hs_views_orbit(&scene.views, 1, &scene.mesh, 1, &err));
    assert_true(hs_packet_encode(&in, 0, &scene.mesh, scene.views.view[0].matrix, &settings, &err));
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_non_null(golden);
    assert_true(hs_golden_run(golden, &in, &out, &report, &err));
    assert_true(hs_output_decode(&scene.output, &out, &err));
    hs_golden_free(golden);
    hs_packet_free(&in);
    hs_packet_free(&out);
    return scene;
}

static void free_scene(hs_scene *scene) {
    hs_mesh_free(&scene->mesh);
    hs_views_free(&scene->views);
    hs_output_free(&scene->output);
}

static hs_renderer *make_renderer(uint32_t width, uint32_t height, uint32_t samples) {
    hs_error err = {0};
    hs_renderer *renderer = hs_renderer_new(width, height, samples, &err);
    if (!renderer) print_error("%s\n", err.text);
    assert_non_null(renderer);
    return renderer;
}

static hs_picture draw(hs_renderer *renderer, const hs_surface *surface, hs_style style) {
    hs_error err = {0};
    hs_picture picture;
    assert_true(hs_renderer_draw(renderer, surface, &style, &picture, &err));
    return picture;
}

/* One polygon in the plane z = 0, with as many generations as faces: 1. */
static hs_surface make_polygon(const double (*corner)[4], uint32_t sides, const float matrix[16]) {
    hs_error err = {0};
    uint32_t first[2] = {0, sides}, index[HS_MAX_SIDES];
    for (uint32_t i = 0; i < sides; i++)
        index[i] = i;
    const hs_faces faces = {
        .vertices = sides, .faces = 1, .position = corner[0], .first = first, .corner = index};
    hs_surface surface;
    assert_true(hs_surface_of_faces(&surface, &faces, matrix, &err));
    return surface;
}

/* --- Are the pictures right? ------------------------------------------------------------------ */

static void clip_space_and_object_space_give_the_same_picture(void **state) {
    (void)state;
    hs_error err = {0};
    hs_scene scene = make_scene("torus", (hs_settings){.guard = true});
    const float *matrix = scene.views.view[0].matrix;
    hs_surface clip, object;
    assert_int_equal(scene.output.faces, scene.mesh.faces);
    assert_true(hs_surface_of_output(&clip, &scene.output, matrix, &err));
    assert_true(hs_surface_of_mesh(&object, &scene.mesh, matrix, &err));
    hs_renderer *renderer = make_renderer(200, 160, 2);
    const hs_style style[2] = {{.smooth = true}, {.wires = true, .paint = HS_PAINT_DEPTH}};
    for (int i = 0; i < 2; i++) {
        hs_picture a = draw(renderer, &clip, style[i]), b = draw(renderer, &object, style[i]);
        hs_picture_difference d;
        assert_true(hs_picture_compare(&d, &a, &b, &err));
        print_message("style %d: %llu of %llu pixels differ, by at most %u of 255\n", i,
                      (unsigned long long)d.different, (unsigned long long)d.pixels, d.largest);
        assert_true(d.covered_a > 2000);
        assert_int_equal(d.visible, 0);
        assert_true(d.different * 200 < d.pixels);
        assert_true(d.maximum == 0);
        hs_picture_free(&a);
        hs_picture_free(&b);
    }
    hs_renderer_free(renderer);
    hs_surface_free(&clip);
    hs_surface_free(&object);
    free_scene(&scene);
}

/* A pixel (X, Y) is covered iff (X, Y, 1) is a combination with positive weights of the corners'
 * (x, y, w): Cramer's rule. That holds wherever the corners are, behind the eye as well. */
static bool triangle_covers(const double c[3][4], double x, double y, double *margin) {
    double weight[3];
    for (int i = 0; i < 3; i++) {
        const double *q = c[(i + 1) % 3], *r = c[(i + 2) % 3];
        weight[i] = x * (q[1] * r[3] - q[3] * r[1]) + y * (q[3] * r[0] - q[0] * r[3]) +
                    (q[0] * r[1] - q[1] * r[0]);
    }
    double volume = c[0][0] * (c[1][1] * c[2][3] - c[1][3] * c[2][1]) +
                    c[0][1] * (c[1][3] * c[2][0] - c[1][0] * c[2][3]) +
                    c[0][3] * (c[1][0] * c[2][1] - c[1][1] * c[2][0]);
    *margin = fmin(fmin(weight[0] / volume, weight[1] / volume), weight[2] / volume);
    return *margin > 0;
}

static void a_triangle_across_the_eye_plane_is_clipped_at_w(void **state) {
    (void)state;
    enum { SIZE = 128 };
    const double corner[3][4] = {{-0.6, -0.5, 0, 1}, {0.9, -0.2, 0, 1.2}, {0.4, -1.0, 0, -0.7}};
    hs_surface surface = make_polygon(corner, 3, identity);
    hs_renderer *renderer = make_renderer(SIZE, SIZE, 1);
    hs_picture picture = draw(renderer, &surface, (hs_style){0});
    uint32_t covered = 0;
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            double margin;
            bool expected = triangle_covers(corner, (x + 0.5) / SIZE * 2 - 1,
                                            1 - (y + 0.5) / SIZE * 2, &margin);
            covered += expected;
            if (fabs(margin) > 0.01)
                assert_int_equal(picture.coverage[y * SIZE + x], expected ? 255 : 0);
        }
    assert_true(covered > 1000 && covered < SIZE * SIZE - 1000);
    hs_picture_free(&picture);
    hs_renderer_free(renderer);
    hs_surface_free(&surface);
}

static void faces_that_are_not_convex_are_filled_exactly(void **state) {
    (void)state;
    enum { SIZE = 160, SIDES = 255 };
    /* A star of 255 sides, and an L whose corners' mean lies outside of it. */
    static double star[SIDES][4];
    for (int i = 0; i < SIDES; i++) {
        double r = i % 2 ? 0.9 : 0.4, angle = 2 * M_PI * i / SIDES;
        star[i][0] = r * cos(angle);
        star[i][1] = r * sin(angle);
        star[i][3] = 1;
    }
    static const double ell[6][4] = {{-0.9, -0.9, 0, 1}, {0.9, -0.9, 0, 1}, {0.9, -0.7, 0, 1},
                                     {-0.7, -0.7, 0, 1}, {-0.7, 0.9, 0, 1}, {-0.9, 0.9, 0, 1}};
    hs_renderer *renderer = make_renderer(SIZE, SIZE, 1);
    for (int shape = 0; shape < 2; shape++) {
        uint32_t sides = shape ? 6 : SIDES;
        const double(*p)[4] = shape ? ell : (const double(*)[4])star;
        hs_surface surface = make_polygon(p, sides, identity);
        uint8_t triangle[3 * HS_MAX_SIDES];
        uint32_t triangles = hs_surface_triangles(&surface, 0, triangle);
        assert_int_equal(triangles, sides - 2);
        double whole = 0, sum = 0;
        for (uint32_t i = 0; i < sides; i++)
            whole += p[i][0] * p[(i + 1) % sides][1] - p[i][1] * p[(i + 1) % sides][0];
        for (uint32_t t = 0; t < triangles; t++) {
            const double *a = p[triangle[3 * t]], *b = p[triangle[3 * t + 1]],
                         *c = p[triangle[3 * t + 2]];
            double area = (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
            assert_true(area > 0);
            sum += area;
        }
        assert_true(fabs(sum - whole) < 1e-12);
        hs_picture picture = draw(renderer, &surface, (hs_style){0});
        uint32_t covered = 0;
        for (uint32_t i = 0; i < SIZE * SIZE; i++)
            covered += picture.coverage[i] == 255;
        assert_true(fabs(covered - whole / 2 / 4 * SIZE * SIZE) < 0.03 * SIZE * SIZE);
        hs_picture_free(&picture);
        hs_surface_free(&surface);
    }
    hs_renderer_free(renderer);
}

static void wires_and_legend_leave_the_coverage_alone(void **state) {
    (void)state;
    hs_error err = {0};
    hs_scene scene = make_scene("cube", (hs_settings){.guard = true});
    hs_surface surface;
    assert_true(hs_surface_of_mesh(&surface, &scene.mesh, scene.views.view[0].matrix, &err));
    hs_renderer *renderer = make_renderer(96, 96, 3);
    hs_picture plain = draw(renderer, &surface, (hs_style){0});
    hs_picture wires = draw(renderer, &surface,
                            (hs_style){.wires = true, .legend = true, .paint = HS_PAINT_DEPTH});
    assert_memory_equal(plain.coverage, wires.coverage, 96 * 96);
    assert_false(hs_picture_equal(&plain, &wires, NULL, NULL));
    hs_picture_free(&plain);
    hs_picture_free(&wires);
    hs_renderer_free(renderer);
    hs_surface_free(&surface);
    free_scene(&scene);
}

static void the_inside_of_a_surface_has_a_colour_of_its_own(void **state) {
    (void)state;
    const double front[3][4] = {{-1, -1, 0, 1}, {1, -1, 0, 1}, {0, 1, 0, 1}};
    const double back[3][4] = {{-1, -1, 0, 1}, {0, 1, 0, 1}, {1, -1, 0, 1}};
    hs_surface a = make_polygon(front, 3, identity), b = make_polygon(back, 3, identity);
    hs_renderer *renderer = make_renderer(32, 32, 1);
    hs_picture outside = draw(renderer, &a, (hs_style){0});
    hs_picture inside = draw(renderer, &b, (hs_style){0});
    const uint8_t *p = &outside.rgb[3 * (16 * 32 + 16)], *q = &inside.rgb[3 * (16 * 32 + 16)];
    assert_true(p[0] - p[2] < 30); /* clay is nearly grey */
    assert_true(q[0] - q[2] > 60); /* terracotta is not */
    hs_picture_free(&outside);
    hs_picture_free(&inside);
    hs_renderer_free(renderer);
    hs_surface_free(&a);
    hs_surface_free(&b);
}

static void a_cube_seen_from_a_corner_has_three_front_and_three_back_faces(void **state) {
    (void)state;
    hs_error err = {0};
    hs_mesh cube;
    assert_true(hs_shape_make(&cube, "cube", 0, 1, &err));
    const double eyes[2][3] = {{9, 8, 7}, {0, 0, 9}}, at[3] = {0}, up[3] = {0, 1, 0};
    for (int i = 0; i < 2; i++) {
        hs_view view;
        hs_surface surface;
        uint32_t count[3] = {0};
        assert_true(hs_view_look(&view, eyes[i], at, up, 40, 1, 1, 100, &err));
        assert_true(hs_surface_of_mesh(&surface, &cube, view.matrix, &err));
        for (uint32_t f = 0; f < surface.faces; f++)
            count[surface.facing[f]]++;
        /* From straight ahead all but one face look away from the eye. */
        assert_int_equal(count[HS_FACING_FRONT], i ? 1 : 3);
        assert_int_equal(count[HS_FACING_BACK], i ? 5 : 3);
        hs_surface_free(&surface);
    }
    hs_mesh_free(&cube);

    /* A folded quad, one triangle to the eye and one away; a triangle seen on edge is back. */
    const double folded[4][4] = {{0, 0, 0, 1}, {0.9, 0, 0, 1}, {0.1, 0.1, 0, 1}, {0, 0.9, 0, 1}};
    const double edge_on[3][4] = {{0, 0, 0, 1}, {0.5, 0, 0.5, 1}, {0.25, 0, 0, 1}};
    hs_surface a = make_polygon(folded, 4, identity), b = make_polygon(edge_on, 3, identity);
    assert_int_equal(a.facing[0], HS_FACING_BOTH);
    assert_int_equal(b.facing[0], HS_FACING_BACK);
    hs_surface_free(&a);
    hs_surface_free(&b);
}

static void the_side_view_takes_in_all_of_the_surface(void **state) {
    (void)state;
    hs_error err = {0};
    hs_scene scene =
        make_scene("torus", (hs_settings){.front_depth = 2, .silhouette_depth = 4, .guard = true});
    hs_surface surface, side;
    assert_true(hs_surface_of_output(&surface, &scene.output, scene.views.view[0].matrix, &err));
    assert_true(hs_surface_turn(&side, &surface, 80, 1, &err));
    float widest = 0;
    for (uint32_t v = 0; v < side.vertices; v++)
        for (uint32_t k = 0; k < 3; k++) {
            const float *c = &side.clip[4 * v];
            assert_true(c[3] > 0 && fabsf(c[k]) < c[3]);
            if (k < 2) widest = fmaxf(widest, fabsf(c[k]) / c[3]);
        }
    assert_true(widest > 0.85f);
    assert_memory_equal(side.facing, surface.facing, side.faces);
    /* Nothing is turned inside out: what is seen is the outside, nearly grey. */
    hs_renderer *renderer = make_renderer(96, 96, 1);
    hs_picture picture = draw(renderer, &side, (hs_style){0});
    uint32_t covered = 0;
    for (uint32_t i = 0; i < 96 * 96; i++) {
        if (picture.coverage[i] < 255) continue;
        covered++;
        assert_true(picture.rgb[3 * i] - picture.rgb[3 * i + 2] < 30);
    }
    assert_true(covered > 1500);
    hs_picture_free(&picture);
    hs_renderer_free(renderer);
    hs_surface_free(&surface);
    hs_surface_free(&side);
    free_scene(&scene);
}

static void the_close_up_goes_to_the_deepest_visible_faces(void **state) {
    (void)state;
    /* A 16 x 16 grid; a patch of 4 x 4 faces around (0.5, -0.25) is deeper than the rest, and
     * so is one face alone, at (-0.81, -0.81). Behind it all, at (-0.75, 0.75), hides a face that
     * is deeper still: face 0. */
    enum { N = 16, GRID = (N + 1) * (N + 1) };
    static double position[GRID + 4][4] = {[GRID] = {-0.8, 0.7, 0.5, 1},
                                           [GRID + 1] = {-0.7, 0.7, 0.5, 1},
                                           [GRID + 2] = {-0.7, 0.8, 0.5, 1},
                                           [GRID + 3] = {-0.8, 0.8, 0.5, 1}};
    static uint32_t first[N * N + 2] = {0, 4};
    static uint32_t corner[N * N * 4 + 4] = {GRID, GRID + 1, GRID + 2, GRID + 3};
    static uint8_t generation[N * N + 1] = {9};
    for (uint32_t j = 0; j <= N; j++)
        for (uint32_t i = 0; i <= N; i++) {
            double *p = position[j * (N + 1) + i];
            p[0] = -1 + 2.0 * i / N;
            p[1] = -1 + 2.0 * j / N;
            p[3] = 1;
        }
    for (uint32_t j = 0; j < N; j++)
        for (uint32_t i = 0; i < N; i++) {
            uint32_t f = 1 + j * N + i, v = j * (N + 1) + i;
            const uint32_t c[4] = {v, v + 1, v + N + 2, v + N + 1};
            memcpy(&corner[4 * f], c, sizeof c);
            first[f + 1] = 4 * (f + 1);
            double x = -1 + (i + 0.5) * 2 / N, y = -1 + (j + 0.5) * 2 / N;
            bool in_patch = fabs(x - 0.5) < 0.19 && fabs(y + 0.25) < 0.19;
            bool alone = i == 1 && j == 1;
            generation[f] = in_patch || alone ? 7 : 3;
        }
    hs_error err = {0};
    const hs_faces faces = {.vertices = GRID + 4,
                            .faces = N * N + 1,
                            .position = position[0],
                            .first = first,
                            .corner = corner,
                            .generation = generation};
    hs_surface surface;
    hs_window window;
    assert_true(hs_surface_of_faces(&surface, &faces, identity, &err));
    hs_renderer *renderer = make_renderer(128, 128, 1);
    assert_true(hs_renderer_finest(renderer, &surface, 4, &window, &err));
    assert_true(fabs(window.x - 0.5) < 0.04 && fabs(window.y + 0.25) < 0.04);
    hs_renderer_free(renderer);
    hs_surface_free(&surface);
}

/* --- Are they repeatable? --------------------------------------------------------------------- */

static void the_same_picture_drawn_twice_is_equal_in_every_byte(void **state) {
    (void)state;
    hs_error err = {0};
    hs_scene scene = make_scene(
        "icosahedron", (hs_settings){.front_depth = 2, .silhouette_depth = 5, .guard = true});
    hs_view_pictures first, second;
    for (int run = 0; run < 2; run++) {
        hs_renderer *renderer = make_renderer(120, 90, 2);
        assert_true(hs_view_pictures_draw(run ? &second : &first, renderer, &scene.mesh,
                                          &scene.output, scene.views.view[0].matrix, &err));
        hs_renderer_free(renderer);
    }
    for (int i = 0; i < HS_VIEW_COUNT; i++) {
        assert_non_null(first.picture[i].rgb);
        assert_true(hs_picture_equal(&first.picture[i], &second.picture[i], NULL, NULL));
        for (int j = 0; j < i; j++) /* and no two of them show the same */
            assert_false(hs_picture_equal(&first.picture[i], &first.picture[j], NULL, NULL));
    }
    hs_view_pictures_free(&first);
    hs_view_pictures_free(&second);
    free_scene(&scene);
}

static void a_singular_matrix_leaves_out_the_side_view_and_says_why(void **state) {
    (void)state;
    hs_error err = {0};
    hs_scene scene = make_scene("cube", (hs_settings){.guard = true});
    float flat[16];
    memcpy(flat, scene.views.view[0].matrix, sizeof flat);
    memcpy(&flat[8], &flat[12], 4 * sizeof flat[0]); /* z = w */
    hs_renderer *renderer = make_renderer(64, 64, 1);
    hs_view_pictures pictures;
    assert_true(hs_view_pictures_draw(&pictures, renderer, &scene.mesh, &scene.output, flat, &err));
    assert_non_null(strstr(pictures.no_side, "singular"));
    assert_null(pictures.picture[HS_VIEW_SIDE].rgb);
    assert_non_null(pictures.picture[HS_VIEW_REFINED].rgb);
    hs_view_pictures_free(&pictures);
    hs_renderer_free(renderer);
    free_scene(&scene);
}

static void sizes_that_cannot_be_drawn_are_refused(void **state) {
    (void)state;
    const uint32_t size[5][3] = {{0, 10, 1}, {10, 0, 1}, {10, 10, 0}, {10, 10, 5}, {16384, 10, 2}};
    for (int i = 0; i < 5; i++) {
        hs_error err = {0};
        assert_null(hs_renderer_new(size[i][0], size[i][1], size[i][2], &err));
        assert_int_equal(err.code, HS_EXIT_USAGE);
    }
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clip_space_and_object_space_give_the_same_picture),
        cmocka_unit_test(a_triangle_across_the_eye_plane_is_clipped_at_w),
        cmocka_unit_test(faces_that_are_not_convex_are_filled_exactly),
        cmocka_unit_test(wires_and_legend_leave_the_coverage_alone),
        cmocka_unit_test(the_inside_of_a_surface_has_a_colour_of_its_own),
        cmocka_unit_test(a_cube_seen_from_a_corner_has_three_front_and_three_back_faces),
        cmocka_unit_test(the_side_view_takes_in_all_of_the_surface),
        cmocka_unit_test(the_close_up_goes_to_the_deepest_visible_faces),
        cmocka_unit_test(the_same_picture_drawn_twice_is_equal_in_every_byte),
        cmocka_unit_test(a_singular_matrix_leaves_out_the_side_view_and_says_why),
        cmocka_unit_test(sizes_that_cannot_be_drawn_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
