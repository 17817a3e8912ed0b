// SPDX-License-Identifier: Apache-2.0
#include <memory>

#include "Vemit.h"
#include "coverage.h"
#include "emit_shim.h"
#include "verilated.h"

struct emit_rtl {
    VerilatedContext context;
    std::unique_ptr<Vemit> top;
    uint32_t lane; // port width 2^lane
};

static void clock(emit_rtl *rtl) {
    rtl->top->clk_i = 1;
    rtl->top->eval();
    rtl->top->clk_i = 0;
    rtl->context.timeInc(1);
}

emit_rtl *emit_rtl_new(uint32_t port, uint32_t seed) {
    auto *rtl = new emit_rtl;
    rtl->context.randReset(2);
    rtl->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1));
    rtl->top = std::make_unique<Vemit>(&rtl->context);
    rtl->lane = port == 4 ? 2 : port - 1;
    rtl->top->clk_i = 0;
    rtl->top->op_valid_i = 0;
    rtl->top->tready_i = 0;
    rtl->top->rst_i = 1;
    rtl->top->eval();
    for (int i = 0; i < 2; i++)
        clock(rtl);
    rtl->top->rst_i = 0;
    return rtl;
}

void emit_rtl_free(emit_rtl *rtl) {
    if (rtl) {
        keep_coverage(rtl->context);
        rtl->top->final();
    }
    delete rtl;
}

void emit_rtl_cycle(emit_rtl *rtl, const emit_op *op, const emit_view *view, bool tready,
                    emit_wires *wires) {
    Vemit &top = *rtl->top;
    const uint32_t lane = rtl->lane;
    top.op_valid_i = static_cast<uint8_t>((op != nullptr) << lane);
    top.tready_i = static_cast<uint8_t>(tready << lane);
    if (op) {
        top.op_kind_i = op->kind & 7;
        top.op_generation_i = op->generation & 0xff;
        top.op_number_i = op->number & 0xffffff;
        for (int i = 0; i < 4; i++)
            top.op_position_i[i] = op->position[i];
        for (int i = 0; i < 12; i++)
            top.op_group_i[i] = op->group[i];
        top.op_at_level_i = op->at_level & 1;
        top.op_mask_i = op->mask & 15;
        top.op_triangle_i = op->triangle & 15;
        top.op_child_i = op->child & 15;
        top.op_candidate_i = op->candidate & 15;
        for (int word = 0; word < 12; word++) {
            const int v = word / 3 * 4 + word % 3; // three words hold four vertices
            top.op_vertex_i[word] = op->vertex[v] >> word % 3 * 8 | op->vertex[v + 1]
                                                                        << (24 - word % 3 * 8);
        }
        top.op_sides_i = op->sides & 0xff;
        top.op_first_i = op->first & 1;
        top.op_last_i = op->last & 1;
    }
    top.view_i = static_cast<uint16_t>(view->view);
    top.exponent_i = static_cast<uint16_t>(view->exponent & 0x3ff);
    top.status_i = static_cast<uint8_t>(view->status);
    top.position_i = view->position;
    top.eval();

    wires->op_ready = top.op_ready_o >> lane & 1;
    wires->tvalid = top.tvalid_o >> lane & 1;
    wires->tlast = top.tlast_o >> lane & 1;
    wires->done = top.done_o >> lane & 1;
    wires->busy = top.busy_o >> lane & 1;
    wires->starved = top.starved_o >> lane & 1;
    wires->blocked = top.blocked_o >> lane & 1;
    for (uint32_t i = 0; i < 16; i++)
        wires->tdata[i] = top.tdata_o[16 * lane + i];
    wires->tkeep = top.tkeep_o[2 * lane] | static_cast<uint64_t>(top.tkeep_o[2 * lane + 1]) << 32;
    wires->tid = static_cast<uint32_t>((top.tid_o >> 16 * lane) & 0xffff);
    wires->items_in = top.items_in_o >> 3 * lane & 7;
    wires->items_out = top.items_out_o >> 3 * lane & 7;
    clock(rtl);
}
