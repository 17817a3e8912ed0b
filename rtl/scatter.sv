// SPDX-License-Identifier: Apache-2.0
//
// Sends up to four words of an item to the banks that they belong to.
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: a mask of the lanes that send a
//     word, their word numbers, and the words. The banks see it from the next cycle on: en_o, row_o
//     and data_o, a word a bank and cycle.
//   * The words of up to 2^WINDOW_BITS items compete for the banks; in each cycle a bank gets the
//     oldest one that wants it (of an item, that of the lowest lane), and of those at most LANES
//     are sent, the oldest. So words of one bank keep their order, and an item whose banks are busy holds up nobody whose banks are not, until the
//     window is full.
//   * Rate: an item a cycle, as long as no bank is wanted more often than once a cycle over a
//     window's length. conflict_o: a word waits. active_o: a word is inside.

module scatter #(
    // Bits of a word.
    parameter int unsigned WIDTH = 8,
    // Rows of a bank and banks, as powers of two.
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3,
    // Items inside, as a power of two; 1 or more.
    parameter int unsigned WINDOW_BITS = 3,
    // Words a cycle, 1 or more.
    parameter int unsigned LANES = 8
) (
    input logic clk_i,
    input logic rst_i,

    // items in
    input  logic                              in_valid_i,
    output logic                              in_ready_o,
    input  logic [                       3:0] in_mask_i,
    input  logic [4*(ROW_BITS+BANK_BITS)-1:0] in_index_i,
    input  logic [               4*WIDTH-1:0] in_data_i,

    // banks
    output logic [         (1<<BANK_BITS)-1:0] en_o,
    output logic [ROW_BITS*(1<<BANK_BITS)-1:0] row_o,
    output logic [   WIDTH*(1<<BANK_BITS)-1:0] data_o,

    output logic conflict_o,
    output logic active_o
);

  localparam int unsigned IB = ROW_BITS + BANK_BITS;
  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned WINDOW = 1 << WINDOW_BITS;
  localparam int unsigned SB = WINDOW_BITS + 2;  // a slot's lane: {slot, lane}

  // The window is a ring of slots. Items enter at tail_q, where the oldest one was: it may enter as
  // soon as that one has nothing left to send.
  logic [WINDOW_BITS-1:0] tail_q;
  logic [IB-1:0] index_q[0:4*WINDOW-1];
  logic [WIDTH-1:0] word_q[0:4*WINDOW-1];
  logic [4*WINDOW-1:0] pending_q, sent;
  logic take;

  assign in_ready_o = (pending_q[{tail_q, 2'b00}+:4] & ~sent[{tail_q, 2'b00}+:4]) == 4'd0;
  assign take = in_valid_i && in_ready_o;
  assign active_o = pending_q != '0;
  assign conflict_o = (pending_q & ~sent) != '0;

  always_comb begin
    logic [SB-1:0] at;
    logic [IB-1:0] index;
    int unsigned served;
    at = '0;
    index = '0;
    served = 0;
    sent = '0;
    en_o = '0;
    row_o = '0;
    data_o = '0;
    if (pending_q != '0)
      for (int a = 0; a < WINDOW; a++)
        for (int i = 0; i < 4; i++) begin
          at = {tail_q + WINDOW_BITS'(a), 2'(i)};
          index = index_q[at];
          if (pending_q[at] && !en_o[index[BANK_BITS-1:0]] &&
              (LANES >= BANKS || served < LANES)) begin
            if (LANES < BANKS) served = served + 1;
            sent[at] = 1'b1;
            en_o[index[BANK_BITS-1:0]] = 1'b1;
            row_o[32'(index[BANK_BITS-1:0])*ROW_BITS+:ROW_BITS] = index[IB-1:BANK_BITS];
            data_o[32'(index[BANK_BITS-1:0])*WIDTH+:WIDTH] = word_q[at];
          end
        end
  end

  always_ff @(posedge clk_i) begin
    pending_q <= pending_q & ~sent;
    if (take) begin
      for (int i = 0; i < 4; i++) begin
        index_q[{tail_q, 2'(i)}] <= in_index_i[i*IB+:IB];
        word_q[{tail_q, 2'(i)}] <= in_data_i[i*WIDTH+:WIDTH];
      end
      pending_q[{tail_q, 2'b00}+:4] <= in_mask_i;
      tail_q <= tail_q + 1'b1;
    end
    if (rst_i) begin
      pending_q <= '0;
      tail_q <= '0;
    end
  end

`ifdef HS_FORMAL
`include "scatter.svh"
`endif

endmodule
