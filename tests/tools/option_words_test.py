#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Options that texts of the library name are options of the program (docs/decisions/0009): what advice
says to give can be given.

usage: option_words_test.py OBVID PROJECT_FOLDER     OBVID: a built program, its parts beside it
"""
import importlib.machinery
import importlib.util
import pathlib
import re
import sys
import unittest

PROGRAM, ROOT = sys.argv[1], pathlib.Path(sys.argv[2]).resolve()
TEXT = re.compile(r'"((?:[^"\\\n]|\\.)*)"')
OPTION = re.compile(r"(?<![\w-])--([a-z][a-z0-9-]*)")


def commands():
    loader = importlib.machinery.SourceFileLoader("make_manuals", str(ROOT / "tools/make_manuals"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader(loader.name, loader))
    loader.exec_module(module)
    return module.read_commands(PROGRAM)


def texts(path):
    """Literals of a source file, those that stand behind one another joined, without comments."""
    code = re.sub(r"^\s*//.*$", "", path.read_text(encoding="utf-8"), flags=re.MULTILINE)
    return TEXT.findall(re.sub(r'"\s*\n\s*"', "", code))


def words_of(root):
    """Pairs (option, file) of texts below the programs."""
    return {(name, path.relative_to(root).as_posix())
            for top in ("include", "src") for path in sorted((root / top).rglob("*"))
            if path.suffix in (".h", ".cpp", ".inc")
            for text in texts(path) for name in OPTION.findall(text)}


class OptionWords(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.known = {name for command in commands() for option in command.options
                     for name in option.names}
        cls.words = words_of(ROOT)

    def test_are_options_of_a_command(self):
        unknown = sorted(f"{file}: --{name}" for name, file in self.words if f"--{name}" not in self.known)
        self.assertEqual(unknown, [])

    def test_are_found_at_all(self):
        named = {name for name, _ in self.words}
        self.assertGreater(len(named), 40)
        self.assertLessEqual({"noise", "carrier", "tolerance", "heading-at", "open", "shard"}, named)
        self.assertIn("--corner-at", self.known)

    def test_literals_are_joined_and_comments_left_out(self):
        import tempfile
        with tempfile.TemporaryDirectory() as folder:
            file = pathlib.Path(folder) / "a.cpp"
            file.write_text('  // "--never"\n  f("take --out"\n    "put-tolerance, or `--open`", x-- -y);\n')
            self.assertEqual([name for text in texts(file) for name in OPTION.findall(text)],
                             ["output-tolerance", "open"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
