# SPDX-License-Identifier: MIT
# Error against cost: a panel for each scene, a point for each trial, with its intervals. A line
# joins the trials of a method that no other of the same method beats in both; those off it are hollow.
# The grey stairs are the front of all methods: what lies above and to the right of them is beaten.
# Numbers are those of the key.
#
#     gnuplot -e "csv='pareto.csv'; out='pareto.svg'" plots/pareto.gp
#     gnuplot -e "csv='pareto.csv'; out='pareto.pdf'; metric='indirect_rmse'; cost='bytes'" plots/pareto.gp
#
# metric is indirect_flip (default), indirect_rmse, indirect_relmse or indirect_flicker; cost is ms
# (frame time, default) or bytes (of OpenGL objects). For all else see style.gp.
figure = "pareto"
folder = ARG0[1:strstrt(ARG0, "pareto.gp")-1]
item_text(x) = strcol("trial")
load folder . "style.gp"
if (!exists("metric")) metric = "indirect_flip"
if (!exists("cost")) cost = "ms"
bytes = cost eq "bytes"

array X[rows]; array X0[rows]; array X1[rows]
array Y[rows]; array Y0[rows]; array Y1[rows]
array best[rows]
r = 0
# an end of an interval; where there is none, the value itself
end_of(x, value) = x == x ? x : value
mebi = 1.0 / 2**20
enter(x, y) = (r = r + 1, X[r] = x, Y[r] = y, best[r] = column(metric . "_front_" . cost) == 1, \
    X0[r] = bytes ? x : end_of(column("frame_ms_low"), x), \
    X1[r] = bytes ? x : end_of(column("frame_ms_high"), x), \
    Y0[r] = end_of(column(metric . "_low"), y), Y1[r] = end_of(column(metric . "_high"), y), 1)
stats csv using (enter(bytes ? column("gl_bytes") * mebi : column("frame_ms"), column(metric))) nooutput
eval end_of_csv

# drawn at all (0 on the edge); better in one and not worse in the other; on the front of its own method
drawn(i) = row_scene[i] > 0 && X[i] >= 0 && X[i] < 1e300 && Y[i] >= 0 && Y[i] < 1e300
beats(i, k) = X[i] <= X[k] && Y[i] <= Y[k] && (X[i] < X[k] || Y[i] < Y[k])
rival(i, k) = drawn(i) && row_scene[i] == row_scene[k] && item_method[row_item[i]] == item_method[row_item[k]]
array leads[rows]
do for [k=1:rows] { leads[k] = drawn(k) ? !(sum [i=1:rows] (rival(i, k) && beats(i, k))) : 0 }

# rows by rising cost
array order[rows]
do for [i=1:rows] {
    k = i
    while (k > 1 && !(X[order[k > 1 ? k-1 : 1]] <= X[i])) { order[k] = order[k-1]; k = k - 1 }
    order[k] = i
}

# ---- key: a block for each method
array key_text[items + methods]; array key_item[items + methods]; array key_kind[items + methods]
key_entries = 0
do for [m=1:methods] {
    first = 1
    do for [i=1:items] {
        if (item_method[i] == m) {
            if (first) {
                key_entries = key_entries + 1
                key_text[key_entries] = method_name[m]; key_item[key_entries] = i; key_kind[key_entries] = 1
                first = 0
            }
            key_entries = key_entries + 1
            key_text[key_entries] = wrap(sprintf("%d  ", number(i)) . short(i), 44, "    ")
            key_item[key_entries] = i; key_kind[key_entries] = 2
        }
    }
}
note = "Filled: no other trial of the method is better in both. Outlined, and grey stairs: " . \
    "no trial of any method is. Bars: 95 % intervals."
if (sum [i=1:rows] (drawn(i) && (X[i] == 0 || Y[i] == 0))) { note = note . zero_note }
panel_width = scenes > 1 ? 390 : 620
panel_height = scenes > 1 ? 350 : 440
left = 62; right = 14; top = 34; bottom = 52
load folder . "page.gp"

set xlabel (bytes ? "OpenGL memory (MiB)" : "frame time (ms)") offset 0,0.3
# what is not above 0 goes to the edge of its axis
at_x(x) = x > x0 ? x : x0
at_y(y) = y > y0 ? y : y0
on(i, s) = drawn(int(i)) && row_scene[int(i)] == s
mine(i, s, m) = on(i, s) && item_method[row_item[int(i)]] == m
x_of(i) = at_x(X[int(i)])
y_of(i) = at_y(Y[int(i)])
# an item of the method, for its looks
of_method(m) = (sum [i=1:items] (item_method[i] == m && (sum [k=1:i] (item_method[k] == m)) == 1 ? i : 0))
full(m) = filled(of_method(m))
symbol_of(m) = 0.8 * symbol_scale * size_of(full(m))
do for [s=1:scenes] {
    x0 = NaN; x1 = NaN; y0 = NaN; y1 = NaN
    do for [i=1:rows] {
        if (on(i, s)) {
            x0 = smaller(smaller(x0, X[i]), X0[i]); x1 = larger(larger(x1, X[i]), X1[i])
            y0 = smaller(smaller(y0, Y[i]), Y0[i]); y1 = larger(larger(y1, Y[i]), Y1[i])
        }
    }
    eval panel(s)
    set title scene_name[s] noenhanced font font . " Bold,10" tc rgb ink offset 0,-0.4
    set ylabel ((s - 1) % columns ? "" : metric_label(metric)) offset 0.5,0
    if (sum [i=1:rows] (on(i, s))) {
        if (x0 != x0) { x0 = 0.1; x1 = 1 }
        if (y0 != y0) { y0 = 0.1; y1 = 1 }
        x0 = x0 / (x1 / x0)**0.05 / 1.05; x1 = x1 * (x1 / x0)**0.07 * 1.05
        y0 = y0 / (y1 / y0)**0.05 / 1.03; y1 = y1 * (y1 / y0)**0.05 * 1.03
        set logscale xy
        set xrange [x0:x1]; set yrange [y0:y1]
        eval log_tics("x", x0, x1, panel_width - left - right)
        eval log_tics("y", y0, y1, panel_height - top - bottom)
        # the front of all, then that of each method, by falling error
        set print $fronts
        print "NaN NaN"
        last = 0
        do for [k=1:rows] {
            i = order[k]
            if (on(i, s) && best[i]) {
                if (!last) { print sprintf("%.9g %.9g", at_x(X[i]), y1) }
                print sprintf("%.9g %.9g", at_x(X[i]), at_y(Y[i]))
                last = i
            }
        }
        if (last) { print sprintf("%.9g %.9g", x1, at_y(Y[last])) }
        do for [m=1:methods] {
            print "\n\nNaN NaN"
            do for [k=1:rows] {
                i = order[k]
                if (mine(i, s, m) && leads[i]) { print sprintf("%.9g %.9g", x_of(i), y_of(i)) }
            }
        }
        unset print
        plot $fronts index 0 using 1:2 title "front of all methods" with steps lw 7 lc rgb "#A8808080", \
            for [m=1:methods] $fronts index m using 1:2 title method_name[m] noenhanced \
                with lines lw 1.4 dt dash(of_method(m)) lc rgb colour(of_method(m)), \
            for [m=1:methods] X using (mine($1, s, m) ? x_of($1) : NaN):(y_of($1)): \
                    (at_x(X0[int($1)])):(at_x(X1[int($1)])):(at_y(Y0[int($1)])):(at_y(Y1[int($1)])) \
                title method_name[m] noenhanced with xyerrorbars pt -1 lw 0.8 lc rgb colour(of_method(m)), \
            for [m=1:methods] X using (mine($1, s, m) && !leads[int($1)] ? x_of($1) : NaN):(y_of($1)) \
                title method_name[m] noenhanced with points pt full(m) ps symbol_of(m) lc bgnd, \
            for [m=1:methods] X using (mine($1, s, m) && !leads[int($1)] ? x_of($1) : NaN):(y_of($1)) \
                title method_name[m] noenhanced with points pt full(m) - 1 ps symbol_of(m) lw 1.2 \
                lc rgb colour(of_method(m)), \
            for [m=1:methods] X using (mine($1, s, m) && leads[int($1)] ? x_of($1) : NaN):(y_of($1)) \
                title method_name[m] noenhanced with points pt full(m) ps symbol_of(m) lc rgb colour(of_method(m)), \
            for [m=1:methods] X using (mine($1, s, m) && best[int($1)] ? x_of($1) : NaN):(y_of($1)) \
                title method_name[m] noenhanced with points pt full(m) - 1 ps symbol_of(m) lw 1 lc rgb ink, \
            for [m=1:methods] X using (mine($1, s, m) ? x_of($1) : NaN):(y_of($1)): \
                    (sprintf("%d", number(row_item[int($1)]))) \
                title method_name[m] noenhanced with labels font font . ",7" tc rgb ink offset 0.75,0.45
    } else {
        eval empty
    }
    unset label; unset arrow
}
unset multiplot
