// SPDX-License-Identifier: Apache-2.0
//
// The last stage: turns final vertices and faces into the records of the output stream
// (docs/stream.md), and counts what it sends.
//
//   op -> next_q -> (4 x to_float) -> this_q -> vertex_records -> records_q -> pack -> m_axis
//            \                               \-> face_records --/
//             \________ looks ahead __________/
//
//   * One op a cycle, whatever its kind, and none is ever held up inside as long as pack is not.
//     An op gives at most 4 records; vertex_records and face_records make those of vertices and
//     of faces, the header and the trailer are made here.
//   * Vertices that follow each other are grouped by four. An op of another kind ends a group, and
//     so does another generation. A vertex may therefore wait for the op behind it.
//   * GROUP is four vertices that make a whole group of the stream, at their level. Its five records
//     are one more than fit a cycle, so every fifth cycle is a group's carry alone.
//   * FACES with an empty mask is taken and leaves no trace. Faces leave in the order of slots.
//   * OP_HEADER begins a packet and clears the counts; OP_TRAILER sends the trailer and the END
//     record and closes the packet. op_generation_i of the trailer is the last generation.
//   * view_i and exponent_i must not change from the header op to done_o; status_i and position_i
//     not from the trailer op to done_o.
//   * OP_TRAILER may overtake an op that was not taken, and end a polygon in the middle: what the view's
//     status then says is that it is of no use.
//   * Illegal: an op outside of a packet; a polygon whose corners are interrupted by another op;
//     sides, candidate or generation that differ between its corners; dropping op_valid_i or
//     changing an op before it was taken.
//   * Items, for the counters: vertices and faces. In: as ops (a polygon with its last corner).
//     Out: as position and FACE records in the beats that were taken.

module emit #(
    // Records a beat of the output stream: 1, 2 or 4.
    parameter int unsigned PORT_RECORDS = 4
) (
    input logic clk_i,
    input logic rst_i,

    // From smooth and split, by way of the top's arbiter: what to send.
    input  logic         op_valid_i,
    output logic         op_ready_o,
    input  logic [  2:0] op_kind_i,        // hs_pkg::OP_...
    input  logic [  7:0] op_generation_i,
    input  logic [ 23:0] op_number_i,      // VERTEX, CORNER: the vertex
    input  logic [127:0] op_position_i,    // VERTEX: x, y, z, w from bit 0 up, S1.30
    input  logic [383:0] op_group_i,       // GROUP: positions of vertices 1 to 3; their numbers are
                                           // in op_vertex_i, 24 bits each
    input  logic         op_at_level_i,    // VERTEX: leaves where its level has it, not at the limit
    input  logic [  3:0] op_mask_i,        // FACES: slots in use
    input  logic [  3:0] op_triangle_i,    // FACES: the slot has 3 sides, not 4
    input  logic [  3:0] op_child_i,       // FACES: the slot's face left a generation later
    input  logic [  3:0] op_candidate_i,   // FACES; CORNER: bit 0
    input  logic [383:0] op_vertex_i,      // FACES: vertex k of slot s in 24 bits at 24*(4*s+k)
    input  logic [  7:0] op_sides_i,       // CORNER: 3 to 255
    input  logic         op_first_i,       // CORNER: the polygon's first
    input  logic         op_last_i,        // CORNER: the polygon's last

    // From the view's control.
    input  logic        [15:0] view_i,
    input  logic signed [ 9:0] exponent_i,  // E: positions are q * 2^(E-30)
    input  logic        [ 7:0] status_i,    // hs_pkg::STATUS_...
    input  logic        [31:0] position_i,  // of the word at fault, or NO_POSITION
    output logic               done_o,      // a pulse behind the packet's last beat

    // The output stream.
    output logic                        m_axis_tvalid,
    input  logic                        m_axis_tready,
    output logic [128*PORT_RECORDS-1:0] m_axis_tdata,
    output logic [ 16*PORT_RECORDS-1:0] m_axis_tkeep,
    output logic                        m_axis_tlast,
    output logic [                15:0] m_axis_tid,

    // To the counters.
    output logic       busy_o,
    output logic       starved_o,
    output logic       blocked_o,
    output logic [2:0] items_in_o,
    output logic [2:0] items_out_o
);

  localparam logic [2:0] HEADER = 3'(hs_pkg::OP_HEADER);
  localparam logic [2:0] VERTEX = 3'(hs_pkg::OP_VERTEX);
  localparam logic [2:0] FACES = 3'(hs_pkg::OP_FACES);
  localparam logic [2:0] CORNER = 3'(hs_pkg::OP_CORNER);
  localparam logic [2:0] TRAILER = 3'(hs_pkg::OP_TRAILER);
  localparam logic [2:0] GROUP = 3'(hs_pkg::OP_GROUP);
  localparam logic [8:0] TAG = 9'(hs_pkg::TAG);

  // An op without its position, in one word:
  // {at_level, vertex, mask, triangle, child, candidate, sides, first, last, number, generation, kind}
  localparam int unsigned OP_BITS = 1 + 384 + 4 + 4 + 4 + 4 + 8 + 1 + 1 + 24 + 8 + 3;

  // --- The op that comes next, as it was given ---------------------------------------------------
  logic next_valid_q, next_taken;
  logic [OP_BITS-1:0] next_q;
  logic [511:0] next_position_q;
  logic [511:0] next_float;  // as binary32
  logic [2:0] next_kind;
  logic [7:0] next_generation;
  logic [23:0] next_number;
  logic leaves_trace;

  assign op_ready_o   = !next_valid_q || next_taken;
  assign leaves_trace = op_kind_i != FACES || op_mask_i != 4'd0;

  always_ff @(posedge clk_i) begin
    if (op_ready_o) next_valid_q <= op_valid_i && leaves_trace;
    if (op_ready_o && op_valid_i) begin
      next_q <= {op_at_level_i, op_vertex_i, op_mask_i, op_triangle_i, op_child_i, op_candidate_i,
                 op_sides_i, op_first_i, op_last_i, op_number_i, op_generation_i, op_kind_i};
      next_position_q <= {op_kind_i == GROUP ? op_group_i : 384'd0, op_position_i};
    end
    if (rst_i) next_valid_q <= 1'b0;
  end

  assign next_kind = next_q[2:0];
  assign next_generation = next_q[10:3];
  assign next_number = next_q[34:11];

  genvar c;
  generate
    for (c = 0; c < 16; c = c + 1) begin : gen_component
      to_float convert (
          .q_i(next_position_q[32*c+:32]), .exponent_i, .c_o(next_float[32*c+:32])
      );
    end
  endgenerate

  // --- The op whose records are made now ---------------------------------------------------------
  logic valid_q, go;
  logic [OP_BITS-1:0] this_q;
  logic [511:0] float_q;
  logic [2:0] kind;
  logic [7:0] generation, sides;
  logic [23:0] number;
  logic [3:0] mask, triangle, child, candidate;
  logic [383:0] vertex;
  logic first, last, at_level;

  assign next_taken = next_valid_q && (!valid_q || go);

  always_ff @(posedge clk_i) begin
    if (!valid_q || go) valid_q <= next_valid_q;
    if (next_taken) begin
      this_q  <= next_q;
      float_q <= next_float;
    end
    if (rst_i) valid_q <= 1'b0;
  end

  assign {at_level, vertex, mask, triangle, child, candidate, sides, first, last, number, generation,
          kind} = this_q;

  // --- What vertices and faces become ------------------------------------------------------------
  logic go_vertex, go_face, vertex_waits;
  logic [511:0] vertex_records, face_records;
  logic [2:0] vertex_count, face_count;  // records
  logic [2:0] complete, complete_triangles;  // faces that are complete with this op

  assign go_vertex = go && kind == VERTEX;
  assign go_face   = go && (kind == FACES || kind == CORNER);

  vertex_records u_vertices (
      .clk_i, .rst_i, .take_i(go_vertex), .generation_i(generation), .number_i(number),
      .position_i(float_q[127:0]), .next_valid_i(next_valid_q),
      .next_joins_i(next_kind == VERTEX && next_generation == generation),
      .next_number_i(next_number), .waits_o(vertex_waits), .count_o(vertex_count),
      .records_o(vertex_records)
  );

  face_records u_faces (
      .clk_i, .rst_i, .take_i(go_face), .polygon_i(kind == CORNER), .generation_i(generation),
      .candidate_i(candidate), .mask_i(mask), .triangle_i(triangle), .child_i(child),
      .vertex_i(vertex), .number_i(number), .sides_i(sides), .first_i(first), .last_i(last),
      .count_o(face_count), .records_o(face_records), .faces_o(complete),
      .triangles_o(complete_triangles)
  );

  // --- A group's five records: what has no room in this cycle's four is carried over ---------------
  logic free;
  logic [511:0] carry_q;  // its lowest carry_count_q records
  logic [2:0] carry_count_q;
  logic [1151:0] window;  // what is carried, and a group behind it
  logic [639:0] group_records;
  logic carry_first;  // what is carried goes before this op

  assign group_records = {
    float_q, vertex[71:0], number,
    TAG, hs_pkg::RECORD_VERTICES, 1'b0, 3'd4, 8'd0, generation
  };
  assign carry_first = carry_count_q == 3'd4 || (carry_count_q != 3'd0 && kind != GROUP);

  always_comb begin
    unique case (carry_count_q)
      3'd0: window = {512'd0, group_records};
      3'd1: window = {384'd0, group_records, carry_q[127:0]};
      3'd2: window = {256'd0, group_records, carry_q[255:0]};
      3'd3: window = {128'd0, group_records, carry_q[383:0]};
      default: window = {640'd0, carry_q};
    endcase
  end

  always_ff @(posedge clk_i) begin
    if (go && kind == GROUP) begin
      carry_q <= 512'(window >> 512);
      carry_count_q <= carry_count_q + 3'd1;
    end else if (valid_q && free && carry_first) begin
      carry_count_q <= 3'd0;
    end
    if (rst_i) carry_count_q <= 3'd0;
  end

  // --- The records of this op --------------------------------------------------------------------
  logic [31:0] vertices_q, at_level_q, faces_q, triangles_q;  // sent in this packet
  logic [511:0] records;
  logic [  2:0] count;

  always_comb begin
    records = 512'd0;
    unique case (kind)
      HEADER: begin
        records[127:0] = {
          32'd0, {{22{exponent_i[9]}}, exponent_i}, {16'd0, view_i},
          TAG, hs_pkg::RECORD_HEADER, 12'd0, 8'(hs_pkg::STREAM_VERSION)
        };
        count = 3'd1;
      end
      VERTEX: begin
        records = vertex_records;
        count   = vertex_count;
      end
      FACES, CORNER: begin
        records = face_records;
        count   = face_count;
      end
      GROUP: begin
        records = window[511:0];
        count   = 3'd4;
      end
      default: begin  // TRAILER; pack puts the CRC into END's last word
        records[255:0] = {
          32'd0, at_level_q, triangles_q, TAG, hs_pkg::RECORD_END, 12'd0, generation,
          faces_q, vertices_q, position_i, TAG, hs_pkg::RECORD_TRAILER, 12'd0, status_i
        };
        count = 3'd2;
      end
    endcase
    if (carry_first) begin
      records = carry_q;
      count   = carry_count_q;
    end
  end

  assign go = valid_q && free && !carry_first && !(kind == VERTEX && vertex_waits);

  always_ff @(posedge clk_i) begin
    if (go && kind == HEADER) begin
      vertices_q  <= 32'd0;
      at_level_q  <= 32'd0;
      faces_q     <= 32'd0;
      triangles_q <= 32'd0;
    end
    if (go_vertex) begin
      vertices_q <= vertices_q + 32'd1;
      at_level_q <= at_level_q + {31'd0, at_level};
    end
    if (go && kind == GROUP) vertices_q <= vertices_q + 32'd4;
    if (go_face) begin
      faces_q     <= faces_q + {29'd0, complete};
      triangles_q <= triangles_q + {29'd0, complete_triangles};
    end
  end

  // --- To pack -----------------------------------------------------------------------------------
  logic records_valid_q, records_last_q, pack_ready;
  logic [511:0] records_q;
  logic [  2:0] count_q;

  assign free = !records_valid_q || pack_ready;

  always_ff @(posedge clk_i) begin
    if (free) records_valid_q <= (go || (valid_q && carry_first)) && count != 3'd0;
    if (free && valid_q) begin
      records_q <= records;
      count_q <= count;
      records_last_q <= kind == TRAILER && !carry_first;
    end
    if (rst_i) records_valid_q <= 1'b0;
  end

  pack #(
      .PORT_RECORDS(PORT_RECORDS)
  ) u_pack (
      .clk_i, .rst_i, .valid_i(records_valid_q), .ready_o(pack_ready), .count_i(count_q),
      .records_i(records_q), .last_i(records_last_q), .view_i, .m_axis_tvalid, .m_axis_tready,
      .m_axis_tdata, .m_axis_tkeep, .m_axis_tlast, .m_axis_tid, .done_o
  );

  // --- For the counters --------------------------------------------------------------------------
  logic working_q;  // from the header op to the last beat
  logic taken, given;

  assign taken = op_valid_i && op_ready_o;
  assign given = m_axis_tvalid && m_axis_tready;
  assign busy_o = taken;
  assign blocked_o = op_valid_i && !op_ready_o;
  assign starved_o = !op_valid_i && working_q;

  always_ff @(posedge clk_i) begin
    if (taken && op_kind_i == HEADER) working_q <= 1'b1;
    else if (given && m_axis_tlast) working_q <= 1'b0;
    if (rst_i) working_q <= 1'b0;
  end

  always_comb begin
    items_in_o = 3'd0;
    if (taken && op_kind_i == VERTEX) items_in_o = 3'd1;
    if (taken && op_kind_i == GROUP) items_in_o = 3'd4;
    if (taken && op_kind_i == CORNER) items_in_o = {2'd0, op_last_i};
    if (taken && op_kind_i == FACES)
      items_in_o = {2'd0, op_mask_i[0]} + {2'd0, op_mask_i[1]} + {2'd0, op_mask_i[2]}
                 + {2'd0, op_mask_i[3]};
  end

  logic [PORT_RECORDS-1:0] item;
  genvar r;
  generate
    for (r = 0; r < PORT_RECORDS; r = r + 1) begin : gen_item
      assign item[r] = given && m_axis_tkeep[16*r] && (m_axis_tdata[128*r+23+:9] != TAG
                       || m_axis_tdata[128*r+20+:3] == hs_pkg::RECORD_FACE);
    end
  endgenerate

  integer n;
  always_comb begin
    items_out_o = 3'd0;
    for (n = 0; n < PORT_RECORDS; n = n + 1) items_out_o = items_out_o + {2'd0, item[n]};
  end

`ifndef YOSYS
  // What the users owe.
  op_stays :
  assert property (@(posedge clk_i) disable iff (rst_i)
      op_valid_i && !op_ready_o |=> op_valid_i &&
      (op_kind_i == TRAILER || ($stable(op_kind_i) && $stable(op_number_i))))
  else $error("emit: an op was withdrawn before it was taken");
`ifdef HS_ASSERT_DATA
  op_keeps :
  assert property (@(posedge clk_i) disable iff (rst_i)
      op_valid_i && !op_ready_o |=> op_kind_i == TRAILER || $stable(
      {op_kind_i, op_generation_i, op_number_i, op_position_i, op_group_i, op_at_level_i, op_mask_i,
       op_triangle_i, op_child_i, op_candidate_i, op_vertex_i, op_sides_i, op_first_i, op_last_i}))
  else $error("emit: an op changed before it was taken");
`endif
  op_is_known :
  assert property (@(posedge clk_i) disable iff (rst_i)
      op_valid_i |-> op_kind_i <= GROUP && (op_kind_i == HEADER || working_q))
  else $error("emit: an op that does not exist, or outside of a packet");
`endif

endmodule
