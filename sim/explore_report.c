/* SPDX-License-Identifier: Apache-2.0 */
#include <inttypes.h>
#include <stdlib.h>
#include <string.h>

#include "explore.h"
#include "json_file.h"
#include "terminal.h"

/* --- What follows from a row --------------------------------------------------------------------
 */
static double ratio(uint64_t a, uint64_t b) {
    return b ? (double)a / (double)b : 0;
}

static double per_face(const hs_explore_row *row, uint32_t column) {
    return ratio(row->value[column], row->value[HS_EXPLORE_FACES]);
}

static double bytes_per_face(const hs_explore_row *row, uint32_t column) {
    return per_face(row, column) / 8;
}

/* Of all views of the architecture whose first point this is. */
static uint64_t stream_cycles(const hs_explore_result *r, uint64_t first) {
    if (r->row[first].value[HS_EXPLORE_STREAM]) return r->row[first].value[HS_EXPLORE_STREAM];
    uint64_t sum = 0;
    for (uint64_t p = first; p < first + r->space->views; p++)
        sum += r->row[p].value[HS_EXPLORE_CYCLES];
    return sum;
}

/* At which views leave; a view alone where they were run apart. */
static double views_per_second(const hs_explore_result *r, uint64_t point) {
    const uint64_t *v = r->row[point].value;
    const double cycles = v[HS_EXPLORE_STREAM]
                              ? (double)v[HS_EXPLORE_STREAM] / (double)r->space->views
                              : (double)v[HS_EXPLORE_CYCLES];
    return cycles > 0 ? r->clock * 1e6 / cycles : 0;
}

/* --- CSV ----------------------------------------------------------------------------------------
 */
static void write_head(const hs_explore_result *r, FILE *out) {
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
        fprintf(out, "%s,", hs_explore_name(p));
    fputs("view,status,faces,vertices,cycles,cycles_per_face,stream_cycles,bound,ratio,first_face,"
          "trailer,conflicts,memory_bits,bytes_read_per_face,bytes_written_per_face",
          out);
    if (r->clock > 0) fputs(",views_per_second", out);
    for (uint32_t s = 0; s < HS_STAGES; s++)
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
            fprintf(out, ",%s_%s", hs_stage_name(s), hs_activity_name(a));
    fputc('\n', out);
}

static void write_cycles(FILE *out, uint64_t cycles) {
    if (cycles == HS_NO_CYCLE)
        fputc(',', out);
    else
        fprintf(out, ",%" PRIu64, cycles);
}

static void write_row(const hs_explore_result *r, uint64_t point, uint64_t stream, FILE *out) {
    const hs_explore_row *row = &r->row[point];
    const uint64_t *v = row->value;
    const hs_model_config config = hs_explore_config(r->space, point);
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
        fprintf(out, "%" PRIu32 ",", hs_explore_value(&config, p));
    fprintf(out,
            "%" PRIu32 ",%s,%" PRIu64 ",%" PRIu64 ",%" PRIu64 ",%.6g,%" PRIu64 ",%" PRIu64 ",%.6g",
            hs_explore_view(r->space, point), hs_status_name((uint32_t)v[HS_EXPLORE_STATUS]),
            v[HS_EXPLORE_FACES], v[HS_EXPLORE_VERTICES], v[HS_EXPLORE_CYCLES],
            per_face(row, HS_EXPLORE_CYCLES), stream, v[HS_EXPLORE_BOUND],
            ratio(v[HS_EXPLORE_CYCLES], v[HS_EXPLORE_BOUND]));
    write_cycles(out, v[HS_EXPLORE_FIRST_FACE]);
    write_cycles(out, v[HS_EXPLORE_TRAILER]);
    fprintf(out, ",%" PRIu64 ",%" PRIu64 ",%.6g,%.6g", v[HS_EXPLORE_CONFLICTS],
            hs_model_memory_bits(&config), bytes_per_face(row, HS_EXPLORE_READ),
            bytes_per_face(row, HS_EXPLORE_WRITTEN));
    if (r->clock > 0) fprintf(out, ",%.6g", views_per_second(r, point));
    for (uint32_t c = HS_EXPLORE_ACTIVITY; c < HS_EXPLORE_COLUMNS; c++)
        fprintf(out, ",%" PRIu64, v[c]);
    fputc('\n', out);
}

bool hs_explore_write_csv(const hs_explore_result *r, const char *path, hs_error *err) {
    hs_file file;
    if (!hs_file_create(&file, path, err)) return false;
    write_head(r, file.stream);
    const uint64_t views = r->space->views, points = hs_explore_points(r->space);
    for (uint64_t first = 0; first < points; first += views) {
        const uint64_t stream = stream_cycles(r, first);
        for (uint64_t point = first; point < first + views; point++)
            write_row(r, point, stream, file.stream);
    }
    return hs_file_commit(&file, err);
}

/* --- JSON ---------------------------------------------------------------------------------------
 */
static json_t *count_or_null(uint64_t count) {
    return count == HS_NO_CYCLE ? json_null() : json_integer((json_int_t)count);
}

static json_t *stages_of(const hs_explore_row *row, bool *good) {
    json_t *stages = json_object();
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        json_t *stage = json_object();
        for (uint32_t a = 0; a < HS_ACTIVITIES; a++)
            hs_json_set(
                stage, hs_activity_name(a),
                json_integer((json_int_t)row->value[HS_EXPLORE_ACTIVITY + s * HS_ACTIVITIES + a]),
                good);
        hs_json_set(stages, hs_stage_name(s), stage, good);
    }
    return stages;
}

static json_t *point_of(const hs_explore_result *r, uint64_t point, uint64_t stream, bool *good) {
    const hs_explore_row *row = &r->row[point];
    const uint64_t *v = row->value;
    const hs_model_config config = hs_explore_config(r->space, point);
    json_t *set = json_object();
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
        hs_json_set(set, hs_explore_name(p), json_integer(hs_explore_value(&config, p)), good);
    json_t *o = json_pack(
        "{s:o, s:i, s:s, s:I, s:I, s:I, s:f, s:I, s:I, s:f, s:o, s:o, s:I, s:I, s:f, s:f, s:o}",
        "set", set, "view", (int)hs_explore_view(r->space, point), "status",
        hs_status_name((uint32_t)v[HS_EXPLORE_STATUS]), "faces", (json_int_t)v[HS_EXPLORE_FACES],
        "vertices", (json_int_t)v[HS_EXPLORE_VERTICES], "cycles", (json_int_t)v[HS_EXPLORE_CYCLES],
        "cycles_per_face", per_face(row, HS_EXPLORE_CYCLES), "stream_cycles", (json_int_t)stream,
        "bound", (json_int_t)v[HS_EXPLORE_BOUND], "ratio",
        ratio(v[HS_EXPLORE_CYCLES], v[HS_EXPLORE_BOUND]), "first_face",
        count_or_null(v[HS_EXPLORE_FIRST_FACE]), "trailer", count_or_null(v[HS_EXPLORE_TRAILER]),
        "conflicts", (json_int_t)v[HS_EXPLORE_CONFLICTS], "memory_bits",
        (json_int_t)hs_model_memory_bits(&config), "bytes_read_per_face",
        bytes_per_face(row, HS_EXPLORE_READ), "bytes_written_per_face",
        bytes_per_face(row, HS_EXPLORE_WRITTEN), "stages", stages_of(row, good));
    if (r->clock > 0)
        hs_json_set(o, "views_per_second", json_real(views_per_second(r, point)), good);
    return o;
}

bool hs_explore_write_json(const hs_explore_result *r, const char *path, hs_error *err) {
    json_t *root = json_object(), *points = json_array();
    bool good = true;
    hs_json_set(root, "mesh", json_string(r->mesh), &good);
    if (r->clock > 0) hs_json_set(root, "clock_mhz", json_real(r->clock), &good);
    const uint64_t views = r->space->views, count = hs_explore_points(r->space);
    for (uint64_t first = 0; first < count; first += views) {
        const uint64_t stream = stream_cycles(r, first);
        for (uint64_t point = first; good && point < first + views; point++)
            hs_json_append(points, point_of(r, point, stream, &good), &good);
    }
    hs_json_set(root, "points", points, &good);
    hs_file file;
    if (!good) hs_fail(err, HS_EXIT_INTERNAL, "%.300s: no memory for it", path);
    good = good && hs_file_create(&file, path, err) &&
           hs_json_commit(root, JSON_INDENT(1) | JSON_REAL_PRECISION(6), &file, err);
    json_decref(root);
    return good;
}

/* --- The table ----------------------------------------------------------------------------------
 */
typedef struct sum {
    uint64_t faces, stream, bound, read, written, memory;
} sum;

static sum sum_of(const hs_explore_result *r, uint64_t first) {
    const hs_model_config config = hs_explore_config(r->space, first);
    sum s = {.memory = hs_model_memory_bits(&config), .stream = stream_cycles(r, first)};
    for (uint64_t point = first; point < first + r->space->views; point++) {
        const uint64_t *v = r->row[point].value;
        s.faces += v[HS_EXPLORE_FACES];
        s.bound += v[HS_EXPLORE_BOUND];
        s.read += v[HS_EXPLORE_READ];
        s.written += v[HS_EXPLORE_WRITTEN];
    }
    return s;
}

static bool beaten(const sum *all, uint64_t count, uint64_t which) {
    const sum *s = &all[which];
    for (uint64_t i = 0; i < count; i++) {
        const sum *o = &all[i];
        const bool no_worse = o->stream <= s->stream && o->memory <= s->memory;
        if (no_worse && (o->stream < s->stream || o->memory < s->memory)) return true;
    }
    return false;
}

/* A column of a parameter, as wide as its name asks, and the columns behind them. */
static int column_of(uint32_t parameter) {
    const int name = (int)strlen(hs_explore_name(parameter));
    return name < 5 ? 6 : name + 1;
}
static const int FIGURE_COLUMNS = 8 + 7 + 6 + 6 + 6 + 6, CLOCK_COLUMNS = 8;

/* Columns of the parameters of which several values were tried. */
static int parameter_columns(const hs_explore_result *r) {
    int columns = 0;
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
        if (r->space->parameter[p].given) columns += column_of(p);
    return columns;
}

void hs_explore_print(const hs_explore_result *r, FILE *out) {
    const uint64_t views = r->space->views, count = hs_explore_points(r->space) / views;
    sum *all = malloc(count * sizeof *all);
    if (!all) return;
    for (uint64_t i = 0; i < count; i++)
        all[i] = sum_of(r, i * views);
    /* What is too much for a line takes two: parameters, and below them the figures. */
    const int columns =
        parameter_columns(r) + 2 + FIGURE_COLUMNS + (r->clock > 0 ? CLOCK_COLUMNS : 0) + 2;
    const char *const between = columns > HS_TERMINAL_COLUMNS ? "\n          " : "  ";
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
        if (r->space->parameter[p].given) fprintf(out, "%*s", column_of(p), hs_explore_name(p));
    fprintf(out, "%s%8s c/face ratio  Mbit  read write%s\n", between, "cycles",
            r->clock > 0 ? " views/s" : "");
    for (uint64_t i = 0; i < count; i++) {
        const sum *s = &all[i];
        const hs_model_config config = hs_explore_config(r->space, i * views);
        for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
            if (r->space->parameter[p].given)
                fprintf(out, "%*" PRIu32, column_of(p), hs_explore_value(&config, p));
        fprintf(out, "%s%8" PRIu64 " %6.2f %5.2f %5.0f %5.0f %5.0f", between, s->stream,
                ratio(s->stream, s->faces), ratio(s->stream * config.views, s->bound),
                (double)s->memory / 1e6, ratio(s->read, s->faces) / 8,
                ratio(s->written, s->faces) / 8);
        if (r->clock > 0)
            fprintf(out, " %7.0f", r->clock * 1e6 * (double)views / (double)s->stream);
        fprintf(out, "%s\n", beaten(all, count, i) ? "" : " *");
    }
    free(all);
}
