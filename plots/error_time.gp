# SPDX-License-Identifier: MIT
# Error against frame time: a panel for each scene, a colour for each method, a point for each trial.
#
#     irbench table RUN --format csv > run.csv
#     gnuplot -e "csv='run.csv'; out='run.svg'" plots/error_time.gp
#     gnuplot -e "csv='run.csv'; out='run.png'; metric='indirect_flip'" plots/error_time.gp
#
# out ends in .svg or .png; metric is a column of the table, indirect_relmse by default. Columns are
# found by name, so that new ones do not move them.
if (!exists("csv")) { print "usage: gnuplot -e \"csv='run.csv'; out='run.svg'\" plots/error_time.gp"; exit status 2 }
if (!exists("out")) out = "error_time.svg"
if (!exists("metric")) metric = "indirect_relmse"
set datafile separator comma
set datafile missing ""
set datafile columnheaders

# names of scenes and methods, in the order in which they come
scenes = ""; methods = ""; trials = ""
name(column) = sprintf(" %s ", strcol(column))
add(list, name) = strstrt(list, name) ? list : list . name
stats csv using (scenes = add(scenes, name("scene")), methods = add(methods, name("method")), \
                 trials = add(trials, name("trial")), 1) nooutput
panels = words(scenes)

# one panel has its key beside it; several share one in a cell of their own
columns = panels > 1 ? 2 : 1
rows = panels > 1 ? (panels + 2) / 2 : 1
width = panels > 1 ? 1160 : 960
height = panels > 1 ? 420 * rows : 560
if (out[strlen(out)-2:] eq "png") {
    set terminal pngcairo size width,height font "DejaVu Sans,10"
} else {
    set terminal svg size width,height dynamic font "DejaVu Sans,11"
}
set output out
set logscale xy
set format "%g"
set xlabel "frame time, median (ms)"
set ylabel metric noenhanced
do for [k=-9:9] {
    do for [d in "1 2 5"] { set xtics add (sprintf("%g", d * 10.0**k) d * 10.0**k) }
    do for [d in "1 1.5 2 3 4 5 7"] { set ytics add (sprintf("%g", d * 10.0**k) d * 10.0**k) }
}
set grid lt 1 lc rgb "#dddddd"
set key outside right top Left reverse noenhanced font ",8"
set autoscale fix
set offsets graph 0.06, graph 0.06, graph 0.08, graph 0.08
# Okabe and Ito's palette, safe for colour-blind readers (jfly.uni-koeln.de/color, 2008)
array colour[8] = ["#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#F0E442", "#000000"]
# number of a trial among those of its method: its symbol
of(trial) = (trial[1:strstrt(trial . ":", ":") - 1])
rank(i) = (sum [j=1:i] of(word(trials, j)) eq of(word(trials, i)))
method_of(i) = (sum [j=1:words(methods)] of(word(trials, i)) eq word(methods, j) ? j : 0)
here(scene, trial, value) = strcol("scene") eq scene && strcol("trial") eq trial ? value : NaN

style(i) = 3 + rank(i)
shade(i) = colour[(method_of(i) - 1) % 8 + 1]

set multiplot layout rows, columns
if (panels > 1) { unset key }
do for [s=1:panels] {
    scene = word(scenes, s)
    set title scene noenhanced
    plot for [i=1:words(trials)] csv \
         using "frame_ms":(here(scene, word(trials, i), column(metric))) \
         with points pt style(i) ps 1.3 lw 2 lc rgb shade(i) title word(trials, i)
}
if (panels > 1) {
    unset title; unset xlabel; unset ylabel; unset xtics; unset ytics; unset grid; unset border
    set key inside left top Left reverse noenhanced font ",9"
    plot [1:2] [1:2] for [i=1:words(trials)] NaN \
         with points pt style(i) ps 1.3 lw 2 lc rgb shade(i) title word(trials, i)
}
unset multiplot
