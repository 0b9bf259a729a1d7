#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `toolpath --strategy rough` prints, by a reader and a stock of the test's own.

usage: roughing_test.py PROGRAM

The part is z = f(x, y), a polynomial that a bicubic grid holds exactly, so the surface is known here without
the file. Judged are, for three cutters and passes along X and at an angle: no cut into part and allowance
beyond the tolerance; rapid moves only at or up to the safe height; no way straight down or steeper than the
ramp meets stock; no way cuts deeper than a level; the stock is gone down to its bottom beside the part; the
report's stock that is left is what is left there. An allowance of zigzag passes is judged likewise.
"""
import bisect
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

WIDE, DEEP, TOLERANCE, ALLOWANCE, LEVEL = 30.0, 20.0, 0.02, 0.4, 2.5


def height(x, y):
    return 6.0 - ((x - 13.0) / 8.0) ** 2 - ((y - 11.0) / 6.0) ** 2


def normal(x, y):
    dx, dy = -2.0 * (x - 13.0) / 64.0, -2.0 * (y - 11.0) / 36.0
    size = np.sqrt(1.0 + dx * dx + dy * dy)
    return np.stack([-dx / size, -dy / size, 1.0 / size], axis=-1)


def grid_text():
    rows = []
    for y in np.linspace(0.0, DEEP, 7):
        rows.append("".join(f"{x:.17g} {y:.17g} {height(x, y):.17g}\n" for x in np.linspace(0.0, WIDE, 7)))
    return "\n".join(rows)


def moves_of(text):
    """(code, from, to) of every motion; arcs are refused here: programs are asked for in lines."""
    at, code, moves = [None, None, None], None, []
    for line in text.splitlines():
        line = re.sub(r"\(.*?\)|;.*", "", line)
        words = re.findall(r"([A-Z])(-?[0-9.]+)", line)
        ends = list(at)
        for letter, value in words:
            if letter == "G" and value in ("0", "1"):
                code = int(value)
            assert not (letter == "G" and value in ("2", "3", "91")), line
            if letter in "XYZ":
                ends["XYZ".index(letter)] = float(value)
        if ends != at:
            if None not in at:
                moves.append((code, np.array(at), np.array(ends)))
            at = ends
    return moves


def rise(radius, corner, level):
    """Height of a cutter's lower side over its tip."""
    out = np.maximum(0.0, level - (radius - corner))
    return corner - np.sqrt(np.maximum(0.0, corner * corner - out * out))


def depth_in(radius, corner, tips, points):
    """How far points lie inside the body at any of these tips, at most."""
    order = np.argsort(points[:, 0], kind="stable")
    x, y, z = points[order].T.copy()
    sorted_deepest, deepest = np.full(len(points), -np.inf), np.empty(len(points))
    ring = radius - corner
    first, last = np.searchsorted(x, tips[:, 0] - radius, "left"), np.searchsorted(x, tips[:, 0] + radius, "right")
    for tip, low, high in zip(tips.tolist(), first.tolist(), last.tolist()):
        near = np.flatnonzero((abs(y[low:high] - tip[1]) <= radius) & (z[low:high] >= tip[2]))
        if not near.size:
            continue
        near += low
        d = np.stack([x[near] - tip[0], y[near] - tip[1], z[near] - tip[2]], axis=1)
        level = np.hypot(d[:, 0], d[:, 1])
        rounded = corner - np.hypot(np.maximum(level - ring, 0.0), np.minimum(d[:, 2] - corner, 0.0))
        inside = np.where((d[:, 2] >= corner) | (level <= ring), np.minimum(radius - level, d[:, 2]), rounded)
        sorted_deepest[near] = np.maximum(sorted_deepest[near], inside)
    deepest[order] = sorted_deepest
    return deepest


def along(a, b, step):
    count = max(1, int(math.ceil(np.linalg.norm(b - a) / step)))
    return a + (b - a) * np.linspace(0.0, 1.0, count + 1)[:, None]


class Stock:
    """Heights over a raster, as far as the cutter has left them."""

    def __init__(self, low, high, cell, radius, corner):
        self.x = np.arange(low[0] + 0.5 * cell, high[0], cell)
        self.y = np.arange(low[1] + 0.5 * cell, high[1], cell)
        self.z = np.full((len(self.y), len(self.x)), high[2])
        self.radius, self.corner = radius, corner
        self.ends_x, self.ends_y = self.x.tolist(), self.y.tolist()

    def cut(self, tip):
        """Takes the cutter's body out; the highest stock over its lower side before."""
        x, y, z = tip.tolist()
        i = slice(*(bisect.bisect_left(self.ends_x, x + side) for side in (-self.radius, self.radius)))
        j = slice(*(bisect.bisect_left(self.ends_y, y + side) for side in (-self.radius, self.radius)))
        if i.start == i.stop or j.start == j.stop:
            return 0.0
        there = self.z[j, i]
        highest = float(there.max())
        if highest <= z:
            return 0.0
        level = np.hypot(self.x[i] - x, (self.y[j] - y)[:, None])
        lower = np.where(level < self.radius, z + rise(self.radius, self.corner, level) if self.corner else z, np.inf)
        over = float((there - lower).max())
        np.minimum(there, lower, out=there)
        return max(0.0, over)


def program(binary, folder, *options):
    out = subprocess.run([binary, "toolpath", "part.json", "--tolerance", str(TOLERANCE), "--allowance", str(ALLOWANCE),
                          "--motion", "lines", "-o", "part.nc", "--json", *options], cwd=folder, capture_output=True,
                         text=True)
    assert out.returncode == 0, out.stderr
    told = json.loads(out.stdout)
    for name in ("hidden_area", "unreached_area", "unreached_depth"):
        assert (told[name] is None) == ("rough" in options), f"only roughing does not look for {name}: {told[name]}"
    return told, (folder / "part.nc").read_text()


def surface_points(step):
    xs, ys = np.meshgrid(np.arange(0.0, WIDE + 1e-9, step), np.arange(0.0, DEEP + 1e-9, step))
    x, y = xs.ravel(), ys.ravel()
    n = normal(x, y)
    return np.stack([x, y, height(x, y)], axis=-1) + ALLOWANCE * n, n


def check_rough(binary, folder, cutter, diameter, corner, angle):
    name = f"{cutter} D{diameter} at {angle}"
    low = np.array([-ALLOWANCE, -ALLOWANCE, min(height(x, y) for x in (0.0, WIDE) for y in (0.0, DEEP))])
    high = np.array([WIDE + ALLOWANCE, DEEP + ALLOWANCE, 6.0 + ALLOWANCE])
    given = []
    if cutter == "flat":  # a larger block, its bottom below the part
        low, high = np.array([-1.0, -1.0, low[2] - 1.0]), np.array([WIDE + 12.0, DEEP + 1.0, 8.0])
        given = ["--stock", ",".join(f"{x:.17g}" for x in (*low, *high))]
    report, text = program(binary, folder, "--strategy", "rough", "--cutter", cutter, "--diameter", str(diameter),
                           "--step-down", str(LEVEL), "--angle", str(angle), "--ramp", "8", "--spindle", "9000",
                           *given, *(["--corner-radius", str(corner)] if cutter == "bull" else []))
    assert "M3 S9000\n" in text and text.index("M3 S9000") < text.index("G1 ") and "\nM5\n" in text, name
    radius = 0.5 * diameter
    stock = Stock(low, high, 0.25, radius, corner)
    tips, deepest = [], 0.0
    for code, a, b in moves_of(text):
        flat = math.hypot(b[0] - a[0], b[1] - a[1])
        if code == 0:
            assert min(a[2], b[2]) >= report["safe_z"] - 1e-3 or (flat == 0.0 and b[2] > a[2]), (name, a, b)
            continue
        steep = b[2] < a[2] - 1e-9 and a[2] - b[2] > math.tan(math.radians(8.01)) * flat + 2e-3
        way = along(a, b, 0.25)
        over = max(stock.cut(tip) for tip in way)
        # rounding of the last digit, and of places of the raster beside the way
        assert not steep or over <= 0.01, f"{name}: {over} mm of stock under a way down from {a} to {b}"
        deepest = max(deepest, over)
        tips.append(way)
    tips = np.concatenate(tips)
    assert deepest <= LEVEL + 0.01, f"{name}: a way cuts {deepest}"
    points, normals = surface_points(0.5)
    gouge = depth_in(radius, corner, tips, points).max()
    assert gouge <= TOLERANCE, f"{name}: {gouge} mm into part and allowance"
    assert gouge <= report["gouge"]["most"] + 1e-3, name
    if given:  # beside the part nothing stays over the bottom
        outside = stock.z[:, stock.x > WIDE + ALLOWANCE + 0.5]
        assert outside.size and np.mean(outside > low[2] + 1e-3) < 0.01, name
    # what the report says is left at its place is left there
    place = np.array(report["scallop"]["place"])
    foot = place.copy()
    for _ in range(50):
        foot[:2] = place[:2] - ALLOWANCE * normal(foot[0], foot[1])[:2]
    n = normal(foot[0], foot[1])
    ups = np.arange(0.0, report["scallop"]["found"] + 0.5, 0.005)
    covered = depth_in(radius, corner, tips, place + ups[:, None] * n) > 0.0
    first = ups[np.argmax(covered)] if covered.any() else math.inf
    assert abs(first - report["scallop"]["found"]) <= 0.05, f"{name}: {first} of {report['scallop']['found']}"
    # and over other places there is no more of the stock (they are not the middles that the program looks at)
    rows = np.arange(0, len(points), 7)
    heights = np.arange(0.0, report["scallop"]["found"] + 0.35, 0.1)
    lines = (points[rows, None, :] + heights[None, :, None] * normals[rows, None, :]).reshape(-1, 3)
    gone = (depth_in(radius, corner, tips, lines) > -0.05) | ((lines < low) | (lines > high)).any(axis=1)
    gone = gone.reshape(len(rows), -1).any(axis=1)
    assert gone.all(), f"{name}: more than told stays at {points[rows[np.argmin(gone)]]}"
    return report, gouge


def check_zigzag(binary, folder):
    report, text = program(binary, folder, "--cutter", "ball", "--diameter", "4", "--scallop", "0.1")
    tips = np.concatenate([along(a, b, 0.1) for code, a, b in moves_of(text) if code == 1])
    points, normals = surface_points(0.8)
    gouge = depth_in(2.0, 2.0, tips, points).max()
    assert gouge <= TOLERANCE, f"zigzag: {gouge} mm into the allowance"
    inner = points[(points[:, 0] > 2) & (points[:, 0] < WIDE - 2) & (points[:, 1] > 2) & (points[:, 1] < DEEP - 2)]
    n = normal(inner[:, 0], inner[:, 1])  # beside the foot by the allowance at most: turns by 0.02
    left = depth_in(2.0, 2.0, tips, inner + 0.12 * n)
    assert left.min() > -0.01, "zigzag: more than the scallop stays over the allowance"
    assert report["scallop"]["found"] <= 0.1, report["scallop"]


def refused(binary, folder, *options):
    out = subprocess.run([binary, "toolpath", "part.json", "-o", "no.nc", *options], cwd=folder, capture_output=True,
                         text=True)
    assert out.returncode == 2 and "E203" in out.stderr, (options, out.stderr)


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "part.txt").write_text(grid_text())
        subprocess.run([binary, "surface", "grid", "part.txt", "--spread", "uniform", "--units", "mm", "-o",
                        "part.json", "-q"], cwd=folder, check=True)
        for cutter, diameter, corner, angle in (("flat", 6.0, 0.0, 0.0), ("bull", 8.0, 1.5, 90.0),
                                                ("ball", 6.0, 3.0, 30.0)):
            report, gouge = check_rough(binary, folder, cutter, diameter, corner, angle)
            print(f"{cutter} D{diameter:g} at {angle:g} degrees: {report['levels']} levels, {report['passes']} passes, "
                  f"{report['minutes']:.1f} min, cuts {gouge:.4f} into the allowance, "
                  f"leaves {report['scallop']['found']:.3f} over it")
        check_zigzag(binary, folder)
        refused(binary, folder, "--ramp-height", "5")
        refused(binary, folder, "--strategy", "rough", "--stock", "0,0,0,1,1")
        refused(binary, folder, "--strategy", "rough", "--stock", "0,0,9,1,1,2")
        refused(binary, folder, "--strategy", "rough", "--scallop", "0.1")
        refused(binary, folder, "--strategy", "rough", "--step-down", "1e-9")
        refused(binary, folder, "--allowance=-1")


if __name__ == "__main__":
    main()
