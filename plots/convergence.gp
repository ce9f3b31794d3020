# SPDX-License-Identifier: MIT
# Error over the number that a family of trials differs in (samples, virtual lights, clusters, ...):
# a panel for each scene, a line for each family, with its intervals.
#
#     gnuplot -e "csv='convergence.csv'; out='convergence.svg'" plots/convergence.gp
#
# metric is indirect_rmse (default) or indirect_flip. For all else see style.gp.
figure = "convergence"
folder = ARG0[1:strstrt(ARG0, "convergence.gp")-1]
# families that differ in their parameter alone have one name: both make the item
item_text(x) = strcol("family") . " [" . strcol("parameter") . "]"
load folder . "style.gp"
if (!exists("metric")) metric = "indirect_rmse"

array X[rows]; array Y[rows]; array Y0[rows]; array Y1[rows]
r = 0
end_of(x, value) = x == x ? x : value
enter(y) = (r = r + 1, X[r] = column("x"), Y[r] = y, \
    Y0[r] = end_of(column(metric . "_low"), y), Y1[r] = end_of(column(metric . "_high"), y), 1)
stats csv using (enter(column(metric))) nooutput
eval end_of_csv

drawn(r, s) = row_scene[r] == s && X[r] == X[r] && positive(Y[r])
array key_text[items]; array key_item[items]; array key_kind[items]; array key_dash[items]
key_entries = 0
do for [m=1:methods] {
    do for [i=1:items] {
        if (item_method[i] == m) {
            key_entries = key_entries + 1
            key_text[key_entries] = wrap(item_name[i], 46, "    ")
            key_item[key_entries] = i; key_kind[key_entries] = 3; key_dash[key_entries] = dash_by_number(i)
        }
    }
}
note = "In brackets the parameter. Bars: 95 % intervals."
if (sum [i=1:rows] (row_scene[i] && X[i] <= 0)) { note = note . zero_note }
panel_width = scenes > 1 ? 390 : 620
panel_height = scenes > 1 ? 330 : 420
left = 62; right = 14; top = 34; bottom = 52
load folder . "page.gp"

array line_item[items]
set xlabel "value of the parameter" offset 0,0.3
do for [s=1:scenes] {
    x0 = NaN; x1 = NaN; y0 = NaN; y1 = NaN; zero = 0
    do for [r=1:rows] {
        if (drawn(r, s)) {
            x0 = smaller(x0, X[r]); x1 = larger(x1, X[r])
            y0 = smaller(smaller(y0, Y[r]), Y0[r]); y1 = larger(larger(y1, Y[r]), Y1[r])
            zero = zero || !positive(X[r])
        }
    }
    eval panel(s)
    set title scene_name[s] noenhanced font font . " Bold,10" tc rgb ink offset 0,-0.4
    set ylabel ((s - 1) % columns ? "" : metric_label(metric)) offset 0.5,0
    if (y0 == y0) {
        if (x0 != x0) { x0 = 1; x1 = 1 }
        x0 = x0 / (zero ? 2.0 : 1.2); x1 = x1 * 1.2
        y0 = y0 / (y1 / y0)**0.05 / 1.03; y1 = y1 * (y1 / y0)**0.05 * 1.03
        set logscale xy
        set xrange [x0:x1]; set yrange [y0:y1]
        eval log_tics("x", x0, x1, panel_width - left - right)
        eval log_tics("y", y0, y1, panel_height - top - bottom)
        set print $lines
        shown = 0
        do for [i=1:items] {
            n = 0
            do for [r=1:rows] {
                if (row_item[r] == i && drawn(r, s)) {
                    n = n + 1
                    print sprintf("%.9g %.9g %.9g %.9g", positive(X[r]) ? X[r] : x0, Y[r], Y0[r] > y0 ? Y0[r] : y0, Y1[r])
                }
            }
            if (n) { print ""; print ""; shown = shown + 1; line_item[shown] = i }
        }
        unset print
        plot for [n=1:shown] $lines index n-1 using 1:2 title item_name[line_item[n]] noenhanced \
                with lines lw 1.5 dt dash_by_number(line_item[n]) lc rgb colour(line_item[n]), \
            for [n=1:shown] $lines index n-1 using 1:2:3:4 title item_name[line_item[n]] noenhanced \
                with yerrorbars pt -1 lw 0.8 lc rgb colour(line_item[n]), \
            for [n=1:shown] $lines index n-1 using 1:2 title item_name[line_item[n]] noenhanced \
                with points pt filled(line_item[n]) ps 0.8*symbol_scale*size_of(filled(line_item[n])) \
                lc rgb colour(line_item[n])
    } else {
        eval empty
    }
    unset label; unset arrow
}
unset multiplot
