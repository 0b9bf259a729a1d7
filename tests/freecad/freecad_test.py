#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Installs the workbench for a FreeCAD of its own home and runs the tests inside it: headless, reopened
without the addon, and in a window under a virtual screen. Exit code 77: FreeCAD (or the screen) is not here.

usage: freecad_test.py headless|window LIBRARY SOURCE_FOLDER [part of a test's name]
"""
import os
import shutil
import subprocess
import sys
import tempfile

WHAT, LIBRARY, SOURCES = sys.argv[1:4]
ONLY = sys.argv[4] if len(sys.argv) > 4 else ""
HERE = os.path.join(SOURCES, "tests/freecad")
NOT_HERE = 77
LONGEST_S = 540


def tried(command, environment, script):
    """Runs a script inside FreeCAD; how many of its tests failed."""
    done = subprocess.run([*command, script], env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, timeout=LONGEST_S)  # fmt: skip
    text = done.stdout.decode(errors="replace").replace("\t", "\n")
    lines = [line for line in text.split("\n") if line.strip() and "%)" not in line]
    results = [line for line in lines if line.startswith(("TEST ", "DRAG "))]
    ends = [line for line in lines if line.startswith("FREECAD DONE")]
    tests = [line for line in results if line.startswith("TEST ")]
    bad = sum(not line.endswith(" ok") for line in tests)
    if not ends or int(ends[0].split()[-1]) != len(tests) or not tests:
        bad += 1
        print(f"{os.path.basename(script)} did not come to its end")
    print("\n".join(lines[-200:] if bad else results))
    return bad


def main():
    program = shutil.which("freecadcmd") or shutil.which("FreeCADCmd")
    window = shutil.which("freecad") or shutil.which("FreeCAD")
    if program is None or (WHAT == "window" and window is None):
        print("FreeCAD is not installed (Debian: freecad-python3; with a window: freecad)")
        return NOT_HERE
    if WHAT == "window" and shutil.which("xvfb-run") is None:
        print("there is no virtual screen (Debian: xvfb)")
        return NOT_HERE
    with tempfile.TemporaryDirectory() as folder:
        home, files = os.path.join(folder, "home"), os.path.join(folder, "files")
        os.makedirs(home)
        os.makedirs(files)
        base = {k: v for k, v in os.environ.items() if k not in ("XDG_DATA_HOME", "XDG_CONFIG_HOME", "OBVID_LIBRARY")}
        base.update(HOME=home, OBVID_TEST_SOURCES=SOURCES, OBVID_TEST_FOLDER=files, OBVID_TEST_ONLY=ONLY,
                    QTWEBENGINE_DISABLE_SANDBOX="1")  # fmt: skip
        installed = subprocess.run([os.path.join(SOURCES, "tools/install_freecad"), LIBRARY], env=base,
                                   capture_output=True, text=True, check=True)  # fmt: skip
        addon = installed.stdout.strip().split("\n")[0]
        assert os.path.isfile(os.path.join(addon, "obvid/libobvid_c.so")), installed
        if WHAT == "window":
            screen = ["xvfb-run", "-a", "-s", "-screen 0 1280x800x24", window]
            return 1 if tried(screen, base, os.path.join(HERE, "window.py")) else 0
        bad = tried([program], base, os.path.join(HERE, "headless.py"))
        if not ONLY:
            shutil.rmtree(addon)
            bad += tried([program], base, os.path.join(HERE, "without_addon.py"))
        return 1 if bad else 0


sys.exit(main())
