/* SPDX-License-Identifier: Apache-2.0 */
#include "picture.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "definitions.h"

bool hs_picture_make(hs_picture *picture, uint32_t width, uint32_t height, uint32_t color,
                     hs_error *err) {
    *picture = (hs_picture){0};
    if (width == 0 || height == 0 || width > HS_PICTURE_LIMIT || height > HS_PICTURE_LIMIT)
        return hs_fail(err, HS_EXIT_USAGE,
                       "a picture of %ux%u pixels cannot be made; ask for 1x1 to %ux%u", width,
                       height, HS_PICTURE_LIMIT, HS_PICTURE_LIMIT);
    size_t pixels = (size_t)width * height;
    uint8_t *rgb = malloc(pixels * 3), *coverage = calloc(pixels, 1);
    if (!rgb || !coverage) {
        free(rgb);
        free(coverage);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a picture of %ux%u pixels", width,
                       height);
    }
    for (size_t i = 0; i < pixels; i++)
        for (size_t c = 0; c < 3; c++)
            rgb[3 * i + c] = (uint8_t)(color >> (16 - 8 * c));
    *picture = (hs_picture){width, height, rgb, coverage};
    return true;
}

void hs_picture_free(hs_picture *picture) {
    free(picture->rgb);
    free(picture->coverage);
    *picture = (hs_picture){0};
}

bool hs_picture_equal(const hs_picture *a, const hs_picture *b, uint32_t *x, uint32_t *y) {
    bool same_size = a->width == b->width && a->height == b->height;
    size_t pixels = same_size ? (size_t)a->width * a->height : 0, i = 0;
    while (i < pixels && a->coverage[i] == b->coverage[i] &&
           memcmp(&a->rgb[3 * i], &b->rgb[3 * i], 3) == 0)
        i++;
    if (same_size && i == pixels) return true;
    uint32_t narrow = a->width < b->width ? a->width : b->width;
    uint32_t low = a->height < b->height ? a->height : b->height;
    if (x) *x = same_size ? (uint32_t)(i % a->width) : narrow;
    if (y) *y = same_size ? (uint32_t)(i / a->width) : low;
    return false;
}

/* --- Silhouettes ------------------------------------------------------------------------------ */

static bool is_covered(const hs_picture *p, size_t i) {
    return p->coverage[i] >= 128;
}

static bool is_silhouette(const hs_picture *p, uint32_t x, uint32_t y) {
    size_t i = (size_t)y * p->width + x;
    return is_covered(p, i) &&
           ((x > 0 && !is_covered(p, i - 1)) || (x + 1 < p->width && !is_covered(p, i + 1)) ||
            (y > 0 && !is_covered(p, i - p->width)) ||
            (y + 1 < p->height && !is_covered(p, i + p->width)));
}

/* The lower envelope of the parabolas (x - i)^2 + in[i], sampled at every x: one pass of the exact
 * squared Euclidean distance transform (P. Felzenszwalb and D. Huttenlocher, "Distance Transforms
 * of Sampled Functions", 2012). Infinite in[i] have no parabola. apex and edge are scratch for n
 * and n + 1 elements. */
static void lower_envelope(const double *in, double *out, uint32_t n, uint32_t *apex,
                           double *edge) {
    uint32_t used = 0;
    for (uint32_t i = 0; i < n; i++) {
        if (isinf(in[i])) continue;
        double from = -INFINITY;
        while (used > 0) {
            double p = apex[used - 1], q = i;
            from = ((in[i] + q * q) - (in[apex[used - 1]] + p * p)) / (2 * (q - p));
            if (from > edge[used - 1]) break;
            used--;
            from = -INFINITY;
        }
        edge[used] = from;
        apex[used++] = i;
    }
    for (uint32_t x = 0, k = 0; x < n; x++) {
        if (used == 0) {
            out[x] = INFINITY;
            continue;
        }
        while (k + 1 < used && edge[k + 1] < x)
            k++;
        double d = (double)x - apex[k];
        out[x] = d * d + in[apex[k]];
    }
}

/* Squared distance of every pixel to the nearest silhouette pixel of p; INFINITY without any.
 * NULL if memory is exhausted. */
static double *squared_distances(const hs_picture *p) {
    uint32_t w = p->width, h = p->height, longest = w > h ? w : h;
    double *field = malloc((size_t)w * h * sizeof *field);
    double *line = malloc(((size_t)3 * longest + 1) * sizeof *line);
    uint32_t *apex = malloc(longest * sizeof *apex);
    if (field && line && apex) {
        double *result = line + longest, *edge = line + 2 * (size_t)longest;
        for (uint32_t x = 0; x < w; x++) {
            for (uint32_t y = 0; y < h; y++)
                line[y] = is_silhouette(p, x, y) ? 0 : INFINITY;
            lower_envelope(line, result, h, apex, edge);
            for (uint32_t y = 0; y < h; y++)
                field[(size_t)y * w + x] = result[y];
        }
        for (uint32_t y = 0; y < h; y++) {
            memcpy(line, &field[(size_t)y * w], w * sizeof *line);
            lower_envelope(line, &field[(size_t)y * w], w, apex, edge);
        }
    } else {
        free(field);
        field = NULL;
    }
    free(line);
    free(apex);
    return field;
}

typedef struct hs_silhouette_sum {
    uint64_t count;
    double sum, maximum;
} hs_silhouette_sum;

/* From the silhouette pixels of `from` to the silhouette whose squared distances are given. */
static hs_silhouette_sum silhouette_distances(const hs_picture *from, const double *squared) {
    hs_silhouette_sum result = {0, 0, 0};
    double diagonal = hypot(from->width, from->height);
    for (uint32_t y = 0; y < from->height; y++)
        for (uint32_t x = 0; x < from->width; x++) {
            if (!is_silhouette(from, x, y)) continue;
            double d = fmin(sqrt(squared[(size_t)y * from->width + x]), diagonal);
            result.count++;
            result.sum += d;
            if (d > result.maximum) result.maximum = d;
        }
    return result;
}

/* --- Differences ------------------------------------------------------------------------------ */

static bool same_size(const hs_picture *a, const hs_picture *b, hs_error *err) {
    if (a->width == b->width && a->height == b->height) return true;
    return hs_fail(err, HS_EXIT_DIFFERENT,
                   "the pictures have %ux%u and %ux%u pixels; compare pictures of one size",
                   a->width, a->height, b->width, b->height);
}

static double decibels(double squares, double samples) {
    return squares > 0 ? 10 * log10(255.0 * 255.0 * samples / squares) : INFINITY;
}

static uint32_t channel_difference(const hs_picture *a, const hs_picture *b, size_t i) {
    return (uint32_t)abs((int)a->rgb[i] - (int)b->rgb[i]);
}

bool hs_picture_compare(hs_picture_difference *difference, const hs_picture *a, const hs_picture *b,
                        hs_error *err) {
    *difference = (hs_picture_difference){0};
    if (!same_size(a, b, err)) return false;
    hs_picture_difference d = {.pixels = (uint64_t)a->width * a->height};
    double squares = 0, squares_covered = 0;
    uint64_t touched = 0;
    for (size_t i = 0; i < d.pixels; i++) {
        uint32_t worst = 0, square = 0;
        for (size_t c = 0; c < 3; c++) {
            uint32_t delta = channel_difference(a, b, 3 * i + c);
            square += delta * delta;
            if (delta > worst) worst = delta;
        }
        d.different += worst > 0;
        d.visible += worst > 16;
        if (worst > d.largest) d.largest = worst;
        squares += square;
        if (a->coverage[i] || b->coverage[i]) {
            squares_covered += square;
            touched++;
        }
        d.covered_a += is_covered(a, i);
        d.covered_b += is_covered(b, i);
        d.covered_either += is_covered(a, i) != is_covered(b, i);
    }
    d.psnr = decibels(squares, 3.0 * (double)d.pixels);
    d.psnr_covered = decibels(squares_covered, 3.0 * (double)touched);

    double *to_a = squared_distances(a), *to_b = squared_distances(b);
    bool enough = to_a && to_b;
    if (enough) {
        hs_silhouette_sum ab = silhouette_distances(a, to_b), ba = silhouette_distances(b, to_a);
        d.mean_a_to_b = ab.count ? ab.sum / (double)ab.count : 0;
        d.mean_b_to_a = ba.count ? ba.sum / (double)ba.count : 0;
        uint64_t count = ab.count + ba.count;
        d.mean = count ? (ab.sum + ba.sum) / (double)count : 0;
        d.maximum = fmax(ab.maximum, ba.maximum);
        *difference = d;
    }
    free(to_a);
    free(to_b);
    return enough || hs_fail(err, HS_EXIT_INTERNAL, "no memory to compare two pictures");
}

bool hs_picture_subtract(hs_picture *difference, const hs_picture *a, const hs_picture *b,
                         double gain, hs_error *err) {
    /* Yellow, orange, red, dark red: darker is worse, in every kind of colour vision. */
    static const double tint[4][3] = {{255, 221, 87}, {245, 133, 38}, {204, 32, 39}, {103, 0, 31}};
    *difference = (hs_picture){0};
    if (!same_size(a, b, err)) return false;
    if (!hs_picture_make(difference, a->width, a->height, 0, err)) return false;
    size_t pixels = (size_t)a->width * a->height;
    memcpy(difference->coverage, a->coverage, pixels);
    for (size_t i = 0; i < pixels; i++) {
        const uint8_t *p = &a->rgb[3 * i];
        double grey = 0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2];
        double pale = 255 - (255 - grey) * 0.45;
        uint32_t worst = 0;
        for (size_t c = 0; c < 3; c++) {
            uint32_t delta = channel_difference(a, b, 3 * i + c);
            if (delta > worst) worst = delta;
        }
        double strength = fmin(worst * gain / 255, 1);
        size_t k = strength < 1 ? (size_t)(strength * 3) : 2;
        double within = strength * 3 - (double)k, opacity = sqrt(strength);
        for (size_t c = 0; c < 3; c++) {
            double ink = tint[k][c] + (tint[k + 1][c] - tint[k][c]) * within;
            double value = worst ? pale + (ink - pale) * opacity : pale;
            difference->rgb[3 * i + c] = (uint8_t)lround(value);
        }
    }
    return true;
}
