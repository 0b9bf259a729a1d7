#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Vertical profiles of `obvid alignment`: heights made here by the textbook's parabolas, the files
read here and judged by the judges of LandXML and OpenDRIVE. Shares nothing with the program.

usage: profile_test.py PROGRAM
"""
import csv
import io
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
TESTS = pathlib.Path(__file__).resolve().parent.parent
# station and height of the corners of the grades, length of the parabola there
CORNERS = [(0, 100, 0), (180, 105.4, 90), (330, 99.4, 120), (500, 104.5, 0)]


def height(s):
    for a, b, c in zip(CORNERS, CORNERS[1:], CORNERS[2:]):
        g0, g1 = (b[1] - a[1]) / (b[0] - a[0]), (c[1] - b[1]) / (c[0] - b[0])
        x = s - (b[0] - b[2] / 2)
        if x < 0:
            return b[1] + g0 * (s - b[0])
        if x <= b[2]:
            return b[1] - b[2] / 2 * g0 + g0 * x + (g1 - g0) * x * x / (2 * b[2])
    a, b = CORNERS[-2:]
    return b[1] + (b[1] - a[1]) / (b[0] - a[0]) * (s - b[0])


def bend(s):
    """A line of 200 m and an arc of radius 250 m."""
    if s <= 200:
        return s, 0.0
    return 200 + 250 * math.sin((s - 200) / 250), 250 * (1 - math.cos((s - 200) / 250))


class Profile(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        noise = random.Random(3)
        rows = [(*bend(5 * i), height(5 * i) + noise.gauss(0, 0.002)) for i in range(101)]
        self.at("survey.csv").write_text("x,y,z\n" + "".join(f"{x:.5f},{y:.5f},{z:.4f}\n" for x, y, z in rows))

    def at(self, name):
        return pathlib.Path(self.folder.name) / name

    def run_alignment(self, *words, code=0):
        done = subprocess.run([PROGRAM, "alignment", *map(str, words)], capture_output=True, text=True, timeout=120,
                              cwd=self.folder.name, check=False)
        self.assertEqual(done.returncode, code, done.stderr)
        return done

    def judged(self, judge, name):
        done = subprocess.run([sys.executable, "-B", TESTS / "exchange" / judge, self.at(name)], capture_output=True,
                              text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (0, ""), done.stderr)

    def elevation(self, name, station):
        rows = [{k: float(v) for k, v in node.attrib.items()}
                for node in xml.etree.ElementTree.parse(self.at(name)).iter("elevation")]
        row = [row for row in rows if row["s"] <= station][-1]
        x = station - row["s"]
        return row["a"] + x * (row["b"] + x * (row["c"] + x * row["d"]))

    def test_grades_and_parabolas_of_the_column_z(self):
        done = self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", 0.008, "--json",
                                  "-o", "r.xml", "-o", "r.xodr", "--profile-table", "p.csv", "--deviations", "d.csv")
        found = json.loads(done.stdout)["profile"]
        self.assertEqual([e["kind"] for e in found["elements"]], ["grade", "crest", "grade", "sag", "grade"])
        for e, corner in zip(found["elements"][1::2], CORNERS[1:]):
            self.assertAlmostEqual(e["pvi_station"], corner[0], delta=1.0)
            self.assertAlmostEqual(e["pvi_height"], corner[1], delta=0.03)
            self.assertAlmostEqual(e["length"], corner[2], delta=6.0)
        self.assertLessEqual(max(abs(d["offset"]) for d in found["deviations"]), 0.008)
        self.judged("check_landxml.py", "r.xml")
        self.judged("check_opendrive.py", "r.xodr")
        for s in range(0, 500, 7):
            self.assertAlmostEqual(self.elevation("r.xodr", s), height(s), delta=0.008)
        rows = list(csv.DictReader(io.StringIO(self.at("p.csv").read_text())))
        self.assertEqual([row["kind"] for row in rows], ["grade", "crest", "grade", "sag", "grade"])
        self.assertAlmostEqual(float(rows[0]["grade_end_percent"]), 3.0, delta=0.02)
        offsets = list(csv.DictReader(io.StringIO(self.at("d.csv").read_text())))
        self.assertEqual(len(offsets), 101)
        for row in offsets:
            # offsets are upwards positive: of the given height above the profile
            profile = self.elevation("r.xodr", max(0.0, min(float(row["station"]), 499.999)))
            self.assertAlmostEqual(float(row["height"]) - profile, float(row["height_offset"]), delta=1e-4)

    def test_heights_of_a_file_with_stations_and_feet(self):
        lines = [f"{1000 + 10 * i} {height(10 * i):.4f}" for i in range(51)]
        self.at("levels.txt").write_text("\n".join(lines) + "\n")
        self.run_alignment("survey.csv", "--noise", 0.001, "--units", "ft", "--station", 1000, "--profile", "levels.txt",
                           "--profile-noise", 0.001, "-o", "r.xml", "-o", "r.xodr", "-q")
        self.judged("check_landxml.py", "r.xml")
        self.judged("check_opendrive.py", "r.xodr")
        foot = 0.3048
        for s in range(0, 500, 9):
            self.assertAlmostEqual(self.elevation("r.xodr", s * foot), height(s) * foot, delta=0.001)
        pvis = [tuple(map(float, node.text.split())) for node in xml.etree.ElementTree.parse(self.at("r.xml")).iter(
            "{http://www.landxml.org/schema/LandXML-1.2}ParaCurve")]
        for pvi, corner in zip(pvis, CORNERS[1:]):
            self.assertAlmostEqual(pvi[0], 1000 + corner[0], delta=0.3)
            self.assertAlmostEqual(pvi[1], corner[1], delta=0.01)

    def test_arcs_in_place_of_parabolas(self):
        self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", 0.02, "--profile-curves",
                           "arcs", "-o", "r.xml", "-o", "r.xodr", "-q")
        self.judged("check_landxml.py", "r.xml")
        self.judged("check_opendrive.py", "r.xodr")
        for s in range(0, 500, 7):
            self.assertAlmostEqual(self.elevation("r.xodr", s), height(s), delta=0.02)
        # read again: the same arcs, of which the cubics of the file are within a millionth
        subprocess.run([PROGRAM, "convert", "r.xodr", "-o", "again.json", "-q"], cwd=self.folder.name, check=True,
                       capture_output=True)
        profile = json.loads(self.at("again.json").read_text())["alignment"]["profile"]
        self.assertEqual(profile["curves"], "arcs")
        for e in profile["elements"]:
            self.assertAlmostEqual(e["height"], self.elevation("r.xodr", e["station"]), delta=2e-6)
            if e["kind"] == "grade":
                continue
            # sin a1 - sin a0 = length / radius
            sines = [math.sin(math.atan(e[g])) for g in ("grade_start", "grade_end")]
            self.assertAlmostEqual(e["radius"] * (sines[1] - sines[0]) / e["length"], 1.0, delta=1e-9)

    def test_noise_that_is_estimated_is_told(self):
        done = self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", "auto")
        said = [line for line in done.stdout.splitlines() if "--profile-noise auto" in line]
        self.assertEqual(len(said), 1)
        deviation = float(said[0].split("scatter of ")[1].split()[0])
        self.assertAlmostEqual(deviation, 0.002, delta=0.0007)  # of 100 normal errors

    def test_the_judges_see_a_step(self):
        self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", 0.008, "-o", "r.xodr",
                           "-o", "r.xml", "-q")
        tree = xml.etree.ElementTree.parse(self.at("r.xodr"))
        second = list(tree.iter("elevation"))[1]
        second.set("a", str(float(second.get("a")) + 0.001))
        tree.write(self.at("broken.xodr"))
        with self.assertRaises(AssertionError):
            self.judged("check_opendrive.py", "broken.xodr")
        text = self.at("r.xml").read_text().replace('ParaCurve length="', 'ParaCurve length="9')
        self.at("broken.xml").write_text(text)
        with self.assertRaises(AssertionError):
            self.judged("check_landxml.py", "broken.xml")

    def test_a_contour_file_makes_the_same_road_files(self):
        self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", 0.008, "--station", 1000,
                           "-o", "r.json", "-o", "r.xml", "-o", "r.xodr", "-q")
        subprocess.run([PROGRAM, "convert", "r.json", "-o", "again.xml", "-o", "again.xodr"], cwd=self.folder.name,
                       check=True, capture_output=True)
        for ending in ("xml", "xodr"):
            self.assertEqual(self.at(f"again.{ending}").read_text(), self.at(f"r.{ending}").read_text())
        stored = json.loads(self.at("r.json").read_text())["alignment"]
        self.assertEqual(stored["first_station"], 1000)
        # by the textbook, where the corners are
        curves = [e for e in stored["profile"]["elements"] if e["kind"] != "grade"]
        self.assertEqual([e["kind"] for e in curves], ["crest", "sag"])
        for e, (station, _, length) in zip(curves, CORNERS[1:3]):
            self.assertAlmostEqual(e["station"] + e["length"] / 2, 1000 + station, delta=4)
            self.assertAlmostEqual(e["length"], length, delta=12)

    def test_false_transitions_of_a_contour_file_are_found(self):
        length, radius = 100.0, 250.0  # Bloss into an arc: its heading by the closed form u^3 - u^4 / 2
        rows, x, y, steps = [], 0.0, 0.0, 4000
        for k in range(steps + 1):
            if k % 200 == 0:
                rows.append((x, y))
            u = (k + 0.5) / steps
            turn = length / radius * (u ** 3 - u ** 4 / 2)
            x, y = x + length / steps * math.cos(turn), y + length / steps * math.sin(turn)
        self.at("b.csv").write_text("x,y\n" + "".join(f"{a - 60},0\n" for a in range(0, 60, 5)) +
                                    "".join(f"{a:.6f},{b:.6f}\n" for a, b in rows))
        self.run_alignment("b.csv", "--units", "m", "--noise", 0.002, "--transitions", "bloss", "-o", "b.json", "-q")
        stored = json.loads(self.at("b.json").read_text())
        self.assertEqual([t["kind"] for t in stored["alignment"]["transitions"]], ["bloss"])

        def verified(change):
            changed = json.loads(json.dumps(stored))
            change(changed["alignment"]["transitions"][0])
            self.at("c.json").write_text(json.dumps(changed))
            done = subprocess.run([PROGRAM, "verify", "c.json"], capture_output=True, text=True, cwd=self.folder.name,
                                  check=False)
            return done.returncode, done.stdout + done.stderr

        self.assertEqual(verified(lambda t: None)[0], 0)
        for name, value in (("kind", "sine"), ("length", 90.0), ("kappa_end", 0.005)):
            code, said = verified(lambda t: t.update({name: value}))
            self.assertEqual(code, 5, name)
            self.assertIn("E503", said)
        for name, value in (("pieces", 1000), ("first_piece", 0), ("kind", "curl"), ("length", -1.0),
                            ("length", 1e300), ("kappa_end", 1e6)):
            code, said = verified(lambda t: t.update({name: value}))
            self.assertEqual(code, 3, name)
            self.assertIn("/alignment/transitions/0", said)

    def test_a_contour_file_that_is_placed_anew_keeps_its_profile(self):
        self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", 0.008, "--station", 1000,
                           "-o", "r.json", "-q")
        subprocess.run([PROGRAM, "convert", "r.json", "--scale", "2", "-o", "twice.xodr"], cwd=self.folder.name,
                       check=True, capture_output=True)
        stored = json.loads(self.at("r.json").read_text())["alignment"]["profile"]
        twice = list(xml.etree.ElementTree.parse(self.at("twice.xodr")).iter("elevation"))
        self.assertEqual(len(twice), len(stored["elements"]))
        for written, element in zip(twice, stored["elements"]):
            self.assertAlmostEqual(float(written.get("s")), 2 * (element["station"] - 1000), delta=1e-6)
            self.assertAlmostEqual(float(written.get("a")), 2 * element["height"], delta=1e-6)

    def test_a_profile_with_gaps_is_refused(self):
        self.run_alignment("survey.csv", "--units", "m", "--noise", 0.001, "--profile-noise", 0.008, "-o", "r.json", "-q")
        stored = json.loads(self.at("r.json").read_text())

        def refused(change):
            changed = json.loads(json.dumps(stored))
            change(changed["alignment"]["profile"])
            self.at("c.json").write_text(json.dumps(changed))
            for how in (["verify", "c.json"], ["convert", "c.json", "-o", "c.xml"]):
                done = subprocess.run([PROGRAM, *how], capture_output=True, text=True, cwd=self.folder.name, check=False)
                self.assertEqual(done.returncode, 3, done.stdout)
                self.assertIn("/alignment/profile", done.stderr)
            self.assertFalse(self.at("c.xml").exists())

        refused(lambda p: p["elements"].pop(1))
        refused(lambda p: p["elements"][1].update(height=p["elements"][1]["height"] + 1))
        refused(lambda p: p["elements"][0].update(length=1e300))
        refused(lambda p: p.update(end_station=-5))

    def test_what_is_no_profile_is_refused(self):
        self.at("back.csv").write_text("0,1\n10,2\n5,3\n")
        self.assertIn("ascend", self.run_alignment("survey.csv", "--profile", "back.csv", code=4).stderr)
        self.at("flat.csv").write_text("x,y\n0,0\n5,0\n10,0\n")
        refused = self.run_alignment("flat.csv", "--noise", 0.01, "--profile-table", "p.csv", code=2).stderr
        self.assertIn("--profile", refused)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
