// SPDX-License-Identifier: Apache-2.0
//
// split_number: the part of split that numbers the children. It finds the edges that are replaced,
// those between two refined faces and, in an odd step, those on the boundary, and for each of their
// half-edges h the half-edge of the next generation at which its children c0(h), c1(h) begin:
//
//   4 quad + 0   if h is the lower or only half-edge of its edge: the quad is numbered here;
//   4 quad + 2   if it is the upper one: the quad was numbered with the item of twin(h).
//
//   items --> replaced, lower --> count --> FIFO --> gather --> items with their children
//                                   |                  ^
//                                   +-> number memory -+  {first, lower} of the twins' items
//
//   * Quads are numbered in the order of items and of their edges. The number memory gets
//     {first, lower}: the number of the item's first child quad, and which of its edges have the
//     lower half-edge here. It is written in the cycle in which the item comes, and read by the
//     item itself and later ones only, later.
//   * An item comes with valid_i, and is never refused; stall_o asks the gather before this module
//     to stop. rest_i goes along unchanged. Items leave in order; stall_i stops them as gather's.
//   * start_i clears count_o, the quads numbered so far. The settings hold until active_o falls.
//   * Generation 0 (quads_i low) has an item a corner, in lane 0.
//   * last_step_i: nobody asks for the children of upper half-edges, so they are not looked up;
//     what children_o says of them is without meaning, as it is of edges that are not replaced.

module split_number #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19,  // width of a quad's (generation 0: a corner's) number
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8, // words a cycle
    parameter int unsigned READ_LATENCY = 1, // of a gather
    parameter int unsigned REST = 8,  // bits of an item that just go along
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    // from the sequencer
    input  logic          start_i,
    input  logic          quads_i,
    input  logic          odd_i,
    input  logic          all_i,
    input  logic          last_step_i,
    input  logic [VW-1:0] first_new_i,  // all_i: the new vertex of face 0
    output logic [  QW:0] count_o,
    output logic          active_o,

    // items, from the gather of the verdicts beyond their edges
    input  logic                valid_i,
    output logic                stall_o,
    input  logic [      QW-1:0] item_i,
    input  logic                refined_i,
    input  logic [         3:0] lanes_i,    // in use
    input  logic [         3:0] boundary_i,
    input  logic [         3:0] border_i,
    input  logic [4*(QW+2)-1:0] twin_i,
    input  logic [4*(VW+2)-1:0] verdict_i,  // {refined, selected, number} of the faces beyond
    input  logic [    REST-1:0] rest_i,

    // number memory {first, lower}
    output logic                                    number_wr_en_o,
    output logic [                          QW-1:0] number_wr_item_o,
    output logic [                          QW+3:0] number_wr_data_o,
    output logic [              (1<<BANK_BITS)-1:0] number_rd_en_o,
    output logic [(QW-BANK_BITS)*(1<<BANK_BITS)-1:0] number_rd_row_o,
    input  logic [       (QW+4)*(1<<BANK_BITS)-1:0] number_rd_data_i,

    // items, with what is known of their edges
    input  logic                stall_i,
    output logic                valid_o,
    output logic [    REST-1:0] rest_o,
    output logic [         3:0] replaced_o,
    output logic [         3:0] lower_o,            // replaced, and this half-edge is the lower
    output logic [4*(QW+2)-1:0] children_o,
    output logic [         3:0] beyond_selected_o,
    output logic [    4*VW-1:0] beyond_number_o,    // of the new vertex

    output logic conflict_o,
    output logic fault_o
);

  localparam int unsigned HW = QW + 2;  // width of a half-edge's number

  // --- Which edges are replaced, and which of them are numbered here -----------------------------
  logic [3:0] replaced, lower, beyond_selected;
  logic [4*VW-1:0] beyond_number;
  logic [QW:0] count_q;
  logic [2:0] lower_count;

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic [HW-1:0] twin, own;
      logic [VW-1:0] beyond_new;  // a name for Yosys, as in split
      logic beyond_refined;
      twin = twin_i[i*HW+:HW];
      own = quads_i ? {item_i, 2'(i)} : {2'b00, item_i};
      beyond_new = first_new_i + VW'(twin[HW-1:2]);
      {beyond_refined, beyond_selected[i], beyond_number[i*VW+:VW]} = all_i ?
          {2'b11, beyond_new} : verdict_i[i*(VW+2)+:VW+2];
      replaced[i] = refined_i && lanes_i[i] &&
          (boundary_i[i] ? odd_i : !border_i[i] && beyond_refined);
      lower[i] = replaced[i] && (boundary_i[i] || own < twin);
    end
    lower_count = 3'(lower[0]) + 3'(lower[1]) + 3'(lower[2]) + 3'(lower[3]);
  end

  always_ff @(posedge clk_i) begin
    if (start_i) count_q <= '0;
    else if (valid_i) count_q <= count_q + (QW + 1)'(lower_count);
  end
  assign count_o = count_q;
  assign number_wr_en_o = valid_i;
  assign number_wr_item_o = item_i;
  assign number_wr_data_o = {count_q[QW-1:0], lower};

  // --- Ask the items of the twins for their numbers ----------------------------------------------
  localparam int unsigned ITEM = REST + 4 * HW + QW + 4 + 4 + 4 + 4 * VW;

  logic waiting_valid, waiting_ready, gather_active;
  logic [WINDOW_BITS+1:0] level;
  logic [ITEM-1:0] waiting, found;
  logic [4*HW-1:0] waiting_twin;
  logic [3:0] waiting_replaced, waiting_lower;
  logic [4*QW-1:0] waiting_index;  // the item that a twin belongs to
  logic [4*(QW+4)-1:0] numbers;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(ITEM),
      .DEPTH(2 << WINDOW_BITS), .PARITY(PARITY)
  ) u_waiting (
      .fault_o(fault_o),
      .clk_i, .rst_i, .in_valid_i(valid_i),
      .in_ready_o(),  // stall_o keeps it high
      .in_data_i({
        rest_i, beyond_number, beyond_selected, count_q[QW-1:0], twin_i, replaced, lower
      }),
      .out_valid_o(waiting_valid), .out_ready_i(waiting_ready), .out_data_o(waiting),
      .level_o(level)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // What is on its way, a window of items, still fits.
  assign stall_o = level > (WINDOW_BITS + 2)'(1 << WINDOW_BITS);
  assign {waiting_twin, waiting_replaced, waiting_lower} = waiting[4*HW+7:0];

  for (genvar i = 0; i < 4; i++) begin : g_waiting
    assign waiting_index[i*QW+:QW] =
        quads_i ? waiting_twin[i*HW+2+:QW] : waiting_twin[i*HW+:QW];
  end

  gather #(
      .ITEM_WIDTH(ITEM),
      .WIDTH(QW + 4),
      .ROW_BITS(QW - BANK_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY)
  ) u_gather_numbers (
      .clk_i, .rst_i, .stall_i, .in_valid_i(waiting_valid), .in_ready_o(waiting_ready),
      .in_item_i(waiting),
      .in_mask_i(last_step_i ? 4'b0000 : waiting_replaced & ~waiting_lower),
      .in_index_i(waiting_index), .rd_en_o(number_rd_en_o), .rd_row_o(number_rd_row_o),
      .rd_data_i(number_rd_data_i), .out_valid_o(valid_o), .out_item_o(found),
      .out_data_o(numbers), .conflict_o, .active_o(gather_active)
  );
  assign active_o = waiting_valid || gather_active;

  // --- The half-edge of the next generation where each half-edge's children begin ----------------
  logic [QW-1:0] first;
  logic [4*HW-1:0] twin_found;

  assign {rest_o, beyond_number_o, beyond_selected_o, first, twin_found, replaced_o, lower_o} =
      found;

  // How many of the edges before edge i are numbered with their item.
  function automatic logic [QW-1:0] before_edge(input logic [2:0] mask, input logic [1:0] i);
    before_edge = QW'(mask[0] && i > 2'd0) + QW'(mask[1] && i > 2'd1) + QW'(mask[2] && i > 2'd2);
  endfunction

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic [QW+2:0] word;  // {first, lower of edges 0 to 2} of the twin's item
      logic [1:0] edge_there;
      word = {numbers[i*(QW+4)+4+:QW], numbers[i*(QW+4)+:3]};
      edge_there = quads_i ? twin_found[i*HW+:2] : 2'd0;
      children_o[i*HW+:HW] = lower_o[i] ?
          {first + before_edge(lower_o[2:0], 2'(i)), 2'b00} :
          {word[3+:QW] + before_edge(word[2:0], edge_there), 2'b10};
    end
  end

endmodule
