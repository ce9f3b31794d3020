# SPDX-License-Identifier: MIT
"""Reads the float channels of a scanline OpenEXR file with the standard library alone.

Does not: read tiles, several parts, half floats, or compressions other than none, ZIPS and ZIP.
"""
import itertools
import struct
import sys
import zlib
from array import array

MAGIC = 20000630
FLOAT = 2
LINES = {0: 1, 2: 1, 3: 16}  # of a block, by compression: none, ZIPS, ZIP


def _text(data, at):
    end = data.index(0, at)
    return data[at:end].decode(), end + 1


def _header(data, at):
    attributes = {}
    while data[at]:
        name, at = _text(data, at)
        _, at = _text(data, at)
        (size,) = struct.unpack_from('<i', data, at)
        attributes[name] = data[at + 4:at + 4 + size]
        at += 4 + size
    return attributes, at + 1


def _channels(data):
    names, at = [], 0
    while data[at]:
        name, at = _text(data, at)
        kind, _, x, y = struct.unpack_from('<iiii', data, at)
        if (kind, x, y) != (FLOAT, 1, 1):
            raise ValueError(f'channel {name}: expected 32-bit float in full resolution')
        names.append(name)
        at += 16
    return names


def _inflate(block, size):
    """Undoes ZIP: differences of bytes, whose even and odd ones were taken apart."""
    if len(block) == size:
        return block
    raw = zlib.decompress(block)
    raw = bytes(v & 255 for v in itertools.accumulate(raw, lambda a, b: a + b - 128))
    out = bytearray(size)
    half = (size + 1) // 2
    out[0::2] = raw[:half]
    out[1::2] = raw[half:]
    return bytes(out)


def read(path):
    """(width, height, {channel: array of width * height floats, row 0 at the top})"""
    with open(path, 'rb') as file:
        data = file.read()
    magic, version = struct.unpack_from('<ii', data, 0)
    if magic != MAGIC or version & 0x1a00:
        raise ValueError(f'{path}: expected a scanline OpenEXR file of one part')
    attributes, at = _header(data, 8)
    x0, y0, x1, y1 = struct.unpack('<iiii', attributes['dataWindow'])
    width, height = x1 - x0 + 1, y1 - y0 + 1
    names = _channels(attributes['channels'])
    lines = LINES.get(attributes['compression'][0])
    if not lines:
        raise ValueError(f'{path}: expected no compression or ZIP')
    channels = {name: array('f', bytes(4 * width * height)) for name in names}
    blocks = (height + lines - 1) // lines
    for offset in struct.unpack_from(f'<{blocks}Q', data, at):
        y, size = struct.unpack_from('<ii', data, offset)
        y -= y0
        count = min(lines, height - y)
        raw = _inflate(data[offset + 8:offset + 8 + size], 4 * width * len(names) * count)
        values = array('f', raw)
        if sys.byteorder == 'big':
            values.byteswap()
        for k in range(count * len(names)):
            line, name = y + k // len(names), names[k % len(names)]
            channels[name][line * width:(line + 1) * width] = values[k * width:(k + 1) * width]
    return width, height, channels
