#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The program starts its own helper and nothing else, wherever hostile files lie.

usage: cad_helper_test.py PROGRAM C_COMPILER EXAMPLES [HELPER]
Hostile are a library whose constructor leaves a trace, under the names that plugins had, and a
program that leaves one, under the names of the helper and of the studio.
"""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

PROGRAM, COMPILER, EXAMPLES = sys.argv[1:4]
HELPER = sys.argv[4] if len(sys.argv) > 4 else None

HOSTILE = """
#include <fcntl.h>
#include <unistd.h>
static void leave(void) { close(open(TRACE, O_CREAT | O_WRONLY, 0600)); }
__attribute__((constructor)) static void start(void) { leave(); }
#ifdef PROGRAM
int main(void) { return 0; }
#endif
"""


class Helper(unittest.TestCase):
    def setUp(self):
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="obvid-test-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.bin = self.folder / "top" / "bin"
        self.bin.mkdir(parents=True)
        self.program = shutil.copy(PROGRAM, self.bin / "obvid")
        self.trace = self.folder / "trace"
        source = self.folder / "hostile.c"
        source.write_text(HOSTILE)
        self.library, self.hostile = self.folder / "hostile.so", self.folder / "hostile"
        trace = f'-DTRACE="{self.trace}"'
        self.compile("-shared", "-fPIC", trace, source, "-o", self.library)
        self.compile("-DPROGRAM", trace, source, "-o", self.hostile)

    def compile(self, *args):
        subprocess.run([COMPILER, "-xc", *map(str, args)], check=True)

    def put(self, *folders):
        for folder in folders:
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copy(self.library, folder / "obvid_cad.so")
            shutil.copy(self.hostile, folder / "obvid-cad")
            shutil.copy(self.hostile, folder / "obvid-studio")

    def fit(self, cwd=None, ending="igs", **env):
        """Exit code and error line of a run that has to write IGES."""
        ours = ("OBVID_PLUGINS", "OBVID_CAD_BUILDER")
        clean = {k: v for k, v in os.environ.items() if k not in ours}
        done = subprocess.run(
            [self.program, "fit", f"{EXAMPLES}/series10.csv", "-o", self.folder / f"out.{ending}",
             "--quiet"], cwd=cwd or self.folder, env=clean | env, capture_output=True, text=True)
        return done.returncode, done.stderr

    def expect_refused(self, *words, **more):
        code, told = self.fit(**more)
        self.assertEqual(code, 3, told)
        for word in ("E310", *words):
            self.assertIn(word, told)
        self.assertFalse(self.trace.exists(), "hostile code ran")
        self.assertFalse((self.folder / "out.igs").exists())

    def test_the_traps_work(self):
        subprocess.run([self.hostile], check=True)
        self.assertTrue(self.trace.exists())
        self.trace.unlink()
        subprocess.run([sys.executable, "-c", "import ctypes, sys; ctypes.CDLL(sys.argv[1])",
                        str(self.library)], check=True)
        self.assertTrue(self.trace.exists())

    def test_parent_working_and_former_folders_are_not_looked_at(self):
        here = self.folder / "here"
        self.put(self.folder / "top", here, self.folder / "top" / "lib" / "obvid")
        self.expect_refused("not installed", cwd=here)
        self.expect_refused("not installed", cwd=here, LD_LIBRARY_PATH=str(here), PATH=str(here))

    def test_surfaces_are_refused_before_anything_is_read(self):
        clean = {k: v for k, v in os.environ.items() if k not in ("OBVID_PLUGINS", "OBVID_CAD_BUILDER")}
        missing, out = self.folder / "missing.json", self.folder / "out.step"
        for command in (("convert", missing), ("skin", missing), ("offset", missing, "--distance", "1"),
                        ("trim", missing, "--plane", "z=0", "--keep", "above"), ("cut", missing, "--waterlines", "0", "--fair", "1")):
            target = self.folder / "{id}.iges" if command[0] == "cut" else out
            done = subprocess.run([self.program, "surface", *map(str, command), "-o", target], cwd=self.folder, env=clean,
                                  capture_output=True, text=True)
            self.assertEqual(done.returncode, 3, done.stderr)
            self.assertIn("E310", done.stderr, command)
            self.assertIn("not installed", done.stderr)
            self.assertNotIn("E301", done.stderr)  # the input is missing, too: nobody looked

    def test_curves_are_refused_before_anything_is_read(self):
        clean = {k: v for k, v in os.environ.items() if k not in ("OBVID_PLUGINS", "OBVID_CAD_BUILDER")}
        missing = self.folder / "missing.csv"
        for command in (("fit", missing), ("fit", missing, missing), ("convert", missing), ("nurbs", missing),
                        ("alignment", missing)):
            for ending in ("iges", "brep"):
                target = self.folder / ("{id}." + ending if command.count(missing) > 1 else "out." + ending)
                done = subprocess.run([self.program, *map(str, command), "-o", target], cwd=self.folder, env=clean,
                                      capture_output=True, text=True)
                self.assertEqual(done.returncode, 3, done.stderr)
                self.assertIn("E310", done.stderr, command)
                self.assertIn("not installed", done.stderr)
                self.assertNotIn("E301", done.stderr)  # the input is missing, too: nobody looked
        done = subprocess.run([self.program, "spline", str(missing), "-o", self.folder / "out.step"], cwd=self.folder,
                              env=clean, capture_output=True, text=True)
        self.assertIn("E310", done.stderr)
        # STEP of curves is written without the helper: the input is what is missing
        done = subprocess.run([self.program, "fit", str(missing), "-o", self.folder / "out.step"], cwd=self.folder,
                              env=clean, capture_output=True, text=True)
        self.assertIn("E301", done.stderr)

    def test_a_helper_without_the_mark_is_not_started(self):
        self.put(self.bin)
        self.expect_refused("another build")

    def test_a_wrong_helper_beside_the_program_hides_no_right_one_silently(self):
        if not HELPER:
            self.skipTest("the helper for CAD files is not built")
        self.put(self.bin)
        right = self.folder / "top" / "libexec" / "obvid"
        right.mkdir(parents=True)
        shutil.copy(HELPER, right / "obvid-cad")
        self.expect_refused("another build")

    def test_a_named_folder_is_no_way_around_the_mark(self):
        named = self.folder / "named"
        self.put(named)
        self.expect_refused("another build", OBVID_PLUGINS=str(named))
        shutil.copyfile("/bin/sh", named / "obvid-cad")
        self.expect_refused("another build", OBVID_PLUGINS=str(named))

    def test_what_everybody_may_write_to_is_not_started(self):
        self.put(self.bin)
        (self.bin / "obvid-cad").chmod(0o777)
        self.expect_refused("everybody may write")

    def test_the_right_helper_is_started_from_each_of_its_places(self):
        if not HELPER:
            self.skipTest("the helper for CAD files is not built")
        named = self.folder / "named"
        for folder, env in ((self.bin, {}), (self.folder / "top" / "libexec" / "obvid", {}),
                            (named, {"OBVID_PLUGINS": str(named)})):
            folder.mkdir(parents=True, exist_ok=True)
            shutil.copy(HELPER, folder / "obvid-cad")
            code, told = self.fit(**env)
            self.assertEqual(code, 0, told)
            self.assertIn("126,", (self.folder / "out.igs").read_text())
            (self.folder / "out.igs").unlink()
            (folder / "obvid-cad").unlink()

    def test_step_of_curves_needs_no_helper(self):
        builder = self.folder / "builder"
        builder.write_text("#!/bin/sh\necho building >&2\nexit 1\n")
        builder.chmod(0o755)
        self.put(self.bin)
        for ending in ("step", "stp"):
            code, told = self.fit(ending=ending, OBVID_CAD_BUILDER=str(builder))
            self.assertEqual(code, 0, told)
            self.assertNotIn("building", told)
            self.assertFalse(self.trace.exists(), "hostile code ran")
            text = (self.folder / f"out.{ending}").read_text()
            self.assertTrue(text.startswith("ISO-10303-21"))

    def test_a_helper_that_is_missing_or_stale_is_built_when_it_is_needed(self):
        if not HELPER:
            self.skipTest("the helper for CAD files is not built")
        builder = self.folder / "builder"
        builder.write_text(f"#!/bin/sh\necho building\ncp {HELPER} {self.bin}/obvid-cad\n")
        builder.chmod(0o755)
        for stale in (False, True):
            if stale:
                self.put(self.bin)
            code, told = self.fit(OBVID_CAD_BUILDER=str(builder))
            self.assertEqual(code, 0, told)
            self.assertIn("building", told)
            self.assertFalse(self.trace.exists())
        code, told = self.fit(OBVID_CAD_BUILDER=str(builder))
        self.assertNotIn("building", told)

    def expect_no_studio(self, *words, cwd=None, **env):
        clean = {k: v for k, v in os.environ.items() if k != "OBVID_STUDIO_BUILDER"}
        done = subprocess.run([self.program, "studio", "--no-browser"], env=clean | env,
                              cwd=cwd or self.folder, capture_output=True, text=True, timeout=60)
        self.assertEqual(done.returncode, 3, done.stderr)
        for word in ("E310", *words):
            self.assertIn(word, done.stderr)
        self.assertFalse(self.trace.exists(), "hostile code ran")

    def test_no_other_studio_than_that_of_this_build_is_started(self):
        here = self.folder / "here"
        self.put(self.folder / "top", here)
        self.expect_no_studio("not built", cwd=here, PATH=str(here), OBVID_PLUGINS=str(here))
        self.put(self.folder / "top" / "libexec" / "obvid")
        self.expect_no_studio("the studio is not started", "another build")
        self.put(self.bin)
        self.expect_no_studio("another build")
        (self.bin / "obvid-studio").chmod(0o777)
        self.expect_no_studio("everybody may write")

    def test_a_builder_that_fails_leaves_the_reason(self):
        builder = self.folder / "builder"
        builder.write_text("#!/bin/sh\nexit 1\n")
        builder.chmod(0o755)
        self.expect_refused("not installed", OBVID_CAD_BUILDER=str(builder))
        self.expect_refused("not installed", OBVID_CAD_BUILDER=str(self.folder / "none"))

    def test_a_link_to_the_program_leads_to_its_helper(self):
        if not HELPER:
            self.skipTest("the helper for CAD files is not built")
        shutil.copy(HELPER, self.bin / "obvid-cad")
        elsewhere = self.folder / "elsewhere"
        self.put(elsewhere)
        self.program = elsewhere / "obvid"
        self.program.symlink_to(self.bin / "obvid")
        code, told = self.fit()
        self.assertEqual(code, 0, told)
        self.assertFalse(self.trace.exists())


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
