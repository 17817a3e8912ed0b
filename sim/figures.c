/* SPDX-License-Identifier: Apache-2.0
 *
 * A figure is made in three steps: refine the mesh (unless the output is given), draw one picture
 * or several, and put several on a sheet.
 */
#include "figures.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "figure_parts.h"
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

bool hs_figure_refine(hs_output *output, const hs_mesh *mesh, const hs_settings *settings,
                      const hs_figure_source *source, hs_error *err) {
    if (!hs_refine(output, mesh, source->matrix, settings, source->limits, err)) return false;
    if (output->status == HS_STATUS_STOPPED && source->stopped) *source->stopped = true;
    return true;
}

/* --- Panels ----------------------------------------------------------------------------------- */

bool hs_figure_show(hs_picture *picture, const char *caption, hs_renderer *renderer,
                    const hs_surface *surface, const hs_style *style,
                    const hs_figure_source *source, hs_error *err) {
    hs_figure_count(source->counts, caption, surface);
    return !renderer || hs_renderer_draw(renderer, surface, style, picture, err);
}

static bool show_view(hs_picture *picture, enum hs_view_picture which, const char *caption,
                      hs_renderer *renderer, const hs_surface *surface,
                      const hs_figure_source *source, hs_error *err) {
    hs_figure_count(source->counts, caption, surface);
    return !renderer || hs_view_picture_draw(picture, which, renderer, surface, NULL, err);
}

static bool make_sheet(hs_picture *sheet, const hs_picture *picture, const char *const *caption,
                       uint32_t panels, uint32_t columns, const hs_figure_source *source,
                       hs_error *err) {
    hs_panel panel[HS_FIGURE_PANELS];
    for (uint32_t i = 0; i < panels; i++)
        panel[i] = (hs_panel){&picture[i], caption[i]};
    return hs_picture_sheet(sheet, panel, panels, source->columns ? source->columns : columns,
                            source->title, err);
}

bool hs_figure_sheet(hs_picture *sheet, const hs_picture *picture, uint32_t panels,
                     const hs_figure_source *source, hs_error *err) {
    char text[HS_FIGURE_PANELS][HS_FIGURE_CAPTION];
    const char *caption[HS_FIGURE_PANELS];
    const hs_figure_counts *counts = source->counts;
    for (uint32_t i = 0; i < panels; i++) {
        hs_figure_caption(text[i], &counts->panel[counts->panels - panels + i]);
        caption[i] = text[i];
    }
    return make_sheet(sheet, picture, caption, panels, panels, source, err);
}

static void free_pictures(hs_picture *picture, uint32_t count) {
    for (uint32_t i = 0; i < count; i++)
        hs_picture_free(&picture[i]);
}

/* --- Single pictures of a view ---------------------------------------------------------------- */

/* Without a renderer there is no aspect to turn for, and counts are the same from everywhere. */
static bool draw_view(hs_picture *picture, enum hs_view_picture which, const char *caption,
                      hs_renderer *renderer, const hs_figure_source *source,
                      const hs_output *output, hs_error *err) {
    hs_surface surface = {0}, side = {0};
    bool done = hs_view_picture_shows_output(which)
                    ? hs_surface_of_output(&surface, output, source->matrix, err)
                    : hs_surface_of_mesh(&surface, source->mesh, source->matrix, err);
    const hs_surface *seen = &surface;
    if (done && renderer && hs_view_picture_is_side(which)) {
        done = hs_surface_turn(&side, &surface, source->turn, hs_renderer_aspect(renderer), err);
        seen = &side;
    }
    done = done && show_view(picture, which, caption, renderer, seen, source, err);
    hs_surface_free(&surface);
    hs_surface_free(&side);
    return done;
}

/* --- Sheets ----------------------------------------------------------------------------------- */

/* Pictures of the view. */
static bool draw_views(hs_picture *picture, const enum hs_view_picture *which,
                       const char *const *caption, uint32_t panels, hs_renderer *renderer,
                       const hs_figure_source *source, const hs_output *output, hs_error *err) {
    bool done = true;
    for (uint32_t i = 0; i < panels && done; i++)
        done = draw_view(&picture[i], which[i], caption[i], renderer, source, output, err);
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
    hs_picture picture[HS_VIEW_COUNT] = {{0}};
    bool done = draw_views(picture, which, caption, HS_VIEW_COUNT, renderer, source, output, err);
    if (done && renderer)
        done = make_sheet(sheet, picture, caption, HS_VIEW_COUNT, HS_VIEW_COUNT / 2, source, err);
    free_pictures(picture, HS_VIEW_COUNT);
    return done;
}

static bool draw_triptych(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                          const hs_output *output, hs_error *err) {
    static const enum hs_view_picture which[] = {HS_VIEW_INITIAL_WIRES, HS_VIEW_REFINED_WIRES,
                                                 HS_VIEW_SIDE_WIRES};
    static const char *const caption[] = {"initial mesh", "refined for this viewpoint",
                                          "the same, seen from the side"};
    hs_picture picture[3] = {{0}};
    bool done = draw_views(picture, which, caption, 3, renderer, source, output, err);
    if (done && renderer) done = hs_figure_sheet(sheet, picture, 3, source, err);
    free_pictures(picture, 3);
    return done;
}

/* --- Uniform refinement ----------------------------------------------------------------------- */

static const hs_style plain_style = {.paint = HS_PAINT_CLAY, .wires = true};

static bool draw_steps(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                       hs_error *err) {
    enum { STEPS = 5 };
    static const char *const caption[STEPS] = {"initial mesh", "1 step", "2 steps = 1 level",
                                               "3 steps", "4 steps = 2 levels"};
    hs_picture picture[STEPS] = {{0}};
    bool done = true;
    for (uint32_t i = 0; i < STEPS && done; i++) {
        const hs_settings uniform = {
            .uniform = true, .uniform_depth = (uint8_t)i, .boundary = source->settings.boundary};
        hs_output output = {0};
        hs_surface surface = {0};
        done =
            hs_figure_refine(&output, source->mesh, &uniform, source, err) &&
            hs_surface_of_output(&surface, &output, source->matrix, err) &&
            hs_figure_show(&picture[i], caption[i], renderer, &surface, &plain_style, source, err);
        hs_surface_free(&surface);
        hs_output_free(&output);
    }
    if (done && renderer) done = hs_figure_sheet(sheet, picture, STEPS, source, err);
    free_pictures(picture, STEPS);
    return done;
}

/* By face, edge and vertex points at once, in doubles: no half-speed step is taken. */
static bool draw_levels(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                        hs_error *err) {
    enum { LEVELS = 3 };
    static const char *const caption[LEVELS] = {"initial mesh", "1 Catmull-Clark level",
                                                "2 levels"};
    hs_picture picture[LEVELS] = {{0}};
    bool done = true;
    for (uint32_t i = 0; i < LEVELS && done; i++) {
        hs_reference_surface reference = {0};
        hs_surface surface = {0};
        done =
            hs_reference_surface_make(&reference, source->mesh, &source->settings, i, err) &&
            hs_surface_of_faces(&surface, &reference.faces, source->matrix, err) &&
            hs_figure_show(&picture[i], caption[i], renderer, &surface, &plain_style, source, err);
        hs_surface_free(&surface);
        hs_reference_surface_free(&reference);
    }
    if (done && renderer) done = hs_figure_sheet(sheet, picture, LEVELS, source, err);
    free_pictures(picture, LEVELS);
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
    done = done && hs_figure_refine(&output, &mesh, &nothing, source, err) &&
           hs_surface_of_output(&surface, &output, source->matrix, err) &&
           show_view(picture, HS_VIEW_REFINED_WIRES, "ramp", renderer, &surface, source, err);
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
    const bool done =
        hs_surface_of_faces(&surface, &reference.faces, source->matrix, err) &&
        show_view(picture, HS_VIEW_REFINED, "reference", renderer, &surface, source, err);
    hs_surface_free(&surface);
    hs_reference_surface_free(&reference);
    return done;
}

static bool draw_difference(hs_picture *picture, hs_renderer *renderer,
                            const hs_figure_source *source, const hs_output *output,
                            hs_error *err) {
    hs_picture refined = {0}, reference = {0};
    const bool done =
        draw_view(&refined, HS_VIEW_REFINED, "refined", renderer, source, output, err) &&
        draw_reference(&reference, renderer, source, err) &&
        (!renderer || hs_picture_subtract(picture, &refined, &reference, HS_DIFFERENCE_GAIN, err));
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
    if (!source->output && !hs_figure_refine(&made, source->mesh, &source->settings, source, err))
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
        done = draw_view(picture, (enum hs_view_picture)which, name, renderer, source, output, err);
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
                    const hs_figure_source *given, hs_error *err) {
    hs_figure_counts own = {0}, *counts = given->counts ? given->counts : &own;
    hs_figure_source with_counts = *given;
    with_counts.counts = counts;
    const hs_figure_source *source = &with_counts;
    counts->panels = 0;
    counts->cycles = 0;
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
    if (is(name, "turntable") && !source->aside)
        return hs_fail(err, HS_EXIT_USAGE,
                       "the figure \"turntable\" needs a second camera; give a mesh and an orbit");
    if (is(name, "splits")) return hs_figure_splits(picture, renderer, source, err);
    if (is(name, "turntable")) return hs_figure_turntable(picture, renderer, source, err);
    if (is(name, "levels")) return draw_levels(picture, renderer, source, err);
    if (is(name, "steps")) return draw_steps(picture, renderer, source, err);
    if (is(name, "ramp")) return draw_ramp(picture, renderer, source, err);
    if (is(name, "reference")) return draw_reference(picture, renderer, source, err);
    return draw_of_output(picture, name, renderer, source, err);
}
