# SPDX-License-Identifier: Apache-2.0
# Mutation: the tests have to see small faults planted in the RTL and in the C code.

# How many of each, which ones, and how many at a time. Each set of mutants of the RTL has a folder of its own.
MUTANTS       := 320
C_MUTANTS     := 220
MUTATION_SEED := 1
MUTATION_JOBS := $(shell nproc)
MUTATION      := $(BUILD)/mutation/$(MUTANTS)-$(MUTATION_SEED)

VECTORS := $(patsubst %,$(BUILD)/tests/mutation/%.o,vectors vectors_make vectors_aimed)

# --- The RTL: one build of the smallest architecture, with small memories -----------------------------
MUTANTS_VERTICES := 512
MUTANTS_QUADS    := 1024

$(MUTATION)/mutants.v: rtl/files.f $(wildcard rtl/*.sv) tests/mutation/rtl_mutants
	@mkdir -p $(@D)
	@tests/mutation/rtl_mutants $(@D) $(MUTANTS) $(MUTATION_SEED) \
	    "-GVERTICES=$(MUTANTS_VERTICES) -GQUADS=$(MUTANTS_QUADS) -GPARITY=0 $(smallest)"

# Yosys's Verilog is not written to be read: without warnings.
$(MUTATION)/verilated/log: $(MUTATION)/mutants.v
	$(call VERILATED,Vmutants,--output-split 20000 -Wno-lint -Wno-style -Wno-fatal --top-module halfstep $<)

# The shims of the pipeline and of the registers, for the pipeline that holds the mutants.
$(MUTATION)/rtl_shim.o $(MUTATION)/registers_shim.o: $(MUTATION)/%.o: $(MUTATION)/verilated/log \
    tests/mutation/Vhalfstep.h tests/mutation/Vregisters.h
	$(CXX) $(VERILATED_FLAGS) -isystem $(MUTATION)/verilated -Itests/mutation -Itests \
	    -c $(filter %/$*.cpp,$^) -o $@
$(MUTATION)/rtl_shim.o: sim/rtl_shim.cpp
$(MUTATION)/registers_shim.o: tests/registers_shim.cpp

$(BUILD)/tests/mutation/kill_rtl.o: CFLAGS += -DMUTANTS_VERTICES=$(MUTANTS_VERTICES) -DMUTANTS_QUADS=$(MUTANTS_QUADS)
$(MUTATION)/kill_rtl: $(BUILD)/tests/mutation/kill_rtl.o $(VECTORS) $(MUTATION)/rtl_shim.o \
    $(MUTATION)/registers_shim.o $(BUILD)/libsim.a $(RUNTIME) $(BUILD)/libhalfstep.a
	$(CXX) $(filter %.o,$^) $(MUTATION)/verilated/Vmutants__ALL.a $(filter %.a,$^) -o $@ $(LIBS) -lcmocka -pthread

# The test of a module alone, with one of it that has a mutant: UNIT and UNIT_DIR are tests/mutation/unit's.
ifdef UNIT
UNIT_CLASS := $(if $(filter fp,$(UNIT)),Vfp_top,V$(UNIT))
$(UNIT_DIR)/log: $(UNIT_DIR)/mutant.v
	$(call VERILATED,$(UNIT_CLASS),+define+HS_ASSERT_DATA -Wno-lint -Wno-style -Wno-fatal --top-module $(UNIT)_top \
	    -y rtl rtl/hs_pkg.sv $< tests/$(UNIT)_top.sv)
$(UNIT_DIR)/shim.o: tests/$(UNIT)_shim.cpp $(UNIT_DIR)/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@
$(UNIT_DIR)/test: $(BUILD)/tests/test_$(UNIT).o $(UNIT_DIR)/shim.o $(RUNTIME) $(BUILD)/libhalfstep.a
	$(CXX) $(filter %.o,$^) $(UNIT_DIR)/$(UNIT_CLASS)__ALL.a $(BUILD)/libhalfstep.a -o $@ -lcmocka -lz -lm -pthread
endif

# --- The C code: each mutant is compiled alone ---------------------------------------------------------
$(BUILD)/mutation/mutate: $(BUILD)/tests/mutation/mutate.o
	@mkdir -p $(@D)
	$(CC) $^ -o $@

$(BUILD)/mutation/record_vectors: $(BUILD)/tests/mutation/record_vectors.o $(VECTORS) \
    $(BUILD)/libsim.a $(BUILD)/libhalfstep.a
	@mkdir -p $(@D)
	$(CXX) $^ -o $@ $(LIBS) -lcmocka

$(BUILD)/mutation/vectors: $(BUILD)/mutation/record_vectors
	$< $(@D)
	@touch $@

MUTATION_TESTS := exhausted golden golden_hostile golden_rules stream stream_decode frame flight log memory

.PHONY: mutation
mutation: $(MUTATION)/kill_rtl $(BUILD)/mutation/mutate $(BUILD)/mutation/vectors $(BUILD)/tests/mutation/kill_c.o \
    $(MUTATION_TESTS:%=$(BUILD)/tests/test_%.o) ## faults planted in the RTL and in the C code: do the tests see them?
	@tests/mutation/run $(BUILD) $(MUTATION) $(C_MUTANTS) $(MUTATION_SEED) $(MUTATION_JOBS)
