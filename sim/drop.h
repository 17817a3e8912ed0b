/* SPDX-License-Identifier: Apache-2.0
 *
 * Final faces that nobody sees, left out of what is written: --drop of run (mesh.obj) and convert.
 * The stream keeps them: it is the pipeline's, and others check it word by word.
 */
#ifndef HS_DROP_H
#define HS_DROP_H

#include "stream.h"

typedef struct hs_drop {
    bool offscreen; /* all corners beyond one of the view volume's six planes: x>w, x<-w, ... */
    bool back;      /* no corner has a positive determinant; zero counts as back */
} hs_drop;

/* Row of a table of options; to is a const char *. */
#define HS_DROP_OPTION(to, where)                                                                  \
    {                                                                                              \
        "drop", 0, HS_OPTION_TEXT, "LIST", &(to), 0, 0, NULL,                                      \
            "leave faces out of " where ": offscreen, back"                                        \
    }

/* Reads a list as in "offscreen,back" (HS_EXIT_USAGE); NULL: nothing. */
bool hs_drop_parse(const char *list, hs_drop *drop, hs_error *err);

typedef struct hs_dropped {
    uint32_t faces, offscreen, back, vertices; /* there were, left out (as the first that holds),
                                                  vertices that no face uses any more */
} hs_dropped;

/* Leaves faces out of an output, and the vertices that no other face uses; what stays keeps its
 * order. Both tests are classify's, exact, on the positions as they were sent: rounded to
 * binary32. A face that is partly on screen, or has one corner to the front, stays. False when
 * memory is exhausted; then *output is as it was. */
bool hs_output_drop(hs_output *output, const hs_drop *drop, hs_dropped *dropped, hs_error *err);

#endif
