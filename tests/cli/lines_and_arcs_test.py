#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The table of lines and arcs against the pieces of the contour file beside it.

usage: lines_and_arcs_test.py PROGRAM
"""
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
        """Of each line and arc with four points or more: points, curvature, centre, heading, length, farthest point."""
        out = []
        pieces, elements, points = contour["pieces"], contour["elements"], contour["points"]
        for k, piece in enumerate(pieces):
            begin, end = elements[k], elements[(k + 1) % len(elements)]
            if piece["type"] not in ("line", "arc") or begin.get("source") is None or end.get("source") is None:
                continue
            count = (end["source"] - begin["source"]) % len(points) + 1
            if count < 4:
                continue
            mine = [points[(begin["source"] + i) % len(points)] for i in range(count)]
            kappa, theta, start = begin["kappa"], begin["heading"], begin["point"]
            left = (-math.sin(theta), math.cos(theta))
            if piece["type"] == "line":
                off = max(abs((x - start[0]) * left[0] + (y - start[1]) * left[1]) for x, y in mine)
                out.append((begin["source"], end["source"], 0.0, None, theta, math.dist(start, end["point"]), off))
            else:
                centre = (start[0] + left[0] / kappa, start[1] + left[1] / kappa)
                turn = (end["heading"] - theta) % (2 * math.pi) if kappa > 0 else (theta - end["heading"]) % (2 * math.pi)
                off = max(abs(math.dist(centre, p) - abs(1 / kappa)) for p in mine)
                out.append((begin["source"], end["source"], kappa, centre, theta, turn / abs(kappa), off))
        return out

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
