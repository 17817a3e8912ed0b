/* SPDX-License-Identifier: Apache-2.0
 *
 * halfstep report: what a run found, as one HTML file.
 */
#include <limits.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include "commands.h"
#include "definitions.h"
#include "options.h"
#include "report_folder.h"
#include "report_html.h"

static const hs_command COMMAND = {
    .name = "report",
    .operands = "DIR",
    .least = 1,
    .most = 1,
    .what = "One HTML file of a run: verdicts, pictures, meshes to turn, tables, plots",
    .text =
        "DIR is the folder of a run: `halfstep run MESH --out DIR`. The file needs no network.\n"
        "\n"
        "Examples:\n"
        "  halfstep run shape:hand --orbit 8 --out out/hand && halfstep report out/hand\n"
        "      writes out/hand/report.html\n"
        "  halfstep explore shape:hand --set banks=2,4 --set window=2,4,8 --out out/space\n"
        "  halfstep report out/hand --explore out/space -o hand.html\n"
        "      with the plots of a design space\n"
        "  halfstep report out/hand --with out/spot --with out/bob/run.json\n"
        "      with other runs in the plot of cycles per face against mesh size\n"};

typedef struct request {
    hs_report_request data;
    const char *out, *template;
    bool quiet;
} request;

static enum hs_parsed parse(request *r, int argc, char **argv, hs_error *err) {
    *r = (request){.data = {.faces = 50000, .views = 16}};
    const hs_option option[] = {
        {"out", 'o', HS_OPTION_TEXT, "FILE", &r->out, 0, 0, NULL,
         "the HTML file to write (DIR/report.html)"},
        {"json", 'j', HS_OPTION_TEXT, "FILE", &r->data.json, 0, 0, NULL,
         "the run's report (DIR/run.json)"},
        {"explore", 'x', HS_OPTION_LIST, "DIR", &r->data.explore, 0, 0, NULL,
         "an exploration to show as well; once for each"},
        {"with", 0, HS_OPTION_LIST, "DIR", &r->data.with, 0, 0, NULL,
         "another run, for plots over meshes; once for each"},
        {"faces", 0, HS_OPTION_NUMBER, "N", &r->data.faces, 100, 1000000, NULL,
         "of a mesh in the file, at most; decimated above (50000)"},
        {"views", 0, HS_OPTION_NUMBER, "N", &r->data.views, 1, 1000, NULL,
         "with pictures and meshes, at most (16)"},
        {"template", 0, HS_OPTION_TEXT, "FILE", &r->template, 0, 0, NULL,
         "the page to fill (report/template.html beside the\nprogram)"},
        {"quiet", 'q', HS_OPTION_FLAG, NULL, &r->quiet, 0, 0, NULL, "no notes"},
        {0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&COMMAND, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED) r->data.folder = argv[operand];
    return parsed;
}

/* From the program's folder: where it is built, and where it is installed. */
static bool find_template(char path[PATH_MAX], hs_error *err) {
    static const char *const place[] = {"report/template.html",
                                        "../share/halfstep/report/template.html"};
    char program[PATH_MAX];
    const ssize_t length = readlink("/proc/self/exe", program, sizeof program - 1);
    if (length > 0) program[length] = 0;
    char *const end = length > 0 ? strrchr(program, '/') : NULL;
    if (end) *end = 0;
    for (size_t i = 0; end && i < sizeof place / sizeof *place; i++) {
        struct stat status;
        const int used = snprintf(path, PATH_MAX, "%s/%s", program, place[i]);
        if (used > 0 && used < PATH_MAX && stat(path, &status) == 0) return true;
    }
    return hs_fail(err, HS_EXIT_FILE,
                   "there is no page to fill, report/template.html beside the program; `make "
                   "report` makes it, or give one by --template");
}

/* "shape:hand, 8 views" */
static void name_page(char *title, size_t size, const json_t *data) {
    const json_t *run = json_object_get(data, "run"), *mesh = json_object_get(run, "mesh");
    const char *source = json_string_value(json_object_get(mesh, "source"));
    const char *name = source ? strrchr(source, '/') : NULL;
    const size_t views = json_array_size(json_object_get(run, "views"));
    snprintf(title, size, "%.200s, %zu view%s",
             name     ? name + 1
             : source ? source
                      : "a mesh",
             views, views == 1 ? "" : "s");
}

static void print_notes(const json_t *data) {
    const json_t *notes = json_object_get(data, "notes");
    for (size_t i = 0; i < json_array_size(notes); i++)
        fprintf(stderr, "note: %s\n", json_string_value(json_array_get(notes, i)));
}

static bool report(const request *r, hs_error *err) {
    char found[PATH_MAX], page[PATH_MAX], title[300];
    if (!r->template && !find_template(found, err)) return false;
    const int length = snprintf(page, sizeof page, "%s/report.html", r->data.folder);
    if (length < 0 || (size_t)length >= sizeof page)
        return hs_fail(err, HS_EXIT_FILE, "%.300s...: the name of this folder is too long",
                       r->data.folder);
    const char *out = r->out ? r->out : page;
    json_t *data = hs_report_folder(&r->data, err);
    if (!data) return false;
    if (!r->quiet) print_notes(data);
    name_page(title, sizeof title, data);
    const bool done = hs_report_html(out, r->template ? r->template : found, title, data, err);
    json_decref(data);
    if (done && !r->quiet && strcmp(out, "-") != 0) printf("report: %s\n", out);
    return done;
}

int hs_command_report(int argc, char **argv, hs_error *err) {
    request r;
    const enum hs_parsed parsed = parse(&r, argc, argv, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    return report(&r, err) ? HS_EXIT_OK : err->code;
}
