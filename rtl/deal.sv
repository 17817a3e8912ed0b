// SPDX-License-Identifier: Apache-2.0
//
// Deals packets out to pipelines. Data go past it.
//
//   * A packet goes, from its first beat to its last one, to the first pipeline that is ready for it,
//     in turn behind the one that got the packet before. Between packets in_ready_o says that one is.
//   * No latency. in_ready_o follows from registers and the pipelines' ready alone.

module deal #(
    // Pipelines, 1 to 8.
    parameter int unsigned VIEWS = 1
) (
    input logic clk_i,
    input logic rst_i,

    input  logic in_valid_i,
    input  logic in_last_i,
    output logic in_ready_o,

    output logic [VIEWS-1:0] out_valid_o,
    input  logic [VIEWS-1:0] out_ready_i
);

  logic open_q;  // within a packet
  logic [VIEWS-1:0] at_q;  // who got the latest packet
  logic [VIEWS-1:0] at, behind;

  // The lowest of those behind at_q, else the lowest of all.
  always_comb begin
    behind = out_ready_i & ~(at_q | (at_q - VIEWS'(1)));
    at = behind != '0 ? behind & (~behind + VIEWS'(1)) : out_ready_i & (~out_ready_i + VIEWS'(1));
    if (open_q) at = at_q;
  end

  assign in_ready_o = (at & out_ready_i) != '0;
  assign out_valid_o = in_valid_i ? at : '0;

  always_ff @(posedge clk_i) begin
    if (in_valid_i && in_ready_o) begin
      at_q   <= at;
      open_q <= !in_last_i;
    end
    if (rst_i) begin
      open_q <= 1'b0;
      at_q   <= VIEWS'(1) << (VIEWS - 1);
    end
  end

`ifdef HS_FORMAL
`include "deal.svh"
`endif

endmodule
