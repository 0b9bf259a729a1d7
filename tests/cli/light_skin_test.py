#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `surface skin --light` says of its distance and its numbers, from the files alone.

usage: light_skin_test.py PROGRAM EXAMPLES

The surfaces of both files are evaluated here (de Boor's recurrence) at places that are no knots; none may
be farther from the other than the report says, and the report no more than what was allowed.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

PLACES_U, PLACES_V = 160, 60


def basis(degree, knots, u):
    """First index and values of the B-splines that are not zero at u."""
    n = len(knots) - degree - 1
    k = degree
    while k < n - 1 and u >= knots[k + 1]:
        k += 1
    values = [1.0]
    for d in range(1, degree + 1):
        row = [0.0] * (d + 1)
        for j in range(d):
            left, right = knots[k + 1 - d + j], knots[k + 1 + j]
            share = (u - left) / (right - left)
            row[j] += (1.0 - share) * values[j]
            row[j + 1] += share * values[j]
        values = row
    return k - degree, values


def bases(degree, knots, count):
    first, last = knots[degree], knots[-degree - 1]
    return [basis(degree, knots, first + (last - first) * (i + 0.371) / count) for i in range(count)]


def points(patch):
    nu = len(patch["knots_u"]) - patch["degree_u"] - 1
    net = patch["points"]
    across = bases(patch["degree_v"], patch["knots_v"], PLACES_V)
    for first, values in bases(patch["degree_u"], patch["knots_u"], PLACES_U):
        column = [[sum(w * net[j * nu + first + i][c] for i, w in enumerate(values)) for c in range(3)]
                  for j in range(len(net) // nu)]
        for start, shares in across:
            yield [sum(w * column[start + j][c] for j, w in enumerate(shares)) for c in range(3)]


def main():
    program, examples = sys.argv[1], pathlib.Path(sys.argv[2])
    stations = str(examples / "surfaces" / "wigley_stations.csv")
    judged = 0
    with tempfile.TemporaryDirectory() as folder:
        def made(name, *options):
            file = pathlib.Path(folder) / name
            done = subprocess.run([program, "surface", "skin", stations, "--units", "m", *options, "-o", str(file)],
                                  capture_output=True, text=True, check=True)
            return done.stdout, json.loads(file.read_text())["patches"]

        _, exact = made("exact.json")
        for allowed in (1e-2, 1e-3, 1e-4):
            text, light = made("light.json", "--light", repr(allowed))
            report = json.loads(made("again.json", "--light", repr(allowed), "--json")[0])["skin"]["light"]
            said = re.search(r"light +(\d+) control points instead of (\d+); nowhere farther than (\S+) m", text)
            assert said, text
            numbers = [sum(len(p["points"]) for p in patches) for patches in (light, exact)]
            assert [int(said[1]), int(said[2])] == numbers, (said[0], numbers)
            assert [report["control_points"], report["control_points_before"]] == numbers, report
            assert numbers[0] < numbers[1] / 2, numbers
            found = max(math.dist(a, b) for one, other in zip(exact, light)
                        for a, b in zip(points(one), points(other)))
            assert found <= report["moved"] <= allowed, (found, report)
            assert report["moved"] <= float(said[3]) <= 1.01 * report["moved"], (said[0], report)
            assert found > 0.1 * report["moved"], "a bound so far above what is there says nothing"
            judged += 1
        # fair across besides: the distance is that of what was written, between the sections too
        options = ("--fair-across", "1e-2", "--light", "1e-3")
        text, fair = made("fair.json", *options)
        report = json.loads(made("again.json", *options, "--json")[0])["skin"]
        _, exact = made("exact.json", "--match", report["matched_by"])
        found = max(math.dist(a, b) for one, other in zip(exact, fair) for a, b in zip(points(one), points(other)))
        light = report["light"]
        assert found <= light["moved"] <= 4.0 * found + 1e-12, (found, light)
        assert light["knots_alone"] <= 1e-3 <= light["tolerance"], light
        assert "made after it was fair" not in text, text
        assert float(re.search(r"nowhere farther than (\S+) m from the exact skin, fairing included", text)[1]) >= found, text
        judged += 1
    print(f"{judged} light skins judged")
    assert judged == 4


if __name__ == "__main__":
    main()
