# SPDX-License-Identifier: Apache-2.0
# A second simulator: the plain Verilog that Yosys writes of the pipeline, under Icarus Verilog, beside the
# Verilated RTL of the same architecture. And Verilator alone, from other initial contents.

ICARUS         := $(BUILD)/icarus
ICARUS_DESIGNS := smallest wider
ICARUS_RECORDS_smallest := 1
ICARUS_RECORDS_wider    := 4
# Yosys takes a quarter of an hour for the default architecture: this one has its port, and more than one of
# everything else.
wider := -GPORT_RECORDS=4 -GBANK_BITS=2 -GWINDOW_BITS=1 -GLANES=2 -GREAD_LATENCY=2

# Without parity: bits of a word that are never of use may be X, and then so is the word's parity, though a
# memory gives back what it got. Its claims are Verilator's to show, whose words have no X.
# `if` and `casez` take an X for a 0 and would hide it; what is chosen by `? :` becomes X. So multiplexers
# stay what they are, and no flip-flop gets an enable.
$(ICARUS_DESIGNS:%=$(ICARUS)/%.v): $(ICARUS)/%.v: rtl/files.f $(wildcard rtl/*.sv) tests/icarus.mk
	@mkdir -p $(@D)
	@echo "yosys: the $* architecture in plain Verilog"
	@yosys -q -p "read_verilog -sv $$(tr '\n' ' ' <rtl/files.f); \
	    chparam $(foreach g,$($*) -GPARITY=0,-set $(subst =, ,$(g:-G%=%))) halfstep; hierarchy -check -top halfstep; \
	    proc; pmuxtree; opt -full -keepdc -nodffe -nosdff; clean; rename -top halfstep; write_verilog -noattr $@.part" \
	    >$@.log 2>&1 || { cat $@.log; exit 1; }
	@mv $@.part $@

# Without iverilog there is no file, and the test says that it was skipped.
$(ICARUS_DESIGNS:%=$(ICARUS)/%.vvp): $(ICARUS)/%.vvp: $(ICARUS)/%.v tests/icarus/bench.v tests/icarus/build
	@$(call INSTALL,iverilog) || true
	@if command -v iverilog >/dev/null; then tests/icarus/build $(ICARUS_RECORDS_$*) $< $@; fi

# The same program on both simulators: tests/words.c.
$(ICARUS_DESIGNS:%=$(ICARUS)/%/rtl_shim.o): $(ICARUS)/%/rtl_shim.o: sim/rtl_shim.cpp
	@mkdir -p $(@D)
	$(CXX) $(VERILATED_FLAGS) -DPORT_RECORDS=$(ICARUS_RECORDS_$*) -Itests/icarus -c $< -o $@
$(ICARUS_DESIGNS:%=$(ICARUS)/words-%-icarus): $(ICARUS)/words-%-icarus: $(BUILD)/tests/words.o $(BUILD)/libsim.a \
    $(ICARUS)/%/rtl_shim.o $(RUNTIME) $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread
$(ICARUS)/words-smallest: $(BUILD)/tests/words.o $(BUILD)/libsim.a $(BUILD)/librtl-smallest.a $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread

# Two more Verilated pipelines: the wider architecture; and the smallest one, with resets that can be taken away.
VERILATED_HERE := $(ICARUS)/verilated/wider $(ICARUS)/verilated/unreset
$(ICARUS)/verilated/wider/log: rtl/files.f $(wildcard rtl/*.sv) sim/probes.sv sim/rtl.mk tests/icarus.mk
	$(call VERILATED,Vhalfstep,$(wider) $(PIPELINE))

$(ICARUS)/verilated/unreset/log: rtl/files.f $(wildcard rtl/*.sv) sim/probes.sv sim/rtl.mk tests/icarus/unreset.sv
	@mkdir -p $(@D)/rtl
	@for f in $$(cat rtl/files.f); do m=$$(basename $$f .sv); \
	    sed "s/if (rst_i/if (rst_i \&\& !unreset::hs_unreset(\"$$m\")/; s/<= rst_i ?/<= rst_i \&\& !unreset::hs_unreset(\"$$m\") ?/" \
	    $$f >$(@D)/$$f; done
	$(call VERILATED,Vhalfstep,$(smallest) $(filter-out -f rtl/files.f sim/probes.sv,$(PIPELINE)) \
	    tests/icarus/unreset.sv $(addprefix $(@D)/,$(shell cat rtl/files.f)) sim/probes.sv)

$(VERILATED_HERE:%=%/rtl_shim.o): %/rtl_shim.o: sim/rtl_shim.cpp %/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@
$(VERILATED_HERE:%=%/Vhalfstep__ALL.a): %/Vhalfstep__ALL.a: %/log ;
$(ICARUS)/words-wider $(ICARUS)/words-unreset: $(ICARUS)/words-%: $(BUILD)/tests/words.o $(BUILD)/tests/icarus/unreset.o \
    $(BUILD)/libsim.a $(ICARUS)/verilated/%/rtl_shim.o $(ICARUS)/verilated/%/Vhalfstep__ALL.a $(RUNTIME) \
    $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread

# Seeds of the initial contents.
SEEDS := 20
.PHONY: icarus
icarus: $(foreach d,$(ICARUS_DESIGNS),$(ICARUS)/$d.vvp $(ICARUS)/words-$d $(ICARUS)/words-$d-icarus) \
    $(ICARUS)/words-unreset ## a second simulator: the same words and cycles under Icarus, and no X; SEEDS initial contents
	@tests/icarus/campaign $(SEEDS)

# Bounded, in `make test`.
$(BUILD)/test_icarus: | $(ICARUS)/smallest.vvp $(ICARUS)/words-smallest $(ICARUS)/words-smallest-icarus
