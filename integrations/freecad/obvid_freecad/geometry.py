# SPDX-License-Identifier: Apache-2.0
"""Curves and surfaces on their way between the library and Open CASCADE: always as NURBS (degree, knots,
control points, weights), never as points."""
import json
import math

import FreeCAD
import Part

#: Distances below this share of the size are none: rounding of coordinates.
ROUNDING = 1e-9
#: Highest degree that the library reads.
MOST_DEGREE = 9


def knots_and_multiplicities(flat):
    """Each knot once, and how often it stands there."""
    knots, times = [], []
    for knot in flat:
        if knots and knot == knots[-1]:
            times[-1] += 1
        else:
            knots.append(knot)
            times.append(1)
    return knots, times


def flat_knots(knots, times):
    return [knot for knot, n in zip(knots, times) for _ in range(n)]


def curve_of(points, flat, degree, weights):
    """A Part.BSplineCurve; points are triples."""
    knots, times = knots_and_multiplicities(flat)
    curve = Part.BSplineCurve()
    poles = [FreeCAD.Vector(*p) for p in points]
    curve.buildFromPolesMultsKnots(poles, times, knots, False, degree, list(weights))
    return curve


def parts_at_corners(points, flat, degree, weights):
    """A curve cut where a knot of full multiplicity says that it has a corner: the numbers stay."""
    knots, times = knots_and_multiplicities(flat)
    first, out, begin = 0, [], 0
    for k in range(1, len(knots)):
        begin_of_next = first + sum(times[begin + 1 : k + 1])
        if k < len(knots) - 1 and times[k] < degree:
            continue
        last = begin_of_next if k < len(knots) - 1 else len(points) - 1
        inner = flat_knots(knots[begin + 1 : k], times[begin + 1 : k])
        own = [knots[begin]] * (degree + 1) + inner + [knots[k]] * (degree + 1)
        out.append((points[first : last + 1], own, degree, weights[first : last + 1]))
        first, begin = last, k
    return out


def shape_of_curves(curves):
    """One edge, or a wire of several that meet in corners."""
    edges = [curve.toShape() for curve in curves]
    if len(edges) == 1:
        return edges[0]
    return Part.Wire(edges)


def shape_of_bspline(spline):
    """The shape of an obvid.BSpline, in the plane z = 0."""
    points = [(x, y, 0.0) for x, y in spline.c.tolist()]
    parts = parts_at_corners(points, spline.t.tolist(), spline.k, spline.weights.tolist())
    return shape_of_curves([curve_of(*part) for part in parts])


def shape_of_space_curve(curve):
    """The shape of an obvid.SpaceCurve."""
    nurbs = [part["curve"] for part in curve.parts]
    pieces = []
    for one in nurbs:
        weights = one["weights"] or [1.0] * len(one["points"])
        pieces += parts_at_corners(one["points"], one["knots"], one["degree"], weights)
    return shape_of_curves([curve_of(*piece) for piece in pieces])


def face_of_patch(patch):
    """The face of a patch of a stored surface (docs/formats.md, Surfaces)."""
    u, times_u = knots_and_multiplicities(patch["knots_u"])
    v, times_v = knots_and_multiplicities(patch["knots_v"])
    across = len(patch["knots_u"]) - patch["degree_u"] - 1
    points, weights = patch["points"], patch.get("weights") or [1.0] * len(patch["points"])
    rows = len(points) // across
    poles = [[FreeCAD.Vector(*points[j * across + i]) for j in range(rows)] for i in range(across)]
    shares = [[weights[j * across + i] for j in range(rows)] for i in range(across)]
    surface = Part.BSplineSurface()
    surface.buildFromPolesMultsKnots(
        poles, times_u, times_v, u, v, False, False, patch["degree_u"], patch["degree_v"], shares
    )
    return surface.toShape()


def shape_of_surface(surface):
    """The shape of an obvid.Surface: one face, or a shell of several."""
    faces = [face_of_patch(patch) for patch in json.loads(surface.data("json"))["patches"]]
    if len(faces) == 1:
        return faces[0]
    shell = Part.makeCompound(faces)
    shell.sewShape()
    return shell


# ---- towards the library -----------------------------------------------------------------------


def bspline_of_edge(edge):
    """An edge as a clamped Part.BSplineCurve in the document's coordinates."""
    if not isinstance(edge.Curve, Part.BSplineCurve):
        edge = edge.toNurbs().Edges[0]
    curve = edge.Curve.copy()
    periodic = curve.isPeriodic()
    if periodic:
        curve.setNotPeriodic()  # leaves knots beyond both ends, which segment() takes away
    first, last = edge.ParameterRange
    ends = curve.FirstParameter, curve.LastParameter
    if periodic or (first, last) != ends:
        curve.segment(max(first, ends[0]), min(last, ends[1]))
    return curve


def in_plane(placement, vector):
    return placement.inverse().multVec(vector)


def plane_of_points(points):
    """A placement whose plane z = 0 holds all points within rounding, or None. The plane z = const keeps the
    axes of the document; others have x along the first points."""
    if not points:
        return None
    origin = points[0]
    size = max((p - origin).Length for p in points)
    if size == 0.0:
        return FreeCAD.Placement(origin, FreeCAD.Rotation())
    near = ROUNDING * size
    if all(abs(p.z - origin.z) <= near for p in points):
        return FreeCAD.Placement(FreeCAD.Vector(0, 0, origin.z), FreeCAD.Rotation())
    along = max(points, key=lambda p: (p - origin).Length) - origin
    along.normalize()
    off = max(points, key=lambda p: ((p - origin) - along * along.dot(p - origin)).Length) - origin
    across = off - along * along.dot(off)
    if across.Length <= near:  # on a line: any plane through it
        across = FreeCAD.Vector(0, 0, 1).cross(along)
        if across.Length <= ROUNDING:
            across = FreeCAD.Vector(1, 0, 0)
    normal = along.cross(across)
    normal.normalize()
    if any(abs(normal.dot(p - origin)) > near for p in points):
        return None
    if normal.z < 0 or (normal.z == 0 and normal.y > 0):  # seen from above, or from the front
        normal = normal * -1.0
    x = points[1] - origin if (points[1] - origin).Length > near else along
    x = x - normal * normal.dot(x)
    x.normalize()
    y = normal.cross(x)
    return FreeCAD.Placement(origin, FreeCAD.Rotation(x, y, normal, "ZXY"))


def plane_of_edge(edge):
    """The plane of an edge, or None. Control points lie in it, not only points of the curve."""
    return plane_of_points(bspline_of_edge(edge).getPoles())


def _entity(kind, *pairs):
    lines = ["0", kind, "8", "0"]
    for code, value in pairs:
        lines += [str(code), repr(float(value)) if isinstance(value, float) else str(value)]
    return lines


def _spline_entity(curve, placement):
    flat = flat_knots(curve.getKnots(), curve.getMultiplicities())
    weights = curve.getWeights()
    rational = max(weights) != min(weights)
    pairs = [(70, 12 if rational else 8), (71, curve.Degree), (72, len(flat)), (73, curve.NbPoles), (74, 0)]
    pairs += [(40, float(knot)) for knot in flat]
    if rational:
        pairs += [(41, float(weight)) for weight in weights]
    for pole in curve.getPoles():
        p = in_plane(placement, pole)
        pairs += [(10, p.x), (20, p.y), (30, 0.0)]
    return _entity("SPLINE", *pairs)


def _entity_of_edge(edge, placement):
    curve = edge.Curve
    first, last = edge.ParameterRange
    if isinstance(curve, (Part.Line, Part.LineSegment)):
        a, b = (in_plane(placement, edge.valueAt(t)) for t in (first, last))
        return _entity("LINE", (10, a.x), (20, a.y), (11, b.x), (21, b.y))
    if isinstance(curve, (Part.Circle, Part.ArcOfCircle)):
        center = in_plane(placement, curve.Center)
        if edge.isClosed():
            return _entity("CIRCLE", (10, center.x), (20, center.y), (40, curve.Radius))
        turned = placement.inverse().Rotation.multVec(curve.Axis).z < 0.0
        ends = [in_plane(placement, edge.valueAt(t)) - center for t in (first, last)]
        angles = [math.degrees(math.atan2(p.y, p.x)) for p in (ends[::-1] if turned else ends)]
        pairs = [(10, center.x), (20, center.y), (40, curve.Radius), (50, angles[0]), (51, angles[1])]
        return _entity("ARC", *pairs)
    spline = bspline_of_edge(edge)
    if spline.Degree > MOST_DEGREE:
        raise ValueError(f"curves of degree {spline.Degree} are not read, {MOST_DEGREE} is the most")
    return _spline_entity(spline, placement)


def drawing_of(edges, placement):
    """Edges of a plane as a DXF text that holds their own numbers."""
    lines = ["0", "SECTION", "2", "HEADER", "9", "$INSUNITS", "70", "4", "0", "ENDSEC"]
    lines += ["0", "SECTION", "2", "ENTITIES"]
    for edge in edges:
        lines += _entity_of_edge(edge, placement)
    return "\n".join(lines + ["0", "ENDSEC", "0", "EOF"]) + "\n"


def patch_of_face(face, name):
    """A face as a patch of a stored surface: its whole box of parameters."""
    if not isinstance(face.Surface, Part.BSplineSurface):
        face = face.toNurbs().Faces[0]
    surface = face.Surface.copy()
    periodic = surface.isUPeriodic(), surface.isVPeriodic()
    if periodic[0]:
        surface.setUNotPeriodic()
    if periodic[1]:
        surface.setVNotPeriodic()
    low_u, high_u, low_v, high_v = face.ParameterRange
    ends = tuple(surface.bounds())
    box = (max(low_u, ends[0]), min(high_u, ends[1]), max(low_v, ends[2]), min(high_v, ends[3]))
    if any(periodic) or box != ends:
        surface.segment(*box)
    poles, weights = surface.getPoles(), surface.getWeights()
    columns = range(len(poles[0]))
    return {
        "name": name,
        "degree_u": surface.UDegree,
        "degree_v": surface.VDegree,
        "knots_u": flat_knots(surface.getUKnots(), surface.getUMultiplicities()),
        "knots_v": flat_knots(surface.getVKnots(), surface.getVMultiplicities()),
        "points": [[row[j].x, row[j].y, row[j].z] for j in columns for row in poles],
        "weights": [row[j] for j in columns for row in weights],
    }


def stored_surface_of(faces):
    """Faces as the text of a stored surface."""
    patches = [patch_of_face(face, f"Face{i + 1}") for i, face in enumerate(faces)]
    return json.dumps(
        {"format": "obvid-surface", "version": 1, "name": "shape", "units": "mm", "patches": patches}
    )


# ---- measured by Open CASCADE ------------------------------------------------------------------


def joint_gaps(curve):
    """Largest steps of a B-spline at its inner knots, as Open CASCADE evaluates both sides: position (mm),
    direction (rad), curvature (of the curve's largest)."""
    knots = curve.getKnots()
    place = turn = step = largest = 0.0
    behind = None
    for a, b in zip(knots, knots[1:]):
        part = curve.copy()
        part.segment(a, b)
        first, last = part.FirstParameter, part.LastParameter
        middle = 0.5 * (first + last)
        bends = [_curvature(part, u) for u in (first, middle, last)]
        largest = max(largest, *bends)
        if behind is not None:
            point, direction, bend = behind
            place = max(place, (part.value(first) - point).Length)
            turn = max(turn, direction.getAngle(part.tangent(first)[0]))
            step = max(step, abs(bends[0] - bend))
        behind = part.value(last), part.tangent(last)[0], bends[2]
    return place, turn, step / largest if largest > 0.0 else 0.0


def _curvature(curve, u):
    try:
        return curve.curvature(u)
    except Exception:  # Part.OCCError: no tangent there
        return math.inf
