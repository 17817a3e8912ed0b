/* SPDX-License-Identifier: Apache-2.0
 *
 * Stream files, and their text form.
 */
#include <ctype.h>
#include <errno.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "options.h"
#include "trace.h"

static const size_t FILE_LIMIT = (size_t)1 << 31;

/* --- Files --------------------------------------------------------------------------------------
 */

bool hs_stream_file_grow(hs_stream_file *file, hs_packet **packet, hs_error *err) {
    hs_packet *more = realloc(file->packet, (file->packets + 1) * sizeof *more);
    if (!more) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for another packet");
    file->packet = more;
    *packet = &more[file->packets++];
    **packet = (hs_packet){0};
    return true;
}

void hs_stream_file_free(hs_stream_file *file) {
    for (uint32_t i = 0; i < file->packets; i++)
        hs_packet_free(&file->packet[i]);
    free(file->packet);
    *file = (hs_stream_file){0};
}

bool hs_stream_file_read(hs_stream_file *file, const char *path, hs_error *err) {
    *file = (hs_stream_file){0};
    uint8_t *bytes;
    size_t size, offset = 0;
    if (!hs_file_read(path, FILE_LIMIT, &bytes, &size, err)) return false;
    bool good =
        size > 0 || hs_fail(err, HS_EXIT_STREAM,
                            "%.300s: empty; a stream file begins with the bytes HS2F", path);
    while (good && offset < size) {
        hs_packet *packet = NULL;
        good = hs_stream_file_grow(file, &packet, err) &&
               hs_frame_read(packet, bytes, size, &offset, path, err);
    }
    free(bytes);
    if (!good) hs_stream_file_free(file);
    return good;
}

bool hs_stream_file_write(const hs_stream_file *file, const char *path, hs_error *err) {
    hs_file target;
    if (!hs_file_create(&target, path, err)) return false;
    for (uint32_t i = 0; i < file->packets; i++)
        if (!hs_frame_write(target.stream, &file->packet[i], path, err)) {
            hs_file_abandon(&target);
            return false;
        }
    return hs_file_commit(&target, err);
}

/* --- Showing ------------------------------------------------------------------------------------
 */

static double number_of(uint32_t word) {
    float value;
    memcpy(&value, &word, sizeof value);
    return (double)value;
}

static void show_numbers(const char *what, uint64_t index, const uint32_t *w, FILE *text) {
    fprintf(text, "%s %llu: %.9g %.9g %.9g %.9g", what, (unsigned long long)index, number_of(w[0]),
            number_of(w[1]), number_of(w[2]), number_of(w[3]));
}

/* How far the reading of an input packet has come; its counts, whatever they are. */
typedef struct reader {
    uint64_t vertices, halfedges;
    uint32_t face;                /* of the next half-edge at place 0, plus one */
    uint32_t positions, position; /* of an output packet: numbers that VERTICES announced */
    uint32_t number[4];
} reader;

static void show_flags(uint32_t flags, FILE *text) {
    static const struct {
        uint32_t flag;
        const char *name;
    } known[] = {{HS_FLAG_UNIFORM, " uniform"},
                 {HS_FLAG_GUARD, " guard"},
                 {HS_FLAG_LIMIT, " limit"},
                 {HS_FLAG_SMOOTH, " smooth"},
                 {HS_FLAG_EDGE_ONLY, " edge-only"}};
    if (!flags) fprintf(text, " none");
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (flags & known[i].flag) fprintf(text, "%s", known[i].name);
        flags &= ~known[i].flag;
    }
    if (flags) fprintf(text, " unknown ones");
}

static void show_sharpness(const char *what, uint32_t sharpness, FILE *text) {
    if (sharpness == HS_SHARP_INFINITE)
        fprintf(text, ", %s sharp for ever", what);
    else if (sharpness)
        fprintf(text, ", %s sharp for %u", what, sharpness);
}

static void show_halfedge(reader *in, uint64_t halfedge, const uint32_t *w, FILE *text) {
    if ((w[2] >> 16 & 255) == 0) in->face++;
    fprintf(text, "half-edge %llu: side %u of %u of face %u, from vertex %u, ",
            (unsigned long long)halfedge, w[2] >> 16 & 255, w[2] & 255, in->face - 1, w[0]);
    if (w[1] == HS_BORDER)
        fprintf(text, "border");
    else
        fprintf(text, "twin %u", w[1]);
    if (w[2] >> 8 & 255) fprintf(text, ", forced %u", w[2] >> 8 & 255);
    show_sharpness("edge", w[3] & 15, text);
    show_sharpness("vertex", w[3] >> 4 & 15, text);
}

static void show_input_record(reader *in, uint64_t record, const uint32_t *w, FILE *text) {
    const uint64_t vertices = HS_HEADER_RECORDS + HS_MATRIX_RECORDS;
    const uint64_t halfedges = vertices + in->vertices, trailer = halfedges + in->halfedges;
    if (record == 0) {
        in->vertices = w[3];
        fprintf(text, "view, version %u, flags:", w[1]);
        show_flags(w[2], text);
        fprintf(text, "; %u vertices", w[3]);
    } else if (record == 1) {
        in->halfedges = w[1];
        fprintf(text, "%u faces, %u half-edges; depths: front %u, silhouette %u, uniform %u", w[0],
                w[1], w[2] & 255, w[2] >> 8 & 255, w[2] >> 16 & 255);
    } else if (record == 2) {
        fprintf(text, "least edge %g pixels of %u x %u",
                (w[0] & 0xffff) / (double)HS_PIXEL_FRACTION, w[1] & 0xffff, w[1] >> 16);
    } else if (record < vertices) {
        show_numbers("matrix row", record - HS_HEADER_RECORDS, w, text);
    } else if (record < halfedges) {
        show_numbers("vertex", record - vertices, w, text);
    } else if (record < trailer) {
        show_halfedge(in, record - halfedges, w, text);
    } else if (record == trailer) {
        fprintf(text, "end, CRC-32");
    } else {
        fprintf(text, "behind the end");
    }
}

/* The numbers packed in words 1 to 3. */
static void unpack_numbers(uint32_t number[4], const uint32_t *w) {
    number[0] = w[1] & 0xffffff;
    number[1] = w[1] >> 24 | (w[2] & 0xffff) << 8;
    number[2] = w[2] >> 16 | (w[3] & 0xff) << 16;
    number[3] = w[3] >> 8;
}

static void show_faces_vertices(uint32_t count, const uint32_t *w, FILE *text) {
    uint32_t number[4];
    unpack_numbers(number, w);
    for (uint32_t i = 0; i < count && i < 4; i++)
        fprintf(text, " %u", number[i]);
}

static void show_output_record(reader *out, const uint32_t *w, FILE *text) {
    if (out->position < out->positions) {
        show_numbers("position of", out->number[out->position++], w, text);
        return;
    }
    if (w[0] >> 23 != HS_TAG) {
        fprintf(text, "a position that no record announced");
        return;
    }
    const uint32_t low = w[0] & 255, count = w[0] >> 8 & 255;
    switch (w[0] >> 20 & 7) {
    case HS_RECORD_HEADER:
        fprintf(text, "header: version %u, view %u, block exponent %d", low, w[1], (int32_t)w[2]);
        return;
    case HS_RECORD_VERTICES:
        out->positions = w[0] >> 16 & 15;
        if (out->positions > 4) out->positions = 4;
        out->position = 0;
        unpack_numbers(out->number, w);
        fprintf(text, "vertices of generation %u:", low);
        show_faces_vertices(out->positions, w, text);
        return;
    case HS_RECORD_FACE:
        fprintf(text, "face of %u, generation %u%s:", count, low,
                w[0] >> 16 & 1 ? ", candidate" : "");
        show_faces_vertices(count, w, text);
        return;
    case HS_RECORD_MORE:
        fprintf(text, "  and:");
        show_faces_vertices(count, w, text);
        return;
    case HS_RECORD_TRAILER:
        fprintf(text, "trailer: %s", hs_status_name(low));
        if (w[1] != HS_NO_POSITION) fprintf(text, " at word %u", w[1]);
        fprintf(text, "; %u vertices, %u faces", w[2], w[3]);
        return;
    case HS_RECORD_END:
        fprintf(text, "end: generation %u, %u triangles, %u vertices at their level, CRC-32", low,
                w[1], w[2]);
        return;
    default:
        fprintf(text, "no kind of record");
    }
}

void hs_stream_file_show(const hs_stream_file *file, FILE *text) {
    for (uint32_t p = 0; p < file->packets; p++) {
        const hs_packet *packet = &file->packet[p];
        const bool output = packet->word[0] >> 23 == HS_TAG;
        reader at = {0};
        fprintf(text, "%spacket %u  # %s, %zu words\n", p ? "\n" : "", packet->view,
                output ? "output" : "input", packet->words);
        for (size_t r = 0; r < packet->words / 4; r++) {
            const uint32_t *w = packet->word + 4 * r;
            fprintf(text, "%08x %08x %08x %08x  # %zu ", w[0], w[1], w[2], w[3], 4 * r);
            if (output)
                show_output_record(&at, w, text);
            else
                show_input_record(&at, r, w, text);
            fputc('\n', text);
        }
    }
}

/* --- Building -----------------------------------------------------------------------------------
 */

/* Reads word i of a record; the words before it are there. */
static bool parse_word(const char *token, const hs_packet *packet, uint32_t record[4], int i) {
    uint32_t *word = &record[i];
    char *end;
    if (strcmp(token, "crc") == 0) {
        *word = hs_crc(hs_crc(0, packet->word, packet->words), record, (size_t)i);
        return true;
    }
    if (strchr(token, '.')) {
        const float value = strtof(token, &end);
        memcpy(word, &value, sizeof value);
        return *end == 0 && end != token;
    }
    if (strlen(token) > 8 || token[strspn(token, "0123456789abcdefABCDEF")] || !*token)
        return false;
    *word = (uint32_t)strtoul(token, NULL, 16);
    return true;
}

static bool build_line(hs_stream_file *file, char *line, const char *where, hs_error *err) {
    line[strcspn(line, "#")] = 0;
    char *token[5], *rest = line, *next;
    int tokens = 0;
    while (tokens < 5 && (next = strsep(&rest, " \t\r")) != NULL)
        if (*next) token[tokens++] = next;
    if (tokens == 0) return true;
    hs_packet *packet = file->packets ? &file->packet[file->packets - 1] : NULL;
    if (strcmp(token[0], "packet") == 0) {
        uint32_t view;
        if (tokens != 2 || !hs_number_parse(token[1], &view) || view > 65535)
            return hs_fail(err, HS_EXIT_STREAM, "%.300s: should be: packet VIEW, 0 to 65535",
                           where);
        if (packet && packet->words == 0)
            return hs_fail(err, HS_EXIT_STREAM, "%.300s: the packet before has no records", where);
        if (!hs_stream_file_grow(file, &packet, err)) return false;
        packet->view = view;
        return true;
    }
    if (!packet)
        return hs_fail(err, HS_EXIT_STREAM, "%.300s: no packet yet; begin with `packet 0`", where);
    if (tokens != 4)
        return hs_fail(err, HS_EXIT_STREAM, "%.300s: %s words; a record has 4", where,
                       tokens > 4 ? "too many" : "too few");
    uint32_t record[4];
    for (int i = 0; i < 4; i++)
        if (!parse_word(token[i], packet, record, i))
            return hs_fail(err, HS_EXIT_STREAM,
                           "%.300s: \"%.40s\" is no word; write 8 hexadecimal digits, a number "
                           "with a decimal point, or crc",
                           where, token[i]);
    return hs_packet_append(packet, record, 1, err);
}

bool hs_stream_file_build(hs_stream_file *file, char *text, size_t size, const char *name,
                          hs_error *err) {
    *file = (hs_stream_file){0};
    char *rest = text, *line;
    bool good = hs_text_check(text, size, name, HS_EXIT_STREAM, err);
    for (unsigned number = 1; good && (line = strsep(&rest, "\n")) != NULL; number++) {
        char where[320];
        snprintf(where, sizeof where, "%.280s:%u", name, number);
        good = build_line(file, line, where, err);
    }
    if (good && (file->packets == 0 || file->packet[file->packets - 1].words == 0))
        good = hs_fail(err, HS_EXIT_STREAM, "%.300s: %s", name,
                       file->packets ? "the last packet has no records"
                                     : "no packets; begin with `packet 0`");
    if (!good) hs_stream_file_free(file);
    return good;
}
