/* SPDX-License-Identifier: Apache-2.0
 *
 * A stand-in for the Verilated pipeline, with its ports: each eval() is a line to Icarus Verilog
 * and one back (tests/icarus/bench.v). Compiled with sim/rtl_shim.cpp it puts a second simulator
 * behind sim/rtl.h. The design is the file that the environment variable HS_ICARUS names. An X
 * where there must be none counts as a failed assertion.
 */
#ifndef HS_TESTS_ICARUS_VHALFSTEP_H
#define HS_TESTS_ICARUS_VHALFSTEP_H

#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <sys/wait.h>
#include <unistd.h>

#include "verilated.h"

class VerilatedFstC;

class Vhalfstep {
  public:
    static constexpr int WORDS = 4 * PORT_RECORDS;

    uint8_t clk_i = 0, rst_i = 0;
    uint8_t s_axis_tvalid = 0, s_axis_tready = 0, s_axis_tlast = 0;
    uint8_t m_axis_tvalid = 0, m_axis_tready = 0, m_axis_tlast = 0;
    uint16_t s_axis_tid = 0, m_axis_tid = 0;
    uint64_t s_axis_tkeep = 0, m_axis_tkeep = 0;
    uint32_t s_axis_tdata[WORDS] = {}, m_axis_tdata[WORDS] = {};
    uint8_t s_axil_awvalid = 0, s_axil_awready = 0, s_axil_wvalid = 0, s_axil_wready = 0;
    uint8_t s_axil_wstrb = 0, s_axil_bvalid = 0, s_axil_bready = 0, s_axil_bresp = 0;
    uint8_t s_axil_arvalid = 0, s_axil_arready = 0, s_axil_rvalid = 0, s_axil_rready = 0;
    uint8_t s_axil_rresp = 0;
    uint16_t s_axil_awaddr = 0, s_axil_araddr = 0;
    uint32_t s_axil_wdata = 0, s_axil_rdata = 0;
    void *rootp = nullptr; /* its memories are out of reach */

    explicit Vhalfstep(VerilatedContext *context) : context_(context) {
        const char *design = std::getenv("HS_ICARUS");
        int down[2], up[2];
        std::signal(SIGPIPE, SIG_IGN); /* that the simulation has ended is told in words */
        if (!design || pipe(down) != 0 || pipe(up) != 0) {
            fail("HS_ICARUS names no design, or there is no pipe to it");
            return;
        }
        child_ = fork();
        if (child_ == 0) {
            dup2(down[0], STDIN_FILENO);
            dup2(up[1], STDOUT_FILENO);
            for (const int end : {down[0], down[1], up[0], up[1]})
                close(end);
            execlp("vvp", "vvp", "-n", design, static_cast<char *>(nullptr));
            _exit(127);
        }
        close(down[0]);
        close(up[1]);
        to_ = fdopen(down[1], "w");
        from_ = fdopen(up[0], "r");
        if (child_ < 0) fail("no process for vvp");
    }
    ~Vhalfstep() {
        if (to_) fclose(to_);
        if (from_) fclose(from_);
        if (child_ > 0) waitpid(child_, nullptr, 0);
    }
    Vhalfstep(const Vhalfstep &) = delete;
    Vhalfstep &operator=(const Vhalfstep &) = delete;

    void final() {}
    void trace(VerilatedFstC *, int) {}

    void eval() {
        if (failed_) return context_->gotError(true);
        send();
        if (!fgets(line_, sizeof line_, from_)) return fail("the simulation has ended");
        at_ = line_;
        if (*at_ == 'u') {
            line_[std::strcspn(line_, "\n")] = 0;
            return fail(line_);
        }
        receive();
    }

  private:
    VerilatedContext *context_;
    pid_t child_ = -1;
    FILE *to_ = nullptr, *from_ = nullptr;
    char line_[4 * 8 * WORDS + 200];
    const char *at_ = nullptr;
    bool failed_ = false;

    void fail(const char *what) {
        std::fprintf(stderr, "icarus: %s\n", what);
        failed_ = true;
        context_->gotError(true); /* as $error does */
    }

    void send() {
        std::fprintf(to_, "%u %u %u ", clk_i, rst_i, s_axis_tvalid);
        for (int i = WORDS - 1; i >= 0; i--)
            std::fprintf(to_, "%08x", s_axis_tdata[i]);
        std::fprintf(to_, " %llx %u %x %u %u %x %u %x %x %u %u %x %u\n",
                     static_cast<unsigned long long>(s_axis_tkeep), s_axis_tlast, s_axis_tid,
                     m_axis_tready, s_axil_awvalid, s_axil_awaddr, s_axil_wvalid, s_axil_wdata,
                     s_axil_wstrb, s_axil_bready, s_axil_arvalid, s_axil_araddr, s_axil_rready);
        fflush(to_);
    }

    /* The next number of the line, of so many hexadecimal digits; what is X, unchecked, counts as
     * 0. */
    uint64_t take(int digits) {
        uint64_t value = 0;
        while (*at_ == ' ')
            at_++;
        for (; digits > 0 && *at_ && *at_ != '\n'; digits--, at_++) {
            const char *hex = "0123456789abcdef", *digit = std::strchr(hex, *at_);
            value = value << 4 | static_cast<uint64_t>(digit ? digit - hex : 0);
        }
        return value;
    }
    template <class Port> void take(Port &port, int digits) {
        port = static_cast<Port>(take(digits));
    }

    void receive() {
        take(s_axis_tready, 1);
        take(m_axis_tvalid, 1);
        for (int i = WORDS - 1; i >= 0; i--)
            take(m_axis_tdata[i], 8);
        take(m_axis_tkeep, 4 * PORT_RECORDS);
        take(m_axis_tlast, 1);
        take(m_axis_tid, 4);
        take(s_axil_awready, 1);
        take(s_axil_wready, 1);
        take(s_axil_bvalid, 1);
        take(s_axil_bresp, 1);
        take(s_axil_arready, 1);
        take(s_axil_rvalid, 1);
        take(s_axil_rdata, 8);
        take(s_axil_rresp, 1);
    }
};

#endif
