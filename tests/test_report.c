/* SPDX-License-Identifier: Apache-2.0
 *
 * The data of halfstep report's page: is what the run said in it, as it was, and harmless; and what
 * is said of folders that lack something, or are broken?
 */
#include "report_scene.h"

#include "png_file.h"
#include "report_folder.h"
#include "report_html.h"
#include "report_pack.h"

static char *read_text(const char *name) {
    uint8_t *bytes = NULL;
    size_t size;
    hs_error err = {0};
    if (!hs_file_read(inside(&place, name), 1 << 26, &bytes, &size, &err)) {
        fail_msg("%s", err.text);
        return NULL;
    }
    return (char *)bytes;
}

/* --- A run's folder, made by hand ---------------------------------------------------------------
 */

static const char RUN[] =
    "{\"mesh\": {\"source\": \"</script><script>alert('1 < 2')</script><!-- & \\\"\", \"faces\": "
    "6},\n"
    " \"settings\": {\"front\": 4, \"size\": [64, 48]}, \"seconds\": 0.1, \"equal\": true,\n"
    " \"views\": [{\"view\": 0, \"bound\": 18446744073709, \"matrix\": [0.333333343, -1e-38],\n"
    "   \"engines\": {\"rtl\": {\"faces\": 123, \"cycles\": 4567, \"stages\": {}}},\n"
    "   \"comparisons\": [{\"a\": \"golden\", \"b\": \"rtl\", \"what\": \"words\", \"compared\": "
    "9, "
    "\"different\": 0}]}]}\n";

static void make_pictures(void) {
    hs_error err = {0};
    hs_picture picture = {0};
    assert_true(hs_picture_make(&picture, 8, 8, 0x336699, &err));
    for (int i = 0; hs_report_picture[i]; i++) {
        char name[100];
        snprintf(name, sizeof name, "view-000/%s.png", hs_report_picture[i]);
        assert_true(hs_png_write(&picture, inside(&place, name), &err));
    }
    hs_picture_free(&picture);
}

static hs_report_request request(void) {
    return (hs_report_request){.folder = place.path, .faces = 50000, .views = 16};
}

static json_t *read_folder(const hs_report_request *r) {
    hs_error err = {0};
    json_t *data = hs_report_folder(r, &err);
    if (!data) fail_msg("%s", err.text);
    return data;
}

static void refuse(const hs_report_request *r, int code, const char *text) {
    hs_error err = {0};
    assert_null(hs_report_folder(r, &err));
    if (err.code != code || !strstr(err.text, text))
        fail_msg("code %d, without \"%s\": %s", err.code, text, err.text);
}

static bool has_note(const json_t *data, const char *text) {
    const json_t *note;
    size_t i;
    json_array_foreach(json_object_get(data, "notes"), i,
                       note) if (strstr(json_string_value(note), text)) return true;
    return false;
}

/* --- The page -----------------------------------------------------------------------------------
 */

static const char TEMPLATE[] =
    "<title>" HS_REPORT_TITLE "</title><script id=\"data\">" HS_REPORT_DATA "</script>end\n";

/* What stands between the script tags. */
static json_t *data_of_page(const char *page) {
    const char *begin = strstr(page, "<script id=\"data\">");
    assert_non_null(begin);
    begin += strlen("<script id=\"data\">");
    const char *end = strchr(begin, '<');
    assert_string_equal(end, "</script>end\n"); /* so no other tag begins in the data */
    json_error_t why;
    json_t *data = json_loadb(begin, (size_t)(end - begin), 0, &why);
    if (!data) fail_msg("%s", why.text);
    return data;
}

static void
the_page_holds_every_figure_of_the_run_and_nothing_that_a_parser_would_run(void **state) {
    (void)state;
    hs_error err = {0};
    write_text("run.json", RUN);
    write_text("t.html", TEMPLATE);
    scene s = make_scene("cube", 0, adaptive, false);
    make_pictures();
    const hs_report_request r = request();
    json_t *data = read_folder(&r);
    assert_int_equal(json_array_size(json_object_get(data, "notes")), 0);
    char page_name[400];
    snprintf(page_name, sizeof page_name, "%s", inside(&place, "page.html"));
    assert_true(hs_report_html(page_name, inside(&place, "t.html"), "<b> & \"'", data, &err));
    char *page = read_text("page.html");
    assert_non_null(strstr(page, "<title>&lt;b&gt; &amp; &quot;&#39;</title>"));
    json_t *read = data_of_page(page), *run = json_loads(RUN, 0, NULL);
    assert_true(json_equal(read, data));
    assert_true(json_equal(json_object_get(read, "run"), run));
    const json_t *pictures = json_object_get(json_object_get(read, "pictures"), "0");
    for (int i = 0; hs_report_picture[i]; i++) {
        const char *image = json_string_value(json_object_get(pictures, hs_report_picture[i]));
        assert_non_null(image);
        assert_ptr_equal(strstr(image, "data:image/png;base64,iVBORw0KGgo"), image);
    }
    assert_true(json_is_object(json_object_get(json_object_get(read, "meshes"), "0")));
    json_decref(run);
    json_decref(read);
    json_decref(data);
    free(page);
    free_scene(&s);
}

static void a_template_without_its_places_is_refused_and_nothing_is_written(void **state) {
    (void)state;
    static const char *const wrong[] = {"",
                                        HS_REPORT_TITLE,
                                        HS_REPORT_DATA,
                                        HS_REPORT_DATA HS_REPORT_TITLE,
                                        HS_REPORT_TITLE HS_REPORT_DATA HS_REPORT_DATA,
                                        HS_REPORT_TITLE HS_REPORT_TITLE HS_REPORT_DATA};
    json_t *data = json_object();
    char page[400];
    snprintf(page, sizeof page, "%s", inside(&place, "page.html"));
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        hs_error err = {0};
        write_text("t.html", wrong[i]);
        assert_false(hs_report_html(page, inside(&place, "t.html"), "", data, &err));
        assert_int_equal(err.code, HS_EXIT_FILE);
        assert_non_null(strstr(err.text, "make report"));
    }
    hs_error err = {0};
    assert_false(hs_report_html(page, inside(&place, "none.html"), "", data, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    write_text("t.html", TEMPLATE);
    assert_false(hs_report_html("/none/page.html", inside(&place, "t.html"), "", data, &err));
    assert_int_equal(err.code, HS_EXIT_FILE);
    assert_int_equal(count_entries(&place), 1);
    json_decref(data);
}

/* RFC 4648, section 10. */
static void base64_is_that_of_the_standard(void **state) {
    (void)state;
    static const char *const vector[][2] = {{"", ""},
                                            {"f", "Zg=="},
                                            {"fo", "Zm8="},
                                            {"foo", "Zm9v"},
                                            {"foob", "Zm9vYg=="},
                                            {"fooba", "Zm9vYmE="},
                                            {"foobar", "Zm9vYmFy"},
                                            {"\xff\xfe\xfd", "//79"}};
    for (size_t i = 0; i < sizeof vector / sizeof *vector; i++) {
        json_t *text = hs_base64_json(">", (const uint8_t *)vector[i][0], strlen(vector[i][0]));
        assert_string_equal(json_string_value(text) + 1, vector[i][1]);
        json_decref(text);
    }
}

/* --- Folders that lack something ----------------------------------------------------------------
 */

static void a_missing_folder_or_report_is_an_error_with_its_remedy(void **state) {
    (void)state;
    hs_report_request r = request();
    refuse(&r, HS_EXIT_FILE, "run.json");
    refuse(&r, HS_EXIT_FILE, "halfstep run MESH --out DIR");
    r.folder = "/none";
    refuse(&r, HS_EXIT_FILE, "/none: there is no such folder");
    r = request();
    write_text("run.json", RUN);
    r.with = (hs_option_list){{"/none.json"}, 1};
    refuse(&r, HS_EXIT_FILE, "/none.json");
    r = request();
    r.explore = (hs_option_list){{place.path}, 1};
    refuse(&r, HS_EXIT_FILE, "halfstep explore MESH --out DIR");
}

static void broken_json_is_named_by_its_line(void **state) {
    (void)state;
    const hs_report_request r = request();
    write_text("run.json", "{\n\"views\": [\n,");
    refuse(&r, HS_EXIT_FILE, "run.json:3");
    write_text("run.json", "[]");
    refuse(&r, HS_EXIT_FILE, "no \"views\"");
    write_text("run.json", "{\"views\": {}}");
    refuse(&r, HS_EXIT_FILE, "no \"views\"");
    write_text("run.json", "{\"views\": [{\"view\": 70000, \"engines\": {}}]}");
    refuse(&r, HS_EXIT_FILE, "views[0]");
    write_text("run.json", "{\"views\": [{\"view\": 0, \"engines\": {}}, 7]}");
    refuse(&r, HS_EXIT_FILE, "views[1]");
    /* Cut anywhere, it is refused, never read in part. */
    for (size_t length = 0; length + 2 < sizeof RUN; length++) {
        char text[sizeof RUN];
        memcpy(text, RUN, length);
        text[length] = 0;
        write_text("run.json", text);
        refuse(&r, HS_EXIT_FILE, "run.json");
    }
}

static void what_is_missing_of_a_view_is_noted(void **state) {
    (void)state;
    const hs_report_request r = request();
    write_text("run.json", RUN);
    json_t *data = read_folder(&r);
    assert_true(has_note(data, "view 0: there is no folder"));
    json_decref(data);
    scene s = make_scene("cube", 0, adaptive, false);
    make_pictures();
    unlink(inside(&place, "view-000/side.png"));
    write_text("view-000/facing.png", "<svg onload='alert(1)'/>");
    data = read_folder(&r);
    assert_true(has_note(data, "side.png"));
    assert_true(has_note(data, "facing.png: is no picture"));
    const json_t *pictures = json_object_get(json_object_get(data, "pictures"), "0");
    assert_null(json_object_get(pictures, "side"));
    assert_null(json_object_get(pictures, "facing"));
    assert_non_null(json_object_get(pictures, "refined"));
    json_decref(data);
    free_scene(&s);
}

static void no_more_views_than_asked_have_pictures(void **state) {
    (void)state;
    char text[1000] = "{\"views\": [";
    for (int i = 0; i < 10; i++)
        snprintf(text + strlen(text), sizeof text - strlen(text),
                 "%s{\"view\": %d, \"engines\": {}}", i ? "," : "", i);
    strcat(text, "]}");
    write_text("run.json", text);
    hs_report_request r = request();
    r.views = 3;
    json_t *data = read_folder(&r);
    assert_true(has_note(data, "3 of 10 views"));
    assert_true(has_note(data, "view 0:") && has_note(data, "view 3:") &&
                has_note(data, "view 6:"));
    assert_false(has_note(data, "view 1:"));
    json_decref(data);
}

static void timelines_and_other_reports_come_along(void **state) {
    (void)state;
    hs_report_request r = request();
    write_text("run.json", "{\"views\": []}");
    write_text("timeline-000.svg", "<svg xmlns='http://www.w3.org/2000/svg'/>");
    write_text("explore.json", "{\"mesh\": \"x\", \"points\": []}");
    r.with = (hs_option_list){{place.path, inside(&place, "run.json")}, 2};
    r.explore = (hs_option_list){{place.path}, 1};
    json_t *data = read_folder(&r);
    const json_t *line = json_array_get(json_object_get(data, "timelines"), 0);
    assert_string_equal(json_string_value(json_object_get(line, "name")), "timeline-000.svg");
    const char *image = json_string_value(json_object_get(line, "image"));
    assert_ptr_equal(strstr(image, "data:image/svg+xml;base64,PHN2Z"), image);
    assert_int_equal(json_array_size(json_object_get(data, "with")), 2);
    assert_int_equal(json_array_size(json_object_get(data, "explore")), 1);
    json_decref(data);
}

int main(void) {
#define TEST(name) cmocka_unit_test_setup_teardown(name, new_place, leave_place)
    const struct CMUnitTest tests[] = {
        TEST(the_page_holds_every_figure_of_the_run_and_nothing_that_a_parser_would_run),
        TEST(a_template_without_its_places_is_refused_and_nothing_is_written),
        TEST(base64_is_that_of_the_standard),
        TEST(a_missing_folder_or_report_is_an_error_with_its_remedy),
        TEST(broken_json_is_named_by_its_line),
        TEST(what_is_missing_of_a_view_is_noted),
        TEST(no_more_views_than_asked_have_pictures),
        TEST(timelines_and_other_reports_come_along),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
