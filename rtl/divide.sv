// SPDX-License-Identifier: Apache-2.0
//
// y = RNE(x / n^2): the rounding of every mask, exactly, to nearest even.
//
//   * One division a cycle, latency 4 cycles, no stalls. n from 1 to 255, |x| <= n^2 2^30; anything else
//     gives a number without meaning. valid_i only saves power.
//   * A face point is the same with x = n times the sum.
//
// Multiplication by a reciprocal, exact because it is wide enough. Let d = n^2 2^s with s such that
// 2^15 < d <= 2^16, and a = |x| 2^s <= d 2^30 <= 2^46. With r = ceil(2^62 / d) = (2^62 + e) / d,
// 0 <= e < d, it is a r / 2^62 = a/d + a e / (d 2^62), and a e / 2^62 < d^2 2^30 / 2^62 <= 1. So
// the error is below 1/d, the distance of a/d from the next integer above it unless it is one, and
// floor(a r / 2^62) = floor(a / d). The remainder then decides the rounding.

module divide (
    input logic clk_i,

    input logic               valid_i,
    input logic        [ 7:0] n_i,
    input logic signed [47:0] x_i,

    output logic signed [31:0] y_o
);

  // --- 1: magnitude, scaled ----------------------------------------------------------------------
  logic valid_1, negative_1;
  logic [46:0] a_1, r_1;  // U(47.0)
  logic [16:0] d_1;       // U(17.0)
  logic [46:0] magnitude;
  logic [4:0] s;
  logic [46:0] r;

  assign magnitude = x_i[47] ? -x_i[46:0] : x_i[46:0];
  assign {s, r} = hs_pkg::RECIPROCALS[52*32'(n_i)+:52];

  // --- 2: partial products; the lowest's low bits only matter by their carry ----------------------
  logic valid_2, negative_2;
  logic [46:0] a_2;
  logic [16:0] d_2;
  logic [45:0] high_2;    // U(46.0), times 2^48
  logic [48:0] middle_2;  // U(49.0), times 2^24
  logic [23:0] low_2;      // U(24.0), times 2^24: its upper half

  // --- 3: quotient and remainder -------------------------------------------------------------------
  logic valid_3, negative_3, up;
  logic [31:0] q_3;
  logic [16:0] d_3, remainder_3;
  logic [31:0] quotient;

  // floor(a r / 2^62); a r / 2^48 has 46 bits, as the quotient is at most 2^30.
  assign quotient = 32'((46'(high_2) + 46'((50'(middle_2) + 50'(low_2)) >> 24)) >> 14);
  assign up = {remainder_3, 1'b0} > {1'b0, d_3} ||
                         ({remainder_3, 1'b0} == {1'b0, d_3} && q_3[0]);

  always_ff @(posedge clk_i) begin
    valid_1 <= valid_i;
    valid_2 <= valid_1;
    valid_3 <= valid_2;
    if (valid_i) begin
      negative_1 <= x_i[47];
      a_1 <= magnitude << s;
      r_1 <= r;
      d_1 <= (17'(n_i) * 17'(n_i)) << s;
    end
    if (valid_1) begin
      negative_2 <= negative_1;
      a_2 <= a_1;
      d_2 <= d_1;
      high_2 <= 46'(a_1[46:24]) * 46'(r_1[46:24]);
      middle_2 <= 49'(a_1[46:24]) * 49'(r_1[23:0]) + 49'(a_1[23:0]) * 49'(r_1[46:24]);
      low_2 <= 24'((48'(a_1[23:0]) * 48'(r_1[23:0])) >> 24);
    end
    if (valid_2) begin
      negative_3 <= negative_2;
      q_3 <= quotient;
      d_3 <= d_2;
      remainder_3 <= 17'(a_2 - 47'(quotient) * 47'(d_2));
    end
    if (valid_3)
      y_o <= negative_3 ? -(q_3 + 32'(up)) : q_3 + 32'(up);
  end

endmodule
