#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Airfoil files against the closed form of the NACA sections of four digits [Abbott 1959].

usage: airfoil_test.py PROGRAM
"""
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
THICK = 0.12
FORM = (0.2969, -0.1260, -0.3516, 0.2843, -0.1036)  # closed trailing edge


def half(x):
    return THICK / 0.2 * (FORM[0] * math.sqrt(x) + sum(a * x**k for k, a in enumerate(FORM[1:], 1)))


def slope(x):
    return THICK / 0.2 * (0.5 * FORM[0] / math.sqrt(x)
                          + sum(k * a * x**(k - 1) for k, a in enumerate(FORM[1:], 1)))


def camber(x, most=0.02, at=0.4):
    return most / at**2 * (2 * at * x - x * x) if x < at else (
        most / (1 - at)**2 * (1 - 2 * at + 2 * at * x - x * x))


def root(f, a, b):
    for _ in range(100):
        c = 0.5 * (a + b)
        a, b = (c, b) if (f(a) > 0) == (f(c) > 0) else (a, c)
    return a


def points(bent):
    x = [0.5 * (1 - math.cos(math.pi * k / 120)) for k in range(121)]
    up = [(v, half(v) + bent * camber(v)) for v in x]
    low = [(v, -half(v) + bent * camber(v)) for v in x]
    return up[::-1] + low[1:]


def numbers(path):
    return [tuple(map(float, line.split())) for line in path.read_text().splitlines()[1:] if line]


class Airfoils(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(self.enterContext(tempfile.TemporaryDirectory()))

    def write(self, name, bent=0):
        (self.folder / name).write_text(
            "foil\n" + "".join(f"{x:.10f} {y:.10f}\n" for x, y in points(bent)))

    def run_it(self, *args):
        done = subprocess.run([PROGRAM, *args], cwd=self.folder, capture_output=True, text=True)
        return done.returncode, done.stdout + done.stderr

    def figures(self, text):
        found = re.search(r"normal to its chord: thickness ([\d.]+) % at ([\d.]+) %, camber (-?[\d.]+) %(?: at ([\d.]+))?",
                          text)
        radius = re.search(r"radius ([\d.]+) %, trailing edge ([\d.]+) % thick, ([\d.]+) deg", text)
        return [float(g or 0) for g in found.groups()], [float(g) for g in radius.groups()]

    def test_figures_are_those_of_the_closed_form(self):
        self.write("a.dat")
        code, text = self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "b.dat")
        self.assertEqual(code, 0, text)
        (thick, at, bent, _), (radius, edge, angle) = self.figures(text)
        top = root(slope, 0.1, 0.6)
        self.assertAlmostEqual(thick, 200 * half(top), delta=2e-3)
        # what stands in the file has straight lines between its points, inside the contour
        alone = float(re.search(r"the file, straight lines between its points: thickness ([\d.]+) %", text).group(1))
        self.assertTrue(thick - 0.02 < alone <= thick + 1e-3, text)
        self.assertAlmostEqual(at, 100 * top, delta=0.05)
        self.assertEqual(bent, 0)
        self.assertAlmostEqual(radius, 100 * 1.1019 * THICK**2, delta=0.02)
        self.assertAlmostEqual(angle, 2 * math.degrees(math.atan(-slope(1.0))), delta=0.05)
        self.assertEqual(edge, 0)

    def test_camber_is_that_of_thickness_along_y(self):
        self.write("a.dat", bent=1)
        _, text = self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "b.dat")
        (_, _, bent, at), _ = self.figures(text)
        # the leading edge lies a little beside x = 0 where the camber line rises from it
        self.assertAlmostEqual(bent, 2.0, delta=0.03)
        self.assertAlmostEqual(at, 40.0, delta=1.0)

    def test_points_lie_on_the_closed_form_with_every_spacing(self):
        self.write("a.dat")
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json", "-q")
        for spacing in ("cosine", "curvature", "uniform"):
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--spacing", spacing,
                                     "--samples", "81")
            self.assertEqual(code, 0, text)
            read = numbers(self.folder / "b.dat")
            self.assertEqual(len(read), 81)
            for x, y in read:
                self.assertLess(abs(abs(y) - half(x)), 1e-5)
            if spacing == "cosine":
                for k in range(41):
                    self.assertAlmostEqual(read[40 - k][0], 0.5 * (1 - math.cos(math.pi * k / 40)),
                                           delta=2e-8)

    def test_a_given_trailing_edge_is_what_the_file_has(self):
        self.write("a.dat")
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json", "-q")
        self.run_it("convert", "a.json", "-o", "b.dat", "--trailing-edge", "0.004", "--airfoil",
                    "lednicer", "--samples", "81")
        rows = numbers(self.folder / "b.dat")
        self.assertEqual(rows[0], (41.0, 41.0))
        for x, y in rows[1:]:
            self.assertLess(abs(abs(y) - half(x) - 0.002 * x * x), 1e-5)

    def test_ends_behind_each_other_are_as_thick_as_they_are_across_the_chord(self):
        rows = points(0)[:-1]  # the lower side ends before the upper one
        (self.folder / "a.dat").write_text("foil\n" + "".join(f"{x:.10f} {y:.10f}\n" for x, y in rows))

        def across(ends, nose=(0.0, 0.0)):
            (ax, ay), (bx, by) = ends
            cx, cy = 0.5 * (ax + bx) - nose[0], 0.5 * (ay + by) - nose[1]
            return abs(cx * (by - ay) - cy * (bx - ax)) / (cx * cx + cy * cy)

        code, text = self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json", "-o", "b.dat")
        self.assertEqual(code, 0, text)
        edge = self.figures(text)[1][1]
        self.assertAlmostEqual(edge, 100 * across((rows[0], rows[-1])), delta=1.5e-3)
        self.assertGreater(100 * math.dist(rows[0], rows[-1]), 1.2 * edge)
        code, text = self.run_it("convert", "a.json", "-o", "c.dat", "--trailing-edge", "0.004", "--unit-chord")
        self.assertEqual(code, 0, text)
        made = numbers(self.folder / "c.dat")
        self.assertAlmostEqual(across((made[0], made[-1])), 0.004, delta=2e-6)
        code, text = self.run_it("fit", "c.dat", "--noise", "rounding", "-o", "d.dat")
        self.assertAlmostEqual(self.figures(text)[1][1], 0.4, delta=1.5e-3)

    def test_a_closed_trailing_edge_has_one_end_though_a_side_lacks_its_last_point(self):
        for missing, deg, size in ((0, 0, 1.0), (1, 0, 1.0), (5, 25, 150.0), (9, 0, 1.0)):
            rows = points(0)[:len(points(0)) - missing]
            turn = math.radians(deg)
            place = lambda x, y: (size * (x * math.cos(turn) - y * math.sin(turn)) + 7 * (size > 1),  # noqa: E731
                                  size * (x * math.sin(turn) + y * math.cos(turn)))
            (self.folder / "a.dat").write_text(
                "foil\n" + "".join("{:.10f} {:.10f}\n".format(*place(x, y)) for x, y in rows))
            self.run_it("fit", "a.dat", "--noise", str(1e-7 * size), "--open", "-o", "a.json", "-q")
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--trailing-edge", "0", "--unit-chord")
            self.assertEqual(code, 0, text)
            made = numbers(self.folder / "b.dat")
            self.assertEqual(made[0], made[-1])
            self.assertAlmostEqual(math.dist(made[0], (1.0, 0.0)), 0.0, delta=1.5e-8)
            moved = float(re.search(r"each end moved ([\d.]+) chords", text).group(1))
            # the tangent of the closed form at the last point of the lower side, up to the end of the upper one
            x = rows[-1][0]
            straight = half(x) + (1.0 - x) * (slope(x) if missing else 0.0)
            self.assertAlmostEqual(moved, 0.5 * abs(straight), delta=3e-5)
            if missing > 1:
                self.assertRegex(text, r"the lower side ends [\d.]+ % of the chord before the other one")
                self.assertIn("it goes on straight by", text)
                ends, on = (float(re.search(what, text).group(1)) for what in (
                    r"lower side ends ([\d.]+) %", r"straight by ([\d.]+) %"))
                self.assertAlmostEqual(ends, 100 * (1 - x) / (0.5 + 0.5 * x), delta=0.02)
                self.assertAlmostEqual(on, 100 * (1 - x) * math.hypot(1.0, slope(x)), delta=0.02)
            code, plain = self.run_it("convert", "a.json", "-o", "c.dat", "--trailing-edge", "0")
            self.assertEqual(code, 0, plain)
            made = numbers(self.folder / "c.dat")
            self.assertEqual(made[0], made[-1])
            self.assertLess(math.dist(made[0], place(1.0, 0.0)), (0.5 * abs(straight) + 1e-5) * size)

    def test_a_side_that_lacks_more_than_its_last_point_is_left_and_told_why(self):
        rows = points(0)[:-25]
        (self.folder / "a.dat").write_text("foil\n" + "".join(f"{x:.10f} {y:.10f}\n" for x, y in rows))
        self.run_it("fit", "a.dat", "--noise", "1e-7", "--open", "-o", "a.json", "-q")
        code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--trailing-edge", "0")
        self.assertEqual(code, 0, text)
        self.assertIn("that is more than a tenth of the chord; add that point", text)
        made = numbers(self.folder / "b.dat")
        self.assertGreater(made[0][0] - made[-1][0], 0.09)

    def test_a_round_trailing_edge_touches_both_sides(self):
        self.write("a.dat")
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json", "-q")
        thick = 0.01
        r = 0.5 * thick
        # how far the sides of the closed form move apart: until a circle around 1 - r touches both

        def nearest(more):
            return min(math.hypot(x - 1 + r, half(x) + 0.5 * more * x * x)
                       for x in (1 - 2 * r * k / 20000 for k in range(20001)))
        more = root(lambda m: nearest(m) - r, 0.5 * thick, 1.5 * thick)
        for spacing in ("cosine", "curvature"):
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--trailing-edge",
                                     str(thick), "--trailing-edge-form", "round", "--spacing",
                                     spacing, "--samples", "201")
            self.assertEqual(code, 0, text)
            touch = [float(v) / 100 for v in re.search(
                r"touches the upper side at ([\d.]+) % and the lower one at ([\d.]+) %",
                text).groups()]
            on_arc = int(re.search(r"(\d+) points on it", text).group(1))
            read = numbers(self.folder / "b.dat")
            self.assertEqual(len(read), 201)
            self.assertEqual(read[0], read[-1])
            self.assertAlmostEqual(read[0][0], 1.0, delta=1e-8)
            self.assertAlmostEqual(read[0][1], 0.0, delta=1e-6)
            found = 0
            for x, y in read:
                if x > max(touch):
                    self.assertAlmostEqual(math.hypot(x - 1 + r, y), r, delta=2e-8)
                    found += 1
                else:
                    self.assertAlmostEqual(abs(y), half(x) + 0.5 * more * x * x, delta=1e-6)
            self.assertEqual(found - 1, on_arc)  # the end of the chord is there twice
            self.assertGreater(on_arc, 4)
            # G1: at the touching point the side runs across the radius
            for x in touch:
                along = slope(x) + more * x
                radius = (half(x) + 0.5 * more * x * x) / (x - 1 + r)
                self.assertAlmostEqual(math.atan(along) - math.atan(-1 / radius), 0, delta=2e-3)

    def test_a_round_edge_ends_at_the_end_of_the_chord_and_is_read_back(self):
        self.write("a.dat", 1)
        thick = 0.01
        _, text = self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "b.dat", "--trailing-edge", str(thick),
                              "--trailing-edge-form", "round", "--unit-chord", "--move", "3,4")
        line = next(t for t in text.splitlines() if "the file, straight lines" in t)
        self.assertIn("trailing edge round, 1.000 % in diameter", line)
        read = numbers(self.folder / "b.dat")
        # the point farthest from the leading edge lies at 1, 0
        for x, y in (read[0], read[-1], max(read, key=lambda p: math.hypot(*p))):
            self.assertAlmostEqual(x, 1, delta=2e-8)
            self.assertAlmostEqual(y, 0, delta=2e-8)
        # what is printed brings that back to where the arc of the placed section is
        scale, turn, x, y = map(float, re.search(
            r"--scale (\S+) --rotate (\S+) --move ([^,]+),(\S+)", text).groups())
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "c.dat", "--trailing-edge", str(thick),
                    "--trailing-edge-form", "round", "--move", "3,4")
        c, s = math.cos(math.radians(turn)), math.sin(math.radians(turn))
        for p, q in zip(read, numbers(self.folder / "c.dat"), strict=True):
            self.assertAlmostEqual(scale * (c * p[0] - s * p[1]) + x, q[0], delta=1e-7)
            self.assertAlmostEqual(scale * (s * p[0] + c * p[1]) + y, q[1], delta=1e-7)
        for more in ([], ["--open"]):
            code, text = self.run_it("fit", "b.dat", "--noise", "rounding", "-o", "d.dat", *more)
            self.assertEqual(code, 0, text)
            shown = float(re.search(r"contour: leading edge radius [\d.]+ %, trailing edge round, ([\d.]+) % in",
                                    text).group(1))
            self.assertAlmostEqual(shown, 100 * thick, delta=0.1)  # rounded points
            for p, q in zip(read, numbers(self.folder / "d.dat"), strict=True):
                self.assertLess(math.hypot(p[0] - q[0], p[1] - q[1]), 2e-4)  # places along it
        code, text = self.run_it("fit", "b.dat", "--noise", "rounding", "-o", "d.dat", "--trailing-edge", "0.02")
        self.assertEqual(code, 2, text)
        self.assertIn("round already", text)
        code, text = self.run_it("compare", "b.dat", "a.dat", "--noise", "rounding", "--align", "chord")
        self.assertEqual(code, 0, text)
        self.assertNotIn("no trailing edge", text)

    def test_a_round_edge_needs_a_thickness_and_room(self):
        self.write("a.dat")
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json", "-q")
        for more in ([], ["--trailing-edge", "0"]):
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--trailing-edge-form",
                                     "round", *more)
            self.assertEqual(code, 2, text)
            self.assertIn("E203", text)
            self.assertFalse((self.folder / "b.dat").exists())

    def test_figures_of_the_input_are_those_of_its_points(self):
        self.write("a.dat")
        _, text = self.run_it("fit", "a.dat", "--noise", "1e-4", "-o", "b.dat")
        found = re.search(r"input, straight lines between its points, same chord: thickness "
                          r"([\d.]+) % at ([\d.]+) %", text)
        thick, at = (float(g) for g in found.groups())
        x = [0.5 * (1 - math.cos(math.pi * k / 120)) for k in range(121)]
        best = max(x, key=half)
        self.assertAlmostEqual(thick, 200 * half(best), delta=2e-3)  # the chord turns by rounding
        self.assertAlmostEqual(at, 100 * best, delta=0.02)
        first = (x[1], half(x[1]))
        # circle through 0, 0 and both neighbours
        radius = (first[0]**2 + first[1]**2) / (2 * first[0])
        shown = float(re.search(r"apart: radius ([\d.]+) %", text).group(1))
        self.assertAlmostEqual(shown, 100 * radius, delta=2e-3)

    def test_a_nose_that_is_no_fair_one_is_warned_of(self):
        tip = [(x, y) for x, y in points(0) if x > 0.004]
        half_way = len(tip) // 2
        tip.insert(half_way, (-0.01, 0.0))  # sticks out: a corner, or curvature that turns back
        (self.folder / "a.dat").write_text("tip\n" + "".join(f"{x:.6f} {y:.6f}\n" for x, y in tip))
        self.write("fair.dat")
        for name, told in (("a.dat", True), ("fair.dat", False)):
            code, text = self.run_it("fit", name, "--noise", "rounding", "-o", "b.dat", "--open")
            self.assertEqual(code, 0, text)
            self.assertEqual("warning: b.dat: the nose" in text, told, text)
        _, text = self.run_it("fit", "a.dat", "--noise", "rounding", "--corner-at",
                              str(half_way + 1), "--open", "-o", "b.dat")
        turn = float(re.search(r"the nose has a corner of ([\d.]+) degrees", text).group(1))
        self.assertGreater(turn, 20)
        _, text = self.run_it("fit", "a.dat", "--noise", "rounding", "--no-corners", "--open", "-o",
                              "b.dat")
        self.assertNotIn("has a corner", text)

    def test_thickness_and_camber_are_those_asked_for(self):
        # the made section has its camber and half thickness as heights over x, normal to the chord
        self.write("a.dat", 1)
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json")
        for options, thick, bent in ((["--thickness", "9%"], 9 / 12.0, 1), (["--camber", "0.03"], 1, 1.5),
                                     (["--thickness", "0.15", "--camber", "0"], 15 / 12.0, 0),
                                     (["--camber", "-1%"], 1, -0.5)):
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", *options)
            self.assertEqual(code, 0, text)
            # the printed figures are those of the contour: factors come from them
            (was, _, camber_was, _), _ = self.figures(text)
            wanted = {"--thickness": 100 * float(options[1].rstrip("%")) / (100 if "%" in options[1] else 1)}
            scale = thick * 100 * 2 * half(root(slope, 0.1, 0.6)) / was if thick == 1 else wanted["--thickness"] / was
            bend = bent * 2 / camber_was
            self.assertIn("undone by", text)
            upper = [p for p in numbers(self.folder / "b.dat")][:81]
            for x, y in upper:
                self.assertAlmostEqual(y, scale * half(max(x, 0)) + bend * camber(x), delta=4e-5, msg=str(options))
        file = re.search(r"the file, straight lines between its points: thickness ([\d.]+) %", text)
        self.assertAlmostEqual(float(file.group(1)), 12, delta=0.02)
        self.assertRegex(text, r"camber \S+ % -> -1\.000 %")
        # what is printed as undoing it does
        self.run_it("convert", "a.json", "-o", "b.dat", "--thickness", "9%")
        code, text = self.run_it("fit", "b.dat", "--noise", "rounding", "-o", "c.dat", "--thickness", "12%")
        self.assertEqual(code, 0, text)
        for a, b in zip(numbers(self.folder / "c.dat"), points(1), strict=False):
            self.assertLess(min(abs(a[1] - half(max(a[0], 0)) - camber(a[0])),
                                abs(a[1] + half(max(a[0], 0)) - camber(a[0]))), 1e-4)

    def test_a_trailing_edge_goes_with_a_thickness_and_its_round_form_touches_the_scaled_sides(self):
        self.write("a.dat", 1)
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json")
        for form in ([], ["--trailing-edge-form", "round"]):
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--thickness", "10%",
                                     "--trailing-edge", "0.004", *form)
            self.assertEqual(code, 0, text)
            shape = numbers(self.folder / "b.dat")
            if not form:
                self.assertAlmostEqual(shape[0][1] - shape[-1][1], 0.004, delta=1e-6)
            else:
                self.assertAlmostEqual(max(p[0] for p in shape), 1, delta=1e-4)
                turns = [math.atan2((c[1] - b[1]) * (b[0] - a[0]) - (c[0] - b[0]) * (b[1] - a[1]),
                                    (c[0] - b[0]) * (b[0] - a[0]) + (c[1] - b[1]) * (b[1] - a[1]))
                         for a, b, c in zip(shape, shape[1:], shape[2:])]
                self.assertLess(max(map(abs, turns)), 1.6)

    def test_what_cannot_be_scaled_is_refused(self):
        self.write("a.dat")
        self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "a.json")
        for options, told in ((["--camber", "2%"], "no camber"), (["--thickness", "12"], "half of the chord"),
                              (["--thickness", "x"], "a length in chords"), (["--thickness", "0"], "above 0")):
            code, text = self.run_it("convert", "a.json", "-o", "b.dat", *options)
            self.assertEqual(code, 2, text)
            self.assertIn(told, text)
        code, text = self.run_it("convert", "a.json", "-o", "b.dat", "--camber", "0")
        self.assertEqual(code, 0, text)

    def test_a_camber_that_became_0_is_not_undone(self):
        self.write("a.dat", 1)
        for more, told in (([], "camber cannot be undone"),
                           (["--thickness", "10%"], "the thickness is undone by --thickness 0.1")):
            _, text = self.run_it("fit", "a.dat", "--noise", "rounding", "-o", "b.dat", "--camber", "0", *more)
            self.assertIn(told, text)
            self.assertIn("camber cannot be undone", text)

    def test_unit_chord_is_undone_by_what_is_printed(self):
        self.write("a.dat")
        place = ["--scale", "250", "--rotate", "20", "--move", "3,4"]
        _, text = self.run_it("fit", "a.dat", *place, "--noise", "rounding", "-o", "b.dat",
                              "--unit-chord")
        scale, turn, x, y = map(float, re.search(
            r"--scale (\S+) --rotate (\S+) --move ([^,]+),(\S+)", text).groups())
        for got, wanted in ((scale, 250), (turn, 20), (x, 3), (y, 4)):
            self.assertAlmostEqual(got, wanted, delta=1e-7)
        for a, b in numbers(self.folder / "b.dat"):
            self.assertLess(abs(abs(b) - half(a)), 1e-5)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
