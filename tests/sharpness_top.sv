// SPDX-License-Identifier: Apache-2.0
//
// sharpness.sv with a memory of 32 words behind it, and vertex_kind.sv for one word at a time.

module sharpness_top (
    input logic clk_i,
    input logic rst_i,

    input logic       vertex_valid_i,
    input logic [4:0] vertex_index_i,
    input logic       corner_valid_i,
    input logic [4:0] corner_origin_i,
    input logic       corner_boundary_i,
    input logic [3:0] corner_sharpness_i,
    input logic [3:0] corner_own_i,

    // a word of the memory, at once
    input  logic [ 4:0] look_i,
    output logic [17:0] word_o,

    input  logic [17:0] kind_word_i,
    input  logic [ 7:0] level_i,
    input  logic        corners_stay_i,
    output logic        stays_o,
    output logic        crease_o
);

  logic rd_en, wr_en;
  logic [4:0] rd_index, wr_index;
  logic [17:0] rd_data, wr_data;
  logic [17:0] word_q[0:31];

  sharpness #(
      .VW(5)
  ) i_sharpness (
      .clk_i, .rst_i, .vertex_valid_i, .vertex_index_i, .corner_valid_i, .corner_origin_i,
      .corner_boundary_i, .corner_sharpness_i, .corner_own_i, .rd_en_o(rd_en),
      .rd_index_o(rd_index), .rd_data_i(rd_data), .wr_en_o(wr_en), .wr_index_o(wr_index),
      .wr_data_o(wr_data)
  );

  // As rtl/banked_memory.sv: a read in the cycle of a write to the same word gives the old one.
  always_ff @(posedge clk_i) begin
    if (rd_en) rd_data <= word_q[rd_index];
    if (wr_en) word_q[wr_index] <= wr_data;
  end
  assign word_o = word_q[look_i];

  vertex_kind i_kind (
      .word_i(kind_word_i), .level_i, .corners_stay_i, .stays_o, .crease_o
  );

endmodule
