/* SPDX-License-Identifier: Apache-2.0
 *
 * libFuzzer's entry points. FUZZ_TARGET in the environment names the target; `list` prints all, and
 * how long an input may be.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fuzz.h"

int LLVMFuzzerInitialize(int *argc, char ***argv);
int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size);
size_t LLVMFuzzerMutate(uint8_t *bytes, size_t size, size_t room);
size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t room, unsigned seed);
size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t room, unsigned seed);

static const fuzz_target *target;

int LLVMFuzzerInitialize(int *argc, char ***argv) {
    (void)argc;
    (void)argv;
    const char *name = getenv("FUZZ_TARGET");
    const bool list = name && strcmp(name, "list") == 0;
    for (size_t i = 0; name && fuzz_targets[i]; i++) {
        if (list) printf("%s %zu\n", fuzz_targets[i]->name, fuzz_targets[i]->longest);
        if (strcmp(fuzz_targets[i]->name, name) == 0) target = fuzz_targets[i];
    }
    if (list) exit(EXIT_SUCCESS);
    fuzz_claim(target != NULL, "FUZZ_TARGET is no target: %s", name ? name : "not set");
    return 0;
}

int LLVMFuzzerTestOneInput(const uint8_t *bytes, size_t size) {
    if (size <= target->longest) target->run(bytes, size);
    return 0;
}

size_t LLVMFuzzerCustomMutator(uint8_t *bytes, size_t size, size_t room, unsigned seed) {
    if (!target->mutate || size == 0) return LLVMFuzzerMutate(bytes, size, room);
    size = seed % 3 ? target->mutate(bytes, size, room, seed) : LLVMFuzzerMutate(bytes, size, room);
    if (seed / 3 % 8) target->mend(bytes, size);
    return size;
}

size_t LLVMFuzzerCustomCrossOver(const uint8_t *a, size_t a_size, const uint8_t *b, size_t b_size,
                                 uint8_t *out, size_t room, unsigned seed) {
    if (!target->cross) return 0; /* LLVMFuzzerMutate crosses, too */
    const size_t size = target->cross(out, room, a, a_size, b, b_size, seed);
    if (seed % 8) target->mend(out, size);
    return size;
}
