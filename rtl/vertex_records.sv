// SPDX-License-Identifier: Apache-2.0
//
// vertex_records: the part of emit that groups vertices. Up to four that follow each other share a
// VERTICES record, with their numbers; their positions follow it, a record each.
//
//   vertex of the group    1st    2nd    3rd, and the 4th is known to come    4th
//   records                 -      -     VERTICES, 3 positions                its position
//
//   * A vertex that nothing joins ends its group: VERTICES and the positions of all so far leave
//     with it. So no vertex gives more than 4 records.
//   * The vertex shown is taken with take_i; records_o and count_o are what it gives then.
//   * next_joins_i: what comes next, if next_valid_i, is a vertex of the same generation. While
//     waits_o the vertex must not be taken: next_valid_i is low, and it matters what follows.

module vertex_records (
    input logic clk_i,
    input logic rst_i,

    // The vertex.
    input logic         take_i,
    input logic [  7:0] generation_i,
    input logic [ 23:0] number_i,
    input logic [127:0] position_i,    // x, y, z, w from bit 0 up, binary32

    // What comes behind it.
    input  logic        next_valid_i,
    input  logic        next_joins_i,
    input  logic [23:0] next_number_i,
    output logic        waits_o,

    // Record k of count_o in bits 128*k+127:128*k.
    output logic [  2:0] count_o,   // 0, 1, 2, 3 or 4
    output logic [511:0] records_o
);

  logic [1:0] grouped_q;  // vertices of the group before this one
  logic [47:0] numbers_q;  // the numbers of the first two
  logic [255:0] positions_q;  // and their positions
  logic joined, fourth, sends;
  logic [95:0] numbers;
  logic [383:0] positions;
  logic [2:0] members;  // as the VERTICES record says it

  assign joined = next_valid_i && next_joins_i;
  // The fourth of a group has no one to wait for, its VERTICES record is gone already.
  assign fourth = grouped_q == 2'd3;
  assign waits_o = !fourth && !next_valid_i;
  assign sends = !fourth && (!joined || grouped_q == 2'd2);
  assign members = {1'b0, grouped_q} + 3'd1 + {2'd0, joined};

  always_comb begin
    unique case (grouped_q)
      2'd0: numbers = {72'd0, number_i};
      2'd1: numbers = {48'd0, number_i, numbers_q[23:0]};
      default: numbers = {joined ? next_number_i : 24'd0, number_i, numbers_q};
    endcase
    unique case (grouped_q)
      2'd0: positions = {256'd0, position_i};
      2'd1: positions = {128'd0, position_i, positions_q[127:0]};
      default: positions = {position_i, positions_q};
    endcase
  end

  always_comb begin
    records_o = 512'd0;
    count_o   = 3'd0;
    if (sends) begin
      records_o = {
        positions, numbers,
        9'(hs_pkg::TAG), hs_pkg::RECORD_VERTICES, 1'b0, members, 8'd0, generation_i
      };
      count_o = 3'd2 + {1'b0, grouped_q};
    end else if (fourth) begin
      records_o[127:0] = position_i;
      count_o = 3'd1;
    end
  end

  always_ff @(posedge clk_i) begin
    if (take_i) begin
      grouped_q   <= fourth || !joined ? 2'd0 : grouped_q + 2'd1;
      numbers_q   <= numbers[47:0];
      positions_q <= positions[255:0];
    end
    if (rst_i) grouped_q <= 2'd0;
  end

`ifndef YOSYS
  next_is_known :
  assert property (@(posedge clk_i) disable iff (rst_i) take_i |-> !waits_o)
  else $error("vertex_records: a vertex was taken before it was known what follows");
`endif

endmodule
