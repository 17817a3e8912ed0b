/* SPDX-License-Identifier: Apache-2.0
 *
 * Coverage of Verilated modules, for their shims: what a simulation covered goes to a file of its
 * own, in the folder that HS_COVERAGE names. In a build without coverage (see tests/coverage.mk),
 * nothing.
 */
#ifndef HS_COVERAGE_H
#define HS_COVERAGE_H

#include "verilated.h"

#if VM_COVERAGE
#include <unistd.h>

#include <cstdlib>
#include <string>

#include "verilated_cov.h"
#endif

/* Before the simulation is freed, since the counts are part of it. */
inline void keep_coverage(VerilatedContext &context) {
#if VM_COVERAGE
    static unsigned files;
    const char *folder = std::getenv("HS_COVERAGE");
    if (!folder) return;
    const std::string name = std::to_string(getpid()) + "-" + std::to_string(files++) + ".dat";
    context.coveragep()->write((std::string(folder) + "/" + name).c_str());
#else
    (void)context;
#endif
}

#endif
