#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What ezdxf, an independent reader, makes of a DXF file.

usage: dxf_audit.py audit FILE...  one line per error or repair, the file in front of it; nothing when all is well
       dxf_audit.py extent FILE    KIND COUNT per kind, then "length L", then "box X0 Y0 X1 Y1"
       dxf_audit.py points N FILE...  "file COUNT" for each, then points of all its curves, N to a piece, in order, "x y" each
"""
import collections
import math
import sys

import ezdxf
from ezdxf import path

DRAWN = {"LINE", "ARC", "CIRCLE", "ELLIPSE", "SPLINE", "LWPOLYLINE", "POLYLINE"}
FLATNESS = 1e-5  # of the size of the curve


def audit(name):
    auditor = ezdxf.readfile(name).audit()
    for entry in auditor.errors + auditor.fixes:
        print(f"{name}:", entry.code, entry.message)


def flattened(entity):
    one = path.make_path(entity)
    points = list(one.control_vertices())
    size = max(p.distance(points[0]) for p in points)
    return list(one.flattening(max(size, 1e-9) * FLATNESS, segments=16))


def extent(doc):
    kinds, length, all_points = collections.Counter(), 0.0, []
    for entity in doc.modelspace():
        kinds[entity.dxftype()] += 1
        if entity.dxftype() not in DRAWN:
            continue
        points = flattened(entity)
        length += sum(a.distance(b) for a, b in zip(points, points[1:]))
        all_points += points
    for kind, count in sorted(kinds.items()):
        print(kind, count)
    print("length", repr(length))
    if all_points:
        xs, ys = [p.x for p in all_points], [p.y for p in all_points]
        print("box", repr(min(xs)), repr(min(ys)), repr(max(xs)), repr(max(ys)))


def arc_points(entity, count):
    """Points of an ARC by its own definition."""
    sweep = (entity.dxf.end_angle - entity.dxf.start_angle) % 360.0
    angles = [entity.dxf.start_angle + sweep * k / count for k in range(count + 1)]
    return list(entity.vertices(angles))


def spline_points(entity, count):
    curve = entity.construction_tool()
    knots = sorted(set(curve.knots()))
    out = []
    for low, high in zip(knots, knots[1:]):
        out += list(curve.points(low + (high - low) * k / count for k in range(count + 1)))
    return out


def entity_points(entity, count):
    kind = entity.dxftype()
    if kind == "LINE":
        return [entity.dxf.start.lerp(entity.dxf.end, k / count) for k in range(count + 1)]
    if kind == "ARC":
        return arc_points(entity, count)
    if kind == "ELLIPSE":
        low, high = entity.dxf.start_param, entity.dxf.end_param
        high += 0.0 if high > low else 2.0 * math.pi
        return list(entity.vertices([low + (high - low) * k / count for k in range(count + 1)]))
    if kind == "SPLINE":
        return spline_points(entity, count)
    return [p for part in entity.virtual_entities() for p in entity_points(part, count)]


def points(doc, count):
    found = [p for entity in doc.modelspace() for p in entity_points(entity, count)]
    print("file", len(found))
    print("".join(f"{p.x!r} {p.y!r}\n" for p in found), end="")


def main():
    if sys.argv[1] == "audit":
        for name in sys.argv[2:]:
            audit(name)
    elif sys.argv[1] == "extent":
        extent(ezdxf.readfile(sys.argv[2]))
    else:
        for name in sys.argv[3:]:
            points(ezdxf.readfile(name), int(sys.argv[2]))


if __name__ == "__main__":
    main()
