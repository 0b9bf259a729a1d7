# SPDX-License-Identifier: Apache-2.0
"""Batches as users run them: every source, every number of workers, killed and going on.

usage: batch_test.py OBVID PROJECT_FOLDER [-k NAME]
"""
import json
import math
import os
import pathlib
import random
import re
import signal
import sqlite3
import struct
import subprocess
import sys
import tempfile
import time
import unittest
import zipfile

import h5py
import numpy as np

OBVID, PROJECT = sys.argv[1], pathlib.Path(sys.argv[2])
ENVIRONMENT = {k: v for k, v in os.environ.items() if not k.startswith(("SLURM_", "OMPI_"))}
ENVIRONMENT.pop("OBVID_BATCH_BUILDER", None)


def batch(*words, code=0, env=None, **more):
    """Runs `obvid batch`, expects the exit code, gives what it printed."""
    done = subprocess.run([OBVID, "batch", *map(str, words)], capture_output=True, text=True,
                          env={**ENVIRONMENT, **(env or {})}, **more)
    if done.returncode != code:
        raise AssertionError(f"{words}: exit {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stdout + done.stderr


def spiral(n, turn=2.0, grow=0.3, radius=100.0):
    """Points of a logarithmic spiral: curvature falls all along, no contour needs a vertex."""
    t = np.linspace(0.0, turn, n)
    r = radius * np.exp(grow * t)
    return np.column_stack([r * np.cos(t), r * np.sin(t)])


def series(count, n=12):
    """Different spirals, the same ones every time."""
    rng = np.random.default_rng(7)
    return [spiral(n, *rng.uniform((1.0, 0.1), (3.0, 0.5))) for _ in range(count)]


def write_csv(path, points, header="x,y"):
    rows = [",".join(repr(float(v)) for v in p) for p in points]
    pathlib.Path(path).write_text("\n".join([header, *rows]) + "\n")


def table(path):
    with h5py.File(path) as file:
        out = {name: file[name][...] for name in file}
    return {k: [v.decode() for v in a] if a.dtype.kind == "S" else a for k, a in out.items()}


def ragged(path, all_points, ids=None):
    with h5py.File(path, "w") as file:
        file["points"] = np.concatenate(all_points)
        file["start"] = np.cumsum([0, *(len(p) for p in all_points)])
        if ids:
            file["id"] = ids


def torus_stl(path, great=5.0, small=1.0, n=60):
    """Binary STL of a torus, its corners computed here."""
    def at(i, k):
        u, v = 2 * math.pi * (i % (2 * n)) / (2 * n), 2 * math.pi * (k % n) / n
        r = great + small * math.cos(v)
        return (r * math.cos(u), r * math.sin(u), small * math.sin(v))
    grid_stl(path, at, 2 * n, n)


def grid_stl(path, at, rows, columns):
    """Binary STL of two triangles a cell, corners at(i, k) with 0 <= i <= rows, 0 <= k <= columns."""
    triangles = []
    for i in range(rows):
        for k in range(columns):
            a, b, c, d = at(i, k), at(i + 1, k), at(i + 1, k + 1), at(i, k + 1)
            triangles += [(a, b, c), (a, c, d)]
    data = [b"grid".ljust(80), struct.pack("<I", len(triangles))]
    data += [struct.pack("<12fH", 0, 0, 0, *(x for p in t for x in p), 0) for t in triangles]
    pathlib.Path(path).write_bytes(b"".join(data))


def stl_corners(path):
    data = pathlib.Path(path).read_bytes()
    count = struct.unpack_from("<I", data, 80)[0]
    record = np.dtype([("normal", "<f4", 3), ("corner", "<f4", (3, 3)), ("mark", "<u2")])
    return np.frombuffer(data, record, count, 84)["corner"].reshape(-1, 3).astype(float)


def wigley(x, z):
    """Half breadth of Wigley's hull: 10 m long, 1 m wide, 0.625 m deep."""
    return 0.5 * (1 - (x / 5) ** 2) * (1 - (z / 0.625) ** 2)


def from_wigley(x, y, z):
    """Distance within a station, to first order."""
    slope = (1 - (x / 5) ** 2) * z / 0.625**2
    return np.abs(y - wigley(x, z)) / np.hypot(1, slope)


class Batch(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.at = pathlib.Path(self.folder.name)
        self.out = self.at / "out.h5"

    def tearDown(self):
        self.folder.cleanup()

    def rows(self, *words, code=0):
        batch(*words, "-o", self.out, code=code)
        return table(self.out)

    # ---- items ----

    def hostile_folder(self):
        folder = self.at / "in"
        folder.mkdir()
        for i, points in enumerate(series(5)):
            write_csv(folder / f"good{i}.csv", points)
        write_csv(folder / "nan.csv", [(0, 0), (math.nan, 1), (2, 2), (3, 1)])
        (folder / "empty.csv").write_text("")
        (folder / "words.csv").write_text("x,y\n1,2\nthree,4\n5,6\n7,8\n")
        (folder / "noise.bin").write_bytes(bytes(random.Random(3).randbytes(5000)))
        write_csv(folder / "two.csv", [(0, 0), (1, 1)])
        write_csv(folder / "back.csv", [(0, 0), (10, 0), (5, 0), (20, 0)])
        return folder

    def test_one_hostile_item_fails_alone_with_its_code(self):
        rows = self.rows(self.hostile_folder())
        found = {pathlib.Path(i).name: int(c) for i, c in zip(rows["id"], rows["code"])}
        for i in range(5):
            self.assertEqual(found[f"good{i}.csv"], 0)
        self.assertEqual(found["nan.csv"], 303)
        self.assertEqual(found["empty.csv"] // 100, 3)
        self.assertEqual(found["words.csv"], 302)
        self.assertEqual(found["noise.bin"] // 100, 3)
        self.assertEqual(found["two.csv"], 304)
        self.assertEqual(found["back.csv"], 402)
        status = {pathlib.Path(i).name: int(s) for i, s in zip(rows["id"], rows["status"])}
        self.assertEqual({n for n, s in status.items() if s == 2},
                         {"nan.csv", "empty.csv", "words.csv", "noise.bin", "two.csv", "back.csv"})

    def test_each_row_says_what_the_program_says_of_that_file(self):
        folder = self.hostile_folder()
        rows = self.rows(folder, "--noise", "0.01")
        looked = 0
        for k, name in enumerate(rows["id"]):
            one = subprocess.run([OBVID, "fit", name, "--noise", "0.01", "--json"],
                                 capture_output=True, text=True, env=ENVIRONMENT)
            if rows["code"][k]:
                self.assertIn(f"E{rows['code'][k]}", one.stdout + one.stderr)
                continue
            said = json.loads(one.stdout)
            self.assertEqual(said["certificate"]["vertices"], rows["vertices"][k])
            self.assertEqual(said["report"]["vertices_lower_bound"], rows["bound"][k])
            self.assertEqual(said["pieces"], rows["pieces"][k])
            self.assertEqual(said["certificate"]["proved"], rows["proved"][k] == 1)
            self.assertEqual(said["report"]["largest_move"], rows["move"][k])
            self.assertEqual(said["report"]["largest_deviation"], rows["error"][k])
            looked += 1
        self.assertGreaterEqual(looked, 5)

    def test_an_item_that_takes_too_long_fails_with_E103(self):
        ragged(self.at / "in.h5", [spiral(9), spiral(20_000), spiral(9)])
        rows = self.rows(self.at / "in.h5", "--item-timeout", "0.02", "--jobs", 1)
        self.assertEqual(rows["code"][1], 103)

    def test_a_table_whose_name_says_that_it_is_no_HDF5_is_refused(self):
        folder = self.hostile_folder()
        for name in ("b.csv", "b.json", "b.sqlite", "b.svg"):
            said = batch(folder, "-o", self.at / name, code=2)
            self.assertIn("E202", said)
            self.assertIn("query OUT.h5 --csv", said)
        self.assertEqual([p.name for p in self.at.iterdir()], ["in"])

    def test_options_that_no_item_could_bear_stop_the_batch_at_once(self):
        folder = self.hostile_folder()
        said = batch(folder, "-o", self.out, "--carrier", "spagetti", code=2)
        self.assertIn("E203", said)
        batch(folder, "-o", self.out, "--nose", "1", code=2)
        batch(folder, "-o", self.out, "--job", "dance", code=2)
        batch(folder, "-o", self.out, "--each", "curve.json", code=2)
        self.assertFalse(self.out.exists())

    # ---- sources ----

    def test_every_source_gives_the_same_rows(self):
        points = series(30)
        names = [f"s{i:02}" for i in range(30)]
        folder = self.at / "in"
        folder.mkdir()
        for name, one in zip(names, points):
            write_csv(folder / f"{name}.csv", one)
        with zipfile.ZipFile(self.at / "in.zip", "w", zipfile.ZIP_DEFLATED) as archive:
            for name in names:
                archive.write(folder / f"{name}.csv", f"deep/{name}.csv")
        (self.at / "list").write_text("".join(f"{folder / n}.csv\n" for n in names))
        lines = ["# many series", "Id;x;y"]
        for name, one in zip(names, points):
            lines += [f"{name};{float(x)!r};{float(y)!r}" for x, y in one]
        (self.at / "table.csv").write_text("\n".join(lines))
        ragged(self.at / "ragged.h5", points, names)
        with h5py.File(self.at / "even.h5", "w") as file:
            padded = np.full((30, 15, 2), np.nan)
            for i, one in enumerate(points):
                padded[i, :len(one)] = one
            file["points"] = padded
        with h5py.File(self.at / "named.h5", "w") as file:
            for name, one in zip(names, points):
                file[f"group/{name}"] = np.column_stack([one, np.full(len(one), 5.0)])
        wanted = None
        for source in ([folder], [self.at / "in.zip"], ["--list", self.at / "list"],
                       [self.at / "table.csv"], [self.at / "ragged.h5"], [self.at / "even.h5"],
                       [self.at / "named.h5"], [folder / f"{n}.csv" for n in names]):
            rows = self.rows(*source)
            figures = [rows[k] for k in ("status", "vertices", "bound", "pieces", "proved", "error")]
            if wanted is None:
                wanted = figures
                self.assertEqual(len(rows["id"]), 30)
                self.assertTrue(all(rows["proved"] == 1))
            for a, b in zip(wanted, figures):
                np.testing.assert_array_equal(a, b)
        self.assertEqual(rows["id"][3], str(folder / "s03.csv"))

    def test_a_table_keeps_columns_of_headings_and_refuses_rows_in_two_places(self):
        p = spiral(5)
        rows = [f"a,{x!r},{y!r}," for x, y in p.tolist()]
        rows[0] += "91"
        (self.at / "t.csv").write_text("id,x,y,heading\n" + "\n".join(rows) + "\n")
        self.assertEqual(self.rows(self.at / "t.csv")["code"][0] // 100 in (0, 4), True)
        (self.at / "u.csv").write_text("id,x,y\na,0,0\nb,1,1\na,2,2\n")
        self.assertIn("two places", batch(self.at / "u.csv", "-o", self.out, code=3))

    def test_sections_of_a_mesh_are_items(self):
        torus_stl(self.at / "torus.stl")
        rows = self.rows(self.at / "torus.stl", "--cut", "z=-1.25:0.5:1.25", "--noise", "0.01")
        self.assertEqual(rows["id"], [f"z={z}/{k}" for z in (-0.75, -0.25, 0.25, 0.75) for k in (1, 2)])
        self.assertTrue(all(rows["proved"] == 1))
        self.assertTrue(all(rows["move"] <= 0.01))
        self.assertTrue(all(rows["corners"] == 0))  # they come back to their beginning
        said = batch(self.at / "torus.stl", "--cut", "z=-1.25:0.5:1.25", "-o", self.at / "b.h5")
        self.assertIn("2 of 6 planes do not cut", said)
        self.assertIn("E203", batch(self.at / "torus.stl", "--cut", "q=1", "-o", self.out, code=2))

    def test_a_mesh_becomes_200_fair_sections_and_one_skin(self):
        """The commands of docs/batch.md, on a hull that is known in closed form."""
        def at(i, k):
            x, z = -5 + i / 20, -0.625 * (1 - k / 60)
            return (x, wigley(x, z), z)
        grid_stl(self.at / "hull.stl", at, 200, 60)
        rows = self.rows(self.at / "hull.stl", "--cut", "x=-4.975:0.05:4.975", "--noise", "0.001",
                         "--units", "m", "--each", self.at / "sec/{number}.csv", "--samples", "40")
        self.assertEqual(len(rows["id"]), 200)
        self.assertTrue(all(rows["proved"] == 1))
        self.assertTrue(all(rows["move"] <= 0.001))
        self.assertGreaterEqual(np.mean(rows["vertices"] == rows["bound"]), 0.9)
        stations = self.at / "st"
        stations.mkdir()
        allowed = 0.001 + 5e-5  # moved points, and the triangles' own chords
        for k in range(200):
            x = -4.975 + 0.05 * k
            points = np.loadtxt(self.at / f"sec/{k}.csv", delimiter=",", skiprows=1, usecols=(1, 2))
            self.assertEqual(len(points), 40)
            self.assertLess(from_wigley(x, *points.T).max(), allowed, k)
            write_csv(stations / f"{k:03}.csv", points)
        made = subprocess.run([OBVID, "surface", "skin", *sorted(stations.iterdir()), "--spacing", "0.05",
                               "--noise", "0.0005", "--units", "m", "--chord-tolerance",
                               "0.0002", "-o", self.at / "fair.stl",
                               "-o", self.at / "fair.json"], capture_output=True, text=True)
        self.assertEqual(made.returncode, 0, made.stderr)
        hull = stl_corners(self.at / "fair.stl")  # (y, z, station)
        self.assertGreater(len(hull), 1000)
        self.assertAlmostEqual(hull[:, 2].max() - hull[:, 2].min(), 199 * 0.05, 5)
        off = from_wigley(hull[:, 2] - hull[:, 2].min() - 4.975, hull[:, 0], hull[:, 1])
        self.assertLess(off.max(), allowed + 0.0005 + 0.0002)  # moved again, and chords
        heights = hull[:, 1]
        self.assertAlmostEqual(heights.min(), -0.625, 2)
        self.assertAlmostEqual(heights.max(), 0.0, 2)

    # ---- jobs ----

    def test_every_job_fills_its_columns(self):
        folder = self.at / "in"
        folder.mkdir()
        write_csv(folder / "a.csv", spiral(10))
        self.assertEqual(self.rows(folder, "--job", "analyse")["bound"][0], 0)
        self.assertGreater(self.rows(folder, "--job", "region")["width"][0], 0)
        compared = self.rows(folder, "--job", "compare")
        self.assertEqual(compared["arcs_code"][0], 0)
        self.assertGreater(compared["baseline_pieces"][0], 0)
        self.assertGreaterEqual(self.rows(folder, "--job", "suggest")["vertices_8"][0], 0)
        screw = np.column_stack([spiral(10), np.linspace(0.0, 40.0, 10)])
        write_csv(self.at / "screw.csv", screw, "x,y,z")
        in_space = self.rows(self.at / "screw.csv", "--job", "space")
        self.assertEqual(in_space["points"][0], 20)  # of projection and heights
        self.assertEqual(in_space["proved"][0], 1)
        self.assertEqual(self.rows(folder, "--job", "space")["code"][0], 203)
        made = self.at / "made"
        self.rows(folder, "--each", made / "{number}.json", "--reports", made / "r{number}.json")
        json.loads((made / "r0.json").read_text())
        self.assertEqual(self.rows(made / "0.json", "--job", "verify")["proved"][0], 1)
        self.rows(made / "0.json", "--job", "convert", "--each", made / "{number}.step")
        self.assertIn("ISO-10303-21", (made / "0.step").read_text())

    def single(self, *words):
        """Runs the command on one file, as a user does."""
        done = subprocess.run([OBVID, *map(str, words)], capture_output=True, text=True, env=ENVIRONMENT)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def same_files(self, job, source, options, endings):
        """The files and the report of a batch are those of the command, byte for byte."""
        made, alone = self.at / "made", self.at / "alone"
        alone.mkdir(exist_ok=True)
        each = [w for e in endings for w in ("--each", made / ("{number}" + e))]
        row = self.rows(source, "--job", job, *options, *each, "--reports", made / "{number}.report")
        self.assertEqual(row["code"][0], 0, row["message"][0])
        outputs = [w for e in endings for w in ("-o", alone / ("0" + e))]
        done = subprocess.run([OBVID, *map(str, (job, source, *options, *outputs, "--json"))], capture_output=True, text=True, env=ENVIRONMENT)
        self.assertEqual(done.returncode, 0, done.stderr)
        report = done.stdout
        warned = re.findall("^obvid: warning: (.*)$", done.stderr, re.MULTILINE)
        self.assertEqual(row["warnings"][0], "; ".join(warned).encode()[:300].decode(errors="ignore"), job)
        for ending in endings:
            self.assertEqual((made / ("0" + ending)).read_bytes(), (alone / ("0" + ending)).read_bytes(), ending)
        self.assertEqual(json.loads((made / "0.report").read_text()), json.loads(report))
        return {name: column[0] for name, column in row.items()}, json.loads(report)

    def test_alignments_cuts_comparisons_and_splines_make_the_files_of_their_commands(self):
        way = np.array([(x, 0.0) for x in np.linspace(0, 200, 21)]
                       + [(200 + 300 * math.sin(t), 300 - 300 * math.cos(t)) for t in np.linspace(0.03, 1, 30)])
        road = self.at / "road.csv"
        write_csv(road, way, "x_m,y_m")
        row, report = self.same_files("alignment", road, ["--noise", "0.001"],
                                      [".json", ".xml", ".xodr", ".dxf", ".csv", ".svg"])
        self.assertEqual((row["lines"], row["arcs"], row["transitions"]), (1, 1, 0))
        self.assertAlmostEqual(row["length"], 500.0, places=2)
        self.assertEqual(row["pieces"], 2)
        self.assertLessEqual(row["move"], 0.001)
        self.rows(road, "--job", "alignment", "--noise", "0.001", "--each",
                  self.at / "made/{number}.deviations.csv")
        self.single("alignment", road, "--noise", "0.001", "--deviations", self.at / "alone.csv")
        self.assertEqual((self.at / "made/0.deviations.csv").read_bytes(), (self.at / "alone.csv").read_bytes())

        sheet = self.at / "sheet.svg"
        sheet.write_text('<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">'
                         '<circle cx="50" cy="50" r="40"/><circle cx="50" cy="50" r="10"/></svg>')
        row, report = self.same_files("cut", sheet, ["--depth", "2", "--diameter", "4", "--feed", "600"],
                                      [".nc", ".svg", ".dxf"])
        self.assertEqual(row["outlines"], 2)
        self.assertEqual(row["blocks"], report["report"]["blocks"])
        self.assertEqual(row["minutes"], report["report"]["minutes"])

        first, second = self.at / "first.csv", self.at / "second.csv"
        arc = spiral(40)
        write_csv(first, arc)
        write_csv(second, arc + [0.0, 0.25])
        row, report = self.compared(first, second)
        largest = report["as_they_lie"][0]["largest"]
        self.assertEqual((row["deviation"], row["x"], row["y"]),
                         (largest["deviation"], largest["x"], largest["y"]))
        self.assertGreater(abs(row["deviation"]), 0.2)
        self.assertLessEqual(abs(row["deviation"]), 0.25 + 1e-9)

        table_file = self.at / "table.csv"
        write_csv(table_file, [(x, x**2) for x in range(6)], "x,f")
        row, report = self.same_files("spline", table_file, ["--samples", "11"], [".csv", ".json", ".svg", ".dxf"])
        self.assertAlmostEqual(row["integral"], 5**3 / 3, places=9)
        grid = self.at / "grid.csv"
        write_csv(grid, [(x, y, x + y * y) for y in range(4) for x in range(3)], "x,y,f")
        row, report = self.same_files("spline", grid, [], [".csv", ".json", ".stl"])
        self.assertEqual(row["points"], 12)
        self.assertAlmostEqual(row["integral"], 2 * 3 + 2 * 9, places=9)

        control = self.at / "control.csv"
        write_csv(control, [(0, 0), (1, 2), (3, 2), (4, 0), (6, 1)])
        row, report = self.same_files("nurbs", control, ["--degree", "2", "--weight-at", "3=2", "--move", "2=0.5"],
                                      [".csv", ".json", ".dxf"])
        self.assertEqual((row["points"], row["degree"], row["degree_v"]), (5, 2, -1))
        net = self.at / "net.csv"
        write_csv(net, [(i, k, i, k, i * k) for i in range(3) for k in range(3)], "row,col,x,y,z")
        row, report = self.same_files("nurbs", net, ["--degree", "2", "--degree-v", "1"], [".json", ".stl"])
        self.assertEqual((row["points"], row["degree"], row["degree_v"]), (9, 2, 1))

    def compared(self, first, second):
        made = self.at / "made"
        row = self.rows(second, "--job", "compare", "--against", first, "--each", made / "{number}.svg",
                        "--each", made / "{number}.csv", "--reports", made / "{number}.json")
        report = self.single("compare", first, second, "-o", self.at / "c.svg", "-o", self.at / "c.csv", "--json")
        for ending in (".svg", ".csv"):
            self.assertEqual((made / ("0" + ending)).read_bytes(), (self.at / ("c" + ending)).read_bytes())
        self.assertEqual(json.loads((made / "0.json").read_text()), json.loads(report))
        return {name: column[0] for name, column in row.items()}, json.loads(report)

    def test_points_of_arrays_become_the_tables_of_splines_and_heights_of_alignments(self):
        ragged(self.at / "f.h5", [np.column_stack([np.arange(6.0), np.arange(6.0) ** 2])])
        self.assertAlmostEqual(self.rows(self.at / "f.h5", "--job", "spline")["integral"][0], 125 / 3, places=9)
        self.assertEqual(self.rows(self.at / "f.h5", "--job", "nurbs")["points"][0], 6)
        way = np.column_stack([np.arange(0, 200, 10.0), np.zeros(20), np.arange(20.0)])
        ragged(self.at / "w.h5", [way])
        made = self.at / "made/{number}.profile.csv"
        row = self.rows(self.at / "w.h5", "--job", "alignment", "--noise", "0.01", "--each", made)
        self.assertEqual((row["code"][0], row["lines"][0]), (0, 1))
        self.assertIn("grade", (self.at / "made/0.profile.csv").read_text())

    def test_heights_of_every_road_are_those_of_the_file_of_its_name(self):
        roads, levels = self.at / "roads", self.at / "levels"
        roads.mkdir()
        levels.mkdir()
        for name, grade in (("a.csv", 0.02), ("b.csv", -0.01)):
            write_csv(roads / name, [(10.0 * k, 0.0) for k in range(20)])
            write_csv(levels / name, [(10.0 * k, 10.0 * grade * k) for k in range(20)], "station,height")
        write_csv(roads / "c.csv", [(10.0 * k, 0.0) for k in range(20)])  # without heights
        made = self.at / "made/{number}.profile.csv"
        rows = self.rows(roads, "--job", "alignment", "--noise", "0.01", "--profile", levels / "{name}",
                         "--profile-noise", "0.001", "--each", made)
        self.assertEqual([int(code) for code in rows["code"]], [0, 0, 301])
        for number, grade in ((0, 0.02), (1, -0.01)):
            head, row = [line.split(",") for line in (self.at / f"made/{number}.profile.csv").read_text().splitlines()[:2]]
            self.assertAlmostEqual(float(row[head.index("grade_start_percent")]), 100 * grade, places=6)
        self.assertIn("E203", batch(roads, "-o", self.out, "--profile", levels / "a.csv", code=2))

    def test_items_are_held_against_a_file_that_counts_as_a_source(self):
        first = self.at / "first.csv"
        write_csv(first, spiral(40))
        write_csv(self.at / "second.csv", spiral(30))
        words = (self.at / "second.csv", "-o", self.out, "--job", "compare")
        self.assertIn("E301", batch(*words, "--against", self.at / "none.csv", code=3))
        self.assertIn("--against", batch(*words, "--each", self.at / "{id}.svg", code=2))
        self.assertIn("E202", batch(*words, "--against", first, "--each", self.at / "{id}.step", code=2))
        self.assertIn("E203", batch(self.at, "-o", self.out, "--against", first, code=2))
        self.assertIn("E203", batch(self.at, "-o", self.out, "--job", "cut", code=2))  # no depth
        self.assertIn("E201", batch(self.at, "-o", self.out, "--job", "cut", "--carrier", "arcs", code=2))
        self.assertIn("E203", batch(self.at, "-o", self.out, "--job", "spline", "--degree", "3", code=2))
        batch(*words, "--against", first)
        self.assertIn("nothing is left", batch(*words, "--against", first))
        write_csv(first, spiral(40) + 1.0)
        self.assertNotIn("nothing is left", batch(*words, "--against", first))

    def test_names_of_members_never_leave_the_folder_of_files(self):
        with zipfile.ZipFile(self.at / "evil.zip", "w") as archive:
            write_csv(self.at / "p.csv", spiral(8))
            for name in ("../../evil", "/tmp/evil", "a/../../b", "..", "x%2Fy"):
                archive.write(self.at / "p.csv", name)
        self.rows(self.at / "evil.zip", "--each", self.at / "made/{id}.json")
        files = sorted(p.relative_to(self.at) for p in self.at.rglob("*.json"))
        self.assertEqual(len(files), 5 if len(table(self.out)["id"]) == 5 else len(table(self.out)["id"]))
        self.assertTrue(all(f.parent == pathlib.Path("made") for f in files), files)

    # ---- the same whatever happens ----

    def many(self, count=400):
        source = self.at / "many.h5"
        points = series(count)
        points[17] = np.array([(0.0, 0.0), (math.nan, 1.0), (2.0, 2.0)])
        points[333 % count] = np.empty((0, 2))
        ragged(source, points)
        return source

    def reference(self, source):
        reference = self.at / "reference.h5"
        batch(source, "-o", reference, "--jobs", 1, "--shard-size", 37)
        return reference.read_bytes()

    def test_the_same_bytes_for_any_number_of_workers_and_size_of_shards(self):
        source = self.many()
        wanted = self.reference(source)
        for jobs, size in ((2, 37), (4, 37), (2, 1000), (3, 1)):
            out = self.at / f"out-{jobs}-{size}.h5"
            batch(source, "-o", out, "--jobs", jobs, "--shard-size", size)
            self.assertEqual(out.read_bytes(), wanted, (jobs, size))
            self.assertFalse(pathlib.Path(f"{out}.parts").exists())

    def test_parts_in_any_order_and_merged_are_the_same_bytes(self):
        source = self.many()
        wanted = self.reference(source)
        parts = [1, 2, 3, 4, 5]
        random.Random(1).shuffle(parts)
        for i in parts[:-1]:
            batch(source, "-o", self.out, "--shard-size", 37, "--shard", f"{i}/5")
        self.assertIn("shards are missing", batch("-o", self.out, "--merge", code=3))
        batch(source, "-o", self.out, "--shard-size", 37,
              env={"SLURM_ARRAY_TASK_ID": str(parts[-1] + 9), "SLURM_ARRAY_TASK_MIN": "10",
                   "SLURM_ARRAY_TASK_MAX": "14", "SLURM_ARRAY_TASK_STEP": "1"})
        batch("-o", self.out, "--merge")
        self.assertEqual(self.out.read_bytes(), wanted)
        for rank in (1, 0):
            batch(source, "-o", self.at / "mpi.h5", "--shard-size", 37,
                  env={"OMPI_COMM_WORLD_RANK": str(rank), "OMPI_COMM_WORLD_SIZE": "2"})
        batch("-o", self.at / "mpi.h5", "--merge")
        self.assertEqual((self.at / "mpi.h5").read_bytes(), wanted)

    def test_killed_at_twenty_random_moments_it_goes_on_and_nothing_is_lost_or_done_twice(self):
        source = self.many(1500)
        began = time.monotonic()
        wanted = self.reference(source)
        whole = time.monotonic() - began
        rng = random.Random(11)
        parts = pathlib.Path(f"{self.out}.parts")
        kills, kept = 0, {}
        while kills < 20:
            process = subprocess.Popen([OBVID, "batch", source, "-o", self.out, "--jobs", "2",
                                        "--shard-size", "37", "--quiet"], env=ENVIRONMENT)
            try:
                process.wait(rng.uniform(0.0, whole / 6))
                self.assertEqual(process.returncode, 0)
                # it was through: begin again
                self.assertEqual(self.out.read_bytes(), wanted)
                for left in (self.out, self.at / "out.sqlite"):
                    left.unlink()
                kept = {}
                continue
            except subprocess.TimeoutExpired:
                process.send_signal(signal.SIGKILL)
                process.wait()
                kills += 1
            # what was whole stays as it is: it is not done again. Shards without a batch are what was
            # being removed behind a whole table: the next batch begins without them
            begun = (parts / "batch.json").exists()
            now = {p.name: p.stat().st_mtime_ns for p in parts.glob("shard-*[0-9].h5")} if begun else {}
            for name, when in kept.items():
                if name in now:
                    self.assertEqual(now[name], when)
            kept = now
        batch(source, "-o", self.out, "--shard-size", 37)
        self.assertEqual(self.out.read_bytes(), wanted)
        self.assertEqual(table(self.out)["id"], [str(i) for i in range(1500)])
        self.assertFalse(parts.exists())

    def test_stopped_by_a_signal_it_says_so_and_goes_on(self):
        source = self.many(3000)
        process = subprocess.Popen([OBVID, "batch", source, "-o", self.out, "--shard-size", "37"],
                                   stderr=subprocess.PIPE, text=True, env=ENVIRONMENT)
        while not list(self.at.glob("out.h5.parts/shard-*[0-9].h5")):
            self.assertIsNone(process.poll())
            time.sleep(0.002)
        process.send_signal(signal.SIGINT)
        said = process.communicate()[1]
        self.assertEqual(process.returncode, 1)
        self.assertIn("E103", said)
        self.assertIn("goes on", batch(source, "-o", self.out, "--shard-size", 37))

    def test_another_batch_does_not_mix_with_one_that_began(self):
        source = self.many()
        batch(source, "-o", self.out, "--shard", "1/2", "--shard-size", 37)
        said = batch(source, "-o", self.out, "--shard-size", 37, "--noise", "0.1", code=2)
        self.assertIn("other options", said)
        os.utime(source, (1, 1))
        said = batch(source, "-o", self.out, "--shard-size", 37, code=2)
        self.assertIn("changed", said)

    def test_what_is_done_is_not_done_again(self):
        source = self.many()
        batch(source, "-o", self.out)
        before = self.out.stat().st_mtime_ns
        self.assertIn("nothing is left to do", batch(source, "-o", self.out))
        self.assertEqual(self.out.stat().st_mtime_ns, before)

    # ---- answers ----

    def test_the_index_answers_questions(self):
        source = self.many()
        said = batch(source, "-o", self.out)
        self.assertIn("E303", said)
        rows = table(self.out)
        base = sqlite3.connect(self.at / "out.sqlite")
        above = base.execute("SELECT number FROM items WHERE vertices > bound").fetchall()
        wanted = np.flatnonzero((rows["vertices"] > rows["bound"]) & (rows["bound"] >= 0))
        self.assertEqual([n for n, in above], wanted.tolist())
        self.assertIsNone(base.execute("SELECT vertices FROM items WHERE number = 17").fetchone()[0])
        plan = base.execute("EXPLAIN QUERY PLAN SELECT * FROM items WHERE vertices > bound").fetchall()
        self.assertIn("items_above", str(plan))
        said = batch("query", self.out, "code <> 0", "--csv", "--columns", "id,code")
        self.assertEqual(said.split(), ["id,code", "17,303", "333,304"])
        for evil in ("1); DROP TABLE items; --", "1; DROP TABLE items", "nonsense"):
            self.assertIn("E203", batch("query", self.out, evil, code=2))
        self.assertEqual(base.execute("SELECT count(*) FROM items").fetchone()[0], 400)
        with h5py.File(self.at / "out.seconds.h5") as file:
            self.assertTrue((file["seconds"][...] > 0).all())
        self.assertIn("<svg", (self.at / "out.svg").read_text())

    def test_progress_and_summary_are_told(self):
        said = batch(self.many(), "-o", self.out)
        self.assertRegex(said, r"items +400 +100.0 %")
        self.assertRegex(said, r"failed +2 ")
        self.assertEqual(batch(self.many(), "-o", self.at / "q.h5", "--quiet"), "")


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0], *sys.argv[3:]], verbosity=2)
