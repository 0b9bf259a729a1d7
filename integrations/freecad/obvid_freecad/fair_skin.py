# SPDX-License-Identifier: Apache-2.0
"""*Fair Skin*: one surface through fair contours of sections."""
import FreeCAD
import obvid

from . import fair_curve, feature, geometry, sources
from .fair_curve import FairCurve, counted, figure

MATCHES = ["as the sections say", "points", "length"]


class FairSkin(feature.Feature):
    """Sections are sketches, wires, edges or Fair Curves, whose own points are taken."""

    KIND = "FairSkin"
    INPUTS = {
        "Sections": ("App::PropertyLinkSubList", "Skin", "Sketches, wires, edges or Fair Curves, in order", None),
        "Noise": ("App::PropertyLength", "Skin", "How far points of sections may move; 0: not at all", None),
        "Tolerance": ("App::PropertyLength", "Skin", "From the contours of the sections; 0: as the program", None),
        "Match": ("App::PropertyEnumeration", "Skin", "What belongs together in neighbouring sections", MATCHES),
        "Closed": ("App::PropertyEnumeration", "Skin", "Whether sections close", fair_curve.CLOSINGS),
    }
    RESULTS = {
        **feature.Feature.RESULTS,
        "Proved": ("App::PropertyBool", "Whether the contours of all sections are proved"),
        "ProvedSections": ("App::PropertyInteger", "Sections whose contours are proved"),
        "FromContours": ("App::PropertyLength", "Largest distance from a fair contour at its section"),
        "FromPoints": ("App::PropertyLength", "Largest distance from a point that was given"),
        "Patches": ("App::PropertyInteger", "Faces"),
    }

    def build(self, item):
        sections = [points_of_section(link, sub) for link, sub in each(item.Sections)]
        if len(sections) < 2:
            raise feature.NotThere("a skin needs two sections at least")
        closed = {closes for _, closes in sections}
        options = {"units": "mm"}
        if feature.length(item.Noise) > 0.0:
            options["noise"] = feature.length(item.Noise)
        if feature.length(item.Tolerance) > 0.0:
            options["tolerance"] = feature.length(item.Tolerance)
        if item.Match != MATCHES[0]:
            options["match"] = item.Match
        if item.Closed == "closed" or (item.Closed not in ("closed", "open") and closed == {True}):
            options["closed"] = True
        if item.Closed == "open":
            options["open"] = True
        try:
            surface = obvid.skin([[(p.x, p.y, p.z) for p in points] for points, _ in sections], **options)
        except obvid.NotProvedError as error:
            if error.surface is None:
                raise
            surface = error.surface
        feature.place(item, geometry.shape_of_surface(surface), FreeCAD.Placement())
        self.report(item, surface, len(sections))

    @staticmethod
    def report(item, surface, n):
        skin = surface.report["skin"]
        rows = skin["sections"]
        item.ProvedSections = skin["proved"]
        item.Proved = skin["proved"] == n
        item.FromContours = max(row["deviation"] for row in rows)
        item.FromPoints = max(row["from_points"] for row in rows)
        item.Patches = surface.patch_count
        item.Verdict = (
            f"{item.ProvedSections} of {n} contours proved; the skin is within {figure(item.FromContours.Value)}"
            f" of them, within {figure(item.FromPoints.Value)} of the points;"
            f" {counted(item.Patches, 'face')}"
        )
        if surface.warnings:
            item.Verdict += ". " + ". ".join(surface.warnings)


def each(value):
    """(object, name of a part or empty) of the sections, in order."""
    for link, subs in sources.links(value):
        for sub in [sub for sub in subs if sub] or [""]:
            yield link, sub


def points_of_section(link, sub):
    if feature.of_kind(link, FairCurve) and not link.File:
        series = sources.series_of(link.Sources, link.Cells)
        return series.points, series.closed or link.Closed == "closed"
    return sources.points_of_link(link, [sub] if sub else [])


def new(document, links=(), name="FairSkin", **properties):
    """A skin through sections: objects, or (object, [names of edges])."""
    item = feature.new_object(document, FairSkin, name)
    item.Sections = [link if isinstance(link, tuple) else (link, [""]) for link in links]
    for key, value in properties.items():
        setattr(item, key, value)
    return item
