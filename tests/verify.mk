# SPDX-License-Identifier: Apache-2.0
# All campaigns, and one page with their figures. CAMPAIGNS names some of them; default: all.
# Each is made as if it were called by hand (level 0), with a job for every core.

CAMPAIGNS :=
.PHONY: verify
verify: ## all campaigns in their default sizes, at most an hour; out/verification.md
	@MAKEFLAGS= MAKELEVEL=0 tests/verify out/verification.md $(CAMPAIGNS)
