/* SPDX-License-Identifier: Apache-2.0
 *
 * The folder of a view, made by golden, for tests of halfstep report.
 */
#ifndef HS_TEST_REPORT_SCENE_H
#define HS_TEST_REPORT_SCENE_H

#include "place.h"

#include <string.h>
#include <sys/stat.h>

#include "golden.h"
#include "shape.h"
#include "view.h"

static const hs_settings adaptive = {
    .front_depth = 2, .silhouette_depth = 4, .guard = true, .boundary = HS_BOUNDARY_SMOOTH};

typedef struct scene {
    hs_mesh mesh;
    float matrix[16];
    hs_packet in, out;
    hs_output output;
    hs_golden_report report; /* its pointers are not kept */
} scene;

static inline void write_packet(const hs_packet *packet, const char *name) {
    hs_error err = {0};
    FILE *file = fopen(inside(&place, name), "wb");
    assert_non_null(file);
    assert_true(hs_frame_write(file, packet, name, &err));
    assert_int_equal(fclose(file), 0);
}

/* A shape from an orbit's viewpoint through golden; its packets are in view-000. */
static inline scene make_scene(const char *shape, uint32_t size, hs_settings settings,
                               bool singular) {
    scene s = {0};
    hs_error err = {0};
    hs_views views;
    assert_true(hs_shape_make(&s.mesh, shape, size, 1, &err));
    assert_true(hs_views_orbit(&views, 3, &s.mesh, 1, &err));
    memcpy(s.matrix, views.view[1].matrix, sizeof s.matrix);
    hs_views_free(&views);
    for (int i = 8; i < 12 && singular; i++)
        s.matrix[i] = 0;
    assert_true(hs_packet_encode(&s.in, 0, &s.mesh, s.matrix, &settings, &err));
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_non_null(golden);
    assert_true(hs_golden_run(golden, &s.in, &s.out, &s.report, &err));
    hs_golden_free(golden);
    assert_true(hs_output_decode(&s.output, &s.out, &err));
    mkdir(inside(&place, "view-000"), 0700);
    write_packet(&s.in, "view-000/input.hss");
    write_packet(&s.out, "view-000/output.hss");
    return s;
}

static inline void free_scene(scene *s) {
    hs_mesh_free(&s->mesh);
    hs_packet_free(&s->in);
    hs_packet_free(&s->out);
    hs_output_free(&s->output);
}

#endif
