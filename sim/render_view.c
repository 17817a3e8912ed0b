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

/* Far enough round that half of what is seen faced the viewpoint, and half did not. */
#define SIDE_DEGREES       80.0
#define CLOSEUP_SCALE      9.0
#define CLOSEUP_SIDE_SCALE 5.0

static const struct {
    const char *file, *caption;
} pictures_of_view[HS_VIEW_COUNT] = {
#define PICTURE(name, file, caption) {file, caption},
    HS_VIEW_PICTURES(PICTURE)
#undef PICTURE
};

const char *hs_view_picture_file(enum hs_view_picture which) {
    return pictures_of_view[which].file;
}

const char *hs_view_picture_caption(enum hs_view_picture which) {
    return pictures_of_view[which].caption;
}

static const hs_style filled_style = {.paint = HS_PAINT_CLAY, .smooth = true};
static const hs_style initial_style = {.paint = HS_PAINT_CLAY};
static const hs_style initial_wires_style = {.paint = HS_PAINT_CLAY, .wires = true};
static const hs_style depth_style = {.paint = HS_PAINT_DEPTH, .wires = true, .legend = true};
static const hs_style facing_style = {.paint = HS_PAINT_FACING, .wires = true, .legend = true};

hs_style hs_view_picture_style(enum hs_view_picture which) {
    static const hs_style *const style[HS_VIEW_COUNT] = {
        [HS_VIEW_INITIAL] = &initial_style, [HS_VIEW_INITIAL_WIRES] = &initial_wires_style,
        [HS_VIEW_REFINED] = &filled_style,  [HS_VIEW_REFINED_WIRES] = &depth_style,
        [HS_VIEW_SIDE] = &filled_style,     [HS_VIEW_SIDE_WIRES] = &depth_style,
        [HS_VIEW_FACING] = &facing_style,   [HS_VIEW_FACING_SIDE] = &facing_style,
        [HS_VIEW_CLOSEUP] = &depth_style,   [HS_VIEW_CLOSEUP_SIDE] = &depth_style,
    };
    return *style[which];
}

/* One surface in two styles. */
static bool draw_pair(hs_renderer *renderer, const hs_surface *surface, const hs_style *a,
                      hs_picture *picture_a, const hs_style *b, hs_picture *picture_b,
                      hs_error *err) {
    return hs_renderer_draw(renderer, surface, a, picture_a, err) &&
           hs_renderer_draw(renderer, surface, b, picture_b, err);
}

static bool draw_initial(hs_view_pictures *pictures, hs_renderer *renderer,
                         const hs_surface *initial, hs_error *err) {
    hs_picture *p = pictures->picture;
    return draw_pair(renderer, initial, &initial_style, &p[HS_VIEW_INITIAL], &initial_wires_style,
                     &p[HS_VIEW_INITIAL_WIRES], err) &&
           hs_renderer_draw(renderer, initial, &facing_style, &p[HS_VIEW_FACING], err);
}

static bool draw_closeup(hs_renderer *renderer, const hs_surface *refined, double scale,
                         hs_picture *picture, hs_window *window, hs_error *err) {
    hs_style style = depth_style;
    if (!hs_renderer_finest(renderer, refined, scale, &style.window, err)) return false;
    *window = style.window;
    return hs_renderer_draw(renderer, refined, &style, picture, err);
}

static bool draw_refined(hs_view_pictures *pictures, hs_renderer *renderer,
                         const hs_surface *refined, hs_error *err) {
    hs_picture *p = pictures->picture;
    if (!draw_pair(renderer, refined, &filled_style, &p[HS_VIEW_REFINED], &depth_style,
                   &p[HS_VIEW_REFINED_WIRES], err))
        return false;
    return draw_closeup(renderer, refined, CLOSEUP_SCALE, &p[HS_VIEW_CLOSEUP], &pictures->closeup,
                        err);
}

/* What cannot be turned is left out; *err then is the reason, and no failure. */
static bool draw_side(hs_view_pictures *pictures, hs_renderer *renderer, const hs_surface *initial,
                      const hs_surface *refined, hs_error *err) {
    hs_picture *p = pictures->picture;
    uint32_t width = p[HS_VIEW_INITIAL].width, height = p[HS_VIEW_INITIAL].height;
    hs_surface side;
    hs_window window;
    bool turned = hs_surface_turn(&side, refined, SIDE_DEGREES, (double)width / height, err);
    if (!turned && err->code != HS_EXIT_VIEWS) return false;
    if (!turned) {
        snprintf(pictures->no_side, sizeof pictures->no_side, "%.*s",
                 (int)sizeof pictures->no_side - 1, err->text);
        *err = (hs_error){0};
        return true;
    }
    bool done =
        draw_pair(renderer, &side, &filled_style, &p[HS_VIEW_SIDE], &depth_style,
                  &p[HS_VIEW_SIDE_WIRES], err) &&
        draw_closeup(renderer, &side, CLOSEUP_SIDE_SCALE, &p[HS_VIEW_CLOSEUP_SIDE], &window, err);
    hs_surface_free(&side);
    done = done && hs_surface_turn(&side, initial, SIDE_DEGREES, (double)width / height, err);
    done = done && hs_renderer_draw(renderer, &side, &facing_style, &p[HS_VIEW_FACING_SIDE], err);
    hs_surface_free(&side);
    return done;
}

bool hs_view_pictures_draw(hs_view_pictures *pictures, hs_renderer *renderer, const hs_mesh *mesh,
                           const hs_output *output, const float matrix[16], hs_error *err) {
    *pictures = (hs_view_pictures){0};
    hs_surface initial = {0}, refined = {0};
    bool done = hs_surface_of_mesh(&initial, mesh, matrix, err) &&
                hs_surface_of_output(&refined, output, matrix, err) &&
                draw_initial(pictures, renderer, &initial, err) &&
                draw_refined(pictures, renderer, &refined, err) &&
                draw_side(pictures, renderer, &initial, &refined, err);
    hs_surface_free(&initial);
    hs_surface_free(&refined);
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
