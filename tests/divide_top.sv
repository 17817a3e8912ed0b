// SPDX-License-Identifier: Apache-2.0
//
// The division of the masks by itself.

module divide_top (
    input logic clk_i,

    input logic               valid_i,
    input logic               limit_i,
    input logic        [ 7:0] n_i,
    input logic signed [47:0] x_i,

    output logic signed [31:0] y_o
);

  divide u_divide (.*);

endmodule
