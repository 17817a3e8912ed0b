// SPDX-License-Identifier: Apache-2.0
//
// send_groups: packs vertices that leave side by side into groups of four, the most that emit takes
// at a time.
//
//   up to 4 vertices --> rest of 0 to 3 and these behind them --> FIFO of groups --> emit
//                                                '--> behind the last: one by one
//
//   * count_i vertices a cycle, 0 to 4, in the lowest lanes. Never refused; stall_o asks the source to
//     stop: as many as make three more groups may come.
//   * Groups leave in order, always full (group_*). When nothing comes any more (end_i, level), what
//     is left over, 0 to 3 vertices, leaves one by one (single_*): whatever follows may join them in
//     a group of the stream.
//   * active_o: something is inside. end_i must not be set while vertices are on their way here.

module send_groups #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned GROUPS = 8,  // that wait for emit; 8 or more
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,

    input  logic [           2:0] count_i,
    input  logic [4*(VW+128)-1:0] lanes_i,  // {vertex, position}
    output logic                  stall_o,
    input  logic                  end_i,

    output logic            group_valid_o,
    input  logic            group_ready_i,
    output logic [4*VW-1:0] group_vertex_o,
    output logic [   511:0] group_position_o,

    output logic          single_valid_o,
    input  logic          single_ready_i,
    output logic [VW-1:0] single_vertex_o,
    output logic [ 127:0] single_position_o,

    output logic active_o,
    output logic fault_o
);

  localparam int unsigned WORD = VW + 128;  // {vertex, position}

  logic [4*WORD-1:0] lanes_q;
  logic [2:0] count_q;

  always_ff @(posedge clk_i) begin
    count_q <= count_i;
    if (count_i != 3'd0) lanes_q <= lanes_i;
    if (rst_i) count_q <= 3'd0;
  end

  // --- Behind what is left of those before ---------------------------------------------------------
  logic [3*WORD-1:0] rest_q;
  logic [1:0] rest_count_q;
  logic [7*WORD-1:0] window;
  logic [2:0] total;
  logic full, drop;

  assign total = {1'b0, rest_count_q} + count_q;
  assign full = total[2];

  always_comb begin
    unique case (rest_count_q)
      2'd0: window = {{3 * WORD{1'b0}}, lanes_q};
      2'd1: window = {{2 * WORD{1'b0}}, lanes_q, rest_q[0+:WORD]};
      2'd2: window = {{WORD{1'b0}}, lanes_q, rest_q[0+:2*WORD]};
      default: window = {lanes_q, rest_q};
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (count_q != 3'd0) begin
      rest_q <= full ? window[4*WORD+:3*WORD] : window[0+:3*WORD];
      rest_count_q <= total[1:0];
    end else if (drop) begin
      rest_q <= {{WORD{1'b0}}, rest_q[WORD+:2*WORD]};
      rest_count_q <= rest_count_q - 2'd1;
    end
    if (rst_i) rest_count_q <= 2'd0;
  end

  // --- Groups --------------------------------------------------------------------------------------
  logic [4*WORD-1:0] group;
  logic [$clog2(GROUPS):0] level;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(4 * WORD),
      .DEPTH(GROUPS), .PARITY(PARITY)
  ) u_groups (
      .fault_o(fault_o),
      .clk_i, .rst_i, .in_valid_i(count_q != 3'd0 && full),
      .in_ready_o(),  // stall_o keeps it high
      .in_data_i(window[0+:4*WORD]), .out_valid_o(group_valid_o), .out_ready_i(group_ready_i),
      .out_data_o(group), .level_o(level)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  for (genvar i = 0; i < 4; i++) begin : g_lane
    assign {group_vertex_o[i*VW+:VW], group_position_o[i*128+:128]} = group[i*WORD+:WORD];
  end
  assign stall_o = level > ($clog2(GROUPS) + 1)'(GROUPS - 5);

  // --- The last ones -------------------------------------------------------------------------------
  assign single_valid_o = end_i && count_q == 3'd0 && rest_count_q != 2'd0 && !group_valid_o;
  assign {single_vertex_o, single_position_o} = rest_q[0+:WORD];
  assign drop = single_valid_o && single_ready_i;
  assign active_o = count_q != 3'd0 || rest_count_q != 2'd0 || group_valid_o;

`ifdef HS_FORMAL
`include "send_groups.svh"
`endif

endmodule
