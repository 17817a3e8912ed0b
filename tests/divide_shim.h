/* SPDX-License-Identifier: Apache-2.0
 *
 * rtl/divide.sv under Verilator, a cycle at a time.
 */
#ifndef DIVIDE_SHIM_H
#define DIVIDE_SHIM_H

#include <stdbool.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

enum { DIVIDE_LATENCY = 4 };

/* x over n^2, or over n^2 + 5n. */
typedef struct division {
    bool limit;
    uint32_t n;
    int64_t x;
} division;

typedef struct divide_rtl divide_rtl;

/* seed randomizes the registers: there is no reset. */
divide_rtl *divide_rtl_new(uint32_t seed);
void divide_rtl_free(divide_rtl *rtl);
/* One cycle with a division at the input, none if NULL; gives what is at the output before it, the
 * quotient of the division DIVIDE_LATENCY cycles ago. */
int32_t divide_rtl_cycle(divide_rtl *rtl, const division *in);

#ifdef __cplusplus
}
#endif
#endif
