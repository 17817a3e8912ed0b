// SPDX-License-Identifier: Apache-2.0
//
// Collects the beats of several pipelines into one stream.
//
//   * Of those that have a beat, one is taken a cycle, in turn behind the one that was taken before.
//     It shows at the output in the next cycle, and stays until it is taken there.
//   * With one pipeline it is a wire.

module collect #(
    // Pipelines, 1 to 8.
    parameter int unsigned VIEWS = 1,
    // Bits of a beat.
    parameter int unsigned WIDTH = 593
) (
    /* verilator lint_off UNUSEDSIGNAL */
    input logic clk_i,  // a wire needs none
    input logic rst_i,
    /* verilator lint_on UNUSEDSIGNAL */

    input  logic [      VIEWS-1:0] in_valid_i,
    output logic [      VIEWS-1:0] in_ready_o,
    input  logic [WIDTH*VIEWS-1:0] in_data_i,

    output logic             out_valid_o,
    input  logic             out_ready_i,
    output logic [WIDTH-1:0] out_data_o
);

  generate
    if (VIEWS == 1) begin : g_wire
      assign out_valid_o = in_valid_i[0];
      assign in_ready_o  = out_ready_i;
      assign out_data_o  = in_data_i;
    end else begin : g_turns
      logic [VIEWS-1:0] at_q, at, behind;
      logic free;
      logic [WIDTH-1:0] data;

      assign free = !out_valid_o || out_ready_i;
      assign in_ready_o = free ? at : '0;

      always_comb begin
        behind = in_valid_i & ~(at_q | (at_q - VIEWS'(1)));
        at = behind != '0 ? behind & (~behind + VIEWS'(1)) : in_valid_i & (~in_valid_i + VIEWS'(1));
        data = '0;
        for (int p = 0; p < VIEWS; p++) if (at[p]) data = in_data_i[WIDTH*p+:WIDTH];
      end

      always_ff @(posedge clk_i) begin
        if (free) out_valid_o <= in_valid_i != '0;
        if (free && in_valid_i != '0) begin
          out_data_o <= data;
          at_q <= at;
        end
        if (rst_i) begin
          out_valid_o <= 1'b0;
          at_q <= VIEWS'(1) << (VIEWS - 1);
        end
      end
    end
  endgenerate

`ifdef HS_FORMAL
`include "collect.svh"
`endif

endmodule
