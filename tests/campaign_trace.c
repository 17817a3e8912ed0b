/* SPDX-License-Identifier: Apache-2.0
 *
 * Cases as traces. trace.txt names the mesh by its path from where the campaign ran, and has the
 * view's matrix; what the case's fault changes in the packet follows as `word` and `cut` lines.
 */
#include <string.h>

#include "campaign_shrink.h"
#include "file.h"
#include "obj.h"
#include "surface_options.h"
#include "trace.h"

/* What of trace.txt makes the good packet. */
static void write_head(FILE *file, const campaign_case *c, hs_limits limits, const char *folder,
                       const char *why) {
    const hs_settings *s = &c->settings;
    const polygons *p = &c->shape;
    fprintf(file, "# %.*s\nmesh %s/mesh.obj\n", (int)strcspn(why, "\n"), why, folder);
    if (limits.vertices != HS_DEFAULT_LIMITS.vertices)
        fprintf(file, "limit-vertices %u\n", limits.vertices);
    if (limits.quads != HS_DEFAULT_LIMITS.quads) fprintf(file, "limit-quads %u\n", limits.quads);
    if (c->stalls.input || c->stalls.output)
        fprintf(file, "stalls %u %u %u\n", c->stalls.input, c->stalls.output, c->stalls.seed);
    fprintf(file, "front %u\nsilhouette %u\nguard %d\n", s->front_depth, s->silhouette_depth,
            s->guard);
    if (s->uniform) fprintf(file, "uniform %u\n", s->uniform_depth);
    fprintf(file, "boundary %s\nlimit %d\n", hs_boundary_name(s->boundary), s->limit);
    if (s->min_edge || s->width || s->height)
        fprintf(file, "edge %u %u %u\n", s->min_edge, s->width, s->height);
    for (uint32_t f = 0, last; f < p->faces; f = last + 1) {
        for (last = f; last + 1 < p->faces && p->forced[last + 1] == p->forced[f];)
            last++;
        if (p->forced[f]) fprintf(file, "force %u-%u %u\n", f + 1, last + 1, p->forced[f]);
    }
    fprintf(file, "matrix");
    for (int i = 0; i < 16; i++)
        fprintf(file, " %.9g", (double)c->matrix[i]);
    fprintf(file, "\n");
}

static void write_changes(FILE *file, const hs_packet *good, const hs_packet *spoiled) {
    for (size_t w = 0; w < spoiled->words; w++)
        if (good->word[w] != spoiled->word[w])
            fprintf(file, "word %zu 0x%x\n", w, spoiled->word[w]);
    if (spoiled->words < good->words) fprintf(file, "cut %zu\n", spoiled->words);
}

static bool write_mesh(const campaign_case *c, const char *folder, hs_error *err) {
    char path[4200];
    hs_mesh mesh;
    snprintf(path, sizeof path, "%s/mesh.obj", folder);
    if (!polygons_build(&c->shape, &mesh, err)) return false;
    const bool good = hs_obj_write_mesh(path, &mesh, err);
    hs_mesh_free(&mesh);
    return good;
}

/* What trace.txt makes is written as input.hss, if it is what the case has. */
static bool write_input(const hs_packet *packet, const char *folder, hs_error *err) {
    char path[4200];
    hs_trace trace;
    snprintf(path, sizeof path, "%s/input.hss", folder);
    if (!hs_trace_compile(&trace, folder, err)) return false;
    const bool same = hs_compare_words(packet, &trace.input.packet[0]).different == 0;
    const bool good =
        same ? hs_stream_file_write(&trace.input, path, err)
             : hs_fail(err, HS_EXIT_INTERNAL, "%.300s: trace.txt makes another packet", folder);
    hs_trace_free(&trace);
    return good;
}

bool campaign_write(const campaign_case *c, const char *folder, const char *why, hs_error *err) {
    char path[4200];
    hs_packet good = {0}, spoiled = {0};
    hs_limits limits;
    uint32_t wanted;
    hs_file file;
    snprintf(path, sizeof path, "%s/trace.txt", folder);
    bool done = hs_folder_make(folder, err) && write_mesh(c, folder, err) &&
                campaign_good_packet(c, &good, err) &&
                campaign_packet(c, &spoiled, &limits, &wanted, err) &&
                hs_file_create(&file, path, err);
    if (done) {
        write_head(file.stream, c, limits, folder, why);
        write_changes(file.stream, &good, &spoiled);
        done = hs_file_commit(&file, err) && write_input(&spoiled, folder, err);
    }
    hs_packet_free(&good);
    hs_packet_free(&spoiled);
    return done;
}

bool campaign_replay(checker *c, const char *folder, hs_error *err) {
    hs_trace trace;
    c->failed = NULL;
    *err = (hs_error){0};
    if (!hs_trace_compile(&trace, folder, err)) return false;
    bool good = true;
    for (uint32_t i = 0; good && i < trace.input.packets; i++) {
        const hs_packet *packet = &trace.input.packet[i];
        good = checker_check(c, packet, trace.limits, trace.stalls, CHECK_ANY_STATUS);
    }
    hs_trace_free(&trace);
    return good;
}
