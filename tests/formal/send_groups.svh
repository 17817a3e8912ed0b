// SPDX-License-Identifier: Apache-2.0
//
// Proof for send_groups.sv, inside of it. The module never looks at a vertex, so numbering them as they
// come shows what happens to any: they leave as they came, each once and in order, in groups of four or,
// behind the last group, singly; and when nothing is active, all have left.

`include "reset.svh"

  logic [VW-1:0] f_in, f_out;
  logic [4:0] f_late;  // came since stall_o went up

  // What the user owes.
  always_comb begin
    assume (count_i <= 3'd4);
    if (stall_o) assume (f_late + 5'(count_i) <= 5'd12);
    if (end_i) assume (count_i == 3'd0);
    for (int i = 0; i < 4; i++) assume (lanes_i[i*WORD+(WORD-VW)+:VW] == f_in + VW'(i));
  end

  logic f_group, f_single, f_stepped = 1'b0, f_group_kept, f_single_kept;
  assign f_group  = group_valid_o && group_ready_i;
  assign f_single = single_valid_o && single_ready_i;

  always_ff @(posedge clk_i) begin
    f_in   <= f_in + VW'(count_i);
    f_out  <= f_out + (f_group ? VW'(4) : VW'(0)) + VW'(f_single);
    f_late <= stall_o ? f_late + 5'(count_i) : 5'd0;
    f_stepped <= !rst_i;
    f_group_kept <= group_valid_o && !group_ready_i;
    if (rst_i) begin
      f_in   <= '0;
      f_out  <= '0;
      f_late <= '0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      if (group_valid_o)
        for (int i = 0; i < 4; i++) assert (group_vertex_o[i*VW+:VW] == f_out + VW'(i));
      if (single_valid_o) assert (single_vertex_o == f_out && !group_valid_o && end_i);
      if (f_stepped && f_group_kept) assert (group_valid_o);
      if (count_q != 3'd0 && full) assert (32'(level) < GROUPS);
      if (!active_o) assert (f_in == f_out);
      if (end_i && f_in != f_out && count_q == 3'd0) assert (group_valid_o || single_valid_o);
    end
