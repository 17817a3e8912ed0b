/* SPDX-License-Identifier: Apache-2.0
 *
 * A view's timeline as a picture: a row a stage, cycles from left to right.
 *
 *   generations   | 0 | 1 |  2   |   3    | ...
 *   receive       ##
 *   ...
 *   classify        ##   ##   ####        height: share of a bucket's cycles; busy from below,
 *   ...                                   blocked on top of it; what is left of the frame: starved
 *   FIFO           _-_    _/\_            height: its fill
 *                 0     1000     2000 cycles
 */
#include <inttypes.h>
#include <string.h>

#include "timeline.h"

enum { WIDTH = 1000, LEFT = 84, RIGHT = 12, TOP = 58, ROW = 30, BAR = 24, ROWS = HS_STAGES + 1 };
enum { BOTTOM = TOP + ROW * ROWS, HEIGHT = BOTTOM + 44 };
enum { TENTHS = 10 }; /* coordinates are computed in tenths of a unit */

static const char STYLE[] =
    "<style>.hs-timeline path{pointer-events:none}"
    ".hs-timeline{font:11px sans-serif;color:#222;background:#fff}"
    ".hs-timeline text{fill:currentColor}.hs-timeline .e{text-anchor:end}"
    ".hs-timeline .m{text-anchor:middle}.hs-timeline .t{font-size:13px;font-weight:bold}"
    ".hs-timeline .f{fill:currentColor;fill-opacity:.09}"
    ".hs-timeline .g{stroke:currentColor;stroke-opacity:.35;stroke-width:.6}"
    ".hs-timeline .a0{fill:#2a7fba}.hs-timeline .a2{fill:#d9662b}.hs-timeline .q{fill:#7d6bb0}"
    "@media(prefers-color-scheme:dark){.hs-timeline{color:#ddd;background:#181818}"
    ".hs-timeline .a0{fill:#4a9fd8}.hs-timeline .a2{fill:#ec8450}.hs-timeline .q{fill:#a596d6}}"
    "</style>\n";

/* --- Coordinates --------------------------------------------------------------------------------
 */

static uint64_t span_of(const hs_timeline *t) {
    return t->end ? t->end : 1;
}

static uint32_t x_of(const hs_timeline *t, uint64_t cycle) {
    const uint64_t end = span_of(t), within = cycle < end ? cycle : end;
    return LEFT * TENTHS + (uint32_t)(within * (WIDTH - LEFT - RIGHT) * TENTHS / end);
}

static void print_tenths(FILE *file, uint32_t tenths) {
    if (tenths % TENTHS)
        fprintf(file, "%u.%u", tenths / TENTHS, tenths % TENTHS);
    else
        fprintf(file, "%u", tenths / TENTHS);
}

static void print_text(FILE *file, const char *text) {
    for (; *text; text++) {
        const unsigned char c = (unsigned char)*text;
        if (c == '<')
            fputs("&lt;", file);
        else if (c == '>')
            fputs("&gt;", file);
        else if (c == '&')
            fputs("&amp;", file);
        else
            fputc(c < 0x20 || c > 0x7e ? '?' : c, file);
    }
}

/* --- Areas --------------------------------------------------------------------------------------
 *
 * One path for all buckets: from the base up to each value and down again. Values are tenths of a
 * unit; below: what they stand on.
 */
typedef struct area {
    uint32_t base; /* y */
    uint32_t value[HS_TIMELINE_BUCKETS], below[HS_TIMELINE_BUCKETS];
} area;

static void draw_area(FILE *file, const hs_timeline *t, const area *a, const char *class) {
    bool open = false;
    for (uint32_t b = 0; b < t->buckets;) {
        uint32_t end = b + 1;
        while (end < t->buckets && a->value[end] == a->value[b] && a->below[end] == a->below[b])
            end++;
        if (a->value[b]) {
            const uint32_t left = x_of(t, b * t->bucket), right = x_of(t, end * t->bucket);
            const uint32_t bottom = a->base - a->below[b], top = bottom - a->value[b];
            if (!open) fprintf(file, "<path class=\"%s\" d=\"", class);
            open = true;
            fputc('M', file);
            print_tenths(file, left);
            fputc(' ', file);
            print_tenths(file, bottom);
            fputc('V', file);
            print_tenths(file, top);
            fputc('H', file);
            print_tenths(file, right);
            fputc('V', file);
            print_tenths(file, bottom);
            fputc('z', file);
        }
        b = end;
    }
    if (open) fputs("\"/>\n", file);
}

static uint32_t row_base(uint32_t row) {
    return (TOP + ROW * row + (ROW + BAR) / 2) * TENTHS;
}

static void draw_stage(FILE *file, const hs_timeline *t, uint32_t stage) {
    area a = {.base = row_base(stage)};
    for (uint32_t k = HS_ACTIVITY_busy; k <= HS_ACTIVITY_blocked; k++) {
        if (k == HS_ACTIVITY_starved) continue;
        for (uint32_t b = 0; b < t->buckets; b++) {
            const uint64_t left = span_of(t) - b * t->bucket;
            const uint64_t cycles = left < t->bucket ? left : t->bucket;
            a.value[b] =
                cycles ? (uint32_t)((uint64_t)t->activity[stage][k][b] * BAR * TENTHS / cycles) : 0;
            if (a.value[b] + a.below[b] > BAR * TENTHS) a.value[b] = BAR * TENTHS - a.below[b];
        }
        draw_area(file, t, &a, k == HS_ACTIVITY_busy ? "a0" : "a2");
        memcpy(a.below, a.value, sizeof a.below);
    }
}

static void draw_queue(FILE *file, const hs_timeline *t) {
    const uint32_t most = t->most[HS_FILL_ops];
    area a = {.base = row_base(HS_STAGES)};
    for (uint32_t b = 0; most && b < t->buckets; b++)
        a.value[b] = (uint32_t)((uint64_t)t->fill[HS_FILL_ops][b] * BAR * TENTHS / most);
    draw_area(file, t, &a, "q");
}

/* --- Frames and words ---------------------------------------------------------------------------
 */

static void draw_run(FILE *file, const hs_timeline *t, const hs_timeline_run *r) {
    const uint32_t left = x_of(t, r->begin), right = x_of(t, r->end);
    fputs("<rect class=\"f\" x=\"", file);
    print_tenths(file, left);
    fputs("\" y=\"", file);
    print_tenths(file, row_base(r->stage) - BAR * TENTHS);
    fputs("\" width=\"", file);
    print_tenths(file, right > left ? right - left : 1);
    fprintf(file, "\" height=\"%d\"><title>%s", BAR, hs_stage_name(r->stage));
    if (r->stage >= HS_STAGE_classify) fprintf(file, ", generation %u", r->generation);
    fprintf(file,
            ": cycles %" PRIu64 " to %" PRIu64 "; busy %" PRIu64 ", blocked %" PRIu64
            ", starved %" PRIu64 "</title></rect>\n",
            r->begin, r->end, r->activity[HS_ACTIVITY_busy], r->activity[HS_ACTIVITY_blocked],
            r->activity[HS_ACTIVITY_starved]);
}

static void draw_line(FILE *file, const hs_timeline *t, uint64_t cycle, uint32_t top,
                      uint32_t bottom) {
    fputs("<path class=\"g\" d=\"M", file);
    print_tenths(file, x_of(t, cycle));
    fprintf(file, " %uV%u\"/>\n", top, bottom);
}

static void draw_word(FILE *file, uint32_t x, uint32_t y, const char *class, const char *text) {
    fputs("<text x=\"", file);
    print_tenths(file, x);
    fprintf(file, "\" y=\"%u\" class=\"%s\">", y, class);
    print_text(file, text);
    fputs("</text>\n", file);
}

static void draw_generations(FILE *file, const hs_timeline *t) {
    uint32_t free_from = 0;
    draw_word(file, (LEFT - 8) * TENTHS, TOP - 6, "e", "generation");
    for (uint32_t g = 0; g < t->generations; g++) {
        char text[20];
        const uint32_t x = x_of(t, t->generation[g].begin), end = x_of(t, t->generation[g].end);
        draw_line(file, t, t->generation[g].begin, TOP - 16, BOTTOM);
        snprintf(text, sizeof text, "%u", t->generation[g].number);
        const uint32_t middle = x / 2 + end / 2, half = (uint32_t)(4 * strlen(text)) * TENTHS;
        if (middle < free_from + half) continue; /* no room for its number */
        draw_word(file, middle, TOP - 6, "m", text);
        free_from = middle + half;
    }
    if (t->generations) draw_line(file, t, t->generation[t->generations - 1].end, TOP - 16, BOTTOM);
}

/* A round number of cycles that makes 4 to 10 steps. */
static uint64_t step_of(uint64_t cycles) {
    uint64_t step = 1;
    for (;;) {
        if (cycles / step <= 10) return step;
        if (cycles / (2 * step) <= 10) return 2 * step;
        if (cycles / (5 * step) <= 10) return 5 * step;
        step *= 10;
    }
}

static void draw_axis(FILE *file, const hs_timeline *t) {
    const uint64_t step = step_of(span_of(t));
    for (uint64_t at = 0; at <= span_of(t); at += step) {
        char text[32];
        draw_line(file, t, at, BOTTOM, BOTTOM + 5);
        snprintf(text, sizeof text, "%" PRIu64, at);
        draw_word(file, x_of(t, at), BOTTOM + 17, "m", text);
    }
    fprintf(file, "<path class=\"g\" d=\"M%d %dH%d\"/>\n", LEFT, BOTTOM, WIDTH - RIGHT);
}

static void draw_legend(FILE *file, const hs_timeline *t) {
    static const struct {
        const char *class, *what;
        int x;
    } entry[] = {{"a0", "busy", 84},
                 {"a2", "blocked: had an item, could not take it", 136},
                 {"f", "at work, but starved", 370}};
    const int y = BOTTOM + 28;
    for (int i = 0; i < 3; i++) {
        fprintf(file, "<rect class=\"%s\" x=\"%d\" y=\"%d\" width=\"10\" height=\"10\"/>\n",
                entry[i].class, entry[i].x, y);
        draw_word(file, (uint32_t)(entry[i].x + 14) * TENTHS, (uint32_t)y + 9, "", entry[i].what);
    }
    char text[100];
    snprintf(text, sizeof text, "FIFO before emit: %u at most; a bucket is %" PRIu64 " cycle%s",
             t->most[HS_FILL_ops], t->bucket, t->bucket == 1 ? "" : "s");
    fprintf(file, "<rect class=\"q\" x=\"510\" y=\"%d\" width=\"10\" height=\"10\"/>\n", y);
    draw_word(file, 524 * TENTHS, (uint32_t)y + 9, "", text);
    draw_word(file, (WIDTH - RIGHT) * TENTHS, (uint32_t)y + 9, "e", "cycles");
}

void hs_timeline_svg(FILE *file, const hs_timeline *t, const char *title) {
    fprintf(file,
            "<svg xmlns=\"http://www.w3.org/2000/svg\" class=\"hs-timeline\" viewBox=\"0 0 %d %d\" "
            "role=\"img\">\n%s<title>",
            WIDTH, HEIGHT, STYLE);
    print_text(file, title);
    fputs("</title>\n", file);
    draw_word(file, LEFT * TENTHS, 20, "t", title);
    for (uint32_t r = 0; r < t->runs; r++)
        draw_run(file, t, &t->run[r]);
    for (uint32_t s = 0; s < HS_STAGES; s++) {
        draw_word(file, (LEFT - 8) * TENTHS, row_base(s) / TENTHS - 8, "e", hs_stage_name(s));
        draw_stage(file, t, s);
    }
    draw_word(file, (LEFT - 8) * TENTHS, row_base(HS_STAGES) / TENTHS - 8, "e", "FIFO");
    draw_queue(file, t);
    draw_generations(file, t);
    draw_axis(file, t);
    draw_legend(file, t);
    fputs("</svg>\n", file);
}
