/* SPDX-License-Identifier: Apache-2.0
 *
 * How much is random in a test: HS_CASES=10 makes ten times as much, HS_CASES=0.1 a tenth.
 */
#ifndef HS_CASES_H
#define HS_CASES_H

#include <stdint.h>
#include <stdlib.h>

/* At least one. */
static inline uint32_t cases(uint32_t count) {
    const char *text = getenv("HS_CASES");
    const double factor = text ? atof(text) : 1;
    const double wanted = count * (factor > 0 ? factor : 1);
    return wanted < 1 ? 1 : wanted < 4e9 ? (uint32_t)wanted : UINT32_MAX;
}

#endif
