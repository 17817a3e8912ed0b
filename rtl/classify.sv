// SPDX-License-Identifier: Apache-2.0
//
// classify: reads the positions of every active face; leaves its marks and its new vertex's
// position, and adds to its vertices' sums and marks.
//
//   fetch --> gather --> masks --> face_geometry: sums, --> contributions --> accumulate, ring
//   records   positions            determinants, division   of its corners    into its vertices
//
//   * start_i for one cycle with items_i: corners in generation 0 (quads_i low), quads later. The
//     settings hold until active_o falls.
//   * New vertex: odd_i, the face point, RNE(sum of positions / n); else the inherited edge point,
//     which is the average of the quad's corners where they stood before the last odd step (the
//     "old" positions), or the middle of the edge, corners 0 and 2, if that is sharp or was on the
//     boundary. point_valid_o gives it for one cycle, face by face, with the face's front and stop.
//   * Vertices: marks always; T and the valence if odd_i; with limit_i rings always.
//   * Rate: a quad, or in generation 0 a corner, a cycle; less where bank conflicts fill a window.
//   * valence_error_o: a vertex got its 256th corner, at corner valence_corner_o; the first counts.

module classify #(
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
    input  logic        odd_i,
    input  logic [ 7:0] generation_i,
    output logic        active_o,

    // the view's settings
    input logic        limit_i,         // limit positions
    input logic        corners_stay_i,  // the boundary mode is smooth
    input logic [15:0] min_edge_i,
    input logic [15:0] width_i,
    input logic [15:0] height_i,

    // record memory: the item's vertices, whether its edges have no active face beyond, are on the
    // surface's boundary, and how sharp; whether it ends its face; lane 0 only in generation 0
    output logic            record_rd_en_o,
    output logic [  QW-1:0] record_rd_item_o,
    input  logic [4*VW-1:0] record_origin_i,
    input  logic [     3:0] record_border_i,
    input  logic [     3:0] record_boundary_i,
    input  logic [    15:0] record_sharp_i,  // even generations
    input  logic [     3:0] record_tag_i,    // odd generations: of the edge that the quad came from
    input  logic            record_half_i,   // a half-quad: lane 3 is void
    input  logic            record_last_i,

    // position and sharp memories, and the old positions in the sum memory, bank by bank
    // {sharp, old, position}
    output logic [              (1<<BANK_BITS)-1:0] position_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] position_rd_row_o,
    input  logic [          274*(1<<BANK_BITS)-1:0] position_rd_data_i,

    // mark and sum memories: see accumulate; ring memory: see ring
    output logic [              (1<<BANK_BITS)-1:0] mark_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_rd_row_o,
    input  logic [           13*(1<<BANK_BITS)-1:0] mark_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] mark_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_wr_row_o,
    output logic [           13*(1<<BANK_BITS)-1:0] mark_wr_data_o,
    output logic [              (1<<BANK_BITS)-1:0] sum_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] sum_rd_row_o,
    input  logic [          168*(1<<BANK_BITS)-1:0] sum_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] sum_void_o,    // what is read is not used
    output logic [              (1<<BANK_BITS)-1:0] sum_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] sum_wr_row_o,
    output logic [          168*(1<<BANK_BITS)-1:0] sum_wr_data_o,
    output logic [              (1<<BANK_BITS)-1:0] ring_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] ring_rd_row_o,
    input  logic [          177*(1<<BANK_BITS)-1:0] ring_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] ring_void_o,
    output logic [              (1<<BANK_BITS)-1:0] ring_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] ring_wr_row_o,
    output logic [          177*(1<<BANK_BITS)-1:0] ring_wr_data_o,

    // split, which takes the items along in a run that needs no decisions (pass_i): an item goes on
    // in a cycle with pass_valid_o and pass_ready_i
    input  logic            pass_i,
    output logic            pass_valid_o,
    input  logic            pass_ready_i,
    output logic [  QW-1:0] pass_item_o,
    output logic [4*VW-1:0] pass_origin_o,
    output logic [   511:0] pass_position_o,
    output logic [   127:0] pass_point_o,
    output logic [     3:0] pass_boundary_o,

    // face memory
    output logic          point_valid_o,
    output logic [QW-1:0] point_face_o,
    output logic [ 127:0] point_o,
    output logic          front_o,
    output logic          stop_o,

    output logic          valence_error_o,
    output logic [QW-1:0] valence_corner_o,

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
  // {last, half, tag, sharp, boundary, border, origins}
  localparam int unsigned RECORD = 1 + 1 + 4 + 16 + 4 + 4 + 4 * VW;

  logic fetch_valid, fetch_ready, fetch_active, stall;
  logic gather_valid, gather_active;
  logic [RECORD-1:0] gather_item;
  logic [4*274-1:0] gather_data;

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
      .rd_face_o(),  // items and faces are counted where they come out
      .valid_o(fetch_valid),
      .ready_i(fetch_ready),
      .last_i(record_last_i),
      .item_o(),
      .face_o(),
      .active_o(fetch_active)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  gather #(
      .ITEM_WIDTH(RECORD),
      .WIDTH(274),
      .ROW_BITS(VW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY)
  ) u_gather (
      .clk_i, .rst_i, .stall_i(stall), .in_valid_i(fetch_valid), .in_ready_o(fetch_ready),
      .in_item_i({
        record_last_i, record_half_i, record_tag_i, record_sharp_i, record_boundary_i,
        record_border_i, record_origin_i
      }),
      .in_mask_i(!quads_i ? 4'b0001 : record_half_i ? 4'b0111 : 4'b1111),
      .in_index_i(record_origin_i), .rd_en_o(position_rd_en_o), .rd_row_o(position_rd_row_o),
      .rd_data_i(position_rd_data_i), .out_valid_o(gather_valid), .out_item_o(gather_item),
      .out_data_o(gather_data), .conflict_o(conflict_o[0]), .active_o(gather_active)
  );

  // --- The item: which masks its corners and its new vertex have --------------------------------
  logic valid_q, last_q, half_q, tag;
  logic [3:0] border_q, boundary_q, sharp, crease;
  logic [4*VW-1:0] origin_q;
  logic [511:0] position, source;

  logic gather_last, gather_half;
  logic [3:0] gather_tag, gather_boundary, gather_border;
  logic [15:0] gather_sharp;
  logic [4*VW-1:0] gather_origin;

  assign {gather_last, gather_half, gather_tag, gather_sharp, gather_boundary, gather_border,
          gather_origin} = gather_item;

  always_ff @(posedge clk_i) begin
    valid_q <= gather_valid;
    if (gather_valid) begin
      last_q <= gather_last;
      half_q <= gather_half;
      border_q <= gather_border;
      boundary_q <= gather_boundary;
      origin_q <= gather_origin;
    end
    if (rst_i) valid_q <= 1'b0;
  end

  masks u_masks (
      .clk_i, .odd_i, .generation_i, .corners_stay_i, .valid_i(gather_valid), .half_i(gather_half),
      .boundary_i(gather_boundary), .sharp_i(gather_sharp), .tag_i(gather_tag),
      .vertex_i(gather_data), .position_o(position), .source_o(source), .crease_o(crease),
      .sharp_o(sharp), .tag_o(tag)
  );

  // --- The face: marks and point --------------------------------------------------------------------
  logic face_valid, face_front, face_back, face_hits, face_nonquad, face_last_border;
  logic [127:0] face_point, face_last_position;
  logic [159:0] face_sum;

  face_geometry u_geometry (
      .clk_i, .rst_i, .quads_i, .valid_i(valid_q), .last_i(last_q), .half_i(half_q),
      .border_i(border_q[0]), .position_i(position), .source_i(source), .min_edge_i, .width_i,
      .height_i, .valid_o(face_valid), .point_o(face_point), .front_o(face_front),
      .back_o(face_back), .hits_o(face_hits), .stop_o, .sum_o(face_sum), .nonquad_o(face_nonquad),
      .last_position_o(face_last_position), .last_border_o(face_last_border)
  );

  logic [QW-1:0] face_q;

  always_ff @(posedge clk_i) begin
    if (start_i) face_q <= '0;
    else if (face_valid) face_q <= face_q + QW'(1);
  end
  assign point_valid_o = face_valid;
  assign point_face_o = face_q;
  assign point_o = face_point;
  assign front_o = face_front;

  // --- What it contributes to its vertices --------------------------------------------------------
  logic give, take, give_nonquad, contributions_active;
  logic [3:0] give_mask;
  logic [4*VW-1:0] give_index;
  logic [15:0] give_marks;
  logic [4*132-1:0] give_addend;
  logic [4*136-1:0] give_ring;
  logic [QW-1:0] give_corner;

  contributions #(
      .VW(VW),
      .QW(QW),
      .WINDOW_BITS(WINDOW_BITS), .PARITY(PARITY)
  ) u_contributions (
      .fault_o(fault_o),
      .clk_i, .rst_i, .start_i, .quads_i, .odd_i, .limit_i, .stall_o(stall),
      .active_o(contributions_active), .item_valid_i(valid_q), .item_last_i(last_q),
      .item_origin_i(origin_q), .item_position_i(position), .item_border_i(border_q),
      .item_boundary_i(boundary_q), .item_sharp_i(sharp), .item_crease_i(crease), .item_tag_i(tag),
      .item_half_i(half_q), .result_valid_i(face_valid), .result_point_i(face_point),
      .result_marks_i({face_hits, face_back, face_front}),
      .result_last_position_i(face_last_position), .result_last_border_i(face_last_border),
      .result_sum_i(face_sum), .result_nonquad_i(face_nonquad), .out_valid_o(give),
      .out_ready_i(take && pass_ready), .out_mask_o(give_mask), .out_index_o(give_index),
      .out_marks_o(give_marks), .out_addend_o(give_addend), .out_ring_o(give_ring),
      .out_nonquad_o(give_nonquad), .out_corner_o(give_corner),
      .out_position_o(pass_position_o), .out_point_o(pass_point_o),
      .out_boundary_o(pass_boundary_o), .item_out_o
  );

  // Both that take the item take it in the same cycle.
  logic pass_ready;

  assign pass_ready = !pass_i || pass_ready_i;
  assign pass_valid_o = pass_i && give && take;
  assign pass_item_o = give_corner;
  assign pass_origin_o = give_index;

  logic [(1<<BANK_BITS)-1:0] update, touched;
  logic accumulate_active;

  accumulate #(
      .VW(VW),
      .BANK_BITS(BANK_BITS),
      .TAG_WIDTH(QW),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_accumulate (
      .clk_i, .rst_i, .generation_i, .sum_i(odd_i), .in_valid_i(give && pass_ready), .in_ready_o(take),
      .in_mask_i(give_mask), .in_index_i(give_index), .in_marks_i(give_marks),
      .in_addend_i(give_addend), .in_tag_i(give_corner), .mark_rd_en_o, .mark_rd_row_o,
      .mark_rd_data_i, .mark_wr_en_o, .mark_wr_row_o, .mark_wr_data_o, .sum_rd_en_o, .sum_rd_row_o,
      .sum_rd_data_i, .sum_void_o, .sum_wr_en_o, .sum_wr_row_o, .sum_wr_data_o, .update_o(update),
      .touched_o(touched), .full_o(valence_error_o), .full_item_o(valence_corner_o),
      .conflict_o(conflict_o[1]), .active_o(accumulate_active)
  );

  ring #(
      .VW(VW),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_ring (
      .clk_i, .rst_i, .in_valid_i(give && take && pass_ready && limit_i), .in_mask_i(give_mask),
      .in_index_i(give_index), .in_addend_i(give_ring), .in_nonquad_i(give_nonquad),
      .update_i(update), .touched_i(touched), .ring_rd_en_o, .ring_rd_row_o, .ring_rd_data_i, .ring_void_o,
      .ring_wr_en_o, .ring_wr_row_o, .ring_wr_data_o
  );

  // --- Counters --------------------------------------------------------------------------------------
  assign active_o = fetch_active || gather_active || valid_q || contributions_active ||
      accumulate_active;
  assign busy_o = fetch_valid && fetch_ready;
  assign blocked_o = fetch_valid && !fetch_ready;
  assign starved_o = active_o && !fetch_valid;
  assign item_in_o = busy_o;

`ifdef HS_FORMAL
`include "activity.svh"
`endif

endmodule
