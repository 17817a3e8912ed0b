/* SPDX-License-Identifier: Apache-2.0 */
#include "run_timeline.h"

#include <string.h>

#include "surface_options.h"

bool hs_run_timelines_wanted(const hs_run_request *r) {
    return r->timeline || r->kanata || r->timeline_svg;
}

static hs_model_config config_of(const hs_run *run) {
    return run->rtl ? hs_rtl_config(run->rtl) : HS_DEFAULT_CONFIG;
}

/* What ran, in ASCII: jansson takes no text that is not UTF-8, and a file's name may be any bytes.
 */
static void make_title(const hs_run *run, char *title, size_t size) {
    const hs_settings *s = &run->request->settings;
    const char *slash = strrchr(run->request->mesh, '/');
    int used = snprintf(title, size, "%.200s, ", slash ? slash + 1 : run->request->mesh);
    if (s->uniform)
        used += snprintf(title + used, size - (size_t)used, "uniform %u", s->uniform_depth);
    else
        used += snprintf(title + used, size - (size_t)used, "front %u, silhouette %u, guard %d",
                         s->front_depth, s->silhouette_depth, s->guard);
    snprintf(title + used, size - (size_t)used, ", boundary %s%s", hs_boundary_name(s->boundary),
             s->limit ? ", limit" : "");
    for (char *c = title; *c; c++)
        if (*c < ' ' || *c > '~') *c = '?';
}

bool hs_run_timelines_begin(hs_run *run, hs_error *err) {
    const hs_run_request *r = run->request;
    hs_run_timelines *t = &run->timelines;
    const hs_model_config config = config_of(run);
    char title[400];
    make_title(run, title, sizeof title);
    if (r->timeline &&
        (!hs_file_create(&t->json_file, r->timeline, err) ||
         !hs_timeline_json_begin(&t->json, t->json_file.stream, title, &config, err)))
        return false;
    if (r->kanata && !hs_file_create(&t->kanata_file, r->kanata, err)) return false;
    if (r->kanata) hs_timeline_kanata_begin(&t->kanata, t->kanata_file.stream);
    return !r->timeline_svg || hs_file_create(&t->svg_file, r->timeline_svg, err);
}

bool hs_run_timelines_view(hs_run *run, uint32_t number, uint32_t status, const hs_log *log,
                           const hs_cycle_report *cycles, hs_error *err) {
    const hs_run_request *r = run->request;
    hs_run_timelines *t = &run->timelines;
    const hs_timeline_source source = {.log = log,
                                       .cycles = cycles,
                                       .config = config_of(run),
                                       .view = number,
                                       .status = status,
                                       .limit = r->settings.limit};
    hs_timeline timeline;
    char title[400];
    bool good = hs_timeline_make(&timeline, &source, err);
    if (good && r->timeline) good = hs_timeline_json_view(&t->json, &timeline, err);
    if (good && r->kanata) good = hs_timeline_kanata_view(&t->kanata, &timeline, err);
    if (good && r->timeline_svg) {
        const int used = snprintf(title, sizeof title, "View %u of ", number);
        make_title(run, title + used, sizeof title - (size_t)used);
        hs_timeline_svg(t->svg_file.stream, &timeline, title);
    }
    hs_timeline_free(&timeline);
    return good;
}

bool hs_run_timelines_end(hs_run *run, hs_error *err) {
    const hs_run_request *r = run->request;
    hs_run_timelines *t = &run->timelines;
    if (r->timeline) hs_timeline_json_end(&t->json);
    return (!r->timeline || hs_file_commit(&t->json_file, err)) &&
           (!r->kanata || hs_file_commit(&t->kanata_file, err)) &&
           (!r->timeline_svg || hs_file_commit(&t->svg_file, err));
}

void hs_run_timelines_abandon(hs_run *run) {
    hs_file_abandon(&run->timelines.json_file);
    hs_file_abandon(&run->timelines.kanata_file);
    hs_file_abandon(&run->timelines.svg_file);
}
