/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep render: does every figure show what it says, do mesh, packet in and packet out give the
 * same picture, and what is said when there is none?
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "commands.h"
#include "figures.h"
#include "folder.h"
#include "png_file.h"
#include "run_pictures.h"
#include "shape.h"
#include "view.h"

enum { SIZE = 128 };

/* --- Material --------------------------------------------------------------------------------- */

static const hs_settings adaptive = {.front_depth = 4, .silhouette_depth = 8, .guard = true};

typedef struct scene {
    hs_mesh mesh;
    float matrix[16];
    hs_renderer *renderer;
    hs_figure_source source;
} scene;

/* The source points into the scene, which so must stay where it is. */
static void make_scene(scene *s, const char *shape, uint32_t size) {
    hs_error err = {0};
    hs_views views;
    assert_true(hs_shape_make(&s->mesh, shape, size, 1, &err));
    assert_true(hs_views_orbit(&views, 1, &s->mesh, 1, &err));
    memcpy(s->matrix, views.view[0].matrix, sizeof s->matrix);
    hs_views_free(&views);
    s->renderer = hs_renderer_new(SIZE, SIZE, 2, &err);
    assert_non_null(s->renderer);
    s->source = (hs_figure_source){.mesh = &s->mesh,
                                   .matrix = s->matrix,
                                   .settings = adaptive,
                                   .limits = HS_DEFAULT_LIMITS,
                                   .turn = HS_SIDE_DEGREES,
                                   .levels = 2,
                                   .aside = s->matrix,
                                   .views = 1};
}

static void free_scene(scene *s) {
    hs_renderer_free(s->renderer);
    hs_mesh_free(&s->mesh);
}

static hs_picture draw(const scene *s, const char *name) {
    hs_error err = {0};
    hs_picture picture;
    if (!hs_figure_draw(&picture, name, s->renderer, &s->source, &err)) fail_msg("%s", err.text);
    return picture;
}

static void assert_same(hs_picture a, hs_picture b, bool same) {
    uint32_t x = 0, y = 0;
    if (hs_picture_equal(&a, &b, &x, &y) != same)
        fail_msg("the pictures are %s; pixel (%u, %u)", same ? "not equal" : "equal", x, y);
    hs_picture_free(&a);
    hs_picture_free(&b);
}

/* --- What figures show ------------------------------------------------------------------------ */

static void every_figure_is_drawn_and_sheets_hold_several(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "torus", 0);
    s.source.title = "a title";
    for (uint32_t i = 0; hs_figure_name(i); i++) {
        const char *name = hs_figure_name(i);
        const uint32_t columns = strcmp(name, "sheet") == 0 || strcmp(name, "steps") == 0 ? 5
                                 : strcmp(name, "turntable") == 0                         ? 2
                                 : strcmp(name, "triptych") == 0 || strcmp(name, "splits") == 0 ||
                                         strcmp(name, "levels") == 0
                                     ? 3
                                     : 1;
        hs_picture picture = draw(&s, name);
        if (columns == 1)
            assert_int_equal(picture.width, SIZE);
        else
            assert_in_range(picture.width, columns * SIZE, (columns + 1) * SIZE);
        const uint32_t rows = strcmp(name, "sheet") == 0 ? 2 : 1;
        assert_in_range(picture.height, rows * SIZE, rows * SIZE + SIZE);
        assert_non_null(hs_figure_what(name));
        hs_picture_free(&picture);
    }
    s.source.columns = 2;
    hs_picture picture = draw(&s, "steps"); /* 5 in 3 rows */
    assert_in_range(picture.width, 2 * SIZE, 3 * SIZE - 1);
    assert_true(picture.height > 3 * SIZE);
    hs_picture_free(&picture);
    free_scene(&s);
}

static void single_figures_are_the_pictures_of_a_run(void **state) {
    (void)state;
    hs_error err = {0};
    scene s;
    make_scene(&s, "mixed", 0);
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_output output;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_true(hs_packet_encode(&in, 0, &s.mesh, s.matrix, &adaptive, &err));
    assert_true(hs_golden_run(golden, &in, &out, &report, &err));
    assert_true(hs_output_decode(&output, &out, &err));
    hs_view_pictures pictures;
    assert_true(hs_view_pictures_draw(&pictures, s.renderer, &s.mesh, &output, s.matrix, &err));
    for (int i = 0; i < HS_VIEW_COUNT; i++) {
        assert_same(draw(&s, hs_view_picture_file((enum hs_view_picture)i)), pictures.picture[i],
                    true);
        pictures.picture[i] = (hs_picture){0};
    }
    hs_output_free(&output);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_golden_free(golden);
    free_scene(&s);
}

static void ramp_uses_forced_depths_if_there_are_any(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "grid", 8);
    hs_picture own = draw(&s, "ramp");
    s.source.settings = (hs_settings){.guard = true};
    hs_picture plain = draw(&s, "refined-wires");
    assert_same(own, plain, false);
    for (uint32_t f = 0; f < s.mesh.faces; f++)
        s.mesh.forced[f] = f < s.mesh.faces / 2 ? 4 : 1;
    s.source.forced = true;
    hs_picture ramp = draw(&s, "ramp");
    assert_same(ramp, draw(&s, "refined-wires"), true);
    free_scene(&s);
}

/* Colour of the palette's dark end is blue: more of it in the upper half than in the lower one. */
static void ramp_is_deepest_at_the_top(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "grid", 16);
    s.source.settings.silhouette_depth = 6;
    hs_picture picture = draw(&s, "ramp");
    uint64_t blue[2] = {0, 0};
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = SIZE / 4; x < 3 * SIZE / 4; x++) {
            const uint8_t *p = &picture.rgb[3 * (y * SIZE + x)];
            if (p[2] > p[0] + 60) blue[y >= SIZE / 2]++;
        }
    print_message("blue pixels: %llu in the upper half, %llu in the lower one\n",
                  (unsigned long long)blue[0], (unsigned long long)blue[1]);
    assert_true(blue[0] > 1000);
    assert_true(blue[1] * 4 < blue[0]);
    hs_picture_free(&picture);
    free_scene(&s);
}

static void steps_begin_with_the_initial_mesh_and_go_on_finer(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "cube", 0);
    hs_picture sheet = draw(&s, "steps"), initial = draw(&s, "initial-wires");
    /* The first panel lies somewhere at the left; its pixels are the initial mesh's. */
    uint32_t found = 0;
    for (uint32_t top = 0; top + SIZE <= sheet.height && !found; top++)
        for (uint32_t left = 0; left < SIZE / 2 && !found; left++) {
            found = 1;
            for (uint32_t y = 0; y < SIZE && found; y++)
                found = memcmp(&sheet.rgb[3 * ((top + y) * sheet.width + left)],
                               &initial.rgb[3 * y * SIZE], 3 * SIZE) == 0;
        }
    assert_true(found);
    hs_picture_free(&sheet);
    hs_picture_free(&initial);
    free_scene(&s);
}

/* --- What is counted -------------------------------------------------------------------------- */

static hs_figure_counts count(scene *s, const char *name) {
    hs_error err = {0};
    hs_figure_counts counts;
    hs_picture picture;
    s->source.counts = &counts;
    if (!hs_figure_draw(&picture, name, NULL, &s->source, &err)) fail_msg("%s", err.text);
    assert_null(picture.rgb);
    s->source.counts = NULL;
    return counts;
}

/* The paper's figure 1: a triangle split in four tears three neighbours in two; in three, none. */
static void a_dyadic_split_tears_the_neighbours_and_a_face_split_does_not(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "icosahedron", 0);
    hs_figure_counts c = count(&s, "splits");
    assert_int_equal(c.panels, 3);
    assert_int_equal(c.panel[0].faces, 20);
    assert_int_equal(c.panel[1].faces, 20 + 3 + 3);
    assert_int_equal(c.panel[2].faces, 20 + 2);
    /* All are marked: no neighbour is torn, and a face split leaves quads of two triangles. */
    memset(s.mesh.forced, 7, s.mesh.faces);
    s.source.forced = true;
    c = count(&s, "splits");
    assert_int_equal(c.panel[1].faces, 4 * 20);
    assert_int_equal(c.panel[2].faces, 30);
    free_scene(&s);
    make_scene(&s, "cube", 1); /* a quad: 4 quads, and of each of 4 neighbours 3 triangles */
    c = count(&s, "splits");
    assert_int_equal(c.panel[1].faces, 4 + 4 * 3 + 1);
    assert_int_equal(c.panel[1].vertices, 8 + 4 + 1);
    assert_int_equal(c.panel[1].cut, 2 * 4 + 4 * 3 + 2);
    assert_int_equal(c.panel[2].faces, 6 + 3);
    free_scene(&s);
}

static void two_steps_have_the_faces_of_a_level(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "mixed", 0);
    const hs_figure_counts levels = count(&s, "levels"), steps = count(&s, "steps");
    for (uint32_t i = 0; i < levels.panels; i++) {
        assert_int_equal(levels.panel[i].faces, steps.panel[2 * i].faces);
        assert_int_equal(levels.panel[i].vertices, steps.panel[2 * i].vertices);
    }
    free_scene(&s);
}

static void what_is_counted_is_what_is_drawn(void **state) {
    (void)state;
    scene s;
    make_scene(&s, "torus", 0);
    for (uint32_t i = 0; hs_figure_name(i); i++) {
        const hs_figure_counts alone = count(&s, hs_figure_name(i));
        hs_figure_counts drawn;
        s.source.counts = &drawn;
        hs_picture picture = draw(&s, hs_figure_name(i));
        hs_picture_free(&picture);
        assert_int_equal(alone.panels, drawn.panels);
        assert_int_equal(alone.cycles, drawn.cycles);
        for (uint32_t p = 0; p < alone.panels; p++) {
            uint32_t faces = 0;
            for (uint32_t g = 0; g <= alone.panel[p].deepest; g++)
                faces += alone.panel[p].generation[g];
            assert_int_equal(faces, alone.panel[p].faces);
            assert_int_equal(alone.panel[p].faces, drawn.panel[p].faces);
            assert_int_equal(alone.panel[p].cut, drawn.panel[p].cut);
        }
    }
    free_scene(&s);
}

/* --- The turntable ---------------------------------------------------------------------------- */

/* Pixels that differ clearly in rectangles, SIZE wide, of two pictures. */
static uint32_t differing(const hs_picture *a, uint32_t left_a, const hs_picture *b,
                          uint32_t left_b, uint32_t height) {
    uint32_t count = 0;
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < SIZE; x++) {
            const uint8_t *p = &a->rgb[3 * ((size_t)y * a->width + left_a + x)];
            const uint8_t *q = &b->rgb[3 * ((size_t)y * b->width + left_b + x)];
            count += abs(p[0] - q[0]) > 16 || abs(p[1] - q[1]) > 16 || abs(p[2] - q[2]) > 16;
        }
    return count;
}

/* Pixels of a panel that the surface covers in one of two frames alone. */
static uint32_t covered_once(const hs_picture *a, const hs_picture *b, uint32_t left) {
    uint32_t count = 0;
    for (uint32_t y = 0; y < SIZE; y++)
        for (uint32_t x = left; x < left + SIZE; x++) {
            const size_t i = (size_t)y * a->width + x;
            count += (a->coverage[i] >= 128) != (b->coverage[i] >= 128);
        }
    return count;
}

static void the_turntables_camera_stays_and_the_refined_part_goes_with_the_eye(void **state) {
    (void)state;
    hs_error err = {0};
    scene s;
    hs_views views;
    make_scene(&s, "hand", 0);
    assert_true(hs_views_orbit(&views, 120, &s.mesh, 1, &err));
    s.source.aside = views.view[0].matrix;
    s.source.views = 120;
    const hs_figure_counts counts = count(&s, "turntable");
    assert_true(counts.cycles > counts.panel[0].faces);
    hs_picture first = draw(&s, "turntable");
    const uint32_t right = first.width - SIZE, dial = SIZE / 2; /* above it */
    /* The camera stands where the eye is: both see the same, but for the dial. */
    assert_in_range(differing(&first, 0, &first, right, dial), 0, 20);
    s.source.matrix = views.view[15].matrix;
    s.source.view = 15;
    hs_picture second = draw(&s, "turntable");
    assert_true(differing(&first, 0, &second, 0, SIZE) > 100);
    assert_true(differing(&first, right, &second, right, dial) > 20);
    const uint32_t of_eye = covered_once(&first, &second, 0),
                   of_camera = covered_once(&first, &second, right);
    print_message("covered in one alone: %u seen by the eye, %u by the camera\n", of_eye,
                  of_camera);
    assert_true(of_camera * 5 < of_eye);
    hs_picture_free(&first);
    hs_picture_free(&second);
    s.source.aside = NULL;
    assert_false(hs_figure_draw(&first, "turntable", s.renderer, &s.source, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
    hs_views_free(&views);
    free_scene(&s);
}

static void a_refinement_that_stops_early_is_told(void **state) {
    (void)state;
    scene s;
    bool stopped = false;
    make_scene(&s, "cube", 0);
    s.source.stopped = &stopped;
    hs_picture picture = draw(&s, "refined");
    hs_picture_free(&picture);
    assert_false(stopped);
    s.source.limits.vertices = 200;
    picture = draw(&s, "refined");
    hs_picture_free(&picture);
    assert_true(stopped);
    free_scene(&s);
}

static void a_view_that_golden_refuses_has_no_figure(void **state) {
    (void)state;
    hs_error err = {0};
    scene s;
    make_scene(&s, "cube", 0);
    s.matrix[5] = INFINITY;
    hs_picture picture;
    assert_false(hs_figure_draw(&picture, "refined", s.renderer, &s.source, &err));
    assert_int_equal(err.code, HS_EXIT_REFUSED);
    assert_non_null(strstr(err.text, "BAD_NUMBER"));
    assert_null(picture.rgb);
    free_scene(&s);
}

/* --- The command ------------------------------------------------------------------------------ */

/* Runs halfstep render on a line of words; they must not contain spaces. */
static int render(const char *line, hs_error *err) {
    char text[1000], *rest = text, *argv[40] = {"render", "--quiet"};
    int argc = 2;
    assert_true(strlen(line) < sizeof text);
    snprintf(text, sizeof text, "%s", line);
    for (char *word; argc < 39 && (word = strsep(&rest, " ")) != NULL;)
        argv[argc++] = word;
    *err = (hs_error){0};
    return hs_command_render(argc, argv, err);
}

static hs_picture rendered(const folder *f, const char *line) {
    hs_error err;
    char all[1000];
    hs_picture picture;
    snprintf(all, sizeof all, "%s --size %dx%d -o %s", line, SIZE, SIZE, inside(f, "a.png"));
    if (render(all, &err) != HS_EXIT_OK) fail_msg("%s: %s", line, err.text);
    assert_true(hs_png_read(&picture, inside(f, "a.png"), &err));
    assert_int_equal(remove(inside(f, "a.png")), 0);
    return picture;
}

/* in.hss, out.hss: a torus from 3 viewpoints, all.txt, at depths 2 and 6, faces 1 to 60 forced
 * to 5. */
static folder make_streams(void) {
    hs_error err = {0};
    folder f = make_folder();
    hs_mesh mesh;
    hs_views views;
    assert_true(hs_shape_make(&mesh, "torus", 0, 1, &err));
    memset(mesh.forced, 5, 60);
    assert_true(hs_views_orbit(&views, 3, &mesh, 1, &err));
    assert_true(hs_views_write(&views, inside(&f, "all.txt"), &err));
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    FILE *in_file = fopen(inside(&f, "in.hss"), "wb"),
         *out_file = fopen(inside(&f, "out.hss"), "wb");
    assert_true(golden && in_file && out_file);
    const hs_settings settings = {.front_depth = 2, .silhouette_depth = 6, .guard = true};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    for (uint32_t i = 0; i < 3; i++) {
        assert_true(hs_packet_encode(&in, i, &mesh, views.view[i].matrix, &settings, &err));
        assert_true(hs_golden_run(golden, &in, &out, &report, &err));
        assert_true(hs_frame_write(in_file, &in, "in", &err));
        assert_true(hs_frame_write(out_file, &out, "out", &err));
    }
    fclose(in_file);
    fclose(out_file);
    FILE *force = fopen(inside(&f, "force.txt"), "w");
    assert_non_null(force);
    fprintf(force, "1-60 5\n");
    fclose(force);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_golden_free(golden);
    hs_views_free(&views);
    hs_mesh_free(&mesh);
    return f;
}

static void remove_streams(const folder *f) {
    static const char *const file[] = {"in.hss", "out.hss", "all.txt", "force.txt"};
    for (int i = 0; i < 4; i++)
        remove(inside(f, file[i]));
    assert_int_equal(rmdir(f->path), 0);
}

static void mesh_packet_in_and_packet_out_give_the_same_picture(void **state) {
    (void)state;
    folder f = make_streams();
    static const char *const what[] = {"refined", "side-wires", "closeup"};
    for (int i = 0; i < 3; i++) {
        char mesh[600], in[600], out[600];
        snprintf(mesh, sizeof mesh, "shape:torus -f 2 -s 6 --force %s --views %s --view 1 -w %s",
                 inside(&f, "force.txt"), inside(&f, "all.txt"), what[i]);
        snprintf(in, sizeof in, "%s --view 1 -w %s", inside(&f, "in.hss"), what[i]);
        snprintf(out, sizeof out, "%s --view 1 --views %s -w %s", inside(&f, "out.hss"),
                 inside(&f, "all.txt"), what[i]);
        assert_same(rendered(&f, mesh), rendered(&f, in), true);
        assert_same(rendered(&f, mesh), rendered(&f, out), true);
    }
    char first[600], second[600];
    snprintf(first, sizeof first, "%s", inside(&f, "in.hss"));
    snprintf(second, sizeof second, "%s --view 1", inside(&f, "in.hss"));
    assert_same(rendered(&f, first), rendered(&f, second), false);
    remove_streams(&f);
}

static void a_packet_in_gives_the_initial_mesh_and_its_forced_depths_too(void **state) {
    (void)state;
    folder f = make_streams();
    static const char *const what[] = {"facing", "ramp"};
    for (int i = 0; i < 2; i++) {
        char mesh[600], in[600];
        snprintf(mesh, sizeof mesh, "shape:torus --force %s --views %s -w %s",
                 inside(&f, "force.txt"), inside(&f, "all.txt"), what[i]);
        snprintf(in, sizeof in, "%s -w %s", inside(&f, "in.hss"), what[i]);
        assert_same(rendered(&f, mesh), rendered(&f, in), true);
    }
    remove_streams(&f);
}

/* A line that fails: with which code, and what it says. @ stands for the test's folder. */
typedef struct failure {
    const char *line;
    int code;
    const char *says;
} failure;

static void what_cannot_be_drawn_is_said_and_leaves_no_file(void **state) {
    (void)state;
    static const failure failures[] = {
        {"shape:cube", HS_EXIT_USAGE, "-o FILE.png"},
        {"shape:cube --json @/none/x.json", HS_EXIT_FILE, "x.json"},
        {"shape:cube -o @/x.png --json @/x.png", HS_EXIT_USAGE, "another file"},
        {"shape:cube -w refind -o @/x.png", HS_EXIT_USAGE, "did you mean \"refined\""},
        {"shape:cube -w zzzzzzzz -o @/x.png", HS_EXIT_USAGE, "--help"},
        {"shape:cube --size 3x3 -o @/x.png", HS_EXIT_USAGE, "768x768"},
        {"shape:cube --size 8192x8192 -o @/x.png", HS_EXIT_USAGE, "8192x8192"},
        {"shape:cube --view 1 -o @/x.png", HS_EXIT_USAGE, "no view 1"},
        {"shape:cube -n 2 -v @/all.txt -o @/x.png", HS_EXIT_USAGE, "give one"},
        {"shape:cube -u 3 -f 2 -o @/x.png", HS_EXIT_USAGE, "--uniform"},
        {"shape:cube -o @/none/x.png", HS_EXIT_FILE, "none"},
        {"shape:cube --views @/none -o @/x.png", HS_EXIT_FILE, "none"},
        {"shape:cube --force @/all.txt -o @/x.png", HS_EXIT_MESH, "all.txt:1"},
        {"@/none.obj -o @/x.png", HS_EXIT_FILE, "none.obj"},
        {"@/none.hss -o @/x.png", HS_EXIT_FILE, "none.hss"},
        {"@/in.hss --view 7 -o @/x.png", HS_EXIT_STREAM, "no packet of view 7"},
        {"@/in.hss -f 3 -o @/x.png", HS_EXIT_USAGE, "drop"},
        {"@/in.hss --orbit 3 -o @/x.png", HS_EXIT_USAGE, "drop"},
        {"@/out.hss -u 3 -o @/x.png", HS_EXIT_USAGE, "drop"},
        {"@/out.hss -w initial -o @/x.png", HS_EXIT_USAGE, "needs the mesh"},
        {"@/out.hss -w side -o @/x.png", HS_EXIT_USAGE, "needs the view's matrix"},
    };
    folder f = make_streams();
    for (size_t i = 0; i < sizeof failures / sizeof *failures; i++) {
        hs_error err;
        const int code = render(with_folder(&f, failures[i].line), &err);
        if (code != failures[i].code || !strstr(err.text, failures[i].says))
            fail_msg("%s: exit code %d, \"%s\"", failures[i].line, code, err.text);
        assert_int_equal(count_entries(&f), 4);
    }
    remove_streams(&f);
}

/* Whatever bit of a packet in is wrong, golden notices it before the packet is unpacked. */
static void damaged_streams_are_refused(void **state) {
    (void)state;
    folder f = make_streams();
    uint8_t *bytes;
    size_t size;
    hs_error err;
    assert_true(hs_file_read(inside(&f, "in.hss"), 1 << 30, &bytes, &size, &err));
    char line[600];
    snprintf(line, sizeof line, "%s -o %s", inside(&f, "in.hss"), inside(&f, "x.png"));
    for (size_t at = 0; at < 4000; at += 61) {
        FILE *file = fopen(inside(&f, "in.hss"), "wb");
        assert_non_null(file);
        bytes[at] ^= 0x40;
        assert_int_equal(fwrite(bytes, 1, size, file), size);
        bytes[at] ^= 0x40;
        fclose(file);
        const int code = render(line, &err);
        /* The view's number, bytes 4 to 7, may be another one. */
        if (at >= 4 && at < 8) continue;
        if (code != HS_EXIT_REFUSED && code != HS_EXIT_STREAM)
            fail_msg("byte %zu: exit code %d, %s", at, code, err.text);
        assert_int_equal(count_entries(&f), 4);
    }
    free(bytes);
    remove_streams(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_figure_is_drawn_and_sheets_hold_several),
        cmocka_unit_test(single_figures_are_the_pictures_of_a_run),
        cmocka_unit_test(ramp_uses_forced_depths_if_there_are_any),
        cmocka_unit_test(ramp_is_deepest_at_the_top),
        cmocka_unit_test(steps_begin_with_the_initial_mesh_and_go_on_finer),
        cmocka_unit_test(a_dyadic_split_tears_the_neighbours_and_a_face_split_does_not),
        cmocka_unit_test(two_steps_have_the_faces_of_a_level),
        cmocka_unit_test(what_is_counted_is_what_is_drawn),
        cmocka_unit_test(the_turntables_camera_stays_and_the_refined_part_goes_with_the_eye),
        cmocka_unit_test(a_refinement_that_stops_early_is_told),
        cmocka_unit_test(a_view_that_golden_refuses_has_no_figure),
        cmocka_unit_test(mesh_packet_in_and_packet_out_give_the_same_picture),
        cmocka_unit_test(a_packet_in_gives_the_initial_mesh_and_its_forced_depths_too),
        cmocka_unit_test(what_cannot_be_drawn_is_said_and_leaves_no_file),
        cmocka_unit_test(damaged_streams_are_refused),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
