/* SPDX-License-Identifier: Apache-2.0
 *
 * Viewpoints: from a views file, around a mesh, from an eye; and back to a views file.
 *
 * A perspective view is the product of two matrices, as gluLookAt and gluPerspective define them:
 *
 *     | c/a  0       0             0      |   |  s  -s.eye |      s   to the right,
 *     |  0   c       0             0      | * |  u  -u.eye |      u   up,
 *     |  0   0  (F+N)/(N-F)  2FN/(N-F)    |   | -d   d.eye |      d   along the line of sight,
 *     |  0   0      -1             0      |   |  0     1   |      c   cot(fov/2), a aspect
 */
#define _GNU_SOURCE
#include "view.h"

#include <locale.h>
#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include "file.h"

/* A view is a line of some 300 bytes; this is more views than a 16-bit number can name. */
static const size_t largest_file = (size_t)1 << 28;

/* --- One perspective view --------------------------------------------------------------------- */

static double dot(const double a[3], const double b[3]) {
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double product[3], const double a[3], const double b[3]) {
    product[0] = a[1] * b[2] - a[2] * b[1];
    product[1] = a[2] * b[0] - a[0] * b[2];
    product[2] = a[0] * b[1] - a[1] * b[0];
}

/* Makes the length 1, without overflow on the way. False if it is zero. */
static bool normalize(double vector[3]) {
    double largest = fmax(fabs(vector[0]), fmax(fabs(vector[1]), fabs(vector[2])));
    if (!(largest > 0)) return false;
    for (int i = 0; i < 3; i++)
        vector[i] /= largest;
    double length = sqrt(dot(vector, vector));
    for (int i = 0; i < 3; i++)
        vector[i] /= length;
    return true;
}

static bool all_finite(const double *number, int count) {
    for (int i = 0; i < count; i++)
        if (!isfinite(number[i])) return false;
    return true;
}

bool hs_view_look(hs_view *view, const double eye[3], const double at[3], const double up[3],
                  double fov, double aspect, double near, double far, hs_error *err) {
    if (!all_finite(eye, 3) || !all_finite(at, 3) || !all_finite(up, 3))
        return hs_fail(err, HS_EXIT_VIEWS, "eye, at or up is not finite; give finite numbers");
    if (!(fov > 0 && fov < 180))
        return hs_fail(err, HS_EXIT_VIEWS, "fov %g; it must lie between 0 and 180 degrees", fov);
    if (!(aspect > 0 && isfinite(aspect)))
        return hs_fail(err, HS_EXIT_VIEWS, "aspect %g; it must be positive", aspect);
    if (!(near > 0 && near < far && isfinite(far)))
        return hs_fail(err, HS_EXIT_VIEWS,
                       "near %g and far %g; near must be positive and smaller than far", near, far);

    double sight[3] = {at[0] - eye[0], at[1] - eye[1], at[2] - eye[2]};
    if (!normalize(sight))
        return hs_fail(err, HS_EXIT_VIEWS, "eye and at are the same point; move one of them");
    double unit_up[3] = {up[0], up[1], up[2]}, right[3], above[3];
    if (!normalize(unit_up)) return hs_fail(err, HS_EXIT_VIEWS, "up is zero; give it a direction");
    cross(right, sight, unit_up);
    /* The sine of the angle between them; rounding alone leaves some 1e-16. */
    if (!(dot(right, right) > 1e-24) || !normalize(right))
        return hs_fail(err, HS_EXIT_VIEWS,
                       "up lies along the line of sight; turn it away from there");
    cross(above, right, sight);

    double scale = 1 / tan(fov * (M_PI / 360));
    double depth = (far + near) / (near - far), offset = 2 * far * (near / (near - far));
    double row[4][4];
    for (int i = 0; i < 3; i++) {
        row[0][i] = scale / aspect * right[i];
        row[1][i] = scale * above[i];
        row[2][i] = -depth * sight[i];
        row[3][i] = sight[i];
    }
    row[0][3] = -scale / aspect * dot(right, eye);
    row[1][3] = -scale * dot(above, eye);
    row[2][3] = depth * dot(sight, eye) + offset;
    row[3][3] = -dot(sight, eye);
    for (int i = 0; i < 16; i++) {
        view->matrix[i] = (float)row[i / 4][i % 4];
        if (!isfinite(view->matrix[i]))
            return hs_fail(err, HS_EXIT_VIEWS,
                           "the matrix has a number beyond binary32; use smaller distances");
    }
    return true;
}

/* --- Views around a mesh ---------------------------------------------------------------------- */

typedef struct sphere {
    double center[3], radius;
} sphere;

/* Around the box of all vertices: centre of the box, farthest vertex. False where a vertex at
 * infinity (w = 0) or a size beyond all numbers leaves no such sphere. */
static bool bounding_sphere(sphere *bound, const hs_mesh *mesh) {
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        const float *p = mesh->position + 4 * (size_t)v;
        for (int i = 0; i < 3; i++) {
            double x = (double)p[i] / (double)p[3];
            low[i] = fmin(low[i], x);
            high[i] = fmax(high[i], x);
            if (!isfinite(x)) return false;
        }
    }
    if (mesh->vertices == 0) return false;
    for (int i = 0; i < 3; i++)
        bound->center[i] = (low[i] + high[i]) / 2;
    bound->radius = 0;
    for (uint32_t v = 0; v < mesh->vertices; v++) {
        const float *p = mesh->position + 4 * (size_t)v;
        double out[3];
        for (int i = 0; i < 3; i++)
            out[i] = (double)p[i] / (double)p[3] - bound->center[i];
        bound->radius = fmax(bound->radius, sqrt(dot(out, out)));
    }
    return true;
}

bool hs_views_orbit(hs_views *views, uint32_t count, const hs_mesh *mesh, double aspect,
                    hs_error *err) {
    *views = (hs_views){0};
    static const double fov = 40, raised = 15 * (M_PI / 180);
    if (!(aspect > 0 && isfinite(aspect)))
        return hs_fail(err, HS_EXIT_VIEWS, "aspect %g; it must be positive", aspect);
    sphere bound;
    if (!bounding_sphere(&bound, mesh))
        return hs_fail(err, HS_EXIT_VIEWS,
                       "there is no sphere around the mesh, for it has no vertices or one at "
                       "infinity; give the views in a file");
    /* Binary32 rounds the vertices' clip coordinates: a little room keeps them inside. For a mesh
     * that is small against its distance from the origin it must be that distance's. */
    double far_away = sqrt(dot(bound.center, bound.center));
    double radius = bound.radius * 1.001 + far_away * 1e-5;
    if (!(radius > 0)) radius = 1;

    /* The sphere touches the planes of the narrower field of view: r = distance sin(fov/2). */
    double half = fov / 2 * (M_PI / 180);
    if (aspect < 1) half = atan(aspect * tan(half));
    double distance = radius / sin(half);

    views->view = calloc(count ? count : 1, sizeof *views->view);
    if (!views->view) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for %u views", count);
    views->count = count;
    static const double up[3] = {0, 1, 0};
    for (uint32_t i = 0; i < count; i++) {
        double turn = 2 * M_PI * i / count;
        double eye[3] = {bound.center[0] + distance * cos(raised) * sin(turn),
                         bound.center[1] + distance * sin(raised),
                         bound.center[2] + distance * cos(raised) * cos(turn)};
        if (!hs_view_look(&views->view[i], eye, bound.center, up, fov, aspect, distance - radius,
                          distance + radius, err)) {
            hs_views_free(views);
            return false;
        }
    }
    return true;
}

bool hs_views_open(hs_views *views, const char *path, uint32_t orbit, const hs_mesh *mesh,
                   double aspect, hs_error *err) {
    if (!path) return hs_views_orbit(views, orbit, mesh, aspect, err);
    if (!hs_views_read(views, path, aspect, err)) return false;
    if (views->count > 0 && views->count <= HS_VIEWS_MOST) return true;
    if (views->count == 0)
        hs_fail(err, HS_EXIT_VIEWS,
                "%.300s: no views; add a `look` or a `matrix` line, as in docs/command-line.md",
                path);
    else
        hs_fail(err, HS_EXIT_VIEWS, "%.300s: %u views; a stream numbers at most %d", path,
                views->count, HS_VIEWS_MOST);
    hs_views_free(views);
    return false;
}

bool hs_views_choose(hs_view *view, const hs_views *views, uint32_t number, hs_error *err) {
    if (number >= views->count)
        return hs_fail(err, HS_EXIT_USAGE, "there is no view %u; views are 0 to %u", number,
                       views->count - 1);
    *view = views->view[number];
    return true;
}

bool hs_view_choose(hs_view *view, uint32_t number, const char *path, uint32_t orbit,
                    const hs_mesh *mesh, double aspect, hs_error *err) {
    hs_views views;
    if (!hs_views_open(&views, path, orbit, mesh, aspect, err)) return false;
    const bool there = hs_views_choose(view, &views, number, err);
    hs_views_free(&views);
    return there;
}

/* --- The words of a views file ---------------------------------------------------------------- */

typedef struct reader {
    const char *path;
    locale_t c_locale;
    char *line, *rest; /* the line, and what is left of it */
    uint32_t number;   /* of the line, from 1 */
    uint32_t word;     /* of the word, from 1 */
    hs_look look;      /* the latest view, */
    bool has_look;     /* if it is one */
    uint32_t frames;   /* steps from there to the next view, if `frames` says so, or 0 */
    hs_error *err;
} reader;

/* Fails with file, line and word. */
static bool fail_here(const reader *r, const char *format, ...)
    __attribute__((format(printf, 2, 3)));
static bool fail_here(const reader *r, const char *format, ...) {
    char cause[300];
    va_list arguments;
    va_start(arguments, format);
    vsnprintf(cause, sizeof cause, format, arguments);
    va_end(arguments);
    return hs_fail(r->err, HS_EXIT_VIEWS, "%.200s:%u: word %u: %s", r->path, r->number, r->word,
                   cause);
}

/* Cuts the next word off the line; NULL at its end. */
static char *next_word(reader *r) {
    static const char blank[] = " \t\r\v\f";
    char *word = r->rest + strspn(r->rest, blank);
    size_t length = strcspn(word, blank);
    r->word++;
    r->rest = word + length;
    if (length == 0) return NULL;
    if (*r->rest) *r->rest++ = 0;
    return word;
}

/* What strtof and strtod take beyond decimal numbers, hexadecimal ones included, is fine. strtof
 * for matrices: a double in between would round twice. */
static bool read_number(reader *r, const char *what, float *single, double *number) {
    char *word = next_word(r), *end;
    if (!word) return fail_here(r, "the line ends, but %s is due", what);
    float value = strtof_l(word, &end, r->c_locale);
    if (end == word || *end)
        return fail_here(r, "'%.40s' is not a number, but %s is due", word, what);
    if (!isfinite(value))
        return fail_here(r, "'%.40s' is not finite in binary32; give a smaller %s", word, what);
    if (single) *single = value;
    if (number) *number = strtod_l(word, NULL, r->c_locale);
    return true;
}

static bool read_keyword(reader *r, const char *keyword) {
    const char *word = next_word(r);
    if (!word) return fail_here(r, "the line ends, but '%s' is due", keyword);
    if (strcmp(word, keyword) != 0) return fail_here(r, "'%.40s' where '%s' is due", word, keyword);
    return true;
}

static bool read_end(reader *r) {
    const char *word = next_word(r);
    if (word) return fail_here(r, "'%.40s' behind the view; a line holds one view", word);
    return true;
}

static bool read_matrix(reader *r, hs_view *view) {
    for (int i = 0; i < 16; i++) {
        char what[] = "m00";
        what[1] = (char)('0' + i / 4);
        what[2] = (char)('0' + i % 4);
        if (!read_number(r, what, &view->matrix[i], NULL)) return false;
    }
    return read_end(r);
}

static bool read_point(reader *r, const char *keyword, double point[3]) {
    static const char *const axis[3] = {"x", "y", "z"};
    if (!read_keyword(r, keyword)) return false;
    for (int i = 0; i < 3; i++) {
        char what[20];
        snprintf(what, sizeof what, "%s %s", keyword, axis[i]);
        if (!read_number(r, what, NULL, &point[i])) return false;
    }
    return true;
}

static bool read_value(reader *r, const char *keyword, double *value) {
    return read_keyword(r, keyword) && read_number(r, keyword, NULL, value);
}

static bool read_look(reader *r, hs_look *l) {
    return read_point(r, "eye", l->eye) && read_point(r, "at", l->at) &&
           read_point(r, "up", l->up) && read_value(r, "fov", &l->fov) &&
           read_value(r, "near", &l->near) && read_value(r, "far", &l->far) && read_end(r);
}

static bool read_frames(reader *r) {
    if (!r->has_look) return fail_here(r, "frames lead from a look to a look; none is before it");
    if (r->frames) return fail_here(r, "a second 'frames' before the next look; keep one");
    char *word = next_word(r), *end;
    const unsigned long frames = word ? strtoul(word, &end, 10) : 0;
    if (!word || *end || *word == '-' || frames < 1 || frames > HS_VIEWS_MOST)
        return fail_here(r, "'%.40s' is no number of frames, 1 to %d", word ? word : "",
                         HS_VIEWS_MOST);
    r->frames = (uint32_t)frames;
    return read_end(r);
}

/* --- The file --------------------------------------------------------------------------------- */

/* Makes room for one more view, at least doubling what there was: growth costs O(1) a view. */
static hs_view *append_view(hs_views *views, uint32_t *capacity) {
    if (views->count == *capacity) {
        uint32_t room = *capacity ? 2 * *capacity : 16;
        hs_view *view = realloc(views->view, room * sizeof *view);
        if (!view) return NULL;
        views->view = view;
        *capacity = room;
    }
    return &views->view[views->count++];
}

/* Adds the view of a look. */
static bool add_look(reader *r, hs_views *views, uint32_t *capacity, double aspect,
                     const hs_look *l) {
    hs_error cause;
    r->word = 1;
    hs_view *view = append_view(views, capacity);
    if (!view) return hs_fail(r->err, HS_EXIT_INTERNAL, "no memory for the views of %s", r->path);
    return hs_view_look(view, l->eye, l->at, l->up, l->fov, aspect, l->near, l->far, &cause) ||
           fail_here(r, "%.250s", cause.text);
}

/* Adds the look of this line, and before it those that lead to it. */
static bool add_looks(reader *r, hs_views *views, uint32_t *capacity, double aspect) {
    hs_look here;
    if (!read_look(r, &here)) return false;
    for (uint32_t i = 1; i < r->frames; i++) {
        hs_look between;
        hs_error cause;
        if (!hs_look_between(&between, &r->look, &here, (double)i / r->frames, &cause)) {
            r->word = 1;
            return fail_here(r, "%.250s", cause.text);
        }
        if (!add_look(r, views, capacity, aspect, &between)) return false;
    }
    r->frames = 0;
    r->look = here;
    r->has_look = true;
    return add_look(r, views, capacity, aspect, &here);
}

/* Reads the line at *at, which ends before a line feed or at the end, and moves *at behind it. */
static bool read_line(reader *r, hs_views *views, uint32_t *capacity, double aspect) {
    r->rest = r->line;
    r->word = 0;
    r->rest[strcspn(r->rest, "#")] = 0;
    const char *kind = next_word(r);
    if (!kind) return true;
    if (strcmp(kind, "frames") == 0) return read_frames(r);
    if (strcmp(kind, "look") == 0) return add_looks(r, views, capacity, aspect);
    if (strcmp(kind, "matrix") != 0)
        return fail_here(r, "'%.40s' is no view; a view begins with 'matrix' or 'look'", kind);
    if (r->frames) return fail_here(r, "frames lead to a look; a matrix has no ways between");
    r->has_look = false;
    hs_view *view = append_view(views, capacity);
    if (!view) return hs_fail(r->err, HS_EXIT_INTERNAL, "no memory for the views of %s", r->path);
    return read_matrix(r, view);
}

static bool read_lines(reader *r, hs_views *views, char *text, size_t size, double aspect) {
    uint32_t capacity = 0;
    for (char *at = text, *end = text + size; at < end; r->line = at) {
        char *stop = memchr(at, '\n', (size_t)(end - at));
        if (!stop) stop = end; /* a zero byte stands there */
        r->line = at;
        r->number++;
        r->word = 1;
        if (memchr(at, 0, (size_t)(stop - at)))
            return fail_here(r, "a zero byte in the line; a views file is text");
        *stop = 0;
        if (!read_line(r, views, &capacity, aspect)) return false;
        at = stop + 1;
    }
    r->word = 1;
    if (r->frames)
        return hs_fail(r->err, HS_EXIT_VIEWS,
                       "%.200s:%u: word 1: the file ends behind 'frames'; add the look that they "
                       "lead to",
                       r->path, r->number + 1);
    if (views->count == 0)
        return hs_fail(r->err, HS_EXIT_VIEWS,
                       "%.200s:%u: word 1: the file ends without a view; add a line that begins "
                       "with 'matrix' or 'look'",
                       r->path, r->number + 1);
    return true;
}

bool hs_views_parse(hs_views *views, const char *name, char *text, size_t size, double aspect,
                    hs_error *err) {
    *views = (hs_views){0};
    reader r = {.path = name, .c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0), .err = err};
    if (r.c_locale == (locale_t)0)
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the views of %s", name);
    const bool good = read_lines(&r, views, text, size, aspect);
    freelocale(r.c_locale);
    if (!good) hs_views_free(views);
    return good;
}

bool hs_views_read(hs_views *views, const char *path, double aspect, hs_error *err) {
    *views = (hs_views){0};
    uint8_t *bytes;
    size_t size;
    if (!hs_file_read(path, largest_file, &bytes, &size, err)) return false;
    const bool good = hs_views_parse(views, path, (char *)bytes, size, aspect, err);
    free(bytes);
    return good;
}

bool hs_views_write(const hs_views *views, const char *path, hs_error *err) {
    hs_file file;
    locale_t c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (c_locale == (locale_t)0)
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory for the views of %s", path);
    bool good = hs_file_create(&file, path, err);
    if (good) {
        locale_t before = uselocale(c_locale); /* of this thread alone, and put back below */
        for (uint32_t i = 0; i < views->count; i++) {
            fputs("matrix", file.stream);
            for (int k = 0; k < 16; k++)
                fprintf(file.stream, " %.9g", (double)views->view[i].matrix[k]);
            fputc('\n', file.stream);
        }
        uselocale(before);
        good = hs_file_commit(&file, err);
    }
    freelocale(c_locale);
    return good;
}

void hs_views_free(hs_views *views) {
    free(views->view);
    *views = (hs_views){0};
}
