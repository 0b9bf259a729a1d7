#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Judges pages and pictures of surfaces from outside: as HTML, in a browser, by their pixels.

usage: page_judge.py html FILE                     structure; one line for each fault
       page_judge.py shot FILE FRAGMENT PNG [FLAG...]   a browser's picture of the page
       page_judge.py dom FILE FRAGMENT SCRIPT [FLAG...] attributes of <html> after a script ran
       page_judge.py pixels PNG EXPRESSION...      numbers; names: see `measures`
       page_judge.py difference PNG PNG...  part of the pixels that differ in the closest two
"""
import html.parser
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy
import PIL.Image

VOID = {"meta", "input", "br", "img", "link", "hr"}
WIDTH, HEIGHT = 900, 560


class Structure(html.parser.HTMLParser):
    def __init__(self):
        super().__init__()
        self.open, self.ids, self.faults, self.tags = [], set(), [], []
        self.named = 0

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.tags.append(tag)
        for key, value in attributes:
            if key.startswith("on"):
                self.faults.append(f"{tag} has {key}")
            if key in ("src", "href", "action", "data"):
                self.faults.append(f"{tag} points to {value}")
        if "id" in values:
            if values["id"] in self.ids:
                self.faults.append(f"two elements {values['id']}")
            self.ids.add(values["id"])
        if tag in ("input", "select") and "label" not in self.open and "aria-label" not in values:
            self.faults.append(f"{tag} {values.get('id')} has no label")
        if tag not in VOID and not (self.open and self.open[-1] == "path"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open[-1] != tag:
            self.faults.append(f"</{tag}> closes {self.open[-1:]}")
        else:
            self.open.pop()


def judge_html(name):
    text = pathlib.Path(name).read_text(encoding="utf-8")
    parser = Structure()
    parser.feed(text)
    faults = parser.faults
    if not text.startswith("<!DOCTYPE html>"):
        faults.append("no doctype")
    if parser.open:
        faults.append(f"never closed: {parser.open}")
    for wanted in ("html", "head", "title", "style", "body", "canvas", "h1", "noscript"):
        if wanted not in parser.tags:
            faults.append(f"no {wanted}")
    if parser.tags.count("script") != 3:
        faults.append(f"{parser.tags.count('script')} scripts")
    if "img" in parser.tags or "link" in parser.tags:
        faults.append("something to fetch")
    if re.search(r"\b(?:https?:)?//[a-z]+\.", text.split('<script type="application/json"')[0]):
        faults.append("an address of the network")
    if "default-src 'none'" not in text:
        faults.append("the browser may fetch things")
    print("\n".join(faults), end="")


def browse(arguments, page, fragment):
    with tempfile.TemporaryDirectory() as profile:
        command = ["timeout", "90", "chromium", "--headless", "--no-sandbox", "--no-first-run",
                   "--disable-background-networking", "--use-gl=angle",
                   "--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--hide-scrollbars",
                   "--enable-logging=stderr", "--virtual-time-budget=1500",
                   f"--window-size={WIDTH},{HEIGHT}", f"--user-data-dir={profile}", *arguments,
                   pathlib.Path(page).absolute().as_uri() + fragment]
        done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit("the browser failed: " + done.stderr[-400:])
    for line in done.stderr.splitlines():
        if "CONSOLE" in line:
            sys.exit("console: " + line)
    return done.stdout


def dom(name, fragment, script, flags):
    """A copy of the page with one more script; what <html> says when that has run."""
    text = pathlib.Path(name).read_text(encoding="utf-8")
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "page.html"
        copy.write_text(text.replace("</body>", f"<script>{script}</script></body>"))
        out = browse(["--dump-dom", *flags], copy, fragment)
    print(re.search(r"<html[^>]*>", out).group(0))


def png(name):
    """Height x width x 3 numbers of a picture, 0 to 255."""
    return numpy.asarray(PIL.Image.open(name).convert("RGB"), dtype=int)


# of red, green and blue, each height x width
KINDS = {
    "green": lambda r, g, b: (g > r + 40) & (g > b),
    "blue": lambda r, g, b: (b > r + 50) & (b > g),
    "red": lambda r, g, b: (r > b + 40) & (r > g),
    "brown": lambda r, g, b: (r > b + 15) & (r > g),
    "dark": lambda r, g, b: r + g + b < 240,
    "ink": lambda r, g, b: r + g + b < 700,
}


def measures(picture, kind, box):
    """count, left, top, right, bottom of the pixels of a kind within left,top,right,bottom."""
    left, top, right, bottom = box
    inside = picture[top:bottom, left:right]
    ys, xs = numpy.nonzero(KINDS[kind](*numpy.moveaxis(inside, 2, 0)))
    if len(xs) == 0:
        return (0, 0, 0, 0, 0)
    return (len(xs), left + xs.min(), top + ys.min(), left + xs.max() + 1, top + ys.max() + 1)


def main(task, *rest):
    if task == "html":
        judge_html(rest[0])
    elif task == "shot":
        browse([f"--screenshot={rest[2]}", *rest[3:]], rest[0], rest[1])
    elif task == "dom":
        dom(rest[0], rest[1], rest[2], rest[3:])
    elif task == "pixels":
        picture = png(rest[0])
        for question in rest[1:]:  # KIND,LEFT,TOP,RIGHT,BOTTOM
            kind, *box = question.split(",")
            print(*measures(picture, kind, [int(n) for n in box]))
    elif task == "difference":
        pictures = [png(name) for name in rest]
        parts = [(abs(a - b).max(axis=2) > 24).mean()
                 for k, a in enumerate(pictures) for b in pictures[:k]]
        print(min(parts))
    else:
        sys.exit(__doc__)


main(*sys.argv[1:])
