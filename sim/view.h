/* SPDX-License-Identifier: Apache-2.0
 *
 * Viewpoints: matrices clip = M p, row-major, OpenGL's clip conventions (|x|, |y|, |z| <= w inside,
 * counter-clockwise is front).
 */
#ifndef HS_VIEW_H
#define HS_VIEW_H

#include "mesh.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_view {
    float matrix[16]; /* row-major */
} hs_view;

typedef struct hs_views {
    uint32_t count;
    hs_view *view; /* from malloc */
} hs_views;

/* What a `look` line says. */
typedef struct hs_look {
    double eye[3], at[3], up[3], fov, near, far;
} hs_look;

/* A look between two, t from 0 to 1: at, fov, near and far change evenly, as does the distance of
 * the eye from at; its direction from there, and up, turn along the shorter way. False
 * (HS_EXIT_VIEWS) where there is none: they are opposite. */
bool hs_look_between(hs_look *look, const hs_look *a, const hs_look *b, double t, hs_error *err);

/* Reads a views file: a view a line, `matrix m00 m01 .. m33` or `look eye X Y Z at X Y Z up X Y Z
 * fov DEGREES near N far F`, '#' comments, blank lines. `frames N` between two looks makes the
 * second one the Nth view behind the first, with the views between them. aspect is width / height
 * of the picture that `look` is for. On failure *views is empty and *err names file, line and word
 * (HS_EXIT_VIEWS, HS_EXIT_FILE). Numbers must be finite as binary32; a singular matrix is fine. */
bool hs_views_read(hs_views *views, const char *path, double aspect, hs_error *err);

/* The same from size bytes in memory, with a zero byte behind them; they are cut up. name stands
 * for the file in messages. */
bool hs_views_parse(hs_views *views, const char *name, char *text, size_t size, double aspect,
                    hs_error *err);

/* count viewpoints evenly spaced on a slightly raised circle around the mesh's bounding sphere,
 * the first in front (+z), all of the mesh in view. */
bool hs_views_orbit(hs_views *views, uint32_t count, const hs_mesh *mesh, double aspect,
                    hs_error *err);

/* As the options --views FILE and --orbit N ask for: what the file has, or if it is NULL, so many
 * on the circle. Fails (HS_EXIT_VIEWS), with *views empty, if there are none, or more than
 * HS_VIEWS_MOST. */
enum { HS_VIEWS_MOST = 65536 }; /* as many as a stream numbers */
bool hs_views_open(hs_views *views, const char *path, uint32_t orbit, const hs_mesh *mesh,
                   double aspect, hs_error *err);

/* One of them. Fails (HS_EXIT_USAGE) if there is none of that number, which counts from 0. */
bool hs_views_choose(hs_view *view, const hs_views *views, uint32_t number, hs_error *err);

/* Both: opens them for one of them. */
bool hs_view_choose(hs_view *view, uint32_t number, const char *path, uint32_t orbit,
                    const hs_mesh *mesh, double aspect, hs_error *err);

/* A perspective view, as gluLookAt and gluPerspective define it, computed in double and rounded
 * once. fov is vertical, in degrees, in (0, 180). False (HS_EXIT_VIEWS) where no view exists:
 * eye = at, up along the line of sight, near >= far, near <= 0. */
bool hs_view_look(hs_view *view, const double eye[3], const double at[3], const double up[3],
                  double fov, double aspect, double near, double far, hs_error *err);

/* Writes views as `matrix` lines, nine significant digits, so that reading gives the same bits. */
bool hs_views_write(const hs_views *views, const char *path, hs_error *err);
void hs_views_free(hs_views *views);

#ifdef __cplusplus
}
#endif
#endif
