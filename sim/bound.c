/* SPDX-License-Identifier: Apache-2.0 */
#include "bound.h"

enum { BEAT_WORDS = 16 };

uint32_t hs_view_depth(const hs_settings *settings, const hs_mesh *mesh) {
    if (settings->uniform) return settings->uniform_depth;
    uint32_t depth = settings->front_depth;
    if (settings->silhouette_depth > depth) depth = settings->silhouette_depth;
    for (uint32_t f = 0; f < mesh->faces; f++)
        if (mesh->forced[f] > depth) depth = mesh->forced[f];
    return depth;
}

hs_bound hs_bound_of(const hs_settings *settings, uint32_t depth, const hs_generation *generation,
                     uint32_t generations, uint32_t vertices, size_t words_in, size_t words_out) {
    hs_bound bound = {0};
    uint64_t *stage = bound.stage;
    for (uint32_t g = 0; g < generations; g++) {
        const uint64_t items = g == 0 ? generation[g].corners : generation[g].active;
        if (g < depth) {
            if (!settings->uniform || g % 2 == 0) stage[HS_STAGE_classify] += items;
            if (!settings->uniform) stage[HS_STAGE_select] += items;
            if (!settings->uniform && generation[g].selected) stage[HS_STAGE_guard] += items;
        }
        const bool rings = settings->limit && g == depth;
        if (rings) stage[HS_STAGE_classify] += items;
        if (g < depth || g == 0 || rings) stage[HS_STAGE_split] += items;
        stage[HS_STAGE_smooth] += generation[g].moved;
    }
    bound.total = stage[HS_STAGE_classify] + stage[HS_STAGE_select] + stage[HS_STAGE_guard] +
                  stage[HS_STAGE_smooth] + stage[HS_STAGE_split];
    stage[HS_STAGE_receive] = (words_in + BEAT_WORDS - 1) / BEAT_WORDS;
    stage[HS_STAGE_transform] = stage[HS_STAGE_quantize] = generations ? vertices : 0;
    stage[HS_STAGE_emit] = (words_out + BEAT_WORDS - 1) / BEAT_WORDS;
    return bound;
}
