/* SPDX-License-Identifier: Apache-2.0
 *
 * What golden's stages share: the active mesh of one generation, its vertices, and what each stage
 * leaves for the next. The stages run in this order, once a generation:
 *
 *   classify   positions -> marks of faces and vertices, face points, sums around vertices
 *   select     marks     -> selected faces
 *   guard      selected  -> refined faces, numbers of their new vertices, held vertices
 *   smooth     sums      -> moved positions; sends the vertices that final faces will name
 *   split      refined   -> child quads, final faces
 *
 * Half-edges of face f of generation 0 are first[f] .. first[f+1]-1; later 4f .. 4f+3, so that
 * next and prev need no memory. A half-quad (odd generations; docs/refinement.md, section 9) has
 * three of the four: 4f+2 is its boundary edge, 4f+3 is void.
 */
#ifndef HS_GOLDEN_STATE_H
#define HS_GOLDEN_STATE_H

#include "golden.h"

/* Marks of a vertex (all) and of a face (FRONT, BACK, HITS); a vertex collects its faces' marks. */
enum {
    MARK_FRONT = 1,     /* a corner is seen counter-clockwise */
    MARK_BACK = 2,      /* a corner is not */
    MARK_HITS = 4,      /* not wholly outside one of the view volume's six planes */
    MARK_BORDER = 8,    /* vertex: an end of an edge with one active face */
    MARK_HELD = 16,     /* vertex: a corner of a face that is not refined */
    MARK_CHOSEN = 32,   /* vertex: a corner of a selected face */
    MARK_ACTIVE = 64,   /* vertex: a corner of an active face */
    MARK_NONQUAD = 128, /* vertex, generation 0: a corner of a face that is not a quad */
    MARK_STOP = 8       /* face: all its edges are shorter than the least edge */
};

/* The twin of a half-edge on the surface's boundary, if the mode is not `kept`: its edge is
 * refined like others. And its child, in an even step: there is none. */
#define BOUNDARY_TWIN 0xfffffffeu

enum { FACE_SELECTED = 1, FACE_REFINED = 2 }; /* bits of a decision, as in hs_golden_report */

typedef struct hs_state {
    /* The view */
    hs_limits limits;
    hs_settings settings;
    float matrix[16];
    uint32_t status, error_position;
    bool parsed;         /* every record was right in itself; the topology may still be wrong */
    uint32_t depth;      /* the generation at which everything is final */
    uint32_t max_forced; /* largest forced depth of a face */
    int32_t exponent;    /* E: positions are in units of 2^(E-30) */

    /* The active mesh of this generation */
    uint32_t generation;
    uint32_t faces, halfedges;
    uint32_t boundary;       /* sides on the surface's boundary, but in the mode `kept` */
    uint32_t *first;         /* generation 0: faces + 1 */
    uint32_t *face;          /* generation 0: per half-edge */
    uint32_t *origin, *twin; /* per half-edge; HS_BORDER: no active face beyond */
    uint8_t *sharp;          /* per half-edge: of the edge; odd generations: of the edge that
                                the quad was made of, four times */
    bool closed;             /* every half-edge has a twin */
    bool mark_always; /* faces get their marks in uniform runs too, which have no use for them */
    bool unmarked;    /* in this run they do not */
    bool plain;       /* nothing is sharp, no boundary but a kept one, no limit, no least edge */
    uint8_t *candidate, *forced; /* per face */

    /* Vertices, alive or not: the first `vertices` of each array. Numbers are for ever: new ones
     * are appended. */
    uint32_t vertices;
    int32_t (*position)[4];
    int32_t (*old)[4];  /* where it was before the latest odd step; where alive, in even steps */
    float (*clip)[4];   /* between transform and quantize */
    int64_t (*sum)[4];  /* T: over its half-edges v -> w: w + F; on a crease: a + b; odd steps */
    int64_t (*ring)[4]; /* with limit: over its half-edges: 4a + b; on a crease: a + b */
    uint8_t *valence;   /* how many those are; it never changes while all its faces are active */
    uint8_t *mark;      /* of this generation's faces; MARK_ACTIVE wherever there is one */
    uint8_t *sent;      /* 1: is in the output, and stays where it is */
    uint8_t *stays;     /* sharpness that makes it stay where it is, and */
    uint8_t *crease;    /* sharpness that keeps it on a crease, while they are above the level */

    /* What the stages leave for each other, per face of this generation */
    int32_t (*point)[4]; /* face point (odd step) or inherited edge point (even step) */
    uint8_t *face_mark;
    uint8_t *decision; /* FACE_SELECTED | FACE_REFINED */
    uint32_t *number;  /* of the new vertex, where refined */
    uint32_t selected, refined;
    uint64_t refined_sides; /* of all refined faces, a boundary side twice in odd steps and not at
                               all in even ones: their children are half as many at most */
    bool last;              /* this step's children are final: they leave at once */
    bool finish;            /* nothing is refined any more: all active faces leave */

    /* The next generation in the making; golden.c swaps it in */
    uint32_t *child; /* per half-edge: the first of its two; HS_BORDER where its edge is kept,
                        BOUNDARY_TWIN where a half-quad's boundary edge ends */
    uint32_t *next_origin, *next_twin;
    uint8_t *next_candidate, *next_forced, *next_sharp;
    uint32_t next_faces, next_boundary;

    /* Output */
    hs_packet *out;
    double unit;          /* 2^(E-30) */
    size_t group;         /* word of the vertex group that is still open, 0 if none is */
    uint32_t group_count; /* vertices in it */
    uint32_t vertices_sent, faces_sent, triangles_sent;
    uint32_t at_level;   /* with limit: vertices sent where their level has them */
    hs_generation count; /* of this generation */

    size_t vertex_room, ring_room, face_room, halfedge_room; /* elements allocated */
    bool exhausted; /* an allocation failed; what follows is void */
} hs_state;

/* Makes room for this many elements, keeping what is there. False (and s->exhausted) if there is
 * no memory. golden.c. */
bool hs_state_reserve(hs_state *s, size_t vertices, size_t faces, size_t halfedges);

/* Looks at a view while golden refines it, without changing what comes out: for the tests of the
 * invariants, and for measurements. Each function may be NULL; context is handed to both. */
typedef struct hs_observer {
    void *context;
    /* Whole levels at a time will do: then uniform runs may pass by odd generations. */
    bool levels;
    /* The generation's active mesh is complete; no stage has begun to work on it. */
    void (*entered)(void *context, const hs_state *s);
    /* Marks, face points and decisions are known; no vertex has moved, nothing was sent. If
     * s->finish, guard may not have run: no face is refined, whatever the decisions say. */
    void (*decided)(void *context, const hs_state *s);
    /* Vertices have moved, and those that leave have left. */
    void (*smoothed)(void *context, const hs_state *s);
    /* Children are numbered and made, final faces have left; the generation is still this one. */
    void (*divided)(void *context, const hs_state *s);
} hs_observer;

/* Has all later runs of the context observed; NULL: by nobody. Keeps a copy. */
void hs_golden_observe(hs_golden *golden, const hs_observer *observer);

/* The context's state: of the run under way, or what the last one left. */
const hs_state *hs_golden_state(const hs_golden *golden);

/* Has later runs mark faces as the RTL does, in uniform runs too. */
void hs_golden_mark_always(hs_golden *golden, bool always);

/* The stages. receive and transform set status and error_position where the packet is at fault. */
void hs_stage_receive(hs_state *s, const hs_packet *in);
bool hs_stage_transform(hs_state *s, uint32_t vertex, const float position[4], uint32_t *row);
void hs_stage_quantize(hs_state *s);
void hs_stage_classify(hs_state *s);
void hs_classify_plain_quads(hs_state *s);
void hs_stage_select(hs_state *s);
void hs_stage_guard(hs_state *s);
void hs_stage_smooth(hs_state *s);
void hs_stage_split(hs_state *s);
void hs_split_plain(hs_state *s);

/* Two steps in one go (level_plain.c), where they fit in: the next even generation is ready to be
 * entered, and *moved vertices have moved. False if memory is exhausted. */
bool hs_level_fits(const hs_state *s);
bool hs_level_plain(hs_state *s, uint32_t *moved);

/* The emit stage, an operation at a time. */
void hs_emit_header(hs_state *s);
void hs_emit_vertex(hs_state *s, uint32_t vertex, const int32_t position[4]);
void hs_emit_face(hs_state *s, const uint32_t *vertex, uint32_t sides, uint32_t generation,
                  bool candidate);
void hs_emit_trailer(hs_state *s);

static inline uint32_t hs_face_first(const hs_state *s, uint32_t f) {
    return s->generation ? 4 * f : s->first[f];
}

/* True for the faces of odd generations that a boundary edge was made into. */
static inline bool hs_is_half(const hs_state *s, uint32_t f) {
    return (s->generation & 1) && s->twin[4 * f + 2] == BOUNDARY_TWIN;
}

static inline uint32_t hs_face_sides(const hs_state *s, uint32_t f) {
    return s->generation ? (hs_is_half(s, f) ? 3 : 4) : s->first[f + 1] - s->first[f];
}

/* True if what has this sharpness is sharp at a Catmull-Clark level. */
static inline bool hs_is_sharp(uint8_t sharpness, uint32_t level) {
    return sharpness == HS_SHARP_INFINITE || sharpness > level;
}

/* The level of which positions are at this generation: behind an odd step, the next one. */
static inline uint32_t hs_level(const hs_state *s) {
    return (s->generation + 1) / 2;
}

/* Which mask a vertex has at that level. */
typedef enum hs_kind { KIND_SMOOTH, KIND_CREASE, KIND_STAYS } hs_kind;

static inline hs_kind hs_vertex_kind(const hs_state *s, uint32_t v) {
    if (hs_is_sharp(s->stays[v], hs_level(s))) return KIND_STAYS;
    return hs_is_sharp(s->crease[v], hs_level(s)) ? KIND_CREASE : KIND_SMOOTH;
}

/* All around the vertex goes on. What was sent was held once, and stays: no face that has left may
 * be pulled at a corner. sent: as it was before this generation's smooth. */
static inline bool hs_is_free(const hs_state *s, const uint8_t *sent, uint32_t v) {
    return !s->finish && !(s->mark[v] & (MARK_HELD | MARK_BORDER)) && !sent[v];
}

/* A vertex of valence 1, which only a face with a vertex twice can have, stays because the mask is
 * no average there. */
static inline bool hs_may_move(const hs_state *s, const uint8_t *sent, uint32_t v) {
    return hs_is_free(s, sent, v) && (s->valence[v] > 1 || hs_vertex_kind(s, v) == KIND_CREASE) &&
           hs_vertex_kind(s, v) != KIND_STAYS;
}

/* The face of a half-edge, such as a twin that exists. */
static inline uint32_t hs_face_of(const hs_state *s, uint32_t h) {
    return s->generation ? h >> 2 : s->face[h];
}

/* True if step g -> g+1 is an odd one: it makes face and edge points and moves vertices. */
static inline bool hs_odd_step(const hs_state *s) {
    return !(s->generation & 1);
}

#endif
