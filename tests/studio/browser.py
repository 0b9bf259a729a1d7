# SPDX-License-Identifier: Apache-2.0
"""A headless Chromium, driven by its DevTools protocol through pipes."""
import base64
import json
import os
import select
import subprocess
import tempfile
import time

from driven import Driven

KEYS = {"Tab": 9, "Enter": 13, "Escape": 27, "Delete": 46, "ArrowLeft": 37, "ArrowUp": 38,
        "ArrowRight": 39, "ArrowDown": 40, " ": 32}
SHIFT, CTRL = 8, 2


class Browser(Driven):
    def __init__(self, address, width=1300, height=860):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        to_read, self.out = os.pipe()
        self.into, to_write = os.pipe()
        command = (f"exec chromium --headless=new --no-sandbox --no-first-run --disable-gpu "
                   f"--disable-extensions --disable-quic --disable-background-networking "
                   f"--disable-component-update --disable-sync --remote-debugging-pipe --window-size={width},{height} "
                   f"--user-data-dir={self.profile.name} about:blank 3<&{to_read} 4>&{to_write}")
        self.process = subprocess.Popen(["bash", "-c", command], pass_fds=(to_read, to_write),
                                        stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        os.close(to_read)
        os.close(to_write)
        self.number, self.rest, self.session, self.trouble = 0, b"", None, []
        target = self.call("Target.createTarget", url="about:blank")
        self.session = self.call("Target.attachToTarget", targetId=target["targetId"],
                                 flatten=True)["sessionId"]
        self.call("Runtime.enable")
        self.call("Page.enable")
        self.call("Page.navigate", url=address)

    def end(self):
        self.process.kill()
        self.process.wait(10)
        os.close(self.out)
        os.close(self.into)
        self.profile.cleanup()

    def _message(self, until):
        while b"\0" not in self.rest:
            left = until - time.monotonic()
            if left <= 0 or not select.select([self.into], [], [], left)[0]:
                raise TimeoutError("the browser does not answer")
            more = os.read(self.into, 1 << 20)
            if not more:
                raise EOFError("the browser ended")
            self.rest += more
        text, _, self.rest = self.rest.partition(b"\0")
        return json.loads(text)

    def call(self, method, seconds=60, **parameters):
        self.number += 1
        request = {"id": self.number, "method": method, "params": parameters}
        if self.session:
            request["sessionId"] = self.session
        data = json.dumps(request).encode() + b"\0"
        while data:
            data = data[os.write(self.out, data):]
        until = time.monotonic() + seconds
        while True:
            message = self._message(until)
            if message.get("method") == "Runtime.exceptionThrown":
                details = message["params"]["exceptionDetails"]
                self.trouble.append(details.get("exception", {}).get("description", str(details)))
            if message.get("id") == self.number:
                if "error" in message:
                    raise RuntimeError(f"{method}: {message['error']}")
                return message["result"]

    def run(self, script, seconds=60):
        """Value of an expression of the page; promises are waited for."""
        got = self.call("Runtime.evaluate", seconds, expression=script, awaitPromise=True,
                        returnByValue=True)
        if "exceptionDetails" in got:
            raise RuntimeError(f"{script}: {got['exceptionDetails']}")
        return got["result"].get("value")

    def mouse(self, kind, x, y, **more):
        self.call("Input.dispatchMouseEvent", type=kind, x=x, y=y, **more)

    def key(self, name, modifiers=0):
        code = KEYS.get(name, ord(name[0].upper()))
        text = {"text": "\r"} if name == "Enter" else {"text": name} if len(name) == 1 and not modifiers & CTRL else {}
        for kind in ("keyDown", "keyUp"):
            self.call("Input.dispatchKeyEvent", type=kind, key=name, windowsVirtualKeyCode=code,
                      modifiers=modifiers, **(text if kind == "keyDown" else {}))

    def write(self, selector, text):
        """Types into a box and leaves it."""
        self.run(f"document.querySelector({json.dumps(selector)}).focus();"
                 f"document.querySelector({json.dumps(selector)}).select?.()")
        if text == "":
            self.key("Delete")
        self.call("Input.insertText", text=text)
        self.run("document.activeElement.blur()")

    def picture(self, path):
        data = self.call("Page.captureScreenshot", format="png")["data"]
        with open(path, "wb") as out:
            out.write(base64.b64decode(data))
