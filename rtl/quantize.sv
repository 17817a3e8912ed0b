// SPDX-License-Identifier: Apache-2.0
//
// quantize: turns the view's vertices, in place, from binary32 into the block's fixed point.
//
// * Start: start_i for one cycle, with count_i (vertices, 0 to 2^VW) and magnitude_i (the largest
//   |component| of all of them: a finite binary32 without its sign). start_i before done_o is
//   illegal.
// * exponent_o: E, the smallest exponent with |component| < 2^E, -148 to 128, or 0 if all are
//   zero. It changes in the cycle after start_i and holds until the next start_i.
// * The vertex memory: rd_data_i belongs to the rd_index_o of the cycle before; wr_* write in the
//   same cycle. A record is x in bits 31:0, then y, z, w. Each component c becomes
//   RNE(c * 2^(30-E)). Vertex 0 comes first, each vertex once, one a cycle.
//
//     cycle      0        1      2      3      ...  n      n+1    n+2
//     start_i    |
//     read                v0     v1     v2          v(n-1)
//     convert                    v0     v1     ...         v(n-1)
//     write                             v0     ...                v(n-1)
//     done_o                                                      |
//
// * done_o: in cycle n+2 after start_i, that is, with the last write; also for n = 0.
// * Activity: busy_o in the n cycles that read, starved_o in the two that follow, idle otherwise.
//   No stalls: blocked_o is never high.
module quantize #(
    // Width of a vertex number.
    parameter int VW = 19
) (
    input logic clk_i,
    input logic rst_i,

    input  logic               start_i,
    input  logic        [VW:0] count_i,
    input  logic        [30:0] magnitude_i,
    output logic signed [ 9:0] exponent_o,
    output logic               done_o,

    // vertex memory
    output logic          rd_en_o,
    output logic [VW-1:0] rd_index_o,
    input  logic [ 127:0] rd_data_i,
    output logic          wr_en_o,
    output logic [VW-1:0] wr_index_o,
    output logic [ 127:0] wr_data_o,

    // counters
    output logic busy_o,
    output logic starved_o,
    output logic blocked_o,
    output logic item_in_o,
    output logic item_out_o
);
  // ---- the block's exponent ---------------------------------------------------------------------
  // E = 1 + floor(log2 |c|). A normal number's field is floor(log2 |c|) + 127; a subnormal's
  // leading one at bit k is worth 2^(k-149).
  function automatic logic signed [9:0] block_exponent(input logic [30:0] magnitude);
    logic [22:0] fraction;
    logic signed [9:0] e;
    fraction = magnitude[22:0];
    e = -10'sd126;  // of a leading one at bit 22
    if (fraction[22:7] == 16'd0) begin
      fraction = fraction << 16;
      e = e - 10'sd16;
    end
    if (fraction[22:15] == 8'd0) begin
      fraction = fraction << 8;
      e = e - 10'sd8;
    end
    if (fraction[22:19] == 4'd0) begin
      fraction = fraction << 4;
      e = e - 10'sd4;
    end
    if (fraction[22:21] == 2'd0) begin
      fraction = fraction << 2;
      e = e - 10'sd2;
    end
    if (!fraction[22]) e = e - 10'sd1;
    if (magnitude == 31'd0) block_exponent = 10'sd0;
    else if (magnitude[30:23] == 8'd0) block_exponent = e;
    else block_exponent = $signed({2'd0, magnitude[30:23]}) - 10'sd126;
  endfunction

  always_ff @(posedge clk_i) begin
    if (rst_i) exponent_o <= '0;
    else if (start_i) exponent_o <= block_exponent(magnitude_i);
  end

  // ---- read -------------------------------------------------------------------------------------
  logic reading_q;
  logic [VW:0] next_q;
  logic [VW:0] count_q;
  logic last;

  assign last       = reading_q && next_q + 1'b1 == count_q;
  assign rd_en_o    = reading_q;
  assign rd_index_o = next_q[VW-1:0];

  always_ff @(posedge clk_i) begin
    if (rst_i) reading_q <= 1'b0;
    else if (start_i) reading_q <= count_i != '0;
    else if (last) reading_q <= 1'b0;
    if (start_i) begin
      next_q  <= '0;
      count_q <= count_i;
    end else if (reading_q) next_q <= next_q + 1'b1;
  end

  // ---- convert, write ---------------------------------------------------------------------------
  logic converting_q, last_converting_q;
  logic [VW-1:0] converting_index_q;

  for (genvar k = 0; k < 4; k++) begin : g_component
    to_fixed i_to_fixed (
        .clk_i,
        .valid_i   (converting_q),
        .c_i       (rd_data_i[32*k+:32]),
        .exponent_i(exponent_o),
        .q_o       (wr_data_o[32*k+:32])
    );
  end

  always_ff @(posedge clk_i) begin
    converting_q       <= reading_q && !rst_i;
    last_converting_q  <= (last || (start_i && count_i == '0)) && !rst_i;
    converting_index_q <= next_q[VW-1:0];
    wr_en_o            <= converting_q && !rst_i;
    wr_index_o         <= converting_index_q;
    done_o             <= last_converting_q && !rst_i;
  end

  // ---- counters ---------------------------------------------------------------------------------
  assign busy_o     = reading_q;
  assign starved_o  = !reading_q && (last_converting_q || done_o);
  assign blocked_o  = 1'b0;
  assign item_in_o  = reading_q;
  assign item_out_o = wr_en_o;

`ifdef HS_FORMAL
`include "activity.svh"
`endif

endmodule
