// SPDX-License-Identifier: Apache-2.0
//
// A memory of 2^BANK_BITS banks, each with one read and one write port. Word i is in bank
// i mod 2^BANK_BITS, row i / 2^BANK_BITS.
//
//   * rd_data_o of a bank belongs to the row read in the cycle before; it holds while rd_en_i of
//     that bank is low.
//   * A read in the cycle of a write to the same row gives the old word.
//   * Contents after reset: whatever was there.
//   * With PARITY every word has a bit more, so that its ones are even. fault_o, two cycles behind a
//     read: they were not, in a word that check_i said was of use (in the cycle of rd_data_o; a word that
//     was never written has no parity).

module banked_memory #(
    // Bits of a word.
    parameter int unsigned WIDTH = 128,
    // Rows of a bank, as a power of two.
    parameter int unsigned ROW_BITS = 16,
    // Banks, as a power of two.
    parameter int unsigned BANK_BITS = 3,
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,

    input  logic [       (1<<BANK_BITS)-1:0] rd_en_i,
    input  logic [ROW_BITS*(1<<BANK_BITS)-1:0] rd_row_i,
    output logic [   WIDTH*(1<<BANK_BITS)-1:0] rd_data_o,
    input  logic [       (1<<BANK_BITS)-1:0] check_i,
    output logic fault_o,

    input logic [       (1<<BANK_BITS)-1:0] wr_en_i,
    input logic [ROW_BITS*(1<<BANK_BITS)-1:0] wr_row_i,
    input logic [   WIDTH*(1<<BANK_BITS)-1:0] wr_data_i
);

  localparam int unsigned BITS = WIDTH + 32'(PARITY);
  localparam int unsigned BANKS = 1 << BANK_BITS;

  logic [BANKS-1:0] parity;  // of the words given now

  for (genvar b = 0; b < BANKS; b++) begin : g_bank
    logic [BITS-1:0] word_q[0:(1<<ROW_BITS)-1];
    logic [BITS-1:0] data_q;

    always_ff @(posedge clk_i) begin
      if (rd_en_i[b]) data_q <= word_q[rd_row_i[b*ROW_BITS+:ROW_BITS]];
      if (wr_en_i[b])
        word_q[wr_row_i[b*ROW_BITS+:ROW_BITS]] <=
            BITS'({^wr_data_i[b*WIDTH+:WIDTH], wr_data_i[b*WIDTH+:WIDTH]});
    end
    assign rd_data_o[b*WIDTH+:WIDTH] = data_q[WIDTH-1:0];
    assign parity[b] = data_q[BITS-1];
  end

  // --- Parity, where a word was read that is of use -----------------------------------------------
  logic [BANKS-1:0] read_q;
  logic fault_q;

  always_ff @(posedge clk_i) begin
    read_q  <= rd_en_i;
    fault_q <= 1'b0;
    if (PARITY && (read_q & check_i) != '0)
      for (int b = 0; b < BANKS; b++)
        if (read_q[b] && check_i[b] && ^rd_data_o[b*WIDTH+:WIDTH] != parity[b]) fault_q <= 1'b1;
  end
  assign fault_o = fault_q;

`ifdef HS_FORMAL
`include "banked_memory.svh"
`endif

endmodule
