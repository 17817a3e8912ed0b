/* SPDX-License-Identifier: Apache-2.0
 *
 * The whole RTL against golden, output word for output word, where surfaces end, crease and stop:
 * boundary modes, sharp edges and vertices, limit positions, least edges, in pairs and all
 * together; and a reset in the midst of all that. HS_CASES=10 makes the random parts ten times as
 * long.
 */
#include "rtl_samples.h"

#include "reference_shapes.h"

static void describe(char *text, size_t size, const char *name, const hs_settings *s) {
    snprintf(text, size, "%s, %s %u/%u/%u, guard %d, mode %d, limit %d, least edge %u in %ux%u",
             name, s->uniform ? "uniform" : "adaptive", s->front_depth, s->silhouette_depth,
             s->uniform_depth, s->guard, s->boundary, s->limit, s->min_edge, s->width, s->height);
}

typedef struct tally {
    uint64_t boundary, at_level, moved, stopped;
} tally;

static void count(tally *t, const bench *b) {
    t->at_level += b->golden_report.at_level;
    t->stopped += b->golden_report.status == HS_STATUS_STOPPED;
    for (uint32_t g = 0; g < b->golden_report.generations; g++) {
        t->boundary += b->golden_report.generation[g].boundary;
        t->moved += b->golden_report.generation[g].moved;
    }
}

static void check(bench *b, const hs_mesh *mesh, const char *name, const hs_view *view,
                  const hs_settings *settings, hs_stalls stalls, tally *t) {
    char what[300];
    describe(what, sizeof what, name, settings);
    assert_same_view(b, 1, mesh, view->matrix, settings, stalls, what);
    count(t, b);
}

static void every_pair_of_settings_is_goldens_word_for_word(void **state) {
    bench *b = *state;
    samples *all = calloc(1, sizeof *all);
    assert_non_null(all);
    tally t = {0};
    add_sharp_samples(all);
    for (uint32_t i = 0; i < all->count; i++) {
        hs_view view[VIEWS];
        const hs_mesh *mesh = &all->item[i].mesh;
        make_views(mesh, view);
        for (uint32_t c = 0; c < 24; c++) {
            hs_settings s = c % 4 < 2 ? uniform((uint8_t)(c / 12 ? 4 : 3)) : adaptive(3, 6, true);
            s.boundary = modes[c % 3];
            s.limit = c & 1;
            s.min_edge = c % 4 == 3 ? 64 : 0;
            s.width = s.height = 300;
            check(b, mesh, all->item[i].name, &view[(c * 5 + i) % VIEWS], &s, no_stalls, &t);
        }
    }
    print_message("%llu boundary sides, %llu vertices at their level, %llu moved\n",
                  (unsigned long long)t.boundary, (unsigned long long)t.at_level,
                  (unsigned long long)t.moved);
    assert_true(t.boundary > 0 && t.at_level > 0 && t.moved > 0);
    free_samples((void **)&all);
}

static void random_creases_and_settings_are_goldens_word_for_word(void **state) {
    bench *b = *state;
    uint64_t random = 5;
    uint32_t seed = 123456789;
    tally t = {0};
    static const char *const name[] = {"grid", "cube", "mixed", "random", "torus"};
    for (uint32_t i = 0; i < cases(120); i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        if (i % 6 == 5)
            build_random_cube(&mesh, i + 1);
        else
            make_shape(&mesh, name[i % 6], i % 6 == 3 ? 24 + random_below(&random, 40) : 0, i);
        if (i % 6 != 5) tag_at_random(&mesh, &seed, 2 + i % 9, 3 + i % 20);
        if (i % 5 == 0)
            for (uint32_t f = 0; f < mesh.faces; f++)
                mesh.forced[f] = (uint8_t)random_below(&random, 5);
        make_views(&mesh, view);
        const hs_settings s = any_settings(&random);
        const hs_stalls stalls = {.seed = i, .input = i % 7 ? 0 : 40, .output = i % 4 ? 0 : 60};
        check(b, &mesh, i % 6 == 5 ? "random cube" : name[i % 6],
              &view[random_below(&random, VIEWS)], &s, stalls, &t);
        hs_mesh_free(&mesh);
    }
    assert_true(t.boundary > 0 && t.at_level > 0 && t.moved > 0);
}

/* A view that just fits, and with one less of either. */
static void half_quads_count_whole_against_the_capacity(void **state) {
    bench *b = *state;
    hs_mesh mesh;
    hs_view view[VIEWS];
    build_grid(&mesh, 4, 3);
    make_views(&mesh, view);
    tally t = {0};
    for (uint32_t c = 0; c < 4; c++) {
        hs_settings s = c & 1 ? uniform(3) : adaptive(3, 5, true);
        s.boundary = HS_BOUNDARY_SMOOTH;
        s.limit = c & 2;
        uint32_t fits = 0;
        for (uint32_t quads = mesh.halfedges; quads < 400; quads += 1 + quads / 16) {
            limit_bench(b, (hs_limits){4096, quads});
            check(b, &mesh, "grid of 12", &view[1], &s, no_stalls, &t);
            fits += b->golden_report.status == HS_STATUS_OK;
        }
        assert_true(fits > 0);
    }
    assert_true(t.stopped > 0);
    hs_mesh_free(&mesh);
}

/* A view is cut off by a reset, early or late; the view behind knows nothing of it. */
static void a_reset_in_the_midst_leaves_nothing_behind(void **state) {
    bench *b = *state;
    static const char *const name[] = {"cube", "grid", "mixed", "icosahedron"};
    uint64_t random = 23;
    hs_packet cut = {0};
    for (uint32_t i = 0; i < cases(48); i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        hs_error err = {0};
        char what[100];
        uint32_t tags = i + 1;
        make_shape(&mesh, name[i % 4], 0, 1);
        if (i % 3 == 2) tag_at_random(&mesh, &tags, 3, 8);
        make_views(&mesh, view);
        const float *matrix = view[random_below(&random, VIEWS)].matrix;
        const hs_settings settings = any_settings(&random);
        const hs_stalls stalls = {.seed = i, .input = i % 2 ? 30 : 0, .output = i % 5 ? 0 : 60};
        assert_same_view(b, i, &mesh, matrix, &settings, stalls, "before a reset");
        assert_true(hs_packet_encode(&cut, i + 1, &mesh, matrix, &settings, &err));
        const uint64_t at = 1 + random_below(&random, (uint32_t)b->rtl_report.cycles - 1);
        snprintf(what, sizeof what, "%s, behind a reset in cycle %llu of %llu", name[i % 4],
                 (unsigned long long)at, (unsigned long long)b->rtl_report.cycles);
        hs_rtl_cycle_limit(b->rtl, at);
        assert_false(hs_rtl_run(b->rtl, &cut, stalls, &b->actual, &b->rtl_report, &err));
        hs_rtl_cycle_limit(b->rtl, UINT64_MAX);
        assert_non_null(strstr(err.text, "does not come to an end"));
        assert_same_view(b, i + 2, &mesh, matrix, &settings, no_stalls, what);
        hs_mesh_free(&mesh);
    }
    hs_packet_free(&cut);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(every_pair_of_settings_is_goldens_word_for_word,
                                        set_up_bench, tear_down_bench),
        cmocka_unit_test_setup_teardown(random_creases_and_settings_are_goldens_word_for_word,
                                        set_up_bench, tear_down_bench),
        cmocka_unit_test_setup_teardown(a_reset_in_the_midst_leaves_nothing_behind, set_up_bench,
                                        tear_down_bench),
        cmocka_unit_test_setup_teardown(half_quads_count_whole_against_the_capacity, set_up_bench,
                                        tear_down_bench),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
