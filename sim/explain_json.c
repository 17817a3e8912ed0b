/* SPDX-License-Identifier: Apache-2.0
 *
 * An explanation for programs: the facts of the face and of all that it comes from.
 */
#include "explain.h"
#include "json_file.h"
#include "surface_options.h"

typedef struct maker {
    const hs_history *history;
    bool complete; /* memory was there for all that was made */
} maker;

static void set(maker *m, json_t *object, const char *key, json_t *value) {
    hs_json_set(object, key, value, &m->complete);
}

static json_t *number_or_null(uint32_t number) {
    return number == HS_HISTORY_NONE ? json_null() : json_integer(number);
}

static json_t *settings_of(maker *m) {
    const hs_settings *s = &m->history->settings;
    json_t *o = json_object();
    set(m, o, "uniform", s->uniform ? json_integer(s->uniform_depth) : json_null());
    set(m, o, "front", json_integer(s->front_depth));
    set(m, o, "silhouette", json_integer(s->silhouette_depth));
    set(m, o, "guard", json_integer(s->guard));
    set(m, o, "boundary", json_string(hs_boundary_name(s->boundary)));
    set(m, o, "limit", json_boolean(s->limit));
    set(m, o, "min_edge_px",
        s->min_edge ? json_real((double)s->min_edge / HS_PIXEL_FRACTION) : json_null());
    set(m, o, "depth", json_integer(m->history->depth));
    return o;
}

static json_t *vertices_of(maker *m, uint32_t g, uint32_t f) {
    static const struct {
        const char *name;
        uint8_t mark;
    } MARK[] = {{"front", MARK_FRONT},   {"back", MARK_BACK}, {"hits", MARK_HITS},
                {"border", MARK_BORDER}, {"held", MARK_HELD}, {"chosen", MARK_CHOSEN}};
    const hs_past *p = &m->history->past[g];
    json_t *vertices = json_array();
    for (uint32_t i = 0; i < p->sides[f]; i++) {
        const uint32_t v = p->origin[p->first[f] + i];
        json_t *o = json_object();
        set(m, o, "vertex", json_integer(v));
        for (size_t k = 0; p->decided && k < sizeof MARK / sizeof *MARK; k++)
            set(m, o, MARK[k].name, json_boolean(p->mark[v] & MARK[k].mark));
        hs_json_append(vertices, o, &m->complete);
    }
    return vertices;
}

static json_t *rule_of(maker *m, uint32_t g, uint32_t f) {
    uint32_t parent[2];
    if (!hs_history_parents(m->history, g, f, parent)) return json_null();
    const hs_past *p = &m->history->past[g];
    json_t *o = json_object();
    const uint32_t *corner = p->origin + p->first[f];
    set(m, o, "edge", json_pack("[I,I]", (json_int_t)corner[2], (json_int_t)corner[0]));
    set(m, o, "faces", json_pack("[I,I]", (json_int_t)parent[0], (json_int_t)parent[1]));
    set(m, o, "boundary", json_boolean((p - 1)->twin[p->parent[f]] == BOUNDARY_TWIN));
    return o;
}

static json_t *face_of(maker *m, uint32_t g, uint32_t f) {
    static const struct {
        const char *name;
        uint32_t term;
    } TERM[] = {{"candidate", TERM_CANDIDATE},
                {"in_view", TERM_IN_VIEW},
                {"stop", TERM_STOP},
                {"front", TERM_FRONT},
                {"front_due", TERM_FRONT_DUE},
                {"silhouette", TERM_SILHOUETTE},
                {"silhouette_due", TERM_SILHOUETTE_DUE},
                {"forced_due", TERM_FORCED},
                {"uniform", TERM_UNIFORM}};
    const hs_past *p = &m->history->past[g];
    json_t *o = json_object();
    set(m, o, "generation", json_integer(g));
    set(m, o, "face", json_integer(f));
    set(m, o, "initial",
        json_pack("[I,I]", (json_int_t)p->within[f][0], (json_int_t)p->within[f][1]));
    set(m, o, "made_of", rule_of(m, g, f));
    set(m, o, "vertices", vertices_of(m, g, f));
    if (p->decided) {
        set(m, o, "facing", json_string(hs_facing_of(m->history, g, f)));
        set(m, o, "forced", json_integer(p->forced[f]));
        json_t *terms = json_object();
        for (size_t k = 0; k < sizeof TERM / sizeof *TERM; k++)
            set(m, terms, TERM[k].name, json_boolean(p->term[f] & TERM[k].term));
        set(m, o, "terms", terms);
        set(m, o, "selected", json_boolean(p->decision[f] & FACE_SELECTED));
        set(m, o, "refined", json_boolean(!p->finish && p->decision[f] & FACE_REFINED));
    }
    const hs_outcome outcome = hs_outcome_of(m->history, g, f);
    uint32_t vertex, selected;
    if (outcome == HS_OUTCOME_GUARD && hs_guard_witness(m->history, g, f, &vertex, &selected))
        set(m, o, "guard",
            json_pack("{s:I,s:I}", "vertex", (json_int_t)vertex, "face", (json_int_t)selected));
    set(m, o, "outcome", json_string(hs_outcome_name(outcome)));
    char why[600];
    hs_explain_why(m->history, g, f, why, sizeof why);
    set(m, o, "why", json_string(why));
    set(m, o, "output", number_or_null(p->output[f]));
    return o;
}

static json_t *inside_of(maker *m, uint32_t initial) {
    const hs_history *history = m->history;
    json_t *all = json_array();
    for (uint32_t g = 0; g < history->generations; g++) {
        const hs_inside inside = hs_inside_of(history, g, initial);
        if (inside.faces == 0) break;
        json_t *o = json_object(), *reasons = json_array(), *outputs = json_array();
        set(m, o, "generation", json_integer(g));
        set(m, o, "faces", json_integer(inside.faces));
        set(m, o, "selected", json_integer(inside.selected));
        set(m, o, "guard", json_integer(inside.guard));
        set(m, o, "final", json_integer(inside.final));
        set(m, o, "triangles", json_integer(inside.triangles));
        hs_reason reason[HS_REASONS_MOST];
        const uint32_t count = hs_reasons_of(history, g, initial, reason);
        for (uint32_t r = 0; r < count; r++) {
            char why[300];
            hs_explain_terms(history, g, reason[r].face, why, sizeof why);
            json_t *one = json_object();
            set(m, one, "faces", json_integer(reason[r].count));
            set(m, one, "why", json_string(why));
            hs_json_append(reasons, one, &m->complete);
        }
        set(m, o, "not_selected", reasons);
        const hs_past *p = &history->past[g];
        for (uint32_t f = 0; f < p->faces; f++)
            if (p->output[f] != HS_HISTORY_NONE && hs_lies_in(history, g, f, initial))
                hs_json_append(outputs, json_integer(p->output[f]), &m->complete);
        set(m, o, "outputs", outputs);
        hs_json_append(all, o, &m->complete);
    }
    return all;
}

static json_t *document(maker *m, const hs_subject *subject, const hs_ancestors *a,
                        const char *mesh, uint32_t view) {
    const hs_past *p = &m->history->past[subject->generation];
    json_t *root = json_object(), *faces = json_array();
    set(m, root, "mesh", json_string(mesh));
    set(m, root, "view", json_integer(view));
    set(m, root, "settings", settings_of(m));
    set(m, root, "status", json_string(hs_status_name(m->history->status)));
    set(m, root, "asked", json_string(subject->asked));
    set(m, root, "generation", json_integer(subject->generation));
    set(m, root, "face", json_integer(subject->face));
    set(m, root, "output", number_or_null(subject->output));
    if (subject->halfedge != HS_HISTORY_NONE) {
        const uint32_t i = subject->halfedge - p->first[subject->face];
        set(m, root, "triangle",
            json_pack(
                "[I,I,I]", (json_int_t)p->origin[subject->halfedge],
                (json_int_t)p->origin[p->first[subject->face] + (i + 1) % p->sides[subject->face]],
                (json_int_t)p->number[subject->face]));
    }
    for (uint32_t g = 0; g <= subject->generation; g++)
        for (uint32_t i = 0; i < a->count[g]; i++)
            hs_json_append(faces, face_of(m, g, a->face[g][i]), &m->complete);
    set(m, root, "faces", faces);
    if (subject->generation == 0 && subject->halfedge == HS_HISTORY_NONE)
        set(m, root, "inside", inside_of(m, subject->face));
    return root;
}

bool hs_explain_write(const char *path, const hs_history *history, const hs_subject *subject,
                      const char *mesh, uint32_t view, hs_error *err) {
    hs_ancestors a;
    if (!hs_ancestors_find(&a, history, subject->generation, subject->face, err)) return false;
    maker m = {.history = history, .complete = true};
    json_t *root = document(&m, subject, &a, mesh, view);
    hs_ancestors_free(&a);
    hs_file file;
    const bool good =
        (m.complete || hs_fail(err, HS_EXIT_INTERNAL, "%.300s: no memory for it", path)) &&
        hs_file_create(&file, path, err) &&
        hs_json_commit(root, JSON_INDENT(1) | JSON_REAL_PRECISION(9), &file, err);
    json_decref(root);
    return good;
}
