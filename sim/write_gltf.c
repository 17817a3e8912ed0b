/* SPDX-License-Identifier: Apache-2.0
 *
 * glTF 2.0: a document in JSON and a buffer of bytes, in one file (GLB) or in two.
 *
 *     GLB:  "glTF" 2 length | length "JSON" document | length "BIN\0" buffer
 *     buffer:  triangles (3 x uint32)  places (3 x float)  normals (3 x float)
 *              colours (4 x uint16, linear)  in clip space: w (float)
 *
 * All lengths are multiples of four. Golden's capacities keep the buffer far below 2^32 bytes.
 */
#define _GNU_SOURCE
#include <endian.h>
#include <jansson.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "convert_write.h"
#include "json_file.h"
#include "options.h"

/* Numbers that the format gives to things. */
enum {
    UNSIGNED_SHORT = 5123,
    UNSIGNED_INT = 5125,
    FLOAT = 5126,
    OF_VERTICES = 34962, /* what a part of the buffer is for */
    OF_TRIANGLES = 34963,
    MAGIC_GLB = 0x46546c67,
    MAGIC_JSON = 0x4e4f534a,
    MAGIC_BIN = 0x004e4942
};

/* The parts of the buffer. */
enum { TRIANGLES, PLACES, NORMALS, COLORS, WEIGHTS, PARTS };
static const struct part {
    const char *attribute; /* NULL: the triangles */
    const char *type;
    int component;
    uint32_t bytes; /* an element */
} PART[PARTS] = {{NULL, "SCALAR", UNSIGNED_INT, 4},
                 {"POSITION", "VEC3", FLOAT, 12},
                 {"NORMAL", "VEC3", FLOAT, 12},
                 {"COLOR_0", "VEC4", UNSIGNED_SHORT, 8},
                 {"_W", "SCALAR", FLOAT, 4}};

static int parts_of(const hs_scene *scene) {
    return scene->space == HS_SPACE_CLIP ? PARTS : WEIGHTS;
}

static size_t elements(const hs_scene *scene, int part) {
    return part == TRIANGLES ? 3 * (size_t)scene->triangles : scene->points;
}

static size_t buffer_bytes(const hs_scene *scene) {
    size_t bytes = 0;
    for (int p = 0; p < parts_of(scene); p++)
        bytes += elements(scene, p) * PART[p].bytes;
    return bytes;
}

/* --- The buffer --------------------------------------------------------------------------------
 */

static void write_word(FILE *stream, uint32_t word) {
    const uint32_t little = htole32(word);
    fwrite(&little, sizeof little, 1, stream);
}

static void write_floats(FILE *stream, const float *number, int count) {
    for (int i = 0; i < count; i++) {
        uint32_t word;
        memcpy(&word, &number[i], sizeof word);
        write_word(stream, word);
    }
}

/* glTF's vertex colours are linear. */
static uint16_t linear(uint8_t srgb) {
    const double c = srgb / 255.0;
    return (uint16_t)lround(65535 * (c <= 0.04045 ? c / 12.92 : pow((c + 0.055) / 1.055, 2.4)));
}

static void write_color(FILE *stream, const uint8_t rgb[3]) {
    const uint16_t color[4] = {htole16(linear(rgb[0])), htole16(linear(rgb[1])),
                               htole16(linear(rgb[2])), 0xffff};
    fwrite(color, sizeof color, 1, stream);
}

static void write_buffer(FILE *stream, const hs_scene *scene) {
    for (size_t i = 0; i < 3 * (size_t)scene->triangles; i++)
        write_word(stream, scene->triangle[i]);
    for (uint32_t p = 0; p < scene->points; p++)
        write_floats(stream, &scene->place[4 * (size_t)scene->vertex[p]], 3);
    write_floats(stream, scene->normal, (int)(3 * scene->points));
    for (uint32_t p = 0; p < scene->points; p++) {
        uint8_t rgb[3];
        hs_scene_color(scene, scene->point_generation[p], rgb);
        write_color(stream, rgb);
    }
    for (uint32_t p = 0; p < scene->points && scene->space == HS_SPACE_CLIP; p++)
        write_floats(stream, &scene->place[4 * (size_t)scene->vertex[p] + 3], 1);
}

/* --- The document ------------------------------------------------------------------------------
 */

static json_t *numbers(bool *good, const double *number, int count) {
    json_t *array = json_array();
    for (int i = 0; i < count; i++)
        hs_json_append(array, json_real(number[i]), good);
    return array;
}

/* The format asks for the box of the places. */
static void add_box(bool *good, json_t *accessor, const hs_scene *scene) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t p = 0; p < scene->points; p++)
        for (uint32_t i = 0; i < 3; i++) {
            const double x = (double)scene->place[4 * (size_t)scene->vertex[p] + i];
            low[i] = fmin(low[i], x);
            high[i] = fmax(high[i], x);
        }
    hs_json_set(accessor, "min", numbers(good, low, 3), good);
    hs_json_set(accessor, "max", numbers(good, high, 3), good);
}

static json_t *accessors(bool *good, const hs_scene *scene) {
    json_t *array = json_array();
    for (int p = 0; p < parts_of(scene); p++) {
        json_t *accessor =
            json_pack("{si si sI ss}", "bufferView", p, "componentType", PART[p].component, "count",
                      (json_int_t)elements(scene, p), "type", PART[p].type);
        if (p == COLORS) hs_json_set(accessor, "normalized", json_true(), good);
        if (p == PLACES) add_box(good, accessor, scene);
        hs_json_append(array, accessor, good);
    }
    return array;
}

static json_t *buffer_views(bool *good, const hs_scene *scene) {
    json_t *array = json_array();
    size_t offset = 0;
    for (int p = 0; p < parts_of(scene); p++) {
        const size_t bytes = elements(scene, p) * PART[p].bytes;
        hs_json_append(array,
                       json_pack("{si sI sI si}", "buffer", 0, "byteOffset", (json_int_t)offset,
                                 "byteLength", (json_int_t)bytes, "target",
                                 p == TRIANGLES ? OF_TRIANGLES : OF_VERTICES),
                       good);
        offset += bytes;
    }
    return array;
}

/* Where the places lie, and what saw them: not glTF's business, but a reader's. */
static json_t *extras(bool *good, const hs_scene *scene) {
    json_t *object =
        json_pack("{ss si}", "space", hs_space_name(scene->space), "deepest", (int)scene->deepest);
    hs_json_set(object, "view", numbers(good, scene->matrix, 16), good);
    return object;
}

static json_t *asset(bool *good, const hs_scene *scene) {
    json_t *object = json_pack("{ss ss}", "version", "2.0", "generator", "halfstep " HS_VERSION);
    hs_json_set(object, "extras", extras(good, scene), good);
    return object;
}

static json_t *meshes(bool *good, const hs_scene *scene) {
    json_t *attributes = json_object();
    for (int p = PLACES; p < parts_of(scene); p++)
        hs_json_set(attributes, PART[p].attribute, json_integer(p), good);
    json_t *primitive = json_pack("{si si}", "indices", TRIANGLES, "material", 0);
    hs_json_set(primitive, "attributes", attributes, good);
    json_t *mesh = json_pack("{s[]}", "primitives"), *array = json_array();
    hs_json_append(json_object_get(mesh, "primitives"), primitive, good);
    hs_json_append(array, mesh, good);
    return array;
}

/* uri is the buffer's file; NULL: it is in the same one. */
static json_t *buffers(bool *good, const hs_scene *scene, const char *uri) {
    json_t *array = json_array();
    json_t *buffer = json_pack("{sI}", "byteLength", (json_int_t)buffer_bytes(scene));
    if (uri) hs_json_set(buffer, "uri", json_string(uri), good);
    hs_json_append(array, buffer, good);
    return array;
}

/* json_dumps loses keys where memory ends; json_dumpb says 0, or what it wrote. */
static char *text_of(const json_t *document) {
    const size_t flags = JSON_COMPACT | JSON_REAL_PRECISION(17);
    const size_t size = json_dumpb(document, NULL, 0, flags);
    char *text = size > 0 ? malloc(size + 1) : NULL;
    if (!text) return NULL;
    if (json_dumpb(document, text, size, flags) != size) {
        free(text);
        return NULL;
    }
    text[size] = 0;
    return text;
}

/* Text from malloc; NULL: no memory. The material is rough, and two-sided, as open surfaces show
 * their inside. */
static char *make_document(const hs_scene *scene, const char *uri) {
    bool good = true;
    json_t *document = json_object();
    hs_json_set(document, "asset", asset(&good, scene), &good);
    hs_json_set(document, "scene", json_integer(0), &good);
    hs_json_set(document, "scenes", json_pack("[{s[i]}]", "nodes", 0), &good);
    hs_json_set(document, "nodes", json_pack("[{si ss}]", "mesh", 0, "name", "halfstep"), &good);
    hs_json_set(document, "meshes", meshes(&good, scene), &good);
    hs_json_set(document, "materials",
                json_pack("[{ss sb s{sf sf}}]", "name", "depth of refinement", "doubleSided", 1,
                          "pbrMetallicRoughness", "metallicFactor", 0.0, "roughnessFactor", 0.75),
                &good);
    hs_json_set(document, "accessors", accessors(&good, scene), &good);
    hs_json_set(document, "bufferViews", buffer_views(&good, scene), &good);
    hs_json_set(document, "buffers", buffers(&good, scene, uri), &good);
    char *text = good ? text_of(document) : NULL;
    json_decref(document);
    return text;
}

/* --- One file ----------------------------------------------------------------------------------
 */

static void write_glb(FILE *stream, const hs_scene *scene, const char *document) {
    const size_t length = strlen(document), padded = (length + 3) / 4 * 4;
    const size_t bytes = buffer_bytes(scene);
    const uint32_t head[5] = {MAGIC_GLB, 2, (uint32_t)(12 + 8 + padded + 8 + bytes),
                              (uint32_t)padded, MAGIC_JSON};
    for (int i = 0; i < 5; i++)
        write_word(stream, head[i]);
    fwrite(document, length, 1, stream);
    for (size_t i = length; i < padded; i++)
        putc(' ', stream);
    write_word(stream, (uint32_t)bytes);
    write_word(stream, MAGIC_BIN);
    write_buffer(stream, scene);
}

static bool no_memory(const char *path, hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL, "%.300s: no memory to write it", path);
}

static bool write_one(const char *path, const hs_scene *scene, hs_error *err) {
    hs_file file;
    if (!hs_file_create(&file, path, err)) return false;
    char *document = make_document(scene, NULL);
    if (!document) {
        hs_file_abandon(&file);
        return no_memory(path, err);
    }
    write_glb(file.stream, scene, document);
    free(document);
    return hs_file_commit(&file, err);
}

/* --- Two files ---------------------------------------------------------------------------------
 */

/* The name of a file as a relative URI: all but the plainest bytes escaped. */
static void escape(char *uri, const char *name) {
    static const char plain[] =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789-_.~";
    for (; *name; name++)
        if (strchr(plain, *name))
            *uri++ = *name;
        else
            uri += sprintf(uri, "%%%02X", (unsigned)(unsigned char)*name);
    *uri = 0;
}

/* The buffer first: a document is never there before what it names. */
static bool write_files(const char *path, const char *side, const char *document,
                        const hs_scene *scene, hs_error *err) {
    hs_file file, buffer;
    if (!hs_file_create(&file, path, err)) return false;
    if (!hs_file_create(&buffer, side, err)) {
        hs_file_abandon(&file);
        return false;
    }
    fputs(document, file.stream);
    putc('\n', file.stream);
    write_buffer(buffer.stream, scene);
    if (hs_file_commit(&buffer, err)) return hs_file_commit(&file, err);
    hs_file_abandon(&file);
    return false;
}

static bool write_two(const char *path, const hs_scene *scene, hs_error *err) {
    const size_t length = strlen(path);
    char *side = malloc(length + 1), *uri = malloc(3 * length + 1), *document = NULL;
    if (side && uri) {
        snprintf(side, length + 1, "%.*s.bin", (int)length - 5, path);
        const char *slash = strrchr(side, '/');
        escape(uri, slash ? slash + 1 : side);
        document = make_document(scene, uri);
    }
    const bool done =
        document ? write_files(path, side, document, scene, err) : no_memory(path, err);
    free(side);
    free(uri);
    free(document);
    return done;
}

bool hs_write_gltf(const char *path, const hs_scene *scene, hs_error *err) {
    const size_t length = strlen(path);
    const bool two = length > 5 && strcmp(path + length - 5, ".gltf") == 0;
    return two ? write_two(path, scene, err) : write_one(path, scene, err);
}
