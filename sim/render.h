/* SPDX-License-Identifier: Apache-2.0
 *
 * The reference renderer: draws, off screen (OSMesa), what comes out of the pipeline and what it is
 * compared with.
 *
 *   hs_output + matrix ----.                                     .-> hs_picture -> PNG
 *   hs_mesh + matrix -------+-> hs_surface -> hs_renderer_draw --+-> hs_picture -> compare
 *   arrays + matrix -------'        '-> hs_surface_turn: the same, seen from the side
 *
 * Clip-space positions are handed to OpenGL as they are (the division by w is OpenGL's, and so is
 * the clipping). Light is computed in object space: positions that come in clip space are carried
 * back through the inverse matrix, in double. If the matrix has none, colours are flat.
 *
 * With one renderer, one surface and one style, pictures are equal byte for byte from call to call
 * and from run to run. OSMesa's context is current in the calling thread during a call.
 */
#ifndef HS_RENDER_H
#define HS_RENDER_H

#include "picture.h"
#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* --- Surfaces --------------------------------------------------------------------------------- */

/* How a face lies to the viewpoint: the signs of its corner determinants det[(x, y, w)] of three
 * consecutive corners, positive = front, zero = back. */
enum hs_facing { HS_FACING_FRONT, HS_FACING_BACK, HS_FACING_BOTH };

/* Faces to be drawn. All is owned by the surface. */
typedef struct hs_surface {
    uint32_t vertices, faces;
    float *clip;         /* 4 per vertex: x, y, z, w of the view that is drawn */
    double *object;      /* 3 per vertex: x, y, z in object space; NULL: not known, colours flat */
    float *normal;       /* 3 per corner: unit normals in object space; NULL: means of the faces' */
    uint32_t *first;     /* faces + 1: where a face's corners begin */
    uint32_t *corner;    /* vertices of the faces */
    uint8_t *generation; /* per face: its depth of refinement */
    uint8_t *facing;     /* per face: enum hs_facing, as seen from the original viewpoint */
    double matrix[16];   /* of the view that is drawn, row-major, clip = M p */
    double eye[4];       /* from the point p, what is front looks towards eye.xyz - p * eye.w */
} hs_surface;

/* The surface of an output packet. matrix (row-major) is the view's; it may be NULL or singular:
 * then the surface can be drawn, without light, but not turned. The facing is evaluated on
 * 32-bit integers of the block exponent, exactly. False only when memory is exhausted. */
bool hs_surface_of_output(hs_surface *surface, const hs_output *output, const float *matrix,
                          hs_error *err);

/* The surface of a mesh under a matrix, each row ((m0*x + m1*y) + (m2*z + m3*w)) in binary32, as
 * the pipeline transforms; generation 0. The facing is bit for bit that of the pipeline at
 * generation 0. Matrices and positions must be finite. */
bool hs_surface_of_mesh(hs_surface *surface, const hs_mesh *mesh, const float matrix[16],
                        hs_error *err);

/* A face list in object space. The arrays belong to the caller. */
typedef struct hs_faces {
    uint32_t vertices, faces;
    const double *position;    /* 4 per vertex: x, y, z, w */
    const float *normal;       /* 3 per corner: unit vectors; NULL: means of the faces' */
    const uint32_t *first;     /* faces + 1 */
    const uint32_t *corner;    /* first[faces] */
    const uint8_t *generation; /* per face; NULL: all 0 */
} hs_faces;

/* The surface of a face list under a matrix; clip = M p in double, rounded once to binary32. */
bool hs_surface_of_faces(hs_surface *surface, const hs_faces *faces, const float matrix[16],
                         hs_error *err);

/* The same surface from elsewhere: the eye goes degrees (positive: to the right) around the axis of
 * object space that looks most upright in the view, through the middle of the surface's bounding
 * box, and the camera then takes in all of the surface. aspect is width / height. Facing stays that
 * of the original viewpoint. False, with the reason: the view's matrix is unknown or singular, or
 * the surface is empty (HS_EXIT_VIEWS), or memory. */
bool hs_surface_turn(hs_surface *turned, const hs_surface *surface, double degrees, double aspect,
                     hs_error *err);

/* The same surface through another view's matrix, row-major. Facing stays that of the original
 * viewpoint. False, with the reason: the surface's own matrix is unknown or singular
 * (HS_EXIT_VIEWS), or memory. */
bool hs_surface_view(hs_surface *seen, const hs_surface *surface, const float matrix[16],
                     hs_error *err);

void hs_surface_free(hs_surface *surface);

/* The deepest generation among the faces. */
uint8_t hs_surface_deepest(const hs_surface *surface);

/* Cuts a face into triangles for drawing: writes corners of the face (0 to sides-1), or sides for
 * the mean of the corners, three a triangle, and returns how many triangles. Quads are cut along
 * the shorter diagonal, larger convex faces into a fan around their mean, faces that are not
 * convex (in the plane of their mean normal) by cutting off ears. triangle has room for
 * 3 * HS_MAX_SIDES entries. */
uint32_t hs_surface_triangles(const hs_surface *surface, uint32_t face, uint8_t *triangle);

/* --- Drawing ---------------------------------------------------------------------------------- */

enum hs_paint {
    HS_PAINT_CLAY,  /* one material; inside of the surface: terracotta */
    HS_PAINT_DEPTH, /* by generation, pale (0) to dark blue (deepest); inside: terracotta, likewise
                     */
    HS_PAINT_FACING /* front dark, back medium, both pale, as in the paper's figure 8; no inside */
};

/* A part of the screen: x' = scale * (x - x_centre * w), y likewise. All zero: all of it. */
typedef struct hs_window {
    double x, y;  /* centre, in normalized device coordinates, -1 to 1 */
    double scale; /* enlargement */
} hs_window;

/* A zeroed style is a filled, flatly lit clay picture without wires or legend. */
typedef struct hs_style {
    enum hs_paint paint;
    bool smooth;       /* the corners' normals; otherwise one normal a face */
    bool wires;        /* the faces' edges; the surface's boundary is drawn bolder */
    bool legend;       /* explains the paint, lower left corner */
    uint8_t deepest;   /* generation at the dark end of the palette; 0: the surface's deepest */
    double wire_width; /* pixels; 0: 1.1 at 768 pixels, in proportion to the picture's size */
    hs_window window;
} hs_style;

typedef struct hs_renderer hs_renderer;

/* A renderer of pictures of width x height pixels, each the mean of samples x samples samples
 * (1 to 4; 3 is good). NULL, with the reason: a size that OSMesa cannot do (HS_EXIT_USAGE), no
 * OSMesa or memory (HS_EXIT_INTERNAL). Memory: 8 bytes a sample. */
hs_renderer *hs_renderer_new(uint32_t width, uint32_t height, uint32_t samples, hs_error *err);
void hs_renderer_free(hs_renderer *renderer);

/* Width / height of its pictures. */
double hs_renderer_aspect(const hs_renderer *renderer);

/* Draws a surface. Replaces *picture, which must be empty. */
bool hs_renderer_draw(hs_renderer *renderer, const hs_surface *surface, const hs_style *style,
                      hs_picture *picture, hs_error *err);

/* The window, scale times enlarged, that has most visible faces of the deepest visible generation:
 * where the silhouette is finest. The middle of the screen if nothing is visible. */
bool hs_renderer_finest(hs_renderer *renderer, const hs_surface *surface, double scale,
                        hs_window *window, hs_error *err);

/* --- The pictures of one view ----------------------------------------------------------------- */

/* File name (without ".png") and caption of each, in the order of the sheet. */
#define HS_VIEW_PICTURES(PICTURE)                                                                  \
    PICTURE(INITIAL, "initial", "initial mesh")                                                    \
    PICTURE(REFINED, "refined", "refined, from the viewpoint")                                     \
    PICTURE(SIDE, "side", "refined, from the side")                                                \
    PICTURE(FACING, "facing", "initial mesh, classified")                                          \
    PICTURE(CLOSEUP, "closeup", "where the silhouette is finest")                                  \
    PICTURE(INITIAL_WIRES, "initial-wires", "initial mesh, wires")                                 \
    PICTURE(REFINED_WIRES, "refined-wires", "refined, wires and depth")                            \
    PICTURE(SIDE_WIRES, "side-wires", "from the side, wires and depth")                            \
    PICTURE(FACING_SIDE, "facing-side", "classified, from the side")                               \
    PICTURE(CLOSEUP_SIDE, "closeup-side", "where it is finest, from the side")

enum hs_view_picture {
#define PICTURE(name, file, caption) HS_VIEW_##name,
    HS_VIEW_PICTURES(PICTURE)
#undef PICTURE
        HS_VIEW_COUNT
};

/* How far round these go (hs_surface_turn): half of what is seen then faced the viewpoint, and half
 * did not. */
#define HS_SIDE_DEGREES 80.0

const char *hs_view_picture_file(enum hs_view_picture which);
const char *hs_view_picture_caption(enum hs_view_picture which);
/* Whether it shows the output; otherwise, the initial mesh. */
bool hs_view_picture_shows_output(enum hs_view_picture which);
/* Whether it is seen from the side; otherwise, from the viewpoint. */
bool hs_view_picture_is_side(enum hs_view_picture which);

/* Draws one of them; surface is what it shows, turned already if it is seen from the side. *window
 * (may be NULL) becomes a close-up's place. */
bool hs_view_picture_draw(hs_picture *picture, enum hs_view_picture which, hs_renderer *renderer,
                          const hs_surface *surface, hs_window *window, hs_error *err);

typedef struct hs_view_pictures {
    hs_picture picture[HS_VIEW_COUNT]; /* empty where there is none */
    hs_window closeup;                 /* where the close-up is, seen from the viewpoint */
    char no_side[200]; /* why there are no pictures from the side; "" if there are */
} hs_view_pictures;

/* Draws all pictures of a view: mesh and output under the view's matrix. Where the view cannot be
 * seen from the side, these pictures are missing and no_side says why; that is no failure. */
bool hs_view_pictures_draw(hs_view_pictures *pictures, hs_renderer *renderer, const hs_mesh *mesh,
                           const hs_output *output, const float matrix[16], hs_error *err);

/* Writes them as FOLDER/NAME.png, and FOLDER/sheet.png with all of them, in two rows,
 * titled. The folder must exist. On failure the files written so far are removed. */
bool hs_view_pictures_write(const hs_view_pictures *pictures, const char *folder, const char *title,
                            hs_error *err);
void hs_view_pictures_free(hs_view_pictures *pictures);

#ifdef __cplusplus
}
#endif
#endif
