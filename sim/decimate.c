/* SPDX-License-Identifier: Apache-2.0
 *
 * 1. Each vertex has a cell: three coordinates of 20 bits, one number. Sorted, equal ones are
 *    neighbours, and each run of them is a vertex of the result.
 * 2. A face's corners become those; one that follows itself is dropped, and so is a face that names
 *    a vertex twice then, or has fewer than three.
 * 3. The number of cells along the longest side is found by bisection.
 */
#include "decimate.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "definitions.h"

enum { COARSEST = 1, FINEST = 1 << 20, MOST_SIDES = 255 };

typedef struct place {
    uint64_t cell;
    uint32_t vertex;
} place;

typedef struct work {
    uint32_t vertices, faces;
    const double *position;
    const uint32_t *first, *corner;
    double low[3], side; /* of the box: lower corner, longest side */
    place *place;
    uint32_t *target; /* per vertex: the vertex that it becomes */
} work;

static void measure(work *w) {
    double high[3];
    for (int k = 0; k < 3; k++) {
        w->low[k] = INFINITY;
        high[k] = -INFINITY;
    }
    for (size_t i = 0; i < 3 * (size_t)w->vertices; i++) {
        w->low[i % 3] = fmin(w->low[i % 3], w->position[i]);
        high[i % 3] = fmax(high[i % 3], w->position[i]);
    }
    w->side = 0;
    for (int k = 0; k < 3; k++)
        w->side = fmax(w->side, high[k] - w->low[k]);
}

static int by_cell(const void *a, const void *b) {
    const place *p = a, *q = b;
    if (p->cell != q->cell) return p->cell < q->cell ? -1 : 1;
    return p->vertex < q->vertex ? -1 : 1;
}

/* Returns how many vertices there are then. */
static uint32_t cluster(work *w, uint32_t cells) {
    const double scale = w->side > 0 ? cells / w->side : 0;
    for (uint32_t v = 0; v < w->vertices; v++) {
        uint64_t cell = 0;
        for (int k = 0; k < 3; k++) {
            const double at = (w->position[3 * (size_t)v + (size_t)k] - w->low[k]) * scale;
            const uint32_t i = at >= cells ? cells - 1 : (uint32_t)at;
            cell = cell << 20 | i;
        }
        w->place[v] = (place){cell, v};
    }
    qsort(w->place, w->vertices, sizeof *w->place, by_cell);
    uint32_t count = 0;
    for (uint32_t i = 0; i < w->vertices; i++) {
        if (i && w->place[i].cell != w->place[i - 1].cell) count++;
        w->target[w->place[i].vertex] = count;
    }
    return w->vertices ? count + 1 : 0;
}

/* A face's corners behind clustering; 0: it vanishes. */
static uint32_t collapse(const work *w, uint32_t face, uint32_t corner[MOST_SIDES]) {
    uint32_t count = 0;
    for (uint32_t i = w->first[face]; i < w->first[face + 1]; i++) {
        const uint32_t v = w->target[w->corner[i]];
        if (count && corner[count - 1] == v) continue;
        if (count == MOST_SIDES) return 0;
        corner[count++] = v;
    }
    if (count > 1 && corner[count - 1] == corner[0]) count--;
    for (uint32_t i = 0; i < count; i++)
        for (uint32_t j = i + 1; j < count; j++)
            if (corner[i] == corner[j]) return 0;
    return count < 3 ? 0 : count;
}

static uint32_t remaining(const work *w) {
    uint32_t corner[MOST_SIDES], count = 0;
    for (uint32_t f = 0; f < w->faces; f++)
        count += collapse(w, f, corner) > 0;
    return count;
}

static void take(hs_decimated *d, const work *w) {
    uint32_t corner[MOST_SIDES], *sharing = d->source; /* lent: a count per vertex */
    memset(sharing, 0, w->vertices * sizeof *sharing);
    for (uint32_t v = 0; v < w->vertices; v++) {
        const uint32_t t = w->target[v];
        sharing[t]++;
        for (size_t k = 0; k < 3; k++)
            d->position[3 * (size_t)t + k] += w->position[3 * (size_t)v + k];
    }
    for (uint32_t t = 0; t < d->vertices; t++)
        for (size_t k = 0; k < 3; k++)
            d->position[3 * (size_t)t + k] /= sharing[t];
    for (uint32_t f = 0; f < w->faces; f++) {
        const uint32_t count = collapse(w, f, corner);
        if (!count) continue;
        memcpy(&d->corner[d->first[d->faces]], corner, count * sizeof *corner);
        d->source[d->faces++] = f;
        d->first[d->faces] = d->first[d->faces - 1] + count;
    }
}

static bool exhausted(uint32_t faces, hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory to decimate %u faces", faces);
}

static bool reserve(hs_decimated *d, work *w) {
    const size_t corners = w->first[w->faces],
                 most = w->vertices > w->faces ? w->vertices : w->faces;
    d->position = calloc(3 * (size_t)w->vertices + 1, sizeof *d->position);
    d->first = calloc((size_t)w->faces + 1, sizeof *d->first);
    d->corner = malloc((corners + 1) * sizeof *d->corner);
    d->source = malloc((most + 1) * sizeof *d->source);
    w->place = malloc(((size_t)w->vertices + 1) * sizeof *w->place);
    w->target = malloc(((size_t)w->vertices + 1) * sizeof *w->target);
    return d->position && d->first && d->corner && d->source && w->place && w->target;
}

static void keep_all(hs_decimated *d, const work *w) {
    d->vertices = w->vertices;
    d->faces = w->faces;
    memcpy(d->position, w->position, 3 * (size_t)w->vertices * sizeof *d->position);
    memcpy(d->first, w->first, ((size_t)w->faces + 1) * sizeof *d->first);
    memcpy(d->corner, w->corner, w->first[w->faces] * sizeof *d->corner);
    for (uint32_t f = 0; f < w->faces; f++)
        d->source[f] = f;
}

bool hs_decimate(hs_decimated *fewer, uint32_t vertices, const double *position, uint32_t faces,
                 const uint32_t *first, const uint32_t *corner, uint32_t most, hs_error *err) {
    *fewer = (hs_decimated){0};
    work w = {.vertices = vertices,
              .faces = faces,
              .position = position,
              .first = first,
              .corner = corner};
    const bool good = reserve(fewer, &w);
    if (good && faces <= most) {
        keep_all(fewer, &w);
    } else if (good) {
        measure(&w);
        uint32_t low = COARSEST, high = FINEST; /* a single cell leaves nothing */
        while (high - low > low / 64 + 1) {
            const uint32_t middle = low + (high - low) / 2;
            cluster(&w, middle);
            if (remaining(&w) <= most)
                low = middle;
            else
                high = middle;
        }
        fewer->vertices = cluster(&w, low);
        take(fewer, &w);
    }
    free(w.place);
    free(w.target);
    if (good) return true;
    hs_decimated_free(fewer);
    return exhausted(faces, err);
}

void hs_decimated_free(hs_decimated *fewer) {
    free(fewer->position);
    free(fewer->first);
    free(fewer->corner);
    free(fewer->source);
    *fewer = (hs_decimated){0};
}
