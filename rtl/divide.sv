// SPDX-License-Identifier: Apache-2.0
//
// y = RNE(x / denominator): the rounding of every mask, exactly, to nearest even.
//
//   denominator = n^2        of face and vertex points
//                 n^2 + 5n   of limit positions (limit_i)
//
//   * One division a cycle, latency 4 cycles, no stalls. n from 1 to 255, |x| <= denominator 2^30;
//     anything else gives a number without meaning. valid_i only saves power.
//   * A face point is the first with x = n times the sum.
//
// Multiplication by a reciprocal, exact because it is wide enough. Denominators are at most 66300.
// Let d = denominator 2^s with s such that 2^16 < d <= 2^17, and a = |x| 2^s <= d 2^30 <= 2^47. With
// r = ceil(2^64 / d) = (2^64 + e) / d, 0 <= e < d, it is a r / 2^64 = a/d + a e / (d 2^64), and
// a e / 2^64 < d^2 2^30 / 2^64 <= 1. So the error is below 1/d, the distance of a/d from the next
// integer above it unless it is one, and floor(a r / 2^64) = floor(a / d). The remainder then
// decides the rounding.

module divide (
    input logic clk_i,

    input logic               valid_i,
    input logic               limit_i,
    input logic        [ 7:0] n_i,
    input logic signed [47:0] x_i,

    output logic signed [31:0] y_o
);

  // --- 1: magnitude, scaled ----------------------------------------------------------------------
  logic valid_1, negative_1;
  logic [47:0] a_1, r_1;  // U(48.0)
  logic [17:0] d_1;       // U(18.0)
  logic [46:0] magnitude;
  logic [16:0] denominator;
  logic [4:0] s;
  logic [47:0] r;

  assign magnitude = x_i[47] ? -x_i[46:0] : x_i[46:0];
  assign denominator = 17'(n_i) * (17'(n_i) + (limit_i ? 17'd5 : 17'd0));
  assign {s, r} = hs_pkg::RECIPROCALS[53*32'({limit_i, n_i})+:53];

  // --- 2: partial products; the lowest's low bits only matter by their carry ----------------------
  logic valid_2, negative_2;
  logic [47:0] a_2;
  logic [17:0] d_2;
  logic [46:0] high_2;    // U(47.0), times 2^48: a's upper half is at most 2^23
  logic [48:0] middle_2;  // U(49.0), times 2^24
  logic [23:0] low_2;      // U(24.0), times 2^24: its upper half

  // --- 3: quotient and remainder -------------------------------------------------------------------
  logic valid_3, negative_3, up;
  logic [31:0] q_3;
  logic [17:0] d_3, remainder_3;
  logic [31:0] quotient;

  // floor(a r / 2^64); a r / 2^48 has 47 bits, as the quotient is at most 2^30.
  assign quotient = 32'((high_2 + 47'((50'(middle_2) + 50'(low_2)) >> 24)) >> 16);
  assign up = {remainder_3, 1'b0} > {1'b0, d_3} ||
                         ({remainder_3, 1'b0} == {1'b0, d_3} && q_3[0]);

  always_ff @(posedge clk_i) begin
    valid_1 <= valid_i;
    valid_2 <= valid_1;
    valid_3 <= valid_2;
    if (valid_i) begin
      negative_1 <= x_i[47];
      a_1 <= 48'(magnitude) << s;
      r_1 <= r;
      d_1 <= 18'(denominator) << s;
    end
    if (valid_1) begin
      negative_2 <= negative_1;
      a_2 <= a_1;
      d_2 <= d_1;
      high_2 <= 47'(a_1[47:24]) * 47'(r_1[47:24]);
      middle_2 <= 49'(a_1[47:24]) * 49'(r_1[23:0]) + 49'(a_1[23:0]) * 49'(r_1[47:24]);
      low_2 <= 24'((48'(a_1[23:0]) * 48'(r_1[23:0])) >> 24);
    end
    if (valid_2) begin
      negative_3 <= negative_2;
      q_3 <= quotient;
      d_3 <= d_2;
      remainder_3 <= 18'(a_2 - 48'(quotient) * 48'(d_2));
    end
    if (valid_3)
      y_o <= negative_3 ? -(q_3 + 32'(up)) : q_3 + 32'(up);
  end

endmodule
