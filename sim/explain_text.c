/* SPDX-License-Identifier: Apache-2.0
 *
 * An explanation for people: a row for every face that matters, its reason beside it.
 */
#include "explain.h"

#include <string.h>

#include "surface_options.h"
#include "terminal.h"

static void print_title(FILE *stream, const hs_history *history, const hs_subject *subject,
                        const char *mesh, uint32_t view) {
    const hs_settings *s = &history->settings;
    char text[600], how[100];
    if (s->uniform)
        snprintf(how, sizeof how, "uniform %u", s->uniform_depth);
    else
        snprintf(how, sizeof how, "front %u, silhouette %u, guard %d", s->front_depth,
                 s->silhouette_depth, s->guard);
    snprintf(text, sizeof text, "%.300s, view %u; %s, boundary %s", mesh, view, how,
             hs_boundary_name(s->boundary));
    hs_print_wrapped(stream, 0, 2, text);
    const hs_past *p = &history->past[subject->generation];
    if (subject->halfedge != HS_HISTORY_NONE)
        snprintf(text, sizeof text, "%s: a triangle of generation %u, at a kept edge of face %u:%u",
                 subject->asked, subject->generation, subject->generation, subject->face);
    else
        snprintf(text, sizeof text, "%s: face %u:%u, of generation %u, %u sides", subject->asked,
                 subject->generation, subject->face, subject->generation, p->sides[subject->face]);
    if (subject->output != HS_HISTORY_NONE && !strstr(subject->asked, "output"))
        snprintf(text + strlen(text), sizeof text - strlen(text), ", face %u of the output",
                 subject->output);
    const uint32_t *within = p->within[subject->face];
    if (subject->generation && within[0] == within[1])
        snprintf(text + strlen(text), sizeof text - strlen(text), ", in initial face %u",
                 within[0]);
    else if (subject->generation)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 ", half in initial face %u, half in %u", within[0], within[1]);
    hs_print_wrapped(stream, 0, 2, text);
}

/* A row of the table: the facts of an active face, and what follows from them. */
static void print_face(FILE *stream, const hs_history *history, uint32_t g, uint32_t f) {
    const hs_past *p = &history->past[g];
    char text[600], name[24], silhouette[12] = "-";
    const bool marked = p->decided && !history->settings.uniform;
    snprintf(name, sizeof name, "%u:%u", g, f);
    if (marked)
        snprintf(silhouette, sizeof silhouette, "%u/%u", hs_silhouette_vertices(history, g, f),
                 p->sides[f]);
    const int column =
        fprintf(stream, "%-12s %-6s %-4s %-6s %-5s ", name, hs_facing_of(history, g, f),
                marked ? (p->term[f] & TERM_IN_VIEW ? "in" : "out") : "-", silhouette,
                marked ? (p->term[f] & TERM_CANDIDATE ? "yes" : "no") : "-");
    hs_explain_why(history, g, f, text, sizeof text);
    hs_print_wrapped(stream, column, column, text);
    if (g == 0) return;
    hs_explain_rule(history, g, f, text, sizeof text);
    fprintf(stream, "%*s", 13, "");
    hs_print_wrapped(stream, 13, 13, text);
}

/* The triangle of a refined face: the face beyond its edge was not refined. */
static void print_triangle(FILE *stream, const hs_history *history, const hs_subject *subject) {
    const uint32_t g = subject->generation, f = subject->face;
    const hs_past *p = &history->past[g];
    const uint32_t i = subject->halfedge - p->first[f], twin = p->twin[subject->halfedge];
    const uint32_t v = p->origin[subject->halfedge];
    const uint32_t w = p->origin[p->first[f] + (i + 1) % p->sides[f]];
    char text[400];
    if (twin == HS_BORDER) {
        snprintf(text, sizeof text,
                 "half-edge rule: edge %u-%u has no active face beyond, so it is kept: triangle "
                 "%u %u %u, final",
                 v, w, v, w, p->number[f]);
    } else {
        const uint32_t beyond = hs_history_face_of(history, g, twin);
        print_face(stream, history, g, beyond);
        snprintf(text, sizeof text,
                 "half-edge rule: face %u:%u beyond edge %u-%u is not refined, so the edge is "
                 "kept: triangle %u %u %u, final",
                 g, beyond, v, w, v, w, p->number[f]);
    }
    fputc('\n', stream);
    hs_print_wrapped(stream, 0, 2, text);
}

static void print_inside(FILE *stream, const hs_history *history, uint32_t initial) {
    fprintf(stream,
            "\nwhat lies in it   faces selected guard ring  final  triangles at kept edges\n");
    for (uint32_t g = 0; g < history->generations; g++) {
        const hs_inside inside = hs_inside_of(history, g, initial);
        if (inside.faces == 0) break;
        fprintf(stream, "generation %3u %8u %8u %10u %6u %10u\n", g, inside.faces, inside.selected,
                inside.guard, inside.final, inside.triangles);
        hs_reason reason[HS_REASONS_MOST];
        const uint32_t reasons = hs_reasons_of(history, g, initial, reason);
        for (uint32_t r = 0; r < reasons; r++) {
            char text[300];
            hs_explain_terms(history, g, reason[r].face, text, sizeof text);
            const int column = fprintf(stream, "%4snot selected, %u: ", "", reason[r].count);
            hs_print_wrapped(stream, column, 6, text);
        }
    }
}

bool hs_explain_print(FILE *stream, const hs_history *history, const hs_subject *subject,
                      const char *mesh, uint32_t view, hs_error *err) {
    hs_ancestors a;
    if (!hs_ancestors_find(&a, history, subject->generation, subject->face, err)) return false;
    print_title(stream, history, subject, mesh, view);
    fprintf(stream, "\nface         facing view silh.  cand. why\n");
    for (uint32_t g = 0; g <= subject->generation; g++) {
        print_face(stream, history, g, a.line[g]);
        for (uint32_t i = 0; i < a.count[g]; i++)
            if (a.face[g][i] != a.line[g] &&
                hs_outcome_of(history, g, a.face[g][i]) != HS_OUTCOME_SELECTED)
                print_face(stream, history, g, a.face[g][i]);
    }
    if (subject->halfedge != HS_HISTORY_NONE) print_triangle(stream, history, subject);
    if (subject->generation == 0 && subject->halfedge == HS_HISTORY_NONE)
        print_inside(stream, history, subject->face);
    hs_ancestors_free(&a);
    return true;
}
