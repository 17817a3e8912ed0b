// SPDX-License-Identifier: Apache-2.0
//
// Takes the beats of an AXI4-Stream packet apart into records of 128 bits, one a cycle.
//
//   * start_i allows one packet: no beat is taken before it, nor behind the packet's last beat
//     until the next one. It is legal when the packet before has ended.
//   * A record is at record_o whenever valid_o is set, for that cycle alone: the user takes it.
//   * end_o: the packet ends with this cycle, with the record at record_o or, if the last beat is
//     empty, without one.
//   * Record k of a beat is bits 128*k +: 128; TKEEP's bit 16*k says whether it is there. Records
//     are contiguous from record 0. Only the last beat may be partial; it may even be empty.
//   * view_o is the TID of the packet's first beat, and holds until the next one's.

module unpack #(
    // Records a beat: 1, 2 or 4.
    parameter int unsigned PORT_RECORDS = 4
) (
    input logic clk_i,
    input logic rst_i,

    input  logic                        s_axis_tvalid,
    output logic                        s_axis_tready,
    input  logic [128*PORT_RECORDS-1:0] s_axis_tdata,
    /* verilator lint_off UNUSEDSIGNAL */
    input  logic [ 16*PORT_RECORDS-1:0] s_axis_tkeep,   // a record's first bit stands for it
    /* verilator lint_on UNUSEDSIGNAL */
    input  logic                        s_axis_tlast,
    input  logic [                15:0] s_axis_tid,

    input  logic         start_i,
    output logic         valid_o,
    output logic [127:0] record_o,
    output logic         end_o,
    output logic [ 15:0] view_o
);

  generate
    if (PORT_RECORDS != 1 && PORT_RECORDS != 2 && PORT_RECORDS != 4) begin : gen_bad_port
      $error("unpack: PORT_RECORDS must be 1, 2 or 4");
    end
  endgenerate

  // One bit more than there are records: behind the last one there is none.
  logic [PORT_RECORDS:0] port_present;
  assign port_present[PORT_RECORDS] = 1'b0;
  genvar k;
  generate
    for (k = 0; k < PORT_RECORDS; k = k + 1) begin : gen_present
      assign port_present[k] = s_axis_tkeep[16*k];
    end
  endgenerate

  // The beat moves down one record a cycle; the next one is taken when at most one record is left.
  // TREADY so depends on registers alone.

  logic open_q;   // the packet's last beat was not taken yet
  logic first_q;  // nor was its first
  logic beat_valid_q, beat_last_q;
  logic [128*PORT_RECORDS-1:0] beat_q;
  logic [PORT_RECORDS:0] present_q;
  logic beat_done, take_beat;

  assign beat_done = beat_valid_q && !present_q[1];
  assign s_axis_tready = open_q && (!beat_valid_q || beat_done);
  assign take_beat = s_axis_tvalid && s_axis_tready;
  assign valid_o = beat_valid_q && present_q[0];
  assign record_o = beat_q[127:0];
  assign end_o = beat_done && beat_last_q;

  always_ff @(posedge clk_i) begin
    if (beat_valid_q) begin
      beat_q <= beat_q >> 128;
      present_q <= present_q >> 1;
      if (beat_done) beat_valid_q <= 1'b0;
    end
    if (take_beat) begin
      beat_valid_q <= 1'b1;
      beat_q <= s_axis_tdata;
      present_q <= port_present;
      beat_last_q <= s_axis_tlast;
      first_q <= 1'b0;
      if (first_q) view_o <= s_axis_tid;
      if (s_axis_tlast) open_q <= 1'b0;
    end
    if (start_i) begin
      open_q  <= 1'b1;
      first_q <= 1'b1;
    end
    if (rst_i) begin
      open_q <= 1'b0;
      beat_valid_q <= 1'b0;
    end
  end

  // --- What the sender and the user owe.

`ifndef YOSYS
  beat_stays :
  assert property (@(posedge clk_i) disable iff (rst_i)
      s_axis_tvalid && !s_axis_tready |=> s_axis_tvalid && $stable(s_axis_tkeep) && $stable(s_axis_tlast) && $stable(s_axis_tid))
  else $error("unpack: a beat changed before it was taken");
`ifdef HS_ASSERT_DATA
  beat_keeps :
  assert property (@(posedge clk_i) disable iff (rst_i)
      s_axis_tvalid && !s_axis_tready |=> $stable(s_axis_tdata))
  else $error("unpack: a beat's data changed before it was taken");
`endif
  records_contiguous :
  assert property (@(posedge clk_i) disable iff (rst_i)
      s_axis_tvalid |-> (port_present & (port_present + 1'b1)) == '0
      && (s_axis_tlast || port_present[PORT_RECORDS-1]))
  else $error("unpack: a beat has a hole, or is partial and not the last");
  start_between_packets :
  assert property (@(posedge clk_i) disable iff (rst_i) start_i |-> !open_q && !beat_valid_q)
  else $error("unpack: started within a packet");
`endif

`ifdef HS_FORMAL
`include "unpack.svh"
`endif

endmodule
