# SPDX-License-Identifier: Apache-2.0
"""Plane geometry that the comparisons need: curvature of printed points, points of the pieces of a
contour file, circles through points. Shares nothing with the engine."""
import cmath
import math

# Nodes and weights of Gauss-Legendre quadrature with 8 nodes on [-1, 1] (positive half).
GAUSS = [(0.1834346424956498, 0.3626837833783620), (0.5255324099163290, 0.3137066458778873),
         (0.7966664774136267, 0.2223810344533745), (0.9602898564975363, 0.1012285362903763)]
TURN_PER_STEP = 0.5  # rad; 8 nodes integrate exp(i theta) over such a step to the last bits
# A proved bound of a distance may exceed the tolerance by the rounding of the coordinates
# themselves: a few units in their last place, relative to the largest of them.
COORDINATE_ROUNDING = 16 * 2.0**-53


def size_of(points):
    return max(max(abs(x), abs(y)) for x, y in points)


def distinct(points):
    """Points without those that repeat the one before."""
    kept = []
    for p in points:
        if not kept or tuple(p) != tuple(kept[-1]):
            kept.append(tuple(p))
    return kept


def circle_curvature(a, b, c):
    """Signed curvature of the circle through three points, positive where they turn left."""
    ab, bc, ac = (b[0] - a[0], b[1] - a[1]), (c[0] - b[0], c[1] - b[1]), (c[0] - a[0], c[1] - a[1])
    product = math.hypot(*ab) * math.hypot(*bc) * math.hypot(*ac)
    return 2.0 * (ab[0] * bc[1] - ab[1] * bc[0]) / product if product else 0.0


def raw_extrema(points, closed=False):
    """Changes of sign of the differences of adjacent curvatures of the points as they are
    printed."""
    p = distinct(points)
    if closed and len(p) > 1 and p[0] == p[-1]:
        p.pop()
    if closed:
        p = p + p[:2]
    curvatures = [circle_curvature(*p[i:i + 3]) for i in range(len(p) - 2)]
    if closed:
        curvatures.append(curvatures[0])
    signs = [d > 0 for d in (b - a for a, b in zip(curvatures, curvatures[1:])) if d != 0]
    changes = sum(a != b for a, b in zip(signs, signs[1:]))
    return changes + (1 if closed and signs and signs[0] != signs[-1] else 0)


def move(z, theta, kappa0, kappa1, length):
    """End point of a clothoid (also line, arc) that starts at the complex z."""
    steps = 1 + int((abs(kappa0) + abs(kappa1)) * abs(length) / TURN_PER_STEP)
    h, sharpness = length / steps, (kappa1 - kappa0) / length if length else 0.0
    for step in range(steps):
        middle = (step + 0.5) * h
        for node, weight in GAUSS:
            for s in (middle - node * h / 2, middle + node * h / 2):
                z += weight * h / 2 * cmath.exp(1j * (theta + kappa0 * s + sharpness * s * s / 2))
    return z


def bezier_point(piece, t):
    """Point and signed curvature of a rational Bézier piece, from its points in homogeneous
    form."""
    weights = piece.get("weights") or [1.0] * len(piece["points"])
    exact = piece.get("exact")
    points = exact["offsets"] if exact else piece["points"]
    rows = [(complex(p[0], p[1]) * w, w) for p, w in zip(points, weights)]
    n = len(rows) - 1
    levels = {n: rows}
    for k in range(n, 0, -1):
        row = levels[k]
        levels[k - 1] = [((1 - t) * a[0] + t * b[0], (1 - t) * a[1] + t * b[1])
                         for a, b in zip(row, row[1:])]
    (z, w), first = levels[0][0], levels[1]
    d1 = [n * (first[1][i] - first[0][i]) for i in (0, 1)]
    d2 = [0.0, 0.0]
    if n > 1:
        second = levels[2]
        d2 = [n * (n - 1) * (second[2][i] - 2 * second[1][i] + second[0][i]) for i in (0, 1)]
    place = z / w
    speed = (d1[0] - place * d1[1]) / w
    bend = (d2[0] - 2 * speed * d1[1] - place * d2[1]) / w
    curvature = (speed.conjugate() * bend).imag / abs(speed) ** 3 if speed else 0.0
    return place + (complex(*exact["origin"]) if exact else 0.0), curvature


def piece_point(piece, t):
    """Point (complex) and signed curvature of a piece of a contour file at t in [0, 1]."""
    kind = piece["type"]
    if kind == "bezier":
        return bezier_point(piece, t)
    start = complex(*piece["start"])
    if kind == "line":
        return start + t * (complex(*piece["end"]) - start), 0.0
    if kind == "arc":
        kappa0 = kappa1 = piece["kappa"]
    elif kind == "clothoid":
        kappa0, kappa1 = piece["kappa0"], piece["kappa1"]
    else:
        raise ValueError(f"unknown type of piece: {kind}")
    here = kappa0 + t * (kappa1 - kappa0)
    return move(start, piece["theta0"], kappa0, here, t * piece["length"]), here


def fit_circle(points):
    """Curvature (signed like the points turn) and largest distance of the least-squares circle
    through points that do not turn by much more than half a circle (Pratt's weighting of the
    algebraic distances, in a frame on the chord: also exact for a line)."""
    a, b = complex(*points[0]), complex(*points[-1])
    size = abs(b - a)
    if size == 0.0:
        raise ValueError("first and last point are the same")
    frame = [(complex(*p) - a) / (b - a) for p in points]
    # distance ~ v - (k/2)((u - m)^2 + v^2) - c0 - c1 (u - m), linear in (k, c0, c1)
    rows = [((z.real - 0.5) ** 2 + z.imag ** 2, 1.0, z.real - 0.5) for z in frame]
    q, c0, c1 = solve_least_squares(rows, [z.imag for z in frame])
    # v = q (u'^2 + v^2) + c0 + c1 u'  ->  circle with curvature 2 q / sqrt(1 + c1^2 - 4 q c0)
    root = math.sqrt(max(1e-300, 1.0 + c1 * c1 - 4.0 * q * c0))
    worst = max(abs(z.imag - q * r[0] - c0 - c1 * r[2]) for z, r in zip(frame, rows)) / root
    return 2.0 * q / root / size, worst * size


def solve_least_squares(rows, values):
    """Coefficients of the best linear combination of the columns, by normal equations (the columns
    used here are far from dependent)."""
    n = len(rows[0])
    matrix = [[sum(r[i] * r[j] for r in rows) for j in range(n)]
              + [sum(r[i] * v for r, v in zip(rows, values))] for i in range(n)]
    for i in range(n):
        pivot = max(range(i, n), key=lambda k: abs(matrix[k][i]))
        matrix[i], matrix[pivot] = matrix[pivot], matrix[i]
        if matrix[i][i] == 0.0:
            raise ValueError("points do not determine the curve")
        for k in range(n):
            if k != i:
                factor = matrix[k][i] / matrix[i][i]
                matrix[k] = [x - factor * y for x, y in zip(matrix[k], matrix[i])]
    return [matrix[i][n] / matrix[i][i] for i in range(n)]
