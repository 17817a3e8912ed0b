/* SPDX-License-Identifier: Apache-2.0
 *
 * The second camera: a surface that was refined for one viewpoint, looked at from another.
 */
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "render.h"
#include "render_parts.h"

/* The camera's opening angle, and how much of the picture the surface may take. */
#define VIEW_ANGLE 24.0
#define FILL       0.90

typedef struct hs_box {
    double low[3], high[3], middle[3];
    double radius; /* of the sphere around the box */
} hs_box;

static hs_box bounding_box(const hs_surface *surface) {
    hs_box box;
    for (uint32_t i = 0; i < 3; i++) {
        box.low[i] = INFINITY;
        box.high[i] = -INFINITY;
        for (uint32_t v = 0; v < surface->vertices; v++) {
            box.low[i] = fmin(box.low[i], surface->object[3 * (size_t)v + i]);
            box.high[i] = fmax(box.high[i], surface->object[3 * (size_t)v + i]);
        }
        box.middle[i] = (box.low[i] + box.high[i]) / 2;
    }
    box.radius = sqrt(pow(box.high[0] - box.low[0], 2) + pow(box.high[1] - box.low[1], 2) +
                      pow(box.high[2] - box.low[2], 2)) /
                 2;
    return box;
}

/* The unit direction from a point to where the eye really is, be the view mirrored or not. */
static bool direction_to_eye(const hs_surface *surface, const double from[3], double to_eye[3]) {
    double sign = surface->eye[3] < 0 ? -1 : 1;
    for (int i = 0; i < 3; i++)
        to_eye[i] = sign * (surface->eye[i] - from[i] * surface->eye[3]);
    return hs_normalize(to_eye);
}

/* The axis of object space, with its sign, that rises most on the screen around a point: the
 * gradient of y/w is (row_y w - row_w y) / w^2. */
static void upright_axis(const hs_surface *surface, const double at[3], double axis[3]) {
    const double p[4] = {at[0], at[1], at[2], 1};
    double clip[4], rise[3];
    hs_matrix_apply(clip, surface->matrix, p);
    for (int i = 0; i < 3; i++)
        rise[i] = surface->matrix[4 + i] * clip[3] - surface->matrix[12 + i] * clip[1];
    int best = 1;
    for (int i = 0; i < 3; i++)
        if (fabs(rise[i]) > fabs(rise[best]) * 1.001) best = i;
    axis[0] = axis[1] = axis[2] = 0;
    axis[best] = rise[best] < 0 ? -1 : 1;
}

/* v turned around a unit axis (O. Rodrigues). */
static void rotate(double v[3], const double axis[3], double degrees) {
    double angle = degrees * M_PI / 180, c = cos(angle), s = sin(angle), across[3];
    double along = hs_dot(axis, v) * (1 - c);
    hs_cross(across, axis, v);
    for (int i = 0; i < 3; i++)
        v[i] = v[i] * c + across[i] * s + axis[i] * along;
}

/* A perspective view of a sphere from a direction, as gluLookAt and gluPerspective define it. */
static void look_at_sphere(double m[16], const double middle[3], double radius,
                           const double to_eye[3], const double up[3], double aspect) {
    double right[3], above[3], f = 1 / tan(VIEW_ANGLE * M_PI / 360);
    double distance = radius / sin(VIEW_ANGLE * M_PI / 360);
    double near = distance - 1.05 * radius, far = distance + 1.05 * radius;
    hs_cross(right, up, to_eye);
    if (!hs_normalize(right)) right[to_eye[0] * to_eye[0] < 0.5 ? 0 : 1] = 1;
    hs_cross(above, to_eye, right);
    hs_normalize(above);
    for (int i = 0; i < 3; i++) {
        m[i] = f / aspect * right[i];
        m[4 + i] = f * above[i];
        m[8 + i] = -(far + near) / (far - near) * to_eye[i];
        m[12 + i] = -to_eye[i];
    }
    m[3] = -f / aspect * hs_dot(right, middle);
    m[7] = -f * hs_dot(above, middle);
    double behind = hs_dot(to_eye, middle) + distance; /* the eye's place along to_eye */
    m[11] = (far + near) / (far - near) * behind - 2 * far * near / (far - near);
    m[15] = behind;
}

/* Enlarges and shifts the picture so that the surface fills FILL of it, undistorted. */
static void fit(double m[16], const hs_surface *surface) {
    double low[2] = {INFINITY, INFINITY}, high[2] = {-INFINITY, -INFINITY};
    for (uint32_t v = 0; v < surface->vertices; v++) {
        const double *o = &surface->object[3 * (size_t)v], p[4] = {o[0], o[1], o[2], 1};
        double clip[4];
        hs_matrix_apply(clip, m, p);
        for (int i = 0; i < 2; i++) {
            low[i] = fmin(low[i], clip[i] / clip[3]);
            high[i] = fmax(high[i], clip[i] / clip[3]);
        }
    }
    double extent = fmax(high[0] - low[0], high[1] - low[1]);
    if (!(extent > 0)) return;
    double scale = 2 * FILL / extent;
    for (int i = 0; i < 2; i++)
        for (int j = 0; j < 4; j++)
            m[4 * i + j] = scale * (m[4 * i + j] - (low[i] + high[i]) / 2 * m[12 + j]);
}

/* A copy, facing included, without matrix, eye and clip positions. */
static bool copy_surface(hs_surface *copy, const hs_surface *surface, hs_error *err) {
    if (!hs_surface_make(copy, surface->vertices, surface->faces, surface->first, surface->corner,
                         surface->generation, err))
        return false;
    if (surface->normal && !hs_surface_add_normals(copy, surface->normal, err)) return false;
    memcpy(copy->object, surface->object, (size_t)surface->vertices * 3 * sizeof(double));
    memcpy(copy->facing, surface->facing, surface->faces);
    return true;
}

/* Eye and clip positions that belong to the matrix. */
static void project(hs_surface *surface) {
    hs_eye_of_matrix(surface->eye, surface->matrix);
    for (uint32_t v = 0; v < surface->vertices; v++) {
        const double *o = &surface->object[3 * (size_t)v], p[4] = {o[0], o[1], o[2], 1};
        double clip[4];
        hs_matrix_apply(clip, surface->matrix, p);
        for (uint32_t i = 0; i < 4; i++)
            surface->clip[4 * (size_t)v + i] = (float)clip[i];
    }
}

bool hs_surface_view(hs_surface *seen, const hs_surface *surface, const float matrix[16],
                     hs_error *err) {
    *seen = (hs_surface){0};
    if (!surface->object)
        return hs_fail(err, HS_EXIT_VIEWS,
                       "the view's matrix is unknown or singular, so the mesh cannot be seen from "
                       "elsewhere; give an invertible matrix");
    if (!copy_surface(seen, surface, err)) return false;
    for (int i = 0; i < 16; i++)
        seen->matrix[i] = (double)matrix[i];
    project(seen);
    return true;
}

bool hs_surface_turn(hs_surface *turned, const hs_surface *surface, double degrees, double aspect,
                     hs_error *err) {
    *turned = (hs_surface){0};
    if (!surface->object)
        return hs_fail(err, HS_EXIT_VIEWS,
                       "the view's matrix is unknown or singular, so the mesh cannot be seen from "
                       "the side; give an invertible matrix");
    if (surface->vertices == 0)
        return hs_fail(err, HS_EXIT_VIEWS, "an empty mesh cannot be seen from the side");
    hs_box box = bounding_box(surface);
    double to_eye[3], axis[3];
    if (!direction_to_eye(surface, box.middle, to_eye)) to_eye[2] = 1;
    upright_axis(surface, box.middle, axis);
    rotate(to_eye, axis, degrees);
    if (!copy_surface(turned, surface, err)) return false;
    look_at_sphere(turned->matrix, box.middle, fmax(box.radius, 1e-30), to_eye, axis, aspect);
    fit(turned->matrix, turned);
    if (surface->eye[3] < 0) /* a mirrored view stays one: fronts stay fronts */
        for (int j = 0; j < 4; j++)
            turned->matrix[j] = -turned->matrix[j];
    project(turned);
    return true;
}
