#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Writes every shader below a folder into a C table {path, text}, sorted by path.

usage: embed_shaders.py SHADERS OUTPUT.c OUTPUT.d

OUTPUT.d is a dependency file that names the shaders and their folders: a build tool that reads it
runs this again when one is edited, added or removed.
"""
import os
import sys

EXTENSIONS = (".vert", ".tesc", ".tese", ".geom", ".frag", ".comp", ".glsl")


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


def main(root, output, depfile):
    shaders, folders = [], []
    for folder, subfolders, names in os.walk(root):
        subfolders.sort()
        folders.append(folder)
        for name in names:
            if name.endswith(EXTENSIONS) and not name.startswith("."):
                shaders.append(os.path.join(folder, name))
    shaders.sort(key=lambda path: os.path.relpath(path, root))
    with open(output, "w", encoding="ascii") as out:
        out.write("/* Made by embed_shaders.py from shaders/; do not edit. */\n")
        out.write('#include "core/gl/shaders.h"\n\n')
        out.write("const struct irb_embedded_shader irb_embedded_shaders[] = {\n")
        for path in shaders:
            with open(path, "rb") as file:
                text = file.read()
            if b"\0" in text:
                sys.exit(f"{path}: expected GLSL text, found a zero byte")
            out.write("    {%s,\n" % c_string(os.path.relpath(path, root).encode()))
            for line in text.splitlines(keepends=True):
                out.write("     %s\n" % c_string(line))
            out.write('     ""},\n')
        out.write("    {0, 0},\n};\n")
        out.write("const size_t irb_embedded_shader_count = %d;\n" % len(shaders))
    with open(depfile, "w", encoding="utf-8") as out:
        escaped = [path.replace(" ", "\\ ") for path in folders + shaders]
        out.write("%s: %s\n" % (output, " ".join(escaped)))


if __name__ == "__main__":
    if len(sys.argv) != 4:
        sys.exit(__doc__)
    main(*sys.argv[1:])
