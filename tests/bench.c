/* SPDX-License-Identifier: Apache-2.0
 *
 * How fast golden is, beside OpenSubdiv: uniform refinement of one mesh, on one thread, in this
 * one process, in turns, the least of several rounds each. `make bench` runs it.
 *
 * Refinement is, for golden, from the initial active mesh, quantized, to the complete active mesh
 * of generation D = 2 levels: twins, origins and positions of every quad; for OpenSubdiv,
 * RefineUniform (topology) and PrimvarRefiner (positions, four floats a vertex), from a base mesh
 * whose topology is complete. Packet is from input packet to output packet, both with CRC, checks
 * and transform included; OpenSubdiv has no such thing.
 *
 * Both ask the system for tens of megabytes, and to get them page by page takes about as long as
 * the work itself. So there are two comparisons, each under the same terms. Fresh: golden in a new
 * context, OpenSubdiv in a new refiner, and malloc returns what is freed to the system; all pages
 * are new, as in a program's first view. Warm: golden in a context that had this view before;
 * OpenSubdiv in a new refiner (it has no other way), but malloc keeps what is freed, so that its
 * pages are there. OpenSubdiv's positions alone, without topology, tell how fast the machine is.
 */
#define PROGRAM "bench"

#include <malloc.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "golden_state.h"
#include "obj.h"
#include "osd.h"
#include "progress.h"
#include "quit.h"
#include "shape.h"

#define MESH "../shared/meshes/bob_cc1_1336.obj"

enum { ROUNDS = 9 };
static const hs_limits limits = {1 << 24, 1 << 24};

/* Seconds from the initial active mesh to the one of a generation. */
typedef struct {
    uint32_t generation, faces;
    double start, end;
} stopwatch;

static void press(void *context, const hs_state *s) {
    stopwatch *w = context;
    if (s->generation == 0) w->start = hs_seconds();
    if (s->generation != w->generation) return;
    w->end = hs_seconds();
    w->faces = s->faces;
}

static void run(hs_golden *golden, const hs_mesh *mesh, uint32_t depth, hs_packet *out) {
    static const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const hs_settings settings = {.uniform = true, .uniform_depth = (uint8_t)depth};
    hs_packet in = {0};
    hs_golden_report report;
    hs_error err;
    quit_on(hs_packet_encode(&in, 0, mesh, identity, &settings, &err), &err);
    quit_on(hs_golden_run(golden, &in, out, &report, &err), &err);
    hs_packet_free(&in);
}

static hs_golden *new_golden(void) {
    hs_golden *golden = hs_golden_new(limits);
    if (golden) return golden;
    fprintf(stderr, "bench: no memory\n");
    exit(HS_EXIT_INTERNAL);
}

/* The step behind generation D is not the last one, so the quads of D are stored, not sent. */
static double time_refinement(hs_golden *golden, const hs_mesh *mesh, uint32_t depth,
                              uint32_t *faces) {
    stopwatch watch = {.generation = depth};
    hs_packet out = {0};
    hs_golden_observe(golden, &(hs_observer){.context = &watch, .levels = true, .entered = press});
    run(golden, mesh, depth + 1, &out);
    hs_golden_observe(golden, NULL);
    hs_packet_free(&out);
    *faces = watch.faces;
    return watch.end - watch.start;
}

static double time_packet(hs_golden *golden, const hs_mesh *mesh, uint32_t depth, hs_packet *out) {
    const double start = hs_seconds();
    run(golden, mesh, depth, out);
    return hs_seconds() - start;
}

static void keep_least(double *least, double seconds) {
    if (*least == 0 || seconds < *least) *least = seconds;
}

/* Whether malloc keeps what is freed, or returns it to the system. */
static void keep_memory(bool keep) {
    mallopt(M_MMAP_THRESHOLD, keep ? 1 << 25 : 1 << 17); /* the most that it takes, the default */
    mallopt(M_TRIM_THRESHOLD, keep ? 1 << 30 : 1 << 17);
    malloc_trim(0);
}

static void keep_least_osd(double *least, double *positions, const hs_mesh *mesh, uint32_t levels) {
    osd_timing osd;
    hs_error err;
    quit_on(osd_time(&osd, mesh, levels, &err), &err);
    keep_least(least, osd.topology + osd.position);
    keep_least(positions, osd.position);
}

static void compare_at(const hs_mesh *mesh, uint32_t levels) {
    double fresh = 0, osd_fresh = 0, warm = 0, osd_warm = 0, packet = 0, positions = 0;
    const int rounds = levels < 5 ? ROUNDS : 5; /* a round takes seconds */
    uint32_t faces = 0;
    keep_memory(false);
    for (int i = 0; i < rounds; i++) {
        hs_golden *golden = new_golden();
        keep_least(&fresh, time_refinement(golden, mesh, 2 * levels, &faces));
        hs_golden_free(golden);
        keep_least_osd(&osd_fresh, &positions, mesh, levels);
    }
    keep_memory(true);
    hs_golden *golden = new_golden();
    hs_packet out = {0};
    time_refinement(golden, mesh, 2 * levels, &faces);
    for (int i = 0; i < rounds; i++) {
        keep_least(&warm, time_refinement(golden, mesh, 2 * levels, &faces));
        keep_least(&packet, time_packet(golden, mesh, 2 * levels, &out));
        keep_least_osd(&osd_warm, &positions, mesh, levels);
    }
    const double m = 1e-6 * faces;
    printf("%5u %5u %8u | %6.1f %6.1f %5.2f | %6.1f %6.1f %5.2f | %7.1f | %7.1f\n", levels,
           2 * levels, faces, m / fresh, m / osd_fresh, osd_fresh / fresh, m / warm, m / osd_warm,
           osd_warm / warm, m / packet, m / positions);
    hs_packet_free(&out);
    hs_golden_free(golden);
}

int main(void) {
    hs_mesh mesh;
    hs_error err;
    const char *name = MESH;
    if (!hs_obj_read(&mesh, MESH, false, NULL, &err)) {
        name = "torus, size 52"; /* 52 * 26 quads, about as many */
        quit_on(hs_shape_make(&mesh, "torus", 52, 0, &err), &err);
    }
    printf("uniform refinement of %s: %u faces, %u vertices; one thread;\n"
           "millions of output faces per second, the best of %d rounds\n\n",
           name, mesh.faces, mesh.vertices, ROUNDS);
    printf(
        "                     |    fresh memory     |     warm memory     | golden, | OpenSD,\n"
        "level depth    faces | golden OpenSD ratio | golden OpenSD ratio |  packet | positions\n");
    for (uint32_t levels = 2; levels <= 6; levels += levels < 4 ? 1 : 2)
        compare_at(&mesh, levels);
    hs_mesh_free(&mesh);
    return HS_EXIT_OK;
}
