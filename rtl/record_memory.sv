// SPDX-License-Identifier: Apache-2.0
//
// The active mesh: one generation's records on one side, the next generation's in the making on the
// other. A quad's record has two halves, written by the two half-edges that it comes from:
//
//   half  {selected, forced[7:0], half-quad, place, sharpness[3:0], boundary of c1, boundary of c0,
//          border of c1, border of c0, twin of c1, twin of c0, origin of c1, origin of c0}
//
//   lanes 0, 1: the lower half's c0, c1;   lanes 2, 3: the upper half's
//
// A quad is a candidate if both halves say selected; its forced depth is the smaller one. In odd
// generations both halves hold the sharpness of the edge that the quad was made of (15 if that was a
// boundary edge); in even ones each the sharpness of one of its two half-edges, c1 if place is set,
// the other one being smooth. A half-quad (the upper half says so) has no lane 3.
//
// Generation 0 has a corner a record, in the lower half: c0 is the corner, {first, last of its face}
// stand in place of c1's twin. It is read from side 0; side 1 holds it twice, for check_twins.
//
//   * fault_o, two cycles behind a read: the parity of a word of use was wrong.
//   * Reads answer one cycle later. Split writes the side that is not read.

module record_memory #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19,
    parameter int unsigned BANK_BITS = 3,
    parameter bit PARITY = 1'b1,
    localparam int unsigned BANKS = 1 << BANK_BITS,
    localparam int unsigned ROW_BITS = QW - BANK_BITS,
    localparam int unsigned HW = QW + 2,
    localparam int unsigned HALF = 2 * VW + 2 * HW + 19
) (
    input logic clk_i,

    input logic side_i,   // which side is read
    input logic quads_i,  // quads, not corners
    input logic [QW:0] items_i,

    // receive: corners
    input logic          corner_valid_i,
    input logic [QW-1:0] corner_index_i,
    input logic [VW-1:0] corner_origin_i,
    input logic [QW-1:0] corner_twin_i,
    input logic          corner_border_i,
    input logic          corner_boundary_i,
    input logic [   3:0] corner_sharpness_i,
    input logic [   7:0] corner_forced_i,
    input logic          corner_first_i,
    input logic          corner_last_i,

    // classify, select, guard, split: a record
    input  logic            rd_en_i,
    input  logic [  QW-1:0] rd_item_i,
    output logic [4*VW-1:0] origin_o,
    output logic [4*HW-1:0] twin_o,
    output logic [     3:0] border_o,
    output logic [     3:0] boundary_o,
    output logic [    15:0] sharp_o,      // even generations: of each lane's half-edge
    output logic [     3:0] tag_o,        // odd generations: of the edge that the quad was made of
    output logic            half_o,
    output logic            candidate_o,
    output logic [     7:0] forced_o,
    output logic            last_o,

    // the middles of the edges that the quads in line with this one were made of, four or as many as
    // there are banks: read with the record, or alone
    input  logic          edge_i,          // there are any
    input  logic          edge_rd_en_i,
    input  logic [QW-1:0] edge_rd_item_i,
    output logic [ 127:0] edge_point_o,
    output logic [ 511:0] edge_points_o,

    // check_twins: corners in order, and their twins
    input  logic          a_rd_en_i,
    input  logic [QW-1:0] a_rd_index_i,
    output logic [VW-1:0] a_origin_o,
    output logic [QW-1:0] a_twin_o,
    output logic          a_border_o,     // border or boundary
    output logic [   3:0] a_sharpness_o,
    output logic          a_first_o,
    output logic          a_last_o,
    input  logic          b_rd_en_i,
    input  logic [QW-1:0] b_rd_index_i,
    output logic [VW-1:0] b_origin_o,
    output logic [QW-1:0] b_twin_o,
    output logic          b_border_o,
    output logic [   3:0] b_sharpness_o,

    // split: halves of the next generation
    input logic [         BANKS-1:0] lower_wr_en_i,
    input logic [ROW_BITS*BANKS-1:0] lower_wr_row_i,
    input logic [    HALF*BANKS-1:0] lower_wr_data_i,
    input logic [         BANKS-1:0] upper_wr_en_i,
    input logic [ROW_BITS*BANKS-1:0] upper_wr_row_i,
    input logic [    HALF*BANKS-1:0] upper_wr_data_i,
    input logic                      sum_wr_i,         // and half the sums of the edges
    input logic [     132*BANKS-1:0] lower_wr_sum_i,
    input logic [     132*BANKS-1:0] upper_wr_sum_i,

    output logic fault_o
);

  logic [3:0] fault_half;
  logic fault_lower_sum, fault_upper_sum;
  assign fault_o = fault_half != '0 || fault_lower_sum || fault_upper_sum;

  function automatic logic [BANKS-1:0] bank_of(input logic en, input logic [BANK_BITS-1:0] bank);
    bank_of = BANKS'(en) << bank;
  endfunction

  logic [HALF-1:0] corner;
  logic [BANKS-1:0] corner_bank;

  assign corner = {
    1'b1,
    corner_forced_i,
    2'b00,
    corner_sharpness_i,
    1'b0,
    corner_boundary_i,
    1'b0,
    corner_border_i,
    (HW - 2)'(0),
    corner_first_i,
    corner_last_i,
    2'b00,
    corner_twin_i,
    VW'(0),
    corner_origin_i
  };
  assign corner_bank = bank_of(corner_valid_i, corner_index_i[BANK_BITS-1:0]);

  // --- Two sides, two halves ---------------------------------------------------------------------------
  // Memory 0, 1: side 0's lower and upper half; 2, 3: side 1's.
  logic [4*HALF-1:0] word;

  for (genvar m = 0; m < 4; m++) begin : g_memory
    localparam bit UPPER = m % 2 == 1;
    localparam bit SIDE = m / 2 == 1;
    logic rd_en, split_writes;
    logic [QW-1:0] rd_index;
    logic [BANK_BITS-1:0] bank_q;
    logic [HALF*BANKS-1:0] data;

    always_comb begin
      rd_en = rd_en_i && side_i == SIDE;
      rd_index = rd_item_i;
      if (m == 2 && a_rd_en_i) begin
        rd_en = 1'b1;
        rd_index = a_rd_index_i;
      end
      if (m == 3 && b_rd_en_i) begin
        rd_en = 1'b1;
        rd_index = b_rd_index_i;
      end
    end

    always_ff @(posedge clk_i) if (rd_en) bank_q <= rd_index[BANK_BITS-1:0];

    assign split_writes = side_i != SIDE;

    banked_memory #(
        .WIDTH(HALF),
        .ROW_BITS(ROW_BITS),
        .BANK_BITS(BANK_BITS),
        .PARITY(PARITY)
    ) u_half (
        .clk_i,
        .check_i({BANKS{1'b1}}),
        .fault_o(fault_half[m]),
        .rd_en_i(bank_of(rd_en, rd_index[BANK_BITS-1:0])),
        .rd_row_i({BANKS{rd_index[QW-1:BANK_BITS]}}),
        .rd_data_o(data),
        .wr_en_i(corner_valid_i ? corner_bank : !split_writes ? '0 :
                 UPPER ? upper_wr_en_i : lower_wr_en_i),
        .wr_row_i(corner_valid_i ? {BANKS{corner_index_i[QW-1:BANK_BITS]}} :
                  UPPER ? upper_wr_row_i : lower_wr_row_i),
        .wr_data_i(corner_valid_i ? {BANKS{corner}} : UPPER ? upper_wr_data_i : lower_wr_data_i)
    );

    assign word[m*HALF+:HALF] = data[32'(bank_q)*HALF+:HALF];
  end

  // --- A record ------------------------------------------------------------------------------------------
  logic [HALF-1:0] lower, upper;
  logic lower_selected, upper_selected;
  logic [7:0] lower_forced, upper_forced;
  logic [1:0] lower_border, upper_border, lower_boundary, upper_boundary;
  logic [3:0] lower_sharpness, upper_sharpness;
  logic lower_place, upper_place, half;
  /* verilator lint_off UNUSEDSIGNAL */
  logic lower_half;  // the upper half says it
  /* verilator lint_on UNUSEDSIGNAL */
  logic [2*HW-1:0] lower_twin, upper_twin;
  logic [2*VW-1:0] lower_origin, upper_origin;

  assign lower = side_i ? word[2*HALF+:HALF] : word[0*HALF+:HALF];
  assign upper = side_i ? word[3*HALF+:HALF] : word[1*HALF+:HALF];
  assign {lower_selected, lower_forced, lower_half, lower_place, lower_sharpness, lower_boundary,
          lower_border, lower_twin, lower_origin} = lower;
  assign {upper_selected, upper_forced, half, upper_place, upper_sharpness, upper_boundary,
          upper_border, upper_twin, upper_origin} = upper;

  assign origin_o = {upper_origin, lower_origin};
  assign twin_o = {upper_twin, lower_twin};
  assign border_o = {upper_border, lower_border};
  assign boundary_o = {upper_boundary, lower_boundary};
  assign sharp_o = {
    upper_place ? upper_sharpness : 4'd0, upper_place ? 4'd0 : upper_sharpness,
    lower_place ? lower_sharpness : 4'd0, lower_place ? 4'd0 : lower_sharpness
  };
  assign tag_o = lower_sharpness;
  assign half_o = half && quads_i;
  assign candidate_o = lower_selected && (upper_selected || !quads_i);
  assign forced_o = quads_i && upper_forced < lower_forced ? upper_forced : lower_forced;
  assign last_o = quads_i || lower_twin[HW];

  // --- Middles of edges: a quarter of two halves of a sum ----------------------------------------------
  localparam int unsigned LINE = BANKS < 4 ? BANKS : 4;

  logic edge_rd;
  logic [QW-1:0] edge_item;
  logic [BANK_BITS-1:0] edge_bank_q;
  logic [ROW_BITS-1:0] edge_row_q;
  logic [BANKS-1:0] edge_banks, edge_used;
  logic edge_line_q;
  logic [132*BANKS-1:0] lower_sum, upper_sum;

  assign edge_rd = edge_i && (edge_rd_en_i || rd_en_i);
  assign edge_item = edge_rd_en_i ? edge_rd_item_i : rd_item_i;
  assign edge_banks = !edge_rd ? '0 :
      ((BANKS'(1) << LINE) - BANKS'(1)) << (edge_item[BANK_BITS-1:0] & ~BANK_BITS'(LINE - 1));

  always_ff @(posedge clk_i) begin
    if (edge_rd) begin
      {edge_row_q, edge_bank_q} <= edge_item;
      edge_line_q <= edge_rd_en_i;
    end
  end

  always_comb begin
    for (int b = 0; b < BANKS; b++)
      edge_used[b] = edge_line_q ? {1'b0, edge_row_q, BANK_BITS'(b)} < items_i : edge_bank_q == BANK_BITS'(b);
  end

  banked_memory #(
      .WIDTH(132),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_lower_sum (
      .clk_i,
      .check_i(edge_used),
      .fault_o(fault_lower_sum),
      .rd_en_i(edge_banks),
      .rd_row_i({BANKS{edge_item[QW-1:BANK_BITS]}}),
      .rd_data_o(lower_sum),
      .wr_en_i(sum_wr_i ? lower_wr_en_i : '0),
      .wr_row_i(lower_wr_row_i),
      .wr_data_i(lower_wr_sum_i)
  );

  banked_memory #(
      .WIDTH(132),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_upper_sum (
      .clk_i,
      .check_i(edge_used),
      .fault_o(fault_upper_sum),
      .rd_en_i(edge_banks),
      .rd_row_i({BANKS{edge_item[QW-1:BANK_BITS]}}),
      .rd_data_o(upper_sum),
      .wr_en_i(sum_wr_i ? upper_wr_en_i : '0),
      .wr_row_i(upper_wr_row_i),
      .wr_data_i(upper_wr_sum_i)
  );

  // To nearest, ties to even.
  function automatic logic [31:0] quarter(input logic en, input logic [32:0] a,
                                          input logic [32:0] b);
    logic [33:0] sum;
    sum = {a[32], a} + {b[32], b};
    sum = sum + 34'd1 + 34'(sum[2]);
    quarter = en ? sum[33:2] : 32'd0;
  endfunction

  logic [132*LINE-1:0] lower_line, upper_line;

  assign lower_line = lower_sum[132*LINE*(32'(edge_bank_q)/LINE)+:132*LINE];
  assign upper_line = upper_sum[132*LINE*(32'(edge_bank_q)/LINE)+:132*LINE];

  always_comb begin
    edge_points_o = '0;
    for (int i = 0; i < LINE; i++)
      for (int k = 0; k < 4; k++)
        edge_points_o[i*128+k*32+:32] =
            quarter(edge_i, lower_line[i*132+k*33+:33], upper_line[i*132+k*33+:33]);
  end
  assign edge_point_o = edge_points_o[128*(32'(edge_bank_q)%LINE)+:128];

  // --- Corners, for check_twins -----------------------------------------------------------------------------
  logic [HALF-1:0] a, b;

  assign a = word[2*HALF+:HALF];
  assign b = word[3*HALF+:HALF];
  assign a_origin_o = a[VW-1:0];
  assign a_twin_o = a[2*VW+:QW];
  assign a_border_o = a[2*VW+2*HW] || a[2*VW+2*HW+2];
  assign a_sharpness_o = a[2*VW+2*HW+4+:4];
  assign a_last_o = a[2*VW+HW];
  assign a_first_o = a[2*VW+HW+1];
  assign b_origin_o = b[VW-1:0];
  assign b_twin_o = b[2*VW+:QW];
  assign b_border_o = b[2*VW+2*HW] || b[2*VW+2*HW+2];
  assign b_sharpness_o = b[2*VW+2*HW+4+:4];

endmodule
