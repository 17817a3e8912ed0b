/* SPDX-License-Identifier: Apache-2.0
 *
 * What the tests of the reference share: the meshes that they run over (three written out here,
 * all built-in shapes, all of MESH_FOLDER that load), and what a conforming mesh is.
 */
#ifndef HS_TESTS_REFERENCE_SAMPLES_H
#define HS_TESTS_REFERENCE_SAMPLES_H

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

#include <dirent.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "obj.h"
#include "reference.h"
#include "shape.h"

#define MESH_FOLDER "../shared/meshes"

/* --- Meshes ---------------------------------------------------------------------------------- */

typedef struct {
    char name[300];
    hs_mesh mesh;
    bool closed;
} sample;

typedef struct {
    uint32_t count;
    sample item[128];
} samples;

static inline void build(hs_mesh *mesh, const char *name, uint32_t vertices, const float *position,
                         uint32_t faces, const uint32_t *sides, const uint32_t *corner) {
    const hs_soup soup = {.name = name,
                          .vertices = vertices,
                          .position = position,
                          .faces = faces,
                          .sides = sides,
                          .corner = corner};
    hs_error err;
    if (!hs_mesh_build(mesh, &soup, NULL, &err)) fail_msg("%s", err.text);
}

static inline void build_tetrahedron(hs_mesh *mesh) {
    const float position[] = {1, 1, 1, 1, -1, -1, 1, 1, -1, 1, -1, 1, 1, -1, -1, 1};
    const uint32_t sides[] = {3, 3, 3, 3}, corner[] = {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3};
    build(mesh, "tetrahedron", 4, position, 4, sides, corner);
}

/* Vertex i is at (+-1, +-1, +-1), bits 0 to 2 of i; face 0 looks along +z, face 1 along -z. */
static inline void build_cube(hs_mesh *mesh) {
    float position[32];
    for (unsigned i = 0; i < 8; i++) {
        for (unsigned axis = 0; axis < 3; axis++)
            position[4 * i + axis] = i >> axis & 1 ? 1.0f : -1.0f;
        position[4 * i + 3] = 1;
    }
    const uint32_t sides[] = {4, 4, 4, 4, 4, 4};
    const uint32_t corner[] = {4, 5, 7, 6, 0, 2, 3, 1, 1, 3, 7, 5,
                               0, 4, 6, 2, 2, 6, 7, 3, 0, 1, 5, 4};
    build(mesh, "cube", 8, position, 6, sides, corner);
}

static inline void build_torus(hs_mesh *mesh) {
    enum { AROUND = 5, ACROSS = 4 };
    float position[4 * AROUND * ACROSS];
    uint32_t sides[AROUND * ACROSS], corner[4 * AROUND * ACROSS];
    for (uint32_t i = 0; i < AROUND; i++) {
        for (uint32_t j = 0; j < ACROSS; j++) {
            const double a = 2 * M_PI * i / AROUND, b = 2 * M_PI * j / ACROSS;
            const uint32_t v = i * ACROSS + j, down = (i + 1) % AROUND, right = (j + 1) % ACROSS;
            position[4 * v] = (float)(cos(a) * (2 + cos(b)));
            position[4 * v + 1] = (float)(sin(a) * (2 + cos(b)));
            position[4 * v + 2] = (float)sin(b);
            position[4 * v + 3] = 1;
            sides[v] = 4;
            corner[4 * v] = v;
            corner[4 * v + 1] = down * ACROSS + j;
            corner[4 * v + 2] = down * ACROSS + right;
            corner[4 * v + 3] = i * ACROSS + right;
        }
    }
    build(mesh, "torus", AROUND * ACROSS, position, AROUND * ACROSS, sides, corner);
}

static inline sample *add_sample(samples *all, const char *name) {
    assert_true(all->count < 128);
    sample *s = &all->item[all->count++];
    memset(s, 0, sizeof *s);
    snprintf(s->name, sizeof s->name, "%s", name);
    return s;
}

static inline void add_files(samples *all) {
    DIR *folder = opendir(MESH_FOLDER);
    if (!folder) {
        print_message("no folder " MESH_FOLDER ": its meshes are skipped\n");
        return;
    }
    for (const struct dirent *entry; (entry = readdir(folder));) {
        const char *dot = strrchr(entry->d_name, '.');
        if (!dot || strcmp(dot, ".obj") != 0) continue;
        sample *s = add_sample(all, entry->d_name);
        char path[400];
        snprintf(path, sizeof path, MESH_FOLDER "/%s", entry->d_name);
        hs_error err;
        if (hs_obj_read(&s->mesh, path, false, NULL, &err)) continue;
        print_message("%s: skipped\n", err.text);
        all->count--;
    }
    closedir(folder);
}

static inline void see_which_are_closed(samples *all) {
    for (uint32_t i = 0; i < all->count; i++) {
        sample *s = &all->item[i];
        s->closed = true;
        for (uint32_t h = 0; h < s->mesh.halfedges; h++)
            s->closed &= s->mesh.twin[h] != HS_BORDER;
    }
}

static inline int make_samples(void **state) {
    samples *all = calloc(1, sizeof *all);
    assert_non_null(all);
    build_tetrahedron(&add_sample(all, "inline tetrahedron")->mesh);
    build_cube(&add_sample(all, "inline cube")->mesh);
    build_torus(&add_sample(all, "inline torus")->mesh);
    for (const hs_shape *shape = hs_shapes; shape->name; shape++) {
        hs_error err;
        if (!hs_shape_make(&add_sample(all, shape->name)->mesh, shape->name, 0, 1, &err))
            fail_msg("%s", err.text);
    }
    add_files(all);
    see_which_are_closed(all);
    *state = all;
    return 0;
}

static inline int free_samples(void **state) {
    samples *all = *state;
    for (uint32_t i = 0; i < all->count; i++)
        hs_mesh_free(&all->item[i].mesh);
    free(all);
    return 0;
}

/* --- The reference, any failure of which ends the test --------------------------------------- */

/* A perspective view from the side of anything about 2 units large: w varies over the mesh. */
static const float perspective[16] = {1.6f, 0.2f, -0.3f, 0.1f, -0.1f, 1.5f, 0.4f,  -0.2f,
                                      0.3f, 0.1f, -1.1f, 7.0f, 0.2f,  0.1f, -0.9f, 8.0f};

static inline void matrix_in_double(double out[16]) {
    for (int i = 0; i < 16; i++)
        out[i] = (double)perspective[i];
}

static inline hs_reference new_reference(const hs_mesh *mesh, const double *matrix,
                                         hs_boundary boundary) {
    hs_reference r;
    hs_error err;
    if (!hs_reference_new(&r, mesh, matrix, boundary, &err)) fail_msg("%s", err.text);
    return r;
}

static inline void step(hs_reference *r, const uint8_t *decision) {
    hs_error err;
    if (!hs_reference_step(r, decision, &err)) fail_msg("%s", err.text);
}

static inline void finish(hs_reference *r) {
    hs_error err;
    if (!hs_reference_finish(r, &err)) fail_msg("%s", err.text);
}

/* --- Conforming meshes
 * ----------------------------------------------------------------------------- */

/* Rows of up to four numbers and what they stand for, to be found again. */
typedef struct {
    uint32_t key[4], value;
} row;

static inline int by_key(const void *a, const void *b) {
    const row *x = a, *y = b;
    for (int i = 0; i < 4; i++)
        if (x->key[i] != y->key[i]) return x->key[i] < y->key[i] ? -1 : 1;
    return 0;
}

static inline row *new_rows(uint32_t count) {
    row *rows = malloc((count + 1u) * sizeof *rows);
    assert_non_null(rows);
    return rows;
}

/* Where the boundary goes on at a vertex, or HS_REFERENCE_NONE: one number per vertex. */
static inline uint32_t *new_boundary(uint32_t vertices) {
    uint32_t *next = malloc((vertices + 1u) * sizeof *next);
    assert_non_null(next);
    memset(next, 0xff, (vertices + 1u) * sizeof *next);
    return next;
}

static inline uint32_t *boundary_of_mesh(const hs_mesh *mesh) {
    uint32_t *next = new_boundary(mesh->vertices);
    for (uint32_t h = 0; h < mesh->halfedges; h++)
        if (mesh->twin[h] == HS_BORDER) next[mesh->origin[h]] = mesh->origin[hs_next(mesh, h)];
    return next;
}

/* How many closed curves the boundary is; every one of its vertices must lie on one. */
static inline uint32_t count_loops(const uint32_t *next, uint32_t vertices) {
    uint32_t loops = 0;
    uint8_t *seen = calloc(vertices + 1u, 1);
    assert_non_null(seen);
    for (uint32_t v = 0; v < vertices; v++) {
        if (next[v] == HS_REFERENCE_NONE || seen[v]) continue;
        loops++;
        uint32_t w = v;
        do {
            assert_false(seen[w]);
            seen[w] = 1;
            w = next[w];
            assert_int_not_equal(w, HS_REFERENCE_NONE);
        } while (w != v);
    }
    free(seen);
    return loops;
}

/* The open sides of a refined boundary: as many curves as before, through the same old vertices. */
static inline void check_refined_boundary(const uint32_t *next, uint32_t vertices,
                                          const sample *s) {
    uint32_t *before = boundary_of_mesh(&s->mesh);
    for (uint32_t v = 0; v < s->mesh.vertices; v++)
        if ((before[v] == HS_REFERENCE_NONE) != (next[v] == HS_REFERENCE_NONE))
            fail_msg("%s: vertex %u has come to the boundary, or left it", s->name, v);
    assert_int_equal(count_loops(next, vertices), count_loops(before, s->mesh.vertices));
    free(before);
}

/* I1: every directed side occurs once, and its opposite does, unless it is on the boundary.
 * Boundary edges that are kept are all still there, and alone. */
static inline void check_conforming(const hs_reference *r, const sample *s) {
    row *sides = new_rows(r->final_corners);
    uint32_t count = 0, borders = 0, expected = 0, *next = new_boundary(r->vertices);
    for (uint32_t f = 0; f < r->finals; f++) {
        const hs_reference_list v = r->final[f].v;
        for (uint32_t k = 0; k < v.count; k++)
            sides[count++] = (row){
                {r->final_vertex[v.first + k], r->final_vertex[v.first + (k + 1) % v.count], 0, 0},
                f};
    }
    qsort(sides, count, sizeof *sides, by_key);
    for (uint32_t i = 0; i < count; i++) {
        const uint32_t v = sides[i].key[0], w = sides[i].key[1];
        if (i > 0 && by_key(&sides[i - 1], &sides[i]) == 0)
            fail_msg("%s: two faces run from %u to %u", s->name, v, w);
        const row opposite = {{w, v, 0, 0}, 0};
        if (bsearch(&opposite, sides, count, sizeof *sides, by_key)) continue;
        assert_int_equal(next[v], HS_REFERENCE_NONE);
        next[v] = w;
        borders++;
    }
    const bool kept = r->boundary == HS_BOUNDARY_KEPT;
    if (!kept) check_refined_boundary(next, r->vertices, s);
    free(next);
    for (uint32_t h = 0; kept && h < s->mesh.halfedges; h++) {
        if (s->mesh.twin[h] != HS_BORDER) continue;
        const uint32_t v = s->mesh.origin[h], w = s->mesh.origin[hs_next(&s->mesh, h)];
        const row here = {{v, w, 0, 0}, 0}, opposite = {{w, v, 0, 0}, 0};
        expected++;
        if (!bsearch(&here, sides, count, sizeof *sides, by_key) ||
            bsearch(&opposite, sides, count, sizeof *sides, by_key))
            fail_msg("%s: boundary edge from %u to %u is gone or inside", s->name, v, w);
    }
    free(sides);
    if (kept && borders != expected)
        fail_msg("%s: %u open edges, %u on the initial boundary", s->name, borders, expected);
}

#endif
