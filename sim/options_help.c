/* SPDX-License-Identifier: Apache-2.0 */
#include "options_help.h"

#include <stdio.h>
#include <string.h>

#include "terminal.h"

enum { OPTION_COLUMN = 30 };

static const hs_option HELP = {.name = "help", .letter = 'h', .what = "this text"};
static const char *const FORM_NAME[] = {"text", "bash", "zsh", "man"};

bool hs_help_form_parse(const char *text, hs_help_form *form) {
    *form = HS_HELP_TEXT;
    if (!text) return true;
    for (size_t i = 0; i < sizeof FORM_NAME / sizeof *FORM_NAME; i++)
        if (strcmp(text, FORM_NAME[i]) == 0) {
            *form = (hs_help_form)i;
            return true;
        }
    return false;
}

/* "info" of "mesh info". */
static const char *last_word(const char *name) {
    const char *space = strrchr(name, ' ');
    return space ? space + 1 : name;
}

/* --- Help ---------------------------------------------------------------------------------------
 */

static void text_option(const hs_option *o) {
    char letter[5] = "    ";
    if (o->letter) snprintf(letter, sizeof letter, "-%c, ", o->letter);
    int column = printf("  %s--%s%s%s", letter, o->name, o->argument ? " " : "",
                        o->argument ? o->argument : "");
    if (column >= OPTION_COLUMN) {
        printf("\n");
        column = 0;
    }
    printf("%*s", OPTION_COLUMN - column, "");
    hs_print_wrapped(stdout, OPTION_COLUMN, OPTION_COLUMN, o->what);
}

static void text_command(const hs_command *command, const hs_option *option) {
    printf("halfstep %s%s%s%s\n\n", command->name, *command->operands ? " " : "", command->operands,
           option->name ? " [options]" : "");
    char what[300];
    snprintf(what, sizeof what, "%s.", command->what);
    hs_print_wrapped(stdout, 0, 0, what);
    printf("\n");
    for (const hs_option *o = option; o->name; o++)
        text_option(o);
    text_option(&HELP);
    if (*command->text) printf("\n");
    hs_print_paragraphs(stdout, command->text);
}

/* --- Completion ---------------------------------------------------------------------------------
 * What a value can be follows from what help calls it: "0|1" is a choice, FILE and DIR are paths,
 * of the rest nothing is known.
 */

static bool is_choice(const char *argument) {
    return strchr(argument, '|') && !strstr(argument, "MESH");
}

static bool is_path(const char *argument) {
    return strstr(argument, "FILE") || strstr(argument, "DIR");
}

/* "0 1" of "0|1". */
static void print_choice(const char *argument) {
    for (; *argument; argument++)
        putchar(*argument == '|' ? ' ' : *argument);
}

static void bash_command(const hs_command *command, const hs_option *option) {
    printf("%s)\n    options='", last_word(command->name));
    for (const hs_option *o = option; o->name; o++)
        printf("--%s ", o->name);
    printf("--help'\n");
    if (is_choice(command->operands)) {
        printf("    [[ $word == -* ]] || values='");
        print_choice(command->operands);
        printf("'\n");
    }
    printf("    case $previous in\n");
    for (const hs_option *o = option; o->name; o++) {
        if (!o->argument) continue;
        printf("    --%s", o->name);
        if (o->letter) printf(" | -%c", o->letter);
        if (is_choice(o->argument)) {
            printf(") values='");
            print_choice(o->argument);
            printf("' ;;\n");
        } else {
            printf(") kind=%s ;;\n", is_path(o->argument) ? "path" : "none");
        }
    }
    printf("    esac\n    ;;\n");
}

/* The first line of a text, in a single-quoted '[...]' of zsh's _arguments. */
static void zsh_text(const char *text) {
    for (; *text && *text != '\n'; text++)
        if (*text == '\'')
            printf("'\\''");
        else if (strchr("[]:\\", *text))
            printf("\\%c", *text);
        else
            putchar(*text);
}

static void zsh_option(const hs_option *o) {
    printf("        ");
    if (o->kind == HS_OPTION_LIST)
        printf("'*'");
    else if (o->letter)
        printf("'(-%c --%s)'", o->letter, o->name);
    if (o->letter)
        printf("{-%c,--%s}'", o->letter, o->name);
    else
        printf("'--%s", o->name);
    printf("[");
    zsh_text(o->what);
    printf("]");
    if (o->argument) {
        printf(":");
        zsh_text(o->argument);
        if (is_choice(o->argument)) {
            printf(":(");
            print_choice(o->argument);
            printf(")");
        } else {
            printf(is_path(o->argument) ? ":_files" : ": ");
        }
    }
    printf("' \\\n");
}

static void zsh_command(const hs_command *command, const hs_option *option) {
    printf("%s)\n    _arguments -s -S \\\n", last_word(command->name));
    for (const hs_option *o = option; o->name; o++)
        zsh_option(o);
    zsh_option(&HELP);
    if (is_choice(command->operands)) {
        printf("        '1:which:(");
        print_choice(command->operands);
        printf(")'\n    ;;\n");
    } else if (*command->operands) {
        printf("        '*:");
        zsh_text(command->operands);
        printf(":_halfstep_operand'\n    ;;\n");
    } else {
        printf("        && return\n    ;;\n");
    }
}

void hs_help_print_zsh(const hs_part *part) {
    printf("        '%s:", part->name);
    zsh_text(part->what);
    printf("'\n");
}

static void shell_parts(hs_help_form form, const char *prefix, const hs_part *part) {
    printf("%s)\n", prefix);
    if (form == HS_HELP_BASH) {
        printf("    parts='");
        for (const hs_part *p = part; p->name; p++)
            printf("%s ", p->name);
        printf("--help'\n    case $part in\n");
    } else {
        printf("    if ((CURRENT == 2)); then\n        local -a parts=(\n");
        for (const hs_part *p = part; p->name; p++)
            hs_help_print_zsh(p);
        printf("        )\n        _describe part parts\n        return\n    fi\n"
               "    shift words\n    ((CURRENT--))\n    case $words[1] in\n");
    }
}

/* --- The man page -------------------------------------------------------------------------------
 */

void hs_help_print_roff(const char *text) {
    bool begins = true;
    for (; *text; text++) {
        if (begins && (*text == '.' || *text == '\'')) printf("\\&");
        begins = *text == '\n';
        if (*text == '\\')
            printf("\\e");
        else if (*text == '-')
            printf("\\-");
        else
            putchar(*text);
    }
}

static void man_option(const hs_option *o) {
    printf(".TP\n");
    if (o->letter) printf("\\fB\\-%c\\fR, ", o->letter);
    printf("\\fB\\-\\-");
    hs_help_print_roff(o->name);
    printf("\\fR");
    if (o->argument) {
        printf(" \\fI");
        hs_help_print_roff(o->argument);
        printf("\\fR");
    }
    printf("\n");
    hs_help_print_roff(o->what);
    if (!*o->what || o->what[strlen(o->what) - 1] != '\n') printf("\n");
}

static void man_command(const hs_command *command, const hs_option *option) {
    printf(".SS halfstep %s", command->name);
    if (*command->operands) {
        printf(" \\fI");
        hs_help_print_roff(command->operands);
        printf("\\fR");
    }
    printf("%s\n", option->name ? " [options]" : "");
    hs_help_print_roff(command->what);
    printf(".\n");
    for (const hs_option *o = option; o->name; o++)
        man_option(o);
    if (!*command->text) return;
    printf(".PP\n.nf\n");
    hs_help_print_roff(command->text);
    printf(".fi\n");
}

/* --- Which of them ------------------------------------------------------------------------------
 */

void hs_help_print(hs_help_form form, const hs_command *command, const hs_option *option) {
    static void (*const print[])(const hs_command *, const hs_option *) = {
        text_command, bash_command, zsh_command, man_command};
    print[form](command, option);
}

void hs_help_print_parts(hs_help_form form, const char *prefix, const hs_part *part) {
    if (form == HS_HELP_TEXT) {
        for (const hs_part *p = part; p->name; p++) {
            const int column = printf("  halfstep %s %-8s ", prefix, p->name);
            hs_print_wrapped(stdout, column, column, p->what);
        }
        printf("\n`halfstep %s %s --help`, and so on, explain each by examples.\n", prefix,
               part->name);
        return;
    }
    if (form != HS_HELP_MAN) shell_parts(form, prefix, part);
    for (const hs_part *p = part; p->name; p++) {
        char name[40], help[20];
        snprintf(name, sizeof name, "%s", p->name);
        snprintf(help, sizeof help, "--help=%s", FORM_NAME[form]);
        char *argv[] = {name, help, NULL};
        hs_error err = {0};
        p->run(2, argv, &err);
    }
    if (form != HS_HELP_MAN) printf("    esac\n    ;;\n");
}
