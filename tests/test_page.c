/* SPDX-License-Identifier: Apache-2.0
 *
 * Are the numbers of docs/figures.md what the program makes now, are its pictures there, and does
 * the turntable of the README turn? And are pages renewed as sim/page.h says?
 */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#include "definitions.h"
#include "file.h"
#include "folder.h"
#include "page.h"

static const char PAGE[] = "docs/figures.md";

static char *read_file(const char *path, size_t *size) {
    uint8_t *bytes;
    hs_error err = {0};
    if (!hs_file_read(path, 4 << 20, &bytes, size, &err)) fail_msg("%s", err.text);
    return (char *)bytes;
}

/* The page that text becomes, without pictures. */
static char *renewed(const char *name, const char *text) {
    folder f = make_folder();
    hs_error err = {0};
    char *page;
    if (!hs_page_update(&page, name, text, false, inside(&f, "numbers.json"), &err))
        fail_msg("%s", err.text);
    remove_folder(&f);
    return page;
}

/* --- What the project's page says --------------------------------------------------------------
 */

static void its_numbers_are_what_the_program_makes(void **state) {
    (void)state;
    size_t size;
    char *text = read_file(PAGE, &size), *page = renewed(PAGE, text);
    uint32_t numbers = 0;
    for (const char *at = text; (at = strstr(at, "<!--panels.")) != NULL; at++)
        numbers++;
    print_message("%u numbers\n", numbers);
    assert_true(numbers > 30);
    if (strcmp(text, page) != 0) {
        uint32_t line = 1, i = 0;
        for (; text[i] == page[i]; i++)
            line += text[i] == '\n';
        fail_msg("%s:%u is not what the program makes: \"%.20s\" should be \"%.20s\"; `make "
                 "figures` writes it anew",
                 PAGE, line, text + i, page + i);
    }
    free(page);
    free(text);
}

/* Each picture that the page shows lies in docs/figures; together they are small. */
static void its_pictures_are_there_and_small(void **state) {
    (void)state;
    size_t size, all = 0;
    uint32_t pictures = 0;
    char *text = read_file(PAGE, &size);
    for (char *at = text; (at = strstr(at, "](figures/")) != NULL; pictures++) {
        char path[200];
        at += 2;
        snprintf(path, sizeof path, "docs/%.*s", (int)strcspn(at, ")"), at);
        char *bytes = read_file(path, &size);
        assert_memory_equal(bytes, "\x89PNG", 4);
        all += size;
        free(bytes);
    }
    print_message("%u pictures, %zu bytes\n", pictures, all);
    assert_true(pictures >= 11);
    assert_true(all < 1200000);
    free(text);
}

/* --- The turntable -----------------------------------------------------------------------------
 */

/* WebP is RIFF: chunks of four letters and a size; ANMF is a frame. One that repeats its
 * predecessor would be merged with it, or hold the same bytes. */
static void the_turntable_has_120_frames_that_differ(void **state) {
    (void)state;
    size_t size, last = 0, last_size = 0;
    char *file = read_file("docs/pictures/spin.webp", &size);
    uint32_t frames = 0;
    assert_true(size < 2000000);
    assert_memory_equal(file, "RIFF", 4);
    for (size_t at = 12; at + 8 <= size;) {
        const uint8_t *s = (const uint8_t *)file + at + 4;
        const size_t length = s[0] | (size_t)s[1] << 8 | (size_t)s[2] << 16 | (size_t)s[3] << 24;
        assert_true(length <= size - at - 8);
        if (memcmp(file + at, "ANMF", 4) == 0) {
            assert_false(last_size == length && memcmp(file + last, file + at, length) == 0);
            frames++;
            last = at;
            last_size = length;
        }
        at += 8 + length + length % 2;
    }
    assert_int_equal(frames, 120);
    free(file);
}

/* --- Pages in general --------------------------------------------------------------------------
 */

#define CUBE "    build/halfstep render shape:cube:1 --what steps -o never.png\n"

static void numbers_are_renewed_and_all_else_stays(void **state) {
    (void)state;
    char *page = renewed("page.md", "<!-- a note -->\n" CUBE
                                    "from <!--panels.0.faces-->77,777, to <!--panels.1.faces-->,\n"
                                    "<!--panels.4.faces-->1x and <!--panels.2.faces-->24.\n"
                                    "    build/halfstep render shape:hand --json -\n"
                                    "<!--panels.0.generations.0-->1 <!--panels.0.faces-->1");
    assert_string_equal(page, "<!-- a note -->\n" CUBE
                              "from <!--panels.0.faces-->6, to <!--panels.1.faces-->12,\n"
                              "<!--panels.4.faces-->96x and <!--panels.2.faces-->24.\n"
                              "    build/halfstep render shape:hand --json -\n"
                              "<!--panels.0.generations.0-->45 <!--panels.0.faces-->29,652");
    free(page);
    assert_int_equal(access("never.png", F_OK), -1);
}

static void what_is_wrong_is_said_with_page_and_line(void **state) {
    (void)state;
    static const struct {
        const char *text;
        int code;
        const char *says;
    } wrong[] = {
        {"a\n<!--panels.0.faces-->1\n", HS_EXIT_USAGE, "page.md:2: no command"},
        {CUBE "<!--panels.5.faces-->1\n", HS_EXIT_USAGE, "page.md:2: the command above gives no"},
        {CUBE "\n<!--panels-->1\n", HS_EXIT_USAGE, "page.md:3: the command above gives no"},
        {CUBE "    build/halfstep render shape:cub -o x.png\n", HS_EXIT_USAGE, "page.md:2: "},
    };
    folder f = make_folder();
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        hs_error err = {0};
        char *page;
        assert_false(hs_page_update(&page, "page.md", wrong[i].text, false,
                                    inside(&f, "numbers.json"), &err));
        if (!strstr(err.text, wrong[i].says)) fail_msg("said: %s", err.text);
        assert_int_equal(err.code, wrong[i].code);
        assert_null(page);
    }
    remove_folder(&f);
}

int main(void) {
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(its_numbers_are_what_the_program_makes),
        cmocka_unit_test(its_pictures_are_there_and_small),
        cmocka_unit_test(the_turntable_has_120_frames_that_differ),
        cmocka_unit_test(numbers_are_renewed_and_all_else_stays),
        cmocka_unit_test(what_is_wrong_is_said_with_page_and_line),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
