#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `surface skin --fair-across` says of its distances and its waves, from the files alone.

usage: fair_across_test.py PROGRAM EXAMPLES

Stations of a smooth hull get scatter of a known size. The surfaces of the exact and of the fair skin are
evaluated here (de Boor's recurrence) at places that are no knots: no section may be farther from where it
was than the report says, and the report no more than what was allowed. A plane border stays in its plane.
Bending across is looked at in second differences of points close to each other, and changes its sign
less often than before.
"""
import csv
import json
import math
import pathlib
import random
import subprocess
import sys
import tempfile

from light_skin_test import basis

PLACES = 150


def row_at(patch, v):
    """Control points of the line v = const."""
    nu = len(patch["knots_u"]) - patch["degree_u"] - 1
    start, shares = basis(patch["degree_v"], patch["knots_v"], v)
    return [[sum(w * patch["points"][(start + j) * nu + i][c] for j, w in enumerate(shares)) for c in range(3)]
            for i in range(nu)]


def point(patch, row, u):
    start, shares = basis(patch["degree_u"], patch["knots_u"], u)
    return [sum(w * row[start + i][c] for i, w in enumerate(shares)) for c in range(3)]


def bends(patch, least):
    """Changes of the side that half-breadths bend to, along waterlines u = const: of bulges that leave their
    chord by more than `least`."""
    lines, steps = 21, 400
    rows = [row_at(patch, k / steps) for k in range(steps)] + [row_at(patch, 1.0 - 1e-12)]
    changes = 0
    for i in range(1, lines):
        y = [point(patch, row, i / lines)[1] for row in rows]
        side, begun, last = 0, 0, 0
        for k in range(1, steps):
            bend = y[k - 1] - 2.0 * y[k] + y[k + 1]
            now = 1 if bend > 0 else -1
            if now != side or k == steps - 1:
                chord = [y[begun] + (y[k] - y[begun]) * (j - begun) / (k - begun) for j in range(begun, k)] if k > begun else []
                high = max((abs(y[begun + j] - c) for j, c in enumerate(chord)), default=0.0)
                if side and high > least:
                    changes += 1 if last and last != side else 0
                    last = side
                side, begun = now, k
    return changes


def main():
    program, examples = sys.argv[1], pathlib.Path(sys.argv[2])
    lines = (examples / "surfaces" / "wigley_stations.csv").read_text().splitlines()
    stations = list(csv.reader(line for line in lines if not line.startswith("#")))
    dice = random.Random(5)
    scatter = 3e-2
    judged = 0
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        shift = {}
        for row in stations[1:]:
            side = shift.setdefault(row[0], dice.uniform(-scatter, scatter))
            row[2] = repr(float(row[2]) * (1.0 + side / 0.5))  # half-breadths are up to 0.5
        source = folder / "hull.csv"
        source.write_text("\n".join(",".join(row) for row in stations) + "\n")

        def made(name, *options):
            file = folder / name
            done = subprocess.run([program, "surface", "skin", str(source), "--units", "m", *options, "--json", "-o", str(file)],
                                  capture_output=True, text=True, check=True)
            return json.loads(done.stdout)["skin"], json.loads(file.read_text())["patches"]

        for allowed in (1e-3, 6e-3, 2e-2):
            report, fair = made("fair.json", "--fair-across", repr(allowed))
            said = report["fair_across"]
            tried = said["tried"]
            assert tried[0]["matched_by"] == report["matched_by"], tried
            for trial in tried[1:]:  # what forces less loses runs of curvature, or is heavy
                assert trial["forced"] >= tried[0]["forced"] or trial["ripple"] > 1e-3 or trial["heavier"] > 2.0, tried
            exact_report, exact = made("exact.json", "--match", report["matched_by"])
            assert said["tolerance"] == allowed and said["moved"] <= allowed, said
            farthest = 0.0
            for one, other in zip(exact, fair):
                assert one["knots_u"] == other["knots_u"] and one["knots_v"] == other["knots_v"]
                for section in report["sections"]:
                    v = min(section["v"], 1.0 - 1e-12)
                    rows = row_at(one, v), row_at(other, v)
                    for k in range(PLACES):
                        u = (k + 0.371) / PLACES
                        farthest = max(farthest, math.dist(point(one, rows[0], u), point(other, rows[1], u)))
            assert farthest <= said["moved"] * (1.0 + 1e-9) + 1e-12, (farthest, said)
            assert said["moved"] == 0.0 or farthest > 0.1 * said["moved"], (farthest, said)
            for before, after in zip(exact_report["sections"], report["sections"]):
                assert after["ripple"] <= max(1e-3, 1.01 * before["ripple"]), (before, after)
            assert report["across"]["beyond"] <= said["before"]["beyond"], report["across"]
            counted = [sum(bends(p, allowed / 4.0) for p in patches) for patches in (exact, fair)]
            assert counted[1] <= counted[0], counted
            judged += 1
            print(f"{allowed}: moved {said['moved']:.3g} (found {farthest:.3g}), changes {said['before']['found']} to "
                  f"{report['across']['found']}, forced {report['across']['forced']}; here {counted[0]} to {counted[1]}")
        assert counted[1] < counted[0], "scatter within the tolerance makes waves that need not be"
    assert judged == 3


if __name__ == "__main__":
    main()
