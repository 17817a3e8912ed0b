# SPDX-License-Identifier: Apache-2.0
# The harness itself, and files and processes: programs with faults planted at the linker's seams, and
# a library that refuses memory.

SEAMS := golden_run model_run rtl_run compare_words log_compare reference_compare
PLANT  = $(CXX) $(filter-out %.a,$^) $(RTL_LIBS) $(SEAMS:%=-Wl,--wrap=hs_%) -o $@ $(LIBS) -pthread

$(BUILD)/halfstep-faulty: $(BUILD)/sim/main.o $(BUILD)/tests/planted.o $(RTL_LIBS)
	$(PLANT)
$(BUILD)/parity-faulty: $(BUILD)/tests/parity.o $(BUILD)/tests/planted.o $(RTL_LIBS)
	$(PLANT) -lcmocka

$(BUILD)/fail_alloc.so: tests/fail_alloc.c
	$(CC) -std=gnu17 -g -O2 $(WARN) -fPIC -shared $< -o $@ -ldl

# These tests run programs.
$(BUILD)/test_harness: | $(BUILD)/halfstep $(BUILD)/halfstep-faulty $(BUILD)/parity-faulty $(BUILD)/test_rtl_throughput
$(BUILD)/test_processes: | $(BUILD)/halfstep $(BUILD)/fail_alloc.so

.PHONY: harness
harness: $(BUILD)/test_harness ## golden, baselines, words and comparisons that are wrong: the harness has to fail
	@tests/run $<

# Points of a run at which it is killed.
POINTS := 50
.PHONY: processes
processes: $(BUILD)/test_processes ## full disks, kills, two at once, little memory: every writer, in full
	@HS_PROCESSES=$(POINTS) $<
