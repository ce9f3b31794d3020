#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""Checks `irbench compare` against values that share no code with it.

    oracle.py IRBENCH     writes images given by formulas, compares them with irbench, and holds the
                          figures against double-precision sums over the definitions, against the
                          public FLIP tool's values, and against OpenImageIO's idiff where it is
    oracle.py --print     prints the SSIM that test_ssim.c expects

Needs nothing but the standard library. The EXR and PNG writers are here for that reason.
"""
import json
import math
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import zlib

FAILURES = 0


def check(what, found, expected, tolerance):
    global FAILURES
    ok = found is not None and abs(found - expected) <= tolerance
    print(f"{'ok  ' if ok else 'FAIL'} {what}: {found}, expected {expected:.9g} +- {tolerance:.1g}")
    FAILURES += not ok


# ---- images: lists of rows of (r, g, b) ----

def single(v):
    """Rounded to single precision, as files hold it."""
    return struct.unpack("<f", struct.pack("<f", v))[0]


def chequer(x, y):
    return ((x >> 3) + (y >> 3)) & 1


def radiance(width, height, changed):
    """Over three decades, with a tenth more or less in a chequerboard."""
    def pixel(x, y):
        s = 10 ** (3 * y / (height - 1) - 2)
        k = (1.1 if (x ^ y) & 1 else 0.8) if changed and chequer(x, y) else 1
        return tuple(single(k * s * c) for c in (0.1 + 0.9 * x / (width - 1),
                                                 0.5 + 0.5 * math.sin(x / 5), y / (height - 1)))
    return [[pixel(x, y) for x in range(width)] for y in range(height)]


def pattern(width, height, changed):
    """Of test_ssim.c; 1 channel."""
    def value(x, y):
        v = (x * 7 + y * 13 + ((x ^ y) & 31) * 3) % 256
        return ((v * 3 + 128) // 4 if changed and chequer(x, y) else v) / 256
    return [[value(x, y) for x in range(width)] for y in range(height)]


def flip_ldr(kind):
    """The pairs of the public tool's table, 8 bits."""
    def pixel(x, y):
        if kind == "ref8":
            return (x, y, x ^ y)
        if kind == "testA":
            return (min(255, x + 8) if chequer(x, y) else x, y, x ^ y)
        if kind == "shifted":
            left = max(0, x - 1)
            return (left, y, left ^ y)
        return (132 if kind == "flat132" else 128, 128, 128)
    return [[pixel(x, y) for x in range(256)] for y in range(256)]


# ---- files ----

def write_exr(path, image, names=("R", "G", "B")):
    """Uncompressed scan lines of 32-bit floats (OpenEXR File Layout); channels in order of name."""
    height, width = len(image), len(image[0])
    order = sorted(range(len(names)), key=lambda c: names[c])

    def attribute(name, kind, data):
        return name.encode() + b"\0" + kind.encode() + b"\0" + struct.pack("<i", len(data)) + data
    channels = b"".join(names[c].encode() + b"\0" + struct.pack("<iBBBBii", 2, 0, 0, 0, 0, 1, 1)
                        for c in order) + b"\0"
    box = struct.pack("<4i", 0, 0, width - 1, height - 1)
    header = struct.pack("<ii", 20000630, 2)
    header += attribute("channels", "chlist", channels)
    header += attribute("compression", "compression", b"\0")
    header += attribute("dataWindow", "box2i", box) + attribute("displayWindow", "box2i", box)
    header += attribute("lineOrder", "lineOrder", b"\0")
    header += attribute("pixelAspectRatio", "float", struct.pack("<f", 1))
    header += attribute("screenWindowCenter", "v2f", struct.pack("<2f", 0, 0))
    header += attribute("screenWindowWidth", "float", struct.pack("<f", 1)) + b"\0"
    size = 4 * width * len(names)
    with open(path, "wb") as out:
        out.write(header)
        for y in range(height):
            out.write(struct.pack("<Q", len(header) + 8 * height + y * (8 + size)))
        for y, row in enumerate(image):
            out.write(struct.pack("<ii", y, size))
            for c in order:
                out.write(struct.pack(f"<{width}f", *(p[c] for p in row)))


def write_png(path, image):
    def chunk(kind, data):
        return (struct.pack(">I", len(data)) + kind + data +
                struct.pack(">I", zlib.crc32(kind + data)))
    rows = b"".join(b"\0" + bytes(v for p in row for v in p) for row in image)
    with open(path, "wb") as out:
        out.write(b"\x89PNG\r\n\x1a\n")
        out.write(chunk(b"IHDR", struct.pack(">IIBBBBB", len(image[0]), len(image), 8, 2, 0, 0, 0)))
        out.write(chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))


# ---- definitions, in double precision ----

def ssim(test, reference):
    """Wang et al. 2004, eq. 13, over all windows inside the image."""
    window = [[math.exp(-(i * i + j * j) / 4.5) for i in range(-5, 6)] for j in range(-5, 6)]
    total = sum(map(sum, window))
    values = []
    for y in range(5, len(test) - 5):
        for x in range(5, len(test[0]) - 5):
            taps = [(window[j][i] / total, test[y + j - 5][x + i - 5],
                     reference[y + j - 5][x + i - 5]) for j in range(11) for i in range(11)]
            mt = math.fsum(w * t for w, t, _ in taps)
            mr = math.fsum(w * r for w, _, r in taps)
            vt = math.fsum(w * (t - mt) ** 2 for w, t, _ in taps)
            vr = math.fsum(w * (r - mr) ** 2 for w, _, r in taps)
            cov = math.fsum(w * (t - mt) * (r - mr) for w, t, r in taps)
            values.append((2 * mt * mr + 1e-4) * (2 * cov + 9e-4) /
                          ((mt * mt + mr * mr + 1e-4) * (vt + vr + 9e-4)))
    return math.fsum(values) / len(values)


def luma(image, exposure):
    """Reinhard on luminance, sRGB, Rec.709 luma."""
    weights = (0.2126, 0.7152, 0.0722)

    def encode(v):
        v = min(1, v)
        return 12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055

    def pixel(p):
        level = exposure * sum(w * c for w, c in zip(weights, p))
        return sum(w * encode(c * exposure / (1 + level)) for w, c in zip(weights, p))
    return [[pixel(p) for p in row] for row in image]


def definitions(test, reference):
    pairs = [(v, r) for a, b in zip(test, reference) for p, q in zip(a, b) for v, r in zip(p, q)]
    n = len(pairs)
    values = sorted(r for _, r in pairs)
    mean = math.fsum(values) / n
    eps = (0.01 * mean) ** 2
    rmse = math.sqrt(math.fsum((v - r) ** 2 for v, r in pairs) / n)
    peak = values[math.ceil(0.999 * n) - 1]
    light = [0.2126 * p[0] + 0.7152 * p[1] + 0.0722 * p[2] for row in reference for p in row]
    lit = [math.log(y) for y in light if y > 0]
    exposure = 0.18 / math.exp(math.fsum(lit) / len(lit))
    return {
        "rmse": rmse,
        "relmse": math.fsum((v - r) ** 2 / (r * r + eps) for v, r in pairs) / n,
        "smape": math.fsum(abs(v - r) / (abs(v) + abs(r) + 0.01 * mean) for v, r in pairs) / n,
        "bias": math.fsum(v - r for v, r in pairs) / n,
        "energy_ratio": math.fsum(v for v, _ in pairs) / math.fsum(values),
        "max_error": max(abs(v - r) for v, r in pairs),
        "peak": peak,
        "psnr": 20 * math.log10(peak / rmse),
        "exposure": exposure,
        "ssim": ssim(luma(test, exposure), luma(reference, exposure)),
    }


# ---- checks ----

def compare(irbench, test, reference):
    out = subprocess.run([irbench, "compare", test, reference, "--format", "json"], check=True,
                         stdout=subprocess.PIPE).stdout
    return json.loads(out)


def check_definitions(irbench, folder):
    test, reference = radiance(72, 50, True), radiance(72, 50, False)
    paths = f"{folder}/test.exr", f"{folder}/reference.exr"
    write_exr(paths[0], test)
    write_exr(paths[1], reference)
    found = compare(irbench, *paths)
    for name, expected in definitions(test, reference).items():
        # the displayed image is in single precision, so that SSIM has fewer digits
        tolerance = 2e-6 if name == "ssim" else 2e-8 * max(1, abs(expected))
        check(name, found[name], expected, tolerance)
    same = compare(irbench, paths[0], paths[0])
    for name, expected in (("rmse", 0), ("smape", 0), ("ssim", 1), ("flip", 0), ("ldr_flip", 0)):
        check(f"{name} of equal images", same[name], expected, 0)
    check_idiff(found, *paths)


def check_idiff(found, test, reference):
    """idiff prints 6 digits; its PSNR has another peak, which follows from its figures."""
    if not shutil.which("idiff"):
        print("skipped: no idiff (package openimageio-tools)")
        return
    text = subprocess.run(["idiff", test, reference], stdout=subprocess.PIPE).stdout.decode()

    def figure(label):
        return float(re.search(label + r"\s*[:=]\s*([-+.0-9e]+)", text).group(1))
    rms, psnr = figure("RMS error"), figure("Peak SNR")
    check("rmse against idiff", found["rmse"], rms, 2e-5 * rms)
    check("max_error against idiff", found["max_error"], figure("Max error"),
          2e-5 * found["max_error"])
    peak = rms * 10 ** (psnr / 20)
    print(f"     idiff's peak is {peak:.6g}")
    check("psnr against idiff, at its peak",
          found["psnr"] + 20 * math.log10(peak / found["peak"]), psnr, 1e-3)


def check_flip(irbench, folder):
    """Means of FLIP 1.6; the flat pair's mean is rounded there, its median is the true value."""
    for test, reference, mean in (("testA", "ref8", 0.065781), ("shifted", "ref8", 0.047806),
                                  ("flat132", "flat128", 0.065321)):
        paths = f"{folder}/{test}.png", f"{folder}/{reference}.png"
        write_png(paths[0], flip_ldr(test))
        write_png(paths[1], flip_ldr(reference))
        check(f"LDR-FLIP of {test} against {reference}",
              compare(irbench, *paths)["ldr_flip"], mean, 2e-5)


def main():
    if sys.argv[1:] == ["--print"]:
        print(f"{ssim(pattern(96, 64, True), pattern(96, 64, False)):.12f}")
        return 0
    with tempfile.TemporaryDirectory() as folder:
        check_definitions(sys.argv[1], folder)
        check_flip(sys.argv[1], folder)
    return FAILURES > 0


if __name__ == "__main__":
    sys.exit(main())
