/* SPDX-License-Identifier: Apache-2.0
 *
 * A waveform as a file: it appears whole or not at all, like all others, although the library that
 * writes FST opens files by name and keeps to itself whether it could write.
 */
#ifndef HS_WAVE_FILE_H
#define HS_WAVE_FILE_H

#include "file.h"
#include "rtl.h"

/* Begins to record the cycles from first to last. HS_EXIT_FILE: path cannot be written, or is no
 * regular file (FST is not written in one go). */
bool hs_wave_start(hs_file *file, const char *path, hs_rtl *rtl, uint64_t first, uint64_t last,
                   hs_error *err);

/* Ends the recording, and the file: path holds the waveform if all of it was written. An empty
 * *file is left alone. */
bool hs_wave_end(hs_file *file, hs_rtl *rtl, hs_error *err);

#endif
