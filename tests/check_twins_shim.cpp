/* SPDX-License-Identifier: Apache-2.0 */
#include "check_twins_shim.h"

#include "Vcheck_twins.h"
#include "simulated.h"

struct check_twins_shim : simulated<Vcheck_twins> {
    using simulated::simulated;
};

check_twins_shim *check_twins_new(uint32_t seed) {
    auto *shim = new check_twins_shim(seed);
    shim->top->start_i = 0;
    shim->top->write_i = 0;
    shim->reset();
    return shim;
}

void check_twins_free(check_twins_shim *shim) {
    delete shim;
}

check_verdict check_twins_run(check_twins_shim *shim, const check_corner *corner,
                              uint32_t corners) {
    Vcheck_twins &top = *shim->top;
    for (uint32_t h = 0; h < corners; h++) {
        top.write_i = 1;
        top.index_i = h & 127;
        top.origin_i = corner[h].origin & 63;
        top.twin_i = corner[h].twin & 127;
        top.border_i = corner[h].border;
        top.sharpness_i = corner[h].sharpness & 15;
        top.first_i = corner[h].first;
        top.last_i = corner[h].last;
        shim->rise();
    }
    top.write_i = 0;
    top.corners_i = static_cast<uint8_t>(corners);
    top.start_i = 1;
    shim->rise();
    top.start_i = 0;
    check_verdict verdict = {};
    while (top.active_o && verdict.cycles < 1000) {
        shim->rise();
        verdict.cycles++;
    }
    if (top.active_o) verdict.cycles = 0;
    verdict.error = top.error_o;
    verdict.corner = top.corner_o;
    verdict.of_sharpness = top.sharpness_error_o;
    return verdict;
}
