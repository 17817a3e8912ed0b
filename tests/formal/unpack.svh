// SPDX-License-Identifier: Apache-2.0
//
// Proof for unpack.sv, inside of it: one record of one beat, whichever, is followed. As many records come
// out as the beats of a packet have, each once, in order and as it came; a packet that was started ends
// once, with its last record; and nothing is taken before a start or behind a packet's last beat.

`include "reset.svh"

  localparam int unsigned F_RECORD = $bits(record_o);

  // What the sender and the user owe.
  always_comb if (f_started && !rst_i) begin
    if (s_axis_tvalid) assume ((port_present & (port_present + 1'b1)) == '0);
    if (s_axis_tvalid && !s_axis_tlast) assume (port_present[PORT_RECORDS-1]);
    if (start_i) assume (!f_open && f_level == '0 && !f_ending);
  end

  (* anyseq *) logic f_choose;
  (* anyconst *) logic [1:0] f_lane;
  logic [2:0] f_level, f_enter, f_ahead;  // records inside; in this beat; before the followed one
  logic f_open = 1'b0, f_first, f_ending = 1'b0, f_inside = 1'b0, f_chosen;
  logic [F_RECORD-1:0] f_record;
  logic [15:0] f_view;

  assign f_chosen = take_beat && f_choose && !f_inside && 32'(f_lane) < PORT_RECORDS && port_present[f_lane];
  always_comb begin
    f_enter = 3'd0;
    for (int i = 0; i < PORT_RECORDS; i++) f_enter = f_enter + 3'(port_present[i]);
  end

  always_ff @(posedge clk_i) begin
    f_level <= f_level - 3'(valid_o) + (take_beat ? f_enter : 3'd0);
    if (f_inside && valid_o) begin
      f_ahead <= f_ahead - 3'd1;
      if (f_ahead == '0) f_inside <= 1'b0;
    end
    if (f_chosen) begin
      f_inside <= 1'b1;
      f_record <= s_axis_tdata[F_RECORD*32'(f_lane)+:F_RECORD];
      f_ahead  <= f_level - 3'(valid_o) + 3'(f_lane);
    end
    if (end_o) f_ending <= 1'b0;
    if (take_beat) begin
      f_first <= 1'b0;
      if (f_first) f_view <= s_axis_tid;
      if (s_axis_tlast) begin
        f_open   <= 1'b0;
        f_ending <= 1'b1;
      end
    end
    if (start_i) begin
      f_open  <= 1'b1;
      f_first <= 1'b1;
    end
    if (rst_i) begin
      f_open   <= 1'b0;
      f_ending <= 1'b0;
      f_level  <= '0;
      f_inside <= 1'b0;
    end
  end

  // A packet that was started has shown its view, from its first record on.
  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      if (s_axis_tready) assert (f_open);
      if (f_open && f_level <= 3'd1) assert (s_axis_tready);
      assert (valid_o == (f_level != '0));
      if (f_inside) assert (f_ahead < f_level);
      if (f_inside && f_ahead == '0) assert (valid_o && record_o == f_record);
      assert (end_o == (f_ending && f_level <= 3'd1));
      if (valid_o || end_o) assert (view_o == f_view);

      // What makes that inductive.
      assert (open_q == f_open && !(f_open && f_ending));
      if (f_open) assert (first_q == f_first);
      if (f_open && f_first) assert (f_level == '0);
      if (!f_open && !f_ending) assert (!beat_valid_q);
      if (f_ending || (f_open && beat_valid_q)) assert (view_o == f_view && beat_valid_q && !(f_open && f_first));
      if (beat_valid_q) assert (beat_last_q == f_ending);
      assert (32'(f_level) <= PORT_RECORDS);
      if (!beat_valid_q) assert (f_level == '0);
      if (beat_valid_q)
        for (int i = 0; i <= PORT_RECORDS; i++) assert (present_q[i] == (3'(i) < f_level));
      if (f_inside) assert (beat_q[F_RECORD*32'(f_ahead)+:F_RECORD] == f_record);
    end
