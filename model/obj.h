/* SPDX-License-Identifier: Apache-2.0
 *
 * Wavefront OBJ: polygon meshes as text. Of its keywords, v and f are read: polygons of any number
 * of sides, indices from 1 or backwards from -1, forward references, line continuation. All objects
 * and groups are merged into one mesh. OpenSubdiv's t lines make edges and vertices sharp
 * (obj_tags.h). Texture coordinates, normals, names, materials, points and
 * lines are skipped. Numbers are read as strtof reads them in the "C" locale; `v x y z` has w = 1,
 * and so has a v with more than four numbers (the others being a colour).
 */
#ifndef HS_OBJ_H
#define HS_OBJ_H

#include "error.h"
#include "mesh.h"
#include "stream.h"

#ifdef __cplusplus
extern "C" {
#endif

/* Something in a file that was passed over, but that its user may want to know of. */
typedef struct hs_obj_note {
    uint32_t count; /* how often; 0: not at all */
    uint32_t line;  /* of the first one */
} hs_obj_note;

typedef struct hs_obj_notes {
    hs_obj_note unused;    /* vertices that no face uses: dropped */
    hs_obj_note repeated;  /* t lines for an edge or vertex that has one: the last one counts */
    hs_obj_note tags;      /* t lines that are neither crease nor corner: ignored */
    hs_obj_note unknown;   /* lines with an unknown keyword: ignored */
    char unknown_word[32]; /* the first of those keywords, fit for printing */
} hs_obj_notes;

/* Reads a mesh from a file. round_sharpness: fractions of a sharpness are rounded to the nearest
 * integer, halves up; else they are refused. What *mesh held is not freed. On failure *mesh is
 * empty and *err names file and line: HS_EXIT_MESH, or HS_EXIT_FILE if the file can't be read.
 * notes may be NULL. */
bool hs_obj_read(hs_mesh *mesh, const char *path, bool round_sharpness, hs_obj_notes *notes,
                 hs_error *err);

/* The same from size bytes in memory; name stands for the file in messages. */
bool hs_obj_parse(hs_mesh *mesh, const char *name, const char *text, size_t size,
                  bool round_sharpness, hs_obj_notes *notes, hs_error *err);

/* The notes as sentences: writes the one with the given index, from 0, into text, as in
 * "cube.obj:7: 3 vertices that no face uses were dropped". False if there is none (any more). */
bool hs_obj_note_text(const hs_obj_notes *notes, const char *name, uint32_t index, char *text,
                      size_t size);

/* Writes a mesh in object space: `v x y z`, with w behind it where it isn't 1. Nine significant
 * digits, so that reading gives the same bits. Sharp edges and vertices follow as t lines. The file
 * appears whole or not at all (HS_EXIT_FILE). */
bool hs_obj_write_mesh(const char *path, const hs_mesh *mesh, hs_error *err);

/* Writes an output packet in clip space: always `v x y z w`; vertices and faces in output order. */
bool hs_obj_write_output(const char *path, const hs_output *output, hs_error *err);

#ifdef __cplusplus
}
#endif
#endif
