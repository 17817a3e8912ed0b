/* SPDX-License-Identifier: Apache-2.0
 *
 * The arithmetic campaign: RTL and golden against independent arithmetic, an operation at a time.
 *
 *   arithmetic OPERATION OPERANDS SEED
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "arithmetic_parts.h"

static const struct {
    const char *name;
    campaign *run;
} campaigns[] = {
    {"add", campaign_add},
    {"mul", campaign_mul},
    {"transform", campaign_transform},
    {"exponent", campaign_exponent},
    {"to_fixed", campaign_to_fixed},
    {"to_float", campaign_to_float},
    {"divide", campaign_divide},
    {"remainders", campaign_remainders},
    {"facing", campaign_facing},
};

int main(int argc, char **argv) {
    const uint64_t operands = argc == 4 ? strtoull(argv[2], NULL, 10) : 0;
    const uint64_t seed = argc == 4 ? strtoull(argv[3], NULL, 10) : 0;
    for (size_t i = 0; operands && seed && i < sizeof campaigns / sizeof *campaigns; i++)
        if (strcmp(argv[1], campaigns[i].name) == 0)
            return campaigns[i].run(operands, seed) ? EXIT_SUCCESS : EXIT_FAILURE;
    fprintf(stderr, "usage: arithmetic OPERATION OPERANDS SEED, both numbers from 1; operations:");
    for (size_t i = 0; i < sizeof campaigns / sizeof *campaigns; i++)
        fprintf(stderr, " %s", campaigns[i].name);
    fprintf(stderr, "\n");
    return EXIT_FAILURE;
}
