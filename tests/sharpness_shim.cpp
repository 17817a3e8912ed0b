/* SPDX-License-Identifier: Apache-2.0 */
#include "sharpness_shim.h"

#include <memory>

#include "Vsharpness.h"
#include "verilated.h"

struct sharpness_shim {
    VerilatedContext context;
    std::unique_ptr<Vsharpness> top;
};

static void rise(sharpness_shim *shim) {
    shim->top->eval();
    shim->top->clk_i = 1;
    shim->top->eval();
    shim->top->clk_i = 0;
    shim->top->eval();
    shim->context.timeInc(1);
}

sharpness_shim *sharpness_new(uint32_t seed) {
    auto *shim = new sharpness_shim;
    shim->context.randReset(2);
    shim->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
    shim->top = std::make_unique<Vsharpness>(&shim->context);
    shim->top->clk_i = 0;
    shim->top->rst_i = 1;
    sharpness_cycle(shim, {});
    shim->top->rst_i = 0;
    return shim;
}

void sharpness_free(sharpness_shim *shim) {
    delete shim;
}

void sharpness_cycle(sharpness_shim *shim, sharpness_in in) {
    Vsharpness &top = *shim->top;
    top.vertex_valid_i = in.vertex;
    top.vertex_index_i = in.index % SHARPNESS_VERTICES;
    top.corner_valid_i = in.corner;
    top.corner_origin_i = in.index % SHARPNESS_VERTICES;
    top.corner_boundary_i = in.boundary;
    top.corner_sharpness_i = in.sharpness & 15;
    top.corner_own_i = in.own & 15;
    rise(shim);
}

uint32_t sharpness_word(sharpness_shim *shim, uint8_t vertex) {
    shim->top->look_i = vertex % SHARPNESS_VERTICES;
    shim->top->eval();
    return shim->top->word_o;
}

vertex_kind sharpness_kind(sharpness_shim *shim, uint32_t word, uint8_t level, bool corners_stay) {
    Vsharpness &top = *shim->top;
    top.kind_word_i = word & 0x3ffff;
    top.level_i = level;
    top.corners_stay_i = corners_stay;
    top.eval();
    return {top.stays_o != 0, top.crease_o != 0};
}
