/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep explore: the cycle-level model over a space of micro-architectures and views, on all
 * cores, and on as many machines as there are shards.
 */
#include <math.h>
#include <stdlib.h>

#include "commands.h"
#include "explore_work.h"
#include "file.h"
#include "mesh_source.h"
#include "options.h"
#include "surface_options.h"
#include "terminal.h"

static const hs_command COMMAND = {
    .name = "explore",
    .operands = "MESH",
    .least = 1,
    .most = 1,
    .what = "cycles, memory and traffic over a space of micro-architectures, by the model",
    .text =
        "  halfstep explore shape:hand --orbit 8 --set banks=2,4,8,16 --set window=2,4,8\n"
        "      twelve architectures times eight views; explore.csv and explore.json in\n"
        "      out/explore\n"
        "  halfstep explore bunny.obj --set lanes=1,2,4,8 --clock 800 --out out/lanes\n"
        "      with views per second at 800 MHz\n"
        "  halfstep explore bunny.obj --set lanes=1,2,4,8 --out out/lanes --shard 3/8\n"
        "      the third of eight parts; without --shard, the same command does what is\n"
        "      missing and puts all parts together\n\n"
        "Parameters: port (records of 128 bits in a beat), banks, window (items that compete for\n"
        "them), lanes (words a cycle), latency (of a read), ops (that wait for emit), views (in\n"
        "flight: all views then stream through in a row), parity (of the memories: 0 or 1).\n"
        "What is done is kept in the folder: an interrupted run goes on where it was.\n"};

typedef struct request {
    const char *mesh, *views, *force, *out, *clock_text, *shard_text, *size;
    hs_option_list set;
    uint32_t orbit, jobs;
    uint32_t width, height, shard, shards;
    bool orbit_given, round_sharpness, quiet;
    hs_surface_options surface;
    hs_settings settings;
    hs_limits limits;
    double clock;
} request;

/* --- Options ------------------------------------------------------------------------------------
 */
static bool complete(request *r, hs_error *err) {
    if (!hs_pair_parse(r->size, 'x', &r->width, &r->height) || !r->width || !r->height ||
        r->width > 65535 || r->height > 65535)
        return hs_fail(err, HS_EXIT_USAGE, "--size is \"%.40s\"; it should be WIDTHxHEIGHT",
                       r->size);
    r->shard = r->shards = 1;
    if (r->shard_text && (!hs_pair_parse(r->shard_text, '/', &r->shard, &r->shards) ||
                          r->shard < 1 || r->shard > r->shards || r->shards > 100000))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--shard is \"%.40s\"; it should be I/N, the I-th of N parts, as in 1/8",
                       r->shard_text);
    if (r->clock_text) {
        char *end;
        r->clock = strtod(r->clock_text, &end);
        if (*end || !(r->clock > 0) || !isfinite(r->clock))
            return hs_fail(err, HS_EXIT_USAGE, "--clock is \"%.40s\"; it should be megahertz",
                           r->clock_text);
    }
    if (r->views && r->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE, "--views and --orbit exclude each other; give one");
    return hs_surface_settings(&r->settings, &r->surface, r->force != NULL, r->width, r->height,
                               err);
}

static enum hs_parsed parse(request *r, int argc, char **argv, hs_error *err) {
    *r = (request){.out = "out/explore",
                   .size = "768x768",
                   .orbit = 1,
                   .surface = HS_SURFACE_DEFAULTS,
                   .limits = HS_DEFAULT_LIMITS};
    const hs_option option[] = {
        {"set", 0, HS_OPTION_LIST, "NAME=V,V", &r->set, 0, 0, NULL,
         "values of a parameter to try; once for each"},
        {"orbit", 'n', HS_OPTION_NUMBER, "N", &r->orbit, 1, 65536, &r->orbit_given,
         "N viewpoints on a circle around the mesh (1)"},
        {"views", 'v', HS_OPTION_TEXT, "FILE", &r->views, 0, 0, NULL, "viewpoints from a file"},
        {"front", 'f', HS_OPTION_NUMBER, "DEPTH", &r->surface.front, 0, HS_MAX_DEPTH,
         &r->surface.front_given, "steps for front faces in view (4)"},
        {"silhouette", 's', HS_OPTION_NUMBER, "DEPTH", &r->surface.silhouette, 0, HS_MAX_DEPTH,
         &r->surface.silhouette_given, "steps for faces at the silhouette (8)"},
        {"guard", 'g', HS_OPTION_NUMBER, "0|1", &r->surface.guard, 0, 1, NULL,
         "refine the ring around selected faces as well (1)"},
        {"uniform", 'u', HS_OPTION_NUMBER, "DEPTH", &r->surface.uniform, 0, HS_MAX_DEPTH,
         &r->surface.uniform_given, "so many steps everywhere"},
        {"min-edge-px", 0, HS_OPTION_TEXT, "PIXELS", &r->surface.min_edge, 0, 0, NULL,
         "leave faces alone whose edges are all shorter; depths\nthat are not given then are 24"},
        {"boundary", 'b', HS_OPTION_TEXT, "MODE", &r->surface.boundary, 0, 0, NULL,
         "kept, smooth or edge-only (smooth)"},
        {"limit", 'l', HS_OPTION_FLAG, NULL, &r->surface.limit, 0, 0, NULL,
         "send vertices at their limit positions"},
        {"round-sharpness", 0, HS_OPTION_FLAG, NULL, &r->round_sharpness, 0, 0, NULL,
         "round fractions of a sharpness, halves up"},
        {"force", 0, HS_OPTION_TEXT, "FILE", &r->force, 0, 0, NULL, "depths for single faces"},
        {"size", 0, HS_OPTION_TEXT, "WxH", &r->size, 0, 0, NULL,
         "pixels of a picture, and the views' aspect (768x768)"},
        {"clock", 0, HS_OPTION_TEXT, "MHZ", &r->clock_text, 0, 0, NULL,
         "tell views per second as well"},
        {"shard", 0, HS_OPTION_TEXT, "I/N", &r->shard_text, 0, 0, NULL,
         "only the I-th of N parts of the points"},
        {"jobs", 'j', HS_OPTION_NUMBER, "N", &r->jobs, 1, 1024, NULL,
         "points at a time (as many as there are cores)"},
        {"out", 'o', HS_OPTION_TEXT, "DIR", &r->out, 0, 0, NULL,
         "folder for what is done, and for the reports (out/explore)"},
        {"quiet", 'q', HS_OPTION_FLAG, NULL, &r->quiet, 0, 0, NULL, "no notes, no progress line"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&COMMAND, option, argc, argv, &operand, err);
    if (parsed != HS_PARSED) return parsed;
    r->mesh = argv[operand];
    return complete(r, err) ? HS_PARSED : HS_PARSED_WRONG;
}

/* --- The command --------------------------------------------------------------------------------
 */
/* What is explored, in one number: the packets of all views, and the space. */
static bool encode_views(hs_exploration *e, const request *r, uint32_t *fingerprint,
                         hs_error *err) {
    e->packet = calloc(e->views.count, sizeof *e->packet);
    if (!e->packet) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the views");
    *fingerprint = 0;
    for (uint32_t v = 0; v < e->views.count; v++) {
        hs_packet *p = &e->packet[v];
        if (!hs_packet_encode(p, v, &e->mesh, e->views.view[v].matrix, &r->settings, err))
            return false;
        /* Without its own CRC, behind which that of any packet is the same. */
        *fingerprint = hs_crc(*fingerprint, p->word, p->words - 1);
    }
    for (uint64_t point = 0; point < e->points; point += e->views.count) {
        const hs_model_config config = hs_explore_config(&e->space, point);
        uint32_t word[HS_EXPLORE_NAMES];
        for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
            word[p] = hs_explore_value(&config, p);
        *fingerprint = hs_crc(*fingerprint, word, HS_EXPLORE_NAMES);
    }
    return true;
}

static bool make_space(hs_exploration *e, const request *r, hs_error *err) {
    hs_explore_space_start(&e->space, e->views.count);
    for (uint32_t i = 0; i < r->set.count; i++)
        if (!hs_explore_set(&e->space, r->set.text[i], err)) return false;
    e->points = hs_explore_points(&e->space);
    e->row = e->points < (uint64_t)1 << 32 ? calloc(e->points, sizeof *e->row) : NULL;
    return e->row || hs_fail(err, HS_EXIT_INTERNAL, "no memory for %llu points",
                             (unsigned long long)e->points);
}

static bool prepare(hs_exploration *e, const request *r, hs_error *err) {
    uint32_t fingerprint = 0;
    if (!hs_mesh_open(&e->mesh, r->mesh, r->round_sharpness, r->quiet, err)) return false;
    if (r->force && !hs_mesh_force(&e->mesh, r->force, err)) return false;
    e->depth = hs_view_depth(&r->settings, &e->mesh);
    const double aspect = (double)r->width / (double)r->height;
    if (!hs_views_open(&e->views, r->views, r->orbit, &e->mesh, aspect, err) ||
        !make_space(e, r, err) || !encode_views(e, r, &fingerprint, err))
        return false;
    return hs_folder_make(r->out, err) &&
           hs_explore_journal_open(&e->journal, r->out, r->shard, r->shards, fingerprint, e->row,
                                   e->points, err);
}

static bool report(const hs_exploration *e, const request *r, hs_error *err) {
    if (r->shards > 1) {
        printf("part %u of %u: %llu points in %s; the same command without --shard puts the parts "
               "together\n",
               r->shard, r->shards, (unsigned long long)e->mine, r->out);
        return true;
    }
    const hs_explore_result result = {
        .space = &e->space, .row = e->row, .mesh = r->mesh, .clock = r->clock};
    char path[4200];
    snprintf(path, sizeof path, "%.4000s/explore.csv", r->out);
    if (!hs_explore_write_csv(&result, path, err)) return false;
    snprintf(path, sizeof path, "%.4000s/explore.json", r->out);
    if (!hs_explore_write_json(&result, path, err)) return false;
    char what[4400];
    snprintf(what, sizeof what,
             "%.4000s: %u faces; %u view%s; read, write: bytes of memory traffic a face", r->mesh,
             e->mesh.faces, e->views.count, e->views.count == 1 ? "" : "s");
    hs_print_wrapped(stdout, 0, 0, what);
    printf("\n");
    hs_explore_print(&result, stdout);
    printf("\n* no other is better in both cycles and memory\n%s/explore.csv, explore.json\n",
           r->out);
    return true;
}

int hs_command_explore(int argc, char **argv, hs_error *err) {
    request r;
    const enum hs_parsed parsed = parse(&r, argc, argv, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    hs_exploration e = {.settings = &r.settings,
                        .limits = r.limits,
                        .shard = r.shard,
                        .shards = r.shards,
                        .journal = {.file = -1}};
    const bool good =
        prepare(&e, &r, err) && hs_explore_work(&e, r.jobs, r.quiet, err) && report(&e, &r, err);
    hs_explore_journal_close(&e.journal);
    for (uint32_t v = 0; e.packet && v < e.views.count; v++)
        hs_packet_free(&e.packet[v]);
    free(e.packet);
    free(e.row);
    hs_views_free(&e.views);
    hs_mesh_free(&e.mesh);
    return good ? HS_EXIT_OK : (int)err->code;
}
