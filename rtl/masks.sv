// SPDX-License-Identifier: Apache-2.0
//
// Which mask each corner of an item has, and which its new vertex: what the sharpness of edges and
// vertices means at the item's generation.
//
//   * In: an item with valid_i, as classify has gathered it: the record's sharpness, and its vertices'
//     {sharp, old, position}.
//   * Out, one cycle later, until the next item:
//       position_o  of the vertices
//       source_o    what the new vertex is the average of, four times: the positions (odd_i) or the
//                   old positions; of a sharp edge, and of a half-quad, its ends twice each
//       crease_o    the vertex is on a crease
//       sharp_o     even generations: the half-edge is sharp, or on the boundary
//       tag_o       odd generations: the quad was made of such an edge
//
// Vertices move in even generations g, at level g/2, and leave in any, at their limit from level
// floor((g+1)/2): that level serves both. The new vertex of an odd generation is of the step before:
// level floor(g/2).

module masks (
    input logic clk_i,

    input logic       odd_i,          // the step: the generation is even
    input logic [7:0] generation_i,
    input logic       corners_stay_i,

    input logic             valid_i,
    input logic             half_i,
    input logic [      3:0] boundary_i,
    input logic [     15:0] sharp_i,
    input logic [      3:0] tag_i,
    input logic [4*274-1:0] vertex_i,

    output logic [511:0] position_o,
    output logic [511:0] source_o,
    output logic [  3:0] crease_o,
    output logic [  3:0] sharp_o,
    output logic         tag_o
);

  function automatic logic is_sharp(input logic [3:0] sharpness, input logic [7:0] level);
    is_sharp = sharpness == hs_pkg::SHARP_INFINITE[3:0] || 8'(sharpness) > level;
  endfunction

  logic [7:0] level;
  logic middle;
  logic [3:0] crease;

  assign level = 8'((9'(generation_i) + 9'd1) >> 1);
  assign middle = half_i || is_sharp(tag_i, generation_i >> 1);

  for (genvar i = 0; i < 4; i++) begin : g_kind
    /* verilator lint_off PINCONNECTEMPTY */
    vertex_kind u_kind (
        .word_i(vertex_i[i*274+256+:18]),
        .level_i(level),
        .corners_stay_i,
        .stays_o(),  // smooth sees to that
        .crease_o(crease[i])
    );
    /* verilator lint_on PINCONNECTEMPTY */
  end

  always_ff @(posedge clk_i) begin
    if (valid_i) begin
      crease_o <= crease;
      tag_o <= half_i || is_sharp(tag_i, level);
      for (int i = 0; i < 4; i++) begin
        sharp_o[i] <= boundary_i[i] || is_sharp(sharp_i[i*4+:4], level);
        position_o[i*128+:128] <= vertex_i[i*274+:128];
        // RNE((v + w) / 2) is the average of v, v, w, w: the ends are lanes 0 and 2.
        source_o[i*128+:128] <= odd_i ? vertex_i[i*274+:128] :
            middle ? vertex_i[i/2*2*274+128+:128] : vertex_i[i*274+128+:128];
      end
    end
  end

endmodule
