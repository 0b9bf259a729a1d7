#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What a larger cutter left is found and milled by a smaller one: `toolpath --rest-of`, by a judge of its own.

usage: rest_test.py PROGRAM

The part is a trough z = x^2 / 4, which a bicubic grid holds exactly; its bottom bends with a radius of 2. A ball of radius 3
rests on both sides at x = -+sqrt(5), 1/4 over the bottom. The report has to know that depth and the strip below the ball.
Then the printed programs of both cutters are swept together: nowhere does more than the scallop stay, no gouge is deeper
than the tolerance, while the larger cutter alone leaves more on that strip, and the smaller one needs a part of its whole way.
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from roughing_test import along, depth_in, moves_of, refused  # noqa: E402

WIDE, DEEP, TOLERANCE, SCALLOP = 5.0, 2.5, 0.01, 0.05
LARGE, SMALL = 6.0, 2.0
CENTRE = 0.25 * 5.0 + 2.0  # of the ball that rests on both sides: its height
REACHED = 1.2 * TOLERANCE  # what counts as reached: docs/methods/toolpath.md


def height(x):
    return 0.25 * x * x


def strip():
    """x up to which the resting ball is farther from the trough than what counts as reached, by halving."""
    near, far = 0.0, math.sqrt(5.0)
    for _ in range(60):
        x = 0.5 * (near + far)
        gap = math.hypot(x, CENTRE - height(x)) - 0.5 * LARGE
        near, far = (x, far) if gap > REACHED else (near, x)
    return near


def length(x):
    """Of the parabola from its vertex."""
    s = 0.5 * x
    return 0.5 * (x * math.sqrt(1.0 + s * s) + 2.0 * math.asinh(s))


def program(binary, folder, *options, code=0):
    done = subprocess.run([binary, "toolpath", "part.json", "--tolerance", str(TOLERANCE), "--motion", "lines", "-o",
                           "part.nc", "--json", *map(str, options)], cwd=folder, capture_output=True, text=True)
    assert done.returncode == code, (options, done.returncode, done.stderr)
    tips = [along(a, b, 0.08) for code, a, b in moves_of((folder / "part.nc").read_text()) if code == 1]
    return json.loads(done.stdout), np.concatenate(tips) if tips else np.zeros((0, 3))


def places():
    """A little inside of the borders, over which cutters roll."""
    xs, ys = np.meshgrid(np.arange(-WIDE + 0.1, WIDE, 0.07), np.arange(-DEEP + 0.1, DEEP, 0.23))
    x, y = xs.ravel(), ys.ravel()
    size = np.sqrt(1.0 + 0.25 * x * x)
    return np.stack([x, y, height(x)], axis=-1), np.stack([-0.5 * x / size, 0.0 * x, 1.0 / size], axis=-1)


def scallop_line(binary, folder, *options):
    """What is told about the scallop, and of which places."""
    out = subprocess.run([binary, "toolpath", "part.json", "--cutter", "ball", "--scallop", str(SCALLOP), "--tolerance",
                          str(TOLERANCE), *map(str, options), "-o", "part.nc"], cwd=folder, capture_output=True, text=True)
    return next(line for line in out.stdout.splitlines() if line.startswith("scallop"))


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "part.txt").write_text("\n".join("".join(f"{x:.17g} {y:.17g} {height(x):.17g}\n"
                                                           for x in np.linspace(-WIDE, WIDE, 9))
                                                   for y in np.linspace(-DEEP, DEEP, 7)))
        subprocess.run([binary, "surface", "grid", "part.txt", "--spread", "uniform", "--units", "mm", "-o", "part.json",
                        "-q"], cwd=folder, check=True)
        points, normals = places()
        # a scallop beside a place that counts as reached from its tolerance off
        limit = points + (1.02 * SCALLOP + REACHED) * normals
        _, tips = program(binary, folder, "--diameter", LARGE, "--scallop", SCALLOP, code=5)
        # passes of a ball of radius r across the trough come to r^2 / 4 + 1 - r over the bottom, and keep to their tolerance
        told, _ = program(binary, folder, "--diameter", 8.0, "--scallop", SCALLOP, code=5)
        assert 1.0 - TOLERANCE < told["unreached_depth"] < 1.0 + TOLERANCE, told["unreached_depth"]
        before = depth_in(0.5 * LARGE, 0.5 * LARGE, tips, limit)
        edge = strip()
        high = abs(points[:, 0][before < 0.0])
        assert len(high) > 100 and high.max() < edge, (len(high), high.max(), edge)
        share = length(edge) / length(WIDE)
        for cutter, corner, strategy, most in (("ball", 1.0, ("zigzag",), 0.55), ("ball", 1.0, ("zigzag", "--angle", 30), 0.55),
                                               ("ball", 1.0, ("scallop",), 0.6), ("ball", 1.0, ("isoparametric",), 0.6),
                                               ("ball", 1.0, ("isoparametric", "--along-v"), 0.7),
                                               ("bull", 0.9, ("zigzag", "--one-way"), 0.7),
                                               ("ball", 1.0, ("zigzag", "--steep-angle", 30), 0.7)):
            label = f"{cutter}, {' '.join(map(str, strategy))}"
            options = ["--cutter", cutter, "--diameter", SMALL, "--strategy", *strategy, "--scallop", SCALLOP,
                       *(["--corner-radius", corner] if cutter == "bull" else [])]
            whole, _ = program(binary, folder, *options)
            told, rest = program(binary, folder, *options, "--rest-of", LARGE, "--rest-corner", 0.5 * LARGE)
            assert told["cutting_length"] < most * whole["cutting_length"], (label, told["cutting_length"])
            assert whole["leftover_area"] == 0.0
            # cells at the strip's edges count by their middles
            wide = 2.0 * told["spacing"] / length(WIDE)
            assert abs(told["leftover_area"] / told["surface_area"] - share) < wide, (label, told["leftover_area"], share)
            # that of the closed form (the middle of a cell lies aside); the search ends by a step of 1e-4 of the radius, up
            # the sides where the ball rests, which lean by sqrt(5) / 2
            depth = told["leftover_depth"]
            assert 0.25 - TOLERANCE < depth < 0.25 + 1e-4 * 0.5 * LARGE * math.sqrt(5.0) / 2.0 + TOLERANCE, (label, depth)
            both = np.maximum(before, depth_in(0.5 * SMALL, corner, rest, limit))
            assert both.min() >= 0.0, f"{label}: {(both < 0.0).sum()} places keep more than the scallop"
            gouge = depth_in(0.5 * SMALL, corner, rest, points).max()
            assert gouge <= TOLERANCE, f"{label}: {gouge} deep in the part"
            print(f"{label}: {told['cutting_length']:.0f} of {whole['cutting_length']:.0f} mm, {100 * share:.1f} % left before, "
                  f"{depth:.3f} high; gouge {max(0.0, gouge):.4f}")
        # a ball that bends more than the trough comes everywhere
        told, rest = program(binary, folder, "--diameter", SMALL, "--rest-of", 3.0)
        assert told["leftover_area"] == 0.0 and told["passes"] == 0 and len(rest) == 0, told
        assert any("nothing is left" in w for w in told["warnings"]), told["warnings"]
        assert "none is looked at" in scallop_line(binary, folder, "--diameter", SMALL, "--rest-of", 3.0)
        said = scallop_line(binary, folder, "--diameter", SMALL, "--rest-of", LARGE)
        assert "and the earlier one left too much, at" in said and said.endswith("exceeded nowhere there"), said
        assert "earlier" not in scallop_line(binary, folder, "--diameter", SMALL)
        for wrong in (["--diameter", "2", "--rest-of", "2"], ["--diameter", "2", "--rest-of", "1e9"], ["--diameter", "2", "--rest-corner", "1"],
                      ["--diameter", "2", "--rest-of", "6", "--rest-corner", "4"],
                      ["--diameter", "2", "--rest-of", "6", "--strategy", "rough"]):
            refused(binary, folder, *wrong)


if __name__ == "__main__":
    main()
