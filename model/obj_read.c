/* SPDX-License-Identifier: Apache-2.0
 *
 * Reads OBJ text line by line into a face list, from which hs_mesh_build makes the mesh. A logical
 * line is copied without its comment, with continued lines joined; then it is split at blanks.
 * The arrays grow with what was read, never from a number in the file.
 */
#define _GNU_SOURCE
#include <locale.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "obj.h"
#include "obj_tags.h"

/* So that line numbers, counts and indices of a file all fit 32 bits. */
#define SIZE_LIMIT ((size_t)1 << 31)

typedef struct reader {
    const char *name, *text;
    size_t size, at;   /* bytes of the text, and the next to be read */
    uint32_t line;     /* where the current logical line begins, from 1 */
    uint32_t end_line; /* the physical line that is read next */
    char *buffer;      /* the logical line, ends with a zero byte */
    char *rest;        /* what is left of it */
    locale_t c_locale;

    uint32_t vertices, faces, corners;
    float *position; /* 4 per vertex */
    uint32_t *vertex_line, *face_line, *sides, *corner;

    hs_obj_tags tags;
    bool round_sharpness;

    hs_obj_notes notes;
    hs_error *err;
} reader;

/* --- Messages and memory --------------------------------------------------------------------- */

__attribute__((format(printf, 2, 3))) static bool fail_here(reader *r, const char *format, ...) {
    char text[400];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    return hs_fail(r->err, HS_EXIT_MESH, "%.180s:%u: %s", r->name, r->line, text);
}

static bool exhausted(reader *r) {
    return hs_fail(r->err, HS_EXIT_INTERNAL, "%.180s: out of memory; use a smaller mesh", r->name);
}

typedef struct quote {
    char text[32];
} quote;

/* A word of the file, fit for a message: cut, and without control characters. */
static quote quoted(const char *word) {
    quote q;
    size_t n = 0;
    for (; n < sizeof q.text - 1 && word[n] != 0; n++)
        q.text[n] = word[n] >= ' ' && word[n] <= '~' ? word[n] : '?';
    q.text[n] = 0;
    return q;
}

static void note(reader *r, hs_obj_note *entry) {
    if (entry->count++ == 0) entry->line = r->line;
}

/* Makes room for entry number count of an array that has always grown through here: its capacity
 * is 64 or the next power of two. Returns the array, or NULL (and the old one stays). */
static void *room_for(void *array, uint32_t count, size_t entry_size) {
    if (count != 0 && (count < 64 || (count & (count - 1)) != 0)) return array;
    return realloc(array, (count == 0 ? 64 : 2 * (size_t)count) * entry_size);
}

static bool append_number(reader *r, uint32_t **array, uint32_t count, uint32_t number) {
    uint32_t *grown = room_for(*array, count, sizeof **array);
    if (grown == NULL) return exhausted(r);
    *array = grown;
    grown[count] = number;
    return true;
}

static bool append_position(reader *r, const float position[4]) {
    float *grown = room_for(r->position, r->vertices, 4 * sizeof *grown);
    if (grown == NULL) return exhausted(r);
    r->position = grown;
    memcpy(grown + 4 * (size_t)r->vertices, position, 4 * sizeof *grown);
    return true;
}

/* --- Lines and words ------------------------------------------------------------------------- */

/* Copies the next logical line into the buffer; false at the end of the text. Lines end with LF,
 * CR LF or CR. A backslash at the end of a comment continues nothing. */
static bool take_line(reader *r) {
    if (r->at == r->size) return false;
    r->line = r->end_line;
    size_t length = 0;
    bool comment = false;
    while (r->at < r->size) {
        char c = r->text[r->at++];
        if (c == '\r' && r->at < r->size && r->text[r->at] == '\n') c = r->text[r->at++];
        if (c == '\n' || c == '\r') {
            r->end_line++;
            if (comment || length == 0 || r->buffer[length - 1] != '\\') break;
            r->buffer[length - 1] = ' ';
            continue;
        }
        comment = comment || c == '#';
        if (!comment) r->buffer[length++] = c;
    }
    r->buffer[length] = 0;
    r->rest = r->buffer;
    return true;
}

/* The next word of the line; empty if there is none. */
static char *take_word(reader *r) {
    static const char blanks[] = " \t\v\f";
    char *word = r->rest + strspn(r->rest, blanks);
    char *end = word + strcspn(word, blanks);
    r->rest = *end != 0 ? end + 1 : end;
    *end = 0;
    return word;
}

/* --- v --------------------------------------------------------------------------------------- */

static bool read_vertex(reader *r) {
    float position[4] = {0, 0, 0, 1};
    uint32_t count = 0;
    for (const char *word; *(word = take_word(r)) != 0; count++) {
        char *end;
        float number = strtof_l(word, &end, r->c_locale);
        if (*end != 0)
            return fail_here(r, "'%s' is not a number; a vertex is 'v x y z' or 'v x y z w'",
                             quoted(word).text);
        if (count < 4) position[count] = number;
    }
    if (count < 3)
        return fail_here(r, "the vertex has %u coordinate%s; a vertex is 'v x y z' or 'v x y z w'",
                         count, count == 1 ? "" : "s");
    if (count > 4) position[3] = 1;
    if (!append_position(r, position) || !append_number(r, &r->vertex_line, r->vertices, r->line))
        return false;
    r->vertices++;
    return true;
}

/* --- f --------------------------------------------------------------------------------------- */

/* Reads an integer and moves *text behind it. Magnitudes beyond 32 bits stay beyond them. */
static bool take_integer(const char **text, int64_t *number) {
    const char *at = *text;
    bool negative = *at == '-';
    at += negative;
    if (*at < '0' || *at > '9') return false;
    int64_t magnitude = 0;
    for (; *at >= '0' && *at <= '9'; at++)
        if (magnitude <= UINT32_MAX) magnitude = 10 * magnitude + (*at - '0');
    *number = negative ? -magnitude : magnitude;
    *text = at;
    return true;
}

/* v, v/vt, v//vn or v/vt/vn; vt and vn must be integers or missing. */
static bool read_corner(reader *r, const char *word) {
    const char *at = word;
    int64_t index, other;
    bool good = take_integer(&at, &index);
    for (int slashes = 0; good && slashes < 2 && *at == '/'; slashes++) {
        at++;
        good = *at == '/' || *at == 0 || take_integer(&at, &other);
    }
    if (!good || *at != 0)
        return fail_here(r,
                         "'%s' is not a corner of a face; write integers, as in 'f 1 2 3', "
                         "'f 1/1 2/2 3/3' or 'f 1//1 2//2 3//3'",
                         quoted(word).text);
    if (index == 0)
        return fail_here(r, "vertex index 0; the first vertex is 1, the latest one is -1");
    if (index < 0 && -index > r->vertices)
        return fail_here(r, "vertex index %s, but only %u vertices come before; correct the index",
                         quoted(word).text, r->vertices);
    if (index > UINT32_MAX)
        return fail_here(r, "vertex index %s is out of range; correct the index",
                         quoted(word).text);
    /* A positive index may name a vertex that follows; hs_mesh_build checks those. */
    uint32_t corner = (uint32_t)(index > 0 ? index - 1 : r->vertices + index);
    if (!append_number(r, &r->corner, r->corners, corner)) return false;
    r->corners++;
    return true;
}

static bool read_face(reader *r) {
    uint32_t sides = 0;
    for (const char *word; *(word = take_word(r)) != 0; sides++)
        if (!read_corner(r, word)) return false;
    if (!append_number(r, &r->sides, r->faces, sides) ||
        !append_number(r, &r->face_line, r->faces, r->line))
        return false;
    r->faces++;
    return true;
}

/* --- t --------------------------------------------------------------------------------------- */

static bool read_tags(reader *r) {
    char why[200];
    switch (hs_obj_tags_read(&r->tags, r->rest, r->line, r->c_locale, why, sizeof why)) {
    case HS_TAGS_READ:
        return true;
    case HS_TAGS_OTHER:
        note(r, &r->notes.tags);
        return true;
    case HS_TAGS_WRONG:
        return fail_here(r, "%s", why);
    default:
        return exhausted(r);
    }
}

/* --- The file -------------------------------------------------------------------------------- */

static bool is_skipped(const char *keyword) {
    static const char *const skipped[] = {"vt", "vn",     "vp",     "g", "o",
                                          "s",  "usemtl", "mtllib", "l", "p"};
    for (size_t i = 0; i < sizeof skipped / sizeof *skipped; i++)
        if (strcmp(keyword, skipped[i]) == 0) return true;
    return false;
}

static bool read_line(reader *r) {
    const char *keyword = take_word(r);
    if (strcmp(keyword, "v") == 0) return read_vertex(r);
    if (strcmp(keyword, "f") == 0) return read_face(r);
    if (strcmp(keyword, "t") == 0) return read_tags(r);
    if (*keyword != 0 && !is_skipped(keyword)) {
        note(r, &r->notes.unknown);
        if (r->notes.unknown.count == 1)
            snprintf(r->notes.unknown_word, sizeof r->notes.unknown_word, "%s",
                     quoted(keyword).text);
    }
    return true;
}

static bool check_text(reader *r) {
    if (r->size >= SIZE_LIMIT)
        return hs_fail(r->err, HS_EXIT_MESH, "%.180s: has %zu bytes; fewer than %zu are supported",
                       r->name, r->size, SIZE_LIMIT);
    const char *zero = r->size != 0 ? memchr(r->text, 0, r->size) : NULL;
    if (zero == NULL) return true;
    for (const char *c = r->text; c < zero; c++)
        r->line += *c == '\n';
    return fail_here(r, "a zero byte: this is no OBJ file, or not in ASCII or UTF-8; export the "
                        "mesh as OBJ text");
}

/* Finds the first vertex that no face uses; hs_mesh_build has counted them. */
static bool note_unused(reader *r, uint32_t dropped) {
    if (dropped == 0) return true;
    uint8_t *used = calloc(r->vertices, 1);
    if (used == NULL) return exhausted(r);
    for (uint32_t i = 0; i < r->corners; i++)
        used[r->corner[i]] = 1;
    const uint8_t *unused = memchr(used, 0, r->vertices);
    r->notes.unused = (hs_obj_note){dropped, r->vertex_line[unused - used]};
    free(used);
    return true;
}

static bool make_mesh(reader *r, hs_mesh *mesh) {
    hs_soup soup = {.name = r->name,
                    .vertices = r->vertices,
                    .position = r->position,
                    .faces = r->faces,
                    .sides = r->sides,
                    .corner = r->corner,
                    .vertex_line = r->vertex_line,
                    .face_line = r->face_line,
                    .tags = r->tags.count,
                    .tag = r->tags.tag,
                    .round_sharpness = r->round_sharpness};
    uint32_t dropped;
    if (!hs_mesh_build(mesh, &soup, &dropped, r->err)) return false;
    if (note_unused(r, dropped) &&
        (hs_obj_tags_repeated(&r->tags, &r->notes.repeated.count, &r->notes.repeated.line) ||
         exhausted(r)))
        return true;
    hs_mesh_free(mesh);
    return false;
}

static bool read_text(reader *r, hs_mesh *mesh) {
    if (!check_text(r)) return false;
    r->buffer = malloc(r->size + 1);
    r->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (r->buffer == NULL || r->c_locale == (locale_t)0) return exhausted(r);
    static const char byte_order_mark[] = "\xef\xbb\xbf";
    if (r->size >= 3 && memcmp(r->text, byte_order_mark, 3) == 0) r->at = 3;
    while (take_line(r))
        if (!read_line(r)) return false;
    return make_mesh(r, mesh);
}

bool hs_obj_parse(hs_mesh *mesh, const char *name, const char *text, size_t size,
                  bool round_sharpness, hs_obj_notes *notes, hs_error *err) {
    memset(mesh, 0, sizeof *mesh);
    reader r = {.name = name,
                .text = text,
                .size = size,
                .line = 1,
                .end_line = 1,
                .round_sharpness = round_sharpness,
                .err = err};
    bool good = read_text(&r, mesh);
    if (notes != NULL) *notes = r.notes;
    if (r.c_locale != (locale_t)0) freelocale(r.c_locale);
    free(r.buffer);
    free(r.position);
    free(r.vertex_line);
    free(r.face_line);
    free(r.sides);
    free(r.corner);
    hs_obj_tags_free(&r.tags);
    return good;
}

bool hs_obj_read(hs_mesh *mesh, const char *path, bool round_sharpness, hs_obj_notes *notes,
                 hs_error *err) {
    uint8_t *bytes;
    size_t size;
    memset(mesh, 0, sizeof *mesh);
    if (notes != NULL) memset(notes, 0, sizeof *notes);
    if (!hs_file_read(path, SIZE_LIMIT - 1, &bytes, &size, err)) return false;
    bool good = hs_obj_parse(mesh, path, (const char *)bytes, size, round_sharpness, notes, err);
    free(bytes);
    return good;
}

bool hs_obj_note_text(const hs_obj_notes *notes, const char *name, uint32_t index, char *text,
                      size_t size) {
    char suffix[64];
    snprintf(suffix, sizeof suffix, " (the first is '%s')", notes->unknown_word);
    const struct {
        const hs_obj_note *note;
        const char *one, *many, *suffix;
    } kinds[] = {
        {&notes->unused, "vertex that no face uses was dropped",
         "vertices that no face uses were dropped", ""},
        {&notes->repeated, "tag names an edge or vertex again; the last one counts",
         "tags name an edge or vertex again; the last one counts", ""},
        {&notes->tags, "tag ('t' line) is neither crease nor corner, and was ignored",
         "tags ('t' lines) are neither crease nor corner, and were ignored", ""},
        {&notes->unknown, "line with an unknown keyword was ignored",
         "lines with unknown keywords were ignored", suffix},
    };
    for (size_t i = 0; i < sizeof kinds / sizeof *kinds; i++) {
        const hs_obj_note *entry = kinds[i].note;
        if (entry->count == 0 || index-- != 0) continue;
        snprintf(text, size, "%.180s:%u: %u %s%s", name, entry->line, entry->count,
                 entry->count == 1 ? kinds[i].one : kinds[i].many, kinds[i].suffix);
        return true;
    }
    return false;
}
