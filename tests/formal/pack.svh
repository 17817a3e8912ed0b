// SPDX-License-Identifier: Apache-2.0
//
// Proof for pack.sv, inside of it, whatever CRC it gets. Records are numbered, in their low bits, as they
// come: they leave each once and in order, the lowest lanes first, in beats that are full but for a packet's
// last; a packet ends with its END record and nowhere else; and a beat that is not taken stays.

`include "reset.svh"

  localparam int unsigned F_BITS = 6;  // of a number; none comes twice

  logic [F_BITS-1:0] f_in, f_out;
  logic [63:0] f_ends;  // END records among them

  // What the user owes.
  logic f_offered = 1'b0, f_last;
  logic [2:0] f_count;
  always_comb begin
    if (f_offered) assume (valid_i && count_i == f_count && last_i == f_last);
    assume (count_i <= 3'd4 && (count_i != 3'd0 || !last_i));
    for (int i = 0; i < 4; i++) assume (records_i[128*i+:F_BITS] == f_in + F_BITS'(i));
    assume (view_i == f_view || f_in == f_out);
  end

  logic [15:0] f_view;
  logic f_given;
  logic [2:0] f_records;
  logic [PORT_RECORDS-1:0] f_keep;
  assign f_given = m_axis_tvalid && m_axis_tready;
  for (genvar i = 0; i < PORT_RECORDS; i++) begin : f_lane
    assign f_keep[i] = m_axis_tkeep[16*i];
  end
  always_comb begin
    f_records = 3'd0;
    for (int i = 0; i < PORT_RECORDS; i++) f_records = f_records + 3'(f_keep[i]);
  end

  logic f_kept, f_kept_last, f_done, f_stepped = 1'b0;
  logic [PORT_RECORDS-1:0] f_kept_keep;
  always_ff @(posedge clk_i) begin
    f_offered <= valid_i && !ready_o && !rst_i;
    f_count   <= count_i;
    f_last    <= last_i;
    f_view    <= view_i;
    if (take) begin
      f_in <= f_in + F_BITS'(count_i);
      if (last_i) f_ends[f_in+F_BITS'(count_i)-F_BITS'(1)] <= 1'b1;
    end
    if (f_given) f_out <= f_out + F_BITS'(f_records);
    f_stepped   <= !rst_i;
    f_kept      <= m_axis_tvalid && !m_axis_tready;
    f_kept_keep <= f_keep;
    f_kept_last <= m_axis_tlast;
    f_done      <= f_given && m_axis_tlast;
    if (rst_i) begin
      f_in   <= '0;
      f_out  <= '0;
      f_ends <= '0;
    end
  end

  always_ff @(posedge clk_i)
    if (f_started && !rst_i) begin
      if (m_axis_tvalid) begin
        assert (f_keep != '0 && (f_keep & (f_keep + 1'b1)) == '0);
        assert (m_axis_tlast || &f_keep);
        assert (m_axis_tid == view_i);
        for (int i = 0; i < PORT_RECORDS; i++)
          if (f_keep[i]) begin
            assert (f_out + F_BITS'(i) != f_in);
            assert (m_axis_tdata[128*i+:F_BITS] == f_out + F_BITS'(i));
            assert (f_ends[f_out+F_BITS'(i)] == (m_axis_tlast && 3'(i + 1) == f_records));
          end else assert (m_axis_tdata[128*i+:F_BITS] == '0);
      end
      if (f_stepped && f_kept) assert (m_axis_tvalid && f_keep == f_kept_keep && m_axis_tlast == f_kept_last);
      if (f_stepped) assert (done_o == f_done);
      if (f_in - f_out <= F_BITS'(2) && !spilled_q) assert (ready_o);
    end
