/* SPDX-License-Identifier: Apache-2.0
 *
 * `make bench`, the part with cycles: how fast RTL and model are simulated, in one run on the same
 * work; and how cycles grow with the mesh and the depth, beside the closed forms (sim/bound.h),
 * with golden's memory and views per second. out/bench/scaling.csv has the points of the plot.
 */
#define PROGRAM "bench"

#include "bound.h"
#include "file.h"
#include "mesh_source.h"
#include "progress.h"
#include "quit.h"
#include "rtl_samples.h"

enum { SPEED_VIEWS = 8, MOST_RTL = 1 << 19, MOST_MODEL = 1 << 23 };

/* --- Speed --------------------------------------------------------------------------------------
 */
typedef struct speed {
    uint64_t cycles, faces;
    uint32_t views;
    double rtl, model, golden; /* seconds */
} speed;

/* A mesh from eight sides, one engine after the other, without logs. */
static void measure_speed(bench *b, const char *source, const hs_settings *s, speed *sum) {
    hs_mesh mesh;
    hs_views views;
    hs_error err;
    quit_on(hs_mesh_open(&mesh, source, true, true, &err), &err);
    quit_on(hs_views_orbit(&views, SPEED_VIEWS, &mesh, 1, &err), &err);
    for (uint32_t v = 0; v < SPEED_VIEWS; v++) {
        quit_on(hs_packet_encode(&b->in, v, &mesh, views.view[v].matrix, s, &err), &err);
        double start = hs_seconds();
        quit_on(hs_golden_run(b->golden, &b->in, &b->expected, &b->golden_report, &err), &err);
        sum->golden += hs_seconds() - start;
        start = hs_seconds();
        quit_on(hs_model_run(b->model, &b->in, no_stalls, &b->modelled, &b->modelled_report,
                             &b->model_report, NULL, &err),
                &err);
        sum->model += hs_seconds() - start;
        start = hs_seconds();
        quit_on(hs_rtl_run(b->rtl, &b->in, no_stalls, &b->actual, &b->rtl_report, &err), &err);
        sum->rtl += hs_seconds() - start;
        if (b->rtl_report.cycles != b->model_report.cycles) {
            fprintf(stderr, "bench: %s, view %u: rtl takes %llu cycles, model %llu\n", source, v,
                    (unsigned long long)b->rtl_report.cycles,
                    (unsigned long long)b->model_report.cycles);
            exit(HS_EXIT_DIFFERENT);
        }
        sum->cycles += b->rtl_report.cycles;
        sum->faces += b->golden_report.faces;
        sum->views++;
    }
    hs_views_free(&views);
    hs_mesh_free(&mesh);
}

static void print_speed(const char *name, const speed *s) {
    const double m = 1e-6 * (double)s->cycles;
    printf("%-22s %5u %9.2f %8.3f %8.1f %6.0f %9.0f %9.0f\n", name, s->views, m, m / s->rtl,
           m / s->model, s->rtl / s->model, s->views / s->model, s->views / s->golden);
    fflush(stdout);
}

static void add_speed(speed *sum, const speed *s) {
    sum->cycles += s->cycles;
    sum->faces += s->faces;
    sum->views += s->views;
    sum->rtl += s->rtl;
    sum->model += s->model;
    sum->golden += s->golden;
}

static void compare_speeds(void) {
    static const struct {
        const char *mesh, *name;
        uint8_t uniform;
    } work[] = {{"shape:hand", "hand 4/8", 0},
                {"shape:monster", "monster 4/8", 0},
                {"shape:random:10000", "10,000 faces 4/8", 0},
                {"shape:torus:52", "torus uniform 6", 6}};
    bench *b = new_bench(HS_DEFAULT_LIMITS, 1);
    hs_rtl_log(b->rtl, NULL);
    speed all = {0};
    printf("\nSimulation, one thread, millions of cycles per second; views per second\n\n"
           "                       views  M cycles      rtl    model  ratio   model/s  golden/s\n");
    for (uint32_t i = 0; i < sizeof work / sizeof *work; i++) {
        hs_settings s = adaptive(4, 8, true);
        if (work[i].uniform) s = uniform(work[i].uniform);
        s.boundary = HS_BOUNDARY_SMOOTH;
        speed of = {0};
        measure_speed(b, work[i].mesh, &s, &of);
        print_speed(work[i].name, &of);
        add_speed(&all, &of);
    }
    print_speed("all", &all);
    free_bench(b);
}

/* --- Views in flight ----------------------------------------------------------------------------
 */
enum { ROW = 48 };

/* Cycles per output face of a row of views; the first quarter fills the pipelines and is left out.
 */
static double row_of(uint32_t in_flight, const hs_packet *in) {
    static hs_packet out[ROW];
    hs_golden_report report[ROW];
    hs_flight_view view[ROW];
    hs_model_config config = HS_DEFAULT_CONFIG;
    hs_error err;
    uint64_t cycles, from = 0, to = 0, faces = 0;
    config.views = in_flight;
    hs_flight *flight = hs_flight_new(HS_DEFAULT_LIMITS, config, &err);
    quit_on(flight != NULL, &err);
    quit_on(hs_flight_run(flight, in, ROW, no_stalls, out, report, view, &cycles, NULL, &err),
            &err);
    for (uint32_t v = 0; v < ROW; v++) {
        if (v < ROW / 4 && view[v].end > from) from = view[v].end;
        if (v < 3 * ROW / 4 && view[v].end > to) to = view[v].end;
    }
    for (uint32_t v = 0; v < ROW; v++)
        if (view[v].end > from && view[v].end <= to) faces += report[v].faces;
    hs_flight_free(flight);
    return (double)(to - from) / (double)faces;
}

static void compare_rows(void) {
    static const struct {
        const char *mesh;
        uint8_t uniform;
    } work[] = {{"shape:hand", 0},
                {"shape:monster", 0},
                {"../shared/meshes/bob_cc1_1336.obj", 0},
                {"shape:torus:52", 6},
                {"shape:torus:52", 7}};
    static hs_packet in[ROW];
    printf(
        "\nViews in a row, by the model: cycles per output face in steady state, with so many in "
        "flight\n\n%-34s %-10s",
        "", "");
    for (uint32_t n = 1; n <= 5; n++)
        printf(" %5u", n);
    printf("\n");
    for (uint32_t i = 0; i < sizeof work / sizeof *work; i++) {
        hs_mesh mesh;
        hs_views views;
        hs_error err;
        hs_settings s = work[i].uniform ? uniform(work[i].uniform) : adaptive(4, 8, true);
        s.boundary = HS_BOUNDARY_SMOOTH;
        if (!hs_mesh_open(&mesh, work[i].mesh, true, true, &err)) continue;
        quit_on(hs_views_orbit(&views, ROW, &mesh, 1, &err), &err);
        for (uint32_t v = 0; v < ROW; v++)
            quit_on(hs_packet_encode(&in[v], v, &mesh, views.view[v].matrix, &s, &err), &err);
        char how[20] = "4/8";
        if (work[i].uniform) snprintf(how, sizeof how, "uniform %u", work[i].uniform);
        printf("%-34s %-10s", work[i].mesh, how);
        for (uint32_t n = 1; n <= 5; n++) {
            printf(" %5.2f", row_of(n, in));
            fflush(stdout);
        }
        printf("\n");
        hs_views_free(&views);
        hs_mesh_free(&mesh);
    }
    printf("%-45s", "memory, Mbit");
    for (uint32_t n = 1; n <= 5; n++) {
        hs_model_config config = HS_DEFAULT_CONFIG;
        config.views = n;
        printf(" %5.0f", (double)hs_model_memory_bits(&config) / 1e6);
    }
    printf("\n");
}

/* --- Scaling ------------------------------------------------------------------------------------
 */
typedef struct scaling {
    FILE *csv;
    hs_rtl *rtl;
    hs_model *model;
    hs_golden *golden;
    double least, most; /* cycles over expected, where that is more than the latencies */
    uint32_t points, on_rtl;
} scaling;

static void measure_point(scaling *c, const hs_mesh *mesh, const float matrix[16],
                          const hs_settings *s, const char *how) {
    hs_packet in = {0}, out = {0};
    hs_golden_report g, r;
    hs_cycle_report cycles, rtl;
    hs_error err;
    quit_on(hs_packet_encode(&in, 0, mesh, matrix, s, &err), &err);
    const double start = hs_seconds();
    quit_on(hs_golden_run(c->golden, &in, &out, &g, &err), &err);
    const double seconds = hs_seconds() - start;
    const uint32_t depth = hs_view_depth(s, mesh);
    const uint64_t expected =
        hs_expected_of(s, depth, g.generation, g.generations, in.words, g.vertices);
    quit_on(hs_model_run(c->model, &in, no_stalls, &out, &r, &cycles, NULL, &err), &err);
    const bool on_rtl =
        g.faces <= MOST_RTL && g.vertices <= MOST_RTL && mesh->halfedges <= MOST_RTL;
    if (on_rtl) {
        quit_on(hs_rtl_run(c->rtl, &in, no_stalls, &out, &rtl, &err), &err);
        if (rtl.cycles != cycles.cycles) {
            fprintf(stderr, "bench: %s: rtl takes %llu cycles, model %llu\n", how,
                    (unsigned long long)rtl.cycles, (unsigned long long)cycles.cycles);
            exit(HS_EXIT_DIFFERENT);
        }
        c->on_rtl++;
    }
    const double ratio = (double)cycles.cycles / (double)expected;
    if (ratio < c->least) c->least = ratio;
    if (ratio > c->most) c->most = ratio;
    c->points++;
    const double bytes = (double)hs_golden_bytes(c->golden) / g.faces;
    printf("%7u %-10s %9u %10llu %6.2f %6.3f %-5s %7.0f %6.1f\n", mesh->faces, how, g.faces,
           (unsigned long long)cycles.cycles, (double)cycles.cycles / g.faces, ratio,
           on_rtl ? "rtl" : "", bytes, 1e-6 * g.faces / seconds);
    fprintf(c->csv, "%u,%s,%u,%u,%llu,%llu,%d,%.6g\n", mesh->faces, how, depth, g.faces,
            (unsigned long long)cycles.cycles, (unsigned long long)expected, on_rtl, bytes);
    fflush(stdout);
    hs_packet_free(&in);
    hs_packet_free(&out);
}

static void compare_sizes(void) {
    static const uint32_t size[] = {100, 1000, 10000, 100000};
    static const hs_limits large = {1 << 24, 1 << 24};
    scaling c = {.least = INFINITY};
    hs_error err;
    hs_file file;
    quit_on(hs_folder_make("out/bench", &err), &err);
    quit_on(hs_file_create(&file, "out/bench/scaling.csv", &err), &err);
    c.csv = file.stream;
    fputs("faces_in,how,depth,faces,cycles,expected,on_rtl,golden_bytes_per_face\n", c.csv);
    quit_on((c.rtl = hs_rtl_new(HS_DEFAULT_LIMITS, 1, &err)) != NULL, &err);
    printf(
        "\nScaling: random bodies; cycles over what is expected of them (docs/timing.md); golden's "
        "memory,\nand its speed from packet to packet in millions of faces a second\n\n"
        "  faces refined to    output     cycles c/face  ratio also bytes/f golden\n");
    for (uint32_t i = 0; i < sizeof size / sizeof *size; i++) {
        hs_mesh mesh;
        hs_views views;
        quit_on(hs_shape_make(&mesh, "random", size[i], 1, &err), &err);
        quit_on(hs_views_orbit(&views, 8, &mesh, 1, &err), &err);
        for (uint32_t depth = 0; depth <= 10; depth++) {
            char how[40];
            hs_settings s = uniform((uint8_t)depth);
            snprintf(how, sizeof how, "uniform:%u", depth);
            /* The model's capacity is the RTL's, unless it is asked for more. */
            const bool fits = (uint64_t)mesh.halfedges << depth >> 1 <= MOST_RTL;
            if ((uint64_t)mesh.halfedges << depth >> 1 > MOST_MODEL) break;
            const hs_limits limits = fits ? HS_DEFAULT_LIMITS : large;
            c.golden = hs_golden_new(limits);
            quit_on((c.model = hs_model_new(limits, HS_DEFAULT_CONFIG, &err)) != NULL, &err);
            measure_point(&c, &mesh, views.view[0].matrix, &s, how);
            if (depth == 8 || (depth == 4 && mesh.faces > 50000)) {
                s = adaptive((uint8_t)(depth / 2), (uint8_t)depth, true);
                snprintf(how, sizeof how, "%u/%u", depth / 2, depth);
                measure_point(&c, &mesh, views.view[0].matrix, &s, how);
            }
            hs_golden_free(c.golden);
            hs_model_free(c.model);
        }
        hs_views_free(&views);
        hs_mesh_free(&mesh);
    }
    quit_on(hs_file_commit(&file, &err), &err);
    hs_rtl_free(c.rtl);
    printf("\n%u points, %u of them on the rtl too; %.3f to %.3f of the expected cycles\n",
           c.points, c.on_rtl, c.least, c.most);
}

int main(void) {
    compare_rows();
    compare_speeds();
    compare_sizes();
    return HS_EXIT_OK;
}
