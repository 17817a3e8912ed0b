/* SPDX-License-Identifier: Apache-2.0
 *
 * Meshes with boundaries, creases and sharp vertices: a grid, cones of any valence, cubes with
 * random tags, and the files of TAGGED_FOLDER.
 */
#ifndef HS_TESTS_REFERENCE_SHAPES_H
#define HS_TESTS_REFERENCE_SHAPES_H

#include "reference_samples.h"

#define TAGGED_FOLDER MESH_FOLDER "/tagged"

static inline uint32_t next_random(uint32_t *seed) {
    *seed ^= *seed << 13;
    *seed ^= *seed >> 17;
    *seed ^= *seed << 5;
    return *seed;
}

/* --- Sharpness -------------------------------------------------------------------------------- */

/* Arrays of a mesh's sharpness, all 0 if there were none. */
static inline void make_taggable(hs_mesh *mesh) {
    if (!mesh->sharpness) mesh->sharpness = calloc(mesh->halfedges, 1);
    if (!mesh->vertex_sharpness) mesh->vertex_sharpness = calloc(mesh->vertices, 1);
    assert_non_null(mesh->sharpness);
    assert_non_null(mesh->vertex_sharpness);
}

static inline void crease_halfedge(hs_mesh *mesh, uint32_t h, uint8_t sharpness) {
    mesh->sharpness[h] = sharpness;
    if (mesh->twin[h] != HS_BORDER) mesh->sharpness[mesh->twin[h]] = sharpness;
}

/* The edge from v to w, in any direction; it must be there. */
static inline void crease_edge(hs_mesh *mesh, uint32_t v, uint32_t w, uint8_t sharpness) {
    make_taggable(mesh);
    bool found = false;
    for (uint32_t h = 0; h < mesh->halfedges; h++) {
        const uint32_t a = mesh->origin[h], b = mesh->origin[hs_next(mesh, h)];
        if ((a != v || b != w) && (a != w || b != v)) continue;
        crease_halfedge(mesh, h, sharpness);
        found = true;
    }
    assert_true(found);
}

/* Most edges and vertices stay smooth; the others get what ends within few levels, or what lasts:
 * 1 to 4 mostly, 5 to HS_MAX_SHARPNESS, or 15. */
static inline uint8_t random_sharpness(uint32_t *seed, uint32_t one_in) {
    if (next_random(seed) % one_in) return 0;
    const uint32_t random = next_random(seed), s = 1 + random % 6;
    if (s == 5) return (uint8_t)(5 + random / 6 % (HS_MAX_SHARPNESS - 4));
    return (uint8_t)(s < 5 ? s : HS_SHARP_INFINITE);
}

static inline void tag_at_random(hs_mesh *mesh, uint32_t *seed, uint32_t one_edge_in,
                                 uint32_t one_vertex_in) {
    make_taggable(mesh);
    for (uint32_t h = 0; h < mesh->halfedges; h++)
        if (mesh->twin[h] == HS_BORDER || h < mesh->twin[h])
            crease_halfedge(mesh, h, random_sharpness(seed, one_edge_in));
    for (uint32_t v = 0; v < mesh->vertices; v++)
        mesh->vertex_sharpness[v] = random_sharpness(seed, one_vertex_in);
}

/* --- Shapes ----------------------------------------------------------------------------------- */

/* width x height quads in a plane that is not flat. */
static inline void build_grid(hs_mesh *mesh, uint32_t width, uint32_t height) {
    float position[4 * 64];
    uint32_t sides[64], corner[4 * 64], faces = 0;
    assert_true((width + 1) * (height + 1) <= 64);
    for (uint32_t y = 0; y <= height; y++)
        for (uint32_t x = 0; x <= width; x++) {
            float *p = position + 4 * (size_t)(y * (width + 1) + x);
            p[0] = (float)x;
            p[1] = (float)y;
            p[2] = (float)((3 * x * x + 5 * x * y + y) % 7) / 4;
            p[3] = 1;
        }
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++) {
            const uint32_t v = y * (width + 1) + x, up = v + width + 1;
            const uint32_t quad[4] = {v, v + 1, up + 1, up};
            sides[faces] = 4;
            memcpy(corner + 4 * (size_t)faces++, quad, sizeof quad);
        }
    build(mesh, "grid", (width + 1) * (height + 1), position, faces, sides, corner);
}

/* n triangles around a tip, and unless it is open a face of n sides below. */
static inline void build_cone(hs_mesh *mesh, uint32_t n, bool open) {
    float position[4 * 256];
    uint32_t sides[256], corner[4 * 256], corners = 0;
    assert_true(n <= 255);
    for (uint32_t i = 0; i < n; i++) {
        const double angle = 2 * M_PI * i / n;
        float *p = position + 4 * (size_t)i;
        p[0] = (float)cos(angle);
        p[1] = (float)sin(angle);
        p[2] = (float)(0.3 * cos(3 * angle));
        p[3] = 1;
        sides[i] = 3;
        corner[corners++] = i;
        corner[corners++] = (i + 1) % n;
        corner[corners++] = n;
    }
    const float tip[4] = {0.1f, 0.2f, 1.5f, 1};
    memcpy(position + 4 * (size_t)n, tip, sizeof tip);
    sides[n] = n;
    for (uint32_t i = 0; i < n; i++)
        corner[corners++] = n - 1 - i;
    build(mesh, "cone", n + 1, position, open ? n : n + 1, sides, corner);
}

/* One face of n sides, all of them boundary. */
static inline void build_polygon(hs_mesh *mesh, uint32_t n) {
    float position[4 * 255];
    uint32_t corner[255];
    for (uint32_t i = 0; i < n; i++) {
        const double angle = 2 * M_PI * i / n;
        const float p[4] = {(float)cos(angle), (float)sin(angle), (float)(i % 3) / 5, 1};
        memcpy(position + 4 * (size_t)i, p, sizeof p);
        corner[i] = i;
    }
    build(mesh, "polygon", n, position, 1, &n, corner);
}

/* Two quads, back to back: four vertices of valence 2. */
static inline void build_pillow(hs_mesh *mesh) {
    const float position[] = {0, 0, 0, 1, 2, 0, 1, 1, 2, 2, 0, 1, 0, 2, 1, 1};
    const uint32_t sides[] = {4, 4}, corner[] = {0, 1, 2, 3, 3, 2, 1, 0};
    build(mesh, "pillow", 4, position, 2, sides, corner);
}

/* A cube, of which up to two faces may be missing, with tags at random. */
static inline void build_random_cube(hs_mesh *mesh, uint32_t seed) {
    hs_mesh cube;
    build_cube(&cube);
    const uint32_t missing = next_random(&seed) % 3;
    const uint32_t gone[2] = {next_random(&seed) % 6, next_random(&seed) % 6};
    uint32_t sides[6], corner[24], faces = 0;
    for (uint32_t f = 0; f < 6; f++) {
        if ((missing > 0 && f == gone[0]) || (missing > 1 && f == gone[1])) continue;
        sides[faces] = 4;
        memcpy(corner + 4 * (size_t)faces++, cube.origin + 4 * (size_t)f, 4 * sizeof *corner);
    }
    for (uint32_t i = 0; i < 4 * 8; i++) /* no symmetry hides a mistake */
        if (i % 4 < 3) cube.position[i] += (float)(next_random(&seed) % 100) / 400;
    build(mesh, "random cube", 8, cube.position, faces, sides, corner);
    hs_mesh_free(&cube);
    tag_at_random(mesh, &seed, 2, 6);
}

/* --- The tagged files ------------------------------------------------------------------------- */

/* To the nearest integer, halves up; 10 and more is for ever. */
static inline uint8_t rounded_sharpness(double sharpness) {
    const double s = floor(sharpness + 0.5);
    return (uint8_t)(s < 10 ? s : HS_SHARP_INFINITE);
}

/* A crease, or a corner if v and w are the same: vertices from 0. */
typedef struct {
    uint32_t v, w;
    double sharpness;
} tag_line;

/* Takes the t lines out of a file in memory. Gives how many creases and corners they are. */
static inline uint32_t take_tags(char *text, tag_line *tag, uint32_t room) {
    uint32_t count = 0;
    for (char *line = text; line && *line; line = strchr(line, '\n'), line += line != NULL) {
        if (strncmp(line, "t ", 2) != 0) continue;
        tag_line t;
        assert_true(count < room);
        if (sscanf(line, "t crease 2/1/0 %u %u %lf", &t.v, &t.w, &t.sharpness) == 3) {
            tag[count++] = t;
        } else if (sscanf(line, "t corner 1/1/0 %u %lf", &t.v, &t.sharpness) == 2) {
            t.w = t.v;
            tag[count++] = t;
        }
        for (char *c = line; *c && *c != '\n'; c++)
            *c = ' ';
    }
    return count;
}

/* Reads a file with its tags, independently of what hs_obj_read makes of them. Faces must use all
 * its vertices, which keep their numbers then. */
static inline void read_tagged(hs_mesh *mesh, const char *path, uint32_t *tags) {
    static char text[1 << 16];
    tag_line tag[256];
    FILE *file = fopen(path, "rb");
    assert_non_null(file);
    const size_t size = fread(text, 1, sizeof text - 1, file);
    fclose(file);
    text[size] = 0;
    *tags = take_tags(text, tag, 256);
    hs_error err;
    if (!hs_obj_parse(mesh, path, text, size, false, NULL, &err)) fail_msg("%s", err.text);
    make_taggable(mesh);
    for (uint32_t i = 0; i < *tags; i++) {
        if (tag[i].v == tag[i].w)
            mesh->vertex_sharpness[tag[i].v] = rounded_sharpness(tag[i].sharpness);
        else
            crease_edge(mesh, tag[i].v, tag[i].w, rounded_sharpness(tag[i].sharpness));
    }
}

static inline void add_tagged_files(samples *all) {
    DIR *folder = opendir(TAGGED_FOLDER);
    if (!folder) {
        print_message("no folder " TAGGED_FOLDER ": its meshes are skipped\n");
        return;
    }
    uint32_t files = 0, tags = 0, here;
    for (const struct dirent *entry; (entry = readdir(folder));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".obj") != 0) continue;
        char path[400];
        snprintf(path, sizeof path, TAGGED_FOLDER "/%s", entry->d_name);
        read_tagged(&add_sample(all, entry->d_name)->mesh, path, &here);
        files++;
        tags += here;
    }
    closedir(folder);
    print_message("%u tagged files with %u tags\n", files, tags);
    assert_true(files == 0 || tags > files);
}

/* Small meshes of every kind: closed and open, smooth and tagged. */
static inline void add_sharp_samples(samples *all) {
    static const uint32_t valences[] = {3, 5, 64, 254, 255};
    uint32_t seed = 88172645u;
    build_pillow(&add_sample(all, "pillow")->mesh);
    build_grid(&add_sample(all, "grid")->mesh, 4, 3);
    sample *s = add_sample(all, "tagged grid");
    build_grid(&s->mesh, 5, 4);
    tag_at_random(&s->mesh, &seed, 3, 8);
    for (size_t i = 0; i < sizeof valences / sizeof *valences; i++) {
        build_cone(&add_sample(all, "cone")->mesh, valences[i], false);
        build_cone(&add_sample(all, "open cone")->mesh, valences[i], true);
        s = add_sample(all, "tagged cone");
        build_cone(&s->mesh, valences[i], i % 2 == 0);
        tag_at_random(&s->mesh, &seed, valences[i], 7);
        build_polygon(&add_sample(all, "polygon")->mesh, valences[i]);
    }
    for (uint32_t i = 0; i < 20; i++)
        build_random_cube(&add_sample(all, "random cube")->mesh, 77 + i);
    add_tagged_files(all);
    see_which_are_closed(all);
}

/* The meshes of reference_samples.h, and those of this file. */
static inline int make_all_samples(void **state) {
    if (make_samples(state) != 0) return -1;
    add_sharp_samples(*state);
    return 0;
}

static inline int make_sharp_samples(void **state) {
    samples *all = calloc(1, sizeof *all);
    assert_non_null(all);
    add_sharp_samples(all);
    *state = all;
    return 0;
}

#endif
