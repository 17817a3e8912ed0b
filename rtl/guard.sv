// SPDX-License-Identifier: Apache-2.0
//
// guard: which faces are refined, and what number each one's new vertex gets.
//
//   refined = guard: a vertex of the face is a selected face's; no guard: the face is selected;
//             all_i: always
//
//   * start_i for one cycle with items_i: corners in generation 0 (quads_i low), quads later, and
//     first_new_i, the number of the first new vertex. The settings hold until active_o falls.
//   * Refined faces' new vertices are numbered in the order of the faces; new_valid_o gives number
//     and position to the vertex memories.
//   * Every item gets a verdict in the verdict memory, {refined, selected, number}: per quad, or in
//     generation 0 per corner, so that split can look up the face beyond a twin.
//   * Vertices of a face that is not refined are set in the held memory.
//   * refined_o and sides_o count the refined faces and their sides: a boundary side twice in an odd
//     step, which makes a half-quad of it, and not at all in an even one.
//   * A new vertex on a sharp edge (new_sharpness_o) is on a crease as long as the edge was sharp.
//   * Rate: a quad, or in generation 0 a corner, a cycle; less where bank conflicts fill a window.

module guard #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19,  // width of a quad's (generation 0: a corner's) number
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8, // words a cycle
    parameter int unsigned READ_LATENCY = 1, // of a gather
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    // from the sequencer
    input  logic          start_i,
    input  logic [  QW:0] items_i,
    input  logic          quads_i,
    input  logic          odd_i,    // the step is odd
    input  logic          guard_i,
    input  logic          all_i,
    input  logic [  VW:0] first_new_i,
    output logic          active_o,
    output logic [  QW:0] refined_o,
    output logic [QW+2:0] sides_o,

    // record memory, lane 0 only in generation 0; face memory
    output logic            record_rd_en_o,
    output logic [  QW-1:0] record_rd_item_o,
    output logic [  QW-1:0] record_rd_face_o,
    input  logic [4*VW-1:0] record_origin_i,
    input  logic [     3:0] record_boundary_i,
    input  logic [     3:0] record_tag_i,
    input  logic            record_half_i,
    input  logic            record_last_i,
    input  logic            face_selected_i,
    input  logic [   127:0] face_point_i,

    // chosen memory, written by select
    output logic [              (1<<BANK_BITS)-1:0] chosen_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] chosen_rd_row_o,
    input  logic [              (1<<BANK_BITS)-1:0] chosen_rd_data_i,

    // held memory: set for the vertices of faces that stay
    output logic [              (1<<BANK_BITS)-1:0] held_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] held_wr_row_o,

    // verdict memory
    output logic          verdict_valid_o,
    output logic [QW-1:0] verdict_item_o,
    output logic [VW+1:0] verdict_o,

    // new vertices
    output logic          new_valid_o,
    output logic [VW-1:0] new_vertex_o,
    output logic [ 127:0] new_position_o,
    output logic [   3:0] new_sharpness_o,

    // counters
    output logic       busy_o,
    output logic       starved_o,
    output logic       blocked_o,
    output logic       item_in_o,
    output logic       item_out_o,
    output logic [1:0] conflict_o,
    output logic fault_o
);

  // --- Fetch and gather -----------------------------------------------------------------------------
  // {last, selected, lanes, boundary, tag, point, origins}
  localparam int unsigned ITEM = 1 + 1 + 4 + 4 + 4 + 128 + 4 * VW;

  logic [3:0] fetch_lanes;
  assign fetch_lanes = !quads_i ? 4'b0001 : record_half_i ? 4'b0111 : 4'b1111;

  logic fetch_valid, fetch_ready, fetch_active, stall;
  logic gather_valid, gather_active;
  logic [ITEM-1:0] gather_item;
  logic [3:0] gather_data;

  /* verilator lint_off PINCONNECTEMPTY */
  fetch #(
      .BITS(QW)
  ) u_fetch (
      .clk_i,
      .rst_i,
      .start_i,
      .count_i(items_i),
      .rd_en_o(record_rd_en_o),
      .rd_item_o(record_rd_item_o),
      .rd_face_o(record_rd_face_o),
      .valid_o(fetch_valid),
      .ready_i(fetch_ready),
      .last_i(record_last_i),
      .item_o(),  // items are counted where their verdicts come out
      .face_o(),
      .active_o(fetch_active)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  gather #(
      .ITEM_WIDTH(ITEM),
      .WIDTH(1),
      .ROW_BITS(VW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY)
  ) u_gather (
      .clk_i,
      .rst_i,
      .stall_i(stall),
      .in_valid_i(fetch_valid),
      .in_ready_o(fetch_ready),
      .in_item_i({
        record_last_i, face_selected_i, fetch_lanes, record_boundary_i, record_tag_i, face_point_i,
        record_origin_i
      }),
      .in_mask_i(fetch_lanes),
      .in_index_i(record_origin_i),
      .rd_en_o(chosen_rd_en_o),
      .rd_row_o(chosen_rd_row_o),
      .rd_data_i(chosen_rd_data_i),
      .out_valid_o(gather_valid),
      .out_item_o(gather_item),
      .out_data_o(gather_data),
      .conflict_o(conflict_o[0]),
      .active_o(gather_active)
  );

  // --- The verdict, and the number of the new vertex ----------------------------------------------------
  logic touches, touches_q, first_q;  // a vertex is a selected face's; _q: of the corners so far
  logic last, selected, refined;
  logic [3:0] lanes, boundary, tag;
  logic [8:0] sides, sides_before_q;  // of the face so far; _q: generation 0: without this corner
  logic [VW:0] number_q;
  logic [QW:0] refined_q;
  logic [QW+2:0] sides_q;

  assign {last, selected, lanes, boundary, tag} = gather_item[ITEM-1:ITEM-14];

  always_comb begin
    touches = !first_q && touches_q;
    for (int i = 0; i < 4; i++)
      if (lanes[i]) touches = touches || gather_data[i];
    sides = first_q ? 9'd0 : sides_before_q;
    for (int i = 0; i < 4; i++)
      if (lanes[i]) sides = sides + (!boundary[i] ? 9'd1 : odd_i ? 9'd2 : 9'd0);
  end
  assign refined = all_i || (guard_i ? touches : selected);

  always_ff @(posedge clk_i) begin
    if (gather_valid) begin
      first_q   <= last;
      touches_q <= touches;
      sides_before_q <= sides;
      if (last && refined) begin
        number_q <= number_q + (VW + 1)'(1);
        refined_q <= refined_q + (QW + 1)'(1);
        sides_q <= sides_q + (QW + 3)'(sides);
      end
    end
    if (start_i) begin
      first_q   <= 1'b1;
      number_q  <= first_new_i;
      refined_q <= '0;
      sides_q   <= '0;
    end
  end
  assign refined_o = refined_q;
  assign sides_o = sides_q;

  // A number beyond the memory is not written: the sequencer stops the refinement anyway.
  assign new_valid_o = gather_valid && last && refined && !number_q[VW];
  assign new_vertex_o = number_q[VW-1:0];
  assign new_position_o = gather_item[4*VW+:128];
  assign new_sharpness_o = odd_i ? 4'd0 : tag;

  // --- Fold: every item with its face's verdict -----------------------------------------------------------
  localparam int unsigned RESULT = 2 + VW;  // {refined, selected, number}

  logic fold_valid, fold_ready, fold_active, scatter_active;
  logic [4*VW-1:0] fold_origin;
  logic [3:0] fold_lanes;
  logic [RESULT-1:0] fold_result;

  /* verilator lint_off PINCONNECTEMPTY */
  fold #(
      .ITEM_WIDTH(4 + 4 * VW),
      .RESULT_WIDTH(RESULT),
      .MARGIN((1 << WINDOW_BITS) + 24), .PARITY(PARITY)
  ) u_fold (
      .fault_o(fault_o),
      .clk_i,
      .rst_i,
      .stall_o(stall),
      .item_valid_i(gather_valid),
      .item_last_i(last),
      .item_i({lanes, gather_item[4*VW-1:0]}),
      .result_valid_i(gather_valid && last),
      .result_i({refined, selected || all_i, number_q[VW-1:0]}),
      .out_valid_o(fold_valid),
      .out_ready_i(fold_ready),
      .out_last_o(),
      .out_item_o({fold_lanes, fold_origin}),
      .out_result_o(fold_result),
      .active_o(fold_active)
  );

  scatter #(
      .WIDTH(1),
      .ROW_BITS(VW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_scatter (
      .clk_i,
      .rst_i,
      .in_valid_i(fold_valid),
      .in_ready_o(fold_ready),
      .in_mask_i(fold_result[RESULT-1] ? 4'b0000 : fold_lanes),
      .in_index_i(fold_origin),
      .in_data_i(4'd0),
      .en_o(held_wr_en_o),
      .row_o(held_wr_row_o),
      .data_o(),  // set
      .conflict_o(conflict_o[1]),
      .active_o(scatter_active)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  logic [QW-1:0] item_q;

  always_ff @(posedge clk_i) begin
    if (start_i) item_q <= '0;
    else if (verdict_valid_o) item_q <= item_q + QW'(1);
  end
  assign verdict_valid_o = fold_valid && fold_ready;
  assign verdict_item_o = item_q;
  assign verdict_o = fold_result;

  // --- Counters --------------------------------------------------------------------------------------
  assign active_o = fetch_active || gather_active || fold_active || scatter_active;
  assign busy_o = fetch_valid && fetch_ready;
  assign blocked_o = fetch_valid && !fetch_ready;
  assign starved_o = active_o && !fetch_valid;
  assign item_in_o = busy_o;
  assign item_out_o = verdict_valid_o;

`ifdef HS_FORMAL
`include "activity.svh"
`endif

endmodule
