#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `toolpath --strategy z-level` and `--steep-angle` print, by a reader and a cutter of the test's own.

usage: z_level_test.py PROGRAM

The parts are z = f(x, y), polynomials that a bicubic grid holds exactly, so the surface is known here without the
file: a dome whose sides get as steep as 72 degrees, and a bowl. Judged are, for three cutters: no cut into the part
beyond the tolerance; passes of z-level lie on as many heights as there are levels and half ways between them; on the
walls no more stays than the scallop; with zigzag nowhere more; exit code and words where levels are not meant for.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

WIDE, TOLERANCE, SCALLOP, STEEP = 24.0, 0.01, 0.2, 40.0
MIDDLE = 0.5 * WIDE


class Part:
    """z = sign ((x - m)^2 + (y - m)^2) / scale."""

    def __init__(self, sign, scale):
        self.sign, self.scale = sign, scale

    def height(self, x, y):
        return self.sign * ((x - MIDDLE) ** 2 + (y - MIDDLE) ** 2) / self.scale

    def normal(self, x, y):
        dx, dy = (2.0 * self.sign * (w - MIDDLE) / self.scale for w in (x, y))
        size = np.sqrt(1.0 + dx * dx + dy * dy)
        return np.stack([-dx / size, -dy / size, 1.0 / size], axis=-1)

    def text(self):
        return "\n".join("".join(f"{x:.17g} {y:.17g} {self.height(x, y):.17g}\n" for x in np.linspace(0.0, WIDE, 7))
                         for y in np.linspace(0.0, WIDE, 7))

    def points(self, count):
        """Off the raster of anything that the program looks at; a diameter away from the borders."""
        rng = np.random.default_rng(7)
        x, y = rng.uniform(3.0, WIDE - 3.0, (2, count))
        return np.stack([x, y, self.height(x, y)], axis=-1), self.normal(x, y)


def feed_moves(text):
    at, code, moves = [None, None, None], None, []
    for line in text.splitlines():
        ends = list(at)
        for letter, value in re.findall(r"([A-Z])(-?[0-9.]+)", re.sub(r"\(.*?\)|;.*", "", line)):
            if letter == "G" and value in ("0", "1"):
                code = int(value)
            assert not (letter == "G" and value in ("2", "3", "91")), line
            if letter in "XYZ":
                ends["XYZ".index(letter)] = float(value)
        if ends != at and None not in at and code == 1:
            moves.append((np.array(at), np.array(ends)))
        at = ends
    return moves


def depth_in(radius, corner, moves, points):
    """How far points lie inside the body that goes along the moves, at most. A ball by the exact distance from each
    move; others at places of it 0.03 apart, which cuts less by 0.03^2 / (8 corner) at most on level ways."""
    deepest = np.full(len(points), -np.inf)
    ring = radius - corner
    order = np.argsort(points[:, 0])
    xs = points[order, 0]
    for a, b in moves:
        low, high = np.minimum(a, b), np.maximum(a, b)
        part = order[np.searchsorted(xs, low[0] - radius):np.searchsorted(xs, high[0] + radius)]
        near = part[(points[part, 1] >= low[1] - radius) & (points[part, 1] <= high[1] + radius)
                    & (points[part, 2] >= low[2])]
        if not len(near):
            continue
        p, way = points[near], b - a
        if ring == 0.0:
            middle = a + [0.0, 0.0, radius]
            t = np.clip((p - middle) @ way / (way @ way), 0.0, 1.0)
            d = p - middle - t[:, None] * way
            inside = radius - np.sqrt((d * d).sum(axis=1))
            above = p[:, 2] - middle[2] - t * way[2] > 0.0
            inside = np.where(above, radius - np.hypot(d[:, 0], d[:, 1]), inside)
            deepest[near] = np.maximum(deepest[near], inside)
            continue
        for s in np.linspace(0.0, 1.0, max(2, int(math.ceil(np.linalg.norm(way) / 0.03)) + 1)):
            d = p - (a + s * way)
            level = np.hypot(d[:, 0], d[:, 1])
            if corner > 0.0:
                rounded = corner - np.hypot(np.maximum(level - ring, 0.0), np.minimum(d[:, 2] - corner, 0.0))
            else:
                rounded = np.minimum(radius - level, d[:, 2])
            body = (d[:, 2] >= corner) | (level <= ring)
            inside = np.where(body, np.minimum(radius - level, d[:, 2]), rounded)
            deepest[near] = np.maximum(deepest[near], inside)
    return deepest


def program(binary, folder, part, *options):
    (folder / "part.txt").write_text(part.text())
    subprocess.run([binary, "surface", "grid", "part.txt", "--spread", "uniform", "--units", "mm", "-o", "part.json",
                    "-q"], cwd=folder, check=True)
    out = subprocess.run([binary, "toolpath", "part.json", "--tolerance", str(TOLERANCE), "--motion", "lines", "-o",
                          "part.nc", "--json", *options], cwd=folder, capture_output=True, text=True)
    assert out.returncode in (0, 5), out.stderr
    return out, json.loads(out.stdout), (folder / "part.nc").read_text()


def judge(binary, folder, name, part, cutter, diameter, corner, *strategy):
    given = ["--cutter", cutter, "--diameter", str(diameter), "--scallop", str(SCALLOP), *strategy]
    out, report, text = program(binary, folder, part, *given, *(["--corner-radius", str(corner)] if cutter == "bull"
                                                                 else []))
    moves, radius = feed_moves(text), 0.5 * diameter
    points, normals = part.points(800)
    gouge = depth_in(radius, corner, moves, points).max()
    assert gouge <= TOLERANCE, f"{name}: {gouge} mm into the part"
    assert gouge <= report["gouge"]["most"] + 1e-3, (name, gouge)
    steep = normals[:, 2] < math.cos(math.radians(STEEP))
    alone = "z-level" in strategy
    judged = steep if alone else np.ones(len(points), dtype=bool)
    over = points[judged] + SCALLOP * normals[judged]
    left = depth_in(radius, corner, moves, over)
    slack = 2e-4 if corner else 0.03 * 0.5  # between places of the moves; sharp corners: half their distance
    missed = left < -slack
    assert not missed.any() or report["scallop"]["found"] > SCALLOP or report["unreached_area"] > 0.0, (
        f"{name}: more than the scallop stays at {over[np.argmin(left)]}, {-left.min()} more, and nothing is said")
    assert report["levels"] > 1, report
    if alone:
        level = {round(a[2], 4) for a, b in moves if abs(a[2] - b[2]) < 1e-9 and np.linalg.norm(b - a) > 0.5}
        assert len(level) <= report["levels"] + report["added_passes"], (name, len(level), report["levels"])
        if not steep.all() and report["flat_area"] > 0.0:
            assert out.returncode == 5 and "flatter than levels are for" in out.stderr, (name, out.stderr)
            place = points[~steep]
            too_much = depth_in(radius, corner, moves, place + SCALLOP * normals[~steep]) < -0.02
            share, told = too_much.sum() / len(points), report["flat_area"] / report["surface_area"]
            assert share == 0.0 or told > 0.0, (name, share, told)
    print(f"{name}: {report['levels']} levels, {report['passes']} passes, cuts {gouge:.4f} deep, "
          f"{missed.sum()} of {judged.sum()} places keep more than {SCALLOP}, told {report['scallop']['found']}, "
          f"exit {out.returncode}")
    return out, report


def refused(binary, folder, *options):
    out = subprocess.run([binary, "toolpath", "part.json", "-o", "no.nc", *options], cwd=folder, capture_output=True,
                         text=True)
    assert out.returncode == 2 and "E203" in out.stderr, (options, out.stderr)


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        dome, bowl = Part(-1.0, 8.0), Part(1.0, 18.0)
        levels = ("--strategy", "z-level", "--steep-angle", str(STEEP))
        both = ("--steep-angle", str(STEEP))
        out, report = judge(binary, folder, "ball, dome, levels", dome, "ball", 6.0, 3.0, *levels)
        assert out.returncode == 5 and report["scallop"]["found"] <= SCALLOP and report["flat_area"] > 0.0
        out, report = judge(binary, folder, "ball, dome, both", dome, "ball", 6.0, 3.0, *both)
        assert out.returncode == 0, out.stderr
        out, report = judge(binary, folder, "bull, dome, both", dome, "bull", 6.0, 1.5, *both)
        assert out.returncode == 0, out.stderr
        out, report = judge(binary, folder, "ball, bowl, both", bowl, "ball", 6.0, 3.0, *both)
        assert out.returncode == 0, out.stderr
        # levels by the step down alone, with a flat cutter
        out, report, text = program(binary, folder, dome, "--strategy", "z-level", "--step-down", "2", "--cutter",
                                    "flat")
        moves = feed_moves(text)
        gouge = depth_in(3.0, 0.0, moves, dome.points(800)[0]).max()
        assert gouge <= TOLERANCE, f"flat: {gouge} mm into the part"
        heights = sorted({round(a[2], 3) for a, b in moves if a[2] == b[2] and np.linalg.norm(b - a) > 0.1})
        assert len(heights) == report["levels"] and max(np.diff(heights)) <= 2.0 + 2e-3, (heights, report)
        refused(binary, folder, "--strategy", "z-level", "--step-over", "1")
        refused(binary, folder, "--strategy", "scallop", "--steep-angle", "40")
        refused(binary, folder, "--steep-angle", "90")
        refused(binary, folder, "--strategy", "z-level", "--stock", "0,0,0,1,1,1")
        refused(binary, folder, "--step-down", "1")
        refused(binary, folder, "--strategy", "z-level", "--step-down", "1e-9")


if __name__ == "__main__":
    main()
