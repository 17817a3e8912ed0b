/* SPDX-License-Identifier: Apache-2.0 */
#include "window_shim.h"

#include "Vwindow.h"
#include "simulated.h"

struct window_shim : simulated<Vwindow> {
    using simulated::simulated;
};

static uint32_t indices_of(const window_item *item) {
    uint32_t packed = 0;
    for (int i = 0; i < 4; i++)
        packed |= static_cast<uint32_t>(item->index[i] % WINDOW_WORDS) << 6 * i;
    return packed;
}

static uint32_t data_of(const window_item *item) {
    uint32_t packed = 0;
    for (int i = 0; i < 4; i++)
        packed |= static_cast<uint32_t>(item->data[i]) << 8 * i;
    return packed;
}

window_shim *window_new(uint32_t seed) {
    auto *shim = new window_shim(seed);
    shim->top->write_valid_i = shim->top->read_valid_i = shim->top->stall_i = 0;
    shim->reset();
    return shim;
}

void window_free(window_shim *shim) {
    delete shim;
}

window_wires window_cycle(window_shim *shim, const window_item *write, const window_item *read,
                          bool stall) {
    Vwindow &top = *shim->top;
    top.write_valid_i = write->valid;
    top.write_mask_i = write->mask & 15;
    top.write_index_i = indices_of(write);
    top.write_data_i = data_of(write);
    top.read_valid_i = read->valid;
    top.read_mask_i = read->mask & 15;
    top.read_index_i = indices_of(read);
    top.read_item_i = read->number;
    top.stall_i = stall;
    top.eval();
    window_wires wires = {};
    wires.write_ready = top.write_ready_o;
    wires.write_active = top.write_active_o;
    wires.write_conflict = top.write_conflict_o;
    wires.read_ready = top.read_ready_o;
    wires.read_active = top.read_active_o;
    wires.read_conflict = top.read_conflict_o;
    wires.out = top.out_valid_o;
    wires.number = top.out_item_o;
    for (int i = 0; i < 4; i++)
        wires.data[i] = static_cast<uint8_t>(top.out_data_o >> 8 * i);
    shim->rise();
    return wires;
}
