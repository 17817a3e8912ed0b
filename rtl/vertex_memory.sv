// SPDX-License-Identifier: Apache-2.0
//
// What is known of every vertex, in banks by the vertex' number:
//
//   position  x, y, z, w: binary32 until quantize ran, then S1.30 of the block
//   sum       {count[7:0], T}: this generation's, in odd steps; afterwards its low 128 bits are the
//             position before that step
//   sharp     {many, seen, own[3:0], t3[3:0], t2[3:0], t1[3:0]}, see sharpness and vertex_kind
//   ring      {nonquad, count[7:0], M}: this generation's, with limit positions only
//   mark      {tag[7:0], sent, border, hits, back, front}: marks of the generation that the tag
//             names; sent: it is in the output
//   chosen    a selected face's vertex; held: a vertex of a face that stays. Both count only where
//             the tag is this generation's: classify clears them with every mark that it writes
//
//   * Nothing is cleared between views: a vertex that is born (birth_*) gets the tag
//     birth_generation_i, of a generation that its next classify is not.
//   * The stages take turns. Single accesses go to one bank, rows to the same row of all banks. Two
//     users of one memory's read port, or write port, in the same cycle are illegal, with the
//     exceptions that classify's ports need: see accumulate.
//   * Every read answers one cycle later. fault_o, a cycle behind the answer: its parity was wrong. What
//     *_void_i and what a row's *_there_i do not cover was never of use.

module vertex_memory #(
    parameter int unsigned VW = 19,
    parameter int unsigned BANK_BITS = 3,
    parameter bit PARITY = 1'b1,
    localparam int unsigned BANKS = 1 << BANK_BITS,
    localparam int unsigned ROW_BITS = VW - BANK_BITS
) (
    input logic clk_i,

    // transform: positions in binary32; quantize reads them and gives birth to what it makes
    input  logic          load_wr_en_i,
    input  logic [VW-1:0] load_wr_index_i,
    input  logic [ 127:0] load_wr_data_i,
    input  logic          quantize_rd_en_i,
    input  logic [VW-1:0] quantize_rd_index_i,
    output logic [ 127:0] single_position_o,  // of the latest single read

    // birth (quantize, guard, split): position, old position, mark word; sent_i alone: mark word.
    // birth_sharp_wr_i: the sharp word of a vertex on an edge of this sharpness too
    input logic          birth_i,
    input logic          sent_i,
    input logic [VW-1:0] birth_vertex_i,
    input logic [ 127:0] birth_position_i,
    input logic [   7:0] birth_generation_i,
    input logic          birth_sharp_wr_i,
    input logic [   3:0] birth_sharpness_i,
    input logic          birth_quiet_i,     // neither old position nor mark word: classify is at work

    // sharpness, while a packet comes in
    input  logic          sharp_rd_en_i,
    input  logic [VW-1:0] sharp_rd_index_i,
    output logic [  17:0] sharp_rd_data_o,
    input  logic          sharp_wr_en_i,
    input  logic [VW-1:0] sharp_wr_index_i,
    input  logic [  17:0] sharp_wr_data_i,

    input logic [7:0] generation_i,

    // classify
    input  logic [         BANKS-1:0] gather_rd_en_i,
    input  logic [ROW_BITS*BANKS-1:0] gather_rd_row_i,
    input  logic                      gather_old_i,     // read the old positions too
    output logic [     274*BANKS-1:0] gather_rd_data_o, // {sharp, old, position}
    input  logic [         BANKS-1:0] mark_rd_en_i,     // classify or select
    input  logic [ROW_BITS*BANKS-1:0] mark_rd_row_i,
    output logic [      13*BANKS-1:0] mark_rd_data_o,
    input  logic [         BANKS-1:0] mark_wr_en_i,
    input  logic [ROW_BITS*BANKS-1:0] mark_wr_row_i,
    input  logic [      13*BANKS-1:0] mark_wr_data_i,
    input  logic [         BANKS-1:0] sum_rd_en_i,
    input  logic [ROW_BITS*BANKS-1:0] sum_rd_row_i,
    output logic [     168*BANKS-1:0] sum_rd_data_o,
    input  logic [         BANKS-1:0] sum_void_i,       // what is read is not used
    input  logic [         BANKS-1:0] sum_wr_en_i,
    input  logic [ROW_BITS*BANKS-1:0] sum_wr_row_i,
    input  logic [     168*BANKS-1:0] sum_wr_data_i,
    input  logic [         BANKS-1:0] ring_rd_en_i,
    input  logic [ROW_BITS*BANKS-1:0] ring_rd_row_i,
    output logic [     177*BANKS-1:0] ring_rd_data_o,
    input  logic [         BANKS-1:0] ring_void_i,
    input  logic [         BANKS-1:0] ring_wr_en_i,
    input  logic [ROW_BITS*BANKS-1:0] ring_wr_row_i,
    input  logic [     177*BANKS-1:0] ring_wr_data_i,

    // select and guard
    input  logic [         BANKS-1:0] chosen_wr_en_i,
    input  logic [ROW_BITS*BANKS-1:0] chosen_wr_row_i,
    input  logic [         BANKS-1:0] chosen_rd_en_i,
    input  logic [ROW_BITS*BANKS-1:0] chosen_rd_row_i,
    output logic [         BANKS-1:0] chosen_rd_data_o,
    input  logic [         BANKS-1:0] held_wr_en_i,
    input  logic [ROW_BITS*BANKS-1:0] held_wr_row_i,

    // smooth
    input  logic                row_rd_en_i,
    input  logic [ROW_BITS-1:0] row_rd_i,
    output logic [   BANKS-1:0] held_rd_data_o,
    input  logic [   BANKS-1:0] row_there_i,       // vertices of the row just read that exist,
    input  logic [   BANKS-1:0] held_used_i,      // and those whose held is of use
    input  logic                smooth_rd_en_i,
    input  logic [      VW-1:0] smooth_rd_index_i,
    output logic [       167:0] single_sum_o,
    output logic [       176:0] single_ring_o,
    output logic [        17:0] single_sharp_o,
    input  logic [         BANKS-1:0] wide_rd_en_i,    // positions, several of a row
    input  logic [ROW_BITS-1:0] wide_rd_row_i,
    output logic [   128*BANKS-1:0] wide_rd_data_o,
    input  logic [         BANKS-1:0] leave_wr_en_i,   // these of a row have been sent
    input  logic [ROW_BITS-1:0] leave_wr_row_i,
    input  logic                leave_new_i,     // no, they are new
    input  logic                smooth_wr_i,
    input  logic [      VW-1:0] smooth_wr_vertex_i,
    input  logic                smooth_wr_move_i,
    input  logic                smooth_wr_sent_i,
    input  logic [       127:0] smooth_wr_position_i,
    input  logic [         BANKS-1:0] keep_wr_en_i,    // the positions just read become old ones
    input  logic [ROW_BITS-1:0] keep_wr_row_i,

    output logic fault_o
);

  logic fault_position, fault_sum, fault_sharp, fault_ring, fault_mark, fault_chosen, fault_held;
  assign fault_o = fault_position || fault_sum || fault_sharp || fault_ring || fault_mark ||
      fault_chosen || fault_held;

  // --- A single access, as the banks see it -------------------------------------------------------------
  function automatic logic [BANKS-1:0] bank_of(input logic en,
                                               input logic [BANK_BITS-1:0] bank);
    bank_of = BANKS'(en) << bank;
  endfunction

  // --- Position -------------------------------------------------------------------------------------------
  logic single_rd_en, position_wr_en;
  logic [VW-1:0] single_rd_index, position_wr_index;
  logic [127:0] position_wr_data;
  logic [BANK_BITS-1:0] single_bank_q;
  logic [BANKS-1:0] position_rd_en;
  logic [ROW_BITS*BANKS-1:0] position_rd_row;
  logic [128*BANKS-1:0] position_rd_data;

  assign single_rd_en = quantize_rd_en_i || smooth_rd_en_i;
  assign single_rd_index = smooth_rd_en_i ? smooth_rd_index_i : quantize_rd_index_i;
  assign position_rd_en = gather_rd_en_i | wide_rd_en_i |
      bank_of(single_rd_en, single_rd_index[BANK_BITS-1:0]);
  assign position_rd_row = single_rd_en ? {BANKS{single_rd_index[VW-1:BANK_BITS]}} :
      wide_rd_en_i != '0 ? {BANKS{wide_rd_row_i}} : gather_rd_row_i;
  assign position_wr_en = load_wr_en_i || birth_i || (smooth_wr_i && smooth_wr_move_i);

  always_comb begin
    position_wr_index = load_wr_index_i;
    position_wr_data  = load_wr_data_i;
    if (birth_i) begin
      position_wr_index = birth_vertex_i;
      position_wr_data  = birth_position_i;
    end
    if (smooth_wr_i) begin
      position_wr_index = smooth_wr_vertex_i;
      position_wr_data  = smooth_wr_position_i;
    end
  end

  always_ff @(posedge clk_i) if (single_rd_en) single_bank_q <= single_rd_index[BANK_BITS-1:0];

  banked_memory #(
      .WIDTH(128),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_position (
      .clk_i,
      .check_i({BANKS{1'b1}}),
      .fault_o(fault_position),
      .rd_en_i(position_rd_en),
      .rd_row_i(position_rd_row),
      .rd_data_o(position_rd_data),
      .wr_en_i(bank_of(position_wr_en, position_wr_index[BANK_BITS-1:0])),
      .wr_row_i({BANKS{position_wr_index[VW-1:BANK_BITS]}}),
      .wr_data_i({BANKS{position_wr_data}})
  );

  assign wide_rd_data_o = position_rd_data;
  assign single_position_o = position_rd_data[32'(single_bank_q)*128+:128];

  // --- Sum, old position ---------------------------------------------------------------------------------
  logic [BANKS-1:0] sum_rd_en;
  logic [ROW_BITS*BANKS-1:0] sum_rd_row;

  assign sum_rd_en = sum_rd_en_i | (gather_old_i ? gather_rd_en_i : '0) |
      bank_of(smooth_rd_en_i, smooth_rd_index_i[BANK_BITS-1:0]);
  assign sum_rd_row = smooth_rd_en_i ? {BANKS{smooth_rd_index_i[VW-1:BANK_BITS]}} :
      gather_old_i ? gather_rd_row_i : sum_rd_row_i;
  logic birth_marked;
  logic [BANKS-1:0] sum_wr_en;
  logic [ROW_BITS*BANKS-1:0] sum_wr_row;
  logic [168*BANKS-1:0] sum_wr_data;

  assign birth_marked = birth_i && !birth_quiet_i;

  always_comb begin
    sum_wr_en = sum_wr_en_i | keep_wr_en_i | bank_of(birth_marked, birth_vertex_i[BANK_BITS-1:0]);
    sum_wr_row = sum_wr_row_i;
    sum_wr_data = sum_wr_data_i;
    if (birth_marked) begin
      sum_wr_row  = {BANKS{birth_vertex_i[VW-1:BANK_BITS]}};
      sum_wr_data = {BANKS{40'd0, birth_position_i}};
    end else if (keep_wr_en_i != '0) begin
      sum_wr_row = {BANKS{keep_wr_row_i}};
      for (int b = 0; b < BANKS; b++)
        sum_wr_data[168*b+:168] = {40'd0, position_rd_data[128*b+:128]};
    end
  end

  banked_memory #(
      .WIDTH(168),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_sum (
      .clk_i,
      .check_i(~sum_void_i),
      .fault_o(fault_sum),
      .rd_en_i(sum_rd_en),
      .rd_row_i(sum_rd_row),
      .rd_data_o(sum_rd_data_o),
      .wr_en_i(sum_wr_en),
      .wr_row_i(sum_wr_row),
      .wr_data_i(sum_wr_data)
  );

  assign single_sum_o = sum_rd_data_o[32'(single_bank_q)*168+:168];

  // --- Sharp, ring ---------------------------------------------------------------------------------------
  logic [BANK_BITS-1:0] sharp_bank_q;
  logic [BANKS-1:0] smooth_rd_bank, sharp_rd_en;
  logic [ROW_BITS*BANKS-1:0] smooth_rd_row, sharp_rd_row;
  logic [18*BANKS-1:0] sharp_rd_data;
  logic sharp_wr_en;
  logic [VW-1:0] sharp_wr_index;
  logic [17:0] sharp_wr_data;

  assign smooth_rd_bank = bank_of(smooth_rd_en_i, smooth_rd_index_i[BANK_BITS-1:0]);
  assign smooth_rd_row = {BANKS{smooth_rd_index_i[VW-1:BANK_BITS]}};
  assign sharp_rd_en = gather_rd_en_i | smooth_rd_bank |
      bank_of(sharp_rd_en_i, sharp_rd_index_i[BANK_BITS-1:0]);
  assign sharp_rd_row = smooth_rd_en_i ? smooth_rd_row :
      sharp_rd_en_i ? {BANKS{sharp_rd_index_i[VW-1:BANK_BITS]}} : gather_rd_row_i;
  assign sharp_wr_en = birth_sharp_wr_i || sharp_wr_en_i;
  assign sharp_wr_index = birth_sharp_wr_i ? birth_vertex_i : sharp_wr_index_i;
  // The two halves of the edge that a vertex was made on are all that can be sharp around it.
  assign sharp_wr_data = birth_sharp_wr_i ?
      {2'b11, 4'd0, 4'd0, birth_sharpness_i, birth_sharpness_i} : sharp_wr_data_i;

  always_ff @(posedge clk_i) if (sharp_rd_en_i) sharp_bank_q <= sharp_rd_index_i[BANK_BITS-1:0];

  banked_memory #(
      .WIDTH(18),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_sharp (
      .clk_i,
      .check_i({BANKS{1'b1}}),
      .fault_o(fault_sharp),
      .rd_en_i(sharp_rd_en),
      .rd_row_i(sharp_rd_row),
      .rd_data_o(sharp_rd_data),
      .wr_en_i(bank_of(sharp_wr_en, sharp_wr_index[BANK_BITS-1:0])),
      .wr_row_i({BANKS{sharp_wr_index[VW-1:BANK_BITS]}}),
      .wr_data_i({BANKS{sharp_wr_data}})
  );

  banked_memory #(
      .WIDTH(177),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_ring (
      .clk_i,
      .check_i(~ring_void_i),
      .fault_o(fault_ring),
      .rd_en_i(ring_rd_en_i | smooth_rd_bank),
      .rd_row_i(smooth_rd_en_i ? smooth_rd_row : ring_rd_row_i),
      .rd_data_o(ring_rd_data_o),
      .wr_en_i(ring_wr_en_i),
      .wr_row_i(ring_wr_row_i),
      .wr_data_i(ring_wr_data_i)
  );

  assign sharp_rd_data_o = sharp_rd_data[32'(sharp_bank_q)*18+:18];
  assign single_sharp_o = sharp_rd_data[32'(single_bank_q)*18+:18];
  assign single_ring_o = ring_rd_data_o[32'(single_bank_q)*177+:177];
  for (genvar b = 0; b < BANKS; b++) begin : g_gather
    assign gather_rd_data_o[b*274+:274] = {
      sharp_rd_data[b*18+:18], sum_rd_data_o[b*168+:128], position_rd_data[b*128+:128]
    };
  end

  // --- Marks -----------------------------------------------------------------------------------------------
  logic mark_single_en, leaves;
  logic [VW-1:0] mark_single_index;
  logic [12:0] mark_single_data;
  logic [BANKS-1:0] all_banks;
  logic row_rd_q;
  logic [ROW_BITS*BANKS-1:0] rows;

  assign leaves = smooth_wr_i && smooth_wr_sent_i;
  assign mark_single_en = birth_marked || sent_i || leaves;
  assign mark_single_index = leaves ? smooth_wr_vertex_i : birth_vertex_i;
  assign mark_single_data = {leaves ? generation_i : birth_generation_i, leaves || sent_i, 4'd0};
  assign all_banks = {BANKS{row_rd_en_i}};
  assign rows = {BANKS{row_rd_i}};
  always_ff @(posedge clk_i) row_rd_q <= row_rd_en_i;

  banked_memory #(
      .WIDTH(13),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_mark (
      .clk_i,
      .check_i(row_rd_q ? row_there_i : {BANKS{1'b1}}),
      .fault_o(fault_mark),
      .rd_en_i(mark_rd_en_i | all_banks),
      .rd_row_i(row_rd_en_i ? rows : mark_rd_row_i),
      .rd_data_o(mark_rd_data_o),
      .wr_en_i(mark_wr_en_i | leave_wr_en_i |
               bank_of(mark_single_en, mark_single_index[BANK_BITS-1:0])),
      .wr_row_i(mark_single_en ? {BANKS{mark_single_index[VW-1:BANK_BITS]}} :
                leave_wr_en_i != '0 ? {BANKS{leave_wr_row_i}} : mark_wr_row_i),
      .wr_data_i(mark_single_en ? {BANKS{mark_single_data}} :
                 leave_wr_en_i != '0 ? {BANKS{generation_i, !leave_new_i, 4'd0}} : mark_wr_data_i)
  );

  banked_memory #(
      .WIDTH(1),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_chosen (
      .clk_i,
      .check_i({BANKS{1'b1}}),
      .fault_o(fault_chosen),
      .rd_en_i(chosen_rd_en_i),
      .rd_row_i(chosen_rd_row_i),
      .rd_data_o(chosen_rd_data_o),
      .wr_en_i(mark_wr_en_i | chosen_wr_en_i),
      .wr_row_i(mark_wr_row_i | chosen_wr_row_i),  // the one that does not write is 0
      .wr_data_i(chosen_wr_en_i)
  );

  banked_memory #(
      .WIDTH(1),
      .ROW_BITS(ROW_BITS),
      .BANK_BITS(BANK_BITS),
      .PARITY(PARITY)
  ) u_held (
      .clk_i,
      .check_i(held_used_i),
      .fault_o(fault_held),
      .rd_en_i(all_banks),
      .rd_row_i(rows),
      .rd_data_o(held_rd_data_o),
      .wr_en_i(mark_wr_en_i | held_wr_en_i),
      .wr_row_i(mark_wr_row_i | held_wr_row_i),
      .wr_data_i(held_wr_en_i)
  );

endmodule
