/* SPDX-License-Identifier: Apache-2.0
 *
 * Which program, and on which machine: for reports.
 */
#ifndef HS_MACHINE_H
#define HS_MACHINE_H

#include <stdint.h>

/* The program. main says what it was built from; tests leave it as it is. */
typedef struct hs_program_info {
    const char *name;      /* as it was called, to call it again */
    const char *commit;    /* a + behind it: of changed files */
    const char *compiler;  /* of the C code */
    const char *simulator; /* of the RTL */
} hs_program_info;
extern hs_program_info hs_program;

typedef struct hs_machine {
    char system[300];    /* "Linux 6.1.0 x86_64" */
    char processor[200]; /* "" if it is not known */
    uint32_t cores;      /* that this process may use */
    uint64_t memory;     /* bytes; 0 if it is not known */
} hs_machine;

void hs_machine_read(hs_machine *machine);

#endif
