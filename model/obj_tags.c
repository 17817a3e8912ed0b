/* SPDX-License-Identifier: Apache-2.0 */
#define _GNU_SOURCE
#include "obj_tags.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char blanks[] = " \t\v\f";

/* The next word; empty if there is none. */
static char *take_word(char **rest) {
    char *word = *rest + strspn(*rest, blanks);
    char *end = word + strcspn(word, blanks);
    *rest = *end != 0 ? end + 1 : end;
    *end = 0;
    return word;
}

static bool take_vertex(char **rest, uint32_t *vertex) {
    const char *word = take_word(rest);
    char *end;
    if (*word < '0' || *word > '9') return false;
    const unsigned long long number = strtoull(word, &end, 10);
    *vertex = number < UINT32_MAX ? (uint32_t)number : UINT32_MAX;
    return *end == 0;
}

static bool append(hs_obj_tags *tags, hs_sharp_tag tag) {
    if (tags->count == tags->room) {
        const uint32_t room = tags->room ? 2 * tags->room : 64;
        hs_sharp_tag *grown = realloc(tags->tag, room * sizeof *grown);
        if (!grown) return false;
        tags->tag = grown;
        tags->room = room;
    }
    tags->tag[tags->count++] = tag;
    return true;
}

static hs_tag_line wrong(char *why, size_t size, const char *what) {
    snprintf(why, size,
             "%s; a tag is 't crease 2/1/0 V W SHARPNESS' or 't corner 1/1/0 V SHARPNESS'", what);
    return HS_TAGS_WRONG;
}

hs_tag_line hs_obj_tags_read(hs_obj_tags *tags, char *text, uint32_t line, locale_t c_locale,
                             char *why, size_t size) {
    char *rest = text;
    const char *type = take_word(&rest);
    const bool crease = strcmp(type, "crease") == 0;
    if (!crease && strcmp(type, "corner") != 0)
        return *type ? HS_TAGS_OTHER : wrong(why, size, "the tag has no type");
    unsigned vertices, numbers, strings;
    int used = 0;
    const char *counts = take_word(&rest);
    if (sscanf(counts, "%5u/%5u/%5u%n", &vertices, &numbers, &strings, &used) != 3 || counts[used])
        return wrong(why, size, "the tag's counts are not of the form 2/1/0");
    const unsigned named = crease ? vertices - 1 : vertices;
    if (vertices < (crease ? 2u : 1u) || (numbers != 1 && numbers != named))
        return wrong(why, size, "the tag's counts do not fit its type");

    const uint32_t first = tags->count;
    uint32_t before = 0;
    for (unsigned i = 0; i < vertices; i++) {
        uint32_t v;
        if (!take_vertex(&rest, &v)) return wrong(why, size, "a vertex number is missing");
        if ((!crease || i > 0) &&
            !append(tags, (hs_sharp_tag){.v = crease ? before : v, .w = v, .line = line}))
            return HS_TAGS_NO_MEMORY;
        if (crease && i > 0 && before == v) return wrong(why, size, "an edge needs two vertices");
        before = v;
    }
    float sharpness = 0;
    for (unsigned i = 0; i < named; i++) {
        if (i < numbers) {
            char *end;
            const char *word = take_word(&rest);
            sharpness = strtof_l(word, &end, c_locale);
            if (!*word || *end) return wrong(why, size, "a sharpness is missing");
        }
        tags->tag[first + i].sharpness = sharpness;
    }
    if (*take_word(&rest)) return wrong(why, size, "the tag has more words than its counts say");
    return HS_TAGS_READ;
}

static int by_place(const void *a, const void *b) {
    const hs_sharp_tag *p = a, *q = b;
    const uint32_t p_low = p->v < p->w ? p->v : p->w, q_low = q->v < q->w ? q->v : q->w;
    const uint32_t p_high = p->v ^ p->w ^ p_low, q_high = q->v ^ q->w ^ q_low;
    if (p_low != q_low) return p_low < q_low ? -1 : 1;
    if (p_high != q_high) return p_high < q_high ? -1 : 1;
    return 0;
}

static int by_place_and_line(const void *a, const void *b) {
    const int place = by_place(a, b);
    const hs_sharp_tag *p = a, *q = b;
    return place ? place : (p->line > q->line) - (p->line < q->line);
}

bool hs_obj_tags_repeated(const hs_obj_tags *tags, uint32_t *count, uint32_t *line) {
    *count = *line = 0;
    if (tags->count < 2) return true;
    hs_sharp_tag *sorted = malloc(tags->count * sizeof *sorted);
    if (!sorted) return false;
    memcpy(sorted, tags->tag, tags->count * sizeof *sorted);
    qsort(sorted, tags->count, sizeof *sorted, by_place_and_line);
    for (uint32_t i = 1; i < tags->count; i++) {
        if (by_place(&sorted[i - 1], &sorted[i]) != 0) continue;
        if ((*count)++ == 0 || sorted[i].line < *line) *line = sorted[i].line;
    }
    free(sorted);
    return true;
}

void hs_obj_tags_free(hs_obj_tags *tags) {
    free(tags->tag);
    *tags = (hs_obj_tags){0};
}
