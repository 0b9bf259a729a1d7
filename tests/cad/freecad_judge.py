# SPDX-License-Identifier: Apache-2.0
"""Judges CAD files inside FreeCAD: run by freecadcmd, files and points come in the environment.

OBVID_JUDGE names a JSON file: a list of {"file", "points": [[x, y, kappa], ...], "size"}, lengths in
mm, points in order along the curve. Prints one line per file: JUDGED name edges continuity distance
curvature turns, and a last line JUDGE DONE. Turns: how many more changes between growing and falling
the curvature read has than the curvature expected.
"""
import json
import os

import FreeCAD
import Part

ORDER = {"C0": 0, "G1": 0, "C1": 1, "G2": 1, "C2": 2, "C3": 3, "CN": 9}


NOISE = 1e-8  # of the largest curvature: swings below it are rounding


def turns(values, noise):
    count, direction, extreme = 0, 0, values[0]
    for value in values:
        step = value - extreme
        if direction == 0:
            direction = (step > noise) - (step < -noise)
        if direction * step > 0:
            extreme = value
        elif direction * step < -noise:
            direction, extreme, count = -direction, value, count + 1
    return count


def judge(case):
    shape = Part.Shape()
    shape.read(case["file"])
    edges = shape.Edges
    edge = edges[0]
    largest = max(abs(k) for _, _, k in case["points"])
    distance = difference = 0.0
    read = []
    for x, y, kappa in case["points"]:
        place = FreeCAD.Vector(x, y, 0.0)
        parameter = edge.Curve.parameter(place)
        distance = max(distance, (edge.valueAt(parameter) - place).Length)
        read.append(edge.curvatureAt(parameter))
        difference = max(difference, abs(read[-1] - abs(kappa)))
    expected = [abs(kappa) for _, _, kappa in case["points"]]
    return (len(edges), ORDER.get(edge.Continuity, -1), distance / case["size"],
            difference / largest, turns(read, NOISE * largest) - turns(expected, NOISE * largest))


with open(os.environ["OBVID_JUDGE"], encoding="utf-8") as text:
    for one in json.load(text):
        print("JUDGED", os.path.basename(one["file"]), *judge(one), flush=True)
print("JUDGE DONE", flush=True)
