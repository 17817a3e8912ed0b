/* SPDX-License-Identifier: Apache-2.0 */
#include "surface_options.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "options.h"

static const char *const BOUNDARY_NAME[] = {"kept", "smooth", "edge-only", NULL};

const char *hs_boundary_name(hs_boundary boundary) {
    return BOUNDARY_NAME[boundary];
}

bool hs_boundary_parse(const char *text, hs_boundary *boundary) {
    for (unsigned b = 0; BOUNDARY_NAME[b]; b++)
        if (strcmp(text, BOUNDARY_NAME[b]) == 0) {
            *boundary = (hs_boundary)b;
            return true;
        }
    return false;
}

bool hs_pixels_parse(const char *text, uint16_t *sixteenths) {
    char *end;
    const double pixels = strtod(text, &end);
    /* Written so that NaN fails. */
    if (end == text || *end || !(pixels >= 1.0 / HS_PIXEL_FRACTION && pixels <= 4095)) return false;
    *sixteenths = (uint16_t)lround(pixels * HS_PIXEL_FRACTION);
    return true;
}

bool hs_surface_settings(hs_settings *settings, const hs_surface_texts *texts, uint32_t width,
                         uint32_t height, hs_error *err) {
    settings->boundary = HS_BOUNDARY_SMOOTH;
    if (texts->boundary && !hs_boundary_parse(texts->boundary, &settings->boundary)) {
        const char *nearest = hs_nearest(texts->boundary, BOUNDARY_NAME);
        return hs_fail(err, HS_EXIT_USAGE,
                       "--boundary is \"%.40s\"%s%s%s; it should be kept, smooth or edge-only",
                       texts->boundary, nearest ? "; did you mean \"" : "", nearest ? nearest : "",
                       nearest ? "\"?" : "");
    }
    settings->limit = texts->limit;
    settings->width = (uint16_t)width;
    settings->height = (uint16_t)height;
    if (texts->min_edge && !hs_pixels_parse(texts->min_edge, &settings->min_edge))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--min-edge-px is \"%.40s\"; it should be a number of pixels, 0.0625 to "
                       "4095, as in 4 or 1.5",
                       texts->min_edge);
    return true;
}
