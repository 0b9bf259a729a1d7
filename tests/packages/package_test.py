# SPDX-License-Identifier: Apache-2.0
"""The Debian package of this build, unpacked into a folder and used from there; tools/try_package installs one in a
clean system. usage: package_test.py BUILD_FOLDER PROJECT_FOLDER CPACK     exit code 77: not Debian"""
import os
import pathlib
import select
import shutil
import subprocess
import sys
import tempfile
import unittest
import urllib.request

BUILD, PROJECT, CPACK = pathlib.Path(sys.argv[1]), pathlib.Path(sys.argv[2]), sys.argv[3]
POINTS = PROJECT / "examples/series10.csv"
CLEAN = {"PATH": "/usr/bin:/bin", "HOME": "/nonexistent", "LC_ALL": "C.UTF-8"}


def output(*words, **more):
    done = subprocess.run([str(w) for w in words], capture_output=True, text=True, **{"env": CLEAN, **more})
    if done.returncode != 0:
        raise AssertionError(f"{words}: {done.returncode}\n{done.stdout}\n{done.stderr}")
    return done.stdout


class Package(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.at = pathlib.Path(cls.place.name)
        output(CPACK, "-G", "DEB", "--config", BUILD / "CPackConfig.cmake", "-B", cls.at / "packed",
               "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=gzip", env=os.environ)
        [cls.package] = (cls.at / "packed").glob("*.deb")
        cls.root = cls.at / "root"
        output("dpkg-deb", "-x", cls.package, cls.root)
        cls.obvid = cls.root / "usr/bin/obvid"

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def field(self, name):
        return output("dpkg-deb", "-f", self.package, name).strip()

    def test_it_says_what_it_is_and_needs(self):
        version = (PROJECT / "VERSION").read_text().strip()
        self.assertEqual(self.field("Package"), "obvid")
        self.assertEqual(self.field("Version"), f"{version}-1")
        self.assertIn("@", self.field("Maintainer"))
        needs = self.field("Depends")
        for library in ("libc6", "libstdc++6", "libfmt9", "libhdf5-", "libsqlite3-0", "libzip4",
                        "libocct-data-exchange", "python3-numpy"):
            self.assertIn(library, needs)
        self.assertNotIn("-dev", needs)
        self.assertIn("libobvid_c 1 obvid", output("dpkg-deb", "-I", self.package, "shlibs"))

    def test_nothing_is_of_this_build_or_for_everybody_to_change(self):
        said = output("dpkg-deb", "-c", self.package)
        self.assertNotRegex(said, r"__pycache__|CMakeFiles|\.o$")
        for line in said.splitlines():
            self.assertRegex(line, r"^(-rw-r--r--|-rwxr-xr-x|drwxr-xr-x|lrwxrwxrwx) root/root ")

    def test_the_program_finds_its_parts(self):
        made = self.at / "made"
        made.mkdir()
        said = output(self.obvid, "fit", POINTS, "-o", made / "c.json", "-o", made / "c.step", "-o", made / "c.igs")
        self.assertIn("proved", said)
        self.assertIn("proved", output(self.obvid, "verify", made / "c.json"))
        self.assertIn("vertices", output(self.obvid, "analyse", made / "c.igs"))
        output(self.obvid, "batch", POINTS, "-o", made / "out.h5", "--quiet")
        rows = output(self.obvid, "batch", "query", made / "out.h5", "proved = 1", "--columns", "vertices", "--csv")
        self.assertEqual(rows.split(), ["vertices", "0"])

    def test_the_studio_serves_its_page(self):
        with subprocess.Popen([self.obvid, "studio", "--no-browser", POINTS], env=CLEAN, text=True,
                              stdout=subprocess.PIPE) as studio:
            try:
                ready, _, _ = select.select([studio.stdout], [], [], 30)
                self.assertTrue(ready)
                address = studio.stdout.readline().strip()
                with urllib.request.urlopen(address, timeout=30) as answer:
                    self.assertIn("<title>Obvid studio</title>", answer.read().decode())
            finally:
                studio.terminate()

    def test_the_python_package_finds_its_library(self):
        said = output(sys.executable, "-B", "-c",
                      "import numpy, obvid, sys; c = obvid.fit(numpy.loadtxt(sys.argv[1], delimiter=',', skiprows=1)); "
                      "print(obvid.__file__, c.proved, c.certificate.vertices); print(c.write(sys.argv[2]))",
                      POINTS, self.at / "python.igs",
                      env={**CLEAN, "PYTHONPATH": str(self.root / "usr/lib/python3/dist-packages")})
        self.assertIn(str(self.root), said)
        self.assertIn("True 0", said)

    def test_a_c_program_is_compiled_by_pkg_config(self):
        flags = output("pkg-config", "--cflags", "--libs", "obvid_c",
                       env={**CLEAN, "PKG_CONFIG_PATH": str(self.root / "usr/lib/pkgconfig")}).split()
        output("cc", "-std=c11", PROJECT / "examples/fit.c", *flags, "-lm", "-o", self.at / "fit")
        said = output(self.at / "fit", POINTS, env={**CLEAN, "LD_LIBRARY_PATH": str(self.root / "usr/lib")})
        self.assertTrue(said.strip())

    def test_documents_are_where_debian_looks(self):
        share = self.root / "usr/share"
        for file in ("man/man1/obvid.1.gz", "man/man1/obvid-fit.1.gz", "man/man1/obvid-batch.1.gz",
                     "man/man1/obvid-studio.1.gz", "bash-completion/completions/obvid", "obvid/studio.html",
                     "fish/vendor_completions.d/obvid.fish", "doc/obvid/copyright", "doc/obvid/changelog.gz",
                     "doc/obvid/changelog.Debian.gz"):
            self.assertTrue((share / file).is_file(), file)
        self.assertTrue(list((share / "zsh").rglob("_obvid")))
        self.assertIn("Open CASCADE", (share / "doc/obvid/copyright").read_text())

    def test_the_workbench_is_loaded_by_freecad(self):
        mod = self.root / "usr/share/freecad/Mod/Obvid"
        self.assertNotIn("@VERSION@", (mod / "package.xml").read_text())
        lib = pathlib.Path("/usr/lib/freecad-python3/lib")
        if not lib.is_dir():
            print("FreeCAD is not installed: the workbench is not loaded")
            return
        said = output(sys.executable, "-B", "-c",
                      "import sys; sys.path[:0] = sys.argv[1:4]; import FreeCAD, Part; from obvid_freecad import fair_curve\n"
                      "doc = FreeCAD.newDocument('t'); import csv\n"
                      "rows = [tuple(map(float, r)) for r in list(csv.reader(open(sys.argv[4])))[1:]]\n"
                      "s = doc.addObject('Sketcher::SketchObject', 'S')\n"
                      "s.addGeometry([Part.Point(FreeCAD.Vector(x, y, 0)) for x, y in rows], False); doc.recompute()\n"
                      "c = fair_curve.new(doc, [s]); doc.recompute(); print('VERDICT', c.Verdict, c.Proved)",
                      lib, mod, self.root / "usr/lib/python3/dist-packages", POINTS,
                      env={**CLEAN, "HOME": str(self.at)})
        self.assertRegex(said, r"VERDICT .*True")


if __name__ == "__main__":
    if not shutil.which("dpkg-shlibdeps"):
        print("SKIPPED: dpkg-shlibdeps is not there: no Debian system")
        sys.exit(77)
    unittest.main(argv=sys.argv[:1])
