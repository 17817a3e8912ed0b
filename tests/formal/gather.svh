// SPDX-License-Identifier: Apache-2.0
//
// Proof for gather.sv, inside of it: one item, whichever, is followed from its taking to its leaving, and
// of its words one, in a memory in which that word stays as it is. Items leave once and in order, each
// with its payload and its words, and the oldest has left 4 + READ_LATENCY cycles after it became that.

`include "reset.svh"

  localparam int unsigned F_AT = 4 * WINDOW;

  // The memory's word: it shows in the cycle after the request.
  (* anyconst *) logic [IB-1:0] f_index;
  (* anyconst *) logic [WIDTH-1:0] f_word;
  logic [BANK_BITS-1:0] f_bank;
  logic f_read;
  assign f_bank = f_index[BANK_BITS-1:0];
  always_ff @(posedge clk_i)
    f_read <= rd_en_o[f_bank] && rd_row_o[ROW_BITS*32'(f_bank)+:ROW_BITS] == f_index[IB-1:BANK_BITS];
  always_comb if (f_read) assume (rd_data_i[WIDTH*32'(f_bank)+:WIDTH] == f_word);

  // The item, and which of its lanes.
  (* anyseq *) logic f_choose;
  (* anyconst *) logic [1:0] f_lane;
  logic f_inside = 1'b0, f_wants, f_leaves;
  logic [ITEM_WIDTH-1:0] f_item;
  logic [WINDOW_BITS-1:0] f_slot, f_ahead;
  logic [SB-1:0] f_at;

  assign f_ahead  = f_slot - head_q;
  assign f_at     = {f_slot, f_lane};
  assign f_leaves = f_inside && f_ahead == '0 && out_valid_o;

  always_ff @(posedge clk_i) begin
    if (take && f_choose && !f_inside) begin
      f_inside <= 1'b1;
      f_item   <= in_item_i;
      f_slot   <= tail_q;
      f_wants  <= in_mask_i[f_lane] && in_index_i[IB*32'(f_lane)+:IB] == f_index;
    end
    if (f_leaves) f_inside <= 1'b0;
    if (rst_i) f_inside <= 1'b0;
  end

  // How long the oldest has been that.
  logic [3:0] f_age, f_head_pending;
  assign f_head_pending = pending_q[{head_q, 2'b00}+:4];
  always_ff @(posedge clk_i)
    f_age <= rst_i || !active_o || out_valid_o ? 4'd0 : f_age + 4'd1;

  function automatic logic [2:0] f_ones(input logic [3:0] bits);
    f_ones = 3'(bits[0]) + 3'(bits[1]) + 3'(bits[2]) + 3'(bits[3]);
  endfunction

  // Requests on their way: who, by bank and by the cycles since.
  logic [BANKS-1:0] f_en[0:READ_LATENCY-1];
  logic [SB*BANKS-1:0] f_who[0:READ_LATENCY-1];
  always_ff @(posedge clk_i) begin
    f_en[0] <= rst_i ? '0 : rd_en_o;
    for (int b = 0; b < BANKS; b++) f_who[0][b*SB+:SB] <= asks[b];
    for (int t = 1; t < READ_LATENCY; t++) begin
      f_en[t]  <= rst_i ? '0 : f_en[t-1];
      f_who[t] <= f_who[t-1];
    end
  end

  // Per slot's lane: how many requests of it are on their way, and whether all to the right bank.
  logic [2:0] f_flying[0:F_AT-1];
  logic [F_AT-1:0] f_astray;
  logic [2:0] f_served;
  logic f_mine_read;
  always_comb begin
    f_served = 3'd0;
    for (int b = 0; b < BANKS; b++) f_served = f_served + 3'(rd_en_o[b]);
    f_astray = '0;
    f_mine_read = f_en[0][f_bank] && f_who[0][32'(f_bank)*SB+:SB] == f_at;
    for (int a = 0; a < F_AT; a++) begin
      f_flying[a] = 3'd0;
      for (int t = 0; t < READ_LATENCY; t++)
        for (int b = 0; b < BANKS; b++)
          if (f_en[t][b] && f_who[t][b*SB+:SB] == SB'(a)) begin
            f_flying[a] = f_flying[a] + 3'd1;
            if (index_q[a][BANK_BITS-1:0] != BANK_BITS'(b)) f_astray[a] = 1'b1;
          end
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert (in_ready_o == (32'(count_q) != WINDOW && !stall_i));
      if (out_valid_o) assert (active_o);
      if (f_inside) assert (f_ahead < count_q);
      if (f_leaves) begin
        assert (out_item_o == f_item);
        if (f_wants) assert (out_data_o[WIDTH*32'(f_lane)+:WIDTH] == f_word);
      end
      assert (32'(f_age) <= 4 + READ_LATENCY);
      assert (32'(f_served) <= LANES);
      if (pending_q != '0) assert (f_served != 3'd0);

      // What makes that inductive: the ring; each request is to be sent, on its way once, or answered.
      assert (32'(count_q) <= WINDOW && tail_q == head_q + count_q[WINDOW_BITS-1:0]);
      assert ((pending_q & ~missing_q) == '0);
      assert (f_astray == '0);
      for (int a = 0; a < F_AT; a++) begin
        assert (f_flying[a] == 3'(missing_q[a] && !pending_q[a]));
        if ({1'b0, WINDOW_BITS'(a / 4) - head_q} >= count_q) assert (!missing_q[a]);
      end
      assert (answers_q == f_en[READ_LATENCY-1]);
      for (int b = 0; b < BANKS; b++)
        if (answers_q[b]) assert (asked_q[b] == f_who[READ_LATENCY-1][b*SB+:SB]);
      if (f_inside) begin
        assert (item_q[f_slot] == f_item);
        if (f_wants) begin
          assert (index_q[f_at] == f_index);
          if (f_mine_read) assert (f_read);
          if (!missing_q[f_at]) assert (word_q[f_at] == f_word);
        end
      end
      if (active_o && f_head_pending != 4'd0) assert (f_age + 4'(f_ones(f_head_pending)) <= 4'd4);
      cover (f_leaves && f_wants && count_q > 1 && f_age > 4'd3);
    end

  generate
    if (READ_LATENCY > 1) begin : f_far
      always_ff @(posedge clk_i)
        if (f_started && !rst_i)
          for (int t = 0; t < READ_LATENCY - 1; t++) begin
            assert (g_far.read_q[t] == f_en[t]);
            for (int b = 0; b < BANKS; b++)
              if (f_en[t][b]) assert (g_far.slot_q[t][b*SB+:SB] == f_who[t][b*SB+:SB]);
            if (f_inside && f_wants && f_en[t+1][f_bank] && f_who[t+1][32'(f_bank)*SB+:SB] == f_at)
              assert (g_far.word_way_q[t][32'(f_bank)*WIDTH+:WIDTH] == f_word);
          end
    end
  endgenerate
