// SPDX-License-Identifier: Apache-2.0
//
// retag: goes over the rows of the vertices that were born while classify was writing marks, and so
// have none yet, and gives them their mark word, a row a cycle.
//
//   * start_i for one cycle with count_i vertices from first_i on; active_o until all are written.

module retag #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned BANK_BITS = 3
) (
    input logic clk_i,
    input logic rst_i,

    input  logic          start_i,
    input  logic [VW-1:0] first_i,
    input  logic [  VW:0] count_i,
    output logic          active_o,

    output logic [(1<<BANK_BITS)-1:0] wr_en_o,
    output logic [  VW-BANK_BITS-1:0] wr_row_o
);

  localparam int unsigned BANKS = 1 << BANK_BITS;

  logic [VW:0] next_q, end_q;  // the first vertex of the row, or first_i; behind the last one

  assign active_o = next_q != end_q;
  assign wr_row_o = next_q[VW-1:BANK_BITS];

  always_comb begin
    for (int b = 0; b < BANKS; b++)
      wr_en_o[b] = active_o && BANK_BITS'(b) >= next_q[BANK_BITS-1:0] &&
          {1'b0, wr_row_o, BANK_BITS'(b)} < end_q;
  end

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      next_q <= {1'b0, first_i};
      end_q  <= {1'b0, first_i} + count_i;
    end else if (active_o) begin
      next_q <= {1'b0, wr_row_o, {BANK_BITS{1'b1}}} + (VW + 1)'(1) < end_q ?
          {1'b0, wr_row_o, {BANK_BITS{1'b1}}} + (VW + 1)'(1) : end_q;
    end
    if (rst_i) begin
      next_q <= '0;
      end_q  <= '0;
    end
  end

`ifdef HS_FORMAL
`include "retag.svh"
`endif

endmodule
