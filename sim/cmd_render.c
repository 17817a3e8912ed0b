/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep render: one figure of a mesh, or of a stream, as a PNG file.
 *
 *   mesh, views, depths ----------------------.
 *   packet in, from a file: all of the above --+-> golden -> figure -> PNG
 *   packet out, from a file ---------------------------------^
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "figures.h"
#include "file.h"
#include "mesh_source.h"
#include "options.h"
#include "png_file.h"
#include "run_pictures.h"
#include "surface_options.h"
#include "view.h"

static const char EXAMPLES[] =
    "MESH is an OBJ file or shape:NAME[:SIZE[:SEED]] (`halfstep mesh list`).\n"
    "STREAM.hss is a file of packets, as in the folders of traces. A packet in brings mesh, view\n"
    "and depths along; a packet out is drawn as it is: refined, refined-wires, closeup, and with\n"
    "the views that it was made for (--views) from the side, too.\n"
    "\n"
    "Examples:\n"
    "  halfstep render shape:hand -o hand.png\n"
    "      a hand, refined for the viewpoint in front of it\n"
    "  halfstep render bob.obj --orbit 8 --view 3 --what triptych -o bob.png\n"
    "      initial mesh, refined mesh, the same from the side; the fourth of 8 views\n"
    "  halfstep render shape:mixed --what steps --size 320x320 -o steps.png\n"
    "      uniform steps 0 to 4; two of them make one Catmull-Clark level\n"
    "  halfstep render shape:grid:16 --what ramp -o ramp.png\n"
    "      how faces of all depths meet without a crack\n"
    "  halfstep render shape:grid -f 0 -s 0 --force my.txt -w refined-wires -o my.png\n"
    "      depths of your own: lines `FIRST-LAST DEPTH`\n"
    "  halfstep render bob.obj -v my.txt --view 2 -w closeup --samples 4 -o tip.png\n"
    "      nine times enlarged, where the silhouette is finest\n"
    "  halfstep render shape:hand --json -\n"
    "      how many faces there are, in each generation\n"
    "  halfstep render output.hss --view 5 --what refined-wires -o view5.png\n"
    "      what a pipeline sent for view 5\n";

/* What was asked for. Text belongs to the command line. */
typedef struct request {
    const char *source, *views, *force, *what, *file, *json, *title;
    uint32_t orbit, view, turn, width, height, samples, levels, columns;
    bool views_given, orbit_given, view_given, depths_given; /* depths: anything that refines */
    bool quiet;
    bool round_sharpness;
    hs_settings settings;
} request;

/* What is drawn. */
typedef struct scene {
    hs_mesh mesh;
    hs_output output;
    float matrix[16];
    float aside[16];      /* of the turntable's second camera */
    uint32_t view, views; /* which of how many */
    bool has_mesh, has_output, has_matrix;
    bool forced; /* depths of single faces were asked for */
    hs_settings settings;
} scene;

static void free_scene(scene *s) {
    hs_mesh_free(&s->mesh);
    hs_output_free(&s->output);
}

/* --- The command line ------------------------------------------------------------------------- */

/* Options whose values are looked at behind the table. */
typedef struct texts {
    const char *size;
    hs_surface_options surface;
} texts;

static bool check_figure(const char *what, hs_error *err) {
    if (hs_figure_exists(what)) return true;
    enum { MOST = 32 };
    const char *name[MOST + 1] = {NULL};
    for (uint32_t i = 0; i < MOST && hs_figure_name(i); i++)
        name[i] = hs_figure_name(i);
    const char *nearest = hs_nearest(what, name);
    if (nearest)
        return hs_fail(err, HS_EXIT_USAGE,
                       "halfstep render: no figure \"%.40s\"; did you mean \"%s\"?", what, nearest);
    return hs_fail(err, HS_EXIT_USAGE,
                   "halfstep render: no figure \"%.40s\"; `halfstep render --help` lists them",
                   what);
}

static bool complete(request *r, const texts *t, hs_error *err) {
    if (!r->file && !r->json)
        return hs_fail(err, HS_EXIT_USAGE,
                       "halfstep render: where to? add -o FILE.png, or --json FILE to count only");
    if (r->file && r->json && strcmp(r->file, r->json) == 0)
        return hs_fail(err, HS_EXIT_USAGE,
                       "halfstep render: picture and counts cannot both go to %.300s; give --json "
                       "another file",
                       r->file);
    if (!check_figure(r->what, err)) return false;
    if (!hs_size_parse(t->size, &r->width, &r->height, err)) return false;
    if (r->views_given && r->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE, "--views and --orbit exclude each other; give one");
    const hs_surface_options *o = &t->surface;
    r->depths_given = o->front_given || o->silhouette_given || o->guard_given || o->uniform_given ||
                      o->boundary || o->limit || o->min_edge || r->force;
    return hs_surface_settings(&r->settings, o, r->force != NULL, r->width, r->height, err);
}

/* The figures as lines of help. */
static void list_figures(char *text, size_t size) {
    size_t used = (size_t)snprintf(text, size, "which figure (refined):\n");
    for (uint32_t i = 0; hs_figure_name(i) && used < size; i++)
        used += (size_t)snprintf(text + used, size - used, "  %-14s %s\n", hs_figure_name(i),
                                 hs_figure_what(hs_figure_name(i)));
}

static enum hs_parsed parse(request *r, int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "render",
        "MESH|STREAM.hss",
        1,
        1,
        "Draws a figure of a mesh, refined by the golden model, or of a stream",
        EXAMPLES};
    char figures[3000];
    list_figures(figures, sizeof figures);
    *r = (request){.what = "refined",
                   .orbit = 1,
                   .turn = (uint32_t)HS_SIDE_DEGREES,
                   .samples = 3,
                   .levels = HS_REFERENCE_SURFACE_LEVELS};
    texts t = {.size = "768x768", .surface = HS_SURFACE_DEFAULTS};
    const hs_option option[] = {
        {"out", 'o', HS_OPTION_TEXT, "FILE", &r->file, 0, 0, NULL, "the PNG file to write"},
        {"json", 0, HS_OPTION_TEXT, "FILE", &r->json, 0, 0, NULL,
         "how many faces are shown, in each generation; without\n-o nothing is drawn"},
        {"what", 'w', HS_OPTION_TEXT, "FIGURE", &r->what, 0, 0, NULL, figures},
        {"orbit", 'n', HS_OPTION_NUMBER, "N", &r->orbit, 1, 65536, &r->orbit_given,
         "N viewpoints on a circle around the mesh (1)"},
        {"views", 'v', HS_OPTION_TEXT, "FILE", &r->views, 0, 0, &r->views_given,
         "viewpoints from a file: `matrix` or `look` lines"},
        {"view", 0, HS_OPTION_NUMBER, "N", &r->view, 0, 65535, &r->view_given,
         "which of them, or which of a stream's views (0; of a\nstream, its first)"},
        HS_REFINED_OPTIONS(t.surface, r->round_sharpness, r->force),
        {"turn", 0, HS_OPTION_NUMBER, "DEGREES", &r->turn, 0, 360, NULL,
         "how far to the right figures from the side go (80)"},
        {"size", 0, HS_OPTION_TEXT, "WxH", &t.size, 0, 0, NULL,
         "pixels of a picture; of a sheet, those of each (768x768)"},
        {"samples", 0, HS_OPTION_NUMBER, "N", &r->samples, 1, 4, NULL,
         "N x N samples a pixel, 1 to 4 (3)"},
        {"levels", 0, HS_OPTION_NUMBER, "N", &r->levels, 1, 8, NULL,
         "Catmull-Clark levels of the reference surface (4)"},
        {"columns", 0, HS_OPTION_NUMBER, "N", &r->columns, 1, HS_VIEW_COUNT, NULL,
         "pictures in a row of a sheet"},
        {"title", 0, HS_OPTION_TEXT, "TEXT", &r->title, 0, 0, NULL, "above a sheet"},
        {"quiet", 'q', HS_OPTION_FLAG, NULL, &r->quiet, 0, 0, NULL, "no notes"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed != HS_PARSED) return parsed;
    r->source = argv[operand];
    return complete(r, &t, err) ? HS_PARSED : HS_PARSED_WRONG;
}

/* --- A mesh and its view ---------------------------------------------------------------------- */

/* The matrix of view N of --views, or of --orbit around the mesh; without a mesh, of --views. The
 * second camera stands an eighth of the way round. */
static bool choose_view(scene *s, const request *r, uint32_t number, const hs_mesh *mesh,
                        hs_error *err) {
    if (!r->views && !mesh)
        return hs_fail(err, HS_EXIT_USAGE, "%.300s: no mesh to go around; give --views", r->source);
    hs_views views;
    hs_view view;
    if (!hs_views_open(&views, r->views, r->orbit, mesh, (double)r->width / r->height, err))
        return false;
    const bool there = hs_views_choose(&view, &views, number, err);
    if (there) {
        memcpy(s->matrix, view.matrix, sizeof s->matrix);
        memcpy(s->aside, views.view[views.count / 8].matrix, sizeof s->aside);
        s->view = number;
        s->views = views.count;
    }
    hs_views_free(&views);
    return there;
}

static bool open_mesh(scene *s, const request *r, hs_error *err) {
    if (!hs_mesh_open(&s->mesh, r->source, r->round_sharpness, r->quiet, err)) return false;
    if (r->force && !hs_mesh_force(&s->mesh, r->force, err)) return false;
    s->settings = r->settings;
    s->forced = r->force != NULL;
    s->has_mesh = s->has_matrix = true;
    return choose_view(s, r, r->view, &s->mesh, err);
}

/* --- A stream --------------------------------------------------------------------------------- */

/* The packet of the view that is asked for; the first one if none is. */
static bool find_packet(hs_packet *packet, const request *r, hs_error *err) {
    const size_t limit = (size_t)4 << 30;
    uint8_t *bytes;
    size_t size, offset = 0;
    if (!hs_file_read(r->source, limit, &bytes, &size, err)) return false;
    bool found = false, good = true;
    while (good && !found && offset < size) {
        good = hs_frame_read(packet, bytes, size, &offset, r->source, err);
        found = good && (!r->view_given || packet->view == r->view);
    }
    free(bytes);
    if (!good || found) return found;
    if (size == 0) return hs_fail(err, HS_EXIT_STREAM, "%.300s: an empty file", r->source);
    return hs_fail(err, HS_EXIT_STREAM, "%.300s: no packet of view %u in it", r->source, r->view);
}

/* Takes mesh, matrix and settings out of a packet in that golden has accepted, so that all counts
 * and fields are as they should be (docs/stream.md). */
static bool unpack(scene *s, const hs_packet *packet, const char *name, hs_error *err) {
    const uint32_t *w = packet->word, flags = w[2], depths = w[6];
    const uint32_t vertices = w[3], faces = w[4], corners = w[5];
    const uint32_t *position = w + 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS);
    const uint32_t *halfedge = position + 4 * (size_t)vertices;
    memcpy(s->matrix, w + 4 * HS_HEADER_RECORDS, sizeof s->matrix);
    s->settings = (hs_settings){.front_depth = (uint8_t)depths,
                                .silhouette_depth = (uint8_t)(depths >> 8),
                                .uniform_depth = (uint8_t)(depths >> 16),
                                .uniform = flags & HS_FLAG_UNIFORM,
                                .guard = flags & HS_FLAG_GUARD,
                                .limit = flags & HS_FLAG_LIMIT,
                                .boundary = flags & HS_FLAG_SMOOTH      ? HS_BOUNDARY_SMOOTH
                                            : flags & HS_FLAG_EDGE_ONLY ? HS_BOUNDARY_EDGE_ONLY
                                                                        : HS_BOUNDARY_KEPT,
                                .min_edge = (uint16_t)w[8],
                                .width = (uint16_t)w[9],
                                .height = (uint16_t)(w[9] >> 16)};
    float *place = malloc(4 * (size_t)vertices * sizeof *place);
    uint32_t *sides = malloc(faces * sizeof *sides), *corner = malloc(corners * sizeof *corner);
    bool done = place && sides && corner;
    if (!done) hs_fail(err, HS_EXIT_INTERNAL, "no memory for the mesh of %.300s", name);
    if (done) {
        memcpy(place, position, 4 * (size_t)vertices * sizeof *place);
        for (uint32_t f = 0, h = 0; f < faces; f++) {
            sides[f] = halfedge[4 * (size_t)h + 2] & 0xff;
            for (uint32_t end = h + sides[f]; h < end; h++)
                corner[h] = halfedge[4 * (size_t)h];
        }
        const hs_soup soup = {.name = name,
                              .vertices = vertices,
                              .position = place,
                              .faces = faces,
                              .sides = sides,
                              .corner = corner};
        done = hs_mesh_build(&s->mesh, &soup, NULL, err);
    }
    for (uint32_t f = 0; done && f < faces; f++)
        if ((s->mesh.forced[f] = (uint8_t)(halfedge[4 * (size_t)s->mesh.first[f] + 2] >> 8)))
            s->forced = true;
    for (uint32_t h = 0; done && h < corners; h++) {
        const uint32_t word = halfedge[4 * (size_t)h + 3];
        uint8_t *of_vertex = &s->mesh.vertex_sharpness[s->mesh.origin[h]];
        s->mesh.sharpness[h] = word & 0xf;
        if (word >> 4 > *of_vertex) *of_vertex = (uint8_t)(word >> 4);
    }
    free(place);
    free(sides);
    free(corner);
    s->has_mesh = s->has_matrix = done;
    return done;
}

/* A packet in: golden's answer says whether it can be unpacked, and is what is drawn. */
static bool open_packet_in(scene *s, const hs_packet *in, const request *r, hs_error *err) {
    if (r->depths_given || r->views_given || r->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE,
                       "%.300s brings view and depths along; drop --views, --orbit, --front, "
                       "--silhouette, --guard, --uniform and --force",
                       r->source);
    hs_packet out = {0};
    hs_golden_report report;
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    bool done = golden ? hs_golden_run(golden, in, &out, &report, err)
                       : hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    if (done && report.status > HS_STATUS_STOPPED)
        done = hs_fail(err, HS_EXIT_REFUSED, "%.300s: view %u is refused, %s at word %u: %s; %s",
                       r->source, in->view, hs_status_name(report.status), report.error_position,
                       hs_status_what(report.status), hs_status_remedy(report.status));
    done = done && hs_output_decode(&s->output, &out, err);
    s->has_output = done;
    hs_golden_free(golden);
    hs_packet_free(&out);
    return done && unpack(s, in, r->source, err);
}

static bool open_packet_out(scene *s, const hs_packet *out, const request *r, hs_error *err) {
    if (r->depths_given || r->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE,
                       "%.300s holds output, refined already; drop --orbit, --front, "
                       "--silhouette, --guard, --uniform and --force",
                       r->source);
    if (!hs_output_decode(&s->output, out, err)) return false;
    s->has_output = true;
    if (s->output.faces == 0)
        return hs_fail(err, HS_EXIT_REFUSED, "%.300s: view %u has no faces: it was refused, %s",
                       r->source, out->view, hs_status_name(s->output.status));
    if (!r->views) return true;
    s->has_matrix = choose_view(s, r, out->view, NULL, err);
    return s->has_matrix;
}

static bool open_stream(scene *s, const request *r, hs_error *err) {
    hs_packet packet = {0};
    const bool done = find_packet(&packet, r, err) &&
                      (packet.word[0] == HS_MAGIC_VIEW ? open_packet_in(s, &packet, r, err)
                                                       : open_packet_out(s, &packet, r, err));
    hs_packet_free(&packet);
    return done;
}

/* --- The figure ------------------------------------------------------------------------------- */

static bool draw(hs_picture *picture, hs_figure_counts *counts, const scene *s, const request *r,
                 hs_error *err) {
    bool stopped = s->has_output && s->output.status == HS_STATUS_STOPPED;
    const hs_figure_source source = {.mesh = s->has_mesh ? &s->mesh : NULL,
                                     .output = s->has_output ? &s->output : NULL,
                                     .matrix = s->has_matrix ? s->matrix : NULL,
                                     .settings = s->settings,
                                     .limits = HS_DEFAULT_LIMITS,
                                     .forced = s->forced,
                                     .stopped = &stopped,
                                     .turn = r->turn,
                                     .levels = r->levels,
                                     .columns = r->columns,
                                     .title = r->title,
                                     .aside = s->views ? s->aside : NULL,
                                     .view = s->view,
                                     .views = s->views,
                                     .counts = counts};
    hs_renderer *renderer = r->file ? hs_renderer_new(r->width, r->height, r->samples, err) : NULL;
    const bool done =
        (renderer || !r->file) && hs_figure_draw(picture, r->what, renderer, &source, err);
    hs_renderer_free(renderer);
    if (done && stopped && !r->quiet)
        fprintf(stderr, "note: %s: %s; %s\n", r->source, hs_status_what(HS_STATUS_STOPPED),
                hs_status_remedy(HS_STATUS_STOPPED));
    return done;
}

static bool render(const request *r, hs_error *err) {
    const size_t length = strlen(r->source);
    const bool is_stream = length > 4 && strcmp(r->source + length - 4, ".hss") == 0;
    scene s = {0};
    hs_picture picture = {0};
    hs_figure_counts counts;
    const bool done = (is_stream ? open_stream(&s, r, err) : open_mesh(&s, r, err)) &&
                      draw(&picture, &counts, &s, r, err) &&
                      (!r->file || hs_png_write(&picture, r->file, err)) &&
                      (!r->json || hs_figure_counts_write(&counts, r->what, r->json, err));
    const bool to_stdout = r->json && strcmp(r->json, "-") == 0;
    if (done && r->file && !r->quiet)
        fprintf(to_stdout ? stderr : stdout, "%s: %ux%u pixels\n", r->file, picture.width,
                picture.height);
    hs_picture_free(&picture);
    free_scene(&s);
    return done;
}

int hs_command_render(int argc, char **argv, hs_error *err) {
    request r;
    const enum hs_parsed parsed = parse(&r, argc, argv, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    return render(&r, err) ? HS_EXIT_OK : err->code;
}
