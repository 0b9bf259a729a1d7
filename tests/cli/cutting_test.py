#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Programs of `obvid cut`, read as a controller reads them and cut into drawings whose distances are
known in closed form. Shares nothing with the program.

usage: cutting_test.py PROGRAM
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
WORD = re.compile(r"([A-Z])([-+]?\d*\.?\d+)")


class Move:
    """A motion of the tip: `at(t)` for t in [0, 1]."""

    def __init__(self, code, a, b, centre=None, feed=None, spins=False):
        self.code, self.a, self.b, self.centre, self.feed, self.spins = code, a, b, centre, feed, spins
        if centre:
            cx, cy = centre
            self.radius = math.hypot(a[0] - cx, a[1] - cy)
            self.end_radius = math.hypot(b[0] - cx, b[1] - cy)
            self.begin = math.atan2(a[1] - cy, a[0] - cx)
            turn = math.atan2(b[1] - cy, b[0] - cx) - self.begin
            if code == 3 and turn <= 0:
                turn += 2 * math.pi
            if code == 2 and turn >= 0:
                turn -= 2 * math.pi
            self.turn = turn

    def length(self):
        if self.centre:
            return abs(self.turn) * self.radius
        return math.dist(self.a[:2], self.b[:2])

    def at(self, t):
        z = self.a[2] + t * (self.b[2] - self.a[2])
        if not self.centre:
            return (self.a[0] + t * (self.b[0] - self.a[0]), self.a[1] + t * (self.b[1] - self.a[1]), z)
        angle = self.begin + t * self.turn
        r = self.radius + t * (self.end_radius - self.radius)
        return (self.centre[0] + r * math.cos(angle), self.centre[1] + r * math.sin(angle), z)

    def places(self, apart):
        count = max(2, math.ceil(self.length() / apart))
        return [self.at(k / count) for k in range(count + 1)]


class Controller:
    """Reads a program by the rules that grbl, LinuxCNC, Fanuc and Marlin share, and refuses the rest."""

    def __init__(self, text, burns=False):
        self.moves, self.codes, self.dwells = [], [], []
        at, feed, motion, spins = [0.0, 0.0, 0.0 if burns else None], None, None, False
        for line in text.splitlines():
            assert len(line) <= 80, line
            line = re.sub(r"\([^()]*\)", "", line.split(";")[0]).strip()
            if line in ("", "%"):
                continue
            assert WORD.sub("", line).strip() == "", f"words that no controller knows: {line}"
            words = [(k, float(v)) for k, v in WORD.findall(line)]
            ends, ij = {}, {}
            for letter, value in words:
                if letter == "G":
                    self.codes.append(("G", value))
                    if value in (0, 1, 2, 3):
                        motion = int(value)
                    else:
                        assert value in (4, 17, 20, 21, 90, 91.1, 94), line
                elif letter == "M":
                    assert value in (2, 3, 4, 5, 30), line
                    spins = {3: True, 4: True, 5: False}.get(value, spins)
                    self.codes.append(("M", value))
                elif letter == "F":
                    assert value > 0, line
                    feed = value
                elif letter in "XYZ":
                    ends["XYZ".index(letter)] = value
                elif letter in "IJ":
                    ij["IJ".index(letter)] = value
                else:
                    assert letter in "SPO", line
            if any(k == "G" and v == 4 for k, v in words):
                self.dwells.append(dict(words)["P"])
                continue
            if not ends:
                assert not ij, line
                continue
            end = [ends.get(k, at[k]) for k in range(3)]
            if motion in (1, 2, 3):
                assert feed is not None, f"no feed: {line}"
                assert None not in at, f"cuts before it is placed: {line}"
            centre = None
            if motion in (2, 3):
                assert set(ij) == {0, 1}, line
                centre = (at[0] + ij[0], at[1] + ij[1])
            if None not in at:
                move = Move(motion, tuple(at), tuple(end), centre, feed, spins)
                if centre:  # grbl: 0.005 mm and 0.1 %; LinuxCNC and others are looser
                    assert abs(move.radius - move.end_radius) <= 0.002, line
                    assert abs(move.turn) < math.pi, line
                self.moves.append(move)
            at = end


class Circle:
    def __init__(self, x, y, r):
        self.x, self.y, self.r = x, y, r

    def distance(self, p):
        """Signed: positive outside."""
        return math.hypot(p[0] - self.x, p[1] - self.y) - self.r

    def points(self, n):
        return [(self.x + self.r * math.cos(a), self.y + self.r * math.sin(a))
                for a in (2 * math.pi * k / n for k in range(n))]

    corners = ()

    def dxf(self):
        return f"0\nCIRCLE\n8\nA\n10\n{self.x!r}\n20\n{self.y!r}\n40\n{self.r!r}\n"


class Round:
    """A rectangle with rounded corners (r = 0: sharp ones), or a slot."""

    def __init__(self, x0, y0, x1, y1, r):
        self.box, self.r = (x0, y0, x1, y1), r

    def distance(self, p):
        x0, y0, x1, y1 = self.box
        cx, cy, hx, hy = (x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2 - self.r, (y1 - y0) / 2 - self.r
        qx, qy = abs(p[0] - cx) - hx, abs(p[1] - cy) - hy
        return math.hypot(max(qx, 0), max(qy, 0)) + min(max(qx, qy), 0) - self.r

    @property
    def corners(self):
        x0, y0, x1, y1 = self.box
        return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)] if self.r == 0 else []

    def vertices(self):
        """Of a polyline with bulges."""
        x0, y0, x1, y1 = self.box
        r, b = self.r, math.tan(math.pi / 8)
        if r == 0:
            return [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
        rows = [(x0 + r, y0, 0), (x1 - r, y0, b), (x1, y0 + r, 0), (x1, y1 - r, b),
                (x1 - r, y1, 0), (x0 + r, y1, b), (x0, y1 - r, 0), (x0, y0 + r, b)]
        out = []
        for k, row in enumerate(rows):  # a slot has no straight ends
            after = rows[(k + 1) % 8]
            if row[2] == 0 and math.dist(row[:2], after[:2]) < 1e-12:
                continue
            out.append(row)
        return out

    def points(self, n):
        out, rows = [], self.vertices()
        for k, (x, y, b) in enumerate(rows):
            ex, ey, _ = rows[(k + 1) % len(rows)]
            for j in range(n // 8):
                t = j / (n // 8)
                if b == 0:
                    out.append((x + t * (ex - x), y + t * (ey - y)))
                    continue
                angle = 4 * math.atan(b)
                turn = math.atan2(ey - y, ex - x) - angle / 2
                cx, cy = x - self.r * math.cos(turn - math.pi / 2), y - self.r * math.sin(turn - math.pi / 2)
                a = turn - math.pi / 2 + t * angle
                out.append((cx + self.r * math.cos(a), cy + self.r * math.sin(a)))
        return out

    def dxf(self):
        rows = self.vertices()
        text = f"0\nLWPOLYLINE\n8\nA\n90\n{len(rows)}\n70\n1\n"
        return text + "".join(f"10\n{x!r}\n20\n{y!r}\n42\n{b!r}\n" for x, y, b in rows)


class Ellipse:
    def __init__(self, x, y, a, b):
        self.x, self.y, self.a, self.b = x, y, a, b

    def distance(self, p):
        px, py = abs(p[0] - self.x), abs(p[1] - self.y)
        t = math.atan2(self.a * py, self.b * px)  # then Newton on the foot
        for _ in range(40):
            c, s = math.cos(t), math.sin(t)
            f = (self.b ** 2 - self.a ** 2) * s * c + px * self.a * s - py * self.b * c
            g = (self.b ** 2 - self.a ** 2) * (c * c - s * s) + px * self.a * c + py * self.b * s
            t -= f / g
        d = math.hypot(px - self.a * math.cos(t), py - self.b * math.sin(t))
        return d if (px / self.a) ** 2 + (py / self.b) ** 2 > 1 else -d

    corners = ()

    def points(self, n):
        return [(self.x + self.a * math.cos(a), self.y + self.b * math.sin(a))
                for a in (2 * math.pi * k / n for k in range(n))]

    def dxf(self):
        return (f"0\nELLIPSE\n8\nA\n10\n{self.x!r}\n20\n{self.y!r}\n11\n{self.a!r}\n21\n0.0\n"
                f"40\n{self.b / self.a!r}\n41\n0.0\n42\n{2 * math.pi!r}\n")


def drawing(shapes, unit=4):
    return (f"0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n"
            "0\nSECTION\n2\nENTITIES\n" + "".join(s.dxf() for s in shapes) + "0\nENDSEC\n0\nEOF\n")


def plate(k=1.0):
    """Ten outlines: a plate, five holes, a slot, a window, an ellipse with a part in it."""
    shapes = [Round(0, 0, 200, 120, 12)]
    shapes += [Circle(x, y, 4) for x, y in ((15, 15), (185, 15), (185, 105), (15, 105))]
    shapes += [Round(55, 10, 145, 20, 5), Round(30, 40, 60, 80, 0), Ellipse(110, 65, 30, 18),
               Round(100, 58, 120, 72, 3), Circle(165, 65, 12.5)]
    for s in shapes:
        for name in ("x", "y", "r", "a", "b"):
            if hasattr(s, name):
                setattr(s, name, getattr(s, name) * k)
        if hasattr(s, "box"):
            s.box = tuple(v * k for v in s.box)
    return shapes, [True] + [False] * 7 + [True, False]  # cut outside


class Cutting(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.at = pathlib.Path(self.folder.name)

    def run_cut(self, text, *options, code=0, name="d.dxf", out="p.nc"):
        (self.at / name).write_text(text)
        (self.at / out).unlink(missing_ok=True)
        done = subprocess.run([PROGRAM, "cut", name, "-o", out, "--json", *map(str, options)], cwd=self.at,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, code, done.stderr)
        if code:
            self.assertFalse((self.at / out).exists())
            return done.stderr
        self.report = json.loads(done.stdout)
        self.text = (self.at / out).read_text()
        return self.text

    def cuts(self, program):
        return [m for m in program.moves if m.code in (1, 2, 3) and min(m.a[2], m.b[2]) < 0]

    def judged(self, shapes, outside, program, diameter, tolerance, exact=(), depth=6.0, climb=True):
        """No gouge, nothing left, rapid moves in the air, the inside first, the right way round."""
        radius, top = diameter / 2, 0.0
        for m in program.moves:
            if m.code == 0 and math.dist(m.a[:2], m.b[:2]) > 0:
                self.assertGreater(min(m.a[2], m.b[2]), top, "a rapid move through the stock")
            if m.code == 0:
                self.assertGreater(m.b[2], top, "a rapid move into the stock")
        done = [[] for _ in shapes]
        for number, m in enumerate(self.cuts(program)):
            for x, y, z in m.places(radius / 4):
                for shape in shapes:
                    self.assertGreaterEqual(abs(shape.distance((x, y))), radius - tolerance,
                                            f"cuts into an outline at {x}, {y}")
            x, y, z = m.at(0.5)
            own = min(range(len(shapes)), key=lambda k: abs(abs(shapes[k].distance((x, y))) - radius))
            done[own].append((number, m))
        for k, (shape, out) in enumerate(zip(shapes, outside)):
            self.assertTrue(done[k], "an outline is not cut")
            path = [p for _, m in done[k] for p in m.places(radius / 20)]
            self.assertAlmostEqual(min(p[2] for p in path), -depth, places=6)
            for p in shape.points(160):
                if any(math.dist(p, c) < 1.5 * radius for c in shape.corners):
                    continue
                away = min(math.dist(p, q[:2]) for q in path)
                self.assertLess(away, radius + tolerance + radius / 100, "something is left")
            side = 1 if out else -1
            for _, m in done[k]:
                x, y, z = m.at(0.5)
                if k in exact and abs(shape.distance((x, y)) * side - radius) < 1e-4:
                    for q in m.places(radius / 4):  # leads touch it and go away
                        here = shape.distance(q) * side - radius
                        if abs(here) < 1e-4:
                            self.assertLess(abs(here), 1e-6, "the compensation is not exact")
            # what stays lies to the right when climbing
            m = max((m for _, m in done[k]), key=Move.length)
            a, b = m.at(0.5), m.at(0.5001)
            right = (a[0] + (b[1] - a[1]) * 100, a[1] - (b[0] - a[0]) * 100)
            nearer = abs(shape.distance(right)) < abs(shape.distance(a))
            self.assertEqual(nearer, climb, "the tool runs the wrong way round")
        first = [d[0][0] for d in done]
        last = [d[-1][0] for d in done]
        for i, shape in enumerate(shapes):
            for j, other in enumerate(shapes):
                if i != j and other.distance(shape.points(16)[0]) < 0:
                    self.assertLess(last[i], first[j], "an outline is cut after one around it")

    def test_a_plate_of_ten_outlines(self):
        shapes, outside = plate()
        for diameter, options in ((3, []), (3, ["--lead-in", 1.2, "--direction", "conventional"]),
                                  (2, ["--ramp", 3]), (5, ["--ramp", 12])):
            with self.subTest(diameter=diameter, options=options):
                text = self.run_cut(drawing(shapes), "--diameter", diameter, "--depth", 6, "--pass-depth", 2.5,
                                    "--decimals", 6, *options)
                exact = [k for k, s in enumerate(shapes) if not isinstance(s, Ellipse)]
                self.judged(shapes, outside, Controller(text), diameter, 0.01, exact,
                            climb="conventional" not in options)
                self.assertEqual(len(self.report["outlines"]), 10)
                self.assertLessEqual(self.report["report"]["beyond"], 0.01)

    def test_the_figures_of_the_report_are_those_of_the_program(self):
        shapes, _ = plate()
        program = Controller(self.run_cut(drawing(shapes), "--diameter", 3, "--depth", 6, "--pass-depth", 3))
        report = self.report["report"]
        cuts = [m for m in program.moves if m.code in (1, 2, 3) and m.length() > 0]
        self.assertEqual(len(cuts), report["blocks"])
        self.assertEqual(sum(m.code > 1 for m in cuts), report["arc_blocks"])
        self.assertAlmostEqual(sum(m.length() for m in cuts), report["cut_length"], places=2)
        rapid = sum(m.length() for m in program.moves if m.code == 0)
        # the first one comes from the origin
        first = next(m for m in program.moves if m.code != 0).a
        self.assertAlmostEqual(rapid + (math.hypot(*first[:2]) if rapid < report["rapid_length"] - 1 else 0),
                               report["rapid_length"], places=2)
        self.assertEqual(report["levels"], 2)
        reach = 1.5 * (math.sqrt(2) - 1)
        self.assertAlmostEqual(report["left_in_corners"], reach, places=6)

    def test_tabs_hold_what_they_hold(self):
        shapes = [Round(0, 0, 80, 50, 6)]
        program = Controller(self.run_cut(drawing(shapes), "--diameter", 3, "--depth", 5, "--pass-depth", 2, "--tabs",
                                          3, "--tab-width", 4, "--tab-height", 1.5))
        deep = [m for m in self.cuts(program) if m.a[2] < -3.5 - 1e-9 or m.b[2] < -3.5 - 1e-9]
        self.assertTrue(deep)
        lifts = [m for m in program.moves if m.code == 1 and m.a[2] == -5.0 and m.b[2] == -3.5]
        falls = [m for m in program.moves if m.code == 1 and m.a[2] == -3.5 and m.b[2] == -5.0]
        self.assertEqual((len(lifts), len(falls)), (3, 3))
        for up, down in zip(lifts, falls):  # a bridge of 4 mm between two ends of a cut of 3 mm
            self.assertGreaterEqual(math.dist(up.a[:2], down.a[:2]), 7 - 1e-3)
            self.assertLess(math.dist(up.a[:2], down.a[:2]), 7.2)
        for m in program.moves:
            if m.a[2] != m.b[2] and m.code == 1:
                self.assertEqual(m.length(), 0.0)

    def test_ramps_are_no_steeper(self):
        program = Controller(self.run_cut(drawing([Circle(0, 0, 20)]), "--diameter", 6, "--depth", 4, "--pass-depth",
                                          2, "--ramp", 2))
        steep = [abs(m.b[2] - m.a[2]) / m.length() for m in self.cuts(program) if m.length() > 0]
        self.assertLess(max(steep), math.tan(math.radians(2)) * 1.001 + 1e-3 / 10)
        self.assertGreater(max(steep), 0.9 * math.tan(math.radians(2)))

    def test_lasers_burn_only_along_outlines(self):
        shapes = [Round(0, 0, 80, 50, 6), Circle(40, 25, 10)]
        for controller, on in (("grbl", 4), ("linuxcnc", 3), ("fanuc", 3), ("marlin", 3)):
            text = self.run_cut(drawing(shapes), "--laser", 800, "--diameter", 0.2, "--controller", controller)
            program = Controller(text, burns=True)
            for m in program.moves:
                self.assertEqual(m.spins, m.code != 0)
            self.assertIn(("M", on), program.codes)
            self.assertNotIn("Z", re.sub(r"\(.*?\)|;.*", "", text))
            for m in program.moves:
                if m.code == 0:
                    continue
                for p in m.places(1.0):
                    self.assertLess(min(abs(shapes[0].distance(p) - 0.1), abs(shapes[1].distance(p) + 0.1)), 0.011)
            ends = {"grbl": "M2", "linuxcnc": "M2", "fanuc": "%", "marlin": "M5"}
            self.assertEqual(text.split()[-1], ends[controller])

    def test_torches_wait(self):
        program = Controller(self.run_cut(drawing([Circle(0, 0, 20)]), "--plasma", 0.5, "--diameter", 1.5), burns=True)
        self.assertEqual(program.dwells, [0.5])
        self.run_cut(drawing([Circle(0, 0, 20)]), "--plasma", 0.5, "--diameter", 1.5, "--controller", "fanuc")
        self.assertIn("G4 P500\n", self.text)

    def test_inches_are_inches(self):
        shapes, outside = plate(0.05)
        text = self.run_cut(drawing(shapes, unit=1), "--diameter", 0.125, "--depth", 0.25, "--tolerance", 0.0005)
        self.assertIn("G20", text)
        program = Controller(text)
        self.judged(shapes, outside, program, 0.125, 0.0005, depth=0.25)

    def test_small_radii_are_cut_more_slowly(self):
        program = Controller(self.run_cut(drawing([Round(0, 0, 80, 50, 6)]), "--diameter", 0, "--depth", 1, "--feed",
                                          6000, "--centripetal", 400))
        for m in self.cuts(program):
            if m.centre:
                self.assertLessEqual((m.feed / 60) ** 2 / m.radius, 400.5)
            elif m.length() > 0:
                self.assertEqual(m.feed, 6000)

    def test_time_is_that_of_constant_acceleration(self):
        # there and back along a line: 100 mm from rest to rest, 1000 mm/min, 500 mm/s2, and the way there
        text = ("0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n100\n21\n0\n0\nENDSEC\n0\nEOF\n")
        self.run_cut(text, "--laser", 100, "--units", "mm")
        v, a = 1000 / 60, 500
        self.assertAlmostEqual(self.report["report"]["minutes"] * 60, 100 / v + v / a, places=6)

    def test_what_does_not_fit_is_refused(self):
        slot = drawing([Round(0, 0, 80, 10, 5)])
        self.assertIn("E409", self.run_cut(slot, "--diameter", 10.5, "--depth", 1, "--side", "inside", code=4))
        near = drawing([Circle(0, 0, 10), Circle(22, 0, 10)])
        said = self.run_cut(near, "--diameter", 3, "--depth", 1, code=4)
        self.assertIn("E409", said)
        self.run_cut(near, "--diameter", 1.9, "--depth", 1)
        notch = drawing([Round(0, 0, 4, 40, 0)])
        self.assertIn("E409", self.run_cut(notch, "--diameter", 5, "--depth", 1, "--side", "inside", code=4))

    def test_options_that_do_not_go_together(self):
        one = drawing([Circle(0, 0, 10)])
        for options, word in (([], "--depth"), (["--depth", -1], "--depth"), (["--depth", 1, "--diameter", -2], "--diameter"),
                              (["--depth", 1, "--ramp", 90], "--ramp"), (["--depth", 1, "--tabs", 2], "--tab-width"),
                              (["--laser", 1, "--plasma", 1], "--laser"), (["--depth", 1, "--side", "left"], "--side"),
                              (["--depth", 1, "--start", "1"], "--start"), (["--depth", 1, "--decimals", 9], "--decimals"),
                              (["--depth", 1, "--tolerance", 0], "--tolerance")):
            said = self.run_cut(one, *options, code=2)
            self.assertIn(word, said)

    def test_random_plates(self):
        dice = random.Random(5)
        for trial in range(6):
            shapes, outside = [Round(0, 0, 300, 200, dice.choice([0, 5, 20]))], [True]
            for column in range(5):
                for row in range(3):
                    x, y = 35 + 57 * column + dice.uniform(-4, 4), 38 + 62 * row + dice.uniform(-4, 4)
                    r = dice.uniform(6, 20)
                    kind = dice.randrange(3)
                    shapes.append(Circle(x, y, r) if kind == 0 else
                                  Round(x - r, y - 0.7 * r, x + r, y + 0.7 * r, dice.choice([0, 4.5])) if kind == 1 else
                                  Ellipse(x, y, r, dice.uniform(0.8, 0.95) * r))
                    outside.append(False)
            with self.subTest(trial=trial):
                text = self.run_cut(drawing(shapes), "--diameter", 4, "--depth", 6)
                self.judged(shapes, outside, Controller(text), 4, 0.01)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
