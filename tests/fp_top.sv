// SPDX-License-Identifier: Apache-2.0
//
// fp_top: the floating-point modules side by side, for tests/test_fp.c. They share clock and reset
// and nothing else.
module fp_top #(
    parameter int VW = 17
) (
    input logic clk_i,
    input logic rst_i,

    input  logic        add_valid_i,
    input  logic        mul_valid_i,
    input  logic [31:0] a_i,
    input  logic [31:0] b_i,
    output logic        add_valid_o,
    output logic [31:0] add_y_o,
    output logic        mul_valid_o,
    output logic [31:0] mul_y_o,

    input  logic          transform_clear_i,
    input  logic          transform_valid_i,
    input  logic [VW-1:0] transform_index_i,
    input  logic [ 127:0] transform_record_i,
    input  logic [ 511:0] transform_matrix_i,
    output logic          transform_valid_o,
    output logic [VW-1:0] transform_index_o,
    output logic [ 127:0] transform_clip_o,
    output logic          transform_overflow_o,
    output logic [   1:0] transform_overflow_row_o,
    output logic [  30:0] transform_magnitude_o,
    output logic          transform_busy_o,

    input  logic              fixed_valid_i,
    input  logic       [31:0] fixed_c_i,
    input  logic signed [9:0] fixed_exponent_i,
    output logic       [31:0] fixed_q_o,

    input  logic       [31:0] float_q_i,
    input  logic signed [9:0] float_exponent_i,
    output logic       [31:0] float_c_o,

    input  logic               quantize_start_i,
    input  logic        [VW:0] quantize_count_i,
    input  logic        [30:0] quantize_magnitude_i,
    output logic signed [ 9:0] quantize_exponent_o,
    output logic               quantize_done_o,
    output logic               quantize_rd_en_o,
    output logic [VW-1:0]      quantize_rd_index_o,
    input  logic [ 127:0]      quantize_rd_data_i,
    output logic               quantize_wr_en_o,
    output logic [VW-1:0]      quantize_wr_index_o,
    output logic [ 127:0]      quantize_wr_data_o,
    output logic               quantize_busy_o,
    output logic               quantize_starved_o,
    output logic               quantize_blocked_o,
    output logic               quantize_item_in_o,
    output logic               quantize_item_out_o
);
  fp_add i_add (
      .clk_i, .rst_i, .valid_i(add_valid_i), .a_i, .b_i, .valid_o(add_valid_o), .y_o(add_y_o)
  );

  fp_mul i_mul (
      .clk_i, .rst_i, .valid_i(mul_valid_i), .a_i, .b_i, .valid_o(mul_valid_o), .y_o(mul_y_o)
  );

  transform #(
      .VW(VW)
  ) i_transform (
      .clk_i,
      .rst_i,
      .clear_i       (transform_clear_i),
      .valid_i       (transform_valid_i),
      .index_i       (transform_index_i),
      .record_i      (transform_record_i),
      .matrix_i      (transform_matrix_i),
      .valid_o       (transform_valid_o),
      .index_o       (transform_index_o),
      .clip_o        (transform_clip_o),
      .overflow_o    (transform_overflow_o),
      .overflow_row_o(transform_overflow_row_o),
      .magnitude_o   (transform_magnitude_o),
      .busy_o        (transform_busy_o)
  );

  to_fixed i_to_fixed (
      .clk_i, .valid_i(fixed_valid_i), .c_i(fixed_c_i), .exponent_i(fixed_exponent_i),
      .q_o(fixed_q_o)
  );

  to_float i_to_float (
      .q_i(float_q_i), .exponent_i(float_exponent_i), .c_o(float_c_o)
  );

  quantize #(
      .VW(VW)
  ) i_quantize (
      .clk_i,
      .rst_i,
      .start_i    (quantize_start_i),
      .count_i    (quantize_count_i),
      .magnitude_i(quantize_magnitude_i),
      .exponent_o (quantize_exponent_o),
      .done_o     (quantize_done_o),
      .rd_en_o    (quantize_rd_en_o),
      .rd_index_o (quantize_rd_index_o),
      .rd_data_i  (quantize_rd_data_i),
      .wr_en_o    (quantize_wr_en_o),
      .wr_index_o (quantize_wr_index_o),
      .wr_data_o  (quantize_wr_data_o),
      .busy_o     (quantize_busy_o),
      .starved_o  (quantize_starved_o),
      .blocked_o  (quantize_blocked_o),
      .item_in_o  (quantize_item_in_o),
      .item_out_o (quantize_item_out_o)
  );
endmodule
