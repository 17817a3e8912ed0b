/* SPDX-License-Identifier: Apache-2.0 */
#include "explain.h"

#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* Appends to a text what still fits. */
static void add(char *text, size_t size, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static void add(char *text, size_t size, const char *format, ...) {
    const size_t used = strlen(text);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text + used, size - used, format, arguments);
    va_end(arguments);
}

/* --- Facts --------------------------------------------------------------------------------------
 */

const char *hs_outcome_name(hs_outcome outcome) {
    static const char *const name[] = {"selected", "guard", "final", "stopped", "last"};
    return name[outcome];
}

hs_outcome hs_outcome_of(const hs_history *history, uint32_t generation, uint32_t face) {
    const hs_past *p = &history->past[generation];
    if (!p->decided) return HS_OUTCOME_LAST;
    if (p->stopped) return HS_OUTCOME_STOPPED;
    if (p->finish || !(p->decision[face] & FACE_REFINED)) return HS_OUTCOME_FINAL;
    return p->decision[face] & FACE_SELECTED ? HS_OUTCOME_SELECTED : HS_OUTCOME_GUARD;
}

const char *hs_facing_of(const hs_history *history, uint32_t generation, uint32_t face) {
    const hs_past *p = &history->past[generation];
    const uint8_t mark = p->decided ? p->face_mark[face] : 0;
    return mark & MARK_FRONT  ? (mark & MARK_BACK ? "both" : "front")
           : mark & MARK_BACK ? "back"
                              : "-";
}

static const uint32_t *corners_of(const hs_past *p, uint32_t face) {
    return p->origin + p->first[face];
}

uint32_t hs_silhouette_vertices(const hs_history *history, uint32_t generation, uint32_t face) {
    const hs_past *p = &history->past[generation];
    uint32_t count = 0;
    for (uint32_t i = 0; p->decided && i < p->sides[face]; i++) {
        const uint8_t mark = p->mark[corners_of(p, face)[i]];
        count += (mark & MARK_FRONT) && (mark & MARK_BACK);
    }
    return count;
}

bool hs_guard_witness(const hs_history *history, uint32_t generation, uint32_t face,
                      uint32_t *vertex, uint32_t *selected) {
    const hs_past *p = &history->past[generation];
    for (uint32_t i = 0; p->decided && i < p->sides[face]; i++) {
        *vertex = corners_of(p, face)[i];
        if (!(p->mark[*vertex] & MARK_CHOSEN)) continue;
        for (uint32_t f = 0; f < p->faces; f++)
            for (uint32_t k = 0; (p->decision[f] & FACE_SELECTED) && k < p->sides[f]; k++)
                if (corners_of(p, f)[k] == *vertex) {
                    *selected = f;
                    return true;
                }
    }
    return false;
}

/* --- Words --------------------------------------------------------------------------------------
 */

/* What was wanted, if it was; else, what stood against it. */
static void add_wishes(char *text, size_t size, const hs_settings *settings, uint32_t term,
                       uint32_t forced) {
    const char *comma = "";
    if (hs_is_wanted(term)) {
        if (hs_all_terms(term, TERM_FRONT | TERM_FRONT_DUE)) {
            add(text, size, "front, depth %u", settings->front_depth);
            comma = "; ";
        }
        if (hs_all_terms(term, TERM_SILHOUETTE | TERM_SILHOUETTE_DUE)) {
            add(text, size, "%ssilhouette, depth %u", comma, settings->silhouette_depth);
            comma = "; ";
        }
    }
    if (term & TERM_FORCED) add(text, size, "%sforced to depth %u", comma, forced);
}

static void add_obstacles(char *text, size_t size, const hs_settings *settings, uint32_t term) {
    if (!(term & TERM_IN_VIEW)) {
        add(text, size, "outside the view volume");
    } else if (term & TERM_STOP) {
        add(text, size, "all edges are shorter than %g pixels",
            (double)settings->min_edge / HS_PIXEL_FRACTION);
    } else {
        if (term & TERM_FRONT)
            add(text, size, "depth %u of front faces is reached", settings->front_depth);
        else
            add(text, size, "back-facing");
        if (term & TERM_SILHOUETTE)
            add(text, size, ", depth %u of silhouettes is reached", settings->silhouette_depth);
        else
            add(text, size, ", no silhouette vertex");
    }
}

void hs_explain_terms(const hs_history *history, uint32_t generation, uint32_t face, char *text,
                      size_t size) {
    const hs_past *p = &history->past[generation];
    const hs_settings *settings = &history->settings;
    text[0] = 0;
    if (!p->decided) {
        add(text, size, "depth %u is reached", history->depth);
        return;
    }
    const uint32_t term = p->term[face];
    if (term & TERM_UNIFORM)
        add(text, size, "uniform depth %u%s", settings->uniform_depth,
            generation < history->depth ? "" : " is reached");
    else if (hs_is_wanted(term) || (term & TERM_FORCED))
        add_wishes(text, size, settings, term, p->forced[face]);
    else
        add_obstacles(text, size, settings, term);
    if (!(term & (TERM_CANDIDATE | TERM_UNIFORM)))
        add(text, size, "%s",
            hs_is_wanted(term) || (term & TERM_FORCED) ? ", but no candidate" : ", no candidate");
}

/* Which of its parents made it no candidate. */
static void add_parents(char *text, size_t size, const hs_history *history, uint32_t generation,
                        uint32_t face) {
    const hs_past *p = &history->past[generation];
    uint32_t parent[2];
    if (!p->decided || (p->term[face] & (TERM_CANDIDATE | TERM_UNIFORM)) ||
        !hs_history_parents(history, generation, face, parent))
        return;
    const uint8_t *decision = history->past[generation - 1].decision;
    const char *and = "";
    add(text, size, " (");
    for (int i = 0; i < 2; i++)
        if (!(decision[parent[i]] & FACE_SELECTED)) {
            add(text, size, "%s%u:%u", and, generation - 1, parent[i]);
            and = " and ";
            if (parent[0] == parent[1]) break;
        }
    add(text, size, " not selected)");
}

void hs_explain_why(const hs_history *history, uint32_t generation, uint32_t face, char *text,
                    size_t size) {
    char terms[300];
    hs_explain_terms(history, generation, face, terms, sizeof terms);
    add_parents(terms, sizeof terms, history, generation, face);
    const hs_past *p = &history->past[generation];
    const bool ring = history->settings.guard && !history->settings.uniform;
    uint32_t vertex, selected;
    text[0] = 0;
    switch (hs_outcome_of(history, generation, face)) {
    case HS_OUTCOME_SELECTED:
        add(text, size, "selected: %s", terms);
        break;
    case HS_OUTCOME_GUARD:
        add(text, size, "guard ring");
        if (hs_guard_witness(history, generation, face, &vertex, &selected))
            add(text, size, ": vertex %u is a corner of selected face %u:%u", vertex, generation,
                selected);
        add(text, size, "; itself not selected: %s", terms);
        break;
    case HS_OUTCOME_FINAL:
        add(text, size, "final: %s", terms);
        if (!p->finish)
            add(text, size, "; %s", ring ? "no corner of a selected face" : "there is no guard");
        else if (p->selected == 0)
            add(text, size, "; nothing is selected");
        break;
    case HS_OUTCOME_STOPPED:
        add(text, size, "final: a capacity stopped the view; else %s: %s",
            p->decision[face] & FACE_SELECTED  ? "selected"
            : p->decision[face] & FACE_REFINED ? "guard ring"
                                               : "not selected",
            terms);
        break;
    case HS_OUTCOME_LAST:
        add(text, size, "final: %s, it leaves as it is made", terms);
        break;
    }
}

void hs_explain_rule(const hs_history *history, uint32_t generation, uint32_t face, char *text,
                     size_t size) {
    uint32_t parent[2];
    text[0] = 0;
    if (!hs_history_parents(history, generation, face, parent)) {
        add(text, size, "initial face");
        return;
    }
    const hs_past *p = &history->past[generation], *before = p - 1;
    const uint32_t *corner = corners_of(p, face); /* (w, F, v, G) */
    if (before->twin[p->parent[face]] == BOUNDARY_TWIN)
        add(text, size, "half-quad of boundary edge %u-%u of face %u:%u", corner[2], corner[0],
            generation - 1, parent[0]);
    else
        add(text, size, "quad of edge %u-%u, faces %u:%u and %u:%u", corner[2], corner[0],
            generation - 1, parent[0], generation - 1, parent[1]);
}

/* --- Where it comes from ------------------------------------------------------------------------
 */

static int by_number(const void *a, const void *b) {
    const uint32_t x = *(const uint32_t *)a, y = *(const uint32_t *)b;
    return (x > y) - (x < y);
}

/* The parent that an even generation's face lies in half of, and the one of that which it lies in:
 * the side of its half-edge. */
static uint32_t line_parent(const hs_history *history, uint32_t generation, uint32_t face,
                            uint32_t after) {
    uint32_t parent[2];
    hs_history_parents(history, generation, face, parent);
    if (generation % 2 == 0 || after == HS_HISTORY_NONE) return parent[0];
    return parent[history->past[generation + 1].parent[after] % 4 / 2];
}

bool hs_ancestors_find(hs_ancestors *a, const hs_history *history, uint32_t generation,
                       uint32_t face, hs_error *err) {
    *a = (hs_ancestors){0};
    uint32_t after = HS_HISTORY_NONE;
    for (uint32_t g = generation + 1; g-- > 0;) {
        const uint32_t children = g == generation ? 0 : a->count[g + 1];
        a->face[g] = malloc((2 * (size_t)children + 1) * sizeof *a->face[g]);
        if (!a->face[g]) {
            hs_ancestors_free(a);
            return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a face's ancestors");
        }
        if (g == generation) {
            a->line[g] = a->face[g][a->count[g]++] = face;
            continue;
        }
        a->line[g] = line_parent(history, g + 1, a->line[g + 1], after);
        after = a->line[g + 1];
        for (uint32_t i = 0; i < children; i++)
            hs_history_parents(history, g + 1, a->face[g + 1][i], &a->face[g][2 * i]);
        qsort(a->face[g], 2 * (size_t)children, sizeof *a->face[g], by_number);
        for (uint32_t i = 0; i < 2 * children; i++)
            if (i == 0 || a->face[g][i] != a->face[g][a->count[g] - 1])
                a->face[g][a->count[g]++] = a->face[g][i];
    }
    return true;
}

void hs_ancestors_free(hs_ancestors *a) {
    for (size_t g = 0; g < sizeof a->face / sizeof *a->face; g++)
        free(a->face[g]);
    *a = (hs_ancestors){0};
}

/* --- What becomes of an initial face ------------------------------------------------------------
 */

bool hs_lies_in(const hs_history *history, uint32_t generation, uint32_t face, uint32_t initial) {
    const uint32_t *within = history->past[generation].within[face];
    return within[0] == initial || within[1] == initial;
}

/* Whether the triangle at a side of a face lies in an initial face. */
static bool side_lies_in(const hs_past *p, uint32_t generation, uint32_t face, uint32_t side,
                         uint32_t initial) {
    return p->within[face][generation % 2 ? side / 2 : 0] == initial;
}

hs_inside hs_inside_of(const hs_history *history, uint32_t generation, uint32_t initial) {
    const hs_past *p = &history->past[generation];
    hs_inside inside = {0};
    for (uint32_t f = 0; f < p->faces; f++) {
        if (!hs_lies_in(history, generation, f, initial)) continue;
        const hs_outcome outcome = hs_outcome_of(history, generation, f);
        inside.faces++;
        inside.selected += outcome == HS_OUTCOME_SELECTED;
        inside.guard += outcome == HS_OUTCOME_GUARD;
        inside.final += outcome > HS_OUTCOME_GUARD;
        for (uint32_t i = 0; i < p->sides[f]; i++)
            inside.triangles += p->triangle[p->first[f] + i] != HS_HISTORY_NONE &&
                                side_lies_in(p, generation, f, i, initial);
    }
    return inside;
}

uint32_t hs_reasons_of(const hs_history *history, uint32_t generation, uint32_t initial,
                       hs_reason reason[HS_REASONS_MOST]) {
    const hs_past *p = &history->past[generation];
    uint32_t reasons = 0;
    for (uint32_t f = 0; f < p->faces; f++) {
        if (!hs_lies_in(history, generation, f, initial) ||
            hs_outcome_of(history, generation, f) == HS_OUTCOME_SELECTED)
            continue;
        char text[300], other[300];
        hs_explain_terms(history, generation, f, text, sizeof text);
        uint32_t r = 0;
        for (; r < reasons; r++) {
            hs_explain_terms(history, generation, reason[r].face, other, sizeof other);
            if (strcmp(text, other) == 0) break;
        }
        if (r < reasons)
            reason[r].count++;
        else if (reasons < HS_REASONS_MOST)
            reason[reasons++] = (hs_reason){1, f};
    }
    return reasons;
}
