/* SPDX-License-Identifier: Apache-2.0
 *
 * Drawing, in the order in which a picture comes about:
 *
 *   1. background, a gentle gradient with coverage (alpha) 0;
 *   2. faces, cut into triangles, coverage 1, pushed back a little (polygon offset);
 *   3. wires, blended over them; they leave the coverage alone, so silhouettes are the surface's;
 *   4. the mean of samples x samples samples for every pixel;
 *   5. legend.
 */
#define GL_GLEXT_PROTOTYPES
#include "render.h"

#include <GL/osmesa.h>

#include <GL/glext.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render_parts.h"

/* --- Shaders ---------------------------------------------------------------------------------- */

/* Positions are clip coordinates already. */
static const char vertex_shader[] = "#version 120\n"
                                    "attribute vec4 clip;\n"
                                    "attribute vec3 normal;\n"
                                    "attribute vec3 to_eye;\n"
                                    "attribute vec4 paint;\n"
                                    "varying vec3 n;\n"
                                    "varying vec3 v;\n"
                                    "varying vec4 c;\n"
                                    "void main() {\n"
                                    "    gl_Position = clip;\n"
                                    "    n = normal;\n"
                                    "    v = to_eye;\n"
                                    "    c = paint;\n"
                                    "}\n";

/* Light comes from the camera, a second one from above its left shoulder, a little from the sky.
 * weight: ambient, sky, camera, key. A normal that looks away from the eye belongs to the other
 * side of the surface, or, where normals are averaged, to the silhouette, where it is bent back. */
static const char fragment_shader[] =
    "#version 120\n"
    "uniform bool lit;\n"
    "uniform bool two_sided;\n"
    "uniform vec3 inside;\n"
    "uniform vec3 key;\n"
    "uniform vec3 up;\n"
    "uniform vec4 weight;\n"
    "uniform float gloss;\n"
    "varying vec3 n;\n"
    "varying vec3 v;\n"
    "varying vec4 c;\n"
    "void main() {\n"
    "    vec4 color = c;\n"
    "    if (lit) {\n"
    "        vec3 eye = normalize(v);\n"
    "        vec3 m = normalize(n);\n"
    "        if (!gl_FrontFacing) {\n"
    "            m = -m;\n"
    "            if (two_sided) color.rgb = mix(inside, inside * c.rgb, 0.35);\n"
    "        }\n"
    "        float ahead = dot(m, eye);\n"
    "        if (ahead < 0.0) { m = normalize(m - ahead * eye); ahead = 0.0; }\n"
    "        float shade = weight.x + weight.y * (0.5 + 0.5 * dot(m, up)) + weight.z * ahead\n"
    "                    + weight.w * max(dot(m, key), 0.0);\n"
    "        float shine = pow(max(dot(m, normalize(eye + key)), 0.0), 40.0);\n"
    "        color.rgb = color.rgb * shade + vec3(gloss * shine);\n"
    "    }\n"
    "    gl_FragColor = color;\n"
    "}\n";

enum { ATTRIBUTE_CLIP, ATTRIBUTE_NORMAL, ATTRIBUTE_TO_EYE, ATTRIBUTE_PAINT };

/* What a vertex brings along. */
typedef struct hs_point {
    float clip[4], normal[3], to_eye[3];
    uint8_t paint[4];
} hs_point;

/* Points go to OpenGL in batches of this many, a multiple of 6: whole triangles and lines. */
#define BATCH 49152

struct hs_renderer {
    uint32_t width, height, samples;
    OSMesaContext context;
    uint8_t *frame; /* RGBA of all samples, from top to bottom */
    GLuint program;
    hs_point *point;
    uint32_t points;
    GLenum shape; /* of the batch */
};

/* --- Context ---------------------------------------------------------------------------------- */

static bool make_current(hs_renderer *r) {
    GLsizei width = (GLsizei)(r->width * r->samples), height = (GLsizei)(r->height * r->samples);
    if (!OSMesaMakeCurrent(r->context, r->frame, GL_UNSIGNED_BYTE, width, height)) return false;
    OSMesaPixelStore(OSMESA_Y_UP, 0);
    glViewport(0, 0, width, height);
    return true;
}

static bool add_shader(GLuint program, GLenum kind, const char *source) {
    GLuint shader = glCreateShader(kind);
    GLint compiled = 0;
    glShaderSource(shader, 1, &source, NULL);
    glCompileShader(shader);
    glGetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
    glAttachShader(program, shader);
    glDeleteShader(shader);
    return compiled;
}

static bool make_program(hs_renderer *r) {
    GLint linked = 0;
    r->program = glCreateProgram();
    if (!add_shader(r->program, GL_VERTEX_SHADER, vertex_shader)) return false;
    if (!add_shader(r->program, GL_FRAGMENT_SHADER, fragment_shader)) return false;
    glBindAttribLocation(r->program, ATTRIBUTE_CLIP, "clip");
    glBindAttribLocation(r->program, ATTRIBUTE_NORMAL, "normal");
    glBindAttribLocation(r->program, ATTRIBUTE_TO_EYE, "to_eye");
    glBindAttribLocation(r->program, ATTRIBUTE_PAINT, "paint");
    glLinkProgram(r->program);
    glGetProgramiv(r->program, GL_LINK_STATUS, &linked);
    return linked;
}

hs_renderer *hs_renderer_new(uint32_t width, uint32_t height, uint32_t samples, hs_error *err) {
    const uint32_t limit = 16384;
    if (samples < 1 || samples > 4 || width < 1 || height < 1 || width > limit / samples ||
        height > limit / samples) {
        hs_fail(err, HS_EXIT_USAGE,
                "pictures of %ux%u pixels with %ux%u samples cannot be drawn; ask for 1 to 4 "
                "samples and at most %u pixels times samples a side",
                width, height, samples, samples, limit);
        return NULL;
    }
    hs_renderer *r = calloc(1, sizeof *r);
    bool done = r != NULL;
    if (done) {
        static const int attributes[] = {OSMESA_FORMAT,
                                         OSMESA_RGBA,
                                         OSMESA_DEPTH_BITS,
                                         32,
                                         OSMESA_PROFILE,
                                         OSMESA_COMPAT_PROFILE,
                                         0,
                                         0};
        *r = (hs_renderer){.width = width, .height = height, .samples = samples};
        r->frame = malloc((size_t)width * height * samples * samples * 4);
        r->point = malloc(BATCH * sizeof *r->point);
        r->context = OSMesaCreateContextAttribs(attributes, NULL);
        done = r->frame && r->point && r->context && make_current(r) && make_program(r);
    }
    if (done) return r;
    hs_renderer_free(r);
    hs_fail(err, HS_EXIT_INTERNAL, "OSMesa gives no context of %ux%u samples; is there memory?",
            width * samples, height * samples);
    return NULL;
}

void hs_renderer_free(hs_renderer *renderer) {
    if (!renderer) return;
    if (renderer->context) {
        if (make_current(renderer)) glDeleteProgram(renderer->program);
        OSMesaMakeCurrent(NULL, NULL, 0, 0, 0);
        OSMesaDestroyContext(renderer->context);
    }
    free(renderer->frame);
    free(renderer->point);
    free(renderer);
}

double hs_renderer_aspect(const hs_renderer *renderer) {
    return (double)renderer->width / renderer->height;
}

/* --- Batches ---------------------------------------------------------------------------------- */

static void flush(hs_renderer *r) {
    if (r->points) glDrawArrays(r->shape, 0, (GLsizei)r->points);
    r->points = 0;
}

static void begin(hs_renderer *r, GLenum shape) {
    const GLsizei stride = sizeof(hs_point);
    r->shape = shape;
    r->points = 0;
    glUseProgram(r->program);
    for (GLuint i = ATTRIBUTE_CLIP; i <= ATTRIBUTE_PAINT; i++)
        glEnableVertexAttribArray(i);
    glVertexAttribPointer(ATTRIBUTE_CLIP, 4, GL_FLOAT, GL_FALSE, stride, r->point->clip);
    glVertexAttribPointer(ATTRIBUTE_NORMAL, 3, GL_FLOAT, GL_FALSE, stride, r->point->normal);
    glVertexAttribPointer(ATTRIBUTE_TO_EYE, 3, GL_FLOAT, GL_FALSE, stride, r->point->to_eye);
    glVertexAttribPointer(ATTRIBUTE_PAINT, 4, GL_UNSIGNED_BYTE, GL_TRUE, stride, r->point->paint);
}

static void add(hs_renderer *r, const hs_point *point) {
    if (r->points == BATCH) flush(r);
    r->point[r->points++] = *point;
}

static void set_paint(hs_point *point, uint32_t color, double opacity) {
    for (int c = 0; c < 3; c++)
        point->paint[c] = (uint8_t)(color >> (16 - 8 * c));
    point->paint[3] = (uint8_t)lround(255 * opacity);
}

/* --- Faces ------------------------------------------------------------------------------------ */

static void set_vector(hs_renderer *r, const char *name, const double v[3]) {
    glUniform3f(glGetUniformLocation(r->program, name), (GLfloat)v[0], (GLfloat)v[1],
                (GLfloat)v[2]);
}

static void set_light(hs_renderer *r, const hs_surface *surface, const hs_style *style) {
    hs_light light;
    hs_light_of_view(&light, surface->matrix, surface->eye);
    set_vector(r, "key", light.key);
    set_vector(r, "up", light.up);

    static const double inside[3] = HS_INSIDE_COLOR;
    set_vector(r, "inside", inside);
    bool clay = style->paint == HS_PAINT_CLAY;
    glUniform1i(glGetUniformLocation(r->program, "lit"), surface->object != NULL);
    glUniform1i(glGetUniformLocation(r->program, "two_sided"), style->paint != HS_PAINT_FACING);
    glUniform1f(glGetUniformLocation(r->program, "gloss"), clay ? 0.10f : 0.0f);
    /* Where colour means something, light may change it less. */
    if (clay)
        glUniform4f(glGetUniformLocation(r->program, "weight"), 0.18f, 0.20f, 0.28f, 0.46f);
    else
        glUniform4f(glGetUniformLocation(r->program, "weight"), 0.50f, 0.10f, 0.26f, 0.24f);
}

static uint32_t face_color(const hs_surface *surface, const hs_style *style, uint32_t face,
                           uint32_t deepest) {
    if (style->paint == HS_PAINT_DEPTH) return hs_depth_color(surface->generation[face], deepest);
    if (style->paint == HS_PAINT_FACING) return hs_facing_color(surface->facing[face]);
    return HS_CLAY_COLOR;
}

/* The clip position of a point, seen through the window. */
static void see(hs_point *point, const double clip[4], const hs_window *window) {
    double scale = window->scale > 0 ? window->scale : 1;
    double x = window->scale > 0 ? window->x : 0, y = window->scale > 0 ? window->y : 0;
    point->clip[0] = (float)(scale * (clip[0] - x * clip[3]));
    point->clip[1] = (float)(scale * (clip[1] - y * clip[3]));
    point->clip[2] = (float)clip[2];
    point->clip[3] = (float)clip[3];
}

/* The points of a face's corners and, behind them, of their mean. */
static void face_points(const hs_surface *surface, uint32_t face, const hs_window *window,
                        const float *corner_normal, hs_point *point) {
    uint32_t begin = surface->first[face], sides = surface->first[face + 1] - begin;
    double clip[4], mean_clip[4] = {0}, place[3], mean_place[3] = {0}, normal[3] = {0};
    if (surface->object) hs_face_normal(surface, face, normal);
    /* Directions may be of any length; eye.w brings them near that of the object. */
    double unit = fmax(fmax(fabs(surface->eye[0]), fabs(surface->eye[1])),
                       fmax(fabs(surface->eye[2]), fabs(surface->eye[3])));
    for (uint32_t i = 0; i <= sides; i++) {
        uint32_t v = i < sides ? surface->corner[begin + i] : 0;
        for (uint32_t k = 0; k < 4; k++) {
            clip[k] = i < sides ? (double)surface->clip[4 * (size_t)v + k] : mean_clip[k] / sides;
            mean_clip[k] += clip[k];
        }
        see(&point[i], clip, window);
        for (uint32_t k = 0; k < 3 && surface->object; k++) {
            place[k] = i < sides ? surface->object[3 * (size_t)v + k] : mean_place[k] / sides;
            mean_place[k] += place[k];
            point[i].to_eye[k] = (float)((surface->eye[k] - place[k] * surface->eye[3]) / unit);
            const bool smooth = corner_normal && i < sides;
            point[i].normal[k] =
                smooth ? corner_normal[3 * (size_t)(begin + i) + k] : (float)normal[k];
        }
    }
}

static void draw_faces(hs_renderer *r, const hs_surface *surface, const hs_window *window,
                       const float *corner_normal, const uint32_t *color) {
    hs_point corner[HS_MAX_SIDES + 1] = {0};
    uint8_t triangle[3 * HS_MAX_SIDES];
    begin(r, GL_TRIANGLES);
    for (uint32_t f = 0; f < surface->faces; f++) {
        face_points(surface, f, window, corner_normal, corner);
        uint32_t count = 3 * hs_surface_triangles(surface, f, triangle);
        for (uint32_t i = 0; i < count; i++) {
            set_paint(&corner[triangle[i]], color[f], 1);
            add(r, &corner[triangle[i]]);
        }
    }
    flush(r);
}

/* --- Wires ------------------------------------------------------------------------------------ */

/* Length on the screen in pixels; INFINITY where an end is not before the eye. */
static double screen_length(const hs_renderer *r, const hs_point *a, const hs_point *b) {
    double wa = (double)a->clip[3], wb = (double)b->clip[3];
    if (!(wa > 0) || !(wb > 0)) return INFINITY;
    double x = ((double)a->clip[0] / wa - (double)b->clip[0] / wb) * r->width / 2;
    double y = ((double)a->clip[1] / wa - (double)b->clip[1] / wb) * r->height / 2;
    return hypot(x, y);
}

/* Short edges are fainter, or a dense mesh would be black. */
static double wire_opacity(double pixels) {
    return fmin(0.85, fmax(0.08, 0.055 * pixels));
}

static bool draw_wires(hs_renderer *r, const hs_surface *surface, const hs_window *window,
                       double width, hs_error *err) {
    uint32_t edges;
    hs_edge *edge = hs_surface_edges(surface, &edges);
    if (!edge) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for wires");
    glEnable(GL_BLEND);
    glBlendFunc(GL_SRC_ALPHA, GL_ONE_MINUS_SRC_ALPHA);
    glEnable(GL_LINE_SMOOTH);
    glDepthMask(GL_FALSE);
    glDepthFunc(GL_LEQUAL);
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_FALSE);
    for (int bold = 0; bold < 2; bold++) {
        begin(r, GL_LINES);
        glUniform1i(glGetUniformLocation(r->program, "lit"), 0);
        glLineWidth((GLfloat)(width * r->samples * (bold ? 2.2 : 1)));
        for (uint32_t e = 0; e < edges; e++) {
            if (edge[e].border != bold) continue;
            hs_point end[2] = {0};
            for (int k = 0; k < 2; k++) {
                const float *c = &surface->clip[4 * (size_t)(k ? edge[e].to : edge[e].from)];
                const double clip[4] = {(double)c[0], (double)c[1], (double)c[2], (double)c[3]};
                see(&end[k], clip, window);
            }
            double opacity = bold ? 1 : wire_opacity(screen_length(r, &end[0], &end[1]));
            for (int k = 0; k < 2; k++) {
                set_paint(&end[k], bold ? 0x5a1f14 : 0x141a24, opacity);
                add(r, &end[k]);
            }
        }
        flush(r);
    }
    glColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    glDepthMask(GL_TRUE);
    glDisable(GL_LINE_SMOOTH);
    glDisable(GL_BLEND);
    free(edge);
    return true;
}

/* --- The picture ------------------------------------------------------------------------------ */

static void clear(hs_renderer *r) {
    (void)r;
    glDisable(GL_BLEND);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DITHER);
    glClearColor(0, 0, 0, 0);
    glClearDepth(1);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
}

static void draw_background(hs_renderer *r) {
    static const uint32_t low = 0xe9ecf0, high = 0xfcfcfb;
    static const float corner[6][2] = {{-1, -1}, {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}};
    begin(r, GL_TRIANGLES);
    glUniform1i(glGetUniformLocation(r->program, "lit"), 0);
    glDisable(GL_DEPTH_TEST);
    for (int i = 0; i < 6; i++) {
        hs_point point = {.clip = {corner[i][0], corner[i][1], 0, 1}};
        set_paint(&point, corner[i][1] < 0 ? low : high, 0);
        add(r, &point);
    }
    flush(r);
    glEnable(GL_DEPTH_TEST);
}

/* The mean of each pixel's samples. */
static void resolve(const hs_renderer *r, hs_picture *picture) {
    uint32_t s = r->samples, area = s * s;
    size_t stride = (size_t)r->width * s * 4;
    for (uint32_t y = 0; y < r->height; y++)
        for (uint32_t x = 0; x < r->width; x++) {
            uint32_t sum[4] = {area / 2, area / 2, area / 2, area / 2};
            for (uint32_t j = 0; j < s; j++) {
                const uint8_t *p = r->frame + (size_t)(y * s + j) * stride + (size_t)x * s * 4;
                for (uint32_t i = 0; i < 4 * s; i++)
                    sum[i % 4] += p[i];
            }
            size_t pixel = (size_t)y * r->width + x;
            for (uint32_t c = 0; c < 3; c++)
                picture->rgb[3 * pixel + c] = (uint8_t)(sum[c] / area);
            picture->coverage[pixel] = (uint8_t)(sum[3] / area);
        }
}

bool hs_renderer_draw(hs_renderer *renderer, const hs_surface *surface, const hs_style *style,
                      hs_picture *picture, hs_error *err) {
    hs_renderer *r = renderer;
    uint32_t least = r->width < r->height ? r->width : r->height;
    double width = style->wire_width > 0 ? style->wire_width : fmax(1.1 * least / 768.0, 0.7);
    uint32_t deepest = style->deepest ? style->deepest : hs_surface_deepest(surface);
    bool smooth = style->smooth && surface->object;

    *picture = (hs_picture){0};
    uint32_t *color = malloc((surface->faces + (size_t)1) * sizeof *color);
    const size_t corners = surface->faces ? surface->first[surface->faces] : 0;
    float *normal = smooth ? malloc((3 * corners + 1) * sizeof *normal) : NULL;
    bool done = color && (!smooth || (normal && hs_corner_normals(surface, normal)));
    if (!done) hs_fail(err, HS_EXIT_INTERNAL, "no memory to draw %u faces", surface->faces);
    if (done && !make_current(r)) done = hs_fail(err, HS_EXIT_INTERNAL, "OSMesa lost its context");
    if (done) {
        for (uint32_t f = 0; f < surface->faces; f++)
            color[f] = face_color(surface, style, f, deepest);
        clear(r);
        draw_background(r);
        set_light(r, surface, style);
        /* Only where wires need it: at silhouettes it lets the inside shine through. */
        if (style->wires) glEnable(GL_POLYGON_OFFSET_FILL);
        glPolygonOffset(1.25f, 4);
        draw_faces(r, surface, &style->window, normal, color);
        glDisable(GL_POLYGON_OFFSET_FILL);
        done = !style->wires || draw_wires(r, surface, &style->window, width, err);
        glFinish();
    }
    done = done && hs_picture_make(picture, r->width, r->height, 0, err);
    if (done) {
        resolve(r, picture);
        if (style->legend) hs_draw_legend(picture, style->paint, deepest);
    }
    free(color);
    free(normal);
    return done;
}

/* --- Where the silhouette is finest ----------------------------------------------------------- */

#define CELLS 96

/* Counts, per cell of the screen, the faces of the deepest visible generation, each where its
 * corners' mean is; returns how many. number holds the faces that the samples show. */
static uint32_t count_finest(const hs_surface *surface, const uint8_t *visible,
                             uint32_t cell[CELLS][CELLS]) {
    uint32_t deepest = 0, total = 0;
    for (uint32_t f = 0; f < surface->faces; f++)
        if (visible[f] && surface->generation[f] > deepest) deepest = surface->generation[f];
    memset(cell, 0, CELLS * sizeof cell[0]);
    for (uint32_t f = 0; f < surface->faces; f++) {
        if (!visible[f] || surface->generation[f] != deepest) continue;
        double mean[4] = {0};
        for (uint32_t i = surface->first[f]; i < surface->first[f + 1]; i++)
            for (uint32_t k = 0; k < 4; k++)
                mean[k] += (double)surface->clip[4 * (size_t)surface->corner[i] + k];
        double x = (mean[0] / mean[3] + 1) / 2 * CELLS, y = (mean[1] / mean[3] + 1) / 2 * CELLS;
        if (!(mean[3] > 0) || !(x >= 0 && x < CELLS && y >= 0 && y < CELLS)) continue;
        cell[(uint32_t)y][(uint32_t)x]++;
        total++;
    }
    return total;
}

/* The middle of gravity of the square of side cells that holds most, in device coordinates. */
static void find_densest(uint32_t cell[CELLS][CELLS], uint32_t side, hs_window *window) {
    uint32_t best = 0;
    for (uint32_t top = 0; top + side <= CELLS; top++)
        for (uint32_t left = 0; left + side <= CELLS; left++) {
            uint32_t sum = 0;
            double x = 0, y = 0;
            for (uint32_t j = top; j < top + side; j++)
                for (uint32_t i = left; i < left + side; i++) {
                    sum += cell[j][i];
                    x += cell[j][i] * (i + 0.5);
                    y += cell[j][i] * (j + 0.5);
                }
            if (sum <= best) continue;
            best = sum;
            window->x = x / sum / CELLS * 2 - 1;
            window->y = y / sum / CELLS * 2 - 1;
        }
}

bool hs_renderer_finest(hs_renderer *renderer, const hs_surface *surface, double scale,
                        hs_window *window, hs_error *err) {
    *window = (hs_window){0, 0, scale};
    uint32_t *number = malloc((surface->faces + (size_t)1) * sizeof *number);
    uint8_t *visible = calloc(surface->faces + (size_t)1, 1);
    if (!number || !visible || !make_current(renderer)) {
        free(number);
        free(visible);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory to look for the finest silhouette");
    }
    /* Every face is drawn in its number: the samples then name the faces that are seen. */
    for (uint32_t f = 0; f < surface->faces; f++)
        number[f] = f + 1;
    const hs_window whole = {0};
    clear(renderer);
    glEnable(GL_DEPTH_TEST);
    begin(renderer, GL_TRIANGLES);
    glUniform1i(glGetUniformLocation(renderer->program, "lit"), 0);
    draw_faces(renderer, surface, &whole, NULL, number);
    glFinish();
    size_t samples =
        (size_t)renderer->width * renderer->height * renderer->samples * renderer->samples;
    for (size_t i = 0; i < samples; i++) {
        const uint8_t *p = &renderer->frame[4 * i];
        uint32_t face = (uint32_t)p[0] << 16 | (uint32_t)p[1] << 8 | p[2];
        if (face > 0 && face <= surface->faces) visible[face - 1] = 1;
    }
    uint32_t cell[CELLS][CELLS];
    double side = fmin(fmax(round(CELLS / scale), 1), CELLS);
    if (count_finest(surface, visible, cell) > 0) find_densest(cell, (uint32_t)side, window);
    free(number);
    free(visible);
    return true;
}
