// SPDX-License-Identifier: Apache-2.0
//
// Proof for fifo.sv, inside of it: one word, whichever, is followed from its taking to its giving. As
// it may be any, none is lost, doubled, changed or overtaken.

`include "reset.svh"

  (* anyseq *) logic f_choose;
  logic f_inside = 1'b0, f_given = 1'b0;
  logic [WIDTH-1:0] f_word;
  logic [INDEX_BITS:0] f_place, f_ahead;

  assign f_ahead = f_place - read_q;

  always_ff @(posedge clk_i) begin
    f_given <= 1'b0;
    if (take && f_choose && !f_inside) begin
      f_inside <= 1'b1;
      f_word   <= in_data_i;
      f_place  <= write_q;
    end
    if (f_inside && give && f_ahead == '0) begin
      f_inside <= 1'b0;
      f_given  <= 1'b1;
    end
    if (rst_i) begin
      f_inside <= 1'b0;
      f_given  <= 1'b0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert (32'(level_o) <= DEPTH);
      assert (out_valid_o == (level_o != '0));
      assert (in_ready_o == (32'(level_o) != DEPTH));
      if (f_inside) begin
        assert (f_ahead < level_o);
        assert (storage_q[f_place[INDEX_BITS-1:0]] == BITS'({^f_word, f_word}));
        if (f_ahead == '0) assert (out_valid_o && out_data_o == f_word);
      end
      if (f_given) assert (!fault_o);
      cover (f_given && level_o != '0);
    end

  // A step: what is taken and given, and nothing else, changes the level; a word offered stays.
  logic f_stepped = 1'b0, f_take, f_give, f_kept;
  logic [INDEX_BITS:0] f_level;
  logic [WIDTH-1:0] f_data;
  always_ff @(posedge clk_i) begin
    f_stepped <= !rst_i;
    f_level   <= level_o;
    f_take    <= in_valid_i && in_ready_o;
    f_give    <= out_valid_o && out_ready_i;
    f_kept    <= out_valid_o && !out_ready_i;
    f_data    <= out_data_o;
    if (f_started && f_stepped && !rst_i) begin
      assert (level_o == f_level + (INDEX_BITS + 1)'(f_take) - (INDEX_BITS + 1)'(f_give));
      if (f_kept) assert (out_valid_o && out_data_o == f_data);
    end
  end
