# SPDX-License-Identifier: Apache-2.0
"""*Region*: where every fair contour through the points must lie, as faces between exact arcs."""
import json
import math

import FreeCAD
import obvid
import Part

from . import fair_curve, feature, sources
from .fair_curve import CONTOUR, SOURCES, FairCurve, figure


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


def edges_between(arcs, end):
    """Edges of a boundary, of arcs as the library tells them."""
    begins = [row[:2] for row in arcs] + [end]
    made = [arc(a, (math.cos(row[2]), math.sin(row[2])), b) for a, b, row in zip(begins, begins[1:], arcs)]
    return [edge for edge in made if edge is not None]


def face_of_segment(before, behind):
    """The face between both boundaries of a segment, or None where it is flat."""
    if before["kappa"] is None or behind["kappa"] is None:
        return None
    start, end = ((*e["point"], e["heading"], e["kappa"]) for e in (before, behind))
    found = obvid.region_arcs(start, end)
    if found is None:
        return None
    edges = [edge for arcs in found for edge in edges_between(arcs, end[:2])]
    try:
        return Part.Face(Part.Wire(Part.__sortEdges__(edges)))
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
