/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include <locale.h>
#include <stdio.h>

#include "file.h"
#include "obj.h"

/* Nine significant digits tell any two floats apart. */
static void write_vertex(FILE *stream, const float p[4], bool with_w) {
    fprintf(stream, "v %.9g %.9g %.9g", (double)p[0], (double)p[1], (double)p[2]);
    if (with_w) fprintf(stream, " %.9g", (double)p[3]);
    putc('\n', stream);
}

static void write_faces(FILE *stream, uint32_t faces, const uint32_t *first,
                        const uint32_t *corner) {
    for (uint32_t f = 0; f < faces; f++) {
        putc('f', stream);
        for (uint32_t i = first[f]; i < first[f + 1]; i++)
            fprintf(stream, " %u", corner[i] + 1);
        putc('\n', stream);
    }
}

/* What of a mesh and of an output packet makes an OBJ file. */
typedef struct shape {
    uint32_t vertices, faces;
    const float *position;
    const uint32_t *first, *corner;
    bool always_w;
    const hs_mesh *tagged; /* NULL: without tags */
} shape;

static unsigned written(uint8_t sharpness) {
    return sharpness == HS_SHARP_INFINITE ? 10 : sharpness;
}

/* Each edge once. */
static void write_tags(FILE *file, const hs_mesh *mesh) {
    for (uint32_t h = 0; h < mesh->halfedges; h++)
        if (mesh->sharpness[h] && (mesh->twin[h] == HS_BORDER || h < mesh->twin[h]))
            fprintf(file, "t crease 2/1/0 %u %u %u\n", mesh->origin[h],
                    mesh->origin[hs_next(mesh, h)], written(mesh->sharpness[h]));
    for (uint32_t v = 0; v < mesh->vertices; v++)
        if (mesh->vertex_sharpness[v])
            fprintf(file, "t corner 1/1/0 %u %u\n", v, written(mesh->vertex_sharpness[v]));
}

static bool write_shape(const char *path, const shape *s, hs_error *err) {
    hs_file file;
    if (!hs_file_create(&file, path, err)) return false;
    /* OBJ has decimal points, wherever the program runs. */
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c_locale == (locale_t)0) {
        hs_file_abandon(&file);
        return hs_fail(err, HS_EXIT_INTERNAL, "%.300s: out of memory; free some memory", path);
    }
    locale_t previous = uselocale(c_locale);
    for (uint32_t v = 0; v < s->vertices; v++) {
        const float *p = s->position + 4 * (size_t)v;
        write_vertex(file.stream, p, s->always_w || p[3] != 1.0F);
    }
    write_faces(file.stream, s->faces, s->first, s->corner);
    if (s->tagged && s->tagged->sharpness && s->tagged->vertex_sharpness)
        write_tags(file.stream, s->tagged);
    uselocale(previous);
    freelocale(c_locale);
    return hs_file_commit(&file, err);
}

bool hs_obj_write_mesh(const char *path, const hs_mesh *mesh, hs_error *err) {
    shape s = {mesh->vertices, mesh->faces, mesh->position, mesh->first, mesh->origin, false, mesh};
    return write_shape(path, &s, err);
}

bool hs_obj_write_output(const char *path, const hs_output *output, hs_error *err) {
    shape s = {output->vertices,
               output->faces,
               output->position,
               output->first,
               output->corner,
               true,
               NULL};
    return write_shape(path, &s, err);
}
