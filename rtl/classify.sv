// SPDX-License-Identifier: Apache-2.0
//
// classify: reads the positions of every active face; leaves its marks and its new vertex's
// position, and adds to its vertices' sums and marks.
//
//   fetch --> gather --> sums, determinants, division --> fold --> accumulate
//   records   positions  of the face                      items    into its vertices
//
//   * start_i for one cycle with items_i: corners in generation 0 (quads_i low), quads later. The
//     settings hold until active_o falls.
//   * New vertex: odd_i, the face point, RNE(sum of positions / n); else the inherited edge point,
//     which is the average of the quad's corners where they stood before the last odd step (the
//     "old" positions). point_valid_o gives it for one cycle, face by face, with the face's front.
//   * Vertices: marks always; T, the sum of w + F around a vertex, and the valence if odd_i. The
//     face's contribution to v is F and v's neighbour on the way in, where the formula takes the
//     one on the way out: around a closed vertex the two sums are the same, and no other moves.
//   * Rate: a quad, or in generation 0 a corner, a cycle, and a cycle more for each bank conflict.
//   * valence_error_o: a vertex got its 256th corner, at corner valence_corner_o; the first counts.

module classify #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19,  // width of a quad's (generation 0: a corner's) number
    parameter int unsigned BANK_BITS = 3
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

    // record memory: the item's vertices, whether its edges have no active face beyond, and whether
    // it ends its face; lane 0 only in generation 0
    output logic            record_rd_en_o,
    output logic [  QW-1:0] record_rd_item_o,
    input  logic [4*VW-1:0] record_origin_i,
    input  logic [     3:0] record_border_i,
    input  logic            record_last_i,

    // position memory, and the old positions in the sum memory, bank by bank {old, position}
    output logic [              (1<<BANK_BITS)-1:0] position_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] position_rd_row_o,
    input  logic [          256*(1<<BANK_BITS)-1:0] position_rd_data_i,

    // mark and sum memories: see accumulate
    output logic [              (1<<BANK_BITS)-1:0] mark_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_rd_row_o,
    input  logic [           13*(1<<BANK_BITS)-1:0] mark_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] mark_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_wr_row_o,
    output logic [           13*(1<<BANK_BITS)-1:0] mark_wr_data_o,
    output logic [              (1<<BANK_BITS)-1:0] sum_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] sum_rd_row_o,
    input  logic [          168*(1<<BANK_BITS)-1:0] sum_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] sum_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] sum_wr_row_o,
    output logic [          168*(1<<BANK_BITS)-1:0] sum_wr_data_o,

    // face memory
    output logic          point_valid_o,
    output logic [QW-1:0] point_face_o,
    output logic [ 127:0] point_o,
    output logic          front_o,

    output logic          valence_error_o,
    output logic [QW-1:0] valence_corner_o,

    // counters
    output logic       busy_o,
    output logic       starved_o,
    output logic       blocked_o,
    output logic       item_in_o,
    output logic       item_out_o,
    output logic [1:0] conflict_o
);

  // --- Fetch and gather -----------------------------------------------------------------------------
  localparam int unsigned RECORD = 1 + 4 + 4 * VW;  // {last, border, origins}

  logic fetch_valid, fetch_ready, fetch_active, stall;
  logic gather_valid, gather_active;
  logic [RECORD-1:0] gather_item;
  logic [4*256-1:0] gather_data;

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
      .WIDTH(256),
      .ROW_BITS(VW - BANK_BITS),
      .BANK_BITS(BANK_BITS)
  ) u_gather (
      .clk_i,
      .rst_i,
      .stall_i(stall),
      .in_valid_i(fetch_valid),
      .in_ready_o(fetch_ready),
      .in_item_i({record_last_i, record_border_i, record_origin_i}),
      .in_mask_i(quads_i ? 4'b1111 : 4'b0001),
      .in_index_i(record_origin_i),
      .rd_en_o(position_rd_en_o),
      .rd_row_o(position_rd_row_o),
      .rd_data_i(position_rd_data_i),
      .out_valid_o(gather_valid),
      .out_item_o(gather_item),
      .out_data_o(gather_data),
      .conflict_o(conflict_o[0]),
      .active_o(gather_active)
  );

  // --- The face: marks and point ----------------------------------------------------------------------
  logic valid_q;
  logic [RECORD-1:0] item_q;
  logic [511:0] position_q;  // of the four lanes
  logic [511:0] source_q;    // what the new vertex is the average of

  always_ff @(posedge clk_i) begin
    valid_q <= gather_valid;
    if (gather_valid) begin
      item_q <= gather_item;
      for (int i = 0; i < 4; i++) begin
        position_q[i*128+:128] <= gather_data[i*256+:128];
        source_q[i*128+:128] <= odd_i ? gather_data[i*256+:128] : gather_data[i*256+128+:128];
      end
    end
    if (rst_i) valid_q <= 1'b0;
  end

  logic face_valid, face_front, face_back, face_hits, face_last_border;
  logic [127:0] face_point, face_last_position;

  face_geometry u_geometry (
      .clk_i,
      .rst_i,
      .quads_i,
      .valid_i(valid_q),
      .last_i(item_q[RECORD-1]),
      .border_i(item_q[4*VW]),
      .position_i(position_q),
      .source_i(source_q),
      .valid_o(face_valid),
      .point_o(face_point),
      .front_o(face_front),
      .back_o(face_back),
      .hits_o(face_hits),
      .last_position_o(face_last_position),
      .last_border_o(face_last_border)
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

  // --- Fold: every corner with its face's marks and point ---------------------------------------------
  localparam int unsigned RESULT = 1 + 128 + 3 + 128;
  localparam int unsigned ITEM = RECORD - 1 + 512;

  logic fold_valid, fold_ready, fold_last, fold_active;
  logic [ITEM-1:0] fold_item;
  logic [RESULT-1:0] fold_result;

  fold #(
      .ITEM_WIDTH(ITEM),
      .RESULT_WIDTH(RESULT)
  ) u_fold (
      .clk_i,
      .rst_i,
      .stall_o(stall),
      .item_valid_i(valid_q),
      .item_last_i(item_q[RECORD-1]),
      .item_i({position_q, item_q[RECORD-2:0]}),
      .result_valid_i(face_valid),
      .result_i({
        face_last_border, face_last_position, face_hits, face_back, face_front, face_point
      }),
      .out_valid_o(fold_valid),
      .out_ready_i(fold_ready),
      .out_last_o(fold_last),
      .out_item_o(fold_item),
      .out_result_o(fold_result),
      .active_o(fold_active)
  );

  // --- Contributions to the vertices --------------------------------------------------------------------
  logic first_q, previous_border_q;  // generation 0: at a face's first corner; the corner before
  logic [127:0] previous_q;
  logic [QW-1:0] corner_q;
  logic [15:0] lane_marks;
  logic [4*132-1:0] addend;
  logic [511:0] position;
  logic [3:0] border;
  logic [127:0] prior_0;
  logic prior_border_0, take;

  assign position = fold_item[4*VW+4+:512];
  assign border = fold_item[4*VW+:4];
  assign prior_0 = quads_i ? position[3*128+:128] : first_q ? fold_result[131+:128] : previous_q;
  assign prior_border_0 = quads_i ? border[3] : first_q ? fold_result[259] : previous_border_q;
  assign take = fold_valid && fold_ready;

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic [127:0] prior;
      logic prior_border;
      prior = i == 0 ? prior_0 : position[((i+3)%4)*128+:128];
      prior_border = i == 0 ? prior_border_0 : border[(i+3)%4];
      lane_marks[i*4+:4] = {border[i] || prior_border, fold_result[130:128]};
      for (int k = 0; k < 4; k++)
        addend[i*132+k*33+:33] = {prior[k*32+31], prior[k*32+:32]} +
            {fold_result[k*32+31], fold_result[k*32+:32]};
    end
  end

  always_ff @(posedge clk_i) begin
    if (take) begin
      first_q <= fold_last;
      previous_q <= position[127:0];
      previous_border_q <= border[0];
      corner_q <= corner_q + QW'(1);
    end
    if (start_i) begin
      first_q  <= 1'b1;
      corner_q <= '0;
    end
  end

  logic accumulate_active;

  accumulate #(
      .VW(VW),
      .BANK_BITS(BANK_BITS),
      .TAG_WIDTH(QW)
  ) u_accumulate (
      .clk_i,
      .rst_i,
      .generation_i,
      .sum_i(odd_i),
      .in_valid_i(fold_valid),
      .in_ready_o(fold_ready),
      .in_mask_i(quads_i ? 4'b1111 : 4'b0001),
      .in_index_i(fold_item[4*VW-1:0]),
      .in_marks_i(lane_marks),
      .in_addend_i(addend),
      .in_tag_i(corner_q),
      .mark_rd_en_o,
      .mark_rd_row_o,
      .mark_rd_data_i,
      .mark_wr_en_o,
      .mark_wr_row_o,
      .mark_wr_data_o,
      .sum_rd_en_o,
      .sum_rd_row_o,
      .sum_rd_data_i,
      .sum_wr_en_o,
      .sum_wr_row_o,
      .sum_wr_data_o,
      .full_o(valence_error_o),
      .full_item_o(valence_corner_o),
      .conflict_o(conflict_o[1]),
      .active_o(accumulate_active)
  );

  // --- Counters --------------------------------------------------------------------------------------
  assign active_o = fetch_active || gather_active || valid_q || fold_active || accumulate_active;
  assign busy_o = fetch_valid && fetch_ready;
  assign blocked_o = fetch_valid && !fetch_ready;
  assign starved_o = active_o && !fetch_valid;
  assign item_in_o = busy_o;
  assign item_out_o = take;

endmodule
