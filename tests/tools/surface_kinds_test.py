#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Looks that kinds of things are named where their recipe in docs/conventions.md says, and nowhere else.

usage: surface_kinds_test.py PROJECT_FOLDER
"""
import functools
import os
import re
import sys
import unittest

PROJECT = sys.argv.pop() if len(sys.argv) > 1 else "."
# Not in tables: who makes surfaces of a kind names it.
MAKERS = (
    "src/surface_builders/",
    "include/obvid/surface_builders/",
    "src/cad/helper/face_surface.cpp",
    "src/pipeline/surface/surface_kinds.cpp",
    "src/pipeline/surface/surface_points.cpp",
    "src/pipeline/splines/spline_grid.cpp",
)
SURFACE = "include/obvid/surface/surface.h"
KINDS = "include/obvid/pipeline/surface_kinds.inc"
# Lists for readers.
LISTS = ("include/obvid/obvid.h", "docs/c.md", "docs/surfaces.md", "bindings/python/obvid/surfaces.py",
         "apps/cli/surface_options.cpp")


@functools.lru_cache(maxsize=None)
def text_of(path):
    with open(os.path.join(PROJECT, path), encoding="utf-8") as file:
        return file.read()


@functools.lru_cache(maxsize=None)
def sources():
    return list(walk())


def walk():
    for top in ("include", "src", "apps"):
        for folder, _, names in os.walk(os.path.join(PROJECT, top)):
            for name in names:
                if name.endswith((".h", ".cpp")):
                    yield os.path.relpath(os.path.join(folder, name), PROJECT)


def alternatives(path, variant):
    found = re.search(r"using " + variant + r" =\s+std::variant<([^;]*)>;", text_of(path))
    return [name.strip() for name in found.group(1).split(",")]


def table():
    """Structs and words of the kinds that are made."""
    return re.findall(r'^OBVID_SURFACE_KIND\((\w+), "(\w+)"', text_of(KINDS), re.MULTILINE)


def recipe(title):
    """Files that a recipe names: those in backquotes in the first column of its tables."""
    section = text_of("docs/conventions.md").split("### " + title + "\n")[1].split("\n## ")[0].split("\n### ")[0]
    files = set()
    for row in re.findall(r"^\| (`[^|]*) \|", section, re.MULTILINE):
        files.update(re.findall(r"`([^`]*)`", row))
    return files


def naming(name):
    return {path for path in sources() if re.search(r"\b" + name + r"\b", text_of(path))}


class KindsOfSurfaces(unittest.TestCase):
    def test_the_recipe_names_files_that_are_there(self):
        for path in recipe("A new kind of surface"):
            if "NAME" not in path:
                self.assertTrue(os.path.exists(os.path.join(PROJECT, path)), path)

    def test_kinds_are_named_where_the_recipe_says(self):
        files = recipe("A new kind of surface")
        kinds = [kind for kind in alternatives(SURFACE, "Surface") if kind != "NurbsSurface"]
        self.assertGreaterEqual(len(kinds), 7)
        for kind in kinds:
            for path in naming(kind):
                # its own job, by the recipe `surface_NAME.cpp`
                job = f"src/pipeline/surface/surface_{kind.removesuffix('Surface').lower()}.cpp"
                own = re.fullmatch(r"src/surface/kinds_\w+\.cpp", path) or path == job
                known = path in files or own or path.startswith(MAKERS)
                self.assertTrue(known, f"{path} knows {kind}")

    def test_jobs_are_named_where_the_recipe_says(self):
        files = recipe("A new kind of surface") | set(MAKERS)
        kinds = [kind for kind, _ in table()]
        self.assertGreaterEqual(len(kinds), 9)
        for kind in kinds:
            others = {path for path in naming(kind) - files if not re.fullmatch(r"src/pipeline/surface/surface_\w+\.cpp", path)}
            self.assertEqual(others, set(), kind)
            self.assertIn("src/pipeline/surface/surface_values.cpp", naming(kind))

    def test_lists_for_readers_have_every_kind(self):
        for path in LISTS:
            for _, word in table():
                named = re.search(r"[\"`]" + word + r"\b|surface " + word + r"\b", text_of(path))
                self.assertTrue(named, f"{path} lacks {word}")


if __name__ == "__main__":
    unittest.main()
