# SPDX-License-Identifier: Apache-2.0
# What judges the files of `halfstep convert`: Khronos' validator for glTF, POV-Ray, and Assimp, which reads
# PLY and glTF. Where they cannot be had, tests say so and are skipped.

GLTF_VALIDATOR := $(BUILD)/convert/node_modules/gltf-validator
HAVE_NPM = command -v npm >/dev/null || { $(call INSTALL,nodejs npm); }

$(GLTF_VALIDATOR):
	@mkdir -p $(BUILD)/convert
	@{ $(HAVE_NPM); } && npm install --prefix $(BUILD)/convert --no-save --no-audit --no-fund --loglevel=error \
	    gltf-validator@2.0.0-dev.3.10 >/dev/null || \
	    echo "npm cannot be reached: Khronos' validator of glTF is missing, and its test will be skipped"

$(BUILD)/convert/readers:
	@mkdir -p $(@D)
	@{ $(call INSTALL,povray assimp-utils); } && touch $@ || \
	    echo "povray and assimp-utils cannot be installed: tests of convert with them will be skipped"

$(BUILD)/test_convert $(BUILD)/test_convert_files: | $(GLTF_VALIDATOR) $(BUILD)/convert/readers

.PHONY: gltf
gltf: $(BUILD)/halfstep | $(GLTF_VALIDATOR) ## out/gltf: hand, monster and die for Blender and browsers, validated
	@mkdir -p out/gltf
	@$< convert shape:hand -o out/gltf/hand.glb
	@$< convert shape:monster -o out/gltf/monster.glb
	@$< convert shape:die:11 --views docs/pictures/die.txt -o out/gltf/die.glb
	@node tests/gltf/validate.mjs $(BUILD)/convert $(addprefix out/gltf/,hand.glb monster.glb die.glb)
