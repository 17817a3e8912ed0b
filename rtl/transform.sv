// SPDX-License-Identifier: Apache-2.0
//
// transform: clip = M * p for a stream of vertices, in binary32.
//
// Each row is ((m0*x + m1*y) + (m2*z + m3*w)), every operation rounded to nearest even, subnormals
// included, so that C's float gives the same bits:
//
//     m0*x --+                         16 multipliers and 12 adders: four rows side by side,
//     m1*y --+-- + --+                 one vertex a cycle.
//     m2*z --+       +-- + -- clip
//     m3*w --+-- + --+
//
// * In: record_i (x in bits 31:0, then y, z, w) with valid_i; index_i goes along with it.
//   matrix_i (m00 in bits 31:0, row-major) must hold still while valid_i or busy_o is high.
// * Out: clip_o (laid out like record_i) and index_o with valid_o, LATENCY = 9 cycles later.
// * overflow_o, with valid_o: a component of clip_o is infinite or NaN; overflow_row_o is the
//   lowest such row. With finite inputs this is an overflow; what else it may be is the caller's.
// * magnitude_o: the largest |component|, as the bit pattern of a binary32 without its sign, over
//   all finite components that came out since clear_i. It includes a vertex from the cycle after
//   its valid_o on, and is complete when busy_o is low.
// * busy_o: a vertex is in flight, or its magnitude is.
// * No stalls: whoever takes clip_o takes it at once. clear_i while busy_o is illegal (what is in
//   flight would count for the next view).
module transform #(
    // Width of a vertex number.
    parameter int VW = 19
) (
    input logic clk_i,
    input logic rst_i,

    // from receive
    input logic          clear_i,
    input logic          valid_i,
    input logic [VW-1:0] index_i,
    input logic [ 127:0] record_i,
    input logic [ 511:0] matrix_i,

    // to the vertex memory
    output logic          valid_o,
    output logic [VW-1:0] index_o,
    output logic [ 127:0] clip_o,

    // to receive and quantize
    output logic        overflow_o,
    output logic [ 1:0] overflow_row_o,
    output logic [30:0] magnitude_o,
    output logic        busy_o
);
  // One multiplication and two additions of 3 cycles each.
  localparam int LATENCY = 9;

  // ---- the four rows ----------------------------------------------------------------------------
  logic [3:0] valid_row;

  for (genvar r = 0; r < 4; r++) begin : g_row
    logic [3:0] valid_product;
    logic [31:0] product_x, product_y, product_z, product_w;
    logic valid_xy, valid_zw;
    logic [31:0] sum_xy, sum_zw;

    fp_mul i_mul_x (
        .clk_i, .rst_i, .valid_i,
        .a_i(matrix_i[128*r+:32]), .b_i(record_i[31:0]),
        .valid_o(valid_product[0]), .y_o(product_x)
    );
    fp_mul i_mul_y (
        .clk_i, .rst_i, .valid_i,
        .a_i(matrix_i[128*r+32+:32]), .b_i(record_i[63:32]),
        .valid_o(valid_product[1]), .y_o(product_y)
    );
    fp_mul i_mul_z (
        .clk_i, .rst_i, .valid_i,
        .a_i(matrix_i[128*r+64+:32]), .b_i(record_i[95:64]),
        .valid_o(valid_product[2]), .y_o(product_z)
    );
    fp_mul i_mul_w (
        .clk_i, .rst_i, .valid_i,
        .a_i(matrix_i[128*r+96+:32]), .b_i(record_i[127:96]),
        .valid_o(valid_product[3]), .y_o(product_w)
    );
    fp_add i_add_xy (
        .clk_i, .rst_i, .valid_i(&valid_product[1:0]),
        .a_i(product_x), .b_i(product_y), .valid_o(valid_xy), .y_o(sum_xy)
    );
    fp_add i_add_zw (
        .clk_i, .rst_i, .valid_i(&valid_product[3:2]),
        .a_i(product_z), .b_i(product_w), .valid_o(valid_zw), .y_o(sum_zw)
    );
    fp_add i_add (
        .clk_i, .rst_i, .valid_i(valid_xy && valid_zw),
        .a_i(sum_xy), .b_i(sum_zw), .valid_o(valid_row[r]), .y_o(clip_o[32*r+:32])
    );
  end

  assign valid_o = &valid_row;

  // ---- what goes along --------------------------------------------------------------------------
  logic [LATENCY-1:0] flight_q;  // bit k: a vertex that came in k+1 cycles ago
  logic magnitude_due_q;
  logic [VW*LATENCY-1:0] index_q;

  assign index_o = index_q[VW*(LATENCY-1)+:VW];
  assign busy_o  = (|flight_q) || magnitude_due_q;

  always_ff @(posedge clk_i) begin
    flight_q        <= rst_i ? '0 : {flight_q[LATENCY-2:0], valid_i};
    magnitude_due_q <= valid_o && !rst_i;
    if (valid_i || (|flight_q)) index_q <= {index_q[VW*(LATENCY-1)-1:0], index_i};
  end

  // ---- overflow and magnitude -------------------------------------------------------------------
  logic [3:0] bad_row;

  for (genvar r = 0; r < 4; r++) begin : g_bad
    assign bad_row[r] = clip_o[32*r+23+:8] == 8'd255;
  end

  assign overflow_o     = valid_o && (|bad_row);
  assign overflow_row_o = bad_row[0] ? 2'd0 : bad_row[1] ? 2'd1 : bad_row[2] ? 2'd2 : 2'd3;

  // Without their signs, finite binary32 numbers order as integers do.
  function automatic logic [30:0] larger(input logic [30:0] a, input logic bad_b,
                                         input logic [30:0] b);
    larger = !bad_b && b > a ? b : a;
  endfunction

  always_ff @(posedge clk_i) begin
    if (rst_i || clear_i) magnitude_o <= '0;
    else if (valid_o)
      magnitude_o <= larger(larger(larger(larger(magnitude_o,
          bad_row[0], clip_o[30:0]), bad_row[1], clip_o[62:32]),
          bad_row[2], clip_o[94:64]), bad_row[3], clip_o[126:96]);
  end
endmodule
