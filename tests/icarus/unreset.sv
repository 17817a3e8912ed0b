// SPDX-License-Identifier: Apache-2.0
//
// For a copy of the RTL in which the resets of any one module can be taken away at run time: each `rst_i`
// in it asks here first (tests/icarus.mk). Registers then keep the random contents they start with.

package unreset;
  import "DPI-C" function bit hs_unreset(input string name);
endpackage
