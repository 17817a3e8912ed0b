/* SPDX-License-Identifier: Apache-2.0
 *
 * Greedy: a change that keeps the failure is kept, and everything is tried again until nothing more
 * can be changed. Faces and vertices go in halves, quarters, eighths, down to single ones.
 */
#include "campaign_shrink.h"

#include <time.h>

typedef struct shrinker {
    checker *checker;
    campaign_case *best;
    const char *failed; /* the check that has to fail */
    char text[sizeof((checker *)0)->text];
    uint32_t tried;
    clock_t end;  /* of processor time, so that a busy machine changes nothing */
    bool changed; /* since the round began */
} shrinker;

/* The case in the making: a copy of the best one, with one change. */
static campaign_case tried_case;

bool campaign_check(checker *c, const campaign_case *which) {
    static hs_packet packet;
    hs_limits limits;
    uint32_t wanted;
    hs_error err;
    c->failed = NULL;
    if (!campaign_packet(which, &packet, &limits, &wanted, &err)) return true;
    return checker_check(c, &packet, limits, which->stalls, wanted);
}

static bool out_of_time(const shrinker *s) {
    return clock() >= s->end;
}

static campaign_case *change(const shrinker *s) {
    tried_case = *s->best;
    return &tried_case;
}

/* Keeps tried_case if it fails as the first one did. */
static bool try_change(shrinker *s) {
    if (out_of_time(s)) return false;
    s->tried++;
    if (campaign_check(s->checker, &tried_case) || s->checker->failed != s->failed) return false;
    memcpy(s->text, s->checker->text, sizeof s->text);
    *s->best = tried_case;
    s->changed = true;
    return true;
}

/* --- Everything but the mesh --------------------------------------------------------------------
 */

static void drop_fault(shrinker *s) {
    if (!s->best->fault) return;
    change(s)->fault = HS_STATUS_OK;
    try_change(s);
}

static void drop_stalls(shrinker *s) {
    const hs_stalls stalls = s->best->stalls;
    if (stalls.input) {
        change(s)->stalls.input = 0;
        if (!try_change(s)) {
            change(s)->stalls.input = 50;
            if (stalls.input != 50) try_change(s);
        }
    }
    if (stalls.output) {
        change(s)->stalls.output = 0;
        if (!try_change(s)) {
            change(s)->stalls.output = 50;
            if (stalls.output != 50) try_change(s);
        }
    }
    if (stalls.seed > 1) {
        change(s)->stalls.seed = 1;
        try_change(s);
    }
}

static void drop_limits(shrinker *s) {
    if (s->best->limits.vertices != HS_DEFAULT_LIMITS.vertices) {
        change(s)->limits.vertices = HS_DEFAULT_LIMITS.vertices;
        try_change(s);
    }
    if (s->best->limits.quads != HS_DEFAULT_LIMITS.quads) {
        change(s)->limits.quads = HS_DEFAULT_LIMITS.quads;
        try_change(s);
    }
    if (s->best->number) {
        change(s)->number = 0;
        try_change(s);
    }
}

/* To 0, or as far as it goes; best: of *s->best. */
static void lower_depth(shrinker *s, const uint8_t *best, uint8_t *tried) {
    for (uint32_t depth = 0; depth < *best; depth++) {
        change(s);
        *tried = (uint8_t)depth;
        if (try_change(s)) return;
    }
}

static void simplify_settings(shrinker *s) {
    hs_settings *best = &s->best->settings, *tried = &tried_case.settings;
    if (best->limit) {
        change(s);
        tried->limit = false;
        try_change(s);
    }
    if (best->min_edge || best->width || best->height) {
        change(s);
        tried->min_edge = tried->width = tried->height = 0;
        try_change(s);
    }
    if (!best->guard && !best->uniform) {
        change(s);
        tried->guard = true;
        try_change(s);
    }
    if (best->boundary != HS_BOUNDARY_KEPT) {
        change(s);
        tried->boundary = HS_BOUNDARY_KEPT;
        try_change(s);
    }
    if (best->uniform) {
        change(s);
        *tried = (hs_settings){.guard = true,
                               .limit = best->limit,
                               .boundary = best->boundary,
                               .front_depth = best->uniform_depth,
                               .silhouette_depth = best->uniform_depth};
        try_change(s);
    }
    lower_depth(s, &best->uniform_depth, &tried->uniform_depth);
    lower_depth(s, &best->front_depth, &tried->front_depth);
    lower_depth(s, &best->silhouette_depth, &tried->silhouette_depth);
}

/* --- Tags and forced depths ---------------------------------------------------------------------
 */

static void drop_tags(shrinker *s) {
    if (s->best->shape.tags == 0) return;
    change(s)->shape.tags = 0;
    if (try_change(s)) return;
    for (uint32_t t = s->best->shape.tags; t-- > 0;) {
        polygons *p = &change(s)->shape;
        p->tag[t] = p->tag[--p->tags];
        try_change(s);
    }
}

static void drop_forced(shrinker *s) {
    bool any = false;
    for (uint32_t f = 0; f < s->best->shape.faces; f++)
        any |= s->best->shape.forced[f] > 0;
    if (!any) return;
    memset(change(s)->shape.forced, 0, sizeof tried_case.shape.forced);
    if (try_change(s)) return;
    for (uint32_t f = 0; f < s->best->shape.faces; f++)
        lower_depth(s, &s->best->shape.forced[f], &tried_case.shape.forced[f]);
}

/* --- Faces and vertices -------------------------------------------------------------------------
 */

static void drop_faces(shrinker *s) {
    static bool keep[POLYGONS_FACES];
    for (uint32_t size = (s->best->shape.faces + 1) / 2; size > 0; size /= 2)
        for (uint32_t first = 0; first < s->best->shape.faces && !out_of_time(s);) {
            for (uint32_t f = 0; f < s->best->shape.faces; f++)
                keep[f] = f < first || f >= first + size;
            /* What is left moves up when they are gone. */
            if (!polygons_keep(&change(s)->shape, keep) || !try_change(s)) first += size;
        }
}

static void drop_vertices(shrinker *s) {
    for (uint32_t size = (s->best->shape.vertices + 1) / 2; size > 0; size /= 2)
        for (uint32_t first = 0; first < s->best->shape.vertices && !out_of_time(s);)
            if (!polygons_drop_vertices(&change(s)->shape, first, size) || !try_change(s))
                first += size;
}

static void collapse_edges(shrinker *s) {
    for (uint32_t f = 0; f < s->best->shape.faces; f++)
        for (uint32_t i = 0; f < s->best->shape.faces && i < s->best->shape.sides[f]; i++) {
            if (out_of_time(s)) return;
            polygons *p = &change(s)->shape;
            const uint32_t *corner = p->corner + polygons_first(p, f);
            if (polygons_collapse(p, corner[i], corner[(i + 1) % p->sides[f]])) try_change(s);
        }
}

static void merge_faces(shrinker *s) {
    for (uint32_t f = 0; f < s->best->shape.faces; f++)
        for (uint32_t i = 0; f < s->best->shape.faces && i < s->best->shape.sides[f]; i++) {
            if (out_of_time(s)) return;
            if (polygons_merge(&change(s)->shape, f, i)) try_change(s);
        }
}

/* --- Numbers ------------------------------------------------------------------------------------
 */

/* Simpler numbers than x, the simplest first; how many. */
static uint32_t simpler(float x, float out[5]) {
    const float candidate[5] = {0, 1, -1, roundf(x), roundf(x * 8) / 8};
    uint32_t count = 0;
    for (int i = 0; i < 5; i++) {
        if (x == candidate[i] && !(signbit(x) && !signbit(candidate[i]))) break;
        if (isfinite(candidate[i])) out[count++] = candidate[i];
    }
    return count;
}

static void simplify_number(shrinker *s, const float *best, float *tried) {
    float candidate[5];
    const uint32_t count = simpler(*best, candidate);
    for (uint32_t i = 0; i < count; i++) {
        change(s);
        *tried = candidate[i];
        if (try_change(s)) return;
    }
}

static void simplify_view(shrinker *s) {
    if (memcmp(s->best->matrix, identity, sizeof identity) == 0) return;
    memcpy(change(s)->matrix, identity, sizeof identity);
    if (try_change(s)) return;
    for (int i = 0; i < 16; i++)
        simplify_number(s, &s->best->matrix[i], &tried_case.matrix[i]);
}

/* All at once, then one by one. */
static void simplify_coordinates(shrinker *s) {
    polygons *p = &change(s)->shape;
    bool other = false;
    for (uint32_t v = 0; v < p->vertices; v++) {
        const float simple[4] = {roundf(p->position[v][0]), roundf(p->position[v][1]),
                                 roundf(p->position[v][2]), 1};
        other |= memcmp(p->position[v], simple, sizeof simple) != 0;
        memcpy(p->position[v], simple, sizeof simple);
    }
    if (other) try_change(s);
    for (uint32_t v = 0; v < s->best->shape.vertices; v++)
        for (int k = 0; k < 4 && !out_of_time(s); k++) {
            if (k == 3 && s->best->shape.position[v][3] == 1) continue;
            simplify_number(s, &s->best->shape.position[v][k], &tried_case.shape.position[v][k]);
        }
}

/* ------------------------------------------------------------------------------------------------
 */

uint32_t campaign_shrink(checker *c, campaign_case *which, uint32_t seconds) {
    shrinker s = {.checker = c,
                  .best = which,
                  .failed = c->failed,
                  .end = clock() + (clock_t)seconds * CLOCKS_PER_SEC,
                  .changed = true};
    memcpy(s.text, c->text, sizeof s.text);
    const tally tally = c->tally;
    while (s.changed && !out_of_time(&s)) {
        s.changed = false;
        drop_fault(&s);
        drop_stalls(&s);
        drop_limits(&s);
        simplify_settings(&s);
        drop_faces(&s);
        drop_vertices(&s);
        merge_faces(&s);
        collapse_edges(&s);
        drop_tags(&s);
        drop_forced(&s);
        simplify_view(&s);
        simplify_coordinates(&s);
    }
    c->tally = tally;
    c->failed = s.failed;
    memcpy(c->text, s.text, sizeof s.text);
    return s.tried;
}
