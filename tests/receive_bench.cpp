/* SPDX-License-Identifier: Apache-2.0
 *
 * A cycle here: inputs are set, the outputs that depend on them alone are read, then the clock
 * rises. All widths of the port are the same template over three Verilated classes.
 */
#include "receive_bench.h"

#include <cmath>
#include <cstring>
#include <memory>

#include "Vreceive1.h"
#include "Vreceive2.h"
#include "Vreceive4.h"
#include "coverage.h"
#include "verilated.h"

namespace {

constexpr int TRANSFORM_CYCLES = 9;

/* A port of up to 64 bits is an integer, a wider one an array of words; TKEEP of a narrow port and
 * of a wide one so look different. */
template <typename T> void set_keep(T &port, uint32_t records) {
    port = static_cast<T>(records == 4 ? ~0ull : (1ull << 16 * records) - 1);
}

struct Vertex {
    bool valid;
    uint32_t index;
    int overflow_row; /* -1: none */
};

int overflow_row(const uint32_t matrix[16], const uint32_t record[4]) {
    float m[16], p[4];
    std::memcpy(m, matrix, sizeof m);
    std::memcpy(p, record, sizeof p);
    for (int r = 0; r < 4; r++) {
        volatile float a = m[4 * r] * p[0], b = m[4 * r + 1] * p[1];
        volatile float c = m[4 * r + 2] * p[2], d = m[4 * r + 3] * p[3];
        volatile float ab = a + b, cd = c + d;
        if (!std::isfinite(ab + cd)) return r;
    }
    return -1;
}

} // namespace

struct receive_bench {
    virtual ~receive_bench() = default;
    virtual void run(const hs_packet *packet, const receive_send *send, receive_result *result) = 0;
};

namespace {

template <typename Top, uint32_t RECORDS> struct Bench : receive_bench {
    VerilatedContext context;
    std::unique_ptr<Top> top;
    Vertex pipe[TRANSFORM_CYCLES] = {};

    ~Bench() override {
        keep_coverage(context);
    }
    explicit Bench(uint32_t seed) {
        context.randSeed(static_cast<int>(seed));
        context.randReset(2);
        top = std::make_unique<Top>(&context);
        top->clk_i = 0;
        top->s_axis_tvalid = 0;
        top->start_i = 0;
        top->transform_busy_i = 0;
        top->overflow_i = 0;
        top->limit_vertices_i = RECEIVE_VERTICES;
        top->limit_quads_i = RECEIVE_QUADS;
        top->rst_i = 1;
        for (int i = 0; i < 2; i++)
            rise();
        top->rst_i = 0;
    }

    void rise() {
        top->clk_i = 1;
        top->eval();
        context.timeInc(1);
        top->clk_i = 0;
        top->eval();
        context.timeInc(1);
    }

    /* The transform's outputs of this cycle; step_transform shows it the vertex of this cycle. */
    void drive_transform() {
        const Vertex &out = pipe[TRANSFORM_CYCLES - 1];
        bool busy = false;
        for (const Vertex &v : pipe)
            busy = busy || v.valid;
        top->transform_busy_i = busy;
        top->overflow_i = out.valid && out.overflow_row >= 0;
        top->overflow_index_i = static_cast<uint16_t>(out.index & (RECEIVE_VERTICES - 1));
        top->overflow_row_i = static_cast<uint8_t>(out.overflow_row & 3);
    }
    void step_transform() {
        for (int i = TRANSFORM_CYCLES - 1; i > 0; i--)
            pipe[i] = pipe[i - 1];
        pipe[0] = {top->vertex_valid_o != 0, top->vertex_index_o, -1};
        uint32_t matrix[16], record[4];
        for (int i = 0; i < 16; i++)
            matrix[i] = top->matrix_o[i];
        for (int i = 0; i < 4; i++)
            record[i] = top->vertex_record_o[i];
        if (pipe[0].valid) pipe[0].overflow_row = overflow_row(matrix, record);
    }

    void write_down(receive_result *r) {
        if (top->vertex_valid_o) {
            uint32_t i = top->vertex_index_o;
            r->not_in_order += i != r->vertices_stored;
            for (int k = 0; k < 4; k++)
                r->vertex[i][k] = top->vertex_record_o[k];
            r->vertices_stored++;
        }
        r->vertices_done += top->vertices_done_o;
        if (top->corner_valid_o) {
            uint32_t i = top->corner_index_o;
            r->not_in_order += i != r->corners_stored;
            r->corner[i] = {top->corner_origin_o,
                            top->corner_border_o || top->corner_boundary_o
                                ? static_cast<uint32_t>(HS_BORDER)
                                : static_cast<uint32_t>(top->corner_twin_o),
                            top->corner_face_o,
                            top->corner_forced_o,
                            top->corner_first_o,
                            top->corner_last_o,
                            top->corner_border_o,
                            top->corner_boundary_o,
                            top->corner_sharpness_o,
                            top->corner_own_o};
            r->corners_stored++;
        }
        r->busy += top->busy_o;
        r->starved += top->starved_o;
        r->blocked += top->blocked_o;
        r->items_in += top->item_in_o;
        r->items_out += top->item_out_o;
    }

    void read_header(receive_result *r) {
        r->status = top->status_o;
        r->position = top->position_o;
        r->view = top->view_o;
        r->uniform = top->uniform_o;
        r->guard = top->guard_o;
        r->limit = top->limit_o;
        r->kept = top->kept_o;
        r->corners_stay = top->corners_stay_o;
        r->front_depth = top->front_depth_o;
        r->silhouette_depth = top->silhouette_depth_o;
        r->uniform_depth = top->uniform_depth_o;
        r->min_edge = top->min_edge_o;
        r->width = top->width_o;
        r->height = top->height_o;
        r->vertices = top->vertices_o;
        r->faces = top->faces_o;
        r->halfedges = top->halfedges_o;
        r->forced_max = top->forced_max_o;
        r->closed = top->closed_o;
        r->boundary_count = top->boundary_count_o;
        for (int i = 0; i < 16; i++)
            r->matrix[i] = top->matrix_o[i];
    }

    void run(const hs_packet *packet, const receive_send *send, receive_result *r) override {
        *r = receive_result{};
        const size_t records = packet->words / 4;
        const size_t full = (records + RECORDS - 1) / RECORDS;
        const size_t beats = full + (send->empty_beat || records == 0 ? 1 : 0);
        const uint64_t bound = 200 + 4 * records * 100 / (100u - send->pause);
        size_t beat = 0;
        bool offered = false;
        uint32_t random = send->seed * 2654435761u + 1;
        top->limit_vertices_i = static_cast<uint16_t>(send->limit_vertices);
        top->limit_quads_i = static_cast<uint16_t>(send->limit_quads);

        for (uint64_t cycle = 0; cycle < bound; cycle++) {
            random = random * 1664525u + 1013904223u;
            if (!offered && beat < beats) offered = (random >> 16) % 100 >= send->pause;
            top->start_i = cycle == send->start_cycle;
            top->s_axis_tvalid = offered;
            top->s_axis_tlast = beat + 1 == beats;
            /* Later beats carry another TID: only the first one's counts. */
            top->s_axis_tid = static_cast<uint16_t>(beat == 0 ? packet->view : ~packet->view);
            uint32_t here = 0;
            for (size_t k = 0; k < 4 * RECORDS; k++) {
                size_t word = 4 * RECORDS * beat + k;
                bool present = word < packet->words;
                top->s_axis_tdata[k] = present ? packet->word[word] : 0x5a5a5a5au;
                here += present && k % 4 == 0;
            }
            set_keep(top->s_axis_tkeep, here);
            drive_transform();
            top->eval();
            bool ready = top->s_axis_tready;
            if (ready && (cycle <= send->start_cycle || beat == beats)) r->wrong_cycles++;
            if (top->done_o && cycle > 0 && cycle <= send->start_cycle) r->wrong_cycles++;
            if (cycle > send->start_cycle) {
                r->cycles++;
                write_down(r);
            }
            if (top->done_o && cycle > send->start_cycle) {
                read_header(r);
                r->finished = beat == beats && !top->transform_busy_i;
                break; /* the next run begins in this very cycle */
            }
            bool taken = offered && ready;
            step_transform();
            rise();
            if (taken) {
                beat++;
                offered = false;
            }
        }
        top->s_axis_tvalid = 0;
        top->start_i = 0;
    }
};

} // namespace

receive_bench *receive_bench_new(uint32_t port_records, uint32_t seed) {
    if (port_records == 1) return new Bench<Vreceive1, 1>(seed);
    if (port_records == 2) return new Bench<Vreceive2, 2>(seed);
    if (port_records == 4) return new Bench<Vreceive4, 4>(seed);
    return nullptr;
}

void receive_bench_free(receive_bench *bench) {
    delete bench;
}

void receive_bench_run(receive_bench *bench, const hs_packet *packet, const receive_send *send,
                       receive_result *result) {
    bench->run(packet, send, result);
}
