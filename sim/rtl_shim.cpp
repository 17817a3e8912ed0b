/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl_pins.h on what Verilator writes, or on a stand-in of the same name.
 */
#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <utility>
#include <vector>

#include "Vhalfstep.h"
#include "coverage.h"
#include "definitions.h"
#include "rtl_pins.h"
#include "svdpi.h"
#include "verilated.h"
#include "verilated_fst_c.h"

static constexpr size_t BEAT_WORDS = sizeof(Vhalfstep::m_axis_tdata) / 4;
static_assert(BEAT_WORDS <= HS_MOST_BEAT_WORDS, "hs_axis holds a beat");

struct hs_rtl_top {
    VerilatedContext context;
    std::unique_ptr<Vhalfstep> model;
    std::unique_ptr<VerilatedFstC> trace;
    uint64_t trace_first = 0, trace_last = 0;
    hs_rtl_probe *probe = nullptr;
    void *probe_context = nullptr;

    void dump(uint64_t cycle, uint64_t time) {
        if (trace && cycle >= trace_first && cycle <= trace_last) trace->dump(time);
    }
};

/* No exception goes up into C: what C++ throws for want of memory becomes an error. */
template <typename Work> static bool guarded(hs_error *err, Work work) {
    try {
        return work();
    } catch (const std::exception &) { /* bad_alloc, or system_error where a thread has no stack */
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the simulation; free some memory");
    }
}

/* --- Probes ------------------------------------------------------------------------------------
 */

/* The one whose edge it is, if somebody looks at its transactions. */
static thread_local hs_rtl_top *probed;

/* The number of the pipeline from which a probe calls, by the name of its place: "g_pipeline[1]".
 */
static uint32_t calling_pipeline() {
    static thread_local std::vector<std::pair<svScope, uint32_t>> known;
    const svScope scope = svGetScope();
    for (const auto &entry : known)
        if (entry.first == scope) return entry.second;
    const char *name = std::strstr(svGetNameFromScope(scope), "g_pipeline");
    uint32_t number = 0;
    for (const char *c = name; c && *c && *c != '.' && !number; c++)
        if (*c >= '0' && *c <= '9') number = static_cast<uint32_t>(*c - '0');
    known.emplace_back(scope, number);
    return number;
}

/* For sim/probes.sv, which calls them at the clock's edge. */
extern "C" unsigned char hs_probe_on() {
    return probed != nullptr;
}
extern "C" void hs_probe(unsigned probe, unsigned item, unsigned a, unsigned b, unsigned c,
                         unsigned d) {
    const uint32_t word[4] = {a, b, c, d};
    probed->probe(probed->probe_context, calling_pipeline(), probe, item, word);
}

void hs_rtl_top_probe(hs_rtl_top *top, hs_rtl_probe *probe, void *context) {
    top->probe = probe;
    top->probe_context = context;
}

/* --- Construction ------------------------------------------------------------------------------
 */

/* Verilator's runtime does not survive it if memory ends while it builds a simulation: some hundred
 * thousand bytes beside the pipeline's own have to be there before. */
static bool has_memory() {
    constexpr size_t beside = size_t{16} << 20;
    const std::unique_ptr<char[]> room(new (std::nothrow) char[beside]);
    return room != nullptr;
}

hs_rtl_top *hs_rtl_top_new(uint32_t seed, hs_error *err) {
    std::unique_ptr<hs_rtl_top> top;
    const bool built = guarded(err, [&] {
        if (!has_memory()) throw std::bad_alloc();
        top = std::make_unique<hs_rtl_top>();
        top->context.traceEverOn(true);
        top->context.fatalOnError(false);
        top->context.randReset(2);
        top->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1)); /* 0: chosen by the clock */
        top->model = std::make_unique<Vhalfstep>(&top->context);
        return true;
    });
    return built ? top.release() : nullptr;
}

/* Verilator's runtime asks the thread for its context, which is that of the simulation built last:
 * another one's errors would be counted there, or in freed memory. */
void hs_rtl_top_enter(hs_rtl_top *top) {
    Verilated::threadContextp(&top->context);
}

void hs_rtl_top_free(hs_rtl_top *top) {
    if (!top) return;
    hs_rtl_top_enter(top);
    if (top->trace) top->trace->close();
    keep_coverage(top->context);
    top->model->final();
    delete top;
}

void *hs_rtl_top_model(hs_rtl_top *top) {
    return top->model.get();
}

void hs_rtl_top_forgive(hs_rtl_top *top) {
    top->context.gotError(false);
    top->context.gotFinish(false);
}

void hs_rtl_top_assert(hs_rtl_top *top, bool on) {
    top->context.assertOn(on);
}

bool hs_rtl_top_trace(hs_rtl_top *top, const char *path, uint64_t first, uint64_t last,
                      hs_error *err) {
    return guarded(err, [&] {
        if (top->trace) top->trace->close();
        top->trace.reset();
        if (!path) return true;
        top->trace = std::make_unique<VerilatedFstC>();
        top->model->trace(top->trace.get(), 99);
        top->trace->open(path);
        top->trace_first = first;
        top->trace_last = last;
        if (top->trace->isOpen()) return true;
        top->trace.reset();
        return hs_fail(err, HS_EXIT_FILE, "%s: cannot be written; check its folder", path);
    });
}

/* --- A cycle -----------------------------------------------------------------------------------
 */

size_t hs_rtl_top_beat_words(void) {
    return BEAT_WORDS;
}

static void drive(Vhalfstep &model, const hs_pins &pins) {
    model.rst_i = pins.rst;
    model.s_axis_tvalid = pins.s_axis.valid;
    model.s_axis_tlast = pins.s_axis.last;
    model.s_axis_tid = pins.s_axis.id;
    model.s_axis_tkeep = pins.s_axis.keep;
    std::copy_n(pins.s_axis.data, BEAT_WORDS, &model.s_axis_tdata[0]);
    model.m_axis_tready = pins.m_axis_ready;
    model.s_axil_arvalid = pins.arvalid;
    model.s_axil_araddr = pins.araddr;
    model.s_axil_rready = pins.rready;
    model.s_axil_awvalid = pins.awvalid;
    model.s_axil_awaddr = pins.awaddr;
    model.s_axil_wvalid = pins.wvalid;
    model.s_axil_wdata = pins.wdata;
    model.s_axil_wstrb = 15;
    model.s_axil_bready = pins.bready;
}

static void show(const Vhalfstep &model, hs_pins &pins) {
    pins.s_axis_ready = model.s_axis_tready;
    pins.m_axis.valid = model.m_axis_tvalid;
    if (model.m_axis_tvalid) {
        pins.m_axis.last = model.m_axis_tlast;
        pins.m_axis.id = model.m_axis_tid;
        pins.m_axis.keep = model.m_axis_tkeep;
        std::copy_n(&model.m_axis_tdata[0], BEAT_WORDS, pins.m_axis.data);
    }
    pins.arready = model.s_axil_arready;
    pins.rvalid = model.s_axil_rvalid;
    pins.rdata = model.s_axil_rdata;
    pins.rresp = model.s_axil_rresp;
    pins.awready = model.s_axil_awready;
    pins.wready = model.s_axil_wready;
    pins.bvalid = model.s_axil_bvalid;
    pins.bresp = model.s_axil_bresp;
}

bool hs_rtl_top_settle(hs_rtl_top *top, hs_pins *pins, uint64_t cycle, hs_error *err) {
    return guarded(err, [&] {
        drive(*top->model, *pins);
        top->model->clk_i = 0;
        top->model->eval();
        top->dump(cycle, 10 * cycle + 5);
        show(*top->model, *pins);
        return true;
    });
}

bool hs_rtl_top_edge(hs_rtl_top *top, uint64_t cycle, hs_error *err) {
    return guarded(err, [&] {
        probed = top->probe ? top : nullptr;
        top->model->clk_i = 1;
        top->model->eval();
        probed = nullptr;
        top->context.time(cycle + 1); /* what the assertions print */
        top->dump(cycle + 1, 10 * (cycle + 1));
        if (!top->context.gotError()) return true;
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "cycle %llu: an assertion of the RTL failed (printed above)",
                       static_cast<unsigned long long>(cycle));
    });
}
