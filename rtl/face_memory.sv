// SPDX-License-Identifier: Apache-2.0
//
// What the stages of one generation leave for each other, by face and by item.
//
//   point     the new vertex's position, the face's front mark, and whether it stops; written by
//             classify
//   selected  written by select
//   verdict   {refined, selected, number} per item; written by guard. Twice: in banks for split's
//             look beyond a twin, and in order for the item itself
//   number    {first child, lower edges} per item; written and read by split
//
//   * fault_o, two cycles behind a read: the parity of a word of use was wrong.
//   * An item is a quad, or in generation 0 a corner. Faces and items are read in order. All reads
//     answer one cycle later.

module face_memory #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19,
    parameter int unsigned BANK_BITS = 3,
    parameter bit PARITY = 1'b1,
    localparam int unsigned BANKS = 1 << BANK_BITS,
    localparam int unsigned ROW_BITS = QW - BANK_BITS
) (
    input logic clk_i,

    // by face
    input  logic          point_wr_en_i,
    input  logic [QW-1:0] point_wr_face_i,
    input  logic [ 127:0] point_wr_data_i,
    input  logic          point_wr_front_i,
    input  logic          point_wr_stop_i,
    input  logic          selected_wr_en_i,
    input  logic [QW-1:0] selected_wr_face_i,
    input  logic          selected_wr_data_i,
    input  logic          face_rd_en_i,
    input  logic [QW-1:0] face_rd_i,
    input  logic          point_used_i,     // points are of use
    input  logic          face_line_i,      // its line is read for points_o
    input  logic [  QW:0] faces_i,          // of a line those that exist
    input  logic          selected_used_i,  // the face's selected is of use; its own verdict
    input  logic          own_used_i,
    output logic [ 127:0] point_o,
    output logic [ 511:0] points_o,   // of the faces in line with this one, two or four
    output logic          front_o,
    output logic          stop_o,
    output logic          selected_o,

    // by item
    input  logic                      verdict_wr_en_i,
    input  logic [            QW-1:0] verdict_wr_item_i,
    input  logic [            VW+1:0] verdict_wr_data_i,
    input  logic                      own_rd_en_i,
    input  logic [            QW-1:0] own_rd_item_i,
    output logic [            VW+1:0] own_o,
    input  logic [         BANKS-1:0] verdict_rd_en_i,
    input  logic [ROW_BITS*BANKS-1:0] verdict_rd_row_i,
    output logic [  (VW+2)*BANKS-1:0] verdict_rd_data_o,
    input  logic                      number_wr_en_i,
    input  logic [            QW-1:0] number_wr_item_i,
    input  logic [            QW+3:0] number_wr_data_i,
    input  logic [         BANKS-1:0] number_rd_en_i,
    input  logic [ROW_BITS*BANKS-1:0] number_rd_row_i,
    output logic [  (QW+4)*BANKS-1:0] number_rd_data_o,

    output logic fault_o
);

  logic fault_point, fault_selected, fault_own, fault_verdict, fault_number;
  assign fault_o = fault_point || fault_selected || fault_own || fault_verdict || fault_number;

  function automatic logic [BANKS-1:0] bank_of(input logic en, input logic [BANK_BITS-1:0] bank);
    bank_of = BANKS'(en) << bank;
  endfunction

  localparam int unsigned LINE_BITS = BANK_BITS < 2 ? 1 : 2;
  localparam int unsigned LINE = 1 << LINE_BITS;

  logic [LINE*130-1:0] line;
  logic [LINE_BITS-1:0] lane_q;
  logic [LINE-1:0] line_used;
  logic [QW-LINE_BITS-1:0] row_q;
  logic line_q, selected_used_q, own_used_q;

  banked_memory #(
      .WIDTH(130),
      .ROW_BITS(QW - LINE_BITS),
      .BANK_BITS(LINE_BITS),
      .PARITY(PARITY)
  ) u_point (
      .clk_i,
      .check_i(line_used),
      .fault_o(fault_point),
      .rd_en_i({LINE{face_rd_en_i}}),
      .rd_row_i({LINE{face_rd_i[QW-1:LINE_BITS]}}),
      .rd_data_o(line),
      .wr_en_i(LINE'(point_wr_en_i) << point_wr_face_i[LINE_BITS-1:0]),
      .wr_row_i({LINE{point_wr_face_i[QW-1:LINE_BITS]}}),
      .wr_data_i({LINE{point_wr_stop_i, point_wr_front_i, point_wr_data_i}})
  );

  always_ff @(posedge clk_i) begin
    if (face_rd_en_i) begin
      {row_q, lane_q} <= face_rd_i;
      line_q <= face_line_i;
    end
    selected_used_q <= selected_used_i;
    own_used_q <= own_used_i;
  end

  always_comb begin
    for (int i = 0; i < LINE; i++)
      line_used[i] = point_used_i &&
          (line_q ? {1'b0, row_q, LINE_BITS'(i)} < faces_i : lane_q == LINE_BITS'(i));
  end

  assign {stop_o, front_o, point_o} = line[130*32'(lane_q)+:130];
  for (genvar i = 0; i < 4; i++) begin : g_points
    assign points_o[128*i+:128] = line[130*(i%LINE)+:128];
  end

  banked_memory #(
      .WIDTH(1),
      .ROW_BITS(QW),
      .BANK_BITS(0),
      .PARITY(PARITY)
  ) u_selected (
      .clk_i,
      .check_i(selected_used_q),
      .fault_o(fault_selected),
      .rd_en_i(face_rd_en_i),
      .rd_row_i(face_rd_i),
      .rd_data_o(selected_o),
      .wr_en_i(selected_wr_en_i),
      .wr_row_i(selected_wr_face_i),
      .wr_data_i(selected_wr_data_i)
  );

  banked_memory #(
      .WIDTH(VW + 2),
      .ROW_BITS(QW),
      .BANK_BITS(0),
      .PARITY(PARITY)
  ) u_own (
      .clk_i,
      .check_i(own_used_q),
      .fault_o(fault_own),
      .rd_en_i(own_rd_en_i),
      .rd_row_i(own_rd_item_i),
      .rd_data_o(own_o),
      .wr_en_i(verdict_wr_en_i),
      .wr_row_i(verdict_wr_item_i),
      .wr_data_i(verdict_wr_data_i)
  );

  banked_memory #(
      .WIDTH(VW + 2),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_verdict (
      .clk_i,
      .check_i({BANKS{1'b1}}),
      .fault_o(fault_verdict),
      .rd_en_i(verdict_rd_en_i),
      .rd_row_i(verdict_rd_row_i),
      .rd_data_o(verdict_rd_data_o),
      .wr_en_i(bank_of(verdict_wr_en_i, verdict_wr_item_i[BANK_BITS-1:0])),
      .wr_row_i({BANKS{verdict_wr_item_i[QW-1:BANK_BITS]}}),
      .wr_data_i({BANKS{verdict_wr_data_i}})
  );

  banked_memory #(
      .WIDTH(QW + 4),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_number (
      .clk_i,
      .check_i({BANKS{1'b1}}),
      .fault_o(fault_number),
      .rd_en_i(number_rd_en_i),
      .rd_row_i(number_rd_row_i),
      .rd_data_o(number_rd_data_o),
      .wr_en_i(bank_of(number_wr_en_i, number_wr_item_i[BANK_BITS-1:0])),
      .wr_row_i({BANKS{number_wr_item_i[QW-1:BANK_BITS]}}),
      .wr_data_i({BANKS{number_wr_data_i}})
  );

endmodule
