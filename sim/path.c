/* SPDX-License-Identifier: Apache-2.0
 *
 * Which vertices are settled, by induction over the steps, m the level of an even generation 2m:
 *
 *   initial vertices  are, at level 0
 *   F of an odd step  if all corners of its face are, at level m; it is then of level m + 1
 *   v of an odd step  if it is free, and all face points around it are settled; level m + 1
 *   X of an even step if the face points of its quad are: what they were made of was, too
 *
 * A vertex that is not free keeps its level, and is settled as before.
 */
#include "path.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "reference.h"

/* --- Names ------------------------------------------------------------------------------------ */

enum { WHOLE = 1, TRIANGLE = 2 };

/* What a face is made of: its kind and its corners' names. Its name is its number in the
 * dictionary. */
typedef struct key {
    uint32_t kind, corner[4];
} key;

typedef struct frame {
    uint32_t faces, vertices;
    uint32_t *face;   /* names, ascending */
    uint32_t *vertex; /* per name: place in the arrays below, or NONE */
    uint32_t names;
    uint8_t *level, *settled;
    double (*position)[4];
} frame;

struct hs_path {
    const hs_mesh *mesh;
    key *key; /* of every name; the initial faces come first and have none */
    uint32_t keys, key_room;
    uint32_t *slot, slots; /* hash table of names: a power of two, at most half full */
    frame before;
    bool has_before;
};

static void free_frame(frame *f) {
    free(f->face);
    free(f->vertex);
    free(f->level);
    free(f->settled);
    free(f->position);
    *f = (frame){0};
}

hs_path *hs_path_new(const hs_mesh *mesh) {
    hs_path *path = calloc(1, sizeof *path);
    if (!path) return NULL;
    path->mesh = mesh;
    path->keys = mesh->faces;
    return path;
}

void hs_path_free(hs_path *path) {
    if (!path) return;
    free_frame(&path->before);
    free(path->key);
    free(path->slot);
    free(path);
}

/* The slot of a key, or the free one where it belongs. */
static uint32_t *slot_of(const hs_path *path, const key *k) {
    uint64_t hash = k->kind;
    for (int i = 0; i < 4; i++)
        hash = (hash ^ k->corner[i]) * 0x9e3779b97f4a7c15u, hash ^= hash >> 29;
    uint32_t at = (uint32_t)hash & (path->slots - 1);
    while (path->slot[at] != HS_HISTORY_NONE &&
           memcmp(&path->key[path->slot[at]], k, sizeof *k) != 0)
        at = (at + 1) & (path->slots - 1);
    return &path->slot[at];
}

static bool grow(hs_path *path) {
    if (path->keys >= path->key_room) {
        const size_t room = 2 * (size_t)path->keys + 1024;
        key *k = room < UINT32_MAX ? realloc(path->key, room * sizeof *k) : NULL;
        if (!k) return false;
        path->key = k;
        path->key_room = (uint32_t)room;
    }
    if (2 * (uint64_t)path->keys < path->slots) return true;
    uint32_t slots = 4096;
    while (slots < 4 * (uint64_t)path->keys && slots < 1u << 31)
        slots *= 2;
    uint32_t *slot = malloc(slots * sizeof *slot);
    if (!slot) return false;
    free(path->slot);
    path->slot = slot;
    path->slots = slots;
    for (uint32_t i = 0; i < slots; i++)
        slot[i] = HS_HISTORY_NONE;
    for (uint32_t n = path->mesh->faces; n < path->keys; n++)
        *slot_of(path, &path->key[n]) = n;
    return true;
}

/* The name of a key, NONE if memory is exhausted. */
static uint32_t name_of(hs_path *path, const key *k) {
    if (!grow(path)) return HS_HISTORY_NONE;
    uint32_t *slot = slot_of(path, k);
    if (*slot == HS_HISTORY_NONE) {
        path->key[path->keys] = *k;
        *slot = path->keys++;
    }
    return *slot;
}

/* --- A frame ---------------------------------------------------------------------------------- */

/* What is known of the pipeline's vertices, by their numbers. */
typedef struct work {
    hs_path *path;
    const hs_history *history;
    const hs_output *output;
    uint32_t *name;
    uint8_t *level, *settled, *around;
    frame frame;
    bool exhausted;
} work;

/* The name of an active face, by its corners (w, F, v, G). Which of its edge's two half-edges is
 * the lower, and so which corner is the first, is the same in all frames: what is refined keeps its
 * order, whatever else is. */
static uint32_t name_face(work *w, uint32_t g, uint32_t f) {
    if (g == 0) return f;
    const hs_past *p = &w->history->past[g];
    const uint32_t *corner = p->origin + p->first[f];
    key k = {WHOLE, {0, 0, 0, HS_HISTORY_NONE}};
    for (uint32_t i = 0; i < p->sides[f]; i++)
        k.corner[i] = w->name[corner[i]];
    const uint32_t name = name_of(w->path, &k);
    w->exhausted = w->exhausted || name == HS_HISTORY_NONE;
    return name;
}

static bool corners_settled(const work *w, const hs_past *p, uint32_t f, uint32_t level) {
    for (uint32_t i = 0; i < p->sides[f]; i++) {
        const uint32_t v = p->origin[p->first[f] + i];
        if (!w->settled[v] || w->level[v] != level) return false;
    }
    return true;
}

/* The face's new vertex: its name, its level, whether it is settled. */
static void make_vertex(work *w, uint32_t g, uint32_t f, uint32_t face_name) {
    const hs_past *p = &w->history->past[g];
    const uint32_t v = p->number[f], *corner = p->origin + p->first[f];
    w->name[v] = w->path->mesh->vertices + face_name;
    w->level[v] = (uint8_t)(g / 2 + 1);
    w->settled[v] = g % 2 == 0
                        ? corners_settled(w, p, f, g / 2)
                        : w->settled[corner[1]] && (p->sides[f] == 3 || w->settled[corner[3]]);
}

/* An odd step moves what is free. */
static void move_vertices(work *w, uint32_t g) {
    const hs_past *p = &w->history->past[g];
    memset(w->around, 1, p->vertices);
    for (uint32_t f = 0; f < p->faces; f++)
        if (p->output[f] == HS_HISTORY_NONE && !w->settled[p->number[f]])
            for (uint32_t i = 0; i < p->sides[f]; i++)
                w->around[p->origin[p->first[f] + i]] = 0;
    for (uint32_t v = 0; v < p->vertices; v++)
        if (p->free[v]) {
            w->level[v] = (uint8_t)(g / 2 + 1);
            w->settled[v] = w->settled[v] && w->around[v];
        }
}

static void name_triangles(work *w, uint32_t g, uint32_t f) {
    const hs_past *p = &w->history->past[g];
    const uint32_t h0 = p->first[f], n = p->sides[f];
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t place = p->triangle[h0 + i];
        if (place == HS_HISTORY_NONE) continue;
        const key k = {TRIANGLE,
                       {w->name[p->origin[h0 + i]], w->name[p->origin[h0 + (i + 1) % n]],
                        w->name[p->number[f]], HS_HISTORY_NONE}};
        w->frame.face[place] = name_of(w->path, &k);
        w->exhausted = w->exhausted || w->frame.face[place] == HS_HISTORY_NONE;
    }
}

static void follow(work *w) {
    const hs_history *history = w->history;
    for (uint32_t v = 0; v < history->past[0].vertices; v++) {
        w->name[v] = v;
        w->level[v] = 0;
        w->settled[v] = 1;
    }
    for (uint32_t g = 0; g < history->generations && !w->exhausted; g++) {
        const hs_past *p = &history->past[g];
        for (uint32_t f = 0; f < p->faces && !w->exhausted; f++) {
            const uint32_t name = name_face(w, g, f);
            if (p->output[f] != HS_HISTORY_NONE)
                w->frame.face[p->output[f]] = name;
            else
                make_vertex(w, g, f, name);
        }
        for (uint32_t f = 0; f < p->faces && !w->exhausted; f++)
            name_triangles(w, g, f);
        if (g % 2 == 0 && p->decided) move_vertices(w, g);
    }
}

static int by_name(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* Vertices of the output, by name. */
static bool take_vertices(work *w, const hs_reference *reference) {
    const hs_output *o = w->output;
    frame *f = &w->frame;
    f->names = w->path->mesh->vertices + w->path->keys;
    f->vertex = malloc((f->names + (size_t)1) * sizeof *f->vertex);
    f->level = malloc(o->vertices + (size_t)1);
    f->settled = malloc(o->vertices + (size_t)1);
    f->position = malloc((o->vertices + (size_t)1) * sizeof *f->position);
    if (!f->vertex || !f->level || !f->settled || !f->position) return false;
    f->vertices = o->vertices;
    for (uint32_t n = 0; n < f->names; n++)
        f->vertex[n] = HS_HISTORY_NONE;
    for (uint32_t i = 0; i < o->vertices; i++) {
        const uint32_t v = o->number[i];
        f->vertex[w->name[v]] = i;
        f->level[i] = w->level[v];
        f->settled[i] = w->settled[v];
        memcpy(f->position[i], reference->vertex[v].position, sizeof f->position[i]);
    }
    return true;
}

/* --- Beside the frame before ------------------------------------------------------------------ */

static void compare_faces(hs_path_step *step, const frame *before, const frame *now) {
    uint32_t i = 0, j = 0;
    while (i < before->faces && j < now->faces) {
        const uint32_t a = before->face[i], b = now->face[j];
        step->kept += a == b;
        i += a <= b;
        j += b <= a;
    }
    step->lost = before->faces - step->kept;
    step->gained = now->faces - step->kept;
}

static void compare_vertices(hs_path_step *step, const frame *before, const frame *now) {
    for (uint32_t n = 0; n < before->names; n++) {
        const uint32_t a = before->vertex[n], b = now->vertex[n];
        if (a == HS_HISTORY_NONE || b == HS_HISTORY_NONE) continue;
        step->shared++;
        if (!before->settled[a] || !now->settled[b] || before->level[a] != now->level[b]) continue;
        step->compared++;
        step->moved +=
            memcmp(before->position[a], now->position[b], sizeof before->position[a]) != 0;
    }
}

/* A face with a silhouette vertex, in view. */
static bool at_silhouette(const hs_past *p, uint32_t f) {
    return hs_all_terms(p->term[f], TERM_SILHOUETTE | TERM_IN_VIEW);
}

/* How much of the silhouette got to its depth: faces there that were made of a face at the
 * silhouette, or that the least edge stopped; and those that left before. A face of generation g
 * covers as much as 2^(depth - g) there. */
static void count_silhouette(hs_path_step *step, const hs_history *history) {
    const uint32_t depth = history->settings.silhouette_depth;
    if (history->settings.uniform) return;
    for (uint32_t g = 0; g < history->generations && g <= depth; g++) {
        const hs_past *p = &history->past[g];
        for (uint32_t f = 0; f < p->faces; f++) {
            uint32_t parent[2];
            if (g == depth) {
                if (hs_history_parents(history, g, f, parent) &&
                    (at_silhouette(p - 1, parent[0]) || at_silhouette(p - 1, parent[1])))
                    step->reached++;
            } else if (p->decided && p->output[f] != HS_HISTORY_NONE && at_silhouette(p, f)) {
                *(p->term[f] & TERM_STOP ? &step->reached : &step->short_of) +=
                    ldexp(1, (int)(depth - g));
            }
        }
    }
}

/* --- One more frame --------------------------------------------------------------------------- */

static bool make_room(work *w) {
    const hs_history *history = w->history;
    size_t vertices = 1;
    for (uint32_t g = 0; g < history->generations; g++)
        if (history->past[g].vertices + (size_t)history->past[g].refined > vertices)
            vertices = history->past[g].vertices + (size_t)history->past[g].refined;
    w->name = malloc((vertices + 1) * sizeof *w->name);
    w->level = malloc(vertices + 1);
    w->settled = malloc(vertices + 1);
    w->around = malloc(vertices + 1);
    w->frame.face = malloc((w->output->faces + (size_t)1) * sizeof *w->frame.face);
    w->frame.faces = w->output->faces;
    return w->name && w->level && w->settled && w->around && w->frame.face;
}

static bool add(work *w, hs_path_step *step, const hs_golden_report *report, hs_error *err) {
    hs_path *path = w->path;
    hs_reference reference = {0};
    bool good = make_room(w);
    if (good) follow(w);
    good = good && !w->exhausted;
    if (!good) hs_fail(err, HS_EXIT_INTERNAL, "no memory to compare the frames of the path");
    good = good &&
           hs_reference_new(&reference, path->mesh, NULL, w->history->settings.boundary, err) &&
           hs_reference_replay(&reference, &w->history->settings, report, NULL, err);
    if (good && !take_vertices(w, &reference))
        good = hs_fail(err, HS_EXIT_INTERNAL, "no memory to compare the frames of the path");
    hs_reference_free(&reference);
    if (!good) return false;
    frame *now = &w->frame;
    qsort(now->face, now->faces, sizeof *now->face, by_name);
    *step = (hs_path_step){
        .done = true, .first = !path->has_before, .faces = now->faces, .vertices = now->vertices};
    for (uint32_t i = 0; i < now->vertices; i++)
        step->settled += now->settled[i];
    count_silhouette(step, w->history);
    if (path->has_before) {
        compare_faces(step, &path->before, now);
        compare_vertices(step, &path->before, now);
    }
    free_frame(&path->before);
    path->before = *now;
    path->has_before = true;
    *now = (frame){0};
    return true;
}

bool hs_path_add(hs_path *path, hs_path_step *step, const hs_history *history,
                 const hs_output *output, const hs_golden_report *report, hs_error *err) {
    work w = {.path = path, .history = history, .output = output};
    const bool good = add(&w, step, report, err);
    free(w.name);
    free(w.level);
    free(w.settled);
    free(w.around);
    free_frame(&w.frame);
    return good;
}
