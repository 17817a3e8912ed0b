// SPDX-License-Identifier: Apache-2.0
//
// Reads up to four words of a banked memory for each item that passes.
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: its payload, a mask of the lanes
//     that want a word, and their word numbers. Items leave in order, out_valid_o for one cycle,
//     with the lanes' words; whoever takes them always takes them.
//   * Rate: an item a cycle if its lanes' banks differ; else as many cycles as the busiest bank has
//     lanes (conflict_o in each cycle beyond the first). Latency: 2 cycles from the one that took
//     it, and 1 for each conflict.
//   * stall_i: nothing is taken. At most 2 items still come out.
//   * The memory answers one cycle after rd_en_o. Writing a word that an item inside is about to
//     read is illegal but where the user shows which of the two words it gets.

module gather #(
    // Bits of the payload.
    parameter int unsigned ITEM_WIDTH = 8,
    // Bits of a memory word.
    parameter int unsigned WIDTH = 128,
    // Rows of a bank and banks, as powers of two.
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3
) (
    input logic clk_i,
    input logic rst_i,
    input logic stall_i,

    // items in
    input  logic                              in_valid_i,
    output logic                              in_ready_o,
    input  logic [            ITEM_WIDTH-1:0] in_item_i,
    input  logic [                       3:0] in_mask_i,
    input  logic [4*(ROW_BITS+BANK_BITS)-1:0] in_index_i,

    // memory
    output logic [         (1<<BANK_BITS)-1:0] rd_en_o,
    output logic [ROW_BITS*(1<<BANK_BITS)-1:0] rd_row_o,
    input  logic [   WIDTH*(1<<BANK_BITS)-1:0] rd_data_i,

    // items out
    output logic                  out_valid_o,
    output logic [ITEM_WIDTH-1:0] out_item_o,
    output logic [   4*WIDTH-1:0] out_data_o,

    output logic conflict_o,
    output logic active_o  // an item is inside
);

  localparam int unsigned IB = ROW_BITS + BANK_BITS;

  // --- Issue: one read a bank and cycle --------------------------------------------------------
  logic issue_valid_q;
  logic [ITEM_WIDTH-1:0] issue_item_q;
  logic [3:0] pending_q, grant;
  logic [4*IB-1:0] index_q;
  logic [4*BANK_BITS-1:0] bank;
  logic issued;

  for (genvar i = 0; i < 4; i++) begin : g_bank_of
    assign bank[i*BANK_BITS+:BANK_BITS] = index_q[i*IB+:BANK_BITS];
  end

  lanes #(
      .BANK_BITS(BANK_BITS)
  ) u_lanes (
      .pending_i(pending_q),
      .bank_i(bank),
      .grant_o(grant)
  );

  assign issued = (pending_q & ~grant) == 4'd0;
  assign conflict_o = issue_valid_q && !issued;
  assign in_ready_o = (!issue_valid_q || issued) && !stall_i;

  always_comb begin
    rd_en_o  = '0;
    rd_row_o = '0;
    for (int i = 0; i < 4; i++)
      if (issue_valid_q && grant[i]) begin
        rd_en_o[bank[i*BANK_BITS+:BANK_BITS]] = 1'b1;
        rd_row_o[32'(bank[i*BANK_BITS+:BANK_BITS])*ROW_BITS+:ROW_BITS] =
            index_q[i*IB+BANK_BITS+:ROW_BITS];
      end
  end

  always_ff @(posedge clk_i) begin
    if (in_valid_i && in_ready_o) begin
      issue_valid_q <= 1'b1;
      issue_item_q <= in_item_i;
      pending_q <= in_mask_i;
      index_q <= in_index_i;
    end else begin
      pending_q <= pending_q & ~grant;
      if (issued) issue_valid_q <= 1'b0;
    end
    if (rst_i) begin
      issue_valid_q <= 1'b0;
      pending_q <= 4'd0;
    end
  end

  // --- Collect: the words of a cycle's reads, kept until the item's last have come ---------------
  logic collect_valid_q, collect_last_q;
  logic [ITEM_WIDTH-1:0] collect_item_q;
  logic [3:0] arrives_q;
  logic [4*BANK_BITS-1:0] arrives_bank_q;
  logic [4*WIDTH-1:0] kept_q;

  always_ff @(posedge clk_i) begin
    collect_valid_q <= issue_valid_q;
    collect_last_q  <= issue_valid_q && issued;
    if (issue_valid_q) begin
      collect_item_q <= issue_item_q;
      arrives_q <= grant;
      arrives_bank_q <= bank;
    end
    if (collect_valid_q && !collect_last_q)
      for (int i = 0; i < 4; i++)
        if (arrives_q[i])
          kept_q[i*WIDTH+:WIDTH] <=
              rd_data_i[32'(arrives_bank_q[i*BANK_BITS+:BANK_BITS])*WIDTH+:WIDTH];
    if (rst_i) begin
      collect_valid_q <= 1'b0;
      collect_last_q  <= 1'b0;
    end
  end

  assign out_valid_o = collect_last_q;
  assign out_item_o  = collect_item_q;
  for (genvar i = 0; i < 4; i++) begin : g_word
    assign out_data_o[i*WIDTH+:WIDTH] = arrives_q[i] ?
        rd_data_i[32'(arrives_bank_q[i*BANK_BITS+:BANK_BITS])*WIDTH+:WIDTH] :
        kept_q[i*WIDTH+:WIDTH];
  end
  assign active_o = issue_valid_q || collect_valid_q;

endmodule
