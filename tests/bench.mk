# SPDX-License-Identifier: Apache-2.0
# Measurements: they print tables, and never fail by being slow. And tests whose programs are made
# of more than one file.

$(BUILD)/bench: $(BUILD)/tests/osd.o
$(BUILD)/bench: LIBS += -losdCPU

.PHONY: bench throughput baselines accuracy saving
bench: $(BUILD)/bench ## golden's speed beside OpenSubdiv's, one thread
	$<

throughput: $(BUILD)/test_rtl_throughput ## cycles of views through the RTL beside their bounds
	$<

baselines: $(BUILD)/test_rtl_throughput ## the cycles that `make test` expects, anew: tests/throughput.txt
	HS_BASELINES=write $<

saving: $(BUILD)/saving ## faces and silhouette of fixed depths beside those of least edges
	$<

accuracy: $(BUILD)/accuracy ## distance to doubles: block floating point beside binary32
	$<

$(BUILD)/test_invariants: $(BUILD)/tests/invariants.o
