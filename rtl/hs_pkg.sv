// SPDX-License-Identifier: Apache-2.0
//
// The numbers that C and SystemVerilog share. Written by build/gen_pkg from
// model/definitions.def: change them there.

/* verilator lint_off UNUSEDPARAM */
package hs_pkg;

  // --- Constants
  // version of both stream formats
  localparam logic [31:0] STREAM_VERSION = 32'd1;
  // word 0 of an input packet: the bytes HS2I
  localparam logic [31:0] MAGIC_VIEW = 32'h49325348;
  // word 0 of an input packet's last record: the bytes HS2E
  localparam logic [31:0] MAGIC_END = 32'h45325348;
  // input flag: refine everything to the uniform depth; marks are ignored
  localparam logic [31:0] FLAG_UNIFORM = 32'd1;
  // input flag: refine the ring around every selected face as well
  localparam logic [31:0] FLAG_GUARD = 32'd2;
  // records of an input packet before the matrix
  localparam logic [31:0] HEADER_RECORDS = 32'd2;
  // records of the matrix, one a row
  localparam logic [31:0] MATRIX_RECORDS = 32'd4;
  // the twin of a half-edge that has none
  localparam logic [31:0] BORDER = 32'hffffffff;
  // least sides of a face
  localparam logic [31:0] MIN_SIDES = 32'd3;
  // most sides of a face
  localparam logic [31:0] MAX_SIDES = 32'd255;
  // most faces at a vertex
  localparam logic [31:0] MAX_VALENCE = 32'd255;
  // largest refinement depth that a stream may ask for
  localparam logic [31:0] MAX_DEPTH = 32'd250;
  // bits 31:23 of word 0 of every record that is not a vertex; no finite number
  localparam logic [31:0] TAG = 32'h000001ff;
  // width of a vertex number in the output stream: four to a record
  localparam logic [31:0] INDEX_BITS = 32'd24;
  // the trailer's position when no input word is at fault
  localparam logic [31:0] NO_POSITION = 32'hffffffff;
  // a coordinate: two's complement, S1.30 of the block
  localparam logic [31:0] POSITION_BITS = 32'd32;
  // binary places of a coordinate below the block's 2^E
  localparam logic [31:0] FRACTION_BITS = 32'd30;
  // T, the sum of 2n positions around a vertex: 32 + log2(2*255), rounded up
  localparam logic [31:0] SUM_BITS = 32'd40;
  // dividend of a mask: |T + n(n-2)S| <= n^2 2^30 < 2^46, and its sign
  localparam logic [31:0] DIVIDEND_BITS = 32'd48;
  // a component of a cross product of two positions
  localparam logic [31:0] CROSS_BITS = 32'd63;
  // begin a packet: header record
  localparam logic [31:0] OP_HEADER = 32'd0;
  // a vertex's number and position
  localparam logic [31:0] OP_VERTEX = 32'd1;
  // up to four final faces with 3 or 4 sides
  localparam logic [31:0] OP_FACES = 32'd2;
  // a corner of a final face with any number of sides
  localparam logic [31:0] OP_CORNER = 32'd3;
  // end the packet: trailer and end records
  localparam logic [31:0] OP_TRAILER = 32'd4;
  // the identity register: the bytes tSfh
  localparam logic [31:0] IDENTITY = 32'h68665374;

  // --- Output records
  // first record: version, view, block exponent
  localparam logic [2:0] RECORD_HEADER = 3'd0;
  // numbers of the 1 to 4 vertices whose positions follow, a record each
  localparam logic [2:0] RECORD_VERTICES = 3'd1;
  // a final face: sides, generation, its first 4 vertices
  localparam logic [2:0] RECORD_FACE = 3'd2;
  // the next 1 to 4 vertices of a face with more than 4 sides
  localparam logic [2:0] RECORD_MORE = 3'd3;
  // status, position of the offending input word, vertices and faces sent
  localparam logic [2:0] RECORD_TRAILER = 3'd4;
  // last record: last generation, triangles sent, CRC-32 of all records before it
  localparam logic [2:0] RECORD_END = 3'd5;

  // --- Statuses of a view
  // the view is complete
  localparam logic [7:0] STATUS_OK = 8'd0;
  // refinement stopped early: the next generation would exceed a capacity
  localparam logic [7:0] STATUS_STOPPED = 8'd1;
  // the packet does not begin with the magic word
  localparam logic [7:0] STATUS_BAD_MAGIC = 8'd16;
  // the stream version is not known
  localparam logic [7:0] STATUS_BAD_VERSION = 8'd17;
  // a flag that is not defined is set
  localparam logic [7:0] STATUS_BAD_FLAGS = 8'd18;
  // a count is zero, or too small for the others
  localparam logic [7:0] STATUS_BAD_COUNT = 8'd19;
  // a depth exceeds 250
  localparam logic [7:0] STATUS_BAD_DEPTH = 8'd20;
  // a reserved word or bit is not zero
  localparam logic [7:0] STATUS_BAD_RESERVED = 8'd21;
  // more vertices than this pipeline holds
  localparam logic [7:0] STATUS_CAPACITY_VERTICES = 8'd22;
  // more half-edges than this pipeline holds
  localparam logic [7:0] STATUS_CAPACITY_CORNERS = 8'd23;
  // a number of the matrix or of a vertex is not finite
  localparam logic [7:0] STATUS_BAD_NUMBER = 8'd24;
  // a transformed vertex is not finite
  localparam logic [7:0] STATUS_OVERFLOW = 8'd25;
  // a corner names a vertex that does not exist
  localparam logic [7:0] STATUS_BAD_INDEX = 8'd26;
  // a twin does not exist, does not point back, or runs in the same direction
  localparam logic [7:0] STATUS_BAD_TWIN = 8'd27;
  // sides, corner number or face count do not fit together
  localparam logic [7:0] STATUS_BAD_FACE = 8'd28;
  // a vertex has more than 255 corners
  localparam logic [7:0] STATUS_BAD_VALENCE = 8'd29;
  // the packet's last record is not a trailer
  localparam logic [7:0] STATUS_BAD_TRAILER = 8'd30;
  // the CRC-32 of the packet does not match
  localparam logic [7:0] STATUS_BAD_CRC = 8'd31;
  // the packet ends early
  localparam logic [7:0] STATUS_TRUNCATED = 8'd32;
  // the packet goes on behind its trailer
  localparam logic [7:0] STATUS_TOO_LONG = 8'd33;

  // --- Stages
  // stream in: unpacks, checks, stores
  localparam logic [3:0] STAGE_receive = 4'd0;
  // clip = M p in binary32
  localparam logic [3:0] STAGE_transform = 4'd1;
  // binary32 to block floating point
  localparam logic [3:0] STAGE_quantize = 4'd2;
  // marks, face points, sums around the vertices
  localparam logic [3:0] STAGE_classify = 4'd3;
  // which faces the view wants refined
  localparam logic [3:0] STAGE_select = 4'd4;
  // which faces are refined, and the numbers of their new vertices
  localparam logic [3:0] STAGE_guard = 4'd5;
  // moves the vertices that may move, sends those that never will again
  localparam logic [3:0] STAGE_smooth = 4'd6;
  // child quads, and the faces that are final
  localparam logic [3:0] STAGE_split = 4'd7;
  // records, packed into beats, with their CRC: stream out
  localparam logic [3:0] STAGE_emit = 4'd8;
  // how many there are
  localparam logic [31:0] STAGES = 32'd9;

  // --- Activities of a stage
  // took an item
  localparam logic [1:0] ACTIVITY_busy = 2'd0;
  // at work, but had no item to take
  localparam logic [1:0] ACTIVITY_starved = 2'd1;
  // had an item, but could not take it
  localparam logic [1:0] ACTIVITY_blocked = 2'd2;
  // not at work
  localparam logic [1:0] ACTIVITY_idle = 2'd3;
  // how many there are
  localparam logic [31:0] ACTIVITIES = 32'd4;

  // --- Registers
  // 0x68665374
  localparam logic [11:0] REG_IDENTITY = 12'h000;
  // stream version
  localparam logic [11:0] REG_VERSION = 12'h004;
  // vertices that the memories hold
  localparam logic [11:0] REG_CAPACITY_VERTICES = 12'h008;
  // active quads (corners, for the initial mesh) they hold
  localparam logic [11:0] REG_CAPACITY_QUADS = 12'h00c;
  // run-time limit of vertices, at or below the capacity
  localparam logic [11:0] REG_LIMIT_VERTICES = 12'h010;
  // run-time limit of active quads, at or below the capacity
  localparam logic [11:0] REG_LIMIT_QUADS = 12'h014;
  // 1 from the first word of a view to its trailer
  localparam logic [11:0] REG_BUSY = 12'h018;
  // status of the latest view
  localparam logic [11:0] REG_STATUS = 12'h01c;
  // position of its offending word
  localparam logic [11:0] REG_POSITION = 12'h020;
  // views completed, whatever their status
  localparam logic [11:0] REG_VIEWS = 12'h024;
  // cycles since reset, low 32 bits
  localparam logic [11:0] REG_CYCLES = 12'h028;
  // cycles since reset, high 32 bits
  localparam logic [11:0] REG_CYCLES_HIGH = 12'h02c;
  // cycles in which an item waited for a memory bank
  localparam logic [11:0] REG_CONFLICTS = 12'h030;
  // counters, 32 bytes a stage: busy, starved, blocked, idle, in, out
  localparam logic [11:0] REG_STAGES = 12'h100;

endpackage
/* verilator lint_on UNUSEDPARAM */
