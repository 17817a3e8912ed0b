// SPDX-License-Identifier: Apache-2.0
//
// Proof for fold.sv, inside of it. It never looks at an item or a result, so each item carries its number and
// its face's, each result its face's: items leave each once and in order, with the result of their face,
// and as soon as that is there.

`include "reset.svh"

  localparam int unsigned F_BITS = 3;

  logic [F_BITS-1:0] f_in, f_out, f_face_in, f_face_out, f_results;
  logic f_last;

  // What the user owes: an item when there is room, and no more results than faces that began.
  always_comb begin
    if (item_valid_i) assume (f_in - f_out < F_BITS'(ITEMS));
    if (result_valid_i) assume (f_results - f_face_out < F_BITS'(ITEMS));
    assume (item_i == {f_in, f_face_in});
    assume (result_i == f_results);
  end

  always_ff @(posedge clk_i) begin
    if (item_valid_i) begin
      f_in <= f_in + 1'b1;
      if (item_last_i) f_face_in <= f_face_in + 1'b1;
    end
    if (result_valid_i) f_results <= f_results + 1'b1;
    if (out_valid_o && out_ready_i) begin
      f_out <= f_out + 1'b1;
      if (out_last_o) f_face_out <= f_face_out + 1'b1;
    end
    if (rst_i) begin
      f_in       <= '0;
      f_out      <= '0;
      f_face_in  <= '0;
      f_face_out <= '0;
      f_results  <= '0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert (out_valid_o == (f_in != f_out && f_results != f_face_out));
      if (out_valid_o) assert (out_item_o == {f_out, f_face_out} && out_result_o == f_face_out);
      assert (active_o == (f_in != f_out));
      assert (stall_o == (f_in - f_out > F_BITS'(ITEMS - MARGIN)));
    end
