/* SPDX-License-Identifier: Apache-2.0 */
#include "convert_write.h"

static void write_vertices(FILE *stream, const hs_scene *scene) {
    for (uint32_t v = 0; v < scene->vertices; v++) {
        const float *p = &scene->place[4 * (size_t)v];
        uint8_t rgb[3];
        fprintf(stream, "v %.9g %.9g %.9g", (double)p[0], (double)p[1], (double)p[2]);
        hs_scene_color(scene, scene->vertex_generation[v], rgb);
        if (scene->space == HS_SPACE_CLIP)
            fprintf(stream, " %.9g\n", (double)p[3]);
        else
            fprintf(stream, " %.4f %.4f %.4f\n", rgb[0] / 255.0, rgb[1] / 255.0, rgb[2] / 255.0);
    }
}

bool hs_write_obj(const char *path, const hs_scene *scene, hs_error *err) {
    hs_text_file text;
    if (!hs_text_begin(&text, path, err)) return false;
    FILE *stream = text.file.stream;
    fprintf(stream, "# %s space; depth of refinement 0 to %u\n", hs_space_name(scene->space),
            scene->deepest);
    write_vertices(stream, scene);
    for (uint32_t p = 0; p < scene->points; p++) {
        const float *n = &scene->normal[3 * (size_t)p];
        fprintf(stream, "vn %.9g %.9g %.9g\n", (double)n[0], (double)n[1], (double)n[2]);
    }
    for (uint32_t f = 0; f < scene->faces; f++) {
        putc('f', stream);
        for (uint32_t c = scene->first[f]; c < scene->first[f + 1]; c++)
            fprintf(stream, " %u//%u", scene->vertex[scene->corner[c]] + 1, scene->corner[c] + 1);
        putc('\n', stream);
    }
    return hs_text_end(&text, err);
}
