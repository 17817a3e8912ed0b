/* SPDX-License-Identifier: Apache-2.0
 *
 * Golden does what docs/refinement.md says of depth, guard and capacity, and at the edges of what
 * meshes and numbers may be. Marks and decisions are in test_golden_rules.c, packets that were
 * tampered with in test_golden_hostile.c.
 */
#include "golden_state.h"
#include "reference_samples.h"
#include "view.h"

/* --- Runs, any failure of which ends the test ----------------------------------------------------
 */

static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};

typedef struct {
    hs_golden_report report;
    hs_output output;
} result;

/* Golden with room for everything, or with limits; observer may be NULL. */
static result run_limited(const hs_mesh *mesh, const float matrix[16], const hs_settings *settings,
                          hs_limits limits, const hs_observer *observer) {
    result r;
    hs_packet in = {0}, out = {0};
    hs_error err;
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    hs_golden_observe(golden, observer);
    if (!hs_packet_encode(&in, 5, mesh, matrix, settings, &err) ||
        !hs_golden_run(golden, &in, &out, &r.report, &err) ||
        !hs_output_decode(&r.output, &out, &err))
        fail_msg("%s", err.text);
    assert_int_equal(r.output.status, r.report.status);
    assert_int_equal(r.output.error_position, r.report.error_position);
    assert_int_equal(r.output.faces, r.report.faces);
    assert_int_equal(r.output.vertices, r.report.vertices);
    hs_packet_free(&in);
    hs_packet_free(&out);
    r.report.decision = NULL; /* it goes with the context */
    r.report.generation = NULL;
    hs_golden_free(golden);
    return r;
}

/* Position of the first vertex. */
enum { VERTICES_AT = 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS) };

static result run(const hs_mesh *mesh, const float matrix[16], const hs_settings *settings) {
    return run_limited(mesh, matrix, settings, (hs_limits){1 << 20, 1 << 20}, NULL);
}

static void expect_refusal(const hs_mesh *mesh, const float matrix[16], uint32_t status,
                           size_t position) {
    const hs_settings settings = {.uniform = true, .uniform_depth = 2};
    result r = run(mesh, matrix, &settings);
    assert_int_equal(r.report.status, status);
    assert_int_equal(r.report.error_position, position);
    assert_int_equal(r.output.faces, 0);
    hs_output_free(&r.output);
}

/* --- Depth, capacity, nothing to do
 * ------------------------------------------------------------------ */

static void refinement_ends_at_the_largest_depth_that_is_asked_for(void **state) {
    const hs_mesh *torus = &((const samples *)*state)->item[2].mesh;
    uint8_t forced[20] = {0};
    static const struct {
        uint8_t front, silhouette, forced, uniform, reached;
    } of[] = {{4, 6, 0, 0, 6}, {5, 2, 0, 0, 5}, {0, 0, 7, 0, 7}, {3, 4, 5, 0, 5},
              {0, 0, 0, 0, 0}, {9, 9, 9, 3, 3}, {0, 0, 0, 6, 6}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        hs_mesh mesh = *torus;
        memset(forced, of[i].forced, sizeof forced);
        mesh.forced = forced;
        const hs_settings settings = {.front_depth = of[i].front,
                                      .silhouette_depth = of[i].silhouette,
                                      .uniform_depth = of[i].uniform,
                                      .uniform = of[i].uniform != 0,
                                      .guard = true};
        result r = run(&mesh, perspective, &settings);
        assert_int_equal(r.output.generations, of[i].reached);
        assert_int_equal(r.report.generations, of[i].reached + 1);
        if (of[i].uniform) assert_int_equal(r.output.faces, 20u << of[i].uniform);
        hs_output_free(&r.output);
    }
}

static void expect_initial_mesh(const hs_mesh *mesh, const float matrix[16],
                                const hs_settings *settings, const char *name) {
    result r = run(mesh, matrix, settings);
    if (r.output.faces != mesh->faces || r.output.generations != 0)
        fail_msg("%s: %u faces", name, r.output.faces);
    assert_int_equal(r.report.status, HS_STATUS_OK);
    for (uint32_t f = 0; f < mesh->faces; f++) {
        assert_int_equal(r.output.first[f], mesh->first[f]);
        assert_int_equal(r.output.generation[f], 0);
        assert_int_equal(r.output.candidate[f], 1);
        for (uint32_t h = mesh->first[f]; h < mesh->first[f + 1]; h++)
            assert_int_equal(r.output.number[r.output.corner[h]], mesh->origin[h]);
    }
    hs_output_free(&r.output);
}

static void a_view_that_selects_nothing_gives_back_the_initial_mesh(void **state) {
    const samples *all = *state;
    const hs_settings none = {.guard = true}, no_steps = {.uniform = true};
    const hs_settings deep = {.front_depth = 4, .silhouette_depth = 8, .guard = true};
    for (uint32_t i = 0; i < all->count; i++) {
        const sample *s = &all->item[i];
        expect_initial_mesh(&s->mesh, perspective, &none, s->name);
        expect_initial_mesh(&s->mesh, perspective, &no_steps, s->name);
        /* An eye a million units away that looks the other way. */
        hs_view away;
        hs_error err;
        assert_true(hs_view_look(&away, (const double[3]){0, 0, 1e6}, (const double[3]){0, 0, 2e6},
                                 (const double[3]){0, 1, 0}, 60, 1, 1, 1e7, &err));
        expect_initial_mesh(&s->mesh, away.matrix, &deep, s->name);
    }
}

static void capacity_stops_refinement_at_exactly_its_limit(void **state) {
    const hs_mesh *torus = &((const samples *)*state)->item[2].mesh; /* 20 quads, 20 vertices */
    const hs_settings settings = {.uniform = true, .uniform_depth = 3};
    /* 80 vertices at generation 2, when 80 more are to come; 160 quads in generation 3. */
    static const struct {
        hs_limits limits;
        uint32_t status, faces, generation;
    } of[] = {
        {{160, 160}, HS_STATUS_OK, 160, 3},     {{159, 160}, HS_STATUS_STOPPED, 80, 2},
        {{160, 159}, HS_STATUS_STOPPED, 80, 2}, {{80, 80}, HS_STATUS_STOPPED, 80, 2},
        {{79, 160}, HS_STATUS_STOPPED, 40, 1},  {{39, 80}, HS_STATUS_STOPPED, 20, 0},
        {{1000, 80}, HS_STATUS_STOPPED, 80, 2}, {{20, 80}, HS_STATUS_STOPPED, 20, 0},
    };
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        result r = run_limited(torus, perspective, &settings, of[i].limits, NULL);
        assert_int_equal(r.report.status, of[i].status);
        assert_int_equal(r.output.faces, of[i].faces);
        assert_int_equal(r.output.vertices, of[i].faces); /* as of any torus of quads */
        assert_int_equal(r.output.generations, of[i].generation);
        for (uint32_t f = 0; f < r.output.faces; f++)
            assert_int_equal(r.output.generation[f], of[i].generation);
        hs_output_free(&r.output);
    }
    /* The mesh itself: 20 vertices, 80 corners. */
    result r = run_limited(torus, perspective, &settings, (hs_limits){19, 80}, NULL);
    assert_int_equal(r.report.status, HS_STATUS_CAPACITY_VERTICES);
    assert_int_equal(r.report.error_position, 3);
    hs_output_free(&r.output);
    r = run_limited(torus, perspective, &settings, (hs_limits){20, 79}, NULL);
    assert_int_equal(r.report.status, HS_STATUS_CAPACITY_CORNERS);
    assert_int_equal(r.report.error_position, 5);
    hs_output_free(&r.output);
    assert_null(hs_golden_new((hs_limits){(1 << 24) + 1, 1}));
}

/* A stopped view shows what the same view shows with less depth. */
static void a_stopped_view_is_a_shallower_one(void **state) {
    const hs_mesh *torus = &((const samples *)*state)->item[2].mesh;
    const hs_settings deep = {.uniform = true, .uniform_depth = 9};
    const hs_settings shallow = {.uniform = true, .uniform_depth = 4};
    result a = run_limited(torus, perspective, &deep, (hs_limits){400, 400}, NULL);
    result b = run(torus, perspective, &shallow);
    assert_int_equal(a.report.status, HS_STATUS_STOPPED);
    assert_int_equal(a.output.faces, b.output.faces);
    assert_memory_equal(a.output.number, b.output.number, 4 * (size_t)b.output.vertices);
    assert_memory_equal(a.output.position, b.output.position, 16 * (size_t)b.output.vertices);
    hs_output_free(&a.output);
    hs_output_free(&b.output);
}

static int by_number(const void *a, const void *b) {
    const row *x = a, *y = b;
    return memcmp(x, y, sizeof *x);
}

/* The rows of a run's quads, each from its smallest vertex on. */
static row *rows_of(const hs_output *o) {
    row *rows = new_rows(o->faces);
    for (uint32_t f = 0; f < o->faces; f++) {
        uint32_t best = 0;
        for (uint32_t i = 1; i < 4; i++)
            if (o->number[o->corner[4 * f + i]] < o->number[o->corner[4 * f + best]]) best = i;
        for (uint32_t i = 0; i < 4; i++)
            rows[f].key[i] = o->number[o->corner[4 * f + (best + i) % 4]];
        rows[f].value = o->generation[f];
    }
    qsort(rows, o->faces, sizeof *rows, by_number);
    return rows;
}

/* The last step's quads leave at once, among generation D-1's faces, without being stored. Stopped
 * by a capacity right behind that step, the same quads leave from memory. */
static void the_last_step_sends_what_it_would_have_stored(void **state) {
    const hs_mesh *torus = &((const samples *)*state)->item[2].mesh;
    for (uint8_t depth = 1; depth < 6; depth++) {
        const hs_settings at = {.uniform = true, .uniform_depth = depth};
        const hs_settings beyond = {.uniform = true, .uniform_depth = (uint8_t)(depth + 1)};
        result a = run(torus, perspective, &at);
        result b =
            run_limited(torus, perspective, &beyond, (hs_limits){1 << 20, 20u << depth}, NULL);
        assert_int_equal(b.report.status,
                         depth == 1 ? HS_STATUS_CAPACITY_CORNERS : HS_STATUS_STOPPED);
        if (depth > 1) {
            row *x = rows_of(&a.output), *y = rows_of(&b.output);
            assert_int_equal(a.output.faces, b.output.faces);
            assert_memory_equal(x, y, a.output.faces * sizeof *x);
            assert_memory_equal(a.output.position, b.output.position,
                                16 * (size_t)a.output.vertices);
            free(x);
            free(y);
        }
        hs_output_free(&a.output);
        hs_output_free(&b.output);
    }
}

/* --- Shapes at the limits
 * ------------------------------------------------------------------------------- */

/* n vertices around, and one above and below: two n-gons and n quads (prism), or 2n triangles. */
static void make_round(hs_mesh *mesh, uint32_t n, bool prism) {
    *mesh = (hs_mesh){
        .vertices = prism ? 2 * n : n + 2, .faces = prism ? n + 2 : 2 * n, .halfedges = 6 * n};
    mesh->position = calloc(mesh->vertices, 16);
    mesh->first = calloc(mesh->faces + 1u, 4);
    mesh->origin = calloc(mesh->halfedges, 4);
    mesh->twin = calloc(mesh->halfedges, 4);
    mesh->face = calloc(mesh->halfedges, 4);
    assert_true(mesh->position && mesh->first && mesh->origin && mesh->twin && mesh->face);
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        const double a = 2 * M_PI * (v % n) / n;
        const bool apex = !prism && v >= n;
        float *p = mesh->position + 4 * v;
        p[0] = apex ? 0 : (float)cos(a);
        p[1] = apex ? 0 : (float)sin(a);
        p[2] = v < n && !prism ? 0 : v == n || (prism && v > n) ? 1 : -1;
        p[3] = 1;
    }
    uint32_t f = 0, h = 0;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n;
        if (prism) { /* quad i, j, j', i' with i below, i' = n + i above */
            const uint32_t corner[4] = {i, j, n + j, n + i};
            mesh->first[f++] = h;
            memcpy(mesh->origin + h, corner, sizeof corner);
            mesh->twin[h] = 4 * n + (n - 1 - i); /* below: runs backwards */
            mesh->twin[h + 1] = 4 * j + 3;
            mesh->twin[h + 2] = 5 * n + i;
            mesh->twin[h + 3] = 4 * ((i + n - 1) % n) + 1;
            h += 4;
        } else { /* triangles i, j, above and j, i, below */
            const uint32_t corner[6] = {i, j, n, j, i, n + 1};
            const uint32_t before = 6 * ((i + n - 1) % n), after = 6 * j;
            const uint32_t twin[6] = {h + 3, after + 2, before + 1, h, before + 5, after + 4};
            mesh->first[f++] = h;
            mesh->first[f++] = h + 3;
            memcpy(mesh->origin + h, corner, sizeof corner);
            memcpy(mesh->twin + h, twin, sizeof twin);
            h += 6;
        }
    }
    if (prism) { /* below: n-1 .. 0, whose half-edge k runs from vertex n-k (mod n) to n-1-k */
        mesh->first[f++] = h;
        for (uint32_t k = 0; k < n; k++, h++) {
            mesh->origin[h] = (n - k) % n;
            mesh->twin[h] = 4 * (n - 1 - k);
        }
        mesh->first[f++] = h;
        for (uint32_t k = 0; k < n; k++, h++) {
            mesh->origin[h] = n + k;
            mesh->twin[h] = 4 * k + 2;
        }
    }
    mesh->first[f] = h;
    for (f = 0; f < mesh->faces; f++)
        for (h = mesh->first[f]; h < mesh->first[f + 1]; h++)
            mesh->face[h] = f;
}

static void faces_of_255_sides_are_refined(void **state) {
    (void)state;
    hs_mesh mesh;
    make_round(&mesh, 255, true);
    const hs_settings settings = {.uniform = true, .uniform_depth = 2};
    result r = run(&mesh, perspective, &settings);
    assert_int_equal(r.report.status, HS_STATUS_OK);
    assert_int_equal(r.output.faces, mesh.halfedges);
    hs_output_free(&r.output);
    const hs_settings none = {.uniform = true}; /* and leave whole */
    r = run(&mesh, perspective, &none);
    assert_int_equal(r.output.faces, 257);
    assert_int_equal(r.output.first[257] - r.output.first[256], 255);
    hs_output_free(&r.output);
    hs_mesh_free(&mesh);
}

static void valence_255_is_accepted_and_256_refused_at_its_corner(void **state) {
    (void)state;
    hs_mesh mesh;
    make_round(&mesh, 255, false);
    const hs_settings settings = {.uniform = true, .uniform_depth = 4};
    result r = run(&mesh, perspective, &settings);
    assert_int_equal(r.report.status, HS_STATUS_OK);
    assert_int_equal(r.output.faces, 4 * mesh.halfedges);
    hs_output_free(&r.output);
    hs_mesh_free(&mesh);

    make_round(&mesh, 256, false); /* its last triangle but one is the 256th above */
    expect_refusal(&mesh, perspective, HS_STATUS_BAD_VALENCE,
                   VERTICES_AT + 4 * (mesh.vertices + 6 * 255 + 2));
    hs_mesh_free(&mesh);
}

/* Every vertex that was sent: where it was then. */
typedef struct {
    int32_t (*position)[4];
    uint8_t *known;
    uint64_t compared;
} resting;

static void check_rest(void *context, const hs_state *s) {
    resting *r = context;
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (!s->sent[v]) continue;
        if (r->known[v] && (s->mark[v] & MARK_ACTIVE)) {
            if (memcmp(r->position[v], s->position[v], 16) != 0)
                fail_msg("vertex %u moved in generation %u", v, s->generation);
            r->compared++;
        }
        if (!r->known[v]) memcpy(r->position[v], s->position[v], 16);
        r->known[v] = 1;
    }
}

/* Two surfaces that touch in a vertex: when one of them is final there, the other one may not pull
 * at it. Vertex 0 of two tetrahedra is the same; only the first is refined. */
static void what_was_sent_never_moves_again(void **state) {
    (void)state;
    static const float position[7][4] = {{0, 0, 0, 1},  {1, 0, 0, 1},  {0, 1, 0, 1}, {0, 0, 1, 1},
                                         {-1, 0, 0, 1}, {0, -1, 0, 1}, {0, 0, -1, 1}};
    /* Tetrahedron a, b, c, d: faces bcd, acb... each edge once in each direction. */
    static const uint32_t origin[24] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3,
                                        0, 5, 4, 0, 4, 6, 0, 6, 5, 4, 5, 6};
    uint32_t twin[24], first[9], face[24];
    uint8_t forced[8] = {8, 8, 8, 8, 0, 0, 0, 0};
    hs_mesh mesh = {.vertices = 7,
                    .faces = 8,
                    .halfedges = 24,
                    .first = first,
                    .twin = twin,
                    .face = face,
                    .forced = forced};
    mesh.position = malloc(sizeof position);
    mesh.origin = malloc(sizeof origin);
    memcpy(mesh.position, position, sizeof position);
    memcpy(mesh.origin, origin, sizeof origin);
    for (uint32_t h = 0; h < 24; h++) {
        face[h] = h / 3;
        first[h / 3] = h / 3 * 3;
    }
    first[8] = 24;
    for (uint32_t h = 0; h < 24; h++)
        for (uint32_t t = 0; t < 24; t++)
            if (origin[t] == origin[hs_next(&mesh, h)] && origin[h] == origin[hs_next(&mesh, t)])
                twin[h] = t;
    for (int guard = 0; guard < 2; guard++) {
        const hs_settings settings = {.guard = guard};
        resting r = {.position = calloc(1 << 16, 16), .known = calloc(1 << 16, 1)};
        result of = run_limited(&mesh, identity, &settings, (hs_limits){1 << 16, 1 << 16},
                                &(hs_observer){.context = &r, .decided = check_rest});
        assert_int_equal(of.report.status, HS_STATUS_OK);
        assert_true(of.output.faces > 100 && r.compared > 0);
        hs_output_free(&of.output);
        free(r.position);
        free(r.known);
    }
    free(mesh.position);
    free(mesh.origin);
}

/* One face w, v, w, u, sewn up along both its edges: v and u have one face each. */
static void a_vertex_of_valence_1_stays(void **state) {
    (void)state;
    float position[12] = {1, 1, 1, 1, -1, -1, -1, 1, -0.5f, -1, 1, 1};
    uint32_t first[2] = {0, 4}, origin[4] = {0, 1, 0, 2}, twin[4] = {1, 0, 3, 2}, face[4] = {0};
    const hs_mesh mesh = {.vertices = 3,
                          .faces = 1,
                          .halfedges = 4,
                          .position = position,
                          .first = first,
                          .origin = origin,
                          .twin = twin,
                          .face = face};
    const hs_settings settings = {.uniform = true, .uniform_depth = 5};
    result r = run(&mesh, identity, &settings);
    assert_int_equal(r.report.status, HS_STATUS_OK);
    assert_int_equal(r.output.faces, 2 << 4);
    for (uint32_t i = 0; i < r.output.vertices; i++)
        if (r.output.number[i] == 1 || r.output.number[i] == 2)
            assert_memory_equal(r.output.position + 4 * i, position + 4 * r.output.number[i], 16);
    hs_output_free(&r.output);
}

/* --- Numbers at the limits
 * --------------------------------------------------------------------------------- */

/* A triangle with the given numbers as its twelve components, through the identity or a matrix. */
static result run_triangle(const float component[12], const float matrix[16]) {
    const uint32_t sides = 3, corner[3] = {0, 1, 2};
    hs_mesh mesh;
    build(&mesh, "triangle", 3, component, 1, &sides, corner);
    const hs_settings settings = {.uniform = true};
    result r = run(&mesh, matrix, &settings);
    hs_mesh_free(&mesh);
    return r;
}

static uint32_t bits_of(float x) {
    uint32_t bits;
    memcpy(&bits, &x, sizeof bits);
    return bits;
}

static void minus_zero_leaves_as_plus_zero(void **state) {
    (void)state;
    float minus[16];
    for (int i = 0; i < 16; i++)
        minus[i] = -0.0f;
    minus[0] = minus[5] = minus[10] = minus[15] = 1;
    const float component[12] = {-0.0f, 1, 1, 1, 1, -1e-30f, 1, 1, 1, 1, -0.0f, 1};
    assert_int_equal(bits_of((minus[0] * component[0] + minus[1] * component[1]) +
                             (minus[2] * component[2] + minus[3] * component[3])),
                     0x80000000); /* it is there to be lost */
    result r = run_triangle(component, minus);
    for (uint32_t i = 0; i < 12; i++)
        assert_int_equal(bits_of(r.output.position[i]),
                         component[i] > 0 ? bits_of(component[i]) : 0);
    hs_output_free(&r.output);
}

static void a_mesh_of_zeros_has_the_exponent_zero(void **state) {
    (void)state;
    const float zero[12] = {0};
    result r = run_triangle(zero, identity);
    assert_int_equal(r.report.status, HS_STATUS_OK);
    assert_int_equal(r.output.exponent, 0);
    assert_memory_equal(r.output.position, zero, sizeof zero);
    hs_output_free(&r.output);

    const hs_mesh *torus = &((const samples *)*state)->item[2].mesh; /* and can be refined */
    const float nothing[16] = {0};
    const hs_settings settings = {.front_depth = 4, .silhouette_depth = 4, .guard = true};
    r = run(torus, nothing, &settings);
    assert_int_equal(r.report.status, HS_STATUS_OK);
    assert_int_equal(r.output.exponent, 0);
    hs_output_free(&r.output);
}

static void blocks_reach_from_the_smallest_subnormal_to_the_largest_number(void **state) {
    (void)state;
    static const struct {
        float largest;
        int exponent;
    } of[] = {{0x1p-149f, -148},      {0x1.8p-148f, -147}, {0x1.fffffcp-127f, -126},
              {0x1p-126f, -125},      {0.5f, 0},           {1, 1},
              {0x1.fffffep127f, 128}, {0x1p127f, 128}};
    for (size_t i = 0; i < sizeof of / sizeof *of; i++) {
        for (int sign = -1; sign <= 1; sign += 2) {
            const float c = (float)sign * of[i].largest;
            const float component[12] = {c, c / 2, c / 4, c, 0, c, 0, c, c, 0, c, c / 2};
            result r = run_triangle(component, identity);
            assert_int_equal(r.report.status, HS_STATUS_OK);
            assert_int_equal(r.output.exponent, of[i].exponent);
            for (int k = 0; k < 12; k++) /* exact: 24 bits of a block of 30 */
                assert_true(r.output.position[k] == component[k]);
            hs_output_free(&r.output);
        }
    }
}

static void rows_that_overflow_are_refused_at_their_word(void **state) {
    const hs_mesh *torus = &((const samples *)*state)->item[2].mesh;
    for (uint32_t row = 0; row < 4; row++) {
        float matrix[16];
        memcpy(matrix, identity, sizeof matrix);
        matrix[4 * row] = matrix[4 * row + 3] = 0x1.8p127f;
        hs_mesh mesh = *torus; /* x <= 0.25 everywhere but at vertex 11 */
        mesh.position = malloc(16 * (size_t)mesh.vertices);
        memcpy(mesh.position, torus->position, 16 * (size_t)mesh.vertices);
        for (uint32_t v = 0; v < mesh.vertices; v++)
            mesh.position[4 * v] = v == 11 ? 0.5f : v == 15 ? 3 : 0.25f;
        expect_refusal(&mesh, matrix, HS_STATUS_OVERFLOW, VERTICES_AT + 4 * 11 + row);
        mesh.position[4 * 7 + 2] = INFINITY;
        expect_refusal(&mesh, matrix, HS_STATUS_BAD_NUMBER, VERTICES_AT + 4 * 7 + 2);
        matrix[9] = NAN;
        expect_refusal(&mesh, matrix, HS_STATUS_BAD_NUMBER, 4 * HS_HEADER_RECORDS + 9);
        free(mesh.position);
    }
}

/* --- Guard
 * ----------------------------------------------------------------------------------------------------
 */

static void the_guard_refines_more(void **state) {
    const samples *all = *state;
    uint32_t larger = 0;
    for (uint32_t i = 0; i < all->count; i++) {
        const hs_mesh *mesh = &all->item[i].mesh;
        hs_settings settings = {.front_depth = 1, .silhouette_depth = 1};
        result without = run(mesh, perspective, &settings);
        settings.guard = true;
        result with = run(mesh, perspective, &settings);
        /* One step: every refined face has made a vertex. */
        assert_true(with.output.vertices >= without.output.vertices);
        larger += with.output.vertices > without.output.vertices;
        hs_output_free(&with.output);
        hs_output_free(&without.output);
    }
    assert_true(larger > 2);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refinement_ends_at_the_largest_depth_that_is_asked_for),
        cmocka_unit_test(a_view_that_selects_nothing_gives_back_the_initial_mesh),
        cmocka_unit_test(capacity_stops_refinement_at_exactly_its_limit),
        cmocka_unit_test(a_stopped_view_is_a_shallower_one),
        cmocka_unit_test(the_last_step_sends_what_it_would_have_stored),
        cmocka_unit_test(faces_of_255_sides_are_refined),
        cmocka_unit_test(valence_255_is_accepted_and_256_refused_at_its_corner),
        cmocka_unit_test(what_was_sent_never_moves_again),
        cmocka_unit_test(a_vertex_of_valence_1_stays),
        cmocka_unit_test(minus_zero_leaves_as_plus_zero),
        cmocka_unit_test(a_mesh_of_zeros_has_the_exponent_zero),
        cmocka_unit_test(blocks_reach_from_the_smallest_subnormal_to_the_largest_number),
        cmocka_unit_test(rows_that_overflow_are_refused_at_their_word),
        cmocka_unit_test(the_guard_refines_more),
    };
    return cmocka_run_group_tests_name("golden", tests, make_samples, free_samples);
}
