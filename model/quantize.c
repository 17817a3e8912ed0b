/* SPDX-License-Identifier: Apache-2.0
 *
 * quantize: block floating point. E is the smallest exponent with |component| < 2^E for all the
 * view's vertices (0 if all are zero); a coordinate is q = RNE(c * 2^(30-E)).
 */
#include <math.h>

#include "golden_state.h"

/* E of a largest magnitude: frexp gives c = m 2^e with m in [1/2, 1), subnormals included. */
static int32_t block_exponent(float magnitude) {
    int e = 0;
    if (magnitude > 0) frexpf(magnitude, &e);
    return e;
}

/* Exact: scaling a float by a power of two in double loses nothing, and lrint rounds as RNE does
 * in the default rounding mode. */
static int32_t quantize(float c, int32_t exponent) {
    return (int32_t)lrint(ldexp((double)c, 30 - exponent));
}

void hs_stage_quantize(hs_state *s) {
    float magnitude = 0;
    for (uint32_t v = 0; v < s->vertices; v++)
        for (int k = 0; k < 4; k++)
            magnitude = fmaxf(magnitude, fabsf(s->clip[v][k]));
    s->exponent = block_exponent(magnitude);
    for (uint32_t v = 0; v < s->vertices; v++)
        for (int k = 0; k < 4; k++)
            s->position[v][k] = quantize(s->clip[v][k], s->exponent);
}
