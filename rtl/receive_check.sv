// SPDX-License-Identifier: Apache-2.0
//
// What is wrong with one record of an input packet. Combinational; docs/stream.md gives the rules.
//
//   * One of the at_..._i says which record it is; none means that nothing is checked.
//   * bad_o: something is wrong. word_o is the first offending word, status_o its status.
//   * The counts and the depths of the face are those of records that passed before.

module receive_check #(
    parameter int unsigned VERTICES = 1024,
    parameter int unsigned QUADS = 1024,
    localparam int unsigned VW = $clog2(VERTICES),
    localparam int unsigned QW = $clog2(QUADS)
) (
    input logic [127:0] record_i,

    input logic at_view_i,     // record 0: magic, version, flags, vertices
    input logic at_counts_i,   // record 1: faces, half-edges, depths
    input logic at_picture_i,  // record 2: least edge, picture
    input logic at_matrix_i,
    input logic at_vertex_i,
    input logic at_corner_i,
    input logic at_end_i,      // the last record
    input logic at_behind_i,   // there should be none

    input logic [VW:0] limit_vertices_i,
    input logic [QW:0] limit_quads_i,

    // of the header
    input logic [VW:0] vertices_i,
    input logic [QW:0] faces_i,
    input logic [QW:0] halfedges_i,

    // of the corner: its half-edge, its number in its face, faces complete before it; if it is not
    // the first of its face, what that one said
    input logic [QW:0] halfedge_i,
    input logic [ 7:0] corner_i,
    input logic [QW:0] face_i,
    input logic [ 7:0] sides_i,
    input logic [ 7:0] forced_i,

    input logic [31:0] crc_i,  // at_end_i: the state behind the words before this record's last one

    output logic       bad_o,
    output logic [1:0] word_o,
    output logic [7:0] status_o
);

  logic [31:0] w0, w1, w2, w3;
  assign w0 = record_i[31:0];
  assign w1 = record_i[63:32];
  assign w2 = record_i[95:64];
  assign w3 = record_i[127:96];

  // --- Header. 3F needs two bits more than F.

  localparam logic [31:0] MODES = hs_pkg::FLAG_SMOOTH | hs_pkg::FLAG_EDGE_ONLY;  // not both
  localparam logic [31:0] FLAGS =
      hs_pkg::FLAG_UNIFORM | hs_pkg::FLAG_GUARD | hs_pkg::FLAG_LIMIT | MODES;

  logic flags_bad, counts_disagree, quads_exceeded, depth_bad, size_bad;
  assign flags_bad = (w2 & ~FLAGS) != 32'd0 || (w2 & MODES) == MODES;
  assign counts_disagree = {2'd0, w1} < {1'b0, w0, 1'b0} + {2'd0, w0};
  assign quads_exceeded = w1 > 32'(limit_quads_i);
  assign depth_bad = w2[31:24] != 8'd0 || w2[7:0] > hs_pkg::MAX_DEPTH[7:0]
                     || w2[15:8] > hs_pkg::MAX_DEPTH[7:0] || w2[23:16] > hs_pkg::MAX_DEPTH[7:0];
  assign size_bad = w0[15:0] != 16'd0 && (w1[15:0] == 16'd0 || w1[31:16] == 16'd0);

  // --- Matrix and vertices: an exponent of all ones is an infinity or not a number.

  logic [3:0] infinite;
  assign infinite = {&w3[30:23], &w2[30:23], &w1[30:23], &w0[30:23]};

  // --- Corners. Sides up to 255 are all that 8 bits can say. A face that fits into the rest of
  // the half-edges leaves none over, so the last half-edge always completes a face.

  logic twin_bad, first_bad, later_bad, count_bad, face_bad;
  logic [QW:0] rest;
  assign rest = halfedges_i - halfedge_i;
  assign twin_bad = w1 != hs_pkg::BORDER
                    && (w1 >= 32'(halfedges_i) || w1 == 32'(halfedge_i));
  assign first_bad = w2[7:0] < hs_pkg::MIN_SIDES[7:0] || 32'(w2[7:0]) > 32'(rest)
                     || face_i == faces_i || w2[15:8] > hs_pkg::MAX_DEPTH[7:0];
  assign later_bad = w2[7:0] != sides_i || w2[15:8] != forced_i;
  assign count_bad = rest == (QW + 1)'(1) && face_i + 1'b1 != faces_i;
  assign face_bad = w2[31:24] != 8'd0 || w2[23:16] != corner_i
                    || (corner_i == 8'd0 ? first_bad : later_bad) || count_bad;

  localparam logic [3:0] SHARPEST = hs_pkg::MAX_SHARPNESS[3:0];
  localparam logic [3:0] INFINITE = hs_pkg::SHARP_INFINITE[3:0];

  logic edge_bad, vertex_bad, sharpness_bad;
  assign edge_bad = w3[3:0] > SHARPEST && w3[3:0] != INFINITE;
  assign vertex_bad = w3[7:4] > SHARPEST && w3[7:4] != INFINITE;
  assign sharpness_bad = w3[31:8] != 24'd0 || edge_bad || vertex_bad;

  // --- Which words are bad, and the status of each.

  logic [3:0] bad;
  logic [7:0] status0, status1, status2, status3;

  always_comb begin
    bad = 4'd0;
    status0 = hs_pkg::STATUS_BAD_NUMBER;
    status1 = hs_pkg::STATUS_BAD_NUMBER;
    status2 = hs_pkg::STATUS_BAD_NUMBER;
    status3 = hs_pkg::STATUS_BAD_NUMBER;
    if (at_view_i) begin
      bad[0] = w0 != hs_pkg::MAGIC_VIEW;
      status0 = hs_pkg::STATUS_BAD_MAGIC;
      bad[1] = w1 != hs_pkg::STREAM_VERSION;
      status1 = hs_pkg::STATUS_BAD_VERSION;
      bad[2] = flags_bad;
      status2 = hs_pkg::STATUS_BAD_FLAGS;
      bad[3] = w3 < 32'd3 || w3 > 32'(limit_vertices_i);
      status3 = w3 < 32'd3 ? hs_pkg::STATUS_BAD_COUNT : hs_pkg::STATUS_CAPACITY_VERTICES;
    end
    if (at_counts_i) begin
      bad[0] = w0 == 32'd0;
      status0 = hs_pkg::STATUS_BAD_COUNT;
      bad[1] = counts_disagree || quads_exceeded;
      status1 = counts_disagree ? hs_pkg::STATUS_BAD_COUNT : hs_pkg::STATUS_CAPACITY_CORNERS;
      bad[2] = depth_bad;
      status2 = hs_pkg::STATUS_BAD_DEPTH;
      bad[3] = w3 != 32'd0;
      status3 = hs_pkg::STATUS_BAD_RESERVED;
    end
    if (at_picture_i) begin
      bad[0] = w0[31:16] != 16'd0;
      status0 = hs_pkg::STATUS_BAD_PIXELS;
      bad[1] = size_bad;
      status1 = hs_pkg::STATUS_BAD_PIXELS;
      bad[2] = w2 != 32'd0;
      status2 = hs_pkg::STATUS_BAD_RESERVED;
      bad[3] = w3 != 32'd0;
      status3 = hs_pkg::STATUS_BAD_RESERVED;
    end
    if (at_matrix_i || at_vertex_i) bad = infinite;
    if (at_corner_i) begin
      bad[0] = w0 >= 32'(vertices_i);
      status0 = hs_pkg::STATUS_BAD_INDEX;
      bad[1] = twin_bad;
      status1 = hs_pkg::STATUS_BAD_TWIN;
      bad[2] = face_bad;
      status2 = hs_pkg::STATUS_BAD_FACE;
      bad[3] = sharpness_bad;
      status3 = hs_pkg::STATUS_BAD_SHARPNESS;
    end
    if (at_end_i) begin
      bad[0] = w0 != hs_pkg::MAGIC_END;
      status0 = hs_pkg::STATUS_BAD_TRAILER;
      bad[1] = w1 != 32'd0;
      status1 = hs_pkg::STATUS_BAD_RESERVED;
      bad[2] = w2 != 32'd0;
      status2 = hs_pkg::STATUS_BAD_RESERVED;
      bad[3] = w3 != ~crc_i;
      status3 = hs_pkg::STATUS_BAD_CRC;
    end
    if (at_behind_i) begin
      bad[0]  = 1'b1;
      status0 = hs_pkg::STATUS_TOO_LONG;
    end
  end

  assign bad_o = bad != 4'd0;
  assign word_o = bad[0] ? 2'd0 : bad[1] ? 2'd1 : bad[2] ? 2'd2 : 2'd3;
  assign status_o = bad[0] ? status0 : bad[1] ? status1 : bad[2] ? status2 : status3;

endmodule
