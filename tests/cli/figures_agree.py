#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every figure that two commands, or a text, a file and a picture, both print is the same figure.

usage: figures_agree.py PROGRAM DATA OWN [--every-file | --all] [--only TEXT] [--jobs N]

DATA   folder of public data sets; where it is not there only OWN is swept, and that is said
OWN    folders of files that come with the sources, separated by commas
--every-file  every file instead of a spread over them: spirals and one more carrier, which take turns
--all         every file, every option and every carrier

What is compared, for each series of points: table, JSON and contour file of `fit`; `verify` (table,
JSON), `analyse` (table, JSON, picture) and `convert` (files, picture) of that contour file; the
captions of the picture of `fit`; `compare` (table, JSON, CSV, picture) with `fit --carrier`; what
`fit`, `verify`, `analyse` and `compare` say of joints, of the verdict, and the exit codes of the first two;
`fit --suggest` (table, JSON, chart) with `fit --noise`; `analyse` of the points. For each drawing:
table, JSON and picture of `analyse`; for surfaces those of `surface check`. A number in a text is the number of the JSON when it is that,
rounded to the digits that are printed. Exit code 1: two of them differ, or nothing was compared.
"""
import argparse
import collections
import concurrent.futures
import csv
import html
import io
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import time

# (files, options of fit that do not move points, how many of them without --all)
SERIES = [
    ("airfoils_uiuc_selig/*.dat", [["--noise", "rounding"], []], 3),
    ("airfoils_aerosandbox/*.dat", [["--noise", "rounding"], []], 2),
    ("airfoils_other_formats/*", [["--noise", "rounding"]], 1),
    ("windturbine_iea15/*_Coords.txt", [["--noise", "rounding"], []], 1),
    ("rail_transition_curves/*.txt", [[]], 1),
    ("rail_wheel_profiles/*.dat", [["--noise", "0.001"]], 0),
    ("tracks_tum/*.csv", [["--closed"]], 1),
    ("published_series/*.csv", [[]], 3),
    ("paper_tables/*.csv", [[]], 1),
    ("hulls_grids/hand.dat", [["--noise", "0.01"]], 0),
    ("outlines_momocs/*/*.csv", [["--noise", "rounding"],
                                 ["--noise", "2", "--primitives"]], 1),
    ("gps_gpx/*.gpx", [["--noise", "5"]], 0),
    ("tracks_f1_geojson/*", [["--noise", "5"]], 1),
    ("found/bound/*.csv", [["--noise", "1e-3"]], 1),
    ("found/jumps/*.csv", [[]], 1),
]
DRAWINGS = [("cad_dxf/*", 3), ("cad_svg/*", 4), ("roads_opendrive/*.xodr", 1), ("landxml/*", 1)]
# Larger ones are left to --all: the test is for every day. Twice as large where a set has no such file.
SECONDS_BETWEEN_LINES = 60  # that tell how far a sweep is
BYTES_OF_A_SMALL_FILE = 2500
# kind, files (patterns that give one file each), options: sets of matrices belong together
SURFACES = [("skin", ["hulls_grids/Series60Offset_%s.dat"], []),
            ("grid", ["hulls_grids/TrawlerOffset_%s.dat"], []),
            ("skin", ["hulls_grids/wpb_offset_mid_%s.dat"], [])]
OWN_SURFACES = [("skin", ["surfaces/wigley_stations.csv"], []),
                ("grid", ["surfaces/wavy_grid.csv"], []),
                ("revolve", ["surfaces/vase_profile.csv"], []),
                ("ruled", ["surfaces/vase_profile.csv"], ["--apex", "0,50,90"])]
CARRIERS = re.findall(r"^OBVID_CARRIER\(k\w+, (\w+),", (pathlib.Path(__file__).resolve().parents[2] /
                      "include/obvid/curve/carriers.inc").read_text(encoding="utf-8"), re.MULTILINE)
NOT_MONOTONE = ["cubic", "baseline", "imported"]  # they promise no monotone curvature
CONTINUOUS = 1e-6  # rad, and of the curvature: gaps up to it are called none (docs/claims.md)
SECONDS_OF_A_RUN = 120
UNKNOWN = "-"
NO_BOUND = "no bound"
NUMBER = r"[-+−]?(?:\d+\.?\d*|\.\d+)(?:e[-+]?\d+)?"
# A text rounds once; a value halfway between two numbers may fall to either side.
HALF = 0.5 * (1 + 1e-6)

Run = collections.namedtuple("Run", "code out err")


def halfway(text):
    """Half a unit of the last digit of a printed number."""
    mantissa, _, power = text.lower().partition("e")
    decimals = len(mantissa.partition(".")[2])
    return HALF * 10.0 ** (int(power or 0) - decimals)


def same_number(text, value):
    """The printed text is the value, rounded; no number is printed for one that is not known."""
    if value is None:
        return text == UNKNOWN
    text = text.replace("−", "-")
    if not re.fullmatch(NUMBER, text):
        return False
    return abs(float(text) - value) <= halfway(text)


def plural(count, one, many):
    return f"{count} {one if count == 1 else many}"


def facts_of(text):
    """Lines "label  value" below the tables."""
    return dict(re.findall(r"^(\S.*?)  +(\S.*)$", text, re.M))


def keeps_circle(stored, circular, point):
    """Whether a contour is monotone along all points of a line or circle on which `point` begins a chord."""
    at = {e["source"]: k for k, e in enumerate(stored["elements"]) if "source" in e}
    for stretch in circular:
        first, last = stretch["first_point"], stretch["last_point"]
        if first <= point < last:
            kinds = {stored["certificate"]["monotone"][k]["verdict"] for k in range(at[first], at[last])}
            return len(kinds - {"constant"}) < 2
    return True


def labels_of(picture):
    """What is written in a picture, without the numbers of its axes; 3·10⁻⁶ becomes 3e-6."""
    raised = str.maketrans("⁰¹²³⁴⁵⁶⁷⁸⁹⁻−", "0123456789--")
    found = [html.unescape(re.sub(r"<[^>]*>", "", t)) for t in re.findall(
        r"<text[^>]*>(.*?)</text>", picture, re.S)]
    found = [re.sub(r"(·?)10([⁰¹²³⁴⁵⁶⁷⁸⁹⁻]+)",
                    lambda m: ("e" if m[1] else "1e") + m[2].translate(raised), t) for t in found]
    return [t for t in found if not re.fullmatch(NUMBER, t)]


def largest(values):
    known = [v for v in values if v is not None]
    return max(known) if known else None


def order_of(stored, corners):
    """What docs/claims.md calls the joints of a contour: 3, 2, 1, 0. `corners`: they count as well."""
    certificate, gaps = stored["certificate"], stored["certificate"]["joint_gaps"]
    within = [gaps[key] is not None and gaps[key] <= CONTINUOUS for key in ("heading", "curvature")]
    if not within[0] or (corners and certificate["corners"] > 0):
        return 0
    if not within[1] or certificate["curvature_steps"] > 0 or stored["carrier"] == "arcs":
        return 1
    smooth = stored.get("continuity") == "G3" and certificate["slope_steps"] == 0
    return 3 if smooth else 2


def verdict_of(stored):
    """In a word, as tables of carriers have it; what keeps its promise ends `fit` and `verify` with 0."""
    certificate = stored["certificate"]
    if certificate["proved"]:
        return "proved"
    kept = (stored["carrier"] in NOT_MONOTONE and certificate["gaps_within_bounds"]
            and certificate["through_points"])
    return "not monotone" if kept else "NOT proved"


def largest_kappa(curve):
    return max(abs(curve["least_kappa"]), abs(curve["largest_kappa"]))


class Subject:
    """One file with one set of options: runs commands in a folder and notes what disagrees."""

    def __init__(self, program, path, options, folder, thorough):
        self.program, self.path, self.options = program, path, options
        self.folder, self.thorough = folder, thorough
        self.faults, self.checks, self.runs = [], 0, 0

    def run(self, *args):
        self.runs += 1
        done = subprocess.run([self.program, *args], cwd=self.folder, capture_output=True,
                              timeout=SECONDS_OF_A_RUN)
        return Run(done.returncode, done.stdout.decode(), done.stderr.decode())

    def same(self, what, a, b):
        self.checks += 1
        if a != b:
            self.faults.append(f"{what}: {a!r} and {b!r}")

    def shows(self, what, text, value):
        self.checks += 1
        if text is None or not same_number(text, value):
            self.faults.append(f"{what}: printed {text!r} for {value!r}")

    def bounds(self, what, text, value):
        """A figure behind "at most": rounded up by less than a unit of its last digit, never down."""
        self.checks += 1
        mantissa, _, power = text.partition("e")
        unit = 10.0 ** (int(power or 0) - len(mantissa.partition(".")[2]))
        if not value * (1 - 1e-12) <= float(text) < value + unit * (1 + 1e-9):
            self.faults.append(f"{what}: printed {text!r} as a bound of {value!r}")

    def found(self, what, pattern, text):
        """Groups of a pattern that the text must hold."""
        self.checks += 1
        match = re.search(pattern, text or "")
        if match is None:
            self.faults.append(f"{what}: {text!r} does not say {pattern!r}")
        return match.groups() if match else None

    def read(self, name):
        return (self.folder / name).read_text()

    # fit ----------------------------------------------------------------------------------------

    def fit(self, carrier):
        """The contour file of one carrier after all its checks, or None when there is none."""
        options = [str(self.path), *self.options, "--carrier", carrier]
        self.mark = carrier
        table = self.run("fit", *options, "-o", "fit.json", "-o", "fit.svg", "-o", "fit.dxf")
        as_json = self.run("fit", *options, "--json")
        self.same("exit codes of fit and fit --json", table.code, as_json.code)
        if table.code not in (0, 5) or not (self.folder / "fit.json").exists():
            self.same("errors of fit and fit --json", table.err, as_json.err)
            return None
        stored = json.loads(self.read("fit.json"))
        answer = json.loads(as_json.out)
        self.stored_is_answered(stored, answer)
        self.report_agrees_with_itself(stored)
        self.table_of_fit(table, stored)
        self.lines_of_fit(table.out, answer["lines_and_arcs"])
        self.captions(labels_of(self.read("fit.svg")), stored, "picture of fit")
        self.verdict(table, labels_of(self.read("fit.svg")))
        certificate = self.verify(table, stored)
        self.analyse_contour(stored)
        self.convert(stored)
        self.same("certificates of fit and verify", certificate, stored["certificate"])
        for name in ("fit.json", "fit.svg", "fit.dxf"):
            (self.folder / name).unlink()
        stored["exit code"], stored["errors"] = table.code, table.err
        return stored

    def verdict(self, table, labels):
        """The picture says of the joints what the last line of the table says."""
        line = table.out.rstrip().rsplit("\n", 1)[-1]
        proved = re.match(r"proved: monotone (\w+) on every run, (.*), inside the region$", line)
        if proved:
            words = f"✓ proved: monotone {proved[1]}, {proved[2]}"
            self.same("verdict in the picture", True, any(one.startswith(words) for one in labels))

    def stored_is_answered(self, stored, answer):
        for report in (stored["report"], answer["report"]):
            report.pop("seconds")
        self.same("report of file and JSON", stored["report"], answer["report"])
        self.same("certificate of file and JSON", stored["certificate"], answer["certificate"])
        self.same("carrier of file and JSON", stored["carrier"], answer["carrier"])
        self.same("units of file and JSON", stored["units"], answer["units"])
        self.same("pieces of file and JSON", len(stored["pieces"]), answer["pieces"])
        self.same("points of file and JSON", len(stored["points"]), answer["points"])

    def report_agrees_with_itself(self, stored):
        report, certificate = stored["report"], stored["certificate"]
        rows = report["segments"]
        widths = [row["width"] for row in rows]
        self.same("largest width", report["largest_width"],
                  None if None in widths else largest(widths))
        self.same("largest deviation", report["largest_deviation"],
                  largest(row["deviation"] for row in rows))
        self.same("inserted points", report["inserted_points"], sum(r["inserted"] for r in rows))
        self.same("vertices of report and certificate", report["vertices"],
                  certificate["vertices"])
        self.same("inflections of report and certificate", report["inflections"],
                  certificate["inflections"])
        self.same("moves of report and certificate", report["largest_move"],
                  certificate["largest_move"])
        if certificate["proved"]:
            self.same("the bound is at most the proved vertices", True,
                      report["vertices_lower_bound"] <= certificate["vertices"])

    def table_of_fit(self, table, stored):
        report, certificate, units = stored["report"], stored["certificate"], stored["units"]
        facts = facts_of(table.out)
        said = self.found("contour", r"^(\d+) pieces? through (\d+) points?(?:, (\d+) joints? free "
                          r"between them)? in (\d+) runs?$", facts.get("contour"))
        if said:
            self.same("contour", [int(n or 0) for n in said],
                      [len(stored["pieces"]), len(stored["points"]),
                       report["chain"]["free_elements"], len(stored["runs"])])
        self.same("fairness", facts.get("fairness"), "{} (curvature extrema, at least {} unless a curve winds between the points), {}".format(
            plural(certificate["vertices"], "vertex", "vertices"), report["vertices_lower_bound"],
            plural(certificate["inflections"], "inflection", "inflections")))
        self.bounds_of_fit(facts, stored)
        if report["carrier_deviation"] is not None:
            said = self.found("from the spirals", rf"^({NUMBER}) \S+ as measured, (?:({NUMBER}) "
                              "outside|inside) their region$", facts.get("from the spirals"))
            if said:
                self.shows("from the spirals", said[0], report["carrier_deviation"])
                self.shows("outside their region", said[1] or "0", report["outside_spirals_region"])
        else:
            self.same("from the spirals", facts.get("from the spirals"), None)
        if report["waviness"] is not None:
            said = self.found("waviness", rf"^({NUMBER}) hills of the slope of curvature on a run$",
                              facts.get("waviness"))
            if said:
                self.shows("waviness", said[0], report["waviness"])
        else:
            self.same("waviness", facts.get("waviness"), None)
        if report["largest_move"] > 0:
            self.shows("largest move", facts.get("largest move", "").split(" ")[0],
                       report["largest_move"])
        self.gaps(facts, certificate)
        self.rows_of_fit(table.out, stored)
        verdict = table.out.rstrip("\n").rsplit("\n", 1)[-1]
        self.same("verdict and certificate", verdict.startswith("proved"), certificate["proved"])
        self.same("verdict and exit code", verdict.startswith(("proved", "NOT monotone, as")),
                  table.code == 0 or "E502" in table.err)
        word = verdict.partition(":")[0].partition(",")[0]
        self.same("verdict by the certificate", word.replace("NOT monotone", "not monotone"),
                  verdict_of(stored))

    def bounds_of_fit(self, facts, stored):
        report = stored["report"]
        if "largest error" not in facts:
            self.same("no promise, no bound", stored["carrier"] in ("cubic", "baseline", "imported"), True)
            self.same("no promise, no bound", report["largest_deviation"], None)
            return
        said = self.found("largest error", rf"^({NUMBER}|unknown)(?: \S+)? from the points alone"
                          rf"(?: \(points (\d+)-\d+(?:, unknown over (\d+) segments?)?\))?; ({NUMBER}|unknown)(?: \S+)? with these tangents and "
                          rf"curvatures(?: \(points (\d+)-\d+, at ({NUMBER}), ({NUMBER})\))?$",
                          facts["largest error"])
        if said:
            each = [row["points_only_error"] for row in report["segments"]]
            alone = largest(each)
            if alone == 0 and None in each:
                alone = None  # lines and circles alone say nothing of what lies between them
            self.shows("points-only error", said[0].replace("unknown", UNKNOWN), alone)
            self.shows("error bound", said[3].replace("unknown", UNKNOWN), report["largest_deviation"])
            self.same("segments left open", int(said[2] or 0), each.count(None) if said[1] else 0)
            for text, key in ((said[1], "points_only_error"), (said[4], "deviation")):
                if text:
                    value = largest(r[key] for r in report["segments"])
                    at = [r for r in report["segments"] if r[key] == value]
                    self.same("where the error is", int(text), at[0]["points"][0] + 1)
                    if key == "deviation":
                        for shown, there in zip(said[5:7], at[0]["deviation_at"]):
                            self.shows("place of the error", shown, there)
        said = self.found("largest width", rf"^({NUMBER}|unknown)(?: \S+)? \(tolerance ({NUMBER})\)$",
                          facts.get("largest width"))
        if said:
            self.shows("largest width", said[0].replace("unknown", UNKNOWN), report["largest_width"])
            self.shows("tolerance", said[1], report["tolerance"])
        self.same("inserted elements", facts.get("bound needed"),
                  plural(report["inserted_points"], "inserted element", "inserted elements"))

    def gaps(self, facts, certificate):
        said = self.found("joint gaps", rf"^position ({NUMBER}) of the size, heading ({NUMBER}) rad"
                          rf"(?:(?:, curvature|; curvature steps up to) ({NUMBER}|unknown))?",
                          facts.get("joint gaps"))
        for text, key in zip(said or [], ("position", "heading", "curvature")):
            if text is None:  # arcs of which no two meet but in corners
                self.same("a " + key + " gap", certificate["joint_gaps"][key], 0)
                continue
            self.shows(key + " gap", text.replace("unknown", UNKNOWN),
                       certificate["joint_gaps"][key])

    def rows_of_fit(self, text, stored):
        rows = {tuple(p + 1 for p in row["points"]): row for row in stored["report"]["segments"]}
        segments = text.partition("\nline or arc ")[0]  # whose rows begin alike
        printed = re.findall(r"^ *(\d+)-(\d+) +(\S+) +(\S+) +(\S+) +(\d+) ", segments, re.M)
        self.same("there is a table", bool(printed), bool(rows))
        for first, last, chord, alone, width, inserted in printed:
            row = rows.get((int(first), int(last)))
            if row is None:
                self.same("row of the table", (int(first), int(last)), sorted(rows)[:3])
                continue
            what = f"row {first}-{last}: "
            self.shows(what + "chord", chord, row["chord"])
            self.shows(what + "points-only error", alone, row["points_only_error"])
            self.shows(what + "width", width, row["width"])
            self.same(what + "inserted", int(inserted), row["inserted"])

    def lines_of_fit(self, text, answered):
        """The table of lines and arcs has the rows of the JSON."""
        rows = {("all, from %d" if one["points"][0] == one["points"][1] else "%d-%d")
                % tuple(p + 1 for p in one["points"][:1 if one["points"][0] == one["points"][1] else 2]): one
                for one in answered}
        table = text.partition("\nline or arc ")[2].partition("\n\n")[0]
        printed = re.findall(r"^(all, from \d+|\d+-\d+) +(\S+) +(\S+) +(\S+) +(\S+) +(\S+) +(\S+)$", table, re.M)
        self.same("there is a table of lines and arcs", bool(printed), bool(rows))
        for points, radius, x, y, heading, length, farthest in printed:
            one = rows.get(points)
            if one is None:
                self.same("row of lines and arcs", points, sorted(rows)[:3])
                continue
            what = f"line or arc {points}: "
            self.same(what + "kind", radius == "straight", one["kind"] == "line")
            self.shows(what + "radius", UNKNOWN if radius == "straight" else radius, one["radius"])
            self.shows(what + "centre x", x, one["centre_x"])
            self.shows(what + "centre y", y, one["centre_y"])
            self.shows(what + "heading", heading, math.degrees(one["heading"]))
            self.shows(what + "length", length, one["length"])
            self.shows(what + "farthest point", farthest, one["farthest_point"])

    def captions(self, labels, stored, what):
        """A caption of a picture says what the report says."""
        report, certificate, text = stored["report"], stored["certificate"], " · ".join(labels)
        self.same(what + ": counts", True, "{} (at least {} unless a curve winds) · {}".format(
            plural(certificate["vertices"], "vertex", "vertices"), report["vertices_lower_bound"],
            plural(certificate["inflections"], "inflection", "inflections")) in text)
        self.same(what + ": points and pieces", True, "{} · {}".format(
            plural(len(stored["points"]), "point", "points"),
            plural(len(stored["pieces"]), "piece", "pieces")) in text)
        self.same(what + ": proved", certificate["proved"],
                  any(t.startswith("✓") for t in labels))
        width = re.search(rf"region width ({NUMBER}|-) ", text)
        self.same(what + ": width is told", report["largest_width"] is not None,
                  width is not None and width[1] != "-")
        if width and width[1] != "-":
            self.shows(what + ": width", width[1], report["largest_width"])
        move = re.search(rf"points at most ({NUMBER}) \S+ from the contour", text)
        self.same(what + ": move is told", move is not None, certificate["largest_move"] > 0)
        if move:
            self.bounds(what + ": move", move[1], certificate["largest_move"])
        widest = re.search(rf"through the points, widest ({NUMBER}) ", text)
        alone = largest(row["points_only_error"] for row in report["segments"])
        if widest and alone is not None:
            self.shows(what + ": points-only error", widest[1], alone)
        self.counts_in_legend(labels, certificate, what)

    def counts_in_legend(self, labels, certificate, what):
        for one, many in (("vertex", "vertices"), ("inflection", "inflections"),
                          ("corner", "corners")):
            told = [m for m in (re.fullmatch(rf"(\d+) {many}, not marked|"
                                             rf"{many}, \d+ of (\d+) marked", t)
                                for t in labels) if m]
            count = certificate[many]
            if told:
                self.same(f"{what}: {many} in the legend", int(told[0][1] or told[0][2]), count)
            else:
                self.same(f"{what}: legend has {many}", one in labels, count > 0)

    # verify, analyse, convert -------------------------------------------------------------------

    def verify(self, fitted, stored):
        table, as_json = self.run("verify", "fit.json"), self.run("verify", "fit.json", "--json")
        answer = json.loads(as_json.out)
        certificate, facts = answer["certificate"], facts_of(table.out)
        self.same("exit codes of verify", table.code, as_json.code)
        self.same("exit codes of fit and verify", fitted.code, table.code)
        self.same("no false claim", answer["false_claim"], None)
        self.same("holds", answer["holds"], table.code == 0)
        self.same("verdicts of fit and verify", fitted.out.rstrip("\n").rsplit("\n", 1)[-1],
                  table.out.rstrip("\n").rsplit("\n", 1)[-1])
        self.same("verdict of the file", facts.get("file claims"),
                  table.out.rstrip("\n").rsplit("\n", 1)[-1])
        said = self.found("claims", rf"^(\d+) vert\w+, (\d+) inflections?, largest width "
                          rf"({NUMBER}|unknown)(?: |$)", facts.get("report claims"))
        if said:
            self.same("claimed vertices", int(said[0]), certificate["vertices"])
            self.same("claimed inflections", int(said[1]), certificate["inflections"])
            self.shows("claimed width", said[2].replace("unknown", UNKNOWN), stored["report"]["largest_width"])
        verdicts = collections.Counter(p["verdict"] for p in certificate["monotone"])
        self.same("verdicts of pieces", {name: int(count) for count, name in re.findall(
            r"(\d+) ([a-z-]+)", facts.get("curvature", ""))}, dict(verdicts))
        for key in ("vertices", "inflections", "self-intersections"):
            self.same("verify: " + key, facts.get(key), str(certificate[key.replace("-", "_")]))
        for label, key in (("gaps within bounds", "gaps_within_bounds"),
                           ("through all points", "through_points"),
                           ("inside the region", "inside_region")):
            self.same("verify: " + label, facts.get(label), "yes" if certificate[key] else "no")
        self.gaps(facts, certificate)
        return certificate

    def analyse_contour(self, stored):
        certificate = stored["certificate"]
        curve = self.analyse_drawing("fit.json", "analysis.svg")[0]
        self.same("analyse: pieces", curve["pieces"], len(stored["pieces"]))
        self.same("analyse: closed", curve["closed"], stored["closed"])
        self.joints_of_analyse(curve, stored)
        if certificate["gaps_within_bounds"]:
            self.same("analyse: vertices", curve["vertices"], certificate["vertices"])
            self.same("analyse: inflections", curve["inflections"], certificate["inflections"])
        kappa = largest_kappa(curve)
        tooth = re.search(rf"longest tooth ({NUMBER}) /", " ".join(labels_of(self.read("fit.svg"))))
        if tooth:
            self.shows("longest tooth", tooth[1], kappa)

    def joints_of_analyse(self, curve, stored):
        """`analyse` measures what `fit` has proved: never less, and a corner or a step as such."""
        certificate, order = stored["certificate"], order_of(stored, True)
        told = f"analyse: G{curve['continuity']} where fit says G{order}: at least that"
        self.same(told, True, curve["continuity"] >= order)
        if certificate["corners"] + certificate["curvature_steps"] > 0:
            self.same("analyse: corners and steps", curve["continuity"], order)

    def convert(self, stored):
        """What is converted is what fit wrote, but for the name of the file in the picture."""
        done = self.run("convert", "fit.json", "-o", "again.svg", "-o", "again.dxf", "-o",
                        "again.json")
        self.same("convert ends well", done.code, 0)
        if done.code != 0:
            return
        self.same("DXF of fit and convert", self.read("fit.dxf"), self.read("again.dxf"))
        again = json.loads(self.read("again.json"))
        again["report"].pop("seconds")
        self.same("contour of fit and convert", again, stored)
        self.same("captions of fit and convert", labels_of(self.read("fit.svg"))[1:],
                  labels_of(self.read("again.svg"))[1:])
        for name in ("again.svg", "again.dxf", "again.json"):
            (self.folder / name).unlink()

    def list_of_drawing(self, text, items):
        """Every curve and series has a row, in their order."""
        rows = re.findall(r"^ *(\d+)  (.*?)  +(\S.*?)  +(\d+)  +(\S+)  +(yes|no)  +(\S+)  +(\S+)$", text, re.M)
        self.same("rows of the list", [int(row[0]) for row in rows], list(range(1, len(items) + 1)))
        for (number, _, kind, points, length, closed, width, height), item in zip(rows, items):
            what = f"analyse, row {number}: "
            self.same(what + "kind and points", (kind, int(points)), (item["kind"], item["points"]))
            self.same(what + "closed", closed, "yes" if item["closed"] else "no")
            self.shows(what + "length", length, item["length"])
            low_x, low_y, high_x, high_y = item["box"]
            self.shows(what + "width", width, high_x - low_x)
            self.shows(what + "height", height, high_y - low_y)

    def analyse_drawing(self, name, picture):
        """Curves of a drawing, after table, JSON and picture were compared."""
        as_json = self.run("analyse", name, "--json")
        if as_json.code != 0:
            self.same("analyse ends well or with an error", bool(as_json.err), True)
            return []
        answer = json.loads(as_json.out)
        curves = answer.get("curves", [])
        output = ["-o", picture] if curves else []
        table = self.run("analyse", name, *output)
        self.same("exit codes of analyse", table.code, as_json.code)
        self.list_of_drawing(table.out, curves + answer.get("series", []))
        listed = re.findall(r"^ *(\d+)  +(\d+)  +(G\d|gaps)  +(\d+|-)  +(\d+|-)  +(\d+|-)  +(\S+)$",
                            table.out, re.M)
        self.same("curves in the table", bool(listed), bool(curves))
        for number, pieces, joints, vertices, visible, inflections, radius in listed:
            curve = curves[int(number) - 1]
            what = f"analyse, curve {number}: "
            self.same(what + "counts", [pieces, vertices, visible, inflections],
                      [UNKNOWN if curve[k] is None else str(curve[k])
                       for k in ("pieces", "vertices", "visible_vertices", "inflections")])
            self.same(what + "joints", joints,
                      "gaps" if curve["continuity"] < 0 else f"G{curve['continuity']}")
            kappa = None
            if curve["largest_kappa"] is not None:
                kappa = max(curve["largest_kappa"], curve["least_kappa"], key=abs)
            if kappa is None:
                self.same(what + "least radius", radius, UNKNOWN)
            elif kappa != 0:
                self.shows(what + "least radius", radius, 1 / kappa)
            if curve["vertices"] is None:
                continue
            kinds = collections.Counter(place["kind"] for place in curve["places"])
            self.same(what + "places are not more than the counts", True,
                      kinds["vertex"] <= curve["vertices"] and
                      kinds["inflection"] <= curve["inflections"])
            placed = "{} of {} and {} of {} have a row".format(
                kinds["vertex"], plural(curve["vertices"], "vertex", "vertices"),
                kinds["inflection"], plural(curve["inflections"], "inflection", "inflections"))
            whole = (kinds["vertex"], kinds["inflection"]) == (curve["vertices"],
                                                               curve["inflections"])
            if len(listed) == 1 and curve["places"]:
                self.same(what + "what has no place is told", placed in table.out, not whole)
        if output and (self.folder / picture).exists():
            longest = max(curves, key=lambda c: c["length"])
            labels = labels_of(self.read(picture))
            self.same("picture of analyse", True, longest["vertices"] is None or any(
                "{}, {}".format(plural(longest["vertices"], "vertex", "vertices"),
                                plural(longest["inflections"], "inflection", "inflections")) in t
                for t in labels))
            self.same("picture of analyse: pieces", True, any(
                re.search(rf"· {plural(longest['pieces'], 'piece', 'pieces')}( ·|$)", t)
                for t in labels))
            (self.folder / picture).unlink()
        return curves

    def analyse_points(self, stored):
        """The points alone say the same beside a contour as without."""
        as_json, table = (self.run("analyse", str(self.path), *more) for more in (["--json"], []))
        self.same("exit codes of analyse", table.code, as_json.code)
        if as_json.code != 0 or "segments" not in as_json.out:
            return
        answer = json.loads(as_json.out)
        facts = facts_of(table.out)
        if "size" not in answer:
            return  # a drawing with several series
        self.shows("analyse: size", facts.get("size", "").split(" ")[0], answer["size"])
        for key in ("vertices", "inflections"):
            kind = "curvature extrema, " if key == "vertices" else ""
            self.same("analyse: " + key, facts.get(key), "{} ({}at least {} unless a curve winds between the points)".format(
                answer[key], kind, answer[key + "_lower_bound"]))
        for i, alone in re.findall(r"^ *(\d+) .*  +(\S+)$", table.out, re.M):
            if int(i) <= len(answer["segments"]) and alone not in ("increasing", "decreasing"):
                self.shows(f"analyse, row {i}: points-only error", alone,
                           answer["segments"][int(i) - 1]["points_only_error"])
        if stored is None or self.options or stored["closed"] or stored["certificate"]["corners"]:
            return
        if len(answer["points"]) != len(stored["points"]):
            return  # points that stand twice were merged
        for row in stored["report"]["segments"]:
            alone = answer["segments"][row["points"][0]]["points_only_error"]
            # a contour that turns back elsewhere than the points is known where they tell nothing,
            # and one that leaves their line or circle is not one of the curves that have no choice
            left = alone == 0 and not keeps_circle(stored, answer["circular"], row["points"][0])
            if row["points_only_error"] is not None and alone is not None and not left:
                self.same(f"points-only error of fit and analyse at {row['points']}",
                          row["points_only_error"], alone)
        self.same("bounds of fit and analyse", stored["report"]["vertices_lower_bound"],
                  answer["vertices_lower_bound"])

    # surfaces -----------------------------------------------------------------------------------

    def surface(self, kind, paths):
        """Number of patches, after table, JSON and picture of `surface check` were compared."""
        made = self.run("surface", kind, *(str(p) for p in paths), *self.options, "-o", "s.json",
                        "--colour", "gaussian", "-o", "made.svg", "-o", "made.html")
        if made.code != 0:
            return 0
        table = self.run("surface", "check", "s.json", "-o", "s.svg")
        answer = json.loads(self.run("surface", "check", "s.json", "--json").out)
        patches = {p["name"]: p for p in answer["patches"]}
        for name, patch in patches.items():
            row = re.search(rf"^{re.escape(name)}  +\d+ x \d+.*$", table.out, re.M)
            end = rf"({NUMBER}|{NO_BOUND})"
            said = self.found(f"{name}: row of surface check", rf" ({NUMBER})  +{end} to "
                              rf"{end}  +{end} to {end}$", row and row[0])
            values = [patch["area"], *patch["gaussian"], *patch["mean"]]
            for text, value in zip(said or [], values):
                self.shows(f"{name}: surface check", text.replace(NO_BOUND, UNKNOWN), value)
            row = re.search(rf"^{re.escape(name)} +(\d+) of (\d+) +(\d+) +(\d+) +(\d+) +(\d+) of "
                            r"(\d+) +(\d+) +(\d+) +(\d+)$", table.out, re.M)
            self.same(f"{name}: lines", row and [int(n) for n in row.groups()],
                      [patch[way][key] for way in ("along_u", "along_v") for key in (
                          "monotone", "lines", "vertices", "most_vertices", "inflections")])
        endless = (-math.inf, math.inf)
        most = [(min, max)[k](endless[k] if p["gaussian"][k] is None else p["gaussian"][k]
                              for p in patches.values()) for k in range(2)]
        most = [value if math.isfinite(value) else None for value in most]
        for picture in ("s.svg", "made.svg"):
            extremes = re.search(rf"from {end} to {end} in all",
                                 " ".join(labels_of(self.read(picture))))
            for k in range(2) if extremes else []:
                self.shows(f"Gaussian curvature in {picture}",
                           extremes[k + 1].replace(NO_BOUND, UNKNOWN), most[k])
        page = re.search(r'"least":(-?[\d.e+-]+|null)[^{}]*?"most":(-?[\d.e+-]+|null)',
                         self.read("made.html"))
        for k in range(2) if most[0] != most[1] else []:
            self.same("Gaussian curvature of the page", page and json.loads(page[k + 1]), most[k])
        return len(patches)

    # compare ------------------------------------------------------------------------------------

    def compare(self, contours):
        """Rows of the comparison beside contours of `fit --carrier`, by the carriers' names."""
        self.mark = "compare"
        source = [str(self.path), *self.options]
        done = self.run("compare", *source, "--json", "-o", "rows.csv", "-o", "rows.svg")
        if done.code != 0:
            table = self.run("compare", *source)
            self.same("exit codes of compare", table.code, done.code)
            self.same("errors of fit and compare", contours.get("spiral"), None)
            return
        rows = {row["carrier"]: row for row in json.loads(done.out)["carriers"]}
        table = self.run("compare", *source)
        for name, stored in contours.items():
            row = rows[name]
            self.same(f"{name}: there is a contour", row["refusal"] is None, stored is not None)
            if stored is None or row["refusal"] is not None:
                continue
            report, certificate = stored["report"], stored["certificate"]
            for key, value in (("pieces", len(stored["pieces"])),
                               ("vertices", certificate["vertices"]),
                               ("inflections", certificate["inflections"]),
                               ("error_bound", report["largest_deviation"]),
                               ("deviation", report["carrier_deviation"]),
                               ("outside", report["outside_spirals_region"]),
                               ("continuity", order_of(stored, False)),
                               ("monotone", certificate["proved"]),
                               ("reason", certificate["reason"])):
                self.same(f"{name}: {key} of compare and fit", row[key], value)
            verdict = verdict_of(stored)
            line = re.search(rf"^{name} .*  (\S.*)$", table.out, re.M)
            self.same(f"{name}: verdict of compare and fit", line and line[1], verdict)
            wide = "E502" in stored["errors"]  # kept, but for the width of the region
            self.same(f"{name}: verdict and exit code of fit", verdict != "NOT proved",
                      stored["exit code"] == 0 or wide)
        self.table_of_compare(table.out, rows)
        self.csv_of_compare(rows, contours)
        self.captions_of_compare(labels_of(self.read("rows.svg")), rows)

    def table_of_compare(self, text, rows):
        for name, row in rows.items():
            line = re.search(rf"^{name} +(.*)$", text, re.M)
            self.same(f"{name}: row of compare", line is not None, True)
            if line is None or row["refusal"] is not None:
                continue
            cells = line[1].split()
            for cell, key in zip(cells[:2], ("pieces", "control_points")):
                self.same(f"{name}: {key}", cell, "-" if row[key] is None else str(row[key]))
            self.same(f"{name}: joints", cells[2], f"G{row['continuity']}")
            self.same(f"{name}: counts", cells[3:5], [str(row["vertices"]),
                                                      str(row["inflections"])])
            for cell, key in zip(cells[5:8], ("error_bound", "deviation", "outside")):
                self.shows(f"{name}: {key}", cell, row[key])
            self.same(f"{name}: verdict", line[1].endswith("  proved"), row["monotone"])

    def csv_of_compare(self, rows, contours):
        for line in csv.DictReader(io.StringIO(self.read("rows.csv"))):
            row = rows[line["carrier"]]
            if row["refusal"] is not None:
                self.same("refusal in CSV", line["verdict"] or line[None], row["refusal"]["code"])
                continue
            for key in ("pieces", "control_points", "vertices", "inflections", "error_bound",
                        "deviation", "outside"):
                self.same(f"{line['carrier']}: {key} in CSV",
                          float(line[key]) if line[key] else None, row[key])
            self.same(f"{line['carrier']}: joints in CSV", line["continuity"], f"G{row['continuity']}")
            if contours.get(line["carrier"]) is not None:
                self.same(f"{line['carrier']}: verdict in CSV", line["verdict"],
                          verdict_of(contours[line["carrier"]]))

    def captions_of_compare(self, labels, rows):
        for name, row in rows.items():
            caption = [t for t in labels if t == name or t.startswith(name + ": ")]
            self.same(f"{name}: caption", len(caption), 1)
            if row["refusal"] is not None or len(caption) != 1:
                continue
            counts = ": " + plural(row["vertices"], "vertex", "vertices")
            if row["inflections"]:
                counts += ", " + plural(row["inflections"], "inflection", "inflections")
            said = re.sub(r", \d+ corners?$", "", caption[0])
            self.same(f"{name}: counts in the picture", said, name + counts)
            remark = labels[labels.index(caption[0]) + 1]
            said = self.found(f"{name}: remark", rf"^G{row['continuity']}, {row['pieces']} pieces?"
                              rf"(?:, ({NUMBER}) \S+ from the spirals)?$", remark)
            if said:
                self.shows(f"{name}: deviation in the picture", said[0] or UNKNOWN,
                           row["deviation"])

    # suggest ------------------------------------------------------------------------------------

    def suggest(self):
        self.mark = "suggest"
        source = [str(self.path), *(o for o in self.options if o in ("--closed", "--primitives"))]
        done = self.run("fit", *source, "--suggest", "--json", "-o", "chart.svg")
        table = self.run("fit", *source, "--suggest")
        self.same("exit codes of --suggest", table.code, done.code)
        if not done.out:
            return
        answer = json.loads(done.out)
        rows = answer["rows"]
        lines = re.findall(rf"^ *({NUMBER}) +(\S+) +(\S+) +(\S+) +(\S+) +(\S+) +\S+  (\S.*?)  +(yes|no)",
                           table.out, re.M)
        self.same("rows of --suggest", len(lines), len(rows))
        for cells, row in zip(lines, rows):
            self.shows("tolerance of --suggest", cells[0], row["tolerance"])
            self.same("proved by --suggest", cells[7] == "yes", row["proved"])
            self.same("option of --suggest", cells[6].strip(), row.get("option", "-"))
            for cell, key in zip(cells[1:5], ("vertices", "vertices_lower_bound", "inflections",
                                              "pieces")):
                self.same("--suggest: " + key, cell, str(row.get(key, UNKNOWN)))
            self.shows("--suggest: largest move", cells[5], row.get("largest_move"))
        for number in self.rows_to_repeat(answer):
            self.row_of_suggest(rows[number], source)
        if answer["recommended"] is None:
            return
        row = rows[answer["recommended"]]
        said = self.found("recommendation", rf"^Recommended: --noise ({NUMBER})\S*(?: --\S+)* \((\d+) "
                          rf"vert\w+, moves up to ({NUMBER}) ",
                          re.search(r"^Recommended.*", table.out, re.M)[0])
        if said:
            self.shows("recommended tolerance", said[0], row["tolerance"])
            self.same("vertices of the recommendation", int(said[1]), row["vertices"])
            self.shows("move of the recommendation", said[2], row["largest_move"])
        said = self.found("chart", rf"Recommended \(diamond\): --noise ({NUMBER})(?: --open)?, (\d+) vert",
                          " ".join(labels_of(self.read("chart.svg"))))
        if said:
            self.shows("tolerance in the chart", said[0], row["tolerance"])
            self.same("vertices in the chart", int(said[1]), row["vertices"])

    def rows_to_repeat(self, answer):
        if self.thorough:
            return range(len(answer["rows"]))
        return [] if answer["recommended"] is None else [answer["recommended"]]

    def row_of_suggest(self, row, source):
        """What a user types who reads the row."""
        if not row["formed"] or row["carried"] or "no smaller" in row["option"]:
            return
        done = self.run("fit", *source, *row["option"].split(), "--json")
        if not done.out:
            self.same(f"fit --noise {row['tolerance']!r}", done.err, "a contour")
            return
        fitted = json.loads(done.out)
        report = fitted["report"]
        for key, value in (("vertices", report["vertices"]),
                           ("vertices_lower_bound", report["vertices_lower_bound"]),
                           ("inflections", report["inflections"]),
                           ("largest_move", report["largest_move"]),
                           ("pieces", fitted["pieces"]),
                           ("proved", fitted["certificate"]["proved"])):
            self.same(f"{key} of --suggest and fit --noise {row['tolerance']!r}", row[key], value)


def sweep_series(program, path, options, carriers, thorough):
    with tempfile.TemporaryDirectory() as name:
        subject = Subject(program, path, options, pathlib.Path(name), thorough)
        faults = []

        def step(mark, function, *args):
            answer = None
            try:
                answer = function(*args)
            except (ValueError, KeyError, IndexError, TypeError, OSError) as error:
                subject.faults.append(f"not readable: {error!r}")
            except subprocess.TimeoutExpired as error:
                subject.faults.append(f"no end: {error}")
            faults.extend(f"{mark}: {fault}" for fault in subject.faults)
            subject.faults.clear()
            return answer

        contours = {carrier: step(carrier, subject.fit, carrier) for carrier in carriers}
        step("analyse", subject.analyse_points, contours.get("spiral"))
        exact = not any(option in options for option in ("--noise", "--closed", "--primitives"))
        if exact and (thorough or contours.get("spiral")):
            step("compare", subject.compare, contours)
        if thorough or not exact:
            step("--suggest", subject.suggest)
        formed = sum(stored is not None for stored in contours.values())
        return faults, subject.checks, subject.runs, formed


def sweep_drawing(program, path):
    with tempfile.TemporaryDirectory() as name:
        subject = Subject(program, path, [], pathlib.Path(name), False)
        try:
            curves = subject.analyse_drawing(str(path), "analysis.svg")
        except (ValueError, KeyError, IndexError, TypeError, OSError) as error:
            return [f"not readable: {error!r}"], 0, subject.runs, 0
        return subject.faults, subject.checks, subject.runs, len(curves)


def sweep_surface(program, kind, paths, options):
    with tempfile.TemporaryDirectory() as name:
        subject = Subject(program, paths[0], options, pathlib.Path(name), False)
        try:
            patches = subject.surface(kind, paths)
        except (ValueError, KeyError, IndexError, TypeError, OSError) as error:
            return [f"not readable: {error!r}"], 0, subject.runs, 0
        return subject.faults, subject.checks, subject.runs, patches


def spread(things, count):
    """Evenly spread over a list, the first and the last among them."""
    if count is None or len(things) <= count:
        return things
    if count == 0:
        return []
    if count == 1:
        return [things[len(things) // 2]]
    return [things[round(i * (len(things) - 1) / (count - 1))] for i in range(count)]


def jobs_of(data, own, every_file, everything):
    """(path, options, carriers) of series, (path,) of drawings; and how many files there are."""
    jobs, there, turn = [], 0, 0
    for folder in own:
        files = sorted(p for p in folder.rglob("*") if p.suffix in (".csv", ".dat")
                       and "surfaces" not in p.parts)
        there += len(files)
        for path in files:
            turn += 1
            some = ["spiral", CARRIERS[1 + turn % (len(CARRIERS) - 1)]]
            choices = [[], ["--noise", "rounding"], ["--noise", "rounding", "--primitives"]]
            jobs += [(path, options, CARRIERS if everything else some)
                     for options in (choices if everything else [choices[turn % len(choices)]])]
    for pattern, choices, count in SERIES:
        files = sorted(p for p in data.glob(pattern) if p.is_file())
        there += len(files)
        small = [p for p in files if p.stat().st_size <= BYTES_OF_A_SMALL_FILE]
        if len(small) < count:
            small = [p for p in files if p.stat().st_size <= 2 * BYTES_OF_A_SMALL_FILE]
        for i, path in enumerate(files if every_file else spread(small, count)):
            for options in choices if everything else [choices[i % len(choices)]]:
                turn += 1  # carriers take turns, spirals are always there
                some = ["spiral", CARRIERS[1 + turn % (len(CARRIERS) - 1)]]
                jobs.append((path, options, CARRIERS if everything else some))
    for pattern, count in DRAWINGS:
        files = sorted(p for p in data.glob(pattern) if p.is_file())
        there += len(files)
        small = [p for p in files if p.stat().st_size <= 20 * BYTES_OF_A_SMALL_FILE]
        jobs += [(path,) for path in (files if every_file else spread(small, count))]
    for surfaces, folder in [(OWN_SURFACES, own[0]), (SURFACES, data)]:
        for kind, patterns, options in surfaces:
            paths = [folder / (pattern % axis) if "%s" in pattern else folder / pattern
                     for pattern in patterns for axis in ("xyz" if "%s" in pattern else "x")]
            if all(path.is_file() for path in paths):
                there += len(paths)
                jobs.append((paths[0], kind, paths, options))
    return jobs, there


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("program")
    parser.add_argument("data", type=pathlib.Path)
    parser.add_argument("own")
    parser.add_argument("--every-file", action="store_true")
    parser.add_argument("--all", action="store_true")
    parser.add_argument("--only", default="", help="files whose path holds this")
    parser.add_argument("--jobs", type=int, default=min(2, os.cpu_count() or 1))
    asked = parser.parse_args()
    program = str(pathlib.Path(asked.program).resolve())
    if not asked.data.is_dir():
        print(f"{asked.data} is not there: only the files of the sources are swept")
    own = [pathlib.Path(folder).resolve() for folder in asked.own.split(",")]
    jobs, there = jobs_of(asked.data.resolve(), own, asked.every_file or asked.all, asked.all)
    jobs = [job for job in jobs if asked.only in str(job[0])]
    start = time.monotonic()
    bad = checks = runs = formed = 0
    slowest = []
    told = start

    def work(job):
        begun = time.monotonic()
        return *swept_job(job), time.monotonic() - begun

    def swept_job(job):
        if len(job) == 1:
            return sweep_drawing(program, *job)
        if len(job) == 4:
            return sweep_surface(program, *job[1:])
        return sweep_series(program, *job, asked.all)

    with concurrent.futures.ThreadPoolExecutor(asked.jobs) as pool:
        for job, (faults, checked, ran, made, seconds) in zip(jobs, pool.map(work, jobs)):
            slowest.append((seconds, job[0].name))
            checks, runs, formed = checks + checked, runs + ran, formed + made
            bad += bool(faults)
            if faults:
                print("DISAGREE " + " ".join([str(job[0]), *(job[1] if len(job) == 3 else [])]), flush=True)
                for fault in faults:
                    print("    " + (fault if len(fault) < 400 else fault[:400] + " ..."))
            if time.monotonic() - told >= SECONDS_BETWEEN_LINES:
                told = time.monotonic()
                print(f"{len(slowest)} of {len(jobs)} sets of options after {told - start:.0f} s: "
                      f"{checks} comparisons, {bad} disagree", flush=True)
    swept = len({job[0] for job in jobs})
    print(f"{swept} of {there} files swept ({len(jobs)} sets of options, {runs} runs, {formed} "
          f"contours and curves): {checks} comparisons, {bad} of {len(jobs)} disagree; "
          f"{time.monotonic() - start:.0f} s")
    print("slowest: " + ", ".join(f"{n} {s:.0f} s" for s, n in sorted(slowest, reverse=True)[:3]))
    assert formed > 0, "nothing was compared"
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
