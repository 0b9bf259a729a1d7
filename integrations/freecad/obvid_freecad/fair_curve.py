# SPDX-License-Identifier: Apache-2.0
"""*Fair Curve*: a proved contour through points of the document, which follows them."""
import math
import time

import FreeCAD
import obvid
import Part

from . import feature, geometry, sources

CARRIERS = ["spiral", "conics", "bspline", "arcs"]
CONTINUITIES = ["automatic", "G2", "G3"]
CLOSINGS = ["as the points say", "closed", "open"]

SOURCES = {
    "Sources": ("App::PropertyLinkSubList", "Points", "Sketch, vertices, edges, wire or spreadsheet", None),
    "Cells": ("App::PropertyString", "Points", "Cells of the spreadsheet, as A2:B40; empty: from A1 on", None),
    "File": ("App::PropertyFile", "Points", "A file of points or a drawing, in place of objects", None),
}
CONTOUR = {
    "Carrier": ("App::PropertyEnumeration", "Contour", "Family of curves", CARRIERS),
    "Noise": ("App::PropertyLength", "Contour", "How far points may move; 0: not at all", None),
    "Closed": ("App::PropertyEnumeration", "Contour", "Whether the contour closes", CLOSINGS),
    "Corners": ("App::PropertyIntegerList", "Contour", "Points where it may turn at once, from 1", None),
    "Headings": ("App::PropertyStringList", "Contour", "Given tangents: 3 = 45, or 3 = 40..50 (degrees)", None),
    "Radii": ("App::PropertyStringList", "Contour", "Given radii: 3 = 120, 1 = inf, 5 = 20..30", None),
    "Continuity": ("App::PropertyEnumeration", "Contour", "Of the curvature (G2), of its slope too (G3)",
                   CONTINUITIES),
    "Convex": ("App::PropertyBool", "Contour", "Allow no inflection", None),
    "LinesAndArcs": ("App::PropertyBool", "Contour", "Keep lines and arcs on which points lie", None),
}  # fmt: skip


def given(lines, what):
    """{index: value} of lines such as "3 = 45" and "3 = 40..50"; points from 1."""
    out = {}
    for line in lines:
        if not line.strip():
            continue
        left, equals, right = line.replace(":", "=", 1).partition("=")
        try:
            point, text = int(left), right.strip().replace("°", "").replace("deg", "").strip()
            value = text if ".." in text or text in ("inf", "natural") else float(text)
        except ValueError:
            raise feature.NotThere(f'{what} "{line}" is not of the form "3 = 45"') from None
        if not equals or point < 1:
            raise feature.NotThere(f'{what} "{line}": points count from 1')
        out[point - 1] = value
    return out


def options_of(item, series):
    """Options of obvid.fit."""
    options = {"carrier": item.Carrier, "units": "mm"}
    if feature.length(item.Noise) > 0.0:
        options["noise"] = feature.length(item.Noise)
    closed = {"closed": True, "open": False}.get(item.Closed, True if series.closed else None)
    if closed is not None:
        options["closed"] = closed
    if item.Corners:
        if min(item.Corners) < 1:
            raise feature.NotThere("corners are points, which count from 1")
        options["corners"] = [k - 1 for k in item.Corners]
    for name, lines in (("heading", item.Headings), ("radius", item.Radii)):
        if lines:
            options[name] = given(lines, name)
    if item.Continuity != "automatic":
        options["continuity"] = item.Continuity
    if item.Convex:
        options["convex"] = True
    if item.LinesAndArcs:
        options["primitives"] = True
    return options


def counted(n, one, many=None):
    return f"{n} {one if n == 1 else many or one + 's'}"


def figure(value, unit="mm"):
    """Four digits; a bound is never shown smaller than it is."""
    if value is None or math.isnan(value):
        return "unknown"
    if value == 0.0:
        return f"0 {unit}"
    power = 10.0 ** (math.floor(math.log10(abs(value))) - 3)
    up = math.ceil(value / power) * power
    return f"{up:.4g} {unit}"


def verdict_of(contour):
    """What was proved, as one sentence."""
    c, report = contour.certificate, contour.report
    if not contour.proved:
        return f"NOT proved: {c.reason}"
    text = f"Proved: {counted(c.vertices, 'vertex', 'vertices')}, the points force {report.vertices_lower_bound} where no curve winds between them"
    text += f"; {counted(c.inflections, 'inflection')}; {contour.continuity}"
    if c.corners:
        text += f" between {counted(c.corners, 'corner')}"
    if c.largest_move > 0.0:
        text += f"; points moved by at most {figure(c.largest_move)}"
    if report.largest_deviation is not None:
        text += f"; every monotone curve with its tangents and curvatures is within {figure(report.largest_deviation)}"
    return text


def formed(series, options):
    """The contour, or the curve in space; not proved where it does not keep its promise."""
    points = series.file
    if points is None:
        if series.plane is None:
            spatial = {k: v for k, v in options.items() if k not in ("heading", "radius")}
            if len(spatial) < len(options):
                raise feature.NotThere("the points lie in no plane: tangents and radii are given in one")
            try:
                return obvid.fit_space(series.spatial(), **spatial)
            except obvid.NotProvedError as error:
                return error.contour
        points = series.flat()
    try:
        return obvid.fit(points, **options)
    except obvid.NotProvedError as error:
        return error.contour


def shape_of(made):
    """A wire of one edge, or of one from corner to corner; of a contour in its plane."""
    if isinstance(made, obvid.SpaceCurve):
        return wire_of(geometry.shape_of_space_curve(made))
    return wire_of(geometry.shape_of_bspline(made.to_bspline(smooth=True)))


def wire_of(shape):
    """Pads and lofts take wires."""
    return shape if shape.ShapeType == "Wire" else Part.Wire([shape])


class FairCurve(feature.Feature):
    """Properties say what it is made of and what was proved of it; `Stored` is its contour file."""

    KIND = "FairCurve"
    INPUTS = {**SOURCES, **CONTOUR}
    RESULTS = {
        **feature.Feature.RESULTS,
        "Proved": ("App::PropertyBool", "Whether all of it was proved"),
        "Vertices": ("App::PropertyInteger", "Extrema of the curvature"),
        "LowerBound": ("App::PropertyInteger", "Vertices that the points force"),
        "Inflections": ("App::PropertyInteger", "Changes of the sign of the curvature"),
        "LargestMove": ("App::PropertyLength", "How far points were moved at most"),
        "ErrorBound": ("App::PropertyLength", "Within which every monotone curve with its tangents and curvatures at the points lies; 0: unknown"),
        "PointCount": ("App::PropertyInteger", "Points that were given"),
        "Milliseconds": ("App::PropertyFloat", "Time of the last computation"),
        "Stored": ("App::PropertyString", "Contour file"),
    }

    def build(self, item):
        started = time.perf_counter()
        series = sources.series_of(item.Sources, item.Cells, item.File)
        made = formed(series, options_of(item, series))
        feature.place(item, shape_of(made), series.plane or FreeCAD.Placement())
        item.Stored = made.text("json")
        self.report(item, made)
        item.Milliseconds = 1e3 * (time.perf_counter() - started)

    def report(self, item, made):
        if isinstance(made, obvid.SpaceCurve):
            contours = [part[name] for part in made.parts
                        for name in ("contour", "projection", "heights") if name in part]  # fmt: skip
            certificates = [one["certificate"] for one in contours]
            item.Vertices = sum(one["vertices"] for one in certificates)
            item.Inflections = sum(one["inflections"] for one in certificates)
            item.LowerBound = sum(one["report"]["vertices_lower_bound"] for one in contours)
            item.LargestMove = made.to_dict().get("largest_move", 0.0)
            item.ErrorBound = 0.0
            item.Verdict = space_verdict(made, item)
        else:
            item.Vertices = made.certificate.vertices
            item.Inflections = made.certificate.inflections
            item.LowerBound = made.report.vertices_lower_bound
            item.LargestMove = made.certificate.largest_move
            item.ErrorBound = made.report.largest_deviation or 0.0
            item.Verdict = verdict_of(made)
        item.Proved = made.proved
        item.PointCount = len(made.points)


def space_verdict(made, item):
    if not made.proved:
        return "NOT proved"
    flat = all(part["planar"] for part in made.parts)
    where = "in the plane of the points" if flat else "in space: projection and heights"
    text = f"Proved {where}, {counted(item.Vertices, 'vertex', 'vertices')}"
    return f"{text}, {counted(item.Inflections, 'inflection')}, {counted(made.part_count, 'part')}"


def new(document, links=(), name="FairCurve", **properties):
    """A Fair Curve of objects, or of (object, [names of parts]); other properties by their names."""
    item = feature.new_object(document, FairCurve, name, "Part::Part2DObjectPython")
    item.Sources = [link if isinstance(link, tuple) else (link, [""]) for link in links]
    for key, value in properties.items():
        setattr(item, key, value)
    return item
