// SPDX-License-Identifier: Apache-2.0
//
// One step of CRC-32 (IEEE 802.3: zlib's, reflected polynomial 0xEDB88320) over a record of
// 16 bytes, bits 7:0 first. Combinational.
//
//   crc_o = crc32(crc_i, data_i)          with enable_i; without it, crc_o = crc_i
//   crc_o = crc32(crc_i, data_i[95:0])    with enable_i and end_i: the record's last word will be
//                                         the CRC itself
//
//   * The state before the first record is 32'hffffffff; the CRC of a packet is the inverse of
//     the state behind its last record. Both are the user's business.
//
// A step is linear over GF(2): with m = data_i ^ crc_i (in the low 32 bits, where the state meets
// the first four bytes), every bit of crc_o is the parity of m under a constant mask. The 32 masks
// come from the polynomial at elaboration. What 12 bytes do to the state, they do too as the last 12
// of 16 if the state meets them, and not the first four, which are zero.

module crc32 (
    input  logic         enable_i,  // spares a simulation the sums when there is no record
    input  logic         end_i,
    input  logic [ 31:0] crc_i,
    input  logic [127:0] data_i,
    output logic [ 31:0] crc_o
);

  localparam logic [31:0] POLYNOMIAL = 32'hedb88320;

  // The masks, mask of output bit b in bits 128*b+127:128*b. column is what a single 1 in bit i of
  // m leaves in the state: bit 127 is shifted once, each bit below it once more.
  function automatic logic [4095:0] masks(input logic [31:0] polynomial);
    logic [31:0] column;
    integer i, b;
    begin
      masks  = '0;
      column = 32'd1;
      for (i = 127; i >= 0; i = i - 1) begin
        column = (column >> 1) ^ (column[0] ? polynomial : 32'd0);
        for (b = 0; b < 32; b = b + 1) masks[128*b+i] = column[b];
      end
    end
  endfunction

  localparam logic [4095:0] MASKS = masks(POLYNOMIAL);

  logic [127:0] mixed;
  assign mixed = end_i ? {data_i[95:0] ^ {64'd0, crc_i}, 32'd0} : data_i ^ {96'd0, crc_i};

  integer b;
  always_comb begin
    b = 0;
    crc_o = crc_i;
    if (enable_i) for (b = 0; b < 32; b = b + 1) crc_o[b] = ^(mixed & MASKS[128*b+:128]);
  end

endmodule
