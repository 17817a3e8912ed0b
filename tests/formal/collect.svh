// SPDX-License-Identifier: Apache-2.0
//
// Proof for collect.sv, inside of it: a beat that is taken shows at the output in the next cycle,
// unchanged, and stays until it is taken there; nothing else shows; no pipeline waits for another twice.

`include "reset.svh"
`include "turns.svh"

  logic [VIEWS-1:0] f_taken;
  logic [WIDTH-1:0] f_offer;
  assign f_taken = in_valid_i & in_ready_o;
  assign f_offer = in_data_i[WIDTH*32'(f_who)+:WIDTH];

  logic f_stepped = 1'b0, f_took_mine, f_took, f_kept;
  logic [WIDTH-1:0] f_sent, f_held;
  always_ff @(posedge clk_i) begin
    f_stepped   <= !rst_i;
    f_took      <= f_taken != '0;
    f_took_mine <= (f_taken & f_mine) != '0;
    f_sent      <= f_offer;
    f_kept      <= out_valid_o && !out_ready_i;
    f_held      <= out_data_o;
    if (f_started && !rst_i) begin
      assert ((f_taken & (f_taken - VIEWS'(1))) == '0);
      assert (g_turns.at_q != '0 && (g_turns.at_q & (g_turns.at_q - VIEWS'(1))) == '0);
      if (in_valid_i != '0 && (!out_valid_o || out_ready_i)) assert (f_taken != '0);
      if (f_stepped) begin
        assert (out_valid_o == (f_took || f_kept));
        assert (!(f_took && f_kept));
        if (f_took_mine) assert (out_data_o == f_sent);
        if (f_kept) assert (out_data_o == f_held);
      end
    end
  end

  // Those that were served while the followed one waited.
  logic [VIEWS-1:0] f_passed = '0;
  always_ff @(posedge clk_i) begin
    if ((in_valid_i & f_mine) == '0 || (f_taken & f_mine) != '0) f_passed <= '0;
    else f_passed <= f_passed | f_taken;
    if (rst_i) f_passed <= '0;
    if (f_started && !rst_i) begin
      if ((in_valid_i & f_mine) != '0) assert ((f_taken & f_passed) == '0);
      assert ((f_passed & f_mine) == '0);
      for (int p = 0; p < VIEWS; p++) if (f_passed[p]) assert (f_between(g_turns.at_q, 3'(p)));
    end
  end
