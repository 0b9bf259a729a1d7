#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Each example below tests/recipes goes into a copy of the project. It touches the places that its recipe in
docs/conventions.md names and no others, and layers and names stay in order.

usage: recipes_test.py PROJECT_FOLDER [COPY]     COPY: a folder to keep the project with all examples in
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1]).resolve()
ONE_LINE = ("carrier", "format")  # what they add to sources that are there
# What looks that the lists of the project are complete.
LISTS = ("tests/tools/carriers_test.py", "tests/tools/surface_kinds_test.py")
EXAMPLES = sorted(path.parent for path in (ROOT / "tests/recipes").glob("*/lines.json"))


def copy_project(to):
    names = subprocess.run(["git", "-C", str(ROOT), "ls-files", "-co", "--exclude-standard", "-z"],
                           capture_output=True, text=True, check=False).stdout.split("\0")
    if not any(names):
        names = [str(p.relative_to(ROOT)) for p in ROOT.rglob("*") if p.is_file() and "build" not in p.parts]
    for name in filter(None, names):
        if (ROOT / name).is_file():
            (to / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(ROOT / name, to / name)


def put_in(example, project):
    """Puts an example into a project; the places it touches, and how many lines it adds to sources that are there."""
    touched, lines = set(), 0
    for path in example.rglob("*"):
        name = path.relative_to(example).as_posix()
        if path.is_file() and name != "lines.json":
            assert not (project / name).exists(), name
            (project / name).parent.mkdir(parents=True, exist_ok=True)
            shutil.copy2(path, project / name)
            touched.add(name)
    for name, added in json.loads((example / "lines.json").read_text(encoding="utf-8")).items():
        text = (project / name).read_text(encoding="utf-8")
        for one in added:
            text = with_text(text, one, name)
        (project / name).write_text(text, encoding="utf-8")
        touched.add(name)
        lines += len(added) if of_program(name) else 0
    return touched, lines


def of_program(name):
    return name.split("/")[0] in ("include", "src", "apps")


def with_text(text, added, name):
    """A line at the end, or {"before": what stands there once, "text": what comes before it}."""
    if isinstance(added, str):
        return text + added + "\n"
    assert text.count(added["before"]) == 1, f"{name} has {added['before']} {text.count(added['before'])} times"
    return text.replace(added["before"], added["text"] + added["before"])


def places_of(kind):
    """Patterns of the places that the recipe names."""
    text = (ROOT / "docs/conventions.md").read_text(encoding="utf-8")
    section = re.search(rf"^### A new {kind}\n(.*?)(?=^##)", text, re.DOTALL | re.MULTILINE)[1]
    cells = re.findall(r"^\| (`.*?`) \|", section, re.MULTILINE)
    names = [name for cell in cells for name in re.findall(r"`([^`]+)`", cell)]
    return [re.sub(r"<\w+>", "[^/]+", name).replace("NAME", r"\w+") + (r"[^/]+" if name.endswith("/") else "") for name in names]


class Recipes(unittest.TestCase):
    def test_every_recipe_has_an_example(self):
        text = (ROOT / "docs/conventions.md").read_text(encoding="utf-8")
        kinds = set(re.findall(r"^### A new ([a-z ]+)$", text, re.MULTILINE))
        self.assertGreaterEqual(kinds, {"carrier", "format", "kind of surface"})
        self.assertGreaterEqual(kinds, {path.name for path in EXAMPLES})
        self.assertGreaterEqual(len(EXAMPLES), 3)

    def test_examples_touch_what_their_recipes_name_and_nothing_else(self):
        for example in EXAMPLES:
            with self.subTest(recipe=example.name), tempfile.TemporaryDirectory() as folder:
                project = pathlib.Path(folder)
                copy_project(project)
                touched, lines = put_in(example, project)
                places = places_of(example.name)
                for name in touched:
                    self.assertTrue(any(re.fullmatch(place, name) for place in places), f"{name} is in no recipe")
                for place in places:
                    self.assertTrue(any(re.fullmatch(place, name) for name in touched), f"{place} is not touched")
                if example.name in ONE_LINE:
                    self.assertEqual(lines, 1)
                for tool in ("tools/check_layers", "tools/check_names", *LISTS):
                    done = subprocess.run([sys.executable, "-B", str(project / tool), str(project)],
                                          capture_output=True, text=True)
                    self.assertEqual(done.returncode, 0, f"{tool}: {done.stdout}{done.stderr}")


if __name__ == "__main__":
    if len(sys.argv) > 2:
        kept = pathlib.Path(sys.argv[2]).resolve()
        shutil.rmtree(kept, ignore_errors=True)
        copy_project(kept)
        for one in EXAMPLES:
            put_in(one, kept)
    else:
        unittest.main(argv=sys.argv[:1])
