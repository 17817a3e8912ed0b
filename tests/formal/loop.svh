// SPDX-License-Identifier: Apache-2.0
//
// Proof for loop.sv, inside of it.

`include "reset.svh"

  localparam int unsigned SLACK = 2 + READ_LATENCY + DELAY;

  logic f_active;
  assign f_active = fetch_active || gather_active || fold_active || scatter_active;

  // The record: it is of the item that is shown; faces are not too large, and the last item ends one.
  logic [BITS:0] f_left, f_in, f_out, f_length;
  always_comb if (f_started && !rst_i) begin
    if (start_i) assume (!f_active && count_i <= (BITS + 1)'(1) << BITS);
    if (fetch_valid && f_left == (BITS + 1)'(1)) assume (last_i);
    if (fetch_valid && f_length == (BITS + 1)'(FACE_ITEMS - 1)) assume (last_i);
  end

  logic f_moves;
  logic [4:0] f_still, f_level;
  assign f_moves = (fetch_valid && fetch_ready) || gather_valid || (fold_valid && fold_ready) ||
      word_en != 2'd0 || read_en != 2'd0;

  always_ff @(posedge clk_i) begin
    f_still <= f_moves || !f_active ? 5'd0 : f_still + 5'd1;
    if (fetch_valid && fetch_ready) begin
      f_left   <= f_left - 1'b1;
      f_length <= last_i ? '0 : f_length + 1'b1;
      f_in     <= f_in + 1'b1;
    end
    if (fold_valid && fold_ready) f_out <= f_out + 1'b1;
    f_level <= f_level + 5'(gather_valid) - 5'(fold_valid && fold_ready);
    if (start_i) begin
      f_left <= count_i;
      f_length <= '0;
      f_in <= '0;
      f_out <= '0;
    end
    if (rst_i) begin
      f_level     <= '0;
      f_left      <= '0;
      f_in        <= '0;
      f_out       <= '0;
      f_still     <= '0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      // Nothing hangs.
      assert (32'(f_still) <= SLACK);
      // Nothing is lost, doubled, invented, or overtaken.
      if (gather_valid) assert (32'(f_level) < ITEMS);
      if (fold_valid && fold_ready) begin
        assert (f_out < f_in && fold_item[12+BITS+:BITS] == f_out[BITS-1:0]);
        assert (fold_item[12+:BITS] == fold_result);
      end
      if (!f_active) assert (f_left == '0 && f_in == f_out);
    end
