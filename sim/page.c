/* SPDX-License-Identifier: Apache-2.0 */
#include "page.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "commands.h"
#include "definitions.h"
#include "json_file.h"
#include "picture.h"

static const char COMMAND[] = "    build/halfstep render ";
#define OPENING "<!--"
#define CLOSING "-->"

/* Where the page is read, and the numbers of the command read last. */
typedef struct place {
    const char *name;
    uint32_t line;
    json_t *numbers; /* NULL: no command so far */
} place;

/* Puts page and line before what went wrong. */
static bool fail_here(const place *at, hs_error *err) {
    char text[sizeof err->text];
    memcpy(text, err->text, sizeof text);
    return hs_fail(err, err->code, "%.200s:%u: %.600s", at->name, at->line, text);
}

/* --- Commands ----------------------------------------------------------------------------------
 */

/* Runs a line's command with its numbers going to scratch, and reads them. */
static bool run_command(place *at, const char *line, bool draw, const char *scratch,
                        hs_error *err) {
    enum { WORDS = 40, LETTERS = 1000 };
    char copy[LETTERS], *rest = copy, *word[WORDS + 5];
    int words = 0;
    if (strlen(line) >= LETTERS)
        return hs_fail(err, HS_EXIT_USAGE, "the command is longer than %d letters", LETTERS - 1);
    strcpy(copy, line);
    char render[] = "render", quiet[] = "--quiet", json[] = "--json";
    word[words++] = render;
    word[words++] = quiet;
    for (char *next; words < WORDS && (next = strsep(&rest, " ")) != NULL;) {
        if (!draw && strcmp(next, "-o") == 0)
            strsep(&rest, " ");
        else if (*next)
            word[words++] = next;
    }
    if (rest) return hs_fail(err, HS_EXIT_USAGE, "the command has more than %d words", WORDS - 2);
    char *file = strdup(scratch);
    word[words++] = json;
    word[words++] = file;
    word[words] = NULL;
    bool done = file ? hs_command_render(words, word, err) == HS_EXIT_OK
                     : hs_fail(err, HS_EXIT_INTERNAL, "no memory for a command");
    free(file);
    json_decref(at->numbers);
    at->numbers = NULL;
    if (!done) return false;
    json_error_t wrong;
    at->numbers = json_load_file(scratch, 0, &wrong);
    return at->numbers || hs_fail(err, HS_EXIT_FILE, "%.200s: %.150s", scratch, wrong.text);
}

/* --- Numbers -----------------------------------------------------------------------------------
 */

/* The length of a number's name: small letters, digits, dots; 0: it is another comment. */
static size_t length_of_key(const char *key) {
    const size_t length = strspn(key, "abcdefghijklmnopqrstuvwxyz0123456789.");
    return strncmp(key + length, CLOSING, strlen(CLOSING)) == 0 ? length : 0;
}

static bool look_up(uint64_t *number, const place *at, const char *key, size_t length,
                    hs_error *err) {
    char copy[100] = "", *rest = copy;
    if (!at->numbers)
        return hs_fail(err, HS_EXIT_USAGE, "no command stands before \"%.*s\"", (int)length, key);
    if (length < sizeof copy) memcpy(copy, key, length);
    json_t *value = at->numbers;
    for (char *part; (part = strsep(&rest, ".")) != NULL;)
        value = json_is_array(value) && *part >= '0' && *part <= '9'
                    ? json_array_get(value, strtoul(part, NULL, 10))
                    : json_object_get(value, part);
    if (!json_is_integer(value))
        return hs_fail(err, HS_EXIT_USAGE,
                       "the command above gives no number \"%.*s\"; its --json has all there are",
                       (int)(length < 100 ? length : 100), key);
    *number = (uint64_t)json_integer_value(value);
    return true;
}

/* Copies a line of text, numbers renewed. */
static bool copy_line(FILE *to, const place *at, const char *line, hs_error *err) {
    const char *from = line;
    for (const char *found; (found = strstr(from, OPENING)) != NULL;) {
        const char *key = found + strlen(OPENING);
        const size_t length = length_of_key(key);
        const char *behind = key + length + (length ? strlen(CLOSING) : 0);
        fwrite(from, 1, (size_t)(behind - from), to);
        from = behind;
        if (!length) continue;
        uint64_t number = 0;
        char text[HS_COUNT_TEXT];
        if (!look_up(&number, at, key, length, err)) return false;
        fputs(hs_count_text(text, number), to);
        /* A comma belongs to the number if a digit follows. */
        while ((*from >= '0' && *from <= '9') || (*from == ',' && from[1] >= '0' && from[1] <= '9'))
            from++;
    }
    fputs(from, to);
    return true;
}

/* --- The page ----------------------------------------------------------------------------------
 */

bool hs_page_update(char **updated, const char *name, const char *text, bool draw,
                    const char *scratch, hs_error *err) {
    place at = {.name = name};
    size_t size;
    *updated = NULL;
    char *copy = strdup(text), *rest = copy;
    FILE *to = copy ? open_memstream(updated, &size) : NULL;
    bool done = to != NULL || hs_fail(err, HS_EXIT_INTERNAL, "no memory for %.300s", name);
    for (char *line; done && (line = strsep(&rest, "\n")) != NULL;) {
        at.line++;
        if (strncmp(line, COMMAND, strlen(COMMAND)) == 0)
            done = run_command(&at, line + strlen(COMMAND), draw, scratch, err);
        done = done && copy_line(to, &at, line, err);
        if (!done) fail_here(&at, err);
        if (done && rest) fputc('\n', to);
    }
    if (to && fclose(to) != 0 && done)
        done = hs_fail(err, HS_EXIT_INTERNAL, "no memory for %.300s", name);
    if (!done) {
        free(*updated);
        *updated = NULL;
    }
    json_decref(at.numbers);
    free(copy);
    return done;
}
