# SPDX-License-Identifier: Apache-2.0
"""The independent judge, a program of its own (check_contour.py), held against the report.

It reads a contour file as plain numbers. Twice that is less than the file says: pieces with `exact`
are read from their rounded points, and the curvature at a joint is compared without asking how far
the rounding of the coordinates moves it. So vertices are counted twice: from the file as it is, and
with what the rounding explains taken out.
"""
import importlib.util
import math
import pathlib

from . import geometry

# Half units in the last place by which control points may be off: each coordinate is rounded when the
# piece is formed, when it is moved to its joints, and in each of the judge's own steps (products with
# the weights, differences, quotients: about ten).
ROUNDED_TIMES = 16 * 2.0**-53


def load_judge(folder):
    """The module check_contour.py of the folder, or None without one."""
    if folder is None:
        return None
    file = pathlib.Path(folder)
    file = file / "check_contour.py" if file.is_dir() else file
    spec = importlib.util.spec_from_file_location("check_contour", file)
    judge = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(judge)
    return judge


def sampling_error(judge, contour, samples):
    """How far the polygon that the judge measures distances from can be from the curve: the height
    of the arc over each of its sides. Twice that, since curvature may change along a side."""
    worst = 0.0
    for piece in contour["pieces"]:
        row = [judge.sample(piece, j / samples) for j in range(samples + 1)]
        for a, b in zip(row, row[1:]):
            worst = max(worst, max(abs(a[2]), abs(b[2])) * abs(b[0] - a[0]) ** 2 / 4)
    return worst


def own_frame(piece):
    """A piece that has `exact`, moved to its own origin: there its curvature can be read, from the
    rounded points it cannot (docs/formats.md). Curvatures do not see the move."""
    return {**piece, "points": piece["exact"]["offsets"]} if "exact" in piece else dict(piece)


def curvature_rounding(piece, at_end):
    """How far rounded coordinates move the curvature at an end. With the control legs u and v there
    and weights w it is (n-1)/n w0 w2/w1^2 (u x v)/|u|^3; an offset of both legs counts with their
    length. Lines, arcs and clothoids state their curvature."""
    if piece["type"] != "bezier" or len(piece["points"]) < 3:
        return 0.0
    order = -1 if at_end else 1
    points = piece["points"][::order][:3]
    weights = (piece.get("weights") or [1.0] * len(piece["points"]))[::order][:3]
    u, v = math.dist(*points[:2]), math.dist(*points[1:])
    offset = ROUNDED_TIMES * geometry.size_of(piece["points"])
    return weights[0] * weights[2] / weights[1] ** 2 * offset * (u + v) / u**3 if u else math.inf


def without_rounding(judge, contour):
    """The contour in own frames, and the values to read at joints whose step rounding explains."""
    pieces = [own_frame(piece) for piece in contour["pieces"]]
    settled = {}
    for i in range(0 if contour["closed"] else 1, len(pieces)):
        before, after = pieces[i - 1], pieces[i]
        left, right = judge.sample(before, 1.0)[2], judge.sample(after, 0.0)[2]
        allowed = curvature_rounding(before, True) + curvature_rounding(after, False)
        if abs(left - right) <= allowed:
            settled[id(before), 1.0] = settled[id(after), 0.0] = (left + right) / 2
    return {**contour, "pieces": pieces}, settled


def settled_vertices(judge, contour, samples):
    """Vertices that the judge counts with the rounding at joints taken out."""
    plain = judge.sample
    moved, settled = without_rounding(judge, contour)

    def sample(piece, t):
        z, theta, kappa, change = plain(piece, t)
        return z, theta, settled.get((id(piece), t), kappa), change

    judge.sample = sample
    try:
        return judge.check(moved, None, samples)["vertices"]
    finally:
        judge.sample = plain


def judged(judge, contour, samples, tolerance):
    """What the judge says, and whether it agrees with the report."""
    said = judge.check(contour, contour["points"], samples)
    slack = (sampling_error(judge, contour, samples)
             + geometry.COORDINATE_ROUNDING * geometry.size_of(contour["points"]))
    reported = contour["report"]["vertices"]
    vertices = said["vertices"]
    if vertices > reported:
        vertices = settled_vertices(judge, contour, samples)
    return {"judge_vertices": vertices, "judge_distance": said["worst_point_distance"],
            "judge_as_is": said["vertices"] <= reported,
            "judge_agrees": vertices <= reported
                            and said["worst_point_distance"] <= tolerance + slack}
