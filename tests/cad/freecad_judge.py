# SPDX-License-Identifier: Apache-2.0
"""Judges CAD files inside FreeCAD: run by freecadcmd, files and points come in the environment.

OBVID_JUDGE names a JSON file: a list of {"file", "points": [[x, y, kappa], ...], "size"}. Prints one
line per file: JUDGED name edges continuity distance curvature, and a last line JUDGE DONE.
"""
import json
import os

import FreeCAD
import Part

ORDER = {"C0": 0, "G1": 0, "C1": 1, "G2": 1, "C2": 2, "C3": 3, "CN": 9}


def judge(case):
    shape = Part.Shape()
    shape.read(case["file"])
    edges = shape.Edges
    edge = edges[0]
    largest = max(abs(k) for _, _, k in case["points"])
    distance = difference = 0.0
    for x, y, kappa in case["points"]:
        place = FreeCAD.Vector(x, y, 0.0)
        parameter = edge.Curve.parameter(place)
        distance = max(distance, (edge.valueAt(parameter) - place).Length)
        difference = max(difference, abs(edge.curvatureAt(parameter) - abs(kappa)))
    return (len(edges), ORDER.get(edge.Continuity, -1), distance / case["size"],
            difference / largest)


with open(os.environ["OBVID_JUDGE"], encoding="utf-8") as text:
    for one in json.load(text):
        print("JUDGED", os.path.basename(one["file"]), *judge(one), flush=True)
print("JUDGE DONE", flush=True)
