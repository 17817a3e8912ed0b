// SPDX-License-Identifier: Apache-2.0
//
// Marks, point and verdict on the edges of faces, without the memories around them; and short_edges
// once more by itself, as the edges of a face never let it see one end alone.

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
    output logic         edges_short_o
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

endmodule
