/* SPDX-License-Identifier: Apache-2.0
 *
 * What refinement that stops at pixel size saves: faces, and how far the silhouette is from that of
 * the uniform surface (four Catmull-Clark levels, in doubles), for fixed depths and for least
 * edges, from several distances. `make saving` runs it; docs/refinement.md quotes it.
 */
#define PROGRAM "saving"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#include "golden.h"
#include "quit.h"
#include "render.h"
#include "run_pictures.h"
#include "shape.h"
#include "view.h"

enum { SIZE = 768, SAMPLES = 2, LEVELS = 4, VIEWS = 8, SAFETY = 24 };

typedef struct way {
    const char *name;
    uint8_t front, silhouette;
    double pixels;
} way;

static const way ways[] = {{"depths 4/8", 4, 8, 0},         {"depths 3/6", 3, 6, 0},
                           {"depths 2/5", 2, 5, 0},         {"depths 1/4", 1, 4, 0},
                           {"2 pixels", SAFETY, SAFETY, 2}, {"4 pixels", SAFETY, SAFETY, 4}};
enum { WAYS = sizeof ways / sizeof *ways };

/* Over the views. */
typedef struct sums {
    uint64_t faces;
    double mean, maximum;
} sums;

static hs_settings settings_of(const way *way) {
    return (hs_settings){.front_depth = way->front,
                         .silhouette_depth = way->silhouette,
                         .guard = true,
                         .boundary = HS_BOUNDARY_SMOOTH,
                         .min_edge = (uint16_t)(way->pixels * HS_PIXEL_FRACTION),
                         .width = SIZE,
                         .height = SIZE};
}

/* Around the mesh as hs_views_orbit goes, `distance` times as far away as all of it fills the
 * picture. */
static hs_view look(const hs_mesh *mesh, uint32_t i, double distance) {
    double middle[3], radius = 0;
    for (uint32_t k = 0; k < 3; k++) {
        double low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < mesh->vertices; v++) {
            low = fmin(low, (double)mesh->position[4 * (size_t)v + k]);
            high = fmax(high, (double)mesh->position[4 * (size_t)v + k]);
        }
        middle[k] = (low + high) / 2;
        radius = fmax(radius, (high - low) / 2);
    }
    const double angle = 2 * M_PI * i / VIEWS, far = 3 * radius * distance;
    const double eye[3] = {middle[0] + far * sin(angle), middle[1] + 0.25 * far,
                           middle[2] + far * cos(angle)};
    hs_view view;
    hs_error err;
    quit_on(hs_view_look(&view, eye, middle, (const double[3]){0, 1, 0}, 40, 1, far / 100, 2 * far,
                         &err),
            &err);
    return view;
}

static void draw_reference(hs_picture *picture, hs_renderer *renderer,
                           const hs_reference_surface *reference, const hs_view *view) {
    hs_surface surface;
    hs_error err;
    quit_on(hs_surface_of_faces(&surface, &reference->faces, view->matrix, &err) &&
                hs_view_picture_draw(picture, HS_VIEW_REFINED, renderer, &surface, NULL, &err),
            &err);
    hs_surface_free(&surface);
}

static void measure(sums *sum, hs_golden *golden, hs_renderer *renderer, const hs_mesh *mesh,
                    const hs_view *view, const way *way, const hs_picture *reference) {
    const hs_settings settings = settings_of(way);
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_output output;
    hs_surface surface;
    hs_picture picture = {0};
    hs_picture_difference difference;
    hs_error err;
    quit_on(hs_packet_encode(&in, 0, mesh, view->matrix, &settings, &err) &&
                hs_golden_run(golden, &in, &out, &report, &err) &&
                hs_output_decode(&output, &out, &err) &&
                hs_surface_of_output(&surface, &output, view->matrix, &err) &&
                hs_view_picture_draw(&picture, HS_VIEW_REFINED, renderer, &surface, NULL, &err) &&
                hs_picture_compare(&difference, &picture, reference, &err),
            &err);
    sum->faces += output.faces;
    sum->mean += difference.mean / VIEWS;
    sum->maximum = fmax(sum->maximum, difference.maximum);
    hs_picture_free(&picture);
    hs_surface_free(&surface);
    hs_output_free(&output);
    hs_packet_free(&in);
    hs_packet_free(&out);
}

int main(void) {
    static const char *const shapes[] = {"hand", "monster"};
    static const double distances[] = {0.5, 1, 2, 4, 8};
    hs_error err;
    hs_golden *golden = hs_golden_new((hs_limits){1 << 22, 1 << 22});
    quit_on(golden || hs_fail(&err, HS_EXIT_INTERNAL, "no memory"), &err);
    hs_renderer *renderer = hs_renderer_new(SIZE, SIZE, SAMPLES, &err);
    quit_on(renderer, &err);
    printf("%d views, %d x %d pixels; silhouette: distance from the uniform surface in pixels,\n"
           "mean and largest; faces: mean of the views\n\n"
           "%-8s %8s  %-11s %9s %7s %6s %8s\n",
           VIEWS, SIZE, SIZE, "mesh", "distance", "refined to", "faces", "of 4/8", "mean",
           "largest");
    for (size_t m = 0; m < 2; m++) {
        hs_mesh mesh;
        hs_reference_surface reference;
        quit_on(hs_shape_make(&mesh, shapes[m], 0, 1, &err), &err);
        quit_on(hs_reference_surface_make(&reference, &mesh,
                                          &(hs_settings){.boundary = HS_BOUNDARY_SMOOTH}, LEVELS,
                                          &err),
                &err);
        for (size_t d = 0; d < sizeof distances / sizeof *distances; d++) {
            sums sum[WAYS] = {0};
            for (uint32_t i = 0; i < VIEWS; i++) {
                const hs_view view = look(&mesh, i, distances[d]);
                hs_picture picture = {0};
                draw_reference(&picture, renderer, &reference, &view);
                for (size_t w = 0; w < WAYS; w++)
                    measure(&sum[w], golden, renderer, &mesh, &view, &ways[w], &picture);
                hs_picture_free(&picture);
            }
            for (size_t w = 0; w < WAYS; w++)
                printf("%-8s %8g  %-11s %9.0f %6.0f%% %6.3f %8.2f\n", shapes[m], distances[d],
                       ways[w].name, (double)sum[w].faces / VIEWS,
                       100 * (double)sum[w].faces / (double)sum[0].faces, sum[w].mean,
                       sum[w].maximum);
            fflush(stdout);
        }
        hs_reference_surface_free(&reference);
        hs_mesh_free(&mesh);
    }
    hs_renderer_free(renderer);
    hs_golden_free(golden);
    return 0;
}
