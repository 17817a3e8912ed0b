/* SPDX-License-Identifier: Apache-2.0
 *
 * From clip space to a scene, in this order:
 *
 *   1. the renderer's surface of the output: object space, if the matrix has an inverse;
 *   2. vertices into the space, faces that have no place there left out;
 *   3. normals of corners, carried along as planes are: (n, -n p) times the inverse matrix;
 *   4. points: corners of a vertex with the same normal share one;
 *   5. triangles.
 */
#include "convert_scene.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render_parts.h"

static const char *const SPACE_NAME[] = {"object", "ndc", "clip", NULL};
static const uint32_t NONE = UINT32_MAX;

const char *hs_space_name(hs_space space) {
    return SPACE_NAME[space];
}

bool hs_space_parse(const char *text, hs_space *space) {
    for (unsigned s = 0; SPACE_NAME[s]; s++)
        if (strcmp(text, SPACE_NAME[s]) == 0) {
            *space = (hs_space)s;
            return true;
        }
    return false;
}

/* A scene in the making. Corners are numbered as in the surface. */
typedef struct maker {
    hs_scene *scene;
    const hs_scene_options *options;
    hs_surface surface;
    double inverse[16];
    bool invertible;
    double cofactor[3][3]; /* of the matrix without w, in clip space */
    bool mirrored;         /* the space is left-handed */
    bool *kept;            /* per face */
    uint32_t *number;      /* per vertex: in the scene, or NONE */
    float *normal;         /* 3 per corner */
    uint32_t *point;       /* per corner */
    uint32_t *latest;      /* per vertex of the scene: its latest point, or NONE */
    uint32_t *before;      /* per point: the one before it at the same vertex */
} maker;

void hs_scene_free(hs_scene *scene) {
    free(scene->place);
    free(scene->vertex_generation);
    free(scene->vertex);
    free(scene->normal);
    free(scene->point_generation);
    free(scene->first);
    free(scene->corner);
    free(scene->generation);
    free(scene->triangle);
    free(scene->triangle_generation);
    *scene = (hs_scene){0};
}

static void free_maker(maker *m) {
    hs_surface_free(&m->surface);
    free(m->kept);
    free(m->number);
    free(m->normal);
    free(m->point);
    free(m->latest);
    free(m->before);
}

/* --- 1. The view -------------------------------------------------------------------------------
 */

/* Whether the space's x, y, z are a left-handed system, seen from object space. With a singular
 * matrix nobody can tell: then they are taken to be, as those of usual views. */
static void look_at_matrix(maker *m) {
    const double *row = m->surface.matrix;
    m->invertible = hs_matrix_invert(m->inverse, row);
    m->mirrored = false;
    if (m->scene->space == HS_SPACE_NDC) {
        double determinant = 0;
        for (int i = 0; i < 4; i++)
            determinant += m->surface.eye[i] * row[8 + i];
        m->mirrored = !(m->invertible && determinant > 0);
    }
    if (m->scene->space == HS_SPACE_CLIP) {
        for (int i = 0; i < 3; i++)
            hs_cross(m->cofactor[i], &row[4 * ((i + 1) % 3)], &row[4 * ((i + 2) % 3)]);
        const double determinant = hs_dot(m->cofactor[0], row);
        const double lengths = sqrt(hs_dot(row, row)) * sqrt(hs_dot(row + 4, row + 4)) *
                               sqrt(hs_dot(row + 8, row + 8));
        m->invertible = fabs(determinant) > 1e-12 * lengths;
        m->mirrored = !(m->invertible && determinant > 0);
    }
    static const double identity[16] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
    memcpy(m->scene->matrix, m->scene->space == HS_SPACE_OBJECT ? row : identity, sizeof identity);
}

/* --- 2. Vertices and faces ---------------------------------------------------------------------
 */

/* False: no place in this space, or none in binary32. */
static bool place_vertex(const maker *m, const double clip[4], float place[4]) {
    double p[4];
    memcpy(p, clip, sizeof p);
    if (m->scene->space == HS_SPACE_OBJECT) hs_matrix_apply(p, m->inverse, clip);
    if (m->scene->space == HS_SPACE_NDC && !(p[3] > 0)) return false;
    for (int i = 0; i < 3 && m->scene->space != HS_SPACE_CLIP; i++)
        p[i] /= p[3];
    if (m->scene->space != HS_SPACE_CLIP) p[3] = 1;
    for (int i = 0; i < 4; i++) {
        place[i] = (float)p[i];
        if (!isfinite(place[i])) return false;
    }
    return true;
}

static void clip_of(const maker *m, uint32_t v, double clip[4]) {
    for (uint32_t i = 0; i < 4; i++)
        clip[i] = (double)m->surface.clip[4 * (size_t)v + i];
}

/* Marks vertices that have a place (0; others NONE), then faces, then numbers what these use. */
static bool place_vertices(maker *m, hs_error *err) {
    const hs_surface *s = &m->surface;
    double clip[4];
    float place[4];
    for (uint32_t v = 0; v < s->vertices; v++) {
        clip_of(m, v, clip);
        m->number[v] = place_vertex(m, clip, place) ? 0 : NONE;
        if (m->number[v] == NONE && m->scene->space == HS_SPACE_OBJECT)
            return hs_fail(err, HS_EXIT_VIEWS,
                           "vertex %u of the output has no place in object space, or one beyond "
                           "binary32: the view's matrix is nearly singular; use --space clip or "
                           "another view",
                           v);
    }
    for (uint32_t f = 0; f < s->faces; f++) {
        m->kept[f] = true;
        for (uint32_t c = s->first[f]; c < s->first[f + 1]; c++)
            m->kept[f] = m->kept[f] && m->number[s->corner[c]] != NONE;
        m->scene->left_out += !m->kept[f];
    }
    if (m->scene->left_out == s->faces)
        return hs_fail(err, HS_EXIT_VIEWS,
                       "all %u faces are at or behind the eye, where device coordinates end; use "
                       "--space object or clip",
                       s->faces);
    for (uint32_t v = 0; v < s->vertices; v++)
        m->number[v] = NONE;
    for (uint32_t f = 0; f < s->faces; f++)
        for (uint32_t c = s->first[f]; m->kept[f] && c < s->first[f + 1]; c++)
            m->number[s->corner[c]] = 0;
    for (uint32_t v = 0; v < s->vertices; v++) {
        if (m->number[v] == NONE) continue;
        m->number[v] = m->scene->vertices++;
        clip_of(m, v, clip);
        place_vertex(m, clip, &m->scene->place[4 * (size_t)m->number[v]]);
    }
    return true;
}

/* --- 3. Normals --------------------------------------------------------------------------------
 */

static bool is_direction(double n[3]) {
    return isfinite(n[0]) && isfinite(n[1]) && isfinite(n[2]) && hs_normalize(n);
}

/* A plane that is touched from outside stays so: its covector goes through the inverse matrix. */
static void carry_normal(const maker *m, const double place[3], const double n[3], double out[3]) {
    if (m->scene->space == HS_SPACE_NDC) {
        const double plane[4] = {n[0], n[1], n[2], -hs_dot(n, place)};
        for (int j = 0; j < 3; j++)
            out[j] = plane[0] * m->inverse[j] + plane[1] * m->inverse[4 + j] +
                     plane[2] * m->inverse[8 + j] + plane[3] * m->inverse[12 + j];
        return;
    }
    for (int i = 0; i < 3; i++)
        out[i] = m->scene->space == HS_SPACE_CLIP
                     ? (m->mirrored ? -1 : 1) * hs_dot(m->cofactor[i], n)
                     : n[i];
}

/* Where there is no object space, or no way from it, the surface is taken as it lies in the space.
 */
static bool leave_object_space(maker *m) {
    hs_surface *s = &m->surface;
    free(s->object);
    s->object = calloc((size_t)s->vertices * 3 + 1, sizeof *s->object);
    for (uint32_t v = 0; v < s->vertices && s->object; v++)
        for (uint32_t i = 0; i < 3 && m->number[v] != NONE; i++)
            s->object[3 * (size_t)v + i] = (double)m->scene->place[4 * (size_t)m->number[v] + i];
    return s->object != NULL;
}

static bool find_normals(maker *m) {
    const hs_surface *s = &m->surface;
    const bool carried = s->object && m->invertible;
    if (!carried && !leave_object_space(m)) return false;
    if (!hs_corner_normals(s, m->normal)) return false;
    for (uint32_t f = 0; f < s->faces; f++) {
        double of_face[3];
        hs_face_normal(s, f, of_face);
        for (uint32_t c = s->first[f]; c < s->first[f + 1]; c++) {
            float *normal = &m->normal[3 * (size_t)c];
            double own[3] = {(double)normal[0], (double)normal[1], (double)normal[2]}, out[3];
            if (!is_direction(own)) memcpy(own, of_face, sizeof own);
            if (carried)
                carry_normal(m, &s->object[3 * (size_t)s->corner[c]], own, out);
            else
                for (int i = 0; i < 3; i++)
                    out[i] = m->mirrored ? -own[i] : own[i];
            if (!is_direction(out)) memcpy(out, (const double[3]){0, 0, 1}, sizeof out);
            for (int i = 0; i < 3; i++)
                normal[i] = (float)out[i] + 0.0F; /* no -0, so that equal ones have equal bits */
        }
    }
    return true;
}

/* --- 4. Points ---------------------------------------------------------------------------------
 */

static uint32_t add_point(maker *m, uint32_t vertex, const float normal[3], uint8_t generation) {
    hs_scene *scene = m->scene;
    uint32_t p = m->latest[vertex];
    for (; p != NONE; p = m->before[p])
        if (memcmp(&scene->normal[3 * (size_t)p], normal, 3 * sizeof *normal) == 0 &&
            (!m->options->depths_apart || scene->point_generation[p] == generation))
            break;
    if (p == NONE) {
        p = scene->points++;
        scene->vertex[p] = vertex;
        memcpy(&scene->normal[3 * (size_t)p], normal, 3 * sizeof *normal);
        scene->point_generation[p] = generation;
        m->before[p] = m->latest[vertex];
        m->latest[vertex] = p;
    }
    if (generation > scene->point_generation[p]) scene->point_generation[p] = generation;
    if (generation > scene->vertex_generation[vertex])
        scene->vertex_generation[vertex] = generation;
    return p;
}

static void make_faces(maker *m) {
    const hs_surface *s = &m->surface;
    hs_scene *scene = m->scene;
    for (uint32_t f = 0; f < s->faces; f++) {
        if (!m->kept[f]) continue;
        const uint32_t begin = s->first[f], sides = s->first[f + 1] - begin;
        uint32_t *corner = &scene->corner[scene->first[scene->faces]];
        for (uint32_t i = 0; i < sides; i++) {
            const size_t c = begin + i;
            m->point[c] =
                add_point(m, m->number[s->corner[c]], &m->normal[3 * c], s->generation[f]);
            corner[m->mirrored && i > 0 ? sides - i : i] = m->point[c];
        }
        scene->generation[scene->faces] = s->generation[f];
        scene->first[scene->faces + 1] = scene->first[scene->faces] + sides;
        scene->faces++;
    }
}

/* --- 5. Triangles ------------------------------------------------------------------------------
 */

/* The mean of an n-gon's corners, as a vertex with the mean of their normals. */
static uint32_t add_mean(maker *m, uint32_t face) {
    const hs_surface *s = &m->surface;
    const uint32_t begin = s->first[face], sides = s->first[face + 1] - begin;
    double mean[4] = {0}, normal[3] = {0};
    for (uint32_t c = begin; c < begin + sides; c++) {
        double clip[4];
        clip_of(m, s->corner[c], clip);
        for (uint32_t i = 0; i < 4; i++)
            mean[i] += clip[i] / sides;
        for (uint32_t i = 0; i < 3; i++)
            normal[i] += (double)m->normal[3 * (size_t)c + i];
    }
    if (!is_direction(normal)) memcpy(normal, (const double[3]){0, 0, 1}, sizeof normal);
    const uint32_t vertex = m->scene->vertices++;
    float *place = &m->scene->place[4 * (size_t)vertex];
    /* Between places lies a place, up to rounding; a corner's will do. */
    if (!place_vertex(m, mean, place))
        memcpy(place, &m->scene->place[4 * (size_t)m->number[s->corner[begin]]], 4 * sizeof *place);
    const float n[3] = {(float)normal[0], (float)normal[1], (float)normal[2]};
    return add_point(m, vertex, n, s->generation[face]);
}

static void cut_faces(maker *m) {
    const hs_surface *s = &m->surface;
    hs_scene *scene = m->scene;
    uint8_t cut[3 * HS_MAX_SIDES];
    for (uint32_t f = 0; f < s->faces; f++) {
        if (!m->kept[f]) continue;
        const uint32_t begin = s->first[f], sides = s->first[f + 1] - begin;
        const uint32_t triangles = hs_surface_triangles(s, f, cut);
        uint32_t mean = NONE;
        for (uint32_t t = 0; t < triangles; t++) {
            uint32_t *triangle = &scene->triangle[3 * (size_t)scene->triangles];
            scene->triangle_generation[scene->triangles++] = s->generation[f];
            for (uint32_t i = 0; i < 3; i++) {
                const uint32_t corner = cut[3 * t + i];
                if (corner == sides && mean == NONE) mean = add_mean(m, f);
                triangle[m->mirrored && i > 0 ? 3 - i : i] =
                    corner == sides ? mean : m->point[begin + corner];
            }
        }
    }
}

/* --- The scene ---------------------------------------------------------------------------------
 */

/* Room for all that may come; one element more than needed, as an array may be empty. */
static bool make_room(maker *m) {
    const hs_surface *s = &m->surface;
    hs_scene *scene = m->scene;
    const size_t corners = s->first[s->faces];
    size_t means = 0, triangles = 0;
    for (uint32_t f = 0; f < s->faces && m->options->cut; f++) {
        const uint32_t sides = s->first[f + 1] - s->first[f];
        means += sides > 4;
        triangles += sides > 4 ? sides : sides - 2;
    }
    const size_t vertices = s->vertices + means, points = corners + means;
    m->kept = malloc(s->faces + (size_t)1);
    m->number = malloc((s->vertices + (size_t)1) * sizeof *m->number);
    m->normal = malloc((3 * corners + 1) * sizeof *m->normal);
    m->point = malloc((corners + 1) * sizeof *m->point);
    m->latest = malloc((vertices + 1) * sizeof *m->latest);
    m->before = malloc((points + 1) * sizeof *m->before);
    scene->place = malloc((4 * vertices + 1) * sizeof *scene->place);
    scene->vertex_generation = calloc(vertices + 1, 1);
    scene->vertex = malloc((points + 1) * sizeof *scene->vertex);
    scene->normal = malloc((3 * points + 1) * sizeof *scene->normal);
    scene->point_generation = malloc(points + 1);
    scene->first = calloc(s->faces + (size_t)1, sizeof *scene->first);
    scene->corner = malloc((corners + 1) * sizeof *scene->corner);
    scene->generation = malloc(s->faces + (size_t)1);
    scene->triangle = malloc((3 * triangles + 1) * sizeof *scene->triangle);
    scene->triangle_generation = malloc(triangles + 1);
    for (size_t v = 0; v < vertices && m->latest; v++)
        m->latest[v] = NONE;
    return m->kept && m->number && m->normal && m->point && m->latest && m->before &&
           scene->place && scene->vertex_generation && scene->vertex && scene->normal &&
           scene->point_generation && scene->first && scene->corner && scene->generation &&
           scene->triangle && scene->triangle_generation;
}

static bool no_memory(const maker *m, hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory to convert %u faces", m->surface.faces);
}

static bool make(maker *m, hs_error *err) {
    if (!make_room(m)) return no_memory(m, err);
    look_at_matrix(m);
    if (m->scene->space == HS_SPACE_OBJECT && !m->invertible)
        return hs_fail(err, HS_EXIT_VIEWS,
                       "the view's matrix is singular, so nothing leads back to object space; use "
                       "--space ndc or clip, or another view");
    m->scene->deepest = hs_surface_deepest(&m->surface);
    if (!place_vertices(m, err)) return false;
    if (!find_normals(m)) return no_memory(m, err);
    make_faces(m);
    if (m->options->cut) cut_faces(m);
    return true;
}

bool hs_scene_make(hs_scene *scene, const hs_output *output, const float matrix[16],
                   const hs_scene_options *options, hs_error *err) {
    *scene = (hs_scene){.space = options->space};
    maker m = {.scene = scene, .options = options};
    const bool done = hs_surface_of_output(&m.surface, output, matrix, err) && make(&m, err);
    free_maker(&m);
    if (!done) hs_scene_free(scene);
    return done;
}
