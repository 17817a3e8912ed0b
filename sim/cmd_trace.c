/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep trace: makes traces, checks them, shows streams as text and builds them from text.
 */
#include <dirent.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

#include "commands.h"
#include "compare.h"
#include "json_file.h"
#include "options.h"
#include "terminal.h"
#include "trace.h"

static const char ROOT[] = "traces";
static const size_t JSON_LIMIT = 1 << 24;

/* --- Folders ------------------------------------------------------------------------------------
 */

static bool is_trace(const char *folder) {
    char path[4096];
    struct stat status;
    snprintf(path, sizeof path, "%s/trace.txt", folder);
    return stat(path, &status) == 0;
}

/* A name alone is one in traces/. */
static void folder_of(const char *name, char *folder, size_t size) {
    if (strchr(name, '/') || is_trace(name))
        snprintf(folder, size, "%s", name);
    else
        snprintf(folder, size, "%s/%s", ROOT, name);
    for (size_t length = strlen(folder); length > 1 && folder[length - 1] == '/';)
        folder[--length] = 0;
}

static int is_visible(const struct dirent *entry) {
    char path[512];
    snprintf(path, sizeof path, "%s/%s", ROOT, entry->d_name);
    return entry->d_name[0] != '.' && is_trace(path);
}

typedef bool visit(const char *folder, hs_error *err);

/* Visits the named folders, or, with none, all in traces/. Goes on behind a failure; every error
 * is printed where it happens. */
static int visit_all(int count, char **name, visit *what, hs_error *err) {
    int code = HS_EXIT_OK;
    struct dirent **entry = NULL;
    int entries = count;
    if (count == 0) {
        entries = scandir(ROOT, &entry, is_visible, alphasort);
        if (entries <= 0) {
            hs_fail(err, HS_EXIT_FILE,
                    "%s: no traces here; run in the project's folder, or name a "
                    "trace's folder",
                    ROOT);
            free(entry);
            return err->code;
        }
    }
    for (int i = 0; i < entries; i++) {
        char folder[4000];
        folder_of(entry ? entry[i]->d_name : name[i], folder, sizeof folder);
        if (!what(folder, err)) {
            hs_print_error(err);
            code = err->code;
            err->text[0] = 0;
        }
        if (entry) free(entry[i]);
    }
    free(entry);
    return code;
}

/* --- trace make ---------------------------------------------------------------------------------
 */

static bool make_trace(const char *folder, hs_error *err) {
    hs_trace trace;
    char path[4096];
    if (!hs_trace_compile(&trace, folder, err)) return false;
    json_t *expected = hs_trace_expect(&trace, folder, err);
    snprintf(path, sizeof path, "%s/input.hss", folder);
    bool good = expected && hs_stream_file_write(&trace.input, path, err);
    hs_file file;
    snprintf(path, sizeof path, "%s/expected.json", folder);
    good = good && hs_file_create(&file, path, err) &&
           hs_json_commit(expected, JSON_INDENT(1), &file, err);
    if (good)
        printf("%s: made, %u view%s\n", folder, trace.input.packets,
               trace.input.packets == 1 ? "" : "s");
    json_decref(expected);
    hs_trace_free(&trace);
    return good;
}

static int run_make(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "trace make",
        "TRACE...",
        0,
        -1,
        "Makes input.hss and expected.json of a trace from its trace.txt",
        "A TRACE is a folder, or its name in traces/. trace.txt says how the input is made\n"
        "(docs/command-line.md); golden and rtl run it and have to agree. The same trace.txt\n"
        "gives the same bytes, as long as the rtl takes the same cycles.\n\n"
        "  halfstep trace make cube-4-8\n  halfstep trace make --all\n"};
    bool all = false;
    const hs_option option[] = {
        {"all", 'a', HS_OPTION_FLAG, NULL, &all, 0, 0, NULL, "all traces in traces/"}, {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    if (all == (operand < argc)) {
        hs_fail(err, HS_EXIT_USAGE, "trace make: name traces, or give --all%s",
                all ? ", not both" : "");
        return err->code;
    }
    return visit_all(argc - operand, argv + operand, make_trace, err);
}

/* --- trace check --------------------------------------------------------------------------------
 */

static json_t *read_expected(const char *folder, hs_error *err) {
    char path[4096];
    uint8_t *bytes;
    size_t size;
    snprintf(path, sizeof path, "%s/expected.json", folder);
    if (!hs_file_read(path, JSON_LIMIT, &bytes, &size, err)) return NULL;
    json_t *expected = hs_trace_expected_parse((const char *)bytes, size, path, err);
    free(bytes);
    return expected;
}

/* input.hss has to be what trace.txt makes. */
static bool check_input(const char *folder, const hs_trace *trace, const hs_stream_file *input,
                        hs_error *err) {
    if (input->packets != trace->input.packets)
        return hs_fail(err, HS_EXIT_STREAM,
                       "%.300s: input.hss has %u packets, trace.txt makes %u; make the trace again",
                       folder, input->packets, trace->input.packets);
    for (uint32_t i = 0; i < input->packets; i++) {
        const hs_word_comparison words =
            hs_compare_words(&trace->input.packet[i], &input->packet[i]);
        if (words.different || input->packet[i].view != trace->input.packet[i].view)
            return hs_fail(err, HS_EXIT_STREAM,
                           "%.300s: packet %u of input.hss is not what trace.txt makes, from word "
                           "%zu on; make the trace again",
                           folder, i, words.first);
    }
    return true;
}

static bool check_trace(const char *folder, hs_error *err) {
    hs_trace trace;
    hs_stream_file input = {0};
    char path[4096];
    if (!hs_trace_compile(&trace, folder, err)) return false;
    snprintf(path, sizeof path, "%s/input.hss", folder);
    json_t *expected = read_expected(folder, err), *actual = NULL;
    bool good = expected && hs_stream_file_read(&input, path, err) &&
                check_input(folder, &trace, &input, err);
    if (good) actual = hs_trace_expect(&trace, folder, err);
    good = actual && hs_trace_expected_check(expected, actual, folder, err);
    if (good) printf("%s: good, %u view%s\n", folder, input.packets, input.packets == 1 ? "" : "s");
    json_decref(expected);
    json_decref(actual);
    hs_stream_file_free(&input);
    hs_trace_free(&trace);
    return good;
}

/* --- trace check --output -----------------------------------------------------------------------
 */

static bool judge_packet(const char *path, const hs_trace *trace, uint32_t i, hs_golden *golden,
                         const hs_packet *sent, uint64_t *words, hs_error *err) {
    const hs_packet *in = &trace->input.packet[i];
    hs_packet wanted = {0};
    hs_golden_report report;
    bool good = hs_golden_run(golden, in, &wanted, &report, err);
    if (good && sent->view != in->view)
        good = hs_fail(err, HS_EXIT_DIFFERENT,
                       "%.200s: packet %u is of view %u; it should be of view %u", path, i,
                       sent->view, in->view);
    if (good) {
        const hs_word_comparison c = hs_compare_words(&wanted, sent);
        *words += c.compared;
        char text[400];
        if (c.compared == 0) {
            good = hs_fail(err, HS_EXIT_DIFFERENT, "%.200s, view %u: no word was compared", path,
                           in->view);
        } else if (c.different) {
            hs_compare_describe(&wanted, sent, c.first, "yours", text, sizeof text);
            good = hs_fail(err, HS_EXIT_DIFFERENT,
                           "%.100s, view %u: %llu of %llu words differ; first %s", path, in->view,
                           (unsigned long long)c.different, (unsigned long long)c.compared, text);
        }
    }
    hs_packet_free(&wanted);
    return good;
}

/* Judges somebody else's output stream for a trace's input. */
static bool judge_output(const char *folder, const char *path, hs_error *err) {
    hs_trace trace;
    hs_stream_file sent = {0};
    if (!hs_trace_compile(&trace, folder, err)) return false;
    hs_golden *golden = hs_golden_new(trace.limits);
    bool good = golden || hs_fail(err, HS_EXIT_INTERNAL, "no memory for golden");
    good = good && hs_stream_file_read(&sent, path, err);
    uint64_t words = 0;
    for (uint32_t i = 0; good && i < trace.input.packets && i < sent.packets; i++)
        good = judge_packet(path, &trace, i, golden, &sent.packet[i], &words, err);
    if (good && sent.packets != trace.input.packets)
        good = hs_fail(err, HS_EXIT_DIFFERENT, "%.300s: %u packets; %s asks for %u views", path,
                       sent.packets, folder, trace.input.packets);
    if (good)
        printf("%s: good for %s: all %llu words of %u view%s\n", path, folder,
               (unsigned long long)words, sent.packets, sent.packets == 1 ? "" : "s");
    hs_golden_free(golden);
    hs_stream_file_free(&sent);
    hs_trace_free(&trace);
    return good;
}

static int run_check(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "trace check",
        "[TRACE...]",
        0,
        -1,
        "Runs golden and rtl on traces and compares with what is expected",
        "A TRACE is a folder, or its name in traces/; none: all in traces/.\n\n"
        "  halfstep trace check\n"
        "  halfstep trace check cube-4-8 --output mine.hss\n"
        "      judges the output stream that your own pipeline made of\n"
        "      traces/cube-4-8/input.hss, word for word (docs/stream.md, chapter 6)\n"};
    const char *output = NULL;
    const hs_option option[] = {
        {"output", 'o', HS_OPTION_TEXT, "FILE", &output, 0, 0, NULL, "judge this output stream"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    if (!output) return visit_all(argc - operand, argv + operand, check_trace, err);
    if (argc - operand != 1) {
        hs_fail(err, HS_EXIT_USAGE, "trace check: --output belongs to one trace; name it");
        return err->code;
    }
    char folder[4000];
    folder_of(argv[operand], folder, sizeof folder);
    return judge_output(folder, output, err) ? HS_EXIT_OK : err->code;
}

/* --- trace show, trace build --------------------------------------------------------------------
 */

static int run_show(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "trace show",
        "FILE",
        1,
        1,
        "Prints a stream file as text, a record a line, explained",
        "  halfstep trace show traces/cube-4-8/input.hss | less\n"
        "What it prints, `halfstep trace build` turns into the same file again.\n"};
    const hs_option option[] = {{0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    hs_stream_file file;
    if (!hs_stream_file_read(&file, argv[operand], err)) return err->code;
    hs_stream_file_show(&file, stdout);
    hs_stream_file_free(&file);
    return HS_EXIT_OK;
}

static int run_build(int argc, char **argv, hs_error *err) {
    static const hs_command command = {
        "trace build",
        "TEXT FILE",
        2,
        2,
        "Builds a stream file from text",
        "The text has `packet VIEW` and then four words a line; # begins a comment. A word is\n"
        "up to 8 hexadecimal digits, a number with a decimal point, or crc: the CRC-32 of the\n"
        "records before it.\n\n"
        "  halfstep trace show in.hss > in.txt    and edit it; then\n"
        "  halfstep trace build in.txt changed.hss\n"};
    const hs_option option[] = {{0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&command, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(argv[operand], (size_t)1 << 32, &bytes, &size, err)) return err->code;
    hs_stream_file file;
    const bool good = hs_stream_file_build(&file, (char *)bytes, size, argv[operand], err) &&
                      hs_stream_file_write(&file, argv[operand + 1], err);
    hs_stream_file_free(&file);
    free(bytes);
    return good ? HS_EXIT_OK : err->code;
}

/* --- trace --------------------------------------------------------------------------------------
 */

int hs_command_trace(int argc, char **argv, hs_error *err) {
    static const hs_part part[] = {
        {"make", run_make, "make input.hss and expected.json from trace.txt"},
        {"check", run_check, "golden and rtl, or --output FILE, against what is expected"},
        {"show", run_show, "a stream as text"},
        {"build", run_build, "text as a stream"},
        {0}};
    return hs_part_run("trace", part, argc, argv, err);
}
