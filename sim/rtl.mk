# SPDX-License-Identifier: Apache-2.0
# The Verilated RTL: the whole pipeline for the program and the tests that drive it, and single
# modules for tests of their own.

VERILATOR_INCLUDE := $(shell verilator --getenv VERILATOR_ROOT 2>/dev/null)/include
# Registers and memories start with seeded random contents, so that a missing reset shows. The
# assertions stay armed: a broken rule stops the run. Those of data that must keep still cost a quarter of
# the speed: they are armed in the tests of single modules (HS_ASSERT_DATA).
VERILATE := verilator --cc -O3 -Wall --assert --x-initial unique --threads 1 --compiler clang
RTL_OPT := -O2
# Of what runs once.
RTL_OPT_SLOW := -O1
# $(call COMPILE,CLASS,FLAGS): its C++ in $(@D), in CLASS__ALL.a, with the jobs of this make (+). By clang, for the
# processor at hand: sooner done than by gcc, and faster.
COMPILE = $(MAKE) -s -C $(@D) -f $(1).mk CXX=clang++ OPT_FAST="$(RTL_OPT) -march=native $(2)" OPT_SLOW=$(RTL_OPT_SLOW) OPT_GLOBAL=-O2 \
          $(1)__ALL.a >/dev/null
# $(call VERILATED,CLASS,ARGUMENTS): both steps, as the recipe of $(@D)/log.
define VERILATED
@mkdir -p $(@D)
@$(VERILATE) --Mdir $(@D) --prefix $(1) $(2) >$@.part 2>&1 || { cat $@.part; exit 1; }
+@$(call COMPILE,$(1))
@mv $@.part $@
endef
VERILATED_FLAGS = $(CXXFLAGS) -isystem $(VERILATOR_INCLUDE) -isystem $(VERILATOR_INCLUDE)/vltstd

# What every Verilated model is linked with.
RUNTIME := $(addprefix $(BUILD)/verilated/,verilated.o verilated_threads.o verilated_fst_c.o verilated_dpi.o verilated_cov.o)
$(RUNTIME): $(BUILD)/verilated/%.o:
	@mkdir -p $(@D)
	$(CXX) -std=c++17 -O2 -DVM_TRACE=1 -DVM_TRACE_FST=1 -I$(VERILATOR_INCLUDE) -I$(VERILATOR_INCLUDE)/vltstd \
	    -c $(VERILATOR_INCLUDE)/$*.cpp -o $@

# --- The pipeline -----------------------------------------------------------------------------------
# rtl/files.f lists its modules. The waveform writer costs nothing until a file is opened; uncut, its one
# function takes longer to compile than all the rest.
RTL_DIR := $(BUILD)/verilated/halfstep
PIPELINE := --trace-fst --output-split 20000 --output-split-ctrace 200 --top-module halfstep -f rtl/files.f sim/probes.sv

$(RTL_DIR)/log: rtl/files.f $(wildcard rtl/*.sv) sim/probes.sv sim/rtl.mk
	$(call VERILATED,Vhalfstep,$(PIPELINE))

$(RTL_DIR)/rtl_shim.o: sim/rtl_shim.cpp $(RTL_DIR)/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@

# An archive of its own, behind libsim.a and before libhalfstep.a on the linker's line.
$(BUILD)/librtl.a: $(RTL_DIR)/rtl_shim.o $(RUNTIME)
	rm -f $@ && cp $(RTL_DIR)/Vhalfstep__ALL.a $@ && ar rs $@ $^

RTL_LIBS := $(BUILD)/libsim.a $(BUILD)/librtl.a $(BUILD)/libhalfstep.a

# --- Other architectures -----------------------------------------------------------------------------
# The same pipeline with other parameters, for the comparison of RTL and model: librtl-NAME.a.
ARCHITECTURES := smallest narrow few slow wide largest
smallest := -GPORT_RECORDS=1 -GBANK_BITS=1 -GWINDOW_BITS=1 -GLANES=1
narrow   := -GPORT_RECORDS=2 -GBANK_BITS=2 -GWINDOW_BITS=2
few      := -GLANES=4 -GWINDOW_BITS=4
slow     := -GREAD_LATENCY=4 -GWINDOW_BITS=4
wide     := -GBANK_BITS=4 -GLANES=16 -GOPS=64
flight   := -GVIEWS=3
largest  := -GBANK_BITS=4 -GWINDOW_BITS=5 -GLANES=16 -GREAD_LATENCY=8 -GOPS=256

$(patsubst %,$(BUILD)/verilated/%/log,$(ARCHITECTURES) flight): $(BUILD)/verilated/%/log: rtl/files.f $(wildcard rtl/*.sv) sim/probes.sv sim/rtl.mk
	$(call VERILATED,Vhalfstep,$($*) $(PIPELINE))

$(patsubst %,$(BUILD)/verilated/%/rtl_shim.o,$(ARCHITECTURES) flight): $(BUILD)/verilated/%/rtl_shim.o: sim/rtl_shim.cpp $(BUILD)/verilated/%/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@

$(patsubst %,$(BUILD)/librtl-%.a,$(ARCHITECTURES) flight): $(BUILD)/librtl-%.a: $(BUILD)/verilated/%/rtl_shim.o $(RUNTIME)
	rm -f $@ && cp $(BUILD)/verilated/$*/Vhalfstep__ALL.a $@ && ar rs $@ $^

# The campaign, for each architecture and for the default one.
$(BUILD)/parity: $(BUILD)/tests/parity.o $(RTL_LIBS)
	$(LINK_RTL) -lcmocka
$(ARCHITECTURES:%=$(BUILD)/parity-%): $(BUILD)/parity-%: $(BUILD)/tests/parity.o $(BUILD)/libsim.a \
    $(BUILD)/librtl-%.a $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

# Views in flight.
$(BUILD)/parity-flight: $(BUILD)/tests/parity_flight.o $(BUILD)/libsim.a $(BUILD)/librtl-flight.a \
    $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

# Bounded, in `make test`: the test of the model once more, on the smallest architecture.
$(BUILD)/test_smallest: $(BUILD)/tests/test_rtl_model.o $(BUILD)/libsim.a $(BUILD)/librtl-smallest.a \
    $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

# Per cent of the campaign.
PARITY := 100
.PHONY: parity
parity: $(BUILD)/parity $(patsubst %,$(BUILD)/parity-%,$(ARCHITECTURES) flight) ## the model against the RTL in full, in eight architectures
	@tests/parity_run $(PARITY) $^

LINK_RTL  = $(CXX) $< $(RTL_LIBS) -o $@ $(LIBS) -pthread

# What reports say of the program. Written only if it is another, so that nothing is built for it.
$(BUILD)/build_info.h: FORCE
	@mkdir -p $(@D)
	@printf '#define HS_BUILD_COMMIT "%s"\n#define HS_BUILD_SIMULATOR "%s"\n' \
	    "$$(git describe --always --abbrev=12 --dirty=+ 2>/dev/null || echo unknown)" "$$(verilator --version)" >$@.new
	@cmp -s $@.new $@ || cp $@.new $@
.PHONY: FORCE
$(BUILD)/sim/main.o: $(BUILD)/build_info.h
$(BUILD)/sim/main.o: CFLAGS += -I$(BUILD)

$(BUILD)/halfstep: $(BUILD)/sim/main.o $(RTL_LIBS)
	$(LINK_RTL)

# This test runs the program.
$(BUILD)/test_cli: | $(BUILD)/halfstep

# --- By a profile ------------------------------------------------------------------------------------
# The same C++, compiled twice: the first build counts its branches while it simulates meshes that no
# measurement uses; in the second, what is seldom executed stands apart, and the code of a cycle takes less
# of the caches. Worth its two minutes to measurements and long runs.
COUNTING := $(BUILD)/verilated/counting
PROFILED := $(BUILD)/verilated/profiled
PROFILED_LIBS := $(BUILD)/libsim.a $(BUILD)/librtl-profiled.a $(BUILD)/libhalfstep.a

# $(call COMPILE_AGAIN,FLAGS): the C++ once more, in a folder of its own.
COMPILE_AGAIN = rm -rf $(@D) && mkdir -p $(@D) && cp $(RTL_DIR)/*.cpp $(RTL_DIR)/*.h $(RTL_DIR)/*.mk $(@D) && \
                $(call COMPILE,Vhalfstep,$(1))

$(COUNTING)/Vhalfstep__ALL.a: $(RTL_DIR)/log
	@$(call INSTALL,llvm libclang-rt-14-dev)
	+@$(call COMPILE_AGAIN,-fprofile-generate)

$(COUNTING)/halfstep: $(BUILD)/sim/main.o $(BUILD)/libsim.a $(RTL_DIR)/rtl_shim.o $(COUNTING)/Vhalfstep__ALL.a \
    $(RUNTIME) $(BUILD)/libhalfstep.a
	clang++ -fprofile-generate $^ -o $@ $(LIBS) -latomic -pthread

$(BUILD)/verilated/profile: $(COUNTING)/halfstep
	rm -f $(COUNTING)/*.profraw
	LLVM_PROFILE_FILE=$(COUNTING)/%p.profraw $< run shape:die --orbit 2 --quiet >/dev/null
	LLVM_PROFILE_FILE=$(COUNTING)/%p.profraw $< run shape:spoon --uniform 6 --quiet >/dev/null
	llvm-profdata merge -o $@ $(COUNTING)/*.profraw

$(PROFILED)/Vhalfstep__ALL.a: $(BUILD)/verilated/profile
	+@$(call COMPILE_AGAIN,-O3 -fprofile-use=$(abspath $<))

$(BUILD)/librtl-profiled.a: $(RTL_DIR)/rtl_shim.o $(RUNTIME) $(PROFILED)/Vhalfstep__ALL.a
	rm -f $@ && cp $(PROFILED)/Vhalfstep__ALL.a $@ && ar rs $@ $(filter %.o,$^)

.PHONY: profiled
profiled: $(BUILD)/halfstep-profiled ## build/halfstep-profiled: the program with a faster rtl, for long runs
$(BUILD)/halfstep-profiled: $(BUILD)/sim/main.o $(PROFILED_LIBS)
	$(CXX) $^ -o $@ $(LIBS) -pthread

.PHONY: traces
traces: $(BUILD)/halfstep ## input and expectations of all traces, anew from their trace.txt
	$< trace make --all

# Tests that run the pipeline are named test_rtl*.c.
RTL_TESTS := $(filter-out $(BUILD)/test_rtl_shim,$(filter $(BUILD)/test_rtl%,$(TESTS)))
$(RTL_TESTS): $(BUILD)/test_%: $(BUILD)/tests/test_%.o $(RTL_LIBS)
	$(LINK_RTL) -lcmocka

# The shim itself is tested on a pipeline with planted faults.
$(BUILD)/tests/broken_rtl/rtl_shim.o: sim/rtl_shim.cpp
	@mkdir -p $(@D)
	$(CXX) $(VERILATED_FLAGS) -Itests/broken_rtl -c $< -o $@

$(BUILD)/test_rtl_shim: $(BUILD)/tests/test_rtl_shim.o $(BUILD)/tests/broken_rtl/rtl_shim.o $(RUNTIME) \
    $(BUILD)/libsim.a $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lcmocka $(LIBS) -pthread

# --- Single modules -------------------------------------------------------------------------------
# tests/test_NAME.c drives tests/NAME_top.sv through tests/NAME_shim.cpp, with the class VNAME.
UNITS := check_twins classify divide emit fifo geometry registers select sharpness window

$(UNITS:%=$(BUILD)/verilated/%/log): $(BUILD)/verilated/%/log: tests/%_top.sv $(wildcard rtl/*.sv) sim/rtl.mk
	$(call VERILATED,V$*,+define+HS_ASSERT_DATA --top-module $*_top -y rtl rtl/hs_pkg.sv $<)

$(UNITS:%=$(BUILD)/verilated/%/shim.o): $(BUILD)/verilated/%/shim.o: tests/%_shim.cpp $(BUILD)/verilated/%/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@

$(UNITS:%=$(BUILD)/test_%): $(BUILD)/test_%: $(BUILD)/tests/test_%.o $(BUILD)/verilated/%/shim.o \
    $(RUNTIME) $(BUILD)/libhalfstep.a
	$(CXX) $(filter-out %.a,$^) $(BUILD)/verilated/$*/V$*__ALL.a $(BUILD)/libhalfstep.a -o $@ \
	    -lcmocka -lz -lm -pthread
