/* SPDX-License-Identifier: Apache-2.0
 *
 * A frame of a turntable: the eye goes round, the mesh is refined for it, and beside what it sees
 * stands what a camera sees that stays: the refined part moves over the surface with the eye. A
 * dial shows the eye from above, with the camera at its lower end; below run the numbers.
 */
#include <math.h>
#include <stdio.h>

#include "figure_parts.h"
#include "model.h"
#include "render_parts.h"

enum { INK = 0x20242c, GREY = 0x6b7280, PALE = 0xc9ced6, PAPER = 0xffffff, EYE = 0xc2410c };

/* What the cycle-level model makes of the view, and in how many cycles. */
static bool run_model(hs_output *output, const hs_figure_source *source, hs_error *err) {
    hs_packet in = {0}, out = {0};
    hs_golden_report report;
    hs_cycle_report cycles;
    hs_model *model = hs_model_new(source->limits, HS_DEFAULT_CONFIG, err);
    const bool done =
        model && hs_packet_encode(&in, 0, source->mesh, source->matrix, &source->settings, err) &&
        hs_model_run(model, &in, (hs_stalls){0}, &out, &report, &cycles, NULL, err) &&
        hs_output_decode(output, &out, err) && hs_output_accepted(output, err);
    if (done) source->counts->cycles = cycles.cycles;
    if (done && report.status == HS_STATUS_STOPPED && source->stopped) *source->stopped = true;
    hs_model_free(model);
    hs_packet_free(&in);
    hs_packet_free(&out);
    return done;
}

/* --- The dial ----------------------------------------------------------------------------------
 */

/* Where the eye of a view is, seen from above by the camera: x to its right, y towards it. */
static void place_of_eye(double place[2], const hs_surface *seen, const hs_surface *aside) {
    hs_light eye, camera;
    double right[3];
    hs_light_of_view(&eye, seen->matrix, seen->eye);
    hs_light_of_view(&camera, aside->matrix, aside->eye);
    hs_cross(right, camera.up, camera.ahead);
    place[0] = hs_dot(eye.ahead, right);
    place[1] = hs_dot(eye.ahead, camera.ahead);
    const double length = hypot(place[0], place[1]);
    for (int i = 0; i < 2 && length > 0; i++)
        place[i] /= length;
}

static void draw_dial(hs_picture *picture, double x, double y, double radius,
                      const double place[2]) {
    const double dot = radius / 4.5, line = fmax(radius / 16, 0.8);
    hs_picture_disc(picture, x, y, radius + line / 2, GREY);
    hs_picture_disc(picture, x, y, radius - line / 2, 0xf4f6f8);
    hs_picture_disc(picture, x, y, dot * 1.2, 0x3d86b4); /* what is looked at */
    for (double along = 0.42; along < 0.8; along += 0.15)
        hs_picture_disc(picture, x + along * radius * place[0], y + along * radius * place[1],
                        dot / 3, EYE);
    hs_picture_disc(picture, x + radius * place[0], y + radius * place[1], dot, EYE);
    hs_picture_disc(picture, x, y + radius, dot * 0.8, GREY);
}

/* --- The frame ---------------------------------------------------------------------------------
 */

/* A number and what it counts, the number's right end at x, so that digits do not dance. */
static void write_count(hs_picture *frame, double x, double y, double size, uint64_t count,
                        const char *what) {
    char text[HS_COUNT_TEXT];
    hs_count_text(text, count);
    hs_picture_write(frame, x - hs_picture_text_width(size, text), y, size, INK, text);
    hs_picture_write(frame, x + 0.6 * size, y, size, GREY, what);
}

static void write_middle(hs_picture *frame, double x, double y, double size, const char *text) {
    hs_picture_write(frame, x - hs_picture_text_width(size, text) / 2, y, size, GREY, text);
}

static bool compose(hs_picture *frame, const hs_picture picture[2], const double place[2],
                    const hs_figure_source *source, hs_error *err) {
    const uint32_t width = picture[0].width, height = picture[0].height;
    const uint32_t size = width / 28 > 8 ? width / 28 : 8, gap = size / 2 + 1, strip = 5 * size;
    const uint32_t wide = 2 * width + gap, high = height + strip;
    if (!hs_picture_make(frame, wide, high, PAPER, err)) return false;
    hs_picture_paste(frame, &picture[0], 0, 0);
    hs_picture_paste(frame, &picture[1], width + gap, 0);
    const double radius = 2.6 * size;
    draw_dial(frame, wide - radius - 1.3 * size, height - radius - 1.3 * size, radius, place);
    const double top = height + 1.75 * size, bottom = height + 3.9 * size;
    write_middle(frame, width / 2.0, top, 0.85 * size, "what the eye sees");
    write_middle(frame, width * 1.5 + gap, top, 0.85 * size,
                 "the same surface, from a camera that stays");
    write_count(frame, wide * 0.20, bottom, size, source->counts->panel[0].faces, "faces");
    write_count(frame, wide * 0.53, bottom, size, source->counts->cycles, "cycles of the pipeline");
    char view[64];
    snprintf(view, sizeof view, "view %u of %u", source->view, source->views);
    hs_picture_write(frame, wide - hs_picture_text_width(size, "view 120 of 120") - 0.6 * size,
                     bottom, size, GREY, view);
    return true;
}

bool hs_figure_turntable(hs_picture *frame, hs_renderer *renderer, const hs_figure_source *source,
                         hs_error *err) {
    hs_style style = {.paint = HS_PAINT_DEPTH, .wires = true};
    const uint32_t front = source->settings.front_depth, rim = source->settings.silhouette_depth;
    style.deepest = (uint8_t)(front > rim ? front : rim);
    hs_output output = {0};
    hs_surface seen = {0}, aside = {0};
    hs_picture picture[2] = {{0}};
    double place[2] = {0, 1};
    bool done =
        run_model(&output, source, err) &&
        hs_surface_of_output(&seen, &output, source->matrix, err) &&
        hs_surface_view(&aside, &seen, source->aside, err) &&
        hs_figure_show(&picture[0], "seen by the eye", renderer, &seen, &style, source, err) &&
        hs_figure_show(&picture[1], "seen from aside", renderer, &aside, &style, source, err);
    if (done && renderer) {
        place_of_eye(place, &seen, &aside);
        done = compose(frame, picture, place, source, err);
    }
    for (int i = 0; i < 2; i++)
        hs_picture_free(&picture[i]);
    hs_surface_free(&seen);
    hs_surface_free(&aside);
    hs_output_free(&output);
    return done;
}
