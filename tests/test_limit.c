/* SPDX-License-Identifier: Apache-2.0
 *
 * Does golden's limit position stay where it is, however deep the surface is refined? In integers
 * it may move by one unit of 2^(E-30) a level (docs/refinement.md, section 10).
 *
 * The output has binary32 numbers, which are coarser than that. So every mesh gets one more vertex,
 * of no face, far enough away that all others are below 2^24 units: then they leave exactly.
 */
#include "golden.h"
#include "reference_shapes.h"

enum { DEEPEST = 9, MOST_FACES = 100000 };

static const hs_limits limits = {1 << 22, 1 << 22};

/* --- Meshes with a far vertex ------------------------------------------------------------------
 */

static float largest_component(const hs_mesh *mesh) {
    float largest = 1; /* w */
    for (size_t i = 0; i < 4 * (size_t)mesh->vertices; i++)
        largest = fmaxf(largest, fabsf(mesh->position[i]));
    return largest;
}

/* A copy of what changes: positions and sharpness. Sharp is sharp for ever here: as long as a
 * finite sharpness has not worn off, the limit is that of a crease that stays. */
static hs_mesh with_far_vertex(const hs_mesh *mesh) {
    hs_mesh far = *mesh;
    far.vertices++;
    far.position = calloc(4 * (size_t)far.vertices, sizeof *far.position);
    far.sharpness = calloc(mesh->halfedges, 1);
    far.vertex_sharpness = calloc(far.vertices, 1);
    assert_non_null(far.position);
    assert_non_null(far.sharpness);
    assert_non_null(far.vertex_sharpness);
    memcpy(far.position, mesh->position, 4 * (size_t)mesh->vertices * sizeof *far.position);
    far.position[4 * (size_t)mesh->vertices] = 256 * largest_component(mesh);
    far.position[4 * (size_t)mesh->vertices + 3] = 1;
    for (uint32_t h = 0; mesh->sharpness && h < mesh->halfedges; h++)
        far.sharpness[h] = mesh->sharpness[h] ? HS_SHARP_INFINITE : 0;
    for (uint32_t v = 0; mesh->vertex_sharpness && v < mesh->vertices; v++)
        far.vertex_sharpness[v] = mesh->vertex_sharpness[v] ? HS_SHARP_INFINITE : 0;
    return far;
}

static void free_far(hs_mesh *far) {
    free(far->position);
    free(far->sharpness);
    free(far->vertex_sharpness);
}

/* Per vertex, whether it is a dart, the end of a crease inside the surface: the smooth mask takes
 * no notice of its sharp edge, so what it gives is near the limit only. */
static bool *find_darts(const hs_mesh *mesh) {
    uint32_t *sharp = calloc(mesh->vertices, sizeof *sharp);
    bool *dart = calloc(mesh->vertices, sizeof *dart);
    assert_non_null(sharp);
    assert_non_null(dart);
    for (uint32_t h = 0; h < mesh->halfedges; h++) {
        const bool boundary = mesh->twin[h] == HS_BORDER;
        sharp[mesh->origin[h]] += mesh->sharpness[h] || boundary;
        if (boundary) sharp[mesh->origin[hs_next(mesh, h)]]++;
    }
    for (uint32_t v = 0; v < mesh->vertices; v++)
        dart[v] = sharp[v] == 1 && !mesh->vertex_sharpness[v];
    free(sharp);
    return dart;
}

/* --- Limits in units ---------------------------------------------------------------------------
 */

typedef struct {
    uint32_t numbers;      /* vertex numbers are below this */
    double (*position)[4]; /* by number, in units of 2^(E-30); NAN: did not leave */
} limit_set;

static limit_set limits_at(hs_golden *golden, const hs_mesh *mesh, hs_boundary boundary,
                           uint8_t depth) {
    const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const hs_settings settings = {
        .uniform = true, .uniform_depth = depth, .limit = true, .boundary = boundary};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_output output;
    hs_error err;
    if (!hs_packet_encode(&in, 0, mesh, identity, &settings, &err) ||
        !hs_golden_run(golden, &in, &out, &report, &err) || !hs_output_decode(&output, &out, &err))
        fail_msg("%s", err.text);
    assert_int_equal(report.status, HS_STATUS_OK);
    if (boundary != HS_BOUNDARY_KEPT) assert_int_equal(output.at_level, 0);
    limit_set set = {0};
    for (uint32_t i = 0; i < output.vertices; i++)
        if (output.number[i] >= set.numbers) set.numbers = output.number[i] + 1;
    set.position = malloc(set.numbers * sizeof *set.position);
    assert_non_null(set.position);
    for (uint32_t v = 0; v < set.numbers; v++)
        set.position[v][0] = NAN;
    for (uint32_t i = 0; i < output.vertices; i++)
        for (int k = 0; k < 4; k++) {
            const double units =
                ldexp((double)output.position[4 * (size_t)i + (size_t)k], 30 - output.exponent);
            assert_true(fabs(units) < 1 << 24 && units == rint(units));
            set.position[output.number[i]][k] = units;
        }
    hs_output_free(&output);
    hs_packet_free(&in);
    hs_packet_free(&out);
    return set;
}

/* The largest difference of a component at vertices that both have, darts aside. */
static double largest_move(const limit_set *a, const limit_set *b, const bool *dart,
                           uint32_t initial, uint64_t *compared) {
    double largest = 0;
    for (uint32_t v = 0; v < a->numbers && v < b->numbers; v++) {
        if ((v < initial && dart[v]) || isnan(a->position[v][0]) || isnan(b->position[v][0]))
            continue;
        for (int k = 0; k < 4; k++)
            largest = fmax(largest, fabs(a->position[v][k] - b->position[v][k]));
        ++*compared;
    }
    return largest;
}

static uint32_t level_of(uint32_t depth) {
    return (depth + 1) / 2;
}

/* --- The claim ---------------------------------------------------------------------------------
 */

typedef struct {
    uint64_t compared, runs;
    double in_a_level, in_all; /* the largest moves */
} totals;

static void compare_depths(hs_golden *golden, const sample *s, hs_boundary boundary, totals *sum) {
    hs_mesh mesh = with_far_vertex(&s->mesh);
    bool *dart = find_darts(&mesh);
    const limit_set first = limits_at(golden, &mesh, boundary, 1);
    limit_set before = first;
    for (uint8_t depth = 2; depth <= DEEPEST && mesh.halfedges << depth < 2 * MOST_FACES; depth++) {
        limit_set after = limits_at(golden, &mesh, boundary, depth);
        const uint32_t levels = level_of(depth) - level_of(depth - 1u);
        const double here = largest_move(&before, &after, dart, mesh.vertices, &sum->compared);
        const double all = largest_move(&first, &after, dart, mesh.vertices, &sum->compared);
        if (!(here <= levels) || !(all <= level_of(depth) - 1))
            fail_msg("%s, mode %u, depth %u: moved by %g units, since depth 1 by %g", s->name,
                     boundary, depth, here, all);
        sum->in_a_level = fmax(sum->in_a_level, here);
        sum->in_all = fmax(sum->in_all, all);
        sum->runs++;
        if (before.position != first.position) free(before.position);
        before = after;
    }
    if (before.position != first.position) free(before.position);
    free(first.position);
    free(dart);
    free_far(&mesh);
}

static void refining_deeper_moves_no_vertex_by_more_than_a_unit_a_level(void **state) {
    const samples *all = *state;
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    totals sum = {0};
    for (uint32_t i = 0; i < all->count; i++) {
        compare_depths(golden, &all->item[i], HS_BOUNDARY_SMOOTH, &sum);
        compare_depths(golden, &all->item[i], HS_BOUNDARY_EDGE_ONLY, &sum);
    }
    hs_golden_free(golden);
    print_message("%u meshes, %llu runs, %llu vertices: moved by %g units a level at most, %g over "
                  "all levels\n",
                  all->count, (unsigned long long)sum.runs, (unsigned long long)sum.compared,
                  sum.in_a_level, sum.in_all);
    assert_true(sum.compared > 1000000);
    assert_true(sum.in_a_level == 1); /* rounding shows: the integers were compared */
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(refining_deeper_moves_no_vertex_by_more_than_a_unit_a_level),
    };
    return cmocka_run_group_tests_name("limit", tests, make_all_samples, free_samples);
}
