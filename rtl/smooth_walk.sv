// SPDX-License-Identifier: Apache-2.0
//
// smooth_walk: the part of smooth that goes over the marks, row by row, and picks vertices: singly
// where they are divided, up to four of a row where they stay where they are.
//
//                       move        stay          leave           picked
//   even step           -           -             x               four of those that leave
//   odd step            x           x             x               four that do not move, then the
//                                                                 movers singly
//   last odd step       x           x             all             singly
//   with limit          as even and odd ones                      singly
//
//   * start_i for one cycle with count_i vertices and new_i new ones behind them, which all leave,
//     four at a time. A row of vertices without work takes one cycle.
//   * A pick is one of single_*, row_* or new_*, in a cycle without stall_i; what moves, but does not
//     leave yet, needs no room and heeds no stall. New ones come when nothing is on its way singly any
//     more (single_busy_i).
//   * single_move_o: it may move; row_mask_o: the vertices of the row, row_leave_o: those of them
//     that leave. new_vertex_o and the new_count_o - 1 behind it: in the vertex memory a row's, in
//     the face memory (new_from_face_i) those of
//     faces in line, four or as many as there are banks.
//   * waits_o: a pick that is stalled. active_o: there is more to pick, or to look at.

module smooth_walk #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned BANK_BITS = 3,
    parameter bit WIDE = 1'b1  // else all are picked singly, and new_from_face_i is illegal
) (
    input logic clk_i,
    input logic rst_i,

    // the step: as smooth's
    input  logic        start_i,
    input  logic [VW:0] count_i,
    input  logic [VW:0] new_i,
    input  logic        odd_i,
    input  logic        last_i,
    input  logic        finish_i,
    input  logic        limit_i,
    input  logic        new_from_face_i,
    input  logic [ 7:0] generation_i,
    output logic        active_o,
    output logic        waits_o,

    // mark and held memories
    output logic                         row_rd_en_o,
    output logic [     VW-BANK_BITS-1:0] row_rd_o,
    input  logic [13*(1<<BANK_BITS)-1:0] mark_rd_data_i,
    input  logic [   (1<<BANK_BITS)-1:0] held_rd_data_i,
    output logic [   (1<<BANK_BITS)-1:0] row_there_o,   // vertices of the row that was read which exist,
    output logic [   (1<<BANK_BITS)-1:0] held_used_o,   // and those whose held is looked at

    input logic stall_i,
    input logic single_busy_i,

    output logic          single_o,
    output logic [VW-1:0] single_vertex_o,
    output logic          single_new_o,
    output logic          single_move_o,
    output logic          single_leave_o,
    output logic          single_border_o,

    output logic                      row_o,
    output logic [VW-BANK_BITS-1:0]   row_number_o,
    output logic [(1<<BANK_BITS)-1:0] row_mask_o,
    output logic [(1<<BANK_BITS)-1:0] row_leave_o,

    output logic          new_o,
    output logic [VW-1:0] new_vertex_o,
    output logic [   2:0] new_count_o
);

  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned ROW_BITS = VW - BANK_BITS;
  localparam int unsigned LINE = BANKS < 4 ? BANKS : 4;  // faces

  logic leaves_only, mixed;  // a step whose picks are all of rows; one with both kinds

  assign leaves_only = WIDE && !limit_i && (!odd_i || finish_i);
  assign mixed = WIDE && !limit_i && odd_i && !finish_i && !last_i;

  // --- Rows: which of a row's vertices have work -------------------------------------------------
  logic rows_q;  // rows remain
  logic [ROW_BITS-1:0] row_q;
  logic [BANKS-1:0] work, move, leave, border, done_q, pick, pickable;
  logic together, advance, stall, pick_row, last_row;

  always_comb begin
    for (int b = 0; b < BANKS; b++) begin
      logic active, stays;
      row_there_o[b] = {1'b0, row_q, BANK_BITS'(b)} < count_i;
      active = mark_rd_data_i[b*13+5+:8] == generation_i && row_there_o[b];
      border[b] = mark_rd_data_i[b*13+3];
      stays = held_rd_data_i[b] || border[b];
      move[b] = active && odd_i && !stays && !mark_rd_data_i[b*13+4] && !finish_i;
      leave[b] = active && !mark_rd_data_i[b*13+4] && (stays || last_i || finish_i);
      held_used_o[b] = active && !border[b] && !mark_rd_data_i[b*13+4] && !finish_i && (odd_i || !last_i);
      work[b] = active && ((odd_i && !leaves_only) || leave[b]) && !done_q[b];
    end
  end

  // The lowest, or the lowest four.
  assign together = leaves_only || (mixed && (work & ~move) != '0);
  assign pickable = together && mixed ? work & ~move : work;

  always_comb begin
    logic [BANKS-1:0] left;
    left = pickable;
    pick = '0;
    for (int i = 0; i < 4; i++)
      if (i == 0 || together) begin
        pick = pick | (left & (~left + BANKS'(1)));
        left = left & (left - BANKS'(1));
      end
  end
  assign stall = stall_i && (together || !mixed);
  assign pick_row = rows_q && work != '0 && !stall;
  assign advance = rows_q && (work == '0 || (!stall && work == pick));
  assign last_row = {1'b0, row_q, {BANK_BITS{1'b1}}} + (VW + 1)'(1) >= count_i;
  assign row_rd_en_o = start_i || advance;
  assign row_rd_o = start_i ? '0 : row_q + ROW_BITS'(1);

  always_ff @(posedge clk_i) begin
    if (row_rd_en_o) begin
      row_q  <= row_rd_o;
      done_q <= '0;
    end else if (pick_row) begin
      done_q <= done_q | pick;
    end
    if (start_i) rows_q <= count_i != '0;
    else if (advance && last_row) rows_q <= 1'b0;
    if (rst_i) rows_q <= 1'b0;
  end

  assign row_o = pick_row && together;
  assign row_number_o = row_q;
  assign row_mask_o = pick;
  assign row_leave_o = leave & pick;

  // --- New vertices, after a last step ------------------------------------------------------------
  logic [VW:0] new_left_q;
  logic [VW-1:0] new_q;
  logic [1:0] face;  // in its line, if that has four
  logic [BANK_BITS:0] row_left;
  logic [2:0] faces_left;
  logic pick_new, new_waits;

  assign face = new_q[1:0] - count_i[1:0];
  assign row_left = (BANK_BITS + 1)'(BANKS) - {1'b0, new_q[BANK_BITS-1:0]};
  assign faces_left = 3'(LINE) - {1'b0, face & 2'(LINE - 1)};
  assign new_waits = stall_i || (WIDE && single_busy_i);
  assign pick_new = !rows_q && new_left_q != '0 && !new_waits;

  always_comb begin
    new_count_o = 3'd4;
    if (new_from_face_i) new_count_o = faces_left;
    else if (32'(row_left) < 32'd4) new_count_o = 3'(row_left);
    if (new_left_q < (VW + 1)'(new_count_o)) new_count_o = 3'(new_left_q);
    if (!WIDE) new_count_o = 3'd1;
  end

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      new_left_q <= last_i ? new_i : '0;
      new_q <= count_i[VW-1:0];
    end else if (pick_new) begin
      new_left_q <= new_left_q - (VW + 1)'(new_count_o);
      new_q <= new_q + VW'(new_count_o);
    end
    if (rst_i) new_left_q <= '0;
  end

  assign new_o = pick_new && WIDE;
  assign new_vertex_o = new_q;

  // --- Singly ------------------------------------------------------------------------------------
  logic [BANK_BITS-1:0] pick_bank;

  always_comb begin
    pick_bank = '0;
    for (int b = 0; b < BANKS; b++) if (pick[b]) pick_bank = BANK_BITS'(b);
  end

  assign single_o = (pick_row && !together) || (pick_new && !WIDE);
  assign single_vertex_o = pick_row ? {row_q, pick_bank} : new_q;
  assign single_new_o = !pick_row;
  assign single_move_o = pick_row && (move & pick) != '0;
  assign single_leave_o = !pick_row || (leave & pick) != '0;
  assign single_border_o = pick_row && (border & pick) != '0;

  assign active_o = rows_q || new_left_q != '0;
  assign waits_o = rows_q ? work != '0 && stall : new_left_q != '0 && new_waits;

endmodule
