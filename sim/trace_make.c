/* SPDX-License-Identifier: Apache-2.0
 *
 * From trace.txt to packets.
 */
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "mesh_source.h"
#include "options.h"
#include "surface_options.h"
#include "trace.h"

static const size_t TEXT_LIMIT = 1 << 20;

/* --- trace.txt ----------------------------------------------------------------------------------
 */

/* The statements read so far. */
typedef struct compiler {
    hs_trace *trace;
    hs_mesh mesh;
    hs_settings settings;
    const char *where; /* FILE:LINE */
    hs_error *err;
} compiler;

static bool fail(const compiler *c, const char *what) {
    return hs_fail(c->err, HS_EXIT_STREAM, "%.300s: %s", c->where, what);
}

/* A number in the first word of text, 0x... allowed, and nothing behind it but *rest. */
static bool take_number(const compiler *c, char **rest, uint32_t most, uint32_t *number) {
    char *word, *end;
    do
        word = strsep(rest, " \t\r");
    while (word && !*word);
    if (!word) return fail(c, "a number is missing");
    const unsigned long long value = strtoull(word, &end, 0);
    if (*end || *word == '-' || value > most)
        return hs_fail(c->err, HS_EXIT_STREAM, "%.300s: \"%.40s\" should be a number up to %u",
                       c->where, word, most);
    *number = (uint32_t)value;
    return true;
}

static hs_packet *latest(const compiler *c) {
    const hs_stream_file *input = &c->trace->input;
    return input->packets ? &input->packet[input->packets - 1] : NULL;
}

static bool add_view(compiler *c, char *rest) {
    float matrix[16];
    for (int i = 0; i < 16; i++) {
        char *end;
        matrix[i] = strtof(rest, &end);
        if (end == rest) return fail(c, "a matrix has 16 numbers");
        rest = end;
    }
    if (rest[strspn(rest, " \t\r")]) return fail(c, "a matrix has 16 numbers, no more");
    hs_packet *packet;
    const uint32_t view = c->trace->input.packets;
    return hs_stream_file_grow(&c->trace->input, &packet, c->err) &&
           hs_packet_encode(packet, view, &c->mesh, matrix, &c->settings, c->err);
}

/* word, crc, cut: what spoils the packet of the view before. */
static bool change_packet(compiler *c, const char *keyword, char **rest) {
    hs_packet *packet = latest(c);
    uint32_t position, value;
    if (!packet) return fail(c, "no view before it");
    if (strcmp(keyword, "crc") == 0) {
        packet->word[packet->words - 1] = hs_packet_crc(packet);
        return true;
    }
    const uint32_t last = (uint32_t)packet->words - 1;
    if (!take_number(c, rest, last, &position)) return false;
    if (strcmp(keyword, "word") == 0) {
        if (!take_number(c, rest, UINT32_MAX, &value)) return false;
        packet->word[position] = value;
        return true;
    }
    if (position % 4 || position == 0) return fail(c, "cut needs a positive multiple of 4");
    packet->words = position;
    return true;
}

static bool set_depth(compiler *c, char **rest, uint8_t *depth) {
    uint32_t value;
    if (!take_number(c, rest, HS_MAX_DEPTH, &value)) return false;
    *depth = (uint8_t)value;
    return true;
}

static bool set_edge(compiler *c, char **rest) {
    uint32_t edge, width, height;
    if (!take_number(c, rest, UINT16_MAX, &edge) || !take_number(c, rest, UINT16_MAX, &width) ||
        !take_number(c, rest, UINT16_MAX, &height))
        return false;
    c->settings.min_edge = (uint16_t)edge;
    c->settings.width = (uint16_t)width;
    c->settings.height = (uint16_t)height;
    return true;
}

static bool set_run(compiler *c, const char *keyword, char **rest) {
    hs_trace *trace = c->trace;
    if (trace->input.packets) return fail(c, "has to stand before the first view");
    const uint32_t most = 1u << HS_INDEX_BITS;
    if (strcmp(keyword, "mesh") == 0) {
        if (c->mesh.faces) return fail(c, "a second mesh; a trace has one");
        return hs_mesh_open(&c->mesh, *rest + strspn(*rest, " \t"), false, true, c->err);
    }
    if (strcmp(keyword, "limit-vertices") == 0)
        return take_number(c, rest, most, &trace->limits.vertices);
    if (strcmp(keyword, "limit-quads") == 0)
        return take_number(c, rest, most, &trace->limits.quads);
    uint32_t in, out;
    if (!take_number(c, rest, 95, &in) || !take_number(c, rest, 95, &out) ||
        !take_number(c, rest, UINT32_MAX, &trace->stalls.seed))
        return false;
    trace->stalls.input = (uint8_t)in;
    trace->stalls.output = (uint8_t)out;
    return true;
}

static bool compile_line(compiler *c, char *line) {
    static const char *const keywords[] = {
        "mesh",   "limit-vertices", "limit-quads", "stalls", "front", "silhouette",
        "guard",  "uniform",        "boundary",    "limit",  "edge",  "force",
        "matrix", "word",           "crc",         "cut",    NULL};
    enum {
        MESH,
        VERTICES,
        QUADS,
        STALLS,
        FRONT,
        SILHOUETTE,
        GUARD,
        UNIFORM,
        BOUNDARY,
        LIMIT,
        EDGE,
        FORCE,
        MATRIX
    };
    line[strcspn(line, "#\r")] = 0;
    line += strspn(line, " \t");
    size_t length = strlen(line);
    while (length && strchr(" \t", line[length - 1]))
        line[--length] = 0;
    if (!length) return true;
    char *rest = line, *keyword = strsep(&rest, " \t"), none[1] = "";
    if (!rest) rest = none;
    int which = 0;
    while (keywords[which] && strcmp(keyword, keywords[which]) != 0)
        which++;
    uint32_t flag;
    if (!keywords[which]) {
        const char *nearest = hs_nearest(keyword, keywords);
        return hs_fail(c->err, HS_EXIT_STREAM, "%.300s: no statement \"%.40s\"%s%s%s", c->where,
                       keyword, nearest ? "; did you mean \"" : "; docs/command-line.md has them",
                       nearest ? nearest : "", nearest ? "\"?" : "");
    }
    if (which > MESH && c->mesh.faces == 0) return fail(c, "a trace begins with `mesh SOURCE`");
    switch (which) {
    case MESH:
    case VERTICES:
    case QUADS:
    case STALLS:
        return set_run(c, keyword, &rest);
    case FRONT:
        return set_depth(c, &rest, &c->settings.front_depth);
    case SILHOUETTE:
        return set_depth(c, &rest, &c->settings.silhouette_depth);
    case GUARD:
        if (!take_number(c, &rest, 1, &flag)) return false;
        c->settings.guard = flag;
        return true;
    case UNIFORM:
        c->settings.uniform = strcmp(rest, "no") != 0;
        c->settings.uniform_depth = 0;
        return !c->settings.uniform || set_depth(c, &rest, &c->settings.uniform_depth);
    case BOUNDARY:
        return hs_boundary_parse(rest, &c->settings.boundary) ||
               fail(c, "boundary should be kept, smooth or edge-only");
    case LIMIT:
        if (!take_number(c, &rest, 1, &flag)) return false;
        c->settings.limit = flag;
        return true;
    case EDGE:
        return set_edge(c, &rest);
    case FORCE:
        return hs_mesh_force_line(&c->mesh, rest, c->where, c->err);
    case MATRIX:
        return add_view(c, rest);
    default:
        return change_packet(c, keyword, &rest);
    }
}

bool hs_trace_parse(hs_trace *trace, char *text, size_t size, const char *name, hs_error *err) {
    *trace = (hs_trace){.limits = HS_DEFAULT_LIMITS};
    char where[320];
    compiler c = {.trace = trace,
                  .settings = {.front_depth = 4,
                               .silhouette_depth = 8,
                               .guard = true,
                               .boundary = HS_BOUNDARY_SMOOTH},
                  .where = where,
                  .err = err};
    char *rest = text, *line;
    bool good = hs_text_check(text, size, name, HS_EXIT_STREAM, err);
    for (unsigned number = 1; good && (line = strsep(&rest, "\n")) != NULL; number++) {
        snprintf(where, sizeof where, "%.280s:%u", name, number);
        good = compile_line(&c, line);
    }
    if (good && trace->input.packets == 0)
        good = hs_fail(err, HS_EXIT_STREAM, "%.300s: no views; add `matrix` lines", name);
    hs_mesh_free(&c.mesh);
    if (!good) hs_trace_free(trace);
    return good;
}

bool hs_trace_compile(hs_trace *trace, const char *folder, hs_error *err) {
    *trace = (hs_trace){0};
    char path[4096];
    snprintf(path, sizeof path, "%s/trace.txt", folder);
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(path, TEXT_LIMIT, &bytes, &size, err)) return false;
    const bool good = hs_trace_parse(trace, (char *)bytes, size, path, err);
    free(bytes);
    return good;
}

void hs_trace_free(hs_trace *trace) {
    hs_stream_file_free(&trace->input);
    *trace = (hs_trace){0};
}
