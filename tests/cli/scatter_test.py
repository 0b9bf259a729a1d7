#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `surface scatter` says of its surface, from its file alone.

usage: scatter_test.py PROGRAM

Splines are evaluated here by de Boor's recurrence. Judged are: the distance of every point, the mean square
and the farthest point; the bending, by Gauss quadrature of second derivatives that are taken of the control
points; that the sum of squares plus weight times bending is stationary; the parts without points, by a search
of all points; that a turned and scaled cloud gives the same surface; outliers that were put in; that points of
STL, PLY and OBJ files give what a table gives.
"""
import json
import math
import pathlib
import random
import struct
import subprocess
import sys
import tempfile


def franke(x, y):
    return (0.75 * math.exp(-((9 * x - 2) ** 2 + (9 * y - 2) ** 2) / 4)
            + 0.75 * math.exp(-((9 * x + 1) ** 2) / 49 - (9 * y + 1) / 10)
            + 0.5 * math.exp(-((9 * x - 7) ** 2 + (9 * y - 3) ** 2) / 4)
            - 0.2 * math.exp(-((9 * x - 4) ** 2) - (9 * y - 7) ** 2))


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


def slopes(degree, knots, u, order):
    """As `basis`, of derivatives: of each B-spline as a spline whose control points are 0 and 1."""
    first, _ = basis(degree, knots, u)
    out = []
    for one in range(degree + 1):
        net = [1.0 if i == first + one else 0.0 for i in range(len(knots) - degree - 1)]
        own, d = list(knots), degree
        for _ in range(order):
            net = [d * (net[i + 1] - net[i]) / (own[i + d + 1] - own[i + 1]) if own[i + d + 1] > own[i + 1] else 0.0
                   for i in range(len(net) - 1)]
            own, d = own[1:-1], d - 1
        start, values = basis(d, own, u)
        out.append(sum(w * net[start + i] for i, w in enumerate(values)))
    return first, out


def dot(a, b):
    return sum(p * q for p, q in zip(a, b))


class Surface:
    def __init__(self, patch):
        self.ku, self.kv, self.net = patch["knots_u"], patch["knots_v"], patch["points"]
        assert patch["degree_u"] == patch["degree_v"] == 3
        self.nu, self.nv = len(self.ku) - 4, len(self.kv) - 4
        assert len(self.net) == self.nu * self.nv
        corner, right, top = self.net[0], self.net[self.nu - 1], self.net[-self.nu]
        self.corner = corner
        self.up = None
        self.sides = [[q - p for p, q in zip(corner, other)] for other in (right, top)]

    def over(self, up):
        """Parameters are linear in the plane across `up`."""
        self.up = up
        self.sides = [[s - dot(side, up) * n for s, n in zip(side, up)] for side in self.sides]
        self.width, self.depth = (math.sqrt(dot(s, s)) for s in self.sides)
        self.heights = [dot([q - p for p, q in zip(self.corner, point)], up) for point in self.net]
        for j in range(self.nv):  # the net stands over Greville's places
            for i in range(self.nu):
                at = (sum(self.ku[i + 1:i + 4]) / 3, sum(self.kv[j + 1:j + 4]) / 3)
                gap = [q - p for p, q in zip(self.corner, self.net[j * self.nu + i])]
                for share, side in zip(at, self.sides):
                    assert abs(dot(gap, side) / dot(side, side) - share) < 1e-9, (i, j)

    def place(self, point):
        gap = [q - p for p, q in zip(self.corner, point)]
        u, v = (min(1.0, max(0.0, dot(gap, side) / dot(side, side))) for side in self.sides)
        return u, v, dot(gap, self.up)

    def off(self, point):
        u, v, height = self.place(point)
        i0, a = basis(3, self.ku, u)
        j0, b = basis(3, self.kv, v)
        there = sum(q * sum(p * self.heights[(j0 + j) * self.nu + i0 + i] for i, p in enumerate(a))
                    for j, q in enumerate(b))
        return height - there

    def plate(self):
        """Places of Gauss of every span: shares of the integral, B-splines' second derivatives."""
        nodes = [(-math.sqrt(3 / 7 + s * 2 / 7 * math.sqrt(6 / 5)), (18 - s * math.sqrt(30)) / 36) for s in (1, -1)]
        nodes += [(-x, w) for x, w in nodes]

        def lines(knots, length):
            own = sorted(set(knots))
            for a, b in zip(own, own[1:]):
                for x, w in nodes:
                    u = (a + b) / 2 + x * (b - a) / 2
                    first, values = basis(3, knots, u)
                    yield (first, w * (b - a) / 2 * length, values, [s / length for s in slopes(3, knots, u, 1)[1]],
                           [s / length ** 2 for s in slopes(3, knots, u, 2)[1]])
        rows = list(lines(self.kv, self.depth))
        for i0, wu, a, da, dda in lines(self.ku, self.width):
            for j0, wv, b, db, ddb in rows:
                yield i0, j0, wu * wv, (a, da, dda), (b, db, ddb)

    def bending_and_gradient(self):
        energy, gradient = 0.0, [0.0] * len(self.net)
        for i0, j0, share, u, v in self.plate():
            for times, r, s in ((1.0, 2, 0), (2.0, 1, 1), (1.0, 0, 2)):
                value = sum(v[s][j] * sum(u[r][i] * self.heights[(j0 + j) * self.nu + i0 + i] for i in range(4))
                            for j in range(4))
                energy += times * share * value * value
                for j in range(4):
                    for i in range(4):
                        gradient[(j0 + j) * self.nu + i0 + i] += times * share * value * u[r][i] * v[s][j]
        return energy, gradient


def made(program, folder, file, *options, fails=False):
    out = pathlib.Path(folder) / "out.json"
    done = subprocess.run([program, "surface", "scatter", str(file), *options, "--json", "-o", str(out)],
                          capture_output=True, text=True, check=False)
    if fails:
        assert done.returncode == 4 and not out.exists(), done
        return done.stderr
    assert done.returncode == 0, done.stderr
    report, patches = json.loads(done.stdout), json.loads(out.read_text())["patches"]
    out.unlink()
    assert len(patches) == 1
    surface = Surface(patches[0])
    surface.over(report["scatter"]["up"])
    return report, surface


def judge(points, report, surface, tolerance, left_out=()):
    said = report["scatter"]
    used = [k for k in range(len(points)) if k not in left_out]
    off = [surface.off(points[k]) for k in used]
    size = max(math.sqrt(dot(p, p)) for p in points)
    worst = max(abs(d) for d in off)
    assert worst <= tolerance, (worst, tolerance)
    near = 1e-12 * size
    assert abs(worst - said["deviation"]) <= 1e-6 * worst + near, (worst, said)
    assert abs(abs(surface.off(points[said["farthest"] - 1])) - worst) <= 1e-6 * worst + near
    mean = math.sqrt(sum(d * d for d in off) / len(off))
    assert abs(mean - said["root_mean_square"]) <= 1e-6 * mean + near
    assert said["points"] == len(used)
    energy, gradient = surface.bending_and_gradient()
    assert abs(energy - said["bending"]) <= 1e-6 * energy + 1e-18, (energy, said["bending"])
    whole, parts = [said["weight"] * g for g in gradient], [0.0] * len(gradient)
    for k, d in zip(used, off):
        u, v, _ = surface.place(points[k])
        i0, a = basis(3, surface.ku, u)
        j0, b = basis(3, surface.kv, v)
        for j in range(4):
            for i in range(4):
                at = (j0 + j) * surface.nu + i0 + i
                whole[at] -= d * a[i] * b[j]
                parts[at] += abs(d) * a[i] * b[j]
    largest = max(max(parts), max(abs(said["weight"] * g) for g in gradient))
    assert max(abs(g) for g in whole) <= 1e-6 * largest + near, (max(abs(g) for g in whole), largest)


def write(file, points):
    file.write_text("x,y,z\n" + "".join(",".join(repr(c) for c in p) + "\n" for p in points))


def main():
    program = sys.argv[1]
    rng = random.Random(1)
    places = [(rng.random(), rng.random()) for _ in range(600)]
    judged = 0
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        table = folder / "points.csv"

        def both(points, tolerance, *options, left_out=()):
            nonlocal judged
            write(table, points)
            report, surface = made(program, folder, table, "--tolerance", repr(tolerance), *options)
            judge(points, report, surface, tolerance, left_out)
            judged += 1
            return report, surface

        # closed forms: a plane, a quadratic, Franke's function
        plane = [(x, y, 2 - 3 * x + 0.4 * y) for x, y in places]
        report, _ = both(plane, 1e-3, "--up", "z")
        assert report["scatter"]["deviation"] < 1e-14 and report["scatter"]["bending"] < 1e-25
        report, _ = both(plane, 1e-3)  # its own plane: level there
        normal = [c / math.sqrt(9 + 0.16 + 1) for c in (3, -0.4, 1)]
        turned = abs(dot(report["scatter"]["up"], normal))
        assert abs(turned - 1) < 1e-12, turned
        report, surface = both([(x, y, x * x - x * y) for x, y in places], 1e-9, "--up", "z")
        assert surface.nu == surface.nv == 4
        hills = [(x, y, franke(x, y)) for x, y in places]
        for tolerance in (1e-2, 1e-3):
            report, surface = both(hills, tolerance, "--up", "z")
            between = max(abs(surface.off((x, y, franke(x, y)))) for x, y in
                          [(0.1 + 0.8 * rng.random(), 0.1 + 0.8 * rng.random()) for _ in range(300)])
            assert between < 0.05, between

        # turned, scaled and far away: the same surface
        a, b = 0.7, 0.4
        for scale, far in ((1.0, 0.0), (1e-3, 0.0), (1e3, 1e6)):
            moved = []
            for x, y, z in hills:
                p = (x * math.cos(a) - y * math.sin(a), x * math.sin(a) + y * math.cos(a), z)
                q = (p[0], p[1] * math.cos(b) - p[2] * math.sin(b), p[1] * math.sin(b) + p[2] * math.cos(b))
                moved.append(tuple(scale * c + far for c in q))
            up = f"0,{-math.sin(b)!r},{math.cos(b)!r}"
            write(table, moved)
            again, other = made(program, folder, table, "--tolerance", repr(1e-3 * scale), "--up", up)
            assert (other.nu, other.nv) == (surface.nu, surface.nv)
            assert abs(again["scatter"]["bending"] - report["scatter"]["bending"]) < 1e-3 * report["scatter"]["bending"]
            assert max(abs(other.off(p)) for p in moved) <= 1e-3 * scale
            judged += 1

        # outliers that were put in are named; left out when asked for
        wrong = {17: 1.5, 300: -2.0}
        spoilt = [(x, y, z + wrong.get(k, 0.0)) for k, (x, y, z) in enumerate(hills)]
        write(table, spoilt)
        text = made(program, folder, table, "--tolerance", "1e-3", "--up", "z", fails=True)
        assert "E408" in text and "2 found" in text, text
        report, _ = both(spoilt, 1e-3, "--up", "z", "--drop-outliers", left_out=set(wrong))
        assert [o["point"] - 1 for o in report["scatter"]["outliers"]] == sorted(wrong), report["scatter"]["outliers"]
        for o in report["scatter"]["outliers"]:
            assert abs(o["off"] - wrong[o["point"] - 1]) < 0.2, o
        report, _ = both(spoilt, 1e-2, "--up", "z", "--steepest", "89.9")
        assert len(report["scatter"]["outliers"]) == 2 and any("kept" in w for w in report["warnings"])

        # a hole: its middle and size, by a search of all points
        ring = [p for p in hills if math.hypot(p[0] - 0.5, p[1] - 0.55) > 0.3]
        report, surface = both(ring, 1e-2, "--up", "z")
        empty = report["scatter"]["without_data"]
        x, y, z = empty["place"]
        assert abs(min(math.hypot(p[0] - x, p[1] - y) for p in ring) - empty["farthest"]) < 1e-9
        assert abs(surface.off((x, y, z))) < 1e-9
        steps = 60
        share = sum(min(math.hypot(p[0] - i / steps, p[1] - j / steps) for p in ring) > empty["reach"]
                    for i in range(steps + 1) for j in range(steps + 1)) / (steps + 1) ** 2
        assert abs(share - empty["share"]) < 0.02, (share, empty)
        assert any("no points near" in w for w in report["warnings"])

        # files of meshes: points with and without triangles
        few = [tuple(struct.unpack("<3f", struct.pack("<3f", *p))) for p in hills[:99]]
        write(table, few)
        expected, _ = made(program, folder, table, "--tolerance", "0.01", "--up", "z")
        corners = [few[k:k + 3] for k in range(0, 99, 3)]
        (folder / "cloud.obj").write_text("".join("v {!r} {!r} {!r}\n".format(*p) for p in few))
        (folder / "cloud.ply").write_text("ply\nformat ascii 1.0\nelement vertex 99\nproperty double x\nproperty double y\n"
                                          "property double z\nend_header\n" + "".join("{!r} {!r} {!r}\n".format(*p) for p in few))
        (folder / "cloud.stl").write_bytes(bytes(80) + struct.pack("<I", 33) + b"".join(
            struct.pack("<12fH", 0, 0, 0, *(c for p in t for c in p), 0) for t in corners))
        for ending in ("obj", "ply", "stl"):
            found, _ = made(program, folder, folder / f"cloud.{ending}", "--tolerance", "0.01", "--up", "z")
            assert found["scatter"] == expected["scatter"], ending
            judged += 1
    print(f"{judged} surfaces judged")
    assert judged >= 14


if __name__ == "__main__":
    main()
