/* SPDX-License-Identifier: Apache-2.0 */
#include "fp_shim.h"

#include <cstring>

#include "Vfp_top.h"
#include "coverage.h"
#include "verilated.h"

struct fp_shim {
    VerilatedContext context;
    Vfp_top top{&context};
};

/* One clock cycle. Afterwards the outputs are those of the next cycle. */
static void step(fp_shim *shim) {
    shim->top.clk_i = 1;
    shim->top.eval();
    shim->top.clk_i = 0;
    shim->top.eval();
}

/* A linear congruential step; true every second time or so. Never for state 0. */
static bool gap(uint32_t *state) {
    if (*state == 0) return false;
    *state = *state * 1664525u + 1013904223u;
    if (*state == 0) *state = 1;
    return *state >> 31;
}

fp_shim *fp_new(void) {
    fp_shim *shim = new fp_shim;
    shim->top.rst_i = 1;
    step(shim);
    step(shim);
    shim->top.rst_i = 0;
    step(shim);
    return shim;
}

void fp_free(fp_shim *shim) {
    keep_coverage(shim->context);
    delete shim;
}

/* Bit k of history: an item went in k+1 cycles ago. */
bool fp_binary(fp_shim *shim, enum fp_operation operation, size_t n, const uint32_t *a,
               const uint32_t *b, uint32_t *y, uint32_t gaps) {
    const unsigned latency = 3;
    Vfp_top &top = shim->top;
    uint32_t history = 0;
    bool timely = true;
    for (size_t in = 0, out = 0, drain = 0; drain <= latency; drain += in == n) {
        bool valid = in < n && !gap(&gaps);
        top.add_valid_i = valid && operation == FP_ADD;
        top.mul_valid_i = valid && operation == FP_MUL;
        top.a_i = valid ? a[in] : 0x5a5a5a5a;
        top.b_i = valid ? b[in] : 0xa5a5a5a5;
        in += valid;
        step(shim);
        history = history << 1 | valid;
        bool due = history >> (latency - 1) & 1;
        timely &= top.add_valid_o == (due && operation == FP_ADD);
        timely &= top.mul_valid_o == (due && operation == FP_MUL);
        if (due) y[out++] = operation == FP_ADD ? top.add_y_o : top.mul_y_o;
    }
    return timely;
}

bool fp_transform(fp_shim *shim, const uint32_t matrix[16], size_t n, const uint32_t *record,
                  fp_vertex *vertex, uint32_t *magnitude, uint32_t gaps) {
    const unsigned latency = 9;
    Vfp_top &top = shim->top;
    uint32_t history = 0;
    bool timely = !top.transform_busy_o;
    top.transform_clear_i = 1;
    step(shim);
    top.transform_clear_i = 0;
    for (unsigned k = 0; k < 16; k++)
        top.transform_matrix_i[k] = matrix[k];
    *magnitude = 0;
    for (size_t in = 0, out = 0, drain = 0; drain <= latency + 1; drain += in == n) {
        bool valid = in < n && !gap(&gaps);
        top.transform_valid_i = valid;
        top.transform_index_i = (uint32_t)(valid ? in : ~in) & (FP_VERTICES - 1);
        for (unsigned k = 0; k < 4; k++)
            top.transform_record_i[k] = valid ? record[4 * in + k] : 0x7f800000;
        in += valid;
        step(shim);
        history = history << 1 | valid;
        bool due = history >> (latency - 1) & 1;
        timely &= top.transform_valid_o == due;
        timely &= top.transform_busy_o == ((history & ((2u << latency) - 1)) != 0);
        timely &= due || !top.transform_overflow_o;
        if (due) {
            fp_vertex *v = &vertex[out++];
            for (unsigned k = 0; k < 4; k++)
                v->clip[k] = top.transform_clip_o[k];
            v->index = top.transform_index_o;
            v->overflow = top.transform_overflow_o;
            v->overflow_row = top.transform_overflow_row_o;
        }
        if (!top.transform_busy_o) *magnitude = top.transform_magnitude_o;
    }
    return timely;
}

int32_t fp_to_fixed(fp_shim *shim, uint32_t c, int exponent) {
    shim->top.fixed_valid_i = 1;
    shim->top.fixed_c_i = c;
    shim->top.fixed_exponent_i = (uint32_t)exponent & 0x3ff;
    step(shim);
    return (int32_t)shim->top.fixed_q_o;
}

uint32_t fp_to_float(fp_shim *shim, int32_t q, int exponent) {
    shim->top.float_q_i = (uint32_t)q;
    shim->top.float_exponent_i = (uint32_t)exponent & 0x3ff;
    shim->top.eval();
    return shim->top.float_c_o;
}

/* exponent_o's ten bits as a signed number. */
static int sign_extend(uint32_t bits) {
    return bits & 0x200 ? (int)bits - 0x400 : (int)bits;
}

fp_quantize_report fp_quantize(fp_shim *shim, uint32_t count, uint32_t magnitude,
                               uint32_t *memory) {
    Vfp_top &top = shim->top;
    fp_quantize_report report;
    memset(&report, 0, sizeof report);
    top.quantize_start_i = 1;
    top.quantize_count_i = count;
    top.quantize_magnitude_i = magnitude;
    for (uint32_t cycle = 0, next_read = 0, next_write = 0;; cycle++) {
        unsigned active = top.quantize_busy_o + top.quantize_starved_o + top.quantize_blocked_o;
        report.busy += top.quantize_busy_o;
        report.starved += top.quantize_starved_o;
        report.blocked += top.quantize_blocked_o;
        report.idle += active == 0;
        report.confused += active > 1;
        report.items_in += top.quantize_item_in_o;
        report.items_out += top.quantize_item_out_o;
        if (top.quantize_wr_en_o) {
            report.unordered += top.quantize_wr_index_o != next_write++;
            for (unsigned k = 0; k < 4; k++)
                memory[4 * top.quantize_wr_index_o + k] = top.quantize_wr_data_o[k];
        }
        if (top.quantize_done_o || cycle > count + 100) {
            report.done_cycle = cycle;
            break;
        }
        bool read = top.quantize_rd_en_o;
        uint32_t index = top.quantize_rd_index_o;
        if (read) report.unordered += index != next_read++;
        step(shim);
        top.quantize_start_i = 0;
        top.quantize_count_i = 0;
        top.quantize_magnitude_i = 0x7f7fffff;
        for (unsigned k = 0; k < 4; k++)
            top.quantize_rd_data_i[k] = read ? memory[4 * index + k] : 0x7fc0ffee;
    }
    report.exponent = sign_extend(top.quantize_exponent_o);
    step(shim);
    return report;
}
