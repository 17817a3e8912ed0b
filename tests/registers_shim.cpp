// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "Vregisters.h"
#include "coverage.h"
#include "registers_shim.h"
#include "verilated.h"

struct registers_rtl {
    VerilatedContext context;
    std::unique_ptr<Vregisters> top;
    uint64_t cycles = 0;
    uint32_t chance = 1;

    bool hesitate() {
        chance ^= chance << 13;
        chance ^= chance >> 17;
        chance ^= chance << 5;
        return chance >> 30 == 0;
    }
    void settle() {
        top->clk_i = 0;
        top->eval();
    }
    void step() {
        top->clk_i = 1;
        top->eval();
        cycles++;
    }
};

static void set(Vregisters &top, const pipeline_cycle &c) {
    top.stage_busy_i = static_cast<uint16_t>(c.busy);
    top.stage_starved_i = static_cast<uint16_t>(c.starved);
    top.stage_blocked_i = static_cast<uint16_t>(c.blocked);
    top.stage_in_i = c.in;
    top.stage_out_i = c.out;
    top.conflict_i = static_cast<uint8_t>(c.conflicts);
    top.busy_i = c.view_busy;
    top.view_done_i = c.view_done;
    top.status_i = static_cast<uint8_t>(c.status);
    top.position_i = c.position;
}

registers_rtl *registers_rtl_new(uint32_t seed) {
    auto *rtl = new registers_rtl;
    rtl->chance = seed | 1;
    rtl->context.randReset(2);
    rtl->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
    rtl->top = std::make_unique<Vregisters>(&rtl->context);
    Vregisters &top = *rtl->top;
    top.s_axil_awvalid = top.s_axil_wvalid = top.s_axil_arvalid = 0;
    top.s_axil_bready = top.s_axil_rready = 0;
    set(top, pipeline_cycle());
    top.rst_i = 1;
    for (int i = 0; i < 2; i++) {
        rtl->settle();
        rtl->step();
    }
    top.rst_i = 0;
    rtl->cycles = 0;
    return rtl;
}

void registers_rtl_free(registers_rtl *rtl) {
    if (rtl) {
        keep_coverage(rtl->context);
        rtl->top->final();
    }
    delete rtl;
}

uint64_t registers_rtl_cycles(const registers_rtl *rtl) {
    return rtl->cycles;
}

void registers_rtl_limits(const registers_rtl *rtl, uint32_t *vertices, uint32_t *quads) {
    *vertices = rtl->top->limit_vertices_o;
    *quads = rtl->top->limit_quads_o;
}

void registers_rtl_cycle(registers_rtl *rtl, const pipeline_cycle *cycle) {
    set(*rtl->top, *cycle);
    rtl->settle();
    rtl->step();
    set(*rtl->top, pipeline_cycle());
    rtl->top->busy_i = cycle->view_busy;
}

int registers_rtl_read(registers_rtl *rtl, uint32_t address, uint32_t *data, uint64_t *taken) {
    Vregisters &top = *rtl->top;
    bool open = true, seen = false;
    uint32_t first = 0, first_response = 0;
    top.s_axil_araddr = static_cast<uint16_t>(address);
    for (int i = 0; i < 100; i++) {
        top.s_axil_arvalid = open && (top.s_axil_arvalid || !rtl->hesitate());
        top.s_axil_rready = !rtl->hesitate();
        rtl->settle();
        const bool valid = top.s_axil_rvalid;
        if (seen && (!valid || top.s_axil_rdata != first || top.s_axil_rresp != first_response))
            return -1;
        if (valid && open) return -1; /* an answer before the question */
        seen = valid;
        first = top.s_axil_rdata;
        first_response = top.s_axil_rresp;
        if (top.s_axil_arvalid && top.s_axil_arready) {
            open = false;
            if (taken) *taken = rtl->cycles;
        }
        const bool done = valid && top.s_axil_rready;
        rtl->step();
        if (done) {
            *data = first;
            top.s_axil_rready = 0;
            return static_cast<int>(first_response);
        }
    }
    return -1;
}

int registers_rtl_write(registers_rtl *rtl, uint32_t address, uint32_t data, uint32_t strobe) {
    Vregisters &top = *rtl->top;
    bool address_open = true, data_open = true, seen = false;
    top.s_axil_awaddr = static_cast<uint16_t>(address);
    top.s_axil_wdata = data;
    top.s_axil_wstrb = static_cast<uint8_t>(strobe);
    for (int i = 0; i < 100; i++) {
        top.s_axil_awvalid = address_open && (top.s_axil_awvalid || !rtl->hesitate());
        top.s_axil_wvalid = data_open && (top.s_axil_wvalid || !rtl->hesitate());
        top.s_axil_bready = !rtl->hesitate();
        rtl->settle();
        const bool valid = top.s_axil_bvalid;
        const int response = top.s_axil_bresp;
        if (seen && !valid) return -1;
        if (valid && (address_open || data_open)) return -1;
        seen = valid;
        if (top.s_axil_awvalid && top.s_axil_awready) address_open = false;
        if (top.s_axil_wvalid && top.s_axil_wready) data_open = false;
        const bool done = valid && top.s_axil_bready;
        rtl->step();
        if (done) {
            top.s_axil_bready = 0;
            return response;
        }
    }
    return -1;
}
