/* SPDX-License-Identifier: Apache-2.0
 *
 * Faces that nobody sees, dropped: are they those of the definition, and does all else stay?
 */
#include "cli.h"

#include <math.h>

#include "drop.h"
#include "refine.h"
#include "shape.h"
#include "view.h"

/* --- The definition, in reals ----------------------------------------------------------------- */

static const float *corner_of(const hs_output *o, uint32_t f, uint32_t i) {
    const uint32_t n = o->first[f + 1] - o->first[f];
    return o->position + 4 * (size_t)o->corner[o->first[f] + i % n];
}

static bool beyond_one_plane(const hs_output *o, uint32_t f) {
    for (int plane = 0; plane < 6; plane++) {
        bool all = true;
        for (uint32_t i = 0; i < o->first[f + 1] - o->first[f]; i++) {
            const float *p = corner_of(o, f, i);
            all = all && (plane % 2 ? p[plane / 2] < -p[3] : p[plane / 2] > p[3]);
        }
        if (all) return true;
    }
    return false;
}

/* 72 bits of the products of three binary32 do not fit into 64 of a long double, but as integers of
 * 2^(E-30) they do. */
static bool all_back(const hs_output *o, uint32_t f) {
    for (uint32_t i = 0; i < o->first[f + 1] - o->first[f]; i++) {
        __int128 q[3][3];
        for (uint32_t k = 0; k < 3; k++)
            for (int c = 0; c < 3; c++)
                q[k][c] = (__int128)ldexp((double)corner_of(o, f, i + k)[c < 2 ? c : 3],
                                          30 - o->exponent);
        if (q[0][0] * (q[1][1] * q[2][2] - q[1][2] * q[2][1]) -
                q[0][1] * (q[1][0] * q[2][2] - q[1][2] * q[2][0]) +
                q[0][2] * (q[1][0] * q[2][1] - q[1][1] * q[2][0]) >
            0)
            return false;
    }
    return true;
}

/* --- Outputs ---------------------------------------------------------------------------------- */

/* From near by, so that much is off screen, beside and behind. */
static void refine_near(hs_output *output, const char *shape) {
    hs_error err = {0};
    hs_mesh mesh;
    hs_view view;
    const hs_settings settings = {
        .front_depth = 2, .silhouette_depth = 5, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};
    if (!hs_shape_make(&mesh, shape, 0, 1, &err) ||
        !hs_view_choose(&view, 1, NULL, 5, &mesh, 1, &err))
        fail_msg("%s", err.text);
    for (int i = 0; i < 8; i++)
        view.matrix[i] *= 4;
    if (!hs_refine(output, &mesh, view.matrix, &settings, HS_DEFAULT_LIMITS, &err))
        fail_msg("%s", err.text);
    hs_mesh_free(&mesh);
}

static uint32_t seen[3]; /* off screen, back-facing, kept: in all checks */

static void check(const char *shape, hs_drop drop) {
    hs_error err = {0};
    hs_output all, some;
    hs_dropped dropped;
    refine_near(&all, shape);
    refine_near(&some, shape);
    if (!hs_output_drop(&some, &drop, &dropped, &err)) fail_msg("%s", err.text);
    uint32_t kept = 0, offscreen = 0, back = 0, triangles = 0;
    bool *used = calloc(all.vertices, 1);
    assert_non_null(used);
    for (uint32_t f = 0; f < all.faces; f++) {
        if (drop.offscreen && beyond_one_plane(&all, f)) {
            offscreen++;
            continue;
        }
        if (drop.back && all_back(&all, f)) {
            back++;
            continue;
        }
        const uint32_t n = all.first[f + 1] - all.first[f];
        assert_true(kept < some.faces);
        assert_int_equal(some.first[kept + 1] - some.first[kept], n);
        assert_int_equal(some.generation[kept], all.generation[f]);
        assert_int_equal(some.candidate[kept], all.candidate[f]);
        for (uint32_t i = 0; i < n; i++) {
            assert_memory_equal(corner_of(&some, kept, i), corner_of(&all, f, i), 16);
            const uint32_t v = all.corner[all.first[f] + i];
            assert_int_equal(some.number[some.corner[some.first[kept] + i]], all.number[v]);
            used[v] = true;
        }
        triangles += n == 3;
        kept++;
    }
    assert_int_equal(some.faces, kept);
    assert_int_equal(some.triangles, triangles);
    assert_int_equal(some.corners, some.first[kept]);
    assert_int_equal(dropped.faces, all.faces);
    assert_int_equal(dropped.offscreen, offscreen);
    assert_int_equal(dropped.back, back);
    uint32_t vertices = 0;
    for (uint32_t v = 0; v < all.vertices; v++)
        if (used[v]) assert_int_equal(some.number[vertices++], all.number[v]);
    assert_int_equal(some.vertices, vertices);
    assert_int_equal(dropped.vertices, all.vertices - vertices);
    seen[0] += offscreen;
    seen[1] += back;
    seen[2] += kept;
    free(used);
    hs_output_free(&all);
    hs_output_free(&some);
}

static void dropped_faces_are_those_of_the_definition(void **state) {
    (void)state;
    static const char *const SHAPE[] = {"hand", "spoon", "die", "random"};
    for (size_t i = 0; i < sizeof SHAPE / sizeof *SHAPE; i++)
        for (int k = 0; k < 4; k++)
            check(SHAPE[i], (hs_drop){.offscreen = k & 1, .back = k & 2});
    assert_true(seen[0] > 1000 && seen[1] > 1000 && seen[2] > 1000);
}

/* --- The commands ----------------------------------------------------------------------------- */

/* Lines of a file that begin with a letter and a space. */
static json_int_t lines(const char *name, char letter) {
    char line[2000];
    json_int_t count = 0;
    FILE *file = fopen(inside(&place, name), "r");
    assert_non_null(file);
    while (fgets(line, sizeof line, file))
        count += line[0] == letter && line[1] == ' ';
    fclose(file);
    return count;
}

static void mesh_obj_is_without_them_and_the_stream_is_not(void **state) {
    (void)state;
    const char *const run = "run shape:hand --orbit 3 --view 1 --engine golden --size 64x64 "
                            "--levels 0 ";
    char arguments[300];
    snprintf(arguments, sizeof arguments, "%s --out @/all", run);
    expect(HS_EXIT_OK, arguments, "1 view");
    snprintf(arguments, sizeof arguments, "%s --out @/some --drop offscreen,back", run);
    expect(HS_EXIT_OK, arguments, "back-facing dropped");
    json_t *root = read_json("some/run.json");
    const json_int_t faces = number_at(root, "views/0/engines/golden/faces");
    const json_int_t dropped =
        number_at(root, "views/0/dropped/back") + number_at(root, "views/0/dropped/offscreen");
    assert_true(dropped > 100);
    assert_int_equal(lines("all/view-001/mesh.obj", 'f'), faces);
    assert_int_equal(lines("some/view-001/mesh.obj", 'f'), faces - dropped);
    assert_int_equal(lines("some/view-001/mesh.obj", 'v'),
                     lines("all/view-001/mesh.obj", 'v') -
                         number_at(root, "views/0/dropped/vertices"));
    json_decref(root);
    char line[300];
    snprintf(line, sizeof line,
             "cd %s && cmp all/view-001/output.hss some/view-001/output.hss && "
             "cmp all/view-001/sheet.png some/view-001/sheet.png",
             place.path);
    assert_int_equal(system(line), 0);
}

static void convert_leaves_them_out_and_counts_them(void **state) {
    (void)state;
    expect(HS_EXIT_OK, "convert shape:hand -o @/all.obj", "faces");
    expect(HS_EXIT_OK, "convert shape:hand --drop back -o @/some.obj", "0 off screen, ");
    const char *said = strstr(output, "0 off screen, ");
    assert_int_equal(lines("some.obj", 'f'),
                     lines("all.obj", 'f') - atoi(said + strlen("0 off screen, ")));
    write_text("away.txt", "look eye 0 0 9 at 0 0 10 up 0 1 0 fov 30 near 1 far 9\n");
    expect(HS_EXIT_VIEWS, "convert shape:cube --drop offscreen --views @/away.txt -o @/no.ply",
           "--drop leaves no face: 6 are off screen");
    assert_false(exists("no.ply"));
}

static void a_list_that_is_not_understood_is_refused(void **state) {
    (void)state;
    expect(HS_EXIT_USAGE, "convert shape:cube --drop bakc -o @/no.ply", "did you mean \"back\"?");
    expect(HS_EXIT_USAGE, "convert shape:cube --drop back, -o @/no.ply", "no faces are called");
    expect(HS_EXIT_USAGE, "run shape:cube --drop back", "add --out DIR");
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, new_place, leave_place)

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dropped_faces_are_those_of_the_definition),
        TEST(mesh_obj_is_without_them_and_the_stream_is_not),
        TEST(convert_leaves_them_out_and_counts_them),
        TEST(a_list_that_is_not_understood_is_refused),
    };
    return cmocka_run_group_tests_name("drop", tests, NULL, NULL);
}
