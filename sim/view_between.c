/* SPDX-License-Identifier: Apache-2.0
 *
 * Frames between two looks: what is seen moves along a line, the eye turns about it.
 */
#include <math.h>

#include "view.h"

static double mix(double a, double b, double t) {
    return a + (b - a) * t;
}

static double length_of(const double v[3]) {
    return sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
}

/* From one direction to another along the great circle; the length goes evenly. False where there
 * is no such circle: a vector is zero, or they are opposite. */
static bool turn(double result[3], const double a[3], const double b[3], double t) {
    const double la = length_of(a), lb = length_of(b), length = mix(la, lb, t);
    if (!(la > 0 && lb > 0 && isfinite(la) && isfinite(lb))) return false;
    double sum[3], difference[3];
    for (int i = 0; i < 3; i++) {
        sum[i] = a[i] / la + b[i] / lb;
        difference[i] = a[i] / la - b[i] / lb;
    }
    if (length_of(sum) < 1e-6) return false;
    const double angle = 2 * atan2(length_of(difference), length_of(sum)), sine = sin(angle);
    const double wa = sine > 1e-9 ? sin((1 - t) * angle) / sine : 1 - t;
    const double wb = sine > 1e-9 ? sin(t * angle) / sine : t;
    for (int i = 0; i < 3; i++)
        result[i] = length * (wa * a[i] / la + wb * b[i] / lb);
    return true;
}

bool hs_look_between(hs_look *look, const hs_look *a, const hs_look *b, double t, hs_error *err) {
    double from[3], to[3], out[3];
    for (int i = 0; i < 3; i++) {
        look->at[i] = mix(a->at[i], b->at[i], t);
        from[i] = a->eye[i] - a->at[i];
        to[i] = b->eye[i] - b->at[i];
    }
    if (!turn(out, from, to, t) || !turn(look->up, a->up, b->up, t))
        return hs_fail(err, HS_EXIT_VIEWS,
                       "the two looks are from opposite sides, or with opposite ups, so there is "
                       "more than one way between them; put a look in between");
    for (int i = 0; i < 3; i++)
        look->eye[i] = look->at[i] + out[i];
    look->fov = mix(a->fov, b->fov, t);
    look->near = mix(a->near, b->near, t);
    look->far = mix(a->far, b->far, t);
    return true;
}
