/* SPDX-License-Identifier: Apache-2.0
 *
 * A stand-in for the Verilated pipeline, with its ports, registers and counters: it stores a packet
 * and sends it back, a beat a cycle, and has one planted fault. Compiled with sim/rtl_shim.cpp it
 * shows that each check of the driver can fail.
 */
#ifndef HS_TESTS_BROKEN_VHALFSTEP_H
#define HS_TESTS_BROKEN_VHALFSTEP_H

#include <cstring>
#include <vector>

#include "definitions.h"
#include "faults.h"
#include "verilated.h"

class VerilatedFstC;

class Vhalfstep {
  public:
    uint8_t clk_i = 0, rst_i = 0;
    uint8_t s_axis_tvalid = 0, s_axis_tready = 0, s_axis_tlast = 0;
    uint8_t m_axis_tvalid = 0, m_axis_tready = 0, m_axis_tlast = 0;
    uint16_t s_axis_tid = 0, m_axis_tid = 0;
    uint64_t s_axis_tkeep = 0, m_axis_tkeep = 0;
    uint32_t s_axis_tdata[16] = {}, m_axis_tdata[16] = {};
    uint8_t s_axil_awvalid = 0, s_axil_awready = 0, s_axil_wvalid = 0, s_axil_wready = 0;
    uint8_t s_axil_wstrb = 0, s_axil_bvalid = 0, s_axil_bready = 0, s_axil_bresp = 0;
    uint8_t s_axil_arvalid = 0, s_axil_arready = 0, s_axil_rvalid = 0, s_axil_rready = 0;
    uint8_t s_axil_rresp = 0;
    uint16_t s_axil_awaddr = 0, s_axil_araddr = 0;
    uint32_t s_axil_wdata = 0, s_axil_rdata = 0;

    explicit Vhalfstep(VerilatedContext *) {}
    void final() {}
    void trace(VerilatedFstC *, int) {}

    void eval() {
        if (clk_i && !clock_) edge();
        clock_ = clk_i;
        show();
    }

  private:
    struct beat {
        uint32_t data[16];
        uint64_t keep;
    };

    std::vector<beat> beats_;
    size_t sent_ = 0;
    uint16_t id_ = 0;
    bool whole_ = false, waited_ = false;
    uint32_t late_ = 0; /* cycles since the last beat was sent */
    uint8_t clock_ = 0;
    uint32_t cycles_ = 0, sampled_ = 0, taken_ = 0, given_ = 0;
    uint32_t outside_ = 0, sampled_outside_ = 0;
    uint32_t views_ = 0, status_ = 0, position_ = 0;

    bool is(fault f) const {
        return planted_fault == f;
    }
    bool last() const {
        return sent_ + 1 == beats_.size() && !is(FAULT_ENDLESS);
    }

    /* What the outputs are in this cycle. */
    void show() {
        s_axis_tready = !whole_ && !is(FAULT_DEAF);
        m_axis_tvalid = whole_ && !is(FAULT_MUTE) && !(is(FAULT_VALID_FALLS) && waited_);
        if (late_ >= 1 && is(FAULT_BEAT_BEHIND)) m_axis_tvalid = 1;
        if (late_ >= 30 && is(FAULT_LATE_BEAT)) m_axis_tvalid = 1;
        if (whole_) {
            const beat &b = beats_[sent_ < beats_.size() && !is(FAULT_ENDLESS) ? sent_ : 0];
            std::memcpy(m_axis_tdata, b.data, sizeof b.data);
            m_axis_tkeep = b.keep;
            m_axis_tlast = last();
            m_axis_tid = id_;
            spoil();
        }
        s_axil_arready = !s_axil_rvalid && !is(FAULT_SILENT_BUS);
        s_axil_awready = s_axil_wready =
            s_axil_awvalid && s_axil_wvalid && !s_axil_bvalid && !is(FAULT_SILENT_BUS);
    }

    void spoil() {
        if (is(FAULT_WORD) && sent_ == 1) m_axis_tdata[3] ^= 1u << 9;
        if (is(FAULT_DATA_CHANGES) && waited_) m_axis_tdata[15] ^= 1;
        if (is(FAULT_LAST_CHANGES) && waited_) m_axis_tlast = !m_axis_tlast;
        if (is(FAULT_KEEP_CHANGES) && waited_ && m_axis_tlast) m_axis_tkeep >>= 16;
        if (is(FAULT_OTHER_ID) && sent_ == 1) m_axis_tid++;
        if (is(FAULT_KEEP_GAP)) m_axis_tkeep &= ~uint64_t{0xffff0000};
        if (is(FAULT_KEEP_PART) && last()) m_axis_tkeep = 0xff;
        if (is(FAULT_KEEP_EARLY) && !last()) m_axis_tkeep = 0xffff;
    }

    void edge() {
        if (rst_i) return reset();
        cycles_++;
        if (late_) late_++;
        waited_ = m_axis_tvalid && !m_axis_tready;
        if (is(FAULT_ACTIVE_OUTSIDE) && !whole_ && beats_.empty()) outside_ += 100;
        if (m_axis_tvalid && m_axis_tready && whole_) {
            if (is(FAULT_ASSERTION))
                Verilated::threadContextp()->gotError(true); /* as $error does */
            given_++;
            const bool done = last();
            sent_++;
            if (done) {
                tell();
                beats_.clear();
                whole_ = false;
                late_ = is(FAULT_BEAT_BEHIND) || is(FAULT_LATE_BEAT);
            }
        }
        if (s_axis_tvalid && s_axis_tready) {
            beat b;
            std::memcpy(b.data, s_axis_tdata, sizeof b.data);
            b.keep = s_axis_tkeep;
            beats_.push_back(b);
            taken_++;
            id_ = s_axis_tid;
            whole_ = s_axis_tlast;
            sent_ = 0;
            late_ = 0;
        }
        bus();
    }

    /* The view's fate, as the last two records of what was sent, its trailer and its end, have it.
     */
    void tell() {
        std::vector<uint32_t> sent;
        for (const beat &b : beats_)
            for (uint32_t w = 0; w < 16; w++)
                if (b.keep >> 4 * w & 1) sent.push_back(b.data[w]);
        views_ += !is(FAULT_VIEWS);
        status_ = sent.size() < 8 ? 0 : sent[sent.size() - 8] & 0xff;
        position_ = sent.size() < 8 ? 0 : sent[sent.size() - 7];
    }

    void reset() {
        beats_.clear();
        whole_ = waited_ = false;
        late_ = 0;
        cycles_ = sampled_ = taken_ = given_ = outside_ = sampled_outside_ = 0;
        views_ = status_ = position_ = 0;
        s_axil_rvalid = s_axil_bvalid = 0;
    }

    void bus() {
        if (s_axil_rvalid && s_axil_rready) s_axil_rvalid = 0;
        if (s_axil_bvalid && s_axil_bready) s_axil_bvalid = 0;
        if (s_axil_arvalid && s_axil_arready) {
            s_axil_rvalid = 1;
            s_axil_rdata = value(s_axil_araddr);
            s_axil_rresp = is(FAULT_BUS_ERROR) ? 2 : 0;
        }
        if (s_axil_awready) {
            s_axil_bvalid = 1;
            s_axil_bresp = 0;
        }
    }

    uint32_t value(uint32_t address) {
        switch (address) {
        case HS_REG_IDENTITY:
            return HS_IDENTITY + is(FAULT_IDENTITY);
        case HS_REG_VERSION:
            return HS_STREAM_VERSION + is(FAULT_VERSION);
        case HS_REG_CAPACITY_VERTICES:
        case HS_REG_CAPACITY_QUADS:
            return 64;
        case HS_REG_BUSY:
            return whole_ || is(FAULT_STAYS_BUSY);
        case HS_REG_VIEWS:
            return views_;
        case HS_REG_STATUS:
            return status_ + is(FAULT_STATUS);
        case HS_REG_POSITION:
            return position_ + is(FAULT_POSITION);
        case HS_REG_CYCLES:
            sampled_outside_ = outside_;
            return sampled_ = cycles_ - (is(FAULT_CYCLES) && taken_ > 0);
        default:
            break;
        }
        if (address < HS_REG_STAGES) return 0;
        const uint32_t stage = (address - HS_REG_STAGES) / 32, counter = address % 32 / 4;
        const uint32_t busy = taken_ + (stage == HS_STAGE_emit ? sampled_outside_ : 0);
        if (counter == HS_ACTIVITY_busy) return busy;
        if (counter == HS_ACTIVITY_idle)
            return sampled_ - busy - (is(FAULT_ACTIVITY) && stage == HS_STAGE_split && taken_ > 0);
        if (counter == 4)
            return taken_ + (is(FAULT_ITEM_LOST) && stage == HS_STAGE_select && taken_);
        if (counter == 5) return given_;
        return 0;
    }
};

#endif
