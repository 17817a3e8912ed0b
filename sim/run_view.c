/* SPDX-License-Identifier: Apache-2.0
 *
 * One view: encode the packet, run the engines on it, compare them, keep what the reports need.
 */
#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "file.h"
#include "obj.h"
#include "run.h"
#include "run_timeline.h"
#include "wave_file.h"

/* What lives only as long as the view is in work. */
typedef struct work {
    hs_run *run;
    hs_run_view *view;
    hs_packet in, packet[HS_ENGINES];
    hs_output output[HS_ENGINES];
    hs_golden_report golden;
    hs_reference reference;
    hs_history history; /* of a path's frame */
} work;

static const enum hs_engine PIPELINES[] = {HS_ENGINE_golden, HS_ENGINE_model, HS_ENGINE_rtl};
enum { PIPELINE_COUNT = sizeof PIPELINES / sizeof *PIPELINES };

static bool wants(const work *w, enum hs_engine engine) {
    return w->run->request->engines >> engine & 1;
}

static bool accepted(const hs_golden_report *report) {
    return report->status == HS_STATUS_OK || report->status == HS_STATUS_STOPPED;
}

/* --- Engines ------------------------------------------------------------------------------------
 */

/* Golden runs for every view: its counts give the bound, its decisions lead the reference. It is
 * an engine of the run, with a stream to compare and to report, only if it was named. */
static bool run_golden(work *w, hs_error *err) {
    hs_run_view *view = w->view;
    const double start = hs_seconds();
    if (w->run->path) hs_history_watch(&w->history, w->run->golden);
    if (!hs_golden_run(w->run->golden, &w->in, &w->packet[HS_ENGINE_golden], &w->golden, err))
        return false;
    view->engine[HS_ENGINE_golden].seconds = hs_seconds() - start;
    view->exponent = w->golden.exponent;
    view->generations = w->golden.generations;
    const size_t bytes = w->golden.generations * sizeof *view->generation;
    view->generation = malloc(bytes ? bytes : 1);
    if (!view->generation) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the report");
    memcpy(view->generation, w->golden.generation, bytes);
    view->bound =
        hs_bound_of(&w->run->request->settings, w->run->depth, view->generation, view->generations,
                    w->run->mesh.vertices, w->in.words, w->packet[HS_ENGINE_golden].words);
    return true;
}

/* The cycle in which a pipeline's word left; HS_NO_CYCLE: it has no clock, or sent no such word. */
static uint64_t word_cycle(const work *w, enum hs_engine engine, size_t word) {
    return engine == HS_ENGINE_rtl     ? hs_rtl_word_cycle(w->run->rtl, word)
           : engine == HS_ENGINE_model ? hs_model_word_cycle(w->run->model, word)
                                       : HS_NO_CYCLE;
}

/* From the packet's first beat to the beat with its first record of a kind. */
static uint64_t record_latency(const work *w, enum hs_engine engine, uint32_t kind) {
    const hs_cycle_report *c = &w->view->cycles[engine];
    const size_t at = hs_packet_find(&w->packet[engine], kind);
    return at == SIZE_MAX ? HS_NO_CYCLE : c->begin + word_cycle(w, engine, at) - c->start;
}

static void measure_latency(work *w, enum hs_engine engine) {
    w->view->latency[engine].first_face = record_latency(w, engine, HS_RECORD_FACE);
    w->view->latency[engine].trailer = record_latency(w, engine, HS_RECORD_TRAILER);
}

/* Whether transactions are logged and compared: a run of model and rtl both. */
static bool compares_cycles(const work *w) {
    return wants(w, HS_ENGINE_model) && wants(w, HS_ENGINE_rtl);
}

/* The log that a timed engine is to fill, or NULL. */
static hs_log *log_of(work *w, enum hs_engine engine) {
    hs_run *run = w->run;
    if (!compares_cycles(w) && !hs_run_timelines_wanted(run->request)) return NULL;
    return engine == HS_ENGINE_rtl ? &run->rtl_log : &run->model_log;
}

static bool run_model(work *w, hs_error *err) {
    hs_golden_report ignored;
    hs_run *run = w->run;
    const double start = hs_seconds();
    if (!hs_model_run(run->model, &w->in, run->request->stalls, &w->packet[HS_ENGINE_model],
                      &ignored, &w->view->cycles[HS_ENGINE_model], log_of(w, HS_ENGINE_model), err))
        return false;
    w->view->engine[HS_ENGINE_model].seconds = hs_seconds() - start;
    measure_latency(w, HS_ENGINE_model);
    uint64_t *cycle = malloc((w->view->generations + 1) * sizeof *cycle);
    if (!cycle) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the report");
    for (uint32_t g = 0; g < w->view->generations; g++)
        cycle[g] = hs_model_generation_cycle(run->model, g);
    w->view->generation_cycle = cycle;
    return true;
}

static bool run_rtl(work *w, hs_error *err) {
    const hs_run_request *request = w->run->request;
    const uint64_t now = hs_rtl_cycle(w->run->rtl);
    hs_file wave = {0};
    if (request->wave && !hs_wave_start(&wave, request->wave, w->run->rtl,
                                        now + request->wave_first, now + request->wave_last, err))
        return false;
    hs_rtl_log(w->run->rtl, log_of(w, HS_ENGINE_rtl));
    const double start = hs_seconds();
    const bool good = hs_rtl_run(w->run->rtl, &w->in, request->stalls, &w->packet[HS_ENGINE_rtl],
                                 &w->view->cycles[HS_ENGINE_rtl], err);
    w->view->engine[HS_ENGINE_rtl].seconds = hs_seconds() - start;
    hs_error why;
    if (!hs_wave_end(&wave, w->run->rtl, &why) && good) {
        *err = why;
        return false;
    }
    if (!good) hs_run_print_rerun(w->run, w->view->number, hs_rtl_cycle(w->run->rtl) - now);
    measure_latency(w, HS_ENGINE_rtl);
    return good;
}

/* The reference has no stream of its own: it replays what golden decided, in doubles. */
static bool run_reference(work *w, hs_error *err) {
    hs_engine_result *result = &w->view->engine[HS_ENGINE_reference];
    const hs_run *run = w->run;
    result->ran = true;
    result->status = w->golden.status;
    result->error_position = w->golden.error_position;
    if (!accepted(&w->golden)) return true;
    double matrix[16];
    for (int i = 0; i < 16; i++)
        matrix[i] = (double)run->views.view[w->view->number].matrix[i];
    const double start = hs_seconds();
    hs_reference *reference = &w->reference;
    if (!hs_reference_new(reference, &run->mesh, matrix, run->request->settings.boundary, err) ||
        !hs_reference_replay(reference, &run->request->settings, &w->golden, &w->view->decisions,
                             err))
        return false;
    result->seconds = hs_seconds() - start;
    uint8_t *used = calloc(reference->vertices ? reference->vertices : 1, 1);
    if (!used) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the reference's count");
    result->faces = reference->finals;
    for (uint32_t f = 0; f < reference->finals; f++) {
        const hs_reference_list v = reference->final[f].v;
        result->triangles += v.count == 3;
        for (uint32_t i = 0; i < v.count; i++) {
            uint8_t *mark = &used[reference->final_vertex[v.first + i]];
            result->vertices += !*mark;
            *mark = 1;
        }
    }
    free(used);
    return true;
}

/* Decodes what a pipeline sent. */
static bool finish_pipeline(work *w, enum hs_engine engine, hs_error *err) {
    hs_engine_result *result = &w->view->engine[engine];
    const hs_packet *packet = &w->packet[engine];
    hs_output *output = &w->output[engine];
    result->ran = true;
    result->words = packet->words;
    result->digest = hs_packet_crc(packet);
    hs_error why = {0};
    if (!hs_output_decode(output, packet, &why))
        return hs_fail(err, why.code, "view %u: what %s sent is no output packet: %s",
                       w->view->number, hs_engine_name(engine), why.text);
    result->status = output->status;
    result->error_position = output->error_position;
    result->vertices = output->vertices;
    result->faces = output->faces;
    result->triangles = output->triangles;
    result->at_level = output->at_level;
    return true;
}

/* --- Comparisons --------------------------------------------------------------------------------
 */

static void add_comparison(hs_run_view *view, enum hs_engine a, enum hs_engine b, const char *what,
                           uint64_t compared, uint64_t different) {
    assert(view->comparisons < HS_RUN_COMPARISONS);
    if (!compared)
        fprintf(stderr, "view %u: of %s and %s, no %s were compared\n", view->number,
                hs_engine_name(a), hs_engine_name(b), what);
    view->comparison[view->comparisons++] = (hs_comparison){a, b, what, compared, different};
}

/* The output words of two pipelines. */
static bool compare_words(work *w, enum hs_engine a, enum hs_engine b) {
    const hs_packet *expected = &w->packet[a], *actual = &w->packet[b];
    const hs_word_comparison words = hs_compare_words(expected, actual);
    add_comparison(w->view, a, b, "words", words.compared, words.different);
    if (words.different == 0) return true;
    char text[500];
    hs_compare_describe(expected, actual, words.first, hs_engine_name(b), text, sizeof text);
    const uint64_t cycle = word_cycle(w, b, words.first);
    hs_progress_clear(&w->run->progress);
    fprintf(stderr, "view %u: %s and %s differ in %llu of %llu words, first in\n  %s\n",
            w->view->number, hs_engine_name(b), hs_engine_name(a),
            (unsigned long long)words.different, (unsigned long long)words.compared, text);
    if (cycle != HS_NO_CYCLE)
        fprintf(stderr, "  which left in cycle %llu of the view\n", (unsigned long long)cycle);
    hs_run_print_rerun(w->run, w->view->number, cycle);
    return false;
}

/* The words of each pipeline against those of the first one that was named. */
static bool compare_pipelines(work *w) {
    enum hs_engine first = HS_ENGINES;
    bool equal = true;
    for (int i = 0; i < PIPELINE_COUNT; i++) {
        if (!wants(w, PIPELINES[i])) continue;
        if (first == HS_ENGINES)
            first = PIPELINES[i];
        else
            equal = compare_words(w, first, PIPELINES[i]) && equal;
    }
    return equal;
}

/* Model and RTL: every transaction at every stage boundary, and every counter. */
static void compare_cycles(work *w) {
    hs_run_view *view = w->view;
    const hs_log_comparison c = hs_log_compare(&w->run->rtl_log, "rtl", &w->run->model_log, "model",
                                               accepted(&w->golden) ? 0 : HS_LOG_DATA_OF_REFUSED);
    char counter[200];
    const bool counted = hs_cycle_report_equal(
        &view->cycles[HS_ENGINE_rtl], &view->cycles[HS_ENGINE_model], counter, sizeof counter);
    add_comparison(view, HS_ENGINE_model, HS_ENGINE_rtl, "transactions", c.compared, c.different);
    add_comparison(view, HS_ENGINE_model, HS_ENGINE_rtl, "counters", HS_REPORT_COUNTERS, !counted);
    if (c.different == 0 && counted) return;
    hs_progress_clear(&w->run->progress);
    if (c.different)
        fprintf(
            stderr, "view %u: rtl and model differ in %llu of %llu transactions, first in\n  %s\n",
            view->number, (unsigned long long)c.different, (unsigned long long)c.compared, c.text);
    if (!counted)
        fprintf(stderr, "view %u: rtl and model count differently: %s\n", view->number, counter);
    hs_run_print_rerun(w->run, view->number, c.different ? c.cycle : HS_NO_CYCLE);
}

static bool compare_reference(work *w, hs_error *err) {
    hs_run_view *view = w->view;
    hs_reference_comparison *c = &view->reference;
    const bool equal = hs_reference_compare(&w->reference, &w->output[HS_ENGINE_golden], c);
    if (c->exhausted)
        return hs_fail(err, HS_EXIT_INTERNAL, "view %u: no memory to compare reference and golden",
                       view->number);
    add_comparison(view, HS_ENGINE_reference, HS_ENGINE_golden, "faces", c->faces,
                   c->different_faces);
    add_comparison(view, HS_ENGINE_reference, HS_ENGINE_golden, "positions", c->vertices,
                   (uint64_t)c->different_vertices + c->different_at_level + c->beyond_bound);
    if (equal) return true;
    hs_progress_clear(&w->run->progress);
    fprintf(stderr,
            "view %u: reference and golden differ: %u of %u faces, %u of %u vertices, %u beyond "
            "the bound; first\n  %s\n",
            view->number, c->different_faces, c->faces, c->different_vertices, c->vertices,
            c->beyond_bound, c->first);
    hs_run_print_rerun(w->run, view->number, HS_NO_CYCLE);
    return true;
}

/* --- The view's folder --------------------------------------------------------------------------
 */

static enum hs_engine engine_of(const char *name) {
    for (enum hs_engine e = 0; e < HS_ENGINES; e++)
        if (strcmp(name, hs_engine_name(e)) == 0) return e;
    return HS_ENGINES;
}

static bool write_pictures(work *w, const char *folder, hs_error *err) {
    hs_run_view *view = w->view;
    hs_run_output output[PIPELINE_COUNT];
    uint32_t outputs = 0;
    for (int i = 0; i < PIPELINE_COUNT; i++)
        if (wants(w, PIPELINES[i]))
            output[outputs++] =
                (hs_run_output){hs_engine_name(PIPELINES[i]), &w->output[PIPELINES[i]]};
    char title[200];
    const char *name = strrchr(w->run->request->mesh, '/');
    snprintf(title, sizeof title, "%.100s, view %u", name ? name + 1 : w->run->request->mesh,
             view->number);
    view->pictures = calloc(1, sizeof *view->pictures);
    if (!view->pictures) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the pictures");
    if (!hs_run_pictures_view(w->run->pictures, folder, title,
                              w->run->views.view[view->number].matrix, output, outputs,
                              view->pictures, err))
        return false;
    for (uint32_t i = 0; i < view->pictures->comparisons; i++) {
        const hs_run_picture_comparison *c = &view->pictures->comparison[i];
        const enum hs_engine a = engine_of(c->a), b = engine_of(c->b);
        if (!c->must_equal || a == HS_ENGINES || b == HS_ENGINES) continue;
        add_comparison(view, a, b, "pixels", c->difference.pixels, c->difference.different);
        if (c->difference.different == 0) continue;
        hs_progress_clear(&w->run->progress);
        fprintf(stderr, "view %u: pictures \"%s\" of %s and %s differ: %s\n", view->number, c->what,
                c->a, c->b, c->first);
    }
    return true;
}

static bool write_stream(const hs_packet *packet, const char *folder, const char *name,
                         hs_error *err) {
    char path[4200];
    snprintf(path, sizeof path, "%s/%s", folder, name);
    hs_file file;
    if (!hs_file_create(&file, path, err)) return false;
    if (hs_frame_write(file.stream, packet, path, err)) return hs_file_commit(&file, err);
    hs_file_abandon(&file);
    return false;
}

static bool write_folder(work *w, hs_error *err) {
    char folder[4096], path[4200];
    snprintf(folder, sizeof folder, "%s/view-%03u", w->run->request->out, w->view->number);
    mkdir(folder, 0777); /* if it fails, the first file in it says why */
    if (!write_stream(&w->in, folder, "input.hss", err)) return false;
    for (int i = 0; i < PIPELINE_COUNT; i++) {
        const enum hs_engine engine = PIPELINES[i];
        if (!w->view->engine[engine].ran) continue;
        snprintf(path, sizeof path, "%s/mesh.obj", folder);
        /* Faces are dropped last: pictures show all. */
        return write_stream(&w->packet[engine], folder, "output.hss", err) &&
               write_pictures(w, folder, err) &&
               hs_output_drop(&w->output[engine], &w->run->request->drop, &w->view->dropped, err) &&
               hs_obj_write_output(path, &w->output[engine], err);
    }
    return true;
}

/* The rtl's timeline, or without it the model's. */
static bool write_timelines(work *w, hs_error *err) {
    const enum hs_engine engine = wants(w, HS_ENGINE_rtl) ? HS_ENGINE_rtl : HS_ENGINE_model;
    return !hs_run_timelines_wanted(w->run->request) ||
           hs_run_timelines_view(w->run, w->view->number, w->golden.status, log_of(w, engine),
                                 &w->view->cycles[engine], err);
}

/* The view as the next frame of the path. */
static bool add_frame(work *w, hs_error *err) {
    const hs_output *output = &w->output[HS_ENGINE_golden];
    return hs_history_check(&w->history, output, err) &&
           hs_path_add(w->run->path, &w->view->step, &w->history, output, &w->golden, err);
}

/* --- One view -----------------------------------------------------------------------------------
 */

static bool work_on(work *w, hs_error *err) {
    hs_run *run = w->run;
    hs_run_view *view = w->view;
    if (!hs_packet_encode(&w->in, view->number, &run->mesh, run->views.view[view->number].matrix,
                          &run->request->settings, err))
        return false;
    view->words_in = w->in.words;
    if (!run_golden(w, err)) return false;
    if (wants(w, HS_ENGINE_golden) && !finish_pipeline(w, HS_ENGINE_golden, err)) return false;
    if (run->path && accepted(&w->golden) && !add_frame(w, err)) return false;
    if (wants(w, HS_ENGINE_model) &&
        (!run_model(w, err) || !finish_pipeline(w, HS_ENGINE_model, err)))
        return false;
    if (wants(w, HS_ENGINE_rtl) && !run_rtl(w, err)) return false;
    if (compares_cycles(w)) compare_cycles(w);
    if (!write_timelines(w, err)) return false;
    if (!compare_pipelines(w)) {
        /* What differs may be no packet at all; what it counts is told all the same. */
        hs_error ignored;
        finish_pipeline(w, HS_ENGINE_rtl, &ignored);
        return true;
    }
    if (wants(w, HS_ENGINE_rtl) && !finish_pipeline(w, HS_ENGINE_rtl, err)) return false;
    if (wants(w, HS_ENGINE_reference)) {
        if (!run_reference(w, err)) return false;
        if (wants(w, HS_ENGINE_golden) && accepted(&w->golden) && !compare_reference(w, err))
            return false;
    }
    return run->request->out == NULL || write_folder(w, err);
}

bool hs_run_one(hs_run *run, uint32_t number, hs_run_view *view, hs_error *err) {
    *view = (hs_run_view){.number = number,
                          .mesh_vertices = run->mesh.vertices,
                          .mesh_faces = run->mesh.faces,
                          .mesh_halfedges = run->mesh.halfedges};
    work w = {.run = run, .view = view};
    const bool good = work_on(&w, err);
    hs_packet_free(&w.in);
    for (int e = 0; e < HS_ENGINES; e++) {
        hs_packet_free(&w.packet[e]);
        hs_output_free(&w.output[e]);
    }
    hs_reference_free(&w.reference);
    hs_history_free(&w.history);
    return good;
}

void hs_run_view_free(hs_run_view *view) {
    free(view->generation);
    free(view->generation_cycle);
    free(view->pictures);
    *view = (hs_run_view){0};
}

bool hs_run_view_equal(const hs_run_view *view) {
    if (view->step.moved) return false;
    for (uint32_t i = 0; i < view->comparisons; i++)
        if (!view->comparison[i].compared || view->comparison[i].different) return false;
    return true;
}
