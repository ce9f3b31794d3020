#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes plots/methods.csv, the one table of colours, into a C table.

usage: embed_palette.py METHODS.csv OUTPUT.c
"""
import csv
import re
import sys

with open(sys.argv[1], newline="", encoding="ascii") as file, open(sys.argv[2], "w", encoding="ascii") as out:
    rows = list(csv.DictReader(file))
    out.write('/* Made by embed_palette.py from plots/methods.csv; do not edit. */\n')
    out.write('#include "core/report/palette.h"\n\n')
    out.write("const struct irb_palette_line irb_palette[] = {\n")
    for row in rows:
        if not re.fullmatch(r"[\w*-]+", row["method"]) or not re.fullmatch("[0-9A-F]{6}", row["colour"]):
            sys.exit(f"{sys.argv[1]}: expected a method and RRGGBB, found {row}")
        out.write('    {"%s", "#%s"},\n' % (row["method"], row["colour"]))
    out.write("    {0, 0},\n};\n")
