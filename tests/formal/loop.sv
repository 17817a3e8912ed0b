// SPDX-License-Identifier: Apache-2.0
//
// A stage's loop, of the real modules in their smallest sizes:
//
//   fetch --> gather --> fold --> scatter --> banks
//                '---stall---'
//
// An item carries its number and its face's, and a face's result is its number, so that what leaves shows
// where it came from; the words are what gather and scatter are proved for apart. Proved: something moves in
// every SLACK cycles while anything is inside; every item leaves once and in order, with its face's
// result; and fold never gets an item that it has no room for.

module loop #(
    // Items of a generation, as a power of two, and of a face at most.
    parameter int unsigned BITS = 2,
    parameter int unsigned FACE_ITEMS = 3,
    parameter int unsigned ITEMS = 8,
    parameter int unsigned MARGIN = 4,
    parameter int unsigned LANES = 1,
    parameter int unsigned READ_LATENCY = 1,
    // Cycles from a face's last item to its result.
    parameter int unsigned DELAY = 1
) (
    input logic clk_i,
    input logic rst_i,

    input logic            start_i,
    input logic [BITS:0]   count_i,
    // the item's record: lanes that read, lanes that send, words
    input logic [3:0]      mask_i,
    input logic [3:0]      send_i,
    input logic [7:0]      index_i,
    input logic            last_i
);

  localparam int unsigned WINDOW_BITS = 1;
  localparam int unsigned ITEM = 1 + 2 * BITS + 4 + 8;

  logic fetch_valid, fetch_ready, fetch_active, stall, gather_valid, gather_active, gather_last;
  logic [BITS-1:0] fetch_item, fetch_face;
  logic [ITEM-1:0] gather_item;
  logic [7:0] gather_index;
  logic [3:0] gather_send;
  logic [BITS-1:0] gather_number, gather_face;
  logic [1:0] read_en, word_en;
  logic fold_valid, fold_ready, fold_last, fold_active, scatter_active;
  logic [ITEM-2:0] fold_item;
  logic [BITS-1:0] fold_result;

  fetch #(
      .BITS(BITS)
  ) u_fetch (
      .clk_i, .rst_i, .start_i, .count_i, .rd_en_o(), .rd_item_o(), .rd_face_o(), .valid_o(fetch_valid),
      .ready_i(fetch_ready), .last_i, .item_o(fetch_item), .face_o(fetch_face), .active_o(fetch_active)
  );

  gather #(
      .ITEM_WIDTH(ITEM), .WIDTH(1), .ROW_BITS(1), .BANK_BITS(1), .WINDOW_BITS(WINDOW_BITS), .LANES(LANES),
      .READ_LATENCY(READ_LATENCY)
  ) u_gather (
      .clk_i, .rst_i, .stall_i(stall), .in_valid_i(fetch_valid), .in_ready_o(fetch_ready),
      .in_item_i({last_i, fetch_item, fetch_face, send_i, index_i}), .in_mask_i(mask_i), .in_index_i(index_i),
      .rd_en_o(read_en), .rd_row_o(), .rd_data_i(2'd0), .out_valid_o(gather_valid),
      .out_item_o(gather_item), .out_data_o(), .conflict_o(), .active_o(gather_active)
  );
  assign {gather_last, gather_number, gather_face, gather_send, gather_index} = gather_item;

  // Results.
  logic [DELAY:0] result_valid;
  logic [(DELAY+1)*BITS-1:0] result;
  logic [DELAY:0] later_q;
  logic [(DELAY+1)*BITS-1:0] result_q;
  assign result_valid = {later_q[DELAY-1:0], gather_valid && gather_last};
  assign result = {result_q[DELAY*BITS-1:0], gather_face};
  always_ff @(posedge clk_i) begin
    later_q  <= rst_i ? '0 : result_valid;
    result_q <= result;
  end

  fold #(
      .ITEM_WIDTH(ITEM - 1), .RESULT_WIDTH(BITS), .ITEMS(ITEMS), .FACE_ITEMS(FACE_ITEMS),
      .MARGIN(MARGIN)
  ) u_fold (
      .clk_i, .rst_i, .stall_o(stall), .item_valid_i(gather_valid), .item_last_i(gather_last),
      .item_i(gather_item[ITEM-2:0]), .result_valid_i(result_valid[DELAY]),
      .result_i(result[DELAY*BITS+:BITS]), .out_valid_o(fold_valid), .out_ready_i(fold_ready),
      .out_last_o(fold_last), .out_item_o(fold_item), .out_result_o(fold_result), .active_o(fold_active)
  );

  scatter #(
      .WIDTH(1), .ROW_BITS(1), .BANK_BITS(1), .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_scatter (
      .clk_i, .rst_i, .in_valid_i(fold_valid), .in_ready_o(fold_ready), .in_mask_i(fold_item[11:8]),
      .in_index_i(fold_item[7:0]), .in_data_i(4'd0), .en_o(word_en), .row_o(), .data_o(), .conflict_o(), .active_o(scatter_active)
  );

`ifdef HS_FORMAL
`include "loop.svh"
`endif

endmodule
