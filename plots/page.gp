# SPDX-License-Identifier: MIT
# The page of a figure: panels in a grid, the key below them, the file's format. Lengths are in
# pixels of a page at 96 dpi. Wants panel_width, panel_height and the margins left, right, top and
# bottom of each panel; key_entries and the arrays key_text, key_item (whose colour), key_kind:
# 1 opens a block (symbol and text in bold type), 2 goes on with it, 3 is a block of its own with a
# piece of line of dash key_dash, 4 likewise with a rectangle, for which key_area(x0, y0, x1, y1, item)
# gives the command. Blocks are not broken over columns. note, where it is set, stands below.
#
# After it, `panel(s)` gives the command that puts the next plot into the place of scene s.
if (!exists("columns")) columns = scenes == 4 ? 2 : scenes < 3 ? scenes : 3
if (!exists("key_font")) key_font = 8
grid_rows = (scenes + columns - 1) / columns
if (!exists("names_width")) names_width = 0
page_width = names_width + columns * panel_width
line_height = key_font * 1.5

# ---- the key: lines of each entry, width and height of its columns
key_widest = 1; key_lines = 0; key_tallest = 1; block = 0
do for [e=1:key_entries] {
    n = lines(key_text[e])
    key_lines = key_lines + n
    block = key_kind[e] == 2 ? block + n : n
    key_tallest = block > key_tallest ? block : key_tallest
    rest = key_text[e]
    while (strlen(rest)) {
        k = strstrt(rest, "\n") ? strstrt(rest, "\n") - 1 : strlen(rest)
        key_widest = k > key_widest ? k : key_widest
        rest = k < strlen(rest) ? rest[k+2:] : ""
    }
}
key_width = key_widest * key_font * 0.8 + 36
key_columns = int(page_width / key_width)
if (key_columns < 1) { key_columns = 1 }
array key_column[key_entries > 0 ? key_entries : 1]
array key_line[key_entries > 0 ? key_entries : 1]
# the least height in which the blocks fit into the columns
key_high = (key_lines + key_columns - 1) / key_columns - 1
if (key_high < key_tallest - 1) { key_high = key_tallest - 1 }
used = key_columns + 1
while (used > key_columns && key_entries) {
    key_high = key_high + 1
    used = 1; at = 0
    do for [e=1:key_entries] {
        n = lines(key_text[e])
        if (key_kind[e] != 2) {
            block = n
            do for [f=e+1:key_entries] {
                if (key_kind[f] != 2) { break }
                block = block + lines(key_text[f])
            }
            if (at && at + block > key_high) { used = used + 1; at = 0 }
        }
        key_column[e] = used; key_line[e] = at
        at = at + n
    }
}
if (key_entries) { key_width = real(page_width) / used }
# height of the key and of the note
note = exists("note") ? fold(note, int(page_width / 5.6)) : ""
key_height = (key_entries ? key_high * line_height + 18 : 0) + \
    (strlen(note) ? lines(note) * line_height + 6 : 4)
page_height = grid_rows * panel_height + key_height

# ---- the file; symbols are drawn larger by svg than by the others
symbol_scale = 1.0
if (out[strlen(out)-3:] eq ".png") {
    set terminal pngcairo size 2*page_width,2*page_height fontscale 2 linewidth 2 pointscale 2 \
        font font . ",9" background "#ffffff"
}
if (out[strlen(out)-3:] eq ".pdf") {
    set terminal pdfcairo size page_width/96.0,page_height/96.0 fontscale 0.75 linewidth 1.4 pointscale 0.72 \
        font font . ",9" background "#ffffff"
}
if (out[strlen(out)-3:] eq ".svg") {
    symbol_scale = 0.8
    set terminal svg size page_width,page_height dynamic name id fontscale 1.333 \
        font font . ",9" background "#ffffff"
}
set output out

sx(x) = real(x) / page_width
sy(y) = 1 - real(y) / page_height
panel_left(s) = names_width + ((s - 1) % columns) * panel_width + left
panel_right(s) = names_width + ((s - 1) % columns + 1) * panel_width - right
panel_top(s) = ((s - 1) / columns) * panel_height + top
panel_bottom(s) = ((s - 1) / columns + 1) * panel_height - bottom
place(x0, x1, y0, y1) = sprintf("set lmargin at screen %f; set rmargin at screen %f; ", sx(x0), sx(x1)) . \
    sprintf("set tmargin at screen %f; set bmargin at screen %f", sy(y0), sy(y1))
panel(s) = place(panel_left(s), panel_right(s), panel_top(s), panel_bottom(s))

# where a scene has nothing to show
empty = 'unset logscale; unset xtics; unset ytics; set label "no values" at graph 0.5, graph 0.5 center \
    font font . ",9" tc rgb ink; plot [0:1] [0:1] NaN notitle'

set multiplot
unset key

# ---- draws the key once, as labels and lines of the first panel
do for [e=1:key_entries] {
    x = (key_column[e] - 1) * key_width + 22
    y = grid_rows * panel_height + key_line[e] * line_height + 14
    if (key_kind[e] == 1 || key_kind[e] == 3) {
        set label "" at screen sx(x), screen sy(y) \
            point pt filled(key_item[e]) ps 0.9*symbol_scale*size_of(filled(key_item[e])) lc rgb colour(key_item[e])
    }
    if (key_kind[e] == 3) {
        set arrow from screen sx(x-13), screen sy(y) to screen sx(x+13), screen sy(y) nohead \
            lw 1.6 dt key_dash[e] lc rgb colour(key_item[e])
    }
    if (key_kind[e] == 4) { eval key_area(sx(x-8), sy(y+4), sx(x+4), sy(y-4), key_item[e]) }
    set label key_text[e] at screen sx(x + (key_kind[e] == 3 ? 20 : 10)), screen sy(y) noenhanced \
        font font . (key_kind[e] == 1 ? " Bold," : ",") . key_font tc rgb ink
}
if (strlen(note)) {
    set label note at screen sx(8), screen sy(page_height - (lines(note) - 0.4) * line_height - 2) \
        noenhanced font font . ",7.5" tc rgb ink
}
