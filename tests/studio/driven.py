# SPDX-License-Identifier: Apache-2.0
"""What the tests do in a browser, whichever it is: one has `run`, `mouse`, `picture` and `end`."""
import json
import time


class Driven:
    def __enter__(self):
        return self

    def __exit__(self, *_):
        self.end()

    def wait(self, condition, seconds=20):
        until = time.monotonic() + seconds
        while not self.run(f"Boolean({condition})"):
            if time.monotonic() > until:
                raise TimeoutError(condition)
            time.sleep(0.005)

    def press(self, x, y, count=1):
        self.mouse("mouseMoved", x, y)
        self.mouse("mousePressed", x, y, button="left", clickCount=count, buttons=1)

    def release(self, x, y, count=1):
        self.mouse("mouseReleased", x, y, button="left", clickCount=count)

    def click(self, x, y, count=1):
        for k in range(1, count + 1):
            self.press(x, y, k)
            self.release(x, y, k)

    def click_on(self, selector):
        self.wait(f"document.querySelector({json.dumps(selector)})")
        x, y = self.run(f"(() => {{ const e = document.querySelector({json.dumps(selector)});"
                        "e.scrollIntoView({block: 'nearest'}); const b = e.getBoundingClientRect();"
                        "return [b.left + b.width / 2, b.top + b.height / 2]; })()")
        self.click(x, y)

    def choose(self, selector, value):
        self.run(f"(() => {{ const e = document.querySelector({json.dumps(selector)}); e.value = "
                 f"{json.dumps(value)}; e.dispatchEvent(new Event('change', {{bubbles: true}})); }})()")
