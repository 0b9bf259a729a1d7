# SPDX-License-Identifier: Apache-2.0
"""Programs of G-code, read as controllers read them: what each motion does, and what none of them
takes. Shares nothing with the engine."""
import math
import re

# places and weights on [-1, 1]
GAUSS = [(0.0, 128 / 225), *((s * math.sqrt(5 - 2 * math.sqrt(10 / 7)) / 3, (322 + 13 * math.sqrt(70)) / 900) for s in (1, -1)),
         *((s * math.sqrt(5 + 2 * math.sqrt(10 / 7)) / 3, (322 - 13 * math.sqrt(70)) / 900) for s in (1, -1))]
WORD = re.compile(r"([A-Z])([-+]?\d*\.?\d+)")

MOST_BLOCK_TURN = 3.15  # rad: half a turn and half a degree; blocks that are planned turn no more


class Move:
    """A motion of the tip: `at(t)` for t in [0, 1]."""

    def __init__(self, code, a, b, centre=None, feed=None, spins=False, inner=None):
        self.code, self.a, self.b, self.centre, self.feed, self.spins = code, a, b, centre, feed, spins
        self.inner = inner  # both inner control points of a G5
        if centre:
            cx, cy = centre
            self.radius = math.hypot(a[0] - cx, a[1] - cy)
            self.end_radius = math.hypot(b[0] - cx, b[1] - cy)
            self.begin = math.atan2(a[1] - cy, a[0] - cx)
            turn = math.atan2(b[1] - cy, b[0] - cx) - self.begin
            if code == 3 and turn <= 0:
                turn += 2 * math.pi
            if code == 2 and turn >= 0:
                turn -= 2 * math.pi
            self.turn = turn

    def length(self):
        if self.centre:
            return abs(self.turn) * self.radius
        if self.inner:
            return self.spline_length()
        return math.dist(self.a[:2], self.b[:2])

    def spline_length(self):
        """Of the hodograph, by Gauss and Legendre with 5 places on each of 16 parts."""
        total = 0.0
        for k in range(16):
            for x, w in GAUSS:
                total += w / 32 * math.hypot(*self.velocity((k + 0.5 + 0.5 * x) / 16))
        return total

    def velocity(self, t):
        p = [self.a, *self.inner, self.b]
        s = 1.0 - t
        return [3 * (s * s * (p[1][i] - p[0][i]) + 2 * s * t * (p[2][i] - p[1][i]) + t * t * (p[3][i] - p[2][i]))
                for i in (0, 1)]

    def curvature(self, t):
        p = [self.a, *self.inner, self.b]
        v = self.velocity(t)
        w = [6 * ((1 - t) * (p[2][i] - 2 * p[1][i] + p[0][i]) + t * (p[3][i] - 2 * p[2][i] + p[1][i])) for i in (0, 1)]
        return (v[0] * w[1] - v[1] * w[0]) / math.hypot(*v) ** 3

    def at(self, t):
        z = self.a[2] + t * (self.b[2] - self.a[2])
        if self.inner:
            s, (c, d) = 1.0 - t, self.inner
            return (*(s ** 3 * self.a[i] + 3 * s * s * t * c[i] + 3 * s * t * t * d[i] + t ** 3 * self.b[i]
                      for i in (0, 1)), z)
        if not self.centre:
            return (self.a[0] + t * (self.b[0] - self.a[0]), self.a[1] + t * (self.b[1] - self.a[1]), z)
        angle = self.begin + t * self.turn
        r = self.radius + t * (self.end_radius - self.radius)
        return (self.centre[0] + r * math.cos(angle), self.centre[1] + r * math.sin(angle), z)

    def places(self, apart):
        count = max(2, math.ceil(self.length() / apart))
        return [self.at(k / count) for k in range(count + 1)]


class Controller:
    """Reads a program by the rules that grbl, LinuxCNC, Fanuc and Marlin share, and refuses the rest. `splines`:
    G5 as LinuxCNC has it, in XY alone, with I, J, P and Q in each block."""

    def __init__(self, text, burns=False, splines=False):
        self.moves, self.codes, self.dwells = [], [], []
        self.blending = 0.0  # by the controller: G64 P
        places = 0  # decimals of ends
        at, feed, motion, spins = [0.0, 0.0, 0.0 if burns else None], None, None, False
        for line in text.splitlines():
            assert len(line) <= (255 if splines else 80), line  # LINELEN of LinuxCNC, buffer of grbl
            line = re.sub(r"\([^()]*\)", "", line.split(";")[0]).strip()
            if line in ("", "%"):
                continue
            assert WORD.sub("", line).strip() == "", f"words that no controller knows: {line}"
            words = [(k, float(v)) for k, v in WORD.findall(line)]
            ends, ij, pq, blends = {}, {}, {}, False
            for letter, value in words:
                if letter == "G":
                    self.codes.append(("G", value))
                    if value in (0, 1, 2, 3) or splines and value == 5:
                        motion = int(value)
                    else:
                        assert value in (4, 17, 20, 21, 40, 49, 64, 80, 90, 91.1, 94), line
                        blends |= value == 64
                elif letter == "M":
                    assert value in (2, 3, 4, 5, 30), line
                    spins = {3: True, 4: True, 5: False}.get(value, spins)
                    self.codes.append(("M", value))
                elif letter == "F":
                    assert value > 0, line
                    feed = value
                elif letter in "XYZ":
                    ends["XYZ".index(letter)] = value
                    places = len(re.search(letter + r"[-+]?\d*\.?(\d*)", line)[1]) if letter != "Z" else places
                elif letter in "IJ":
                    ij["IJ".index(letter)] = value
                elif letter in "PQ" and blends:
                    if letter == "P":
                        assert value > 0, f"no limit: {line}"
                        self.blending = value
                elif letter in "PQ" and motion == 5:
                    pq["PQ".index(letter)] = value
                else:
                    assert letter in "SPO", line
            if any(k == "G" and v == 4 for k, v in words):
                self.dwells.append(dict(words)["P"])
                continue
            if not ends:
                assert not ij, line
                continue
            end = [ends.get(k, at[k]) for k in range(3)]
            if motion in (1, 2, 3, 5):
                assert feed is not None, f"no feed: {line}"
                assert None not in at, f"cuts before it is placed: {line}"
            centre = None
            if motion in (2, 3):
                assert set(ij) == {0, 1}, line
                centre = (at[0] + ij[0], at[1] + ij[1])
            inner = None
            if motion == 5:
                assert set(ij) == set(pq) == {0, 1} and 2 not in ends, line
                inner = [(at[0] + ij[0], at[1] + ij[1]), (end[0] + pq[0], end[1] + pq[1])]
            if None not in at:
                move = Move(motion, tuple(at), tuple(end), centre, feed, spins, inner)
                if centre:  # grbl: 0.005 mm and 0.1 %; LinuxCNC and others are looser
                    assert abs(move.radius - move.end_radius) <= 0.002, line
                    # both ends are rounded by half a last digit of x and y; a sliver that points the wrong
                    # way turns almost around
                    rounded = math.sqrt(2) * 10.0 ** -places / move.radius
                    assert abs(move.turn) <= MOST_BLOCK_TURN + rounded, line
                self.moves.append(move)
            at = end
