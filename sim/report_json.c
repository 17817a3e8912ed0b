/* SPDX-License-Identifier: Apache-2.0 */
#include "report_json.h"

#include <math.h>
#include <string.h>

#include "json_file.h"
#include "machine.h"
#include "options.h"
#include "surface_options.h"

/* One flag for all of it, so that the code below reads as the report does. */
typedef struct report {
    bool complete; /* memory was there for all that was made */
} report;

static void set(report *r, json_t *object, const char *key, json_t *value) {
    hs_json_set(object, key, value, &r->complete);
}
static void append(report *r, json_t *array, json_t *value) {
    hs_json_append(array, value, &r->complete);
}
static void set_count(report *r, json_t *object, const char *key, uint64_t value) {
    set(r, object, key, json_integer((json_int_t)value));
}
static void set_text(report *r, json_t *object, const char *key, const char *text) {
    set(r, object, key, text ? json_string(text) : json_null());
}
/* JSON knows no infinities: null. */
static void set_real(report *r, json_t *object, const char *key, double value) {
    set(r, object, key, isfinite(value) ? json_real(value) : json_null());
}
static void set_hex(report *r, json_t *object, const char *key, uint32_t value) {
    char text[11];
    snprintf(text, sizeof text, "0x%08x", value);
    set_text(r, object, key, text);
}

/* --- Settings -----------------------------------------------------------------------------------
 */

static json_t *settings_of(report *r, const hs_run *run) {
    const hs_run_request *q = run->request;
    json_t *s = json_object(), *engines = json_array();
    set(r, s, "uniform",
        q->settings.uniform ? json_integer(q->settings.uniform_depth) : json_null());
    set_count(r, s, "front", q->settings.front_depth);
    set_count(r, s, "silhouette", q->settings.silhouette_depth);
    set_count(r, s, "guard", q->settings.guard);
    set_text(r, s, "boundary", hs_boundary_name(q->settings.boundary));
    set(r, s, "limit", json_boolean(q->settings.limit));
    set(r, s, "min_edge_px",
        q->settings.min_edge ? json_real((double)q->settings.min_edge / HS_PIXEL_FRACTION)
                             : json_null());
    set_text(r, s, "force", q->force);
    set_count(r, s, "depth", run->depth);
    for (int e = 0; e < HS_ENGINES; e++)
        if (q->engines >> e & 1) append(r, engines, json_string(hs_engine_name((enum hs_engine)e)));
    set(r, s, "engines", engines);
    set(r, s, "size", json_pack("[i,i]", (int)q->width, (int)q->height));
    set(r, s, "stalls", json_pack("[i,i]", q->stalls.input, q->stalls.output));
    set_count(r, s, "seed", q->stalls.seed);
    set_count(r, s, "max_vertices", q->limits.vertices);
    set_count(r, s, "max_quads", q->limits.quads);
    return s;
}

static json_t *mesh_of(report *r, const hs_run *run) {
    json_t *m = json_object();
    set_text(r, m, "source", run->request->mesh);
    set(r, m, "frames", run->frames.count ? json_integer(run->frames.count) : json_null());
    /* Of a deforming mesh, the first that ran. */
    set_count(r, m, "vertices", run->done ? run->view[0].mesh_vertices : run->mesh.vertices);
    set_count(r, m, "faces", run->done ? run->view[0].mesh_faces : run->mesh.faces);
    set_count(r, m, "halfedges", run->done ? run->view[0].mesh_halfedges : run->mesh.halfedges);
    return m;
}

/* The view's own mesh, where it has one. */
static json_t *frame_of(report *r, const hs_run *run, const hs_run_view *view) {
    char name[4096];
    hs_error ignored;
    json_t *m = json_object();
    const bool named = hs_frames_name(&run->frames, run->frames.count > 1 ? view->number : 0, name,
                                      sizeof name, &ignored);
    set_text(r, m, "source", named ? name : NULL);
    set_count(r, m, "vertices", view->mesh_vertices);
    set_count(r, m, "faces", view->mesh_faces);
    set_count(r, m, "halfedges", view->mesh_halfedges);
    return m;
}

/* --- The program and the machine ----------------------------------------------------------------
 */

static json_t *versions_of(report *r) {
    json_t *v = json_object();
    set_text(r, v, "halfstep", HS_VERSION);
    set_count(r, v, "stream", HS_STREAM_VERSION);
    set_text(r, v, "commit", hs_program.commit);
    set_text(r, v, "compiler", hs_program.compiler);
    set_text(r, v, "simulator", hs_program.simulator);
    return v;
}

static json_t *machine_of(report *r) {
    hs_machine machine;
    hs_machine_read(&machine);
    json_t *m = json_object();
    set_text(r, m, "system", machine.system);
    set_text(r, m, "processor", machine.processor);
    set_count(r, m, "cores", machine.cores);
    set_count(r, m, "memory", machine.memory);
    return m;
}

/* --- Views --------------------------------------------------------------------------------------
 */

static json_t *stages_of(report *r, const hs_run_view *view, const hs_cycle_report *c) {
    json_t *stages = json_object();
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        json_t *stage = json_object();
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
            set_count(r, stage, hs_activity_name(a), c->activity[s][a]);
        set_count(r, stage, "items", c->items_in[s]);
        set_count(r, stage, "bound", view->bound.stage[s]);
        set(r, stages, hs_stage_name(s), stage);
    }
    return stages;
}

static json_t *cycles_or_null(uint64_t cycles) {
    return cycles == HS_NO_CYCLE ? json_null() : json_integer((json_int_t)cycles);
}

static json_t *engine_of(report *r, const hs_run_view *view, enum hs_engine engine) {
    const hs_engine_result *result = &view->engine[engine];
    json_t *e = json_object();
    set_count(r, e, "vertices", result->vertices);
    set_count(r, e, "faces", result->faces);
    set_count(r, e, "triangles", result->triangles);
    set_count(r, e, "at_level", result->at_level);
    const bool timed = hs_engine_timed(engine);
    const hs_cycle_report *c = &view->cycles[engine];
    set(r, e, "cycles", timed ? json_integer((json_int_t)c->cycles) : json_null());
    set_text(r, e, "status", hs_status_name(result->status));
    set(r, e, "position",
        result->error_position == HS_NO_POSITION ? json_null()
                                                 : json_integer(result->error_position));
    set_real(r, e, "seconds", result->seconds);
    if (result->words) {
        set_count(r, e, "words", result->words);
        set_hex(r, e, "digest", result->digest);
    }
    if (timed) {
        set_count(r, e, "first_out", c->first_out - c->start);
        set(r, e, "first_face", cycles_or_null(view->latency[engine].first_face));
        set(r, e, "trailer", cycles_or_null(view->latency[engine].trailer));
        set_count(r, e, "conflicts", c->conflicts);
        set(r, e, "ratio",
            view->bound.total ? json_real((double)c->cycles / (double)view->bound.total)
                              : json_null());
        set(r, e, "stages", stages_of(r, view, c));
    }
    if (engine == HS_ENGINE_reference) {
        json_t *d = json_object();
        set_count(r, d, "faces", view->decisions.faces);
        set_count(r, d, "selected_different", view->decisions.selected_different);
        set_count(r, d, "refined_different", view->decisions.refined_different);
        set(r, e, "decisions", d);
    }
    return e;
}

static json_t *generations_of(report *r, const hs_run_view *view) {
    json_t *generations = json_array();
    for (uint32_t i = 0; i < view->generations; i++) {
        const hs_generation *g = &view->generation[i];
        json_t *o = json_object();
        set_count(r, o, "active", g->active);
        set_count(r, o, "selected", g->selected);
        set_count(r, o, "refined", g->refined);
        set_count(r, o, "final", g->final);
        set_count(r, o, "corners", g->corners);
        set_count(r, o, "boundary", g->boundary);
        set_count(r, o, "vertices", g->vertices);
        set_count(r, o, "moved", g->moved);
        set(r, o, "cycle",
            view->generation_cycle ? cycles_or_null(view->generation_cycle[i]) : json_null());
        append(r, generations, o);
    }
    return generations;
}

static json_t *comparisons_of(report *r, const hs_run_view *view) {
    json_t *comparisons = json_array();
    for (uint32_t i = 0; i < view->comparisons; i++) {
        const hs_comparison *c = &view->comparison[i];
        json_t *o = json_object();
        set_text(r, o, "a", hs_engine_name(c->a));
        set_text(r, o, "b", hs_engine_name(c->b));
        set_text(r, o, "what", c->what);
        set_count(r, o, "compared", c->compared);
        set_count(r, o, "different", c->different);
        if (strcmp(c->what, "positions") == 0) {
            const hs_reference_comparison *p = &view->reference;
            set_real(r, o, "bound", p->bound);
            set_real(r, o, "largest_distance", p->largest_distance);
            set_real(r, o, "largest_pixels", p->largest_pixels);
            set_count(r, o, "components", p->components);
            set_count(r, o, "components_equal", p->equal);
        }
        append(r, comparisons, o);
    }
    return comparisons;
}

static json_t *pictures_of(report *r, const hs_run_pictures_report *report) {
    json_t *pictures = json_object(), *comparisons = json_array();
    set_count(r, pictures, "reference_level", report->reference_level);
    set_count(r, pictures, "reference_faces", report->reference_faces);
    for (uint32_t i = 0; i < report->comparisons; i++) {
        const hs_run_picture_comparison *c = &report->comparison[i];
        json_t *o = json_object();
        set_text(r, o, "a", c->a);
        set_text(r, o, "b", c->b);
        set_text(r, o, "what", c->what);
        set_count(r, o, "pixels", c->difference.pixels);
        set_count(r, o, "different", c->difference.different);
        set_count(r, o, "visible", c->difference.visible);
        set_real(r, o, "psnr", c->difference.psnr);
        set_real(r, o, "silhouette_mean", c->difference.mean);
        set_real(r, o, "silhouette_maximum", c->difference.maximum);
        append(r, comparisons, o);
    }
    set(r, pictures, "comparisons", comparisons);
    return pictures;
}

/* What a frame is beside the one before it; null where there is none. */
static json_t *step_of(report *r, const hs_path_step *step) {
    json_t *o = json_object();
    const uint32_t values[] = {step->kept,   step->gained,   step->lost,
                               step->shared, step->compared, step->moved};
    static const char *const key[] = {"faces_kept",      "faces_gained",      "faces_lost",
                                      "vertices_shared", "vertices_compared", "vertices_moved"};
    for (int i = 0; i < 6; i++)
        set(r, o, key[i], step->first ? json_null() : json_integer(values[i]));
    set_count(r, o, "vertices_settled", step->settled);
    const double all = step->reached + step->short_of;
    set(r, o, "silhouette_share", all > 0 ? json_real(step->reached / all) : json_null());
    return o;
}

static json_t *view_of(report *r, const hs_run *run, const hs_run_view *view) {
    json_t *v = json_object(), *matrix = json_array(), *engines = json_object();
    set_count(r, v, "view", view->number);
    for (int i = 0; i < 16; i++)
        append(r, matrix, json_real((double)run->views.view[view->number].matrix[i]));
    set(r, v, "matrix", matrix);
    if (run->frames.count) set(r, v, "mesh", frame_of(r, run, view));
    set(r, v, "exponent", json_integer(view->exponent));
    set_count(r, v, "words_in", view->words_in);
    set_count(r, v, "bound", view->bound.total);
    for (int e = 0; e < HS_ENGINES; e++)
        if (view->engine[e].ran)
            set(r, engines, hs_engine_name((enum hs_engine)e),
                engine_of(r, view, (enum hs_engine)e));
    set(r, v, "engines", engines);
    set(r, v, "generations", generations_of(r, view));
    set(r, v, "comparisons", comparisons_of(r, view));
    if (run->path) set(r, v, "path", view->step.done ? step_of(r, &view->step) : json_null());
    if (run->request->drop.offscreen || run->request->drop.back)
        set(r, v, "dropped",
            json_pack("{s:I,s:I,s:I}", "offscreen", (json_int_t)view->dropped.offscreen, "back",
                      (json_int_t)view->dropped.back, "vertices",
                      (json_int_t)view->dropped.vertices));
    if (view->pictures) set(r, v, "pictures", pictures_of(r, view->pictures));
    return v;
}

/* --- The file -----------------------------------------------------------------------------------
 */

bool hs_report_write(const hs_run *run, hs_error *err) {
    report r = {.complete = true};
    bool equal = true;
    json_t *root = json_object(), *views = json_array();
    set(&r, root, "versions", versions_of(&r));
    set(&r, root, "machine", machine_of(&r));
    set(&r, root, "mesh", mesh_of(&r, run));
    set(&r, root, "settings", settings_of(&r, run));
    for (uint32_t i = 0; i < run->done; i++) {
        append(&r, views, view_of(&r, run, &run->view[i]));
        equal = equal && hs_run_view_equal(&run->view[i]);
    }
    set_count(&r, root, "views_asked", run->request->only == UINT32_MAX ? run->views.count : 1);
    set(&r, root, "equal", json_boolean(equal));
    set_real(&r, root, "seconds", run->seconds);
    set(&r, root, "views", views);

    hs_file file;
    bool good = r.complete ||
                hs_fail(err, HS_EXIT_INTERNAL, "%.300s: no memory for it", run->request->json);
    /* Nine digits bring every binary32 back. */
    good = good && hs_file_create(&file, run->request->json, err) &&
           hs_json_commit(root, JSON_INDENT(1) | JSON_REAL_PRECISION(9), &file, err);
    json_decref(root);
    return good;
}
