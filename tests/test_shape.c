/* SPDX-License-Identifier: Apache-2.0
 *
 * Claims about the shapes that the tool makes (model/shape.h).
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "shape.h"

/* What is counted of a mesh. Sides and valences of 15 and more are counted as 15. */
typedef struct census {
    uint32_t sides[16], valences[16];
    uint32_t border, border_loops;
    long euler;           /* vertices - edges + faces */
    uint32_t components;  /* of faces joined by edges */
    double volume;        /* positive: faces are counter-clockwise seen from outside */
    double smallest_area; /* of all faces, by their vector areas */
    double repeated_corners;
} census;

static hs_mesh make(const char *name, uint32_t size, uint32_t seed) {
    hs_mesh mesh;
    hs_error err = {0};
    if (!hs_shape_make(&mesh, name, size, seed, &err)) fail_msg("%s", err.text);
    return mesh;
}

static uint32_t smaller(uint32_t a, uint32_t b) {
    return a < b ? a : b;
}

static uint32_t root(uint32_t *parent, uint32_t f) {
    while (parent[f] != f)
        f = parent[f] = parent[parent[f]];
    return f;
}

static uint32_t count_components(const hs_mesh *m) {
    uint32_t *parent = malloc(m->faces * sizeof *parent), count = m->faces;
    for (uint32_t f = 0; f < m->faces; f++)
        parent[f] = f;
    for (uint32_t h = 0; h < m->halfedges; h++) {
        if (m->twin[h] == HS_BORDER) continue;
        uint32_t a = root(parent, m->face[h]), b = root(parent, m->face[m->twin[h]]);
        count -= a != b;
        parent[a] = b;
    }
    free(parent);
    return count;
}

/* Walks along the boundary: from h to the border half-edge that leaves h's end. */
static uint32_t count_border_loops(const hs_mesh *m) {
    uint8_t *seen = calloc(m->halfedges, 1);
    uint32_t loops = 0;
    for (uint32_t start = 0; start < m->halfedges; start++) {
        if (m->twin[start] != HS_BORDER || seen[start]) continue;
        loops++;
        for (uint32_t h = start; !seen[h];) {
            seen[h] = 1;
            for (h = hs_next(m, h); m->twin[h] != HS_BORDER;)
                h = hs_next(m, m->twin[h]);
        }
    }
    free(seen);
    return loops;
}

static void cross(const double a[3], const double b[3], double out[3]) {
    for (int i = 0; i < 3; i++)
        out[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
}

/* A face's vector area (its length is the area of a flat face), and its share of the volume. */
static void measure_face(const hs_mesh *m, uint32_t f, census *c) {
    double area[3] = {0}, centre[3] = {0}, volume = 0;
    uint32_t first = m->first[f], sides = hs_sides(m, f);
    for (uint32_t i = 0; i < sides; i++) {
        const float *p = m->position + 4 * m->origin[first + i];
        const float *q = m->position + 4 * m->origin[first + (i + 1) % sides];
        double a[3] = {p[0], p[1], p[2]}, b[3] = {q[0], q[1], q[2]}, ab[3];
        cross(a, b, ab);
        for (int k = 0; k < 3; k++) {
            area[k] += ab[k] / 2;
            centre[k] += a[k] / sides;
        }
        for (uint32_t j = 0; j < i; j++)
            c->repeated_corners += m->origin[first + i] == m->origin[first + j];
    }
    for (int k = 0; k < 3; k++)
        volume += area[k] * centre[k] / 3;
    c->volume += volume;
    c->smallest_area =
        fmin(c->smallest_area, sqrt(area[0] * area[0] + area[1] * area[1] + area[2] * area[2]));
}

static census take_census(const hs_mesh *m) {
    census c = {.smallest_area = INFINITY};
    uint32_t *valence = calloc(m->vertices, sizeof *valence);
    for (uint32_t h = 0; h < m->halfedges; h++) {
        c.border += m->twin[h] == HS_BORDER;
        valence[m->origin[h]]++;
    }
    for (uint32_t v = 0; v < m->vertices; v++)
        c.valences[smaller(valence[v], 15)]++;
    for (uint32_t f = 0; f < m->faces; f++) {
        c.sides[smaller(hs_sides(m, f), 15)]++;
        measure_face(m, f, &c);
    }
    free(valence);
    c.euler = (long)m->vertices - (long)((m->halfedges + c.border) / 2) + (long)m->faces;
    c.border_loops = count_border_loops(m);
    c.components = count_components(m);
    return c;
}

static bool equal_meshes(const hs_mesh *a, const hs_mesh *b) {
    return a->vertices == b->vertices && a->faces == b->faces && a->halfedges == b->halfedges &&
           memcmp(a->position, b->position, a->vertices * 4 * sizeof *a->position) == 0 &&
           memcmp(a->first, b->first, (a->faces + 1) * sizeof *a->first) == 0 &&
           memcmp(a->origin, b->origin, a->halfedges * sizeof *a->origin) == 0 &&
           memcmp(a->twin, b->twin, a->halfedges * sizeof *a->twin) == 0 &&
           !a->sharpness == !b->sharpness &&
           (!a->sharpness || memcmp(a->sharpness, b->sharpness, a->halfedges) == 0);
}

/* Every claim that holds for each closed body. */
static census assert_closed_body(const char *name, uint32_t size, uint32_t seed, long euler) {
    hs_mesh m = make(name, size, seed);
    census c = take_census(&m);
    if (c.border || c.euler != euler || c.components != 1 || c.repeated_corners > 0 ||
        c.valences[1] || c.valences[2] || !(c.volume > 0) || !(c.smallest_area > 1e-9))
        fail_msg("%s size %u seed %u: border %u, Euler %ld, components %u, valences 1 and 2: %u "
                 "%u, volume %g, smallest area %g",
                 name, size, seed, c.border, c.euler, c.components, c.valences[1], c.valences[2],
                 c.volume, c.smallest_area);
    hs_mesh_free(&m);
    return c;
}

/* Six times the signed volume of the tetrahedron of four vertices. */
static double tetrahedron(const hs_mesh *m, uint32_t v0, const uint32_t v[3]) {
    double d[3][3], n[3];
    for (uint32_t i = 0; i < 3; i++)
        for (uint32_t k = 0; k < 3; k++)
            d[i][k] = (double)m->position[4 * v[i] + k] - (double)m->position[4 * v0 + k];
    cross(d[0], d[1], n);
    return n[0] * d[2][0] + n[1] * d[2][1] + n[2] * d[2][2];
}

/* Whether the edge p q passes through the triangle t. */
static bool edge_pierces(const hs_mesh *m, uint32_t p, uint32_t q, const uint32_t t[3]) {
    if ((tetrahedron(m, p, t) > 0) == (tetrahedron(m, q, t) > 0)) return false;
    bool side[3];
    for (int i = 0; i < 3; i++)
        side[i] = tetrahedron(m, p, (uint32_t[3]){q, t[i], t[(i + 1) % 3]}) > 0;
    return side[0] == side[1] && side[1] == side[2];
}

/* Pairs of an edge and a face without a common vertex that it passes through; faces are taken as
 * fans of triangles. */
static uint32_t count_piercings(const hs_mesh *m) {
    uint32_t count = 0;
    for (uint32_t h = 0; h < m->halfedges; h++) {
        if (m->twin[h] < h) continue;
        uint32_t p = m->origin[h], q = m->origin[hs_next(m, h)];
        for (uint32_t f = 0; f < m->faces; f++) {
            const uint32_t *corner = m->origin + m->first[f];
            uint32_t sides = hs_sides(m, f);
            bool apart = true;
            for (uint32_t i = 0; i < sides; i++)
                apart = apart && corner[i] != p && corner[i] != q;
            for (uint32_t i = 1; apart && i + 1 < sides; i++)
                count += edge_pierces(m, p, q, (uint32_t[3]){corner[0], corner[i], corner[i + 1]});
        }
    }
    return count;
}

static uint32_t faces_of(const census *c) {
    uint32_t faces = 0;
    for (int n = 0; n < 16; n++)
        faces += c->sides[n];
    return faces;
}

/* --- All shapes --------------------------------------------------------------------------------
 */

static bool is_open(const char *name) {
    return strcmp(name, "grid") == 0 || strcmp(name, "spoon") == 0 || strcmp(name, "pot") == 0;
}

static void every_other_shape_is_a_closed_body_with_its_faces_outward(void **state) {
    (void)state;
    for (const hs_shape *s = hs_shapes; s->name; s++)
        if (!is_open(s->name))
            assert_closed_body(s->name, 0, 2, strcmp(s->name, "torus") == 0 ? 0 : 2);
}

static void the_same_name_size_and_seed_make_the_same_mesh(void **state) {
    (void)state;
    for (const hs_shape *s = hs_shapes; s->name; s++) {
        hs_mesh a = make(s->name, 0, 7), b = make(s->name, 0, 7), other = make(s->name, 0, 9);
        assert_true(equal_meshes(&a, &b));
        assert_int_equal(equal_meshes(&a, &other), !s->seeded);
        hs_mesh_free(&a);
        hs_mesh_free(&b);
        hs_mesh_free(&other);
    }
}

static void a_size_of_0_is_the_default_size(void **state) {
    (void)state;
    for (const hs_shape *s = hs_shapes; s->name; s++) {
        hs_mesh a = make(s->name, 0, 1), b = make(s->name, s->size, 1);
        assert_true(equal_meshes(&a, &b));
        hs_mesh_free(&a);
        hs_mesh_free(&b);
    }
}

static void an_unknown_name_is_answered_with_the_names(void **state) {
    (void)state;
    hs_mesh mesh;
    hs_error err = {0};
    assert_false(hs_shape_make(&mesh, "teapot", 0, 0, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
    assert_int_equal(mesh.faces, 0);
    assert_non_null(strstr(err.text, "'teapot'"));
    for (const hs_shape *s = hs_shapes; s->name; s++)
        assert_non_null(strstr(err.text, s->name));
}

static void a_size_out_of_range_is_answered_with_the_range(void **state) {
    (void)state;
    hs_mesh mesh;
    for (const hs_shape *s = hs_shapes; s->name; s++) {
        hs_error err = {0};
        assert_false(hs_shape_make(&mesh, s->name, s->max_size + 1, 0, &err));
        assert_int_equal(err.code, HS_EXIT_USAGE);
        assert_int_equal(mesh.faces, 0);
        assert_non_null(strstr(err.text, s->name));
        if (s->min_size > 1) assert_false(hs_shape_make(&mesh, s->name, s->min_size - 1, 0, &err));
    }
}

/* --- One by one --------------------------------------------------------------------------------
 */

static void the_simple_shapes_have_the_faces_they_should(void **state) {
    (void)state;
    census c = assert_closed_body("cube", 1, 0, 2);
    assert_int_equal(c.sides[4], 6);
    assert_true(fabs(c.volume - 8) < 1e-6);
    c = assert_closed_body("cube", 5, 0, 2);
    assert_int_equal(c.sides[4], 150);
    c = assert_closed_body("tetrahedron", 0, 0, 2);
    assert_int_equal(c.sides[3], 4);
    assert_true(fabs(c.volume - 8.0 / 3) < 1e-6);
    c = assert_closed_body("icosahedron", 0, 0, 2);
    assert_int_equal(c.sides[3], 20);
    assert_int_equal(c.valences[5], 12);
    assert_true(fabs(c.volume - 2.536150) < 1e-5);
    c = assert_closed_body("torus", 10, 0, 0);
    assert_int_equal(c.sides[4], 50);
    assert_int_equal(c.valences[4], 50);
}

static void the_grid_has_one_boundary_and_faces_the_viewer(void **state) {
    (void)state;
    hs_mesh m = make("grid", 3, 0);
    census c = take_census(&m);
    assert_int_equal(m.faces, 9);
    assert_int_equal(c.sides[4], 9);
    assert_int_equal(c.border, 12);
    assert_int_equal(c.border_loops, 1);
    assert_int_equal(c.euler, 1);
    assert_int_equal(c.components, 1);
    for (uint32_t f = 0; f < m.faces; f++) {
        const float *a = m.position + 4 * m.origin[4 * f];
        const float *b = m.position + 4 * m.origin[4 * f + 1];
        const float *d = m.position + 4 * m.origin[4 * f + 3];
        assert_true((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) > 0);
        assert_true(a[2] == 0);
    }
    hs_mesh_free(&m);
}

static void
mixed_has_every_valence_from_3_to_12_and_every_number_of_sides_from_3_to_9(void **state) {
    (void)state;
    census c = assert_closed_body("mixed", 0, 0, 2);
    for (int n = 3; n <= 12; n++)
        assert_true(c.valences[n] > 0);
    for (int n = 3; n <= 9; n++)
        assert_true(c.sides[n] > 0);
    for (int n = 13; n < 16; n++)
        assert_int_equal(c.valences[n], 0);
    for (int n = 10; n < 16; n++)
        assert_int_equal(c.sides[n], 0);
}

static void fifty_seeds_of_random_are_closed_bodies_of_about_the_size_asked_for(void **state) {
    (void)state;
    for (uint32_t seed = 0; seed < 50; seed++) {
        uint32_t size = 24 + 17 * seed;
        census c = assert_closed_body("random", size, seed, seed % 2 ? 0 : 2);
        assert_in_range(faces_of(&c), size * 3 / 4, size * 5 / 4);
        assert_true(c.sides[3] > 0 && c.sides[4] > 0 && c.sides[5] > 0);
        assert_true(c.valences[3] > 0 && c.valences[4] > 0);
        for (int n = 13; n < 16; n++)
            assert_true(c.sides[n] == 0 && c.valences[n] == 0);
    }
}

static void the_hand_is_mostly_quads_with_some_triangles_and_pentagons(void **state) {
    (void)state;
    census c = assert_closed_body("hand", 0, 0, 2);
    uint32_t faces = faces_of(&c);
    assert_in_range(faces, 300, 800);
    assert_true(c.sides[4] > faces * 3 / 4);
    assert_true(c.sides[3] >= 4);
    assert_true(c.sides[5] + c.sides[6] >= 4);
}

/* The mirror image of v, or HS_BORDER. */
static uint32_t find_mirrored(const hs_mesh *m, uint32_t v) {
    const float *p = m->position + 4 * v;
    for (uint32_t w = 0; w < m->vertices; w++) {
        const float *q = m->position + 4 * w;
        if (q[0] == -p[0] && q[1] == p[1] && q[2] == p[2]) return w;
    }
    return HS_BORDER;
}

static void the_monster_is_mostly_quads_and_symmetric_to_the_bit(void **state) {
    (void)state;
    census c = assert_closed_body("monster", 0, 0, 2);
    uint32_t faces = faces_of(&c);
    assert_in_range(faces, 400, 1200);
    assert_true(c.sides[4] > faces * 3 / 4);
    hs_mesh m = make("monster", 0, 0);
    for (uint32_t v = 0; v < m.vertices; v++)
        assert_int_not_equal(find_mirrored(&m, v), HS_BORDER);
    hs_mesh_free(&m);
}

/* Boundary vertices with one face would be corners that stay where they are. */
static void the_spoon_is_a_sheet_of_116_quads_without_a_corner(void **state) {
    (void)state;
    hs_mesh m = make("spoon", 0, 0);
    census c = take_census(&m);
    assert_int_equal(m.faces, 116);
    assert_int_equal(c.sides[4], 116);
    assert_int_equal(c.border_loops, 1);
    assert_int_equal(c.border, 40);
    assert_int_equal(c.components, 1);
    assert_int_equal(c.euler, 1);
    assert_int_equal(c.valences[1], 0);
    assert_int_equal(c.valences[2], c.border);
    assert_true(c.smallest_area > 0.005 && c.repeated_corners == 0);
    double lowest = INFINITY;
    for (uint32_t f = 0; f < m.faces; f++) { /* hollow to the front, and nowhere turned over */
        const float *a = m.position + 4 * m.origin[4 * f],
                    *b = m.position + 4 * m.origin[4 * f + 1];
        const float *d = m.position + 4 * m.origin[4 * f + 3];
        assert_true((b[0] - a[0]) * (d[1] - a[1]) - (b[1] - a[1]) * (d[0] - a[0]) > 0);
        lowest = fmin(lowest, (double)a[2]);
    }
    assert_true(lowest < -0.4);
    hs_mesh_free(&m);
}

static void the_pot_has_two_parts_and_three_openings(void **state) {
    (void)state;
    hs_mesh m = make("pot", 0, 0);
    census c = take_census(&m);
    assert_int_equal(c.components, 2);
    assert_int_equal(c.border_loops, 3);
    assert_int_equal(c.border, 11 + 11 + 8);
    /* A disc, the lid, has 1; a sphere with a handle has 0, less 1 for rim and spout each. */
    assert_int_equal(c.euler, 1 - 2);
    assert_int_equal(c.sides[3], 11);
    assert_int_equal(c.sides[11], 1);
    assert_int_equal(c.sides[4], m.faces - 12);
    assert_int_equal(c.valences[1], 0);
    assert_int_equal(c.valences[11], 1);
    assert_true(c.smallest_area > 0.002 && c.repeated_corners == 0);
    assert_true(c.volume > 10);
    hs_mesh_free(&m);
}

static void the_die_has_seven_pips_on_opposite_sides(void **state) {
    (void)state;
    census c = assert_closed_body("die", 0, 0, 2);
    /* 150 faces, and twelve more for every pip. */
    assert_int_equal(c.sides[4], 150 + 21 * 12);
    hs_mesh m = make("die", 0, 0);
    uint32_t pips[3][2] = {{0}};
    for (uint32_t f = 0; f < m.faces; f++) { /* the floor of a pip is the deepest */
        const float *p = m.position + 4 * m.origin[4 * f];
        for (uint32_t k = 0; k < 3; k++) {
            bool floor = fabsf(p[k]) > 0.8f && fabsf(p[k]) < 0.85f;
            for (uint32_t i = 0; i < 4; i++)
                floor = floor && m.position[4 * m.origin[4 * f + i] + k] == p[k];
            pips[k][p[k] > 0] += floor;
        }
    }
    assert_int_equal(pips[0][1], 1);
    assert_int_equal(pips[1][1], 2);
    assert_int_equal(pips[2][1], 3);
    for (int k = 0; k < 3; k++)
        assert_int_equal(pips[k][0] + pips[k][1], 7);
    hs_mesh_free(&m);
}

static void the_die_is_sharp_for_as_long_as_its_size_says_but_for_the_corners(void **state) {
    (void)state;
    for (uint32_t size = 1; size <= 11; size++) {
        hs_mesh m = make("die", size, 0);
        const uint8_t expected = (uint8_t)(size < 11 ? size - 1 : HS_SHARP_INFINITE);
        uint32_t sharp = 0;
        for (uint32_t h = 0; m.sharpness && h < m.halfedges; h++) {
            if (m.sharpness[h] == 0) continue;
            assert_int_equal(m.sharpness[h], expected);
            const float *p = m.position + 4 * m.origin[h];
            uint32_t at_end = 0;
            for (int k = 0; k < 3; k++)
                at_end += fabsf(p[k]) == 1;
            assert_int_equal(at_end, 2);
            sharp++;
        }
        assert_int_equal(sharp, size == 1 ? 0 : 2 * 12 * 3); /* half-edges: three on each edge */
        hs_mesh_free(&m);
    }
}

static void no_shape_that_is_modelled_passes_through_itself(void **state) {
    (void)state;
    const char *name[] = {"hand", "monster", "spoon", "pot", "die"};
    for (int i = 0; i < 5; i++) {
        hs_mesh m = make(name[i], 0, 0);
        assert_int_equal(count_piercings(&m), 0);
        hs_mesh_free(&m);
    }
}

static void a_point_pushed_through_a_body_is_seen(void **state) {
    (void)state;
    hs_mesh m = make("cube", 3, 0);
    assert_int_equal(count_piercings(&m), 0);
    for (uint32_t v = 0; v < m.vertices; v++) /* a point inside the front goes out at the back */
        if (m.position[4 * v + 2] == 1 && m.position[4 * v] < 0 && m.position[4 * v] > -1 &&
            m.position[4 * v + 1] < 0 && m.position[4 * v + 1] > -1) {
            m.position[4 * v + 2] = -2;
            m.position[4 * v] -= 0.1f;
            m.position[4 * v + 1] -= 0.2f;
        }
    assert_true(count_piercings(&m) > 0);
    hs_mesh_free(&m);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_other_shape_is_a_closed_body_with_its_faces_outward),
        cmocka_unit_test(the_same_name_size_and_seed_make_the_same_mesh),
        cmocka_unit_test(a_size_of_0_is_the_default_size),
        cmocka_unit_test(an_unknown_name_is_answered_with_the_names),
        cmocka_unit_test(a_size_out_of_range_is_answered_with_the_range),
        cmocka_unit_test(the_simple_shapes_have_the_faces_they_should),
        cmocka_unit_test(the_grid_has_one_boundary_and_faces_the_viewer),
        cmocka_unit_test(
            mixed_has_every_valence_from_3_to_12_and_every_number_of_sides_from_3_to_9),
        cmocka_unit_test(fifty_seeds_of_random_are_closed_bodies_of_about_the_size_asked_for),
        cmocka_unit_test(the_hand_is_mostly_quads_with_some_triangles_and_pentagons),
        cmocka_unit_test(the_spoon_is_a_sheet_of_116_quads_without_a_corner),
        cmocka_unit_test(the_pot_has_two_parts_and_three_openings),
        cmocka_unit_test(the_die_has_seven_pips_on_opposite_sides),
        cmocka_unit_test(the_die_is_sharp_for_as_long_as_its_size_says_but_for_the_corners),
        cmocka_unit_test(no_shape_that_is_modelled_passes_through_itself),
        cmocka_unit_test(a_point_pushed_through_a_body_is_seen),
        cmocka_unit_test(the_monster_is_mostly_quads_and_symmetric_to_the_bit),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
