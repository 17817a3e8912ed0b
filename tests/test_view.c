/* SPDX-License-Identifier: Apache-2.0
 *
 * Views: what a views file says is what the matrix is, bit for bit; what it cannot say is refused
 * with file, line and word; an orbit sees all of the mesh; a look is OpenGL's.
 */
#include <locale.h>
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "view.h"

/* Writes text to a new file and returns its name, which holds until the next call. */
static const char *file_of(const char *text, size_t size) {
    static char path[40];
    strcpy(path, "/tmp/halfstep-test-view-XXXXXX");
    int descriptor = mkstemp(path);
    assert_true(descriptor >= 0);
    assert_int_equal(write(descriptor, text, size), size);
    close(descriptor);
    return path;
}

static bool read_text(hs_views *views, const char *text, double aspect, hs_error *err) {
    const char *path = file_of(text, strlen(text));
    bool good = hs_views_read(views, path, aspect, err);
    unlink(path);
    return good;
}

/* --- Files ------------------------------------------------------------------------------------ */

static void a_views_file_gives_its_views_in_order(void **state) {
    (void)state;
    static const char text[] = "# two views\r\n"
                               "\n"
                               "   \t # blank\n"
                               "matrix 1 2 3 4 5 6 7 8  9 1e1 -0 +.5 0x1p-3 14\t15 16 # numbers\r\n"
                               "look eye 0 0 5 at 0 0 0 up 0 1 0 fov 90 near 1 far 9";
    hs_views views;
    hs_error err;
    if (!read_text(&views, text, 2, &err)) fail_msg("%s", err.text);
    assert_int_equal(views.count, 2);
    const float first[16] = {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, -0.0f, 0.5f, 0.125f, 14, 15, 16};
    assert_memory_equal(views.view[0].matrix, first, sizeof first);
    /* By hand: cot 45 degrees is 1; z' = -(10/8)(z-5) - 18/8; w' = 5 - z. */
    const float second[16] = {0.5f, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1.25f, 4, 0, 0, -1, 5};
    for (int i = 0; i < 16; i++)
        assert_true(fabsf(views.view[1].matrix[i] - second[i]) <= 1e-6f);
    hs_views_free(&views);
    assert_null(views.view);
}

static void written_views_read_back_bit_for_bit(void **state) {
    (void)state;
    enum { COUNT = 2000 };
    hs_views views = {COUNT, calloc(COUNT, sizeof *views.view)}, back;
    assert_non_null(views.view);
    uint64_t seed = 5;
    for (int i = 0; i < COUNT * 16; i++) {
        /* Any finite number: subnormal, negative zero, the largest. */
        uint32_t bits;
        do {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            bits = (uint32_t)(seed >> 32);
            if (i % 5 == 0) bits &= 0x807fffff;
            if (i % 97 == 0) bits = 0x80000000;
            if (i % 101 == 0) bits = 0x7f7fffff;
        } while ((bits >> 23 & 0xff) == 0xff);
        memcpy(&views.view[i / 16].matrix[i % 16], &bits, 4);
    }
    char path[60];
    strcpy(path, file_of("", 0));
    hs_error err;
    if (!hs_views_write(&views, path, &err)) fail_msg("%s", err.text);
    if (!hs_views_read(&back, path, 1, &err)) fail_msg("%s", err.text);
    assert_int_equal(back.count, COUNT);
    assert_memory_equal(back.view, views.view, COUNT * sizeof *views.view);
    hs_views_free(&back);
    hs_views_free(&views);
    unlink(path);
}

/* A number that lies just above the middle of two neighbours in binary32, closer to it than
 * double can tell: read through double it would round to even, which is down. */
static void matrix_numbers_are_rounded_once(void **state) {
    (void)state;
    hs_views views;
    hs_error err;
    if (!read_text(&views,
                   "matrix 1.000000059604644775390625000000000001 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", 1,
                   &err))
        fail_msg("%s", err.text);
    assert_true(views.view[0].matrix[0] == 0x1.000002p0f);
    hs_views_free(&views);
}

/* Makes a locale whose decimal point is a comma, in a new folder, and enters it. */
static bool enter_locale_with_comma(char folder[40]) {
    strcpy(folder, "/tmp/halfstep-test-view-XXXXXX");
    if (!mkdtemp(folder)) return false;
    char path[80], command[200];
    snprintf(path, sizeof path, "%s/source", folder);
    FILE *source = fopen(path, "w");
    if (!source) return false;
    fputs("LC_NUMERIC\ndecimal_point \",\"\nthousands_sep \"\"\ngrouping -1\nEND LC_NUMERIC\n",
          source);
    fclose(source);
    /* Its exit code only tells that the other categories are missing. */
    snprintf(command, sizeof command,
             "localedef -c --no-archive -i %s/source %s/comma >%s/log 2>&1", folder, folder,
             folder);
    if (system(command) == -1) return false;
    setenv("LOCPATH", folder, 1);
    return setlocale(LC_NUMERIC, "comma") != NULL;
}

static void the_locale_changes_nothing(void **state) {
    (void)state;
    char folder[40], command[80], path[60], text[8];
    bool entered = enter_locale_with_comma(folder);
    snprintf(text, sizeof text, "%.1f", 0.5);
    hs_views views = {0}, back = {0};
    hs_error err;
    bool good = read_text(&views, "matrix 0.5 0 0 0 0 0 0 0 0 0 0 0 0 0 0 0", 1, &err);
    strcpy(path, file_of("", 0));
    good = good && hs_views_write(&views, path, &err) && hs_views_read(&back, path, 1, &err);
    setlocale(LC_ALL, "C");
    unsetenv("LOCPATH");
    unlink(path);
    snprintf(command, sizeof command, "rm -r %s", folder);
    assert_int_equal(system(command), 0);
    if (!entered) {
        hs_views_free(&back);
        hs_views_free(&views);
        print_message("localedef makes no locale with a decimal comma here\n");
        skip();
    }
    assert_string_equal(text, "0,5");
    if (!good) fail_msg("%s", err.text);
    assert_true(back.view[0].matrix[0] == 0.5f);
    hs_views_free(&back);
    hs_views_free(&views);
}

static void a_malformed_line_names_file_line_and_word(void **state) {
    (void)state;
    static const struct {
        const char *line, *cause;
    } fault[] = {
        {"matrx 1", ":2: word 1: 'matrx' is no view"},
        {"matrix 1 2 3", ":2: word 5: the line ends, but m03 is due"},
        {"matrix 1 2 x 4 5 6 7 8 9 10 11 12 13 14 15 16", ":2: word 4: 'x' is not a number"},
        {"matrix 1 2,5 3 4 5 6 7 8 9 10 11 12 13 14 15 16", ":2: word 3: '2,5' is not a number"},
        {"matrix 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 1e39", ":2: word 17: '1e39' is not finite"},
        {"matrix nan 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16", ":2: word 2: 'nan' is not finite"},
        {"matrix 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16 17", ":2: word 18: '17' behind the view"},
        {"look at 0 0 5", ":2: word 2: 'at' where 'eye' is due"},
        {"look eye 0 0", ":2: word 5: the line ends, but eye z is due"},
        {"look", ":2: word 2: the line ends, but 'eye' is due"},
        {"look eye 0 0 5 at 0 0 0 up 0 1 0 fov wide near 1 far 9", ":2: word 15: 'wide' is not"},
        {"look eye 0 0 5 at 0 0 0 up 0 1 0 fov 90 near 1 far 9 10", ":2: word 20: '10' behind"},
        {"look eye 0 0 inf at 0 0 0 up 0 1 0 fov 90 near 1 far 9", ":2: word 5: 'inf' is not"},
        {"look eye 0 0 5 at 0 0 5 up 0 1 0 fov 90 near 1 far 9", ":2: word 1: eye and at are"},
        {"look eye 0 0 5 at 0 0 0 up 0 0 -3 fov 90 near 1 far 9", ":2: word 1: up lies along"},
        {"look eye 0 0 5 at 0 0 0 up 0 0 0 fov 90 near 1 far 9", ":2: word 1: up is zero"},
        {"look eye 0 0 5 at 0 0 0 up 0 1 0 fov 180 near 1 far 9", ":2: word 1: fov 180"},
        {"look eye 0 0 5 at 0 0 0 up 0 1 0 fov 90 near 9 far 9", ":2: word 1: near 9 and far 9"},
        {"look eye 0 0 5 at 0 0 0 up 0 1 0 fov 90 near 0 far 9", ":2: word 1: near 0 and far 9"},
    };
    hs_views views;
    hs_error err;
    for (size_t i = 0; i < sizeof fault / sizeof *fault; i++) {
        char text[200];
        int size = snprintf(text, sizeof text, "# comment\n%s # more\nmatrix 1\n", fault[i].line);
        const char *path = file_of(text, (size_t)size);
        bool good = hs_views_read(&views, path, 1, &err);
        unlink(path);
        if (good) fail_msg("not refused: %s", fault[i].line);
        assert_int_equal(err.code, HS_EXIT_VIEWS);
        assert_null(views.view);
        assert_int_equal(views.count, 0);
        if (strncmp(err.text, path, strlen(path)) != 0 ||
            strncmp(err.text + strlen(path), fault[i].cause, strlen(fault[i].cause)) != 0)
            fail_msg("\"%s\" gives \"%s\"", fault[i].line, err.text);
    }
    /* A zero byte, in a line that would be fine up to it. */
    const char zero[] = "matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\0 2\n";
    const char *path = file_of(zero, sizeof zero - 1);
    assert_false(hs_views_read(&views, path, 1, &err));
    unlink(path);
    assert_non_null(strstr(err.text, ":1: word 1: a zero byte"));

    assert_false(read_text(&views, "# nothing\n", 1, &err));
    assert_int_equal(err.code, HS_EXIT_VIEWS);
    assert_non_null(strstr(err.text, ":2: word 1: the file ends without a view"));
    assert_false(hs_views_read(&views, "/tmp/there/is/no/such/file", 1, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
}

/* --- Looks ------------------------------------------------------------------------------------ */

/* The eight corners of the frustum, made from eye, directions and tangents alone, are the eight
 * corners of the clip cube: that fixes the matrix but for a factor, and w is the distance. */
static void a_look_takes_the_frustum_to_the_clip_cube(void **state) {
    (void)state;
    static const double eye[3] = {3, -2, 4.5}, at[3] = {-1, 0.25, 2}, up[3] = {0.3, 0.2, 1.7};
    static const double fov = 35, aspect = 1.6, near = 0.75, far = 20;
    hs_view view;
    hs_error err;
    if (!hs_view_look(&view, eye, at, up, fov, aspect, near, far, &err)) fail_msg("%s", err.text);

    /* Directions by Gram-Schmidt; the third completes a left-handed triple (right, up, sight). */
    double d[3], u[3], along = 0, length = 0;
    for (int i = 0; i < 3; i++)
        length += (at[i] - eye[i]) * (at[i] - eye[i]);
    for (int i = 0; i < 3; i++)
        d[i] = (at[i] - eye[i]) / sqrt(length);
    for (int i = 0; i < 3; i++)
        along += up[i] * d[i];
    length = 0;
    for (int i = 0; i < 3; i++)
        u[i] = up[i] - along * d[i];
    for (int i = 0; i < 3; i++)
        length += u[i] * u[i];
    for (int i = 0; i < 3; i++)
        u[i] /= sqrt(length);
    const double s[3] = {d[1] * u[2] - d[2] * u[1], d[2] * u[0] - d[0] * u[2],
                         d[0] * u[1] - d[1] * u[0]};
    const double tangent = tan(fov / 2 / 180 * acos(-1));
    for (int corner = 0; corner < 8; corner++) {
        int x = corner & 1 ? 1 : -1, y = corner & 2 ? 1 : -1, z = corner & 4 ? 1 : -1;
        double away = z < 0 ? near : far, clip[4];
        for (int r = 0; r < 4; r++) {
            clip[r] = (double)view.matrix[4 * r + 3];
            for (int i = 0; i < 3; i++)
                clip[r] += (double)view.matrix[4 * r + i] *
                           (eye[i] + away * (d[i] + tangent * (aspect * x * s[i] + y * u[i])));
        }
        assert_true(fabs(clip[3] - away) < 2e-5);
        assert_true(fabs(clip[0] - x * away) < 2e-5);
        assert_true(fabs(clip[1] - y * away) < 2e-5);
        assert_true(fabs(clip[2] - z * away) < 2e-5);
    }
}

static void a_look_that_shows_nothing_is_refused(void **state) {
    (void)state;
    static const double eye[3] = {0, 0, 5}, at[3] = {0, 0, 0}, up[3] = {0, 1, 0};
    static const double far_eye[3] = {0, 1e300, 0};
    hs_view view;
    hs_error err;
    assert_true(hs_view_look(&view, eye, at, up, 90, 1, 1, 9, &err));
    assert_false(hs_view_look(&view, eye, at, up, 90, 1, 1, (double)NAN, &err));
    assert_false(hs_view_look(&view, eye, at, up, (double)NAN, 1, 1, 9, &err));
    assert_false(hs_view_look(&view, eye, at, up, 90, 0, 1, 9, &err));
    assert_false(hs_view_look(&view, eye, eye, up, 90, 1, 1, 9, &err));
    assert_false(hs_view_look(&view, eye, at, at, 90, 1, 1, 9, &err));
    assert_false(hs_view_look(&view, far_eye, at, eye, 90, 1, 1, 9, &err));
    assert_int_equal(err.code, HS_EXIT_VIEWS);
}

/* --- Orbits ----------------------------------------------------------------------------------- */

/* Points on an ellipsoid, as a mesh of vertices alone; w is not 1. */
static void make_points(hs_mesh *mesh, uint32_t count, const double axis[3], const double at[3]) {
    *mesh = (hs_mesh){.vertices = count, .position = calloc(count, 16)};
    assert_non_null(mesh->position);
    for (uint32_t v = 0; v < count; v++) {
        double z = 1 - 2 * (v + 0.5) / count, r = sqrt(1 - z * z), turn = 2.399963229728653 * v;
        double w = 1 + 0.25 * (v % 3);
        float *p = mesh->position + 4 * (size_t)v;
        p[0] = (float)(w * (at[0] + axis[0] * r * cos(turn)));
        p[1] = (float)(w * (at[1] + axis[1] * z));
        p[2] = (float)(w * (at[2] + axis[2] * r * sin(turn)));
        p[3] = (float)w;
    }
}

/* The transform's own arithmetic: binary32, each operation rounded. */
static void transform(float clip[4], const float m[16], const float p[4]) {
    for (int r = 0; r < 4; r++) {
        float xy = m[4 * r] * p[0] + m[4 * r + 1] * p[1];
        float zw = m[4 * r + 2] * p[2] + m[4 * r + 3] * p[3];
        clip[r] = xy + zw;
    }
}

static void an_orbit_sees_all_of_the_mesh_from_everywhere(void **state) {
    (void)state;
    static const struct {
        double axis[3], at[3];
    } body[] = {{{1, 1, 1}, {0, 0, 0}},          {{1, 1, 1}, {3e4, -2e4, 1e4}},
                {{1e-3, 5, 0.1}, {0, 0, 7}},     {{40, 1, 1}, {-5, 5, 0}},
                {{1e-9, 1e-9, 1e-9}, {0, 0, 0}}, {{1e9, 1e9, 2e9}, {0, 0, 0}},
                {{0, 0, 0}, {1, 2, 3}}};
    static const double aspect[] = {1, 0.4, 2.5};
    hs_error err;
    for (size_t b = 0; b < sizeof body / sizeof *body; b++) {
        hs_mesh mesh;
        make_points(&mesh, 2000, body[b].axis, body[b].at);
        for (size_t a = 0; a < 3; a++) {
            hs_views views;
            if (!hs_views_orbit(&views, 13, &mesh, aspect[a], &err)) fail_msg("%s", err.text);
            assert_int_equal(views.count, 13);
            double fill = 0;
            for (uint32_t i = 0; i < views.count; i++)
                for (uint32_t v = 0; v < mesh.vertices; v++) {
                    float c[4];
                    transform(c, views.view[i].matrix, mesh.position + 4 * (size_t)v);
                    if (!(c[3] > 0 && fabsf(c[0]) <= c[3] && fabsf(c[1]) <= c[3] &&
                          fabsf(c[2]) <= c[3]))
                        fail_msg("body %zu, aspect %g, view %u, vertex %u: (%g %g %g %g)", b,
                                 aspect[a], i, v, (double)c[0], (double)c[1], (double)c[2],
                                 (double)c[3]);
                    fill =
                        fmax(fill, fmax(fabs((double)(c[0] / c[3])), fabs((double)(c[1] / c[3]))));
                }
            /* A sphere at the origin just fits. */
            if (b == 0 || b == 4) assert_true(fill > 0.99);
            hs_views_free(&views);
        }
        free(mesh.position);
    }
}

static void an_orbit_begins_in_front_slightly_raised(void **state) {
    (void)state;
    hs_mesh mesh;
    make_points(&mesh, 500, (const double[3]){1, 1, 1}, (const double[3]){0, 0, 0});
    hs_views views;
    hs_error err;
    assert_true(hs_views_orbit(&views, 4, &mesh, 1, &err));
    /* w is the distance along the line of sight: its row is the direction from the eye. */
    static const double expected[4][2] = {{0, -1}, {-1, 0}, {0, 1}, {1, 0}}; /* x and z */
    for (int i = 0; i < 4; i++) {
        const float *row = views.view[i].matrix + 12;
        assert_true(fabs((double)row[0] - expected[i][0] * cos(acos(-1) / 12)) < 1e-6);
        assert_true(fabs((double)row[1] + sin(acos(-1) / 12)) < 1e-6);
        assert_true(fabs((double)row[2] - expected[i][1] * cos(acos(-1) / 12)) < 1e-6);
    }
    hs_views_free(&views);
    assert_true(hs_views_orbit(&views, 0, &mesh, 1, &err));
    assert_int_equal(views.count, 0);
    hs_views_free(&views);

    mesh.position[3] = 0;
    assert_false(hs_views_orbit(&views, 4, &mesh, 1, &err));
    assert_int_equal(err.code, HS_EXIT_VIEWS);
    assert_non_null(strstr(err.text, "infinity"));
    mesh.vertices = 0;
    assert_false(hs_views_orbit(&views, 4, &mesh, 1, &err));
    free(mesh.position);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_views_file_gives_its_views_in_order),
        cmocka_unit_test(written_views_read_back_bit_for_bit),
        cmocka_unit_test(matrix_numbers_are_rounded_once),
        cmocka_unit_test(the_locale_changes_nothing),
        cmocka_unit_test(a_malformed_line_names_file_line_and_word),
        cmocka_unit_test(a_look_takes_the_frustum_to_the_clip_cube),
        cmocka_unit_test(a_look_that_shows_nothing_is_refused),
        cmocka_unit_test(an_orbit_sees_all_of_the_mesh_from_everywhere),
        cmocka_unit_test(an_orbit_begins_in_front_slightly_raised),
    };
    return cmocka_run_group_tests_name("view", tests, NULL, NULL);
}
