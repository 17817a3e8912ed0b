// SPDX-License-Identifier: Apache-2.0
//
// Adds what a face contributes to the rings of its vertices, beside accumulate and in lock-step with
// it: M is summed, corners are counted, nonquad is ORed. For limit positions, in every generation.
//
//   * An item is taken with in_valid_i, in the cycle in which accumulate takes its own with the same
//     mask and vertex numbers, and is written when accumulate's is. Whoever has no use for rings
//     keeps in_valid_i low: then nothing here moves, and the memory is not touched.
//   * update_i, touched_i: accumulate writes a word of the bank; its vertex was touched before in
//     this generation. One that was not starts from nothing.
//   * ring_void_o: the word that a bank gives now is not used.
//   * Addends are S(33.0): at most 6 positions, below 6 * 2^30 in magnitude.
//
// Memory: ring word {nonquad, count[7:0], M of w, z, y, x: S(41.0) each}; 255 addends are below
// 1530 * 2^30 < 2^41.

module ring #(
    // Width of a vertex number, and banks as a power of two.
    parameter int unsigned VW = 19,
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8 // words a cycle
) (
    input logic clk_i,
    input logic rst_i,

    input logic            in_valid_i,
    input logic [     3:0] in_mask_i,
    input logic [4*VW-1:0] in_index_i,
    input logic [ 4*136-1:0] in_addend_i,
    input logic            in_nonquad_i,

    // accumulate
    input logic [(1<<BANK_BITS)-1:0] update_i,
    input logic [(1<<BANK_BITS)-1:0] touched_i,

    output logic [              (1<<BANK_BITS)-1:0] ring_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] ring_rd_row_o,
    input  logic [          177*(1<<BANK_BITS)-1:0] ring_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] ring_void_o,
    output logic [              (1<<BANK_BITS)-1:0] ring_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] ring_wr_row_o,
    output logic [          177*(1<<BANK_BITS)-1:0] ring_wr_data_o
);

  localparam int unsigned ROW_BITS = VW - BANK_BITS;
  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned WORD = 137;  // {nonquad, addends of w, z, y, x}

  logic [4*WORD-1:0] word;
  logic [BANKS-1:0] en;
  logic [BANKS*ROW_BITS-1:0] row;
  logic [BANKS*WORD-1:0] data;
  /* verilator lint_off UNUSEDSIGNAL */
  logic ready;  // as accumulate's
  /* verilator lint_on UNUSEDSIGNAL */

  always_comb begin
    word = '0;
    if (in_valid_i)
      for (int i = 0; i < 4; i++)
        word[i*WORD+:WORD] = {in_nonquad_i, in_addend_i[i*136+:136]};
  end

  /* verilator lint_off PINCONNECTEMPTY */
  scatter #(
      .WIDTH(WORD),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_scatter (
      .clk_i,
      .rst_i,
      .in_valid_i,
      .in_ready_o(ready),
      .in_mask_i,
      .in_index_i,
      .in_data_i(word),
      .en_o(en),
      .row_o(row),
      .data_o(data),
      .conflict_o(),  // accumulate counts them
      .active_o()
  );
  /* verilator lint_on PINCONNECTEMPTY */

  assign ring_rd_en_o  = en;
  assign ring_rd_row_o = row;

  // --- Per bank: the word read, plus the lane's, written back -------------------------------------
  logic [BANKS-1:0] update_q;

  for (genvar b = 0; b < BANKS; b++) begin : g_bank
    logic [ROW_BITS-1:0] row_q, written_row_q;
    logic [WORD-1:0] data_q;
    logic written_q, forward;
    logic [176:0] old_ring, new_ring, written_ring_q;

    assign forward = written_q && written_row_q == row_q;
    assign old_ring = !touched_i[b] ? 177'd0 : forward ? written_ring_q : ring_rd_data_i[b*177+:177];
    assign ring_void_o[b] = update_q[b] && (!touched_i[b] || forward);

    always_comb begin
      new_ring = '0;
      if (update_q[b]) begin
        new_ring[176] = old_ring[176] || data_q[136];
        new_ring[175:168] = old_ring[175:168] + 8'd1;
        for (int k = 0; k < 4; k++)
          new_ring[k*42+:42] = old_ring[k*42+:42] + {{8{data_q[k*34+33]}}, data_q[k*34+:34]};
      end
    end

    always_ff @(posedge clk_i) begin
      update_q[b] <= en[b];
      written_q   <= update_q[b];
      if (en[b]) begin
        row_q  <= row[b*ROW_BITS+:ROW_BITS];
        data_q <= data[b*WORD+:WORD];
      end
      if (update_q[b]) begin
        written_row_q  <= row_q;
        written_ring_q <= new_ring;
      end
      if (rst_i) begin
        update_q[b] <= 1'b0;
        written_q   <= 1'b0;
      end
    end

    assign ring_wr_en_o[b] = update_q[b];
    assign ring_wr_row_o[b*ROW_BITS+:ROW_BITS] = update_q[b] ? row_q : '0;
    assign ring_wr_data_o[b*177+:177] = new_ring;
  end

`ifndef YOSYS
  in_lock_step :
  assert property (@(posedge clk_i) disable iff (rst_i)
      (update_q == '0 || update_q == update_i) && (!in_valid_i || ready))
  else $error("ring: out of step with accumulate");
`endif

endmodule
