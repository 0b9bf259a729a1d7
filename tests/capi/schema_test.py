#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Options and reports of every job are what docs/schema says; names are those of the command line and
of the contour file.

usage: schema_test.py LIBRARY PROGRAM SOURCE_FOLDER
"""
import copy
import ctypes as C
import glob
import json
import os
import re
import sys
import tempfile
import unittest

import jsonschema

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import c_interface_test as c  # noqa: E402  (takes the same arguments)

FOLDER = os.path.join(c.SOURCES, "docs/schema")
# Options of the command line that say what is done with a result, not what it is.
FOR_PEOPLE = {"help", "output", "json", "quiet", "no-progress", "csv", "suggest", "flat", "format", "deviations",
              "profile", "profile-table"}


def schemas():
    out = {}
    for path in sorted(glob.glob(os.path.join(FOLDER, "*.schema.json"))):
        with open(path, encoding="utf-8") as file:
            out[os.path.basename(path)] = json.load(file)
    return out


ALL = schemas()


def validator(schema):
    resolver = jsonschema.RefResolver(schema.get("$id", ""), schema, store=dict(ALL))
    return jsonschema.Draft202012Validator(schema, resolver=resolver)


def faults(name, value):
    return [f"{'/'.join(map(str, e.absolute_path))}: {e.message[:200]}"
            for e in validator(ALL[name + ".schema.json"]).iter_errors(value)]


def job_schema(job):
    return {"$id": "options.schema.json", "$defs": ALL["options.schema.json"]["$defs"],
            "$ref": f"#/$defs/jobs/{job}"}


def names_of(job):
    return set(ALL["options.schema.json"]["$defs"]["jobs"][job]["properties"])


def report_of(work):
    """The report of a call, of one that fails with its report, too."""
    try:
        return json.loads(work())
    except c.Failed as failed:
        if failed.report is None:
            raise
        return json.loads(failed.report)


def example(name):
    return os.path.join(c.SOURCES, "examples", name)


SQUARE = "x,y\n" + "".join(f"{x},{y}\n" for x, y in [
    (0, 0), (1, 0), (2, 0), (3, 0), (3, 1), (3, 2), (3, 3), (2, 3), (1, 3), (0, 3), (0, 2), (0, 1), (0, 0)])
PAPER = example("paper_series10.csv")
DRAWN = ('<svg xmlns="http://www.w3.org/2000/svg"><path d="M0 0H40V30H0Z"/>'
         '<path d="M0 50C10 90 30 20 60 60"/></svg>')
ROAD = """<LandXML><Units><Metric linearUnit="meter"/></Units><Alignments><Alignment name="A" staStart="1500">
<CoordGeom><Line><Start>0 0</Start><End>0 100</End></Line></CoordGeom></Alignment></Alignments></LandXML>"""
TRACK = ('<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1"><trk><trkseg>' + "".join(
    f'<trkpt lat="50.0{i}" lon="30.0{i * i}"/>' for i in range(1, 6)) + "</trkseg></trk></gpx>")


def grid():
    return c.surface("grid", [c.read(example("surfaces/wavy_grid.csv"))])[0]


def kinds_of_surfaces():
    """Words of the table of kinds."""
    with open(os.path.join(c.SOURCES, "include/obvid/pipeline/surface_kinds.inc"), encoding="utf-8") as table:
        return re.findall(r'^OBVID_SURFACE_KIND\(\w+, "(\w+)"', table.read(), re.MULTILINE)


class TheSchemas(unittest.TestCase):
    def test_are_schemas_with_a_title(self):
        self.assertGreater(len(ALL), 12)
        for name, schema in ALL.items():
            jsonschema.Draft202012Validator.check_schema(schema)
            self.assertTrue(schema["title"], name)
            self.assertEqual(schema["$id"], name)

    def test_share_what_the_contour_file_and_the_report_share(self):
        part = "parts.schema.json#/$defs/"
        for name in ("fit", "contour"):
            properties = ALL[name + ".schema.json"]["properties"]
            self.assertEqual(properties["report"], {"$ref": part + "fit_report"})
            self.assertEqual(properties["certificate"], {"$ref": part + "certificate"})
            self.assertEqual(properties["carrier"], {"$ref": part + "carrier"})

    def test_see(self):
        """A report with another name, without one, or with another type is refused."""
        good = json.loads(c.fit(c.read(c.SERIES))[1])
        self.assertEqual(faults("fit", good), [])
        for doctor in (lambda r: r.update(extra=1), lambda r: r.pop("units"),
                       lambda r: r.update(pieces="nine"), lambda r: r.update(carrier="splines"),
                       lambda r: r["report"].update(width=1), lambda r: r["certificate"].pop("proved"),
                       lambda r: r["certificate"]["monotone"][0].update(verdict="rising")):
            bad = copy.deepcopy(good)
            doctor(bad)
            self.assertNotEqual(faults("fit", bad), [])


class Reports(unittest.TestCase):
    def holds(self, name, value):
        self.assertEqual(faults(name, value), [])

    def test_of_fit_and_contour_files(self):
        inputs = [c.SERIES, c.DRAWING]
        for path in inputs:
            for options in ({}, {"carrier": "arcs", "tolerance": 0.01}, {"carrier": "baseline"}, {"carrier": "cubic"},
                            {"carrier": "clothoids"}, {"noise": 0.05, "heading-at": {"3": "0..90"}},
                            {"continuity": "G2"}):
                try:
                    contour, report = c.fit(c.read(path), options)
                except c.Failed as failed:
                    self.assertEqual(failed.category, 4, failed)  # no such contour: nothing to look at
                    continue
                self.holds("fit", json.loads(report))
                text = c.export(contour, "json")
                self.holds("contour", json.loads(text))
                self.holds("verify", report_of(lambda: self.verified(contour)))
                c.lib.obvid_contour_free(contour)
        for options in ({"construction": "arcs", "tolerance": 0.05}, {"construction": "parabolas"}):
            self.holds("fit", json.loads(c.fit(c.read(c.SERIES), options)[1]))
        self.holds("fit", json.loads(c.fit(c.text_input(SQUARE))[1]))

    @staticmethod
    def verified(contour):
        report = C.c_void_p()
        return c.call(c.lib.obvid_verify, contour, None, C.byref(report), report=report)

    def test_of_stored_contours(self):
        seen = 0
        for path in glob.glob(os.path.join(c.SOURCES, "tests/data/contours/*.json")):
            with open(path, encoding="utf-8") as file:
                self.holds("contour", json.load(file))
            contour = c.stored(c.read(path))
            self.holds("verify", report_of(lambda: self.verified(contour)))
            seen += 1
        self.assertGreater(seen, 3)
        drawn = c.stored(c.read(c.DRAWING))
        text = json.loads(c.export(drawn, "json"))
        self.assertEqual(text["carrier"], "imported")
        self.holds("contour", text)
        self.holds("verify", report_of(lambda: self.verified(drawn)))

    def test_of_the_points(self):
        for handle in (c.read(c.SERIES), c.text_input(SQUARE), c.points(c.wave(40))):
            self.holds("analyse", json.loads(c.job("analyse", handle)))
            self.holds("series", json.loads(c.job("series", handle)))
            self.holds("region", json.loads(c.job("region", handle)))
            self.holds("compare", json.loads(c.job("compare", handle)))
            self.holds("suggest", json.loads(c.job("suggest", handle)))
        for handle in (c.read(c.DRAWING), c.text_input(DRAWN, "drawn.svg")):
            found = json.loads(c.job("analyse", handle))
            self.holds("analyse", found)
            self.assertTrue(found["curves"])
        self.assertTrue(any(one["places"] for one in found["curves"]))
        road = json.loads(c.job("analyse", c.text_input(ROAD, "road.xml")))
        self.holds("analyse", road)
        self.assertEqual([one["kind"] for one in road["curves"][0]["elements"]], ["line"])
        self.assertEqual(road["curves"][0]["elements"][0]["station"], 1500)
        track = json.loads(c.job("analyse", c.text_input(TRACK, "track.gpx")))
        self.holds("analyse", track)
        self.assertTrue(track["series"])

    def test_of_constructions(self):
        for options in ({"construction": "arcs", "insert": [9]}, {"construction": "ellipses"},
                        {"construction": "parabolas", "fixation": 1, "prefer": "neighbours"},
                        {"construction": "clothoids"}, {"tolerance": 0.1, "end-radius": -900}):
            self.holds("region", json.loads(c.job("region", c.read(PAPER), options)))

    def test_of_what_is_not_there(self):
        with self.assertRaises(c.Failed) as caught:
            c.job("why_not", c.read(c.SERIES), {"start-heading": 170, "end-heading": 10})
        self.holds("why_not", json.loads(caught.exception.report))

    def test_of_curves_in_space(self):
        for handle, options in ((c.space_points(c.rail()), {}), (c.space_points(c.cone()), {"along": "Z"})):
            space, report = c.fit_space(handle, options)
            self.holds("fit_space", json.loads(report))
            out = C.c_void_p()
            self.holds("verify_space", json.loads(
                c.call(c.lib.obvid_verify_space, space, None, C.byref(out), report=out)))
            c.lib.obvid_space_free(space)

    def test_of_audits_in_space(self):
        knots, xyz, out = (C.c_double * 6)(0, 0, 0, 1, 1, 1), (C.c_double * 9)(0, 0, 0, 1, 2, 0, 2, 0, 1), C.c_void_p()
        self.holds("space_audit", json.loads(c.call(c.lib.obvid_space_audit, 2, C.c_size_t(3), knots, xyz, None, None,
                                                    C.byref(out), report=out)))

    def test_of_surfaces(self):
        for kind, paths, options, _ in c.Surfaces("kinds").kinds():
            handle, report, _ = c.surface(kind, [c.read(path) for path in paths], options)
            self.holds("surface_make", json.loads(report))
            c.lib.obvid_surface_free(handle)
        handle = grid()
        out, files = C.c_void_p(), C.c_void_p()
        self.holds("surface_check", json.loads(c.call(
            c.lib.obvid_surface_check, handle, None, None, C.byref(out), report=out)))
        out = C.c_void_p()
        where = json.dumps({"waterlines": "count:3", "plane": ["1,0,1,20", "0,1,0,10"], "draught": 1.0}).encode()
        self.holds("surface_cut", json.loads(c.call(
            c.lib.obvid_surface_cut, handle, where, None, C.byref(files), C.byref(out), report=out)))
        out, files = C.c_void_p(), C.c_void_p()
        plan = json.dumps({"diameter": 6, "scallop": 0.1, "tolerance": 0.02}).encode()
        self.holds("surface_toolpath", report_of(lambda: c.call(
            c.lib.obvid_surface_toolpath, handle, plan, None, C.byref(files), C.byref(out), report=out)))

    def test_of_curves_over_each_other(self):
        pair = (C.c_void_p * 2)(c.read(example("naca2412.dat")).value, c.read(example("wing_template.dat")).value)
        for options in (b'{"noise": "rounding"}', b'{"noise": "rounding", "align": "chord"}'):
            text = C.c_void_p()
            self.holds("compare_curves", json.loads(c.call(c.lib.obvid_compare_curves, pair, C.c_size_t(2), options, None,
                                                           None, C.byref(text), report=text)))

    def test_of_splines_and_control_points(self):
        grid_table = "x,y,f\n0,0,0\n1,0,1\n0,1,1\n1,1,2\n"
        for text, options in (("x,f\n0,0\n1,1\n2,0\n", None), ("x,f\n0,0\n1,1\n2,0\n", b'{"compare": true}'),
                              ("x,y,z\n0,0,0\n1,1,0\n2,0,1\n", b'{"curve": true}'), (grid_table, None)):
            out = C.c_void_p()
            self.holds("spline", json.loads(c.call(c.lib.obvid_spline, c.text_input(text), None, options, None, None, None,
                                                   None, C.byref(out), report=out)))
        for text in ("x,y\n0,0\n1,2\n3,3\n", "row,col,x,y,z\n0,0,0,0,0\n0,1,1,0,1\n1,0,0,1,0\n1,1,1,1,3\n"):
            out = C.c_void_p()
            self.holds("nurbs_make", json.loads(c.call(c.lib.obvid_nurbs_make, c.text_input(text), None, None, None, None,
                                                       None, C.byref(out), report=out)))

    def test_of_cutting(self):
        inputs = (C.c_void_p * 1)(c.read(example("plate.dxf")).value)
        files, out = C.c_void_p(), C.c_void_p()
        self.holds("cut", json.loads(c.call(c.lib.obvid_cut, inputs, C.c_size_t(1), b'{"diameter": 3, "depth": 5}', None,
                                            C.byref(files), C.byref(out), report=out)))

    def test_of_an_alignment(self):
        files, out = C.c_void_p(), C.c_void_p()
        self.holds("alignment", json.loads(c.call(
            c.lib.obvid_alignment, c.read(example("road_survey.csv")), c.read(example("road_levels.csv")),
            b'{"noise": 0.02, "profile-noise": "auto", "station": 12000, "lateral-acceleration": 1}', None, None,
            C.byref(files), C.byref(out), report=out)))

    def test_every_job_with_a_report_has_a_schema(self):
        with open(os.path.join(c.SOURCES, "include/obvid/obvid.h"), encoding="utf-8") as header:
            declared = re.findall(r"OBVID_API int obvid_(\w+)\(([^;]*)\);", header.read())
        reporting = {name for name, arguments in declared if "char** report" in arguments}
        self.assertGreater(len(reporting), 10)
        self.assertEqual({name for name in reporting if name + ".schema.json" not in ALL}, set())


class Options(unittest.TestCase):
    """Every job tells the names that it knows when it is given another."""

    def told(self, work):
        with self.assertRaises(c.Failed) as caught:
            work(b'{"zzzzzzzzzzzz": 1}')
        self.assertEqual(caught.exception.code, 201)
        said = re.fullmatch("available are (.*)", caught.exception.advice)
        self.assertTrue(said, caught.exception.advice)
        return set(said[1].split(", "))

    def jobs(self):
        points, text, out = c.read(c.SERIES), C.c_void_p(), C.c_void_p()
        contour, drawn = c.fit(points)[0], c.read(c.DRAWING)
        space, surface = c.fit_space(c.space_points(c.rail()))[0], grid()
        inputs = (C.c_void_p * 1)(c.read(example("surfaces/wavy_grid.csv")).value)
        lib, ref = c.lib, C.byref
        yield "fit", lambda o: c.call(lib.obvid_fit, points, o, None, None, None)
        for name in ("why_not", "suggest", "series", "analyse", "region", "compare"):
            yield name, lambda o, name=name: c.call(getattr(lib, "obvid_" + name), points, o, None, ref(text))
        for name in ("why_not_file", "suggest_file", "analyse_file", "compare_file"):
            yield name, lambda o, name=name: c.call(getattr(lib, "obvid_" + name), points, o, b"svg", None, ref(out))
        yield "worksheet", lambda o: c.call(lib.obvid_worksheet, points, o, b"csv", None, ref(out))
        yield "stored", lambda o: c.call(lib.obvid_stored, drawn, o, None, ref(out))
        yield "export", lambda o: c.call(lib.obvid_export, contour, b"dxf", o, None, ref(out))
        yield "fit_space", lambda o: c.call(lib.obvid_fit_space, c.space_points(c.rail()), o, None, None, None)
        yield "space_export", lambda o: c.call(lib.obvid_space_export, space, b"dxf", o, None, ref(out))
        yield "surface_make", lambda o: c.call(lib.obvid_surface_make, b"grid", inputs, C.c_size_t(1), None, C.c_size_t(0),
                                               o, None, ref(out), ref(text))
        yield "surface_export", lambda o: c.call(lib.obvid_surface_export, surface, b"stl", o, None, ref(out))
        yield "surface_check", lambda o: c.call(lib.obvid_surface_check, surface, o, None, ref(text))
        yield "surface_check_file", lambda o: c.call(lib.obvid_surface_check_file, surface, o, b"svg", None, ref(out))
        yield "surface_branches", lambda o: c.call(lib.obvid_surface_branches, surface, o, b"csv", None, ref(out))
        yield "alignment", lambda o: c.call(lib.obvid_alignment, points, None, o, None, None, ref(out), ref(text))
        yield "compare_curves", lambda o: c.call(lib.obvid_compare_curves, inputs, C.c_size_t(1), o, None, ref(out), ref(text))
        yield "spline", lambda o: c.call(lib.obvid_spline, points, None, o, None, None, None, None, ref(text))
        yield "nurbs_make", lambda o: c.call(lib.obvid_nurbs_make, points, o, None, None, None, None, ref(text))
        yield "cut", lambda o: c.call(lib.obvid_cut, inputs, C.c_size_t(1), o, None, ref(out), ref(text))
        yield "surface_cut", lambda o: c.call(lib.obvid_surface_cut, surface, o, None, ref(out), ref(text))
        yield "surface_toolpath", lambda o: c.call(lib.obvid_surface_toolpath, surface, o, None, ref(out), ref(text))

    def test_of_every_job_are_those_of_its_schema(self):
        seen = set()
        for name, work in self.jobs():
            with self.subTest(job=name):
                self.assertEqual(self.told(work), names_of(name))
            seen.add(name)
        self.assertEqual(seen, set(ALL["options.schema.json"]["$defs"]["jobs"]))

    def test_have_the_names_of_the_command_line(self):
        def typed(*command):
            text, _ = c.program(*command, "--help")
            return set(re.findall(r"^ +(?:-\w,)?--([a-z-]+)", text, re.MULTILINE)) - FOR_PEOPLE

        commands = {("fit",): names_of("fit") | names_of("fit_space") | names_of("export"),
                    ("convert",): names_of("stored") | names_of("export"),
                    ("surface", "grid"): names_of("surface_make") | names_of("surface_export"),
                    ("surface", "skin"): names_of("surface_make") | names_of("surface_export"),
                    ("surface", "check"): names_of("surface_check") | names_of("surface_export"), ("surface", "cut"): names_of("surface_cut"),
                    ("cut",): names_of("cut"), ("alignment",): names_of("alignment"),
                    ("toolpath",): names_of("surface_toolpath") | names_of("surface_export"),
                    ("region",): names_of("region"), ("compare",): names_of("compare_curves") | names_of("export"),
                    ("analyse",): names_of("analyse") | names_of("export"), ("verify",): set(),
                    ("spline",): names_of("spline") | {"against"}, ("nurbs",): names_of("nurbs_make")}
        every = set()
        for command, known in commands.items():
            with self.subTest(command=command):
                self.assertEqual(typed(*command) - known, set())
        for command in [("fit",), ("region",), ("compare",), ("convert",), ("toolpath",), ("cut",), ("alignment",), ("spline",),
                        ("nurbs",),
                        ("surface", "check"), ("surface", "cut")] + [
                ("surface", kind) for kind in kinds_of_surfaces()]:
            every |= typed(*command)
        self.assertEqual(typed("fit"), commands[("fit",)])
        ours = set(ALL["options.schema.json"]["$defs"]["options"])
        self.assertEqual(ours - every, set())

    def test_values_of_other_types_are_refused_by_both(self):
        for name, value in (("noise", True), ("tolerance", "wide"), ("closed", "yes"), ("corner-at", 3),
                            ("heading-at", [1]), ("carrier", 7), ("construction", "hyperbolas")):
            self.assertFalse(validator(job_schema("fit")).is_valid({name: value}), name)
            with self.assertRaises(c.Failed) as caught:
                c.fit(c.read(c.SERIES), {name: value})
            self.assertEqual(caught.exception.category, 2, name)

    def test_that_the_tests_use_are_valid(self):
        for options in ({"start-heading": 30, "noise": 0.05}, {"radius-at": {"3": 50}, "noise": "rounding", "units": "mm"},
                        {"construction": "parabolas", "fixation": 1, "prefer": "neighbours"}, {"carrier": "arcs"}):
            self.assertEqual(list(validator(job_schema("fit")).iter_errors(options)), [])
            try:
                c.fit(c.read(c.SERIES), options)
            except c.Failed as failed:
                self.assertEqual(failed.category, 4, failed)  # understood, and impossible there

    def test_carriers_are_those_of_the_table(self):
        with open(os.path.join(c.SOURCES, "include/obvid/curve/carriers.inc"), encoding="utf-8") as table:
            names = re.findall(r"^OBVID_CARRIER\w*\(k\w+, (\w+),", table.read(), re.MULTILINE)
        self.assertEqual(ALL["parts.schema.json"]["$defs"]["carrier"]["enum"], names)


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[4:])
