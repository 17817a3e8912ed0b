# SPDX-License-Identifier: Apache-2.0
# The receive stage on its own, for each width of the port: build/test_receive, and _hostile.

RECEIVE_SV    := $(addprefix rtl/,hs_pkg.sv crc32.sv unpack.sv receive_check.sv receive_header.sv \
                 receive_verdict.sv receive.sv)
RECEIVE_PORTS := 1 2 4
RECEIVE_DIR   := $(BUILD)/receive
RECEIVE_LIB   := $(foreach p,$(RECEIVE_PORTS),$(RECEIVE_DIR)/$p/Vreceive$p__ALL.a)
RECEIVE_RUN   := $(addprefix $(RECEIVE_DIR)/1/,verilated.o verilated_threads.o)

$(RECEIVE_LIB): $(RECEIVE_DIR)/%__ALL.a: $(RECEIVE_SV)
	@mkdir -p $(@D)
	verilator --cc --build -O3 -Wall --assert --x-assign unique --x-initial unique --Mdir $(@D) \
	    --top receive --prefix $(*F) -GPORT_RECORDS=$(notdir $(@D)) -GVERTICES=512 -GQUADS=1024 \
	    -MAKEFLAGS "OPT_FAST=-O2" $^ >$(@D)/log || { cat $(@D)/log; exit 1; }
	$(MAKE) -s -C $(@D) -f $(*F).mk verilated.o verilated_threads.o

$(RECEIVE_RUN): $(firstword $(RECEIVE_LIB)) ;

$(RECEIVE_DIR)/receive_bench.o: tests/receive_bench.cpp tests/receive_bench.h $(RECEIVE_LIB)
	$(CXX) $(CXXFLAGS) $(addprefix -I$(RECEIVE_DIR)/,$(RECEIVE_PORTS)) \
	    -isystem $$(verilator --getenv VERILATOR_ROOT)/include -c $< -o $@

$(BUILD)/test_receive $(BUILD)/test_receive_hostile: $(BUILD)/test_%: $(BUILD)/tests/test_%.o \
    $(RECEIVE_DIR)/receive_bench.o $(RECEIVE_LIB) $(RECEIVE_RUN) $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lcmocka -lm -lz -pthread
