// SPDX-License-Identifier: Apache-2.0
//
// Proof for banked_memory.sv, inside of it: one word, whichever, is followed. What a read of it shows in
// the next cycle, and until the next read of its bank, is what was written to it before, and not what
// is written in the cycle of the read; and it has no fault.

  (* anyconst *) logic [3:0] f_bank;
  (* anyconst *) logic [ROW_BITS-1:0] f_row;
  always_comb assume (32'(f_bank) < 1 << BANK_BITS);

  logic f_written = 1'b0, f_shown = 1'b0, f_both = 1'b0;
  logic [WIDTH-1:0] f_word, f_shows;
  logic f_reads, f_writes;

  assign f_reads = rd_en_i[f_bank] && rd_row_i[ROW_BITS*32'(f_bank)+:ROW_BITS] == f_row;
  assign f_writes = wr_en_i[f_bank] && wr_row_i[ROW_BITS*32'(f_bank)+:ROW_BITS] == f_row;

  // Only this word is looked at.
  logic f_looked = 1'b0;
  always_comb assume (check_i == '0 || (f_shown && check_i == BANKS'(1) << f_bank));

  always_ff @(posedge clk_i) begin
    f_looked <= 1'b1;
    f_both <= f_reads && f_writes && f_written;
    if (f_writes) begin
      f_written <= 1'b1;
      f_word    <= wr_data_i[WIDTH*32'(f_bank)+:WIDTH];
    end
    if (rd_en_i[f_bank]) begin
      f_shown <= f_reads && f_written;
      f_shows <= f_word;
    end
    if (f_shown) assert (rd_data_o[WIDTH*32'(f_bank)+:WIDTH] == f_shows);
    if (f_looked) assert (!fault_o);
    cover (f_both && f_shows != f_word);
  end

  // What makes that inductive.
  for (genvar b = 0; b < (1 << BANK_BITS); b++) begin : f_banks
    always_ff @(posedge clk_i)
      if (32'(f_bank) == b) begin
        if (f_written) assert (g_bank[b].word_q[f_row] == BITS'({^f_word, f_word}));
        if (f_shown) assert (g_bank[b].data_q == BITS'({^f_shows, f_shows}));
      end
  end
