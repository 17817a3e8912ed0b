// SPDX-License-Identifier: Apache-2.0
//
// check_twins: that every twin of the initial mesh points back, runs the other way, and says the
// same sharpness of their edge. Part of receive's verdict, but it needs the whole mesh; it runs
// beside classify in generation 0.
//
//   * start_i for one cycle with corners_i. It reads every corner in order through port a, and its
//     twin's corner through port b (each answers one cycle after its read): origin, twin, border
//     (it has no twin, whatever the boundary's mode), sharpness and, on a, whether the corner is the
//     first or last of its face.
//   * error_o, valid when active_o has fallen: a half-edge h has twin(twin(h)) != h or
//     origin(twin(h)) != origin(next(h)), at its word w1; or, sharpness_error_o, the sharpness of
//     twin(h) is another, at w3. corner_o is the first such h, and w1 goes before w3.
//   * Rate: a corner a cycle. No stalls.

module check_twins #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19   // width of a corner's number
) (
    input logic clk_i,
    input logic rst_i,

    input  logic          start_i,
    input  logic [  QW:0] corners_i,
    output logic          active_o,
    output logic          error_o,
    output logic [QW-1:0] corner_o,
    output logic          sharpness_error_o,

    output logic          a_rd_en_o,
    output logic [QW-1:0] a_rd_index_o,
    input  logic [VW-1:0] a_origin_i,
    input  logic [QW-1:0] a_twin_i,
    input  logic          a_border_i,
    input  logic [   3:0] a_sharpness_i,
    input  logic          a_first_i,
    input  logic          a_last_i,

    output logic          b_rd_en_o,
    output logic [QW-1:0] b_rd_index_o,
    input  logic [VW-1:0] b_origin_i,
    input  logic [QW-1:0] b_twin_i,
    input  logic          b_border_i,
    input  logic [   3:0] b_sharpness_i
);

  // --- Read: corner h in cycle t, its twin in t+1, both known in t+2 -------------------------------
  logic [QW:0] left_q;
  logic [QW-1:0] next_q, corner_1, corner_2;
  logic valid_1, valid_2;
  logic [VW-1:0] origin_2;
  logic border_2, first_2, last_2;
  logic [3:0] sharpness_2;

  assign a_rd_en_o = left_q != '0;
  assign a_rd_index_o = next_q;
  assign b_rd_en_o = valid_1 && !a_border_i;
  assign b_rd_index_o = a_twin_i;

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      left_q <= corners_i;
      next_q <= '0;
    end else if (a_rd_en_o) begin
      left_q <= left_q - (QW + 1)'(1);
      next_q <= next_q + QW'(1);
    end
    valid_1  <= a_rd_en_o;
    corner_1 <= next_q;
    valid_2  <= valid_1;
    corner_2 <= corner_1;
    origin_2 <= a_origin_i;
    border_2 <= a_border_i;
    sharpness_2 <= a_sharpness_i;
    first_2  <= a_first_i;
    last_2   <= a_last_i;
    if (rst_i) begin
      left_q  <= '0;
      valid_1 <= 1'b0;
      valid_2 <= 1'b0;
    end
  end
  assign active_o = a_rd_en_o || valid_1 || valid_2;

  // --- Check: the direction of h's twin is known when the corner behind h is -------------------------
  // So a wrong direction of h comes a corner later than a wrong sharpness of h, and takes its place:
  // it is of an earlier word. No other error can be of an earlier word than one that is noted.
  logic checked_q;  // the corner before this one, of the same face, has a twin
  logic [VW-1:0] twin_origin_q, face_origin_q;
  logic before_wrong, wrong, sharpness_wrong;

  assign before_wrong = !first_2 && checked_q && twin_origin_q != origin_2;
  assign wrong = !border_2 && (b_border_i || b_twin_i != corner_2 ||
                               (last_2 && b_origin_i != face_origin_q));
  assign sharpness_wrong = !border_2 && sharpness_2 != b_sharpness_i;

  always_ff @(posedge clk_i) begin
    if (valid_2) begin
      checked_q <= !border_2;
      twin_origin_q <= b_origin_i;
      if (first_2) face_origin_q <= origin_2;
      if (!error_o && (before_wrong || wrong || sharpness_wrong)) begin
        error_o <= 1'b1;
        corner_o <= before_wrong ? corner_2 - QW'(1) : corner_2;
        sharpness_error_o <= !before_wrong && !wrong;
      end
      if (error_o && before_wrong && corner_o == corner_2 - QW'(1)) sharpness_error_o <= 1'b0;
    end
    if (start_i) error_o <= 1'b0;
  end

endmodule
