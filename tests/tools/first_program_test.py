# SPDX-License-Identifier: Apache-2.0
"""The launcher's first program against the whole one: the same bytes for what it holds, and for all
else it starts the launcher once, with its own arguments and the whole of standard input.
usage: first_program_test.py FIRST WHOLE EXAMPLES"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

FIRST, WHOLE, EXAMPLES = (pathlib.Path(word).resolve() for word in sys.argv[1:4])
POINTS = str(EXAMPLES / "series10.csv")
HELIX = "".join(f"{x},{x * x / 9},{x / 3}\n" for x in range(6))
DXF = "0\nSECTION\n2\nENTITIES\n" + "".join(
    f"0\nLINE\n8\n0\n10\n{x}\n20\n{x * x}\n11\n{x + 1}\n21\n{(x + 1) ** 2}\n" for x in range(4)
) + "0\nENDSEC\n0\nEOF\n"

HELD = [["fit", POINTS], ["fit", POINTS, "--json"], ["fit", POINTS, "-o", "a.json", "-o", "a.svg"],
        ["fit", POINTS, "--continuity", "G2", "-o", "a.json"], ["fit", POINTS, "--carrier", "clothoids"],
        ["fit", POINTS, "--carrier", "bspline", "--noise", "1e-3", "--json"],
        ["fit", "missing.csv"], ["analyse", POINTS], ["analyse", POINTS, "--json", "-o", "b.svg"],
        ["explain", "E401"], ["--version"], ["--help"], ["fit", "--help"], ["fit", "--unheard-of"]]
LATER = [["region", POINTS], ["compare", POINTS, "--json"], ["fit", POINTS, "-o", "a.step"],
         ["fit", POINTS, "-o", "a.dxf", "-o", "a.nc"], ["fit", POINTS, "-o", "a.csv"],
         ["fit", "helix.csv", "--along", "z"], ["fit", "drawing.dxf"], ["analyse", "drawing.dxf"],
         ["verify", "contour.json"], ["convert", "contour.json", "-o", "c.svg"],
         ["surface", "--help"], ["spline", "--help"], ["nurbs", "--help"], ["toolpath", "--help"],
         ["cut", "--help"]]

TIMES = re.compile(rb'"seconds": [-+.0-9e]+|\s*\b[.0-9]+ [mu]?s\b')  # of the run


class FirstProgram(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.top = pathlib.Path(folder.name)
        self.log = self.top / "log"
        self.launcher = self.top / "launcher"
        self.launcher.write_text(f'#!/bin/sh\necho "$OBVID_WHOLE $*" >>"{self.log}"\n'
                                 f'exec "{WHOLE}" "$@"\n', encoding="utf-8")
        self.launcher.chmod(0o755)
        self.count = 0
        subprocess.run([WHOLE, "fit", POINTS, "--quiet", "-o", self.top / "contour.json"], check=True)
        self.contour = (self.top / "contour.json").read_bytes()

    def run_in_new_folder(self, program, arguments, stdin=b"", launcher=True):
        self.count += 1
        place = self.top / str(self.count)
        place.mkdir()
        (place / "helix.csv").write_text(HELIX, encoding="utf-8")
        (place / "drawing.dxf").write_text(DXF, encoding="utf-8")
        (place / "contour.json").write_bytes(self.contour)
        variables = {k: v for k, v in os.environ.items() if not k.startswith("OBVID_")}
        if launcher:
            variables["OBVID_LAUNCHER"] = str(self.launcher)
        how = {"stdin": stdin} if hasattr(stdin, "fileno") else {"input": stdin}
        done = subprocess.run([program, *arguments], cwd=place, env=variables, capture_output=True,
                              check=False, timeout=120, **how)
        files = {path.name: TIMES.sub(b"", path.read_bytes()) for path in sorted(place.iterdir())}
        return done.returncode, TIMES.sub(b"", done.stdout), done.stderr, files

    def started(self):
        text = self.log.read_text(encoding="utf-8") if self.log.exists() else ""
        self.log.unlink(missing_ok=True)
        return text.splitlines()

    def test_what_it_holds_gives_the_bytes_of_the_whole_program(self):
        for arguments in HELD:
            with self.subTest(arguments):
                whole = self.run_in_new_folder(WHOLE, arguments)
                self.assertEqual(self.run_in_new_folder(FIRST, arguments), whole)
                self.assertEqual(self.started(), [])

    def test_for_all_else_it_goes_on_in_the_whole_program(self):
        for arguments in LATER:
            with self.subTest(arguments):
                whole = self.run_in_new_folder(WHOLE, arguments)
                self.assertEqual(self.run_in_new_folder(FIRST, arguments), whole)
                self.assertEqual(self.started(), ["1 " + " ".join(arguments)])

    def test_standard_input_is_read_again_from_a_pipe_and_from_where_a_file_stood(self):
        texts = (DXF, HELIX, pathlib.Path(POINTS).read_text(encoding="utf-8"))
        for arguments in (["fit", "-", "-o", "a.step"], ["fit", "-o", "a.step"],
                          ["fit", "-o", "-", "--format", "step"]):
            for text in texts:
                with self.subTest(arguments, text=text[:20]):
                    whole = self.run_in_new_folder(WHOLE, arguments, text.encode())
                    self.assertEqual(self.run_in_new_folder(FIRST, arguments, text.encode()), whole)
                    path = self.top / "input"
                    path.write_text("to be left out\n" + text, encoding="utf-8")
                    with path.open("rb", buffering=0) as file:
                        file.seek(len("to be left out\n"))
                        self.assertEqual(self.run_in_new_folder(FIRST, arguments, file), whole)
                    self.assertEqual(len(self.started()), 2)

    def test_standard_input_that_is_not_read_may_stay_open(self):
        silent, end = os.pipe()
        try:
            with os.fdopen(silent, "rb", buffering=0) as pipe:
                code, out, _, _ = self.run_in_new_folder(FIRST, ["fit", POINTS, "-o", "-"], pipe)
        finally:
            os.close(end)
        self.assertEqual(code, 0)
        self.assertIn(b"obvid-contour", out)

    def test_without_the_launcher_it_says_what_it_is(self):
        code, out, err, _ = self.run_in_new_folder(FIRST, ["region", POINTS], launcher=False)
        self.assertEqual((code, out), (3, b""))
        self.assertIn(b"E310", err)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
