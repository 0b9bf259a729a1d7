# SPDX-License-Identifier: Apache-2.0
"""Runs cases with `obvid fit`, one process each, and holds every contour file against its
points."""
import concurrent.futures
import json
import pathlib
import re
import subprocess
import sys
import time

from . import geometry, judging, rounding

DOCUMENTED_CODES = (0, 3, 4, 5)
# Longest wait for one file; a file that takes longer counts as a hang.
SECONDS_AT_MOST = 300
# "a tolerance of 1.9e-06" or "about 1.9e-06 mm": what a refusal says the points would have to move.
NAMED_TOLERANCE = re.compile(r"(?:tolerance of|about) ([0-9.]+(?:e[-+]?\d+)?)")
SPARE = 1.05  # the number is printed with two digits
ERROR = re.compile(r"^obvid: error (E\d{3}): (.*)", re.M)


def moves_of(contour, tolerance):
    """Largest move in units of the tolerance of its point, and whether all are within it."""
    report, points = contour["report"], contour["points"]
    rounding = geometry.COORDINATE_ROUNDING * geometry.size_of(points)
    tolerances = contour.get("point_tolerance") or [tolerance] * len(points)
    moves = report.get("moves") or []
    honest = all(t <= tolerance * (1 + 1e-9) for t in tolerances)  # 1e-9: decimal text of both
    if not moves:  # interpolated exactly
        within = report["largest_move"] <= tolerance + rounding
        return {"move": 0.0, "moves_within": honest and within}
    ratios = [m / t for m, t in zip(moves, tolerances) if t > 0]
    return {"move": max(ratios, default=0.0),
            "moves_within": honest and len(moves) == len(tolerances) == len(points)
                            and all(m <= t + rounding for m, t in zip(moves, tolerances))}


def tolerance_of(case, points):
    """The tolerance that was asked for, or the rounding of the file's digits."""
    if case.tolerance is not None:
        return case.tolerance
    return rounding.printed_rounding(case.path.read_text(errors="replace"), points)


def figures(case, contour, judge, samples):
    report, tolerance = contour["report"], tolerance_of(case, contour["points"])
    found = {"points": len(contour["points"]), "pieces": len(contour["pieces"]),
             "raw": geometry.raw_extrema(contour["points"], contour["closed"]),
             "closed": contour["closed"], "vertices": report["vertices"],
             "bound": report["vertices_lower_bound"], "seconds": report["seconds"],
             "runs": len([r for r in contour["runs"] if r["direction"]]),
             "corners": contour["certificate"].get("corners", 0),
             "proved": contour["certificate"]["proved"], "tolerance": tolerance}
    found.update(moves_of(contour, tolerance))
    if judge:
        found.update(judging.judged(judge, contour, samples, tolerance))
    return found


def run_case(case, program, judge_folder, samples, work):
    """Runs one case; a dict of figures for tables and summary."""
    output = pathlib.Path(work) / "contours" / (case.group + "_" + case.name + ".json")
    output.parent.mkdir(parents=True, exist_ok=True)
    output.unlink(missing_ok=True)
    command = [program, "fit", str(case.path), *case.arguments, "-o", str(output), "--quiet"]
    outcome = {"name": case.name, "group": case.group, "tolerance": case.tolerance,
               "exit": None, "error": "", "text": "", "proved": False}
    start = time.perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, timeout=SECONDS_AT_MOST, check=False)
    except subprocess.TimeoutExpired:
        hang = {"exit": "hang", "process_seconds": SECONDS_AT_MOST}
        return {**outcome, **hang, **(case.compare(case.truth, None) if case.compare else {})}
    outcome["process_seconds"] = time.perf_counter() - start
    outcome["exit"] = done.returncode
    found = ERROR.search(done.stderr.decode(errors="replace"))
    if found:
        outcome["error"], outcome["text"] = found.groups()
    if done.returncode == 4:
        outcome["explanation_holds"] = explanation_holds(case, program, outcome["text"])
    contour = None
    if done.returncode in (0, 5) and output.exists():
        contour = json.loads(output.read_text(encoding="utf-8"))
        outcome.update(figures(case, contour, judging.load_judge(judge_folder), samples))
    if case.compare:
        outcome.update(case.compare(case.truth, contour))
    return outcome


def explanation_holds(case, program, text):
    """Whether a contour exists at the smallest tolerance that a refusal names, with a little to
    spare. None when it names no number. A series is refused truly when this is so."""
    named = NAMED_TOLERANCE.search(text)
    if not named:
        return None
    tolerance = float(named.group(1)) * SPARE
    arguments = list(case.arguments)
    if "--noise" in arguments:
        at = arguments.index("--noise")
        del arguments[at:at + 2]
    command = [program, "fit", str(case.path), *arguments, "--noise", repr(tolerance), "--quiet"]
    try:
        done = subprocess.run(command, capture_output=True, timeout=SECONDS_AT_MOST, check=False)
    except subprocess.TimeoutExpired:
        return False
    return done.returncode == 0


def run_cases(cases, options):
    """All outcomes in the order of the cases, with a line of progress on stderr."""
    outcomes, start = [], time.perf_counter()
    with concurrent.futures.ProcessPoolExecutor(options.jobs) as pool:
        pending = [pool.submit(run_case, case, options.program, options.judge, options.samples,
                               options.work) for case in cases]
        for done, future in enumerate(pending, 1):
            outcomes.append(future.result())
            if sys.stderr.isatty() or done % 100 == 0 or done == len(pending):
                print(f"\r{done} of {len(pending)}, {time.perf_counter() - start:.0f} s",
                      end="\n" if done == len(pending) else "", file=sys.stderr, flush=True)
    return outcomes
