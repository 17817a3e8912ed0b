/* SPDX-License-Identifier: Apache-2.0
 *
 * OBJ text in and out: what is read, what is refused and how, and that writing loses no bit.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#include "folder.h"
#include "obj.h"

/* --- Help ------------------------------------------------------------------------------------ */

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static hs_mesh parse(const char *text, hs_obj_notes *notes) {
    hs_mesh mesh;
    hs_error err = {0};
    /* A copy of the exact size, so that the sanitizers see a read behind its end. */
    size_t size = strlen(text);
    char *exact = malloc(size + !size);
    memcpy(exact, text, size);
    bool good = hs_obj_parse(&mesh, "a.obj", exact, size, false, notes, &err);
    free(exact);
    if (!good) fail_msg("%s\nin:\n%s", err.text, text);
    return mesh;
}

static void assert_corners(const char *text, uint32_t count, const uint32_t *corner) {
    hs_mesh mesh = parse(text, NULL);
    assert_int_equal(mesh.halfedges, count);
    assert_memory_equal(mesh.origin, corner, count * sizeof *corner);
    hs_mesh_free(&mesh);
}
#define CORNERS(text, ...)                                                                         \
    assert_corners(text, sizeof((uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t),                     \
                   (uint32_t[]){__VA_ARGS__})

/* --- What is read ---------------------------------------------------------------------------- */

static void every_form_of_a_corner_names_its_vertex(void **state) {
    (void)state;
    CORNERS(TRIANGLE "f 1 2 3\n", 0, 1, 2);
    CORNERS(TRIANGLE "vt 0 0\nf 1/1 2/1 3/1\n", 0, 1, 2);
    CORNERS(TRIANGLE "vn 0 0 1\nf 1//1 2//1 3//1\n", 0, 1, 2);
    CORNERS(TRIANGLE "f 1/7/9 2/8/-1 3/-9/9\n", 0, 1, 2);
    CORNERS(TRIANGLE "f 1/ 2/ 3//\n", 0, 1, 2);
    CORNERS(TRIANGLE "f -3 -2 -1\n", 0, 1, 2);
    CORNERS(TRIANGLE "f -3/-1 2 -1//1\n", 0, 1, 2);
    CORNERS(TRIANGLE "f 01 002 3\n", 0, 1, 2);
}

static void negative_indices_count_back_from_their_own_line(void **state) {
    (void)state;
    CORNERS(TRIANGLE "f -3 -2 -1\n" TRIANGLE "f -1 -2 -3\n", 0, 1, 2, 5, 4, 3);
}

static void faces_may_come_before_their_vertices(void **state) {
    (void)state;
    CORNERS("f 1 2 3\n" TRIANGLE, 0, 1, 2);
}

static void polygons_of_any_size_keep_their_order(void **state) {
    (void)state;
    CORNERS(TRIANGLE "v 1 1 0\nv 2 2 2\nf 5 3 1 2 4\n", 4, 2, 0, 1, 3);
}

static void line_ends_blanks_and_comments_do_not_matter(void **state) {
    (void)state;
    CORNERS("v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n", 0, 1, 2);
    CORNERS("v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 3", 0, 1, 2);
    CORNERS(TRIANGLE "f 1 2 3", 0, 1, 2);
    CORNERS("\n\n" TRIANGLE "\n  \t \n\tf\t1 \t 2  3  \n\n", 0, 1, 2);
    CORNERS("# a comment\n" TRIANGLE "f 1 2 3 # 4 5\n#f 1 2 3\n", 0, 1, 2);
    CORNERS("v 0 0 0#c\nv 1 0 0\nv 0 1 0\nf 1 2 3#4", 0, 1, 2);
    CORNERS("\xef\xbb\xbfv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", 0, 1, 2);
}

static void a_backslash_continues_a_line(void **state) {
    (void)state;
    CORNERS(TRIANGLE "f 1 \\\n2\\\n 3\n", 0, 1, 2);
    CORNERS(TRIANGLE "f 1\\\r\n2 \\\r\n3\r\n", 0, 1, 2);
    CORNERS(TRIANGLE "f\\\n1 2 3", 0, 1, 2);
    CORNERS(TRIANGLE "# C:\\meshes\\\nf 1 2 3", 0, 1, 2);
}

static void objects_and_groups_become_one_mesh(void **state) {
    (void)state;
    hs_obj_notes notes;
    hs_mesh mesh = parse("mtllib a.mtl\no one\ng x y\ns off\nusemtl red\n" TRIANGLE "f 1 2 3\n"
                         "o two\ns 1\nvt 0 0\nvn 0 0 1\nvp 1\n" TRIANGLE "f 4 5 6\nl 1 2\np 1\n",
                         &notes);
    assert_int_equal(mesh.vertices, 6);
    assert_int_equal(mesh.faces, 2);
    assert_int_equal(notes.unknown.count, 0);
    assert_int_equal(notes.tags.count, 0);
    assert_int_equal(notes.unused.count, 0);
    char text[200];
    assert_false(hs_obj_note_text(&notes, "a.obj", 0, text, sizeof text));
    hs_mesh_free(&mesh);
}

static void numbers_are_what_strtof_reads(void **state) {
    (void)state;
    static const char *const words[] = {"0.1",
                                        "-0",
                                        "1e-45",
                                        "1e-46",
                                        "3.4028235e38",
                                        "16777217",
                                        ".5",
                                        "5.",
                                        "+2",
                                        "1E+3",
                                        "0x1p3",
                                        "1e-999",
                                        "000.25",
                                        "1e-40",
                                        "1.1754944e-38",
                                        "0.30000001192092896"};
    for (size_t i = 0; i < sizeof words / sizeof *words; i++) {
        char text[200];
        snprintf(text, sizeof text, "v %s 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", words[i]);
        hs_mesh mesh = parse(text, NULL);
        float wanted = strtof(words[i], NULL);
        assert_memory_equal(mesh.position, &wanted, sizeof wanted);
        hs_mesh_free(&mesh);
    }
}

static void the_fourth_number_is_w_unless_there_are_more(void **state) {
    (void)state;
    hs_mesh mesh = parse("v 1 2 3\nv 1 2 3 4\nv 1 2 3 .5 .5\nv 1 2 3 .5 .5 .5\nv 1 2 3 0\n"
                         "f 1 2 3 4 5\n",
                         NULL);
    static const float w[5] = {1, 4, 1, 1, 0};
    for (uint32_t v = 0; v < 5; v++) {
        float wanted[4] = {1, 2, 3, w[v]};
        assert_memory_equal(mesh.position + 4 * v, wanted, sizeof wanted);
    }
    hs_mesh_free(&mesh);
}

/* --- Tags ------------------------------------------------------------------------------------- */

#define STRIP "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 0 1 0\nv 1 1 0\nv 2 1 0\nf 1 2 5 4\nf 2 3 6 5\n"

/* Of the edge from v to w, from 0. */
static uint8_t sharpness_between(const hs_mesh *m, uint32_t v, uint32_t w) {
    for (uint32_t h = 0; h < m->halfedges; h++)
        if (m->origin[h] == v && m->origin[hs_next(m, h)] == w) {
            if (m->twin[h] != (uint32_t)HS_BORDER)
                assert_int_equal(m->sharpness[h], m->sharpness[m->twin[h]]);
            return m->sharpness[h];
        }
    fail_msg("no half-edge from %u to %u", v, w);
    return 0;
}

static void tags_make_edges_and_vertices_sharp(void **state) {
    (void)state;
    hs_obj_notes notes;
    hs_mesh m = parse("t crease 2/1/0 4 1 3\n" STRIP "t crease 3/2/0 0 1 2 2.0 99\n"
                      "t corner 2/1/0 0 4 1e30\nt crease 3/1/0 5 4 3 inf\n",
                      &notes);
    assert_int_equal(sharpness_between(&m, 1, 4), 3);
    assert_int_equal(sharpness_between(&m, 0, 1), 2);
    assert_int_equal(sharpness_between(&m, 1, 2), HS_SHARP_INFINITE);
    assert_int_equal(sharpness_between(&m, 4, 3), HS_SHARP_INFINITE);
    assert_int_equal(sharpness_between(&m, 5, 4), HS_SHARP_INFINITE);
    assert_int_equal(sharpness_between(&m, 2, 5), 0);
    for (uint32_t v = 0; v < 6; v++)
        assert_int_equal(m.vertex_sharpness[v], v == 0 || v == 4 ? HS_SHARP_INFINITE : 0);
    assert_int_equal(notes.repeated.count, 0);
    assert_int_equal(notes.tags.count, 0);
    hs_mesh_free(&m);
}

static void of_repeated_tags_the_last_one_counts(void **state) {
    (void)state;
    hs_obj_notes notes;
    hs_mesh m = parse(STRIP "t crease 2/1/0 1 4 3\nt corner 1/1/0 2 4\nt crease 2/1/0 4 1 5\n"
                            "t corner 1/1/0 2 0\nt crease 2/1/0 1 4 2\n",
                      &notes);
    assert_int_equal(sharpness_between(&m, 1, 4), 2);
    assert_int_equal(m.vertex_sharpness[2], 0);
    assert_int_equal(notes.repeated.count, 3);
    assert_int_equal(notes.repeated.line, 11);
    hs_mesh_free(&m);
}

static void fractions_are_refused_or_rounded_halves_up(void **state) {
    (void)state;
    static const struct {
        const char *text;
        uint8_t rounded;
    } sample[] = {{"0.4", 0}, {"0.5", 1}, {"1.49", 1}, {"2.5", 3}, {"9.4", 9}, {"9.5", 15}};
    for (size_t i = 0; i < sizeof sample / sizeof *sample; i++) {
        char text[300];
        hs_mesh m;
        hs_error err;
        snprintf(text, sizeof text, STRIP "t crease 2/1/0 1 4 %s\n", sample[i].text);
        assert_false(hs_obj_parse(&m, "a.obj", text, strlen(text), false, NULL, &err));
        assert_int_equal(err.code, HS_EXIT_MESH);
        assert_non_null(strstr(err.text, "a.obj:9: the crease 1-4"));
        assert_non_null(strstr(err.text, "--round-sharpness"));
        assert_true(hs_obj_parse(&m, "a.obj", text, strlen(text), true, NULL, &err));
        assert_int_equal(sharpness_between(&m, 1, 4), sample[i].rounded);
        hs_mesh_free(&m);
    }
}

static void bad_tags_are_refused_at_their_line(void **state) {
    (void)state;
    static const struct {
        const char *tag, *says;
    } bad[] = {
        {"crease 2/1/0 0 4 1", "no edge joins"},
        {"crease 2/1/0 0 9 1", "vertex 9, but the last one is 6"},
        {"crease 2/1/0 0 4294967297 1", "vertex"},
        {"corner 1/1/0 7 1", "vertex 7, but the last one is 6"},
        {"corner 1/1/0 6 1", "no face uses"},
        {"crease 2/1/0 1 4 -1", "sharpness -1"},
        {"crease 2/1/0 1 4 nan", "sharpness nan"},
        {"corner 1/1/0 1 -0.5", "sharpness -0.5"},
        {"crease 2/1/0 1 4", "a sharpness is missing"},
        {"crease 2/1/0 1", "a vertex number is missing"},
        {"crease 2/1/0 1 -4 1", "a vertex number is missing"},
        {"crease 2/1/0 1 1 1", "an edge needs two"},
        {"crease 1/1/0 1 1", "do not fit"},
        {"crease 3/3/0 0 1 2 1 1 1", "do not fit"},
        {"corner 0/1/0 1", "do not fit"},
        {"crease 2/1 1 4 1", "not of the form"},
        {"crease 2/1/0 1 4 1 1", "more words"},
        {"crease 2/1/0 1 4 x", "a sharpness is missing"},
        {"", "no type"},
    };
    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) {
        char text[300];
        hs_mesh m;
        hs_error err;
        snprintf(text, sizeof text, STRIP "v 9 9 9\nt %s\n", bad[i].tag);
        if (hs_obj_parse(&m, "a.obj", text, strlen(text), true, NULL, &err))
            fail_msg("'t %s' was not refused", bad[i].tag);
        assert_int_equal(err.code, HS_EXIT_MESH);
        if (strncmp(err.text, "a.obj:10: ", 10) != 0 || !strstr(err.text, bad[i].says))
            fail_msg("'t %s': '%s' does not say '%s'", bad[i].tag, err.text, bad[i].says);
    }
}

static void what_is_passed_over_is_noted_with_its_first_line(void **state) {
    (void)state;
    hs_obj_notes notes;
    hs_mesh mesh = parse("v 9 9 9\n" TRIANGLE "v 8 8 8\ncurv2 \\\n1\nt smoothtriangles 1/0/0 2\n"
                         "f 2 3 4\nt hole 1/0/0 2\nb\x01gus 1\n",
                         &notes);
    assert_int_equal(mesh.vertices, 3);
    assert_int_equal(notes.unused.count, 2);
    assert_int_equal(notes.unused.line, 1);
    assert_int_equal(notes.tags.count, 2);
    assert_int_equal(notes.tags.line, 8);
    assert_int_equal(notes.unknown.count, 2);
    assert_int_equal(notes.unknown.line, 6);
    char text[200];
    assert_true(hs_obj_note_text(&notes, "a.obj", 0, text, sizeof text));
    assert_string_equal(text, "a.obj:1: 2 vertices that no face uses were dropped");
    assert_true(hs_obj_note_text(&notes, "a.obj", 1, text, sizeof text));
    assert_string_equal(
        text, "a.obj:8: 2 tags ('t' lines) are neither crease nor corner, and were ignored");
    assert_true(hs_obj_note_text(&notes, "a.obj", 2, text, sizeof text));
    assert_string_equal(
        text, "a.obj:6: 2 lines with unknown keywords were ignored (the first is 'curv2')");
    assert_false(hs_obj_note_text(&notes, "a.obj", 3, text, sizeof text));
    hs_mesh_free(&mesh);

    mesh = parse(TRIANGLE "b\x01gus 1\nf 1 2 3", &notes);
    assert_true(hs_obj_note_text(&notes, "a.obj", 0, text, sizeof text));
    assert_string_equal(
        text, "a.obj:4: 1 line with an unknown keyword was ignored (the first is 'b?gus')");
    hs_mesh_free(&mesh);
}

/* --- What is refused ------------------------------------------------------------------------- */

static const struct {
    const char *text;
    uint32_t line; /* 0: the message has none */
    const char *words[3];
} malformed[] = {
    {"", 0, {"no faces"}},
    {"\n\n# nothing\n", 0, {"no faces"}},
    {TRIANGLE, 0, {"no faces", "'f' lines"}},
    {"v 1 2\n", 1, {"2 coordinates", "v x y z"}},
    {"v 1\n", 1, {"1 coordinate;"}},
    {"\nv\n", 2, {"0 coordinates"}},
    {"v 1 2 x\n", 1, {"'x' is not a number"}},
    {"v 1 2,5 3\n", 1, {"'2,5' is not a number"}},
    {"v 1 2 3e\n", 1, {"'3e' is not a number"}},
    {"v 1 2 3 4 5 red\n", 1, {"'red' is not a number"}},
    {"v 1 2 3 /\n", 1, {"'/' is not a number"}},
    {"v 1 2 \x1b[2J\n", 1, {"'?[2J' is not a number"}},
    {"v 0 0 0\nv nan 0 0\nv 0 1 0\nf 1 2 3\n", 2, {"x of vertex 2", "finite"}},
    {"v 0 0 0\nv 0 inf 0\nv 0 1 0\nf 1 2 3\n", 2, {"y of vertex 2", "finite"}},
    {"v 0 0 0\nv 0 0 0\nv 0 1 -1e39\nf 1 2 3\n", 3, {"z of vertex 3", "finite"}},
    {"v 0 0 0 -infinity\nv 0 0 0\nv 0 1 1\nf 1 2 3\n", 1, {"w of vertex 1", "finite"}},
    {TRIANGLE "f 1 2\n", 4, {"face 1 has 2 corners", "3 to 255"}},
    {TRIANGLE "f 1 2 3\nf 1\n", 5, {"face 2 has 1 corner;"}},
    {TRIANGLE "f\n", 4, {"face 1 has 0 corners"}},
    {TRIANGLE "f 0 1 2\n", 4, {"vertex index 0", "first vertex is 1"}},
    {TRIANGLE "f 1 -0 2\n", 4, {"vertex index 0"}},
    {TRIANGLE "f 1 2 4\n", 4, {"vertex 4", "3 vertices", "correct"}},
    {TRIANGLE "f 1 2 -4\nv 1 1 1\n", 4, {"vertex index -4", "only 3 vertices"}},
    {"f -1 -2 -3\n" TRIANGLE, 1, {"vertex index -1", "only 0 vertices"}},
    {TRIANGLE "f 1 2 4294967297\n", 4, {"4294967297", "out of range"}},
    {TRIANGLE "f 1 2 4294967295\n", 4, {"vertex 4294967295", "3 vertices"}},
    {TRIANGLE "f 1 2 99999999999999999999999\n", 4, {"99999999999999999999999", "out of range"}},
    {TRIANGLE "f 1 2 -99999999999999999999999\n", 4, {"-99999999999999999999999"}},
    {TRIANGLE "f 1 2 3.0\n", 4, {"'3.0' is not a corner", "integers"}},
    {TRIANGLE "f 1 2 3x\n", 4, {"'3x' is not a corner"}},
    {TRIANGLE "f 1 2 +3\n", 4, {"'+3' is not a corner"}},
    {TRIANGLE "f 1 2 -\n", 4, {"'-' is not a corner"}},
    {TRIANGLE "f 1 2 /3\n", 4, {"'/3' is not a corner"}},
    {TRIANGLE "f 1 2 3/a\n", 4, {"'3/a' is not a corner"}},
    {TRIANGLE "f 1 2 3/1/1/1\n", 4, {"'3/1/1/1' is not a corner"}},
    {TRIANGLE "f 1 2 3 \\ \n", 4, {"'\\' is not a corner"}},
    {TRIANGLE "f 1 2 3 \\# no\n", 4, {"'\\' is not a corner"}},
    {TRIANGLE "f 1 2 3\\", 4, {"'3\\' is not a corner"}},
    {TRIANGLE "f 1 2 1\n", 4, {"face 1", "vertex 1 more than once"}},
    {TRIANGLE "f 1 \\\n2 \\\n3\nf 1 2 x\n", 7, {"'x' is not a corner"}},
    {TRIANGLE "\nf 1 \\\n2 \\\n9\n", 5, {"face 1 uses vertex 9"}},
    {"v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 x\r\n", 4, {"'x' is not a corner"}},
    {"v 0 0 0\rv 1 0 0\rv 0 1 0\rf 1 2 x", 4, {"'x' is not a corner"}},
    {TRIANGLE "v 1 1 1\nf 1 2 3\nf 1 2 4\n", 6, {"inconsistently oriented", "line 5", "edge 1-2"}},
    {TRIANGLE "v 1 1 1\nv 2 2 2\nf 1 2 3\nf 2 1 4\nf 1 2 5\n",
     8,
     {"edge 1-2", "3 faces", "line 6"}},
    {TRIANGLE "f 1 2 3\nf 2 3 1\n", 5, {"inconsistently oriented", "face 2 (line 5)"}},
    {"v 5 5 5\n" TRIANGLE "v 1 1 1\nf 1 2 3\nf 1 4 5\n", 1, {"vertex 1 is non-manifold", "line 6"}},
};

static void malformed_files_are_refused_with_line_and_cause(void **state) {
    (void)state;
    for (size_t i = 0; i < sizeof malformed / sizeof *malformed; i++) {
        hs_mesh mesh;
        hs_error err = {0};
        size_t size = strlen(malformed[i].text);
        char *exact = malloc(size + !size);
        memcpy(exact, malformed[i].text, size);
        bool good = hs_obj_parse(&mesh, "a.obj", exact, size, false, NULL, &err);
        free(exact);
        if (good) fail_msg("not refused:\n%s", malformed[i].text);
        assert_int_equal(err.code, HS_EXIT_MESH);
        assert_null(mesh.position);
        assert_int_equal(mesh.faces, 0);
        char place[50];
        if (malformed[i].line != 0)
            snprintf(place, sizeof place, "a.obj:%u: ", malformed[i].line);
        else
            snprintf(place, sizeof place, "a.obj: ");
        if (strncmp(err.text, place, strlen(place)) != 0)
            fail_msg("'%s' is not at '%s'", err.text, place);
        for (size_t w = 0; w < 3 && malformed[i].words[w] != NULL; w++)
            if (strstr(err.text, malformed[i].words[w]) == NULL)
                fail_msg("'%s' does not say '%s'", err.text, malformed[i].words[w]);
    }
}

static void a_file_that_is_not_there_is_no_mesh(void **state) {
    (void)state;
    folder f = make_folder();
    hs_mesh mesh;
    hs_error err = {0};
    assert_false(hs_obj_read(&mesh, inside(&f, "a.obj"), false, NULL, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_non_null(strstr(err.text, inside(&f, "a.obj: cannot read: No such file")));
    assert_null(mesh.position);
    assert_int_equal(rmdir(f.path), 0);
}

static void binary_files_are_refused(void **state) {
    (void)state;
    static const char text[] = TRIANGLE "f 1 2\0 3\n";
    hs_mesh mesh;
    hs_error err;
    assert_false(hs_obj_parse(&mesh, "a.obj", text, sizeof text - 1, false, NULL, &err));
    assert_int_equal(err.code, HS_EXIT_MESH);
    assert_non_null(strstr(err.text, "a.obj:4: a zero byte"));
}

static void long_names_and_words_do_not_crowd_out_the_cause(void **state) {
    (void)state;
    static char name[5000], text[100000];
    memset(name, 'n', sizeof name - 1);
    memset(text, 'x', sizeof text);
    memcpy(text, "v 1 2 ", 6);
    hs_mesh mesh;
    hs_error err;
    assert_false(hs_obj_parse(&mesh, name, text, sizeof text, false, NULL, &err));
    assert_non_null(strstr(err.text, "xxx' is not a number; a vertex is 'v x y z'"));
    memcpy(text, "f 1 2 ", 6);
    assert_false(hs_obj_parse(&mesh, name, text, sizeof text, false, NULL, &err));
    assert_non_null(strstr(err.text, "is not a corner of a face; write integers"));
}

/* Random edits of a good file: whatever comes out, nothing is read or written out of bounds (run
 * under the sanitizers), and what is accepted is a mesh. */
static void random_edits_give_a_mesh_or_a_message(void **state) {
    (void)state;
    static const char good[] = "# x\no a\n" TRIANGLE "v 1 1 0 2\nvt 0 0\nf 1 2 3\nf -1/1/1 3//2 2\n"
                               "t crease 2/1/0 0 1 2\n";
    static const char spare[] = "0123456789-+./\\#\n\r \tvftnaeix\xff";
    uint32_t random = 1;
    uint32_t accepted = 0;
    for (int run = 0; run < 20000; run++) {
        char text[sizeof good - 1];
        memcpy(text, good, sizeof text);
        size_t edits = 1 + (size_t)run % 4;
        size_t size = sizeof text;
        for (size_t e = 0; e < edits; e++) {
            random = random * 1664525 + 1013904223;
            size_t at = (random >> 8) % size;
            random = random * 1664525 + 1013904223;
            text[at] = spare[(random >> 8) % (sizeof spare - 1)];
        }
        if (run % 3 == 0) size -= (random >> 16) % size;
        char *exact = malloc(size);
        memcpy(exact, text, size);
        hs_mesh mesh;
        hs_error err = {0};
        if (hs_obj_parse(&mesh, "a.obj", exact, size, false, NULL, &err)) {
            accepted++;
            for (uint32_t h = 0; h < mesh.halfedges; h++)
                assert_true(mesh.twin[h] == (uint32_t)HS_BORDER || mesh.twin[mesh.twin[h]] == h);
        } else {
            assert_int_equal(err.code, HS_EXIT_MESH);
            assert_int_equal(strncmp(err.text, "a.obj:", 6), 0);
        }
        hs_mesh_free(&mesh);
        free(exact);
    }
    assert_in_range(accepted, 100, 19900);
}

/* --- Round trips ----------------------------------------------------------------------------- */

enum { RUNGS = 2000 };

/* A strip of quads whose coordinates are random bits, subnormal, huge and negative zero included.
 */
static hs_mesh random_strip(void) {
    static float position[8 * RUNGS];
    static uint32_t sides[RUNGS], corner[4 * RUNGS];
    uint64_t random = 12345;
    for (uint32_t i = 0; i < 8 * RUNGS; i++) {
        do {
            random = random * 6364136223846793005ULL + 1442695040888963407ULL;
            uint32_t bits = (uint32_t)(random >> 32);
            memcpy(position + i, &bits, sizeof bits);
        } while (!isfinite(position[i]));
    }
    static const float special[] = {-0.0F, 0.0F, 1e-45F, 3.4028235e38F, 1.17549435e-38F, 0.1F};
    memcpy(position, special, sizeof special);
    for (uint32_t v = 0; v < 2 * RUNGS; v += 3)
        position[4 * v + 3] = 1;
    for (uint32_t f = 0; f < RUNGS - 1; f++) {
        sides[f] = 4;
        static const uint32_t offset[4] = {0, 2, 3, 1};
        for (uint32_t i = 0; i < 4; i++)
            corner[4 * f + i] = 2 * f + offset[i];
    }
    static const hs_sharp_tag tag[4] = {{2, 3, 9, 0}, {5, 4, 10, 0}, {0, 2, 1, 0}, {7, 7, 3, 0}};
    hs_soup soup = {.name = "strip",
                    .vertices = 2 * RUNGS,
                    .position = position,
                    .faces = RUNGS - 1,
                    .sides = sides,
                    .corner = corner,
                    .tags = 4,
                    .tag = tag};
    hs_mesh mesh;
    hs_error err;
    if (!hs_mesh_build(&mesh, &soup, NULL, &err)) fail_msg("%s", err.text);
    return mesh;
}

static void assert_same(const hs_mesh *a, const hs_mesh *b) {
    assert_int_equal(a->vertices, b->vertices);
    assert_int_equal(a->faces, b->faces);
    assert_int_equal(a->halfedges, b->halfedges);
    assert_memory_equal(a->position, b->position, a->vertices * 4 * sizeof(float));
    assert_memory_equal(a->first, b->first, (a->faces + 1) * sizeof(uint32_t));
    assert_memory_equal(a->origin, b->origin, a->halfedges * sizeof(uint32_t));
    assert_memory_equal(a->twin, b->twin, a->halfedges * sizeof(uint32_t));
    assert_memory_equal(a->sharpness, b->sharpness, a->halfedges);
    assert_memory_equal(a->vertex_sharpness, b->vertex_sharpness, a->vertices);
}

static void a_mesh_that_is_written_and_read_is_the_same_bit_for_bit(void **state) {
    (void)state;
    folder f = make_folder();
    const char *path = inside(&f, "strip.obj");
    hs_mesh before = random_strip(), after;
    hs_error err;
    assert_true(hs_obj_write_mesh(path, &before, &err));
    assert_true(hs_obj_read(&after, path, false, NULL, &err));
    assert_same(&before, &after);
    hs_mesh_free(&after);

    hs_output output = {.vertices = before.vertices,
                        .faces = before.faces,
                        .position = before.position,
                        .first = before.first,
                        .corner = before.origin};
    assert_true(hs_obj_write_output(path, &output, &err));
    assert_true(hs_obj_read(&after, path, false, NULL, &err));
    /* What came out of the pipeline has no tags. */
    memset(before.sharpness, 0, before.halfedges);
    memset(before.vertex_sharpness, 0, before.vertices);
    assert_same(&before, &after);
    hs_mesh_free(&after);
    hs_mesh_free(&before);
    assert_int_equal(count_entries(&f), 1);
    unlink(path);
    assert_int_equal(rmdir(f.path), 0);
}

static void w_is_written_where_it_matters(void **state) {
    (void)state;
    folder f = make_folder();
    const char *path = inside(&f, "a.obj");
    hs_mesh mesh = parse("v 0.1 -0 1e10\nv 1 0 0 2\nv 0 1 0\nf 1 2 3\n", NULL);
    hs_error err;
    assert_true(hs_obj_write_mesh(path, &mesh, &err));
    assert_content(path, "v 0.100000001 -0 1e+10\nv 1 0 0 2\nv 0 1 0\nf 1 2 3\n");
    hs_output output = {.vertices = 3,
                        .faces = 1,
                        .position = mesh.position,
                        .first = mesh.first,
                        .corner = mesh.origin};
    assert_true(hs_obj_write_output(path, &output, &err));
    assert_content(path, "v 0.100000001 -0 1e+10 1\nv 1 0 0 2\nv 0 1 0 1\nf 1 2 3\n");
    hs_mesh_free(&mesh);
    unlink(path);
    assert_int_equal(rmdir(f.path), 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_form_of_a_corner_names_its_vertex),
        cmocka_unit_test(negative_indices_count_back_from_their_own_line),
        cmocka_unit_test(faces_may_come_before_their_vertices),
        cmocka_unit_test(polygons_of_any_size_keep_their_order),
        cmocka_unit_test(line_ends_blanks_and_comments_do_not_matter),
        cmocka_unit_test(a_backslash_continues_a_line),
        cmocka_unit_test(objects_and_groups_become_one_mesh),
        cmocka_unit_test(numbers_are_what_strtof_reads),
        cmocka_unit_test(the_fourth_number_is_w_unless_there_are_more),
        cmocka_unit_test(tags_make_edges_and_vertices_sharp),
        cmocka_unit_test(of_repeated_tags_the_last_one_counts),
        cmocka_unit_test(fractions_are_refused_or_rounded_halves_up),
        cmocka_unit_test(bad_tags_are_refused_at_their_line),
        cmocka_unit_test(what_is_passed_over_is_noted_with_its_first_line),
        cmocka_unit_test(malformed_files_are_refused_with_line_and_cause),
        cmocka_unit_test(a_file_that_is_not_there_is_no_mesh),
        cmocka_unit_test(binary_files_are_refused),
        cmocka_unit_test(long_names_and_words_do_not_crowd_out_the_cause),
        cmocka_unit_test(random_edits_give_a_mesh_or_a_message),
        cmocka_unit_test(a_mesh_that_is_written_and_read_is_the_same_bit_for_bit),
        cmocka_unit_test(w_is_written_where_it_matters),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
