/* SPDX-License-Identifier: Apache-2.0 */
#include "geometry_shim.h"

#include <cstring>

#include "Vgeometry.h"
#include "simulated.h"

struct geometry_rtl : simulated<Vgeometry> {
    using simulated::simulated;
};

geometry_rtl *geometry_rtl_new(uint32_t seed) {
    auto *rtl = new geometry_rtl(seed);
    rtl->top->valid_i = 0;
    rtl->top->edges_valid_i = 0;
    rtl->top->marks_valid_i = 0;
    geometry_rtl_reset(rtl);
    return rtl;
}

void geometry_rtl_free(geometry_rtl *rtl) {
    delete rtl;
}

void geometry_rtl_reset(geometry_rtl *rtl) {
    rtl->reset();
}

/* The 40 bits of a sum, at bit 40 k of words of 32. */
static int64_t sum_of(const VlWide<5> &words, int k) {
    const int word = 40 * k / 32, bit = 40 * k % 32;
    const uint64_t both = static_cast<uint64_t>(words[word + 1]) << 32 | words[word];
    return static_cast<int64_t>(both >> bit << 24) >> 24;
}

static void set(Vgeometry &top, const geometry_settings *settings) {
    top.quads_i = settings->quads;
    top.min_edge_i = static_cast<uint16_t>(settings->min_edge);
    top.width_i = static_cast<uint16_t>(settings->width);
    top.height_i = static_cast<uint16_t>(settings->height);
}

bool geometry_rtl_cycle(geometry_rtl *rtl, const geometry_settings *settings,
                        const geometry_item *in, geometry_face *out) {
    Vgeometry &top = *rtl->top;
    const bool valid = top.valid_o;
    if (valid) {
        std::memcpy(out->point, &top.point_o[0], sizeof out->point);
        std::memcpy(out->last_position, &top.last_position_o[0], sizeof out->last_position);
        for (int k = 0; k < 4; k++)
            out->sum[k] = sum_of(top.sum_o, k);
        out->front = top.front_o;
        out->back = top.back_o;
        out->hits = top.hits_o;
        out->stop = top.stop_o;
        out->nonquad = top.nonquad_o;
        out->last_border = top.last_border_o;
    }
    set(top, settings);
    top.valid_i = in != nullptr;
    if (in) {
        top.half_i = in->half;
        top.last_i = in->last;
        top.border_i = in->border;
        std::memcpy(&top.position_i[0], in->position, sizeof in->position);
        std::memcpy(&top.source_i[0], in->source, sizeof in->source);
    }
    rtl->rise();
    return valid;
}

bool geometry_rtl_edges(geometry_rtl *rtl, const geometry_settings *settings, uint32_t use,
                        const int32_t v[4][4], const int32_t w[4][4]) {
    static const int component[3] = {0, 1, 3};
    Vgeometry &top = *rtl->top;
    set(top, settings);
    top.valid_i = 0;
    top.edges_use_i = use & 15;
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) {
            top.edges_from_i[3 * i + k] = static_cast<uint32_t>(v[i][component[k]]);
            top.edges_to_i[3 * i + k] = static_cast<uint32_t>(w[i][component[k]]);
        }
    for (int i = 0; i < EDGES_LATENCY; i++) {
        top.edges_valid_i = i == 0;
        rtl->rise();
    }
    return top.edges_short_o;
}

void geometry_rtl_marks(geometry_rtl *rtl, const geometry_marks *in, bool *front, bool *back) {
    Vgeometry &top = *rtl->top;
    *front = top.marks_front_o;
    *back = top.marks_back_o;
    top.valid_i = 0;
    top.edges_valid_i = 0;
    top.marks_valid_i = in != nullptr;
    if (in) {
        top.marks_use_i = in->use & 15;
        std::memcpy(&top.marks_vectors_i[0], in->vector, sizeof in->vector);
    }
    rtl->rise();
}
