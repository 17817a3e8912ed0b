/* SPDX-License-Identifier: Apache-2.0
 *
 * Figures: single pictures and sheets of what the golden model makes of a mesh in one view, or of
 * an output packet that exists already. What halfstep render draws.
 */
#ifndef HS_FIGURES_H
#define HS_FIGURES_H

#include "figure_counts.h"
#include "golden.h"
#include "mesh.h"
#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* The figures beside those of HS_VIEW_PICTURES (render.h). */
#define HS_FIGURES(FIGURE)                                                                         \
    FIGURE(sheet, "all of the above on one sheet")                                                 \
    FIGURE(triptych, "initial, refined, from the side (the paper's figures 9, 10)")                \
    FIGURE(splits, "some faces split: dyadic, and by their face points (figure 1)")                \
    FIGURE(levels, "Catmull-Clark levels 0 to 2, directly (figure 3)")                             \
    FIGURE(steps, "uniform steps 0 to 4 (figures 5, 6)")                                           \
    FIGURE(ramp, "forced depths, 0 at the bottom to most on top (figure 7)")                       \
    FIGURE(reference, "uniform surface in doubles, which runs compare with")                       \
    FIGURE(difference, "where refined and reference differ")                                       \
    FIGURE(turntable, "the view, and the same from a camera that stays; faces, cycles")

/* Where a figure comes from. Pointers belong to the caller. */
typedef struct hs_figure_source {
    const hs_mesh *mesh;      /* NULL: there is only the output; few figures can be drawn then */
    const hs_output *output;  /* what is shown as refined; NULL: golden refines the mesh */
    const float *matrix;      /* row-major; NULL: unknown, so no light and no side */
    hs_settings settings;     /* for golden */
    hs_limits limits;         /* for golden */
    bool forced;              /* the mesh's forced depths are to be used for the ramp, too */
    bool *stopped;            /* becomes true if a capacity stops a refinement; NULL: not asked */
    double turn;              /* degrees from the viewpoint to the side; HS_SIDE_DEGREES is usual */
    uint32_t levels;          /* of the reference surface */
    uint32_t columns;         /* of a sheet; 0: as is usual for the figure */
    const char *title;        /* of a sheet; NULL: none */
    const float *aside;       /* matrix of the turntable's second camera; NULL: no turntable */
    uint32_t view, views;     /* which of how many the turntable shows */
    hs_figure_counts *counts; /* what is shown is counted here; NULL: not asked */
} hs_figure_source;

/* Whether there is a figure of this name, HS_VIEW_PICTURES included. */
bool hs_figure_exists(const char *name);

/* The names, for messages: *index from 0; NULL behind the last one. */
const char *hs_figure_name(uint32_t index);

/* What a figure shows, in a line. NULL if there is none of this name. */
const char *hs_figure_what(const char *name);

/* Draws a figure. Without a renderer (NULL) it is only counted. *picture, empty so far, becomes as
 * large as the renderer's pictures, or a sheet of such. False, with the reason: no such figure, or
 * one that needs the mesh or the matrix where there is none (HS_EXIT_USAGE); the pipeline refuses
 * the view (HS_EXIT_REFUSED); the view cannot be seen from the side (HS_EXIT_VIEWS); memory. */
bool hs_figure_draw(hs_picture *picture, const char *name, hs_renderer *renderer,
                    const hs_figure_source *source, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
