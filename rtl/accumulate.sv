// SPDX-License-Identifier: Apache-2.0
//
// Adds what a face contributes to its vertices: marks are ORed, positions summed, corners counted.
//
//   * An item is taken in a cycle with in_valid_i and in_ready_o: up to four lanes, each a vertex
//     number, marks (front, back, hits, border) and four addends, S(32.0).
//   * A vertex that no item of this generation touched before starts from nothing: its mark word's
//     tag is not generation_i. Nothing is ever cleared.
//   * sum_i: sums and counts are kept too; without it the sum memory is not touched.
//   * Rate: as scatter's. Written in the cycle behind the bank's read; a vertex may be touched in
//     every cycle: the word just written is forwarded.
//   * touched_o: the vertex of the word that a bank gets now was touched before; with update_o.
//   * sum_void_o: the sum that a bank gives now is not used.
//   * full_o: a vertex got its 256th corner, the only lane of the item that was tagged full_item_o.
//     Only for generation 0; its count stays void.
//   * active_o: something is not yet written.
//
// Memories: mark word {tag[7:0], sent, border, hits, back, front}, sent is kept as it is; sum word
// {count[7:0], T of w, z, y, x: S(39.0) each}.

module accumulate #(
    // Width of a vertex number, and banks as a power of two.
    parameter int unsigned VW = 19,
    parameter int unsigned BANK_BITS = 3,
    parameter int unsigned WINDOW_BITS = 3, // items that compete for banks
    parameter int unsigned LANES = 8, // words a cycle
    // Bits of the tag that goes along with an item.
    parameter int unsigned TAG_WIDTH = 19
) (
    input logic clk_i,
    input logic rst_i,

    input logic [7:0] generation_i,
    input logic       sum_i,

    input  logic                 in_valid_i,
    output logic                 in_ready_o,
    input  logic [          3:0] in_mask_i,
    input  logic [     4*VW-1:0] in_index_i,
    input  logic [         15:0] in_marks_i,
    input  logic [    4*132-1:0] in_addend_i,
    input  logic [TAG_WIDTH-1:0] in_tag_i,

    output logic [              (1<<BANK_BITS)-1:0] mark_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_rd_row_o,
    input  logic [           13*(1<<BANK_BITS)-1:0] mark_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] mark_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] mark_wr_row_o,
    output logic [           13*(1<<BANK_BITS)-1:0] mark_wr_data_o,

    output logic [              (1<<BANK_BITS)-1:0] sum_rd_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] sum_rd_row_o,
    input  logic [          168*(1<<BANK_BITS)-1:0] sum_rd_data_i,
    output logic [              (1<<BANK_BITS)-1:0] sum_wr_en_o,
    output logic [(VW-BANK_BITS)*(1<<BANK_BITS)-1:0] sum_wr_row_o,
    output logic [          168*(1<<BANK_BITS)-1:0] sum_wr_data_o,

    output logic [(1<<BANK_BITS)-1:0] update_o,
    output logic [(1<<BANK_BITS)-1:0] touched_o,
    output logic [(1<<BANK_BITS)-1:0] sum_void_o,

    output logic                 full_o,
    output logic [TAG_WIDTH-1:0] full_item_o,
    output logic                 conflict_o,
    output logic                 active_o
);

  localparam int unsigned ROW_BITS = VW - BANK_BITS;
  localparam int unsigned BANKS = 1 << BANK_BITS;
  localparam int unsigned WORD = 136;  // {addends of w, z, y, x; marks}

  logic [4*WORD-1:0] word;
  logic [BANKS-1:0] en;
  logic [BANKS*ROW_BITS-1:0] row;
  logic [BANKS*WORD-1:0] data;
  logic scatter_active;

  for (genvar i = 0; i < 4; i++) begin : g_word
    assign word[i*WORD+:WORD] = {in_addend_i[i*132+:132], in_marks_i[i*4+:4]};
  end

  scatter #(
      .WIDTH(WORD),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .WINDOW_BITS(WINDOW_BITS), .LANES(LANES)
  ) u_scatter (
      .clk_i,
      .rst_i,
      .in_valid_i,
      .in_ready_o,
      .in_mask_i,
      .in_index_i,
      .in_data_i(word),
      .en_o(en),
      .row_o(row),
      .data_o(data),
      .conflict_o,
      .active_o(scatter_active)
  );

  assign mark_rd_en_o  = en;
  assign mark_rd_row_o = row;
  assign sum_rd_en_o   = sum_i ? en : '0;
  assign sum_rd_row_o  = sum_i ? row : '0;

  // --- Per bank: the word read, plus the lane's, written back -------------------------------------
  logic [BANKS-1:0] update_q, full;

  for (genvar b = 0; b < BANKS; b++) begin : g_bank
    logic [ROW_BITS-1:0] row_q, written_row_q;
    logic [WORD-1:0] data_q;
    logic written_q;
    logic [12:0] old_mark, new_mark, written_mark_q;
    logic [167:0] old_sum, new_sum, written_sum_q;
    logic touched, forward;

    assign forward  = written_q && written_row_q == row_q;
    assign old_mark = forward ? written_mark_q : mark_rd_data_i[b*13+:13];
    assign touched  = old_mark[12:5] == generation_i;
    assign new_mark = {generation_i, old_mark[4],
                       data_q[3:0] | (touched ? old_mark[3:0] : 4'd0)};
    assign full[b]  = update_q[b] && touched && old_sum[167:160] == 8'd255;

    always_comb begin
      old_sum = '0;
      new_sum = '0;
      if (update_q[b] && sum_i) begin
        old_sum = forward ? written_sum_q : sum_rd_data_i[b*168+:168];
        new_sum[167:160] = touched ? old_sum[167:160] + 8'd1 : 8'd1;
        for (int k = 0; k < 4; k++)
          new_sum[k*40+:40] = (touched ? old_sum[k*40+:40] : 40'd0) +
              {{7{data_q[4+k*33+32]}}, data_q[4+k*33+:33]};
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
        written_mark_q <= new_mark;
        written_sum_q  <= new_sum;
      end
      if (rst_i) begin
        update_q[b] <= 1'b0;
        written_q   <= 1'b0;
      end
    end

    assign touched_o[b] = touched;
    assign sum_void_o[b] = sum_i && update_q[b] && (!touched || forward);
    assign mark_wr_en_o[b] = update_q[b];
    assign mark_wr_row_o[b*ROW_BITS+:ROW_BITS] = update_q[b] ? row_q : '0;
    assign mark_wr_data_o[b*13+:13] = update_q[b] ? new_mark : '0;
    assign sum_wr_en_o[b] = update_q[b] && sum_i;
    assign sum_wr_row_o[b*ROW_BITS+:ROW_BITS] = update_q[b] && sum_i ? row_q : '0;
    assign sum_wr_data_o[b*168+:168] = new_sum;
  end

  // --- The item whose lane is being updated; it has one lane where it matters ----------------------
  logic [TAG_WIDTH-1:0] tag_1, tag_2;

  always_ff @(posedge clk_i) begin
    if (in_valid_i && in_ready_o) tag_1 <= in_tag_i;
    tag_2 <= tag_1;
  end
  assign update_o = update_q;
  assign full_o = |full && sum_i;
  assign full_item_o = tag_2;
  assign active_o = scatter_active || update_q != '0;

endmodule
