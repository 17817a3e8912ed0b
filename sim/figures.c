/* SPDX-License-Identifier: Apache-2.0
 *
 * A figure is made in three steps: refine the mesh (unless the output is given), draw one picture
 * or several, and put several on a sheet.
 */
#include "figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "refine.h"
#include "run_pictures.h"

static const struct {
    const char *name, *what;
} figures[] = {
#define PICTURE(name, file, caption) {file, caption},
    HS_VIEW_PICTURES(PICTURE)
#undef PICTURE
#define FIGURE(name, what) {#name, what},
        HS_FIGURES(FIGURE)
#undef FIGURE
};
enum { FIGURES = sizeof figures / sizeof *figures };

const char *hs_figure_name(uint32_t index) {
    return index < FIGURES ? figures[index].name : NULL;
}

const char *hs_figure_what(const char *name) {
    for (uint32_t i = 0; i < FIGURES; i++)
        if (strcmp(name, figures[i].name) == 0) return figures[i].what;
    return NULL;
}

bool hs_figure_exists(const char *name) {
    return hs_figure_what(name) != NULL;
}

/* --- Refinement ------------------------------------------------------------------------------- */

/* What golden makes of a mesh (the source's, but for forced depths) under the source's view. */
static bool refine(hs_output *output, const hs_mesh *mesh, const hs_settings *settings,
                   const hs_figure_source *source, hs_error *err) {
    if (!hs_refine(output, mesh, source->matrix, settings, source->limits, err)) return false;
    if (output->status == HS_STATUS_STOPPED && source->stopped) *source->stopped = true;
    return true;
}

/* --- Single pictures of a view ---------------------------------------------------------------- */

static bool draw_side(hs_picture *picture, enum hs_view_picture which, hs_renderer *renderer,
                      const hs_surface *surface, double turn, hs_error *err) {
    hs_surface side;
    if (!hs_surface_turn(&side, surface, turn, hs_renderer_aspect(renderer), err)) return false;
    const bool done = hs_view_picture_draw(picture, which, renderer, &side, NULL, err);
    hs_surface_free(&side);
    return done;
}

static bool draw_view(hs_picture *picture, enum hs_view_picture which, hs_renderer *renderer,
                      const hs_figure_source *source, const hs_output *output, hs_error *err) {
    hs_surface surface = {0};
    bool done = hs_view_picture_shows_output(which)
                    ? hs_surface_of_output(&surface, output, source->matrix, err)
                    : hs_surface_of_mesh(&surface, source->mesh, source->matrix, err);
    if (done && hs_view_picture_is_side(which))
        done = draw_side(picture, which, renderer, &surface, source->turn, err);
    else if (done)
        done = hs_view_picture_draw(picture, which, renderer, &surface, NULL, err);
    hs_surface_free(&surface);
    return done;
}

/* --- Sheets ----------------------------------------------------------------------------------- */

enum { MOST_PANELS = HS_VIEW_COUNT };

static bool make_sheet(hs_picture *sheet, const hs_picture *picture, const char *const *caption,
                       uint32_t panels, uint32_t columns, const hs_figure_source *source,
                       hs_error *err) {
    hs_panel panel[MOST_PANELS];
    for (uint32_t i = 0; i < panels; i++)
        panel[i] = (hs_panel){&picture[i], caption[i]};
    return hs_picture_sheet(sheet, panel, panels, source->columns ? source->columns : columns,
                            source->title, err);
}

static void free_pictures(hs_picture *picture, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        hs_picture_free(&picture[i]);
}

/* A sheet of pictures of the view. */
static bool draw_views(hs_picture *sheet, const enum hs_view_picture *which,
                       const char *const *caption, uint32_t panels, uint32_t columns,
                       hs_renderer *renderer, const hs_figure_source *source,
                       const hs_output *output, hs_error *err) {
    hs_picture picture[MOST_PANELS] = {{0}};
    bool done = true;
    for (uint32_t i = 0; i < panels && done; i++)
        done = draw_view(&picture[i], which[i], renderer, source, output, err);
    done = done && make_sheet(sheet, picture, caption, panels, columns, source, err);
    free_pictures(picture, MOST_PANELS);
    return done;
}

static bool draw_sheet(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                       const hs_output *output, hs_error *err) {
    enum hs_view_picture which[HS_VIEW_COUNT];
    const char *caption[HS_VIEW_COUNT];
    for (int i = 0; i < HS_VIEW_COUNT; i++) {
        which[i] = (enum hs_view_picture)i;
        caption[i] = hs_view_picture_caption(which[i]);
    }
    return draw_views(sheet, which, caption, HS_VIEW_COUNT, HS_VIEW_COUNT / 2, renderer, source,
                      output, err);
}

static bool draw_triptych(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                          const hs_output *output, hs_error *err) {
    static const enum hs_view_picture which[] = {HS_VIEW_INITIAL_WIRES, HS_VIEW_REFINED_WIRES,
                                                 HS_VIEW_SIDE_WIRES};
    static const char *const caption[] = {"initial mesh", "refined for this viewpoint",
                                          "the same, seen from the side"};
    return draw_views(sheet, which, caption, 3, 3, renderer, source, output, err);
}

/* --- Uniform steps ---------------------------------------------------------------------------- */

enum { STEPS = 5 };

static bool draw_steps(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                       hs_error *err) {
    static const char *const caption[STEPS] = {"initial mesh", "1 step", "2 steps = 1 level",
                                               "3 steps", "4 steps = 2 levels"};
    static const hs_style style = {.paint = HS_PAINT_CLAY, .wires = true};
    hs_picture picture[STEPS] = {{0}};
    bool done = true;
    for (uint32_t i = 0; i < STEPS && done; i++) {
        const hs_settings uniform = {
            .uniform = true, .uniform_depth = (uint8_t)i, .boundary = source->settings.boundary};
        hs_output output = {0};
        hs_surface surface = {0};
        done = refine(&output, source->mesh, &uniform, source, err) &&
               hs_surface_of_output(&surface, &output, source->matrix, err) &&
               hs_renderer_draw(renderer, &surface, &style, &picture[i], err);
        hs_surface_free(&surface);
        hs_output_free(&output);
    }
    done = done && make_sheet(sheet, picture, caption, STEPS, STEPS, source, err);
    free_pictures(picture, STEPS);
    return done;
}

/* --- A ramp of depths ------------------------------------------------------------------------- */

/* How high a face lies on the screen: y/w of the mean of its corners; NAN behind the eye. */
static double height_of_face(const hs_surface *surface, uint32_t face) {
    double y = 0, w = 0;
    for (uint32_t i = surface->first[face]; i < surface->first[face + 1]; i++) {
        y += (double)surface->clip[4 * (size_t)surface->corner[i] + 1];
        w += (double)surface->clip[4 * (size_t)surface->corner[i] + 3];
    }
    return w > 0 ? y / w : NAN;
}

/* Depths 0 to deepest in equal bands, from the lowest face to the highest one. */
static void force_ramp(uint8_t *forced, const hs_surface *initial, uint32_t deepest) {
    double low = INFINITY, high = -INFINITY;
    for (uint32_t f = 0; f < initial->faces; f++) {
        const double y = height_of_face(initial, f);
        low = fmin(low, y);
        high = fmax(high, y);
    }
    for (uint32_t f = 0; f < initial->faces; f++) {
        const double part = (height_of_face(initial, f) - low) / (high - low);
        const double band = floor(part * (deepest + 1));
        forced[f] = (uint8_t)(band > 0 ? fmin(band, deepest) : 0);
    }
}

static bool draw_ramp(hs_picture *picture, hs_renderer *renderer, const hs_figure_source *source,
                      hs_error *err) {
    hs_surface surface = {0};
    hs_output output = {0};
    hs_mesh mesh = *source->mesh; /* but for its forced depths */
    uint8_t *forced = calloc(mesh.faces, 1);
    if (!forced) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the depths of the ramp");
    const hs_settings nothing = {.guard = source->settings.guard,
                                 .boundary = source->settings.boundary};
    const uint32_t front = source->settings.front_depth, rim = source->settings.silhouette_depth;
    bool done = hs_surface_of_mesh(&surface, &mesh, source->matrix, err);
    if (done && !source->forced) {
        force_ramp(forced, &surface, front > rim ? front : rim);
        mesh.forced = forced;
    }
    hs_surface_free(&surface);
    done = done && refine(&output, &mesh, &nothing, source, err) &&
           hs_surface_of_output(&surface, &output, source->matrix, err) &&
           hs_view_picture_draw(picture, HS_VIEW_REFINED_WIRES, renderer, &surface, NULL, err);
    hs_surface_free(&surface);
    hs_output_free(&output);
    free(forced);
    return done;
}

/* --- The reference surface -------------------------------------------------------------------- */

static bool draw_reference(hs_picture *picture, hs_renderer *renderer,
                           const hs_figure_source *source, hs_error *err) {
    hs_reference_surface reference;
    if (!hs_reference_surface_make(&reference, source->mesh, &source->settings, source->levels,
                                   err))
        return false;
    hs_surface surface = {0};
    const bool done = hs_surface_of_faces(&surface, &reference.faces, source->matrix, err) &&
                      hs_view_picture_draw(picture, HS_VIEW_REFINED, renderer, &surface, NULL, err);
    hs_surface_free(&surface);
    hs_reference_surface_free(&reference);
    return done;
}

static bool draw_difference(hs_picture *picture, hs_renderer *renderer,
                            const hs_figure_source *source, const hs_output *output,
                            hs_error *err) {
    hs_picture refined = {0}, reference = {0};
    const bool done = draw_view(&refined, HS_VIEW_REFINED, renderer, source, output, err) &&
                      draw_reference(&reference, renderer, source, err) &&
                      hs_picture_subtract(picture, &refined, &reference, HS_DIFFERENCE_GAIN, err);
    hs_picture_free(&refined);
    hs_picture_free(&reference);
    return done;
}

/* --- Any figure ------------------------------------------------------------------------------- */

static bool is(const char *name, const char *other) {
    return strcmp(name, other) == 0;
}

/* Figures that are made of the output, given or golden's. */
static bool draw_of_output(hs_picture *picture, const char *name, hs_renderer *renderer,
                           const hs_figure_source *source, hs_error *err) {
    hs_output made = {0};
    const hs_output *output = source->output ? source->output : &made;
    if (!source->output && !refine(&made, source->mesh, &source->settings, source, err))
        return false;
    bool done;
    if (is(name, "sheet"))
        done = draw_sheet(picture, renderer, source, output, err);
    else if (is(name, "triptych"))
        done = draw_triptych(picture, renderer, source, output, err);
    else if (is(name, "difference"))
        done = draw_difference(picture, renderer, source, output, err);
    else {
        int which = 0;
        while (!is(name, hs_view_picture_file((enum hs_view_picture)which)))
            which++;
        done = draw_view(picture, (enum hs_view_picture)which, renderer, source, output, err);
    }
    hs_output_free(&made);
    return done;
}

/* Whether the output alone is not enough. */
static bool needs_mesh(const char *name) {
    for (int i = 0; i < HS_VIEW_COUNT; i++)
        if (is(name, hs_view_picture_file((enum hs_view_picture)i)))
            return !hs_view_picture_shows_output((enum hs_view_picture)i);
    return true;
}

static bool needs_matrix(const char *name) {
    for (int i = 0; i < HS_VIEW_COUNT; i++)
        if (is(name, hs_view_picture_file((enum hs_view_picture)i)))
            return hs_view_picture_is_side((enum hs_view_picture)i);
    return true;
}

bool hs_figure_draw(hs_picture *picture, const char *name, hs_renderer *renderer,
                    const hs_figure_source *source, hs_error *err) {
    *picture = (hs_picture){0};
    if (!hs_figure_exists(name))
        return hs_fail(err, HS_EXIT_USAGE, "there is no figure \"%.40s\"", name);
    if (needs_mesh(name) && !source->mesh)
        return hs_fail(err, HS_EXIT_USAGE,
                       "the figure \"%s\" needs the mesh, which a stream of output does not hold; "
                       "give the mesh, or ask for refined, refined-wires or closeup",
                       name);
    if (needs_matrix(name) && !source->matrix)
        return hs_fail(err, HS_EXIT_USAGE,
                       "the figure \"%s\" needs the view's matrix, which a stream of output does "
                       "not hold; give the views that it was made for",
                       name);
    if (is(name, "steps")) return draw_steps(picture, renderer, source, err);
    if (is(name, "ramp")) return draw_ramp(picture, renderer, source, err);
    if (is(name, "reference")) return draw_reference(picture, renderer, source, err);
    return draw_of_output(picture, name, renderer, source, err);
}
