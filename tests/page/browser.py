# SPDX-License-Identifier: Apache-2.0
# SPDX-FileCopyrightText: The crease authors

"""A headless Chromium, steered through its debugging pipe by the standard library alone."""

import base64
import json
import os
import select
import shutil
import struct
import subprocess
import time
import zlib

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")


def find_chromium():
    return next((path for path in map(shutil.which, NAMES) if path), None)


class Browser:
    """Messages are JSON, each ended by a zero byte: to the browser on 3, from it on 4."""

    def __init__(self, chromium, folder, width, height):
        self.events, self.last, self.rest = [], 0, b""
        options = ["--headless=new", "--remote-debugging-pipe", "--no-first-run", "--hide-scrollbars",
                   "--disable-background-networking", "--disable-dev-shm-usage", "--mute-audio",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist",
                   "--force-device-scale-factor=1", f"--window-size={width},{height}",
                   f"--user-data-dir={folder}"]
        if os.geteuid() == 0:
            options.append("--no-sandbox")
        down, self.down = os.pipe()
        self.up, up = os.pipe()

        def place_pipes():
            # Not over each other: first out of the way, then to 3 and 4.
            high = [os.dup2(down, 100), os.dup2(up, 101)]
            os.dup2(high[0], 3)
            os.dup2(high[1], 4)

        self.process = subprocess.Popen([chromium, *options, "about:blank"], close_fds=False,
                                        preexec_fn=place_pipes, stdout=subprocess.DEVNULL,
                                        stderr=subprocess.DEVNULL)
        os.close(down)
        os.close(up)
        target = self.call("Target.createTarget", url="about:blank")["targetId"]
        self.session = None
        self.session = self.call("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        for domain in ("Page", "Runtime", "Network", "Log"):
            self.call(f"{domain}.enable")
        self.resize(width, height)

    session = None

    def receive(self, deadline):
        while b"\0" not in self.rest:
            ready, _, _ = select.select([self.up], [], [], max(0, deadline - time.monotonic()))
            block = os.read(self.up, 1 << 20) if ready else b""
            if not block:
                raise TimeoutError("the browser does not answer")
            self.rest += block
        message, self.rest = self.rest.split(b"\0", 1)
        return json.loads(message)

    def call(self, method, **parameters):
        self.last += 1
        message = {"id": self.last, "method": method, "params": parameters}
        if self.session:
            message["sessionId"] = self.session
        os.write(self.down, json.dumps(message).encode() + b"\0")
        deadline = time.monotonic() + 60
        while True:
            answer = self.receive(deadline)
            if answer.get("id") != self.last:
                self.events.append(answer)
            elif "error" in answer:
                raise RuntimeError(f"{method}: {answer['error']}")
            else:
                return answer["result"]

    def evaluate(self, expression):
        answer = self.call("Runtime.evaluate", expression=expression, returnByValue=True,
                           awaitPromise=True)
        if "exceptionDetails" in answer:
            raise RuntimeError(f"{expression}: {answer['exceptionDetails']}")
        return answer["result"].get("value")

    def wait_for(self, expression, seconds=60):
        deadline = time.monotonic() + seconds
        while not self.evaluate(expression):
            if time.monotonic() > deadline:
                raise TimeoutError(f"never true: {expression}")
            time.sleep(0.05)

    def rest_frames(self):
        """Waits until what was asked for has been drawn."""
        self.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")

    def resize(self, width, height):
        self.call("Emulation.setDeviceMetricsOverride", width=width, height=height,
                  deviceScaleFactor=1, mobile=False)

    def prefer(self, scheme):
        self.call("Emulation.setEmulatedMedia",
                  features=[{"name": "prefers-color-scheme", "value": scheme}])

    def mouse(self, kind, x, y, button="left", **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, button=button, clickCount=1, **more)

    def click(self, x, y):
        self.mouse("mouseMoved", x, y, button="none")
        self.mouse("mousePressed", x, y)
        self.mouse("mouseReleased", x, y)
        self.rest_frames()

    def click_on(self, selector):
        place = self.evaluate(
            f"(() => {{ const e = document.querySelector({json.dumps(selector)}); "
            "e.scrollIntoView({block: 'center'}); const r = e.getBoundingClientRect(); "
            "return [r.left + r.width / 2, r.top + r.height / 2]; })()")
        self.click(*place)

    def drag(self, start, end):
        self.mouse("mouseMoved", *start, button="none")
        self.mouse("mousePressed", *start)
        for i in range(1, 6):
            self.mouse("mouseMoved", *(a + (b - a) * i / 5 for a, b in zip(start, end)), buttons=1)
        self.mouse("mouseReleased", *end)
        self.rest_frames()

    def key(self, key, code="", shift=False):
        text = {"text": key} if len(key) == 1 else {}
        number = {"Escape": 27, "Tab": 9, "Enter": 13}.get(key, 0)
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=key, code=code or key, windowsVirtualKeyCode=number,
                      modifiers=8 if shift else 0, **(text if kind == "keyDown" else {}))
        self.rest_frames()

    def touch(self, kind, *fingers):
        self.call("Input.dispatchTouchEvent", type=kind,
                  touchPoints=[{"x": x, "y": y, "id": i} for i, (x, y) in enumerate(fingers)])

    def swipe(self, starts, ends):
        """Moves fingers from starts to ends at the same time."""
        self.touch("touchStart", *starts)
        for i in range(1, 6):
            self.touch("touchMove", *([a + (b - a) * i / 5 for a, b in zip(start, end)]
                                      for start, end in zip(starts, ends)))
        self.touch("touchEnd")
        self.rest_frames()

    def tap(self, x, y):
        self.touch("touchStart", (x, y))
        self.touch("touchEnd")
        self.rest_frames()

    def text(self, selector):
        return self.evaluate(f"document.querySelector({json.dumps(selector)}).innerText")

    def picture(self, path=None):
        self.rest_frames()
        answer = self.call("Page.captureScreenshot", format="png", optimizeForSpeed=True)
        data = base64.b64decode(answer["data"])
        if path:
            with open(path, "wb") as file:
                file.write(data)
        return Picture(data)

    def close(self):
        try:
            self.session = None
            self.call("Browser.close")
            self.process.wait(10)
        except (OSError, RuntimeError, TimeoutError, subprocess.TimeoutExpired):
            self.process.kill()
            self.process.wait()
        os.close(self.down)
        os.close(self.up)


class Picture:
    """The pixels of a PNG of 8 bits a channel, as browsers write it."""

    def __init__(self, data):
        at, packed = 8, b""
        while at < len(data):
            size, kind = struct.unpack(">I4s", data[at:at + 8])
            body = data[at + 8:at + 8 + size]
            if kind == b"IHDR":
                self.width, self.height, _, colour = struct.unpack(">IIBB", body[:10])
            elif kind == b"IDAT":
                packed += body
            at += size + 12
        self.channels = {2: 3, 6: 4}[colour]
        self.rows = self.unfilter(zlib.decompress(packed))

    def unfilter(self, raw):
        step, stride = self.channels, self.channels * self.width
        rows, above = [], bytearray(stride)
        for y in range(self.height):
            kind, row = raw[y * (stride + 1)], bytearray(raw[y * (stride + 1) + 1:(y + 1) * (stride + 1)])
            self.undo(kind, row, above, step)
            rows.append(row)
            above = row
        return rows

    @staticmethod
    def undo(kind, row, above, step):
        if kind == 2:
            row[:] = bytes((a + b) & 255 for a, b in zip(row, above))
        elif kind:
            for i in range(len(row)):
                left = row[i - step] if i >= step else 0
                corner = above[i - step] if i >= step else 0
                row[i] = (row[i] + Picture.guess(kind, left, above[i], corner)) & 255

    @staticmethod
    def guess(kind, left, up, corner):
        if kind == 1:
            return left
        if kind == 3:
            return (left + up) // 2
        near = left + up - corner
        return min((left, up, corner), key=lambda value: abs(near - value))

    def count(self, wanted, left=0):
        """How many pixels right of `left` have a colour that wanted(red, green, blue) accepts."""
        step = self.channels
        return sum(1 for row in self.rows for i in range(left * step, len(row), step)
                   if wanted(row[i], row[i + 1], row[i + 2]))

    def differs(self, other, left=0):
        """The share of the pixels right of `left` that differ."""
        step = self.channels
        different = sum(1 for a, b in zip(self.rows, other.rows) for i in range(left * step, len(a), step)
                        if a[i:i + 3] != b[i:i + 3])
        return different / ((self.width - left) * self.height)
