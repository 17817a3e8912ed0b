# SPDX-License-Identifier: Apache-2.0
# `make help` lists what there is to make.

BUILD     := build
CC        := gcc
CXX       := g++
OPT       := -O2
WARN      := -Wall -Wextra -Wconversion -Werror
CFLAGS    := -std=gnu17 -g $(OPT) $(WARN) -ffp-contract=off -Imodel -Isim -MMD -MP
CXXFLAGS  := -std=c++17 -g $(OPT) -Wall -Wextra -Werror -Imodel -Isim -MMD -MP
LIBS      := -lOSMesa -lpng -ljansson -lz -lm

MODEL_OBJ := $(patsubst %.c,$(BUILD)/%.o,$(wildcard model/*.c))
SIM_OBJ   := $(patsubst %.c,$(BUILD)/%.o,$(filter-out sim/main.c sim/gen_pkg.c,$(wildcard sim/*.c)))
TESTS     := $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/test_*.c))

.PHONY: all
all: $(BUILD)/halfstep ## build/halfstep, the program (the default)

$(BUILD)/%.o: %.c | $(BUILD)/packages
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -c $< -o $@

$(BUILD)/libhalfstep.a: $(MODEL_OBJ)
	rm -f $@ && ar rcs $@ $^

$(BUILD)/libsim.a: $(SIM_OBJ)
	rm -f $@ && ar rcs $@ $^

# The RTL's package of constants is written from definitions.def and kept in the tree, so that
# rtl/ can be used without building anything.
$(BUILD)/gen_pkg: sim/gen_pkg.c model/definitions.def | $(BUILD)/packages
	$(CC) $(CFLAGS) $< -o $@

# Copied only if they differ, so that timestamps stay.
rtl/hs_pkg.sv docs/reference.md: $(BUILD)/generated
	@cmp -s $(BUILD)/gen/$(@F) $@ || cp $(BUILD)/gen/$(@F) $@
$(BUILD)/generated: $(BUILD)/gen_pkg
	@mkdir -p $(BUILD)/gen && $< sv >$(BUILD)/gen/hs_pkg.sv && $< md >$(BUILD)/gen/reference.md
	@touch $@

$(BUILD)/%: $(BUILD)/tests/%.o $(BUILD)/libsim.a $(BUILD)/libhalfstep.a
	$(CXX) $^ -o $@ -lcmocka $(LIBS)

# Programs that ask OpenSubdiv for a second opinion, through tests/osd.h.
OSD_USERS := $(BUILD)/test_reference
$(BUILD)/tests/osd.o: tests/osd.cpp | $(BUILD)/packages
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -c $< -o $@
$(OSD_USERS): $(BUILD)/tests/osd.o
$(OSD_USERS): LIBS += -losdCPU

include tests/fp.mk tests/receive.mk

# What a bare Debian 12 misses; the stamp keeps later runs from asking again.
PACKAGES := gcc g++ make verilator yosys libosmesa6-dev libosd-dev libcmocka-dev libjansson-dev \
            libpng-dev zlib1g-dev clang-format cppcheck
$(BUILD)/packages:
	@mkdir -p $(@D)
	@missing=; for p in $(PACKAGES); do \
	    dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
	if [ -n "$$missing" ]; then echo "installing the packages that are missing:$$missing"; \
	    apt-get -qq update && apt-get -qq install -y --no-install-recommends $$missing >/dev/null; fi
	@touch $@

include sim/rtl.mk
-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
