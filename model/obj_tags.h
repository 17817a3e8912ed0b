/* SPDX-License-Identifier: Apache-2.0
 *
 * The t lines of an OBJ file, as OpenSubdiv's shapes have them:
 *
 *   t crease N/F/0  v0 v1 .. vN-1  s ..      a chain of N-1 sharp edges; one sharpness, or one each
 *   t corner N/F/0  v0 .. vN-1     s ..      sharp vertices, likewise
 *
 * with vertices from 0 in the order of the file. Lines of other types (interpolateboundary, hole,
 * ...) say what an application is to do with the mesh; they are passed over.
 */
#ifndef HS_OBJ_TAGS_H
#define HS_OBJ_TAGS_H

#include <locale.h>

#include "mesh.h"

typedef struct hs_obj_tags {
    uint32_t count, room;
    hs_sharp_tag *tag; /* owned */
} hs_obj_tags;

typedef enum hs_tag_line {
    HS_TAGS_READ,
    HS_TAGS_OTHER,
    HS_TAGS_WRONG,
    HS_TAGS_NO_MEMORY
} hs_tag_line;

/* Reads what stands behind the keyword t and appends its tags. What is wrong goes to why, without
 * the line's number. */
hs_tag_line hs_obj_tags_read(hs_obj_tags *tags, char *text, uint32_t line, locale_t c_locale,
                             char *why, size_t size);

/* How many tags name an edge or vertex that an earlier one named, and the first one's line. False
 * without memory. */
bool hs_obj_tags_repeated(const hs_obj_tags *tags, uint32_t *count, uint32_t *line);

void hs_obj_tags_free(hs_obj_tags *tags);

#endif
