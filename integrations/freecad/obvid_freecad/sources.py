# SPDX-License-Identifier: Apache-2.0
"""Points of the objects of a document: sketches, vertices, wires, spreadsheets, files."""
import re

import FreeCAD
import Part

from . import geometry

#: Vertices nearer than this share of the size are one.
SAME = 1e-9


class Series:
    """Points of a contour. `plane` is None where they lie in none; `file` stands in place of points."""

    def __init__(self, points, plane, closed, file=None):
        self.points = points  #: FreeCAD.Vector, coordinates of the document
        self.plane = plane
        self.closed = closed  #: where they come from a closed chain of edges
        self.file = file

    def flat(self):
        """Pairs in the plane."""
        back = self.plane.inverse()
        return [(p.x, p.y) for p in map(back.multVec, self.points)]

    def spatial(self):
        return [(p.x, p.y, p.z) for p in self.points]


def is_sketch(item):
    return item.isDerivedFrom("Sketcher::SketchObject")


def is_spreadsheet(item):
    return item.isDerivedFrom("Spreadsheet::Sheet")


def global_placement(item):
    return item.getGlobalPlacement() if hasattr(item, "getGlobalPlacement") else FreeCAD.Placement()


def global_shape(item, sub=""):
    """The shape of an object, or of a part of it, where it is in the document."""
    shape = Part.getShape(item, sub, needSubElement=bool(sub))
    if shape.isNull():
        raise ValueError(f"{item.Label} {sub} has no shape")
    if hasattr(item, "Placement"):
        container = global_placement(item).multiply(item.Placement.inverse())
        if not container.isIdentity():
            shape = shape.copy()
            shape.Placement = container.multiply(shape.Placement)
    return shape


def points_of_edge(edge):
    """The points that an edge was drawn through, in its direction: knots of a spline (an interpolating one
    has its points there), ends of others, and the middle of arcs."""
    curve = edge.Curve
    first, last = edge.ParameterRange
    at = [first, last]
    if isinstance(curve, Part.BSplineCurve):
        at = [first] + [k for k in curve.getKnots() if first < k < last] + [last]
    elif not isinstance(curve, (Part.Line, Part.LineSegment)):
        at = [first, 0.5 * (first + last), last]
    points = [edge.valueAt(t) for t in at]
    return points[::-1] if edge.Orientation == "Reversed" else points


def points_of_edges(edges):
    """Points of a chain of edges, and whether it closes."""
    chains = Part.sortEdges(edges)
    if len(chains) > 1:
        raise ValueError(f"the edges are no chain: {len(chains)} pieces do not meet")
    out = []
    for edge in chains[0]:
        points = points_of_edge(edge)
        out += points[1:] if out and _same(out[-1], points[0], edge) else points
    closed = len(out) > 2 and _same(out[0], out[-1], chains[0][0])
    return (out[:-1] if closed else out), closed


def _same(a, b, edge):
    return (a - b).Length <= max(SAME * edge.BoundBox.DiagonalLength, 1e-7)


def points_of_sketch(sketch):
    """Points of a sketch in its order, construction points too; without any, of its lines and curves."""
    place = global_placement(sketch)
    points = [FreeCAD.Vector(g.X, g.Y, g.Z) for g in sketch.Geometry if isinstance(g, Part.Point)]
    if points:
        return [place.multVec(p) for p in points], False
    edges = global_shape(sketch).Edges
    if not edges:
        raise ValueError(f"{sketch.Label} has neither points nor curves")
    return points_of_edges(edges)


CELL = re.compile(r"^([A-Za-z]{1,2})([1-9][0-9]*)$")


def _column(letters):
    number = 0
    for letter in letters.upper():
        number = 26 * number + ord(letter) - ord("A") + 1
    return number


def _letters(column):
    out = ""
    while column:
        column, digit = divmod(column - 1, 26)
        out = chr(ord("A") + digit) + out
    return out


def points_of_cells(sheet, cells):
    """Rows of a range "A2:B40" of two or three columns; without one all rows of numbers from A1 on."""
    if cells:
        ends = [CELL.match(end.strip()) for end in cells.split(":")]
        if len(ends) != 2 or not all(ends):
            raise ValueError(f'"{cells}" is no range of cells such as A2:B40')
        (left, top), (right, bottom) = [(_column(e.group(1)), int(e.group(2))) for e in ends]
        if right - left not in (1, 2) or bottom < top:
            raise ValueError(f"{cells} are not two or three columns of points")
        return [_row(sheet, row, range(left, right + 1), True) for row in range(top, bottom + 1)]
    width = 3 if _number(sheet, 3, 1) is not None or _number(sheet, 3, 2) is not None else 2
    out, row = [], 1
    while True:
        point = _row(sheet, row, range(1, width + 1), False)
        if point is None and (out or row > 1):
            break
        if point is not None:
            out.append(point)
        row += 1
    if not out:
        raise ValueError(f"{sheet.Label} has no points in the columns A and B")
    return out


def _row(sheet, row, columns, needed):
    values = [_number(sheet, column, row) for column in columns]
    if any(value is None for value in values):
        if needed:
            raise ValueError(f"row {row} of {sheet.Label} holds no point")
        return None
    return FreeCAD.Vector(*(values + [0.0])[:3])


def _number(sheet, column, row):
    try:
        value = sheet.get(f"{_letters(column)}{row}")
    except ValueError:  # an empty cell
        return None
    value = getattr(value, "Value", value)
    return float(value) if isinstance(value, (int, float)) else None


def points_of_link(item, subs, cells=""):
    """Points of an object or of its named parts, and whether they are a closed chain."""
    subs = [sub for sub in subs if sub]
    if is_spreadsheet(item):
        return points_of_cells(item, cells), False
    if subs:
        shapes = [global_shape(item, sub) for sub in subs]
        if all(shape.ShapeType == "Vertex" for shape in shapes):
            return [shape.Point for shape in shapes], False
        if all(shape.ShapeType == "Edge" for shape in shapes):
            return points_of_edges(shapes)
        raise ValueError(f"of {item.Label} take vertices or edges, not {', '.join(subs)}")
    if is_sketch(item):
        return points_of_sketch(item)
    shape = global_shape(item)
    if shape.Edges:
        return points_of_edges(shape.Edges)
    return [vertex.Point for vertex in shape.Vertexes], False


def links(value):
    """(object, [names of parts]) of a PropertyLinkSubList, in order; parts of one object stay together."""
    out = []
    for item, subs in value or []:
        subs = [subs] if isinstance(subs, str) else list(subs)
        if out and out[-1][0] is item:
            out[-1][1].extend(subs)
        else:
            out.append((item, subs))
    return out


def series_of(sources, cells="", file=""):
    """The series of a feature."""
    import obvid

    given = links(sources)
    if file:
        if given:
            raise ValueError("points come from objects or from a file, not from both")
        return Series([], FreeCAD.Placement(), None, obvid.read(file))
    if not given:
        raise ValueError("there are no points: choose a sketch, vertices, a wire, a spreadsheet or a file")
    points, closed = [], False
    for item, subs in given:
        some, closed = points_of_link(item, subs, cells)
        points += some
    closed = closed and len(given) == 1
    if len(given) == 1 and is_sketch(given[0][0]):
        plane = global_placement(given[0][0])
    else:
        plane = geometry.plane_of_points(points)
    return Series(points, plane, closed)
