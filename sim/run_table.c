/* SPDX-License-Identifier: Apache-2.0
 *
 * What a run shows on the terminal: a line a view, totals, and, when engines differ, the command
 * that runs just that view.
 */
#include <string.h>

#include "machine.h"
#include "run.h"
#include "surface_options.h"
#include "terminal.h"

/* The engine whose counts the table shows: what golden says holds. */
static const hs_engine_result *shown_engine(const hs_run_view *view) {
    static const enum hs_engine order[] = {HS_ENGINE_golden, HS_ENGINE_model, HS_ENGINE_rtl};
    for (int i = 0; i < 3; i++)
        if (view->engine[order[i]].ran) return &view->engine[order[i]];
    return &view->engine[HS_ENGINE_reference];
}

/* The engine whose cycles the table shows: the RTL, or if it does not run, the model. */
static enum hs_engine timed_engine(const hs_run *run) {
    return run->request->engines >> HS_ENGINE_rtl & 1 ? HS_ENGINE_rtl : HS_ENGINE_model;
}

/* --- The table ----------------------------------------------------------------------------------
 */

void hs_run_table_head(const hs_run *run) {
    const hs_run_request *r = run->request;
    char how[200], engines[80] = "";
    if (r->settings.uniform)
        snprintf(how, sizeof how, "uniform %u", r->settings.uniform_depth);
    else
        snprintf(how, sizeof how, "front %u, silhouette %u, guard %d", r->settings.front_depth,
                 r->settings.silhouette_depth, r->settings.guard);
    snprintf(how + strlen(how), sizeof how - strlen(how), ", boundary %s%s",
             hs_boundary_name(r->settings.boundary), r->settings.limit ? ", limit" : "");
    if (r->settings.min_edge)
        snprintf(how + strlen(how), sizeof how - strlen(how), ", edges of %g px",
                 (double)r->settings.min_edge / HS_PIXEL_FRACTION);
    for (int e = 0; e < HS_ENGINES; e++)
        if (r->engines >> e & 1)
            snprintf(engines + strlen(engines), sizeof engines - strlen(engines), "%s%s",
                     *engines ? ", " : "", hs_engine_name((enum hs_engine)e));
    char what[4400], meshes[80] = "";
    if (run->frames.count)
        snprintf(meshes, sizeof meshes, "%u meshes, %u to %u, the first of ", run->frames.count,
                 run->frames.first, run->frames.first + run->frames.count - 1);
    snprintf(what, sizeof what, "%.4000s: %s%u faces, %u vertices; %s", r->mesh, meshes,
             run->mesh.faces, run->mesh.vertices, engines);
    hs_print_wrapped(run->table, 0, 0, what);
    hs_print_wrapped(run->table, 0, 0, how);
    fputc('\n', run->table);
    fprintf(run->table,
            "view     faces vertices    cycles c/face  face 1     bound ratio  kHz  result\n");
    fflush(run->table);
}

/* A row of the table, but for its number and its result. */
typedef struct figures {
    uint64_t faces, vertices, cycles, first_face, bound;
    double seconds;
} figures;

/* Cycles, their ratios and speed; dashes where nothing was timed. */
static void print_figures(const hs_run *run, const figures *f) {
    FILE *table = run->table;
    fprintf(table, "%9llu %8llu", (unsigned long long)f->faces, (unsigned long long)f->vertices);
    if (!f->cycles) {
        fprintf(table, " %9s %6s %7s %9llu %5s %4s", "-", "-", "-", (unsigned long long)f->bound,
                "-", "-");
        return;
    }
    fprintf(table, " %9llu", (unsigned long long)f->cycles);
    if (f->faces)
        fprintf(table, " %6.2f", (double)f->cycles / (double)f->faces);
    else
        fprintf(table, " %6s", "-");
    if (f->first_face != HS_NO_CYCLE)
        fprintf(table, " %7llu", (unsigned long long)f->first_face);
    else
        fprintf(table, " %7s", "-");
    fprintf(table, " %9llu", (unsigned long long)f->bound);
    if (f->bound)
        fprintf(table, " %5.2f", (double)f->cycles / (double)f->bound);
    else
        fprintf(table, " %5s", "-");
    fprintf(table, " %4.0f", (double)f->cycles / (f->seconds > 1e-9 ? f->seconds : 1e-9) / 1e3);
}

void hs_run_table_view(const hs_run *run, const hs_run_view *view) {
    const hs_engine_result *e = shown_engine(view);
    const enum hs_engine timed = timed_engine(run);
    fprintf(run->table, "%4u ", view->number);
    print_figures(run, &(figures){.faces = e->faces,
                                  .vertices = e->vertices,
                                  .cycles = view->cycles[timed].cycles,
                                  .first_face = view->latency[timed].first_face,
                                  .bound = view->bound.total,
                                  .seconds = view->engine[timed].seconds});
    const char *result = view->comparisons ? "equal" : "done";
    hs_colour colour = view->comparisons ? HS_GREEN : HS_PLAIN;
    const bool equal = hs_run_view_equal(view);
    if (!equal) {
        result = "DIFFER";
        colour = HS_RED;
    } else if (e->status != HS_STATUS_OK) {
        result = e->status == HS_STATUS_STOPPED ? "stopped" : "REFUSED";
        colour = e->status == HS_STATUS_STOPPED ? HS_YELLOW : HS_RED;
    }
    fputs("  ", run->table);
    hs_print_coloured(run->table, colour, 0, result);
    fputc('\n', run->table);
    if (equal && e->status != HS_STATUS_OK) {
        char what[300], where[40] = "";
        if (e->error_position != HS_NO_POSITION)
            snprintf(where, sizeof where, ", at word %u", e->error_position);
        snprintf(what, sizeof what, "%s: %s%s; %s", hs_status_name(e->status),
                 hs_status_what(e->status), where, hs_status_remedy(e->status));
        const int column = fprintf(run->table, "     note: ");
        hs_print_wrapped(run->table, column, column, what);
    }
    fflush(run->table);
}

/* What was compared, of one kind. */
typedef struct total {
    uint64_t compared, different;
    enum hs_engine a, b; /* of the last one, that is, of all */
    bool pairs;          /* there is more than one pair of engines */
} total;

static void add(total *t, const hs_comparison *c) {
    t->pairs = t->pairs || (t->compared && (t->a != c->a || t->b != c->b));
    t->compared += c->compared;
    t->different += c->different;
    t->a = c->a;
    t->b = c->b;
}

static void print_total(const hs_run *run, const total *t, const char *what) {
    if (!t->compared) return;
    char text[200];
    int used =
        t->different
            ? snprintf(text, sizeof text, "%llu of %llu %s ", (unsigned long long)t->different,
                       (unsigned long long)t->compared, what)
            : snprintf(text, sizeof text, "all %llu %s ", (unsigned long long)t->compared, what);
    if (t->pairs)
        snprintf(text + used, sizeof text - (size_t)used, "%s",
                 t->different ? "differ between engines" : "are equal");
    else
        snprintf(text + used, sizeof text - (size_t)used, "of %s %s %s's", hs_engine_name(t->b),
                 t->different ? "differ from" : "equal", hs_engine_name(t->a));
    hs_print_coloured(run->table, t->different ? HS_RED : HS_GREEN, 0, text);
    fputc('\n', run->table);
}

/* What mesh.obj is without. */
static void print_dropped(const hs_run *run) {
    uint64_t faces = 0, offscreen = 0, back = 0;
    for (uint32_t i = 0; i < run->done; i++) {
        faces += run->view[i].dropped.faces;
        offscreen += run->view[i].dropped.offscreen;
        back += run->view[i].dropped.back;
    }
    if (run->request->drop.offscreen || run->request->drop.back)
        fprintf(run->table,
                "mesh.obj: of %llu faces, %llu off screen and %llu back-facing dropped\n",
                (unsigned long long)faces, (unsigned long long)offscreen, (unsigned long long)back);
}

void hs_run_table_total(const hs_run *run) {
    figures sum = {.first_face = HS_NO_CYCLE}; /* no sum says anything about latencies */
    const enum hs_engine timed = timed_engine(run);
    uint64_t other = 0, decided = 0;
    total words = {0}, transactions = {0};
    for (uint32_t i = 0; i < run->done; i++) {
        const hs_run_view *view = &run->view[i];
        const hs_engine_result *e = shown_engine(view);
        sum.faces += e->faces;
        sum.vertices += e->vertices;
        sum.cycles += view->cycles[timed].cycles;
        sum.bound += view->bound.total;
        sum.seconds += view->engine[timed].seconds;
        other += view->decisions.refined_different;
        decided += view->decisions.faces;
        for (uint32_t c = 0; c < view->comparisons; c++) {
            if (strcmp(view->comparison[c].what, "words") == 0) add(&words, &view->comparison[c]);
            if (strcmp(view->comparison[c].what, "transactions") == 0)
                add(&transactions, &view->comparison[c]);
        }
    }
    if (run->done > 1) {
        fprintf(run->table, " all ");
        print_figures(run, &sum);
        fprintf(run->table, "\n");
    }
    fprintf(run->table, "\n%u view%s in %.1f s\n", run->done, run->done == 1 ? "" : "s",
            run->seconds);
    print_total(run, &words, "words");
    print_total(run, &transactions, "transactions");
    print_dropped(run);
    double farthest = 0, bound_distance = 0, pixels = 0;
    uint64_t components = 0, equal = 0;
    for (uint32_t i = 0; i < run->done; i++) {
        const hs_reference_comparison *c = &run->view[i].reference;
        if (c->bound > 0 && c->largest_distance / c->bound > farthest) {
            farthest = c->largest_distance / c->bound;
            bound_distance = c->bound;
        }
        if (c->largest_pixels > pixels) pixels = c->largest_pixels;
        components += c->components;
        equal += c->equal;
    }
    if (!components) return;
    char text[400];
    snprintf(text, sizeof text,
             "reference: golden is at most %.2g pixels (of 1024) away, %.0f%% of the bound of "
             "%.2g; %.1f%% of its components are the rounded double; %llu of %llu faces would be "
             "decided otherwise in doubles",
             pixels, 100 * farthest, bound_distance, 100 * (double)equal / (double)components,
             (unsigned long long)other, (unsigned long long)decided);
    hs_print_wrapped(run->table, 0, 0, text);
}

/* --- Running one view again ---------------------------------------------------------------------
 */

/* Prints " word", quoted for a shell where needed. */
static void print_word(const char *word) {
    static const char plain[] = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789"
                                "_-./:,+=@%";
    fputc(' ', stderr);
    if (*word && word[strspn(word, plain)] == 0) {
        fputs(word, stderr);
        return;
    }
    fputc('\'', stderr);
    for (; *word; word++)
        if (*word == '\'')
            fputs("'\\''", stderr);
        else
            fputc(*word, stderr);
    fputc('\'', stderr);
}

void hs_run_print_rerun(const hs_run *run, uint32_t number, uint64_t cycle) {
    const hs_run_request *r = run->request;
    fprintf(stderr, "to run this view alone%s:\n ",
            cycle == HS_NO_CYCLE ? "" : ", with a waveform of the cycles around");
    print_word(hs_program.name);
    fputs(" run", stderr);
    print_word(r->mesh);
    if (r->views) {
        fputs(r->path ? " --path" : " --views", stderr);
        print_word(r->views);
    } else {
        fprintf(stderr, " --orbit %u", r->orbit);
    }
    fprintf(stderr, " --view %u", number);
    if (r->settings.uniform)
        fprintf(stderr, " --uniform %u", r->settings.uniform_depth);
    else
        fprintf(stderr, " --front %u --silhouette %u", r->settings.front_depth,
                r->settings.silhouette_depth);
    fprintf(stderr, " --guard %d --boundary %s%s", r->settings.guard,
            hs_boundary_name(r->settings.boundary), r->settings.limit ? " --limit" : "");
    if (r->settings.min_edge)
        fprintf(stderr, " --min-edge-px %g", (double)r->settings.min_edge / HS_PIXEL_FRACTION);
    if (r->round_sharpness) fputs(" --round-sharpness", stderr);
    if (r->force) {
        fputs(" --force", stderr);
        print_word(r->force);
    }
    fprintf(stderr, " --size %ux%u --engine ", r->width, r->height);
    const char *separator = "";
    for (int e = 0; e < HS_ENGINES; e++)
        if (r->engines >> e & 1) {
            fprintf(stderr, "%s%s", separator, hs_engine_name((enum hs_engine)e));
            separator = ",";
        }
    if (r->stalls.input || r->stalls.output)
        fprintf(stderr, " --stalls %u,%u", r->stalls.input, r->stalls.output);
    fprintf(stderr, " --seed %u --max-vertices %u --max-quads %u", r->stalls.seed,
            r->limits.vertices, r->limits.quads);
    if (cycle != HS_NO_CYCLE)
        fprintf(stderr, " --wave view-%03u.fst --wave-cycles %llu:%llu", number,
                (unsigned long long)(cycle < 200 ? 0 : cycle - 200),
                (unsigned long long)(cycle + 200));
    fputc('\n', stderr);
}
