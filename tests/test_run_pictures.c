/* SPDX-License-Identifier: Apache-2.0
 *
 * The pictures of a run: is the reference surface the right one, is the refined picture near it, do
 * equal outputs give equal pictures and others not, and what lies in the folder afterwards?
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "folder.h"
#include "golden.h"
#include "png_file.h"
#include "refine.h"
#include "run_pictures.h"
#include "shape.h"
#include "view.h"

enum { SIZE = 240 };

static const hs_settings kept = {.boundary = HS_BOUNDARY_KEPT};

/* --- Material --------------------------------------------------------------------------------- */

/* A shape seen through a matrix, and what the golden model made of it. */
typedef struct scene {
    hs_mesh mesh;
    float matrix[16];
    hs_output output;
} scene;

static const hs_settings adaptive = {.front_depth = 4, .silhouette_depth = 8, .guard = true};

static hs_output run_golden(const hs_mesh *mesh, const float matrix[16],
                            const hs_settings *settings) {
    hs_error err = {0};
    hs_output output;
    assert_true(hs_refine(&output, mesh, matrix, settings, HS_DEFAULT_LIMITS, &err));
    return output;
}

static scene make_scene(const char *shape, uint32_t size, hs_settings settings) {
    hs_error err = {0};
    hs_views views;
    scene s = {0};
    assert_true(hs_shape_make(&s.mesh, shape, size, 1, &err));
    assert_true(hs_views_orbit(&views, 1, &s.mesh, 1, &err));
    memcpy(s.matrix, views.view[0].matrix, sizeof s.matrix);
    hs_views_free(&views);
    s.output = run_golden(&s.mesh, s.matrix, &settings);
    return s;
}

static void free_scene(scene *s) {
    hs_mesh_free(&s->mesh);
    hs_output_free(&s->output);
}

static hs_run_pictures *make_pictures(const hs_mesh *mesh, uint32_t levels) {
    hs_error err = {0};
    hs_run_pictures *pictures = hs_run_pictures_new(mesh, &kept, SIZE, SIZE, levels, &err);
    if (!pictures) fail_msg("%s", err.text);
    return pictures;
}

/* Removes a test's folder and the pictures in it, and says how many there were. */
static uint32_t remove_pictures(const folder *f) {
    uint32_t count = count_entries(f);
    char name[64];
    for (int i = 0; i < HS_VIEW_COUNT + 3; i++) {
        static const char *const more[3] = {"sheet", "reference", "difference"};
        const char *file = i < HS_VIEW_COUNT ? hs_view_picture_file((enum hs_view_picture)i)
                                             : more[i - HS_VIEW_COUNT];
        snprintf(name, sizeof name, "%s.png", file);
        remove(inside(f, name));
    }
    assert_int_equal(count_entries(f), 0);
    assert_int_equal(rmdir(f->path), 0);
    return count;
}

/* The pictures of a scene whose outputs are given, in a folder of their own. */
static hs_run_pictures_report view_scene(const scene *s, const hs_run_output *output,
                                         uint32_t outputs, uint32_t levels, uint32_t files) {
    hs_error err = {0};
    hs_run_pictures_report report;
    hs_run_pictures *pictures = make_pictures(&s->mesh, levels);
    folder f = make_folder();
    if (!hs_run_pictures_view(pictures, f.path, "a view", s->matrix, output, outputs, &report,
                              &err))
        fail_msg("%s", err.text);
    assert_int_equal(remove_pictures(&f), files);
    hs_run_pictures_free(pictures);
    return report;
}

/* --- The reference surface -------------------------------------------------------------------- */

static void reference_surface_of_a_closed_mesh_has_four_times_the_quads_per_level(void **state) {
    (void)state;
    hs_error err = {0};
    hs_mesh mesh;
    assert_true(hs_shape_make(&mesh, "icosahedron", 0, 1, &err));
    for (uint32_t levels = 0; levels <= 4; levels++) {
        hs_reference_surface surface;
        assert_true(hs_reference_surface_make(&surface, &mesh, &kept, levels, &err));
        assert_int_equal(surface.level, levels);
        uint32_t faces = levels == 0 ? 20 : 60u << 2 * (levels - 1);
        assert_int_equal(surface.faces.faces, faces);
        assert_int_equal(surface.faces.vertices, levels == 0 ? 12 : faces + 2);
        assert_int_equal(surface.first[faces], levels == 0 ? 60 : 4 * faces);
        assert_int_equal(surface.generation[faces - 1], 2 * levels);
        hs_reference_surface_free(&surface);
    }
    hs_mesh_free(&mesh);
}

static void reference_surface_stays_below_its_limit_and_says_its_level(void **state) {
    (void)state;
    hs_error err = {0};
    hs_mesh mesh;
    hs_reference_surface surface;
    /* 4,096 quads: 16,384, 65,536, 262,144, and then too many. */
    assert_true(hs_shape_make(&mesh, "grid", 64, 1, &err));
    assert_int_equal(mesh.faces, 4096);
    assert_true(hs_reference_surface_make(&surface, &mesh, &kept, 5, &err));
    assert_int_equal(surface.level, 3);
    assert_int_equal(surface.asked_level, 5);
    assert_true(surface.faces.faces <= HS_REFERENCE_SURFACE_FACES);
    assert_true(surface.faces.faces > 200000);
    hs_reference_surface_free(&surface);
    hs_mesh_free(&mesh);
}

static void reference_surface_of_an_open_mesh_keeps_its_boundary(void **state) {
    (void)state;
    hs_error err = {0};
    hs_mesh mesh;
    hs_reference_surface surface;
    assert_true(hs_shape_make(&mesh, "grid", 4, 1, &err));
    assert_true(hs_reference_surface_make(&surface, &mesh, &kept, 2, &err));
    assert_int_equal(surface.level, 2);
    /* The same number of faces that the pipeline sends at depth 4. */
    const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    hs_output output =
        run_golden(&mesh, identity, &(hs_settings){.uniform = true, .uniform_depth = 4});
    assert_int_equal(surface.faces.faces, output.faces);
    uint32_t triangles = 0;
    for (uint32_t f = 0; f < surface.faces.faces; f++)
        triangles += surface.first[f + 1] - surface.first[f] == 3;
    assert_true(triangles >= 16);
    assert_int_equal(triangles, output.triangles);
    hs_output_free(&output);
    hs_reference_surface_free(&surface);
    hs_mesh_free(&mesh);
}

/* --- The refined picture beside the reference surface ------------------------------------------
 */

static hs_picture_difference measure(const char *shape, hs_settings settings) {
    scene s = make_scene(shape, 0, settings);
    const hs_run_output output = {"golden", &s.output};
    hs_run_pictures_report report = view_scene(&s, &output, 1, 4, HS_VIEW_COUNT + 3);
    assert_true(report.drawn);
    assert_int_equal(report.comparisons, 1);
    assert_string_equal(report.comparison[0].a, "golden");
    assert_string_equal(report.comparison[0].b, "reference");
    assert_string_equal(report.comparison[0].what, "refined");
    assert_false(report.comparison[0].must_equal);
    assert_int_equal(report.reference_level, 4);
    hs_picture_difference d = report.comparison[0].difference;
    print_message("%s at %u/%u: %llu of %llu pixels differ, %llu visibly; silhouette mean %.3f, "
                  "maximum %.2f pixels; PSNR %.1f dB\n",
                  shape, settings.front_depth, settings.silhouette_depth,
                  (unsigned long long)d.different, (unsigned long long)d.pixels,
                  (unsigned long long)d.visible, d.mean, d.maximum, d.psnr);
    assert_int_equal(d.pixels, SIZE * SIZE);
    assert_true(d.covered_a > 5000);
    free_scene(&s);
    return d;
}

static void silhouette_of_a_refined_sphere_is_that_of_the_reference_surface(void **state) {
    (void)state;
    hs_picture_difference d = measure("icosahedron", adaptive);
    assert_true(d.mean <= 0.02);
    assert_true(d.maximum <= 1.5);
    assert_true(d.psnr >= 42);
    assert_true(d.visible * 500 < d.pixels);
}

static void silhouette_of_an_unrefined_sphere_is_not(void **state) {
    (void)state;
    hs_picture_difference d = measure("icosahedron", (hs_settings){.guard = true});
    assert_true(d.mean > 2);
    assert_true(d.maximum > 5);
}

static void uniform_refinement_as_deep_as_the_reference_gives_its_picture(void **state) {
    (void)state;
    hs_picture_difference d =
        measure("icosahedron", (hs_settings){.uniform = true, .uniform_depth = 8});
    assert_true(d.maximum <= 1);
    assert_true(d.mean <= 0.01);
    assert_int_equal(d.visible, 0);
}

static void open_mesh_is_drawn_and_compared(void **state) {
    (void)state;
    scene s = make_scene("grid", 8, adaptive);
    const hs_run_output output = {"rtl", &s.output};
    hs_run_pictures_report report = view_scene(&s, &output, 1, 4, HS_VIEW_COUNT + 3);
    assert_int_equal(report.comparisons, 1);
    assert_true(report.comparison[0].difference.maximum <= 1.5);
    assert_true(report.comparison[0].difference.psnr >= 30);
    assert_int_equal(report.no_side[0], 0);
    free_scene(&s);
}

static void without_levels_there_is_no_reference_surface(void **state) {
    (void)state;
    scene s = make_scene("cube", 0, adaptive);
    const hs_run_output output = {"rtl", &s.output};
    hs_run_pictures_report report = view_scene(&s, &output, 1, 0, HS_VIEW_COUNT + 1);
    assert_true(report.drawn);
    assert_int_equal(report.comparisons, 0);
    assert_int_equal(report.reference_faces, 0);
    free_scene(&s);
}

/* --- Engines ---------------------------------------------------------------------------------- */

static void equal_outputs_give_equal_pictures(void **state) {
    (void)state;
    scene s = make_scene("torus", 0, adaptive);
    hs_output again = run_golden(&s.mesh, s.matrix, &adaptive);
    const hs_run_output output[2] = {{"rtl", &s.output}, {"golden", &again}};
    hs_run_pictures_report report = view_scene(&s, output, 2, 2, HS_VIEW_COUNT + 3);
    assert_int_equal(report.comparisons, 3);
    for (int i = 0; i < 2; i++) {
        const hs_run_picture_comparison *c = &report.comparison[i];
        assert_string_equal(c->a, "rtl");
        assert_string_equal(c->b, "golden");
        assert_string_equal(c->what, i ? "refined-wires" : "refined");
        assert_true(c->must_equal);
        assert_int_equal(c->difference.pixels, SIZE * SIZE);
        assert_int_equal(c->difference.different, 0);
        assert_true(isinf(c->difference.psnr));
        assert_true(c->difference.covered_a > 5000);
        assert_int_equal(c->first[0], 0);
    }
    hs_output_free(&again);
    free_scene(&s);
}

/* A vertex that is seen: in a front face, in the middle of the view. */
static uint32_t visible_vertex(const hs_output *output) {
    uint32_t best = 0;
    for (uint32_t v = 1; v < output->vertices; v++) {
        const float *p = &output->position[4 * v], *q = &output->position[4 * best];
        if (p[2] / p[3] < q[2] / q[3]) best = v;
    }
    return best;
}

static void a_moved_vertex_is_found(void **state) {
    (void)state;
    scene s = make_scene("cube", 0, adaptive);
    hs_output moved = run_golden(&s.mesh, s.matrix, &adaptive);
    float *p = &moved.position[4 * visible_vertex(&moved)];
    p[0] += 0.02f * p[3]; /* 2.4 of 240 pixels */
    const hs_run_output output[2] = {{"rtl", &moved}, {"golden", &s.output}};
    hs_run_pictures_report report = view_scene(&s, output, 2, 1, HS_VIEW_COUNT + 3);
    assert_int_equal(report.comparisons, 3);
    for (int i = 0; i < 2; i++) {
        const hs_run_picture_comparison *c = &report.comparison[i];
        print_message("%llu pixels: %s\n", (unsigned long long)c->difference.different, c->first);
        assert_in_range(c->difference.different, 5, SIZE * SIZE / 10);
        char begin[64];
        snprintf(begin, sizeof begin, "%s.png, pixel (", c->what);
        assert_ptr_equal(strstr(c->first, begin), c->first);
        assert_non_null(strstr(c->first, "rtl #"));
        assert_non_null(strstr(c->first, "golden #"));
    }
    hs_output_free(&moved);
    free_scene(&s);
}

/* All corners of a face that is seen become one: a hole of a face's size. */
static void a_missing_face_is_found(void **state) {
    (void)state;
    scene s = make_scene("cube", 0, adaptive);
    hs_output less = run_golden(&s.mesh, s.matrix, &adaptive);
    const uint32_t seen = visible_vertex(&less);
    uint32_t face = 0, corner = 0;
    while (less.corner[corner] != seen)
        corner++;
    while (less.first[face + 1] <= corner)
        face++;
    for (uint32_t i = less.first[face]; i < less.first[face + 1]; i++)
        less.corner[i] = seen;
    const hs_run_output output[2] = {{"rtl", &s.output}, {"golden", &less}};
    hs_run_pictures_report report = view_scene(&s, output, 2, 0, HS_VIEW_COUNT + 1);
    for (int i = 0; i < 2; i++)
        assert_in_range(report.comparison[i].difference.different, 5, SIZE * SIZE / 10);
    hs_output_free(&less);
    free_scene(&s);
}

static void an_engine_without_faces_differs_in_every_pixel(void **state) {
    (void)state;
    scene s = make_scene("cube", 0, adaptive);
    hs_output empty = {.status = HS_STATUS_BAD_CRC};
    const hs_run_output output[2] = {{"rtl", &s.output}, {"golden", &empty}};
    hs_run_pictures_report report = view_scene(&s, output, 2, 0, HS_VIEW_COUNT + 1);
    assert_int_equal(report.comparison[0].difference.different, SIZE * SIZE);
    assert_string_equal(report.comparison[0].first, "golden sent no faces (status BAD_CRC)");
    const hs_run_output refused = {"rtl", &empty};
    report = view_scene(&s, &refused, 1, 0, 0);
    assert_false(report.drawn);
    free_scene(&s);
}

/* --- Views and folders ------------------------------------------------------------------------ */

static void singular_matrix_gives_pictures_from_the_viewpoint_alone(void **state) {
    (void)state;
    scene s = make_scene("torus", 0, adaptive);
    for (int i = 8; i < 12; i++)
        s.matrix[i] = 0; /* z = 0 for all: flat */
    hs_output_free(&s.output);
    s.output = run_golden(&s.mesh, s.matrix, &adaptive);
    assert_int_equal(s.output.status, HS_STATUS_OK);
    hs_output again = run_golden(&s.mesh, s.matrix, &adaptive);
    const hs_run_output output[2] = {{"rtl", &s.output}, {"golden", &again}};
    hs_run_pictures_report report = view_scene(&s, output, 2, 4, HS_VIEW_COUNT - 4 + 3);
    assert_true(report.drawn);
    assert_non_null(strstr(report.no_side, "singular"));
    assert_int_equal(report.comparison[0].difference.different, 0);
    assert_true(report.comparison[2].difference.maximum <= 1.5);
    print_message("singular: PSNR %.1f dB\n", report.comparison[2].difference.psnr);
    assert_true(report.comparison[2].difference.psnr >= 40); /* neither is lit */
    hs_output_free(&again);
    free_scene(&s);
}

static void missing_folder_is_an_error_that_names_the_file(void **state) {
    (void)state;
    hs_error err = {0};
    scene s = make_scene("cube", 0, adaptive);
    const hs_run_output output = {"rtl", &s.output};
    hs_run_pictures_report report;
    for (uint32_t levels = 0; levels < 2; levels++) {
        hs_run_pictures *pictures = make_pictures(&s.mesh, levels);
        folder f = make_folder();
        assert_false(hs_run_pictures_view(pictures, inside(&f, "none"), "", s.matrix, &output, 1,
                                          &report, &err));
        assert_int_equal(err.code, HS_EXIT_FILE);
        assert_non_null(strstr(err.text, inside(&f, "none")));
        assert_false(report.drawn);
        assert_int_equal(remove_pictures(&f), 0);
        hs_run_pictures_free(pictures);
    }
    free_scene(&s);
}

/* A folder that bears a picture's name cannot be replaced by a file. */
static void nothing_is_left_behind_when_one_file_cannot_be_written(void **state) {
    (void)state;
    hs_error err = {0};
    scene s = make_scene("cube", 0, adaptive);
    const hs_run_output output = {"rtl", &s.output};
    hs_run_pictures_report report;
    hs_run_pictures *pictures = make_pictures(&s.mesh, 1);
    static const char *const blocked[] = {"reference.png", "difference.png", "sheet.png",
                                          "closeup-side.png"};
    for (int i = 0; i < 4; i++) {
        folder f = make_folder();
        assert_int_equal(mkdir(inside(&f, blocked[i]), 0700), 0);
        assert_false(
            hs_run_pictures_view(pictures, f.path, "", s.matrix, &output, 1, &report, &err));
        assert_int_equal(err.code, HS_EXIT_FILE);
        assert_non_null(strstr(err.text, blocked[i]));
        assert_int_equal(count_entries(&f), 1);
        assert_int_equal(rmdir(inside(&f, blocked[i])), 0);
        assert_int_equal(rmdir(f.path), 0);
    }
    hs_run_pictures_free(pictures);
    free_scene(&s);
}

static void written_pictures_have_the_size_asked_for(void **state) {
    (void)state;
    hs_error err = {0};
    scene s = make_scene("cube", 0, adaptive);
    const hs_run_output output = {"rtl", &s.output};
    hs_run_pictures_report report;
    hs_run_pictures *pictures = hs_run_pictures_new(&s.mesh, &kept, 120, 80, 1, &err);
    assert_non_null(pictures);
    folder f = make_folder();
    assert_true(hs_run_pictures_view(pictures, f.path, "", s.matrix, &output, 1, &report, &err));
    static const char *const file[] = {"refined.png", "reference.png", "difference.png"};
    for (int i = 0; i < 3; i++) {
        hs_picture picture;
        assert_true(hs_png_read(&picture, inside(&f, file[i]), &err));
        assert_int_equal(picture.width, 120);
        assert_int_equal(picture.height, 80);
        hs_picture_free(&picture);
    }
    remove_pictures(&f);
    hs_run_pictures_free(pictures);
    assert_null(hs_run_pictures_new(&s.mesh, &kept, 20000, 20000, 1, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
    free_scene(&s);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(reference_surface_of_a_closed_mesh_has_four_times_the_quads_per_level),
        cmocka_unit_test(reference_surface_stays_below_its_limit_and_says_its_level),
        cmocka_unit_test(reference_surface_of_an_open_mesh_keeps_its_boundary),
        cmocka_unit_test(silhouette_of_a_refined_sphere_is_that_of_the_reference_surface),
        cmocka_unit_test(silhouette_of_an_unrefined_sphere_is_not),
        cmocka_unit_test(uniform_refinement_as_deep_as_the_reference_gives_its_picture),
        cmocka_unit_test(open_mesh_is_drawn_and_compared),
        cmocka_unit_test(without_levels_there_is_no_reference_surface),
        cmocka_unit_test(equal_outputs_give_equal_pictures),
        cmocka_unit_test(a_moved_vertex_is_found),
        cmocka_unit_test(a_missing_face_is_found),
        cmocka_unit_test(an_engine_without_faces_differs_in_every_pixel),
        cmocka_unit_test(singular_matrix_gives_pictures_from_the_viewpoint_alone),
        cmocka_unit_test(missing_folder_is_an_error_that_names_the_file),
        cmocka_unit_test(nothing_is_left_behind_when_one_file_cannot_be_written),
        cmocka_unit_test(written_pictures_have_the_size_asked_for),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
