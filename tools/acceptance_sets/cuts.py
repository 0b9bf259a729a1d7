# SPDX-License-Identifier: Apache-2.0
"""`obvid surface cut`: random planes through spheres, cylinders, tori, Wigley's hull and public hulls.

Every branch is counted by the signs on a grid of parameters that shares no code with the program
(section_judge.py), and every crossing of that grid must lie on a branch. Points are held against the
closed form of the body, and of all bodies against the surface that they name by its parameters. """
import json
import math
import random
import subprocess
import time

import numpy as np

from . import section_judge, tables
from .cases import Case

EXACT = 1e-9  # of the size: closed forms
CHORD = 1e-4  # of the size: tolerance that is asked for
AT_ONCE = 25  # planes of one run
GRIDS = (160, 1600)  # places along each parameter; the finer one where branches are not as many
SECONDS_AT_MOST = 300
BODIES = {"sphere": 200, "cylinder": 175, "torus": 250, "Wigley": 150}
HULLS = {"Series 60": ("Series60Offset",), "trawler": ("TrawlerOffset",), "patrol boat, panel": ("wpb_offset_mid",)}
PLANES_OF_HULL = 75
VOLUMES, FLOATING = 40, "floating sphere, torus, Wigley"
HALF = math.sqrt(0.5)


# ------------------------------------------------------------------------------------- surfaces
def model(patches):
    return {"format": "obvid-surface", "version": 1, "name": "body", "units": "mm", "units_source": "given",
            "patches": patches}


def circle(radius):
    """Nine control points of a full turn as rational quadratic, with weights."""
    x, y = [1, 1, 0, -1, -1, -1, 0, 1, 1], [0, 1, 1, 1, 0, -1, -1, -1, 0]
    return [(radius * a, radius * b) for a, b in zip(x, y)], [1, HALF] * 4 + [1]


TURN = [0, 0, 0, .25, .25, .5, .5, .75, .75, 1, 1, 1]


def revolved(profile, weights, degree, knots):
    """A profile of (radius, height) about z: rational, exact; v around the axis."""
    ring, ring_weights = circle(1.0)
    points = [[r * x, r * y, z] for x, y in ring for r, z in profile]
    return {"name": "body", "degree_u": degree, "degree_v": 2, "knots_u": knots, "knots_v": TURN, "points": points,
            "weights": [w * a for a in ring_weights for w in weights]}


def sphere(radius):
    profile = [(0, -1), (1, -1), (1, 0), (1, 1), (0, 1)]
    return revolved([(radius * r, radius * z) for r, z in profile], [1, HALF, 1, HALF, 1], 2, [0, 0, 0, .5, .5, 1, 1, 1])


def torus(large, small):
    ring, weights = circle(small)
    return revolved([(large + x, z) for x, z in ring], weights, 2, TURN)


def cylinder(radius, height):
    return revolved([(radius, 0.0), (radius, height)], [1, 1], 1, [0, 0, 1, 1])


def wigley(length, breadth, draught):
    """y = B / 2 (1 - x^2) (1 - z^2): one biquadratic patch, x over the length, z from -1 to 0."""
    along = [(-1.0, 0.0), (0.0, 2.0), (1.0, 0.0)]  # x and the coefficients of 1 - x^2
    up = [(-1.0, 0.0), (-0.5, 1.0), (0.0, 1.0)]
    return {"name": "hull", "degree_u": 2, "degree_v": 2, "knots_u": [0, 0, 0, 1, 1, 1], "knots_v": [0, 0, 0, 1, 1, 1],
            "points": [[length / 2 * x, breadth / 2 * a * b, draught * z] for z, b in up for x, a in along]}


def off_sphere(radius):
    return lambda p: np.abs(np.linalg.norm(p, axis=1) - radius)


def off_torus(large, small):
    return lambda p: np.abs(np.hypot(np.hypot(p[:, 0], p[:, 1]) - large, p[:, 2]) - small)


def off_cylinder(radius):
    return lambda p: np.abs(np.hypot(p[:, 0], p[:, 1]) - radius)


def off_wigley(length, breadth, draught):
    return lambda p: np.abs(p[:, 1] - breadth / 2 * (1 - (2 * p[:, 0] / length) ** 2) * (1 - (p[:, 2] / draught) ** 2))


# ---------------------------------------------------------------------------------------- cases
def planes_through(points, count, dice):
    """Random normals, offsets anywhere between the ends of the body."""
    out = []
    for _ in range(count):
        normal = np.array([dice.gauss(0, 1) for _ in range(3)])
        normal /= np.linalg.norm(normal)
        low, high = (points @ normal).min(), (points @ normal).max()
        out.append((normal.tolist(), low + (high - low) * dice.uniform(0.002, 0.998)))
    return out


def body_of(name, dice):
    if name == "sphere":
        r = dice.uniform(0.5, 20)
        return sphere(r), off_sphere(r)
    if name == "torus":
        large = dice.uniform(1, 20)
        small = large * dice.uniform(0.1, 0.9)
        return torus(large, small), off_torus(large, small)
    if name == "cylinder":
        r = dice.uniform(0.5, 20)
        return cylinder(r, r * dice.uniform(0.3, 5)), off_cylinder(r)
    size = dice.uniform(5, 120), dice.uniform(1, 12), dice.uniform(0.5, 8)
    return wigley(*size), off_wigley(*size)


def cases(data, work, options):
    work.mkdir(parents=True, exist_ok=True)
    dice, found = random.Random(19), []
    for name, count in BODIES.items():
        for k in range(0, count, AT_ONCE):
            told, off = body_of(name, dice)
            path = work / f"{name}-{k // AT_ONCE + 1}.json"
            path.write_text(json.dumps(model([told])))
            found.append(Case(path.stem, path, [], EXACT, name, (off, planes_of([told], min(AT_ONCE, count - k), dice))))
    for name in ("sphere", "torus", "Wigley"):
        for k in range(VOLUMES):
            told, water, half, truth = floating(name, dice)
            path = work / f"floating-{name}-{k + 1}.json"
            path.write_text(json.dumps(model([told])))
            options_of = ["--draught", repr(water), *(["--half"] if half else [])]
            found.append(Case(path.stem, path, options_of, EXACT, FLOATING, truth))
    for name, stems in HULLS.items():
        files = [str(data / "hulls_grids" / f"{stem}_{axis}.dat") for stem in stems for axis in "xyz"]
        path = work / (name.split(",")[0].replace(" ", "_") + ".json")
        done = subprocess.run([options.program, "surface", "skin", *files, "-o", str(path), "-q"], capture_output=True,
                              text=True, check=False, timeout=SECONDS_AT_MOST)
        if not path.exists():
            print(f"{name}: no skin: {done.stderr.strip()[:200]}")
            continue
        patches = json.loads(path.read_text())["patches"]
        for k in range(0, PLANES_OF_HULL, AT_ONCE):
            found.append(Case(f"{name} {k // AT_ONCE + 1}", path, [], EXACT, name, (None, planes_of(patches, AT_ONCE, dice))))
    return found, [f"Chords within {CHORD:g} of the size; planes of random direction and place, seed 19.\n"]


def segment(r, t):
    """Area of a disc of radius r below the height t of its middle, and first moment about that height 0."""
    t = max(-r, min(r, t))
    half = math.sqrt(r * r - t * t)
    return r * r * (math.pi / 2 + math.asin(t / r)) + t * half, -2.0 / 3.0 * half ** 3


def floating(name, dice):
    """A body, the height of its water, whether it is a half, and volume, waterplane, x, y and z of the centre in closed
    form; the body is moved away from the origin."""
    if name == "sphere":
        r, x, y, z = dice.uniform(0.5, 20), *(dice.uniform(-50, 50) for _ in range(3))
        t = r * dice.uniform(-0.95, 0.95)
        h = r + t
        truth = (math.pi * h * h * (3 * r - h) / 3, math.pi * (r * r - t * t), x, y,
                 z - 3 * (2 * r - h) ** 2 / (4 * (3 * r - h)))
        return moved(sphere(r), x, y, z), z + t, False, truth
    if name == "torus":
        large, x, y, z = dice.uniform(1, 20), *(dice.uniform(-50, 50) for _ in range(3))
        small = large * dice.uniform(0.1, 0.9)
        t = small * dice.uniform(-0.95, 0.95)
        area, moment = segment(small, t)
        truth = (2 * math.pi * large * area, 4 * math.pi * large * math.sqrt(small ** 2 - t ** 2), x, y, z + moment / area)
        return moved(torus(large, small), x, y, z), z + t, False, truth
    length, breadth, draught = dice.uniform(5, 120), dice.uniform(1, 12), dice.uniform(0.5, 8)
    w = dice.uniform(0, 0.9)  # the water lies w draughts below the edge
    x, z = dice.uniform(-50, 50), dice.uniform(-50, 50)
    volume = 2 / 3 * length * breadth * draught * (2 / 3 - w + w ** 3 / 3)
    moment = -2 / 3 * length * breadth * draught ** 2 * (0.25 - w * w / 2 + w ** 4 / 4)
    truth = (volume, 2 / 3 * length * breadth * (1 - w * w), x, 0.0, z + moment / volume)
    return moved(wigley(length, breadth, draught), x, 0.0, z), z - w * draught, True, truth


def moved(patch, *by):
    return {**patch, "points": [[a + b for a, b in zip(p, by)] for p in patch["points"]]}


def planes_of(patches, count, dice):
    points = np.concatenate([section_judge.Patch(p).grid(*(section_judge.Patch(p).places(a, 40) for a in (0, 1))).reshape(-1, 3)
                             for p in patches])
    return planes_through(points, count, dice)


# ----------------------------------------------------------------------------------------- runs
def run(cases, options):
    return [run_case(case, options.program, options.work) for case in cases]


def run_floating(case, program):
    arguments = [case.arguments[0] + "=" + case.arguments[1], *case.arguments[2:]]
    begin = time.perf_counter()
    done = subprocess.run([program, "surface", "cut", str(case.path), *arguments, "--json"], capture_output=True, text=True,
                          timeout=SECONDS_AT_MOST, check=False)
    outcome = {"name": case.name, "group": case.group, "tolerance": EXACT, "exit": done.returncode, "error": "", "text": "",
               "process_seconds": time.perf_counter() - begin, "planes": 0}
    if done.returncode != 0:
        line = next((s for s in done.stderr.splitlines() if s.startswith("obvid: error")), "")
        outcome["error"], _, outcome["text"] = line.removeprefix("obvid: error ").partition(": ")
        return outcome
    report = json.loads(done.stdout)
    said, size = report["hydrostatics"], report["size"]
    volume, plane, *centre = case.truth
    outcome["volume_off"] = abs(said["volume"]["value"] - volume) / volume
    outcome["plane_off"] = abs(said["waterplane_area"]["value"] - plane) / plane
    outcome["centre_off"] = max(abs(said["centre_" + a]["value"] - c) for a, c in zip("xyz", centre)) / size
    return outcome


def run_case(case, program, work):
    if case.group == FLOATING:
        return run_floating(case, program)
    off, planes = case.truth
    told = json.loads(case.path.read_text())["patches"]
    patches = [section_judge.Patch(p) for p in told]
    corners = np.concatenate([p.net[..., :3].reshape(-1, 3) / p.net[..., 3:].reshape(-1, 1) for p in patches])
    size = float(np.linalg.norm(corners.max(axis=0) - corners.min(axis=0)))
    output = work / "sections.json"
    output.unlink(missing_ok=True)
    typed = [x for normal, d in planes for x in ("--plane", ",".join(repr(float(v)) for v in [*normal, d]))]
    begin = time.perf_counter()
    done = subprocess.run([program, "surface", "cut", str(case.path), *typed, "--tolerance", repr(CHORD * size), "-q", "-o",
                           str(output)], capture_output=True, text=True, timeout=SECONDS_AT_MOST, check=False)
    outcome = {"name": case.name, "group": case.group, "tolerance": CHORD * size, "exit": done.returncode, "error": "",
               "text": "", "process_seconds": time.perf_counter() - begin, "planes": len(planes)}
    if done.returncode != 0:
        line = next((s for s in done.stderr.splitlines() if s.startswith("obvid: error")), "")
        outcome["error"], _, outcome["text"] = line.removeprefix("obvid: error ").partition(": ")
        return outcome
    sections = json.loads(output.read_text())["sections"]
    figures = [judged(s, n, d, patches, off, size) for s, (n, d) in zip(sections, planes)]
    outcome.update({key: max(f[key] for f in figures) for key in ("closed_form", "own", "plane", "missed")})
    outcome.update({key: sum(f[key] for f in figures) for key in ("branches", "wrong", "touching")})
    return outcome


def judged(section, normal, offset, patches, off, size):
    normal = np.array(normal)
    lines, worst = [], {"closed_form": 0.0, "own": 0.0, "plane": 0.0, "missed": 0.0}
    for branch in section["branches"]:
        points, at = np.array(branch["points"]), np.array(branch["parameters"])
        lines.append(np.concatenate([points, points[:1]]) if branch["closed"] else points)
        worst["plane"] = max(worst["plane"], np.abs(points @ normal - offset).max() / size)
        for k, patch in enumerate(patches):
            mine = at[:, 0] == k
            if mine.any():
                apart = np.linalg.norm(patch.points(at[mine, 1:]) - points[mine], axis=1).max() / size
                worst["own"] = max(worst["own"], apart)
        if off:
            worst["closed_form"] = max(worst["closed_form"], off(points).max() / size)
    closed = sum(b["closed"] for b in section["branches"])
    for grid in GRIDS:
        count, rings, places = section_judge.branches(patches, normal, offset, grid, size)
        wrong = (count, rings) != (len(section["branches"]), closed)
        if not wrong:
            break
    if len(places):
        worst["missed"] = section_judge.from_polylines(places, lines).max() / (CHORD * size) if lines else math.inf
    return {**worst, "branches": len(section["branches"]), "wrong": int(wrong), "touching": len(section["touching"])}


# --------------------------------------------------------------------------------------- tables
def summary(outcomes):
    rows = []
    for name, group in tables.groups_of([o for o in outcomes if o["group"] != FLOATING]).items():
        done = [o for o in group if o["exit"] == 0]
        most = lambda key, of=done: tables.number(max((o[key] for o in of), default=None))  # noqa: E731
        count = lambda key, of=done: sum(o[key] for o in of)  # noqa: E731
        rows.append([name, sum(o["planes"] for o in group), count("branches"), count("wrong"), most("missed"),
                     most("closed_form") if done and name in BODIES else "", most("own"), most("plane"), count("touching"),
                     tables.number(1e3 * sum(o["process_seconds"] for o in group) / sum(o["planes"] for o in group))])
    return tables.markdown(["body", "sections", "branches", "sections with other branches than the grid",
                            "crossings of the grid off the branches / chord tolerance", "off the closed form / size",
                            "off the surface at their parameters / size", "off the plane / size", "touching places",
                            "ms a section"], rows)


def details(outcomes):
    group = [o for o in outcomes if o["group"] == FLOATING and o["exit"] == 0]
    if not group:
        return ""
    most = lambda key: tables.number(max(o[key] for o in group))  # noqa: E731
    return tables.markdown(["bodies", "number", "volume off / volume", "waterplane off / area", "centre off / size", "ms each"],
                           [[FLOATING, len(group), most("volume_off"), most("plane_off"), most("centre_off"),
                             tables.number(1e3 * sum(o["process_seconds"] for o in group) / len(group))]])


def criteria(outcomes):
    floats = [o for o in outcomes if o["group"] == FLOATING and o["exit"] == 0]
    done = [o for o in outcomes if o["exit"] == 0 and o["group"] != FLOATING]
    all_done = len(done) + len(floats)
    off = max((max(o["volume_off"], o["plane_off"], o["centre_off"]) for o in floats), default=0.0)
    most = lambda key: max((o[key] for o in done), default=math.inf)  # noqa: E731
    sections = sum(o["planes"] for o in done)
    return [("every run is done", f"{all_done} of {len(outcomes)}", all_done == len(outcomes)),
            ("sections", f"{sections}", sections > 0),
            ("every branch found, closed where closed", f"{sum(o['wrong'] for o in done)} sections not",
             not sum(o["wrong"] for o in done)),
            ("crossings of the grid lie on branches within the chord tolerance", f"{most('missed'):.3g}", most("missed") <= 1.0),
            (f"closed forms within {EXACT:g} of the size", f"{most('closed_form'):.2g}", most("closed_form") <= EXACT),
            ("points are those of their parameters within 1e-12 of the size", f"{most('own'):.2g}", most("own") <= 1e-12),
            ("points lie in the plane within 1e-12 of the size", f"{most('plane'):.2g}", most("plane") <= 1e-12),
            (f"volumes, waterplanes and centres of closed forms within {EXACT:g}", f"{off:.2g}", off <= EXACT)]
