#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Licences and sources: every source file says its licence, every data file has its source and licence listed,
and what texts cite stands in docs/sources.md. Errors are made and handed on in the ways that docs/conventions.md names.

usage: house_test.py PROJECT_FOLDER
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv[1]).resolve()

# Folders whose files are data: listed with source and licence in tests/data/README.md.
DATA_FOLDERS = ("tests/data", "tests/fuzz/corpus", "examples")
# Neither sources nor data: prose, its pictures, and files whose form has no room for a comment.
PROSE = {".md", ".svg", ".png", ".jpg", ".gif"}
WITHOUT_COMMENTS = {"LICENSE", "NOTICE", "lines.json", "VERSION", "CMakePresets.json", "package.json", "package-lock.json", "tsconfig.json"}
SPDX = "SPDX-License-Identifier: Apache-2.0"
HEAD_LINES = 3  # a line that starts the program may come before


def project_files(root):
    """Files of the project, from its folder: what git would take, or all without git."""
    listed = subprocess.run(["git", "-C", root, "ls-files", "-co", "--exclude-standard", "-z"],
                            capture_output=True)
    if listed.returncode == 0:
        names = listed.stdout.decode().split("\0")
        return [pathlib.PurePosixPath(name) for name in names if name and (root / name).is_file()]
    out = []
    for folder, folders, names in os.walk(root):
        folders[:] = [f for f in folders if f not in ("build", ".git", "__pycache__", ".cache")]
        out += [pathlib.PurePosixPath(os.path.relpath(os.path.join(folder, n), root))
                for n in names]
    return out


def is_data(path):
    inside = any(str(path).startswith(folder + "/") for folder in DATA_FOLDERS)
    return inside and path.suffix not in (".c", ".cpp", ".h", ".py", ".md")


def without_licence(root, files):
    faults = []
    for path in files:
        if is_data(path) or path.suffix in PROSE or path.name in WITHOUT_COMMENTS:
            continue
        with open(root / path, encoding="utf-8", errors="replace") as text:
            head = [text.readline() for _ in range(HEAD_LINES)]
        if not any(SPDX in line for line in head):
            faults.append(str(path))
    return faults


def listed_data(readme):
    """Names in the first cells of the table rows: `tests/data/...`."""
    return re.findall(r"^\| `([^`]+)` \|", readme, re.MULTILINE)


def data_faults(root, files):
    rows = listed_data((root / "tests/data/README.md").read_text(encoding="utf-8"))
    data = [str(path) for path in files if is_data(path)]
    faults = [f"{name} is not listed" for name in data if name not in rows]
    faults += [f"{name} is listed and not there" for name in rows if name not in data]
    faults += [f"{name} is listed twice" for name in set(rows) if rows.count(name) > 1]
    return faults


# "[Higham 2002]", "[000]" and, without brackets, "Higham 2002" or "Karney (2011)".
CITED = re.compile(r"\[(\d{3})\]|\b([A-Z][a-z]+(?:(?:,| &| and) [A-Z][a-z]+)*),? \(?((?:1[89]|20)\d\d)\)?")
NOT_CITED = {"Apache", "Copyright", "January", "February", "March", "April", "May", "June", "July", "August", "September", "October",
             "November", "December", "Release", "SolidWorks", "Debian", "Windows", "Visual"}


def cited(text):
    """Keys that a text cites: "000", "Higham 2002", with the first name of several."""
    found = set()
    for number, names, year in CITED.findall(text):
        first = re.split(r"[ ,]", names)[0]
        if number or first not in NOT_CITED:
            found.add(number or f"{first} {year}")
    return found


def unknown_sources(root, files):
    listed = cited(" ".join(re.findall(r"^\| \[[^\]]+\]", (root / "docs/sources.md").read_text(encoding="utf-8"),
                                       re.MULTILINE)))
    prose = ("docs/", "include/", "src/", "tests/", "benches/")
    faults = set()
    for path in files:
        if str(path) == "docs/sources.md":
            continue
        if str(path).startswith(prose) and path.suffix in (".md", ".h", ".cpp") and not is_data(path):
            text = (root / path).read_text(encoding="utf-8", errors="replace")
            if path.suffix != ".md":
                text = "\n".join(re.findall(r"//(.*)", text))
            faults |= {f"{path}: {key}" for key in cited(text) - listed}
    return sorted(faults)


STRING = re.compile(r'"(?:\\.|[^"\\])*"|\'(?:\\.|[^\'\\])\'')
HANDED_ON = re.compile(r"if \(!(\w+)\) return fail\(\1\.error\(\)\);|if \(auto (\w+) = [^;]+; !\2\) return fail\(\2\.error\(\)\);")
MOST_FIELDS = 4  # code, what, where, hint


def fields_by_position(text):
    """Numbers of fields of the errors that are written as {ErrorCode::..., ...}."""
    text = re.sub(r"//.*", "", STRING.sub('""', text))
    out = []
    for found in re.finditer(r"\{\s*ErrorCode::", text):
        depth, fields = 0, 1
        for c in text[found.start():]:
            depth += (c in "({[") - (c in ")}]")
            fields += c == "," and depth == 1
            if depth == 0:
                break
        out.append(fields)
    return out


def ways_of_errors(root, files):
    faults = []
    for path in files:
        if str(path).startswith(("src/", "apps/", "include/")) and path.suffix in (".h", ".cpp"):
            text = (root / path).read_text(encoding="utf-8", errors="replace")
            if any(n > MOST_FIELDS for n in fields_by_position(text)):
                faults.append(f"{path}: an error of more than {MOST_FIELDS} fields by position: use error(...).where(...)")
            if HANDED_ON.search(text):
                faults.append(f"{path}: an error is handed on without OBVID_TRY")
    return faults


NEEDS_NUMPY = re.compile(r"^\s*((import|from) (numpy|scipy)\b|from acceptance_sets import (cuts|milling)\b)", re.M)


def without_numpy(text, folder):
    """Tests whose script needs numpy, and that are given to a Python that may have none: they would be skipped."""
    return [name for name in re.findall(r'COMMAND Python3::Interpreter -B "\$\{CMAKE_CURRENT_SOURCE_DIR\}/([\w./]+\.py)"', text)
            if NEEDS_NUMPY.search((folder / name).read_text())]


class House(unittest.TestCase):
    def test_scripts_that_need_numpy_are_run_by_the_python_that_has_it(self):
        lists = sorted((ROOT / "tests").rglob("CMakeLists.txt"))
        self.assertEqual([(str(one), without_numpy(one.read_text(), one.parent)) for one in lists
                          if without_numpy(one.read_text(), one.parent)], [])
        with tempfile.TemporaryDirectory() as name:
            (pathlib.Path(name) / "a.py").write_text("    import numpy as np\n")
            self.assertEqual(without_numpy('COMMAND Python3::Interpreter -B "${CMAKE_CURRENT_SOURCE_DIR}/a.py"',
                                           pathlib.Path(name)), ["a.py"])

    def test_errors_are_told_field_by_field_and_handed_on_in_one_way(self):
        self.assertEqual(ways_of_errors(ROOT, project_files(ROOT)), [])
        self.assertEqual(fields_by_position('fail({ErrorCode::kX, "a, b", f(1, 2), {}, -1, 0.0});  // {ErrorCode::a, b'), [6])
        self.assertTrue(HANDED_ON.search("  if (!made) return fail(made.error());"))
        self.assertTrue(HANDED_ON.search("  if (auto done = f(); !done) return fail(done.error());"))

    def test_what_is_cited_stands_among_the_sources(self):
        self.assertEqual(unknown_sources(ROOT, project_files(ROOT)), [])

    def test_sources_that_are_not_listed_are_seen(self):
        self.assertEqual(cited("after [Higham 2002], Karney (2011), Boyd & Vandenberghe 2004 and [000]"),
                         {"Higham 2002", "Karney 2011", "Boyd 2004", "000"})
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            for path, text in {"docs/sources.md": "| [000] | x |\n| [Karney 2011] | y |\n",
                               "src/a.cpp": "// [000], Karney (2011), Gauss 1809\nint Table_1999;\n"}.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            self.assertEqual(unknown_sources(root, [pathlib.PurePosixPath("src/a.cpp")]), ["src/a.cpp: Gauss 1809"])

    def test_every_source_file_says_its_licence(self):
        files = project_files(ROOT)
        self.assertGreater(len(files), 500)
        self.assertEqual(without_licence(ROOT, files), [])

    def test_every_data_file_has_its_source_and_licence_listed(self):
        files = project_files(ROOT)
        self.assertGreater(sum(map(is_data, files)), 40)
        self.assertEqual(data_faults(ROOT, files), [])

    def test_every_row_of_the_list_has_a_source_and_a_licence(self):
        for line in (ROOT / "tests/data/README.md").read_text(encoding="utf-8").splitlines():
            if line.startswith("| `"):
                cells = [cell.strip() for cell in line.strip("|").split("|")]
                self.assertEqual(len(cells), 3, line)
                self.assertTrue(all(cells), line)

    def test_the_copyright_holder_is_one(self):
        line = "Copyright 2026 The Obvid authors"
        for name in ("LICENSE", "NOTICE"):
            self.assertIn(line, (ROOT / name).read_text(encoding="utf-8"), name)

    def test_what_is_linked_is_in_the_notice(self):
        notice = (ROOT / "NOTICE").read_text(encoding="utf-8")
        packages = (ROOT / "tools/install_packages").read_text(encoding="utf-8")
        wanted = re.search(r'build_packages="([^"]*)"', packages)[1].split()
        wanted += re.search(r'cad_packages="([^"]*)"', packages)[1].split()
        libraries = [name for name in wanted if name.endswith("-dev")]
        self.assertGreater(len(libraries), 5)
        for name in libraries:
            self.assertIn(name, notice)

    def test_the_checks_see(self):
        with tempfile.TemporaryDirectory() as name:
            root = pathlib.Path(name)
            files = {"a.cpp": f"// {SPDX}\n", "b.cpp": "int x;\n", "tool": "#!/bin/sh\n",
                     "README.md": "no licence\n", "tests/data/known": "1\n",
                     "tests/data/unknown": "2\n",
                     "tests/data/README.md": "| `tests/data/known` | ours | Apache-2.0 |\n"
                                             "| `tests/data/gone` | ours | Apache-2.0 |\n"}
            for path, text in files.items():
                (root / path).parent.mkdir(parents=True, exist_ok=True)
                (root / path).write_text(text)
            found = [pathlib.PurePosixPath(path) for path in files]
            self.assertEqual(without_licence(root, found), ["b.cpp", "tool"])
            self.assertEqual(data_faults(root, found),
                             ["tests/data/unknown is not listed",
                              "tests/data/gone is listed and not there"])


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
