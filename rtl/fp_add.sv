// SPDX-License-Identifier: Apache-2.0
//
// fp_add: y = a + b in IEEE-754 binary32, rounded to nearest, ties to even.
//
// * In: a_i and b_i, any bit patterns, with valid_i. Subnormals count in full.
// * Out: y_o with valid_o, 3 cycles later, one sum a cycle. Subnormal sums are
//   delivered as such. An exact zero is +0 unless both operands are -0.
// * Any NaN result is 32'h7fc00000, whatever the operands' payloads were.
// * No stalls, no exception flags. y_o means nothing without valid_o.
//
//     align        x is the operand of larger magnitude; shift y's significand to x's exponent
//     accumulate   add or subtract: never negative, because |x| >= |y|
//     pack         normalize, round, assemble
//
// Each step is a function, called only for a valid operand, so that a simulator skips idle units.
module fp_add (
    input  logic        clk_i,
    input  logic        rst_i,
    input  logic        valid_i,
    input  logic [31:0] a_i,
    input  logic [31:0] b_i,
    output logic        valid_o,
    output logic [31:0] y_o
);
  // ---- 1: align ---------------------------------------------------------------------------------
  // {nan, infinite, sign of x, sign of an exact zero, subtract, exponent of x (8),
  //  significand of x (24, U(1.23)), significand of y (27, U(1.26))}.
  // y's last bit is sticky: the OR of everything below it. Two exact places above it are enough:
  // where y moves by more than one place, the difference loses at most one place by normalizing.
  function automatic logic [63:0] align(input logic [31:0] a, input logic [31:0] b);
    logic [31:0] x, y;
    logic [7:0] exponent_x, exponent_y, distance;
    logic [50:0] wide;  // U(1.50): y's significand, and room for what is shifted out
    logic infinite_x, infinite_y, nan;
    x = b[30:0] > a[30:0] ? b : a;
    y = b[30:0] > a[30:0] ? a : b;
    // A subnormal has the exponent of the smallest normal number, and no leading one.
    exponent_x = x[30:23] == 8'd0 ? 8'd1 : x[30:23];
    exponent_y = y[30:23] == 8'd0 ? 8'd1 : y[30:23];
    distance = exponent_x - exponent_y;
    // From 26 places on, all of y is sticky.
    wide = {y[30:23] != 8'd0, y[22:0], 27'd0} >> (distance > 8'd26 ? 5'd26 : distance[4:0]);
    infinite_x = x[30:0] == 31'h7f800000;
    infinite_y = y[30:0] == 31'h7f800000;
    // A NaN has the larger magnitude, so x is one if any is.
    nan = x[30:0] > 31'h7f800000 || (infinite_x && infinite_y && x[31] != y[31]);
    align = {
      nan, infinite_x, x[31], x[31] & y[31], x[31] ^ y[31], exponent_x,
      x[30:23] != 8'd0, x[22:0], wide[50:25], |wide[24:0]
    };
  endfunction

  logic valid1_q, nan1_q, infinite1_q, sign1_q, sign_zero1_q, subtract1_q;
  logic [ 7:0] exponent1_q;
  logic [23:0] significand_x1_q;  // U(1.23)
  logic [26:0] significand_y1_q;  // U(1.26), last bit sticky

  always_ff @(posedge clk_i) begin
    valid1_q <= valid_i && !rst_i;
    if (valid_i)
      {nan1_q, infinite1_q, sign1_q, sign_zero1_q, subtract1_q, exponent1_q, significand_x1_q,
       significand_y1_q} <= align(a_i, b_i);
  end

  // ---- 2: accumulate ----------------------------------------------------------------------------
  logic valid2_q, nan2_q, infinite2_q, sign2_q;
  logic [ 7:0] exponent2_q;
  logic [27:0] sum2_q;  // U(2.26), last bit sticky
  logic [27:0] sum_d;

  assign sum_d = !valid1_q ? 28'd0 :
      subtract1_q ? {1'b0, significand_x1_q, 3'd0} - {1'b0, significand_y1_q}
                  : {1'b0, significand_x1_q, 3'd0} + {1'b0, significand_y1_q};

  always_ff @(posedge clk_i) begin
    valid2_q <= valid1_q && !rst_i;
    if (valid1_q) begin
      nan2_q      <= nan1_q;
      infinite2_q <= infinite1_q;
      sign2_q     <= sum_d == 28'd0 ? sign_zero1_q : sign1_q;
      exponent2_q <= exponent1_q;
      sum2_q      <= sum_d;
    end
  end

  // ---- 3: pack ----------------------------------------------------------------------------------
  // The binary32 of sum * 2^(exponent - 127), sign apart. Normalizing stops at exponent 1: what
  // has no leading one there is subnormal (or zero), and its exponent field is 0. A carry out of
  // the rounded fraction runs into the exponent field, which is just what is wanted, up to
  // infinity.
  function automatic logic [30:0] pack(input logic [7:0] exponent, input logic [27:0] sum);
    logic [26:0] n;  // U(1.26), last bit sticky
    logic [ 7:0] e;
    if (sum[27]) begin
      n = {sum[27:2], sum[1] | sum[0]};
      e = exponent + 8'd1;
    end else begin
      n = sum[26:0];
      e = exponent;
      if (n[26:11] == 16'd0 && e > 8'd16) begin
        n = n << 16;
        e = e - 8'd16;
      end
      if (n[26:19] == 8'd0 && e > 8'd8) begin
        n = n << 8;
        e = e - 8'd8;
      end
      if (n[26:23] == 4'd0 && e > 8'd4) begin
        n = n << 4;
        e = e - 8'd4;
      end
      if (n[26:25] == 2'd0 && e > 8'd2) begin
        n = n << 2;
        e = e - 8'd2;
      end
      if (!n[26] && e > 8'd1) begin
        n = n << 1;
        e = e - 8'd1;
      end
    end
    if (e == 8'd255) pack = 31'h7f800000;
    else pack = {n[26] ? e : 8'd0, n[25:3]} + {30'd0, n[2] & (n[3] | n[1] | n[0])};
  endfunction

  always_ff @(posedge clk_i) begin
    valid_o <= valid2_q && !rst_i;
    if (valid2_q) begin
      if (nan2_q) y_o <= 32'h7fc00000;
      else if (infinite2_q) y_o <= {sign2_q, 31'h7f800000};
      else y_o <= {sign2_q, pack(exponent2_q, sum2_q)};
    end
  end
endmodule
