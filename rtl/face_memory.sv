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
//   * An item is a quad, or in generation 0 a corner. Faces and items are read in order. All reads
//     answer one cycle later.

module face_memory #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19,
    parameter int unsigned BANK_BITS = 3,
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
    output logic [  (QW+4)*BANKS-1:0] number_rd_data_o
);

  function automatic logic [BANKS-1:0] bank_of(input logic en, input logic [BANK_BITS-1:0] bank);
    bank_of = BANKS'(en) << bank;
  endfunction

  localparam int unsigned LINE_BITS = BANK_BITS < 2 ? 1 : 2;
  localparam int unsigned LINE = 1 << LINE_BITS;

  logic [LINE*130-1:0] line;
  logic [LINE_BITS-1:0] lane_q;

  banked_memory #(
      .WIDTH(130),
      .ROW_BITS(QW - LINE_BITS),
      .BANK_BITS(LINE_BITS)
  ) u_point (
      .clk_i,
      .rd_en_i({LINE{face_rd_en_i}}),
      .rd_row_i({LINE{face_rd_i[QW-1:LINE_BITS]}}),
      .rd_data_o(line),
      .wr_en_i(LINE'(point_wr_en_i) << point_wr_face_i[LINE_BITS-1:0]),
      .wr_row_i({LINE{point_wr_face_i[QW-1:LINE_BITS]}}),
      .wr_data_i({LINE{point_wr_stop_i, point_wr_front_i, point_wr_data_i}})
  );

  always_ff @(posedge clk_i) if (face_rd_en_i) lane_q <= face_rd_i[LINE_BITS-1:0];

  assign {stop_o, front_o, point_o} = line[130*32'(lane_q)+:130];
  for (genvar i = 0; i < 4; i++) begin : g_points
    assign points_o[128*i+:128] = line[130*(i%LINE)+:128];
  end

  banked_memory #(
      .WIDTH(1),
      .ROW_BITS(QW),
      .BANK_BITS(0)
  ) u_selected (
      .clk_i,
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
      .BANK_BITS(0)
  ) u_own (
      .clk_i,
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
      .BANK_BITS(BANK_BITS)
  ) u_verdict (
      .clk_i,
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
      .BANK_BITS(BANK_BITS)
  ) u_number (
      .clk_i,
      .rd_en_i(number_rd_en_i),
      .rd_row_i(number_rd_row_i),
      .rd_data_o(number_rd_data_o),
      .wr_en_i(bank_of(number_wr_en_i, number_wr_item_i[BANK_BITS-1:0])),
      .wr_row_i({BANKS{number_wr_item_i[QW-1:BANK_BITS]}}),
      .wr_data_i({BANKS{number_wr_data_i}})
  );

endmodule
