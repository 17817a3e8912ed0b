/* SPDX-License-Identifier: Apache-2.0
 *
 * The checkers take golden's word for nothing but what they check: they count faces around
 * vertices, number children and follow vertices from generation to generation themselves.
 */
#include "invariants.h"

#include <stdlib.h>
#include <string.h>

static bool differ(hs_error *err, const char *what, uint32_t generation, uint32_t item) {
    return hs_fail(err, HS_EXIT_DIFFERENT, "generation %u: %s %u", generation, what, item);
}

static bool exhausted(hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory to check invariants");
}

/* Replaces *(void **)array by one of count elements; what it held is lost. */
static bool replace(void *array, size_t count, size_t element) {
    void *data;
    memcpy(&data, array, sizeof data);
    free(data);
    data = calloc(count + 1, element);
    memcpy(array, &data, sizeof data);
    return data;
}

/* --- I1: a set of directed edges ----------------------------------------------------------------
 */

typedef struct edge_set {
    uint64_t *slot; /* from << 32 | to, plus 1; 0: free */
    size_t mask;
} edge_set;

static uint64_t *find_edge(const edge_set *set, uint32_t from, uint32_t to) {
    const uint64_t key = ((uint64_t)from << 32 | to) + 1;
    size_t i = (size_t)(key * 0x9e3779b97f4a7c15u >> 20) & set->mask;
    while (set->slot[i] && set->slot[i] != key)
        i = (i + 1) & set->mask;
    return &set->slot[i];
}

static bool has_edge(const edge_set *set, uint32_t from, uint32_t to) {
    return *find_edge(set, from, to) != 0;
}

static uint32_t next_corner(const hs_output *o, uint32_t f, uint32_t i) {
    return o->corner[i + 1 < o->first[f + 1] ? i + 1 : o->first[f]];
}

static bool collect_edges(const hs_output *o, edge_set *set, hs_error *err) {
    for (uint32_t f = 0; f < o->faces; f++) {
        for (uint32_t i = o->first[f]; i < o->first[f + 1]; i++) {
            const uint32_t v = o->number[o->corner[i]], w = o->number[next_corner(o, f, i)];
            uint64_t *slot = find_edge(set, v, w);
            if (*slot) return differ(err, "an edge of two faces: output face", o->generation[f], f);
            *slot = ((uint64_t)v << 32 | w) + 1;
        }
    }
    return true;
}

/* After each vertex of the output the next one along the boundary, NO_VERTEX inside. */
#define NO_VERTEX UINT32_MAX

static bool follow_boundary(const hs_output *o, const hs_mesh *mesh, hs_boundary boundary,
                            const edge_set *set, uint32_t *after, uint32_t numbers, hs_error *err) {
    uint32_t alone = 0;
    memset(after, 0xff, numbers * sizeof *after);
    for (uint32_t f = 0; f < o->faces; f++)
        for (uint32_t i = o->first[f]; i < o->first[f + 1]; i++) {
            const uint32_t v = o->number[o->corner[i]], w = o->number[next_corner(o, f, i)];
            if (has_edge(set, w, v)) continue;
            if (after[v] != NO_VERTEX)
                return differ(err, "two boundaries at a vertex: output face", o->generation[f], f);
            after[v] = w;
            alone++;
        }
    for (uint32_t h = 0; h < mesh->halfedges; h++) {
        if (mesh->twin[h] != HS_BORDER) continue;
        uint32_t v = mesh->origin[h], length = 0;
        do {
            v = v < numbers ? after[v] : NO_VERTEX;
            length++;
        } while (v != NO_VERTEX && v >= mesh->vertices);
        if (v != mesh->origin[hs_next(mesh, h)] || length > alone)
            return differ(err, "boundary edge gone, or inside: half-edge", 0, h);
        if (length > 1 && boundary == HS_BOUNDARY_KEPT)
            return differ(err, "boundary edge not kept: half-edge", 0, h);
        alone -= length;
    }
    if (alone) return differ(err, "edges without a second face:", o->generations, alone);
    return true;
}

bool invariant_conforming(const hs_output *o, const hs_mesh *mesh, hs_boundary boundary,
                          uint64_t *compared, hs_error *err) {
    edge_set set = {.mask = 1};
    uint32_t numbers = 0;
    for (uint32_t v = 0; v < o->vertices; v++)
        if (o->number[v] >= numbers) numbers = o->number[v] + 1;
    while (set.mask < 2 * (size_t)o->corners)
        set.mask = 2 * set.mask + 1;
    set.slot = calloc(set.mask + 1, sizeof *set.slot);
    uint32_t *after = malloc((numbers + (size_t)1) * sizeof *after);
    bool good = set.slot && after;
    if (!good) exhausted(err);
    good = good && collect_edges(o, &set, err) &&
           follow_boundary(o, mesh, boundary, &set, after, numbers, err);
    free(set.slot);
    free(after);
    *compared += o->corners;
    return good;
}

/* --- The uniform run ----------------------------------------------------------------------------
 */

typedef struct recorder {
    uniform_record *record;
    uint32_t last;
    bool exhausted;
} recorder;

/* Whether the edge of a half-edge becomes a face: in an odd step a boundary edge does, too. */
static bool makes_quad(const hs_state *s, uint32_t h) {
    return s->twin[h] != HS_BORDER && (s->twin[h] != BOUNDARY_TWIN || s->generation % 2 == 0);
}

static void record_generation(void *context, const hs_state *s) {
    recorder *r = context;
    if (s->generation > r->last) return;
    uniform_generation *u = &r->record->generation[s->generation];
    if (s->faces > u->faces || s->halfedges > u->halfedges || s->vertices > u->vertices) {
        if (!replace(&u->origin, s->halfedges, sizeof *u->origin) ||
            !replace(&u->quad, s->halfedges, sizeof *u->quad) ||
            !replace(&u->first, s->faces + (size_t)1, sizeof *u->first) ||
            !replace(&u->position, s->vertices, sizeof *u->position) ||
            !replace(&u->faces_around, s->vertices, sizeof *u->faces_around)) {
            r->exhausted = true;
            return;
        }
    }
    u->vertices = s->vertices;
    u->faces = s->faces;
    u->halfedges = s->halfedges;
    r->record->generations = s->generation + 1;
    memcpy(u->position, s->position, s->vertices * sizeof *u->position);
    memset(u->faces_around, 0, s->vertices * sizeof *u->faces_around);

    uint32_t quads = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
        u->first[f] = h0;
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t h = h0 + i, t = s->twin[h], v = s->origin[h];
            u->origin[h] = v;
            u->faces_around[v]++;
            u->quad[h] = !makes_quad(s, h) ? HS_BORDER : h < t ? quads++ : u->quad[t];
        }
    }
    u->first[s->faces] = s->halfedges;
}

bool uniform_record_make(uniform_record *record, hs_golden *golden, const hs_mesh *mesh,
                         const float matrix[16], const hs_settings *settings, hs_error *err) {
    const uint8_t front = settings->front_depth, silhouette = settings->silhouette_depth;
    const hs_settings uniform = {.uniform = true,
                                 .uniform_depth = front > silhouette ? front : silhouette,
                                 .boundary = settings->boundary};
    /* The last step's children go out; nobody looks. */
    recorder r = {.record = record, .last = uniform.uniform_depth - 1u};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    record->generations = 0;
    hs_golden_observe(golden, &(hs_observer){.context = &r, .decided = record_generation});
    bool good = hs_packet_encode(&in, 0, mesh, matrix, &uniform, err) &&
                hs_golden_run(golden, &in, &out, &report, err);
    hs_golden_observe(golden, NULL);
    hs_packet_free(&in);
    hs_packet_free(&out);
    if (good && r.exhausted) good = exhausted(err);
    if (good && report.status != HS_STATUS_OK)
        good = hs_fail(err, HS_EXIT_REFUSED, "uniform run: %s", hs_status_name(report.status));
    return good;
}

void uniform_record_free(uniform_record *record) {
    for (uint32_t g = 0; g < UNIFORM_GENERATIONS; g++) {
        uniform_generation *u = &record->generation[g];
        free(u->origin);
        free(u->quad);
        free(u->first);
        free(u->position);
        free(u->faces_around);
    }
    *record = (uniform_record){0};
}

/* --- I2, I3: a run beside the uniform one -------------------------------------------------------
 */

static bool make_room(invariant_watch *w, size_t vertices, size_t faces) {
    if (vertices > w->vertex_room) {
        uint32_t *vertex = realloc(w->vertex, 2 * vertices * sizeof *vertex);
        if (!vertex) return false;
        w->vertex = vertex;
        w->vertex_room = 2 * vertices;
    }
    if (faces > w->face_room) {
        uint32_t *face = realloc(w->face, 2 * faces * sizeof *face);
        if (!face) return false;
        w->face = face;
        uint32_t *next_face = realloc(w->next_face, 2 * faces * sizeof *next_face);
        if (!next_face) return false;
        w->next_face = next_face;
        w->face_room = 2 * faces;
    }
    return true;
}

static bool is_refined(const hs_state *s, uint32_t f) {
    return !s->finish && (s->decision[f] & FACE_REFINED);
}

/* The half-edge of the uniform run that half-edge i of face f is. */
static uint32_t uniform_halfedge(const invariant_watch *w, const uniform_generation *u, uint32_t f,
                                 uint32_t i) {
    return u->first[w->face[f]] + i;
}

/* The two runs' faces have the same corners: otherwise whatever else is compared means nothing. */
static bool check_correspondence(invariant_watch *w, const hs_state *s,
                                 const uniform_generation *u) {
    for (uint32_t f = 0; f < s->faces; f++) {
        const uint32_t h0 = hs_face_first(s, f), n = hs_face_sides(s, f);
        if (w->face[f] >= u->faces) return differ(&w->error, "no such quad", s->generation, f);
        for (uint32_t i = 0; i < n; i++)
            if (u->origin[uniform_halfedge(w, u, f, i)] != w->vertex[s->origin[h0 + i]])
                return differ(&w->error, "not the uniform run's quad:", s->generation, f);
    }
    return true;
}

/* I2 at every vertex of every selected face, I3 at every vertex of every refined one.
 * refined_around: zeros, per vertex. */
static bool check_vertices(invariant_watch *w, const hs_state *s, const uniform_generation *u,
                           uint16_t *refined_around) {
    for (uint32_t f = 0; f < s->faces; f++)
        for (uint32_t i = 0; i < hs_face_sides(s, f); i++)
            refined_around[s->origin[hs_face_first(s, f) + i]] += is_refined(s, f);
    for (uint32_t f = 0; f < s->faces; f++) {
        for (uint32_t i = 0; is_refined(s, f) && i < hs_face_sides(s, f); i++) {
            const uint32_t v = s->origin[hs_face_first(s, f) + i], uv = w->vertex[v];
            if (s->decision[f] & FACE_SELECTED) {
                if (refined_around[v] != u->faces_around[uv])
                    return differ(&w->error, "I2: not all faces are refined around vertex",
                                  s->generation, v);
                w->rings++;
            }
            if (s->generation % 2 == 0) {
                if (memcmp(s->position[v], u->position[uv], sizeof s->position[v]) != 0)
                    return differ(&w->error, "I3: not where the uniform run has it: vertex",
                                  s->generation, v);
                w->positions++;
            }
        }
    }
    return true;
}

/* Which vertices and quads of the uniform run the next generation's are. */
static void follow(invariant_watch *w, const hs_state *s, const uniform_generation *u) {
    uint32_t quads = 0, created = 0;
    for (uint32_t f = 0; f < s->faces; f++) {
        if (!is_refined(s, f)) continue;
        w->vertex[s->vertices + created++] = u->vertices + w->face[f];
        for (uint32_t i = 0; i < hs_face_sides(s, f); i++) {
            const uint32_t h = hs_face_first(s, f) + i, t = s->twin[h];
            if (makes_quad(s, h) && h < t &&
                (t == BOUNDARY_TWIN || is_refined(s, hs_face_of(s, t))))
                w->next_face[quads++] = u->quad[uniform_halfedge(w, u, f, i)];
        }
    }
    uint32_t *face = w->face;
    w->face = w->next_face;
    w->next_face = face;
}

static void watch_generation(void *context, const hs_state *s) {
    invariant_watch *w = context;
    if (!w->good || s->generation >= w->uniform->generations) return;
    const uniform_generation *u = &w->uniform->generation[s->generation];
    uint16_t *refined_around = calloc(s->vertices, sizeof *refined_around);
    if (!refined_around || !make_room(w, (size_t)s->vertices + s->faces, s->halfedges)) {
        w->good = exhausted(&w->error);
    } else {
        if (s->generation == 0) {
            for (uint32_t v = 0; v < s->vertices; v++)
                w->vertex[v] = v;
            for (uint32_t f = 0; f < s->faces; f++)
                w->face[f] = f;
        }
        w->good = check_correspondence(w, s, u) && check_vertices(w, s, u, refined_around);
        if (w->good) follow(w, s, u);
    }
    free(refined_around);
}

hs_observer invariant_watch_begin(invariant_watch *watch, const uniform_record *uniform) {
    watch->uniform = uniform;
    watch->rings = watch->positions = 0;
    watch->good = true;
    return (hs_observer){.context = watch, .decided = watch_generation};
}

void invariant_watch_free(invariant_watch *watch) {
    free(watch->vertex);
    free(watch->face);
    free(watch->next_face);
    *watch = (invariant_watch){0};
}

/* --- I4: two surfaces of quads -------------------------------------------------------------------
 */

/* A quad, turned so that its positions are the smallest row of numbers that they can be. */
typedef struct quad_key {
    int32_t position[4][4];
    uint32_t corner[4];
} quad_key;

static int by_position(const void *a, const void *b) {
    return memcmp(((const quad_key *)a)->position, ((const quad_key *)b)->position,
                  sizeof((const quad_key *)a)->position);
}

static quad_key *sorted_quads(uint32_t faces, const int32_t (*position)[4],
                              const uint32_t *corner) {
    quad_key *keys = malloc((faces + (size_t)1) * sizeof *keys);
    if (!keys) return NULL;
    for (uint32_t f = 0; f < faces; f++) {
        for (uint32_t turn = 0; turn < 4; turn++) {
            quad_key k;
            for (uint32_t i = 0; i < 4; i++) {
                k.corner[i] = corner[4 * f + (i + turn) % 4];
                memcpy(k.position[i], position[k.corner[i]], sizeof k.position[i]);
            }
            if (turn == 0 || by_position(&k, &keys[f]) < 0) keys[f] = k;
        }
    }
    qsort(keys, faces, sizeof *keys, by_position);
    return keys;
}

/* Quads that lie upon each other can't be told apart; all others have one partner. */
static bool is_unique(const quad_key *keys, uint32_t faces, uint32_t f) {
    return !(f > 0 && by_position(&keys[f - 1], &keys[f]) == 0) &&
           !(f + 1 < faces && by_position(&keys[f], &keys[f + 1]) == 0) &&
           memcmp(keys[f].position[0], keys[f].position[1], 16) != 0 &&
           memcmp(keys[f].position[0], keys[f].position[2], 16) != 0 &&
           memcmp(keys[f].position[0], keys[f].position[3], 16) != 0;
}

static bool same_keys(uint32_t faces, const quad_key *a, const quad_key *b, uint32_t *partner,
                      hs_error *err) {
    for (uint32_t f = 0; f < faces; f++) {
        if (by_position(&a[f], &b[f]) != 0)
            return hs_fail(err, HS_EXIT_DIFFERENT,
                           "I4: face %u of %u, in order of position, lies "
                           "elsewhere",
                           f, faces);
        if (!is_unique(a, faces, f)) continue;
        for (int i = 0; i < 4; i++) {
            uint32_t *known = &partner[a[f].corner[i]];
            if (*known != HS_BORDER && *known != b[f].corner[i])
                return hs_fail(err, HS_EXIT_DIFFERENT, "I4: vertex %u corresponds to two: %u, %u",
                               a[f].corner[i], *known, b[f].corner[i]);
            *known = b[f].corner[i];
        }
    }
    return true;
}

bool invariant_same_surface(uint32_t faces, const int32_t (*position_a)[4],
                            const uint32_t *corner_a, const int32_t (*position_b)[4],
                            const uint32_t *corner_b, uint32_t vertices, uint64_t *compared,
                            hs_error *err) {
    quad_key *a = sorted_quads(faces, position_a, corner_a);
    quad_key *b = sorted_quads(faces, position_b, corner_b);
    uint32_t *partner = malloc((vertices + (size_t)1) * sizeof *partner);
    bool good = a && b && partner;
    if (!good) exhausted(err);
    for (int turn = 0; good && turn < 2; turn++) { /* a to b, and b to a */
        memset(partner, 0xff, vertices * sizeof *partner);
        good = turn ? same_keys(faces, b, a, partner, err) : same_keys(faces, a, b, partner, err);
    }
    free(a);
    free(b);
    free(partner);
    *compared += 4 * (uint64_t)faces;
    return good;
}

static bool check_level(invariant_levels *l, const hs_state *s) {
    const hs_catmull_clark *surface = &l->surface;
    if (s->generation == 0)
        return hs_catmull_clark_new(&l->surface, l->mesh, (const int32_t(*)[4])s->position,
                                    l->boundary, &l->error);
    if (!hs_catmull_clark_refine(&l->surface, &l->error)) return false;
    if (s->faces != surface->faces || s->vertices != surface->vertices)
        return hs_fail(&l->error, HS_EXIT_DIFFERENT,
                       "I4: generation %u: %u faces and %u vertices instead of %u and %u",
                       s->generation, s->faces, s->vertices, surface->faces, surface->vertices);
    if (s->generation == 2 && /* the numbers are the same, too */
        memcmp(s->position, surface->position, 16 * (size_t)s->vertices) != 0)
        return hs_fail(&l->error, HS_EXIT_DIFFERENT, "I4: generation 2: other positions");
    return invariant_same_surface(s->faces, (const int32_t(*)[4])s->position, s->origin,
                                  (const int32_t(*)[4])surface->position, surface->origin,
                                  s->vertices, &l->corners, &l->error);
}

static void watch_level(void *context, const hs_state *s) {
    invariant_levels *l = context;
    if (l->good && s->generation % 2 == 0) l->good = check_level(l, s);
}

hs_observer invariant_levels_begin(invariant_levels *levels, const hs_mesh *mesh,
                                   hs_boundary boundary) {
    *levels = (invariant_levels){.mesh = mesh, .boundary = boundary, .good = true};
    return (hs_observer){.context = levels, .entered = watch_level};
}

void invariant_levels_free(invariant_levels *levels) {
    hs_catmull_clark_free(&levels->surface);
}

/* --- I5: memory full of something else -----------------------------------------------------------
 */

/* Poisons elements from..., as many as the next generation can reach, inside the room there is. */
static void spoil(void *array, size_t element, size_t from, size_t to, size_t room,
                  uint8_t poison) {
    if (to > room) to = room;
    if (array && from < to)
        memset((uint8_t *)array + from * element, poison, (to - from) * element);
}

static void spoil_state(void *context, const hs_state *s) {
    uint8_t *poison = context;
    const uint8_t p = (*poison)++;
    const size_t v = s->vertices, f = s->faces, h = s->halfedges;
    const size_t more_v = v + f + 64, more_f = h / 2 + 64, more_h = 2 * h + 64;
    const size_t vr = s->vertex_room, fr = s->face_room, hr = s->halfedge_room;
    spoil(s->position, 16, v, more_v, vr, p);
    spoil(s->old, 16, s->generation % 2 ? v : 0, more_v, vr, p);
    spoil(s->clip, 16, 0, more_v, vr, p);
    spoil(s->sum, sizeof *s->sum, 0, more_v, vr, p);
    spoil(s->ring, sizeof *s->ring, 0, more_v, s->ring_room, p);
    spoil(s->stays, 1, v, more_v, vr, p);
    spoil(s->crease, 1, v, more_v, vr, p);
    spoil(s->valence, 1, v, more_v, vr, p);
    spoil(s->mark, 1, 0, more_v, vr, p);
    spoil(s->sent, 1, v, more_v, vr, p);
    spoil(s->candidate, 1, f, more_f, fr, p);
    spoil(s->forced, 1, f, more_f, fr, p);
    spoil(s->point, 16, 0, more_f, fr, p);
    spoil(s->face_mark, 1, 0, more_f, fr, p);
    spoil(s->decision, 1, 0, more_f, fr, p);
    spoil(s->number, 4, 0, more_f, fr, p);
    spoil(s->next_candidate, 1, 0, more_f, fr, p);
    spoil(s->next_forced, 1, 0, more_f, fr, p);
    spoil(s->origin, 4, h, more_h, hr, p);
    spoil(s->twin, 4, h, more_h, hr, p);
    spoil(s->sharp, 1, h, more_h, hr, p);
    spoil(s->child, 4, 0, more_h, hr, p);
    spoil(s->next_origin, 4, 0, more_h, hr, p);
    spoil(s->next_twin, 4, 0, more_h, hr, p);
    spoil(s->next_sharp, 1, 0, more_h, hr, p);
    if (s->generation) {
        spoil(s->first, 4, 0, more_f, fr, p);
        spoil(s->face, 4, 0, more_h, hr, p);
    }
}

hs_observer invariant_poisoner(uint8_t *poison) {
    return (hs_observer){.context = poison, .entered = spoil_state};
}
