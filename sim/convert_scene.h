/* SPDX-License-Identifier: Apache-2.0
 *
 * A refined surface for other programs: what one view made of a mesh, in a space of choice.
 *
 *   hs_output, clip space -- inverse matrix or division by w --> hs_scene --> PLY, glTF, POV-Ray,
 * OBJ
 *
 * Whatever the space: corners run counter-clockwise, seen from outside and in a right-handed
 * system, which is what these programs expect. Device and clip space are left-handed (z grows away
 * from the eye), so faces run the other way round there than in the stream.
 */
#ifndef HS_CONVERT_SCENE_H
#define HS_CONVERT_SCENE_H

#include "stream.h"

typedef enum hs_space {
    HS_SPACE_OBJECT, /* the mesh's: clip coordinates through the inverse of the view's matrix */
    HS_SPACE_NDC,    /* normalized device coordinates: x, y, z over w, -1 to 1 in view */
    HS_SPACE_CLIP    /* x, y, z and, beside them, w, as the pipeline sends them */
} hs_space;

/* Names of the spaces, as in "ndc"; hs_space_parse is false if there is none such. */
const char *hs_space_name(hs_space space);
bool hs_space_parse(const char *text, hs_space *space);

/* All arrays are the scene's. A vertex is a place; a point is a vertex with a normal: vertices on a
 * crease have one for each of its sides. */
typedef struct hs_scene {
    hs_space space;
    double matrix[16]; /* clip = M place, row-major: the view's, as seen from this space */
    uint8_t deepest;   /* the generation at the dark end of the palette */
    uint32_t left_out; /* faces that have no place in this space */

    uint32_t vertices; /* the output's, in its order, and then the means of n-gons that were cut */
    float *place;      /* 4 per vertex: x, y, z, w; finite; w = 1 but in clip space */
    uint8_t *vertex_generation; /* the deepest generation among the faces there */

    uint32_t points;
    uint32_t *vertex;          /* per point */
    float *normal;             /* 3 per point: unit vectors, outwards */
    uint8_t *point_generation; /* the deepest generation among the faces that have this point */

    uint32_t faces;      /* in the output's order */
    uint32_t *first;     /* faces + 1: where a face's corners begin */
    uint32_t *corner;    /* points */
    uint8_t *generation; /* per face: the one in which it became final */

    uint32_t triangles;           /* 0 unless faces were to be cut */
    uint32_t *triangle;           /* 3 points each */
    uint8_t *triangle_generation; /* of the face that it is cut from */
} hs_scene;

/* How a scene is made. */
typedef struct hs_scene_options {
    hs_space space;
    bool cut;          /* faces into triangles, as the renderer cuts them */
    bool depths_apart; /* no point belongs to faces of different generations */
} hs_scene_options;

/* Makes a scene of an output that has faces and the view's matrix. In device coordinates faces with
 * a vertex at or behind the eye, or beyond binary32, are left out, and so are their vertices.
 * Normals are those of hs_corner_normals in object space, carried along; where the matrix is
 * singular, means in the space itself. False, with *scene empty: object space is asked for, and the
 * matrix is singular or leads beyond binary32, or no face is left (HS_EXIT_VIEWS); memory. */
bool hs_scene_make(hs_scene *scene, const hs_output *output, const float matrix[16],
                   const hs_scene_options *options, hs_error *err);
void hs_scene_free(hs_scene *scene);

#endif
