/* SPDX-License-Identifier: Apache-2.0
 *
 * The ray of a pixel is the set of clip positions with x = X w and y = Y w. A point of a triangle
 * a, b, c with weights i, j, k lies on it if the weighted sum of (x - X w, y - Y w) is zero: they
 * are the 2 x 2 minors of these, up to a common factor. No division by any w: a triangle may have
 * corners behind the eye.
 */
#include "pick.h"

#include <math.h>

/* A corner as the pixel's ray sees it. */
typedef struct seen {
    double x, y, z, w; /* x and y: away from the ray */
} seen;

static double minor(const seen *a, const seen *b) {
    return a->x * b->y - a->y * b->x;
}

/* Where the ray meets the triangle: z over w, or infinity if it does not within the view. */
static double depth_at(const seen t[3]) {
    double weight[3] = {minor(&t[1], &t[2]), minor(&t[2], &t[0]), minor(&t[0], &t[1])};
    const double sum = weight[0] + weight[1] + weight[2];
    if (!(sum != 0)) return INFINITY; /* edge-on, or not finite */
    double z = 0, w = 0;
    for (int i = 0; i < 3; i++) {
        if (weight[i] / sum < 0) return INFINITY;
        z += weight[i] / sum * t[i].z;
        w += weight[i] / sum * t[i].w;
    }
    return w > 0 && fabs(z) <= w ? z / w : INFINITY;
}

uint32_t hs_pick(const hs_surface *surface, uint32_t x, uint32_t y, uint32_t width,
                 uint32_t height) {
    const double across = (2.0 * x + 1) / width - 1, up = 1 - (2.0 * y + 1) / height;
    uint32_t nearest = HS_PICK_NONE;
    double depth = INFINITY;
    uint8_t cut[3 * HS_MAX_SIDES];
    for (uint32_t f = 0; f < surface->faces; f++) {
        const uint32_t begin = surface->first[f], sides = surface->first[f + 1] - begin;
        seen corner[HS_MAX_SIDES + 1] = {0}, *mean = &corner[sides];
        for (uint32_t i = 0; i < sides; i++) {
            const float *p = &surface->clip[4 * (size_t)surface->corner[begin + i]];
            const double w = (double)p[3];
            corner[i] = (seen){(double)p[0] - across * w, (double)p[1] - up * w, (double)p[2], w};
            mean->x += corner[i].x / sides;
            mean->y += corner[i].y / sides;
            mean->z += corner[i].z / sides;
            mean->w += corner[i].w / sides;
        }
        const uint32_t triangles = hs_surface_triangles(surface, f, cut);
        for (uint32_t t = 0; t < triangles; t++) {
            const uint8_t *k = &cut[3 * t];
            const double there = depth_at((seen[3]){corner[k[0]], corner[k[1]], corner[k[2]]});
            if (there < depth) {
                depth = there;
                nearest = f;
            }
        }
    }
    return nearest;
}
