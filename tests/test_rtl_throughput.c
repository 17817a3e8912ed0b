/* SPDX-License-Identifier: Apache-2.0
 *
 * What views cost in cycles, beside the least that is possible (sim/bound.h), and beside what they
 * cost before: tests/throughput.txt has the cycles of every row, and a cycle more or less is a
 * failure. A change that means to change them writes them anew (`make baselines`) and says why.
 */
#include "rtl_samples.h"

#include "bound.h"
#include "file.h"
#include "mesh_source.h"

#define BASELINES "tests/throughput.txt"

enum { ROWS = 64 };

/* A line of the file. */
typedef struct {
    char mesh[200], how[40];
    unsigned long long expected, cycles; /* cycles 0: the mesh is not there */
} row;

typedef struct {
    uint32_t rows;
    row row[ROWS];
    char comment[1000]; /* the lines before the first row */
} baselines;

static void read_baselines(baselines *b) {
    FILE *file = fopen(BASELINES, "r");
    char line[400];
    assert_non_null(file);
    *b = (baselines){0};
    while (fgets(line, sizeof line, file)) {
        row *r = &b->row[b->rows];
        if (line[0] == '#') {
            assert_true(strlen(b->comment) + strlen(line) < sizeof b->comment);
            strcat(b->comment, line);
            continue;
        }
        assert_true(b->rows < ROWS);
        if (sscanf(line, "%199s %39s %llu", r->mesh, r->how, &r->expected) != 3)
            fail_msg(BASELINES ": \"%s\" is no row", line);
        b->rows++;
    }
    fclose(file);
    assert_true(b->rows > 0);
}

static void write_baselines(const baselines *b) {
    hs_file file;
    hs_error err;
    if (!hs_file_create(&file, BASELINES, &err)) fail_msg("%s", err.text);
    fputs(b->comment, file.stream);
    for (uint32_t i = 0; i < b->rows; i++) {
        const row *r = &b->row[i];
        fprintf(file.stream, "%s %s %llu\n", r->mesh, r->how, r->cycles ? r->cycles : r->expected);
    }
    if (!hs_file_commit(&file, &err)) fail_msg("%s", err.text);
}

/* "4/8": depths of front faces and silhouettes; "uniform:6". */
static hs_settings settings_of(const char *how) {
    unsigned front, silhouette, depth;
    hs_settings s = {.boundary = HS_BOUNDARY_SMOOTH, .guard = true};
    if (sscanf(how, "uniform:%u", &depth) == 1) {
        s.uniform = true;
        s.uniform_depth = (uint8_t)depth;
    } else if (sscanf(how, "%u/%u", &front, &silhouette) == 2) {
        s.front_depth = (uint8_t)front;
        s.silhouette_depth = (uint8_t)silhouette;
    } else {
        fail_msg(BASELINES ": \"%s\" is no way to refine", how);
    }
    return s;
}

static void measure(bench *b, row *r) {
    hs_error err;
    hs_mesh mesh;
    hs_views views;
    if (!hs_mesh_open(&mesh, r->mesh, true, true, &err)) {
        if (err.code != HS_EXIT_FILE) fail_msg("%s", err.text);
        print_message("%-34s %-10s skipped: not there\n", r->mesh, r->how);
        return;
    }
    if (!hs_views_orbit(&views, 8, &mesh, 1, &err)) fail_msg("%s", err.text);
    const hs_settings settings = settings_of(r->how);
    assert_same_view(b, 1, &mesh, views.view[0].matrix, &settings, no_stalls, r->mesh);
    const hs_golden_report *g = &b->golden_report;
    const hs_bound bound =
        hs_bound_of(&settings, hs_view_depth(&settings, &mesh), g->generation, g->generations,
                    mesh.vertices, b->in.words, b->expected.words);
    r->cycles = b->rtl_report.cycles;
    print_message("%-34s %-10s %7u %8u %9llu %6.2f %9llu %6.2f\n", r->mesh, r->how, mesh.faces,
                  g->faces, r->cycles, (double)r->cycles / g->faces,
                  (unsigned long long)bound.total, (double)r->cycles / (double)bound.total);
    assert_true(r->cycles >= bound.total);
    hs_views_free(&views);
    hs_mesh_free(&mesh);
}

static void views_cost_as_many_cycles_as_before(void **state) {
    bench *b = *state;
    static baselines all;
    read_baselines(&all);
    print_message("%-34s %-10s %7s %8s %9s %6s %9s %6s\n", "mesh", "refined to", "faces", "output",
                  "cycles", "c/face", "bound", "ratio");
    uint32_t measured = 0, different = 0;
    for (uint32_t i = 0; i < all.rows; i++) {
        measure(b, &all.row[i]);
        measured += all.row[i].cycles != 0;
    }
    assert_true(measured > 0);
    if (getenv("HS_BASELINES")) {
        write_baselines(&all);
        return;
    }
    for (uint32_t i = 0; i < all.rows; i++) {
        const row *r = &all.row[i];
        if (!r->cycles || r->cycles == r->expected) continue;
        print_error("%s, %s: %llu cycles, %+lld against %llu\n", r->mesh, r->how, r->cycles,
                    (long long)(r->cycles - r->expected), r->expected);
        different++;
    }
    if (different)
        fail_msg("%u of %u views cost another number of cycles; if that is meant, `make baselines` "
                 "writes " BASELINES " anew, and the commit says why",
                 different, measured);
}

static int set_up(void **state) {
    *state = new_bench(HS_DEFAULT_LIMITS, 1);
    return 0;
}

static int tear_down(void **state) {
    free_bench(*state);
    return 0;
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup_teardown(views_cost_as_many_cycles_as_before, set_up, tear_down),
    };
    return cmocka_run_group_tests_name("throughput", tests, NULL, NULL);
}
