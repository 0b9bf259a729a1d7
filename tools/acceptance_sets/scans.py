# SPDX-License-Identifier: Apache-2.0
"""What measured points get before and beside a fit, held against what was put in.

order: outlines of the public data, their points shuffled: `--unordered` must give the order of the
file, up to direction and (closed ones) the start. An outline is *clear* when no point is nearer to
one that is not its neighbour than to both neighbours.
noise: curves in closed form with Gaussian errors: the scatter that `--noise auto` states, over that
put in.
outliers: the same curves with single points moved along the normal: `--drop-outliers` must leave out
these and no other.
primitives: chains of lines and arcs with Gaussian errors, tolerance four standard deviations:
`--primitives` must give each line and arc as one, radius and centre as well as the points know them;
`obvid alignment`, which needs no transitions, gets the same points.
corners: outlines of lines and arcs with corners on which no point stands, tolerance four standard deviations: `--primitives`
must give each side as one and each corner where the sides meet, and no other."""
import cmath
import json
import math
import random
import re
import subprocess
import time

from . import geometry, tables
from .cases import Case, number_rows, write_points
from .matching import TruePiece

ORDER, NOISE, OUTLIERS, NONE, PRIMITIVES = "order", "noise", "outliers", "no outliers", "primitives"
CORNERS = "corners"
STEP, CORNER_SIGMAS = 0.5, (0.005, 0.02)  # of points along outlines, units; standard deviations
SEEDS = 4
PER_UNIT = 3  # points of chains
POINTS = 200
PARTS = (1e-4, 3e-4, 1e-3)  # standard deviations of errors, of the size of the curve
SIGMAS, LOUD = (0.0005, 0.002, 0.01), 0.01  # units, on radii of 10 to 30; criteria are for those below LOUD
PLANTED, FARTHER = 4, (20.0, 40.0)  # wrong points of a curve; how far off, standard deviations
FACTOR = 2.0  # within which a scatter is right
SECONDS_AT_MOST = 120
SCATTER = re.compile(r"times their scatter of ([0-9.e+-]+)")
LEFT_OUT = re.compile(r"(\d+) \([0-9.e+-]+ [^()]*\)")


# ------------------------------------------------------------------------------------------ curves
def along(place, count, low, high):
    return [place(low + (high - low) * k / (count - 1)) for k in range(count)]


def curves():
    """Name, points and whether they are closed; unit size about 100."""
    turn = 2 * math.pi
    ring = lambda place: [place(turn * k / POINTS) for k in range(POINTS)]  # noqa: E731
    return [("circle", ring(lambda t: 50 * cmath.exp(1j * t)), True),
            ("ellipse", ring(lambda t: complex(50 * math.cos(t), 25 * math.sin(t))), True),
            ("trefoil", ring(lambda t: (40 + 8 * math.cos(3 * t)) * cmath.exp(1j * t)), True),
            ("parabola", along(lambda t: complex(50 * t, 40 * t * t), POINTS, -1, 1), False),
            ("sine", along(lambda t: complex(16 * t, 20 * math.sin(t)), POINTS, 0, turn), False),
            ("logarithmic spiral", along(lambda t: 60 * cmath.exp((0.2 + 1j) * -t), POINTS, 0, turn), False),
            ("catenary", along(lambda t: complex(25 * t, 25 * math.cosh(t)), POINTS, -1.8, 1.8), False)]


def chains():
    """Lines and arcs (length, curvature) one after the other with common tangents, and whether closed."""
    quarter = lambda r: (math.pi / 2 * r, 1 / r)  # noqa: E731
    return [("bend", [(40, 0), quarter(10), (40, 0)], False),
            ("slot", [(60, 0), (15 * math.pi, 1 / 15)] * 2, True),
            ("rounded rectangle", [(50, 0), quarter(12), (30, 0), quarter(12)] * 2, True),
            ("s-bend", [(30, 0), (30, 1 / 20), (25, 0), (45, -1 / 30), (30, 0)], False),
            ("arch", [(30, 0), (math.pi * 25, 1 / 25), (30, 0)], False)]


def outlines():
    """Lines and arcs around: length, curvature, and the turn behind each, which is 0 where they touch."""
    right, mouth = math.pi / 2, math.asin(0.3)
    bend = (math.pi / 2 * 6, 1 / 6, 0)
    tooth = [(5, 0, right), (4, 0, -right), (5, 0, -right), (4, 0, right)]
    return [("rectangle", [(40, 0, right), (24, 0, right)] * 2),
            ("hexagon", [(20, 0, math.pi / 3)] * 6),
            ("bracket", [(40, 0, right), (12, 0, right), (26, 0, -right), (18, 0, right), (14, 0, right), (30, 0, right)]),
            ("arc and chord", [(20 * math.pi, 1 / 15, math.pi / 3), (15 * math.sqrt(3), 0, math.pi / 3)]),
            ("keyhole", [(20 * (math.pi - mouth), 1 / 10, mouth - right), (15, 0, right), (6, 0, right),
                         (15, 0, mouth - right)]),
            ("one sharp corner", [(34, 0, 0), bend, (12, 0, 0), bend, (28, 0, 0), bend, (18, 0, right)]),
            ("comb", tooth * 3 + [(5, 0, right), (10, 0, right), (35, 0, right), (10, 0, right)])]


def noisy(points, sigma, dice):
    return [z + complex(dice.gauss(0, sigma), dice.gauss(0, sigma)) for z in points]


def pairs(points):
    return [(z.real, z.imag) for z in points]


def normal(points, k):
    after, before = points[min(k + 1, len(points) - 1)], points[max(k - 1, 0)]
    return 1j * (after - before) / abs(after - before)


# ------------------------------------------------------------------------------------------- cases
def cases(data, work, _options):
    found = list(order_cases(data, work))
    if not found:
        return [], []
    for name, points, closed in curves():
        for part in PARTS:
            for seed in range(SEEDS):
                found += curve_cases(work, name, points, closed, part, seed)
    for name, chain, closed in chains():
        for sigma in SIGMAS:
            for seed in range(SEEDS):
                found.append(chain_case(work, name, chain, closed, sigma, seed))
    for name, pieces in outlines():
        for sigma in CORNER_SIGMAS:
            for seed in range(SEEDS):
                found.append(outline_case(work, name, pieces, sigma, seed))
    return found, [f"Curves of {POINTS} points with errors of {', '.join(f'{p:g}' for p in PARTS)} of their size (100), "
                   f"{PLANTED} points {FARTHER[0]:g} to {FARTHER[1]:g} standard deviations off.\n"]


def order_cases(data, work):
    for path in sorted((data / "outlines_momocs").rglob("*.csv")):
        points = geometry.distinct([tuple(row[:2]) for row in number_rows(path, 2)])
        points = list(dict.fromkeys(points))
        if len(points) < 8:
            continue
        closed = path.parent.name != "olea"
        name = f"{path.parent.name}_{path.stem}"
        shuffled = random.Random(name).sample(points, len(points))
        file = write_points(work / (name + ".csv"), shuffled, "shuffled points of " + path.name)
        yield Case(name, file, ["--unordered"], None, ORDER, {"points": points, "closed": closed})


def curve_cases(work, name, points, closed, part, seed):
    name = f"{name} {part:g} {seed}"
    dice, sigma = random.Random(name), part * 100
    measured = noisy(points, sigma, dice)
    file = write_points(work / (name.replace(" ", "_") + ".csv"), pairs(measured), name)
    options = ["--closed"] if closed else ["--open"]
    yield Case(name, file, [*options, "--noise", "auto"], sigma, NOISE)
    yield Case(name, file, [*options, "--drop-outliers", "--noise", repr(4 * sigma)], sigma, NONE, [])
    wrong = sorted(random.Random(name + "o").sample(range(3, len(points) - 3), PLANTED))
    wrong = [k for i, k in enumerate(wrong) if i == 0 or k - wrong[i - 1] > 3]
    for k in wrong:
        measured[k] = points[k] + dice.choice((-1, 1)) * dice.uniform(*FARTHER) * sigma * normal(points, k)
    file = write_points(work / (name.replace(" ", "_") + "_wrong.csv"), pairs(measured), name)
    yield Case(name, file, [*options, "--drop-outliers", "--noise", repr(4 * sigma)], sigma, OUTLIERS, [k + 1 for k in wrong])


def chain_case(work, name, chain, closed, sigma, seed):
    name = f"{name} {sigma:g} {seed}"
    dice = random.Random(name)
    pieces, start, theta = [], 0j, 0.3
    for k, (length, kappa) in enumerate(chain):
        pieces.append(TruePiece(k, start, theta, length, kappa, kappa))
        start, theta = pieces[-1].end()
    points, truth = [], []
    for piece in pieces:
        count = max(4, round(PER_UNIT * piece.length))
        truth.append({"kind": piece.kind(), "first": len(points), "last": len(points) + count - 1,
                      "length": piece.length, "kappa": piece.kappa0,
                      "centre": piece.start + 1j * cmath.exp(1j * piece.theta) / piece.kappa0 if piece.kappa0 else 0})
        points += [piece.at(piece.length * (j + 0.5) / count) for j in range(count)]
    file = write_points(work / (name.replace(" ", "_") + ".csv"), pairs(noisy(points, sigma, dice)), name)
    return Case(name, file, ["--closed" if closed else "--open", "--primitives", "--no-corners", "--noise",
                             repr(4 * sigma)], sigma, PRIMITIVES, {"pieces": truth, "points": pairs(points)})


def outline_case(work, name, shape, sigma, seed):
    name = f"{name} {sigma:g} {seed}"
    dice = random.Random(name + "c")
    pieces, start, theta, corners = [], 0j, dice.uniform(0, 6), []
    for k, (length, kappa, turn) in enumerate(shape):
        pieces.append(TruePiece(k, start, theta, length, kappa, kappa))
        start, theta = pieces[-1].end()
        if turn:
            corners.append(start)
        theta += turn
    count = round(sum(p.length for p in pieces) / STEP)
    places = off_corners([p.length for p in pieces], count, dice)
    points, truth = [], []
    for k, piece in enumerate(pieces):
        own = [along_ for number, along_ in places if number == k]
        truth.append({"kind": piece.kind(), "first": len(points), "last": len(points) + len(own) - 1, "length": piece.length,
                      "kappa": piece.kappa0,
                      "centre": piece.start + 1j * cmath.exp(1j * piece.theta) / piece.kappa0 if piece.kappa0 else 0})
        points += [piece.at(s) for s in own]
    file = write_points(work / (name.replace(" ", "_") + ".csv"), pairs(noisy(points, sigma, dice)), name)
    return Case(name, file, ["--closed", "--primitives", "--noise", repr(4 * sigma)], sigma, CORNERS,
                {"pieces": truth, "points": pairs(points), "corners": corners})


def off_corners(lengths, count, dice):
    """Piece and arc length on it of points at one distance around, none on an end of a piece."""
    whole, least = sum(lengths), 0.02 * STEP
    while True:
        begin, out = dice.uniform(0, STEP), []
        for k in range(count):
            s = begin + whole * k / count
            number = 0
            while number + 1 < len(lengths) and s > lengths[number]:
                s -= lengths[number]
                number += 1
            out.append((number, s))
        if all(least < s < lengths[number] - least for number, s in out):
            return out


# -------------------------------------------------------------------------------------------- runs
def run(cases, options):
    """`obvid analyse` or `fit`, as the question wants it."""
    return [run_case(case, options.program, options.work) for case in cases]


def run_case(case, program, work):
    output = work / "scan.json"
    output.unlink(missing_ok=True)
    command = [program, "analyse" if case.group == ORDER else "fit", str(case.path), *case.arguments,
               "--json"] + (["-o", str(output)] if case.group in (PRIMITIVES, CORNERS) else [])
    begin = time.perf_counter()
    done = subprocess.run(command, capture_output=True, text=True, timeout=SECONDS_AT_MOST, check=False)
    outcome = {"name": case.name, "group": case.group, "tolerance": case.tolerance, "exit": done.returncode,
               "error": "", "text": "", "process_seconds": time.perf_counter() - begin}
    if done.returncode != 0:
        line = next((s for s in done.stderr.splitlines() if s.startswith("obvid: error")), "")
        outcome["error"], _, outcome["text"] = line.removeprefix("obvid: error ").partition(": ")
    if case.group == ORDER:
        outcome["clear"] = clear(case.truth["points"], case.truth["closed"])
        outcome["right"] = done.returncode == 0 and ordered(case.truth, json.loads(done.stdout))
    elif case.group == NOISE:
        said = SCATTER.search(done.stderr)
        outcome["ratio"] = float(said.group(1)) / case.tolerance if said else None
    elif case.group == CORNERS:
        contour = json.loads(output.read_text()) if output.exists() else None
        outcome["sides"] = [held_against(row, case, contour)["found"] for row in case.truth["pieces"]]
        outcome["corners"], outcome["met"], outcome["more"] = corners_met(case, contour)
    elif case.group == PRIMITIVES:
        contour = json.loads(output.read_text()) if output.exists() else None
        rows = case.truth["pieces"]
        outcome["primitives"] = [held_against(row, case, contour) for row in rows]
        elements = alignment(case, program)
        outcome["elements"] = [held_against(row, case, elements) for row in rows]
    else:  # what is left out is told before a contour is tried
        line = next((s for s in done.stderr.splitlines() if "--drop-outliers: " in s), "")
        left = [int(number) for number in LEFT_OUT.findall(line)]
        outcome["found"] = len(set(left) & set(case.truth))
        outcome["planted"], outcome["others"] = len(case.truth), len(set(left) - set(case.truth))
    return outcome


def alignment(case, program):
    """Lines and arcs that `obvid alignment` makes of the same points, as a contour file has them."""
    done = subprocess.run([program, "alignment", str(case.path), "--units", "mm", "--noise", repr(4 * case.tolerance),
                           "--json"], capture_output=True, text=True, timeout=SECONDS_AT_MOST, check=False)
    if done.returncode != 0:
        return None
    pieces = []
    for e in json.loads(done.stdout)["elements"]:
        start = complex(e["x"], e["y"])
        end = start + cmath.rect(e["length"], e["heading"])  # of lines
        pieces.append({"type": e["kind"], "start": [start.real, start.imag], "end": [end.real, end.imag],
                       "theta0": e["heading"], "kappa": e["curvature_start"], "length": e["length"]})
    return {"pieces": pieces}


def corners_met(case, contour):
    """How many corners there are, of how many one lies within the tolerance, and how many others were made."""
    made = [complex(*e["point"]) for e in contour["elements"] if e.get("corner")] if contour else []
    true, near = case.truth["corners"], 4 * case.tolerance
    met = sum(any(abs(z - c) <= near for z in made) for c in true)
    return len(true), met, sum(all(abs(z - c) > near for c in true) for z in made)


def clear(points, closed):
    """Whether every point has its neighbours on the outline for its nearest ones."""
    n = len(points)
    for i, p in enumerate(points):
        beside = {(i + 1) % n, (i - 1) % n} if closed else {j for j in (i - 1, i + 1) if 0 <= j < n}
        farthest = max(math.dist(p, points[j]) for j in beside)
        if any(math.dist(p, q) < farthest for j, q in enumerate(points) if j != i and j not in beside):
            return False
    return True


def ordered(truth, found):
    """Whether the chords of the row are those of the outline in its order."""
    points, closed = truth["points"], truth["closed"]
    row = [0j]
    for segment in found["segments"]:
        row.append(row[-1] + cmath.rect(segment["chord"], segment["heading"]))
    if len(row) != len(points):
        return False
    move = sum(complex(*p) for p in points) / len(points) - sum(row) / len(row)
    numbers = [min(range(len(points)), key=lambda k: abs(complex(*points[k]) - z - move)) for z in row]
    n = len(points)
    steps = {(b - a) % n if closed else b - a for a, b in zip(numbers, numbers[1:])}
    return len(set(numbers)) == n and steps in ({1}, {n - 1 if closed else -1})


def held_against(row, case, contour):
    """A line or an arc of the truth: whether one of its kind runs along its inner points, and how far
    radius and centre are off."""
    n = row["last"] - row["first"] + 1
    out = {"kind": row["kind"], "found": False, "flat": False, "loud": case.tolerance >= LOUD}
    inner = [complex(*p) for p in case.truth["points"][row["first"] + 1:row["last"]]]
    best, share = None, 0
    for piece in whole(contour["pieces"]) if contour else []:
        near = sum(abs(offset(piece, z)) <= 6 * case.tolerance and beside(piece, z) for z in inner)
        if near > share:
            best, share = piece, near
    if best is None or 2 * share <= len(inner):
        return out
    out["found"] = best["type"] == row["kind"]
    # an arc that points within the tolerance cannot tell from the line
    out["flat"] = not out["found"] and row["kind"] == "line" and (
        abs(best["kappa"]) * row["length"] ** 2 / 8 <= 4 * case.tolerance)
    if out["found"] and row["kind"] == "arc":
        out["radius_off"] = abs(row["kappa"] / best["kappa"] - 1)
        centre = complex(*best["start"]) + 1j * cmath.exp(1j * best["theta0"]) / best["kappa"]
        out["centre_off"] = abs(centre - row["centre"]) * abs(row["kappa"])
        # of a circle through so many points over such a length: standard deviation of the curvature
        deviation = case.tolerance * math.sqrt(720 / n) / row["length"] ** 2
        out["known"] = deviation / abs(row["kappa"])
    return out


def whole(pieces):
    """Lines and arcs; neighbours that are parts of one, with the same curvature and common tangents, as one."""
    out, before = [], None
    for piece in pieces:
        if piece["type"] not in ("line", "arc"):
            before = None
            continue
        if before and goes_on(before, piece):
            before["end"], before["length"] = piece["end"], before.get("length", 0) + piece.get("length", 0)
            continue
        before = dict(piece)
        out.append(before)
    return out


def goes_on(a, b):
    if a["type"] != b["type"] or math.dist(a["end"], b["start"]) > 1e-9:
        return False
    if a["type"] == "line":
        return abs(cmath.phase((complex(*b["end"]) - complex(*b["start"])) / (complex(*a["end"]) - complex(*a["start"])))) < 1e-9
    turn = b["theta0"] - a["theta0"] - a["kappa"] * a["length"]
    return abs(a["kappa"] / b["kappa"] - 1) < 1e-9 and abs(math.remainder(turn, 2 * math.pi)) < 1e-9


def offset(piece, z):
    start = complex(*piece["start"])
    if piece["type"] == "line":
        along_ = complex(*piece["end"]) - start
        return ((z - start) / along_).imag * abs(along_)
    centre = start + 1j * cmath.exp(1j * piece["theta0"]) / piece["kappa"]
    return abs(z - centre) - 1 / abs(piece["kappa"])


def beside(piece, z):
    """Whether the foot of a place lies on the piece."""
    start = complex(*piece["start"])
    if piece["type"] == "line":
        return 0 <= ((z - start) / (complex(*piece["end"]) - start)).real <= 1
    centre = start + 1j * cmath.exp(1j * piece["theta0"]) / piece["kappa"]
    turn = cmath.phase((z - centre) / (start - centre)) * math.copysign(1, piece["kappa"])
    return turn % (2 * math.pi) <= piece["length"] * abs(piece["kappa"])


# ------------------------------------------------------------------------------------------ tables
def groups(outcomes):
    """Rows of the table: outlines by folder, curves and chains by name."""
    rows = {}
    for o in outcomes:
        words = o["name"].rsplit(" ", 2)
        key = (o["name"].split("_")[0] if o["group"] == ORDER else
               f"{words[0]}, errors {words[1]}" if o["group"] in (PRIMITIVES, CORNERS) else words[0])
        rows.setdefault((o["group"], key), []).append(o)
    return rows


def summary(outcomes):
    rows = []
    for (group, name), some in groups(outcomes).items():
        rows.append([group, name, len(some), sum(o["exit"] == 0 for o in some), figure(group, some),
                     tables.number(1e3 * tables.median(o["process_seconds"] for o in some))])
    return tables.markdown(["question", "data", "runs", "done", "answer", "process ms"], rows)


def figure(group, some):
    if group == ORDER:
        bright = [o for o in some if o["clear"]]
        return (f"right {sum(o['right'] for o in some)}, wrong {sum(o['exit'] == 0 and not o['right'] for o in some)}, "
                f"refused {sum(o['exit'] != 0 for o in some)}; clear ones right {sum(o['right'] for o in bright)} of "
                f"{len(bright)}")
    if group == NOISE:
        ratios = [o["ratio"] for o in some if o["ratio"] is not None]
        return f"{min(ratios, default=math.nan):.2f} to {max(ratios, default=math.nan):.2f} of the errors"
    if group == CORNERS:
        count = lambda key: sum(o[key] for o in some)  # noqa: E731
        sides = [side for o in some for side in o["sides"]]
        return f"found {sum(sides)} of {len(sides)}; corners {count('met')} of {count('corners')}, {count('more')} others"
    if group == PRIMITIVES:
        rows = [r for o in some for r in o["primitives"]]
        arcs = [r for r in rows if "radius_off" in r]
        return (f"found {sum(r['found'] for r in rows)} of {len(rows)}, {sum(r['flat'] for r in rows)} lines as flat "
                f"arcs, radii off "
                f"{tables.number(100 * tables.median(r['radius_off'] for r in arcs), 2)} % (median), "
                f"{tables.number(100 * max((r['radius_off'] for r in arcs), default=math.nan), 2)} % (most); alignment "
                f"{sum(r['found'] for o in some for r in o['elements'])}")
    count = lambda key: sum(o.get(key, 0) for o in some)  # noqa: E731
    return f"{count('found')} of {count('planted')} found, {count('others')} others"


ORDER_RIGHT, ORDER_CLEAR, NOISE_RIGHT, FOUND, OTHERS, SEEN, RADII = 99, 95, 98, 98, 0.1, 98, 90
SIDES = 98
RADIUS_OFF = 0.02


def criteria(outcomes):
    of = lambda group: [o for o in outcomes if o["group"] == group]  # noqa: E731
    order, noise = of(ORDER), of(NOISE)
    bright = [o for o in order if o["clear"]]
    within = [o["ratio"] is not None and 1 / FACTOR <= o["ratio"] <= FACTOR for o in noise]
    wrong = of(OUTLIERS)
    clean = [o for o in wrong + of(NONE) if "others" in o]
    found = 100.0 * sum(o.get("found", 0) for o in wrong) / max(1, sum(o.get("planted", PLANTED) for o in wrong))
    others = 100.0 * sum(o["others"] for o in clean) / max(1, POINTS * len(clean))
    rows = [r for o in of(PRIMITIVES) for r in o["primitives"] if not r["loud"]]
    arcs = [r for r in rows if r.get("known", 1) * 3 < RADIUS_OFF]
    seen = tables.percent(r["found"] or r["flat"] for r in rows)
    aligned = tables.percent(r["found"] for o in of(PRIMITIVES) for r in o["elements"])
    radii = tables.percent(r["radius_off"] <= RADIUS_OFF and r["centre_off"] <= RADIUS_OFF for r in arcs)
    sharp = of(CORNERS)
    sides = tables.percent(side for o in sharp for side in o["sides"])
    corners = 100.0 * sum(o["met"] for o in sharp) / max(1, sum(o["corners"] for o in sharp))
    more = sum(o["more"] for o in sharp)
    given = [o for o in order if o["exit"] == 0]
    right, certain = tables.percent(o["right"] for o in given), tables.percent(o["right"] for o in bright)
    scatter = tables.percent(within)
    return [(f"rows that are given are right, at least {ORDER_RIGHT} %; others are refused with a place",
             f"{right:.1f} % of {len(given)}, {len(order) - len(given)} refused",
             right >= ORDER_RIGHT and all(o["error"] == "E313" for o in order if o["exit"] != 0)),
            (f"clear outlines in order, at least {ORDER_CLEAR} %", f"{certain:.1f} % of {len(bright)}",
             certain >= ORDER_CLEAR),
            (f"scatter within a factor of {FACTOR:g}, at least {NOISE_RIGHT} %", f"{scatter:.1f} % of {len(within)}",
             scatter >= NOISE_RIGHT),
            (f"wrong points found, at least {FOUND} %", f"{found:.1f} %", found >= FOUND),
            (f"others left out, at most {OTHERS:g} % of the points", f"{others:.3f} %", others <= OTHERS),
            (f"lines (or arcs that points cannot tell from them) and arcs found where errors are below {LOUD:g}, "
             f"at least {SEEN} %", f"{seen:.1f} % of {len(rows)}", seen >= SEEN),
            (f"lines and arcs found by `obvid alignment`, at least {SEEN} %", f"{aligned:.1f} %", aligned >= SEEN),
            (f"sides of outlines without a point at their corners, at least {SIDES} %", f"{sides:.1f} %", sides >= SIDES),
            (f"their corners within the tolerance, at least {SIDES} %, and no others", f"{corners:.1f} %, {more} others",
             corners >= SIDES and more == 0),
            (f"radius and centre within {100 * RADIUS_OFF:g} % of the radius where points know it to a third of that, at least "
             f"{RADII} %", f"{radii:.1f} % of {len(arcs)}", radii >= RADII)]
