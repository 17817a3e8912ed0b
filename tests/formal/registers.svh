// SPDX-License-Identifier: Apache-2.0
//
// Proof for registers.sv, inside of it: each write and each read is taken within a cycle of the end of the
// one before and gets one answer, which stays as it is until it is taken; and nothing else is answered.

`include "reset.svh"

  logic f_stepped = 1'b0, f_aw, f_w, f_ar, f_b_kept, f_r_kept, f_write_waits, f_read_waits;
  logic [1:0] f_writes, f_reads, f_bresp, f_rresp;  // taken, and not answered
  logic [31:0] f_rdata;

  // What the user owes.
  always_comb if (f_started && f_stepped) begin
    if (f_aw) assume (s_axil_awvalid);
    if (f_w) assume (s_axil_wvalid);
    if (f_ar) assume (s_axil_arvalid);
  end

  always_ff @(posedge clk_i) begin
    f_stepped <= !rst_i;
    f_aw      <= s_axil_awvalid && !s_axil_awready;
    f_w       <= s_axil_wvalid && !s_axil_wready;
    f_ar      <= s_axil_arvalid && !s_axil_arready;
    f_b_kept  <= s_axil_bvalid && !s_axil_bready;
    f_r_kept  <= s_axil_rvalid && !s_axil_rready;
    f_bresp   <= s_axil_bresp;
    f_rresp   <= s_axil_rresp;
    f_rdata   <= s_axil_rdata;
    f_write_waits <= s_axil_awvalid && s_axil_wvalid && !s_axil_awready && !s_axil_bvalid;
    f_read_waits  <= s_axil_arvalid && !s_axil_arready && !s_axil_rvalid;
    f_writes  <= rst_i ? '0 : f_writes + 2'(s_axil_awready) - 2'(s_axil_bvalid && s_axil_bready);
    f_reads   <= rst_i ? '0 : f_reads + 2'(s_axil_arready) - 2'(s_axil_rvalid && s_axil_rready);
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert (s_axil_awready == s_axil_wready);
      if (s_axil_awready) assert (s_axil_awvalid && s_axil_wvalid && f_writes == '0);
      if (s_axil_arready) assert (s_axil_arvalid && f_reads == '0);
      assert (f_writes == 2'(s_axil_bvalid) && f_reads == 2'(s_axil_rvalid));
      if (f_stepped) begin
        if (f_b_kept) assert (s_axil_bvalid && s_axil_bresp == f_bresp);
        if (f_r_kept) assert (s_axil_rvalid && s_axil_rresp == f_rresp && s_axil_rdata == f_rdata);
        if (f_write_waits) assert (s_axil_awready);
        if (f_read_waits) assert (s_axil_arready);
      end
      assert (32'(limit_vertices_o) <= VERTICES && 32'(limit_quads_o) <= QUADS);
    end
