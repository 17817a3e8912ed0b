// SPDX-License-Identifier: Apache-2.0
//
// select on 256 vertices and 256 items; the memories around it are the test's.

module select_top #(
    localparam int unsigned VW = 8,
    localparam int unsigned QW = 8,
    localparam int unsigned BANK_BITS = 3
) (
    input logic clk_i,
    input logic rst_i,

    input  logic        start_i,
    input  logic [QW:0] items_i,
    input  logic        quads_i,
    input  logic [ 7:0] generation_i,
    input  logic [ 7:0] front_depth_i,
    input  logic [ 7:0] silhouette_depth_i,
    output logic        active_o,
    output logic any_o,

    output logic            record_rd_en_o,
    output logic [  QW-1:0] record_rd_item_o,
    output logic [  QW-1:0] record_rd_face_o,
    input  logic [4*VW-1:0] record_origin_i,
    input  logic            record_half_i,
    input  logic            record_candidate_i,
    input  logic [     7:0] record_forced_i,
    input  logic            record_last_i,
    input  logic            face_front_i,
    input  logic            face_stop_i,

    output logic [              (1<<BANK_BITS)-1:0] mark_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_rd_row_o,
    input  logic [           13*(1<<BANK_BITS)-1:0] mark_rd_data_i,

    output logic [              (1<<BANK_BITS)-1:0] chosen_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] chosen_wr_row_o,

    output logic          selected_valid_o,
    output logic [QW-1:0] selected_face_o,
    output logic          selected_verdict_o
);

  /* verilator lint_off PINCONNECTEMPTY */
  select #(
      .VW(VW),
      .QW(QW),
      .BANK_BITS(BANK_BITS)
  ) u_select (
      .busy_o(),  // the pipeline's tests look at counters
      .starved_o(),
      .blocked_o(),
      .item_in_o(),
      .item_out_o(),
      .conflict_o(),
      .fault_o(),
      .*
  );
  /* verilator lint_on PINCONNECTEMPTY */

endmodule
