// SPDX-License-Identifier: Apache-2.0
//
// scatter.sv and gather.sv before one memory of 64 bytes in 8 banks.

module window_top (
    input logic clk_i,
    input logic rst_i,

    input  logic        write_valid_i,
    output logic        write_ready_o,
    input  logic [ 3:0] write_mask_i,
    input  logic [23:0] write_index_i,
    input  logic [31:0] write_data_i,
    output logic        write_conflict_o,
    output logic        write_active_o,

    input  logic        stall_i,
    input  logic        read_valid_i,
    output logic        read_ready_o,
    input  logic [15:0] read_item_i,
    input  logic [ 3:0] read_mask_i,
    input  logic [23:0] read_index_i,
    output logic        out_valid_o,
    output logic [15:0] out_item_o,
    output logic [31:0] out_data_o,
    output logic        read_conflict_o,
    output logic        read_active_o
);

  logic [7:0] rd_en, wr_en;
  logic [23:0] rd_row, wr_row;
  logic [63:0] rd_data, wr_data;

  scatter #(
      .WIDTH(8), .ROW_BITS(3), .BANK_BITS(3)
  ) u_scatter (
      .clk_i, .rst_i, .in_valid_i(write_valid_i), .in_ready_o(write_ready_o),
      .in_mask_i(write_mask_i), .in_index_i(write_index_i), .in_data_i(write_data_i),
      .en_o(wr_en), .row_o(wr_row), .data_o(wr_data), .conflict_o(write_conflict_o),
      .active_o(write_active_o)
  );

  gather #(
      .ITEM_WIDTH(16), .WIDTH(8), .ROW_BITS(3), .BANK_BITS(3)
  ) u_gather (
      .clk_i, .rst_i, .stall_i, .in_valid_i(read_valid_i), .in_ready_o(read_ready_o),
      .in_item_i(read_item_i), .in_mask_i(read_mask_i), .in_index_i(read_index_i),
      .rd_en_o(rd_en), .rd_row_o(rd_row), .rd_data_i(rd_data), .out_valid_o, .out_item_o,
      .out_data_o, .conflict_o(read_conflict_o), .active_o(read_active_o)
  );

  /* verilator lint_off PINCONNECTEMPTY */
  banked_memory #(
      .WIDTH(8), .ROW_BITS(3), .BANK_BITS(3)
  ) u_memory (
      .clk_i, .rd_en_i(rd_en), .rd_row_i(rd_row), .rd_data_o(rd_data), .wr_en_i(wr_en),
      .wr_row_i(wr_row), .wr_data_i(wr_data), .check_i(8'hff), .fault_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

endmodule
