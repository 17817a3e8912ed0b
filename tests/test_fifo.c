/* SPDX-License-Identifier: Apache-2.0
 *
 * The FIFO (rtl/fifo.sv) against an array: with 2, 4 and 16 words, whatever the pace on its two
 * sides.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "fifo_shim.h"

static const uint32_t depths[FIFO_LANES] = {2, 4, 16};

/* One cycle of a lane agrees with a queue that holds the words number out .. in-1; word n is n
 * hashed. Moves the queue on. */
struct queue {
    uint32_t in, out;
};

static uint32_t word_of(uint32_t number) {
    return number * 2654435761u ^ 0x1234567;
}

static void assert_agrees(struct queue *q, const fifo_wires *w, uint32_t depth) {
    uint32_t level = q->in - q->out;
    assert_int_equal(w->level, level);
    assert_int_equal(w->in_ready, level < depth);
    assert_int_equal(w->out_valid, level > 0);
    if (level > 0) assert_int_equal(w->out_data, word_of(q->out));
    q->in += w->in_valid && level < depth;
    q->out += w->out_ready && level > 0;
}

static void every_pace_keeps_order_and_level(void **state) {
    (void)state;
    static const uint32_t paces[] = {0, 10, 50, 90, 100}; /* per cent of the cycles */
    fifo_shim *shim = fifo_new(1);
    struct queue queue[FIFO_LANES] = {0};
    fifo_wires wires[FIFO_LANES] = {0};
    uint32_t random = 1;
    for (uint32_t cycle = 0; cycle < 25 * 400; cycle++) {
        uint32_t in_pace = paces[cycle / 400 % 5], out_pace = paces[cycle / 2000];
        for (int i = 0; i < FIFO_LANES; i++) {
            random = random * 1664525 + 1013904223;
            bool held = wires[i].in_valid && !wires[i].in_ready;
            wires[i].in_valid = held || (random >> 16) % 100 < in_pace;
            wires[i].in_data = word_of(queue[i].in);
            random = random * 1664525 + 1013904223;
            wires[i].out_ready = (random >> 16) % 100 < out_pace;
        }
        fifo_cycle(shim, false, wires);
        for (int i = 0; i < FIFO_LANES; i++)
            assert_agrees(&queue[i], &wires[i], depths[i]);
    }
    for (int i = 0; i < FIFO_LANES; i++)
        assert_true(queue[i].out > 1000);
    fifo_free(shim);
}

static void a_word_a_cycle_goes_through(void **state) {
    (void)state;
    fifo_shim *shim = fifo_new(2);
    struct queue queue[FIFO_LANES] = {0};
    for (uint32_t cycle = 0; cycle < 100; cycle++) {
        fifo_wires wires[FIFO_LANES];
        for (int i = 0; i < FIFO_LANES; i++)
            wires[i] = (fifo_wires){true, true, word_of(queue[i].in), false, false, 0, 0};
        fifo_cycle(shim, false, wires);
        for (int i = 0; i < FIFO_LANES; i++)
            assert_agrees(&queue[i], &wires[i], depths[i]);
    }
    for (int i = 0; i < FIFO_LANES; i++)
        assert_int_equal(queue[i].out, 99);
    fifo_free(shim);
}

static void reset_empties_it(void **state) {
    (void)state;
    fifo_shim *shim = fifo_new(3);
    fifo_wires wires[FIFO_LANES] = {0};
    for (uint32_t cycle = 0; cycle < 20; cycle++) {
        for (int i = 0; i < FIFO_LANES; i++)
            wires[i].in_valid = true;
        fifo_cycle(shim, false, wires);
    }
    for (int i = 0; i < FIFO_LANES; i++)
        assert_int_equal(wires[i].level, depths[i]);
    memset(wires, 0, sizeof wires);
    fifo_cycle(shim, true, wires);
    fifo_cycle(shim, false, wires);
    for (int i = 0; i < FIFO_LANES; i++) {
        assert_int_equal(wires[i].level, 0);
        assert_false(wires[i].out_valid);
        assert_true(wires[i].in_ready);
    }
    fifo_free(shim);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pace_keeps_order_and_level),
        cmocka_unit_test(a_word_a_cycle_goes_through),
        cmocka_unit_test(reset_empties_it),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
