// SPDX-License-Identifier: Apache-2.0
//
// Reads up to four words of a banked memory for each item that passes.
//
//                +-> lane 0: requests --+             +--> words of lane 0 --+
//   items in ----+-> ...                +--> banks ---+--> ...               +--> items out
//                +-> lane 3: requests --+             +--> words of lane 3 --+
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: its payload, a mask of the lanes
//     that want a word, and their word numbers. Items leave in order, out_valid_o for one cycle,
//     with the lanes' words (of the lanes in the mask; the others' are without meaning); whoever
//     takes them always takes them.
//   * Each lane asks for its words in order, but the lanes do not wait for each other: one that
//     finds its bank free runs ahead of one that does not, by up to WINDOW items. So an item's own
//     lanes may share a bank without costing a cycle, as long as the banks are evenly used.
//     Of the lanes that want the same bank in the same cycle the lowest gets it; the others wait
//     (conflict_o), and catch up when the window stops the lower ones.
//   * Rate: at most an item a cycle. Latency: 3 cycles without conflicts.
//   * stall_i: nothing is taken. At most WINDOW items still come out.
//   * The memory answers one cycle after rd_en_o. Writing a word that an item inside is about to
//     read is illegal but where the user shows which of the two words it gets.

module gather #(
    // Bits of the payload.
    parameter int unsigned ITEM_WIDTH = 8,
    // Bits of a memory word.
    parameter int unsigned WIDTH = 128,
    // Rows of a bank and banks, as powers of two.
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3,
    // Items inside; a power of two.
    parameter int unsigned WINDOW = 16
) (
    input logic clk_i,
    input logic rst_i,
    input logic stall_i,

    // items in
    input  logic                              in_valid_i,
    output logic                              in_ready_o,
    input  logic [            ITEM_WIDTH-1:0] in_item_i,
    input  logic [                       3:0] in_mask_i,
    input  logic [4*(ROW_BITS+BANK_BITS)-1:0] in_index_i,

    // memory
    output logic [         (1<<BANK_BITS)-1:0] rd_en_o,
    output logic [ROW_BITS*(1<<BANK_BITS)-1:0] rd_row_o,
    input  logic [   WIDTH*(1<<BANK_BITS)-1:0] rd_data_i,

    // items out
    output logic                  out_valid_o,
    output logic [ITEM_WIDTH-1:0] out_item_o,
    output logic [   4*WIDTH-1:0] out_data_o,

    output logic conflict_o,
    output logic active_o  // an item is inside
);

  localparam int unsigned IB = ROW_BITS + BANK_BITS;

  logic take, item_there, item_room;
  logic [3:0] item_mask;

  assign in_ready_o = item_room && !stall_i;
  assign take = in_valid_i && in_ready_o;
  assign active_o = item_there;

  // No lane holds more requests and words than there are items, so only the items' FIFO can be full.
  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(ITEM_WIDTH + 4),
      .DEPTH(WINDOW)
  ) u_items (
      .clk_i,
      .rst_i,
      .in_valid_i(take),
      .in_ready_o(item_room),
      .in_data_i({in_mask_i, in_item_i}),
      .out_valid_o(item_there),
      .out_ready_i(out_valid_o),
      .out_data_o({item_mask, out_item_o}),
      .level_o()
  );

  // --- Requests, lane by lane, to the banks -------------------------------------------------------
  logic [3:0] wanted, grant;
  logic [4*IB-1:0] index;
  logic [4*BANK_BITS-1:0] bank;

  for (genvar i = 0; i < 4; i++) begin : g_request
    fifo #(
        .WIDTH(IB),
        .DEPTH(WINDOW)
    ) u_requests (
        .clk_i,
        .rst_i,
        .in_valid_i(take && in_mask_i[i]),
        .in_ready_o(),
        .in_data_i(in_index_i[i*IB+:IB]),
        .out_valid_o(wanted[i]),
        .out_ready_i(grant[i]),
        .out_data_o(index[i*IB+:IB]),
        .level_o()
    );
    assign bank[i*BANK_BITS+:BANK_BITS] = index[i*IB+:BANK_BITS];
  end

  lanes #(
      .BANK_BITS(BANK_BITS)
  ) u_lanes (
      .pending_i(wanted),
      .bank_i(bank),
      .grant_o(grant)
  );
  assign conflict_o = wanted != grant;

  always_comb begin
    rd_en_o  = '0;
    rd_row_o = '0;
    for (int i = 0; i < 4; i++)
      if (grant[i]) begin
        rd_en_o[bank[i*BANK_BITS+:BANK_BITS]] = 1'b1;
        rd_row_o[32'(bank[i*BANK_BITS+:BANK_BITS])*ROW_BITS+:ROW_BITS] =
            index[i*IB+BANK_BITS+:ROW_BITS];
      end
  end

  // --- Words, lane by lane, until the whole item's are there -----------------------------------------
  logic [3:0] arrives_q, there;
  logic [4*BANK_BITS-1:0] bank_q;

  always_ff @(posedge clk_i) begin
    arrives_q <= grant;
    bank_q <= bank;
    if (rst_i) arrives_q <= 4'd0;
  end

  for (genvar i = 0; i < 4; i++) begin : g_word
    fifo #(
        .WIDTH(WIDTH),
        .DEPTH(WINDOW)
    ) u_words (
        .clk_i,
        .rst_i,
        .in_valid_i(arrives_q[i]),
        .in_ready_o(),
        .in_data_i(rd_data_i[32'(bank_q[i*BANK_BITS+:BANK_BITS])*WIDTH+:WIDTH]),
        .out_valid_o(there[i]),
        .out_ready_i(out_valid_o && item_mask[i]),
        .out_data_o(out_data_o[i*WIDTH+:WIDTH]),
        .level_o()
    );
  end
  /* verilator lint_on PINCONNECTEMPTY */

  assign out_valid_o = item_there && (item_mask & ~there) == 4'd0;

endmodule
