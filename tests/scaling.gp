# SPDX-License-Identifier: Apache-2.0
# Cycles against output faces, of out/bench/scaling.csv, and the expected ones as lines.
set datafile separator ","
set terminal pngcairo size 900,620 font "sans,11"
set output "out/bench/scaling.png"
set logscale xy
set format x "10^{%L}"
set format y "10^{%L}"
set xlabel "output faces"
set ylabel "cycles of a view"
set key left top
set grid
f = "out/bench/scaling.csv"
uniform(n) = sprintf("< awk -F, '$1 >= %d && $1 <= %d && $2 ~ /uniform/' %s", n * 0.8, n * 1.2, f)
views = sprintf("< awk -F, '$2 ~ /\\//' %s", f)
plot NaN with lines lc rgb "gray" title "expected (docs/timing.md)", \
     for [n in "100 1000 10000 100000"] uniform(n + 0) using 4:6 with lines lc rgb "gray" notitle, \
     for [i = 2:5] uniform(10 ** i) using 4:5 with points pt i + 3 title sprintf("uniform, from about 10^%d faces", i), \
     views using 4:5 with points pt 3 lc rgb "black" title "view-dependent, 4/8 and 2/4"
