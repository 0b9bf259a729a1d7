# SPDX-License-Identifier: Apache-2.0
"""*Region*: where every fair contour through the points must lie, as faces between exact arcs."""
import json
import math

import FreeCAD
import obvid
import Part

from . import fair_curve, feature, sources
from .fair_curve import CONTOUR, SOURCES, FairCurve, figure

#: Two curvatures are one, and a region has no width, below this share of the larger.
SAME = 1e-12


def other_curvature(start, end, kappa):
    """Curvature of the second of two arcs that touch: the first begins at `start` with `kappa`, the second
    meets `end`. Elements are (x, y, heading). None where there is none."""
    dx, dy = end[0] - start[0], end[1] - start[1]
    n0, n1 = (-math.sin(start[2]), math.cos(start[2])), (-math.sin(end[2]), math.cos(end[2]))
    across0, across1 = dx * n0[0] + dy * n0[1], dx * n1[0] + dy * n1[1]
    below = 2.0 * across0 - kappa * (dx * dx + dy * dy)
    # |c0 - c1|^2 = (1/k0 - 1/k1)^2 with centres on the normals, freed of its denominators
    above = 2.0 * kappa * across1 + 2.0 * (1.0 - (n0[0] * n1[0] + n0[1] * n1[1]))
    return above / below if below != 0.0 else None


def joint(start, end, first, second):
    """Where both arcs touch, and the direction there."""
    t = [math.cos(start[2]), math.sin(start[2]), math.cos(end[2]), math.sin(end[2])]
    if abs(second - first) <= SAME * max(abs(first), abs(second)):
        return None
    # t(p) = t0 + kappa J (p - p0), J the left turn: at the joint both arcs say the same
    px = (first * start[0] - second * end[0] + t[3] - t[1]) / (first - second)
    py = (first * start[1] - second * end[1] - t[2] + t[0]) / (first - second)
    tangent = (t[0] - first * (py - start[1]), t[1] + first * (px - start[0]))
    return px, py, tangent


def arc(a, tangent, b):
    """The arc from a to b that leaves along a tangent; a line where it does not bend."""
    dx, dy = b[0] - a[0], b[1] - a[1]
    chord = math.hypot(dx, dy)
    if chord == 0.0:
        return None
    half = math.atan2(tangent[0] * dy - tangent[1] * dx, tangent[0] * dx + tangent[1] * dy)
    begin, end = FreeCAD.Vector(a[0], a[1], 0), FreeCAD.Vector(b[0], b[1], 0)
    rise = 0.5 * chord * math.tan(0.5 * half)
    middle = FreeCAD.Vector(0.5 * (a[0] + b[0]) + rise * dy / chord, 0.5 * (a[1] + b[1]) - rise * dx / chord, 0)
    if abs(rise) <= 1e-9 * chord:
        return Part.makeLine(begin, end)
    return Part.Arc(begin, middle, end).toShape()


def boundary(start, end, kappa, kappa_end, from_start):
    """Edges of a boundary: both arcs from start to end."""
    if from_start:
        first, second = kappa, other_curvature(start, end, kappa)
    else:
        back = other_curvature((-end[0], -end[1], end[2]), (-start[0], -start[1], start[2]), -kappa_end)
        first, second = (None if back is None else -back), kappa_end
    if first is None or second is None:
        return None
    tangent = (math.cos(start[2]), math.sin(start[2]))
    met = joint(start, end, first, second)
    if met is None:
        return [arc(start[:2], tangent, end[:2])]
    px, py, along = met
    edges = [arc(start[:2], tangent, (px, py)), arc((px, py), along, end[:2])]
    return [edge for edge in edges if edge is not None]


def face_of_segment(before, behind):
    """The face between both boundaries of a segment, or None where it is flat."""
    start, end = ((*e["point"], e["heading"]) for e in (before, behind))
    if before["kappa"] is None or behind["kappa"] is None:
        return None
    one = boundary(start, end, before["kappa"], behind["kappa"], True)
    other = boundary(start, end, before["kappa"], behind["kappa"], False)
    if not one or not other:
        return None
    try:
        return Part.Face(Part.Wire(Part.__sortEdges__(one + other)))
    except Part.OCCError:
        return None


def leaving(element):
    """An element as the segment behind it sees it: corners leave with another heading."""
    if not element.get("corner"):
        return element
    return {**element, "heading": element["heading_out"], "kappa": element["kappa_out"]}


class Region(feature.Feature):
    """Its shape: one face for each segment that has room; its verdict: the widest."""

    KIND = "Region"
    INPUTS = {
        "Curve": ("App::PropertyLink", "Points", "A Fair Curve: the region of its own tangents and curvatures", None),
        **SOURCES,
        **{k: v for k, v in CONTOUR.items() if k not in ("Carrier", "Continuity", "LinesAndArcs")},
    }
    RESULTS = {
        **feature.Feature.RESULTS,
        "Widths": ("App::PropertyFloatList", "Width of the region between neighbouring points, mm; nan: none"),
        "Widest": ("App::PropertyLength", "Largest of them"),
    }

    def build(self, item):
        found = of_curve(item.Curve) if item.Curve is not None else of_points(item)
        pairs, widths, plane, what = found
        faces = [face_of_segment(leaving(before), behind) for before, behind in pairs]
        drawn = [face for face in faces if face is not None]
        known = [width for width in widths if not math.isnan(width)]
        if not drawn or not known:
            raise feature.NotThere("no segment has a region with room in it")
        feature.place(item, Part.makeCompound(drawn), plane)
        item.Widths = widths
        item.Widest = max(known)
        item.Verdict = f"Every monotone curve with {what} lies within {figure(max(known))}"
        flat = len(faces) - len(drawn)
        if flat:
            item.Verdict += f"; {fair_curve.counted(flat, 'segment')} without room or without a region"


def of_points(item):
    """The region of points as the program tells it, with the tangents that it chooses where none is given."""
    series = sources.series_of(item.Sources, item.Cells, item.File)
    if series.plane is None:
        raise feature.NotThere("the points lie in no plane: regions are known in planes")
    points = series.file if series.file is not None else series.flat()
    table = obvid.region(points, **region_options(item, series))
    elements = table.json["elements"]
    pairs = [(elements[row["from"]], elements[row["to"]]) for row in table.rows if row["width"] is not None]
    return pairs, table["width"].tolist(), series.plane, "the tangents and curvatures of the table"


def of_curve(curve):
    """The region of the tangents and curvatures that a Fair Curve has at its points."""
    if not feature.of_kind(curve, FairCurve):
        raise feature.NotThere(f"{curve.Label} is no Fair Curve")
    contour = json.loads(curve.Stored) if curve.Stored else {}
    if contour.get("format") != "obvid-contour":
        raise feature.NotThere(f"{curve.Label} has no contour in a plane: regions are known in planes")
    elements = contour["elements"]
    pairs = list(zip(elements, elements[1:] + elements[:1] if contour["closed"] else elements[1:]))
    segments = contour["report"]["segments"]
    widths = [s.get("width_unrefined") for s in segments]
    widths = [math.nan if width is None else width for width in widths]
    return pairs, widths, curve.Placement, "its tangents and curvatures"


def region_options(item, series):
    class Asked:
        Carrier, Continuity, LinesAndArcs = "spiral", "automatic", False
        Noise, Closed, Corners = item.Noise, item.Closed, item.Corners
        Headings, Radii, Convex = item.Headings, item.Radii, item.Convex

    options = fair_curve.options_of(Asked, series)
    del options["carrier"]
    return options


def new(document, links=(), name="Region", **properties):
    """A region of objects as of fair_curve.new, or with Curve=... of a Fair Curve."""
    item = feature.new_object(document, Region, name)
    item.Sources = [link if isinstance(link, tuple) else (link, [""]) for link in links]
    for key, value in properties.items():
        setattr(item, key, value)
    return item
