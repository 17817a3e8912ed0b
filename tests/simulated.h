/* SPDX-License-Identifier: Apache-2.0
 *
 * A Verilated module and its clock, for the shims of unit tests. Registers and memories start with
 * random contents.
 */
#ifndef HS_TESTS_SIMULATED_H
#define HS_TESTS_SIMULATED_H

#include <cstdint>
#include <memory>

#include "coverage.h"
#include "verilated.h"

template <class Top> struct simulated {
    VerilatedContext context;
    std::unique_ptr<Top> top;

    explicit simulated(uint32_t seed) {
        context.randReset(2);
        context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
        top = std::make_unique<Top>(&context);
        top->clk_i = 0;
    }
    ~simulated() {
        keep_coverage(context);
        top->final();
    }

    /* One cycle. Afterwards the outputs are those of the next one. */
    void rise() {
        top->eval();
        top->clk_i = 1;
        top->eval();
        top->clk_i = 0;
        top->eval();
        context.timeInc(1);
    }

    /* One cycle of reset. */
    void reset() {
        top->rst_i = 1;
        rise();
        top->rst_i = 0;
    }
};

#endif
