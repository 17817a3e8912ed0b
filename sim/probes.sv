// SPDX-License-Identifier: Apache-2.0
//
// Looks at the stage boundaries of the RTL, for simulation only: every transaction is handed to
// hs_probe (sim/rtl_shim.cpp) in the cycle in which it happens. definitions.def (PROBE) says what
// passes where; the modules here are bound to the RTL's, which know nothing of it.

/* verilator lint_off DECLFILENAME */  // one file for all that is bound
package probes;
  // Whether anyone looks: asked first, since what a probe shows costs time.
  import "DPI-C" function bit hs_probe_on();
  import "DPI-C" context function void hs_probe(
    input int unsigned probe,
    input int unsigned item,
    input int unsigned a,
    input int unsigned b,
    input int unsigned c,
    input int unsigned d
  );
endpackage

// The streams, and what lies before the first generation.
module probe_pipeline #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19,
    parameter int unsigned PORT_RECORDS = 4
) (
    input logic clk_i,
    input logic rst_i,
    input logic in_taken,
    input logic [16*PORT_RECORDS-1:0] in_keep,
    input logic raw_valid,
    input logic [VW-1:0] raw_index,
    input logic [127:0] raw,
    input logic corner_valid,
    input logic [QW-1:0] corner_index,
    input logic [VW-1:0] corner_origin,
    input logic [QW-1:0] corner_twin,
    input logic [3:0] corner_flags,
    input logic [3:0] corner_sharpness,
    input logic [3:0] corner_own,
    input logic [7:0] corner_forced,
    input logic clip_valid,
    input logic [VW-1:0] clip_index,
    input logic [127:0] clip,
    input logic quantize_wr,
    input logic [VW-1:0] quantize_wr_index,
    input logic [127:0] quantize_wr_data,
    input logic [4:0] kick,  // split, smooth, guard, select, classify: as the stages are numbered, from the right
    input logic [7:0] generation,
    input logic [QW:0] items,
    input logic [VW:0] vertices,
    input logic out_taken,
    input logic out_last,
    input logic [128*PORT_RECORDS-1:0] out_data
);
  int unsigned beats_in_q, beats_out_q, stage;
  logic [127:0] folded;
  int unsigned beat_records;

  always_comb begin
    folded = '0;
    beat_records = 0;
    for (int r = 0; r < PORT_RECORDS; r++) begin
      folded = folded ^ out_data[128*r+:128];
      beat_records = beat_records + 32'(in_keep[16*r]);
    end
    // In the order of refine: classify, select, guard, smooth, split.
    stage = 0;
    for (int s = 4; s >= 0; s--) if (kick[s]) stage = 32'(hs_pkg::STAGE_classify) + s;
  end

  always_ff @(posedge clk_i) begin
    if (in_taken) beats_in_q <= beats_in_q + 1;
    if (out_taken) begin
      beats_out_q <= out_last ? 0 : beats_out_q + 1;
      if (out_last) beats_in_q <= 0;
    end
    if (rst_i) begin
      beats_in_q  <= 0;
      beats_out_q <= 0;
    end
    if (probes::hs_probe_on()) begin
      if (in_taken) probes::hs_probe(hs_pkg::PROBE_beat_in, beats_in_q, beat_records, 0, 0, 0);
      if (raw_valid)
        probes::hs_probe(hs_pkg::PROBE_vertex_in, 32'(raw_index), raw[31:0], raw[63:32],
                         raw[95:64], raw[127:96]);
      if (corner_valid)
        probes::hs_probe(hs_pkg::PROBE_corner_in, 32'(corner_index), 32'(corner_origin),
                         corner_flags[1:0] != 2'd0 ? 32'd0 : 32'(corner_twin), 32'(corner_flags),
                         {16'd0, corner_own, corner_sharpness, corner_forced});
      if (clip_valid)
        probes::hs_probe(hs_pkg::PROBE_clip, 32'(clip_index), clip[31:0], clip[63:32],
                         clip[95:64], clip[127:96]);
      if (quantize_wr)
        probes::hs_probe(hs_pkg::PROBE_quantized, 32'(quantize_wr_index), quantize_wr_data[31:0],
                         quantize_wr_data[63:32], quantize_wr_data[95:64],
                         quantize_wr_data[127:96]);
      if (kick != '0)
        probes::hs_probe(hs_pkg::PROBE_kick, stage, 32'(generation), 32'(items), 32'(vertices),
                         32'(kick));
      if (out_taken)
        probes::hs_probe(hs_pkg::PROBE_beat_out, beats_out_q, folded[31:0], folded[63:32],
                         folded[95:64], folded[127:96]);
    end
  end
endmodule

bind pipeline probe_pipeline #(
    .VW(VW), .QW(QW), .PORT_RECORDS(PORT_RECORDS)
) u_probe (
    .clk_i, .rst_i, .in_taken(s_axis_tvalid && s_axis_tready), .in_keep(s_axis_tkeep), .raw_valid,
    .raw_index, .raw, .corner_valid, .corner_index, .corner_origin, .corner_twin,
    .corner_flags({corner_last, corner_first, corner_boundary, corner_border}), .corner_sharpness,
    .corner_own, .corner_forced, .clip_valid, .clip_index, .clip, .quantize_wr, .quantize_wr_index,
    .quantize_wr_data, .kick({kick_split, kick_smooth, kick_guard, kick_select, kick_classify}),
    .generation, .items, .vertices, .out_taken(m_axis_tvalid && m_axis_tready),
    .out_last(m_axis_tlast), .out_data(m_axis_tdata)
);

// The items that a stage takes, numbered from its start.
module probe_items #(
    parameter int unsigned VW = 19,
    parameter int unsigned PROBE = 0
) (
    input logic clk_i,
    input logic start_i,
    input logic taken,
    input logic [3:0] lanes,
    input logic [4*VW-1:0] origin
);
  int unsigned item_q;
  logic [127:0] word;

  always_comb begin
    for (int i = 0; i < 4; i++)
      word[i*32+:32] = lanes[i] ? 32'(origin[i*VW+:VW]) : 32'hffffffff;
  end

  always_ff @(posedge clk_i) begin
    if (start_i) item_q <= 0;
    else if (taken) item_q <= item_q + 1;
    if (taken && probes::hs_probe_on())
      probes::hs_probe(PROBE, item_q, word[31:0], word[63:32], word[95:64], word[127:96]);
  end
endmodule

bind classify probe_items #(
    .VW(VW), .PROBE(hs_pkg::PROBE_classify_in)
) u_probe_in (
    .clk_i, .start_i, .taken(fetch_valid && fetch_ready),
    .lanes(!quads_i ? 4'b0001 : record_half_i ? 4'b0111 : 4'b1111), .origin(record_origin_i)
);
bind select probe_items #(
    .VW(VW), .PROBE(hs_pkg::PROBE_select_in)
) u_probe_in (
    .clk_i, .start_i, .taken(fetch_valid && fetch_ready),
    .lanes(!quads_i ? 4'b0001 : record_half_i ? 4'b0111 : 4'b1111), .origin(record_origin_i)
);
bind guard probe_items #(
    .VW(VW), .PROBE(hs_pkg::PROBE_guard_in)
) u_probe_in (
    .clk_i, .start_i, .taken(fetch_valid && fetch_ready), .lanes(fetch_lanes),
    .origin(record_origin_i)
);
bind split probe_items #(
    .VW(VW), .PROBE(hs_pkg::PROBE_split_in)
) u_probe_in (
    .clk_i, .start_i, .taken(busy_o), .lanes(pass_i ? 4'b1111 : lanes),
    .origin(pass_i ? pass_origin_i : record_origin_i)
);

module probe_classify #(
    parameter int unsigned QW = 19
) (
    input logic clk_i,
    input logic point_valid_o,
    input logic [QW-1:0] point_face_o,
    input logic [127:0] point_o,
    input logic front_o,
    input logic stop_o,
    input logic given,
    input logic [QW-1:0] give_corner,
    input logic [3:0] give_mask,
    input logic [15:0] give_marks
);
  logic [15:0] marks;
  always_comb for (int i = 0; i < 4; i++) marks[4*i+:4] = give_mask[i] ? give_marks[4*i+:4] : 4'd0;

  always_ff @(posedge clk_i)
    if (probes::hs_probe_on()) begin
      if (point_valid_o)
        probes::hs_probe(hs_pkg::PROBE_classify_face, {stop_o, front_o, 30'(point_face_o)},
                         point_o[31:0], point_o[63:32], point_o[95:64], point_o[127:96]);
      if (given)
        probes::hs_probe(hs_pkg::PROBE_classify_out, 32'(give_corner), 32'(marks), 0, 0, 0);
    end
endmodule

bind classify probe_classify #(
    .QW(QW)
) u_probe (
    .clk_i, .point_valid_o, .point_face_o, .point_o, .front_o, .stop_o, .given(give && take && pass_ready),
    .give_corner, .give_mask, .give_marks
);

module probe_select #(
    parameter int unsigned QW = 19
) (
    input logic clk_i,
    input logic start_i,
    input logic selected_valid_o,
    input logic [QW-1:0] selected_face_o,
    input logic selected_verdict_o,
    input logic out,
    input logic fold_verdict
);
  int unsigned item_q;

  always_ff @(posedge clk_i) begin
    if (start_i) item_q <= 0;
    else if (out) item_q <= item_q + 1;
    if (probes::hs_probe_on()) begin
      if (selected_valid_o)
        probes::hs_probe(hs_pkg::PROBE_select_face, 32'(selected_face_o), 32'(selected_verdict_o),
                         0, 0, 0);
      if (out) probes::hs_probe(hs_pkg::PROBE_select_out, item_q, 32'(fold_verdict), 0, 0, 0);
    end
  end
endmodule

bind select probe_select #(
    .QW(QW)
) u_probe (
    .clk_i, .start_i, .selected_valid_o, .selected_face_o, .selected_verdict_o,
    .out(fold_valid && fold_ready), .fold_verdict
);

module probe_guard #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19
) (
    input logic clk_i,
    input logic new_valid_o,
    input logic [VW-1:0] new_vertex_o,
    input logic [127:0] new_position_o,
    input logic verdict_valid_o,
    input logic [QW-1:0] verdict_item_o,
    input logic [VW+1:0] verdict_o
);
  always_ff @(posedge clk_i)
    if (probes::hs_probe_on()) begin
      if (new_valid_o)
        probes::hs_probe(hs_pkg::PROBE_guard_new, 32'(new_vertex_o), new_position_o[31:0],
                         new_position_o[63:32], new_position_o[95:64], new_position_o[127:96]);
      if (verdict_valid_o)
        probes::hs_probe(hs_pkg::PROBE_guard_out, 32'(verdict_item_o), 32'(verdict_o[VW+1]),
                         32'(verdict_o[VW]), 32'(verdict_o[VW-1:0]), 0);
    end
endmodule

bind guard probe_guard #(
    .VW(VW), .QW(QW)
) u_probe (
    .clk_i, .new_valid_o, .new_vertex_o, .new_position_o, .verdict_valid_o, .verdict_item_o,
    .verdict_o
);

module probe_smooth #(
    parameter int unsigned VW = 19,
    parameter int unsigned BANK_BITS = 3
) (
    input logic clk_i,
    input logic single,
    input logic [VW-1:0] single_vertex,
    input logic row,
    input logic [VW-BANK_BITS-1:0] row_number,
    input logic [(1<<BANK_BITS)-1:0] row_mask,
    input logic [(1<<BANK_BITS)-1:0] row_leave,
    input logic new_pick,
    input logic [VW-1:0] new_vertex,
    input logic [2:0] new_count,
    input logic write_valid_o,
    input logic [VW-1:0] write_vertex_o,
    input logic write_move_o,
    input logic write_sent_o,
    input logic [95:0] write_position
);
  logic [95:0] moved;
  assign moved = write_move_o ? write_position : 96'd0;

  always_ff @(posedge clk_i)
    if (probes::hs_probe_on()) begin
      if (single) probes::hs_probe(hs_pkg::PROBE_smooth_in, 32'(single_vertex), 0, 0, 0, 0);
      if (row)
        probes::hs_probe(hs_pkg::PROBE_smooth_in, 32'({row_number, BANK_BITS'(0)}), 32'(row_mask),
                         32'(row_leave), 0, 0);
      if (new_pick)
        probes::hs_probe(hs_pkg::PROBE_smooth_in, 32'(new_vertex), 0, 0, 32'(new_count), 0);
      if (write_valid_o)
        probes::hs_probe(hs_pkg::PROBE_smooth_out, 32'(write_vertex_o),
                         {30'd0, write_sent_o, write_move_o}, moved[31:0], moved[63:32],
                         moved[95:64]);
    end
endmodule

bind smooth probe_smooth #(
    .VW(VW), .BANK_BITS(BANK_BITS)
) u_probe (
    .clk_i, .single, .single_vertex, .row, .row_number, .row_mask, .row_leave, .new_pick,
    .new_vertex, .new_count, .write_valid_o, .write_vertex_o, .write_move_o, .write_sent_o,
    .write_position(write_position_o[95:0])
);

module probe_split_number #(
    parameter int unsigned QW = 19
) (
    input logic clk_i,
    input logic valid_i,
    input logic [QW-1:0] item_i,
    input logic [QW:0] count_q,
    input logic [3:0] lower
);
  always_ff @(posedge clk_i)
    if (valid_i && probes::hs_probe_on())
      probes::hs_probe(hs_pkg::PROBE_split_number, 32'(item_i), 32'(count_q), 32'(lower), 0, 0);
endmodule

bind split_number probe_split_number #(
    .QW(QW)
) u_probe (
    .clk_i, .valid_i, .item_i, .count_q, .lower
);

module probe_split_write #(
    parameter int unsigned QW = 19
) (
    input logic clk_i,
    input logic start_i,
    input logic lower_taken,
    input logic [3:0] lower_mask,
    input logic upper_taken,
    input logic [3:0] upper_mask,
    input logic [4*QW-1:0] quad,
    input logic done,
    input logic [3:0] replaced,
    input logic [3:0] lower
);
  int unsigned item_q;
  logic [127:0] lower_word, upper_word;

  always_comb
    for (int i = 0; i < 4; i++) begin
      lower_word[i*32+:32] = lower_mask[i] ? 32'(quad[i*QW+:QW]) : 32'hffffffff;
      upper_word[i*32+:32] = upper_mask[i] ? 32'(quad[i*QW+:QW]) : 32'hffffffff;
    end

  always_ff @(posedge clk_i) begin
    if (start_i) item_q <= 0;
    else if (done) item_q <= item_q + 1;
    if (probes::hs_probe_on()) begin
      if (lower_taken)
        probes::hs_probe(hs_pkg::PROBE_split_lower, item_q, lower_word[31:0], lower_word[63:32],
                         lower_word[95:64], lower_word[127:96]);
      if (upper_taken)
        probes::hs_probe(hs_pkg::PROBE_split_upper, item_q, upper_word[31:0], upper_word[63:32],
                         upper_word[95:64], upper_word[127:96]);
      if (done) probes::hs_probe(hs_pkg::PROBE_split_out, item_q, 32'(replaced), 32'(lower), 0, 0);
    end
  end
endmodule

bind split_write probe_split_write #(
    .QW(QW)
) u_probe (
    .clk_i, .start_i,
    .lower_taken(valid_q && known && lower_mask != 4'b0000 && !lower_done_q && lower_ready),
    .lower_mask,
    .upper_taken(valid_q && known && upper_mask != 4'b0000 && !upper_done_q && upper_ready),
    .upper_mask, .quad, .done, .replaced, .lower
);

module probe_emit (
    input logic clk_i,
    input logic op_taken,
    input logic [2:0] op_kind_i,
    input logic [23:0] op_number_i,
    input logic [3:0] op_mask_i,
    input logic records_taken,
    input logic [2:0] count_q,
    input logic records_last_q
);
  logic numbered;
  assign numbered = op_kind_i != 3'(hs_pkg::OP_HEADER) && op_kind_i != 3'(hs_pkg::OP_TRAILER);

  always_ff @(posedge clk_i)
    if (probes::hs_probe_on()) begin
      if (op_taken)
        probes::hs_probe(hs_pkg::PROBE_op, numbered ? 32'(op_number_i) : 0, 32'(op_kind_i),
                         op_kind_i == 3'(hs_pkg::OP_FACES) ? 32'(op_mask_i) : 0, 0, 0);
      if (records_taken)
        probes::hs_probe(hs_pkg::PROBE_records, 0, 32'(count_q), 32'(records_last_q), 0, 0);
    end
endmodule

bind emit probe_emit u_probe (
    .clk_i, .op_taken(op_valid_i && op_ready_o), .op_kind_i, .op_number_i, .op_mask_i,
    .records_taken(records_valid_q && pack_ready), .count_q, .records_last_q
);
