/* SPDX-License-Identifier: Apache-2.0
 *
 * expected.json, read and compared with what there is.
 */
#include <stdlib.h>

#include "trace.h"

json_t *hs_trace_expected_parse(const char *text, size_t size, const char *name, hs_error *err) {
    json_error_t why;
    json_t *expected = json_loadb(text, size, 0, &why);
    if (!expected)
        hs_fail(err, HS_EXIT_STREAM, "%.200s:%d: %s; make the trace again", name, why.line,
                why.text);
    return expected;
}

/* The first key in which an object is not as expected; of views, only how many there are. */
static bool check_object(json_t *expected, json_t *actual, const char *where, hs_error *err) {
    const char *key;
    json_t *value;
    json_object_foreach(actual, key, value) {
        json_t *wanted = json_object_get(expected, key);
        if (json_is_array(value) || json_equal(wanted, value)) continue;
        char *a = wanted ? json_dumps(wanted, JSON_ENCODE_ANY | JSON_COMPACT) : NULL;
        char *b = json_dumps(value, JSON_ENCODE_ANY | JSON_COMPACT);
        hs_fail(err, HS_EXIT_DIFFERENT,
                "%.240s: %s should be %.60s, but is %.60s; if that is meant, make the trace again",
                where, key, a ? a : "nothing", b ? b : "?");
        free(a);
        free(b);
        return false;
    }
    return true;
}

bool hs_trace_expected_check(json_t *expected, json_t *actual, const char *folder, hs_error *err) {
    json_t *wanted = json_object_get(expected, "views"), *views = json_object_get(actual, "views");
    if (json_array_size(wanted) != json_array_size(views))
        return hs_fail(err, HS_EXIT_DIFFERENT,
                       "%.300s: expected.json has %zu views, input.hss %zu; make the trace again",
                       folder, json_array_size(wanted), json_array_size(views));
    if (!check_object(expected, actual, folder, err)) return false;
    for (size_t i = 0; i < json_array_size(views); i++) {
        char where[260];
        snprintf(where, sizeof where, "%.200s, view %zu", folder, i);
        if (!check_object(json_array_get(wanted, i), json_array_get(views, i), where, err))
            return false;
    }
    return true;
}
