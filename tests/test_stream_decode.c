/* SPDX-License-Identifier: Apache-2.0
 *
 * What decode accepts is an output packet and nothing else.
 */
#include "stream_samples.h"

static void a_packet_of_every_kind_of_record_decodes(void **state) {
    (void)state;
    hs_packet packet;
    make_sample(&packet);
    hs_output out;
    hs_error err;
    if (!hs_output_decode(&out, &packet, &err)) fail_msg("%s", err.text);
    assert_int_equal(out.view, 7);
    assert_int_equal(out.status, HS_STATUS_OK);
    assert_int_equal(out.error_position, HS_NO_POSITION);
    assert_int_equal(out.exponent, 1);
    assert_int_equal(out.generations, 2);
    assert_int_equal(out.vertices, 11);
    assert_int_equal(out.faces, 5);
    assert_int_equal(out.triangles, 2);
    assert_int_equal(out.corners, 23);
    const uint32_t number[11] = {0, 0xabcdef, 0xffffff, 17, 21, 22, 23, 24, 25, 26, 27};
    const uint32_t first[6] = {0, 3, 12, 15, 19, 23};
    const uint32_t corner[23] = {3, 2, 0,  0, 1, 2, 3,  4, 5, 6, 7, 8,
                                 8, 9, 10, 4, 9, 5, 10, 4, 5, 6, 0};
    assert_memory_equal(out.number, number, sizeof number);
    assert_memory_equal(out.first, first, sizeof first);
    assert_memory_equal(out.corner, corner, sizeof corner);
    assert_memory_equal(out.generation, ((uint8_t[]){0, 0, 1, 2, 1}), 5);
    assert_memory_equal(out.candidate, ((uint8_t[]){1, 1, 0, 0, 1}), 5);
    assert_memory_equal(out.position, packet.word + 8, 64);
    assert_memory_equal(out.position + 40, packet.word + 76, 16);
    hs_output_free(&out);
    hs_packet_free(&packet);
}

static void a_refused_view_decodes_without_vertices_and_faces(void **state) {
    (void)state;
    hs_packet packet;
    make_refused(&packet);
    hs_output out;
    hs_error err;
    if (!hs_output_decode(&out, &packet, &err)) fail_msg("%s", err.text);
    assert_int_equal(out.status, HS_STATUS_BAD_CRC);
    assert_int_equal(out.error_position, 123);
    assert_int_equal(out.vertices + out.faces + out.corners, 0);
    hs_output_free(&out);
    hs_packet_free(&packet);
}

/* Fails the test unless the packet is refused with a message that says all of `cause`. */
static void expect_refusal(const hs_packet *packet, const char *cause) {
    hs_output out;
    hs_error err = {0};
    if (hs_output_decode(&out, packet, &err)) {
        hs_output_free(&out);
        fail_msg("not detected: %s", cause);
    }
    assert_int_equal(err.code, HS_EXIT_STREAM);
    assert_null(out.position);
    if (!strstr(err.text, cause)) fail_msg("\"%s\" is not in \"%s\"", cause, err.text);
}

static void every_corrupted_word_is_detected(void **state) {
    (void)state;
    for (int refused = 0; refused < 2; refused++) {
        hs_packet packet;
        refused ? make_refused(&packet) : make_sample(&packet);
        for (size_t i = 0; i < packet.words; i++)
            for (uint32_t bit = 0; bit < 34; bit++) {
                uint32_t flip = bit < 32 ? 1u << bit : bit == 32 ? 0xffffffff : 0x00550055;
                packet.word[i] ^= flip;
                expect_refusal(&packet, "view 7");
                packet.word[i] ^= flip;
            }
        hs_packet_free(&packet);
    }
}

static void every_truncation_is_detected(void **state) {
    (void)state;
    hs_packet packet;
    make_sample(&packet);
    for (size_t words = packet.words; words-- > 0;) {
        packet.words = words;
        expect_refusal(&packet, "view 7");
    }
    packet.words = 20;
    expect_refusal(&packet,
                   "word 4 (head of a group of 4 vertices, generation 0): the packet ends");
    packet.words = 68;
    expect_refusal(&packet, "the packet ends inside the face");
    packet.words = 8;
    expect_refusal(&packet, "8 words; a packet has three records of 4 words or more");
    hs_packet_free(&packet);
}

static void a_wrong_packet_with_a_right_crc_is_refused_with_its_cause(void **state) {
    (void)state;
    static const struct {
        size_t word;
        uint32_t value;
        const char *cause;
    } fault[] = {
        {0, 0xff800102, "word 0 (header, version): 0xff800102 is not the header of version 2"},
        {0, 0xff800000, "output packet of view 7: it is of stream version 0"},
        {0, 0xff800001, "it is of stream version 1, and version 2 is read here"},
        {0, 0xff800003, "it is of stream version 3, and version 2 is read here"},
        {0, 0xff8000ff, "it is of stream version 255"},
        {1, 8, "word 1 (header, view): it is the header of view 8"},
        {2, 129, "word 2 (header, block exponent): no binary32 has the block exponent 129"},
        {2, 0xffffff6b, "no binary32 has the block exponent -149"},
        {3, 1, "word 3 (header, reserved): 0x00000001 in a reserved word"},
        {4, 0xff940100, "word 4 (head of a group of 4 vertices, generation 0): 0xff940100 sets"},
        {4, 0xff900000, "a group of 0 vertices"},
        {4, 0xff950000, "a group of 5 vertices"},
        {4, 0xff930000, "an unused number is not zero"},
        {4, 0xff940002, "vertices of generation 0 behind faces of generation 2"},
        {4, 0xff9400fb, "generation 251 is deeper than 250"},
        {5, 0x16000000, "vertex 11259375 was not sent"}, /* it became vertex 0xabcd16 */
        {8, 0x7f800000, "word 8 (position of vertex 0 (x)): inf is not below the block's 2^1"},
        {13, 0xc0000000, "word 13 (position of vertex 11259375 (y)): -2 is not below"},
        {19, 0x7fc00000, "word 19 (position of vertex 16777215 (w)): nan is not below"},
        {20, 0xffb00000, "word 20 (more vertices of no face): the group before it announces 4"},
        {25, 17 | 22 << 24,
         "word 25 (numbers 1 and 2 of a group of 4 vertices): vertex 17 is sent"},
        {45, 25 | 1 << 24, "word 45 (numbers 1 and 2 of a group of 1 vertices): an unused number"},
        {52, 0x3f800000, "word 52 (position of no vertex (x)): a position that no group announces"},
        {52, 0xffa30300, "sets reserved bits"},
        {52, 0xffa10200, "a face of 2 sides in generation 0"},
        {52, 0xfff10300, "word 52 (record of unknown kind 7): this kind of record has no place"},
        {52, 0xffc10300, "word 52 (trailer, status): this kind of record has no place here"},
        {53, 18 | 0xffu << 24, "word 53 (face 0 of generation 0, vertices 1 and 2): vertex 18 was"},
        {55, 1 << 8, "word 55 (face 0 of generation 0, vertices 3 and 4): an unused number is not"},
        {56, 0xffa10901, "a face of 9 sides in generation 1"},
        {60, 0xffb00300, "word 60 (face 1 of generation 0, head of 3 more vertices): 0xffb00300"},
        {60, 0xffb00401, "0xffb00401 instead of 0xffb00400, which is due for the face"},
        {64, 0xffb00200, "instead of 0xffb00100"},
        {65, 99, "word 65 (face 1 of generation 0, vertices 9 and 10): vertex 99 was not sent"},
        {66, 1, "word 65 (face 1 of generation 0, vertices 9 and 10): an unused number"},
        {68, 0xff920002, "generation 1 behind generation 2"},
        {80, 0xffa00300,
         "word 80 (face 2 of generation 0, head: 3 sides, no candidate): generation 0"},
        {84, 0xffa00403, "generation 1 behind generation 3"},
        {88, 0xffa10400, "generation 0 behind generation 2"},
        {92, 0xffd00000, "word 92 (end, last generation): no trailer before the last record"},
        {92, 0xffc00100, "sets reserved bits"},
        {92, 0xffc00003, "3 is no status"},
        {92, 0xffc00010, "a refused view (BAD_MAGIC) has a block exponent"},
        {93, 0, "word 93 (trailer, position): position 0x00000000 with status OK"},
        {94, 10, "word 94 (trailer, vertices sent): it says 10, the packet has 11"},
        {95, 6, "word 95 (trailer, faces sent): it says 6, the packet has 5"},
        {96, 0xffc00002, "word 96 (trailer, status): the packet does not end with an end record"},
        {96, 0xffd00102, "sets reserved bits"},
        {96, 0xffd00003, "word 96 (end, last generation): generation 3, but faces left in"},
        {96, 0xffd00001, "generation 1, but faces left in generation 2"},
        {97, 1, "word 97 (end, triangles sent): it says 1, the packet has 2"},
        {98, 12, "word 98 (end, vertices at their level): 12 vertices at their level of 11"},
    };
    for (size_t i = 0; i < sizeof fault / sizeof *fault; i++) {
        hs_packet packet;
        make_sample(&packet);
        packet.word[fault[i].word] = fault[i].value;
        fix_crc(&packet);
        expect_refusal(&packet, fault[i].cause);
        hs_packet_free(&packet);
    }
}

/* Of a view that met a memory's fault, the trailer is looked at, and nothing before it. */
static void the_trailer_of_a_memory_fault_is_checked(void **state) {
    (void)state;
    static const struct {
        size_t word;
        uint32_t bit;
    } wrong[] = {{4, 1 << 9}, {4, 1 << 19}, {5, 1}, {8, 1 << 20}, {11, 1}};
    for (size_t i = 0; i <= sizeof wrong / sizeof *wrong; i++) {
        hs_packet packet = {.view = 7};
        hs_output out;
        hs_error err;
        put(&packet, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), 7, 1, 0);
        put(&packet, hs_tag(HS_RECORD_TRAILER, HS_STATUS_MEMORY_FAULT), HS_NO_POSITION, 3, 1);
        put_end(&packet, 0, 0);
        if (i > 0) {
            packet.word[wrong[i - 1].word] ^= wrong[i - 1].bit;
            if (wrong[i - 1].word < 11) fix_crc(&packet);
        }
        assert_int_equal(hs_output_decode(&out, &packet, &err), i == 0);
        if (i > 0) {
            char place[20];
            snprintf(place, sizeof place, ": word %zu (", wrong[i - 1].word);
            assert_non_null(strstr(err.text, place));
        }
        hs_output_free(&out);
        hs_packet_free(&packet);
    }
}

static void records_are_found(void **state) {
    (void)state;
    hs_packet packet = {.view = 7};
    put(&packet, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), 7, 1, 0);
    put(&packet, hs_tag(HS_RECORD_TRAILER, HS_STATUS_OK), HS_NO_POSITION, 0, 0);
    put_end(&packet, 0, 0);
    assert_int_equal(hs_packet_find(&packet, HS_RECORD_HEADER), 0);
    assert_int_equal(hs_packet_find(&packet, HS_RECORD_TRAILER), 4);
    assert_int_equal(hs_packet_find(&packet, HS_RECORD_END), 8);
    assert_int_equal(hs_packet_find(&packet, HS_RECORD_FACE), SIZE_MAX);
    hs_packet_free(&packet);
}

static void groups_that_are_not_filled_up_are_refused(void **state) {
    (void)state;
    hs_packet packet = {.view = 7};
    put(&packet, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), 7, 1, 0);
    put_numbers(&packet, hs_tag(HS_RECORD_VERTICES, 1 << 16), 1, 0, 0, 0);
    put_positions(&packet, 1);
    put_numbers(&packet, hs_tag(HS_RECORD_VERTICES, 2 << 16), 2, 3, 0, 0);
    put_positions(&packet, 2);
    put_numbers(&packet, hs_tag(HS_RECORD_FACE, 3 << 8), 1, 2, 3, 0);
    put(&packet, hs_tag(HS_RECORD_TRAILER, HS_STATUS_OK), HS_NO_POSITION, 3, 1);
    put_end(&packet, 0, 1);
    expect_refusal(&packet, "the group before it has fewer than 4 vertices");
    /* A new generation may open a group of its own. */
    packet.word[12] += 1;
    packet.word[24] += 1;
    packet.word[32] += 1;
    fix_crc(&packet);
    hs_output out;
    hs_error err;
    if (!hs_output_decode(&out, &packet, &err)) fail_msg("%s", err.text);
    hs_output_free(&out);
    /* The triangle of a step that left nothing active: the generation behind it is reached. */
    packet.word[32] += 1;
    fix_crc(&packet);
    if (!hs_output_decode(&out, &packet, &err)) fail_msg("%s", err.text);
    assert_int_equal(out.generations, 2);
    hs_output_free(&out);
    packet.word[32] += 1;
    expect_refusal(&packet, "generation 3, but faces left in generation 1");
    hs_packet_free(&packet);
}

static void generations_go_back_in_the_last_step_alone(void **state) {
    (void)state;
    static const char *const cause[3] = {NULL, "generation 2 behind the last one",
                                         "vertices of generation 1 behind faces of generation 1"};
    for (int i = 0; i < 3; i++) {
        hs_packet packet = {.view = 7};
        put(&packet, hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION), 7, 1, 0);
        put_numbers(&packet, hs_tag(HS_RECORD_VERTICES, 3 << 16), 1, 2, 3, 0);
        put_positions(&packet, 3);
        put_numbers(&packet, hs_tag(HS_RECORD_FACE, 3 << 8 | 0), 1, 2, 3, 0);
        put_numbers(&packet, hs_tag(HS_RECORD_FACE, 3 << 8 | 1), 1, 2, 3, 0);
        put_numbers(&packet, hs_tag(HS_RECORD_FACE, 3 << 8 | 0), 1, 2, 3, 0);
        if (i == 1) put_numbers(&packet, hs_tag(HS_RECORD_FACE, 3 << 8 | 2), 1, 2, 3, 0);
        if (i == 2) {
            put_numbers(&packet, hs_tag(HS_RECORD_VERTICES, 1 << 16 | 1), 4, 0, 0, 0);
            put_positions(&packet, 1);
        }
        uint32_t faces = i == 1 ? 4 : 3;
        put(&packet, hs_tag(HS_RECORD_TRAILER, HS_STATUS_OK), HS_NO_POSITION, i == 2 ? 4 : 3,
            faces);
        put_end(&packet, i == 1 ? 2 : 1, faces);
        if (cause[i]) {
            expect_refusal(&packet, cause[i]);
        } else {
            hs_output out;
            hs_error err;
            if (!hs_output_decode(&out, &packet, &err)) fail_msg("%s", err.text);
            hs_output_free(&out);
        }
        hs_packet_free(&packet);
    }
}

static void a_view_without_faces_is_a_refused_one(void **state) {
    (void)state;
    hs_packet packet;
    make_refused(&packet);
    packet.word[4] = hs_tag(HS_RECORD_TRAILER, HS_STATUS_OK);
    packet.word[5] = HS_NO_POSITION;
    fix_crc(&packet);
    expect_refusal(&packet, "0 vertices and 0 faces with status OK");
    hs_packet_free(&packet);
}

static void hostile_words_are_only_ever_refused_or_decoded(void **state) {
    (void)state;
    uint64_t seed = 1;
    unsigned accepted = 0;
    for (unsigned round = 0; round < 20000; round++) {
        hs_packet packet;
        make_sample(&packet);
        for (unsigned change = 0; change <= round % 4; change++) {
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            size_t at = (size_t)(seed >> 33) % packet.words;
            seed = seed * 6364136223846793005u + 1442695040888963407u;
            /* Often a word of the packet itself: a record that is right, in the wrong place. */
            packet.word[at] =
                seed >> 63 ? (uint32_t)(seed >> 31) : packet.word[(seed >> 33) % packet.words];
        }
        fix_crc(&packet);
        char text[24];
        for (size_t i = 0; i < packet.words + 5; i += 1 + round % 7) {
            memset(text, 'x', sizeof text);
            hs_output_describe(&packet, i, text, sizeof text);
            assert_non_null(memchr(text, 0, sizeof text));
        }
        hs_output out;
        hs_error err;
        if (hs_output_decode(&out, &packet, &err)) {
            for (uint32_t c = 0; c < out.corners; c++)
                assert_true(out.corner[c] < out.vertices);
            accepted++;
        }
        hs_output_free(&out);
        hs_packet_free(&packet);
    }
    /* Positions may be anything below 2^E: some changes make another good packet. */
    assert_true(accepted > 0 && accepted < 20000);
}

static void what_golden_sends_decodes(void **state) {
    (void)state;
    hs_mesh mesh;
    make_cube(&mesh);
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_non_null(golden);
    static const hs_settings settings[] = {
        {.uniform = true, .uniform_depth = 0, .guard = true},
        {.uniform = true, .uniform_depth = 4, .guard = true},
        {.uniform = true, .uniform_depth = 5},
        {.uniform = true, .uniform_depth = 3, .limit = true},
        {.front_depth = 4, .silhouette_depth = 8, .guard = true},
        {.front_depth = 4, .silhouette_depth = 8, .guard = true, .limit = true},
        {.front_depth = 4, .silhouette_depth = 7}};
    for (size_t i = 0; i < sizeof settings / sizeof *settings; i++) {
        /* Off the axes, in perspective. */
        const float matrix[16] = {1, 0.2f, 0.1f, 0.1f, -0.1f, 1, 0.3f, 0,
                                  0, 0,    -1,   2,    0.1f,  0, -1,   4};
        hs_packet in = {0}, sent = {0};
        hs_error err;
        hs_golden_report report;
        hs_output out;
        assert_true(hs_packet_encode(&in, 2, &mesh, matrix, &settings[i], &err));
        assert_true(hs_golden_run(golden, &in, &sent, &report, &err));
        assert_int_equal(report.status, HS_STATUS_OK);
        if (!hs_output_decode(&out, &sent, &err)) fail_msg("settings %zu: %s", i, err.text);
        assert_int_equal(out.faces, report.faces);
        assert_int_equal(out.at_level, report.at_level);
        assert_int_equal(out.generations + 1, report.generations);
        /* A cube has 6 faces, and step g makes 12 * 2^g of them. */
        if (settings[i].uniform)
            assert_int_equal(out.faces, i == 0 ? 6 : 12u << (settings[i].uniform_depth - 1));
        hs_output_free(&out);
        hs_packet_free(&in);
        hs_packet_free(&sent);
    }
    hs_golden_free(golden);
    hs_mesh_free(&mesh);
}
/* For messages about packets that went wrong: no more than four numbers stand in a group's head. */
static void the_fourth_of_a_group_of_seven_has_its_name(void **state) {
    (void)state;
    hs_packet packet;
    char text[80];
    make_sample(&packet);
    packet.word[4] |= 7 << 16;
    for (size_t i = 0; i < 4; i++) {
        static const char *const name[] = {"vertex 0 ", "vertex 11259375 ", "vertex 16777215 ",
                                           "vertex 17 "};
        hs_output_describe(&packet, 8 + 4 * i, text, sizeof text);
        assert_non_null(strstr(text, name[i]));
    }
    hs_packet_free(&packet);
}
int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_packet_of_every_kind_of_record_decodes),
        cmocka_unit_test(a_refused_view_decodes_without_vertices_and_faces),
        cmocka_unit_test(every_corrupted_word_is_detected),
        cmocka_unit_test(every_truncation_is_detected),
        cmocka_unit_test(a_wrong_packet_with_a_right_crc_is_refused_with_its_cause),
        cmocka_unit_test(the_trailer_of_a_memory_fault_is_checked),
        cmocka_unit_test(groups_that_are_not_filled_up_are_refused),
        cmocka_unit_test(records_are_found),
        cmocka_unit_test(generations_go_back_in_the_last_step_alone),
        cmocka_unit_test(a_view_without_faces_is_a_refused_one),
        cmocka_unit_test(hostile_words_are_only_ever_refused_or_decoded),
        cmocka_unit_test(what_golden_sends_decodes),
        cmocka_unit_test(the_fourth_of_a_group_of_seven_has_its_name),
    };
    return cmocka_run_group_tests_name("stream_decode", tests, NULL, NULL);
}
