/* SPDX-License-Identifier: Apache-2.0
 *
 * Frames: a file of packets gives them back as they were, whatever is in them, or names the byte
 * that is wrong.
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "stream.h"

static void make_packet(hs_packet *packet, uint32_t view, size_t words) {
    hs_error err;
    *packet = (hs_packet){.view = view};
    for (uint32_t i = 0; i < words; i += 4) {
        const uint32_t record[4] = {0xff800001 + i, i * i, 0x01020304, ~i};
        assert_true(hs_packet_append(packet, record, 1, &err));
    }
}

/* A file in memory with two packets. */
static uint8_t *write_frames(size_t *size) {
    hs_packet first, second;
    hs_error err;
    make_packet(&first, 7, 100);
    make_packet(&second, 0xffff, 12);
    char *bytes = NULL;
    FILE *file = open_memstream(&bytes, size);
    assert_non_null(file);
    assert_true(hs_frame_write(file, &first, "memory", &err));
    assert_true(hs_frame_write(file, &second, "memory", &err));
    fclose(file);
    hs_packet_free(&first);
    hs_packet_free(&second);
    return (uint8_t *)bytes;
}

static void frames_bring_packets_back(void **state) {
    (void)state;
    size_t size, offset = 0;
    uint8_t *bytes = write_frames(&size);
    const uint8_t head[16] = {'H', 'S', '2', 'F', 7, 0, 0, 0, 100, 0, 0, 0, 0, 0, 0, 0};
    assert_memory_equal(bytes, head, 16);
    assert_int_equal(size, 16 + 400 + 16 + 48);
    assert_memory_equal(bytes + 16, ((uint8_t[]){1, 0, 0x80, 0xff}), 4); /* little-endian */

    hs_packet packet = {0}, first;
    make_packet(&first, 7, 100);
    hs_error err;
    assert_true(hs_frame_read(&packet, bytes, size, &offset, "memory", &err));
    assert_int_equal(offset, 416);
    assert_int_equal(packet.view, 7);
    assert_int_equal(packet.words, first.words);
    assert_memory_equal(packet.word, first.word, 4 * first.words);
    assert_true(hs_frame_read(&packet, bytes, size, &offset, "memory", &err));
    assert_int_equal(offset, size);
    assert_int_equal(packet.view, 0xffff);
    assert_int_equal(packet.words, 12);
    assert_false(hs_frame_read(&packet, bytes, size, &offset, "memory", &err));
    assert_int_equal(packet.words, 0);
    hs_packet_free(&packet);
    hs_packet_free(&first);
    free(bytes);
}

static void a_broken_frame_names_its_byte(void **state) {
    (void)state;
    static const struct {
        size_t byte;
        uint8_t value;
        const char *cause;
    } fault[] = {{0, 'h', "memory: byte 0: 0x46325368 is not the frame's magic word"},
                 {6, 1, "memory: byte 4: view 65543"},
                 {8, 101, "memory: byte 8: a packet of 101 words"},
                 {8, 0, "memory: byte 8: a packet of 0 words"},
                 {11, 0xff, "memory: byte 16: the file ends inside a packet of 4278190180 words"},
                 {13, 1, "memory: byte 12: the frame's last word is 0x00000100"}};
    hs_packet packet = {0};
    hs_error err;
    for (size_t i = 0; i < sizeof fault / sizeof *fault; i++) {
        size_t size, offset = 0;
        uint8_t *bytes = write_frames(&size);
        bytes[fault[i].byte] = fault[i].value;
        assert_false(hs_frame_read(&packet, bytes, size, &offset, "memory", &err));
        assert_int_equal(err.code, HS_EXIT_STREAM);
        assert_int_equal(offset, 0);
        if (!strstr(err.text, fault[i].cause)) fail_msg("%s: %s", fault[i].cause, err.text);
        free(bytes);
    }
    size_t size;
    uint8_t *bytes = write_frames(&size);
    for (size_t short_size = 0; short_size < 416; short_size++) {
        size_t offset = 0;
        uint8_t *exact = malloc(short_size + 1); /* for the address sanitizer */
        assert_non_null(exact);
        memcpy(exact, bytes, short_size);
        assert_false(hs_frame_read(&packet, exact, short_size, &offset, "memory", &err));
        free(exact);
    }
    free(bytes);
    hs_packet_free(&packet);
}

static void what_no_frame_can_hold_is_not_written(void **state) {
    (void)state;
    hs_packet packet;
    hs_error err;
    make_packet(&packet, 7, 100);
    char *bytes = NULL;
    size_t size;
    FILE *file = open_memstream(&bytes, &size);
    assert_non_null(file);
    packet.view = 0x10000;
    assert_false(hs_frame_write(file, &packet, "memory", &err));
    packet.view = 1;
    packet.words = 99;
    assert_false(hs_frame_write(file, &packet, "memory", &err));
    packet.words = 0;
    assert_false(hs_frame_write(file, &packet, "memory", &err));
    assert_int_equal(err.code, HS_EXIT_STREAM);
    fclose(file);
    assert_int_equal(size, 0);
    free(bytes);

    /* A file that is full after 40 bytes. */
    packet.words = 100;
    char room[40];
    file = fmemopen(room, sizeof room, "wb");
    assert_non_null(file);
    setvbuf(file, NULL, _IONBF, 0);
    assert_false(hs_frame_write(file, &packet, "small", &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    fclose(file);
    hs_packet_free(&packet);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(frames_bring_packets_back),
        cmocka_unit_test(a_broken_frame_names_its_byte),
        cmocka_unit_test(what_no_frame_can_hold_is_not_written),
    };
    return cmocka_run_group_tests_name("frame", tests, NULL, NULL);
}
