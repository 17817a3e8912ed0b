/* SPDX-License-Identifier: Apache-2.0
 *
 * A camera path: are its frames where the file says, and is what changes from one to the next told?
 */
#include "cli.h"

#include <math.h>

#include "path.h"
#include "shape.h"
#include "view.h"

/* --- Frames ----------------------------------------------------------------------------------- */

static const hs_settings USUAL = {
    .front_depth = 3, .silhouette_depth = 6, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};

static hs_path_step add(hs_path *path, const hs_mesh *mesh, const hs_view *view,
                        hs_settings settings) {
    hs_error err = {0};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_history history = {0};
    hs_output output;
    hs_path_step step;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    hs_history_watch(&history, golden);
    if (!hs_packet_encode(&in, 0, mesh, view->matrix, &settings, &err) ||
        !hs_golden_run(golden, &in, &out, &report, &err) ||
        !hs_output_decode(&output, &out, &err) || !hs_history_check(&history, &output, &err) ||
        !hs_path_add(path, &step, &history, &output, &report, &err))
        fail_msg("%s", err.text);
    assert_int_equal(step.faces, output.faces);
    assert_int_equal(step.vertices, output.vertices);
    hs_golden_free(golden);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_output_free(&output);
    hs_history_free(&history);
    return step;
}

static hs_mesh make_mesh(const char *shape) {
    hs_error err = {0};
    hs_mesh mesh;
    if (!hs_shape_make(&mesh, shape, 0, 1, &err)) fail_msg("%s", err.text);
    return mesh;
}

static hs_view view_of(const hs_mesh *mesh, uint32_t number, uint32_t of) {
    hs_error err = {0};
    hs_view view;
    if (!hs_view_choose(&view, number, NULL, of, mesh, 1, &err)) fail_msg("%s", err.text);
    return view;
}

static void nothing_moves_in_object_space_at_one_level(void **state) {
    (void)state;
    static const char *const SHAPE[] = {"hand", "spoon", "die", "mixed", "random", "grid"};
    uint64_t compared = 0, shared = 0, changed = 0;
    for (size_t i = 0; i < sizeof SHAPE / sizeof *SHAPE; i++)
        for (int k = 0; k < 5; k++) {
            hs_mesh mesh = make_mesh(SHAPE[i]);
            hs_settings settings = USUAL;
            settings.boundary = (hs_boundary)(k % 3);
            settings.limit = k == 3;
            settings.guard = k != 4;
            hs_path *path = hs_path_new(&mesh);
            uint32_t before = 0;
            for (uint32_t frame = 0; frame < 4; frame++) {
                const hs_view view = view_of(&mesh, frame, 40);
                const hs_path_step step = add(path, &mesh, &view, settings);
                assert_true(step.done);
                assert_int_equal(step.first, frame == 0);
                if (frame) {
                    assert_int_equal(step.kept + step.gained, step.faces);
                    assert_int_equal(step.kept + step.lost, before);
                    assert_true(step.compared <= step.settled && step.compared <= step.shared);
                    changed += step.gained;
                }
                if (step.moved)
                    fail_msg("%s, frame %u: %u of %u moved", SHAPE[i], frame, step.moved,
                             step.compared);
                before = step.faces;
                compared += step.compared;
                shared += step.shared;
            }
            hs_path_free(path);
            hs_mesh_free(&mesh);
        }
    print_message("%llu of %llu shared vertices compared, %llu faces new\n",
                  (unsigned long long)compared, (unsigned long long)shared,
                  (unsigned long long)changed);
    assert_true(compared > shared / 2 && compared > 50000 && changed > 10000);
}

static void a_view_beside_itself_changes_nothing(void **state) {
    (void)state;
    hs_mesh mesh = make_mesh("hand");
    hs_path *path = hs_path_new(&mesh);
    const hs_view view = view_of(&mesh, 1, 5);
    hs_settings settings = USUAL;
    for (int guard = 0; guard < 2; guard++) {
        settings.guard = guard;
        add(path, &mesh, &view, settings);
        const hs_path_step step = add(path, &mesh, &view, settings);
        assert_int_equal(step.kept, step.faces);
        assert_int_equal(step.shared, step.vertices);
        assert_int_equal(step.compared, step.settled);
        assert_int_equal(step.moved, 0);
        /* With a guard ring all that is refined is where uniform refinement has it. */
        assert_int_equal(step.settled == step.vertices, guard);
    }
    hs_path_free(path);
    hs_mesh_free(&mesh);
}

/* Uniform runs: all faces are the same from anywhere, none is at another depth; of the vertices of
 * two steps all are among those of four, but at another level. */
static void uniform_frames_are_the_same_from_everywhere(void **state) {
    (void)state;
    hs_mesh mesh = make_mesh("hand");
    hs_path *path = hs_path_new(&mesh);
    const hs_view here = view_of(&mesh, 0, 5), there = view_of(&mesh, 2, 5);
    hs_settings settings = {.uniform = true, .uniform_depth = 2, .boundary = HS_BOUNDARY_SMOOTH};
    const uint32_t faces = add(path, &mesh, &here, settings).faces;
    hs_path_step step = add(path, &mesh, &there, settings);
    assert_int_equal(step.kept, faces);
    assert_int_equal(step.gained + step.lost, 0);
    assert_int_equal(step.compared, step.vertices);
    assert_int_equal(step.moved, 0);
    settings.uniform_depth = 4;
    step = add(path, &mesh, &here, settings);
    assert_int_equal(step.kept, 0);
    assert_int_equal(step.lost, faces);
    assert_int_equal(step.shared, mesh.vertices + mesh.faces + mesh.halfedges / 2);
    assert_int_equal(step.compared, 0);
    assert_int_equal(step.settled, step.vertices);
    /* What a view selects is a part of that, and what is settled is where that has it. */
    step = add(path, &mesh, &there,
               (hs_settings){.front_depth = 4,
                             .silhouette_depth = 4,
                             .guard = true,
                             .boundary = HS_BOUNDARY_SMOOTH});
    assert_true(step.compared > 1000);
    assert_int_equal(step.moved, 0);
    hs_path_free(path);
    hs_mesh_free(&mesh);
}

static void the_silhouette_s_share_is_that_of_its_faces(void **state) {
    (void)state;
    hs_mesh mesh = make_mesh("cube");
    const hs_view view = view_of(&mesh, 0, 5);
    hs_settings settings = USUAL;
    settings.silhouette_depth = 0;
    hs_path *path = hs_path_new(&mesh);
    hs_path_step step = add(path, &mesh, &view, settings);
    assert_true(step.reached == 0 && step.short_of == 0);
    settings.front_depth = 0;
    settings.silhouette_depth = 1;
    step = add(path, &mesh, &view, settings);
    /* Every face of a cube has a silhouette vertex: one step makes twelve quads of its edges. */
    assert_true(step.reached == 12 && step.short_of == 0);
    hs_path_free(path);
    hs_mesh_free(&mesh);
}

/* --- The file --------------------------------------------------------------------------------- */

static bool parse(hs_views *views, const char *lines, hs_error *err) {
    char text[2000];
    snprintf(text, sizeof text, "%s", lines);
    return hs_views_parse(views, "path.txt", text, strlen(text), 1, err);
}

static void frames_lie_between_two_looks(void **state) {
    (void)state;
    hs_error err = {0};
    hs_views views;
    if (!parse(&views,
               "look eye 0 0 4 at 0 0 0 up 0 1 0 fov 40 near 1 far 9\n"
               "frames 4 # a quarter\n\n"
               "look eye 2 0 0 at 0 0 0 up 0 1 0 fov 20 near 2 far 5\n"
               "matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n",
               &err))
        fail_msg("%s", err.text);
    assert_int_equal(views.count, 6);
    for (int k = 0; k <= 4; k++) {
        const double t = k / 4.0, angle = t * M_PI / 2, far = 4 - 2 * t;
        hs_view view;
        assert_true(hs_view_look(&view, (double[]){far * sin(angle), 0, far * cos(angle)},
                                 (double[]){0, 0, 0}, (double[]){0, 1, 0}, 40 - 20 * t, 1, 1 + t,
                                 9 - 4 * t, &err));
        for (int i = 0; i < 16; i++)
            assert_true(fabsf(view.matrix[i] - views.view[k].matrix[i]) < 1e-5f);
    }
    hs_views_free(&views);
}

static void expect_wrong(const char *lines, const char *what) {
    hs_error err = {0};
    hs_views views;
    assert_false(parse(&views, lines, &err));
    assert_int_equal(err.code, HS_EXIT_VIEWS);
    if (!strstr(err.text, what)) fail_msg("no \"%s\" in \"%s\"", what, err.text);
    assert_int_equal(views.count, 0);
}

#define LOOK   "look eye 0 0 4 at 0 0 0 up 0 1 0 fov 40 near 1 far 9\n"
#define BACK   "look eye 0 0 -4 at 0 0 0 up 0 1 0 fov 40 near 1 far 9\n"
#define MATRIX "matrix 1 0 0 0 0 1 0 0 0 0 1 0 0 0 0 1\n"

static void frames_that_lead_nowhere_are_refused_with_their_line(void **state) {
    (void)state;
    expect_wrong("frames 3\n" LOOK, "path.txt:1: word 1: frames lead from a look");
    expect_wrong(LOOK "frames 3\n", "path.txt:3: word 1: the file ends behind 'frames'");
    expect_wrong(LOOK "frames 3\nframes 3\n" LOOK, "path.txt:3: word 1: a second 'frames'");
    expect_wrong(LOOK "frames 3\n" MATRIX, "path.txt:3: word 1: frames lead to a look");
    expect_wrong(MATRIX "frames 3\n" LOOK, "path.txt:2: word 1: frames lead from a look");
    expect_wrong(LOOK "frames 0\n" LOOK, "path.txt:2: word 2: '0' is no number of frames");
    expect_wrong(LOOK "frames\n" LOOK, "is no number of frames");
    expect_wrong(LOOK "frames 3x\n" LOOK, "'3x' is no number of frames");
    expect_wrong(LOOK "frames 2 2\n" LOOK, "path.txt:2: word 3");
    expect_wrong(LOOK "frames 3\n" BACK, "path.txt:3: word 1: the two looks are from opposite");
}

/* --- The command ------------------------------------------------------------------------------ */

static void run_tells_what_changes(void **state) {
    (void)state;
    write_text("p.txt", "look eye 0 1 14 at 0 0 0 up 0 1 0 fov 40 near 5 far 30\nframes 2\n"
                        "look eye 2 1 14 at 0 0 0 up 0 1 0 fov 40 near 5 far 30\n");
    expect(HS_EXIT_OK, "run shape:hand --path @/p.txt --engine golden --json @/p.json",
           "at one level, 0 moved");
    json_t *root = read_json("p.json");
    assert_int_equal(number_at(root, "views_asked"), 3);
    assert_true(json_is_null(at(root, "views/0/path/faces_kept")));
    const json_int_t kept = number_at(root, "views/2/path/faces_kept");
    assert_int_equal(kept + number_at(root, "views/2/path/faces_gained"),
                     number_at(root, "views/2/engines/golden/faces"));
    assert_int_equal(kept + number_at(root, "views/2/path/faces_lost"),
                     number_at(root, "views/1/engines/golden/faces"));
    assert_int_equal(number_at(root, "views/1/path/vertices_moved"), 0);
    assert_true(number_at(root, "views/1/path/vertices_compared") > 1000);
    const double share = json_number_value(at(root, "views/1/path/silhouette_share"));
    assert_true(share > 0.3 && share <= 1);
    json_decref(root);
    expect(HS_EXIT_OK, "convert shape:cube --views @/p.txt --view 1 -o @/c.ply", "faces");
    expect(HS_EXIT_USAGE, "run shape:hand --path @/p.txt --orbit 3", "--path names its views");
    expect(HS_EXIT_USAGE, "run shape:hand --path @/p.txt --engine model", "follows golden");
    expect(HS_EXIT_OK, "mesh make cube -o @/f_0.obj", "");
    expect(HS_EXIT_USAGE, "run '@/f_%d.obj' --path @/p.txt --engine golden",
           "--path compares frames of one mesh");
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(nothing_moves_in_object_space_at_one_level),
        cmocka_unit_test(a_view_beside_itself_changes_nothing),
        cmocka_unit_test(uniform_frames_are_the_same_from_everywhere),
        cmocka_unit_test(the_silhouette_s_share_is_that_of_its_faces),
        cmocka_unit_test(frames_lie_between_two_looks),
        cmocka_unit_test(frames_that_lead_nowhere_are_refused_with_their_line),
        cmocka_unit_test_setup_teardown(run_tells_what_changes, new_place, leave_place),
    };
    return cmocka_run_group_tests_name("path", tests, NULL, NULL);
}
