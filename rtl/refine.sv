// SPDX-License-Identifier: Apache-2.0
//
// refine: the stages that run once a generation, and the memories that they share.
//
//   +--> classify --> select --> guard --> smooth --> split --+
//   |        |           |         |          |         |     |      vertex_memory: every vertex
//   +--------+-----------+--memories----------+---------+-----+      record_memory: the active mesh
//                                             |         |            face_memory: between stages
//                                             v         v
//                                         vertices    faces to emit
//
//   * The sequencer starts a stage with kick_*_i for one cycle and waits for its active_o to fall;
//     the generation's settings hold from classify's start to the end of split. check_twins runs
//     beside classify in generation 0.
//   * Before generation 0 transform and quantize fill the vertex memory, receive the corners.
//   * What each stage does and promises stands in its own file; what is wired here are the turns in
//     which they use the memories.

module refine #(
    parameter int unsigned VW = 19,  // width of a vertex number
    parameter int unsigned QW = 19,  // width of a quad's (generation 0: a corner's) number
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8, // words a cycle
    parameter int unsigned READ_LATENCY = 1, // of a gather
    parameter int unsigned OPS = 16, // that wait for emit
    parameter bit PARITY = 1'b1 // of the memories
) (
    input logic clk_i,
    input logic rst_i,

    // the generation, from the sequencer
    input  logic [7:0] generation_i,
    input  logic odd_i, quads_i, side_i, all_i, last_step_i, finish_i,
    input  logic pass_i,        // classify and split work in one pass
    input  logic edge_i,        // new vertices are made of the sums that such a pass left
    input  logic [7:0] marked_i,  // the generation whose classify wrote the marks
    input  logic [QW:0] items_i,
    input  logic [VW:0] vertices_i, new_vertices_i,

    // the view's settings, from receive
    input  logic uniform_i, guarded_i, limit_i, corners_stay_i,
    input  logic [7:0] front_depth_i, silhouette_depth_i,
    input  logic [15:0] min_edge_i, width_i, height_i,

    // starts, from the sequencer, and what it learns
    input  logic kick_classify_i, kick_check_i, kick_select_i, kick_guard_i,
    input  logic kick_smooth_i, kick_split_i,
    output logic classify_active_o, check_active_o, select_active_o,
    output logic guard_active_o, smooth_active_o, split_active_o, check_error_o,
    output logic [QW-1:0] check_corner_o,
    output logic check_sharpness_o,
    output logic valence_error_o,
    output logic [QW-1:0] valence_corner_o,
    output logic        any_selected_o,
    output logic [QW:0] refined_count_o,
    output logic [QW+2:0] refined_sides_o,
    output logic [QW:0] children_o,

    // vertices, from transform and quantize
    input  logic clip_valid_i,
    input  logic [VW-1:0] clip_index_i,
    input  logic [127:0] clip_i,
    input  logic quantize_rd_i,
    input  logic [VW-1:0] quantize_rd_index_i,
    output logic [127:0] single_position_o,
    input  logic quantize_wr_i,
    input  logic [VW-1:0] quantize_wr_index_i,
    input  logic [127:0] quantize_wr_data_i,

    // vertices and corners, from receive
    input  logic raw_valid_i,
    input  logic [VW-1:0] raw_index_i,
    input  logic corner_valid_i,
    input  logic [QW-1:0] corner_index_i,
    input  logic [VW-1:0] corner_origin_i,
    input  logic [QW-1:0] corner_twin_i,
    input  logic corner_border_i, corner_boundary_i,
    input  logic [3:0] corner_sharpness_i, corner_own_i,
    input  logic [7:0] corner_forced_i,
    input  logic corner_first_i, corner_last_i,

    // vertices to emit, from smooth, four at a time or singly
    output logic group_valid_o,
    input  logic group_ready_i,
    output logic [4*VW-1:0] group_vertex_o,
    output logic [511:0] group_position_o,
    output logic send_valid_o,
    input  logic send_ready_i,
    output logic [VW-1:0] send_vertex_o,
    output logic [127:0] send_position_o,
    output logic send_at_level_o,

    // faces to emit, and their new vertices, from split
    output logic split_op_o,
    input  logic split_ready_i,
    output logic [2:0] split_kind_o,
    output logic [23:0] split_number_o,
    output logic [127:0] split_op_position_o,
    output logic [3:0] split_mask_o, split_triangle_o, split_child_o, split_candidate_o,
    output logic [383:0] split_op_vertex_o,
    output logic [7:0] split_sides_o,
    output logic split_first_o, split_last_o,

    // counters, stage by stage from classify to split
    output logic [4:0] busy_o, starved_o, blocked_o, item_in_o,
    output logic [9:0] item_out_o,  // two bits a stage

    output logic [3:0] conflict_o,

    output logic fault_o  // the parity of a memory's word that is of use was wrong
);

  localparam int unsigned HW = QW + 2;
  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned VR = VW - BANK_BITS;
  localparam int unsigned QR = QW - BANK_BITS;
  localparam int unsigned HALF = 2 * VW + 2 * HW + 19;

  // --- Vertex memory: quantize, guard and split give birth to vertices, one after the other ------
  logic [BANKS-1:0] gather_rd_en, classify_mark_rd_en, select_mark_rd_en, mark_wr_en;
  logic [BANKS-1:0] sum_rd_en, sum_wr_en, chosen_wr_en, chosen_rd_en, held_wr_en, chosen, held;
  logic [VR*BANKS-1:0] gather_rd_row, classify_mark_rd_row, select_mark_rd_row, mark_wr_row;
  logic [VR*BANKS-1:0] sum_rd_row, sum_wr_row, chosen_wr_row, chosen_rd_row, held_wr_row;
  logic [274*BANKS-1:0] gathered;
  logic [BANKS-1:0] ring_rd_en, ring_wr_en;
  logic [VR*BANKS-1:0] ring_rd_row, ring_wr_row;
  logic [177*BANKS-1:0] ring, ring_wr_data;
  logic [13*BANKS-1:0] mark, mark_wr_data;
  logic [BANKS-1:0] sum_void, ring_void, row_there, held_used;
  logic vertices_fault, records_fault, faces_fault, classify_fault, select_fault, guard_fault, smooth_fault;
  logic split_fault;
  logic [168*BANKS-1:0] sum, sum_wr_data;
  logic [BANKS-1:0] wide_rd_en, leave_wr_en;
  logic [VR-1:0] wide_rd_row, leave_wr_row;
  logic [128*BANKS-1:0] wide_rd_data;
  logic smooth_row_rd, smooth_rd, smooth_wr, smooth_move, smooth_sent;
  logic [BANKS-1:0] keep_wr_en;
  logic [VR-1:0] keep_wr_row;
  logic [VR-1:0] smooth_row;
  logic [VW-1:0] smooth_rd_index, smooth_wr_vertex;
  logic [127:0] smooth_position;
  logic [167:0] single_sum;
  logic [176:0] single_ring;
  logic [17:0] single_sharp, sharp_rd_data, sharp_wr_data;
  logic sharp_rd, sharp_wr;
  logic [VW-1:0] sharp_rd_index, sharp_wr_index;
  logic [3:0] guard_sharpness, split_sharpness;
  logic guard_birth, split_birth, split_sent, retag_active, smooth_walks;
  logic [BANKS-1:0] retag_en;
  logic [VR-1:0] retag_row;
  logic [VW-1:0] guard_vertex, split_vertex, birth_vertex;
  logic [127:0] guard_position, split_position, birth_position;

  always_comb begin
    birth_vertex = quantize_wr_index_i;
    birth_position = quantize_wr_data_i;
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
      .VW(VW), .BANK_BITS(BANK_BITS), .PARITY(PARITY)
  ) u_vertices (
      .clk_i, .load_wr_en_i(clip_valid_i), .load_wr_index_i(clip_index_i), .load_wr_data_i(clip_i),
      .quantize_rd_en_i(quantize_rd_i), .quantize_rd_index_i, .single_position_o,
      .birth_i(quantize_wr_i || guard_birth || split_birth), .sent_i(split_sent),
      .birth_vertex_i(birth_vertex), .birth_position_i(birth_position),
      .birth_generation_i(quantize_wr_i ? 8'hff : generation_i), .generation_i,
      .birth_sharp_wr_i(guard_birth || split_birth),
      .birth_sharpness_i(split_birth ? split_sharpness : guard_sharpness), .birth_quiet_i(pass_i),
      .sharp_rd_en_i(sharp_rd), .sharp_rd_index_i(sharp_rd_index),
      .sharp_rd_data_o(sharp_rd_data), .sharp_wr_en_i(sharp_wr), .sharp_wr_index_i(sharp_wr_index),
      .sharp_wr_data_i(sharp_wr_data), .ring_rd_en_i(ring_rd_en), .ring_rd_row_i(ring_rd_row),
      .ring_rd_data_o(ring), .ring_wr_en_i(ring_wr_en), .ring_wr_row_i(ring_wr_row),
      .ring_wr_data_i(ring_wr_data), .single_ring_o(single_ring), .single_sharp_o(single_sharp),
      .gather_rd_en_i(gather_rd_en), .gather_rd_row_i(gather_rd_row), .gather_old_i(!odd_i),
      .gather_rd_data_o(gathered), .mark_rd_en_i(classify_mark_rd_en | select_mark_rd_en),
      .mark_rd_row_i(classify_mark_rd_row | select_mark_rd_row), .mark_rd_data_o(mark),
      .mark_wr_en_i(mark_wr_en), .mark_wr_row_i(mark_wr_row), .mark_wr_data_i(mark_wr_data),
      .sum_rd_en_i(sum_rd_en), .sum_rd_row_i(sum_rd_row), .sum_rd_data_o(sum), .sum_void_i(sum_void), .ring_void_i(limit_i ? ring_void : {BANKS{1'b1}}),
      .row_there_i(row_there), .held_used_i(held_used), .fault_o(vertices_fault),
      .sum_wr_en_i(sum_wr_en), .sum_wr_row_i(sum_wr_row), .sum_wr_data_i(sum_wr_data),
      .chosen_wr_en_i(chosen_wr_en), .chosen_wr_row_i(chosen_wr_row), .chosen_rd_en_i(chosen_rd_en),
      .chosen_rd_row_i(chosen_rd_row), .chosen_rd_data_o(chosen), .held_wr_en_i(held_wr_en),
      .held_wr_row_i(held_wr_row), .row_rd_en_i(smooth_row_rd), .row_rd_i(smooth_row),
      .held_rd_data_o(held), .smooth_rd_en_i(smooth_rd), .smooth_rd_index_i(smooth_rd_index),
      .single_sum_o(single_sum), .wide_rd_en_i(wide_rd_en), .wide_rd_row_i(wide_rd_row),
      .wide_rd_data_o(wide_rd_data), .leave_wr_en_i(leave_wr_en | retag_en),
      .leave_wr_row_i(retag_active ? retag_row : leave_wr_row), .leave_new_i(retag_active),
      .smooth_wr_i(smooth_wr), .smooth_wr_vertex_i(smooth_wr_vertex),
      .smooth_wr_move_i(smooth_move), .smooth_wr_sent_i(smooth_sent), .keep_wr_en_i(keep_wr_en),
      .keep_wr_row_i(keep_wr_row),
      .smooth_wr_position_i(smooth_position)
  );

  // What was born in one pass with classify gets its marks while smooth is at work; in such a step none
  // leave.
  retag #(
      .VW(VW), .BANK_BITS(BANK_BITS)
  ) u_retag (
      .clk_i, .rst_i, .start_i(kick_smooth_i && pass_i), .first_i(vertices_i[VW-1:0]),
      .count_i(new_vertices_i), .active_o(retag_active), .wr_en_o(retag_en), .wr_row_o(retag_row)
  );
  assign smooth_active_o = smooth_walks || retag_active;

  // --- Record and face memories: the stages read them in turn ------------------------------------
  logic classify_rd, select_rd, guard_rd, split_rd, candidate, record_last, half;
  logic [QW-1:0] classify_item, select_item, guard_item, split_item;
  logic [QW-1:0] select_face, guard_face, split_face, record_item, face_item;
  logic smooth_face_rd;
  logic [VW-1:0] smooth_face;
  logic [4*VW-1:0] origin;
  logic [4*HW-1:0] twin;
  logic [3:0] border, boundary, tag, a_sharpness, b_sharpness;
  logic [15:0] sharp;
  logic [7:0] forced;
  logic check_a_rd, check_b_rd, a_border, a_first, a_last, b_border;
  logic [QW-1:0] check_a_index, check_b_index, a_twin, b_twin;
  logic [VW-1:0] a_origin, b_origin;
  logic [BANKS-1:0] lower_wr_en, upper_wr_en;
  logic [QR*BANKS-1:0] lower_wr_row, upper_wr_row;
  logic [HALF*BANKS-1:0] lower_wr_data, upper_wr_data;
  logic [132*BANKS-1:0] lower_wr_sum, upper_wr_sum;
  logic [127:0] edge_point;
  logic [511:0] edge_points;

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

  record_memory #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS), .PARITY(PARITY)
  ) u_records (
      .clk_i, .side_i, .quads_i, .items_i, .fault_o(records_fault), .corner_valid_i, .corner_index_i, .corner_origin_i, .corner_twin_i,
      .corner_border_i, .corner_boundary_i, .corner_sharpness_i, .corner_forced_i, .corner_first_i,
      .corner_last_i, .rd_en_i(classify_rd || select_rd || guard_rd || split_rd), .rd_item_i(record_item),
      .origin_o(origin), .twin_o(twin), .border_o(border), .boundary_o(boundary), .sharp_o(sharp),
      .tag_o(tag), .half_o(half), .candidate_o(candidate),
      .forced_o(forced), .last_o(record_last), .edge_i, .edge_rd_en_i(smooth_face_rd),
      .edge_rd_item_i(QW'(smooth_face)), .edge_point_o(edge_point), .edge_points_o(edge_points),
      .sum_wr_i(pass_i), .lower_wr_sum_i(lower_wr_sum), .upper_wr_sum_i(upper_wr_sum), .a_rd_en_i(check_a_rd), .a_rd_index_i(check_a_index),
      .a_origin_o(a_origin), .a_twin_o(a_twin), .a_border_o(a_border), .a_sharpness_o(a_sharpness), .a_first_o(a_first),
      .a_last_o(a_last), .b_rd_en_i(check_b_rd), .b_rd_index_i(check_b_index),
      .b_origin_o(b_origin), .b_twin_o(b_twin), .b_border_o(b_border), .b_sharpness_o(b_sharpness), .lower_wr_en_i(lower_wr_en),
      .lower_wr_row_i(lower_wr_row), .lower_wr_data_i(lower_wr_data), .upper_wr_en_i(upper_wr_en),
      .upper_wr_row_i(upper_wr_row), .upper_wr_data_i(upper_wr_data)
  );

  logic point_valid, point_front, point_stop, front, stop, selected_valid, selected_verdict, selected;
  logic [QW-1:0] point_face, selected_face;
  logic [127:0] point_wr_data, point;
  logic [511:0] points;
  logic verdict_valid, number_wr;
  logic [QW-1:0] verdict_item, number_wr_item;
  logic [VW+1:0] verdict_wr_data, own_verdict;
  logic [QW+3:0] number_wr_data;
  logic [BANKS-1:0] verdict_rd_en, number_rd_en;
  logic [QR*BANKS-1:0] verdict_rd_row, number_rd_row;
  logic [(VW+2)*BANKS-1:0] verdicts;
  logic [(QW+4)*BANKS-1:0] numbers;

  face_memory #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS), .PARITY(PARITY)
  ) u_faces (
      .clk_i, .point_wr_en_i(point_valid), .point_wr_face_i(point_face),
      .point_wr_data_i(point_wr_data), .point_wr_front_i(point_front), .point_wr_stop_i(point_stop),
      .selected_wr_en_i(selected_valid), .selected_wr_face_i(selected_face),
      .selected_wr_data_i(selected_verdict),
      .face_rd_en_i(select_rd || guard_rd || split_rd || smooth_face_rd), .face_rd_i(face_item),
      .point_used_i(!edge_i), .face_line_i(smooth_face_rd), .faces_i(items_i), .selected_used_i(guard_rd && !uniform_i),
      .own_used_i(!all_i && !finish_i), .fault_o(faces_fault),
      .point_o(point), .points_o(points), .front_o(front), .stop_o(stop), .selected_o(selected), .verdict_wr_en_i(verdict_valid),
      .verdict_wr_item_i(verdict_item), .verdict_wr_data_i(verdict_wr_data), .own_rd_en_i(split_rd),
      .own_rd_item_i(split_item), .own_o(own_verdict), .verdict_rd_en_i(verdict_rd_en),
      .verdict_rd_row_i(verdict_rd_row), .verdict_rd_data_o(verdicts), .number_wr_en_i(number_wr),
      .number_wr_item_i(number_wr_item), .number_wr_data_i(number_wr_data),
      .number_rd_en_i(number_rd_en), .number_rd_row_i(number_rd_row), .number_rd_data_o(numbers)
  );

  // --- While a view comes in: how sharp its vertices are -----------------------------------------
  sharpness #(
      .VW(VW)
  ) u_sharpness (
      .clk_i, .rst_i, .vertex_valid_i(raw_valid_i), .vertex_index_i(raw_index_i), .corner_valid_i,
      .corner_origin_i, .corner_boundary_i, .corner_sharpness_i, .corner_own_i,
      .rd_en_o(sharp_rd), .rd_index_o(sharp_rd_index), .rd_data_i(sharp_rd_data),
      .wr_en_o(sharp_wr), .wr_index_o(sharp_wr_index), .wr_data_o(sharp_wr_data)
  );

  // --- classify; in generation 0 check_twins beside it -------------------------------------------
  logic [1:0] classify_conflict;

  // --- In one pass, from classify to split -------------------------------------------------------
  logic pass_valid, pass_ready;
  logic [QW-1:0] pass_item;
  logic [4*VW-1:0] pass_origin;
  logic [511:0] pass_position;
  logic [127:0] pass_point;
  logic [3:0] pass_boundary;

  classify #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .PARITY(PARITY)
  ) u_classify (
      .clk_i, .rst_i, .start_i(kick_classify_i), .pass_i, .pass_valid_o(pass_valid),
      .pass_ready_i(pass_ready), .pass_item_o(pass_item), .pass_origin_o(pass_origin),
      .pass_position_o(pass_position), .pass_point_o(pass_point), .pass_boundary_o(pass_boundary), .items_i, .quads_i, .odd_i, .generation_i,
      .limit_i, .corners_stay_i, .min_edge_i, .width_i, .height_i, .record_half_i(half),
      .record_boundary_i(boundary), .record_sharp_i(sharp), .record_tag_i(tag),
      .stop_o(point_stop), .ring_rd_en_o(ring_rd_en), .ring_rd_row_o(ring_rd_row),
      .ring_rd_data_i(ring), .ring_wr_en_o(ring_wr_en), .ring_wr_row_o(ring_wr_row),
      .ring_wr_data_o(ring_wr_data),
      .active_o(classify_active_o), .record_rd_en_o(classify_rd), .record_rd_item_o(classify_item),
      .record_origin_i(origin), .record_border_i(border), .record_last_i(record_last),
      .position_rd_en_o(gather_rd_en), .position_rd_row_o(gather_rd_row),
      .position_rd_data_i(gathered), .mark_rd_en_o(classify_mark_rd_en),
      .mark_rd_row_o(classify_mark_rd_row), .mark_rd_data_i(mark), .mark_wr_en_o(mark_wr_en),
      .mark_wr_row_o(mark_wr_row), .mark_wr_data_o(mark_wr_data), .sum_rd_en_o(sum_rd_en),
      .sum_rd_row_o(sum_rd_row), .sum_rd_data_i(sum), .sum_void_o(sum_void),
      .ring_void_o(ring_void), .fault_o(classify_fault), .sum_wr_en_o(sum_wr_en),
      .sum_wr_row_o(sum_wr_row), .sum_wr_data_o(sum_wr_data), .point_valid_o(point_valid),
      .point_face_o(point_face), .point_o(point_wr_data), .front_o(point_front), .valence_error_o,
      .valence_corner_o, .busy_o(busy_o[0]), .starved_o(starved_o[0]), .blocked_o(blocked_o[0]),
      .item_in_o(item_in_o[0]), .item_out_o(item_out_o[0]), .conflict_o(classify_conflict)
  );

  check_twins #(
      .VW(VW), .QW(QW)
  ) u_check_twins (
      .clk_i, .rst_i, .start_i(kick_check_i), .corners_i(items_i), .active_o(check_active_o),
      .error_o(check_error_o), .corner_o(check_corner_o), .sharpness_error_o(check_sharpness_o),
      .a_sharpness_i(a_sharpness), .b_sharpness_i(b_sharpness), .a_rd_en_o(check_a_rd),
      .a_rd_index_o(check_a_index), .a_origin_i(a_origin), .a_twin_i(a_twin), .a_border_i(a_border),
      .a_first_i(a_first), .a_last_i(a_last), .b_rd_en_o(check_b_rd), .b_rd_index_o(check_b_index),
      .b_origin_i(b_origin), .b_twin_i(b_twin), .b_border_i(b_border)
  );

  // --- select, guard -----------------------------------------------------------------------------
  logic [1:0] select_conflict, guard_conflict;

  select #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .PARITY(PARITY)
  ) u_select (
      .clk_i, .rst_i, .start_i(kick_select_i), .items_i, .quads_i, .generation_i, .front_depth_i,
      .silhouette_depth_i, .active_o(select_active_o), .any_o(any_selected_o),
      .record_rd_en_o(select_rd), .record_rd_item_o(select_item), .record_rd_face_o(select_face),
      .record_origin_i(origin), .record_candidate_i(candidate), .record_forced_i(forced),
      .record_half_i(half), .record_last_i(record_last), .face_front_i(front), .face_stop_i(stop),
      .mark_rd_en_o(select_mark_rd_en),
      .mark_rd_row_o(select_mark_rd_row), .mark_rd_data_i(mark), .chosen_wr_en_o(chosen_wr_en),
      .chosen_wr_row_o(chosen_wr_row), .selected_valid_o(selected_valid),
      .selected_face_o(selected_face), .selected_verdict_o(selected_verdict), .busy_o(busy_o[1]),
      .starved_o(starved_o[1]), .blocked_o(blocked_o[1]), .item_in_o(item_in_o[1]),
      .item_out_o(item_out_o[2]), .conflict_o(select_conflict), .fault_o(select_fault)
  );

  guard #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .PARITY(PARITY)
  ) u_guard (
      .clk_i, .rst_i, .start_i(kick_guard_i), .items_i, .quads_i, .odd_i, .guard_i(guarded_i),
      .record_boundary_i(boundary), .record_tag_i(tag), .record_half_i(half),
      .new_sharpness_o(guard_sharpness),
      .all_i(uniform_i), .first_new_i(vertices_i), .active_o(guard_active_o),
      .refined_o(refined_count_o), .sides_o(refined_sides_o), .record_rd_en_o(guard_rd),
      .record_rd_item_o(guard_item), .record_rd_face_o(guard_face), .record_origin_i(origin),
      .record_last_i(record_last), .face_selected_i(selected), .face_point_i(point),
      .chosen_rd_en_o(chosen_rd_en), .chosen_rd_row_o(chosen_rd_row), .chosen_rd_data_i(chosen),
      .held_wr_en_o(held_wr_en), .held_wr_row_o(held_wr_row), .verdict_valid_o(verdict_valid),
      .verdict_item_o(verdict_item), .verdict_o(verdict_wr_data), .new_valid_o(guard_birth),
      .new_vertex_o(guard_vertex), .new_position_o(guard_position), .busy_o(busy_o[2]),
      .starved_o(starved_o[2]), .blocked_o(blocked_o[2]), .item_in_o(item_in_o[2]),
      .item_out_o(item_out_o[4]), .conflict_o(guard_conflict), .fault_o(guard_fault)
  );

  // --- smooth, split -----------------------------------------------------------------------------
  logic [2:0] split_conflict;

  smooth #(
      .VW(VW), .BANK_BITS(BANK_BITS),
      .OPS(OPS), .PARITY(PARITY)
  ) u_smooth (
      .clk_i, .rst_i, .start_i(kick_smooth_i), .count_i(vertices_i), .new_i(new_vertices_i), .odd_i,
      .last_i(last_step_i), .finish_i, .generation_i(marked_i), .active_o(smooth_walks),
      .limit_i, .corners_stay_i, .sharp_rd_data_i(single_sharp), .ring_rd_data_i(single_ring),
      .send_at_level_o,
      .row_rd_en_o(smooth_row_rd), .row_rd_o(smooth_row), .mark_rd_data_i(mark),
      .held_rd_data_i(held), .row_there_o(row_there), .held_used_o(held_used), .fault_o(smooth_fault), .vertex_rd_en_o(smooth_rd), .vertex_rd_index_o(smooth_rd_index),
      .position_rd_data_i(single_position_o), .sum_rd_data_i(single_sum), .new_from_face_i(all_i),
      .face_rd_en_o(smooth_face_rd), .face_rd_index_o(smooth_face), .face_rd_data_i(edge_i ? edge_points : points),
      .write_valid_o(smooth_wr), .write_vertex_o(smooth_wr_vertex), .write_move_o(smooth_move),
      .write_sent_o(smooth_sent), .write_position_o(smooth_position),
      .keep_wr_en_o(keep_wr_en), .keep_wr_row_o(keep_wr_row), .wide_rd_en_o(wide_rd_en), .wide_rd_row_o(wide_rd_row),
      .wide_rd_data_i(wide_rd_data), .leave_wr_en_o(leave_wr_en), .leave_wr_row_o(leave_wr_row),
      .group_valid_o, .group_ready_i, .group_vertex_o, .group_position_o, .send_valid_o, .send_ready_i, .send_vertex_o,
      .send_position_o, .busy_o(busy_o[3]), .starved_o(starved_o[3]), .blocked_o(blocked_o[3]),
      .item_in_o(item_in_o[3]), .item_out_o(item_out_o[7:6])
  );

  split #(
      .VW(VW), .QW(QW), .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .OPS(OPS), .PARITY(PARITY)
  ) u_split (
      .clk_i, .rst_i, .start_i(kick_split_i), .pass_i, .pass_take_i(item_in_o[0]), .pass_valid_i(pass_valid),
      .pass_ready_o(pass_ready), .pass_item_i(pass_item), .pass_origin_i(pass_origin),
      .pass_position_i(pass_position), .pass_point_i(pass_point), .pass_boundary_i(pass_boundary),
      .edge_i, .edge_point_i(edge_point), .generation_i, .lower_wr_sum_o(lower_wr_sum),
      .upper_wr_sum_o(upper_wr_sum), .items_i, .quads_i, .odd_i, .all_i,
      .last_i(last_step_i), .record_boundary_i(boundary), .record_sharp_i(sharp),
      .record_tag_i(tag), .record_half_i(half), .birth_sharpness_o(split_sharpness),
      .finish_i, .first_new_i(vertices_i[VW-1:0]), .active_o(split_active_o), .children_o,
      .record_rd_en_o(split_rd), .record_rd_item_o(split_item), .record_rd_face_o(split_face),
      .record_origin_i(origin), .record_twin_i(twin), .record_border_i(border),
      .record_candidate_i(candidate), .record_forced_i(forced), .record_last_i(record_last),
      .face_point_i(point), .own_verdict_i(own_verdict), .verdict_rd_en_o(verdict_rd_en),
      .verdict_rd_row_o(verdict_rd_row), .verdict_rd_data_i(verdicts), .number_wr_en_o(number_wr),
      .number_wr_item_o(number_wr_item), .number_wr_data_o(number_wr_data),
      .number_rd_en_o(number_rd_en), .number_rd_row_o(number_rd_row), .number_rd_data_i(numbers),
      .lower_wr_en_o(lower_wr_en), .lower_wr_row_o(lower_wr_row), .lower_wr_data_o(lower_wr_data),
      .upper_wr_en_o(upper_wr_en), .upper_wr_row_o(upper_wr_row), .upper_wr_data_o(upper_wr_data),
      .birth_o(split_birth), .sent_o(split_sent), .birth_vertex_o(split_vertex),
      .birth_position_o(split_position), .op_valid_o(split_op_o), .op_ready_i(split_ready_i),
      .op_kind_o(split_kind_o), .op_number_o(split_number_o), .op_position_o(split_op_position_o),
      .op_mask_o(split_mask_o), .op_triangle_o(split_triangle_o), .op_child_o(split_child_o),
      .op_candidate_o(split_candidate_o), .op_vertex_o(split_op_vertex_o),
      .op_sides_o(split_sides_o), .op_first_o(split_first_o), .op_last_o(split_last_o),
      .busy_o(busy_o[4]), .starved_o(starved_o[4]), .blocked_o(blocked_o[4]),
      .item_in_o(item_in_o[4]), .item_out_o(item_out_o[8]), .conflict_o(split_conflict), .fault_o(split_fault)
  );

  assign {item_out_o[9], item_out_o[5], item_out_o[3], item_out_o[1]} = 4'd0;

  // --- Counters ----------------------------------------------------------------------------------
  assign conflict_o = 4'(classify_conflict[0]) + 4'(classify_conflict[1]) + 4'(select_conflict[0]) +
      4'(select_conflict[1]) + 4'(guard_conflict[0]) + 4'(guard_conflict[1]) +
      4'(split_conflict[0]) + 4'(split_conflict[1]) + 4'(split_conflict[2]);

  // --- Parity ------------------------------------------------------------------------------------
  assign fault_o = vertices_fault || records_fault || faces_fault || classify_fault || select_fault ||
      guard_fault || smooth_fault || split_fault;

endmodule
