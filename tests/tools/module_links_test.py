#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every obvid_module of CMake depends on nothing that its files do not include, and what they include it
depends on, or what it depends on does: the order of layers is what is built, not a wider permission beside it.

usage: module_links_test.py PROJECT_FOLDER
"""
import glob
import importlib.machinery
import importlib.util
import os
import re
import sys
import unittest

ROOT = os.path.abspath(sys.argv[1])
MODULE = re.compile(r"^ *obvid_module\(NAME ([^\s)]+)([^)]*)\)", re.MULTILINE)
WORDS = {"FOLDER", "DEPENDS", "LIBRARIES", "PRIVATE_HEADERS_OF", "BATCH", "LATER", "WORDS"}


def layers():
    path = os.path.join(ROOT, "tools/check_layers")
    loader = importlib.machinery.SourceFileLoader("check_layers", path)
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_layers", loader))
    loader.exec_module(module)
    module.FAMILIES.update(module.families_in(ROOT))
    return module


CHECK = layers()
FAMILIES = {one.replace("/", "_") for one in CHECK.FAMILIES}


def declared(text):
    """{module: (folder below src, what it depends on)}; modules of one line for all families apart."""
    out = {}
    for name, rest in MODULE.findall(re.sub(r'"[^"]*"', '""', text)):
        found, key = {"FOLDER": [], "DEPENDS": []}, ""
        for word in rest.split():
            if word in WORDS:
                key = word
            elif key in found:
                found[key].append(word)
        needs = set()
        for word in found["DEPENDS"]:
            needs |= FAMILIES if word == "${families}" else {word}
        out[name] = (found["FOLDER"][0] if found["FOLDER"] else name, needs)
    return out


def included(folder, name):
    """Modules that the files of one include, and how many files these are."""
    public = name.replace("contour_", "contour/")
    files = [path for top in (f"src/{folder}", f"include/obvid/{public}") for ending in ("h", "cpp", "inc")
             for path in glob.glob(os.path.join(ROOT, top, "**", "*." + ending), recursive=True)]
    own, out = CHECK.module_of(public + "/x"), set()
    for path in files:
        with open(path, encoding="utf-8") as lines:
            for line in lines:
                match = CHECK.INCLUDE.match(line)
                if match and match[1].startswith("obvid/"):
                    out.add(CHECK.module_of(match[1][len("obvid/"):]))
    return {one.replace("/", "_") for one in out - {own, None}}, len(files)


class Links(unittest.TestCase):
    def test_are_what_is_included(self):
        modules = {}
        for path in ("CMakeLists.txt", "cmake/ObvidCad.cmake"):
            with open(os.path.join(ROOT, path), encoding="utf-8") as file:
                modules.update(declared(file.read()))
        self.assertGreater(len(modules), 20)
        # one line for all families: what some of them include
        shared = modules.pop("contour_${family}")[1]
        families = {one: included(one.replace("_", "/", 1), one)[0] for one in sorted(FAMILIES)}
        self.assertEqual(shared - set().union(*families.values()), set())
        modules.update({one: ("", shared) for one in families})

        def reached(name):
            out, open_ones = set(), [name]
            while open_ones:
                for one in modules[open_ones.pop()][1] - out:
                    out.add(one)
                    open_ones.append(one)
            return out
        for name, found in families.items():
            self.assertEqual(found - reached(name), set(), name)
        for name, (folder, needs) in modules.items():
            if name in families:
                continue
            found, count = included(folder, name)
            with self.subTest(module=name):
                self.assertGreater(count, 0)
                self.assertEqual(needs - found, set(), "DEPENDS on what no file includes")
                self.assertEqual(found - reached(name), set(), "includes what it does not depend on")

    def test_sees(self):
        text = 'obvid_module(NAME mesh BATCH 17 DEPENDS core surface WORDS\n  LATER "a/(b|c)\\\\.cpp$"\n  PRIVATE_HEADERS_OF x::y)\n'
        self.assertEqual(declared(text), {"mesh": ("mesh", {"core", "surface"})})
        self.assertIn("core", included("mesh", "mesh")[0])


if __name__ == "__main__":
    unittest.main(argv=[sys.argv[0]] + sys.argv[2:])
