// SPDX-License-Identifier: Apache-2.0
//
// to_float: c = q * 2^(E-30), rounded to nearest even: a fixed-point number of the block as
// binary32. Combinational.
//
// * In: q_i, two's complement, S1.30 of the block; exponent_i = E, -148 <= E <= 128.
// * Out: c_o. Subnormal results are delivered as such, rounded once. q = 0 gives +0.
//
// It never overflows on the pipeline's numbers. For E < 128, |c| <= 2^E <= 2^127. For E = 128, the
// block was made from binary32 numbers, of at most (2^24-1) * 2^104, so |q| <= 2^30 - 2^6 to begin
// with; a mask takes a convex combination, and rounding it to an integer cannot pass the integer
// 2^30 - 2^6. So |c| never exceeds the largest binary32 number. (A larger |q| at E = 128 is
// illegal; from 2^30 - 2^5 on it gives infinity.)
module to_float (
    input  logic       [31:0] q_i,
    input  logic signed [9:0] exponent_i,
    output logic       [31:0] c_o
);
  function automatic logic [31:0] convert(input logic [31:0] q, input logic signed [9:0] exponent);
    logic signed [9:0] e;  // biased exponent of the leading one
    logic signed [9:0] below;
    logic [31:0] n;  // U(1.31): |q|, leading one first
    logic [31:0] kept;
    logic [30:0] exact;  // exponent field and fraction, before rounding
    logic sticky;
    n = q[31] ? 32'd0 - q : q;
    // Bit 31 of |q| is worth 2^(31+E-30); 127 is binary32's bias.
    e = exponent + 10'sd128;
    if (n[31:16] == 16'd0) begin
      n = n << 16;
      e = e - 10'sd16;
    end
    if (n[31:24] == 8'd0) begin
      n = n << 8;
      e = e - 10'sd8;
    end
    if (n[31:28] == 4'd0) begin
      n = n << 4;
      e = e - 10'sd4;
    end
    if (n[31:30] == 2'd0) begin
      n = n << 2;
      e = e - 10'sd2;
    end
    if (!n[31]) begin
      n = n << 1;
      e = e - 10'sd1;
    end
    if (e < 10'sd1) begin
      // Subnormal: the leading one moves to where exponent 1 has it; beyond 31 places |c| is less
      // than a quarter of the least subnormal, and the place of the sticky bit does not matter.
      below = 10'sd1 - e;
      if (below > 10'sd31) below = 10'sd31;
      kept = n >> below[4:0];
      sticky = (kept << below[4:0]) != n;
      exact = {8'd0, kept[30:8]};
    end else begin
      kept = n;
      sticky = 1'b0;
      exact = {e[7:0], kept[30:8]};
    end
    // A carry out of the fraction runs into the exponent field, as it should.
    if (q == 32'd0) convert = 32'd0;
    else convert = {q[31], exact + {30'd0, kept[7] & (kept[8] | (|kept[6:0]) | sticky)}};
  endfunction

  assign c_o = convert(q_i, exponent_i);
endmodule
