// SPDX-License-Identifier: Apache-2.0
//
// Packs records into the beats of the output stream, without gaps, and closes a packet with its
// CRC-32.
//
//   records -> assemble (rows of 4) -> queue of 2 rows -> cut into beats, CRC -> m_axis
//
//   * Takes up to 4 records of 128 bits a cycle: record k of count_i in bits 128*k+127:128*k.
//     With last_i, the last of them is the packet's END record, and its word 3 is replaced by the
//     CRC-32 of all words before it; what comes there is of no account.
//   * Every beat carries PORT_RECORDS records, lowest bits first, but for a packet's last one,
//     which may carry fewer: tkeep says how many, and unused lanes are zero.
//   * All of m_axis comes from registers: tvalid never waits for tready, and nothing changes until
//     the beat is taken. ready_o comes from registers as well; no path crosses the module.
//   * With PORT_RECORDS = 4 and an output that is always taken, records are never held up, but
//     for one cycle behind a packet whose end spills into one more row.
//   * view_i must not change from a packet's first record to done_o.
//   * Illegal: last_i with count_i = 0; count_i above 4; dropping valid_i before it was taken.

module pack #(
    // Records a beat: 1, 2 or 4.
    parameter int unsigned PORT_RECORDS = 4
) (
    input logic clk_i,
    input logic rst_i,

    // From emit.
    input  logic         valid_i,
    output logic         ready_o,
    input  logic [  2:0] count_i,    // 0 to 4
    input  logic [511:0] records_i,
    input  logic         last_i,
    input  logic [ 15:0] view_i,

    // The output stream.
    output logic                        m_axis_tvalid,
    input  logic                        m_axis_tready,
    output logic [128*PORT_RECORDS-1:0] m_axis_tdata,
    output logic [ 16*PORT_RECORDS-1:0] m_axis_tkeep,
    output logic                        m_axis_tlast,
    output logic [                15:0] m_axis_tid,

    // A pulse in the cycle after the packet's last beat was taken.
    output logic done_o
);

  generate
    if (PORT_RECORDS != 1 && PORT_RECORDS != 2 && PORT_RECORDS != 4) begin : gen_bad_port
      $error("pack: PORT_RECORDS must be 1, 2 or 4");
    end
  endgenerate

  // --- Assemble: what doesn't fill a row of 4 records waits in rest ------------------------------
  logic [383:0] rest_q;  // its lowest rest_count_q records
  logic [  1:0] rest_count_q;
  logic         spilled_q;  // rest is the end of a packet, which its last row had no room for

  logic [895:0] window;  // rest and the new records behind it
  logic [2:0] total;  // records in the window, 0 to 7
  logic take, row_valid, row_ready, row_last;
  logic [  2:0] row_count;  // 1 to 4
  logic [511:0] row;

  assign ready_o = row_ready && !spilled_q;
  assign take = valid_i && ready_o;
  assign total = {1'b0, rest_count_q} + (take ? count_i : 3'd0);

  always_comb begin
    unique case (rest_count_q)
      2'd0: window = {384'd0, records_i};
      2'd1: window = {256'd0, records_i, rest_q[127:0]};
      2'd2: window = {128'd0, records_i, rest_q[255:0]};
      default: window = {records_i, rest_q};
    endcase
  end

  assign row_valid = row_ready && (spilled_q || (take && (last_i || total[2])));
  assign row_last = spilled_q || (last_i && total <= 3'd4);
  assign row_count = total[2] ? 3'd4 : total;
  assign row = window[511:0];

  always_ff @(posedge clk_i) begin
    if (row_valid) begin
      rest_q <= window[895:512];
      rest_count_q <= row_last ? 2'd0 : total[1:0];
      spilled_q <= take && last_i && !row_last;
    end else if (take) begin
      rest_q <= window[383:0];
      rest_count_q <= total[1:0];
    end
    if (rst_i) begin
      rest_count_q <= 2'd0;
      spilled_q <= 1'b0;
    end
  end

  // --- The queue, so that a stalled output doesn't reach emit within the cycle -------------------
  logic front_valid, front_ready, front_last;
  logic [  2:0] front_count;
  logic [511:0] front;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [  1:0] level;
  logic         fault;  // without parity there is none
  /* verilator lint_on UNUSEDSIGNAL */

  fifo #(
      .WIDTH(516),
      .DEPTH(2),
      .PARITY(1'b0)  // registers
  ) rows (
      .clk_i      (clk_i),
      .rst_i      (rst_i),
      .in_valid_i (row_valid),
      .in_ready_o (row_ready),
      .in_data_i  ({row_last, row_count, row}),
      .out_valid_o(front_valid),
      .out_ready_i(front_ready),
      .out_data_o ({front_last, front_count, front}),
      .level_o    (level),
      .fault_o    (fault)
  );

  // --- Cut the row into beats --------------------------------------------------------------------
  logic [1:0] lane_q;  // first record of the next beat
  logic [2:0] left;  // records of the row that are not in a beat yet, 1 to 4
  logic [2:0] beat_count;
  logic beat_valid, row_ends, beat_last, slot_free;
  logic [128*PORT_RECORDS-1:0] beat;

  assign left = front_count - {1'b0, lane_q};
  assign row_ends = left <= 3'(PORT_RECORDS);
  assign beat_count = row_ends ? left : 3'(PORT_RECORDS);
  assign beat_last = front_last && row_ends;
  assign slot_free = !m_axis_tvalid || m_axis_tready;
  assign beat_valid = front_valid && slot_free;
  assign front_ready = slot_free && row_ends;

  generate
    if (PORT_RECORDS == 4) begin : gen_whole
      assign beat = front;
    end else begin : gen_part
      assign beat = front[128*lane_q+:128*PORT_RECORDS];
    end
  endgenerate

  always_ff @(posedge clk_i) begin
    if (beat_valid) lane_q <= row_ends ? 2'd0 : lane_q + 2'(PORT_RECORDS);
    if (rst_i) lane_q <= 2'd0;
  end

  // --- The CRC's way through the beat's records, and the beat with the CRC in place --------------
  logic [31:0] crc_q;  // state behind the beats so far
  logic [32*PORT_RECORDS+31:0] crc;  // state before record k of the beat in bits 32*k+31:32*k
  logic [128*PORT_RECORDS-1:0] sealed;
  logic [16*PORT_RECORDS-1:0] keep;

  assign crc[31:0] = crc_q;

  genvar k;
  generate
    for (k = 0; k < PORT_RECORDS; k = k + 1) begin : gen_lane
      logic end_record;
      assign end_record = beat_last && 3'(k + 1) == beat_count;
      crc32 step (
          .enable_i(front_valid && 3'(k) < beat_count),
          .end_i   (end_record),
          .crc_i   (crc[32*k+:32]),
          .data_i  (beat[128*k+:128]),
          .crc_o   (crc[32*k+32+:32])
      );
      assign keep[16*k+:16] = {16{3'(k) < beat_count}};
      assign sealed[128*k+:96] = 3'(k) < beat_count ? beat[128*k+:96] : 96'd0;
      assign sealed[128*k+96+:32] =
          3'(k) >= beat_count ? 32'd0 :
          end_record ? ~crc[32*k+32+:32] : beat[128*k+96+:32];
    end
  endgenerate

  always_ff @(posedge clk_i) begin
    done_o <= m_axis_tvalid && m_axis_tready && m_axis_tlast;
    if (slot_free) m_axis_tvalid <= front_valid;
    if (beat_valid) begin
      m_axis_tdata <= sealed;
      m_axis_tkeep <= keep;
      m_axis_tlast <= beat_last;
      m_axis_tid <= view_i;
      crc_q <= beat_last ? 32'hffffffff : crc[32*PORT_RECORDS+:32];
    end
    if (rst_i) begin
      m_axis_tvalid <= 1'b0;
      crc_q <= 32'hffffffff;
      done_o <= 1'b0;
    end
  end

`ifndef YOSYS
  // What the user owes.
  offer_stays :
  assert property (@(posedge clk_i) disable iff (rst_i)
      valid_i && !ready_o |=> valid_i && $stable({count_i, last_i}))
  else $error("pack: records were withdrawn before they were taken");
`ifdef HS_ASSERT_DATA
  offer_keeps :
  assert property (@(posedge clk_i) disable iff (rst_i) valid_i && !ready_o |=> $stable(records_i))
  else $error("pack: records changed before they were taken");
  beat_keeps :
  assert property (@(posedge clk_i) disable iff (rst_i)
      m_axis_tvalid && !m_axis_tready |=> $stable(m_axis_tdata))
  else $error("pack: a beat changed before it was taken");
`endif
  count_in_range :
  assert property (@(posedge clk_i) disable iff (rst_i)
      valid_i |-> count_i <= 3'd4 && (count_i != 3'd0 || !last_i))
  else $error("pack: illegal record count");
  // What AXI4-Stream demands.
  beat_stays :
  assert property (@(posedge clk_i) disable iff (rst_i)
      m_axis_tvalid && !m_axis_tready |=> m_axis_tvalid
      && $stable({m_axis_tkeep, m_axis_tlast, m_axis_tid}))
  else $error("pack: a beat changed before it was taken");
  only_last_is_partial :
  assert property (@(posedge clk_i) disable iff (rst_i)
      m_axis_tvalid && !m_axis_tlast |-> &m_axis_tkeep)
  else $error("pack: a beat other than the last is not full");
  one_view :
  assert property (@(posedge clk_i) disable iff (rst_i)
      m_axis_tvalid && m_axis_tready && !m_axis_tlast && front_valid |=> m_axis_tid == $past(m_axis_tid))
  else $error("pack: the view changed within a packet");
`endif

`ifdef HS_FORMAL
`include "pack.svh"
`endif

endmodule
