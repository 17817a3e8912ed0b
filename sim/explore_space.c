/* SPDX-License-Identifier: Apache-2.0 */
#include "explore.h"

#include <string.h>

#include "options.h"

static const struct {
    const char *name;
    size_t offset;
} PARAMETERS[HS_EXPLORE_NAMES] = {
    {"port", offsetof(hs_model_config, port)},       {"banks", offsetof(hs_model_config, banks)},
    {"window", offsetof(hs_model_config, window)},   {"lanes", offsetof(hs_model_config, lanes)},
    {"latency", offsetof(hs_model_config, latency)}, {"ops", offsetof(hs_model_config, ops)},
    {"views", offsetof(hs_model_config, views)},     {"parity", offsetof(hs_model_config, parity)},
};

const char *hs_explore_name(uint32_t parameter) {
    return PARAMETERS[parameter].name;
}

uint32_t hs_explore_value(const hs_model_config *config, uint32_t parameter) {
    uint32_t value;
    memcpy(&value, (const char *)config + PARAMETERS[parameter].offset, sizeof value);
    return value;
}

static void set_value(hs_model_config *config, uint32_t parameter, uint32_t value) {
    memcpy((char *)config + PARAMETERS[parameter].offset, &value, sizeof value);
}

void hs_explore_space_start(hs_explore_space *space, uint32_t views) {
    *space = (hs_explore_space){.views = views};
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++) {
        space->parameter[p].count = 1;
        space->parameter[p].value[0] = hs_explore_value(&HS_DEFAULT_CONFIG, p);
    }
}

static bool find(const char *text, uint32_t *parameter, hs_error *err) {
    const size_t length = strcspn(text, "=");
    char name[40];
    const char *names[HS_EXPLORE_NAMES + 1] = {NULL};
    snprintf(name, sizeof name, "%.*s", (int)length, text);
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++) {
        names[p] = PARAMETERS[p].name;
        if (text[length] == '=' && strcmp(name, names[p]) == 0) {
            *parameter = p;
            return true;
        }
    }
    const char *nearest = hs_nearest(name, names);
    return hs_fail(err, HS_EXIT_USAGE,
                   "--set %.60s: it should be NAME=VALUE,VALUE..., as in banks=4,8,16%s%s%s; there "
                   "are port, banks, window, lanes, latency, ops, views and parity",
                   text, nearest ? "; did you mean \"" : "", nearest ? nearest : "",
                   nearest ? "\"?" : "");
}

/* Whether the model takes this value; the other parameters are as by default. */
static bool good_value(uint32_t parameter, uint32_t value, hs_error *err) {
    hs_model_config config = HS_DEFAULT_CONFIG;
    set_value(&config, parameter, value);
    return hs_model_config_good(&config, err);
}

bool hs_explore_set(hs_explore_space *space, const char *text, hs_error *err) {
    uint32_t p = 0;
    if (!find(text, &p, err)) return false;
    if (space->parameter[p].given)
        return hs_fail(err, HS_EXIT_USAGE, "--set %s: given twice; list all values in one",
                       PARAMETERS[p].name);
    space->parameter[p].given = true;
    space->parameter[p].count = 0;
    for (const char *at = strchr(text, '='); at; at = strchr(at + 1, ',')) {
        char number[20];
        uint32_t value;
        snprintf(number, sizeof number, "%.*s", (int)strcspn(at + 1, ","), at + 1);
        if (!hs_number_parse(number, &value))
            return hs_fail(err, HS_EXIT_USAGE, "--set %.60s: \"%s\" is no number", text, number);
        if (!good_value(p, value, err)) return false;
        if (space->parameter[p].count == HS_EXPLORE_VALUES)
            return hs_fail(err, HS_EXIT_USAGE, "--set %s: more than %d values", PARAMETERS[p].name,
                           HS_EXPLORE_VALUES);
        for (uint32_t i = 0; i < space->parameter[p].count; i++)
            if (space->parameter[p].value[i] == value)
                return hs_fail(err, HS_EXIT_USAGE, "--set %s: %u is there twice",
                               PARAMETERS[p].name, value);
        space->parameter[p].value[space->parameter[p].count++] = value;
    }
    return true;
}

uint64_t hs_explore_points(const hs_explore_space *space) {
    uint64_t points = space->views;
    for (uint32_t p = 0; p < HS_EXPLORE_NAMES; p++)
        points *= space->parameter[p].count;
    return points;
}

hs_model_config hs_explore_config(const hs_explore_space *space, uint64_t point) {
    hs_model_config config = HS_DEFAULT_CONFIG;
    uint64_t left = point / space->views;
    for (uint32_t p = HS_EXPLORE_NAMES; p-- > 0;) {
        set_value(&config, p, space->parameter[p].value[left % space->parameter[p].count]);
        left /= space->parameter[p].count;
    }
    return config;
}
