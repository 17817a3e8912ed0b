// SPDX-License-Identifier: Apache-2.0
//
// FIFOs of 2, 4 and 16 words side by side, so that one binary tests them all: lane i of every
// port is the FIFO with 2, 4, 16 words for i = 0, 1, 2.

module fifo_top (
    input logic clk_i,
    input logic rst_i,

    input  logic [ 2:0] in_valid_i,
    output logic [ 2:0] in_ready_o,
    input  logic [95:0] in_data_i,   // 32 bits a lane
    output logic [ 2:0] out_valid_o,
    input  logic [ 2:0] out_ready_i,
    output logic [95:0] out_data_o,
    output logic [23:0] level_o      // 8 bits a lane
);

  genvar i;
  generate
    for (i = 0; i < 3; i = i + 1) begin : gen_lane
      localparam int unsigned DEPTH = i == 2 ? 16 : 2 << i;
      logic [$clog2(DEPTH):0] level;
      assign level_o[8*i+:8] = 8'(level);
      /* verilator lint_off PINCONNECTEMPTY */
      fifo #(
          .WIDTH(32),
          .DEPTH(DEPTH)
      ) i_fifo (
          .clk_i(clk_i),
          .rst_i(rst_i),
          .in_valid_i(in_valid_i[i]),
          .in_ready_o(in_ready_o[i]),
          .in_data_i(in_data_i[32*i+:32]),
          .out_valid_o(out_valid_o[i]),
          .out_ready_i(out_ready_i[i]),
          .out_data_o(out_data_o[32*i+:32]),
          .level_o(level),
          .fault_o()  // parity has a test of its own
      );
      /* verilator lint_on PINCONNECTEMPTY */
    end
  endgenerate

endmodule
