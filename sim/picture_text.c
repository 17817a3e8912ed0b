/* SPDX-License-Identifier: Apache-2.0
 *
 * Text on pictures, and sheets of pictures with captions. A letter is a few pen strokes on a small
 * grid; round strokes are control polygons with their corners cut (G. Chaikin's algorithm, the
 * subdivision curve), so text is sharp at every size and needs no font file.
 */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "definitions.h"
#include "picture.h"

/* Grid: x from 0 to 4 or less, y from 0 to 9: 0 descender, 2 baseline, 6 x-height, 8 capitals. A
 * stroke is a row of points, two digits each; '~' before it rounds its corners, 'o' rounds and
 * closes it. */
typedef struct hs_glyph {
    char letter;
    uint8_t width;
    const char *strokes;
} hs_glyph;

static const hs_glyph glyphs[] = {
    {'A', 4, "022842 1434"},
    {'B', 4, "0208 ~08383505 ~05454202"},
    {'C', 4, "~4738180703123243"},
    {'D', 4, "0208 ~082847432202"},
    {'E', 4, "48080242 0535"},
    {'F', 4, "480802 0535"},
    {'G', 4, "~473818070312324345 4525"},
    {'H', 4, "0208 4248 0545"},
    {'I', 0, "0208"},
    {'J', 3, "~3833221203"},
    {'K', 4, "0208 4804 1542"},
    {'L', 3, "080232"},
    {'M', 4, "0208244842"},
    {'N', 4, "02084248"},
    {'O', 4, "o1838474332120307"},
    {'P', 4, "0208 ~08484505"},
    {'Q', 4, "o1838474332120307 2442"},
    {'R', 4, "0208 ~08484505 2542"},
    {'S', 4, "~473818070615354443321203"},
    {'T', 4, "0848 2822"},
    {'U', 4, "~080312324348"},
    {'V', 4, "082248"},
    {'W', 4, "0812263248"},
    {'X', 4, "0248 0842"},
    {'Y', 4, "082548 2522"},
    {'Z', 4, "08480242"},
    {'a', 3, "o2616050312223335 3632"},
    {'b', 3, "0802 o2616050312223335"},
    {'c', 3, "~3526160503122233"},
    {'d', 3, "3832 o2616050312223335"},
    {'e', 3, "0434 ~343526160503122233"},
    {'f', 2, "~28181612 0626"},
    {'g', 3, "o2616050312223335 ~3631201001"},
    {'h', 3, "0802 ~0416263532"},
    {'i', 0, "0602 0808"},
    {'j', 1, "~161100 1818"},
    {'k', 3, "0802 3603 1432"},
    {'l', 0, "0802"},
    {'m', 4, "0602 ~04162522 ~24364542"},
    {'n', 3, "0602 ~0416263532"},
    {'o', 3, "o2616050312223335"},
    {'p', 3, "0600 o2616050312223335"},
    {'q', 3, "3630 o2616050312223335"},
    {'r', 2, "0602 ~041626"},
    {'s', 3, "~35261605142433221203"},
    {'t', 2, "~08031222 0626"},
    {'u', 3, "~0603122234 3632"},
    {'v', 4, "062246"},
    {'w', 4, "0612263246"},
    {'x', 3, "0236 0632"},
    {'y', 4, "0622 4610"},
    {'z', 3, "06360232"},
    {'0', 3, "o1828373322120307"},
    {'1', 2, "071812"},
    {'2', 3, "~071828373602 0232"},
    {'3', 3, "~07182837362515 ~15253433221203"},
    {'4', 3, "2228 280434"},
    {'5', 3, "380805 ~05263533221203"},
    {'6', 3, "~38170603 o1525343322120304"},
    {'7', 3, "083812"},
    {'8', 3, "o1828373625150607 o1525343322120304"},
    {'9', 3, "~02233437 o2515060718283736"},
    {'.', 0, "0202"},
    {',', 0, "0201"},
    {':', 0, "0202 0505"},
    {';', 0, "0201 0505"},
    {'!', 0, "0804 0202"},
    {'?', 3, "~07182837361514 1212"},
    {'-', 2, "0525"},
    {'+', 4, "0545 2723"},
    {'=', 3, "0636 0434"},
    {'/', 3, "0139"},
    {'(', 1, "~19070311"},
    {')', 1, "~09171301"},
    {'[', 1, "19090111"},
    {']', 1, "09191101"},
    {'<', 3, "370533"},
    {'>', 3, "073503"},
    {'_', 4, "0141"},
    {'|', 0, "0109"},
    {'%', 4, "0248 o08181707 o33433242"},
    {'#', 4, "1218 3238 0444 0646"},
    {'*', 4, "2824 0735 0537"},
    {'\'', 0, "0807"},
    {'"', 1, "0807 1817"},
};

static const hs_glyph *find_glyph(char letter) {
    const hs_glyph *unknown = NULL;
    for (size_t i = 0; i < sizeof glyphs / sizeof glyphs[0]; i++) {
        if (glyphs[i].letter == letter) return &glyphs[i];
        if (glyphs[i].letter == '?') unknown = &glyphs[i];
    }
    return unknown;
}

/* Grid units: capitals are 6 high. */
#define CAPITAL    6.0
#define LETTER_GAP 1.7
#define SPACE      3.0
#define BASELINE   2.0

static double advance(char letter) {
    return letter == ' ' ? SPACE : find_glyph(letter)->width + LETTER_GAP;
}

double hs_picture_text_width(double size, const char *text) {
    double width = 0;
    for (const char *c = text; *c; c++)
        width += advance(*c);
    return width > 0 ? (width - LETTER_GAP) * size / CAPITAL : 0;
}

/* --- Strokes ---------------------------------------------------------------------------------- */

#define STROKE_POINTS 256

typedef struct hs_stroke {
    uint32_t points;
    double x[STROKE_POINTS], y[STROKE_POINTS];
} hs_stroke;

/* One round of corner cutting. An open stroke keeps its ends. */
static void cut_corners(hs_stroke *stroke, bool closed) {
    hs_stroke cut = {0};
    uint32_t n = stroke->points, edges = closed ? n : n - 1;
    for (uint32_t i = 0; i < edges; i++) {
        uint32_t j = (i + 1) % n;
        for (uint32_t k = 0; k < 2; k++) {
            double t = k ? 0.75 : 0.25;
            if (!closed && i == 0 && k == 0) t = 0;
            if (!closed && i == edges - 1 && k == 1) t = 1;
            cut.x[cut.points] = stroke->x[i] + t * (stroke->x[j] - stroke->x[i]);
            cut.y[cut.points++] = stroke->y[i] + t * (stroke->y[j] - stroke->y[i]);
        }
    }
    *stroke = cut;
}

/* Reads one stroke and returns what follows it. */
static const char *read_stroke(hs_stroke *stroke, const char *text) {
    char kind = *text == '~' || *text == 'o' ? *text++ : '-';
    stroke->points = 0;
    for (; *text && *text != ' '; text += 2) {
        stroke->x[stroke->points] = text[0] - '0';
        stroke->y[stroke->points++] = text[1] - '0';
    }
    for (int round = 0; kind != '-' && round < 3; round++)
        cut_corners(stroke, kind == 'o');
    if (kind == 'o') {
        stroke->x[stroke->points] = stroke->x[0];
        stroke->y[stroke->points++] = stroke->y[0];
    }
    return *text ? text + 1 : text;
}

static double distance_to_stroke(const hs_stroke *stroke, double x, double y) {
    double least = INFINITY;
    for (uint32_t i = 0; i + 1 < stroke->points; i++) {
        double dx = stroke->x[i + 1] - stroke->x[i], dy = stroke->y[i + 1] - stroke->y[i];
        double length = dx * dx + dy * dy;
        double t = length > 0 ? ((x - stroke->x[i]) * dx + (y - stroke->y[i]) * dy) / length : 0;
        t = fmin(fmax(t, 0), 1);
        least = fmin(least, hypot(x - stroke->x[i] - t * dx, y - stroke->y[i] - t * dy));
    }
    return least;
}

static void blend(hs_picture *picture, int64_t x, int64_t y, uint32_t color, double opacity) {
    if (x < 0 || y < 0 || x >= picture->width || y >= picture->height || opacity <= 0) return;
    uint8_t *p = &picture->rgb[((size_t)y * picture->width + (size_t)x) * 3];
    for (int c = 0; c < 3; c++) {
        double ink = color >> (16 - 8 * c) & 0xff;
        p[c] = (uint8_t)lround(p[c] + (ink - p[c]) * fmin(opacity, 1));
    }
}

static void draw_glyph(hs_picture *picture, const hs_glyph *glyph, double left, double baseline,
                       double unit, uint32_t color) {
    hs_stroke stroke[4];
    uint32_t strokes = 0;
    for (const char *text = glyph->strokes; *text && strokes < 4;)
        text = read_stroke(&stroke[strokes++], text);
    double radius = fmax(0.40 * unit, 0.5);
    int64_t x0 = (int64_t)floor(left - radius - 1);
    int64_t x1 = (int64_t)ceil(left + glyph->width * unit + radius + 1);
    int64_t y0 = (int64_t)floor(baseline - 7.5 * unit - radius - 1);
    int64_t y1 = (int64_t)ceil(baseline + 2.5 * unit + radius + 1);
    for (int64_t y = y0; y <= y1; y++)
        for (int64_t x = x0; x <= x1; x++) {
            double gx = ((double)x + 0.5 - left) / unit;
            double gy = (baseline - (double)y - 0.5) / unit + BASELINE, nearest = INFINITY;
            for (uint32_t s = 0; s < strokes; s++)
                nearest = fmin(nearest, distance_to_stroke(&stroke[s], gx, gy));
            blend(picture, x, y, color, radius - nearest * unit + 0.5);
        }
}

void hs_picture_write(hs_picture *picture, double x, double y, double size, uint32_t color,
                      const char *text) {
    double unit = size / CAPITAL;
    for (const char *c = text; *c; c++) {
        if (*c != ' ') draw_glyph(picture, find_glyph(*c), x, y, unit, color);
        x += advance(*c) * unit;
    }
}

void hs_picture_fill(hs_picture *picture, double left, double top, double right, double bottom,
                     uint32_t color) {
    for (int64_t y = (int64_t)floor(fmax(top, 0)); (double)y < bottom && y < picture->height; y++)
        for (int64_t x = (int64_t)floor(fmax(left, 0)); (double)x < right && x < picture->width;
             x++) {
            double across = fmin(right, (double)x + 1) - fmax(left, (double)x);
            double down = fmin(bottom, (double)y + 1) - fmax(top, (double)y);
            blend(picture, x, y, color, across * down);
        }
}

void hs_picture_disc(hs_picture *picture, double x, double y, double radius, uint32_t color) {
    const int64_t left = (int64_t)floor(fmax(x - radius - 1, 0));
    for (int64_t j = (int64_t)floor(fmax(y - radius - 1, 0));
         (double)j <= y + radius && j < picture->height; j++)
        for (int64_t i = left; (double)i <= x + radius && i < picture->width; i++)
            blend(picture, i, j, color,
                  radius - hypot((double)i + 0.5 - x, (double)j + 0.5 - y) + 0.5);
}

char *hs_count_text(char text[HS_COUNT_TEXT], uint64_t count) {
    char digits[HS_COUNT_TEXT];
    const int length = snprintf(digits, sizeof digits, "%llu", (unsigned long long)count);
    char *to = text;
    for (int i = 0; i < length; i++) {
        if (i > 0 && (length - i) % 3 == 0) *to++ = ',';
        *to++ = digits[i];
    }
    *to = 0;
    return text;
}

/* --- Sheets ----------------------------------------------------------------------------------- */

void hs_picture_paste(hs_picture *picture, const hs_picture *part, uint32_t left, uint32_t top) {
    const uint32_t right = left < picture->width ? picture->width - left : 0;
    const uint32_t width = part->width < right ? part->width : right;
    for (uint32_t y = 0; y < part->height && top + y < picture->height; y++) {
        size_t to = (size_t)(top + y) * picture->width + left, from = (size_t)y * part->width;
        memcpy(&picture->rgb[3 * to], &part->rgb[3 * from], (size_t)width * 3);
        memcpy(&picture->coverage[to], &part->coverage[from], width);
    }
}

/* Writes text centred; what is too wide ends in "...". */
static void write_centred(hs_picture *sheet, double centre, double baseline, double size,
                          double room, uint32_t color, const char *text) {
    char line[256] = "";
    strncat(line, text, sizeof line - 1);
    for (size_t length = strlen(line); length > 3 && hs_picture_text_width(size, line) > room;) {
        length--;
        strcpy(&line[length - 3], "...");
    }
    hs_picture_write(sheet, centre - hs_picture_text_width(size, line) / 2, baseline, size, color,
                     line);
}

bool hs_picture_sheet(hs_picture *sheet, const hs_panel *panel, uint32_t panels, uint32_t columns,
                      const char *title, hs_error *err) {
    const uint32_t paper = 0xffffff, ink = 0x20242c;
    *sheet = (hs_picture){0};
    uint32_t width = 0, height = 0;
    bool captions = false;
    for (uint32_t i = 0; i < panels; i++) {
        if (panel[i].picture->width > width) width = panel[i].picture->width;
        if (panel[i].picture->height > height) height = panel[i].picture->height;
        captions = captions || (panel[i].caption && panel[i].caption[0]);
    }
    if (panels == 0 || columns == 0 || width == 0)
        return hs_fail(err, HS_EXIT_USAGE, "a sheet needs a picture and a column at least");
    if (columns > panels) columns = panels;
    uint32_t rows = (panels + columns - 1) / columns;
    uint32_t size = width / 45 > 9 ? width / 45 : 9;
    uint32_t gap = size, strip = captions ? 3 * size : 0;
    uint32_t head = title && title[0] ? 3 * size + size / 2 : 0;
    uint64_t all_wide = gap + (uint64_t)columns * (width + gap);
    uint64_t all_high = gap + head + (uint64_t)rows * (height + strip) + (uint64_t)(rows - 1) * gap;
    if (!captions) all_high += gap;
    if (all_wide > HS_PICTURE_LIMIT || all_high > HS_PICTURE_LIMIT)
        return hs_fail(err, HS_EXIT_USAGE,
                       "a sheet of %u columns and %u rows of %ux%u pixels is too large; ask for "
                       "smaller pictures",
                       columns, rows, width, height);
    if (!hs_picture_make(sheet, (uint32_t)all_wide, (uint32_t)all_high, paper, err)) return false;

    if (head)
        write_centred(sheet, (double)all_wide / 2, gap + 1.7 * size, 1.35 * size,
                      (double)all_wide - 2.0 * gap, ink, title);
    for (uint32_t i = 0; i < panels; i++) {
        uint32_t left = gap + i % columns * (width + gap);
        uint32_t top = gap + head + i / columns * (height + strip + gap);
        hs_picture_paste(sheet, panel[i].picture, left + (width - panel[i].picture->width) / 2,
                         top + (height - panel[i].picture->height) / 2);
        if (panel[i].caption)
            write_centred(sheet, left + width / 2.0, top + height + 1.9 * size, size, width, ink,
                          panel[i].caption);
    }
    return true;
}
