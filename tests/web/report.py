#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The report of a tiny run in a real browser: headless Chromium, driven through chromedriver.

usage: report.py IRBENCH [SCREENSHOT.png]

What the canvas shows is held against closed forms: the film's code, Reinhard's operator and sRGB,
computed here from the film's JPEG files. Exits with 77 where there is no chromedriver, no OpenGL or
no OpenImageIO.
"""
import base64
import json
import math
import os
import shutil
import sqlite3
import subprocess
import sys
import tempfile
import time

import webdriver
from webdriver import Browser, Failed

SKIPPED = 77
LOAD_SECONDS = 60  # generous: other tests may keep the machine busy; the time itself is printed
EVIL = """# </script><script>document.title = 'hacked'</script><!-- & "quotes" 'single' <b>bold</b>"""
CONFIG = EVIL + """
name: tiny
resolution: [64, 48]
frames: 3
rsm_resolution: 32
settle: 0
seed: 1
reference: {min_samples: 8, max_samples: 8, bounces: 1}
scenes: [{scene: cornell}, {scene: doorway}]
trials:
  - rsm: {mode: uniform, samples: 40}
  - rsm: {mode: uniform, samples: 90, clamp: 100}
"""
A, B = "rsm:mode=uniform:samples=40", "rsm:mode=uniform:samples=90:clamp=100"
RIGHT, LEFT, SPACE = "\ue014", "\ue012", " "

checks = 0


def check(what, holds, found=""):
    global checks
    checks += 1
    if not holds:
        raise AssertionError("%s %s" % (what, found))


class Run:
    """The run's folder, its numbers and its film."""

    def __init__(self, irbench, folder):
        self.irbench, self.folder = irbench, folder
        config = os.path.join(folder, "tiny.yaml")
        with open(config, "w") as file:
            file.write(CONFIG)
        self.path = os.path.join(folder, "run")
        self.call("run", config, "--out", self.path, "--quiet")
        with sqlite3.connect(os.path.join(self.path, "results.sqlite")) as store:
            self.meta = dict(store.execute("SELECT name, value FROM meta"))

    def call(self, *arguments):
        environment = dict(os.environ, IRBENCH_CACHE=os.path.join(self.folder, "cache"))
        subprocess.run([self.irbench, *arguments], check=True, stdout=subprocess.DEVNULL, env=environment)

    def report(self, *options):
        path = os.path.join(self.folder, "report.html")
        self.call("report", self.path, "--out", path, "--quiet", *options)
        return path

    def number(self, scene, name):
        return float(self.meta["scene/%s/%s" % (scene, name)])

    def film(self, scene, trial, stem, frame):
        parts = [self.path, scene] + ([trial] if trial else []) + ["film", "%s-%04d.jpg" % (stem, frame)]
        with open(os.path.join(*parts), "rb") as file:
            return base64.b64encode(file.read()).decode()


# ---- closed forms

def decode(code, v0, vmax):
    return v0 * (2 ** (code / 255 * math.log2(1 + vmax / v0)) - 1)


def srgb(v):
    v = min(1, max(0, v))
    return 255 * (12.92 * v if v <= 0.0031308 else 1.055 * v ** (1 / 2.4) - 0.055)


def shown(rgb, exposure, reinhard=True):
    y = 0.2126 * rgb[0] + 0.7152 * rgb[1] + 0.0722 * rgb[2]
    return [srgb(v * exposure / (1 + y * exposure if reinhard else 1)) for v in rgb]


def near(a, b, tolerance):
    return all(abs(x - y) <= tolerance for x, y in zip(a, b))


# ---- the page

CODES = """
const [text, points] = arguments_;
const image = new Image();
image.src = "data:image/jpeg;base64," + text;
await image.decode();
const canvas = document.createElement("canvas");
canvas.width = image.naturalWidth;
canvas.height = image.naturalHeight;
const context = canvas.getContext("2d");
context.drawImage(image, 0, 0);
return points.map(([x, y]) => [...context.getImageData(x, y, 1, 1).data.slice(0, 3)]);
"""

CANVAS = """
const stage = document.getElementById("stage"), canvas = document.getElementById("canvas");
const scale = Number(stage.dataset.scale), [cx, cy] = stage.dataset.centre.split(" ").map(Number);
const width = arguments[1] || stage.clientWidth, left = arguments[2] || 0, density = devicePixelRatio;
const context = canvas.getContext("2d");
return arguments[0].map(([x, y]) => [...context.getImageData(
    Math.floor(density * (left + width / 2 + (x + 0.5 - cx) * scale)),
    Math.floor(density * (canvas.clientHeight / 2 + (y + 0.5 - cy) * scale)), 1, 1).data.slice(0, 3)]);
"""

# over the whole picture, but for its edges
POINTS = [[x, y] for x in range(3, 64, 12) for y in range(3, 48, 11)]


class Page:
    def __init__(self, browser, run):
        self.browser, self.run = browser, run

    def open(self, path):
        self.browser.open("file://" + path)
        return self

    def ready(self):
        self.browser.until("return document.getElementById('stage').dataset.state === 'ready'")

    def text(self, selector):
        return self.browser.run("return document.querySelector(arguments[0]).textContent", selector)

    def choose(self, select, value):
        self.browser.click("#%s option[value='%s']" % (select, value))
        self.ready()

    def press(self, *keys):
        self.browser.keys(*keys)
        self.ready()

    def focus(self, selector):
        self.browser.run("document.querySelector(arguments[0]).focus()", selector)

    def pixels(self, points=None):
        self.ready()
        return self.browser.run(CANVAS, points or POINTS)

    def light(self, scene, trial, frame, full=False):
        """Radiance at POINTS, of a trial or (None) of the reference."""
        parts = [("reference" if trial is None else "indirect", trial, "indirect")]
        if full:
            parts.append(("direct_reference" if trial is None else "direct", None, "direct"))
        total = [[0, 0, 0] for _ in POINTS]
        for stem, folder, kind in parts:
            codes = self.browser.run_async(CODES, self.run.film(scene, folder, stem, frame), POINTS)
            v0, vmax = (self.run.number(scene, "film_%s_%s" % (end, kind)) for end in ("v0", "vmax"))
            total = [[t + decode(c, v0, vmax) for t, c in zip(sums, rgb)] for sums, rgb in zip(total, codes)]
        return total

    def expect(self, what, light, exposure, reinhard=True):
        """The canvas shows this light, within one level of 255."""
        found = self.pixels()
        for point, rgb, pixel in zip(POINTS, light, found):
            wanted = shown(rgb, exposure, reinhard)
            check("%s at %s" % (what, point), near(wanted, pixel, 1.01), "expected %s, found %s" % (wanted, pixel))


# ---- the checks

def check_source(path):
    with open(path, encoding="utf-8") as file:
        html = file.read()
    for word in ('src="http', "src='http", 'href="http', "@import", "url(", "fetch(", "XMLHttpRequest"):
        check("the page has no %s" % word, word not in html)
    check("the policy forbids all but what the page holds", "default-src 'none'" in html)
    check("the config's text ends no element", "<script>document.title" not in html)
    folder = os.path.dirname(path)
    check("nothing half written is left", not [name for name in os.listdir(folder) if ".tmp." in name])


def check_load(page, path):
    for what in ("in a new browser", "again"):
        begin = time.monotonic()
        page.open(path).ready()
        ready = time.monotonic() - begin
        loaded = page.browser.run("return performance.getEntriesByType('navigation')[0].loadEventEnd") / 1000
        print("%.2f MB %s: loaded in %.2f s, first image after %.2f s"
              % (os.path.getsize(path) / 1e6, what, loaded, ready))
        check("loads soon enough", ready < LOAD_SECONDS, ready)
    check("title", page.browser.run("return document.title") == "tiny \u2013 irbench")
    check("the config stands there as it is", EVIL in page.text("#provenance"))


def check_viewer(page):
    scene, exposure = "cornell", page.run.number("cornell", "preview_exposure")
    page.choose("scene", 0)
    page.focus("#frame")
    page.press("\ue011")  # Home
    page.choose("a", 0)
    page.focus("#stage")
    page.press("f")  # A alone
    page.expect("A", page.light(scene, A, 0), exposure)
    page.press("f")
    check("B's name", page.text("#label-b").endswith("reference"))
    page.expect("the reference", page.light(scene, None, 0), exposure)
    page.press("f")
    page.choose("a", 1)
    check("A's name", page.text("#label-a").endswith(B), page.text("#label-a"))
    page.expect("the other trial", page.light(scene, B, 0), exposure)
    page.focus("#stage")
    page.press("]", "]", "]", "]")
    page.expect("two stops more", page.light(scene, B, 0), 4 * exposure)
    page.press("t")
    page.expect("linear", page.light(scene, B, 0), 4 * exposure, reinhard=False)
    page.press("t", "[", "[", "[", "[", "l")
    page.expect("with direct light", page.light(scene, B, 0, full=True), exposure)
    page.press("f")
    page.expect("the reference with direct light", page.light(scene, None, 0, full=True), exposure)
    page.press("f", "l")
    page.focus("#exposure")
    page.press(RIGHT)
    page.expect("a quarter stop more", page.light(scene, B, 0), exposure * 2 ** 0.25)
    page.press(LEFT)


def check_frames(page):
    exposure = page.run.number("cornell", "preview_exposure")
    page.focus("#frame")
    page.press(RIGHT)
    check("the slider's frame", page.text("#frame-text").startswith("frame 1 "), page.text("#frame-text"))
    page.expect("frame 1", page.light("cornell", B, 1), exposure)
    page.focus("#stage")
    page.press(RIGHT)
    page.expect("frame 2", page.light("cornell", B, 2), exposure)
    page.press(RIGHT)
    check("round to the first", page.text("#frame-text").startswith("frame 0 "))
    page.browser.keys(SPACE)
    page.browser.until("return document.getElementById('frame').value !== '0'")
    page.browser.keys(SPACE)
    check("pauses", page.text("#play") == "\u25b6")
    page.focus("#frame")
    page.press("\ue011")


def check_split(page):
    browser, exposure = page.browser, page.run.number("cornell", "preview_exposure")
    at = "return Number(document.getElementById('divider').getAttribute('aria-valuenow'))"
    page.focus("#stage")
    page.press("s")
    check("in the middle", browser.run(at) == 50)
    browser.drag("#divider", -200, 0)
    dragged = browser.run(at)
    width = browser.run("return document.getElementById('stage').clientWidth")
    check("dragged", abs(dragged - (50 - 100 * 200 / width)) <= 1.5, dragged)
    page.focus("#divider")
    page.press(RIGHT, RIGHT)
    check("moved by keys", browser.run(at) == dragged + 4, browser.run(at))
    left, right = page.light("cornell", B, 0), page.light("cornell", None, 0)
    border = 64 * (dragged + 4) / 100
    for point, a, b, pixel in zip(POINTS, left, right, page.pixels()):
        if abs(point[0] + 0.5 - border) > 2:
            wanted = shown(a if point[0] < border else b, exposure)
            check("split at %s" % point, near(wanted, pixel, 1.01), "expected %s, found %s" % (wanted, pixel))


def check_maps(page):
    browser = page.browser
    page.focus("#stage")
    page.press("f")
    plain = page.pixels()
    page.press("e")
    check("FLIP", browser.run("return document.getElementById('map').value") == "flip")
    full = page.pixels()
    codes = browser.run_async(CODES, page.run.film("cornell", B, "flip", 0), POINTS)
    magma = json.loads(page.text("#run"))["magma"]
    for code, pixel in zip(codes, full):
        colour = [int(magma[6 * code[0] + 2 * c:6 * code[0] + 2 * c + 2], 16) for c in range(3)]
        check("FLIP's colour", near(colour, pixel, 1.01), "%s %s" % (colour, pixel))
    browser.run("const o = document.getElementById('opacity'); o.value = 0.5; o.dispatchEvent(new Event('input'))")
    for a, b, half in zip(plain, full, page.pixels()):
        check("half", near([(x + y) / 2 for x, y in zip(a, b)], half, 1.01))
    browser.run("const o = document.getElementById('opacity'); o.value = 1; o.dispatchEvent(new Event('input'))")
    page.choose("map", "signed")
    signs = [0, 0]
    for a, r, pixel in zip(page.light("cornell", B, 0), page.light("cornell", None, 0), page.pixels()):
        error = (sum(a) - sum(r)) / 3 / page.run.number("cornell", "mean_indirect")
        if abs(error) > 0.2:
            signs[error > 0] += 1
            check("red is too bright", (pixel[0] > pixel[2]) == (error > 0), "%g %s" % (error, pixel))
    check("both signs are there", sum(signs) > 5, signs)
    page.choose("map", "none")


def check_reading(page):
    point = POINTS[14]
    place = page.browser.run("""
        const stage = document.getElementById("stage"), scale = Number(stage.dataset.scale);
        const [cx, cy] = stage.dataset.centre.split(" ").map(Number);
        return [(arguments[0][0] + 0.5 - cx) * scale, (arguments[0][1] + 0.5 - cy) * scale];""", point)
    page.browser.run("document.getElementById('stage').scrollIntoView({block: 'center'})")
    page.browser.hover("#stage", round(place[0]), round(place[1]))
    check("pixel", page.text("#pixel") == "pixel %d, %d" % tuple(point), page.text("#pixel"))
    rows = page.browser.run("""return ["read-a", "read-b", "read-d"].map((id) =>
        [...document.querySelectorAll(`#${id} td`)].slice(0, 3).map((cell) => Number(cell.textContent.replace("\u2212", "-"))));""")
    a, b = (page.light("cornell", trial, 0)[14] for trial in (B, None))
    for wanted, found in ((a, rows[0]), (b, rows[1]), ([x - y for x, y in zip(a, b)], rows[2])):
        check("values", all(abs(x - y) <= 0.006 * abs(x) + 1e-6 for x, y in zip(wanted, found)), "%s %s" % (wanted, found))


def check_zoom(page):
    browser = page.browser
    state = "const s = document.getElementById('stage').dataset; return [Number(s.scale), ...s.centre.split(' ').map(Number)]"
    page.focus("#stage")
    page.press("+", "+")
    before = browser.run(state)
    inside = [[30.5 + dx, 20.5 + dy] for dx in (-0.4, 0, 0.4) for dy in (-0.4, 0, 0.4)]
    colours = {tuple(pixel) for pixel in browser.run(CANVAS, [[x - 0.5, y - 0.5] for x, y in inside])}
    check("pixels are squares", before[0] > 2 and len(colours) == 1, "%s %s" % (before, colours))
    browser.drag("#stage", 60, 30)
    after = browser.run(state)
    check("panned", near([before[1] - 60 / before[0], before[2] - 30 / before[0]], after[1:], 0.2), "%s %s" % (before, after))
    page.press("p")
    width = browser.run("return document.getElementById('stage').clientWidth")
    half = (width - 8) / 2
    point = [[round(after[1]), round(after[2])]]
    left, right = browser.run(CANVAS, point, half, 0), browser.run(CANVAS, point, half, half + 8)
    page.press("x")
    check("panes are linked: swapped they show each other's pixel",
          browser.run(CANVAS, point, half, 0) == right and browser.run(CANVAS, point, half, half + 8) == left)
    page.press("0", "s")


def check_table(page):
    column = "return [...document.querySelectorAll('.results tbody')][0].rows"
    values = "return [...document.querySelector('.results tbody').rows].map((row) => Number(row.cells[3].dataset.key))"
    check(column, page.browser.run("return document.querySelectorAll('.results').length") == 2)
    button = ".results thead th:nth-child(4) button"
    check("FLIP's column", page.text(button) == "FLIP", page.text(button))
    page.browser.click(button)
    up = page.browser.run(values)
    page.browser.click(button)
    down = page.browser.run(values)
    check("sorted", up == sorted(up) and down == sorted(up, reverse=True) and len(set(up)) == 2, "%s %s" % (up, down))
    sort = page.browser.run("return document.querySelector(arguments[0]).closest('th').getAttribute('aria-sort')", button)
    check("and says so", sort == "descending", sort)


def check_figures(page):
    links = page.browser.run("return [...document.querySelectorAll('#figures a[download]')].map((a) => [a.download, a.href])")
    names = {name: base64.b64decode(link.split("base64,")[1]).decode() for name, link in links}
    check("data", {"pareto.csv", "stages.csv", "timeline.csv", "flicker.csv"} <= set(names), list(names))
    for name, text in names.items():
        check("titles of " + name, text.startswith("scene,method,"), text[:40])
    drawn = page.browser.run("return document.querySelectorAll('#figures svg').length")
    check("drawn", drawn == len(names) if shutil.which("gnuplot") else drawn == 0, drawn)


def check_failures(page):
    page.browser.until("return document.querySelectorAll('.fails li').length === 2")
    text = page.text(".fails li p")
    check("where it fails", "FLIP" in text and "frame" in text, text)
    page.browser.click(".fails[data-scene='1'] button")
    page.ready()
    state = page.browser.run("return ['scene', 'map'].map((id) => document.getElementById(id).value)")
    check("shown in the viewer", state == ["1", "flip"], state)


def check_beside(page):
    """Profile and flicker map of A."""
    page.browser.until("return [...document.querySelectorAll('#beside img')].every((image) => image.naturalWidth > 0)")
    count = page.browser.run("return document.querySelectorAll('#beside img').length")
    check("profile and flicker", count == 2, count)


def check_theme(page):
    def brightness():
        return page.browser.run("return getComputedStyle(document.body).backgroundColor.match(/[0-9]+/)[0]")
    media = [{"name": "prefers-color-scheme", "value": "dark"}]
    page.browser.devtools("Emulation.setEmulatedMedia", features=media)
    check("dark", int(brightness()) < 64, brightness())
    page.browser.click("#theme")
    check("light by the button", page.text("#theme") == "Theme: light" and int(brightness()) > 192, brightness())
    page.browser.click("#theme")
    check("dark by the button", page.text("#theme") == "Theme: dark" and int(brightness()) < 64, brightness())
    page.browser.click("#theme")
    page.browser.devtools("Emulation.setEmulatedMedia", features=[])


def check_widths(page):
    for width in (800, 1280, 1920):
        page.browser.devtools("Emulation.setDeviceMetricsOverride", width=width, height=900, deviceScaleFactor=1, mobile=False)
        wide = page.browser.run("return document.documentElement.scrollWidth")
        check("nothing is wider than %d" % width, wide <= width, wide)
    page.browser.devtools("Emulation.clearDeviceMetricsOverride")


def check_quiet(browser, path):
    """No message on the console, and nothing asked for but the page and what it holds."""
    messages = [entry for entry in browser.logs("browser")
                if "willReadFrequently" not in entry["message"]]  # this test's own reading of the canvas
    check("console", not messages, messages)
    asked = set()
    for entry in browser.logs("performance"):
        message = json.loads(entry["message"])["message"]
        # the browser's own first page asks for things too
        if message["method"] == "Network.requestWillBeSent" and message["params"]["documentURL"].startswith("file:"):
            asked.add(message["params"]["request"]["url"])
    check("the page itself was asked for", "file://" + path in asked, asked)
    asked = {url for url in asked if not url.startswith(("data:", "blob:"))}
    check("requests", asked <= {"file://" + path}, asked)


def check_without_film(page):
    shutil.rmtree(os.path.join(page.run.path, "cornell", "film"))
    shutil.rmtree(os.path.join(page.run.path, "doorway", "film"))
    page.open(page.run.report())
    page.browser.until("return document.getElementById('sheet').naturalWidth > 0")
    check("no viewer", page.browser.run("return document.getElementById('viewer').hidden"))
    for scene in ("cornell", "doorway"):
        for trial in (A, B):
            folder = os.path.join(page.run.path, scene, trial)
            for name in os.listdir(folder):
                if name.startswith("image-"):
                    os.unlink(os.path.join(folder, name))
    page.open(page.run.report())
    check("says that there are none", "no images of the scene cornell" in page.text("#images"))
    hidden = page.browser.run("return ['viewer', 'sheets'].map((id) => document.getElementById(id).hidden)")
    check("shows none", hidden == [True, True], hidden)


def check_all(run, screenshot):
    path = run.report()
    check_source(path)
    with Browser() as browser:
        page = Page(browser, run)
        check_load(page, path)
        for part in (check_viewer, check_frames, check_split, check_maps, check_reading, check_zoom,
                     check_table, check_figures, check_failures, check_beside, check_theme, check_widths):
            part(page)
        browser.screenshot(screenshot, whole=True)
        check_quiet(browser, path)
        check_without_film(page)
        check_quiet(browser, path)


def skip(why):
    print("skipped: " + why)
    sys.exit(SKIPPED)


def main(irbench, screenshot=None):
    if not webdriver.available():
        skip("no chromedriver, or no Chromium beside it")
    version = subprocess.run([irbench, "--version"], capture_output=True, text=True, check=True).stdout
    if "images" not in version or "reference" not in version:
        skip("a build without OpenImageIO or Embree")
    if subprocess.run([irbench, "doctor"], capture_output=True).returncode:
        skip("no OpenGL backend")
    with tempfile.TemporaryDirectory(prefix="irbench-report-") as folder:
        try:
            check_all(Run(irbench, folder), screenshot or os.path.join(folder, "report.png"))
        except (AssertionError, Failed) as error:
            print("FAIL after %d checks: %s" % (checks, error))
            sys.exit(1)
    print("%d checks" % checks)


if __name__ == "__main__":
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    main(*sys.argv[1:])
