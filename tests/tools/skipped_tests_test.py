# SPDX-License-Identifier: Apache-2.0
"""tools/skipped_tests against reports as ctest 3.25 writes them."""
import pathlib
import subprocess
import sys
import tempfile
import unittest

TOOL = pathlib.Path(__file__).resolve().parents[2] / "tools/skipped_tests"
REPORT = '<?xml version="1.0"?>\n<testsuite tests="2">\n{}</testsuite>'
RUN = '<testcase name="ran" status="run"><system-out>[ OK ]</system-out></testcase>\n'
SKIPPED = ('<testcase name="left out" status="notrun"><skipped message="SKIP_REGULAR_EXPRESSION_MATCHED"/>'
           "<system-out>{}</system-out></testcase>\n")


def judged(*cases):
    with tempfile.TemporaryDirectory() as folder:
        path = pathlib.Path(folder) / "report.xml"
        path.write_text(REPORT.format(RUN + "".join(cases)), encoding="utf-8")
        done = subprocess.run([sys.executable, "-B", TOOL, path], capture_output=True, text=True, check=False)
    return done.returncode, done.stdout


class SkippedTests(unittest.TestCase):
    def test_nothing_skipped(self):
        self.assertEqual(judged(), (0, "0 skipped, 0 of them should have run\n"))

    def test_what_no_package_brings_may_be_skipped_and_is_told(self):
        code, said = judged(SKIPPED.format("a.cpp:3: Skipped\nthe public data sets are missing (OBVID_SHARED_DATA)\n"))
        self.assertEqual(code, 0)
        self.assertIn("skipped: left out: the public data sets are missing", said)
        self.assertIn("1 skipped, 0 of them", said)

    def test_engines_that_share_batches_out_may_be_missing(self):
        for text in ("SKIPPED: sbatch is not installed", "SKIPPED: python3-distributed is not installed"):
            self.assertEqual(judged(SKIPPED.format(text))[0], 0)

    def test_a_missing_package_or_an_unknown_reason_is_a_failure(self):
        for text in ("a.cpp:3: Skipped\nFreeCAD is not installed\n", "SKIPPED: chromium is not installed",
                     "hello", ""):
            with self.subTest(text):
                code, said = judged(SKIPPED.format(text))
                self.assertEqual(code, 1)
                self.assertIn("SKIPPED, BUT SHOULD RUN: left out", said)

    def test_a_program_that_was_not_built_should_have_run(self):
        code, _ = judged('<testcase name="x_NOT_BUILT" status="notrun">'
                         '<skipped message="Unable to find executable"/></testcase>')
        self.assertEqual(code, 1)


if __name__ == "__main__":
    unittest.main()
