# SPDX-License-Identifier: Apache-2.0
# All campaigns, and one page with their figures. CAMPAIGNS names some of them; default: all.

CAMPAIGNS :=
.PHONY: verify
verify: ## all campaigns in their default sizes, at most an hour; out/verification.md
	@MAKEFLAGS= tests/verify out/verification.md $(CAMPAIGNS)
