/* SPDX-License-Identifier: Apache-2.0
 *
 * The Verilated pipeline as an object: its cycles, its registers over AXI4-Lite, its limits.
 */
#include <stdlib.h>

#include "rtl_parts.h"

/* --- Cycles ----------------------------------------------------------------------------------- */

bool rtl_settle(hs_rtl *rtl, hs_error *err) {
    hs_pins *pins = &rtl->pins;
    const rtl_access *bus = &rtl->bus;
    pins->arvalid = bus->reading && bus->address_open;
    pins->awvalid = bus->writing && bus->address_open;
    pins->araddr = pins->awaddr = (uint16_t)bus->address;
    pins->rready = bus->reading;
    pins->wvalid = bus->writing && bus->data_open;
    pins->wdata = bus->data;
    pins->bready = bus->writing;
    return hs_rtl_top_settle(rtl->top, pins, rtl->cycle, err);
}

/* What the coming edge does to the access. */
static void advance(rtl_access *bus, const hs_pins *pins, uint64_t cycle) {
    if (bus->reading) {
        if (bus->address_open && pins->arready) {
            bus->address_open = false;
            bus->when = cycle;
        } else if (!bus->address_open && pins->rvalid) {
            bus->reading = false;
            bus->data = pins->rdata;
            bus->response = pins->rresp;
        }
    }
    if (bus->writing) {
        if (!bus->address_open && !bus->data_open && pins->bvalid) {
            bus->writing = false;
            bus->response = pins->bresp;
        }
        if (bus->address_open && pins->awready) bus->address_open = false;
        if (bus->data_open && pins->wready) bus->data_open = false;
    }
}

bool rtl_edge(hs_rtl *rtl, hs_error *err) {
    advance(&rtl->bus, &rtl->pins, rtl->cycle);
    if (rtl->strike)
        rtl->strike(rtl->strike_context, hs_rtl_top_model(rtl->top), rtl->cycle - rtl->begin);
    const bool good = hs_rtl_top_edge(rtl->top, rtl->cycle, err); /* probes ask for the cycle */
    rtl->cycle++;
    return good;
}

/* --- Registers -------------------------------------------------------------------------------- */

/* Lets the bus access finish while the streams rest. */
static bool finish_access(hs_rtl *rtl, hs_error *err) {
    const uint64_t start = rtl->cycle;
    while (!rtl_access_ended(&rtl->bus)) {
        if (!rtl_settle(rtl, err) || !rtl_edge(rtl, err)) return false;
        if (rtl->cycle - start > 1000)
            return hs_fail(err, HS_EXIT_INTERNAL, "register 0x%03x does not answer",
                           rtl->bus.address);
    }
    if (rtl->bus.response)
        return hs_fail(err, HS_EXIT_INTERNAL, "register 0x%03x answers with an error",
                       rtl->bus.address);
    return true;
}

bool rtl_read_register(hs_rtl *rtl, uint32_t address, uint32_t *value, hs_error *err) {
    rtl_access_read(&rtl->bus, address);
    if (!finish_access(rtl, err)) return false;
    *value = rtl->bus.data;
    return true;
}

static bool write_register(hs_rtl *rtl, uint32_t address, uint32_t value, hs_error *err) {
    rtl_access_write(&rtl->bus, address, value);
    return finish_access(rtl, err);
}

uint32_t rtl_counter_address(uint32_t stage, uint32_t counter) {
    return HS_REG_STAGES + 32 * stage + 4 * counter;
}

/* Reading CYCLES is what the idle counters refer to. */
bool rtl_read_counters(hs_rtl *rtl, rtl_counters *counters, hs_error *err) {
    if (!rtl_read_register(rtl, HS_REG_CYCLES, &counters->cycles, err)) return false;
    counters->when = rtl->bus.when;
    for (uint32_t s = 0; s < HS_STAGES; s++)
        for (uint32_t c = 0; c < RTL_COUNTERS; c++)
            if (!rtl_read_register(rtl, rtl_counter_address(s, c), &counters->stage[s][c], err))
                return false;
    return rtl_read_register(rtl, HS_REG_CONFLICTS, &counters->conflicts, err) &&
           rtl_read_register(rtl, HS_REG_VIEWS, &counters->views, err) &&
           rtl_read_register(rtl, HS_REG_STATUS, &counters->status, err) &&
           rtl_read_register(rtl, HS_REG_POSITION, &counters->position, err);
}

static bool write_limits(hs_rtl *rtl, hs_error *err) {
    return write_register(rtl, HS_REG_LIMIT_VERTICES, rtl->limits.vertices, err) &&
           write_register(rtl, HS_REG_LIMIT_QUADS, rtl->limits.quads, err);
}

static bool reset(hs_rtl *rtl, hs_error *err) {
    hs_rtl_top_forgive(rtl->top);
    rtl->bus = (rtl_access){0};
    rtl->pins.s_axis.valid = rtl->pins.s_axis.last = false;
    rtl->pins.m_axis_ready = false;
    rtl->pins.rst = true;
    for (int i = 0; i < 4; i++)
        if (!rtl_settle(rtl, err) || !rtl_edge(rtl, err)) return false;
    rtl->pins.rst = false;
    if (!write_limits(rtl, err) || !rtl_read_counters(rtl, &rtl->before, err)) return false;
    rtl->broken = false;
    return true;
}

bool rtl_begin(hs_rtl *rtl, hs_error *err) {
    hs_rtl_top_enter(rtl->top);
    if (rtl->broken && !reset(rtl, err)) return false;
    rtl->broken = true;
    return true;
}

void rtl_end(hs_rtl *rtl) {
    rtl->broken = false;
}

/* --- Construction ----------------------------------------------------------------------------- */

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
    hs_limits *capacity = &rtl->capacity;
    if (!rtl_read_register(rtl, HS_REG_IDENTITY, &identity, err) ||
        !rtl_read_register(rtl, HS_REG_VERSION, &version, err) ||
        !rtl_read_register(rtl, HS_REG_CAPACITY_VERTICES, &capacity->vertices, err) ||
        !rtl_read_register(rtl, HS_REG_CAPACITY_QUADS, &capacity->quads, err) ||
        !rtl_read_register(rtl, HS_REG_ARCHITECTURE, &rtl->architecture, err))
        return false;
    if (identity != HS_IDENTITY || version != HS_STREAM_VERSION)
        return hs_fail(err, HS_EXIT_INTERNAL,
                       "the RTL says identity 0x%08x, stream version %u, instead of 0x%08x, %u",
                       identity, version, (uint32_t)HS_IDENTITY, (uint32_t)HS_STREAM_VERSION);
    return check_limits(rtl, rtl->limits, err);
}

hs_rtl *hs_rtl_new(hs_limits limits, uint32_t seed, hs_error *err) {
    hs_rtl *rtl = calloc(1, sizeof *rtl);
    if (!rtl) {
        hs_fail(err, HS_EXIT_INTERNAL, "no memory for the simulation; free some memory");
        return NULL;
    }
    rtl->limit = UINT64_MAX;
    rtl->limits = limits;
    rtl->top = hs_rtl_top_new(seed, err);
    if (rtl->top && reset(rtl, err) && check_identity(rtl, err)) return rtl;
    hs_rtl_free(rtl);
    return NULL;
}

void hs_rtl_free(hs_rtl *rtl) {
    if (!rtl) return;
    hs_rtl_top_free(rtl->top);
    free(rtl->beat_cycle);
    free(rtl);
}

bool hs_rtl_limit(hs_rtl *rtl, hs_limits limits, hs_error *err) {
    if (!check_limits(rtl, limits, err)) return false;
    hs_rtl_top_enter(rtl->top);
    rtl->limits = limits;
    return rtl->broken || write_limits(rtl, err); /* a reset writes them too */
}

bool hs_rtl_trace(hs_rtl *rtl, const char *path, uint64_t first, uint64_t last, hs_error *err) {
    hs_rtl_top_enter(rtl->top);
    return hs_rtl_top_trace(rtl->top, path, first, last, err);
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
    hs_rtl_top_assert(rtl->top, !strike);
}

void hs_rtl_cycle_limit(hs_rtl *rtl, uint64_t cycles) {
    rtl->limit = cycles;
}

void hs_rtl_log(hs_rtl *rtl, hs_log *log) {
    rtl->log = log;
}

void hs_rtl_logs(hs_rtl *rtl, hs_log *logs) {
    rtl->logs = logs;
}

uint64_t hs_rtl_word_cycle(const hs_rtl *rtl, size_t word) {
    const size_t beat = word / hs_rtl_top_beat_words();
    return beat < rtl->beats ? rtl->beat_cycle[beat] : HS_NO_CYCLE;
}
