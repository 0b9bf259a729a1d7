#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Pages of contours against the contour files written beside them.

usage: report_page_test.py PROGRAM EXAMPLES
"""
import csv
import html.parser
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

PROGRAM = str(pathlib.Path(sys.argv[1]).resolve())
EXAMPLES = pathlib.Path(sys.argv[2]).resolve()
VOID = {"meta", "br", "hr", "img", "input", "link"}
NUMBER = r"[-+]?\d+(?:\.\d*)?(?:e[-+]?\d+)?"


class Page(html.parser.HTMLParser):
    """Tables by their id, texts of headings, faults of structure, addresses that leave the page."""

    def __init__(self, text):
        super().__init__()
        self.open, self.faults, self.texts, self.tables, self.outside = [], [], {}, {}, []
        self.kinds, self.cell, self.rows = [], None, None
        self.lists = {}
        self.feed(text)
        self.faults += [f"<{name}> stays open" for name in self.open]

    def handle_starttag(self, tag, attributes):
        self.kinds.append(tag)
        names = dict(attributes)
        self.outside += [v for k, v in names.items() if k in ("href", "src") and not v.startswith("#")]
        if tag not in VOID:
            self.open.append(tag)
        if tag == "ul":
            self.items = self.lists.setdefault(names.get("id"), [])
        elif tag == "li":
            self.cell = ""
        if tag == "table":
            self.rows = self.tables.setdefault(names.get("id"), [])
        elif tag == "tr":
            self.rows.append([])
        elif tag in ("td", "th"):
            self.cell = ""
        elif tag in ("h1", "title") or names.get("id") == "verdict":
            self.cell = ""

    def handle_startendtag(self, tag, attributes):
        self.kinds.append(tag)

    def handle_endtag(self, tag):
        if not self.open or self.open.pop() != tag:
            self.faults.append(f"</{tag}>")
        if tag in ("td", "th"):
            self.rows[-1].append(self.cell)
        elif tag == "li":
            self.items.append(self.cell)
        elif tag in ("h1", "p"):
            self.texts[tag] = self.cell

    def handle_data(self, data):
        if self.cell is not None:
            self.cell += data


def same(text, value):
    """Whether a printed number is this one, rounded to the digits that are printed."""
    if value is None:
        return text == "-"
    digits = len(re.sub(r"e.*|[-+.]", "", text).lstrip("0"))
    printed = float(text)
    unit = 10.0 ** (math.floor(math.log10(abs(value))) - digits + 1) if value else 0.0
    return abs(printed - value) <= 0.5001 * unit or printed == value


class PageCase(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.root = pathlib.Path(self.folder.name)

    def run_program(self, *arguments, code=0):
        done = subprocess.run([PROGRAM, *map(str, arguments)], capture_output=True, text=True, cwd=self.root)
        self.assertEqual(done.returncode, code, done.stderr)
        return done.stdout

    def page(self, name="r.html"):
        text = (self.root / name).read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual(page.faults, [])
        self.assertEqual(page.outside, [])
        self.assertNotIn("script", page.kinds)
        self.assertEqual(page.kinds.count("svg"), 1)
        return page


class Reports(PageCase):
    def judge(self, page, stored):
        report, rows = stored["report"], dict(page.tables["figures"])
        self.assertEqual(rows["carrier"], stored["carrier"])
        self.assertEqual(rows["closed"], "yes" if stored["closed"] else "no")
        counts = [int(n) for n in re.findall(r"\d+", rows["contour"])]
        self.assertEqual(counts, [len(stored["pieces"]), len(stored["points"]), len(stored["runs"])])
        vertices, bound, inflections = map(int, re.findall(r"\d+", rows["fairness"]))
        self.assertEqual([vertices, bound], [report["vertices"], report["vertices_lower_bound"]])
        self.assertEqual(inflections, report["inflections"])
        if "largest width" in rows:
            width, tolerance = re.findall(NUMBER, rows["largest width"])
            self.assertTrue(same(width, report["largest_width"]) and same(tolerance, report["tolerance"]))
            error = re.search("(" + NUMBER + r") \w+ with these tangents and curvatures", rows["largest error"])
            self.assertTrue(same(error[1], report["largest_deviation"]))
        self.assertEqual("largest move" in rows, report["largest_move"] > 0)
        if report["largest_move"] > 0:
            self.assertTrue(same(re.match(NUMBER, rows["largest move"])[0], report["largest_move"]))
        gaps = stored["certificate"]["joint_gaps"]
        printed = re.findall(r"(position|heading|slope of curvature|curvature) (" + NUMBER + ")", rows["joint gaps"])
        self.assertGreaterEqual(len(printed), 2)
        for name, figure in printed:
            self.assertTrue(same(figure, gaps[name.split(" ")[0]]), (name, figure, gaps))
        segments = page.tables["segments"][1:]
        self.assertEqual(len(segments), len(report["segments"]))
        for row, one in zip(segments, report["segments"]):
            self.assertEqual(row[0], "-".join(str(i + 1) for i in one["points"]))
            for text, key in zip(row[1:5], ("chord", "points_only_error", "width", "deviation")):
                self.assertTrue(same(text, one[key]), (key, text, one[key]))
            self.assertEqual(int(row[5]), one["inserted"])

    def test_every_carrier_says_what_its_file_says(self):
        table = (EXAMPLES.parent / "include/obvid/curve/carriers.inc").read_text(encoding="utf-8")
        carriers = re.findall(r"^OBVID_CARRIER\(k\w+, (\w+),", table, re.MULTILINE)
        self.assertGreater(len(carriers), 7)
        for carrier in carriers:
            with self.subTest(carrier):
                table = self.run_program("fit", EXAMPLES / "series10.csv", "--carrier", carrier,
                                         "-o", "r.html", "-o", "r.json")
                page = self.page()
                self.judge(page, json.loads((self.root / "r.json").read_text()))
                self.assertEqual(page.texts["p"], table.splitlines()[-1])
                self.assertEqual(page.texts["h1"], "series10.csv")
                self.assertIn(f"--carrier {carrier}", dict(page.tables["figures"])["asked for"])

    def test_measured_and_closed_points_in_other_units(self):
        points = "\n".join(f"{40 * math.cos(t) + 0.001 * (i % 3)} {20 * math.sin(t)}"
                           for i, t in enumerate(2 * math.pi * k / 24 for k in range(24)))
        (self.root / "p.txt").write_text(points)
        self.run_program("fit", "p.txt", "--closed", "--noise", "0.01", "--units", "in", "-o", "r.html", "-o", "r.json")
        page = self.page()
        self.judge(page, json.loads((self.root / "r.json").read_text()))
        self.assertEqual(dict(page.tables["figures"])["lengths in"], "in")
        asked = dict(page.tables["figures"])["asked for"]
        self.assertEqual(sorted(asked.split(" --")), ["closed", "noise 0.01", "obvid fit", "units in"])

    def test_the_page_of_a_file_is_the_page_of_its_fit(self):
        self.run_program("fit", EXAMPLES / "series10.csv", "-o", "r.html", "-o", "r.json")
        first = self.page()
        self.run_program("convert", "r.json", "-o", "again.html")
        again = self.page("again.html")
        self.assertEqual(again.tables["segments"], first.tables["segments"])
        self.assertEqual(again.texts["p"], first.texts["p"])
        figures = [dict(p.tables["figures"]) for p in (first, again)]
        for rows in figures:
            del rows["asked for"]
        self.assertEqual(*figures)

    def test_names_are_no_markup(self):
        name = "<script>alert(1)</script>&.csv".replace("/", "_")
        (self.root / name).write_text((EXAMPLES / "series10.csv").read_text())
        self.run_program("fit", name, "-o", "r.html")
        self.assertEqual(self.page().texts["h1"], name)

    def test_a_drawing_gets_no_verdict_of_ours(self):
        (self.root / "d.svg").write_text('<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" '
                                         'viewBox="0 0 100 100"><path d="M0 0 C 30 60 60 -10 90 40"/></svg>')
        self.run_program("convert", "d.svg", "-o", "r.html")
        self.assertNotIn("proved:", self.page().texts["p"])

    def test_long_tables_show_the_widest(self):
        rows = "\n".join(f"{1000 * math.cos(k / 1000)} {1000 * math.sin(k / 1000) * (1 + k * 1e-4)}" for k in range(1300))
        (self.root / "p.txt").write_text(rows)
        self.run_program("fit", "p.txt", "-o", "r.html", "-o", "r.json")
        segments = json.loads((self.root / "r.json").read_text())["report"]["segments"]
        self.assertEqual(len(segments), 1299)
        widest = sorted(range(1299), key=lambda i: -segments[i]["width"])[:1000]
        self.assertEqual([row[0] for row in self.page().tables["segments"][1:]],
                         ["-".join(str(i + 1) for i in segments[k]["points"]) for k in sorted(widest)])


class PagesOfOtherCommands(PageCase):
    """Figures of their pages against closed forms, and against what --json says."""

    def columns(self, page, table):
        head, *rows = page.tables[table]
        return {name: [row[k] for row in rows] for k, name in enumerate(head)}

    def close(self, text, value, room=1e-9):
        self.assertLessEqual(abs(float(text) - value), room * max(1.0, abs(value)), (text, value))

    def test_an_alignment(self):
        said = json.loads(self.run_program(
            "alignment", EXAMPLES / "road_survey.csv", "--noise", "0.008", "--station", "12000", "--profile",
            EXAMPLES / "road_levels.csv", "--profile-noise", "0.012", "-o", "r.html", "--json"))
        page = self.page()
        elements, figures = self.columns(page, "elements"), dict(page.tables["figures"])
        self.assertEqual(elements["kind"], [e["kind"] for e in said["elements"]])
        for k, e in enumerate(said["elements"]):
            for name in ("station", "length", "x", "y"):
                self.close(elements[name][k], e[name])
            heading = math.radians(90.0 - float(elements["azimuth_deg"][k]))
            self.close(math.remainder(heading - e["heading"], 2 * math.pi), 0.0, 1e-8)
            if e["curvature_start"]:
                self.close(elements["radius_start"][k], 1.0 / e["curvature_start"])
            else:
                self.assertEqual(elements["radius_start"][k], "-")
            if e["kind"] == "clothoid":
                change = abs(e["curvature_end"] - e["curvature_start"])
                self.close(elements["A"][k], math.sqrt(e["length"] / change))
        profile = self.columns(page, "profile")
        for k, e in enumerate(said["profile"]["elements"]):
            self.close(profile["grade_start_percent"][k], 100.0 * e["grade_start"])
            self.close(profile["height"][k], e["height"])
        offsets = [float(t) for t in self.columns(page, "deviations")["offset"] if t != "-"]
        self.assertEqual(len(offsets), len(said["deviations"]))
        for text, one in zip(offsets, said["deviations"]):
            self.close(text, one["offset"])
        count, largest, tolerance, rms = re.findall(NUMBER, figures["points"])
        self.assertEqual(int(count), len(offsets))
        unit = 10.0 ** -len(largest.partition(".")[2])
        most = max(map(abs, offsets))
        self.assertTrue(most <= float(largest) < most + unit and float(tolerance) == 0.008)
        self.assertTrue(same(rms, math.sqrt(sum(o * o for o in offsets) / len(offsets))))
        self.assertEqual(re.findall(NUMBER, figures["length"])[0], f"{said['length']:.1f}")
        self.assertIn("--noise 0.008", figures["asked for"])

    def test_outlines_that_are_cut(self):
        (self.root / "d.svg").write_text(
            '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">'
            '<rect x="10" y="10" width="60" height="40"/><circle cx="40" cy="30" r="10"/></svg>')
        said = json.loads(self.run_program("cut", "d.svg", "--diameter", "4", "--depth", "1", "-o", "r.html", "-o", "t.csv",
                                           "--json"))
        page = self.page()
        rows = self.columns(page, "outlines")
        # the hole first, from inside by the radius; the rectangle outside, its corners rounded by the tool
        wanted = [2 * math.pi * (10 - 2), 2 * (60 + 40) + 2 * math.pi * 2]
        for text, length in zip(rows["length"], wanted):
            self.close(text, length, 1e-6)
        self.assertEqual(rows["tool"], ["inside", "outside"])
        self.assertEqual(rows["curve"], ["2", "1"])
        figures = dict(page.tables["figures"])
        blocks, arcs = re.findall(r"\d+", figures["program"])[:2]
        self.assertEqual([int(blocks), int(arcs)], [said["report"]["blocks"], said["report"]["arc_blocks"]])
        beyond, short = re.findall(NUMBER, figures["read back"])[:2]
        for shown, found in ((beyond, said["report"]["beyond"]), (short, said["report"]["short_of"])):
            self.assertTrue(found <= float(shown) <= 1.01 * found)  # three digits, never below
        self.assertEqual((self.root / "t.csv").read_text().splitlines()[0].split(","), list(rows))

    def test_names_are_the_same_in_drawings_tables_and_pages(self):
        name = '1/2" hole, "deep"; 1.23456789012'
        text = (EXAMPLES / "plate.dxf").read_text().splitlines()
        at = next(k for k, line in enumerate(text) if line == "CIRCLE")
        layer = next(k for k in range(at + 1, len(text), 2) if text[k].strip() == "8")
        text[layer + 1] = name
        (self.root / "d.dxf").write_text("\n".join(text) + "\n")
        for command, table, column in ((("cut", "--diameter", "1", "--depth", "1"), "outlines", "outline"),
                                       (("analyse",), "curves", "layer")):
            with self.subTest(command[0]):
                self.run_program(*command, "d.dxf", "-o", "r.html", "-o", "t.csv", "-q")
                with open(self.root / "t.csv", newline="") as file:
                    head, *rows = csv.reader(file)
                shown = self.columns(self.page(), table)[column]
                self.assertEqual([row[head.index(column)] for row in rows], shown)
                self.assertEqual(sum(name in cell for cell in shown), 1, shown)

    def test_points_that_are_analysed(self):
        # a circle of radius 5 at steps of 10 degrees
        (self.root / "p.csv").write_text("x_m,y_m\n" + "".join(
            f"{5 * math.cos(math.radians(10 * k)):.15f},{5 * math.sin(math.radians(10 * k)):.15f}\n" for k in range(13)))
        self.run_program("analyse", "p.csv", "-o", "r.html", "-q")
        text = (self.root / "r.html").read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual(page.faults + page.outside, [])
        rows = self.columns(page, "points")
        for k in range(12):
            self.close(rows["chord"][k], 10 * math.sin(math.radians(5)))
            if k > 0:
                self.close(rows["adjacent_kappa"][k], 0.2)
                self.close(rows["turning_deg"][k], 10.0)
        self.assertEqual(dict(page.tables["figures"])["lengths in"], "m")

    def test_a_drawing_that_is_analysed(self):
        self.run_program("analyse", EXAMPLES / "plate.dxf", "-o", "r.html", "-q")
        rows = self.columns(self.page(), "curves")
        drawn = [line.strip() for line in (EXAMPLES / "plate.dxf").read_text().splitlines()]
        radii = [float(drawn[drawn.index("40", k) + 1]) for k, line in enumerate(drawn) if line == "CIRCLE"]
        lengths = [t for t, name in zip(rows["length"], rows["name"]) if name.startswith("CIRCLE")]
        self.assertEqual(len(lengths), len(radii))
        for text, radius in zip(lengths, radii):
            self.close(text, 2 * math.pi * radius)

    def test_carriers_that_are_compared(self):
        said = json.loads(self.run_program("compare", EXAMPLES / "series10.csv", "-o", "r.html", "--json"))
        page = self.page()
        rows = self.columns(page, "carriers")
        self.assertEqual(rows["carrier"], [c["carrier"] for c in said["carriers"]])
        for name in ("pieces", "vertices", "inflections"):
            self.assertEqual(list(map(int, rows[name])), [c[name] for c in said["carriers"]])
        for text, one in zip(rows["error_bound"], said["carriers"]):
            self.assertEqual(text == "-", one["error_bound"] is None)
            if text != "-":
                self.close(text, one["error_bound"])
        proved, all_of_them = map(int, re.findall(r"\d+", page.texts["p"]))
        self.assertEqual([proved, all_of_them], [rows["verdict"].count("proved"), len(said["carriers"])])

    def test_curves_that_are_compared(self):
        # circles of radius 10 and 10.5 about one centre: 0.5 apart everywhere
        for name, radius in (("a.svg", 10), ("b.svg", 10.5)):
            (self.root / name).write_text(
                '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">'
                f'<circle cx="40" cy="30" r="{radius}"/></svg>')
        self.run_program("compare", "a.svg", "b.svg", "-o", "r.html", "-q")
        figures = dict(self.page().tables["figures"])
        self.assertEqual(abs(float(figures["deviation of b.svg, as it lies, largest"].split(" at ")[0])), 0.5)
        self.assertEqual(figures["deviation of b.svg, as it lies, root mean square"],
                         "0.50000 (100.0 % of the curve measured)")

    def test_what_was_not_measured_is_told(self):
        for name, length in (("a.svg", 80), ("b.svg", 20)):  # one above the other, a quarter as long
            (self.root / name).write_text(
                '<svg xmlns="http://www.w3.org/2000/svg" width="100mm" height="100mm" viewBox="0 0 100 100">'
                f'<path d="M10 {length}H{10 + length}"/></svg>')
        self.run_program("compare", "a.svg", "b.svg", "-o", "r.html", "-q")
        measured = dict(self.page().tables["figures"])["deviation of b.svg, as it lies, root mean square"]
        self.assertAlmostEqual(float(measured.split("(")[1].split(" %")[0]), 25.0, delta=2.0)

    def test_airfoils_that_are_laid_on_one_chord(self):
        # the same shape a hundred times as large: on one chord they are one
        rows = (EXAMPLES / "naca2412.dat").read_text().splitlines()
        large = [" ".join(f"{100 * float(value):.17g}" for value in row.split()) for row in rows[1:] if row.split()]
        (self.root / "large.dat").write_text("\n".join([rows[0], *large]) + "\n")
        self.run_program("compare", EXAMPLES / "naca2412.dat", "large.dat", "--align", "chord", "-o", "r.html", "-q")
        figures = dict(self.page().tables["figures"])
        largest = figures["deviation of large.dat, on one chord, % of it, largest"]
        self.assertLess(abs(float(largest.split(" at ")[0])), 1e-3)
        self.assertIn("(100.0 % of the curve measured)",
                      figures["deviation of large.dat, on one chord, % of it, root mean square"])
        thickness = figures["large.dat as an airfoil"].split("thickness ")[1].split(" at")[0]
        self.assertAlmostEqual(float(thickness), 12.0, delta=0.02)  # NACA 2412

    def test_a_region(self):
        said = json.loads(self.run_program("region", EXAMPLES / "series10.csv", "-o", "r.html", "--json"))
        page = self.page()
        rows = self.columns(page, "region")
        segments = [k for k, name in enumerate(rows["segment"]) if name != "-"]
        self.assertEqual(len(segments), len(said["segments"]))
        for k, one in zip(segments, said["segments"]):
            for column, name in (("chord", "chord"), ("h", "lower_height"), ("delta", "width"), ("f", "spline_distance")):
                self.close(rows[column][k], one[name])
        self.assertTrue(same(re.findall(NUMBER, page.texts["p"])[0], max(s["width"] for s in said["segments"])))
        self.assertIn("asked for", dict(page.tables["figures"]))


class PagesSayWhatTerminalsSay(PageCase):
    """Every sentence and fact of the terminal, and every warning, is on the page; its tables are tables there."""

    # said in cells: where files are, how long it took, and what the page has more of
    ELSEWHERE = re.compile(r"lengths in|\d+ rows of steps: in")

    def sentences(self, told):
        """Lines that are no rows of tables: facts as (label, value), and what is said in words."""
        for block in (block.splitlines() for block in told.strip().split("\n\n")):
            facts = [re.match(r"^(\S(?:\S| (?! ))*) {2,}(\S(?:\S| (?! ))*)$", line) for line in block]
            if facts[0]:
                yield from ((m[1], m[2]) if m else (None, line) for m, line in zip(facts, block))
            else:  # words, or rows of a table and words below them
                yield from ((None, line) for line in block
                            if re.match(r"^\S.*[a-z]{2,} [a-z]{2,} [a-z]{2,}", line) and "  " not in line)

    def judge(self, arguments, skipped=("written",)):
        done = subprocess.run([PROGRAM, *map(str, arguments), "-o", "r.html"], capture_output=True, text=True, cwd=self.root)
        self.assertIn(done.returncode, (0, 5), done.stderr)
        text = (self.root / "r.html").read_text(encoding="utf-8")
        page = Page(text)
        self.assertEqual(page.faults + page.outside, [])
        said = [row[1] for row in page.tables["figures"]] + page.lists.get("notes", []) + page.lists.get("warnings", []) + list(page.texts.values())
        said += [cell for rows in page.tables.values() for row in rows for cell in row]
        warnings = [line.split("warning: ", 1)[1] for line in done.stderr.splitlines() if "warning: " in line]
        for warning in warnings:
            self.assertIn(warning, page.lists.get("warnings", []))
        count = 0
        for label, value in self.sentences(done.stdout):
            if label in skipped or self.ELSEWHERE.search(value):
                continue
            count += 1
            self.assertTrue(any(value in one for one in said), (label, value))
        return warnings, count

    def test_fit(self):
        warnings, count = self.judge(["fit", EXAMPLES / "series10.csv", "--noise", "0.01", "--primitives"])
        self.assertTrue(warnings and count >= 8)
        self.judge(["fit", EXAMPLES / "plate.dxf", "--curve", "1"])

    def test_verify(self):
        self.judge(["fit", EXAMPLES / "series10.csv", "-o", "c.json"])
        _, count = self.judge(["verify", "c.json"], ())
        self.assertGreaterEqual(count, 10)

    def test_convert(self):
        self.assertTrue(self.judge(["convert", EXAMPLES / "plate.dxf"])[0])

    def test_analyse(self):
        (self.root / "twice.csv").write_text("0,0\n1,0\n1,0\n2,1\n2,3\n0,4\n")
        warnings, count = self.judge(["analyse", "twice.csv"])
        self.assertTrue(warnings and count >= 5)
        self.assertTrue(self.judge(["analyse", EXAMPLES / "plate.dxf"])[1])

    def test_compare(self):
        (self.root / "twice.csv").write_text("0,0\n1,0\n1,0\n2,1\n2,3\n0,4\n")
        warnings, count = self.judge(["compare", "twice.csv"])
        self.assertTrue(warnings and count >= 2)
        self.judge(["compare", EXAMPLES / "series10.csv", "--continuity", "G2"])

    def test_compared_curves(self):
        rows = (EXAMPLES / "naca2412.dat").read_text().splitlines()
        large = [" ".join(f"{100 * float(value):.17g}" for value in row.split()) for row in rows[1:] if row.split()]
        (self.root / "large.dat").write_text("\n".join([rows[0], *large]) + "\n")
        self.judge(["compare", EXAMPLES / "naca2412.dat", "large.dat"])

    def test_region(self):
        for more in ([], ["--insert", "9"], ["--construction", "arcs"], ["--construction", "parabolas"]):
            with self.subTest(more):
                self.assertTrue(self.judge(["region", EXAMPLES / "series10.csv", *more])[1] >= 6)

    def test_alignment(self):
        (self.root / "survey.csv").write_text((EXAMPLES / "road_survey.csv").read_text() +
                                              (EXAMPLES / "road_survey.csv").read_text().splitlines()[-1] + "\n")
        (self.root / "levels.csv").write_text((EXAMPLES / "road_levels.csv").read_text())
        warnings, count = self.judge(["alignment", "survey.csv", "--noise", "0.008", "--station", "12000", "--profile", "levels.csv",
                                      "--profile-noise", "0.012"])
        self.assertTrue(warnings and count >= 5)

    def test_cut(self):
        warnings, count = self.judge(["cut", EXAMPLES / "plate.dxf", "--depth", "1"])
        self.assertTrue(warnings and count >= 3)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
