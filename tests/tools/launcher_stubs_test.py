# SPDX-License-Identifier: Apache-2.0
"""The launcher's decisions, with stubs for cmake, ninja, apt-get and sudo: when it builds, what it
says, what it leaves alone. tests/tools/launcher_test builds the real program."""
import os
import pathlib
import shutil
import subprocess
import tempfile
import unittest

PROJECT = pathlib.Path(__file__).resolve().parents[2]
SOURCES = {"CMakeLists.txt": "", "VERSION": "1\n", "cmake/a.cmake": "", "include/a.h": "int a;\n",
           "src/a.cpp": "int a = 1;\n", "src/name with blanks.cpp": "", "apps/main.cpp": ""}

CMAKE = """#!/bin/sh
echo "cmake" >>"$STUB_LOG"
while [ $# -gt 0 ]; do case $1 in -S) root=$2 ;; -B) build=$2 ;; esac; shift; done
echo "CMAKE_HOME_DIRECTORY:INTERNAL=$root" >"$build/CMakeCache.txt"
printf 'build a: b\\n\\nbuild build.ninja: RERUN_CMAKE c\\n  pool = console\\n\\nbuild d: e\\n' >"$build/build.ninja"
"""

# The program is built when a source is newer, as ninja does it.
NINJA = """#!/bin/sh
cd "$2"; shift 2
case "$*" in
  *-n*) case "$*" in "-f .plan.ninja -n "*) ;; *) exit 2 ;; esac
    grep -q RERUN_CMAKE .plan.ninja && { echo "[1/2] Re-running CMake"; exit 0; }
    [ -n "$STUB_IDLE" ] || echo "[1/4] a step"; exit 0 ;;
  "-t clean") echo "clean" >>"$STUB_LOG"; rm -f obvid obvid-first; exit 0 ;;
esac
for target; do :; done
[ -n "$STUB_FAIL" ] && { echo "FAILED: a.o"; echo "a.cpp:1: error: no"; exit 1; }
[ -n "$STUB_SLOW" ] && { echo "[1/4] one"; sleep "$STUB_SLOW"; echo "[2/4] two"; }
case $target in
obvid | obvid_first)
  file=$(echo $target | tr _ -)
  if [ ! -e $file ] || [ -n "$(find ../../src ../../VERSION -newer $file)" ]; then
    echo "ninja $target" >>"$STUB_LOG"
    sleep "${STUB_SECONDS:-0}"
    cat >$file <<'PROGRAM'
#!/bin/sh
case "$0 $1" in *obvid-first" surface") OBVID_WHOLE=1 exec "$OBVID_LAUNCHER" "$@" ;; esac
case $0 in *obvid-first) echo "program $*" ;; *) echo "whole program $*" ;; esac
[ "$1" = helper ] && { [ -e "$(dirname "$0")/obvid-cad" ] || "$OBVID_CAD_BUILDER" >&2; }
[ "$1" = read ] && cat
exit ${STUB_CODE:-0}
PROGRAM
    chmod +x $file
  fi ;;
*) echo "ninja $target" >>"$STUB_LOG"; : >obvid-cad ;;
esac
"""

APT = """#!/bin/sh
echo "apt-get $*" >>"$STUB_LOG"
case "$*" in
  *--assume-no*) [ -e "$STUB_LOG.lists" ] || exit 100
    echo "Need to get 12.3 MB of archives."
    echo "After this operation, 45.6 MB of additional disk space will be used."; exit 1 ;;
  *update*) : >"$STUB_LOG.lists" ;;
  *install*) [ -e "$STUB_LOG.lists" ] ;;
esac
"""


class Launcher(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        top = pathlib.Path(folder.name)
        self.root, self.stubs, self.log = top / "a project", top / "stubs", top / "log"
        for path, text in SOURCES.items():
            self.write(path, text)
        (self.root / "tools").mkdir()
        shutil.copy(PROJECT / "obvid", self.root)
        for tool in ("build_release", "build_cad", "install_packages"):
            shutil.copy(PROJECT / "tools" / tool, self.root / "tools")
        self.stub("cmake", CMAKE)
        self.stub("ninja", NINJA)
        self.build = self.root / "build/release"

    def write(self, path, text):
        (self.root / path).parent.mkdir(parents=True, exist_ok=True)
        (self.root / path).write_text(text, encoding="utf-8")

    def stub(self, name, text):
        self.stubs.mkdir(exist_ok=True)
        (self.stubs / name).write_text(text, encoding="utf-8")
        (self.stubs / name).chmod(0o755)

    def environment(self, **more):
        return {**os.environ, "PATH": f"{self.stubs}:{os.environ['PATH']}", "STUB_LOG": str(self.log),
                "STUB_IDLE": "", "STUB_FAIL": "", "STUB_SLOW": "", "OBVID_SKIP_PACKAGES": "1", **more}

    def start(self, *arguments, code=0, stdin=None, **environment):
        done = subprocess.run([self.root / "obvid", *arguments], capture_output=True, text=True,
                              env=self.environment(**environment), input=stdin)
        self.assertEqual(done.returncode, code, done.stdout + done.stderr)
        return done

    def steps(self):
        text = self.log.read_text() if self.log.exists() else ""
        self.log.unlink(missing_ok=True)
        return text.splitlines()

    def test_the_first_start_builds_and_says_how_long_the_second_is_silent(self):
        first = self.start("one", "two words")
        self.assertEqual(first.stdout, "program one two words\n")
        # four steps of 6 s, on so many processors
        self.assertRegex(first.stderr, r"building the program \(once, about [123]0 s with \d+ processors")
        self.assertEqual(self.steps(), ["cmake", "ninja obvid_first"])
        self.assertEqual(self.start("x").stderr, "")
        self.assertEqual(self.steps(), [])

    def test_another_content_is_built_whatever_its_time(self):
        self.start()
        self.steps()
        self.write("src/a.cpp", "int a = 2;\n")  # as long as before
        os.utime(self.root / "src/a.cpp", (10**9, 10**9))
        self.start()
        self.assertEqual(self.steps(), ["cmake", "ninja obvid_first"])
        self.start()
        self.assertEqual(self.start().stderr, "")
        self.assertEqual(self.steps(), [])

    def test_another_content_of_the_same_size_and_time_is_built(self):
        for path in SOURCES:  # as archives that can be made again are unpacked
            os.utime(self.root / path, (10**9, 10**9))
        self.start()
        self.steps()
        self.write("src/a.cpp", "int a = 2;\n")
        os.utime(self.root / "src/a.cpp", (10**9, 10**9))
        self.start()
        self.assertEqual(self.steps(), ["cmake", "ninja obvid_first"])
        self.assertEqual(self.start().stderr, "")

    def test_a_copy_that_its_user_may_not_write_to_runs_as_long_as_its_content_is_that(self):
        self.start()
        self.steps()
        shutil.copytree(self.root, self.root.with_name("a copy"))  # other times
        self.root = self.root.with_name("a copy")
        folder, builder = self.root / "build/release", self.root / "tools/build_release"
        text = builder.read_text()
        self.assertEqual(text.count('[ ! -w "$build" ]'), 1)  # root may write everywhere
        builder.write_text(text.replace('[ ! -w "$build" ]', "true"))
        before = sorted((p.name, p.stat().st_mtime_ns) for p in folder.iterdir())
        self.assertEqual(self.start("x").stdout, "program x\n")
        self.assertEqual(sorted((p.name, p.stat().st_mtime_ns) for p in folder.iterdir()), before)
        self.write("src/a.cpp", "int a = 2;\n")
        self.assertIn("cannot write to", self.start("x", code=1).stderr)

    def test_sources_that_cannot_be_made_newer_are_built_from_nothing(self):
        self.start()
        self.steps()
        self.write("src/a.cpp", "int a = 2;\n")
        os.utime(self.root / "src/a.cpp", (10**9, 10**9))
        self.stub("touch", "#!/bin/sh\nexit 1\n")
        self.start()
        self.assertIn("clean", self.steps())

    def test_new_removed_and_renamed_sources_are_noticed(self):
        self.start()
        for change in (lambda: self.write("src/b.cpp", ""),
                       lambda: (self.root / "src/b.cpp").rename(self.root / "src/c.cpp"),
                       lambda: (self.root / "src/c.cpp").unlink()):
            self.steps()
            change()
            self.start()
            self.assertIn("cmake", self.steps())

    def test_other_times_alone_do_not_build(self):
        self.start()
        self.steps()
        for path in SOURCES:
            os.utime(self.root / path, (2 * 10**9, 2 * 10**9))
        self.assertEqual(self.start().stderr, "")
        self.assertEqual(self.steps(), [])

    def test_the_second_of_two_first_starts_does_not_build_again(self):
        both = [subprocess.Popen([self.root / "obvid", "x"], stdout=subprocess.PIPE,
                                 stderr=subprocess.PIPE, env=self.environment(STUB_SECONDS="1"))
                for _ in range(2)]
        for one in both:
            out, err = one.communicate(timeout=60)
            self.assertEqual((one.returncode, out), (0, b"program x\n"), err)
        self.assertEqual(self.steps(), ["cmake", "ninja obvid_first"])

    def test_a_failed_build_is_told_and_tried_again(self):
        done = self.start(code=1, STUB_FAIL="1")
        self.assertIn("a.cpp:1: error: no", done.stderr)
        self.assertIn("build.log", done.stderr)
        self.assertEqual(done.stdout, "")
        self.start()
        self.assertIn("ninja obvid_first", self.steps())

    def test_a_failed_rebuild_does_not_run_the_old_program(self):
        self.start()
        self.write("src/a.cpp", "int a = 22;\n")
        self.assertEqual(self.start(code=1, STUB_FAIL="1").stdout, "")
        self.assertEqual(self.start(code=1, STUB_FAIL="1").stdout, "")

    def test_a_full_disk_is_named_before_and_after_the_build(self):
        self.stub("df", "#!/bin/sh\nprintf 'Filesystem\\n/dev/x 1000 1000 3 99%% /\\n'\n")
        self.assertIn("the disk is full: 3 MB are free", self.start(code=1).stderr)
        self.stub("df", "#!/bin/sh\ngrep -q ninja \"$STUB_LOG.f\" && free=2 || free=9999\n"
                        "printf 'Filesystem\\n/dev/x 1000 1000 %s 99%% /\\n' $free\n")
        self.stub("ninja", NINJA.replace('[ -n "$STUB_FAIL" ] &&',
                                         'echo ninja >"$STUB_LOG.f"; [ -n "$STUB_FAIL" ] &&'))
        self.assertIn("the disk is full: 2 MB are free", self.start(code=1, STUB_FAIL="1").stderr)

    def test_progress_is_told_without_a_terminal(self):
        text = (self.root / "tools/build_release").read_text()
        self.assertIn("report_every=15 ", text)
        (self.root / "tools/build_release").write_text(
            text.replace("report_every=15 ", "report_every=1 "))
        self.assertRegex(self.start(STUB_SLOW="3").stderr, r"\n(obvid: 1 of 4 steps, about \d+ s left\n)+")

    def test_standard_input_stays_the_programs(self):
        self.assertEqual(self.start("read", stdin="0 0\n1 1\n").stdout, "program read\n0 0\n1 1\n")

    def test_the_exit_code_is_the_programs(self):
        self.start(code=7, STUB_CODE="7")
        self.start(code=7, STUB_CODE="7")

    def test_the_plugin_is_built_when_first_needed_and_again_after_a_change(self):
        self.start("x")
        self.assertNotIn("ninja obvid_cad_helper", self.steps())
        done = self.start("helper")
        self.assertRegex(done.stderr, r"building the CAD helper \(once, about \d+ s")
        self.assertEqual(done.stdout, "program helper\n")
        self.assertEqual(self.steps(), ["cmake", "ninja obvid_cad_helper"])
        self.assertEqual(self.start("helper").stderr, "")
        self.write("src/a.cpp", "int a = 23;\n")
        self.start("x")
        self.assertFalse((self.build / "obvid-cad").exists(), "a helper of other sources is left")
        self.start("helper")
        self.assertIn("ninja obvid_cad_helper", self.steps())

    def test_the_whole_program_is_built_when_first_needed_and_is_the_only_one_from_then_on(self):
        self.start("x")
        self.assertEqual(self.steps(), ["cmake", "ninja obvid_first"])
        done = self.start("surface", "skin", stdin="0 0\n")
        self.assertRegex(done.stderr, r"building the whole program \(once, about \d+ s")
        self.assertEqual(done.stdout, "whole program surface skin\n")
        self.assertEqual(self.steps(), ["cmake", "ninja obvid"])
        again = self.start("x")
        self.assertEqual((again.stdout, again.stderr), ("whole program x\n", ""))
        self.write("src/a.cpp", "int a = 24;\n")
        self.assertEqual(self.start("x").stdout, "whole program x\n")
        self.assertEqual(self.steps(), ["cmake", "ninja obvid"])

    def test_no_plugin_is_built_where_it_is_not_wanted(self):
        self.start("x", OBVID_CAD="0")
        done = subprocess.run([self.root / "obvid", "helper"], capture_output=True, text=True,
                              env={k: v for k, v in self.environment(OBVID_CAD="0").items()
                                   if k != "OBVID_CAD_BUILDER"})
        self.assertNotIn("building the CAD helper", done.stderr)

    def test_packages_are_named_with_their_size_before_they_are_installed(self):
        self.stub("dpkg-query", "#!/bin/sh\nexit 1\n")
        self.stub("apt-get", APT)
        self.stub("id", "#!/bin/sh\necho 0\n")
        said = self.start(OBVID_SKIP_PACKAGES="0").stderr
        self.assertRegex(said, r"missing, they are installed: cmake g\+\+ ninja-build")
        self.assertNotIn("libocct", said)
        self.assertIn("12.3 MB to download, 45.6 MB on the disk", said)
        self.assertLess(said.index("12.3 MB"), said.index("building the program"))
        steps = self.steps()
        self.assertLess(steps.index("apt-get -y -qq update"),
                        next(i for i, s in enumerate(steps) if "-qq install" in s))

    def test_sudo_is_asked_after_saying_for_what(self):
        self.stub("dpkg-query", "#!/bin/sh\nexit 1\n")
        self.stub("apt-get", APT)
        self.stub("id", "#!/bin/sh\necho 1000\n")
        self.stub("sudo", '#!/bin/sh\n[ "$1" = -n ] && shift\n'
                          'echo "sudo $*" >>"$STUB_LOG"; echo "SUDO $1" >&2; exec "$@"\n')
        said = self.start(OBVID_SKIP_PACKAGES="0").stderr
        self.assertIn("they are installed with sudo: cmake", said)
        self.stub("sudo", "#!/bin/sh\nexit 1\n")
        (self.build / ".listing").unlink()
        (self.build / ".hashes").unlink()
        said = self.start(OBVID_SKIP_PACKAGES="0", code=1).stderr
        self.assertIn("neither root nor allowed to use sudo", said)


if __name__ == "__main__":
    unittest.main()
