/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep explain: why a face was refined in a view, or was not.
 */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "explain.h"
#include "mesh_source.h"
#include "options.h"
#include "pick.h"
#include "surface_options.h"
#include "view.h"

static const char EXAMPLES[] =
    "MESH is an OBJ file or shape:NAME[:SIZE[:SEED]] (`halfstep mesh list`). What\n"
    "golden decided is told generation by generation, for the face and for those that\n"
    "it comes from. Faces are called GENERATION:NUMBER; all numbers count from 0.\n"
    "\n"
    "Examples:\n"
    "  halfstep explain shape:hand --face 77\n"
    "      the initial mesh's face 77, and what became of it\n"
    "  halfstep explain shape:hand --output-face 1200\n"
    "      face 1200 of the output, as in mesh.obj and `trace show`\n"
    "  halfstep explain shape:hand --orbit 8 --view 3 --pixel 380,240\n"
    "      what the picture of view 3 shows there, from the upper left corner\n"
    "  halfstep explain shape:hand --face 4:512 --json -\n"
    "      the active face 512 of generation 4, as JSON\n";

/* What was asked for. Text belongs to the command line. */
typedef struct request {
    const char *source, *views, *force, *json;
    uint32_t orbit, view, width, height;
    uint32_t generation, face, output, x, y; /* by what was given */
    bool face_given, output_given, pixel_given;
    bool quiet, round_sharpness;
    hs_settings settings;
    hs_limits limits;
} request;

/* --- The command line ------------------------------------------------------------------------- */

/* Options whose values are looked at behind the table. */
typedef struct texts {
    const char *face, *pixel, *size;
    bool views_given, orbit_given;
    hs_surface_options surface;
} texts;

static bool complete(request *r, const texts *t, hs_error *err) {
    r->face_given = t->face != NULL;
    r->pixel_given = t->pixel != NULL;
    if (r->face_given + r->pixel_given + r->output_given != 1)
        return hs_fail(err, HS_EXIT_USAGE,
                       "halfstep explain: which face? give one of --face N, --output-face N and "
                       "--pixel X,Y");
    if (t->face && !hs_number_parse(t->face, &r->face) &&
        !hs_pair_parse(t->face, ':', &r->generation, &r->face))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--face is \"%.40s\"; it should be a number, or GENERATION:NUMBER, as in "
                       "77 or 4:512",
                       t->face);
    if (t->pixel && !hs_pair_parse(t->pixel, ',', &r->x, &r->y))
        return hs_fail(err, HS_EXIT_USAGE, "--pixel is \"%.40s\"; it should be X,Y, as in 380,240",
                       t->pixel);
    if (!hs_size_parse(t->size, &r->width, &r->height, err)) return false;
    if (t->pixel && (r->x >= r->width || r->y >= r->height))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--pixel %u,%u is beyond the picture; pixels are 0,0 to %u,%u", r->x, r->y,
                       r->width - 1, r->height - 1);
    if (t->views_given && t->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE, "--views and --orbit exclude each other; give one");
    return hs_surface_settings(&r->settings, &t->surface, r->force != NULL, r->width, r->height,
                               err);
}

static enum hs_parsed parse(request *r, int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "explain", "MESH", 1, 1, "Says why a face was refined in a view, or was not", EXAMPLES};
    const uint32_t most = 1u << HS_INDEX_BITS;
    *r = (request){.orbit = 1, .limits = HS_DEFAULT_LIMITS};
    texts t = {.size = "768x768", .surface = HS_SURFACE_DEFAULTS};
    const hs_option option[] = {
        {"face", 0, HS_OPTION_TEXT, "N", &t.face, 0, 0, NULL,
         "face N of the initial mesh, or GENERATION:N of an\nactive mesh"},
        {"output-face", 0, HS_OPTION_NUMBER, "N", &r->output, 0, UINT32_MAX, &r->output_given,
         "face N of the output"},
        {"pixel", 'p', HS_OPTION_TEXT, "X,Y", &t.pixel, 0, 0, NULL,
         "what is seen in the middle of a pixel"},
        {"json", 'j', HS_OPTION_TEXT, "FILE", &r->json, 0, 0, NULL,
         "all of it as JSON; - is standard output"},
        {"orbit", 'n', HS_OPTION_NUMBER, "N", &r->orbit, 1, 65536, &t.orbit_given,
         "N viewpoints on a circle around the mesh (1)"},
        {"views", 'v', HS_OPTION_TEXT, "FILE", &r->views, 0, 0, &t.views_given,
         "viewpoints from a file: `matrix` or `look` lines"},
        {"view", 0, HS_OPTION_NUMBER, "N", &r->view, 0, 65535, NULL, "which of them (0)"},
        HS_REFINED_OPTIONS(t.surface, r->round_sharpness, r->force),
        {"max-vertices", 0, HS_OPTION_NUMBER, "N", &r->limits.vertices, 1, most, NULL,
         "run-time limit of vertices (524288)"},
        {"max-quads", 0, HS_OPTION_NUMBER, "N", &r->limits.quads, 1, most, NULL,
         "run-time limit of active quads (524288)"},
        {"size", 0, HS_OPTION_TEXT, "WxH", &t.size, 0, 0, NULL,
         "pixels of the view's picture (768x768)"},
        {"quiet", 'q', HS_OPTION_FLAG, NULL, &r->quiet, 0, 0, NULL, "no notes"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed != HS_PARSED) return parsed;
    r->source = argv[operand];
    return complete(r, &t, err) ? HS_PARSED : HS_PARSED_WRONG;
}

/* --- The subject ------------------------------------------------------------------------------ */

static void choose_output(hs_subject *subject, const hs_history *history, uint32_t output) {
    const hs_origin *origin = &history->origin[output];
    subject->generation = origin->generation;
    subject->face = origin->face;
    subject->halfedge = origin->halfedge;
    subject->output = output;
}

static bool choose_pixel(hs_subject *subject, const request *r, const hs_history *history,
                         const hs_output *output, const hs_view *view, hs_error *err) {
    hs_surface surface;
    if (!hs_surface_of_output(&surface, output, view->matrix, err)) return false;
    const uint32_t face = hs_pick(&surface, r->x, r->y, r->width, r->height);
    hs_surface_free(&surface);
    if (face == HS_PICK_NONE)
        return hs_fail(err, HS_EXIT_USAGE,
                       "pixel %u,%u shows no face; choose one on the surface, in a picture of "
                       "%ux%u",
                       r->x, r->y, r->width, r->height);
    choose_output(subject, history, face);
    return true;
}

static bool choose(hs_subject *subject, const request *r, const hs_history *history,
                   const hs_output *output, const hs_view *view, hs_error *err) {
    *subject = (hs_subject){.halfedge = HS_HISTORY_NONE, .output = HS_HISTORY_NONE};
    if (r->pixel_given) {
        snprintf(subject->asked, sizeof subject->asked, "pixel %u,%u", r->x, r->y);
        return choose_pixel(subject, r, history, output, view, err);
    }
    if (r->output_given) {
        if (r->output >= output->faces)
            return hs_fail(err, HS_EXIT_USAGE,
                           "--output-face %u: the output has faces 0 to %u in this view", r->output,
                           output->faces - 1);
        snprintf(subject->asked, sizeof subject->asked, "output face %u", r->output);
        choose_output(subject, history, r->output);
        return true;
    }
    if (r->generation >= history->generations)
        return hs_fail(err, HS_EXIT_USAGE, "--face %u:%u: this view has generations 0 to %u",
                       r->generation, r->face, history->generations - 1);
    const uint32_t faces = history->past[r->generation].faces;
    if (r->face >= faces)
        return hs_fail(err, HS_EXIT_USAGE,
                       "--face %u:%u: generation %u has %u active faces, from 0", r->generation,
                       r->face, r->generation, faces);
    snprintf(subject->asked, sizeof subject->asked, r->generation ? "active face" : "initial face");
    subject->generation = r->generation;
    subject->face = r->face;
    subject->output = history->past[r->generation].output[r->face];
    return true;
}

/* --- The work ----------------------------------------------------------------------------------
 */

static bool explain(const request *r, const hs_mesh *mesh, hs_error *err) {
    hs_view view;
    hs_history history;
    hs_output output;
    hs_subject subject;
    if (!hs_view_choose(&view, r->view, r->views, r->orbit, mesh, (double)r->width / r->height,
                        err) ||
        !hs_history_record(&history, &output, mesh, view.matrix, &r->settings, r->limits, err))
        return false;
    bool good = choose(&subject, r, &history, &output, &view, err);
    if (good && r->json)
        good = hs_explain_write(r->json, &history, &subject, r->source, r->view, err);
    if (good && !(r->json && strcmp(r->json, "-") == 0))
        good = hs_explain_print(stdout, &history, &subject, r->source, r->view, err);
    hs_history_free(&history);
    hs_output_free(&output);
    return good;
}

int hs_command_explain(int argc, char **argv, hs_error *err) {
    request r;
    const enum hs_parsed parsed = parse(&r, argc, argv, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    hs_mesh mesh;
    if (!hs_mesh_open(&mesh, r.source, r.round_sharpness, r.quiet, err)) return err->code;
    const bool good = (!r.force || hs_mesh_force(&mesh, r.force, err)) && explain(&r, &mesh, err);
    hs_mesh_free(&mesh);
    return good ? HS_EXIT_OK : err->code;
}
