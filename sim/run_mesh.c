/* SPDX-License-Identifier: Apache-2.0 */
#include "run_mesh.h"

#include <stdlib.h>
#include <string.h>

#include "mesh_source.h"

/* Opens the mesh of a view, with its forced depths, in place of another one. */
static bool open_mesh(hs_run *run, uint32_t view, bool quiet, hs_error *err) {
    const hs_run_request *r = run->request;
    char name[4096];
    const char *source = r->mesh;
    hs_mesh_free(&run->mesh);
    if (run->frames.count) {
        if (!hs_frames_name(&run->frames, view, name, sizeof name, err)) return false;
        source = name;
    }
    if (!hs_mesh_open(&run->mesh, source, r->round_sharpness, quiet, err) ||
        (r->force && !hs_mesh_force(&run->mesh, r->force, err)))
        return false;
    run->depth = hs_view_depth(&r->settings, &run->mesh);
    return true;
}

/* Adds the positions of run->mesh to those of all meshes. */
static bool gather(hs_mesh *all, const hs_mesh *mesh, hs_error *err) {
    const size_t before = all->vertices, more = mesh->vertices;
    float *position = before + more <= UINT32_MAX
                          ? realloc(all->position, (before + more) * 4 * sizeof *position)
                          : NULL;
    if (!position) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for a view of all meshes");
    memcpy(position + 4 * before, mesh->position, more * 4 * sizeof *position);
    all->position = position;
    all->vertices += mesh->vertices;
    return true;
}

/* One view for all meshes, or a view for each. */
static bool share_views(hs_run *run, hs_error *err) {
    const uint32_t count = run->frames.count, views = run->views.count;
    if (views == count || count == 1) return true;
    if (views != 1)
        return hs_fail(err, HS_EXIT_VIEWS,
                       "%.200s: %u meshes, but %u views; give one view for all, or %u",
                       run->request->mesh, count, views, count);
    hs_view *view = realloc(run->views.view, count * sizeof *view);
    if (!view) return hs_fail(err, HS_EXIT_INTERNAL, "no memory for %u views", count);
    for (uint32_t i = 1; i < count; i++)
        view[i] = view[0];
    run->views = (hs_views){count, view};
    return true;
}

static bool open_frames(hs_run *run, double aspect, hs_error *err) {
    const hs_run_request *r = run->request;
    hs_mesh all = {0};
    bool good = true;
    for (uint32_t i = 0; good && i < run->frames.count; i++) {
        hs_progress_show(&run->progress, "reading mesh %u of %u", i + 1, run->frames.count);
        good = open_mesh(run, i, r->quiet, err) && gather(&all, &run->mesh, err);
    }
    hs_progress_clear(&run->progress);
    good = good && open_mesh(run, 0, true, err) &&
           hs_views_open(&run->views, r->views, r->orbit, &all, aspect, err) &&
           share_views(run, err);
    free(all.position);
    return good;
}

bool hs_run_mesh_open(hs_run *run, hs_error *err) {
    const hs_run_request *r = run->request;
    const double aspect = (double)r->width / (double)r->height;
    if (!hs_frames_find(&run->frames, r->mesh, err)) return false;
    if (run->frames.count) return open_frames(run, aspect, err);
    return open_mesh(run, 0, r->quiet, err) &&
           hs_views_open(&run->views, r->views, r->orbit, &run->mesh, aspect, err);
}

bool hs_run_mesh_enter(hs_run *run, uint32_t view, hs_error *err) {
    if (run->frames.count < 2) return true;
    const hs_run_request *r = run->request;
    if (!open_mesh(run, view, true, err)) return false;
    if (!run->pictures) return true;
    hs_run_pictures_free(run->pictures);
    run->pictures = hs_run_pictures_new(&run->mesh, &r->settings, r->width, r->height,
                                        r->reference_levels, err);
    return run->pictures != NULL;
}
