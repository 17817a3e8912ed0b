/* SPDX-License-Identifier: Apache-2.0 */
#include "figure_counts.h"

#include <stdio.h>

#include "json_file.h"

void hs_figure_count(hs_figure_counts *counts, const char *caption, const hs_surface *surface) {
    hs_figure_panel *panel = &counts->panel[counts->panels++];
    *panel = (hs_figure_panel){.vertices = surface->vertices,
                               .faces = surface->faces,
                               .deepest = hs_surface_deepest(surface)};
    snprintf(panel->caption, sizeof panel->caption, "%s", caption);
    uint8_t triangle[3 * HS_MAX_SIDES];
    for (uint32_t f = 0; f < surface->faces; f++) {
        panel->cut += hs_surface_triangles(surface, f, triangle);
        panel->generation[surface->generation[f]]++;
        panel->facing[surface->facing[f]]++;
    }
}

void hs_figure_caption(char caption[HS_FIGURE_CAPTION], const hs_figure_panel *panel) {
    char faces[HS_COUNT_TEXT];
    snprintf(caption, HS_FIGURE_CAPTION, "%s (%s faces)", panel->caption,
             hs_count_text(faces, panel->faces));
}

static json_t *panel_json(const hs_figure_panel *panel, bool *good) {
    json_t *object = json_object(), *generations = json_array();
    for (uint32_t g = 0; g <= panel->deepest; g++)
        hs_json_append(generations, json_integer(panel->generation[g]), good);
    hs_json_set(object, "caption", json_string(panel->caption), good);
    hs_json_set(object, "vertices", json_integer(panel->vertices), good);
    hs_json_set(object, "faces", json_integer(panel->faces), good);
    hs_json_set(object, "cut", json_integer(panel->cut), good);
    hs_json_set(object, "generations", generations, good);
    json_t *facing = json_object();
    static const char *const name[] = {
        [HS_FACING_FRONT] = "front", [HS_FACING_BACK] = "back", [HS_FACING_BOTH] = "both"};
    for (int i = 0; i < 3; i++)
        hs_json_set(facing, name[i], json_integer(panel->facing[i]), good);
    hs_json_set(object, "facing", facing, good);
    return object;
}

bool hs_figure_counts_write(const hs_figure_counts *counts, const char *figure, const char *path,
                            hs_error *err) {
    hs_file file;
    if (!hs_file_create(&file, path, err)) return false;
    bool good = true;
    json_t *all = json_object(), *panels = json_array();
    for (uint32_t i = 0; i < counts->panels; i++)
        hs_json_append(panels, panel_json(&counts->panel[i], &good), &good);
    hs_json_set(all, "figure", json_string(figure), &good);
    hs_json_set(all, "panels", panels, &good);
    if (counts->cycles) hs_json_set(all, "cycles", json_integer((json_int_t)counts->cycles), &good);
    if (!good) hs_file_abandon(&file);
    const bool done = good ? hs_json_commit(all, JSON_INDENT(2), &file, err)
                           : hs_fail(err, HS_EXIT_INTERNAL, "no memory for %.300s", path);
    json_decref(all);
    return done;
}
