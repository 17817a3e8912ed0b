/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl.h on the Verilated pipeline: drives the streams with their pauses, watches the rules of the
 * output, reads the counters over AXI4-Lite.
 *
 * A cycle has two halves. In the first the inputs are set and settle, and what the ports show is
 * what both sides see at the coming edge; the second is the edge. In a waveform, cycle c lasts from
 * time 10c (its state) to 10c + 10, and its inputs come at 10c + 5.
 */
#include <algorithm>
#include <cstring>
#include <exception>
#include <memory>
#include <new>
#include <string>
#include <vector>

#include "Vhalfstep.h"
#include "coverage.h"
#include "rtl.h"
#include "svdpi.h"
#include "verilated.h"
#include "verilated_fst_c.h"

static constexpr size_t BEAT_WORDS = sizeof(Vhalfstep::m_axis_tdata) / 4;
static constexpr uint32_t COUNTERS = 6; /* of a stage: the activities, in, out */
static constexpr uint32_t IN = 4, OUT = 5;

/* One bus access at a time. The slave sees it from start() on; done is set by observe(). */
struct axil {
    bool reading = false, writing = false, address_open = false, data_open = false;
    uint32_t address = 0, data = 0, response = 0;
    uint64_t when = 0; /* cycle in which a read's address was taken */

    bool idle() const {
        return !reading && !writing;
    }
    void read(uint32_t from) {
        reading = address_open = true;
        address = from;
    }
    void write(uint32_t to, uint32_t value) {
        writing = address_open = data_open = true;
        address = to;
        data = value;
    }
};

/* The counters of all stages, read while no stage works. */
struct snapshot {
    uint64_t when; /* cycle to which they refer */
    uint32_t cycles, conflicts;
    uint32_t stage[HS_STAGES][COUNTERS];
};

struct hs_rtl {
    VerilatedContext context;
    std::unique_ptr<Vhalfstep> top;
    std::unique_ptr<VerilatedFstC> trace;
    uint64_t trace_first = 0, trace_last = 0;
    uint64_t cycle = 0;
    uint64_t limit = UINT64_MAX; /* of cycles, set by hs_rtl_cycle_limit */
    hs_limits limits{}, capacity{};
    uint32_t architecture = 0;
    axil bus;
    snapshot before{};
    std::vector<uint32_t> beat_cycle; /* of the last run: when each beat was taken */
    bool broken = false;              /* the last run failed: reset before the next */
    hs_log *log = nullptr;
    hs_log *logs = nullptr; /* of hs_rtl_stream: one a pipeline */
    uint64_t begin = 0;     /* of the last run */
    hs_rtl_strike *strike = nullptr;
    void *strike_context = nullptr;
};

/* The simulation whose transactions are logged: set while it streams a packet. */
static thread_local hs_rtl *logging;

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
    return logging != nullptr;
}
extern "C" void hs_probe(unsigned probe, unsigned item, unsigned a, unsigned b, unsigned c,
                         unsigned d) {
    const uint32_t word[4] = {a, b, c, d};
    hs_log *log = logging->logs ? &logging->logs[calling_pipeline()] : logging->log;
    hs_log_add(log, probe, logging->cycle - logging->begin, item, word);
}

/* --- Cycles -------------------------------------------------------------------------------------
 */
static void dump(hs_rtl *rtl, uint64_t time) {
    if (rtl->trace && rtl->cycle >= rtl->trace_first && rtl->cycle <= rtl->trace_last)
        rtl->trace->dump(time);
}

/* First half: inputs are set, outputs settle. */
static void settle(hs_rtl *rtl) {
    Vhalfstep &top = *rtl->top;
    const axil &bus = rtl->bus;
    top.s_axil_arvalid = bus.reading && bus.address_open;
    top.s_axil_araddr = static_cast<uint16_t>(bus.address);
    top.s_axil_rready = bus.reading;
    top.s_axil_awvalid = bus.writing && bus.address_open;
    top.s_axil_awaddr = static_cast<uint16_t>(bus.address);
    top.s_axil_wvalid = bus.writing && bus.data_open;
    top.s_axil_wdata = bus.data;
    top.s_axil_wstrb = 15;
    top.s_axil_bready = bus.writing;
    top.clk_i = 0;
    top.eval();
    dump(rtl, 10 * rtl->cycle + 5);
}

/* Second half: the clock's edge. False if an assertion of the RTL failed; it has printed itself. */
static bool step(hs_rtl *rtl, hs_error *err) {
    Vhalfstep &top = *rtl->top;
    axil &bus = rtl->bus;
    if (bus.reading) {
        if (bus.address_open && top.s_axil_arready) {
            bus.address_open = false;
            bus.when = rtl->cycle;
        } else if (!bus.address_open && top.s_axil_rvalid) {
            bus.reading = false;
            bus.data = top.s_axil_rdata;
            bus.response = top.s_axil_rresp;
        }
    }
    if (bus.writing) {
        if (!bus.address_open && !bus.data_open && top.s_axil_bvalid) {
            bus.writing = false;
            bus.response = top.s_axil_bresp;
        }
        if (bus.address_open && top.s_axil_awready) bus.address_open = false;
        if (bus.data_open && top.s_axil_wready) bus.data_open = false;
    }
    if (rtl->strike) rtl->strike(rtl->strike_context, &top, rtl->cycle - rtl->begin);
    top.clk_i = 1;
    top.eval();
    rtl->cycle++;
    rtl->context.time(rtl->cycle); /* what the assertions print */
    dump(rtl, 10 * rtl->cycle);
    if (!rtl->context.gotError()) return true;
    return hs_fail(err, HS_EXIT_INTERNAL,
                   "cycle %llu: an assertion of the RTL failed (printed above)",
                   static_cast<unsigned long long>(rtl->cycle - 1));
}

/* Lets the bus access finish while the streams rest. */
static bool finish_access(hs_rtl *rtl, hs_error *err) {
    const uint64_t start = rtl->cycle;
    while (!rtl->bus.idle()) {
        settle(rtl);
        if (!step(rtl, err)) return false;
        if (rtl->cycle - start > 1000)
            return hs_fail(err, HS_EXIT_INTERNAL, "register 0x%03x does not answer",
                           rtl->bus.address);
    }
    if (rtl->bus.response)
        return hs_fail(err, HS_EXIT_INTERNAL, "register 0x%03x answers with an error",
                       rtl->bus.address);
    return true;
}

static bool read_register(hs_rtl *rtl, uint32_t address, uint32_t *value, hs_error *err) {
    rtl->bus.read(address);
    if (!finish_access(rtl, err)) return false;
    *value = rtl->bus.data;
    return true;
}

static bool write_register(hs_rtl *rtl, uint32_t address, uint32_t value, hs_error *err) {
    rtl->bus.write(address, value);
    return finish_access(rtl, err);
}

static uint32_t counter_address(uint32_t stage, uint32_t counter) {
    return HS_REG_STAGES + 32 * stage + 4 * counter;
}

/* Reading CYCLES is what the idle counters refer to. */
static bool take_snapshot(hs_rtl *rtl, snapshot *s, hs_error *err) {
    if (!read_register(rtl, HS_REG_CYCLES, &s->cycles, err)) return false;
    s->when = rtl->bus.when;
    for (uint32_t stage = 0; stage < HS_STAGES; stage++)
        for (uint32_t counter = 0; counter < COUNTERS; counter++)
            if (!read_register(rtl, counter_address(stage, counter), &s->stage[stage][counter],
                               err))
                return false;
    return read_register(rtl, HS_REG_CONFLICTS, &s->conflicts, err);
}

static bool write_limits(hs_rtl *rtl, hs_error *err) {
    return write_register(rtl, HS_REG_LIMIT_VERTICES, rtl->limits.vertices, err) &&
           write_register(rtl, HS_REG_LIMIT_QUADS, rtl->limits.quads, err);
}

static bool reset(hs_rtl *rtl, hs_error *err) {
    Vhalfstep &top = *rtl->top;
    rtl->context.gotError(false);
    rtl->context.gotFinish(false);
    rtl->bus = axil();
    top.s_axis_tvalid = 0;
    top.s_axis_tlast = 0;
    top.m_axis_tready = 0;
    top.rst_i = 1;
    for (int i = 0; i < 4; i++) {
        settle(rtl);
        if (!step(rtl, err)) return false;
    }
    top.rst_i = 0;
    if (!write_limits(rtl, err) || !take_snapshot(rtl, &rtl->before, err)) return false;
    rtl->broken = false;
    return true;
}

/* --- Construction
 * --------------------------------------------------------------------------------- */
static bool check_limits(const hs_rtl *rtl, hs_limits limits, hs_error *err) {
    const hs_limits capacity = rtl->capacity;
    if (limits.vertices > capacity.vertices || limits.quads > capacity.quads)
        return hs_fail(err, HS_EXIT_USAGE,
                       "limits of %u vertices and %u quads exceed the RTL's capacity of %u and %u",
                       limits.vertices, limits.quads, capacity.vertices, capacity.quads);
    return true;
}

static bool check_identity(hs_rtl *rtl, hs_error *err) {
    uint32_t identity = 0, version = 0;
    hs_limits &capacity = rtl->capacity;
    if (!read_register(rtl, HS_REG_IDENTITY, &identity, err) ||
        !read_register(rtl, HS_REG_VERSION, &version, err) ||
        !read_register(rtl, HS_REG_CAPACITY_VERTICES, &capacity.vertices, err) ||
        !read_register(rtl, HS_REG_CAPACITY_QUADS, &capacity.quads, err) ||
        !read_register(rtl, HS_REG_ARCHITECTURE, &rtl->architecture, err))
        return false;
    if (identity != HS_IDENTITY || version != HS_STREAM_VERSION)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "the RTL says identity 0x%08x, stream version %u, instead of 0x%08x, %u",
                       identity, version, static_cast<uint32_t>(HS_IDENTITY),
                       static_cast<uint32_t>(HS_STREAM_VERSION));
    return check_limits(rtl, rtl->limits, err);
}

/* No exception goes up into C: what C++ throws for want of memory becomes an error. */
template <typename Work> static bool guarded(hs_error *err, Work work) {
    try {
        return work();
    } catch (const std::exception &) { /* bad_alloc, or system_error where a thread has no stack */
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the simulation; free some memory");
    }
}

/* Verilator's runtime does not survive it if memory ends while it builds a simulation: some hundred
 * thousand bytes beside the pipeline's own have to be there before. */
static bool has_memory() {
    constexpr size_t beside = size_t{16} << 20;
    const std::unique_ptr<char[]> room(new (std::nothrow) char[beside]);
    return room != nullptr;
}

static bool build(hs_rtl *rtl, hs_limits limits, uint32_t seed, hs_error *err) {
    if (!has_memory()) throw std::bad_alloc();
    rtl->limits = limits;
    rtl->context.traceEverOn(true);
    rtl->context.fatalOnError(false);
    rtl->context.randReset(2);
    rtl->context.randSeed(static_cast<int>(seed % 0x7fffffff + 1)); /* 0: chosen by the clock */
    rtl->top = std::make_unique<Vhalfstep>(&rtl->context);
    return reset(rtl, err) && check_identity(rtl, err);
}

hs_rtl *hs_rtl_new(hs_limits limits, uint32_t seed, hs_error *err) {
    hs_rtl *rtl = nullptr;
    if (guarded(err, [&] {
            rtl = new hs_rtl;
            return build(rtl, limits, seed, err);
        }))
        return rtl;
    hs_rtl_free(rtl);
    return nullptr;
}

/* Verilator's runtime asks the thread for its context, which is that of the simulation built last:
 * another one's errors would be counted there, or in freed memory. */
static void enter(hs_rtl *rtl) {
    Verilated::threadContextp(&rtl->context);
}

void hs_rtl_free(hs_rtl *rtl) {
    if (!rtl) return;
    enter(rtl);
    if (rtl->trace) rtl->trace->close();
    keep_coverage(rtl->context);
    if (rtl->top) rtl->top->final();
    delete rtl;
}

bool hs_rtl_limit(hs_rtl *rtl, hs_limits limits, hs_error *err) {
    if (!check_limits(rtl, limits, err)) return false;
    enter(rtl);
    rtl->limits = limits;
    return rtl->broken || write_limits(rtl, err); /* a reset writes them too */
}

uint64_t hs_rtl_cycle(const hs_rtl *rtl) {
    return rtl->cycle;
}

uint32_t hs_rtl_architecture(const hs_rtl *rtl) {
    return rtl->architecture;
}

hs_limits hs_rtl_capacity(const hs_rtl *rtl) {
    return rtl->capacity;
}

void hs_rtl_on_cycle(hs_rtl *rtl, hs_rtl_strike *strike, void *context) {
    rtl->strike = strike;
    rtl->strike_context = context;
    rtl->context.assertOn(!strike);
}

void hs_rtl_cycle_limit(hs_rtl *rtl, uint64_t cycles) {
    rtl->limit = cycles;
}

void hs_rtl_log(hs_rtl *rtl, hs_log *log) {
    rtl->log = log;
}

uint64_t hs_rtl_word_cycle(const hs_rtl *rtl, size_t word) {
    const size_t beat = word / BEAT_WORDS;
    return beat < rtl->beat_cycle.size() ? rtl->beat_cycle[beat] : HS_NO_CYCLE;
}

static bool open_trace(hs_rtl *rtl, const char *path, uint64_t first, uint64_t last,
                       hs_error *err) {
    rtl->trace = std::make_unique<VerilatedFstC>();
    rtl->top->trace(rtl->trace.get(), 99);
    rtl->trace->open(path);
    if (!rtl->trace->isOpen()) {
        rtl->trace.reset();
        return hs_fail(err, HS_EXIT_FILE, "%s: cannot be written; check its folder", path);
    }
    rtl->trace_first = first;
    rtl->trace_last = last;
    return true;
}

bool hs_rtl_trace(hs_rtl *rtl, const char *path, uint64_t first, uint64_t last, hs_error *err) {
    enter(rtl);
    return guarded(err, [&] {
        if (rtl->trace) rtl->trace->close();
        rtl->trace.reset();
        return !path || open_trace(rtl, path, first, last, err);
    });
}

/* --- How long a view may take --------------------------------------------------------------------
 *
 * Two bounds, both far above what the pipeline needs. In total: every generation reads, at most,
 * twice the faces of the one before, and no more than the limits; a face or a vertex takes a few
 * cycles, a division by an odd valence some dozens. And between two items that any stage takes or
 * gives: a sweep over the memories. */
static uint64_t most_cycles(const hs_rtl *rtl, const hs_packet *in, hs_stalls stalls) {
    const uint64_t per_item = 64, records = in->words / 4;
    uint32_t depth = 0;
    if (in->words >= 8) {
        const uint32_t depths = in->word[6], corners = in->word[5];
        for (int i = 0; i < 24; i += 8)
            if ((depths >> i & 0xff) > depth) depth = depths >> i & 0xff;
        for (uint64_t r = corners + 1 < records ? records - corners - 1 : records; r < records; r++)
            if ((in->word[4 * r + 2] >> 8 & 0xff) > depth) depth = in->word[4 * r + 2] >> 8 & 0xff;
    }
    if (depth > HS_MAX_DEPTH) depth = HS_MAX_DEPTH;
    const uint64_t most =
        static_cast<uint64_t>(rtl->capacity.vertices) + rtl->capacity.quads + records;
    uint64_t items = records, sum = records;
    for (uint32_t g = 0; g <= depth; g++) {
        sum += items;
        items = 2 * items < most ? 2 * items : most;
    }
    const uint64_t taken = 100 - (stalls.input < 95 ? stalls.input : 95);
    const uint64_t given = 100 - (stalls.output < 95 ? stalls.output : 95);
    const uint64_t sweep = static_cast<uint64_t>(rtl->capacity.vertices) + rtl->capacity.quads;
    return (65536 + 4 * sweep + per_item * sum) * 100 / taken * 100 / given;
}

static uint64_t most_silence(const hs_rtl *rtl) {
    return 65536 + 4 * (static_cast<uint64_t>(rtl->capacity.vertices) + rtl->capacity.quads);
}

/* Looks at the item counters, one bus access after the other, while nothing goes in or out. */
struct watch {
    uint64_t moved; /* cycle of the last sign of life */
    uint32_t next = 0;
    bool polling = false, changed = false;
    uint32_t items[HS_STAGES][2] = {};

    explicit watch(uint64_t now) : moved(now) {}

    void look(hs_rtl *rtl) {
        if (!rtl->bus.idle()) return;
        if (polling) {
            uint32_t &item = items[next / 2][next % 2];
            changed |= item != rtl->bus.data;
            item = rtl->bus.data;
            polling = ++next < 2 * HS_STAGES;
            if (!polling && changed) moved = rtl->cycle;
        } else if ((rtl->cycle - moved) % 4096 == 4095) {
            polling = true;
            changed = false;
            next = 0;
        }
        if (polling) rtl->bus.read(counter_address(next / 2, IN + next % 2));
    }

    /* "; held: classify 3, split 1" */
    std::string held() const {
        std::string text;
        for (uint32_t s = 0; s < HS_STAGES; s++)
            if (items[s][0] != items[s][1])
                text += (text.empty() ? "; held: " : ", ") + std::string(hs_stage_name(s)) + " " +
                        std::to_string(static_cast<int32_t>(items[s][0] - items[s][1]));
        return text;
    }
};

/* --- One view
 * ------------------------------------------------------------------------------------- */

/* The beat that the output showed in the last cycle and that nobody took. */
struct beat {
    bool open = false, last = false;
    uint32_t id = 0, data[BEAT_WORDS] = {};
    uint64_t keep = 0;
};

static bool break_of_rule(const hs_rtl *rtl, const hs_packet *in, const char *what, hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL,
                   "view %u, cycle %llu: the RTL breaks a rule of its "
                   "output stream: %s",
                   in->view, static_cast<unsigned long long>(rtl->cycle), what);
}

/* Puts the next beat of the packet on the input. */
static void offer(Vhalfstep &top, const hs_packet *in, size_t at) {
    const size_t left = in->words - at, words = left < BEAT_WORDS ? left : BEAT_WORDS;
    for (size_t i = 0; i < BEAT_WORDS; i++)
        top.s_axis_tdata[i] = i < words ? in->word[at + i] : 0;
    top.s_axis_tkeep = words == 16 ? ~uint64_t{0} : (uint64_t{1} << 4 * words) - 1;
    top.s_axis_tlast = left <= BEAT_WORDS;
    top.s_axis_tid = static_cast<uint16_t>(in->view);
}

/* Checks what the output shows in this cycle against the last one, and a beat in itself. */
static bool check_beat(const hs_rtl *rtl, const hs_packet *in, const beat &before, hs_error *err) {
    const Vhalfstep &top = *rtl->top;
    if (before.open && !top.m_axis_tvalid)
        return break_of_rule(rtl, in, "tvalid fell before the beat was taken", err);
    if (!top.m_axis_tvalid) return true;
    if (before.open && (before.last != top.m_axis_tlast || before.id != top.m_axis_tid ||
                        before.keep != top.m_axis_tkeep ||
                        std::memcmp(before.data, &top.m_axis_tdata[0], sizeof before.data) != 0))
        return break_of_rule(rtl, in, "a beat changed before it was taken", err);
    /* Whole records, from the lowest up; fewer than a beat holds only at the end. */
    uint64_t full = 0;
    for (size_t records = 1; records <= BEAT_WORDS / 4; records++) {
        full = full << 16 | 0xffff;
        if (top.m_axis_tkeep == full && (top.m_axis_tlast || records == BEAT_WORDS / 4))
            return true;
    }
    return break_of_rule(rtl, in, "tkeep is not a row of whole records, or has gaps", err);
}

/* The same of a view that is alone. */
static bool check_output(const hs_rtl *rtl, const hs_packet *in, const beat &before, bool ended,
                         hs_error *err) {
    const Vhalfstep &top = *rtl->top;
    if (!check_beat(rtl, in, before, err)) return false;
    if (top.m_axis_tvalid && ended)
        return break_of_rule(rtl, in, "a beat behind the packet's last one", err);
    if (top.m_axis_tvalid && top.m_axis_tid != (in->view & 0xffff))
        return break_of_rule(rtl, in, "tid is not the view's number", err);
    return true;
}

/* What is shown now and will have to be shown again. */
static void keep_beat(const Vhalfstep &top, beat *shown) {
    shown->open = top.m_axis_tvalid && !top.m_axis_tready;
    if (!shown->open) return;
    shown->last = top.m_axis_tlast;
    shown->id = top.m_axis_tid;
    shown->keep = top.m_axis_tkeep;
    std::memcpy(shown->data, &top.m_axis_tdata[0], sizeof shown->data);
}

/* Streams the packet in and the answer out. */
static bool stream(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                   hs_cycle_report *report, hs_error *err) {
    Vhalfstep &top = *rtl->top;
    hs_pauses input = hs_pauses_start(stalls.seed, HS_PAUSES_INPUT, stalls.input);
    hs_pauses output = hs_pauses_start(stalls.seed, HS_PAUSES_OUTPUT, stalls.output);
    const uint64_t begin = rtl->begin = rtl->cycle;
    const uint64_t most = std::min(most_cycles(rtl, in, stalls), rtl->limit);
    const uint64_t silence = most_silence(rtl);
    watch life(begin);
    beat shown;
    size_t at = 0;
    rtl->beat_cycle.clear();
    bool offered = false, taken = false, ended = false, started = false;
    report->begin = begin;
    report->first_out = 0;
    while (!ended || !taken || !rtl->bus.idle()) {
        if (!offered && !taken && !hs_pauses_next(&input)) {
            offer(top, in, at);
            offered = true;
            if (at == 0) report->start = rtl->cycle;
        }
        top.s_axis_tvalid = offered;
        top.m_axis_tready = !hs_pauses_next(&output);
        if (!ended) life.look(rtl);
        settle(rtl);

        if (!check_output(rtl, in, shown, ended, err)) return false;
        keep_beat(top, &shown);
        if (top.m_axis_tvalid && top.m_axis_tready) {
            const auto bytes = static_cast<size_t>(__builtin_popcountll(top.m_axis_tkeep));
            if (!hs_packet_append(out, &top.m_axis_tdata[0], bytes / 16, err)) return false;
            rtl->beat_cycle.push_back(static_cast<uint32_t>(rtl->cycle - begin));
            if (!started) report->first_out = rtl->cycle;
            started = true;
            ended = top.m_axis_tlast;
            report->end = rtl->cycle;
            life.moved = rtl->cycle;
        }
        if (offered && top.s_axis_tready) {
            offered = false;
            at += BEAT_WORDS;
            taken = at >= in->words;
            life.moved = rtl->cycle;
        }
        if (!step(rtl, err)) return false;
        if (rtl->cycle - life.moved > silence)
            return hs_fail(err, HS_EXIT_INTERNAL,
                           "view %u, cycle %llu: the RTL hangs: nothing has moved for %llu "
                           "cycles%s",
                           in->view, static_cast<unsigned long long>(rtl->cycle),
                           static_cast<unsigned long long>(silence), life.held().c_str());
        if (rtl->cycle - begin > most)
            return hs_fail(err, HS_EXIT_INTERNAL,
                           "view %u, cycle %llu: the RTL does not come to an end: more than %llu "
                           "cycles%s",
                           in->view, static_cast<unsigned long long>(rtl->cycle),
                           static_cast<unsigned long long>(most), life.held().c_str());
    }
    top.s_axis_tvalid = 0;
    top.m_axis_tready = 0;
    report->cycles = report->end - report->start + 1;
    return true;
}

/* Behind a view: nothing may come any more, the pipeline comes to rest. */
static bool rest(hs_rtl *rtl, const hs_packet *in, hs_error *err) {
    const uint64_t begin = rtl->cycle;
    for (uint32_t busy = 1; busy;) {
        if (!read_register(rtl, HS_REG_BUSY, &busy, err)) return false;
        if (rtl->top->m_axis_tvalid)
            return break_of_rule(rtl, in, "a beat behind the packet's last one", err);
        if (rtl->cycle - begin > most_silence(rtl))
            return hs_fail(err, HS_EXIT_INTERNAL, "view %u: the RTL stays busy behind it",
                           in->view);
    }
    return true;
}

/* A view that a memory's fault ends leaves items behind. */
static bool faulty(const hs_packet &out) {
    return out.words >= 8 && (out.word[out.words - 8] & 0xff) == HS_STATUS_MEMORY_FAULT;
}

/* The counters of the view: what they grew by. Idle is what the view's own cycles leave. */
static bool account(const hs_rtl *rtl, const hs_packet *in, const hs_packet *out,
                    const snapshot &after, hs_cycle_report *report, hs_error *err) {
    const snapshot &before = rtl->before;
    const uint32_t cycles = after.cycles - before.cycles;
    if (cycles != static_cast<uint32_t>(after.when - before.when))
        return hs_fail(err, HS_EXIT_INTERNAL, "view %u: the RTL counts %u cycles instead of %u",
                       in->view, cycles, static_cast<uint32_t>(after.when - before.when));
    report->conflicts = after.conflicts - before.conflicts;
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        uint32_t grown[COUNTERS], sum = 0;
        for (uint32_t c = 0; c < COUNTERS; c++)
            grown[c] = after.stage[s][c] - before.stage[s][c];
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++) {
            report->activity[s][a] = grown[a];
            sum += grown[a];
        }
        report->items_in[s] = grown[IN];
        report->items_out[s] = grown[OUT];
        const uint64_t active = report->activity[s][HS_ACTIVITY_busy] +
                                report->activity[s][HS_ACTIVITY_starved] +
                                report->activity[s][HS_ACTIVITY_blocked];
        if (sum != cycles || active > report->cycles)
            return hs_fail(err, HS_EXIT_INTERNAL,
                           "view %u: stage %s was busy %u, starved %u, blocked %u and idle %u "
                           "cycles of %u, the view's own %llu among them",
                           in->view, hs_stage_name(s), grown[0], grown[1], grown[2], grown[3],
                           cycles, static_cast<unsigned long long>(report->cycles));
        if (grown[IN] != grown[OUT] && !faulty(*out))
            return hs_fail(err, HS_EXIT_INTERNAL, "view %u: stage %s took %u items and gave %u",
                           in->view, hs_stage_name(s), grown[IN], grown[OUT]);
        report->activity[s][HS_ACTIVITY_idle] = report->cycles - active;
    }
    return true;
}

bool hs_rtl_run(hs_rtl *rtl, const hs_packet *in, hs_stalls stalls, hs_packet *out,
                hs_cycle_report *report, hs_error *err) {
    std::memset(report, 0, sizeof *report);
    enter(rtl);
    out->view = in->view;
    out->words = 0;
    if (rtl->broken && !reset(rtl, err)) return false;
    rtl->broken = true;
    snapshot after;
    if (rtl->log) hs_log_clear(rtl->log);
    logging = rtl->log ? rtl : nullptr;
    const bool streamed = guarded(err, [&] { return stream(rtl, in, stalls, out, report, err); });
    logging = nullptr;
    if (!streamed || !rest(rtl, in, err) || !take_snapshot(rtl, &after, err)) return false;
    if (rtl->top->m_axis_tvalid) /* late, when it was at rest already */
        return break_of_rule(rtl, in, "a beat behind the packet's last one", err);
    if (!account(rtl, in, out, after, report, err)) return false;
    rtl->before = after;
    rtl->broken = false;
    return true;
}

/* --- Several views in a row ----------------------------------------------------------------------
 */

/* Which of the packets a beat of the output answers; count: none that has not ended. */
static uint32_t answered(const Vhalfstep &top, const hs_packet *in, uint32_t count,
                         const std::vector<bool> &ended) {
    for (uint32_t i = 0; i < count; i++)
        if ((in[i].view & 0xffff) == top.m_axis_tid && !ended[i]) return i;
    return count;
}

static bool stream_all(hs_rtl *rtl, const hs_packet *in, uint32_t count, hs_stalls stalls,
                       hs_packet *out, hs_flight_view *view, uint64_t *cycles, hs_error *err) {
    Vhalfstep &top = *rtl->top;
    hs_pauses input = hs_pauses_start(stalls.seed, HS_PAUSES_INPUT, stalls.input);
    hs_pauses output = hs_pauses_start(stalls.seed, HS_PAUSES_OUTPUT, stalls.output);
    const uint64_t begin = rtl->begin = rtl->cycle;
    std::vector<bool> ended(count, false);
    uint64_t most = 0;
    for (uint32_t i = 0; i < count; i++)
        most += most_cycles(rtl, &in[i], stalls);
    most = std::min(most, rtl->limit);
    uint32_t next = 0, open = count; /* packets: on its way in; not yet answered */
    size_t at = 0;
    bool offered = false;
    beat shown;
    while (open) {
        if (!offered && next < count && !hs_pauses_next(&input)) {
            offer(top, &in[next], at);
            offered = true;
            if (at == 0) view[next].start = rtl->cycle - begin;
        }
        top.s_axis_tvalid = offered;
        top.m_axis_tready = !hs_pauses_next(&output);
        settle(rtl);
        if (!check_beat(rtl, in, shown, err)) return false;
        keep_beat(top, &shown);
        if (top.m_axis_tvalid && top.m_axis_tready) {
            const uint32_t i = answered(top, in, count, ended);
            if (i == count || i > next)
                return break_of_rule(rtl, in, "a beat of a view that is not in flight", err);
            const auto bytes = static_cast<size_t>(__builtin_popcountll(top.m_axis_tkeep));
            if (!hs_packet_append(&out[i], &top.m_axis_tdata[0], bytes / 16, err)) return false;
            ended[i] = top.m_axis_tlast;
            open -= top.m_axis_tlast;
            view[i].end = rtl->cycle - begin;
            *cycles = view[i].end - view[0].start + 1;
        }
        if (offered && top.s_axis_tready) {
            offered = false;
            at += BEAT_WORDS;
            if (at >= in[next].words) {
                at = 0;
                next++;
            }
        }
        if (!step(rtl, err)) return false;
        if (rtl->cycle - begin > most)
            return hs_fail(err, HS_EXIT_INTERNAL, "the RTL does not answer %u of %u views", open,
                           count);
    }
    top.s_axis_tvalid = 0;
    top.m_axis_tready = 0;
    return true;
}

bool hs_rtl_stream(hs_rtl *rtl, const hs_packet *in, uint32_t count, hs_stalls stalls,
                   hs_packet *out, hs_flight_view *view, uint64_t *cycles, hs_error *err) {
    enter(rtl);
    for (uint32_t i = 0; i < count; i++) {
        out[i].view = in[i].view;
        out[i].words = 0;
    }
    *cycles = 0;
    if (rtl->broken && !reset(rtl, err)) return false;
    rtl->broken = true;
    logging = rtl->logs ? rtl : nullptr;
    const bool good =
        guarded(err, [&] { return stream_all(rtl, in, count, stalls, out, view, cycles, err); });
    logging = nullptr;
    if (!good || (count && !rest(rtl, in, err)) || !take_snapshot(rtl, &rtl->before, err))
        return false;
    rtl->broken = false;
    return true;
}

void hs_rtl_logs(hs_rtl *rtl, hs_log *logs) {
    rtl->logs = logs;
}
