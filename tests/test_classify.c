/* SPDX-License-Identifier: Apache-2.0
 *
 * classify.sv and smooth.sv, with accumulate, ring and the vertex memory between them, against
 * golden: each generation of golden's views is given to them, and every face and vertex compared.
 * Where a vertex goes is worked out here once more, from golden's sums around it.
 */
#include "arithmetic.h"
#include "classify_shim.h"
#include "golden_state.h"
#include "reference_shapes.h"

static const hs_limits limits = {CLASSIFY_VERTICES, CLASSIFY_ITEMS};

/* What has been compared. Kinds: smooth, crease, stays; parity: of the generation. */
typedef struct counts {
    uint32_t generations, faces, half_quads, tagged, stopped;
    uint32_t moved[3], left[3][2], at_level[2], nonquad_at_level;
    uint32_t items, cycles;
} counts;

typedef struct bench {
    hs_golden *golden;
    classify_shim *rtl;
    hs_packet in, out;
    counts sum;
    classify_item item[CLASSIFY_ITEMS];
    classify_vertex vertex[CLASSIFY_VERTICES];
    classify_run run;
    char name[100];
} bench;

/* --- A generation, as the memories hold it -----------------------------------------------------
 */

/* Golden has no sharpness where nothing is sharp. */
static uint8_t sharpness_of(const hs_state *s, uint32_t h) {
    return s->plain ? 0 : s->sharp[h];
}

static void make_corner(const hs_state *s, uint32_t f, uint32_t h, classify_item *item) {
    *item = (classify_item){.origin = {s->origin[h]},
                            .border = s->twin[h] == HS_BORDER,
                            .boundary = s->twin[h] == BOUNDARY_TWIN,
                            .sharpness = {sharpness_of(s, h)},
                            .last = h + 1 == s->first[f + 1]};
}

static void make_quad(const hs_state *s, uint32_t f, classify_item *item) {
    const bool half = hs_is_half(s, f), odd = s->generation & 1;
    *item = (classify_item){.half = half, .last = true};
    if (odd) item->tag = half ? HS_SHARP_INFINITE : sharpness_of(s, 4 * f);
    for (uint32_t i = 0; i < (half ? 3 : 4); i++) {
        item->origin[i] = s->origin[4 * f + i];
        item->border |= (uint8_t)((s->twin[4 * f + i] == HS_BORDER) << i);
        item->boundary |= (uint8_t)((s->twin[4 * f + i] == BOUNDARY_TWIN) << i);
        if (!odd) item->sharpness[i] = sharpness_of(s, 4 * f + i);
    }
}

static uint32_t make_items(bench *b, const hs_state *s) {
    uint32_t items = 0;
    for (uint32_t f = 0; f < s->faces; f++)
        if (s->generation)
            make_quad(s, f, &b->item[items++]);
        else
            for (uint32_t h = s->first[f]; h < s->first[f + 1]; h++)
                make_corner(s, f, h, &b->item[items++]);
    return items;
}

static void make_vertex(const hs_state *s, uint32_t v, classify_vertex *vertex) {
    memcpy(vertex->position, s->position[v], sizeof vertex->position);
    memcpy(vertex->old, s->old[v], sizeof vertex->old);
    vertex->sharp = 3u << 16 | (uint32_t)s->stays[v] << 12 | s->crease[v] * 0x11u;
    vertex->sent = s->sent[v];
    vertex->held = s->mark[v] & MARK_HELD;
}

/* --- Where a vertex goes -----------------------------------------------------------------------
 */

static bool is_active(const hs_state *s, uint32_t v) {
    return s->mark[v] & MARK_ACTIVE;
}

static bool is_moved(const hs_state *s, uint32_t v) {
    const hs_kind kind = hs_vertex_kind(s, v);
    if (!is_active(s, v) || !hs_odd_step(s) || s->finish || s->sent[v]) return false;
    if (s->mark[v] & (MARK_HELD | MARK_BORDER)) return false;
    return kind == KIND_CREASE || (kind == KIND_SMOOTH && s->valence[v] > 1);
}

static bool is_sent(const hs_state *s, uint32_t v) {
    if (!is_active(s, v) || s->sent[v]) return false;
    return s->finish || s->mark[v] & (MARK_HELD | MARK_BORDER);
}

static void moved_to(const hs_state *s, uint32_t v, int32_t to[4]) {
    const int64_t n = s->valence[v];
    for (int k = 0; k < 4; k++) {
        const int64_t from = s->position[v][k], sum = s->sum[v][k];
        to[k] = (int32_t)(hs_vertex_kind(s, v) == KIND_CREASE
                              ? hs_rne_divide(sum + 6 * from, 8)
                              : hs_rne_divide(sum + n * (n - 2) * from, n * n));
    }
}

/* False if it leaves where its level has it. */
static bool limit_of(const hs_state *s, uint32_t v, int32_t to[4]) {
    const int64_t n = s->valence[v];
    const hs_kind kind = hs_vertex_kind(s, v);
    memcpy(to, s->position[v], sizeof s->position[v]);
    if (s->mark[v] & (MARK_BORDER | MARK_NONQUAD)) return false;
    for (int k = 0; k < 4 && kind != KIND_STAYS; k++) {
        const int64_t from = s->position[v][k], ring = s->ring[v][k];
        to[k] = (int32_t)(kind == KIND_CREASE ? hs_rne_divide(ring + 4 * from, 6)
                                              : hs_rne_divide(ring + n * n * from, n * n + 5 * n));
    }
    return true;
}

/* --- Comparing ---------------------------------------------------------------------------------
 */

static void compare(const bench *b, const hs_state *s, const char *what, uint32_t number,
                    const int32_t rtl[4], const int32_t golden[4]) {
    if (memcmp(rtl, golden, 4 * sizeof *rtl))
        fail_msg("%s, generation %u: %s %u is %d %d %d %d, not %d %d %d %d", b->name, s->generation,
                 what, number, rtl[0], rtl[1], rtl[2], rtl[3], golden[0], golden[1], golden[2],
                 golden[3]);
}

static void compare_faces(bench *b, const hs_state *s) {
    assert_int_equal(b->run.faces, s->faces);
    for (uint32_t f = 0; f < s->faces; f++) {
        const classified_face *face = &b->run.face[f];
        compare(b, s, "the new vertex of face", f, face->point, s->point[f]);
        assert_int_equal(face->front, (s->face_mark[f] & MARK_FRONT) != 0);
        assert_int_equal(face->stop, (s->face_mark[f] & MARK_STOP) != 0);
        b->sum.half_quads += hs_is_half(s, f);
        b->sum.tagged += (s->generation & 1) && !hs_is_half(s, f) && sharpness_of(s, 4 * f);
        b->sum.stopped += face->stop;
    }
    b->sum.faces += s->faces;
}

static void compare_vertex(bench *b, const hs_state *s, uint32_t v) {
    const smoothed_vertex *rtl = &b->run.vertex[v];
    const hs_kind kind = hs_vertex_kind(s, v);
    int32_t to[4];
    assert_int_equal(rtl->active, is_active(s, v));
    if (rtl->active) assert_int_equal(rtl->marks, s->mark[v] & 15);

    assert_int_equal(rtl->moved, is_moved(s, v));
    memcpy(to, s->position[v], sizeof to);
    if (rtl->moved) moved_to(s, v, to);
    compare(b, s, "vertex", v, rtl->position, to);
    b->sum.moved[kind] += rtl->moved;
    if (rtl->active && hs_odd_step(s))
        compare(b, s, "the old position of vertex", v, rtl->old, s->position[v]);

    assert_int_equal(rtl->sent, is_sent(s, v));
    if (!rtl->sent) return;
    const bool at_level = s->settings.limit && !limit_of(s, v, to);
    compare(b, s, "what is sent of vertex", v, rtl->left_at, to);
    assert_int_equal(rtl->at_level, at_level);
    if (!s->settings.limit) return;
    if (!at_level) b->sum.left[kind][s->generation & 1]++;
    b->sum.at_level[s->generation & 1] += at_level;
    b->sum.nonquad_at_level += at_level && !(s->mark[v] & MARK_BORDER);
}

static void compare_generation(void *context, const hs_state *s) {
    bench *b = context;
    if (s->last) return; /* what a last step sends is the pipeline's tests' */
    const classify_generation generation = {.generation = (uint8_t)s->generation,
                                            .limit = s->settings.limit,
                                            .finish = s->finish,
                                            .min_edge = s->settings.min_edge,
                                            .width = s->settings.width,
                                            .height = s->settings.height,
                                            .items = make_items(b, s),
                                            .vertices = s->vertices,
                                            .item = b->item,
                                            .vertex = b->vertex};
    for (uint32_t v = 0; v < s->vertices; v++)
        make_vertex(s, v, &b->vertex[v]);
    if (!classify_generation_run(b->rtl, &generation, &b->run))
        fail_msg("%s, generation %u: classify or smooth hangs", b->name, s->generation);
    compare_faces(b, s);
    for (uint32_t v = 0; v < s->vertices; v++)
        compare_vertex(b, s, v);
    b->sum.generations++;
    b->sum.items += generation.items;
    b->sum.cycles += b->run.cycles;
}

/* --- Views -------------------------------------------------------------------------------------
 */

static int set_up(void **state) {
    bench *b = calloc(1, sizeof *b);
    assert_non_null(b);
    b->golden = hs_golden_new(limits);
    b->rtl = classify_new(3);
    assert_non_null(b->golden);
    const hs_observer observer = {.context = b, .decided = compare_generation};
    hs_golden_observe(b->golden, &observer);
    *state = b;
    return 0;
}

static int tear_down(void **state) {
    bench *b = *state;
    hs_golden_free(b->golden);
    classify_free(b->rtl);
    hs_packet_free(&b->in);
    hs_packet_free(&b->out);
    free(b);
    return 0;
}

/* Some faces are refined whatever the view says, some are not, so that there are borders. */
static void run_view(bench *b, hs_mesh *mesh, const hs_settings *settings, uint32_t *seed) {
    hs_error err;
    hs_golden_report report;
    for (uint32_t f = 0; f < mesh->faces; f++)
        mesh->forced[f] = next_random(seed) % 3 ? (uint8_t)(next_random(seed) % 5) : 0;
    if (!hs_packet_encode(&b->in, 0, mesh, perspective, settings, &err) ||
        !hs_golden_run(b->golden, &b->in, &b->out, &report, &err))
        fail_msg("%s: %s", b->name, err.text);
    assert_true(report.status == HS_STATUS_OK || report.status == HS_STATUS_STOPPED);
}

/* In every boundary mode, with and without limit positions. */
static void run_mesh(bench *b, hs_mesh *mesh, const char *name, uint32_t seed) {
    for (uint32_t mode = 0; mode < 6; mode++) {
        const bool small = next_random(&seed) % 4 == 0;
        const hs_settings settings = {.front_depth = (uint8_t)(next_random(&seed) % 6),
                                      .silhouette_depth = (uint8_t)(next_random(&seed) % 6),
                                      .guard = next_random(&seed) % 4 != 0,
                                      .limit = mode & 1,
                                      .boundary = (hs_boundary)(mode / 2),
                                      .min_edge = small ? 1600 : 0,
                                      .width = small ? 800 : 0,
                                      .height = small ? 600 : 0};
        snprintf(b->name, sizeof b->name, "%s, boundary mode %u%s", name, mode / 2,
                 settings.limit ? ", limit" : "");
        run_view(b, mesh, &settings, &seed);
    }
    hs_mesh_free(mesh);
}

/* --- Claims ------------------------------------------------------------------------------------
 */

static void cubes_with_random_tags_and_faces_missing_go_where_golden_has_them(void **state) {
    bench *b = *state;
    for (uint32_t seed = 1; seed <= 60; seed++) {
        hs_mesh mesh;
        char name[30];
        snprintf(name, sizeof name, "random cube %u", seed);
        build_random_cube(&mesh, seed);
        run_mesh(b, &mesh, name, seed);
    }
}

static void faces_and_vertices_of_any_valence_do_too(void **state) {
    static const uint32_t valences[] = {3, 4, 5, 6, 7, 12, 31, 100, 254, 255};
    bench *b = *state;
    uint32_t seed = 7;
    for (uint32_t i = 0; i < sizeof valences / sizeof *valences; i++)
        for (uint32_t open = 0; open < 2; open++) {
            hs_mesh mesh;
            char name[30];
            snprintf(name, sizeof name, "cone %u", valences[i]);
            build_cone(&mesh, valences[i], open);
            tag_at_random(&mesh, &seed, valences[i] / 2 + 1, valences[i]);
            run_mesh(b, &mesh, name, next_random(&seed));
        }
    hs_mesh pillow;
    build_pillow(&pillow);
    run_mesh(b, &pillow, "pillow", 5);
}

static void built_in_shapes_do_too_with_tags_and_without(void **state) {
    static const char *const shapes[] = {"cube", "tetrahedron", "icosahedron", "mixed", "grid"};
    bench *b = *state;
    uint32_t seed = 11;
    for (uint32_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        for (uint32_t tagged = 0; tagged < 2; tagged++) {
            hs_mesh mesh;
            hs_error err;
            if (!hs_shape_make(&mesh, shapes[i], 0, 1, &err)) fail_msg("%s", err.text);
            if (tagged) tag_at_random(&mesh, &seed, 4, 20);
            run_mesh(b, &mesh, shapes[i], next_random(&seed));
        }
}

static void all_kinds_of_faces_and_vertices_were_among_them(void **state) {
    const bench *b = *state;
    const counts *sum = &b->sum;
    print_message("%u generations, %u faces, %u half-quads, %.2f cycles an item\n",
                  sum->generations, sum->faces, sum->half_quads, (double)sum->cycles / sum->items);
    assert_true(sum->half_quads > 1000 && sum->tagged > 1000 && sum->stopped > 1000);
    assert_true(sum->moved[KIND_SMOOTH] > 1000 && sum->moved[KIND_CREASE] > 1000);
    assert_true(sum->nonquad_at_level > 100);
    for (int parity = 0; parity < 2; parity++) {
        for (int kind = 0; kind < 3; kind++)
            assert_true(sum->left[kind][parity] > 100);
    }
    /* Later the ends of border edges have left already: with the faces beyond, or with a triangle.
     */
    assert_true(sum->at_level[0] > 100);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(cubes_with_random_tags_and_faces_missing_go_where_golden_has_them),
        cmocka_unit_test(faces_and_vertices_of_any_valence_do_too),
        cmocka_unit_test(built_in_shapes_do_too_with_tags_and_without),
        cmocka_unit_test(all_kinds_of_faces_and_vertices_were_among_them),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
