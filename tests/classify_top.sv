// SPDX-License-Identifier: Apache-2.0
//
// classify.sv and smooth.sv at a vertex memory of 1024 words; the records come from outside, one
// cycle after they are asked for.

module classify_top (
    input logic clk_i,
    input logic rst_i,

    // a vertex: old position, sharp word and mark word first, position a cycle later
    input logic         birth_i,
    input logic         load_i,
    input logic [  9:0] vertex_i,
    input logic [127:0] position_i,
    input logic [ 17:0] sharp_i,
    input logic         sent_i,
    input logic         hold_i,

    // the generation
    input  logic        classify_i,
    input  logic        smooth_i,
    input  logic [10:0] items_i,
    input  logic [10:0] vertices_i,
    input  logic        finish_i,
    input  logic [ 7:0] generation_i,
    input  logic        limit_i,
    input  logic [15:0] min_edge_i,
    input  logic [15:0] width_i,
    input  logic [15:0] height_i,
    output logic        classify_active_o,
    output logic        smooth_active_o,

    // records
    output logic        rd_en_o,
    output logic [ 9:0] rd_item_o,
    input  logic [39:0] origin_i,
    input  logic [ 3:0] border_i,
    input  logic [ 3:0] boundary_i,
    input  logic [15:0] sharpness_i,
    input  logic [ 3:0] tag_i,
    input  logic        half_i,
    input  logic        last_i,

    // faces
    output logic         point_valid_o,
    output logic [  9:0] face_o,
    output logic [127:0] point_o,
    output logic         front_o,
    output logic         stop_o,

    // marks: of all banks, a cycle after look_i
    input  logic         look_i,
    input  logic [  6:0] row_i,
    output logic [103:0] marks_o,

    // what smooth writes and sends
    output logic         write_o,
    output logic [  9:0] write_vertex_o,
    output logic         move_o,
    output logic         old_o,         // of the vertex that was read in the cycle before
    output logic [  9:0] old_vertex_o,
    output logic         leave_o,
    output logic [127:0] write_position_o,
    output logic [127:0] before_o,
    output logic         send_valid_o,
    input  logic         send_ready_i,
    output logic [  9:0] send_vertex_o,
    output logic [127:0] send_position_o,
    output logic         at_level_o
);

  logic [7:0] keep;
  logic [6:0] keep_row;
  logic [7:0] gather_rd_en, mark_rd_en, mark_wr_en, sum_rd_en, sum_wr_en, ring_rd_en, ring_wr_en, held;
  logic [55:0] gather_rd_row, mark_rd_row, mark_wr_row, sum_rd_row, sum_wr_row, ring_rd_row;
  logic [55:0] ring_wr_row;
  logic [2191:0] gathered;
  logic [103:0] mark, mark_wr_data;
  logic [1343:0] sum, sum_wr_data;
  logic [1415:0] ring, ring_wr_data;
  logic row_rd, smooth_rd;
  logic [6:0] row;
  logic [9:0] smooth_rd_index;
  logic [127:0] single_position;
  logic [167:0] single_sum;
  logic [176:0] single_ring;
  logic [17:0] single_sharp;

  assign marks_o = mark;

  logic [7:0] sum_void, ring_void, row_there, held_used;

  /* verilator lint_off PINCONNECTEMPTY */
  vertex_memory #(
      .VW(10)
  ) i_vertices (
      .clk_i, .load_wr_en_i(load_i), .load_wr_index_i(vertex_i), .load_wr_data_i(position_i),
      .quantize_rd_en_i(1'b0), .quantize_rd_index_i(10'd0), .single_position_o(single_position),
      .birth_i, .sent_i(birth_i && sent_i), .birth_vertex_i(vertex_i),
      .birth_position_i(position_i), .birth_generation_i(8'hff), .birth_sharp_wr_i(1'b0),
      .birth_sharpness_i(4'd0), .birth_quiet_i(1'b0), .sharp_rd_en_i(1'b0), .sharp_rd_index_i(10'd0),
      .sharp_rd_data_o(), .sharp_wr_en_i(birth_i), .sharp_wr_index_i(vertex_i),
      .sharp_wr_data_i(sharp_i), .generation_i, .gather_rd_en_i(gather_rd_en),
      .gather_rd_row_i(gather_rd_row), .gather_old_i(generation_i[0]), .gather_rd_data_o(gathered),
      .mark_rd_en_i(mark_rd_en), .mark_rd_row_i(mark_rd_row), .mark_rd_data_o(mark),
      .mark_wr_en_i(mark_wr_en), .mark_wr_row_i(mark_wr_row), .mark_wr_data_i(mark_wr_data),
      .sum_rd_en_i(sum_rd_en), .sum_rd_row_i(sum_rd_row), .sum_rd_data_o(sum),
      .sum_wr_en_i(sum_wr_en), .sum_wr_row_i(sum_wr_row), .sum_wr_data_i(sum_wr_data),
      .ring_rd_en_i(ring_rd_en), .ring_rd_row_i(ring_rd_row), .ring_rd_data_o(ring),
      .ring_wr_en_i(ring_wr_en), .ring_wr_row_i(ring_wr_row), .ring_wr_data_i(ring_wr_data),
      .chosen_wr_en_i(8'd0), .chosen_wr_row_i(56'd0), .chosen_rd_en_i(8'd0),
      .chosen_rd_row_i(56'd0), .chosen_rd_data_o(), .held_wr_en_i(8'(hold_i) << vertex_i[2:0]),
      .held_wr_row_i(hold_i ? {8{vertex_i[9:3]}} : 56'd0), .row_rd_en_i(row_rd || look_i),
      .row_rd_i(look_i ? row_i : row), .held_rd_data_o(held), .smooth_rd_en_i(smooth_rd),
      .smooth_rd_index_i(smooth_rd_index), .single_sum_o(single_sum), .single_ring_o(single_ring),
      .single_sharp_o(single_sharp), .wide_rd_en_i(8'd0), .wide_rd_row_i(7'd0), .wide_rd_data_o(), .leave_wr_en_i(8'd0),
      .leave_wr_row_i(7'd0), .leave_new_i(1'b0), .smooth_wr_i(write_o), .smooth_wr_vertex_i(write_vertex_o),
      .smooth_wr_move_i(move_o), .smooth_wr_sent_i(leave_o),
      .smooth_wr_position_i(write_position_o), .keep_wr_en_i(keep), .keep_wr_row_i(keep_row),
      .sum_void_i(sum_void), .ring_void_i(ring_void), .row_there_i(row_there), .held_used_i(held_used), .fault_o()
  );

  classify #(
      .VW(10), .QW(10)
  ) i_classify (
      .clk_i, .rst_i, .start_i(classify_i), .items_i, .quads_i(generation_i != 8'd0),
      .odd_i(!generation_i[0]), .generation_i, .active_o(classify_active_o), .limit_i,
      .corners_stay_i(1'b0), .min_edge_i, .width_i, .height_i, .record_rd_en_o(rd_en_o),
      .record_rd_item_o(rd_item_o), .record_origin_i(origin_i), .record_border_i(border_i),
      .record_boundary_i(boundary_i), .record_sharp_i(sharpness_i), .record_tag_i(tag_i),
      .record_half_i(half_i), .record_last_i(last_i), .position_rd_en_o(gather_rd_en),
      .position_rd_row_o(gather_rd_row), .position_rd_data_i(gathered),
      .mark_rd_en_o(mark_rd_en), .mark_rd_row_o(mark_rd_row), .mark_rd_data_i(mark),
      .mark_wr_en_o(mark_wr_en), .mark_wr_row_o(mark_wr_row), .mark_wr_data_o(mark_wr_data),
      .sum_rd_en_o(sum_rd_en), .sum_rd_row_o(sum_rd_row), .sum_rd_data_i(sum),
      .sum_wr_en_o(sum_wr_en), .sum_wr_row_o(sum_wr_row), .sum_wr_data_o(sum_wr_data),
      .ring_rd_en_o(ring_rd_en), .ring_rd_row_o(ring_rd_row), .ring_rd_data_i(ring),
      .ring_wr_en_o(ring_wr_en), .ring_wr_row_o(ring_wr_row), .ring_wr_data_o(ring_wr_data),
      .pass_i(1'b0), .pass_valid_o(), .pass_ready_i(1'b0), .pass_item_o(),
      .pass_origin_o(), .pass_position_o(), .pass_point_o(), .pass_boundary_o(),
      .point_valid_o, .point_face_o(face_o), .point_o, .front_o, .stop_o, .valence_error_o(),
      .valence_corner_o(), .busy_o(), .starved_o(), .blocked_o(), .item_in_o(), .item_out_o(),
      .conflict_o(), .sum_void_o(sum_void), .ring_void_o(ring_void), .fault_o()
  );

  smooth #(
      .VW(10),
      .WIDE(1'b0)  // the test looks at vertices one by one
  ) i_smooth (
      .clk_i, .rst_i, .start_i(smooth_i), .count_i(vertices_i), .new_i(11'd0),
      .odd_i(!generation_i[0]), .last_i(1'b0), .finish_i, .generation_i,
      .active_o(smooth_active_o), .limit_i, .corners_stay_i(1'b0), .row_rd_en_o(row_rd),
      .row_rd_o(row), .mark_rd_data_i(mark), .held_rd_data_i(held), .vertex_rd_en_o(smooth_rd),
      .vertex_rd_index_o(smooth_rd_index), .position_rd_data_i(single_position),
      .sum_rd_data_i(single_sum), .ring_rd_data_i(single_ring), .sharp_rd_data_i(single_sharp),
      .new_from_face_i(1'b0), .face_rd_en_o(), .face_rd_index_o(), .face_rd_data_i(512'd0),
      .write_valid_o(write_o), .write_vertex_o, .write_move_o(move_o),
      .write_sent_o(leave_o), .write_position_o, .keep_wr_en_o(keep), .keep_wr_row_o(keep_row), .wide_rd_en_o(), .wide_rd_row_o(), .wide_rd_data_i(1024'd0), .leave_wr_en_o(),
      .leave_wr_row_o(), .group_valid_o(), .group_ready_i(1'b1), .group_vertex_o(),
      .group_position_o(), .send_valid_o,
      .send_ready_i, .send_vertex_o, .send_position_o, .send_at_level_o(at_level_o), .busy_o(),
      .starved_o(), .blocked_o(), .item_in_o(), .item_out_o(), .row_there_o(row_there), .held_used_o(held_used),
      .fault_o()
  );

  /* verilator lint_on PINCONNECTEMPTY */

  logic [9:0] read_q;

  always_ff @(posedge clk_i) if (smooth_rd) read_q <= smooth_rd_index;
  assign old_o = keep != 8'd0;
  assign old_vertex_o = old_o && keep_row == read_q[9:3] && keep == 8'd1 << read_q[2:0] ? read_q : '1;
  assign before_o = single_position;

endmodule
