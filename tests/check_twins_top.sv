// SPDX-License-Identifier: Apache-2.0
//
// check_twins.sv with the corners in a memory: up to 64 vertices, 128 corners.

module check_twins_top (
    input logic clk_i,
    input logic rst_i,

    input logic       write_i,
    input logic [6:0] index_i,
    input logic [5:0] origin_i,
    input logic [6:0] twin_i,
    input logic       border_i,
    input logic [3:0] sharpness_i,
    input logic       first_i,
    input logic       last_i,

    input  logic       start_i,
    input  logic [7:0] corners_i,
    output logic       active_o,
    output logic       error_o,
    output logic [6:0] corner_o,
    output logic       sharpness_error_o
);

  logic a_rd_en, b_rd_en, a_border, b_border, a_first, a_last;
  logic [6:0] a_rd_index, b_rd_index, a_twin, b_twin;
  logic [5:0] a_origin, b_origin;
  logic [3:0] a_sharpness, b_sharpness;
  logic [19:0] word_q[0:127];
  logic [19:0] a_q, b_q;

  always_ff @(posedge clk_i) begin
    if (a_rd_en) a_q <= word_q[a_rd_index];
    if (b_rd_en) b_q <= word_q[b_rd_index];
    if (write_i) word_q[index_i] <= {first_i, last_i, border_i, sharpness_i, twin_i, origin_i};
  end
  assign {a_first, a_last, a_border, a_sharpness, a_twin, a_origin} = a_q;
  assign {b_border, b_sharpness, b_twin, b_origin} = b_q[17:0];

  /* verilator lint_off UNUSEDSIGNAL */
  logic [1:0] b_place;  // the twin's place in its face does not matter
  /* verilator lint_on UNUSEDSIGNAL */
  assign b_place = b_q[19:18];

  check_twins #(
      .VW(6), .QW(7)
  ) i_check_twins (
      .clk_i, .rst_i, .start_i, .corners_i, .active_o, .error_o, .corner_o, .sharpness_error_o,
      .a_rd_en_o(a_rd_en), .a_rd_index_o(a_rd_index), .a_origin_i(a_origin), .a_twin_i(a_twin),
      .a_border_i(a_border), .a_sharpness_i(a_sharpness), .a_first_i(a_first), .a_last_i(a_last),
      .b_rd_en_o(b_rd_en), .b_rd_index_o(b_rd_index), .b_origin_i(b_origin), .b_twin_i(b_twin),
      .b_border_i(b_border), .b_sharpness_i(b_sharpness)
  );

endmodule
