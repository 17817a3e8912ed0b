// SPDX-License-Identifier: Apache-2.0
//
// Whether edges are short on the screen: up to four at a time, exactly.
//
//   an edge v-w is short if w_v > 0, w_w > 0, and both
//     |x_v w_w - x_w w_v| 8 width  < min_edge w_v w_w
//     |y_v w_w - y_w w_v| 8 height < min_edge w_v w_w
//
// Its ends then are before the eye and less than min_edge/16 pixels apart, across and up: a picture
// is as wide as x/w from -1 to 1.
//
//   * Inputs: x in bits 31:0, y in 63:32, w in 95:64 of the two ends of edge i, at 96i; |component|
//     <= 2^30. use_i says which edges count. The settings min_edge_i, width_i and height_i hold
//     while anything is inside.
//   * all_short_o: all edges that count are short; low if min_edge_i is 0, when nothing is computed.
//     Latency 3 cycles, one set a cycle, no stalls; valid_i only saves power.
//
// With the determinants D = |x_v w_w - x_w w_v| <= 2^61 and P = w_v w_w <= 2^60 the sides have up to 80
// bits. Each factor is split at bit 32: D = U 2^32 + L, D 8 width = U 8 width 2^32 + L 8 width,
// where U <= 2^29, 8 width < 2^19 and L < 2^32. The carry of the second product, its bits from 32
// on, goes to the first one, below 2^49, and the sides compare like numbers of two digits. P by
// min_edge likewise.

module short_edges (
    input logic clk_i,

    // settings
    input logic [15:0] min_edge_i,
    input logic [15:0] width_i,
    input logic [15:0] height_i,

    input logic         valid_i,
    input logic [  3:0] use_i,
    input logic [383:0] from_i,
    input logic [383:0] to_i,

    output logic all_short_o
);

  // --- 1: determinants and products ---------------------------------------------------------------
  function automatic logic [63:0] distance(input logic signed [31:0] a, input logic signed [31:0] a_w,
                                           input logic signed [31:0] b, input logic signed [31:0] b_w);
    logic signed [63:0] difference;
    difference = 64'(a) * 64'(b_w) - 64'(b) * 64'(a_w);
    distance = difference < 64'sd0 ? -difference : difference;
  endfunction

  logic valid_1;
  logic [3:0] use_1;
  logic [4*64-1:0] x_1, y_1;  // U(62.0) each: D across and up
  logic [4*64-1:0] p_1;       // U(61.0) each: P; 0 if an end is not before the eye, and nothing is below

  always_ff @(posedge clk_i) begin
    valid_1 <= valid_i && min_edge_i != 16'd0;
    if (valid_i && min_edge_i != 16'd0) begin
      use_1 <= use_i;
      for (int i = 0; i < 4; i++) begin
        logic signed [31:0] from_w, to_w;
        from_w = from_i[i*96+64+:32];
        to_w = to_i[i*96+64+:32];
        x_1[i*64+:64] <= distance(from_i[i*96+:32], from_w, to_i[i*96+:32], to_w);
        y_1[i*64+:64] <= distance(from_i[i*96+32+:32], from_w, to_i[i*96+32+:32], to_w);
        p_1[i*64+:64] <= from_w > 32'sd0 && to_w > 32'sd0 ? 64'(from_w) * 64'(to_w) : 64'd0;
      end
    end
  end

  // --- 2: both sides, in two digits ---------------------------------------------------------------
  // {upper, lower}: U(64.0), times 2^32, and U(32.0)
  function automatic logic [95:0] scaled(input logic [63:0] number, input logic [18:0] factor);
    logic [63:0] upper, lower;
    lower = 64'(number[31:0]) * 64'(factor);
    upper = 64'(number[63:32]) * 64'(factor) + (lower >> 32);
    scaled = {upper, lower[31:0]};
  endfunction

  logic valid_2;
  logic [3:0] use_2;
  logic [4*64-1:0] x_upper_2, y_upper_2, p_upper_2;
  logic [4*32-1:0] x_lower_2, y_lower_2, p_lower_2;

  always_ff @(posedge clk_i) begin
    valid_2 <= valid_1;
    if (valid_1) begin
      use_2 <= use_1;
      for (int i = 0; i < 4; i++) begin
        {x_upper_2[i*64+:64], x_lower_2[i*32+:32]} <= scaled(x_1[i*64+:64], {width_i, 3'd0});
        {y_upper_2[i*64+:64], y_lower_2[i*32+:32]} <= scaled(y_1[i*64+:64], {height_i, 3'd0});
        {p_upper_2[i*64+:64], p_lower_2[i*32+:32]} <= scaled(p_1[i*64+:64], {3'd0, min_edge_i});
      end
    end
  end

  // --- 3: the verdict -----------------------------------------------------------------------------
  function automatic logic below(input logic [63:0] upper, input logic [31:0] lower,
                                 input logic [63:0] than_upper, input logic [31:0] than_lower);
    below = upper < than_upper || (upper == than_upper && lower < than_lower);
  endfunction

  logic [3:0] is_short;

  always_comb begin
    for (int i = 0; i < 4; i++)
      is_short[i] = below(x_upper_2[i*64+:64], x_lower_2[i*32+:32],
                          p_upper_2[i*64+:64], p_lower_2[i*32+:32]) &&
                    below(y_upper_2[i*64+:64], y_lower_2[i*32+:32],
                          p_upper_2[i*64+:64], p_lower_2[i*32+:32]);
  end

  always_ff @(posedge clk_i) begin
    if (valid_2) all_short_o <= (use_2 & ~is_short) == 4'd0;
    else all_short_o <= 1'b0;
  end

endmodule
