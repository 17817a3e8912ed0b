// SPDX-License-Identifier: Apache-2.0
//
// The sequencer: takes a view from stage to stage and from generation to generation.
//
//   receive --> classify --> select --> guard --> smooth --> split --> trailer --> receive
//   quantize       ^                                           |
//                  +-------------- next generation ------------+
//
//   * One view at a time, one stage at a time, but for receive, transform and quantize, which
//     overlap, and check_twins, which runs beside the first classify.
//   * kick_* starts a stage for one cycle; *_active_i tells that it is still at work.
//   * A uniform run decides nothing between classify and split: where no vertex leaves early, and no
//     limit is wanted, they work in one pass in the odd steps from generation 2 on, but for the last
//     one, and split leaves the new vertices of the next, even, step, which needs no classify.
//   * Left out: select and, after generation 0, guard in a uniform run; guard where nothing is
//     selected; smooth where no vertex moves or leaves.
//   * The settings of a generation hold from its classify to the end of its split.
//   * fault_i, a memory gave a word with wrong parity: the stages of the generations are put back by abort_o,
//     for one cycle, and the view ends with a header, if it had none, and a trailer that says so. While a
//     packet comes in, it is taken to its end first; if it is refused, that is what the trailer says.

module sequencer #(
    parameter int unsigned VW = 19,
    parameter int unsigned QW = 19
) (
    input logic clk_i,
    input logic rst_i,

    // registers
    input  logic [VW:0] limit_vertices_i,
    input  logic [QW:0] limit_quads_i,
    output logic        view_done_o,
    output logic        busy_o,
    output logic [ 7:0] status_o,
    output logic [31:0] position_o,

    // memories
    input  logic fault_i,
    output logic abort_o,

    // receive, transform, quantize
    output logic        kick_receive_o,
    input  logic        receive_item_i,
    input  logic        receive_done_i,
    input  logic        vertices_done_i,
    input  logic        transform_busy_i,
    output logic        kick_quantize_o,
    input  logic        quantize_done_i,
    input  logic [ 7:0] receive_status_i,
    input  logic [31:0] receive_position_i,
    input  logic        uniform_i,
    input  logic        limit_i,
    input  logic        kept_i,       // boundary mode
    input  logic [QW:0] boundary_i,   // boundary edges, if their mode is another
    input  logic [ 7:0] front_depth_i,
    input  logic [ 7:0] silhouette_depth_i,
    input  logic [ 7:0] uniform_depth_i,
    input  logic [ 7:0] forced_max_i,
    input  logic        closed_i,
    input  logic [VW:0] vertices_i,
    input  logic [QW:0] faces_i,
    input  logic [QW:0] halfedges_i,

    // check_twins, classify
    output logic          kick_check_o,
    output logic          kick_classify_o,
    input  logic          classify_active_i,
    input  logic          check_active_i,
    input  logic          check_error_i,
    input  logic [QW-1:0] check_corner_i,
    input  logic          check_sharpness_i,  // the error is of the sharpness word
    input  logic          valence_error_i,
    input  logic [QW-1:0] valence_corner_i,

    // select, guard, smooth, split
    output logic          kick_select_o,
    input  logic          select_active_i,
    input  logic          any_selected_i,
    output logic          kick_guard_o,
    input  logic          guard_active_i,
    input  logic [  QW:0] refined_i,
    input  logic [QW+2:0] sides_i,
    output logic          kick_smooth_o,
    input  logic          smooth_active_i,
    output logic          kick_split_o,
    input  logic          split_active_i,
    input  logic [  QW:0] children_i,

    // emit: header and trailer
    output logic       op_valid_o,
    input  logic       op_ready_i,
    output logic       op_trailer_o,
    output logic [7:0] op_generation_o,
    input  logic       emit_done_i,

    // the generation
    output logic [ 7:0] generation_o,
    output logic        odd_o,      // the step makes face points and moves vertices
    output logic        quads_o,    // generation 1 and later
    output logic        side_o,     // of the record memory
    output logic [QW:0] items_o,    // corners or quads
    output logic [VW:0] vertices_o, // before this step's new ones
    output logic [VW:0] new_o,      // this step's new ones
    output logic        pass_o,     // classify and split work in one pass
    output logic        edge_o,     // no classify: the step before was such a pass
    output logic [ 7:0] marked_o,   // the generation whose classify ran last
    output logic        all_o,      // uniform, after generation 0: every quad is refined
    output logic        last_o,     // the children are final
    output logic        finish_o,   // nothing is refined: all active faces are final
    output logic        refused_o   // the view has an error
);

  localparam logic [7:0] OK = hs_pkg::STATUS_OK;
  localparam logic [7:0] STOPPED = hs_pkg::STATUS_STOPPED;
  localparam logic [7:0] FAULT = hs_pkg::STATUS_MEMORY_FAULT;

  typedef enum logic [3:0] {
    RECEIVE,
    CLASSIFY,
    HEADER,
    SELECT,
    GUARD,
    SMOOTH,
    SPLIT,
    NEXT,
    TRAILER,
    DRAIN
  } state_t;

  state_t state_q;
  logic kick_q;  // the first cycle in a state
  logic received_q, vertices_done_q, quantizing_q;
  logic [7:0] generation_q, status_q, depth;
  logic [31:0] position_q;
  logic [QW:0] items_q, faces_q;
  logic [QW+1:0] boundary_q;  // uniform runs: boundary edges at the latest even generation
  logic [VW:0] vertices_q;
  logic side_q, finish_q, busy_q;
  logic faulty_q, header_sent_q;

  // --- What this generation's step is -------------------------------------------------------------------
  always_comb begin
    depth = front_depth_i > silhouette_depth_i ? front_depth_i : silhouette_depth_i;
    if (forced_max_i > depth) depth = forced_max_i;
    if (uniform_i) depth = uniform_depth_i;
  end

  logic [QW:0] refined;
  /* verilator lint_off UNUSEDSIGNAL */
  logic [QW+3:0] all_sides;  // never reaches its highest bit: faces and boundary are within bounds
  /* verilator lint_on UNUSEDSIGNAL */
  logic [QW+2:0] sides;
  logic exceeds, ends, empty;

  assign quads_o = generation_q != 8'd0;
  assign odd_o = !generation_q[0];
  assign all_o = uniform_i && quads_o;
  assign ends = generation_q >= depth;
  // On a mesh with a boundary a step may leave triangles only: then nothing is selected any more.
  assign empty = items_q == '0;
  assign refined = all_o ? faces_q : refined_i;
  // A boundary side counts twice in an odd step; in an even one a half-quad counts two sides.
  assign all_sides = (QW + 4)'({faces_q, 2'b00}) +
      (odd_o ? (QW + 4)'(boundary_q) : (QW + 4)'(0) - (QW + 4)'({boundary_q, 1'b0}));
  assign sides = all_o ? all_sides[QW+2:0] : sides_i;
  assign exceeds = 32'(vertices_q) + 32'(refined) > 32'(limit_vertices_i) ||
      (32'(sides) + 32'd1) >> 1 > 32'(limit_quads_i);

  // For limit positions every vertex needs its ring: no generation is skipped.
  assign last_o = !finish_q && !limit_i && generation_q + 8'd1 == depth;
  assign finish_o = finish_q;
  assign generation_o = generation_q;
  assign side_o = side_q;
  assign items_o = items_q;
  assign vertices_o = vertices_q;
  assign new_o = (VW + 1)'(refined);
  assign refused_o = status_q != OK && status_q != STOPPED && status_q != FAULT;

  // Runs without borders whose every step refines all there is; and of these, those in which vertices
  // leave in the last step alone.
  logic borderless, whole, stops;

  assign borderless = uniform_i && (closed_i || !kept_i);
  assign whole = borderless && !limit_i;
  assign stops = ends || exceeds || empty;
  assign pass_o = whole && odd_o && quads_o && !last_o && !stops && !finish_q;
  assign edge_o = whole && !odd_o && generation_q >= 8'd3;
  assign marked_o = edge_o ? generation_q - 8'd1 : generation_q;

  // In an even step without borders, nothing moves and nothing is held.
  logic smooth_idle;

  assign smooth_idle = borderless && !odd_o && !last_o && !ends;

  // --- Errors of the topology, found in generation 0 -------------------------------------------------------
  logic valence_error_q;
  logic [QW-1:0] valence_corner_q;
  logic topology_error, valence_first;
  logic [31:0] topology_corner, corners_at;

  assign valence_first = valence_error_q && (!check_error_i || valence_corner_q <= check_corner_i);
  assign topology_error = valence_error_q || check_error_i;
  assign topology_corner = valence_first ? 32'(valence_corner_q) : 32'(check_corner_i);
  assign corners_at = 4 * (hs_pkg::HEADER_RECORDS + hs_pkg::MATRIX_RECORDS + 32'(vertices_i));

  // --- Kicks ------------------------------------------------------------------------------------------------
  assign kick_receive_o = kick_q && state_q == RECEIVE;
  assign kick_quantize_o = vertices_done_q && !transform_busy_i;
  assign kick_classify_o = kick_q && state_q == CLASSIFY && !edge_o;
  assign kick_check_o = kick_classify_o && !quads_o;
  assign kick_select_o = kick_q && state_q == SELECT;
  assign kick_guard_o = kick_q && state_q == GUARD;
  assign kick_smooth_o = kick_q && state_q == SMOOTH;
  assign kick_split_o = kick_q && (state_q == SPLIT || (state_q == CLASSIFY && pass_o));

  assign op_valid_o = state_q == HEADER || state_q == TRAILER;
  assign op_trailer_o = state_q == TRAILER;
  // A refused view has reached none, whatever the settings of its header, or of the view before, say.
  assign op_generation_o = last_o && !refused_o && status_q != FAULT ? generation_q + 8'd1 : generation_q;
  assign view_done_o = state_q == DRAIN && emit_done_i;
  assign busy_o = busy_q;
  assign status_o = status_q;
  assign position_o = position_q;

  // --- From state to state ----------------------------------------------------------------------------------
  always_ff @(posedge clk_i) begin
    kick_q <= 1'b0;
    if (vertices_done_i) vertices_done_q <= 1'b1;
    if (kick_quantize_o) begin
      vertices_done_q <= 1'b0;
      quantizing_q <= 1'b1;
    end
    if (quantize_done_i) quantizing_q <= 1'b0;
    if (receive_done_i) received_q <= 1'b1;
    if (receive_item_i) busy_q <= 1'b1;
    if (valence_error_i && !valence_error_q && !quads_o) begin
      valence_error_q  <= 1'b1;
      valence_corner_q <= valence_corner_i;
    end

    case (state_q)
      RECEIVE: begin
        generation_q <= 8'd0;
        side_q <= 1'b0;
        finish_q <= 1'b0;
        valence_error_q <= 1'b0;
        header_sent_q <= 1'b0;
        if (fault_i && busy_q) faulty_q <= 1'b1;
        if (received_q && !vertices_done_q && !quantizing_q) begin
          received_q <= 1'b0;
          status_q <= receive_status_i;
          position_q <= receive_position_i;
          items_q <= halfedges_i;
          faces_q <= faces_i;
          vertices_q <= vertices_i;
          boundary_q <= (QW + 2)'(boundary_i);
          kick_q <= 1'b1;
          state_q <= receive_status_i == OK ? CLASSIFY : HEADER;
          if (receive_status_i == OK && (faulty_q || fault_i)) begin
            status_q <= FAULT;
            state_q  <= HEADER;
          end
          faulty_q <= 1'b0;
        end
      end

      CLASSIFY:
      if (!kick_q && !classify_active_i && !(check_active_i && !quads_o) &&
          !(split_active_i && pass_o)) begin
        kick_q <= 1'b1;
        if (!quads_o && topology_error) begin
          status_q <= valence_first ? hs_pkg::STATUS_BAD_VALENCE :
              check_sharpness_i ? hs_pkg::STATUS_BAD_SHARPNESS : hs_pkg::STATUS_BAD_TWIN;
          position_q <= corners_at + 4 * topology_corner +
              (valence_first ? 32'd0 : check_sharpness_i ? 32'd3 : 32'd1);
        end
        finish_q <= ends || (all_o && (exceeds || empty));
        if (all_o && exceeds && !ends) status_q <= STOPPED;
        if (!quads_o) state_q <= HEADER;
        else if (all_o) state_q <= smooth_idle && !exceeds ? SPLIT : SMOOTH;
        else state_q <= ends ? SMOOTH : SELECT;
      end

      HEADER:
      if (op_ready_i) begin
        kick_q <= 1'b1;
        header_sent_q <= 1'b1;
        if (refused_o || status_q == FAULT) state_q <= TRAILER;
        else if (finish_q) state_q <= SMOOTH;
        else state_q <= uniform_i ? GUARD : SELECT;
      end

      SELECT:
      if (!kick_q && !select_active_i) begin
        kick_q   <= 1'b1;
        finish_q <= !any_selected_i;
        state_q  <= any_selected_i ? GUARD : SMOOTH;
      end

      GUARD:
      if (!kick_q && !guard_active_i) begin
        kick_q <= 1'b1;
        if (exceeds) begin
          finish_q <= 1'b1;
          status_q <= STOPPED;
        end
        state_q <= SMOOTH;
      end

      SMOOTH:
      if (!kick_q && !smooth_active_i) begin
        kick_q  <= !pass_o;
        state_q <= pass_o ? NEXT : SPLIT;
      end

      SPLIT: if (!kick_q && !split_active_i) state_q <= finish_q || last_o ? TRAILER : NEXT;

      NEXT: begin
        kick_q <= 1'b1;
        generation_q <= generation_q + 8'd1;
        side_q <= !side_q;
        vertices_q <= vertices_q + (VW + 1)'(refined);
        if (!odd_o) boundary_q <= boundary_q << 1;
        items_q <= children_i;
        faces_q <= children_i;
        state_q <= CLASSIFY;
      end

      TRAILER: if (op_ready_i) state_q <= DRAIN;

      DRAIN:
      if (emit_done_i) begin
        kick_q  <= 1'b1;
        busy_q  <= 1'b0;
        state_q <= RECEIVE;
      end

      default: state_q <= RECEIVE;
    endcase

    // What is on its way to emit is overtaken by the trailer, and then gone.
    abort_o <= 1'b0;
    if (fault_i && state_q != RECEIVE && state_q != DRAIN) begin
      abort_o <= 1'b1;
      kick_q <= 1'b0;
      status_q <= FAULT;
      position_q <= hs_pkg::NO_POSITION;
      if (state_q == HEADER) state_q <= op_ready_i ? TRAILER : HEADER;
      else if (state_q != TRAILER) state_q <= header_sent_q ? TRAILER : HEADER;
    end

    if (rst_i) begin
      state_q <= RECEIVE;
      kick_q <= 1'b1;
      received_q <= 1'b0;
      vertices_done_q <= 1'b0;
      quantizing_q <= 1'b0;
      busy_q <= 1'b0;
      faulty_q <= 1'b0;
      header_sent_q <= 1'b0;
      abort_o <= 1'b0;
      status_q <= OK;
      position_q <= hs_pkg::NO_POSITION;
      generation_q <= 8'd0;
    end
  end

endmodule
