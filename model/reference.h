/* SPDX-License-Identifier: Apache-2.0
 *
 * The reference: sqrt(2)-subdivision as the paper writes it down, in doubles, with the paper's own
 * records (section 3.4) and its formula (1). It is there to be read beside the paper and to be
 * independent of everything else: it knows no half-edges, finds edges by searching its vertices'
 * lists, counts the sharp ones at a vertex in every odd step, and takes from an hs_mesh nothing but
 * positions, the faces' vertices and what is sharp. The golden model is compared with it; it is
 * compared with OpenSubdiv.
 *
 *      a step:     w                 w
 *                / | \             /   \        face points F, G are joined to their faces'
 *          ... F   |   G ...  ->  F     G       vertices, the old edge v-w is deleted, and the two
 *                \ | /             \   /        triangles beside it merge into one quad, which
 *                  v                 v          inherits the edge's point.
 *
 * Order. Faces, edges and vertices have numbers, and those are the normative ones
 * (docs/refinement.md): edges are numbered as they are met, walking the faces' sides in order; new
 * vertices follow the old ones in the order of their faces; new faces have the order of the edges
 * that they replace; the quad of edge v -> w (v -> w as the first of its faces runs) is (w, F, v,
 * G). Where the boundary is refined, an odd step makes the half-quad (w, F, v) of a boundary edge,
 * a face with three vertices and a boundary side, v -> w; an even step makes nothing of that side.
 */
#ifndef HS_REFERENCE_H
#define HS_REFERENCE_H

#include "golden.h"
#include "mesh.h"
#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* No face: what is on the other side of a border or a boundary. */
#define HS_REFERENCE_NONE UINT32_MAX

/* Bits of a decision, as in hs_golden_report. */
enum { HS_REFERENCE_SELECTED = 1, HS_REFERENCE_REFINED = 2 };

/* The paper's list<>: count items of a shared array, from first on. */
typedef struct hs_reference_list {
    uint32_t first, count;
} hs_reference_list;

/* class Face { list<Vertex*> v; list<Face*> f; float x, y, z, w; } */
typedef struct hs_reference_face {
    hs_reference_list v; /* its vertices in order, counter-clockwise: items of face_vertex */
    hs_reference_list f; /* the face behind side k, v[k] to v[k+1], or NONE: items of face_face */
    double point[4];     /* the face point: computed in odd steps, inherited for even ones */
    uint8_t forced;      /* refine to this depth whatever the view */
    bool candidate;      /* both parents were selected; true at generation 0 */
    uint8_t sharpness;   /* odd generations: of the halves of the edge that it replaced, v[0]-v[2];
                            15 for a half-quad */
} hs_reference_face;

/* class Edge { Vertex *v0, *v1; float x, y, z, w; } */
typedef struct hs_reference_edge {
    uint32_t v0, v1; /* end vertices */
    uint32_t f0, f1; /* the face that runs v0 -> v1, and the one that runs v1 -> v0 or NONE */
    double point[4]; /* the edge point, until a merged face inherits it */
    /* For how many more levels it is sharp, 15: for ever; 0 for the edges of odd generations, whose
     * faces keep it. */
    uint8_t sharpness;
    bool boundary; /* an end of the surface that is refined (so not in the mode `kept`) */
} hs_reference_edge;

/* class Vertex { float x, y, z, w; list<Face*> f; list<Edge*> e; ... } */
typedef struct hs_reference_vertex {
    double position[4];      /* homogeneous: x, y, z, w */
    hs_reference_list faces; /* the active faces around it, any order: items of vertex_face */
    hs_reference_list edges; /* the active edges that end in it: items of vertex_edge */
    bool held;               /* belongs to a final face, and so never moves again */
    uint8_t sharpness;       /* for how many more levels it stays; 15: for ever, as do corners of
                                the boundary in the mode `smooth` */
    double limit[4];         /* if it was held in a replay with limit positions: where it leaves */
} hs_reference_vertex;

/* A face that will never change again. */
typedef struct hs_reference_final {
    hs_reference_list v; /* its vertices: items of final_vertex */
    uint32_t generation; /* in which it became final */
    bool candidate;      /* its candidate bit; false for the triangles at kept edges */
} hs_reference_final;

/* A mesh in the middle of its refinement. All counts are below 2^31. Read it as you like; change
 * it through the functions below. */
typedef struct hs_reference {
    uint32_t generation; /* steps taken; the next step is odd when this is even */
    uint32_t vertices;   /* all there ever were, dead and alive */
    uint32_t faces;      /* active ones: those that may still change */
    uint32_t edges;      /* of active faces */
    uint32_t finals;     /* faces that will not */
    hs_reference_vertex *vertex;
    hs_reference_face *face;
    hs_reference_edge *edge;
    hs_reference_final *final;
    uint32_t *face_vertex, *face_face, *vertex_face, *vertex_edge, *final_vertex; /* lists' items */
    uint32_t corners, final_corners; /* items of face_vertex, of final_vertex */
    uint32_t final_room, final_corner_room;
    double input_sum; /* largest sum |m_i p_i| of an initial component; 0 without matrix */
    hs_boundary boundary;
    bool limit;        /* vertices leave at their limit positions (set by hs_reference_replay) */
    uint32_t at_level; /* of them, those that left where their level has them */
} hs_reference;

/* --- A mesh in the paper's records ----------------------------------------------------------- */

/* Makes *reference generation 0 of a mesh, with what is sharp in it. matrix: row-major, the
 * positions become M p, evaluated in doubles; NULL leaves them as they are, which is for object
 * space, and for positions that went through the pipeline's binary32 transform already. False, and
 * *reference empty, when memory is exhausted (HS_EXIT_INTERNAL) or the faces are no oriented
 * 2-manifold (HS_EXIT_MESH). */
bool hs_reference_new(hs_reference *reference, const hs_mesh *mesh, const double matrix[16],
                      hs_boundary boundary, hs_error *err);

/* Makes *copy an independent copy. */
bool hs_reference_copy(hs_reference *copy, const hs_reference *reference, hs_error *err);

/* Frees the arrays and empties *reference; an empty (zeroed) one may be freed. */
void hs_reference_free(hs_reference *reference);

/* --- Refinement ------------------------------------------------------------------------------ */

/* One step of the paper (3.3), odd or even as the generation has it, with the rules of
 * docs/refinement.md where only part of the mesh is refined.
 *   decision: a byte per active face, in order; bit HS_REFERENCE_REFINED refines it, bit
 *   HS_REFERENCE_SELECTED makes its children candidates. NULL: everything, a uniform step.
 * Faces that are not refined become final, in the order of the faces; in the same place, sides
 * v -> w of a refined face without a refined face behind them yield final triangles (v, w, F), in
 * the order of the sides; but not boundary edges, unless their mode is `kept`. False when memory is
 * exhausted or a count reaches 2^31; *reference may then only be freed. */
bool hs_reference_step(hs_reference *reference, const uint8_t *decision, hs_error *err);

/* The same, but the quads (and half-quads) are final at once, as those of the step to the last
 * generation D are when they leave the pipeline: each has its place in the order of the sides of
 * the first of its edge's two faces, and its generation is the next one. No active face remains. */
bool hs_reference_last_step(hs_reference *reference, const uint8_t *decision, hs_error *err);

/* Makes all active faces final, in order. Without it a uniformly refined mesh is in .face, unless
 * it has a boundary that is kept; with it every mesh is in .final. */
bool hs_reference_finish(hs_reference *reference, hs_error *err);

/* One Catmull-Clark level, directly (paper, 3.1): every n-gon becomes the n quads (v, edge point
 * behind v, F, edge point before v), corner by corner; vertices are numbered old vertices, face
 * points, edge points. Generation grows by 2. Vertex numbers of the first level are those of two
 * steps; faces have another order. False (HS_EXIT_MESH) on a mesh with a boundary that is kept. */
bool hs_reference_catmull_clark(hs_reference *reference, hs_error *err);

/* --- The limit surface ------------------------------------------------------------------------ */

/* Where vertices are after infinitely many levels, and the surface's normals there, of a uniformly
 * refined reference at an even generation.
 *   position: room for .vertices; 4 numbers each. Only vertices of active faces are written.
 *   normal: room for .corners, or NULL; unit vectors in the space of x/w, y/w, z/w, outward for
 *   faces that run counter-clockwise. A normal per corner (item of face_vertex), since a crease has
 *   one on each side; the corners at a smooth vertex have the same. 0 0 0 where there is none.
 *
 * With v the vertex, e_i its neighbours along edges, f_i the vertex opposite in the quad between
 * e_i and e_(i+1), counter-clockwise, n quads:
 *   smooth     position  (n^2 v + sum(4 e_i + f_i)) / (n^2 + 5n)
 *              tangents  sum A cos(i t) e_i + (cos(i t) + cos((i+1) t)) f_i, the same with sin;
 *                        t = 2 pi/n, A = 1 + cos t + cos(t/2) sqrt(2 (9 + cos t))
 *   crease     position  (e_0 + 4 v + e_k)/6, e_0 and e_k along the crease, k quads between them
 *              tangents  e_0 - e_k; across, with t = pi/k and R = (cos t + 1)/sin t,
 *                        4 R (cos t - 1) v - R (1 + 2 cos t) (e_0 + e_k)
 *                        + sum over 0 < i < k of 4 sin(i t) e_i
 *                        + sum over 0 <= i < k of (sin(i t) + sin((i+1) t)) f_i
 *                        or e_0 + e_k - 2v if k = 1
 *   stays      position  v
 *              tangents  e_0 - v and e_k - v, in each sector between two sharp edges
 * Sources: M. Halstead, M. Kass, T. DeRose, "Efficient, Fair Interpolation using Catmull-Clark
 * Surfaces", 1993, appendix (smooth; the second tangent there is the first one of the next edge);
 * H. Biermann, A. Levin, D. Zorin, "Piecewise Smooth Subdivision Surfaces with Normal Control",
 * 2000 (crease, corner), as OpenSubdiv's catmarkScheme.h has them. The sharpness that counts is
 * that of the level; a finite one that has not worn off counts as if it never did, as in
 * OpenSubdiv.
 *
 * Where these have no normal, it is that of the fan v, e_0, e_1, ...: at smooth vertices of valence
 * 2 (whose tangents vanish), at a vertex that is sharp alone, where tangents are parallel, on a
 * boundary that is kept, and at vertices of other faces than quads; the latter two leave the
 * position as it is, too. False (HS_EXIT_INTERNAL) at an odd generation. */
bool hs_reference_limit(const hs_reference *reference, double (*position)[4], double (*normal)[3],
                        hs_error *err);

/* --- Replaying what golden did --------------------------------------------------------------- */

/* The reference's own decisions on its active faces: marks, selection and guard
 * ring of docs/refinement.md, in doubles. decision: room for a byte per active face.
 * A determinant that is tiny may have another sign than golden's exact one on rounded positions. */
bool hs_reference_decide(const hs_reference *reference, const hs_settings *settings,
                         uint8_t *decision, hs_error *err);

/* How often the reference would have decided otherwise. Reported, no failure: at a silhouette a
 * determinant may be as near to zero as the roundings that the two engines differ by. */
typedef struct hs_reference_decisions {
    uint64_t faces; /* active faces in all generations */
    uint64_t selected_different, refined_different;
} hs_reference_decisions;

/* Refines *reference (fresh from hs_reference_new, with the view's matrix and boundary mode) as
 * golden's report says that golden did, to the last generation, and finishes it. With
 * settings->limit the vertices' limit positions are made as well, each when a final face first
 * names the vertex; .at_level counts those that have none. decisions may be NULL. False
 * (HS_EXIT_DIFFERENT) when a generation has another number of active faces than golden's. */
bool hs_reference_replay(hs_reference *reference, const hs_settings *settings,
                         const hs_golden_report *report, hs_reference_decisions *decisions,
                         hs_error *err);

/* A bound of |golden's component - reference's component| for every vertex that leaves golden
 * within the given number of generations (steps), where E is the block exponent.
 *
 * Let u = 2^(E-30), golden's unit, and let e be the largest error of a position, in units, before
 * an odd step. All masks are convex combinations, which never enlarge the largest error of what
 * goes into them; each result is then rounded once, by at most 1/2 unit.
 *   face point   mean of vertices                                e + 1/2
 *   edge point   (v + w + F + G)/4, half of it rounded points:   e + 1/2 * 1/2 + 1/2 = e + 3/4
 *   vertex point weight of the n face points: n * 1/n^2 = 1/n, n >= 2:
 *                                                                e + 1/n * 1/2 + 1/2 <= e + 3/4
 *   on creases   (v + w)/2 and (a + 6v + b)/8, of vertices alone: e + 1/2
 * An even step computes nothing. So g generations add at most 3/4 ceil(g/2) units to what the
 * initial positions have: 1/2 unit of quantization and t/u, where
 *   t = 3 * 2^-24 / (1 - 3 * 2^-24) * S + 7 * 2^-150
 * bounds the binary32 evaluation of M p (three roundings on the way of every product to the sum,
 * seven operations that may underflow), S being reference->input_sum; without a matrix t is 0. On
 * the way out, rounding to binary32 adds at most half an ulp of a number below 2^E: 2^(E-25) = 32
 * units, or 2^-150 if subnormal. The doubles of the reference itself: sums of up to 255 terms of at
 * most 2^E with weights that add up to at most 2 lose less than 264 * 2 * 2^-53 * 2^E < 2^-13 unit
 * per odd step, less than 1/1000 even where face points enter the next sum. Together
 *   (1/2 + (3/4 + 1/1000) ceil(g/2) + 32) u + t + 2^-150.
 *
 * A limit position is one more convex combination, rounded once: it adds 1/2 unit to the largest
 * error of what goes into it. These are, in even generations, positions of vertices; in odd ones,
 * positions behind the odd step, and attributes of quads, which are edge points of that step: for
 * all of them the e of that step holds already. In doubles, at most 2 * 255 + 1 terms with weights
 * that add up to 1 lose less than 520 * 2^-53 * 2^E < 1/1000 unit. So reference->limit adds
 *   (1/2 + 1/1000) u. */
double hs_reference_bound(const hs_reference *reference, uint32_t generations, int32_t exponent);

typedef struct hs_reference_comparison {
    uint32_t vertices, faces; /* compared: what golden sent */
    uint32_t different_faces; /* faces of another place, shape, generation or candidate bit; missing
                                 ones */
    uint32_t different_vertices; /* vertices that one of the two does not have */
    uint32_t different_at_level; /* with limit positions: the difference of how many have none */
    uint32_t beyond_bound;       /* vertices farther apart than hs_reference_bound allows */
    double largest_distance;     /* largest difference of a component, over 2^E */
    double bound;                /* hs_reference_bound of the run, over 2^E */
    double largest_pixels;       /* at 1024 x 1024, across or up, of vertices in the view volume */
    uint32_t largest_vertex;     /* vertex number of largest_distance */
    uint64_t components, equal;  /* of positions; those equal to the double rounded once */
    bool exhausted;              /* memory: the vertices were not compared */
    char first[160];             /* the first difference in a sentence; "" if there is none */
} hs_reference_comparison;

/* Compares a finished replay with golden's decoded output: the same faces in the same order, the
 * same vertices, as many without a limit position, positions within the bound. True if all that
 * holds; *comparison says how far. */
bool hs_reference_compare(const hs_reference *reference, const hs_output *output,
                          hs_reference_comparison *comparison);

#ifdef __cplusplus
}
#endif
#endif
