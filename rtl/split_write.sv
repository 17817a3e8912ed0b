// SPDX-License-Identifier: Apache-2.0
//
// split_write: the last part of split. It writes the child halves of an item's edges into the next
// generation's records, and lets split_faces send the faces that are final.
//
//                                                    +--> scatter: lower halves, upper halves
//   items --> fold --> the item with its neighbours -+
//                                                    +--> split_faces --> emit
//
//   * In: an item with valid_i, as split_number tells it; fold's MARGIN is how many may still come
//     when stall_o goes high. children_i: per edge that is replaced, the half-edge of the next step
//     at which its children begin: 4 quad + 0 for the lower half-edge, + 2 for the upper.
//   * What a half is stands in record_memory. The twin of c0(h) is c1(next(h)), that of c1(h) is c0(prev(h)): so next
//     and prev must be known, which in generation 0 takes the whole face: its items are folded.
//   * An item is done when its halves are written and split_faces has sent what is final of it.

module split_write #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19,
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8, // words a cycle
    parameter int unsigned OPS = 16, // that wait for emit
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    input  logic start_i,
    input  logic quads_i,
    input  logic odd_i,
    input  logic last_step_i,
    input  logic all_i,
    output logic stall_o,
    output logic active_o,

    // items
    input logic                valid_i,
    input logic                last_i,
    input logic                candidate_i,
    input logic [         7:0] forced_i,
    input logic                refined_i,
    input logic                selected_i,
    input logic [         3:0] lanes_i,
    input logic [         3:0] boundary_i,
    input logic                half_i,      // a half-quad: lane 2 is its boundary edge, 3 is void
    input logic [         3:0] tag_i,       // of a quad of an odd generation
    input logic [        15:0] sharp_i,     // of the lanes, in even generations
    input logic [      VW-1:0] number_i,
    input logic [       127:0] point_i,
    input logic [    4*VW-1:0] origin_i,
    input logic [4*(QW+2)-1:0] children_i,
    input logic [         3:0] replaced_i,
    input logic [         3:0] lower_i,
    input logic [         3:0] beyond_selected_i,
    input logic [    4*VW-1:0] beyond_number_i,

    // in one pass with classify: the positions of the item at work
    input logic         pass_i,
    input logic [  7:0] generation_i,
    input logic [511:0] position_i,

    // next generation's records
    output logic [                 (1<<BANK_BITS)-1:0] lower_wr_en_o,
    output logic [   (QW-BANK_BITS)*(1<<BANK_BITS)-1:0] lower_wr_row_o,
    output logic [(2*VW+2*QW+23)*(1<<BANK_BITS)-1:0] lower_wr_data_o,
    output logic [            132*(1<<BANK_BITS)-1:0] lower_wr_sum_o,
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
    output logic [  3:0] op_child_o,
    output logic [  3:0] op_candidate_o,
    output logic [383:0] op_vertex_o,
    output logic [  7:0] op_sides_o,
    output logic         op_first_o,
    output logic         op_last_o,

    output logic item_out_o,
    output logic conflict_o,
    output logic fault_o
);

  localparam int unsigned HW = QW + 2;
  localparam int unsigned HALF = 2 * VW + 2 * HW + 19;

  // --- Fold: in generation 0 the first corner needs the last one's children ----------------------
  localparam int unsigned ITEM = 16 + 4 + 1 + 4 + 4 + 4 * VW + 4 + 4 + 4 + 4 * HW + 4 * VW + 128 +
      VW + 1 + 1 + 8 + 1;
  localparam int unsigned RESULT = 8 + 1 + HW;  // {sides, last edge replaced, its children}

  logic fold_valid, fold_ready, fold_last, fold_active;
  logic [ITEM-1:0] fold_item;
  logic [RESULT-1:0] fold_result;
  logic [7:0] corner_q;

  always_ff @(posedge clk_i) begin
    if (valid_i) corner_q <= last_i ? 8'd0 : corner_q + 8'd1;
    if (start_i) corner_q <= 8'd0;
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
      .item_valid_i(valid_i),
      .item_last_i(last_i),
      .item_i({
        sharp_i, tag_i, half_i, lanes_i, boundary_i, beyond_number_i, beyond_selected_i, lower_i, replaced_i, children_i, origin_i, point_i,
        number_i, selected_i, refined_i, forced_i, candidate_i
      }),
      .result_valid_i(valid_i && last_i),
      .result_i({corner_q + 8'd1, replaced_i[0], children_i[HW-1:0]}),
      .out_valid_o(fold_valid),
      .out_ready_i(fold_ready),
      .out_last_o(fold_last),
      .out_item_o(fold_item),
      .out_result_o(fold_result),
      .active_o(fold_active)
  );

  // --- The item at work, with what is behind and before its edges --------------------------------
  logic valid_q, last_q, first_q;
  logic [ITEM-1:0] item_q;
  logic [7:0] sides_q;
  logic prev_replaced_q;  // generation 0: the edge before
  logic [HW-1:0] prev_children_q;
  logic [VW-1:0] first_origin_q;  // generation 0: the face's first corner
  logic first_replaced_q;
  logic [HW-1:0] first_children_q;
  logic done, known, begins_q;

  logic candidate, refined, selected;
  logic [7:0] forced;
  logic [VW-1:0] number;
  logic [127:0] point;
  logic [4*VW-1:0] origin, beyond_number;
  logic [4*HW-1:0] children;
  logic [3:0] replaced, lower, beyond_selected, lanes, boundary, tag;
  logic [15:0] sharp;
  logic half;

  assign {sharp, tag, half, lanes, boundary, beyond_number, beyond_selected, lower, replaced, children, origin, point, number,
          selected, refined, forced, candidate} = item_q;

  // Origin, children and replaced of the corner that the fold shows.
  localparam int unsigned ORIGIN_AT = 128 + VW + 11;
  localparam int unsigned CHILDREN_AT = ORIGIN_AT + 4 * VW;
  localparam int unsigned REPLACED_AT = CHILDREN_AT + 4 * HW;

  assign known = quads_i || last_q || fold_valid;
  assign fold_ready = !valid_q || done;

  always_ff @(posedge clk_i) begin
    if (fold_valid && fold_ready) begin
      valid_q <= 1'b1;
      item_q <= fold_item;
      last_q <= fold_last;
      first_q <= begins_q;
      begins_q <= fold_last;
      sides_q <= fold_result[RESULT-1-:8];
      prev_replaced_q <= begins_q ? fold_result[HW] : replaced[0];
      prev_children_q <= begins_q ? fold_result[HW-1:0] : children[HW-1:0];
      if (begins_q) begin
        first_origin_q <= fold_item[ORIGIN_AT+:VW];
        first_replaced_q <= fold_item[REPLACED_AT];
        first_children_q <= fold_item[CHILDREN_AT+:HW];
      end
    end else if (done) begin
      valid_q <= 1'b0;
    end
    if (start_i) begins_q <= 1'b1;
    if (rst_i) valid_q <= 1'b0;
  end

  logic [4*VW-1:0] next_origin;
  logic [4*HW-1:0] next_children, prev_children;
  logic [3:0] next_replaced, prev_replaced;

  always_comb begin
    next_origin = '0;
    next_children = '0;
    next_replaced = '0;
    prev_children = '0;
    prev_replaced = '0;
    if (valid_q) begin
      next_origin = {origin[0+:VW], origin[4*VW-1:VW]};
      next_children = {children[0+:HW], children[4*HW-1:HW]};
      next_replaced = {replaced[0], replaced[3:1]};
      prev_children = {children[3*HW-1:0], children[3*HW+:HW]};
      prev_replaced = {replaced[2:0], replaced[3]};
    end
    if (valid_q && !quads_i) begin
      next_origin[0+:VW] = last_q ? first_origin_q : fold_item[ORIGIN_AT+:VW];
      next_children[0+:HW] = last_q ? first_children_q : fold_item[CHILDREN_AT+:HW];
      next_replaced[0] = last_q ? first_replaced_q : fold_item[REPLACED_AT];
      prev_children[0+:HW] = prev_children_q;
      prev_replaced[0] = prev_replaced_q;
    end
  end

  // --- Child halves ------------------------------------------------------------------------------
  logic [4*HALF-1:0] lower_half, upper_half;
  logic [4*QW-1:0] quad;
  logic [3:0] lower_mask, upper_mask;
  logic lower_ready, upper_ready, lower_done_q, upper_done_q, lower_active, upper_active;
  logic lower_conflict, upper_conflict;

  always_comb begin
    lower_half = '0;
    upper_half = '0;
    quad = '0;
    for (int i = 0; i < 4; i++) begin
      logic next_ends, prev_ends;  // c0 or c1 is what remains of a half-quad's boundary edge
      next_ends = half && i == 1;
      prev_ends = half && i == 0;
      if (valid_q) begin
        lower_half[i*HALF+:HALF] = {
          selected,
          forced,
          1'b0,
          !odd_i && i % 2 == 0,  // of the children of an even step, c1 of slots 0 and 2, c0 of the
          !odd_i ? tag : boundary[i] ? 4'd15 : sharp[i*4+:4],  // others lie on the old edge
          prev_ends,
          next_ends,
          !prev_ends && !prev_replaced[i],
          !next_ends && !next_replaced[i],
          prev_children[i*HW+:HW],
          next_children[i*HW+1+:HW-1],
          1'b1,  // c1 follows c0, which is at an even place
          number,
          next_origin[i*VW+:VW]
        };
        upper_half[i*HALF+:HALF] = lower_half[i*HALF+:HALF];
        if (boundary[i])
          upper_half[i*HALF+:HALF] = {
            selected, forced, 1'b1, 1'b0, 4'd0, 2'b01, 2'b00, {2 * HW{1'b0}}, VW'(0),
            origin[i*VW+:VW]
          };
        quad[i*QW+:QW] = children[i*HW+2+:QW];
      end
    end
  end

  // --- Half the sums that the middles of the edges are made of --------------------------------------
  localparam int unsigned WORD = 132 + HALF;  // {sums of w, z, y, x; half}

  logic [4*132-1:0] lower_sum, upper_sum;
  logic [4*WORD-1:0] lower_word, upper_word;
  logic [7:0] level;

  assign level = generation_i >> 1;

  logic [3:0] sharp_edge;

  always_comb begin
    lower_sum = '0;
    upper_sum = '0;
    sharp_edge = '0;
    if (pass_i && valid_q) for (int i = 0; i < 4; i++)
      sharp_edge[i] = boundary[i] || sharp[i*4+:4] == hs_pkg::SHARP_INFINITE[3:0] ||
          8'(sharp[i*4+:4]) > level;
    if (pass_i && valid_q)
      for (int i = 0; i < 4; i++)
        for (int k = 0; k < 4; k++) begin
          lower_sum[i*132+k*33+:33] = 33'($signed(position_i[(i+1)%4*128+k*32+:32])) +
              33'($signed(sharp_edge[i] ? position_i[(i+1)%4*128+k*32+:32] : point[k*32+:32]));
          upper_sum[i*132+k*33+:33] = boundary[i] ? {position_i[i*128+k*32+:32], 1'b0} :
              lower_sum[i*132+k*33+:33];
        end
    lower_word = '0;
    upper_word = '0;
    if (valid_q) for (int i = 0; i < 4; i++) begin
      lower_word[i*WORD+:WORD] = {lower_sum[i*132+:132], lower_half[i*HALF+:HALF]};
      upper_word[i*WORD+:WORD] = {upper_sum[i*132+:132], upper_half[i*HALF+:HALF]};
    end
  end

  logic [WORD*(1<<BANK_BITS)-1:0] lower_wr_word, upper_wr_word;

  for (genvar b = 0; b < (1 << BANK_BITS); b++) begin : g_bank
    assign {lower_wr_sum_o[b*132+:132], lower_wr_data_o[b*HALF+:HALF]} = lower_wr_word[b*WORD+:WORD];
    assign {upper_wr_sum_o[b*132+:132], upper_wr_data_o[b*HALF+:HALF]} = upper_wr_word[b*WORD+:WORD];
  end

  assign lower_mask = last_step_i ? 4'b0000 : replaced & lower;
  assign upper_mask = last_step_i ? 4'b0000 : replaced & (~lower | boundary);

  scatter #(
      .WIDTH(WORD),
      .ROW_BITS(QW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_lower (
      .clk_i,
      .rst_i,
      .in_valid_i(valid_q && known && lower_mask != 4'b0000 && !lower_done_q),
      .in_ready_o(lower_ready),
      .in_mask_i(lower_mask),
      .in_index_i(quad),
      .in_data_i(lower_word),
      .en_o(lower_wr_en_o),
      .row_o(lower_wr_row_o),
      .data_o(lower_wr_word),
      .conflict_o(lower_conflict),
      .active_o(lower_active)
  );

  scatter #(
      .WIDTH(WORD),
      .ROW_BITS(QW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_upper (
      .clk_i,
      .rst_i,
      .in_valid_i(valid_q && known && upper_mask != 4'b0000 && !upper_done_q),
      .in_ready_o(upper_ready),
      .in_mask_i(upper_mask),
      .in_index_i(quad),
      .in_data_i(upper_word),
      .en_o(upper_wr_en_o),
      .row_o(upper_wr_row_o),
      .data_o(upper_wr_word),
      .conflict_o(upper_conflict),
      .active_o(upper_active)
  );
  assign conflict_o = lower_conflict || upper_conflict;

  // --- Final faces -------------------------------------------------------------------------------
  logic fold_fault, faces_fault;
  logic faces_over, faces_active;

  split_faces #(
      .VW(VW),
      .OPS(OPS), .PARITY(PARITY)
  ) u_faces (
      .fault_o(faces_fault),
      .clk_i, .rst_i, .quads_i, .last_step_i, .done_i(done), .over_o(faces_over), .sent_o,
      .active_o(faces_active), .first_i(first_q), .last_i(last_q), .sides_i(sides_q),
      .candidate_i(candidate), .refined_i(refined), .selected_i(selected), .number_i(number),
      .lanes_i(lanes), .boundary_i(boundary), .half_i(half), .point_i(point),
      .origin_i(origin), .next_origin_i(next_origin), .replaced_i(replaced),
      .lower_i(lower), .beyond_selected_i(beyond_selected), .beyond_number_i(beyond_number),
      .op_valid_o, .op_ready_i, .op_kind_o, .op_number_o, .op_position_o, .op_mask_o,
      .op_triangle_o, .op_child_o, .op_candidate_o, .op_vertex_o, .op_sides_o, .op_first_o,
      .op_last_o
  );

  // --- The item is done when each of its parts is ------------------------------------------------
  logic lower_over, upper_over;

  assign lower_over = lower_mask == 4'b0000 || lower_done_q || lower_ready;
  assign upper_over = upper_mask == 4'b0000 || upper_done_q || upper_ready;
  assign done = valid_q && known && lower_over && upper_over && faces_over;
  assign item_out_o = done;

  assign birth_o = done && all_i && refined && !last_step_i;
  assign birth_vertex_o = number;
  assign birth_position_o = point;
  assign birth_sharpness_o = odd_i ? 4'd0 : tag;

  always_ff @(posedge clk_i) begin
    if (done || !valid_q || !known) begin
      lower_done_q <= 1'b0;
      upper_done_q <= 1'b0;
    end else begin
      lower_done_q <= lower_over;
      upper_done_q <= upper_over;
    end
  end

  assign active_o = fold_active || valid_q || lower_active || upper_active || faces_active;

  assign fault_o = fold_fault || faces_fault;

endmodule
