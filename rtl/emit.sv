// SPDX-License-Identifier: Apache-2.0
//
// The last stage: turns final vertices and faces into the records of the output stream
// (docs/stream.md), and counts what it sends.
//
//   op -> next_q -> (4 x to_float) -> this_q -> records_q -> pack -> m_axis
//            \________ looks ahead ______/
//
//   * One op a cycle, whatever its kind, and none is ever held up inside as long as pack is not.
//     An op gives at most 4 records: of 4 vertices that share a VERTICES record the third sends
//     that record and three positions, because the op behind it is already known to be the fourth,
//     and the fourth sends its own position.
//   * Vertices that follow each other are grouped by four. An op of another kind ends a group, and
//     so does another generation. A vertex may therefore wait for the op behind it.
//   * FACES with an empty mask is taken and leaves no trace. Faces leave in the order of slots.
//   * OP_HEADER begins a packet and clears the counts; OP_TRAILER sends the trailer and the END
//     record and closes the packet. op_generation_i of the trailer is the last generation.
//   * view_i and exponent_i must not change from the header op to done_o; status_i and position_i
//     not from the trailer op to done_o.
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
  localparam logic [8:0] TAG = 9'(hs_pkg::TAG);

  // An op without its position, in one word:
  // {vertex, mask, triangle, child, candidate, sides, first, last, number, generation, kind}
  localparam int unsigned OP_BITS = 384 + 4 + 4 + 4 + 4 + 8 + 1 + 1 + 24 + 8 + 3;

  // --- The op that comes next, as it was given ---------------------------------------------------
  logic next_valid_q, next_taken;
  logic [OP_BITS-1:0] next_q;
  logic [127:0] next_position_q;
  logic [127:0] next_float;  // as binary32
  logic [2:0] next_kind;
  logic [7:0] next_generation;
  logic [23:0] next_number;
  logic leaves_trace;

  assign op_ready_o   = !next_valid_q || next_taken;
  assign leaves_trace = op_kind_i != FACES || op_mask_i != 4'd0;

  always_ff @(posedge clk_i) begin
    if (op_ready_o) next_valid_q <= op_valid_i && leaves_trace;
    if (op_ready_o && op_valid_i) begin
      next_q <= {op_vertex_i, op_mask_i, op_triangle_i, op_child_i, op_candidate_i, op_sides_i,
                 op_first_i, op_last_i, op_number_i, op_generation_i, op_kind_i};
      next_position_q <= op_position_i;
    end
    if (rst_i) next_valid_q <= 1'b0;
  end

  assign next_kind = next_q[2:0];
  assign next_generation = next_q[10:3];
  assign next_number = next_q[34:11];

  genvar c;
  generate
    for (c = 0; c < 4; c = c + 1) begin : gen_component
      to_float convert (
          .q_i       (next_position_q[32*c+:32]),
          .exponent_i(exponent_i),
          .c_o       (next_float[32*c+:32])
      );
    end
  endgenerate

  // --- The op whose records are made now ---------------------------------------------------------
  logic valid_q, go;
  logic [OP_BITS-1:0] this_q;
  logic [127:0] float_q;
  logic [2:0] kind;
  logic [7:0] generation, sides;
  logic [23:0] number;
  logic [3:0] mask, triangle, child, candidate;
  logic [383:0] vertex;
  logic first, last;

  assign next_taken = next_valid_q && (!valid_q || go);

  always_ff @(posedge clk_i) begin
    if (!valid_q || go) valid_q <= next_valid_q;
    if (next_taken) begin
      this_q  <= next_q;
      float_q <= next_float;
    end
    if (rst_i) valid_q <= 1'b0;
  end

  assign {vertex, mask, triangle, child, candidate, sides, first, last, number, generation, kind} =
      this_q;

  // --- Vertices: who is in the group -------------------------------------------------------------
  logic [1:0] grouped_q;  // vertices of the group before this one
  logic [47:0] group_number_q;  // the numbers of the first two
  logic [255:0] group_float_q;  // and their positions
  logic next_joins, group_sends, group_closes;
  logic [ 95:0] group_numbers;
  logic [383:0] group_floats;
  logic [  2:0] group_count;  // as the VERTICES record says it

  assign next_joins = next_valid_q && next_kind == VERTEX && next_generation == generation;
  // The fourth of a group has no one to wait for, its record is gone already.
  assign group_closes = grouped_q == 2'd3 || !next_joins;
  assign group_sends = grouped_q != 2'd3 && (!next_joins || grouped_q == 2'd2);
  assign group_count = {1'b0, grouped_q} + 3'd1 + {2'd0, next_joins};

  always_comb begin
    unique case (grouped_q)
      2'd0: group_numbers = {72'd0, number};
      2'd1: group_numbers = {48'd0, number, group_number_q[23:0]};
      default: group_numbers = {next_joins ? next_number : 24'd0, number, group_number_q};
    endcase
    unique case (grouped_q)
      2'd0: group_floats = {256'd0, float_q};
      2'd1: group_floats = {128'd0, float_q, group_float_q[127:0]};
      default: group_floats = {float_q, group_float_q};
    endcase
  end

  // --- Polygons: the corners of the record in the making -----------------------------------------
  logic [1:0] cornered_q;  // corners that wait for their record
  logic [71:0] corner_number_q;  // their numbers, the first lowest
  logic opened_q;  // the polygon's FACE record is gone; what comes is MORE
  logic [1:0] corners;
  logic opened, corner_sends;
  logic [95:0] corner_numbers;

  // A polygon's first corner starts anew, whatever was left behind.
  assign corners = first ? 2'd0 : cornered_q;
  assign opened = !first && opened_q;
  assign corner_sends = last || corners == 2'd3;

  always_comb begin
    unique case (corners)
      2'd0: corner_numbers = {72'd0, number};
      2'd1: corner_numbers = {48'd0, number, corner_number_q[23:0]};
      2'd2: corner_numbers = {24'd0, number, corner_number_q[47:0]};
      default: corner_numbers = {number, corner_number_q};
    endcase
  end

  // --- Faces: a record for each slot in use, close together --------------------------------------
  logic [511:0] face;  // the record of slot s in bits 128*s+127:128*s
  logic [511:0] faces;  // those in use, without gaps, zeros behind them
  logic [2:0] face_count, triangle_count;

  genvar s;
  generate
    for (s = 0; s < 4; s = s + 1) begin : gen_face
      assign face[128*s+:128] = {
        triangle[s] ? 24'd0 : vertex[24*(4*s+3)+:24],
        vertex[24*(4*s)+:72],
        TAG,
        hs_pkg::RECORD_FACE,
        3'd0,
        candidate[s],
        triangle[s] ? 8'd3 : 8'd4,
        generation + {7'd0, child[s]}
      };
    end
  endgenerate

  always_comb begin
    faces = mask[3] ? {384'd0, face[511:384]} : 512'd0;
    if (mask[2]) faces = {faces[383:0], face[383:256]};
    if (mask[1]) faces = {faces[383:0], face[255:128]};
    if (mask[0]) faces = {faces[383:0], face[127:0]};
    face_count = {2'd0, mask[0]} + {2'd0, mask[1]} + {2'd0, mask[2]} + {2'd0, mask[3]};
    triangle_count = {2'd0, mask[0] & triangle[0]} + {2'd0, mask[1] & triangle[1]}
                   + {2'd0, mask[2] & triangle[2]} + {2'd0, mask[3] & triangle[3]};
  end

  // --- The records of this op --------------------------------------------------------------------
  logic [31:0] vertices_q, faces_q, triangles_q;  // sent in this packet
  logic [511:0] records;
  logic [  2:0] count;

  always_comb begin
    records = 512'd0;
    count   = 3'd0;
    unique case (kind)
      HEADER: begin
        records[127:0] = {
          32'd0, {{22{exponent_i[9]}}, exponent_i}, {16'd0, view_i},
          TAG, hs_pkg::RECORD_HEADER, 12'd0, 8'(hs_pkg::STREAM_VERSION)
        };
        count = 3'd1;
      end
      VERTEX: begin
        if (group_sends) begin
          records = {
            group_floats, group_numbers,
            TAG, hs_pkg::RECORD_VERTICES, 1'b0, group_count, 8'd0, generation
          };
          count = 3'd2 + {1'b0, grouped_q};
        end else if (grouped_q == 2'd3) begin
          records[127:0] = float_q;
          count = 3'd1;
        end
      end
      FACES: begin
        records = faces;
        count   = face_count;
      end
      CORNER: begin
        if (corner_sends) begin
          records[127:0] = {
            corner_numbers, TAG,
            opened ? {hs_pkg::RECORD_MORE, 4'd0, 8'd1 + {6'd0, corners}}
                   : {hs_pkg::RECORD_FACE, 3'd0, candidate[0], sides},
            generation
          };
          count = 3'd1;
        end
      end
      default: begin  // TRAILER; pack puts the CRC into END's last word
        records[255:0] = {
          32'd0, 32'd0, triangles_q, TAG, hs_pkg::RECORD_END, 12'd0, generation,
          faces_q, vertices_q, position_i, TAG, hs_pkg::RECORD_TRAILER, 12'd0, status_i
        };
        count = 3'd2;
      end
    endcase
  end

  // A vertex that is not its group's fourth must know what follows it.
  logic free;
  assign go = valid_q && free && (kind != VERTEX || grouped_q == 2'd3 || next_valid_q);

  always_ff @(posedge clk_i) begin
    if (go) begin
      unique case (kind)
        HEADER: begin
          vertices_q  <= 32'd0;
          faces_q     <= 32'd0;
          triangles_q <= 32'd0;
        end
        VERTEX: begin
          vertices_q <= vertices_q + 32'd1;
          grouped_q  <= group_closes ? 2'd0 : grouped_q + 2'd1;
          group_number_q <= group_numbers[47:0];
          group_float_q  <= group_floats[255:0];
        end
        FACES: begin
          faces_q <= faces_q + {29'd0, face_count};
          triangles_q <= triangles_q + {29'd0, triangle_count};
        end
        CORNER: begin
          cornered_q <= corner_sends ? 2'd0 : corners + 2'd1;
          corner_number_q <= corner_numbers[71:0];
          opened_q <= opened || corner_sends;
          if (last) begin
            faces_q <= faces_q + 32'd1;
            if (sides == 8'd3) triangles_q <= triangles_q + 32'd1;
          end
        end
        default: ;
      endcase
    end
    if (rst_i) grouped_q <= 2'd0;
  end

  // --- To pack -----------------------------------------------------------------------------------
  logic records_valid_q, records_last_q, pack_ready;
  logic [511:0] records_q;
  logic [  2:0] count_q;

  assign free = !records_valid_q || pack_ready;

  always_ff @(posedge clk_i) begin
    if (free) records_valid_q <= go && count != 3'd0;
    if (go) begin
      records_q <= records;
      count_q <= count;
      records_last_q <= kind == TRAILER;
    end
    if (rst_i) records_valid_q <= 1'b0;
  end

  pack #(
      .PORT_RECORDS(PORT_RECORDS)
  ) pack (
      .clk_i        (clk_i),
      .rst_i        (rst_i),
      .valid_i      (records_valid_q),
      .ready_o      (pack_ready),
      .count_i      (count_q),
      .records_i    (records_q),
      .last_i       (records_last_q),
      .view_i       (view_i),
      .m_axis_tvalid(m_axis_tvalid),
      .m_axis_tready(m_axis_tready),
      .m_axis_tdata (m_axis_tdata),
      .m_axis_tkeep (m_axis_tkeep),
      .m_axis_tlast (m_axis_tlast),
      .m_axis_tid   (m_axis_tid),
      .done_o       (done_o)
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
      op_valid_i && !op_ready_o |=> op_valid_i && $stable(
      {op_kind_i, op_generation_i, op_number_i, op_position_i, op_mask_i, op_triangle_i,
       op_child_i, op_candidate_i, op_vertex_i, op_sides_i, op_first_i, op_last_i}))
  else $error("emit: an op was withdrawn before it was taken");
  op_is_known :
  assert property (@(posedge clk_i) disable iff (rst_i)
      op_valid_i |-> op_kind_i <= TRAILER && (op_kind_i == HEADER || working_q))
  else $error("emit: an op that does not exist, or outside of a packet");
  polygon_begins :
  assert property (@(posedge clk_i) disable iff (rst_i)
      go && kind == CORNER && !opened_q && cornered_q == 2'd0 |-> first)
  else $error("emit: a polygon without a first corner");
`endif

endmodule
