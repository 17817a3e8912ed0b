// SPDX-License-Identifier: Apache-2.0
//
// For proofs of modules that serve VIEWS pipelines in turn: one of them, whichever, is followed.

  (* anyconst *) logic [2:0] f_who;
  always_comb assume (32'(f_who) < VIEWS);
  logic [VIEWS-1:0] f_mine;
  assign f_mine = VIEWS'(1) << f_who;

  // p is behind the followed pipeline and not behind the latest one, in turn.
  function automatic logic f_between(input logic [VIEWS-1:0] latest_at, input logic [2:0] p);
    logic [3:0] latest;
    integer k;
    begin
      latest = '0;
      for (k = 0; k < VIEWS; k = k + 1) if (latest_at[k]) latest = 4'(k);
      f_between = (4'(p) + (p < f_who ? 4'(VIEWS) : 4'd0)) <=
          (latest + (latest < 4'(f_who) ? 4'(VIEWS) : 4'd0)) && latest != 4'(f_who);
    end
  endfunction
