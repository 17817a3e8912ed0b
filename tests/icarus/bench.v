// SPDX-License-Identifier: Apache-2.0
//
// halfstep under Icarus Verilog, moved by the program that started it (tests/icarus/Vhalfstep.h): a
// line in sets all inputs, a line out shows all outputs. What a receiver looks at must never be X: if
// it is, the answer is `unknown NAME` instead, and the simulation ends.
//
// PORT_RECORDS is set on the command line, to what Yosys gave the pipeline.

`timescale 1ns / 1ns

module bench;
  localparam DATA = 128 * `PORT_RECORDS;
  localparam KEEP = 16 * `PORT_RECORDS;
  localparam STDIN = 32'h8000_0000;
  localparam STDOUT = 32'h8000_0001;
  localparam INPUTS = 17;
  localparam LAST_REGISTER = 12'h220;

  reg clk, rst;
  reg in_valid, in_last, out_ready;
  reg [DATA-1:0] in_data;
  reg [KEEP-1:0] in_keep;
  reg [15:0] in_id;
  reg awvalid, wvalid, bready, arvalid, rready;
  reg [11:0] awaddr, araddr;
  reg [31:0] wdata;
  reg [3:0] wstrb;

  wire in_ready, out_valid, out_last;
  wire [DATA-1:0] out_data;
  wire [KEEP-1:0] out_keep;
  wire [15:0] out_id;
  wire awready, wready, bvalid, arready, rvalid;
  wire [1:0] bresp, rresp;
  wire [31:0] rdata;

  // From the reset's first edge on, everything that is checked has to be known. The design sees that edge
  // alone, however long the program holds the reset: no register may rely on another one's for a second.
  reg alive;

  halfstep dut (
      .clk_i(clk), .rst_i(rst && !alive),
      .s_axis_tvalid(in_valid), .s_axis_tready(in_ready), .s_axis_tdata(in_data), .s_axis_tkeep(in_keep),
      .s_axis_tlast(in_last), .s_axis_tid(in_id),
      .m_axis_tvalid(out_valid), .m_axis_tready(out_ready), .m_axis_tdata(out_data), .m_axis_tkeep(out_keep),
      .m_axis_tlast(out_last), .m_axis_tid(out_id),
      .s_axil_awvalid(awvalid), .s_axil_awready(awready), .s_axil_awaddr(awaddr), .s_axil_wvalid(wvalid),
      .s_axil_wready(wready), .s_axil_wdata(wdata), .s_axil_wstrb(wstrb), .s_axil_bvalid(bvalid),
      .s_axil_bready(bready), .s_axil_bresp(bresp), .s_axil_arvalid(arvalid), .s_axil_arready(arready),
      .s_axil_araddr(araddr), .s_axil_rvalid(rvalid), .s_axil_rready(rready), .s_axil_rdata(rdata),
      .s_axil_rresp(rresp)
  );

  reg x;

  // folded: the exclusive or of all bits, X if any of them is.
  task known(input [8*16-1:0] name, input folded);
    if (folded === 1'bx && !x) begin
      x = 1;
      $fwrite(STDOUT, "unknown %0s\n", name);
    end
  endtask

  task check;
    begin
      known("s_axis_tready", in_ready);
      known("m_axis_tvalid", out_valid);
      if (out_valid) begin
        known("m_axis_tdata", ^out_data);
        known("m_axis_tkeep", ^out_keep);
        known("m_axis_tlast", out_last);
        known("m_axis_tid", ^out_id);
      end
      known("s_axil_awready", awready);
      known("s_axil_wready", wready);
      known("s_axil_bvalid", bvalid);
      if (bvalid) known("s_axil_bresp", ^bresp);
      known("s_axil_arready", arready);
      known("s_axil_rvalid", rvalid);
      if (rvalid) begin
        known("s_axil_rdata", ^rdata);
        known("s_axil_rresp", ^rresp);
      end
    end
  endtask

  // A cycle of the bench's own.
  task cycle;
    begin
      #1 check;
      clk = 1;
      #1 check;
      clk = 0;
    end
  endtask

  // Reads all registers right behind the reset, while the program holds it.
  task read_registers;
    begin
      clk = 0;
      rready = 1;
      for (araddr = 0; araddr < LAST_REGISTER; araddr = araddr + 4) begin
        arvalid = 1;
        while (!arready && !x) cycle;
        cycle;
        arvalid = 0;
        while (!rvalid && !x) cycle;
        cycle;
      end
      rready = 0;
      clk = 1;
    end
  endtask

  integer taken;

  initial begin
    x = 0;
    alive = 0;
    taken = INPUTS;
    while (taken == INPUTS && !x) begin
      taken = $fscanf(STDIN, "%b %b %b %h %h %b %h %b %b %h %b %h %h %b %b %h %b", clk, rst, in_valid, in_data,
                      in_keep, in_last, in_id, out_ready, awvalid, awaddr, wvalid, wdata, wstrb, bready,
                      arvalid, araddr, rready);
      #1;
      if (alive) check;
      if (clk && rst && !alive) begin
        alive = 1;
        read_registers;
      end
      if (!x)
        $fwrite(STDOUT, "%b %b %h %h %b %h %b %b %b %h %b %b %h %h\n", in_ready, out_valid, out_data, out_keep,
                out_last, out_id, awready, wready, bvalid, bresp, arready, rvalid, rdata, rresp);
      $fflush(STDOUT);
    end
    $finish;
  end
endmodule
