// SPDX-License-Identifier: Apache-2.0
//
// Brings those words of a row that are wanted, at most four, close together, the lowest bank first,
// each with its number. Combinational.

module row_lanes #(
    parameter int unsigned WIDTH = 128,
    parameter int unsigned ROW_BITS = 16,
    parameter int unsigned BANK_BITS = 3
) (
    input  logic [              (1<<BANK_BITS)-1:0] mask_i,
    input  logic [                    ROW_BITS-1:0] row_i,
    input  logic [        WIDTH*(1<<BANK_BITS)-1:0] words_i,
    output logic [                             2:0] count_o,
    output logic [4*(ROW_BITS+BANK_BITS+WIDTH)-1:0] lanes_o  // {number, word} each
);

  localparam int unsigned LANE = ROW_BITS + BANK_BITS + WIDTH;

  always_comb begin
    lanes_o = '0;
    count_o = 3'd0;
    if (mask_i != '0)
      for (int b = 0; b < (1 << BANK_BITS); b++) begin
        for (int i = 0; i < 4; i++)
          if (mask_i[b] && count_o == 3'(i))
            lanes_o[i*LANE+:LANE] = {row_i, BANK_BITS'(b), words_i[b*WIDTH+:WIDTH]};
        count_o = count_o + 3'(mask_i[b]);
      end
  end

endmodule
