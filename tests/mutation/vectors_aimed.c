/* SPDX-License-Identifier: Apache-2.0 */
#include "../reference_shapes.h"
#include "../rtl_samples.h"
#include "vectors_make.h"

/* --- Errors: counts just beyond a limit, and two at a time
 * ----------------------------------------
 */

/* Faces, corners and vertices that a header claims. */
static void add_counts(vectors *all, hs_limits limits) {
    const uint32_t counts[][3] = {{limits.vertices + 1, 4, 12},
                                  {2 * limits.vertices, 4, 12},
                                  {limits.vertices, 4, 12},
                                  {4, 4, limits.quads + 1},
                                  {4, 4, 2 * limits.quads},
                                  {4, 4, limits.quads},
                                  {4, limits.quads / 3, limits.quads},
                                  {4, limits.quads / 3 + 1, limits.quads},
                                  {4, 1u << 31, 1u << 30},
                                  {4, 5, 15}};
    hs_mesh mesh;
    const hs_settings s = uniform(1);
    make_shape(&mesh, "tetrahedron", 0, 0);
    for (uint32_t i = 0; i < sizeof counts / sizeof *counts; i++) {
        hs_packet *packet =
            &add_view(all, "claimed counts", limits, &mesh, identity, &s, no_stalls)->in;
        packet->word[3] = counts[i][0];
        packet->word[4] = counts[i][1];
        packet->word[5] = counts[i][2];
        mend_crc(packet);
    }
    hs_mesh_free(&mesh);
}

/* Every other bit of the header and of two corners turned over: refused, or another view. */
static void add_bits(vectors *all, hs_limits limits) {
    hs_mesh mesh;
    const hs_settings s = adaptive(1, 2, true);
    make_shape(&mesh, "tetrahedron", 0, 0);
    const uint32_t from[] = {0, corner_at(mesh.vertices, 3), corner_at(mesh.vertices, 7)};
    const uint32_t words[] = {12, 4, 4};
    for (uint32_t k = 0; k < 3; k++)
        for (uint32_t bit = k % 2; bit < 32 * words[k]; bit += 2) {
            char text[80];
            const uint32_t word = from[k] + bit / 32;
            snprintf(text, sizeof text, "bit %u of word %u turned over", bit % 32, word);
            hs_packet *packet = &add_view(all, text, limits, &mesh, identity, &s, no_stalls)->in;
            packet->word[word] ^= 1u << bit % 32;
            mend_crc(packet);
        }
    hs_mesh_free(&mesh);
}

/* A vertex whose product with the matrix is no number of binary32, and behind it, in turn, one that
 * is infinite by itself, or another such. */
static void add_overflows(vectors *all, hs_limits limits) {
    for (uint32_t i = 0; i < 12; i++) {
        hs_mesh mesh;
        float matrix[16];
        const hs_settings s = uniform(1);
        make_shape(&mesh, "icosahedron", 0, 0);
        memcpy(matrix, identity, sizeof matrix);
        matrix[i % 4 * 5] = 0x1p100f;
        const uint32_t v = i, w = i % 3 ? v + i % 3 : 0;
        mesh.position[4 * v + i % 4] = 0x1p100f;
        const uint32_t vertices = mesh.vertices;
        hs_packet *packet = &add_view(all, "overflow", limits, &mesh, matrix, &s, no_stalls)->in;
        if (w && w < vertices) packet->word[VERTICES_AT + 4 * w] = i % 2 ? 0x7f800000 : 0x7f7fffff;
        mend_crc(packet);
        hs_mesh_free(&mesh);
    }
}

/* One corner too many at a vertex, and a wrong twin a power of two of corners before it, or behind.
 */
static void add_errors(vectors *all, hs_limits limits) {
    enum { FAN = HS_MAX_VALENCE + 3, WRONG = 3 * HS_MAX_VALENCE };
    for (uint32_t i = 0; i < 12; i++) {
        const uint32_t h = i < 10 ? WRONG - (1u << i) : WRONG + i - 10;
        hs_packet *packet = &add_fan(all, limits, FAN, 0)->in;
        packet->word[corner_at(FAN_VERTICES, h) + 1] = h < 300 ? h + 300 : h - 300;
        mend_crc(packet);
    }
}

/* As many vertices as there is room for, and a corner at the first number behind them, or at one a
 * bit of which is set besides. */
static void add_strangers(vectors *all, hs_limits limits) {
    hs_mesh mesh;
    hs_packet base = {0};
    hs_error err;
    const hs_settings s = uniform(1);
    make_shape(&mesh, "tetrahedron", 0, 0);
    if (!hs_packet_encode(&base, 9, &mesh, identity, &s, &err)) give_up("strangers", &err);
    const uint32_t vertices = mesh.vertices, halfedges = mesh.halfedges;
    hs_mesh_free(&mesh);
    for (uint32_t more = 0; more < limits.vertices; more = more ? 2 * more : 1) {
        char text[80];
        snprintf(text, sizeof text, "a corner at vertex %u of %u", limits.vertices + more,
                 limits.vertices);
        hs_packet *packet = &add_vector(all, text, limits, no_stalls)->in;
        bool good = hs_packet_append(packet, base.word, VERTICES_AT / 4 + vertices, &err);
        for (uint32_t v = vertices; good && v < limits.vertices; v++)
            good = hs_packet_append(packet, base.word + VERTICES_AT, 1, &err);
        if (!good ||
            !hs_packet_append(packet, base.word + corner_at(vertices, 0), halfedges + 1, &err))
            give_up(text, &err);
        packet->word[3] = limits.vertices;
        packet->word[corner_at(limits.vertices, 5)] = limits.vertices + more;
        mend_crc(packet);
    }
    hs_packet_free(&base);
}

/* Twins of four half-edges dealt anew: they point the wrong way. Some have another sharpness than
 * their twins, too; or another vertex. */
static void add_crossed(vectors *all, hs_limits limits) {
    uint64_t random = 91;
    for (uint32_t i = 0; i < 32; i++) {
        hs_mesh mesh;
        const hs_settings s = uniform(1);
        make_shape(&mesh,
                   i % 4 == 3   ? "random"
                   : i % 4 == 2 ? "icosahedron"
                                : "tetrahedron",
                   i % 4 == 3 ? 130 : 0, i);
        const uint32_t vertices = mesh.vertices, halfedges = mesh.halfedges;
        hs_packet *packet =
            &add_view(all, "crossed twins", limits, &mesh, identity, &s, no_stalls)->in;
        hs_mesh_free(&mesh);
#define CORNER(h) (packet->word + corner_at(vertices, h))
        const uint32_t a = random_below(&random, halfedges), b = CORNER(a)[1];
        const uint32_t c = random_below(&random, halfedges), d = CORNER(c)[1];
        if (b != HS_BORDER && d != HS_BORDER && a != c && a != d && i % 5 != 4) {
            CORNER(a)[1] = d;
            CORNER(d)[1] = a;
            CORNER(b)[1] = c;
            CORNER(c)[1] = b;
        }
        if (i % 3 == 1) CORNER(a)[3] ^= 1;
        if (i % 3 == 2) CORNER(random_below(&random, halfedges))[3] ^= 2;
        if (i % 5 == 4) CORNER(a)[0] = random_below(&random, vertices);
#undef CORNER
        mend_crc(packet);
    }
}

/* --- Numbers
 * --------------------------------------------------------------------------------------
 */

/* Zeros and subnormal numbers beside the largest ones: what little they make of each other is all
 * there is. */
static void add_zeros(vectors *all, hs_limits limits) {
    for (uint32_t i = 0; i < 4; i++) {
        static const float tiny[] = {0, 0x1p-149f, 0x1p-130f, 0x1p-126f};
        hs_mesh mesh;
        float matrix[16];
        make_shape(&mesh, "icosahedron", 0, 0);
        const float large = 0x1p126f;
        for (uint32_t k = 0; k < 4 * mesh.vertices; k++) {
            float *c = &mesh.position[k];
            *c = i % 2 ? tiny[k % 7 % 4] : large * (k % 4 == 3 ? 1 : *c / 4);
        }
        for (uint32_t k = 0; k < 16; k++)
            matrix[k] = i % 2 ? large / (float)(1 + k) : k == 15 ? 0x1p-126f : tiny[k % (1 + i)];
        const hs_settings s = uniform(1);
        add_view(all, "zeros beside large numbers", limits, &mesh, matrix, &s, no_stalls);
        hs_mesh_free(&mesh);
    }
}

/* Nothing but subnormal numbers, the largest of which has its leading one in each place in turn. */
static void add_subnormals(vectors *all, hs_limits limits) {
    for (int place = 0; place < 23; place++) {
        hs_mesh mesh;
        char text[80];
        const hs_settings s = uniform(1);
        make_shape(&mesh, "tetrahedron", 0, 0);
        for (uint32_t k = 0; k < 4 * mesh.vertices; k++)
            mesh.position[k] = ldexpf(k == 5       ? 1.25f
                                      : k % 4 == 3 ? 1
                                                   : 0.9f * mesh.position[k] / 2,
                                      place - 149);
        snprintf(text, sizeof text, "subnormal numbers up to 2^%d", place - 149);
        add_view(all, text, limits, &mesh, identity, &s, no_stalls);
        hs_mesh_free(&mesh);
    }
}

/* --- Limits, boundaries, sharpness
 * ---------------------------------------------------------------
 */

/* One of the sixteen views of a mesh, which is freed. */
static void add_seen(vectors *all, const char *name, hs_limits limits, hs_mesh *mesh, uint32_t v,
                     const hs_settings *settings) {
    hs_view view[VIEWS];
    make_views(mesh, view);
    add_view(all, name, limits, mesh, view[v].matrix, settings, no_stalls);
    hs_mesh_free(mesh);
}

/* Quads that just fit, or just do not. */
static void add_narrow(vectors *all, hs_limits limits) {
    static const char *const shape[] = {"cube", "icosahedron", "grid"};
    for (uint32_t i = 0; i < 36; i++) {
        hs_mesh mesh;
        char text[80];
        make_shape(&mesh, shape[i % 3], i % 3 == 2 ? 4 : 0, i);
        const hs_settings s = i % 4 == 3 ? uniform(4) : adaptive(3, 5, i % 2);
        const uint32_t quads = mesh.halfedges + i / 3 * 29;
        snprintf(text, sizeof text, "%s in %u quads", shape[i % 3], quads);
        add_seen(all, text, (hs_limits){limits.vertices, quads}, &mesh, i % 8, &s);
    }
}

/* Surfaces with a boundary, refined as a whole: vertices and faces of all counts, odd ones too. */
static void add_strips(vectors *all, hs_limits limits) {
    for (uint32_t i = 0; i < 24; i++) {
        hs_mesh mesh;
        char text[80];
        make_shape(&mesh, "grid", 1 + i % 4, i);
        hs_settings s = uniform((uint8_t)(4 + i / 4 % 3));
        s.boundary = modes[1 + i / 12];
        snprintf(text, sizeof text, "a whole grid %u", i);
        add_seen(all, text, limits, &mesh, i % 8, &s);
    }
}

/* All sharpnesses that there are, some levels deep. */
static void add_sharp(vectors *all, hs_limits limits) {
    static const char *const shape[] = {"cube", "tetrahedron", "grid"};
    uint32_t tags = 5;
    for (uint32_t i = 0; i < 24; i++) {
        hs_mesh mesh;
        char text[80];
        make_shape(&mesh, shape[i % 3], i % 3 == 2 ? 2 : 0, i);
        tag_at_random(&mesh, &tags, 1, 1 + i % 4);
        hs_settings s = i % 2 ? uniform((uint8_t)(3 + i % 3)) : adaptive(4, 5, true);
        s.boundary = modes[i / 3 % 3];
        s.limit = i % 7 == 3;
        snprintf(text, sizeof text, "sharp edges %u", i);
        add_seen(all, text, limits, &mesh, i % 8, &s);
    }
}

/* --- Short edges
 * ----------------------------------------------------------------------------------
 */

/* All on one point of the screen, so that only the ends' w count: of all sizes, and signs. */
static void add_points(vectors *all, hs_limits limits) {
    for (uint32_t i = 0; i < 4; i++) {
        hs_mesh mesh;
        float matrix[16] = {0};
        uint64_t random = i;
        make_shape(&mesh, "random", 40, i);
        for (uint32_t v = 0; v < mesh.vertices; v++) {
            float *p = &mesh.position[4 * v];
            p[0] = ldexpf(random_below(&random, 5) ? 1 : -1, -(int)random_below(&random, 33));
        }
        mesh.position[0] = 1;
        matrix[12] = 1; /* w is the vertex' x */
        if (i % 2) matrix[0] = 0x1p-20f;
        hs_settings s = adaptive(2, 3, i % 2);
        s.min_edge = (uint16_t)(1 + 300 * i);
        s.width = s.height = 1000;
        add_view(all, "edges that are points", limits, &mesh, matrix, &s, no_stalls);
        hs_mesh_free(&mesh);
    }
}

/* The least edge that makes a half-edge short by a hair. */
static double threshold(const hs_mesh *mesh, const float m[16], uint32_t h, const hs_settings *s) {
    double end[2][4];
    for (uint32_t e = 0; e < 2; e++) {
        const float *p = &mesh->position[4 * mesh->origin[e ? hs_next(mesh, h) : h]];
        for (uint32_t r = 0; r < 4; r++)
            end[e][r] = (double)m[4 * r] * (double)p[0] + (double)m[4 * r + 1] * (double)p[1] +
                        (double)m[4 * r + 2] * (double)p[2] + (double)m[4 * r + 3] * (double)p[3];
    }
    const double across = fabs(end[0][0] / end[0][3] - end[1][0] / end[1][3]) * 8 * s->width;
    const double up = fabs(end[0][1] / end[0][3] - end[1][1] / end[1][3]) * 8 * s->height;
    return 1 + floor(fmax(across, up));
}

/* Faces whose longest edge is just short, or just not. */
static void add_thresholds(vectors *all, hs_limits limits) {
    uint64_t random = 4;
    for (uint32_t i = 0; i < 32; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_shape(&mesh, "random", 24, i);
        make_views(&mesh, view);
        hs_settings s = adaptive(2, 3, true);
        s.width = (uint16_t)(1 + random_below(&random, 60000 >> i % 4 * 3));
        s.height = (uint16_t)(1 + random_below(&random, 60000 >> i % 4 * 3));
        const float *matrix = view[i % 8].matrix;
        const uint32_t f = random_below(&random, mesh.faces);
        double longest = 1;
        for (uint32_t h = mesh.first[f]; h < mesh.first[f + 1]; h++)
            longest = fmax(longest, threshold(&mesh, matrix, h, &s));
        s.min_edge = (uint16_t)fmin(longest, 65535);
        if (i % 2 && s.min_edge > 1) s.min_edge--;
        add_view(all, "a face at the threshold", limits, &mesh, matrix, &s, no_stalls);
        hs_mesh_free(&mesh);
    }
}

/* --- Order
 * ----------------------------------------------------------------------------------------
 */

static void shuffle(uint32_t *list, uint32_t n, uint64_t *random) {
    for (uint32_t i = 0; i < n; i++)
        list[i] = i;
    for (uint32_t i = n - 1; i > 0; i--) {
        const uint32_t k = random_below(random, i + 1), swapped = list[i];
        list[i] = list[k];
        list[k] = swapped;
    }
}

/* The corner of a face that is at a vertex, or the number of its corners. */
static uint32_t corner_with(const hs_mesh *mesh, uint32_t f, uint32_t v) {
    uint32_t k = 0;
    while (k < hs_sides(mesh, f) && mesh->origin[mesh->first[f] + k] != v)
        k++;
    return k;
}

/* Numbers the vertices by chance, and deals the faces anew: where one can, it begins at the corner
 * where the one before it ended, so that a vertex is met twice in a row. With holes: leaves out
 * faces that have no vertex in common. */
static void mix(hs_mesh *mesh, bool holes, uint64_t *random) {
    enum { MOST = 1024 };
    float position[4 * MOST];
    uint32_t sides[MOST], corner[MOST], vertex[MOST], face[MOST], corners = 0;
    assert_true(mesh->vertices <= MOST && mesh->halfedges <= MOST);
    shuffle(vertex, mesh->vertices, random);
    shuffle(face, mesh->faces, random);
    for (uint32_t v = 0; v < mesh->vertices; v++)
        memcpy(&position[4 * vertex[v]], &mesh->position[4 * v], 4 * sizeof *position);
    uint32_t ended = 0; /* the last corner's vertex in *mesh */
    uint32_t faces = 0;
    bool at_hole[MOST] = {false};
    for (uint32_t i = 0; i < mesh->faces; i++) {
        uint32_t best = i;
        while (best < mesh->faces &&
               corner_with(mesh, face[best], ended) == hs_sides(mesh, face[best]))
            best++;
        if (best == mesh->faces) best = i;
        const uint32_t f = face[best], n = hs_sides(mesh, f);
        face[best] = face[i];
        bool stays = !holes;
        for (uint32_t k = 0; k < n; k++)
            stays = stays || at_hole[mesh->origin[mesh->first[f] + k]];
        if (!stays) {
            for (uint32_t k = 0; k < n; k++)
                at_hole[mesh->origin[mesh->first[f] + k]] = true;
            continue;
        }
        const uint32_t turn = corner_with(mesh, f, ended);
        sides[faces++] = n;
        for (uint32_t k = 0; k < n; k++) {
            ended = mesh->origin[mesh->first[f] + (k + turn) % n];
            corner[corners++] = vertex[ended];
        }
    }
    const uint32_t vertices = mesh->vertices;
    hs_mesh_free(mesh);
    make_soup(mesh, vertices, position, faces, sides, corner);
}

static void add_mixed(vectors *all, hs_limits limits) {
    static const struct {
        const char *shape;
        uint32_t size;
        uint8_t forced; /* depth of the last third of the faces */
        hs_settings settings;
    } mixed[] = {
        {"random", 160, 0, {.uniform = true, .uniform_depth = 1}},
        {"random", 140, 3, {.front_depth = 1, .silhouette_depth = 1}},
        {"random", 120, 0, {.front_depth = 2, .silhouette_depth = 4}},
        {"grid", 16, 0, {.uniform = true, .uniform_depth = 0, .limit = true}},
        {"random", 100, 0, {.uniform = true, .uniform_depth = 0, .limit = true}},
        {"random", 90, 0, {.uniform = true, .uniform_depth = 1, .limit = true}},
        {"random", 80, 0, {.uniform = true, .uniform_depth = 1, .boundary = HS_BOUNDARY_EDGE_ONLY}},
        {"random",
         60,
         0,
         {.uniform = true, .uniform_depth = 2, .boundary = HS_BOUNDARY_SMOOTH, .limit = true}},
        {"random",
         70,
         0,
         {.front_depth = 1,
          .silhouette_depth = 2,
          .boundary = HS_BOUNDARY_EDGE_ONLY,
          .limit = true}},
        {"cube", 0, 0, {.uniform = true, .uniform_depth = 5}},
        {"random", 60, 0, {.front_depth = 2, .silhouette_depth = 3, .guard = true, .limit = true}},
        {"icosahedron", 0, 0, {.uniform = true, .uniform_depth = 5}},
        {"grid", 4, 0, {.uniform = true, .uniform_depth = 5}},
        {"grid", 3, 0, {.uniform = true, .uniform_depth = 5, .boundary = HS_BOUNDARY_SMOOTH}},
        {"grid",
         7,
         0,
         {.uniform = true, .uniform_depth = 2, .boundary = HS_BOUNDARY_SMOOTH, .limit = true}},
        {"grid", 3, 0, {.front_depth = 4, .silhouette_depth = 6, .guard = true}},
        {"cube", 0, 0, {.front_depth = 4, .silhouette_depth = 7, .guard = true}},
    };
    uint64_t random = 8;
    for (uint32_t i = 0; i < 3 * sizeof mixed / sizeof *mixed; i++) {
        const uint32_t kind = i / 3;
        hs_mesh mesh;
        hs_view view[VIEWS];
        uint32_t tags = 31 + i;
        const hs_stalls stalls = {.seed = i, .output = i % 2 ? 60 : 0};
        make_shape(&mesh, mixed[kind].shape, mixed[kind].size, i);
        mix(&mesh, mixed[kind].settings.boundary != HS_BOUNDARY_KEPT, &random);
        if (i % 2) tag_at_random(&mesh, &tags, 1 + kind % 3, 5);
        for (uint32_t f = 2 * mesh.faces / 3; f < mesh.faces; f++)
            mesh.forced[f] = mixed[kind].forced;
        make_views(&mesh, view);
        add_view(all, "mixed", limits, &mesh, view[i % 8].matrix, &mixed[kind].settings, stalls);
        hs_mesh_free(&mesh);
    }
}

void add_aimed(vectors *all, hs_limits limits) {
    add_counts(all, limits);
    add_bits(all, limits);
    add_overflows(all, limits);
    add_errors(all, limits);
    add_strangers(all, limits);
    add_crossed(all, limits);
    add_zeros(all, limits);
    add_subnormals(all, limits);
    add_narrow(all, limits);
    add_strips(all, limits);
    add_sharp(all, limits);
    add_points(all, limits);
    add_thresholds(all, limits);
    add_mixed(all, limits);
}
