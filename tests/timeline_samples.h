/* SPDX-License-Identifier: Apache-2.0
 *
 * Views for the tests of timelines: the model runs them, and a timeline is made of its log.
 */
#ifndef HS_TESTS_TIMELINE_SAMPLES_H
#define HS_TESTS_TIMELINE_SAMPLES_H

#include "folder.h"

#include "shape.h"
#include "timeline.h"
#include "view.h"

typedef struct sample {
    const char *shape;
    uint32_t size;
    hs_settings settings;
    hs_stalls stalls;
    uint32_t spoilt;  /* this word of the packet is wrong, from the end; 0: none */
    hs_limits limits; /* 0: the default */
    enum { USUAL, SMALL, LARGE } machine;
} sample;

#define VIEW(f, s, g)                                                                              \
    { .front_depth = f, .silhouette_depth = s, .guard = g }
#define ALL(d)                                                                                     \
    { .uniform = true, .uniform_depth = d }

static const sample samples[] = {
    {.shape = "cube", .settings = VIEW(4, 8, true)},
    {.shape = "cube", .settings = VIEW(0, 0, true)},
    {.shape = "cube", .settings = VIEW(1, 1, false)},
    {.shape = "cube", .settings = ALL(1)},
    {.shape = "grid", .size = 6, .settings = VIEW(2, 5, true)},
    {.shape = "grid",
     .size = 6,
     .settings =
         {.front_depth = 2, .silhouette_depth = 5, .guard = true, .boundary = HS_BOUNDARY_SMOOTH}},
    {.shape = "grid",
     .size = 6,
     .settings = {.uniform = true, .uniform_depth = 5, .boundary = HS_BOUNDARY_SMOOTH}},
    {.shape = "torus", .settings = ALL(5)},
    {.shape = "torus", .settings = VIEW(3, 5, true), .stalls = {7, 30, 50}},
    {.shape = "torus", .settings = ALL(4), .stalls = {3, 0, 90}},
    {.shape = "die",
     .settings = {.front_depth = 3,
                  .silhouette_depth = 4,
                  .guard = true,
                  .limit = true,
                  .boundary = HS_BOUNDARY_EDGE_ONLY}},
    {.shape = "torus", .settings = {.uniform = true, .uniform_depth = 3, .limit = true}},
    {.shape = "mixed", .settings = VIEW(3, 5, true), .machine = SMALL},
    {.shape = "torus", .settings = VIEW(2, 4, false), .machine = SMALL, .stalls = {5, 0, 70}},
    {.shape = "mixed", .settings = ALL(5), .machine = LARGE},
    {.shape = "torus", .settings = VIEW(4, 8, true), .limits = {2000, 1500}},
    {.shape = "cube", .settings = VIEW(4, 8, true), .spoilt = 1},
    {.shape = "cube", .settings = VIEW(4, 8, true), .spoilt = 7},
    {.shape = "cube", .settings = VIEW(4, 8, true), .spoilt = 51}, /* a twin: found by classify */
};
enum { SAMPLES = sizeof samples / sizeof *samples };

/* A view that the model ran, and its timeline. */
typedef struct taken {
    hs_model *model;
    hs_packet in, out;
    hs_golden_report report;
    hs_cycle_report cycles;
    hs_log log;
    hs_model_config config;
    hs_timeline t;
} taken;

static inline void take(taken *v, const sample *s, uint32_t number) {
    hs_mesh mesh;
    hs_views views;
    hs_error err = {0};
    *v = (taken){.config = HS_DEFAULT_CONFIG};
    if (s->machine == SMALL) {
        v->config.port = v->config.lanes = 1;
        v->config.banks = v->config.window = 2;
        v->config.latency = 3;
    }
    if (s->machine == LARGE) {
        v->config.banks = v->config.lanes = 16;
        v->config.window = 32;
        v->config.ops = 64;
    }
    v->model = hs_model_new(s->limits.quads ? s->limits : HS_DEFAULT_LIMITS, v->config, &err);
    assert_non_null(v->model);
    assert_true(hs_shape_make(&mesh, s->shape, s->size, 1, &err));
    assert_true(hs_views_orbit(&views, 5, &mesh, 1, &err));
    assert_true(hs_packet_encode(&v->in, number, &mesh, views.view[1].matrix, &s->settings, &err));
    if (s->spoilt) v->in.word[v->in.words - s->spoilt] ^= 2;
    if (s->spoilt > 4) v->in.word[v->in.words - 1] = hs_packet_crc(&v->in);
    hs_views_free(&views);
    hs_mesh_free(&mesh);
    assert_true(
        hs_model_run(v->model, &v->in, s->stalls, &v->out, &v->report, &v->cycles, &v->log, &err));
    const hs_timeline_source source = {.log = &v->log,
                                       .cycles = &v->cycles,
                                       .config = v->config,
                                       .view = number,
                                       .status = v->report.status,
                                       .limit = s->settings.limit};
    if (!hs_timeline_make(&v->t, &source, &err)) fail_msg("%s", err.text);
}

static inline void give_back(taken *v) {
    hs_timeline_free(&v->t);
    hs_log_free(&v->log);
    hs_packet_free(&v->in);
    hs_packet_free(&v->out);
    hs_model_free(v->model);
}

static inline bool refused(const taken *v) {
    return v->report.status > HS_STATUS_STOPPED;
}

#endif
