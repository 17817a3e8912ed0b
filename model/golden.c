/* SPDX-License-Identifier: Apache-2.0
 *
 * golden: one view, from packet to packet. Receive it; then, once a generation, classify, select,
 * guard, smooth, split; the stages are files of their own, and golden_state.h says what each
 * leaves for the next.
 */
#include <stdlib.h>
#include <string.h>

#include "golden_state.h"
#include "memory.h"

enum { GENERATIONS = HS_MAX_DEPTH + 1 };

struct hs_golden {
    hs_state state;
    hs_observer observer;
    hs_generation generation[GENERATIONS];
    uint8_t *decision[GENERATIONS];
    size_t decision_room[GENERATIONS];
};

hs_golden *hs_golden_new(hs_limits limits) {
    const uint32_t most = 1u << HS_INDEX_BITS;
    if (limits.vertices > most || limits.quads > most) return NULL;
    hs_golden *golden = calloc(1, sizeof *golden);
    if (golden) golden->state.limits = limits;
    return golden;
}

void hs_golden_free(hs_golden *golden) {
    if (!golden) return;
    hs_state *s = &golden->state;
    void *const arrays[] = {s->first,          s->face,        s->origin,      s->twin,
                            s->candidate,      s->forced,      s->position,    s->old,
                            s->clip,           s->sum,         s->mark,        s->sent,
                            s->point,          s->valence,     s->face_mark,   s->decision,
                            s->number,         s->child,       s->next_origin, s->next_twin,
                            s->next_candidate, s->next_forced, s->sharp,       s->next_sharp,
                            s->stays,          s->crease,      s->ring};
    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++)
        hs_array_free(arrays[i]);
    for (size_t g = 0; g < GENERATIONS; g++)
        hs_array_free(golden->decision[g]);
    free(golden);
}

size_t hs_golden_bytes(const hs_golden *golden) {
    const hs_state *s = &golden->state;
    const size_t vertex = sizeof *s->position + sizeof *s->old + sizeof *s->clip + sizeof *s->sum +
                          sizeof *s->mark + sizeof *s->valence + sizeof *s->sent +
                          sizeof *s->stays + sizeof *s->crease;
    const size_t face = sizeof *s->first + sizeof *s->candidate + sizeof *s->forced +
                        sizeof *s->next_candidate + sizeof *s->next_forced + sizeof *s->point +
                        sizeof *s->face_mark + sizeof *s->decision + sizeof *s->number;
    const size_t halfedge = sizeof *s->face + sizeof *s->origin + sizeof *s->twin +
                            sizeof *s->child + sizeof *s->sharp + sizeof *s->next_sharp +
                            sizeof *s->next_origin + sizeof *s->next_twin;
    size_t bytes = sizeof *golden + s->vertex_room * vertex + s->ring_room * sizeof *s->ring +
                   s->face_room * face + s->halfedge_room * halfedge;
    for (size_t g = 0; g < GENERATIONS; g++)
        bytes += golden->decision_room[g];
    return bytes;
}

void hs_golden_observe(hs_golden *golden, const hs_observer *observer) {
    golden->observer = observer ? *observer : (hs_observer){0};
}

void hs_golden_mark_always(hs_golden *golden, bool always) {
    golden->state.mark_always = always;
}

const hs_state *hs_golden_state(const hs_golden *golden) {
    return &golden->state;
}

/* Reallocates *(void **)array to count elements; the old array stays if there is no memory. Its
 * number is its place in the state: neighbours have different ones. */
static bool resize(void *array, size_t count, size_t element) {
    void *old, *data;
    memcpy(&old, array, sizeof old);
    data =
        hs_array_reallocate(old, count * element, (uint32_t)((uintptr_t)array / sizeof old % 32));
    if (!data) return false;
    memcpy(array, &data, sizeof data);
    // cppcheck-suppress memleak ; *array is its owner
    return true;
}

static size_t grown(size_t room, size_t wanted) {
    return wanted > room + room / 2 ? wanted : room + room / 2;
}

bool hs_state_reserve(hs_state *s, size_t vertices, size_t faces, size_t halfedges) {
    bool good = true;
    if (vertices > s->vertex_room) {
        const size_t n = grown(s->vertex_room, vertices);
        good = resize(&s->position, n, sizeof *s->position) && resize(&s->old, n, sizeof *s->old) &&
               resize(&s->clip, n, sizeof *s->clip) && resize(&s->sum, n, sizeof *s->sum) &&
               resize(&s->mark, n, sizeof *s->mark) && resize(&s->valence, n, sizeof *s->valence) &&
               resize(&s->sent, n, sizeof *s->sent) && resize(&s->stays, n, sizeof *s->stays) &&
               resize(&s->crease, n, sizeof *s->crease);
        if (good) s->vertex_room = n;
    }
    if (good && s->settings.limit && s->vertex_room > s->ring_room) {
        good = resize(&s->ring, s->vertex_room, sizeof *s->ring);
        if (good) s->ring_room = s->vertex_room;
    }
    if (good && faces > s->face_room) {
        const size_t n = grown(s->face_room, faces);
        good = resize(&s->first, n + 1, sizeof *s->first) &&
               resize(&s->candidate, n, sizeof *s->candidate) &&
               resize(&s->forced, n, sizeof *s->forced) &&
               resize(&s->next_candidate, n, sizeof *s->next_candidate) &&
               resize(&s->next_forced, n, sizeof *s->next_forced) &&
               resize(&s->point, n, sizeof *s->point) &&
               resize(&s->face_mark, n, sizeof *s->face_mark) &&
               resize(&s->decision, n, sizeof *s->decision) &&
               resize(&s->number, n, sizeof *s->number);
        if (good) s->face_room = n;
    }
    if (good && halfedges > s->halfedge_room) {
        const size_t n = grown(s->halfedge_room, halfedges);
        good = resize(&s->face, n, sizeof *s->face) && resize(&s->origin, n, sizeof *s->origin) &&
               resize(&s->twin, n, sizeof *s->twin) && resize(&s->child, n, sizeof *s->child) &&
               resize(&s->sharp, n, sizeof *s->sharp) &&
               resize(&s->next_sharp, n, sizeof *s->next_sharp) &&
               resize(&s->next_origin, n, sizeof *s->next_origin) &&
               resize(&s->next_twin, n, sizeof *s->next_twin);
        if (good) s->halfedge_room = n;
    }
    if (!good) s->exhausted = true;
    return good;
}

/* Keeps what was decided in this generation, for the report. */
static bool keep_decisions(hs_golden *golden) {
    hs_state *s = &golden->state;
    const uint32_t g = s->generation;
    if (s->faces > golden->decision_room[g]) {
        if (!resize(&golden->decision[g], s->faces, 1)) return false;
        golden->decision_room[g] = s->faces;
    }
    if (s->faces == 0)
        ; /* all that the step before refined became triangles: there may be no array yet */
    else if (s->finish)
        memset(golden->decision[g], 0, s->faces);
    else
        memcpy(golden->decision[g], s->decision, s->faces);
    golden->generation[g] = s->count;
    return true;
}

static void swap(uint32_t **a, uint32_t **b) {
    uint32_t *c = *a;
    *a = *b;
    *b = c;
}

static void swap_bytes(uint8_t **a, uint8_t **b) {
    uint8_t *c = *a;
    *a = *b;
    *b = c;
}

/* The generation that split made, as numbers. */
static void count_next_generation(hs_state *s) {
    s->vertices += s->refined;
    s->faces = s->next_faces;
    s->boundary = s->next_boundary;
    s->halfedges = 4 * s->next_faces;
    s->generation++;
}

static hs_generation new_count(const hs_state *s) {
    const uint32_t void_corners = s->generation & 1 ? s->boundary : 0; /* one a half-quad */
    return (hs_generation){.active = s->faces,
                           .corners = s->halfedges - void_corners,
                           .boundary = s->boundary,
                           .vertices = s->vertices};
}

static void enter_next_generation(hs_state *s) {
    count_next_generation(s);
    swap(&s->origin, &s->next_origin);
    swap(&s->twin, &s->next_twin);
    swap_bytes(&s->candidate, &s->next_candidate);
    swap_bytes(&s->forced, &s->next_forced);
    swap_bytes(&s->sharp, &s->next_sharp);
}

/* The children of a last step left in split, without becoming a generation. */
static bool count_last_generation(hs_golden *golden) {
    hs_state *s = &golden->state;
    count_next_generation(s);
    s->finish = true;
    s->count = new_count(s);
    s->count.final = s->faces;
    return keep_decisions(golden);
}

/* Keeps of a generation that a whole level takes along: everything is refined. */
static bool keep_whole(hs_golden *golden, uint32_t g, hs_generation count) {
    if (count.active > golden->decision_room[g]) {
        if (!resize(&golden->decision[g], count.active, 1)) return false;
        golden->decision_room[g] = count.active;
    }
    memset(golden->decision[g], FACE_SELECTED | FACE_REFINED, count.active);
    count.selected = count.refined = count.active;
    golden->generation[g] = count;
    return true;
}

static bool refine_level(hs_golden *golden) {
    hs_state *s = &golden->state;
    hs_generation first = new_count(s);
    const hs_generation second = {.active = 2 * first.active,
                                  .corners = 8 * first.active,
                                  .vertices = first.vertices + first.active};
    if (!hs_level_plain(s, &first.moved) || !keep_whole(golden, s->generation, first) ||
        !keep_whole(golden, s->generation + 1, second))
        return false;
    s->refined = 3 * first.active;
    s->next_boundary = 0;
    s->generation++; /* the one that was passed by */
    enter_next_generation(s);
    return true;
}

/* Whether somebody wants to see every generation. */
static bool watched(const hs_observer *o) {
    return (o->entered && !o->levels) || o->decided || o->smoothed || o->divided;
}

static bool refine(hs_golden *golden) {
    hs_state *s = &golden->state;
    const hs_observer *o = &golden->observer;
    for (;;) {
        if (o->entered) o->entered(o->context, s);
        if (!watched(o) && hs_level_fits(s)) {
            if (!refine_level(golden)) return false;
            continue;
        }
        s->count = new_count(s);
        hs_stage_classify(s);
        hs_stage_select(s);
        if (!s->finish) hs_stage_guard(s);
        if (s->finish) {
            s->last = false;
            s->refined = 0;
            s->refined_sides = 0;
        } else {
            s->count.selected = s->selected;
            s->count.refined = s->refined;
        }
        if (o->decided) o->decided(o->context, s);
        const size_t children = s->last ? 0 : (size_t)s->refined_sides / 2;
        if (!hs_state_reserve(s, (size_t)s->vertices + s->refined, children, 4 * children))
            return false;
        hs_stage_smooth(s);
        if (o->smoothed) o->smoothed(o->context, s);
        hs_stage_split(s);
        if (o->divided) o->divided(o->context, s);
        if (s->exhausted || !keep_decisions(golden)) return false;
        if (s->finish) return true;
        if (s->last) return count_last_generation(golden);
        enter_next_generation(s);
    }
}

static uint32_t final_depth(const hs_state *s) {
    const hs_settings *settings = &s->settings;
    if (settings->uniform) return settings->uniform_depth;
    uint32_t depth = settings->front_depth;
    if (settings->silhouette_depth > depth) depth = settings->silhouette_depth;
    return s->max_forced > depth ? s->max_forced : depth;
}

bool hs_golden_run(hs_golden *golden, const hs_packet *in, hs_packet *out, hs_golden_report *report,
                   hs_error *err) {
    hs_state *s = &golden->state;
    s->out = out;
    s->out->view = in->view;
    s->out->words = 0;
    s->exhausted = false;
    s->generation = 0;
    s->exponent = 0;
    s->group = 0;
    s->vertices_sent = s->faces_sent = s->triangles_sent = s->at_level = 0;

    hs_stage_receive(s, in);
    const bool accepted = s->status == HS_STATUS_OK && !s->exhausted;
    if (accepted) hs_stage_quantize(s);
    if (!s->exhausted) hs_emit_header(s);
    if (accepted) {
        s->depth = final_depth(s);
        memset(s->sent, 0, s->vertices);
        memset(s->candidate, 1, s->faces);
        if (!refine(golden)) s->exhausted = true;
    }
    if (!s->exhausted) hs_emit_trailer(s);
    if (s->exhausted)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "view %u: out of memory in golden; use a smaller mesh or depth", in->view);
    *report = (hs_golden_report){
        .status = s->status,
        .error_position = s->error_position,
        .exponent = s->exponent,
        .generations = accepted ? s->generation + 1 : 0,
        .generation = golden->generation,
        .vertices = s->vertices_sent,
        .faces = s->faces_sent,
        .triangles = s->triangles_sent,
        .at_level = s->at_level,
        .decision = (const uint8_t *const *)golden->decision,
    };
    return true;
}
