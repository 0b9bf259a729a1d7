#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Ctrl-C ends long work of every command at once and leaves no output (standard library only).

usage: interrupt_test.py PROGRAM

Each job works for seconds. When it has used 0.2 s of processor time it gets the signal of Ctrl-C; a job
that ends before that is a fault of this test (`nurbs` and `explain` take no time; tests/batch kills batches). It has to end within 2 s of it, by the signal or with exit code
1 and E103, and the folder has to hold what it held before.
"""
import math
import os
import pathlib
import signal
import subprocess
import sys
import tempfile
import time
import unittest

WORKED_S = 0.2
AT_ONCE_S = 2.0
TICKS = os.sysconf("SC_CLK_TCK")

JOBS = {
    "fit": ["fit", "long.csv", "--noise", "0.01", "-o", "o.json", "-o", "o.svg"],
    "fit to G-code": ["fit", "long.csv", "--carrier", "clothoids", "-o", "o.nc"],
    "fit --suggest": ["fit", "long.csv", "--suggest", "-o", "o.svg"],
    "fit in space": ["fit", "space.csv", "-o", "o.json"],
    "analyse": ["analyse", "endless.json", "-o", "o.svg"],
    "region": ["region", "long.csv", "-o", "o.csv"],
    "compare": ["compare", "long.csv", "-o", "o.csv"],
    "convert": ["convert", "endless.json", "-o", "o.step"],
    "verify": ["verify", "endless.json"],
    "surface skin": ["surface", "skin", "sections.csv", "-o", "o.stl"],
    "surface offset": ["surface", "offset", "hills.json", "--distance", "0.01", "--tolerance",
                       "1e-9", "-o", "o.json"],
    "surface cut": ["surface", "cut", "hills.json", "--waterlines", "count:4000", "-o", "o.csv"],
    "surface scatter": ["surface", "scatter", "cloud.csv", "--tolerance", "1e-3", "--up", "z",
                        "--steepest", "89.99", "-o", "o.json"],
    "surface check": ["surface", "check", "hills.json", "--samples", "2000", "-o", "o.svg"],
    "alignment": ["alignment", "long.csv", "--noise", "0.01", "-o", "o.xml", "--units", "m"],
    "spline": ["spline", "table.csv", "--samples", "3000000", "-o", "o.csv"],
    "cut": ["cut", "endless.json", "--depth", "1", "--tolerance", "1e-7", "-o", "o.nc"],
    "toolpath": ["toolpath", "hills.json", "--scallop", "0.0005", "-o", "o.nc"],
}


def line_of(*numbers):
    return ",".join(f"{n:.9g}" for n in numbers) + "\n"


def write_inputs(program, folder):
    for file, noise in (("long.csv", 1e-3), ("smooth.csv", 0.0)):
        wave = [(0.5 * k, 8 * math.sin(0.065 * k) + noise * math.sin(k * k)) for k in range(40000)]
        (folder / file).write_text("".join(line_of(*p) for p in wave))
    turns = [(9 * math.cos(0.1 * k), 9 * math.sin(0.1 * k) + 0.1 * k, 0.05 * k) for k in range(8000)]
    (folder / "space.csv").write_text("x,y,z\n" + "".join(line_of(*p) for p in turns))
    hills = [(i, j, 2 * math.sin(0.3 * i) * math.cos(0.25 * j))
             for i in range(40) for j in range(40)]
    (folder / "hills.csv").write_text("".join(line_of(*p) for p in hills))
    sections = [(k, 5 * math.cos(a) * (2 + math.sin(0.1 * k)), 3 * math.sin(a), k)
                for k in range(300) for a in (0.02 * j for j in range(150))]
    (folder / "sections.csv").write_text(
        "section,x,y,z\n" + "".join(line_of(*p) for p in sections))
    places = [((0.618033989 * k) % 1.0, (0.754877666 * k) % 1.0) for k in range(20000)]
    (folder / "cloud.csv").write_text("".join(
        line_of(x, y, math.sin(9 * x) * math.cos(7 * y) + 0.05 * math.sin(k * k))
        for k, (x, y) in enumerate(places)))
    (folder / "table.csv").write_text(
        "x,f\n" + "".join(line_of(0.1 * k, math.sin(0.1 * k)) for k in range(200)))
    made = [["fit", "smooth.csv", "-o", "endless.json", "--quiet"],
            ["surface", "grid", "hills.csv", "-o", "hills.json", "--quiet"]]
    for args in made:
        subprocess.run([program, *args], cwd=folder, check=True, capture_output=True)


def processor_seconds(process):
    """Of a running process; None when it has ended."""
    try:
        fields = pathlib.Path(f"/proc/{process.pid}/stat").read_text().rsplit(")", 1)[1].split()
    except (OSError, IndexError):
        return None
    return None if fields[0] in "ZX" else (int(fields[11]) + int(fields[12])) / TICKS


def processor_seconds_at_end(process):
    """And the exit code. Other work on the machine makes a job late, not busy."""
    _, status, usage = os.wait4(process.pid, 0)
    process.returncode = os.waitstatus_to_exitcode(status)
    return usage.ru_utime + usage.ru_stime, process.returncode


class Interrupt(unittest.TestCase):
    def test_every_command_ends_at_once_and_leaves_nothing(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            write_inputs(PROGRAM, folder)
            before = sorted(p.name for p in folder.iterdir())
            for job, args in JOBS.items():
                with self.subTest(job):
                    self.interrupted(folder, args)
                    self.assertEqual(sorted(p.name for p in folder.iterdir()), before)

    def interrupted(self, folder, args):
        with tempfile.TemporaryFile() as out, tempfile.TemporaryFile() as err:
            child = subprocess.Popen([PROGRAM, *args], cwd=folder, stdout=out, stderr=err)
            while (used := processor_seconds(child)) is not None and used < WORKED_S:
                time.sleep(0.01)
            self.assertIsNone(child.poll(), "the job ended before it could be interrupted")
            child.send_signal(signal.SIGINT)
            ended_after, code = processor_seconds_at_end(child)
            self.assertLess(ended_after - used, AT_ONCE_S)
            err.seek(0)
            text = err.read().decode()
        self.assertIn(code, (-signal.SIGINT, 1), text)
        if code == 1:
            self.assertIn("obvid: error E103", text)


if __name__ == "__main__":
    PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
    signal.signal(signal.SIGINT, signal.default_int_handler)  # shells ignore it for background jobs
    unittest.main()
