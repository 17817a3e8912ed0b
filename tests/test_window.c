/* SPDX-License-Identifier: Apache-2.0
 *
 * Do the windows before the banks (rtl/gather.sv, rtl/scatter.sv) lose, mix up or hold up anything?
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

#include "window_shim.h"

static uint32_t random_state;

static uint32_t random_below(uint32_t n) {
    random_state = random_state * 1664525 + 1013904223;
    return (random_state >> 8) % n;
}

static const window_item nothing;

/* words: how many of the memory's the item may name; few make many conflicts. */
static window_item random_item(uint32_t words, uint16_t number) {
    window_item item = {.valid = true, .mask = (uint8_t)random_below(16), .number = number};
    for (int i = 0; i < 4; i++) {
        item.index[i] = (uint8_t)random_below(words);
        item.data[i] = (uint8_t)random_below(256);
    }
    return item;
}

/* Offers an item until it is taken. Gives the cycles that it took. */
static uint32_t write_item(window_shim *shim, const window_item *item) {
    uint32_t cycles = 1;
    while (!window_cycle(shim, item, &nothing, false).write_ready)
        assert_true(++cycles < 100);
    return cycles;
}

static void drain_writes(window_shim *shim) {
    for (uint32_t cycles = 0; window_cycle(shim, &nothing, &nothing, false).write_active; cycles++)
        assert_true(cycles < 100);
}

static void fill(window_shim *shim, uint8_t memory[WINDOW_WORDS]) {
    for (uint32_t w = 0; w < WINDOW_WORDS; w += 4) {
        window_item item = {.valid = true, .mask = 15};
        for (uint8_t i = 0; i < 4; i++) {
            item.index[i] = (uint8_t)(w + i);
            item.data[i] = memory[w + i] = (uint8_t)random_below(256);
        }
        write_item(shim, &item);
    }
    drain_writes(shim);
}

/* --- Reading ------------------------------------------------------------------------------------
 */

enum { QUEUE = 64 };

/* Items that were taken and have not come out. */
typedef struct {
    window_item item[QUEUE];
    uint32_t taken, seen;
} queue;

static void check_out(queue *q, const window_wires *wires, const uint8_t *memory) {
    assert_true(q->seen < q->taken);
    const window_item *item = &q->item[q->seen++ % QUEUE];
    assert_int_equal(wires->number, item->number);
    for (int i = 0; i < 4; i++)
        if (item->mask >> i & 1) assert_int_equal(wires->data[i], memory[item->index[i]]);
}

/* One cycle of reading; gives whether the item was taken. */
static bool read_cycle(window_shim *shim, queue *q, const window_item *item, bool stall,
                       const uint8_t *memory) {
    const window_wires wires = window_cycle(shim, &nothing, item, stall);
    if (wires.out) check_out(q, &wires, memory);
    assert_true(wires.read_active == (q->seen < q->taken) || wires.out);
    if (!item->valid || !wires.read_ready) return false;
    assert_false(stall);
    q->item[q->taken++ % QUEUE] = *item;
    assert_true(q->taken - q->seen <= GATHER_WINDOW);
    return true;
}

static void items_leave_in_order_with_their_words(void **state) {
    (void)state;
    static const uint32_t words[] = {64, 12, 3, 1};
    for (uint32_t seed = 0; seed < 8; seed++) {
        window_shim *shim = window_new(seed);
        uint8_t memory[WINDOW_WORDS];
        queue q = {0};
        random_state = seed;
        fill(shim, memory);
        window_item item = random_item(64, 0);
        for (uint32_t cycle = 0; cycle < 20000; cycle++) {
            const bool stall = seed % 2 && random_below(4) == 0;
            const bool gap = seed % 3 && random_below(3) == 0;
            if (read_cycle(shim, &q, gap ? &nothing : &item, stall, memory))
                item = random_item(words[seed % 4], (uint16_t)q.taken);
        }
        for (uint32_t cycle = 0; q.seen < q.taken; cycle++) {
            assert_true(cycle < 100);
            read_cycle(shim, &q, &nothing, false, memory);
        }
        assert_true(q.taken > 2000);
        window_free(shim);
    }
}

static void behind_a_stall_the_window_is_all_that_comes(void **state) {
    (void)state;
    window_shim *shim = window_new(5);
    uint8_t memory[WINDOW_WORDS];
    queue q = {0};
    fill(shim, memory);
    const window_item same = {.valid = true, .mask = 15, .index = {8, 16, 24, 32}}; /* one bank */
    for (uint32_t cycle = 0; cycle < 60; cycle++)
        read_cycle(shim, &q, &same, false, memory);
    const uint32_t inside = q.taken - q.seen;
    assert_int_equal(inside, GATHER_WINDOW);
    for (uint32_t cycle = 0; cycle < 100; cycle++)
        read_cycle(shim, &q, &same, true, memory);
    assert_int_equal(q.seen, q.taken);
    window_free(shim);
}

/* --- Writing ------------------------------------------------------------------------------------
 */

static void writes_to_one_word_keep_their_order(void **state) {
    (void)state;
    static const uint32_t words[] = {64, 20, 9, 2};
    for (uint32_t seed = 0; seed < 40; seed++) {
        window_shim *shim = window_new(seed);
        uint8_t memory[WINDOW_WORDS];
        queue q = {0};
        random_state = seed;
        fill(shim, memory);
        for (uint32_t n = 0; n < 300; n++) {
            const window_item item = random_item(words[seed % 4], 0);
            for (int i = 0; i < 4; i++)
                if (item.mask >> i & 1) memory[item.index[i]] = item.data[i];
            write_item(shim, &item);
            if (random_below(4) == 0) window_cycle(shim, &nothing, &nothing, false);
        }
        drain_writes(shim);
        for (uint8_t w = 0; w < WINDOW_WORDS; w += 4) {
            const window_item item = {
                .valid = true,
                .mask = 15,
                .index = {w, (uint8_t)(w + 1), (uint8_t)(w + 2), (uint8_t)(w + 3)}};
            while (!read_cycle(shim, &q, &item, false, memory)) {
            }
        }
        while (q.seen < q.taken)
            read_cycle(shim, &q, &nothing, false, memory);
        window_free(shim);
    }
}

/* --- Rates --------------------------------------------------------------------------------------
 */

/* Cycles that a number of items take to be read and to be written, all lanes in use. */
static void count_cycles(window_shim *shim, bool random, uint32_t items, uint32_t cycles[2]) {
    uint8_t memory[WINDOW_WORDS];
    queue q = {0};
    fill(shim, memory);
    cycles[0] = cycles[1] = 0;
    for (uint32_t n = 0; n < items; n++) {
        window_item item = random_item(64, (uint16_t)n);
        item.mask = 15;
        for (int i = 0; !random && i < 4; i++) /* 4 lanes, 4 banks */
            item.index[i] = (uint8_t)(item.index[i] / 4 * 4 + i);
        do
            cycles[0]++;
        while (!read_cycle(shim, &q, &item, false, memory));
    }
    for (uint32_t n = 0; n < items; n++) {
        window_item item = random_item(64, 0);
        item.mask = 15;
        for (int i = 0; !random && i < 4; i++)
            item.index[i] = (uint8_t)(item.index[i] / 4 * 4 + i);
        cycles[1] += write_item(shim, &item);
    }
}

static void an_item_goes_through_in_every_cycle(void **state) {
    (void)state;
    window_shim *shim = window_new(3);
    uint32_t cycles[2];
    random_state = 9;
    count_cycles(shim, false, 1000, cycles);
    assert_int_equal(cycles[0], 1000);
    assert_int_equal(cycles[1], 1000);
    count_cycles(shim, true, 20000, cycles);
    print_message("random words in 8 banks: %.3f cycles an item read, %.3f written\n",
                  cycles[0] / 20000.0, cycles[1] / 20000.0);
    assert_true(cycles[0] < 20000 * 1.02 && cycles[1] < 20000 * 1.05);
    window_free(shim);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(items_leave_in_order_with_their_words),
        cmocka_unit_test(behind_a_stall_the_window_is_all_that_comes),
        cmocka_unit_test(writes_to_one_word_keep_their_order),
        cmocka_unit_test(an_item_goes_through_in_every_cycle),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
