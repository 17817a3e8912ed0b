/* SPDX-License-Identifier: Apache-2.0
 *
 * Output packets, decoded and checked. The words come from hardware under test, so nothing in them
 * is believed: a first pass walks the records and counts, a second fills arrays of just that size.
 *
 *   header | any number of: (vertices, 1 to 4 positions) or (face, more*) | trailer | end
 */
#include "stream.h"

#include <inttypes.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* --- The fields of a record ------------------------------------------------------------------- */

static bool is_tagged(const uint32_t record[4]) {
    return record[0] >> 23 == HS_TAG;
}

static uint32_t kind_of(const uint32_t record[4]) {
    return record[0] >> 20 & 7;
}

static uint32_t generation_of(const uint32_t record[4]) {
    return record[0] & 0xff;
}

/* Vertices that a VERTICES record announces. */
static uint32_t group_of(const uint32_t record[4]) {
    return record[0] >> 16 & 15;
}

/* Sides of a FACE, vertices in a MORE record. */
static uint32_t sides_of(const uint32_t record[4]) {
    return record[0] >> 8 & 0xff;
}

/* The four numbers of 24 bits in words 1 to 3, the lowest bits first. */
static void unpack_numbers(uint32_t number[4], const uint32_t record[4]) {
    number[0] = record[1] & 0xffffff;
    number[1] = record[1] >> 24 | (record[2] & 0xffff) << 8;
    number[2] = record[2] >> 16 | (record[3] & 0xff) << 16;
    number[3] = record[3] >> 8;
}

static float float_of(uint32_t word) {
    float value;
    memcpy(&value, &word, sizeof value);
    return value;
}

/* --- First pass: is it a packet, and how much is in it? --------------------------------------- */

typedef struct counts {
    uint32_t vertices, faces, triangles, corners;
    uint32_t generation; /* the largest one seen */
    bool grouped;        /* vertices of that generation were sent */
    bool interleaved;    /* faces of the one before followed: it is the last step's result */
    bool cut;            /* in that generation, a triangle (v, w, F) left */
} counts;

typedef struct reader {
    const hs_packet *packet;
    hs_error *err;
} reader;

/* Fails with the view, the word, what the stream has there, and why that is wrong. */
static bool wrong(const reader *in, size_t word, const char *format, ...)
    __attribute__((format(printf, 3, 4)));
static bool wrong(const reader *in, size_t word, const char *format, ...) {
    char what[160], why[240];
    hs_output_describe(in->packet, word, what, sizeof what);
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(why, sizeof why, format, arguments);
    va_end(arguments);
    return hs_fail(in->err, HS_EXIT_STREAM,
                   "output packet of view %u: word %zu (%s): %s; the packet was damaged, or its "
                   "sender has a defect",
                   in->packet->view, word, what, why);
}

/* Bits of word 0 that a kind of record leaves unused are zero. */
static bool check_unused(const reader *in, size_t at, uint32_t mask) {
    uint32_t word = in->packet->word[at];
    if (word & mask) return wrong(in, at, "0x%08x sets reserved bits", word);
    return true;
}

/* Numbers behind the first used ones are zero. */
static bool check_numbers(const reader *in, size_t at, uint32_t used) {
    uint32_t number[4];
    unpack_numbers(number, in->packet->word + at);
    for (uint32_t i = used; i < 4; i++)
        if (number[i]) return wrong(in, at + 1 + 3 * i / 4, "an unused number is not zero");
    return true;
}

static bool check_depth(const reader *in, size_t at, counts *sum) {
    uint32_t generation = generation_of(in->packet->word + at);
    if (generation > HS_MAX_DEPTH)
        return wrong(in, at, "generation %u is deeper than %d", generation, HS_MAX_DEPTH);
    if (generation > sum->generation) {
        if (sum->interleaved) return wrong(in, at, "generation %u behind the last one", generation);
        sum->generation = generation;
        sum->grouped = sum->cut = false;
    }
    return true;
}

/* Vertices never go back to an earlier generation; in the last step they precede the quads. */
static bool check_vertex_generation(const reader *in, size_t at, counts *sum) {
    uint32_t generation = generation_of(in->packet->word + at);
    if (generation < sum->generation || (generation == sum->generation && sum->interleaved))
        return wrong(in, at, "vertices of generation %u behind faces of generation %u", generation,
                     sum->generation);
    if (!check_depth(in, at, sum)) return false;
    sum->grouped = true;
    return true;
}

/* Faces go back by one in the last step alone, whose quads leave among the faces that it ends;
 * they need no vertices of their own generation. */
static bool check_face_generation(const reader *in, size_t at, counts *sum) {
    uint32_t generation = generation_of(in->packet->word + at);
    if (generation >= sum->generation) return check_depth(in, at, sum);
    if (generation + 1 < sum->generation || sum->grouped)
        return wrong(in, at, "generation %u behind generation %u", generation, sum->generation);
    sum->interleaved = true;
    return true;
}

/* The header, and the block exponent in it. */
static bool check_header(const reader *in) {
    const uint32_t *word = in->packet->word;
    if (word[0] != hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION) &&
        (word[0] & ~0xffu) == hs_tag(HS_RECORD_HEADER, 0))
        return hs_fail(in->err, HS_EXIT_STREAM,
                       "output packet of view %u: it is of stream version %u, and version %d is "
                       "read here; make it anew, or use a halfstep of its version",
                       in->packet->view, word[0] & 0xff, HS_STREAM_VERSION);
    if (word[0] != hs_tag(HS_RECORD_HEADER, HS_STREAM_VERSION))
        return wrong(in, 0, "0x%08x is not the header of version %d", word[0], HS_STREAM_VERSION);
    if (word[1] != in->packet->view) return wrong(in, 1, "it is the header of view %u", word[1]);
    /* The smallest positive binary32 is 2^-149, all are below 2^128. */
    int32_t exponent = (int32_t)word[2];
    if (exponent < -148 || exponent > 128)
        return wrong(in, 2, "no binary32 has the block exponent %" PRId32, exponent);
    if (word[3]) return wrong(in, 3, "0x%08x in a reserved word", word[3]);
    return true;
}

/* A group: VERTICES and its positions. left is how many records follow before TRAILER and END;
 * *records is set to the group's own. short_group tells, and is told, whether the record before is
 * a group of fewer than 4 (which a group of the same generation would have filled). */
static bool check_group(const reader *in, size_t at, size_t left, counts *sum, bool *short_group,
                        size_t *records) {
    const uint32_t *word = in->packet->word + at;
    uint32_t count = group_of(word), before = sum->generation;
    if (!check_unused(in, at, 0xff00)) return false;
    if (count < 1 || count > 4) return wrong(in, at, "a group of %u vertices", count);
    if (!check_vertex_generation(in, at, sum) || !check_numbers(in, at, count)) return false;
    if (*short_group && before == sum->generation)
        return wrong(in, at, "the group before it has fewer than 4 vertices");
    if (count > left) return wrong(in, at, "the packet ends inside the group");
    double bound = ldexp(1, (int32_t)in->packet->word[2]);
    for (size_t i = 4; i < 4 + 4 * (size_t)count; i++) {
        if (i % 4 == 0 && is_tagged(word + i))
            return wrong(in, at + i, "the group before it announces %u positions", count);
        if (!(fabs((double)float_of(word[i])) < bound))
            return wrong(in, at + i, "%g is not below the block's 2^%" PRId32,
                         (double)float_of(word[i]), (int32_t)in->packet->word[2]);
    }
    sum->vertices += count;
    *short_group = count < 4;
    *records = 1 + count;
    return true;
}

/* A face: FACE and its MORE records. */
static bool check_face(const reader *in, size_t at, size_t left, counts *sum, size_t *records) {
    const uint32_t *word = in->packet->word + at;
    uint32_t sides = sides_of(word);
    if (!check_unused(in, at, 0xe0000)) return false;
    if (sides < HS_MIN_SIDES || (sides > 4 && generation_of(word)))
        return wrong(in, at, "a face of %u sides in generation %u", sides, generation_of(word));
    if (!check_face_generation(in, at, sum) || !check_numbers(in, at, sides < 4 ? sides : 4))
        return false;
    uint32_t more = sides > 4 ? (sides - 4 + 3) / 4 : 0;
    if (more > left) return wrong(in, at, "the packet ends inside the face");
    for (uint32_t i = 1; i <= more; i++) {
        size_t here = at + 4 * (size_t)i;
        uint32_t rest = sides - 4 * i, count = rest < 4 ? rest : 4;
        uint32_t expected = hs_tag(HS_RECORD_MORE, count << 8 | generation_of(word));
        if (word[4 * i] != expected)
            return wrong(in, here, "0x%08x instead of 0x%08x, which is due for the face",
                         word[4 * i], expected);
        if (!check_numbers(in, here, count)) return false;
    }
    sum->faces++;
    sum->corners += sides;
    sum->triangles += sides == 3;
    if (generation_of(word) == sum->generation && sides == 3 && !(word[0] >> 16 & 1))
        sum->cut = true;
    *records = 1 + more;
    return true;
}

/* What a status says about the rest of the packet, and the counts. at is TRAILER's word 0. */
static bool check_trailer(const reader *in, size_t at, const counts *sum) {
    const uint32_t *word = in->packet->word + at;
    uint32_t status = word[0] & 0xff;
    bool refused = status != HS_STATUS_OK && status != HS_STATUS_STOPPED;
    if (!is_tagged(word) || kind_of(word) != HS_RECORD_TRAILER)
        return wrong(in, at, "no trailer before the last record");
    if (!check_unused(in, at, 0xfff00)) return false;
    if (strcmp(hs_status_name(status), "?") == 0) return wrong(in, at, "%u is no status", status);
    if (refused && in->packet->word[2])
        return wrong(in, 2, "a refused view (%s) has a block exponent", hs_status_name(status));
    if (refused != (word[1] != HS_NO_POSITION))
        return wrong(in, at + 1, "position 0x%08x with status %s", word[1], hs_status_name(status));
    if (word[2] != sum->vertices)
        return wrong(in, at + 2, "it says %u, the packet has %u", word[2], sum->vertices);
    if (word[3] != sum->faces)
        return wrong(in, at + 3, "it says %u, the packet has %u", word[3], sum->faces);
    if (refused != (sum->faces == 0) || (refused && sum->vertices))
        return wrong(in, at, "%u vertices and %u faces with status %s", sum->vertices, sum->faces,
                     hs_status_name(status));
    return true;
}

/* A view that met a memory's fault: its records say nothing, and may end in the middle of a face.
 * What must hold is that the packet came over whole. */
static bool is_faulty(const hs_packet *packet) {
    const uint32_t *word = packet->word + packet->words - 8;
    return is_tagged(word) && kind_of(word) == HS_RECORD_TRAILER &&
           (word[0] & 0xff) == HS_STATUS_MEMORY_FAULT;
}

static bool check_faulty(const reader *in) {
    const size_t at = in->packet->words - 8;
    const uint32_t *word = in->packet->word + at, *end = word + 4;
    if (!check_unused(in, at, 0xfff00)) return false;
    if (word[1] != HS_NO_POSITION)
        return wrong(in, at + 1, "position 0x%08x with a memory's fault", word[1]);
    if (!is_tagged(end) || kind_of(end) != HS_RECORD_END)
        return wrong(in, at + 4, "the last record is no END");
    const uint32_t crc = hs_crc(0, in->packet->word, at + 7);
    if (end[3] != crc) return wrong(in, at + 7, "it says 0x%08x, it is 0x%08x", end[3], crc);
    return true;
}

/* at is END's word 0. */
static bool check_end(const reader *in, size_t at, const counts *sum) {
    const uint32_t *word = in->packet->word + at;
    uint32_t generation = generation_of(word);
    if (!is_tagged(word) || kind_of(word) != HS_RECORD_END)
        return wrong(in, at, "the packet does not end with an end record");
    if (!check_unused(in, at, 0xfff00)) return false;
    /* Refined faces that all became triangles leave an empty mesh to the next generation. */
    if (generation != sum->generation && !(sum->cut && generation == sum->generation + 1))
        return wrong(in, at, "generation %u, but faces left in generation %u", generation,
                     sum->generation);
    if (word[1] != sum->triangles)
        return wrong(in, at + 1, "it says %u, the packet has %u", word[1], sum->triangles);
    if (word[2] > sum->vertices)
        return wrong(in, at + 2, "%u vertices at their level of %u", word[2], sum->vertices);
    uint32_t crc = hs_crc(0, in->packet->word, at + 3);
    if (word[3] != crc) return wrong(in, at + 3, "it says 0x%08x, it is 0x%08x", word[3], crc);
    return true;
}

static bool check_packet(const reader *in, counts *sum) {
    const uint32_t *word = in->packet->word;
    size_t words = in->packet->words;
    if (words < 12 || words % 4 || words / 4 > UINT32_MAX / 4)
        return hs_fail(in->err, HS_EXIT_STREAM,
                       "output packet of view %u: %zu words; a packet has three records of 4 words "
                       "or more",
                       in->packet->view, words);
    if (!check_header(in)) return false;
    if (is_faulty(in->packet)) return check_faulty(in);
    bool short_group = false;
    size_t at = 4, trailer = words - 8;
    while (at < trailer) {
        size_t left = (trailer - at) / 4 - 1, records = 0;
        bool good = false;
        if (!is_tagged(word + at)) return wrong(in, at, "a position that no group announces");
        switch (kind_of(word + at)) {
        case HS_RECORD_VERTICES:
            good = check_group(in, at, left, sum, &short_group, &records);
            break;
        case HS_RECORD_FACE:
            short_group = false;
            good = check_face(in, at, left, sum, &records);
            break;
        default:
            return wrong(in, at, "this kind of record has no place here");
        }
        if (!good) return false;
        at += 4 * records;
    }
    return check_trailer(in, trailer, sum) && check_end(in, trailer + 4, sum);
}

/* --- Second pass: vertices and faces ---------------------------------------------------------- */

/* From vertex numbers to places in the output: a hash table, open addressing, at most half full.
 * (The largest number is not bounded by the packet's size, a plain table would not be either.) */
typedef struct places {
    uint32_t bits;   /* of a slot's number, 1 to 25 */
    uint32_t *place; /* 2^bits; place + 1, or 0 where free */
} places;

/* The slot that has a number, or the free one where it belongs. number_at is by place. */
static uint32_t *find_slot(const places *map, const uint32_t *number_at, uint32_t number) {
    /* 2^32 / golden ratio: spreads runs of numbers evenly over the upper bits. */
    uint32_t slot = (number * 2654435769u) >> (32 - map->bits), mask = (1u << map->bits) - 1;
    while (map->place[slot] && number_at[map->place[slot] - 1] != number)
        slot = (slot + 1) & mask;
    return &map->place[slot];
}

static bool take_group(const reader *in, size_t at, hs_output *out, places *map) {
    const uint32_t *word = in->packet->word + at;
    uint32_t number[4], count = group_of(word);
    unpack_numbers(number, word);
    for (uint32_t i = 0; i < count; i++) {
        uint32_t *slot = find_slot(map, out->number, number[i]);
        if (*slot)
            return wrong(in, at + 1 + 3 * i / 4, "vertex %u is sent a second time", number[i]);
        out->number[out->vertices] = number[i];
        memcpy(out->position + 4 * (size_t)out->vertices, word + 4 + 4 * i, 16);
        *slot = ++out->vertices;
    }
    return true;
}

/* A face may name a vertex twice: the pipeline takes such meshes, and sends what they become. */
static bool take_face(const reader *in, size_t at, hs_output *out, const places *map) {
    const uint32_t *word = in->packet->word + at;
    uint32_t sides = sides_of(word), begin = out->first[out->faces], number[4];
    for (uint32_t i = 0; i < sides; i++) {
        if (i % 4 == 0) unpack_numbers(number, word + i);
        uint32_t place = *find_slot(map, out->number, number[i % 4]);
        size_t where = at + i / 4 * 4 + 1 + 3 * (i % 4) / 4;
        if (!place) return wrong(in, where, "vertex %u was not sent", number[i % 4]);
        out->corner[begin + i] = place - 1;
    }
    out->generation[out->faces] = (uint8_t)generation_of(word);
    out->candidate[out->faces] = (uint8_t)(word[0] >> 16 & 1);
    out->first[++out->faces] = begin + sides;
    return true;
}

/* All records were checked: only what the numbers mean is left to be found wrong. */
static bool take_packet(const reader *in, hs_output *out, places *map) {
    const uint32_t *word = in->packet->word;
    for (size_t at = 4; at < in->packet->words - 8;) {
        if (kind_of(word + at) == HS_RECORD_VERTICES) {
            if (!take_group(in, at, out, map)) return false;
            at += 4 + 4 * (size_t)group_of(word + at);
        } else {
            if (!take_face(in, at, out, map)) return false;
            at += ((size_t)sides_of(word + at) + 3) / 4 * 4;
        }
    }
    return true;
}

/* An array of at least one item, so that NULL always means that there is no memory. */
static void *new_array(size_t count, size_t size) {
    return calloc(count ? count : 1, size);
}

bool hs_output_decode(hs_output *output, const hs_packet *packet, hs_error *err) {
    *output = (hs_output){0};
    reader in = {packet, err};
    counts sum = {0};
    if (!check_packet(&in, &sum)) return false;

    const uint32_t *trailer = packet->word + packet->words - 8, *end = trailer + 4;
    const bool faulty = is_faulty(packet);
    hs_output out = {.view = packet->view,
                     .status = trailer[0] & 0xff,
                     .error_position = trailer[1],
                     .exponent = (int32_t)packet->word[2],
                     .generations = faulty ? 0 : generation_of(end),
                     .triangles = sum.triangles,
                     .at_level = faulty ? 0 : end[2],
                     .corners = sum.corners,
                     .position = new_array(sum.vertices, 16),
                     .number = new_array(sum.vertices, sizeof(uint32_t)),
                     .first = new_array((size_t)sum.faces + 1, sizeof(uint32_t)),
                     .corner = new_array(sum.corners, sizeof(uint32_t)),
                     .generation = new_array(sum.faces, 1),
                     .candidate = new_array(sum.faces, 1)};
    uint32_t bits = 1; /* the numbers have 24 bits, so 2^25 slots are enough for any packet */
    while (bits < HS_INDEX_BITS + 1 && 1u << bits < 2 * (uint64_t)sum.vertices)
        bits++;
    places map = {bits, new_array((size_t)1 << bits, sizeof(uint32_t))};

    bool good = out.position && out.number && out.first && out.corner && out.generation &&
                out.candidate && map.place;
    if (!good) hs_fail(err, HS_EXIT_INTERNAL, "no memory for the output of view %u", packet->view);
    good = good && (faulty || take_packet(&in, &out, &map));
    free(map.place);
    if (!good) {
        hs_output_free(&out);
        return false;
    }
    *output = out;
    return true;
}

void hs_output_free(hs_output *output) {
    free(output->position);
    free(output->number);
    free(output->first);
    free(output->corner);
    free(output->generation);
    free(output->candidate);
    *output = (hs_output){0};
}

/* --- Words, in words -------------------------------------------------------------------------- */

/* Where a walk over the records is: enough to name the next one. */
typedef struct walk {
    uint32_t faces;       /* FACE records so far */
    uint32_t corners;     /* of the latest face: its vertices in the records so far */
    uint32_t number[4];   /* of the latest VERTICES record */
    uint32_t group, sent; /* how many it announces; positions since */
} walk;

static void step_walk(walk *state, const uint32_t record[4]) {
    if (!is_tagged(record)) {
        if (state->sent < state->group) state->sent++;
        return;
    }
    state->group = state->sent = 0;
    switch (kind_of(record)) {
    case HS_RECORD_VERTICES:
        unpack_numbers(state->number, record);
        state->group = group_of(record) > 4 ? 4 : group_of(record);
        break;
    case HS_RECORD_FACE:
        state->faces++;
        state->corners = 4;
        break;
    case HS_RECORD_MORE:
        state->corners += 4;
        break;
    }
}

static void describe_face(const walk *state, const uint32_t record[4], uint32_t w, char *text,
                          size_t size) {
    bool more = kind_of(record) == HS_RECORD_MORE;
    uint32_t face = more ? state->faces - 1 : state->faces;
    /* Word w holds bits of two numbers: the w-th and the next. */
    uint32_t place = (more ? state->corners : 0) + w;
    if (more && state->faces == 0)
        snprintf(text, size, "more vertices of no face");
    else if (w > 0)
        snprintf(text, size, "face %u of generation %u, vertices %u and %u", face,
                 generation_of(record), place, place + 1);
    else if (more)
        snprintf(text, size, "face %u of generation %u, head of %u more vertices", face,
                 generation_of(record), sides_of(record));
    else
        snprintf(text, size, "face %u of generation %u, head: %u sides, %s", face,
                 generation_of(record), sides_of(record),
                 record[0] >> 16 & 1 ? "candidate" : "no candidate");
}

static void describe_record(const walk *state, const uint32_t record[4], uint32_t w, char *text,
                            size_t size) {
    static const char *const header[4] = {"version", "view", "block exponent", "reserved"};
    static const char *const trailer[4] = {"status", "position", "vertices sent", "faces sent"};
    static const char *const end[4] = {"last generation", "triangles sent",
                                       "vertices at their level", "CRC-32"};
    if (!is_tagged(record)) {
        if (state->sent < state->group)
            snprintf(text, size, "position of vertex %u (%c)", state->number[state->sent],
                     "xyzw"[w]);
        else
            snprintf(text, size, "position of no vertex (%c)", "xyzw"[w]);
        return;
    }
    switch (kind_of(record)) {
    case HS_RECORD_HEADER:
        snprintf(text, size, "header, %s", header[w]);
        break;
    case HS_RECORD_VERTICES:
        if (w > 0)
            snprintf(text, size, "numbers %u and %u of a group of %u vertices", w, w + 1,
                     group_of(record));
        else
            snprintf(text, size, "head of a group of %u vertices, generation %u", group_of(record),
                     generation_of(record));
        break;
    case HS_RECORD_FACE:
    case HS_RECORD_MORE:
        describe_face(state, record, w, text, size);
        break;
    case HS_RECORD_TRAILER:
        snprintf(text, size, "trailer, %s", trailer[w]);
        break;
    case HS_RECORD_END:
        snprintf(text, size, "end, %s", end[w]);
        break;
    default:
        snprintf(text, size, "record of unknown kind %u", kind_of(record));
    }
}

void hs_output_describe(const hs_packet *packet, size_t word, char *text, size_t size) {
    if (size == 0) return;
    size_t at = word - word % 4;
    if (word >= packet->words || packet->words - at < 4) {
        snprintf(text, size, "behind the packet's %zu words", packet->words);
        return;
    }
    walk state = {0};
    for (size_t i = 0; i < at; i += 4)
        step_walk(&state, packet->word + i);
    describe_record(&state, packet->word + at, (uint32_t)(word % 4), text, size);
}

bool hs_output_accepted(const hs_output *output, hs_error *err) {
    const uint32_t status = output->status;
    if (status == HS_STATUS_OK || status == HS_STATUS_STOPPED) return true;
    return hs_fail(err, HS_EXIT_REFUSED, "the view is refused, %s: %s; %s", hs_status_name(status),
                   hs_status_what(status), hs_status_remedy(status));
}
