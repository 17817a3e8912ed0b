# SPDX-License-Identifier: Apache-2.0
# The arithmetic on its own: build/test_fp, `make testfloat`, and the campaign, `make arithmetic`.

FP_SV  := $(addprefix rtl/,fp_add.sv fp_mul.sv transform.sv to_fixed.sv quantize.sv to_float.sv)
FP_DIR := $(BUILD)/fp

$(FP_DIR)/log: $(FP_SV) tests/fp_top.sv sim/rtl.mk
	$(call VERILATED,Vfp_top,--top-module fp_top $(filter %.sv,$^))

$(FP_DIR)/fp_shim.o: tests/fp_shim.cpp tests/fp_shim.h $(FP_DIR)/log
	$(CXX) $(VERILATED_FLAGS) -isystem $(@D) -c $< -o $@

FP_LIB := $(FP_DIR)/fp_shim.o $(FP_DIR)/Vfp_top__ALL.a $(RUNTIME)
$(FP_DIR)/Vfp_top__ALL.a: $(FP_DIR)/log ;

$(BUILD)/test_fp: $(BUILD)/tests/test_fp.o $(FP_LIB)
	$(CXX) $^ -o $@ -lcmocka -lz -lm -pthread


# --- Berkeley TestFloat, which Debian ships inside qemu's source ------------------------------------
# apt gets sources and lists of its own under build/: the machine's Debian mirror (whatever entry of
# its lists names this release's main suite), asked for sources instead of binaries.
TF     := $(BUILD)/testfloat
TF_GEN := $(TF)/berkeley-testfloat-3/build/Linux-x86_64-GCC/testfloat_gen
SOFTFLOAT := $(TF)/berkeley-softfloat-3/build/Linux-x86_64-GCC/softfloat.a
TF_APT := apt-get -qq -o Dir::Etc::sourcelist=/dev/null -o Dir::Etc::sourceparts=$(CURDIR)/$(TF)/apt/parts \
          -o Dir::State::lists=$(CURDIR)/$(TF)/apt/lists -o Dir::Cache=$(CURDIR)/$(TF)/apt/cache \
          -o APT::Sandbox::User=root

$(TF)/apt/parts: /etc/os-release
	@mkdir -p $@ $(TF)/apt/lists/partial $(TF)/apt/cache/archives/partial
	@. /etc/os-release; for f in /etc/apt/sources.list /etc/apt/sources.list.d/*; do test -e $$f || continue; case $$f in \
	    *.sources) awk -v suite=$$VERSION_CODENAME 'BEGIN { RS = ""; FS = "\n" } \
	        { found = 0; \
	          for (i = 1; i <= NF; i++) { n = split($$i, w, /[ \t]+/); \
	              if (w[1] == "Suites:") for (k = 2; k <= n; k++) if (w[k] == suite) found = 1 } \
	          if (found) { sub(/Types:[^\n]*/, "Types: deb-src"); print $$0 "\n" } }' $$f >>$@/debian.sources ;; \
	    *.list) awk -v suite=$$VERSION_CODENAME '$$1 == "deb" { \
	        for (k = 2; k <= NF; k++) if ($$k == suite) { $$1 = "deb-src"; print; break } }' \
	        $$f >>$@/debian.list ;; \
	    esac; done; test -s $@/debian.sources || test -s $@/debian.list || \
	    { echo "testfloat: no entry of /etc/apt names $$VERSION_CODENAME; add its deb-src line"; rm -r $@; exit 1; }

$(TF)/unpacked: | $(TF)/apt/parts
	$(TF_APT) update
	cd $(TF) && $(TF_APT) source --download-only qemu
	cd $(TF) && tar -xf $$(ls qemu_*.orig.tar.* | grep -v '[.]asc$$') --strip-components=3 --wildcards \
	    '*/tests/fp/berkeley-softfloat-3' '*/tests/fp/berkeley-testfloat-3'
	@touch $@

$(TF_GEN): $(TF)/unpacked
	$(MAKE) -s -C $(TF)/berkeley-softfloat-3/build/Linux-x86_64-GCC
	$(MAKE) -s -C $(@D) testfloat_gen

$(SOFTFLOAT): $(TF_GEN) ;
SOFTFLOAT_USERS := $(addprefix $(BUILD)/tests/,fp_testfloat.o arithmetic_floats.o)
$(SOFTFLOAT_USERS): CFLAGS += -isystem $(TF)/berkeley-softfloat-3/source/include
$(SOFTFLOAT_USERS): | $(SOFTFLOAT)

$(BUILD)/fp_testfloat: $(BUILD)/tests/fp_testfloat.o $(FP_LIB) $(SOFTFLOAT) $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lz -lm -pthread

.PHONY: testfloat
testfloat: $(TF_GEN) $(BUILD)/fp_testfloat ## Berkeley TestFloat, level 2: add, mul and conversions, of the RTL and of golden
	@tests/arithmetic_run $(TF_GEN)

# --- The campaign -----------------------------------------------------------------------------------
ARITHMETIC_PARTS := $(patsubst %,$(BUILD)/tests/arithmetic%.o,_floats _divide _facing)
$(BUILD)/tests/arithmetic_facing.o: | $(BUILD)/gmp
$(BUILD)/gmp:
	@mkdir -p $(@D)
	@$(call INSTALL,libgmp-dev)
	@touch $@

$(BUILD)/arithmetic: $(BUILD)/tests/arithmetic.o $(ARITHMETIC_PARTS) $(FP_LIB) $(SOFTFLOAT) \
    $(patsubst %,$(BUILD)/verilated/%/shim.o,divide geometry)
	$(CXX) $^ $(foreach u,divide geometry,$(BUILD)/verilated/$u/V$u__ALL.a) -o $@ -lgmp -lz -lm -pthread

# Of each operation.
OPERANDS := 100000000
SEED := 1
.PHONY: arithmetic
arithmetic: $(TF_GEN) $(BUILD)/fp_testfloat $(BUILD)/arithmetic ## RTL and golden beside TestFloat, SoftFloat, GMP; OPERANDS of each operation
	@tests/arithmetic_run $(TF_GEN) $(OPERANDS) $(SEED)
