/* SPDX-License-Identifier: Apache-2.0 */
#include "definitions.h"

#include <stddef.h>

struct status_text {
    uint32_t status;
    const char *name, *what, *remedy;
};

#define CONSTANT(name, value, what)
#define RECORD(name, value, what)
#define STATUS(name, value, what, remedy) {value, #name, what, remedy},
#define STAGE(name, index, what)
#define ACTIVITY(name, index, what)
#define REGISTER(name, address, access, what)
#define PROBE(name, index, stage, what)
#define EXIT(name, value, what)
static const struct status_text statuses[] = {
#include "definitions.def"
};
#undef STATUS
#define STATUS(name, value, what, remedy)
#undef STAGE
#define STAGE(name, index, what) #name,
static const char *const stages[] = {
#include "definitions.def"
};

#undef STAGE
#define STAGE(name, index, what)
#undef ACTIVITY
#define ACTIVITY(name, index, what) #name,
static const char *const activities[] = {
#include "definitions.def"
};

#undef ACTIVITY
#define ACTIVITY(name, index, what)
#undef PROBE
#define PROBE(name, index, stage, what) {#name, what, HS_STAGE_##stage},
static const struct {
    const char *name, *what;
    uint32_t stage;
} probes[] = {
#include "definitions.def"
};

#undef PROBE
#define PROBE(name, index, stage, what)
#undef EXIT
#define EXIT(name, value, what) [value] = what,
static const char *const exits[] = {
#include "definitions.def"
};

static const struct status_text *find(uint32_t status) {
    static const struct status_text unknown = {0, "?", "an unknown status", ""};
    for (size_t i = 0; i < sizeof statuses / sizeof *statuses; i++)
        if (statuses[i].status == status) return &statuses[i];
    return &unknown;
}

const char *hs_status_name(uint32_t status) {
    return find(status)->name;
}

const char *hs_status_what(uint32_t status) {
    return find(status)->what;
}

const char *hs_status_remedy(uint32_t status) {
    return find(status)->remedy;
}

const char *hs_exit_what(int code) {
    return code >= 0 && (size_t)code < sizeof exits / sizeof *exits ? exits[code] : NULL;
}

const char *hs_stage_name(uint32_t stage) {
    return stage < HS_STAGES ? stages[stage] : "?";
}

const char *hs_activity_name(uint32_t activity) {
    return activity < HS_ACTIVITIES ? activities[activity] : "?";
}

const char *hs_probe_name(uint32_t probe) {
    return probe < HS_PROBES ? probes[probe].name : "?";
}

const char *hs_probe_what(uint32_t probe) {
    return probe < HS_PROBES ? probes[probe].what : "?";
}

uint32_t hs_probe_stage(uint32_t probe) {
    return probe < HS_PROBES ? probes[probe].stage : HS_STAGES;
}
