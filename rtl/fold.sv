// SPDX-License-Identifier: Apache-2.0
//
// Holds the items of a face until what follows from all of them together is known, then lets them
// pass with it.
//
//   items   ----> [ FIFO ] ----+--> item, its face's result      A face has one item, a quad, or,
//   results ----> [ FIFO ] ----+    one item a cycle             in generation 0, one a corner.
//
//   * Each face's last item is marked; each face has one result, in the order of the faces. Items
//     may come long before the result or after it.
//   * Neither input is ever refused. stall_o asks the source of items to stop: it may send MARGIN
//     more. ITEMS - MARGIN must exceed FACE_ITEMS, so that a whole face gets in.
//   * out_valid_o: the oldest item and its face's result are there; out_ready_i takes the item.

module fold #(
    // Bits of an item and of a result.
    parameter int unsigned ITEM_WIDTH = 8,
    parameter int unsigned RESULT_WIDTH = 8,
    // Items held; a power of two.
    parameter int unsigned ITEMS = 512,
    // Items of a face at most.
    parameter int unsigned FACE_ITEMS = 255,
    // Items that may still come when stall_o goes high.
    parameter int unsigned MARGIN = 32,
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,
    output logic stall_o,

    input logic                  item_valid_i,
    input logic                  item_last_i,
    input logic [ITEM_WIDTH-1:0] item_i,

    input logic                    result_valid_i,
    input logic [RESULT_WIDTH-1:0] result_i,

    output logic                    out_valid_o,
    input  logic                    out_ready_i,
    output logic                    out_last_o,
    output logic [  ITEM_WIDTH-1:0] out_item_o,
    output logic [RESULT_WIDTH-1:0] out_result_o,

    output logic active_o,  // an item is inside
    output logic fault_o
);

  generate
    if (ITEMS <= FACE_ITEMS + MARGIN) begin : gen_bad_items
      $error("fold: ITEMS must exceed a face's items and MARGIN");
    end
  endgenerate

  localparam int unsigned LEVEL_BITS = $clog2(ITEMS) + 1;

  logic item_there, result_there, take;
  logic items_fault, results_fault;
  logic [LEVEL_BITS-1:0] level;

  // As many results as items: in generations of quads there are.
  /* verilator lint_off PINCONNECTEMPTY */
  fifo #(
      .WIDTH(ITEM_WIDTH + 1),
      .DEPTH(ITEMS), .PARITY(PARITY)
  ) u_items (
      .fault_o(items_fault),
      .clk_i,
      .rst_i,
      .in_valid_i(item_valid_i),
      .in_ready_o(),  // stall_o keeps it high
      .in_data_i({item_last_i, item_i}),
      .out_valid_o(item_there),
      .out_ready_i(take),
      .out_data_o({out_last_o, out_item_o}),
      .level_o(level)
  );

  fifo #(
      .WIDTH(RESULT_WIDTH),
      .DEPTH(ITEMS), .PARITY(PARITY)
  ) u_results (
      .fault_o(results_fault),
      .clk_i,
      .rst_i,
      .in_valid_i(result_valid_i),
      .in_ready_o(),  // there are no more results than items
      .in_data_i(result_i),
      .out_valid_o(result_there),
      .out_ready_i(take && out_last_o),
      .out_data_o(out_result_o),
      .level_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign out_valid_o = item_there && result_there;
  assign take = out_valid_o && out_ready_i;
  assign stall_o = level > LEVEL_BITS'(ITEMS - MARGIN);
  assign active_o = item_there;

  assign fault_o = items_fault || results_fault;
`ifndef YOSYS
  items_fit :
  assert property (@(posedge clk_i) disable iff (rst_i) item_valid_i |-> level < LEVEL_BITS'(ITEMS))
  else $error("fold: an item came although it was told to stop");
`endif

`ifdef HS_FORMAL
`include "fold.svh"
`endif

endmodule
