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
  // four vertices' numbers and positions, a whole group
  localparam logic [31:0] OP_GROUP = 32'd5;
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
  // last record: last generation, triangles sent, CRC-32 of all words before it
  localparam logic [2:0] RECORD_END = 3'd5;

  // --- Statuses of a view
  // the view is complete
  localparam logic [7:0] STATUS_OK = 8'd0;
  // refinement stopped early: the next generation would exceed a capacity
  localparam logic [7:0] STATUS_STOPPED = 8'd1;
  // a memory gave a word with wrong parity: nothing of the view is of use
  localparam logic [7:0] STATUS_MEMORY_FAULT = 8'd2;
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
  // cycles in which a request waited for a memory bank
  localparam logic [11:0] REG_CONFLICTS = 12'h030;
  // parameters, 4 bits each from bit 0 up: log2 of the records in a beat, log2 of banks, log2 of a window's items, log2 of lanes, read latency, log2 of ops that wait for emit, views in flight, whether memories have parity
  localparam logic [11:0] REG_ARCHITECTURE = 12'h034;
  // whose counters are read, from 0: each view in flight has a pipeline of its own
  localparam logic [11:0] REG_PIPELINE = 12'h038;
  // counters, 32 bytes a stage: busy, starved, blocked, idle, in, out
  localparam logic [11:0] REG_STAGES = 12'h100;

  // --- Stage boundaries
  // a beat of the input stream
  localparam logic [31:0] PROBE_beat_in = 32'd0;
  // a vertex for transform: x, y, z, w
  localparam logic [31:0] PROBE_vertex_in = 32'd1;
  // a corner for the record memory: origin, twin, {last, first, boundary, border}, {own, sharpness, forced}
  localparam logic [31:0] PROBE_corner_in = 32'd2;
  // a vertex in clip space: x, y, z, w
  localparam logic [31:0] PROBE_clip = 32'd3;
  // a vertex for the position memory: x, y, z, w
  localparam logic [31:0] PROBE_quantized = 32'd4;
  // a stage starts, its number: generation, items, vertices, all that start, a bit each from classify on
  localparam logic [31:0] PROBE_kick = 32'd5;
  // an item is taken: origins
  localparam logic [31:0] PROBE_classify_in = 32'd6;
  // a face's new vertex, {stop, front} above its number: x, y, z, w
  localparam logic [31:0] PROBE_classify_face = 32'd7;
  // a contribution to the vertices: marks
  localparam logic [31:0] PROBE_classify_out = 32'd8;
  // an item is taken: origins
  localparam logic [31:0] PROBE_select_in = 32'd9;
  // a face's verdict: selected
  localparam logic [31:0] PROBE_select_face = 32'd10;
  // an item's vertices are chosen, or not: selected
  localparam logic [31:0] PROBE_select_out = 32'd11;
  // an item is taken: origins
  localparam logic [31:0] PROBE_guard_in = 32'd12;
  // a new vertex: x, y, z, w
  localparam logic [31:0] PROBE_guard_new = 32'd13;
  // an item's verdict: refined, selected, number
  localparam logic [31:0] PROBE_guard_out = 32'd14;
  // a vertex is picked, or those of a row, or new ones: those of the row, those that leave, how many new ones
  localparam logic [31:0] PROBE_smooth_in = 32'd15;
  // a vertex is written: {sent, moved}, its x, y, z
  localparam logic [31:0] PROBE_smooth_out = 32'd16;
  // an item is taken: origins
  localparam logic [31:0] PROBE_split_in = 32'd17;
  // an item's children are numbered: first, lower
  localparam logic [31:0] PROBE_split_number = 32'd18;
  // lower halves: quads
  localparam logic [31:0] PROBE_split_lower = 32'd19;
  // upper halves: quads
  localparam logic [31:0] PROBE_split_upper = 32'd20;
  // an item is done: edges replaced, lower ones
  localparam logic [31:0] PROBE_split_out = 32'd21;
  // emit takes an op: kind, number, mask
  localparam logic [31:0] PROBE_op = 32'd22;
  // pack takes records: how many, {last}
  localparam logic [31:0] PROBE_records = 32'd23;
  // a beat of the output stream: its words, four XORed
  localparam logic [31:0] PROBE_beat_out = 32'd24;

  // --- Division by n^2, and for limits by n^2 + 5n; see divide.sv.
  // {s[4:0], r[47:0]} for {limit, n} from 511 down to 0
  localparam logic [53*512-1:0] RECIPROCALS = {
    53'h00fd0ccdc9d99b, 53'h00ff06f3367ccb, 53'h018083869bc36a, 53'h01818699e82001,
    53'h01828cbfbeb9a1, 53'h018396049c297a, 53'h0184a2753cb931, 53'h0185b21e9dea43,
    53'h0186c50e00086d, 53'h0187db50e7c76b, 53'h0188f4f51fec7a, 53'h018a1208bb03ee,
    53'h018b329a152350, 53'h018c56b7d5b860, 53'h018d7e70f16578, 53'h018ea9d4abeba9,
    53'h018fd8f29a2328, 53'h01910bdaa40260, 53'h0192429d06b446, 53'h01937d4a56be61,
    53'h0194bbf382370d, 53'h0195fea9d30c97, 53'h0197457ef15dab, 53'h01989084e5e3c5,
    53'h0199dfce1c702d, 53'h019b336d667c3a, 53'h019c8b75fdcd6b, 53'h019de7fb872e21,
    53'h019f4912153b9e, 53'h01a0aece2b4a19, 53'h01a21944c05f9d, 53'h01a3888b424697,
    53'h01a4fcb798b8cf, 53'h01a675e028a3c8, 53'h01a7f41bd7875e, 53'h01a977820eef99,
    53'h01ab002ac00ab1, 53'h01ac8e2e675c4b, 53'h01ae21a6108f04, 53'h01afbaab5a6557,
    53'h01b159587acb1d, 53'h01b2fdc84308cc, 53'h01b4a8162419b7, 53'h01b6585e3326aa,
    53'h01b80ebd2e2633, 53'h01b9cb5080a406, 53'h01bb8e3648b107, 53'h01bd578d5bfd6a,
    53'h01bf27754d1ea4, 53'h01c0fe0e7102c5, 53'h01c2db79e4930d, 53'h01c4bfd9928782,
    53'h01c6ab50396d86, 53'h01c89e0171e353, 53'h01ca9811b50a8d, 53'h01cc99a6633400,
    53'h01cea2e5cac6eb, 53'h01d0b3f72f6620, 53'h01d2cd02d15586, 53'h01d4ee31f52299,
    53'h01d717aeeb9291, 53'h01d949a519d917, 53'h01db8441021a81, 53'h01ddc7b04c3ca5,
    53'h01e01421cf099a, 53'h01e269c599a7c1, 53'h01e4c8ccfd6aac, 53'h01e7316a9800ae,
    53'h01e9a3d25e00ea, 53'h01ec2039a5de13, 53'h01eea6d733421e, 53'h01f137e342d76d,
    53'h01f3d397968437, 53'h01f67a2f821d19, 53'h01f92be7f89412, 53'h01fbe8ff99a959,
    53'h01feb1b6c023d1, 53'h0280c327c84b93, 53'h02823387045eeb, 53'h0283aa1c07b6f8,
    53'h0285270ac297af, 53'h0286aa782abd9b, 53'h0288348a4455dd, 53'h0289c5682b5294,
    53'h028b5d3a1d1ffc, 53'h028cfc2982beb9, 53'h028ea260fb4811, 53'h0290500c66e111,
    53'h02920558f221de, 53'h0293c27521f6bb, 53'h02958790e00096, 53'h029754dd877b4b,
    53'h02992a8df2b00e, 53'h029b08d688fae0, 53'h029cefed4d6a3b, 53'h029ee009ee009f,
    53'h02a0d965d3a007, 53'h02a2dc3c32a7c1, 53'h02a4e8ca1c4db5, 53'h02a6ff4e90bc87,
    53'h02a9200a9200aa, 53'h02ab4b4137cefd, 53'h02ad8137c43035, 53'h02afc235b91cec,
    53'h02b20e84ef1700, 53'h02b46671accd82, 53'h02b6ca4abfd972, 53'h02b93a6196a22b,
    53'h02bbb70a5b7973, 53'h02be409c110006, 53'h02c0d770afe482, 53'h02c37be5460fa8,
    53'h02c62e5a175235, 53'h02c8ef32bfa9aa, 53'h02cbbed65732dd, 53'h02ce9daf97e28b,
    53'h02d18c2d051dad, 53'h02d48ac1154d08, 53'h02d799e25d8933, 53'h02daba0bbf7e22,
    53'h02ddebbc99a779, 53'h02e12f78fa08f7, 53'h02e485c9d388b8, 53'h02e7ef3d361398,
    53'h02eb6c6689b6a9, 53'h02eefddeccdbbd, 53'h02f2a444d5da08, 53'h02f6603d980f67,
    53'h02fa32746cba6e, 53'h02fe1b9b5fd159, 53'h03810e35c08b24, 53'h03831ad29cd6d7,
    53'h03853408534086, 53'h03875a3efbde8f, 53'h03898de2eae067, 53'h038bcf64e5ec11,
    53'h038e1f3a5c92d8, 53'h03907ddda411ec, 53'h0392ebce3697e0, 53'h03956990f64c05,
    53'h0397f7b07459a4, 53'h039a96bd3c45e6, 53'h039d474e23dd23, 53'h03a00a00a00a01,
    53'h03a2df791eefb3, 53'h03a5c86367a79b, 53'h03a8c573000a8d, 53'h03abd76398f65a,
    53'h03aefef98189be, 53'h03b23d0221dad7, 53'h03b592547db792, 53'h03b8ffd1c00b90,
    53'h03bc8665cf947c, 53'h03c02707ed9c44, 53'h03c3e2bb5f80fb, 53'h03c7ba9023e386,
    53'h03cbafa3b469d3, 53'h03cfc321d51693, 53'h03d3f645725001, 53'h03d84a598ec916,
    53'h03dcc0ba429d29, 53'h03e15ad5cd0d97, 53'h03e61a2dba73d7, 53'h03eb005820210d,
    53'h03f00f00f00f01, 53'h03f547eb6675bb, 53'h03faacf3938dae, 53'h04802008020081,
    53'h048301a9c567c2, 53'h0485fc7797d8c0, 53'h0489119a22ab34, 53'h048c424b559b77,
    53'h048f8fd79f8b5c, 53'h0492fb9f4161ae, 53'h04968717bd8e5f, 53'h049a33cd67009b,
    53'h049e036512abe7, 53'h04a1f79def1361, 53'h04a6125385b782, 53'h04aa557feab551,
    53'h04aec33e1f6716, 53'h04b35dccad6930, 53'h04b82790800b83, 53'h04bd231802f48d,
    53'h04c2531e8d918e, 53'h04c7ba9023e386, 53'h04cd5c8d964f9f, 53'h04d33c710b5880,
    53'h04d95dd2ff9352, 53'h04dfc48fc9ce66, 53'h04e674cdb3419b, 53'h04ed7303b5cc0f,
    53'h04f4c400f4c401, 53'h04fc6cf507c3db, 53'h058239bc991de3, 53'h05866ecd533b9b,
    53'h058ad8f2fba939, 53'h058f7bb9f09636, 53'h05945afbcc6c5f, 53'h05997ae76b50f0,
    53'h059ee009ee009f, 53'h05a48f58de69bf, 53'h05aa8e3da06545, 53'h05b0e2a2600b0f,
    53'h05b79300b79301, 53'h05bea67250cd8c, 53'h05c624c3d25587, 53'h05ce168a772509,
    53'h05d6853cc0bbb5, 53'h05df7b4ec93887, 53'h05e90452d48972, 53'h05f32d1edf3a6c,
    53'h05fe03f80fe040, 53'h0684cc628fb127, 53'h068afea48364b8, 53'h0691a2b3c4d5e7,
    53'h0698c3bac74f5e, 53'h06a06e4bd421d8, 53'h06a8b098e00a8c, 53'h06b19ab5c45607,
    53'h06bb3ee721a54e, 53'h06c5b200c5b201, 53'h06d10bd72baffa, 53'h06dd67c8a60dd7,
    53'h06eae56403ab96, 53'h06f9a9342cdc68, 53'h0784eedd357c1c, 53'h078dda5202376a,
    53'h0797b425ed097c, 53'h07a29ecf163bb7, 53'h07aec33e1f6716, 53'h07bc52640bc527,
    53'h07cb8727c065c4, 53'h07dca8f158c7fa, 53'h07f00f00f00f01, 53'h0883126e978d50,
    53'h088fb823ee08fc, 53'h089e4cad23dd60, 53'h08af3addc680b0, 53'h08c30c30c30c31,
    53'h08da740da740db, 53'h08f6603d980f67, 53'h098c08c08c08c1, 53'h09a0a0a0a0a0a1,
    53'h09ba2e8ba2e8bb, 53'h09da740da740db, 53'h0a820820820821, 53'h0a9d89d89d89d9,
    53'h0ac30c30c30c31, 53'h0af83e0f83e0f9, 53'h0ba3d70a3d70a4, 53'h0be38e38e38e39,
    53'h0caaaaaaaaaaab, 53'h0d924924924925, 53'h0eaaaaaaaaaaab, 53'h11800000000000,
    53'h01810182028304, 53'h018206102860e3, 53'h01830db6cd631b, 53'h018418828c3905,
    53'h018526803ff980, 53'h018637bd05af6d, 53'h01874c463df158, 53'h018864298e84aa,
    53'h01897f74e40cbe, 53'h018a9e3673c644, 53'h018bc07cbd4f57, 53'h018ce6568c7caa,
    53'h018e0fd2fb3c45, 53'h018f3d0173863c, 53'h01906df1b15be3, 53'h0191a2b3c4d5e7,
    53'h0192db581441e2, 53'h019417ef5e4fdf, 53'h0195588abc5062, 53'h01969d3ba4837f,
    53'h0197e613ec7996, 53'h01993325cb864b, 53'h019a8483dd4669, 53'h019bda4124393b,
    53'h019d34710c6e2c, 53'h019e93276e4747, 53'h019ff678915158, 53'h01a15e792f3282,
    53'h01a2cb3e76aff6, 53'h01a43cde0ecbbc, 53'h01a5b36e19fb57, 53'h01a72f0539782a,
    53'h01a8afba90aa95, 53'h01aa35a5c8b0b2, 53'h01abc0df1401be, 53'h01ad517f322f39,
    53'h01aee79f73c4cc, 53'h01b08359be4819, 53'h01b224c89059af, 53'h01b3cc0705f847,
    53'h01b57930dce7a7, 53'h01b72c62793c71, 53'h01b8e5b8ea0e4d, 53'h01baa551ee51d7,
    53'h01bc6b4bf9dbe1, 53'h01be37c63a8f8c, 53'h01c00ae09db8ef, 53'h01c1e4bbd595f7,
    53'h01c3c5795f0f4d, 53'h01c5ad3b87a326, 53'h01c79c257383e7, 53'h01c9925b23ecb6,
    53'h01cb90017dae03, 53'h01cd953e4ff45c, 53'h01cfa2385b4bc4, 53'h01d1b71758e21a,
    53'h01d3d404020af4, 53'h01d5f9281807bc, 53'h01d826ae6c16b8, 53'h01da5cc2e7cbf8,
    53'h01dc9b9295b725, 53'h01dee34baa5968, 53'h01e1341d8d6ec1, 53'h01e38e38e38e39,
    53'h01e5f1cf9824a9, 53'h01e85f14e7cdda, 53'h01ead63d6b1009, 53'h01ed577f217df9,
    53'h01efe3117d4405, 53'h01f2792d6f24bc, 53'h01f51a0d72e9f5, 53'h01f7c5ed9c4f5e,
    53'h01fa7d0ba46bd9, 53'h01fd3fa6f79f4d, 53'h0280070062055d, 53'h0281742e044c5c,
    53'h0282e77ed24e7a, 53'h028461163408aa, 53'h0285e118923bff, 53'h028767ab5f34e5,
    53'h0288f4f51fec7a, 53'h028a891d758834, 53'h028c244d273c3a, 53'h028dc6ae2c94fa,
    53'h028f706bb82ce6, 53'h029121b242d364, 53'h0292daaf972a64, 53'h02949b92ddc026,
    53'h0296648ca9ab50, 53'h029835cf05af83, 53'h029a0f8d81f117, 53'h029bf1fd423f0d,
    53'h029ddd550cfa8f, 53'h029fd1cd5aa3cd, 53'h02a1cfa066147c, 53'h02a3d70a3d70a4,
    53'h02a5e848d3d6f8, 53'h02a8039c13da6e, 53'h02aa2945f2cf5d, 53'h02ac598a84f715,
    53'h02ae94b0129554, 53'h02b0daff2dfbf1, 53'h02b32cc2ca9985, 53'h02b58a485518d2,
    53'h02b7f3dfcc9f63, 53'h02ba69dbdd3ac2, 53'h02bcec91fb8c8e, 53'h02bf7c5a81c6c8,
    53'h02c21990ce0aa4, 53'h02c4c493623d65, 53'h02c77dc40567f9, 53'h02ca4587e6b750,
    53'h02cd1c47c234db, 53'h02d00270075016, 53'h02d2f871015388, 53'h02d5febf01e17e,
    53'h02d915d28d9674, 53'h02dc3e288af137, 53'h02df784273a2c3, 53'h02e2c4a6886a4d,
    53'h02e623e007a431, 53'h02e9967f66b53d, 53'h02ed1d1a8e7e76, 53'h02f0b84d1b08b3,
    53'h02f468b89e9a75, 53'h02f82f04e86e09, 53'h02fc0be04f41bd, 53'h03800000000000,
    53'h038206102860e3, 53'h038418828c3905, 53'h038637bd05af6d, 53'h038864298e84aa,
    53'h038a9e3673c644, 53'h038ce6568c7caa, 53'h038f3d0173863c, 53'h0391a2b3c4d5e7,
    53'h039417ef5e4fdf, 53'h03969d3ba4837f, 53'h03993325cb864b, 53'h039bda4124393b,
    53'h039e93276e4747, 53'h03a15e792f3282, 53'h03a43cde0ecbbc, 53'h03a72f0539782a,
    53'h03aa35a5c8b0b2, 53'h03ad517f322f39, 53'h03b08359be4819, 53'h03b3cc0705f847,
    53'h03b72c62793c71, 53'h03baa551ee51d7, 53'h03be37c63a8f8c, 53'h03c1e4bbd595f7,
    53'h03c5ad3b87a326, 53'h03c9925b23ecb6, 53'h03cd953e4ff45c, 53'h03d1b71758e21a,
    53'h03d5f9281807bc, 53'h03da5cc2e7cbf8, 53'h03dee34baa5968, 53'h03e38e38e38e39,
    53'h03e85f14e7cdda, 53'h03ed577f217df9, 53'h03f2792d6f24bc, 53'h03f7c5ed9c4f5e,
    53'h03fd3fa6f79f4d, 53'h0481742e044c5c, 53'h048461163408aa, 53'h048767ab5f34e5,
    53'h048a891d758834, 53'h048dc6ae2c94fa, 53'h049121b242d364, 53'h04949b92ddc026,
    53'h049835cf05af83, 53'h049bf1fd423f0d, 53'h049fd1cd5aa3cd, 53'h04a3d70a3d70a4,
    53'h04a8039c13da6e, 53'h04ac598a84f715, 53'h04b0daff2dfbf1, 53'h04b58a485518d2,
    53'h04ba69dbdd3ac2, 53'h04bf7c5a81c6c8, 53'h04c4c493623d65, 53'h04ca4587e6b750,
    53'h04d00270075016, 53'h04d5febf01e17e, 53'h04dc3e288af137, 53'h04e2c4a6886a4d,
    53'h04e9967f66b53d, 53'h04f0b84d1b08b3, 53'h04f82f04e86e09, 53'h05800000000000,
    53'h058418828c3905, 53'h058864298e84aa, 53'h058ce6568c7caa, 53'h0591a2b3c4d5e7,
    53'h05969d3ba4837f, 53'h059bda4124393b, 53'h05a15e792f3282, 53'h05a72f0539782a,
    53'h05ad517f322f39, 53'h05b3cc0705f847, 53'h05baa551ee51d7, 53'h05c1e4bbd595f7,
    53'h05c9925b23ecb6, 53'h05d1b71758e21a, 53'h05da5cc2e7cbf8, 53'h05e38e38e38e39,
    53'h05ed577f217df9, 53'h05f7c5ed9c4f5e, 53'h0681742e044c5c, 53'h068767ab5f34e5,
    53'h068dc6ae2c94fa, 53'h06949b92ddc026, 53'h069bf1fd423f0d, 53'h06a3d70a3d70a4,
    53'h06ac598a84f715, 53'h06b58a485518d2, 53'h06bf7c5a81c6c8, 53'h06ca4587e6b750,
    53'h06d5febf01e17e, 53'h06e2c4a6886a4d, 53'h06f0b84d1b08b3, 53'h07800000000000,
    53'h078864298e84aa, 53'h0791a2b3c4d5e7, 53'h079bda4124393b, 53'h07a72f0539782a,
    53'h07b3cc0705f847, 53'h07c1e4bbd595f7, 53'h07d1b71758e21a, 53'h07e38e38e38e39,
    53'h07f7c5ed9c4f5e, 53'h088767ab5f34e5, 53'h08949b92ddc026, 53'h08a3d70a3d70a4,
    53'h08b58a485518d2, 53'h08ca4587e6b750, 53'h08e2c4a6886a4d, 53'h09800000000000,
    53'h0991a2b3c4d5e7, 53'h09a72f0539782a, 53'h09c1e4bbd595f7, 53'h09e38e38e38e39,
    53'h0a8767ab5f34e5, 53'h0aa3d70a3d70a4, 53'h0aca4587e6b750, 53'h0b800000000000,
    53'h0ba72f0539782a, 53'h0be38e38e38e39, 53'h0ca3d70a3d70a4, 53'h0d800000000000,
    53'h0de38e38e38e39, 53'h0f800000000000, 53'h11800000000000, 53'h11800000000000
  };

endpackage
/* verilator lint_on UNUSEDPARAM */
