/* SPDX-License-Identifier: Apache-2.0
 *
 * random: a closed body of random faces, for tests.
 *
 * 1. Start from a ball (even seeds) or a torus (odd ones) of about as many quads as asked for.
 * 2. Apply random local operations: merge two faces, split a face by a diagonal, both in turn (a
 *    flip), poke a face, split a vertex. Each is made only if it keeps the body an oriented
 *    2-manifold with valences 3 to 12 and at most 12 sides:
 *      - a merge takes away one edge, and only if the two faces share nothing else, so that no
 *        face names a point twice, and both ends have valence 4 or more;
 *      - a split adds one edge, and only between points that have none between them yet;
 *      - a vertex split cuts the fan of faces around a point in two, with a new edge between.
 * 3. Shake the points a little.
 */
#include <math.h>
#include <stdlib.h>

#include "shape_kit.h"

enum { MIN_VALENCE = 3, MAX_VALENCE = 12, NO_FACE = -1 };

/* The cage with what local operations need to know: which face has the edge a -> b (a hash table
 * with linear probing; taken edges stay as NO_FACE), and how many faces meet at a point. */
typedef struct web {
    hs_cage *cage;
    uint64_t random;
    uint32_t live;  /* faces not deleted */
    uint64_t *edge; /* a << 32 | b, plus 1; 0: free */
    int64_t *owner; /* the face, or NO_FACE */
    size_t mask, used;
    uint32_t *valence; /* by point; room for point_limit */
    uint32_t point_limit;
} web;

/* --- Which face has the edge a -> b ---------------------------------------------------------- */

static size_t find_slot(const web *w, uint64_t key) {
    uint64_t state = key;
    size_t slot = (size_t)hs_random_next(&state) & w->mask;
    while (w->edge[slot] && w->edge[slot] != key)
        slot = (slot + 1) & w->mask;
    return slot;
}

static uint64_t edge_key(uint32_t a, uint32_t b) {
    return ((uint64_t)a << 32 | b) + 1;
}

static int64_t find_face(const web *w, uint32_t a, uint32_t b) {
    size_t slot = find_slot(w, edge_key(a, b));
    return w->edge[slot] ? w->owner[slot] : NO_FACE;
}

static void grow_table(web *w) {
    web old = *w;
    w->mask = 2 * old.mask + 1;
    w->used = 0;
    w->edge = calloc(w->mask + 1, sizeof *w->edge);
    w->owner = calloc(w->mask + 1, sizeof *w->owner);
    if (!w->edge || !w->owner) {
        free(w->edge);
        free(w->owner);
        *w = old;
        w->cage->failed = true;
        return;
    }
    for (size_t i = 0; i <= old.mask; i++)
        if (old.edge[i] && old.owner[i] != NO_FACE) {
            size_t slot = find_slot(w, old.edge[i]);
            w->edge[slot] = old.edge[i];
            w->owner[slot] = old.owner[i];
            w->used++;
        }
    free(old.edge);
    free(old.owner);
}

/* Enters (sign 1) or takes out (sign -1) a face's edges and corners. */
static void link_face(web *w, uint32_t face, int sign) {
    const hs_cage_face *f = &w->cage->face[face];
    for (uint32_t c = 0; c < f->sides && !w->cage->failed; c++) {
        if (2 * w->used > w->mask) grow_table(w);
        uint32_t a = f->corner[c], b = f->corner[(c + 1) % f->sides];
        size_t slot = find_slot(w, edge_key(a, b));
        w->used += w->edge[slot] == 0;
        w->edge[slot] = edge_key(a, b);
        w->owner[slot] = sign > 0 ? (int64_t)face : NO_FACE;
        w->valence[a] += (uint32_t)sign;
    }
}

/* --- Local operations: each returns whether it was made -------------------------------------- */

static bool merge_across(web *w, uint32_t face, uint32_t corner) {
    const hs_cage_face *f = &w->cage->face[face];
    uint32_t a = f->corner[corner], b = f->corner[(corner + 1) % f->sides];
    uint32_t other = (uint32_t)find_face(w, b, a);
    if (w->valence[a] <= MIN_VALENCE || w->valence[b] <= MIN_VALENCE) return false;
    link_face(w, face, -1);
    link_face(w, other, -1);
    bool made = hs_cage_merge(w->cage, face, other);
    link_face(w, face, 1);
    link_face(w, other, 1); /* which has no sides left if it was merged */
    w->live -= made;
    return made;
}

static bool split_face(web *w, uint32_t face, uint32_t i, uint32_t j) {
    const hs_cage_face *f = &w->cage->face[face];
    uint32_t a = f->corner[i], b = f->corner[j];
    if (j < i + 2 || j + 2 > i + f->sides || w->valence[a] >= MAX_VALENCE ||
        w->valence[b] >= MAX_VALENCE || find_face(w, a, b) != NO_FACE ||
        find_face(w, b, a) != NO_FACE)
        return false;
    link_face(w, face, -1);
    uint32_t cut = hs_cage_split(w->cage, face, i, j);
    link_face(w, face, 1);
    link_face(w, cut, 1);
    w->live++;
    return true;
}

static bool split_anywhere(web *w, uint32_t face) {
    uint32_t sides = w->cage->face[face].sides;
    uint32_t i = hs_random_below(&w->random, sides), j = hs_random_below(&w->random, sides);
    return split_face(w, face, i < j ? i : j, i < j ? j : i);
}

static bool poke_face(web *w, uint32_t face) {
    hs_cage_face f = w->cage->face[face];
    for (uint32_t c = 0; c < f.sides; c++)
        if (w->valence[f.corner[c]] >= MAX_VALENCE) return false;
    if (w->cage->points == w->point_limit) return false;
    link_face(w, face, -1);
    uint32_t first = w->cage->faces;
    hs_cage_poke(w->cage, face);
    link_face(w, face, 1);
    for (uint32_t i = first; i < w->cage->faces; i++)
        link_face(w, i, 1);
    w->live += f.sides - 1;
    return true;
}

static uint32_t corner_of(const hs_cage_face *f, uint32_t point) {
    uint32_t c = 0;
    while (f->corner[c] != point)
        c++;
    return c;
}

static void insert_corner(hs_cage_face *f, uint32_t at, uint32_t point) {
    for (uint32_t c = f->sides++; c > at; c--)
        f->corner[c] = f->corner[c - 1];
    f->corner[at] = point;
}

/* Around point p the faces fan[0] .. fan[n-1] follow each other across p's outgoing edges. Those
 * from 1 to s go to a new point; fan[0] and fan[s+1] get the new edge. */
static bool split_vertex(web *w, uint32_t face, uint32_t corner) {
    hs_cage *cage = w->cage;
    uint32_t p = cage->face[face].corner[corner], n = w->valence[p], fan[MAX_VALENCE];
    if (n < 4 || cage->points == w->point_limit) return false;
    fan[0] = face;
    for (uint32_t i = 1; i < n; i++) {
        const hs_cage_face *f = &cage->face[fan[i - 1]];
        uint32_t to = f->corner[(corner_of(f, p) + 1) % f->sides];
        fan[i] = (uint32_t)find_face(w, to, p);
    }
    uint32_t s = 1 + hs_random_below(&w->random, n - 3);
    if (cage->face[fan[0]].sides == HS_CAGE_SIDES || cage->face[fan[s + 1]].sides == HS_CAGE_SIDES)
        return false;
    hs_vec target = {0, 0, 0};
    for (uint32_t i = 1; i <= s; i++)
        target = hs_vec_along(target, hs_cage_centre(cage, fan[i]), 1.0 / s);
    hs_vec old = cage->point[p];
    uint32_t q = hs_cage_point(cage, hs_vec_along(old, hs_vec_sub(target, old), 0.5));
    for (uint32_t i = 0; i <= s + 1; i++)
        link_face(w, fan[i], -1);
    for (uint32_t i = 1; i <= s; i++) {
        hs_cage_face *f = &cage->face[fan[i]];
        f->corner[corner_of(f, p)] = q;
    }
    hs_cage_face *before = &cage->face[fan[0]], *after = &cage->face[fan[s + 1]];
    insert_corner(before, corner_of(before, p) + 1, q);
    insert_corner(after, corner_of(after, p), q);
    for (uint32_t i = 0; i <= s + 1; i++)
        link_face(w, fan[i], 1);
    return true;
}

/* One random operation; the number of faces is steered back to size when it strays. */
static bool change(web *w, uint32_t size) {
    enum { MERGE, SPLIT, FLIP, POKE, SPLIT_VERTEX, KINDS };
    uint32_t face = hs_random_below(&w->random, w->cage->faces);
    uint32_t kind = hs_random_below(&w->random, KINDS);
    uint32_t sides = w->cage->face[face].sides;
    if (sides == 0) return false;
    if (w->live > size + size / 20 && (kind == SPLIT || kind == POKE)) kind = MERGE;
    if (w->cage->points > w->live && (kind == POKE || kind == SPLIT_VERTEX))
        kind = FLIP; /* no operation takes points away, and valences would all sink to 3 */
    if (w->live < size - size / 20 && (kind == MERGE || kind == FLIP)) kind = SPLIT;
    uint32_t corner = hs_random_below(&w->random, sides);
    switch (kind) {
    case MERGE:
        return merge_across(w, face, corner);
    case SPLIT:
        return split_anywhere(w, face);
    case FLIP:
        return merge_across(w, face, corner) && split_anywhere(w, face);
    case POKE:
        return poke_face(w, face);
    default:
        return split_vertex(w, face, corner);
    }
}

/* --- The shape ------------------------------------------------------------------------------- */

static void start_body(hs_cage *cage, uint32_t size, bool torus) {
    uint32_t n = 2;
    if (torus) {
        for (n = 6; (n + 1) * (n + 1) <= 2 * size;)
            n++;
        hs_shape_torus(cage, n, 0);
    } else {
        while (6 * (n + 1) * (n + 1) <= size)
            n++;
        hs_cage_box(cage, (uint32_t[3]){n, n, n});
        for (uint32_t v = 0; v < cage->points; v++)
            cage->point[v] = hs_ball_from_cube(cage->point[v]);
    }
}

/* By up to a tenth of the typical distance from a face's centre to its corners. */
static void shake_points(web *w) {
    hs_cage *cage = w->cage;
    double sum = 0, corners = 0;
    for (uint32_t f = 0; f < cage->faces; f++)
        for (uint32_t c = 0; c < cage->face[f].sides; c++) {
            hs_vec d = hs_vec_sub(cage->point[cage->face[f].corner[c]], hs_cage_centre(cage, f));
            sum += hs_vec_dot(d, d);
            corners++;
        }
    double reach = 0.1 * sqrt(sum / corners);
    for (uint32_t v = 0; v < cage->points; v++) {
        double x = hs_random_signed(&w->random), y = hs_random_signed(&w->random);
        double z = hs_random_signed(&w->random);
        cage->point[v] = hs_vec_along(cage->point[v], hs_vec_of(x, y, z), reach);
    }
}

void hs_shape_random(hs_cage *cage, uint32_t size, uint32_t seed) {
    start_body(cage, size, seed % 2);
    web w = {.cage = cage, .random = seed, .mask = 1023, .point_limit = cage->points + 4 * size};
    w.edge = calloc(w.mask + 1, sizeof *w.edge);
    w.owner = calloc(w.mask + 1, sizeof *w.owner);
    w.valence = calloc(w.point_limit, sizeof *w.valence);
    if (!w.edge || !w.owner || !w.valence) cage->failed = true;
    for (uint32_t f = 0; f < cage->faces && !cage->failed; f++, w.live++)
        link_face(&w, f, 1);
    /* Twice as many changes as faces leave little of the start. Not every try succeeds. */
    for (uint32_t made = 0, tries = 0; made < 2 * size && tries < 50 * size && !cage->failed;
         tries++)
        made += change(&w, size);
    if (!cage->failed) shake_points(&w);
    free(w.edge);
    free(w.owner);
    free(w.valence);
}
