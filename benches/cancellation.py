#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The longest time between two questions whether to go on, for jobs of the C interface: of the clock, and of
all threads' processors.

benches/cancellation.py LIBOBVID_C.SO [POINTS [SECTIONS...]]

SECTIONS: files with the sections of a skin; else those of examples/surfaces.
"""

import ctypes as C
import json
import math
import pathlib
import sys
import time

PROGRESS = C.CFUNCTYPE(None, C.c_void_p, C.c_char_p, C.c_double)
CANCELLED = C.CFUNCTYPE(C.c_int, C.c_void_p)


class Run(C.Structure):
    _fields_ = [("user", C.c_void_p), ("progress", PROGRESS), ("cancelled", CANCELLED), ("threads", C.c_size_t)]


def wave(count):
    """A slow wave of so many points."""
    return [(0.05 * i, math.sin(0.01 * i) * (1 + 0.2 * math.sin(0.003 * i))) for i in range(count)]


def main():
    lib = C.CDLL(sys.argv[1])
    count = int(sys.argv[2]) if len(sys.argv) > 2 else 20000
    rows = wave(count)
    flat = [number for row in rows for number in row]
    series, error = C.c_void_p(), C.c_void_p()
    lib.obvid_points((C.c_double * len(flat))(*flat), C.c_size_t(count), C.byref(series), C.byref(error))

    def now():
        return time.perf_counter(), time.process_time()

    asked = []
    run = Run(None, PROGRESS(0), CANCELLED(lambda _: asked.append(now()) or 0))

    def measured(name, work):
        asked[:] = [now()]
        code = work()
        asked.append(now())
        clock, busy = (max(b[k] - a[k] for a, b in zip(asked, asked[1:])) for k in (0, 1))
        whole = asked[-1][1] - asked[0][1]
        said = f", E{code}" if code else ""
        print(f"{name:24} {1e3 * clock:7.1f} ms, busy {1e3 * busy:7.1f} ms of {whole:7.2f} s, {len(asked)} questions{said}")

    def fit(options):
        contour, report = C.c_void_p(), C.c_void_p()
        code = lib.obvid_fit(series, json.dumps(options).encode(), C.byref(run), C.byref(contour),
                             C.byref(report), None)
        return code, contour

    def job(name, options):
        report = C.c_void_p()
        return getattr(lib, "obvid_" + name)(series, json.dumps(options).encode(), C.byref(run),
                                             C.byref(report), None)

    print(f"{count} points")
    for carrier in ["spiral", "clothoids", "arcs", "bspline"]:
        measured("fit " + carrier, lambda: fit({"carrier": carrier})[0])
    measured("fit within 0.001", lambda: fit({"noise": 0.001})[0])
    _, contour = fit({})
    report = C.c_void_p()
    measured("verify", lambda: lib.obvid_verify(contour, C.byref(run), C.byref(report), None))
    for name in ["analyse", "region", "compare"]:
        measured(name, lambda: job(name, {}))

    def export(ending, options):
        files = C.c_void_p()
        return lib.obvid_export(contour, ending.encode(), json.dumps(options).encode(), C.byref(run), C.byref(files), None)

    for ending, options in [("json", {}), ("svg", {}), ("svg", {"svg": "drawing"}), ("step", {}), ("dxf", {}),
                            ("dxf", {"dxf": "arcs"}), ("dxf", {"dxf": "cubic"}), ("nc", {}), ("csv", {}), ("html", {})]:
        measured(" ".join(["export", ending, *options.values()]), lambda: export(ending, options))

    def stored():
        files, size, text, read = C.c_void_p(), C.c_size_t(), C.c_void_p(), C.c_void_p()
        lib.obvid_export(contour, b"json", b"{}", None, C.byref(files), None)
        lib.obvid_files_data.restype = C.c_void_p
        data = lib.obvid_files_data(files, C.c_size_t(0), C.byref(size))
        lib.obvid_read_text(C.c_void_p(data), size, b"contour.json", C.byref(text), None)
        asked[:] = [now()]
        return lib.obvid_stored(text, b"{}", C.byref(run), C.byref(read), None)

    measured("a contour file, read", stored)
    examples = pathlib.Path(__file__).resolve().parent.parent / "examples"

    def opened(paths):
        handles = (C.c_void_p * len(paths))()
        for i, path in enumerate(paths):
            handle = C.c_void_p()
            if lib.obvid_read_file(str(path).encode(), C.byref(handle), None):
                sys.exit(f"cannot read {path}")
            handles[i] = handle
        return handles

    def made(kind, paths, options):
        surface, out = C.c_void_p(), C.c_void_p()
        code = lib.obvid_surface_make(kind.encode(), opened(paths), C.c_size_t(len(paths)), None, C.c_size_t(0),
                                      json.dumps(options).encode(), C.byref(run), C.byref(surface), C.byref(out), None)
        return code, surface

    def on_surface(name, surface, options):
        files, out = C.c_void_p(), C.c_void_p()
        call = getattr(lib, "obvid_surface_" + name)
        where = [C.byref(out)] if name == "check" else [C.byref(files), C.byref(out)]
        return call(surface, json.dumps(options).encode(), C.byref(run), *where, None)

    sections = [pathlib.Path(p) for p in sys.argv[3:]] or [examples / "surfaces/wigley_stations.csv"]
    kept = {}

    def skin(options):
        code, kept["skin"] = made("skin", sections, {"noise": "rounding" if len(sections) == 1 else 2e-4, **options})
        return code

    measured("surface skin --light", lambda: skin({"light": 1e-4}))
    measured("surface skin --fair-across", lambda: skin({"fair-across": 1e-3}))
    measured("surface skin", lambda: skin({}))
    measured("surface check", lambda: on_surface("check", kept["skin"], {"samples": 200}))
    measured("surface cut", lambda: on_surface("cut", kept["skin"], {"stations": "count:200"}))
    cloud = C.c_void_p()
    places = [(0.37 * i % 10.0, 0.011 * i, math.sin(0.01 * i)) for i in range(count // 4)]
    values = [x for row in places for x in row]
    lib.obvid_space_points((C.c_double * len(values))(*values), C.c_size_t(len(places)), C.byref(cloud), None)

    def scatter():
        surface, out = C.c_void_p(), C.c_void_p()
        return lib.obvid_surface_make(b"scatter", (C.c_void_p * 1)(cloud), C.c_size_t(1), None, C.c_size_t(0),
                                      json.dumps({"tolerance": 0.05, "up": "z", "steepest": 89.99}).encode(),
                                      C.byref(run), C.byref(surface), C.byref(out), None)

    measured("surface scatter", scatter)
    _, grid = made("grid", [examples / "surfaces/wavy_grid.csv"], {})
    for strategy in ["zigzag", "scallop"]:
        measured("toolpath " + strategy, lambda: on_surface("toolpath", grid, {"strategy": strategy, "scallop": 0.01}))
    survey = opened([examples / "road_survey.csv"])[0]

    def alignment():
        contour, files, out = C.c_void_p(), C.c_void_p(), C.c_void_p()
        return lib.obvid_alignment(C.c_void_p(survey), None, json.dumps({"noise": 0.05}).encode(), C.byref(run),
                                   C.byref(contour), C.byref(files), C.byref(out), None)

    measured("alignment", alignment)


main()
