# SPDX-License-Identifier: Apache-2.0
# What the tests cover, on one page: the C by gcc and gcovr, the RTL by Verilator.

COVERAGE := $(BUILD)/coverage
# Per cent of the parity campaign's views (tests/parity.c) with which the whole pipeline is covered.
COVERAGE_PARITY := 2

# --- The C: a tree of links with a build folder of its own, since tests name build/halfstep. What is
# Verilated in it is the ordinary build's. The long tests of the RTL, those of single modules and those of tools
# and invariants add nothing to the C that others do not run in a tenth of the time; those of installation and docs
# run make and git, which belong into the checkout.
COVERAGE_TREE := $(COVERAGE)/tree
COVERAGE_ALONE := $(UNITS) docs formal fp harness icarus install invariants receive receive_hostile rtl rtl_hostile rtl_surface rtl_throughput smallest
COVERAGE_C := $(filter-out $(COVERAGE_ALONE:%=$(BUILD)/test_%),$(TESTS))

# --- The RTL: tests of single modules, the pipeline in two architectures, hostile packets, flipped bits. Its
# capacity is small, so that
# few views reach every bit of an index. What names all points, once, are functions of 100,000 lines: not optimized.
# Modules that have tests of their own are left out of it.
COVERAGE_RTL := $(COVERAGE)/rtl
COVERAGE_CAPACITY := 1024 2048
COVERAGE_UNITS := $(UNITS:%=test_%) test_fp test_receive test_receive_hostile
COVERAGE_PIPELINES := parity parity-smallest test_rtl_hostile test_protection
# Verilator splits and reorders blocks: counts then stand behind what changes their conditions.
COVERAGE_VERILATE = $(VERILATE) --coverage-line --coverage-toggle -fno-split -fno-reorder

.PHONY: coverage
coverage: $(COVERAGE_C) $(BUILD)/halfstep $(BUILD)/libsim.a $(BUILD)/tests/parity.o ## lines, branches and toggles that the tests cover: out/coverage.md
	@$(call INSTALL,gcovr)
	@mkdir -p $(COVERAGE_TREE)/build $(COVERAGE_RTL)
	@ln -sfn $(addprefix $(CURDIR)/,Makefile README.md model sim rtl docs traces tests) $(COVERAGE_TREE)
	@ln -sfn $(abspath $(BUILD))/verilated $(COVERAGE_TREE)/build/verilated
	@ln -sfn $(addprefix $(abspath $(BUILD))/,model sim tests libsim.a libhalfstep.a) $(COVERAGE_RTL)
	@cp $(BUILD)/packages.mk $(COVERAGE_TREE)/build && cp $(BUILD)/packages.mk $(COVERAGE_RTL)
	@echo "building the C with --coverage"
	+@$(MAKE) -s -C $(COVERAGE_TREE) BUILD=build CC="gcc --coverage -fprofile-update=atomic" CXX="g++ --coverage" OPT=-O0 \
	    build/halfstep $(COVERAGE_C:$(BUILD)/%=build/%)
	@echo "building the RTL with coverage of lines and toggles"
	+@$(MAKE) -s BUILD=$(COVERAGE_RTL) VERILATE="$(COVERAGE_VERILATE)" RTL_OPT=-O1 RTL_OPT_SLOW=-O0 \
	    CXXFLAGS="$(CXXFLAGS) -DVM_COVERAGE=1" \
	    PIPELINE="tests/coverage/elsewhere.vlt -GVERTICES=$(word 1,$(COVERAGE_CAPACITY)) -GQUADS=$(word 2,$(COVERAGE_CAPACITY)) $(PIPELINE)" \
	    $(addprefix $(COVERAGE_RTL)/,$(COVERAGE_UNITS) $(COVERAGE_PIPELINES))
	@tests/coverage/run $(COVERAGE) out/coverage.md $(COVERAGE_PARITY) $(COVERAGE_CAPACITY) \
	    $(patsubst $(BUILD)/%,build/%,$(filter $(LONGEST),$(COVERAGE_C)) $(filter-out $(LONGEST),$(COVERAGE_C))) -- $(addprefix $(COVERAGE_RTL)/,$(COVERAGE_UNITS) $(COVERAGE_PIPELINES))
