#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Drawings of several curves, written by ezdxf, through `convert --curve all` to one file: ezdxf finds
no fault in it and the layers and lengths that it drew.

usage: together_test.py PROGRAM
"""
import collections
import csv
import io
import math
import pathlib
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import ezdxf

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
CLOSE = 1e-9  # of lengths
SVG = "{http://www.w3.org/2000/svg}"
INKSCAPE = "{http://www.inkscape.org/namespaces/inkscape}"


def arc_of(chord, bulge):
    """Length of a polyline's arc."""
    turn = 4.0 * math.atan(abs(bulge))
    return chord if turn == 0.0 else turn * chord / (2.0 * math.sin(0.5 * turn))


# layer, what draws it, its length; None: no closed form
CURVES = [
    ("HOLES", lambda m, a: m.add_circle((10, 20), 5, dxfattribs=a), 10.0 * math.pi),
    ("HOLES", lambda m, a: m.add_arc((30, 20), 5, 30, 290, dxfattribs=a), 5.0 * math.radians(260.0)),
    ("EDGE", lambda m, a: m.add_lwpolyline([(0, 0), (60, 0), (60, 40), (0, 40)], close=True, dxfattribs=a), 200.0),
    ("Außen kante 2", lambda m, a: m.add_lwpolyline([(0, 50, 0.3), (80, 50, 0), (80, 90, -0.5), (0, 90, 0)], format="xyb",
                                                    close=True, dxfattribs=a),
     arc_of(80, 0.3) + arc_of(80, 0.5) + 80.0),
    # touches the outline above: on its layer it would be a place where three ends meet
    ("EDGE", lambda m, a: m.add_line((60, 40), (90, 80), dxfattribs=a), 50.0),
    ("0", lambda m, a: m.add_ellipse((200, 0), (40, 10), 0.5, 0.3, 2.4, dxfattribs=a), None),
    ("0", lambda m, a: m.add_open_spline([(0, 200), (20, 220), (50, 190), (80, 210), (90, 240)], dxfattribs=a), None),
]


def drawing(path, curves=None, units=4):
    document = ezdxf.new("R2010")
    document.units = units
    for layer, draw, _ in curves or CURVES:
        if layer not in document.layers:
            document.layers.add(layer)
        draw(document.modelspace(), {"layer": layer})
    document.saveas(path)


class Together(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.at = pathlib.Path(folder.name)

    def run_program(self, *args):
        done = subprocess.run([PROGRAM, *args], cwd=self.at, capture_output=True, text=True)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def listed(self, name):
        """(length, layer) of what `analyse` finds."""
        rows = list(csv.DictReader(io.StringIO(self.run_program("analyse", name, "--csv"))))
        return [(float(row["length"]), row["layer"]) for row in rows]

    def same_curves(self, found, drawn):
        self.assertEqual(len(found), len(drawn))
        for (a, _), (b, _) in zip(sorted(found), sorted(drawn)):
            self.assertLessEqual(abs(a - b), CLOSE * b)

    def dxf(self, name):
        document = ezdxf.readfile(self.at / name)
        auditor = document.audit()
        self.assertEqual([entry.message for entry in auditor.errors + auditor.fixes], [])
        return document

    def test_every_profile_keeps_layers_unit_and_curves(self):
        drawing(self.at / "d.dxf", units=5)
        for profile in ("exact", "arcs", "cubic", "r12"):
            self.run_program("convert", "d.dxf", "--curve", "all", "--dxf", profile, "-o", "out.dxf")
            document = self.dxf("out.dxf")
            entities = list(document.modelspace())
            if profile != "cubic":  # corners cut splines
                self.assertEqual(len(entities), len(CURVES), profile)
            if profile == "r12":
                names = {"HOLES", "EDGE", "Au__en_kante_2", "0"}
                self.assertEqual({e.dxf.layer for e in entities}, names)
            else:
                self.assertEqual(document.units, 5, profile)
                self.assertEqual({e.dxf.layer for e in entities}, {layer for layer, _, _ in CURVES}, profile)
            for entity in entities:
                self.assertIn(entity.dxf.layer, document.layers)

    def test_exact_curves_stay_exact(self):
        drawing(self.at / "d.dxf")
        self.run_program("convert", "d.dxf", "--curve", "all", "-o", "out.dxf")
        kinds = collections.Counter(e.dxftype() for e in self.dxf("out.dxf").modelspace())
        self.assertEqual(kinds, {"CIRCLE": 1, "ARC": 1, "LWPOLYLINE": 2, "LINE": 1, "ELLIPSE": 1, "SPLINE": 1})
        found = self.listed("out.dxf")
        self.same_curves(found, self.listed("d.dxf"))
        for layer, _, length in CURVES:
            if length is not None:
                self.assertTrue(any(abs(one - length) <= CLOSE * length and where == layer for one, where in found),
                                (layer, length, found))

    def test_formed_contours_are_on_the_layers_of_their_points(self):
        drawing(self.at / "d.dxf", CURVES[:5])
        self.run_program("fit", "d.dxf", "--curve", "all", "-o", "out.dxf")
        layers = [e.dxf.layer for e in self.dxf("out.dxf").modelspace()]
        self.assertEqual(layers, [layer for layer, _, _ in CURVES[:5]])

    def test_more_layers_than_handles_of_tables(self):
        curves = [(f"L{i}", lambda m, a, i=i: m.add_line((0, i), (10, i), dxfattribs=a), 10.0) for i in range(300)]
        drawing(self.at / "d.dxf", curves)
        self.run_program("convert", "d.dxf", "--curve", "all", "-o", "out.dxf")
        document = self.dxf("out.dxf")
        self.assertEqual({e.dxf.layer for e in document.modelspace()}, {f"L{i}" for i in range(300)})
        handles = [e.dxf.handle for e in document.layers] + [e.dxf.handle for e in document.modelspace()]
        self.assertEqual(len(set(handles)), len(handles))

    def test_ids_of_svg_are_layers_of_dxf(self):
        (self.at / "d.svg").write_text(
            "<svg xmlns='http://www.w3.org/2000/svg' width='100mm' height='100mm' viewBox='0 0 100 100'>"
            "<circle id='a:b' cx='50' cy='50' r='20'/><circle id='a|b' cx='50' cy='50' r='30'/>"
            "<rect id='rim' x='5' y='5' width='90' height='90'/></svg>")
        self.run_program("convert", "d.svg", "--curve", "all", "-o", "out.dxf")
        layers = {e.dxf.layer for e in self.dxf("out.dxf").modelspace()}
        self.assertEqual(layers, {"a_b", "a_b_2", "rim"})
        self.same_curves(self.listed("out.dxf"), [(40.0 * math.pi, ""), (60.0 * math.pi, ""), (360.0, "")])

    def test_paths_of_svg_have_ids_and_inkscapes_layers(self):
        drawing(self.at / "d.dxf")
        self.run_program("convert", "d.dxf", "--curve", "all", "-o", "out.svg")
        root = xml.etree.ElementTree.parse(self.at / "out.svg").getroot()
        paths = list(root.iter(SVG + "path"))
        self.assertEqual(len(paths), len(CURVES))
        ids = [e.get("id") for e in root.iter() if e.get("id")]
        self.assertEqual(len(set(ids)), len(ids))
        layers = [e.get(INKSCAPE + "label") for e in root.iter(SVG + "g") if e.get(INKSCAPE + "groupmode") == "layer"]
        self.assertEqual(sorted(layers), sorted({layer for layer, _, _ in CURVES}))
        found = self.listed("out.svg")
        for layer, _, length in CURVES:
            if length is not None:
                self.assertTrue(any(abs(one - length) <= CLOSE * length and where == layer for one, where in found),
                                (layer, length, found))

    def test_step_holds_all_curves(self):
        if not (pathlib.Path(PROGRAM).parent / "obvid-cad").exists():
            self.skipTest("the helper for CAD files is not built")
        drawing(self.at / "d.dxf")
        for name in ("out.step", "out.iges", "out.brep"):
            self.run_program("convert", "d.dxf", "--curve", "all", "-o", name)
            self.same_curves(self.listed(name), self.listed("d.dxf"))
        self.assertEqual((self.at / "out.step").read_text().count("GEOMETRIC_CURVE_SET"), 1)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
