// SPDX-License-Identifier: Apache-2.0
//
// For a proof inside of a module: the first cycle is a reset.

  logic f_started = 1'b0;
  always_ff @(posedge clk_i) f_started <= 1'b1;
  always_comb if (!f_started) assume (rst_i);
