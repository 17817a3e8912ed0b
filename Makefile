# SPDX-License-Identifier: Apache-2.0
# `make help` lists what there is to make.

BUILD     := build
.DEFAULT_GOAL := all
.SECONDARY:
ifeq ($(MAKELEVEL),0)
MAKEFLAGS += -j$(shell nproc)
endif

# What a bare Debian 12 misses is installed before anything else is looked at: packages.mk is
# included, so make brings it up to date first and then reads everything again.
PACKAGES := gcc g++ clang make git verilator yosys libosmesa6-dev libosd-dev libcmocka-dev libjansson-dev \
            libpng-dev zlib1g-dev pkg-config clang-format cppcheck
# $(call INSTALL,NAMES): those of the packages that are missing, with sudo unless root.
INSTALL = missing=; for p in $(1); do \
    dpkg-query -W -f='$${Status}' $$p 2>/dev/null | grep -q 'ok installed' || missing="$$missing $$p"; done; \
    if [ -n "$$missing" ]; then echo "installing the packages that are missing:$$missing"; \
    test $$(id -u) = 0 || sudo=sudo; export DEBIAN_FRONTEND=noninteractive; \
    $$sudo apt-get -qq update && $$sudo apt-get -qq install -y --no-install-recommends $$missing >/dev/null; fi
$(BUILD)/packages.mk:
	@mkdir -p $(@D)
	@$(call INSTALL,$(PACKAGES))
	@echo "# packages are there: $(PACKAGES)" >$@
ifeq ($(filter clean help,$(MAKECMDGOALS)),)
include $(BUILD)/packages.mk
endif
CC        := gcc
CXX       := g++
OPT       := -O2
WARN      := -Wall -Wextra -Wconversion -Werror
CFLAGS    := -std=gnu17 -g $(OPT) $(WARN) -ffp-contract=off -Imodel -Isim -MMD -MP
CXXFLAGS  := -std=c++17 -g $(OPT) -Wall -Wextra -Werror -Imodel -Isim -MMD -MP
LIBS      := -lOSMesa -lpng -ljansson -lz -lm

MODEL_OBJ := $(patsubst %.c,$(BUILD)/%.o,$(wildcard model/*.c))
SIM_OBJ   := $(patsubst %.c,$(BUILD)/%.o,$(filter-out sim/main.c sim/gen_pkg.c,$(wildcard sim/*.c)))
TESTS     := $(patsubst tests/%.c,$(BUILD)/%,$(wildcard tests/test_*.c)) $(BUILD)/test_smallest

.PHONY: all
all: $(BUILD)/halfstep ## build/halfstep, the program (the default)

$(BUILD)/%.o: %.c
	@mkdir -p $(@D)
	$(CC) $(CFLAGS) -c $< -o $@

$(BUILD)/libhalfstep.a: $(MODEL_OBJ)
	rm -f $@ && ar rcs $@ $^

$(BUILD)/libsim.a: $(SIM_OBJ)
	rm -f $@ && ar rcs $@ $^

# The RTL's package of constants is written from definitions.def and kept in the tree, so that
# rtl/ can be used without building anything.
$(BUILD)/gen_pkg: sim/gen_pkg.c model/definitions.def
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
OSD_USERS := $(BUILD)/test_reference $(BUILD)/test_reference_creases $(BUILD)/test_reference_limit
$(BUILD)/tests/osd.o: tests/osd.cpp
	@mkdir -p $(@D)
	$(CXX) $(CXXFLAGS) -c $< -o $@
$(OSD_USERS): $(BUILD)/tests/osd.o
$(OSD_USERS): LIBS += -losdCPU

include sim/rtl.mk sim/pictures.mk sim/report.mk sim/install.mk $(wildcard tests/*.mk)

# --- What there is to do --------------------------------------------------------------------------
.PHONY: run test lint format clean help
# Side by side: the RTL is one thread, and so is most of what draws.
run: $(BUILD)/halfstep ## the main job: hand and monster head, 8 views each, through the RTL
	+@$(MAKE) -s --output-sync=target run-hand run-monster
.PHONY: run-hand run-monster
run-hand run-monster: run-%: $(BUILD)/halfstep
	@$< run shape:$* --orbit 8 --out out/$*

# The longest first, so that none of them runs alone at the end.
LONGEST := $(addprefix $(BUILD)/test_,rtl rtl_surface harness cli invariants processes terminal install)
test: $(BUILD)/halfstep $(TESTS) ## all tests; logs in build/test-logs
	@tests/run $(LONGEST) $(filter-out $(LONGEST),$(TESTS))

# The tests that are C alone, in a build of their own. OSMesa keeps some memory for good.
SANITIZER := -fsanitize=address,undefined -fno-sanitize-recover=undefined
SANITIZED := golden golden_rules golden_hostile memory mesh obj file stream frame view shape picture render \
             reference reference_creases reference_limit reference_replay report report_mesh convert timeline \
             timeline_files fuzz
sanitize: ## the tests of the C code under ASan and UBSan
	+@$(MAKE) BUILD=$(BUILD)/sanitize CC="gcc $(SANITIZER)" CXX="g++ $(SANITIZER)" OPT=-O1 sanitized
.PHONY: sanitize sanitized
sanitized: $(SANITIZED:%=$(BUILD)/test_%)
	@ASAN_OPTIONS=allocator_may_return_null=1 LSAN_OPTIONS=suppressions=tests/leaks.supp:print_suppressions=0 TEST_SECONDS=1200 tests/run $^

LINT_C := $(wildcard model/*.[ch] sim/*.[ch] tests/*.[ch] tests/*/*.[ch])
LINT_CPP := $(wildcard sim/*.cpp tests/*.cpp tests/*/*.cpp)
lint: rtl/hs_pkg.sv docs/reference.md ## Verilator, Yosys, clang-format, cppcheck, licence lines
	@for r in 1 2 4; do echo "verilator -Wall, $$r records a beat"; \
	    verilator --lint-only -Wall -GPORT_RECORDS=$$r -f rtl/files.f --top-module halfstep || exit 1; done
	@for a in smallest largest flight; do echo "verilator -Wall, $$a architecture"; done
	@verilator --lint-only -Wall $(smallest) -f rtl/files.f --top-module halfstep
	@verilator --lint-only -Wall $(largest) -f rtl/files.f --top-module halfstep
	@verilator --lint-only -Wall $(flight) -f rtl/files.f --top-module halfstep
	@echo "yosys check"
	@yosys -q -p "read_verilog -sv $$(tr '\n' ' ' <rtl/files.f); \
	    chparam -set VERTICES 1024 -set QUADS 1024 -set WINDOW_BITS 1 -set BANK_BITS 2 halfstep; \
	    hierarchy -check -top halfstep; proc; check -assert" >$(BUILD)/yosys.log 2>&1 || \
	    { cat $(BUILD)/yosys.log; exit 1; }
	@! grep -v 'Replacing memory' $(BUILD)/yosys.log
	@test "$$(grep -v hs_pkg rtl/files.f)" = "$$(ls rtl/*.sv | grep -v hs_pkg)" || \
	    { echo "rtl/files.f does not list every module"; exit 1; }
	@echo "clang-format"
	@clang-format --dry-run -Werror $(LINT_C) $(LINT_CPP)
	@echo "cppcheck"
	@cppcheck -q --error-exitcode=1 --std=c11 --enable=warning,performance,portability --inline-suppr \
	    --suppress=missingIncludeSystem -Imodel -Isim $(wildcard model/*.c sim/*.c)
	@echo "licence lines"
	@! git ls-files model sim rtl tests Makefile | grep -vE '\.(txt|gp|supp|breaks|narrow|f)$$|^tests/corpus/|hs_pkg.sv$$' | \
	    xargs grep -L SPDX-License-Identifier | grep .
	@git diff --exit-code --stat rtl/hs_pkg.sv docs/reference.md || \
	    { echo "generated files differ from model/definitions.def: commit them"; exit 1; }
	@echo "lint: clean"

format: ## clang-format, in place
	clang-format -i $(LINT_C) $(LINT_CPP)

clean: ## removes build/ and out/
	rm -rf $(BUILD) out

help: ## this list
	@grep -hE '^[a-z-]+:.*##' $(MAKEFILE_LIST) | sort -u | sed -E 's/^([a-z-]+):.*## (.*)/  make \1\t\2/' | expand -t 18

-include $(shell find $(BUILD) -name '*.d' 2>/dev/null)
