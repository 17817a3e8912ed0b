/* SPDX-License-Identifier: Apache-2.0
 *
 * README and docs, as far as they can be checked without running what they say: `make test-docs`
 * runs it. And the check itself, which has to find a fault in a page that has one.
 */
#include "command.h"

static void pages_agree_with_the_project(void **state) {
    (void)state;
    expect_line(0, "tests/docs/check fast", "\n0 faults");
}

static void page(const char *text) {
    write_text("page.md", text);
}

static void faults_of_a_page_are_found(void **state) {
    (void)state;
    static const char *const found[] = {
        "page.md:1: the link to nowhere.md leads nowhere",
        "page.md has no heading for #other",
        "page.md:5: a block of code should say what it is",
        "page.md:8: make has no target no-such",
        "page.md:9: there is no halfstep rnu",
        "page.md:10: there is no halfstep mesh inof",
        "page.md:11: halfstep run  has no option --frnt",
        "page.md:13: halfstep render  has no option --fnrt",
        "page.md:17: halfstep mesh make has no option --front",
        "page.md:19: no command has the option --frtn",
    };
    page("[a](nowhere.md)\n"                                             /* 1 */
         "# Some: `Title`\n"                                             /* 2 */
         "[a](#some-title) [b](page.md) [c](page.md#other)\n"            /* 3 */
         "\n```\nls\n```\n"                                              /* 4 to 7 */
         "`make test`, `make no-such`\n"                                 /* 8 */
         "`halfstep rnu MESH`\n"                                         /* 9 */
         "`halfstep mesh inof MESH`\n"                                   /* 10 */
         "`halfstep run MESH --front 3`, `halfstep run MESH --frnt 3`\n" /* 11 */
         "```sh\nbuild/halfstep render x -o y \\\n    --fnrt 3\n```\n"   /* 12 to 15 */
         "\n    halfstep mesh make X --front 3\n"                        /* 16, 17 */
         "\n`--front 3`, `--frtn 3`\n");                                 /* 18, 19 */
    const outcome *o = run_line("tests/docs/check fast @/page.md");
    assert_int_equal(o->code, 1);
    for (size_t i = 0; i < sizeof found / sizeof *found; i++)
        if (!strstr(o->text, found[i])) fail_msg("no \"%s\" in\n%s", found[i], o->text);
    assert_non_null(strstr(o->text, "\n10 faults"));
}

static void a_page_with_nothing_to_check_is_a_fault(void **state) {
    (void)state;
    page("a");
    const outcome *o = run_line("tests/docs/check fast @/page.md");
    assert_int_equal(o->code, 1);
    assert_non_null(strstr(o->text, "no link was found"));
    assert_non_null(strstr(o->text, "no command was found"));
}

static void a_command_that_fails_is_found(void **state) {
    (void)state;
    page("```sh\ntrue # yes\nmake test\necho a \\\n    b\n```\n");
    expect_line(0, "tests/docs/check run @/page.md",
                "2 commands of 1 pages run, 1 named as not to be run");
    page("```sh\ntrue\ncat no-such-file\ntrue\n```\n");
    expect_line(1, "tests/docs/check run @/page.md", "page.md:3: cat no-such-file ended with 1");
    page("```text\nfalse\n```\n");
    expect_line(1, "tests/docs/check run @/page.md", "no command was found");
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)
    const struct CMUnitTest tests[] = {
        TEST(pages_agree_with_the_project),
        TEST(faults_of_a_page_are_found),
        TEST(a_page_with_nothing_to_check_is_a_fault),
        TEST(a_command_that_fails_is_found),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
