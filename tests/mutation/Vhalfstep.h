/* SPDX-License-Identifier: Apache-2.0
 *
 * The pipeline that holds all mutants, where sim/rtl_shim.cpp expects the one without: its input
 * `mutant` says which of them lives; 0: none.
 */
#ifndef HS_TESTS_MUTATION_VHALFSTEP_H
#define HS_TESTS_MUTATION_VHALFSTEP_H

#include "Vmutants.h"
#include "kill_rtl.h"

class VerilatedFstC;

class Vhalfstep : public Vmutants {
  public:
    explicit Vhalfstep(VerilatedContext *context) : Vmutants(context) {
        mutant = living_mutant;
    }
    void trace(VerilatedFstC *, int) {} /* without waveforms, it is sooner compiled */
};

#endif
