/* SPDX-License-Identifier: Apache-2.0
 *
 * Flips bits in the memories of the Verilated RTL, one a run, and sees what becomes of the view,
 * and of the one behind it:
 *
 *   detected  the trailer says MEMORY_FAULT
 *   masked    every word of the output is as without the flip
 *   silent    another output, and a status that does not say so
 *
 * Which memory is drawn evenly from all kinds of memories and FIFOs, then its bank, the bit,
 * parity's own among them, and the cycle, from the packet's first beat to the trailer. Half of the
 * flips strike a row, mostly one that the view uses; the other half the next word that is written
 * from that cycle on, up to 15 cycles behind. In half of the runs the output stalls, which fills
 * the FIFOs. The view behind must be right in every word and take its usual cycles.
 */
#ifndef HS_TESTS_STRIKES_H
#define HS_TESTS_STRIKES_H

#include <stdbool.h>
#include <stdint.h>

enum { HS_MOST_MEMORIES = 64 };

/* A memory, all its banks, and what flips in it came to. */
typedef struct hs_struck {
    char name[80];
    uint32_t first, banks; /* in the list of memories.h */
    uint64_t flips, detected, masked, silent;
} hs_struck;

typedef struct hs_strikes {
    hs_struck memory[HS_MOST_MEMORIES];
    uint32_t memories;
    uint64_t flips, detected, masked, silent;
    uint64_t wrong;  /* views behind a flip that were not as ever */
    uint64_t cycles; /* simulated */
} hs_strikes;

/* So many flips. Says each silent one, if loud, and each wrong view behind. Ends the program if the
 * RTL's output is not golden's without a flip, or memory is exhausted. */
hs_strikes hs_strike(uint64_t flips, uint64_t seed, bool loud);

#endif
