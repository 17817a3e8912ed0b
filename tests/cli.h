/* SPDX-License-Identifier: Apache-2.0
 *
 * build/halfstep as its users meet it: runs it, and reads what it says and leaves in the test's
 * folder.
 */
#ifndef HS_TEST_CLI_H
#define HS_TEST_CLI_H

#include "place.h"

#include <jansson.h>
#include <sys/stat.h>
#include <sys/wait.h>

#include "definitions.h"

static char output[400000]; /* of the latest command, both streams */

/* Runs `build/halfstep ARGUMENTS`, a shell's line, and returns its exit code. @ stands for the
 * test's folder. */
static inline int halfstep(const char *arguments) {
    char line[4100];
    const int length = snprintf(line, sizeof line, "timeout 120 build/halfstep %s 2>&1",
                                with_folder(&place, arguments));
    assert_in_range(length, 1, sizeof line - 1);
    FILE *pipe = popen(line, "r");
    assert_non_null(pipe);
    const size_t size = fread(output, 1, sizeof output - 1, pipe);
    output[size] = 0;
    const int status = pclose(pipe);
    if (!WIFEXITED(status)) fail_msg("%s: killed\n%s", line, output);
    return WEXITSTATUS(status);
}

static inline void expect(int code, const char *arguments, const char *text) {
    const int sent = halfstep(arguments);
    if (sent != code)
        fail_msg("halfstep %s: exit code %d instead of %d\n%s", arguments, sent, code, output);
    if (!strstr(output, text)) fail_msg("halfstep %s: no \"%s\" in\n%s", arguments, text, output);
}

static inline bool exists(const char *name) {
    struct stat status;
    return stat(inside(&place, name), &status) == 0;
}

static inline json_t *read_json(const char *name) {
    json_error_t why;
    json_t *root = json_load_file(inside(&place, name), 0, &why);
    if (!root) fail_msg("%s: %s", name, why.text);
    return root;
}

/* A path of keys and indices below a JSON value, as in "views", 0, "engines"; NULL ends it. */
static inline json_t *at(json_t *value, const char *path) {
    char text[200], *rest = text, *key;
    snprintf(text, sizeof text, "%s", path);
    while (value && (key = strsep(&rest, "/")) != NULL)
        value = json_is_array(value) ? json_array_get(value, (size_t)atoi(key))
                                     : json_object_get(value, key);
    if (!value) fail_msg("the report has no %s", path);
    return value;
}

static inline json_int_t number_at(json_t *value, const char *path) {
    json_t *number = at(value, path);
    if (!json_is_integer(number)) fail_msg("%s is no integer", path);
    return json_integer_value(number);
}

#endif
