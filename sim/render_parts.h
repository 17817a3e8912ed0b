/* SPDX-License-Identifier: Apache-2.0
 *
 * What the renderer's files share among themselves; users need render.h alone.
 */
#ifndef HS_RENDER_PARTS_H
#define HS_RENDER_PARTS_H

#include "render.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Vectors of three. hs_normalize leaves the zero vector and returns false. */
double hs_dot(const double a[3], const double b[3]);
void hs_cross(double result[3], const double a[3], const double b[3]);
bool hs_normalize(double v[3]);

/* 4x4 matrices, row-major. False: singular, up to rounding. */
bool hs_matrix_invert(double inverse[16], const double m[16]);
void hs_matrix_apply(double result[4], const double m[16], const double p[4]);

/* Sets hs_surface.eye for a matrix. */
void hs_eye_of_matrix(double eye[4], const double m[16]);

/* A surface with room for its vertices (zero) and a copy of its faces; facing zero. */
bool hs_surface_make(hs_surface *surface, uint32_t vertices, uint32_t faces, const uint32_t *first,
                     const uint32_t *corner, const uint8_t *generation, hs_error *err);

/* Gives a surface 3 numbers per corner. False, the surface freed: no memory. */
bool hs_surface_add_normals(hs_surface *surface, const float *normal, hs_error *err);

/* Unit normals in object space (surface->object must not be NULL): of a face, and of all corners, 3
 * numbers each. A corner's is the surface's own, if it has any, or the mean of the faces around the
 * vertex, weighted by their angles there. No mean is taken across a crease: between faces of
 * generation 2 and more that are more than HS_CREASE_DEGREES apart. False: no memory. */
#define HS_CREASE_DEGREES 60
void hs_face_normal(const hs_surface *surface, uint32_t face, double normal[3]);
bool hs_corner_normals(const hs_surface *surface, float *normal);

/* An edge of the surface, once, whichever faces share it. */
typedef struct hs_edge {
    uint32_t from, to;
    bool border; /* one face alone has it */
} hs_edge;

/* All edges, from malloc; *count of them. NULL: no memory. */
hs_edge *hs_surface_edges(const hs_surface *surface, uint32_t *count);

/* Where the light of a view comes from: unit vectors in object space. */
typedef struct hs_light {
    double ahead[3]; /* where front faces look to: towards the eye, unless the view is mirrored */
    double up[3];    /* up on the screen */
    double key[3];   /* towards the second light, above the camera's left shoulder */
} hs_light;
void hs_light_of_view(hs_light *light, const double matrix[16], const double eye[4]);
void hs_light_from(hs_light *light, const double matrix[16], const double ahead[3]);

/* sRGB colours, 0xrrggbb. */
#define HS_CLAY_COLOR 0xdcd6cc
#define HS_INSIDE_COLOR                                                                            \
    { 0.80, 0.52, 0.42 } /* terracotta */
uint32_t hs_depth_color(uint32_t generation, uint32_t deepest);
uint32_t hs_facing_color(uint32_t facing);

/* Explains a paint in the lower left corner. */
void hs_draw_legend(hs_picture *picture, enum hs_paint paint, uint32_t deepest);

#ifdef __cplusplus
}
#endif
#endif
