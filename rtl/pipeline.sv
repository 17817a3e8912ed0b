// SPDX-License-Identifier: Apache-2.0
//
// pipeline: one view at a time, from its input packet to its output packet.
//
//   s_axis --> receive --> transform --> quantize     vertex_memory   record_memory   face_memory
//                                           |              |                |              |
//                  +---> classify --> select --> guard --> smooth --> split --+     sequencer
//                  +----------------- once a generation ----------------------+
//                                                             |         |
//                                                             +-- emit -+--> m_axis
//
//   * Views are worked on one after the other, in the order of their packets; an output packet
//     carries its input packet's TID. s_axis_tready falls with a packet's last beat, and rises when its
//     output packet has been taken.
//   * Parameters and limits are halfstep's. The counters are read as rtl/counters.sv says.

module pipeline #(
    parameter int unsigned VERTICES = 524288,
    parameter int unsigned QUADS = 524288,
    parameter int unsigned PORT_RECORDS = 4,
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3,
    parameter int unsigned LANES = 8,
    parameter int unsigned READ_LATENCY = 1,
    parameter int unsigned OPS = 16,
    parameter bit PARITY = 1'b1,
    localparam int unsigned VW = $clog2(VERTICES),
    localparam int unsigned QW = $clog2(QUADS)
) (
    input logic clk_i,
    input logic rst_i,

    input  logic                        s_axis_tvalid,
    output logic                        s_axis_tready,
    input  logic [128*PORT_RECORDS-1:0] s_axis_tdata,
    input  logic [ 16*PORT_RECORDS-1:0] s_axis_tkeep,
    input  logic                        s_axis_tlast,
    input  logic [                15:0] s_axis_tid,

    output logic                        m_axis_tvalid,
    input  logic                        m_axis_tready,
    output logic [128*PORT_RECORDS-1:0] m_axis_tdata,
    output logic [ 16*PORT_RECORDS-1:0] m_axis_tkeep,
    output logic                        m_axis_tlast,
    output logic [                15:0] m_axis_tid,

    // registers
    input  logic [VW:0] limit_vertices_i,
    input  logic [QW:0] limit_quads_i,
    output logic        busy_o,
    output logic        view_done_o,
    output logic [ 7:0] status_o,
    output logic [31:0] position_o,

    // counters
    input  logic        sample_i,
    output logic [31:0] cycles_o,
    output logic [31:0] cycles_high_o,
    output logic [31:0] conflicts_o,
    input  logic [ 8:0] counter_address_i,
    output logic [31:0] counter_o,
    output logic        counter_known_o
);

  localparam int unsigned STAGES = 9;

  // What each stage did in this cycle, for the counters.
  logic [STAGES-1:0] busy, starved, blocked;
  logic [3*STAGES-1:0] items_in, items_out;

  // --- The view, from receive and quantize -------------------------------------------------------
  logic uniform, guarded, closed, limit, kept_mode, corners_stay;
  logic [15:0] min_edge, width, height;
  logic [7:0] front_depth, silhouette_depth, uniform_depth, forced_max, receive_status;
  logic [31:0] receive_position;
  logic [15:0] view;
  logic [VW:0] vertices_in;
  logic [QW:0] faces_in, halfedges_in, boundary_in;
  logic [511:0] matrix;
  logic signed [9:0] view_exponent;

  // --- The generation, from the sequencer --------------------------------------------------------
  logic [7:0] generation;
  logic odd, of_quads, side, all, last_step, finish, refused, pass, edge_points;
  logic [7:0] marked;
  logic [QW:0] items;
  logic [VW:0] vertices, new_vertices;

  // --- Counters ----------------------------------------------------------------------------------
  logic [3:0] conflict;

  counters #(
      .STAGES(STAGES)
  ) u_counters (
      .clk_i, .rst_i, .busy_i(busy), .starved_i(starved), .blocked_i(blocked), .in_i(items_in),
      .out_i(items_out), .conflict_i(conflict), .sample_i, .cycles_o, .cycles_high_o,
      .conflicts_o, .address_i(counter_address_i), .data_o(counter_o), .known_o(counter_known_o)
  );

  // --- receive, transform, quantize --------------------------------------------------------------
  logic kick_receive, receive_done, vertices_done, receive_in, receive_out;
  logic raw_valid, clip_valid, transform_busy, overflow;
  logic [VW-1:0] raw_index, clip_index;
  logic [127:0] raw, clip;
  logic [1:0] overflow_row;
  logic [30:0] view_magnitude;
  logic kick_quantize, quantize_done, quantize_in, quantize_out, quantize_rd, quantize_wr;
  logic [VW-1:0] quantize_rd_index, quantize_wr_index;
  logic [127:0] quantize_wr_data, single_position;
  logic corner_valid, corner_border, corner_boundary, corner_first, corner_last;
  logic [3:0] corner_sharpness, corner_own;
  logic [QW-1:0] corner_index, corner_twin;
  logic [VW-1:0] corner_origin;
  logic [7:0] corner_forced;

  /* verilator lint_off PINCONNECTEMPTY */
  receive #(
      .VERTICES(VERTICES), .QUADS(QUADS), .PORT_RECORDS(PORT_RECORDS)
  ) u_receive (
      .clk_i, .rst_i, .s_axis_tvalid, .s_axis_tready, .s_axis_tdata, .s_axis_tkeep, .s_axis_tlast,
      .s_axis_tid, .start_i(kick_receive), .limit_vertices_i,
      .limit_quads_i, .done_o(receive_done), .vertices_done_o(vertices_done),
      .status_o(receive_status), .position_o(receive_position), .view_o(view),
      .uniform_o(uniform), .guard_o(guarded), .front_depth_o(front_depth),
      .silhouette_depth_o(silhouette_depth), .uniform_depth_o(uniform_depth),
      .vertices_o(vertices_in), .faces_o(faces_in), .halfedges_o(halfedges_in), .matrix_o(matrix),
      .limit_o(limit), .kept_o(kept_mode), .corners_stay_o(corners_stay), .min_edge_o(min_edge),
      .width_o(width), .height_o(height), .boundary_count_o(boundary_in),
      .corner_boundary_o(corner_boundary), .corner_sharpness_o(corner_sharpness),
      .corner_own_o(corner_own), .forced_max_o(forced_max), .closed_o(closed), .vertex_valid_o(raw_valid),
      .vertex_index_o(raw_index), .vertex_record_o(raw), .transform_busy_i(transform_busy),
      .overflow_i(overflow), .overflow_index_i(clip_index), .overflow_row_i(overflow_row),
      .corner_valid_o(corner_valid), .corner_index_o(corner_index),
      .corner_origin_o(corner_origin), .corner_twin_o(corner_twin),
      .corner_border_o(corner_border), .corner_forced_o(corner_forced),
      .corner_first_o(corner_first), .corner_last_o(corner_last),
      .corner_face_o(),  // faces are counted again where they are read
      .busy_o(busy[hs_pkg::STAGE_receive]), .starved_o(starved[hs_pkg::STAGE_receive]),
      .blocked_o(blocked[hs_pkg::STAGE_receive]), .item_in_o(receive_in), .item_out_o(receive_out)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  transform #(
      .VW(VW)
  ) u_transform (
      .clk_i, .rst_i, .clear_i(kick_receive), .valid_i(raw_valid), .index_i(raw_index),
      .record_i(raw), .matrix_i(matrix), .valid_o(clip_valid), .index_o(clip_index), .clip_o(clip),
      .overflow_o(overflow), .overflow_row_o(overflow_row), .magnitude_o(view_magnitude),
      .busy_o(transform_busy)
  );

  assign busy[hs_pkg::STAGE_transform] = raw_valid;
  assign starved[hs_pkg::STAGE_transform] = transform_busy && !raw_valid;
  assign blocked[hs_pkg::STAGE_transform] = 1'b0;

  quantize #(
      .VW(VW)
  ) u_quantize (
      .clk_i, .rst_i, .start_i(kick_quantize), .count_i(vertices_in), .magnitude_i(view_magnitude),
      .exponent_o(view_exponent), .done_o(quantize_done), .rd_en_o(quantize_rd),
      .rd_index_o(quantize_rd_index), .rd_data_i(single_position), .wr_en_o(quantize_wr),
      .wr_index_o(quantize_wr_index), .wr_data_o(quantize_wr_data),
      .busy_o(busy[hs_pkg::STAGE_quantize]), .starved_o(starved[hs_pkg::STAGE_quantize]),
      .blocked_o(blocked[hs_pkg::STAGE_quantize]), .item_in_o(quantize_in),
      .item_out_o(quantize_out)
  );

  // --- The generations; a memory's fault ends them ----------------------------------------------------------------------------
  logic kick_classify, kick_check, kick_select, kick_guard, kick_smooth, kick_split;
  logic classify_active, check_active, select_active, guard_active, smooth_active;
  logic split_active, check_error, check_sharpness, send_at_level, valence_error, send_valid, send_ready, split_op;
  logic split_ready, split_first, split_last;
  logic [QW-1:0] check_corner, valence_corner;
  logic any_selected;
  logic [QW:0] refined_count, children;
  logic [QW+2:0] refined_sides;
  logic [VW-1:0] send_vertex;
  logic group_valid, group_ready;
  logic [4*VW-1:0] group_vertex;
  logic [511:0] group_position;
  logic [383:0] op_vertex;
  logic [127:0] send_position, split_op_position;
  logic [2:0] split_kind;
  logic [23:0] split_number;
  logic [3:0] split_mask, split_triangle, split_child, split_candidate;
  logic [383:0] split_op_vertex;
  logic [7:0] split_sides;
  logic fault, abort;
  logic [4:0] refine_in;
  logic [9:0] refine_out;

  refine #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .OPS(OPS),
      .PARITY(PARITY)
  ) u_refine (
      .clk_i, .rst_i(rst_i || abort), .fault_o(fault), .generation_i(generation), .odd_i(odd), .quads_i(of_quads), .side_i(side),
      .all_i(all), .last_step_i(last_step), .finish_i(finish), .pass_i(pass), .edge_i(edge_points),
      .marked_i(marked), .items_i(items),
      .vertices_i(vertices), .new_vertices_i(new_vertices), .uniform_i(uniform),
      .guarded_i(guarded), .limit_i(limit), .corners_stay_i(corners_stay),
      .front_depth_i(front_depth), .silhouette_depth_i(silhouette_depth), .min_edge_i(min_edge),
      .width_i(width), .height_i(height), .check_sharpness_o(check_sharpness),
      .raw_valid_i(raw_valid), .raw_index_i(raw_index), .corner_boundary_i(corner_boundary),
      .corner_sharpness_i(corner_sharpness), .corner_own_i(corner_own),
      .send_at_level_o(send_at_level), .kick_classify_i(kick_classify), .kick_check_i(kick_check), .kick_select_i(kick_select),
      .kick_guard_i(kick_guard), .kick_smooth_i(kick_smooth), .kick_split_i(kick_split),
      .classify_active_o(classify_active), .check_active_o(check_active),
      .select_active_o(select_active), .guard_active_o(guard_active),
      .smooth_active_o(smooth_active), .split_active_o(split_active), .check_error_o(check_error),
      .check_corner_o(check_corner), .valence_error_o(valence_error),
      .valence_corner_o(valence_corner), .any_selected_o(any_selected),
      .refined_count_o(refined_count), .refined_sides_o(refined_sides), .children_o(children),
      .clip_valid_i(clip_valid), .clip_index_i(clip_index), .clip_i(clip),
      .quantize_rd_i(quantize_rd), .quantize_rd_index_i(quantize_rd_index),
      .single_position_o(single_position), .quantize_wr_i(quantize_wr),
      .quantize_wr_index_i(quantize_wr_index), .quantize_wr_data_i(quantize_wr_data),
      .corner_valid_i(corner_valid), .corner_index_i(corner_index), .corner_origin_i(corner_origin),
      .corner_twin_i(corner_twin), .corner_border_i(corner_border), .corner_forced_i(corner_forced),
      .corner_first_i(corner_first), .corner_last_i(corner_last), .send_valid_o(send_valid),
      .group_valid_o(group_valid), .group_ready_i(group_ready), .group_vertex_o(group_vertex),
      .group_position_o(group_position),
      .send_ready_i(send_ready), .send_vertex_o(send_vertex), .send_position_o(send_position),
      .split_op_o(split_op), .split_ready_i(split_ready), .split_kind_o(split_kind),
      .split_number_o(split_number), .split_op_position_o(split_op_position),
      .split_mask_o(split_mask), .split_triangle_o(split_triangle), .split_child_o(split_child),
      .split_candidate_o(split_candidate), .split_op_vertex_o(split_op_vertex),
      .split_sides_o(split_sides), .split_first_o(split_first), .split_last_o(split_last),
      .busy_o(busy[hs_pkg::STAGE_classify+:5]), .starved_o(starved[hs_pkg::STAGE_classify+:5]),
      .blocked_o(blocked[hs_pkg::STAGE_classify+:5]), .item_in_o(refine_in),
      .item_out_o(refine_out), .conflict_o(conflict)
  );

  // --- emit: the sequencer, smooth and split send in turn ----------------------------------------
  logic control_op, control_trailer, op_valid, op_ready, emit_done;
  logic [7:0] control_generation;
  logic [2:0] op_kind;

  assign op_valid = control_op || group_valid || send_valid || split_op;
  assign op_kind = control_op ? (control_trailer ? 3'(hs_pkg::OP_TRAILER) : 3'(hs_pkg::OP_HEADER)) :
      group_valid ? 3'(hs_pkg::OP_GROUP) : send_valid ? 3'(hs_pkg::OP_VERTEX) : split_kind;
  assign group_ready = op_ready && !control_op;
  assign send_ready = op_ready && !control_op && !group_valid;
  assign split_ready = op_ready && !control_op && !group_valid && !send_valid;

  always_comb begin
    op_vertex = split_op_vertex;
    if (group_valid)
      for (int i = 1; i < 4; i++) op_vertex[24*(i-1)+:24] = 24'(group_vertex[i*VW+:VW]);
  end

  emit #(
      .PORT_RECORDS(PORT_RECORDS)
  ) u_emit (
      .clk_i, .rst_i, .op_valid_i(op_valid), .op_ready_o(op_ready), .op_kind_i(op_kind),
      .op_generation_i(control_op ? control_generation : generation),
      .op_number_i(group_valid ? 24'(group_vertex[VW-1:0]) : send_valid ? 24'(send_vertex) : split_number),
      .op_position_i(group_valid ? group_position[127:0] : send_valid ? send_position : split_op_position),
      .op_group_i(group_position[511:128]),
      .op_at_level_i(send_valid ? send_at_level : limit && !group_valid), .op_mask_i(split_mask),
      .op_triangle_i(split_triangle), .op_child_i(split_child), .op_candidate_i(split_candidate),
      .op_vertex_i(op_vertex), .op_sides_i(split_sides), .op_first_i(split_first),
      .op_last_i(split_last), .view_i(view), .exponent_i(refused ? 10'sd0 : view_exponent),
      .status_i(status_o), .position_i(position_o), .done_o(emit_done), .m_axis_tvalid, .m_axis_tready,
      .m_axis_tdata, .m_axis_tkeep, .m_axis_tlast, .m_axis_tid, .busy_o(busy[hs_pkg::STAGE_emit]),
      .starved_o(starved[hs_pkg::STAGE_emit]), .blocked_o(blocked[hs_pkg::STAGE_emit]),
      .items_in_o(items_in[3*hs_pkg::STAGE_emit+:3]),
      .items_out_o(items_out[3*hs_pkg::STAGE_emit+:3])
  );

  // --- The sequencer -----------------------------------------------------------------------------
  sequencer #(
      .VW(VW), .QW(QW)
  ) u_sequencer (
      .clk_i, .rst_i, .limit_vertices_i, .limit_quads_i,
      .view_done_o, .busy_o, .status_o, .position_o, .fault_i(fault), .abort_o(abort),
      .kick_receive_o(kick_receive), .receive_item_i(receive_in), .receive_done_i(receive_done),
      .vertices_done_i(vertices_done), .transform_busy_i(transform_busy),
      .kick_quantize_o(kick_quantize), .quantize_done_i(quantize_done),
      .receive_status_i(receive_status), .receive_position_i(receive_position), .uniform_i(uniform),
      .front_depth_i(front_depth), .silhouette_depth_i(silhouette_depth),
      .uniform_depth_i(uniform_depth), .forced_max_i(forced_max), .closed_i(closed),
      .limit_i(limit), .kept_i(kept_mode), .boundary_i(boundary_in),
      .check_sharpness_i(check_sharpness), .vertices_i(vertices_in), .faces_i(faces_in), .halfedges_i(halfedges_in),
      .kick_check_o(kick_check), .kick_classify_o(kick_classify),
      .classify_active_i(classify_active), .check_active_i(check_active),
      .check_error_i(check_error), .check_corner_i(check_corner), .valence_error_i(valence_error),
      .valence_corner_i(valence_corner), .kick_select_o(kick_select),
      .select_active_i(select_active), .any_selected_i(any_selected), .kick_guard_o(kick_guard),
      .guard_active_i(guard_active), .refined_i(refined_count), .sides_i(refined_sides),
      .kick_smooth_o(kick_smooth), .smooth_active_i(smooth_active), .kick_split_o(kick_split),
      .split_active_i(split_active), .children_i(children), .op_valid_o(control_op),
      .op_ready_i(op_ready), .op_trailer_o(control_trailer), .op_generation_o(control_generation),
      .emit_done_i(emit_done), .generation_o(generation), .odd_o(odd), .quads_o(of_quads),
      .side_o(side), .items_o(items), .vertices_o(vertices), .new_o(new_vertices), .pass_o(pass), .edge_o(edge_points),
      .marked_o(marked), .all_o(all),
      .last_o(last_step), .finish_o(finish), .refused_o(refused)
  );

  // --- Counters ----------------------------------------------------------------------------------
  assign items_in[3*hs_pkg::STAGE_receive+:3] = 3'(receive_in);
  assign items_out[3*hs_pkg::STAGE_receive+:3] = 3'(receive_out);
  assign items_in[3*hs_pkg::STAGE_transform+:3] = 3'(raw_valid);
  assign items_out[3*hs_pkg::STAGE_transform+:3] = 3'(clip_valid);
  assign items_in[3*hs_pkg::STAGE_quantize+:3] = 3'(quantize_in);
  assign items_out[3*hs_pkg::STAGE_quantize+:3] = 3'(quantize_out);

  for (genvar s = 0; s < 5; s++) begin : g_refine_items
    assign items_in[3*(hs_pkg::STAGE_classify+s)+:3] = 3'(refine_in[s]);
    assign items_out[3*(hs_pkg::STAGE_classify+s)+:3] = 3'(refine_out[2*s+:2]);
  end

endmodule
