// SPDX-License-Identifier: Apache-2.0
//
// Proof for fetch.sv, inside of it: after a start, as many items are shown as it said, each once and in
// order, each with its face, and beside it what the memories read for it.

`include "reset.svh"

  // What the user owes.
  always_comb if (f_started && !rst_i && start_i)
    assume (!active_o && count_i <= (BITS + 1)'(1) << BITS);

  logic [BITS:0] f_count, f_taken;
  logic [BITS-1:0] f_faces, f_read_item, f_read_face;

  always_ff @(posedge clk_i) begin
    if (valid_o && ready_i) begin
      f_taken <= f_taken + 1'b1;
      if (last_i) f_faces <= f_faces + 1'b1;
    end
    if (start_i) begin
      f_count <= count_i;
      f_taken <= '0;
      f_faces <= '0;
    end
    if (rd_en_o) begin
      f_read_item <= rd_item_o;
      f_read_face <= rd_face_o;
    end
    if (rst_i) begin
      f_count <= '0;
      f_taken <= '0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert (valid_o == (f_taken != f_count));
      assert (active_o == valid_o);
      assert (f_taken <= f_count && f_count <= (BITS + 1)'(1) << BITS);
      assert (left_q == f_count - f_taken);
      if (valid_o) begin
        assert (item_o == f_taken[BITS-1:0] && face_o == f_faces);
        assert (f_read_item == item_o && f_read_face == face_o);
      end
      cover (f_count == (BITS + 1)'(3) && !active_o && f_faces == BITS'(2));
    end
