# SPDX-License-Identifier: Apache-2.0
"""Judges files of faces inside FreeCAD: run by freecadcmd, the list comes in the environment.

OBVID_JUDGE names a JSON file: a list of {"file", "size", "points": [[x, y, z], ...]}, lengths in mm;
"area": false leaves the area at 0, because it takes seconds on surfaces of many spans.
Prints one line per file: JUDGED name valid kind faces open_edges area volume distance box, and a last
line JUDGE DONE. Distance: the largest of the points from the faces, over the size. Open edges: those of
one face only, not counting poles. Area: integrated here over the faces' own surfaces (FreeCAD's
Shape.Area is 0.2 % off on rational spheres); the volume is FreeCAD's. Box: six numbers.
"""
import json
import math
import os

import FreeCAD
import Part


def distance(face, place):
    """From the surface under the face."""
    u, v = face.Surface.parameter(place)
    return (face.Surface.value(u, v) - place).Length


# Gauss-Legendre, 5 points in [-1, 1]
NODES = [(0.0, 128 / 225)]
for inner, weight in ((-2, 322 + 13 * math.sqrt(70)), (2, 322 - 13 * math.sqrt(70))):
    node = math.sqrt(5 + inner * math.sqrt(10 / 7)) / 3
    NODES += [(node, weight / 900), (-node, weight / 900)]


def places(knots):
    """Parameters and weights: each span in two halves."""
    out = []
    for a, b in zip(knots, knots[1:]):
        for low, high in ((a, 0.5 * (a + b)), (0.5 * (a + b), b)):
            out += [(0.5 * (low + high) + 0.5 * (high - low) * x, 0.5 * (high - low) * w)
                    for x, w in NODES]
    return out


def area(face):
    surface = face.Surface
    if not hasattr(surface, "getUKnots"):
        return face.Area
    across = places(surface.getVKnots())
    total = 0.0
    for u, a in places(surface.getUKnots()):
        for v, b in across:
            du, dv = face.derivative1At(u, v)
            total += a * b * du.cross(dv).Length
    return total


def distance_to_nearest(faces, place, first, good):
    """Stops at the first face that is good enough."""
    best = float("inf")
    for k in range(len(faces)):
        best = min(best, distance(faces[(first + k) % len(faces)], place))
        if best <= good:
            break
    return best


def judge(case):
    shape = Part.Shape()
    shape.read(case["file"])
    faces = shape.Faces
    worst = 0.0
    for k, point in enumerate(case["points"]):
        first = k * len(faces) // len(case["points"])
        worst = max(worst, distance_to_nearest(faces, FreeCAD.Vector(*point), first,
                                               1e-12 * case["size"]))
    uses = {}
    for face in faces:
        for wire in face.Wires:
            for edge in wire.OrderedEdges:
                if not edge.Degenerated:
                    uses[edge.hashCode()] = uses.get(edge.hashCode(), 0) + 1
    open_edges = sum(1 for count in uses.values() if count == 1)
    kinds = [shape.ShapeType]
    while kinds[-1] == "Compound" and len(shape.SubShapes) == 1:
        shape = shape.SubShapes[0]
        kinds.append(shape.ShapeType)
    volume = sum(solid.Volume for solid in shape.Solids)
    box = shape.BoundBox
    total = sum(map(area, faces)) if case.get("area", True) else 0.0
    return (int(shape.isValid()), kinds[-1], len(faces), open_edges, repr(total),
            repr(volume), worst / case["size"], box.XMin, box.YMin, box.ZMin, box.XMax, box.YMax,
            box.ZMax)


with open(os.environ["OBVID_JUDGE"], encoding="utf-8") as text:
    for one in json.load(text):
        print("JUDGED", os.path.basename(one["file"]), *judge(one), flush=True)
print("JUDGE DONE", flush=True)
