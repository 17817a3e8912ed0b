// SPDX-License-Identifier: Apache-2.0
//
// The receive stage: takes the packet of a view apart, checks every bit of it, and hands its
// vertices to transform and its corners to the corner memory. docs/stream.md defines the packet.
//
//   beats -> unpack -> a record a cycle -+-> receive_header: settings, counts, matrix
//                                        +-> receive_verdict: what is wrong, and where
//                                        +-> vertices to transform, corners to memory
//
//   * start_i allows one packet; it may come from done_o's cycle on. Until then, and between a
//     packet's last beat and the next start_i, no beat is taken.
//   * done_o, for one cycle: the packet's TLAST was taken, transform has drained, and the verdict
//     status_o, position_o is final. From then to the next start_i all header outputs hold.
//   * The error at the smallest word position wins, even if transform reports it (overflow_i)
//     after a later one was found. Counts, depths and matrix are right if status_o is STATUS_OK;
//     the ones used before done_o (by transform) have passed their checks by then.
//   * After an error nothing is stored any more; records go by, one a cycle, until TLAST. What was
//     stored before, of a packet that turns out to be bad, is the sequencer's to ignore.

module receive #(
    // Vertices and corners that the memories hold: powers of two, 4 to 2^24.
    parameter int unsigned VERTICES = 1024,
    parameter int unsigned QUADS = 1024,
    // Records a beat: 1, 2 or 4.
    parameter int unsigned PORT_RECORDS = 4,
    localparam int unsigned VW = $clog2(VERTICES),
    localparam int unsigned QW = $clog2(QUADS)
) (
    input logic clk_i,
    input logic rst_i,

    // Input stream
    input  logic                        s_axis_tvalid,
    output logic                        s_axis_tready,
    input  logic [128*PORT_RECORDS-1:0] s_axis_tdata,
    input  logic [ 16*PORT_RECORDS-1:0] s_axis_tkeep,
    input  logic                        s_axis_tlast,
    input  logic [                15:0] s_axis_tid,

    // Sequencer and registers
    input  logic        start_i,
    input  logic [VW:0] limit_vertices_i,  // at most VERTICES
    input  logic [QW:0] limit_quads_i,     // at most QUADS
    output logic        done_o,
    output logic        vertices_done_o,   // with the last vertex
    output logic [ 7:0] status_o,
    output logic [31:0] position_o,

    // Header
    output logic [ 15:0] view_o,              // TID of the packet's first beat
    output logic         uniform_o,
    output logic         guard_o,
    output logic         limit_o,
    output logic         kept_o,              // the boundary's mode
    output logic         corners_stay_o,      // it is smooth
    output logic [  7:0] front_depth_o,
    output logic [  7:0] silhouette_depth_o,
    output logic [  7:0] uniform_depth_o,
    output logic [ 15:0] min_edge_o,          // sixteenths of a pixel; 0: there is none
    output logic [ 15:0] width_o,             // of the picture, in pixels
    output logic [ 15:0] height_o,
    output logic [ VW:0] vertices_o,
    output logic [ QW:0] faces_o,
    output logic [ QW:0] halfedges_o,
    output logic [511:0] matrix_o,            // row r, column c: bits 128*r + 32*c +: 32
    output logic [  7:0] forced_max_o,        // largest forced depth
    output logic         closed_o,            // no half-edge is on a border or boundary
    output logic [ QW:0] boundary_count_o,    // half-edges on the boundary

    // Transform: takes a vertex whenever one is valid
    output logic          vertex_valid_o,
    output logic [VW-1:0] vertex_index_o,
    output logic [ 127:0] vertex_record_o,   // x, y, z, w
    input  logic          transform_busy_i,  // from the cycle after vertex_valid_o
    input  logic          overflow_i,        // until transform_busy_i falls, at the latest
    input  logic [VW-1:0] overflow_index_i,
    input  logic [   1:0] overflow_row_i,

    // Corner memory: half-edge corner_index_o. Without a twin it is on the border if the mode is
    // kept, else on the boundary; its edge then has the sharpness 0.
    output logic          corner_valid_o,
    output logic [QW-1:0] corner_index_o,
    output logic [VW-1:0] corner_origin_o,
    output logic [QW-1:0] corner_twin_o,       // anything if there is none
    output logic          corner_border_o,
    output logic          corner_boundary_o,
    output logic [   3:0] corner_sharpness_o,  // of the edge
    output logic [   3:0] corner_own_o,        // of the vertex
    output logic [   7:0] corner_forced_o,
    output logic          corner_first_o,      // of its face
    output logic          corner_last_o,       // of its face
    output logic [QW-1:0] corner_face_o,

    // Activity; idle if none of the three
    output logic busy_o,
    output logic starved_o,
    output logic blocked_o,
    output logic item_in_o,
    output logic item_out_o
);

  generate
    if ((VERTICES & (VERTICES - 1)) != 0 || VERTICES < 4 || VERTICES > (1 << 24)) begin : gen_bad_v
      $error("receive: VERTICES must be a power of two, 4 to 2^24");
    end
    if ((QUADS & (QUADS - 1)) != 0 || QUADS < 4 || QUADS > (1 << 24)) begin : gen_bad_q
      $error("receive: QUADS must be a power of two, 4 to 2^24");
    end
  endgenerate

  // --- Records.

  logic take;  // a record is there, and taken
  logic ends;  // it, or an empty beat, is the packet's end
  logic [127:0] record;

  unpack #(
      .PORT_RECORDS(PORT_RECORDS)
  ) i_unpack (
      .clk_i, .rst_i, .s_axis_tvalid, .s_axis_tready, .s_axis_tdata, .s_axis_tkeep, .s_axis_tlast,
      .s_axis_tid, .start_i, .valid_o(take), .record_o(record), .end_o(ends), .view_o
  );

  // --- What the record is. A packet is at work from start_i to its last record, then drains.

  localparam logic [3:0] AT_VIEW = 4'd0;
  localparam logic [3:0] AT_COUNTS = 4'd1;
  localparam logic [3:0] AT_PICTURE = 4'd2;
  localparam logic [3:0] AT_MATRIX = 4'd3;
  localparam logic [3:0] AT_VERTEX = 4'd4;
  localparam logic [3:0] AT_CORNER = 4'd5;
  localparam logic [3:0] AT_END = 4'd6;
  localparam logic [3:0] AT_BEHIND = 4'd7;
  localparam logic [3:0] AT_DISCARD = 4'd8;

  logic at_work_q, drain_q;
  logic [3:0] at_q, at_d;
  logic [29:0] number_q;  // of the record in its packet
  logic [1:0] row_q;
  logic [VW:0] vertex_q;
  logic [QW:0] halfedge_q, face_q;
  logic [7:0] corner_q, sides_q, forced_q;  // of the face that is coming in
  logic face_first, face_last;
  logic bad;  // the record has an error
  logic finish;

  always_comb begin
    at_d = at_q;
    case (at_q)
      AT_VIEW: at_d = AT_COUNTS;
      AT_COUNTS: at_d = AT_PICTURE;
      AT_PICTURE: at_d = AT_MATRIX;
      AT_MATRIX: if (row_q == 2'd3) at_d = AT_VERTEX;
      AT_VERTEX: if (vertex_q + 1'b1 == vertices_o) at_d = AT_CORNER;
      AT_CORNER: if (halfedge_q + 1'b1 == halfedges_o) at_d = AT_END;
      AT_END: at_d = AT_BEHIND;
      default: at_d = at_q;
    endcase
    if (!take) at_d = at_q;
    if (bad || overflow_i) at_d = AT_DISCARD;
  end

  assign face_first = corner_q == 8'd0;
  assign face_last = corner_q + 8'd1 == record[71:64];

  always_ff @(posedge clk_i) begin
    at_q <= at_d;
    if (take) begin
      number_q <= number_q + 1'b1;
      if (at_q == AT_MATRIX) row_q <= row_q + 1'b1;
      if (at_q == AT_VERTEX) vertex_q <= vertex_q + 1'b1;
      if (at_q == AT_CORNER) begin
        halfedge_q <= halfedge_q + 1'b1;
        sides_q <= record[71:64];
        forced_q <= record[79:72];
        corner_q <= face_last ? 8'd0 : corner_q + 8'd1;
        if (face_last) face_q <= face_q + 1'b1;
      end
    end
    if (ends) begin
      at_work_q <= 1'b0;
      drain_q   <= 1'b1;
    end
    if (finish) drain_q <= 1'b0;
    if (start_i) begin
      at_work_q <= 1'b1;
      at_q <= AT_VIEW;
      number_q <= '0;
      row_q <= '0;
      vertex_q <= '0;
      halfedge_q <= '0;
      face_q <= '0;
      corner_q <= '0;
    end
    if (rst_i) begin
      at_work_q <= 1'b0;
      drain_q   <= 1'b0;
    end
  end

  // --- The verdict, and the end of the work.

  logic cut_short;

  receive_verdict #(
      .VERTICES(VERTICES), .QUADS(QUADS)
  ) i_verdict (
      .clk_i, .start_i, .take_i(take), .record_i(record), .number_i(number_q),
      .at_view_i(at_q == AT_VIEW), .at_counts_i(at_q == AT_COUNTS),
      .at_picture_i(at_q == AT_PICTURE), .at_matrix_i(at_q == AT_MATRIX),
      .at_vertex_i(at_q == AT_VERTEX), .at_corner_i(at_q == AT_CORNER),
      .at_end_i(at_q == AT_END), .at_behind_i(at_q == AT_BEHIND), .cut_i(cut_short),
      .limit_vertices_i, .limit_quads_i, .vertices_i(vertices_o), .faces_i(faces_o),
      .halfedges_i(halfedges_o), .halfedge_i(halfedge_q), .corner_i(corner_q), .face_i(face_q),
      .sides_i(sides_q), .forced_i(forced_q), .overflow_i, .overflow_index_i, .overflow_row_i,
      .bad_o(bad), .status_o, .position_o
  );

  assign cut_short = ends && at_d != AT_BEHIND && at_d != AT_DISCARD;
  // transform_busy_i follows a vertex by a cycle.
  assign finish = drain_q && !vertex_valid_o && !transform_busy_i;

  always_ff @(posedge clk_i) begin
    done_o <= finish;
    if (rst_i) done_o <= 1'b0;
  end

  // --- What the view is, and what goes to the neighbours.

  logic store, twinless;
  assign store = take && !bad;
  assign twinless = record[63:32] == hs_pkg::BORDER;

  receive_header #(
      .VW(VW), .QW(QW)
  ) i_header (
      .clk_i, .start_i, .record_i(record), .store_i(store), .at_view_i(at_q == AT_VIEW),
      .at_counts_i(at_q == AT_COUNTS), .at_picture_i(at_q == AT_PICTURE),
      .at_matrix_i(at_q == AT_MATRIX), .at_corner_i(at_q == AT_CORNER), .uniform_o, .guard_o,
      .limit_o, .kept_o, .corners_stay_o, .front_depth_o, .silhouette_depth_o, .uniform_depth_o,
      .min_edge_o, .width_o, .height_o, .vertices_o, .faces_o, .halfedges_o, .matrix_o,
      .forced_max_o, .closed_o, .boundary_count_o
  );

  always_ff @(posedge clk_i) begin
    vertex_valid_o  <= store && at_q == AT_VERTEX;
    vertices_done_o <= store && at_q == AT_VERTEX && at_d == AT_CORNER;
    vertex_index_o  <= vertex_q[VW-1:0];
    vertex_record_o <= record;

    corner_valid_o  <= store && at_q == AT_CORNER;
    corner_index_o  <= halfedge_q[QW-1:0];
    corner_origin_o <= record[VW-1:0];
    corner_twin_o   <= record[32+:QW];
    corner_border_o <= twinless && kept_o;
    corner_boundary_o <= twinless && !kept_o;
    corner_sharpness_o <= twinless ? 4'd0 : record[99:96];
    corner_own_o <= record[103:100];
    corner_forced_o <= record[79:72];
    corner_first_o  <= face_first;
    corner_last_o   <= face_last;
    corner_face_o   <= face_q[QW-1:0];

    if (rst_i) begin
      vertex_valid_o  <= 1'b0;
      vertices_done_o <= 1'b0;
      corner_valid_o  <= 1'b0;
    end
  end

  assign busy_o = take;
  assign starved_o = at_work_q && at_q != AT_VIEW && !take;
  assign blocked_o = 1'b0;
  assign item_in_o = take;
  assign item_out_o = take;

  // --- What the neighbours owe, and what they are promised.

`ifndef YOSYS
  start_when_idle :
  assert property (@(posedge clk_i) disable iff (rst_i) start_i |-> !at_work_q && !drain_q)
  else $error("receive: started while at work");
  limits_in_range :
  assert property (@(posedge clk_i) disable iff (rst_i)
      32'(limit_vertices_i) <= VERTICES && 32'(limit_quads_i) <= QUADS)
  else $error("receive: a limit exceeds its memory");
  overflow_in_time :
  assert property (@(posedge clk_i) disable iff (rst_i) overflow_i |-> at_work_q || drain_q)
  else $error("receive: an overflow came after the verdict");
  verdict_holds :
  assert property (@(posedge clk_i) disable iff (rst_i)
      done_o && !start_i |=> $stable(status_o) && $stable(position_o) && !s_axis_tready)
  else $error("receive: the verdict changed, or a beat was asked for before a start");
  vertices_in_range :
  assert property (@(posedge clk_i) disable iff (rst_i)
      vertex_valid_o |-> {1'b0, vertex_index_o} < limit_vertices_i)
  else $error("receive: a vertex has no place in memory");
  corners_in_range :
  assert property (@(posedge clk_i) disable iff (rst_i)
      corner_valid_o |-> {1'b0, corner_index_o} < limit_quads_i
      && {1'b0, corner_origin_o} < vertices_o
      && (corner_border_o || corner_boundary_o || {1'b0, corner_twin_o} < halfedges_o))
  else $error("receive: a corner has no place in memory, or names what does not exist");
`endif

`ifdef HS_FORMAL
`include "activity.svh"
`endif

endmodule
