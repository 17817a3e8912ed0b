/* SPDX-License-Identifier: Apache-2.0
 *
 * Command lines as tables: a command lists its options with the places where their values go;
 * parsing (getopt_long's), range checks, help texts and the nearest valid word for one that is
 * unknown follow from the table.
 */
#ifndef HS_OPTIONS_H
#define HS_OPTIONS_H

#include "error.h"

#include <stddef.h>
#include <stdint.h>

#define HS_VERSION "0.1.0"

enum hs_option_kind {
    HS_OPTION_FLAG,   /* value: bool *, becomes true */
    HS_OPTION_TEXT,   /* value: const char **, points into argv */
    HS_OPTION_NUMBER, /* value: uint32_t *, least to most */
    HS_OPTION_LIST,   /* value: hs_option_list *; may be given several times */
};

enum { HS_OPTION_LIST_ROOM = 64 };
typedef struct hs_option_list {
    const char *text[HS_OPTION_LIST_ROOM]; /* point into argv */
    uint32_t count;
} hs_option_list;

typedef struct hs_option {
    const char *name; /* without the dashes */
    char letter;      /* short form, or 0 */
    enum hs_option_kind kind;
    const char *argument; /* what help calls its value; NULL for a flag */
    void *value;
    uint32_t least, most; /* of a number */
    bool *given;          /* set when the option is there; may be NULL */
    const char *what;     /* for help; lines end with '\n' and are indented there */
} hs_option;

/* A command or one of its subcommands. */
typedef struct hs_command {
    const char *name;     /* "run", "mesh info": as typed behind halfstep */
    const char *operands; /* "MESH", "FILE [FILE...]"; "" if there are none */
    int least, most;      /* number of operands; most -1: any */
    const char *what;     /* one line, no full stop */
    const char *text;     /* behind the options in help: examples, notes; may be "" */
} hs_command;

enum hs_parsed { HS_PARSED, HS_PARSED_HELP, HS_PARSED_WRONG };

/* Parses argv[1..]. Options may stand anywhere; a name may be shortened while it is unique.
 * option ends with a NULL name. The operands end up in argv[*operand .. argc-1]. --help (and -h)
 * prints the help to stdout, --help=FORM (options_help.h) another form of it, and gives
 * HS_PARSED_HELP. Otherwise, if the line is wrong, *err says
 * how it should be (HS_EXIT_USAGE). */
enum hs_parsed hs_options_parse(const hs_command *command, const hs_option *option, int argc,
                                char **argv, int *operand, hs_error *err);

/* Reads a decimal number of at most 32 bits, nothing around it. */
bool hs_number_parse(const char *text, uint32_t *number);

/* Reads two numbers with a separator between them, as in 640x480 or 100:200. */
bool hs_pair_parse(const char *text, char separator, uint32_t *first, uint32_t *second);

/* The word of a NULL-terminated list that is nearest to text, in the number of letters to add,
 * drop, change or swap; NULL if none is near. */
const char *hs_nearest(const char *text, const char *const *word);

/* A command of the program, or a part of a command, as in "mesh info". */
typedef struct hs_part {
    const char *name;
    int (*run)(int argc, char **argv, hs_error *err);
    const char *what; /* one line, no full stop */
} hs_part;

/* Runs the part that argv[1] names; the list ends with a NULL name. --help lists the parts. Gives
 * the exit code, with *err if there is no such part. */
int hs_part_run(const char *prefix, const hs_part *part, int argc, char **argv, hs_error *err);

#endif
