# SPDX-License-Identifier: Apache-2.0
"""*Curvature Comb and Audit*: what the curvature of edges is like, and how much of it their points force."""
import math

import FreeCAD
import obvid
import Part

from . import feature, geometry, preferences, sources
from .fair_curve import FairCurve, counted


class Edge:
    """What was found about one edge."""

    def __init__(self, vertices, inflections, steps, places, exact):
        self.vertices = vertices
        self.inflections = inflections
        self.steps = steps  #: joints that are not G2: corners and steps of curvature
        self.places = places  #: of vertices: FreeCAD.Vector
        self.exact = exact  #: counted by the library, not sampled


def audit_in_plane(edges, plane):
    """Edges of one plane: the library reads their own control points and counts exactly."""
    found = obvid.analyse(
        obvid.read_text(geometry.drawing_of(edges, plane), "edges.dxf"), units="mm", drawing="exact"
    )
    curves = getattr(found, "curves", None)
    if curves is None:
        raise feature.NotThere("these edges are read as a polyline of points: nothing bends")
    places = [(p["kind"], plane.multVec(FreeCAD.Vector(p["x"], p["y"], 0.0)))
              for curve in curves for p in curve["places"]]  # fmt: skip
    vertices = sum(curve["vertices"] for curve in curves)
    inflections = sum(curve["inflections"] for curve in curves)
    steps = sum(kind not in ("vertex", "inflection") for kind, _ in places)
    return Edge(vertices, inflections, steps, [p for kind, p in places if kind == "vertex"], True)


def audit_in_space(edge):
    """An edge of no plane: the library looks at places of its spans."""
    curve = geometry.bspline_of_edge(edge)
    poles = [(p.x, p.y, p.z) for p in curve.getPoles()]
    knots = geometry.flat_knots(curve.getKnots(), curve.getMultiplicities())
    found = obvid.space_audit(poles, knots, curve.Degree, curve.getWeights())
    places = [FreeCAD.Vector(*place["point"]) for place in found["places"]]
    return Edge(found["vertices"], 0, found["steps"], places, False)


def points_behind(item, edges):
    """Chains of points that the edges go through, each with whether it closes: of the property, of the Fair
    Curve, else the joints of the edges; and what they are called."""
    if item.Points:
        return [sources.points_of_link(link, subs) for link, subs in sources.links(item.Points)], "points"
    links = sources.links(item.Edges)
    if len(links) == 1 and feature.of_kind(links[0][0], FairCurve):
        series = sources.series_of(links[0][0].Sources, links[0][0].Cells, links[0][0].File)
        if series.file is None:
            return [(series.points, series.closed or links[0][0].Closed == "closed")], "points"
    return [sources.points_of_edges(chain) for chain in Part.sortEdges(edges)], "joints"


def forced_by_all(chains):
    """Sum over all chains, or None where one of them is not known."""
    each = [forced(points, closed) for points, closed in chains]
    return None if None in each else sum(each)


def forced(points, closed):
    """Vertices that points force on every curve through them, or None where that is not known."""
    plane = geometry.plane_of_points(points)
    if plane is None:
        return None
    if len(points) < 4:
        return 0
    flat = [(p.x, p.y) for p in map(plane.inverse().multVec, points)]
    try:
        return obvid.analyse(flat + flat[:1] if closed else flat, units="mm").vertices_lower_bound
    except obvid.ObvidError:
        return None


def edges_of(item):
    out = []
    for link, subs in sources.links(item.Edges):
        for sub in [sub for sub in subs if sub] or [""]:
            out += sources.global_shape(link, sub).Edges
    if not out:
        raise feature.NotThere("choose edges, or an object that has some")
    return out


def comb(edges, teeth, share):
    """Teeth along the normals, as long as the curvature is large, the outline of their tips, both as wires."""
    rows, largest = [], 0.0
    size = max(Part.makeCompound(edges).BoundBox.DiagonalLength, 1e-300)
    for edge in edges:
        first, last = edge.ParameterRange
        row = []
        for k in range(teeth + 1):
            u = first + (last - first) * k / teeth
            bend = edge.curvatureAt(u)
            if not math.isfinite(bend):
                continue
            straight = bend <= geometry.ROUNDING / size
            normal = FreeCAD.Vector() if straight else edge.normalAt(u)
            row.append((edge.valueAt(u), normal, bend))
            largest = max(largest, bend)
        rows.append(row)
    scale = share * size / largest if largest > 0.0 else 0.0
    shapes = []
    for row in rows:
        tips = [p - n * (scale * bend) for p, n, bend in row]
        near = 1e-7
        shapes += [Part.makeLine(p, tip) for (p, _, _), tip in zip(row, tips) if (tip - p).Length > near]
        apart = [tips[0]] + [b for a, b in zip(tips, tips[1:]) if (b - a).Length > near]
        if len(apart) > 1:
            shapes.append(Part.makePolygon(apart))
    return shapes, largest


class CurvatureAudit(feature.Feature):
    """The comb is its shape; what was found stands in its verdict."""

    KIND = "CurvatureAudit"
    INPUTS = {
        "Edges": ("App::PropertyLinkSubList", "Audit", "Edges, or objects whose edges are meant", None),
        "Points": ("App::PropertyLinkSubList", "Audit", "Points that force vertices; empty: those of the edges",
                   None),
        "Teeth": ("App::PropertyIntegerConstraint", "Comb", "Teeth on each edge", None),
        "Height": ("App::PropertyFloatConstraint", "Comb", "Tallest tooth, share of the size", None),
        "ShowVertices": ("App::PropertyBool", "Comb", "Mark vertices", True),
    }  # fmt: skip
    RESULTS = {
        **feature.Feature.RESULTS,
        "Vertices": ("App::PropertyInteger", "Extrema of the curvature of the edges"),
        "LowerBound": ("App::PropertyInteger", "Vertices that the points force; -1: unknown"),
        "Inflections": ("App::PropertyInteger", "Changes of the sign of the curvature"),
        "Steps": ("App::PropertyInteger", "Joints where curvature or direction steps"),
        "Places": ("App::PropertyVectorList", "Where the vertices are"),
        "LeastRadius": ("App::PropertyLength", "Where the edges bend most"),
    }

    def add_properties(self, item):
        new = "Teeth" not in item.PropertiesList
        super().add_properties(item)
        if new:
            item.Teeth = (preferences.teeth(), 10, 5000, 10)
            item.Height = (preferences.comb_height(), 0.001, 2.0, 0.01)

    def build(self, item):
        edges = edges_of(item)
        plane = geometry.plane_of_points([p for e in edges for p in geometry.bspline_of_edge(e).getPoles()])
        if plane is not None:
            parts = [audit_in_plane(edges, plane)]
        else:
            parts = [audit_in_space(edge) for edge in edges]
        chains, kind = points_behind(item, edges)
        least = forced_by_all(chains)
        shapes, largest = comb(edges, item.Teeth, item.Height)
        feature.place(item, Part.makeCompound(shapes), FreeCAD.Placement())
        item.Places = [place for part in parts for place in part.places]
        item.Vertices = sum(part.vertices for part in parts)
        item.Inflections = sum(part.inflections for part in parts)
        item.Steps = sum(part.steps for part in parts)
        item.LowerBound = -1 if least is None else least
        item.LeastRadius = 1.0 / largest if largest > 0.0 else 0.0
        item.Verdict = self.verdict(item, len(edges), all(part.exact for part in parts), kind)

    @staticmethod
    def verdict(item, n, exact, kind):
        text = "this edge has" if n == 1 else f"these {n} edges have"
        text += f" {counted(item.Vertices, 'vertex', 'vertices')}"
        if item.LowerBound >= 0:
            text = f"The {kind} force {item.LowerBound}, {text}"
        text = text[0].upper() + text[1:]
        text += f"; {counted(item.Inflections, 'inflection')}" if exact else " (sampled)"
        if item.Steps:
            text += f"; curvature or direction steps at {counted(item.Steps, 'joint')}"
        return text


def new(document, links, name="CurvatureAudit", **properties):
    """A comb over edges: objects, or (object, [names of edges])."""
    item = feature.new_object(document, CurvatureAudit, name)
    item.Edges = [link if isinstance(link, tuple) else (link, [""]) for link in links]
    for key, value in properties.items():
        setattr(item, key, value)
    return item
