// SPDX-License-Identifier: Apache-2.0
//
// The numbers that C and SystemVerilog share. Written by build/gen_pkg from
// model/definitions.def: change them there.

/* verilator lint_off UNUSEDPARAM */
package hs_pkg;

  // --- Constants
  // version of both stream formats
  localparam logic [31:0] STREAM_VERSION = 32'd2;
  // word 0 of an input packet: the bytes HS2I
  localparam logic [31:0] MAGIC_VIEW = 32'h49325348;
  // word 0 of an input packet's last record: the bytes HS2E
  localparam logic [31:0] MAGIC_END = 32'h45325348;
  // input flag: refine everything to the uniform depth; marks are ignored
  localparam logic [31:0] FLAG_UNIFORM = 32'd1;
  // input flag: refine the ring around every selected face as well
  localparam logic [31:0] FLAG_GUARD = 32'd2;
  // input flag: vertices leave at their positions on the limit surface
  localparam logic [31:0] FLAG_LIMIT = 32'd4;
  // input flag: boundary mode smooth; neither this nor edge-only: kept
  localparam logic [31:0] FLAG_SMOOTH = 32'd8;
  // input flag: boundary mode edge-only
  localparam logic [31:0] FLAG_EDGE_ONLY = 32'd16;
  // records of an input packet before the matrix
  localparam logic [31:0] HEADER_RECORDS = 32'd3;
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
  // largest sharpness of an edge or vertex that wears off
  localparam logic [31:0] MAX_SHARPNESS = 32'd9;
  // sharpness of an edge or vertex that stays sharp for ever
  localparam logic [31:0] SHARP_INFINITE = 32'd15;
  // units of the least edge's length in a pixel
  localparam logic [31:0] PIXEL_FRACTION = 32'd16;
  // bits 31:23 of word 0 of every record that is not a vertex; no finite number
  localparam logic [31:0] TAG = 32'h000001ff;
  // width of a vertex number in the output stream: four to a record
  localparam logic [31:0] INDEX_BITS = 32'd24;
  // the trailer's position when no input word is at fault
  localparam logic [31:0] NO_POSITION = 32'hffffffff;
  // binary places of a coordinate below the block's 2^E
  localparam logic [31:0] FRACTION_BITS = 32'd30;
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
  // the least edge is too long, or given without the size of the picture
  localparam logic [7:0] STATUS_BAD_PIXELS = 8'd34;
  // a sharpness is neither 0 to 9 nor 15, or differs from the twin's
  localparam logic [7:0] STATUS_BAD_SHARPNESS = 8'd35;

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

  // --- Division by n^2: {s[4:0], r[46:0]} for n from 255 down to 0; see divide.sv
  localparam logic [52*256-1:0] RECIPROCALS = {
    52'h04080c1014182, 52'h0410308143072, 52'h04186db66b18e, 52'h0420c41461c83,
    52'h04293401ffcc0, 52'h0431bde82d7b7, 52'h043a6231ef8ac, 52'h0443214c74255,
    52'h044bfba72065f, 52'h0454f1b39e322, 52'h045e03e5ea7ac, 52'h046732b463e55,
    52'h04707e97d9e23, 52'h0479e80b9c31e, 52'h04836f8d8adf2, 52'h048d159e26af4,
    52'h0496dac0a20f1, 52'h04a0bf7af27f0, 52'h04aac455e2831, 52'h04b4e9dd241c0,
    52'h04bf309f63ccb, 52'h04c9992e5c326, 52'h04d4241eea335, 52'h04ded20921c9e,
    52'h04e9a38863716, 52'h04f4993b723a4, 52'h04ffb3c48a8ac, 52'h050af3c979941,
    52'h051659f3b57fb, 52'h0521e6f0765de, 52'h052d9b70cfdac, 52'h05397829cbc15,
    52'h05457dd48554b, 52'h0551ad2e45859, 52'h055e06f8a00df, 52'h056a8bf99179d,
    52'h05773cfb9e266, 52'h05841acdf240d, 52'h0591264482cd8, 52'h059e60382fc24,
    52'h05abc986e73d4, 52'h05b96313c9e39, 52'h05c72dc750727, 52'h05d52a8f728ec,
    52'h05e35a5fcedf1, 52'h05f1be31d47c6, 52'h06005704edc78, 52'h060f25deacafc,
    52'h061e2bcaf87a7, 52'h062d69dc3d193, 52'h063ce12b9c1f4, 52'h064c92d91f65b,
    52'h065c800bed702, 52'h066ca9f27fa2e, 52'h067d11c2da5e2, 52'h068db8bac710d,
    52'h069ea0201057a, 52'h06afc940c03de, 52'h06c1357360b5c, 52'h06d2e6173e5fc,
    52'h06e4dc94adb93, 52'h06f71a5d52cb4, 52'h0709a0ec6b761, 52'h071c71c71c71d,
    52'h072f8e7cc1255, 52'h0742f8a73e6ed, 52'h0756b1eb58805, 52'h076abbf90befd,
    52'h077f188bea203, 52'h0793c96b7925e, 52'h07a8d06b974fb, 52'h07be2f6ce27af,
    52'h07d3e85d235ed, 52'h07e9fd37bcfa7, 52'h0c003803102af, 52'h0c0ba1702262e,
    52'h0c173bf69273d, 52'h0c2308b1a0455, 52'h0c2f08c491e00, 52'h0c3b3d5af9a73,
    52'h0c47a7a8ff63d, 52'h0c5448ebac41a, 52'h0c61226939e1d, 52'h0c6e357164a7d,
    52'h0c7b835dc1673, 52'h0c890d92169b2, 52'h0c96d57cb9532, 52'h0ca4dc96ee013,
    52'h0cb324654d5a8, 52'h0cc1ae782d7c2, 52'h0cd07c6c0f88c, 52'h0cdf8fea11f87,
    52'h0ceeeaa867d48, 52'h0cfe8e6ad51e7, 52'h0d0e7d0330a3e, 52'h0d1eb851eb852,
    52'h0d2f42469eb7c, 52'h0d401ce09ed37, 52'h0d514a2f967af, 52'h0d62cc5427b8b,
    52'h0d74a58094aaa, 52'h0d86d7f96fdf9, 52'h0d99661654cc3, 52'h0dac5242a8c69,
    52'h0dbf9efe64fb2, 52'h0dd34edee9d61, 52'h0de7648fdc647, 52'h0dfbe2d40e364,
    52'h0e10cc8670552, 52'h0e26249b11eb3, 52'h0e3bee202b3fd, 52'h0e522c3f35ba8,
    52'h0e68e23e11a6e, 52'h0e8013803a80b, 52'h0e97c3880a9c4, 52'h0eaff5f80f0bf,
    52'h0ec8ae946cb3a, 52'h0ee1f1445789c, 52'h0efbc2139d162, 52'h0f16253443527,
    52'h0f311f003d219, 52'h0f4cb3fb35a9f, 52'h0f68e8d473f3b, 52'h0f85c268d845a,
    52'h0fa345c4f4d3b, 52'h0fc1782743705, 52'h0fe05f027a0df, 52'h1400000000000,
    52'h1410308143072, 52'h1420c41461c83, 52'h1431bde82d7b7, 52'h1443214c74255,
    52'h1454f1b39e322, 52'h146732b463e55, 52'h1479e80b9c31e, 52'h148d159e26af4,
    52'h14a0bf7af27f0, 52'h14b4e9dd241c0, 52'h14c9992e5c326, 52'h14ded20921c9e,
    52'h14f4993b723a4, 52'h150af3c979941, 52'h1521e6f0765de, 52'h15397829cbc15,
    52'h1551ad2e45859, 52'h156a8bf99179d, 52'h15841acdf240d, 52'h159e60382fc24,
    52'h15b96313c9e39, 52'h15d52a8f728ec, 52'h15f1be31d47c6, 52'h160f25deacafc,
    52'h162d69dc3d193, 52'h164c92d91f65b, 52'h166ca9f27fa2e, 52'h168db8bac710d,
    52'h16afc940c03de, 52'h16d2e6173e5fc, 52'h16f71a5d52cb4, 52'h171c71c71c71d,
    52'h1742f8a73e6ed, 52'h176abbf90befd, 52'h1793c96b7925e, 52'h17be2f6ce27af,
    52'h17e9fd37bcfa7, 52'h1c0ba1702262e, 52'h1c2308b1a0455, 52'h1c3b3d5af9a73,
    52'h1c5448ebac41a, 52'h1c6e357164a7d, 52'h1c890d92169b2, 52'h1ca4dc96ee013,
    52'h1cc1ae782d7c2, 52'h1cdf8fea11f87, 52'h1cfe8e6ad51e7, 52'h1d1eb851eb852,
    52'h1d401ce09ed37, 52'h1d62cc5427b8b, 52'h1d86d7f96fdf9, 52'h1dac5242a8c69,
    52'h1dd34edee9d61, 52'h1dfbe2d40e364, 52'h1e26249b11eb3, 52'h1e522c3f35ba8,
    52'h1e8013803a80b, 52'h1eaff5f80f0bf, 52'h1ee1f1445789c, 52'h1f16253443527,
    52'h1f4cb3fb35a9f, 52'h1f85c268d845a, 52'h1fc1782743705, 52'h2400000000000,
    52'h2420c41461c83, 52'h2443214c74255, 52'h246732b463e55, 52'h248d159e26af4,
    52'h24b4e9dd241c0, 52'h24ded20921c9e, 52'h250af3c979941, 52'h25397829cbc15,
    52'h256a8bf99179d, 52'h259e60382fc24, 52'h25d52a8f728ec, 52'h260f25deacafc,
    52'h264c92d91f65b, 52'h268db8bac710d, 52'h26d2e6173e5fc, 52'h271c71c71c71d,
    52'h276abbf90befd, 52'h27be2f6ce27af, 52'h2c0ba1702262e, 52'h2c3b3d5af9a73,
    52'h2c6e357164a7d, 52'h2ca4dc96ee013, 52'h2cdf8fea11f87, 52'h2d1eb851eb852,
    52'h2d62cc5427b8b, 52'h2dac5242a8c69, 52'h2dfbe2d40e364, 52'h2e522c3f35ba8,
    52'h2eaff5f80f0bf, 52'h2f16253443527, 52'h2f85c268d845a, 52'h3400000000000,
    52'h3443214c74255, 52'h348d159e26af4, 52'h34ded20921c9e, 52'h35397829cbc15,
    52'h359e60382fc24, 52'h360f25deacafc, 52'h368db8bac710d, 52'h371c71c71c71d,
    52'h37be2f6ce27af, 52'h3c3b3d5af9a73, 52'h3ca4dc96ee013, 52'h3d1eb851eb852,
    52'h3dac5242a8c69, 52'h3e522c3f35ba8, 52'h3f16253443527, 52'h4400000000000,
    52'h448d159e26af4, 52'h45397829cbc15, 52'h460f25deacafc, 52'h471c71c71c71d,
    52'h4c3b3d5af9a73, 52'h4d1eb851eb852, 52'h4e522c3f35ba8, 52'h5400000000000,
    52'h55397829cbc15, 52'h571c71c71c71d, 52'h5d1eb851eb852, 52'h6400000000000,
    52'h671c71c71c71d, 52'h7400000000000, 52'h8400000000000, 52'h8400000000000
  };

endpackage
/* verilator lint_on UNUSEDPARAM */
