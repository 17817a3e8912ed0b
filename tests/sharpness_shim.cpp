/* SPDX-License-Identifier: Apache-2.0 */
#include "sharpness_shim.h"

#include "Vsharpness.h"
#include "simulated.h"

struct sharpness_shim : simulated<Vsharpness> {
    using simulated::simulated;
};

sharpness_shim *sharpness_new(uint32_t seed) {
    auto *shim = new sharpness_shim(seed);
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
    shim->rise();
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
