/* SPDX-License-Identifier: Apache-2.0
 *
 * The corpora of the fuzzers, tests/corpus, and with them what fuzzing has found, through the
 * fuzzers' own functions in an ordinary build; and a few changes of each stream.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "fuzz.h"

enum { CHANGES = 100 };

static int is_file(const struct dirent *entry) {
    return entry->d_name[0] != '.';
}

/* A claim that does not hold ends the program: the last line printed tells the input. */
static void run_file(const fuzz_target *t, const char *name, uint32_t verdicts[2]) {
    char path[400];
    uint8_t *bytes;
    size_t size;
    hs_error err;
    snprintf(path, sizeof path, "tests/corpus/%s/%s", t->name, name);
    if (!hs_file_read(path, t->longest, &bytes, &size, &err)) fail_msg("%s", err.text);
    print_message("%s\n", path);
    fflush(stdout);
    verdicts[t->run(bytes, size)]++;
    if (t->mutate) {
        uint8_t *changed = malloc(t->longest);
        assert_non_null(changed);
        for (uint32_t seed = 0; seed < CHANGES; seed++) {
            memcpy(changed, bytes, size);
            const size_t now = t->mutate(changed, size, t->longest, seed);
            assert_true(now <= t->longest);
            if (seed % 4) t->mend(changed, now);
            t->run(changed, now);
        }
        free(changed);
    }
    free(bytes);
}

static void corpus_holds(void **state) {
    const fuzz_target *t = *state;
    struct dirent **entry;
    char folder[100];
    uint32_t verdicts[2] = {0};
    snprintf(folder, sizeof folder, "tests/corpus/%s", t->name);
    const int files = scandir(folder, &entry, is_file, alphasort);
    if (files <= 0) fail_msg("%s: nothing in it", folder);
    for (int i = 0; i < files; i++) {
        run_file(t, entry[i]->d_name, verdicts);
        free(entry[i]);
    }
    free(entry);
    print_message("%s: %u inputs taken, %u refused\n", t->name, verdicts[FUZZ_TAKEN],
                  verdicts[FUZZ_REFUSED]);
    assert_true(verdicts[FUZZ_TAKEN] > 0 && verdicts[FUZZ_REFUSED] > 0);
}

int main(void) {
    struct CMUnitTest tests[20] = {0};
    size_t count = 0;
    for (; fuzz_targets[count]; count++) {
        union {
            const fuzz_target *target;
            void *state;
        } of = {.target = fuzz_targets[count]}; /* cmocka hands it on, and changes nothing */
        tests[count] = (struct CMUnitTest){of.target->name, corpus_holds, NULL, NULL, of.state};
    }
    return _cmocka_run_group_tests("fuzz", tests, count, NULL, NULL);
}
