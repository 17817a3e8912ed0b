/* SPDX-License-Identifier: Apache-2.0 */
#include "check_twins_shim.h"

#include <memory>

#include "Vcheck_twins.h"
#include "verilated.h"

struct check_twins_shim {
    VerilatedContext context;
    std::unique_ptr<Vcheck_twins> top;
};

static void rise(check_twins_shim *shim) {
    shim->top->eval();
    shim->top->clk_i = 1;
    shim->top->eval();
    shim->top->clk_i = 0;
    shim->top->eval();
    shim->context.timeInc(1);
}

check_twins_shim *check_twins_new(uint32_t seed) {
    auto *shim = new check_twins_shim;
    shim->context.randReset(2);
    shim->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
    shim->top = std::make_unique<Vcheck_twins>(&shim->context);
    shim->top->clk_i = 0;
    shim->top->start_i = 0;
    shim->top->write_i = 0;
    shim->top->rst_i = 1;
    rise(shim);
    shim->top->rst_i = 0;
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
        rise(shim);
    }
    top.write_i = 0;
    top.corners_i = static_cast<uint8_t>(corners);
    top.start_i = 1;
    rise(shim);
    top.start_i = 0;
    check_verdict verdict = {};
    while (top.active_o && verdict.cycles < 1000) {
        rise(shim);
        verdict.cycles++;
    }
    if (top.active_o) verdict.cycles = 0;
    verdict.error = top.error_o;
    verdict.corner = top.corner_o;
    verdict.of_sharpness = top.sharpness_error_o;
    return verdict;
}
