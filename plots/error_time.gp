# SPDX-License-Identifier: MIT
# Error against frame time, one point a trial:
#
#     irbench table RUN --format csv > run.csv
#     gnuplot -e "csv='run.csv'; out='run.svg'" plots/error_time.gp
#
# out may end in .svg or .png. Columns are found by name, so that new metrics do not move them.
if (!exists("csv")) { print "usage: gnuplot -e \"csv='run.csv'; out='run.svg'\" plots/error_time.gp"; exit status 2 }
if (!exists("out")) out = "error_time.svg"
if (out[strlen(out)-2:] eq "png") {
    set terminal pngcairo size 960,600 font "DejaVu Sans,11"
} else {
    set terminal svg size 960,600 dynamic font "DejaVu Sans,13"
}
set output out
set datafile separator comma
set datafile missing ""
set datafile columnheaders
set logscale xy
set format "%g"
set xlabel "frame time, median (ms)"
set ylabel "indirect relMSE against bounce 1"
set grid lc rgb "#dddddd"
set key outside right top noenhanced spacing 1.1
set offsets graph 0.05, graph 0.05, graph 0.1, graph 0.1
# Okabe and Ito's palette, safe for colour-blind readers (jfly.uni-koeln.de/color, 2008)
array colour[8] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#F0E442", "#000000"]
array trial[1000]
stats csv using (trial[int($0) + 1] = strcol("trial"), 1) nooutput
rows = int(STATS_records)
plot for [i=1:rows] csv every ::(i - 1)::(i - 1) using "frame_ms":"indirect_relmse" \
     with points pt (4 + 2 * ((i - 1) / 8) + i % 2) ps 1.4 lw 2 lc rgb colour[(i - 1) % 8 + 1] title trial[i]
