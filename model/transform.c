/* SPDX-License-Identifier: Apache-2.0
 *
 * transform: clip = M p, each row ((m0*x + m1*y) + (m2*z + m3*w)) in binary32.
 */
#include "arithmetic.h"
#include "golden_state.h"

/* False, and the first such row, if a component is not finite. */
bool hs_stage_transform(hs_state *s, uint32_t vertex, const float p[4], uint32_t *row) {
    for (uint32_t r = 0; r < 4; r++) {
        const float c = hs_row_times(s->matrix + 4 * r, p);
        if (!isfinite(c)) {
            *row = r;
            return false;
        }
        s->clip[vertex][r] = c;
    }
    return true;
}
