// SPDX-License-Identifier: Apache-2.0
//
// Marks, point and verdict on the edges of faces, without the memories around them.

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
    output logic         last_border_o
);

  face_geometry u_geometry (.*);

endmodule
