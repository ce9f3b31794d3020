# SPDX-License-Identifier: MIT
# Flicker of each trial with its interval, and beside it the share of pixels that pop: for each scene
# a panel, a row a trial. The dashed line is what the flicker that the reference's own noise makes stays
# below, by an unknown amount.
#
#     gnuplot -e "csv='flicker.csv'; out='flicker.svg'" plots/flicker.gp
#
# For all else see style.gp.
figure = "flicker"
folder = ARG0[1:strstrt(ARG0, "flicker.gp")-1]
item_text(x) = strcol("trial")
load folder . "style.gp"

array X[rows]; array X0[rows]; array X1[rows]; array pops[rows]; array noise[rows]
end_of(x, value) = x == x ? x : value
r = 0
enter(x) = (r = r + 1, X[r] = x, X0[r] = end_of(column("low"), x), X1[r] = end_of(column("high"), x), \
    pops[r] = column("pop_share"), noise[r] = column("reference_flicker"), 1)
stats csv using (enter(column("flicker"))) nooutput
eval end_of_csv

array key_text[methods]; array key_item[methods]; array key_kind[methods]
key_entries = methods
do for [m=1:methods] {
    key_text[m] = method_name[m]; key_kind[m] = 1
    do for [i=1:items] { if (item_method[i] == m) { key_item[m] = i } }
}
note = "Flicker is relative to the mean of the reference. " . \
    "Dashed: what the reference's own noise stays below. Bars: 95 % intervals. " . \
    "Pops: pixels whose error jumps by more than 10 % from one frame to the next."
if (sum [i=1:rows] (row_scene[i] && X[i] == 0)) { note = note . zero_note }
load folder . "rows.gp"
panel_width = scenes > 2 ? 320 : scenes > 1 ? 400 : 600
load folder . "page.gp"

unset grid
# distance of labels of which each has some 40 pixels
step(x, pixels) = (n = x * 40.0 / pixels, n > 20 ? 50 : n > 10 ? 20 : n > 5 ? 10 : n > 2 ? 5 : \
    n > 1 ? 2 : n > 0.5 ? 1 : x > 0 ? x / 2 : 1)
at_x(x) = x > x0 ? x : x0
on(r, s) = row_scene[r] == s && X[r] == X[r]
do for [s=1:scenes] {
    x0 = NaN; x1 = NaN; most = 0; line = NaN
    do for [r=1:rows] {
        if (row_scene[r] == s) {
            x0 = smaller(smaller(smaller(x0, X[r]), X0[r]), noise[r])
            x1 = larger(larger(larger(x1, X[r]), X1[r]), noise[r])
            most = pops[r] > most ? pops[r] : most
            line = smaller(line, noise[r])
        }
    }
    if (x0 != x0) { x0 = 1; x1 = 1 }
    x0 = x0 / 1.25; x1 = x1 * 1.25
    split = panel_left(s) + 0.68 * (panel_right(s) - panel_left(s))
    set print $dots
    do for [m=1:methods] {
        print "NaN NaN NaN NaN NaN"
        do for [r=1:rows] {
            if (on(r, s) && item_method[row_item[r]] == m) {
                print sprintf("%.9g %g %.9g %.9g %.9g", at_x(X[r]), row_y(row_item[r]), \
                    at_x(X0[r]), at_x(X1[r]), pops[r])
            }
        }
        print ""; print ""
    }
    unset print

    eval place(panel_left(s), split - 6, panel_top(s), panel_bottom(s))
    if ((s - 1) % columns == 0) { eval names }
    set title scene_name[s] noenhanced font font . " Bold,10" tc rgb ink offset 0,-0.4
    set logscale x
    set xrange [x0:x1]
    eval log_tics("x", x0, x1, split - 6 - panel_left(s))
    set grid xtics lt 1 lw 0.6 lc rgb faint
    set xlabel "flicker (of mean reference)" offset 0,0.3
    do for [i=1:items] {
        set arrow 1000+i from graph 0, first row_y(i) to graph 1, first row_y(i) nohead back \
            lw 0.6 dt 3 lc rgb faint
    }
    if (line == line) { set arrow 999 from line, graph 0 to line, graph 1 nohead front lw 1.2 dt 2 lc rgb ink }
    plot for [m=1:methods] $dots index m-1 using 1:2:3:4 title method_name[m] noenhanced \
            with xerrorbars pt -1 lw 1.2 lc rgb colour(key_item[m]), \
        for [m=1:methods] $dots index m-1 using 1:2 title method_name[m] noenhanced \
            with points pt filled(key_item[m]) ps 0.8*symbol_scale*size_of(filled(key_item[m])) lc rgb colour(key_item[m])
    unset label; unset arrow 999; unset title

    eval place(split + 6, panel_right(s), panel_top(s), panel_bottom(s))
    unset logscale x
    eval tics_of("x")
    set xtics step(100 * most, panel_right(s) - split)
    set xlabel "pops (%)" offset 0,0.3
    set xrange [0:most > 0 ? 108 * most : 1]
    plot for [m=1:methods] $dots index m-1 using (100*$5):2 title method_name[m] noenhanced \
        with points pt filled(key_item[m]) ps 0.8*symbol_scale*size_of(filled(key_item[m])) lc rgb colour(key_item[m])
    unset label; unset arrow
}
unset multiplot
