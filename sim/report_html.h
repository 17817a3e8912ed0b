/* SPDX-License-Identifier: Apache-2.0
 *
 * The page of halfstep report: a template (sim/report/, bundled into one file by esbuild) with two
 * places to fill, its title and its data.
 */
#ifndef HS_REPORT_HTML_H
#define HS_REPORT_HTML_H

#include <jansson.h>

#include "error.h"

/* Each stands in the template once. */
#define HS_REPORT_TITLE "@HALFSTEP_TITLE@"
#define HS_REPORT_DATA  "@HALFSTEP_DATA@"

/* Writes path: the template with the title escaped for HTML, and the data as JSON that no HTML
 * parser reads anything into (every < is \u003c). False, with nothing written: the template
 * cannot be read, or has other places (HS_EXIT_FILE), or memory (HS_EXIT_INTERNAL). */
bool hs_report_html(const char *path, const char *template_path, const char *title,
                    const json_t *data, hs_error *err);

#endif
