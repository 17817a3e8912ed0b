// SPDX-License-Identifier: Apache-2.0
//
// Proof for scatter.sv, inside of it: of one bank, whichever, one word, whichever, is followed from its
// taking to its sending. As many words of the bank are sent as were taken, each once, in order, with
// their rows; and nobody waits at the door for more than three cycles.

`include "reset.svh"

  (* anyseq *) logic f_choose;
  (* anyconst *) logic [1:0] f_lane;
  (* anyconst *) logic [BANK_BITS-1:0] f_bank;

  // Words of the bank: in this item, and in it below the followed lane; inside; inside and older.
  logic [4:0] f_enter, f_enter_below, f_level, f_ahead, f_pending, f_older;
  logic f_inside = 1'b0, f_chosen;
  logic [WINDOW_BITS-1:0] f_slot;
  logic [IB-1:0] f_index;
  logic [WIDTH-1:0] f_word;
  logic [SB-1:0] f_at;
  logic [2:0] f_sends;

  assign f_at = {f_slot, f_lane};
  assign f_chosen = take && f_choose && !f_inside && in_mask_i[f_lane] &&
      in_index_i[IB*32'(f_lane)+:BANK_BITS] == f_bank;

  always_comb begin
    f_enter = '0;
    f_enter_below = '0;
    for (int i = 0; i < 4; i++)
      if (take && in_mask_i[i] && in_index_i[IB*i+:BANK_BITS] == f_bank) begin
        f_enter = f_enter + 5'd1;
        if (2'(i) < f_lane) f_enter_below = f_enter_below + 5'd1;
      end
    f_sends = '0;
    for (int b = 0; b < BANKS; b++) f_sends = f_sends + 3'(en_o[b]);
  end

  always_ff @(posedge clk_i) begin
    f_level <= f_level + f_enter - 5'(en_o[f_bank]);
    if (f_inside && en_o[f_bank]) begin
      f_ahead <= f_ahead - 5'd1;
      if (f_ahead == '0) f_inside <= 1'b0;
    end
    if (f_chosen) begin
      f_inside <= 1'b1;
      f_slot   <= tail_q;
      f_index  <= in_index_i[IB*32'(f_lane)+:IB];
      f_word   <= in_data_i[WIDTH*32'(f_lane)+:WIDTH];
      f_ahead  <= f_level - 5'(en_o[f_bank]) + f_enter_below;
    end
    if (rst_i) begin
      f_level  <= '0;
      f_inside <= 1'b0;
    end
  end

  // The same, by the window.
  always_comb begin
    f_pending = '0;
    f_older = '0;
    for (int a = 0; a < 4 * WINDOW; a++)
      if (pending_q[a] && index_q[a][BANK_BITS-1:0] == f_bank) begin
        f_pending = f_pending + 5'd1;
        if ({WINDOW_BITS'(a / 4) - tail_q, 2'(a)} < {f_slot - tail_q, f_lane}) f_older = f_older + 5'd1;
      end
  end

  logic [2:0] f_waited;
  logic [3:0] f_oldest;
  assign f_oldest = pending_q[{tail_q, 2'b00}+:4];
  always_ff @(posedge clk_i) f_waited <= rst_i || in_ready_o ? 3'd0 : f_waited + 3'd1;

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      if (en_o[f_bank]) assert (f_level != '0);
      if (f_inside) assert (f_ahead < f_level);
      if (f_inside && en_o[f_bank] && f_ahead == '0) begin
        assert (row_o[ROW_BITS*32'(f_bank)+:ROW_BITS] == f_index[IB-1:BANK_BITS]);
        assert (data_o[WIDTH*32'(f_bank)+:WIDTH] == f_word);
      end
      if (f_level != '0) assert (active_o);
      if (active_o) assert (f_sends != 3'd0);
      assert (32'(f_sends) <= LANES);
      assert (f_waited <= 3'd3);

      // What makes that inductive.
      assert (f_level == f_pending);
      if (f_inside) begin
        assert (pending_q[f_at] && index_q[f_at] == f_index && word_q[f_at] == f_word);
        assert (f_index[BANK_BITS-1:0] == f_bank && f_ahead == f_older);
      end
      if (!in_ready_o)
        assert (32'(f_waited) + 32'(f_oldest[0]) + 32'(f_oldest[1]) + 32'(f_oldest[2]) + 32'(f_oldest[3]) <= 4);
      cover (f_inside && en_o[f_bank] && f_ahead == '0 && f_level > 5'd3);
    end
