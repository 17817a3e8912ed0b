# SPDX-License-Identifier: Apache-2.0
# Measurements: they print tables, and never fail by being slow. And tests whose programs are made
# of more than one file.

$(BUILD)/bench: $(BUILD)/tests/osd.o
$(BUILD)/bench: LIBS += -losdCPU

# Explorations in parts: a Slurm job array on this machine, and GNU parallel.
.PHONY: slurm
slurm: $(BUILD)/halfstep ## an exploration as a Slurm job array, on a cluster started here for it (root)
	@$(call INSTALL,slurmctld slurmd slurm-client munge parallel)
	@tests/slurm_loopback $<

.PHONY: bench throughput baselines accuracy saving
bench: $(BUILD)/bench $(BUILD)/bench_cycles $(BUILD)/test_rtl_throughput ## tables: throughput, speed of rtl and model, golden beside OpenSubdiv, scaling
	@$(BUILD)/test_rtl_throughput | grep -v '^\['
	@echo; $(BUILD)/bench_cycles
	@$(call INSTALL,gnuplot-nox)
	@gnuplot tests/scaling.gp && echo "out/bench/scaling.png"
	@echo; $(BUILD)/bench

# With the RTL at its fastest, laid out by a profile.
$(BUILD)/bench_cycles: $(BUILD)/tests/bench_cycles.o $(PROFILED_LIBS)
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

throughput: $(BUILD)/test_rtl_throughput ## cycles of views through the RTL beside their bounds
	$<

baselines: $(BUILD)/test_rtl_throughput ## the cycles that `make test` expects, anew: tests/throughput.txt
	HS_BASELINES=write $<

saving: $(BUILD)/saving ## faces and silhouette of fixed depths beside those of least edges
	$<

accuracy: $(BUILD)/accuracy ## distance to doubles: block floating point beside binary32
	$<

$(BUILD)/test_invariants: $(BUILD)/tests/test_invariants.o $(BUILD)/tests/invariants.o $(BUILD)/libsim.a \
    $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lcmocka $(LIBS)
