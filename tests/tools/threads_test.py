#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Every public header says in its second line how threads may use it; docs/threads.md lists the classes
that keep state.

usage: threads_test.py PROJECT_FOLDER
"""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv[1]).resolve()
FUNCTIONS = "#pragma once  // reentrant: docs/threads.md"
CLASSES = "#pragma once  // reentrant, an object is used by one thread at a time: docs/threads.md"


def fault(text):
    """What is wrong with a header's line, or None."""
    line = (text.splitlines() + ["", ""])[1]
    keeps_state = re.search(r"^class \w+", text, re.MULTILINE) is not None
    if line not in (FUNCTIONS, CLASSES):
        return "says nothing about threads"
    if (line == CLASSES) != keeps_state:
        return "its classes and its line differ"
    return None


class Threads(unittest.TestCase):
    def headers(self):
        found = [path for path in sorted((ROOT / "include/obvid").rglob("*.h"))
                 if "internal" not in path.parts and path.name != "obvid.h"]
        self.assertGreater(len(found), 30)
        return found

    def test_every_public_header_says_how_threads_may_use_it(self):
        faults = {str(path.relative_to(ROOT)): fault(path.read_text(encoding="utf-8")) for path in self.headers()}
        self.assertEqual({name: why for name, why in faults.items() if why}, {})

    def test_classes_that_keep_state_are_listed(self):
        listed = set(re.findall(r"^\| `(\w+)` \| `", (ROOT / "docs/threads.md").read_text(encoding="utf-8"), re.MULTILINE))
        classes = set()
        for path in self.headers():
            classes |= set(re.findall(r"^class (\w+)", path.read_text(encoding="utf-8"), re.MULTILINE))
        self.assertEqual(listed, classes)

    def test_the_c_interface_says_it(self):
        text = (ROOT / "include/obvid/obvid.h").read_text(encoding="utf-8")
        self.assertIn("Every call may be made from any thread", text)

    def test_sees(self):
        head = "// SPDX\n"
        self.assertIsNone(fault(head + FUNCTIONS + "\nint f();\n"))
        self.assertIsNone(fault(head + CLASSES + "\nclass Job {};\n"))
        self.assertIsNotNone(fault(head + "#pragma once\nint f();\n"))
        self.assertIsNotNone(fault(head + FUNCTIONS + "\nclass Job {};\n"))
        self.assertIsNotNone(fault(head + CLASSES + "\nint f();\n"))
        self.assertIsNotNone(fault(""))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
