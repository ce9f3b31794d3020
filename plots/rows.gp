# SPDX-License-Identifier: MIT
# A row for each trial, methods together, their names left of the panels: for bars and dots that lie. Sets the
# heights and margins of page.gp; row_y(i) is the middle of item i's row, in pixels from the
# panel's top. After page.gp, `names` draws the names beside the panel of scene s.
array row_top[items + 1]; array row_name[items]; array row_lines[items]
rows_high = 4
names_widest = 1
do for [m=1:methods] {
    do for [i=1:items] {
        if (item_method[i] == m) {
            row_name[i] = wrap(item_name[i], 46, "    ")
            row_lines[i] = lines(row_name[i])
            row_top[i] = rows_high
            rows_high = rows_high + 5 + 11 * row_lines[i]
            widest = row_lines[i] > 1 ? 46 : strlen(row_name[i])
            names_widest = widest > names_widest ? widest : names_widest
        }
    }
    rows_high = rows_high + (m < methods ? 5 : 4)
}
row_high(i) = 5 + 11 * row_lines[i]
row_y(i) = row_top[i] + row_high(i) / 2.0
names_width = int(names_widest * 6.2) + 22
left = 6; right = 22; top = 34; bottom = 46
panel_height = rows_high + top + bottom
# not more than one grid row of names where it can be helped
if (!exists("columns")) columns = scenes < 4 ? scenes : scenes == 4 ? 2 : 3
names = 'do for [i=1:items] { set label 100+i row_name[i] at screen sx(names_width - 4), \
    screen sy(panel_top(s) + row_y(i) - 5.5 * (row_lines[i] - 1)) right noenhanced font font . ",8" tc rgb ink }'
set yrange [rows_high:0]
unset ytics
set border 1
