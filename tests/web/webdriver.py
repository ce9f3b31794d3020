# SPDX-License-Identifier: MIT
"""A small WebDriver client for headless Chromium, of the standard library alone (W3C WebDriver)."""
import base64
import json
import os
import shutil
import socket
import subprocess
import tempfile
import time
import urllib.error
import urllib.request

ELEMENT = "element-6066-11e4-a52e-4f735466cecf"  # the standard's name for a reference to one
BROWSERS = ("chromium", "chromium-browser", "google-chrome")


def available():
    return shutil.which("chromedriver") and any(shutil.which(name) for name in BROWSERS)


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


class Failed(Exception):
    pass


class Browser:
    """One browser; use it as a context."""

    def __init__(self, width=1280, height=900):
        self.profile = tempfile.mkdtemp(prefix="irbench-web-")
        self.port = free_port()
        self.log = open(os.path.join(self.profile, "driver.log"), "wb")
        self.driver = subprocess.Popen(["chromedriver", "--port=%d" % self.port], stdout=self.log, stderr=self.log)
        self.session = None
        try:
            self.wait_for_driver()
            self.session = self.start(width, height)
        except BaseException:
            self.close()
            raise

    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.close()

    def wait_for_driver(self, seconds=60):
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            try:
                if self.call("GET", "/status")["ready"]:
                    return
            except OSError:
                pass
            if self.driver.poll() is not None:
                raise Failed("chromedriver ended with status %d" % self.driver.returncode)
            time.sleep(0.05)
        raise Failed("chromedriver does not answer")

    def start(self, width, height):
        options = {
            "binary": next(shutil.which(name) for name in BROWSERS if shutil.which(name)),
            "args": ["--headless=new", "--no-sandbox", "--disable-gpu", "--disable-dev-shm-usage",
                     "--user-data-dir=" + os.path.join(self.profile, "user"), "--no-first-run",
                     "--disable-background-networking", "--hide-scrollbars",
                     "--window-size=%d,%d" % (width, height)],
        }
        wanted = {"alwaysMatch": {"browserName": "chrome", "goog:chromeOptions": options,
                                  "goog:loggingPrefs": {"browser": "ALL", "performance": "ALL"}}}
        return self.call("POST", "/session", {"capabilities": wanted})["sessionId"]

    def close(self):
        try:
            if self.session:
                self.call("DELETE", "/session/" + self.session)
        except (OSError, Failed):
            pass
        self.driver.terminate()
        try:
            self.driver.wait(10)
        except subprocess.TimeoutExpired:
            self.driver.kill()
            self.driver.wait()
        self.log.close()
        shutil.rmtree(self.profile, ignore_errors=True)

    def call(self, verb, path, body=None):
        data = None if body is None else json.dumps(body).encode()
        request = urllib.request.Request("http://127.0.0.1:%d%s" % (self.port, path), data, method=verb,
                                         headers={"Content-Type": "application/json"})
        opener = urllib.request.build_opener(urllib.request.ProxyHandler({}))
        try:
            with opener.open(request, timeout=300) as answer:
                return json.load(answer)["value"]
        except urllib.error.HTTPError as error:
            value = json.load(error)["value"]
            raise Failed("%s: %s" % (value["error"], value["message"].split("\n")[0])) from None

    def command(self, verb, path, body=None):
        return self.call(verb, "/session/%s%s" % (self.session, path), body)

    def open(self, url):
        self.command("POST", "/url", {"url": url})

    def run(self, script, *arguments):
        """The value that the function body returns."""
        return self.command("POST", "/execute/sync", {"script": script, "args": list(arguments)})

    def run_async(self, script, *arguments):
        """Likewise of an async function body."""
        script = ("const done = arguments[arguments.length - 1];"
                  "(async (...arguments_) => {%s})(...arguments).then(done, (e) => done('error: ' + e));" % script)
        return self.command("POST", "/execute/async", {"script": script, "args": list(arguments)})

    def until(self, script, *arguments, seconds=120):
        """Runs the function body until it returns something true, and returns that."""
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            value = self.run(script, *arguments)
            if value:
                return value
            time.sleep(0.02)
        raise Failed("not within %d s: %s" % (seconds, script))

    def find(self, selector):
        return self.command("POST", "/element", {"using": "css selector", "value": selector})[ELEMENT]

    def click(self, selector):
        self.command("POST", "/element/%s/click" % self.find(selector), {})

    def keys(self, *keys):
        """Presses keys one after the other, wherever the focus is."""
        actions = [{"type": kind, "value": key} for key in keys for kind in ("keyDown", "keyUp")]
        self.command("POST", "/actions", {"actions": [{"type": "key", "id": "keys", "actions": actions}]})

    def drag(self, selector, dx, dy):
        """With the mouse, from the middle of an element."""
        origin = {ELEMENT: self.find(selector)}
        move = [{"type": "pointerMove", "duration": 0, "origin": origin, "x": 0, "y": 0},
                {"type": "pointerDown", "button": 0},
                {"type": "pointerMove", "duration": 30, "origin": "pointer", "x": dx // 2, "y": dy // 2},
                {"type": "pointerMove", "duration": 30, "origin": "pointer", "x": dx - dx // 2, "y": dy - dy // 2},
                {"type": "pointerUp", "button": 0}]
        self.command("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": move,
                                                       "parameters": {"pointerType": "mouse"}}]})

    def hover(self, selector, dx, dy):
        """The mouse over an element, dx and dy from its middle."""
        move = {"type": "pointerMove", "duration": 0, "origin": {ELEMENT: self.find(selector)}, "x": dx, "y": dy}
        self.command("POST", "/actions", {"actions": [{"type": "pointer", "id": "mouse", "actions": [move],
                                                       "parameters": {"pointerType": "mouse"}}]})

    def devtools(self, name, **parameters):
        return self.command("POST", "/goog/cdp/execute", {"cmd": name, "params": parameters})

    def logs(self, kind):
        return self.command("POST", "/se/log", {"type": kind})

    def screenshot(self, path, whole=False):
        """Of the window, or of the whole page."""
        if whole:
            data = self.devtools("Page.captureScreenshot", captureBeyondViewport=True)["data"]
        else:
            data = self.command("GET", "/screenshot")
        with open(path, "wb") as file:
            file.write(base64.b64decode(data))
