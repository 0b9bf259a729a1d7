#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Time and memory of a batch of sections of logarithmic spirals, 100 points each, in an HDF5 file.

benches/batch.py OBVID [ITEMS] [WORKERS]...    (100000 items, workers 1 and 2, without others)
"""

import os
import resource
import subprocess
import sys
import tempfile
import time

import h5py
import numpy as np

POINTS = 100


def write_sections(path, items):
    """Turning by 1 to 3 rad, the radius growing by the factor e^(0.1 to 0.5) a radian."""
    random = np.random.default_rng(1)
    with h5py.File(path, "w") as file:
        points = file.create_dataset("points", (items * POINTS, 2), "f8")
        file["start"] = np.arange(0, items * POINTS, POINTS)
        for first in range(0, items, 10000):
            count = min(10000, items - first)
            angle = random.uniform(1, 3, (count, 1)) * np.linspace(0, 1, POINTS)
            radius = np.exp(random.uniform(0.1, 0.5, (count, 1)) * angle)
            rows = np.stack([radius * np.cos(angle), radius * np.sin(angle)], -1)
            points[first * POINTS:(first + count) * POINTS] = rows.reshape(-1, 2)


def run(command):
    """Runs a program to its end; the largest memory it had, MB, looked at ten times a second."""
    child, peak = subprocess.Popen(command), 0
    while child.poll() is None:
        try:
            with open(f"/proc/{child.pid}/status", encoding="ascii") as status:
                peak = max([peak] + [int(line.split()[1]) for line in status if line.startswith("VmHWM")])
        except OSError:
            pass
        time.sleep(0.1)
    if child.returncode != 0:
        sys.exit(f"{command[0]} ended with {child.returncode}")
    return round(peak / 1024)


def main():
    program = os.path.abspath(sys.argv[1])
    items = int(sys.argv[2]) if len(sys.argv) > 2 else 100000
    workers = [int(word) for word in sys.argv[3:]] or [1, 2]
    with tempfile.TemporaryDirectory() as folder:
        sections = os.path.join(folder, "sections.h5")
        write_sections(sections, items)
        walls = {}
        for count in workers:
            table = os.path.join(folder, f"table{count}.h5")
            before = resource.getrusage(resource.RUSAGE_CHILDREN)
            begin = time.monotonic()
            peak = run([program, "batch", sections, "-o", table, "--jobs", str(count), "-q"])
            walls[count] = time.monotonic() - begin
            after = resource.getrusage(resource.RUSAGE_CHILDREN)
            spent = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
            with h5py.File(table, "r") as file:
                proved = int(np.sum(file["proved"][:] == 1))
                above = int(np.sum(file["vertices"][:] > file["bound"][:]))
            print(f"{items} items, {count} workers: {walls[count]:.1f} s, {spent:.1f} s of processor time, "
                  f"{peak} MB, proved {proved}, more vertices than the bound {above}",
                  flush=True)
        if len(workers) > 1:
            print(f"gain {walls[workers[0]] / walls[workers[1]]:.2f}")


main()
