# SPDX-License-Identifier: Apache-2.0
# What `make install` installs has to be there before the test installs it.

$(BUILD)/test_install: | installable $(BUILD)/halfstep-faulty
