/* SPDX-License-Identifier: Apache-2.0
 *
 * The register map of definitions.def, as a bus master and the pipeline see it.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "definitions.h"
#include "registers_shim.h"

enum { COUNTERS = 6 };

static uint32_t read_ok(registers_rtl *rtl, uint32_t address) {
    uint32_t data = 0;
    assert_int_equal(registers_rtl_read(rtl, address, &data, NULL), OKAY);
    return data;
}

static void write_ok(registers_rtl *rtl, uint32_t address, uint32_t data) {
    assert_int_equal(registers_rtl_write(rtl, address, data, 15), OKAY);
}

static const struct {
    uint32_t address;
    const char *access;
} registers[] = {
#define CONSTANT(name, value, what)
#define RECORD(name, value, what)
#define STATUS(name, value, what, remedy)
#define STAGE(name, index, what)
#define ACTIVITY(name, index, what)
#define REGISTER(name, address, access, what) {address, access},
#define PROBE(name, index, stage, what)
#define EXIT(name, value, what)
#include "definitions.def"
};
enum { REGISTERS = sizeof registers / sizeof registers[0] };

/* "ro", "rw", or NULL where no register is. */
static const char *access_of(uint32_t address) {
    for (int i = 0; i < REGISTERS; i++)
        if (registers[i].address == address) return registers[i].access;
    uint32_t behind = address - HS_REG_STAGES;
    bool counter = address >= HS_REG_STAGES && behind < 32 * HS_STAGES && behind % 4 == 0 &&
                   behind % 32 / 4 < COUNTERS;
    return counter ? "ro" : NULL;
}

static void after_reset_registers_say_who_they_are(void **unused) {
    (void)unused;
    registers_rtl *rtl = registers_rtl_new(1);
    assert_int_equal(read_ok(rtl, HS_REG_IDENTITY), HS_IDENTITY);
    assert_int_equal(read_ok(rtl, HS_REG_VERSION), HS_STREAM_VERSION);
    assert_int_equal(read_ok(rtl, HS_REG_CAPACITY_VERTICES), REGISTERS_VERTICES);
    assert_int_equal(read_ok(rtl, HS_REG_CAPACITY_QUADS), REGISTERS_QUADS);
    assert_int_equal(read_ok(rtl, HS_REG_LIMIT_VERTICES), REGISTERS_VERTICES);
    assert_int_equal(read_ok(rtl, HS_REG_LIMIT_QUADS), REGISTERS_QUADS);
    assert_int_equal(read_ok(rtl, HS_REG_BUSY), 0);
    assert_int_equal(read_ok(rtl, HS_REG_STATUS), HS_STATUS_OK);
    assert_int_equal(read_ok(rtl, HS_REG_POSITION), HS_NO_POSITION);
    assert_int_equal(read_ok(rtl, HS_REG_VIEWS), 0);
    assert_int_equal(read_ok(rtl, HS_REG_CONFLICTS), 0);
    registers_rtl_free(rtl);
}

static void every_address_answers_as_the_map_says(void **unused) {
    (void)unused;
    registers_rtl *rtl = registers_rtl_new(2);
    for (uint32_t address = 0; address < 4096; address++) {
        const char *access = access_of(address);
        uint32_t data = 1;
        assert_int_equal(registers_rtl_read(rtl, address, &data, NULL), access ? OKAY : SLVERR);
        if (!access) assert_int_equal(data, 0);
        assert_int_equal(registers_rtl_write(rtl, address, 7, 15),
                         access && !strcmp(access, "rw") ? OKAY : SLVERR);
    }
    assert_int_equal(read_ok(rtl, HS_REG_IDENTITY), HS_IDENTITY);
    assert_int_equal(read_ok(rtl, HS_REG_CAPACITY_VERTICES), REGISTERS_VERTICES);
    assert_int_equal(read_ok(rtl, HS_REG_VIEWS), 0);
    registers_rtl_free(rtl);
}

static void limits_are_cut_to_the_capacities(void **unused) {
    (void)unused;
    registers_rtl *rtl = registers_rtl_new(3);
    static const uint32_t values[] = {0, 1, 999, 1000, 1001, 2000, 2001, 1u << 25, 0xffffffff};
    for (size_t i = 0; i < sizeof values / sizeof *values; i++) {
        uint32_t v = values[i], vertices, quads;
        write_ok(rtl, HS_REG_LIMIT_VERTICES, v);
        write_ok(rtl, HS_REG_LIMIT_QUADS, v);
        registers_rtl_limits(rtl, &vertices, &quads);
        assert_int_equal(vertices, v < REGISTERS_VERTICES ? v : REGISTERS_VERTICES);
        assert_int_equal(quads, v < REGISTERS_QUADS ? v : REGISTERS_QUADS);
        assert_int_equal(read_ok(rtl, HS_REG_LIMIT_VERTICES), vertices);
        assert_int_equal(read_ok(rtl, HS_REG_LIMIT_QUADS), quads);
    }
    /* Only the bytes whose strobe is set: 0x2aa becomes 0x255. */
    write_ok(rtl, HS_REG_LIMIT_VERTICES, 0x2aa);
    assert_int_equal(registers_rtl_write(rtl, HS_REG_LIMIT_VERTICES, 0x155, 1), OKAY);
    assert_int_equal(read_ok(rtl, HS_REG_LIMIT_VERTICES), 0x255);
    assert_int_equal(registers_rtl_write(rtl, HS_REG_LIMIT_VERTICES, 0x155, 0), OKAY);
    assert_int_equal(read_ok(rtl, HS_REG_LIMIT_VERTICES), 0x255);
    registers_rtl_free(rtl);
}

static void the_latest_view_is_what_status_and_position_tell(void **unused) {
    (void)unused;
    registers_rtl *rtl = registers_rtl_new(4);
    for (uint32_t view = 1; view <= 5; view++) {
        pipeline_cycle work = {.view_busy = true, .status = 99, .position = 98};
        registers_rtl_cycle(rtl, &work);
        assert_int_equal(read_ok(rtl, HS_REG_BUSY), 1);
        assert_int_equal(read_ok(rtl, HS_REG_VIEWS), view - 1);
        pipeline_cycle done = {.view_done = true, .status = 20 + view, .position = 1000 * view};
        registers_rtl_cycle(rtl, &done);
        assert_int_equal(read_ok(rtl, HS_REG_BUSY), 0);
        assert_int_equal(read_ok(rtl, HS_REG_VIEWS), view);
        assert_int_equal(read_ok(rtl, HS_REG_STATUS), 20 + view);
        assert_int_equal(read_ok(rtl, HS_REG_POSITION), 1000 * view);
    }
    registers_rtl_free(rtl);
}

static void counters_hold_what_the_stages_did_and_add_up_to_the_cycles(void **unused) {
    (void)unused;
    registers_rtl *rtl = registers_rtl_new(5);
    uint32_t expected[HS_STAGES][COUNTERS] = {{0}}, conflicts = 0;
    srand(11);
    for (int round = 0; round < 4; round++) {
        for (int i = 0; i < 1000; i++) {
            pipeline_cycle c = {.conflicts = (uint32_t)rand() % 16};
            conflicts += c.conflicts;
            for (uint32_t s = 0; s < HS_STAGES; s++) {
                uint32_t what = ((uint32_t)rand() + s) % 5, in = (uint32_t)rand() % 8;
                uint32_t out = (uint32_t)rand() % 8;
                uint32_t *activity[] = {&c.busy, &c.starved, &c.blocked};
                if (what < 3) {
                    *activity[what] |= 1u << s;
                    expected[s][what]++;
                }
                c.in |= in << 3 * s;
                c.out |= out << 3 * s;
                expected[s][4] += in;
                expected[s][5] += out;
            }
            registers_rtl_cycle(rtl, &c);
        }
        uint32_t cycles = 0;
        uint64_t taken = 0;
        assert_int_equal(registers_rtl_read(rtl, HS_REG_CYCLES, &cycles, &taken), OKAY);
        assert_int_equal(cycles, taken);
        assert_int_equal(read_ok(rtl, HS_REG_CYCLES_HIGH), 0);
        assert_int_equal(read_ok(rtl, HS_REG_CONFLICTS), conflicts);
        for (uint32_t s = 0; s < HS_STAGES; s++) {
            uint32_t sum = 0;
            for (uint32_t k = 0; k < COUNTERS; k++) {
                uint32_t got = read_ok(rtl, HS_REG_STAGES + 32 * s + 4 * k);
                if (k != HS_ACTIVITY_idle) assert_int_equal(got, expected[s][k]);
                if (k < HS_ACTIVITIES) sum += got;
            }
            assert_int_equal(sum, cycles);
        }
    }
    registers_rtl_free(rtl);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(after_reset_registers_say_who_they_are),
        cmocka_unit_test(every_address_answers_as_the_map_says),
        cmocka_unit_test(limits_are_cut_to_the_capacities),
        cmocka_unit_test(the_latest_view_is_what_status_and_position_tell),
        cmocka_unit_test(counters_hold_what_the_stages_did_and_add_up_to_the_cycles),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
