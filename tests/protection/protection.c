/* SPDX-License-Identifier: Apache-2.0
 *
 * The campaign of strikes.h, and its table.
 *
 *   protection FLIPS SEED     fails if a flip is silent or the view behind one is wrong, and if
 * nothing was detected or nothing masked protection FLIPS SEED -   for a build without parity:
 * fails if no flip is silent
 */
#include <inttypes.h>
#include <stdio.h>
#include <stdlib.h>

#include "strikes.h"

int main(int argc, char **argv) {
    if (argc < 3) {
        fprintf(stderr, "usage: protection FLIPS SEED [-]\n");
        return 2;
    }
    const uint64_t flips = strtoull(argv[1], NULL, 10), seed = strtoull(argv[2], NULL, 10);
    const bool unprotected = argc > 3;
    setvbuf(stdout, NULL, _IOLBF, 0);
    const hs_strikes all = hs_strike(flips, seed, !unprotected);
    printf("%-44s %8s %8s %8s %8s\n", "memory", "flips", "detected", "masked", "silent");
    for (uint32_t i = 0; i < all.memories; i++)
        printf("%-44s %8" PRIu64 " %8" PRIu64 " %8" PRIu64 " %8" PRIu64 "\n", all.memory[i].name,
               all.memory[i].flips, all.memory[i].detected, all.memory[i].masked,
               all.memory[i].silent);
    printf("sum seed %" PRIu64 ": %" PRIu64 " flips in %u memories, %" PRIu64 " detected, %" PRIu64
           " masked, %" PRIu64 " silent, %" PRIu64 " next views wrong, %" PRIu64 " cycles\n",
           seed, all.flips, all.memories, all.detected, all.masked, all.silent, all.wrong,
           all.cycles);
    if (all.flips < flips) return 1;
    if (unprotected) return all.silent == 0;
    return all.silent || all.wrong || !all.detected || !all.masked;
}
