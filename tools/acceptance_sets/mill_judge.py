# SPDX-License-Identifier: Apache-2.0
"""Programs of three-axis mills judged without the program that printed them: a reader of G-code with arcs in all three
planes, and the body of a cutter along straight ways. """
import math
import re

import numpy as np
from scipy.spatial import cKDTree

PLANES = {17: (0, 1), 18: (2, 0), 19: (1, 2)}
WORD = re.compile(r"([A-Z])([-+]?\d*\.?\d+)")
GOLDEN, STEPS = (math.sqrt(5.0) - 1.0) / 2.0, 40  # of the search along a way: to 4e-9 of its length
AT_ONCE = 400_000  # pairs of points and ways


def ways_of(text, sag):
    """Rapid ways and ways at feed, each (n, 2, 3); arcs as chords that lie `sag` off them at most."""
    at, code, plane, rapid, feed = [None] * 3, None, 17, [], []
    for line in text.splitlines():
        line = re.sub(r"\([^()]*\)|;.*", "", line)
        ends, ijk = list(at), {}
        for letter, value in WORD.findall(line):
            number = float(value)
            if letter == "G":
                assert number in (0, 1, 2, 3, 17, 18, 19, 20, 21, 40, 49, 64, 80, 90, 91.1, 94), line
                code = int(number) if number < 4 else code
                plane = int(number) if number in PLANES else plane
            elif letter in "XYZ":
                ends["XYZ".index(letter)] = number
            elif letter in "IJK":
                ijk["IJK".index(letter)] = number
        if ends == at:
            continue
        if None not in at:
            a, b = np.array(at), np.array(ends)
            (rapid if code == 0 else feed).extend(arc(code, plane, a, b, ijk, sag) if code > 1 else [(a, b)])
        at = ends
    shaped = lambda ways: np.array(ways).reshape(-1, 2, 3)  # noqa: E731
    return shaped(rapid), shaped(feed)


def arc(code, plane, a, b, ijk, sag):
    i, j = PLANES[plane]
    k = 3 - i - j
    centre = np.array([a[i] + ijk[i], a[j] + ijk[j]])
    p, q = a[[i, j]] - centre, b[[i, j]] - centre
    sign = 1.0 if code == 3 else -1.0
    turn = (sign * (math.atan2(q[1], q[0]) - math.atan2(p[1], p[0]))) % (2.0 * math.pi)
    radius, last = np.hypot(*p), np.hypot(*q)
    assert abs(radius - last) <= 0.002, "no controller takes this arc"
    count = max(1, math.ceil(turn / (2.0 * math.acos(max(0.0, 1.0 - sag / radius)))))
    t = np.linspace(0.0, 1.0, count + 1)
    angle = math.atan2(p[1], p[0]) + sign * turn * t
    points = np.empty((count + 1, 3))
    points[:, i] = centre[0] + (radius + (last - radius) * t) * np.cos(angle)
    points[:, j] = centre[1] + (radius + (last - radius) * t) * np.sin(angle)
    points[:, k] = a[k] + (b[k] - a[k]) * t
    points[0], points[-1] = a, b
    return list(zip(points, points[1:]))


class Sweep:
    """A cutter's body, a disc of `radius` whose rim is rounded by `corner`, along ways of its tip."""

    def __init__(self, radius, corner, ways):
        self.radius, self.corner = radius, corner
        lengths = np.linalg.norm(ways[:, 1] - ways[:, 0], axis=1)
        parts = np.maximum(1, np.ceil(lengths / (2.0 * radius)).astype(int))
        which = np.repeat(np.arange(len(ways)), parts)
        number = np.arange(len(which)) - np.repeat(np.cumsum(parts) - parts, parts)
        a, way = ways[which, 0], (ways[:, 1] - ways[:, 0])[which]
        self.from_ = a + way * (number / parts[which])[:, None]
        self.way = way / parts[which][:, None]
        self.tree = cKDTree((self.from_ + 0.5 * self.way)[:, :2])

    def outside(self, tips, points):
        """Distance of points from the body at tips; below 0 inside."""
        d = points - tips
        out = np.hypot(d[:, 0], d[:, 1]) - (self.radius - self.corner)
        below = self.corner - d[:, 2]
        around = np.hypot(np.maximum(out, 0.0), np.maximum(below, 0.0)) - self.corner
        # in the inner part the nearest of side and bottom; the body has no top
        inside = np.maximum(out, below) - self.corner
        return np.where((out > 0.0) & (below > 0.0), around, inside)

    def distance(self, points):
        """Least distance of each point from the body on all ways; nothing near: infinite. The distance is convex along
        a way, so a golden section finds it."""
        least = np.full(len(points), np.inf)
        near = self.tree.query_ball_point(points[:, :2], 2.0 * self.radius * (1.0 + 1e-9))
        counts = np.array([len(n) for n in near])
        if not counts.sum():
            return least
        rows = np.repeat(np.arange(len(points)), counts)
        ways = np.concatenate([np.array(n, int) for n in near if n])
        for begin in range(0, len(rows), AT_ONCE):
            r, w = rows[begin:begin + AT_ONCE], ways[begin:begin + AT_ONCE]
            p, a, way = points[r], self.from_[w], self.way[w]
            along = np.einsum("ij,ij->i", (p - a)[:, :2], way[:, :2])
            square = np.einsum("ij,ij->i", way[:, :2], way[:, :2])
            s = np.clip(np.divide(along, square, out=np.zeros_like(along), where=square > 0.0), 0.0, 1.0)
            off = (p - a)[:, :2] - s[:, None] * way[:, :2]
            keep = (np.hypot(*off.T) <= self.radius) & (np.minimum(a[:, 2], a[:, 2] + way[:, 2]) <= p[:, 2] + self.corner)
            r, p, a, way = r[keep], p[keep], a[keep], way[keep]
            low, high = np.zeros(len(r)), np.ones(len(r))
            values = lambda s: self.outside(a + s[:, None] * way, p)  # noqa: E731
            left, right = high - GOLDEN * (high - low), low + GOLDEN * (high - low)
            at_left, at_right = values(left), values(right)
            for _ in range(STEPS):
                lower = at_left < at_right
                high, low = np.where(lower, right, high), np.where(lower, low, left)
                new = np.where(lower, high - GOLDEN * (high - low), low + GOLDEN * (high - low))
                at_new = values(new)
                left, at_left, right, at_right = (np.where(lower, new, right), np.where(lower, at_new, at_right),
                                                  np.where(lower, left, new), np.where(lower, at_left, at_new))
            found = np.minimum.reduce([at_left, at_right, values(np.zeros(len(r))), values(np.ones(len(r)))])
            np.minimum.at(least, r, found)
        return least
