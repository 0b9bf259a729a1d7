#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the program on cases that stand as data in a TOML file (Python's standard library only).

usage: run_cases.py PROGRAM EXAMPLES CASES.toml [PUBLIC [--slow] [--first]]

PUBLIC  folder of public data sets that are not among the sources; where it is not there, cases
        that need one of them are skipped, and that is said
--slow  the program is built to find faults, not to be fast: `cpu_seconds` is not looked at, and
        cases that are `long` are left out
--first the program is the launcher's first one: cases that it leaves to the whole one are counted,
        and that is all

Every case runs in a folder of its own that holds copies of the examples. Keys of a [[case]]:
  name          sentence that says what holds
  args          arguments
  before        lists of arguments of runs that must end with 0 first
  edit          [file, old, new]: doctors a file after `before`; old must occur
  stdin         text for standard input
  files         table of files to write first
  data          files of tests/data to copy first, "folder/name"
  public        files of PUBLIC to copy first, likewise
  exit          exit code (default 0)
  stdout        whole standard output
  stdout_has    texts that standard output holds
  stdout_last   its last line
  stderr        whole standard error, or
  stderr_has    texts that standard error holds (in any order)
  stderr_count  table of texts to how often standard error holds them
  stdout_lacks  texts that standard output does not hold; stderr_lacks likewise
  cpu_seconds   most processor time of the run
  long          true: takes a second and more, and reads nothing that others do not
  json          table of paths "a.b.0" to values in standard output read as JSON; "" asks nothing
  json_between  table of paths to [least, greatest] of numbers there
  program_box   [file, xmin, ymin, xmax, ymax]: no block of this G-code moves beyond
  svg           files that must be well-formed SVG
  contour       files that must be contour files
  contour_values  table of paths to numbers in the first of them (within 1e-12)
  untouched     files that must exist before and after, with the same bytes
  absent        files that must not exist afterwards
  terminal      true: standard output and error are a terminal (then stdout holds both); such a
                case is skipped, and that is said, where the system has no pseudo-terminals
  env           table of environment variables
Besides, always: the error line has the form of the contract when the exit code is not 0, there is
no error line when it is 0, and no file is left that the case does not name.
"""
import json
import os
import pathlib
import re
import resource
import shutil
import subprocess
import sys
import tempfile
import tomllib
import xml.etree.ElementTree

ERROR_LINE = re.compile(r"^obvid: error E([1-5]\d\d): \S.*$")
KEYS = set("name args before edit stdin files data exit stdout stdout_has stdout_last stderr stderr_has "
           "stderr_count json svg contour contour_values untouched absent terminal env holds cad public "
           "stdout_lacks stderr_lacks cpu_seconds json_between program_box long".split())
SLOW = "--slow" in sys.argv
FIRST = "--first" in sys.argv
LEFT_TO_THE_WHOLE = "this program holds `fit` and `analyse` alone"
TIMEOUT_S = 300 if SLOW else 60
DATA = pathlib.Path(__file__).resolve().parent.parent / "data"


def run(program, args, folder, stdin="", env=None, terminal=False):
    full_env = {k: v for k, v in os.environ.items() if k != "NO_COLOR"} | {"TERM": "xterm"}
    full_env |= env or {}
    if not terminal:
        done = subprocess.run([program, *args], cwd=folder, input=stdin.encode(),
                              capture_output=True, env=full_env, timeout=TIMEOUT_S)
        return checked_whether_it_holds(done.returncode, done.stdout.decode(), done.stderr.decode())
    master, slave = os.openpty()
    child = subprocess.Popen([program, *args], cwd=folder, stdin=subprocess.DEVNULL,
                             stdout=slave, stderr=slave, env=full_env)
    os.close(slave)
    text = b""
    while True:
        try:
            block = os.read(master, 65536)
        except OSError:  # the terminal is closed: the program has ended
            break
        if not block:
            break
        text += block
    os.close(master)
    text = text.decode().replace("\r\n", "\n")
    return checked_whether_it_holds(child.wait(TIMEOUT_S), text, "")


def checked_whether_it_holds(code, out, err):
    if FIRST and LEFT_TO_THE_WHOLE in out + err:
        raise LeftToTheWhole
    return code, out, err


def processor_time():
    """Of the runs that have ended, seconds."""
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def has_terminals():
    """False in containers without a mounted devpts, and on systems that know no such thing."""
    try:
        for end in os.openpty():
            os.close(end)
    except (OSError, AttributeError):
        return False
    return True


def at_path(value, path):
    for key in filter(None, path.split(".")):
        value = value[int(key)] if isinstance(value, list) else value[key]
    return value


class LeftToTheWhole(Exception):
    """The first program does not hold what the case is about."""


class Case:
    def __init__(self, data, program, examples, public):
        self.data, self.program = data, program
        self.examples, self.public = examples, public
        self.faults = []

    def check(self, holds, text):
        if not holds:
            self.faults.append(text)

    def prepare(self, folder):
        for example in self.examples.glob("**/*.csv"):
            shutil.copy(example, folder)
        for name in self.data.get("data", []):
            shutil.copy(DATA / name, folder)
        for name in self.data.get("public", []):
            shutil.copy(self.public / name, folder)
            (folder / pathlib.Path(name).name).chmod(0o644)
        for name, text in self.data.get("files", {}).items():
            (folder / name).write_text(text)
        for args in self.data.get("before", []):
            code, _, err = run(self.program, args, folder)
            self.check(code == 0, f"the run before, {args}, ended with {code}: {err}")
        if "edit" in self.data:
            name, old, new = self.data["edit"]
            text = (folder / name).read_text()
            self.check(old in text, f"{name} does not hold {old!r}")
            (folder / name).write_text(text.replace(old, new, 1))

    def check_streams(self, code, out, err):
        data = self.data
        self.check(code == data.get("exit", 0), f"exit code {code}, not {data.get('exit', 0)}")
        for stream, text in (("stdout", out), ("stderr", err)):
            if stream in data:
                self.check(text == data[stream], f"{stream} is not {data[stream]!r}")
            for part in data.get(stream + "_has", []):
                self.check(part in text, f"{stream} does not hold {part!r}")
            for part in data.get(stream + "_lacks", []):
                self.check(part not in text, f"{stream} holds {part!r}")
        for part, times in data.get("stderr_count", {}).items():
            self.check(err.count(part) == times, f"stderr holds {part!r} {err.count(part)} times")
        if "stdout_last" in data:
            last = out.rstrip("\n").split("\n")[-1]
            self.check(last == data["stdout_last"], f"last line is {last!r}")
        plain = re.sub("\x1b\\[[0-9;]*m", "", err or out)
        lines = [line for line in plain.splitlines() if line.startswith("obvid: error")]
        if data.get("exit", 0) == 0:
            self.check(not lines, f"exit code 0 with an error line: {lines}")
        else:
            self.check(len(lines) == 1, f"{len(lines)} error lines")
            match = lines and ERROR_LINE.match(lines[0])
            self.check(match, "the error line has not the form of the contract")
            self.check(match and int(match[1]) // 100 == code, "code and exit code disagree")

    def found_at(self, value, path):
        try:
            return at_path(value, path)
        except (KeyError, IndexError, TypeError, ValueError):
            self.check(False, f"there is no {path}")
            return None

    def check_json(self, out):
        if "json" not in self.data and "json_between" not in self.data:
            return
        try:
            value = json.loads(out)
        except ValueError as error:
            self.check(False, f"stdout is no JSON: {error}")
            return
        for path, expected in self.data.get("json", {}).items():
            if path:
                found = self.found_at(value, path)
                self.check(found == expected, f"{path} is {found!r}, not {expected!r}")
        for path, (least, greatest) in self.data.get("json_between", {}).items():
            found = self.found_at(value, path)
            self.check(found is not None and least <= found <= greatest,
                       f"{path} is {found!r}, not {least!r} to {greatest!r}")

    def check_program(self, folder):
        if "program_box" not in self.data:
            return
        name, *box = self.data["program_box"]
        blocks = [dict((letter, float(value)) for letter, value in
                       re.findall(r"([XY])(-?[\d.]+)", line))
                  for line in (folder / name).read_text().splitlines()
                  if re.match(r"(N\d+ )?G0?[0123]\b", line)]
        self.check(any("X" in block for block in blocks), f"{name} moves nowhere")
        for k, letter in enumerate("XY"):
            for value in (block[letter] for block in blocks if letter in block):
                self.check(box[k] <= value <= box[k + 2], f"{name} moves to {letter}{value}")

    def check_files(self, folder, before):
        data = self.data
        missing = [n for n in data.get("svg", []) + data.get("contour", [])
                   if not (folder / n).is_file()]
        for name in missing:
            self.check(False, f"{name} was not written")
        if missing:
            return
        for name in data.get("svg", []):
            root = xml.etree.ElementTree.parse(folder / name).getroot()
            self.check(root.tag == "{http://www.w3.org/2000/svg}svg", f"{name} is no SVG")
        for name in data.get("contour", []):
            contour = json.loads((folder / name).read_text())
            self.check(contour["format"] == "obvid-contour", f"{name} is no contour")
        for path, expected in data.get("contour_values", {}).items():
            found = at_path(json.loads((folder / data["contour"][0]).read_text()), path)
            self.check(abs(found - expected) < 1e-12, f"{path} is {found!r}, not {expected!r}")
        for name in data.get("untouched", []):
            self.check(name in before, f"{name} did not exist before")
            kept = (folder / name).is_file() and (folder / name).read_bytes() == before.get(name)
            self.check(kept, f"{name} was changed")
        for name, part in data.get("holds", {}).items():
            written = (folder / name).read_text(errors="replace") if (folder / name).exists() else ""
            self.check(part in written, f"{name} does not hold {part!r}")
        for name in data.get("absent", []):
            self.check(not (folder / name).exists(), f"{name} exists")
        named = set(data.get("svg", [])) | set(data.get("contour", [])) | set(before)
        named |= set(data.get("holds", {}))
        left = {p.name for p in folder.iterdir()} - named
        self.check(not left, f"files left behind: {sorted(left)}")

    def run(self):
        with tempfile.TemporaryDirectory() as name:
            folder = pathlib.Path(name)
            self.prepare(folder)
            before = {p.name: p.read_bytes() for p in folder.iterdir() if p.is_file()}
            used = processor_time()
            code, out, err = run(self.program, self.data["args"], folder,
                                 self.data.get("stdin", ""), self.data.get("env"),
                                 self.data.get("terminal", False))
            used = processor_time() - used
            most = None if SLOW else self.data.get("cpu_seconds")
            self.check(most is None or used <= most, f"{used:.1f} s of processor time")
            self.check_streams(code, out, err)
            self.check_json(out)
            self.check_program(folder)
            self.check_files(folder, before)
            if self.faults:
                print(f"--- stdout\n{out[-2000:]}\n--- stderr\n{err[-2000:]}\n---")
        return self.faults


def busy_seconds():
    used = resource.getrusage(resource.RUSAGE_CHILDREN)
    return used.ru_utime + used.ru_stime


def main():
    program, examples, case_file = sys.argv[1:4]
    public = pathlib.Path(sys.argv[4] if len(sys.argv) > 4 else "")
    with open(case_file, "rb") as file:
        cases = tomllib.load(file)["case"]
    assert cases, "a file of cases must hold a case"
    failed = skipped = left = 0
    terminals = has_terminals()
    for data in cases:
        unknown = set(data) - KEYS
        assert not unknown, f"unknown keys {unknown} in {data['name']!r}"
        if data.get("long") and SLOW:
            left += 1
            continue
        if data.get("terminal") and not terminals:
            print("skipped: " + data["name"] + " (no pseudo-terminals here)")
            skipped += 1
            continue
        if data.get("cad") and not (pathlib.Path(program).parent / "obvid-cad").exists():
            print("skipped: " + data["name"] + " (the helper for CAD files is not built)")
            skipped += 1
            continue
        missing = [name for name in data.get("public", []) if not (public / name).is_file()]
        if missing:
            print("skipped: " + data["name"] + f" ({', '.join(missing)} is not among the public data)")
            skipped += 1
            continue
        before = busy_seconds()
        try:
            faults = Case(data, str(pathlib.Path(program).resolve()), pathlib.Path(examples),
                          public).run()
        except LeftToTheWhole:
            left += 1
            continue
        print(("FAILED: " if faults else "passed: ") + f"{data['name']} ({busy_seconds() - before:.1f} s of processor time)")
        for fault in faults:
            print("    " + fault)
        failed += bool(faults)
    note = f", {skipped} skipped" if skipped else ""
    reason = "left to the whole program" if FIRST else "too long for such a build"
    note += f", {left} {reason}" if left else ""
    print(f"{len(cases) - failed - skipped - left} of {len(cases)} cases passed{note}")
    assert skipped + left < len(cases), "no case was run"
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
