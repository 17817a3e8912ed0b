/* SPDX-License-Identifier: Apache-2.0 */
#include "select_shim.h"

#include "Vselect.h"
#include "simulated.h"

static const int BANKS = 8, ROW_BITS = 5, MARK_BITS = 13;

struct select_rtl : simulated<Vselect> {
    using simulated::simulated;
};

select_rtl *select_rtl_new(uint32_t seed) {
    auto *rtl = new select_rtl(seed);
    rtl->top->start_i = 0;
    rtl->reset();
    return rtl;
}

void select_rtl_free(select_rtl *rtl) {
    delete rtl;
}

/* The bits of an answer that has come: the memories' next word, at the place of the bank's. */
static void set_bits(VlWide<4> &words, int at, int bits, uint32_t value) {
    for (int i = 0; i < bits; i++) {
        const uint32_t bit = UINT32_C(1) << (at + i) % 32;
        EData &word = words[(at + i) / 32];
        word = value >> i & 1 ? word | bit : word & ~bit;
    }
}

static uint32_t vertex_of(uint64_t rows, int bank) {
    return (rows >> ROW_BITS * bank & 31) << 3 | static_cast<uint32_t>(bank);
}

bool select_rtl_run(select_rtl *rtl, const select_generation *in, select_verdicts *out) {
    Vselect &top = *rtl->top;
    *out = select_verdicts();
    top.items_i = static_cast<uint16_t>(in->items);
    top.quads_i = in->quads;
    top.generation_i = static_cast<uint8_t>(in->generation);
    top.front_depth_i = static_cast<uint8_t>(in->front_depth);
    top.silhouette_depth_i = static_cast<uint8_t>(in->silhouette_depth);
    for (int cycle = 0; cycle < 5000; cycle++) {
        top.start_i = cycle == 0;
        top.eval();
        if (cycle > 1 && !top.active_o) {
            out->any = top.any_o;
            return true;
        }
        if (top.selected_valid_o) {
            if (top.selected_face_o != out->faces) return false;
            out->verdict[out->faces++] = top.selected_verdict_o;
        }
        const bool record = top.record_rd_en_o;
        const uint32_t item = top.record_rd_item_o, face = top.record_rd_face_o;
        const uint32_t banks = top.mark_rd_en_o;
        const uint64_t rows = top.mark_rd_row_o;
        for (int b = 0; b < BANKS; b++)
            if (top.chosen_wr_en_o >> b & 1) out->chosen[vertex_of(top.chosen_wr_row_o, b)] = true;
        rtl->rise();
        if (record) {
            top.record_origin_i = 0;
            for (int i = 0; i < 4; i++)
                top.record_origin_i |= static_cast<uint32_t>(in->item[item].origin[i]) << 8 * i;
            top.record_half_i = in->item[item].half;
            top.record_candidate_i = in->item[item].candidate;
            top.record_forced_i = in->item[item].forced;
            top.record_last_i = in->item[item].last;
            top.face_front_i = in->face[face].front;
            top.face_stop_i = in->face[face].stop;
        }
        for (int b = 0; b < BANKS; b++)
            if (banks >> b & 1) {
                out->read[vertex_of(rows, b)] = true;
                set_bits(top.mark_rd_data_i, MARK_BITS * b, MARK_BITS,
                         in->mark[vertex_of(rows, b)]);
            }
    }
    return false;
}
