/* SPDX-License-Identifier: Apache-2.0
 *
 * Refined surfaces for other programs: are places, normals, colours and faces in every space what
 * the view and the output say they are?
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "convert_scene.h"
#include "convert_write.h"
#include "refine.h"
#include "render_parts.h"
#include "shape.h"
#include "view.h"

/* --- Material --------------------------------------------------------------------------------- */

/* A shape, what golden makes of it, and the view. */
typedef struct sample {
    hs_mesh mesh;
    hs_view view;
    hs_output output;
} sample;

static const hs_settings usual = {
    .front_depth = 2, .silhouette_depth = 4, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};
static const hs_settings as_it_is = {.guard = true, .boundary = HS_BOUNDARY_SMOOTH};

/* view: NULL for the orbit's first one. */
static sample make_sample(const char *shape, uint32_t size, const hs_view *view,
                          hs_settings settings) {
    hs_error err = {0};
    sample s = {0};
    if (!hs_shape_make(&s.mesh, shape, size, 1, &err)) fail_msg("%s", err.text);
    if (view)
        s.view = *view;
    else if (!hs_view_choose(&s.view, 0, NULL, 1, &s.mesh, 1, &err))
        fail_msg("%s", err.text);
    if (!hs_refine(&s.output, &s.mesh, s.view.matrix, &settings, HS_DEFAULT_LIMITS, &err))
        fail_msg("%s", err.text);
    return s;
}

static void free_sample(sample *s) {
    hs_mesh_free(&s->mesh);
    hs_output_free(&s->output);
}

static hs_scene make_scene(const sample *s, hs_space space, bool cut, bool depths_apart) {
    hs_error err = {0};
    hs_scene scene;
    const hs_scene_options options = {space, cut, depths_apart};
    if (!hs_scene_make(&scene, &s->output, s->view.matrix, &options, &err))
        fail_msg("%s", err.text);
    return scene;
}

static void place_of(const hs_scene *scene, uint32_t point, double place[4]) {
    for (uint32_t i = 0; i < 4; i++)
        place[i] = (double)scene->place[4 * (size_t)scene->vertex[point] + i];
}

static hs_view view_from(double x, double y, double z, double at, double near) {
    hs_error err = {0};
    hs_view view;
    const double eye[3] = {x, y, z}, middle[3] = {at, 0, 0}, up[3] = {0, 1, 0};
    if (!hs_view_look(&view, eye, middle, up, 50, 1, near, 100, &err)) fail_msg("%s", err.text);
    return view;
}

/* Six times the volume that faces enclose, counted positive if they look out of it. */
static double volume_of(const hs_scene *scene, bool triangles) {
    double sum = 0;
    const uint32_t count = triangles ? scene->triangles : scene->faces;
    for (uint32_t f = 0; f < count; f++) {
        const uint32_t sides = triangles ? 3 : scene->first[f + 1] - scene->first[f];
        const uint32_t *corner =
            triangles ? &scene->triangle[3 * (size_t)f] : &scene->corner[scene->first[f]];
        double a[4], b[4], c[4], n[3];
        place_of(scene, corner[0], a);
        for (uint32_t i = 1; i + 1 < sides; i++) {
            place_of(scene, corner[i], b);
            place_of(scene, corner[i + 1], c);
            hs_cross(n, b, c);
            sum += hs_dot(a, n);
        }
    }
    return sum;
}

/* --- Places ------------------------------------------------------------------------------------
 */

/* The largest component of a shape is about 1. */
static void object_space_is_the_meshs_own(void **state) {
    (void)state;
    sample s = make_sample("mixed", 0, NULL, as_it_is);
    hs_scene scene = make_scene(&s, HS_SPACE_OBJECT, false, false);
    assert_int_equal(scene.vertices, s.mesh.vertices);
    assert_int_equal(scene.faces, s.mesh.faces);
    double largest = 0;
    for (uint32_t f = 0; f < scene.faces; f++) {
        assert_int_equal(scene.first[f + 1], s.mesh.first[f + 1]);
        for (uint32_t c = scene.first[f]; c < scene.first[f + 1]; c++) {
            const float *wanted = &s.mesh.position[4 * (size_t)s.mesh.origin[c]];
            double place[4];
            place_of(&scene, scene.corner[c], place);
            for (int i = 0; i < 4; i++)
                largest = fmax(largest, fabs(place[i] - (double)wanted[i]));
        }
    }
    print_message("largest distance from the mesh: %g\n", largest);
    assert_true(largest < 5e-6);
    hs_scene_free(&scene);
    free_sample(&s);
}

static void the_three_spaces_are_one_surface(void **state) {
    (void)state;
    sample s = make_sample("hand", 0, NULL, usual);
    hs_scene object = make_scene(&s, HS_SPACE_OBJECT, false, false);
    hs_scene ndc = make_scene(&s, HS_SPACE_NDC, false, false);
    hs_scene clip = make_scene(&s, HS_SPACE_CLIP, false, false);
    assert_int_equal(ndc.left_out, 0);
    assert_int_equal(object.vertices, s.output.vertices);
    assert_memory_equal(clip.place, s.output.position, 4 * sizeof(float) * s.output.vertices);
    double m[16], largest[2] = {0};
    for (int i = 0; i < 16; i++)
        m[i] = (double)s.view.matrix[i];
    for (uint32_t v = 0; v < object.vertices; v++) {
        double p[4], c[4];
        for (uint32_t i = 0; i < 4; i++)
            p[i] = (double)object.place[4 * (size_t)v + i];
        hs_matrix_apply(c, m, p);
        for (uint32_t i = 0; i < 4; i++) {
            const double sent = (double)s.output.position[4 * (size_t)v + i];
            largest[0] = fmax(largest[0], fabs(c[i] - sent));
            largest[1] = fmax(largest[1], fabs(sent / (double)s.output.position[4 * (size_t)v + 3] -
                                               (double)ndc.place[4 * (size_t)v + i]));
        }
    }
    print_message("through the matrix: %g; over w: %g\n", largest[0], largest[1]);
    assert_true(largest[0] < 2e-5); /* of 17 units to the eye */
    assert_true(largest[1] < 1e-7);
    hs_scene_free(&object);
    hs_scene_free(&ndc);
    hs_scene_free(&clip);
    free_sample(&s);
}

/* --- Outside ------------------------------------------------------------------------------------
 */

static void negate_row(hs_view *view, int row) {
    for (int j = 0; j < 4; j++)
        view->matrix[4 * row + j] = -view->matrix[4 * row + j];
}

/* Of each face: its mean normal along its corners' normals. The least cosine. */
static double least_agreement(const hs_scene *scene) {
    double least = 1;
    for (uint32_t t = 0; t < scene->triangles; t++) {
        double p[3][4], u[3], v[3], n[3];
        for (uint32_t i = 0; i < 3; i++)
            place_of(scene, scene->triangle[3 * (size_t)t + i], p[i]);
        for (int i = 0; i < 3; i++) {
            u[i] = p[1][i] - p[0][i];
            v[i] = p[2][i] - p[0][i];
        }
        hs_cross(n, u, v);
        if (!hs_normalize(n)) continue;
        for (uint32_t i = 0; i < 3; i++) {
            const float *own = &scene->normal[3 * (size_t)scene->triangle[3 * (size_t)t + i]];
            const double corner[3] = {(double)own[0], (double)own[1], (double)own[2]};
            assert_true(fabs(hs_dot(corner, corner) - 1) < 1e-5);
            least = fmin(least, hs_dot(corner, n));
        }
    }
    return least;
}

static void faces_and_normals_look_outwards_in_every_space(void **state) {
    (void)state;
    hs_view views[3] = {view_from(2, 3, 7, 0, 1),
                        view_from(2, 3, 7, 0, 1),
                        {{0.2F, 0, 0, 0, 0, 0.2F, 0.1F, 0, 0, 0, -0.1F, 0, 0, 0, 0, 1}}};
    negate_row(&views[1], 0); /* mirrored */
    for (int view = 0; view < 3; view++) {
        const hs_settings fine = {.uniform = true, .uniform_depth = 6, .guard = true};
        sample s = make_sample("torus", 32, &views[view], fine);
        for (int space = 0; space < 3; space++) {
            hs_scene scene = make_scene(&s, (hs_space)space, true, false);
            const double agreement = least_agreement(&scene);
            print_message("view %d, %s: volume %g, least cosine %g\n", view,
                          hs_space_name((hs_space)space), volume_of(&scene, false), agreement);
            assert_true(volume_of(&scene, false) > 0);
            assert_true(volume_of(&scene, true) > 0);
            assert_true(agreement > 0.9);
            hs_scene_free(&scene);
        }
        free_sample(&s);
    }
}

/* --- Points, colours, triangles -----------------------------------------------------------------
 */

static void vertices_are_split_at_creases_and_nowhere_else(void **state) {
    (void)state;
    sample hand = make_sample("torus", 24, NULL, usual);
    hs_scene whole = make_scene(&hand, HS_SPACE_OBJECT, false, false);
    assert_int_equal(whole.points, whole.vertices);
    sample cube = make_sample("cube", 0, NULL, as_it_is);
    /* From generation 2 on what is left of an angle of 90 degrees is a crease. */
    memset(cube.output.generation, 2, cube.output.faces);
    hs_scene sharp = make_scene(&cube, HS_SPACE_OBJECT, false, false);
    assert_int_equal(sharp.vertices, 8);
    assert_int_equal(sharp.points, 24);
    hs_scene_free(&sharp);
    hs_scene_free(&whole);
    free_sample(&cube);
    free_sample(&hand);
}

static void colours_tell_the_depth_of_refinement(void **state) {
    (void)state;
    sample s = make_sample("hand", 0, NULL, usual);
    hs_scene apart = make_scene(&s, HS_SPACE_OBJECT, true, true);
    hs_scene whole = make_scene(&s, HS_SPACE_OBJECT, true, false);
    assert_int_equal(apart.deepest, 4);
    assert_true(apart.points > whole.points);
    assert_int_equal(apart.faces, s.output.faces);
    uint32_t deeper = 0;
    for (uint32_t f = 0; f < apart.faces; f++) {
        assert_int_equal(apart.generation[f], s.output.generation[f]);
        for (uint32_t c = apart.first[f]; c < apart.first[f + 1]; c++) {
            assert_int_equal(apart.point_generation[apart.corner[c]], apart.generation[f]);
            assert_true(whole.point_generation[whole.corner[c]] >= whole.generation[f]);
            deeper += whole.point_generation[whole.corner[c]] > whole.generation[f];
        }
    }
    assert_true(deeper > 0);
    uint8_t rgb[3];
    hs_scene_color(&apart, 0, rgb);
    assert_true(rgb[0] == 250 && rgb[1] == 243 && rgb[2] == 214);
    hs_scene_color(&apart, 4, rgb);
    assert_true(rgb[0] == 50 && rgb[1] == 102 && rgb[2] == 168);
    hs_scene_free(&apart);
    hs_scene_free(&whole);
    free_sample(&s);
}

static void assert_mean(const hs_scene *scene, uint32_t face, uint32_t vertex) {
    const uint32_t sides = scene->first[face + 1] - scene->first[face];
    double mean[3] = {0};
    for (uint32_t c = scene->first[face]; c < scene->first[face + 1]; c++) {
        double place[4];
        place_of(scene, scene->corner[c], place);
        for (int i = 0; i < 3; i++)
            mean[i] += place[i] / sides;
    }
    for (uint32_t i = 0; i < 3; i++)
        assert_true(fabs(mean[i] - (double)scene->place[4 * (size_t)vertex + i]) < 1e-6);
}

/* A face of n sides is cut into n - 2 triangles, or into n around the mean of its corners. */
static void faces_are_cut_as_the_renderer_cuts_them(void **state) {
    (void)state;
    sample s = make_sample("random", 200, NULL, as_it_is);
    for (int space = HS_SPACE_OBJECT; space <= HS_SPACE_CLIP; space += 2) {
        hs_scene scene = make_scene(&s, (hs_space)space, true, false);
        uint32_t t = 0, means = 0;
        for (uint32_t f = 0; f < scene.faces; f++) {
            const uint32_t sides = scene.first[f + 1] - scene.first[f];
            uint32_t mean = 0;
            for (uint32_t i = 0; i < 3; i++) {
                const uint32_t vertex = scene.vertex[scene.triangle[3 * (size_t)t + i]];
                if (vertex >= s.output.vertices) mean = vertex;
            }
            if (mean) assert_mean(&scene, f, mean);
            assert_true(!mean || sides > 4);
            means += mean > 0;
            for (const uint32_t end = t + (mean ? sides : sides - 2); t < end; t++)
                assert_int_equal(scene.triangle_generation[t], scene.generation[f]);
        }
        assert_int_equal(t, scene.triangles);
        assert_true(means > 0);
        assert_int_equal(means, scene.vertices - s.output.vertices);
        assert_true(volume_of(&scene, true) > 0);
        hs_scene_free(&scene);
    }
    free_sample(&s);
}

/* --- Views that do not lead everywhere ----------------------------------------------------------
 */

static void expect_refusal(const sample *s, hs_space space, const char *text) {
    hs_error err = {0};
    hs_scene scene;
    const hs_scene_options options = {.space = space};
    assert_false(hs_scene_make(&scene, &s->output, s->view.matrix, &options, &err));
    assert_int_equal(err.code, HS_EXIT_VIEWS);
    if (!strstr(err.text, text)) fail_msg("%s", err.text);
    assert_null(scene.place);
}

static void a_singular_matrix_leads_to_no_object_space(void **state) {
    (void)state;
    hs_view flat = view_from(2, 3, 7, 0, 1);
    memset(&flat.matrix[8], 0, 4 * sizeof(float));
    sample s = make_sample("torus", 12, &flat, as_it_is);
    expect_refusal(&s, HS_SPACE_OBJECT, "singular");
    for (int space = HS_SPACE_NDC; space <= HS_SPACE_CLIP; space++) {
        hs_scene scene = make_scene(&s, (hs_space)space, true, false);
        for (uint32_t i = 0; i < 3 * scene.points; i++)
            assert_true(isfinite(scene.normal[i]));
        hs_scene_free(&scene);
    }
    free_sample(&s);
}

/* Large and small meshes are none the worse for it, beside the origin. */
static void units_do_not_make_a_matrix_singular(void **state) {
    (void)state;
    for (int exponent = -40; exponent <= 40; exponent += 20) {
        hs_error err = {0};
        sample s = make_sample("torus", 12, NULL, as_it_is);
        for (uint32_t i = 0; i < 4 * s.mesh.vertices; i++)
            if (i % 4 != 3) s.mesh.position[i] = ldexpf(s.mesh.position[i] + 1, exponent);
        hs_output_free(&s.output);
        assert_true(hs_view_choose(&s.view, 0, NULL, 1, &s.mesh, 1, &err));
        assert_true(hs_refine(&s.output, &s.mesh, s.view.matrix, &usual, HS_DEFAULT_LIMITS, &err));
        hs_scene scene = make_scene(&s, HS_SPACE_OBJECT, false, false);
        assert_true(volume_of(&scene, false) > 0);
        hs_scene_free(&scene);
        free_sample(&s);
    }
}

static void what_is_behind_the_eye_has_no_device_coordinates(void **state) {
    (void)state;
    const hs_view inside = view_from(0, 0.1, 0, 5, 0.01), away = view_from(9, 0, 0, 20, 1);
    sample s = make_sample("torus", 12, &inside, as_it_is);
    uint32_t behind = 0;
    for (uint32_t f = 0; f < s.output.faces; f++) {
        bool before = true;
        for (uint32_t c = s.output.first[f]; c < s.output.first[f + 1]; c++)
            before = before && s.output.position[4 * (size_t)s.output.corner[c] + 3] > 0;
        behind += !before;
    }
    assert_true(behind > 0 && behind < s.output.faces);
    hs_scene scene = make_scene(&s, HS_SPACE_NDC, true, false);
    assert_int_equal(scene.left_out, behind);
    assert_int_equal(scene.faces, s.output.faces - behind);
    for (uint32_t v = 0; v < scene.vertices; v++)
        assert_true(scene.place[4 * (size_t)v + 3] == 1);
    assert_true(scene.vertices < s.output.vertices);
    hs_scene_free(&scene);
    for (int space = HS_SPACE_OBJECT; space <= HS_SPACE_CLIP; space += 2) {
        scene = make_scene(&s, (hs_space)space, false, false);
        assert_int_equal(scene.left_out, 0);
        assert_int_equal(scene.faces, s.output.faces);
        hs_scene_free(&scene);
    }
    free_sample(&s);
    s = make_sample("torus", 12, &away, as_it_is);
    expect_refusal(&s, HS_SPACE_NDC, "behind the eye");
    free_sample(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(object_space_is_the_meshs_own),
        cmocka_unit_test(the_three_spaces_are_one_surface),
        cmocka_unit_test(faces_and_normals_look_outwards_in_every_space),
        cmocka_unit_test(vertices_are_split_at_creases_and_nowhere_else),
        cmocka_unit_test(colours_tell_the_depth_of_refinement),
        cmocka_unit_test(faces_are_cut_as_the_renderer_cuts_them),
        cmocka_unit_test(a_singular_matrix_leads_to_no_object_space),
        cmocka_unit_test(units_do_not_make_a_matrix_singular),
        cmocka_unit_test(what_is_behind_the_eye_has_no_device_coordinates),
    };
    return cmocka_run_group_tests_name("scenes for other programs", tests, NULL, NULL);
}
