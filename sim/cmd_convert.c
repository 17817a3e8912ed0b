/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep convert: what a view makes of a mesh, as a file for other programs.
 *
 *   mesh, view, depths -> golden -> scene in a space -> PLY, glTF, POV-Ray or OBJ
 */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "convert_write.h"
#include "drop.h"
#include "mesh_source.h"
#include "options.h"
#include "refine.h"
#include "surface_options.h"
#include "view.h"

static const char EXAMPLES[] =
    "MESH is an OBJ file or shape:NAME[:SIZE[:SEED]] (`halfstep mesh list`); golden refines it "
    "for\n"
    "one view. Colours tell the depth of refinement.\n"
    "\n"
    "Examples:\n"
    "  halfstep convert shape:hand --to gltf -o hand.glb\n"
    "      for Blender, browsers, engines; -o hand.gltf writes hand.bin beside it\n"
    "  halfstep convert bob.obj --orbit 8 --view 3 --to ply -o bob.ply\n"
    "      polygons as they are, for MeshLab and the like\n"
    "  halfstep convert shape:monster -o my.pov && povray +W768 +H768 my.pov\n"
    "      camera and light as the view; Declare=DEPTH=1 colours by depth\n"
    "  halfstep convert shape:hand --to gltf --space ndc -o seen.glb\n"
    "      as the view deforms it: the cube from -1 to 1 is what is seen\n";

typedef enum format { PLY, GLTF, POV, OBJ, FORMATS } format;
static const char *const FORMAT_NAME[FORMATS + 1] = {"ply", "gltf", "pov", "obj", NULL};

/* What was asked for. Text belongs to the command line. */
typedef struct request {
    const char *source, *views, *force, *file;
    uint32_t orbit, view, width, height;
    format format;
    hs_space space;
    hs_drop drop;
    bool text, quiet, round_sharpness;
    hs_settings settings;
} request;

/* --- The command line ------------------------------------------------------------------------- */

/* Options whose values are looked at behind the table. */
typedef struct texts {
    const char *to, *space, *size, *drop;
    bool views_given, orbit_given;
    hs_surface_options surface;
} texts;

static bool has_ending(const char *path, const char *ending) {
    const size_t length = strlen(path), end = strlen(ending);
    return length > end && strcmp(path + length - end, ending) == 0;
}

static bool no_format(const char *word, hs_error *err) {
    const char *nearest = hs_nearest(word, FORMAT_NAME);
    return hs_fail(
        err, HS_EXIT_USAGE, "--to is \"%.40s\"; it should be ply, gltf, pov or obj%s%s%s", word,
        nearest ? "; did you mean \"" : "", nearest ? nearest : "", nearest ? "\"?" : "");
}

/* The format by its name, or by the file's ending. */
static bool choose_format(request *r, const char *to, hs_error *err) {
    static const char *const ending[] = {".ply", ".glb", ".pov", ".obj", ".gltf"};
    static const format by_ending[] = {PLY, GLTF, POV, OBJ, GLTF};
    for (int i = 0; !to && i < 5; i++)
        if (has_ending(r->file, ending[i])) {
            r->format = by_ending[i];
            return true;
        }
    if (!to)
        return hs_fail(
            err, HS_EXIT_USAGE,
            "%.300s has no ending that says what it should be; add --to ply, gltf, pov or "
            "obj",
            r->file);
    for (int f = 0; f < FORMATS; f++)
        if (strcmp(to, FORMAT_NAME[f]) == 0) {
            r->format = (format)f;
            return true;
        }
    return no_format(to, err);
}

static bool complete(request *r, const texts *t, hs_error *err) {
    if (!r->file) return hs_fail(err, HS_EXIT_USAGE, "halfstep convert: where to? add -o FILE");
    if (!choose_format(r, t->to, err) || !hs_drop_parse(t->drop, &r->drop, err)) return false;
    if (!hs_space_parse(t->space, &r->space))
        return hs_fail(err, HS_EXIT_USAGE, "--space is \"%.40s\"; it should be object, ndc or clip",
                       t->space);
    if (r->format == POV && r->space == HS_SPACE_CLIP)
        return hs_fail(err, HS_EXIT_USAGE,
                       "POV-Ray knows no w, so clip space means nothing to it; use --space object "
                       "or ndc");
    if (r->text && r->format != PLY)
        return hs_fail(err, HS_EXIT_USAGE, "--text is for PLY alone; drop it, or use --to ply");
    if (!hs_size_parse(t->size, &r->width, &r->height, err)) return false;
    if (t->views_given && t->orbit_given)
        return hs_fail(err, HS_EXIT_USAGE, "--views and --orbit exclude each other; give one");
    return hs_surface_settings(&r->settings, &t->surface, r->force != NULL, r->width, r->height,
                               err);
}

static enum hs_parsed parse(request *r, int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "convert", "MESH", 1, 1, "Refines a mesh for a view and writes it for other programs",
        EXAMPLES};
    *r = (request){.orbit = 1};
    texts t = {.space = "object", .size = "768x768", .surface = HS_SURFACE_DEFAULTS};
    const hs_option option[] = {
        {"out", 'o', HS_OPTION_TEXT, "FILE", &r->file, 0, 0, NULL,
         "the file to write; - is standard output"},
        {"to", 't', HS_OPTION_TEXT, "FORMAT", &t.to, 0, 0, NULL,
         "ply, gltf (GLB, or .gltf and .bin), pov or obj\n(what FILE ends in)"},
        {"space", 0, HS_OPTION_TEXT, "SPACE", &t.space, 0, 0, NULL,
         "object, ndc (over w) or clip (w beside) (object)"},
        {"text", 0, HS_OPTION_FLAG, NULL, &r->text, 0, 0, NULL, "PLY as text, not binary"},
        {"orbit", 'n', HS_OPTION_NUMBER, "N", &r->orbit, 1, 65536, &t.orbit_given,
         "N viewpoints on a circle around the mesh (1)"},
        {"views", 'v', HS_OPTION_TEXT, "FILE", &r->views, 0, 0, &t.views_given,
         "viewpoints from a file: `matrix` or `look` lines"},
        {"view", 0, HS_OPTION_NUMBER, "N", &r->view, 0, 65535, NULL, "which of them (0)"},
        HS_REFINED_OPTIONS(t.surface, r->round_sharpness, r->force),
        HS_DROP_OPTION(t.drop, "the file"),
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

/* --- The work ----------------------------------------------------------------------------------
 */

/* What golden makes of the mesh in the view. */
static bool refine(hs_output *output, hs_view *view, const request *r, hs_error *err) {
    hs_mesh mesh;
    if (!hs_mesh_open(&mesh, r->source, r->round_sharpness, r->quiet, err)) return false;
    const bool done = (!r->force || hs_mesh_force(&mesh, r->force, err)) &&
                      hs_view_choose(view, r->view, r->views, r->orbit, &mesh,
                                     (double)r->width / r->height, err) &&
                      hs_refine(output, &mesh, view->matrix, &r->settings, HS_DEFAULT_LIMITS, err);
    hs_mesh_free(&mesh);
    return done;
}

static bool write_scene(const request *r, const hs_scene *scene, hs_error *err) {
    switch (r->format) {
    case PLY:
        return hs_write_ply(r->file, scene, r->text, err);
    case GLTF:
        return hs_write_gltf(r->file, scene, err);
    case POV:
        return hs_write_pov(r->file, scene, r->width, r->height, err);
    default:
        return hs_write_obj(r->file, scene, err);
    }
}

/* Without the faces that are to be dropped; there must be others. */
static bool drop(hs_output *output, hs_dropped *dropped, const request *r, hs_error *err) {
    if (!hs_output_drop(output, &r->drop, dropped, err)) return false;
    return output->faces || dropped->faces == 0 ||
           hs_fail(err, HS_EXIT_VIEWS,
                   "--drop leaves no face: %u are off screen, %u back-facing; drop less, or choose "
                   "another view",
                   dropped->offscreen, dropped->back);
}

static void tell(const request *r, const hs_output *output, const hs_dropped *dropped,
                 const hs_scene *scene) {
    if (r->quiet) return;
    if (r->drop.offscreen || r->drop.back)
        fprintf(stderr, "note: dropped of %u faces: %u off screen, %u back-facing; %u vertices\n",
                dropped->faces, dropped->offscreen, dropped->back, dropped->vertices);
    if (output->status == HS_STATUS_STOPPED)
        fprintf(stderr, "note: %s: %s; %s\n", r->source, hs_status_what(HS_STATUS_STOPPED),
                hs_status_remedy(HS_STATUS_STOPPED));
    if (scene->left_out)
        fprintf(stderr,
                "note: %u of %u faces are at or behind the eye, where device coordinates end; they "
                "were left out\n",
                scene->left_out, output->faces);
    if (strcmp(r->file, "-") == 0 || strcmp(r->file, "/dev/stdout") == 0) return;
    printf("%s: %u vertices, ", r->file, scene->points);
    if (scene->triangles) printf("%u triangles of ", scene->triangles);
    printf("%u faces, %s space\n", scene->faces, hs_space_name(scene->space));
}

static bool convert(const request *r, hs_error *err) {
    hs_output output = {0};
    hs_dropped dropped;
    hs_view view;
    hs_scene scene = {0};
    const hs_scene_options options = {.space = r->space,
                                      .cut = r->format == GLTF || r->format == POV,
                                      .depths_apart = r->format == GLTF};
    const bool done = refine(&output, &view, r, err) && drop(&output, &dropped, r, err) &&
                      hs_scene_make(&scene, &output, view.matrix, &options, err) &&
                      write_scene(r, &scene, err);
    if (done) tell(r, &output, &dropped, &scene);
    hs_scene_free(&scene);
    hs_output_free(&output);
    return done;
}

int hs_command_convert(int argc, char **argv, hs_error *err) {
    request r;
    const enum hs_parsed parsed = parse(&r, argc, argv, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    return convert(&r, err) ? HS_EXIT_OK : err->code;
}
