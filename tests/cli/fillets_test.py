#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Blends by `surface fillet` against closed forms: cylinders, tori, cones of balls; trims, units, errors, FreeCAD. Borders
by `surface match`.

usage: fillets_test.py PROGRAM PLUGINS

Evaluates stored surfaces by the recursion of trims_test.py (de Boor, Cox); needs numpy. What FreeCAD says of STEP
files is asked where freecadcmd and the helper in the folder PLUGINS are there.
"""
import json
import math
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

import trims_test
from trims_test import CIRCLE, TURN, along, at_surface, model, np, patch

FLAT = [0, 0, 1, 1]


def plate(name, a, b, c, d):
    return patch(name, (1, 1), (FLAT, FLAT), [list(map(float, p)) for p in (a, b, c, d)])


def corner(angle, length=4.0, width=3.0, scale=1.0, turn=None, shift=(0, 0, 0)):
    """Two plates that meet in the y axis: one along x, one turned up from it by the angle."""
    c, s = math.cos(angle), math.sin(angle)
    plates = [[(0, 0, 0), (width, 0, 0), (0, length, 0), (width, length, 0)],
              [(0, 0, 0), (width * c, 0, width * s), (0, length, 0), (width * c, length, width * s)]]
    turn = np.eye(3) if turn is None else turn
    return [plate(name, *[scale * (turn @ np.array(p, float)) + np.array(shift, float) for p in points])
            for name, points in zip(("floor", "wall"), plates)]


def disc(r, z):
    """A square plate around the origin."""
    return plate("cap", (-r, -r, z), (r, -r, z), (-r, r, z), (r, r, z))


def tube(r, z0, z1):
    points = [[r * x, r * y, z] for z in (z0, z1) for x, y, _ in CIRCLE]
    return patch("tube", (2, 1), (TURN, FLAT), points, [w for _ in range(2) for _, _, w in CIRCLE])


def normal(told, u, v):
    """By differences."""
    ku, kv = told["knots_u"], told["knots_v"]
    hu, hv = 1e-6 * (ku[-1] - ku[0]), 1e-6 * (kv[-1] - kv[0])
    a, b = min(max(u, ku[0] + hu), ku[-1] - hu), min(max(v, kv[0] + hv), kv[-1] - hv)
    n = np.cross(at_surface(told, a + hu, b) - at_surface(told, a - hu, b), at_surface(told, a, b + hv) - at_surface(told, a, b - hv))
    return n / np.linalg.norm(n)


SHARES = [k / 10 for k in range(11)] + [0.013, 0.337, 0.781]


class Fillets(trims_test.Trims):
    """What runs the program is shared with the test of trims, whose own tests are not repeated."""

    def filleted(self, faces, *options, also=()):
        source, out = self.work / "in.json", self.work / "out.json"
        source.write_text(json.dumps(model(*faces)))
        done = self.run_it("surface", "fillet", source, *options, "-o", out, *(part for one in also for part in ("-o", self.work / one)))
        told = json.loads(out.read_text())
        return told["patches"], done.stdout, out

    def blend_points(self, blend):
        for u in SHARES:
            for v in SHARES:
                yield u, v, at_surface(blend, u, v)

    def test_check_measures_along_the_trims(self):
        """Tangent to both plates, and a plate that was lowered by 0.01 is found again."""
        patches, _, out = self.filleted(corner(math.pi / 2), "--faces", "floor,wall", "--radius", "0.5")
        told = json.loads(self.run_it("surface", "check", out, "--json").stdout)
        self.assertEqual([(j["patches"], j["order"]) for j in told["trim_joints"]], [([0, 2], 1), ([1, 2], 1)])
        for joint in told["trim_joints"]:
            self.assertLess(joint["gap"], 1e-8)
            self.assertLess(joint["angle"], 1e-8)
            self.assertAlmostEqual(joint["length"], 4.0, places=9)
        self.assertEqual(told["free_borders"], 2)
        self.assertAlmostEqual(told["trimmed_borders"]["free"], 18.0, places=9)
        self.assertFalse([text for text in told["warnings"] if "not compared" in text])
        whole = json.loads(out.read_text())
        floor = whole["patches"][0]
        floor["points"] = [[x, y, z - 0.01] for x, y, z in floor["points"]]
        out.write_text(json.dumps(whole))
        told = json.loads(self.run_it("surface", "check", out, "--meeting", "0.1", "--json").stdout)
        self.assertEqual([j["patches"] for j in told["trim_joints"]], [[0, 2], [1, 2]])
        self.assertAlmostEqual(told["trim_joints"][0]["gap"], 0.01, places=7)
        text = self.run_it("surface", "check", out).stdout
        self.assertRegex(text, r"wall +blend of floor and wall +4\.000 +")
        self.assertNotRegex(text, r"floor +blend of floor and wall +4\.000 +")
        self.assertIn("of trims  26.00 mm, 22.00 mm of them along no other face", text)

    def test_two_plates_give_a_cylinder(self):
        for angle, units in ((math.pi / 2, ((1.0, (0, 0, 0)), (1e-6, (0, 0, 0)), (1e6, (3e6, 0, 0)), (1.0, (0, 1e6, 0)))),
                             (2.0, ((1e-6, (0, 0, 0)),)), (0.8, ((1e6, (3e6, 0, 0)),))):
            for scale, shift in units:
                with self.subTest(angle=angle, scale=scale, shift=shift):
                    q, _ = np.linalg.qr(np.array([[0.3, 0.5, 0.1], [0.7, -0.2, 0.4], [0.1, 0.9, -0.6]]))
                    q = q * np.sign(np.linalg.det(q))
                    r = 0.7 * scale
                    patches, _, out = self.filleted(corner(angle, scale=scale, turn=q, shift=shift), "--faces", "floor,wall", "--radius", repr(r))
                    floor, wall, blend = patches
                    # the axis: r from both plates, in the middle of the angle
                    middle = r / math.sin(angle / 2) * np.array([math.cos(angle / 2), 0, math.sin(angle / 2)])
                    rounding = 1e-9 * scale + 1e-15 * max(shift)
                    for u, v, p in self.blend_points(blend):
                        x = q.T @ (p - np.array(shift, float)) - middle
                        self.assertAlmostEqual(math.hypot(x[0], x[2]), r, delta=rounding)
                        self.assertTrue(-rounding <= x[1] <= 4 * scale + rounding)
                    self.assertLessEqual(len(blend["points"]), 10 if angle < 1.1 else 6)  # more than 2 rad in two pieces
                    foot = r / math.tan(angle / 2)
                    area, _ = self.area(out)
                    truth = 2 * (3 * scale - foot) * 4 * scale + r * (math.pi - angle) * 4 * scale
                    self.assertAlmostEqual(area / truth, 1.0, delta=2e-5)  # areas of whole patches are good to some 1e-4
                    self.assertTrue(floor["trims"] and wall["trims"])

    def sections(self, source, *planes):
        lines = self.work / "lines.json"
        self.run_it("surface", "cut", source, *(part for one in planes for part in ("--plane", one)), "-o", lines, "-q")
        return [one["branches"] for one in json.loads(lines.read_text())["sections"]]

    def test_sections_of_rounded_edges_are_one_branch(self):
        """Both plates and the arc between them, from end to end."""
        length, width, r = 100.0, 60.0, 10.0
        for degrees in (60, 120):
            angle = math.radians(degrees)
            foot, up = r / math.tan(angle / 2), np.array([math.cos(angle), math.sin(angle)])
            _, _, out = self.filleted(corner(angle, length, width), "--faces", "floor,wall", "--radius", r)
            stations = (10.0, 31.7, 50.0, 75.0, 99.0)
            for at, branches in zip(stations, self.sections(out, *(f"0,1,0,{at}" for at in stations))):
                with self.subTest(degrees=degrees, at=at):
                    self.assertEqual(len(branches), 1)
                    self.assertFalse(branches[0]["closed"])
                    places = np.array([p[:3] for p in branches[0]["points"]])
                    self.assertLessEqual(np.abs(places[:, 1] - at).max(), 1e-9)
                    line = places[:, [0, 2]]
                    if abs(line[0, 1]) > 1e-9:
                        line = line[::-1]
                    np.testing.assert_allclose(line[0], [width, 0.0], atol=1e-9)
                    np.testing.assert_allclose(line[-1], width * up, atol=1e-9)
                    for x, z in line:
                        off = [abs(z) if x >= foot - 1e-9 else 1.0, abs(math.hypot(x - foot, z - r) - r),
                               abs(up[0] * z - up[1] * x) if up @ (x, z) >= foot - 1e-9 else 1.0]
                        self.assertLessEqual(min(off), 1e-9)
                    for touch in (np.array([foot, 0.0]), foot * up):
                        self.assertLessEqual(np.linalg.norm(line - touch, axis=1).min(), 1e-8)
                    steps = np.linalg.norm(np.diff(line, axis=0), axis=1)
                    self.assertGreater(steps.min(), 0.0)
                    self.assertAlmostEqual(steps.sum(), 2 * (width - foot) + r * (math.pi - angle), delta=1e-3 * r)
            aslant = self.sections(out, "0.3,1,0.2,60")[0]
            self.assertEqual([one["closed"] for one in aslant], [False])

    def test_sections_go_round_blends_that_close(self):
        """A tube whose floor is rounded inside: down, round, across, round, up; level cuts are circles."""
        big, r = 2.0, 0.5
        _, _, out = self.filleted([disc(5.0, 0.0), tube(big, 0.0, 4.0)], "--faces", "cap,tube", "--radius", r, "--sides", "front,back")
        upright, through_blend, above = self.sections(out, "0,1,0,0.3", "0,0,1,0.2", "0,0,1,2")
        self.assertEqual([one["closed"] for one in upright], [False])
        ends = sorted((upright[0]["points"][0], upright[0]["points"][-1]))
        x = math.sqrt(big ** 2 - 0.09)
        np.testing.assert_allclose([p[:3] for p in ends], [[-x, 0.3, 4.0], [x, 0.3, 4.0]], atol=1e-9)
        for circle, radius in ((through_blend, big - r + math.sqrt(r ** 2 - 0.09)), (above, big)):
            self.assertEqual([one["closed"] for one in circle], [True])
            for p in circle[0]["points"]:
                self.assertAlmostEqual(math.hypot(p[0], p[1]), radius, delta=2e-6)

    def test_many_edges_beside_each_other_are_all_found_whichever_face_is_first(self):
        """A roof of twelve ridges through a plate: 24 edges, a cylinder along each, and 25 strips of the plate."""
        periods, r = 12, 0.05
        ridge = [(0.5 * k, -0.25 if k % 2 == 0 else 0.25) for k in range(2 * periods + 1)]
        knots = [0.0] + list(range(2 * periods + 1)) + [2.0 * periods]
        roof = patch("roof", (1, 1), (knots, FLAT), [[x, y, z] for y in (0.0, 2.0) for x, z in ridge])
        ground = plate("ground", (-1, 0, 0), (13, 0, 0), (-1, 2, 0), (13, 2, 0))
        lean = r * math.tan(math.pi / 8)  # the centre is above both, beside where they meet
        axes = [0.25 + 0.5 * k + (-lean if k % 2 == 0 else lean) for k in range(2 * periods)]
        for faces in ("ground,roof", "roof,ground"):
            with self.subTest(faces=faces):
                patches, said, out = self.filleted([ground, roof], "--faces", faces, "--radius", r, "--sides", "front,front")
                blends = [one for one in patches if one["name"].startswith("blend")]
                self.assertEqual(len(blends), 2 * periods, said)
                used = []
                for blend in blends:
                    middle = at_surface(blend, 0.5, 0.5)
                    axis = min(range(len(axes)), key=lambda k: abs(axes[k] - middle[0]))
                    used.append(axis)
                    for _, _, p in self.blend_points(blend):
                        self.assertAlmostEqual(math.hypot(p[0] - axes[axis], p[2] - r), r, delta=1e-9)
                self.assertEqual(sorted(used), list(range(2 * periods)))
                # of the plate both ends and what is between neighbours that the roof is below; of the roof what is above
                area, _ = self.area(out)
                plate_left = 2.0 * (14.0 - periods * 0.5 - 2 * periods * lean)
                roof_left = 2.0 * (periods * math.sqrt(2.0) * 0.5 - 2 * periods * lean)
                blend_area = 2.0 * 2 * periods * r * math.pi / 4
                self.assertAlmostEqual(area / (plate_left + roof_left + blend_area), 1.0, delta=1e-6)

    def test_a_tube_on_a_plate_gives_a_torus(self):
        """Outside the ball's centre runs at R + r, inside at R - r."""
        big, r = 2.0, 0.5
        for sides, ring in (("front,front", big + r), ("front,back", big - r)):
            with self.subTest(sides=sides):
                patches, said, out = self.filleted([disc(5.0, 0.0), tube(big, 0.0, 4.0)], "--faces", "cap,tube", "--radius", r, "--sides", sides)
                blend = patches[-1]
                for u, v, p in self.blend_points(blend):
                    self.assertAlmostEqual(math.hypot(math.hypot(p[0], p[1]) - ring, p[2] - r), r, delta=2e-6)
                self.assertIn("closed", said)
                edge = [at_surface(blend, u, 0.0) - at_surface(blend, u, 1.0) for u in SHARES]
                self.assertLessEqual(max(np.abs(edge).max(1)), 1e-12)
                area, _ = self.area(out)
                cap = 100.0 - math.pi * ring ** 2 if ring > big else math.pi * ring ** 2
                # Pappus: the arc's centroid lies 2 r / pi from its centre, towards the edge
                torus = 2 * math.pi * (ring + (2 * r / math.pi if ring < big else -2 * r / math.pi)) * (math.pi / 2 * r)
                truth = cap + 2 * math.pi * big * (4.0 - r) + torus
                self.assertAlmostEqual(area / truth, 1.0, delta=1e-4)
                for one in patches[:-1]:
                    for loop in one["trims"]:
                        for curve in loop:
                            for place in along(curve, 21):
                                p = at_surface(one, *place)
                                on_contact = abs(p[2] - r) if "tube" in one["name"] else abs(math.hypot(p[0], p[1]) - ring)
                                on_border = ("tube" in one["name"] and min(abs(p[2] - 4.0), abs(p[1])) < 1e-9) or max(abs(p[0]), abs(p[1])) > 4.999
                                self.assertTrue(on_contact <= 2e-6 or on_border, p)

    def test_a_radius_that_grows_gives_the_cone_of_its_balls(self):
        """Between two plates the envelope of balls with a linear radius is a cone through the corner of the edge."""
        for radii in ((0.4, 1.0), (1.0, 0.4), (1.0, 0.003)):  # with the last the radius runs out on a way of the first one's length
            patches, _, _ = self.filleted(corner(math.pi / 2, length=4.0), "--faces", "floor,wall", "--radius", radii[0],
                                          "--radius-end", radii[1], "--tolerance", 1e-9)
            self.cone_of_balls(patches[2], *sorted(radii))

    def cone_of_balls(self, blend, a, b):
        ends = sorted(((at_surface(blend, 0.0, v)[0], at_surface(blend, 0.0, v)[1]) for v in (0.0, 1.0)))
        self.assertAlmostEqual(ends[0][0], a, delta=1e-6)
        self.assertAlmostEqual(ends[1][0], b, delta=1e-6)
        # the spine is straight: centre (q, y, q) with q = radius
        for u, v, p in self.blend_points(blend):
            y0, y1 = ends[0][1], ends[1][1]
            # distance from the line of centres and the angle of the cone
            start, end = np.array([a, y0, a]), np.array([b, y1, b])
            way = (end - start) / np.linalg.norm(end - start)
            slope = (b - a) / np.linalg.norm(end - start)
            x = p - start
            axial = x @ way
            radial = np.linalg.norm(x - axial * way)
            self.assertAlmostEqual(radial * math.sqrt(1 - slope ** 2) - axial * slope, a, delta=1e-7)
        for u, wanted in ((0.0, [0, 0, 1]), (1.0, [1, 0, 0])):
            for v in SHARES:
                self.assertAlmostEqual(abs(normal(blend, u, v) @ np.array(wanted)), 1.0, delta=1e-6)

    def test_faces_of_one_name_are_told_by_their_numbers(self):
        floor, wall = corner(math.pi / 2, length=4.0)
        source = self.work / "in.json"
        source.write_text(json.dumps(model(floor, wall, floor)))
        done = self.run_it("surface", "fillet", source, "--faces", "floor,wall", "--radius", 0.2, "-o", self.work / "out.json", code=2)
        self.assertIn("2 faces are called 'floor' (--faces); give its number: #1, #3", done.stderr)

    def test_figures_of_the_report_hold(self):
        """Between a wavy sheet and a plate: border distance and angle as told, centres a radius from both."""
        waves = [[x, y, 0.15 * math.sin(1.1 * y) + 0.05 * x * x] for y in np.linspace(0, 6, 9) for x in np.linspace(0, 3, 5)]
        knots = lambda n: [0] * 4 + [k / (n - 3) for k in range(1, n - 3)] + [1] * 4
        sheet = patch("sheet", (3, 3), (knots(5), knots(9)), waves)
        wall = plate("wall", (0.6, -1, -2), (0.8, 7, -2), (0.3, -1, 4), (0.5, 7, 4))
        patches, said, _ = self.filleted([sheet, wall], "--faces", "sheet,wall", "--radius", 0.4, "--sides", "front,front", "--tolerance", 1e-5)
        blend = next(p for p in patches if p["name"].startswith("blend"))
        n = normal(wall, 0.5, 0.5)
        origin = np.array(wall["points"][0])
        for v in SHARES:
            off = abs((at_surface(blend, 1.0, v) - origin) @ n)
            self.assertLessEqual(off, 1e-5)
            self.assertGreaterEqual(abs(normal(blend, 1.0, v) @ n), 1 - 1e-6)
        self.assertRegex(said, r"on wall +up to [0-9.e-]+ mm off it")

    def test_refused(self):
        flat = corner(math.pi / 2)
        source = self.work / "in.json"
        source.write_text(json.dumps(model(*flat)))
        for options, code in ((("--faces", "floor,roof", "--radius", 1), 2), (("--faces", "floor", "--radius", 1), 2), (("--faces", "1,2"), 2),
                              (("--faces", "1,1", "--radius", 1), 2), (("--faces", "1,2", "--radius", -1), 2), (("--faces", "1,2", "--radius", 9), 3),
                              (("--faces", "1,2", "--radius", 1, "--sides", "up,down"), 2)):
            self.run_it("surface", "fillet", source, *options, "-o", self.work / "no.json", code=code)
        source.write_text(json.dumps(model(disc(5.0, 0.0), tube(0.3, 0.0, 4.0))))
        # inside a tube a ball fits that is smaller than it
        self.run_it("surface", "fillet", source, "--faces", "1,2", "--radius", 0.4, "--sides", "front,back", "-o", self.work / "no.json", code=4)
        told = self.run_it("surface", "fillet", source, "--faces", "1,2", "--radius", 0.1, "-o", self.work / "no.json", code=2)
        self.assertIn("--sides", told.stderr)
        self.assertFalse((self.work / "no.json").exists())

    def test_faces_that_keep_the_rounded_corner_are_named(self):
        end = plate("end", (0, 0, 0), (3, 0, 0), (0, 0, 3), (3, 0, 3))
        source = self.work / "open.json"
        for faces, named in ((corner(math.pi / 2), False), ([*corner(math.pi / 2), end], True)):
            source.write_text(json.dumps(model(*faces)))
            done = self.run_it("surface", "fillet", source, "--faces", "1,2", "--radius", 1, "-o", self.work / "closed.json")
            self.assertEqual("the blend ends at face end, which keeps the corner that it rounds" in done.stderr, named, done.stderr)

    def test_a_trough_that_bends_more_than_the_ball(self):
        """z = x^2 has the radius 1/2 at its bottom."""
        trough = patch("trough", (2, 1), ([0, 0, 0, 1, 1, 1], FLAT), [[x, y, z] for y in (0, 6) for x, z in ((-1, 1), (0, -1), (1, 1))])
        end = plate("end", (-1, 3, -1), (1, 3, -1), (-1, 3, 5), (1, 3, 5))  # its normal points along -y
        source = self.work / "in.json"
        source.write_text(json.dumps(model(trough, end)))
        told = self.run_it("surface", "fillet", source, "--faces", "1,2", "--radius", 0.6, "--sides", "front,front", "-o", self.work / "no.json", code=4)
        self.assertIn("a ball of radius 0.6 does not go on along trough, whose radius comes down to 0.6", told.stderr)
        patches, _, _ = self.filleted([trough, end], "--faces", "1,2", "--radius", 0.3, "--sides", "front,front")
        for u, v, p in self.blend_points(patches[-1]):
            self.assertGreaterEqual(p[2], p[0] ** 2 - 1e-6)

    def test_equal_cylinders_touch_each_other(self):
        """Their edge is two ellipses that cross where both have one tangent plane: balls of every radius stop there."""
        other = tube(1.0, -4.0, 4.0)
        other["name"], other["points"] = "lying", [[p[2], p[0], p[1]] for p in other["points"]]
        source = self.work / "in.json"
        source.write_text(json.dumps(model(tube(1.0, -4.0, 4.0), other)))
        for r in (0.1, 0.5):
            told = self.run_it("surface", "fillet", source, "--faces", "tube,lying", "--radius", r, "--sides", "front,front",
                               "-o", self.work / "no.json", code=4)
            self.assertIn("no radius goes on: cut the faces before that place", told.stderr)
            self.assertNotIn("another radius", told.stderr)

    def test_step_in_freecad_and_back(self):
        if shutil.which("freecadcmd") is None or not pathlib.Path(PLUGINS, "obvid-cad").exists():
            self.skipTest("FreeCAD or the helper for STEP is not there")
        r = 5.0
        cases = {"corner.step": (corner(math.pi / 2, length=40.0, width=30.0), (), 2 * 25 * 40 + math.pi / 2 * r * 40, 3),
                 "boss.step": ([disc(50.0, 0.0), tube(20.0, 0.0, 40.0)], ("--sides", "front,front"),
                               10000 - math.pi * 625 + 40 * math.pi * 35 + 2 * math.pi * (25 - 10 / math.pi) * math.pi / 2 * r, 5)}
        for name, (faces, options, *_) in cases.items():
            self.filleted(faces, "--faces", "1,2", "--radius", r, *options, also=(name,))
        script = self.work / "judge.py"
        script.write_text(trims_test.JUDGE)
        done = subprocess.run(["freecadcmd", str(script)], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
                              env={**os.environ, "HOME": str(self.work), "OBVID_JUDGE": json.dumps([str(self.work / n) for n in cases])})
        self.assertIn("JUDGE DONE", done.stdout, done.stderr)
        for line in done.stdout.splitlines():
            if not line.startswith("JUDGED "):
                continue
            path, valid, faces, area, _, _, tolerance, shells = json.loads(line[7:])
            _, _, truth, count = cases[pathlib.Path(path).name]
            self.assertTrue(valid, path)
            self.assertEqual(shells, 1, path)
            self.assertGreaterEqual(faces, 3, path)
            self.assertAlmostEqual(area / truth, 1.0, delta=1e-2, msg=path)
            self.assertLessEqual(tolerance, 1e-3, path)


for name in dir(trims_test.Trims):  # those are run by trims_test.py
    if name.startswith("test_") and name not in Fillets.__dict__:
        setattr(Fillets, name, None)

class Matches(Fillets):
    """Borders after `surface match`, by differences of own evaluations."""

    @staticmethod
    def bumpy(name, x0, tilt, rows, columns, degree):
        knots = lambda n, p: [0] * (p + 1) + [k / (n - p) for k in range(1, n - p)] + [1] * (p + 1)
        points = [[x0 + 2.0 * i / (columns - 1), 3.0 * j / (rows - 1), tilt * i + 0.1 * math.sin(1.7 * i + 2.3 * j)] for j in range(rows) for i in range(columns)]
        return patch(name, (degree, degree), (knots(columns, degree), knots(rows, degree)), points)

    def test_borders_tangents_and_curvatures(self):
        left, right = self.bumpy("left", 0.0, 0.2, 6, 5, 3), self.bumpy("right", 2.3, -0.1, 8, 6, 2)
        source, out = self.work / "in.json", self.work / "out.json"
        source.write_text(json.dumps(model(left, right)))
        for order in (0, 1, 2):
            done = self.run_it("surface", "match", source, "--border", "right:u0", "--to", "left:u1", "--join", f"G{order}", "-o", out)
            a, b = json.loads(out.read_text())["patches"]
            self.assertEqual(a["points"], left["points"])
            moved = max(np.linalg.norm(at_surface(b, u, v) - at_surface(right, u, v)) for u in SHARES for v in SHARES)
            self.assertLessEqual(moved, float(done.stdout.split("no point by more than ")[1].split()[0]))
            reach = float(done.stdout.split("up to ")[-1].split(" of the way")[0])
            for u in SHARES:
                for v in (0.1, 0.7):
                    if u >= reach:
                        self.assertLessEqual(np.linalg.norm(at_surface(b, u, v) - at_surface(right, u, v)), 1e-12)
            h, paces = 1e-4, []
            for v in SHARES:
                p = [at_surface(a, 1.0 - k * h, v) for k in range(4)]
                q = [at_surface(b, k * h, v) for k in range(4)]
                self.assertLessEqual(np.linalg.norm(p[0] - q[0]), 1e-12)
                # one-sided differences of second order, both away from the border
                da, db = (-3 * p[0] + 4 * p[1] - p[2]) / (2 * h), (-3 * q[0] + 4 * q[1] - q[2]) / (2 * h)
                paces.append(-(da @ db) / (da @ da))
                if order >= 1:
                    self.assertLessEqual(np.linalg.norm(db + paces[0] * da), 1e-4 * np.linalg.norm(db))
                if order == 2:
                    saa, sbb = (2 * p[0] - 5 * p[1] + 4 * p[2] - p[3]) / h ** 2, (2 * q[0] - 5 * q[1] + 4 * q[2] - q[3]) / h ** 2
                    n = np.cross(da, at_surface(a, 1.0, min(v + 1e-5, 1.0)) - at_surface(a, 1.0, max(v - 1e-5, 0.0)))
                    n /= np.linalg.norm(n)
                    self.assertAlmostEqual(sbb @ n, paces[0] ** 2 * (saa @ n), delta=2e-3 * (1 + abs(sbb @ n)))
            joint = json.loads(self.run_it("surface", "check", out, "--json").stdout)["joints"]
            self.assertEqual(len(joint), 1)
            self.assertGreaterEqual(joint[0]["order"] if isinstance(joint[0]["order"], int) else int(str(joint[0]["order"])[-1]), order)

    def test_sizes_and_turned_borders(self):
        for scale in (1e-6, 1e6):
            left, right = self.bumpy("left", 0.0, 0.2, 6, 5, 3), self.bumpy("right", 2.3, -0.1, 8, 6, 2)
            right["points"] = [p for row in range(7, -1, -1) for p in right["points"][6 * row:6 * row + 6]]  # v runs the other way
            for one in (left, right):
                one["points"] = [[scale * x for x in p] for p in one["points"]]
            source, out = self.work / "in.json", self.work / "out.json"
            source.write_text(json.dumps(model(left, right)))
            self.run_it("surface", "match", source, "--border", "2:u0", "--to", "1:u1", "--join", "G2", "-o", out, "-q")
            a, b = json.loads(out.read_text())["patches"]
            for v in SHARES:
                self.assertLessEqual(np.linalg.norm(at_surface(a, 1.0, v) - at_surface(b, 0.0, 1 - v)), 1e-12 * scale)

    def test_refused_matches(self):
        source = self.work / "in.json"
        source.write_text(json.dumps(model(self.bumpy("left", 0.0, 0.2, 6, 5, 3), self.bumpy("right", 2.3, -0.1, 8, 6, 2), tube(1.0, 0.0, 2.0))))
        for border, to, code in (("right:u2", "left:u1", 2), ("right", "left:u1", 2), ("right:u0", "right:u1", 2), ("right:u0", "tube:v0", 3),
                                 ("right:u0", "left:u0", 4), ("none:u0", "left:u1", 2)):
            self.run_it("surface", "match", source, "--border", border, "--to", to, "-o", self.work / "no.json", code=code)
        self.assertFalse((self.work / "no.json").exists())

    def test_a_match_moves_no_farther_than_it_may(self):
        """A plate beside another, 0.25 lower: its border moves up by as much, and nothing farther."""
        left = plate("left", (0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0))
        right = plate("right", (1, 0, -0.25), (2, 0, -0.25), (1, 1, -0.25), (2, 1, -0.25))
        source, out = self.work / "in.json", self.work / "out.json"
        source.write_text(json.dumps(model(left, right)))
        how = ("surface", "match", source, "--border", "right:u0", "--to", "left:u1", "--join", "G0", "-o", out)
        refused = self.run_it(*how, "--within", "0.2", code=5)
        self.assertIn("would move by up to 0.2500", refused.stderr)
        self.assertIn("0.05", refused.stderr)
        self.assertFalse(out.exists())
        self.run_it(*how, "--within", "0.2501")
        self.assertTrue(out.exists())
        self.run_it(*how, "--within", "0", code=2)


for name in dir(Fillets):
    if name.startswith("test_") and name not in Matches.__dict__:
        setattr(Matches, name, None)


if __name__ == "__main__":
    trims_test.PROGRAM, trims_test.PLUGINS = PROGRAM, PLUGINS = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
