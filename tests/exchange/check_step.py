# SPDX-License-Identifier: Apache-2.0
"""Judges a STEP file of curves: its syntax (ISO 10303-21) and what the schemas want of its entities.

usage: check_step.py FILE

Shares nothing with the writer: the grammar is that of clause 5.2 and annex A of ISO 10303-21:2002
(internal mapping), the attributes and rules are those of ISO 10303-42, -41 and the AP214 schema.
Prints one fault per line, nothing when there is none.
"""
import math
import re
import sys

TOKEN = re.compile(r"""
    (?P<space>[ \n]+|/\*.*?\*/)
  | (?P<real>[+-]?[0-9]+\.[0-9]*(?:E[+-]?[0-9]+)?)
  | (?P<integer>[+-]?[0-9]+)
  | (?P<ref>\#[0-9]+)
  | (?P<enum>\.[A-Z_][A-Z0-9_]*\.)
  | (?P<string>'(?:[^'\\\n]|''|\\\\|\\X[24]\\(?:[0-9A-F]{4})+\\X0\\)*')
  | (?P<word>!?[A-Z_][A-Z0-9_]*(?:-[A-Z0-9]+)*)
  | (?P<sign>[()=;,$*])
""", re.VERBOSE | re.DOTALL)

# s: string, r: real, i: integer, e: enumeration or logical, #: instance, $: not given, *: derived;
# [x]: list of x; LENGTH_MEASURE(r): a typed value; |: one of
ATTRIBUTES = {
    "CARTESIAN_POINT": ["s", "[r]"],
    "DIRECTION": ["s", "[r]"],
    "VECTOR": ["s", "#", "r"],
    "AXIS2_PLACEMENT_3D": ["s", "#", "#", "#"],
    "LINE": ["s", "#", "#"],
    "CIRCLE": ["s", "#", "r"],
    "ELLIPSE": ["s", "#", "r", "r"],
    "TRIMMED_CURVE": ["s", "#", "[t]", "[t]", "e", "e"],
    "COMPOSITE_CURVE_SEGMENT": ["e", "e", "#"],
    "COMPOSITE_CURVE": ["s", "[#]", "e"],
    "B_SPLINE_CURVE_WITH_KNOTS": ["s", "i", "[#]", "e", "e", "e", "[i]", "[r]", "e"],
    "GEOMETRIC_CURVE_SET": ["s", "[#]"],
    "GEOMETRICALLY_BOUNDED_WIREFRAME_SHAPE_REPRESENTATION": ["s", "[#]", "#"],
    "SHAPE_REPRESENTATION": ["s", "[#]", "#"],
    "MANIFOLD_SURFACE_SHAPE_REPRESENTATION": ["s", "[#]", "#"],
    "SHAPE_REPRESENTATION_RELATIONSHIP": ["s", "s", "#", "#"],
    "SHELL_BASED_SURFACE_MODEL": ["s", "[#]"],
    "OPEN_SHELL": ["s", "[#]"],
    "ADVANCED_FACE": ["s", "[#]", "#", "e"],
    "FACE_OUTER_BOUND": ["s", "#", "e"],
    "EDGE_LOOP": ["s", "[#]"],
    "ORIENTED_EDGE": ["s", "*", "*", "#", "e"],
    "EDGE_CURVE": ["s", "#", "#", "#", "e"],
    "VERTEX_POINT": ["s", "#"],
    "PLANE": ["s", "#"],
    "CYLINDRICAL_SURFACE": ["s", "#", "r"],
    "SURFACE_OF_LINEAR_EXTRUSION": ["s", "#", "#"],
    "LENGTH_MEASURE_WITH_UNIT": ["t", "#"],
    "DIMENSIONAL_EXPONENTS": ["r"] * 7,
    "UNCERTAINTY_MEASURE_WITH_UNIT": ["t", "#", "s", "s"],
    "APPLICATION_CONTEXT": ["s"],
    "APPLICATION_PROTOCOL_DEFINITION": ["s", "s", "i", "#"],
    "PRODUCT_CONTEXT": ["s", "#", "s"],
    "PRODUCT": ["s", "s", "s", "[#]"],
    "PRODUCT_RELATED_PRODUCT_CATEGORY": ["s", "$", "[#]"],
    "PRODUCT_DEFINITION_FORMATION": ["s", "s", "#"],
    "PRODUCT_DEFINITION_CONTEXT": ["s", "#", "s"],
    "PRODUCT_DEFINITION": ["s", "s", "#", "#"],
    "PRODUCT_DEFINITION_SHAPE": ["s", "s", "#"],
    "SHAPE_DEFINITION_REPRESENTATION": ["#", "#"],
}
# of complex instances: each part alone
PARTS = {
    "BOUNDED_CURVE": [],
    "B_SPLINE_CURVE": ["i", "[#]", "e", "e", "e"],
    "B_SPLINE_CURVE_WITH_KNOTS": ["[i]", "[r]", "e"],
    "CURVE": [],
    "GEOMETRIC_REPRESENTATION_ITEM": [],
    "RATIONAL_B_SPLINE_CURVE": ["[r]"],
    "REPRESENTATION_ITEM": ["s"],
    "LENGTH_UNIT": [],
    "PLANE_ANGLE_UNIT": [],
    "SOLID_ANGLE_UNIT": [],
    "NAMED_UNIT": ["*|#"],
    "SI_UNIT": ["$|e", "e"],
    "CONVERSION_BASED_UNIT": ["s", "#"],
    "GEOMETRIC_REPRESENTATION_CONTEXT": ["i"],
    "GLOBAL_UNCERTAINTY_ASSIGNED_CONTEXT": ["[#]"],
    "GLOBAL_UNIT_ASSIGNED_CONTEXT": ["[#]"],
    "REPRESENTATION_CONTEXT": ["s", "s"],
}
LOGICALS = {".T.", ".F.", ".U."}
CURVES_OF_A_SET = {"TRIMMED_CURVE", "COMPOSITE_CURVE", "CIRCLE", "ELLIPSE",
                   "B_SPLINE_CURVE_WITH_KNOTS"}
BOUNDED = {"TRIMMED_CURVE", "B_SPLINE_CURVE_WITH_KNOTS"}
REACH = 1e-9  # of the largest coordinate: what trimmed curves may miss their points by

faults = []


class Syntax(Exception):
    pass


class Parser:
    """Records as (name, [parameters]); a parameter is (kind, text), ("list", [...]) or
    ("typed", (name, [parameters]))."""

    def __init__(self, text):
        self.tokens, at = [], 0
        while at < len(text):
            match = TOKEN.match(text, at)
            if match is None:
                raise Syntax(f"no token: {text[at:at + 30]!r}")
            at = match.end()
            if match.lastgroup != "space":
                self.tokens.append((match.lastgroup, match.group()))
        self.at = 0

    def peek(self):
        return self.tokens[self.at][1] if self.at < len(self.tokens) else None

    def take(self, text=None, kind=None):
        if self.at == len(self.tokens):
            raise Syntax("the file ends too early")
        found = self.tokens[self.at]
        if (text is not None and found[1] != text) or (kind is not None and found[0] != kind):
            raise Syntax(f"{text or kind} expected, {found[1]} found")
        self.at += 1
        return found

    def parameter(self):
        if self.peek() == "(":
            return ("list", self.parameters())
        kind, text = self.take()
        if kind == "word":
            return ("typed", (text, self.parameters()))
        if kind == "sign" and text not in "$*":
            raise Syntax(f"a parameter expected, {text} found")
        return (kind, text)

    def parameters(self):
        self.take("(")
        out = []
        while self.peek() != ")":
            if out:
                self.take(",")
            out.append(self.parameter())
        self.take(")")
        return out

    def record(self):
        return (self.take(kind="word")[1], self.parameters())

    def file(self):
        self.take("ISO-10303-21"), self.take(";"), self.take("HEADER"), self.take(";")
        header = []
        while self.peek() != "ENDSEC":
            header.append(self.record())
            self.take(";")
        self.take("ENDSEC"), self.take(";"), self.take("DATA"), self.take(";")
        instances = {}
        while self.peek() != "ENDSEC":
            name = self.take(kind="ref")[1]
            self.take("=")
            if name in instances:
                raise Syntax(f"{name} is there twice")
            if self.peek() == "(":
                self.take("(")
                parts = []
                while self.peek() != ")":
                    parts.append(self.record())
                self.take(")")
                instances[name] = parts
            else:
                instances[name] = [self.record()]
            self.take(";")
        self.take("ENDSEC"), self.take(";"), self.take("END-ISO-10303-21"), self.take(";")
        if self.at != len(self.tokens):
            raise Syntax("something follows the end")
        return header, instances


def fits(value, form):
    kind, inside = value
    if "|" in form:
        return any(fits(value, one) for one in form.split("|"))
    if form.startswith("["):
        return kind == "list" and inside and all(fits(one, form[1:-1]) for one in inside)
    if form == "t":  # of a select type: a reference, or a value with its type
        return kind == "ref" or (kind == "typed" and len(inside[1]) == 1
                                 and fits(inside[1][0], "r"))
    if form in "$*":
        return inside == form
    return kind == {"s": "string", "r": "real", "i": "integer", "e": "enum", "#": "ref"}[form]


class Model:
    def __init__(self, instances):
        self.all = instances

    def kinds(self, ref):
        return {name for name, _ in self.all[ref]}

    def part(self, ref, name):
        for one, values in self.all[ref]:
            if one == name:
                return values
        return None

    def numbers(self, ref, name):
        return [float(v) for _, v in self.part(ref, name)[1][1]]

    def point(self, ref):
        return self.numbers(ref, "CARTESIAN_POINT")

    def fault(self, ref, text):
        faults.append(f"{ref} {'/'.join(sorted(self.kinds(ref)))}: {text}")

    def check(self):
        for ref, parts in self.all.items():
            table = PARTS if len(parts) > 1 else ATTRIBUTES
            names = [name for name, _ in parts]
            if names != sorted(set(names)):
                self.fault(ref, "parts are not in the order of the alphabet")
            for name, values in parts:
                if name not in table:
                    self.fault(ref, f"{name} is not known")
                elif len(values) != len(table[name]):
                    self.fault(ref, f"{len(values)} attributes, {len(table[name])} wanted")
                else:
                    for place, (value, form) in enumerate(zip(values, table[name])):
                        if not fits(value, form):
                            self.fault(ref, f"attribute {place + 1} is {value}, {form} wanted")
                for other in references(("list", values)):
                    if other not in self.all:
                        self.fault(ref, f"{other} is not there")
        if not faults:
            self.rules()

    def rules(self):
        used = {other for parts in self.all.values() for _, values in parts
                for other in references(("list", values))}
        roots = {"SHAPE_DEFINITION_REPRESENTATION", "SHAPE_REPRESENTATION_RELATIONSHIP",
                 "APPLICATION_PROTOCOL_DEFINITION", "PRODUCT_RELATED_PRODUCT_CATEGORY"}
        for ref in self.all:
            if ref not in used and not self.kinds(ref) & roots:
                self.fault(ref, "nobody uses it")
            for kind in self.kinds(ref):
                rule = getattr(self, "rule_" + kind.lower(), None)
                if rule:
                    rule(ref)
        for one in ("PRODUCT", "SHAPE_DEFINITION_REPRESENTATION", "GEOMETRIC_CURVE_SET"):
            count = sum(one in self.kinds(ref) for ref in self.all)
            if count != 1:
                faults.append(f"{count} {one}")

    def rule_direction(self, ref):
        length = sum(x * x for x in self.numbers(ref, "DIRECTION")) ** 0.5
        if abs(length - 1.0) > 1e-15 * 4:
            self.fault(ref, f"its length is {length}")

    def rule_cartesian_point(self, ref):
        if len(self.point(ref)) != 3:
            self.fault(ref, "not three coordinates")

    def rule_axis2_placement_3d(self, ref):
        _, _, z, x = self.part(ref, "AXIS2_PLACEMENT_3D")
        a, b = (self.numbers(one[1], "DIRECTION") for one in (z, x))
        if abs(sum(p * q for p, q in zip(a, b))) > 1e-15:
            self.fault(ref, "its axes are not perpendicular")

    def rule_b_spline_curve_with_knots(self, ref):
        whole = self.part(ref, "B_SPLINE_CURVE")
        with_knots = self.part(ref, "B_SPLINE_CURVE_WITH_KNOTS")
        general = whole if whole else with_knots[1:6]
        counts, knots = (with_knots if whole else with_knots[6:])[:2]
        degree, points = int(general[0][1]), general[1][1]
        times = [int(v) for _, v in counts[1]]
        values = [float(v) for _, v in knots[1]]
        if sum(times) != len(points) + degree + 1 or len(times) != len(values):
            self.fault(ref, "knots and points do not go together")
        if any(a >= b for a, b in zip(values, values[1:])):
            self.fault(ref, "knots do not ascend")
        if max(times[1:-1], default=0) > degree or min(times) < 1 or max(times) > degree + 1:
            self.fault(ref, f"multiplicities {times}")
        closed = self.point(points[0][1]) == self.point(points[-1][1])
        if general[3][1] != (".T." if closed else ".F."):
            self.fault(ref, "closed_curve is not true")
        weights = self.part(ref, "RATIONAL_B_SPLINE_CURVE")
        if weights is not None:
            values = [float(v) for _, v in weights[0][1]]
            if len(values) != len(points) or min(values) <= 0.0:
                self.fault(ref, "weights")
            if len(set(values)) == 1:
                self.fault(ref, "weights that say nothing")

    def place(self, ref):
        at = self.part(ref, "AXIS2_PLACEMENT_3D")
        return (self.point(at[1][1]), self.numbers(at[2][1], "DIRECTION"),
                self.numbers(at[3][1], "DIRECTION"))

    def on_basis(self, ref, t):
        """Point of a LINE, CIRCLE or ELLIPSE at a parameter, as ISO 10303-42 defines it."""
        if "LINE" in self.kinds(ref):
            _, start, vector = self.part(ref, "LINE")
            _, along, size = self.part(vector[1], "VECTOR")
            return [p + t * float(size[1]) * d for p, d in
                    zip(self.point(start[1]), self.numbers(along[1], "DIRECTION"))]
        kind = "CIRCLE" if "CIRCLE" in self.kinds(ref) else "ELLIPSE"
        values = self.part(ref, kind)
        centre, z, x = self.place(values[1][1])
        y = [z[1] * x[2] - z[2] * x[1], z[2] * x[0] - z[0] * x[2], z[0] * x[1] - z[1] * x[0]]
        a, b = float(values[2][1]), float(values[-1][1])
        return [c + a * math.cos(t) * u + b * math.sin(t) * v for c, u, v in zip(centre, x, y)]

    def ends(self, ref):
        """First and last point of a bounded curve."""
        if "TRIMMED_CURVE" in self.kinds(ref):
            values = self.part(ref, "TRIMMED_CURVE")
            return tuple(self.point(values[i][1][0][1]) for i in (2, 3))
        if "COMPOSITE_CURVE" in self.kinds(ref):
            segments = self.part(ref, "COMPOSITE_CURVE")[1][1]
            curves = [self.part(s[1], "COMPOSITE_CURVE_SEGMENT")[2][1] for s in segments]
            return self.ends(curves[0])[0], self.ends(curves[-1])[1]
        whole = self.part(ref, "B_SPLINE_CURVE")
        points = (whole[1] if whole else self.part(ref, "B_SPLINE_CURVE_WITH_KNOTS")[2])[1]
        return self.point(points[0][1]), self.point(points[-1][1])

    def near(self, a, b):
        return max(abs(p - q) for p, q in zip(a, b)) <= REACH * max(map(abs, (*a, *b, 1e-300)))

    def rule_trimmed_curve(self, ref):
        _, basis, first, last, sense, master = self.part(ref, "TRIMMED_CURVE")
        if not self.kinds(basis[1]) & {"LINE", "CIRCLE", "ELLIPSE"}:
            self.fault(ref, "trims another kind of curve")
            return
        reach = max(abs(x) for p in self.ends(ref) for x in p)
        parameters = []
        for trim in (first, last):
            point, value = trim[1]
            parameters.append(float(value[1][1][0][1]))
            at = self.on_basis(basis[1], parameters[-1])
            if max(abs(p - q) for p, q in zip(at, self.point(point[1]))) > REACH * reach:
                self.fault(ref, f"{at} is not {self.point(point[1])}")
        if parameters[0] >= parameters[1] or sense[1] != ".T." or master[1] != ".PARAMETER.":
            self.fault(ref, "direction")

    def rule_composite_curve(self, ref):
        segments = [one[1] for one in self.part(ref, "COMPOSITE_CURVE")[1][1]]
        parts = [self.part(one, "COMPOSITE_CURVE_SEGMENT") for one in segments]
        curves = [part[2][1] for part in parts]
        for one in curves:
            if not self.kinds(one) & BOUNDED:
                self.fault(ref, "a segment without ends")
        for before, after in zip(curves, curves[1:]):
            if not self.near(self.ends(before)[1], self.ends(after)[0]):
                self.fault(ref, "segments do not meet")
        closed = self.near(*self.ends(ref))
        kinds = [part[0][1] for part in parts]
        wanted = [".CONTINUOUS."] * (len(parts) - 1)
        if kinds != wanted + [".CONTINUOUS." if closed else ".DISCONTINUOUS."]:
            self.fault(ref, f"transitions {kinds}")

    def rule_geometric_curve_set(self, ref):
        for one in self.part(ref, "GEOMETRIC_CURVE_SET")[1][1]:
            if not self.kinds(one[1]) & CURVES_OF_A_SET:
                self.fault(ref, f"{one[1]} may not be in it")

    def rule_open_shell(self, ref):
        """Loops close, edges have their vertices, none has two faces on one side."""
        sides = []
        for face in self.part(ref, "OPEN_SHELL")[1][1]:
            for bound in self.part(face[1], "ADVANCED_FACE")[1][1]:
                loop = self.part(bound[1], "FACE_OUTER_BOUND")[1][1]
                ends = []
                for one in self.part(loop, "EDGE_LOOP")[1][1]:
                    edge, forwards = self.part(one[1], "ORIENTED_EDGE")[3:]
                    sides.append((edge[1], forwards[1]))
                    pair = [v[1] for v in self.part(edge[1], "EDGE_CURVE")[1:3]]
                    ends.append(pair if forwards[1] == ".T." else pair[::-1])
                for before, after in zip(ends, ends[1:] + ends[:1]):
                    if before[1] != after[0]:
                        self.fault(loop, "does not close")
        if len(set(sides)) != len(sides):
            self.fault(ref, "an edge has two faces on one side")


def references(value):
    kind, inside = value
    if kind == "ref":
        yield inside
    elif kind == "list":
        for one in inside:
            yield from references(one)
    elif kind == "typed":
        yield from references(("list", inside[1]))


def check_header(header):
    wanted = {"FILE_DESCRIPTION": ["[s]", "s"],
              "FILE_NAME": ["s", "s", "[s]", "[s]", "s", "s", "s"],
              "FILE_SCHEMA": ["[s]"]}
    if [name for name, _ in header] != list(wanted):
        faults.append(f"header {[name for name, _ in header]}")
        return
    for name, values in header:
        if len(values) != len(wanted[name]) or not all(map(fits, values, wanted[name])):
            faults.append(f"{name} {values}")
    if header[0][1][1][1] != "'2;1'":
        faults.append("implementation level")


def main():
    with open(sys.argv[1], "rb") as file:
        data = file.read()
    try:
        header, instances = Parser(data.decode("ascii")).file()
        check_header(header)
        Model(instances).check()
    except (Syntax, UnicodeDecodeError) as error:
        faults.append(str(error))
    print("\n".join(faults), end="")
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
