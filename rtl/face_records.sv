// SPDX-License-Identifier: Apache-2.0
//
// face_records: the part of emit that makes the records of faces. An op is either up to four faces
// with 3 or 4 sides, a FACE record each, or one corner of a polygon with any number of sides:
//
//   corner of the polygon    1  2  3  4     5  6  7  8     9 ...    last
//   record                   -  -  -  FACE  -  -  -  MORE  - ...    FACE or MORE
//
//   * The op shown is taken with take_i; records_o, count_o, faces_o and triangles_o are what it
//     gives then. Faces leave in the order of slots, those in use close together.
//   * A face whose child_i is set left a generation later than generation_i says.
//   * A polygon's first corner starts anew, whatever was left behind.
//   * Illegal: a polygon that begins without first_i; sides, candidate or generation that differ
//     between its corners.

module face_records (
    input logic clk_i,
    input logic rst_i,

    // The op.
    input logic         take_i,
    input logic         polygon_i,     // a polygon's corner, not faces
    input logic [  7:0] generation_i,
    input logic [  3:0] candidate_i,   // of each slot; polygon: bit 0
    input logic [  3:0] mask_i,        // faces: slots in use
    input logic [  3:0] triangle_i,    // faces: the slot has 3 sides, not 4
    input logic [  3:0] child_i,       // faces
    input logic [383:0] vertex_i,      // faces: vertex k of slot s in 24 bits at 24*(4*s+k)
    input logic [ 23:0] number_i,      // polygon: the corner's vertex
    input logic [  7:0] sides_i,       // polygon: 3 to 255
    input logic         first_i,       // polygon: its first corner
    input logic         last_i,        // polygon: its last corner

    // Record k of count_o in bits 128*k+127:128*k, zeros behind them.
    output logic [  2:0] count_o,     // 0 to 4
    output logic [511:0] records_o,
    output logic [  2:0] faces_o,     // faces that are complete with this op
    output logic [  2:0] triangles_o  // and those of them with 3 sides
);

  localparam logic [8:0] TAG = 9'(hs_pkg::TAG);

  // --- Faces: a record for each slot in use, close together --------------------------------------
  logic [511:0] face;  // the record of slot s in bits 128*s+127:128*s
  logic [511:0] faces;  // those in use, without gaps, zeros behind them
  logic [2:0] face_count, triangle_count;

  genvar s;
  generate
    for (s = 0; s < 4; s = s + 1) begin : gen_face
      assign face[128*s+:128] = {
        triangle_i[s] ? 24'd0 : vertex_i[24*(4*s+3)+:24],
        vertex_i[24*(4*s)+:72],
        TAG,
        hs_pkg::RECORD_FACE,
        3'd0,
        candidate_i[s],
        triangle_i[s] ? 8'd3 : 8'd4,
        generation_i + {7'd0, child_i[s]}
      };
    end
  endgenerate

  always_comb begin
    faces = mask_i[3] ? {384'd0, face[511:384]} : 512'd0;
    if (mask_i[2]) faces = {faces[383:0], face[383:256]};
    if (mask_i[1]) faces = {faces[383:0], face[255:128]};
    if (mask_i[0]) faces = {faces[383:0], face[127:0]};
    face_count = {2'd0, mask_i[0]} + {2'd0, mask_i[1]} + {2'd0, mask_i[2]} + {2'd0, mask_i[3]};
    triangle_count = {2'd0, mask_i[0] & triangle_i[0]} + {2'd0, mask_i[1] & triangle_i[1]}
                   + {2'd0, mask_i[2] & triangle_i[2]} + {2'd0, mask_i[3] & triangle_i[3]};
  end

  // --- Polygons: the corners of the record in the making -----------------------------------------
  logic [1:0] waiting_q, waiting;  // corners that wait for their record
  logic [71:0] numbers_q;  // their numbers, the first lowest
  logic [95:0] numbers;
  logic opened_q, opened;  // the polygon's FACE record is gone; what comes is MORE
  logic corner_sends;
  logic [127:0] corner_record;

  assign waiting = first_i ? 2'd0 : waiting_q;
  assign opened = !first_i && opened_q;
  assign corner_sends = last_i || waiting == 2'd3;

  always_comb begin
    unique case (waiting)
      2'd0: numbers = {72'd0, number_i};
      2'd1: numbers = {48'd0, number_i, numbers_q[23:0]};
      2'd2: numbers = {24'd0, number_i, numbers_q[47:0]};
      default: numbers = {number_i, numbers_q};
    endcase
    corner_record = {
      numbers, TAG,
      opened ? {hs_pkg::RECORD_MORE, 4'd0, 8'd1 + {6'd0, waiting}}
             : {hs_pkg::RECORD_FACE, 3'd0, candidate_i[0], sides_i},
      generation_i
    };
  end

  always_ff @(posedge clk_i) begin
    if (take_i && polygon_i) begin
      waiting_q <= corner_sends ? 2'd0 : waiting + 2'd1;
      numbers_q <= numbers[71:0];
      opened_q  <= !last_i && (opened || corner_sends);
    end
    if (rst_i) begin
      waiting_q <= 2'd0;
      opened_q  <= 1'b0;
    end
  end

  // --- The one or the other ----------------------------------------------------------------------
  always_comb begin
    records_o = faces;
    count_o = face_count;
    faces_o = face_count;
    triangles_o = triangle_count;
    if (polygon_i) begin
      records_o = corner_sends ? {384'd0, corner_record} : 512'd0;
      count_o = {2'd0, corner_sends};
      faces_o = {2'd0, last_i};
      triangles_o = {2'd0, last_i && sides_i == 8'd3};
    end
  end

`ifndef YOSYS
  polygon_begins :
  assert property (@(posedge clk_i) disable iff (rst_i)
      take_i && polygon_i && !opened_q && waiting_q == 2'd0 |-> first_i)
  else $error("face_records: a polygon without a first corner");
`endif

endmodule
