/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include "convert_write.h"

#include <locale.h>

#include "render_parts.h"

bool hs_text_begin(hs_text_file *text, const char *path, hs_error *err) {
    if (!hs_file_create(&text->file, path, err)) return false;
    text->c_locale = newlocale(LC_ALL_MASK, "C", (locale_t)0);
    if (!text->c_locale) {
        hs_file_abandon(&text->file);
        return hs_fail(err, HS_EXIT_INTERNAL, "%.300s: out of memory; free some memory", path);
    }
    text->previous = uselocale(text->c_locale);
    return true;
}

bool hs_text_end(hs_text_file *text, hs_error *err) {
    uselocale(text->previous);
    freelocale(text->c_locale);
    return hs_file_commit(&text->file, err);
}

void hs_scene_color(const hs_scene *scene, uint8_t generation, uint8_t rgb[3]) {
    const uint32_t color = hs_depth_color(generation, scene->deepest);
    for (int i = 0; i < 3; i++)
        rgb[i] = (uint8_t)(color >> (16 - 8 * i));
}
