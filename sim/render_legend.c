/* SPDX-License-Identifier: Apache-2.0
 *
 * The colours that stand for something, and the legend that says for what.
 */
#include <math.h>
#include <stdio.h>

#include "render_parts.h"

#define INK 0x20242c

/* Pale sand over green to blue: lightness falls evenly, hue moves along the blue-yellow axis, so
 * that order is legible in grey and to colour-blind readers alike. The dark end stays light enough
 * for black wires. */
static const uint8_t ramp[][3] = {{250, 243, 214}, {217, 234, 196}, {158, 212, 187},
                                  {97, 181, 189},  {60, 143, 184},  {50, 102, 168}};

uint32_t hs_depth_color(uint32_t generation, uint32_t deepest) {
    double along = deepest ? fmin((double)generation / deepest, 1) : 0;
    double place = along * (sizeof ramp / sizeof ramp[0] - 1);
    size_t k = (size_t)fmin(floor(place), sizeof ramp / sizeof ramp[0] - 2);
    uint32_t color = 0;
    for (int c = 0; c < 3; c++) {
        double value = ramp[k][c] + (ramp[k + 1][c] - ramp[k][c]) * (place - (double)k);
        color = color << 8 | (uint32_t)lround(value);
    }
    return color;
}

/* As in the paper's figure 8: dark, medium, light. */
uint32_t hs_facing_color(uint32_t facing) {
    return facing == HS_FACING_FRONT ? 0x3d5a80 : facing == HS_FACING_BACK ? 0x98b4cf : 0xf6e3b4;
}

typedef struct hs_legend {
    hs_picture *picture;
    double x, y, size; /* lower left corner, height of letters */
} hs_legend;

static void swatch(hs_legend *at, double width, uint32_t color) {
    hs_picture_fill(at->picture, at->x, at->y - 1.45 * at->size, at->x + width, at->y, color);
}

static void frame(hs_legend *at, double width) {
    double line = fmax(1, at->size / 14), top = at->y - 1.45 * at->size, right = at->x + width;
    const uint32_t grey = 0x7c828c;
    hs_picture_fill(at->picture, at->x - line, top - line, right + line, top, grey);
    hs_picture_fill(at->picture, at->x - line, at->y, right + line, at->y + line, grey);
    hs_picture_fill(at->picture, at->x - line, top, at->x, at->y, grey);
    hs_picture_fill(at->picture, right, top, right + line, at->y, grey);
}

/* Keeps the legend legible where the surface is behind it. */
static void backing(hs_legend *at, double width) {
    hs_picture_fill(at->picture, at->x - 0.7 * at->size, at->y - 2.1 * at->size,
                    at->x + width + 0.7 * at->size, at->y + 0.65 * at->size, 0xf7f8f9);
}

static void word(hs_legend *at, const char *text) {
    hs_picture_write(at->picture, at->x, at->y - 0.22 * at->size, at->size, INK, text);
    at->x += hs_picture_text_width(at->size, text) + 0.7 * at->size;
}

void hs_draw_legend(hs_picture *picture, enum hs_paint paint, uint32_t deepest) {
    uint32_t least = picture->width < picture->height ? picture->width : picture->height;
    double size = fmax(least / 64.0, 7);
    hs_legend at = {picture, 1.4 * size, picture->height - 1.4 * size, size};
    if (paint == HS_PAINT_DEPTH) {
        /* Deep scales label every second, fourth ... generation, so that numbers stay apart. */
        uint32_t step = 1;
        while (deepest / step > 16)
            step *= 2;
        double width = 2.1 * size / step;
        double text = hs_picture_text_width(size, "depth") + 0.7 * size;
        backing(&at, text + width * (deepest + 1));
        word(&at, "depth");
        frame(&at, width * (deepest + 1));
        for (uint32_t g = 0; g <= deepest; g++) {
            swatch(&at, width, hs_depth_color(g, deepest));
            if (g % step == 0) {
                char number[16];
                snprintf(number, sizeof number, "%u", g);
                double left = at.x + (width * step - hs_picture_text_width(0.8 * size, number)) / 2;
                bool dark = deepest > 0 && g * 4 > deepest * 3;
                hs_picture_write(picture, left, at.y - 0.33 * size, 0.8 * size,
                                 dark ? 0xffffff : INK, number);
            }
            at.x += width;
        }
    }
    if (paint == HS_PAINT_FACING) {
        static const char *const name[] = {"front", "back", "both"};
        double width = 0;
        for (uint32_t facing = 0; facing < 3; facing++)
            width += (facing ? 4.3 : 2.7) * size + hs_picture_text_width(size, name[facing]);
        backing(&at, width);
        for (uint32_t facing = 0; facing < 3; facing++) {
            frame(&at, 2.1 * size);
            swatch(&at, 2.1 * size, hs_facing_color(facing));
            at.x += 2.7 * size;
            word(&at, name[facing]);
            at.x += 0.9 * size;
        }
    }
}
