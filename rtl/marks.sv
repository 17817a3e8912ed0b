// SPDX-License-Identifier: Apache-2.0
//
// Which way corners face: the signs of up to four determinants of (x, y, w), exactly.
//
//   cross = a x b:  det(p, a, b) and det(q, a, b)
//   cross = c x d:  det(r, c, d) and det(s, c, d)
//
//   * Inputs: x in bits 31:0, y in 63:32, w in 95:64 of each vector, |component| <= 2^30. use_i
//     says which of the four determinants (p, q, r, s: bits 0 to 3) count.
//   * front_o: one of them is above zero; back_o: one of them is not. Latency 3 cycles, one set a
//     cycle, no stalls; valid_i only saves power.
//
// A component of a cross product is below 2^61 in magnitude (S62). Its upper part, S31, and its
// lower 31 bits, U31, are multiplied apart, so that no product needs more than 63 bits; a sum of
// three such products stays below 2^63, and the upper sum, plus what the lower one carries,
// decides the sign.

module marks (
    input logic clk_i,

    input logic        valid_i,
    input logic [ 3:0] use_i,
    input logic [95:0] a_i,
    input logic [95:0] b_i,
    input logic [95:0] c_i,
    input logic [95:0] d_i,
    input logic [95:0] p_i,
    input logic [95:0] q_i,
    input logic [95:0] r_i,
    input logic [95:0] s_i,

    output logic front_o,
    output logic back_o
);

  // --- 1: cross products --------------------------------------------------------------------------
  function automatic logic signed [63:0] cross_component(input logic signed [31:0] a,
                                                         input logic signed [31:0] b,
                                                         input logic signed [31:0] c,
                                                         input logic signed [31:0] d);
    cross_component = 64'(a) * 64'(b) - 64'(c) * 64'(d);
  endfunction

  logic valid_1;
  logic [3:0] use_1;
  logic [191:0] ab_1, cd_1;  // three S(62.0) each: x, y, w
  logic [383:0] point_1;     // p, q, r, s

  always_ff @(posedge clk_i) begin
    valid_1 <= valid_i;
    if (valid_i) begin
      use_1 <= use_i;
      point_1 <= {s_i, r_i, q_i, p_i};
      ab_1[0+:64] <= cross_component(a_i[32+:32], b_i[64+:32], a_i[64+:32], b_i[32+:32]);
      ab_1[64+:64] <= cross_component(a_i[64+:32], b_i[0+:32], a_i[0+:32], b_i[64+:32]);
      ab_1[128+:64] <= cross_component(a_i[0+:32], b_i[32+:32], a_i[32+:32], b_i[0+:32]);
      cd_1[0+:64] <= cross_component(c_i[32+:32], d_i[64+:32], c_i[64+:32], d_i[32+:32]);
      cd_1[64+:64] <= cross_component(c_i[64+:32], d_i[0+:32], c_i[0+:32], d_i[64+:32]);
      cd_1[128+:64] <= cross_component(c_i[0+:32], d_i[32+:32], c_i[32+:32], d_i[0+:32]);
    end
  end

  // --- 2: dot products, in two parts ----------------------------------------------------------------
  logic valid_2;
  logic [3:0] use_2;
  logic [255:0] upper_2, lower_2;  // four S(63.0) each

  always_ff @(posedge clk_i) begin
    valid_2 <= valid_1;
    if (valid_1) begin
      use_2 <= use_1;
      for (int i = 0; i < 4; i++) begin
        logic signed [63:0] upper, lower;
        upper = '0;
        lower = '0;
        for (int k = 0; k < 3; k++) begin
          logic signed [63:0] component, coordinate;
          component = i < 2 ? ab_1[k*64+:64] : cd_1[k*64+:64];
          coordinate = {{32{point_1[i*96+k*32+31]}}, point_1[i*96+k*32+:32]};
          upper = upper + coordinate * (component >>> 31);
          lower = lower + coordinate * $signed({33'd0, component[30:0]});
        end
        upper_2[i*64+:64] <= upper;
        lower_2[i*64+:64] <= lower;
      end
    end
  end

  // --- 3: signs ---------------------------------------------------------------------------------------
  // upper 2^31 + lower > 0, where lower = carry 2^31 + rest and 0 <= rest < 2^31.
  logic [3:0] positive;

  always_comb begin
    for (int i = 0; i < 4; i++) begin
      logic signed [63:0] sum;
      sum = $signed(upper_2[i*64+:64]) + ($signed(lower_2[i*64+:64]) >>> 31);
      positive[i] = sum > 64'sd0 || (sum == 64'sd0 && lower_2[i*64+:31] != 31'd0);
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_2) begin
      front_o <= |(use_2 & positive);
      back_o  <= |(use_2 & ~positive);
    end
  end

endmodule
