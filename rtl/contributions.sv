// SPDX-License-Identifier: Apache-2.0
//
// What every corner of a face contributes to its vertex: marks, and addends of the sums T and M.
//
//                          the vertex is smooth               is on a crease
//   T    even generations  prior + F                          ends
//   M    even generations  S + 2 prior                        ends
//        odd generations   4 A + prior                        A, if its quad was made of a sharp edge
//
//   prior, next   the neighbours that the corner's half-edges come from and go to
//   F, A, S       the face's new point, as F or A; the sum of its corners
//   ends          prior, if the half-edge from there is sharp or on the boundary, plus next, if the
//                 half-edge to there is on the boundary
//
//   * T sums w + F over the half-edges v -> w, and M is n v + sum of 4a + b in even generations, sum
//     of 4A + w in odd ones; a is the next corner, b the opposite one. Here the neighbour on the way
//     in stands where these have the one on the way out: around a closed vertex the sums are the same,
//     and no other is smooth and moves, or leaves at its limit. S is v + a + b + prior: its sum, and
//     twice that of prior, is that of v + 4a + b.
//   * The two sharp edges of a crease vertex are met once each: an edge inside by its half-edge that
//     arrives, or, in odd generations, by the quad made of it, whose corners 0 and 2 are its ends; a
//     boundary edge by its only half-edge at both of its ends, or by its half-quad.
//   * What a vertex that stays gets is of no use to anyone.
//
//   items, results --> fold --> the item with its neighbours --> addends, comb. --> accumulate, ring
//
//   * In generation 0 an item waits for the next one of its face: that has the next corner.
//   * item_*: fold's, one quad or corner; result_*: fold's, one a face. Positions are S1.30.
//   * Rate: an item a cycle.

module contributions #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19,  // width of a quad's (generation 0: a corner's) number
    parameter int unsigned WINDOW_BITS = 3,  // of the gather before this
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    input  logic start_i,
    input  logic quads_i,
    input  logic odd_i,    // the step: the generation is even
    input  logic limit_i,
    output logic stall_o,
    output logic active_o,

    input logic            item_valid_i,
    input logic            item_last_i,
    input logic [4*VW-1:0] item_origin_i,
    input logic [   511:0] item_position_i,
    input logic [     3:0] item_border_i,
    input logic [     3:0] item_boundary_i,  // the half-edge is on the surface's boundary
    input logic [     3:0] item_sharp_i,     // even generations: it is sharp, or on the boundary
    input logic [     3:0] item_crease_i,    // the vertex is on a crease
    input logic            item_tag_i,       // odd generations: made of a sharp edge
    input logic            item_half_i,      // a half-quad: lane 3 is void

    input logic         result_valid_i,
    input logic [127:0] result_point_i,
    input logic [  2:0] result_marks_i,          // hits, back, front
    input logic [127:0] result_last_position_i,  // of the face's last corner (generation 0)
    input logic         result_last_border_i,
    input logic [159:0] result_sum_i,            // S(39.0) each
    input logic         result_nonquad_i,

    output logic            out_valid_o,
    input  logic            out_ready_i,
    output logic [     3:0] out_mask_o,
    output logic [4*VW-1:0] out_index_o,
    output logic [    15:0] out_marks_o,    // border, hits, back, front
    output logic [ 4*132-1:0] out_addend_o, // of T: S(32.0) each
    output logic [ 4*136-1:0] out_ring_o,   // of M: S(33.0) each
    output logic            out_nonquad_o,
    output logic [  QW-1:0] out_corner_o,   // the item's number
    output logic [   511:0] out_position_o, // of the item's corners
    output logic [   127:0] out_point_o,    // of its new vertex
    output logic [     3:0] out_boundary_o,
    output logic            item_out_o,
    output logic fault_o
);

  // --- Generation 0: the sharpness of the face's last corner waits for its result ----------------
  logic last_sharp;
  logic last_fault, fold_fault;

  assign fault_o = last_fault || fold_fault;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(1),
      .DEPTH(16), .PARITY(PARITY)
  ) u_last (
      .fault_o(last_fault),
      .clk_i,
      .rst_i,
      .in_valid_i(item_valid_i && item_last_i && !quads_i),
      .in_ready_o(),   // a face has 3 corners or more: few are on their way at a time
      .in_data_i(item_sharp_i[0]),
      .out_valid_o(),  // as result_valid_i
      .out_ready_i(result_valid_i && !quads_i),
      .out_data_o(last_sharp),
      .level_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // --- Fold: every corner with its face's marks, point and sum -----------------------------------
  // Of S 34 bits are enough where it is used, in quads: S(32.0).
  localparam int unsigned ITEM = 512 + 4 * VW + 18;
  localparam int unsigned RESULT = 1 + 136 + 1 + 1 + 128 + 3 + 128;

  logic fold_valid, fold_ready, fold_last, fold_active;
  logic [ITEM-1:0] fold_item;
  logic [RESULT-1:0] fold_result;
  logic [135:0] result_sum;
  logic [127:0] fold_last_position;
  logic fold_last_border, fold_last_sharp;

  always_comb begin
    for (int k = 0; k < 4; k++) result_sum[k*34+:34] = result_sum_i[k*40+:34];
  end

  fold #(
      .ITEM_WIDTH(ITEM),
      .RESULT_WIDTH(RESULT),
      .MARGIN((1 << WINDOW_BITS) + 24), .PARITY(PARITY)
  ) u_fold (
      .fault_o(fold_fault),
      .clk_i,
      .rst_i,
      .stall_o,
      .item_valid_i,
      .item_last_i,
      .item_i({
        item_half_i, item_tag_i, item_crease_i, item_sharp_i, item_boundary_i, item_border_i,
        item_origin_i, item_position_i
      }),
      .result_valid_i,
      .result_i({
        last_sharp, result_last_border_i, result_last_position_i, result_nonquad_i,
        result_sum, result_marks_i, result_point_i
      }),
      .out_valid_o(fold_valid),
      .out_ready_i(fold_ready),
      .out_last_o(fold_last),
      .out_item_o(fold_item),
      .out_result_o(fold_result),
      .active_o(fold_active)
  );
  assign {fold_last_sharp, fold_last_border, fold_last_position} = fold_result[RESULT-1-:130];

  // --- The item at work, and in generation 0 the corner before it --------------------------------
  logic valid_q, last_q, begins_q, known, take;
  logic [ITEM-1:0] item_q;
  logic [267:0] result_q;
  logic [127:0] first_q, previous_q;  // positions of the face's first corner, of the one before
  logic previous_border_q, previous_sharp_q;
  logic [QW-1:0] corner_q;

  logic half, tag, nonquad;
  logic [3:0] crease, sharp, boundary, border;
  logic [511:0] position;
  logic [135:0] sum;
  logic [2:0] marks;
  logic [127:0] point;

  assign {half, tag, crease, sharp, boundary, border, out_index_o, position} = item_q;
  assign {nonquad, sum, marks, point} = result_q;

  assign known = quads_i || last_q || fold_valid;
  assign take = out_valid_o && out_ready_i;
  assign fold_ready = !valid_q || take;

  always_ff @(posedge clk_i) begin
    if (fold_valid && fold_ready) begin
      valid_q <= 1'b1;
      item_q <= fold_item;
      result_q <= fold_result[267:0];
      last_q <= fold_last;
      begins_q <= fold_last;
      if (!quads_i) begin
        if (begins_q) first_q <= fold_item[127:0];
        previous_q <= begins_q ? fold_last_position : position[127:0];
        previous_border_q <= begins_q ? fold_last_border : border[0];
        previous_sharp_q <= begins_q ? fold_last_sharp : sharp[0];
      end
    end else if (take) begin
      valid_q <= 1'b0;
    end
    if (take) corner_q <= corner_q + QW'(1);
    if (start_i) begin
      begins_q <= 1'b1;
      corner_q <= '0;
    end
    if (rst_i) valid_q <= 1'b0;
  end

  // --- Neighbours --------------------------------------------------------------------------------
  // A half-quad's corner 0 has corner 2 before it, not 3; but both are ends of a boundary edge, and
  // so never smooth, where odd generations look at the neighbour.
  logic [511:0] prior, next;
  logic [3:0] prior_border, prior_sharp;

  always_comb begin
    prior = {position[383:0], position[511:384]};
    next = {position[127:0], position[511:128]};
    prior_border = {border[2:0], border[3]};
    prior_sharp = {sharp[2:0], sharp[3]};
    if (!quads_i) begin
      prior[127:0] = previous_q;
      next[127:0] = last_q ? first_q : fold_item[127:0];
      prior_border[0] = previous_border_q;
      prior_sharp[0] = previous_sharp_q;
    end
    if (half) prior_border[0] = border[2];
  end

  // --- Addends -----------------------------------------------------------------------------------
  function automatic logic [33:0] wide(input logic en, input logic [31:0] coordinate);
    wide = en ? {{2{coordinate[31]}}, coordinate} : 34'd0;
  endfunction

  // What has no use is not computed: it would cost the simulation its speed.
  always_comb begin
    out_addend_o = '0;
    out_ring_o = '0;
    for (int i = 0; i < 4; i++)
      out_marks_o[i*4+:4] = {border[i] || prior_border[i], marks};
    if (valid_q && odd_i)
      for (int i = 0; i < 4; i++)
        if (i == 0 || quads_i)
          for (int k = 0; k < 4; k++)
            out_addend_o[i*132+k*33+:33] = 33'(crease[i] ?
                wide(prior_sharp[i], prior[i*128+k*32+:32]) +
                wide(boundary[i], next[i*128+k*32+:32]) :
                wide(1'b1, prior[i*128+k*32+:32]) + wide(1'b1, point[k*32+:32]));
    if (valid_q && limit_i)
      for (int i = 0; i < 4; i++)
        if (i == 0 || quads_i)
          for (int k = 0; k < 4; k++)
            if (odd_i)
              out_ring_o[i*136+k*34+:34] = crease[i] ?
                  {out_addend_o[i*132+k*33+32], out_addend_o[i*132+k*33+:33]} :
                  sum[k*34+:34] + wide(1'b1, prior[i*128+k*32+:32]) * 34'd2;
            else
              out_ring_o[i*136+k*34+:34] = crease[i] ? wide(i % 2 == 0 && tag, point[k*32+:32]) :
                  wide(1'b1, point[k*32+:32]) * 34'd4 + wide(1'b1, prior[i*128+k*32+:32]);
  end

  assign out_valid_o = valid_q && known;
  assign out_mask_o = !quads_i ? 4'b0001 : half ? 4'b0111 : 4'b1111;
  assign out_nonquad_o = nonquad;
  assign out_corner_o = corner_q;
  assign out_position_o = position;
  assign out_point_o = point;
  assign out_boundary_o = boundary;
  assign item_out_o = take;
  assign active_o = fold_active || valid_q;

endmodule
