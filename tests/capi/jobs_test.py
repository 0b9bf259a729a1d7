#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""All jobs of the C interface in one table: each is run once, then by two threads at once, and says and
writes what the command line does, byte for byte. The table has every function of obvid.h that takes an
obvid_run, every kind of surface, and every file of formats.inc that the library makes.

usage: jobs_test.py LIBRARY PROGRAM SOURCE_FOLDER
"""
import ctypes as C
import json
import math
import os
import re
import subprocess
import sys
import tempfile
import threading
import unittest

sys.path.insert(0, os.path.dirname(os.path.abspath(__file__)))
import c_interface_test as c  # noqa: E402  (takes the same arguments)

lib = c.lib
lib.obvid_files_suffix.restype = C.c_char_p
FOLDER = tempfile.TemporaryDirectory()
HELPER = os.path.join(os.path.dirname(os.path.abspath(c.LIBRARY)), "obvid-cad")
# Of the table of formats, what the library leaves to the command line: pages that hold what its
# terminal says. docs/c.md names them.
PAGES = {("cut", "html"), ("alignment", "html"), ("tables", "html")}


def at(name):
    return os.path.join(FOLDER.name, name)


def written(name, text):
    os.makedirs(os.path.dirname(at(name)), exist_ok=True)
    with open(at(name), "w", encoding="utf-8") as file:
        file.write(text)
    return at(name)


def example(name):
    return os.path.join(c.SOURCES, "examples", name)


# ---- the tables of the project -----------------------------------------------------------------
def source(name):
    with open(os.path.join(c.SOURCES, name), encoding="utf-8") as file:
        return file.read()


def formats():
    """Pairs of a column of formats.inc and the first extension of a format that it has."""
    out = []
    for endings, words in re.findall(r'^OBVID_FORMAT\(\w+,\s*"\.(\S+?)[ "][^,]*,[^.]*(.*)\)$',
                                     source("include/obvid/pipeline/formats.inc"), re.MULTILINE):
        out += [(column, endings) for column in re.findall(r"\.(\w+) = ", words)
                if column not in ("rule", "files")]
    return out


def endings(column):
    return [ending for name, ending in formats() if name == column and (name, ending) not in PAGES]


def kinds():
    return re.findall(r'^OBVID_SURFACE_KIND\(\w+, "(\w+)"', source("include/obvid/pipeline/surface_kinds.inc"),
                      re.MULTILINE)


def functions():
    """Those of obvid.h that are told of a run."""
    return set(re.findall(r"OBVID_API[^;(]*?(obvid_\w+)\([^;]*?const obvid_run\* run[^;]*;",
                          source("include/obvid/obvid.h")))


# ---- calls -------------------------------------------------------------------------------------
USED = set()


def asked(options):
    return None if options is None else json.dumps(options).encode()


def texts(files):
    """Files by their suffixes."""
    out, size = {}, C.c_size_t()
    for i in range(lib.obvid_files_count(files)):
        data = lib.obvid_files_data(files, C.c_size_t(i), C.byref(size))
        out[lib.obvid_files_suffix(files, C.c_size_t(i)).decode()] = C.string_at(data, size.value)
    lib.obvid_files_free(files)
    return out


def call(name, *arguments):
    """Results of a call by their kinds, and its code: `arguments` are those before the error, results named by
    "report", "files", or by what frees them."""
    USED.add("obvid_" + name)
    results = {one: C.c_void_p() for one in arguments if isinstance(one, str)}
    given = [C.byref(results[one]) if isinstance(one, str) else one for one in arguments]
    code = getattr(lib, "obvid_" + name)(*given, None)
    out = {"code": code}
    for kind, handle in results.items():
        if kind == "report" and handle.value:
            out[kind] = C.string_at(handle.value)
            lib.obvid_free(handle)
        elif kind == "files" and handle.value:
            out[kind] = texts(handle)
        elif handle.value:
            out[kind] = handle
    return out


def said(result):
    """What a call says: report, or the one file, else its code."""
    if result["code"] not in (0,) and "report" not in result and "files" not in result:
        return b"E%d" % result["code"]
    if "report" in result:
        return result["report"]
    (text,) = result["files"].values()
    return text


def exported(function, handle, column, options=None):
    out = {}
    for ending in endings(column):
        got = call(function, handle, ending.encode(), asked(options), None, "files")
        if got["code"]:
            out[ending] = b"E%d" % got["code"]
        for suffix, text in got.get("files", {}).items():
            out[f"{suffix}.{ending}" if suffix else ending] = text
    return out


class Job:
    """`make()` gives texts by keys; `theirs` has for each key the command and the file that it writes, None: what it
    prints."""

    def __init__(self, name, make, theirs, column=None):
        self.name, self.make, self.theirs, self.column = name, make, theirs, column


class Theirs(dict):
    argv, endings = (), ()  # a command and what it can be asked for at once

    def make_at_once(self, ours):
        """Files of one command for all: a refused one, which is asked for by a command of its own, would refuse all."""
        paths = [self[one][1] for one in self.endings if self[one][1] and not re.fullmatch(rb"E\d+", ours.get(one, b""))]
        if len(paths) > 1:
            subprocess.run([c.PROGRAM, *self.argv, *(word for path in paths for word in ("-o", path))], capture_output=True,
                           timeout=120)
        return sum(os.path.exists(path) for path in paths)


def theirs(argv, keys, report=True, stem=None):
    """For a report what is printed with --json, for files those of one command."""
    stem = stem or "file"
    out = Theirs({"report": (argv + ["--json"], None)} if report else {})
    out.argv, out.endings = argv, keys
    for number, ending in enumerate(keys):
        folder = f"{stem}-{number}"
        os.makedirs(at(folder), exist_ok=True)
        out[ending] = (argv + ["-o", at(f"{folder}/x.{ending}")], at(f"{folder}/x.{ending}"))
    return out


def of_contour(name, make, argv, column="contour", report=True):
    """`make()` gives the contour and the report of a job, which are written in all formats."""
    def work():
        got = make()
        out = exported("export", got["contour"], "contour")
        if report:
            out["report"] = got["report"]
        out.update({suffix: text for suffix, text in got.get("more", {}).items()})
        lib.obvid_contour_free(got["contour"])
        return out
    return Job(name, work, theirs(argv, endings("contour"), report, name.replace(" ", "_")), column)


def on_input(name, function, path, options, argv, ending=None):
    """A report on an input, or a file of it."""
    def work():
        handle = c.read(path)
        if ending is None:
            got = call(function, handle, asked(options), None, "report")
        else:
            got = call(function, handle, asked(options), ending.encode(), None, "files")
        lib.obvid_input_free(handle)
        return {ending or "report": said(got)}
    keys = [] if ending is None else [ending]
    return Job(name, work, theirs(argv, keys, ending is None, name.replace(" ", "_")),
               "tables" if function in ("analyse_file", "compare_file") else None)


def typed(options):
    return [word for name, value in options.items()
            for word in ([f"--{name}"] if value is True else [f"--{name}", str(value)])]


# ---- inputs ------------------------------------------------------------------------------------
NACA, SERIES, SURVEY, PLATE = (example(name) for name in ("naca2412.dat", "series10.csv", "road_survey.csv", "plate.dxf"))
WAVY = example("surfaces/wavy_grid.csv")


def files_of_inputs():
    """Written once: named series, drawings, curves and surfaces."""
    written("track.gpx", '<gpx version="1.1" xmlns="http://www.topografix.com/GPX/1/1"><trk><name>Loop</name><trkseg>' +
            "".join(f'<trkpt lat="50.0{i}" lon="30.0{i * i}"/>' for i in range(1, 8)) + "</trkseg></trk></gpx>")
    written("named.svg", '<svg xmlns="http://www.w3.org/2000/svg"><path id="rim" d="M0 0C10 40 30 -20 60 10"/></svg>')
    written("rail.csv", c.table(c.rail()))
    for folder, height in (("a", 12), ("b", 13)):
        written(f"{folder}/x.dat", "x\n" + "".join(
            f"{x / 10!r} {s * height / 100 * math.sqrt(x / 10) * (1 - x / 10)!r}\n"
            for s, row in ((1, range(10, -1, -1)), (-1, range(1, 11))) for x in row))
    for number in (0, 10, 20):
        written(f"u{number}.csv", c.table([(x, number, 0.1 * x * number) for x in range(0, 31, 5)]))
    for number in (0, 15, 30):
        written(f"v{number}.csv", c.table([(number, y, 0.1 * number * y) for y in range(0, 21, 5)]))
    plates = [{"name": name, "degree_u": 1, "degree_v": 1, "knots_u": [0, 0, 1, 1], "knots_v": [0, 0, 1, 1],
               "points": rows} for name, rows in
              (("floor", [[0, 0, 0], [10, 0, 0], [0, 20, 0], [10, 20, 0]]),
               ("wall", [[10, 0, 0], [13, 0, 8], [10, 20, 0], [13, 20, 8]]))]
    written("two.json", json.dumps({"format": "obvid-surface", "version": 1, "name": "two", "units": "mm",
                                    "units_source": "file", "patches": plates}))
    written("t.csv", "x,f\n0,0\n1,0.84\n2,0.9\n3,0.14\n")
    written("g.csv", "x,y,f\n0,0,0\n1,0,1\n2,0,4\n0,1,1\n1,1,2\n2,1,5\n")
    written("c.csv", "x,y\n0,0\n1,2\n3,3\n5,3\n7,2\n8,0\n")
    written("n.csv", "row,col,x,y,z\n0,0,0,0,0\n0,1,1,0,1\n1,0,0,1,0\n1,1,1,1,3\n")
    for argv in (["fit", SERIES, "-o", at("contour.json")], ["fit", at("rail.csv"), "-o", at("rail.json")],
                 ["surface", "grid", WAVY, "-o", at("wavy.json")]):
        subprocess.run([c.PROGRAM, *argv], check=True, capture_output=True, timeout=120)


# ---- the table ---------------------------------------------------------------------------------
def fitted(path, options):
    def make():
        handle = c.read(path)
        got = call("fit", handle, asked(options), None, "contour", "report")
        lib.obvid_input_free(handle)
        return got
    return make


def taken(path, options=None):
    def make():
        handle = c.read(path)
        got = call("stored", handle, asked(options), None, "contour")
        lib.obvid_input_free(handle)
        return got
    return make


def contours():
    for name, path, options in (("fit an airfoil", NACA, {"noise": "rounding"}), ("fit a named track", at("track.gpx"), {}),
                                ("fit clothoids", SERIES, {"carrier": "clothoids"}),
                                ("fit a named path", at("named.svg"), {"drawing": "points"}),
                                ("fit arcs", SERIES, {"carrier": "arcs", "tolerance": 0.01, "units": "mm"}),
                                ("fit a construction", SERIES, {"construction": "clothoids"})):
        yield of_contour(name, fitted(path, options), ["fit", path, *typed(options)])
    for name, path, options in (("convert a path", at("named.svg"), {}), ("convert a contour", at("contour.json"), {}),
                                ("place a contour", at("contour.json"), {"scale": 2, "units": "mm"})):
        yield of_contour(name, taken(path, options), ["convert", path, *typed(options)], report=False)

    def proved(key):
        def work():
            contour = taken(at("contour.json"))()["contour"]
            got = (call("verify", contour, None, "report") if key == "report"
                   else call("verify_file", contour, key.encode(), None, "files"))
            lib.obvid_contour_free(contour)
            return {key: said(got)}
        return work
    verify = ["verify", at("contour.json")]
    yield Job("verify", proved("report"), theirs(verify, []))
    for ending in endings("proof"):
        yield Job("verify " + ending, proved(ending), theirs(verify, [ending], False, "verify"), "proof")


def alignment():
    options = {"noise": 0.02, "profile-noise": "auto", "station": 12000, "lateral-acceleration": 1}

    def work():
        handle, levels = c.read(SURVEY), c.read(example("road_levels.csv"))
        got = call("alignment", handle, levels, asked(options), None, "contour", "files", "report")
        out = exported("export", got["contour"], "contour")
        tables = got["files"]
        out.update({"csv": tables[".csv"], "svg": tables[".svg"], "report": got["report"]})
        del out["html"]
        lib.obvid_contour_free(got["contour"])
        return out
    argv = ["alignment", SURVEY, *typed(options), "--profile", example("road_levels.csv")]
    keys = [one for one in endings("contour") if one != "html"]
    return Job("alignment", work, theirs(argv, keys, True, "alignment"), "alignment")


def space():
    def work():
        handle = c.read(at("rail.csv"))
        got = call("fit_space", handle, None, None, "space", "report")
        out = {"report": got["report"], **exported("space_export", got["space"], "space")}
        return out
    yield Job("fit in space", work, theirs(["fit", at("rail.csv")], endings("space"), True, "space"), "space")

    def verified():
        handle, chain = c.read(at("rail.json")), C.c_void_p()
        assert lib.obvid_stored_space(handle, C.byref(chain), None) == 0
        return {"report": said(call("verify_space", chain, None, "report"))}
    def audited():
        knots, xyz = (C.c_double * 6)(0, 0, 0, 1, 1, 1), (C.c_double * 9)(0, 0, 0, 1, 2, 0, 2, 0, 1)
        return {"report": said(call("space_audit", 2, C.c_size_t(3), knots, xyz, None, None, "report"))}
    yield Job("audit in space", audited, {})  # no command has it
    yield Job("verify in space", verified, theirs(["verify", at("rail.json")], []))


def made(kind, paths, options, across=()):
    def some(names):
        return (C.c_void_p * len(names))(*[c.read(name).value for name in names]), C.c_size_t(len(names))
    return call("surface_make", kind.encode(), *some(paths), *some(across), asked(options), None, "surface", "report")


def surfaces():
    edges = [example("surfaces/board_lower.csv"), example("surfaces/board_upper.csv")]
    us, vs = ([at(f"{name}{k}.csv") for k in places] for name, places in (("u", (0, 10, 20)), ("v", (0, 15, 30))))
    two, wavy = at("two.json"), at("wavy.json")
    for kind, paths, across, options in (
            ("skin", [example("surfaces/wigley_stations.csv")], [], {"noise": "rounding"}),
            ("ruled", edges, [], {"match": "length"}), ("revolve", [example("surfaces/vase_profile.csv")], [], {"axis": "z"}),
            ("coons", [us[0], vs[2], us[2], vs[0]], [], {}), ("gordon", us, vs, {}),
            ("grid", [WAVY], [], {"near": True, "tolerance": 0.01}), ("id", [WAVY], [], {"smooth": True}),
            ("scatter", [WAVY], [], {"tolerance": 0.1, "up": "z"}), ("offset", [wavy], [], {"distance": 0.5}),
            ("trim", [wavy], [], {"plane": "x=10", "keep": "below"}),
            ("fillet", [two], [], {"faces": "1,2", "radius": 2}),
            ("match", [two], [], {"border": "2:u0", "to": "1:u1", "join": "G2"}), ("convert", [wavy], [], {})):
        def work(kind=kind, paths=paths, across=across, options=options):
            got = made(kind, paths, options, across)
            return {"report": got["report"], **exported("surface_export", got["surface"], "surface")}
        argv = ["surface", kind, *paths, *(["--across", *across] if across else []), *typed(options)]
        yield Job("surface " + kind, work, theirs(argv, endings("surface"), True, "surface_" + kind), "surface")


def on_surfaces():
    wavy = at("wavy.json")

    def handle():
        return made("convert", [wavy], None)["surface"]

    def on(name, work, argv, keys, report=True, column=None):
        return Job(name, lambda: work(handle()), theirs(argv, keys, report, name.replace(" ", "_")), column)
    checked = {"samples": 20}
    yield on("check", lambda h: {"report": said(call("surface_check", h, asked(checked), None, "report"))},
             ["surface", "check", wavy, *typed(checked)], [])
    for against in ({}, {"against": WAVY}):
        options = {**checked, **against, "colour": "gaussian"}
        for ending in endings("check"):
            yield on(f"check {ending}{' against' if against else ''}", lambda h, o=options, e=ending: {e: said(
                call("surface_check_file", h, asked(o), e.encode(), None, "files"))},
                ["surface", "check", wavy, *typed(options)], [ending], False, "check")
    where = {"plane": "1,0,0,40", "waterlines": "count:2", "draught": 3}

    def cut(h):
        got = call("surface_cut", h, asked(where), None, "files", "report")
        return {"report": got["report"], **{suffix[1:]: text for suffix, text in got["files"].items()}}
    argv = ["surface", "cut", wavy, *typed(where)]
    yield on("sections", cut, argv, endings("sections"), True, "sections")
    for ending, more in (("csv", {}), ("step", {"fair": 0.05}), ("sldcrv", {"fair": 0.05}), ("json", {"fair": 0.05})):
        options = {"waterlines": "count:3", **more}

        def branches(h, ending=ending, options=options):
            got = call("surface_branches", h, asked(options), ending.encode(), None, "files")
            assert len(got["files"]) > 1, got
            return {f"{suffix}.{ending}": text for suffix, text in got["files"].items()}
        job = on(f"branches {ending}", branches, [], [])
        job.theirs = BranchFiles(["surface", "cut", wavy, *typed(options)], f"branches_{ending}", ending)
        yield job
    plan = {"diameter": 6, "scallop": 0.2, "tolerance": 0.05, "view": "top"}

    def milled(h):
        got = call("surface_toolpath", h, asked(plan), None, "files", "report")
        return {"report": got["report"], **{suffix[1:] or "nc": text for suffix, text in got["files"].items()}}
    argv = ["toolpath", wavy, *typed(plan)]
    job = on("toolpath", milled, argv, endings("toolpath"), False, "toolpath")
    job.theirs["report"] = (argv + ["-o", at("printed.nc"), "--json"], None)
    yield job


class BranchFiles(dict):
    """Files whose names the command line makes of {id}: known once it has run."""

    def __init__(self, argv, stem, ending):
        super().__init__()
        os.makedirs(at(stem), exist_ok=True)
        subprocess.run([c.PROGRAM, *argv, "-o", at(stem + "/{id}." + ending)], capture_output=True, timeout=120)
        for name in os.listdir(at(stem)):
            self[name] = (None, os.path.join(at(stem), name))


def series():
    """What points and drawings say, and what could be asked for instead."""
    refused = {"start-heading": 170, "end-heading": 10}
    drawing = os.path.join(c.SOURCES, "tests/data/judge/series10.dxf")
    for path in (SERIES, drawing):
        name = os.path.basename(path)
        yield on_input("analyse " + name, "analyse", path, None, ["analyse", path])
        for ending in endings("tables"):
            if (path, ending) != (SERIES, "svg"):
                yield on_input(f"analyse {name} {ending}", "analyse_file", path, None, ["analyse", path], ending)
    yield on_input("region", "region", SERIES, {"tolerance": 0.1}, ["region", SERIES, "--tolerance", "0.1"])
    for ending in ("csv", "tex", "json", "svg", "dxf", "html"):
        yield on_input("worksheet " + ending, "worksheet", SERIES, {"insert": [3]}, ["region", SERIES, "--insert", "3"], ending)
    yield on_input("compare", "compare", SERIES, {}, ["compare", SERIES])
    for ending in endings("tables"):
        yield on_input("compare " + ending, "compare_file", SERIES, {}, ["compare", SERIES], ending)
    yield on_input("suggest", "suggest", SERIES, {}, ["fit", SERIES, "--suggest"])
    for ending in ("svg", "json"):
        job = on_input("suggest " + ending, "suggest_file", SERIES, {}, ["fit", SERIES, "--suggest"], ending)
        if ending == "json":  # the command line prints it
            job.theirs["json"] = (["fit", SERIES, "--suggest", "--json"], None)
        yield job
    yield on_input("why not", "why_not", SERIES, refused, ["fit", SERIES, *typed(refused)])
    job = on_input("why not svg", "why_not_file", SERIES, refused, ["fit", SERIES, *typed(refused)], "svg")
    argv, name = job.theirs["svg"]
    job.theirs["svg"] = (argv, name.replace(".svg", ".why-not.svg"))
    yield job
    job = on_input("series", "series", SERIES, {}, [])
    job.theirs = {}  # no command prints it alone
    yield job


def several():
    for names in (("a/x.dat", "b/x.dat"), ("naca", "a/x.dat")):
        pair = [NACA if name == "naca" else at(name) for name in names]

        def over(pair=pair):
            inputs = (C.c_void_p * 2)(*[c.read(one).value for one in pair])
            got = call("compare_curves", inputs, C.c_size_t(2), asked({"noise": "rounding"}), None, "files", "report")
            return {"report": got["report"], **{suffix[1:]: text for suffix, text in got["files"].items()}}
        yield Job("compare " + " ".join(names), over, theirs(["compare", *pair, "--noise", "rounding"], endings("tables"), True,
                                                             "over_" + names[0].replace("/", "_")), "tables")
    options = {"diameter": 3, "depth": 6, "pass-depth": 2.5}

    def cut():
        got = call("cut", (C.c_void_p * 1)(c.read(PLATE).value), C.c_size_t(1), asked(options), None, "files", "report")
        return {"report": got["report"], **{suffix[1:] or "nc": text for suffix, text in got["files"].items()}}
    yield Job("cut", cut, theirs(["cut", PLATE, *typed(options)], endings("cut"), True, "cut"), "cut")


def tables():
    def spline(path, ending):
        got = call("spline", c.read(path), None, None, ending and ending.encode(), None, None,
                   "files" if ending else None, None if ending else "report")
        return {ending or "report": said(got)}

    def nurbs(path, ending):
        got = call("nurbs_make", c.read(path), None, ending and ending.encode(), None, None, "files" if ending else None,
                   None if ending else "report")
        return {ending or "report": said(got)}
    for name, path, column in (("spline", at("t.csv"), "spline"), ("spline", at("g.csv"), "graph"), ("nurbs", at("c.csv"), "space"),
                               ("nurbs", at("n.csv"), None)):
        argv, work = [name, path], spline if name == "spline" else nurbs
        yield Job(f"{name} {column}", lambda w=work, p=path: w(p, None), theirs(argv, []))
        for ending in endings(column) if column else ():
            if (name, ending) != ("nurbs", "sldcrv"):
                yield Job(f"{name} {column} {ending}", lambda w=work, p=path, e=ending: w(p, e),
                          theirs(argv, [ending], False, f"{name}_{column}"), column if name == "spline" else None)


def table():
    files_of_inputs()
    return [*contours(), alignment(), *space(), *surfaces(), *on_surfaces(), *series(), *several(), *tables()]


# ---- comparison --------------------------------------------------------------------------------
TIME = re.compile(rb'<tr><th[^>]*>time</th>.*?</tr>\n?')
ASKED = re.compile(rb"<tr><th[^>]*>asked for</th>.*?</tr>\n?", re.DOTALL)


def bare(text, job, key):
    """Without times, names of files and what was typed."""
    text = re.sub(rb'"seconds": [0-9.e+-]+', b'"seconds": 0', text)
    text = re.sub(rb'"written": \[[^\]]*\]', b'"written": []', text)
    if key == "html":
        text = TIME.sub(b"", ASKED.sub(b"", text))
    if job.name == "compare csv":  # its last but one column is the time
        text = re.sub(rb"[^,\n]*(,[^,\n]*\n)", rb"\1", text)
    return text


def command_for(job, key):
    """Command and file of a key; formats of several files have one command for all of them."""
    if key in job.theirs or "." not in key:
        return job.theirs[key]
    suffix, ending = key.rsplit(".", 1)
    argv, path = job.theirs[ending]
    return argv, path.replace(f".{ending}", f"{suffix}.{ending}")


def what_the_program_says(argv, path):
    """Printed, or written; the error where there is neither."""
    there = path is not None and os.path.exists(path)  # by the command for another file of several
    printed = subprocess.run([c.PROGRAM, *argv], capture_output=True, timeout=120) if argv and not there else None
    if path is None:
        return printed.stdout
    if os.path.exists(path):
        with open(path, "rb") as file:
            return file.read()
    code = re.search(rb"error (E\d+)", printed.stderr)
    return code.group(1) if code else printed.stderr


class EveryJob(unittest.TestCase):
    maxDiff = 2000

    @classmethod
    def setUpClass(cls):
        cls.jobs = table()
        cls.once = [job.make() for job in cls.jobs]

    @classmethod
    def tearDownClass(cls):
        FOLDER.cleanup()

    def test_of_the_header_is_in_the_table(self):
        self.assertGreater(len(functions()), 25)
        self.assertEqual(functions() - USED, set())

    def test_of_the_header_is_run_under_the_thread_sanitizer_too(self):
        """And with inputs that are large enough to be ended in the middle: tests/capi/threads."""
        text = source("tests/capi/threads/every_job.cpp")
        self.assertEqual({name for name in functions() if name + "(" not in text and name + "," not in text}, set())
        words = [*kinds(), *endings("contour"), *endings("surface")]
        self.assertEqual({word for word in words if f'"{word}"' not in text}, set())

    def test_makes_all_kinds_of_surfaces(self):
        self.assertEqual({job.name.split()[1] for job in self.jobs if job.name.startswith("surface ")}, set(kinds()))

    def test_writes_all_files_of_the_table_of_formats(self):
        self.assertGreater(len(formats()), 50)
        files = {(job.column, key.rsplit(".", 1)[-1]) for job, made_once in zip(self.jobs, self.once) for key in made_once}
        self.assertEqual({pair for pair in formats() if pair not in PAGES} - files, set())

    def test_says_what_the_command_line_says(self):
        compared = 0
        at_once = sum(job.theirs.make_at_once(ours) for job, ours in zip(self.jobs, self.once) if isinstance(job.theirs, Theirs))
        self.assertGreater(at_once, 200)
        for job, ours in zip(self.jobs, self.once):
            kernel = not os.path.exists(HELPER)
            for key, text in ours.items():
                if not job.theirs or (kernel and text == b"E310"):
                    continue
                with self.subTest(job=job.name, key=key):
                    self.assertTrue(text)
                    told = what_the_program_says(*command_for(job, key))
                    if bare(text, job, key) != bare(told, job, key):
                        show = [bare(one, job, key).decode(errors="replace") for one in (text, told)]
                        first = next((k for k, (a, b) in enumerate(zip(*show)) if a != b), 0)
                        self.fail("\n".join(one[max(first - 60, 0):first + 140] for one in show))
                compared += 1
            with self.subTest(job=job.name):
                missing = set(job.theirs) - set(ours)
                self.assertEqual(missing - {key.rsplit(".", 1)[-1] for key in ours}, set())
        self.assertGreater(compared, 300)

    def test_says_it_from_two_threads_at_once(self):
        faults = []

        def work(order):
            for k in order:
                got = self.jobs[k].make()
                faults.extend((self.jobs[k].name, key) for key in {**got, **self.once[k]}
                              if bare(got.get(key, b""), self.jobs[k], key) != bare(self.once[k].get(key, b""), self.jobs[k], key))
        threads = [threading.Thread(target=work, args=(order,))
                   for order in (range(len(self.jobs)), range(len(self.jobs) - 1, -1, -1))]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        self.assertEqual(faults, [])

    @unittest.skipUnless(os.path.exists(HELPER), "the helper obvid-cad of the CAD kernel is not there: what it writes is not compared")
    def test_of_the_kernel_is_compared(self):
        wanted = {"iges", "brep"}
        told = {key for job, ours in zip(self.jobs, self.once) if job.column == "contour" for key, text in ours.items()
                if key in wanted and not text.startswith(b"E3")}
        self.assertEqual(told, wanted)


class Converting(unittest.TestCase):
    """What a file holds decides how it is taken, not its name, nor the way it comes."""

    def converted(self, folder, *arguments, piped=None):
        out = os.path.join(folder, "out.json")
        done = subprocess.run([c.PROGRAM, "convert", *arguments, "-o", out], input=piped, capture_output=True, text=True,
                              timeout=120)
        self.assertEqual(done.returncode, 0, done.stderr)
        with open(out, encoding="utf-8") as file:
            return json.load(file)

    def test_goes_by_what_is_there(self):
        with tempfile.TemporaryDirectory() as folder:
            def put(name, text):
                with open(os.path.join(folder, name), "w", encoding="utf-8") as file:
                    file.write(text)
                return os.path.join(folder, name)
            stored = os.path.join(folder, "contour.json")
            subprocess.run([c.PROGRAM, "fit", c.SERIES, "-o", stored], capture_output=True, check=True, timeout=120)
            with open(stored, encoding="utf-8") as file:
                text = file.read()
            other = self.converted(folder, put("contour.txt", text))
            self.assertEqual(other["carrier"], "spiral")
            self.assertEqual(other["report"], json.loads(text)["report"])
            doubled = self.converted(folder, "-", "--scale", "2", piped=text)
            self.assertEqual(doubled["pieces"], self.converted(folder, stored, "--scale", "2")["pieces"])
            self.assertEqual(doubled["carrier"], "imported")
            line = json.dumps({"type": "Feature", "properties": {"name": "way"}, "geometry": {
                "type": "LineString", "coordinates": [[30.0, 50.0], [30.001, 50.0], [30.002, 50.001]]}})
            drawn = self.converted(folder, put("way.json", line), "--drawing", "exact")
            self.assertEqual(len(drawn["pieces"]), 2)
            self.assertEqual(drawn["pieces"], self.converted(folder, "-", "--drawing", "exact", piped=line)["pieces"])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[4:])
