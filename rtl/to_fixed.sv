// SPDX-License-Identifier: Apache-2.0
//
// to_fixed: q = RNE(c * 2^(30-E)): a binary32 number as a fixed-point number of the block.
//
// * In: c_i, finite, and exponent_i = E, with |c| < 2^E and -148 <= E <= 128, with valid_i.
//   Zeros of either sign and subnormals are as good as any other number.
// * Out: q_o, two's complement, S1.30 of the block, |q| <= 2^30, one cycle later; it holds until
//   the next valid_i. -0 becomes 0. One number a cycle, no stalls.
// * Illegal: infinity, NaN, |c| >= 2^E; q_o is then some number.
//
// c is the 24-bit significand times 2^(e-150), so q is the significand times 2^(e-120-E): a shift
// to the left by at most 29 (of 2^-149, at E = -148), or to the right. Both are one shift to the
// left, by e-120-E+26, with the binary point at bit 26. |c| < 2^E says that the result is below
// 2^30 * 2^26, hence 56 bits hold it. Where that shift would be negative, the significand is worth
// less than 2^24 * 2^-26 = 1/4 and rounds to 0 as it does unshifted.
module to_fixed (
    input  logic              clk_i,
    input  logic              valid_i,
    input  logic       [31:0] c_i,
    input  logic signed [9:0] exponent_i,
    output logic       [31:0] q_o
);
  function automatic logic [31:0] convert(input logic [31:0] c, input logic signed [9:0] exponent);
    logic normal;
    logic signed [10:0] shift;
    logic [55:0] wide;  // U(30.26)
    logic [30:0] magnitude;  // U(31.0): up to 2^30, rounding included
    normal = c[30:23] != 8'd0;
    shift = $signed({3'd0, c[30:23]}) + $signed({10'd0, !normal}) - {exponent[9], exponent} - 11'sd94;
    wide = {32'd0, normal, c[22:0]};
    if (shift > 11'sd0) wide = wide << shift[5:0];
    magnitude = {1'b0, wide[55:26]} + {30'd0, wide[25] & (wide[26] | (|wide[24:0]))};
    convert = c[31] ? 32'd0 - {1'b0, magnitude} : {1'b0, magnitude};
  endfunction

  always_ff @(posedge clk_i) if (valid_i) q_o <= convert(c_i, exponent_i);
endmodule
