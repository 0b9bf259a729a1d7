# SPDX-License-Identifier: Apache-2.0
"""Railway transition curves: Bloss, clothoid and sine, each one monotone run."""
import math

from . import geometry, tables
from .cases import noise_case, number_rows

TOLERANCE = 1e-4  # m: a tenth of what track is set out and measured to
STEPS_PER_PIECE = 8  # samples of the contour that are held against the formula
# Curvature over the length: share of the change that is reached at the share u of the length.
SHARES = {"Clothoid": lambda u: u, "BlossCurve": lambda u: u * u * (3 - 2 * u),
          "SineCurve": lambda u: u - math.sin(2 * math.pi * u) / (2 * math.pi)}
ORACLE_STEPS = 1000  # cells of the formula's polyline; its arcs of 0.1 m over 300 m rise by 4e-6 m


def cases(data, work, _options):
    found = []
    for path in sorted((data / "rail_transition_curves").glob("*.txt")):
        source, kind, length, radius1, radius2 = path.stem.split("_")[:5]
        if kind not in SHARES:
            continue
        points = [tuple(row[1:3]) for row in rows_of(path)]
        truth = (kind, float(length), 1 / float(radius1), 1 / float(radius2))
        found.append(noise_case(work, path.stem, points, TOLERANCE, f"transition curve {path.name}",
                                group=kind, truth=truth, compare=against_formula))
    return found, []


def rows_of(path):
    """Length, x and y; one of the sources adds a column in parentheses."""
    text = path.read_text(encoding="utf-8").replace("(", " ").replace(")", " ")
    rows = ([float(w) for w in line.split()] for line in text.splitlines() if line[:1].isdigit())
    return [row for row in rows if len(row) >= 3]


def formula(truth):
    """Points of the curve by quadrature of its heading, each cell with 8 nodes."""
    kind, length, kappa0, kappa1 = truth
    share, h = SHARES[kind], length / ORACLE_STEPS
    z, theta, points = 0j, 0.0, [0j]
    for i in range(ORACLE_STEPS):
        ends = [kappa0 + (kappa1 - kappa0) * share(u / ORACLE_STEPS) for u in (i, i + 0.5, i + 1)]
        z = geometry.move(z, theta, ends[0], ends[2], h)
        theta += h * (ends[0] + 4 * ends[1] + ends[2]) / 6  # Simpson
        points.append(z)
    return points


def against_formula(truth, contour):
    """Largest distance of samples of the contour from the formula's polyline, and back from the
    abscissas: transition curves run along x, so the nearest place is sought there."""
    if not contour:
        return {}
    line, worst, at = formula(truth), 0.0, 0
    for piece in contour["pieces"]:
        for j in range(STEPS_PER_PIECE):
            z = geometry.piece_point(piece, j / STEPS_PER_PIECE)[0]
            while at + 2 < len(line) and line[at + 1].real < z.real:
                at += 1
            a, b = line[at], line[at + 1]
            t = ((z - a) / (b - a)).real
            worst = max(worst, abs(z - a - t * (b - a)))
    return {"deviation": worst}


def criteria(outcomes):
    fitted = [o for o in outcomes if "vertices" in o]
    one_run = sum(o["vertices"] == 0 for o in fitted)
    worst = max((o["deviation"] for o in fitted), default=math.inf)
    rise = 4e-6  # of the formula's polyline
    return [tables.all_proved(outcomes),
            ("one monotone run", f"{one_run} of {len(outcomes)}", one_run == len(outcomes)),
            (f"distance from the formula at most {TOLERANCE:g} m", f"{worst:.2g} m",
             worst <= TOLERANCE + rise)] + tables.common_criteria(outcomes)
