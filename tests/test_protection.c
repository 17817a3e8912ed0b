/* SPDX-License-Identifier: Apache-2.0
 *
 * Flipped bits in the memories of the default architecture; `make protection` flips more.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <inttypes.h>
#include <stdio.h>

#include "rtl_samples.h"
#include "strikes.h"

static void no_flip_is_silent(void **state) {
    (void)state;
    const uint64_t wanted = cases(1000);
    const hs_strikes all = hs_strike(wanted, 1, true);
    printf("%" PRIu64 " flips in %u memories: %" PRIu64 " detected, %" PRIu64 " masked\n",
           all.flips, all.memories, all.detected, all.masked);
    assert_int_equal(all.flips, wanted);
    assert_int_equal(all.silent, 0);
    assert_int_equal(all.wrong, 0);
    /* All memories were struck, and many flips mattered. */
    for (uint32_t i = 0; i < all.memories; i++)
        assert_true(all.memory[i].flips > 0);
    assert_true(all.detected > wanted / 20 && all.masked > wanted / 20);
}

int main(void) {
    const struct CMUnitTest tests[] = {cmocka_unit_test(no_flip_is_silent)};
    return cmocka_run_group_tests(tests, NULL, NULL);
}
