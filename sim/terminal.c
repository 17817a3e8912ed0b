/* SPDX-License-Identifier: Apache-2.0 */
#include "terminal.h"

#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* --- Colours ------------------------------------------------------------------------------------
 */

bool hs_colours_welcome(FILE *stream) {
    const char *no = getenv("NO_COLOR"), *term = getenv("TERM");
    return (!no || !*no) && term && *term && strcmp(term, "dumb") != 0 && isatty(fileno(stream));
}

void hs_print_coloured(FILE *stream, hs_colour colour, int width, const char *text) {
    static const int code[] = {[HS_RED] = 31, [HS_GREEN] = 32, [HS_YELLOW] = 33};
    if (colour == HS_PLAIN || !hs_colours_welcome(stream))
        fprintf(stream, "%*s", width, text);
    else
        fprintf(stream, "\033[%dm%*s\033[0m", code[colour], width, text);
}

void hs_print_error(const hs_error *err) {
    fflush(stdout);
    hs_print_coloured(stderr, HS_RED, 0, "halfstep:");
    fprintf(stderr, " %s\n", err->text);
}

/* --- Lines that fit -----------------------------------------------------------------------------
 */

/* Where the second column of a row "  name   what" begins. */
static int second_column(const char *row) {
    size_t at = strspn(row, " ");
    at += strcspn(row + at, " \n");
    return (int)(at + strspn(row + at, " "));
}

void hs_print_wrapped(FILE *stream, int column, int indent, const char *text) {
    int hanging = indent;
    bool first = true; /* word of its line */
    while (*text && strcmp(text, "\n") != 0) {
        if (text[0] == '\n' && text[1] == ' ') {
            text++;
            fprintf(stream, "\n%*s", indent, "");
            column = indent;
            hanging = indent + second_column(text);
            first = true;
            continue;
        }
        const int spaces = (int)strspn(text, *text == '\n' ? "\n" : " ");
        const int word = (int)strcspn(text + spaces, " \n");
        if (!first && column + spaces + word > HS_TERMINAL_COLUMNS) {
            fprintf(stream, "\n%*s", hanging, "");
            column = hanging;
        } else {
            fprintf(stream, "%*s", spaces, "");
            column += spaces;
        }
        fprintf(stream, "%.*s", word, text + spaces);
        column += word;
        text += spaces + word;
        first = false;
    }
    fputc('\n', stream);
}

/* The lines from text on that make a paragraph to fill: none begins with a space or is empty, one
 * is too long. 0: the first line is none of these. */
static size_t to_fill(const char *text) {
    size_t size = 0;
    bool too_long = false;
    while (text[size] && text[size] != ' ' && text[size] != '\n') {
        const size_t length = strcspn(text + size, "\n");
        too_long = too_long || length > HS_TERMINAL_COLUMNS;
        size += length + (text[size + length] == '\n');
    }
    return too_long ? size : 0;
}

void hs_print_paragraphs(FILE *stream, const char *text) {
    while (*text) {
        size_t size = to_fill(text);
        if (!size) {
            size = strcspn(text, "\n");
            fprintf(stream, "%.*s\n", (int)size, text);
            text += size + (text[size] == '\n');
            continue;
        }
        char *line = strndup(text, size);
        if (!line) return;
        for (char *c = line; *c; c++)
            if (*c == '\n') *c = ' ';
        if (line[size - 1] == ' ') line[size - 1] = 0;
        hs_print_wrapped(stream, 0, 0, line);
        free(line);
        text += size;
    }
}
