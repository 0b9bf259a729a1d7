#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The same job writes the same bytes, whatever surrounds it (Python's standard library only).

usage: same_bytes.py PROGRAM EXAMPLES

Runs jobs as they are, again, and with other time zones, home folders, widths of terminals, numbers of
threads and languages (with a decimal comma where the system has such a one; where not, that is
said). Seconds that a job took are left out of the comparison, nothing else. Exit code 1: some
bytes differ, or a job wrote nothing.
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

JOBS = [
    ["fit", "series10.csv", "-o", "a.json", "-o", "a.svg", "-o", "a.step", "-o", "a.dxf", "-o",
     "a.nc", "-o", "a.csv", "-o", "a.ply", "-o", "a.bas"],
    ["fit", "series10.csv", "--noise", "0.02", "--carrier", "clothoids", "--units", "m", "-o",
     "b.json", "-o", "b.xodr", "-o", "b.xml"],
    ["analyse", "series10.csv"],
    ["surface", "skin", "surfaces/wigley_stations.csv", "--units", "m", "-o", "h.json", "-o",
     "h.glb", "-o", "h.svg", "-o", "h.stl", "-o", "h.html"],
]
SURROUNDINGS = [
    {},
    {"TZ": "Pacific/Kiritimati", "SOURCE_DATE_EPOCH": "1"},
    {"HOME": "/nowhere", "USER": "somebody", "COLUMNS": "40", "LINES": "3"},
    {"OMP_NUM_THREADS": "1", "TBB_NUM_THREADS": "1"},
]
# what the clock says: in reports and in tables
SECONDS = [rb'"seconds": [-+.\de]+', rb"(?m)^time +.*$"]


def with_comma(folder):
    """Variables of a language with a decimal comma, compiled into the folder; None without one."""
    try:
        made = subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", f"{folder}/de_DE.UTF-8"],
                              capture_output=True)
    except OSError:
        return None
    env = {"LOCPATH": str(folder), "LC_ALL": "de_DE.UTF-8", "LANG": "de_DE.UTF-8"}
    shown = subprocess.run(["locale", "decimal_point"], capture_output=True, env=os.environ | env)
    return env if made.returncode == 0 and shown.stdout.strip() == b"," else None


def outcome(program, examples, args, surroundings):
    """Everything that the run printed and wrote, without seconds."""
    env = {k: v for k, v in os.environ.items() if not k.startswith("LC_") and k != "LANG"}
    with tempfile.TemporaryDirectory() as name:
        folder = pathlib.Path(name)
        inputs = [a for a in args if (examples / a).is_file()]
        for file in inputs:
            (folder / file).parent.mkdir(exist_ok=True)
            shutil.copy(examples / file, folder / file)
        done = subprocess.run([program, *args], cwd=folder, capture_output=True,
                              env=env | surroundings, timeout=120)
        texts = {"exit code": str(done.returncode).encode(), "stdout": done.stdout,
                 "stderr": done.stderr}
        texts |= {p.name: p.read_bytes() for p in folder.iterdir()
                  if p.is_file() and p.name not in inputs}
    for pattern in SECONDS:
        texts = {k: re.sub(pattern, b"", v) for k, v in texts.items()}
    return texts


def main():
    program, examples = str(pathlib.Path(sys.argv[1]).resolve()), pathlib.Path(sys.argv[2])
    with tempfile.TemporaryDirectory() as languages:
        surroundings = list(SURROUNDINGS)
        comma = with_comma(languages)
        if comma:
            surroundings.append(comma)
        else:
            print("no language with a decimal comma can be had here: left out")
        return compare(program, examples, surroundings)


def compare(program, examples, surroundings):
    faults = compared = 0
    for args in JOBS:
        first = outcome(program, examples, args, {})
        written = args.count("-o")
        if first["exit code"] != b"0" or len(first) != 3 + written:
            print(f"{args}: exit code {first['exit code']}, wrote {sorted(first)}")
            faults += 1
            continue
        for env in surroundings:
            again = outcome(program, examples, args, env)
            for name in sorted(first.keys() | again.keys()):
                compared += 1
                if first.get(name) != again.get(name):
                    print(f"{' '.join(args)} with {env}: {name} differs")
                    faults += 1
    print(f"{compared} outputs compared, {faults} differ")
    assert compared > 0 or faults, "nothing was compared"
    return 1 if faults else 0


if __name__ == "__main__":
    sys.exit(main())
