#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The longest processor time between two questions whether to go on, for jobs of the C interface.

benches/cancellation.py LIBOBVID_C.SO [POINTS]
"""

import ctypes as C
import json
import math
import sys
import time

PROGRESS = C.CFUNCTYPE(None, C.c_void_p, C.c_char_p, C.c_double)
CANCELLED = C.CFUNCTYPE(C.c_int, C.c_void_p)


class Run(C.Structure):
    _fields_ = [("user", C.c_void_p), ("progress", PROGRESS), ("cancelled", CANCELLED)]


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

    asked = []
    run = Run(None, PROGRESS(0), CANCELLED(lambda _: asked.append(time.process_time()) or 0))

    def measured(name, work):
        asked[:] = [time.process_time()]
        code = work()
        asked.append(time.process_time())
        longest = max(b - a for a, b in zip(asked, asked[1:]))
        whole = asked[-1] - asked[0]
        said = f", E{code}" if code else ""
        print(f"{name:24} {1e3 * longest:7.1f} ms of {whole:7.2f} s, {len(asked)} questions{said}")

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


main()
