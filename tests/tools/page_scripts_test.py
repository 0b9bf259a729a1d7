#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The scripts of the page of surfaces, as CMake puts them together, are JavaScript in strict mode, and the page
has the elements that they ask for by name.

usage: page_scripts_test.py PROJECT_FOLDER
"""
import os
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = os.path.abspath(sys.argv[1])
NODE = shutil.which("node")


def text_of(path):
    with open(os.path.join(ROOT, path), encoding="utf-8") as file:
        return file.read()


def scripts():
    listed = re.search(r"surface_page_script=(\S+?)\)", text_of("CMakeLists.txt"))
    return listed[1].split("+")


@unittest.skipUnless(NODE, "no node")
class Scripts(unittest.TestCase):
    def checked(self, text):
        with tempfile.TemporaryDirectory() as folder:
            path = os.path.join(folder, "page.js")
            with open(path, "w", encoding="utf-8") as file:
                file.write('"use strict";\n' + text)
            done = subprocess.run([NODE, "--check", path], capture_output=True, text=True, timeout=60)
        return done.returncode == 0, done.stderr

    def test_are_javascript(self):
        self.assertGreater(len(scripts()), 2)
        whole = "".join(text_of(path) for path in scripts())
        self.assertEqual(self.checked(whole), (True, ""))
        for path in scripts():
            fine, said = self.checked(text_of(path))
            self.assertTrue(fine, f"{path}: {said}")

    def test_that_are_broken_are_seen(self):
        for text in ("function f( {", "const a = 1; const a = 2;", "with (Math) { cos(1); }"):
            self.assertFalse(self.checked(text)[0], text)

    def test_are_all_on_the_page(self):
        folder = os.path.join(ROOT, "web/surface")
        there = {f"web/surface/{name}" for name in os.listdir(folder) if name.endswith(".js")}
        self.assertEqual(there, set(scripts()))

    def test_find_their_elements(self):
        page = text_of("web/surface/page.html") + text_of("src/picture/page/surface_page.cpp").replace("\\", "")
        names = set(re.findall(r"(?:byId|getElementById)\(['\"]([\w-]+)['\"]\)", "".join(text_of(path) for path in scripts())))
        self.assertGreater(len(names), 5)
        missing = {name for name in names if not re.search(rf"id=['\"]?{re.escape(name)}\b", page)}
        self.assertEqual(missing, set())


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
