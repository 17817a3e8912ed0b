/* SPDX-License-Identifier: Apache-2.0
 *
 * Which face a picture shows at a pixel.
 */
#ifndef HS_PICK_H
#define HS_PICK_H

#include "render.h"

#define HS_PICK_NONE UINT32_MAX

/* The face of the surface that is nearest at the middle of pixel x, y (from the upper left corner,
 * from 0) of a picture of width x height pixels: of its triangles, cut as the renderer cuts them,
 * those over that point between the nearest and the farthest plane count, whichever way they face.
 * HS_PICK_NONE if there is none. */
uint32_t hs_pick(const hs_surface *surface, uint32_t x, uint32_t y, uint32_t width,
                 uint32_t height);

#endif
