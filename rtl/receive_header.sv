// SPDX-License-Identifier: Apache-2.0
//
// receive_header: the part of receive that keeps what a packet says of its view: the settings and
// counts of its header, the matrix, and what only all half-edges together tell.
//
//   * store_i: the record has no error, and one of the at_..._i says which one it is. The outputs
//     follow in the cycle after.
//   * start_i begins a packet: the sums over the half-edges start anew, the rest stays what it was.

module receive_header #(
    parameter int unsigned VW = 19,  // width of a vertex' number
    parameter int unsigned QW = 19   // width of a half-edge's
) (
    input logic clk_i,
    input logic start_i,

    /* verilator lint_off UNUSEDSIGNAL */
    input logic [127:0] record_i,    // checked: no count has more bits than are kept
    /* verilator lint_on UNUSEDSIGNAL */
    input logic         store_i,
    input logic         at_view_i,
    input logic         at_counts_i,
    input logic         at_picture_i,
    input logic         at_matrix_i,
    input logic         at_corner_i,

    output logic         uniform_o,
    output logic         guard_o,
    output logic         limit_o,
    output logic         kept_o,             // the boundary's mode
    output logic         corners_stay_o,     // it is smooth
    output logic [  7:0] front_depth_o,
    output logic [  7:0] silhouette_depth_o,
    output logic [  7:0] uniform_depth_o,
    output logic [ 15:0] min_edge_o,         // sixteenths of a pixel; 0: there is none
    output logic [ 15:0] width_o,            // of the picture, in pixels
    output logic [ 15:0] height_o,
    output logic [ VW:0] vertices_o,
    output logic [ QW:0] faces_o,
    output logic [ QW:0] halfedges_o,
    output logic [511:0] matrix_o,           // row r, column c: bits 128*r + 32*c +: 32
    output logic [  7:0] forced_max_o,       // largest forced depth
    output logic         closed_o,           // no half-edge is on a border or boundary
    output logic [ QW:0] boundary_count_o    // half-edges on the boundary; 0 if the mode is kept
);

  logic [31:0] flags;
  logic twinless;

  assign flags = record_i[95:64];
  assign twinless = record_i[63:32] == hs_pkg::BORDER;

  always_ff @(posedge clk_i) begin
    if (store_i && at_view_i) begin
      uniform_o <= (flags & hs_pkg::FLAG_UNIFORM) != 32'd0;
      guard_o <= (flags & hs_pkg::FLAG_GUARD) != 32'd0;
      limit_o <= (flags & hs_pkg::FLAG_LIMIT) != 32'd0;
      kept_o <= (flags & (hs_pkg::FLAG_SMOOTH | hs_pkg::FLAG_EDGE_ONLY)) == 32'd0;
      corners_stay_o <= (flags & hs_pkg::FLAG_SMOOTH) != 32'd0;
      vertices_o <= record_i[96+:VW+1];
    end
    if (store_i && at_counts_i) begin
      faces_o <= record_i[0+:QW+1];
      halfedges_o <= record_i[32+:QW+1];
      front_depth_o <= record_i[71:64];
      silhouette_depth_o <= record_i[79:72];
      uniform_depth_o <= record_i[87:80];
    end
    if (store_i && at_picture_i) begin
      min_edge_o <= record_i[15:0];
      width_o <= record_i[47:32];
      height_o <= record_i[63:48];
    end
    if (store_i && at_matrix_i) matrix_o <= {record_i, matrix_o[511:128]};
    if (store_i && at_corner_i) begin
      if (record_i[79:72] > forced_max_o) forced_max_o <= record_i[79:72];
      if (twinless) closed_o <= 1'b0;
      if (twinless && !kept_o) boundary_count_o <= boundary_count_o + 1'b1;
    end
    if (start_i) begin
      forced_max_o <= 8'd0;
      closed_o <= 1'b1;
      boundary_count_o <= '0;
    end
  end

endmodule
