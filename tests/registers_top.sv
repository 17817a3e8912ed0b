// SPDX-License-Identifier: Apache-2.0
//
// The registers with the counters behind them, as the pipeline has them.

module registers_top #(
    parameter int unsigned VERTICES = 1000,
    parameter int unsigned QUADS = 2000
) (
    input logic clk_i,
    input logic rst_i,

    input  logic        s_axil_awvalid,
    output logic        s_axil_awready,
    input  logic [11:0] s_axil_awaddr,
    input  logic        s_axil_wvalid,
    output logic        s_axil_wready,
    input  logic [31:0] s_axil_wdata,
    input  logic [ 3:0] s_axil_wstrb,
    output logic        s_axil_bvalid,
    input  logic        s_axil_bready,
    output logic [ 1:0] s_axil_bresp,
    input  logic        s_axil_arvalid,
    output logic        s_axil_arready,
    input  logic [11:0] s_axil_araddr,
    output logic        s_axil_rvalid,
    input  logic        s_axil_rready,
    output logic [31:0] s_axil_rdata,
    output logic [ 1:0] s_axil_rresp,

    output logic [24:0] limit_vertices_o,
    output logic [24:0] limit_quads_o,
    input  logic        busy_i,
    input  logic        view_done_i,
    input  logic [ 7:0] status_i,
    input  logic [31:0] position_i,

    input logic [ 8:0] stage_busy_i,
    input logic [ 8:0] stage_starved_i,
    input logic [ 8:0] stage_blocked_i,
    input logic [26:0] stage_in_i,
    input logic [26:0] stage_out_i,
    input logic [ 3:0] conflict_i
);

  logic sample, known;
  logic [31:0] cycles, cycles_high, conflicts, data;
  logic [8:0] address;

  registers #(
      .VERTICES(VERTICES),
      .QUADS(QUADS)
  ) registers (
      /* verilator lint_off PINCONNECTEMPTY */
      .pipeline_o       (),  // there is one
      /* verilator lint_on PINCONNECTEMPTY */
      .sample_o         (sample),
      .cycles_i         (cycles),
      .cycles_high_i    (cycles_high),
      .conflicts_i      (conflicts),
      .counter_address_o(address),
      .counter_i        (data),
      .counter_known_i  (known),
      .*
  );

  counters #(
      .STAGES(9)
  ) counters (
      .clk_i        (clk_i),
      .rst_i        (rst_i),
      .busy_i       (stage_busy_i),
      .starved_i    (stage_starved_i),
      .blocked_i    (stage_blocked_i),
      .in_i         (stage_in_i),
      .out_i        (stage_out_i),
      .conflict_i   (conflict_i),
      .sample_i     (sample),
      .cycles_o     (cycles),
      .cycles_high_o(cycles_high),
      .conflicts_o  (conflicts),
      .address_i    (address),
      .data_o       (data),
      .known_o      (known)
  );

endmodule
