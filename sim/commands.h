/* SPDX-License-Identifier: Apache-2.0
 *
 * The commands of halfstep. Each gets its part of the command line, argv[0] being its name, does
 * its work, and returns the exit code. What went wrong is in *err, which main prints if it has a
 * text; a command may have told it itself.
 */
#ifndef HS_COMMANDS_H
#define HS_COMMANDS_H

#include "error.h"
#include "options.h"

int hs_command_run(int argc, char **argv, hs_error *err);
int hs_command_mesh(int argc, char **argv, hs_error *err);
int hs_command_trace(int argc, char **argv, hs_error *err);
int hs_command_explore(int argc, char **argv, hs_error *err);
int hs_command_render(int argc, char **argv, hs_error *err);
int hs_command_convert(int argc, char **argv, hs_error *err);
int hs_command_explain(int argc, char **argv, hs_error *err);
int hs_command_report(int argc, char **argv, hs_error *err);

/* These tell of all commands; the list ends with a NULL name. */
int hs_command_completion(const hs_part *command, int argc, char **argv, hs_error *err);
int hs_command_man(const hs_part *command, int argc, char **argv, hs_error *err);
void hs_print_help(const hs_part *command);

#endif
