// SPDX-License-Identifier: Apache-2.0
//
// fp_mul: y = a * b in IEEE-754 binary32, rounded to nearest, ties to even.
//
// * In: a_i and b_i, any bit patterns, with valid_i. Subnormals count in full.
// * Out: y_o with valid_o, 3 cycles later, one product a cycle. Subnormal products are
//   delivered as such, rounded once.
// * Any NaN result is 32'h7fc00000, whatever the operands' payloads were.
// * No stalls, no exception flags. y_o means nothing without valid_o.
//
//     multiply     the exact product of the significands, and the sum of the exponents
//     normalize    to a leading one, or to the exponent of the subnormal numbers
//     pack         round, assemble
//
// Each step is a function, called only for a valid operand, so that a simulator skips idle units.
module fp_mul (
    input  logic        clk_i,
    input  logic        rst_i,
    input  logic        valid_i,
    input  logic [31:0] a_i,
    input  logic [31:0] b_i,
    output logic        valid_o,
    output logic [31:0] y_o
);
  // ---- 1: multiply ------------------------------------------------------------------------------
  // {nan, infinite, sign, biased exponent of the product's bit 47 (10, signed),
  //  product (48, U(2.46))}.
  function automatic logic [60:0] multiply(input logic [31:0] a, input logic [31:0] b);
    logic normal_a, normal_b, nan, infinite;
    logic [9:0] exponent;  // -124 to 384
    logic [47:0] product;
    normal_a = a[30:23] != 8'd0;
    normal_b = b[30:23] != 8'd0;
    nan = a[30:0] > 31'h7f800000 || b[30:0] > 31'h7f800000 ||
          (a[30:0] == 31'h7f800000 && b[30:0] == 31'd0) ||
          (b[30:0] == 31'h7f800000 && a[30:0] == 31'd0);
    infinite = a[30:23] == 8'd255 || b[30:23] == 8'd255;
    // A subnormal has the exponent of the smallest normal number, and no leading one.
    exponent = {2'd0, a[30:23]} + {9'd0, !normal_a} + {2'd0, b[30:23]} + {9'd0, !normal_b} - 10'd126;
    product = {24'd0, normal_a, a[22:0]} * {24'd0, normal_b, b[22:0]};
    multiply = {nan, infinite, a[31] ^ b[31], exponent, product};
  endfunction

  logic valid1_q, nan1_q, infinite1_q, sign1_q;
  logic signed [ 9:0] exponent1_q;
  logic        [47:0] product1_q;  // U(2.46)

  always_ff @(posedge clk_i) begin
    valid1_q <= valid_i && !rst_i;
    if (valid_i) {nan1_q, infinite1_q, sign1_q, exponent1_q, product1_q} <= multiply(a_i, b_i);
  end

  // ---- 2: normalize -----------------------------------------------------------------------------
  // {biased exponent (10), significand (26, U(1.25), last bit sticky)}. The exponent ends at 1 or
  // above; a significand without a leading one there is subnormal, or zero.
  function automatic logic [35:0] normalize(input logic signed [9:0] exponent,
                                            input logic [47:0] product);
    logic signed [9:0] e, below;
    logic [47:0] n;  // U(1.47)
    logic sticky;
    e = exponent;
    n = product;
    sticky = 1'b0;
    if (e < 10'sd1) begin
      // From 48 places on, all of the product is sticky.
      below = 10'sd1 - e;
      if (below > 10'sd48) below = 10'sd48;
      n = product >> below[5:0];
      sticky = (n << below[5:0]) != product;
      e = 10'sd1;
    end else begin
      if (n[47:16] == 32'd0 && e > 10'sd32) begin
        n = n << 32;
        e = e - 10'sd32;
      end
      if (n[47:32] == 16'd0 && e > 10'sd16) begin
        n = n << 16;
        e = e - 10'sd16;
      end
      if (n[47:40] == 8'd0 && e > 10'sd8) begin
        n = n << 8;
        e = e - 10'sd8;
      end
      if (n[47:44] == 4'd0 && e > 10'sd4) begin
        n = n << 4;
        e = e - 10'sd4;
      end
      if (n[47:46] == 2'd0 && e > 10'sd2) begin
        n = n << 2;
        e = e - 10'sd2;
      end
      if (!n[47] && e > 10'sd1) begin
        n = n << 1;
        e = e - 10'sd1;
      end
    end
    normalize = {e, n[47:23], (|n[22:0]) | sticky};
  endfunction

  logic valid2_q, nan2_q, infinite2_q, sign2_q;
  logic [ 9:0] exponent2_q;  // 1 to 384
  logic [25:0] significand2_q;  // U(1.25), last bit sticky

  always_ff @(posedge clk_i) begin
    valid2_q <= valid1_q && !rst_i;
    if (valid1_q) begin
      nan2_q      <= nan1_q;
      infinite2_q <= infinite1_q;
      sign2_q     <= sign1_q;
      {exponent2_q, significand2_q} <= normalize(exponent1_q, product1_q);
    end
  end

  // ---- 3: pack ----------------------------------------------------------------------------------
  // A carry out of the rounded fraction runs into the exponent field, which is just what is
  // wanted: a subnormal becomes the smallest normal number, the largest number infinity.
  function automatic logic [30:0] pack(input logic [9:0] exponent, input logic [25:0] n);
    if (n[25] && exponent > 10'd254) pack = 31'h7f800000;
    else pack = {n[25] ? exponent[7:0] : 8'd0, n[24:2]} + {30'd0, n[1] & (n[2] | n[0])};
  endfunction

  always_ff @(posedge clk_i) begin
    valid_o <= valid2_q && !rst_i;
    if (valid2_q) begin
      if (nan2_q) y_o <= 32'h7fc00000;
      else if (infinite2_q) y_o <= {sign2_q, 31'h7f800000};
      else y_o <= {sign2_q, pack(exponent2_q, significand2_q)};
    end
  end
endmodule
