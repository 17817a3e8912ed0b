// SPDX-License-Identifier: Apache-2.0
//
// Proof for deal.sv, inside of it: a beat goes to exactly one pipeline, in the cycle in which it is
// taken; the beats of a packet to the same one; and no pipeline is passed over for another twice.

`include "reset.svh"
`include "turns.svh"

  // Who has the packet that is open.
  logic [VIEWS-1:0] f_owner;
  logic f_within = 1'b0;

  // Packets that began elsewhere while the followed one was ready: each other pipeline has one at most.
  logic [VIEWS-1:0] f_passed = '0;
  logic f_gets;
  assign f_gets = in_valid_i && in_ready_o;

  always_ff @(posedge clk_i) begin
    if (f_gets) begin
      f_within <= !in_last_i;
      f_owner  <= out_valid_o;
    end
    if ((out_ready_i & f_mine) == '0 || (f_gets && (out_valid_o & f_mine) != '0)) f_passed <= '0;
    else if (f_gets && !f_within) f_passed <= f_passed | out_valid_o;
    if (rst_i) begin
      f_within <= 1'b0;
      f_passed <= '0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      assert ((out_valid_o & (out_valid_o - VIEWS'(1))) == '0);
      assert (at_q != '0 && (at_q & (at_q - VIEWS'(1))) == '0);
      assert (open_q == f_within);
      if (!in_valid_i) assert (out_valid_o == '0);
      if (f_gets) assert ((out_valid_o & out_ready_i) != '0);
      if (in_valid_i && !in_ready_o) assert ((out_valid_o & out_ready_i) == '0);
      if (in_valid_i && f_within) assert (out_valid_o == f_owner);
      if (f_within) assert (at_q == f_owner);
      if (!f_within && out_ready_i != '0) assert (in_ready_o);
      if (f_gets && !f_within && (out_ready_i & f_mine) != '0)
        assert ((out_valid_o & f_passed) == '0);
      // What makes that inductive: those that passed lie between the followed one and the latest.
      assert ((f_passed & f_mine) == '0);
      for (int p = 0; p < VIEWS; p++)
        if (f_passed[p]) assert (f_between(at_q, 3'(p)));
    end
