// SPDX-License-Identifier: Apache-2.0
//
// split_faces: the part of split_write that sends what is final of an item, as ops for emit.
//
//   item           a face that is not refined      a refined face
//   edge v -> w    (any)                           kept             replaced, in the last step
//   op             the face: a quad's FACES,       new vertex F,    FACES: the child quad
//                  an n-gon's CORNER               FACES: the       (w, F, v, G), where it is
//                                                  triangle         numbered
//                                                  (v, w, F)
//
//   * In the last step a boundary edge leaves its half-quad (w, F, v) as a triangle; a half-quad that
//     is not refined is a triangle too.
//   * An item is at most one VERTEX op and one FACES or CORNER op, in this order. A FACES op has a
//     slot for each edge. Items wait in a FIFO for emit, so that one with two ops holds up nobody as
//     long as others have none.
//   * The new vertex is sent before its face's first triangle, but in the last step, when smooth
//     sent it. In generation 0 (quads_i low) an item is a corner, and of its edges only edge 0
//     counts: the n-gon sends its vertex once.
//   * An item is there with done_i, which needs over_o: there is room for what it has to send.
//     sent_o: with done_i, its new vertex is sent here. active_o: something is not yet sent.

module split_faces #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned OPS = 16,  // items that wait for emit
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    input logic quads_i,
    input logic last_step_i,

    // the item
    input  logic            done_i,
    output logic            over_o,
    output logic            sent_o,
    output logic            active_o,
    input  logic            first_i,            // of its face
    input  logic            last_i,
    input  logic [     7:0] sides_i,
    input  logic            candidate_i,
    input  logic            refined_i,
    input  logic            selected_i,
    input  logic [     3:0] lanes_i,            // edges that there are
    input  logic [     3:0] boundary_i,
    input  logic            half_i,
    input  logic [  VW-1:0] number_i,           // of the new vertex, F
    input  logic [   127:0] point_i,
    input  logic [4*VW-1:0] origin_i,           // of each edge: v
    input  logic [4*VW-1:0] next_origin_i,      // w
    input  logic [     3:0] replaced_i,
    input  logic [     3:0] lower_i,
    input  logic [     3:0] beyond_selected_i,
    input  logic [4*VW-1:0] beyond_number_i,    // G

    // to emit
    output logic         op_valid_o,
    input  logic         op_ready_i,
    output logic [  2:0] op_kind_o,
    output logic [ 23:0] op_number_o,
    output logic [127:0] op_position_o,
    output logic [  3:0] op_mask_o,
    output logic [  3:0] op_triangle_o,
    output logic [  3:0] op_child_o,
    output logic [  3:0] op_candidate_o,
    output logic [383:0] op_vertex_o,
    output logic [  7:0] op_sides_o,
    output logic         op_first_o,
    output logic         op_last_o,
    output logic fault_o
);

  // --- What there is to send ---------------------------------------------------------------------
  logic [3:0] kept, leaving;  // edges that yield a triangle; or, in the last step, a quad
  logic vertex_needed, face_needed;
  logic vertex_sent_q;  // generation 0: with an earlier corner

  assign kept = refined_i ? lanes_i & ~replaced_i & ~boundary_i : 4'b0000;
  assign leaving = refined_i && last_step_i ? replaced_i & lower_i : 4'b0000;
  assign vertex_needed = kept != 4'b0000 && !last_step_i && (first_i || !vertex_sent_q);
  assign face_needed = !refined_i || (kept | leaving) != 4'b0000;

  always_ff @(posedge clk_i) begin
    if (done_i) vertex_sent_q <= !last_i && (vertex_needed || (!first_i && vertex_sent_q));
  end
  assign sent_o = done_i && vertex_needed;

  // --- The ops of an item --------------------------------------------------------------------------
  // {vertex, face, kind, number, position, mask, triangle, child, candidate, vertices, sides, first,
  // last}
  localparam int unsigned OP_BITS = 1 + 1 + 3 + 24 + 128 + 4 * 4 + 384 + 8 + 1 + 1;

  logic [OP_BITS-1:0] ops;
  logic [2:0] kind;
  logic [23:0] number;
  logic [3:0] mask, triangle, candidate;
  logic [383:0] vertices;
  logic room;

  assign kind = refined_i || quads_i ? 3'(hs_pkg::OP_FACES) : 3'(hs_pkg::OP_CORNER);
  assign number = refined_i ? 24'(number_i) : 24'(origin_i[0+:VW]);
  assign mask = refined_i ? kept | leaving : 4'b0001;
  assign triangle = refined_i ? kept | (leaving & boundary_i) : {3'b000, half_i};
  assign candidate = refined_i ? leaving & (beyond_selected_i | boundary_i) & {4{selected_i}}
                               : {3'b000, candidate_i};

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic [23:0] v, w, f, g;
      v = 24'(origin_i[i*VW+:VW]);
      w = 24'(next_origin_i[i*VW+:VW]);
      f = 24'(number_i);
      g = 24'(beyond_number_i[i*VW+:VW]);
      vertices[i*96+:96] = kept[i] ? {24'd0, f, w, v} : {g, v, f, w};
    end
    if (!refined_i)
      for (int k = 0; k < 4; k++) vertices[k*24+:24] = 24'(origin_i[k*VW+:VW]);
  end

  assign ops = {vertex_needed, face_needed, kind, number, point_i, mask, triangle, leaving, candidate,
                vertices, sides_i, first_i, last_i};
  assign over_o = room || !(vertex_needed || face_needed);

  // --- One op after the other ----------------------------------------------------------------------
  logic has_vertex, has_face, vertex_done_q, vertex_now, take;
  logic [2:0] face_kind;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(OP_BITS),
      .DEPTH(OPS), .PARITY(PARITY)
  ) u_ops (
      .fault_o(fault_o),
      .clk_i, .rst_i, .in_valid_i(done_i && (vertex_needed || face_needed)), .in_ready_o(room),
      .in_data_i(ops), .out_valid_o(op_valid_o), .out_ready_i(take),
      .out_data_o({
        has_vertex, has_face, face_kind, op_number_o, op_position_o, op_mask_o, op_triangle_o,
        op_child_o, op_candidate_o, op_vertex_o, op_sides_o, op_first_o, op_last_o
      }),
      .level_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign vertex_now = has_vertex && !vertex_done_q;
  assign op_kind_o = vertex_now ? 3'(hs_pkg::OP_VERTEX) : face_kind;
  assign take = op_ready_i && !(vertex_now && has_face);
  assign active_o = op_valid_o;

  always_ff @(posedge clk_i) begin
    if (op_valid_o && op_ready_i) vertex_done_q <= vertex_now && has_face;
    if (rst_i) vertex_done_q <= 1'b0;
  end

endmodule
