/* SPDX-License-Identifier: Apache-2.0
 *
 * Pictures to and from PNG files. The same picture always gives the same bytes.
 * (Not png.h: that name is libpng's, and sim/ is on the include path.)
 */
#ifndef HS_PNG_FILE_H
#define HS_PNG_FILE_H

#include "picture.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Writes the colours of a picture (not its coverage) as 8-bit sRGB. The file appears under its name
 * only when it is complete; on failure nothing is left behind, and a file that was there before
 * stays as it was (HS_EXIT_FILE). */
bool hs_png_write(const hs_picture *picture, const char *path, hs_error *err);

/* Reads a PNG file of any kind as 8-bit RGB; an alpha channel becomes the coverage, without one
 * all of the picture is covered. On failure *picture is empty (HS_EXIT_FILE). */
bool hs_png_read(hs_picture *picture, const char *path, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
