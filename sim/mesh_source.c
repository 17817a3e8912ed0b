/* SPDX-License-Identifier: Apache-2.0 */
#include "mesh_source.h"

#include <stdlib.h>
#include <string.h>

#include "file.h"
#include "obj.h"
#include "options.h"
#include "shape.h"

static const size_t FORCE_LIMIT = 64 << 20; /* bytes of a --force file */

/* --- Opening ------------------------------------------------------------------------------------
 */

static bool open_shape(hs_mesh *mesh, const char *source, hs_error *err) {
    char text[64], *part[3] = {NULL, NULL, NULL}, *rest = text;
    snprintf(text, sizeof text, "%s", source + strlen("shape:"));
    for (int i = 0; i < 3 && rest; i++)
        part[i] = strsep(&rest, ":");
    uint32_t size = 0, seed = 1;
    if (rest || strlen(source) >= sizeof text || (part[1] && !hs_number_parse(part[1], &size)) ||
        (part[2] && !hs_number_parse(part[2], &seed)))
        return hs_fail(err, HS_EXIT_USAGE,
                       "\"%.80s\" is no shape; it should be shape:NAME[:SIZE[:SEED]], such as "
                       "shape:grid:16; `halfstep mesh list` shows them all",
                       source);
    const char *name[64] = {NULL};
    for (size_t i = 0; i < 63 && hs_shapes[i].name; i++) {
        name[i] = hs_shapes[i].name;
        if (strcmp(part[0], name[i]) == 0) return hs_shape_make(mesh, part[0], size, seed, err);
    }
    const char *nearest = hs_nearest(part[0], name);
    if (nearest)
        return hs_fail(err, HS_EXIT_USAGE, "no shape \"%s\"; did you mean \"%s\"?", part[0],
                       nearest);
    return hs_shape_make(mesh, part[0], size, seed, err);
}

bool hs_mesh_open(hs_mesh *mesh, const char *source, bool round_sharpness, bool quiet,
                  hs_error *err) {
    *mesh = (hs_mesh){0};
    if (strncmp(source, "shape:", 6) == 0) return open_shape(mesh, source, err);
    hs_obj_notes notes = {0};
    if (!hs_obj_read(mesh, source, round_sharpness, &notes, err)) return false;
    char text[500];
    for (uint32_t i = 0; !quiet && hs_obj_note_text(&notes, source, i, text, sizeof text); i++)
        fprintf(stderr, "note: %s\n", text);
    return true;
}

/* --- Forced depths ------------------------------------------------------------------------------
 */

bool hs_mesh_force_line(hs_mesh *mesh, const char *line, const char *where, hs_error *err) {
    char text[80], *rest = text;
    const size_t length = strcspn(line, "#");
    if (length >= sizeof text)
        return hs_fail(err, HS_EXIT_MESH, "%.200s: too long; a line is FIRST-LAST DEPTH", where);
    memcpy(text, line, length);
    text[length] = 0;
    char *word[3] = {NULL, NULL, NULL};
    int words = 0;
    for (char *next; words < 3 && (next = strsep(&rest, " \t\r")) != NULL;)
        if (*next) word[words++] = next;
    if (words == 0) return true;
    uint32_t first = 0, last = 0, depth = 0;
    const bool range = words == 2 && strchr(word[0], '-') != NULL;
    bool good = words == 2 && hs_number_parse(word[1], &depth);
    if (good)
        good =
            range ? hs_pair_parse(word[0], '-', &first, &last) : hs_number_parse(word[0], &first);
    if (!range) last = first;
    if (!good)
        return hs_fail(err, HS_EXIT_MESH, "%.200s: not understood; a line is FIRST-LAST DEPTH",
                       where);
    if (first < 1 || last < first || last > mesh->faces)
        return hs_fail(err, HS_EXIT_MESH, "%.200s: faces %u to %u; the mesh has faces 1 to %u",
                       where, first, last, mesh->faces);
    if (depth > HS_MAX_DEPTH)
        return hs_fail(err, HS_EXIT_MESH, "%.200s: depth %u; a depth is at most %d", where, depth,
                       HS_MAX_DEPTH);
    memset(mesh->forced + first - 1, (int)depth, last - first + 1);
    return true;
}

bool hs_mesh_force(hs_mesh *mesh, const char *path, hs_error *err) {
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(path, FORCE_LIMIT, &bytes, &size, err)) return false;
    char *rest = (char *)bytes, *line;
    bool good = hs_text_check(rest, size, path, HS_EXIT_MESH, err);
    for (unsigned number = 1; good && (line = strsep(&rest, "\n")) != NULL; number++) {
        char where[300];
        snprintf(where, sizeof where, "%.250s:%u", path, number);
        good = hs_mesh_force_line(mesh, line, where, err);
    }
    free(bytes);
    return good;
}
