/* SPDX-License-Identifier: Apache-2.0
 *
 * One table of options, told in four ways: as help, as a branch of a shell's completion, as a part
 * of the man page. `--help=FORM`, given to any command, prints the form; `halfstep completion` and
 * `halfstep man` put them together, so that neither can miss a command or an option.
 */
#ifndef HS_OPTIONS_HELP_H
#define HS_OPTIONS_HELP_H

#include "options.h"

typedef enum hs_help_form { HS_HELP_TEXT, HS_HELP_BASH, HS_HELP_ZSH, HS_HELP_MAN } hs_help_form;

/* Reads what stands behind "--help=": text, bash, zsh or man; NULL is text. False if none. */
bool hs_help_form_parse(const char *text, hs_help_form *form);

/* Prints a command. In bash's and zsh's forms it is a branch of a `case`; which is that of the
 * command's last word. */
void hs_help_print(hs_help_form form, const hs_command *command, const hs_option *option);

/* Prints a command that has parts, and all of them: by calling each with --help=FORM. */
void hs_help_print_parts(hs_help_form form, const char *prefix, const hs_part *part);

/* Prints a command's name and what it does as zsh's _describe wants them, a line. */
void hs_help_print_zsh(const hs_part *part);

/* Prints a text for the man page: what would be an escape or a request is none. */
void hs_help_print_roff(const char *text);

#endif
