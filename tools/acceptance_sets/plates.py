# SPDX-License-Identifier: Apache-2.0
"""Drawings whose distances are known in closed form, and what a program of G-code leaves of them.
Shares nothing with the engine."""
import math

import numpy as np

from .controller import Move

ON_THE_OUTLINE = 1e-4  # units: places so near to a radius from an outline follow it; leads touch it and go away


class Circle:
    def __init__(self, x, y, r):
        self.x, self.y, self.r = x, y, r

    def distance(self, p):
        """Signed: positive outside."""
        return math.hypot(p[0] - self.x, p[1] - self.y) - self.r

    def points(self, n):
        return [(self.x + self.r * math.cos(a), self.y + self.r * math.sin(a))
                for a in (2 * math.pi * k / n for k in range(n))]

    corners = ()

    def dxf(self):
        return f"0\nCIRCLE\n8\nA\n10\n{self.x!r}\n20\n{self.y!r}\n40\n{self.r!r}\n"


class Round:
    """A rectangle with rounded corners (r = 0: sharp ones), or a slot."""

    def __init__(self, x0, y0, x1, y1, r):
        self.box, self.r = (x0, y0, x1, y1), r

    def distance(self, p):
        x0, y0, x1, y1 = self.box
        cx, cy, hx, hy = (x0 + x1) / 2, (y0 + y1) / 2, (x1 - x0) / 2 - self.r, (y1 - y0) / 2 - self.r
        qx, qy = abs(p[0] - cx) - hx, abs(p[1] - cy) - hy
        return math.hypot(max(qx, 0), max(qy, 0)) + min(max(qx, qy), 0) - self.r

    @property
    def corners(self):
        x0, y0, x1, y1 = self.box
        return [(x0, y0), (x1, y0), (x1, y1), (x0, y1)] if self.r == 0 else []

    def vertices(self):
        """Of a polyline with bulges."""
        x0, y0, x1, y1 = self.box
        r, b = self.r, math.tan(math.pi / 8)
        if r == 0:
            return [(x0, y0, 0), (x1, y0, 0), (x1, y1, 0), (x0, y1, 0)]
        rows = [(x0 + r, y0, 0), (x1 - r, y0, b), (x1, y0 + r, 0), (x1, y1 - r, b),
                (x1 - r, y1, 0), (x0 + r, y1, b), (x0, y1 - r, 0), (x0, y0 + r, b)]
        out = []
        for k, row in enumerate(rows):  # a slot has no straight ends
            after = rows[(k + 1) % 8]
            if row[2] == 0 and math.dist(row[:2], after[:2]) < 1e-12:
                continue
            out.append(row)
        return out

    def points(self, n):
        out, rows = [], self.vertices()
        for k, (x, y, b) in enumerate(rows):
            ex, ey, _ = rows[(k + 1) % len(rows)]
            for j in range(n // 8):
                t = j / (n // 8)
                if b == 0:
                    out.append((x + t * (ex - x), y + t * (ey - y)))
                    continue
                angle = 4 * math.atan(b)
                turn = math.atan2(ey - y, ex - x) - angle / 2
                cx, cy = x - self.r * math.cos(turn - math.pi / 2), y - self.r * math.sin(turn - math.pi / 2)
                a = turn - math.pi / 2 + t * angle
                out.append((cx + self.r * math.cos(a), cy + self.r * math.sin(a)))
        return out

    def dxf(self):
        rows = self.vertices()
        text = f"0\nLWPOLYLINE\n8\nA\n90\n{len(rows)}\n70\n1\n"
        return text + "".join(f"10\n{x!r}\n20\n{y!r}\n42\n{b!r}\n" for x, y, b in rows)


class Ellipse:
    def __init__(self, x, y, a, b):
        self.x, self.y, self.a, self.b = x, y, a, b

    def distance(self, p):
        px, py = abs(p[0] - self.x), abs(p[1] - self.y)
        t = math.atan2(self.a * py, self.b * px)  # then Newton on the foot
        for _ in range(40):
            c, s = math.cos(t), math.sin(t)
            f = (self.b ** 2 - self.a ** 2) * s * c + px * self.a * s - py * self.b * c
            g = (self.b ** 2 - self.a ** 2) * (c * c - s * s) + px * self.a * c + py * self.b * s
            t -= f / g
            if abs(f) <= 1e-15 * abs(g):
                break
        d = math.hypot(px - self.a * math.cos(t), py - self.b * math.sin(t))
        return d if (px / self.a) ** 2 + (py / self.b) ** 2 > 1 else -d

    corners = ()

    def points(self, n):
        return [(self.x + self.a * math.cos(a), self.y + self.b * math.sin(a))
                for a in (2 * math.pi * k / n for k in range(n))]

    def dxf(self):
        return (f"0\nELLIPSE\n8\nA\n10\n{self.x!r}\n20\n{self.y!r}\n11\n{self.a!r}\n21\n0.0\n"
                f"40\n{self.b / self.a!r}\n41\n0.0\n42\n{2 * math.pi!r}\n")


def drawing(shapes, unit=4):
    return (f"0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1015\n9\n$INSUNITS\n70\n{unit}\n0\nENDSEC\n"
            "0\nSECTION\n2\nENTITIES\n" + "".join(s.dxf() for s in shapes) + "0\nENDSEC\n0\nEOF\n")


def plate(k=1.0):
    """Ten outlines: a plate, five holes, a slot, a window, an ellipse with a part in it."""
    shapes = [Round(0, 0, 200, 120, 12)]
    shapes += [Circle(x, y, 4) for x, y in ((15, 15), (185, 15), (185, 105), (15, 105))]
    shapes += [Round(55, 10, 145, 20, 5), Round(30, 40, 60, 80, 0), Ellipse(110, 65, 30, 18),
               Round(100, 58, 120, 72, 3), Circle(165, 65, 12.5)]
    for s in shapes:
        for name in ("x", "y", "r", "a", "b"):
            if hasattr(s, name):
                setattr(s, name, getattr(s, name) * k)
        if hasattr(s, "box"):
            s.box = tuple(v * k for v in s.box)
    return shapes, [True] + [False] * 7 + [True, False]  # cut outside


def random_plate(dice):
    """A plate with fifteen circles, ellipses and rectangles."""
    shapes, outside = [Round(0, 0, 300, 200, dice.choice([0, 5, 20]))], [True]
    for column in range(5):
        for row in range(3):
            x, y = 35 + 57 * column + dice.uniform(-4, 4), 38 + 62 * row + dice.uniform(-4, 4)
            r = dice.uniform(6, 20)
            kind = dice.randrange(3)
            shapes.append(Circle(x, y, r) if kind == 0 else
                          Round(x - r, y - 0.7 * r, x + r, y + 0.7 * r, dice.choice([0, 4.5])) if kind == 1 else
                          Ellipse(x, y, r, dice.uniform(0.8, 0.95) * r))
            outside.append(False)
    return shapes, outside


def rapids_through(moves, top=0.0):
    """Rapid moves that touch what is not above the top: along it, or down into it."""
    return [m for m in moves if m.code == 0
            and (m.b[2] <= top or (math.dist(m.a[:2], m.b[:2]) > 0 and min(m.a[2], m.b[2]) <= top))]


def below(moves):
    return [m for m in moves if m.code in (1, 2, 3, 5) and min(m.a[2], m.b[2]) < 0]


def simulated(shapes, outside, program, diameter, exact=()):
    """What a program leaves of a drawing, all of it in its units:
    rapids: rapid moves through stock; gouge: deepest that the cutter is across an outline;
    missed: outlines that nothing cuts; left: farthest of an outline from the edge of the cut
    (but for what a round cutter leaves in corners); depths: deepest of each outline;
    compensation: farthest from a radius beside the outlines `exact`; wrong_way: outlines where
    what stays lies to the left; early: outlines that are not cut before one around them."""
    radius = diameter / 2
    found = {"rapids": len(rapids_through(program.moves)), "gouge": 0.0, "missed": 0, "left": 0.0,
             "depths": [], "compensation": 0.0, "wrong_way": 0, "early": 0}
    done = [[] for _ in shapes]
    for number, m in enumerate(below(program.moves)):
        for place in m.places(radius / 4):
            found["gouge"] = max(found["gouge"], radius - min(abs(s.distance(place)) for s in shapes))
        middle = m.at(0.5)
        own = min(range(len(shapes)), key=lambda k: abs(abs(shapes[k].distance(middle)) - radius))
        done[own].append((number, m))
    for k, (shape, out) in enumerate(zip(shapes, outside)):
        if not done[k]:
            found["missed"] += 1
            continue
        moves = [m for _, m in done[k]]
        path = [p for m in moves for p in m.places(radius / 20)]
        found["depths"].append(min(p[2] for p in path))
        flat = np.array([p[:2] for p in path])
        for p in shape.points(160):
            if all(math.dist(p, c) >= 1.5 * radius for c in shape.corners):
                found["left"] = max(found["left"], float(np.hypot(*(flat - p).T).min()) - radius)
        beside = lambda p: shape.distance(p) * (1 if out else -1) - radius  # noqa: E731
        for m in moves if k in exact else []:
            if abs(beside(m.at(0.5))) < ON_THE_OUTLINE:
                here = [abs(beside(q)) for q in m.places(radius / 4)]
                found["compensation"] = max([found["compensation"], *(d for d in here if d < ON_THE_OUTLINE)])
        # what stays lies to the right when climbing
        m = max(moves, key=Move.length)
        a, b = m.at(0.5), m.at(0.5001)
        right = (a[0] + (b[1] - a[1]) * 100, a[1] - (b[0] - a[0]) * 100)
        found["wrong_way"] += not abs(shape.distance(right)) < abs(shape.distance(a))
    for i, shape in enumerate(shapes):
        for j, other in enumerate(shapes):
            if i != j and done[i] and done[j] and other.distance(shape.points(16)[0]) < 0:
                found["early"] += done[i][-1][0] >= done[j][0][0]
    return found
