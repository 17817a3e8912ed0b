// SPDX-License-Identifier: Apache-2.0
//
// Proof for split.sv, inside of it: its activity, as of all stages. What the user owes for it: pass_i holds
// from a start until all is done.

`include "activity.svh"

  logic f_pass;
  always_ff @(posedge clk_i) if (start_i) f_pass <= pass_i;
  always_comb if (f_started && fetch_active) assume (pass_i == f_pass);
  always_comb if (f_started && fetch_active) assert (!f_pass);
