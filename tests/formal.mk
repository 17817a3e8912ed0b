# SPDX-License-Identifier: Apache-2.0
# Proofs of the RTL's modules: tests/formal/prove says what is proved.

.PHONY: formal
formal: ## proofs of fifo, deal and collect by induction; broken ones are seen
	@$(call INSTALL,z3)
	@tests/formal/prove $(BUILD)/formal
