/* SPDX-License-Identifier: Apache-2.0
 *
 * PLY: a header in text, then the elements. Whole surfaces stay whole: a vertex occurs twice only
 * on a crease.
 */
#include <endian.h>
#include <string.h>

#include "convert_write.h"
#include "options.h"

static void write_header(FILE *stream, const hs_scene *scene, bool text) {
    fprintf(stream, "ply\nformat %s 1.0\n", text ? "ascii" : "binary_little_endian");
    fprintf(stream,
            "comment halfstep " HS_VERSION
            ": %s space; colours tell depths of refinement, 0 to %u\n",
            hs_space_name(scene->space), scene->deepest);
    fprintf(stream, "element vertex %u\n", scene->points);
    fputs("property float x\nproperty float y\nproperty float z\n", stream);
    if (scene->space == HS_SPACE_CLIP) fputs("property float w\n", stream);
    fputs("property float nx\nproperty float ny\nproperty float nz\n"
          "property uchar red\nproperty uchar green\nproperty uchar blue\n",
          stream);
    fprintf(stream, "element face %u\nproperty list uchar int vertex_indices\n", scene->faces);
    fputs("property uchar generation\nend_header\n", stream);
}

/* The numbers of a point, in the header's order: 6, in clip space 7. */
static uint32_t point_numbers(const hs_scene *scene, uint32_t p, float number[7]) {
    const uint32_t places = scene->space == HS_SPACE_CLIP ? 4 : 3;
    memcpy(number, &scene->place[4 * (size_t)scene->vertex[p]], places * sizeof *number);
    memcpy(number + places, &scene->normal[3 * (size_t)p], 3 * sizeof *number);
    return places + 3;
}

static void write_text(FILE *stream, const hs_scene *scene) {
    for (uint32_t p = 0; p < scene->points; p++) {
        float number[7] = {0};
        uint8_t rgb[3];
        const uint32_t numbers = point_numbers(scene, p, number);
        for (uint32_t i = 0; i < numbers; i++)
            fprintf(stream, "%.9g ", (double)number[i]);
        hs_scene_color(scene, scene->point_generation[p], rgb);
        fprintf(stream, "%u %u %u\n", rgb[0], rgb[1], rgb[2]);
    }
    for (uint32_t f = 0; f < scene->faces; f++) {
        fprintf(stream, "%u", scene->first[f + 1] - scene->first[f]);
        for (uint32_t c = scene->first[f]; c < scene->first[f + 1]; c++)
            fprintf(stream, " %u", scene->corner[c]);
        fprintf(stream, " %u\n", scene->generation[f]);
    }
}

static void write_word(FILE *stream, uint32_t word) {
    const uint32_t little = htole32(word);
    fwrite(&little, sizeof little, 1, stream);
}

static void write_binary(FILE *stream, const hs_scene *scene) {
    for (uint32_t p = 0; p < scene->points; p++) {
        float number[7] = {0};
        uint32_t word[7];
        uint8_t rgb[3];
        const uint32_t numbers = point_numbers(scene, p, number);
        memcpy(word, number, sizeof word);
        for (uint32_t i = 0; i < numbers; i++)
            write_word(stream, word[i]);
        hs_scene_color(scene, scene->point_generation[p], rgb);
        fwrite(rgb, sizeof rgb, 1, stream);
    }
    for (uint32_t f = 0; f < scene->faces; f++) {
        putc((int)(scene->first[f + 1] - scene->first[f]), stream);
        for (uint32_t c = scene->first[f]; c < scene->first[f + 1]; c++)
            write_word(stream, scene->corner[c]);
        putc(scene->generation[f], stream);
    }
}

bool hs_write_ply(const char *path, const hs_scene *scene, bool text, hs_error *err) {
    hs_text_file file;
    if (!hs_text_begin(&file, path, err)) return false;
    write_header(file.file.stream, scene, text);
    if (text)
        write_text(file.file.stream, scene);
    else
        write_binary(file.file.stream, scene);
    return hs_text_end(&file, err);
}
