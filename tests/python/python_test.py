#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The Python package against the program and against figures computed here.

usage: python_test.py PACKAGE_FOLDER LIBRARY PROGRAM SOURCE_FOLDER [unittest options]
"""
import ast
import copy
import doctest
import glob
import json
import os
import pathlib
import pickle
import re
import shutil
import signal
import subprocess
import sys
import tempfile
import threading
import time
import unittest
import warnings
import zipfile

PACKAGE, LIBRARY, PROGRAM, SOURCES = sys.argv[1:5]
os.environ["OBVID_LIBRARY"] = LIBRARY
os.environ["MPLBACKEND"] = "Agg"
SOURCES = os.path.abspath(SOURCES)
sys.path.insert(0, PACKAGE)
sys.dont_write_bytecode = True

import numpy as np  # noqa: E402

import obvid  # noqa: E402
import obvid.contour  # noqa: E402
import obvid.jobs  # noqa: E402
import obvid.space  # noqa: E402
import obvid.splines  # noqa: E402

SERIES = os.path.join(SOURCES, "examples/series10.csv")
SECONDS = re.compile(r'"seconds": [0-9.e+-]+')
POINTS = np.loadtxt(SERIES, delimiter=",", skiprows=1)


def program(*arguments):
    done = subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120)
    return done.stdout, done.returncode


def spiral(n, growth=0.1, step=0.3):
    """Points of a logarithmic spiral: curvature is monotone."""
    t = step * np.arange(n)
    r = np.exp(growth * t)
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


HOSTILE = ("plain", "nan", "equal", "float32", "transposed", "overflowing", "rounded", "on a line", "strided",
           "read-only", "backwards", "big-endian", "integers", "masked", "objects", "complex", "booleans", "empty",
           "one", "three columns", "flat", "deep", "text", "broadcast", "records", "huge", "tiny steps",
           "half")  # fmt: skip


def hostile(rng, trial, huge):
    """An array that is no series of points, or one that is laid out in an odd way."""
    kind = HOSTILE[trial % len(HOSTILE)]
    n = int(rng.integers(1, 10))
    points = rng.normal(size=(n, 2)) * 10.0 ** rng.integers(-12, 13)
    if kind == "nan":
        points[rng.integers(n), rng.integers(2)] = rng.choice([np.nan, np.inf, -np.inf])
    elif kind == "equal":
        points[-1] = points[max(n - 2, 0)]
    elif kind == "rounded":
        points = np.round(points)
    elif kind == "on a line":
        points[:, 1] = 0.0
    elif kind == "strided":
        wide = np.full((3 * n, 7), np.nan)
        wide[::3, 1:6:4] = points
        points = wide[::3, 1:6:4]
    elif kind == "read-only":
        points.flags.writeable = False
    elif kind == "masked":
        points = np.ma.masked_array(points, mask=rng.random((n, 2)) < 0.1)
    elif kind == "objects":
        points = points.astype(object)
        points[0, 0] = rng.choice(np.array([None, "x", 1e400, 2, 10**400], dtype=object))
    elif kind == "broadcast":
        points = np.broadcast_to(points[0], (n, 2))
    elif kind == "records":
        points = np.zeros(n, dtype=[("x", float), ("y", float)])
    elif kind == "huge":
        points = huge[: int(rng.integers(1, len(huge)))] if trial % (40 * len(HOSTILE)) == HOSTILE.index(kind) else huge[:50]
    elif kind == "tiny steps":
        points = 1.0 + np.arange(2.0 * n).reshape(n, 2) * 2.0**-52
    with np.errstate(all="ignore"), warnings.catch_warnings():
        warnings.simplefilter("ignore")
        odd = {
            "float32": lambda p: p.astype(np.float32), "half": lambda p: p.astype(np.float16),
            "transposed": lambda p: p.T, "overflowing": lambda p: p * 1e300, "backwards": lambda p: p[::-1, ::-1],
            "big-endian": lambda p: p.astype(">f8"), "integers": lambda p: p.astype(np.int32),
            "complex": lambda p: p + 1j, "booleans": lambda p: p > 0, "empty": lambda p: p[:0],
            "one": lambda p: p[:1], "three columns": lambda p: np.column_stack([p, p[:, 0]]),
            "flat": np.ravel, "deep": lambda p: p[None], "text": lambda p: p.astype(str),
        }  # fmt: skip
        return odd.get(kind, lambda p: p)(points)


def run_cell(source, names):
    """What a notebook shows of a cell: its last expression, as text and as a picture."""
    tree = ast.parse(source)
    last = tree.body.pop() if isinstance(tree.body[-1], ast.Expr) else None
    exec(compile(tree, "cell", "exec"), names)
    if last is None:
        return {}
    value = eval(compile(ast.Expression(last.value), "cell", "eval"), names)
    shown = {"text/plain": repr(value)}
    if hasattr(value, "_repr_svg_"):
        shown["image/svg+xml"] = value._repr_svg_()
    return shown


class AgainstTheProgram(unittest.TestCase):
    def test_a_contour_file_has_the_same_bytes(self):
        with tempfile.TemporaryDirectory() as folder:
            for carrier in ("spiral", "arcs", "conics", "clothoids", "bspline"):
                path = os.path.join(folder, "c.json")
                program("fit", SERIES, "--carrier", carrier, "-o", path)
                ours = obvid.fit(obvid.read(SERIES), carrier=carrier).text("json")
                theirs = pathlib.Path(path).read_text()
                self.assertEqual(SECONDS.sub("", ours), SECONDS.sub("", theirs), carrier)

    def test_every_format_has_the_same_bytes(self):
        contour = obvid.fit(obvid.read(SERIES))
        with tempfile.TemporaryDirectory() as folder:
            for ending in ("svg", "dxf", "step", "igs", "nc", "csv", "sldcrv", "geojson"):
                theirs = os.path.join(folder, "theirs." + ending)
                _, code = program("fit", SERIES, "-o", theirs)
                ours = os.path.join(folder, "ours." + ending)
                if code == 2:
                    with self.assertRaises(obvid.UsageError):
                        contour.write(ours)
                    continue
                contour.write(ours)
                self.assertEqual(
                    pathlib.Path(ours).read_bytes(), pathlib.Path(theirs).read_bytes(), ending
                )

    def test_public_series_have_the_vertices_of_the_program(self):
        files = sorted(glob.glob(os.path.join(SOURCES, "tests/data/published/*.csv")))
        shared = os.environ.get("OBVID_SHARED_DATA", os.path.join(SOURCES, "../shared/data"))
        public = os.path.join(shared, "airfoils_uiuc_selig/*.dat")
        airfoils = sorted(glob.glob(public))[::100]
        if not airfoils:
            print("public airfoils are not there: only series of the sources are compared")
        compared = 0
        for path, options in [(f, {}) for f in files] + [
            (f, {"noise": "rounding"}) for f in airfoils
        ]:
            more = [f"--{name}={value}" for name, value in options.items()]
            out, code = program("fit", path, "--json", *more)
            if code in (3, 4):
                with self.assertRaises((obvid.NoContourError, obvid.InputError), msg=path):
                    obvid.fit(path, **options)
                continue
            try:
                contour = obvid.fit(path, **options)
            except obvid.NotProvedError as error:
                self.assertEqual(code, 5)
                contour = error.contour
            theirs = json.loads(out)
            self.assertEqual(contour.certificate.vertices, theirs["certificate"]["vertices"], path)
            self.assertEqual(contour.proved, theirs["certificate"]["proved"], path)
            self.assertEqual(contour.report.largest_width, theirs["report"]["largest_width"], path)
            compared += 1
        self.assertGreater(compared, 2)

    def test_an_input_is_placed_before_anything_else(self):
        angles = np.radians(np.arange(0, 150, 30))
        circle = 10 * np.column_stack([np.cos(angles), np.sin(angles)])
        np.testing.assert_allclose(obvid.analyse(circle).curvature, 0.1, rtol=1e-12)
        np.testing.assert_allclose(obvid.analyse(circle, scale=4, mirror="x").curvature, -0.025, rtol=1e-12)
        moved = obvid.fit(circle, rotate=90, move=(100, -20))
        np.testing.assert_allclose(moved.points[0], (100, -10), atol=1e-12)
        text = "\n".join(f"9 {x!r} {y!r}" for x, y in circle.tolist())
        read = obvid.analyse(obvid.read_text("a title\nand a second one\n" + text), columns=(1, 2), skip=2)
        np.testing.assert_allclose(read.curvature, 0.1, rtol=1e-12)
        with self.assertRaises(TypeError):
            obvid.analyse(circle, turn=3)

    def test_reports_hold_what_the_program_prints(self):
        analysis = obvid.analyse(SERIES)
        theirs = json.loads(program("analyse", SERIES, "--json")[0])
        self.assertEqual(analysis.json, theirs)
        self.assertEqual(analysis.vertices, theirs["vertices"])
        np.testing.assert_array_equal(analysis.chord, [s["chord"] for s in theirs["segments"]])
        self.assertTrue(np.isnan(analysis.points_only_error[0]))
        region = obvid.region(SERIES)
        theirs = json.loads(program("region", SERIES, "--json")[0])
        self.assertEqual(region.json, theirs)
        self.assertEqual(region["width"].tolist(), [s["width"] for s in theirs["segments"]])
        with self.assertRaises(KeyError):
            region["no such column"]
        rows = obvid.compare(SERIES)
        theirs = json.loads(program("compare", SERIES, "--json")[0])
        self.assertEqual([r.carrier for r in rows], [c["carrier"] for c in theirs["carriers"]])
        self.assertEqual([r.vertices for r in rows], [c["vertices"] for c in theirs["carriers"]])
        table = obvid.suggest(SERIES)
        theirs = json.loads(program("fit", SERIES, "--suggest", "--json")[0])
        self.assertEqual([r.tolerance for r in table], [r["tolerance"] for r in theirs["rows"]])
        none = obvid.suggest(SERIES, carrier="arcs", convex=True, start_heading=170)
        self.assertFalse(any(row.formed for row in none))
        self.assertTrue(all(row.refusal for row in none))

    def test_curves_over_each_other_are_those_of_the_program(self):
        paths = [os.path.join(SOURCES, "examples", name) for name in ("naca2412.dat", "wing_template.dat")]
        with tempfile.TemporaryDirectory() as folder:
            picture = os.path.join(folder, "a.svg")
            ours = obvid.compare_curves(paths, picture, noise="rounding", align="chord", enlarge=20)
            typed = ("compare", *paths, "--noise", "rounding", "--align", "chord")
            self.assertEqual(ours, json.loads(program(*typed, "--json")[0]))
            with open(picture, encoding="utf-8") as file:
                self.assertIn("enlarged 20 times", file.read())
            with self.assertRaises(ValueError):
                obvid.compare_curves(paths, os.path.join(folder, "a.step"), noise="rounding")
        with self.assertRaises(obvid.UsageError):
            obvid.compare_curves(paths[:1], noise="rounding")

    def test_splines_and_control_points_are_those_of_the_program(self):
        with tempfile.TemporaryDirectory() as folder:
            tables = {"f.csv": "x,f,integral\n0,0,0.45\n1,0.84,0.95\n2,0.9,\n", "c.csv": "x,y\n0,0\n1,2\n3,3\n5,3\n7,2\n8,0\n",
                      "g.csv": "x,y,f\n0,0,0\n1,0,1\n0,1,1\n1,1,2\n", "p.csv": "x,y,z\n0,0,0\n1,0,0.1\n2,0.3,0.3\n3,1,0.6\n"}
            for name, text in tables.items():
                pathlib.Path(folder, name).write_text(text, encoding="ascii")
            at = {name: os.path.join(folder, name) for name in tables}
            for ours, typed in (
                    (lambda: obvid.spline(at["f.csv"], degree=4, compare=True), ("spline", at["f.csv"], "--degree", "4", "--compare")),
                    (lambda: obvid.spline(at["p.csv"], curve=True), ("spline", at["p.csv"], "--curve")),
                    (lambda: obvid.spline(at["g.csv"], smooth="values-free"), ("spline", at["g.csv"], "--smooth", "values-free")),
                    (lambda: obvid.nurbs(at["c.csv"], move={3: 0.8}, degree=2), ("nurbs", at["c.csv"], "--move", "4=0.8", "--degree", "2"))):
                made = ours()
                self.assertEqual(made.report, json.loads(program(*typed, "--json")[0]))
                for ending in ("csv", "json") if made.surface else ("csv", "json", "dxf"):
                    name, mine = (os.path.join(folder, f"{who}.{ending}") for who in ("theirs", "ours"))
                    program(*typed, "-o", name)
                    made.write(mine)
                    self.assertEqual(pathlib.Path(mine).read_bytes(), pathlib.Path(name).read_bytes())
            net = obvid.nurbs({"row": [1, 1, 2, 2], "col": [1, 2, 1, 2], "x": [0, 1, 0, 1], "y": [0, 0, 1, 1], "z": [0, 0, 0, 1]}, degree=1, degree_v=1)
            self.assertEqual((net.surface.report["kind"], net.report["kind"]), (net.report["kind"],) * 2)
            self.assertEqual(obvid.spline(at["g.csv"], smooth="values-free").surface.report["kind"], "graph")
            columns = obvid.spline({"x": [0, 1, 2], "f": [0, 0.84, 0.9], "integral": [0.45, 0.95]}, degree=4, compare=True)
            told = json.loads(program("spline", at["f.csv"], "--degree", "4", "--compare", "--json")[0])
            self.assertEqual({**columns.report, "name": told["name"]}, told)
        for work in (lambda: obvid.spline([1, 2, 3]), lambda: obvid.spline([[1, 2, 3, 4]]), lambda: obvid.nurbs([(0, 0), (1, 1)], move={0: 0.5}),
                     lambda: obvid.spline({"x": [0, 1]}), lambda: obvid.spline([(0, 0), (1, 1)], cancelled=3)):
            with self.assertRaises((ValueError, TypeError)):
                work()

    def test_constructions_are_those_of_the_program(self):
        path = os.path.join(SOURCES, "examples/paper_series10.csv")
        ours = obvid.region(path, construction="arcs", insert=[8], prefer="centre")
        typed = ("region", path, "--construction", "arcs", "--insert", "9", "--prefer", "centre")
        self.assertEqual(ours.json, json.loads(program(*typed, "--json")[0]))
        made = obvid.fit(POINTS, construction="clothoids", prefer="neighbours")
        self.assertEqual(made.carrier, "clothoids")
        made = obvid.fit(path, construction="parabolas", fixation=2, prefer="neighbours")
        self.assertEqual(made.carrier, "beziers")
        with self.assertRaises(TypeError):
            obvid.compare(POINTS, construction="arcs")
        with self.assertRaises(obvid.UsageError):
            obvid.fit(POINTS, construction="arcs", carrier="arcs")

    def test_curves_in_space_have_the_same_bytes(self):
        t = 0.3 * np.arange(12)
        helix = np.column_stack([20 * np.cos(t), 20 * np.sin(t), 6 * t])
        with tempfile.TemporaryDirectory() as folder:
            points = os.path.join(folder, "p.csv")
            pathlib.Path(points).write_text(
                "x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in helix.tolist())
            )
            for options, typed in [
                ({}, []),
                ({"along": "Z", "corners": [5]}, ["--along", "Z", "--corner-at", "6"]),
                ({"along": (0, 0.1, 1), "noise": 0.01}, ["--along", "0,0.1,1", "--noise", "0.01"]),
            ]:
                made = obvid.fit_space(obvid.read(points), **options)
                for ending in ("json", "dxf", "step", "csv"):
                    theirs = os.path.join(folder, "theirs." + ending)
                    program("fit", points, *typed, "-o", theirs)
                    ours = os.path.join(folder, "ours." + ending)
                    made.write(ours)
                    a, b = (SECONDS.sub("", pathlib.Path(p).read_text()) for p in (ours, theirs))
                    self.assertEqual(a, b, ending)

    def test_drawings_are_read(self):
        drawing = os.path.join(SOURCES, "tests/data/judge/series10.dxf")
        analysis = obvid.analyse(drawing)
        self.assertIsInstance(analysis, obvid.DrawingAnalysis)
        self.assertEqual(len(analysis.curves), 1)
        contour = obvid.read_contour(drawing)
        self.assertGreater(contour.length, 300.0)
        self.assertIsNone(contour.report)


class Curves(unittest.TestCase):
    def setUp(self):
        self.contour = obvid.fit(POINTS)

    def test_passes_the_points(self):
        c = self.contour
        np.testing.assert_allclose(c(np.arange(10)), POINTS, atol=1e-9)
        self.assertEqual(c(0.0).shape, (2,))
        self.assertEqual(c(np.zeros((3, 4))).shape, (3, 4, 2))
        self.assertEqual(c.domain, (0.0, 9.0))
        self.assertEqual(len(c.pieces), 9)
        np.testing.assert_array_equal(c.points, POINTS)

    def test_derivatives_are_those_of_differences(self):
        c, t, h = self.contour, np.linspace(0.05, 8.95, 41), 1e-5
        t = t[np.abs(t - np.round(t)) > 0.01]
        first = (c(t + h) - c(t - h)) / (2 * h)
        np.testing.assert_allclose(c(t, 1), first, rtol=1e-6, atol=1e-5)
        second = (c(t + h, 1) - c(t - h, 1)) / (2 * h)
        np.testing.assert_allclose(c(t, 2), second, rtol=1e-6, atol=1e-3)
        third = (c(t + h, 2) - c(t - h, 2)) / (2 * h)
        np.testing.assert_allclose(c(t, 3), third, rtol=1e-5, atol=1e-1)
        d, dd = c(t, 1), c(t, 2)
        kappa = (d[:, 0] * dd[:, 1] - d[:, 1] * dd[:, 0]) / np.hypot(*d.T) ** 3
        np.testing.assert_allclose(c.curvature(t), kappa, rtol=1e-9)
        np.testing.assert_allclose(
            np.exp(1j * c.heading(t)), (d[:, 0] + 1j * d[:, 1]) / np.hypot(*d.T), atol=1e-12
        )
        with self.assertRaises(obvid.UsageError):
            c(t, 4)
        with self.assertRaises(obvid.UsageError):
            c(9.1)

    def test_three_points_are_an_arc_with_a_report(self):
        c = obvid.fit([(5, 0), (0, 5), (-5, 0)])
        self.assertAlmostEqual(c.length, 5 * np.pi, places=9)
        self.assertEqual((c.certificate.vertices, c.report.vertices_lower_bound), (0, 0))
        self.assertEqual(len(c.report.segments), 2)

    def test_arc_lengths_are_those_of_a_fine_polygon(self):
        c = self.contour
        fine = c(np.linspace(0, 9, 200_001))
        self.assertAlmostEqual(c.length / np.hypot(*np.diff(fine, axis=0).T).sum(), 1.0, places=8)
        s = np.linspace(0, c.length, 1001)
        chords = np.hypot(*np.diff(c.at_length(s), axis=0).T)
        self.assertLess(np.ptp(chords) / chords.mean(), 1e-3)

    def test_curvature_is_monotone(self):
        kappa = self.contour.curvature(np.linspace(0, 9, 5001))
        self.assertTrue((np.diff(kappa) > -1e-9).all() or (np.diff(kappa) < 1e-9).all())

    def test_samples(self):
        c = self.contour
        for spacing in ("uniform", "cosine", "curvature"):
            places = c.sample(101, spacing)
            self.assertEqual(places.points.shape, (101, 2))
            self.assertEqual((places.s[0], places.s[-1]), (0.0, c.length))
            self.assertTrue((np.diff(places.s) > 0).all(), spacing)
        steps = np.diff(c.sample(101, "curvature").s)
        self.assertGreater(steps.max() / steps.min(), 2.0)
        self.assertGreaterEqual(len(np.asarray(c)), 200)
        for wrong in (lambda: c.sample(1), lambda: c.sample(5, "dense")):
            with self.assertRaises(ValueError):
                wrong()

    def test_the_bspline_is_the_same_curve(self):
        for carrier in ("spiral", "conics", "bspline"):
            c = obvid.fit(POINTS, carrier=carrier)
            spline = c.to_bspline()
            t, points, k, weights = spline
            self.assertEqual(len(t), len(points) + k + 1)
            ours = spline(np.linspace(t[k], t[-k - 1], 400))
            fine = c(np.linspace(0, c.piece_count, 400_001))
            for p in ours[::23]:
                self.assertLess(np.hypot(*(fine - p).T).min(), 0.002, carrier)
            np.testing.assert_allclose(ours[[0, -1]], POINTS[[0, -1]], atol=1e-9)
        try:
            import scipy.interpolate
        except ImportError:
            return
        spline = obvid.fit(POINTS, carrier="bspline").to_bspline()
        if np.ptp(spline.weights) == 0.0:
            u = np.linspace(spline.t[spline.k], spline.t[-spline.k - 1], 50)
            theirs = scipy.interpolate.BSpline(spline.t, spline.c, spline.k)(u)
            np.testing.assert_allclose(spline(u), theirs, atol=1e-9)

    def test_the_smooth_bspline_is_the_same_curve_and_c1(self):
        slot = [(x, 0) for x in range(4)] + [
            (3 + np.sin(t) * 5, 5 - 5 * np.cos(t)) for t in (0.1, 0.3, 0.6, 0.9)
        ]
        bent = [(0, 0), (4, 0.2), (8, 1), (8, 5), (7.8, 9), (7, 12)]
        made = [obvid.fit(POINTS, carrier=one) for one in ("spiral", "arcs", "conics", "bspline")]
        for c in [*made, obvid.fit(slot), obvid.fit(bent, corners=[2])]:
            t, points, k, weights = spline = c.to_bspline(smooth=True)
            self.assertTrue((weights > 0).all())
            self.assertEqual(len(t), len(points) + k + 1)
            inner, times = np.unique(t[k + 1:-k - 1], return_counts=True)
            corners = len(inner[times == k])
            self.assertEqual(corners, c.certificate.corners)
            self.assertLessEqual(times.max(), k if corners else k - 1)
            # every place of the spline lies on the contour: its foot is found between fine places
            ours = spline(np.linspace(t[0], t[-1], 300))
            at = np.linspace(0, c.piece_count, 40_001)
            fine = c(at)
            for p in ours[::23]:
                nearest = int(np.argmin(np.hypot(*(fine - p).T)))
                close = c(np.linspace(at[max(nearest - 1, 0)], at[min(nearest + 1, 40_000)], 2001))
                size = np.ptp(c.points, axis=0).max()
                self.assertLess(np.hypot(*(close - p).T).min(), 1e-5 * size)

    def test_a_curve_without_bspline_says_so(self):
        clothoids = obvid.fit(POINTS, carrier="clothoids")
        with self.assertRaises(obvid.UsageError):
            clothoids.to_bspline()
        with self.assertRaises(obvid.InputError):
            clothoids.to_bspline(smooth=True)

    def test_verify_copy_and_pickle(self):
        self.assertTrue(self.contour.verify().holds)
        for other in (pickle.loads(pickle.dumps(self.contour)), copy.deepcopy(self.contour)):
            self.assertEqual(other.text("json"), self.contour.text("json"))
        tampered = self.contour.to_dict()
        tampered["report"] = dict(tampered["report"], vertices=3)
        verification = obvid.Contour.from_json(json.dumps(tampered)).verify()
        self.assertFalse(verification.holds)
        self.assertIn("vertices", verification.false_claim)
        tampered = self.contour.to_dict()
        tampered["bspline"] = dict(tampered["bspline"], degree=3)
        with self.assertRaises(obvid.InputError):
            obvid.Contour.from_json(json.dumps(tampered))

    def test_pictures(self):
        self.assertTrue(self.contour._repr_svg_().lstrip().startswith("<"))
        self.assertIn("proved", repr(self.contour))


class CurvesInSpace(unittest.TestCase):
    T = 0.3 * np.arange(12)
    HELIX = np.column_stack([20 * np.cos(T), 20 * np.sin(T), 6 * T])

    def test_a_helix(self):
        c = obvid.fit_space(self.HELIX, along="Z")
        steep = np.hypot(20, 6)
        self.assertAlmostEqual(c.length, 3.3 * steep, places=6)
        s, points, tangent, curvature, torsion = c.sample(40)
        a = s / steep
        wanted = np.column_stack([20 * np.cos(a), 20 * np.sin(a), 6 * a])
        np.testing.assert_allclose(points, wanted, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(tangent, axis=1), 1.0, atol=1e-12)
        np.testing.assert_allclose(curvature, 20 / steep**2, rtol=1e-6)
        np.testing.assert_allclose(torsion, 6 / steep**2, rtol=1e-4)
        self.assertEqual(c.at_length(np.zeros((2, 3))).shape, (2, 3, 3))
        with self.assertRaises(ValueError):
            c.at_length(c.length + 1.0)

    def test_corners_files_and_copies(self):
        c = obvid.fit_space(self.HELIX, along="Z", corners=[5], heading={2: (110, 140)})
        self.assertEqual((c.part_count, c.corners[0].point, c.closed), (2, 5, False))
        self.assertLess(c.corners[0].turn, 0.01)
        np.testing.assert_allclose(c.at_length(c.part_lengths[0]), self.HELIX[5], atol=1e-9)
        self.assertTrue(c.verify().holds)
        again = pickle.loads(pickle.dumps(c))
        self.assertEqual(again.text("json"), c.text("json"))
        with tempfile.TemporaryDirectory() as folder:
            said = c.write(os.path.join(folder, "c.sldcrv"))
            self.assertEqual(sorted(os.listdir(folder)), ["c-1.sldcrv", "c-2.sldcrv"])
            self.assertIn("would round corners", said[-1])
            c.write(os.path.join(folder, "c.json"))
            self.assertEqual(obvid.read_space(os.path.join(folder, "c.json")).part_count, 2)
        with self.assertRaises(obvid.UsageError):
            c.text("sldcrv")

    def test_what_is_refused(self):
        for wrong in (POINTS, np.zeros(5)):
            with self.assertRaises(ValueError):
                obvid.fit_space(wrong)
        with self.assertRaises(obvid.UsageError):
            obvid.fit_space(self.HELIX, start_heading=10)
        with self.assertRaises(ValueError):
            obvid.fit(self.HELIX)
        with self.assertRaises(TypeError):
            obvid.fit_space(self.HELIX, construction="arcs")
        with self.assertRaises(obvid.CancelledError):
            obvid.fit_space(self.HELIX, cancelled=lambda: True)
        file = obvid.fit_space(self.HELIX, corners=[5]).to_dict()
        self.assertTrue(obvid.SpaceCurve.from_json(json.dumps(file)).verify().holds)
        file["corners"][0]["turn"] += 0.1
        self.assertFalse(obvid.SpaceCurve.from_json(json.dumps(file)).verify().holds)


class Options(unittest.TestCase):
    def test_given_data_are_kept(self):
        free = np.degrees(float(obvid.fit(POINTS).heading(4.0)))
        given = round(free, 1)
        c = obvid.fit(POINTS, heading={4: given}, end_radius=float("inf"))
        self.assertAlmostEqual(np.degrees(float(c.heading(4.0))), given, places=9)
        self.assertAlmostEqual(float(c.curvature(c.piece_count)), 0.0, places=12)
        self.assertEqual(c.report.headings_given, 1)
        first = obvid.fit(POINTS, heading={0: -60.0})
        last = obvid.fit(POINTS[::-1], heading={-1: 120.0})
        self.assertAlmostEqual(first.length, last.length, places=1)

    def test_two_points_need_both_headings(self):
        two = [(20.0, -1.0), (38.0, 90.0)]
        for some in ({}, {"start_heading": 60}, {"end_heading": 110}, {"end_radius": 3}):
            with self.assertRaises(obvid.ObvidError) as refused:
                obvid.fit(two, **some)
            self.assertIn("two do when both have a heading", str(refused.exception))
        c = obvid.fit(two, start_heading=60, end_heading=110)
        self.assertAlmostEqual(np.degrees(float(c.heading(0.0))), 60.0, places=9)

    def test_given_ranges_are_kept(self):
        free = np.degrees(float(obvid.fit(POINTS).heading(4.0)))
        c = obvid.fit(POINTS, heading={4: (free - 3.0, free - 1.0)}, end_radius=(-500, -400))
        self.assertAlmostEqual(np.degrees(float(c.heading(4.0))), free - 1.0, places=6)
        self.assertEqual(c.report.ranges_given, 2)
        self.assertIn((4, "heading", "greatest"), c.report.ranges_active)
        wide = obvid.fit(POINTS, heading={4: (free - 1.0, free + 1.0)}, prefer="fair")
        self.assertEqual(wide.report.ranges_active, ())
        with self.assertRaises(obvid.UsageError):
            obvid.fit(POINTS, end_radius=(-20, 30))
        with self.assertRaises(obvid.UsageError):
            obvid.fit(POINTS, prefer="best")

    def test_noise_for_each_point(self):
        rng = np.random.default_rng(1)
        points = spiral(40) + rng.uniform(-1e-3, 1e-3, (40, 2))
        for noise in (0.002, np.full(40, 0.002), np.float32(0.002)):
            c = obvid.fit(points, noise=noise)
            self.assertEqual(c.certificate.vertices, 0)
            self.assertLessEqual(c.report.largest_move, 0.002)
        with self.assertRaises(ValueError):
            obvid.fit(points, noise=np.full(39, 0.002))

    def test_closed_and_corners(self):
        square = [(0, 0), (4, 0), (4, 4), (0, 4)]
        ring = obvid.fit(np.array([(np.cos(t), 0.7 * np.sin(t)) for t in np.arange(24) * np.pi / 12]),
                         closed=True)
        self.assertTrue(ring.closed)
        self.assertEqual(ring.certificate.vertices, 4)
        c = obvid.fit(square, closed=True, corners=[0, 1, 2, 3])
        self.assertEqual(c.certificate.corners, 4)

    def test_what_is_not_there_is_refused(self):
        with self.assertRaises(TypeError):
            obvid.analyse(POINTS, closed=True)
        with self.assertRaises(TypeError):
            obvid.fit(POINTS, carier="arcs")
        with self.assertRaises(obvid.UsageError):
            obvid.fit(POINTS, carrier="splines")
        with self.assertRaises((obvid.UsageError, obvid.InputError)):
            obvid.fit(POINTS, heading={99: 0.0})
        with self.assertRaises(IndexError):
            obvid.fit(POINTS, heading={-11: 0.0})


class Errors(unittest.TestCase):
    ZIGZAG = [(0, 0), (1, 5), (2, 0), (3, 5), (4, 0)]

    def test_a_refusal_says_what_and_where(self):
        with self.assertRaises(obvid.NoContourError) as caught:
            obvid.fit(self.ZIGZAG, convex=True)
        error = caught.exception
        self.assertEqual(error.code // 100, 4)
        self.assertTrue(error.message)
        self.assertIn(f"E{error.code}", str(error))
        again = pickle.loads(pickle.dumps(error))
        self.assertEqual((again.code, again.advice, again.points),
                         (error.code, error.advice, error.points))
        reason = obvid.why_not(self.ZIGZAG, convex=True)
        self.assertEqual(reason.code // 100, 4)
        self.assertIsNone(obvid.why_not(POINTS))

    def test_files(self):
        with self.assertRaises(obvid.ObvidError):
            obvid.read("/no/such/file.csv")
        with self.assertRaises(obvid.InputError):
            obvid.fit(obvid.read_text("x,y\n1,2\nnot,numbers\n"))
        with self.assertRaises(obvid.UsageError):
            obvid.fit(POINTS).write("contour.nothing")

    def test_a_broken_promise_brings_the_contour(self):
        # a cubic spline promises nothing; a B-spline that cannot keep its promise says so
        try:
            contour = obvid.fit(os.path.join(SOURCES, "tests/data/found/against_run_143.csv"),
                                carrier="bspline")
        except obvid.NotProvedError as error:
            contour = error.contour
            self.assertFalse(contour.proved)
            self.assertTrue(contour.certificate.reason)
        self.assertIsNotNone(contour)


class Arrays(unittest.TestCase):
    def test_everything_that_numpy_takes(self):
        base = obvid.fit(POINTS).length
        wide = np.zeros((20, 6))
        wide[::2, 1:4:2] = POINTS
        frozen = POINTS.copy()
        frozen.flags.writeable = False
        for points in (POINTS.tolist(), [tuple(p) for p in POINTS], np.asfortranarray(POINTS),
                       wide[::2, 1:4:2], frozen, POINTS.astype(">f8"), POINTS.astype(object),
                       np.column_stack([POINTS, np.full(10, 3.0)])):
            self.assertEqual(obvid.fit(points).length, base)
        self.assertAlmostEqual(obvid.fit(POINTS.astype(np.float32)).length, base, places=3)
        self.assertAlmostEqual(obvid.fit(POINTS[::-1]).length, base, places=1)

    def test_hostile_arrays_are_refused_or_fitted(self):
        """OBVID_HOSTILE=100000 tries so many."""
        trials = int(os.environ.get("OBVID_HOSTILE", "3000"))
        rng = np.random.default_rng(7)
        fitted = refused = 0
        huge = np.zeros((200_000, 2))
        jobs = (obvid.fit, obvid.fit, obvid.fit, obvid.analyse, obvid.fit_space, obvid.region)
        for trial in range(trials):
            points = hostile(rng, trial, huge)
            job = jobs[trial // len(HOSTILE) % len(jobs)]
            try:
                made = job(points)
                if job is obvid.fit:
                    self.assertGreater(made.length, 0.0)
                    made(np.nan if trial % 97 == 0 else 0.0)
                fitted += 1
            except (obvid.ObvidError, ValueError, TypeError):
                refused += 1
        print(f"{trials} hostile arrays: {fitted} fitted, {refused} refused")
        self.assertGreater(fitted, trials // 10)
        self.assertGreater(refused, trials // 10)

    def test_what_is_no_series_is_refused(self):
        for wrong in ([], [1, 2, 3], [[1, 2, 3, 4]], np.zeros((3, 2, 2)), "/no/such/file",
                      np.zeros((0, 2)), [[0, 0], [1, 1]], np.zeros((5, 2)),
                      [(0, 0, 0), (1, 0, 1), (2, 1, 0)], POINTS + 1j, [(0, 10**400), (1, 1), (2, 0)],
                      np.ma.masked_greater(POINTS, 100)):
            with self.assertRaises((obvid.ObvidError, ValueError)):
                obvid.fit(wrong)


class Work(unittest.TestCase):
    def test_progress_and_cancellation(self):
        stages = []
        rng = np.random.default_rng(3)
        t = np.linspace(0, 30, 3000)
        points = np.column_stack([t, np.sin(t)]) + rng.uniform(-1e-3, 1e-3, (3000, 2))
        obvid.fit(points, noise=2e-3, progress=lambda stage, part: stages.append((stage, part)))
        self.assertTrue(stages)
        self.assertTrue(all(0.0 <= part <= 1.0 for _, part in stages))
        with self.assertRaises(obvid.CancelledError):
            obvid.fit(points, noise=2e-3, cancelled=lambda: True)

        def fails(stage, part):
            raise RuntimeError("from the callback")

        with self.assertRaisesRegex(RuntimeError, "from the callback"):
            obvid.fit(points, noise=2e-3, progress=fails)

    def test_ctrl_c_ends_the_work(self):
        rng = np.random.default_rng(3)
        t = np.linspace(0, 300, 30_000)
        points = np.column_stack([t, np.sin(t)]) + rng.uniform(-1e-3, 1e-3, (30_000, 2))
        timer = threading.Timer(0.3, os.kill, (os.getpid(), signal.SIGINT))
        before = signal.getsignal(signal.SIGINT)
        timer.start()
        started = time.process_time()
        with self.assertRaises(KeyboardInterrupt):
            for _ in range(100):
                obvid.fit(points, noise=2e-3)
        timer.join()
        self.assertLess(time.process_time() - started, 20.0)
        self.assertIs(signal.getsignal(signal.SIGINT), before)

    def test_threads_give_the_same_contours(self):
        series = [spiral(12, 0.05 + 0.001 * k) for k in range(60)] + [[(0, 0), (1, 1)]]
        one = obvid.fit_many(series, workers=1, errors="return")
        four = obvid.fit_many(series, workers=4, errors="return")
        for a, b in zip(one[:-1], four[:-1]):
            self.assertEqual(SECONDS.sub("", a.text("json")), SECONDS.sub("", b.text("json")))
        self.assertIsInstance(one[-1], obvid.ObvidError)
        with self.assertRaises(obvid.ObvidError):
            obvid.fit_many(series)

    def test_one_contour_from_many_threads(self):
        contour, seen = obvid.fit(POINTS), []

        def look():
            seen.append(contour(np.linspace(0, 9, 100)).tobytes())

        threads = [threading.Thread(target=look) for _ in range(8)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(len(set(seen)), 1)


class Wheel(unittest.TestCase):
    def test_is_small_and_needs_numpy_only(self):
        with tempfile.TemporaryDirectory() as folder:
            built = subprocess.run(
                [os.path.join(SOURCES, "tools/build_wheel"), LIBRARY, folder],
                capture_output=True, text=True, env={**os.environ, "PYTHON": sys.executable},
            )
            self.assertEqual(built.returncode, 0, built.stderr)
            wheel = built.stdout.strip()
            self.assertRegex(os.path.basename(wheel), r"^obvid-.*-py3-none-linux_\w+\.whl$")
            self.assertLess(os.path.getsize(wheel), 5_000_000)
            unpacked = os.path.join(folder, "unpacked")
            zipfile.ZipFile(wheel).extractall(unpacked)
            code = (
                "import obvid, sys; c = obvid.fit([(0, 0), (10, 1), (19, 4), (26, 9), (30, 16)]); "
                "assert c.proved and c.certificate.vertices == 0; "
                "print(sorted(m for m in ('matplotlib', 'scipy') if m in sys.modules))"
            )
            environment = {k: v for k, v in os.environ.items() if k not in ("OBVID_LIBRARY", "PYTHONPATH")}
            whole, library = [], []
            for python in pythons():
                with self.subTest(python=python):
                    version, numpy = self.installed(python, wheel, folder, environment)
                    command = code if numpy else WITHOUT_NUMPY
                    inside = os.path.join(folder, "venv" + version, "bin/python")
                    done = subprocess.run([inside, "-B", "-W", "ignore", "-c", command], capture_output=True,
                                          text=True, env=environment, cwd=folder)
                    self.assertEqual((done.returncode, done.stdout.strip()), (0, "[]"), python + done.stderr)
                    (whole if numpy else library).append(version)
            print("wheel in fresh environments: whole with Python", ", ".join(whole),
                  "- modules and library, without numpy:", ", ".join(library) or "none")
            self.assertTrue(whole)

    def installed(self, python, wheel, folder, environment):
        """A fresh environment with the wheel, by pip; numpy from outside, where that Python has one."""
        told = subprocess.run([python, "-c", TOLD], capture_output=True, text=True, env=environment, check=True)
        version, numpy = (told.stdout.strip().split("\n") + [""])[:2]
        place = os.path.join(folder, "venv" + version)
        made = subprocess.run([python, "-m", "venv", "--without-pip", place], capture_output=True, text=True,
                              env=environment)
        self.assertEqual(made.returncode, 0, python + made.stderr)
        site = glob.glob(os.path.join(place, "lib/python*/site-packages"))[0]
        pip = subprocess.run([python, "-m", "pip", "install", "-q", "--no-index", "--no-deps", "--target", site, wheel],
                             capture_output=True, text=True, env=environment)  # fmt: skip
        if "No module named pip" in pip.stderr:  # Debian's, without the package python3-pip
            zipfile.ZipFile(wheel).extractall(site)
        else:
            self.assertEqual(pip.returncode, 0, python + pip.stderr)
        if numpy:
            os.symlink(numpy, os.path.join(site, "numpy"))
        return version, numpy


def pythons():
    """Every Python 3.8 or later that is here, one of each minor version."""
    found = {}
    places = [sys.executable] + [shutil.which(f"python3.{minor}") or "" for minor in range(8, 15)]
    places += sorted(glob.glob(os.path.expanduser("~/.pyenv/versions/3.*/bin/python3")))
    for place in places:
        told = place and subprocess.run([place, "-c", "import sys; print(sys.version_info[:2])"],
                                        capture_output=True, text=True)
        if not told or told.returncode != 0 or told.stdout < "(3, 8" and len(told.stdout.strip()) < 7:
            continue
        found.setdefault(told.stdout.strip(), place)
    return list(found.values())


TOLD = """
import sys
print(sys.version.split()[0])
try:
    import numpy
    print(numpy.__path__[0])
except ImportError:
    pass
"""
# The modules compile, and the library, which needs no numpy, forms the contour of a circle.
WITHOUT_NUMPY = """
import compileall, ctypes as C, importlib, os, sys, sysconfig, types
place = os.path.join(sysconfig.get_paths()["purelib"], "obvid")
assert compileall.compile_dir(place, quiet=1)
package = types.ModuleType("obvid")
package.__path__ = [place]
sys.modules["obvid"] = package
lib = importlib.import_module("obvid._library").lib
xy = (C.c_double * 8)(5, 0, 3, 4, 0, 5, -5, 0)
source, contour, error = C.c_void_p(), C.c_void_p(), C.POINTER(importlib.import_module("obvid._library").ErrorStruct)()
assert lib.obvid_points(xy, 4, C.byref(source), C.byref(error)) == 0
assert lib.obvid_fit(source, None, None, C.byref(contour), None, C.byref(error)) == 0
assert abs(lib.obvid_contour_length(contour) - 5 * 3.141592653589793) < 1e-6
print([])
"""


class Surfaces(unittest.TestCase):
    def sections(self):
        t = np.linspace(0, 2, 9)
        return [np.column_stack([np.exp(t) * np.cos(t), np.exp(t) * np.sin(t), 0 * t + z]) for z in (0, 1, 3)]

    def test_says_what_the_program_says(self):
        path = os.path.join(SOURCES, "examples/surfaces/wigley_stations.csv")
        with tempfile.TemporaryDirectory() as folder:
            name = os.path.join(folder, "hull.json")
            told = json.loads(subprocess.run([PROGRAM, "surface", "skin", path, "-o", name, "--json"], check=True,
                                             capture_output=True, text=True).stdout)
            hull = obvid.skin([path])
            ours = dict(hull.report)
            for one in (ours, told):
                one.pop("written"), one.pop("remarks")
            self.assertEqual(ours, told)
            with open(name, "rb") as file:
                self.assertEqual(hull.data("json"), file.read())
            again = obvid.read_surface(name)
            self.assertEqual(again.data("json"), hull.data("json"))
            checked = json.loads(subprocess.run([PROGRAM, "surface", "check", name, "--json"], check=True,
                                                capture_output=True, text=True).stdout)
            self.assertEqual(again.check(), checked)
            told = json.loads(subprocess.run([PROGRAM, "surface", "cut", name, "--waterlines", "count:3", "--draught", "-0.1", "--half",
                                              "--json"], check=True, capture_output=True, text=True).stdout)
            cut = hull.cut(waterlines="count:3", draught=-0.1, half=True)
            self.assertEqual(cut.report, told)
            for section in cut.sections:
                for branch in section.branches:
                    self.assertEqual(branch.points.shape[0], branch.in_plane.shape[0])
                    self.assertEqual(branch.parameters.shape, branch.points.shape)
            self.assertTrue(cut.files[".dxf"].startswith(b"  0") and b"<svg" in cut.files[".svg"])
            hull.write(os.path.join(folder, "hull.stl"))
            self.assertGreater(os.path.getsize(os.path.join(folder, "hull.stl")), 84)

    def test_passes_the_points(self):
        sections = self.sections()
        body = obvid.skin(sections, match="points")
        ends = body([(0, 0), (1, 0), (0, 1), (1, 1)]).points
        for place, point in zip(ends, (sections[0][0], sections[0][-1], sections[-1][0], sections[-1][-1])):
            self.assertLess(np.abs(place - point).max(), 1e-9)

    def test_grids_of_arrays(self):
        x, y = np.meshgrid(np.arange(4.0), np.arange(3.0))
        grid = obvid.surface("grid", [np.dstack([x, y, 0.1 * x * y])])
        places = grid(np.random.default_rng(1).random((20, 2))).points
        self.assertLess(np.abs(places[:, 2] - 0.1 * places[:, 0] * places[:, 1]).max(), 1e-12)

    def test_scattered_points_of_arrays(self):
        x, y = np.random.default_rng(2).random((2, 300))
        made = obvid.surface("scatter", [np.column_stack([x, y, x * x - y])], tolerance=1e-6, up="z", drop_outliers=True)
        said = made.report["scatter"]
        self.assertEqual((said["points"], said["outliers"]), (300, []))
        self.assertLessEqual(said["deviation"], 1e-6)
        places = made(np.random.default_rng(1).random((20, 2))).points
        self.assertLess(np.abs(places[:, 2] - places[:, 0] ** 2 + places[:, 1]).max(), 1e-5)

    def test_what_is_refused(self):
        for work, kind in ((lambda: obvid.surface("bowl", [self.sections()[0]]), obvid.UsageError),
                           (lambda: obvid.skin([]), obvid.UsageError), (lambda: obvid.skin([[(0, 0)]]), obvid.InputError),
                           (lambda: obvid.skin([np.zeros((4, 4))]), ValueError),
                           (lambda: obvid.skin([np.full((4, 3), np.nan)] * 2), obvid.InputError),
                           (lambda: obvid.skin(self.sections(), carrier="arcs"), obvid.UsageError),
                           (lambda: obvid.skin(self.sections())([(0, 2)]), obvid.UsageError),
                           (lambda: obvid.skin(self.sections()).data("doc"), obvid.UsageError)):
            with self.assertRaises(kind):
                work()

    def test_cancellation(self):
        with self.assertRaises(obvid.CancelledError):
            obvid.skin(self.sections(), cancelled=lambda: True)


class Documents(unittest.TestCase):
    def test_examples_of_the_docstrings(self):
        for module in (obvid, obvid.jobs, obvid.contour, obvid.space, obvid.splines, obvid.surfaces):
            result = doctest.testmod(module)
            self.assertEqual(result.failed, 0, module.__name__)

    def test_examples_of_the_page(self):
        page = os.path.join(SOURCES, "docs/python.md")
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                os.symlink(os.path.join(SOURCES, "examples"), "examples")
                result = doctest.testfile(page, module_relative=False)
            finally:
                os.chdir(before)
        self.assertEqual(result.failed, 0)
        self.assertGreater(result.attempted, 20)

    def test_the_gallery_has_its_pictures(self):
        page = pathlib.Path(SOURCES, "docs/python.md").read_text()
        listed = set(re.findall(r"\(images/(python-[a-z-]+\.png)\)", page))
        self.assertEqual(len(listed), 10)
        try:
            import matplotlib  # noqa: F401
        except ImportError:
            self.skipTest("matplotlib is not installed")
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run(
                [sys.executable, "-B", os.path.join(SOURCES, "tools/make_python_pictures"), folder],
                capture_output=True, text=True,
            )
            self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
            self.assertEqual(set(os.listdir(folder)), listed)
            for name in listed:
                self.assertTrue(pathlib.Path(SOURCES, "docs/images", name).is_file(), name)
                self.assertGreater(os.path.getsize(os.path.join(folder, name)), 3000)

    def test_the_notebook(self):
        book = json.loads(pathlib.Path(SOURCES, "examples/fair_contours.ipynb").read_text())
        names, compared = {"__name__": "__main__"}, 0
        before = os.getcwd()
        with tempfile.TemporaryDirectory() as folder:
            os.chdir(folder)
            try:
                os.symlink(os.path.join(SOURCES, "examples"), "examples")
                for cell in book["cells"]:
                    if cell["cell_type"] != "code":
                        continue
                    shown = run_cell("".join(cell["source"]), names)
                    for output in cell["outputs"]:
                        for kind, text in output["data"].items():
                            self.assertEqual(shown[kind], "".join(text), cell["source"])
                            compared += 1
                self.assertTrue(os.path.isfile("contour.step"))
            finally:
                os.chdir(before)
        self.assertGreaterEqual(compared, 6)

    def test_types(self):
        try:
            from mypy import api
        except ImportError:
            self.skipTest("mypy is not installed")
        with tempfile.TemporaryDirectory() as cache:
            out, err, code = api.run(["--strict", "--cache-dir", cache,
                                      "--config-file", os.path.join(PACKAGE, "pyproject.toml"),
                                      os.path.join(PACKAGE, "obvid")])
        self.assertEqual(code, 0, out + err)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[5:]])
