/* SPDX-License-Identifier: Apache-2.0
 *
 * What GTKWave needs beside a waveform (tests/waves.mk):
 *
 *   waves window TIMELINE GEN         prints FIRST:LAST, the cycles of a generation and some around
 *   waves begin TIMELINE GEN          those around its beginning
 *   waves save DIR TIMELINE REPORT FST FIRST:LAST
 *       writes DIR/waves.gtkw, which shows FST: signals stage by stage, what a stage does and what
 *       the states are by name, positions as numbers, markers where generations and stages begin;
 *       and the filters that it uses, beside it
 *
 * TIMELINE, REPORT and FST are of one view: halfstep run --timeline, --json, --wave. Names of
 * states come from the RTL itself: it is started in the project's folder.
 */
#include <jansson.h>
#include <limits.h>
#include <math.h>
#include <stdint.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#define PIXELS 14.0  /* of a cycle, at first */
#define FRAME  200.0 /* pixels of a unit of time where GTKWave's zoom is 0 */

#include "definitions.h"
#include "file.h"
#include "options.h"

enum { AROUND = 36, CYCLE = 10 }; /* cycles before and behind; units of FST time in a cycle */

/* --- The signals --------------------------------------------------------------------------------
 */

enum format { BIT, DECIMAL, HEX, STATE, AT, KIND, STATUS, BINARY32, FIXED, ACTIVITY };

typedef struct signal {
    const char *path; /* below the pipeline; of an activity: the stage's module. NAME=PATH: to be
                         shown by that name */
    enum format format;
} signal;

enum { MOST = 14 };
typedef struct group {
    const char *name;
    signal signal[MOST];
} group;

/* What the probes look at (sim/probes.sv), and what a stage waits for. */
static const group GROUPS[] = {
    {"sequencer",
     {{"u_sequencer.state_q[3:0]", STATE},
      {"generation[7:0]", DECIMAL},
      {"items[19:0]", DECIMAL},
      {"vertices[19:0]", DECIMAL},
      {"status_o[7:0]", STATUS}}},
    {"receive",
     {{"u_receive", ACTIVITY},
      {"u_receive.at_q[3:0]", AT},
      {"s_axis_tvalid", BIT},
      {"s_axis_tready", BIT},
      {"raw_valid", BIT},
      {"raw_index[18:0]", DECIMAL},
      {"raw[127:0]", BINARY32},
      {"corner_valid", BIT},
      {"corner_index[18:0]", DECIMAL},
      {"corner_origin[18:0]", DECIMAL}}},
    {"transform, quantize",
     {{"clip_valid", BIT},
      {"clip_index[18:0]", DECIMAL},
      {"clip[127:0]", BINARY32},
      {"quantize_wr", BIT},
      {"quantize_wr_index[18:0]", DECIMAL},
      {"quantize_wr_data[127:0]", FIXED}}},
    {"classify",
     {{"u_refine.u_classify", ACTIVITY},
      {"u_refine.u_classify.u_fetch.item_o[18:0]", DECIMAL},
      {"u_refine.u_classify.fetch_valid", BIT},
      {"u_refine.u_classify.fetch_ready", BIT},
      {"u_refine.u_classify.stall", BIT},
      {"u_refine.u_classify.point_valid_o", BIT},
      {"u_refine.u_classify.point_face_o[18:0]", DECIMAL},
      {"u_refine.u_classify.point_o[127:0]", FIXED},
      {"u_refine.u_classify.front_o", BIT},
      {"u_refine.u_classify.give", BIT},
      {"u_refine.u_classify.take", BIT},
      {"u_refine.u_classify.give_corner[18:0]", DECIMAL}}},
    {"select",
     {{"u_refine.u_select", ACTIVITY},
      {"u_refine.u_select.u_fetch.item_o[18:0]", DECIMAL},
      {"u_refine.u_select.fetch_valid", BIT},
      {"u_refine.u_select.fetch_ready", BIT},
      {"u_refine.u_select.stall", BIT},
      {"u_refine.u_select.selected_valid_o", BIT},
      {"u_refine.u_select.selected_face_o[18:0]", DECIMAL},
      {"u_refine.u_select.selected_verdict_o", BIT},
      {"u_refine.u_select.fold_valid", BIT},
      {"u_refine.u_select.fold_ready", BIT}}},
    {"guard",
     {{"u_refine.u_guard", ACTIVITY},
      {"u_refine.u_guard.u_fetch.item_o[18:0]", DECIMAL},
      {"u_refine.u_guard.fetch_valid", BIT},
      {"u_refine.u_guard.fetch_ready", BIT},
      {"u_refine.u_guard.stall", BIT},
      {"u_refine.u_guard.verdict_valid_o", BIT},
      {"u_refine.u_guard.verdict_item_o[18:0]", DECIMAL},
      {"u_refine.u_guard.new_valid_o", BIT},
      {"u_refine.u_guard.new_vertex_o[18:0]", DECIMAL},
      {"u_refine.u_guard.new_position_o[127:0]", FIXED}}},
    {"smooth",
     {{"u_refine.u_smooth", ACTIVITY},
      {"u_refine.u_smooth.row_number[15:0]", DECIMAL},
      {"u_refine.u_smooth.row_mask[7:0]", HEX},
      {"u_refine.u_smooth.single", BIT},
      {"u_refine.u_smooth.single_vertex[18:0]", DECIMAL},
      {"u_refine.u_smooth.new_pick", BIT},
      {"u_refine.u_smooth.write_valid_o", BIT},
      {"u_refine.u_smooth.write_vertex_o[18:0]", DECIMAL},
      {"u_refine.u_smooth.write_move_o", BIT},
      {"u_refine.u_smooth.write_position_o[127:0]", FIXED},
      {"u_refine.u_smooth.waits", BIT},
      {"FIFO before emit=u_refine.u_smooth.u_groups.level[3:0]", DECIMAL}}},
    {"split",
     {{"u_refine.u_split", ACTIVITY},
      {"u_refine.u_split.u_fetch.item_o[18:0]", DECIMAL},
      {"u_refine.u_split.fetch_valid", BIT},
      {"u_refine.u_split.fetch_ready", BIT},
      {"u_refine.u_split.beyond_stall", BIT},
      {"u_refine.u_split.numbered_valid", BIT},
      {"u_refine.u_split.numbered_stall", BIT},
      {"u_refine.u_split.done", BIT},
      {"u_refine.u_split.replaced[3:0]", HEX},
      {"children[19:0]", DECIMAL},
      {"FIFO before emit=u_refine.u_split.u_write.u_faces.u_ops.level_o[4:0]", DECIMAL}}},
    {"emit",
     {{"u_emit", ACTIVITY},
      {"u_emit.op_valid_i", BIT},
      {"u_emit.op_ready_o", BIT},
      {"u_emit.op_kind_i[2:0]", KIND},
      {"u_emit.op_number_i[23:0]", DECIMAL},
      {"u_emit.records_valid_q", BIT},
      {"u_emit.pack_ready", BIT},
      {"u_emit.count_q[2:0]", DECIMAL},
      {"rows before the port=u_emit.u_pack.level[1:0]", DECIMAL},
      {"m_axis_tvalid", BIT},
      {"m_axis_tready", BIT},
      {"m_axis_tlast", BIT}}},
};
enum { GROUP_COUNT = sizeof GROUPS / sizeof *GROUPS };

static const char PIPELINE[] = "TOP.halfstep.g_pipeline[0].u_pipeline.";

/* --- Filters ------------------------------------------------------------------------------------
 *
 * Text files with a value and its name a line, for what has a name; a program for what is a number.
 */
static bool write_text(const char *folder, const char *name, const char *text, hs_error *err) {
    char path[PATH_MAX];
    hs_file file;
    snprintf(path, sizeof path, "%s/%s", folder, name);
    if (!hs_file_create(&file, path, err)) return false;
    fputs(text, file.stream);
    return hs_file_commit(&file, err);
}

/* Names of the RTL's: the word behind each `before`; their values count from 0. */
static bool write_names(const char *folder, const char *name, const char *source,
                        const char *before, hs_error *err) {
    uint8_t *bytes;
    size_t size;
    char text[4000] = "";
    uint32_t count = 0;
    if (!hs_file_read(source, 1 << 20, &bytes, &size, err)) return false;
    for (const char *at = (char *)bytes; (at = strstr(at, before)) != NULL;) {
        at += strlen(before);
        const size_t length = strspn(at, "ABCDEFGHIJKLMNOPQRSTUVWXYZ_"), used = strlen(text);
        snprintf(text + used, sizeof text - used, "%X %.*s\n", count++, (int)length, at);
    }
    free(bytes);
    return count > 1 ? write_text(folder, name, text, err)
                     : hs_fail(err, HS_EXIT_INTERNAL, "%s: no names behind \"%s\"", source, before);
}

/* Puts the filter program into the folder, under a name that tells it what it reads. */
static bool link_program(const char *folder, const char *name, hs_error *err) {
    char path[PATH_MAX], program[PATH_MAX] = "";
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 10);
    if (length > 0) memcpy(program + length, "_filter", 8);
    snprintf(path, sizeof path, "%s/%s", folder, name);
    unlink(path);
    return (length > 0 && symlink(program, path) == 0) ||
           hs_fail(err, HS_EXIT_FILE, "%.300s: cannot be linked to %.200s", path, program);
}

static bool write_filters(const char *folder, int exponent, hs_error *err) {
    static const char *const kind[] = {
        [HS_OP_HEADER] = "header", [HS_OP_VERTEX] = "vertex",   [HS_OP_FACES] = "faces",
        [HS_OP_CORNER] = "corner", [HS_OP_TRAILER] = "trailer", [HS_OP_GROUP] = "group"};
    char kinds[200] = "", statuses[4000] = "", fixed[20];
    for (uint32_t i = 0; i < sizeof kind / sizeof *kind; i++)
        snprintf(kinds + strlen(kinds), sizeof kinds - strlen(kinds), "%X %s\n", i, kind[i]);
    for (uint32_t i = 0; i <= HS_STATUS_BAD_SHARPNESS; i++)
        if (hs_status_name(i))
            snprintf(statuses + strlen(statuses), sizeof statuses - strlen(statuses), "%02X %s\n",
                     i, hs_status_name(i));
    snprintf(fixed, sizeof fixed, "fixed_e%d", exponent);
    return write_names(folder, "at.txt", "rtl/receive.sv", "localparam logic [3:0] AT_", err) &&
           write_text(folder, "kind.txt", kinds, err) &&
           write_text(folder, "status.txt", statuses, err) &&
           /* {busy, starved, blocked} */
           write_text(folder, "activity.txt", "0 idle\n1 blocked\n2 starved\n4 busy\n", err) &&
           link_program(folder, "binary32", err) && link_program(folder, fixed, err);
}

/* --- The view -----------------------------------------------------------------------------------
 */

typedef struct start {
    char name[40];
    uint64_t cycle, end;
    bool generation; /* or a stage's */
} start;

typedef struct starts {
    start of[4096];
    uint32_t count;
    uint64_t end;  /* of the view */
    uint32_t last; /* generation */
} starts;

/* Reads where generations and stages begin, from a timeline of one view. */
static bool read_starts(const char *path, starts *s, hs_error *err) {
    json_error_t why;
    json_t *root = json_load_file(path, 0, &why);
    if (!root) return hs_fail(err, HS_EXIT_FILE, "%s: %s", path, why.text);
    size_t i;
    json_t *event;
    *s = (starts){0};
    json_array_foreach(json_object_get(root, "traceEvents"), i, event) {
        const char *name = json_string_value(json_object_get(event, "name"));
        const char *phase = json_string_value(json_object_get(event, "ph"));
        const uint64_t ts = (uint64_t)json_integer_value(json_object_get(event, "ts"));
        const uint64_t end = ts + (uint64_t)json_integer_value(json_object_get(event, "dur"));
        if (!name || !phase || *phase != 'X') continue;
        if (end > s->end) s->end = end;
        if (strncmp(name, "view ", 5) == 0 || strcmp(name, "blocked") == 0 ||
            strcmp(name, "starved") == 0)
            continue;
        if (s->count == sizeof s->of / sizeof *s->of) break;
        start *of = &s->of[s->count++];
        snprintf(of->name, sizeof of->name, "%s", name);
        of->cycle = ts;
        of->end = end;
        of->generation = strncmp(name, "generation ", 11) == 0;
        if (of->generation) s->last = (uint32_t)strtoul(name + 11, NULL, 10);
    }
    json_decref(root);
    return s->count || hs_fail(err, HS_EXIT_STREAM, "%s: the view has no generations", path);
}

/* The exponent of the view's block, from the run's report. */
static bool read_exponent(const char *path, int *exponent, hs_error *err) {
    json_error_t why;
    json_t *root = json_load_file(path, 0, &why);
    const json_t *view = json_array_get(json_object_get(root, "views"), 0);
    const json_t *value = json_object_get(view, "exponent");
    const bool good = json_is_integer(value);
    *exponent = good ? (int)json_integer_value(value) : 0;
    json_decref(root);
    return good || hs_fail(err, HS_EXIT_FILE, "%s: no report of a view", path);
}

/* The first time in an FST file: behind the kind and the length of its header. */
static bool read_first_time(const char *path, uint64_t *time, hs_error *err) {
    uint8_t head[17];
    FILE *file = fopen(path, "rb");
    const bool good = file && fread(head, sizeof head, 1, file) == 1 && head[0] == 0;
    if (file) fclose(file);
    *time = 0;
    for (int i = 9; good && i < 17; i++)
        *time = *time << 8 | head[i];
    return good || hs_fail(err, HS_EXIT_FILE, "%s: is no FST file", path);
}

/* --- The save file ------------------------------------------------------------------------------
 */

enum { MARKERS = 26 };

/* Emit begins and ends with what it is sent. */
static bool in_window(const start *of, uint64_t first, uint64_t last) {
    return of->cycle >= first && of->cycle <= last && strncmp(of->name, "emit", 4) != 0;
}

/* Markers A to Z: the generations that begin in the window, and its stages if there is room. */
static uint32_t choose_markers(const starts *s, uint64_t first, uint64_t last,
                               const start *marker[MARKERS]) {
    uint32_t within[2] = {0, 0}, count = 0;
    for (uint32_t i = 0; i < s->count; i++)
        within[s->of[i].generation] += in_window(&s->of[i], first, last);
    const bool stages = within[0] + within[1] <= MARKERS;
    for (uint32_t i = 0; i < s->count && count < MARKERS; i++) {
        const start *of = &s->of[i];
        if (!in_window(of, first, last) || (!of->generation && !stages)) continue;
        if (count && marker[count - 1]->cycle == of->cycle)
            continue; /* classify: the generation's */
        marker[count++] = of;
    }
    return count;
}

/* A signal as GTKWave's save files have it: how it is shown, through which filter, its name. */
static void print_signal(FILE *out, const signal *s, const char *folder, int exponent) {
    static const struct {
        const char *flags, *filter;
    } shown[] = {[BIT] = {"28", NULL},
                 [DECIMAL] = {"24", NULL},
                 [HEX] = {"22", NULL},
                 [STATE] = {"100000028", NULL}, /* an enum, whose names are in the FST file */
                 [AT] = {"2022", "at.txt"},
                 [KIND] = {"2022", "kind.txt"},
                 [STATUS] = {"2022", "status.txt"},
                 [BINARY32] = {"4022", "binary32"},
                 [FIXED] = {"4022", "fixed_e"},
                 [ACTIVITY] = {"2022", "activity.txt"}};
    const char *equals = strchr(s->path, '='), *path = equals ? equals + 1 : s->path;
    const char *dot = strrchr(path, '.'), *name = equals ? s->path : dot ? dot + 1 : path;
    const size_t length = equals ? (size_t)(equals - s->path) : strlen(name);
    if (s->format == ACTIVITY) fputs("[color] 3\n", out);
    fprintf(out, "@%s\n", shown[s->format].flags);
    if (s->format == FIXED)
        fprintf(out, "^>%d %s/%s%d\n", s->format, folder, shown[s->format].filter, exponent);
    else if (shown[s->format].filter)
        fprintf(out, "^%s%d %s/%s\n", s->format == BINARY32 ? ">" : "", s->format, folder,
                shown[s->format].filter);
    if (s->format == ACTIVITY)
        fprintf(out, "#{activity} %s%s.busy_o %s%s.starved_o %s%s.blocked_o\n", PIPELINE, s->path,
                PIPELINE, s->path, PIPELINE, s->path);
    else
        fprintf(out, "+{%.*s} %s%s\n", (int)length, name, PIPELINE, path);
}

typedef struct window {
    uint64_t first, last; /* cycles of the view */
} window;

/* Whether a group's stage is at work in the window; the sequencer always is. */
static bool at_work(const starts *s, const char *group, window w) {
    const size_t length = strcspn(group, ",");
    for (uint32_t i = 0; i < s->count; i++)
        if (strncmp(s->of[i].name, group, length) == 0 && s->of[i].cycle <= w.last &&
            s->of[i].end >= w.first)
            return true;
    return strcmp(group, "sequencer") == 0;
}

/* Groups whose stage is not at work are closed. */
static void print_groups(FILE *out, const starts *s, const char *folder, int exponent, window w) {
    fprintf(out, "@28\nTOP.clk_i\n");
    for (uint32_t g = 0; g < GROUP_COUNT; g++) {
        const bool open = at_work(s, GROUPS[g].name, w);
        fprintf(out, "@%s\n-%s\n", open ? "800200" : "c00200", GROUPS[g].name);
        for (uint32_t i = 0; i < MOST && GROUPS[g].signal[i].path; i++)
            print_signal(out, &GROUPS[g].signal[i], folder, exponent);
        fprintf(out, "@%s\n-%s\n", open ? "1000200" : "1401200", GROUPS[g].name);
    }
}

/* time: the file's first, which is that of the window's first cycle. */
static void print_save(FILE *out, const starts *s, const char *fst, uint64_t time, window w) {
    const start *marker[MARKERS];
    const uint32_t count = choose_markers(s, w.first, w.last, marker);
    const uint64_t first = time - time % CYCLE;
    fprintf(out, "[dumpfile] \"%s\"\n[timestart] %llu\n[size] 1300 1220\n[pos] 0 0\n*%.2f -1", fst,
            (unsigned long long)first, log2(PIXELS / CYCLE / FRAME));
    for (uint32_t i = 0; i < MARKERS; i++)
        if (i < count)
            fprintf(out, " %llu",
                    (unsigned long long)(first + CYCLE * (marker[i]->cycle - w.first)));
        else
            fputs(" -1", out);
    fputc('\n', out);
    for (uint32_t i = 0; i < count; i++)
        fprintf(out, "[markername] %c%s\n", (int)('A' + i), marker[i]->name);
    fputs("[sst_expanded] 0\n[signals_width] 260\n", out);
}

/* --- The commands -------------------------------------------------------------------------------
 */

static starts all; /* of the view */

static bool print_window(char **argument, bool whole, hs_error *err) {
    uint32_t generation;
    if (!hs_number_parse(argument[1], &generation))
        return hs_fail(err, HS_EXIT_USAGE, "GEN: \"%.40s\" is no generation", argument[1]);
    if (!read_starts(argument[0], &all, err)) return false;
    for (uint32_t i = 0; i < all.count; i++) {
        const start *of = &all.of[i];
        if (!of->generation || strtoul(of->name + 11, NULL, 10) != generation) continue;
        const uint64_t end = (whole ? of->end : of->cycle) + AROUND;
        printf("%llu:%llu\n", (unsigned long long)(of->cycle > AROUND ? of->cycle - AROUND : 0),
               (unsigned long long)(end < all.end ? end : all.end));
        return true;
    }
    return hs_fail(err, HS_EXIT_USAGE, "GEN=%u: the view has generations 0 to %u", generation,
                   all.last);
}

static bool save(char **argument, hs_error *err) {
    char folder[PATH_MAX], fst[PATH_MAX], path[PATH_MAX + 20];
    uint64_t time;
    uint32_t first, last;
    int exponent;
    hs_file file;
    if (!hs_pair_parse(argument[4], ':', &first, &last) || first > last)
        return hs_fail(err, HS_EXIT_USAGE, "\"%s\" is no FIRST:LAST", argument[4]);
    if (!realpath(argument[0], folder) || !realpath(argument[3], fst))
        return hs_fail(err, HS_EXIT_FILE, "%s or %s is not there", argument[0], argument[3]);
    snprintf(path, sizeof path, "%s/waves.gtkw", folder);
    if (!read_starts(argument[1], &all, err) || !read_exponent(argument[2], &exponent, err) ||
        !read_first_time(fst, &time, err) || !write_filters(folder, exponent, err) ||
        !hs_file_create(&file, path, err))
        return false;
    const window w = {first, last};
    print_save(file.stream, &all, fst, time, w);
    print_groups(file.stream, &all, folder, exponent, w);
    return hs_file_commit(&file, err);
}

int main(int argc, char **argv) {
    hs_error err = {0};
    bool good;
    if (argc == 4 && strcmp(argv[1], "window") == 0)
        good = print_window(argv + 2, true, &err);
    else if (argc == 4 && strcmp(argv[1], "begin") == 0)
        good = print_window(argv + 2, false, &err);
    else if (argc == 7 && strcmp(argv[1], "save") == 0)
        good = save(argv + 2, &err);
    else
        good = hs_fail(&err, HS_EXIT_USAGE,
                       "waves window|begin TIMELINE GEN | save DIR TIMELINE REPORT FST FIRST:LAST");
    if (!good) fprintf(stderr, "waves: %s\n", err.text);
    return good ? 0 : err.code;
}
