// SPDX-License-Identifier: Apache-2.0
//
// vertex_kind: which mask a vertex has at a Catmull-Clark level (docs/refinement.md, section 9).
//
//   word   {many, seen, own[3:0], t3[3:0], t2[3:0], t1[3:0]}: sharpness.sv makes it
//
//   stays    if the vertex itself or its third sharpest edge is still sharp, or if, in the mode
//            smooth, it lies on the boundary and has one face
//   crease   else, if its second sharpest edge is
//   neither: smooth
//
//   * Sharp at a level: the sharpness exceeds it, or is SHARP_INFINITE.
//   * Combinational. In a vertex with one face only one half-edge leaves it: t2 is SHARP_INFINITE
//     exactly if that is on the boundary, which counts twice. The word of a vertex that is born
//     later says many.

module vertex_kind (
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [17:0] word_i,          // t1 and seen decide nothing
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic [ 7:0] level_i,
    input  logic        corners_stay_i,  // the mode is smooth
    output logic        stays_o,
    output logic        crease_o
);

  localparam logic [3:0] INFINITE = hs_pkg::SHARP_INFINITE[3:0];

  logic many, own_sharp, t3_sharp, t2_sharp;
  logic [3:0] own, t3, t2;

  assign many = word_i[17];
  assign own = word_i[15:12];
  assign t3 = word_i[11:8];
  assign t2 = word_i[7:4];
  assign own_sharp = own == INFINITE || 8'(own) > level_i;
  assign t3_sharp = t3 == INFINITE || 8'(t3) > level_i;
  assign t2_sharp = t2 == INFINITE || 8'(t2) > level_i;

  assign stays_o = own_sharp || t3_sharp || (corners_stay_i && !many && t2 == INFINITE);
  assign crease_o = !stays_o && t2_sharp;

endmodule
