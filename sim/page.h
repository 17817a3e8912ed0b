/* SPDX-License-Identifier: Apache-2.0
 *
 * A page of documentation whose pictures and numbers come from the program. The page itself says
 * how: an indented line
 *
 *     build/halfstep render shape:hand --what triptych -o docs/figures/9-hand.png
 *
 * is a command, and in the text below it, up to the next such line, a comment names a number of
 * what the command shows (its --json), which stands behind it: <!--panels.1.faces-->29,652.
 */
#ifndef HS_PAGE_H
#define HS_PAGE_H

#include "error.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Runs a page's commands and gives the page with their numbers in it, from malloc. name: of the
 * page, for messages. draw: commands draw their pictures, too; otherwise they only count. scratch:
 * a file for a command's numbers, which is written over and left behind. False, with page and line:
 * a command fails (its exit code), or there is no number of that name (HS_EXIT_USAGE). */
bool hs_page_update(char **updated, const char *name, const char *text, bool draw,
                    const char *scratch, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
