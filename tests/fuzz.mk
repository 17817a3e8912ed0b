# SPDX-License-Identifier: Apache-2.0
# Fuzzing: tests/fuzz.h says what; tests/fuzz and tests/fuzz_rtl.c do it.

FUZZ_SRC := fuzz_kit fuzz_text fuzz_stream fuzz_surface mutate invariants
$(BUILD)/test_fuzz: $(BUILD)/tests/test_fuzz.o $(FUZZ_SRC:%=$(BUILD)/tests/%.o) $(BUILD)/libsim.a $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lcmocka $(LIBS)

# libFuzzer's program, in a build of its own. clang's warnings are not gcc's: those count.
FUZZ_CC := clang -fsanitize=fuzzer-no-link,address,undefined -fno-sanitize-recover=undefined
$(BUILD)/fuzzer: $(FUZZ_SRC:%=$(BUILD)/tests/%.o) $(BUILD)/tests/fuzz_main.o $(BUILD)/libsim.a $(BUILD)/libhalfstep.a
	clang++ -fsanitize=fuzzer,address,undefined $^ -o $@ $(LIBS)

# Seconds that each target gets; two run at a time.
.PHONY: fuzz
fuzz: SECONDS := 60
fuzz: SEED := 1
fuzz: ## libFuzzer on readers, decoder, golden and model, under ASan and UBSan; SECONDS=60 each
	@$(call INSTALL,clang libclang-rt-14-dev)
	+@$(MAKE) BUILD=$(BUILD)/fuzz CC="$(FUZZ_CC)" CXX="$(subst clang,clang++,$(FUZZ_CC))" OPT=-O1 WARN=-Wall $(BUILD)/fuzz/fuzzer
	@tests/fuzz $(BUILD)/fuzz/fuzzer $(SECONDS) $(SEED)

# The RTL: as it is by default, and with three views in flight.
FUZZ_RTL_OBJ := $(BUILD)/tests/fuzz_rtl.o $(BUILD)/tests/mutate.o
$(BUILD)/fuzz_rtl: $(FUZZ_RTL_OBJ) $(RTL_LIBS)
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka
$(BUILD)/fuzz_rtl-flight: $(FUZZ_RTL_OBJ) $(BUILD)/libsim.a $(BUILD)/librtl-flight.a $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

# Streams into the default RTL, and a tenth as many into the other.
.PHONY: fuzzrtl
fuzzrtl: STREAMS := 100000
fuzzrtl: SEED := 1
fuzzrtl: $(BUILD)/fuzz_rtl $(BUILD)/fuzz_rtl-flight ## the Verilated RTL with input streams that were tampered with; STREAMS=100000
	@$(BUILD)/fuzz_rtl $(STREAMS) $(SEED)
	@$(BUILD)/fuzz_rtl-flight $$(($(STREAMS) / 10 + 1)) $(SEED)
