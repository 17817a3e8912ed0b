# SPDX-License-Identifier: Apache-2.0
# Proofs of the RTL's modules: tests/formal/prove says what is proved.

# Broken designs of each proof, at most.
BREAKS := 999
.PHONY: formal
formal: ## proofs of FIFOs, handshakes, memories, counters, CRC; broken designs are refuted
	@$(call INSTALL,z3)
	@PROOF_BREAKS=$(BREAKS) tests/formal/prove $(BUILD)/formal

# The test does without z3 if it cannot be had, and says so.
$(BUILD)/test_formal: | $(BUILD)/formal/z3
$(BUILD)/formal/z3:
	@mkdir -p $(@D)
	@{ $(call INSTALL,z3); } && touch $@ || echo "z3 cannot be installed: test_formal will skip proofs"
