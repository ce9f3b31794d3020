#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes every text file below a folder into a C table of struct irb_embedded_file, sorted by path.

usage: embed.py FOLDER OUTPUT.c OUTPUT.d HEADER TABLE EXTENSION...

HEADER declares `TABLE` and `TABLE_count`. OUTPUT.d is a dependency file that names the files and their
folders: a build tool that reads it runs this again when one is edited, added or removed.
"""
import os
import sys


def c_string(line):
    """A C string literal. Bytes outside printable ASCII become octal escapes."""
    out = []
    for byte in line:
        char = chr(byte)
        if char in '"\\?':
            out.append("\\" + char)
        elif 32 <= byte < 127:
            out.append(char)
        else:
            out.append("\\%03o" % byte)
    return '"' + "".join(out) + '"'


def main(root, output, depfile, header, table, *extensions):
    files, folders = [], []
    for folder, subfolders, names in os.walk(root):
        subfolders.sort()
        folders.append(folder)
        for name in names:
            if name.endswith(extensions) and not name.startswith("."):
                files.append(os.path.join(folder, name))
    files.sort(key=lambda path: os.path.relpath(path, root))
    with open(output, "w", encoding="ascii") as out:
        out.write("/* Made by embed.py from %s/; do not edit. */\n" % os.path.basename(root))
        out.write('#include "%s"\n\n' % header)
        out.write("const struct irb_embedded_file %s[] = {\n" % table)
        for path in files:
            with open(path, "rb") as file:
                text = file.read()
            if b"\0" in text:
                sys.exit(f"{path}: expected text, found a zero byte")
            out.write("    {%s,\n" % c_string(os.path.relpath(path, root).encode()))
            for line in text.splitlines(keepends=True):
                out.write("     %s\n" % c_string(line))
            out.write('     ""},\n')
        out.write("    {0, 0},\n};\n")
        out.write("const size_t %s_count = %d;\n" % (table, len(files)))
    with open(depfile, "w", encoding="utf-8") as out:
        escaped = [path.replace(" ", "\\ ") for path in folders + files]
        out.write("%s: %s\n" % (output, " ".join(escaped)))


if __name__ == "__main__":
    if len(sys.argv) < 7:
        sys.exit(__doc__)
    main(*sys.argv[1:])
