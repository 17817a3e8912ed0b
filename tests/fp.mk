# SPDX-License-Identifier: Apache-2.0
# The floating-point modules on their own: build/test_fp, and `make testfloat`.

FP_SV  := $(addprefix rtl/,fp_add.sv fp_mul.sv transform.sv to_fixed.sv quantize.sv to_float.sv)
FP_DIR := $(BUILD)/fp

$(FP_DIR)/Vfp_top__ALL.a: $(FP_SV) tests/fp_top.sv | $(BUILD)/packages
	@mkdir -p $(@D)
	verilator --cc --build -O3 -Wall --Mdir $(@D) --top fp_top -MAKEFLAGS "OPT_FAST=-O2" $^ >$(@D)/log \
	    || { cat $(@D)/log; exit 1; }
	$(MAKE) -s -C $(@D) -f Vfp_top.mk verilated.o verilated_threads.o

$(FP_DIR)/fp_shim.o: tests/fp_shim.cpp tests/fp_shim.h $(FP_DIR)/Vfp_top__ALL.a
	$(CXX) $(CXXFLAGS) -I$(FP_DIR) -isystem $$(verilator --getenv VERILATOR_ROOT)/include -c $< -o $@

FP_LIB := $(addprefix $(FP_DIR)/,fp_shim.o Vfp_top__ALL.a verilated.o verilated_threads.o)
$(FP_DIR)/verilated.o $(FP_DIR)/verilated_threads.o: $(FP_DIR)/Vfp_top__ALL.a ;

$(BUILD)/test_fp: $(BUILD)/tests/test_fp.o $(FP_LIB)
	$(CXX) $^ -o $@ -lcmocka -lm -pthread

