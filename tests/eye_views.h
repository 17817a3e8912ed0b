/* SPDX-License-Identifier: Apache-2.0
 *
 * Views from near to far of a point on a mesh's surface, refined until edges are short: what the
 * tests of the least edge share.
 */
#ifndef HS_TESTS_EYE_VIEWS_H
#define HS_TESTS_EYE_VIEWS_H

#include "golden_state.h"
#include "reference_shapes.h"
#include "view.h"

enum { DEPTH = 24, WIDTH = 1024, HEIGHT = 768 };

static const hs_limits limits = {1 << 22, 1 << 22};

/* --- Meshes and views --------------------------------------------------------------------------
 */

/* Where to look from: a direction, and the point of the surface that is looked at. */
typedef struct {
    double at[3], out[3], radius, box;
} subject;

static inline hs_golden *new_golden(void) {
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    return golden;
}

static inline void run(hs_golden *golden, const hs_mesh *mesh, const float matrix[16],
                       const hs_settings *settings, hs_packet *out) {
    hs_packet in = {0};
    hs_golden_report report;
    hs_error err;
    if (!hs_packet_encode(&in, 0, mesh, matrix, settings, &err) ||
        !hs_golden_run(golden, &in, out, &report, &err))
        fail_msg("%s", err.text);
    assert_int_equal(report.status, HS_STATUS_OK);
    hs_packet_free(&in);
}

/* The surface's point of the vertex that is furthest out in a direction. */
static inline subject look_at_surface(hs_golden *golden, const hs_mesh *mesh, const double out[3]) {
    const float identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    const hs_settings settings = {
        .uniform = true, .uniform_depth = 4, .limit = true, .boundary = HS_BOUNDARY_SMOOTH};
    subject s = {0};
    hs_packet packet = {0};
    hs_output o;
    hs_error err;
    run(golden, mesh, identity, &settings, &packet);
    if (!hs_output_decode(&o, &packet, &err)) fail_msg("%s", err.text);
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    double furthest = -INFINITY;
    for (uint32_t v = 0; v < o.vertices; v++) {
        double p[3], along = 0;
        for (int k = 0; k < 3; k++) {
            p[k] = (double)o.position[4 * v + (uint32_t)k];
            low[k] = fmin(low[k], p[k]);
            high[k] = fmax(high[k], p[k]);
            along += p[k] * out[k];
        }
        if (along > furthest) memcpy(s.at, p, sizeof p);
        furthest = fmax(furthest, along);
    }
    memcpy(s.out, out, sizeof s.out);
    for (int k = 0; k < 3; k++)
        s.box = fmax(s.box, high[k] - low[k]);
    s.radius = s.box / 2;
    hs_output_free(&o);
    hs_packet_free(&packet);
    return s;
}

/* From a distance in radii of the mesh. The near plane is as far away as it can be, so that the
 * depth of a vertex, and with it its place, is known as well as may be. */
static inline hs_view look(const subject *s, double distance, double fov) {
    double eye[3], size = 0;
    for (int k = 0; k < 3; k++)
        size += s->out[k] * s->out[k];
    for (int k = 0; k < 3; k++)
        eye[k] = s->at[k] + s->out[k] / sqrt(size) * distance * s->radius;
    hs_view view;
    hs_error err;
    if (!hs_view_look(&view, eye, s->at, (const double[3]){0, 1, 0.01}, fov, WIDTH / (double)HEIGHT,
                      s->radius * distance * 0.9, s->radius * (distance + 6), &err))
        fail_msg("%s", err.text);
    return view;
}

static inline hs_settings settings_for(double pixels, hs_boundary boundary) {
    return (hs_settings){.front_depth = DEPTH,
                         .silhouette_depth = DEPTH,
                         .guard = true,
                         .boundary = boundary,
                         .min_edge = (uint16_t)(pixels * HS_PIXEL_FRACTION),
                         .width = WIDTH,
                         .height = HEIGHT};
}

static const double directions[][3] = {{0.3, 0.4, 1}, {-1, 0.1, 0.4}, {0.1, 1, 0.3}};
static const double distances[] = {15, 5, 1.5, 0.5, 0.15, 0.05, 0.015};
enum { DISTANCES = sizeof distances / sizeof *distances };

/* --- The samples -------------------------------------------------------------------------------
 */

static inline void add_shape(samples *all, const char *name, uint32_t size) {
    hs_error err;
    if (!hs_shape_make(&add_sample(all, name)->mesh, name, size, 1, &err)) fail_msg("%s", err.text);
}

static inline void add_file(samples *all, const char *name) {
    char path[400];
    hs_error err;
    snprintf(path, sizeof path, MESH_FOLDER "/%s", name);
    if (hs_obj_read(&add_sample(all, name)->mesh, path, true, NULL, &err)) return;
    print_message("%s: skipped\n", err.text);
    all->count--;
}

static inline int make_some_samples(void **state) {
    samples *all = calloc(1, sizeof *all);
    assert_non_null(all);
    add_shape(all, "hand", 0);
    add_shape(all, "monster", 0);
    add_shape(all, "grid", 14);
    add_shape(all, "mixed", 0);
    add_file(all, "spot_control.obj");
    add_file(all, "catmark_helmet.obj");
    add_file(all, "tagged/catmark_dart_edgecorner.obj");
    *state = all;
    return 0;
}

#endif
