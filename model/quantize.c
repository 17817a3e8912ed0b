/* SPDX-License-Identifier: Apache-2.0
 *
 * quantize: block floating point. E is the smallest exponent with |component| < 2^E for all the
 * view's vertices (0 if all are zero); a coordinate is q = RNE(c * 2^(30-E)).
 */
#include "arithmetic.h"
#include "golden_state.h"

void hs_stage_quantize(hs_state *s) {
    float magnitude = 0;
    for (uint32_t v = 0; v < s->vertices; v++)
        for (int k = 0; k < 4; k++)
            magnitude = fmaxf(magnitude, fabsf(s->clip[v][k]));
    s->exponent = hs_block_exponent(magnitude);
    for (uint32_t v = 0; v < s->vertices; v++)
        for (int k = 0; k < 4; k++)
            s->position[v][k] = hs_to_fixed(s->clip[v][k], s->exponent);
}
