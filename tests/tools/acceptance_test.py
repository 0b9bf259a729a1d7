# SPDX-License-Identifier: Apache-2.0
"""The acceptance sweeps must find what they are there for: figures against closed forms, sound
contours accepted, doctored ones refused, and the whole tool with a program that answers as told."""
import json
import math
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree

import numpy as np

TOOLS = pathlib.Path(__file__).resolve().parent.parent.parent / "tools"
sys.dont_write_bytecode = True
sys.path.insert(0, str(TOOLS))

from acceptance_sets import (cases, controller, cutting, fair_across, geometry, judging, matching, plates, profiles,  # noqa: E402
                             roads, rounding, running, scans, sections, tracks, transitions)
from acceptance_sets.controller import Controller  # noqa: E402

# Fresnel integrals at 1: C and S of a clothoid with curvature pi s.
FRESNEL = complex(0.7798934003768228, 0.4382591473903548)
QUARTER = {"type": "bezier", "points": [[1, 0], [1, 1], [0, 1]],
           "weights": [1, math.sqrt(0.5), 1]}


def chain(*shapes):
    """Pieces (length, kappa0, kappa1), each starting where the one before ends."""
    pieces, start = [], (0j, 0.3)
    for length, kappa0, kappa1 in shapes:
        pieces.append(matching.TruePiece(len(pieces), *start, length, kappa0, kappa1))
        start = pieces[-1].end()
    return pieces


def contour_of(pieces, points=(), closed=False):
    """The contour file of a chain as a perfect program would write it."""
    rows = []
    for p in pieces:
        a, b = p.start, p.end()[0]
        row = {"type": {"spiral": "clothoid"}.get(p.kind(), p.kind()), "start": [a.real, a.imag],
               "end": [b.real, b.imag], "theta0": p.theta, "length": p.length,
               "kappa": p.kappa0, "kappa0": p.kappa0, "kappa1": p.kappa1}
        rows.append(row)
    return {"points": [list(p) for p in points], "pieces": rows, "closed": closed, "runs": [],
            "elements": [], "certificate": {"proved": True},
            "report": {"vertices": 0, "vertices_lower_bound": 0, "largest_move": 0.0,
                       "moves": [0.0] * len(points), "seconds": 0.001}}


ROAD = ((60.0, 0, 0), (40.0, 0, 0.01), (50.0, 0.01, 0.01), (40.0, 0.01, 0), (60.0, 0, 0))


class Programs(unittest.TestCase):
    def test_the_judge_of_programs_allows_the_turn_that_is_planned(self):
        header = (TOOLS.parent / "include/obvid/exchange/internal/gcode/path.h").read_text(encoding="utf-8")
        self.assertEqual(float(re.search(r"kMostBlockTurn = ([\d.]+);", header)[1]), controller.MOST_BLOCK_TURN)

    def test_a_sliver_that_turns_almost_around_is_refused(self):
        head = "G21\nG90\nG17\nM3 S1\nG0 X0 Y0\n"
        Controller(head + "G3 X-20.0000 Y0.0000 I-10.0000 J0.0000 F100\n", burns=True)
        with self.assertRaises(AssertionError):
            Controller(head + "G3 X0.0000 Y-0.1500 I-10.0000 J0.0000 F100\n", burns=True)


class Geometry(unittest.TestCase):
    def test_an_ellipse_has_four_extrema_and_half_of_it_the_inner_one(self):
        n = 40
        ring = [(3 * math.cos(2 * math.pi * (i + 0.3) / n), math.sin(2 * math.pi * (i + 0.3) / n))
                for i in range(n)]
        self.assertEqual(geometry.raw_extrema(ring, closed=True), 4)
        self.assertEqual(geometry.raw_extrema(ring + ring[:1], closed=True), 4)
        self.assertEqual(geometry.raw_extrema(ring[2:n // 2 - 2]), 1)

    def test_pieces_are_evaluated_as_their_closed_forms(self):
        for t in (0.0, 0.25, 0.5, 1.0):
            z, kappa = geometry.bezier_point(QUARTER, t)
            self.assertAlmostEqual(abs(z), 1.0, 14)
            self.assertAlmostEqual(kappa, 1.0, 13)
        self.assertLess(abs(geometry.move(0j, 0.0, 0.0, math.pi, 1.0) - FRESNEL), 1e-14)
        arc = {"type": "arc", "start": [0, 0], "theta0": 0.0, "kappa": 0.5, "length": 2 * math.pi}
        self.assertLess(abs(geometry.piece_point(arc, 0.5)[0] - (2 + 2j)), 1e-14)

    def test_a_piece_with_exact_offsets_stands_at_its_origin(self):
        piece = {**QUARTER, "points": [[0, 0]] * 3,
                 "exact": {"origin": [1e6, 2e6], "offsets": QUARTER["points"]}}
        z, kappa = geometry.bezier_point(piece, 0.0)
        self.assertEqual(z, complex(1e6 + 1, 2e6))
        self.assertAlmostEqual(kappa, 1.0, 14)

    def test_circles_and_lines_are_fitted_exactly(self):
        arc = [(300 * math.sin(a / 90), -300 * math.cos(a / 90)) for a in range(12)]
        self.assertAlmostEqual(geometry.fit_circle(arc)[0] * 300, 1.0, 9)
        self.assertLess(geometry.fit_circle(arc)[1], 1e-9)
        self.assertAlmostEqual(geometry.fit_circle([(x, 2 * x + 1) for x in range(5)])[0], 0, 14)
        bent = arc[:6] + [(arc[6][0], arc[6][1] + 0.5)] + arc[7:]
        self.assertGreater(geometry.fit_circle(bent)[1], 0.2)


class PrintedDigits(unittest.TestCase):
    def half(self, text, points):
        return rounding.printed_rounding(text, points)

    def test_half_a_unit_of_the_last_digit_counts_titles_and_counts_do_not(self):
        text = "NACA 0012 1.5\n 61. 61.\n 1.0 0.00126\n0.95000  .5\n"
        self.assertAlmostEqual(self.half(text, [(1.0, 0.00126), (0.95, 0.5)]),
                               math.hypot(5e-6, 5e-6), 12)

    def test_the_coarsest_full_mantissa_decides_with_exponents(self):
        text = "1.000E+00 2.50D-01\n9.95E-01 1.00D-03\n"
        self.assertAlmostEqual(self.half(text, [(1.0, 0.25), (0.995, 0.001)]),
                               math.hypot(5e-4, 5e-4), 12)

    def test_whole_numbers_are_known_to_half(self):
        self.assertAlmostEqual(self.half("x,y\n37,561\n40,540\n", [(37, 561), (40, 540)]),
                               math.sqrt(0.5), 12)


class Roads(unittest.TestCase):
    def truth(self, *shapes, tolerance=1e-3):
        return matching.sampled_truth(chain(*shapes), 5.0, tolerance)

    def test_points_lie_every_step_and_at_the_end(self):
        points, places = matching.sampled(chain((12.0, 0, 0), (10.0, 0, 0)), 5.0)
        self.assertEqual(places, [0.0, 5.0, 10.0, 15.0, 22.0])
        for (x, y), s in zip(points, places):
            self.assertAlmostEqual(x, s * math.cos(0.3), 12)
            self.assertAlmostEqual(y, s * math.sin(0.3), 12)

    def test_a_contour_of_the_true_pieces_matches_all_of_them(self):
        truth = self.truth(*ROAD)
        found = matching.matched(truth, contour_of(chain(*ROAD), truth["points"]))
        self.assertEqual(found["matched"], {"line": 2, "spiral": 2, "arc": 1})
        self.assertEqual(found["missed"], [])

    def test_a_radius_three_percent_off_a_wrong_kind_and_a_wrong_spiral_are_missed(self):
        truth = self.truth(*ROAD)
        for number, change, why in ((2, {"kappa": 0.0103}, "radius off"),
                                    (2, {"type": "clothoid", "kappa1": 0.0102}, "found as spiral"),
                                    (0, {"type": "arc", "kappa": 1e-9}, "found as arc"),
                                    (1, {"kappa1": 0.007}, "curvature off")):
            contour = contour_of(chain(*ROAD), truth["points"])
            contour["pieces"][number].update(change)
            missed = matching.matched(truth, contour)["missed"]
            self.assertEqual([m["why"] for m in missed], [why])
        missed = matching.matched(truth, None)["missed"]
        self.assertEqual({m["why"] for m in missed}, {"not fitted"})

    def test_what_the_points_cannot_show_is_not_asked_for(self):
        rows = self.truth((60, 0, 0), (9, 0.02, 0.02), (60, 0, 0))["pieces"]
        seen = [row["seen"] for row in rows]
        self.assertEqual(seen, [True, False, True])  # at most two points on the arc
        # 30 m of radius 200 km rise by 0.6 mm: with 1 mm a line, with 0.1 mm an arc.
        flat = ((30.0, 5e-6, 5e-6),)
        self.assertFalse(self.truth(*flat)["pieces"][0]["seen"])
        self.assertTrue(self.truth(*flat, tolerance=1e-4)["pieces"][0]["seen"])

    def test_pieces_cut_for_other_reasons_are_one(self):
        rows = self.truth((30, 0, 0), (30, 0, 0), (20, 0, 0.01), (20, 0.01, 0.02), (9, 0.02, 0.02),
                          (30, 0.02, 0.02))["pieces"]
        self.assertEqual([(r["kind"], r["length"]) for r in rows],
                         [("line", 60), ("spiral", 40), ("arc", 39)])

    def test_a_gap_of_the_file_is_found(self):
        pieces = chain(*ROAD)
        self.assertLess(roads.largest_gap(pieces), 1e-12)
        pieces[2].start += 0.02j
        self.assertAlmostEqual(roads.largest_gap(pieces), 0.02, 2)

    def test_public_roads_start_each_piece_where_the_one_before_ends(self):
        data = os.environ.get("OBVID_SHARED_DATA", "")
        folder = pathlib.Path(data) / "roads_opendrive"
        if not data or not folder.exists():
            self.skipTest("the public data sets are missing (OBVID_SHARED_DATA)")
        gaps = [roads.largest_gap(pieces) for file in sorted(folder.glob("*.xodr"))
                for road in xml.etree.ElementTree.parse(file).getroot().iter("road")
                if (pieces := roads.plan_view(road))]
        self.assertGreater(len(gaps), 300)
        self.assertLess(max(gaps), 2e-3)  # the largest that the files are known to have: 1.5e-3


class Truths(unittest.TestCase):
    def test_the_transition_formula_ends_where_fresnel_says(self):
        # Curvature 0 to 1/300 over 100 m, scaled from the integrals at sqrt(2 A), series of theta =
        # 1/6.
        end = transitions.formula(("Clothoid", 100.0, 0.0, 1 / 300))[-1]
        theta = 100.0 / 300 / 2
        x = 100 * (1 - theta**2 / 10 + theta**4 / 216 - theta**6 / 9360)
        y = 100 * (theta / 3 - theta**3 / 42 + theta**5 / 1320)
        self.assertLess(abs(end - complex(x, y)), 1e-6)

    def test_a_contour_off_the_formula_by_a_millimetre_is_seen(self):
        truth = ("Clothoid", 100.0, 0.0, 1 / 300)
        sound = contour_of([matching.TruePiece(0, 0j, 0.0, 100.0, 0.0, 1 / 300)])
        moved = contour_of([matching.TruePiece(0, 1e-3j, 0.0, 100.0, 0.0, 1 / 300)])
        self.assertLess(transitions.against_formula(truth, sound)["deviation"], 1e-5)
        self.assertAlmostEqual(transitions.against_formula(truth, moved)["deviation"], 1e-3, 5)

    def test_radii_are_read_from_the_arc_that_fills_the_interval(self):
        arcs = [matching.TruePiece(0, 0j, 0.0, 2.0, -1 / 13, -1 / 13),
                matching.TruePiece(1, 2 - 0.1j, -0.1, 20.0, -1 / 300, -1 / 300)]
        rows = profiles.found_radii([(-300, 3, 20), (-80, 40, 50)], contour_of(arcs))["radii"]
        self.assertAlmostEqual(rows[0]["found"], -300, 9)
        self.assertIsNone(rows[1]["found"])
        self.assertEqual([profiles.close(row) for row in rows], [True, False])
        self.assertFalse(profiles.close({"published": 300, "found": 304}))

    def test_a_degree_of_latitude_at_45_degrees_has_its_tabulated_length(self):
        points = tracks.to_metres([(10.0, 44.5), (10.0, 45.5), (11.0, 45.0)])
        self.assertAlmostEqual(points[1][1] - points[0][1], 111131.8, 0)  # NIMA TR8350.2: 111.13 km
        self.assertAlmostEqual(points[2][0] - points[1][0], 78846.8, 0)

    def test_dummies_of_an_offset_table_are_left_out(self):
        row = [(0, 0.0), (1, 0.3), (2, 1.0), (3, 0.4), (4, 0.0)]
        self.assertEqual(sections.without_dummies(row), row[:4])
        self.assertEqual(sections.without_dummies([(0, 0.0), *((i + 1, v) for i, v in row[:3])]),
                         [(2, 0.3), (3, 1.0)])
        self.assertEqual(sections.without_dummies([(0, 0.0), (1, 0.0)]), [])


class Moves(unittest.TestCase):
    def contour(self, moves, tolerances):
        contour = contour_of([], [(0, 0), (1, 0), (2, 1)])
        contour["report"]["moves"], contour["point_tolerance"] = moves, tolerances
        return contour

    def test_each_point_has_its_own_tolerance(self):
        found = running.moves_of(self.contour([0.1, 0.02, 0.0], [0.2, 0.02, 0.0]), 0.2)
        self.assertEqual(found, {"move": 1.0, "moves_within": True})
        self.assertFalse(running.moves_of(self.contour([0.0, 0.03, 0], [0.2, 0.02, 0]),
                                          0.2)["moves_within"])

    def test_tolerances_above_the_asked_one_and_missing_moves_are_refused(self):
        self.assertFalse(running.moves_of(self.contour([0, 0, 0], [0.3, 0, 0]),
                                          0.2)["moves_within"])
        self.assertFalse(running.moves_of(self.contour([0, 0], [0.1] * 3), 0.2)["moves_within"])


PICKY = """import sys
noise = float(sys.argv[sys.argv.index("--noise") + 1])
sys.exit(0 if noise >= 0.5 and "--closed" in sys.argv else 4)
"""


class Refusals(unittest.TestCase):
    def test_a_refusal_holds_when_the_tolerance_that_it_names_is_enough(self):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "obvid"
            program.write_text(f"#!{sys.executable}\n" + PICKY)
            program.chmod(0o755)
            case = cases.Case("a", program, ["--noise", "0.1", "--closed"], 0.1)
            for text, holds in (("possible with a tolerance of 0.49", True),
                                ("points 3 to 5, about 3.0e-01 mm; move them", False),
                                ("a stretch leaves no room; remove a point", None)):
                self.assertIs(running.explanation_holds(case, str(program), text), holds)


class FallsOfCurvature(unittest.TestCase):
    """What fair_across calls a fall against the run: of made-up curvatures, whose falls are known."""

    def test_the_deepest_fall_of_a_rising_run(self):
        wanted = np.linspace(0.0, 1.0, 201)
        found = wanted.copy()
        found[100] += 0.015  # the next place is 0.005 higher: 0.010 are lost
        self.assertEqual(fair_across.fall(wanted, wanted), 0.0)
        self.assertAlmostEqual(fair_across.fall(wanted, found), 0.010, delta=1e-12)

    def test_a_turn_elsewhere_is_a_fall_by_what_lies_between(self):
        wanted = np.r_[np.linspace(0.0, 1.0, 101), np.linspace(0.99, 0.0, 100)]
        found = np.r_[np.linspace(0.0, 1.05, 106), np.linspace(1.04, 0.10, 95)]  # turns 5 places later
        self.assertAlmostEqual(fair_across.fall(wanted, found), 0.05, delta=1e-12)

    def test_the_noise_of_an_arc_is_no_turn_but_a_wave_on_it_is_a_fall(self):
        arc = 0.5 + 2e-5 * np.sin(np.arange(100.0))
        wanted = np.r_[np.linspace(0.0, 0.49, 50), arc, np.linspace(0.51, 1.0, 50)]
        rising = np.linspace(0.0, 1.0, 200)
        self.assertEqual(fair_across.fall(wanted, rising), 0.0)
        waved = rising.copy()
        waved[100] -= 0.2
        self.assertAlmostEqual(fair_across.fall(wanted, waved), 0.2 - 1.0 / 199, delta=1e-12)

    def test_a_run_may_end_anywhere_on_a_flat_top(self):
        wanted = np.r_[np.linspace(0.0, 1.0, 50), np.ones(100), np.linspace(1.0, 0.0, 50)]
        for top in (60, 100, 140):
            self.assertEqual(fair_across.fall(wanted, -np.abs(np.arange(200.0) - top)), 0.0)
        self.assertAlmostEqual(fair_across.fall(wanted, -np.abs(np.arange(200.0) - 40.0)), 9.0)


class PlanesOfSections(unittest.TestCase):
    """Stations that are not plane are looked at along the normal that their given points have."""

    def test_matrices_give_each_row_its_own_normal(self):
        t = np.linspace(0.0, 1.0, 7)
        rows = [(np.full(7, 2.0), t, t * t), (0.5 * t, t, np.cos(t))]  # x = 2; x = y / 2
        with tempfile.TemporaryDirectory() as folder:
            for axis, name in enumerate("xyz"):
                np.savetxt(pathlib.Path(folder) / f"hull_{name}.dat", [row[axis] for row in rows])
            first, second = fair_across.given_normals(pathlib.Path(folder) / "hull_x.dat")
        self.assertAlmostEqual(abs(first[0]), 1.0, delta=1e-12)
        self.assertAlmostEqual(abs(second @ np.array([2.0, -1.0, 0.0])), np.sqrt(5.0), delta=1e-12)

    def test_other_files_have_none(self):
        self.assertIsNone(fair_across.given_normals(pathlib.Path("offsets.csv")))


class Judging(unittest.TestCase):
    def test_a_step_of_the_size_of_rounding_is_settled_and_a_larger_one_is_not(self):
        leg = {"type": "bezier", "points": [[1, 0], [1.0001, 0], [1.1, 0.001], [1.2, 0.01]],
               "weights": [1, 1, 1, 1]}
        allowed = judging.curvature_rounding(leg, at_end=False)
        # curvature 2/3 u x v / u^3, and v turned by an ulp of 1 (2.2e-16) over its length
        self.assertGreater(allowed, 2 / 3 * 2.2e-16 * 0.1 / 1e-4**3 / 10)
        self.assertLess(allowed, 1e-2)
        self.assertLess(judging.curvature_rounding(leg, at_end=True), 1e-11)


FAKE = '''import sys
out = sys.argv[sys.argv.index("-o") + 1]
answer = {answer!r}
if answer is None:
    print("obvid: error E401: no curve (points 1 to 3); move them", file=sys.stderr)
    sys.exit(4)
with open(out, "w") as file:
    file.write(answer)
'''
ROAD_XML = """<OpenDRIVE><road id="7"><planView>{}</planView></road></OpenDRIVE>"""
SHAPES = {"line": "<line/>", "arc": '<arc curvature="{k0}"/>',
          "spiral": '<spiral curvStart="{k0}" curvEnd="{k1}"/>'}


def road_file(pieces):
    return ROAD_XML.format("".join(
        f'<geometry x="{p.start.real!r}" y="{p.start.imag!r}" hdg="{p.theta!r}" '
        f'length="{p.length!r}">{SHAPES[p.kind()].format(k0=p.kappa0, k1=p.kappa1)}</geometry>'
        for p in pieces))


class WholeTool(unittest.TestCase):
    def sweep(self, contour):
        """Exit code, tables and figures for one road and a program that answers with this
        contour."""
        with tempfile.TemporaryDirectory() as folder:
            folder = pathlib.Path(folder)
            (folder / "roads_opendrive").mkdir()
            (folder / "roads_opendrive" / "own.xodr").write_text(road_file(chain(*ROAD)))
            program = folder / "obvid"
            answer = contour and json.dumps(contour)
            program.write_text(f"#!{sys.executable}\n" + FAKE.format(answer=answer))
            program.chmod(0o755)
            done = subprocess.run(
                [sys.executable, "-B", str(TOOLS / "acceptance"), "roads", str(folder), "--program",
                 str(program), "--json", str(folder / "out.json")], capture_output=True, text=True)
            return done.returncode, done.stdout, json.loads((folder / "out.json").read_text())

    def contour(self):
        truth = matching.sampled_truth(chain(*ROAD), roads.STEP, roads.TOLERANCE)
        return contour_of(chain(*ROAD), truth["points"])

    def test_a_perfect_program_meets_every_criterion(self):
        code, text, figures = self.sweep(self.contour())
        self.assertEqual(code, 0, text)
        self.assertIn("| own | 5 | 5 | 2 of 2 | 1 of 1 | 2 of 2 | 100.0 % |", text)
        self.assertTrue(figures["roads"]["met"])

    def test_a_wrong_radius_a_move_too_far_and_a_refusal_fail(self):
        wrong = self.contour()
        wrong["pieces"][2]["kappa"] *= 1.03
        far = self.contour()
        far["report"]["moves"][3] = 1.01 * roads.TOLERANCE
        for contour, words in ((wrong, "arc radius off"), (None, "spiral not fitted"),
                               (far, "| moves within the tolerance | 0 of")):
            code, text, figures = self.sweep(contour)
            self.assertEqual(code, 1, text)
            self.assertIn(words, text)
            self.assertFalse(figures["roads"]["met"])

    def test_no_file_at_all_fails(self):
        with tempfile.TemporaryDirectory() as folder:
            done = subprocess.run([sys.executable, "-B", str(TOOLS / "acceptance"), "airfoils", folder],
                                  capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("airfoils: no file", done.stderr)


def around(radius, deep=-1.0, before="G0 Z5"):
    """A program that runs clockwise around the origin, a quarter at a time."""
    at = [(radius, 0), (0, -radius), (-radius, 0), (0, radius), (radius, 0)]
    lines = ["G21 G90 G17", before, f"G0 X{radius} Y0", f"G1 Z{deep} F100"]
    lines += [f"G2 X{x} Y{y} I{-a} J{-b}" for (a, b), (x, y) in zip(at, at[1:])]
    return Controller("\n".join([*lines, "G0 Z5", "M2"]))


class Cutting(unittest.TestCase):
    def left(self, program):
        return plates.simulated([plates.Circle(0, 0, 10)], [True], program, 2.0, exact=[0])

    def test_a_sound_program_leaves_the_circle_and_nothing_else(self):
        found = self.left(around(11))
        self.assertEqual([found[k] for k in ("rapids", "missed", "wrong_way", "early")], [0, 0, 0, 0])
        self.assertLess(max(found["gouge"], found["compensation"]), 1e-12)
        self.assertLess(found["left"], 0.01)
        self.assertEqual(found["depths"], [-1.0])

    def test_faults_are_seen(self):
        self.assertAlmostEqual(self.left(around(10.75))["gouge"], 0.25, 9)
        self.assertAlmostEqual(self.left(around(11.25))["left"], 0.25, 2)
        self.assertAlmostEqual(self.left(around(11.00002))["compensation"], 2e-5, 9)
        self.assertEqual(self.left(around(11, before="G0 Z-0.5"))["rapids"], 1)
        self.assertEqual(self.left(around(11, deep=1.0))["missed"], 1)
        other = plates.simulated([plates.Circle(0, 0, 12)], [False], around(11), 2.0)
        self.assertEqual(other["wrong_way"], 1)
        inner = [plates.Circle(0, 0, 10), plates.Circle(0, 0, 5)]
        first = around(11)
        both = Controller("G21\nG90\nG17\nG0 Z5")
        both.moves = first.moves + around(4).moves
        self.assertEqual(plates.simulated(inner, [True, False], both, 2.0)["early"], 1)

    def test_what_no_controller_takes_is_refused(self):
        for line in ("G2 X1 Y0", "X1 @", "G7 X1", "G1 X1"):
            with self.assertRaises(AssertionError):
                Controller("G0 Z5\nG0 X0 Y0\n" + line)

    def test_programs_of_parts_of_drawings_are_whole_and_say_what_is_missing(self):
        told = {"left_out": 1, "warnings": ["path data have an error"]}
        text = "G21 G90\nG0 X0 Y0\nM3 S1\nG1 X10 Y0 F100\nM5\nM2"
        self.assertEqual(cutting.fault_of_partial("E504", told, text), "")
        self.assertIn("E502", cutting.fault_of_partial("E502", told, text))
        for said in ({}, {**told, "left_out": 0}, {**told, "warnings": []}):
            self.assertIn("missing", cutting.fault_of_partial("E504", said, text))
        self.assertEqual(cutting.fault_of_partial("E504", told, text.removesuffix("\nM2")), "does not end")
        self.assertIn("tool on", cutting.fault_of_partial("E504", told, text.replace("M5\n", "")))
        self.assertIn("no controller", cutting.fault_of_partial("E504", told, text.replace(" F100", "")))

    def test_ways_and_outlines_cover_each_other(self):
        square = [(0, 0), (10, 0), (10, 10), (0, 10), (0, 0)]
        program = Controller("G21 G90\nG0 X0 Y0\nM3 S1\nG1 X10 Y0 F100\nX10 Y10\nX0 Y10\nX0 Y0", burns=True)
        found = cutting.covered([square], program, 0.01)
        self.assertLess(max(found["off"], found["left"]), 1e-9)
        program.moves.pop()
        self.assertGreater(cutting.covered([square], program, 0.01)["left"], 0.03)
        self.assertEqual(cutting.Lines([square], 1.0).nearest((5, 0.25), 1.0), (0.25, 0))


class Scans(unittest.TestCase):
    def row(self, points):
        chords = [complex(*b) - complex(*a) for a, b in zip(points, points[1:])]
        return {"segments": [{"chord": abs(z), "heading": math.atan2(z.imag, z.real)} for z in chords]}

    def test_a_row_is_right_up_to_direction_and_start(self):
        ring = [(math.cos(k), math.sin(k)) for k in range(6)]
        for row, closed, right in ((ring, True, True), (ring[2:] + ring[:2], True, True), (ring[::-1], False, True),
                                   (ring[2:] + ring[:2], False, False), ([ring[1], ring[0], *ring[2:]], True, False),
                                   (ring[:5], True, False)):
            self.assertEqual(scans.ordered({"points": ring, "closed": closed}, self.row(row)), right)
        self.assertTrue(scans.clear(ring, True))
        self.assertFalse(scans.clear([(0, 0), (2, 0), (4, 0), (4, 1), (2, 1), (0, 1)], True))

    def test_lines_and_arcs_are_held_against_the_truth(self):
        arc = {"type": "arc", "start": [0, -10], "end": [10, 0], "theta0": 0.0, "kappa": 0.1, "length": 5 * math.pi}
        points = [(10 * math.sin(k / 10), -10 * math.cos(k / 10)) for k in range(1, 15)]
        row = {"kind": "arc", "first": 0, "last": 13, "length": 14.0, "kappa": 0.1, "centre": 0j}
        case = cases.Case("a", None, [], 0.002, "", {"points": points})
        found = scans.held_against(row, case, {"pieces": [arc]})
        self.assertTrue(found["found"])
        self.assertLess(max(found["radius_off"], found["centre_off"]), 1e-12)
        self.assertFalse(scans.held_against(row, case, {"pieces": [{**arc, "kappa": 0.2}]})["found"])
        self.assertFalse(scans.held_against(row, case, None)["found"])

    def test_outlines_close_and_no_point_stands_on_their_corners(self):
        with tempfile.TemporaryDirectory() as folder:
            for name, shape in scans.outlines():
                case = scans.outline_case(pathlib.Path(folder), name, shape, 0.0, 0)
                points = [complex(*p) for p in case.truth["points"]]
                self.assertLess(abs(case.truth["corners"][-1] if shape[-1][2] else 0), 1e-9, name)
                self.assertEqual(len(case.truth["corners"]), sum(turn != 0 for _, _, turn in shape))
                for corner in case.truth["corners"]:
                    self.assertGreater(min(abs(p - corner) for p in points), 0.005, name)
            case.truth["corners"] = [0j, 1 + 0j]
            made = {"elements": [{"point": [1.0, 0.0], "corner": True}, {"point": [5.0, 0.0], "corner": True}]}
            self.assertEqual(scans.corners_met(case, made), (2, 1, 1))
            self.assertEqual(scans.corners_met(case, None), (2, 0, 0))

    def test_the_numbers_of_what_is_left_out_are_read(self):
        text = "left out 2 points that lie off the curve of their neighbours: 128 (2.457 units), 162 (2.066 mm); the others"
        self.assertEqual(scans.LEFT_OUT.findall(text), ["128", "162"])
        text = "left out point 65 (0.2037 mm off the curve of its neighbours); the others scatter by 0.004220 mm"
        self.assertEqual(scans.LEFT_OUT.findall(text), ["65"])


class Points(unittest.TestCase):
    def test_written_points_read_back_to_the_same_doubles(self):
        with tempfile.TemporaryDirectory() as folder:
            points = [(0.1, 1 / 3), (1e-17, -2e8), (3.0, 4.0)]
            path = cases.write_points(pathlib.Path(folder) / "a.csv", points, "one\ntwo", [1, 2, 3])
            self.assertEqual([tuple(r[:2]) for r in cases.number_rows(path, 3)], points)


if __name__ == "__main__":
    unittest.main()
