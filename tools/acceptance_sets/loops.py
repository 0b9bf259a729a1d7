# SPDX-License-Identifier: Apache-2.0
"""Made loops, rounded to a tenth of a millimetre or with 2 mm of noise: `obvid alignment --closed` has
to find their elements again, whatever the tolerance and wherever their points begin.

What counts. A loop is a half, line, arc and clothoids between them or none, and the same turned by half
a turn, so that it closes exactly. Its elements are all seen: the shortest holds seven points. A
tolerance is at least four times the errors of the points. """
import json
import math
import random
import subprocess
import time

from . import matching, tables
from .cases import Case, write_points

STRAIGHT = 200.0  # m
RADII = (30.0, 80.0)
TRANSITIONS = (0.0, 50.0)  # m; 0: a stadium
COUNTS = (90, 180)  # points
BEGINS = (0.0, 37.0, 260.0)  # m behind the start of a straight: a joint, a line, a curve
ERRORS = ((0.0, (0.0005, 0.001, 0.002, 0.005)), (0.002, (0.008, 0.012)))  # m: noise, tolerances
DIGITS = 4
SECONDS_AT_MOST = 300


def half_loop(radius, transition):
    """Kinds and pieces of what turns by half a turn."""
    kappa, arc = 1 / radius, math.pi * radius - transition
    curved = [(transition, 0.0, kappa), (arc, kappa, kappa), (transition, kappa, 0.0)]
    rows = [(STRAIGHT, 0.0, 0.0)] + [row for row in curved if row[0] > 0]
    pieces, at, theta = [], 0j, 0.0
    for k, row in enumerate(rows):
        pieces.append(matching.TruePiece(k, at, theta, *row))
        at, theta = pieces[-1].end()
    return pieces, at


def place(pieces, end, s):
    """At s along the loop: its second half is the first one, turned by half a turn."""
    half = sum(piece.length for piece in pieces)
    s %= 2 * half
    turned, s = s >= half, s % half
    for piece in pieces:
        if s <= piece.length or piece is pieces[-1]:
            point = piece.at(s)
            return end - point if turned else point
        s -= piece.length


def cases(data, work, options):
    out = []
    for radius in RADII:
        for transition in TRANSITIONS:
            pieces, end = half_loop(radius, transition)
            whole = 2 * sum(piece.length for piece in pieces)
            for count in COUNTS:
                for begin in BEGINS:
                    for sigma, tolerances in ERRORS:
                        shape = f"{'oval' if transition else 'stadium'}_{radius:g}_{count}_{begin:g}_{1e3 * sigma:g}mm"
                        noise = random.Random(shape)
                        places = [place(pieces, end, begin + whole * i / count) for i in range(count)]
                        points = [(round(p.real + noise.gauss(0, sigma), DIGITS),
                                   round(p.imag + noise.gauss(0, sigma), DIGITS)) for p in places]
                        path = write_points(work / (shape + ".csv"), points, shape)
                        truth = {"kinds": sorted(2 * [piece.kind() for piece in pieces]), "loop": shape}
                        out += [Case(f"{shape}_{tolerance:g}", path, [], tolerance, shape.split("_")[0], truth)
                                for tolerance in tolerances]
    return out, []


def run(cases, options):
    return [run_case(case, options.program) for case in cases]


def run_case(case, program):
    begin = time.perf_counter()
    done = subprocess.run([program, "alignment", str(case.path), "--units", "m", "--closed", "--noise",
                           f"{case.tolerance}", "--json"], capture_output=True, text=True, timeout=SECONDS_AT_MOST,
                          check=False)
    outcome = {"name": case.name, "group": case.group, "exit": done.returncode, "loop": case.truth["loop"],
               "tolerance": case.tolerance, "true": len(case.truth["kinds"]), "elements": None, "right": False,
               "within": False, "error": done.stderr.strip() if done.returncode else "",
               "process_seconds": time.perf_counter() - begin}
    if done.returncode:
        return outcome
    found = json.loads(done.stdout)
    kinds = sorted({"clothoid": "spiral"}.get(e["kind"], e["kind"]) for e in found["elements"])
    within = max(abs(d["offset"]) for d in found["deviations"]) <= case.tolerance * (1 + 1e-9)
    return {**outcome, "elements": len(kinds), "right": kinds == case.truth["kinds"], "within": within}


def growing(outcomes):
    """Loops that have more elements within a larger tolerance, or none."""
    out = set()
    for a in outcomes:
        for b in outcomes:
            if a["loop"] == b["loop"] and a["tolerance"] < b["tolerance"] and a["elements"] is not None:
                if b["elements"] is None or b["elements"] > a["elements"]:
                    out.add(a["loop"])
    return out


def summary(outcomes):
    table = []
    for name, group in list(tables.groups_of(outcomes).items()) + [("all", outcomes)]:
        table.append([name, len(group), sum(o["elements"] == o["true"] for o in group), sum(o["right"] for o in group),
                      max(o["elements"] or 0 for o in group) if group else 0, len(growing(group)),
                      tables.number(1e3 * max(o["process_seconds"] for o in group))])
    return tables.markdown(["loops", "alignments", "as many elements as built", "of their kinds", "most elements",
                            "more within a larger tolerance", "longest ms"], table)


def criteria(outcomes):
    number = tables.percent(o["elements"] == o["true"] for o in outcomes)
    right = tables.percent(o["right"] for o in outcomes)
    within, more = sum(o["within"] for o in outcomes), growing(outcomes)
    return [("every loop has an alignment within the tolerance", f"{within} of {len(outcomes)}", within == len(outcomes)),
            ("with the elements that were built, at least 98 %", f"{number:.1f} %", number >= 98),
            ("and all of their kinds, at least 98 %", f"{right:.1f} %", right >= 98),
            ("more elements within a larger tolerance", f"{len(more)}", not more)]
