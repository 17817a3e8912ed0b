/* SPDX-License-Identifier: Apache-2.0
 *
 * The list of shapes, and the simple ones.
 */
#include "shape.h"

#include <string.h>

#include "shape_kit.h"

/* --- Simple shapes --------------------------------------------------------------------------- */

static void make_cube(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)seed;
    uint32_t n[3] = {size, size, size};
    hs_cage_box(cage, n);
}

static void make_tetrahedron(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    /* Every other corner of the cube. */
    uint32_t a = hs_cage_point(cage, hs_vec_of(1, 1, 1));
    uint32_t b = hs_cage_point(cage, hs_vec_of(-1, -1, 1));
    uint32_t c = hs_cage_point(cage, hs_vec_of(1, -1, -1));
    uint32_t d = hs_cage_point(cage, hs_vec_of(-1, 1, -1));
    hs_cage_triangle(cage, a, b, c);
    hs_cage_triangle(cage, a, d, b);
    hs_cage_triangle(cage, a, c, d);
    hs_cage_triangle(cage, b, d, c);
}

static void make_icosahedron(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)size;
    (void)seed;
    /* A pole, two rings of five at latitudes of +-atan(1/2), the second turned by 36 degrees, and
     * the other pole. */
    double height = 0.4472135954999579393, radius = 2 * height; /* 1/sqrt(5), 2/sqrt(5) */
    uint32_t north = hs_cage_point(cage, hs_vec_of(0, 1, 0)), upper[5], lower[5];
    for (uint32_t i = 0; i < 5; i++) {
        double at = 72.0 * i;
        upper[i] = hs_cage_point(
            cage, hs_vec_of(radius * hs_sin_degrees(at), height, radius * hs_cos_degrees(at)));
    }
    for (uint32_t i = 0; i < 5; i++) {
        double at = 72.0 * i + 36;
        lower[i] = hs_cage_point(
            cage, hs_vec_of(radius * hs_sin_degrees(at), -height, radius * hs_cos_degrees(at)));
    }
    uint32_t south = hs_cage_point(cage, hs_vec_of(0, -1, 0));
    for (uint32_t i = 0; i < 5; i++) {
        uint32_t next = (i + 1) % 5;
        hs_cage_triangle(cage, north, upper[i], upper[next]);
        hs_cage_triangle(cage, upper[i], lower[i], upper[next]);
        hs_cage_triangle(cage, upper[next], lower[i], lower[next]);
        hs_cage_triangle(cage, lower[i], south, lower[next]);
    }
}

void hs_shape_torus(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)seed;
    uint32_t around = size, tube = (size + 1) / 2;
    for (uint32_t i = 0; i < around; i++)
        for (uint32_t j = 0; j < tube; j++) {
            double at = 360.0 * i / around, of = 360.0 * j / tube;
            double radius = 1 + 0.4 * hs_cos_degrees(of);
            hs_cage_point(cage, hs_vec_of(radius * hs_sin_degrees(at), 0.4 * hs_sin_degrees(of),
                                          radius * hs_cos_degrees(at)));
        }
    for (uint32_t i = 0; i < around; i++)
        for (uint32_t j = 0; j < tube; j++) {
            uint32_t here = i * tube, there = (i + 1) % around * tube, up = (j + 1) % tube;
            hs_cage_quad(cage, here + j, there + j, there + up, here + up);
        }
}

static void make_grid(hs_cage *cage, uint32_t size, uint32_t seed) {
    (void)seed;
    for (uint32_t j = 0; j <= size; j++)
        for (uint32_t i = 0; i <= size; i++)
            hs_cage_point(cage, hs_vec_of(2.0 * i / size - 1, 2.0 * j / size - 1, 0));
    for (uint32_t j = 0; j < size; j++)
        for (uint32_t i = 0; i < size; i++) {
            uint32_t p = j * (size + 1) + i;
            hs_cage_quad(cage, p, p + 1, p + size + 2, p + size + 1);
        }
}

/* --- The list -------------------------------------------------------------------------------- */

const hs_shape hs_shapes[] = {
    {"hand", "an open right hand, palm to the front", 0, 0, 0, false, hs_shape_hand},
    {"monster", "the head of a horned monster", 0, 0, 0, false, hs_shape_monster},
    {"spoon", "a thin spoon: one sheet, one boundary", 0, 0, 0, false, hs_shape_spoon},
    {"pot", "a teapot: body, lid and open spout, with boundaries", 0, 0, 0, false, hs_shape_pot},
    {"die", "a die; its edges are sharp for size - 1 levels, at 11 for ever", 11, 1, 11, false,
     hs_shape_die},
    {"cube", "a cube of size x size quads a side", 1, 1, 256, false, make_cube},
    {"tetrahedron", "four triangles", 0, 0, 0, false, make_tetrahedron},
    {"icosahedron", "twenty triangles", 0, 0, 0, false, make_icosahedron},
    {"torus", "a ring of quads, size around it and half as many around its tube", 24, 5, 1024,
     false, hs_shape_torus},
    {"grid", "size x size quads in the plane z = 0, with a boundary", 8, 1, 1024, false, make_grid},
    {"mixed", "valences 3 to 12 and faces of 3 to 9 sides", 0, 0, 0, false, hs_shape_mixed},
    {"random", "a closed body of about size random faces; a torus if the seed is odd", 200, 24,
     200000, true, hs_shape_random},
    {NULL, NULL, 0, 0, 0, false, NULL},
};

static bool fail_name(const char *name, hs_error *err) {
    char list[300] = "";
    for (const hs_shape *s = hs_shapes; s->name; s++) {
        strcat(list, s == hs_shapes ? "" : ", ");
        strcat(list, s->name);
    }
    return hs_fail(err, HS_EXIT_USAGE, "there is no shape called '%s'; the shapes are %s", name,
                   list);
}

bool hs_shape_make(hs_mesh *mesh, const char *name, uint32_t size, uint32_t seed, hs_error *err) {
    *mesh = (hs_mesh){0};
    const hs_shape *shape = hs_shapes;
    while (shape->name && strcmp(shape->name, name) != 0)
        shape++;
    if (!shape->name) return fail_name(name, err);
    if (size == 0)
        size = shape->size;
    else if (shape->max_size == 0)
        return hs_fail(err, HS_EXIT_USAGE, "%s: this shape has no size; leave the size out", name);
    if (size < shape->min_size || size > shape->max_size)
        return hs_fail(err, HS_EXIT_USAGE, "%s: the size %u is outside %u to %u", name, size,
                       shape->min_size, shape->max_size);
    hs_cage cage;
    hs_cage_init(&cage);
    if (!cage.failed) shape->build(&cage, size, seed);
    bool ok = hs_cage_mesh(&cage, name, mesh, err);
    hs_cage_free(&cage);
    return ok;
}
