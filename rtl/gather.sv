// SPDX-License-Identifier: Apache-2.0
//
// Reads up to four words of a banked memory for each item that passes.
//
//   items --> window of 2^WINDOW_BITS items --> items with their words
//               | each bank: the oldest        ^
//               | request that wants it        | next cycle
//               +------> banked memory --------+
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: its payload, a mask of the lanes
//     that want a word, and their word numbers. Items leave in order, out_valid_o for one cycle,
//     with the lanes' words; whoever takes them always takes them.
//   * The requests of all items inside compete for the banks; in each cycle a bank serves the oldest
//     one that wants it (in an item, that of the lowest lane), and of those at most LANES are served,
//     the oldest. So an item whose banks are busy holds up nobody whose banks are not, until the
//     window is full.
//   * Rate: an item a cycle, as long as no bank is wanted more often than once a cycle over a
//     window's length. Latency: 2 + READ_LATENCY cycles from the one that took it, and 1 for each in
//     which the last of its requests waited. conflict_o: a request waits.
//   * stall_i: nothing is taken. At most the window's items still come out.
//   * The memory answers one cycle after rd_en_o; READ_LATENCY - 1 registers on the words' way back
//     stand for a slower memory or a longer way. Writing a word that an item inside is about to
//     read is illegal but where the user shows which of the two words it gets.

module gather #(
    // Bits of the payload.
    parameter int unsigned ITEM_WIDTH = 8,
    // Bits of a memory word.
    parameter int unsigned WIDTH = 128,
    // Rows of a bank and banks, as powers of two.
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3,
    // Items inside, as a power of two; 1 or more.
    parameter int unsigned WINDOW_BITS = 3,
    // Words a cycle, 1 or more.
    parameter int unsigned LANES = 8,
    // Cycles from a request to its word; 1 or more.
    parameter int unsigned READ_LATENCY = 1
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
  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned WINDOW = 1 << WINDOW_BITS;
  localparam int unsigned SB = WINDOW_BITS + 2;  // a slot's lane: {slot, lane}

  // --- The window: a ring of slots, the oldest at head_q -----------------------------------------
  logic [WINDOW_BITS-1:0] head_q, tail_q;
  logic [WINDOW_BITS:0] count_q;
  logic [ITEM_WIDTH-1:0] item_q[0:WINDOW-1];
  logic [IB-1:0] index_q[0:4*WINDOW-1];
  logic [WIDTH-1:0] word_q[0:4*WINDOW-1];
  logic [4*WINDOW-1:0] pending_q, missing_q;  // requests: not yet sent, not yet answered
  logic [4*WINDOW-1:0] sent, answered;
  logic take;

  assign in_ready_o = !count_q[WINDOW_BITS] && !stall_i;
  assign take = in_valid_i && in_ready_o;

  // --- Requests: a bank serves the oldest ---------------------------------------------------------
  logic [SB-1:0] asks[0:BANKS-1];  // who

  always_comb begin
    logic [SB-1:0] at;
    logic [IB-1:0] index;
    int unsigned served;
    at = '0;
    index = '0;
    served = 0;
    sent = '0;
    rd_en_o = '0;
    rd_row_o = '0;
    for (int b = 0; b < BANKS; b++) asks[b] = '0;
    if (pending_q != '0)
      for (int a = 0; a < WINDOW; a++)
        for (int i = 0; i < 4; i++) begin
          at = {head_q + WINDOW_BITS'(a), 2'(i)};
          index = index_q[at];
          if (pending_q[at] && !rd_en_o[index[BANK_BITS-1:0]] &&
              (LANES >= BANKS || served < LANES)) begin
            if (LANES < BANKS) served = served + 1;
            sent[at] = 1'b1;
            rd_en_o[index[BANK_BITS-1:0]] = 1'b1;
            rd_row_o[32'(index[BANK_BITS-1:0])*ROW_BITS+:ROW_BITS] = index[IB-1:BANK_BITS];
            asks[index[BANK_BITS-1:0]] = at;
          end
        end
  end
  assign conflict_o = (pending_q & ~sent) != '0;

  // --- Answers ------------------------------------------------------------------------------------
  logic [BANKS-1:0] answers_q;
  logic [SB-1:0] asked_q[0:BANKS-1];
  logic [WIDTH*BANKS-1:0] words;

  always_comb begin
    answered = '0;
    for (int b = 0; b < BANKS; b++) if (answers_q[b]) answered[asked_q[b]] = 1'b1;
  end

  generate
    if (READ_LATENCY == 1) begin : g_near
      assign words = rd_data_i;
      always_ff @(posedge clk_i) begin
        answers_q <= rst_i ? '0 : rd_en_o;
        for (int b = 0; b < BANKS; b++) if (rd_en_o[b]) asked_q[b] <= asks[b];
      end
    end else begin : g_far
      localparam int unsigned WAY = READ_LATENCY - 1;
      logic [BANKS-1:0] read_q[0:WAY-1];
      logic [SB*BANKS-1:0] slot_q[0:WAY-1];
      logic [WIDTH*BANKS-1:0] word_way_q[0:WAY-1];

      always_ff @(posedge clk_i) begin
        read_q[0] <= rst_i ? '0 : rd_en_o;
        for (int b = 0; b < BANKS; b++) slot_q[0][b*SB+:SB] <= asks[b];
        word_way_q[0] <= rd_data_i;
        for (int t = 1; t < WAY; t++) begin
          read_q[t] <= rst_i ? '0 : read_q[t-1];
          slot_q[t] <= slot_q[t-1];
          word_way_q[t] <= word_way_q[t-1];
        end
        answers_q <= rst_i ? '0 : read_q[WAY-1];
        for (int b = 0; b < BANKS; b++)
          if (read_q[WAY-1][b]) asked_q[b] <= slot_q[WAY-1][b*SB+:SB];
      end
      assign words = word_way_q[WAY-1];
    end
  endgenerate

  always_ff @(posedge clk_i) begin
    for (int b = 0; b < BANKS; b++)
      if (answers_q[b]) word_q[asked_q[b]] <= words[b*WIDTH+:WIDTH];
    pending_q <= pending_q & ~sent;
    missing_q <= missing_q & ~answered;
    if (take) begin
      item_q[tail_q] <= in_item_i;
      for (int i = 0; i < 4; i++) index_q[{tail_q, 2'(i)}] <= in_index_i[i*IB+:IB];
      pending_q[{tail_q, 2'b00}+:4] <= in_mask_i;
      missing_q[{tail_q, 2'b00}+:4] <= in_mask_i;
      tail_q <= tail_q + 1'b1;
    end
    if (out_valid_o) head_q <= head_q + 1'b1;
    count_q <= count_q + (WINDOW_BITS + 1)'(take) - (WINDOW_BITS + 1)'(out_valid_o);
    if (rst_i) begin
      pending_q <= '0;
      missing_q <= '0;
      head_q <= '0;
      tail_q <= '0;
      count_q <= '0;
    end
  end

  // --- The oldest leaves when nothing is missing ---------------------------------------------------
  assign active_o = count_q != '0;
  assign out_valid_o = active_o && missing_q[{head_q, 2'b00}+:4] == 4'd0;
  assign out_item_o = item_q[head_q];
  for (genvar i = 0; i < 4; i++) begin : g_word
    assign out_data_o[i*WIDTH+:WIDTH] = word_q[{head_q, 2'(i)}];
  end

`ifdef HS_FORMAL
`include "gather.svh"
`endif

endmodule
