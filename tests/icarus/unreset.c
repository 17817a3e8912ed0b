/* SPDX-License-Identifier: Apache-2.0
 *
 * For tests/icarus/unreset.sv: the module without resets is the one that the environment variable
 * HS_UNRESET names.
 */
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

bool hs_unreset(const char *name);

bool hs_unreset(const char *name) {
    const char *module = getenv("HS_UNRESET");
    return module && strcmp(module, name) == 0;
}
