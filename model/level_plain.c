/* SPDX-License-Identifier: Apache-2.0
 *
 * A whole Catmull-Clark level, two steps, in one go: for uniform runs of closed meshes on which
 * nothing is sharp, from the second level on, where nobody looks at the generation between. What
 * comes out is what the stages make in two rounds, numbers and all.
 *
 * The quad that the odd step makes of the edge of h: v -> w and its twin t, in faces with the new
 * vertices F and G, is q = child[h] / 4 with the corners w, F, v, G; its half-edges are 4q to 4q +
 * 3,
 *
 *   w -> F   twin: child[next(h)] + 1        v -> G   twin: child[next(t)] + 1
 *   F -> v   twin: child[prev(h)]            G -> w   twin: child[prev(t)]
 *
 * so that they need not be stored: the even step's children are numbered, and written, from the
 * parents' records alone.
 */
#include "arithmetic.h"
#include "classify.h"
#include "golden_state.h"

/* Face points and sums; the first children of the odd step. */
static void first_step(hs_state *s) {
    const uint32_t faces = s->faces, vertices = s->vertices;
    const uint32_t *origin = s->origin, *twin = s->twin;
    uint32_t *child = s->child, quads = 0;
    int32_t(*position)[4] = s->position;
    int64_t(*sum)[4] = s->sum;
    for (uint32_t f = 0; f < faces; f++) {
        const uint32_t *corner = origin + 4 * (size_t)f;
        hs_int4 p[4];
#pragma GCC unroll 4
        for (int i = 0; i < 4; i++)
            p[i] = hs_load(position[corner[i]]);
        const hs_int4 point = hs_quad_mask(p[0], p[1], p[2], p[3]);
        memcpy(position[vertices + f], &point, sizeof point);
#pragma GCC unroll 4
        for (uint32_t i = 0; i < 4; i++) {
            const uint32_t h = 4 * f + i, t = twin[h];
            add_to_sum(sum[corner[i]], p[(i + 1) % 4], point);
            /* Which one is the lower is as good as random, so no branch hangs on it. */
            const uint32_t lower = h < t, fresh = 4 * quads, known = child[t] + 2;
            child[h] = known ^ ((known ^ fresh) & -lower);
            quads += lower;
        }
    }
}

/* The quad of a lower half-edge h: its edge point, and the children of its four half-edges. */
static inline void second_step_of(hs_state *s, uint32_t h, uint32_t t, uint32_t quad,
                                  uint32_t *count) {
    const uint32_t *origin = s->origin, *child = s->child, vertices = s->vertices;
    uint32_t *grandchild = s->face;
    const uint32_t next_h = (h & ~3u) | ((h + 1) & 3), prev_h = (h & ~3u) | ((h + 3) & 3);
    const uint32_t next_t = (t & ~3u) | ((t + 1) & 3), prev_t = (t & ~3u) | ((t + 3) & 3);
    const uint32_t corner[4] = {origin[next_h], vertices + h / 4, origin[h], vertices + t / 4};
    const uint32_t twin[4] = {child[next_h] + 1, child[prev_h], child[next_t] + 1, child[prev_t]};
    const uint32_t edge = vertices + s->faces + quad;
    int32_t(*position)[4] = s->position;
    const hs_int4 point = hs_quad_mask(hs_load(position[corner[0]]), hs_load(position[corner[1]]),
                                       hs_load(position[corner[2]]), hs_load(position[corner[3]]));
    memcpy(position[edge], &point, sizeof point);
    uint32_t c[4], faces = *count;
#pragma GCC unroll 4
    for (uint32_t j = 0; j < 4; j++) {
        const uint32_t k = 4 * quad + j;
        const uint32_t lower = k < twin[j], fresh = 4 * faces, known = grandchild[twin[j]] + 2;
        c[j] = known ^ ((known ^ fresh) & -lower);
        grandchild[k] = c[j];
        faces += lower;
    }
    *count = faces;
#pragma GCC unroll 4
    for (uint32_t j = 0; j < 4; j++) {
        s->next_origin[c[j]] = corner[(j + 1) % 4];
        s->next_origin[c[j] + 1] = edge;
        s->next_twin[c[j]] = c[(j + 1) % 4] + 1;
        s->next_twin[c[j] + 1] = c[(j + 3) % 4];
    }
}

/* Edge points come from where the vertices stand before they move. */
static void second_step(hs_state *s) {
    uint32_t quad = 0, faces = 0;
    for (uint32_t h = 0; h < 4 * s->faces; h++)
        if (h < s->twin[h]) second_step_of(s, h, s->twin[h], quad++, &faces);
    s->next_faces = faces;
}

static uint32_t move_vertices(hs_state *s) {
    uint32_t moved = 0;
    for (uint32_t v = 0; v < s->vertices; v++) {
        const uint32_t n = s->valence[v];
        int32_t *p = s->position[v];
        if (n < 2) continue; /* isolated, or a vertex that never moves */
        if (n == 4)
            for (int k = 0; k < 4; k++)
                p[k] = hs_vertex_mask(s->sum[v][k], p[k], 4);
        else
            for (int k = 0; k < 4; k++)
                p[k] = hs_vertex_mask(s->sum[v][k], p[k], n);
        moved++;
    }
    return moved;
}

bool hs_level_fits(const hs_state *s) {
    const uint64_t faces = s->faces, vertices = s->vertices;
    return s->settings.uniform && s->plain && s->closed && s->generation >= 2 &&
           !(s->generation & 1) && s->generation + 2 < s->depth && faces > 0 &&
           vertices + 3 * faces <= s->limits.vertices && 4 * faces <= s->limits.quads;
}

bool hs_level_plain(hs_state *s, uint32_t *moved) {
    const uint32_t vertices = s->vertices, born = 3 * s->faces;
    if (!hs_state_reserve(s, (size_t)vertices + born, 4 * (size_t)s->faces, 16 * (size_t)s->faces))
        return false;
    memset(s->sum, 0, vertices * sizeof *s->sum);
    first_step(s);
    second_step(s);
    *moved = move_vertices(s);
    memset(s->valence + vertices, 4, born);
    memset(s->sent + vertices, 0, born);
    memset(s->stays + vertices, 0, born);
    memset(s->crease + vertices, 0, born);
    memset(s->next_candidate, 1, s->next_faces);
    return true;
}
