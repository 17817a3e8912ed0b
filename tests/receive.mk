# SPDX-License-Identifier: Apache-2.0
# The receive stage on its own, for each width of the port: build/test_receive, and _hostile.

RECEIVE_SV    := $(addprefix rtl/,hs_pkg.sv crc32.sv unpack.sv receive_check.sv receive_header.sv \
                 receive_verdict.sv receive.sv)
RECEIVE_PORTS := 1 2 4
RECEIVE_DIR   := $(BUILD)/receive
RECEIVE_LIB   := $(foreach p,$(RECEIVE_PORTS),$(RECEIVE_DIR)/$p/Vreceive$p__ALL.a)

$(RECEIVE_PORTS:%=$(RECEIVE_DIR)/%/log): $(RECEIVE_DIR)/%/log: $(RECEIVE_SV) sim/rtl.mk
	$(call VERILATED,Vreceive$*,--x-assign unique --top-module receive -GPORT_RECORDS=$* -GVERTICES=512 -GQUADS=1024 \
	    $(RECEIVE_SV))

$(RECEIVE_LIB): $(RECEIVE_PORTS:%=$(RECEIVE_DIR)/%/log) ;

$(RECEIVE_DIR)/receive_bench.o: tests/receive_bench.cpp tests/receive_bench.h $(RECEIVE_PORTS:%=$(RECEIVE_DIR)/%/log)
	$(CXX) $(VERILATED_FLAGS) $(addprefix -isystem $(RECEIVE_DIR)/,$(RECEIVE_PORTS)) -c $< -o $@

$(BUILD)/test_receive $(BUILD)/test_receive_hostile: $(BUILD)/test_%: $(BUILD)/tests/test_%.o \
    $(RECEIVE_DIR)/receive_bench.o $(RECEIVE_LIB) $(RUNTIME) $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lcmocka -lm -lz -pthread
