/* SPDX-License-Identifier: Apache-2.0
 *
 * Which face lists are meshes, what half-edges they become, and what is measured of them.
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include <cmocka.h>

#include "mesh.h"
#include "mesh_info.h"
#include "obj.h"

#define SHARED "../shared/meshes/"

/* --- Help ------------------------------------------------------------------------------------ */

enum { MOST = 2048 };

/* A face list in the making; vertex v lies at (v, 0, 0, 1). */
typedef struct draft {
    float position[4 * MOST];
    uint32_t sides[MOST], corner[4 * MOST], vertex_line[MOST], face_line[MOST];
    uint32_t corners;
    hs_soup soup;
} draft;

/* Vertices stand in lines 101.., faces in lines 501... */
static void begin(draft *d, uint32_t vertices) {
    memset(d, 0, sizeof *d);
    for (uint32_t v = 0; v < vertices; v++) {
        d->position[4 * v] = (float)v;
        d->position[4 * v + 3] = 1;
        d->vertex_line[v] = 101 + v;
    }
    d->soup = (hs_soup){.name = "draft",
                        .vertices = vertices,
                        .position = d->position,
                        .sides = d->sides,
                        .corner = d->corner,
                        .vertex_line = d->vertex_line,
                        .face_line = d->face_line};
}

static void add_face(draft *d, uint32_t sides, const uint32_t *corner) {
    memcpy(d->corner + d->corners, corner, sides * sizeof *corner);
    d->corners += sides;
    d->face_line[d->soup.faces] = 501 + d->soup.faces;
    d->sides[d->soup.faces++] = sides;
}
#define FACE(d, ...)                                                                               \
    add_face(d, sizeof((uint32_t[]){__VA_ARGS__}) / sizeof(uint32_t), (uint32_t[]){__VA_ARGS__})

static void cube(draft *d) {
    begin(d, 8);
    FACE(d, 0, 1, 3, 2);
    FACE(d, 4, 6, 7, 5);
    FACE(d, 0, 4, 5, 1);
    FACE(d, 2, 3, 7, 6);
    FACE(d, 0, 2, 6, 4);
    FACE(d, 1, 5, 7, 3);
}

/* Every promise of mesh.h on the arrays. */
static void assert_half_edges_fit(const hs_mesh *m) {
    assert_int_equal(m->first[0], 0);
    assert_int_equal(m->first[m->faces], m->halfedges);
    for (uint32_t f = 0; f < m->faces; f++) {
        assert_in_range(hs_sides(m, f), 3, 255);
        assert_int_equal(m->forced[f], 0);
        for (uint32_t h = m->first[f]; h < m->first[f + 1]; h++)
            assert_int_equal(m->face[h], f);
    }
    for (uint32_t h = 0; h < m->halfedges; h++) {
        assert_true(m->origin[h] < m->vertices);
        assert_int_equal(hs_next(m, hs_prev(m, h)), h);
        uint32_t t = m->twin[h];
        if (t == (uint32_t)HS_BORDER) continue;
        assert_true(t < m->halfedges && t != h);
        assert_int_equal(m->twin[t], h);
        assert_int_equal(m->origin[t], m->origin[hs_next(m, h)]);
        assert_int_equal(m->origin[h], m->origin[hs_next(m, t)]);
    }
}

static void assert_refused(draft *d, const char *place, const char *const *words) {
    hs_mesh mesh;
    hs_error err = {0};
    uint32_t dropped = 7;
    assert_false(hs_mesh_build(&mesh, &d->soup, &dropped, &err));
    assert_int_equal(err.code, HS_EXIT_MESH);
    assert_int_equal(dropped, 0);
    hs_mesh empty = {0};
    assert_memory_equal(&mesh, &empty, sizeof mesh);
    if (strncmp(err.text, place, strlen(place)) != 0)
        fail_msg("'%s' does not begin with '%s'", err.text, place);
    for (; *words != NULL; words++)
        if (strstr(err.text, *words) == NULL) fail_msg("'%s' does not say '%s'", err.text, *words);
}
#define REFUSED(d, place, ...) assert_refused(d, place, (const char *const[]){__VA_ARGS__, NULL})

/* --- What is a mesh -------------------------------------------------------------------------- */

static void a_cube_becomes_twenty_four_half_edges_without_border(void **state) {
    (void)state;
    static draft d;
    cube(&d);
    hs_mesh mesh;
    hs_error err;
    uint32_t dropped;
    assert_true(hs_mesh_build(&mesh, &d.soup, &dropped, &err));
    assert_int_equal(dropped, 0);
    assert_int_equal(mesh.vertices, 8);
    assert_int_equal(mesh.faces, 6);
    assert_int_equal(mesh.halfedges, 24);
    assert_half_edges_fit(&mesh);
    for (uint32_t h = 0; h < 24; h++) {
        assert_int_not_equal(mesh.twin[h], (uint32_t)HS_BORDER);
        assert_int_equal(mesh.origin[h], d.corner[h]);
    }
    hs_mesh_free(&mesh);
    hs_mesh_free(&mesh);
}

static void two_faces_may_share_all_their_edges(void **state) {
    (void)state;
    static draft d;
    begin(&d, 3);
    FACE(&d, 0, 1, 2);
    FACE(&d, 2, 1, 0);
    hs_mesh mesh;
    hs_error err;
    assert_true(hs_mesh_build(&mesh, &d.soup, NULL, &err));
    assert_half_edges_fit(&mesh);
    assert_int_equal(mesh.twin[0], 4);
    assert_int_equal(mesh.twin[1], 3);
    assert_int_equal(mesh.twin[2], 5);
    hs_mesh_free(&mesh);
}

static void unused_vertices_are_dropped_and_the_others_keep_their_order(void **state) {
    (void)state;
    static draft d;
    begin(&d, 6);
    FACE(&d, 1, 5, 3);
    hs_mesh mesh;
    hs_error err;
    uint32_t dropped;
    assert_true(hs_mesh_build(&mesh, &d.soup, &dropped, &err));
    assert_int_equal(dropped, 3);
    assert_int_equal(mesh.vertices, 3);
    static const float place[3] = {1, 3, 5};
    for (uint32_t v = 0; v < 3; v++)
        assert_true(mesh.position[4 * v] == place[v]);
    static const uint32_t origin[3] = {0, 2, 1};
    assert_memory_equal(mesh.origin, origin, sizeof origin);
    hs_mesh_free(&mesh);
}

/* A fan of faces around vertex 0. */
static void fan(draft *d, uint32_t faces, bool closed) {
    begin(d, faces + 1 + !closed);
    for (uint32_t i = 0; i < faces; i++)
        FACE(d, 0, i + 1, closed && i + 1 == faces ? 1 : i + 2);
}

static void a_vertex_may_have_255_faces_but_not_256(void **state) {
    (void)state;
    static draft d;
    hs_mesh mesh;
    hs_error err;
    for (int closed = 0; closed < 2; closed++) {
        fan(&d, 255, closed);
        assert_true(hs_mesh_build(&mesh, &d.soup, NULL, &err));
        assert_half_edges_fit(&mesh);
        hs_mesh_free(&mesh);
        fan(&d, 256, closed);
        REFUSED(&d, "draft:101: ", "vertex 1 ", "more than 255 faces", "split");
    }
}

static void a_face_has_3_to_255_sides(void **state) {
    (void)state;
    static draft d;
    uint32_t corner[256];
    for (uint32_t i = 0; i < 256; i++)
        corner[i] = i;
    hs_mesh mesh;
    hs_error err;
    begin(&d, 256);
    add_face(&d, 255, corner);
    assert_true(hs_mesh_build(&mesh, &d.soup, NULL, &err));
    assert_half_edges_fit(&mesh);
    hs_mesh_free(&mesh);

    for (uint32_t sides = 0; sides < 3; sides++) {
        begin(&d, 4);
        FACE(&d, 0, 1, 2);
        add_face(&d, sides, corner);
        REFUSED(&d, "draft:502: ", "face 2 ", "; a face needs 3 to 255");
    }
    begin(&d, 256);
    add_face(&d, 256, corner);
    REFUSED(&d, "draft:501: ", "face 1 has 256 corners");
}

static void numbers_that_are_not_finite_are_refused(void **state) {
    (void)state;
    static draft d;
    static const float bad[3] = {NAN, INFINITY, -INFINITY};
    for (uint32_t i = 0; i < 12; i++) {
        cube(&d);
        d.position[4 * 5 + i % 4] = bad[i / 4];
        static const char *const words[4] = {"x of vertex 6 ", "y of vertex 6 ", "z of vertex 6 ",
                                             "w of vertex 6 "};
        REFUSED(&d, "draft:106: ", words[i % 4], "finite");
    }
}

static void bad_indices_and_repeated_corners_are_refused(void **state) {
    (void)state;
    static draft d;
    cube(&d);
    d.corner[7] = 8;
    REFUSED(&d, "draft:502: ", "face 2 uses vertex 9", "8 vertices");
    d.corner[7] = UINT32_MAX;
    REFUSED(&d, "draft:502: ", "face 2 uses vertex 4294967296");
    cube(&d);
    d.corner[6] = d.corner[4];
    REFUSED(&d, "draft:502: ", "face 2 uses vertex 5 more than once");
}

static void nothing_is_no_mesh(void **state) {
    (void)state;
    static draft d;
    begin(&d, 0);
    REFUSED(&d, "draft: ", "no faces");
    begin(&d, 4);
    REFUSED(&d, "draft: ", "no faces");
}

static void counts_of_two_to_the_24_are_refused_before_any_array_is_read(void **state) {
    (void)state;
    static draft d;
    cube(&d);
    d.soup.vertices = 1 << 24;
    REFUSED(&d, "draft: ", "16777216 vertices", "fewer than 16777216");
    cube(&d);
    d.soup.faces = UINT32_MAX;
    REFUSED(&d, "draft: ", "4294967295 faces");
}

static void a_face_turned_round_is_called_inconsistently_oriented(void **state) {
    (void)state;
    static draft d;
    cube(&d);
    static const uint32_t reversed[4] = {5, 7, 6, 4};
    memcpy(d.corner + 4, reversed, sizeof reversed);
    REFUSED(&d, "draft:", "inconsistently oriented", "face 2 (line 502)", "reverse", "edge ");
}

static void a_moebius_strip_is_refused(void **state) {
    (void)state;
    static draft d;
    begin(&d, 8);
    FACE(&d, 0, 2, 3, 1);
    FACE(&d, 2, 4, 5, 3);
    FACE(&d, 4, 6, 7, 5);
    FACE(&d, 6, 1, 0, 7);
    REFUSED(&d, "draft:", "inconsistently oriented");
}

static void an_edge_of_three_faces_is_named_with_its_faces(void **state) {
    (void)state;
    static draft d;
    begin(&d, 5);
    FACE(&d, 0, 1, 2);
    FACE(&d, 1, 0, 3);
    FACE(&d, 0, 1, 4);
    REFUSED(&d, "draft:503: ", "edge 1-2 belongs to 3 faces", "face 1 (line 501)",
            "face 3 (line 503)", "at most two");
}

static void two_fans_at_one_vertex_are_refused(void **state) {
    (void)state;
    static draft d;
    /* Two triangles that touch at vertex 0: two open fans. */
    begin(&d, 5);
    FACE(&d, 1, 2, 0);
    FACE(&d, 3, 4, 0);
    REFUSED(&d, "draft:101: ", "vertex 1 is non-manifold", "face 1 (line 501)",
            "face 2 (line 502)");
    /* Two tetrahedra that touch there: two closed ones. */
    begin(&d, 7);
    for (uint32_t i = 0; i < 2; i++) {
        uint32_t a = 1 + 3 * i, b = a + 1, c = a + 2;
        FACE(&d, 0, a, b);
        FACE(&d, 0, b, c);
        FACE(&d, 0, c, a);
        FACE(&d, c, b, a);
    }
    REFUSED(&d, "draft:101: ", "vertex 1 is non-manifold", "face 1 (line 501)",
            "face 5 (line 505)");
    /* A tetrahedron and a triangle: one of each. */
    d.corners -= 12;
    d.soup.faces -= 4;
    FACE(&d, 4, 5, 0);
    REFUSED(&d, "draft:101: ", "vertex 1 is non-manifold", "(line 505)");
}

static void dropped_vertices_do_not_shift_the_numbers_in_messages(void **state) {
    (void)state;
    static draft d;
    begin(&d, 9);
    FACE(&d, 5, 6, 4);
    FACE(&d, 7, 8, 4);
    REFUSED(&d, "draft:105: ", "vertex 5 is non-manifold");
    begin(&d, 9);
    FACE(&d, 5, 6, 4);
    FACE(&d, 5, 6, 8);
    REFUSED(&d, "draft:502: ", "edge 6-7");
    FACE(&d, 6, 5, 2);
    REFUSED(&d, "draft:502: ", "edge 6-7 belongs to 3 faces");
}

static void messages_do_without_lines(void **state) {
    (void)state;
    static draft d;
    begin(&d, 5);
    FACE(&d, 1, 2, 0);
    FACE(&d, 3, 4, 0);
    d.soup.vertex_line = d.soup.face_line = NULL;
    REFUSED(&d, "draft: vertex 1 ", "face 1 and face 2");
}

/* --- Measuring ------------------------------------------------------------------------------- */

static void measuring_an_open_cube_counts_its_hole(void **state) {
    (void)state;
    static draft d;
    cube(&d);
    d.soup.faces = 5;
    d.position[1] = -7;
    d.position[4 * 3 + 3] = 2;
    hs_mesh mesh;
    hs_error err;
    assert_true(hs_mesh_build(&mesh, &d.soup, NULL, &err));
    hs_mesh_info info;
    assert_true(hs_mesh_measure(&info, &mesh, &err));
    assert_int_equal(info.vertices, 8);
    assert_int_equal(info.faces, 5);
    assert_int_equal(info.edges, 12);
    assert_int_equal(info.sides[4], 5);
    assert_int_equal(info.valence[2], 4);
    assert_int_equal(info.valence[3], 4);
    assert_int_equal(info.boundary_valence[2], 4);
    assert_int_equal(info.boundary_valence[3], 0);
    assert_int_equal(info.boundary_edges, 4);
    assert_int_equal(info.boundary_loops, 1);
    assert_int_equal(info.components, 1);
    assert_int_equal(info.euler, 1);
    static const float lowest[4] = {0, -7, 0, 1}, highest[4] = {7, 0, 0, 2};
    assert_memory_equal(info.lowest, lowest, sizeof lowest);
    assert_memory_equal(info.highest, highest, sizeof highest);
    hs_mesh_free(&mesh);
}

static void a_ring_and_a_triangle_have_three_loops_and_two_components(void **state) {
    (void)state;
    static draft d;
    begin(&d, 9);
    for (uint32_t i = 0; i < 3; i++) {
        uint32_t a = 2 * i, b = (2 * i + 2) % 6;
        FACE(&d, a, b, b + 1, a + 1);
    }
    FACE(&d, 6, 7, 8);
    hs_mesh mesh;
    hs_error err;
    assert_true(hs_mesh_build(&mesh, &d.soup, NULL, &err));
    hs_mesh_info info;
    assert_true(hs_mesh_measure(&info, &mesh, &err));
    assert_int_equal(info.boundary_edges, 9);
    assert_int_equal(info.boundary_loops, 3);
    assert_int_equal(info.components, 2);
    assert_int_equal(info.euler, 1);
    hs_mesh_free(&mesh);
    assert_true(hs_mesh_measure(&info, &mesh, &err));
    hs_mesh_info nothing = {0};
    assert_memory_equal(&info, &nothing, sizeof info);
}

/* --- The shared meshes: SOURCES.txt says what they are --------------------------------------- */

/* The integer behind key ("euler=") in a line. */
static long figure(const char *line, const char *key) {
    const char *at = strstr(line, key);
    if (at == NULL)
        fail_msg("'%s' is missing in '%s'", key, line);
    else
        return strtol(at + strlen(key), NULL, 10);
    return 0;
}

/* "faces-by-size={3: 8, 4: 100}" against the histogram. */
static void assert_sides(const hs_mesh_info *info, const char *line) {
    const char *at = strstr(line, "faces-by-size={");
    assert_non_null(at);
    long sum = 0;
    for (at = strchr(at, '{'); *at != '}';) {
        char *end;
        long sides = strtol(at + 1, &end, 10);
        long count = strtol(end + 1, &end, 10);
        assert_in_range(sides, 3, 255);
        assert_int_equal(info->sides[sides], count);
        sum += count;
        at = end;
    }
    assert_int_equal(sum, info->faces);
}

static void assert_as_described(const char *path, const char *line) {
    hs_mesh mesh;
    hs_error err;
    hs_obj_notes notes;
    if (!hs_obj_read(&mesh, path, false, &notes, &err)) fail_msg("%s", err.text);
    assert_half_edges_fit(&mesh);
    hs_mesh_info info;
    assert_true(hs_mesh_measure(&info, &mesh, &err));
    /* V there counts unused vertices, euler does not. */
    assert_int_equal(info.vertices + notes.unused.count, figure(line, " V="));
    assert_int_equal(info.faces, figure(line, " F="));
    assert_int_equal(info.edges, figure(line, " E="));
    assert_int_equal(info.boundary_edges, figure(line, "boundary-edges="));
    assert_int_equal(info.components, figure(line, "components="));
    assert_int_equal(info.euler, figure(line, "euler="));
    assert_sides(&info, line);
    hs_mesh_free(&mesh);
}

static bool exists(const char *path) {
    struct stat status;
    return stat(path, &status) == 0;
}

static void assert_file_refused(const char *path) {
    hs_mesh mesh;
    hs_error err;
    if (hs_obj_read(&mesh, path, false, NULL, &err)) fail_msg("%s was not refused", path);
    assert_int_equal(err.code, HS_EXIT_MESH);
    char place[320];
    snprintf(place, sizeof place, "%s:", path);
    assert_memory_equal(err.text, place, strlen(place));
}

static void shared_meshes_are_what_their_list_says(void **state) {
    (void)state;
    FILE *list = fopen(SHARED "SOURCES.txt", "r");
    if (list == NULL) {
        print_message("skipped: " SHARED " is not there\n");
        skip();
    }
    char line[1000], name[200] = "", path[300];
    int good = 0, bad = 0;
    while (fgets(line, sizeof line, list) != NULL) {
        if (line[0] != ' ') {
            sscanf(line, "%199s", name);
        } else if (strstr(line, " V=") != NULL) {
            snprintf(path, sizeof path, SHARED "%s", name);
            bool is_good = exists(path) || strcmp(name, "catmark_nonman_bareverts.obj") == 0;
            if (!exists(path)) snprintf(path, sizeof path, SHARED "bad/%s", name);
            if (is_good)
                assert_as_described(path, line);
            else
                assert_file_refused(path);
            *(is_good ? &good : &bad) += 1;
        }
    }
    fclose(list);
    print_message("%d meshes measured, %d refused\n", good, bad);
    assert_true(good >= 26);
    assert_true(bad >= 5);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_becomes_twenty_four_half_edges_without_border),
        cmocka_unit_test(two_faces_may_share_all_their_edges),
        cmocka_unit_test(unused_vertices_are_dropped_and_the_others_keep_their_order),
        cmocka_unit_test(a_vertex_may_have_255_faces_but_not_256),
        cmocka_unit_test(a_face_has_3_to_255_sides),
        cmocka_unit_test(numbers_that_are_not_finite_are_refused),
        cmocka_unit_test(bad_indices_and_repeated_corners_are_refused),
        cmocka_unit_test(nothing_is_no_mesh),
        cmocka_unit_test(counts_of_two_to_the_24_are_refused_before_any_array_is_read),
        cmocka_unit_test(a_face_turned_round_is_called_inconsistently_oriented),
        cmocka_unit_test(a_moebius_strip_is_refused),
        cmocka_unit_test(an_edge_of_three_faces_is_named_with_its_faces),
        cmocka_unit_test(two_fans_at_one_vertex_are_refused),
        cmocka_unit_test(dropped_vertices_do_not_shift_the_numbers_in_messages),
        cmocka_unit_test(messages_do_without_lines),
        cmocka_unit_test(measuring_an_open_cube_counts_its_hole),
        cmocka_unit_test(a_ring_and_a_triangle_have_three_loops_and_two_components),
        cmocka_unit_test(shared_meshes_are_what_their_list_says),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
