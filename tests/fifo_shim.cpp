/* SPDX-License-Identifier: Apache-2.0 */
#include "fifo_shim.h"

#include <memory>

#include "Vfifo.h"
#include "coverage.h"
#include "verilated.h"

struct fifo_shim {
    VerilatedContext context;
    std::unique_ptr<Vfifo> top;
};

fifo_shim *fifo_new(uint32_t seed) {
    auto *shim = new fifo_shim;
    shim->context.randReset(2);
    shim->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
    shim->top = std::make_unique<Vfifo>(&shim->context);
    shim->top->clk_i = 0;
    shim->top->eval();
    fifo_wires wires[FIFO_LANES] = {};
    fifo_cycle(shim, true, wires);
    return shim;
}

void fifo_free(fifo_shim *shim) {
    keep_coverage(shim->context);
    delete shim;
}

void fifo_cycle(fifo_shim *shim, bool reset, fifo_wires wires[FIFO_LANES]) {
    Vfifo &top = *shim->top;
    uint32_t valid = 0, ready = 0;
    for (int i = 0; i < FIFO_LANES; i++) {
        valid |= static_cast<uint32_t>(wires[i].in_valid) << i;
        ready |= static_cast<uint32_t>(wires[i].out_ready) << i;
        top.in_data_i[i] = wires[i].in_data;
    }
    top.rst_i = reset;
    top.in_valid_i = valid & 7;
    top.out_ready_i = ready & 7;
    top.eval();
    for (int i = 0; i < FIFO_LANES; i++) {
        wires[i].in_ready = top.in_ready_o >> i & 1;
        wires[i].out_valid = top.out_valid_o >> i & 1;
        wires[i].out_data = top.out_data_o[i];
        wires[i].level = top.level_o >> 8 * i & 0xff;
    }
    top.clk_i = 1;
    top.eval();
    top.clk_i = 0;
    top.eval();
    shim->context.timeInc(1);
}
