/* SPDX-License-Identifier: Apache-2.0
 *
 * What the files of the figures share among themselves; users need figures.h alone.
 */
#ifndef HS_FIGURE_PARTS_H
#define HS_FIGURE_PARTS_H

#include "figures.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Counts a surface as the figure's next panel, and draws it unless renderer is NULL. */
bool hs_figure_show(hs_picture *picture, const char *caption, hs_renderer *renderer,
                    const hs_surface *surface, const hs_style *style,
                    const hs_figure_source *source, hs_error *err);

/* What golden makes of a mesh (the source's, but for forced depths) under the source's view. */
bool hs_figure_refine(hs_output *output, const hs_mesh *mesh, const hs_settings *settings,
                      const hs_figure_source *source, hs_error *err);

/* Puts the pictures of the panels that were counted last on a sheet, captions with their faces. */
bool hs_figure_sheet(hs_picture *sheet, const hs_picture *picture, uint32_t panels,
                     const hs_figure_source *source, hs_error *err);

/* The figures that have a file of their own. renderer may be NULL: then they only count. */
bool hs_figure_splits(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                      hs_error *err);
bool hs_figure_turntable(hs_picture *sheet, hs_renderer *renderer, const hs_figure_source *source,
                         hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
