#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sections of meshes with `--cut`: what `analyse`, `fit` and `convert` take is where the plane cuts the body.

usage: mesh_sections_test.py PROGRAM

A torus about z and a tube along x are made here as STL (text and binary), PLY and OBJ. Distances from the torus are
those of its closed form; a triangle's edges lie inside it by no more than the sagitta of its chords.
"""
import json
import math
import pathlib
import struct
import subprocess
import sys
import tempfile

BIG, SMALL, AROUND, ACROSS = 40.0, 12.0, 180, 90


def torus():
    def at(i, j):
        u, v = 2 * math.pi * i / AROUND, 2 * math.pi * j / ACROSS
        r = BIG + SMALL * math.cos(v)
        return (r * math.cos(u), r * math.sin(u), SMALL * math.sin(v))

    points = [at(i, j) for i in range(AROUND) for j in range(ACROSS)]
    faces = []
    for i in range(AROUND):
        for j in range(ACROSS):
            a, b = i * ACROSS + j, (i + 1) % AROUND * ACROSS + j
            c, d = (i + 1) % AROUND * ACROSS + (j + 1) % ACROSS, i * ACROSS + (j + 1) % ACROSS
            faces += [(a, b, c), (a, c, d)]
    return points, faces


def written(folder, points, faces):
    """The same mesh in four files; all numbers as they are."""
    word = lambda p: " ".join(repr(c) for c in p)
    facet = lambda f: "facet normal 0 0 0\nouter loop\n%s\nendloop\nendfacet\n" % "\n".join(
        "vertex " + word(points[k]) for k in f)
    (folder / "text.stl").write_text("solid torus\n" + "".join(map(facet, faces)) + "endsolid torus\n")
    (folder / "binary.stl").write_bytes(b"\0" * 80 + struct.pack("<I", len(faces)) + b"".join(
        struct.pack("<12fH", 0, 0, 0, *points[a], *points[b], *points[c], 0) for a, b, c in faces))
    (folder / "t.ply").write_text(
        "ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\nproperty double z\n"
        "element face %d\nproperty list uchar int vertex_indices\nend_header\n" % (len(points), len(faces))
        + "".join(word(p) + "\n" for p in points) + "".join("3 %d %d %d\n" % f for f in faces))
    (folder / "t.obj").write_text("".join("v " + word(p) + "\n" for p in points)
                                  + "".join("f %d %d %d\n" % tuple(k + 1 for k in f) for f in faces))
    return [folder / name for name in ("text.stl", "binary.stl", "t.ply", "t.obj")]


def main():
    program = sys.argv[1]

    def run(*words):
        return subprocess.run([program, *map(str, words)], capture_output=True, text=True, timeout=120)

    def check(holds, what):
        if not holds:
            sys.exit(f"mesh sections: {what}")

    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        files = written(folder, *torus())
        z = 5.0
        half = math.sqrt(SMALL**2 - z**2)
        radii = (BIG + half, BIG - half)
        sagitta = (BIG + SMALL) * (1 - math.cos(math.pi / AROUND)) + SMALL * (1 - math.cos(math.pi / ACROSS))
        slope = SMALL / half  # how much faster a circle of the section moves than the torus
        off = slope * sagitta
        for file in files:
            done = run("analyse", file, "--cut", f"z={z}", "--json", "-q")
            check(done.returncode == 0, f"analyse {file.name}: {done.stderr}")
            report = json.loads(done.stdout)
            series = report["series"]
            check([s["label"] for s in series] == [f"z={z:g}/1", f"z={z:g}/2"], f"{file.name}: names {series}")
            for s, radius in zip(series, radii):
                check(s["closed"], f"{file.name}: a section is open")
                check(abs(s["length"] / (2 * math.pi * radius) - 1) < off / radius + 1e-3,
                      f"{file.name}: length {s['length']} of radius {radius}")
        # contours through the points keep to both circles
        for k, radius in enumerate(radii):
            out = folder / f"ring{k}.csv"
            done = run("fit", files[2], "--cut", f"z={z}", "--curve", k + 1, "--noise", "0.02", "-q",
                       "-o", folder / f"ring{k}.json", "-o", out)
            check(done.returncode == 0, f"fit of ring {k}: {done.stderr}")
            rows = [line.split(",") for line in out.read_text().splitlines()]
            at = {column.split()[0]: i for i, column in enumerate(next(r for r in rows if "x" in [c.split()[0] for c in r if c]))}
            values = [r for r in rows if r[0].replace(".", "", 1).replace("-", "", 1).replace("e", "", 1)[:1].isdigit()]
            check(len(values) > 50, f"ring {k}: {len(values)} samples")
            for row in values:
                miss = math.hypot(float(row[at["x"]]), float(row[at["y"]])) - radius
                check(abs(miss) < off + 0.03, f"ring {k}: {miss} off its circle, {off} expected")
        # every format has the same curves, and all of them at once are two
        texts = {run("fit", f, "--cut", "z=5", "--curve", "1", "--noise", "0.02", "--csv", "-q").stdout
                 for f in files if f.name != "binary.stl"}  # floats there
        check(len(texts) == 1 and "" not in texts, "formats differ")
        done = run("fit", files[3], "--cut", "z=5", "--curve", "all", "--noise", "0.02", "--csv")
        check(done.returncode == 0 and len(done.stdout.splitlines()) >= 3, f"all: {done.stdout}{done.stderr}")
        # planes across x and y: two discs each; coordinates are told
        for axis, told in (("x", "y and z"), ("y", "z and x")):
            done = run("analyse", files[0], "--cut", f"{axis}=-1:2:1", "--json", "-q")
            series = json.loads(done.stdout)["series"]
            check(len(series) == 4, f"{axis}: {len(series)} sections")
            check(told in done.stderr, f"{axis}: {done.stderr}")
            for s in series:
                check(abs(s["length"] - 2 * math.pi * SMALL) < 0.5, f"{axis}: length {s['length']}")
        # what cannot be
        for words, code in (((files[0],), "E311"), ((files[0], "--cut", "z=13"), "E311"),
                            ((files[0], "--cut", "w=1"), "E203"), ((files[0], "--cut", "z=5:0:1"), "E203")):
            for command in ("fit", "analyse"):
                done = run(command, *words)
                check(done.returncode not in (0, None) and code in done.stderr, f"{command} {words}: {done.stderr}")
        check("z = -11.99" in run("fit", files[0]).stderr, "the box of the mesh is not told")
        (folder / "p.csv").write_text("x,y\n0,0\n1,0.1\n2,0.4\n3,0.9\n")
        check("E203" in run("fit", folder / "p.csv", "--cut", "z=1").stderr, "points are no mesh")
        (folder / "half.stl").write_bytes(files[1].read_bytes()[:-20])
        done = run("fit", folder / "half.stl", "--cut", "z=1")
        check(done.returncode not in (0, None) and "error E" in done.stderr, f"damaged: {done.stderr}")
    print("mesh sections: 4 formats, 2 circles, planes across three axes")


if __name__ == "__main__":
    main()
