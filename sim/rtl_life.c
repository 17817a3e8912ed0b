/* SPDX-License-Identifier: Apache-2.0
 *
 * How long a view may take. Two bounds, both far above what the pipeline needs. In total: every
 * generation reads, at most, twice the faces of the one before, and no more than the limits; a face
 * or a vertex takes a few cycles, a division by an odd valence some dozens. And between two items
 * that any stage takes or gives: a sweep over the memories.
 */
#include <stdio.h>

#include "rtl_parts.h"

/* The greatest depth that the packet asks for: the header's, and, among what may be the forced
 * depths of single corners, theirs. */
static uint32_t deepest(const hs_packet *in) {
    uint32_t depth = 0;
    if (in->words < 8) return 0;
    const uint64_t records = in->words / 4;
    const uint32_t depths = in->word[6], corners = in->word[5];
    for (int i = 0; i < 24; i += 8)
        if ((depths >> i & 0xff) > depth) depth = depths >> i & 0xff;
    const uint64_t behind = (uint64_t)corners + 1;
    for (uint64_t r = behind < records ? records - behind : records; r < records; r++)
        if ((in->word[4 * r + 2] >> 8 & 0xff) > depth) depth = in->word[4 * r + 2] >> 8 & 0xff;
    return depth < HS_MAX_DEPTH ? depth : HS_MAX_DEPTH;
}

uint64_t rtl_most_cycles(const hs_rtl *rtl, const hs_packet *in, hs_stalls stalls) {
    const uint64_t per_item = 64, records = in->words / 4;
    const uint32_t depth = deepest(in);
    const uint64_t memories = (uint64_t)rtl->capacity.vertices + rtl->capacity.quads;
    const uint64_t most = memories + records;
    uint64_t items = records, sum = records;
    for (uint32_t g = 0; g <= depth; g++) {
        sum += items;
        items = 2 * items < most ? 2 * items : most;
    }
    const uint64_t taken = 100 - (uint64_t)(stalls.input < 95 ? stalls.input : 95);
    const uint64_t given = 100 - (uint64_t)(stalls.output < 95 ? stalls.output : 95);
    return (65536 + 4 * memories + per_item * sum) * 100 / taken * 100 / given;
}

uint64_t rtl_most_silence(const hs_rtl *rtl) {
    return 65536 + 4 * ((uint64_t)rtl->capacity.vertices + rtl->capacity.quads);
}

void rtl_life_look(rtl_life *life, hs_rtl *rtl) {
    if (!rtl_access_ended(&rtl->bus)) return;
    if (life->polling) {
        uint32_t *item = &life->items[life->next / 2][life->next % 2];
        life->changed |= *item != rtl->bus.data;
        *item = rtl->bus.data;
        life->polling = ++life->next < 2 * HS_STAGES;
        if (!life->polling && life->changed) life->moved = rtl->cycle;
    } else if ((rtl->cycle - life->moved) % 4096 == 4095) {
        life->polling = true;
        life->changed = false;
        life->next = 0;
    }
    if (life->polling)
        rtl_access_read(&rtl->bus, rtl_counter_address(life->next / 2, RTL_IN + life->next % 2));
}

rtl_held rtl_life_held(const rtl_life *life) {
    rtl_held held = {""};
    size_t length = 0;
    for (uint32_t s = 0; s < HS_STAGES; s++)
        if (life->items[s][0] != life->items[s][1] && length < sizeof held.text)
            length += (size_t)snprintf(held.text + length, sizeof held.text - length, "%s%s %d",
                                       length ? ", " : "; held: ", hs_stage_name(s),
                                       (int)(life->items[s][0] - life->items[s][1]));
    return held;
}
