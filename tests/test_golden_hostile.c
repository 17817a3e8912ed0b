/* SPDX-License-Identifier: Apache-2.0
 *
 * Packets that were tampered with: golden refuses them or takes them, but it never crashes, its
 * answer is a packet that decodes, and the next view is as if they had not been there. Half of them
 * get a CRC that is right, so that they pass beyond it. HS_HOSTILE=100000 in the environment sets
 * another number of them than the default.
 */
#include "golden.h"
#include "reference_samples.h"

enum { DEFAULT_PACKETS = 50000, GOOD_PACKETS = 5, MOST_WORDS = 1 << 14 };

static const hs_limits limits = {2000, 2000};

/* --- Good packets, and what comes out of them
 * ------------------------------------------------------ */

typedef struct {
    hs_packet in[GOOD_PACKETS], out[GOOD_PACKETS];
} good_packets;

static void run(hs_golden *golden, const hs_packet *in, hs_packet *out, hs_golden_report *report) {
    hs_error err;
    if (!hs_golden_run(golden, in, out, report, &err)) fail_msg("%s", err.text);
}

static void make_good_packets(good_packets *good, hs_golden *golden) {
    static const struct {
        const char *shape;
        hs_settings settings;
    } of[GOOD_PACKETS] = {
        {"cube", {.front_depth = 3, .silhouette_depth = 6, .guard = true}},
        {"tetrahedron", {.uniform = true, .uniform_depth = 4}},
        {"mixed", {.front_depth = 2, .silhouette_depth = 2, .guard = true}},
        {"grid", {.front_depth = 2, .silhouette_depth = 3}},
        {"icosahedron", {.uniform = true, .uniform_depth = 250, .guard = true}}, /* is stopped */
    };
    for (uint32_t i = 0; i < GOOD_PACKETS; i++) {
        hs_mesh mesh;
        hs_error err;
        hs_golden_report report;
        if (!hs_shape_make(&mesh, of[i].shape, 0, 1, &err) ||
            !hs_packet_encode(&good->in[i], i, &mesh, perspective, &of[i].settings, &err))
            fail_msg("%s", err.text);
        run(golden, &good->in[i], &good->out[i], &report);
        assert_int_equal(report.status, i == 4 ? HS_STATUS_STOPPED : HS_STATUS_OK);
        hs_mesh_free(&mesh);
    }
}

/* --- Tampering
 * --------------------------------------------------------------------------------------- */

typedef struct {
    uint64_t state;
    uint32_t word[MOST_WORDS];
    size_t words;
} tampered;

/* Steele, Lea and Flood's SplitMix64. */
static uint32_t below(tampered *t, size_t limit) {
    uint64_t z = t->state += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return limit ? (uint32_t)((z ^ z >> 31) % limit) : 0;
}

/* A number that is likely to be just right, just wrong, or far off. */
static uint32_t odd_number(tampered *t) {
    static const uint32_t numbers[] = {0,          1,          2,          3,          4,
                                       255,        256,        2000,       2001,       0x7fffffff,
                                       0x80000000, 0xffffffff, 0xfffffffe, 0x7f800000, 0x7f7fffff,
                                       0x00000001, 0x00ff0000, 0x0000ff00, 0x3f800000, 0x40000000};
    return numbers[below(t, sizeof numbers / sizeof *numbers)];
}

static void cut(tampered *t) {
    t->words = below(t, t->words + 1);
}

/* Doubles a run of words in place: all behind it shifts. */
static void repeat(tampered *t) {
    const size_t from = below(t, t->words), left = t->words - from;
    size_t count = 1 + below(t, left < 40 ? left : 40);
    if (count > left || t->words + count > MOST_WORDS) return;
    memmove(t->word + from + count, t->word + from, 4 * left);
    t->words += count;
}

/* Puts words of another packet over these. */
static void splice(tampered *t, const hs_packet *other) {
    const size_t from = below(t, other->words), to = below(t, t->words + 1);
    size_t count = 1 + below(t, other->words - from);
    if (count > MOST_WORDS - to) count = MOST_WORDS - to;
    memcpy(t->word + to, other->word + from, 4 * count);
    if (to + count > t->words) t->words = to + count;
}

/* Lets all corners name one vertex: every edge becomes a loop, which is topologically in order. */
static void collapse(tampered *t) {
    const uint32_t vertex = below(t, 4);
    if (t->words < 8) return;
    for (size_t at = 24 + 4 * (size_t)t->word[3]; at + 4 < t->words; at += 4)
        t->word[at] = vertex;
}

static void tamper(tampered *t, const good_packets *good) {
    const hs_packet *in = &good->in[below(t, GOOD_PACKETS)];
    memcpy(t->word, in->word, 4 * in->words);
    t->words = in->words;
    const uint32_t times = 1 + below(t, 4);
    for (uint32_t i = 0; i < times; i++) {
        const size_t header = t->words < 24 ? t->words : 24;
        const uint32_t what = below(t, 17);
        if (t->words == 0) return;
        if (what < 6)
            t->word[below(t, t->words)] ^= 1u << below(t, 32);
        else if (what < 8)
            t->word[below(t, header)] ^= 1u << below(t, 32);
        else if (what < 11)
            t->word[below(t, t->words)] = odd_number(t);
        else if (what < 13) /* some other word of it: an index that exists */
            t->word[below(t, t->words)] = t->word[below(t, t->words)];
        else if (what < 14)
            cut(t);
        else if (what < 15)
            repeat(t);
        else if (what < 16)
            collapse(t);
        else
            splice(t, &good->in[below(t, GOOD_PACKETS)]);
    }
    if (t->words >= 4 && below(t, 2)) t->word[t->words - 1] = hs_crc(0, t->word, t->words - 1);
}

/* --- The answer
 * ----------------------------------------------------------------------------------------- */

/* The answer is handed over in memory of exactly the packet's size, for ASan to see. */
static void check_answer(hs_golden *golden, const tampered *t, hs_packet *out, uint64_t *seen) {
    hs_golden_report report;
    hs_output output;
    hs_error err;
    hs_packet in = {.view = 9, .words = t->words, .capacity = t->words};
    in.word = malloc(4 * t->words + (t->words == 0));
    assert_non_null(in.word);
    memcpy(in.word, t->word, 4 * t->words);
    run(golden, &in, out, &report);
    free(in.word);

    if (!hs_output_decode(&output, out, &err)) fail_msg("%s", err.text);
    assert_int_equal(output.view, 9);
    assert_int_equal(output.status, report.status);
    assert_int_equal(output.error_position, report.error_position);
    if (report.status >= HS_STATUS_BAD_MAGIC) {
        assert_int_equal(out->words, 12);
        assert_true(report.error_position <= t->words);
        assert_int_equal(report.generations, 0);
    } else {
        assert_int_equal(report.error_position, HS_NO_POSITION);
        assert_true(output.faces > 0);
    }
    *seen |= (uint64_t)1 << report.status;
    hs_output_free(&output);
}

static void hostile_packets_are_refused_or_refined_and_leave_no_trace(void **state) {
    (void)state;
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    good_packets good = {0};
    make_good_packets(&good, golden);
    tampered *t = calloc(1, sizeof *t);
    assert_non_null(t);
    hs_packet out = {0};
    hs_golden_report report;
    uint64_t seen = 0;
    const char *wish = getenv("HS_HOSTILE");
    const uint32_t packets = wish ? (uint32_t)strtoul(wish, NULL, 10) : DEFAULT_PACKETS;
    for (uint32_t i = 0; i < packets; i++) {
        t->state = i; /* so that a failure can be had again alone */
        tamper(t, &good);
        check_answer(golden, t, &out, &seen);
        if (i % 8) continue;
        const hs_packet *expected = &good.out[i / 8 % GOOD_PACKETS];
        run(golden, &good.in[i / 8 % GOOD_PACKETS], &out, &report);
        assert_int_equal(out.words, expected->words);
        assert_memory_equal(out.word, expected->word, 4 * out.words);
    }
    /* Every status there is has come up, but the one that only hardware has. */
    uint64_t all = 0;
    for (uint32_t s = 0; s < 64; s++)
        if (strcmp(hs_status_name(s), "?") != 0 && s != HS_STATUS_MEMORY_FAULT)
            all |= (uint64_t)1 << s;
    if (!wish)
        for (uint32_t s = 0; s < 64; s++)
            if ((all & ~seen) >> s & 1) fail_msg("no packet had the status %s", hs_status_name(s));
    print_message("%u packets\n", packets);
    for (uint32_t i = 0; i < GOOD_PACKETS; i++) {
        hs_packet_free(&good.in[i]);
        hs_packet_free(&good.out[i]);
    }
    hs_packet_free(&out);
    free(t);
    hs_golden_free(golden);
}

/* Whatever the version asks for, it is refused at its word, and the next packet is not. */
static void a_packet_of_another_version_is_refused_with_its_status(void **state) {
    (void)state;
    static const uint32_t version[] = {0,
                                       HS_STREAM_VERSION - 1,
                                       HS_STREAM_VERSION + 1,
                                       HS_STREAM_VERSION | 0x100,
                                       HS_STREAM_VERSION | 0x80000000,
                                       0xffffffff};
    hs_golden *golden = hs_golden_new(limits);
    assert_non_null(golden);
    good_packets good = {0};
    make_good_packets(&good, golden);
    hs_packet out = {0};
    hs_golden_report report;
    hs_packet *in = &good.in[0];
    for (size_t i = 0; i < sizeof version / sizeof *version; i++) {
        in->word[1] = version[i];
        in->word[in->words - 1] = hs_packet_crc(in);
        run(golden, in, &out, &report);
        assert_int_equal(report.status, HS_STATUS_BAD_VERSION);
        assert_int_equal(report.error_position, 1);
        assert_int_equal(out.words, 12);
        run(golden, &good.in[1], &out, &report);
        assert_int_equal(report.status, HS_STATUS_OK);
    }
    for (uint32_t i = 0; i < GOOD_PACKETS; i++) {
        hs_packet_free(&good.in[i]);
        hs_packet_free(&good.out[i]);
    }
    hs_packet_free(&out);
    hs_golden_free(golden);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(hostile_packets_are_refused_or_refined_and_leave_no_trace),
        cmocka_unit_test(a_packet_of_another_version_is_refused_with_its_status),
    };
    return cmocka_run_group_tests_name("golden, hostile packets", tests, NULL, NULL);
}
