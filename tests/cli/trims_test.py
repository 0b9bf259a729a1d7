#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Parts of surfaces by `surface trim` against closed forms: areas, trims on the cut, meshes, sections, files.

usage: trims_test.py PROGRAM PLUGINS

Evaluates stored surfaces and trims by its own recursion (de Boor, Cox); needs numpy. What FreeCAD says of
STEP files is asked where freecadcmd and the helper in the folder PLUGINS are there.
"""
import json
import math
import os
import pathlib
import re
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

try:
    import numpy as np
except ImportError:
    np = None

H = math.sqrt(0.5)
# a full turn by four rational quarters
CIRCLE = [(1, 0, 1), (1, 1, H), (0, 1, 1), (-1, 1, H), (-1, 0, 1), (-1, -1, H), (0, -1, 1), (1, -1, H), (1, 0, 1)]
TURN = [0, 0, 0, 0.25, 0.25, 0.5, 0.5, 0.75, 0.75, 1, 1, 1]
JUDGE = """
import json, os, Part
for path in json.loads(os.environ["OBVID_JUDGE"]):
    shape = Part.Shape()
    shape.read(path)
    heights = [q.z for e in shape.Edges if not e.Degenerated for q in e.discretize(40)]
    print("JUDGED", json.dumps([path, shape.isValid(), len(shape.Faces), shape.Area, min(heights), max(heights),
                                max(e.Tolerance for e in shape.Edges), len(shape.Shells)]))
print("JUDGE DONE")
"""


def patch(name, degrees, knots, points, weights=None):
    out = {"name": name, "degree_u": degrees[0], "degree_v": degrees[1], "knots_u": knots[0], "knots_v": knots[1],
           "points": points}
    if weights:
        out["weights"] = weights
    return out


def model(*patches):
    return {"format": "obvid-surface", "version": 1, "name": "part", "units": "mm", "units_source": "file", "patches": patches}


def plane(width, depth):
    flat = [0, 0, 1, 1]
    return patch("plane", (1, 1), (flat, flat), [[0, 0, 0], [width, 0, 0], [0, depth, 0], [width, depth, 0]])


def cylinder(r, height, middle=(0, 0)):
    points = [[middle[0] + r * x, middle[1] + r * y, z] for z in (0, height) for x, y, _ in CIRCLE]
    return patch("cylinder", (2, 1), (TURN, [0, 0, 1, 1]), points, [w for _ in range(2) for _, _, w in CIRCLE])


def sphere(r):
    profile = [(0, -1, 1), (1, -1, H), (1, 0, 1), (1, 1, H), (0, 1, 1)]
    points = [[r * a * x, r * a * y, r * z] for a, z, _ in profile for x, y, _ in CIRCLE]
    return patch("sphere", (2, 2), (TURN, [0, 0, 0, 0.5, 0.5, 1, 1, 1]), points, [w * q for _, _, w in profile for _, _, q in CIRCLE])


def basis(knots, degree, t):
    """All functions at t, by their definition (Cox, de Boor)."""
    n = len(knots) - degree - 1
    last = max(k for k in range(n) if knots[k] < knots[k + 1])
    value = [1.0 if knots[k] <= t < knots[k + 1] or (k == last and t >= knots[k + 1]) else 0.0 for k in range(len(knots) - 1)]
    for d in range(1, degree + 1):
        for k in range(len(knots) - d - 1):
            a, b = knots[k + d] - knots[k], knots[k + d + 1] - knots[k + 1]
            value[k] = ((t - knots[k]) / a * value[k] if a > 0 else 0.0) + ((knots[k + d + 1] - t) / b * value[k + 1] if b > 0 else 0.0)
    return np.array(value[:n])


def at_surface(told, u, v):
    u, v = min(max(u, told["knots_u"][0]), told["knots_u"][-1]), min(max(v, told["knots_v"][0]), told["knots_v"][-1])  # rounding
    p, w = np.array(told["points"], float), np.array(told.get("weights") or [1.0] * len(told["points"]))
    weigh = np.outer(basis(told["knots_v"], told["degree_v"], v), basis(told["knots_u"], told["degree_u"], u)).ravel() * w
    return weigh @ p / weigh.sum()


def along(curve, count):
    points, knots = np.array(curve["points"], float), curve["knots"]
    w = np.array(curve.get("weights") or [1.0] * len(points))
    for k in range(count):
        b = basis(knots, curve["degree"], knots[0] + (knots[-1] - knots[0]) * k / (count - 1)) * w
        yield b @ points / b.sum()


def stl_triangles(path):
    data = path.read_bytes()
    count = struct.unpack("<I", data[80:84])[0]
    rows = np.frombuffer(data, dtype=np.dtype([("n", "<3f4"), ("p", "<9f4"), ("a", "<u2")]), count=count, offset=84)
    return rows["p"].reshape(-1, 3, 3).astype(float)


class Trims(unittest.TestCase):
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

    def trimmed(self, told, *options, also=()):
        source, out = self.work / "in.json", self.work / "out.json"
        source.write_text(json.dumps(told))
        self.run_it("surface", "trim", source, *options, "-o", out, *(part for one in also for part in ("-o", self.work / one)), "-q")
        return json.loads(out.read_text()), out

    def area(self, path):
        patches = json.loads(self.run_it("surface", "check", path, "--samples", 33, "--json").stdout)["patches"]
        return sum(p["area"] for p in patches), patches

    def outlines(self, part, size):
        """Places of all trims in space; that they close is looked at on the way."""
        for one in part["patches"]:
            for loop in one.get("trims", []):
                for k, curve in enumerate(loop):
                    following = loop[(k + 1) % len(loop)]
                    gap = np.abs(np.array(curve["points"][-1]) - np.array(following["points"][0])).max()
                    self.assertLessEqual(gap, 1e-9)
                    yield [at_surface(one, *place) for place in along(curve, 41)]

    def test_offsets_keep_trims_and_areas_tell_theirs(self):
        r, h, out = 2.0, 0.7, self.work / "moved.json"
        cap, path = self.trimmed(model(sphere(r)), "--plane", f"0.6,0,0.8,{h}", "--keep", "above", "--tolerance", 1e-4)
        within = max(p["trims_within"] for p in cap["patches"])
        self.assertGreater(within, 0.0)
        self.assertLessEqual(within, 1e-4)
        area, patches = self.area(path)
        rim = 2 * math.pi * math.sqrt(r * r - h * h)
        told = sum(p["area_error"] for p in patches)
        self.assertGreaterEqual(told, 0.9 * within * rim)  # halves of a sphere share the rim
        self.assertLessEqual(told, 1.1 * within * rim + 1e-6)
        self.assertLessEqual(abs(area - 2 * math.pi * r * (r - h)), told)
        # outwards by 0.5, wherever that is: the cap of a larger or a smaller sphere
        self.run_it("surface", "offset", path, "--distance", 0.5, "-o", out, "-q")
        moved, _ = self.area(out)
        wanted = [2 * math.pi * r * (r - h) * (s / r) ** 2 for s in (1.5, 2.5)]
        self.assertLess(min(abs(moved / w - 1) for w in wanted), 1e-4)

    def test_distances_are_from_what_is_there(self):
        part, path = self.trimmed(model(plane(4, 3)), "--plane", "x=1", "--keep", "above")
        points = self.work / "points.csv"
        points.write_text("x,y,z\n0,1,0\n0.25,2,0\n3,1,0.125\n")
        report = json.loads(self.run_it("surface", "check", path, "--against", points, "--json").stdout)
        found = report["deviation"]["found"]
        self.assertAlmostEqual(found["largest"], 1.0, delta=1e-6)

    def test_sphere_above_a_plane(self):
        for r, h in ((2.0, 0.7), (1e-9, 3e-10), (1e9, -4e8)):
            with self.subTest(r=r):
                part, path = self.trimmed(model(sphere(r)), "--plane", f"z={h!r}", "--keep", "above", "--tolerance", repr(1e-8 * r))
                area, _ = self.area(path)
                self.assertAlmostEqual(area / (2 * math.pi * r * (r - h)), 1.0, delta=2e-8)
                places = [p for line in self.outlines(part, r) for p in line]
                self.assertGreaterEqual(min(p[2] for p in places), h - 2e-8 * r)
                self.assertGreater(sum(abs(p[2] - h) < 2e-8 * r for p in places), 40)

    def test_sphere_through_its_poles(self):
        r = 3.0
        _, path = self.trimmed(model(sphere(r)), "--plane", "1,0.3,0,0", "--keep", "below")
        self.assertAlmostEqual(self.area(path)[0], 2 * math.pi * r * r, delta=1e-5 * r * r)

    def test_cylinder_below_an_oblique_plane(self):
        r, a, b = 2.0, 3.0, 0.6  # z = a + b x
        part, path = self.trimmed(model(cylinder(r, 10.0)), "--plane", f"{-b},0,1,{a}", "--keep", "below")
        self.assertAlmostEqual(self.area(path)[0], 2 * math.pi * r * a, delta=1e-5)
        off = [p[2] - a - b * p[0] for line in self.outlines(part, 10.0) for p in line]
        self.assertLessEqual(max(off), 1.3e-5)  # 1e-6 of the size

    def test_half_of_what_lies_on_both_sides_is_told(self):
        r = 2.256
        source = self.work / "in.json"
        for shift, reach in ((0.0, r), (0.75 * r, 0.25 * r), (-0.75 * r, 0.25 * r)):
            told = sphere(r)
            told["points"] = [[x, y + shift, z] for x, y, z in told["points"]]
            source.write_text(json.dumps(model(told)))
            said = self.run_it("surface", "cut", source, "--draught", "0.7", "--half").stderr
            self.assertIn("beyond y = 0", said)
            self.assertAlmostEqual(float(re.search(r"reaches (\S+) mm", said)[1]), reach, delta=0.01 * r)
            self.assertNotIn("beyond y = 0", self.run_it("surface", "cut", source, "--draught", "0.7").stderr)
        # beside the plane, by no more than the tolerance over it
        for over, tolerance, told_of in ((0.0, (), False), (1e-3, (), True), (1e-3, ("--tolerance", "0.01"), False)):
            told = sphere(r)
            told["points"] = [[x, y + r - over, z] for x, y, z in told["points"]]
            source.write_text(json.dumps(model(told)))
            said = self.run_it("surface", "cut", source, "--draught", "0.7", "--half", *tolerance).stderr
            self.assertEqual("beyond y = 0" in said, told_of, said)

    def test_two_planes_cut_twice(self):
        source = self.work / "in.json"
        source.write_text(json.dumps(model(plane(4.0, 3.0))))
        for planes, rows in ((("x=1",), ["left "]), (("x=1", "1,1,0,3"), ["left by the plane 1 ", "left by the plane 2 "])):
            said = self.run_it("surface", "trim", source, *(part for one in planes for part in ("--plane", one)), "--keep", "above",
                               "-o", self.work / "out.json").stdout
            found = [line for line in said.splitlines() if line.startswith("left")]
            self.assertEqual(len(found), len(rows), said)
            for line, row in zip(found, rows):
                self.assertTrue(line.startswith(row), line)
        _, path = self.trimmed(model(plane(4.0, 3.0)), "--plane", "x=1", "--plane", "1,1,0,3", "--keep", "above")
        # right of x = 1 and above x + y = 3: the rest of 3 x 3 without a triangle of 2 x 2
        self.assertAlmostEqual(self.area(path)[0], 9.0 - 2.0, delta=1e-9)

    def test_inside_and_outside_a_circle(self):
        drawing = self.work / "circle.dxf"
        drawing.write_text("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n2.0\n20\n1.5\n40\n1.2\n0\nENDSEC\n0\nEOF\n")
        disc = math.pi * 1.44
        for keep, truth in (("inside", disc), ("outside", 12.0 - disc)):
            part, path = self.trimmed(model(plane(4.0, 3.0)), "--contour", drawing, "--keep", keep, also=("out.stl", "out.svg"))
            self.assertAlmostEqual(self.area(path)[0], truth, delta=1e-4)
            ring = [abs(math.hypot(p[0] - 2.0, p[1] - 1.5) - 1.2) for line in self.outlines(part, 5.0) for p in line]
            self.assertLessEqual(sorted(ring)[40], 5e-6)
            triangles = stl_triangles(self.work / "out.stl")
            crossed = np.cross(triangles[:, 1] - triangles[:, 0], triangles[:, 2] - triangles[:, 0])
            self.assertAlmostEqual(0.5 * np.linalg.norm(crossed, axis=1).sum(), truth, delta=0.05)
            self.assertTrue((crossed[:, 2] > -1e-6).all())
        # what is there is cut inside of its trims: a line through the middle, without the diameter
        sections = json.loads(self.run_it("surface", "cut", path, "--plane", "0,1,0,1.5", "--json").stdout)["sections"]
        self.assertEqual(len(sections[0]["branches"]), 2)
        points = self.work / "sections.json"
        self.run_it("surface", "cut", path, "--plane", "0,1,0,1.5", "-o", points, "-q")
        branches = json.loads(points.read_text())["sections"][0]["branches"]
        ends = sorted(p[0] for b in branches for p in (b["points"][0], b["points"][-1]))
        for found, truth in zip(ends, (0.0, 0.8, 3.2, 4.0)):
            self.assertAlmostEqual(found, truth, delta=5e-6)

    def test_a_square_hole_through_a_cylinder(self):
        """Corners of the contour are corners of the trims; both walls get a hole."""
        r, half = 2.0, 0.5
        hole = self.work / "hole.dxf"
        corners = [(-half, 2.0), (half, 2.0), (half, 3.0), (-half, 3.0)]
        vertices = "".join(f"10\n{x}\n20\n{y}\n" for x, y in corners)
        hole.write_text(f"0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nLWPOLYLINE\n8\n0\n90\n4\n70\n1\n{vertices}0\nENDSEC\n0\nEOF\n")
        _, path = self.trimmed(model(cylinder(r, 10.0)), "--contour", hole, "--along", "y", "--keep", "outside")
        truth = 2 * math.pi * r * 10.0 - 2 * (2 * r * math.asin(half / r)) * 1.0
        self.assertAlmostEqual(self.area(path)[0], truth, delta=1e-4)

    def test_refused(self):
        source = self.work / "in.json"
        source.write_text(json.dumps(model(plane(4.0, 3.0))))
        for options, code in ((("--plane", "x=1"), 2), (("--plane", "x=1", "--keep", "inside"), 2), (("--keep", "above"), 2),
                              (("--plane", "x=9", "--keep", "above"), 3), (("--plane", "q=1", "--keep", "above"), 2)):
            self.run_it("surface", "trim", source, *options, "-o", self.work / "no.json", code=code)
        self.assertFalse((self.work / "no.json").exists())

    def test_step_in_freecad_and_back(self):
        if shutil.which("freecadcmd") is None or not pathlib.Path(PLUGINS, "obvid-cad").exists():
            self.skipTest("FreeCAD or the helper for STEP is not there")
        r, h = 20.0, 7.0
        drawing = self.work / "circle.dxf"
        drawing.write_text("0\nSECTION\n2\nHEADER\n9\n$INSUNITS\n70\n4\n0\nENDSEC\n0\nSECTION\n2\nENTITIES\n0\nCIRCLE\n8\n0\n10\n20\n20\n15\n40\n12\n0\nENDSEC\n0\nEOF\n")
        cases = {"cap.step": (model(sphere(r)), ("--plane", f"z={h}", "--keep", "above"), 2 * math.pi * r * (r - h), 2, (h, r)),
                 "half.step": (model(sphere(r)), ("--plane", "1,0.3,0,0", "--keep", "below"), 2 * math.pi * r * r, 2, (-r, r)),
                 "tube.step": (model(cylinder(r, 100.0)), ("--plane", "-0.6,0,1,50", "--keep", "below"), 2 * math.pi * r * 50.0, 2, (0, 62)),
                 "ring.step": (model(plane(40, 30)), ("--contour", drawing, "--keep", "outside"), 1200 - 144 * math.pi, 1, (0, 0))}
        for name, (told, options, *_) in cases.items():
            self.trimmed(told, *options, also=(name,))
        script = self.work / "judge.py"
        script.write_text(JUDGE)
        done = subprocess.run(["freecadcmd", str(script)], capture_output=True, text=True, stdin=subprocess.DEVNULL, check=False,
                              env={**os.environ, "HOME": str(self.work), "OBVID_JUDGE": json.dumps([str(self.work / n) for n in cases])})
        self.assertIn("JUDGE DONE", done.stdout, done.stderr)
        for line in done.stdout.splitlines():
            if not line.startswith("JUDGED "):
                continue
            path, valid, faces, area, low, high, tolerance, shells = json.loads(line[7:])
            _, _, truth, count, heights = cases[pathlib.Path(path).name]
            self.assertTrue(valid, path)
            self.assertEqual((faces, shells), (count, 1 if count > 1 else shells), path)
            self.assertAlmostEqual(area / truth, 1.0, delta=1e-2, msg=path)  # FreeCAD's areas of rational faces are coarse
            self.assertLessEqual(tolerance, 1e-3, path)
            self.assertAlmostEqual(low, heights[0], delta=1e-4)
            self.assertAlmostEqual(high, heights[1], delta=1e-4)
        for name, (_, _, truth, _, _) in cases.items():
            self.assertAlmostEqual(self.area(self.work / name)[0] / truth, 1.0, delta=1e-5, msg=name)


if __name__ == "__main__":
    PROGRAM, PLUGINS = sys.argv[1:3]
    unittest.main(argv=sys.argv[:1] + sys.argv[3:])
