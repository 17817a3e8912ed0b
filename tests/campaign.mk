# SPDX-License-Identifier: Apache-2.0
# The differential campaign: random cases through all engines (tests/campaign.c).

CAMPAIGN_OBJ := $(patsubst %,$(BUILD)/tests/campaign_%.o,case check coverage faults polygons shrink trace) \
                $(BUILD)/tests/invariants.o

# How many cases, from which seed on, in how many processes.
CASES := 10000
SEED  := 1
JOBS  := 2

.PHONY: campaign
campaign: $(BUILD)/campaign ## random meshes x views x settings x stalls, all engines: CASES=, SEED=, JOBS=
	@$< --seed $(SEED) --cases $(CASES) --jobs $(JOBS)

$(BUILD)/campaign: $(BUILD)/tests/campaign.o $(CAMPAIGN_OBJ) $(RTL_LIBS)
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka

$(BUILD)/test_campaign: $(BUILD)/tests/test_campaign.o $(CAMPAIGN_OBJ) $(RTL_LIBS)
	$(CXX) $^ -o $@ $(LIBS) -pthread -lcmocka
