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
// Quads are numbered by the lower of their two half-edges. An edge of one refined face only is kept:
// it yields the final triangle (v, w, F); a face that is not refined is final itself.
//
//   fetch --> gather --> which edges are  --> gather --> fold --> split_write
//   records   verdicts   replaced; numbers    numbers    n-gons   child halves, final faces
//             beyond     of the lower         beyond
//
//   * start_i for one cycle with items_i: corners in generation 0 (quads_i low), quads later. The
//     settings hold until active_o falls. children_o: quads of the next generation so far.
//   * all_i: every face is refined, and the verdict memory is not used: face q's new vertex is
//     first_new_i + q. finish_i: none is refined.
//   * The number memory gets {first, lower}: per item the number of its first child quad, and which
//     of its edges have the lower half-edge here. An item's word is written in the cycle in which
//     it leaves the first gather, and read by itself and later items only, later.
//   * Rate: a quad, or in generation 0 a corner, a cycle, and a cycle more for each bank conflict
//     and for each face that sends its own new vertex.

module split #(
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
    input  logic        all_i,
    input  logic        last_i,       // the children are final: they leave at once
    input  logic        finish_i,     // nothing is refined: all active faces are final
    input  logic [VW-1:0] first_new_i,
    output logic        active_o,
    output logic [QW:0] children_o,

    // record memory, lane 0 only in generation 0; face memory; the item's own verdict
    output logic                record_rd_en_o,
    output logic [      QW-1:0] record_rd_item_o,
    output logic [      QW-1:0] record_rd_face_o,
    input  logic [    4*VW-1:0] record_origin_i,
    input  logic [4*(QW+2)-1:0] record_twin_i,
    input  logic [         3:0] record_border_i,
    input  logic                record_candidate_i,
    input  logic [         7:0] record_forced_i,
    input  logic                record_last_i,
    input  logic [       127:0] face_point_i,
    input  logic [      VW+1:0] own_verdict_i,  // {refined, selected, number}

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
    output logic [(2*VW+2*QW+15)*(1<<BANK_BITS)-1:0] lower_wr_data_o,
    output logic [                 (1<<BANK_BITS)-1:0] upper_wr_en_o,
    output logic [   (QW-BANK_BITS)*(1<<BANK_BITS)-1:0] upper_wr_row_o,
    output logic [(2*VW+2*QW+15)*(1<<BANK_BITS)-1:0] upper_wr_data_o,

    // new vertices: born here if all_i, else just marked as sent
    output logic          birth_o,
    output logic          sent_o,
    output logic [VW-1:0] birth_vertex_o,
    output logic [ 127:0] birth_position_o,

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
    output logic [2:0] conflict_o
);

  localparam int unsigned HW = QW + 2;  // width of a half-edge's number
  localparam int unsigned IB = QW;

  // --- Fetch; gather the verdicts of the faces beyond ---------------------------------------------------
  // {last, candidate, forced, refined, selected, number, point, item, border, twins, origins}
  localparam int unsigned RECORD = 1 + 1 + 8 + 2 + VW + 128 + QW + 4 + 4 * HW + 4 * VW;

  logic fetch_valid, fetch_ready, fetch_active, stall_first;
  logic [QW-1:0] fetch_item;
  logic own_refined, own_selected;
  logic [VW-1:0] own_number;
  logic [3:0] lanes_in;
  logic [4*IB-1:0] beyond_in;  // the item that a twin belongs to
  logic beyond_valid, beyond_active;
  logic [RECORD-1:0] beyond_item;
  logic [4*(VW+2)-1:0] beyond_verdict;

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
      .item_o(fetch_item),
      /* verilator lint_off PINCONNECTEMPTY */
      .face_o(),  // the face's words come with the item's
      /* verilator lint_on PINCONNECTEMPTY */
      .active_o(fetch_active)
  );

  assign own_refined = !finish_i && (all_i || own_verdict_i[VW+1]);
  assign own_selected = all_i || own_verdict_i[VW];
  assign own_number = all_i ? first_new_i + VW'(fetch_item) : own_verdict_i[VW-1:0];
  assign lanes_in = quads_i ? 4'b1111 : 4'b0001;

  for (genvar i = 0; i < 4; i++) begin : g_beyond
    assign beyond_in[i*IB+:IB] =
        quads_i ? record_twin_i[i*HW+2+:QW] : record_twin_i[i*HW+:QW];
  end

  gather #(
      .ITEM_WIDTH(RECORD),
      .WIDTH(VW + 2),
      .ROW_BITS(QW - BANK_BITS),
      .BANK_BITS(BANK_BITS)
  ) u_gather_verdicts (
      .clk_i,
      .rst_i,
      .stall_i(stall_first),
      .in_valid_i(fetch_valid),
      .in_ready_o(fetch_ready),
      .in_item_i({
        record_last_i,
        record_candidate_i,
        record_forced_i,
        own_refined,
        own_selected,
        own_number,
        face_point_i,
        fetch_item,
        record_border_i,
        record_twin_i,
        record_origin_i
      }),
      .in_mask_i(own_refined && !all_i ? lanes_in & ~record_border_i : 4'b0000),
      .in_index_i(beyond_in),
      .rd_en_o(verdict_rd_en_o),
      .rd_row_o(verdict_rd_row_o),
      .rd_data_i(verdict_rd_data_i),
      .out_valid_o(beyond_valid),
      .out_item_o(beyond_item),
      .out_data_o(beyond_verdict),
      .conflict_o(conflict_o[0]),
      .active_o(beyond_active)
  );

  // --- Which edges are replaced, and which of them are numbered here ----------------------------------------
  logic [3:0] replaced, lower;
  logic [QW:0] children_q;
  logic [2:0] lower_count;
  logic [QW-1:0] beyond_number_item;
  logic [4*HW-1:0] beyond_twin;
  logic [3:0] beyond_selected;
  logic [4*VW-1:0] beyond_number;

  assign beyond_number_item = beyond_item[4*VW+4*HW+4+:QW];
  assign beyond_twin = beyond_item[4*VW+:4*HW];

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic [HW-1:0] twin, own;
      twin = beyond_twin[i*HW+:HW];
      own = quads_i ? {beyond_number_item, 2'(i)} : {2'b00, beyond_number_item};
      replaced[i] = beyond_item[RECORD-11] && !beyond_item[4*VW+4*HW+i] && (quads_i || i == 0) &&
          (all_i || beyond_verdict[i*(VW+2)+VW+1]);
      lower[i] = replaced[i] && own < twin;
      beyond_selected[i] = all_i || beyond_verdict[i*(VW+2)+VW];
      beyond_number[i*VW+:VW] = all_i ? first_new_i + VW'(twin[HW-1:2]) :
          beyond_verdict[i*(VW+2)+:VW];
    end
    lower_count = 3'(lower[0]) + 3'(lower[1]) + 3'(lower[2]) + 3'(lower[3]);
  end

  always_ff @(posedge clk_i) begin
    if (start_i) children_q <= '0;
    else if (beyond_valid) children_q <= children_q + (QW + 1)'(lower_count);
  end
  assign children_o = children_q;
  assign number_wr_en_o = beyond_valid;
  assign number_wr_item_o = beyond_number_item;
  assign number_wr_data_o = {children_q[QW-1:0], lower};

  // --- Between the gathers ------------------------------------------------------------------------------------
  // {first child, lower, replaced, selected beyond, numbers beyond, record}
  localparam int unsigned MIDDLE = QW + 4 + 4 + 4 + 4 * VW + RECORD;

  logic middle_valid, middle_ready;
  logic [MIDDLE-1:0] middle;
  logic [5:0] middle_level;
  logic [4*IB-1:0] middle_index;
  logic [3:0] middle_lower, middle_replaced;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(MIDDLE),
      .DEPTH(32)
  ) u_middle (
      .clk_i,
      .rst_i,
      .in_valid_i(beyond_valid),
      .in_ready_o(),  // stall_first keeps it high
      .in_data_i({
        children_q[QW-1:0], lower, replaced, beyond_selected, beyond_number, beyond_item
      }),
      .out_valid_o(middle_valid),
      .out_ready_i(middle_ready),
      .out_data_o(middle),
      .level_o(middle_level)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign stall_first = middle_level > 6'd12;  // gather's window still fits
  assign middle_replaced = middle[RECORD+4*VW+4+:4];
  assign middle_lower = middle[RECORD+4*VW+8+:4];
  for (genvar i = 0; i < 4; i++) begin : g_middle
    assign middle_index[i*IB+:IB] =
        quads_i ? middle[4*VW+i*HW+2+:QW] : middle[4*VW+i*HW+:QW];
  end

  logic numbered_valid, numbers_active, stall_second;
  logic [MIDDLE-1:0] numbered;
  logic [4*(QW+4)-1:0] numbers;

  gather #(
      .ITEM_WIDTH(MIDDLE),
      .WIDTH(QW + 4),
      .ROW_BITS(QW - BANK_BITS),
      .BANK_BITS(BANK_BITS)
  ) u_gather_numbers (
      .clk_i,
      .rst_i,
      .stall_i(stall_second),
      .in_valid_i(middle_valid),
      .in_ready_o(middle_ready),
      .in_item_i(middle),
      .in_mask_i(last_i ? 4'b0000 : middle_replaced & ~middle_lower),
      .in_index_i(middle_index),
      .rd_en_o(number_rd_en_o),
      .rd_row_o(number_rd_row_o),
      .rd_data_i(number_rd_data_i),
      .out_valid_o(numbered_valid),
      .out_item_o(numbered),
      .out_data_o(numbers),
      .conflict_o(conflict_o[1]),
      .active_o(numbers_active)
  );

  // --- The half-edge of the next generation where each half-edge's children begin -----------------------------
  logic [4*HW-1:0] children;
  logic [3:0] numbered_lower;

  assign numbered_lower = numbered[RECORD+4*VW+8+:4];

  // How many of the edges before edge i are numbered at their item.
  function automatic logic [QW-1:0] before_edge(input logic [2:0] mask, input logic [1:0] i);
    before_edge = QW'(mask[0] && i > 2'd0) + QW'(mask[1] && i > 2'd1) + QW'(mask[2] && i > 2'd2);
  endfunction

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic [QW+2:0] word;  // {first, lower of edges 0 to 2}
      logic [1:0] edge_there;
      word = {numbers[i*(QW+4)+4+:QW], numbers[i*(QW+4)+:3]};
      edge_there = quads_i ? numbered[4*VW+i*HW+:2] : 2'd0;
      children[i*HW+:HW] = numbered_lower[i] ?
          {numbered[MIDDLE-QW+:QW] + before_edge(numbered_lower[2:0], 2'(i)), 2'b00} :
          {word[3+:QW] + before_edge(word[2:0], edge_there), 2'b10};
    end
  end

  // --- Write -----------------------------------------------------------------------------------------------------
  logic write_active;

  split_write #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_write (
      .clk_i,
      .rst_i,
      .start_i,
      .quads_i,
      .last_step_i(last_i),
      .all_i,
      .stall_o(stall_second),
      .active_o(write_active),
      .valid_i(numbered_valid),
      .last_i(numbered[RECORD-1]),
      .candidate_i(numbered[RECORD-2]),
      .forced_i(numbered[RECORD-3-:8]),
      .refined_i(numbered[RECORD-11]),
      .selected_i(numbered[RECORD-12]),
      .number_i(numbered[RECORD-13-:VW]),
      .point_i(numbered[RECORD-13-VW-:128]),
      .origin_i(numbered[4*VW-1:0]),
      .children_i(children),
      .replaced_i(numbered[RECORD+4*VW+4+:4]),
      .lower_i(numbered_lower),
      .beyond_selected_i(numbered[RECORD+4*VW+:4]),
      .beyond_number_i(numbered[RECORD+:4*VW]),
      .lower_wr_en_o,
      .lower_wr_row_o,
      .lower_wr_data_o,
      .upper_wr_en_o,
      .upper_wr_row_o,
      .upper_wr_data_o,
      .birth_o,
      .sent_o,
      .birth_vertex_o,
      .birth_position_o,
      .op_valid_o,
      .op_ready_i,
      .op_kind_o,
      .op_number_o,
      .op_position_o,
      .op_mask_o,
      .op_triangle_o,
      .op_child_o,
      .op_candidate_o,
      .op_vertex_o,
      .op_sides_o,
      .op_first_o,
      .op_last_o,
      .item_out_o,
      .conflict_o(conflict_o[2])
  );

  // --- Counters --------------------------------------------------------------------------------------
  assign active_o = fetch_active || beyond_active || middle_valid || numbers_active || write_active;
  assign busy_o = fetch_valid && fetch_ready;
  assign blocked_o = fetch_valid && !fetch_ready;
  assign starved_o = active_o && !fetch_valid;
  assign item_in_o = busy_o;

endmodule
