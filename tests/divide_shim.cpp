/* SPDX-License-Identifier: Apache-2.0 */
#include "divide_shim.h"

#include <memory>

#include "Vdivide.h"
#include "coverage.h"
#include "verilated.h"

struct divide_rtl {
    VerilatedContext context;
    std::unique_ptr<Vdivide> top;
};

divide_rtl *divide_rtl_new(uint32_t seed) {
    auto *rtl = new divide_rtl;
    rtl->context.randReset(2);
    rtl->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
    rtl->top = std::make_unique<Vdivide>(&rtl->context);
    rtl->top->clk_i = 0;
    rtl->top->eval();
    return rtl;
}

void divide_rtl_free(divide_rtl *rtl) {
    if (rtl) {
        keep_coverage(rtl->context);
        rtl->top->final();
    }
    delete rtl;
}

int32_t divide_rtl_cycle(divide_rtl *rtl, const division *in) {
    Vdivide &top = *rtl->top;
    const int32_t y = static_cast<int32_t>(top.y_o);
    top.valid_i = in != nullptr;
    if (in) {
        top.limit_i = in->limit;
        top.n_i = static_cast<uint8_t>(in->n);
        top.x_i = static_cast<uint64_t>(in->x) & ((UINT64_C(1) << 48) - 1);
    }
    top.clk_i = 1;
    top.eval();
    top.clk_i = 0;
    top.eval();
    return y;
}
