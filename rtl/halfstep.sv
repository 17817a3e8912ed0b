// SPDX-License-Identifier: Apache-2.0
//
// halfstep: view-dependent sqrt(2) subdivision. One AXI4-Stream packet in for each view (matrix,
// vertices, faces), one out (refined vertices, final faces): docs/stream.md. Registers and counters
// over AXI4-Lite: docs/reference.md.
//
//                 +--> pipeline 0 --+
//   s_axis --> deal --> ...         +--> collect --> m_axis        registers: s_axil
//                 +--> pipeline n --+
//
//   * Each pipeline works on one view at a time; VIEWS views are in flight. A packet goes to the next
//     pipeline, in turn, that is ready for one.
//   * With one pipeline output packets come in the order of their input packets, one after the other.
//     With more, beats of different views may interleave: TID, that of the input packet, says whose
//     they are; the beats of each view are those that one pipeline alone would send, in that order.
//   * VERTICES and QUADS are the capacities of each; views that need more are refused, or stop early.

module halfstep #(
    // Vertices held; a power of two, 64 to 2^24.
    parameter int unsigned VERTICES = 524288,
    // Active quads held, and corners of the initial mesh; a power of two, 64 to 2^24.
    parameter int unsigned QUADS = 524288,
    // Records of 128 bits in a beat of either stream: 1, 2 or 4.
    parameter int unsigned PORT_RECORDS = 4,
    // Banks of the memories, as a power of two: 1 to 4.
    parameter int unsigned BANK_BITS = 3,
    // Items of a stage that compete for the banks, as a power of two: 1 to 5.
    parameter int unsigned WINDOW_BITS = 3,
    // Words that a stage reads or writes in a cycle, of one memory, at most: a power of two, 1 to 16.
    parameter int unsigned LANES = 8,
    // Cycles from a request of a window to its word: 1 to 8.
    parameter int unsigned READ_LATENCY = 1,
    // Ops of smooth and of split that wait for emit: a power of two, 16 to 256.
    parameter int unsigned OPS = 16,
    // Views in flight: 1 to 8.
    parameter int unsigned VIEWS = 1,
    // Memories and FIFOs have a parity bit a word; a view that meets a wrong one ends with
    // STATUS_MEMORY_FAULT, and the next is worked on as ever.
    parameter bit PARITY = 1'b1
) (
    input logic clk_i,
    input logic rst_i,  // synchronous

    input  logic                        s_axis_tvalid,
    output logic                        s_axis_tready,
    input  logic [128*PORT_RECORDS-1:0] s_axis_tdata,
    input  logic [ 16*PORT_RECORDS-1:0] s_axis_tkeep,
    input  logic                        s_axis_tlast,
    input  logic [                15:0] s_axis_tid,

    output logic                        m_axis_tvalid,
    input  logic                        m_axis_tready,
    output logic [128*PORT_RECORDS-1:0] m_axis_tdata,
    output logic [ 16*PORT_RECORDS-1:0] m_axis_tkeep,
    output logic                        m_axis_tlast,
    output logic [                15:0] m_axis_tid,

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
    output logic [ 1:0] s_axil_rresp
);

  generate
    if (VERTICES < 64 || (VERTICES & (VERTICES - 1)) != 0 || VERTICES > (1 << 24)) begin : g_bad_v
      $error("halfstep: VERTICES must be a power of two, 64 to 2^24");
    end
    if (QUADS < 64 || (QUADS & (QUADS - 1)) != 0 || QUADS > (1 << 24)) begin : g_bad_q
      $error("halfstep: QUADS must be a power of two, 64 to 2^24");
    end
    if (BANK_BITS < 1 || BANK_BITS > 4) begin : g_bad_banks
      $error("halfstep: BANK_BITS must be 1 to 4");
    end
    if (WINDOW_BITS < 1 || WINDOW_BITS > 5) begin : g_bad_window
      $error("halfstep: WINDOW_BITS must be 1 to 5");
    end
    if (LANES < 1 || LANES > 16 || (LANES & (LANES - 1)) != 0) begin : g_bad_lanes
      $error("halfstep: LANES must be a power of two, 1 to 16");
    end
    if (READ_LATENCY < 1 || READ_LATENCY > 8) begin : g_bad_latency
      $error("halfstep: READ_LATENCY must be 1 to 8");
    end
    if (OPS < 16 || OPS > 256 || (OPS & (OPS - 1)) != 0) begin : g_bad_ops
      $error("halfstep: OPS must be a power of two, 16 to 256");
    end
    if (VIEWS < 1 || VIEWS > 8) begin : g_bad_views
      $error("halfstep: VIEWS must be 1 to 8");
    end
  endgenerate

  localparam int unsigned VW = $clog2(VERTICES);
  localparam int unsigned QW = $clog2(QUADS);
  localparam int unsigned DATA = 128 * PORT_RECORDS;
  localparam int unsigned KEEP = 16 * PORT_RECORDS;
  // {PARITY, VIEWS, log2 OPS, READ_LATENCY, log2 LANES, WINDOW_BITS, BANK_BITS, log2 PORT_RECORDS}, 4 bits each
  localparam logic [31:0] ARCHITECTURE = {
    4'(PARITY), 4'(VIEWS), 4'($clog2(OPS)), 4'(READ_LATENCY), 4'($clog2(LANES)), 4'(WINDOW_BITS), 4'(BANK_BITS),
    4'($clog2(PORT_RECORDS))
  };

  // --- Registers -----------------------------------------------------------------------------------
  // The registers are as wide as the largest capacity needs.
  /* verilator lint_off UNUSEDSIGNAL */
  logic [24:0] limit_vertices, limit_quads;
  logic [3:0] pipeline_shown;  // whose counters are read
  /* verilator lint_on UNUSEDSIGNAL */
  logic sample, view_done;
  logic [8:0] counter_address;
  logic [VIEWS-1:0] busy, done, done_q, told, known;
  logic [8*VIEWS-1:0] status;
  logic [32*VIEWS-1:0] position, cycles, cycles_high, conflicts, counter;
  logic [7:0] status_told;
  logic [31:0] position_told;
  logic [31:0] shown;

  // Views that end in the same cycle are told one after the other.
  assign told = (done | done_q) & (~(done | done_q) + VIEWS'(1));
  assign view_done = told != '0;

  always_ff @(posedge clk_i) done_q <= rst_i ? '0 : (done | done_q) & ~told;

  always_comb begin
    status_told = '0;
    position_told = '0;
    for (int p = 0; p < VIEWS; p++)
      if (told[p]) begin
        status_told = status[8*p+:8];
        position_told = position[32*p+:32];
      end
  end
  assign shown = 32'(pipeline_shown) < VIEWS ? 32'(pipeline_shown) : 32'd0;

  registers #(
      .VERTICES(VERTICES), .QUADS(QUADS), .ARCHITECTURE(ARCHITECTURE)
  ) u_registers (
      .clk_i, .rst_i, .s_axil_awvalid, .s_axil_awready, .s_axil_awaddr, .s_axil_wvalid,
      .s_axil_wready, .s_axil_wdata, .s_axil_wstrb, .s_axil_bvalid, .s_axil_bready, .s_axil_bresp,
      .s_axil_arvalid, .s_axil_arready, .s_axil_araddr, .s_axil_rvalid, .s_axil_rready,
      .s_axil_rdata, .s_axil_rresp, .limit_vertices_o(limit_vertices), .limit_quads_o(limit_quads),
      .pipeline_o(pipeline_shown), .busy_i(busy != '0), .view_done_i(view_done),
      .status_i(status_told), .position_i(position_told), .sample_o(sample),
      .cycles_i(cycles[32*shown+:32]), .cycles_high_i(cycles_high[32*shown+:32]),
      .conflicts_i(conflicts[32*shown+:32]), .counter_address_o(counter_address),
      .counter_i(counter[32*shown+:32]), .counter_known_i(known[shown])
  );

  // --- Pipelines -----------------------------------------------------------------------------------
  logic [VIEWS-1:0] in_valid, in_ready, out_valid, out_ready, out_last;
  logic [DATA*VIEWS-1:0] out_data;
  logic [KEEP*VIEWS-1:0] out_keep;
  logic [16*VIEWS-1:0] out_id;

  deal #(
      .VIEWS(VIEWS)
  ) u_deal (
      .clk_i, .rst_i, .in_valid_i(s_axis_tvalid), .in_last_i(s_axis_tlast),
      .in_ready_o(s_axis_tready), .out_valid_o(in_valid), .out_ready_i(in_ready)
  );

  for (genvar p = 0; p < VIEWS; p++) begin : g_pipeline
    pipeline #(
        .VERTICES(VERTICES), .QUADS(QUADS), .PORT_RECORDS(PORT_RECORDS), .BANK_BITS(BANK_BITS),
        .WINDOW_BITS(WINDOW_BITS), .LANES(LANES), .READ_LATENCY(READ_LATENCY), .OPS(OPS),
        .PARITY(PARITY)
    ) u_pipeline (
        .clk_i, .rst_i, .s_axis_tvalid(in_valid[p]), .s_axis_tready(in_ready[p]), .s_axis_tdata,
        .s_axis_tkeep, .s_axis_tlast, .s_axis_tid, .m_axis_tvalid(out_valid[p]),
        .m_axis_tready(out_ready[p]), .m_axis_tdata(out_data[DATA*p+:DATA]),
        .m_axis_tkeep(out_keep[KEEP*p+:KEEP]), .m_axis_tlast(out_last[p]),
        .m_axis_tid(out_id[16*p+:16]), .limit_vertices_i(limit_vertices[VW:0]),
        .limit_quads_i(limit_quads[QW:0]), .busy_o(busy[p]), .view_done_o(done[p]),
        .status_o(status[8*p+:8]), .position_o(position[32*p+:32]), .sample_i(sample),
        .cycles_o(cycles[32*p+:32]), .cycles_high_o(cycles_high[32*p+:32]),
        .conflicts_o(conflicts[32*p+:32]), .counter_address_i(counter_address),
        .counter_o(counter[32*p+:32]), .counter_known_o(known[p])
    );
  end

  logic [(DATA+KEEP+17)*VIEWS-1:0] collected;

  for (genvar p = 0; p < VIEWS; p++) begin : g_beat
    assign collected[(DATA+KEEP+17)*p+:DATA+KEEP+17] = {
      out_id[16*p+:16], out_last[p], out_keep[KEEP*p+:KEEP], out_data[DATA*p+:DATA]
    };
  end

  collect #(
      .VIEWS(VIEWS), .WIDTH(DATA + KEEP + 17)
  ) u_collect (
      .clk_i, .rst_i, .in_valid_i(out_valid), .in_ready_o(out_ready), .in_data_i(collected),
      .out_valid_o(m_axis_tvalid), .out_ready_i(m_axis_tready),
      .out_data_o({m_axis_tid, m_axis_tlast, m_axis_tkeep, m_axis_tdata})
  );

endmodule
