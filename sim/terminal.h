/* SPDX-License-Identifier: Apache-2.0
 *
 * What a terminal is given beside plain text: colours, where they are welcome, and lines that fit.
 */
#ifndef HS_TERMINAL_H
#define HS_TERMINAL_H

#include <stdbool.h>
#include <stdio.h>

#include "error.h"

/* Columns that help texts, tables and lists keep to. */
enum { HS_TERMINAL_COLUMNS = 80 };

typedef enum hs_colour { HS_PLAIN, HS_RED, HS_GREEN, HS_YELLOW } hs_colour;

/* Whether a stream takes colours: a terminal (TERM is set, and not to "dumb") whose user has not
 * set NO_COLOR to anything but nothing (no-color.org). */
bool hs_colours_welcome(FILE *stream);

/* Writes a text in a colour, or plainly where colours are not welcome; width as printf's %*s. */
void hs_print_coloured(FILE *stream, hs_colour colour, int width, const char *text);

/* Writes an error as every command does: "halfstep: TEXT", behind what standard output has. */
void hs_print_error(const hs_error *err);

/* Writes a text that begins in a column (from 0) and breaks lines between words, before
 * HS_TERMINAL_COLUMNS; lines after the first begin at indent. A '\n' is a space like others, unless
 * a space follows: then a row "  name   what" begins, whose later lines stand below "what". Ends
 * the last line. */
void hs_print_wrapped(FILE *stream, int column, int indent, const char *text);

/* Writes paragraphs, which empty lines part: one with a line that is too long is filled anew;
 * another, and lines that begin with a space, stay as they are. */
void hs_print_paragraphs(FILE *stream, const char *text);

#endif
