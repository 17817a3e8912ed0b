# SPDX-License-Identifier: Apache-2.0
# The pictures of README.md and docs/. They are kept in the tree, so that one sees them before
# anything is built. Each is what one command draws, which may be typed by hand as well.

PICTURE := $(BUILD)/halfstep render --quiet

.PHONY: pictures
pictures: $(BUILD)/halfstep ## docs/pictures/*.png, the pictures of README.md and docs/, anew
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

# The paper's figures: docs/figures.md says how each is drawn, and has its numbers. Of a picture
# 200 colours are kept, which nobody sees, in a third of the bytes.
.PHONY: figures
figures: $(BUILD)/halfstep $(BUILD)/figures_page out/pov/hand.png out/pov/monster.png ## docs/figures, the paper's figures made again, and docs/figures.md's numbers
	@$(call INSTALL,pngquant)
	@$(BUILD)/figures_page docs/figures.md
	@cp out/pov/hand.png docs/figures/12-hand.png && cp out/pov/monster.png docs/figures/12-monster.png
	@pngquant --force --ext .png --speed 1 --strip 200 docs/figures/[0-9]*.png
	@du -cb docs/figures/[0-9]*.png

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

# The hand on a turntable: refined anew for each of 120 viewpoints. Equal frames in a row would be
# merged, so as many frames as views means that each differs from the one before.
SPIN := $(BUILD)/spin
SPIN_VIEWS := 120
.PHONY: spin
spin: $(BUILD)/halfstep ## docs/pictures/spin.webp, the hand refined for an eye that goes round it
	@$(call INSTALL,webp)
	@rm -rf $(SPIN) && mkdir -p $(SPIN)
	@seq -w 0 $$(($(SPIN_VIEWS) - 1)) | xargs -P $$(nproc) -I NUMBER $(PICTURE) shape:hand --what turntable \
	    --orbit $(SPIN_VIEWS) --view NUMBER --size 320x340 -o $(SPIN)/NUMBER.png
	@img2webp -loop 0 -lossy -q 65 -m 6 -d 80 $(SPIN)/*.png -o $(SPIN)/spin.webp
	@webpmux -info $(SPIN)/spin.webp | grep -qx 'Number of frames: $(SPIN_VIEWS)' || \
	    { echo "$(SPIN)/spin.webp: not $(SPIN_VIEWS) frames that differ"; exit 1; }
	@mv $(SPIN)/spin.webp docs/pictures/spin.webp && ls -l docs/pictures/spin.webp
