#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Seconds of the clock that tool paths of a hull take with all cores and with one, and their ratio.

benches/milling.py PUBLIC_DATA OBVID [WORDS...]

The hull, cutters, scallop and tolerance are those of `tools/acceptance milling`. WORDS: only programs whose
names hold all of them (`flat zigzag`). One core: the process is bound to it, so that it sees no other.
"""

import os
import pathlib
import resource
import subprocess
import sys
import tempfile
import time

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent.parent / "tools"))
from acceptance_sets import milling  # noqa: E402


def measured(command, cores):
    """Seconds of the clock and of the processors."""
    before, begun = resource.getrusage(resource.RUSAGE_CHILDREN), time.perf_counter()
    subprocess.run(command, check=False, stdout=subprocess.DEVNULL, stderr=subprocess.DEVNULL,
                   preexec_fn=lambda: os.sched_setaffinity(0, cores))
    clock = time.perf_counter() - begun
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    return clock, after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


def main():
    data, program, words = pathlib.Path(sys.argv[1]), sys.argv[2], sys.argv[3:]
    everything = os.sched_getaffinity(0)
    with tempfile.TemporaryDirectory() as folder:
        work = pathlib.Path(folder)
        options = type("Options", (), {"only": "hull", "program": program})
        cases, _ = milling.cases(data, work, options)
        print(f"{len(everything)} cores\n{'program':<28}{'all, s':>9}{'processor, s':>14}{'one, s':>9}{'ratio':>7}")
        for case in cases:
            if not all(word in case.name.split() for word in words):
                continue
            command = [program, "toolpath", str(case.path), *case.arguments, "-o", str(work / "part.nc"), "-q"]
            every, spent = measured(command, everything)
            one, _ = measured(command, {min(everything)})
            print(f"{case.name:<28}{every:9.1f}{spent:14.1f}{one:9.1f}{one / every:7.2f}", flush=True)


if __name__ == "__main__":
    main()
