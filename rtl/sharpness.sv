// SPDX-License-Identifier: Apache-2.0
//
// sharpness: how sharp every initial vertex is, collected while the vertices and then the corners of
// a packet come in. docs/refinement.md, section 9, says why a few numbers a vertex are enough.
//
//   word   {many, seen, own[3:0], t3[3:0], t2[3:0], t1[3:0]}
//     t1 >= t2 >= t3   the largest sharpnesses of the edges around the vertex, 0 where there are fewer
//     own              the largest sharpness of the vertex itself that any of its corners says
//     seen, many       one corner came, a second one came
//
//   * Every edge inside the surface has one half-edge that leaves each of its ends, so it is enough
//     to look at those that leave. On the boundary as many half-edges leave a vertex as arrive: each
//     that leaves counts as two edges of SHARP_INFINITE. Where the mode is kept there is no boundary;
//     receive gives a half-edge on the border the sharpness 0, which is as good as any, since a vertex
//     on the border is held. The golden model does the same.
//   * A vertex clears its word. All vertices come before the first corner.
//   * Rate: a corner a cycle: read in its cycle, written in the next one. A read that meets the write
//     of the corner before may answer either word; the new one is at hand here.

module sharpness #(
    parameter int unsigned VW = 19  // width of a vertex number
) (
    input logic clk_i,
    input logic rst_i,

    // receive
    input logic          vertex_valid_i,
    input logic [VW-1:0] vertex_index_i,
    input logic          corner_valid_i,
    input logic [VW-1:0] corner_origin_i,
    input logic          corner_boundary_i,   // and the mode is not kept
    input logic [   3:0] corner_sharpness_i,  // of the edge; anything on the boundary
    input logic [   3:0] corner_own_i,        // of the vertex

    // the words: reads answer one cycle later
    output logic          rd_en_o,
    output logic [VW-1:0] rd_index_o,
    input  logic [  17:0] rd_data_i,
    output logic          wr_en_o,
    output logic [VW-1:0] wr_index_o,
    output logic [  17:0] wr_data_o
);

  localparam logic [3:0] INFINITE = hs_pkg::SHARP_INFINITE[3:0];

  assign rd_en_o = corner_valid_i;
  assign rd_index_o = corner_origin_i;

  // --- The corner whose word has come, and the word of the corner before it ---------------------------
  logic valid_q, boundary_q, before_valid_q;
  logic [VW-1:0] origin_q, before_origin_q;
  logic [3:0] sharpness_q, own_q;
  logic [17:0] before_q, word, next;

  always_ff @(posedge clk_i) begin
    valid_q <= corner_valid_i;
    origin_q <= corner_origin_i;
    boundary_q <= corner_boundary_i;
    sharpness_q <= corner_sharpness_i;
    own_q <= corner_own_i;
    before_valid_q <= valid_q;
    before_origin_q <= origin_q;
    before_q <= next;
    if (rst_i) begin
      valid_q <= 1'b0;
      before_valid_q <= 1'b0;
    end
  end

  assign word = before_valid_q && before_origin_q == origin_q ? before_q : rd_data_i;

  // --- One more half-edge leaves the vertex -----------------------------------------------------------
  logic [3:0] own, t1, t2, t3, next_own, next_t1, next_t2, next_t3;

  assign {own, t3, t2, t1} = word[15:0];
  assign next_own = own_q > own ? own_q : own;

  always_comb begin
    next_t1 = t1;
    next_t2 = t2;
    next_t3 = t3;
    if (boundary_q) begin
      next_t1 = INFINITE;
      next_t2 = INFINITE;
      next_t3 = t1;
    end else if (sharpness_q > t1) begin
      next_t1 = sharpness_q;
      next_t2 = t1;
      next_t3 = t2;
    end else if (sharpness_q > t2) begin
      next_t2 = sharpness_q;
      next_t3 = t2;
    end else if (sharpness_q > t3) begin
      next_t3 = sharpness_q;
    end
  end

  assign next = {word[17] || word[16], 1'b1, next_own, next_t3, next_t2, next_t1};

  assign wr_en_o = vertex_valid_i || valid_q;
  assign wr_index_o = vertex_valid_i ? vertex_index_i : origin_q;
  assign wr_data_o = vertex_valid_i ? 18'd0 : next;

`ifndef YOSYS
  vertices_before_corners :
  assert property (@(posedge clk_i) disable iff (rst_i)
      vertex_valid_i |-> !corner_valid_i && !valid_q)
  else $error("sharpness: a vertex came with or right behind a corner");
`endif

endmodule
