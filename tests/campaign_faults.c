/* SPDX-License-Identifier: Apache-2.0
 *
 * A fault for each status: the smallest change of a good packet that has it refused so. Words alone
 * are changed, or the end cut off, so that a trace can say it (sim/trace.h).
 */
#include "campaign_case.h"

#include <string.h>

enum { MATRIX_AT = 4 * HS_HEADER_RECORDS, VERTICES_AT = MATRIX_AT + 4 * HS_MATRIX_RECORDS };

/* A packet, taken apart. */
typedef struct parts {
    uint32_t *word, *vertex, *corner, *trailer;
    uint32_t vertices, faces, halfedges, at;
} parts;

/* Half-edge h of the mesh has a twin that has it as twin. */
static uint32_t *find_inner(const parts *p) {
    for (uint32_t i = 0; i < p->halfedges; i++) {
        uint32_t *corner = p->corner + 4 * (size_t)((p->at + i) % p->halfedges);
        if (corner[1] != HS_BORDER) return corner;
    }
    return NULL;
}

/* Counts corners at vertices; the two vertices that have the most. */
static bool merge_poles(const parts *p) {
    uint32_t valence[POLYGONS_VERTICES] = {0}, first = 0, second = 1;
    for (uint32_t h = 0; h < p->halfedges; h++)
        valence[p->corner[4 * (size_t)h]]++;
    if (valence[second] > valence[first]) {
        first = 1;
        second = 0;
    }
    for (uint32_t v = 2; v < p->vertices; v++)
        if (valence[v] > valence[first]) {
            second = first;
            first = v;
        } else if (valence[v] > valence[second]) {
            second = v;
        }
    if (valence[first] + valence[second] <= HS_MAX_VALENCE) return false;
    for (uint32_t h = 0; h < p->halfedges; h++)
        if (p->corner[4 * (size_t)h] == second) p->corner[4 * (size_t)h] = first;
    return true;
}

/* Ends the packet in front of its last face, and leaves what is behind. */
static bool end_early(hs_packet *packet, const parts *p) {
    if (p->faces < 2) return false;
    const uint32_t *last = p->corner + 4 * ((size_t)p->halfedges - 1);
    const uint32_t left = p->halfedges - (last[2] & 0xff);
    for (uint32_t h = 0; h < left; h++) /* its twins become boundary */
        if (p->corner[4 * (size_t)h + 1] >= left) p->corner[4 * (size_t)h + 1] = HS_BORDER;
    p->word[4]--;
    p->word[5] = left;
    const hs_packet whole = {.words = (size_t)(p->corner - p->word) + 4 * (size_t)left + 4,
                             .word = packet->word};
    const uint32_t end[4] = {HS_MAGIC_END, 0, 0, 0};
    memcpy(whole.word + whole.words - 4, end, sizeof end);
    whole.word[whole.words - 1] = hs_packet_crc(&whole);
    return true;
}

static bool spoil_count(const parts *p) {
    static const uint32_t position[] = {3, 4, 5};
    const uint32_t which = p->at % 3, value[] = {p->at / 3 % 3, 0, 3 * p->faces - 1};
    p->word[position[which]] = value[which];
    return true;
}

static bool spoil_reserved(const parts *p) {
    uint32_t *const place[] = {p->word + 7, p->word + 10, p->word + 11, p->trailer + 1,
                               p->trailer + 2};
    *place[p->at % 5] |= 1u << p->at / 5 % 32;
    return true;
}

static bool spoil_pixels(const parts *p) {
    if (p->at % 2) {
        p->word[8] |= 1u << (16 + p->at / 2 % 16);
    } else {
        p->word[8] |= 1;
        p->word[9] = p->at / 2 % 2 ? 640 : 480u << 16;
    }
    return true;
}

static bool spoil_number(const parts *p) {
    static const uint32_t value[] = {0x7f800000, 0xff800000, 0x7fc00000, 0xffffffff, 0x7f800001};
    const uint32_t words = 4 * (HS_MATRIX_RECORDS + p->vertices);
    p->word[MATRIX_AT + p->at % words] = value[p->at % 5];
    return true;
}

/* A vertex and a row whose product is beyond binary32. */
static bool spoil_sum(const parts *p) {
    const float large[4] = {3e38f, 3e38f, 3e38f, 1}, row[4] = {2, 2, 2, 1};
    memcpy(p->vertex + 4 * (size_t)(p->at % p->vertices), large, sizeof large);
    memcpy(p->word + MATRIX_AT + 4 * (size_t)(p->at / 7 % 4), row, sizeof row);
    return true;
}

static bool spoil_twin(const parts *p) {
    const uint32_t h = p->at % p->halfedges;
    uint32_t *inner = find_inner(p);
    if (p->at / 3 % 3 == 0)
        p->corner[4 * (size_t)h + 1] = h;
    else if (p->at / 3 % 3 == 1 || !inner)
        p->corner[4 * (size_t)h + 1] = p->halfedges + p->at % 1000;
    else
        inner[1] = HS_BORDER;
    return true;
}

static bool spoil_face(const parts *p) {
    uint32_t *corner = p->corner + 4 * (size_t)(p->at % p->halfedges);
    static const uint32_t bit[] = {1u << 24, 1u << 31, 1u << 16, 1u << 8, 1u << 23};
    corner[2] ^= bit[p->at / 3 % 5];
    if (p->at / 3 % 5 == 3) corner[2] |= 0xff00; /* a depth beyond all, or beside the others */
    return true;
}

static bool spoil_sharpness(const parts *p) {
    uint32_t *inner = find_inner(p), *corner = p->corner + 4 * (size_t)(p->at % p->halfedges);
    if (p->at / 3 % 3 == 0)
        corner[3] |= 1u << (8 + p->at % 24);
    else if (p->at / 3 % 3 == 1 || !inner)
        corner[3] = (10 + p->at % 5) << (p->at % 2 ? 4 : 0);
    else
        inner[3] = (inner[3] & 0xf0) | ((inner[3] & 15) ? 0 : 1 + p->at % 9);
    return true;
}

static bool spoil_words(hs_packet *packet, const parts *p, hs_limits *limits, uint32_t fault) {
    switch (fault) {
    case HS_STATUS_BAD_MAGIC:
        p->word[0] ^= 1u << p->at % 32;
        return true;
    case HS_STATUS_BAD_VERSION:
        p->word[1] ^= 1u << p->at % 32;
        return true;
    case HS_STATUS_BAD_FLAGS:
        p->word[2] |= p->at % 28 ? 1u << (4 + p->at % 28) : 0;
        if (p->at % 28 < 1) p->word[2] |= HS_FLAG_SMOOTH | HS_FLAG_EDGE_ONLY;
        return true;
    case HS_STATUS_BAD_COUNT:
        return spoil_count(p);
    case HS_STATUS_BAD_DEPTH:
        p->word[6] |= p->at % 4 < 3 ? 0xffu << 8 * (p->at % 4) : 1u << (24 + p->at / 4 % 8);
        return true;
    case HS_STATUS_BAD_RESERVED:
        return spoil_reserved(p);
    case HS_STATUS_CAPACITY_VERTICES:
        limits->vertices = p->at % p->vertices;
        return true;
    case HS_STATUS_CAPACITY_CORNERS:
        limits->quads = p->at % p->halfedges;
        return true;
    case HS_STATUS_BAD_NUMBER:
        return spoil_number(p);
    case HS_STATUS_OVERFLOW:
        return spoil_sum(p);
    case HS_STATUS_BAD_INDEX:
        p->corner[4 * (size_t)(p->at % p->halfedges)] = p->vertices + p->at / 3 % 4 * 0x3fffffff;
        return true;
    case HS_STATUS_BAD_TWIN:
        return spoil_twin(p);
    case HS_STATUS_BAD_FACE:
        return spoil_face(p);
    case HS_STATUS_BAD_VALENCE:
        return merge_poles(p);
    case HS_STATUS_BAD_TRAILER:
        p->trailer[0] ^= 1u << p->at % 32;
        return true;
    case HS_STATUS_BAD_CRC:
        p->trailer[3] ^= 1u << p->at % 32;
        return true;
    case HS_STATUS_TRUNCATED:
        packet->words = 4 + 4 * (size_t)(p->at % (packet->words / 4 - 1));
        return true;
    case HS_STATUS_TOO_LONG:
        return end_early(packet, p);
    case HS_STATUS_BAD_PIXELS:
        return spoil_pixels(p);
    case HS_STATUS_BAD_SHARPNESS:
        return spoil_sharpness(p);
    default:
        return false;
    }
}

bool campaign_spoil(hs_packet *packet, hs_limits *limits, uint32_t fault, uint32_t at) {
    uint32_t *word = packet->word;
    const parts p = {.word = word,
                     .vertex = word + VERTICES_AT,
                     .corner = word + VERTICES_AT + 4 * (size_t)word[3],
                     .trailer = word + packet->words - 4,
                     .vertices = word[3],
                     .faces = word[4],
                     .halfedges = word[5],
                     .at = at};
    if (!spoil_words(packet, &p, limits, fault)) return false;
    const bool keeps_crc =
        fault == HS_STATUS_BAD_CRC || fault == HS_STATUS_TRUNCATED || fault == HS_STATUS_TOO_LONG;
    if (!keeps_crc) packet->word[packet->words - 1] = hs_packet_crc(packet);
    return true;
}
