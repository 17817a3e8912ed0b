/* SPDX-License-Identifier: Apache-2.0
 *
 * The pictures of a run, one call a view: what the pipeline made of it, and how far that is from
 * the surface that it stands for. The context holds what all views share: the renderer, and the
 * reference surface (uniform, so many Catmull-Clark levels, object space).
 *
 *   mesh -- uniform, in doubles, once a run --> reference surface
 *   reference surface -- matrix --> reference.png   -.
 *   output of the first engine -- matrix --> refined -+-> difference.png, distances
 *                                          |
 *   output of another engine -- matrix --> refined: equal in every pixel, or the run has failed
 */
#ifndef HS_RUN_PICTURES_H
#define HS_RUN_PICTURES_H

#include "mesh.h"
#include "picture.h"
#include "render.h"
#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- The reference surface -------------------------------------------------------------------- */

/* The most faces that a reference surface gets, and the levels that are good: more make no
 * difference that a picture of 768 x 768 pixels shows. */
enum { HS_REFERENCE_SURFACE_FACES = 400000, HS_REFERENCE_SURFACE_LEVELS = 4 };

/* How strongly pictures of differences show a difference of colour. */
#define HS_DIFFERENCE_GAIN 4.0

/* A uniformly refined mesh in object space, in doubles, with the normals of its limit surface (but
 * where an open mesh's boundary is kept: such a mesh has no limit at its boundary). */
typedef struct hs_reference_surface {
    uint32_t level;       /* Catmull-Clark levels that were made, each of two steps */
    uint32_t asked_level; /* level, unless HS_REFERENCE_SURFACE_FACES forbids that many */
    hs_faces faces;       /* for hs_surface_of_faces; its arrays are the surface's */
    double *position;
    float *normal;
    uint32_t *first, *corner;
    uint8_t *generation;
} hs_reference_surface;

/* Refines a mesh uniformly, so many levels or as many as HS_REFERENCE_SURFACE_FACES allows: by
 * Catmull-Clark, or, in the boundary mode `kept` where the mesh is open, by steps that keep the
 * boundary's edges, as the pipeline does. Of the settings, boundary and limit count; with limit,
 * vertices are at their limit positions, where they have any. On failure *surface is empty
 * (HS_EXIT_INTERNAL: memory). */
bool hs_reference_surface_make(hs_reference_surface *surface, const hs_mesh *mesh,
                               const hs_settings *settings, uint32_t levels, hs_error *err);
void hs_reference_surface_free(hs_reference_surface *surface);

/* --- The pictures of a run -------------------------------------------------------------------- */

/* What an engine sent for the view that is drawn. */
typedef struct hs_run_output {
    const char *engine; /* "golden", "rtl" */
    const hs_output *output;
} hs_run_output;

/* Two pictures of a view, compared. */
typedef struct hs_run_picture_comparison {
    const char *a, *b; /* an engine, or "reference" for the reference surface */
    const char *what;  /* which picture: "refined", "refined-wires" */
    bool must_equal;   /* equal in every pixel, or the run has failed */
    hs_picture_difference difference;
    char first[160]; /* if must_equal: the first pixel that differs, in a sentence; "" if none */
} hs_run_picture_comparison;

enum { HS_RUN_PICTURE_COMPARISONS = 32 };

typedef struct hs_run_pictures_report {
    bool drawn; /* false: there is nothing to draw, as the first engine sent no faces */
    uint32_t comparisons;
    hs_run_picture_comparison comparison[HS_RUN_PICTURE_COMPARISONS];
    uint32_t reference_level, reference_faces; /* the reference surface; no faces: there is none */
    char no_side[200]; /* why there are no pictures from the side; "" if there are */
} hs_run_pictures_report;

typedef struct hs_run_pictures hs_run_pictures;

/* A context for the views of one mesh. Of the settings, boundary and limit count. levels: of the
 * reference surface; 0: none. The mesh must outlive it. NULL, with the reason, as hs_renderer_new.
 */
hs_run_pictures *hs_run_pictures_new(const hs_mesh *mesh, const hs_settings *settings,
                                     uint32_t width, uint32_t height, uint32_t levels,
                                     hs_error *err);

/* The reference surface, to say what it is; NULL if there is none. */
const hs_reference_surface *hs_run_pictures_reference(const hs_run_pictures *pictures);

/* Draws and writes a view's pictures into folder, which exists, and compares them. output: one or
 * more engines' (the first is the one that is written). title: for the sheet. *report is filled
 * even if the pictures of two engines differ; that is no failure here.
 *
 * Written are NAME.png for HS_VIEW_PICTURES, sheet.png with all of them and, with a reference
 * surface, reference.png and difference.png. Each other engine's refined pictures, plain and with
 * wires, are compared with the first one's; an engine that sent no faces differs in every pixel.
 * Last in the report stands the refined picture beside the reference surface's. On failure
 * (HS_EXIT_FILE, HS_EXIT_INTERNAL) the view has no file that was written here. */
bool hs_run_pictures_view(hs_run_pictures *pictures, const char *folder, const char *title,
                          const float matrix[16], const hs_run_output *output, uint32_t outputs,
                          hs_run_pictures_report *report, hs_error *err);

void hs_run_pictures_free(hs_run_pictures *pictures);

#ifdef __cplusplus
}
#endif
#endif
