/* SPDX-License-Identifier: Apache-2.0
 *
 * A process filter of GTKWave: reads values in hexadecimal, a line each, and answers with numbers.
 * Words of 32 bits, the lowest first: x, y, z, w. What they are is in the name that it is called
 * by:
 *
 *   binary32     floating point
 *   fixed_eE     S1.30 of a block whose exponent is E: q stands for q 2^(E-30)
 */
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { DIGITS = 8, MOST_DIGITS = 4096 };

static void print_word(uint32_t word, int fixed, int exponent) {
    double value = ldexp((double)(int32_t)word, exponent - 30);
    if (!fixed) {
        float number;
        memcpy(&number, &word, sizeof number);
        value = (double)number;
    }
    printf("%.6g", value);
}

int main(int argc, char **argv) {
    char line[MOST_DIGITS];
    const char *slash = argc ? strrchr(argv[0], '/') : NULL;
    const char *name = slash ? slash + 1 : argc ? argv[0] : "";
    const int fixed = strncmp(name, "fixed_e", 7) == 0, exponent = fixed ? atoi(name + 7) : 0;
    while (fgets(line, sizeof line, stdin)) {
        size_t end = strcspn(line, "\n");
        line[end] = 0;
        if (end == 0 || strspn(line, "0123456789abcdefABCDEF") != end) {
            puts(line); /* not known: as it is */
        } else {
            while (end) {
                const size_t begin = end > DIGITS ? end - DIGITS : 0;
                line[end] = 0;
                print_word((uint32_t)strtoul(line + begin, NULL, 16), fixed, exponent);
                end = begin;
                if (end) putchar(' ');
            }
            putchar('\n');
        }
        fflush(stdout);
    }
    return 0;
}
