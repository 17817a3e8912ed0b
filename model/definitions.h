/* SPDX-License-Identifier: Apache-2.0
 *
 * The numbers of definitions.def as C enumerators: HS_STATUS_OK, HS_RECORD_FACE, HS_STAGE_split,
 * HS_REG_LIMIT_QUADS, HS_EXIT_MESH, and every CONSTANT as HS_<name>.
 */
#ifndef HS_DEFINITIONS_H
#define HS_DEFINITIONS_H

#include <stdint.h>

#define CONSTANT(name, value, what) enum { HS_##name = value };
#define RECORD(name, value, what)
#define STATUS(name, value, what, remedy)
#define STAGE(name, index, what)
#define ACTIVITY(name, index, what)
#define REGISTER(name, address, access, what)
#define PROBE(name, index, stage, what)
#define EXIT(name, value, what)
#include "definitions.def"
#undef CONSTANT
#define CONSTANT(name, value, what)

#undef RECORD
#define RECORD(name, value, what) HS_RECORD_##name = value,
enum hs_record_kind {
#include "definitions.def"
};
#undef RECORD
#define RECORD(name, value, what)

#undef STATUS
#define STATUS(name, value, what, remedy) HS_STATUS_##name = value,
enum hs_status {
#include "definitions.def"
};
#undef STATUS
#define STATUS(name, value, what, remedy)

#undef STAGE
#define STAGE(name, index, what) HS_STAGE_##name = index,
enum hs_stage {
#include "definitions.def"
    HS_STAGES
};
#undef STAGE
#define STAGE(name, index, what)

#undef ACTIVITY
#define ACTIVITY(name, index, what) HS_ACTIVITY_##name = index,
enum hs_activity {
#include "definitions.def"
    HS_ACTIVITIES
};
#undef ACTIVITY
#define ACTIVITY(name, index, what)

#undef REGISTER
#define REGISTER(name, address, access, what) HS_REG_##name = address,
enum hs_register {
#include "definitions.def"
};
#undef REGISTER
#define REGISTER(name, address, access, what)

#undef PROBE
#define PROBE(name, index, stage, what) HS_PROBE_##name = index,
enum hs_probe {
#include "definitions.def"
    HS_PROBES
};
#undef PROBE
#define PROBE(name, index, stage, what)

#undef EXIT
#define EXIT(name, value, what) HS_EXIT_##name = value,
enum hs_exit {
#include "definitions.def"
};
#undef EXIT

#undef CONSTANT
#undef RECORD
#undef STATUS
#undef STAGE
#undef ACTIVITY
#undef REGISTER
#undef PROBE

#ifdef __cplusplus
extern "C" {
#endif

/* "BAD_TWIN" for HS_STATUS_BAD_TWIN; "?" for a number that is no status. */
const char *hs_status_name(uint32_t status);
/* What a status means, in a sentence without a full stop. */
const char *hs_status_what(uint32_t status);
/* What to do about it; empty where there is nothing to do. */
const char *hs_status_remedy(uint32_t status);
/* What an exit code means, in a sentence without a full stop; NULL behind the last of them. */
const char *hs_exit_what(int code);
/* "classify" for HS_STAGE_classify. */
const char *hs_stage_name(uint32_t stage);
/* "busy" for HS_ACTIVITY_busy. */
const char *hs_activity_name(uint32_t activity);
/* "split_in" for HS_PROBE_split_in, what passes there, and the stage that it belongs to. */
const char *hs_probe_name(uint32_t probe);
const char *hs_probe_what(uint32_t probe);
uint32_t hs_probe_stage(uint32_t probe);

#ifdef __cplusplus
}
#endif
#endif
