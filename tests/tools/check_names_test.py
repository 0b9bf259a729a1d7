# SPDX-License-Identifier: Apache-2.0
"""check_names must find what would clash in a unity build: each case is a small project tree."""
import os
import subprocess
import sys
import tempfile
import unittest

TOOL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "check_names")


def run_on(files):
    """Exit code and output of the tool for a tree given as {path: text}."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in files.items():
            full = os.path.join(root, path)
            os.makedirs(os.path.dirname(full), exist_ok=True)
            with open(full, "w", encoding="utf-8") as out:
                out.write(text)
        done = subprocess.run([sys.executable, "-B", TOOL, root], capture_output=True, text=True)
        return done.returncode, done.stdout


def anonymous(body):
    return f"#include <vector>\n\nnamespace obvid {{\nnamespace {{\n\n{body}\n\n}}  // namespace\n}}\n"


class CheckNames(unittest.TestCase):
    def pair(self, one, two, paths=("src/io/a.cpp", "src/io/b.cpp")):
        return run_on({paths[0]: anonymous(one), paths[1]: anonymous(two)})

    def refuses(self, name, one, two=None):
        code, out = self.pair(one, two or one)
        self.assertEqual(code, 1, out)
        self.assertIn(f": {name} ", out)

    def accepts(self, one, two):
        code, out = self.pair(one, two)
        self.assertEqual(code, 0, out)

    def test_equal_names_of_every_kind_are_found(self):
        self.refuses("kSamples", "constexpr int kSamples = 8;", "const double kSamples{3};")
        self.refuses("kTwo", "constexpr int kOne = 1, kTwo = 2;", "constexpr int kTwo = 3;")
        self.refuses("kTable", "constexpr double kTable[] = {1.0, 2.0};")
        self.refuses("Box", "struct Box {\n  int x = 0;\n};", "class Box {};")
        self.refuses("Kind", "enum class Kind { kOne };", "using Kind = int;")
        self.refuses("size_of", "double size_of(int a) { return a; }")
        self.refuses("map", "template <class T>\nstd::vector<T> map(const T& a) { return {a}; }")

    def test_overloads_in_two_files_are_found_those_in_one_pass(self):
        self.refuses("add", "void add(int a) { (void)a; }", "void add(double a) { (void)a; }")
        self.accepts("void add(int) {}\nvoid add(double) {}", "void sub(int) {}")

    def test_what_follows_a_function_with_a_default_argument_is_seen(self):
        self.refuses("after", "int first(int a = 1) {\n  return a;\n}\n\nint after() { return 1; }",
                     "int after() { return 2; }")

    def test_what_follows_a_lambda_a_raw_string_or_a_directive_is_seen(self):
        for before in ("const auto f = [](int a) { return a; };",
                       'const char* t = R"x(} namespace { ")x";',
                       "#define TWICE(a) \\\n  { a; a; }\n", "constexpr char c = '{';"):
            code, out = self.pair(before + "\nint after = 1;", "int after = 2;")
            self.assertEqual(code, 1, before + out)
            self.assertIn(": after ", out)

    def test_locals_members_and_comments_are_no_names(self):
        self.accepts("int one() {\n  int total = 1;\n  return total;\n}",
                     "struct Two {\n  int total = 0;\n  int one() { return total; }\n};")
        self.accepts("// int three;\nint two = 1;", "int three = 1;")

    def test_a_constant_in_a_function_that_hides_one_of_another_file_is_found(self):
        self.refuses("kMost", "constexpr int kMost = 1;",
                     "int two() {\n  constexpr int kMost = 3;\n  return kMost;\n}")

    def test_other_targets_and_programs_of_one_file_may_have_the_same_names(self):
        for paths in (("src/io/a.cpp", "src/mesh/b.cpp"), ("tests/io/a.cpp", "tests/mesh/b.cpp"),
                      ("src/contour/arcs/a.cpp", "src/contour/conics/b.cpp")):
            code, out = self.pair("int one = 1;", "int one = 2;", paths)
            self.assertEqual(code, 0, out)
        code, out = run_on({path: anonymous("int one = 1;")
                            for path in ("src/io/a.cpp", "tests/fuzz/a.cpp", "tests/fuzz/b.cpp")})
        self.assertEqual(code, 0, out)

    def test_files_below_a_folder_of_the_target_belong_to_it(self):
        code, out = self.pair("int one = 1;", "int one = 2;",
                              ("src/exchange/a.cpp", "src/exchange/page/b.cpp"))
        self.assertEqual(code, 1, out)

    def test_a_tree_without_sources_is_not_all_right(self):
        code, out = run_on({"README.md": ""})
        self.assertEqual(code, 2, out)


if __name__ == "__main__":
    unittest.main()
