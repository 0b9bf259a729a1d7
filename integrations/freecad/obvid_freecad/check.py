# SPDX-License-Identifier: Apache-2.0
"""*Check*: whether a shape is what it should be. Contours are proved again from what the document holds,
joints are measured by Open CASCADE, surfaces by the library."""
import math

import obvid

from . import audit, fair_curve, feature, geometry, sources
from .fair_curve import FairCurve, counted

#: A joint is G2 below this: direction in rad, curvature as share of the largest.
G2 = obvid.JOINT_LIMIT


class Finding:
    """One line of a check."""

    def __init__(self, good, text):
        self.good = good  #: True, False, or None: told, not judged
        self.text = text

    def __str__(self):
        return f"{ {True: 'good', False: 'BAD', None: 'note'}[self.good] }: {self.text}"


def valid(shape):
    try:
        good = shape.isValid()
    except Exception as error:  # Part.OCCError
        return Finding(False, f"the kernel refuses it: {error}")
    return Finding(good, "valid for the kernel" if good else "not valid for the kernel")


def joints(edges):
    """Continuity of each edge at its inner knots."""
    place = turn = step = 0.0
    inner = 0
    for edge in edges:
        curve = geometry.bspline_of_edge(edge)
        inner += len(curve.getKnots()) - 2
        gaps = geometry.joint_gaps(curve)
        place, turn, step = max(place, gaps[0]), max(turn, gaps[1]), max(step, gaps[2])
    if inner == 0:
        return Finding(True, "no joints: one polynomial")
    order = "G2" if turn <= G2 and step <= G2 else "G1" if turn <= G2 else "G0"
    text = f"{counted(inner, 'joint')} {order}: direction within {turn:.1e} rad, curvature within {step:.1e}"
    return Finding(order == "G2", text)


def proof(item):
    """The contour file of a Fair Curve is proved again, and the shape compared with it, number by number."""
    if not item.Stored:
        return [Finding(False, "no contour is stored: recompute it")]
    source = obvid.read_text(item.Stored, f"{item.Label}.json")
    spatial = '"obvid-space' in item.Stored[:200]
    made = source.space_curve() if spatial else source.contour()
    found = made.verify()
    name = "false_claim" if not spatial else None
    why = found.false_claim if name else found.json.get("false_claim")
    proved = Finding(found.holds, "proved again from its numbers" if found.holds else f"not proved: {why}")
    return [proved, same_shape(item, made)]


def same_shape(item, made):
    own, wanted = item.Shape, fair_curve.shape_of(made)
    wanted.Placement = item.Placement
    off = 0.0
    if len(own.Edges) != len(wanted.Edges):
        return Finding(False, "the shape is another one than the contour: recompute it")
    for a, b in zip(own.Edges, wanted.Edges):
        one, other = geometry.bspline_of_edge(a), geometry.bspline_of_edge(b)
        if one.NbPoles != other.NbPoles or one.Degree != other.Degree:
            return Finding(False, "the shape is another one than the contour: recompute it")
        off = max([off] + [(p - q).Length for p, q in zip(one.getPoles(), other.getPoles())])
    good = off <= geometry.ROUNDING * max(item.Shape.BoundBox.DiagonalLength, 1e-300)
    return Finding(good, f"the shape has the control points of the contour, within {off:.1e} mm")


def curvature(edges):
    plane = geometry.plane_of_points([p for e in edges for p in geometry.bspline_of_edge(e).getPoles()])
    if plane is None:
        return Finding(None, "no plane: vertices are not counted")
    found = audit.audit_in_plane(edges, plane)
    text = f"{counted(found.vertices, 'vertex', 'vertices')}, {counted(found.inflections, 'inflection')}"
    return Finding(None, text)


def surfaces(faces):
    """What the library measures of faces: joints inside and between them, ranges of curvature."""
    text = geometry.stored_surface_of(faces)
    values = obvid.surface("convert", [obvid.read_text(text, "faces.json")]).check()
    return surface_findings(values)


def check(shape, item=None):
    """Findings about a shape; of a Fair Curve also its proof."""
    out = [valid(shape)]
    faces, edges = shape.Faces, shape.Edges
    if item is not None and feature.of_kind(item, FairCurve):
        out += proof(item)
    if faces:
        out += surfaces(faces)
    elif edges:
        out.append(joints(edges))
        out.append(curvature(edges))
    return out


def surface_findings(values):
    out = []
    for patch in values["patches"]:
        inner = min(patch["order_u"], patch["order_v"])
        radius = smallest_radius([k for name in ("k1", "k2") for k in patch[name]])
        monotone = " and ".join(
            f"{patch[name]['monotone']} of {patch[name]['lines']}" for name in ("along_u", "along_v")
        )
        text = f"{patch['name']}: C{min(inner, patch_most(patch))} inside, smallest radius {radius},"
        out.append(Finding(inner >= 1, f"{text} {monotone} parameter lines monotone"))
    for joint in values["joints"] + values["trim_joints"]:
        out.append(joint_finding(joint))
    return out


def smallest_radius(curvatures):
    """Curvatures that grow without bound, as at poles, are None."""
    if None in curvatures:
        return "0, at a point without bound"
    bend = max(abs(k) for k in curvatures)
    return fair_curve.figure(1.0 / bend) if bend > 0.0 else "none, it is plane"


def joint_finding(joint):
    names = " and ".join(f"Face{k + 1}" for k in joint["patches"])
    text = f"{names}: G{joint['order']}, gap {joint['gap']:.1e} mm, angle {joint['angle']:.1e} rad"
    return Finding(None if joint["order"] < 1 else True, text)


def patch_most(patch):
    return min(patch["degree_u"], patch["degree_v"])


class Check(feature.Feature):
    """Its findings stand in a list; it has no shape."""

    KIND = "Check"
    INPUTS = {"Target": ("App::PropertyLinkSub", "Check", "What is checked", None)}
    RESULTS = {
        **feature.Feature.RESULTS,
        "Good": ("App::PropertyBool", "Whether nothing bad was found"),
        "Findings": ("App::PropertyStringList", "One line each"),
    }

    def build(self, item):
        if not item.Target or item.Target[0] is None:
            raise feature.NotThere("choose what is to be checked")
        link, subs = item.Target
        names = [sub for sub in subs if sub]
        found = []
        for name in names or [""]:
            found += check(sources.global_shape(link, name), None if names else link)
        item.Findings = [str(one) for one in found]
        bad = sum(one.good is False for one in found)
        item.Good = bad == 0
        item.Verdict = "Nothing bad was found" if item.Good else f"{counted(bad, 'finding')} bad"


def new(document, link, name="Check"):
    """A check of an object, of (object, [names of parts]), or of what is chosen later."""
    item = feature.new_object(document, Check, name, "App::FeaturePython")
    if link is not None:
        item.Target = link if isinstance(link, tuple) else (link, [""])
    return item
