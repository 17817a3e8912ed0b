// SPDX-License-Identifier: Apache-2.0
//
// Proof for counters.sv, inside of it: of the stages one, whichever, is followed. All that it did is
// counted and can be read, and busy + starved + blocked + idle = cycles: no cycle is lost or counted twice.

`include "reset.svh"

  localparam int unsigned F_WIDTH = $bits(cycles_o);

  (* anyconst *) logic [3:0] f_stage;
  always_comb assume (32'(f_stage) < STAGES);

  // What the stages owe: one activity a cycle.
  logic f_busy, f_starved, f_blocked, f_active;
  assign f_busy    = busy_i[f_stage];
  assign f_starved = starved_i[f_stage];
  assign f_blocked = blocked_i[f_stage];
  assign f_active  = f_busy || f_starved || f_blocked;
  always_comb assume (!(f_busy && f_starved) && !(f_busy && f_blocked) && !(f_starved && f_blocked));

  // What is expected: counts since reset, and those of the sampled cycle.
  logic [F_WIDTH-1:0] f_busies, f_starvings, f_blockings, f_idles, f_ins, f_outs, f_conflicts, f_sample_idles;
  logic [2*F_WIDTH-1:0] f_cycles, f_sample;
  logic f_still;  // not active since the sample

  always_ff @(posedge clk_i) begin
    f_cycles <= f_cycles + 1'b1;
    if (f_busy) f_busies <= f_busies + 1'b1;
    if (f_starved) f_starvings <= f_starvings + 1'b1;
    if (f_blocked) f_blockings <= f_blockings + 1'b1;
    if (!f_active) f_idles <= f_idles + 1'b1;
    f_ins       <= f_ins + F_WIDTH'(in_i[3*32'(f_stage)+:3]);
    f_outs      <= f_outs + F_WIDTH'(out_i[3*32'(f_stage)+:3]);
    f_conflicts <= f_conflicts + F_WIDTH'(conflict_i);
    f_still     <= (f_still || sample_i) && !f_active;
    if (sample_i) begin
      f_sample       <= f_cycles;
      f_sample_idles <= f_idles;
    end
    if (rst_i) begin
      f_cycles       <= '0;
      f_busies       <= '0;
      f_starvings    <= '0;
      f_blockings    <= '0;
      f_idles        <= '0;
      f_ins          <= '0;
      f_outs         <= '0;
      f_conflicts    <= '0;
      f_sample       <= '0;
      f_sample_idles <= '0;
      f_still        <= 1'b1;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert (f_busies + f_starvings + f_blockings + f_idles == f_cycles[F_WIDTH-1:0]);
      assert (cycles_o == f_cycles[F_WIDTH-1:0]);
      assert (cycles_high_o == f_sample[2*F_WIDTH-1:F_WIDTH]);
      assert (conflicts_o == f_conflicts);
      assert (known_o == (address_i[1:0] == 2'd0 && address_i[4:2] < 3'd6 && 32'(address_i[8:5]) < STAGES));
      if (!known_o) assert (data_o == '0);
      if (known_o && address_i[8:5] == f_stage)
        case (address_i[4:2])
          3'd0: assert (data_o == f_busies);
          3'd1: assert (data_o == f_starvings);
          3'd2: assert (data_o == f_blockings);
          3'd3: begin
            assert (f_busies + f_starvings + f_blockings + data_o == f_sample[F_WIDTH-1:0]);
            if (f_still) assert (data_o == f_sample_idles);
          end
          3'd4: assert (data_o == f_ins);
          3'd5: assert (data_o == f_outs);
          default: ;
        endcase
      // What makes that inductive.
      assert (busy_q[f_stage] == f_busies && starved_q[f_stage] == f_starvings);
      assert (blocked_q[f_stage] == f_blockings);
      assert (in_q[f_stage] == f_ins && out_q[f_stage] == f_outs);
      assert (cycles_q == f_cycles && sample_q == f_sample);
      if (f_still) assert (f_sample_idles + f_busies + f_starvings + f_blockings == f_sample[F_WIDTH-1:0]);
    end
