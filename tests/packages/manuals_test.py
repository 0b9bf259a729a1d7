# SPDX-License-Identifier: Apache-2.0
"""Man pages and completions name every option of every command, as `obvid COMMAND --help` shows them to
people, and the programs that read them are content. usage: manuals_test.py OBVID MAKE_MANUALS"""
import gzip
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

OBVID, MAKE = sys.argv[1], sys.argv[2]


def output(*words, **more):
    return subprocess.run(words, check=True, capture_output=True, text=True, **more).stdout


def shown_options(path):
    """What --help shows: names at the beginnings of lines."""
    text = output(OBVID, *path, "--help")
    return set(re.findall(r"^  (?:-\w,)?(--[a-z][-a-z0-9]*)", text, re.M))


def shown_commands(path):
    text = output(OBVID, *path, "--help")
    if path == ("surface",):  # a page of its own
        return sorted(set(re.findall(r"^  obvid surface (\w+)", text, re.M)))
    inside = re.search(r"^Subcommands:\n((?:  .*\n)+)", text, re.M)
    return re.findall(r"^  (\w+)", inside.group(1), re.M) if inside else []


def all_paths(path=()):
    out = [path] if path != ("surface",) else []
    for name in shown_commands(path) + (["query"] if path == ("batch",) else []):
        out += all_paths((*path, name))
    return out


class Manuals(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.place = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.place.name)
        said = subprocess.run([sys.executable, "-B", MAKE, OBVID, str(cls.folder)], check=True,
                              capture_output=True, text=True)
        cls.left_out = said.stderr
        cls.paths = [p for p in all_paths() if f"no page for {p[0] if p else ''}:" not in cls.left_out]
        cls.bash, cls.zsh, cls.fish = (cls.folder / "completions" / n for n in ("obvid", "_obvid", "obvid.fish"))

    @classmethod
    def tearDownClass(cls):
        cls.place.cleanup()

    def page(self, path):
        return self.folder / "man1" / ("-".join(("obvid", *path)) + ".1.gz")

    def test_commands_are_found(self):
        for path in (("fit",), ("surface", "skin"), ("batch",), ("batch", "query"), ("studio",), ("toolpath",)):
            if path[0] not in self.left_out:
                self.assertIn(path, self.paths)
        self.assertGreater(len(shown_options(("fit",))), 40)

    def test_every_option_has_its_paragraph(self):
        for path in self.paths:
            page = gzip.decompress(self.page(path).read_bytes()).decode().replace("\\-", "-")
            for option in shown_options(path):
                self.assertRegex(page, rf"\.TP\n.*\\fB{option}\\fR", f"{path}")

    def test_bash_completes_every_option(self):
        output("bash", "-n", str(self.bash))
        for path in self.paths:
            self.assertEqual(shown_options(path) - set(self.bash_says(*path, "--")), set(), path)

    def bash_says(self, *words):
        words = ("obvid", *words)
        script = (f"source {self.bash}; COMP_WORDS=({' '.join(words)}); COMP_CWORD={len(words) - 1}; _obvid; "
                  "printf '%s\\n' \"${COMPREPLY[@]}\"")
        return output("bash", "-c", script).split()

    def test_bash_completes_commands_and_beginnings(self):
        self.assertEqual(self.bash_says("su"), ["surface"])
        self.assertEqual(self.bash_says("surface", "go"), ["gordon"])
        self.assertEqual(self.bash_says("fit", "--noi"), ["--noise"])
        self.assertEqual(self.bash_says("fit", "--noise", "--noi"), [])  # it waits for a value
        self.assertEqual(self.bash_says("fit", "surface", "''"), [])  # a file of that name

    def test_zsh_and_fish_name_every_option(self):
        zsh, fish = self.zsh.read_text(), self.fish.read_text()
        for path in self.paths:
            block = zsh.split(f"    '{' '.join(('obvid', *path))}')\n")[1].split(";;")[0]
            at = f"complete -c obvid -n '__obvid_at \\'{' '.join(path)}\\'' "
            lines = "\n".join(line for line in fish.splitlines() if line.startswith(at))
            for option in shown_options(path):
                self.assertRegex(block, rf"'\*?{option}\[", f"zsh {path}")
                self.assertRegex(lines, rf" -l {option[2:]} ", f"fish {path}")

    def test_zsh_reads_it(self):
        if not shutil.which("zsh"):
            print("zsh is not installed: its completion is not read by it")
            return
        output("zsh", "-n", str(self.zsh))

    def test_fish_completes(self):
        if not shutil.which("fish"):
            print("fish is not installed: its completion is not tried in it")
            return
        output("fish", "-n", str(self.fish))
        for path in self.paths:
            said = output("fish", "-c", f"source {self.fish}; complete -C'{' '.join(('obvid', *path))} --'",
                          env={**os.environ, "HOME": str(self.folder)})
            names = {line.split("\t")[0] for line in said.splitlines()}
            self.assertEqual(shown_options(path) - names, set(), path)

    def test_man_reads_the_pages_without_a_warning(self):
        reader = shutil.which("man") and shutil.which("groff")
        if not reader:
            print("man or groff is not installed: pages are not formatted")
            return
        for page in sorted((self.folder / "man1").iterdir()):
            made = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", str(page)], capture_output=True, text=True,
                                  env={**os.environ, "MANWIDTH": "80", "LC_ALL": "C.UTF-8", "MANROFFSEQ": ""})
            self.assertEqual((made.returncode, made.stderr), (0, ""), page.name)
            self.assertIn("SYNOPSIS", made.stdout)
            if shutil.which("lexgrog"):
                self.assertIn(" - ", output("lexgrog", str(page)))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
