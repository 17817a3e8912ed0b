// SPDX-License-Identifier: Apache-2.0
//
// halfstep: view-dependent sqrt(2) subdivision. One AXI4-Stream packet in for each view (matrix,
// vertices, faces), one out (refined vertices, final faces): docs/stream.md. Registers and counters
// over AXI4-Lite: docs/reference.md.
//
//   s_axis --> receive --> transform --> quantize     vertex_memory   record_memory   face_memory
//                                           |              |                |              |
//                  +---> classify --> select --> guard --> smooth --> split --+     sequencer
//                  +----------------- once a generation ----------------------+
//                                                             |         |
//                                                             +-- emit -+--> m_axis
//
//   * Views are worked on one after the other, in the order of their packets; an output packet
//     carries its input packet's TID.
//   * VERTICES and QUADS are the capacities; views that need more are refused, or stop early.

module halfstep #(
    // Vertices held; a power of two, 64 to 2^24.
    parameter int unsigned VERTICES = 524288,
    // Active quads held, and corners of the initial mesh; a power of two, 64 to 2^24.
    parameter int unsigned QUADS = 524288,
    // Records of 128 bits in a beat of either stream: 1, 2 or 4.
    parameter int unsigned PORT_RECORDS = 4,
    // Banks of the memories, as a power of two: 1 to 4.
    parameter int unsigned BANK_BITS = 3
) (
    input logic clk_i,
    input logic rst_i,  // synchronous

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

    input  logic        s_axil_awvalid,
    output logic        s_axil_awready,
    input  logic [11:0] s_axil_awaddr,
    input  logic        s_axil_wvalid,
    output logic        s_axil_wready,
    input  logic [31:0] s_axil_wdata,
    input  logic [ 3:0] s_axil_wstrb,
    output logic        s_axil_bvalid,
    input  logic        s_axil_bready,
    output logic [ 1:0] s_axil_bresp,
    input  logic        s_axil_arvalid,
    output logic        s_axil_arready,
    input  logic [11:0] s_axil_araddr,
    output logic        s_axil_rvalid,
    input  logic        s_axil_rready,
    output logic [31:0] s_axil_rdata,
    output logic [ 1:0] s_axil_rresp
);

  generate
    if (VERTICES < 64 || (VERTICES & (VERTICES - 1)) != 0 || VERTICES > (1 << 24)) begin : g_bad_v
      $error("halfstep: VERTICES must be a power of two, 64 to 2^24");
    end
    if (QUADS < 64 || (QUADS & (QUADS - 1)) != 0 || QUADS > (1 << 24)) begin : g_bad_q
      $error("halfstep: QUADS must be a power of two, 64 to 2^24");
    end
    if (BANK_BITS < 1 || BANK_BITS > 4) begin : g_bad_banks
      $error("halfstep: BANK_BITS must be 1 to 4");
    end
  endgenerate

  localparam int unsigned VW = $clog2(VERTICES);
  localparam int unsigned QW = $clog2(QUADS);
  localparam int unsigned HW = QW + 2;
  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned VR = VW - BANK_BITS;
  localparam int unsigned QR = QW - BANK_BITS;
  localparam int unsigned HALF = 2 * VW + 2 * HW + 11;
  localparam int unsigned STAGES = 9;

  // What each stage did in this cycle, for the counters.
  logic [STAGES-1:0] busy, starved, blocked;
  logic [3*STAGES-1:0] items_in, items_out;

  // --- The view, from receive and quantize ---------------------------------------------------------------
  logic uniform, guarded, closed;
  logic [7:0] front_depth, silhouette_depth, uniform_depth, forced_max, receive_status;
  logic [31:0] receive_position;
  logic [15:0] view;
  logic [VW:0] vertices_in;
  logic [QW:0] faces_in, halfedges_in;
  logic [511:0] matrix;
  logic signed [9:0] exponent;

  // --- The generation, from the sequencer ----------------------------------------------------------------
  logic [7:0] generation;
  logic odd, quads, side, all, last_step, finish, refused;
  logic [QW:0] items;
  logic [VW:0] vertices, new_vertices;

  // --- Registers and counters ----------------------------------------------------------------------------
  // The registers are as wide as the largest capacity needs.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [24:0] limit_vertices, limit_quads;
  /* verilator lint_on UNUSEDSIGNAL */
  logic view_done, view_busy, sample, counter_known;
  logic [7:0] status;
  logic [31:0] position, cycles, cycles_high, conflicts, counter;
  logic [8:0] counter_address;
  logic [3:0] conflict;

  registers #(
      .VERTICES(VERTICES),
      .QUADS(QUADS)
  ) u_registers (
      .clk_i,
      .rst_i,
      .s_axil_awvalid,
      .s_axil_awready,
      .s_axil_awaddr,
      .s_axil_wvalid,
      .s_axil_wready,
      .s_axil_wdata,
      .s_axil_wstrb,
      .s_axil_bvalid,
      .s_axil_bready,
      .s_axil_bresp,
      .s_axil_arvalid,
      .s_axil_arready,
      .s_axil_araddr,
      .s_axil_rvalid,
      .s_axil_rready,
      .s_axil_rdata,
      .s_axil_rresp,
      .limit_vertices_o(limit_vertices),
      .limit_quads_o(limit_quads),
      .busy_i(view_busy),
      .view_done_i(view_done),
      .status_i(status),
      .position_i(position),
      .sample_o(sample),
      .cycles_i(cycles),
      .cycles_high_i(cycles_high),
      .conflicts_i(conflicts),
      .counter_address_o(counter_address),
      .counter_i(counter),
      .counter_known_i(counter_known)
  );

  counters #(
      .STAGES(STAGES)
  ) u_counters (
      .clk_i,
      .rst_i,
      .busy_i(busy),
      .starved_i(starved),
      .blocked_i(blocked),
      .in_i(items_in),
      .out_i(items_out),
      .conflict_i(conflict),
      .sample_i(sample),
      .cycles_o(cycles),
      .cycles_high_o(cycles_high),
      .conflicts_o(conflicts),
      .address_i(counter_address),
      .data_o(counter),
      .known_o(counter_known)
  );

  // --- receive, transform, quantize ----------------------------------------------------------------------
  logic kick_receive, receive_done, vertices_done, receive_in, receive_out;
  logic raw_valid, clip_valid, transform_busy, overflow;
  logic [VW-1:0] raw_index, clip_index;
  logic [127:0] raw, clip;
  logic [1:0] overflow_row;
  logic [30:0] magnitude;
  logic kick_quantize, quantize_done, quantize_in, quantize_out, quantize_rd, quantize_wr;
  logic [VW-1:0] quantize_rd_index, quantize_wr_index;
  logic [127:0] quantize_wr_data, single_position;
  logic corner_valid, corner_border, corner_first, corner_last;
  logic [QW-1:0] corner_index, corner_twin;
  logic [VW-1:0] corner_origin;
  logic [7:0] corner_forced;

  /* verilator lint_off PINCONNECTEMPTY */
  receive #(
      .VERTICES(VERTICES),
      .QUADS(QUADS),
      .PORT_RECORDS(PORT_RECORDS)
  ) u_receive (
      .clk_i,
      .rst_i,
      .s_axis_tvalid,
      .s_axis_tready,
      .s_axis_tdata,
      .s_axis_tkeep,
      .s_axis_tlast,
      .s_axis_tid,
      .start_i(kick_receive),
      .limit_vertices_i(limit_vertices[VW:0]),
      .limit_quads_i(limit_quads[QW:0]),
      .done_o(receive_done),
      .vertices_done_o(vertices_done),
      .status_o(receive_status),
      .position_o(receive_position),
      .view_o(view),
      .uniform_o(uniform),
      .guard_o(guarded),
      .front_depth_o(front_depth),
      .silhouette_depth_o(silhouette_depth),
      .uniform_depth_o(uniform_depth),
      .vertices_o(vertices_in),
      .faces_o(faces_in),
      .halfedges_o(halfedges_in),
      .matrix_o(matrix),
      .forced_max_o(forced_max),
      .closed_o(closed),
      .vertex_valid_o(raw_valid),
      .vertex_index_o(raw_index),
      .vertex_record_o(raw),
      .transform_busy_i(transform_busy),
      .overflow_i(overflow),
      .overflow_index_i(clip_index),
      .overflow_row_i(overflow_row),
      .corner_valid_o(corner_valid),
      .corner_index_o(corner_index),
      .corner_origin_o(corner_origin),
      .corner_twin_o(corner_twin),
      .corner_border_o(corner_border),
      .corner_forced_o(corner_forced),
      .corner_first_o(corner_first),
      .corner_last_o(corner_last),
      .corner_face_o(),  // faces are counted again where they are read
      .busy_o(busy[hs_pkg::STAGE_receive]),
      .starved_o(starved[hs_pkg::STAGE_receive]),
      .blocked_o(blocked[hs_pkg::STAGE_receive]),
      .item_in_o(receive_in),
      .item_out_o(receive_out)
  );
  /* verilator lint_on PINCONNECTEMPTY */

  transform #(
      .VW(VW)
  ) u_transform (
      .clk_i,
      .rst_i,
      .clear_i(kick_receive),
      .valid_i(raw_valid),
      .index_i(raw_index),
      .record_i(raw),
      .matrix_i(matrix),
      .valid_o(clip_valid),
      .index_o(clip_index),
      .clip_o(clip),
      .overflow_o(overflow),
      .overflow_row_o(overflow_row),
      .magnitude_o(magnitude),
      .busy_o(transform_busy)
  );

  assign busy[hs_pkg::STAGE_transform] = raw_valid;
  assign starved[hs_pkg::STAGE_transform] = transform_busy && !raw_valid;
  assign blocked[hs_pkg::STAGE_transform] = 1'b0;

  quantize #(
      .VW(VW)
  ) u_quantize (
      .clk_i,
      .rst_i,
      .start_i(kick_quantize),
      .count_i(vertices_in),
      .magnitude_i(magnitude),
      .exponent_o(exponent),
      .done_o(quantize_done),
      .rd_en_o(quantize_rd),
      .rd_index_o(quantize_rd_index),
      .rd_data_i(single_position),
      .wr_en_o(quantize_wr),
      .wr_index_o(quantize_wr_index),
      .wr_data_o(quantize_wr_data),
      .busy_o(busy[hs_pkg::STAGE_quantize]),
      .starved_o(starved[hs_pkg::STAGE_quantize]),
      .blocked_o(blocked[hs_pkg::STAGE_quantize]),
      .item_in_o(quantize_in),
      .item_out_o(quantize_out)
  );

  // --- Memories: who uses them is told below -------------------------------------------------------------
  logic [BANKS-1:0] gather_rd_en, classify_mark_rd_en, select_mark_rd_en, mark_wr_en, sum_rd_en, sum_wr_en;
  logic [BANKS-1:0] chosen_wr_en, chosen_rd_en, held_wr_en, chosen, held;
  logic [VR*BANKS-1:0] gather_rd_row, classify_mark_rd_row, select_mark_rd_row, mark_wr_row;
  logic [VR*BANKS-1:0] sum_rd_row, sum_wr_row, chosen_wr_row, chosen_rd_row, held_wr_row;
  logic [256*BANKS-1:0] gathered;
  logic [13*BANKS-1:0] mark, mark_wr_data;
  logic [168*BANKS-1:0] sum, sum_wr_data;
  logic smooth_row_rd, smooth_rd, smooth_wr, smooth_move, smooth_old, smooth_sent;
  logic [VR-1:0] smooth_row;
  logic [VW-1:0] smooth_rd_index, smooth_wr_vertex;
  logic [127:0] smooth_position, smooth_before;
  logic [167:0] single_sum;
  logic guard_birth, split_birth, split_sent;
  logic [VW-1:0] guard_vertex, split_vertex, birth_vertex;
  logic [127:0] guard_position, split_position, birth_position;

  // quantize, guard and split give birth to vertices, at different times.
  always_comb begin
    birth_vertex = quantize_wr_index;
    birth_position = quantize_wr_data;
    if (guard_birth) begin
      birth_vertex = guard_vertex;
      birth_position = guard_position;
    end
    if (split_birth || split_sent) begin
      birth_vertex = split_vertex;
      birth_position = split_position;
    end
  end

  vertex_memory #(
      .VW(VW),
      .BANK_BITS(BANK_BITS)
  ) u_vertices (
      .clk_i,
      .load_wr_en_i(clip_valid),
      .load_wr_index_i(clip_index),
      .load_wr_data_i(clip),
      .quantize_rd_en_i(quantize_rd),
      .quantize_rd_index_i(quantize_rd_index),
      .single_position_o(single_position),
      .birth_i(quantize_wr || guard_birth || split_birth),
      .sent_i(split_sent),
      .birth_vertex_i(birth_vertex),
      .birth_position_i(birth_position),
      .birth_generation_i(quantize_wr ? 8'hff : generation),
      .generation_i(generation),
      .gather_rd_en_i(gather_rd_en),
      .gather_rd_row_i(gather_rd_row),
      .gather_old_i(!odd),
      .gather_rd_data_o(gathered),
      .mark_rd_en_i(classify_mark_rd_en | select_mark_rd_en),
      .mark_rd_row_i(classify_mark_rd_row | select_mark_rd_row),
      .mark_rd_data_o(mark),
      .mark_wr_en_i(mark_wr_en),
      .mark_wr_row_i(mark_wr_row),
      .mark_wr_data_i(mark_wr_data),
      .sum_rd_en_i(sum_rd_en),
      .sum_rd_row_i(sum_rd_row),
      .sum_rd_data_o(sum),
      .sum_wr_en_i(sum_wr_en),
      .sum_wr_row_i(sum_wr_row),
      .sum_wr_data_i(sum_wr_data),
      .chosen_wr_en_i(chosen_wr_en),
      .chosen_wr_row_i(chosen_wr_row),
      .chosen_rd_en_i(chosen_rd_en),
      .chosen_rd_row_i(chosen_rd_row),
      .chosen_rd_data_o(chosen),
      .held_wr_en_i(held_wr_en),
      .held_wr_row_i(held_wr_row),
      .row_rd_en_i(smooth_row_rd),
      .row_rd_i(smooth_row),
      .held_rd_data_o(held),
      .smooth_rd_en_i(smooth_rd),
      .smooth_rd_index_i(smooth_rd_index),
      .single_sum_o(single_sum),
      .smooth_wr_i(smooth_wr),
      .smooth_wr_vertex_i(smooth_wr_vertex),
      .smooth_wr_move_i(smooth_move),
      .smooth_wr_old_i(smooth_old),
      .smooth_wr_sent_i(smooth_sent),
      .smooth_wr_position_i(smooth_position),
      .smooth_wr_before_i(smooth_before)
  );

  logic classify_rd, select_rd, guard_rd, split_rd, candidate, record_last;
  logic [QW-1:0] classify_item, select_item, guard_item, split_item;
  logic [QW-1:0] select_face, guard_face, split_face;
  logic [4*VW-1:0] origin;
  logic [4*HW-1:0] twin;
  logic [3:0] border;
  logic [7:0] forced;
  logic check_a_rd, check_b_rd, a_border, a_first, a_last, b_border;
  logic [QW-1:0] check_a_index, check_b_index, a_twin, b_twin;
  logic [VW-1:0] a_origin, b_origin;
  logic [BANKS-1:0] lower_wr_en, upper_wr_en;
  logic [QR*BANKS-1:0] lower_wr_row, upper_wr_row;
  logic [HALF*BANKS-1:0] lower_wr_data, upper_wr_data;

  record_memory #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_records (
      .clk_i,
      .side_i(side),
      .quads_i(quads),
      .corner_valid_i(corner_valid),
      .corner_index_i(corner_index),
      .corner_origin_i(corner_origin),
      .corner_twin_i(corner_twin),
      .corner_border_i(corner_border),
      .corner_forced_i(corner_forced),
      .corner_first_i(corner_first),
      .corner_last_i(corner_last),
      .rd_en_i(classify_rd || select_rd || guard_rd || split_rd),
      .rd_item_i(record_item),
      .origin_o(origin),
      .twin_o(twin),
      .border_o(border),
      .candidate_o(candidate),
      .forced_o(forced),
      .last_o(record_last),
      .a_rd_en_i(check_a_rd),
      .a_rd_index_i(check_a_index),
      .a_origin_o(a_origin),
      .a_twin_o(a_twin),
      .a_border_o(a_border),
      .a_first_o(a_first),
      .a_last_o(a_last),
      .b_rd_en_i(check_b_rd),
      .b_rd_index_i(check_b_index),
      .b_origin_o(b_origin),
      .b_twin_o(b_twin),
      .b_border_o(b_border),
      .lower_wr_en_i(lower_wr_en),
      .lower_wr_row_i(lower_wr_row),
      .lower_wr_data_i(lower_wr_data),
      .upper_wr_en_i(upper_wr_en),
      .upper_wr_row_i(upper_wr_row),
      .upper_wr_data_i(upper_wr_data)
  );

  logic [QW-1:0] record_item, face_item;
  logic point_valid, point_front, front, selected_valid, selected_verdict, selected;
  logic [QW-1:0] point_face, selected_face;
  logic [127:0] point_wr_data, point;
  logic verdict_valid, number_wr, smooth_face_rd;
  logic [QW-1:0] verdict_item, number_wr_item;
  logic [VW-1:0] smooth_face;
  logic [VW+1:0] verdict_wr_data, own_verdict;
  logic [QW+3:0] number_wr_data;
  logic [BANKS-1:0] verdict_rd_en, number_rd_en;
  logic [QR*BANKS-1:0] verdict_rd_row, number_rd_row;
  logic [(VW+2)*BANKS-1:0] verdicts;
  logic [(QW+4)*BANKS-1:0] numbers;

  always_comb begin
    record_item = classify_item;
    face_item = select_face;
    if (select_rd) record_item = select_item;
    if (guard_rd) begin
      record_item = guard_item;
      face_item = guard_face;
    end
    if (split_rd) begin
      record_item = split_item;
      face_item = split_face;
    end
    if (smooth_face_rd) face_item = QW'(smooth_face);
  end

  face_memory #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_faces (
      .clk_i,
      .point_wr_en_i(point_valid),
      .point_wr_face_i(point_face),
      .point_wr_data_i(point_wr_data),
      .point_wr_front_i(point_front),
      .selected_wr_en_i(selected_valid),
      .selected_wr_face_i(selected_face),
      .selected_wr_data_i(selected_verdict),
      .face_rd_en_i(select_rd || guard_rd || split_rd || smooth_face_rd),
      .face_rd_i(face_item),
      .point_o(point),
      .front_o(front),
      .selected_o(selected),
      .verdict_wr_en_i(verdict_valid),
      .verdict_wr_item_i(verdict_item),
      .verdict_wr_data_i(verdict_wr_data),
      .own_rd_en_i(split_rd),
      .own_rd_item_i(split_item),
      .own_o(own_verdict),
      .verdict_rd_en_i(verdict_rd_en),
      .verdict_rd_row_i(verdict_rd_row),
      .verdict_rd_data_o(verdicts),
      .number_wr_en_i(number_wr),
      .number_wr_item_i(number_wr_item),
      .number_wr_data_i(number_wr_data),
      .number_rd_en_i(number_rd_en),
      .number_rd_row_i(number_rd_row),
      .number_rd_data_o(numbers)
  );

  // --- classify, and what generation 0 is checked for beside it ------------------------------------------
  logic kick_classify, kick_check, classify_active, check_active, check_error, valence_error;
  logic [QW-1:0] check_corner, valence_corner;
  logic classify_in, classify_out;
  logic [1:0] classify_conflict;

  classify #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_classify (
      .clk_i,
      .rst_i,
      .start_i(kick_classify),
      .items_i(items),
      .quads_i(quads),
      .odd_i(odd),
      .generation_i(generation),
      .active_o(classify_active),
      .record_rd_en_o(classify_rd),
      .record_rd_item_o(classify_item),
      .record_origin_i(origin),
      .record_border_i(border),
      .record_last_i(record_last),
      .position_rd_en_o(gather_rd_en),
      .position_rd_row_o(gather_rd_row),
      .position_rd_data_i(gathered),
      .mark_rd_en_o(classify_mark_rd_en),
      .mark_rd_row_o(classify_mark_rd_row),
      .mark_rd_data_i(mark),
      .mark_wr_en_o(mark_wr_en),
      .mark_wr_row_o(mark_wr_row),
      .mark_wr_data_o(mark_wr_data),
      .sum_rd_en_o(sum_rd_en),
      .sum_rd_row_o(sum_rd_row),
      .sum_rd_data_i(sum),
      .sum_wr_en_o(sum_wr_en),
      .sum_wr_row_o(sum_wr_row),
      .sum_wr_data_o(sum_wr_data),
      .point_valid_o(point_valid),
      .point_face_o(point_face),
      .point_o(point_wr_data),
      .front_o(point_front),
      .valence_error_o(valence_error),
      .valence_corner_o(valence_corner),
      .busy_o(busy[hs_pkg::STAGE_classify]),
      .starved_o(starved[hs_pkg::STAGE_classify]),
      .blocked_o(blocked[hs_pkg::STAGE_classify]),
      .item_in_o(classify_in),
      .item_out_o(classify_out),
      .conflict_o(classify_conflict)
  );

  check_twins #(
      .VW(VW),
      .QW(QW)
  ) u_check_twins (
      .clk_i,
      .rst_i,
      .start_i(kick_check),
      .corners_i(items),
      .active_o(check_active),
      .error_o(check_error),
      .corner_o(check_corner),
      .a_rd_en_o(check_a_rd),
      .a_rd_index_o(check_a_index),
      .a_origin_i(a_origin),
      .a_twin_i(a_twin),
      .a_border_i(a_border),
      .a_first_i(a_first),
      .a_last_i(a_last),
      .b_rd_en_o(check_b_rd),
      .b_rd_index_o(check_b_index),
      .b_origin_i(b_origin),
      .b_twin_i(b_twin),
      .b_border_i(b_border)
  );

  // --- select, guard -------------------------------------------------------------------------------------
  logic kick_select, select_active, select_in, select_out, kick_guard, guard_active, guard_in, guard_out;
  logic [QW:0] selected_count, refined_count;
  logic [QW+2:0] refined_sides;
  logic [1:0] select_conflict, guard_conflict;

  select #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_select (
      .clk_i,
      .rst_i,
      .start_i(kick_select),
      .items_i(items),
      .quads_i(quads),
      .generation_i(generation),
      .front_depth_i(front_depth),
      .silhouette_depth_i(silhouette_depth),
      .active_o(select_active),
      .selected_o(selected_count),
      .record_rd_en_o(select_rd),
      .record_rd_item_o(select_item),
      .record_rd_face_o(select_face),
      .record_origin_i(origin),
      .record_candidate_i(candidate),
      .record_forced_i(forced),
      .record_last_i(record_last),
      .face_front_i(front),
      .mark_rd_en_o(select_mark_rd_en),
      .mark_rd_row_o(select_mark_rd_row),
      .mark_rd_data_i(mark),
      .chosen_wr_en_o(chosen_wr_en),
      .chosen_wr_row_o(chosen_wr_row),
      .selected_valid_o(selected_valid),
      .selected_face_o(selected_face),
      .selected_verdict_o(selected_verdict),
      .busy_o(busy[hs_pkg::STAGE_select]),
      .starved_o(starved[hs_pkg::STAGE_select]),
      .blocked_o(blocked[hs_pkg::STAGE_select]),
      .item_in_o(select_in),
      .item_out_o(select_out),
      .conflict_o(select_conflict)
  );

  guard #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_guard (
      .clk_i,
      .rst_i,
      .start_i(kick_guard),
      .items_i(items),
      .quads_i(quads),
      .guard_i(guarded),
      .all_i(uniform),
      .first_new_i(vertices),
      .active_o(guard_active),
      .refined_o(refined_count),
      .sides_o(refined_sides),
      .record_rd_en_o(guard_rd),
      .record_rd_item_o(guard_item),
      .record_rd_face_o(guard_face),
      .record_origin_i(origin),
      .record_last_i(record_last),
      .face_selected_i(selected),
      .face_point_i(point),
      .chosen_rd_en_o(chosen_rd_en),
      .chosen_rd_row_o(chosen_rd_row),
      .chosen_rd_data_i(chosen),
      .held_wr_en_o(held_wr_en),
      .held_wr_row_o(held_wr_row),
      .verdict_valid_o(verdict_valid),
      .verdict_item_o(verdict_item),
      .verdict_o(verdict_wr_data),
      .new_valid_o(guard_birth),
      .new_vertex_o(guard_vertex),
      .new_position_o(guard_position),
      .busy_o(busy[hs_pkg::STAGE_guard]),
      .starved_o(starved[hs_pkg::STAGE_guard]),
      .blocked_o(blocked[hs_pkg::STAGE_guard]),
      .item_in_o(guard_in),
      .item_out_o(guard_out),
      .conflict_o(guard_conflict)
  );

  // --- smooth, split -------------------------------------------------------------------------------------
  logic kick_smooth, smooth_active, smooth_in, smooth_out, send_valid, send_ready;
  logic [VW-1:0] send_vertex;
  logic [127:0] send_position;
  logic kick_split, split_active, split_in, split_out, split_op, split_ready;
  logic [QW:0] children;
  logic [2:0] split_kind, split_conflict;
  logic [23:0] split_number;
  logic [127:0] split_op_position;
  logic [3:0] split_mask, split_triangle, split_child, split_candidate;
  logic [383:0] split_op_vertex;
  logic [7:0] split_sides;
  logic split_first, split_last;

  smooth #(
      .VW(VW),
      .BANK_BITS(BANK_BITS)
  ) u_smooth (
      .clk_i,
      .rst_i,
      .start_i(kick_smooth),
      .count_i(vertices),
      .new_i(new_vertices),
      .odd_i(odd),
      .last_i(last_step),
      .finish_i(finish),
      .generation_i(generation),
      .active_o(smooth_active),
      .row_rd_en_o(smooth_row_rd),
      .row_rd_o(smooth_row),
      .mark_rd_data_i(mark),
      .held_rd_data_i(held),
      .vertex_rd_en_o(smooth_rd),
      .vertex_rd_index_o(smooth_rd_index),
      .position_rd_data_i(single_position),
      .sum_rd_data_i(single_sum),
      .new_from_face_i(all),
      .face_rd_en_o(smooth_face_rd),
      .face_rd_index_o(smooth_face),
      .face_rd_data_i(point),
      .write_valid_o(smooth_wr),
      .write_vertex_o(smooth_wr_vertex),
      .write_move_o(smooth_move),
      .write_old_o(smooth_old),
      .write_sent_o(smooth_sent),
      .write_position_o(smooth_position),
      .write_before_o(smooth_before),
      .send_valid_o(send_valid),
      .send_ready_i(send_ready),
      .send_vertex_o(send_vertex),
      .send_position_o(send_position),
      .busy_o(busy[hs_pkg::STAGE_smooth]),
      .starved_o(starved[hs_pkg::STAGE_smooth]),
      .blocked_o(blocked[hs_pkg::STAGE_smooth]),
      .item_in_o(smooth_in),
      .item_out_o(smooth_out)
  );

  split #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_split (
      .clk_i,
      .rst_i,
      .start_i(kick_split),
      .items_i(items),
      .quads_i(quads),
      .all_i(all),
      .last_i(last_step),
      .finish_i(finish),
      .first_new_i(vertices[VW-1:0]),
      .active_o(split_active),
      .children_o(children),
      .record_rd_en_o(split_rd),
      .record_rd_item_o(split_item),
      .record_rd_face_o(split_face),
      .record_origin_i(origin),
      .record_twin_i(twin),
      .record_border_i(border),
      .record_candidate_i(candidate),
      .record_forced_i(forced),
      .record_last_i(record_last),
      .face_point_i(point),
      .own_verdict_i(own_verdict),
      .verdict_rd_en_o(verdict_rd_en),
      .verdict_rd_row_o(verdict_rd_row),
      .verdict_rd_data_i(verdicts),
      .number_wr_en_o(number_wr),
      .number_wr_item_o(number_wr_item),
      .number_wr_data_o(number_wr_data),
      .number_rd_en_o(number_rd_en),
      .number_rd_row_o(number_rd_row),
      .number_rd_data_i(numbers),
      .lower_wr_en_o(lower_wr_en),
      .lower_wr_row_o(lower_wr_row),
      .lower_wr_data_o(lower_wr_data),
      .upper_wr_en_o(upper_wr_en),
      .upper_wr_row_o(upper_wr_row),
      .upper_wr_data_o(upper_wr_data),
      .birth_o(split_birth),
      .sent_o(split_sent),
      .birth_vertex_o(split_vertex),
      .birth_position_o(split_position),
      .op_valid_o(split_op),
      .op_ready_i(split_ready),
      .op_kind_o(split_kind),
      .op_number_o(split_number),
      .op_position_o(split_op_position),
      .op_mask_o(split_mask),
      .op_triangle_o(split_triangle),
      .op_child_o(split_child),
      .op_candidate_o(split_candidate),
      .op_vertex_o(split_op_vertex),
      .op_sides_o(split_sides),
      .op_first_o(split_first),
      .op_last_o(split_last),
      .busy_o(busy[hs_pkg::STAGE_split]),
      .starved_o(starved[hs_pkg::STAGE_split]),
      .blocked_o(blocked[hs_pkg::STAGE_split]),
      .item_in_o(split_in),
      .item_out_o(split_out),
      .conflict_o(split_conflict)
  );

  // --- emit: the sequencer, smooth and split send in turn ------------------------------------------------
  logic control_op, control_trailer, op_valid, op_ready, emit_done;
  logic [7:0] control_generation;
  logic [2:0] op_kind;

  assign op_valid = control_op || send_valid || split_op;
  assign op_kind = control_op ? (control_trailer ? 3'(hs_pkg::OP_TRAILER) : 3'(hs_pkg::OP_HEADER)) :
      send_valid ? 3'(hs_pkg::OP_VERTEX) : split_kind;
  assign send_ready = op_ready && !control_op;
  assign split_ready = op_ready && !control_op && !send_valid;

  emit #(
      .PORT_RECORDS(PORT_RECORDS)
  ) u_emit (
      .clk_i,
      .rst_i,
      .op_valid_i(op_valid),
      .op_ready_o(op_ready),
      .op_kind_i(op_kind),
      .op_generation_i(control_op ? control_generation : generation),
      .op_number_i(send_valid ? 24'(send_vertex) : split_number),
      .op_position_i(send_valid ? send_position : split_op_position),
      .op_mask_i(split_mask),
      .op_triangle_i(split_triangle),
      .op_child_i(split_child),
      .op_candidate_i(split_candidate),
      .op_vertex_i(split_op_vertex),
      .op_sides_i(split_sides),
      .op_first_i(split_first),
      .op_last_i(split_last),
      .view_i(view),
      .exponent_i(refused ? 10'sd0 : exponent),
      .status_i(status),
      .position_i(position),
      .done_o(emit_done),
      .m_axis_tvalid,
      .m_axis_tready,
      .m_axis_tdata,
      .m_axis_tkeep,
      .m_axis_tlast,
      .m_axis_tid,
      .busy_o(busy[hs_pkg::STAGE_emit]),
      .starved_o(starved[hs_pkg::STAGE_emit]),
      .blocked_o(blocked[hs_pkg::STAGE_emit]),
      .items_in_o(items_in[3*hs_pkg::STAGE_emit+:3]),
      .items_out_o(items_out[3*hs_pkg::STAGE_emit+:3])
  );

  // --- The sequencer -------------------------------------------------------------------------------------
  sequencer #(
      .VW(VW),
      .QW(QW)
  ) u_sequencer (
      .clk_i,
      .rst_i,
      .limit_vertices_i(limit_vertices[VW:0]),
      .limit_quads_i(limit_quads[QW:0]),
      .view_done_o(view_done),
      .busy_o(view_busy),
      .status_o(status),
      .position_o(position),
      .kick_receive_o(kick_receive),
      .receive_item_i(receive_in),
      .receive_done_i(receive_done),
      .vertices_done_i(vertices_done),
      .transform_busy_i(transform_busy),
      .kick_quantize_o(kick_quantize),
      .quantize_done_i(quantize_done),
      .receive_status_i(receive_status),
      .receive_position_i(receive_position),
      .uniform_i(uniform),
      .front_depth_i(front_depth),
      .silhouette_depth_i(silhouette_depth),
      .uniform_depth_i(uniform_depth),
      .forced_max_i(forced_max),
      .closed_i(closed),
      .vertices_i(vertices_in),
      .faces_i(faces_in),
      .halfedges_i(halfedges_in),
      .kick_check_o(kick_check),
      .kick_classify_o(kick_classify),
      .classify_active_i(classify_active),
      .check_active_i(check_active),
      .check_error_i(check_error),
      .check_corner_i(check_corner),
      .valence_error_i(valence_error),
      .valence_corner_i(valence_corner),
      .kick_select_o(kick_select),
      .select_active_i(select_active),
      .selected_i(selected_count),
      .kick_guard_o(kick_guard),
      .guard_active_i(guard_active),
      .refined_i(refined_count),
      .sides_i(refined_sides),
      .kick_smooth_o(kick_smooth),
      .smooth_active_i(smooth_active),
      .kick_split_o(kick_split),
      .split_active_i(split_active),
      .children_i(children),
      .op_valid_o(control_op),
      .op_ready_i(op_ready),
      .op_trailer_o(control_trailer),
      .op_generation_o(control_generation),
      .emit_done_i(emit_done),
      .generation_o(generation),
      .odd_o(odd),
      .quads_o(quads),
      .side_o(side),
      .items_o(items),
      .vertices_o(vertices),
      .new_o(new_vertices),
      .all_o(all),
      .last_o(last_step),
      .finish_o(finish),
      .refused_o(refused)
  );

  // --- Counters ------------------------------------------------------------------------------------------
  assign items_in[3*hs_pkg::STAGE_receive+:3] = 3'(receive_in);
  assign items_out[3*hs_pkg::STAGE_receive+:3] = 3'(receive_out);
  assign items_in[3*hs_pkg::STAGE_transform+:3] = 3'(raw_valid);
  assign items_out[3*hs_pkg::STAGE_transform+:3] = 3'(clip_valid);
  assign items_in[3*hs_pkg::STAGE_quantize+:3] = 3'(quantize_in);
  assign items_out[3*hs_pkg::STAGE_quantize+:3] = 3'(quantize_out);
  assign items_in[3*hs_pkg::STAGE_classify+:3] = 3'(classify_in);
  assign items_out[3*hs_pkg::STAGE_classify+:3] = 3'(classify_out);
  assign items_in[3*hs_pkg::STAGE_select+:3] = 3'(select_in);
  assign items_out[3*hs_pkg::STAGE_select+:3] = 3'(select_out);
  assign items_in[3*hs_pkg::STAGE_guard+:3] = 3'(guard_in);
  assign items_out[3*hs_pkg::STAGE_guard+:3] = 3'(guard_out);
  assign items_in[3*hs_pkg::STAGE_smooth+:3] = 3'(smooth_in);
  assign items_out[3*hs_pkg::STAGE_smooth+:3] = 3'(smooth_out);
  assign items_in[3*hs_pkg::STAGE_split+:3] = 3'(split_in);
  assign items_out[3*hs_pkg::STAGE_split+:3] = 3'(split_out);
  assign conflict = 4'(classify_conflict[0]) + 4'(classify_conflict[1]) + 4'(select_conflict[0]) +
      4'(select_conflict[1]) + 4'(guard_conflict[0]) + 4'(guard_conflict[1]) +
      4'(split_conflict[0]) + 4'(split_conflict[1]) + 4'(split_conflict[2]);

endmodule
