/* SPDX-License-Identifier: Apache-2.0 */
#include "drop.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "classify.h"
#include "options.h"

bool hs_drop_parse(const char *list, hs_drop *drop, hs_error *err) {
    static const char *const NAME[] = {"offscreen", "back", NULL};
    bool *const flag[] = {&drop->offscreen, &drop->back};
    *drop = (hs_drop){0};
    while (list) {
        char word[20];
        const size_t length = strcspn(list, ",");
        snprintf(word, sizeof word, "%.*s", (int)(length < sizeof word ? length : sizeof word - 1),
                 list);
        int i = 0;
        while (NAME[i] && strcmp(word, NAME[i]) != 0)
            i++;
        if (!NAME[i]) {
            const char *nearest = hs_nearest(word, NAME);
            return hs_fail(err, HS_EXIT_USAGE,
                           "--drop: no faces are called \"%s\"%s%s%s; there are offscreen and back",
                           word, nearest ? "; did you mean \"" : "", nearest ? nearest : "",
                           nearest ? "\"?" : "");
        }
        *flag[i] = true;
        list = list[length] ? list + length + 1 : NULL;
    }
    return true;
}

/* The positions in the pipeline's units. What left as binary32 is a whole number of them. */
static int32_t (*quantized(const hs_output *output))[4] {
    int32_t(*q)[4] = malloc((output->vertices + (size_t)1) * sizeof *q);
    for (size_t i = 0; q && i < 4 * (size_t)output->vertices; i++)
        q[i / 4][i % 4] = (int32_t)llrint(
            ldexp((double)output->position[i], HS_FRACTION_BITS - output->exponent));
    return q;
}

static bool is_offscreen(const hs_output *output, uint32_t f, int32_t (*const q)[4]) {
    uint32_t all = 0x3f;
    for (uint32_t c = output->first[f]; c < output->first[f + 1]; c++)
        all &= outside(q[output->corner[c]]);
    return all != 0;
}

static bool is_back(const hs_output *output, uint32_t f, int32_t (*const q)[4]) {
    const uint32_t *corner = output->corner + output->first[f];
    const uint32_t n = output->first[f + 1] - output->first[f];
    for (uint32_t i = 0; i < n; i++) {
        const int32_t *a = q[corner[i]], *b = q[corner[(i + 1) % n]], *c = q[corner[(i + 2) % n]];
        if (facing(a, hs_cross_of(b, c)) == MARK_FRONT) return false;
    }
    return true;
}

static void take_face(hs_output *output, uint32_t to, uint32_t from) {
    const uint32_t begin = output->first[from], n = output->first[from + 1] - begin;
    memmove(output->corner + output->first[to], output->corner + begin, n * sizeof *output->corner);
    output->first[to + 1] = output->first[to] + n;
    output->generation[to] = output->generation[from];
    output->candidate[to] = output->candidate[from];
    output->triangles += n == 3;
}

/* Vertices that a face uses move up; place becomes where each is. */
static void take_vertices(hs_output *output, uint32_t *place) {
    enum { UNUSED = 0, USED = 1 };
    memset(place, 0, output->vertices * sizeof *place);
    for (uint32_t c = 0; c < output->corners; c++)
        place[output->corner[c]] = USED;
    uint32_t count = 0;
    for (uint32_t v = 0; v < output->vertices; v++) {
        if (place[v] == UNUSED) continue;
        memmove(output->position + 4 * (size_t)count, output->position + 4 * (size_t)v,
                4 * sizeof *output->position);
        output->number[count] = output->number[v];
        place[v] = count++;
    }
    for (uint32_t c = 0; c < output->corners; c++)
        output->corner[c] = place[output->corner[c]];
    output->vertices = count;
}

bool hs_output_drop(hs_output *output, const hs_drop *drop, hs_dropped *dropped, hs_error *err) {
    *dropped = (hs_dropped){.faces = output->faces};
    if ((!drop->offscreen && !drop->back) || output->faces == 0) return true;
    int32_t(*q)[4] = quantized(output);
    uint32_t *place = malloc((output->vertices + (size_t)1) * sizeof *place);
    if (!q || !place) {
        free(q);
        free(place);
        return hs_fail(err, HS_EXIT_INTERNAL, "no memory to drop faces of %u", output->faces);
    }
    uint32_t kept = 0;
    output->triangles = 0;
    for (uint32_t f = 0; f < output->faces; f++) {
        if (drop->offscreen && is_offscreen(output, f, q))
            dropped->offscreen++;
        else if (drop->back && is_back(output, f, q))
            dropped->back++;
        else
            take_face(output, kept++, f);
    }
    output->faces = kept;
    output->corners = output->first[kept];
    dropped->vertices = output->vertices;
    take_vertices(output, place);
    dropped->vertices -= output->vertices;
    free(q);
    free(place);
    return true;
}
