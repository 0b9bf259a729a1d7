#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Programs of `obvid cut`, read as a controller reads them and cut into drawings whose distances are
known in closed form. Shares nothing with the program.

usage: cutting_test.py PROGRAM
"""
import io
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import unittest

import ezdxf
import numpy as np

TOOLS = pathlib.Path(__file__).resolve().parents[2] / "tools"
sys.path.insert(0, str(TOOLS))

from acceptance_sets import plates  # noqa: E402
from acceptance_sets.controller import Controller  # noqa: E402
from acceptance_sets.plates import Circle, Ellipse, Round, drawing, plate  # noqa: E402

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())


def polygons(*corners):
    """Closed polylines of straight edges, mm."""
    plan = ezdxf.new()
    plan.header["$INSUNITS"] = 4
    for one in corners:
        plan.modelspace().add_lwpolyline(one, close=True)
    with io.StringIO() as out:
        plan.write(out)
        return out.getvalue()


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
        return plates.below(program.moves)

    def judged(self, shapes, outside, program, diameter, tolerance, exact=(), depth=6.0, climb=True):
        """No gouge, nothing left, rapid moves in the air, the inside first, the right way round."""
        found = plates.simulated(shapes, outside, program, diameter, exact)
        self.assertEqual(found["rapids"], 0, "a rapid move through the stock")
        self.assertLessEqual(found["gouge"], tolerance, "cuts into an outline")
        self.assertEqual(found["missed"], 0, "an outline is not cut")
        for deepest in found["depths"]:
            self.assertAlmostEqual(deepest, -depth, places=6)
        self.assertLess(found["left"], tolerance + diameter / 200, "something is left")
        self.assertLess(found["compensation"], 1e-6, "the compensation is not exact")
        self.assertEqual(found["wrong_way"], 0 if climb else len(shapes), "the tool runs the wrong way round")
        self.assertEqual(found["early"], 0, "an outline is cut after one around it")

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

    def test_splines_are_fewer_blocks_within_the_tolerance(self):
        shapes, outside = plate()
        options = ["--diameter", 3, "--depth", 6, "--pass-depth", 2, "--decimals", 6, "--controller", "linuxcnc"]
        arcs = self.cuts(Controller(self.run_cut(drawing(shapes), *options)))
        self.assertNotIn("G5 ", self.text)
        self.assertEqual(self.report["report"]["spline_blocks"], 0)
        for more in ([], ["--lead-in", 1.2], ["--tabs", 3, "--tab-width", 4, "--tab-height", 1], ["--ramp", 3]):
            with self.subTest(more=more):
                program = Controller(self.run_cut(drawing(shapes), *options, *more, "--motion", "splines"), splines=True)
                exact = [k for k, s in enumerate(shapes) if not isinstance(s, Ellipse)]
                if "--tabs" not in more:
                    self.judged(shapes, outside, program, 3, 0.01, exact)
                curves = [m for m in program.moves if m.code == 5]
                self.assertEqual(len(curves), self.report["report"]["spline_blocks"])
                self.assertTrue(curves)
                # the ellipse alone has curvatures that change
                for m in curves:
                    own = min(shapes, key=lambda s: abs(abs(s.distance(m.at(0.5))) - 1.5))
                    self.assertIsInstance(own, Ellipse)
                    for p in m.places(0.05):
                        self.assertLess(abs(abs(own.distance(p)) - 1.5), 0.01)
                if not more:
                    own = lambda moves: sum(isinstance(min(shapes, key=lambda s: abs(abs(s.distance(m.at(0.5))) - 1.5)),  # noqa: E731
                                                       Ellipse) for m in moves)
                    # each of three passes begins where the way is short, which may part one curve
                    self.assertLess(own(self.cuts(program)), 0.6 * own(arcs) + 3)
                cut = sum(m.length() for m in program.moves if m.code != 0 and m.a[:2] != m.b[:2])
                self.assertAlmostEqual(cut, self.report["report"]["cut_length"], places=1)

    def test_drawings_of_curves_are_within_the_tolerance(self):
        own, tolerance = Ellipse(50.0, 40.0, 30.0, 20.0), 0.0005
        (self.at / "e.dxf").write_text(drawing([own]))
        subprocess.run([PROGRAM, "cut", "e.dxf", "--diameter", "3", "--depth", "2", "--tolerance", str(tolerance), "-o", "out.dxf", "-q"], cwd=self.at, check=True)
        drawn = ezdxf.readfile(self.at / "out.dxf").modelspace().query('*[layer=="OUTLINES"]')
        chords = 0
        for line in drawn:
            points = [p[:2] for p in line.get_points("xy")]
            for a, b in zip(points, points[1:]):
                chords += 1
                middle = (0.5 * (a[0] + b[0]), 0.5 * (a[1] + b[1]))
                self.assertLess(abs(own.distance(middle)), tolerance)
        self.assertGreater(chords, 100)

    def test_splines_slow_down_where_they_are_sharp(self):
        program = Controller(self.run_cut(drawing([Ellipse(0, 0, 40, 8)]), "--diameter", 0, "--depth", 1, "--feed", 6000,
                                          "--centripetal", 400, "--controller", "linuxcnc", "--motion", "splines"),
                             splines=True)
        curves = [m for m in program.moves if m.code == 5]
        self.assertTrue(curves)
        for m in curves:
            bend = max(abs(m.curvature(k / 5000)) for k in range(5001))
            self.assertLessEqual((m.feed / 60) ** 2 * bend, 400 * (1 + 1e-6))

    def test_splines_are_refused_where_they_are_not_known(self):
        one = drawing([Ellipse(0, 0, 40, 8)])
        for controller in ("grbl", "fanuc", "marlin"):
            said = self.run_cut(one, "--depth", 1, "--motion", "splines", "--controller", controller, code=2)
            self.assertIn("linuxcnc", said)
        self.assertIn("0.1 mm", said)
        self.run_cut(one, "--depth", 1, "--motion", "lines", "--controller", "linuxcnc", code=2)

    def test_splines_whose_control_points_repeat_are_polygons(self):
        corners = [(-122.79772, 41.66468), (-127.14778, 41.66468), (-128.87016, 46.21777), (-136.86927, 46.21777),
                   (-135.05403, 61.66474)]
        plan = ezdxf.new()
        plan.header["$INSUNITS"] = 4
        points = [corners[0]] * 2 + [c for c in corners[1:] for _ in range(4)] + [corners[0]] * 2
        inner = len(points) - 4
        knots = [0.0] * 4 + [(k + 1) / (inner + 1) for k in range(inner)] + [1.0] * 4
        plan.modelspace().add_spline(degree=3).control_points = points
        plan.modelspace()[0].knots = knots
        with io.StringIO() as out:
            plan.write(out)
            text = out.getvalue()
        cut = self.cuts(Controller(self.run_cut(text, "--side", "on", "--diameter", 2, "--depth", 1)))
        sides = [math.dist(a, b) for a, b in zip(corners, corners[1:] + corners[:1])]
        self.assertAlmostEqual(sum(m.length() for m in cut), sum(sides), delta=0.05)
        for c in corners:
            self.assertLess(min(math.dist(m.b[:2], c) for m in cut), 0.002)

    def test_some_curves_are_cut(self):
        plan = ezdxf.new()
        plan.header["$INSUNITS"] = 4
        places = {"A": (0, 0), "B": (30, 0), "C": (60, 0), "D": (90, 0)}
        for layer, where in (("HOLES", "A"), ("HOLES", "B"), ("FRAME", "C"), ("NOTES", "D")):
            plan.modelspace().add_circle(places[where], 5, dxfattribs={"layer": layer})
        with io.StringIO() as out:
            plan.write(out)
            text = out.getvalue()

        def cut_at(*options):
            program = Controller(self.run_cut(text, "--diameter", 2, "--depth", 1, "--side", "on", *options))
            return {where for where, (x, y) in places.items()
                    if any(math.hypot(m.b[0] - x, m.b[1] - y) < 6 for m in self.cuts(program))}

        self.assertEqual(cut_at(), set(places))
        self.assertEqual(cut_at("--curve", "HOLES"), {"A", "B"})
        self.assertEqual(len(cut_at("--curve", "HOLES,FRAME")), 3)
        self.assertEqual(len(cut_at("--curve", "1,3")), 2)
        self.assertEqual(len(cut_at("--curve", 2)), 1)
        self.assertIn("E203", self.run_cut(text, "--depth", 1, "--diameter", 2, "--curve", "1,9", code=2))
        self.assertIn("E203", self.run_cut(text, "--depth", 1, "--diameter", 2, "--curve", "1,0", code=2))

    def test_tabs_lie_on_sides_and_what_passes_above_is_whole(self):
        program = Controller(self.run_cut(drawing([Round(0, 0, 50, 50, 0)]), "--diameter", 3, "--depth", 6, "--pass-depth", 2,
                                          "--side", "outside", "--tabs", 4, "--tab-width", 4, "--tab-height", 1.5))
        lifted = [m for m in self.cuts(program) if m.a[2] == m.b[2] == -4.5]
        self.assertEqual(len(lifted), 4)
        for m in lifted:  # around the outline of 50 by 50 with the radius of the tool: away from corners
            for p in (m.a, m.b):
                self.assertGreater(min(math.hypot(p[0] - x, p[1] - y) for x in (0, 50) for y in (0, 50)), 5)
        for level in (-2.0, -4.0):  # four sides, four arcs around corners
            whole = [m for m in self.cuts(program) if m.a[2] == m.b[2] == level]
            self.assertLessEqual(len(whole), 10)

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

    def test_leads_lead_away_behind_ramps_too(self):
        """From where the ramp ends, or farther on: a quarter circle beside a straight wall ends its radius away."""
        hole = Circle(30, 30, 8)
        for lead in (0.5, 1.0):
            program = Controller(self.run_cut(drawing([hole]), "--diameter", 3, "--depth", 2, "--ramp", 3, "--lead-in",
                                              lead, "--decimals", 5, "--side", "inside"))
            last = [m for m in self.cuts(program)][-1]
            self.assertAlmostEqual(hole.distance(last.a), -1.5 if hole.distance(last.a) < 0 else 1.5, places=3)
            inner = 6.5 - lead  # around the centre of the circle: that of the lead
            self.assertAlmostEqual(math.hypot(last.b[0] - 30, last.b[1] - 30), math.hypot(inner, lead), places=3)
        shapes, outside = plate()
        for options in ([], ["--tabs", 2, "--tab-width", 5, "--tab-height", 1.8], ["--direction", "conventional"],
                        ["--tabs", 3, "--tab-width", 5, "--tab-height", 1.8, "--start", "0,0"]):
            with self.subTest(options=options):
                program = Controller(self.run_cut(drawing(shapes), "--diameter", 3, "--depth", 6, "--pass-depth", 2.5,
                                                  "--ramp", 3, "--lead-in", 1.2, "--decimals", 5, *options))
                self.assertFalse([w for w in self.report["warnings"] if "lead-in" in w])
                if "--tabs" not in options:
                    self.judged(shapes, outside, program, 3, 0.01, climb="conventional" not in options)
                ends = [a for a, b in zip(program.moves, program.moves[1:])
                        if a.b[2] < 0 and b.code == 0 and b.b[2] > 0]
                self.assertEqual(len(ends), len(shapes))
                for m in ends:  # from half of the lead's radius on where the wall is round or a corner near
                    self.assertGreater(min(abs(s.distance(m.b[:2])) for s in shapes), 1.5 + 0.6)
                deep = [m for m in self.cuts(program) if min(m.a[2], m.b[2]) < -4.2 - 1e-9]
                self.assertTrue(deep)

    def test_curves_that_are_followed_have_neither_tabs_nor_leads_and_say_so(self):
        plan = ezdxf.new()
        plan.header["$INSUNITS"] = 4
        plan.modelspace().add_lwpolyline([(0, 0), (30, 0), (30, 20)], dxfattribs={"layer": "BEND"})
        with io.StringIO() as out:
            plan.write(out)
            text = out.getvalue()
        for options, words in ((["--lead-in", 1], "--lead-in"),
                               (["--tabs", 2, "--tab-width", 3, "--tab-height", 0.5], "--tabs"),
                               (["--lead-in", 1, "--tabs", 2, "--tab-width", 3, "--tab-height", 0.5], "--tabs, --lead-in")):
            self.run_cut(text, "--diameter", 2, "--depth", 1, *options)
            told = [w for w in self.report["warnings"] if w.startswith(words + ": ")]
            self.assertEqual(len(told), 1, self.report["warnings"])
            self.assertIn("BEND", told[0])
        self.run_cut(text, "--diameter", 2, "--depth", 1)
        self.assertFalse([w for w in self.report["warnings"] if "open curves:" in w])

    def test_the_drawing_of_the_paths_has_closed_loops_and_no_slivers(self):
        shapes, _ = plate()
        circles = sum(isinstance(s, Circle) for s in shapes)
        for options in ([], ["--lead-in", 1.2], ["--ramp", 3]):
            with self.subTest(options=options):
                self.run_cut(drawing(shapes), "--diameter", 3, "--depth", 2, *options, out="paths.dxf")
                drawn = ezdxf.readfile(self.at / "paths.dxf").modelspace().query('*[layer=="CUT"]')
                ends, round_ones = [], []
                for e in drawn:
                    if e.dxftype() == "CIRCLE":
                        round_ones.append(e)
                        continue
                    a, b = ((e.dxf.start, e.dxf.end) if e.dxftype() == "LINE" else (e.start_point, e.end_point))
                    ends += [(a.x, a.y), (b.x, b.y)]
                    size = math.dist(ends[-1], ends[-2])
                    self.assertGreater(size, 0.005)
                if options:
                    continue
                self.assertEqual(len(round_ones), 2 * circles)
                for circle in (s for s in shapes if isinstance(s, Circle)):
                    own = [e.dxf.radius for e in round_ones
                           if math.hypot(e.dxf.center.x - circle.x, e.dxf.center.y - circle.y) < 1e-2]
                    self.assertEqual(len(own), 2)
                    self.assertAlmostEqual(abs(own[0] - own[1]), 3, delta=2e-3)
                ends = np.array(ends)
                for k, p in enumerate(ends):
                    others = np.delete(ends, k, axis=0)
                    self.assertLess(np.hypot(*(others - p).T).min(), 1e-9)

    def test_what_the_digits_cannot_print_is_refused_at_once(self):
        own = drawing([Ellipse(50.0, 40.0, 30.0, 20.0), Circle(0, 0, 5)])
        for tolerance, more in ((1e-9, []), (1e-8, []), (1e-6, ["--decimals", 6]), (0.001, ["--decimals", 3])):
            before = os.times()
            said = self.run_cut(own, "--diameter", 3, "--depth", 2, "--tolerance", tolerance, *more, code=5)
            spent = os.times().children_user - before.children_user
            self.assertLess(spent, 1.0)
            self.assertIn("E502", said)
            enough = float(re.search(r"--tolerance (\S+) or more", said)[1])
            if more != ["--decimals", 3]:
                self.assertNotIn("more --decimals", said)
            decimals = more or ["--decimals", 6]
            self.run_cut(own, "--diameter", 3, "--depth", 2, "--tolerance", enough, *decimals)
            self.assertLessEqual(max(self.report["report"]["beyond"], self.report["report"]["short_of"]), enough)

    def test_notches_are_not_measured_through_walls(self):
        plan = ezdxf.new()
        plan.header["$INSUNITS"] = 4
        plan.modelspace().add_lwpolyline([(0, 0), (40, 0), (40, 30), (25, 30), (20, 2), (15, 30), (0, 30)], close=True)
        with io.StringIO() as out:
            plan.write(out)
            text = out.getvalue()
        self.run_cut(text, "--diameter", 6, "--depth", 1)
        left = 3 / math.sin(math.atan2(5, 28)) - 3
        self.assertAlmostEqual(self.report["outlines"][0]["left_in_corners"], left, places=6)
        self.assertAlmostEqual(self.report["report"]["left_in_corners"], left, places=6)

    def test_ramps_are_kept_behind_tabs(self):
        shapes, outside = plate()
        program = Controller(self.run_cut(drawing(shapes), "--diameter", 3, "--depth", 6, "--pass-depth", 2, "--ramp", 5,
                                          "--tabs", 2, "--tab-width", 5, "--tab-height", 1.8))
        fallen = [m for m in program.moves if m.code == 1 and m.length() == 0 and m.b[2] < m.a[2] and m.a[2] < 0]
        self.assertEqual(fallen, [])
        slopes = [(m.a[2] - m.b[2]) / m.length() for m in self.cuts(program) if m.length() > 0.5]
        self.assertLess(max(slopes), math.tan(math.radians(5)) * 1.01 + 2e-3)
        self.assertEqual(plates.simulated(shapes, outside, program, 3, ())["rapids"], 0)
        # between the tabs everything is cut to the depth: straight down it is the same ground
        ground = lambda moves: {(round(x, 1), round(y, 1)) for m in moves if m.a[2] == m.b[2] == -6.0  # noqa: E731
                                for x, y, _ in m.places(0.2)}
        straight = Controller(self.run_cut(drawing(shapes), "--diameter", 3, "--depth", 6, "--pass-depth", 2, "--tabs", 2,
                                           "--tab-width", 5, "--tab-height", 1.8))
        asked, cut = (np.array(sorted(ground(one.moves))) for one in (straight, program))
        far = [p for p in asked if np.hypot(*(cut - p).T).min() > 0.5]
        self.assertEqual(far, [])

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

    def test_outlines_begin_at_the_nearest_place(self):
        one = drawing([Round(0, 0, 100, 60, 0)])
        for options, start in ((["--laser", 100, "--start", "2,0"], (2, 0)),
                               (["--laser", 100, "--start", "104,63"], (100, 60)),
                               (["--diameter", 3, "--depth", 1, "--start", "105,20"], (101.5, 20)),
                               (["--diameter", 3, "--depth", 1, "--start", "20,-5"], (20, -1.5)),
                               # a quarter of a circle of 2 mm, on the side of the waste
                               (["--diameter", 3, "--depth", 1, "--lead-in", 2, "--start", "20,-5"], (20, -3.5)),
                               (["--diameter", 3, "--depth", 1, "--lead-in", 2, "--start", "50,62.5"], (50, 63.5))):
            with self.subTest(options=options):
                program = Controller(self.run_cut(one, *options), burns="--laser" in options)
                told = self.report["outlines"][0]["start"]
                first = next(m for m in program.moves if m.code != 0 and m.a[:2] != m.b[:2]).a
                for place in (told, first):
                    self.assertAlmostEqual(place[0], start[0], delta=2e-3)
                    self.assertAlmostEqual(place[1], start[1], delta=2e-3)
        self.run_cut(drawing([Circle(20, 30, 10)]), "--laser", 100, "--start", "20,5")
        self.assertEqual(self.report["outlines"][0]["start"], [20, 20])

    def test_the_way_from_home_is_the_shortest(self):
        self.run_cut(drawing([Round(0, 0, 100, 60, 0)]), "--laser", 100)
        self.assertEqual(self.report["report"]["rapid_length"], 0)
        self.run_cut(drawing([Circle(30, 40, 10)]), "--laser", 100)
        self.assertAlmostEqual(self.report["report"]["rapid_length"], 40, places=2)

    def test_figures_have_no_rounding_of_ours(self):
        self.run_cut(drawing([Round(0.1, 0.7, 3, 3, 0)]), "--laser", 100, "--start", "0.3,0.7", "--units", "mm")
        for one in self.report["outlines"]:
            self.assertEqual(one["start"], [0.3, 0.7])
            self.assertEqual(one["length"], 10.4)

    def test_text_is_no_curve_in_dxf_and_svg_alike(self):
        plan = ezdxf.new()
        plan.header["$INSUNITS"] = 4
        plan.modelspace().add_circle((20, 20), 5)
        plan.modelspace().add_text("hello")
        with io.StringIO() as out:
            plan.write(out)
            text = out.getvalue()
        svg = ('<svg xmlns="http://www.w3.org/2000/svg" width="50mm" height="50mm" viewBox="0 0 50 50">'
               '<circle cx="20" cy="20" r="5"/><text x="1" y="2">hello</text></svg>')
        for name, data in (("d.dxf", text), ("d.svg", svg)):
            self.run_cut(data, "--laser", 100, name=name)
            self.assertEqual(self.report["left_out"], 0)
            self.assertIn("converted to paths", " ".join(self.report["warnings"]))

    def test_a_unit_that_is_assumed_is_told_once(self):
        plan = ezdxf.new()
        plan.header["$INSUNITS"] = 0
        plan.modelspace().add_circle((20, 20), 5)
        with io.StringIO() as out:
            plan.write(out)
            (self.at / "u.dxf").write_text(out.getvalue())
        done = subprocess.run([PROGRAM, "cut", "u.dxf", "--laser", "100"], cwd=self.at, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual(done.stderr.count("--units"), 1, done.stderr)
        self.assertIn("mm is assumed", done.stderr)
        self.assertIn("lengths in mm, as assumed", done.stdout)

    def test_what_does_not_fit_is_refused(self):
        slot = drawing([Round(0, 0, 80, 10, 5)])
        self.assertIn("E409", self.run_cut(slot, "--diameter", 10.5, "--depth", 1, "--side", "inside", code=4))
        near = drawing([Circle(0, 0, 10), Circle(22, 0, 10)])
        said = self.run_cut(near, "--diameter", 3, "--depth", 1, code=4)
        self.assertIn("E409", said)
        self.run_cut(near, "--diameter", 1.9, "--depth", 1)
        notch = drawing([Round(0, 0, 4, 40, 0)])
        self.assertIn("E409", self.run_cut(notch, "--diameter", 5, "--depth", 1, "--side", "inside", code=4))

    def test_slots_narrower_than_the_tool_are_refused(self):
        plates = {  # upper side of a plate of 40 by 20: the widest cutter that enters
            1.0: [(20.5, 20), (20.5, 10), (19.5, 10), (19.5, 20)],
            2 * math.hypot(0.5, 15) * 0.5 / 15: [(20.5, 20), (20, 5), (19.5, 20)],
        }
        for widest, inside in plates.items():
            with self.subTest(widest=widest):
                text = polygons([(0, 0), (40, 0), (40, 20), *inside, (0, 20)])
                said = self.run_cut(text, "--diameter", 4, "--depth", 2, code=4)
                self.assertIn("E409", said)
                named = float(re.search(r"a cutter of ([0-9.]+) enters it", said)[1])
                self.assertLessEqual(named, widest)
                self.assertGreater(named, 0.99 * widest)
                self.run_cut(text, "--diameter", named, "--depth", 2)
                self.run_cut(text, "--diameter", 1.02 * widest, "--depth", 2, code=4)

    def test_much_that_stays_in_corners_is_warned_of_also_when_quiet(self):
        notch = polygons([(0, 0), (40, 0), (40, 30), (25, 30), (20, 2), (15, 30), (0, 30)])
        step = polygons([(0, 0), (40, 0), (40, 20), (20, 20), (20, 21), (0, 21)])
        for text, said in ((notch, "leaves more than its radius in 1 inner corner: up to 14.1 mm"),
                           (step, "too short for the round tool to touch them: 1.00 mm of")):
            (self.at / "d.dxf").write_text(text)
            done = subprocess.run([PROGRAM, "cut", "d.dxf", "--diameter", "6", "--depth", "1", "-q"], cwd=self.at,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(said, done.stderr)

    def test_common_edges_and_crossings_are_told_where_nothing_is_compensated(self):
        def rectangle(x, y, w, h):
            return [(x, y), (x + w, y), (x + w, y + h), (x, y + h)]
        apart = polygons(rectangle(0, 0, 30, 20), rectangle(31, 0, 30, 20))
        self.run_cut(apart, "--laser", 100)
        self.assertEqual(self.report["warnings"], [])
        # three parts: the middle one shares 20 with the first and 12 with the last
        common = polygons(rectangle(0, 0, 30, 20), rectangle(30, 0, 30, 20), rectangle(60, 5, 30, 12))
        self.run_cut(common, "--laser", 100)
        said = "\n".join(self.report["warnings"])
        self.assertIn("32.0 mm are burnt once more", said)
        self.assertNotIn("cross", said)
        crossing = polygons(rectangle(0, 0, 30, 20), rectangle(20, 10, 30, 20), rectangle(45, 15, 30, 2))
        self.run_cut(crossing, "--laser", 100)
        said = "\n".join(self.report["warnings"])
        self.assertIn("closed outlines cross and are cut as they are drawn", said)
        self.assertIn("and 1 pair more", said)
        self.assertNotIn("burnt", said)
        self.run_cut(crossing, "--laser", 100, "--side", "on")  # as asked
        self.assertEqual(self.report["warnings"], [])

    def test_outlines_of_drawings_of_paths_are_circles_where_they_were(self):
        (self.at / "d.dxf").write_text(drawing([Circle(20, 30, 7)]))
        subprocess.run([PROGRAM, "cut", "d.dxf", "--diameter", "2", "--depth", "1", "-o", "paths.dxf"], cwd=self.at,
                       check=True, capture_output=True)
        found = [e for e in ezdxf.readfile(self.at / "paths.dxf").modelspace() if e.dxf.layer == "OUTLINES"]
        self.assertEqual([e.dxftype() for e in found], ["CIRCLE"])
        self.assertAlmostEqual(found[0].dxf.radius, 7.0, places=9)

    def test_remarks_for_fanuc_have_no_small_letters(self):
        text = self.run_cut(drawing([Circle(0, 0, 10)]), "--diameter", 2, "--depth", 1, "--controller", "fanuc")
        remarks = re.findall(r"\(.*\)", text)
        self.assertTrue(remarks)
        for one in remarks:
            self.assertEqual(one, one.upper())

    def test_options_that_do_not_go_together(self):
        one = drawing([Circle(0, 0, 10)])
        for options, word in (([], "--depth"), (["--depth", -1], "--depth"), (["--depth", 1, "--diameter", -2], "--diameter"),
                              (["--depth", 1, "--ramp", 90], "--ramp"), (["--depth", 1, "--tabs", 2], "--tab-width"),
                              (["--laser", 1, "--plasma", 1], "--laser"), (["--depth", 1, "--side", "left"], "--side"),
                              (["--depth", 1, "--start", "1"], "--start"), (["--depth", 1, "--decimals", 9], "--decimals"),
                              (["--depth", 1, "--tolerance", 0], "--tolerance"), (["--laser", 0], "--laser"),
                              (["--laser", 1e-5], "--laser"), (["--depth", 1, "--spindle", 0], "--spindle")):
            said = self.run_cut(one, *options, code=2)
            self.assertIn(word, said)

    def test_random_plates(self):
        dice = random.Random(5)
        for trial in range(6):
            shapes, outside = plates.random_plate(dice)
            with self.subTest(trial=trial):
                text = self.run_cut(drawing(shapes), "--diameter", 4, "--depth", 6)
                self.judged(shapes, outside, Controller(text), 4, 0.01)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
