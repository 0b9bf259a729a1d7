#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Sections and volumes of `surface cut` against closed forms and a count of branches by signs on a grid.

usage: sections_test.py PROGRAM TOOLS

A part of what `tools/acceptance cuts` does, with the same judge; needs numpy and scipy.
"""
import json
import pathlib
import random
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True


class Sections(unittest.TestCase):
    def setUp(self):
        try:
            from acceptance_sets import cuts
        except ImportError as error:
            self.skipTest(str(error))
        self.cuts = cuts

    def case(self, work, name, told, arguments, group, truth):
        path = pathlib.Path(work) / (name + ".json")
        path.write_text(json.dumps(self.cuts.model([told])))
        outcome = self.cuts.run_case(self.cuts.Case(name, path, arguments, 0.0, group, truth), PROGRAM, pathlib.Path(work))
        self.assertEqual(outcome["exit"], 0, outcome)
        return outcome

    def test_random_planes(self):
        dice = random.Random(3)
        with tempfile.TemporaryDirectory() as work:
            for name in self.cuts.BODIES:
                told, off = self.cuts.body_of(name, dice)
                found = self.case(work, name, told, [], name, (off, self.cuts.planes_of([told], 6, dice)))
                self.assertEqual(found["wrong"], 0, name)
                self.assertGreater(found["branches"], 0)
                self.assertLessEqual(found["missed"], 1.0)
                for figure in ("closed_form", "own", "plane"):
                    self.assertLessEqual(found[figure], 1e-12, (name, figure))

    def test_what_floats(self):
        dice = random.Random(4)
        with tempfile.TemporaryDirectory() as work:
            for name in ("sphere", "torus", "Wigley"):
                told, water, half, truth = self.cuts.floating(name, dice)
                arguments = ["--draught", repr(water), *(["--half"] if half else [])]
                found = self.case(work, name, told, arguments, self.cuts.FLOATING, truth)
                for figure in ("volume_off", "plane_off", "centre_off"):
                    self.assertLessEqual(found[figure], 1e-10, (name, figure))


if __name__ == "__main__":
    PROGRAM, TOOLS = sys.argv[1:3]
    sys.path.insert(0, TOOLS)
    unittest.main(argv=sys.argv[:1])
