# SPDX-License-Identifier: Apache-2.0
"""`obvid toolpath`: six surfaces, three cutters, all strategies; printed programs judged by mill_judge.py.

Places of the surface lie at random parameters, their points and normals are those of de Boor's recurrence
(section_judge.py). Nothing may be cut deeper than the tolerance, and over each place no more than the stated scallop
may stay along the normal, or the report has to say that more stays, and how much. Roughing leaves what it says.
With --only one part: `hull`, `ball`, `scallop`, or all words of a name. """
import json
import math
import subprocess
import time

import numpy as np
from scipy.spatial import cKDTree

from . import mill_judge, section_judge, tables
from .cases import Case

CUTTERS = {"ball": (6.0, 3.0), "bull": (6.0, 1.5), "flat": (4.0, 0.0)}  # diameter, corner
STRATEGIES = ("zigzag", "isoparametric", "scallop", "z-level", "rough")
PARTS = ("waves", "dome", "bowl", "saddle", "bank", "hull")
PLACES = 1500
SPARE = 0.02  # of the scallop: that is found at single places
SLOWEST = 20.0  # seconds, for a hull at a scallop of 0.05 mm
HULL_LENGTH = 300.0
ALLOWANCE, LEVEL, LADDER, LADDER_STEP = 0.3, 2.0, 40, 1.1
STEEP = "12"  # degrees: from there on levels keep the scallop; what is flatter is told
SECONDS_AT_MOST = 300
UPRIGHT = 0.03  # z of normals
BESIDE, AROUND = 2.0, 1.0  # mm: places on both sides of an upright wall, and how far around them the part is looked for
RASTER = 400  # places along each parameter, for that


def net(wide, deep, height, count=13):
    """A bicubic patch whose x and y are its parameters."""
    inner = np.linspace(0.0, 1.0, count - 2)
    knots = np.concatenate([[0.0] * 3, inner, [1.0] * 3])
    places = np.array([knots[i + 1:i + 4].mean() for i in range(count)])
    return {"name": "part", "degree_u": 3, "degree_v": 3, "knots_u": knots.tolist(), "knots_v": knots.tolist(),
            "points": [[wide * u, deep * v, float(height(wide * u, deep * v))] for v in places for u in places]}


HEIGHTS = {"waves": lambda x, y: 1.5 * math.sin(x / 4.5) * math.cos(y / 4.5),
           "dome": lambda x, y: math.sqrt(900.0 - (x - 15.0) ** 2 - (y - 12.0) ** 2) - 30.0,
           "bowl": lambda x, y: 22.0 - math.sqrt(484.0 - (x - 15.0) ** 2 - (y - 12.0) ** 2),
           "saddle": lambda x, y: 0.02 * ((x - 15.0) ** 2 - (y - 12.0) ** 2),
           "bank": lambda x, y: 4.0 * math.tanh(0.35 * (x + 0.3 * y - 18.0))}


def hull(data, work, program):
    """Half of Series 60 on its plane of symmetry, breadth upwards, to 300 mm: as it is milled for a mould."""
    files = [str(data / "hulls_grids" / f"Series60Offset_{axis}.dat") for axis in "xyz"]
    skin = work / "skin.json"
    subprocess.run([program, "surface", "skin", *files, "-o", str(skin), "-q"], check=True, timeout=SECONDS_AT_MOST)
    patches = json.loads(skin.read_text())["patches"]
    points = np.concatenate([np.array(p["points"]) for p in patches])
    spans = points.max(axis=0) - points.min(axis=0)
    length = int(np.argmax(spans))
    breadth = 3 - length - 2 if length != 2 else 1  # of x, y, z of the tables: along, across, up
    up = 3 - length - breadth
    scale = HULL_LENGTH / spans[length]
    side = 1.0 if points[:, breadth].max() > -points[:, breadth].min() else -1.0
    for patch in patches:
        patch["points"] = [[scale * p[length], scale * side * -p[up], scale * side * p[breadth]] for p in patch["points"]]
    return patches


def cases(data, work, options):
    work.mkdir(parents=True, exist_ok=True)
    found = []
    for part in PARTS:
        names = [f"{part} {cutter} {strategy}" for cutter in CUTTERS for strategy in STRATEGIES]
        if not any(options.only in name for name in names):
            continue
        told = hull(data, work, options.program) if part == "hull" else [net(30.0, 24.0, HEIGHTS[part])]
        path = work / f"{part}.json"
        path.write_text(json.dumps({"format": "obvid-surface", "version": 1, "name": part, "units": "mm",
                                    "units_source": "given", "patches": told}))
        tolerance, scallop = (0.01, 0.05) if part == "hull" else (0.02, 0.1)
        for name in names:
            _, cutter, strategy = name.split()
            found.append(Case(name, path, arguments_of(cutter, strategy, tolerance, scallop), tolerance, part,
                              (cutter, strategy, scallop)))
    return found, [f"Ball D6, bull nose D6 R1.5, flat D4; tolerance 0.02 mm and scallop 0.1 mm on 30 x 24 mm, hull of "
                   f"{HULL_LENGTH:g} mm: 0.01 and 0.05 mm; {PLACES} random places of each part.\n"]


def arguments_of(cutter, strategy, tolerance, scallop):
    diameter, corner = CUTTERS[cutter]
    out = ["--cutter", cutter, "--diameter", repr(diameter), "--strategy", strategy, "--tolerance", repr(tolerance)]
    out += ["--corner-radius", repr(corner)] if cutter == "bull" else []
    if strategy == "rough":
        return out + ["--step-down", repr(LEVEL), "--allowance", repr(ALLOWANCE), "--entry", "helix"]
    if strategy == "z-level":
        out += ["--steep-angle", STEEP]
        if cutter == "flat":  # stairs: hundreds of levels for a scallop
            return out + ["--step-down", "1"]
    return out + ["--scallop", repr(scallop)]


# ----------------------------------------------------------------------------------------- runs
def run(cases, options):
    return [run_case(case, options.program, options.work) for case in cases]


def places_of(path):
    """Points and upward normals at random parameters, off the borders by a hair."""
    dice = np.random.default_rng(5)
    points, normals = [], []
    patches = [section_judge.Patch(p) for p in json.loads(path.read_text())["patches"]]
    for patch in patches:
        (u0, u1), (v0, v1) = patch.domain(0), patch.domain(1)
        uv = dice.uniform(0.001, 0.999, (PLACES // len(patches), 2)) * [u1 - u0, v1 - v0] + [u0, v0]
        step = 1e-6 * np.array([u1 - u0, v1 - v0])
        du, dv = (patch.points(uv + e) - patch.points(uv - e) for e in (step * [1, 0], step * [0, 1]))
        normal = np.cross(du / step[0], dv / step[1])
        normal /= np.linalg.norm(normal, axis=1)[:, None]
        points.append(patch.points(uv))
        normals.append(np.where(normal[:, 2:] < 0.0, -normal, normal))
    return np.concatenate(points), np.concatenate(normals)


def open_sides(path, points, normals):
    """The normal's z does not say which side of an upright wall is open: the one over which the part rises less."""
    upright = np.flatnonzero(abs(normals[:, 2]) < UPRIGHT)
    patches = [section_judge.Patch(p) for p in json.loads(path.read_text())["patches"]]
    grids = [patch.grid(*(np.linspace(*patch.domain(axis), RASTER) for axis in (0, 1))) for patch in patches]
    raster = np.concatenate([grid.reshape(-1, 3) for grid in grids])
    tree = cKDTree(raster[:, :2])

    def heights(places):
        near = tree.query_ball_point(places[:, :2], AROUND)
        return np.array([raster[n, 2].max() if n else -math.inf for n in near])

    out = normals.copy()
    aside = BESIDE * normals[upright]
    other = heights(points[upright] + aside) > heights(points[upright] - aside)
    out[upright[other]] *= -1.0
    return out


def run_case(case, program, work):
    cutter, strategy, scallop = case.truth
    output = work / "part.nc"
    output.unlink(missing_ok=True)
    begin = time.perf_counter()
    outcome = {"name": case.name, "group": case.group, "tolerance": case.tolerance, "exit": None, "error": "timeout",
               "text": f"more than {SECONDS_AT_MOST} s", "process_seconds": float(SECONDS_AT_MOST), "strategy": strategy}
    try:
        done = subprocess.run([program, "toolpath", str(case.path), *case.arguments, "-o", str(output), "--json"],
                              capture_output=True, text=True, timeout=SECONDS_AT_MOST, check=False)
    except subprocess.TimeoutExpired:
        return outcome
    outcome.update({"exit": done.returncode, "error": "", "text": "", "process_seconds": time.perf_counter() - begin})
    if done.returncode:
        line = next((s for s in done.stderr.splitlines() if s.startswith("obvid: error")), "")
        outcome["error"], _, outcome["text"] = line.removeprefix("obvid: error ").partition(": ")
    if not output.exists():
        return outcome
    told = json.loads(done.stdout)
    diameter, corner = CUTTERS[cutter]
    rough = strategy == "rough"
    points, normals = places_of(case.path)
    stock = points.min(axis=0) - [ALLOWANCE, ALLOWANCE, 0.0], points.max(axis=0) + ALLOWANCE
    rapid, feed = mill_judge.ways_of(output.read_text(), 1e-3 * case.tolerance)
    sweep = mill_judge.Sweep(0.5 * diameter, corner, feed)
    normals = open_sides(case.path, points, normals)
    points = points + (ALLOWANCE if rough else 0.0) * normals
    outcome["gouge"] = float(max(0.0, -sweep.distance(points).min()))
    level = np.linalg.norm(rapid[:, 1, :2] - rapid[:, 0, :2], axis=1) > 0.0
    outcome["rapid_low"] = int((rapid[level][:, :, 2].min(axis=1) < told["safe_z"] - 1e-3).sum())
    outcome["minutes"], outcome["blocks"] = told["minutes"], told["blocks"]
    if rough:
        outcome.update(what_stays_of_stock(sweep, points, normals, told["scallop"]["found"], stock))
    else:
        outcome.update(what_stays(sweep, points, normals, told, case.tolerance, scallop, strategy, cutter))
    return outcome


def what_stays_of_stock(sweep, points, normals, told, stock):
    """Places over which more of the stock stays along the normal than is told, but for what its own figure is worth: it
    is that of the middles of cells."""
    heights = (told + 0.1 * LEVEL) * np.linspace(0.0, 1.0, LADDER)
    lines = (points[:, None, :] + heights[None, :, None] * normals[:, None, :]).reshape(-1, 3)
    gone = (sweep.distance(lines) <= 0.0) | ((lines > stock[1]) | (lines < stock[0])).any(axis=1)
    over = ~gone.reshape(len(points), -1).any(axis=1)
    return {"over": int(over.sum()), "left": float("nan"), "told": told, "named": not over.any()}


def number(value):
    """No number in JSON: no bound."""
    return math.inf if value is None else value


def what_stays(sweep, points, normals, told, tolerance, scallop, strategy, cutter):
    """Places with more than the scallop, the most there, and whether the report says that much."""
    allowed = (1.0 + SPARE) * scallop
    if strategy == "z-level" and cutter == "flat":
        allowed = (1.0 + SPARE) * max(scallop, min(number(told["scallop"]["found"]), 2.0 * sweep.radius))
    high = np.flatnonzero(sweep.distance(points + allowed * normals) > 0.0)
    count, most, height = len(high), 0.0, allowed
    while len(high):
        most = height
        if height > 2.0 * sweep.radius:
            most = math.inf
            break
        height *= LADDER_STEP
        high = high[sweep.distance(points[high] + height * normals[high]) > 0.0]
    says = max([number(told["scallop"]["found"]), number(told["unreached_depth"])]
               + [number(told["flat_left"]) if told["flat_area"] > 0.0 else 0.0])
    share = (told["unreached_area"] + told["hidden_area"] + told["flat_area"]) / told["surface_area"]
    # a share of places is a guess of a share of area: three deviations of it, and the half cells at the borders
    guess = share + 3.0 * math.sqrt(max(share, 1.0 / len(points)) / len(points)) + 0.01
    named = count == 0 or (bool(told["not_kept"]) and most <= LADDER_STEP * says + tolerance
                           and (count / len(points) <= guess or says == number(told["scallop"]["found"])))
    return {"over": count, "left": most, "told": says, "named": named}


# --------------------------------------------------------------------------------------- tables
def summary(outcomes):
    rows = []
    for strategy in STRATEGIES:
        for part, group in tables.groups_of([o for o in outcomes if o["strategy"] == strategy]).items():
            done = [o for o in group if "gouge" in o]
            most = lambda key, of=done: tables.number(max((o[key] for o in of), default=None))  # noqa: E731
            rows.append([f"{strategy}, {part}", f"{len(done)} of {len(group)}", most("gouge"),
                         sum(o["over"] for o in done), sum(not o["named"] for o in done), most("minutes"), most("blocks"),
                         most("process_seconds")])
    return tables.markdown(["strategy, part", "programs", "deepest gouge, mm", "places over the scallop",
                            "programs that do not say so", "longest, min", "most blocks", "slowest, s"], rows)


def criteria(outcomes):
    done = [o for o in outcomes if "gouge" in o]
    deep = [o["name"] for o in done if o["gouge"] > o["tolerance"]]
    silent = [o["name"] for o in done if not o["named"]]
    low = sum(o["rapid_low"] for o in done)
    slow = [o for o in outcomes if o["group"] == "hull" and o["process_seconds"] > SLOWEST]
    return [("every program is made", f"{len(done)} of {len(outcomes)}", len(done) == len(outcomes)),
            ("none cuts deeper than the tolerance", ", ".join(deep) or "none does", not deep),
            ("rapid moves aside keep the safe height", f"{low} do not", low == 0),
            ("the scallop is kept, or what stays is said", ", ".join(silent) or "everywhere", not silent),
            (f"a hull at a scallop of 0.05 mm in {SLOWEST:g} s at most",
             ", ".join(f"{o['name']} {o['process_seconds']:.1f} s" for o in slow) or "each", not slow)]
