#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""How `toolpath` goes down to its passes: helices and ramps, by a reader and a stock of the test's own.

usage: entries_test.py PROGRAM

The part is a bowl z = f(x, y), a polynomial that a bicubic grid holds exactly. Roughing has to go down into the stock
there: no way straight down meets any, no way is steeper than the angle or cuts deeper than a level, helices are
circles, and the counts are those of the program. Finishing: entries are nowhere deeper than the tolerance in the part,
begin as far over the pass as is said, and fall as the angle says, neither faster nor slower: over the bowl, and over a
plane and a cylinder whose resting tips are closed forms. Where there is no room for a ramp the program says how many
entries go straight down; where there is none for one of the angle, how steep it is, and where.
"""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
from roughing_test import Stock, along, depth_in, refused, rise  # noqa: E402

WIDE, DEEP, TOLERANCE, LEVEL = 40.0, 30.0, 0.02, 2.0
SCALE = 40.0


def height(x, y):
    return ((x - 20.0) ** 2 + (y - 15.0) ** 2) / SCALE


def normal(x, y):
    dx, dy = -2.0 * (x - 20.0) / SCALE, -2.0 * (y - 15.0) / SCALE
    size = np.sqrt(1.0 + dx * dx + dy * dy)
    return np.stack([dx / size, dy / size, 1.0 / size], axis=-1)


def grid_text():
    return "\n".join("".join(f"{x:.17g} {y:.17g} {height(x, y):.17g}\n" for x in np.linspace(0.0, WIDE, 9))
                     for y in np.linspace(0.0, DEEP, 7))


def moves_of(text):
    """(code, feed, from, to) of every motion."""
    at, code, feed, moves = [None] * 3, None, None, []
    for line in text.splitlines():
        ends = list(at)
        for letter, value in re.findall(r"([A-Z])(-?[0-9.]+)", re.sub(r"\(.*?\)|;.*", "", line)):
            if letter == "G" and value in ("0", "1"):
                code = int(value)
            assert not (letter == "G" and value in ("2", "3", "91")), line
            if letter == "F":
                feed = float(value)
            if letter in "XYZ":
                ends["XYZ".index(letter)] = float(value)
        if ends != at:
            if None not in at:
                moves.append((code, feed, np.array(at), np.array(ends)))
            at = ends
    return moves


def entries_of(moves, plunge):
    """Of each way down: what follows the straight part at the plunge feed."""
    found, now, safe = [], None, max(b[2] for _, _, _, b in moves)
    for code, feed, a, b in moves:
        if code == 0:
            now = None
        elif feed == plunge and now is None:
            straight = a[0] == b[0] and a[1] == b[1]
            assert straight or a[2] == safe, "the first way down is straight, or begins at the safe height"
            now = [] if straight else [(a, b)]
            found.append((b if straight else a, now))
        elif feed == plunge:
            now.append((a, b))
        else:
            now = now if now is not None else []
    return found


def kind(ways):
    """Helices never turn back."""
    if not ways:
        return "straight"
    level = [(b - a)[:2] for a, b in ways if np.hypot(*(b - a)[:2]) > 1e-6]
    turns = [abs(math.atan2(p[0] * q[1] - p[1] * q[0], p @ q)) for p, q in zip(level, level[1:])]
    return "ramped" if max(turns, default=math.pi) > 2.0 else "helical"


def program(binary, folder, *options, code=0, part="part.json"):
    out = subprocess.run([binary, "toolpath", part, "--tolerance", str(TOLERANCE), "--motion", "lines", "-o",
                          "part.nc", "--json", "--plunge-feed", "321", *map(str, options)], cwd=folder,
                         capture_output=True, text=True)
    assert out.returncode == code, (options, out.returncode, out.stderr)
    return json.loads(out.stdout), (folder / "part.nc").read_text(), out.stderr


def counted(report, entries):
    kinds = [kind(ways) for _, ways in entries]
    found = {name: kinds.count(name) for name in ("helical", "ramped", "straight")}
    told = dict(report["entries"])
    steepest, place = told.pop("steepest"), told.pop("steepest_place")
    told.pop("asked")
    assert (place is None) == (steepest == 0.0), (steepest, place)
    assert found == told, (found, told)
    # coordinates are printed to 0.001 mm: ways of 0.2 mm tell an angle to 0.6 degrees
    long = [(a - b, np.hypot(*(b - a)[:2])) for _, ways in entries for a, b in ways if np.hypot(*(b - a)[:2]) > 0.2]
    seen = max((math.degrees(math.atan2(way[2], level)) for way, level in long), default=0.0)
    assert seen <= steepest + 0.6, (seen, steepest)
    # nor is a steeper one told than the printed places allow: blocks lie off the way by a share of the tolerance
    most = max((math.degrees(math.atan2(a[2] - b[2] + TOLERANCE, max(1e-9, np.hypot(*(b - a)[:2]) - TOLERANCE)))
                for _, ways in entries for a, b in ways), default=0.0)
    assert steepest <= most, (steepest, most)
    assert (steepest > 0.0) == (found["helical"] + found["ramped"] > 0), (steepest, found)
    return found


def check_rough(binary, folder, cutter, diameter, corner, angle, entry, ramp, *more):
    name = " ".join([f"rough, {cutter} D{diameter:g} at {angle}, {entry}", *more])
    more = [*more, *(["--corner-radius", corner] if cutter == "bull" else [])]
    report, text, _ = program(binary, folder, "--strategy", "rough", "--cutter", cutter, "--diameter", diameter, *more,
                              "--angle", angle, "--step-down", LEVEL, "--allowance", 0.3, "--entry", entry, "--ramp", ramp)
    radius, moves = 0.5 * diameter, moves_of(text)
    low, high = np.array([-0.3, -0.3, 0.0]), np.array([WIDE + 0.3, DEEP + 0.3, height(0.0, 0.0) + 0.3])
    stock = Stock(low, high, 0.2, radius, corner)
    deepest, on_helix, tips, steepest = 0.0, 0.0, [], 0.0
    ways = {(tuple(a), tuple(b)) for _, w in entries_of(moves, 321.0) if kind(w) == "helical" for a, b in w}
    for code, _, a, b in moves:
        if code == 0:
            continue
        flat = math.hypot(b[0] - a[0], b[1] - a[1])
        steep = b[2] < a[2] - 1e-9 and a[2] - b[2] > math.tan(math.radians(ramp + 0.01)) * flat + 2e-3
        way = along(a, b, 0.2)
        over = max(stock.cut(tip) for tip in way)
        assert not steep or over <= 0.01, f"{name}: {over} mm of stock under a way down from {a} to {b}"
        deepest = max(deepest, over)
        if (tuple(a), tuple(b)) in ways:
            on_helix = max(on_helix, over)
        tips.append(way)
        if not steep and b[2] < a[2]:
            steepest = max(steepest, math.degrees(math.atan2(a[2] - b[2], flat)))
    assert deepest <= LEVEL + 0.02, f"{name}: a way cuts {deepest}"
    xs, ys = np.meshgrid(np.arange(0.0, WIDE + 1e-9, 0.5), np.arange(0.0, DEEP + 1e-9, 0.5))
    x, y = xs.ravel(), ys.ravel()
    points = np.stack([x, y, height(x, y)], axis=-1) + 0.3 * normal(x, y)
    gouge = depth_in(radius, corner, np.concatenate(tips), points).max()
    assert gouge <= TOLERANCE, f"{name}: {gouge} into the allowance"
    entries = entries_of(moves, 321.0)
    found = counted(report, entries)
    assert report["entries"]["steepest"] <= ramp + 1e-6, "over level passes ramps are as steep as asked for at most"
    for _, ways_down in entries:
        if kind(ways_down) != "helical":
            continue
        places = np.array([a for a, _ in ways_down])
        ring = places[:, :2]
        middle = 0.5 * (ring.min(axis=0) + ring.max(axis=0))
        radii = np.hypot(*(ring - middle).T)
        assert radii.max() - radii.min() < 0.03 * radius and radii.max() < radius, (name, radii.min(), radii.max())
    print(f"{name}: {found}, {report['narrow_stretches']} stretches left out, at most {steepest:.2f} degrees, cuts "
          f"{deepest:.2f} deep, {on_helix:.2f} on helices, {gouge:.4f} into the allowance")
    return found


def rests(radius, corner, places):
    """Height of the resting tip, by places of the part 0.1 apart; the part has borders."""
    steps = np.arange(-radius, radius + 1e-9, 0.1)
    dx, dy = np.meshgrid(steps, steps)
    near = np.hypot(dx, dy) <= radius
    x = np.clip(places[:, :1] + dx[near], 0.0, WIDE)
    y = np.clip(places[:, 1:2] + dy[near], 0.0, DEEP)
    level = np.hypot(x - places[:, :1], y - places[:, 1:2])
    lift = np.where(level <= radius, rise(radius, corner, np.minimum(radius, level)), np.inf)
    tops = height(x, y) - lift
    best = tops.argmax(axis=1)
    rows = np.arange(len(places))
    return tops[rows, best], level[rows, best] < 0.9 * radius  # beyond it hangs at the border like at a wall


def check_finish(binary, folder, cutter, diameter, corner, strategy, entry, over, ramp):
    name = f"{strategy}, {cutter} D{diameter:g}, {entry}"
    more = ["--corner-radius", corner] if cutter == "bull" else []
    options = [*more, "--cutter", cutter, "--diameter", diameter, "--strategy", strategy, "--scallop", 0.2,
               *(["--one-way"] if strategy == "zigzag" else [])]
    asked = ["--ramp", ramp, "--ramp-height", over, *(["--entry", entry] if entry == "helix" else [])]
    code = 5 if strategy == "z-level" or cutter == "bull" else 0  # told: too flat, or narrower than the cutter
    report, text, _ = program(binary, folder, *options, *asked, code=code)
    radius, moves = 0.5 * diameter, moves_of(text)
    entries = entries_of(moves, 321.0)
    found = counted(report, entries)
    plain, _, _ = program(binary, folder, *options, code=code)
    assert plain["entries"] == {"helical": 0, "ramped": 0, "straight": len(entries), "asked": 0.0,
                                "steepest": 0.0, "steepest_place": None}, plain["entries"]
    tips = np.concatenate([along(a, b, 0.1) for _, ways in entries for a, b in ways])
    xs, ys = np.meshgrid(np.arange(0.0, WIDE + 1e-9, 0.4), np.arange(0.0, DEEP + 1e-9, 0.4))
    points = np.stack([xs.ravel(), ys.ravel(), height(xs.ravel(), ys.ravel())], axis=-1)
    gouge = depth_in(radius, corner, tips, points).max()
    assert gouge <= TOLERANCE, f"{name}: {gouge} into the part"
    steepest, flattest, judged = 0.0, 90.0, 0
    for _, ways in entries:
        if not ways:
            continue
        places = np.array([a for a, _ in ways] + [ways[-1][1]])
        end = places[-1]
        rest, sure = rests(radius, corner, places)
        rest = np.maximum(rest, end[2])
        lift = places[:, 2] - rest
        begins = places[0, 2] - end[2]
        assert np.allclose(places[0, :2], end[:2]) and begins <= over + 2e-3, name
        assert begins > over - 2e-3 or places[0, 2] > report["safe_z"] - 2e-3, f"{name}: begins {begins} over it"
        for k, told in ((0, begins), (-1, 0.0)):
            assert not sure[k] or abs(lift[k] - told) < 0.03, f"{name}: {lift[k]} over the rest at {places[k]}"
        gone = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(places[:, :2], axis=0).T))])
        judged += int(sure.sum())
        # blocks lie off the exact way by a share of the tolerance, the reference by its raster
        falling = sure & (gone > 1.0) & (places[:, 2] < report["safe_z"] - 2e-3)
        fast = (begins - lift - 0.03)[falling] / gone[falling]
        steepest = max(steepest, math.degrees(math.atan(fast.max(initial=0.0))))
        assert places[:, 2].max() < report["safe_z"] + 2e-3, f"{name}: {places[:, 2].max()} is over the safe height"
        if kind(ways) == "ramped":  # helices have whole turns, and are flatter by what is left of one
            flattest = min(flattest, math.degrees(math.atan(begins / gone[-1])))
    assert steepest <= ramp, f"{name}: {steepest} degrees"
    assert flattest > 0.99 * ramp, f"{name}: {flattest} degrees"
    print(f"{name}: {found}, falls by {steepest:.2f} degrees over the resting tip, {gouge:.4f} into the part")
    return found, judged


def check_slope(binary, folder):
    """Over parts whose resting tip is a closed form ways down have the angle that is asked for, neither more nor less:
    a plane that rises by a half (passes up and down it, and level ones), and a cylinder of radius 30. They begin as far
    over the pass as is asked for, fall evenly to its beginning, and lie over the part all the way."""
    slope, over, degrees, radius = 0.5, 2.0, 10.0, 3.0
    fall = math.tan(math.radians(degrees))
    shapes = {"slope": (lambda x: slope * x, lambda x: slope * x + radius * (math.sqrt(1.0 + slope * slope) - 1.0), 9),
              "cylinder": (lambda x: np.sqrt(900.0 - (x - 20.0) ** 2),
                           lambda x: np.sqrt((30.0 + radius) ** 2 - (x - 20.0) ** 2) - radius, 161)}
    for name, (shape, rests_at, count) in shapes.items():
        (folder / f"{name}.txt").write_text("\n".join("".join(f"{x} {y} {shape(x)}\n" for x in np.linspace(0.0, 40.0, count))
                                                      for y in range(0, 31, 5)))
        subprocess.run([binary, "surface", "grid", f"{name}.txt", "--spread", "uniform", "--units", "mm", "-o",
                        f"{name}.json", "-q"], cwd=folder, check=True)
        for entry, angle in ((e, a) for e in ("ramp", "helix") for a in (0, 90, 180)):
            report, text, said = program(binary, folder, "--cutter", "ball", "--diameter", 2 * radius, "--scallop", 0.2,
                                         "--one-way", "--angle", angle, "--entry", entry, "--ramp", degrees,
                                         "--ramp-height", over, part=f"{name}.json")
            entries, case = entries_of(moves_of(text), 321.0), (name, entry, angle)
            assert counted(report, entries)["straight"] == 0, case
            told = report["entries"]
            assert told["asked"] == degrees and told["steepest"] < degrees + 1e-3, (case, told)
            assert "degrees against the level" not in said, said
            for place, ways in entries:
                ends = np.array([place] + [b for _, b in ways])
                gone = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(ends[:, :2], axis=0).T))])
                begins = ends[0, 2] - ends[-1, 2]
                assert abs(begins - min(over, report["safe_z"] - ends[-1, 2])) < 2e-3, (case, ends[0], ends[-1])
                due = ends[-1, 2] + begins * (1.0 - gone / gone[-1])
                # evenly over the beginning of the pass, or over the tip's rest where the part rises above that
                over_rest = due + np.maximum(rests_at(np.clip(ends[:, 0], 0.0, 40.0)) - ends[-1, 2], 0.0)
                assert (due - ends[:, 2]).max() < 0.012, (case, (due - ends[:, 2]).max())
                assert (ends[:, 2] - over_rest).max() < 0.012, (case, (ends[:, 2] - over_rest).max())
                mean = begins / gone[-1]
                turns = round(gone[-1] / (2.0 * math.pi * 0.9 * radius)) if entry == "helix" else math.inf
                assert mean < 1.005 * fall, (case, mean, fall)
                assert mean > 0.99 * fall * (1.0 - 1.0 / turns), (case, mean, fall, turns)
                inner = (ends[:, 0] > radius) & (ends[:, 0] < 40.0 - radius) & (ends[:, 1] > 0.0) & (ends[:, 1] < 30.0)
                lift = ends[inner, 2] - rests_at(ends[inner, 0])
                assert lift.min(initial=0.0) > -TOLERANCE, (case, lift)
    # so flat that 40 ways of a diameter beside the pass are too few for it: as flat as 40 are, and that is said
    degrees = 0.5
    report, text, said = program(binary, folder, "--cutter", "ball", "--diameter", 6, "--scallop", 0.2, "--one-way",
                                 "--ramp", degrees, "--ramp-height", 3, part="slope.json")
    told = report["entries"]
    flattest = math.degrees(math.atan(3 / (40 * 6)))
    assert abs(told["steepest"] - flattest) < 1e-3, (told, flattest)
    shown = float(re.search(r"at up to (\S+) degrees against the level", said)[1])
    assert told["steepest"] <= shown < told["steepest"] + 0.001 and "where 0.5 were" in said, said
    assert any("degrees against the level" in warning for warning in report["warnings"]), report["warnings"]
    x, y, z = told["steepest_place"]
    assert -6.0 <= x <= 46.0 and -6.0 <= y <= 36.0 and -3.0 <= z <= report["safe_z"], told
    assert counted(report, entries_of(moves_of(text), 321.0))["ramped"] > 0, told
    # stretches that end beside the stock are no narrow ones, though they are cut one way
    report, _, said = program(binary, folder, "--cutter", "ball", "--diameter", 6, "--strategy", "rough", "--one-way",
                              "--step-down", 2, "--allowance", 0.3, part="slope.json")
    assert report["narrow_stretches"] == 0 and "too short" not in said, said


def main():
    binary = str(pathlib.Path(sys.argv[1]).resolve())
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        (folder / "part.txt").write_text(grid_text())
        subprocess.run([binary, "surface", "grid", "part.txt", "--spread", "uniform", "--units", "mm", "-o",
                        "part.json", "-q"], cwd=folder, check=True)
        for cutter, diameter, corner, angle, ramp in (("flat", 4.0, 0.0, 0.0, 6.0), ("bull", 6.0, 1.5, 90.0, 3.0),
                                                      ("ball", 4.0, 2.0, 30.0, 10.0)):
            helix = check_rough(binary, folder, cutter, diameter, corner, angle, "helix", ramp)
            assert helix["helical"] > 0, helix
            if cutter == "flat":
                ramped = check_rough(binary, folder, cutter, diameter, corner, angle, "ramp", ramp)
                assert ramped["helical"] == 0 and sum(ramped.values()) == sum(helix.values()), (ramped, helix)
                check_rough(binary, folder, cutter, diameter, corner, angle, "ramp", ramp, "--one-way")
        judged = 0
        for cutter, diameter, corner, strategy, entry, over in (("ball", 6.0, 3.0, "zigzag", "helix", 4.0),
                                                                ("bull", 6.0, 1.5, "zigzag", "ramp", 1.5),
                                                                ("ball", 6.0, 3.0, "scallop", "helix", 1.5),
                                                                ("ball", 4.0, 2.0, "z-level", "helix", 1.5)):
            found, places = check_finish(binary, folder, cutter, diameter, corner, strategy, entry, over, 10.0)
            judged += places
            assert found["straight"] == 0 and (found["helical"] > 0) == (entry == "helix"), found
        assert judged > 300, judged
        check_slope(binary, folder)
        # a ramp that would take far more than 40 ways of a diameter has 40, and none goes straight down: it is said
        report, _, said = program(binary, folder, "--scallop", 0.1, "--one-way", "--ramp", 0.05, "--ramp-height", 3)
        told = report["entries"]
        assert told["straight"] == 0 and abs(told["steepest"] - math.degrees(math.atan(3 / (40 * 6)))) < 1e-3, told
        assert "at up to 0.717 degrees" in said and "where 0.05 were asked for" in said, said
        for wrong in (["--acceleration", "1e-300"], ["--ramp", "0"], ["--ramp", "90"], ["--entry", "spiral"], ["--ramp-height", "2"],
                      ["--ramp", "5", "--ramp-height", "0"], ["--strategy", "rough", "--ramp-height", "2"]):
            refused(binary, folder, *wrong)


if __name__ == "__main__":
    main()
