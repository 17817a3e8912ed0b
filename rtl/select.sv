// SPDX-License-Identifier: Apache-2.0
//
// select: which active faces the view wants refined; it names their vertices as chosen.
//
//   selected = candidate and (wanted or g < forced)
//   wanted   = in_view and not stop and (front and g < front_depth
//                                        or a silhouette vertex and g < silhouette_depth)
//
//   * start_i for one cycle with items_i: corners in generation 0 (quads_i low), quads later. The
//     settings hold until active_o falls.
//   * Each face's verdict goes to the face memory (selected_valid_o); the vertices of selected faces
//     are set in the chosen memory. any_o: there are selected faces.
//   * Rate: a quad, or in generation 0 a corner, a cycle; less where bank conflicts fill a window.

module select #(
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
    input  logic        start_i,
    input  logic [QW:0] items_i,
    input  logic        quads_i,
    input  logic [ 7:0] generation_i,
    input  logic [ 7:0] front_depth_i,
    input  logic [ 7:0] silhouette_depth_i,
    output logic        active_o,
    output logic any_o,

    // record memory, lane 0 only in generation 0, lanes 0 to 2 of a half-quad; face memory
    output logic            record_rd_en_o,
    output logic [  QW-1:0] record_rd_item_o,
    output logic [  QW-1:0] record_rd_face_o,
    input  logic [4*VW-1:0] record_origin_i,
    input  logic            record_half_i,
    input  logic            record_candidate_i,
    input  logic [     7:0] record_forced_i,
    input  logic            record_last_i,
    input  logic            face_front_i,
    input  logic            face_stop_i,

    // mark memory: {tag, sent, border, hits, back, front}
    output logic [              (1<<BANK_BITS)-1:0] mark_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_rd_row_o,
    input  logic [           13*(1<<BANK_BITS)-1:0] mark_rd_data_i,

    // chosen memory: set for the vertices of selected faces
    output logic [              (1<<BANK_BITS)-1:0] chosen_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] chosen_wr_row_o,

    // face memory
    output logic          selected_valid_o,
    output logic [QW-1:0] selected_face_o,
    output logic          selected_verdict_o,

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
  // {last, wanted if in view, wanted if silhouette and in view, selected anyway, candidate, half,
  // origins}: what the face itself decides is decided here.
  localparam int unsigned ITEM = 1 + 5 + 4 * VW;

  function automatic logic [3:0] lanes_of(input logic quads, input logic half);
    lanes_of = !quads ? 4'b0001 : half ? 4'b0111 : 4'b1111;
  endfunction

  logic fetch_valid, fetch_ready, fetch_active, stall;
  logic gather_valid, gather_active;
  logic [ITEM-1:0] gather_item;
  logic [4*13-1:0] gather_data;

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
      .item_o(),  // faces are counted where their verdicts come out
      .face_o(),
      .active_o(fetch_active)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  gather #(
      .ITEM_WIDTH(ITEM),
      .WIDTH(13),
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
        record_last_i,
        !face_stop_i && face_front_i && generation_i < front_depth_i,
        !face_stop_i && generation_i < silhouette_depth_i,
        generation_i < record_forced_i,
        record_candidate_i,
        record_half_i,
        record_origin_i
      }),
      .in_mask_i(lanes_of(quads_i, record_half_i)),
      .in_index_i(record_origin_i),
      .rd_en_o(mark_rd_en_o),
      .rd_row_o(mark_rd_row_o),
      .rd_data_i(mark_rd_data_i),
      .out_valid_o(gather_valid),
      .out_item_o(gather_item),
      .out_data_o(gather_data),
      .conflict_o(conflict_o[0]),
      .active_o(gather_active)
  );

  // --- The verdict ------------------------------------------------------------------------------------
  logic in_view, silhouette, in_view_q, silhouette_q, first_q;  // _q: of an n-gon's corners so far
  logic last, by_front, by_silhouette, by_force, candidate, half, verdict;
  logic [3:0] lanes;

  assign {last, by_front, by_silhouette, by_force, candidate, half} = gather_item[ITEM-1:4*VW];
  assign lanes = lanes_of(quads_i, half);

  always_comb begin
    in_view = !first_q && in_view_q;
    silhouette = !first_q && silhouette_q;
    for (int i = 0; i < 4; i++)
      if (lanes[i]) begin
        in_view = in_view || gather_data[i*13+2];
        silhouette = silhouette || gather_data[i*13+:2] == 2'b11;
      end
  end
  assign verdict = candidate &&
      (by_force || (in_view && (by_front || (by_silhouette && silhouette))));

  logic [QW-1:0] face_q;
  logic any_q;

  always_ff @(posedge clk_i) begin
    if (gather_valid) begin
      first_q <= last;
      in_view_q <= in_view;
      silhouette_q <= silhouette;
      if (last) begin
        face_q <= face_q + QW'(1);
        any_q <= any_q || verdict;
      end
    end
    if (start_i) begin
      first_q <= 1'b1;
      face_q <= '0;
      any_q <= 1'b0;
    end
  end
  assign selected_valid_o = gather_valid && last;
  assign selected_face_o = face_q;
  assign selected_verdict_o = verdict;
  assign any_o = any_q;

  // --- Fold: the corners of selected faces are chosen ---------------------------------------------------
  logic fold_valid, fold_ready, fold_active, fold_verdict, fold_half, scatter_active;
  logic [4*VW-1:0] fold_origin;

  /* verilator lint_off PINCONNECTEMPTY */
  fold #(
      .ITEM_WIDTH(4 * VW + 1),
      .RESULT_WIDTH(1),
      .MARGIN((1 << WINDOW_BITS) + 24), .PARITY(PARITY)
  ) u_fold (
      .fault_o(fault_o),
      .clk_i,
      .rst_i,
      .stall_o(stall),
      .item_valid_i(gather_valid),
      .item_last_i(last),
      .item_i(gather_item[4*VW:0]),
      .result_valid_i(selected_valid_o),
      .result_i(verdict),
      .out_valid_o(fold_valid),
      .out_ready_i(fold_ready),
      .out_last_o(),
      .out_item_o({fold_half, fold_origin}),
      .out_result_o(fold_verdict),
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
      .in_mask_i(fold_verdict ? lanes_of(quads_i, fold_half) : 4'b0000),
      .in_index_i(fold_origin),
      .in_data_i(4'd0),
      .en_o(chosen_wr_en_o),
      .row_o(chosen_wr_row_o),
      .data_o(),  // set
      .conflict_o(conflict_o[1]),
      .active_o(scatter_active)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // --- Counters --------------------------------------------------------------------------------------
  assign active_o = fetch_active || gather_active || fold_active || scatter_active;
  assign busy_o = fetch_valid && fetch_ready;
  assign blocked_o = fetch_valid && !fetch_ready;
  assign starved_o = active_o && !fetch_valid;
  assign item_in_o = busy_o;
  assign item_out_o = fold_valid && fold_ready;

`ifdef HS_FORMAL
`include "activity.svh"
`endif

endmodule
