#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Curves over each other against circles, and against NACA sections of four digits in closed form.

usage: compare_curves_test.py PROGRAM
"""
import csv
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
FORM = (0.2969, -0.1260, -0.3516, 0.2843, -0.1036)  # closed trailing edge


class Section:
    """Thickness along y on a camber line: thickness t, camber m at p."""

    def __init__(self, t, m=0.0, p=0.4):
        self.t, self.m, self.p = t, m, p

    def line(self, x):
        m, p = self.m, self.p
        return m / p**2 * (2 * p * x - x * x) if x < p else (
            m / (1 - p)**2 * (1 - 2 * p + 2 * p * x - x * x))

    def height(self, x, sign):
        return self.line(x) + sign * self.t / 0.2 * (
            FORM[0] * math.sqrt(x) + sum(a * x**k for k, a in enumerate(FORM[1:], 1)))

    def points(self, n):
        x = [0.5 * (1 - math.cos(math.pi * k / n)) for k in range(n + 1)]
        return ([(v, self.height(v, 1)) for v in reversed(x)] +
                [(v, self.height(v, -1)) for v in x[1:]])

    def normal_distance(self, x, y, normal, side):
        """Along the normal from (x, y) to this side, by bisection on x; None beyond the ends."""
        sign = 1 if side == "upper" else -1
        along = (normal[1], -normal[0])

        def ahead(u):
            return (u - x) * along[0] + (self.height(u, sign) - y) * along[1]

        n = 2000  # crossings are sought in cosine steps
        steps = [0.5 * (1 - math.cos(math.pi * k / n)) for k in range(n + 1)]
        found = []
        before = ahead(steps[0])
        for a, b in zip(steps, steps[1:]):
            now = ahead(b)
            if (before <= 0) != (now <= 0):
                low, high = a, b
                for _ in range(80):
                    middle = 0.5 * (low + high)
                    if (ahead(middle) <= 0) == (before <= 0):
                        low = middle
                    else:
                        high = middle
                found.append((low - x) * normal[0] + (self.height(low, sign) - y) * normal[1])
            before = now
        return min(found, key=abs) if found else None


class Curves(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, points, digits=12):
        head = "foil\n" if name.endswith(".dat") else ""
        (self.folder / name).write_text(
            head + "".join(f"{x:.{digits}f} {y:.{digits}f}\n" for x, y in points))

    def run_it(self, *args, code=0):
        done = subprocess.run([PROGRAM, "compare", *args], cwd=self.folder, capture_output=True,
                              text=True)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done.stdout if code == 0 else done.stderr

    def report(self, *args):
        return json.loads(self.run_it(*args, "--json"))

    def places(self, *args):
        return list(csv.DictReader(self.run_it(*args, "--csv").splitlines()))

    def circle(self, radius, count=60, part=1.0, back=False):
        turns = [2 * math.pi * part * k / (count if part == 1 else count - 1)
                 for k in range(count)]
        out = [(3 + radius * math.cos(a), radius * math.sin(a)) for a in turns]
        return out[::-1] if back else out

    def test_a_larger_circle_is_as_far_everywhere(self):
        self.write("a.txt", self.circle(2.0), 5)
        for back in (False, True):
            self.write("b.txt", self.circle(2.25, 47, back=back), 5)
            found = self.report("a.txt", "b.txt", "--closed", "--noise", "rounding")
            self.assertEqual(found["positive"], "outward")
            one = found["as_they_lie"][0]
            self.assertAlmostEqual(one["largest"]["deviation"], 0.25, delta=3e-5)
            self.assertAlmostEqual(one["root_mean_square"], 0.25, delta=3e-5)
            self.assertAlmostEqual(one["measured"], 1.0, delta=1e-9)
            self.assertAlmostEqual(found["curves"][0]["length"], 4 * math.pi, delta=2e-4)
            for row in self.places("a.txt", "b.txt", "--closed", "--noise", "rounding"):
                self.assertAlmostEqual(float(row["deviation of b.txt"]), 0.25, delta=3e-5)
        found = self.report("b.txt", "a.txt", "--closed", "--noise", "rounding")
        self.assertAlmostEqual(found["as_they_lie"][0]["largest"]["deviation"], -0.25, delta=3e-5)

    def test_left_of_an_open_arc_is_positive_and_its_overhang_is_not_measured(self):
        self.write("a.txt", self.circle(2.0, 21, part=0.2), digits=5)
        self.write("b.txt", self.circle(1.9, 15, part=0.1), digits=5)
        found = self.report("a.txt", "b.txt", "--noise", "rounding")
        self.assertEqual(found["positive"], "left")
        one = found["as_they_lie"][0]
        self.assertAlmostEqual(one["largest"]["deviation"], 0.1, delta=2e-5)
        self.assertAlmostEqual(one["measured"], 0.5, delta=2e-3)

    def test_an_ellipse_from_a_circle(self):
        """Along the radii of a circle around its middle the ellipse is at ab / root(...)."""
        a, b, r = 2.2, 1.9, 2.0
        self.write("a.txt", self.circle(r, 60), 5)
        self.write("b.txt", [(3 + a * math.cos(v), b * math.sin(v))
                             for v in (2 * math.pi * k / 120 for k in range(120))], 5)
        rows = self.places("a.txt", "b.txt", "--closed", "--noise", "rounding")
        self.assertGreaterEqual(len(rows), 2000)

        def away(v):
            return a * b / math.hypot(b * math.cos(v), a * math.sin(v)) - r

        for row in rows:
            v = math.atan2(float(row["y"]), float(row["x"]) - 3)
            self.assertAlmostEqual(float(row["deviation of b.txt"]), away(v), delta=5e-5)
        squares = sum(away(2 * math.pi * k / 10000) ** 2 for k in range(10000)) / 10000
        one = self.report("a.txt", "b.txt", "--closed", "--noise", "rounding")["as_they_lie"][0]
        self.assertAlmostEqual(one["largest"]["deviation"], 0.2, delta=5e-5)
        self.assertAlmostEqual(abs(one["largest"]["x"] - 3), 2.0, delta=1e-3)
        self.assertAlmostEqual(one["root_mean_square"], math.sqrt(squares), delta=5e-5)

    def test_naca_sections_are_apart_as_their_closed_forms(self):
        thin, thick = Section(0.12, 0.02), Section(0.15, 0.03)
        self.write("a.dat", thin.points(160))
        self.write("b.dat", thick.points(140))
        rows = self.places("a.dat", "b.dat", "--noise", "rounding")
        looked = 0
        for row in rows[::7]:
            x, y = float(row["x"]), float(row["y"])
            if not 0.01 < x < 0.98:
                continue  # there the closed forms cross at the nose and at the edge
            sign = 1 if row["side"] == "upper" else -1
            self.assertAlmostEqual(y, thin.height(x, sign), delta=1e-6)
            step = 1e-6
            slope = (thin.height(x + step, sign) - thin.height(x - step, sign)) / (2 * step)
            size = math.hypot(1, slope)
            normal = (-sign * slope / size, sign / size)
            self.assertAlmostEqual(float(row["normal_y"]), normal[1], delta=1e-4)
            wanted = thick.normal_distance(x, thin.height(x, sign), normal, row["side"])
            self.assertAlmostEqual(float(row["deviation of b.dat"]), wanted, delta=1e-6)
            looked += 1
        self.assertGreater(looked, 200)

    def test_figures_of_both_are_those_of_their_closed_forms(self):
        self.write("a.dat", Section(0.12).points(100))
        self.write("b.dat", Section(0.15).points(100))
        found = self.report("a.dat", "b.dat", "--noise", "rounding")
        for curve, t in zip(found["curves"], (0.12, 0.15)):
            foil = curve["airfoil"]
            self.assertAlmostEqual(foil["thickness"], t, delta=2e-4 * t)
            self.assertAlmostEqual(foil["leading_edge_radius"], 1.1019 * t * t, delta=0.012 * 1.1019 * t * t)
            self.assertAlmostEqual(foil["camber"], 0, delta=1e-7)
            self.assertEqual(curve["points"], 200)
        self.assertAlmostEqual(found["as_they_lie"][0]["largest"]["deviation"], 0.015, delta=2e-4)

    def test_one_chord_takes_scale_turn_and_move_away(self):
        section = Section(0.12, 0.02)
        self.write("a.dat", section.points(120))
        turn = math.radians(-3)
        self.write("b.dat", [(7 + 250 * (x * math.cos(turn) - y * math.sin(turn)),
                              -4 + 250 * (x * math.sin(turn) + y * math.cos(turn)))
                             for x, y in section.points(120)])
        found = self.report("a.dat", "b.dat", "--noise", "rounding", "--align", "chord")
        one = found["on_one_chord"][0]
        self.assertLess(abs(one["largest"]["deviation"]), 1e-6)
        self.assertGreater(one["measured"], 0.99)
        text = self.run_it("a.dat", "b.dat", "--noise", "rounding")
        self.assertIn("--align chord", text)

    def test_drawings_and_contours_are_taken_as_they_are(self):
        self.write("a.dat", Section(0.12).points(100))
        for name in ("a.json", "a.dxf"):
            done = subprocess.run([PROGRAM, "fit", "a.dat", "--noise", "rounding", "-o", name, "-q"],
                                  cwd=self.folder, capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
        found = self.report("a.json", "a.dxf", "a.dat", "--units", "mm", "--noise", "rounding")
        self.assertEqual([c["formed"] for c in found["curves"]], [False, False, True])
        self.assertEqual(found["curves"][0]["points"], 200)  # the first one is given twice
        self.assertEqual(found["curves"][0]["vertices"], found["curves"][2]["vertices"])
        for one in found["as_they_lie"]:
            self.assertLess(abs(one["largest"]["deviation"]), 2e-6)

    def test_the_picture_says_how_much_deviations_are_enlarged(self):
        self.write("a.dat", Section(0.12).points(100))
        self.write("b.dat", Section(0.1205).points(100))
        args = ["a.dat", "b.dat", "--noise", "rounding", "-q"]
        self.run_it(*args, "-o", "p.svg", "-o", "p.csv", "-o", "p.json")
        text = (self.folder / "p.svg").read_text()
        factor = float(re.search(r"enlarged ([\d.]+) times", text).group(1))
        largest = abs(json.loads((self.folder / "p.json").read_text())
                      ["as_they_lie"][0]["largest"]["deviation"])
        self.assertLess(factor * largest, 0.122)
        self.assertGreater(factor * largest, 0.12 / 2.6)
        self.assertIn(str(int(factor))[0], "125")
        for name in ("a.dat", "b.dat"):
            self.assertIn(name, text)
        self.run_it(*args, "--enlarge", "30", "-o", "p.svg")
        self.assertIn("enlarged 30 times", (self.folder / "p.svg").read_text())

    def test_what_cannot_be_compared_is_refused(self):
        self.write("a.dat", Section(0.12).points(100))
        self.write("b.txt", self.circle(2.0, part=0.2))
        noise = ["--noise", "rounding"]
        self.assertIn("E203", self.run_it("a.dat", "b.txt", "--align", "chord", *noise, code=2))
        self.assertIn("E203", self.run_it("a.dat", "--align", "chord", code=2))
        self.assertIn("E203", self.run_it("a.dat", "--enlarge", "3", code=2))
        self.assertIn("E203", self.run_it("a.dat", "b.txt", "--enlarge", "0", code=2))
        self.assertIn("E202", self.run_it("a.dat", "b.txt", "-o", "x.step", code=2))
        self.assertIn("none.dat", self.run_it("a.dat", "none.dat", *noise, code=3))
        (self.folder / "m.csv").write_text("x [m],y [m]\n0,0\n1,0.1\n2,0\n3,-0.5\n")
        (self.folder / "mm.csv").write_text("x [mm],y [mm]\n0,0\n1,0.1\n2,0\n3,-0.5\n")
        self.assertIn("E310", self.run_it("m.csv", "mm.csv", *noise, code=3))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
