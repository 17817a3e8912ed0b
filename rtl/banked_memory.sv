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

  logic [BANKS-1:0] read_q;   // banks that give a word that was read in the last cycle
  logic [BANKS-1:0] fault_q;

  always_ff @(posedge clk_i) read_q <= rd_en_i;

  for (genvar b = 0; b < BANKS; b++) begin : g_bank
    logic [BITS-1:0] word_q[0:(1<<ROW_BITS)-1];
    logic [BITS-1:0] data_q;
    logic [WIDTH-1:0] wr_data;

    assign wr_data = wr_data_i[b*WIDTH+:WIDTH];

    always_ff @(posedge clk_i) begin
      if (rd_en_i[b]) data_q <= word_q[rd_row_i[b*ROW_BITS+:ROW_BITS]];
      if (wr_en_i[b]) word_q[wr_row_i[b*ROW_BITS+:ROW_BITS]] <= BITS'({^wr_data, wr_data});
    end
    assign rd_data_o[b*WIDTH+:WIDTH] = data_q[WIDTH-1:0];

    // Of the bank's own register, not of rd_data_o: a simulator then looks at whole words.
    always_ff @(posedge clk_i) begin
      fault_q[b] <= 1'b0;
      if (PARITY && read_q[b] && check_i[b]) fault_q[b] <= ^data_q;
    end
  end
  assign fault_o = fault_q != '0;

`ifdef HS_FORMAL
`include "banked_memory.svh"
`endif

endmodule
