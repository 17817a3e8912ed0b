/* SPDX-License-Identifier: Apache-2.0
 *
 * Pictures: do the measures measure what they say, and do files hold what was drawn?
 */
#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cmocka.h>

#include "definitions.h"
#include "folder.h"
#include "picture.h"
#include "png_file.h"
#include "render.h"

static hs_picture make_mask(uint32_t width, uint32_t height, bool (*inside)(double x, double y)) {
    hs_error err = {0};
    hs_picture picture;
    assert_true(hs_picture_make(&picture, width, height, 0xffffff, &err));
    for (uint32_t y = 0; y < height; y++)
        for (uint32_t x = 0; x < width; x++)
            picture.coverage[y * width + x] = inside(x, y) ? 255 : 0;
    return picture;
}

/* --- Do the measures measure? ----------------------------------------------------------------- */

static bool disc(double x, double y) {
    return hypot(x - 100, y - 80) <= 40;
}

static bool disc_5_to_the_right(double x, double y) {
    return disc(x - 5, y);
}

static bool half(double x, double y) {
    (void)y;
    return x < 60;
}

static bool half_3_less(double x, double y) {
    return half(x + 3, y);
}

static bool nothing(double x, double y) {
    (void)x;
    (void)y;
    return false;
}

static void silhouette_distance_is_the_shift_of_a_shifted_shape(void **state) {
    (void)state;
    hs_error err = {0};
    hs_picture_difference d;
    hs_picture a = make_mask(200, 160, disc), b = make_mask(200, 160, disc_5_to_the_right);
    assert_true(hs_picture_compare(&d, &a, &b, &err));
    assert_true(d.maximum == 5);
    /* The mean of |5 cos| around the circle; pixels, being whole, come a little nearer. */
    assert_true(d.mean > 5 * 2 / M_PI - 0.25 && d.mean < 5 * 2 / M_PI);
    assert_true(d.covered_a == d.covered_b && d.covered_either > 0);
    assert_true(d.psnr == INFINITY && d.different == 0);
    assert_true(hs_picture_compare(&d, &a, &a, &err));
    assert_true(d.maximum == 0 && d.mean == 0 && d.covered_either == 0);
    hs_picture_free(&b);

    /* Where only one picture has a silhouette, nothing is near. */
    b = make_mask(200, 160, nothing);
    assert_true(hs_picture_compare(&d, &a, &b, &err));
    assert_true(fabs(d.maximum - hypot(200, 160)) < 1e-9);
    assert_true(fabs(d.mean - d.maximum) < 1e-9);
    assert_true(hs_picture_compare(&d, &b, &b, &err));
    assert_true(d.maximum == 0);
    hs_picture_free(&a);
    hs_picture_free(&b);

    /* The picture's edge is no silhouette: a half plane has one straight line of it. */
    a = make_mask(120, 50, half);
    b = make_mask(120, 50, half_3_less);
    assert_true(hs_picture_compare(&d, &a, &b, &err));
    assert_true(d.mean == 3 && d.maximum == 3 && d.mean_a_to_b == 3 && d.mean_b_to_a == 3);
    assert_int_equal(d.covered_either, 3 * 50);
    hs_picture_free(&a);
    hs_picture_free(&b);
}

static void psnr_and_counts_are_those_of_a_known_difference(void **state) {
    (void)state;
    hs_error err = {0};
    hs_picture a, b, difference;
    hs_picture_difference d;
    assert_true(hs_picture_make(&a, 40, 30, 0x405060, &err));
    assert_true(hs_picture_make(&b, 40, 30, 0x4a5a6a, &err)); /* 10 more in every channel */
    assert_true(hs_picture_compare(&d, &a, &b, &err));
    assert_true(fabs(d.psnr - 20 * log10(255 / 10.0)) < 1e-9);
    assert_true(d.different == 1200 && d.visible == 0 && d.largest == 10 && d.pixels == 1200);

    memcpy(b.rgb, a.rgb, 3600);
    b.rgb[3 * (7 * 40 + 5) + 1] = (uint8_t)(b.rgb[1] + 100);
    b.coverage[7 * 40 + 5] = 255;
    assert_true(hs_picture_compare(&d, &a, &b, &err));
    assert_true(d.different == 1 && d.visible == 1 && d.largest == 100);
    assert_true(fabs(d.psnr - 10 * log10(255.0 * 255 * 3600 / 10000)) < 1e-9);
    assert_true(fabs(d.psnr_covered - 10 * log10(255.0 * 255 * 3 / 10000)) < 1e-9);
    uint32_t x, y;
    assert_false(hs_picture_equal(&a, &b, &x, &y));
    assert_true(x == 5 && y == 7);

    /* The difference picture is grey but for that pixel. */
    assert_true(hs_picture_subtract(&difference, &a, &b, 4, &err));
    for (uint32_t i = 0; i < 1200; i++) {
        const uint8_t *p = &difference.rgb[3 * i];
        assert_int_equal(p[0] != p[2], i == 7 * 40 + 5);
    }
    hs_picture_free(&difference);
    hs_picture_free(&b);

    assert_true(hs_picture_make(&b, 40, 31, 0, &err));
    assert_false(hs_picture_compare(&d, &a, &b, &err));
    assert_int_equal(err.code, HS_EXIT_DIFFERENT);
    assert_false(hs_picture_subtract(&difference, &a, &b, 4, &err));
    assert_false(hs_picture_equal(&a, &b, &x, &y));
    hs_picture_free(&a);
    hs_picture_free(&b);
}

/* --- Files ------------------------------------------------------------------------------------ */

static void png_files_give_back_what_was_written(void **state) {
    (void)state;
    hs_error err = {0};
    folder own = make_folder();
    const char *folder = own.path;
    char path[200];
    snprintf(path, sizeof path, "%s/a.png", folder);
    const uint32_t size[3][2] = {{1, 1}, {7, 3}, {256, 41}};
    for (int i = 0; i < 3; i++) {
        hs_picture a, b;
        assert_true(hs_picture_make(&a, size[i][0], size[i][1], 0, &err));
        for (uint32_t k = 0; k < 3 * a.width * a.height; k++)
            a.rgb[k] = (uint8_t)(k * k * 31 + k);
        memset(a.coverage, 255, (size_t)a.width * a.height);
        assert_true(hs_png_write(&a, path, &err));
        assert_true(hs_png_read(&b, path, &err));
        assert_true(hs_picture_equal(&a, &b, NULL, NULL));
        hs_picture_free(&a);
        hs_picture_free(&b);
    }
    assert_int_equal(count_entries(&own), 1);
    /* Half a file is no picture. */
    assert_int_equal(truncate(path, 60), 0);
    hs_picture none;
    assert_false(hs_png_read(&none, path, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_null(none.rgb);
    remove(path);
    rmdir(folder);
}

static void what_cannot_be_written_leaves_nothing_behind(void **state) {
    (void)state;
    hs_error err = {0};
    hs_picture a;
    folder own = make_folder();
    const char *folder = own.path;
    char path[200];
    assert_true(hs_picture_make(&a, 8, 8, 0x123456, &err));
    snprintf(path, sizeof path, "%s/missing/a.png", folder);
    assert_false(hs_png_write(&a, path, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_non_null(strstr(err.text, path));
    assert_int_equal(count_entries(&own), 0);

    /* A folder stands where the close-up should go: the pictures before it are taken back. */
    hs_view_pictures pictures = {0};
    for (int i = 0; i < HS_VIEW_COUNT; i++)
        assert_true(hs_picture_make(&pictures.picture[i], 8, 8, 0, &err));
    snprintf(path, sizeof path, "%s/%s.png", folder, hs_view_picture_file(HS_VIEW_CLOSEUP));
    assert_int_equal(mkdir(path, 0777), 0);
    err = (hs_error){0};
    assert_false(hs_view_pictures_write(&pictures, folder, "title", &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_int_equal(count_entries(&own), 1);
    rmdir(path);
    assert_true(hs_view_pictures_write(&pictures, folder, "title", &err));
    assert_int_equal(count_entries(&own), HS_VIEW_COUNT + 1);
    for (int i = 0; i <= HS_VIEW_COUNT; i++) {
        const char *file =
            i < HS_VIEW_COUNT ? hs_view_picture_file((enum hs_view_picture)i) : "sheet";
        snprintf(path, sizeof path, "%s/%s.png", folder, file);
        assert_int_equal(remove(path), 0);
    }
    hs_view_pictures_free(&pictures);
    hs_picture_free(&a);
    assert_int_equal(rmdir(folder), 0);
}

static void a_sheet_holds_its_pictures_unchanged(void **state) {
    (void)state;
    hs_error err = {0};
    hs_picture a, b, sheet;
    assert_true(hs_picture_make(&a, 60, 50, 0x102030, &err));
    assert_true(hs_picture_make(&b, 60, 50, 0xa0b0c0, &err));
    const hs_panel panel[3] = {
        {&a, "first"}, {&b, "a caption that is too long for its picture"}, {&a, NULL}};
    assert_true(hs_picture_sheet(&sheet, panel, 3, 2, "title", &err));
    uint32_t count[2] = {0};
    for (size_t i = 0; i < (size_t)sheet.width * sheet.height; i++) {
        count[0] += memcmp(&sheet.rgb[3 * i], a.rgb, 3) == 0;
        count[1] += memcmp(&sheet.rgb[3 * i], b.rgb, 3) == 0;
    }
    assert_true(count[0] == 2 * 3000 && count[1] == 3000);
    hs_picture_free(&sheet);
    assert_false(hs_picture_sheet(&sheet, panel, 0, 2, NULL, &err));
    assert_int_equal(err.code, HS_EXIT_USAGE);
    hs_picture_free(&a);
    hs_picture_free(&b);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(silhouette_distance_is_the_shift_of_a_shifted_shape),
        cmocka_unit_test(psnr_and_counts_are_those_of_a_known_difference),
        cmocka_unit_test(png_files_give_back_what_was_written),
        cmocka_unit_test(what_cannot_be_written_leaves_nothing_behind),
        cmocka_unit_test(a_sheet_holds_its_pictures_unchanged),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
