# SPDX-License-Identifier: Apache-2.0
"""Lines, arcs and spirals of a known chain, sampled, and how many of them a contour gives back.

What counts. Neighbouring pieces of the truth that are one curve (two lines in line, two arcs of one
circle, cut for other reasons) are joined first. A piece is *seen* when at least FEWEST_SAMPLES
points lie on it and no simpler kind fits these within the tolerance: four points of an arc so flat
that a line passes within the tolerance of them all cannot be told from one, nor a spiral from an
arc. Pieces not seen are counted apart. A seen piece is *matched* when more than half of its length
between the first and the last of its points is made of pieces of its kind, and the curvature is
right within RADIUS_OFF: an arc's radius that of the longest such arc; a spiral's curvature along
its points, in parts of the largest curvature of the spiral (its ends' radii would be those of its
neighbours). """
import bisect
import cmath
import dataclasses
import math

from . import geometry, tables

FEWEST_SAMPLES = 4  # three points lie on a circle whatever the curve is
RADIUS_OFF = 0.02  # relative, as the issue asks
# Pieces of the truth whose headings or curvatures at the joint differ by less are one curve: files
# print about as many digits.
SAME_HEADING, SAME_CURVATURE = 1e-7, 1e-9  # rad, relative to the larger curvature
LEAST_LENGTH = 1e-6  # m; shorter pieces are leftovers of an editor, without a heading of their own
PARAMETER_STEP = 1e-4  # of a piece: curvature changes by less than a tenth of a percent over it
SAMPLES_A_PIECE = 8  # places of a contour piece that are looked at


@dataclasses.dataclass
class TruePiece:
    """Curvature is linear over the length: line, arc or clothoid."""
    number: int
    start: complex
    theta: float
    length: float
    kappa0: float
    kappa1: float

    def kind(self):
        if self.kappa0 == 0.0 and self.kappa1 == 0.0:
            return "line"
        return "arc" if self.kappa0 == self.kappa1 else "spiral"

    def curvature(self, s):
        return self.kappa0 + (self.kappa1 - self.kappa0) * s / self.length

    def at(self, s):
        return geometry.move(self.start, self.theta, self.kappa0, self.curvature(s), s)

    def end(self):
        heading = self.theta + (self.kappa0 + self.kappa1) / 2 * self.length
        return self.at(self.length), heading


def same(a, b):
    largest = max(abs(a), abs(b))
    return abs(a - b) <= SAME_CURVATURE * largest


def joined(pieces):
    """Pieces that continue the line, circle or spiral of the one before become part of it."""
    kept = []
    for piece in pieces:
        before = kept[-1] if kept else None
        if before and before.kind() == piece.kind() and continues(before, piece):
            kept[-1] = dataclasses.replace(before, length=before.length + piece.length,
                                           kappa1=before.kappa1 if piece.kind() != "spiral"
                                           else piece.kappa1)
        elif piece.length > LEAST_LENGTH:
            kept.append(piece)
    return kept


def continues(before, piece):
    turn = abs(cmath.exp(1j * before.end()[1]) - cmath.exp(1j * piece.theta))
    if turn > SAME_HEADING or not same(before.kappa1, piece.kappa0):
        return False
    if piece.kind() != "spiral":
        return True
    rates = [(p.kappa1 - p.kappa0) / p.length for p in (before, piece)]
    return same(*rates)


def sampled(pieces, step):
    """Points every `step` along the chain and at its end, with the length where they stand."""
    points, places, start = [], [], 0.0
    wanted = 0.0
    total = sum(p.length for p in pieces)
    for piece in pieces:
        while wanted < start + piece.length:
            z = piece.at(wanted - start)
            points.append((z.real, z.imag))
            places.append(wanted)
            wanted += step
        start += piece.length
    z = pieces[-1].end()[0]
    if total - places[-1] < 0.5 * step and len(places) > 1:  # no crowd of points at the end
        points.pop()
        places.pop()
    return points + [(z.real, z.imag)], places + [total]


def simpler_fits(kind, points, tolerance):
    """Whether a line (for arcs and spirals) or an arc (for spirals) lies within the tolerance."""
    if kind == "line":
        return False
    if line_distance(points) <= tolerance:
        return True
    return kind == "spiral" and geometry.fit_circle(points)[1] <= tolerance


def line_distance(points):
    """Half the width of the strip along the chord, nearly the distance of the best line."""
    a, b = complex(*points[0]), complex(*points[-1])
    offsets = [((complex(*p) - a) / (b - a)).imag * abs(b - a) for p in points]
    return (max(offsets) - min(offsets)) / 2


def sampled_truth(pieces, step, tolerance):
    """Truth to be sent to `matched`: points, and per joined piece what it is and whether it is
    seen. """
    points, places = sampled(pieces, step)
    rows, start = [], 0.0
    for piece in joined(pieces):
        low = bisect.bisect_left(places, start)
        high = bisect.bisect_right(places, start + piece.length)
        own = points[low:high]
        seen = len(own) >= FEWEST_SAMPLES and not simpler_fits(piece.kind(), own, tolerance)
        rows.append({"kind": piece.kind(), "start": start, "length": piece.length,
                     "kappa0": piece.kappa0, "kappa1": piece.kappa1, "samples": len(own),
                     "first": low, "last": high - 1, "places": places[low:high], "seen": seen})
        start += piece.length
    return {"points": points, "pieces": rows}


def nearest_places(contour, points):
    """Per input point the piece and parameter nearest to it, walking along the contour."""
    samples = [(geometry.piece_point(p, j / SAMPLES_A_PIECE)[0], i, j / SAMPLES_A_PIECE)
               for i, p in enumerate(contour["pieces"]) for j in range(SAMPLES_A_PIECE)]
    last = contour["pieces"][-1]
    samples.append((geometry.piece_point(last, 1.0)[0], len(contour["pieces"]) - 1, 1.0))
    found, at = [], 0
    for point in points:
        z, best = complex(*point), at
        distance = abs(samples[at][0] - z)
        travelled, reach = 0.0, 4 * distance + abs(samples[0][0] - samples[1][0])
        for k in range(at + 1, len(samples)):
            travelled += abs(samples[k][0] - samples[k - 1][0])
            if abs(samples[k][0] - z) < distance:
                best, distance = k, abs(samples[k][0] - z)
            if travelled > reach:
                break
        found.append((samples[best][1], samples[best][2]))
        at = best
    return found


def curvature_near(contour, place, point):
    """Curvature of the contour beside a point, near the sample that was found for it: the nearest
    place between the neighbouring samples, by thirds."""
    piece, t = contour["pieces"][place[0]], place[1]
    low, high = max(0.0, t - 1 / SAMPLES_A_PIECE), min(1.0, t + 1 / SAMPLES_A_PIECE)
    away = lambda u: abs(geometry.piece_point(piece, u)[0] - complex(*point))  # noqa: E731
    while high - low > PARAMETER_STEP:
        a, b = low + (high - low) / 3, high - (high - low) / 3
        low, high = (low, b) if away(a) < away(b) else (a, high)
    return geometry.piece_point(piece, (low + high) / 2)[1]


def kind_of(piece):
    return piece["type"] if piece["type"] in ("line", "arc") else "spiral"


def curvature_match(row, points, contour, nearest):
    """Whether the curvature of the spiral is that of the truth at its inner points."""
    largest = max(abs(row["kappa0"]), abs(row["kappa1"]))
    good = 0
    inner = range(row["first"] + 1, row["last"])
    for i in inner:
        share = (row["places"][i - row["first"]] - row["start"]) / row["length"]
        true = row["kappa0"] + share * (row["kappa1"] - row["kappa0"])
        found = curvature_near(contour, nearest[i], points[i])
        good += abs(found - true) <= RADIUS_OFF * largest
    return 2 * good > len(inner)


def piece_result(row, points, contour, nearest):
    """'matched', or what is wrong with the contour along one piece of the truth."""
    length, longest = {"line": 0.0, "arc": 0.0, "spiral": 0.0}, {}
    first, last = nearest[row["first"]], nearest[row["last"]]
    for i in range(first[0], last[0] + 1):
        piece = contour["pieces"][i]
        low, high = (first[1] if i == first[0] else 0.0), (last[1] if i == last[0] else 1.0)
        part = abs(geometry.piece_point(piece, high)[0] - geometry.piece_point(piece, low)[0])
        kind = kind_of(piece)
        length[kind] += part
        if part > longest.get(kind, (0.0, None))[0]:
            longest[kind] = (part, piece)
    kind = max(length, key=length.get)
    if kind != row["kind"]:
        return "found as " + kind
    if kind == "arc" and abs(row["kappa0"] / longest["arc"][1]["kappa"] - 1) > RADIUS_OFF:
        return "radius off"
    if kind == "spiral" and not curvature_match(row, points, contour, nearest):
        return "curvature off"
    return "matched"


def matched(truth, contour):
    """Figures per kind: seen and matched pieces, and why others failed. Without a contour all
    did."""
    nearest = nearest_places(contour, truth["points"]) if contour else None
    found = {"truth": len(truth["pieces"]), "seen": {}, "matched": {}, "missed": []}
    for row in truth["pieces"]:
        if not row["seen"]:
            continue
        result = piece_result(row, truth["points"], contour, nearest) if contour else "not fitted"
        found["seen"][row["kind"]] = found["seen"].get(row["kind"], 0) + 1
        if result == "matched":
            found["matched"][row["kind"]] = found["matched"].get(row["kind"], 0) + 1
        else:
            found["missed"].append({**{k: row[k] for k in ("kind", "start", "length", "kappa0",
                                                           "kappa1", "samples")}, "why": result})
    return found


COLUMNS = ["set", "pieces", "seen", "lines matched", "arcs matched", "spirals matched", "matched"]


def total(outcomes, key, kind=None):
    parts = [o[key] for o in outcomes if key in o]
    return sum(sum(p.values()) if kind is None else p.get(kind, 0) for p in parts)


def table_rows(outcomes):
    for group, members in tables.groups_of(outcomes).items():
        if not any("matched" in o for o in members):
            continue
        yield ([group, sum(o.get("truth", 0) for o in members), total(members, "seen")]
               + [f"{total(members, 'matched', kind)} of {total(members, 'seen', kind)}"
                  for kind in ("line", "arc", "spiral")]
               + [f"{share(members):.1f} %"])


def share(outcomes):
    seen = total(outcomes, "seen")
    return 100.0 * total(outcomes, "matched") / seen if seen else math.nan


def criterion(outcomes):
    return ("pieces matched in kind and radius, at least 90 %", f"{share(outcomes):.1f} %",
            share(outcomes) >= 90)
