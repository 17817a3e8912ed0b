/* SPDX-License-Identifier: Apache-2.0 */
#include "report_html.h"

#include <stdlib.h>
#include <string.h>

#include "definitions.h"
#include "file.h"

enum { MOST_TEMPLATE = 64 << 20 };

/* The only place where a mark stands; NULL: none, or several. */
static const char *only_place(const char *text, const char *mark) {
    const char *at = strstr(text, mark);
    return at && !strstr(at + 1, mark) ? at : NULL;
}

static void write_escaped(const char *text, FILE *out) {
    for (; *text; text++)
        switch (*text) {
        case '<':
            fputs("&lt;", out);
            break;
        case '>':
            fputs("&gt;", out);
            break;
        case '&':
            fputs("&amp;", out);
            break;
        case '"':
            fputs("&quot;", out);
            break;
        case '\'':
            fputs("&#39;", out);
            break;
        default:
            fputc(*text, out);
        }
}

/* Inside a script element that holds data, only "</script" and "<!--" mean something. */
static int write_json(const char *text, size_t size, void *out) {
    const char *end = text + size;
    while (text < end) {
        const char *less = memchr(text, '<', (size_t)(end - text));
        const size_t plain = (size_t)((less ? less : end) - text);
        if (fwrite(text, 1, plain, out) != plain) return -1;
        if (less && fputs("\\u003c", out) < 0) return -1;
        text += plain + (less != NULL);
    }
    return 0;
}

static bool fill(hs_file *file, const char *text, const char *title_at, const char *title,
                 const char *data_at, const json_t *data, hs_error *err) {
    FILE *out = file->stream;
    const char *rest = data_at + strlen(HS_REPORT_DATA);
    fwrite(text, 1, (size_t)(title_at - text), out);
    write_escaped(title, out);
    title_at += strlen(HS_REPORT_TITLE);
    fwrite(title_at, 1, (size_t)(data_at - title_at), out);
    /* 17 digits bring every double back. */
    const bool good =
        json_dump_callback(data, write_json, out, JSON_COMPACT | JSON_REAL_PRECISION(17)) == 0;
    fwrite(rest, 1, strlen(rest), out);
    if (good || ferror(out)) return hs_file_commit(file, err);
    hs_file_abandon(file);
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the page");
}

bool hs_report_html(const char *path, const char *template_path, const char *title,
                    const json_t *data, hs_error *err) {
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(template_path, MOST_TEMPLATE, &bytes, &size, err)) return false;
    const char *text = (const char *)bytes;
    const char *title_at = only_place(text, HS_REPORT_TITLE);
    const char *data_at = only_place(text, HS_REPORT_DATA);
    hs_file file;
    const bool good =
        title_at && data_at && title_at < data_at && strlen(text) == size
            ? hs_file_create(&file, path, err) &&
                  fill(&file, text, title_at, title, data_at, data, err)
            : hs_fail(err, HS_EXIT_FILE,
                      "%.300s: is no template of a report: %s and %s should stand in it once each; "
                      "`make report` makes one",
                      template_path, HS_REPORT_TITLE, HS_REPORT_DATA);
    free(bytes);
    return good;
}
