#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""What `surface check --against` says, held against closed forms: points and tubes about one axis.

usage: surface_against_test.py PROGRAM
"""
import json
import math
import pathlib
import random
import re
import subprocess
import sys
import tempfile

PROGRAM = None
RADIUS, HEIGHT = 3.0, 5.0


def run(*words, code=0):
    done = subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False)
    assert done.returncode == code, (words, done.returncode, done.stdout, done.stderr)
    return done


def near(found, expected, tolerance, what):
    assert abs(found - expected) <= tolerance, (what, found, expected)


def tube(folder, name, radius, *options):
    profile = folder / f"{name}.csv"
    profile.write_text(f"x,y,z\n{radius},0,0\n{radius},0,{HEIGHT}\n")
    out = folder / f"{name}.json"
    run("surface", "revolve", profile, "--axis", "z", *options, "-o", out, "--quiet")
    return out


def scattered(count, seed):
    """Points about the tube, and their distances from it; some lie above its upper border."""
    rng = random.Random(seed)
    rows, off, beside = [], [], 0
    for _ in range(count):
        angle, z = rng.uniform(0, 2 * math.pi), rng.uniform(0.1, 5.4)
        radius = RADIUS + rng.uniform(-0.02, 0.03)
        rows.append((radius * math.cos(angle), radius * math.sin(angle), z))
        above = max(z - HEIGHT, 0.0)
        off.append(math.copysign(math.hypot(radius - RADIUS, above), radius - RADIUS))
        beside += above > 0
    return rows, off, beside


def points_are_measured(folder, surface):
    rows, off, beside = scattered(5000, 5)
    cloud = folder / "scan.csv"
    cloud.write_text("x,y,z\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in rows))
    ply = folder / "scan.ply"
    ply.write_text("ply\nformat ascii 1.0\nelement vertex %d\nproperty double x\nproperty double y\n"
                   "property double z\nend_header\n" % len(rows)
                   + "".join(f"{x!r} {y!r} {z!r}\n" for x, y, z in rows))
    for file in (cloud, ply):
        told = json.loads(run("surface", "check", surface, "--against", file, "--json").stdout)["deviation"]
        assert told["of"] == "points" and "back" not in told, told
        found = told["found"]
        signed = off  # the normal points away from the axis
        assert found["places"] == len(rows)
        near(found["root_mean_square"], math.sqrt(sum(d * d for d in off) / len(off)), 1e-12, "rms")
        near(found["mean"], sum(signed) / len(off), 1e-12, "mean")
        near(found["beside"], beside / len(off), 1e-15, "beside")
        for name, which in (("least", min), ("most", max)):
            near(found[name]["off"], which(signed), 1e-12, name)
            number = signed.index(which(signed))
            assert found[name]["point"] == number + 1, (name, number)
            for told_x, x in zip(found[name]["place"], rows[number]):
                near(told_x, x, 1e-15, name)
            nearest = found[name]["nearest"]
            near(math.hypot(nearest[0], nearest[1]), RADIUS, 1e-12, "nearest")
    text = run("surface", "check", surface, "--against", cloud).stdout
    assert "5000 points" in text and f"{100.0 * beside / len(off):.3g} % of the points lie beside" in text, text
    return cloud


def tubes_are_measured(folder, surface):
    wide = tube(folder, "wide", 3.25)
    told = json.loads(run("surface", "check", surface, "--against", wide, "--json").stdout)["deviation"]
    assert told["of"] == "surface"
    for way in ("found", "back"):
        found = told[way]
        near(found["largest"], 0.25, 1e-12, way)
        near(found["root_mean_square"], 0.25, 1e-12, way)
        near(abs(found["least"]["off"]), 0.25, 1e-12, way)
        near(found["beside"], 0.0, 0.0, way)
    assert told["found"]["most"]["off"] * told["back"]["most"]["off"] < 0
    # half a tube from the whole one: on it; the whole from the half: a quarter of a turn away
    half = tube(folder, "half", RADIUS, "--angle", "180")
    told = json.loads(run("surface", "check", half, "--against", surface, "--json").stdout)["deviation"]
    near(told["found"]["largest"], 0.0, 1e-12, "half")
    near(told["back"]["largest"], RADIUS * math.sqrt(2.0), 1e-6, "whole")
    near(told["back"]["beside"], 0.5, 0.02, "whole")


def pictures_show_it(folder, surface, cloud):
    svg, page = folder / "off.svg", folder / "off.html"
    run("surface", "check", surface, "--against", cloud, "-o", svg, "-o", page, "--quiet")
    text = svg.read_text()
    dots = re.findall(r'<circle [^>]*fill="(#[0-9a-f]{6})"', text)
    assert 500 < len(dots) <= 4000 and len(set(dots)) > 8, len(dots)
    assert "Points of" in text and "in all" in text
    header = json.loads(re.search(r'id="model">(.*?)</script>', page.read_text()).group(1))
    assert header["start"]["mode"] == "deviation" and header["dots"] == 5000 and not header["off"], header["start"]
    told = json.loads(run("surface", "check", surface, "--against", cloud, "--json").stdout)["deviation"]["found"]
    near(header["scales"]["deviation"]["least"], told["least"]["off"], 0.0, "page")
    near(header["scales"]["deviation"]["most"], told["most"]["off"], 0.0, "page")
    for look in ("isophotes", "reflection"):
        run("surface", "check", surface, "--colour", look, "-o", svg, "--quiet")
        assert text != svg.read_text()
        fills = set(re.findall(r'<path fill="(#[0-9a-f]{6})"', svg.read_text()))
        assert fills == {"#2b3440", "#eef1f4"}, (look, fills)


def what_does_not_fit_is_refused(folder, surface, cloud):
    for words, code, said in (
            (["--against", folder / "missing.csv"], 3, "missing.csv"),
            (["--colour", "deviation", "-o", folder / "x.svg"], 2, "--against"),
            (["--against", cloud, "-o", cloud], 2, ""),
            (["--meeting", "0"], 2, "--meeting")):
        done = run("surface", "check", surface, *words, code=code)
        assert said in done.stderr, done.stderr
    assert cloud.read_text().startswith("x,y,z")
    run("surface", "convert", surface, "--colour", "deviation", "-o", folder / "x.svg", code=2)
    inches = tube(folder, "inches", 3.0, "--units", "in")
    metres = tube(folder, "metres", 3.0, "--units", "m")
    done = run("surface", "check", inches, "--against", metres, code=3)
    assert "E310" in done.stderr, done.stderr


def main():
    global PROGRAM
    PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        surface = tube(folder, "tube", RADIUS)
        cloud = points_are_measured(folder, surface)
        tubes_are_measured(folder, surface)
        pictures_show_it(folder, surface, cloud)
        what_does_not_fit_is_refused(folder, surface, cloud)


if __name__ == "__main__":
    main()
