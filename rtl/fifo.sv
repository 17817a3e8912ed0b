// SPDX-License-Identifier: Apache-2.0
//
// A synchronous FIFO with valid/ready on both sides.
//
//   * A word is taken in a cycle with in_valid_i and in_ready_o, given in one with out_valid_o and
//     out_ready_i. Order is kept.
//   * First-word fall-through: out_data_o is the oldest word whenever out_valid_o is set. A word
//     shows at the output in the cycle after the one that took it, not earlier: no path leads from
//     the input side to the output side or back, so chains of these close no loop.
//   * A full FIFO takes nothing, even in a cycle in which it gives a word.
//   * Once in_valid_i is set it must stay, with its data, until the word is taken (as in AXI).
//   * With PARITY every word has a bit more, so that its ones are even. fault_o, a cycle behind the one
//     that gave the word: they were not.

module fifo #(
    // Bits of a word, 1 or more.
    parameter int unsigned WIDTH = 32,
    // Words held; a power of two, 2 or more.
    parameter int unsigned DEPTH = 16,
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,  // synchronous: empties the FIFO

    input  logic             in_valid_i,
    output logic             in_ready_o,
    input  logic [WIDTH-1:0] in_data_i,

    output logic             out_valid_o,
    input  logic             out_ready_i,
    output logic [WIDTH-1:0] out_data_o,

    output logic [$clog2(DEPTH):0] level_o,  // words held, 0 to DEPTH
    output logic                   fault_o
);

  localparam int unsigned INDEX_BITS = $clog2(DEPTH);

  generate
    if (WIDTH < 1) begin : gen_bad_width
      $error("fifo: WIDTH must be 1 or more");
    end
    if (DEPTH < 2 || (DEPTH & (DEPTH - 1)) != 0) begin : gen_bad_depth
      $error("fifo: DEPTH must be a power of two, 2 or more");
    end
  endgenerate

  // Reading and writing place, each with one bit more than it needs: equal means empty, different
  // in that bit alone means full.
  logic [INDEX_BITS:0] read_q, write_q;
  localparam int unsigned BITS = WIDTH + 32'(PARITY);
  logic [BITS-1:0] storage_q[0:DEPTH-1];
  logic [BITS-1:0] oldest;
  logic take, give;

  assign level_o = write_q - read_q;
  assign in_ready_o = !level_o[INDEX_BITS];
  assign out_valid_o = write_q != read_q;
  assign oldest = storage_q[read_q[INDEX_BITS-1:0]];
  assign out_data_o = oldest[WIDTH-1:0];
  assign take = in_valid_i && in_ready_o;
  assign give = out_valid_o && out_ready_i;

  always_ff @(posedge clk_i) begin
    if (take) begin
      storage_q[write_q[INDEX_BITS-1:0]] <= BITS'({^in_data_i, in_data_i});
      write_q <= write_q + 1'b1;
    end
    if (give) read_q <= read_q + 1'b1;
    if (rst_i) begin
      read_q  <= '0;
      write_q <= '0;
    end
  end

  logic fault_q;

  always_ff @(posedge clk_i) begin
    fault_q <= 1'b0;
    if (PARITY && give && !rst_i) fault_q <= ^oldest;
  end
  assign fault_o = fault_q;

`ifndef YOSYS
  // What the user owes: a word that was offered and not taken is offered again.
  offer_stays :
  assert property (@(posedge clk_i) disable iff (rst_i)
      in_valid_i && !in_ready_o |=> in_valid_i)
  else $error("fifo: a word was withdrawn before it was taken");
`ifdef HS_ASSERT_DATA
  offer_keeps :
  assert property (@(posedge clk_i) disable iff (rst_i)
      in_valid_i && !in_ready_o |=> $stable(in_data_i))
  else $error("fifo: a word changed before it was taken");
`endif
  // What the FIFO owes: a word stays until it is given, and there are never too many.
  word_stays :
  assert property (@(posedge clk_i) disable iff (rst_i)
      out_valid_o && !out_ready_i |=> out_valid_o)
  else $error("fifo: the output fell before it was given");
`ifdef HS_ASSERT_DATA
  word_keeps :
  assert property (@(posedge clk_i) disable iff (rst_i)
      out_valid_o && !out_ready_i |=> $stable(out_data_o))
  else $error("fifo: the output changed before it was given");
`endif
  level_holds :
  assert property (@(posedge clk_i) disable iff (rst_i)
      32'(level_o) <= DEPTH)
  else $error("fifo: holds more words than it has room for");
`endif

`ifdef HS_FORMAL
`include "fifo.svh"
`endif

endmodule
