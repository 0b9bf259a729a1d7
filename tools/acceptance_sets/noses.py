# SPDX-License-Identifier: Apache-2.0
"""Noses of public airfoils: corners, and curvature that turns back more than once, within 1 % of the
chord of the leading edge; with the rounding of the printed digits as tolerance, and with 1e-4
chords. Counted by `obvid analyse` of the contour files, which audits their pieces anew."""
import concurrent.futures
import json
import math
import pathlib
import subprocess

from . import airfoils, running, tables

REACH = 0.01  # chords
FAIR = 1e-4   # chords, the larger tolerance
FAIR_NOSES = 98  # % of the airfoils that shall have a fair nose with it


def cases(data, work, options):
    return airfoils.cases(data, work, options)


def leading_edge(points):
    """The point farthest from the middle of both ends, and how far that is."""
    (ax, ay), (bx, by) = points[0], points[-1]
    edge = (0.5 * (ax + bx), 0.5 * (ay + by))
    nose = max(points, key=lambda p: math.dist(p, edge))
    return nose, math.dist(nose, edge)


def nose_of(program, path, noise, output):
    """Exit code, corners and vertices near the nose, chord."""
    done = subprocess.run([program, "fit", str(path), "--noise", noise, "--open", "-o", str(output),
                           "--quiet"], capture_output=True, timeout=running.SECONDS_AT_MOST,
                          check=False)
    found = running.ERROR.search(done.stderr.decode(errors="replace"))
    out = {"exit": done.returncode, "error": found.group(1) if found else "", "corners": 0,
           "turns": 0, "chord": None}
    if done.returncode not in (0, 5):
        return out
    nose, out["chord"] = leading_edge(json.loads(output.read_text())["points"])
    told = subprocess.run([program, "analyse", str(output), "--json"], capture_output=True,
                          text=True, timeout=running.SECONDS_AT_MOST, check=True)
    (curve,) = json.loads(told.stdout)["curves"]
    for place in curve["places"]:
        if math.dist((place["x"], place["y"]), nose) > REACH * out["chord"]:
            continue
        out["corners"] += place["kind"] == "corner"
        out["turns"] += place["kind"] == "vertex"
    return out


def is_fair(nose):
    return nose["corners"] == 0 and nose["turns"] <= 1


def run_case(case, program, work):
    output = pathlib.Path(work) / "noses" / f"{case.group}_{case.name}.json"
    output.parent.mkdir(parents=True, exist_ok=True)
    close = nose_of(program, case.path, "rounding", output)
    wide = close
    if close["chord"]:
        wide = nose_of(program, case.path, repr(FAIR * close["chord"]), output)
    return {"name": case.name, "group": case.group, "exit": close["exit"], "error": close["error"],
            "close": close, "wide": wide}


def run(cases_, options):
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        pending = [pool.submit(run_case, case, options.program, options.work) for case in cases_]
        return [one.result() for one in pending]


def summary(outcomes):
    rows = []
    for name, group in [*tables.groups_of(outcomes).items(), ("all", outcomes)]:
        fitted = [o for o in group if o["close"]["chord"] and o["wide"]["chord"]]
        bad = [o for o in fitted if not is_fair(o["close"])]
        rows.append([name, len(group), len(fitted),
                     sum(o["close"]["corners"] > 0 for o in fitted),
                     sum(o["close"]["turns"] > 1 for o in fitted),
                     len(bad), sum(is_fair(o["wide"]) for o in bad),
                     sum(not is_fair(o["wide"]) for o in fitted)])
    return tables.markdown(["set", "files", "formed with both", "corner at the nose",
                            "turns back more than once", "either", "of these fair with 1e-4 chords",
                            "not fair with 1e-4 chords"], rows)


def criteria(outcomes):
    fitted = [o for o in outcomes if o["close"]["chord"] and o["wide"]["chord"]]
    fair = tables.percent(is_fair(o["wide"]) for o in fitted)
    corners = sum(o["wide"]["corners"] > 0 for o in fitted)
    return [(f"fair noses with a tolerance of 1e-4 chords, at least {FAIR_NOSES} %", f"{fair:.1f} %",
             fair >= FAIR_NOSES),
            ("corners at noses with that tolerance", corners, corners == 0)]
