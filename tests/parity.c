/* SPDX-License-Identifier: Apache-2.0
 *
 * The campaign of the cycle-level model against the RTL of one architecture: every transaction at
 * every stage boundary, every counter, every word. Prints what was compared; ends with the first
 * difference, which names stage, item, both cycles, and the packet.
 *
 *   parity [PER CENT [VERTICES QUADS]]
 *
 * PER CENT of the campaign's views; 100 is all. The limits are those of an RTL of a lesser
 * capacity.
 *
 *   1. every mesh of the tests x 16 views x settings: depths, guard, boundary modes, limit
 *   2. 200 seeds of stalls on both sides
 *   3. 400 random meshes, settings, views and stalls
 */
#include "reference_shapes.h"
#include "rtl_samples.h"

enum { SETTINGS = 8, SEEDS = 200, RANDOM_CASES = 400 };

static hs_settings setting(uint32_t k) {
    const hs_settings all[SETTINGS] = {
        adaptive(4, 8, true), uniform(2), adaptive(2, 5, false), uniform(3),
        adaptive(3, 6, true), uniform(1), adaptive(0, 4, true),  uniform(4)};
    hs_settings s = all[k];
    s.boundary = modes[k % 3];
    s.limit = k >= 4;
    return s;
}

static double percent = 100;
static uint64_t chosen; /* views that came by: spreads a part of them over all */

/* Whether this view is one of those asked for. */
static bool choose(void) {
    chosen++;
    return (uint64_t)((double)chosen * percent / 100) !=
           (uint64_t)((double)(chosen - 1) * percent / 100);
}

static void run(bench *b, const hs_mesh *mesh, const float matrix[16], const hs_settings *s,
                hs_stalls stalls, const char *what) {
    hs_error err;
    char text[2000];
    if (!hs_packet_encode(&b->in, 1, mesh, matrix, s, &err)) {
        fprintf(stderr, "parity: %s\n", err.text);
        exit(err.code);
    }
    if (same_words(b, &b->in, stalls, what, text, sizeof text)) return;
    fprintf(stderr, "parity: %s\n", text);
    exit(HS_EXIT_DIFFERENT);
}

/* What was compared since *before, which becomes what was compared so far. */
static void print_part(const bench *b, bench *before, const char *part) {
    printf("%-34s %6llu views %12llu transactions %12llu cycles  0 differences\n", part,
           (unsigned long long)(b->views - before->views),
           (unsigned long long)(b->transactions - before->transactions),
           (unsigned long long)(b->cycles - before->cycles));
    fflush(stdout);
    *before = *b;
}

static void every_mesh(bench *b) {
    samples *all;
    if (make_all_samples((void **)&all) != 0) exit(HS_EXIT_INTERNAL);
    for (uint32_t i = 0; i < all->count; i++) {
        hs_view view[VIEWS];
        const hs_mesh *mesh = &all->item[i].mesh;
        make_views(mesh, view);
        for (uint32_t v = 0; v < VIEWS; v++) {
            const hs_settings s = setting((v + i) % SETTINGS);
            char what[300];
            snprintf(what, sizeof what, "%.200s, %s, settings %u", all->item[i].name, view_name[v],
                     (v + i) % SETTINGS);
            if (choose()) run(b, mesh, view[v].matrix, &s, no_stalls, what);
        }
    }
    free_samples((void **)&all);
}

static void every_seed(bench *b) {
    static const char *const name[] = {"cube", "grid", "torus", "mixed", "random", "pot"};
    uint64_t random = 11;
    for (uint32_t seed = 0; seed < SEEDS; seed++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        char what[200];
        const hs_settings s = setting(seed % SETTINGS);
        const hs_stalls stalls = {.seed = seed + 1,
                                  .input = (uint8_t)random_below(&random, 96),
                                  .output = (uint8_t)random_below(&random, 96)};
        make_shape(&mesh, name[seed % 6], seed % 6 == 4 ? 40 : 0, seed);
        make_views(&mesh, view);
        snprintf(what, sizeof what, "%s, stalls %u,%u, seed %u", name[seed % 6], stalls.input,
                 stalls.output, stalls.seed);
        if (choose()) run(b, &mesh, view[seed % VIEWS].matrix, &s, stalls, what);
        hs_mesh_free(&mesh);
    }
}

static void random_case(bench *b, uint32_t i, uint64_t *random, uint32_t *tags) {
    static const char *const name[] = {"grid", "cube", "mixed", "random", "torus"};
    hs_mesh mesh;
    hs_view view[VIEWS];
    char what[200];
    if (i % 6 == 5)
        build_random_cube(&mesh, i + 1);
    else if (i % 17 == 3)
        make_bicone(&mesh, 3 + random_below(random, 253));
    else if (i % 17 == 4)
        make_pillow(&mesh, 3 + random_below(random, 253));
    else
        make_shape(&mesh, name[i % 6], i % 6 == 3 ? 24 + random_below(random, 40) : 0, i);
    if (i % 6 != 5) tag_at_random(&mesh, tags, 2 + i % 9, 3 + i % 20);
    for (uint32_t f = 0; i % 5 == 0 && f < mesh.faces; f++)
        mesh.forced[f] = (uint8_t)random_below(random, 5);
    make_views(&mesh, view);
    const hs_settings s = any_settings(random);
    const hs_stalls stalls = {.seed = i,
                              .input = i % 3 ? 0 : 40,
                              .output = i % 2 ? 0 : (uint8_t)random_below(random, 96)};
    const uint32_t v = random_below(random, VIEWS);
    snprintf(what, sizeof what, "random case %u, %s", i, view_name[v]);
    if (choose()) run(b, &mesh, view[v].matrix, &s, stalls, what);
    hs_mesh_free(&mesh);
}

int main(int argc, char **argv) {
    if (argc > 1) percent = atof(argv[1]);
    hs_limits limits = HS_DEFAULT_LIMITS;
    if (argc > 3) limits = (hs_limits){(uint32_t)atol(argv[2]), (uint32_t)atol(argv[3])};
    bench *b = new_bench(limits, 1);
    const hs_model_config c = hs_rtl_config(b->rtl);
    bench before = *b;
    printf("port %u, banks %u, window %u, lanes %u, latency %u, ops %u\n", c.port, c.banks,
           c.window, c.lanes, c.latency, c.ops);
    every_mesh(b);
    print_part(b, &before, "meshes x views x settings");
    every_seed(b);
    print_part(b, &before, "stalls, seeds 1 to 200");
    uint64_t random = 5;
    uint32_t tags = 123456789;
    for (uint32_t i = 0; i < RANDOM_CASES; i++)
        random_case(b, i, &random, &tags);
    print_part(b, &before, "random, cases 0 to 399");
    const bool compared = b->transactions > 0;
    if (!compared) fprintf(stderr, "parity: nothing was compared\n");
    free_bench(b);
    return compared ? HS_EXIT_OK : HS_EXIT_DIFFERENT;
}
