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
//   smooth_walk --> one vertex: position, sum --> division --> memories, lanes --> send_groups --> emit
//               '-> up to four: positions --------------------------> lanes
//
//   * start_i for one cycle with count_i vertices and new_i new ones behind them. The settings hold
//     until active_o falls, which is when everything was sent. With limit_i last_i is never set.
//   * A vertex is active if its mark word's tag is generation_i: the one whose classify ran last, which
//     in an even step behind one pass of classify and split is the one before. In an odd step every
//     active vertex' old position is kept (keep_*), moved or not: classify needs it in the even step.
//   * Rate: a vertex that moves, or four of a row that do not, a cycle (smooth_walk.sv).
//   * write_valid_o: write_vertex_o gets the position (if write_move_o), and counts as sent (if
//     write_sent_o). No vertex is read after it was written.
//   * group_*, send_*: vertices that leave, in order, four at a time and, behind the last group, singly;
//     with limit_i all singly, and send_at_level_o says that a vertex leaves at
//     the position of its level. What leaves at its limit is not written: the surface goes on with
//     the positions of the level. No vertex moves and leaves at once with limit_i, as what leaves is
//     held or on the border, or nothing is refined any more.

module smooth #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned OPS = 16,  // that wait for emit; 16 or more
    parameter bit WIDE = 1'b1,  // else all are picked, and leave, singly
    parameter bit PARITY = 1'b1
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
    output logic [   (1<<BANK_BITS)-1:0] row_there_o,   // as smooth_walk's
    output logic [   (1<<BANK_BITS)-1:0] held_used_o,

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
    input  logic [511:0] face_rd_data_i,  // of the faces in line

    output logic          write_valid_o,
    output logic [VW-1:0] write_vertex_o,
    output logic          write_move_o,
    output logic          write_sent_o,
    output logic [ 127:0] write_position_o,

    // what was read in the cycle before is kept as the old position, a vertex or several of a row
    output logic [    (1<<BANK_BITS)-1:0] keep_wr_en_o,
    output logic [      VW-BANK_BITS-1:0] keep_wr_row_o,

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
    output logic [1:0] item_out_o,
    output logic fault_o
);

  localparam int unsigned ROW_BITS = VW - BANK_BITS;

  // --- Which vertices, and when -------------------------------------------------------------------
  logic walking, waits, stall, single_busy;
  logic single, single_new, single_move, single_leave, single_border;
  logic row, new_pick;
  logic [VW-1:0] single_vertex, new_vertex;
  logic [ROW_BITS-1:0] row_number;
  logic [(1<<BANK_BITS)-1:0] row_mask, row_leave, new_mask;
  logic [2:0] new_count;

  smooth_walk #(
      .VW(VW),
      .BANK_BITS(BANK_BITS),
      .WIDE(WIDE)
  ) u_walk (
      .clk_i, .rst_i, .start_i, .count_i, .new_i, .odd_i, .last_i, .finish_i, .limit_i,
      .new_from_face_i, .generation_i, .active_o(walking), .waits_o(waits), .row_rd_en_o,
      .row_rd_o, .mark_rd_data_i, .held_rd_data_i, .row_there_o, .held_used_o, .stall_i(stall), .single_busy_i(single_busy),
      .single_o(single), .single_vertex_o(single_vertex), .single_new_o(single_new),
      .single_move_o(single_move), .single_leave_o(single_leave),
      .single_border_o(single_border), .row_o(row), .row_number_o(row_number),
      .row_mask_o(row_mask), .row_leave_o(row_leave), .new_o(new_pick),
      .new_vertex_o(new_vertex), .new_count_o(new_count)
  );

  // --- Read --------------------------------------------------------------------------------------
  logic read_q, read_move_q, read_leave_q, read_border_q, read_new_q;
  logic [VW-1:0] read_vertex_q;
  logic [127:0] position;

  assign vertex_rd_en_o = single;
  assign vertex_rd_index_o = single_vertex;
  assign face_rd_en_o = new_pick && new_from_face_i;
  assign face_rd_index_o = new_vertex - count_i[VW-1:0];
  assign new_mask = (((1<<BANK_BITS))'(1) << new_count) - ((1<<BANK_BITS))'(1);
  assign wide_rd_en_o = row ? row_mask :
      new_pick && !new_from_face_i ? new_mask << new_vertex[BANK_BITS-1:0] : '0;
  assign wide_rd_row_o = row ? row_number : new_vertex[VW-1:BANK_BITS];

  always_ff @(posedge clk_i) begin
    read_q <= single;
    if (single) begin
      read_vertex_q <= single_vertex;
      read_move_q <= single_move;
      read_leave_q <= single_leave;
      read_border_q <= single_border;
      read_new_q <= single_new;
    end
    if (rst_i) read_q <= 1'b0;
  end

  assign position = position_rd_data_i;

  // --- What is picked together: the words that came, in lanes ---------------------------------------
  localparam int unsigned LANE = VW + 128;  // {vertex, position}
  localparam int unsigned LINE = BANK_BITS < 2 ? 2 : 4;  // faces

  logic wide_q, wide_new_q, from_face_q;
  logic [(1<<BANK_BITS)-1:0] wide_mask_q, wide_leave_q;
  logic [ROW_BITS-1:0] wide_row_q;
  logic [VW-1:0] wide_vertex_q;
  logic [2:0] wide_count_q, row_count;
  logic [4*LANE-1:0] row_lane, face_lane;

  always_ff @(posedge clk_i) begin
    wide_q <= row || new_pick;
    if (row || new_pick) begin
      wide_new_q <= new_pick;
      from_face_q <= new_pick && new_from_face_i;
      wide_mask_q <= wide_rd_en_o;
      wide_leave_q <= row ? row_leave : wide_rd_en_o;
      wide_row_q <= wide_rd_row_o;
      wide_vertex_q <= new_vertex;
      wide_count_q <= new_count;
    end
    if (rst_i) wide_q <= 1'b0;
  end

  row_lanes #(
      .WIDTH(128),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS)
  ) u_lanes (
      .mask_i(wide_q ? wide_leave_q : '0), .row_i(wide_row_q), .words_i(wide_rd_data_i),
      .count_o(row_count), .lanes_o(row_lane)
  );

  // Faces come in lines; the first that is wanted may not be its line's first.
  always_comb begin
    logic [1:0] face;
    face = wide_vertex_q[1:0] - count_i[1:0];
    for (int i = 0; i < 4; i++)
      face_lane[i*LANE+:LANE] = {
        wide_vertex_q + VW'(i), face_rd_data_i[128*((32'(face)+i)%LINE)+:128]
      };
  end

  assign leave_wr_en_o = wide_q && !wide_new_q ? wide_leave_q : '0;
  assign leave_wr_row_o = wide_row_q;

  // In an odd step what was read is kept, a vertex or several of a row.
  assign keep_wr_en_o = !odd_i ? '0 :
      read_q && !read_new_q ? ((1<<BANK_BITS))'(1) << read_vertex_q[BANK_BITS-1:0] :
      wide_q && !wide_new_q ? wide_mask_q : '0;
  assign keep_wr_row_o = read_q ? read_vertex_q[VW-1:BANK_BITS] : wide_row_q;

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
      .DEPTH(8), .PARITY(PARITY)
  ) u_along (
      .fault_o(along_fault),
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
  assign write_sent_o = along_leave;
  assign write_position_o = quotient;

  // --- Send: in groups, or with limit_i one by one ------------------------------------------------
  logic [$clog2(OPS):0] send_level;
  logic [127:0] leaves_at, moved_position, rest_position;
  logic along_fault, send_fault, groups_fault;
  logic limit_valid, rest_valid, leaves_now, groups_stall, groups_active, limit_at_level;
  logic [VW-1:0] moved_vertex, rest_vertex;

  assign leaves_at = along_move || along_limit ? quotient : along_position;
  assign leaves_now = retire && along_leave;

  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(1 + VW + 128),
      .DEPTH(OPS), .PARITY(PARITY)
  ) u_send (
      .fault_o(send_fault),
      .clk_i,
      .rst_i,
      .in_valid_i(leaves_now && (limit_i || !WIDE)),
      .in_ready_o(),  // stall keeps it high
      .in_data_i({along_at_level, along_vertex, leaves_at}),
      .out_valid_o(limit_valid),
      .out_ready_i(send_ready_i),
      .out_data_o({limit_at_level, moved_vertex, moved_position}),
      .level_o(send_level)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  logic [2:0] lane_count;
  logic [4*LANE-1:0] lane;

  always_comb begin
    lane_count = from_face_q ? wide_count_q : row_count;
    lane = from_face_q ? face_lane : row_lane;
    if (!wide_q) lane_count = 3'd0;
    if (leaves_now && !limit_i && WIDE) begin
      lane_count = 3'd1;
      lane = {{3 * LANE{1'b0}}, along_vertex, leaves_at};
    end
  end

  send_groups #(
      .VW(VW),
      .GROUPS(OPS / 2), .PARITY(PARITY)
  ) u_groups (
      .fault_o(groups_fault),
      .clk_i, .rst_i, .count_i(lane_count), .lanes_i(lane), .stall_o(groups_stall),
      .end_i(!walking && !wide_q && !single_busy), .group_valid_o, .group_ready_i,
      .group_vertex_o, .group_position_o, .single_valid_o(rest_valid),
      .single_ready_i(send_ready_i && !limit_valid), .single_vertex_o(rest_vertex),
      .single_position_o(rest_position), .active_o(groups_active)
  );

  // Six may be on their way, and one is picked before the level shows the one before it.
  assign stall = limit_i || !WIDE ? send_level > ($clog2(OPS) + 1)'(OPS - 8) : groups_stall;
  assign single_busy = read_q || flight_q != '0;

  // The two ways never have something at the same time.
  assign send_valid_o = limit_valid || rest_valid;
  assign send_vertex_o = limit_valid ? moved_vertex : rest_vertex;
  assign send_position_o = limit_valid ? moved_position : rest_position;
  assign send_at_level_o = limit_valid && limit_at_level;

  // --- Counters ----------------------------------------------------------------------------------------------
  assign active_o = walking || single_busy || wide_q || groups_active || send_valid_o;
  assign busy_o = single || row || new_pick;
  assign blocked_o = waits;
  assign starved_o = active_o && !busy_o && !blocked_o;
  assign item_in_o = busy_o;
  assign item_out_o = 2'(retire) + 2'(wide_q);
  assign fault_o = along_fault || send_fault || groups_fault;

`ifdef HS_FORMAL
`include "activity.svh"
`endif

endmodule
