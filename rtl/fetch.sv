// SPDX-License-Identifier: Apache-2.0
//
// Walks over the items of a generation in order and over their faces: a face has one item, a quad,
// or, in generation 0, an item for each corner.
//
//   * start_i for one cycle, with count_i items (0 to 2^BITS). start_i while active_o is illegal.
//   * It reads ahead: rd_en_o, rd_item_o and rd_face_o name the next item and its face in the cycle
//     before valid_o shows them, so that a memory that answers one cycle later shows their words
//     beside valid_o. The words hold until ready_i takes the item. It does not read beyond the last item.
//   * last_i: the item that is shown is the last of its face (combinational from its words).
//   * Rate: an item a cycle. active_o: items remain.

module fetch #(
    // Width of an item's number.
    parameter int unsigned BITS = 19
) (
    input logic clk_i,
    input logic rst_i,

    input logic          start_i,
    input logic [BITS:0] count_i,

    output logic            rd_en_o,
    output logic [BITS-1:0] rd_item_o,
    output logic [BITS-1:0] rd_face_o,

    output logic            valid_o,
    input  logic            ready_i,
    input  logic            last_i,
    output logic [BITS-1:0] item_o,
    output logic [BITS-1:0] face_o,
    output logic            active_o
);

  logic [BITS:0] left_q;
  logic [BITS-1:0] item_q, face_q;
  logic take, step;

  assign valid_o = left_q != '0;
  assign active_o = valid_o;
  assign item_o = item_q;
  assign face_o = face_q;
  assign take = valid_o && ready_i;
  assign step = start_i || take;
  assign rd_en_o = start_i ? count_i != '0 : take && left_q != (BITS + 1)'(1);
  assign rd_item_o = start_i ? '0 : item_q + BITS'(1);
  assign rd_face_o = start_i ? '0 : last_i ? face_q + BITS'(1) : face_q;

  always_ff @(posedge clk_i) begin
    if (start_i) left_q <= count_i;
    else if (take) left_q <= left_q - (BITS + 1)'(1);
    if (step) begin
      item_q <= rd_item_o;
      face_q <= rd_face_o;
    end
    if (rst_i) left_q <= '0;
  end

`ifdef HS_FORMAL
`include "fetch.svh"
`endif

endmodule
