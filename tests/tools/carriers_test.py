#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Whoever knows single carriers: their table and folder, and the few places listed here. Lists in other
languages and documents are compared with the table.

usage: carriers_test.py PROJECT_FOLDER
"""
import pathlib
import re
import sys
import unittest

ROOT = pathlib.Path(sys.argv[1]).resolve()
TABLE = ROOT / "include/obvid/curve/carriers.inc"
# kSpiral is what all others follow: a default, and `follows_spirals`.
ALLOWED = {
    "include/obvid/curve/carrier.h": {"kSpiral"},
    "include/obvid/curve/contour.h": {"kSpiral"},
    "include/obvid/pipeline/compare.h": {"kSpiral"},
    "include/obvid/pipeline/fit.h": {"kSpiral"},
    "src/pipeline/fit/fit.cpp": {"kSpiral"},
    # the curve of a drawing; what a skin takes where a fair section is refused
    "src/pipeline/verify/audit.cpp": {"kImported"},
    "src/pipeline/surface/skin_sections.cpp": {"kBaseline"},
    # the constructions of the papers are curves of these carriers
    "src/pipeline/region/region_constructions.cpp": {"kArcs", "kConics", "kClothoids", "kBeziers", "kBaseline"},
}


def entries():
    """Pairs (enumerator, name, whether a fit forms it) of the table."""
    text = TABLE.read_text(encoding="utf-8")
    return [(m[2], m[3], not m[1]) for m in
            re.finditer(r"^OBVID_CARRIER(_AS_DRAWN)?\((k\w+), (\w+),", text, re.MULTILINE)]


def uses(root):
    """Files that name single carriers, outside their folders, and which."""
    out = {}
    for top in ("include", "src", "apps"):
        for path in sorted((root / top).rglob("*")):
            name = path.relative_to(root).as_posix()
            if path.suffix not in (".h", ".cpp", ".inc") or name.startswith("src/contour/"):
                continue
            found = set(re.findall(r"Carrier::(k\w+)", path.read_text(encoding="utf-8")))
            if found:
                out[name] = found
    return out


class Carriers(unittest.TestCase):
    def test_are_named_where_they_may_be(self):
        self.assertEqual(uses(ROOT), ALLOWED)

    def test_have_a_builder_in_a_family(self):
        sources = "".join(path.read_text(encoding="utf-8") for path in (ROOT / "src/contour").rglob("carry*.cpp"))
        built = re.findall(r"carry_(\w+)\(const Contour&", sources)
        self.assertEqual(sorted(built), sorted(name for _, name, formed in entries() if formed))

    def listed(self, path, pattern):
        match = re.search(pattern, (ROOT / path).read_text(encoding="utf-8"), re.DOTALL)
        self.assertTrue(match, path)
        return re.findall(r"[a-z]+", re.sub(r"[^a-z\"`]", " ", match[1]))

    def test_of_other_languages_and_documents_are_those_of_the_table(self):
        formed = [name for _, name, is_formed in entries() if is_formed]
        self.assertGreater(len(formed), 7)
        self.assertEqual(self.listed("web/studio/src/document/document.ts", r"CARRIERS =\s*\[(.*?)\] as const"), formed)
        for reads in ("tests/cli/figures_agree.py", "tests/cli/report_page_test.py", "tools/make_papers"):
            self.assertIn("carriers.inc", (ROOT / reads).read_text(encoding="utf-8"))
        self.assertEqual(self.listed("docs/schema/parts.schema.json", r'"carrier": \{"enum": \[(.*?)\]'),
                         [name for _, name, _ in entries()])
        self.assertEqual(self.listed("bindings/python/obvid/jobs.py", r" carrier: \"spiral\"( .*?)\.\n"), ["default", *formed[1:]])
        self.assertEqual([name for name in self.listed("docs/cli.md", r"\| `--carrier NAME` \| curve family: (.*?);") if name != "or"], formed)
        self.assertEqual(self.listed("docs/c.md", r"\| `carrier` \| text: (.*?) \|"), formed)
        rows = re.findall(r"^\| `(\w+)` \|", (ROOT / "docs/carriers.md").read_text(encoding="utf-8"), re.MULTILINE)
        self.assertEqual(rows, [name for _, name, _ in entries()])
        silent = re.search(r"function promisesNothing.*?return (.*?);",
                           (ROOT / "web/studio/src/view/drawing.tsx").read_text(encoding="utf-8"), re.DOTALL)[1]
        text = TABLE.read_text(encoding="utf-8")
        promised = {name: monotone == "true" for name, monotone in
                    re.findall(r", (\w+), \.title = \"[^\"]*\",(?: \.about = \"[^\"]*\",)? \.monotone = (true|false)", text)}
        self.assertEqual(set(promised), {name for _, name, _ in entries()})
        self.assertEqual(set(re.findall(r'"(\w+)"', silent)), {name for name, says in promised.items() if not says})

    def test_of_the_judge_are_those_of_the_table(self):
        names, formed = [name for _, name, _ in entries()], [name for _, name, is_formed in entries() if is_formed]
        self.assertEqual(self.listed("tests/judge/check_form.cpp", r"kNames = \{(.*?)\}"), names)
        self.assertEqual(self.listed("tests/judge/series.cpp", r"kCarriers\[\] = \{(.*?)\}"), formed[1:])
        silent = re.findall(r"^OBVID_CARRIER.*?, (\w+),.*?\.monotone = false", TABLE.read_text(encoding="utf-8"), re.MULTILINE)
        judged = re.search(r"promises_monotone\(\) const \{(.*?)\}",
                           (ROOT / "tests/judge/contour_file.h").read_text(encoding="utf-8"), re.DOTALL)[1]
        self.assertGreater(len(silent), 2)
        self.assertEqual(re.findall(r'"(\w+)"', judged), silent)

    def test_batches_and_pages_have_units_and_carriers_of_the_tables(self):
        table = (ROOT / "src/core/units.cpp").read_text(encoding="utf-8")
        lengths = [name for name, metres in re.findall(r'Row\{"(\w+)", ([0-9.e]+)', table) if float(metres) > 0]
        self.assertGreater(len(lengths), 11)
        self.assertEqual(self.listed("web/studio/src/view/panels.tsx", r"const UNITS = \[(.*?)\]"), [*lengths, "chord"])
        batch = "".join(path.read_text(encoding="utf-8") for path in sorted((ROOT / "src/batch").glob("*.cpp")))
        self.assertIn("kFormedCarriers", batch)
        for _, name, formed in entries():
            if formed and name not in ("spiral", "arcs"):  # alignments have arcs, too
                self.assertNotIn(f'"{name}"', batch)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
