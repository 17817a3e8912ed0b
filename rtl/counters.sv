// SPDX-License-Identifier: Apache-2.0
//
// The performance counters: what every stage did in every cycle since reset.
//
//   * Stage s (hs_pkg::STAGE_...) is busy, starved or blocked in a cycle, or idle if none of the
//     three bits is set. Only these three are counted; idle is what is left of the cycles, so that
//     busy + starved + blocked + idle = cycles whatever happens. That no two are set is asserted.
//   * in_i and out_i: items that entered and left the stage in this cycle, 0 to 7, stage s in bits
//     3*s+2:3*s. A stage that holds nothing has in = out.
//   * conflict_i: how many items waited for a memory bank in this cycle.
//   * All counts are 32 bits and wrap, cycles 64 bits.
//   * Read port, combinational: address_i is the byte address behind the register STAGES, 32 bytes
//     a stage: busy, starved, blocked, idle, in, out at 0, 4, .. 20. Elsewhere, data_o is 0 and
//     known_o is low.
//   * sample_i keeps a copy of the cycle count, which is cycles_o of that cycle and cycles_high_o
//     from the next on, and idle is reckoned up to there. Counters are read one by one: while no
//     stage works, the others stand still, and what is read after a sample adds up to it exactly.

module counters #(
    // Stages, at most 16.
    parameter int unsigned STAGES = 9
) (
    input logic clk_i,
    input logic rst_i,

    // From the stages.
    input logic [  STAGES-1:0] busy_i,
    input logic [  STAGES-1:0] starved_i,
    input logic [  STAGES-1:0] blocked_i,
    input logic [3*STAGES-1:0] in_i,
    input logic [3*STAGES-1:0] out_i,
    input logic [         3:0] conflict_i,

    // To the registers.
    input  logic        sample_i,
    output logic [31:0] cycles_o,       // low half of the count, now
    output logic [31:0] cycles_high_o,  // high half of the sample
    output logic [31:0] conflicts_o,
    input  logic [ 8:0] address_i,
    output logic [31:0] data_o,
    output logic        known_o
);

  generate
    if (STAGES < 1 || STAGES > 16) begin : gen_bad_stages
      $error("counters: STAGES must be 1 to 16");
    end
  endgenerate

  logic [63:0] cycles_q;
  logic [63:0] sample_q;
  logic [31:0] busy_q[0:STAGES-1];
  logic [31:0] starved_q[0:STAGES-1];
  logic [31:0] blocked_q[0:STAGES-1];
  logic [31:0] in_q[0:STAGES-1];
  logic [31:0] out_q[0:STAGES-1];

  assign cycles_o = cycles_q[31:0];
  assign cycles_high_o = sample_q[63:32];

  always_ff @(posedge clk_i) begin
    cycles_q <= cycles_q + 64'd1;
    if (sample_i) sample_q <= cycles_q;
    if (conflict_i != 4'd0) conflicts_o <= conflicts_o + {28'd0, conflict_i};
    if (rst_i) begin
      cycles_q <= 64'd0;
      sample_q <= 64'd0;
      conflicts_o <= 32'd0;
    end
  end

  // Arrays, not one wide vector: more than twice as fast in simulation, and no different in hardware.
  genvar s;
  generate
    for (s = 0; s < STAGES; s = s + 1) begin : gen_stage
      always_ff @(posedge clk_i) begin
        busy_q[s] <= rst_i ? 32'd0 : busy_q[s] + {31'd0, busy_i[s]};
        starved_q[s] <= rst_i ? 32'd0 : starved_q[s] + {31'd0, starved_i[s]};
        blocked_q[s] <= rst_i ? 32'd0 : blocked_q[s] + {31'd0, blocked_i[s]};
        in_q[s]  <= rst_i ? 32'd0 : in_q[s] + {29'd0, in_i[3*s+:3]};
        out_q[s] <= rst_i ? 32'd0 : out_q[s] + {29'd0, out_i[3*s+:3]};
      end
    end
  endgenerate

  // --- Reading -----------------------------------------------------------------------------------
  logic [3:0] stage;
  logic [2:0] which;
  logic [31:0] of_busy, of_starved, of_blocked, of_in, of_out;

  assign stage = address_i[8:5];
  assign which = address_i[4:2];
  assign known_o = address_i[1:0] == 2'd0 && {28'd0, stage} < STAGES && which < 3'd6;
  assign of_busy = busy_q[stage];
  assign of_starved = starved_q[stage];
  assign of_blocked = blocked_q[stage];
  assign of_in = in_q[stage];
  assign of_out = out_q[stage];

  always_comb begin
    unique case (which)
      3'd0: data_o = of_busy;
      3'd1: data_o = of_starved;
      3'd2: data_o = of_blocked;
      3'd3: data_o = sample_q[31:0] - of_busy - of_starved - of_blocked;
      3'd4: data_o = of_in;
      default: data_o = of_out;
    endcase
    if (!known_o) data_o = 32'd0;
  end

`ifndef YOSYS
  one_activity :
  assert property (@(posedge clk_i) disable iff (rst_i)
      ((busy_i & starved_i) | (busy_i & blocked_i) | (starved_i & blocked_i)) == '0)
  else $error("counters: a stage claims two activities at once");
`endif

`ifdef HS_FORMAL
`include "counters.svh"
`endif

endmodule
