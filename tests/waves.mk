# SPDX-License-Identifier: Apache-2.0
# Waveforms, as one wants to see them: a window of one view, in GTKWave, signals grouped by stage, states and
# activities by name, positions as numbers, markers where generations and stages begin.

# Which view of which mesh; GEN: that generation, and some cycles around; CYCLES=FIRST:LAST: those instead.
# RUN: further options of `halfstep run`, as in RUN="--front 2 --stalls 0,50".
MESH   := shape:hand
ORBIT  := 8
VIEW   := 0
GEN    := 0
CYCLES :=
RUN    :=
WAVES  := out/waves
SHOW   := window

$(BUILD)/waves: $(BUILD)/tests/waves.o $(BUILD)/libsim.a $(BUILD)/libhalfstep.a
	$(CC) $^ -o $@ -ljansson -lz -lm
$(BUILD)/waves_filter: $(BUILD)/tests/waves_filter.o
	$(CC) $^ -o $@ -lm

# The model finds the cycles of the generation, the RTL writes the waveform of these alone.
VIEWED = $(BUILD)/halfstep run $(MESH) --orbit $(ORBIT) --view $(VIEW) --quiet $(RUN)
.PHONY: waves-files
waves-files: $(BUILD)/halfstep $(BUILD)/waves $(BUILD)/waves_filter
	@rm -rf $(WAVES) && mkdir -p $(WAVES)
	@$(VIEWED) --engine model --timeline $(WAVES)/timeline.json --json $(WAVES)/run.json >$(WAVES)/model.txt
	@cycles=$(CYCLES); test "$$cycles" || cycles=$$($(BUILD)/waves $(SHOW) $(WAVES)/timeline.json $(GEN)) || exit; \
	    $(VIEWED) --engine rtl --wave $(WAVES)/waves.fst --wave-cycles $$cycles >$(WAVES)/rtl.txt && \
	    $(BUILD)/waves save $(WAVES) $(WAVES)/timeline.json $(WAVES)/run.json $(WAVES)/waves.fst $$cycles && \
	    echo "cycles $$cycles of view $(VIEW) of $(MESH): gtkwave $(WAVES)/waves.fst $(WAVES)/waves.gtkw"

.PHONY: waves
waves: waves-files ## GTKWave with a window of a view: MESH=, VIEW=3 GEN=2, or CYCLES=FIRST:LAST
	@$(call INSTALL,gtkwave)
	@if [ "$$DISPLAY$$WAYLAND_DISPLAY" ]; then gtkwave $(WAVES)/waves.fst $(WAVES)/waves.gtkw; \
	    else echo "there is no display to open it on"; fi

# The picture of docs/timeline.md: the beginning of a generation. A signal that GTKWave does not find it leaves out
# and says nothing: so they are counted.
.PHONY: waves-png
waves-png: ## docs/figures/waves.png, what GTKWave shows of a window, without a display
	@$(call INSTALL,gtkwave xvfb xauth)
	@$(MAKE) --no-print-directory waves-files WAVES=$(BUILD)/waves-png GEN=3 SHOW=begin
	@cp tests/waves_png.tcl $(BUILD)/waves-png && cd $(BUILD)/waves-png && \
	    timeout 60 xvfb-run -a -s "-screen 0 1320x1300x24 -br" gtkwave waves.fst waves.gtkw --script waves_png.tcl >gtkwave.log 2>&1 || \
	    { cat $(BUILD)/waves-png/gtkwave.log; exit 1; }
	@shown=$$(cat $(BUILD)/waves-png/waves.count); named=$$(grep -cE '^(TOP|[+#]\{|-)' $(BUILD)/waves-png/waves.gtkw); \
	    test $$shown = $$named || { echo "GTKWave shows $$shown of $$named rows: tests/waves.c names signals that are not there"; exit 1; }
	@mkdir -p docs/figures && cp $(BUILD)/waves-png/waves.png docs/figures/waves.png && ls -l docs/figures/waves.png

# This test runs programs.
$(BUILD)/test_waves: | $(BUILD)/halfstep $(BUILD)/waves $(BUILD)/waves_filter
