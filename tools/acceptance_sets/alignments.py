# SPDX-License-Identifier: Apache-2.0
"""Roads of OpenDRIVE and LandXML files, a point every 5 m with 2 mm of noise: `obvid alignment` has
to find their elements again.

What counts. Neighbouring elements of the truth that are one curve are joined. An element is *seen*
when at least four points lie on it and no simpler kind passes within the tolerance of these. It is
*found once* when one element of the alignment covers its points but for the first and the last,
and *right* when that is of its kind. The kind is judged where the neighbours are seen too: what
is too short to be seen is made good by its neighbours where the fewest elements are asked for
(docs/decisions/0013); the figure of all is told too. A
radius is judged where noise lets it be known: three
standard deviations of the curvature of a circle through so many points with that noise are less
than what it may be off. """
import bisect
import collections
import json
import math
import random
import subprocess
import time
import xml.etree.ElementTree

from . import matching, roads, tables, transitions
from .cases import Case, number_rows, write_points

STEP, SIGMA = 5.0, 0.002  # m
TOLERANCE = 4 * SIGMA
RADIUS_OFF = 0.01
FEWEST_POINTS = 4
LARGEST_KINK = 1e-3  # rad; elements of alignments have common tangents
SECONDS_AT_MOST = 300
DRAWN = 0.05  # m: tolerance of curves that are no chains of elements, and of transitions
TRACK, MOST_OF_TRACK = "center_Spielberg.csv", 75


def landxml_alignments(path):
    """Pieces of the alignments of a LandXML file: lines, arcs, clothoids; None for others."""
    root = xml.etree.ElementTree.parse(path).getroot()
    plain = lambda node: node.tag.split("}")[-1]  # noqa: E731
    child = lambda node, name: next((c for c in node if plain(c) == name), None)  # noqa: E731

    def point(node, name):
        found = child(node, name)
        if found is None or not found.text:
            return None
        north, east = map(float, found.text.split()[:2])
        return complex(east, north)

    for alignment in root.iter():
        if plain(alignment) != "Alignment":
            continue
        geometry = child(alignment, "CoordGeom")
        pieces = []
        for node in geometry if geometry is not None else []:
            start, end = point(node, "Start"), point(node, "End")
            if start is None or end is None:
                pieces = None
                break
            side = 1.0 if node.get("rot") == "ccw" else -1.0
            curvature = lambda key, of=node, side=side: (  # noqa: E731
                0.0 if of.get(key) == "INF" else side / float(of.get(key)))
            if plain(node) == "Line":
                length, kappas = abs(end - start), (0.0, 0.0)
            elif plain(node) == "Curve":
                kappas = (curvature("radius"),) * 2
                length = 2 * math.asin(abs(end - start) / 2 * abs(kappas[0])) / abs(kappas[0])
            elif plain(node) == "Spiral" and node.get("spiType") == "clothoid":
                kappas = curvature("radiusStart"), curvature("radiusEnd")
                length = float(node.get("length"))
            else:
                pieces = None
                break
            # the chord of the piece as it would lie along x says its heading
            along = matching.TruePiece(0, 0j, 0.0, length, *kappas).end()[0]
            turned = (end - start) / along
            theta = math.atan2(turned.imag, turned.real)
            pieces.append(matching.TruePiece(len(pieces), start, theta, length, *kappas))
        if pieces:
            yield alignment.get("name"), pieces


def chains(path):
    if path.suffix == ".xodr":
        for road in xml.etree.ElementTree.parse(path).getroot().iter("road"):
            yield road.get("id"), roads.plan_view(road)
    else:
        yield from landxml_alignments(path)


def largest_kink(pieces):
    """How far a piece turns from the tangent of the one before, rad."""
    return max((abs(math.remainder(a.end()[1] - b.theta, 2 * math.pi)) for a, b in zip(pieces, pieces[1:])),
               default=0.0)


def road_case(path, name, pieces, work):
    truth = matching.sampled_truth(pieces, STEP, TOLERANCE)
    noise = random.Random(f"{path.name} {name}")
    points = [(x + noise.gauss(0, SIGMA), y + noise.gauss(0, SIGMA)) for x, y in truth["points"]]
    name = f"{path.stem}_{name}".replace("/", "_").replace(" ", "_")
    write_points(work / (name + ".csv"), points, f"{path.name}, {name}")
    return Case(name, work / (name + ".csv"), [], TOLERANCE, path.stem, truth)


def cases(data, work, options):
    found, left_out = [], collections.Counter()
    paths = sorted((data / "roads_opendrive").glob("*.xodr")) + sorted((data / "landxml").glob("*.xml"))
    for path in paths:
        for name, pieces in chains(path):
            if not pieces:
                left_out["with a parametric cubic"] += 1
            elif roads.largest_gap(pieces) > 0.25 * SIGMA:
                left_out["with a gap above a quarter of the noise"] += 1
            elif largest_kink(pieces) > LARGEST_KINK:
                left_out["with a corner"] += 1
            elif sum(piece.length for piece in pieces) < FEWEST_POINTS * STEP:
                left_out[f"shorter than {FEWEST_POINTS * STEP:g} m"] += 1
            else:
                found.append(road_case(path, name, pieces, work))
    found += drawn_cases(data, work)
    notes = [f"A point every {STEP:g} m with {SIGMA * 1e3:g} mm of noise, tolerance "
             f"{TOLERANCE * 1e3:g} mm. Left out: "
             + ", ".join(f"{n} {why}" for why, n in left_out.items()) + ".\n"]
    return found, notes


def drawn_cases(data, work):
    """A transition is one element, a race track few."""
    paths = sorted((data / "rail_transition_curves").glob("*Clothoid*.txt"))
    curves = [(path, [tuple(row[1:3]) for row in transitions.rows_of(path)], 1) for path in paths]
    curves += [(path, [tuple(row[:2]) for row in number_rows(path, 2)], MOST_OF_TRACK)
               for path in (data / "found" / "files").glob(TRACK)]
    for path, points, most in curves:
        copy = write_points(work / (path.stem + ".csv"), points, path.name)
        truth = {"points": points, "pieces": [], "most": most}
        yield Case(path.stem, copy, [], DRAWN, "track" if most > 1 else "transitions", truth)


def run(cases, options):
    """`obvid alignment` in place of `obvid fit`."""
    return [run_case(case, options.program) for case in cases]


def run_case(case, program):
    outcome = {"name": case.name, "group": case.group, "tolerance": case.tolerance, "error": "",
               "points": len(case.truth["points"])}
    begin = time.perf_counter()
    done = subprocess.run([program, "alignment", str(case.path), "--units", "m", "--noise", f"{case.tolerance}",
                           "--json"], capture_output=True, text=True, timeout=SECONDS_AT_MOST, check=False)
    outcome["process_seconds"] = time.perf_counter() - begin
    outcome["exit"] = done.returncode
    if done.returncode != 0:
        outcome["error"] = done.stderr.strip()
        return {**outcome, "seen": [], "elements": None, "true": len(case.truth["pieces"])}
    found = json.loads(done.stdout)
    outcome["elements"] = len(found["elements"])
    outcome["true"] = len(case.truth["pieces"])
    outcome["most"] = case.truth.get("most", outcome["true"])
    outcome["within"] = max(abs(d["offset"]) for d in found["deviations"]) <= case.tolerance * (1 + 1e-9)
    rows = case.truth["pieces"]
    for k, row in enumerate(rows):
        row["clear"] = all(beside["seen"] for beside in rows[max(0, k - 1):k + 2])
    outcome["seen"] = [held_against(row, found) for row in rows if row["seen"]]
    return outcome


def held_against(row, found):
    """One element of the truth: how many elements lie where its inner points are."""
    starts = [e["station"] for e in found["elements"]]
    stations = [d["station"] for d in found["deviations"]]
    first, last = row["first"] + 1, row["last"] - 1
    at = [max(0, bisect.bisect_right(starts, stations[i]) - 1) for i in (first, max(first, last))]
    one = at[0] == at[1]
    element = found["elements"][at[0]]
    kind = {"clothoid": "spiral"}.get(element["kind"], element["kind"])
    out = {"kind": row["kind"], "once": one, "right": one and kind == row["kind"],
           "clear": row["clear"], "length": row["length"], "start": row["start"], "found": kind if one else "several"}
    if row["kind"] == "arc" and out["right"]:
        deviation = SIGMA * math.sqrt(720 / row["samples"]) / row["length"] ** 2
        if 3 * deviation < RADIUS_OFF * abs(row["kappa0"]):
            out["radius_off"] = abs(row["kappa0"] / element["curvature_start"] - 1)
    return out


def rows_of(outcomes):
    return [row for o in outcomes for row in o["seen"]]


def summary(outcomes):
    table = []
    for name, group in list(tables.groups_of(outcomes).items()) + [("all", outcomes)]:
        rows = rows_of(group)
        fitted = [o for o in group if o["elements"] is not None]
        radii = [r["radius_off"] for r in rows if "radius_off" in r]
        table.append([name, len(group), sum(o["true"] for o in fitted), sum(o["elements"] for o in fitted),
                      len(rows), f"{tables.percent(r['once'] for r in rows):.1f} %",
                      f"{tables.percent(r['right'] for r in rows if r['once'] and r['clear']):.1f} %",
                      f"{tables.percent(r['right'] for r in rows if r['once'] and not r['clear']):.1f} %",
                      f"{tables.percent(r <= RADIUS_OFF for r in radii):.1f} % of {len(radii)}",
                      tables.number(1e3 * max(o["process_seconds"] for o in group))])
    return tables.markdown(["file", "roads", "elements", "found", "seen", "found once", "of its kind",
                            "beside unseen ones", "radius within 1 %", "longest ms"], table)


def details(outcomes):
    rows = rows_of(outcomes)
    everywhere = tables.percent(r["right"] for r in rows if r["once"])
    why = collections.Counter((r["kind"], r["found"]) for r in rows_of(outcomes) if not r["right"])
    arcs = [r for r in rows if r["kind"] == "arc"]
    told = (f"Of all {sum(r['once'] for r in rows)} found once {everywhere:.1f} % are of their kind; radii are judged on "
            f"{sum('radius_off' in r for r in arcs)} of {len(arcs)} arcs (docs/decisions/0013).\n\n")
    return told + tables.markdown(["seen, but not right", "found as", "elements"],
                           [[kind, found, n] for (kind, found), n in why.most_common()])


def criteria(outcomes):
    rows = rows_of(outcomes)
    once = tables.percent(r["once"] for r in rows)
    right = tables.percent(r["right"] for r in rows if r["once"] and r["clear"])
    radii = [r["radius_off"] for r in rows if "radius_off" in r]
    within = tables.percent(r <= RADIUS_OFF for r in radii)
    more = [o for o in outcomes if o["elements"] is not None and o["elements"] > o["most"]]
    track = [o["elements"] for o in outcomes if o["group"] == "track"]
    return [("every road has an alignment", f"{sum(o['exit'] == 0 for o in outcomes)} of {len(outcomes)}",
             all(o["exit"] == 0 for o in outcomes)),
            ("points within the tolerance", f"{sum(o.get('within', False) for o in outcomes)}",
             all(o["within"] for o in outcomes if o["exit"] == 0)),
            ("seen elements found once, at least 95 %", f"{once:.1f} %", once >= 95),
            ("of these of the right kind, at least 98 %", f"{right:.1f} %", right >= 98),
            ("radii that noise lets be known within 1 %", f"{within:.1f} % of {len(radii)}", within == 100),
            ("with more elements than the source; a transition more than 1; the track more than "
             f"{MOST_OF_TRACK} (has {', '.join(map(str, track))})", f"{len(more)}", not more)]
