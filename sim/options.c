/* SPDX-License-Identifier: Apache-2.0 */
#include "options.h"

#include <ctype.h>
#include <errno.h>
#include <getopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "definitions.h"
#include "options_help.h"

enum { MOST_OPTIONS = 40, LONGEST_WORD = 40 };

/* --- Numbers ------------------------------------------------------------------------------------
 */

bool hs_number_parse(const char *text, uint32_t *number) {
    if (!isdigit((unsigned char)*text)) return false;
    char *end;
    errno = 0;
    const unsigned long long value = strtoull(text, &end, 10);
    if (errno || *end || value > UINT32_MAX) return false;
    *number = (uint32_t)value;
    return true;
}

bool hs_pair_parse(const char *text, char separator, uint32_t *first, uint32_t *second) {
    char head[16];
    const char *middle = strchr(text, separator);
    if (!middle || (size_t)(middle - text) >= sizeof head) return false;
    memcpy(head, text, (size_t)(middle - text));
    head[middle - text] = 0;
    return hs_number_parse(head, first) && hs_number_parse(middle + 1, second);
}

/* --- The nearest word ---------------------------------------------------------------------------
 */

/* The optimal string alignment distance, row by row. */
static unsigned distance(const char *a, const char *b) {
    const size_t m = strlen(a), n = strlen(b);
    if (m > LONGEST_WORD || n > LONGEST_WORD) return UINT32_MAX;
    unsigned d[LONGEST_WORD + 1][LONGEST_WORD + 1];
    for (unsigned i = 0; i <= m; i++)
        d[i][0] = i;
    for (unsigned j = 0; j <= n; j++)
        d[0][j] = j;
    for (size_t i = 1; i <= m; i++)
        for (size_t j = 1; j <= n; j++) {
            unsigned least = d[i - 1][j - 1] + (a[i - 1] != b[j - 1]);
            if (d[i - 1][j] + 1 < least) least = d[i - 1][j] + 1;
            if (d[i][j - 1] + 1 < least) least = d[i][j - 1] + 1;
            if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1] &&
                d[i - 2][j - 2] + 1 < least)
                least = d[i - 2][j - 2] + 1;
            d[i][j] = least;
        }
    return d[m][n];
}

const char *hs_nearest(const char *text, const char *const *word) {
    const char *nearest = NULL;
    unsigned best = UINT32_MAX;
    for (; *word; word++) {
        const size_t length = strlen(text);
        const bool begins = length >= 2 && strncmp(text, *word, length) == 0;
        const unsigned far = begins ? 1 : distance(text, *word);
        if (far < best) {
            best = far;
            nearest = *word;
        }
    }
    return nearest && best <= 1 + strlen(nearest) / 3 ? nearest : NULL;
}

int hs_part_run(const char *prefix, const hs_part *part, int argc, char **argv, hs_error *err) {
    enum { MOST = 16 };
    const char *name[MOST + 1] = {NULL};
    char list[300] = "";
    for (int i = 0; i < MOST && part[i].name; i++) {
        if (argc > 1 && strcmp(argv[1], part[i].name) == 0)
            return part[i].run(argc - 1, argv + 1, err);
        name[i] = part[i].name;
        snprintf(list + strlen(list), sizeof list - strlen(list), "%s%s", i ? ", " : "", name[i]);
    }
    static const char help[] = "--help";
    hs_help_form form;
    if (argc > 1 && (strcmp(argv[1], "-h") == 0 || strncmp(argv[1], help, strlen(help)) == 0) &&
        hs_help_form_parse(strchr(argv[1], '=') ? strchr(argv[1], '=') + 1 : NULL, &form)) {
        hs_help_print_parts(form, prefix, part);
        return HS_EXIT_OK;
    }
    const char *nearest = argc > 1 ? hs_nearest(argv[1], name) : NULL;
    if (argc < 2)
        hs_fail(err, HS_EXIT_USAGE, "%s: which of %s? `halfstep %s --help` explains", prefix, list,
                prefix);
    else if (nearest)
        hs_fail(err, HS_EXIT_USAGE, "%s: no command \"%.40s\"; did you mean \"%s\"?", prefix,
                argv[1], nearest);
    else
        hs_fail(err, HS_EXIT_USAGE, "%s: no command \"%.40s\"; there are %s", prefix, argv[1],
                list);
    return err->code;
}

/* --- Parsing ------------------------------------------------------------------------------------
 */

static bool take(const hs_command *command, const hs_option *o, const char *value, hs_error *err) {
    if (o->given) *o->given = true;
    switch (o->kind) {
    case HS_OPTION_FLAG:
        *(bool *)o->value = true;
        return true;
    case HS_OPTION_TEXT:
        if (!*value)
            return hs_fail(err, HS_EXIT_USAGE, "%s: --%s is empty; give it %s", command->name,
                           o->name, o->argument);
        *(const char **)o->value = value;
        return true;
    case HS_OPTION_LIST: {
        hs_option_list *list = o->value;
        if (!*value || list->count == HS_OPTION_LIST_ROOM)
            return hs_fail(err, HS_EXIT_USAGE, "%s: --%s is empty, or given too often",
                           command->name, o->name);
        list->text[list->count++] = value;
        return true;
    }
    case HS_OPTION_NUMBER:
        if (hs_number_parse(value, o->value) && *(uint32_t *)o->value >= o->least &&
            *(uint32_t *)o->value <= o->most)
            return true;
        return hs_fail(err, HS_EXIT_USAGE,
                       "%s: --%s is \"%.40s\"; it should be a number from %u to %u", command->name,
                       o->name, value, o->least, o->most);
    }
    return false;
}

static enum hs_parsed unknown(const hs_command *command, const hs_option *option, const char *word,
                              hs_error *err) {
    const char *name[MOST_OPTIONS + 2] = {"help"};
    size_t names = 1;
    for (const hs_option *o = option; o->name; o++)
        name[names++] = o->name;
    name[names] = NULL;
    char text[LONGEST_WORD + 1];
    snprintf(text, sizeof text, "%s", word + strspn(word, "-"));
    text[strcspn(text, "=")] = 0;
    const char *nearest = strlen(text) > 1 ? hs_nearest(text, name) : NULL;
    if (nearest)
        hs_fail(err, HS_EXIT_USAGE, "%s: no option \"%.40s\"; did you mean --%s?", command->name,
                word, nearest);
    else
        hs_fail(err, HS_EXIT_USAGE, "%s: no option \"%.40s\"; `halfstep %s --help` lists them",
                command->name, word, command->name);
    return HS_PARSED_WRONG;
}

enum hs_parsed hs_options_parse(const hs_command *command, const hs_option *option, int argc,
                                char **argv, int *operand, hs_error *err) {
    struct option table[MOST_OPTIONS + 2];
    char letters[2 * MOST_OPTIONS + 8] = ":h";
    int options = 0;
    for (; options < MOST_OPTIONS && option[options].name; options++) {
        const hs_option *o = &option[options];
        const bool flag = o->kind == HS_OPTION_FLAG;
        table[options] =
            (struct option){o->name, flag ? no_argument : required_argument, NULL, 256 + options};
        if (o->letter) {
            const char letter[3] = {o->letter, flag ? '\0' : ':', '\0'};
            strcat(letters, letter);
        }
    }
    table[options] = (struct option){"help", optional_argument, NULL, 'h'};
    table[options + 1] = (struct option){0};

    opterr = 0;
    optind = 0; /* glibc: start anew */
    for (;;) {
        const int code = getopt_long(argc, argv, letters, table, NULL);
        if (code == -1) break;
        if (code == 'h') {
            hs_help_form form;
            if (!hs_help_form_parse(optarg, &form)) {
                hs_fail(err, HS_EXIT_USAGE, "%s: --help takes no value", command->name);
                return HS_PARSED_WRONG;
            }
            hs_help_print(form, command, option);
            return HS_PARSED_HELP;
        }
        if (code == ':') {
            hs_fail(err, HS_EXIT_USAGE, "%s: %s needs a value", command->name, argv[optind - 1]);
            return HS_PARSED_WRONG;
        }
        if (code == '?') {
            const char letter[3] = {'-', (char)optopt, '\0'};
            const char *word = optopt ? letter : argv[optind - 1];
            if (optopt >= 256) {
                hs_fail(err, HS_EXIT_USAGE, "%s: --%s takes no value", command->name,
                        option[optopt - 256].name);
                return HS_PARSED_WRONG;
            }
            return unknown(command, option, word, err);
        }
        int index = code - 256;
        for (int i = 0; code < 256 && i < options; i++)
            if (option[i].letter == code) index = i;
        if (!take(command, &option[index], optarg, err)) return HS_PARSED_WRONG;
    }
    *operand = optind;
    const int operands = argc - optind;
    if (operands < command->least) {
        hs_fail(err, HS_EXIT_USAGE, "%s: %s is missing; usage: halfstep %s %s", command->name,
                operands ? "an operand" : command->operands, command->name, command->operands);
        return HS_PARSED_WRONG;
    }
    if (command->most >= 0 && operands > command->most) {
        hs_fail(err, HS_EXIT_USAGE, "%s: \"%.60s\" is one too many; usage: halfstep %s %s",
                command->name, argv[optind + command->most], command->name, command->operands);
        return HS_PARSED_WRONG;
    }
    return HS_PARSED;
}
