// SPDX-License-Identifier: Apache-2.0
//
// Sends up to four words of an item to the banks that they belong to.
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: a mask of the lanes that send a
//     word, their word numbers, and the words. The banks see it from the next cycle on: en_o, row_o
//     and data_o, a word a bank and cycle, lanes of the same bank in ascending order.
//   * Rate: an item a cycle if its lanes' banks differ; else as many cycles as the busiest bank has
//     lanes (conflict_o in each cycle beyond the first).
//   * active_o: an item is inside.

module scatter #(
    // Bits of a word.
    parameter int unsigned WIDTH = 8,
    // Rows of a bank and banks, as powers of two.
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3
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

  logic valid_q, issued;
  logic [3:0] pending_q, grant;
  logic [4*IB-1:0] index_q;
  logic [4*WIDTH-1:0] word_q;
  logic [4*BANK_BITS-1:0] bank;

  for (genvar i = 0; i < 4; i++) begin : g_bank_of
    assign bank[i*BANK_BITS+:BANK_BITS] = index_q[i*IB+:BANK_BITS];
  end

  lanes #(
      .BANK_BITS(BANK_BITS)
  ) u_lanes (
      .pending_i(pending_q),
      .bank_i(bank),
      .grant_o(grant)
  );

  assign issued = (pending_q & ~grant) == 4'd0;
  assign conflict_o = valid_q && !issued;
  assign in_ready_o = !valid_q || issued;
  assign active_o = valid_q;

  always_ff @(posedge clk_i) begin
    if (in_valid_i && in_ready_o) begin
      valid_q <= 1'b1;
      pending_q <= in_mask_i;
      index_q <= in_index_i;
      word_q <= in_data_i;
    end else begin
      pending_q <= pending_q & ~grant;
      if (issued) valid_q <= 1'b0;
    end
    if (rst_i) begin
      valid_q   <= 1'b0;
      pending_q <= 4'd0;
    end
  end

  always_comb begin
    en_o   = '0;
    row_o  = '0;
    data_o = '0;
    for (int i = 0; i < 4; i++)
      if (grant[i]) begin
        en_o[bank[i*BANK_BITS+:BANK_BITS]] = 1'b1;
        row_o[32'(bank[i*BANK_BITS+:BANK_BITS])*ROW_BITS+:ROW_BITS] =
            index_q[i*IB+BANK_BITS+:ROW_BITS];
        data_o[32'(bank[i*BANK_BITS+:BANK_BITS])*WIDTH+:WIDTH] = word_q[i*WIDTH+:WIDTH];
      end
  end

endmodule
