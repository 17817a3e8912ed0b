/* SPDX-License-Identifier: Apache-2.0
 *
 * Hostile input: whatever words come in, the RTL and golden send the same words out, status and
 * position included; nothing hangs, and the view behind is none the worse. Packets are broken in
 * every way that their format knows, one at a time and at random, and surfaces that no loader would
 * make, but that the rules of docs/stream.md let pass, are refined. HS_CASES=30 makes the random
 * part thirty times as long; HS_SEED sets where it begins.
 */
#include "rtl_samples.h"

/* Small, so that a view that asks for depth 250 soon stops. */
static const hs_limits limits = {.vertices = 400, .quads = 1000};

enum { VERTICES_AT = 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS), GOOD = 8 };

/* Where the half-edges begin, in words. */
static size_t corners_at(const hs_packet *packet) {
    return VERTICES_AT + 4 * (size_t)packet->word[3];
}

/* --- Good packets
 * ---------------------------------------------------------------------------------
 */

typedef struct {
    bench *bench;
    hs_packet good[GOOD];
    uint32_t next_good; /* the one that comes behind the next hostile one */
    uint64_t random;
    uint32_t latest, generations; /* of the latest hostile packet: status, generations */
    uint32_t seen[256];           /* hostile packets by status */
} hostile;

static void copy_packet(hs_packet *to, const hs_packet *from) {
    hs_error err;
    to->view = from->view;
    to->words = 0;
    assert_true(hs_packet_append(to, from->word, from->words / 4, &err));
}

static int set_up(void **state) {
    hostile *h = calloc(1, sizeof *h);
    assert_non_null(h);
    h->bench = new_bench(limits, 3);
    const char *seed = getenv("HS_SEED");
    h->random = seed ? strtoull(seed, NULL, 0) : 1;
    for (uint32_t i = 0; i < GOOD; i++) {
        static const char *const name[] = {"cube", "tetrahedron", "grid", "cube"};
        hs_mesh mesh;
        hs_view view[VIEWS];
        hs_error err;
        if (i == 3)
            make_pillow(&mesh, 9);
        else if (i == 7)
            make_bicone(&mesh, 5);
        else
            make_shape(&mesh, name[i % 4], i % 4 == 2 ? 2 : 0, 0);
        make_views(&mesh, view);
        for (uint32_t f = 0; f < mesh.faces; f++)
            mesh.forced[f] = (uint8_t)(i % 4 == 2 ? f : 0);
        const hs_settings settings =
            i % 3 == 1 ? uniform((uint8_t)(1 + i % 4)) : adaptive(2, 3, i % 2);
        assert_true(hs_packet_encode(&h->good[i], 100 + i, &mesh, view[i].matrix, &settings, &err));
        hs_mesh_free(&mesh);
    }
    *state = h;
    return 0;
}

static int tear_down(void **state) {
    hostile *h = *state;
    for (uint32_t i = 0; i < GOOD; i++)
        hs_packet_free(&h->good[i]);
    free_bench(h->bench);
    free(h);
    return 0;
}

/* The packet, and a good one behind it; what: to find it again. */
static void check(hostile *h, const hs_packet *packet, hs_stalls stalls, const char *what) {
    assert_same_words(h->bench, packet, stalls, what);
    h->latest = h->bench->golden_report.status;
    h->generations = h->bench->golden_report.generations;
    h->seen[h->latest & 0xff]++;
    char behind[300];
    snprintf(behind, sizeof behind, "behind %s", what);
    assert_same_words(h->bench, &h->good[h->next_good++ % GOOD], no_stalls, behind);
    assert_true(h->bench->golden_report.status <= HS_STATUS_STOPPED);
}

static uint32_t below(hostile *h, uint32_t limit) {
    return random_below(&h->random, limit);
}

/* --- One fault at a time
 * ----------------------------------------------------------------------------
 */

static void every_word_set_to_any_telling_value_is_judged_as_golden_judges(void **state) {
    hostile *h = *state;
    static const uint32_t values[] = {0, 1, 3, 4, 255, 256, 0x7f7fffff, 0x7f800000, 0xffffffff};
    hs_packet packet = {0};
    for (uint32_t p = 0; p < 2; p++)
        for (size_t w = 0; w < h->good[1 + p].words; w++) {
            char what[100];
            const uint32_t value = values[(w * 5 + w / 4 + p) % 9];
            copy_packet(&packet, &h->good[1 + p]);
            packet.word[w] = value;
            if (w / 4 + 1 < packet.words / 4) mend_crc(&packet);
            snprintf(what, sizeof what, "word %zu of packet %u set to 0x%x", w, p, value);
            check(h, &packet, no_stalls, what);
        }
    hs_packet_free(&packet);
}

static void every_bit_of_the_header_and_of_a_corner_is_judged_as_golden_judges(void **state) {
    hostile *h = *state;
    hs_packet packet = {0};
    const size_t corner = corners_at(&h->good[0]);
    for (uint32_t i = 0; i < 32 * 16; i++) {
        char what[100];
        const size_t w =
            i / 32 < 8 ? i / 32 : corner + 4 + i / 32 - 8; /* records 0, 1, two corners */
        copy_packet(&packet, &h->good[0]);
        packet.word[w] ^= 1u << i % 32;
        mend_crc(&packet);
        snprintf(what, sizeof what, "bit %u of word %zu flipped", i % 32, w);
        check(h, &packet, no_stalls, what);
    }
    hs_packet_free(&packet);
}

static void a_packet_cut_or_drawn_out_anywhere_is_judged_as_golden_judges(void **state) {
    hostile *h = *state;
    hs_packet packet = {0};
    hs_error err;
    for (uint32_t p = 0; p < 4; p++)
        for (size_t records = 0; records < h->good[p].words / 4 + 6; records++) {
            char what[100];
            copy_packet(&packet, &h->good[p]);
            while (packet.words < 4 * records)
                hs_packet_append(&packet, h->good[p].word, 1, &err);
            packet.words = 4 * records;
            snprintf(what, sizeof what, "packet %u of %zu records", p, records);
            const hs_stalls stalls = {.seed = (uint32_t)records, .input = records % 3 ? 50 : 0};
            check(h, &packet, stalls, what);
        }
    hs_packet_free(&packet);
}

/* n triangles around vertex 0, each alone: valence n. A bad twin at half-edge `bad`, if any. */
static void make_fan(hs_packet *packet, uint32_t n, uint32_t bad) {
    hs_mesh mesh;
    hs_error err;
    make_shape(&mesh, "tetrahedron", 0, 0);
    const hs_settings settings = uniform(1);
    hs_packet base = {0};
    assert_true(hs_packet_encode(&base, 9, &mesh, identity, &settings, &err));
    base.word[4] = n;
    base.word[5] = 3 * n;
    packet->view = 9;
    packet->words = 0;
    hs_packet_append(packet, base.word, VERTICES_AT / 4 + 4, &err);
    for (uint32_t h = 0; h < 3 * n; h++) {
        const uint32_t twin = h == bad ? (h + 3) % (3 * n) : HS_BORDER;
        const uint32_t record[4] = {h % 3, twin, 3 | h % 3 << 16, 0};
        hs_packet_append(packet, record, 1, &err);
    }
    hs_packet_append(packet, base.word + base.words - 4, 1, &err);
    mend_crc(packet);
    hs_packet_free(&base);
    hs_mesh_free(&mesh);
}

static void a_valence_of_255_passes_and_of_256_is_refused(void **state) {
    hostile *h = *state;
    hs_packet packet = {0};
    uint32_t status[3] = {0};
    for (uint32_t n = 254; n <= 257; n++)
        for (uint32_t i = 0; i < 5; i++) {
            /* A bad twin before, at and behind the corner that is one too many, 765, or none. */
            static const uint32_t bad[] = {HS_BORDER, 764, 765, 766, 3};
            char what[100];
            if (bad[i] != HS_BORDER && bad[i] >= 3 * n) continue;
            make_fan(&packet, n, bad[i]);
            snprintf(what, sizeof what, "fan of %u, bad twin at %u", n, bad[i]);
            check(h, &packet, no_stalls, what);
            const uint32_t s = h->latest;
            status[s == HS_STATUS_BAD_VALENCE ? 1 : s == HS_STATUS_BAD_TWIN ? 2 : 0]++;
        }
    assert_true(status[0] > 0 && status[1] > 0 && status[2] > 0);
    hs_packet_free(&packet);
}

/* --- Odd surfaces that the rules let pass
 * -------------------------------------------------------------
 */

/* Faces of any vertices whatever, so also of one vertex many times, whose edges are glued to any
 * others that run the other way: fans that touch in a vertex, edges with many faces, handles,
 * faces glued to themselves, sides from a vertex to itself, vertices without faces. */
static void make_odd_surface(hostile *h, hs_packet *packet) {
    enum { MOST = 120 };
    uint32_t origin[MOST], target[MOST], twin[MOST], sides_of[MOST], place[MOST];
    const uint32_t vertices = 3 + below(h, 6), wanted = 1 + below(h, 12);
    uint32_t faces = 0, halfedges = 0;
    while (faces < wanted && halfedges + 9 < MOST) {
        const uint32_t sides = below(h, 3) ? 3 + below(h, 2) : 3 + below(h, 7);
        for (uint32_t k = 0; k < sides; k++) {
            origin[halfedges + k] = below(h, vertices);
            sides_of[halfedges + k] = sides;
            place[halfedges + k] = k;
        }
        for (uint32_t k = 0; k < sides; k++)
            target[halfedges + k] = origin[halfedges + (k + 1) % sides];
        halfedges += sides;
        faces++;
        /* Often its mirror image too, so that there is something to glue it to. */
        if (below(h, 3) && halfedges + sides < MOST) {
            for (uint32_t k = 0; k < sides; k++) {
                origin[halfedges + k] = target[halfedges - 1 - k];
                sides_of[halfedges + k] = sides;
                place[halfedges + k] = k;
            }
            for (uint32_t k = 0; k < sides; k++)
                target[halfedges + k] = origin[halfedges + (k + 1) % sides];
            halfedges += sides;
            faces++;
        }
    }
    const uint32_t open = below(h, 3) ? 0 : below(h, 100); /* per cent of the edges left open */
    for (uint32_t e = 0; e < halfedges; e++)
        twin[e] = HS_BORDER;
    for (uint32_t e = 0; e < halfedges; e++) {
        if (twin[e] != HS_BORDER || below(h, 100) < open) continue;
        const uint32_t start = below(h, halfedges);
        for (uint32_t k = 0; k < halfedges; k++) {
            const uint32_t t = (start + k) % halfedges;
            if (t == e || twin[t] != HS_BORDER || origin[t] != target[e] || target[t] != origin[e])
                continue;
            twin[e] = t;
            twin[t] = e;
            break;
        }
    }
    hs_error err;
    const bool is_uniform = below(h, 2);
    const uint32_t more = below(h, 12) ? 0 : 8; /* steps, until it is too large */
    static const uint32_t mode[] = {0, HS_FLAG_SMOOTH, HS_FLAG_EDGE_ONLY};
    const uint32_t flags = is_uniform | below(h, 2) << 1 | below(h, 2) << 2;
    const uint32_t header[12] = {HS_MAGIC_VIEW,
                                 HS_STREAM_VERSION,
                                 flags | mode[below(h, 3)],
                                 vertices,
                                 faces,
                                 halfedges,
                                 (more + below(h, 5)) | below(h, 7) << 8 |
                                     (more + below(h, 5)) << 16,
                                 0,
                                 below(h, 3) ? 0 : 1 + below(h, 60000),
                                 (1 + below(h, 3000)) | (1 + below(h, 3000)) << 16,
                                 0,
                                 0};
    packet->view = below(h, 65536);
    packet->words = 0;
    hs_packet_append(packet, header, 3, &err);
    for (uint32_t i = 0; i < 4 + vertices; i++) {
        uint32_t record[4];
        for (uint32_t k = 0; k < 4; k++) {
            const float c = (float)below(h, 1u << 16) / (1 << 15) - 1;
            memcpy(&record[k], &c, 4);
            if (i < 4 && below(h, 3) == 0) record[k] = k == i ? 0x3f800000 : 0;
        }
        hs_packet_append(packet, record, 1, &err);
    }
    uint32_t forced = 0, sharp[MOST] = {0};
    const uint32_t sharp_in = 1 + below(h, 10); /* one edge and vertex in so many */
    for (uint32_t e = 0; e < halfedges; e++) {
        static const uint32_t sharpness[] = {1, 2, 3, 9, HS_SHARP_INFINITE};
        const bool known = twin[e] < e;
        sharp[e] = known ? sharp[twin[e]] & 15 : below(h, sharp_in) ? 0 : sharpness[below(h, 5)];
        if (!below(h, 4 * sharp_in)) sharp[e] |= sharpness[below(h, 5)] << 4;
    }
    for (uint32_t e = 0; e < halfedges; e++) {
        if (place[e] == 0) forced = below(h, 4) ? 0 : below(h, 6);
        const uint32_t record[4] = {origin[e], twin[e], sides_of[e] | forced << 8 | place[e] << 16,
                                    sharp[e]};
        hs_packet_append(packet, record, 1, &err);
    }
    const uint32_t end[4] = {HS_MAGIC_END, 0, 0, 0};
    hs_packet_append(packet, end, 1, &err);
    mend_crc(packet);
}

static hs_stalls any_stalls(hostile *h) {
    if (below(h, 4)) return no_stalls;
    return (hs_stalls){.seed = below(h, 1u << 30),
                       .input = (uint8_t)below(h, 80),
                       .output = (uint8_t)below(h, 80)};
}

static void odd_surfaces_are_refined_as_golden_refines(void **state) {
    hostile *h = *state;
    hs_packet packet = {0};
    uint32_t refined = 0, stopped = 0;
    const uint32_t rounds = cases(800);
    for (uint32_t i = 0; i < rounds; i++) {
        char what[100];
        make_odd_surface(h, &packet);
        snprintf(what, sizeof what, "odd surface %u", i);
        assert_same_words(h->bench, &packet, any_stalls(h), what);
        const hs_golden_report *r = &h->bench->golden_report;
        assert_true(r->status <= HS_STATUS_STOPPED);
        refined += r->status == HS_STATUS_OK && r->faces > packet.word[4];
        stopped += r->status == HS_STATUS_STOPPED;
    }
    print_message("%u of %u odd surfaces were refined, %u until they were too large\n", refined,
                  rounds, stopped);
    assert_true(refined > rounds / 4 && stopped > rounds / 100);
    hs_packet_free(&packet);
}

/* A triangle two of whose sides are one edge is one quad in every generation: the one surface that
 * reaches the largest depth within any capacity. */
static void a_view_of_250_generations_is_refined_as_golden_refines(void **state) {
    hostile *h = *state;
    hs_packet packet = {0};
    hs_error err;
    copy_packet(&packet, &h->good[1]); /* a tetrahedron: header, matrix, four vertices */
    const uint32_t end[4] = {HS_MAGIC_END, 0, 0, 0};
    for (uint32_t mode = 0; mode < 3; mode++) {
        const uint32_t forced = mode ? 250 : 0;
        const uint32_t corner[12] = {0, 2,         3 | forced << 8,           0, /* 0 to 1 */
                                     1, HS_BORDER, 3 | forced << 8 | 1 << 16, 0, /* 1 to 1 */
                                     1, 0,         3 | forced << 8 | 2 << 16, 0};
        packet.words = VERTICES_AT + 4 * 4;
        packet.word[2] = mode == 0 ? HS_FLAG_UNIFORM : mode == 1 ? HS_FLAG_GUARD : 0;
        packet.word[4] = 1;
        packet.word[5] = 3;
        packet.word[6] = 250u << 16;
        assert_true(hs_packet_append(&packet, corner, 3, &err));
        assert_true(hs_packet_append(&packet, end, 1, &err));
        mend_crc(&packet);
        check(h, &packet, no_stalls, "a triangle glued to itself");
        assert_int_equal(h->latest, HS_STATUS_OK);
        assert_int_equal(h->generations, 251);
    }
    hs_packet_free(&packet);
}

/* --- Any number of faults
 * -----------------------------------------------------------------------------
 */

static void flip_bits(hostile *h, hs_packet *packet) {
    for (uint32_t n = 1 + below(h, 3); n > 0; n--)
        packet->word[below(h, (uint32_t)packet->words)] ^= 1u << below(h, 32);
}

static void set_words(hostile *h, hs_packet *packet) {
    static const uint32_t values[] = {0,   1,   2,          3,          4,          7,
                                      250, 251, 0x7f7fffff, 0x7f800000, 0xff800001, 0xffffffff};
    for (uint32_t n = 1 + below(h, 3); n > 0; n--)
        packet->word[below(h, (uint32_t)packet->words)] = values[below(h, 12)];
}

/* A small change of a half-edge: another vertex, twin, place, or number of sides. */
static void change_corners(hostile *h, hs_packet *packet) {
    const size_t at = corners_at(packet);
    const uint32_t count = packet->word[5];
    for (uint32_t n = 1 + below(h, 2); n > 0; n--) {
        uint32_t *a = &packet->word[at + 4 * below(h, count)];
        uint32_t *b = &packet->word[at + 4 * below(h, count)];
        switch (below(h, 6)) {
        case 0:
            a[0] = b[0];
            break;
        case 1:
            a[1] = b[1];
            break;
        case 2:
            a[2] = b[2];
            break;
        case 3: /* twins that point at each other, in any direction */
            a[1] = (uint32_t)((size_t)(b - packet->word) - at) / 4;
            b[1] = (uint32_t)((size_t)(a - packet->word) - at) / 4;
            break;
        case 4:
            a[1] = HS_BORDER;
            break;
        default:
            a[2] += 1u << 8 * below(h, 3);
            break;
        }
    }
}

static void move_records(hostile *h, hs_packet *packet) {
    const uint32_t records = (uint32_t)packet->words / 4;
    uint32_t *a = &packet->word[4 * below(h, records)], *b = &packet->word[4 * below(h, records)];
    uint32_t record[4];
    memcpy(record, a, sizeof record);
    memmove(a, b, sizeof record);
    if (below(h, 2)) memcpy(b, record, sizeof record);
}

/* The head of one packet and the tail of another. */
static void splice(hostile *h, hs_packet *packet) {
    const hs_packet *other = &h->good[below(h, GOOD)];
    const uint32_t from = below(h, (uint32_t)other->words / 4);
    hs_error err;
    packet->words = 4 * below(h, (uint32_t)packet->words / 4 + 1);
    hs_packet_append(packet, other->word + 4 * from, other->words / 4 - from, &err);
}

static void change_length(hostile *h, hs_packet *packet) {
    hs_error err;
    if (below(h, 2)) {
        packet->words = 4 * below(h, (uint32_t)packet->words / 4 + 1);
        return;
    }
    for (uint32_t n = 1 + below(h, 5); n > 0; n--) {
        uint32_t record[4];
        memcpy(record, packet->word + 4 * below(h, (uint32_t)packet->words / 4), sizeof record);
        hs_packet_append(packet, record, 1, &err);
    }
}

static void scale_numbers(hostile *h, hs_packet *packet) {
    for (uint32_t n = 1 + below(h, 6); n > 0; n--) {
        const uint32_t words = (uint32_t)corners_at(packet) - 4 * HS_HEADER_RECORDS;
        packet->word[4 * HS_HEADER_RECORDS + below(h, words)] =
            (below(h, 2) ? 0x7e000000 : 0x7f000000) | below(h, 2) << 31 | below(h, 1u << 23);
    }
}

static void random_words(hostile *h, hs_packet *packet) {
    for (size_t w = below(h, (uint32_t)packet->words); w < packet->words; w++)
        packet->word[w] = below(h, UINT32_MAX);
}

static void mutate(hostile *h, hs_packet *packet) {
    if (packet->words < VERTICES_AT + 4 || packet->word[3] > 300) return;
    if (packet->words < corners_at(packet) + 4 * (size_t)packet->word[5]) return;
    switch (below(h, 9)) {
    case 0:
        flip_bits(h, packet);
        break;
    case 1:
        set_words(h, packet);
        break;
    case 2:
    case 3:
        change_corners(h, packet);
        break;
    case 4:
        move_records(h, packet);
        break;
    case 5:
        splice(h, packet);
        break;
    case 6:
        change_length(h, packet);
        break;
    case 7:
        scale_numbers(h, packet);
        break;
    default:
        random_words(h, packet);
        break;
    }
}

static void mutated_packets_are_judged_and_refined_as_golden_does(void **state) {
    hostile *h = *state;
    hs_packet packet = {0};
    const uint32_t rounds = cases(2400);
    for (uint32_t i = 0; i < rounds; i++) {
        char what[100];
        if (below(h, 3) == 0)
            make_odd_surface(h, &packet);
        else
            copy_packet(&packet, &h->good[below(h, GOOD)]);
        for (uint32_t n = 1 + below(h, 2); n > 0; n--) {
            const uint32_t halfedges = packet.words >= 8 ? packet.word[5] : 0;
            if (halfedges > 0 && halfedges < 1000) mutate(h, &packet);
        }
        if (below(h, 4)) mend_crc(&packet);
        snprintf(what, sizeof what, "mutated packet %u", i);
        check(h, &packet, any_stalls(h), what);
    }
    hs_packet_free(&packet);
    for (uint32_t s = 0; s <= HS_STATUS_BAD_SHARPNESS; s++)
        if (h->seen[s]) print_message("%6u %s\n", h->seen[s], hs_status_name(s));
}

/* Last: the tests before would mean little if a kind of refusal had not occurred. */
static void every_status_was_seen(void **state) {
    const hostile *h = *state;
    for (uint32_t s = HS_STATUS_BAD_MAGIC; s <= HS_STATUS_BAD_SHARPNESS; s++)
        if (h->seen[s] == 0) fail_msg("%s was never seen", hs_status_name(s));
    assert_true(h->seen[HS_STATUS_OK] > 0 && h->seen[HS_STATUS_STOPPED] > 0);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_word_set_to_any_telling_value_is_judged_as_golden_judges),
        cmocka_unit_test(every_bit_of_the_header_and_of_a_corner_is_judged_as_golden_judges),
        cmocka_unit_test(a_packet_cut_or_drawn_out_anywhere_is_judged_as_golden_judges),
        cmocka_unit_test(a_valence_of_255_passes_and_of_256_is_refused),
        cmocka_unit_test(odd_surfaces_are_refined_as_golden_refines),
        cmocka_unit_test(a_view_of_250_generations_is_refined_as_golden_refines),
        cmocka_unit_test(mutated_packets_are_judged_and_refined_as_golden_does),
        cmocka_unit_test(every_status_was_seen),
    };
    return cmocka_run_group_tests(tests, set_up, tear_down);
}
