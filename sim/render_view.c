/* SPDX-License-Identifier: Apache-2.0
 *
 * The pictures of one view, as the paper shows them: the initial mesh (figures 9 and 10, left), the
 * refined mesh from the viewpoint (middle) and from the side (right), shaded by depth (figure 2),
 * the classification (figure 8), and a close-up of the silhouette (figure 11).
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "png_file.h"
#include "render.h"

#define CLOSEUP_SCALE      9.0
#define CLOSEUP_SIDE_SCALE 5.0

static const hs_style filled_style = {.paint = HS_PAINT_CLAY, .smooth = true};
static const hs_style initial_style = {.paint = HS_PAINT_CLAY};
static const hs_style initial_wires_style = {.paint = HS_PAINT_CLAY, .wires = true};
static const hs_style depth_style = {.paint = HS_PAINT_DEPTH, .wires = true, .legend = true};
static const hs_style facing_style = {.paint = HS_PAINT_FACING, .wires = true, .legend = true};

static const struct {
    const char *file, *caption;
} names[HS_VIEW_COUNT] = {
#define PICTURE(name, file, caption) {file, caption},
    HS_VIEW_PICTURES(PICTURE)
#undef PICTURE
};

/* What is drawn, and how. */
static const struct {
    bool refined;   /* the output; otherwise the initial mesh */
    bool side;      /* not from the viewpoint */
    double closeup; /* enlargement; 0: all of the screen */
    const hs_style *style;
} kinds[HS_VIEW_COUNT] = {
    [HS_VIEW_INITIAL] = {false, false, 0, &initial_style},
    [HS_VIEW_REFINED] = {true, false, 0, &filled_style},
    [HS_VIEW_SIDE] = {true, true, 0, &filled_style},
    [HS_VIEW_FACING] = {false, false, 0, &facing_style},
    [HS_VIEW_CLOSEUP] = {true, false, CLOSEUP_SCALE, &depth_style},
    [HS_VIEW_INITIAL_WIRES] = {false, false, 0, &initial_wires_style},
    [HS_VIEW_REFINED_WIRES] = {true, false, 0, &depth_style},
    [HS_VIEW_SIDE_WIRES] = {true, true, 0, &depth_style},
    [HS_VIEW_FACING_SIDE] = {false, true, 0, &facing_style},
    [HS_VIEW_CLOSEUP_SIDE] = {true, true, CLOSEUP_SIDE_SCALE, &depth_style},
};

const char *hs_view_picture_file(enum hs_view_picture which) {
    return names[which].file;
}

const char *hs_view_picture_caption(enum hs_view_picture which) {
    return names[which].caption;
}

bool hs_view_picture_shows_output(enum hs_view_picture which) {
    return kinds[which].refined;
}

bool hs_view_picture_is_side(enum hs_view_picture which) {
    return kinds[which].side;
}

bool hs_view_picture_draw(hs_picture *picture, enum hs_view_picture which, hs_renderer *renderer,
                          const hs_surface *surface, hs_window *window, hs_error *err) {
    *picture = (hs_picture){0};
    hs_style style = *kinds[which].style;
    if (kinds[which].closeup > 0 &&
        !hs_renderer_finest(renderer, surface, kinds[which].closeup, &style.window, err))
        return false;
    if (window) *window = style.window;
    return hs_renderer_draw(renderer, surface, &style, picture, err);
}

/* --- All of a view ------------------------------------------------------------------------------
 */

/* The surfaces that a view's pictures show: [refined][side]. */
typedef struct hs_view_surfaces {
    hs_surface of[2][2];
} hs_view_surfaces;

static bool make_surfaces(hs_view_surfaces *s, const hs_mesh *mesh, const hs_output *output,
                          const float matrix[16], hs_error *err) {
    return hs_surface_of_mesh(&s->of[0][0], mesh, matrix, err) &&
           hs_surface_of_output(&s->of[1][0], output, matrix, err);
}

/* What cannot be turned is left out; *err then is the reason, and no failure. */
static bool turn_surfaces(hs_view_surfaces *s, double aspect, char *no_side, size_t size,
                          hs_error *err) {
    for (int refined = 1; refined >= 0 && !no_side[0]; refined--) {
        if (hs_surface_turn(&s->of[refined][1], &s->of[refined][0], HS_SIDE_DEGREES, aspect, err))
            continue;
        if (err->code != HS_EXIT_VIEWS) return false;
        snprintf(no_side, size, "%.*s", (int)size - 1, err->text);
        *err = (hs_error){0};
    }
    return true;
}

bool hs_view_pictures_draw(hs_view_pictures *pictures, hs_renderer *renderer, const hs_mesh *mesh,
                           const hs_output *output, const float matrix[16], hs_error *err) {
    *pictures = (hs_view_pictures){0};
    hs_view_surfaces surfaces = {0};
    bool done = make_surfaces(&surfaces, mesh, output, matrix, err) &&
                turn_surfaces(&surfaces, hs_renderer_aspect(renderer), pictures->no_side,
                              sizeof pictures->no_side, err);
    for (int i = 0; i < HS_VIEW_COUNT && done; i++) {
        if (kinds[i].side && pictures->no_side[0]) continue;
        hs_window window;
        done = hs_view_picture_draw(&pictures->picture[i], (enum hs_view_picture)i, renderer,
                                    &surfaces.of[kinds[i].refined][kinds[i].side], &window, err);
        if (i == HS_VIEW_CLOSEUP) pictures->closeup = window;
    }
    for (int i = 0; i < 4; i++)
        hs_surface_free(&surfaces.of[i / 2][i % 2]);
    if (!done) hs_view_pictures_free(pictures);
    return done;
}

void hs_view_pictures_free(hs_view_pictures *pictures) {
    for (int i = 0; i < HS_VIEW_COUNT; i++)
        hs_picture_free(&pictures->picture[i]);
    *pictures = (hs_view_pictures){0};
}

/* --- Files ------------------------------------------------------------------------------------ */

static char *join(const char *folder, const char *file) {
    size_t size = strlen(folder) + strlen(file) + 6;
    char *path = malloc(size);
    if (path) snprintf(path, size, "%s/%s.png", folder, file);
    return path;
}

static bool write_picture(const hs_picture *picture, const char *folder, const char *file,
                          hs_error *err) {
    char *path = join(folder, file);
    bool done = path ? hs_png_write(picture, path, err)
                     : hs_fail(err, HS_EXIT_INTERNAL, "no memory for a file name");
    free(path);
    return done;
}

static bool make_sheet(hs_picture *sheet, const hs_view_pictures *pictures, const char *title,
                       hs_error *err) {
    hs_panel panel[HS_VIEW_COUNT];
    uint32_t panels = 0;
    for (int i = 0; i < HS_VIEW_COUNT; i++)
        if (pictures->picture[i].rgb)
            panel[panels++] =
                (hs_panel){&pictures->picture[i], hs_view_picture_caption((enum hs_view_picture)i)};
    return hs_picture_sheet(sheet, panel, panels, (panels + 1) / 2, title, err);
}

bool hs_view_pictures_write(const hs_view_pictures *pictures, const char *folder, const char *title,
                            hs_error *err) {
    hs_picture sheet = {0};
    bool done = make_sheet(&sheet, pictures, title, err) &&
                write_picture(&sheet, folder, "sheet", err),
         written[HS_VIEW_COUNT] = {false};
    bool has_sheet = done;
    for (int i = 0; i < HS_VIEW_COUNT && done; i++)
        if (pictures->picture[i].rgb)
            written[i] = done = write_picture(&pictures->picture[i], folder,
                                              hs_view_picture_file((enum hs_view_picture)i), err);
    for (int i = 0; i < HS_VIEW_COUNT && !done; i++) {
        char *path =
            written[i] ? join(folder, hs_view_picture_file((enum hs_view_picture)i)) : NULL;
        if (path) remove(path);
        free(path);
    }
    char *path = has_sheet && !done ? join(folder, "sheet") : NULL;
    if (path) remove(path);
    free(path);
    hs_picture_free(&sheet);
    return done;
}
