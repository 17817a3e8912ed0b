// SPDX-License-Identifier: Apache-2.0
//
// The registers of definitions.def behind an AXI4-Lite slave: identity, capacities, run-time
// limits, the latest view's fate, performance counters.
//
//   * One read and one write at a time. An address that no register has, or that is not a multiple
//     of 4, reads as 0 with SLVERR; writing there, or to a register that is read-only, changes
//     nothing and gives SLVERR.
//   * LIMIT_VERTICES and LIMIT_QUADS hold the capacity after reset; a larger value that is written
//     to them is cut down to it. Bytes whose strobe is low keep their value. Write them between
//     views: they apply at once.
//   * PIPELINE says whose counters are read, CYCLES and CONFLICTS among them: 0 to VIEWS - 1; what is
//     above is as 0.
//   * STATUS, POSITION and VIEWS change with view_done_i.
//   * Reading CYCLES samples the cycle count: CYCLES_HIGH and the idle counters refer to the latest
//     such reading (see counters.sv).
//   * All outputs of the bus come from registers.

module registers #(
    // Vertices that the memories hold, at most 2^24.
    parameter int unsigned VERTICES = 524288,
    // Active quads that they hold, at most 2^24.
    parameter int unsigned QUADS = 524288,
    // What the register ARCHITECTURE says.
    parameter logic [31:0] ARCHITECTURE = 32'd0
) (
    input logic clk_i,
    input logic rst_i,

    // The bus.
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

    // To the pipeline.
    output logic [24:0] limit_vertices_o,
    output logic [24:0] limit_quads_o,
    output logic [ 3:0] pipeline_o,  // whose counters are read

    // From the view's control.
    input logic        busy_i,       // from the first word of a view to its last beat
    input logic        view_done_i,  // a pulse a view; the two below are taken with it
    input logic [ 7:0] status_i,
    input logic [31:0] position_i,

    // From and to the counters.
    output logic        sample_o,
    input  logic [31:0] cycles_i,
    input  logic [31:0] cycles_high_i,
    input  logic [31:0] conflicts_i,
    output logic [ 8:0] counter_address_o,
    input  logic [31:0] counter_i,
    input  logic        counter_known_i
);

  localparam logic [1:0] OKAY = 2'b00;
  localparam logic [1:0] SLVERR = 2'b10;
  localparam logic [24:0] CAPACITY_VERTICES = 25'(VERTICES);
  localparam logic [24:0] CAPACITY_QUADS = 25'(QUADS);

  generate
    if (VERTICES < 1 || VERTICES > (1 << 24) || QUADS < 1 || QUADS > (1 << 24)) begin : gen_bad_size
      $error("registers: VERTICES and QUADS must be 1 to 2^24");
    end
  endgenerate

  // --- The latest view ---------------------------------------------------------------------------
  logic [ 7:0] status_q;
  logic [31:0] position_q, views_q;

  always_ff @(posedge clk_i) begin
    if (view_done_i) begin
      status_q   <= status_i;
      position_q <= position_i;
      views_q    <= views_q + 32'd1;
    end
    if (rst_i) begin
      status_q   <= hs_pkg::STATUS_OK;
      position_q <= hs_pkg::NO_POSITION;
      views_q    <= 32'd0;
    end
  end

  // --- Writing: address and data are taken together ----------------------------------------------
  logic [31:0] strobes, old_limit, new_limit;
  logic to_vertices, to_quads, to_pipeline, write;

  assign s_axil_wready = s_axil_awready;
  assign write = s_axil_awready;  // both are valid then, and stay so
  assign to_vertices = s_axil_awaddr == hs_pkg::REG_LIMIT_VERTICES;
  assign to_pipeline = s_axil_awaddr == hs_pkg::REG_PIPELINE;
  assign to_quads = s_axil_awaddr == hs_pkg::REG_LIMIT_QUADS;
  assign strobes = {{8{s_axil_wstrb[3]}}, {8{s_axil_wstrb[2]}}, {8{s_axil_wstrb[1]}},
                    {8{s_axil_wstrb[0]}}};
  assign old_limit = {7'd0, to_quads ? limit_quads_o : limit_vertices_o};
  assign new_limit = (s_axil_wdata & strobes) | (old_limit & ~strobes);

  always_ff @(posedge clk_i) begin
    s_axil_awready <= s_axil_awvalid && s_axil_wvalid && !s_axil_awready && !s_axil_bvalid;
    if (s_axil_bready) s_axil_bvalid <= 1'b0;
    if (write) begin
      s_axil_bvalid <= 1'b1;
      s_axil_bresp  <= to_vertices || to_quads || to_pipeline ? OKAY : SLVERR;
    end
    if (write && to_vertices)
      limit_vertices_o <=
          new_limit > {7'd0, CAPACITY_VERTICES} ? CAPACITY_VERTICES : new_limit[24:0];
    if (write && to_quads)
      limit_quads_o <= new_limit > {7'd0, CAPACITY_QUADS} ? CAPACITY_QUADS : new_limit[24:0];
    if (write && to_pipeline && s_axil_wstrb[0]) pipeline_o <= s_axil_wdata[3:0];
    if (rst_i) begin
      pipeline_o <= 4'd0;
      s_axil_awready <= 1'b0;
      s_axil_bvalid <= 1'b0;
      limit_vertices_o <= CAPACITY_VERTICES;
      limit_quads_o <= CAPACITY_QUADS;
    end
  end

  // --- Reading -----------------------------------------------------------------------------------
  logic read, known, of_counters;
  logic [31:0] data;

  assign read = s_axil_arready;  // arvalid is set then
  // The counters' addresses span 512 bytes.
  assign of_counters = s_axil_araddr >= hs_pkg::REG_STAGES
                    && s_axil_araddr < hs_pkg::REG_STAGES + 12'd512;
  assign counter_address_o = s_axil_araddr[8:0] - hs_pkg::REG_STAGES[8:0];
  assign sample_o = read && s_axil_araddr == hs_pkg::REG_CYCLES;

  always_comb begin
    known = 1'b1;
    unique case (s_axil_araddr)
      hs_pkg::REG_IDENTITY: data = hs_pkg::IDENTITY;
      hs_pkg::REG_VERSION: data = hs_pkg::STREAM_VERSION;
      hs_pkg::REG_CAPACITY_VERTICES: data = {7'd0, CAPACITY_VERTICES};
      hs_pkg::REG_CAPACITY_QUADS: data = {7'd0, CAPACITY_QUADS};
      hs_pkg::REG_LIMIT_VERTICES: data = {7'd0, limit_vertices_o};
      hs_pkg::REG_LIMIT_QUADS: data = {7'd0, limit_quads_o};
      hs_pkg::REG_BUSY: data = {31'd0, busy_i};
      hs_pkg::REG_STATUS: data = {24'd0, status_q};
      hs_pkg::REG_POSITION: data = position_q;
      hs_pkg::REG_VIEWS: data = views_q;
      hs_pkg::REG_CYCLES: data = cycles_i;
      hs_pkg::REG_CYCLES_HIGH: data = cycles_high_i;
      hs_pkg::REG_CONFLICTS: data = conflicts_i;
      hs_pkg::REG_PIPELINE: data = {28'd0, pipeline_o};
      hs_pkg::REG_ARCHITECTURE: data = ARCHITECTURE;
      default: begin
        known = of_counters && counter_known_i;
        data  = known ? counter_i : 32'd0;
      end
    endcase
  end

  always_ff @(posedge clk_i) begin
    s_axil_arready <= s_axil_arvalid && !s_axil_arready && !s_axil_rvalid;
    if (s_axil_rready) s_axil_rvalid <= 1'b0;
    if (read) begin
      s_axil_rvalid <= 1'b1;
      s_axil_rdata  <= data;
      s_axil_rresp  <= known ? OKAY : SLVERR;
    end
    if (rst_i) begin
      s_axil_arready <= 1'b0;
      s_axil_rvalid  <= 1'b0;
    end
  end

`ifndef YOSYS
  bus_write :
  assert property (@(posedge clk_i) disable iff (rst_i)
      s_axil_awready |-> s_axil_awvalid && s_axil_wvalid)
  else $error("registers: a write was withdrawn before it was taken");
  bus_read :
  assert property (@(posedge clk_i) disable iff (rst_i) s_axil_arready |-> s_axil_arvalid)
  else $error("registers: a read was withdrawn before it was taken");
`endif

`ifdef HS_FORMAL
`include "registers.svh"
`endif

endmodule
