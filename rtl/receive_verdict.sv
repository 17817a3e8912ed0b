// SPDX-License-Identifier: Apache-2.0
//
// receive_verdict: the part of receive that says what is wrong with a packet: the first offending
// word and its status. receive_check finds what is wrong with one record; here the CRC is kept, a
// packet that ends early is noticed, and of several errors one is chosen.
//
//   * A record is judged in the cycle of take_i, by the stage of the packet that at_..._i says.
//     bad_o, in the same cycle: it has an error.
//   * The error at the smallest word position wins. Records come in order, and after an error of
//     one no more are judged; but an overflow is always of an earlier record, and may be told
//     later. So a smaller position replaces a larger one; NO_POSITION is the largest.
//   * start_i clears the verdict: STATUS_OK, NO_POSITION.

module receive_verdict #(
    parameter int unsigned VERTICES = 1024,
    parameter int unsigned QUADS = 1024,
    localparam int unsigned VW = $clog2(VERTICES),
    localparam int unsigned QW = $clog2(QUADS)
) (
    input logic clk_i,
    input logic start_i,

    // the record, and where in the packet it stands
    input logic         take_i,
    input logic [127:0] record_i,
    input logic [ 29:0] number_i,     // records before it
    input logic         at_view_i,
    input logic         at_counts_i,
    input logic         at_picture_i,
    input logic         at_matrix_i,
    input logic         at_vertex_i,
    input logic         at_corner_i,
    input logic         at_end_i,
    input logic         at_behind_i,
    input logic         cut_i,        // the packet ends early, behind the record of take_i if any

    // what the record is judged by; receive_check says what they mean
    input logic [VW:0] limit_vertices_i,
    input logic [QW:0] limit_quads_i,
    input logic [VW:0] vertices_i,
    input logic [QW:0] faces_i,
    input logic [QW:0] halfedges_i,
    input logic [QW:0] halfedge_i,
    input logic [ 7:0] corner_i,
    input logic [QW:0] face_i,
    input logic [ 7:0] sides_i,
    input logic [ 7:0] forced_i,

    // from transform: this vertex's row overflows
    input logic          overflow_i,
    input logic [VW-1:0] overflow_index_i,
    input logic [   1:0] overflow_row_i,

    output logic        bad_o,
    output logic [ 7:0] status_o,
    output logic [31:0] position_o
);

  logic [31:0] crc_q, crc_d;
  logic check_bad;
  logic [1:0] bad_word;
  logic [7:0] bad_status;
  logic [31:0] cut_position, overflow_position;

  crc32 i_crc32 (
      .enable_i(1'b1), .end_i(at_end_i), .crc_i(crc_q), .data_i(record_i), .crc_o(crc_d)
  );

  receive_check #(
      .VERTICES(VERTICES), .QUADS(QUADS)
  ) i_check (
      .record_i, .at_view_i, .at_counts_i, .at_picture_i, .at_matrix_i, .at_vertex_i, .at_corner_i,
      .at_end_i, .at_behind_i, .limit_vertices_i, .limit_quads_i, .vertices_i, .faces_i, .halfedges_i,
      .halfedge_i, .corner_i, .face_i, .sides_i, .forced_i, .crc_i(crc_d), .bad_o(check_bad),
      .word_o(bad_word), .status_o(bad_status)
  );

  assign bad_o = take_i && check_bad;
  assign cut_position = {number_i + 30'(take_i), 2'd0};
  assign overflow_position = {
    hs_pkg::HEADER_RECORDS[29:0] + hs_pkg::MATRIX_RECORDS[29:0] + 30'(overflow_index_i),
    overflow_row_i
  };

  always_ff @(posedge clk_i) begin
    if (take_i) crc_q <= crc_d;
    if (bad_o) begin
      status_o   <= bad_status;
      position_o <= {number_i, bad_word};
    end
    if (cut_i) begin
      status_o   <= hs_pkg::STATUS_TRUNCATED;
      position_o <= cut_position;
    end
    if (overflow_i && overflow_position < position_o) begin
      status_o   <= hs_pkg::STATUS_OVERFLOW;
      position_o <= overflow_position;
    end
    if (start_i) begin
      crc_q <= 32'hffffffff;
      status_o <= hs_pkg::STATUS_OK;
      position_o <= hs_pkg::NO_POSITION;
    end
  end

endmodule
