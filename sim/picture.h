/* SPDX-License-Identifier: Apache-2.0
 *
 * Pictures: what they hold, how two of them are compared, and how several become one sheet.
 *
 * A picture knows, beside its colours, how much of every pixel the surface covers. Silhouettes are
 * taken from that coverage, never guessed from colours, so they do not depend on light, palette,
 * wires, or legend.
 */
#ifndef HS_PICTURE_H
#define HS_PICTURE_H

#include <stddef.h>
#include <stdint.h>

#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif

typedef struct hs_picture {
    uint32_t width, height; /* pixels */
    uint8_t *rgb;           /* 3 per pixel, sRGB; rows from top to bottom, pixels left to right */
    uint8_t *coverage;      /* 1 per pixel: 0 background to 255 all surface */
} hs_picture;

/* The largest width and height of a picture, sheets included. */
#define HS_PICTURE_LIMIT 32768u

/* A picture of one colour (0xrrggbb) that nothing covers. On failure *picture is empty
 * (HS_EXIT_USAGE: a size of zero or above the limit; HS_EXIT_INTERNAL: memory). */
bool hs_picture_make(hs_picture *picture, uint32_t width, uint32_t height, uint32_t color,
                     hs_error *err);

/* Frees the arrays and empties *picture; an empty (zeroed) picture may be freed. */
void hs_picture_free(hs_picture *picture);

/* Whether both have the same size and, in every pixel, the same colour and coverage. Otherwise
 * *x and *y (may be NULL) are the first pixel that differs, or the size's corner. */
bool hs_picture_equal(const hs_picture *a, const hs_picture *b, uint32_t *x, uint32_t *y);

/* How far two pictures of one size are apart. */
typedef struct hs_picture_difference {
    uint64_t pixels;         /* in each picture */
    uint64_t different;      /* pixels that differ in any channel by anything */
    uint64_t visible;        /* pixels that differ in any channel by more than 16 of 255 */
    uint32_t largest;        /* largest difference of a channel, 0 to 255 */
    double psnr;             /* dB: 10 log10(255^2 / mean squared difference of all channels);
                                INFINITY if nothing differs */
    double psnr_covered;     /* the same over the pixels that either surface touches */
    uint64_t covered_a;      /* pixels that the surface covers by half or more */
    uint64_t covered_b;      /* */
    uint64_t covered_either; /* pixels covered in one of the two alone */
    double mean_a_to_b;      /* from each silhouette pixel of a to the nearest of b, in pixels */
    double mean_b_to_a;      /* */
    double mean;             /* over the silhouette pixels of both */
    double maximum;          /* the largest in either direction: the Hausdorff distance */
} hs_picture_difference;

/* Compares two pictures of the same size. A silhouette pixel is covered (by half or more) and has
 * one of its four neighbours uncovered; the picture's edge is no silhouette. Distances are
 * Euclidean, between pixel centres. If just one picture has a silhouette, the distances are the
 * picture's diagonal; if neither has, 0. False: sizes differ (HS_EXIT_DIFFERENT), or memory. */
bool hs_picture_compare(hs_picture_difference *difference, const hs_picture *a, const hs_picture *b,
                        hs_error *err);

/* A picture of where a and b differ: a in pale grey, and over it the largest difference of a
 * channel, times gain, as a tint from yellow (small) to dark red (255 and above). Equal pixels stay
 * grey. The coverage is that of a. False as hs_picture_compare. */
bool hs_picture_subtract(hs_picture *difference, const hs_picture *a, const hs_picture *b,
                         double gain, hs_error *err);

/* Writes text with its baseline's left end at (x, y), letters size pixels high, in a stroke font
 * of printable ASCII; other bytes show as '?'. What lies outside the picture is cut off. Coverage
 * is left alone. */
void hs_picture_write(hs_picture *picture, double x, double y, double size, uint32_t color,
                      const char *text);

/* Width in pixels that text takes at a size. */
double hs_picture_text_width(double size, const char *text);

/* Fills a rectangle, corners in pixels, edges smoothed. Coverage is left alone. */
void hs_picture_fill(hs_picture *picture, double left, double top, double right, double bottom,
                     uint32_t color);

/* Fills a disc around (x, y), in pixels, its edge smoothed. Coverage is left alone. */
void hs_picture_disc(hs_picture *picture, double x, double y, double radius, uint32_t color);

/* Copies a picture into a larger one, coverage included. What would lie outside is cut off. */
void hs_picture_paste(hs_picture *picture, const hs_picture *part, uint32_t left, uint32_t top);

/* Writes a count with commas between its thousands into text, and returns text. */
enum { HS_COUNT_TEXT = 28 };
char *hs_count_text(char text[HS_COUNT_TEXT], uint64_t count);

/* One picture in a sheet. */
typedef struct hs_panel {
    const hs_picture *picture;
    const char *caption; /* below it; NULL or "" for none. Cut with "..." where too long */
} hs_panel;

/* Puts panels, in reading order, on a sheet of so many columns, each cell as large as the largest
 * picture, with captions below and an optional title (NULL) above. */
bool hs_picture_sheet(hs_picture *sheet, const hs_panel *panel, uint32_t panels, uint32_t columns,
                      const char *title, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
