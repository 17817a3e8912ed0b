/* SPDX-License-Identifier: Apache-2.0
 *
 * The reference beside golden: its own marks and selection in doubles, the
 * replay of golden's decisions, and the comparison of what the two sent.
 */
#include "reference.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* --- Marks ------------------------------------------------------------------------------------ */

/* What a face is, and but for the last what a vertex collects from its active faces. */
enum { FRONT = 1, BACK = 2, HITS = 4, SILHOUETTE = FRONT | BACK, SHORT = 8 };

static const double *corner_position(const hs_reference *r, uint32_t f, uint32_t k) {
    const hs_reference_list v = r->face[f].v;
    return r->vertex[r->face_vertex[v.first + k % v.count]].position;
}

/* det [(x, y, w) of a, b, c]: where all w > 0, positive iff they run counter-clockwise. */
static double determinant(const double *a, const double *b, const double *c) {
    return a[0] * (b[1] * c[3] - b[3] * c[1]) - a[1] * (b[0] * c[3] - b[3] * c[0]) +
           a[3] * (b[0] * c[1] - b[1] * c[0]);
}

/* The half-spaces x > w, x < -w, y > w, y < -w, z > w, z < -w that a position lies in, a bit
 * each. */
static unsigned outside(const double *p) {
    unsigned code = 0;
    for (int i = 0; i < 3; i++) {
        if (p[i] > p[3]) code |= 1u << (2 * i);
        if (p[i] < -p[3]) code |= 2u << (2 * i);
    }
    return code;
}

/* True if coordinate i of two vertices is less than the least edge apart, in a picture of that many
 * pixels, and both are before the eye. */
static bool is_short(const double *p, const double *q, int i, uint32_t pixels,
                     const hs_settings *settings) {
    const double limit = settings->min_edge / (double)HS_PIXEL_FRACTION;
    return p[3] > 0 && q[3] > 0 &&
           fabs(p[i] * q[3] - q[i] * p[3]) * pixels / 2 < limit * p[3] * q[3];
}

/* stop(f): every edge is short both across and up. */
static bool all_short(const hs_reference *r, uint32_t f, const hs_settings *settings) {
    if (settings->min_edge == 0) return false;
    for (uint32_t k = 0; k < r->face[f].v.count; k++) {
        const double *p = corner_position(r, f, k), *q = corner_position(r, f, k + 1);
        if (!is_short(p, q, 0, settings->width, settings)) return false;
        if (!is_short(p, q, 1, settings->height, settings)) return false;
    }
    return true;
}

static uint8_t face_marks(const hs_reference *r, uint32_t f, const hs_settings *settings) {
    unsigned marks = 0, all_outside = 63;
    const uint32_t n = r->face[f].v.count;
    for (uint32_t k = 0; k < n; k++) {
        const double *p = corner_position(r, f, k);
        marks |= determinant(p, corner_position(r, f, k + 1), corner_position(r, f, k + 2)) > 0
                     ? FRONT
                     : BACK;
        all_outside &= outside(p);
    }
    if (!all_outside) marks |= HITS;
    if (all_short(r, f, settings)) marks |= SHORT;
    return (uint8_t)marks;
}

/* --- Selection -------------------------------------------------------------------------------- */

static bool is_wanted(const hs_reference *r, uint32_t f, const hs_settings *settings,
                      unsigned face_mark, const uint8_t *vertex_mark) {
    const hs_reference_list v = r->face[f].v;
    bool in_view = false, silhouette = false;
    for (uint32_t k = 0; k < v.count; k++) {
        const unsigned mark = vertex_mark[r->face_vertex[v.first + k]];
        in_view |= (mark & HITS) != 0;
        silhouette |= (mark & SILHOUETTE) == SILHOUETTE;
    }
    const bool front = (face_mark & FRONT) != 0;
    return in_view && !(face_mark & SHORT) &&
           ((front && r->generation < settings->front_depth) ||
            (silhouette && r->generation < settings->silhouette_depth));
}

static bool is_selected(const hs_reference *r, uint32_t f, const hs_settings *settings,
                        const uint8_t *face_mark, const uint8_t *vertex_mark) {
    if (settings->uniform) return r->generation < settings->uniform_depth;
    const hs_reference_face *face = &r->face[f];
    return face->candidate &&
           (r->generation < face->forced || is_wanted(r, f, settings, face_mark[f], vertex_mark));
}

/* Refined are the selected faces and, with guard, all faces that share a vertex with one. */
static void add_guard(const hs_reference *r, const hs_settings *settings, uint8_t *decision) {
    for (uint32_t f = 0; f < r->faces; f++) {
        if (!(decision[f] & HS_REFERENCE_SELECTED)) continue;
        decision[f] |= HS_REFERENCE_REFINED;
        if (!settings->guard) continue;
        const hs_reference_list v = r->face[f].v;
        for (uint32_t k = 0; k < v.count; k++) {
            const hs_reference_list around = r->vertex[r->face_vertex[v.first + k]].faces;
            for (uint32_t i = 0; i < around.count; i++)
                decision[r->vertex_face[around.first + i]] |= HS_REFERENCE_REFINED;
        }
    }
}

bool hs_reference_decide(const hs_reference *r, const hs_settings *settings, uint8_t *decision,
                         hs_error *err) {
    uint8_t *face_mark = calloc(r->faces + 1u, 1), *vertex_mark = calloc(r->vertices + 1u, 1);
    const bool ok = face_mark && vertex_mark;
    if (ok) {
        for (uint32_t f = 0; f < r->faces; f++) {
            const hs_reference_list v = r->face[f].v;
            face_mark[f] = face_marks(r, f, settings);
            for (uint32_t k = 0; k < v.count; k++)
                vertex_mark[r->face_vertex[v.first + k]] |= face_mark[f];
        }
        for (uint32_t f = 0; f < r->faces; f++)
            decision[f] =
                is_selected(r, f, settings, face_mark, vertex_mark) ? HS_REFERENCE_SELECTED : 0;
        add_guard(r, settings, decision);
    }
    free(face_mark);
    free(vertex_mark);
    return ok || hs_fail(err, HS_EXIT_INTERNAL,
                         "reference: out of memory; refine less deeply or use a smaller mesh");
}

/* --- Replay ----------------------------------------------------------------------------------- */

static bool count_differences(const hs_reference *r, const hs_settings *settings,
                              const uint8_t *replayed, hs_reference_decisions *decisions,
                              hs_error *err) {
    uint8_t *own = malloc(r->faces + 1u);
    if (!own)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "reference: out of memory; refine less deeply or use a smaller mesh");
    const bool ok = hs_reference_decide(r, settings, own, err);
    if (ok) decisions->faces += r->faces;
    for (uint32_t f = 0; ok && f < r->faces; f++) {
        const unsigned different = own[f] ^ replayed[f];
        decisions->selected_different += (different & HS_REFERENCE_SELECTED) != 0;
        decisions->refined_different += (different & HS_REFERENCE_REFINED) != 0;
    }
    free(own);
    return ok;
}

/* D: the generation at which all that remains is final. */
static uint32_t final_depth(const hs_reference *r, const hs_settings *settings) {
    if (settings->uniform) return settings->uniform_depth;
    uint32_t depth = settings->front_depth;
    if (settings->silhouette_depth > depth) depth = settings->silhouette_depth;
    for (uint32_t f = 0; f < r->faces; f++)
        if (r->face[f].forced > depth) depth = r->face[f].forced;
    return depth;
}

static bool check_active(uint32_t g, uint32_t here, uint32_t golden, hs_error *err) {
    return here == golden ||
           hs_fail(err, HS_EXIT_DIFFERENT,
                   "reference: generation %u has %u active faces, golden has %u; the two engines "
                   "refine differently",
                   g, here, golden);
}

/* The step to generation D; its children are the active faces of golden's last generation. */
static bool replay_last(hs_reference *r, const hs_golden_report *report, hs_error *err) {
    const uint32_t g = r->generation, before = r->finals;
    if (!hs_reference_last_step(r, report->decision[g], err)) return false;
    uint32_t children = 0;
    for (uint32_t f = before; f < r->finals; f++)
        children += r->final[f].generation == g + 1;
    const uint32_t golden = g + 1 < report->generations ? report->generation[g + 1].active : 0;
    return check_active(g + 1, children, golden, err);
}

bool hs_reference_replay(hs_reference *r, const hs_settings *settings,
                         const hs_golden_report *report, hs_reference_decisions *decisions,
                         hs_error *err) {
    const uint32_t depth = final_depth(r, settings);
    if (decisions) *decisions = (hs_reference_decisions){0};
    r->limit = settings->limit;
    for (uint32_t g = 0; g < report->generations; g++) {
        const hs_generation *golden = &report->generation[g];
        if (!check_active(g, r->faces, golden->active, err)) return false;
        /* Where nothing is refined, by choice or because a capacity stopped the view, all faces
         * leave as they are. */
        const bool stopped = report->status == HS_STATUS_STOPPED && g + 1 == report->generations;
        if (!stopped && decisions &&
            !count_differences(r, settings, report->decision[g], decisions, err))
            return false;
        if (stopped || golden->refined == 0) break;
        /* With limit positions, generation D is entered: its vertices need their rings. */
        if (g + 1 == depth && !settings->limit) return replay_last(r, report, err);
        if (!hs_reference_step(r, report->decision[g], err)) return false;
    }
    return hs_reference_finish(r, err);
}

/* --- Comparison ------------------------------------------------------------------------------- */

double hs_reference_bound(const hs_reference *r, uint32_t generations, int32_t exponent) {
    const double unit = ldexp(1, exponent - 30), rounding = 3 * 0x1p-24;
    const double transform =
        r->input_sum > 0 ? rounding / (1 - rounding) * r->input_sum + 7 * 0x1p-150 : 0;
    const double odd_steps = (generations + 1) / 2;
    const double limit = r->limit ? 0.501 : 0;
    return (0.5 + 0.751 * odd_steps + limit + 32) * unit + transform + 0x1p-150;
}

static void note(hs_reference_comparison *c, const char *what, uint32_t number, uint32_t here,
                 uint32_t golden) {
    if (c->first[0]) return;
    snprintf(c->first, sizeof c->first, "%s %u: reference %u, golden %u", what, number, here,
             golden);
}

static bool is_same_face(const hs_reference *r, const hs_output *o, uint32_t f,
                         hs_reference_comparison *c) {
    const hs_reference_final *final = &r->final[f];
    const uint32_t sides = o->first[f + 1] - o->first[f];
    if (final->v.count != sides) {
        note(c, "sides of output face", f, final->v.count, sides);
        return false;
    }
    if (final->generation != o->generation[f]) {
        note(c, "generation of output face", f, final->generation, o->generation[f]);
        return false;
    }
    if (final->candidate != o->candidate[f]) {
        note(c, "candidate bit of output face", f, final->candidate, o->candidate[f]);
        return false;
    }
    for (uint32_t k = 0; k < sides; k++) {
        const uint32_t here = r->final_vertex[final->v.first + k],
                       golden = o->number[o->corner[o->first[f] + k]];
        if (here == golden) continue;
        note(c, "vertex number in output face", f, here, golden);
        return false;
    }
    return true;
}

static void compare_faces(const hs_reference *r, const hs_output *o, hs_reference_comparison *c) {
    const uint32_t fewer = r->finals < o->faces ? r->finals : o->faces;
    c->faces = o->faces;
    for (uint32_t f = 0; f < fewer; f++)
        c->different_faces += !is_same_face(r, o, f, c);
    c->different_faces += (r->finals > o->faces ? r->finals : o->faces) - fewer;
    if (r->finals != o->faces) note(c, "faces of view", o->view, r->finals, o->faces);
}

/* Vertices that exactly one of the two sends; each of golden's must come once. */
static bool compare_vertex_sets(const hs_reference *r, const hs_output *o,
                                hs_reference_comparison *c) {
    uint8_t *used = calloc(r->vertices + 1u, 1);
    if (!used) return false;
    for (uint32_t i = 0; i < r->final_corners; i++)
        used[r->final_vertex[i]] = 1;
    for (uint32_t i = 0; i < o->vertices; i++) {
        const uint32_t v = o->number[i];
        if (v < r->vertices && used[v]) {
            used[v] = 0;
            continue;
        }
        c->different_vertices++;
        note(c, "times that a face uses vertex number", v, 0, 1);
    }
    for (uint32_t v = 0; v < r->vertices; v++) {
        if (!used[v]) continue;
        c->different_vertices++;
        note(c, "times that vertex number", v, 1, 0);
    }
    free(used);
    return true;
}

static void compare_position(const double *p, const float *q, uint32_t number,
                             hs_reference_comparison *c, double bound, double block) {
    double largest = 0;
    for (int i = 0; i < 4; i++) {
        const double distance = fabs(p[i] - (double)q[i]);
        if (isnan(distance))
            largest = INFINITY;
        else if (distance > largest)
            largest = distance;
        c->components++;
        c->equal += (float)p[i] == q[i];
    }
    if (largest > bound) {
        if (!c->first[0])
            snprintf(c->first, sizeof c->first,
                     "vertex number %u: positions differ by %.3g, allowed are %.3g", number,
                     largest, bound);
        c->beyond_bound++;
    }
    if (largest / block > c->largest_distance) {
        c->largest_distance = largest / block;
        c->largest_vertex = number;
    }
    if (outside(p) || p[3] <= 0 || q[3] <= 0) return;
    for (int i = 0; i < 2; i++) {
        const double pixels = 512 * fabs(p[i] / p[3] - (double)q[i] / (double)q[3]);
        if (pixels > c->largest_pixels) c->largest_pixels = pixels;
    }
}

/* Where a vertex of a finished replay is in the output. */
static const double *leaving_position(const hs_reference *r, uint32_t v) {
    return r->limit ? r->vertex[v].limit : r->vertex[v].position;
}

bool hs_reference_compare(const hs_reference *r, const hs_output *o, hs_reference_comparison *c) {
    *c = (hs_reference_comparison){0};
    const double bound = hs_reference_bound(r, r->generation, o->exponent);
    const double block = ldexp(1, o->exponent);
    c->bound = bound / block;
    c->vertices = o->vertices;
    compare_faces(r, o, c);
    if (!compare_vertex_sets(r, o, c)) {
        c->exhausted = true;
        return false;
    }
    for (uint32_t i = 0; i < o->vertices; i++)
        if (o->number[i] < r->vertices)
            compare_position(leaving_position(r, o->number[i]), o->position + 4 * (size_t)i,
                             o->number[i], c, bound, block);
    if (r->at_level != o->at_level) {
        c->different_at_level =
            r->at_level > o->at_level ? r->at_level - o->at_level : o->at_level - r->at_level;
        note(c, "vertices at their level's position, view", o->view, r->at_level, o->at_level);
    }
    return !c->different_faces && !c->different_vertices && !c->different_at_level &&
           !c->beyond_bound;
}
