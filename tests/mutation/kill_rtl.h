/* SPDX-License-Identifier: Apache-2.0
 *
 * The mutant of the RTL that the pipelines built from here on have; 0: none.
 */
#ifndef HS_TESTS_MUTATION_KILL_RTL_H
#define HS_TESTS_MUTATION_KILL_RTL_H

#include <stdint.h>

#ifdef __cplusplus
extern "C"
#else
extern
#endif
    uint16_t living_mutant;

#endif
