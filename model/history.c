/* SPDX-License-Identifier: Apache-2.0 */
#include "history.h"

#include <stdlib.h>
#include <string.h>

/* --- Copies of what golden has ------------------------------------------------------------------
 */

static void *room(hs_history *history, size_t count, size_t element) {
    void *array = malloc(count * element + 1); /* an empty one is no lack of memory */
    if (!array) history->exhausted = true;
    return array;
}

static void *copy(hs_history *history, const void *from, size_t count, size_t element) {
    void *array = room(history, count, element);
    if (array && count) memcpy(array, from, count * element);
    return array;
}

/* So many numbers, all NONE. */
static uint32_t *nones(hs_history *history, size_t count) {
    uint32_t *array = room(history, count, sizeof *array);
    for (size_t i = 0; array && i < count; i++)
        array[i] = HS_HISTORY_NONE;
    return array;
}

static void free_past(hs_past *p) {
    void *const array[] = {p->first,  p->sides, p->origin,    p->twin,     p->child,  p->parent,
                           p->within, p->term,  p->face_mark, p->decision, p->forced, p->number,
                           p->mark,   p->free,  p->output,    p->triangle};
    for (size_t i = 0; i < sizeof array / sizeof *array; i++)
        free(array[i]);
    *p = (hs_past){0};
}

void hs_history_free(hs_history *history) {
    for (size_t g = 0; g < sizeof history->past / sizeof *history->past; g++)
        free_past(&history->past[g]);
    free(history->origin);
    *history = (hs_history){0};
}

uint32_t hs_history_face_of(const hs_history *history, uint32_t generation, uint32_t halfedge) {
    if (generation) return halfedge / 4;
    const hs_past *p = &history->past[0];
    uint32_t low = 0, high = p->faces; /* first[low] <= halfedge < first[high] */
    while (high - low > 1) {
        const uint32_t middle = low + (high - low) / 2;
        if (p->first[middle] <= halfedge)
            low = middle;
        else
            high = middle;
    }
    return low;
}

bool hs_history_parents(const hs_history *history, uint32_t generation, uint32_t face,
                        uint32_t parent[2]) {
    if (generation == 0) return false;
    const uint32_t h = history->past[generation].parent[face];
    const uint32_t t = history->past[generation - 1].twin[h];
    parent[0] = hs_history_face_of(history, generation - 1, h);
    parent[1] = t == BOUNDARY_TWIN ? parent[0] : hs_history_face_of(history, generation - 1, t);
    return true;
}

/* --- Observing ----------------------------------------------------------------------------------
 */

/* The initial faces that a child lies in. A step makes two halves of an edge h of face f: of an
 * odd generation, h is in one initial face, that of its half of f. */
static void find_places(hs_history *history, uint32_t generation, uint32_t face) {
    uint32_t *within = history->past[generation].within[face];
    if (generation == 0) {
        within[0] = within[1] = face;
        return;
    }
    const hs_past *before = &history->past[generation - 1];
    const uint32_t h = history->past[generation].parent[face];
    uint32_t parent[2];
    hs_history_parents(history, generation, face, parent);
    if (generation % 2) {
        within[0] = before->within[parent[0]][0];
        within[1] = before->within[parent[1]][0];
    } else {
        within[0] = within[1] = before->within[parent[0]][h % 4 / 2];
    }
}

/* The active mesh, its marks and decisions. */
static void decided(void *context, const hs_state *s) {
    hs_history *history = context;
    const uint32_t g = s->generation;
    hs_past *p = &history->past[g];
    uint32_t *parent = p->parent; /* from the step before */
    *p = (hs_past){.faces = s->faces,
                   .halfedges = s->halfedges,
                   .vertices = s->vertices,
                   .decided = true,
                   .finish = s->finish,
                   .stopped = s->finish && s->status == HS_STATUS_STOPPED,
                   .selected = s->selected,
                   .refined = s->refined,
                   .parent = parent ? parent : nones(history, s->faces)};
    p->first = room(history, s->faces, sizeof *p->first);
    p->sides = room(history, s->faces, 1);
    p->term = room(history, s->faces, sizeof *p->term);
    p->within = room(history, s->faces, sizeof *p->within);
    p->origin = copy(history, s->origin, s->halfedges, sizeof *p->origin);
    p->twin = copy(history, s->twin, s->halfedges, sizeof *p->twin);
    p->face_mark = copy(history, s->face_mark, s->faces, 1);
    p->decision = copy(history, s->decision, s->faces, 1);
    p->forced = copy(history, s->forced, s->faces, 1);
    p->number = copy(history, s->number, s->faces, sizeof *p->number);
    p->mark = copy(history, s->mark, s->vertices, 1);
    p->free = room(history, s->vertices, 1);
    p->output = nones(history, s->faces);
    p->triangle = nones(history, s->halfedges);
    for (uint32_t v = 0; v < s->vertices && !history->exhausted; v++)
        p->free[v] = (s->mark[v] & MARK_ACTIVE) && hs_is_free(s, s->sent, v);
    for (uint32_t f = 0; f < s->faces && !history->exhausted; f++) {
        p->first[f] = hs_face_first(s, f);
        p->sides[f] = (uint8_t)hs_face_sides(s, f);
        p->term[f] = (uint16_t)hs_terms(s, f);
        find_places(history, g, f);
    }
    if (g == 0) {
        history->depth = s->depth;
        history->settings = s->settings;
    }
}

/* The next generation, of which the parents are known, and its last, unless it becomes active, the
 * corners: split's quad (w, F, v, G), or half-quad (w, F, v). */
static void begin_next(hs_history *history, const hs_state *s) {
    const hs_past *before = &history->past[s->generation];
    hs_past *p = &history->past[s->generation + 1];
    *p = (hs_past){.faces = s->next_faces, .parent = nones(history, s->next_faces)};
    for (uint32_t f = 0; f < s->faces && !history->exhausted; f++)
        for (uint32_t h = before->first[f]; h < before->first[f] + before->sides[f]; h++) {
            const uint32_t child = s->child[h];
            if (!(s->decision[f] & FACE_REFINED) || child == HS_BORDER || child == BOUNDARY_TWIN)
                continue;
            if (child % 4 == 0) p->parent[child / 4] = h;
        }
    if (!s->last) return;
    p->halfedges = 4 * p->faces;
    p->vertices = s->vertices + s->refined;
    p->finish = true;
    p->first = room(history, p->faces, sizeof *p->first);
    p->sides = room(history, p->faces, 1);
    p->within = room(history, p->faces, sizeof *p->within);
    p->origin = nones(history, p->halfedges);
    p->output = nones(history, p->faces);
    p->triangle = nones(history, p->halfedges);
    for (uint32_t q = 0; q < p->faces && !history->exhausted; q++) {
        const uint32_t h = p->parent[q], t = before->twin[h];
        uint32_t parent[2];
        hs_history_parents(history, s->generation + 1, q, parent);
        const uint32_t h0 = before->first[parent[0]], n = before->sides[parent[0]];
        p->first[q] = 4 * q;
        p->sides[q] = t == BOUNDARY_TWIN ? 3 : 4;
        p->origin[4 * q] = before->origin[h + 1 < h0 + n ? h + 1 : h0];
        p->origin[4 * q + 1] = before->number[parent[0]];
        p->origin[4 * q + 2] = before->origin[h];
        if (t != BOUNDARY_TWIN) p->origin[4 * q + 3] = before->number[parent[1]];
        find_places(history, s->generation + 1, q);
    }
}

/* Faces leave in their order, what comes of a refined one in the order of its sides. */
static void leave(hs_history *history, const hs_state *s) {
    hs_past *p = &history->past[s->generation], *next = p + 1;
    for (uint32_t f = 0; f < p->faces; f++) {
        if (s->finish || !(s->decision[f] & FACE_REFINED)) {
            p->output[f] = history->sent++;
            continue;
        }
        for (uint32_t h = p->first[f]; h < p->first[f] + p->sides[f]; h++)
            if (p->child[h] == HS_BORDER)
                p->triangle[h] = history->sent++;
            else if (s->last && p->child[h] != BOUNDARY_TWIN && p->child[h] % 4 == 0)
                next->output[p->child[h] / 4] = history->sent++;
    }
}

static void divided(void *context, const hs_state *s) {
    hs_history *history = context;
    if (history->exhausted || s->exhausted) return;
    hs_past *p = &history->past[s->generation];
    p->child = copy(history, s->child, s->halfedges, sizeof *p->child);
    history->generations = s->generation + 1 + s->last;
    if (!s->finish) begin_next(history, s);
    if (!history->exhausted) leave(history, s);
}

/* --- Against what came out ----------------------------------------------------------------------
 */

/* Whether a face of the output is what the record has there: generation, candidate bit, corners. */
static bool matches(const hs_output *output, uint32_t face, uint32_t generation, int candidate,
                    const uint32_t *corner, uint32_t sides) {
    const uint32_t begin = output->first[face];
    if (output->generation[face] != generation || output->first[face + 1] - begin != sides ||
        (candidate >= 0 && output->candidate[face] != candidate))
        return false;
    for (uint32_t i = 0; i < sides; i++)
        if (output->number[output->corner[begin + i]] != corner[i]) return false;
    return true;
}

static bool enter_face(hs_history *history, const hs_output *output, uint32_t g, uint32_t f) {
    const hs_past *p = &history->past[g];
    const uint32_t place = p->output[f];
    if (place == HS_HISTORY_NONE) return true;
    const int candidate =
        !p->decided || p->term[f] & TERM_UNIFORM ? -1 : (p->term[f] & TERM_CANDIDATE) != 0;
    if (place >= output->faces ||
        !matches(output, place, g, candidate, p->origin + p->first[f], p->sides[f]))
        return false;
    history->origin[place] = (hs_origin){(uint8_t)g, f, HS_HISTORY_NONE};
    return true;
}

static bool enter_triangles(hs_history *history, const hs_output *output, uint32_t g, uint32_t f) {
    const hs_past *p = &history->past[g];
    const uint32_t h0 = p->first[f], n = p->sides[f];
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t place = p->triangle[h0 + i];
        if (place == HS_HISTORY_NONE) continue;
        const uint32_t corner[3] = {p->origin[h0 + i], p->origin[h0 + (i + 1) % n], p->number[f]};
        if (place >= output->faces || !matches(output, place, g, 0, corner, 3)) return false;
        history->origin[place] = (hs_origin){(uint8_t)g, f, h0 + i};
    }
    return true;
}

bool hs_history_check(hs_history *history, const hs_output *output, hs_error *err) {
    history->outputs = output->faces;
    history->status = output->status;
    history->origin = room(history, output->faces, sizeof *history->origin);
    if (history->exhausted) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the history");
    bool good = history->sent == output->faces;
    for (uint32_t g = 0; g < history->generations; g++)
        for (uint32_t f = 0; good && f < history->past[g].faces; f++)
            good = enter_face(history, output, g, f) && enter_triangles(history, output, g, f);
    return good || hs_fail(err, HS_EXIT_INTERNAL,
                           "the record of the view is not what came out; this is a defect");
}

void hs_history_watch(hs_history *history, hs_golden *golden) {
    hs_golden_observe(golden, &(hs_observer){history, false, NULL, decided, NULL, divided});
}

bool hs_history_record(hs_history *history, hs_output *output, const hs_mesh *mesh,
                       const float matrix[16], const hs_settings *settings, hs_limits limits,
                       hs_error *err) {
    *history = (hs_history){0};
    *output = (hs_output){0};
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_golden *golden = hs_golden_new(limits);
    if (!golden) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    hs_history_watch(history, golden);
    bool good = hs_packet_encode(&in, 0, mesh, matrix, settings, err) &&
                hs_golden_run(golden, &in, &out, &report, err) &&
                hs_output_decode(output, &out, err) && hs_output_accepted(output, err);
    hs_golden_free(golden);
    hs_packet_free(&in);
    hs_packet_free(&out);
    good = good && hs_history_check(history, output, err);
    if (good) return true;
    hs_history_free(history);
    hs_output_free(output);
    return false;
}
