#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges an OpenDRIVE file by the schema and rules of ASAM OpenDRIVE 1.6, without looking at the
program that wrote it. Prints what is wrong; nothing, and exit code 0, when all is well.

usage: check_opendrive.py FILE
"""
import cmath
import math
import sys
import xml.etree.ElementTree as ElementTree

TOLERANCE = 1e-9  # of lengths and of the size, and radians
ORDER = {  # children in the order of the schema
    "OpenDRIVE": ["header", "road"],
    "header": [],
    "road": ["link", "type", "planView", "elevationProfile", "lateralProfile", "lanes"],
    "link": ["predecessor", "successor"],
    "predecessor": [],
    "successor": [],
    "planView": ["geometry"],
    "geometry": ["line", "spiral", "arc", "poly3", "paramPoly3"],
    "line": [],
    "spiral": [],
    "arc": [],
    "elevationProfile": ["elevation"],
    "elevation": [],
    "lanes": ["laneOffset", "laneSection"],
    "laneSection": ["left", "center", "right"],
    "center": ["lane"],
    "right": ["lane"],
    "lane": ["link", "width", "roadMark"],
    "width": [],
}
REQUIRED = {
    "header": ["revMajor", "revMinor"],
    "road": ["length", "id", "junction"],
    "geometry": ["s", "x", "y", "hdg", "length"],
    "spiral": ["curvStart", "curvEnd"],
    "arc": ["curvature"],
    "elevation": ["s", "a", "b", "c", "d"],
    "laneSection": ["s"],
    "lane": ["id", "type"],
    "width": ["sOffset", "a", "b", "c", "d"],
    "predecessor": ["elementType", "elementId", "contactPoint"],
    "successor": ["elementType", "elementId", "contactPoint"],
}
NAMES = {"name", "version", "id", "junction", "type", "level", "elementType", "elementId",
         "contactPoint"}
GAUSS = [(-0.9061798459386640, 0.2369268850561891), (-0.5384693101056831, 0.4786286704993665),
         (0.0, 0.5688888888888889), (0.5384693101056831, 0.4786286704993665),
         (0.9061798459386640, 0.2369268850561891)]
faults = []


def check_tree(node):
    allowed = ORDER.get(node.tag)
    if allowed is None:
        faults.append(f"unknown element {node.tag}")
        return
    places = [allowed.index(child.tag) if child.tag in allowed else -1 for child in node]
    if -1 in places or places != sorted(places):
        faults.append(f"children of {node.tag}: {[child.tag for child in node]}")
    for name in REQUIRED.get(node.tag, []):
        if name not in node.attrib:
            faults.append(f"{node.tag} lacks {name}")
    for name, value in node.attrib.items():
        if name not in NAMES and not math.isfinite(float(value)):
            faults.append(f"{node.tag} {name} is {value}")
    for child in node:
        check_tree(child)


def end_of(geometry):
    """End point, end heading and end curvature by quadrature of the heading."""
    x, y, hdg, length = (float(geometry.get(name)) for name in ("x", "y", "hdg", "length"))
    shape = geometry[0]
    k0 = float(shape.get("curvature", shape.get("curvStart", 0.0)))
    k1 = float(shape.get("curvature", shape.get("curvEnd", 0.0)))
    steps = 8 + int(8 * (abs(k0) + abs(k1)) * length)
    total = 0j
    for i in range(steps):
        for node, weight in GAUSS:
            s = (i + 0.5 + 0.5 * node) * length / steps
            total += weight * cmath.exp(1j * (k0 * s + (k1 - k0) * s * s / (2.0 * length)))
    total *= 0.5 * length / steps
    return complex(x, y) + total * cmath.exp(1j * hdg), hdg + 0.5 * (k0 + k1) * length


def check_line(road):
    geometries = road.find("planView").findall("geometry")
    number = road.get("id")
    if not geometries:
        faults.append(f"road {number} has no geometry")
    starts = [complex(float(g.get("x")), float(g.get("y"))) for g in geometries]
    length = float(road.get("length"))
    scale = max(abs(z) for z in starts) * 4e-16 + length * TOLERANCE
    station = 0.0
    for i, geometry in enumerate(geometries):
        if len(geometry) != 1:
            faults.append(f"road {number} element {i} has {len(geometry)} shapes")
        if float(geometry.get("length")) <= 0.0:
            faults.append(f"road {number} element {i} has no length")
        if abs(float(geometry.get("s")) - station) > TOLERANCE * length:
            faults.append(f"road {number} element {i} begins at s {geometry.get('s')}, not {station}")
        station += float(geometry.get("length"))
        if i + 1 < len(geometries):
            end, hdg = end_of(geometry)
            turn = math.remainder(float(geometries[i + 1].get("hdg")) - hdg, 2.0 * math.pi)
            if abs(end - starts[i + 1]) > scale:
                faults.append(f"road {number}: gap {abs(end - starts[i + 1])} behind element {i}")
            if abs(turn) > TOLERANCE + scale / length:
                faults.append(f"road {number}: kink {turn} behind element {i}")
    if abs(station - length) > TOLERANCE * length:
        faults.append(f"road {number}: length {length}, elements {station}")


def check_elevations(road):
    """Cubics from 0 on, each beginning with the height and the grade of the one before."""
    rows = [tuple(float(node.get(name)) for name in "sabcd")
            for node in road.findall("elevationProfile/elevation")]
    if not rows:
        return
    number, length = road.get("id"), float(road.get("length"))
    if rows[0][0] != 0.0 or any(b[0] <= a[0] for a, b in zip(rows, rows[1:])) or rows[-1][0] >= length:
        faults.append(f"road {number}: elevations at {[row[0] for row in rows]}")
    for (s, a, b, c, d), (next_s, next_a, next_b, _, _) in zip(rows, rows[1:]):
        x = next_s - s
        if abs(a + x * (b + x * (c + x * d)) - next_a) > TOLERANCE * length:
            faults.append(f"road {number}: step of the height at {next_s}")
        if abs(b + x * (2 * c + 3 * d * x) - next_b) > 1e-7:
            faults.append(f"road {number}: step of the grade at {next_s}")


def check_roads(root):
    roads = root.findall("road")
    numbers = [road.get("id") for road in roads]
    if not roads or len(set(numbers)) != len(numbers):
        faults.append(f"roads {numbers}")
    for road in roads:
        check_line(road)
        check_elevations(road)
        sections = road.findall("lanes/laneSection")
        if not sections or float(sections[0].get("s")) != 0.0:
            faults.append("lane sections do not begin at 0")
        widths = [float(w.get("a")) for w in road.iter("width")]
        if not any(width > 0.0 for width in widths):
            faults.append("no lane is wider than 0")
        for link in road.find("link"):
            if link.get("elementId") not in numbers:
                faults.append(f"link to road {link.get('elementId')}, which is not there")


def main():
    root = ElementTree.parse(sys.argv[1]).getroot()
    if root.tag != "OpenDRIVE":
        faults.append(f"root {root.tag}")
    check_tree(root)
    if not faults:
        check_roads(root)
    print("\n".join(faults), end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
