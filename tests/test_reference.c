/* SPDX-License-Identifier: Apache-2.0
 *
 * Is the reference right? Its surface is compared with OpenSubdiv's, vertex by vertex, through a
 * correspondence that comes from the topology alone; its counts with closed forms; its refinement
 * of a part of a mesh with what a conforming mesh is.
 */
#include "osd.h"
#include "reference_samples.h"

/* Enough levels to see irregular faces and vertices come and go, within a second. */
static uint32_t levels_for(const hs_mesh *mesh) {
    return mesh->halfedges < 8000 ? 3 : 2;
}

/* --- The surface, beside OpenSubdiv's
 * ------------------------------------------------------------- */

static uint32_t find_row(const row *rows, uint32_t count, row wanted, const char *what) {
    const row *found = bsearch(&wanted, rows, count, sizeof *rows, by_key);
    if (!found)
        fail_msg("OpenSubdiv has no %s %u %u %u %u", what, wanted.key[0], wanted.key[1],
                 wanted.key[2], wanted.key[3]);
    return found ? found->value : 0;
}

static row edge_row(uint32_t v, uint32_t w, uint32_t value) {
    return (row){{v < w ? v : w, v < w ? w : v, 0, 0}, value};
}

/* A quad, turned so that its least vertex is first: orientation matters, the start doesn't. */
static row quad_row(const uint32_t v[4], uint32_t value) {
    unsigned least = 0;
    for (unsigned k = 1; k < 4; k++)
        if (v[k] < v[least]) least = k;
    return (row){{v[least], v[(least + 1) % 4], v[(least + 2) % 4], v[(least + 3) % 4]}, value};
}

/* Which of OpenSubdiv's vertices and faces are the reference's. */
typedef struct {
    uint32_t *vertex, *face;
} correspondence;

static uint32_t *new_numbers(uint32_t count) {
    uint32_t *numbers = malloc((count + 1u) * sizeof *numbers);
    assert_non_null(numbers);
    for (uint32_t i = 0; i < count; i++)
        numbers[i] = i;
    return numbers;
}

/* From a level to the next. Either way of refinement numbers old vertices, face points, edge
 * points in the order of the coarse mesh's vertices, faces, edges. */
static void descend(correspondence *c, const hs_reference *coarse, const hs_reference *fine,
                    const osd_level *level) {
    row *edges = new_rows(level->edges);
    for (uint32_t e = 0; e < level->edges; e++)
        edges[e] = edge_row(level->edge[2 * e], level->edge[2 * e + 1], e);
    qsort(edges, level->edges, sizeof *edges, by_key);

    assert_int_equal(fine->vertices, coarse->vertices + coarse->faces + coarse->edges);
    uint32_t *vertex = new_numbers(fine->vertices), count = 0;
    for (uint32_t v = 0; v < coarse->vertices; v++)
        vertex[count++] = level->vertex_child[c->vertex[v]];
    for (uint32_t f = 0; f < coarse->faces; f++)
        vertex[count++] = level->face_child[c->face[f]];
    for (uint32_t e = 0; e < coarse->edges; e++) {
        const row wanted =
            edge_row(c->vertex[coarse->edge[e].v0], c->vertex[coarse->edge[e].v1], 0);
        vertex[count++] = level->edge_child[find_row(edges, level->edges, wanted, "edge")];
    }
    free(edges);
    free(c->vertex);
    c->vertex = vertex;

    const osd_level *next = level + 1;
    row *quads = new_rows(next->faces);
    for (uint32_t f = 0; f < next->faces; f++)
        quads[f] = quad_row(next->corner + next->first[f], f);
    qsort(quads, next->faces, sizeof *quads, by_key);
    free(c->face);
    c->face = new_numbers(fine->faces);
    for (uint32_t f = 0; f < fine->faces; f++) {
        uint32_t corner[4];
        for (uint32_t k = 0; k < 4; k++)
            corner[k] = vertex[fine->face_vertex[fine->face[f].v.first + k]];
        c->face[f] = find_row(quads, next->faces, quad_row(corner, 0), "quad");
    }
    free(quads);
}

static double largest_component(const hs_reference *r) {
    double largest = 0;
    for (uint32_t v = 0; v < r->vertices; v++)
        for (int i = 0; i < 4; i++)
            largest = fmax(largest, fabs(r->vertex[v].position[i]));
    return largest;
}

/* Largest difference of a component. */
static double distance(const hs_reference *r, const osd_level *level, const uint32_t *vertex) {
    double largest = 0;
    assert_int_equal(r->vertices, level->vertices);
    for (uint32_t v = 0; v < r->vertices; v++)
        for (int i = 0; i < 4; i++) {
            const double here = r->vertex[v].position[i],
                         there = level->position[4 * (size_t)vertex[v] + (size_t)i];
            if (!(fabs(here - there) <= largest)) largest = fabs(here - there);
        }
    return largest;
}

static void two_steps(hs_reference *r) {
    step(r, NULL);
    step(r, NULL);
}

static void one_level(hs_reference *r) {
    hs_error err;
    if (!hs_reference_catmull_clark(r, &err)) fail_msg("%s", err.text);
}

/* Relative distance, the worst of levels 1 to 3. */
static double compare_with_opensubdiv(const hs_mesh *mesh, void (*refine)(hs_reference *)) {
    double matrix[16], worst = 0;
    matrix_in_double(matrix);
    hs_reference coarse, fine = new_reference(mesh, matrix);
    const double scale = largest_component(&fine);
    osd_surface surface;
    hs_error err;
    if (!osd_refine(&surface, mesh, matrix, levels_for(mesh), OSD_BOUNDARY_EDGE_AND_CORNER, &err))
        fail_msg("%s", err.text);
    correspondence c = {new_numbers(mesh->vertices), new_numbers(mesh->faces)};
    for (uint32_t l = 0; l < surface.levels; l++) {
        if (!hs_reference_copy(&coarse, &fine, &err)) fail_msg("%s", err.text);
        refine(&fine);
        descend(&c, &coarse, &fine, &surface.level[l]);
        worst = fmax(worst, distance(&fine, &surface.level[l + 1], c.vertex) / scale);
        hs_reference_free(&coarse);
    }
    hs_reference_free(&fine);
    osd_free(&surface);
    free(c.vertex);
    free(c.face);
    return worst;
}

static void compare_all_with_opensubdiv(const samples *all, void (*refine)(hs_reference *)) {
    double worst = 0;
    uint32_t compared = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        if (!all->item[i].closed) continue;
        const double here = compare_with_opensubdiv(&all->item[i].mesh, refine);
        if (!(here <= 1e-12)) fail_msg("%s: relative distance %g", all->item[i].name, here);
        worst = fmax(worst, here);
        compared++;
    }
    print_message("%u closed meshes, worst relative distance %.2g\n", compared, worst);
    assert_true(compared >= 3);
}

static void two_m_steps_are_m_levels_of_opensubdiv(void **state) {
    compare_all_with_opensubdiv(*state, two_steps);
}

static void direct_catmull_clark_is_opensubdivs(void **state) {
    compare_all_with_opensubdiv(*state, one_level);
}

static void the_race_against_opensubdiv_counts_what_it_made(void **state) {
    const samples *all = *state;
    const hs_mesh *mesh = &all->item[2].mesh;
    osd_timing timing;
    hs_error err;
    assert_true(osd_time(&timing, mesh, 4, &err));
    assert_int_equal(timing.faces, mesh->halfedges * 64);
    assert_int_equal(timing.vertices, mesh->halfedges * 64); /* a torus: V = F */
    assert_true(timing.topology > 0 && timing.position > 0);
    assert_false(osd_time(&timing, mesh, OSD_MAX_LEVELS + 1, &err));
}

static void a_corner_of_a_cube_moves_to_five_ninths(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, NULL);
    step(&r, NULL);
    for (int i = 0; i < 3; i++)
        assert_true(fabs(r.vertex[7].position[i] - 5.0 / 9) < 1e-15);
    assert_true(fabs(r.vertex[7].position[3] - 1) < 1e-15);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

static void direct_catmull_clark_refuses_a_boundary(void **state) {
    (void)state;
    const float position[] = {0, 0, 0, 1, 1, 0, 0, 1, 0, 1, 0, 1};
    const uint32_t sides[] = {3}, corner[] = {0, 1, 2};
    hs_mesh triangle;
    build(&triangle, "triangle", 3, position, 1, sides, corner);
    hs_reference r = new_reference(&triangle, NULL);
    hs_error err = {0};
    assert_false(hs_reference_catmull_clark(&r, &err));
    assert_int_equal(err.code, HS_EXIT_MESH);
    assert_non_null(strstr(err.text, "boundary"));
    hs_reference_free(&r);
    hs_mesh_free(&triangle);
}

/* --- Topology
 * ----------------------------------------------------------------------------------------- */

/* On a closed mesh: V' = V + F, F' = E, E' = 2 E. */
static void uniform_steps_have_the_closed_forms_counts(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        if (!all->item[i].closed) continue;
        hs_reference r = new_reference(&all->item[i].mesh, NULL);
        assert_int_equal(2 * r.edges, all->item[i].mesh.halfedges);
        for (uint32_t g = 0; g < 4; g++) {
            const uint32_t vertices = r.vertices, faces = r.faces, edges = r.edges;
            step(&r, NULL);
            assert_int_equal(r.vertices, vertices + faces);
            assert_int_equal(r.faces, edges);
            assert_int_equal(r.edges, 2 * edges);
            assert_int_equal(r.finals, 0);
            assert_int_equal(r.generation, g + 1);
        }
        hs_reference_free(&r);
    }
}

static void uniform_refinement_is_conforming_at_every_depth(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        for (uint32_t depth = 0; depth <= 4; depth++) {
            hs_reference r = new_reference(&all->item[i].mesh, NULL);
            for (uint32_t g = 0; g < depth; g++)
                step(&r, NULL);
            finish(&r);
            assert_int_equal(r.faces, 0);
            check_conforming(&r, &all->item[i]);
            hs_reference_free(&r);
        }
    }
}

static uint8_t *new_decision(uint32_t faces, uint8_t value) {
    uint8_t *decision = malloc(faces + 1u);
    assert_non_null(decision);
    memset(decision, value, faces + 1u);
    return decision;
}

static void refining_every_face_equals_a_uniform_step(void **state) {
    const samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++) {
        hs_reference a = new_reference(&all->item[i].mesh, NULL), b;
        hs_error err;
        assert_true(hs_reference_copy(&b, &a, &err));
        for (uint32_t g = 0; g < 4; g++) {
            uint8_t *decision = new_decision(b.faces, HS_REFERENCE_SELECTED | HS_REFERENCE_REFINED);
            step(&a, NULL);
            step(&b, decision);
            free(decision);
            assert_int_equal(a.vertices, b.vertices);
            assert_int_equal(a.faces, b.faces);
            assert_int_equal(a.finals, b.finals);
            assert_memory_equal(a.face_vertex, b.face_vertex, a.corners * sizeof(uint32_t));
            for (uint32_t v = 0; v < a.vertices; v++)
                assert_memory_equal(a.vertex[v].position, b.vertex[v].position,
                                    sizeof a.vertex[v].position);
        }
        hs_reference_free(&a);
        hs_reference_free(&b);
    }
}

static uint32_t random_number(uint32_t *seed) {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

/* Positions of the vertices that are held, before a step; others are NAN. */
static double *held_positions(const hs_reference *r) {
    double *x = malloc((r->vertices + 1u) * sizeof *x);
    assert_non_null(x);
    for (uint32_t v = 0; v < r->vertices; v++)
        x[v] = r->vertex[v].held ? r->vertex[v].position[0] : (double)NAN;
    return x;
}

static void refine_at_random(hs_reference *r, uint32_t generations, uint32_t *seed) {
    for (uint32_t g = 0; g < generations; g++) {
        uint8_t *decision = new_decision(r->faces, 0);
        for (uint32_t f = 0; f < r->faces; f++)
            if (random_number(seed) % 8 != 0) decision[f] = HS_REFERENCE_REFINED;
        const uint32_t vertices = r->vertices;
        double *held = held_positions(r);
        step(r, decision);
        for (uint32_t v = 0; v < vertices; v++)
            if (!isnan(held[v])) assert_true(held[v] == r->vertex[v].position[0]);
        free(held);
        free(decision);
    }
}

static void refining_any_faces_gives_a_conforming_mesh(void **state) {
    const samples *all = *state;
    uint32_t seed = 2463534242u;
    for (uint32_t i = 0; i < all->count; i++) {
        for (uint32_t run = 0; run < 4; run++) {
            hs_reference r = new_reference(&all->item[i].mesh, NULL);
            refine_at_random(&r, 5, &seed);
            finish(&r);
            check_conforming(&r, &all->item[i]);
            hs_reference_free(&r);
        }
    }
}

/* Faces 0 and 2 of a cube are refined: their common edge becomes a quad; every other side leaves a
 * triangle in its place in the order of the faces. */
static void final_faces_leave_in_the_order_of_the_active_ones(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, NULL);
    const uint8_t decision[6] = {HS_REFERENCE_REFINED, 0, HS_REFERENCE_REFINED, 0, 0, 0};
    step(&r, decision);
    finish(&r);
    const uint32_t expected[11][4] = {{4, 5, 8},    {7, 6, 8},    {6, 4, 8},   {0, 2, 3, 1},
                                      {1, 3, 9},    {3, 7, 9},    {5, 1, 9},   {0, 4, 6, 2},
                                      {2, 6, 7, 3}, {0, 1, 5, 4}, {7, 8, 5, 9}};
    assert_int_equal(r.finals, 11);
    for (uint32_t f = 0; f < 11; f++) {
        const hs_reference_list v = r.final[f].v;
        assert_int_equal(v.count, expected[f][3] ? 4 : 3);
        assert_memory_equal(r.final_vertex + v.first, expected[f], v.count * sizeof(uint32_t));
        assert_int_equal(r.final[f].generation, f == 10 ? 1 : 0);
    }
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* --- Its own decisions
 * ---------------------------------------------------------------------------------- */

static void decide(const hs_reference *r, const hs_settings *settings, uint8_t *decision) {
    hs_error err;
    if (!hs_reference_decide(r, settings, decision, &err)) fail_msg("%s", err.text);
}

/* Orthographic, along -z: of a cube's faces, the first looks at the eye, the second away, and the
 * others are seen edge on, which counts as back. */
static void only_the_front_face_of_a_cube_is_front(void **state) {
    (void)state;
    const double look[16] = {0.5, 0, 0, 0, 0, 0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 1};
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, look);
    uint8_t decision[6];
    const hs_settings front = {.front_depth = 1}, guarded = {.front_depth = 1, .guard = true},
                      silhouette = {.silhouette_depth = 1};
    decide(&r, &front, decision);
    const uint8_t one[6] = {3, 0, 0, 0, 0, 0}, ring[6] = {3, 0, 2, 2, 2, 2},
                  edge[6] = {3, 0, 3, 3, 3, 3};
    assert_memory_equal(decision, one, 6);
    decide(&r, &guarded, decision);
    assert_memory_equal(decision, ring, 6);
    decide(&r, &silhouette, decision);
    assert_memory_equal(decision, edge, 6);
    hs_reference_free(&r);

    const double beside[16] = {0.5, 0, 0, 3, 0, 0.5, 0, 0, 0, 0, -0.5, 0, 0, 0, 0, 1};
    r = new_reference(&cube, beside); /* out of view: x > w */
    decide(&r, &front, decision);
    assert_int_equal(decision[0], 0);
    cube.forced[1] = 1;
    hs_reference_free(&r);
    r = new_reference(&cube, beside);
    decide(&r, &front, decision);
    assert_int_equal(decision[1], HS_REFERENCE_SELECTED | HS_REFERENCE_REFINED);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_corner_of_a_cube_moves_to_five_ninths),
        cmocka_unit_test(two_m_steps_are_m_levels_of_opensubdiv),
        cmocka_unit_test(direct_catmull_clark_is_opensubdivs),
        cmocka_unit_test(the_race_against_opensubdiv_counts_what_it_made),
        cmocka_unit_test(direct_catmull_clark_refuses_a_boundary),
        cmocka_unit_test(uniform_steps_have_the_closed_forms_counts),
        cmocka_unit_test(uniform_refinement_is_conforming_at_every_depth),
        cmocka_unit_test(refining_every_face_equals_a_uniform_step),
        cmocka_unit_test(refining_any_faces_gives_a_conforming_mesh),
        cmocka_unit_test(final_faces_leave_in_the_order_of_the_active_ones),
        cmocka_unit_test(only_the_front_face_of_a_cube_is_front),
    };
    return cmocka_run_group_tests_name("reference", tests, make_samples, free_samples);
}
