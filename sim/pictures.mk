# SPDX-License-Identifier: Apache-2.0
# The pictures of README.md and docs/. They are kept in the tree, so that one sees them before
# anything is built. Each is what one command draws, which may be typed by hand as well.

PICTURE := $(BUILD)/halfstep render --quiet

.PHONY: pictures
pictures: $(BUILD)/halfstep ## docs/pictures/*.png, the pictures of README.md and docs/, anew
	$(PICTURE) shape:hand --what triptych --turn 125 --size 400x440 -o docs/pictures/hand.png
	$(PICTURE) shape:monster --what triptych --size 400x440 -o docs/pictures/monster.png
	$(PICTURE) shape:hand --what steps --size 256x280 -o docs/pictures/steps.png
	$(PICTURE) shape:grid:14 --what ramp --silhouette 6 --views docs/pictures/ramp.txt \
	    --size 448x448 -o docs/pictures/ramp.png
	$(PICTURE) shape:monster --what facing-side --turn 60 --size 448x448 -o docs/pictures/facing.png
	$(PICTURE) shape:hand --what closeup-side --turn 100 --size 448x448 -o docs/pictures/closeup.png
	$(PICTURE) shape:pot --what triptych --turn 60 --size 400x320 -o docs/pictures/pot.png
	$(PICTURE) shape:spoon --what refined-wires --boundary kept --views docs/pictures/spoon.txt \
	    --size 360x420 -o docs/pictures/spoon-kept.png
	$(PICTURE) shape:spoon --what refined-wires --views docs/pictures/spoon.txt \
	    --size 360x420 -o docs/pictures/spoon-smooth.png
	$(PICTURE) shape:die:1 --views docs/pictures/die.txt --size 300x300 -o docs/pictures/die-0.png
	$(PICTURE) shape:die:2 --views docs/pictures/die.txt --size 300x300 -o docs/pictures/die-1.png
	$(PICTURE) shape:die:3 --views docs/pictures/die.txt --size 300x300 -o docs/pictures/die-2.png
	$(PICTURE) shape:die:11 --views docs/pictures/die.txt --size 300x300 \
	    -o docs/pictures/die-for-ever.png
	mkdir -p docs/figures
	$(BUILD)/halfstep run shape:hand --engine model --quiet --timeline-svg docs/figures/timeline.svg >/dev/null

# The paper's figure 12: the same surfaces by a ray tracer, with shadows.
POV := hand monster die
POV_SIZE := 640
POV_hand    := shape:hand
POV_monster := shape:monster
POV_die     := shape:die:1 --views docs/pictures/die.txt

.PHONY: pov
pov: $(POV:%=out/pov/%.png) ## out/pov: hand, monster head and die by POV-Ray (the paper's figure 12)

.PRECIOUS: out/pov/%.pov
$(POV:%=out/pov/%.pov): out/pov/%.pov: $(BUILD)/halfstep
	@mkdir -p $(@D)
	@$< convert $(POV_$*) --size $(POV_SIZE)x$(POV_SIZE) -o $@

out/pov/%.png: out/pov/%.pov
	@$(call INSTALL,povray)
	@povray +W$(POV_SIZE) +H$(POV_SIZE) +A0.1 -D +I$< +O$(@D)/part-$*.png >$(@D)/$*.log 2>&1 || \
	    { tail -5 $(@D)/$*.log; exit 1; }
	@mv $(@D)/part-$*.png $@
	@echo "$@: $(POV_SIZE)x$(POV_SIZE) pixels"
