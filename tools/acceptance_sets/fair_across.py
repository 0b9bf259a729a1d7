# SPDX-License-Identifier: Apache-2.0
"""Skins that are fair across, against the exact ones: public hulls and blades, EPS 1e-4 of their size.

Both surfaces are read from their files and evaluated here (B-splines of numpy alone). Distances of the
sections are looked at densely; changes of bending are counted along lines u = const, the fewest are those
of a string drawn tight by a search that shares nothing with the program's, and curvature along each section
is followed against the run that the exact skin has there. A second table has what each kind of skin (exact,
light, fair across, both) costs: control points, time, STEP file, how far its sections are from those of the exact one, and
whether FreeCAD calls the file valid, where freecadcmd is there. """
import json
import os
import resource
import shutil
import subprocess
import time

import numpy as np

from . import tables
from .cases import Case

SHARE = 1e-4  # of the size: EPS
LINES, PLACES, ALONG = 120, 16, 6  # lines across, places of a span on them, places of a span along
SECONDS = 10.0
RUN = 1e-3  # of a section's largest curvature
TURN = 0.1 * RUN  # the exact skin's curvature turns back by as much on arcs and clothoids of its contours: no run ends there
BARS = {"Series 60": 0.05, "patrol boat": 0.10, "rotor 37": 0.10, "IEA 15": 0.05}
LIGHT = {"IEA 15": 1e-4}  # units; of the others EPS
LIGHT_OF_EPS = 0.3  # of light skins that are fair across


def cases(data, work, _options):
    hull = lambda name: data / "hulls_grids" / f"{name}_x.dat"  # noqa: E731
    found = [("Series 60", [hull("Series60Offset")], []), ("trawler", [hull("TrawlerOffset")], []),
             ("patrol boat", [hull(f"wpb_offset_{part}") for part in ("bottom", "mid", "top")], []),
             ("rotor 37", [data / "turbomachinery_nasa" / "rotor37geometry.dat"], ["--noise", "1e-4"]),
             ("IEA 15", [data / "windturbine_iea15" / "IEA-15-240-RWT_AeroDyn15_blade.dat",
                         *sorted((data / "windturbine_iea15").glob("*_Coords.txt"))], ["--noise", "2e-4"]),
             ("gunnerus", [data / "found" / "files" / "gunnerus_offsets.csv"], []),
             ("PX121", [data / "hulls_offset_tables" / "PX121_offsets.csv"], []),
             ("Series 60, table", [data / "hulls_offset_tables" / "series60_4214W-B4_table7.csv"], [])]
    work.mkdir(parents=True, exist_ok=True)
    return [Case(name, files[0], options, 0.0, "skins", files) for name, files, options in found
            if files and all(f.exists() for f in files)], [f"EPS {SHARE:g} of the size.\n"]


# ------------------------------------------------------------------- surfaces
def basis(degree, knots, at):
    """First B-spline and values of those that are not 0 at places, by the recurrence: [place], [place, degree + 1]."""
    inner = np.unique(knots)
    span = np.searchsorted(knots, np.minimum(at, inner[-2] + 0.999999 * (inner[-1] - inner[-2])), "right") - 1
    values = np.ones((len(at), 1))
    for d in range(1, degree + 1):
        grown = np.zeros((len(at), d + 1))
        for j in range(d):
            left, right = knots[span + 1 - d + j], knots[span + 1 + j]
            part = (at - left) / (right - left)
            grown[:, j] += (1.0 - part) * values[:, j]
            grown[:, j + 1] += part * values[:, j]
        values = grown
    return span - degree, values


def derived(degree, knots, net):
    """Degree, knots and control points of the derivative along the first axis."""
    width = knots[degree + 1:-1] - knots[1:-degree - 1]
    factor = np.divide(degree, width, out=np.zeros_like(width), where=width > 0)
    return degree - 1, knots[1:-1], np.diff(net, axis=0) * factor.reshape(-1, *[1] * (net.ndim - 1))


def along_first(degree, knots, net, at, derivatives):
    for _ in range(derivatives):
        degree, knots, net = derived(degree, knots, net)
    first, values = basis(degree, knots, np.asarray(at, float))
    return sum(values[:, j].reshape(-1, *[1] * (net.ndim - 1)) * net[first + j] for j in range(degree + 1))


class Surface:
    def __init__(self, patch):
        self.ku, self.kv = patch["degree_u"], patch["degree_v"]
        self.tu, self.tv = np.array(patch["knots_u"], float), np.array(patch["knots_v"], float)
        self.net = np.array(patch["points"], float).reshape(-1, len(self.tu) - self.ku - 1, 3)

    def grid(self, u, v, du=0, dv=0):
        """[u, v, coordinate]."""
        rows = along_first(self.kv, self.tv, self.net, v, dv)
        return along_first(self.ku, self.tu, rows.transpose(1, 0, 2), u, du)


def unit(x):
    return x / np.maximum(np.linalg.norm(x, axis=-1, keepdims=True), 1e-300)


def places(breaks, each):
    steps = np.diff(breaks)
    return (breaks[:-1, None] + steps[:, None] * (np.arange(each) + 0.5) / each).ravel()


# ------------------------------------------------------------------- waves
def changes(surface, u, v, least):
    """Of each line: changes of sign of normal curvature, of bulges higher than `least`."""
    at = places(v, PLACES)
    su, sv, svv = (surface.grid(u, at, *d) for d in ((1, 0), (0, 1), (0, 2)))
    q = (sv ** 2).sum(-1)
    kappa = (unit(np.cross(su, sv)) * svv).sum(-1) / np.maximum(q, 1e-300)
    length = np.sqrt(q) * np.repeat(np.diff(v), PLACES) / PLACES
    out = []
    for k, ds in zip(kappa, length):
        cuts = np.r_[0, np.flatnonzero(np.diff(np.sign(k))) + 1, len(k)]
        bulges = [np.sign(k[a]) for a, b in zip(cuts, cuts[1:])
                  if np.abs(k[a:b]).max() * ds[a:b].sum() ** 2 / 8 > least and k[a] != 0]
        out.append(sum(a != b for a, b in zip(bulges, bulges[1:])))
    return np.array(out)


def string_changes(x, low, high):
    """Fewest changes of a string drawn tight, the best of nine choices of its ends."""
    best = len(x)
    for first in (0.0, 0.5, 1.0):
        for last in (0.0, 0.5, 1.0):
            lo, hi = low.copy(), high.copy()
            for end, share in ((0, first), (-1, last)):
                lo[end] = hi[end] = low[end] + share * (high[end] - low[end])
            i, y, bends = 0, lo[0], []
            while i < len(x) - 1:
                d = x[i + 1:] - x[i]
                up, down = np.minimum.accumulate((hi[i + 1:] - y) / d), np.maximum.accumulate((lo[i + 1:] - y) / d)
                hit = np.flatnonzero(up < down)
                if not len(hit):
                    break
                k = hit[0]  # up to here no straight line; what came new decides the side
                rises = (lo[i + 1 + k] - y) / d[k] == down[k] and (k == 0 or down[k] > down[k - 1])
                slopes = (hi if rises else lo)[i + 1:i + 1 + k] - y
                held = np.argmin(slopes / d[:k]) if rises else np.argmax(slopes / d[:k])
                i, y = i + 1 + held, (hi if rises else lo)[i + 1 + held]
                bends.append(rises)
            best = min(best, sum(a != b for a, b in zip(bends, bends[1:])))
    return best


def forced(surface, u, v, tolerance):
    p = surface.grid(u, v)
    n = unit(np.cross(surface.grid(u, v, 1, 0), surface.grid(u, v, 0, 1)))
    out = []
    for q, m in zip(p, n):
        keep = np.r_[True, np.linalg.norm(np.diff(q, axis=0), axis=1) > 0]
        q, m = q[keep], m[keep]
        a = np.linalg.norm(np.diff(q, axis=0), axis=1)
        turn = (np.diff(np.diff(q, axis=0) / a[:, None], axis=0) * m[1:-1]).sum(-1)
        f = np.r_[0, np.cumsum(np.r_[0, np.cumsum(turn)] * a)]
        out.append(string_changes(np.r_[0, np.cumsum(a)], f - tolerance, f + tolerance))
    return np.array(out)


# ------------------------------------------------------------------- sections
def normal_of(points):
    """Of the plane of least squares."""
    return np.linalg.svd(points - points.mean(0), full_matrices=False)[2][2]


def given_normals(file):
    """Of the planes that the points of matrices give each section; None where the file is no such matrix. Stations that
    are not plane look otherwise along other directions, and a curve's own points weigh it otherwise than those given."""
    if not file.name.endswith("_x.dat"):
        return None
    x, y, z = (np.loadtxt(file.with_name(f"{file.name[:-5]}{axis}.dat")) for axis in "xyz")
    return [normal_of(row) for row in np.stack([x, y, z], axis=-1)]


def against_run(exact, fair, v, size, normals=None):
    """Largest fall of curvature against the run that the exact section has, share of its largest."""
    breaks = np.unique(exact.tu)
    u = np.sort(np.r_[breaks, places(breaks, ALONG)])  # runs end at breaks
    worst = 0.0
    points = exact.grid(u, v)
    slopes = [(one.grid(u, v, 1), one.grid(u, v, 2)) for one in (exact, fair)]
    for k in range(len(v)):
        q = points[:, k]
        if np.ptp(q, axis=0).max() < 1e-6 * size:
            continue
        normal = normal_of(q) if normals is None else normals[k]
        wanted, found = (np.cross(a[:, k], b[:, k]) @ normal
                         / np.maximum(np.linalg.norm(a[:, k] - np.outer(a[:, k] @ normal, normal), axis=1), 1e-300) ** 3
                         for a, b in slopes)
        largest = np.abs(wanted).max()
        if largest * size < 1e-6:  # a straight line: its curvature is rounding
            continue
        worst = max(worst, fall(wanted / largest, found / largest))
    return worst


def turns_of(wanted):
    """Where the run changes: of each change the places within TURN of its extreme, and the run before: 1 or -1."""
    out, direction, low, high = [], 0, 0, 0
    for i, w in enumerate(wanted):
        if w > wanted[high]:
            high = i
        if w < wanted[low]:
            low = i
        if direction >= 0 and wanted[high] - w > TURN:  # it falls now
            if direction:
                out.append((high, 1))
            direction, low, high = -1, i, i
        elif direction <= 0 and w - wanted[low] > TURN:
            if direction:
                out.append((low, -1))
            direction, low, high = 1, i, i
    flat = []
    for at, before in out:
        first, last = at, at
        while first > 0 and abs(wanted[first - 1] - wanted[at]) <= TURN:
            first -= 1
        while last + 1 < len(wanted) and abs(wanted[last + 1] - wanted[at]) <= TURN:
            last += 1
        flat.append((first, last, before))
    return flat, direction


def fall(wanted, found):
    """Largest fall of one against the runs of the other. Where a run ends within TURN of the same value on a stretch
    (an arc), it ends where that is best for what is judged."""
    turns, last_run = turns_of(wanted)
    worst, begun = 0.0, 0
    for first, last, run in [*turns, (len(wanted) - 1, len(wanted) - 1, last_run)]:
        first = max(first, begun)
        end = first + int(np.argmax(run * found[first:last + 1])) if last > first else last
        part = run * found[begun:end + 1]
        if run and len(part):
            worst = max(worst, float((np.maximum.accumulate(part) - part).max()))
        begun = end
    return worst


def lines_of(patch):
    breaks = np.unique(patch["knots_u"])
    return breaks[np.unique(np.linspace(0, len(breaks) - 1, min(LINES, len(breaks))).astype(int))]


def judged(exact_patches, fair_patches, v, size, tolerance, files):
    total = dict.fromkeys(("before", "after", "fine_before", "fine_after", "fine_beyond", "forced", "beyond_before",
                           "beyond"), 0)
    moved, run, run_before = 0.0, 0.0, 0.0
    for number, (one, other) in enumerate(zip(exact_patches, fair_patches)):
        exact, fair = Surface(one), Surface(other)
        normals = given_normals(files[number]) if len(files) == len(exact_patches) else None
        if normals is not None and len(normals) != len(v):
            raise ValueError(f"{files[number].name}: {len(normals)} rows for {len(v)} sections")
        breaks = np.unique(exact.tu)
        u = lines_of(one)
        need = forced(exact, u, v, tolerance)
        before, after = changes(exact, u, v, tolerance), changes(fair, u, v, tolerance)
        total["before"] += before.sum()
        total["after"] += after.sum()
        total["forced"] += need.sum()
        total["beyond_before"] += np.maximum(before - need, 0).sum()
        total["beyond"] += np.maximum(after - need, 0).sum()
        total["fine_before"] += changes(exact, u, v, 0.1 * tolerance).sum()
        shallow = changes(fair, u, v, 0.1 * tolerance)
        total["fine_after"] += shallow.sum()
        total["fine_beyond"] += np.maximum(shallow - need, 0).sum()
        dense = places(breaks, ALONG)
        moved = max(moved, np.linalg.norm(exact.grid(dense, v) - fair.grid(dense, v), axis=-1).max())
        run = max(run, against_run(exact, fair, v, size, normals))
        run_before = max(run_before, against_run(exact, exact, v, size, normals))
    return {**{key: int(n) for key, n in total.items()}, "moved": float(moved), "run": run, "run_before": run_before}


# ------------------------------------------------------------------- runs
def skin(program, case, output, options):
    """Done with its STEP file beside its own; wall clock and processor time are those without STEP."""
    command = [program, "surface", "skin", *map(str, case.truth), *case.arguments, *options, "--json", "-o"]
    begun, used = time.time(), resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime
    done = subprocess.run([*command, str(output)], capture_output=True, text=True)
    wall, spent = time.time() - begun, resource.getrusage(resource.RUSAGE_CHILDREN).ru_utime - used
    if done.returncode in (0, 5):  # 5: a section's contour is not proved
        subprocess.run([program, "surface", "convert", str(output), "-o", str(output.with_suffix(".step"))],
                       capture_output=True)
    return done, wall, spent


FREECAD = """import json, os, Part
for path in json.loads(os.environ["OBVID_FILES"]):
    shape = Part.Shape()
    shape.read(path)
    print("JUDGED " + json.dumps([path, shape.isValid(), len(shape.Faces)]))
"""


def valid_in_freecad(files, work):
    """Of each file whether FreeCAD reads faces and calls them valid; nothing without FreeCAD."""
    if shutil.which("freecadcmd") is None:
        return {}
    script = work / "judge_step.py"
    script.write_text(FREECAD)
    done = subprocess.run(["freecadcmd", str(script)], capture_output=True, text=True, stdin=subprocess.DEVNULL,
                          env={**os.environ, "HOME": str(work), "OBVID_FILES": json.dumps([str(f) for f in files])})
    told = [json.loads(line[7:]) for line in done.stdout.splitlines() if line.startswith("JUDGED ")]
    return {path: valid and faces > 0 for path, valid, faces in told}


def run(cases_, options):
    return [run_case(case, options.program, options.work) for case in cases_]


def apart(exact_patches, other_patches, v):
    """Largest distance of the sections, at the same parameters."""
    worst = 0.0
    for one, other in zip(exact_patches, other_patches):
        exact = Surface(one)
        dense = places(np.unique(exact.tu), ALONG)
        worst = max(worst, np.linalg.norm(exact.grid(dense, v) - Surface(other).grid(dense, v), axis=-1).max())
    return float(worst)


def run_case(case, program, work):
    outcome = {"name": case.name, "group": case.group, "exit": 0, "error": "", "text": "", "points": None}
    files = {kind: work / f"{kind}.json" for kind in ("exact", "light", "fair", "both")}
    done, *_ = skin(program, case, files["exact"], [])
    size = json.loads(done.stdout)["size"] if done.returncode in (0, 5) else 0.0
    tolerance = SHARE * size
    light = LIGHT.get(case.name, tolerance)
    kinds = {"fair": ["--fair-across", repr(tolerance)], "exact": [], "light": ["--light", repr(light)],
             "both": ["--fair-across", repr(tolerance), "--light", repr(LIGHT_OF_EPS * tolerance)]}
    made, match = {}, []
    for kind, chosen in kinds.items():  # the fair one says which matching the others are held against
        if done.returncode in (0, 5):
            done, wall, used = skin(program, case, files[kind], [*chosen, *match])
        if done.returncode not in (0, 5):
            return {**outcome, "exit": done.returncode, "error": done.stderr.strip(), "text": done.stderr}
        report = json.loads(done.stdout)
        match = ["--match", report["skin"]["matched_by"]]
        made[kind] = {"report": report["skin"], "wall": wall, "seconds": used, "patches": json.loads(files[kind].read_text())["patches"]}
    said = made["fair"]["report"]
    v = np.array([s["v"] for s in said["sections"]])
    valid = valid_in_freecad([f.with_suffix(".step") for f in files.values()], work)
    skins = {}
    for kind, one in made.items():
        step, told = files[kind].with_suffix(".step"), one["report"]
        proved = {"exact": None, "light": (told.get("light") or {}).get("moved")}.get(kind, (told.get("fair_across") or {}).get("moved"))
        skins[kind] = {"points": sum(len(p["points"]) for p in one["patches"]), "wall": one["wall"],
                       "seconds": one["seconds"], "bytes": step.stat().st_size if step.exists() else None, "proved": proved,
                       "allowed": {"light": light}.get(kind, tolerance), "off": apart(made["exact"]["patches"], one["patches"], v),
                       "forced": told["across"]["forced"], "beyond": told["across"]["beyond"],
                       "ripple": max((s["ripple"] for s in told["sections"]), default=0.0), "valid": valid.get(str(step))}
    patches = [made[kind]["patches"] for kind in ("exact", "fair")]
    return {**outcome, "tolerance": tolerance, **judged(*patches, v, size, tolerance, case.truth), "said": said["fair_across"]["moved"],
            "program": said["across"], "matched_by": said["matched_by"], "tried": said["fair_across"]["tried"],
            "seconds": made["fair"]["seconds"], "plain": made["exact"]["seconds"], "process_seconds": made["fair"]["wall"], "skins": skins}


# ------------------------------------------------------------------- tables
def strict(o):
    """The same of bulges of EPS / 10."""
    return o["fine_beyond"] / max(o["forced"], 1)


def share(o):
    return o["beyond"] / max(o["forced"], 1)


def summary(outcomes):
    rows = [[o["name"], ", ".join(f"{t['matched_by']} {t['forced']}" for t in o["tried"]), f"{o['before']} -> {o['after']}", o["forced"],
             f"{o['beyond_before']} -> {o['beyond']}", f"{100 * share(o):.1f} %", f"{100 * strict(o):.1f} %",
             f"{o['fine_before']} -> {o['fine_after']}", f"{o['moved'] / o['tolerance']:.3f}",
             f"{o['said'] / o['tolerance']:.3f}", f"{o['run_before']:.1e} -> {o['run']:.1e}",
             f"{o['plain']:.1f} -> {o['seconds']:.1f}"] for o in outcomes if "before" in o]
    return tables.markdown(["body", "matchings: what each forces, the first was used", "changes", "forced", "beyond",
                            "of the forced", "of bulges of EPS / 10", "changes, bulges of EPS / 10",
                            "moved / EPS", "bound said", "against runs", "s, one core"], rows)


def details(outcomes):
    """What each kind of skin costs, and how far its sections are from those of the exact one."""
    rows = []
    for o in outcomes:
        for kind, s in o.get("skins", {}).items():
            off = "" if s["proved"] is None else f"{s['proved']:.2e}, {s['off']:.2e}, {s['allowed']:.2e}"
            size = "none" if s["bytes"] is None else f"{s['bytes'] / 1e6:.2f}"
            rows.append([o["name"], {"fair": "fair across", "both": "light and fair"}.get(kind, kind), f"{s['points']:,}",
                         f"{s['seconds']:.1f}, {s['wall']:.1f}", size, off, f"{s['beyond']} of {s['forced']}", f"{s['ripple']:.1e}",
                         {True: "yes", False: "no", None: "not asked"}[s["valid"]]])
    return tables.markdown(["body", "skin", "control points", "processor, wall, s", "STEP, MB", "sections moved: proved, seen, allowed",
                            "changes beyond, of the forced", "against runs", "valid in FreeCAD"], rows)


def criteria(outcomes):
    done = [o for o in outcomes if "before" in o]
    found = [("every body is done", f"{len(done)} of {len(outcomes)}", len(done) == len(outcomes)),
             ("no section moved beyond EPS", f"{max((o['moved'] / o['tolerance'] for o in done), default=9):.3f}",
              all(o["moved"] <= o["tolerance"] for o in done)),
             ("nor beyond the bound that is said", "", all(o["moved"] <= 1.000001 * o["said"] + 1e-12 for o in done))]
    for o in done:
        bar = BARS.get(o["name"])
        if bar is not None:
            found.append((f"{o['name']}: beyond at most {100 * bar:.0f} % of the forced", f"{100 * share(o):.1f} %",
                          share(o) <= bar))
            found.append((f"{o['name']}: the same of bulges of EPS / 10", f"{100 * strict(o):.1f} %",
                          strict(o) <= bar))
        moved = [s for s in o["skins"].values() if s["proved"] is not None]
        found.append((f"{o['name']}: every skin within its bound, and that within its tolerance", "",
                      all(s["off"] <= 1.000001 * s["proved"] + 1e-12 and s["proved"] <= s["allowed"] for s in moved)))
        found.append((f"{o['name']}: STEP files valid in FreeCAD", "", all(s["valid"] is not False for s in o["skins"].values())))
        found.append((f"{o['name']}: curvature against its run at most {RUN:g}", f"{o['run']:.1e}",
                      o["run"] <= max(RUN, 1.01 * o["run_before"])))  # what the exact skin has lost is lost
        found.append((f"{o['name']}: at most {SECONDS:.0f} s", f"{o['seconds']:.1f} s", o["seconds"] <= SECONDS))
    return found
