/* SPDX-License-Identifier: Apache-2.0 */
#include "vectors_make.h"
#include "../reference_shapes.h"
#include "../rtl_samples.h"
#include "trace.h"

static void *grow(void *array, size_t count, size_t size) {
    if ((count & (count + 1)) != 0 && array)
        return array; /* room up to the next power of two, less one */
    void *larger = realloc(array, (2 * count + 2) * size);
    if (!larger) exit(HS_EXIT_INTERNAL);
    return larger;
}

void give_up(const char *what, const hs_error *err) {
    fprintf(stderr, "mutation: %s: %s\n", what, err->text);
    exit(HS_EXIT_DIFFERENT);
}

vector *add_vector(vectors *all, const char *name, hs_limits limits, hs_stalls stalls) {
    all->item = grow(all->item, all->count, sizeof *all->item);
    vector *v = &all->item[all->count++];
    memset(v, 0, sizeof *v);
    snprintf(v->name, sizeof v->name, "%s", name);
    v->limits = limits;
    v->stalls = stalls;
    return v;
}

vector *add_view(vectors *all, const char *name, hs_limits limits, const hs_mesh *mesh,
                 const float matrix[16], const hs_settings *settings, hs_stalls stalls) {
    hs_error err;
    vector *v = add_vector(all, name, limits, stalls);
    if (!hs_packet_encode(&v->in, all->count, mesh, matrix, settings, &err)) give_up(name, &err);
    return v;
}

static void copy_packet(hs_packet *to, const hs_packet *from) {
    hs_error err;
    to->view = from->view;
    if (!hs_packet_append(to, from->word, from->words / 4, &err)) give_up("vectors", &err);
    to->words = from->words;
}

/* A few small views, in which most stages do most of what they can. */
static void add_first(vectors *all, hs_limits limits) {
    static const struct {
        const char *shape;
        uint32_t size;
        hs_settings settings;
        hs_stalls stalls;
    } first[] = {
        {"cube", 0, {.front_depth = 2, .silhouette_depth = 3, .guard = true}, {0}},
        {"grid",
         3,
         {.front_depth = 2, .silhouette_depth = 2, .boundary = HS_BOUNDARY_SMOOTH},
         {3, 0, 50}},
        {"tetrahedron", 0, {.uniform = true, .uniform_depth = 3, .limit = true}, {5, 40, 0}},
        {"random",
         24,
         {.front_depth = 3,
          .silhouette_depth = 4,
          .guard = true,
          .min_edge = 900,
          .width = 640,
          .height = 480},
         {0}},
    };
    for (uint32_t i = 0; i < sizeof first / sizeof *first; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        uint32_t tags = 77;
        make_shape(&mesh, first[i].shape, first[i].size, 1);
        if (i == 1) tag_at_random(&mesh, &tags, 3, 4);
        make_views(&mesh, view);
        add_view(all, first[i].shape, limits, &mesh, view[2 + i].matrix, &first[i].settings,
                 first[i].stalls);
        hs_mesh_free(&mesh);
    }
}

static void add_trace(vectors *all, const char *name, hs_limits limits) {
    hs_stream_file input;
    hs_error err;
    char path[100], text[80];
    snprintf(path, sizeof path, "traces/%s/input.hss", name);
    if (!hs_stream_file_read(&input, path, &err)) give_up(path, &err);
    for (uint32_t i = 0; i < input.packets; i++) {
        snprintf(text, sizeof text, "trace %s, view %u", name, i);
        copy_packet(&add_vector(all, text, limits, no_stalls)->in, &input.packet[i]);
    }
    hs_stream_file_free(&input);
}

/* Chance, and how many vectors it has made. */
typedef struct chance {
    uint64_t random;
    uint32_t tags, made;
} chance;

/* Meshes, tags, settings, views and stalls by chance, until so many are made. */
static void add_random(vectors *all, hs_limits limits, chance *c, uint32_t wanted) {
    static const char *const name[] = {"grid", "cube", "icosahedron", "random", "tetrahedron"};
    for (; c->made < wanted; c->made++) {
        const uint32_t i = c->made;
        hs_mesh mesh;
        hs_view view[VIEWS];
        char text[80];
        if (i % 6 == 5)
            build_random_cube(&mesh, i + 1);
        else if (i % 8 == 3)
            make_bicone(&mesh, 3 + random_below(&c->random, 12));
        else if (i % 8 == 4)
            make_pillow(&mesh, 3 + random_below(&c->random, 20));
        else
            make_shape(&mesh, name[i % 5],
                       i % 5 == 3 ? 24 + random_below(&c->random, 10)
                       : i % 5    ? 0
                                  : 2,
                       i);
        if (i % 3 != 2) tag_at_random(&mesh, &c->tags, 2 + i % 9, 3 + i % 20);
        for (uint32_t f = 0; i % 5 == 0 && f < mesh.faces; f++)
            mesh.forced[f] = (uint8_t)random_below(&c->random, 4);
        make_views(&mesh, view);
        hs_settings s = any_settings(&c->random);
        if (s.uniform_depth > 3) s.uniform_depth = 3;
        if (s.silhouette_depth > 5) s.silhouette_depth = 5;
        const hs_stalls stalls = {.seed = i,
                                  .input = i % 3 ? 0 : 40,
                                  .output = i % 2 ? 0 : (uint8_t)random_below(&c->random, 90)};
        const uint32_t v = random_below(&c->random, VIEWS);
        snprintf(text, sizeof text, "random %u, %s", i, view_name[v]);
        add_view(all, text, limits, &mesh, view[v].matrix, &s, stalls);
        hs_mesh_free(&mesh);
    }
}

/* A small packet with a word changed, or cut, or drawn out; all words of the header, and some of
 * each kind behind it. */
static void add_hostile(vectors *all, hs_limits limits) {
    static const uint32_t values[] = {0, 1, 3, 4, 255, 256, 0x7f7fffff, 0x7f800000, 0xffffffff};
    hs_mesh mesh;
    hs_view view[VIEWS];
    hs_packet good = {0};
    hs_error err;
    make_shape(&mesh, "tetrahedron", 0, 0);
    make_views(&mesh, view);
    const hs_settings s = adaptive(1, 2, true);
    if (!hs_packet_encode(&good, 7, &mesh, view[1].matrix, &s, &err)) give_up("hostile", &err);
    hs_mesh_free(&mesh);
    for (uint32_t w = 0, k = 0; w < good.words; w += w < 12 ? 1 : 3, k++)
        for (uint32_t twice = 0; twice < (w < 12 ? 3 : 1); twice++) {
            char text[80];
            const uint32_t value = values[(k * 5 + w / 4 + 4 * twice) % 9];
            snprintf(text, sizeof text, "word %u set to 0x%x", w, value);
            vector *v = add_vector(all, text, limits, no_stalls);
            copy_packet(&v->in, &good);
            v->in.word[w] = value;
            if (w / 4 + 1 < good.words / 4) mend_crc(&v->in);
        }
    for (uint32_t records = 0; records < good.words / 4 + 6; records += 3) {
        char text[80];
        snprintf(text, sizeof text, "%u records of %zu", records, good.words / 4);
        vector *v = add_vector(all, text, limits, no_stalls);
        copy_packet(&v->in, &good);
        while (v->in.words < 4 * (size_t)records)
            if (!hs_packet_append(&v->in, good.word, 1, &err)) give_up(text, &err);
        v->in.words = 4 * (size_t)records;
    }
    hs_packet_free(&good);
}

/* Components about powers of two, subnormal ones among them. */
static void add_exponents(vectors *all, hs_limits limits) {
    static const int exponents[] = {-149, -147, -126, -30, 0, 1, 126, 127};
    for (uint32_t i = 0; i < sizeof exponents / sizeof *exponents; i++) {
        hs_mesh mesh;
        char text[80];
        const float scale = (float)ldexp(1, exponents[i]);
        make_shape(&mesh, "tetrahedron", 0, 0);
        for (uint32_t k = 0; k < 4 * mesh.vertices; k++) {
            float *c = &mesh.position[k];
            if (k % 4 == 3)
                *c = k % 8 == 3 ? -0.0f : fminf(scale, 1);
            else
                *c = k % 3 == 1   ? nextafterf(*c * scale, 0)
                     : k % 3 == 2 ? *c * scale * 0.3f
                                  : *c * scale;
        }
        const hs_settings s = i % 2 ? adaptive(1, 2, true) : uniform(2);
        snprintf(text, sizeof text, "components about 2^%d", exponents[i]);
        add_view(all, text, limits, &mesh, identity, &s, no_stalls);
        hs_mesh_free(&mesh);
    }
}

/* Two faces of 255 sides: the folds of generation 0 fill up. */
static void add_wide(vectors *all, hs_limits limits) {
    static const hs_settings settings[] = {
        {.front_depth = 1, .silhouette_depth = 2, .guard = true},
        {.uniform = true, .uniform_depth = 0},
        {.front_depth = 2, .silhouette_depth = 1, .limit = true, .boundary = HS_BOUNDARY_SMOOTH}};
    static const hs_stalls stalls[] = {{0}, {21, 0, 80}, {22, 0, 40}};
    for (uint32_t i = 0; i < 3; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        make_pillow(&mesh, HS_MAX_SIDES - i);
        make_views(&mesh, view);
        add_view(all, "two wide faces", limits, &mesh, view[3 * i].matrix, &settings[i], stalls[i]);
        hs_mesh_free(&mesh);
        make_bicone(&mesh, 160 + i);
        add_view(all, "two high valences", limits, &mesh, view[3 * i + 1].matrix, &settings[i],
                 stalls[i]);
        hs_mesh_free(&mesh);
    }
}

vector *add_fan(vectors *all, hs_limits limits, uint32_t n, uint32_t first) {
    hs_mesh mesh;
    hs_packet base = {0};
    hs_error err;
    char text[80];
    make_shape(&mesh, "tetrahedron", 0, 0);
    const hs_settings s = uniform(1);
    if (!hs_packet_encode(&base, 9, &mesh, identity, &s, &err)) give_up("fan", &err);
    hs_mesh_free(&mesh);
    base.word[4] = n;
    base.word[5] = 3 * n;
    snprintf(text, sizeof text, "a fan of %u", n);
    vector *v = add_vector(all, text, limits, no_stalls);
    hs_packet *packet = &v->in;
    bool good = hs_packet_append(packet, base.word, VERTICES_AT / 4 + 4, &err);
    for (uint32_t h = 0; good && h < 3 * n; h++) {
        const uint32_t record[4] = {(first + h) % 3, HS_BORDER, 3 | h % 3 << 16, 0};
        good = hs_packet_append(packet, record, 1, &err);
    }
    if (!good || !hs_packet_append(packet, base.word + base.words - 4, 1, &err))
        give_up(text, &err);
    mend_crc(packet);
    hs_packet_free(&base);
    return v;
}

/* So many vertices, faces and corners that every bit of their numbers is needed. */
static void add_large(vectors *all, hs_limits limits) {
    static const struct {
        const char *shape;
        uint32_t size;
        hs_settings settings;
        hs_stalls stalls;
    } large[] = {
        {"grid",
         15,
         {.uniform = true, .uniform_depth = 1, .boundary = HS_BOUNDARY_SMOOTH},
         {9, 0, 30}},
        {"cube", 0, {.uniform = true, .uniform_depth = 6, .limit = true}, {0}},
        {"grid", 15, {.uniform = true, .uniform_depth = 1}, {12, 0, 95}}, /* split's fold fills */
        {"grid",
         4,
         {.front_depth = 4,
          .silhouette_depth = 5,
          .guard = true,
          .boundary = HS_BOUNDARY_EDGE_ONLY},
         {0}},
        {"random", 100, {.front_depth = 1, .silhouette_depth = 2, .guard = true}, {11, 20, 60}},
        {"random", 60, {.uniform = true, .uniform_depth = 2}, {0}},
        {"tetrahedron", 0, {.uniform = true, .uniform_depth = 6}, {0}},
        {"icosahedron", 0, {.uniform = true, .uniform_depth = 5, .limit = true}, {0}},
    };
    for (uint32_t i = 0; i < sizeof large / sizeof *large; i++) {
        hs_mesh mesh;
        hs_view view[VIEWS];
        char text[80];
        uint32_t tags = 99 + i;
        make_shape(&mesh, large[i].shape, large[i].size, 5);
        if (i != 1 && i < 6) tag_at_random(&mesh, &tags, 4, 9);
        make_views(&mesh, view);
        snprintf(text, sizeof text, "large %u, %s", i, large[i].shape);
        add_view(all, text, limits, &mesh, view[i].matrix, &large[i].settings, large[i].stalls);
        hs_mesh_free(&mesh);
    }
    add_wide(all, limits);
    add_fan(all, limits, 255, 0);
    add_fan(all, limits, 258, 0);
    add_fan(all, limits, 258, 1);
}

/* Numbers of all sizes in matrix and vertices: sums of terms that lie any number of places apart.
 */
static void add_places(vectors *all, hs_limits limits) {
    uint64_t random = 17;
    for (uint32_t i = 0; i < 4; i++) {
        hs_mesh mesh;
        float matrix[16];
        make_shape(&mesh, "random", 30, i);
        for (uint32_t k = 0; k < 4 * mesh.vertices; k++)
            mesh.position[k] = ldexpf(mesh.position[k], -(int)random_below(&random, 28));
        for (uint32_t k = 0; k < 16; k++) {
            const float number = 1 + (float)random_below(&random, 1 << 23) / (1 << 23);
            matrix[k] = ldexpf(k % 3 ? number : -number, -(int)random_below(&random, 28));
        }
        const hs_settings s = i % 2 ? adaptive(1, 1, true) : uniform(1);
        add_view(all, "numbers of all sizes", limits, &mesh, matrix, &s, no_stalls);
        hs_mesh_free(&mesh);
    }
}

/* Triangles two of whose sides are one edge, around vertex 0. To a forced depth: of each, one quad
 * in each of many generations; or, if that is 0, ever more of them, as their boundary is refined
 * too. */
static void add_glued(vectors *all, hs_limits limits, uint32_t triangles, uint32_t forced,
                      uint32_t sharpness) {
    hs_mesh mesh;
    hs_packet base = {0};
    hs_error err;
    make_shape(&mesh, "tetrahedron", 0, 0);
    hs_settings s = forced ? adaptive(0, HS_MAX_DEPTH, false) : uniform(32);
    s.boundary = forced ? HS_BOUNDARY_KEPT : HS_BOUNDARY_SMOOTH;
    char text[80];
    const uint32_t sides = 3 | forced << 8;
    if (!hs_packet_encode(&base, 9, &mesh, identity, &s, &err)) give_up("glued", &err);
    base.word[4] = triangles;
    base.word[5] = 3 * triangles;
    snprintf(text, sizeof text, "%u triangles glued to themselves, %u deep, sharpness %u",
             triangles, forced, sharpness);
    hs_packet *packet = &add_vector(all, text, limits, no_stalls)->in;
    bool good = hs_packet_append(packet, base.word, VERTICES_AT / 4 + 4, &err);
    for (uint32_t t = 0; good && t < triangles; t++) {
        const uint32_t v = 1 + t, h = 3 * t;
        const uint32_t corner[12] = {0, h + 2,     sides,           sharpness, /* 0 to v */
                                     v, HS_BORDER, sides | 1 << 16, 0,         /* v to v */
                                     v, h,         sides | 2 << 16, sharpness /* v to 0 */};
        good = hs_packet_append(packet, corner, 3, &err);
    }
    if (!good || !hs_packet_append(packet, base.word + base.words - 4, 1, &err))
        give_up("glued", &err);
    mend_crc(packet);
    hs_packet_free(&base);
    hs_mesh_free(&mesh);
}

vectors make_vectors(hs_limits capacity, const hs_model_config *config, uint32_t random) {
    enum { EARLY = 60 };
    vectors all = {.config = *config};
    chance chance = {.random = 5, .tags = 123456789};
    add_first(&all, capacity);
    add_trace(&all, "refused-packets", capacity);
    add_trace(&all, "cube-4-8", capacity);
    add_trace(&all, "grid-boundary", capacity);
    add_random(&all, capacity, &chance, random < EARLY ? random : EARLY);
    add_exponents(&all, capacity);
    add_hostile(&all, capacity);
    add_large(&all, capacity);
    add_places(&all, capacity);
    add_glued(&all, capacity, 1, 0, HS_SHARP_INFINITE);
    add_glued(&all, capacity, 1, 34, HS_SHARP_INFINITE);
    add_glued(&all, capacity, 1, 85, HS_MAX_SHARPNESS);
    add_glued(&all, capacity, 2, 0, HS_MAX_SHARPNESS);
    add_glued(&all, capacity, 2, 85, HS_SHARP_INFINITE);
    add_glued(&all, capacity, 3, 42, HS_MAX_SHARPNESS);
    add_aimed(&all, capacity);
    add_trace(&all, "torus-around-the-eye", capacity);
    add_trace(&all, "capacity-stop", (hs_limits){300, 239});
    add_random(&all, capacity, &chance, random);
    engines e = {0};
    hs_error err = {0};
    for (uint32_t i = 0; i < all.count; i++)
        if (!run_engines(&e, config, &all.item[i], &err)) give_up(all.item[i].name, &err);
    return all;
}
