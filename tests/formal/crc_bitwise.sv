// SPDX-License-Identifier: Apache-2.0
//
// Proof for crc32.sv: a record's step is that of the definition, bit by bit: crc32 ^ bit_by_bit = 0, for
// all states and records. What is left of both when END is a constant are exclusive ors alone, so the
// difference is affine, and vanishes if it does for zero and for every single bit: these are tried.

module crc_bitwise #(
    // 1: the record is a packet's last, of which 12 bytes count.
    parameter int unsigned END = 0
) (
    input  logic [ 31:0] crc_i,
    input  logic [127:0] data_i,
    output logic [ 31:0] difference_o
);

  // IEEE 802.3, as its hardware is drawn: a bit a time, bits 7:0 of a byte from the lowest up.
  function automatic logic [31:0] bit_by_bit(input logic [31:0] state, input logic [127:0] data);
    integer i;
    begin
      bit_by_bit = state;
      for (i = 0; i < (END != 0 ? 96 : 128); i = i + 1)
        bit_by_bit = {1'b0, bit_by_bit[31:1]} ^ (32'hedb88320 & {32{bit_by_bit[0] ^ data[i]}});
    end
  endfunction

  logic [31:0] crc;

  crc32 u_crc32 (
      .enable_i(1'b1),
      .end_i(END != 0),
      .crc_i,
      .data_i,
      .crc_o(crc)
  );
  assign difference_o = crc ^ bit_by_bit(crc_i, data_i);

`ifdef HS_FORMAL
  // Zero, and every single bit.
  (* anyconst *) logic [7:0] f_bit;
  always_comb assume ({data_i, crc_i} == 160'd1 << f_bit);
  always_comb assert (difference_o == 32'd0);
`endif

endmodule
