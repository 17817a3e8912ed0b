/* SPDX-License-Identifier: Apache-2.0
 *
 * Texts: a mesh, views, a trace, a stream as text, an exploration's journal, what is expected of a
 * trace. A text that is refused leaves nothing behind but an error; of one that is taken, writing
 * what was read and reading it again gives the same.
 */
#include "fuzz.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "compare.h"
#include "explore.h"
#include "file.h"
#include "obj.h"
#include "trace.h"
#include "view.h"

/* What is behind a zero byte would have been passed over. */
static void claim_whole(const uint8_t *bytes, size_t size) {
    fuzz_claim(size == 0 || !memchr(bytes, 0, size), "taken with a zero byte");
}

/* --- obj: a mesh --------------------------------------------------------------------------------
 */

/* What mesh.h promises. */
static void claim_mesh(const hs_mesh *m) {
    fuzz_claim(m->faces > 0 && m->vertices > 0, "an empty mesh");
    fuzz_claim(m->first[0] == 0 && m->first[m->faces] == m->halfedges, "first");
    uint32_t *valence = calloc(m->vertices, sizeof *valence);
    fuzz_claim(valence != NULL, "no memory");
    for (uint32_t f = 0; f < m->faces; f++) {
        const uint32_t sides = hs_sides(m, f);
        fuzz_claim(sides >= HS_MIN_SIDES && sides <= HS_MAX_SIDES, "%u sides", sides);
        fuzz_claim(m->forced[f] == 0, "forced");
        for (uint32_t h = m->first[f]; h < m->first[f + 1]; h++) {
            const uint32_t v = m->origin[h], t = m->twin[h];
            fuzz_claim(v < m->vertices && m->face[h] == f, "half-edge %u", h);
            valence[v]++;
            if (t == HS_BORDER) continue;
            fuzz_claim(t < m->halfedges && t != h && m->twin[t] == h, "twin of %u", h);
            fuzz_claim(m->origin[t] == m->origin[hs_next(m, h)] &&
                           m->origin[hs_next(m, t)] == m->origin[h],
                       "twins %u, %u", h, t);
            fuzz_claim(!m->sharpness || m->sharpness[h] == m->sharpness[t], "sharpness of %u", h);
        }
    }
    for (uint32_t v = 0; v < m->vertices; v++) {
        fuzz_claim(valence[v] >= 1 && valence[v] <= HS_MAX_VALENCE, "valence %u", valence[v]);
        for (int i = 0; i < 4; i++)
            fuzz_claim(isfinite(m->position[4 * (size_t)v + (size_t)i]), "vertex %u", v);
    }
    free(valence);
}

static bool same_array(const void *a, const void *b, size_t size) {
    return (a == NULL && b == NULL) || (a && b && memcmp(a, b, size) == 0);
}

static void claim_same_mesh(const hs_mesh *a, const hs_mesh *b) {
    fuzz_claim(a->vertices == b->vertices && a->faces == b->faces && a->halfedges == b->halfedges,
               "another mesh");
    fuzz_claim(same_array(a->position, b->position, 16 * (size_t)a->vertices), "other positions");
    fuzz_claim(same_array(a->first, b->first, 4 * ((size_t)a->faces + 1)), "other faces");
    fuzz_claim(same_array(a->origin, b->origin, 4 * (size_t)a->halfedges), "other corners");
    fuzz_claim(same_array(a->twin, b->twin, 4 * (size_t)a->halfedges), "other twins");
    fuzz_claim(same_array(a->vertex_sharpness, b->vertex_sharpness, a->vertices),
               "other sharp vertices");
    fuzz_claim(same_array(a->sharpness, b->sharpness, a->halfedges), "other sharp edges");
}

static bool parse_obj(hs_mesh *mesh, const uint8_t *bytes, size_t size, bool round) {
    hs_obj_notes notes;
    hs_error err = {0};
    char line[600], *text = fuzz_copy(bytes, size);
    const bool good = hs_obj_parse(mesh, "fuzz.obj", text, size, round, &notes, &err);
    free(text);
    for (uint32_t i = 0; hs_obj_note_text(&notes, "fuzz.obj", i, line, sizeof line); i++)
        fuzz_claim(strncmp(line, "fuzz.obj:", 9) == 0, "a note without a place: %s", line);
    if (good) {
        claim_mesh(mesh);
    } else {
        fuzz_claim_error(&err, HS_EXIT_MESH, "fuzz.obj:");
        fuzz_claim(!mesh->position && !mesh->first && !mesh->faces, "a mesh behind a failure");
    }
    return good;
}

static fuzz_verdict run_obj(const uint8_t *bytes, size_t size) {
    hs_mesh mesh, rounded, again;
    hs_error err = {0};
    const bool good = parse_obj(&mesh, bytes, size, false);
    const bool round = parse_obj(&rounded, bytes, size, true);
    fuzz_claim(round || !good, "refused only where sharpness may be rounded");
    if (good) claim_same_mesh(&mesh, &rounded);
    if (round) {
        claim_whole(bytes, size);
        const char *path = fuzz_path("mesh.obj");
        if (!hs_obj_write_mesh(path, &rounded, &err) ||
            !hs_obj_read(&again, path, false, NULL, &err))
            fuzz_claim(false, "written, but not read: %s", err.text);
        claim_same_mesh(&rounded, &again);
        hs_mesh_free(&again);
    }
    hs_mesh_free(&mesh);
    hs_mesh_free(&rounded);
    return good ? FUZZ_TAKEN : FUZZ_REFUSED;
}

const fuzz_target fuzz_obj = {.name = "obj", .longest = 2048, .run = run_obj};

/* --- views --------------------------------------------------------------------------------------
 */

static fuzz_verdict run_views(const uint8_t *bytes, size_t size) {
    hs_views views, again;
    hs_error err = {0};
    char *text = fuzz_copy(bytes, size);
    const bool good = hs_views_parse(&views, "fuzz.views", text, size, 1.5, &err);
    free(text);
    if (!good) {
        fuzz_claim_error(&err, HS_EXIT_VIEWS, "fuzz.views:");
        fuzz_claim(views.count == 0 && !views.view, "views behind a failure");
        return FUZZ_REFUSED;
    }
    claim_whole(bytes, size);
    fuzz_claim(views.count > 0, "no views");
    for (uint32_t i = 0; i < 16 * views.count; i++)
        fuzz_claim(isfinite(views.view[i / 16].matrix[i % 16]), "view %u is not finite", i / 16);
    const char *path = fuzz_path("views");
    if (!hs_views_write(&views, path, &err) || !hs_views_read(&again, path, 1, &err))
        fuzz_claim(false, "written, but not read: %s", err.text);
    fuzz_claim(again.count == views.count &&
                   memcmp(again.view, views.view, views.count * sizeof *views.view) == 0,
               "other views");
    hs_views_free(&views);
    hs_views_free(&again);
    return FUZZ_TAKEN;
}

const fuzz_target fuzz_views = {.name = "views", .longest = 1024, .run = run_views};

/* --- trace, text: packets -----------------------------------------------------------------------
 */

static void claim_same_packets(const hs_stream_file *a, const hs_stream_file *b) {
    fuzz_claim(a->packets == b->packets, "%u packets became %u", a->packets, b->packets);
    for (uint32_t i = 0; i < a->packets; i++) {
        const hs_word_comparison c = hs_compare_words(&a->packet[i], &b->packet[i]);
        fuzz_claim(a->packet[i].view == b->packet[i].view && c.different == 0,
                   "packet %u changed at word %zu", i, c.first);
    }
}

void fuzz_claim_packets(const hs_stream_file *file) {
    char *text = NULL;
    size_t size = 0;
    hs_stream_file again;
    hs_error err = {0};
    FILE *memory = open_memstream(&text, &size);
    fuzz_claim(memory != NULL, "no memory");
    hs_stream_file_show(file, memory);
    fclose(memory);
    if (!hs_stream_file_build(&again, text, size, "shown", &err))
        fuzz_claim(false, "shown, but not built: %s", err.text);
    claim_same_packets(file, &again);
    hs_stream_file_free(&again);
    free(text);

    const char *path = fuzz_path("stream.hss");
    if (!hs_stream_file_write(file, path, &err) || !hs_stream_file_read(&again, path, &err))
        fuzz_claim(false, "written, but not read: %s", err.text);
    claim_same_packets(file, &again);
    hs_stream_file_free(&again);
}

/* Meshes that are small, and no files of this machine. */
static bool has_other_mesh(const char *text) {
    static const char *const small[] = {"cube",   "cube:1", "cube:2",      "grid:1",
                                        "grid:2", "grid:3", "tetrahedron", "torus:5"};
    for (const char *at = text; (at = strstr(at, "mesh")) != NULL; at += 4) {
        const char *name = at + 4 + strspn(at + 4, " \t\r");
        const size_t length = strcspn(name, " \t\r\n#");
        bool known = length == 0 || strncmp(name, "shape:", 6) == 0;
        if (length > 6 && known) {
            known = false;
            for (size_t i = 0; i < sizeof small / sizeof *small; i++)
                known = known || (strlen(small[i]) == length - 6 &&
                                  strncmp(small[i], name + 6, length - 6) == 0);
        }
        if (!known) return true;
    }
    return false;
}

static fuzz_verdict run_trace(const uint8_t *bytes, size_t size) {
    hs_trace trace;
    hs_error err = {0};
    char *text = fuzz_copy(bytes, size);
    bool good = false;
    if (!has_other_mesh(text)) {
        good = hs_trace_parse(&trace, text, size, "fuzz.txt", &err);
        if (!good) {
            const int code = err.code; /* of the line, or of the mesh that it names */
            const bool other =
                code == HS_EXIT_MESH || code == HS_EXIT_USAGE || code == HS_EXIT_FILE;
            fuzz_claim_error(&err, other ? code : HS_EXIT_STREAM, other ? "" : "fuzz.txt:");
            fuzz_claim(trace.input.packets == 0 && !trace.input.packet, "packets behind a failure");
        }
    }
    free(text);
    if (!good) return FUZZ_REFUSED;
    claim_whole(bytes, size);
    fuzz_claim(trace.input.packets > 0, "no packets");
    fuzz_claim_packets(&trace.input);
    hs_trace_free(&trace);
    return FUZZ_TAKEN;
}

const fuzz_target fuzz_trace = {.name = "trace", .longest = 2048, .run = run_trace};

static fuzz_verdict run_text(const uint8_t *bytes, size_t size) {
    hs_stream_file file;
    hs_error err = {0};
    char *text = fuzz_copy(bytes, size);
    const bool good = hs_stream_file_build(&file, text, size, "fuzz.txt", &err);
    free(text);
    if (!good) {
        fuzz_claim_error(&err, HS_EXIT_STREAM, "fuzz.txt:");
        fuzz_claim(file.packets == 0 && !file.packet, "packets behind a failure");
        return FUZZ_REFUSED;
    }
    claim_whole(bytes, size);
    fuzz_claim_packets(&file);
    hs_stream_file_free(&file);
    return FUZZ_TAKEN;
}

const fuzz_target fuzz_text = {.name = "text", .longest = 2048, .run = run_text};

/* --- journal: an exploration's points -----------------------------------------------------------
 */

enum { POINTS = 3 };
static const uint32_t FINGERPRINT = 0x01234567;

static void write_file(const char *path, const void *bytes, size_t size) {
    FILE *file = fopen(path, "wb");
    fuzz_claim(file && fwrite(bytes, 1, size, file) == size && fclose(file) == 0, "%s", path);
}

/* What a journal's lines may look like: numbers without signs and blanks, as many as there are
 * columns. */
static void claim_journal(const char *path, uint32_t *lines) {
    uint8_t *bytes;
    size_t size;
    hs_error err;
    if (!hs_file_read(path, 1 << 20, &bytes, &size, &err)) fuzz_claim(false, "%s", err.text);
    const char *at = strchr((char *)bytes, '\n');
    fuzz_claim(at != NULL, "no first line");
    for (at++, *lines = 0; *at; at++, (*lines)++)
        for (uint32_t c = 0; c < HS_EXPLORE_COLUMNS; c++) {
            const size_t digits = strspn(at, "0123456789");
            const char end = c + 1 < HS_EXPLORE_COLUMNS ? ',' : '\n';
            fuzz_claim(digits > 0 && at[digits] == end, "line %u, column %u", *lines + 2, c);
            at += digits + (end == ',');
        }
    fuzz_claim((size_t)(at - (char *)bytes) == size, "a zero byte");
    free(bytes);
}

static void report(const hs_explore_space *space, const hs_explore_row *row) {
    const hs_explore_result result = {.space = space, .row = row, .mesh = "fuzz", .clock = 500};
    char *text = NULL;
    size_t size = 0;
    hs_error err;
    FILE *memory = open_memstream(&text, &size);
    fuzz_claim(memory != NULL, "no memory");
    hs_explore_print(&result, memory);
    fclose(memory);
    free(text);
    fuzz_claim(hs_explore_write_csv(&result, fuzz_path("points.csv"), &err) &&
                   hs_explore_write_json(&result, fuzz_path("points.json"), &err),
               "no report");
}

static fuzz_verdict run_journal(const uint8_t *bytes, size_t size) {
    hs_explore_space space;
    hs_explore_space_start(&space, POINTS);
    hs_explore_row row[POINTS] = {0}, again[POINTS] = {0};
    hs_explore_journal journal;
    hs_error err = {0};
    const char *path = fuzz_path("shard-0-of-1.csv"), *folder = fuzz_path("");
    write_file(path, bytes, size);
    if (!hs_explore_journal_open(&journal, folder, 0, 1, FINGERPRINT, row, POINTS, &err)) {
        fuzz_claim_error(&err, HS_EXIT_USAGE, folder);
        unlink(path);
        return FUZZ_REFUSED;
    }
    uint32_t lines, more, done = 0;
    claim_journal(path, &lines);
    for (uint64_t p = 0; p < POINTS; p++) {
        done += row[p].done;
        if (row[p].done) fuzz_claim(row[p].value[HS_EXPLORE_POINT] == p, "another point");
    }
    fuzz_claim(done <= lines && (done > 0) == (lines > 0), "%u points of %u lines", done, lines);
    if (done == POINTS) report(&space, row);
    /* It goes on behind the last whole line. */
    row[1] = (hs_explore_row){.done = true, .value = {1, 0, 12, UINT64_MAX}};
    if (!hs_explore_journal_add(&journal, &row[1], &err)) fuzz_claim(false, "%s", err.text);
    hs_explore_journal_close(&journal);
    claim_journal(path, &more);
    fuzz_claim(more == lines + 1, "%u lines and one are %u", lines, more);
    if (!hs_explore_journal_open(&journal, folder, 0, 1, FINGERPRINT, again, POINTS, &err))
        fuzz_claim(false, "not opened again: %s", err.text);
    hs_explore_journal_close(&journal);
    fuzz_claim(memcmp(row, again, sizeof row) == 0, "other points");
    unlink(path);
    return done ? FUZZ_TAKEN : FUZZ_REFUSED;
}

const fuzz_target fuzz_journal = {.name = "journal", .longest = 2048, .run = run_journal};

/* --- expected: JSON -----------------------------------------------------------------------------
 */

static const char ACTUAL[] =
    "{\"stream\": 2, \"views\": [{\"view\": 0, \"status\": \"OK\", \"position\": null},"
    " {\"view\": 1, \"status\": \"BAD_CRC\", \"position\": 159}]}";

static fuzz_verdict run_expected(const uint8_t *bytes, size_t size) {
    hs_error err = {0};
    json_t *actual = json_loads(ACTUAL, 0, NULL);
    char *text = fuzz_copy(bytes, size);
    json_t *expected = hs_trace_expected_parse(text, size, "fuzz.json", &err);
    free(text);
    bool good = expected != NULL;
    if (!good) {
        fuzz_claim_error(&err, HS_EXIT_STREAM, "fuzz.json:");
    } else {
        good = hs_trace_expected_check(expected, actual, "fuzz", &err);
        if (!good) fuzz_claim_error(&err, HS_EXIT_DIFFERENT, "fuzz");
    }
    if (good) {
        json_t *views = json_object_get(expected, "views");
        const char *const status[] = {"OK", "BAD_CRC"};
        fuzz_claim(json_integer_value(json_object_get(expected, "stream")) == 2,
                   "taken with another version");
        fuzz_claim(json_array_size(views) == 2, "taken with other views");
        for (size_t i = 0; i < 2; i++) {
            json_t *view = json_array_get(views, i), *position = json_object_get(view, "position");
            const char *says = json_string_value(json_object_get(view, "status"));
            fuzz_claim(json_integer_value(json_object_get(view, "view")) == (json_int_t)i && says &&
                           strcmp(says, status[i]) == 0 &&
                           (i ? json_integer_value(position) == 159 : json_is_null(position)),
                       "taken with another view %zu", i);
        }
    }
    json_decref(expected);
    json_decref(actual);
    return good ? FUZZ_TAKEN : FUZZ_REFUSED;
}

const fuzz_target fuzz_expected = {.name = "expected", .longest = 1024, .run = run_expected};
