# SPDX-License-Identifier: Apache-2.0
# README and docs: what they say to type. build/test_docs is the fast part.

.PHONY: test-docs
test-docs: $(BUILD)/halfstep $(BUILD)/halfstep-faulty $(BUILD)/test_select installable page ## every command of README.md and docs/*.md, in a copy of the tree
	@tests/docs/check fast
	@tests/docs/check run

$(BUILD)/test_docs: | $(BUILD)/halfstep
