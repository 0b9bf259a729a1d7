#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The time that `toolpath` and `cut` tell is that of their printed programs, by a reader and a sum of the test's own.

usage: machining_time_test.py PROGRAM

Along a row of blocks without a stop the square of the speed is the lower envelope of what feeds allow and of lines
that rise by twice the acceleration from every corner, where the speed is that of the circle that leaves it by the
tolerance. The envelope is laid over places along the blocks and summed. The program walks from block to block instead.
Beside that: with no limit of acceleration the time is that of lengths and feeds; a straight way there and back has a
closed form; and inches are inches.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

PARTS = 400  # of a block: what lies between two places costs less than is allowed below
WORD = re.compile(r"([A-Z])(-?[0-9.]+)")
PLANES = {17: (0, 1), 18: (2, 0), 19: (1, 2)}


class Block:
    """Length, feed a minute and directions at both ends; `code` 0 and `down`: from rest to rest."""

    def __init__(self, code, a, b, feed, plane, centre):
        self.code, self.feed = code, feed
        way = b - a
        if centre is None:
            self.length = float(np.linalg.norm(way))
            self.begin = self.end = way / self.length
        else:
            i, j = PLANES[plane]
            p, q = (np.array([e[i], e[j]]) - centre for e in (a, b))
            turn = math.atan2(q[1], q[0]) - math.atan2(p[1], p[0])
            sign = 1 if code == 3 else -1
            turn = (sign * turn) % (2 * math.pi)
            other = way[3 - i - j]
            across = np.hypot(*p) * turn
            self.length = math.hypot(across, other)
            self.begin, self.end = np.zeros(3), np.zeros(3)
            for out, r in ((self.begin, p), (self.end, q)):
                out[i], out[j] = sign * -r[1], sign * r[0]
                out *= across / np.linalg.norm(out)
                out[3 - i - j] = other
                out /= self.length
        self.down = centre is None and way[0] == 0 and way[1] == 0


def blocks_of(text, at):
    at, code, feed, plane, blocks = list(at), None, None, 17, []
    for line in text.splitlines():
        ends, ijk = list(at), {}
        for letter, value in WORD.findall(re.sub(r"\(.*?\)|;.*", "", line)):
            number = float(value)
            if letter == "G" and number in (0, 1, 2, 3):
                code = int(number)
            elif letter == "G" and number in PLANES:
                plane = int(number)
            elif letter == "F":
                feed = number
            elif letter in "XYZ":
                ends["XYZ".index(letter)] = number
            elif letter in "IJK":
                ijk["IJK".index(letter)] = number
        if ends != at:
            if None not in at:
                centre = None
                if code in (2, 3):
                    centre = np.array([at[k] + ijk[k] for k in PLANES[plane]])
                blocks.append(Block(code, np.array(at), np.array(ends), feed, plane, centre))
            at = ends
    return blocks


def seconds_of_row(row, acceleration, corner):
    """From rest to rest."""
    most = np.array([b.feed / 60 for b in row])
    squares = [0.0]
    for k in range(1, len(row)):
        half = 0.5 * math.acos(max(-1.0, min(1.0, float(row[k - 1].end @ row[k].begin))))
        square = min(most[k - 1], most[k]) ** 2
        if half > 1e-7:
            square = min(square, acceleration * corner * math.cos(half) / (1 - math.cos(half)))
        squares.append(max(0.0, square))
    squares.append(0.0)
    ends = np.concatenate([[0.0], np.cumsum([b.length for b in row])])
    places = np.concatenate([a + (b - a) * np.arange(PARTS) / PARTS for a, b in zip(ends, ends[1:])] + [ends[-1:]])
    limits = np.concatenate([np.repeat(most ** 2, PARTS), [np.inf]])
    limits[::PARTS] = np.minimum(limits[::PARTS], squares)
    rise = 2 * acceleration * places
    forth = np.minimum.accumulate(limits - rise) + rise
    back = (np.minimum.accumulate((limits + rise)[::-1])[::-1]) - rise
    speed = np.sqrt(np.maximum(0.0, np.minimum(forth, back)))
    steps, sums = np.diff(places), speed[:-1] + speed[1:]
    return float(np.sum(2 * steps[steps > 0] / sums[steps > 0]))


def minutes(text, at, rapid, acceleration, corner, stops_down):
    """`stops_down`: of `cut`, where ways straight down or up begin and end at rest."""
    total, row = 0.0, []

    def finish():
        nonlocal total, row
        if row:
            total += seconds_of_row(row, acceleration, corner)
        row = []

    for block in blocks_of(text, at):
        if block.code == 0:
            block.feed = rapid
        if block.code == 0 or stops_down and block.down:
            finish()
            row = [block]
            finish()
        else:
            row.append(block)
    finish()
    return total / 60


def wavy(unit):
    """30 x 20, waves of 4 in height, a grid of points in rows."""
    rows = []
    for y in np.linspace(0, 20, 21):
        rows.append("".join(f"{unit * x:.9g} {unit * y:.9g} {unit * (2 * math.sin(x / 4) * math.cos(y / 5)):.9g}\n"
                            for x in np.linspace(0, 30, 31)))
    return "\n".join(rows)


LINE = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n100\n21\n0\n0\nENDSEC\n0\nEOF\n"
PLATE = ("0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n" +
         "".join(f"10\n{x}\n20\n{y}\n42\n{b}\n" for x, y, b in ((0, 0, 0), (60, 0, 0.4), (60, 30, 0), (0, 40, -0.2)))
         + "0\nCIRCLE\n8\n0\n10\n30\n20\n15\n40\n6\n0\nENDSEC\n0\nEOF\n")


class Test:
    def __init__(self, binary, folder):
        self.binary, self.folder = binary, folder

    def run(self, *arguments):
        out = subprocess.run([self.binary, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True)
        assert out.returncode == 0, out.stderr
        return out.stdout

    def toolpath(self, part, *options):
        told = json.loads(self.run("toolpath", part, "-o", "p.nc", "--json", *options))
        return told, (self.folder / "p.nc").read_text()

    def holds(self, name, told, expected):
        off = abs(told - expected) / expected
        print(f"{name}: {told:.6f} min told, {expected:.6f} summed, {100 * off:.4f} %")
        assert off < 2e-4, name


def check_toolpaths(test):
    tolerance = 0.02
    for name, options in (("zigzag with arcs", ["--scallop", 0.1]),
                          ("zigzag at an angle, fast", ["--scallop", 0.1, "--angle", 30, "--feed", 5000]),
                          ("scallop, lines", ["--strategy", "scallop", "--scallop", 0.1, "--motion", "lines"]),
                          ("roughing", ["--strategy", "rough", "--cutter", "flat", "--step-down", 2])):
        times = []
        for acceleration in (None, 40, 1e12):
            more = [] if acceleration is None else ["--acceleration", acceleration]
            told, text = test.toolpath("mm.json", "--tolerance", tolerance, "--rapid-feed", 3000, *options, *more)
            if acceleration != 1e12:  # that is judged below
                expected = minutes(text, [None] * 3, 3000, acceleration or 500, tolerance, False)
                test.holds(f"{name}, acceleration {acceleration}", told["minutes"], expected)
            assert f"about {told['minutes']:.1f} min" in text, name
            times.append(told["minutes"])
        at_feeds = sum(b.length / (3000 if b.code == 0 else b.feed) for b in blocks_of(text, [None] * 3))
        assert abs(times[2] - at_feeds) < 1e-4 * at_feeds, (name, times[2], at_feeds)
        assert times[1] > times[0] > times[2], times
    told, text = test.toolpath("in.json", "--tolerance", tolerance / 25.4, "--diameter", 0.25, "--scallop", 0.004)
    assert "G20" in text
    test.holds("inches", told["minutes"], minutes(text, [None] * 3, 200, 500 / 25.4, tolerance / 25.4, False))
    for wrong in ("0", "-1", "nan", "inf"):
        out = subprocess.run([test.binary, "toolpath", "mm.json", "-o", "no.nc", f"--acceleration={wrong}"],
                             cwd=test.folder, capture_output=True, text=True)
        assert out.returncode == 2 and ("E203" in out.stderr or "E201" in out.stderr), (wrong, out.stderr)


def check_cuts(test):
    """The same knowledge behind `cut`."""
    (test.folder / "line.dxf").write_text(LINE)
    (test.folder / "plate.dxf").write_text(PLATE)
    for name, options in (("mill", ["--diameter", 4, "--depth", 5, "--pass-depth", 2]),
                          ("mill on ramps", ["--diameter", 4, "--depth", 5, "--pass-depth", 2, "--ramp", 4]),
                          ("laser", ["--laser", 100, "--feed", 6000, "--acceleration", 900])):
        told = json.loads(test.run("cut", "plate.dxf", "--units", "mm", "-o", "p.nc", "--json", "--decimals", 6, *options))
        text, a = (test.folder / "p.nc").read_text(), 900 if name == "laser" else 500
        test.holds(f"cut, {name}", told["report"]["minutes"], minutes(text, [0.0, 0.0, 0.0], 3000, a, 0.01, True))
    told = json.loads(test.run("cut", "line.dxf", "--units", "mm", "-o", "p.nc", "--json", "--laser", 100))
    v, a = 1000 / 60, 500
    assert abs(told["report"]["minutes"] * 60 - 100 / v - v / a) < 1e-6


def main():
    with tempfile.TemporaryDirectory() as name:
        test = Test(str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(name))
        for unit, scale in (("mm", 1.0), ("in", 1 / 25.4)):
            (test.folder / f"{unit}.txt").write_text(wavy(scale))
            test.run("surface", "grid", f"{unit}.txt", "--spread", "uniform", "--units", unit, "-o", f"{unit}.json", "-q")
        check_toolpaths(test)
        check_cuts(test)


if __name__ == "__main__":
    main()
