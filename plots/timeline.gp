# SPDX-License-Identifier: MIT
# A metric over the frames: a panel for each scene, a line for each trial.
#
#     gnuplot -e "csv='timeline.csv'; out='timeline.svg'" plots/timeline.gp
#     gnuplot -e "csv='timeline.csv'; out='x.svg'; metric='indirect_rmse'; trials='ism acrsm:clusters=32'" plots/timeline.gp
#
# metric is indirect_flip (default), indirect_rmse, indirect_relmse, indirect_flicker or frame_ms;
# trials names what is shown, blanks between; default: of each method in each scene the trial with the least mean
# of the metric. A trial of a method in the same colour has another dash. For all else see style.gp.
figure = "timeline"
folder = ARG0[1:strstrt(ARG0, "timeline.gp")-1]
item_text(x) = strcol("trial")
load folder . "style.gp"
if (!exists("metric")) metric = "indirect_flip"

array X[rows]; array Y[rows]
r = 0
enter(x, y) = (r = r + 1, X[r] = x, Y[r] = y, 1)
stats csv using (enter(column("frame"), column(metric))) nooutput
eval end_of_csv

# ---- what is shown: mean of each trial in each scene, the least of each method
# (rows of one trial of a scene are chained: there may be many frames)
array sum_of[scenes*items]; array count_of[scenes*items]; array shown[scenes*items]
array first_row[scenes*items]; array last_row[scenes*items]; array next_row[rows]
do for [k=1:scenes*items] { sum_of[k] = 0; count_of[k] = 0; shown[k] = 0; first_row[k] = 0 }
do for [r=1:rows] {
    next_row[r] = 0
    if (row_scene[r] && Y[r] == Y[r]) {
        k = (row_scene[r] - 1) * items + row_item[r]
        sum_of[k] = sum_of[k] + Y[r]; count_of[k] = count_of[k] + 1
        if (first_row[k]) { next_row[last_row[k]] = r } else { first_row[k] = r }
        last_row[k] = r
    }
}
mean(k) = count_of[k] ? sum_of[k] / count_of[k] : NaN
do for [s=1:scenes] {
    do for [m=1:methods] {
        least = 0
        do for [i=1:items] {
            k = (s - 1) * items + i
            if (item_method[i] == m && count_of[k]) {
                if (exists("trials")) {
                    shown[k] = strstrt(" " . trials . " ", " " . item_name[i] . " ") > 0
                } else {
                    if (!least) { least = k }
                    if (mean(k) < mean(least)) { least = k }
                }
            }
        }
        if (least) { shown[least] = 1 }
    }
}
any(i) = (sum [s=1:scenes] shown[(s - 1) * items + i]) > 0
# number among the shown ones of its method: the dash
dash_of(i) = ((sum [k=1:i] (item_method[k] == item_method[i] && any(k))) - 1) % 5 + 1

array key_text[items]; array key_item[items]; array key_kind[items]; array key_dash[items]
key_entries = 0
do for [m=1:methods] {
    do for [i=1:items] {
        if (item_method[i] == m && any(i)) {
            key_entries = key_entries + 1
            key_text[key_entries] = wrap(item_name[i], 50, "    ")
            key_item[key_entries] = i; key_kind[key_entries] = 3; key_dash[key_entries] = dash_of(i)
        }
    }
}
if (exists("trials")) {
    do for [x in trials] { if (!item_at(x)) { print "no trial '" . x . "'"; exit status 2 } }
}
if (!key_entries) { print "no value of " . metric; exit status 2 }
note = (exists("trials") ? "" : "Of each method the trial with the least mean in its scene. ") . "Means over the seeds."
if (sum [i=1:rows] (row_scene[i] && Y[i] <= 0)) { note = note . zero_note }
panel_width = scenes > 1 ? 390 : 620
panel_height = scenes > 1 ? 300 : 380
left = 62; right = 14; top = 34; bottom = 52
load folder . "page.gp"

array line_item[items]
set xlabel "frame" offset 0,0.3
do for [s=1:scenes] {
    x0 = NaN; x1 = NaN; y0 = NaN; y1 = NaN
    do for [i=1:items] {
        r = shown[(s - 1) * items + i] ? first_row[(s - 1) * items + i] : 0
        while (r) {
            if (!(X[r] >= x0)) { x0 = X[r] }
            if (!(X[r] <= x1)) { x1 = X[r] }
            y0 = smaller(y0, Y[r]); y1 = larger(y1, Y[r])
            r = next_row[r]
        }
    }
    eval panel(s)
    set title scene_name[s] noenhanced font font . " Bold,10" tc rgb ink offset 0,-0.4
    set ylabel ((s - 1) % columns ? "" : metric_label(metric)) offset 0.5,0
    if (x0 == x0 && positive(y1)) {
        # values that lie far apart need a logarithmic axis
        unset logscale y
        lowest = 0
        eval tics_of("y")
        set yrange [0:y1*1.06]
        if (y1 > 12 * y0) {
            set logscale y
            lowest = y0 / 1.15
            set yrange [lowest:y1*1.1]
            eval log_tics("y", lowest, y1 * 1.1, panel_height - top - bottom)
        }
        eval tics_of("x")
        set xrange [x0 - 0.02*(x1-x0) - 0.1:x1 + 0.02*(x1-x0) + 0.1]
        floor_of(y) = y <= lowest ? lowest : y
        set print $lines
        drawn = 0
        do for [i=1:items] {
            if (shown[(s - 1) * items + i] && first_row[(s - 1) * items + i]) {
                drawn = drawn + 1
                line_item[drawn] = i
                r = first_row[(s - 1) * items + i]
                while (r) { print sprintf("%d %.9g", X[r], floor_of(Y[r])); r = next_row[r] }
                print ""; print ""
            }
        }
        unset print
        every_nth = int(x1 - x0) / 8 > 1 ? int(x1 - x0) / 8 : 1
        symbol_at(x, n) = int(x) % every_nth == n % every_nth
        plot for [n=1:drawn] $lines index n-1 using 1:2 title item_name[line_item[n]] noenhanced \
                with lines lw 1.6 dt dash_of(line_item[n]) lc rgb colour(line_item[n]), \
            for [n=1:drawn] $lines index n-1 using (symbol_at($1, n) ? $1 : NaN):2 title item_name[line_item[n]] noenhanced \
                with points pt filled(line_item[n]) ps 0.7*symbol_scale*size_of(filled(line_item[n])) \
                lc rgb colour(line_item[n])
    } else {
        eval empty
    }
    unset label; unset arrow
}
unset multiplot
