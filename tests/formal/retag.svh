// SPDX-License-Identifier: Apache-2.0
//
// Proof for retag.sv, inside of it: of all vertices one, whichever, is followed. It is written once if it
// is one of those that were named, else not at all; and every cycle writes a row more.

`include "reset.svh"

  // What the user owes: the vertices are there.
  always_comb if (f_started && !rst_i && start_i)
    assume (!active_o && (VW + 2)'(first_i) + (VW + 2)'(count_i) <= (VW + 2)'(1) << VW);

  (* anyconst *) logic [VW-1:0] f_vertex;
  logic [VW:0] f_first, f_end;
  logic f_named, f_write, f_written;

  assign f_named = {1'b0, f_vertex} >= f_first && {1'b0, f_vertex} < f_end;
  assign f_write = wr_en_o[f_vertex[BANK_BITS-1:0]] && wr_row_o == f_vertex[VW-1:BANK_BITS];

  always_ff @(posedge clk_i) begin
    if (f_write) f_written <= 1'b1;
    if (start_i) begin
      f_first   <= {1'b0, first_i};
      f_end     <= {1'b0, first_i} + count_i;
      f_written <= 1'b0;
    end
    if (rst_i) begin
      f_first   <= '0;
      f_end     <= '0;
      f_written <= 1'b0;
    end
  end

  logic f_stepped = 1'b0;
  logic [VW-BANK_BITS-1:0] f_row;

  always_ff @(posedge clk_i) begin
    f_stepped <= !rst_i && active_o;
    f_row     <= wr_row_o;
    if (f_started && !rst_i) begin
      if (f_write) assert (active_o && f_named && !f_written);
      if (!active_o) assert (f_written == f_named);
      if (active_o) assert (wr_en_o != '0);
      if (f_stepped && active_o) assert (wr_row_o == f_row + 1'b1);
      // What makes that inductive.
      assert (end_q == f_end && f_end <= (VW + 1)'(1) << VW);
      assert (next_q >= f_first && next_q <= f_end);
      assert (f_written == (f_named && {1'b0, f_vertex} < next_q));
      cover (f_written && !active_o && f_stepped && f_first[BANK_BITS-1:0] != '0);
    end
  end
