/* SPDX-License-Identifier: Apache-2.0
 *
 * How exact golden is: eight uniform steps of a shape seen in perspective, at 1024 x 1024 pixels,
 * in block floating point (golden itself), in binary32 and in binary64, all three from the same
 * clip positions and with the same masks. `make accuracy` runs it; docs/arithmetic.md quotes it.
 *
 * The yardstick is the binary64 result. Whatever leaves in binary32 can at best be that, rounded
 * once: the first row.
 */
#define PROGRAM "accuracy"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "golden_state.h"
#include "quit.h"
#include "shape.h"
#include "view.h"

enum { DEPTH = 8, PIXELS = 1024 };

static void *zeros(size_t count, size_t size) {
    void *array = calloc(count + 1, size);
    hs_error err;
    quit_on(array || hs_fail(&err, HS_EXIT_INTERNAL, "no memory"), &err);
    return array;
}

/* --- The masks in a floating-point type, on golden's own topology -------------------------------
 */

/* One uniform step of positions that golden's vertex numbers count: 4 of type per vertex. */
#define DEFINE_STEP(name, type)                                                                    \
    static void name(const hs_state *s, type(*position)[4], type(*old)[4]) {                       \
        const bool odd = hs_odd_step(s);                                                           \
        type(*sum)[4] = zeros(s->vertices, sizeof *sum);                                           \
        type *n = zeros(s->vertices, sizeof *n);                                                   \
        for (uint32_t f = 0; f < s->faces; f++) {                                                  \
            const uint32_t h0 = hs_face_first(s, f), sides = hs_face_sides(s, f);                  \
            type *point = position[s->vertices + f];                                               \
            for (int k = 0; k < 4; k++) {                                                          \
                type total = 0;                                                                    \
                for (uint32_t i = 0; i < sides; i++)                                               \
                    total += (odd ? position : old)[s->origin[h0 + i]][k];                         \
                point[k] = total / (type)sides;                                                    \
            }                                                                                      \
            for (uint32_t i = 0; odd && i < sides; i++) {                                          \
                const uint32_t v = s->origin[h0 + i], w = s->origin[h0 + (i + 1) % sides];         \
                n[v] += 1;                                                                         \
                for (int k = 0; k < 4; k++)                                                        \
                    sum[v][k] += position[w][k] + point[k];                                        \
            }                                                                                      \
            memcpy(old[s->vertices + f], point, sizeof *old);                                      \
        }                                                                                          \
        for (uint32_t v = 0; odd && v < s->vertices; v++) {                                        \
            memcpy(old[v], position[v], sizeof *old);                                              \
            for (int k = 0; k < 4; k++)                                                            \
                position[v][k] = (sum[v][k] + n[v] * (n[v] - 2) * position[v][k]) / (n[v] * n[v]); \
        }                                                                                          \
        free(sum);                                                                                 \
        free(n);                                                                                   \
    }

DEFINE_STEP(step_binary32, float)
DEFINE_STEP(step_binary64, double)

typedef struct {
    float (*position32)[4], (*old32)[4];
    double (*position64)[4], (*old64)[4];
} parallel;

static void follow(void *context, const hs_state *s) {
    parallel *p = context;
    if (s->generation == 0) {
        for (uint32_t v = 0; v < s->vertices; v++) {
            for (int k = 0; k < 4; k++) {
                p->position32[v][k] = s->clip[v][k];
                p->position64[v][k] = (double)s->clip[v][k];
            }
        }
    }
    step_binary32(s, p->position32, p->old32);
    step_binary64(s, p->position64, p->old64);
}

/* --- Comparison
 * ----------------------------------------------------------------------------------- */

typedef struct {
    double pixels;
    uint64_t equal, components;
} distance;

static void compare(distance *d, const float result[4], const double exact[4]) {
    for (int k = 0; k < 4; k++) {
        const float once = (float)exact[k];
        d->equal += result[k] == once;
        d->components++;
    }
    for (int k = 0; k < 2; k++) {
        const double off = (double)result[k] / (double)result[3] - exact[k] / exact[3];
        d->pixels = fmax(d->pixels, fabs(off) * PIXELS / 2);
    }
}

static void print_row(const char *shape, const char *arithmetic, const distance *d) {
    printf("%-12s %-28s %9.2e px %8.1f%%\n", shape, arithmetic, d->pixels,
           100 * (double)d->equal / (double)d->components);
}

static void measure(const char *shape) {
    hs_mesh mesh;
    hs_view view;
    hs_error err;
    quit_on(hs_shape_make(&mesh, shape, 0, 1, &err), &err);
    quit_on(hs_view_look(&view, (const double[3]){0.9, 1.4, 2.6}, (const double[3]){0, 0, 0},
                         (const double[3]){0, 1, 0}, 45, 1, 0.5, 10, &err),
            &err);
    const hs_settings settings = {.uniform = true, .uniform_depth = DEPTH};
    const size_t room = (size_t)mesh.vertices + mesh.faces + ((size_t)mesh.halfedges << DEPTH);
    parallel p = {zeros(room, 16), zeros(room, 16), zeros(room, 32), zeros(room, 32)};
    hs_golden *golden = hs_golden_new((hs_limits){1 << 24, 1 << 24});
    quit_on(golden || hs_fail(&err, HS_EXIT_INTERNAL, "no memory"), &err);
    hs_golden_observe(golden, &(hs_observer){.context = &p, .decided = follow});
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_output output;
    quit_on(hs_packet_encode(&in, 0, &mesh, view.matrix, &settings, &err), &err);
    quit_on(hs_golden_run(golden, &in, &out, &report, &err), &err);
    quit_on(hs_output_decode(&output, &out, &err), &err);

    distance once = {0}, block = {0}, binary32 = {0};
    for (uint32_t i = 0; i < output.vertices; i++) {
        const uint32_t v = output.number[i];
        const double *exact = p.position64[v];
        const float rounded[4] = {(float)exact[0], (float)exact[1], (float)exact[2],
                                  (float)exact[3]};
        compare(&once, rounded, exact);
        compare(&block, output.position + 4 * i, exact);
        compare(&binary32, p.position32[v], exact);
    }
    print_row(shape, "binary64, rounded once", &once);
    print_row("", "block floating point", &block);
    print_row("", "binary32", &binary32);
    free(p.position32);
    free(p.old32);
    free(p.position64);
    free(p.old64);
    hs_golden_free(golden);
    hs_packet_free(&in);
    hs_packet_free(&out);
    hs_output_free(&output);
    hs_mesh_free(&mesh);
}

int main(void) {
    printf("%d uniform steps in perspective, %d x %d: largest distance to binary64 in pixels, and "
           "share of\ncomponents that equal binary64 rounded once\n\n",
           DEPTH, PIXELS, PIXELS);
    static const char *const shapes[] = {"torus", "mixed", "icosahedron", "cube"};
    for (size_t i = 0; i < sizeof shapes / sizeof *shapes; i++)
        measure(shapes[i]);
    return HS_EXIT_OK;
}
