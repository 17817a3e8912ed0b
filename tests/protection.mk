# SPDX-License-Identifier: Apache-2.0
# Bits flipped in the RTL's memories: tests/protection/strikes.h says what is looked for.

guarded   := -GPORT_RECORDS=1 -GBANK_BITS=1 -GWINDOW_BITS=1 -GLANES=1 -GVERTICES=1024 -GQUADS=1024
unguarded := $(guarded) -GPARITY=0
GUARDED   := guarded unguarded

$(GUARDED:%=$(BUILD)/verilated/%/log): $(BUILD)/verilated/%/log: rtl/files.f $(wildcard rtl/*.sv) sim/probes.sv sim/rtl.mk tests/protection.mk
	$(call VERILATED,Vhalfstep,$($*) $(PIPELINE))

$(GUARDED:%=$(BUILD)/verilated/%/rtl_shim.o): $(BUILD)/verilated/%/rtl_shim.o: sim/rtl_shim.cpp $(BUILD)/verilated/%/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@

$(BUILD)/verilated/%/memories.o: tests/protection/memories.cpp tests/protection/list $(BUILD)/verilated/%/log
	tests/protection/list $(@D)/Vhalfstep___024root.h >$(@D)/memories.inc
	$(CXX) $(VERILATED_FLAGS) -Itests/protection -isystem $(@D) -c $< -o $@

STRIKES := $(BUILD)/tests/protection/strikes.o
$(STRIKES) $(BUILD)/tests/protection/protection.o $(BUILD)/tests/test_protection.o: CFLAGS += -Itests -Itests/protection
$(GUARDED:%=$(BUILD)/protection-%): $(BUILD)/protection-%: $(BUILD)/tests/protection/protection.o $(STRIKES) $(BUILD)/verilated/%/memories.o \
    $(BUILD)/verilated/%/rtl_shim.o $(BUILD)/libsim.a $(BUILD)/libhalfstep.a $(RUNTIME)
	$(CXX) $(filter %.o,$^) $(BUILD)/verilated/$*/Vhalfstep__ALL.a $(filter %.a,$^) -o $@ $(LIBS) -pthread

# Bounded, in `make test`: the default architecture.
$(BUILD)/test_protection: $(BUILD)/tests/test_protection.o $(STRIKES) $(RTL_DIR)/memories.o $(RTL_LIBS)
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

FLIPS := 10000
.PHONY: protection
protection: $(GUARDED:%=$(BUILD)/protection-%) ## bits flipped in every memory of the RTL: FLIPS=10000
	@tests/protection/run $(FLIPS) $^
