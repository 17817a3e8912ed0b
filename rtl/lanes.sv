// SPDX-License-Identifier: Apache-2.0
//
// Which of four lanes may use their banks in this cycle: of the pending lanes that want the same
// bank, the lowest. Combinational.

module lanes #(
    parameter int unsigned BANK_BITS = 3
) (
    input  logic [            3:0] pending_i,
    input  logic [4*BANK_BITS-1:0] bank_i,
    output logic [            3:0] grant_o
);

  always_comb begin
    grant_o = pending_i;
    for (int i = 1; i < 4; i++)
      for (int j = 0; j < i; j++)
        if (pending_i[j] && bank_i[j*BANK_BITS+:BANK_BITS] == bank_i[i*BANK_BITS+:BANK_BITS])
          grant_o[i] = 1'b0;
  end

endmodule
