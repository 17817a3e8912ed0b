/* SPDX-License-Identifier: Apache-2.0
 *
 * What a shell and its user are told of all commands: `halfstep --help`, `halfstep completion`,
 * `halfstep man`. Each puts together what every command says of itself.
 */
#include <stdio.h>
#include <string.h>

#include "commands.h"
#include "definitions.h"
#include "options_help.h"
#include "shape.h"
#include "terminal.h"

static const char SUMMARY[] = "view-dependent sqrt(2)-subdivision in hardware";

static const char BEGIN[] =
    "  halfstep run shape:hand --orbit 4 --out out/hand\n"
    "      streams a hand through the rtl from four viewpoints, compares every word\n"
    "      that comes out with the golden model, draws pictures in out/hand\n"
    "  halfstep mesh info MESH.obj\n"
    "      says what a mesh is like, or what is wrong with it\n";

/* --- Help ---------------------------------------------------------------------------------------
 */

void hs_print_help(const hs_part *command) {
    printf("halfstep: %s\n\n  halfstep COMMAND [options]\n\n", SUMMARY);
    for (const hs_part *c = command; c->name; c++) {
        const int column = printf("  %-10s ", c->name);
        hs_print_wrapped(stdout, column, column, c->what);
    }
    printf("\n"
           "  halfstep COMMAND --help      explains a command by examples\n"
           "  halfstep --version\n\n"
           "To begin with:\n%s\nExit codes:\n",
           BEGIN);
    for (int code = 0; hs_exit_what(code); code++)
        printf("  %d  %s\n", code, hs_exit_what(code));
}

/* All commands in a form, each by itself. */
static void print_commands(const char *help, const hs_part *command) {
    for (const hs_part *c = command; c->name; c++) {
        char name[40], form[20];
        snprintf(name, sizeof name, "%s", c->name);
        snprintf(form, sizeof form, "%s", help);
        char *argv[] = {name, form, NULL};
        hs_error err = {0};
        c->run(2, argv, &err);
    }
}

/* --- Completion ---------------------------------------------------------------------------------
 */

/* bash parts words at colons, so of shape:NAME[:SIZE] the name may stand alone. */
static void print_bash(const hs_part *command) {
    printf("# bash completion for halfstep, from `halfstep completion bash`\n"
           "_halfstep() {\n"
           "local word=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD - 1]}\n"
           "local command=${COMP_WORDS[1]} part=${COMP_WORDS[2]}\n"
           "local options= parts= values= kind=operand shapes='");
    for (const hs_shape *s = hs_shapes; s->name; s++)
        printf("%s%s", s == hs_shapes ? "" : " ", s->name);
    printf("'\n"
           "COMPREPLY=()\n"
           "if [ \"$COMP_CWORD\" -eq 1 ]; then\n"
           "    COMPREPLY=($(compgen -W '");
    for (const hs_part *c = command; c->name; c++)
        printf("%s ", c->name);
    printf("--help --version' -- \"$word\"))\n"
           "    return\n"
           "fi\n"
           "case $command in\n");
    print_commands("--help=bash", command);
    printf("esac\n"
           "[ -z \"$parts\" ] || [ \"$COMP_CWORD\" -ne 2 ] || values=$parts\n"
           "if [ \"$word\" = : ]; then\n"
           "    COMPREPLY=($shapes)\n"
           "elif [ \"$previous\" = : ]; then\n"
           "    COMPREPLY=($(compgen -W \"$shapes\" -- \"$word\"))\n"
           "elif [ -n \"$values\" ]; then\n"
           "    COMPREPLY=($(compgen -W \"$values\" -- \"$word\"))\n"
           "elif [ $kind = none ]; then\n"
           "    COMPREPLY=()\n"
           "elif [ $kind = operand ] && [ \"${word:0:1}\" = - ]; then\n"
           "    COMPREPLY=($(compgen -W \"$options\" -- \"$word\"))\n"
           "else\n"
           "    compopt -o filenames 2>/dev/null\n"
           "    COMPREPLY=($(compgen -f -- \"$word\"))\n"
           "    case $kind$word in\n"
           "    operandshape:*) COMPREPLY=($(compgen -P shape: -W \"$shapes\" -- "
           "\"${word#shape:}\")) ;;\n"
           "    operands*)\n"
           "        [[ shape: != \"$word\"* ]] || {\n"
           "            compopt -o nospace 2>/dev/null\n"
           "            COMPREPLY+=(shape:)\n"
           "        }\n"
           "        ;;\n"
           "    esac\n"
           "fi\n"
           "}\n"
           "complete -F _halfstep halfstep\n");
}

static void print_zsh(const hs_part *command) {
    printf("#compdef halfstep\n"
           "# zsh completion for halfstep, from `halfstep completion zsh`\n"
           "_halfstep_operand() {\n"
           "    local -a shapes=(");
    for (const hs_shape *s = hs_shapes; s->name; s++)
        printf("%sshape:%s", s == hs_shapes ? "" : " ", s->name);
    printf(")\n"
           "    _alternative 'files:file:_files' 'shapes:shape:compadd -a shapes'\n"
           "}\n"
           "_halfstep() {\n"
           "if ((CURRENT == 2)); then\n"
           "    local -a commands=(\n");
    for (const hs_part *c = command; c->name; c++)
        hs_help_print_zsh(c);
    printf("    )\n"
           "    _describe command commands\n"
           "    return\n"
           "fi\n"
           "shift words\n"
           "((CURRENT--))\n"
           "case $words[1] in\n");
    print_commands("--help=zsh", command);
    printf("esac\n"
           "}\n"
           "if [ \"$funcstack[1]\" = _halfstep ]; then _halfstep \"$@\"; else compdef _halfstep "
           "halfstep; fi\n");
}

int hs_command_completion(const hs_part *command, int argc, char **argv, hs_error *err) {
    static const hs_command self = {"completion",
                                    "bash|zsh",
                                    1,
                                    1,
                                    "Prints what completes commands, options and shapes in a shell",
                                    "  . <(halfstep completion bash)\n"
                                    "      for this bash; `make install` installs it for all\n"
                                    "  halfstep completion zsh >~/.zsh/_halfstep\n"
                                    "      into a folder of $fpath, before compinit\n"};
    const hs_option option[] = {{0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&self, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    if (strcmp(argv[operand], "bash") == 0) {
        print_bash(command);
    } else if (strcmp(argv[operand], "zsh") == 0) {
        print_zsh(command);
    } else {
        hs_fail(err, HS_EXIT_USAGE, "completion: no shell \"%.40s\"; there are bash and zsh",
                argv[operand]);
        return err->code;
    }
    return HS_EXIT_OK;
}

/* --- The man page -------------------------------------------------------------------------------
 */

static void print_man(const hs_part *command) {
    printf(".TH HALFSTEP 1 \"\" \"halfstep " HS_VERSION "\" \"User Commands\"\n"
           ".SH NAME\nhalfstep \\- ");
    hs_help_print_roff(SUMMARY);
    printf("\n.SH SYNOPSIS\n.B halfstep\n.I COMMAND\n[options]\n.br\n"
           ".B halfstep\n.I COMMAND\n.B \\-\\-help\n.br\n.B halfstep \\-\\-version\n"
           ".SH DESCRIPTION\n"
           "A polygon mesh and a viewpoint go in; the mesh streams through simulated hardware,\n"
           "which refines it only where that view needs it. Commands:\n");
    for (const hs_part *c = command; c->name; c++) {
        printf(".TP\n.B %s\n", c->name);
        hs_help_print_roff(c->what);
        printf("\n");
    }
    printf(".PP\nTo begin with:\n.PP\n.nf\n");
    hs_help_print_roff(BEGIN);
    printf(".fi\n.SH COMMANDS\n");
    print_commands("--help=man", command);
    printf(".SH EXIT STATUS\n");
    for (int code = 0; hs_exit_what(code); code++) {
        printf(".TP\n.B %d\n", code);
        hs_help_print_roff(hs_exit_what(code));
        printf("\n");
    }
    printf(".SH ENVIRONMENT\n.TP\n.B NO_COLOR\n"
           "If it is set and not empty, nothing is coloured; colours are for terminals alone, and\n"
           "not for those whose\n.B TERM\nis dumb.\n");
}

int hs_command_man(const hs_part *command, int argc, char **argv, hs_error *err) {
    static const hs_command self = {"man",
                                    "",
                                    0,
                                    0,
                                    "Prints the manual page, with every command and option",
                                    "  halfstep man | man -l -\n"};
    const hs_option option[] = {{0}};
    int operand;
    const enum hs_parsed parsed = hs_options_parse(&self, option, argc, argv, &operand, err);
    if (parsed == HS_PARSED_HELP) return HS_EXIT_OK;
    if (parsed == HS_PARSED_WRONG) return err->code;
    print_man(command);
    return HS_EXIT_OK;
}
