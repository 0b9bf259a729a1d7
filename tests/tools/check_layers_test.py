# SPDX-License-Identifier: Apache-2.0
"""check_layers must find what it is there for: each case is a small project tree."""
import os
import subprocess
import sys
import tempfile
import unittest

TOOL = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "tools", "check_layers")


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


def include(header):
    return f'#pragma once\n#include <vector>\n#include "obvid/{header}"\n'


class CheckLayers(unittest.TestCase):
    def accepts(self, path, header):
        code, out = run_on({path: include(header)})
        self.assertEqual(code, 0, out)

    def refuses(self, path, header, words):
        code, out = run_on({path: include(header)})
        self.assertEqual(code, 1, out)
        self.assertIn(f"{path}:3: ", out)
        self.assertIn(words, out)

    def test_includes_of_lower_levels_and_of_the_own_module_pass(self):
        self.accepts("include/obvid/curve/pieces.h", "geom/vec2.h")
        self.accepts("src/chain/solve.cpp", "region/width.h")
        self.accepts("src/contour/arcs/biarc.cpp", "contour/arcs/biarc.h")
        self.accepts("src/pipeline/fit.cpp", "contour/spirals/spiral.h")
        self.accepts("src/pipeline/fit.cpp", "contour/spirals.h")
        self.accepts("include/obvid/contour/arcs.h", "curve/contour.h")
        self.accepts("apps/cli/main.cpp", "pipeline/fit.h")

    def test_an_include_of_a_higher_level_fails(self):
        self.refuses("src/geom/line.cpp", "curve/pieces.h", "geom (level 1) includes curve")
        self.refuses("include/obvid/core/error.h", "io/json.h", "core (level 0) includes io")
        self.refuses("src/io/json.cpp", "pipeline/fit.h", "io (level 5) includes pipeline")

    def test_programs_reach_for_nothing_below_the_pipeline(self):
        self.refuses("apps/cli/main.cpp", "io/read_points.h", "not io")
        self.refuses("apps/cli/main.cpp", "geom/vec2.h", "not geom")
        self.accepts("apps/cli/main.cpp", "core/units.h")
        self.accepts("apps/studio/main.cpp", "obvid.h")
        self.accepts("apps/first/later.cpp", "io/contour_json.h")

    def test_programs_include_no_private_header_by_its_bare_name(self):
        header = {"src/cad/client/helper_file.h": "#pragma once\n", "src/batch/work.h": "#pragma once\n",
                  "apps/batch/work_of_its_own.h": "#pragma once\n"}
        for name, text, fault in (
                ("apps/cli/main.cpp", '#include "helper_file.h"', "helper_file.h is a private header of cad"),
                ("apps/cli/main.cpp", '#include "client/helper_file.h"', "is a private header of cad"),
                ("apps/batch/main.cpp", '#include "helper_file.h"', "is a private header of cad"),
                ("apps/web/no_processes.cpp", '#include "helper_file.h"', None),
                ("apps/batch/main.cpp", '#include "work.h"', None),
                ("apps/batch/main.cpp", '#include "work_of_its_own.h"', None)):
            code, out = run_on({**header, name: text + "\n"})
            self.assertEqual(code, 1 if fault else 0, out)
            self.assertIn(fault or "0 faults", out)

    def test_the_order_inside_level_three_is_kept(self):
        self.refuses("src/series/runs.cpp", "region/width.h", "series (level 3.1)")
        self.refuses("src/region/width.cpp", "chain/solve.h", "region (level 3.2)")

    def test_siblings_do_not_include_each_other(self):
        self.refuses("src/geom/line.cpp", "numeric/roots.h", "geom (level 1) includes numeric")
        self.refuses("src/contour/arcs/arc.cpp", "contour/spirals/spiral.h", "contour/arcs")
        self.refuses("include/obvid/contour/arcs.h", "contour/spirals.h", "contour/arcs")
        self.refuses("src/contour/arcs/arc.cpp", "contour/shared.h", "no known module")

    def test_builders_and_proofs_share_nothing(self):
        self.refuses("src/contour/spirals/s.cpp", "certify/certificate.h", "share nothing")
        self.refuses("src/certify/proof.cpp", "chain/solve.h", "share nothing")

    def test_a_way_around_through_parent_folders_fails(self):
        code, out = run_on({"src/geom/line.cpp": '#include "../curve/private.h"\n'})
        self.assertEqual(code, 1, out)
        self.assertIn("private headers stay private", out)

    def test_examples_do_without_internal_headers(self):
        lower = {"src/geom/line.cpp": include("core/result.h")}
        self.assertEqual(run_on({**lower, "examples/fit.cpp": include("curve/pieces.h")})[0], 0)
        code, out = run_on({**lower, "examples/fit.cpp": include("curve/internal/runs.h")})
        self.assertEqual(code, 1, out)
        self.assertIn("examples/fit.cpp:3: obvid/curve/internal/runs.h is not for users", out)

    def test_unknown_modules_and_empty_trees_fail(self):
        self.refuses("src/geom/line.cpp", "gui/window.h", "no known module")
        self.assertEqual(run_on({"src/gui/window.cpp": "#include <vector>\n"})[0], 1)
        self.assertEqual(run_on({"README.md": "nothing"})[0], 1)


if __name__ == "__main__":
    unittest.main()
