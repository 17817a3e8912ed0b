/* SPDX-License-Identifier: Apache-2.0 */
#include "classify_shim.h"

#include <cstring>

#include "Vclassify.h"
#include "simulated.h"

struct classify_shim : simulated<Vclassify> {
    using simulated::simulated;
    uint32_t random = 1;
};

classify_shim *classify_new(uint32_t seed) {
    auto *shim = new classify_shim(seed);
    shim->random = seed | 1;
    Vclassify &top = *shim->top;
    top.birth_i = top.load_i = top.hold_i = top.classify_i = top.smooth_i = top.look_i = 0;
    top.send_ready_i = 0;
    shim->reset();
    return shim;
}

void classify_free(classify_shim *shim) {
    delete shim;
}

static void load(classify_shim *shim, uint32_t number, const classify_vertex &vertex) {
    Vclassify &top = *shim->top;
    top.vertex_i = number;
    top.birth_i = 1;
    top.sharp_i = vertex.sharp;
    top.sent_i = vertex.sent;
    std::memcpy(&top.position_i, vertex.old, sizeof vertex.old);
    shim->rise();
    top.birth_i = 0;
    top.load_i = 1;
    std::memcpy(&top.position_i, vertex.position, sizeof vertex.position);
    shim->rise();
    top.load_i = 0;
}

static void show(Vclassify &top, const classify_item &item) {
    uint64_t origin = 0;
    uint32_t sharpness = 0;
    for (int i = 0; i < 4; i++) {
        origin |= static_cast<uint64_t>(item.origin[i]) << 10 * i;
        sharpness |= static_cast<uint32_t>(item.sharpness[i]) << 4 * i;
    }
    top.origin_i = origin;
    top.sharpness_i = static_cast<uint16_t>(sharpness);
    top.border_i = item.border;
    top.boundary_i = item.boundary;
    top.tag_i = item.tag;
    top.half_i = item.half;
    top.last_i = item.last;
}

static bool classify(classify_shim *shim, const classify_generation &in, classify_run *out) {
    Vclassify &top = *shim->top;
    top.classify_i = 1;
    for (out->cycles = 0; out->cycles < 100000; out->cycles++) {
        top.eval();
        if (top.point_valid_o) {
            if (top.face_o != out->faces || out->faces == CLASSIFY_ITEMS) return false;
            classified_face &face = out->face[out->faces++];
            std::memcpy(face.point, &top.point_o, sizeof face.point);
            face.front = top.front_o;
            face.stop = top.stop_o;
        }
        const bool asked = top.rd_en_o;
        const uint32_t item = top.rd_item_o;
        if (!top.classify_i && !top.classify_active_o) return true;
        shim->rise();
        if (asked && item < in.items) show(top, in.item[item]);
        top.classify_i = 0;
    }
    return false;
}

static void look(classify_shim *shim, const classify_generation &in, classify_run *out) {
    Vclassify &top = *shim->top;
    top.look_i = 1;
    for (uint32_t v = 0; v < in.vertices; v++) {
        top.row_i = static_cast<uint8_t>(v / 8);
        shim->rise();
        uint32_t word = 0;
        for (uint32_t bit = 0; bit < 13; bit++) {
            const uint32_t at = v % 8 * 13 + bit;
            word |= (top.marks_o[at / 32] >> at % 32 & 1) << bit;
        }
        out->vertex[v].active = word >> 5 == in.generation;
        out->vertex[v].marks = word & 15;
    }
    top.look_i = 0;
}

static bool smooth(classify_shim *shim, classify_run *out) {
    Vclassify &top = *shim->top;
    top.smooth_i = 1;
    for (uint32_t cycle = 0; cycle < 100000; cycle++) {
        shim->random = shim->random * 1664525 + 1013904223;
        top.send_ready_i = shim->random >> 30 != 0;
        top.eval();
        if (top.write_o) {
            smoothed_vertex &vertex = out->vertex[top.write_vertex_o];
            if (top.move_o) {
                vertex.moved = true;
                std::memcpy(vertex.position, &top.write_position_o, sizeof vertex.position);
            }
        }
        if (top.old_o)
            std::memcpy(out->vertex[top.old_vertex_o].old, &top.before_o, sizeof(int32_t[4]));
        if (top.send_valid_o && top.send_ready_i) {
            smoothed_vertex &vertex = out->vertex[top.send_vertex_o];
            if (vertex.sent) return false;
            vertex.sent = true;
            vertex.at_level = top.at_level_o;
            std::memcpy(vertex.left_at, &top.send_position_o, sizeof vertex.left_at);
        }
        if (!top.smooth_i && !top.smooth_active_o) return true;
        shim->rise();
        top.smooth_i = 0;
    }
    return false;
}

bool classify_generation_run(classify_shim *shim, const classify_generation *in,
                             classify_run *out) {
    Vclassify &top = *shim->top;
    std::memset(out, 0, sizeof *out);
    top.generation_i = in->generation;
    top.limit_i = in->limit;
    top.finish_i = in->finish;
    top.min_edge_i = in->min_edge;
    top.width_i = in->width;
    top.height_i = in->height;
    top.items_i = static_cast<uint16_t>(in->items);
    top.vertices_i = static_cast<uint16_t>(in->vertices);
    for (uint32_t v = 0; v < in->vertices; v++) {
        load(shim, v, in->vertex[v]);
        std::memcpy(out->vertex[v].position, in->vertex[v].position, sizeof(int32_t[4]));
        std::memcpy(out->vertex[v].old, in->vertex[v].old, sizeof(int32_t[4]));
    }
    if (!classify(shim, *in, out)) return false;
    look(shim, *in, out);
    for (uint32_t v = 0; v < in->vertices; v++) {
        top.vertex_i = v;
        top.hold_i = in->vertex[v].held;
        shim->rise();
    }
    top.hold_i = 0;
    return smooth(shim, out);
}
