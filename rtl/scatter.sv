// SPDX-License-Identifier: Apache-2.0
//
// Sends up to four words of an item to the banks that they belong to.
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: a mask of the lanes that send a
//     word, their word numbers, and the words. The banks see them from the next cycle on: en_o,
//     row_o and data_o, at most a word a bank and cycle.
//   * A lane's words go out in order, but the lanes do not wait for each other: the order in which
//     words of different lanes reach a bank is not given. Of the lanes that want the same bank in
//     the same cycle the lowest gets it; the others wait (conflict_o).
//   * Rate: at most an item a cycle; less while a lane has WINDOW words waiting.
//   * active_o: a word is inside.

module scatter #(
    // Bits of a word.
    parameter int unsigned WIDTH = 8,
    // Rows of a bank and banks, as powers of two.
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3,
    // Words that a lane holds; a power of two.
    parameter int unsigned WINDOW = 16
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

  logic take;
  logic [3:0] room, waiting, grant;
  logic [4*IB-1:0] index;
  logic [4*WIDTH-1:0] word;
  logic [4*BANK_BITS-1:0] bank;

  assign in_ready_o = &room;
  assign take = in_valid_i && in_ready_o;

  for (genvar i = 0; i < 4; i++) begin : g_lane
    /* verilator lint_off PINCONNECTEMPTY */
    fifo #(
        .WIDTH(IB + WIDTH),
        .DEPTH(WINDOW)
    ) u_words (
        .clk_i,
        .rst_i,
        .in_valid_i(take && in_mask_i[i]),
        .in_ready_o(room[i]),
        .in_data_i({in_data_i[i*WIDTH+:WIDTH], in_index_i[i*IB+:IB]}),
        .out_valid_o(waiting[i]),
        .out_ready_i(grant[i]),
        .out_data_o({word[i*WIDTH+:WIDTH], index[i*IB+:IB]}),
        .level_o()
    );
    /* verilator lint_on PINCONNECTEMPTY */
    assign bank[i*BANK_BITS+:BANK_BITS] = index[i*IB+:BANK_BITS];
  end

  lanes #(
      .BANK_BITS(BANK_BITS)
  ) u_lanes (
      .pending_i(waiting),
      .bank_i(bank),
      .grant_o(grant)
  );
  assign conflict_o = waiting != grant;
  assign active_o = waiting != 4'd0;

  always_comb begin
    en_o   = '0;
    row_o  = '0;
    data_o = '0;
    for (int i = 0; i < 4; i++)
      if (grant[i]) begin
        en_o[bank[i*BANK_BITS+:BANK_BITS]] = 1'b1;
        row_o[32'(bank[i*BANK_BITS+:BANK_BITS])*ROW_BITS+:ROW_BITS] =
            index[i*IB+BANK_BITS+:ROW_BITS];
        data_o[32'(bank[i*BANK_BITS+:BANK_BITS])*WIDTH+:WIDTH] = word[i*WIDTH+:WIDTH];
      end
  end

endmodule
