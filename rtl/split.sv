// SPDX-License-Identifier: Apache-2.0
//
// split: the half-edge rule. Let h: v -> w lie in face f and t = twin(h) in face g, both refined,
// with new vertices F and G. The step replaces the pair by the quad (w, F, v, G), corner by corner
// c0(h), c1(h), c0(t), c1(t) with h < t:
//
//          w                   c0(h): w -> F    next(c0(h)) = c1(h)    twin(c0(h)) = c1(next(h))
//        / | \                 c1(h): F -> v    next(c1(h)) = c0(t)    twin(c1(h)) = c0(prev(h))
//      F  h|t  G
//        \ | /                 Each half-edge contributes two children, from its own record alone.
//          v
//
// Quads are numbered by the lower of their two half-edges. An edge of one refined face only is
// kept: it yields the final triangle (v, w, F); a face that is not refined is final itself. A boundary
// edge is replaced alone: an odd step makes the half-quad (w, F, v) of it, with the edge itself in
// slot 2; in the even step that slot has no children, and what would be twinned with them is boundary.
//
//   fetch -----> gather -----------> split_number --------> split_write
//   records      verdicts beyond     which edges are        child halves,
//                the item's edges    replaced; numbers      final faces
//
//   * Here the items are fetched and wired from part to part; what each does stands in its file.
//   * start_i for one cycle with items_i: corners in generation 0 (quads_i low), quads later. The
//     settings hold until active_o falls. children_o: quads of the next generation so far.
//   * all_i: every face is refined, and the verdict memory is not used: face q's new vertex is
//     first_new_i + q. finish_i: none is refined.
//   * pass_i: classify hands its items on, in one pass with its own work; fetch rests. Then a quad's
//     position goes along, and each child half carries half the sum that its quad's new vertex, the
//     middle of the edge, is a quarter of: w + F, or on a sharp edge 2w. pass_take_i: classify
//     fetches an item, whose record is shown.
//   * edge_i: new vertices are made of such sums (edge_point_i), not by classify.
//   * Rate: a quad, or in generation 0 a corner, a cycle; less where bank conflicts fill a window, or
//     emit is behind.

module split #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19,  // width of a quad's (generation 0: a corner's) number
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8, // words a cycle
    parameter int unsigned READ_LATENCY = 1, // of a gather
    parameter int unsigned OPS = 16, // that wait for emit
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    // from the sequencer
    input  logic        start_i,
    input  logic [QW:0] items_i,
    input  logic        quads_i,
    input  logic        odd_i,        // the step is odd
    input  logic        all_i,
    input  logic        last_i,       // the children are final: they leave at once
    input  logic        finish_i,     // nothing is refined: all active faces are final
    input  logic [VW-1:0] first_new_i,
    input  logic [   7:0] generation_i,
    output logic        active_o,
    output logic [QW:0] children_o,

    // record memory, lane 0 only in generation 0; face memory; the item's own verdict
    output logic                record_rd_en_o,
    output logic [      QW-1:0] record_rd_item_o,
    output logic [      QW-1:0] record_rd_face_o,
    input  logic [    4*VW-1:0] record_origin_i,
    input  logic [4*(QW+2)-1:0] record_twin_i,
    input  logic [         3:0] record_border_i,
    input  logic [         3:0] record_boundary_i,
    input  logic [        15:0] record_sharp_i,
    input  logic [         3:0] record_tag_i,
    input  logic                record_half_i,
    input  logic                record_candidate_i,
    input  logic [         7:0] record_forced_i,
    input  logic                record_last_i,
    input  logic [       127:0] face_point_i,
    input  logic [      VW+1:0] own_verdict_i,  // {refined, selected, number}

    // from classify, in one pass
    input  logic            pass_i,
    input  logic            pass_take_i,
    input  logic            pass_valid_i,
    output logic            pass_ready_o,
    input  logic [  QW-1:0] pass_item_i,
    input  logic [4*VW-1:0] pass_origin_i,
    input  logic [   511:0] pass_position_i,
    input  logic [   127:0] pass_point_i,
    input  logic [     3:0] pass_boundary_i,
    input  logic            edge_i,
    input  logic [   127:0] edge_point_i,

    // verdict memory, for the faces beyond
    output logic [              (1<<BANK_BITS)-1:0] verdict_rd_en_o,
    output logic [(QW-BANK_BITS)*(1<<BANK_BITS)-1:0] verdict_rd_row_o,
    input  logic [       (VW+2)*(1<<BANK_BITS)-1:0] verdict_rd_data_i,

    // number memory {first, lower}
    output logic                                    number_wr_en_o,
    output logic [                          QW-1:0] number_wr_item_o,
    output logic [                          QW+3:0] number_wr_data_o,
    output logic [              (1<<BANK_BITS)-1:0] number_rd_en_o,
    output logic [(QW-BANK_BITS)*(1<<BANK_BITS)-1:0] number_rd_row_o,
    input  logic [       (QW+4)*(1<<BANK_BITS)-1:0] number_rd_data_i,

    // next generation's records, a half by its lower and one by its upper half-edge
    output logic [                 (1<<BANK_BITS)-1:0] lower_wr_en_o,
    output logic [   (QW-BANK_BITS)*(1<<BANK_BITS)-1:0] lower_wr_row_o,
    output logic [(2*VW+2*QW+23)*(1<<BANK_BITS)-1:0] lower_wr_data_o,
    output logic [            132*(1<<BANK_BITS)-1:0] lower_wr_sum_o,  // pass_i: S(32.0) each
    output logic [                 (1<<BANK_BITS)-1:0] upper_wr_en_o,
    output logic [   (QW-BANK_BITS)*(1<<BANK_BITS)-1:0] upper_wr_row_o,
    output logic [(2*VW+2*QW+23)*(1<<BANK_BITS)-1:0] upper_wr_data_o,
    output logic [            132*(1<<BANK_BITS)-1:0] upper_wr_sum_o,

    // new vertices: born here if all_i, else just marked as sent
    output logic          birth_o,
    output logic          sent_o,
    output logic [VW-1:0] birth_vertex_o,
    output logic [ 127:0] birth_position_o,
    output logic [   3:0] birth_sharpness_o,

    // to emit
    output logic         op_valid_o,
    input  logic         op_ready_i,
    output logic [  2:0] op_kind_o,
    output logic [ 23:0] op_number_o,
    output logic [127:0] op_position_o,
    output logic [  3:0] op_mask_o,
    output logic [  3:0] op_triangle_o,
    output logic [  3:0] op_child_o,      // slot holds a child, final in the next generation
    output logic [  3:0] op_candidate_o,
    output logic [383:0] op_vertex_o,
    output logic [  7:0] op_sides_o,
    output logic         op_first_o,
    output logic         op_last_o,

    // counters
    output logic       busy_o,
    output logic       starved_o,
    output logic       blocked_o,
    output logic       item_in_o,
    output logic       item_out_o,
    output logic [2:0] conflict_o,
    output logic fault_o
);

  localparam int unsigned HW = QW + 2;  // width of a half-edge's number

  // --- Fetch; the item's own verdict -------------------------------------------------------------
  logic fetch_valid, fetch_ready, fetch_active, fetch_rd_en;
  logic [QW-1:0] fetch_item;
  logic own_refined, own_selected;
  logic [VW-1:0] own_number;

  fetch #(
      .BITS(QW)
  ) u_fetch (
      .clk_i, .rst_i, .start_i, .count_i(pass_i ? '0 : items_i), .rd_en_o(fetch_rd_en),
      .rd_item_o(record_rd_item_o), .rd_face_o(record_rd_face_o), .valid_o(fetch_valid),
      .ready_i(fetch_ready), .last_i(record_last_i), .item_o(fetch_item),
      /* verilator lint_off PINCONNECTEMPTY */
      .face_o(),  // the face's words come with the item's
      /* verilator lint_on PINCONNECTEMPTY */
      .active_o(fetch_active)
  );

  assign record_rd_en_o = fetch_rd_en && !pass_i;
  assign own_refined = !finish_i && (all_i || own_verdict_i[VW+1]);
  assign own_selected = all_i || own_verdict_i[VW];
  // Yosys 0.23 takes a sum with a narrowing cast, where it stands in a concatenation, to be as wide as what
  // is cast: such sums have a name.
  logic [VW-1:0] pass_number;
  assign pass_number = first_new_i + VW'(pass_item_i);
  assign own_number = all_i ? first_new_i + VW'(fetch_item) : own_verdict_i[VW-1:0];

  // --- In one pass: the rest of the record waits for classify, the positions for split_write ------
  localparam int unsigned PASS = 4 * HW + 16 + 8 + 1;  // {twins, sharpness, forced, candidate}

  logic [PASS-1:0] pass_record;
  logic [4*HW-1:0] pass_twin;
  logic [15:0] pass_sharp;
  logic [7:0] pass_forced;
  logic pass_fault, positions_fault, number_fault, write_fault;
  logic pass_candidate, pass_room, pass_enters, done;
  logic [511:0] position;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(PASS),
      .DEPTH(512), .PARITY(PARITY)
  ) u_pass (
      .fault_o(pass_fault),
      .clk_i, .rst_i, .in_valid_i(pass_i && pass_take_i),
      .in_ready_o(),  // classify's fold asks to stop before
      .in_data_i({record_twin_i, record_sharp_i, record_forced_i, record_candidate_i}),
      .out_valid_o(),  // as pass_valid_i
      .out_ready_i(pass_enters), .out_data_o(pass_record), .level_o()
  );

  fifo #(
      .WIDTH(512),
      .DEPTH(8 << WINDOW_BITS), .PARITY(PARITY)
  ) u_positions (
      .fault_o(positions_fault),
      .clk_i, .rst_i, .in_valid_i(pass_enters), .in_ready_o(pass_room),
      .in_data_i(pass_position_i),
      .out_valid_o(),  // as the item at work
      .out_ready_i(pass_i && done), .out_data_o(position), .level_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign {pass_twin, pass_sharp, pass_forced, pass_candidate} = pass_record;
  assign pass_ready_o = item_ready && pass_room;
  assign pass_enters = pass_valid_i && pass_ready_o;

  // --- Gather the verdicts of the faces beyond the item's edges ----------------------------------
  // What goes along for split_write: {last, candidate, forced, selected, half, tag, sharpness, number,
  // point, origins}.
  localparam int unsigned REST = 1 + 1 + 8 + 1 + 1 + 4 + 16 + VW + 128 + 4 * VW;
  // {refined, rest, item, lanes, boundary, border, twins}
  localparam int unsigned ITEM = 1 + REST + QW + 4 + 4 + 4 + 4 * HW;

  logic [3:0] lanes;
  logic [4*QW-1:0] fetch_beyond;  // the item that a twin belongs to
  logic beyond_valid, beyond_stall, beyond_active;
  logic [ITEM-1:0] beyond;
  logic [4*(VW+2)-1:0] beyond_verdict;
  logic item_ready;
  logic [ITEM-1:0] item;

  assign fetch_ready = item_ready && !pass_i;
  assign item = pass_i ?
      {1'b1,
       {1'b1, pass_candidate, pass_forced, 1'b1, 1'b0, 4'd0, pass_sharp,
        pass_number, pass_point_i, pass_origin_i},
       pass_item_i, 4'b1111, pass_boundary_i, 4'b0000, pass_twin} :
      {own_refined,
       {record_last_i, record_candidate_i, record_forced_i, own_selected, record_half_i,
        record_tag_i, record_sharp_i, own_number, edge_i ? edge_point_i : face_point_i,
        record_origin_i},
       fetch_item, lanes, record_boundary_i, record_border_i, record_twin_i};

  assign lanes = !quads_i ? 4'b0001 : record_half_i ? 4'b0111 : 4'b1111;
  for (genvar i = 0; i < 4; i++) begin : g_beyond
    assign fetch_beyond[i*QW+:QW] =
        quads_i ? record_twin_i[i*HW+2+:QW] : record_twin_i[i*HW+:QW];
  end

  gather #(
      .ITEM_WIDTH(ITEM),
      .WIDTH(VW + 2),
      .ROW_BITS(QW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY)
  ) u_gather_verdicts (
      .clk_i, .rst_i, .stall_i(beyond_stall),
      .in_valid_i(pass_i ? pass_enters : fetch_valid), .in_ready_o(item_ready), .in_item_i(item),
      .in_mask_i(own_refined && !all_i ? lanes & ~record_border_i & ~record_boundary_i : 4'b0000),
      .in_index_i(fetch_beyond), .rd_en_o(verdict_rd_en_o), .rd_row_o(verdict_rd_row_o),
      .rd_data_i(verdict_rd_data_i), .out_valid_o(beyond_valid), .out_item_o(beyond),
      .out_data_o(beyond_verdict), .conflict_o(conflict_o[0]), .active_o(beyond_active)
  );

  // --- Number the children -----------------------------------------------------------------------
  logic beyond_refined;
  logic [REST-1:0] beyond_rest, numbered_rest;
  logic [QW-1:0] beyond_item;
  logic [3:0] beyond_lanes, beyond_boundary, beyond_border;
  logic [3:0] numbered_lanes, boundary, replaced, lower, selected_beyond;
  logic [4*HW-1:0] beyond_twin, children;
  logic [4*VW-1:0] number_beyond;
  logic numbered_valid, numbered_stall, number_active, numbered_refined;

  assign {beyond_refined, beyond_rest, beyond_item, beyond_lanes, beyond_boundary, beyond_border,
          beyond_twin} = beyond;

  split_number #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS),
      .REST(1 + 4 + 4 + REST),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .PARITY(PARITY)
  ) u_number (
      .fault_o(number_fault),
      .clk_i, .rst_i, .start_i, .quads_i, .odd_i, .all_i, .last_step_i(last_i), .first_new_i,
      .count_o(children_o), .active_o(number_active), .valid_i(beyond_valid),
      .stall_o(beyond_stall), .item_i(beyond_item), .refined_i(beyond_refined),
      .lanes_i(beyond_lanes), .boundary_i(beyond_boundary), .border_i(beyond_border),
      .twin_i(beyond_twin), .verdict_i(beyond_verdict),
      .rest_i({beyond_refined, beyond_lanes, beyond_boundary, beyond_rest}), .number_wr_en_o, .number_wr_item_o,
      .number_wr_data_o, .number_rd_en_o, .number_rd_row_o, .number_rd_data_i,
      .stall_i(numbered_stall), .valid_o(numbered_valid),
      .rest_o({numbered_refined, numbered_lanes, boundary, numbered_rest}), .replaced_o(replaced), .lower_o(lower),
      .children_o(children), .beyond_selected_o(selected_beyond),
      .beyond_number_o(number_beyond), .conflict_o(conflict_o[1])
  );

  // --- Write -------------------------------------------------------------------------------------
  logic last, candidate, selected, half, write_active;
  logic [3:0] tag;
  logic [15:0] sharp;
  logic [7:0] forced;
  logic [VW-1:0] number;
  logic [127:0] point;
  logic [4*VW-1:0] origin;

  assign {last, candidate, forced, selected, half, tag, sharp, number, point, origin} =
      numbered_rest;

  split_write #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .OPS(OPS), .PARITY(PARITY)
  ) u_write (
      .fault_o(write_fault),
      .clk_i, .rst_i, .start_i, .quads_i, .odd_i, .last_step_i(last_i), .all_i, .pass_i,
      .generation_i, .position_i(position), .lower_wr_sum_o, .upper_wr_sum_o,
      .stall_o(numbered_stall), .lanes_i(numbered_lanes), .boundary_i(boundary), .half_i(half),
      .tag_i(tag), .sharp_i(sharp),
      .active_o(write_active), .valid_i(numbered_valid), .last_i(last), .candidate_i(candidate),
      .forced_i(forced), .refined_i(numbered_refined), .selected_i(selected), .number_i(number),
      .point_i(point), .origin_i(origin), .children_i(children), .replaced_i(replaced),
      .lower_i(lower), .beyond_selected_i(selected_beyond), .beyond_number_i(number_beyond),
      .lower_wr_en_o, .lower_wr_row_o, .lower_wr_data_o, .upper_wr_en_o, .upper_wr_row_o,
      .upper_wr_data_o, .birth_o, .sent_o, .birth_vertex_o, .birth_position_o,
      .birth_sharpness_o, .op_valid_o,
      .op_ready_i, .op_kind_o, .op_number_o, .op_position_o, .op_mask_o, .op_triangle_o,
      .op_child_o, .op_candidate_o, .op_vertex_o, .op_sides_o, .op_first_o, .op_last_o,
      .item_out_o(done), .conflict_o(conflict_o[2])
  );

  // --- Counters ----------------------------------------------------------------------------------
  assign active_o = fetch_active || beyond_active || number_active || write_active;
  assign busy_o = pass_i ? pass_enters : fetch_valid && fetch_ready;
  assign blocked_o = fetch_valid && !fetch_ready;
  assign starved_o = active_o && !busy_o && !blocked_o;
  assign item_in_o = busy_o;
  assign item_out_o = done;

  assign fault_o = pass_fault || positions_fault || number_fault || write_fault;

`ifdef HS_FORMAL
`include "split.svh"
`endif

endmodule
