/* SPDX-License-Identifier: Apache-2.0
 *
 * The whole RTL against golden, output word for output word: every built-in shape from sixteen
 * views, uniform refinement, stalls, what was streamed before, forced depths, boundaries, extreme
 * numbers, capacities. A difference names view, generation, vertex or face, and both words.
 * HS_CASES=10 makes the random parts ten times as long.
 */
#include "rtl_samples.h"

#include "obj.h"

/* --- Shapes and views ----------------------------------------------------------------------------
 */

static void every_shape_from_every_view_is_goldens_word_for_word(void **state) {
    bench *b = *state;
    const uint64_t words = b->words;
    uint32_t views = 0, shapes = 0;
    uint64_t refined = 0, kept = 0;
    for (const hs_shape *shape = hs_shapes; shape->name; shape++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        shapes++;
        make_shape(&mesh, shape->name, 0, 1);
        make_views(&mesh, view);
        for (uint32_t v = 0; v < VIEWS; v++)
            for (uint32_t guard = 0; guard < 2; guard++) {
                char what[200];
                const hs_settings settings = adaptive(4, 8, guard != 0);
                snprintf(what, sizeof what, "%s, %s, 4/8, guard %u", shape->name, view_name[v],
                         guard);
                assert_same_view(b, v, &mesh, view[v].matrix, &settings, no_stalls, what);
                if (b->golden_report.faces > mesh.faces)
                    refined++;
                else
                    kept++;
                views++;
            }
        hs_mesh_free(&mesh);
    }
    print_message("compared %u views, %llu words; %llu views refined something, %llu nothing\n",
                  views, (unsigned long long)(b->words - words), (unsigned long long)refined,
                  (unsigned long long)kept);
    assert_int_equal(views, shapes * VIEWS * 2);
    assert_true(shapes >= 9);
    assert_true(refined > views / 2);
    assert_true(kept > 0);
}

static void uniform_refinement_is_goldens_word_for_word(void **state) {
    bench *b = *state;
    const uint64_t words = b->words;
    for (const hs_shape *shape = hs_shapes; shape->name; shape++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, shape->name, 0, 2);
        make_views(&mesh, view);
        for (uint8_t depth = 0; depth <= 6; depth++) {
            char what[200];
            const hs_settings settings = uniform(depth);
            snprintf(what, sizeof what, "%s, uniform %u", shape->name, depth);
            assert_same_view(b, depth, &mesh, view[depth + 3].matrix, &settings, no_stalls, what);
            assert_int_equal(b->golden_report.status, HS_STATUS_OK);
        }
        hs_mesh_free(&mesh);
    }
    print_message("compared %llu words\n", (unsigned long long)(b->words - words));
    assert_true(b->words - words > 100000);
}

/* Depths from 0 to 11 for front and silhouette, in any combination. */
static void every_pair_of_depths_is_goldens_word_for_word(void **state) {
    bench *b = *state;
    hs_mesh mesh;
    hs_view view[VIEWS];
    make_shape(&mesh, "mixed", 0, 1);
    make_views(&mesh, view);
    uint64_t random = 3;
    for (uint8_t front = 0; front < 6; front++)
        for (uint8_t silhouette = 0; silhouette < 12; silhouette++) {
            char what[200];
            const uint32_t v = random_below(&random, VIEWS);
            const hs_settings settings = adaptive(front, silhouette, random_below(&random, 2) != 0);
            snprintf(what, sizeof what, "mixed, %s, %u/%u, guard %d", view_name[v], front,
                     silhouette, settings.guard);
            assert_same_view(b, v, &mesh, view[v].matrix, &settings, no_stalls, what);
        }
    hs_mesh_free(&mesh);
}

/* --- Stalls, order, initial contents
 * ---------------------------------------------------------------
 */

static void stalls_on_either_side_change_no_word(void **state) {
    bench *b = *state;
    static const uint8_t percent[][2] = {{90, 0},  {0, 90},  {50, 50}, {90, 90},
                                         {10, 70}, {70, 10}, {30, 0},  {0, 30}};
    static const char *const name[] = {"cube", "mixed", "grid", "tetrahedron"};
    uint64_t random = 7, slower = 0;
    for (uint32_t i = 0; i < cases(32); i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, name[i % 4], 0, 1);
        make_views(&mesh, view);
        const uint32_t v = random_below(&random, VIEWS);
        const hs_settings settings =
            i % 3 == 0 ? uniform((uint8_t)(i % 5)) : adaptive(4, 7, i % 2 == 0);
        char what[200];
        snprintf(what, sizeof what, "%s, %s, without stalls", name[i % 4], view_name[v]);
        assert_same_view(b, i, &mesh, view[v].matrix, &settings, no_stalls, what);
        const uint64_t cycles = b->rtl_report.cycles;
        const hs_stalls stalls = {
            .seed = i * 77 + 1, .input = percent[i / 4 % 8][0], .output = percent[i / 4 % 8][1]};
        snprintf(what, sizeof what, "%s, %s, stalls %u in, %u out, seed %u", name[i % 4],
                 view_name[v], stalls.input, stalls.output, stalls.seed);
        assert_same_view(b, i, &mesh, view[v].matrix, &settings, stalls, what);
        slower += b->rtl_report.cycles > cycles;
        hs_mesh_free(&mesh);
    }
    assert_true(slower > cases(32) / 2); /* else they were no stalls */
}

/* The same view first, in the midst of others, after a refused one, and in a pipeline whose
 * registers and memories began with other contents. */
static void neither_order_nor_initial_contents_change_a_word(void **state) {
    (void)state;
    static const char *const name[] = {"cube", "grid", "mixed", "icosahedron", "tetrahedron"};
    hs_packet packet[20] = {0};
    uint64_t random = 1;
    hs_error err;
    for (uint32_t i = 0; i < 20; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, name[i % 5], 0, 1);
        make_views(&mesh, view);
        const hs_settings settings = i % 4 == 1 ? uniform((uint8_t)(i % 6)) : adaptive(3, 6, i & 2);
        assert_true(hs_packet_encode(&packet[i], i, &mesh,
                                     view[random_below(&random, VIEWS)].matrix, &settings, &err));
        if (i % 7 == 6) packet[i].word[i] ^= 1u << 30; /* refused */
        hs_mesh_free(&mesh);
    }
    for (uint32_t seed = 1; seed <= 5; seed++) {
        bench *b = new_bench(HS_DEFAULT_LIMITS, seed);
        for (uint32_t i = 0; i < 20; i++) {
            const uint32_t p = seed == 1 ? i : random_below(&random, 20);
            char what[100];
            snprintf(what, sizeof what, "seed %u, packet %u of the order", seed, i);
            assert_same_words(b, &packet[p], no_stalls, what);
        }
        free_bench(b);
    }
    for (uint32_t i = 0; i < 20; i++)
        hs_packet_free(&packet[i]);
}

/* --- Forced depths, boundaries, extreme meshes
 * ------------------------------------------------------
 */

static void forced_depths_are_goldens_word_for_word(void **state) {
    bench *b = *state;
    static const char *const name[] = {"grid", "cube", "mixed", "torus"};
    uint64_t random = 11;
    uint32_t deepest = 0;
    for (uint32_t i = 0; i < cases(24); i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, name[i % 4], i % 4 == 1 ? 3 : 0, 1);
        make_views(&mesh, view);
        const uint32_t most = 1 + random_below(&random, 8);
        for (uint32_t f = 0; f < mesh.faces; f++) /* regions of faces, and single ones */
            mesh.forced[f] =
                (uint8_t)(i < 12 ? most * (f / 8 % 3) / 2 : random_below(&random, most));
        const hs_settings settings =
            i % 5 == 4 ? uniform(3) : adaptive((uint8_t)(i % 4), (uint8_t)(i % 6), i & 1);
        const uint32_t v = random_below(&random, VIEWS);
        char what[200];
        snprintf(what, sizeof what, "%s, forced to %u, case %u, %s", name[i % 4], most, i,
                 view_name[v]);
        assert_same_view(b, i, &mesh, view[v].matrix, &settings, no_stalls, what);
        if (b->golden_report.generations > deepest) deepest = b->golden_report.generations;
        hs_mesh_free(&mesh);
    }
    assert_true(deepest >= 7);
}

static void check_views(bench *b, hs_mesh *mesh, const char *name, uint32_t step, uint8_t front,
                        uint8_t silhouette, uint8_t depth) {
    hs_view view[VIEWS];
    char what[200];
    make_views(mesh, view);
    for (uint32_t v = 0; v < VIEWS; v += step) {
        const hs_settings settings = adaptive(front, silhouette, v / step % 2 == 0);
        snprintf(what, sizeof what, "%s, %s, %u/%u", name, view_name[v], front, silhouette);
        assert_same_view(b, v, mesh, view[v].matrix, &settings, no_stalls, what);
    }
    for (uint8_t d = 0; d <= depth; d++) {
        const hs_settings settings = uniform(d);
        snprintf(what, sizeof what, "%s, uniform %u", name, d);
        assert_same_view(b, d, mesh, view[d].matrix, &settings, no_stalls, what);
    }
}

static void open_meshes_keep_their_boundary_as_goldens_do(void **state) {
    bench *b = *state;
    hs_mesh mesh;
    for (uint32_t size = 1; size <= 3; size++) {
        char name[40];
        snprintf(name, sizeof name, "grid of %u", size);
        make_shape(&mesh, "grid", size, 0);
        check_views(b, &mesh, name, 3, 3, 6, 5);
        hs_mesh_free(&mesh);
    }
    /* Lone faces: their last step leaves no quad. Two triangles: one quad. */
    float position[4 * HS_MAX_SIDES];
    uint32_t corner[HS_MAX_SIDES];
    make_ring(position, HS_MAX_SIDES, false);
    for (uint32_t i = 0; i < HS_MAX_SIDES; i++)
        corner[i] = i;
    for (uint32_t n = 3; n <= HS_MAX_SIDES; n = n < 9 ? n + 1 : n + 82) {
        char name[40];
        snprintf(name, sizeof name, "a lone face of %u sides", n);
        make_soup(&mesh, HS_MAX_SIDES, position, 1, &n, corner);
        check_views(b, &mesh, name, 5, 2, 3, 3);
        hs_mesh_free(&mesh);
    }
    const uint32_t sides[4] = {3, 3, 5, 3}, strip[14] = {0, 1, 2, 2, 1, 3, 2, 3, 4, 5, 6, 7, 8, 9};
    make_soup(&mesh, 10, position, 2, sides, strip);
    check_views(b, &mesh, "two triangles", 3, 3, 4, 4);
    hs_mesh_free(&mesh);
    make_soup(&mesh, 10, position, 4, sides, strip);
    check_views(b, &mesh, "a fan and a stray triangle", 3, 3, 4, 4);
    hs_mesh_free(&mesh);
}

static void the_most_sides_and_the_highest_valence_are_goldens_word_for_word(void **state) {
    bench *b = *state;
    static const uint32_t counts[] = {3, 4, 5, 16, 17, 254, 255};
    for (size_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        hs_mesh mesh;
        char name[60];
        snprintf(name, sizeof name, "pillow of two faces of %u sides", counts[i]);
        make_pillow(&mesh, counts[i]);
        check_views(b, &mesh, name, 4, 3, 5, 4);
        hs_mesh_free(&mesh);
        snprintf(name, sizeof name, "bicone with valence %u", counts[i]);
        make_bicone(&mesh, counts[i]);
        check_views(b, &mesh, name, 4, 3, 5, 4);
        hs_mesh_free(&mesh);
    }
}

static void bodies_apart_are_goldens_word_for_word(void **state) {
    hs_mesh mesh;
    make_two_bodies(&mesh);
    check_views(*state, &mesh, "two bodies", 1, 4, 8, 6);
    hs_mesh_free(&mesh);
}

/* --- Numbers
 * --------------------------------------------------------------------------------------
 */

static float power(int exponent) {
    return (float)ldexp(1, exponent);
}

/* A cube whose largest component is just below, at and above powers of two, from the smallest
 * subnormal number to the largest finite one. */
static void every_block_exponent_is_goldens_word_for_word(void **state) {
    bench *b = *state;
    static const int exponents[] = {-149, -148, -147, -127, -126, -125, -30,
                                    -1,   0,    1,    30,   126,  127};
    int32_t least = INT32_MAX, most = INT32_MIN;
    for (size_t i = 0; i < sizeof exponents / sizeof *exponents; i++)
        for (uint32_t kind = 0; kind < 4; kind++) {
            hs_mesh mesh;
            make_shape(&mesh, i % 2 ? "tetrahedron" : "cube", 0, 0);
            const float scale = power(exponents[i]);
            for (uint32_t k = 0; k < 4 * mesh.vertices; k++) {
                float *c = &mesh.position[k];
                if (k % 4 == 3) continue;
                *c = *c * scale;
                if (kind == 1) *c = nextafterf(*c, 0);
                if (kind == 2) *c = nextafterf(*c, *c > 0 ? 3e38f : -3e38f);
                if (kind == 3) *c = *c * 0.3f; /* subnormal numbers are rounded */
            }
            for (uint32_t v = 0; v < mesh.vertices; v++)
                mesh.position[4 * v + 3] = v % 3 ? -0.0f : fminf(scale, 1);
            for (uint32_t mode = 0; mode < 2; mode++) {
                char what[100];
                const hs_settings settings = mode ? adaptive(3, 4, true) : uniform(3);
                snprintf(what, sizeof what, "components about 2^%d, kind %u", exponents[i], kind);
                assert_same_view(b, kind, &mesh, identity, &settings, no_stalls, what);
                if (b->golden_report.exponent < least) least = b->golden_report.exponent;
                if (b->golden_report.exponent > most) most = b->golden_report.exponent;
            }
            hs_mesh_free(&mesh);
        }
    assert_int_equal(least, -148);
    assert_int_equal(most, 128);
}

/* A lone triangle beyond one plane of the view volume, but for a corner that lies just on it: it is
 * in view, and no longer so with the corner moved out by a unit in the last place. */
static void a_face_that_touches_the_view_volume_from_outside_is_in_view(void **state) {
    bench *b = *state;
    for (uint32_t i = 0; i < 6 * 3 * 2; i++) {
        const uint32_t axis = i / 2 % 3, touching = i / 6 % 3, beyond = i / 18;
        const float sign = i % 2 ? -1 : 1, near = beyond ? nextafterf(1, 2) : 1;
        float p[12];
        for (uint32_t v = 0; v < 3; v++) {
            p[4 * v] = v == 1 ? 0.75f : 0.25f * (float)v;
            p[4 * v + 1] = v == 2 ? 0.75f : 0.25f * (float)v;
            p[4 * v + 2] = 0;
            p[4 * v + 3] = 1;
            p[4 * v + axis] = sign * (v == touching ? near : 1.5f);
        }
        const float area = (p[4] - p[0]) * (p[9] - p[1]) - (p[8] - p[0]) * (p[5] - p[1]);
        const uint32_t sides = 3, corner[3] = {0, area > 0 ? 1 : 2, area > 0 ? 2 : 1};
        const hs_settings settings = adaptive(1, 0, true);
        char what[100];
        hs_mesh mesh;
        make_soup(&mesh, 3, p, 1, &sides, corner);
        snprintf(what, sizeof what, "axis %u, sign %g, corner %u, %s", axis, (double)sign, touching,
                 beyond ? "beyond the plane" : "on the plane");
        assert_same_view(b, i, &mesh, identity, &settings, no_stalls, what);
        if (b->golden_report.faces != (beyond ? 1 : 3))
            fail_msg("%s: %u faces", what, b->golden_report.faces);
        hs_mesh_free(&mesh);
    }
}

static void zero_and_degenerate_positions_are_goldens_word_for_word(void **state) {
    bench *b = *state;
    const float zero[16] = {0};
    const float minus_zero[16] = {-0.0f, -0.0f, -0.0f, -0.0f, 0, -0.0f, 0, 0,
                                  -0.0f, 0,     0,     0,     0, 0,     0, 1};
    const float *const matrix[] = {zero, minus_zero, identity};
    for (uint32_t m = 0; m < 3; m++)
        for (uint32_t kind = 0; kind < 4; kind++) {
            hs_mesh mesh;
            char what[100];
            make_shape(&mesh, kind & 1 ? "mixed" : "cube", 0, 0);
            for (uint32_t k = 0; k < 4 * mesh.vertices && kind >= 2; k++) {
                if (m == 0) mesh.position[k] = -0.0f;
                if (m == 2) mesh.position[k] = k % 4 ? 1 : -1; /* all in one point */
            }
            for (uint32_t mode = 0; mode < 2; mode++) {
                const hs_settings settings = mode ? adaptive(4, 5, kind & 1) : uniform(4);
                snprintf(what, sizeof what, "matrix %u, kind %u, mode %u", m, kind, mode);
                assert_same_view(b, kind, &mesh, matrix[m], &settings, no_stalls, what);
            }
            hs_mesh_free(&mesh);
        }
}

/* Positions of full precision in all four components, w of either sign: every rounding and every
 * sign of a determinant gets its turn. */
static void random_positions_and_matrices_are_goldens_word_for_word(void **state) {
    bench *b = *state;
    uint64_t random = 2024;
    for (uint32_t i = 0; i < cases(60); i++) {
        hs_mesh mesh;
        float matrix[16];
        char what[100];
        make_shape(&mesh,
                   i % 3 == 0   ? "random"
                   : i % 3 == 1 ? "mixed"
                                : "cube",
                   i % 3 == 0   ? 24 + random_below(&random, 40)
                   : i % 3 == 1 ? 0
                                : 2,
                   i);
        for (uint32_t k = 0; k < 4 * mesh.vertices; k++) {
            const float part = (float)random_below(&random, 1u << 24) / (1 << 23) - 1;
            const int magnitude = i % 4 == 3 ? -(int)random_below(&random, 34) : 0;
            if (i % 2) mesh.position[k] = part * power(magnitude);
        }
        for (int k = 0; k < 16; k++)
            matrix[k] = (float)random_below(&random, 1u << 24) / (1 << 23) - 1;
        const hs_settings settings = i % 5 == 0 ? uniform((uint8_t)(i % 6)) : adaptive(4, 6, i & 4);
        snprintf(what, sizeof what, "random positions, case %u", i);
        assert_same_view(b, i, &mesh, matrix, &settings, no_stalls, what);
        hs_mesh_free(&mesh);
    }
}

/* --- Mesh files
 * -----------------------------------------------------------------------------------
 */

static void mesh_files_are_goldens_word_for_word(void **state) {
    static const char *const few[] = {"spot_control", "catmark_helmet", "catmark_nonquads",
                                      "catmark_pole64", "bob_cc1_1336"};
    for (size_t i = 0; i < sizeof few / sizeof *few; i++) {
        hs_mesh mesh;
        hs_error err;
        char path[200];
        snprintf(path, sizeof path, "../shared/meshes/%s.obj", few[i]);
        if (!hs_obj_read(&mesh, path, false, NULL, &err)) {
            if (err.code != HS_EXIT_FILE) fail_msg("%s", err.text);
            print_message("%s; skipped\n", err.text);
            continue;
        }
        check_views(*state, &mesh, few[i], 5, 4, 8, i < 4 ? 5 : 2);
        hs_mesh_free(&mesh);
    }
}

/* --- Capacities
 * -------------------------------------------------------------------------------------
 */

/* What refining generation g takes: vertices in all, and half of the refined faces' sides. */
static void needs_of_generation(const hs_golden_report *r, const hs_mesh *mesh, uint32_t g,
                                uint32_t *vertices, uint32_t *quads) {
    uint32_t sides = 4 * r->generation[g].refined;
    if (g == 0) {
        sides = 0;
        for (uint32_t f = 0; f < mesh->faces; f++)
            if (r->decision[0][f] & 2) sides += hs_sides(mesh, f);
    }
    *vertices = r->generation[g].vertices + r->generation[g].refined;
    *quads = (sides + 1) / 2;
}

/* Under these limits the view has this status, and the next one, a small one, is not harmed. */
static void check_limited(bench *b, hs_limits limits, const hs_packet *in, uint32_t status,
                          uint32_t reached, const char *what) {
    limit_bench(b, limits);
    assert_same_words(b, in, no_stalls, what);
    if (b->golden_report.status != status)
        fail_msg("%s: %s instead of %s", what, hs_status_name(b->golden_report.status),
                 hs_status_name(status));
    if (status == HS_STATUS_STOPPED) assert_int_equal(b->golden_report.generations, reached + 1);
    hs_mesh mesh;
    make_shape(&mesh, "tetrahedron", 0, 0);
    const hs_settings settings = uniform(0);
    assert_same_view(b, 77, &mesh, identity, &settings, no_stalls, "the view behind a stopped one");
    /* Too large for the smallest limits, in which case it is refused, but then it is well so. */
    const bool fits = limits.vertices >= mesh.vertices && limits.quads >= mesh.halfedges;
    assert_int_equal(b->golden_report.status == HS_STATUS_OK, fits);
    hs_mesh_free(&mesh);
}

static void a_view_stops_exactly_where_it_exceeds_a_limit(void **state) {
    bench *b = *state, *limited = new_bench(HS_DEFAULT_LIMITS, 1);
    uint32_t stopped = 0;
    for (uint32_t kind = 0; kind < 6; kind++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        char what[200];
        make_shape(&mesh, kind < 3 ? "cube" : kind < 5 ? "mixed" : "grid", kind < 3 ? 2 : 0, 1);
        make_views(&mesh, view);
        const hs_settings settings = kind % 3 == 0 ? uniform(3) : adaptive(3, 4, kind % 3 == 1);
        const float *matrix = view[kind % 3 == 0 ? 0 : 9].matrix;
        assert_same_view(b, kind, &mesh, matrix, &settings, no_stalls, "unlimited");
        assert_int_equal(b->golden_report.status, HS_STATUS_OK);
        const hs_golden_report *r = &b->golden_report;
        uint32_t need[2][8], generations = 0;
        for (uint32_t g = 0; g + 1 < r->generations && g < 8; g++, generations++)
            needs_of_generation(r, &mesh, g, &need[0][g], &need[1][g]);
        assert_true(generations >= 3);
        hs_packet in = b->in;
        for (uint32_t of = 0; of < 2; of++)
            for (uint32_t g = 0; g < generations; g++)
                for (uint32_t below = 0; below < 2; below++) {
                    /* Corners of the input count as well: quads below them are another test's. */
                    const uint32_t limit = need[of][g] - below;
                    uint32_t stops = 0;
                    while (stops < generations && need[of][stops] <= limit)
                        stops++;
                    if (of == 1 && limit < mesh.halfedges) continue;
                    hs_limits limits = HS_DEFAULT_LIMITS;
                    *(of ? &limits.quads : &limits.vertices) = limit;
                    snprintf(what, sizeof what, "kind %u, %s limited to %u, generation %u", kind,
                             of ? "quads" : "vertices", limit, g);
                    const uint32_t status = stops < generations ? HS_STATUS_STOPPED : HS_STATUS_OK;
                    check_limited(limited, limits, &in, status, stops, what);
                    stopped += status == HS_STATUS_STOPPED;
                }
        hs_mesh_free(&mesh);
    }
    free_bench(limited);
    print_message("%u limited views stopped\n", stopped);
    assert_true(stopped >= 20);
}

static void a_mesh_beyond_a_limit_is_refused(void **state) {
    bench *b = *state, *limited = new_bench(HS_DEFAULT_LIMITS, 1);
    hs_mesh mesh;
    hs_error err;
    make_shape(&mesh, "mixed", 0, 1);
    const hs_settings settings = adaptive(2, 3, true);
    assert_true(hs_packet_encode(&b->in, 5, &mesh, identity, &settings, &err));
    for (uint32_t below = 0; below < 2; below++) {
        hs_limits few_vertices = HS_DEFAULT_LIMITS, few_quads = HS_DEFAULT_LIMITS;
        few_vertices.vertices = mesh.vertices - below;
        few_quads.quads = mesh.halfedges - below;
        check_limited(limited, few_vertices, &b->in,
                      below ? HS_STATUS_CAPACITY_VERTICES : HS_STATUS_STOPPED, 0, "vertices");
        check_limited(limited, few_quads, &b->in, below ? HS_STATUS_CAPACITY_CORNERS : HS_STATUS_OK,
                      0, "corners");
    }
    free_bench(limited);
    hs_mesh_free(&mesh);
}

/* Nothing is lost at the capacity itself: the memories are filled to the last vertex and quad. */
static void the_full_capacity_can_be_used(void **state) {
    bench *b = *state;
    hs_mesh mesh;
    make_shape(&mesh, "torus", 512, 0); /* 131072 quads: 2^18 in generation 1, 2^19 in 2 */
    const hs_settings settings = uniform(2);
    assert_same_view(b, 1, &mesh, identity, &settings, no_stalls, "torus of 131072 quads");
    assert_int_equal(b->golden_report.status, HS_STATUS_OK);
    assert_int_equal(b->golden_report.faces, 524288);
    assert_int_equal(b->golden_report.vertices, 524288);
    hs_mesh_free(&mesh);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_shape_from_every_view_is_goldens_word_for_word),
        cmocka_unit_test(uniform_refinement_is_goldens_word_for_word),
        cmocka_unit_test(every_pair_of_depths_is_goldens_word_for_word),
        cmocka_unit_test(stalls_on_either_side_change_no_word),
        cmocka_unit_test(neither_order_nor_initial_contents_change_a_word),
        cmocka_unit_test(forced_depths_are_goldens_word_for_word),
        cmocka_unit_test(open_meshes_keep_their_boundary_as_goldens_do),
        cmocka_unit_test(the_most_sides_and_the_highest_valence_are_goldens_word_for_word),
        cmocka_unit_test(bodies_apart_are_goldens_word_for_word),
        cmocka_unit_test(every_block_exponent_is_goldens_word_for_word),
        cmocka_unit_test(a_face_that_touches_the_view_volume_from_outside_is_in_view),
        cmocka_unit_test(zero_and_degenerate_positions_are_goldens_word_for_word),
        cmocka_unit_test(random_positions_and_matrices_are_goldens_word_for_word),
        cmocka_unit_test(mesh_files_are_goldens_word_for_word),
        cmocka_unit_test(a_view_stops_exactly_where_it_exceeds_a_limit),
        cmocka_unit_test(a_mesh_beyond_a_limit_is_refused),
        cmocka_unit_test(the_full_capacity_can_be_used),
    };
    return cmocka_run_group_tests(tests, set_up_bench, tear_down_bench);
}
