/* SPDX-License-Identifier: Apache-2.0
 *
 * The whole way: a mesh and a view as people write them, through the readers, the encoder, golden
 * and the decoder, to the invariants (invariants.h). An input is a text:
 *
 *   FRONT SILHOUETTE UNIFORM FLAGS EDGE FORCED     depths, the packet's flags, least edge, a depth
 *                                                  forced upon every third face
 *   a line of a views file
 *   an OBJ file
 *
 * What the readers take, the pipeline does not refuse, unless a transformed vertex is not finite.
 */
#include "fuzz.h"

#include <stdlib.h>
#include <string.h>

#include "compare.h"
#include "invariants.h"
#include "model.h"
#include "obj.h"
#include "view.h"

enum { MOST_HALFEDGES = 60, DEPTHS = 7 }; /* depths count modulo that */
static const hs_limits limits = {.vertices = 1 << 14, .quads = 1 << 14};

typedef struct engines {
    hs_golden *golden, *poisoned;
    hs_model *model;
    uint8_t poison;
    uniform_record uniform;
    invariant_watch watch;
    hs_packet in, out, other;
} engines;

static engines *new_engines(void) {
    static engines e;
    if (e.golden) return &e;
    hs_error err = {0};
    e.golden = hs_golden_new(limits);
    e.poisoned = hs_golden_new(limits);
    e.model = hs_model_new(limits, HS_DEFAULT_CONFIG, &err);
    fuzz_claim(e.golden && e.poisoned && e.model, "no engines: %s", err.text);
    const hs_observer poisoner = invariant_poisoner(&e.poison);
    hs_golden_observe(e.poisoned, &poisoner);
    return &e;
}

/* --- The input ----------------------------------------------------------------------------------
 */

/* Cuts the first line off; what stands behind it. */
static char *next_line(char *text) {
    char *end = text + strcspn(text, "\n");
    if (*end) *end++ = 0;
    return end;
}

static bool read_settings(const char *line, hs_settings *settings, uint32_t *forced) {
    uint32_t number[6];
    char *end;
    for (int i = 0; i < 6; i++) {
        number[i] = (uint32_t)strtoul(line, &end, 10);
        if (end == line) return false;
        line = end;
    }
    const uint32_t mode = number[3] / HS_FLAG_SMOOTH % 4;
    *settings = (hs_settings){.front_depth = (uint8_t)(number[0] % DEPTHS),
                              .silhouette_depth = (uint8_t)(number[1] % DEPTHS),
                              .uniform_depth = (uint8_t)(number[2] % DEPTHS),
                              .uniform = number[3] & HS_FLAG_UNIFORM,
                              .guard = number[3] & HS_FLAG_GUARD,
                              .limit = number[3] & HS_FLAG_LIMIT,
                              .boundary = (hs_boundary)(mode % 3),
                              .min_edge = (uint16_t)number[4],
                              .width = 64,
                              .height = 48};
    *forced = number[5] % DEPTHS;
    return true;
}

/* --- The claims ---------------------------------------------------------------------------------
 */

static void claim_same_words(const hs_packet *a, const hs_packet *b, const char *what) {
    const hs_word_comparison c = hs_compare_words(a, b);
    fuzz_claim(c.different == 0, "%s: %llu of %llu words differ, from word %zu", what,
               (unsigned long long)c.different, (unsigned long long)c.compared, c.first);
}

/* The output is a surface: I1, and every vertex of the mesh is still there or was refined away. */
static void claim_surface(engines *e, const hs_mesh *mesh, const hs_settings *settings) {
    hs_output output;
    hs_error err;
    uint64_t edges = 0;
    if (!hs_output_decode(&output, &e->out, &err) ||
        !invariant_conforming(&output, mesh, settings->boundary, &edges, &err))
        fuzz_claim(false, "%s", err.text);
    fuzz_claim(edges > 0 && output.faces >= mesh->faces, "%u faces of %u", output.faces,
               mesh->faces);
    hs_output_free(&output);
}

/* I2, I3: what a view refines is a part of the uniform surface. */
static void claim_part(engines *e, const hs_mesh *mesh, const hs_view *view,
                       const hs_settings *settings) {
    hs_golden_report report;
    hs_error err = {0};
    if (!uniform_record_make(&e->uniform, e->golden, mesh, view->matrix, settings, &err)) {
        fuzz_claim(err.code == HS_EXIT_REFUSED, "%s",
                   err.text); /* the uniform one may be too large */
        return;
    }
    const hs_observer observer = invariant_watch_begin(&e->watch, &e->uniform);
    hs_golden_observe(e->golden, &observer);
    const bool ran = hs_golden_run(e->golden, &e->in, &e->other, &report, &err);
    hs_golden_observe(e->golden, NULL);
    fuzz_claim(ran && e->watch.good, "%s", ran ? e->watch.error.text : err.text);
    claim_same_words(&e->out, &e->other, "golden, watched");
}

static bool run_view(engines *e, const hs_mesh *mesh, const hs_view *view,
                     const hs_settings *settings) {
    hs_golden_report report, other;
    hs_cycle_report cycles;
    hs_error err = {0};
    const hs_stalls stalls = {0};
    if (!hs_packet_encode(&e->in, 1, mesh, view->matrix, settings, &err) ||
        !hs_golden_run(e->golden, &e->in, &e->out, &report, &err))
        fuzz_claim(false, "%s", err.text);
    fuzz_claim(report.status <= HS_STATUS_STOPPED || report.status == HS_STATUS_OVERFLOW,
               "refused: %s at %u", hs_status_name(report.status), report.error_position);
    fuzz_claim(hs_golden_run(e->poisoned, &e->in, &e->other, &other, &err) &&
                   hs_model_run(e->model, &e->in, stalls, &e->other, &other, &cycles, NULL, &err),
               "%s", err.text);
    claim_same_words(&e->out, &e->other, "model");
    fuzz_claim(hs_golden_run(e->poisoned, &e->in, &e->other, &other, &err), "%s", err.text);
    claim_same_words(&e->out, &e->other, "golden, its memory overwritten");
    if (report.status > HS_STATUS_STOPPED) return false;
    claim_surface(e, mesh, settings);
    if (report.status == HS_STATUS_OK && settings->guard && !settings->uniform)
        claim_part(e, mesh, view, settings);
    return true;
}

static fuzz_verdict run_surface(const uint8_t *bytes, size_t size) {
    fuzz_verdict verdict = FUZZ_REFUSED;
    hs_settings settings;
    hs_views views = {0};
    hs_mesh mesh = {0};
    hs_error err;
    uint32_t forced;
    char *text = fuzz_copy(bytes, size), *line = next_line(text), *obj = next_line(line);
    if (read_settings(text, &settings, &forced) &&
        hs_views_parse(&views, "", line, strlen(line), 1.5, &err) &&
        hs_obj_parse(&mesh, "", obj, strlen(obj), true, NULL, &err) &&
        mesh.halfedges <= MOST_HALFEDGES) {
        for (uint32_t f = 0; f < mesh.faces; f += 3)
            mesh.forced[f] = (uint8_t)forced;
        if (run_view(new_engines(), &mesh, &views.view[0], &settings)) verdict = FUZZ_TAKEN;
    }
    hs_views_free(&views);
    hs_mesh_free(&mesh);
    free(text);
    return verdict;
}

const fuzz_target fuzz_surface = {.name = "surface", .longest = 1500, .run = run_surface};
