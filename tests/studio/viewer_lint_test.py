#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Scripts of web/surface, read by the TypeScript compiler as its tsconfig.json says: names that are not there, members
that nothing has, and declarations that nothing uses.

usage: viewer_lint_test.py PROJECT_FOLDER TSC
"""
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCES = pathlib.Path(sys.argv[1]).resolve() / "web/surface"
TSC = sys.argv[2]


def said(folder):
    done = subprocess.run(["node", TSC, "-p", folder], capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout + done.stderr


class Viewer(unittest.TestCase):
    def test_has_no_fault(self):
        self.assertEqual(said(SOURCES), (0, ""))

    def test_faults_are_seen(self):
        for text, told in [("function panTo() { pamBy(1, 2); }", "pamBy"), ("const idle = 1; export {};", "idle"),
                           ("function moveTo(x) { return x; }", "more.js(1,10)")]:
            with self.subTest(text=text), tempfile.TemporaryDirectory() as folder:
                shutil.copytree(SOURCES, folder, dirs_exist_ok=True)
                (pathlib.Path(folder) / "more.js").write_text(text + "\n")
                code, found = said(folder)
                self.assertNotEqual(code, 0)
                self.assertIn(told, found)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
