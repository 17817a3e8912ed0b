// SPDX-License-Identifier: Apache-2.0
//
// Marks, point and verdict on the edges of faces, without the memories around them; short_edges once
// more by itself, as the edges of a face never let it see one end alone, and marks, as those of a face
// are four determinants together.

module geometry_top (
    input logic clk_i,
    input logic rst_i,

    input logic        quads_i,
    input logic [15:0] min_edge_i,
    input logic [15:0] width_i,
    input logic [15:0] height_i,

    input logic         valid_i,
    input logic         half_i,
    input logic         last_i,
    input logic         border_i,
    input logic [511:0] position_i,
    input logic [511:0] source_i,

    output logic         valid_o,
    output logic [127:0] point_o,
    output logic         front_o,
    output logic         back_o,
    output logic         hits_o,
    output logic         stop_o,
    output logic         nonquad_o,
    output logic [159:0] sum_o,
    output logic [127:0] last_position_o,
    output logic         last_border_o,

    input  logic         edges_valid_i,
    input  logic [  3:0] edges_use_i,
    input  logic [383:0] edges_from_i,
    input  logic [383:0] edges_to_i,
    output logic         edges_short_o,

    input  logic         marks_valid_i,
    input  logic [  3:0] marks_use_i,
    input  logic [767:0] marks_vectors_i,  // a, b, c, d, p, q, r, s
    output logic         marks_front_o,
    output logic         marks_back_o
);

  face_geometry u_geometry (.*);

  short_edges u_edges (
      .clk_i,
      .min_edge_i,
      .width_i,
      .height_i,
      .valid_i(edges_valid_i),
      .use_i(edges_use_i),
      .from_i(edges_from_i),
      .to_i(edges_to_i),
      .all_short_o(edges_short_o)
  );

  marks u_marks (
      .clk_i,
      .valid_i(marks_valid_i),
      .use_i(marks_use_i),
      .a_i(marks_vectors_i[0+:96]),
      .b_i(marks_vectors_i[96+:96]),
      .c_i(marks_vectors_i[192+:96]),
      .d_i(marks_vectors_i[288+:96]),
      .p_i(marks_vectors_i[384+:96]),
      .q_i(marks_vectors_i[480+:96]),
      .r_i(marks_vectors_i[576+:96]),
      .s_i(marks_vectors_i[672+:96]),
      .front_o(marks_front_o),
      .back_o(marks_back_o)
  );

endmodule
