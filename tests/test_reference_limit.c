/* SPDX-License-Identifier: Apache-2.0
 *
 * Are the reference's limit positions and normals those of the limit surface? They are compared
 * with OpenSubdiv's, and positions with those of deeper levels, which must be the same.
 *
 * What OpenSubdiv's Limit does at semi-sharp vertices: the rule is that of the sharpness that is
 * left at the last level, so a crease that has not worn off is treated as one that never will; it
 * is no limit of the surface, but the same on both sides here.
 */
#include "reference_levels.h"
#include "reference_parts.h"
#include "reference_shapes.h"

typedef struct {
    double (*position)[4], (*normal)[3];
} limits;

static limits new_limits(const hs_reference *r) {
    limits l = {calloc(r->vertices, sizeof *l.position), calloc(r->corners, sizeof *l.normal)};
    hs_error err;
    assert_non_null(l.position);
    assert_non_null(l.normal);
    if (!hs_reference_limit(r, l.position, l.normal, &err)) fail_msg("%s", err.text);
    return l;
}

static void free_limits(limits *l) {
    free(l->position);
    free(l->normal);
}

/* --- Beside OpenSubdiv ------------------------------------------------------------------------ */

/* OpenSubdiv leaves a smooth vertex of valence 2 where it is; its mask would move it. */
static bool is_smooth_of_valence_2(const hs_reference *r, uint32_t v) {
    uint32_t end[2];
    return r->vertex[v].faces.count == 2 &&
           hs_reference_vertex_rule(r, v, end) == HS_REFERENCE_SMOOTH;
}

typedef struct {
    uint64_t positions, smooth, crease, corner, without; /* compared vertices; normals by rule */
    uint64_t semi_sharp;                                 /* vertices with a finite sharpness left */
    double position, normal;                             /* the worst difference */
} totals;

static double largest_difference(const double *a, const double *b, int n) {
    double largest = 0;
    for (int i = 0; i < n; i++)
        if (!(fabs(a[i] - b[i]) <= largest)) largest = fabs(a[i] - b[i]);
    return largest;
}

static bool has_finite_sharpness(const hs_reference *r, uint32_t v) {
    const hs_reference_list edges = r->vertex[v].edges;
    uint8_t s = r->vertex[v].sharpness;
    bool finite = s && s != HS_SHARP_INFINITE;
    for (uint32_t i = 0; i < edges.count; i++) {
        s = r->edge[r->vertex_edge[edges.first + i]].sharpness;
        finite |= s && s != HS_SHARP_INFINITE;
    }
    return finite;
}

/* The cross product of OpenSubdiv's tangents, as a unit vector; false if they are parallel. *sine
 * of the angle between them, by which a rounding error is divided. w is 1 everywhere. */
static bool osd_normal(const osd_surface *surface, uint32_t v, double normal[3], double *sine) {
    const double *a = surface->tangent1 + 4 * (size_t)v, *b = surface->tangent2 + 4 * (size_t)v;
    double size = 0, size_a = 0, size_b = 0;
    for (int i = 0; i < 3; i++) {
        normal[i] = a[(i + 1) % 3] * b[(i + 2) % 3] - a[(i + 2) % 3] * b[(i + 1) % 3];
        size += normal[i] * normal[i];
        size_a += a[i] * a[i];
        size_b += b[i] * b[i];
    }
    *sine = sqrt(size / (size_a * size_b));
    if (!(*sine > 1e-4)) return false;
    for (int i = 0; i < 3; i++)
        normal[i] /= sqrt(size);
    return true;
}

/* All corners of a smooth vertex have the normal; of a crease, one side has: OpenSubdiv takes the
 * sector between the first and the last of its sharp edges. */
static double normal_difference(const hs_reference *r, const limits *l, uint32_t v,
                                const double *normal, bool all_corners) {
    const hs_reference_list faces = r->vertex[v].faces;
    double least = INFINITY, largest = 0;
    for (uint32_t i = 0; i < faces.count; i++) {
        const uint32_t f = r->vertex_face[faces.first + i];
        for (uint32_t k = 0; k < 4; k++) {
            if (hs_reference_corner(r, f, k) != v) continue;
            const double d = largest_difference(l->normal[r->face[f].v.first + k], normal, 3);
            least = fmin(least, d);
            largest = fmax(largest, d);
        }
    }
    return all_corners ? largest : least;
}

/* To 1e-11 of a right angle: where a sector has hundreds of faces, weights of up to 10^2 cancel.
 *
 * At a corner OpenSubdiv takes the first two edges, whatever lies between the sharp ones: the same
 * only if a sector of one face is all that there is. */
static void compare_normal(const hs_reference *r, const limits *l, uint32_t v,
                           const osd_surface *surface, uint32_t there, totals *sum) {
    double normal[3], sine;
    uint32_t end[2];
    const hs_reference_rule rule = hs_reference_vertex_rule(r, v, end);
    const bool comparable = rule != HS_REFERENCE_STAYS || r->vertex[v].faces.count == 1;
    if (!comparable || is_smooth_of_valence_2(r, v) || !osd_normal(surface, there, normal, &sine)) {
        sum->without++;
        return;
    }
    const double d = normal_difference(r, l, v, normal, rule == HS_REFERENCE_SMOOTH) * sine;
    if (!(d <= 1e-11)) fail_msg("normal of vertex %u, rule %u: differs by %g", v, rule, d);
    sum->normal = fmax(sum->normal, d);
    sum->smooth += rule == HS_REFERENCE_SMOOTH;
    sum->crease += rule == HS_REFERENCE_CREASE;
    sum->corner += rule == HS_REFERENCE_STAYS;
}

static void compare_limits(const hs_reference *r, const osd_surface *surface,
                           const uint32_t *vertex, double size, totals *sum) {
    limits l = new_limits(r);
    for (uint32_t v = 0; v < r->vertices; v++) {
        const uint32_t there = vertex[v];
        sum->semi_sharp += has_finite_sharpness(r, v);
        compare_normal(r, &l, v, surface, there, sum);
        if (is_smooth_of_valence_2(r, v)) continue;
        const double d =
            largest_difference(l.position[v], surface->limit + 4 * (size_t)there, 4) / size;
        if (!(d <= 1e-12)) fail_msg("limit of vertex %u: differs by %g", v, d);
        sum->position = fmax(sum->position, d);
        sum->positions++;
    }
    free_limits(&l);
}

/* Every level of a mesh that OpenSubdiv is asked for is its last one. */
static void compare_levels(const hs_mesh *mesh, hs_boundary boundary, uint32_t levels,
                           totals *sum) {
    for (uint32_t last = 1; last <= levels; last++) {
        hs_reference r = new_reference(mesh, NULL, boundary);
        const double size = box_size(&r);
        osd_surface surface;
        hs_error err;
        if (!osd_refine(&surface, mesh, NULL, last, osd_mode(boundary), &err))
            fail_msg("%s", err.text);
        correspondence c = {new_numbers(mesh->vertices), new_numbers(mesh->faces)};
        for (uint32_t level = 0; level < last; level++)
            follow(&r, &surface, level, &c, two_steps);
        compare_limits(&r, &surface, c.vertex, size, sum);
        hs_reference_free(&r);
        osd_free(&surface);
        free(c.vertex);
        free(c.face);
    }
}

static void limits_and_normals_are_opensubdivs(void **state) {
    const samples *all = *state;
    totals sum = {0};
    for (uint32_t i = 0; i < all->count; i++)
        for (unsigned mode = 0; mode < 2; mode++)
            compare_levels(&all->item[i].mesh, refined_modes[mode],
                           all->item[i].mesh.halfedges < 400 ? 3 : 1, &sum);
    print_message("%llu limit positions, %llu of them at semi-sharp vertices: worst relative "
                  "distance %.2g; %llu smooth, %llu crease, %llu corner normals: worst %.2g "
                  "(%llu not compared)\n",
                  (unsigned long long)sum.positions, (unsigned long long)sum.semi_sharp,
                  sum.position, (unsigned long long)sum.smooth, (unsigned long long)sum.crease,
                  (unsigned long long)sum.corner, sum.normal, (unsigned long long)sum.without);
    assert_true(sum.semi_sharp > 100 && sum.smooth > 100 && sum.crease > 100 && sum.corner > 10);
    assert_true(sum.without * 20 < sum.positions);
}

/* --- Deeper levels ---------------------------------------------------------------------------- */

/* A dart, the end of a crease: the smooth rule, but one edge whose point is its middle. The smooth
 * mask, here as in OpenSubdiv, takes no notice of that edge: what it gives is near the limit only.
 */
static bool is_dart(const hs_reference *r, uint32_t v) {
    const hs_reference_list edges = r->vertex[v].edges;
    uint32_t sharp = 0;
    for (uint32_t i = 0; i < edges.count; i++)
        sharp += r->edge[r->vertex_edge[edges.first + i]].sharpness != 0;
    return sharp == 1 && r->vertex[v].sharpness == 0;
}

/* But those at which a finite sharpness has yet to wear off, and darts. */
static void refining_deeper_moves_no_vertex(void **state) {
    const samples *all = *state;
    double worst = 0;
    uint64_t compared = 0, creases = 0, valence_2 = 0, darts = 0;
    for (uint32_t i = 0; i < 2 * all->count; i++) {
        const hs_mesh *mesh = &all->item[i / 2].mesh;
        hs_reference r = new_reference(mesh, NULL, refined_modes[i % 2]);
        const double size = box_size(&r);
        two_steps(&r);
        limits before = new_limits(&r);
        for (uint32_t level = 2; level <= (mesh->halfedges < 400 ? 3 : 2); level++) {
            const uint32_t vertices = r.vertices;
            bool *settled = calloc(vertices, 1);
            assert_non_null(settled);
            for (uint32_t v = 0; v < vertices; v++) {
                uint32_t end[2];
                const bool dart = is_dart(&r, v);
                darts += dart;
                settled[v] = !dart && !has_finite_sharpness(&r, v);
                creases +=
                    settled[v] && hs_reference_vertex_rule(&r, v, end) == HS_REFERENCE_CREASE;
                valence_2 += is_smooth_of_valence_2(&r, v);
            }
            two_steps(&r);
            limits after = new_limits(&r);
            for (uint32_t v = 0; v < vertices; v++) {
                if (!settled[v]) continue;
                const double d = largest_difference(before.position[v], after.position[v], 4);
                if (!(d <= 1e-12 * size))
                    fail_msg("%s, level %u: vertex %u moves by %g", all->item[i / 2].name, level, v,
                             d);
                worst = fmax(worst, d / size);
                compared++;
            }
            free(settled);
            free_limits(&before);
            before = after;
        }
        free_limits(&before);
        hs_reference_free(&r);
    }
    print_message("%llu vertices, %llu on creases, %llu smooth ones of valence 2: moved by %.2g of "
                  "the bounding box at most; %llu darts not looked at\n",
                  (unsigned long long)compared, (unsigned long long)creases,
                  (unsigned long long)valence_2, worst, (unsigned long long)darts);
    assert_true(creases > 100 && compared > 2 * creases && valence_2 > 0);
}

/* --- What leaves a replay --------------------------------------------------------------------- */

/* An odd generation has the positions of the next level, and the attributes which the even one
 * makes vertices of: what leaves in either has the same limit. */
static void vertices_leave_odd_and_even_generations_at_the_same_limit(void **state) {
    const samples *all = *state;
    uint64_t compared = 0;
    for (uint32_t i = 0; i < 2 * all->count; i++) {
        hs_reference r = new_reference(&all->item[i / 2].mesh, NULL, refined_modes[i % 2]), odd;
        const double size = box_size(&r);
        hs_error err;
        for (uint32_t level = 1; level <= (r.corners < 400 ? 2 : 1); level++) {
            step(&r, NULL);
            assert_true(hs_reference_copy(&odd, &r, &err));
            odd.limit = true;
            finish(&odd);
            assert_int_equal(odd.at_level, 0);
            step(&r, NULL);
            limits even = new_limits(&r);
            for (uint32_t v = 0; v < odd.vertices; v++) {
                const double d = largest_difference(odd.vertex[v].limit, even.position[v], 4);
                if (!(d <= 1e-13 * size))
                    fail_msg("%s, level %u: vertex %u differs by %g", all->item[i / 2].name, level,
                             v, d);
                compared++;
            }
            free_limits(&even);
            hs_reference_free(&odd);
        }
        hs_reference_free(&r);
    }
    assert_true(compared > 10000);
}

/* Two faces of a cube are refined. Its vertices leave at once, as final faces have them, but their
 * rings were whole; the new vertices are born with triangles, and never have a ring. */
static void vertices_without_a_ring_leave_where_they_are_and_are_counted(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    r.limit = true;
    const uint8_t decision[6] = {HS_REFERENCE_REFINED, 0, HS_REFERENCE_REFINED, 0, 0, 0};
    step(&r, decision);
    finish(&r);
    assert_int_equal(r.at_level, 2);
    for (uint32_t v = 0; v < 8; v++) /* (9 + 4 (1 + 1 - 1) + (1 - 1 - 1))/24 = 1/2 */
        for (int i = 0; i < 3; i++)
            assert_true(fabs(r.vertex[v].limit[i] - 0.5 * (v >> i & 1 ? 1 : -1)) < 1e-15);
    for (uint32_t v = 8; v < 10; v++)
        assert_memory_equal(r.vertex[v].limit, r.vertex[v].position, sizeof r.vertex[v].limit);
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* --- By hand ---------------------------------------------------------------------------------- */

/* A sphere's normals point away from its middle, whatever the homogeneous w of its vertices. */
static void normals_look_outward_in_projected_space(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    for (uint32_t i = 0; i < 4 * 8; i++)
        cube.position[i] *= i / 4 % 2 ? 0.5f : 2.0f; /* the same points, other weights */
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    for (int level = 0; level < 3; level++) {
        limits l = new_limits(&r);
        for (uint32_t i = 0; i < r.corners; i++) {
            const double *p = l.position[r.face_vertex[i]], *n = l.normal[i];
            assert_true(fabs(n[0] * n[0] + n[1] * n[1] + n[2] * n[2] - 1) < 1e-12);
            assert_true(n[0] * p[0] + n[1] * p[1] + n[2] * p[2] > 0);
        }
        free_limits(&l);
        two_steps(&r);
    }
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* A cube of which all edges are sharp for ever is a cube in the limit. */
static void a_sharp_cube_has_six_normals(void **state) {
    (void)state;
    hs_mesh cube;
    build_cube(&cube);
    make_taggable(&cube);
    memset(cube.sharpness, HS_SHARP_INFINITE, cube.halfedges);
    hs_reference r = new_reference(&cube, NULL, HS_BOUNDARY_SMOOTH);
    for (int level = 0; level < 3; level++) {
        limits l = new_limits(&r);
        for (uint32_t i = 0; i < r.corners; i++) {
            const double *n = l.normal[i];
            const double sum = fabs(n[0]) + fabs(n[1]) + fabs(n[2]);
            assert_true(fabs(sum - 1) < 1e-12);
        }
        for (uint32_t v = 0; v < 8; v++)
            assert_memory_equal(l.position[v], r.vertex[v].position, sizeof l.position[v]);
        free_limits(&l);
        two_steps(&r);
    }
    hs_reference_free(&r);
    hs_mesh_free(&cube);
}

/* Where the boundary is kept, and at faces that are not quads, vertices have no limit, but they
 * have a normal. */
static void without_a_whole_ring_a_vertex_stays_and_has_the_normal_of_its_fan(void **state) {
    (void)state;
    const float position[] = {0, 0, 0, 1, 8, 0, 0, 1, 8, 8, 0, 1, 0, 8, 0, 1};
    const uint32_t sides[] = {4}, corner[] = {0, 1, 2, 3};
    hs_mesh square;
    build(&square, "square", 4, position, 1, sides, corner);
    hs_reference r = new_reference(&square, NULL, HS_BOUNDARY_KEPT);
    limits l = new_limits(&r);
    for (uint32_t i = 0; i < 4; i++) {
        assert_memory_equal(l.position[i], r.vertex[i].position, sizeof l.position[i]);
        assert_true(l.normal[i][2] == 1);
    }
    free_limits(&l);
    step(&r, NULL);
    hs_error err = {0};
    double none[8][4];
    assert_false(hs_reference_limit(&r, none, NULL, &err));
    assert_non_null(strstr(err.text, "even"));
    hs_reference_free(&r);
    hs_mesh_free(&square);
}

static int make_limit_samples(void **state) {
    make_sharp_samples(state);
    add_files(*state);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(limits_and_normals_are_opensubdivs),
        cmocka_unit_test(refining_deeper_moves_no_vertex),
        cmocka_unit_test(vertices_leave_odd_and_even_generations_at_the_same_limit),
        cmocka_unit_test(vertices_without_a_ring_leave_where_they_are_and_are_counted),
        cmocka_unit_test(normals_look_outward_in_projected_space),
        cmocka_unit_test(a_sharp_cube_has_six_normals),
        cmocka_unit_test(without_a_whole_ring_a_vertex_stays_and_has_the_normal_of_its_fan),
    };
    return cmocka_run_group_tests_name("reference limit", tests, make_limit_samples, free_samples);
}
