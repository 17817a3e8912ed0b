// SPDX-License-Identifier: Apache-2.0
//
// smooth: goes over the vertices in the order of their numbers. In an odd step it moves those that
// may move; it sends those that this generation's final faces will name.
//
//   moves  = active, not held, not on the border of the active mesh, not sent before, and
//            on a crease:           RNE((T + 6 S) / 8)
//            smooth, valence n > 1: RNE((T + n(n-2) S) / n^2)
//   leaves = active, not sent before, and held or on the border; in the last step, or when nothing
//            is refined any more, every active vertex; after a last step all new vertices too
//   limit  = leaves, limit_i, not on the border, and in generation 0 of quads only: it is sent where
//            on a crease: RNE((M + 4 S) / 6)
//            smooth:      RNE(((n^2 - n) S + M) / (n^2 + 5n)) in even generations, whose M has n S,
//                         RNE((n^2 S + M) / (n^2 + 5n)) in odd ones
//            stays:       S
//
//   rows of marks --> pick a vertex --> position, sum --> division --> memories, send
//
//   * start_i for one cycle with count_i vertices and new_i new ones behind them. The settings hold
//     until active_o falls, which is when everything was sent. With limit_i last_i is never set.
//   * A vertex is active if its mark word's tag is this generation. In an odd step every active
//     vertex' old position is kept, moved or not: classify needs it in the even step.
//   * Rate: an active vertex a cycle; a row of vertices without work takes one cycle. In an even
//     step only vertices that leave are work. Where none moves and none has a limit, up to four of a
//     row leave in a cycle, in groups (group_*); with new_from_face_i new ones leave singly.
//   * write_valid_o: write_vertex_o gets the position (if write_move_o), the old position (if
//     write_old_o), and counts as sent (if write_sent_o). No vertex is read after it was written.
//   * send_valid_o/send_ready_i: vertices that leave, in order; send_at_level_o: with limit_i, at
//     the position of its level. What leaves at its limit is not written: the surface goes on with
//     the positions of the level. No vertex moves and leaves at once with limit_i, as what leaves is
//     held or on the border, or nothing is refined any more.

module smooth #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned OPS = 16,  // that wait for emit; 16 or more
    parameter bit WIDE = 1'b1  // several vertices may leave in a cycle
) (
    input logic clk_i,
    input logic rst_i,

    // from the sequencer
    input  logic        start_i,
    input  logic [VW:0] count_i,
    input  logic [VW:0] new_i,
    input  logic        odd_i,
    input  logic        last_i,    // the children of this step are final
    input  logic        finish_i,  // nothing is refined: all active faces are final
    input  logic [ 7:0] generation_i,
    output logic        active_o,

    // the view's settings
    input logic limit_i,
    input logic corners_stay_i,  // the boundary mode is smooth

    // mark and held memories, a row of all banks at a time
    output logic                         row_rd_en_o,
    output logic [     VW-BANK_BITS-1:0] row_rd_o,
    input  logic [13*(1<<BANK_BITS)-1:0] mark_rd_data_i,
    input  logic [   (1<<BANK_BITS)-1:0] held_rd_data_i,

    // position, sum, ring and sharp memories, a vertex at a time
    output logic          vertex_rd_en_o,
    output logic [VW-1:0] vertex_rd_index_o,
    input  logic [ 127:0] position_rd_data_i,
    input  logic [ 167:0] sum_rd_data_i,
    input  logic [ 176:0] ring_rd_data_i,
    input  logic [  17:0] sharp_rd_data_i,

    // face memory: the new vertices' positions where they are not in the vertex memory
    input  logic         new_from_face_i,
    output logic         face_rd_en_o,
    output logic [VW-1:0] face_rd_index_o,
    input  logic [127:0] face_rd_data_i,

    output logic          write_valid_o,
    output logic [VW-1:0] write_vertex_o,
    output logic          write_move_o,
    output logic          write_old_o,
    output logic          write_sent_o,
    output logic [ 127:0] write_position_o,
    output logic [ 127:0] write_before_o,

    // position memory, several vertices of a row, and their marks: they have been sent
    output logic [    (1<<BANK_BITS)-1:0] wide_rd_en_o,
    output logic [      VW-BANK_BITS-1:0] wide_rd_row_o,
    input  logic [128*(1<<BANK_BITS)-1:0] wide_rd_data_i,
    output logic [    (1<<BANK_BITS)-1:0] leave_wr_en_o,
    output logic [      VW-BANK_BITS-1:0] leave_wr_row_o,

    // to emit
    output logic            group_valid_o,
    input  logic            group_ready_i,
    output logic [4*VW-1:0] group_vertex_o,
    output logic [   511:0] group_position_o,
    output logic          send_valid_o,
    input  logic          send_ready_i,
    output logic [VW-1:0] send_vertex_o,
    output logic [ 127:0] send_position_o,
    output logic          send_at_level_o,

    // counters
    output logic busy_o,
    output logic starved_o,
    output logic blocked_o,
    output logic item_in_o,
    output logic item_out_o
);

  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned ROW_BITS = VW - BANK_BITS;

  // --- Rows: which of a row's vertices have work ------------------------------------------------------
  logic rows_q, fresh_q;  // rows remain; the row that is shown was just read
  logic [ROW_BITS-1:0] row_q;
  logic [BANKS-1:0] work, move, leave, border, done_q, pick;
  logic advance, stall, pick_row, last_row, wide;

  assign wide = WIDE && !limit_i && (!odd_i || finish_i);

  always_comb begin
    for (int b = 0; b < BANKS; b++) begin
      logic active, stays;
      active = mark_rd_data_i[b*13+5+:8] == generation_i &&
          {1'b0, row_q, BANK_BITS'(b)} < count_i;
      border[b] = mark_rd_data_i[b*13+3];
      stays = held_rd_data_i[b] || border[b];
      move[b] = active && odd_i && !stays && !mark_rd_data_i[b*13+4] && !finish_i;
      leave[b] = active && !mark_rd_data_i[b*13+4] && (stays || last_i || finish_i);
      work[b] = active && ((odd_i && !wide) || leave[b]) && !done_q[b];
    end
  end

  // The lowest, or the lowest four.
  always_comb begin
    logic [BANKS-1:0] left;
    left = work;
    pick = '0;
    for (int i = 0; i < 4; i++)
      if (i == 0 || wide) begin
        pick = pick | (left & (~left + BANKS'(1)));
        left = left & (left - BANKS'(1));
      end
  end
  assign pick_row = rows_q && fresh_q && work != '0 && !stall;
  assign advance = rows_q && fresh_q && (work == '0 || (!stall && work == pick));
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
    if (start_i) begin
      rows_q  <= count_i != '0;
      fresh_q <= 1'b1;
    end else if (advance && last_row) begin
      rows_q <= 1'b0;
    end
    if (rst_i) rows_q <= 1'b0;
  end

  // --- New vertices, after a last step -------------------------------------------------------------------
  logic [VW:0] new_left_q;
  logic [VW-1:0] new_q;
  logic pick_new;
  logic [2:0] new_count;  // that are picked at once: of a row
  logic [BANKS-1:0] new_mask;
  logic [BANK_BITS:0] row_left;

  assign row_left = (BANK_BITS + 1)'(BANKS) - {1'b0, new_q[BANK_BITS-1:0]};
  always_comb begin
    new_count = 3'd4;
    if (32'(row_left) < 32'd4) new_count = 3'(row_left);
    if (new_left_q < (VW + 1)'(new_count)) new_count = 3'(new_left_q);
    if (!wide || new_from_face_i) new_count = 3'd1;
    new_mask = ((BANKS'(1) << new_count) - BANKS'(1)) << new_q[BANK_BITS-1:0];
  end

  assign pick_new = !rows_q && new_left_q != '0 && !stall;

  always_ff @(posedge clk_i) begin
    if (start_i) begin
      new_left_q <= last_i ? new_i : '0;
      new_q <= count_i[VW-1:0];
    end else if (pick_new) begin
      new_left_q <= new_left_q - (VW + 1)'(new_count);
      new_q <= new_q + VW'(new_count);
    end
    if (rst_i) new_left_q <= '0;
  end

  // --- Read --------------------------------------------------------------------------------------------
  logic [BANK_BITS-1:0] pick_bank;
  logic read_q, read_move_q, read_leave_q, read_border_q, read_new_q;
  logic [VW-1:0] read_vertex_q;
  logic [127:0] position;

  always_comb begin
    pick_bank = '0;
    for (int b = 0; b < BANKS; b++) if (pick[b]) pick_bank = BANK_BITS'(b);
  end
  assign vertex_rd_en_o = (pick_row || pick_new) && !wide;
  assign face_rd_en_o = pick_new && new_from_face_i;
  assign face_rd_index_o = new_q - count_i[VW-1:0];
  assign vertex_rd_index_o = pick_row ? {row_q, pick_bank} : new_q;

  always_ff @(posedge clk_i) begin
    read_q <= vertex_rd_en_o;
    if (vertex_rd_en_o) begin
      read_vertex_q <= vertex_rd_index_o;
      read_move_q <= pick_row && (move & pick) != '0;
      read_leave_q <= pick_new || (leave & pick) != '0;
      read_border_q <= (border & pick) != '0;
      read_new_q <= pick_new;
    end
    if (rst_i) read_q <= 1'b0;
  end

  assign position = read_new_q && new_from_face_i ? face_rd_data_i : position_rd_data_i;

  // --- Wide: what leaves where it is ------------------------------------------------------------------------
  logic wide_q, wide_new_q, groups_stall, groups_active, single_valid, single_ready;
  logic [BANKS-1:0] wide_mask_q;
  logic [ROW_BITS-1:0] wide_row_q;
  logic [VW-1:0] single_vertex;
  logic [127:0] single_position;

  assign wide_rd_en_o = !wide ? '0 : pick_row ? pick : pick_new ? new_mask : '0;
  assign wide_rd_row_o = pick_row ? row_q : new_q[VW-1:BANK_BITS];

  always_ff @(posedge clk_i) begin
    wide_q <= wide_rd_en_o != '0;
    if (wide_rd_en_o != '0) begin
      wide_mask_q <= wide_rd_en_o;
      wide_row_q <= wide_rd_row_o;
      wide_new_q <= pick_new;
    end
    if (rst_i) wide_q <= 1'b0;
  end

  assign leave_wr_en_o = wide_q && !wide_new_q ? wide_mask_q : '0;
  assign leave_wr_row_o = wide_row_q;

  send_groups #(
      .VW(VW),
      .BANK_BITS(BANK_BITS),
      .GROUPS(OPS / 2)
  ) u_groups (
      .clk_i, .rst_i, .valid_i(wide_q), .mask_i(wide_mask_q), .row_i(wide_row_q),
      .positions_i(wide_new_q && new_from_face_i ? {BANKS{face_rd_data_i}} : wide_rd_data_i),
      .stall_o(groups_stall), .end_i(!rows_q && new_left_q == '0 && !wide_q), .group_valid_o,
      .group_ready_i, .group_vertex_o, .group_position_o, .single_valid_o(single_valid),
      .single_ready_i(single_ready), .single_vertex_o(single_vertex),
      .single_position_o(single_position), .active_o(groups_active)
  );

  // --- Which mask ----------------------------------------------------------------------------------------
  logic stays, crease, moves, limits, at_level;
  logic [7:0] n, level;

  assign level = 8'((9'(generation_i) + 9'd1) >> 1);
  assign n = limits ? ring_rd_data_i[175:168] : sum_rd_data_i[167:160];

  vertex_kind u_kind (
      .word_i(sharp_rd_data_i),
      .level_i(level),
      .corners_stay_i,
      .stays_o(stays),
      .crease_o(crease)
  );

  // For n = 1 the smooth mask is no average.
  assign moves = read_move_q && !stays && (crease || sum_rd_data_i[167:160] != 8'd1);
  assign at_level = read_leave_q && limit_i &&
      (read_border_q || (generation_i == 8'd0 && ring_rd_data_i[176]));
  assign limits = read_leave_q && limit_i && !at_level && !stays;

  // --- Dividend: a sum, and S times a weight ---------------------------------------------------------------
  // No weight of the masks is negative, so that it is at most 2^30 times the denominator in
  // magnitude: (255^2 + 5 * 255) 2^30 < 2^47. S(47.0) holds it, and each of its two terms.
  logic divide_valid_q, limits_q;
  logic [7:0] n_q;
  logic [4*48-1:0] dividend_q, sum;
  logic [127:0] quotient;
  logic signed [47:0] wide_n, weight;

  assign wide_n = {40'd0, n};

  always_comb begin
    for (int k = 0; k < 4; k++) begin
      logic [47:0] t, m;
      t = {{8{sum_rd_data_i[k*40+39]}}, sum_rd_data_i[k*40+:40]};
      m = {{6{ring_rd_data_i[k*42+41]}}, ring_rd_data_i[k*42+:42]};
      sum[k*48+:48] = limits ? m : crease ? t << 1 : t;
    end
    // On a crease 2T + 12S over 4^2, and M + 4S over 1^2 + 5.
    if (crease) weight = limits ? 48'sd4 : 48'sd12;
    else if (!limits) weight = wide_n * (wide_n - 48'sd2);
    else weight = wide_n * (generation_i[0] ? wide_n : wide_n - 48'sd1);
  end

  always_ff @(posedge clk_i) begin
    divide_valid_q <= read_q && (moves || limits);
    if (read_q && (moves || limits)) begin
      limits_q <= limits;
      n_q <= !crease ? n : limits ? 8'd1 : 8'd4;
      for (int k = 0; k < 4; k++)
        dividend_q[k*48+:48] <= $signed(sum[k*48+:48]) +
            weight * $signed({{16{position[k*32+31]}}, position[k*32+:32]});
    end
  end

  for (genvar k = 0; k < 4; k++) begin : g_divide
    divide u_divide (
        .clk_i,
        .valid_i(divide_valid_q),
        .limit_i(limits_q),
        .n_i(n_q),
        .x_i(dividend_q[k*48+:48]),
        .y_o(quotient[k*32+:32])
    );
  end

  // --- What goes along with the division, 5 cycles -----------------------------------------------------------
  logic [4:0] flight_q;
  logic along_move, along_limit, along_leave, along_new, along_at_level;
  logic [VW-1:0] along_vertex;
  logic [127:0] along_position;
  logic retire;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(5 + VW + 128),
      .DEPTH(8)
  ) u_along (
      .clk_i,
      .rst_i,
      .in_valid_i(read_q),
      .in_ready_o(),  // at most 6 are on their way
      .in_data_i({
        at_level, limits, read_new_q, read_leave_q, moves, read_vertex_q, position
      }),
      .out_valid_o(),  // as flight_q
      .out_ready_i(retire),
      .out_data_o({
        along_at_level, along_limit, along_new, along_leave, along_move, along_vertex,
        along_position
      }),
      .level_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  always_ff @(posedge clk_i) begin
    flight_q <= {flight_q[3:0], read_q};
    if (rst_i) flight_q <= '0;
  end
  assign retire = flight_q[4];

  assign write_valid_o = retire && !along_new;
  assign write_vertex_o = along_vertex;
  assign write_move_o = along_move;
  assign write_old_o = odd_i;
  assign write_sent_o = along_leave;
  assign write_position_o = quotient;
  assign write_before_o = along_position;

  // --- Send -----------------------------------------------------------------------------------------------------
  logic [$clog2(OPS):0] send_level;
  logic [127:0] leaves_at, moved_position;
  logic moved_valid, moved_at_level;
  logic [VW-1:0] moved_vertex;

  assign leaves_at = along_move || along_limit ? quotient : along_position;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(1 + VW + 128),
      .DEPTH(OPS)
  ) u_send (
      .clk_i,
      .rst_i,
      .in_valid_i(retire && along_leave),
      .in_ready_o(),  // stall keeps it high
      .in_data_i({along_at_level, along_vertex, leaves_at}),
      .out_valid_o(moved_valid),
      .out_ready_i(send_ready_i),
      .out_data_o({moved_at_level, moved_vertex, moved_position}),
      .level_o(send_level)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  // Six may be on their way, and one is picked before the level shows the one before it.
  assign stall = wide ? groups_stall : send_level > ($clog2(OPS) + 1)'(OPS - 8);

  // The two ways never have something at the same time.
  assign send_valid_o = moved_valid || single_valid;
  assign single_ready = send_ready_i && !moved_valid;
  assign send_vertex_o = moved_valid ? moved_vertex : single_vertex;
  assign send_position_o = moved_valid ? moved_position : single_position;
  assign send_at_level_o = moved_valid && moved_at_level;

  // --- Counters ----------------------------------------------------------------------------------------------
  assign active_o = rows_q || new_left_q != '0 || read_q || flight_q != '0 || wide_q || groups_active || send_valid_o;
  assign busy_o = vertex_rd_en_o || wide_rd_en_o != '0;
  assign blocked_o = stall && ((rows_q && work != '0) || (!rows_q && new_left_q != '0));
  assign starved_o = active_o && !busy_o && !blocked_o;
  assign item_in_o = busy_o;
  assign item_out_o = retire || wide_q;

endmodule
