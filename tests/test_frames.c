/* SPDX-License-Identifier: Apache-2.0
 *
 * A mesh that deforms: is each view that of its own file, and is what is wrong with the files said?
 */
#include "cli.h"

#include "frames.h"

/* Makes OBJ files of shapes. */
static void make(const char *shape, const char *name) {
    char arguments[200];
    snprintf(arguments, sizeof arguments, "mesh make %s -o @/%s", shape, name);
    expect(HS_EXIT_OK, arguments, "");
}

static void make_frames(void) {
    make("cube", "f_0000.obj");
    make("grid --size 5", "f_0001.obj");
    make("random --size 60", "f_0002.obj");
}

static const char *text_at(json_t *value, const char *path) {
    return json_string_value(at(value, path));
}

static void each_view_is_that_of_its_own_mesh(void **state) {
    (void)state;
    make_frames();
    expect(HS_EXIT_OK, "run '@/f_%04d.obj' --engine golden,reference,model --json @/all.json",
           "3 meshes, 0 to 2, the first of 6 faces");
    json_t *all = read_json("all.json");
    assert_int_equal(number_at(all, "mesh/frames"), 3);
    assert_int_equal(number_at(all, "views_asked"), 3);
    assert_int_equal(number_at(all, "mesh/faces"), 6);
    for (uint32_t i = 0; i < 3; i++) {
        char path[80], arguments[400];
        FILE *views = fopen(inside(&place, "one.txt"), "w");
        assert_non_null(views);
        fputs("matrix", views);
        for (int k = 0; k < 16; k++) {
            snprintf(path, sizeof path, "views/%u/matrix/%d", i, k);
            fprintf(views, " %.9g", json_number_value(at(all, path)));
        }
        fclose(views);
        snprintf(arguments, sizeof arguments,
                 "run @/f_%04u.obj --views @/one.txt --engine golden --json @/one.json", i);
        expect(HS_EXIT_OK, arguments, "1 view");
        json_t *one = read_json("one.json");
        snprintf(path, sizeof path, "views/%u/mesh/faces", i);
        assert_int_equal(number_at(all, path), number_at(one, "mesh/faces"));
        snprintf(path, sizeof path, "views/%u/mesh/source", i);
        const char *source = text_at(all, path);
        assert_string_equal(source, text_at(one, "mesh/source"));
        snprintf(path, sizeof path, "views/%u/engines/golden/faces", i);
        assert_int_equal(number_at(all, path), number_at(one, "views/0/engines/golden/faces"));
        snprintf(path, sizeof path, "views/%u/bound", i);
        assert_int_equal(number_at(all, path), number_at(one, "views/0/bound"));
        json_decref(one);
    }
    json_decref(all);
}

static void one_view_can_run_alone_and_pictures_are_its_own(void **state) {
    (void)state;
    make_frames();
    expect(HS_EXIT_OK,
           "run '@/f_%04d.obj' --engine golden --levels 1 --size 64x64 --out @/all --view 2",
           "1 view");
    assert_true(exists("all/view-002/reference.png"));
    json_t *root = read_json("all/run.json");
    json_t *sources = at(root, "views/0/mesh/source");
    assert_non_null(strstr(json_string_value(sources), "f_0002.obj"));
    /* A face a corner: Catmull-Clark's first level. */
    assert_int_equal(number_at(root, "views/0/pictures/reference_faces"),
                     number_at(root, "views/0/mesh/halfedges"));
    json_decref(root);
}

static void views_are_one_for_all_meshes_or_one_for_each(void **state) {
    (void)state;
    make_frames();
    expect(HS_EXIT_OK, "run '@/f_%04d.obj' --engine golden --orbit 3", "3 views");
    expect(HS_EXIT_VIEWS, "run '@/f_%04d.obj' --engine golden --orbit 2", "3 meshes, but 2 views");
    make("cube", "only_1.obj");
    expect(HS_EXIT_OK, "run '@/only_%d.obj' --engine golden --orbit 4", "4 views");
}

/* A mesh that walks away stays in the view of an orbit, which is around all of them. */
static void an_orbit_sees_all_meshes(void **state) {
    (void)state;
    write_text("w_1.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    write_text("w_2.obj", "v 9 0 0\nv 10 0 0\nv 9 1 0\nf 1 2 3\n");
    expect(HS_EXIT_OK, "run '@/w_%d.obj' --engine golden --front 2 --silhouette 2 --json @/w.json",
           "2 meshes, 1 to 2");
    json_t *root = read_json("w.json");
    for (int i = 0; i < 2; i++) {
        char path[80];
        snprintf(path, sizeof path, "views/%d/generations/0/selected", i);
        assert_int_equal(number_at(root, path), 1);
    }
    json_decref(root);
}

static void what_is_wrong_with_the_files_is_said_before_the_first_view(void **state) {
    (void)state;
    make_frames();
    expect(HS_EXIT_FILE, "run '@/g_%04d.obj'", "from 0 or 1, without a gap");
    expect(HS_EXIT_USAGE, "run '@/f_%d_%d.obj'", "two numbers");
    make("cube", "f_0004.obj");
    expect(HS_EXIT_FILE, "run '@/f_%04d.obj'", "there is number 4, but not 3");
    write_text("f_0003.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n");
    expect(HS_EXIT_MESH, "run '@/f_%04d.obj' --engine golden --json @/no.json", "f_0003.obj:4");
    assert_null(strstr(output, "view "));
    assert_false(exists("no.json"));
}

static void a_file_of_that_very_name_is_a_mesh(void **state) {
    (void)state;
    make("cube", "odd_%d.obj");
    make("grid", "odd_0.obj");
    expect(HS_EXIT_OK, "run '@/odd_%d.obj' --engine golden", ": 6 faces");
}

#define TEST(f) cmocka_unit_test_setup_teardown(f, new_place, leave_place)

int main(void) {
    const struct CMUnitTest tests[] = {
        TEST(each_view_is_that_of_its_own_mesh),
        TEST(one_view_can_run_alone_and_pictures_are_its_own),
        TEST(views_are_one_for_all_meshes_or_one_for_each),
        TEST(an_orbit_sees_all_meshes),
        TEST(what_is_wrong_with_the_files_is_said_before_the_first_view),
        TEST(a_file_of_that_very_name_is_a_mesh),
    };
    return cmocka_run_group_tests_name("frames", tests, NULL, NULL);
}
