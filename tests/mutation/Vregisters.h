/* SPDX-License-Identifier: Apache-2.0
 *
 * The same, where tests/registers_shim.cpp expects the registers alone: what it drives besides the
 * bus is not connected.
 */
#ifndef HS_TESTS_MUTATION_VREGISTERS_H
#define HS_TESTS_MUTATION_VREGISTERS_H

#include "Vhalfstep.h"

class Vregisters : public Vhalfstep {
  public:
    uint16_t stage_busy_i = 0, stage_starved_i = 0, stage_blocked_i = 0;
    uint32_t stage_in_i = 0, stage_out_i = 0, position_i = 0;
    uint32_t limit_vertices_o = 0, limit_quads_o = 0;
    uint8_t conflict_i = 0, busy_i = 0, view_done_i = 0, status_i = 0;

    explicit Vregisters(VerilatedContext *context) : Vhalfstep(context) {
        s_axis_tvalid = 0;
        m_axis_tready = 0;
    }
};

#endif
