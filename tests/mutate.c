/* SPDX-License-Identifier: Apache-2.0 */
#include "mutate.h"

#include <string.h>

enum { VERTICES_AT = 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS) };

/* Steele, Lea and Flood's SplitMix64. */
uint32_t mutate_below(uint64_t *random, size_t limit) {
    uint64_t z = *random += 0x9e3779b97f4a7c15u;
    z = (z ^ z >> 30) * 0xbf58476d1ce4e5b9u;
    z = (z ^ z >> 27) * 0x94d049bb133111ebu;
    return limit ? (uint32_t)((z ^ z >> 31) % limit) : 0;
}

const char *mutation_name(mutation what) {
    static const char *const name[MUTATIONS] = {"bits",    "words",  "header", "corners",
                                                "numbers", "cut",    "repeat", "drop",
                                                "move",    "splice", "join"};
    return name[what];
}

/* --- Words --------------------------------------------------------------------------------------
 */

/* A number that is likely to be just right, just wrong, or far off. */
static uint32_t telling(const hs_packet *p, uint64_t *random) {
    static const uint32_t numbers[] = {
        0,          1,          2,          3,          4,          7,          8,
        9,          10,         14,         15,         16,         127,        128,
        249,        250,        251,        255,        256,        1000,       0x7fffffff,
        0x80000000, 0xffffffff, 0xfffffffe, 0x7f800000, 0xff800000, 0x7fc00000, 0x7f7fffff,
        0x00800000, 0x00000001, 0x3f800000, 0xbf800000, 0x00ff0000, 0x0000ff00, 0xff000000};
    const size_t count = sizeof numbers / sizeof *numbers;
    const uint32_t which = mutate_below(random, count + 8);
    if (which < count) return numbers[which];
    if (which < count + 5) return p->word[mutate_below(random, p->words)];
    return p->word[mutate_below(random, p->words)] + (which == count + 5 ? 1u : 0xffffffffu);
}

static void flip_bits(hs_packet *p, uint64_t *random) {
    for (uint32_t n = 1 + mutate_below(random, 3); n > 0; n--)
        p->word[mutate_below(random, p->words)] ^= 1u << mutate_below(random, 32);
}

static void set_words(hs_packet *p, uint64_t *random) {
    for (uint32_t n = 1 + mutate_below(random, 3); n > 0; n--)
        p->word[mutate_below(random, p->words)] = telling(p, random);
}

static void change_header(hs_packet *p, uint64_t *random) {
    if (p->words < 12) return;
    const uint32_t small = mutate_below(random, 5);
    switch (mutate_below(random, 7)) {
    case 0: /* flags, those that exist mostly */
        if (mutate_below(random, 2)) p->word[2] &= ~(uint32_t)(HS_FLAG_SMOOTH | HS_FLAG_EDGE_ONLY);
        p->word[2] ^= 1u << mutate_below(random, mutate_below(random, 8) ? 5 : 32);
        break;
    case 1:
    case 2:
    case 3: { /* a depth */
        const uint32_t at = 8 * mutate_below(random, 3);
        const uint32_t depth = mutate_below(random, 5) ? small : 247 + mutate_below(random, 8);
        p->word[6] = (p->word[6] & ~(255u << at)) | depth << at;
        break;
    }
    case 4: /* V, F or H */
        p->word[3 + mutate_below(random, 3)] += small - 2;
        break;
    case 5: /* least edge, picture */
        p->word[8] = mutate_below(random, 4) ? mutate_below(random, 65536) : telling(p, random);
        p->word[9] = mutate_below(random, 4) ? 0x00400040 : telling(p, random);
        break;
    default:
        p->word[mutate_below(random, 12)] = telling(p, random);
    }
}

/* Where the half-edges are, if they are in the packet; how many. */
static uint32_t *corners_of(const hs_packet *p, uint32_t *count) {
    const size_t records = p->words / 4, before = VERTICES_AT / 4;
    *count = 0;
    if (records <= before || p->word[3] >= records - before) return NULL;
    const size_t room = records - before - p->word[3];
    *count = (uint32_t)(p->word[5] < room ? p->word[5] : room);
    return p->word + VERTICES_AT + 4 * (size_t)p->word[3];
}

static void change_corners(hs_packet *p, uint64_t *random) {
    uint32_t count, *corner = corners_of(p, &count);
    if (!count) return;
    for (uint32_t n = 1 + mutate_below(random, 3); n > 0; n--) {
        const uint32_t h = mutate_below(random, count), t = mutate_below(random, count);
        uint32_t *a = corner + 4 * (size_t)h, *b = corner + 4 * (size_t)t;
        switch (mutate_below(random, 10)) {
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
        case 4:
            a[1] = t;
            b[1] = h;
            break;
        case 5: /* an edge is opened, mostly on both sides */
            if (a[1] < count && mutate_below(random, 4)) corner[4 * (size_t)a[1] + 1] = HS_BORDER;
            a[1] = HS_BORDER;
            break;
        case 6:
            a[2] += 1u << 8 * mutate_below(random, 3);
            break;
        case 7: /* an edge, both of its sides */
            a[3] = mutate_below(random, 16);
            if (a[1] < count) corner[4 * (size_t)a[1] + 3] = a[3];
            break;
        case 8:
            a[3] ^= 1u << mutate_below(random, 9);
            break;
        default: /* all corners in one vertex: every edge becomes a loop */
            for (uint32_t i = 0; n == 1 && i < count; i++)
                corner[4 * (size_t)i] = b[0];
        }
    }
}

static void change_numbers(hs_packet *p, uint64_t *random) {
    uint32_t count;
    const uint32_t *corner = corners_of(p, &count);
    const size_t from = 4 * HS_HEADER_RECORDS;
    const size_t to = corner ? (size_t)(corner - p->word) : p->words;
    if (to <= from) return;
    for (uint32_t n = 1 + mutate_below(random, 6); n > 0; n--) {
        static const uint32_t exponent[] = {0x3f800000, 0x3f000000, 0x40000000, 0,
                                            0x00800000, 0x7e000000, 0x7f000000, 0x7f800000};
        const uint32_t turn = mutate_below(random, 8); /* halves to twos, or far off */
        const uint32_t which = mutate_below(random, turn < 5 ? 3 : turn < 7 ? 7 : 8);
        const uint32_t mantissa = mutate_below(random, 3) ? mutate_below(random, 1 << 23) : 0;
        p->word[from + mutate_below(random, to - from)] =
            exponent[which] | mutate_below(random, 2) << 31 | mantissa;
    }
}

/* --- Records ------------------------------------------------------------------------------------
 */

static bool append(hs_packet *p, const uint32_t *record, size_t records) {
    hs_error err;
    return records == 0 || hs_packet_append(p, record, records, &err);
}

static void cut(hs_packet *p, uint64_t *random) {
    p->words = 4 * (1 + (size_t)mutate_below(random, p->words / 4));
}

/* Room for `count` records more, behind which the packet from `at` on is moved. */
static bool make_gap(hs_packet *p, size_t at, size_t count) {
    const uint32_t zero[4] = {0};
    const size_t left = p->words - 4 * at;
    for (size_t i = 0; i < count; i++)
        if (!append(p, zero, 1)) return false;
    memmove(p->word + 4 * (at + count), p->word + 4 * at, 4 * left);
    return true;
}

static void repeat(hs_packet *p, uint64_t *random) {
    const size_t records = p->words / 4, at = mutate_below(random, records);
    const size_t count = 1 + mutate_below(random, records - at < 8 ? records - at : 8);
    make_gap(p, at, count); /* what was there is still before the gap's end */
}

static void drop(hs_packet *p, uint64_t *random) {
    const size_t records = p->words / 4, at = mutate_below(random, records);
    const size_t count = 1 + mutate_below(random, records - at < 8 ? records - at : 8);
    if (count == records) return;
    memmove(p->word + 4 * at, p->word + 4 * (at + count), 16 * (records - at - count));
    p->words -= 4 * count;
}

static void move(hs_packet *p, uint64_t *random) {
    uint32_t *a = p->word + 4 * (size_t)mutate_below(random, p->words / 4);
    uint32_t *b = p->word + 4 * (size_t)mutate_below(random, p->words / 4), record[4];
    memcpy(record, a, sizeof record);
    memmove(a, b, sizeof record);
    if (mutate_below(random, 2)) memcpy(b, record, sizeof record);
}

static void splice(hs_packet *p, const hs_packet *other, uint64_t *random) {
    const size_t from = mutate_below(random, other->words / 4);
    p->words = 4 * (size_t)mutate_below(random, p->words / 4 + 1);
    append(p, other->word + 4 * from, other->words / 4 - from);
}

mutation mutate_packet(hs_packet *p, const hs_packet *other, size_t longest, uint64_t *random) {
    /* The shares keep what is refused at once from crowding out the rest. */
    static const uint8_t share[MUTATIONS] = {3, 2, 6, 6, 5, 1, 1, 1, 1, 1, 1};
    uint32_t turn = mutate_below(random, 28), what = 0;
    while (turn >= share[what])
        turn -= share[what++];
    switch ((mutation)what) {
    case MUTATE_BITS:
        flip_bits(p, random);
        break;
    case MUTATE_WORDS:
        set_words(p, random);
        break;
    case MUTATE_HEADER:
        change_header(p, random);
        break;
    case MUTATE_CORNERS:
        change_corners(p, random);
        break;
    case MUTATE_NUMBERS:
        change_numbers(p, random);
        break;
    case MUTATE_CUT:
        cut(p, random);
        break;
    case MUTATE_REPEAT:
        repeat(p, random);
        break;
    case MUTATE_DROP:
        drop(p, random);
        break;
    case MUTATE_MOVE:
        move(p, random);
        break;
    case MUTATE_SPLICE:
        splice(p, other, random);
        break;
    default:
        append(p, other->word, other->words / 4);
    }
    if (p->words > 4 * longest) p->words = 4 * longest;
    return (mutation)what;
}
