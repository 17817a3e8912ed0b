/* SPDX-License-Identifier: Apache-2.0
 *
 * The light of a picture goes with its camera.
 */
#include <string.h>

#include "render_parts.h"

/* Makes a unit vector of a row of the matrix, as far as it is at right angles to ahead. */
static void screen_direction(double result[3], const double row[4], const double ahead[3]) {
    const double along = hs_dot(row, ahead);
    for (int k = 0; k < 3; k++)
        result[k] = row[k] - along * ahead[k];
    hs_normalize(result);
}

void hs_light_from(hs_light *light, const double matrix[16], const double ahead[3]) {
    double right[3];
    memcpy(light->ahead, ahead, sizeof light->ahead);
    screen_direction(right, &matrix[0], ahead);
    screen_direction(light->up, &matrix[4], ahead);
    for (int i = 0; i < 3; i++)
        light->key[i] = ahead[i] - 0.55 * right[i] + 0.65 * light->up[i];
    hs_normalize(light->key);
}

void hs_light_of_view(hs_light *light, const double matrix[16], const double eye[4]) {
    /* w grows away from the eye, unless the view is parallel. */
    double ahead[3];
    const double sign = eye[3] < 0 ? 1 : -1;
    for (int i = 0; i < 3; i++)
        ahead[i] = sign * matrix[12 + i];
    if (!hs_normalize(ahead)) {
        memcpy(ahead, eye, sizeof ahead);
        hs_normalize(ahead);
    }
    hs_light_from(light, matrix, ahead);
}
