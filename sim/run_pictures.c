/* SPDX-License-Identifier: Apache-2.0
 *
 * In the order in which a run meets it: the reference surface (once a run), the refined picture of
 * each engine and its comparison with the first one's, the comparison with the reference surface,
 * and the files of a view, which come all or not at all.
 */
#include "run_pictures.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "png_file.h"
#include "reference.h"

/* --- The reference surface -------------------------------------------------------------------- */

static bool is_closed(const hs_mesh *mesh) {
    for (uint32_t h = 0; h < mesh->halfedges; h++)
        if (mesh->twin[h] == HS_BORDER) return false;
    return true;
}

/* The first level has a quad per corner, and each further one four times as many. On an open mesh
 * a level has fewer: its first step leaves a triangle per boundary edge, where quads would go on.
 */
static uint32_t affordable_level(const hs_mesh *mesh, uint32_t levels) {
    uint64_t faces = mesh->halfedges;
    uint32_t affordable = 0;
    for (; affordable < levels && faces <= HS_REFERENCE_SURFACE_FACES; faces *= 4)
        affordable++;
    return affordable;
}

/* True if every edge becomes a quad, so that all faces are active until the end. */
static bool has_limit(const hs_mesh *mesh, hs_boundary boundary) {
    return boundary != HS_BOUNDARY_KEPT || is_closed(mesh);
}

static bool refine(hs_reference *reference, const hs_mesh *mesh, hs_boundary boundary,
                   uint32_t level, hs_error *err) {
    if (!hs_reference_new(reference, mesh, NULL, boundary, err)) return false;
    const bool direct = has_limit(mesh, boundary);
    for (uint32_t i = 0; i < level; i++) {
        bool done = direct ? hs_reference_catmull_clark(reference, err)
                           : hs_reference_step(reference, NULL, err) &&
                                 hs_reference_step(reference, NULL, err);
        if (!done) return false;
    }
    return true;
}

static bool exhausted(uint32_t faces, hs_error *err) {
    return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a reference surface of %u faces", faces);
}

/* The corners of active faces, in their order, are those of the final faces that come of them. */
static bool take_limits(hs_reference_surface *surface, const hs_reference *reference, bool move,
                        hs_error *err) {
    double(*position)[4] = calloc((size_t)reference->vertices + 1, sizeof *position);
    double(*normal)[3] = calloc((size_t)reference->corners + 1, sizeof *normal);
    surface->normal = malloc((3 * (size_t)reference->corners + 1) * sizeof *surface->normal);
    bool done = position && normal && surface->normal;
    if (!done) exhausted(reference->faces, err);
    done = done && hs_reference_limit(reference, position, normal, err);
    for (size_t i = 0; i < 3 * (size_t)reference->corners && done; i++)
        surface->normal[i] = (float)normal[i / 3][i % 3];
    if (done && move)
        memcpy(surface->position, position, (size_t)reference->vertices * sizeof *position);
    free(position);
    free(normal);
    return done;
}

static bool take_faces(hs_reference_surface *surface, const hs_reference *reference,
                       hs_error *err) {
    const uint32_t faces = reference->finals;
    surface->first = calloc((size_t)faces + 1, sizeof *surface->first);
    surface->corner = calloc((size_t)reference->final_corners + 1, sizeof *surface->corner);
    surface->generation = calloc((size_t)faces + 1, 1);
    if (!surface->first || !surface->corner || !surface->generation) return exhausted(faces, err);
    for (uint32_t f = 0; f < faces; f++) {
        const hs_reference_final *final = &reference->final[f];
        memcpy(&surface->corner[surface->first[f]], &reference->final_vertex[final->v.first],
               final->v.count * sizeof(uint32_t));
        surface->first[f + 1] = surface->first[f] + final->v.count;
        surface->generation[f] = (uint8_t) final->generation;
    }
    return true;
}

static bool take_positions(hs_reference_surface *surface, const hs_reference *reference,
                           hs_error *err) {
    surface->position = calloc((size_t)reference->vertices * 4 + 1, sizeof *surface->position);
    if (!surface->position) return exhausted(reference->faces, err);
    for (uint32_t v = 0; v < reference->vertices; v++)
        memcpy(&surface->position[4 * (size_t)v], reference->vertex[v].position,
               4 * sizeof *surface->position);
    return true;
}

bool hs_reference_surface_make(hs_reference_surface *surface, const hs_mesh *mesh,
                               const hs_settings *settings, uint32_t levels, hs_error *err) {
    const hs_boundary boundary = settings->boundary;
    *surface =
        (hs_reference_surface){.level = affordable_level(mesh, levels), .asked_level = levels};
    hs_reference r = {0};
    const bool done =
        refine(&r, mesh, boundary, surface->level, err) && take_positions(surface, &r, err) &&
        (!has_limit(mesh, boundary) || take_limits(surface, &r, settings->limit, err)) &&
        hs_reference_finish(&r, err) && take_faces(surface, &r, err);
    surface->faces = (hs_faces){.vertices = r.vertices,
                                .faces = r.finals,
                                .position = surface->position,
                                .normal = surface->normal,
                                .first = surface->first,
                                .corner = surface->corner,
                                .generation = surface->generation};
    hs_reference_free(&r);
    if (!done) hs_reference_surface_free(surface);
    return done;
}

void hs_reference_surface_free(hs_reference_surface *surface) {
    free(surface->position);
    free(surface->normal);
    free(surface->first);
    free(surface->corner);
    free(surface->generation);
    *surface = (hs_reference_surface){0};
}

/* --- Context ---------------------------------------------------------------------------------- */

/* Samples along a pixel's side. */
enum { SAMPLES = 3 };

struct hs_run_pictures {
    const hs_mesh *mesh;
    hs_renderer *renderer;
    hs_reference_surface surface; /* no faces: there is none */
};

hs_run_pictures *hs_run_pictures_new(const hs_mesh *mesh, const hs_settings *settings,
                                     uint32_t width, uint32_t height, uint32_t levels,
                                     hs_error *err) {
    hs_run_pictures *pictures = calloc(1, sizeof *pictures);
    if (!pictures) {
        hs_fail(err, HS_EXIT_INTERNAL, "no memory for pictures");
        return NULL;
    }
    pictures->mesh = mesh;
    pictures->renderer = hs_renderer_new(width, height, SAMPLES, err);
    if (pictures->renderer &&
        (levels == 0 || hs_reference_surface_make(&pictures->surface, mesh, settings, levels, err)))
        return pictures;
    hs_run_pictures_free(pictures);
    return NULL;
}

const hs_reference_surface *hs_run_pictures_reference(const hs_run_pictures *pictures) {
    return pictures->surface.faces.faces ? &pictures->surface : NULL;
}

void hs_run_pictures_free(hs_run_pictures *pictures) {
    if (!pictures) return;
    hs_renderer_free(pictures->renderer);
    hs_reference_surface_free(&pictures->surface);
    free(pictures);
}

/* --- One engine and another ------------------------------------------------------------------- */

/* The pictures in which engines must agree. */
static const enum hs_view_picture compared_pictures[] = {HS_VIEW_REFINED, HS_VIEW_REFINED_WIRES};
enum { COMPARED_PICTURES = sizeof compared_pictures / sizeof *compared_pictures };

/* Unlike hs_picture_compare, this counts pixels of another coverage as well. */
static uint64_t count_different(const hs_picture *a, const hs_picture *b) {
    uint64_t different = 0;
    for (size_t i = 0; i < (size_t)a->width * a->height; i++)
        different +=
            a->coverage[i] != b->coverage[i] || memcmp(&a->rgb[3 * i], &b->rgb[3 * i], 3) != 0;
    return different;
}

static void describe_pixel(hs_run_picture_comparison *c, const hs_picture *a, const hs_picture *b,
                           uint32_t x, uint32_t y) {
    const size_t i = (size_t)y * a->width + x;
    const uint8_t *p = &a->rgb[3 * i], *q = &b->rgb[3 * i];
    snprintf(c->first, sizeof c->first,
             "%s.png, pixel (%u, %u): %.16s #%02x%02x%02x (covered %u/255), %.16s #%02x%02x%02x "
             "(covered %u/255)",
             c->what, x, y, c->a, p[0], p[1], p[2], a->coverage[i], c->b, q[0], q[1], q[2],
             b->coverage[i]);
}

/* Most pictures are equal; those need no distances. */
static bool compare_pixels(hs_run_picture_comparison *c, const hs_picture *a, const hs_picture *b,
                           hs_error *err) {
    uint32_t x, y;
    if (!hs_picture_equal(a, b, &x, &y)) {
        if (!hs_picture_compare(&c->difference, a, b, err)) return false;
        c->difference.different = count_different(a, b);
        describe_pixel(c, a, b, x, y);
        return true;
    }
    uint64_t covered = 0, pixels = (uint64_t)a->width * a->height;
    for (size_t i = 0; i < pixels; i++)
        covered += a->coverage[i] >= 128;
    c->difference = (hs_picture_difference){.pixels = pixels,
                                            .covered_a = covered,
                                            .covered_b = covered,
                                            .psnr = INFINITY,
                                            .psnr_covered = INFINITY};
    return true;
}

static bool compare_engine(hs_run_pictures_report *report, hs_run_pictures *pictures,
                           const hs_view_pictures *drawn, const float matrix[16],
                           const hs_run_output *a, const hs_run_output *b, hs_error *err) {
    hs_surface surface;
    if (!hs_surface_of_output(&surface, b->output, matrix, err)) return false;
    bool done = true;
    for (int i = 0; i < COMPARED_PICTURES && done; i++) {
        const enum hs_view_picture which = compared_pictures[i];
        hs_run_picture_comparison *c = &report->comparison[report->comparisons++];
        *c = (hs_run_picture_comparison){.a = a->engine,
                                         .b = b->engine,
                                         .what = hs_view_picture_file(which),
                                         .must_equal = true};
        hs_picture picture = {0};
        done = hs_view_picture_draw(&picture, which, pictures->renderer, &surface, NULL, err) &&
               compare_pixels(c, &drawn->picture[which], &picture, err);
        hs_picture_free(&picture);
        if (done && surface.faces == 0) {
            c->difference.different = c->difference.pixels;
            snprintf(c->first, sizeof c->first, "%.16s sent no faces (status %s)", b->engine,
                     hs_status_name(b->output->status));
        }
    }
    hs_surface_free(&surface);
    return done;
}

/* --- The refined picture and the reference surface -------------------------------------------- */

/* Draws the reference surface as the refined picture is drawn. Where the output's light cannot be
 * computed (a singular matrix), the surface's is left out as well. */
static bool draw_reference(hs_picture *picture, hs_run_pictures *pictures, const float matrix[16],
                           bool lit, hs_error *err) {
    hs_surface surface;
    if (!hs_surface_of_faces(&surface, &pictures->surface.faces, matrix, err)) return false;
    if (!lit) {
        free(surface.object);
        free(surface.normal);
        surface.object = NULL;
        surface.normal = NULL;
    }
    bool done =
        hs_view_picture_draw(picture, HS_VIEW_REFINED, pictures->renderer, &surface, NULL, err);
    hs_surface_free(&surface);
    return done;
}

/* Leaves *reference and *difference empty if there is no reference surface. */
static bool compare_reference(hs_run_pictures_report *report, hs_picture *reference,
                              hs_picture *difference, hs_run_pictures *pictures,
                              const hs_view_pictures *drawn, const float matrix[16],
                              const char *engine, hs_error *err) {
    if (!hs_run_pictures_reference(pictures)) return true;
    const hs_picture *refined = &drawn->picture[HS_VIEW_REFINED];
    report->reference_level = pictures->surface.level;
    report->reference_faces = pictures->surface.faces.faces;
    hs_run_picture_comparison *c = &report->comparison[report->comparisons++];
    *c = (hs_run_picture_comparison){
        .a = engine, .b = "reference", .what = hs_view_picture_file(HS_VIEW_REFINED)};
    const bool lit = drawn->no_side[0] == 0;
    return draw_reference(reference, pictures, matrix, lit, err) &&
           hs_picture_compare(&c->difference, refined, reference, err) &&
           hs_picture_subtract(difference, refined, reference, HS_DIFFERENCE_GAIN, err);
}

/* --- Files ------------------------------------------------------------------------------------ */

static bool join(char path[PATH_MAX], const char *folder, const char *file, hs_error *err) {
    const int length = snprintf(path, PATH_MAX, "%s/%s", folder, file);
    if (length > 0 && length < PATH_MAX) return true;
    return hs_fail(err, HS_EXIT_FILE, "%.300s...: the name of this folder is too long", folder);
}

static bool write_files(const hs_view_pictures *drawn, const hs_picture *reference,
                        const hs_picture *difference, const char *folder, const char *title,
                        hs_error *err) {
    char reference_path[PATH_MAX], difference_path[PATH_MAX];
    if (!join(reference_path, folder, "reference.png", err) ||
        !join(difference_path, folder, "difference.png", err))
        return false;
    if (!reference->rgb) return hs_view_pictures_write(drawn, folder, title, err);
    /* Those of the view come last, as they take back their own files if they fail. */
    const bool has_reference = hs_png_write(reference, reference_path, err);
    const bool has_difference = has_reference && hs_png_write(difference, difference_path, err);
    if (has_difference && hs_view_pictures_write(drawn, folder, title, err)) return true;
    if (has_reference) remove(reference_path);
    if (has_difference) remove(difference_path);
    return false;
}

/* --- A view ----------------------------------------------------------------------------------- */

bool hs_run_pictures_view(hs_run_pictures *pictures, const char *folder, const char *title,
                          const float matrix[16], const hs_run_output *output, uint32_t outputs,
                          hs_run_pictures_report *report, hs_error *err) {
    *report = (hs_run_pictures_report){0};
    if (outputs < 1 || (outputs - 1) * COMPARED_PICTURES + 1 > HS_RUN_PICTURE_COMPARISONS)
        return hs_fail(err, HS_EXIT_INTERNAL, "pictures of %u engines cannot be compared", outputs);
    if (output[0].output->faces == 0) return true;

    hs_view_pictures drawn;
    if (!hs_view_pictures_draw(&drawn, pictures->renderer, pictures->mesh, output[0].output, matrix,
                               err))
        return false;
    memcpy(report->no_side, drawn.no_side, sizeof report->no_side);
    hs_picture reference = {0}, difference = {0};
    bool done = true;
    for (uint32_t i = 1; i < outputs && done; i++)
        done = compare_engine(report, pictures, &drawn, matrix, &output[0], &output[i], err);
    done = done &&
           compare_reference(report, &reference, &difference, pictures, &drawn, matrix,
                             output[0].engine, err) &&
           write_files(&drawn, &reference, &difference, folder, title, err);
    report->drawn = done;
    hs_picture_free(&reference);
    hs_picture_free(&difference);
    hs_view_pictures_free(&drawn);
    return done;
}
