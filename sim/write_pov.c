/* SPDX-License-Identifier: Apache-2.0
 *
 * POV-Ray. Its camera sends rays location + t (direction + x/2 right + y/2 up) through the points
 * (x, y) of the picture, -1 to 1, and the three vectors may be any. What the view's matrix M shows
 * at (x, y) is where the inverse leads from (x, y, z, 1), whatever z. With a, b, c that inverse's
 * fourth, first and second column, and E = e.xyz / e.w the eye, that is the ray from E along
 *
 *     A + x B + y C,   A = a.xyz - a.w E,  likewise B and C,
 *
 * towards points with w > 0: direction A, right 2B, up 2C. So every view that has an eye has such a
 * camera: shifted, sheared and mirrored ones as well. In parallel views all rays run like the third
 * column.
 */
#include <math.h>

#include "convert_write.h"
#include "options.h"
#include "render_parts.h"

typedef struct camera {
    bool parallel;
    double location[3], direction[3], right[3], up[3];
} camera;

typedef struct box {
    double middle[3], size; /* its longest side; 1 if it has none */
} box;

static box box_of(const hs_scene *scene) {
    box b = {.size = 0};
    for (uint32_t i = 0; i < 3; i++) {
        double low = INFINITY, high = -INFINITY;
        for (uint32_t v = 0; v < scene->vertices; v++) {
            low = fmin(low, (double)scene->place[4 * (size_t)v + i]);
            high = fmax(high, (double)scene->place[4 * (size_t)v + i]);
        }
        b.middle[i] = (low + high) / 2;
        b.size = fmax(b.size, high - low);
    }
    if (!(b.size > 0)) b.size = 1;
    return b;
}

/* --- The camera --------------------------------------------------------------------------------
 */

static double length3(const double v[3]) {
    return sqrt(hs_dot(v, v));
}

/* Column j of the inverse as seen from the eye. */
static void column(double result[3], const double inverse[16], int j, const double eye[3]) {
    for (int i = 0; i < 3; i++)
        result[i] = inverse[4 * i + j] - inverse[12 + j] * eye[i];
}

static bool find_camera(camera *c, const double m[16], hs_error *err) {
    static const double nowhere[3] = {0, 0, 0};
    double inverse[16], eye[4];
    *c = (camera){.parallel = hs_dot(&m[12], &m[12]) == 0};
    if (!hs_matrix_invert(inverse, m))
        return hs_fail(err, HS_EXIT_VIEWS,
                       "the view's matrix is singular: no camera sees that; use --space ndc");
    hs_eye_of_matrix(eye, m);
    const double size = length3(&m[0]) * length3(&m[4]) * length3(&m[12]);
    if (!c->parallel && !(fabs(eye[3]) > 1e-12 * size))
        return hs_fail(err, HS_EXIT_VIEWS,
                       "the view's eye is at infinity, but its rays are not parallel: no camera of "
                       "POV-Ray does that; use --space ndc");
    for (int i = 0; i < 3 && !c->parallel; i++)
        c->location[i] = eye[i] / eye[3];
    const double *from = c->parallel ? nowhere : c->location;
    column(c->direction, inverse, c->parallel ? 2 : 3, from);
    column(c->right, inverse, 0, from);
    column(c->up, inverse, 1, from);
    double scale = 1 / length3(c->direction);
    for (int i = 0; i < 3; i++) {
        /* w is the same everywhere in a parallel view: so are all denominators. */
        const double w = inverse[15];
        if (c->parallel) c->location[i] = (inverse[4 * i + 3] - inverse[4 * i + 2]) / w;
        const double across = 2 * (c->parallel ? 1 / w : scale);
        c->direction[i] *= c->parallel && w < 0 ? -scale : scale;
        c->right[i] *= across;
        c->up[i] *= across;
    }
    return true;
}

static void write_vector(FILE *stream, const char *name, const double v[3]) {
    fprintf(stream, "  %s <%.12g, %.12g, %.12g>\n", name, v[0], v[1], v[2]);
}

static void write_camera(FILE *stream, const camera *c) {
    fprintf(stream, "camera {\n  %s\n", c->parallel ? "orthographic" : "perspective");
    write_vector(stream, "location", c->location);
    write_vector(stream, "direction", c->direction);
    write_vector(stream, "right", c->right);
    write_vector(stream, "up", c->up);
    fputs("  scale Scale\n}\n\n", stream);
}

/* --- The light ---------------------------------------------------------------------------------
 */

/* From the camera's left shoulder, from the camera, and a little from the sky, as the renderer's;
 * the first one alone casts shadows. */
static void write_light(FILE *stream, const hs_scene *scene, const box *b, const camera *c) {
    double ahead[3];
    for (int i = 0; i < 3; i++)
        ahead[i] = c->parallel ? -c->direction[i] : -scene->matrix[12 + i];
    hs_normalize(ahead);
    hs_light light;
    hs_light_from(&light, scene->matrix, ahead);
    const double *from[3] = {light.key, light.ahead, light.up};
    static const double strength[3] = {1.0, 0.2, 0.14};
    for (int k = 0; k < 3; k++) {
        double location[3];
        for (int i = 0; i < 3; i++)
            location[i] = b->middle[i] + 20 * b->size * from[k][i];
        fputs("light_source {\n", stream);
        fprintf(stream, "  <%.12g, %.12g, %.12g>, rgb %g parallel%s\n", location[0], location[1],
                location[2], strength[k], k > 0 ? " shadowless" : "");
        write_vector(stream, "point_at", b->middle);
        fputs("  scale Scale\n}\n\n", stream);
    }
}

/* --- The mesh ----------------------------------------------------------------------------------
 */

static void write_triples(FILE *stream, const char *name, const hs_scene *scene, bool normals) {
    fprintf(stream, "  %s {\n    %u", name, scene->points);
    for (uint32_t p = 0; p < scene->points; p++) {
        const float *t =
            normals ? &scene->normal[3 * (size_t)p] : &scene->place[4 * (size_t)scene->vertex[p]];
        fprintf(stream, ",\n    <%.9g, %.9g, %.9g>", (double)t[0], (double)t[1], (double)t[2]);
    }
    fputs("\n  }\n", stream);
}

/* Where the view cuts the surface off, at its nearest and farthest planes: points inside have
 * row_w +- row_z >= 0. */
static void write_clipping(FILE *stream, const hs_scene *scene) {
    for (int sign = -1; sign <= 1; sign += 2) {
        double plane[4];
        bool cuts = false;
        for (int i = 0; i < 4; i++)
            plane[i] = scene->matrix[12 + i] - sign * scene->matrix[8 + i];
        for (uint32_t v = 0; v < scene->vertices && !cuts; v++) {
            double distance = plane[3];
            for (uint32_t i = 0; i < 3; i++)
                distance += plane[i] * (double)scene->place[4 * (size_t)v + i];
            cuts = distance < 0;
        }
        const double length = length3(plane);
        if (!cuts || !(length > 0)) continue;
        fprintf(stream, "  clipped_by { plane { <%.12g, %.12g, %.12g>, %.12g } }\n",
                -plane[0] / length, -plane[1] / length, -plane[2] / length, plane[3] / length);
    }
}

static void write_mesh(FILE *stream, const hs_scene *scene) {
    fputs("mesh2 {\n", stream);
    write_triples(stream, "vertex_vectors", scene, false);
    write_triples(stream, "normal_vectors", scene, true);
    fprintf(stream, "  texture_list {\n    %u", scene->deepest + 1u);
    for (unsigned g = 0; g <= scene->deepest; g++) {
        uint8_t rgb[3];
        hs_scene_color(scene, (uint8_t)g, rgb);
        fprintf(stream, ",\n    texture { Paint(%.4f, %.4f, %.4f) }", rgb[0] / 255.0,
                rgb[1] / 255.0, rgb[2] / 255.0);
    }
    fprintf(stream, "\n  }\n  face_indices {\n    %u", scene->triangles);
    for (uint32_t t = 0; t < scene->triangles; t++) {
        const uint32_t *corner = &scene->triangle[3 * (size_t)t];
        fprintf(stream, ",\n    <%u,%u,%u>,%u", corner[0], corner[1], corner[2],
                scene->triangle_generation[t]);
    }
    fputs("\n  }\n", stream);
    write_clipping(stream, scene);
    fputs("  scale Scale\n}\n", stream);
}

/* --- The scene ---------------------------------------------------------------------------------
 */

/* POV-Ray's tolerances are meant for scenes of some units' size. */
static void write_head(FILE *stream, const hs_scene *scene, const box *b, uint32_t width,
                       uint32_t height) {
    fprintf(stream,
            "// halfstep " HS_VERSION ": %u faces, depths 0 to %u, %s space\n"
            "//   povray +W%u +H%u +A0.1 THIS_FILE\n"
            "// On the command line, Declare=DEPTH=1 colours faces by depth of refinement, and\n"
            "// Declare=CLEAR=1 with +UA leaves the background transparent.\n"
            "#version 3.7;\n"
            "#ifndef (DEPTH) #declare DEPTH = 0; #end\n"
            "#ifndef (CLEAR) #declare CLEAR = 0; #end\n"
            "global_settings { assumed_gamma 1 }\n"
            "background { color srgb <0.955, 0.961, 0.965> transmit CLEAR }\n"
            "#declare Scale = %g;\n\n",
            scene->faces, scene->deepest, hs_space_name(scene->space), width, height,
            pow(10, -floor(log10(b->size))));
    fprintf(stream,
            "#macro Paint(R, G, B)\n"
            "  #if (DEPTH)\n"
            "    pigment { color srgb <R, G, B> }\n"
            "    finish { ambient 0.25 diffuse 0.75 }\n"
            "  #else\n"
            "    pigment { color srgb <%.4f, %.4f, %.4f> }\n"
            "    finish { ambient 0.03 diffuse 0.9 specular 0.22 roughness 0.03 }\n"
            "  #end\n"
            "#end\n\n",
            (HS_CLAY_COLOR >> 16) / 255.0, (HS_CLAY_COLOR >> 8 & 255) / 255.0,
            (HS_CLAY_COLOR & 255) / 255.0);
}

bool hs_write_pov(const char *path, const hs_scene *scene, uint32_t width, uint32_t height,
                  hs_error *err) {
    camera c;
    hs_text_file text;
    if (scene->space == HS_SPACE_CLIP)
        return hs_fail(err, HS_EXIT_USAGE,
                       "POV-Ray knows no w, so clip space means nothing to it; use --space object "
                       "or ndc");
    if (!find_camera(&c, scene->matrix, err) || !hs_text_begin(&text, path, err)) return false;
    const box b = box_of(scene);
    write_head(text.file.stream, scene, &b, width, height);
    write_camera(text.file.stream, &c);
    write_light(text.file.stream, scene, &b, &c);
    write_mesh(text.file.stream, scene);
    return hs_text_end(&text, err);
}
