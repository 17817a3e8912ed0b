/* SPDX-License-Identifier: Apache-2.0
 *
 * Scenes as files: PLY, glTF 2.0, POV-Ray, OBJ. The colour of a point or vertex says how deep the
 * surface was refined there, in the renderer's palette. Files appear whole or not at all; all
 * errors are HS_EXIT_FILE or HS_EXIT_INTERNAL unless something else is said.
 */
#ifndef HS_CONVERT_WRITE_H
#define HS_CONVERT_WRITE_H

#include "convert_scene.h"
#include "file.h"

/* PLY 1.0, binary little-endian, or text: a vertex for every point (x, y, z, w in clip space;
 * normal; colour) and the polygons, each with its generation. */
bool hs_write_ply(const char *path, const hs_scene *scene, bool text, hs_error *err);

/* glTF 2.0: triangles (the scene must be cut) with normals and colours, in clip space w as the
 * attribute _W. If path ends in .gltf, the buffer is a file of its own beside it, with the ending
 * .bin; anything else is one binary file, GLB. */
bool hs_write_gltf(const char *path, const hs_scene *scene, hs_error *err);

/* POV-Ray 3.7: a mesh2 (the scene must be cut), a camera that sees it as the view does, in a
 * picture of width x height pixels, and the light that goes with that camera. Fails for a scene in
 * clip space (HS_EXIT_USAGE) and for views that no camera has, with a singular matrix
 * (HS_EXIT_VIEWS). */
bool hs_write_pov(const char *path, const hs_scene *scene, uint32_t width, uint32_t height,
                  hs_error *err);

/* OBJ: `v x y z r g b`, in clip space `v x y z w`; normals; polygons. Vertices and faces are in the
 * output's order, nine significant digits. */
bool hs_write_obj(const char *path, const hs_scene *scene, hs_error *err);

/* A file of text with decimal points, wherever the program runs. Between begin and end the thread
 * has the "C" locale; end commits. */
typedef struct hs_text_file {
    hs_file file;
    void *c_locale, *previous; /* locale_t */
} hs_text_file;
bool hs_text_begin(hs_text_file *text, const char *path, hs_error *err);
bool hs_text_end(hs_text_file *text, hs_error *err);

/* The sRGB colour of a generation: red, green, blue. */
void hs_scene_color(const hs_scene *scene, uint8_t generation, uint8_t rgb[3]);

#endif
