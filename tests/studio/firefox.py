# SPDX-License-Identifier: Apache-2.0
"""A headless Firefox, driven by its Marionette protocol."""
import base64
import json
import socket
import subprocess
import tempfile
import time
from pathlib import Path

from driven import Driven

PREFERENCES = {"marionette.port": 0, "app.update.enabled": False, "browser.shell.checkDefaultBrowser": False,
               "datareporting.policy.dataSubmissionEnabled": False, "toolkit.telemetry.reportingpolicy.firstRun": False,
               "browser.startup.homepage_override.mstone": "ignore", "network.captive-portal-service.enabled": False,
               "network.connectivity-service.enabled": False, "remote.prefs.recommended": True}
SECONDS_TO_START = 60


class Firefox(Driven):
    """Expressions only: the page's policy forbids evaluating texts."""

    def __init__(self, address, width=1300, height=860):
        self.profile = tempfile.TemporaryDirectory(ignore_cleanup_errors=True)
        Path(self.profile.name, "user.js").write_text("".join(
            f"user_pref({json.dumps(k)}, {json.dumps(v)});\n" for k, v in PREFERENCES.items()))
        self.process = subprocess.Popen(
            ["firefox-esr", "--headless", "--marionette", "--no-remote", "--profile", self.profile.name,
             f"--width={width}", f"--height={height}"],
            stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL)
        self.number, self.rest, self.buttons = 0, b"", 0
        try:
            self.link = self._connected()
            self._message()  # its greeting
            self.call("WebDriver:NewSession", capabilities={"alwaysMatch": {"acceptInsecureCerts": False}})
            self.call("WebDriver:SetTimeouts", script=120_000, pageLoad=60_000)
            self.call("WebDriver:SetWindowRect", width=width, height=height)
            self.call("WebDriver:Navigate", url=address)
        except BaseException:
            self.end()
            raise

    def end(self):
        self.process.kill()
        self.process.wait(10)
        if hasattr(self, "link"):
            self.link.close()
        self.profile.cleanup()

    def _connected(self):
        port = Path(self.profile.name, "MarionetteActivePort")
        until = time.monotonic() + SECONDS_TO_START
        while time.monotonic() < until:
            try:
                return socket.create_connection(("127.0.0.1", int(port.read_text())), timeout=130)
            except (OSError, ValueError):
                time.sleep(0.05)
        raise TimeoutError("firefox-esr does not start")

    def _message(self):
        while b":" not in self.rest:
            self._more()
        size, _, self.rest = self.rest.partition(b":")
        while len(self.rest) < int(size):
            self._more()
        text, self.rest = self.rest[:int(size)], self.rest[int(size):]
        return json.loads(text)

    def _more(self):
        more = self.link.recv(1 << 20)
        if not more:
            raise EOFError("the browser ended")
        self.rest += more

    def call(self, command, **parameters):
        self.number += 1
        data = json.dumps([0, self.number, command, parameters]).encode()
        self.link.sendall(str(len(data)).encode() + b":" + data)
        while True:
            kind, number, error, result = self._message()
            if kind == 1 and number == self.number:
                if error:
                    raise RuntimeError(f"{command}: {error}")
                return result.get("value", result) if isinstance(result, dict) else result

    def run(self, script, seconds=60):
        """Value of an expression of the page; promises are waited for."""
        done = self.call("WebDriver:ExecuteAsyncScript", args=[], sandbox=None, script=(
            "const done = arguments[arguments.length - 1];"
            "Promise.resolve().then(() => (" + script + ")).then("
            "(value) => done({value: value === undefined ? null : value}),"
            "(error) => done({error: String(error)}))"))
        if "error" in done:
            raise RuntimeError(f"{script}: {done['error']}")
        return done.get("value")

    def mouse(self, kind, x, y, **_):
        actions = [{"type": "pointerMove", "x": round(x), "y": round(y), "duration": 0}]
        if kind in ("mousePressed", "mouseReleased"):
            actions.append({"type": "pointerDown" if kind == "mousePressed" else "pointerUp", "button": 0})
        self.call("WebDriver:PerformActions", actions=[
            {"type": "pointer", "id": "mouse", "parameters": {"pointerType": "mouse"}, "actions": actions}])

    def picture(self, path):
        data = self.call("WebDriver:TakeScreenshot", full=False, hash=False)
        Path(path).write_bytes(base64.b64decode(data))
