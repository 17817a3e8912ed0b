/* SPDX-License-Identifier: Apache-2.0
 *
 * From a seed to a case. The mesh is made in a box of about +-1 around the origin, the view is made
 * of that, and then the coordinates are spoiled, and the matrix, if it should, takes that back.
 */
#include "campaign_case.h"

#include "reference_shapes.h"
#include "rtl_samples.h"
#include "shape_kit.h"

#define WHAT(name, what) what,
const char *const mesh_kind[MESHES] = {MESH_KINDS(WHAT)};
const char *const coordinate_kind[COORDINATES] = {COORDINATE_KINDS(WHAT)};
const char *const view_kind[VIEW_TYPES] = {VIEW_KINDS(WHAT)};
#undef WHAT

static bool chance(uint64_t *random, uint32_t percent) {
    return hs_random_below(random, 100) < percent;
}

static uint32_t between(uint64_t *random, uint32_t least, uint32_t most) {
    return least + hs_random_below(random, most - least + 1);
}

/* Small numbers mostly, and now and then up to most. */
static uint32_t heavy_tail(uint64_t *random, uint32_t least, uint32_t usual, uint32_t most) {
    return between(random, least, chance(random, 88) ? usual : most);
}

/* --- Meshes -------------------------------------------------------------------------------------
 */

static void make_prism(hs_mesh *mesh, uint32_t n) {
    static float position[8 * HS_MAX_SIDES];
    static uint32_t sides[HS_MAX_SIDES + 2], corner[6 * HS_MAX_SIDES];
    make_ring(position, n, false);
    memcpy(position + 4 * (size_t)n, position, 4 * (size_t)n * sizeof *position);
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t j = (i + 1) % n, wall[4] = {j, i, n + i, n + j};
        position[4 * (n + i) + 1] = 1;
        sides[i] = 4;
        memcpy(corner + 4 * (size_t)i, wall, sizeof wall);
        corner[4 * n + i] = i;
        corner[5 * n + i] = 2 * n - 1 - i;
    }
    sides[n] = sides[n + 1] = n;
    make_soup(mesh, 2 * n, position, n + 2, sides, corner);
}

static void make_base(hs_mesh *mesh, uint32_t kind, uint64_t *random) {
    const uint32_t n = heavy_tail(random, 3, 30, kind == MESH_prism ? 200 : 255);
    switch (kind) {
    case MESH_cube:
        build_random_cube(mesh, 1 + hs_random_below(random, 1u << 30));
        return;
    case MESH_grid:
        build_grid(mesh, between(random, 1, 7), between(random, 1, 7));
        return;
    case MESH_torus:
        make_shape(mesh, "torus", between(random, 5, 12), 0);
        return;
    case MESH_prism:
        make_prism(mesh, n);
        return;
    case MESH_bicone:
        make_bicone(mesh, n);
        return;
    case MESH_pillow:
        make_pillow(mesh, n);
        return;
    case MESH_cone:
        build_cone(mesh, n < 255 ? n : 254, chance(random, 50));
        return;
    case MESH_polygon:
        build_polygon(mesh, n);
        return;
    case MESH_body:
        make_shape(mesh, "random", between(random, 24, 70), hs_random_below(random, 1u << 30));
        return;
    default:
        make_shape(mesh, "mixed", 0, 0);
        return;
    }
}

/* One change of a kind that keeps it a mesh; whether it was made does not matter. opens: faces may
 * go. */
static void change_polygons(polygons *p, bool opens, uint64_t *random) {
    const uint32_t f = hs_random_below(random, p->faces), sides = p->sides[f];
    const uint32_t i = hs_random_below(random, sides), j = hs_random_below(random, sides);
    const float height = (float)hs_random_signed(random) * 0.3f;
    static bool keep[POLYGONS_FACES];
    switch (hs_random_below(random, opens ? 9 : 7)) {
    case 0:
        polygons_poke(p, f, height);
        break;
    case 1:
        polygons_split(p, f, i < j ? i : j, i < j ? j : i);
        break;
    case 2:
    case 3:
        polygons_merge(p, f, i);
        break;
    case 4:
        polygons_extrude(p, f, height);
        break;
    case 5: /* an edge cut again and again: an n-gon, and vertices of two faces */
        for (uint32_t k = heavy_tail(random, 1, 3, 40); k > 0; k--)
            polygons_cut_edge(p, f, hs_random_below(random, p->sides[f]));
        break;
    case 6:
        polygons_collapse(p, p->corner[polygons_first(p, f) + i],
                          p->corner[polygons_first(p, f) + j]);
        break;
    default: /* a hole, or part of it gone */
        if (p->faces < 2) break;
        memset(keep, true, sizeof keep);
        for (uint32_t k = heavy_tail(random, 1, 2, 8); k > 0; k--)
            keep[hs_random_below(random, p->faces)] = false;
        polygons_keep(p, keep);
        break;
    }
}

static void make_polygons(polygons *p, uint32_t kind, uint64_t *random) {
    hs_mesh mesh = {0};
    if (kind == MESH_parts) {
        static polygons other;
        make_polygons(p, hs_random_below(random, MESH_torus), random);
        for (uint32_t parts = between(random, 1, 3); parts > 0; parts--) {
            const float offset[3] = {(float)hs_random_signed(random) * 3,
                                     (float)hs_random_signed(random) * 3,
                                     (float)hs_random_signed(random) * 3};
            make_base(&mesh, hs_random_below(random, MESH_polygon), random);
            if (polygons_of_mesh(&other, &mesh)) polygons_append(p, &other, offset);
            hs_mesh_free(&mesh);
        }
        return;
    }
    make_base(&mesh, kind, random);
    if (!polygons_of_mesh(p, &mesh)) fail_msg("a mesh of %u faces is too large", mesh.faces);
    hs_mesh_free(&mesh);
    const bool opens = chance(random, 40);
    for (uint32_t n = chance(random, 30) ? 0 : heavy_tail(random, 0, 8, 40); n > 0; n--)
        change_polygons(p, opens, random);
}

/* Into a box of about +-1. */
static void normalize_polygons(polygons *p) {
    float low[3], high[3], size = 0;
    for (int k = 0; k < 3; k++) {
        low[k] = high[k] = p->position[0][k];
        for (uint32_t v = 1; v < p->vertices; v++) {
            low[k] = fminf(low[k], p->position[v][k]);
            high[k] = fmaxf(high[k], p->position[v][k]);
        }
        size = fmaxf(size, (high[k] - low[k]) / 2);
    }
    for (uint32_t v = 0; v < p->vertices; v++)
        for (int k = 0; k < 3; k++)
            p->position[v][k] =
                (p->position[v][k] - (low[k] + high[k]) / 2) / (size > 0 ? size : 1);
}

/* Sharp edges, vertices, forced depths: none, some, or many. */
static void tag_polygons(polygons *p, uint64_t *random) {
    hs_mesh mesh = {0};
    hs_error err;
    uint32_t tags = 1 + hs_random_below(random, 1u << 30);
    if (chance(random, 50) && polygons_build(p, &mesh, &err)) {
        tag_at_random(&mesh, &tags, between(random, 1, 12), between(random, 2, 30));
        if (mesh.halfedges + mesh.vertices <= POLYGONS_TAGS) polygons_of_mesh(p, &mesh);
        hs_mesh_free(&mesh);
    }
    if (chance(random, 75)) return;
    uint32_t left = 0, depth = 0;
    for (uint32_t f = 0; f < p->faces; f++, left--) {
        if (left == 0) {
            left = between(random, 1, p->faces);
            depth = hs_random_below(random, 5);
        }
        p->forced[f] = (uint8_t)depth;
    }
}

/* --- Coordinates --------------------------------------------------------------------------------
 */

/* Changes coordinates; scale[k] is by what axis k was multiplied. */
static void spoil_coordinates(polygons *p, uint32_t kind, uint64_t *random, double scale[3]) {
    const double shift = pow(10, between(random, 1, 6));
    const uint32_t some = between(random, 2, 6);
    scale[0] = scale[1] = scale[2] = 1;
    for (int k = 0; k < 3; k++)
        if (kind == COORDINATES_stretched)
            scale[k] = pow(10, 6 * hs_random_signed(random));
        else if (kind == COORDINATES_tiny || kind == COORDINATES_huge)
            scale[k] = k ? scale[0]
                         : ldexp(1, kind == COORDINATES_tiny ? -(int)between(random, 60, 148)
                                                             : (int)between(random, 40, 120));
    for (uint32_t v = 0; v < p->vertices; v++) {
        float *q = p->position[v];
        const bool chosen = hs_random_below(random, some) == 0;
        for (int k = 0; k < 3; k++) {
            if (kind == COORDINATES_plain) q[k] += (float)hs_random_signed(random) * 0.05f;
            if (kind == COORDINATES_lattice) q[k] = roundf(q[k] * 2) / 2;
            if (kind == COORDINATES_coincident && chosen) q[k] = p->position[0][k];
            if (kind == COORDINATES_distant) q[k] += (float)shift;
            q[k] = (float)((double)q[k] * scale[k]);
        }
        if (kind == COORDINATES_rational) {
            q[3] = (float)pow(2, 2 * hs_random_signed(random));
            for (int k = 0; k < 3; k++)
                q[k] *= q[3];
        }
        if (kind == COORDINATES_infinite && chosen) q[3] = chance(random, 50) ? 0 : -q[3];
    }
}

/* --- Views --------------------------------------------------------------------------------------
 */

static void random_direction(double d[3], uint64_t *random) {
    double length = 0;
    while (length < 0.1 || length > 1) {
        length = 0;
        for (int k = 0; k < 3; k++) {
            d[k] = hs_random_signed(random);
            length += d[k] * d[k];
        }
    }
    for (int k = 0; k < 3; k++)
        d[k] /= sqrt(length);
}

/* Eye and target in the directions d and, across it, e. */
static void random_look(hs_view *view, double eye, double at, double aside, double fov,
                        uint64_t *random) {
    hs_error err;
    double d[3], e[3], from[3], to[3];
    do {
        random_direction(d, random);
        random_direction(e, random);
        const double along = d[0] * e[0] + d[1] * e[1] + d[2] * e[2];
        for (int k = 0; k < 3; k++) {
            from[k] = eye * d[k];
            to[k] = at * d[k] + aside * (e[k] - along * d[k]);
        }
    } while (!hs_view_look(view, from, to, e, fov, 1.25, 0.01 * fmax(eye, 0.1), 1000 * fmax(eye, 1),
                           &err));
}

/* The eye in a plane through a vertex that an axis stands upon, and looking along it. */
static void graze(hs_view *view, const polygons *p, uint64_t *random) {
    hs_error err;
    const uint32_t axis = hs_random_below(random, 3);
    const float *v = p->position[hs_random_below(random, p->vertices)];
    double eye[3] = {0}, at[3] = {0}, up[3] = {0};
    eye[axis] = at[axis] = (double)v[axis];
    eye[(axis + 1) % 3] = chance(random, 50) ? 3 : -5;
    eye[(axis + 2) % 3] = chance(random, 50) ? 0 : hs_random_signed(random);
    up[axis] = 1;
    if (!hs_view_look(view, eye, at, up, 50, 1, 0.1, 100, &err)) fail_msg("%s", err.text);
}

static void eye_in_vertex(hs_view *view, const polygons *p, uint64_t *random) {
    hs_error err;
    double eye[3], at[3], up[3];
    const float *v = p->position[hs_random_below(random, p->vertices)];
    do {
        random_direction(at, random);
        random_direction(up, random);
        for (int k = 0; k < 3; k++) {
            eye[k] = (double)v[k];
            at[k] += eye[k];
        }
    } while (!hs_view_look(view, eye, at, up, 90, 1, 0.001, 100, &err));
}

static void make_orthographic(float matrix[16], uint64_t *random) {
    hs_view turned;
    random_look(&turned, 3, 0, 0, 90, random);
    const float zoom = 0.3f + (float)hs_random_below(random, 100) / 50;
    memset(matrix, 0, 16 * sizeof *matrix);
    for (int i = 0; i < 3; i++) { /* a perspective's rows are right, above, and, in w, sight */
        matrix[i] = turned.matrix[i] * zoom;
        matrix[4 + i] = turned.matrix[4 + i] * zoom;
        matrix[8 + i] = turned.matrix[12 + i] * 0.5f;
    }
    matrix[15] = 1;
}

static void make_numbers(float matrix[16], uint32_t kind, uint64_t *random) {
    float row[4], column[4];
    for (int i = 0; i < 4; i++) {
        row[i] = (float)hs_random_signed(random);
        column[i] = (float)hs_random_signed(random);
    }
    for (int i = 0; i < 16; i++)
        matrix[i] = kind == VIEW_identity   ? (float)(i % 5 == 0)
                    : kind == VIEW_zero     ? 0
                    : kind == VIEW_integers ? (float)between(random, 0, 4) - 2
                    : kind == VIEW_rank_one ? row[i / 4] * column[i % 4]
                                            : (float)hs_random_signed(random);
}

static void make_view(float matrix[16], uint32_t kind, const polygons *p, uint64_t *random) {
    hs_view view;
    memset(&view, 0, sizeof view);
    const double near = 1.2 + 0.01 * hs_random_below(random, 60);
    const uint32_t row = hs_random_below(random, 4);
    switch (kind) {
    case VIEW_close:
        random_look(&view, near, 0.3, 0.3, 20 + hs_random_below(random, 40), random);
        break;
    case VIEW_inside:
        random_look(&view, 0.3, 2, 1, 90, random);
        break;
    case VIEW_corner:
        eye_in_vertex(&view, p, random);
        break;
    case VIEW_grazing:
        graze(&view, p, random);
        break;
    case VIEW_far:
        random_look(&view, pow(10, between(random, 1, 6)), 0, 0, 30, random);
        break;
    case VIEW_behind:
        random_look(&view, 4, 9, 0, 45, random);
        break;
    case VIEW_across:
        random_look(&view, 0.4, 0.4, 1, 70, random);
        break;
    case VIEW_beside:
        random_look(&view, 4, 0, 12, 40, random);
        break;
    case VIEW_orthographic:
        make_orthographic(view.matrix, random);
        break;
    case VIEW_identity:
    case VIEW_zero:
    case VIEW_integers:
    case VIEW_rank_one:
    case VIEW_any:
        make_numbers(view.matrix, kind, random);
        break;
    default:
        random_look(&view, 2 + 0.02 * hs_random_below(random, 100), 0, 0, 40, random);
        break;
    }
    const double large = kind == VIEW_large   ? ldexp(1, (int)between(random, 40, 125))
                         : kind == VIEW_small ? ldexp(1, -(int)between(random, 40, 148))
                                              : 1;
    for (uint32_t i = 0; i < 16; i++) {
        matrix[i] = (float)((double)view.matrix[i] * large);
        if (kind == VIEW_mirrored && i / 4 == row % 2) matrix[i] = -matrix[i];
        if (kind == VIEW_negated) matrix[i] = -matrix[i];
        if (kind == VIEW_zero_row && i / 4 == row) matrix[i] = 0;
        if (kind == VIEW_equal_rows && i / 4 == row)
            matrix[i] = matrix[4 * ((row + 1) % 4) + i % 4];
        if (!isfinite(matrix[i])) matrix[i] = copysignf(3e38f, matrix[i]);
    }
    for (uint32_t i = 0; kind == VIEW_equal_rows && i < 4; i++)
        matrix[4 * row + i] = matrix[4 * ((row + 1) % 4) + i];
}

/* The view of what the coordinates were before they were scaled, as far as numbers reach. */
static void unscale_view(float matrix[16], const double scale[3]) {
    for (int i = 0; i < 16; i++) {
        if (i % 4 == 3) continue;
        const double m = (double)matrix[i] / scale[i % 4];
        matrix[i] = (float)(fabs(m) < 1e38 ? m : copysign(1e38, m));
    }
}

/* --- Settings -----------------------------------------------------------------------------------
 */

/* Cycles that a view takes at most, roughly: every face refined to the depth. */
static double most_cycles(const polygons *p, uint32_t depth) {
    return 5.0 * p->corners + 2.5 * p->corners * ldexp(1, (int)depth);
}

static uint8_t lower(const polygons *p, uint32_t depth, double budget) {
    while (depth > 0 && most_cycles(p, depth) > budget)
        depth--;
    return (uint8_t)depth;
}

static hs_settings make_settings(polygons *p, uint64_t *random) {
    /* Log-uniform from 2^12 to 2^20 cycles; most views stay far below. */
    const double budget = ldexp(1, 12) * pow(2, 4 * (1 + hs_random_signed(random)));
    hs_settings s = {.boundary = modes[hs_random_below(random, 3)],
                     .limit = chance(random, 35),
                     .guard = chance(random, 70)};
    if (chance(random, 30)) {
        s.uniform = true;
        s.uniform_depth = lower(p, hs_random_below(random, 10), budget);
    } else {
        s.front_depth = lower(p, heavy_tail(random, 0, 7, 14), budget);
        s.silhouette_depth = lower(p, heavy_tail(random, 0, 9, 14), budget);
    }
    if (chance(random, 30)) {
        s.min_edge = (uint16_t)between(random, 1, chance(random, 20) ? 65535 : 1500);
        s.width = (uint16_t)between(random, 1, chance(random, 20) ? 65535 : 1500);
        s.height = (uint16_t)between(random, 1, chance(random, 20) ? 65535 : 1500);
    }
    for (uint32_t f = 0; f < p->faces; f++)
        p->forced[f] = lower(p, p->forced[f], budget);
    return s;
}

/* Room for the mesh, and not for much more. */
static hs_limits make_limits(const polygons *p, uint64_t *random) {
    if (!chance(random, 20)) return HS_DEFAULT_LIMITS;
    return (hs_limits){.vertices = p->vertices + hs_random_below(random, 4 * p->vertices + 20),
                       .quads = p->corners + hs_random_below(random, 4 * p->corners + 20)};
}

static hs_stalls make_stalls(uint64_t *random) {
    return (hs_stalls){.seed = hs_random_below(random, UINT32_MAX),
                       .input = (uint8_t)(chance(random, 25) ? between(random, 1, 95) : 0),
                       .output = (uint8_t)(chance(random, 25) ? between(random, 1, 95) : 0)};
}

/* --- The case -----------------------------------------------------------------------------------
 */

void campaign_make(campaign_case *c, uint64_t seed) {
    uint64_t state = seed, *random = &state;
    double scale[3];
    hs_random_next(random);
    *c = (campaign_case){.seed = seed,
                         .mesh = hs_random_below(random, MESHES),
                         .coordinates = chance(random, 50) ? (uint32_t)COORDINATES_plain
                                                           : hs_random_below(random, COORDINATES),
                         .view = (uint32_t)(seed % VIEW_TYPES),
                         .number = hs_random_below(random, 65536),
                         .fault_at = hs_random_below(random, 1u << 30)};
    if (c->mesh == MESH_mixed && !chance(random, 30)) c->mesh = MESH_body;
    if (seed % 10 == 9) {
        c->fault = FIRST_FAULT + (uint32_t)(seed / 10 % FAULTS);
        if (c->fault == HS_STATUS_BAD_VALENCE) c->mesh = MESH_bicone;
    }
    if (c->fault == HS_STATUS_BAD_VALENCE) {
        hs_mesh mesh;
        make_bicone(&mesh, between(random, 128, 255));
        polygons_of_mesh(&c->shape, &mesh);
        hs_mesh_free(&mesh);
    } else {
        make_polygons(&c->shape, c->mesh, random);
    }
    normalize_polygons(&c->shape);
    tag_polygons(&c->shape, random);
    make_view(c->matrix, c->view, &c->shape, random);
    spoil_coordinates(&c->shape, c->coordinates, random, scale);
    if (!chance(random, 20)) unscale_view(c->matrix, scale);
    c->settings = make_settings(&c->shape, random);
    c->limits = make_limits(&c->shape, random);
    c->stalls = make_stalls(random);
}

bool campaign_good_packet(const campaign_case *c, hs_packet *packet, hs_error *err) {
    hs_mesh mesh;
    if (!polygons_build(&c->shape, &mesh, err)) return false;
    const bool good = hs_packet_encode(packet, c->number, &mesh, c->matrix, &c->settings, err);
    hs_mesh_free(&mesh);
    return good;
}

bool campaign_packet(const campaign_case *c, hs_packet *packet, hs_limits *limits, uint32_t *wanted,
                     hs_error *err) {
    *limits = c->limits;
    *wanted = HS_STATUS_OK;
    if (!campaign_good_packet(c, packet, err)) return false;
    if (c->fault && campaign_spoil(packet, limits, c->fault, c->fault_at)) *wanted = c->fault;
    return true;
}
