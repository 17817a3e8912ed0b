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

enum { BANKS = 8, LATENCY = 80 };

/* Passes over the items of a generation that is refined: classify, select, guard, split. */
static uint32_t passes_of(const hs_settings *settings, uint32_t depth, const hs_generation *g,
                          uint32_t number) {
    const bool last = !settings->limit && number + 1 == depth, odd = number % 2 == 0;
    if (!settings->uniform) return g->selected ? 4 : 3;
    if (number == 0) return 3; /* classify, guard, split */
    if (settings->limit || (last && odd) || number == 1) return 2;
    return 1; /* classify and split together, or split alone */
}

/* Smooth: a cycle for what moves, or for a row of marks at least; a quarter for what stays. */
static uint64_t smooth_of(const hs_settings *settings, const hs_generation *g, bool odd,
                          bool last) {
    const uint64_t rows = g->vertices / BANKS,
                   active = g->active < g->vertices ? g->active : g->vertices;
    if (settings->uniform && !odd && !last) return 0;
    if (!odd) return rows;
    const uint64_t stay = active > g->moved ? active - g->moved : 0;
    const uint64_t picks = g->moved + stay / 4;
    return picks > rows ? picks : rows;
}

uint64_t hs_expected_of(const hs_settings *settings, uint32_t depth,
                        const hs_generation *generation, uint32_t generations, size_t words_in,
                        uint32_t vertices_out) {
    uint64_t cycles = words_in / 4 + LATENCY; /* quantize works while corners come in */
    uint32_t moved_last = 0;
    for (uint32_t g = 0; g < generations; g++) {
        const hs_generation *of = &generation[g];
        const uint64_t items = g == 0 ? of->corners : of->active;
        const bool last = !settings->limit && g + 1 == depth;
        if (g < depth && of->refined) {
            cycles += passes_of(settings, depth, of, g) * items + LATENCY;
            cycles += smooth_of(settings, of, g % 2 == 0, last);
            if (last && g % 2 == 0) moved_last = of->moved;
        } else if (g == 0 || g < depth || settings->limit) {
            cycles +=
                2 * items + of->vertices / BANKS + LATENCY; /* classify, split: all is final */
        }
    }
    /* Who moves in a last step leaves meanwhile. */
    return cycles + (uint64_t)(vertices_out - moved_last) * 5 / 16;
}
