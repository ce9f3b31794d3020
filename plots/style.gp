# SPDX-License-Identifier: MIT
# What all figures share: reading the CSV, colour and symbol of a method, words for the axes, the
# page. Loaded by the figures' own scripts, which say what is above their first line of code:
#
#     csv='x.csv'       the figure's data, see core/report/figures.h
#     out='x.svg'       .svg, .png or .pdf
#     scene='hall'      this scene alone; default: a panel for each
#     font='Sans'       svg: sans-serif
#     separator="\t"    between fields; with commas, a name that holds commas or quotes is cut there
#     id='a'            svg: prefix of its ids, for several in one page
#
# Methods have their colours and symbols in methods.csv; those without a line of their own get the
# lines called *, in the order in which they come. The palette is Okabe and Ito's, safe for
# colour-blind readers (jfly.uni-koeln.de/color, 2008); symbols differ too, for print in grey.
if (!exists("csv") || !exists("out")) {
    print sprintf("usage: gnuplot -e \"csv='%s.csv'; out='%s.svg'\" plots/%s.gp", figure, figure, figure)
    exit status 2
}
if (!exists("font")) font = out[strlen(out)-3:] eq ".svg" ? "sans-serif" : "Sans"
if (!exists("separator")) separator = ","
if (!exists("id")) id = figure
set encoding utf8
set datafile commentschars ""
set datafile missing ""
set datafile columnheaders

# ---- methods.csv
array place_method[32]; array place_colour[32]; array place_symbol[32]; array place_dash[32]
places = 0
enter(x) = (places = places + 1, place_method[places] = strcol("method"), \
            place_colour[places] = "#" . strcol("colour"), \
            place_symbol[places] = int(column("symbol")), place_dash[places] = int(column("dash")), 1)
set datafile separator comma
stats folder . "methods.csv" using (enter(0)) nooutput
own_places = sum [i=1:places] place_method[i] ne "*"

# ---- the names in the data: scenes, methods, and items (trials, or what the figure's item_text says)
set datafile separator separator
stats csv using (1) nooutput
if (!exists("STATS_records") || STATS_records < 1) { print "no data"; exit status 2 }
size = int(STATS_records)
array row_scene[size]; array row_item[size]
array scene_name[size]; array method_name[size]; array item_name[size]; array item_method[size]
rows = 0; scenes = 0; methods = 0; items = 0
scene_at(x) = (sum [i=1:scenes] (scene_name[i] eq x ? i : 0))
method_at(x) = (sum [i=1:methods] (method_name[i] eq x ? i : 0))
item_at(x) = (sum [i=1:items] (item_name[i] eq x ? i : 0))
scene_of(x) = (found = scene_at(x), found ? found : (scenes = scenes + 1, scene_name[scenes] = x, scenes))
method_of(x) = (found = method_at(x), found ? found : (methods = methods + 1, method_name[methods] = x, methods))
item_of(x, m) = (found = item_at(x), found ? found : \
    (items = items + 1, item_name[items] = x, item_method[items] = m, items))
wanted(x) = !exists("scene") || x eq scene
enter(x) = (rows = rows + 1, row_scene[rows] = wanted(x) ? scene_of(x) : 0, \
            row_item[rows] = row_scene[rows] ? item_of(item_text(0), method_of(strcol("method"))) : 0, 1)
stats csv using (enter(strcol("scene"))) nooutput
if (!scenes) { print "no scene '" . scene . "'"; exit status 2 }

# ---- colour, symbol and dash of a method; number of an item among those of its method
array method_place[methods]
do for [m=1:methods] {
    p = (sum [i=1:places] (place_method[i] eq method_name[m] ? i : 0))
    others = (sum [k=1:m] (!(sum [i=1:places] place_method[i] eq method_name[k])))
    method_place[m] = p ? p : own_places + (others - 1) % (places - own_places) + 1
}
colour(i) = place_colour[method_place[item_method[i]]]
filled(i) = place_symbol[method_place[item_method[i]]]
hollow(i) = filled(i) - 1
dash(i) = place_dash[method_place[item_method[i]]]
number(i) = (sum [k=1:i] (item_method[k] == item_method[i]))
dash_by_number(i) = (number(i) - 1) % 5 + 1
# diamonds and triangles are smaller than squares of the same size
size_of(symbol) = symbol > 12 && symbol < 14 ? 1.35 : symbol > 8 && symbol < 12 ? 1.15 : 1.0

# ---- texts
zero_note = " A value of 0 stands on the edge."
ink = "#000000"
faint = "#B0808080"
# the name of an item behind that of its method
behind(x, m) = x eq m ? "(defaults)" : (strlen(x) > strlen(m) + 1 && x[1:strlen(m)+1] eq m . ":") ? x[strlen(m)+2:] : x
short(i) = behind(item_name[i], method_name[item_method[i]])
# lines of at most n characters, broken behind a colon where there is one
colon(x, k, n) = k < 2 ? n : x[k:k] eq ":" ? k : colon(x, k - 1, n)
wrap(x, n, indent) = strlen(x) <= n ? x : (k_ = colon(x, n, n), x[1:k_] . "\n" . indent . wrap(x[k_+1:], n, indent))
# likewise, words of a sentence
blank(x, k, n) = k < 2 ? n : x[k:k] eq " " ? k : blank(x, k - 1, n)
fold(x, n) = strlen(x) <= n ? x : (k_ = blank(x, n, n), x[1:k_] . "\n" . fold(x[k_+1:], n))
lines(x) = (at_ = strstrt(x, "\n"), at_ ? 1 + lines(x[at_+1:]) : 1)
metric_label(m) = m eq "indirect_flip" ? "HDR-FLIP, indirect image" : \
    m eq "indirect_rmse" ? "RMSE, indirect image (W m^{-2} sr^{-1})" : \
    m eq "indirect_relmse" ? "relMSE, indirect image" : \
    m eq "indirect_flicker" ? "flicker, indirect image (share of mean reference)" : \
    m eq "frame_ms" ? "frame time (ms)" : m

# ---- numbers that can be drawn on a logarithmic axis, and the ends of such an axis
positive(x) = x > 0 && x < 1e300
smaller(a, b) = positive(b) && (!positive(a) || b < a) ? b : a
larger(a, b) = positive(b) && (!positive(a) || b > a) ? b : a
set tics scale 0.6 textcolor rgb ink font font . ",8"
set xlabel font font . ",9" tc rgb ink
set ylabel font font . ",9" tc rgb ink
set border 3 lw 0.8 lc rgb ink
set tics nomirror
set errorbars 0.5
set grid lt 1 lw 0.6 lc rgb faint
# labels of a logarithmic axis ("x", "y"): as many in a decade as its pixels have room for
digits(a, decades, pixels) = 7 * decades * (a eq "x" ? 34 : 22) < pixels ? "1 1.5 2 3 4 5 7" : \
    3 * decades * (a eq "x" ? 26 : 18) < pixels ? "1 2 5" : "1"
tics_of(a) = sprintf("unset %stics; set %stics scale 0.6 nomirror textcolor rgb ink font '%s,8'", a, a, font)
# commands; the small marks come first, without a label
log_tics(a, x0, x1, pixels) = tics_of(a) . sprintf("; set %stics ('' 1e-30 1); ", a) . \
    sprintf("do for [k=-9:12] { do for [d=1:9] { set %stics add ('' d * 10.0**k 1) } }; ", a) . \
    sprintf("do for [k=-9:12] { do for [d in digits('%s', log10(%.9g), %g)] { ", a, x1 / x0, pixels) . \
    sprintf("eval sprintf('set %stics add (\"%%g\" %%g)', d * 10.0**k, d * 10.0**k) } }", a)

# After the last line of the CSV has been read: what is printed into data blocks has no headers.
end_of_csv = 'set datafile separator whitespace; unset datafile columnheaders'
