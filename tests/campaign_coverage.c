/* SPDX-License-Identifier: Apache-2.0 */
#include "campaign_coverage.h"

/* Upper bounds of the classes, the last one without. */
static const uint32_t size_class[SIZE_CLASSES - 1] = {3, 15, 40, 100, 300};
static const uint32_t cycle_class[CYCLE_CLASSES - 1] = {300, 1000, 3000, 10000, 30000, 100000};

#define WHAT(name, what) what,
static const char *const trait_name[TRAIT_COUNT] = {TRAITS(WHAT)};
#undef WHAT

/* --- Counting -----------------------------------------------------------------------------------
 */

typedef struct traits {
    bool has[TRAIT_COUNT];
} traits;

static void see_mesh(traits *t, const hs_mesh *mesh) {
    static uint32_t valence[POLYGONS_VERTICES], leader[POLYGONS_VERTICES];
    static bool border[POLYGONS_VERTICES];
    uint32_t parts = mesh->vertices;
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        valence[v] = 0;
        border[v] = false;
        leader[v] = v;
        t->has[TRAIT_sharp_vertex] |= mesh->vertex_sharpness && mesh->vertex_sharpness[v];
    }
    t->has[TRAIT_closed] = true;
    for (uint32_t h = 0; h < mesh->halfedges; h++) {
        uint32_t v = mesh->origin[h], w = mesh->origin[hs_next(mesh, h)];
        valence[v]++;
        if (mesh->twin[h] == HS_BORDER) {
            border[v] = border[w] = true;
            t->has[TRAIT_closed] = false;
        } else {
            const uint8_t sharpness = mesh->sharpness ? mesh->sharpness[h] : 0;
            t->has[TRAIT_crease] |= sharpness > 0;
            t->has[TRAIT_finite] |= sharpness > 0 && sharpness <= HS_MAX_SHARPNESS;
        }
        while (leader[v] != v)
            v = leader[v];
        while (leader[w] != w)
            w = leader[w];
        parts -= v != w;
        leader[v] = w;
    }
    t->has[TRAIT_open] = !t->has[TRAIT_closed];
    t->has[TRAIT_parts] = parts > 1;
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        t->has[TRAIT_valence_2] |= valence[v] == 2 && !border[v];
        t->has[TRAIT_valence_5] |= valence[v] >= 5 && valence[v] < 24;
        t->has[TRAIT_pole] |= valence[v] >= 24;
    }
    for (uint32_t f = 0; f < mesh->faces; f++) {
        const uint32_t sides = hs_sides(mesh, f);
        t->has[TRAIT_triangle] |= sides == 3;
        t->has[TRAIT_ngon] |= sides >= 5 && sides < 24;
        t->has[TRAIT_large] |= sides >= 24;
        t->has[TRAIT_forced] |= mesh->forced[f] > 0;
    }
}

static void see_settings(traits *t, const hs_settings *s) {
    const uint8_t front = s->front_depth, silhouette = s->silhouette_depth;
    const bool adaptive = !s->uniform;
    t->has[TRAIT_uniform_even] = s->uniform && s->uniform_depth % 2 == 0 && s->uniform_depth;
    t->has[TRAIT_uniform_odd] = s->uniform && s->uniform_depth % 2;
    t->has[TRAIT_front_even] = adaptive && front % 2 == 0 && front;
    t->has[TRAIT_front_odd] = adaptive && front % 2;
    t->has[TRAIT_silhouette_even] = adaptive && silhouette % 2 == 0 && silhouette;
    t->has[TRAIT_silhouette_odd] = adaptive && silhouette % 2;
    t->has[TRAIT_front_more] = adaptive && front > silhouette;
    t->has[TRAIT_depth_0] = s->uniform ? s->uniform_depth == 0 : front + silhouette == 0;
    t->has[TRAIT_guard_on] = adaptive && s->guard;
    t->has[TRAIT_guard_off] = adaptive && !s->guard;
    t->has[TRAIT_limit] = s->limit;
    t->has[TRAIT_min_edge] = adaptive && s->min_edge > 0;
    t->has[TRAIT_kept] = t->has[TRAIT_open] && s->boundary == HS_BOUNDARY_KEPT;
    t->has[TRAIT_smooth] = t->has[TRAIT_open] && s->boundary == HS_BOUNDARY_SMOOTH;
    t->has[TRAIT_edge_only] = t->has[TRAIT_open] && s->boundary == HS_BOUNDARY_EDGE_ONLY;
}

static void see_run(traits *t, const hs_golden_report *report, bool uniform) {
    uint32_t steps = 0;
    for (uint32_t g = 0; g < report->generations; g++) {
        const hs_generation *generation = &report->generation[g];
        steps += generation->refined > 0;
        if (uniform) continue;
        const bool all = generation->refined == generation->active;
        t->has[TRAIT_everything] |= all && generation->active;
        t->has[TRAIT_some] |= !all && generation->refined;
        t->has[TRAIT_ring] |= generation->refined > generation->selected;
    }
    t->has[TRAIT_nothing] = !uniform && steps == 0;
    t->has[TRAIT_depth_deep] = steps >= 7;
}

static uint32_t class_of(const uint32_t *bound, uint32_t classes, uint64_t value) {
    uint32_t c = 0;
    while (c + 1 < classes && value > bound[c])
        c++;
    return c;
}

void coverage_add(coverage *sum, const campaign_case *which, const checker *c) {
    traits t = {{false}};
    hs_mesh mesh;
    hs_error err;
    const bool accepted = c->status <= HS_STATUS_STOPPED;
    if (accepted && polygons_build(&which->shape, &mesh, &err)) {
        see_mesh(&t, &mesh);
        hs_mesh_free(&mesh);
        see_settings(&t, &which->settings);
        see_run(&t, &c->bench->golden_report, which->settings.uniform);
        t.has[TRAIT_limits] = which->limits.vertices < HS_DEFAULT_LIMITS.vertices;
    }
    const hs_stalls stalls = which->stalls;
    t.has[TRAIT_stall_in] = stalls.input > 0;
    t.has[TRAIT_stall_out] = stalls.output > 0;
    t.has[TRAIT_stall_both] = stalls.input && stalls.output;
    t.has[TRAIT_refused_stalled] = !accepted && (stalls.input || stalls.output);
    for (uint32_t i = 0; i < TRAIT_COUNT; i++)
        sum->trait[i] += t.has[i];
    sum->mesh[which->mesh]++;
    sum->coordinates[which->coordinates]++;
    sum->view[which->view]++;
    sum->status[c->status % STATUSES]++;
    sum->size[class_of(size_class, SIZE_CLASSES, which->shape.faces)]++;
    sum->cycles[class_of(cycle_class, CYCLE_CLASSES, c->bench->rtl_report.cycles)]++;
}

void coverage_join(coverage *sum, const coverage *other) {
    /* All of it is counters. */
    uint64_t *to = (uint64_t *)sum;
    const uint64_t *from = (const uint64_t *)other;
    for (size_t i = 0; i < sizeof *sum / sizeof *to; i++)
        to[i] += from[i];
}

/* --- Printing -----------------------------------------------------------------------------------
 */

/* Rows of two; how many of them are 0. */
static uint32_t print_counts(const char *title, const uint64_t *count, const char *const *name,
                             uint32_t rows) {
    uint32_t none = 0;
    printf("%s\n", title);
    for (uint32_t i = 0; i < rows; i++) {
        none += count[i] == 0;
        printf("  %8llu  %-40s%s", (unsigned long long)count[i], name[i],
               i % 2 || i + 1 == rows ? "\n" : "");
    }
    return none;
}

static void print_classes(const char *title, const uint64_t *count, const uint32_t *bound,
                          uint32_t classes) {
    printf("%s\n", title);
    for (uint32_t i = 0; i < classes; i++) {
        printf("  %8llu  ", (unsigned long long)count[i]);
        if (i + 1 < classes)
            printf("up to %u\n", bound[i]);
        else
            printf("more\n");
    }
}

uint32_t coverage_print(const coverage *sum) {
    static const uint32_t statuses[] = {HS_STATUS_OK, HS_STATUS_STOPPED};
    const char *status_name[FAULTS + 2];
    uint64_t status_count[FAULTS + 2], none = 0;
    for (uint32_t i = 0; i < FAULTS + 2; i++) {
        const uint32_t status = i < 2 ? statuses[i] : FIRST_FAULT + i - 2;
        status_name[i] = hs_status_name(status);
        status_count[i] = sum->status[status];
    }
    none += print_counts("cases by mesh", sum->mesh, mesh_kind, MESHES);
    none += print_counts("by coordinates", sum->coordinates, coordinate_kind, COORDINATES);
    none += print_counts("by view", sum->view, view_kind, VIEW_TYPES);
    none += print_counts("by status", status_count, status_name, FAULTS + 2);
    none += print_counts("with", sum->trait, trait_name, TRAIT_COUNT);
    print_classes("by faces of the mesh", sum->size, size_class, SIZE_CLASSES);
    print_classes("by cycles of the view", sum->cycles, cycle_class, CYCLE_CLASSES);
    return (uint32_t)none;
}
