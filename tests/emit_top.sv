// SPDX-License-Identifier: Apache-2.0
//
// Three emits with 1, 2 and 4 records a beat, side by side, so that one binary tests them all.
// They share what is told to them; lane i of op_valid_i and so on is the emit with 2^i records.

module emit_top (
    input logic clk_i,
    input logic rst_i,

    input  logic [  2:0] op_valid_i,
    output logic [  2:0] op_ready_o,
    input  logic [  2:0] op_kind_i,
    input  logic [  7:0] op_generation_i,
    input  logic [ 23:0] op_number_i,
    input  logic [127:0] op_position_i,
    input  logic [383:0] op_group_i,
    input  logic         op_at_level_i,
    input  logic [  3:0] op_mask_i,
    input  logic [  3:0] op_triangle_i,
    input  logic [  3:0] op_child_i,
    input  logic [  3:0] op_candidate_i,
    input  logic [383:0] op_vertex_i,
    input  logic [  7:0] op_sides_i,
    input  logic         op_first_i,
    input  logic         op_last_i,

    input  logic [15:0] view_i,
    input  logic [ 9:0] exponent_i,
    input  logic [ 7:0] status_i,
    input  logic [31:0] position_i,
    output logic [ 2:0] done_o,

    output logic [   2:0] tvalid_o,
    input  logic [   2:0] tready_i,
    output logic [1535:0] tdata_o,   // 512 bits a lane
    output logic [ 191:0] tkeep_o,   // 64 bits a lane
    output logic [   2:0] tlast_o,
    output logic [  47:0] tid_o,

    output logic [2:0] busy_o,
    output logic [2:0] starved_o,
    output logic [2:0] blocked_o,
    output logic [8:0] items_in_o,
    output logic [8:0] items_out_o
);

  genvar i;
  generate
    for (i = 0; i < 3; i = i + 1) begin : gen_port
      localparam int unsigned RECORDS = 1 << i;
      logic [128*RECORDS-1:0] tdata;
      logic [ 16*RECORDS-1:0] tkeep;
      assign tdata_o[512*i+:512] = 512'(tdata);
      assign tkeep_o[64*i+:64]   = 64'(tkeep);
      emit #(
          .PORT_RECORDS(RECORDS)
      ) emit (
          .op_valid_i   (op_valid_i[i]),
          .op_ready_o   (op_ready_o[i]),
          .exponent_i   ($signed(exponent_i)),
          .done_o       (done_o[i]),
          .m_axis_tvalid(tvalid_o[i]),
          .m_axis_tready(tready_i[i]),
          .m_axis_tdata (tdata),
          .m_axis_tkeep (tkeep),
          .m_axis_tlast (tlast_o[i]),
          .m_axis_tid   (tid_o[16*i+:16]),
          .busy_o       (busy_o[i]),
          .starved_o    (starved_o[i]),
          .blocked_o    (blocked_o[i]),
          .items_in_o   (items_in_o[3*i+:3]),
          .items_out_o  (items_out_o[3*i+:3]),
          .*
      );
    end
  endgenerate

endmodule
