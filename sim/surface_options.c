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

/* The depths, when the least edge is known. */
static bool set_depths(hs_settings *settings, const hs_surface_options *o, bool forced,
                       hs_error *err) {
    if (o->uniform_given) {
        settings->uniform = true;
        settings->uniform_depth = (uint8_t)o->uniform;
        if (!o->front_given && !o->silhouette_given && !forced) return true;
        return hs_fail(err, HS_EXIT_USAGE,
                       "--uniform refines everything whatever the view; drop it, or drop --front, "
                       "--silhouette and --force");
    }
    const bool safety = settings->min_edge != 0;
    settings->front_depth = (uint8_t)(safety && !o->front_given ? HS_SAFETY_DEPTH : o->front);
    settings->silhouette_depth =
        (uint8_t)(safety && !o->silhouette_given ? HS_SAFETY_DEPTH : o->silhouette);
    return true;
}

bool hs_size_parse(const char *text, uint32_t *width, uint32_t *height, hs_error *err) {
    enum { LEAST = 16, MOST = 8192 };
    if (hs_pair_parse(text, 'x', width, height) && *width >= LEAST && *height >= LEAST &&
        *width <= MOST && *height <= MOST)
        return true;
    return hs_fail(err, HS_EXIT_USAGE,
                   "--size is \"%.40s\"; it should be WIDTHxHEIGHT, %d to %d each, as in 768x768",
                   text, LEAST, MOST);
}

bool hs_surface_settings(hs_settings *settings, const hs_surface_options *o, bool forced,
                         uint32_t width, uint32_t height, hs_error *err) {
    *settings = (hs_settings){.guard = o->guard != 0,
                              .limit = o->limit,
                              .boundary = HS_BOUNDARY_SMOOTH,
                              .width = (uint16_t)width,
                              .height = (uint16_t)height};
    if (o->boundary && !hs_boundary_parse(o->boundary, &settings->boundary)) {
        const char *nearest = hs_nearest(o->boundary, BOUNDARY_NAME);
        return hs_fail(err, HS_EXIT_USAGE,
                       "--boundary is \"%.40s\"%s%s%s; it should be kept, smooth or edge-only",
                       o->boundary, nearest ? "; did you mean \"" : "", nearest ? nearest : "",
                       nearest ? "\"?" : "");
    }
    if (o->min_edge && !hs_pixels_parse(o->min_edge, &settings->min_edge))
        return hs_fail(err, HS_EXIT_USAGE,
                       "--min-edge-px is \"%.40s\"; it should be a number of pixels, 0.0625 to "
                       "4095, as in 4 or 1.5",
                       o->min_edge);
    return set_depths(settings, o, forced, err);
}
