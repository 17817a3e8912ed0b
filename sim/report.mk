# SPDX-License-Identifier: Apache-2.0
# halfstep report: the page that it fills, and a report to look at.

PAGE := $(BUILD)/report
# Node's registry has the page's libraries; sim/report/package.json says which, and which versions.
$(PAGE)/packages: sim/report/package.json
	@command -v node >/dev/null && command -v npm >/dev/null || { $(call INSTALL,nodejs npm); }
	@mkdir -p $(@D) && cp $< $(@D)/package.json
	@cd $(@D) && npm install --no-audit --no-fund --no-package-lock --ignore-scripts --loglevel=error >/dev/null
	@touch $@

$(PAGE)/template.html: $(PAGE)/packages $(wildcard sim/report/*.js sim/report/*.css sim/report/*.html sim/report/*.mjs)
	@cp sim/report/build.mjs $(@D)
	@cd $(@D) && node build.mjs $(abspath sim/report) $(abspath $@)

# $(call WAY,N): N steps around a hand, from before it to behind it.
WAY = printf '%s\n' 'look eye -2 3 14 at 1 0 0 up 0 1 0 fov 45 near 5 far 30' 'frames $(1)' \
    'look eye 1 4 -14 at 1 0 0 up 0 1 0 fov 45 near 5 far 30'

REPORT := out/report
REPORTED := $(BUILD)/halfstep run --quiet --size 480x480
.PHONY: report
report: $(BUILD)/halfstep $(PAGE)/template.html ## out/report/report.html: a hand in 8 views, other meshes, a design space
	@mkdir -p $(REPORT)
	@$(call WAY,7) >$(REPORT)/way.txt
	@$(REPORTED) shape:hand --path $(REPORT)/way.txt --engine golden,model,rtl --out $(REPORT)
	@for mesh in cube grid:8 grid:32 grid:128 torus random:300 random:3000 monster pot; do \
	    $(REPORTED) shape:$$mesh --orbit 2 --engine model --json $(REPORT)/other-$$(echo $$mesh | tr : -).json >/dev/null || exit 1; done
	@$(BUILD)/halfstep explore shape:hand --orbit 4 --set banks=2,4,8,16 --set lanes=2,8 --set views=1,2,3 \
	    --out $(REPORT)/explore --quiet >/dev/null
	@$(BUILD)/halfstep report $(REPORT) --explore $(REPORT)/explore $$(ls $(REPORT)/other-*.json | sed 's/^/--with /')

# A report small enough for a browser that draws without a graphics card.
BROWSED := $(BUILD)/report-test
.PHONY: test-report
test-report: $(BUILD)/halfstep $(PAGE)/template.html ## the report's page in a browser: Chromium, drags, sliders, widths, themes
	@$(call INSTALL,chromium)
	@rm -rf $(BROWSED) && mkdir -p $(BROWSED)
	@$(call WAY,3) >$(BROWSED)/way.txt
	@$(BUILD)/halfstep run shape:hand --path $(BROWSED)/way.txt --front 1 --silhouette 3 --size 240x240 --quiet --out $(BROWSED)/run >/dev/null
	@$(BUILD)/halfstep explore shape:die --orbit 2 --set banks=2,8 --set lanes=2,8 --set views=1,2 --out $(BROWSED)/explore --quiet >/dev/null
	@$(BUILD)/halfstep run shape:die --engine model --quiet --json $(BROWSED)/die.json >/dev/null
	@$(BUILD)/halfstep report $(BROWSED)/run --explore $(BROWSED)/explore --with $(BROWSED)/die.json --quiet
	@cd $(PAGE) && timeout 400 node $(abspath tests/report_browser.mjs) $(abspath $(BROWSED))/run/report.html $(abspath $(BROWSED))
