# SPDX-License-Identifier: Apache-2.0
# Measurements: they print tables, and never fail by being slow.

OSD_USERS += $(BUILD)/bench

.PHONY: bench
bench: $(BUILD)/bench ## golden's speed beside OpenSubdiv's, one thread
	$<
