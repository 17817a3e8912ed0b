/* SPDX-License-Identifier: Apache-2.0 */
#include "png_file.h"

#include <errno.h>
#include <png.h>
#include <setjmp.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include "definitions.h"
#include "file.h"

/* libpng reports an error by calling this; it goes back to the caller's setjmp with the reason. */
static void on_error(png_structp png, png_const_charp reason) {
    char *text = png_get_error_ptr(png);
    snprintf(text, 200, "%s", reason);
    longjmp(png_jmpbuf(png), 1);
}

/* Warnings are about metadata; there is nothing for the user to do. */
static void on_warning(png_structp png, png_const_charp reason) {
    (void)png;
    (void)reason;
}

/* --- Writing ---------------------------------------------------------------------------------- */

static bool encode(const hs_picture *picture, FILE *file, char *reason) {
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, reason, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        snprintf(reason, 200, "out of memory");
        png_destroy_write_struct(&png, NULL);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_write_struct(&png, &info);
        return false;
    }
    png_init_io(png, file);
    png_set_IHDR(png, info, picture->width, picture->height, 8, PNG_COLOR_TYPE_RGB,
                 PNG_INTERLACE_NONE, PNG_COMPRESSION_TYPE_DEFAULT, PNG_FILTER_TYPE_DEFAULT);
    png_set_sRGB(png, info, PNG_sRGB_INTENT_PERCEPTUAL);
    png_set_compression_level(png, 6);
    png_write_info(png, info);
    for (uint32_t y = 0; y < picture->height; y++)
        png_write_row(png, &picture->rgb[(size_t)y * picture->width * 3]);
    png_write_end(png, NULL);
    png_destroy_write_struct(&png, &info);
    return true;
}

bool hs_png_write(const hs_picture *picture, const char *path, hs_error *err) {
    hs_file file;
    char reason[200] = "";
    if (!hs_file_create(&file, path, err)) return false;
    errno = 0;
    if (encode(picture, file.stream, reason)) return hs_file_commit(&file, err);
    const int cause = errno;
    const bool unwritten = ferror(file.stream);
    hs_file_abandon(&file);
    if (unwritten) return hs_file_unwritten(path, cause, err);
    return hs_fail(err, HS_EXIT_INTERNAL, "%.300s: cannot be made: %s", path, reason);
}

/* --- Reading ---------------------------------------------------------------------------------- */

typedef struct hs_decoded {
    uint32_t width, height;
    uint8_t *rgba;
    png_bytep *row;
} hs_decoded;

static bool decode(hs_decoded *decoded, FILE *file, char *reason) {
    png_structp png = png_create_read_struct(PNG_LIBPNG_VER_STRING, reason, on_error, on_warning);
    png_infop info = png ? png_create_info_struct(png) : NULL;
    if (!info) {
        snprintf(reason, 200, "out of memory");
        png_destroy_read_struct(&png, NULL, NULL);
        return false;
    }
    if (setjmp(png_jmpbuf(png))) {
        png_destroy_read_struct(&png, &info, NULL);
        return false;
    }
    png_init_io(png, file);
    png_set_user_limits(png, HS_PICTURE_LIMIT, HS_PICTURE_LIMIT);
    png_read_info(png, info);
    png_set_expand(png);
    png_set_scale_16(png);
    png_set_gray_to_rgb(png);
    png_set_add_alpha(png, 255, PNG_FILLER_AFTER);
    png_set_interlace_handling(png);
    png_read_update_info(png, info);
    decoded->width = png_get_image_width(png, info);
    decoded->height = png_get_image_height(png, info);
    decoded->rgba = malloc((size_t)decoded->width * decoded->height * 4);
    decoded->row = malloc(decoded->height * sizeof *decoded->row);
    if (!decoded->rgba || !decoded->row) png_error(png, "out of memory");
    for (uint32_t y = 0; y < decoded->height; y++)
        decoded->row[y] = &decoded->rgba[(size_t)y * decoded->width * 4];
    png_read_image(png, decoded->row);
    png_read_end(png, NULL);
    png_destroy_read_struct(&png, &info, NULL);
    return true;
}

bool hs_png_read(hs_picture *picture, const char *path, hs_error *err) {
    *picture = (hs_picture){0};
    FILE *file = fopen(path, "rb");
    if (!file) return hs_fail(err, HS_EXIT_FILE, "%s: cannot be read (%s)", path, strerror(errno));
    char reason[200] = "";
    hs_decoded decoded = {0};
    bool done = decode(&decoded, file, reason);
    fclose(file);
    if (!done) hs_fail(err, HS_EXIT_FILE, "%s: is no PNG file that can be read (%s)", path, reason);
    done = done && hs_picture_make(picture, decoded.width, decoded.height, 0, err);
    for (size_t i = 0; done && i < (size_t)decoded.width * decoded.height; i++) {
        memcpy(&picture->rgb[3 * i], &decoded.rgba[4 * i], 3);
        picture->coverage[i] = decoded.rgba[4 * i + 3];
    }
    free(decoded.rgba);
    free(decoded.row);
    return done;
}
