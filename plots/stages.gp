# SPDX-License-Identifier: MIT
# Where the time of a frame goes: a panel for each scene, a bar for each trial, a piece for each stage in
# the order in which they run; the number behind a bar is their sum. The core's own stages, which every
# method needs, are grey.
#
#     gnuplot -e "csv='stages.csv'; out='stages.svg'" plots/stages.gp
#
# For all else see style.gp.
figure = "stages"
folder = ARG0[1:strstrt(ARG0, "stages.gp")-1]
item_text(x) = strcol("trial")
load folder . "style.gp"

array stage_name[rows]; array row_stage[rows]; array X[rows]
stages = 0
stage_at(x) = (sum [k=1:stages] (stage_name[k] eq x ? k : 0))
stage_of(x) = (found = stage_at(x), found ? found : (stages = stages + 1, stage_name[stages] = x, stages))
r = 0
enter(x) = (r = r + 1, X[r] = x > 0 ? x : 0, row_stage[r] = stage_of(strcol("stage")), 1)
stats csv using (enter(column("ms"))) nooutput
eval end_of_csv

# ---- colours: greys for the core; a palette, then lighter, then darker, then hatched
core(k) = stage_name[k] eq "gbuffer" ? 1 : stage_name[k] eq "rsm" ? 2 : stage_name[k] eq "direct" ? 3 : 0
grey(n) = word("#555555 #8c8c8c #bdbdbd", n)
tone(n) = word("#0072B2 #E69F00 #009E73 #CC79A7 #D55E00 #56B4E9 #7A5195 #D6C700", n)
tint(n) = word("#A3CDE5 #F7DBA3 #A3DCCB #EDCFE0 #F3C4A3 #C7E5F7 #CDBCD7 #F1ECA8", n)
shade(n) = word("#003E61 #7D5600 #00563F #6F425B #743300 #2F6280 #422C51 #746C00", n)
turn(k) = (sum [n=1:k] (!core(n))) - 1
circuit(k) = (turn(k) / 8) % 4
hatched(k) = !core(k) && circuit(k) == 3
stage_colour(k) = core(k) ? grey(core(k)) : circuit(k) == 1 ? tint(turn(k) % 8 + 1) : \
    circuit(k) == 2 ? shade(turn(k) % 8 + 1) : tone(turn(k) % 8 + 1)
# text on it, by the colour's luma; not plain black, which is ink and may be recoloured
hex(x) = int("0x" . x)
luma(c) = 0.299 * hex(c[2:3]) + 0.587 * hex(c[4:5]) + 0.114 * hex(c[6:7])
on_stage(k) = hatched(k) || luma(stage_colour(k)) > 115 ? "#000001" : "#ffffff"

# a piece of a bar, or of the key: a command
area(a, x0, y0, x1, y1, k) = sprintf("set object rectangle from %s %.9g, %s %.9g ", a, x0, a, y0) . \
    sprintf("to %s %.9g, %s %.9g ", a, x1, a, y1) . \
    sprintf("fc rgb '%s' fs %s border lc rgb 'white' lw 0.6", stage_colour(k), hatched(k) ? "pattern 4" : "solid")
key_area(x0, y0, x1, y1, k) = area("screen", x0, y0, x1, y1, k)

array key_text[stages]; array key_item[stages]; array key_kind[stages]
key_entries = stages
do for [k=1:stages] { key_text[k] = stage_name[k]; key_item[k] = k; key_kind[k] = 4 }
load folder . "rows.gp"
panel_width = scenes > 2 ? 310 : scenes > 1 ? 420 : 640
right = 44
load folder . "page.gp"

set xlabel "time of a frame, mean (ms)" offset 0,0.3
unset grid
set grid xtics lt 1 lw 0.6 lc rgb faint
array total[items]
do for [s=1:scenes] {
    do for [i=1:items] { total[i] = 0 }
    do for [r=1:rows] { if (row_scene[r] == s) { total[row_item[r]] = total[row_item[r]] + X[r] } }
    longest = 1e-6
    do for [i=1:items] { longest = total[i] > longest ? total[i] : longest }
    per_ms = (panel_width - left - right) / longest
    eval panel(s)
    set title scene_name[s] noenhanced font font . " Bold,10" tc rgb ink offset 0,-0.4
    if ((s - 1) % columns == 0) { eval names }
    set xrange [0:longest]
    do for [i=1:items] {
        x = 0
        do for [r=1:rows] {
            if (row_scene[r] == s && row_item[r] == i && X[r] > 0) {
                k = row_stage[r]
                y0 = row_top[i] + 1.5; y1 = row_top[i] + row_high(i) - 1.5
                eval area("first", x, y0, x + X[r], y1, k)
                if (X[r] * per_ms > 4.9 * strlen(stage_name[k]) + 5) {
                    set label stage_name[k] at x + X[r] / 2, row_y(i) center front noenhanced \
                        font font . ",7" tc rgb on_stage(k)
                }
                x = x + X[r]
            }
        }
    }
    do for [i=1:items] {
        if (total[i] > 0) {
            set label sprintf(total[i] < 100 ? "%.3g" : "%.0f", total[i]) at total[i], row_y(i) left \
                offset 0.4,0 noenhanced font font . ",7" tc rgb ink
        }
    }
    plot NaN notitle
    unset label; unset object
}
unset multiplot
