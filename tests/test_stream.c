/* SPDX-License-Identifier: Apache-2.0
 *
 * Packets: what encode writes is what docs/stream.md says, and the example there is what golden
 * sends.
 */
#include "stream_samples.h"

static void crc_is_that_of_the_standard(void **state) {
    (void)state;
    /* zlib's own check value is of the 9 bytes "123456789", so its first 8 stand here: the value
     * is that of Python's binascii.crc32(b"12345678"). */
    const uint32_t word[2] = {0x34333231, 0x38373635};
    assert_int_equal(hs_crc(0, word, 2), 0x9ae0daaf);
    assert_int_equal(hs_crc(hs_crc(0, word, 1), word + 1, 1), 0x9ae0daaf);
    assert_int_equal(hs_crc(0, word, 0), 0);
    /* More than any buffer inside: binascii.crc32(bytes(4 * 4097)). */
    uint32_t *zeros = calloc(4097, 4);
    assert_non_null(zeros);
    assert_int_equal(hs_crc(0, zeros, 4097), 0xf8a83595);
    free(zeros);
}

static void an_input_packet_is_laid_out_as_documented(void **state) {
    (void)state;
    hs_mesh mesh;
    make_cube(&mesh);
    mesh.forced[1] = 9;
    mesh.sharpness[5] = 3;
    mesh.sharpness[mesh.twin[5]] = 3;
    mesh.vertex_sharpness[cube_corner[5]] = HS_SHARP_INFINITE;
    float matrix[16];
    memcpy(matrix, identity, sizeof matrix);
    matrix[7] = -0.0f;
    const hs_settings settings = {.front_depth = 4,
                                  .silhouette_depth = 8,
                                  .uniform_depth = 2,
                                  .uniform = true,
                                  .guard = true,
                                  .limit = true,
                                  .boundary = HS_BOUNDARY_EDGE_ONLY,
                                  .min_edge = 65,
                                  .width = 640,
                                  .height = 480};
    hs_packet packet = {0};
    hs_error err;
    assert_true(hs_packet_encode(&packet, 5, &mesh, matrix, &settings, &err));
    assert_int_equal(packet.view, 5);
    assert_int_equal(packet.words, 4 * (3 + 4 + 8 + 24 + 1));
    const uint32_t *w = packet.word;
    const uint32_t header[12] = {0x49325348, 2, 0x17, 8,          6, 24,
                                 0x00020804, 0, 65,   0x01e00280, 0, 0};
    assert_memory_equal(w, header, sizeof header);
    assert_memory_equal(w + 12, matrix, sizeof matrix);
    assert_int_equal(w[12 + 7], 0x80000000);
    assert_memory_equal(w + 28, cube_position, sizeof cube_position);

    for (uint32_t h = 0; h < 24; h++) {
        const uint32_t *corner = w + 28 + 32 + 4 * h;
        assert_int_equal(corner[0], cube_corner[h]);
        /* Its twin runs from where it ends to where it begins. */
        uint32_t t = corner[1], next = h % 4 == 3 ? h - 3 : h + 1;
        assert_true(t < 24);
        uint32_t after = t % 4 == 3 ? t - 3 : t + 1;
        assert_int_equal(cube_corner[t], cube_corner[next]);
        assert_int_equal(cube_corner[after], cube_corner[h]);
        assert_int_equal(corner[2], h % 4 << 16 | (h / 4 == 1 ? 9u : 0u) << 8 | 4);
        const bool crease = h == 5 || mesh.twin[h] == 5, sharp = cube_corner[h] == cube_corner[5];
        assert_int_equal(corner[3], (sharp ? 0xf0u : 0u) | (crease ? 3u : 0u));
    }
    const uint32_t *end = w + packet.words - 4;
    assert_int_equal(end[0], 0x45325348);
    assert_int_equal(end[1] | end[2], 0);
    assert_int_equal(end[3], hs_crc(0, w, packet.words - 1));

    /* A second view replaces the first. */
    assert_true(hs_packet_encode(&packet, 6, &mesh, matrix,
                                 &(hs_settings){.boundary = HS_BOUNDARY_SMOOTH}, &err));
    assert_int_equal(packet.view, 6);
    assert_int_equal(packet.words, 4 * (3 + 4 + 8 + 24 + 1));
    assert_int_equal(packet.word[2], HS_FLAG_SMOOTH);
    assert_int_equal(packet.word[8], 0);
    hs_packet_free(&packet);
    hs_mesh_free(&mesh);
}
/* --- The documentation --------------------------------------------------------------------------
 */

/* Reads the n-th packet (from 0) of docs/stream.md: lines of a position and a record's words. */
static void read_example(hs_packet *packet, int n) {
    FILE *file = fopen("docs/stream.md", "r");
    assert_non_null(file);
    *packet = (hs_packet){0};
    char line[300], word[4][9];
    size_t at;
    while (fgets(line, sizeof line, file)) {
        if (sscanf(line, " %zu %8[0-9a-f] %8[0-9a-f] %8[0-9a-f] %8[0-9a-f]", &at, word[0], word[1],
                   word[2], word[3]) != 5 ||
            strlen(word[0]) + strlen(word[1]) + strlen(word[2]) + strlen(word[3]) != 32)
            continue;
        if (at == 0) n--;
        if (n >= 0) continue;
        if (n < -1) break;
        assert_int_equal(at, packet->words);
        uint32_t w[4];
        for (int i = 0; i < 4; i++)
            w[i] = (uint32_t)strtoul(word[i], NULL, 16);
        put(packet, w[0], w[1], w[2], w[3]);
    }
    fclose(file);
}

static void expect_same(const hs_packet *packet, const hs_packet *expected) {
    assert_int_equal(packet->words, expected->words);
    for (size_t i = 0; i < expected->words; i++)
        if (packet->word[i] != expected->word[i])
            fail_msg("word %zu: 0x%08x, documented is 0x%08x", i, packet->word[i],
                     expected->word[i]);
}

static void the_example_of_the_documentation_is_true(void **state) {
    (void)state;
    static const float position[16] = {-1, -1, 1, 1, 1, -1, 1, 1, -1, 1, 1, 1, 1, 1, 1, 1};
    static const float matrix[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, -1, 2, 0, 0, -1, 4};
    static const uint32_t sides[1] = {4}, corner[4] = {0, 1, 3, 2};
    const hs_soup soup = {.name = "face of a cube",
                          .vertices = 4,
                          .position = position,
                          .faces = 1,
                          .sides = sides,
                          .corner = corner};
    const hs_settings settings = {.uniform = true, .uniform_depth = 1, .guard = true};
    hs_packet example_in, example_out, in = {0}, out = {0};
    hs_golden_report report;
    hs_output decoded;
    hs_mesh mesh;
    hs_error err;
    read_example(&example_in, 0);
    read_example(&example_out, 1);
    assert_true(hs_mesh_build(&mesh, &soup, NULL, &err));
    assert_true(hs_packet_encode(&in, 0, &mesh, matrix, &settings, &err));
    expect_same(&in, &example_in);
    hs_golden *golden = hs_golden_new(HS_DEFAULT_LIMITS);
    assert_non_null(golden);
    assert_true(hs_golden_run(golden, &in, &out, &report, &err));
    expect_same(&out, &example_out);
    if (!hs_output_decode(&decoded, &example_out, &err)) fail_msg("%s", err.text);
    assert_int_equal(decoded.generations, 1);
    hs_output_free(&decoded);
    hs_golden_free(golden);
    hs_mesh_free(&mesh);
    hs_packet_free(&example_in);
    hs_packet_free(&example_out);
    hs_packet_free(&in);
    hs_packet_free(&out);
}
int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(crc_is_that_of_the_standard),
        cmocka_unit_test(an_input_packet_is_laid_out_as_documented),
        cmocka_unit_test(the_example_of_the_documentation_is_true),
    };
    return cmocka_run_group_tests_name("stream", tests, NULL, NULL);
}
