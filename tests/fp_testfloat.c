/* SPDX-License-Identifier: Apache-2.0
 *
 * Plays Berkeley TestFloat's vectors through fp_add or fp_mul:
 *
 *     testfloat_gen -level 2 f32_add | build/fp_testfloat add 7496192
 *
 * A line is three or four hexadecimal words: a, b, the expected result, exception flags (ignored).
 * Results that are NaN compare as NaN. The last argument is the number of vectors that must come,
 * so that a generator that fails does not pass. Prints how many were checked and the first few that
 * differ; exits 0 only if all came and none differs.
 */
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "fp_shim.h"

/* Vectors checked at a time. */
enum { BLOCK = 65536 };

static bool is_nan(uint32_t bits) {
    return (bits & 0x7fffffff) > 0x7f800000;
}

int main(int argc, char **argv) {
    bool add = argc == 3 && strcmp(argv[1], "add") == 0;
    bool mul = argc == 3 && strcmp(argv[1], "mul") == 0;
    size_t wanted = argc == 3 ? strtoull(argv[2], NULL, 10) : 0;
    if ((!add && !mul) || wanted == 0) {
        fprintf(stderr, "usage: testfloat_gen ... | fp_testfloat add|mul COUNT\n");
        return EXIT_FAILURE;
    }

    static uint32_t a[BLOCK], b[BLOCK], expected[BLOCK], y[BLOCK];
    fp_shim *shim = fp_new();
    size_t checked = 0, different = 0;
    bool timely = true, more = true;
    while (more) {
        size_t n = 0;
        char line[128];
        while (n < BLOCK && (more = fgets(line, sizeof line, stdin) != NULL)) {
            char *at = line;
            a[n] = (uint32_t)strtoul(at, &at, 16);
            b[n] = (uint32_t)strtoul(at, &at, 16);
            char *last = at;
            expected[n] = (uint32_t)strtoul(at, &at, 16);
            if (at == last) {
                fprintf(stderr, "fp_testfloat: vector %zu is malformed: %s", checked + n + 1, line);
                return EXIT_FAILURE;
            }
            n++;
        }
        timely &= fp_binary(shim, add ? FP_ADD : FP_MUL, n, a, b, y, 0);
        for (size_t i = 0; i < n; i++)
            if (y[i] != expected[i] && !(is_nan(y[i]) && is_nan(expected[i])) && different++ < 10)
                printf("%08x %s %08x: %08x, expected %08x\n", a[i], argv[1], b[i], y[i],
                       expected[i]);
        checked += n;
    }
    fp_free(shim);
    printf("fp_%s: %zu of %zu vectors checked, %zu differ%s\n", argv[1], checked, wanted, different,
           timely ? "" : "; valid_o came in a wrong cycle");
    return checked == wanted && different == 0 && timely ? EXIT_SUCCESS : EXIT_FAILURE;
}
