/* SPDX-License-Identifier: Apache-2.0
 *
 * Traces: packets in files, with where they come from and what is expected of them.
 *
 *   FOLDER/trace.txt      how it was made: the source, written by people
 *   FOLDER/input.hss      the input packets that trace.txt makes
 *   FOLDER/expected.json  per view: status, counts, digest of the output packet, cycles of the rtl
 *
 * trace.txt is read from the top, a statement a line, # for comments:
 *
 *   mesh SOURCE              what hs_mesh_open opens; once, before the first view
 *   limit-vertices N         run-time limits, before the first view
 *   limit-quads N
 *   stalls IN OUT SEED       pauses of the rtl's streams, before the first view
 *   front N, silhouette N, guard 0|1, uniform N|no
 *                            settings of the views that follow (4, 8, 1, no)
 *   boundary MODE, limit 0|1 likewise: kept, smooth or edge-only (smooth), limit positions (0)
 *   edge LENGTH WIDTH HEIGHT likewise: least edge in sixteenths of a pixel of a picture (0: none)
 *   force FIRST-LAST DEPTH   forced depths of faces, from 1, in the views that follow
 *   matrix M00 M01 .. M33    a view; views are numbered from 0
 *   word POSITION VALUE      puts a word (decimal or 0x...) into the packet of the view before
 *   crc                      makes that packet's CRC-32 right again
 *   cut WORDS                lets that packet end behind so many words
 */
#ifndef HS_TRACE_H
#define HS_TRACE_H

#include <jansson.h>

#include "golden.h"
#include "rtl.h"

/* --- Stream files -------------------------------------------------------------------------------
 */

typedef struct hs_stream_file {
    uint32_t packets;
    hs_packet *packet;
} hs_stream_file;

bool hs_stream_file_read(hs_stream_file *file, const char *path, hs_error *err);
bool hs_stream_file_write(const hs_stream_file *file, const char *path, hs_error *err);
/* Appends an empty packet. */
bool hs_stream_file_grow(hs_stream_file *file, hs_packet **packet, hs_error *err);
void hs_stream_file_free(hs_stream_file *file);

/* The text form: `packet VIEW`, then a record a line, four words in hexadecimal, with what they
 * are behind a #. */
void hs_stream_file_show(const hs_stream_file *file, FILE *text);

/* Reads the text form. A word is 1 to 8 hexadecimal digits, a number with a decimal point (a
 * binary32), or `crc`, the CRC-32 of the records before. What hs_stream_file_show wrote gives the
 * same packets again. The text has size bytes and a zero byte behind them, and is cut up; name is
 * for messages (HS_EXIT_STREAM). */
bool hs_stream_file_build(hs_stream_file *file, char *text, size_t size, const char *name,
                          hs_error *err);

/* --- Traces -------------------------------------------------------------------------------------
 */

typedef struct hs_trace {
    hs_limits limits;
    hs_stalls stalls;
    hs_stream_file input;
} hs_trace;

/* Makes a trace from FOLDER/trace.txt. On failure *trace is empty and *err names the line. */
bool hs_trace_compile(hs_trace *trace, const char *folder, hs_error *err);

/* The same from size bytes in memory, with a zero byte behind them; they are cut up. name stands
 * for the file in messages. */
bool hs_trace_parse(hs_trace *trace, char *text, size_t size, const char *name, hs_error *err);

void hs_trace_free(hs_trace *trace);

/* Runs golden and the rtl on the input and gives what is expected of them, or NULL: they differ
 * (HS_EXIT_DIFFERENT), or one of them broke down. */
json_t *hs_trace_expect(const hs_trace *trace, const char *folder, hs_error *err);

/* Reads the text of an expected.json; NULL (HS_EXIT_STREAM) if it is no JSON. */
json_t *hs_trace_expected_parse(const char *text, size_t size, const char *name, hs_error *err);

/* False (HS_EXIT_DIFFERENT), with the first view and key, if what was expected is not what there
 * is: each value of `actual` has to be in `expected`. folder is for messages. */
bool hs_trace_expected_check(json_t *expected, json_t *actual, const char *folder, hs_error *err);

#endif
