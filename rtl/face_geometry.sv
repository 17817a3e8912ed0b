// SPDX-License-Identifier: Apache-2.0
//
// Marks and new vertex of a face from the positions of its corners.
//
//   * In: an item a cycle with valid_i: the four corners of a quad (quads_i), the three of a
//     half-quad (quads_i and half_i), or, in generation 0, the next corner of an n-gon in lane 0, n
//     from 3 to 255, last_i with the last. position_i is what the marks are taken from, source_i
//     what the new vertex is the average of: lane i at 128i, x in its low 32 bits, then y, z, w.
//   * A half-quad has no position in lane 3, but four sources: its ends, twice each.
//   * The settings min_edge_i, width_i and height_i hold while anything is inside.
//   * Out: LATENCY cycles after a face's last item, valid_o with
//       point_o   RNE(sum of source / n), exactly; of the four sources of a half-quad, n = 4
//       sum_o     that sum: x, y, z, w, S(39.0) each
//       front_o, back_o, hits_o  the face's marks
//       stop_o    all its edges are short (short_edges.sv)
//       nonquad_o  n is not 4 (generation 0)
//       last_position_o, last_border_o  of its last corner, for the first one's sake (generation 0)
//   * No stalls.
//
// In generation 0 corner i closes the determinant of corners i-2, i-1, i and the edge from i-1; the
// last corner closes those around corners n-1 and 0 too, with the first two positions, which were
// kept. A half-quad has one determinant: its three corners' are cyclic turns of each other.

module face_geometry (
    input logic clk_i,
    input logic rst_i,
    input logic quads_i,

    // settings
    input logic [15:0] min_edge_i,
    input logic [15:0] width_i,
    input logic [15:0] height_i,

    input logic         valid_i,
    input logic         half_i,
    input logic         last_i,
    input logic         border_i,
    input logic [511:0] position_i,
    input logic [511:0] source_i,

    output logic         valid_o,
    output logic [127:0] point_o,
    output logic         front_o,
    output logic         back_o,
    output logic         hits_o,
    output logic         stop_o,
    output logic         nonquad_o,
    output logic [159:0] sum_o,
    output logic [127:0] last_position_o,
    output logic         last_border_o
);

  localparam int unsigned LATENCY = 5;  // one for n times the sum, four for the division

  // --- Generation 0: what is kept of the face's earlier corners ---------------------------------------
  logic [7:0] corner_q;  // the number of the next corner
  logic [95:0] first_q, second_q, before_q, before_that_q;  // x, y, w
  logic [5:0] outside_q;
  logic [4*40-1:0] sum_q;  // S(39.0) each
  logic [95:0] corner;

  assign corner = {position_i[127:96], position_i[63:0]};

  // --- The lanes that hold corners --------------------------------------------------------------------
  logic [3:0] lanes;
  logic [7:0] n;

  assign lanes = !quads_i ? 4'b0001 : half_i ? 4'b0111 : 4'b1111;
  assign n = quads_i ? 8'd4 : corner_q + 8'd1;  // of sources, with last_i

  // --- View volume: the half-spaces x>w, x<-w, y>w, y<-w, z>w, z<-w that hold all corners -------------
  function automatic logic [5:0] outside_of(input logic signed [31:0] x, input logic signed [31:0] y,
                                            input logic signed [31:0] z,
                                            input logic signed [31:0] w);
    outside_of = {z < -w, z > w, y < -w, y > w, x < -w, x > w};
  endfunction

  logic [5:0] outside;

  always_comb begin
    outside = 6'b111111;
    for (int i = 0; i < 4; i++)
      if (lanes[i])
        outside = outside & outside_of(position_i[i*128+:32], position_i[i*128+32+:32],
                                       position_i[i*128+64+:32], position_i[i*128+96+:32]);
    if (!quads_i && corner_q != 8'd0) outside = outside & outside_q;
  end

  // --- Sum of the source -------------------------------------------------------------------------------
  logic [4*40-1:0] sum;

  always_comb begin
    for (int k = 0; k < 4; k++) begin
      sum[k*40+:40] = !quads_i && corner_q != 8'd0 ? sum_q[k*40+:40] : 40'd0;
      for (int i = 0; i < 4; i++)
        if (i == 0 || quads_i)
          sum[k*40+:40] = sum[k*40+:40] +
              {{8{source_i[i*128+k*32+31]}}, source_i[i*128+k*32+:32]};
    end
  end

  always_ff @(posedge clk_i) begin
    if (valid_i && !quads_i) begin
      corner_q <= last_i ? 8'd0 : corner_q + 8'd1;
      if (corner_q == 8'd0) first_q <= corner;
      if (corner_q == 8'd1) second_q <= corner;
      before_q <= corner;
      before_that_q <= before_q;
      outside_q <= outside;
      sum_q <= sum;
    end
    if (rst_i) corner_q <= 8'd0;
  end

  // --- Determinants, of (x, y, w) ---------------------------------------------------------------------
  logic [3:0] uses;
  logic [95:0] a, b, c, d, p, q, r, s;
  logic front_3, back_3;

  always_comb begin
    if (quads_i) begin
      uses = half_i ? 4'b0001 : 4'b1111;
      a = {position_i[0*128+96+:32], position_i[0*128+:64]};
      b = {position_i[1*128+96+:32], position_i[1*128+:64]};
      c = {position_i[2*128+96+:32], position_i[2*128+:64]};
      d = {position_i[3*128+96+:32], position_i[3*128+:64]};
      p = c;
      q = d;
      r = a;
      s = b;
    end else begin
      uses = {1'b0, last_i, last_i, corner_q >= 8'd2};
      a = before_q;
      b = corner;
      c = first_q;
      d = second_q;
      p = before_that_q;
      q = c;
      r = b;
      s = c;
    end
  end

  marks u_marks (
      .clk_i,
      .valid_i,
      .use_i(uses),
      .a_i(a),
      .b_i(b),
      .c_i(c),
      .d_i(d),
      .p_i(p),
      .q_i(q),
      .r_i(r),
      .s_i(s),
      .front_o(front_3),
      .back_o(back_3)
  );

  // --- Edges: quads, lane i to the next one; n-gons, to this corner, and from the last to the first -----
  logic [3:0] edges;
  logic [383:0] from, to;
  logic short_3;

  always_comb begin
    if (quads_i) begin
      edges = lanes;
      from = {d, c, b, a};
      to = {a, half_i ? a : d, c, b};
    end else begin
      edges = {2'b00, last_i, corner_q != 8'd0};
      from = {corner, corner, corner, before_q};
      to = {first_q, first_q, first_q, corner};
    end
  end

  short_edges u_short_edges (
      .clk_i,
      .min_edge_i,
      .width_i,
      .height_i,
      .valid_i,
      .use_i(edges),
      .from_i(from),
      .to_i(to),
      .all_short_o(short_3)
  );

  // --- Point: the sum, times n, over n^2 -----------------------------------------------------------------
  logic [7:0] n_1;
  logic [4*48-1:0] dividend_1;

  always_ff @(posedge clk_i) begin
    if (valid_i && last_i) begin
      n_1 <= n;
      for (int k = 0; k < 4; k++)
        dividend_1[k*48+:48] <= {{8{sum[k*40+39]}}, sum[k*40+:40]} * 48'(n);
    end
  end

  for (genvar k = 0; k < 4; k++) begin : g_divide
    divide u_divide (
        .clk_i,
        .valid_i(ends_q[0]),
        .limit_i(1'b0),
        .n_i(n_1),
        .x_i(dividend_1[k*48+:48]),
        .y_o(point_o[k*32+:32])
    );
  end

  // --- What goes along: stage t is t + 1 cycles after the item ---------------------------------------------
  logic [2:0] valid_q, starts_q;
  logic [LATENCY-1:0] ends_q, hits_q, nonquad_q, last_border_q;
  logic front_4, back_4, short_4, front_5, back_5, short_5, front_run, back_run, short_run;
  logic [LATENCY*128-1:0] last_q;
  logic [LATENCY*160-1:0] sums_q;

  // The marks of an n-gon are ORed, corner by corner, as its determinants come out, and what its
  // edges say ANDed.
  assign front_run = front_3 || (!starts_q[2] && front_4);
  assign back_run  = back_3 || (!starts_q[2] && back_4);
  assign short_run = short_3 && (starts_q[2] || short_4);

  always_ff @(posedge clk_i) begin
    valid_q <= {valid_q[1:0], valid_i};
    ends_q <= {ends_q[LATENCY-2:0], valid_i && last_i};
    starts_q <= {starts_q[1:0], quads_i || corner_q == 8'd0};
    hits_q <= {hits_q[LATENCY-2:0], outside == 6'd0};
    nonquad_q <= {nonquad_q[LATENCY-2:0], n != 8'd4};
    last_border_q <= {last_border_q[LATENCY-2:0], border_i};
    if (valid_q[2]) begin
      front_4 <= front_run;
      back_4  <= back_run;
      short_4 <= short_run;
    end
    front_5 <= front_4;
    back_5  <= back_4;
    short_5 <= short_4;
    if (valid_i && last_i) sums_q[0+:160] <= sum;
    for (int t = 1; t < LATENCY; t++)
      if (ends_q[t-1]) sums_q[t*160+:160] <= sums_q[(t-1)*160+:160];
    if (!quads_i) last_q <= {last_q[(LATENCY-1)*128-1:0], position_i[127:0]};
    if (rst_i) begin
      valid_q <= '0;
      ends_q  <= '0;
    end
  end

  assign valid_o = ends_q[LATENCY-1];
  assign hits_o = hits_q[LATENCY-1];
  assign front_o = front_5;
  assign back_o = back_5;
  assign stop_o = short_5;
  assign nonquad_o = nonquad_q[LATENCY-1];
  assign sum_o = sums_q[(LATENCY-1)*160+:160];
  assign last_position_o = last_q[(LATENCY-1)*128+:128];
  assign last_border_o = last_border_q[LATENCY-1];

endmodule
