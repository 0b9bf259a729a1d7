#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The table of lines and arcs against the pieces of the contour file beside it.

usage: lines_and_arcs_test.py PROGRAM
"""
import cmath
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
NUMBER = r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?"
ROW = re.compile(rf"^ *(\d+)-(\d+) +(straight|{NUMBER}) +(-|{NUMBER}) +(-|{NUMBER}) +({NUMBER}) +({NUMBER}) +({NUMBER})$")


def moved(points, noise):
    dice = random.Random(11)
    return [(x + dice.uniform(-noise, noise), y + dice.uniform(-noise, noise)) for x, y in points]


def bend():
    """A line of 40, an arc of radius 10 to the left over a right angle, a line of 40."""
    points = [(i, 0.0) for i in range(41)]
    for i in range(1, 16):
        angle = i / 16 * math.pi / 2
        points.append((40 + 10 * math.sin(angle), 10 - 10 * math.cos(angle)))
    return points + [(50.0, 10.0 + i) for i in range(41)]


def rounded_square():
    """Sides of 40 and corners of radius 10, counterclockwise, closed."""
    points, side = [], [(10.0 + 2 * i, 0.0) for i in range(21)]
    side += [(50 + 10 * math.sin(a), 10 - 10 * math.cos(a)) for a in (math.pi / 32 * k for k in range(1, 16))]
    for quarter in range(4):
        c, s = [(1, 0), (0, 1), (-1, 0), (0, -1)][quarter]
        points += [(30 + c * (x - 30) - s * (y - 30), 30 + s * (x - 30) + c * (y - 30)) for x, y in side]
    return points


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.at = pathlib.Path(self.folder.name)

    def fit(self, points, *options):
        (self.at / "p.csv").write_text("x_mm,y_mm\n" + "".join(f"{x:.6f},{y:.6f}\n" for x, y in points))
        done = subprocess.run([PROGRAM, "fit", self.at / "p.csv", "-o", self.at / "c.json", "-o", self.at / "r.html",
                               *map(str, options)], capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        text = done.stdout
        rows = []
        if "line or arc" in text:
            table = text[text.index("line or arc"):].split("\n\n")[0]
            rows = [found.groups() for found in map(ROW.match, table.splitlines()) if found]
        return rows, json.loads((self.at / "c.json").read_text()), done.stderr

    def expected(self, contour):
        """Of each line and arc with four points or more: points, curvature, centre, heading, length, farthest point.
        Neighbours of one kind and curvature are one: parts of an arc, and what leads to the first point or on from the
        last one."""
        out = []
        pieces, elements, points = contour["pieces"], contour["elements"], contour["points"]
        size = len(pieces)
        at = lambda k: elements[k % len(elements)]  # noqa: E731

        def same(a, b):
            a, b = pieces[a % size], pieces[b % size]
            return a["type"] == b["type"] and a["type"] in ("line", "arc") and (
                a["type"] == "line" or math.isclose(a["kappa"], b["kappa"], rel_tol=1e-9))

        begin = next(k for k in range(size) if k == 0 and not contour["closed"] or not same(k - 1, k))
        while begin < size:
            end = begin + 1
            while (contour["closed"] or end < size) and same(end - 1, end):
                end += 1
            kind, sources = pieces[begin % size]["type"], [at(k)["source"] for k in range(begin, end + 1)]
            sources = [k for k in sources if k is not None]
            if kind in ("line", "arc") and len(sources) > 1 and (sources[-1] - sources[0]) % len(points) >= 3:
                out.append(self.figures(contour, begin, end, sources[0], sources[-1]))
            begin = end
        if contour["closed"]:  # what goes over the start was met last
            out.sort(key=lambda row: row[0])
        return out

    def figures(self, contour, begin, end, first, last):
        pieces, elements, points = contour["pieces"], contour["elements"], contour["points"]
        parts = [pieces[k % len(pieces)] for k in range(begin, end)]
        mine = [points[(first + i) % len(points)] for i in range((last - first) % len(points) + 1)]
        if parts[0]["type"] == "line":
            start, stop = parts[0]["start"], parts[-1]["end"]
            along = complex(stop[0] - start[0], stop[1] - start[1])
            off = max(abs((complex(x - start[0], y - start[1]) / along).imag) * abs(along) for x, y in mine)
            return first, last, 0.0, None, cmath.phase(along), abs(along), off
        theta, kappa, start = parts[0]["theta0"], parts[0]["kappa"], parts[0]["start"]
        centre = (start[0] - math.sin(theta) / kappa, start[1] + math.cos(theta) / kappa)
        off = max(abs(math.dist(centre, p) - abs(1 / kappa)) for p in mine)
        return first, last, kappa, centre, theta, sum(p["length"] for p in parts), off

    def check(self, rows, contour):
        expected = self.expected(contour)
        self.assertEqual(len(rows), len(expected))
        for row, (first, last, kappa, centre, theta, length, off) in zip(rows, expected):
            self.assertEqual((int(row[0]), int(row[1])), (first + 1, last + 1))
            if kappa == 0:
                self.assertEqual(row[2:5], ("straight", "-", "-"))
            else:
                self.assertAlmostEqual(float(row[2]) * kappa, 1.0, delta=1e-4)
                for told, true in zip(row[3:5], centre):
                    self.assertAlmostEqual(float(told), true, delta=1e-3)
            self.assertAlmostEqual(math.remainder(math.radians(float(row[5])) - theta, 2 * math.pi), 0.0, delta=1e-4)
            self.assertAlmostEqual(float(row[6]) / length, 1.0, delta=1e-4)
            self.assertAlmostEqual(float(row[7]), off, delta=1e-3 * off + 1e-12)


class OfAScan(Folder):
    def test_line_arc_and_line(self):
        rows, contour, _ = self.fit(moved(bend(), 0.004), "--noise", 0.02, "--primitives")
        self.check(rows, contour)
        self.assertEqual([row[2] == "straight" for row in rows], [True, False, True])
        self.assertAlmostEqual(float(rows[1][2]), 10.0, delta=0.2)  # what was drawn
        self.assertAlmostEqual(float(rows[1][3]), 40.0, delta=0.2)
        self.assertAlmostEqual(float(rows[1][4]), 10.0, delta=0.2)
        for row in rows:
            self.assertLessEqual(float(row[7]), 0.02)
        page = (self.at / "r.html").read_text()
        table = page[page.index('<table id="lines"'):].split("</table>")[0]
        told = [re.findall(r"<td>(.*?)</td>", line) for line in table.splitlines() if line.startswith("<tr><td>")]
        self.assertEqual([row[:2] for row in told],
                         [[f"{row[0]}-{row[1]}", row[2]] for row in rows])
        self.assertEqual([row[2:] for row in told], [[*row[3:5], row[5] + "°", *row[6:]] for row in rows])

    def test_a_closed_outline(self):
        points = moved(rounded_square(), 0.004)
        rows, contour, _ = self.fit(points[5:] + points[:5], "--noise", 0.02, "--primitives", "--closed")
        self.check(rows, contour)
        self.assertTrue(any(int(row[0]) > int(row[1]) for row in rows), "none goes over the first point")
        self.assertEqual(sum(row[2] == "straight" for row in rows), 4)
        self.assertEqual(len(rows), 8)

    def test_none_is_told_with_the_reason(self):
        points = []
        x = y = 0.0
        for i in range(2000):  # a clothoid
            if i % 20 == 0:
                points.append((x, y))
            heading = (i + 0.5) ** 2 * 4e-7
            x += 0.05 * math.cos(heading)
            y += 0.05 * math.sin(heading)
        rows, contour, said = self.fit(points, "--noise", 1e-4, "--primitives")
        self.assertEqual(rows, [])
        self.assertEqual(self.expected(contour), [])
        self.assertIn("no line and no arc was found", said)

    def test_exact_points_have_no_room(self):
        _, _, said = self.fit(bend(), "--primitives")
        self.assertIn("--noise gives them", said)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
