#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Straights and arcs whose points are printed with few digits: `obvid alignment` without a tolerance
finds these elements, and every distance that it prints is that of the point.

usage: rounded_alignments_test.py PROGRAM
"""
import json
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def row_of(parts, heading, step, at):
    """Points every `step` along parts (length, curvature), by the closed forms of line and arc."""
    out, (x, y), due = [at], at, step
    for length, kappa in parts:
        def place(s):
            if kappa == 0:
                return x + s * math.cos(heading), y + s * math.sin(heading)
            turned = heading + kappa * s
            return (x + (math.sin(turned) - math.sin(heading)) / kappa,
                    y - (math.cos(turned) - math.cos(heading)) / kappa)
        while due < length + 1e-9:
            out.append(place(due))
            due += step
        due -= length
        (x, y), heading = place(length), heading + kappa * length
    return out


def offset(element, p):
    """From a line or an arc of the table to a point beside it, to the left positive."""
    ahead = math.cos(element["heading"]), math.sin(element["heading"])
    dx, dy = p[0] - element["x"], p[1] - element["y"]
    across = ahead[0] * dy - ahead[1] * dx
    kappa = element["curvature_start"]
    if kappa == 0:
        return across
    cx, cy = element["x"] - ahead[1] / kappa, element["y"] + ahead[0] / kappa
    return (1 / abs(kappa) - math.dist(p, (cx, cy))) * math.copysign(1, kappa)


class RoundedAlignments(unittest.TestCase):
    def found(self, points, digits, scale=1.0):
        text = "".join(f"{x * scale:.{digits}f},{y * scale:.{digits}f}\n" for x, y in points)
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "points.csv"
            path.write_text(text)
            done = subprocess.run([PROGRAM, "alignment", str(path), "--units", "m", "--json"],
                                  capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        printed = [tuple(map(float, line.split(","))) for line in text.splitlines()]
        return json.loads(done.stdout), printed

    def test_straights_are_lines_and_arcs_are_arcs_in_every_direction(self):
        parts = {"line arc": [(100, 0), (60, 1 / 50)], "arc line": [(48, -1 / 30), (85, 0)],
                 "line arc line": [(70, 0), (90, 1 / 120), (65, 0)]}
        for k, (kinds, lengths) in enumerate(parts.items()):
            for degrees in (0, 10, 45, 77, 133, 290):
                for step, at in ((1, (0.0, 0.0)), (5, (3.5e5, 5.6e6))):
                    with self.subTest(kinds=kinds, degrees=degrees, step=step):
                        points = row_of(lengths, math.radians(degrees + k), step, at)
                        self.hold(points, lengths, kinds.split(), 4)

    def hold(self, points, lengths, kinds, digits):
        found, printed = self.found(points, digits)
        self.assertEqual([e["kind"] for e in found["elements"]], kinds)
        cell = 0.5 * math.sqrt(2) * 10**-digits
        self.assertAlmostEqual(found["tolerance"], cell, delta=1e-12)
        for element, (length, kappa) in zip(found["elements"], lengths):
            # an arc of n points that are a cell off has its curvature within 8 cells over its length squared
            self.assertAlmostEqual(element["curvature_start"], kappa, delta=20 * cell / length**2)
        starts = [e["station"] for e in found["elements"]]
        for p, told in zip(printed, found["deviations"]):
            self.assertLessEqual(abs(told["offset"]), cell * (1 + 1e-9))
            at = max(i for i, s in enumerate(starts) if s <= max(told["station"], 0.0))
            # coordinates of millions have a rounding of 1e-9
            self.assertAlmostEqual(offset(found["elements"][at], p), told["offset"], delta=1e-8)

    def test_the_size_does_not_matter(self):
        points = row_of([(100, 0), (60, 1 / 50)], math.radians(77), 1, (0.0, 0.0))
        for scale, digits in ((1e-3, 7), (1e3, 1)):
            found, _ = self.found(points, digits, scale)
            self.assertEqual([e["kind"] for e in found["elements"]], ["line", "arc"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
