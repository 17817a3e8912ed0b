/* SPDX-License-Identifier: Apache-2.0
 *
 * receive: reads a view's packet, record by record, and checks it (docs/stream.md gives every
 * check). The first word at fault decides: status and position.
 */
#include <stdlib.h>
#include <string.h>

#include "golden_state.h"

enum { POSITION_OF_VERTICES = 4 * (HS_HEADER_RECORDS + HS_MATRIX_RECORDS) };

static void refuse(hs_state *s, uint32_t status, size_t position) {
    s->status = status;
    s->error_position = (uint32_t)position;
}

static bool finite_word(uint32_t word) {
    return (word >> 23 & 0xff) != 0xff;
}

/* The record at word `at`, or NULL and TRUNCATED if the packet ends before it. */
static const uint32_t *record_at(hs_state *s, const hs_packet *in, size_t at) {
    if (at + 4 <= in->words) return in->word + at;
    refuse(s, HS_STATUS_TRUNCATED, in->words);
    return NULL;
}

static bool good_flags(uint32_t flags) {
    const uint32_t modes = HS_FLAG_SMOOTH | HS_FLAG_EDGE_ONLY;
    return !(flags & ~(HS_FLAG_UNIFORM | HS_FLAG_GUARD | HS_FLAG_LIMIT | modes)) &&
           (flags & modes) != modes;
}

/* Sharpness of edge or vertex, 4 bits. */
static bool good_sharpness(uint32_t sharpness) {
    return sharpness <= HS_MAX_SHARPNESS || sharpness == HS_SHARP_INFINITE;
}

static bool read_header(hs_state *s, const hs_packet *in) {
    const uint32_t *a = record_at(s, in, 0);
    if (!a) return false;
    const uint32_t vertices = a[3];
    if (a[0] != HS_MAGIC_VIEW) return refuse(s, HS_STATUS_BAD_MAGIC, 0), false;
    if (a[1] != HS_STREAM_VERSION) return refuse(s, HS_STATUS_BAD_VERSION, 1), false;
    if (!good_flags(a[2])) return refuse(s, HS_STATUS_BAD_FLAGS, 2), false;
    if (vertices < 3) return refuse(s, HS_STATUS_BAD_COUNT, 3), false;
    if (vertices > s->limits.vertices) return refuse(s, HS_STATUS_CAPACITY_VERTICES, 3), false;

    const uint32_t *b = record_at(s, in, 4);
    if (!b) return false;
    const uint32_t faces = b[0], halfedges = b[1], depths = b[2];
    const uint32_t front = depths & 0xff, silhouette = depths >> 8 & 0xff;
    const uint32_t uniform = depths >> 16 & 0xff;
    if (faces < 1) return refuse(s, HS_STATUS_BAD_COUNT, 4), false;
    if (halfedges < (uint64_t)HS_MIN_SIDES * faces) return refuse(s, HS_STATUS_BAD_COUNT, 5), false;
    if (halfedges > s->limits.quads) return refuse(s, HS_STATUS_CAPACITY_CORNERS, 5), false;
    if (depths >> 24 || front > HS_MAX_DEPTH || silhouette > HS_MAX_DEPTH || uniform > HS_MAX_DEPTH)
        return refuse(s, HS_STATUS_BAD_DEPTH, 6), false;
    if (b[3]) return refuse(s, HS_STATUS_BAD_RESERVED, 7), false;

    const uint32_t *c = record_at(s, in, 8);
    if (!c) return false;
    const uint32_t width = c[1] & 0xffff, height = c[1] >> 16;
    if (c[0] >> 16) return refuse(s, HS_STATUS_BAD_PIXELS, 8), false;
    if (c[0] && (!width || !height)) return refuse(s, HS_STATUS_BAD_PIXELS, 9), false;
    if (c[2]) return refuse(s, HS_STATUS_BAD_RESERVED, 10), false;
    if (c[3]) return refuse(s, HS_STATUS_BAD_RESERVED, 11), false;

    s->settings.uniform = a[2] & HS_FLAG_UNIFORM;
    s->settings.guard = a[2] & HS_FLAG_GUARD;
    s->settings.front_depth = (uint8_t)front;
    s->settings.silhouette_depth = (uint8_t)silhouette;
    s->settings.uniform_depth = (uint8_t)uniform;
    s->settings.limit = a[2] & HS_FLAG_LIMIT;
    s->settings.boundary = a[2] & HS_FLAG_SMOOTH      ? HS_BOUNDARY_SMOOTH
                           : a[2] & HS_FLAG_EDGE_ONLY ? HS_BOUNDARY_EDGE_ONLY
                                                      : HS_BOUNDARY_KEPT;
    s->settings.min_edge = (uint16_t)c[0];
    s->settings.width = (uint16_t)width;
    s->settings.height = (uint16_t)height;
    s->vertices = vertices;
    s->faces = faces;
    s->halfedges = halfedges;
    return true;
}

static bool read_matrix(hs_state *s, const hs_packet *in) {
    for (size_t row = 0; row < HS_MATRIX_RECORDS; row++) {
        size_t at = 4 * (HS_HEADER_RECORDS + row);
        const uint32_t *r = record_at(s, in, at);
        if (!r) return false;
        for (size_t k = 0; k < 4; k++)
            if (!finite_word(r[k])) return refuse(s, HS_STATUS_BAD_NUMBER, at + k), false;
        memcpy(s->matrix + 4 * row, r, 16);
    }
    return true;
}

static bool read_vertices(hs_state *s, const hs_packet *in) {
    for (uint32_t v = 0; v < s->vertices; v++) {
        size_t at = POSITION_OF_VERTICES + 4 * (size_t)v;
        const uint32_t *r = record_at(s, in, at);
        if (!r) return false;
        for (size_t k = 0; k < 4; k++)
            if (!finite_word(r[k])) return refuse(s, HS_STATUS_BAD_NUMBER, at + k), false;
        float position[4];
        memcpy(position, r, sizeof position);
        uint32_t row;
        if (!hs_stage_transform(s, v, position, &row))
            return refuse(s, HS_STATUS_OVERFLOW, at + row), false;
    }
    return true;
}

static bool read_corners(hs_state *s, const hs_packet *in) {
    uint32_t face = 0, corner = 0; /* the next corner's */
    uint32_t shape = 0;            /* sides and forced depth of the face under way */
    for (uint32_t h = 0; h < s->halfedges; h++) {
        size_t at = POSITION_OF_VERTICES + 4 * ((size_t)s->vertices + h);
        const uint32_t *r = record_at(s, in, at);
        if (!r) return false;
        if (r[0] >= s->vertices) return refuse(s, HS_STATUS_BAD_INDEX, at), false;
        if ((r[1] >= s->halfedges && r[1] != HS_BORDER) || r[1] == h)
            return refuse(s, HS_STATUS_BAD_TWIN, at + 1), false;

        const uint32_t sides = r[2] & 0xff, forced = r[2] >> 8 & 0xff;
        bool good = r[2] >> 24 == 0 && (r[2] >> 16 & 0xff) == corner;
        if (corner == 0)
            good = good && face < s->faces && sides >= HS_MIN_SIDES && sides <= s->halfedges - h &&
                   forced <= HS_MAX_DEPTH;
        else
            good = good && (r[2] & 0xffff) == shape;
        bool ends = corner + 1 == sides;
        if (h + 1 == s->halfedges) good = good && ends && face + 1 == s->faces;
        if (!good) return refuse(s, HS_STATUS_BAD_FACE, at + 2), false;
        if (r[3] >> 8 || !good_sharpness(r[3] & 0xf) || !good_sharpness(r[3] >> 4))
            return refuse(s, HS_STATUS_BAD_SHARPNESS, at + 3), false;

        if (corner == 0) {
            shape = r[2] & 0xffff;
            s->first[face] = h;
            s->forced[face] = (uint8_t)forced;
            if (forced > s->max_forced) s->max_forced = forced;
        }
        s->origin[h] = r[0];
        s->twin[h] = r[1];
        s->sharp[h] = r[3] & 0xf;
        if (s->stays[r[0]] < r[3] >> 4) s->stays[r[0]] = (uint8_t)(r[3] >> 4);
        s->face[h] = face;
        corner = ends ? 0 : corner + 1;
        face += ends;
    }
    s->first[s->faces] = s->halfedges;
    return true;
}

static bool read_trailer(hs_state *s, const hs_packet *in) {
    size_t at = POSITION_OF_VERTICES + 4 * ((size_t)s->vertices + s->halfedges);
    const uint32_t *r = record_at(s, in, at);
    if (!r) return false;
    if (r[0] != HS_MAGIC_END) return refuse(s, HS_STATUS_BAD_TRAILER, at), false;
    if (r[1]) return refuse(s, HS_STATUS_BAD_RESERVED, at + 1), false;
    if (r[2]) return refuse(s, HS_STATUS_BAD_RESERVED, at + 2), false;
    if (r[3] != hs_crc(0, in->word, at + 3)) return refuse(s, HS_STATUS_BAD_CRC, at + 3), false;
    if (in->words > at + 4) return refuse(s, HS_STATUS_TOO_LONG, at + 4), false;
    return true;
}

/* Twins that point back, in the other direction, and no vertex with too many corners: with that,
 * and whatever else is wrong with a mesh, every later index is in range. The RTL checks it while
 * it classifies generation 0. */
static void check_topology(hs_state *s) {
    const size_t at = POSITION_OF_VERTICES + 4 * (size_t)s->vertices;
    for (uint32_t f = 0; f < s->faces; f++) {
        for (uint32_t h = s->first[f]; h < s->first[f + 1]; h++) {
            if (s->valence[s->origin[h]]++ == HS_MAX_VALENCE)
                return refuse(s, HS_STATUS_BAD_VALENCE, at + 4 * (size_t)h);
            uint32_t next = h + 1 < s->first[f + 1] ? h + 1 : s->first[f];
            uint32_t t = s->twin[h];
            if (t == HS_BORDER) continue;
            if (s->twin[t] != h || s->origin[t] != s->origin[next])
                return refuse(s, HS_STATUS_BAD_TWIN, at + 4 * (size_t)h + 1);
            if (s->sharp[t] != s->sharp[h])
                return refuse(s, HS_STATUS_BAD_SHARPNESS, at + 4 * (size_t)h + 3);
        }
    }
}

/* Puts a sharpness among the three largest ones of a vertex, in descending order. */
static void insert(uint8_t largest[3], uint8_t sharpness) {
    for (int i = 0; i < 3; i++)
        if (sharpness > largest[i]) {
            const uint8_t smaller = largest[i];
            largest[i] = sharpness;
            sharpness = smaller;
        }
}

/* Which vertices stay and which lie on a crease, and until when, follows from the three largest
 * sharpnesses of their edges. Every edge inside has one half-edge that leaves each of its ends; at
 * a boundary as many half-edges leave a vertex as arrive, so each that leaves counts twice. */
static void find_sharp_vertices(hs_state *s) {
    uint8_t(*largest)[3] = calloc(s->vertices, sizeof *largest);
    if (!largest) {
        s->exhausted = true;
        return;
    }
    const bool kept = s->settings.boundary == HS_BOUNDARY_KEPT;
    s->plain = !s->settings.limit && !s->settings.min_edge;
    s->closed = true;
    s->boundary = 0;
    for (uint32_t h = 0; h < s->halfedges; h++) {
        uint8_t *of_origin = largest[s->origin[h]];
        if (s->twin[h] != HS_BORDER) {
            insert(of_origin, s->sharp[h]);
            s->plain &= !s->sharp[h];
        } else {
            s->sharp[h] = 0;
            s->closed = false;
            if (kept) continue;
            s->twin[h] = BOUNDARY_TWIN;
            insert(of_origin, HS_SHARP_INFINITE);
            insert(of_origin, HS_SHARP_INFINITE);
            s->boundary++;
            s->plain = false;
        }
    }
    for (uint32_t v = 0; v < s->vertices; v++) {
        const bool corner = s->settings.boundary == HS_BOUNDARY_SMOOTH && s->valence[v] == 1 &&
                            largest[v][1] == HS_SHARP_INFINITE;
        if (largest[v][2] > s->stays[v]) s->stays[v] = largest[v][2];
        if (corner) s->stays[v] = HS_SHARP_INFINITE;
        s->crease[v] = largest[v][1];
        s->plain &= !s->stays[v];
    }
    free(largest);
}

void hs_stage_receive(hs_state *s, const hs_packet *in) {
    s->status = HS_STATUS_OK;
    s->error_position = HS_NO_POSITION;
    s->max_forced = 0;
    s->parsed = false;
    if (!read_header(s, in) || !read_matrix(s, in)) return;
    if (!hs_state_reserve(s, s->vertices, s->faces, s->halfedges)) return;
    memset(s->stays, 0, s->vertices);
    if (!read_vertices(s, in) || !read_corners(s, in) || !read_trailer(s, in)) return;
    s->parsed = true;
    memset(s->valence, 0, s->vertices);
    check_topology(s);
    if (s->status == HS_STATUS_OK) find_sharp_vertices(s);
}
