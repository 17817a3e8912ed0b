# SPDX-License-Identifier: Apache-2.0
# For `make waves-png`: what GTKWave shows, as a picture, and how many signals that are. An error in here would
# leave GTKWave waiting: it is started with a limit of time.
set out [open waves.count w]
puts $out [gtkwave::getTotalNumTraces]
close $out
gtkwave::/File/Grab_To_File waves.png
gtkwave::/File/Quit
