#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What floats of bodies with trimmed faces (`surface cut --draught`), against closed forms.

usage: afloat_test.py PROGRAM PLUGINS DATA

Bodies are STEP files made by FreeCAD, and parts of stored surfaces made by `surface trim`. Sections at heights z are discs,
segments, rings and strips of closed form; volumes and moments are their integrals over z by Gauss's rule. Needs numpy.
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

sys.dont_write_bytecode = True
try:
    import numpy as np
except ImportError:
    np = None

MAKE = """
import os, Part
from FreeCAD import Vector as V, Rotation, Placement
folder = os.environ["OBVID_BODIES"]
def put(shape, name):
    shape.exportStep(os.path.join(folder, name + ".step"))
    print("MADE", name, shape.isValid())
plate = Part.makeBox(10, 8, 2, V(0, 0, -1))
for x, y, r in ((2, 2, 1), (7, 5, 1.5), (4, 6, 0.75)):
    plate = plate.cut(Part.makeCylinder(r, 4, V(x, y, -2)))
put(plate, "plate")
put(Part.makeSphere(3), "sphere")
put(Part.makeSphere(3).cut(Part.makeBox(10, 10, 10, V(-5, -5, 1))), "cap")
put(Part.makeSphere(3).cut(Part.makeBox(10, 10, 10, V(-5, 1.2, -5))), "sidecap")
put(Part.makeCylinder(2, 6, V(0, 0, -3)).cut(Part.makeCylinder(0.7, 10, V(0, -5, 0), V(0, 1, 0))), "drilled")
put(Part.makeCylinder(2, 6, V(0, -3, 0), V(0, 1, 0)), "lying")
put(Part.makeCone(3, 1, 5, V(0, 0, -2)).cut(Part.makeCylinder(0.5, 10, V(0, 0, -5))), "frustum")
put(Part.makeCone(3, 0, 5, V(0, 0, -2)), "cone")
put(Part.makeTorus(5, 1.5).cut(Part.makeBox(20, 20, 20, V(0, -10, -10))), "halftorus")
box = Part.makeBox(4, 3, 2).cut(Part.makeCylinder(0.6, 5, V(2, 1.5, -1)))
box.Placement = Placement(V(0.3, 0.2, -1), Rotation(V(1, 0, 0), 90))
put(box, "boxonside")
arc = Part.makeBox(4, 3, 2, V(0, 0, -1)).fuse(Part.makeCylinder(1.5, 2, V(4, 1.5, -1))).removeSplitter()
put(arc, "rounded_end")
print("MADE all")
"""


def gauss(f, a, b, parts=1):
    """Integral of f; sines take the roots at both ends out of it."""
    x, w = np.polynomial.legendre.leggauss(60)
    total = 0.0
    for k in range(parts):
        low, high = a + (b - a) * k / parts, a + (b - a) * (k + 1) / parts
        middle, half = 0.5 * (low + high), 0.5 * (high - low)
        angle = 0.5 * math.pi * x
        total += sum(wi * 0.5 * math.pi * math.cos(t) * half * f(middle + half * math.sin(t)) for wi, t in zip(w, angle))
    return total


def segment(r, d):
    """Area of the part of a disc with x < d."""
    d = min(max(d, -r), r)
    return r * r * math.acos(-d / r) + d * math.sqrt(r * r - d * d)


def root(x):
    return math.sqrt(max(x, 0.0))


class Truth:
    """Of sections: their area, and what is wet, by the height of the water."""

    def __init__(self, low, high, area, wetted, kinks=(), moment=None, name="centre_x"):
        self.low, self.high, self.area, self.wetted, self.kinks, self.moment, self.name = low, high, area, wetted, kinks, moment, name

    def at(self, water):
        top = min(water, self.high)
        places = sorted({self.low, top, *(z for z in self.kinks if self.low < z < top)})
        over = lambda f: sum(gauss(f, a, b) for a, b in zip(places, places[1:]))
        volume = over(self.area)
        out = {"volume": volume, "centre_z": over(lambda z: z * self.area(z)) / volume, "wetted_area": self.wetted(top, water > self.high),
               "waterplane_area": self.area(water) if water < self.high else 0.0}
        if self.moment:
            out[self.name] = over(self.moment) / volume
        return out


def truths():
    holes = ((2, 2, 1), (7, 5, 1.5), (4, 6, 0.75))
    flat = 80 - math.pi * sum(r * r for _, _, r in holes)
    around = 36 + 2 * math.pi * sum(r for _, _, r in holes)
    first = 80 * 5 - math.pi * sum(r * r * x for x, _, r in holes)
    out = {"plate": Truth(-1, 1, lambda z: flat, lambda t, under: flat + around * (t + 1) + (flat if under else 0),
                          moment=lambda z: first)}
    zone = lambda z: math.pi * (9 - z * z)
    out["sphere"] = Truth(-3, 3, zone, lambda t, under: 6 * math.pi * (t + 3))
    out["cap"] = Truth(-3, 1, zone, lambda t, under: 6 * math.pi * (t + 3) + (8 * math.pi if under else 0))
    # y < 1.2: at a height a segment; on the sphere the zone's element is r dphi dz
    side = root(9 - 1.44)

    def sidecap(t, under):
        def arc(z):
            rho = root(9 - z * z)
            return 2 * math.pi * 3 if rho <= 1.2 else 3 * 2 * (math.pi - math.acos(1.2 / rho))
        places = [z for z in (-3, -side, side) if z < t] + [t]
        return sum(gauss(arc, a, b, 8) for a, b in zip(places, places[1:])) + segment(side, t)
    moment = lambda z: -2 / 3 * root(9 - z * z - 1.44) ** 3
    out["sidecap"] = Truth(-3, 3, lambda z: segment(root(9 - z * z), 1.2) if abs(z) < 3 else 0.0, sidecap, (-side, side), moment, "centre_y")

    def strip(z):
        w = root(0.49 - z * z)
        return 4 * math.pi - 2 * (w * root(4 - w * w) + 4 * math.asin(w / 2))

    def drilled(t, under):
        lost = lambda z: 8 * math.asin(root(0.49 - z * z) / 2)
        wall = 2 * math.pi * 2 * (t + 3) - (gauss(lost, -0.7, min(t, 0.7), 8) if t > -0.7 else 0)
        # around the hole from its lowest place on both sides up to the water, as long as the body is there
        up = math.acos(-max(min(t / 0.7, 1), -1))
        inner = 2 * gauss(lambda a: 0.7 * 2 * root(4 - (0.7 * math.sin(a)) ** 2), 0, up, 4) if t > -0.7 else 0
        return 4 * math.pi * (2 if under else 1) + wall + inner
    out["drilled"] = Truth(-3, 3, strip, drilled, (-0.7, 0.7))
    out["lying"] = Truth(-2, 2, lambda z: 12 * root(4 - z * z),
                         lambda t, under: 2 * segment(2, t) + 6 * 2 * (2 * math.acos(-max(min(t / 2, 1), -1))))
    cone = lambda low, slope: lambda z: low - slope * (z + 2)
    r = cone(3, 0.4)
    slant = lambda a, b, z: math.pi * (a + b) * math.hypot(z + 2, a - b)
    out["frustum"] = Truth(-2, 3, lambda z: math.pi * (r(z) ** 2 - 0.25),
                           lambda t, under: math.pi * 8.75 + slant(3, r(t), t) + math.pi * (t + 2) + (math.pi * 0.75 if under else 0))
    p = cone(3, 0.6)
    out["cone"] = Truth(-2, 3, lambda z: math.pi * p(z) ** 2, lambda t, under: 9 * math.pi + slant(3, p(t), t))
    ring = lambda z: root(2.25 - z * z)

    def halftorus(t, under):
        a = math.asin(max(min(t / 1.5, 1), -1))
        # angles of the tube below the water: outside from -pi/2 to a, inside likewise; (R + r cos) r dtheta over pi
        tube = math.pi * 1.5 * (2 * 5 * (a + math.pi / 2))
        return tube + 2 * segment(1.5, t)
    out["halftorus"] = Truth(-1.5, 1.5, lambda z: math.pi / 2 * ((5 + ring(z)) ** 2 - (5 - ring(z)) ** 2), halftorus)
    # 4 x 3 along x and z, thick along -y, bored through; z from -1 to 2
    half = lambda z: root(0.36 - (z - 0.5) ** 2)

    def on_side(t, under):
        bored = segment(0.6, t - 0.5)
        wall = 2 * 0.6 * 2 * math.acos(-max(min((t - 0.5) / 0.6, 1), -1))
        return 8 + (8 if under else 0) + 4 * (t + 1) + 2 * (4 * (t + 1) - bored) + wall
    out["boxonside"] = Truth(-1, 2, lambda z: 2 * (4 - 2 * half(z)), on_side, (-0.1, 1.1))
    flat_end = 12 + math.pi * 2.25 / 2
    out["rounded_end"] = Truth(-1, 1, lambda z: flat_end,
                               lambda t, under: flat_end * (2 if under else 1) + (4 * 2 + 3 + 1.5 * math.pi) * (t + 1),
                               moment=lambda z: 24 + math.pi * 2.25 / 2 * 4 + 2 / 3 * 1.5 ** 3)
    return out


class Afloat(unittest.TestCase):
    def setUp(self):
        if np is None:
            self.skipTest("numpy is not there")
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.work = pathlib.Path(self.folder.name)

    def run_it(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, check=False,
                              env={**os.environ, "OBVID_PLUGINS": PLUGINS})
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def afloat(self, path, water, *options):
        done = self.run_it("surface", "cut", path, "--draught", repr(water), "--json", *options)
        return json.loads(done.stdout), done.stderr

    def judge(self, found, truth, size, what, exact=1e-9):
        """Within 1e-9 of the size to its power, and within what is said beside each figure."""
        power = {"volume": 3, "wetted_area": 2, "waterplane_area": 2, "centre_z": 1, "centre_x": 1, "centre_y": 1}
        for name, expected in truth.items():
            told = found["hydrostatics"][name]
            off = abs(told["value"] - expected)
            self.assertLessEqual(off, exact * size ** power[name], (what, name, told, expected))
            self.assertLessEqual(off, told["error"] + 1e-12 * size ** power[name], (what, name, told, expected))

    made = None

    @classmethod
    def tearDownClass(cls):
        if cls.made:
            cls.made.cleanup()

    def bodies(self):
        freecad = shutil.which("freecadcmd")
        if not freecad or not (pathlib.Path(PLUGINS) / "obvid-cad").exists():
            self.skipTest("freecadcmd or the helper is not there")
        if not Afloat.made:
            Afloat.made = tempfile.TemporaryDirectory()
            script = pathlib.Path(Afloat.made.name) / "make.py"
            script.write_text(MAKE)
            done = subprocess.run([freecad, str(script)], capture_output=True, text=True, check=False,
                                  env={**os.environ, "OBVID_BODIES": Afloat.made.name, "HOME": Afloat.made.name})
            self.assertIn("MADE all", done.stdout, done.stdout[-2000:])
        return pathlib.Path(Afloat.made.name)

    def test_bodies_of_another_system(self):
        bodies = self.bodies()
        for name, truth in truths().items():
            path = bodies / (name + ".step")
            for water in (0.61, 0.4, -0.85, truth.high + 0.5):
                found, said = self.afloat(path, water)
                for word in ("whole box", "open below", "cannot be turned", "parts"):
                    self.assertNotIn(word, said, name)
                self.assertEqual(found["hydrostatics"]["parts"], 1, name)
                self.judge(found, truth.at(water), found["size"], (name, water))

    def test_faces_of_public_files_are_measured_inside_their_trims(self):
        # areas: contour integrals of x dy, and of r^2 sin(latitude) d(longitude), over the files' own curves in parameters as
        # FreeCAD 0.20 evaluates them, by Chebyshev series and Gauss's rule
        folder = pathlib.Path(DATA) / "cad_iges_step"
        if not DATA or not folder.is_dir() or not (pathlib.Path(PLUGINS) / "obvid-cad").exists():
            self.skipTest("public data or the helper are not there")
        # the last one's edges stop 4e-6 short of each other: a strip of 3.1e-5
        for name, face, area, near in (("stepcode_HEAD_BACK.stp", 3, 34450.17753005, 1e-5), ("occt_face2.brep", 1, 26273.52643357, 1e-5),
                                       ("stepcode_TAIL_TURBINE.stp", 16, 22.43740873, 4e-5)):
            done = self.run_it("surface", "check", folder / name, "--samples", 9, "--json")
            self.assertNotIn("whole box", done.stderr, name)
            self.assertAlmostEqual(json.loads(done.stdout)["patches"][face - 1]["area"], area, delta=near, msg=name)

    def test_faces_in_a_plane_and_trims_that_it_touches(self):
        bodies = self.bodies()
        # (body, plane): branches, all closed; a rectangle with three holes, ends of tubes, a plane along the seam of a wall
        for name, plane, count in (("plate", "0,0,1,-1", 4), ("plate", "0,0,1,1", 4), ("plate", "0,0,1,0", 4), ("plate", "1,0,0,0", 1),
                                   ("lying", "0,1,0,-3", 1), ("lying", "0,1,0,3", 1), ("lying", "0,0,1,2", 0), ("lying", "1,0,0,2", 0),
                                   ("frustum", "0,0,1,-2", 2), ("frustum", "0,0,1,3", 2), ("rounded_end", "0,0,1,1", 1), ("cap", "0,0,1,1", 1)):
            done = self.run_it("surface", "cut", bodies / (name + ".step"), "--plane", plane, "--json")
            branches = json.loads(done.stdout)["sections"][0]["branches"]
            self.assertEqual([b["closed"] for b in branches], [True] * count, (name, plane))

    def test_faces_that_a_file_turns_differently(self):
        bodies = self.bodies()
        self.run_it("surface", "convert", bodies / "drilled.step", "-o", self.work / "drilled.json", "-q")
        told = json.loads((self.work / "drilled.json").read_text())
        for one in told["patches"][1::2]:  # v backwards: points, weights, knots; trims with it
            low, high = one["knots_v"][0], one["knots_v"][-1]
            nu = len(one["knots_u"]) - one["degree_u"] - 1
            rows = [one["points"][k:k + nu] for k in range(0, len(one["points"]), nu)]
            one["points"] = [p for row in reversed(rows) for p in row]
            if one.get("weights"):
                rows = [one["weights"][k:k + nu] for k in range(0, len(one["weights"]), nu)]
                one["weights"] = [p for row in reversed(rows) for p in row]
            one["knots_v"] = [low + high - t for t in reversed(one["knots_v"])]
            for loop in one.get("trims", []):
                for curve in loop:
                    curve["points"] = [[u, low + high - v] for u, v in curve["points"]]
        turned = self.work / "turned.json"
        turned.write_text(json.dumps(told))
        found, said = self.afloat(turned, 0.4)
        self.assertNotIn("cannot be turned", said)
        self.judge(found, truths()["drilled"].at(0.4), found["size"], "turned")

    def test_parts_of_stored_surfaces(self):
        from trims_test import cylinder, model, sphere
        source, bowl = self.work / "in.json", self.work / "bowl.json"
        for scale in (1e-6, 1.0, 1e6):
            source.write_text(json.dumps(model(sphere(3 * scale))))
            self.run_it("surface", "trim", source, "--plane", f"z={scale!r}", "--keep", "below", "-o", bowl, "-q")
            for water in (0.4, -1.0, 1.0):
                found, said = self.afloat(bowl, water * scale)
                self.assertNotIn("open below", said)
                h = 3 + water
                truth = {"volume": math.pi * h * h * (9 - h) / 3 * scale ** 3, "wetted_area": 6 * math.pi * h * scale ** 2,
                         "waterplane_area": math.pi * (9 - water ** 2) * scale ** 2,
                         "centre_z": -3 * (6 - h) ** 2 / (4 * (9 - h)) * scale}
                # water along the trim: as near as the trim is to its plane
                self.judge(found, truth, found["size"], (scale, water), 1e-9 if water < 1 else 1e-6)
        # deeper than the trim: an opening, which is told
        found, said = self.afloat(bowl, 1.5e6)
        self.assertIn("open below", said)
        # a tube cut aslant: z < 1 + 0.5 x, from z = -2; under water at 0.2 there is no trim, at 1 one
        source.write_text(json.dumps(model(cylinder(1.5, 4))))
        tube = self.work / "tube.json"
        n = math.hypot(0.5, 1)
        self.run_it("surface", "trim", source, "--plane", f"{-0.5 / n!r},0,{1 / n!r},{2 / n!r}", "--keep", "below", "-o", tube, "-q")
        found, _ = self.afloat(tube, 1.0)
        self.judge(found, {"wetted_area": 3 * math.pi}, found["size"], "tube")
        found, _ = self.afloat(tube, 3.5)  # all of it: 2 pi r times the mean height
        self.judge(found, {"wetted_area": 6 * math.pi}, found["size"], "tube, under water")

    def test_half_of_a_hull_with_a_trimmed_deck(self):
        length, breadth, draught = 10.0, 1.0, 0.625
        along, up = ((-1, 0), (0, 2), (1, 0)), ((-1, 0), (-0.5, 1), (0, 1))
        hull = {"name": "hull", "degree_u": 2, "degree_v": 2, "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
                "points": [[length / 2 * x, breadth / 2 * a * b, draught * z] for z, b in up for x, a in along]}
        from trims_test import model
        source, cut = self.work / "hull.json", self.work / "cut.json"
        source.write_text(json.dumps(model(hull)))
        whole, _ = self.afloat(source, -0.25, "--half")
        self.run_it("surface", "trim", source, "--plane", "z=-0.1", "--keep", "below", "-o", cut, "-q")
        w = 0.25 / draught
        truth = {"volume": 2 / 3 * length * breadth * draught * (2 / 3 - w + w ** 3 / 3),
                 "waterplane_area": 2 / 3 * length * breadth * (1 - w * w), "centre_x": 0.0,
                 "wetted_area": whole["hydrostatics"]["wetted_area"]["value"]}
        for path in (source, cut):
            found, said = self.afloat(path, -0.25, "--half")
            self.assertNotIn("open below", said)
            self.judge(found, truth, found["size"], path.name)


if __name__ == "__main__":
    PROGRAM, PLUGINS, DATA = sys.argv[1:4]
    sys.path.insert(0, str(pathlib.Path(__file__).parent))
    unittest.main(argv=sys.argv[:1])
