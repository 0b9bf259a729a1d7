#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Judges every method of `fit` on the five shapes of docs/papers.md: nothing that it says is false.

usage: five_shapes.py PROGRAM JUDGE
"""
import importlib.machinery
import importlib.util
import os
import subprocess
import sys
import tempfile

ROOT = os.path.dirname(os.path.dirname(os.path.dirname(os.path.abspath(__file__))))


def papers():
    loader = importlib.machinery.SourceFileLoader("papers", os.path.join(ROOT, "tools", "make_papers"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("papers", loader))
    loader.exec_module(module)
    return module


def main():
    program, judge = sys.argv[1:3]
    p = papers()
    methods = [["--carrier", name] for name in p.CARRIERS]
    methods += [["--construction", name] for name in p.CONSTRUCTIONS]
    methods += [["--construction", "parabolas", "--fixation", order] for order in p.FIXATIONS]
    methods += [["--prefer", name] for name in p.PREFERENCES]
    judged = refused = 0
    wrong = []
    with tempfile.TemporaryDirectory() as folder:
        for name, text, shape in p.SHAPES:
            if not text:
                with open(os.path.join(p.EXAMPLES, "series10.csv"), encoding="utf-8") as file:
                    text = file.read().replace("x_mm,y_mm", "x,y")  # a column tells the unit, the judge takes options
            points = os.path.join(folder, "points.csv")
            with open(points, "w", encoding="utf-8") as file:
                file.write(text)
            for method in methods:
                contour, report = os.path.join(folder, "c.json"), os.path.join(folder, "report.txt")
                if os.path.exists(contour):
                    os.remove(contour)
                with open(report, "w", encoding="utf-8") as out:
                    subprocess.run([program, "fit", points, *method, *shape, "--no-progress", "-o", contour],
                                   stdout=out, stderr=subprocess.PIPE, check=False)
                if not os.path.exists(contour):
                    assert (" ".join(["fit"] + method), name) in p.CANNOT, (method, name)
                    refused += 1
                    continue
                run = subprocess.run([judge, contour, "--points", points, "--options", " ".join(method + shape),
                                      "--text", report], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)
                judged += 1
                if run.returncode != 0:
                    wrong.append(f"{' '.join(method)} on {name}:\n{run.stdout[-1500:]}")
    assert judged + refused == len(methods) * len(p.SHAPES), (judged, refused)
    if wrong:
        sys.exit("\n".join(wrong))
    print(f"{judged} contours judged, {refused} refused with their reason")


main()
