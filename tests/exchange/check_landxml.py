#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges the alignment of a LandXML 1.2 file by its schema and its own redundancy (lengths, radii,
centres, PIs, neighbours), without looking at the program that wrote it. Prints what is wrong;
nothing, and exit code 0, when all is well.

usage: check_landxml.py FILE
"""
import cmath
import math
import sys
import xml.etree.ElementTree as ElementTree

SCHEMA = "{http://www.landxml.org/schema/LandXML-1.2}"
TOLERANCE = 1e-9  # of lengths and of the size, and radians
CHILDREN = {"Line": ["Start", "End"], "Curve": ["Start", "Center", "End"],
            "Spiral": ["Start", "PI", "End"]}
REQUIRED = {"Line": [], "Curve": ["rot"],
            "Spiral": ["length", "radiusStart", "radiusEnd", "rot", "spiType"]}
# What the schema allows for each attribute of the one or the other system.
UNITS = {
    "Metric": {"linearUnit": ["millimeter", "centimeter", "meter", "kilometer"],
               "areaUnit": ["hectare", "squareMeter", "squareMillimeter", "squareCentimeter"],
               "volumeUnit": ["cubicMeter", "liter", "hectareMeter"],
               "temperatureUnit": ["celsius", "kelvin"],
               "pressureUnit": ["HPA", "milliBars", "mmHG", "millimeterHG"]},
    "Imperial": {"linearUnit": ["foot", "USSurveyFoot", "inch", "mile"],
                 "areaUnit": ["acre", "squareFoot", "squareInch", "squareMiles"],
                 "volumeUnit": ["US_gallon", "IMP_gallon", "cubicInch", "cubicFeet", "cubicYard",
                                "acreFeet"],
                 "temperatureUnit": ["fahrenheit", "kelvin"],
                 "pressureUnit": ["inHG", "inchHG"]}}
GAUSS = [(-0.9061798459386640, 0.2369268850561891), (-0.5384693101056831, 0.4786286704993665),
         (0.0, 0.5688888888888889), (0.5384693101056831, 0.4786286704993665),
         (0.9061798459386640, 0.2369268850561891)]
faults = []


def point(node, kind):
    northing, easting = (float(word) for word in node.find(SCHEMA + kind).text.split())
    return complex(easting, northing)


def direction(z):
    return z / abs(z)


def spiral_step(k0, k1, length):
    steps = 8 + int(8 * (abs(k0) + abs(k1)) * length)
    total = 0j
    for i in range(steps):
        for node, weight in GAUSS:
            s = (i + 0.5 + 0.5 * node) * length / steps
            total += weight * cmath.exp(1j * (k0 * s + (k1 - k0) * s * s / (2.0 * length)))
    return total * 0.5 * length / steps


def ends_of(node, scale):
    """Start, end, and the directions there, each from the points that the element gives."""
    kind = node.tag[len(SCHEMA):]
    start, end = point(node, "Start"), point(node, "End")
    length = float(node.get("length"))
    if kind == "Line":
        if abs(abs(end - start) - length) > scale:
            faults.append(f"Line of length {length}, its ends {abs(end - start)}")
        return start, end, direction(end - start), direction(end - start), length
    side = {"ccw": 1.0, "cw": -1.0}[node.get("rot")]
    if kind == "Curve":
        centre, radius = point(node, "Center"), float(node.get("radius"))
        slack = scale + 1e-15 * radius
        if abs(abs(start - centre) - radius) > slack or abs(abs(end - centre) - radius) > slack:
            faults.append(f"Curve of radius {radius}: {abs(start - centre)} {abs(end - centre)}")
        turn = side * cmath.phase((end - centre) / (start - centre)) % (2.0 * math.pi)
        if abs(turn * radius - length) > slack:
            faults.append(f"Curve of length {length}, its centre says {turn * radius}")
        return (start, end, 1j * side * direction(start - centre),
                1j * side * direction(end - centre), length)
    k0, k1 = (0.0 if node.get(name) == "INF" else side / float(node.get(name))
              for name in ("radiusStart", "radiusEnd"))
    if node.get("spiType") != "clothoid":
        faults.append(f"spiral of type {node.get('spiType')}")
    step, turn = spiral_step(k0, k1, length), 0.5 * (k0 + k1) * length
    heading = direction((end - start) / step)
    if abs(abs(step) - abs(end - start)) > scale:
        faults.append(f"Spiral: chord {abs(end - start)}, its formula {abs(step)}")
    meeting = point(node, "PI")
    after = heading * cmath.exp(1j * turn)
    if abs(((meeting - start) / heading).imag) > 10 * scale + 1e-6 * abs(turn) ** 2 * length:
        faults.append(f"Spiral: the PI is {((meeting - start) / heading).imag} off the first tangent")
    if abs(((end - meeting) / after).imag) > 10 * scale + 1e-6 * abs(turn) ** 2 * length:
        faults.append(f"Spiral: the PI is {((end - meeting) / after).imag} off the last tangent")
    return start, end, heading, after, length


def check_alignment(alignment):
    for name in ("name", "length", "staStart"):
        if name not in alignment.attrib:
            faults.append(f"Alignment lacks {name}")
    elements = list(alignment.find(SCHEMA + "CoordGeom"))
    total = float(alignment.get("length"))
    for node in elements:
        kind = node.tag[len(SCHEMA):]
        if [child.tag[len(SCHEMA):] for child in node] != CHILDREN.get(kind):
            faults.append(f"children of {kind}: {[child.tag for child in node]}")
        for name in REQUIRED.get(kind, []):
            if name not in node.attrib:
                faults.append(f"{kind} lacks {name}")
    if faults or not elements:
        faults.append("nothing to measure")
        return
    size = max(abs(point(node, "Start")) for node in elements)
    scale = TOLERANCE * total + 8e-16 * size
    walked, before = 0.0, None
    for i, node in enumerate(elements):
        start, end, first, last, length = ends_of(node, scale)
        if before is not None:
            if abs(start - before[0]) > scale:
                faults.append(f"gap of {abs(start - before[0])} before element {i}")
            # Directions from coordinates: their rounding over the length of the chord.
            slack = TOLERANCE + 8e-16 * size / min(abs(end - start), before[2])
            if abs(cmath.phase(first / before[1])) > slack:
                faults.append(f"kink of {cmath.phase(first / before[1])} before element {i}")
        walked += length
        before = (end, last, abs(end - start))
    if abs(walked - total) > TOLERANCE * total:
        faults.append(f"length {total}, elements {walked}")


def check_profile(alignment):
    """Between PVIs grades are straight; a curve lies half before its PVI and half behind it (by its
    tangents), and curves do not overlap. Parabolas and arcs bend one way."""
    for profile in alignment.findall(f"{SCHEMA}Profile/{SCHEMA}ProfAlign"):
        if not profile.get("name"):
            faults.append("ProfAlign lacks name")
        nodes = list(profile)
        kinds = [node.tag[len(SCHEMA):] for node in nodes]
        if len(nodes) < 2 or kinds[0] != "PVI" or kinds[-1] != "PVI":
            faults.append(f"ProfAlign has {kinds}")
            return
        places = [tuple(float(word) for word in node.text.split()) for node in nodes]
        stations = [place[0] for place in places]
        if any(len(place) != 2 for place in places) or stations != sorted(stations):
            faults.append(f"PVIs at {stations}")
            return
        grades = [(b[1] - a[1]) / (b[0] - a[0]) for a, b in zip(places, places[1:])]
        end = stations[0]
        for i, (node, kind) in enumerate(zip(nodes, kinds)):
            if kind == "PVI":
                continue
            if kind not in ("ParaCurve", "CircCurve") or not 0 < i < len(nodes) - 1:
                faults.append(f"ProfAlign has {kinds}")
                return
            length = float(node.get("length"))
            before = after = 0.5 * length
            if kind == "CircCurve":
                # tangents of an arc are as long as each other
                tangent = float(node.get("radius")) * math.tan(
                    0.5 * abs(math.atan(grades[i]) - math.atan(grades[i - 1])))
                before = tangent * math.cos(math.atan(grades[i - 1]))
                after = tangent * math.cos(math.atan(grades[i]))
                if abs(before + after - length) > 1e-6 * length:
                    faults.append(f"CircCurve of length {length}: its radius says {before + after}")
            slack = 1e-7 * (stations[-1] - stations[0])
            if stations[i] - before < end - slack or stations[i] + after > stations[-1] + slack:
                faults.append(f"the vertical curve at {stations[i]} has no room")
            end = stations[i] + after


def check_units(root):
    """One child of Units, Metric or Imperial, with units of its own system."""
    systems = [node for parent in root.findall(SCHEMA + "Units") for node in parent]
    if len(systems) != 1 or systems[0].tag[len(SCHEMA):] not in UNITS:
        faults.append(f"Units has {[node.tag for node in systems]}")
        return
    for name, allowed in UNITS[systems[0].tag[len(SCHEMA):]].items():
        if systems[0].get(name) not in allowed:
            faults.append(f"{systems[0].tag} has {name} {systems[0].get(name)}")


def main():
    root = ElementTree.parse(sys.argv[1]).getroot()
    if root.tag != SCHEMA + "LandXML":
        faults.append(f"root {root.tag}")
    for name in ("version", "date", "time"):
        if name not in root.attrib:
            faults.append(f"LandXML lacks {name}")
    check_units(root)
    alignments = root.findall(f"{SCHEMA}Alignments/{SCHEMA}Alignment")
    if len(alignments) != 1:
        faults.append(f"{len(alignments)} alignments")
    for alignment in alignments:
        check_alignment(alignment)
        check_profile(alignment)
    print("\n".join(faults), end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
