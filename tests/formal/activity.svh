// SPDX-License-Identifier: Apache-2.0
//
// Proof for a stage, inside of it, and whatever its parts do: in no cycle does it claim two activities, so
// that each is one of busy, starved, blocked and idle. An item enters only in a busy cycle.

`include "reset.svh"

  always_comb
    if (f_started) begin
      assert (!(busy_o && starved_o));
      assert (!(busy_o && blocked_o));
      assert (!(starved_o && blocked_o));
      if (!busy_o) assert (!item_in_o);
    end
