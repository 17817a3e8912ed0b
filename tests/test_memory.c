/* SPDX-License-Identifier: Apache-2.0
 *
 * Blocks and arrays keep their contents and malloc's alignment while they grow and shrink across
 * the size from which they are kept otherwise.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>

#include <cmocka.h>

#include "memory.h"

static const size_t SIZES[] = {1,       100,     1 << 20, (4 << 20) - 1, 4 << 20,
                               5 << 20, 9 << 20, 3 << 20, 4 << 20,       64};
enum { COUNT = sizeof SIZES / sizeof *SIZES };

static uint8_t pattern(size_t at) {
    return (uint8_t)(at * 0x9e3779b1u >> 24);
}

/* The first `kept` bytes are as they were; writes all. */
static void look_and_fill(uint8_t *byte, size_t kept, size_t size) {
    assert_non_null(byte);
    assert_int_equal((uintptr_t)byte % _Alignof(max_align_t), 0);
    size_t different = 0;
    for (size_t i = 0; i < kept; i++)
        different += byte[i] != pattern(i);
    assert_int_equal(different, 0);
    for (size_t i = 0; i < size; i++)
        byte[i] = pattern(i);
}

static size_t kept_at(int i) {
    return i == 0 ? 0 : SIZES[i - 1] < SIZES[i] ? SIZES[i - 1] : SIZES[i];
}

static void blocks_keep_what_they_hold(void **state) {
    (void)state;
    uint8_t *block = NULL;
    for (int i = 0; i < COUNT; i++) {
        block = hs_reallocate(block, SIZES[i]);
        look_and_fill(block, kept_at(i), SIZES[i]);
    }
    free(block);
}

static void arrays_keep_what_they_hold(void **state) {
    (void)state;
    uint8_t *array[32] = {NULL};
    for (int i = 0; i < COUNT; i++)
        for (uint32_t n = 0; n < 32; n += 31) {
            array[n] = hs_array_reallocate(array[n], SIZES[i], n);
            look_and_fill(array[n], kept_at(i), SIZES[i]);
        }
    for (uint32_t n = 0; n < 32; n++)
        hs_array_free(array[n]);
}

static void more_than_there_is_is_refused_and_the_old_one_stays(void **state) {
    (void)state;
    uint8_t *array = hs_array_reallocate(NULL, 100, 3);
    look_and_fill(array, 0, 100);
    assert_null(hs_array_reallocate(array, SIZE_MAX, 3));
    assert_null(hs_array_reallocate(array, SIZE_MAX / 2, 3));
    look_and_fill(array, 100, 100);
    hs_array_free(array);
    uint8_t *block = hs_reallocate(NULL, 100);
    look_and_fill(block, 0, 100);
    assert_null(hs_reallocate(block, SIZE_MAX / 2));
    look_and_fill(block, 100, 100);
    free(block);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blocks_keep_what_they_hold),
        cmocka_unit_test(arrays_keep_what_they_hold),
        cmocka_unit_test(more_than_there_is_is_refused_and_the_old_one_stays),
    };
    return cmocka_run_group_tests_name("memory", tests, NULL, NULL);
}
