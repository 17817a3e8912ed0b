# SPDX-License-Identifier: Apache-2.0
# Measurements: they print tables, and never fail by being slow. And tests whose programs are made
# of more than one file.

$(BUILD)/bench: $(BUILD)/tests/osd.o
$(BUILD)/bench: LIBS += -losdCPU

# Explorations in parts: a Slurm job array on this machine, and GNU parallel.
.PHONY: slurm
slurm: $(BUILD)/halfstep ## an exploration as a Slurm job array, on a cluster started here for it (root)
	@command -v slurmctld slurmd sbatch munged parallel >/dev/null 2>&1 && [ -x "$$(command -v slurmctld)" ] || { \
	    DEBIAN_FRONTEND=noninteractive; export DEBIAN_FRONTEND; \
	    apt-get -qq update && apt-get -qq install -y --no-install-recommends slurmctld slurmd slurm-client munge parallel >/dev/null; }
	@tests/slurm_loopback $<

.PHONY: bench throughput baselines accuracy saving
bench: $(BUILD)/bench $(BUILD)/bench_cycles $(BUILD)/test_rtl_throughput $(BUILD)/gnuplot.there ## tables: throughput, speed of rtl and model, golden beside OpenSubdiv, scaling
	@$(BUILD)/test_rtl_throughput | grep -v '^\['
	@echo; $(BUILD)/bench_cycles
	@gnuplot tests/scaling.gp && echo "out/bench/scaling.png"
	@echo; $(BUILD)/bench

$(BUILD)/bench_cycles: $(BUILD)/tests/bench_cycles.o $(RTL_LIBS)
	$(LINK_RTL) -lcmocka

# For the plot alone, so that the tests need not have it.
$(BUILD)/gnuplot.there:
	@command -v gnuplot >/dev/null || { test $$(id -u) = 0 || sudo=sudo; \
	    $$sudo apt-get -qq update && $$sudo apt-get -qq install -y --no-install-recommends gnuplot-nox >/dev/null; }
	@touch $@

throughput: $(BUILD)/test_rtl_throughput ## cycles of views through the RTL beside their bounds
	$<

baselines: $(BUILD)/test_rtl_throughput ## the cycles that `make test` expects, anew: tests/throughput.txt
	HS_BASELINES=write $<

saving: $(BUILD)/saving ## faces and silhouette of fixed depths beside those of least edges
	$<

accuracy: $(BUILD)/accuracy ## distance to doubles: block floating point beside binary32
	$<

$(BUILD)/test_invariants: $(BUILD)/tests/invariants.o
