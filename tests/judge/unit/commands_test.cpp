// SPDX-License-Identifier: Apache-2.0
// Curves in space, control points, functions of two variables: each claim doctored once.
#include <fmt/format.h>

#include "command_checks.h"
#include "doctored.h"
#include "input.h"
#include "sentences.h"

namespace judge {
namespace {

Sheet of_space(const std::string& text, const std::string& report = "") {
  Sheet sheet;
  judge_space(text, report, sheet);
  return sheet;
}

TEST(JudgeSpace, AcceptsAFileAndItsReport) {
  const Sheet sheet = of_space(data("judge/space.json"), data("judge/space.txt"));
  EXPECT_EQ(sheet.wrong(), 0) << all_false(sheet);
  EXPECT_GT(sheet.counts().at("text: row of a point in space").judged, 30);
}

TEST(JudgeSpace, FindsEachFalseFigure) {
  const std::string sound = data("judge/space.json");
  const std::pair<const char*, const char*> all[] = {
      {"flatness", "0.001"},           {"largest_move", "0.01"},
      {"least_curvature", "0.01045"},  {"largest_curvature", "0.01145"},
      {"torsion_places", "575"},       {"least_torsion", "0.00136"},
      {"largest_torsion", "0.004442"}, {"torsion_step", "3.7e-05"}};
  for (const auto& [name, value] : all) {
    const Sheet sheet = of_space(with(sound, name, value));
    EXPECT_TRUE(sheet.has(fmt::format("space.{}", name))) << name << "\n" << all_false(sheet);
  }
  EXPECT_TRUE(
      of_space(changed(sound, "\"deviation\": 0.004326553222297583", "\"deviation\": 0.0005"))
          .has("space.curve.deviation"));
  EXPECT_TRUE(of_space(with(sound, "normal", "[0, 0, -1]")).has("space.frame"));
  EXPECT_TRUE(
      of_space(changed(sound, "[71, 64, 12]", "[71, 64, 12.001]")).has("space.heights.height"));
  EXPECT_TRUE(of_space(changed(sound, "[71, 64, 12]", "[71, 64.001, 12]")).has("space.points"));
}

TEST(JudgeSpace, AcceptsAClosedFileAndItsReport) {
  const Sheet sheet = of_space(data("judge/space_closed.json"), data("judge/space_closed.txt"));
  EXPECT_EQ(sheet.wrong(), 0) << all_false(sheet);
  EXPECT_EQ(sheet.counts().at("space.seam").judged, 4);
}

TEST(JudgeSpace, FindsAFalseSeam) {
  const std::string sound = data("judge/space_closed.json");
  EXPECT_TRUE(of_space(changed(sound, "\"seam\": {\"position\": 0", "\"seam\": {\"position\": 1"))
                  .has("space.seam.position"));
  // the step at the seam is the largest one
  EXPECT_TRUE(of_space(with(sound, "torsion_step", "0.0239")).has("space.torsion_step"));
  // the last piece of the heights comes in with another tangent
  EXPECT_TRUE(
      of_space(changed(sound, ", 5.0150509373554]", ", 5.0160509373554]")).has("space.seam"));
}

TEST(JudgeSpace, AcceptsAChainAndFindsEachFalseFigure) {
  const std::string sound = data("judge/space_chain.json");
  const Sheet sheet = of_space(sound);
  EXPECT_EQ(sheet.wrong(), 0) << all_false(sheet);
  EXPECT_EQ(sheet.counts().at("chain.turn").judged, 1);
  EXPECT_EQ(sheet.counts().at("chain.corner").judged, 4);
  EXPECT_TRUE(of_space(changed(sound, "\"turn\": 1.57", "\"turn\": 1.58")).has("chain.turn"));
  EXPECT_TRUE(of_space(changed(sound, "\"point\": 3", "\"point\": 4")).has("chain.points"));
  EXPECT_TRUE(of_space(changed(sound, "[10, 0, 0]", "[10, 0, 0.001]")).has("chain.points"));
  EXPECT_TRUE(of_space(changed(sound, "\"largest_move\": 0", "\"largest_move\": -1"))
                  .has("chain.largest_move"));
}

TEST(JudgeSpace, FindsFalseCurvesOfAStepFile) {
  const ReadChain read = read_chain(read_json(data("judge/space_chain.json")).value);
  ASSERT_EQ(read.fault, "");
  const std::string sound = data("judge/space_chain.step");
  const auto wrong = [&](const std::string& text) {
    Sheet sheet;
    check_space_curves({&read.chain->parts[0]->nurbs, &read.chain->parts[1]->nurbs},
                       step_curves(text), "c.step", "space STEP", sheet);
    return sheet.wrong();
  };
  EXPECT_EQ(wrong(sound), 0);
  EXPECT_GT(wrong(changed(sound, "(30.,20.,20.)", "(30.,20.,20.001)")), 0);
  EXPECT_GT(wrong(changed(sound, "B_SPLINE_CURVE_WITH_KNOTS(", "B_SPLINE_CURVE_WITHOUT_KNOTS(")),
            0);
}

TEST(JudgeSpace, FindsAFalseReport) {
  const std::string file = data("judge/space.json"), sound = data("judge/space.txt");
  const std::pair<const char*, const char*> all[] = {
      {"0.01107", "0.01109"},   {"0.002356", "0.002366"},      {"0.003727", "0.003717"},
      {"48.6429", "48.6449"},   {"0.01044 and", "0.0103 and"}, {"576 places", "575 places"},
      {"3.748e-05", "3.9e-05"}, {"5 pieces, 0", "5 pieces, 1"}};
  for (const auto& [what, by] : all) {
    const Sheet sheet = of_space(file, changed(sound, what, by));
    EXPECT_GT(sheet.wrong(), 0) << what;
  }
}

TEST(JudgeSpace, FindsFalseSamples) {
  const ReadSpace read = read_space(read_json(data("judge/space.json")).value);
  ASSERT_EQ(read.fault, "");
  // the ends alone: the points of the table, and of them the curvatures it prints
  const std::string names = "s,x,y,z,curvature,torsion\n";
  const Real length = read.curve->heights->lengths.whole();
  const auto row = [&](Real order, Real s, Real more) {
    const SpaceJet jet = read.curve->at(order, order > 0.0L);
    return fmt::format("{},{},{},{},{},{}\n", static_cast<double>(s),
                       static_cast<double>(jet.p.x + more), static_cast<double>(jet.p.y),
                       static_cast<double>(jet.p.z), static_cast<double>(jet.curvature()),
                       static_cast<double>(jet.torsion()));
  };
  const Real end = read.curve->heights->course.path.end();
  Sheet sound, moved;
  check_space_samples(*read.curve, names + row(0.0L, 0.0L, 0.0L) + row(end, length, 0.0L), 2, false,
                      sound);
  EXPECT_EQ(sound.wrong(), 0) << all_false(sound);
  check_space_samples(*read.curve, names + row(0.0L, 0.0L, 1e-6L) + row(end, length, 0.0L), 2,
                      false, moved);
  EXPECT_TRUE(moved.has("space samples"));
}

NurbsInput six_points() {
  NurbsInput out;
  out.points = {{0, 0, 0}, {1, 2, 0}, {3, 3, 0}, {5, 3, 0}, {7, 2, 0}, {8, 0, 0}};
  out.weights.assign(6, 1.0L);
  out.at = {{1, 2.5L}};
  out.move = {{3, 0.8L}};
  return out;
}

Sheet of_nurbs(const std::string& text) {
  Sheet sheet;
  check_nurbs(read_json(text).value, six_points(), sheet);
  return sheet;
}

TEST(JudgeNurbs, FindsEachFalseFigure) {
  const std::string sound = data("judge/nurbs.json");
  EXPECT_EQ(of_nurbs(sound).wrong(), 0) << all_false(of_nurbs(sound));
  const std::tuple<const char*, const char*, int, const char*> all[] = {
      {"degree", "2", 0, "nurbs.degree"},
      {"u", "0.4531", 1, "nurbs.row.u"},
      {"w", "2.51", 1, "nurbs.row.w"},
      {"a", "0.583", 1, "nurbs.row on the line from B to P"},
      {"b", "0.801", 3, "nurbs.row.b as asked for"},
      {"B", "[2.06, 1.8539967397533, 0]", 1, "nurbs.row.B"},
      {"N", "[1.44, 1.939087195440, 0]", 1, "nurbs.row.N"},
      {"C", "[1.23, 1.967499260398, 0]", 1, "nurbs.row.C"},
      {"weights", "[1, 2.5, 1, 2.709, 1, 1]", 0, "nurbs.weights"},
      {"knots", "[0, 0, 0, 0, 1.1, 2, 3, 3, 3, 3]", 0, "nurbs.knots"}};
  for (const auto& [name, value, n, claim] : all) {
    const Sheet sheet = of_nurbs(with(sound, name, value, n));
    EXPECT_TRUE(sheet.has(claim)) << name << "\n" << all_false(sheet);
  }
}

TEST(JudgeNurbs, FindsFalseSamples) {
  const Json json = read_json(data("judge/nurbs.json")).value;
  const SpaceNurbs curve = nurbs_of(json);
  std::string text = "u,x,y,z,curvature\n";
  for (const Real u : {0.0L, 1.5L, 3.0L}) {
    const SpaceJet jet = curve.at(u);
    text += fmt::format("{},{},{},0,{}\n", static_cast<double>(u), static_cast<double>(jet.p.x),
                        static_cast<double>(jet.p.y), static_cast<double>(jet.curvature()));
  }
  Sheet sound, short_by_one, moved;
  check_nurbs_samples(json, text, 3, sound);
  EXPECT_EQ(sound.wrong(), 0) << all_false(sound);
  check_nurbs_samples(json, text, 4, short_by_one);
  EXPECT_TRUE(short_by_one.has("nurbs samples"));
  check_nurbs_samples(json, changed(text, "1.5,", "1.51,"), 3, moved);
  EXPECT_TRUE(moved.has("nurbs samples.u"));
}

GridInput nine_places() {
  GridInput out;
  std::string names;
  for (const auto& row : csv_rows(data("judge/spline_2d.csv"), names)) {
    out.places.push_back({*row[0], *row[1], *row[2], *row[3]});
  }
  out.cells = true;
  out.smooth = true;
  out.finer = {{0.5L, 0.5L, 0.4}, {2.0L, 1.5L, 2.2}};
  return out;
}

Sheet of_grid(const std::string& text) {
  Sheet sheet;
  check_grid_spline(read_json(text).value, nine_places(), sheet);
  return sheet;
}

TEST(JudgeSpline2d, FindsEachFalseFigure) {
  const std::string sound = data("judge/spline_2d.json");
  EXPECT_EQ(of_grid(sound).wrong(), 0) << all_false(of_grid(sound));
  const std::tuple<const char*, const char*, const char*> all[] = {
      {"largest_error", "2.61459", "spline.rows.largest_error"},
      {"largest_x", "0.5", "spline.rows.largest_x"},
      {"rms_error", "1.85049", "spline.rows.rms_error"},
      {"largest_move", "2.74", "spline.rows.largest_move"},
      {"integral", "3.0001", "spline.rows.integral"},
      {"integral_error", "1e-6", "spline.rows.integral_error"},
      {"x", "[0, 1.1, 3]", "spline.nodes"},
      {"integrals", "[0.3, 0.9, 0.7, 1.1001]", "spline.integrals"},
      {"values", "[0, 1, 2, 1, -0.751, 2.5, 1.5, 2, 4]", "spline.continuous slopes"},
      {"values", "[0, 1, 2.001, 1, -0.75, 2.5, 1.5, 2, 4]", "spline.values"}};
  for (const auto& [name, value, claim] : all) {
    const Sheet sheet = of_grid(with(sound, name, value));
    EXPECT_TRUE(sheet.has(claim)) << name << "\n" << all_false(sheet);
  }
}

TEST(JudgeSpline2d, FindsFalseSamples) {
  // the four corners of the grid; slopes from the parabolas along the edges, by hand: the lower
  // edge of the first cell has the values 0 and 1 and the mean 0.52777...: slope at the start
  // 6 * 0.52777 - 4 * 0 - 2 * 1
  const Json json = read_json(data("judge/spline_2d.json")).value;
  const double slope = 6.0 * 0.5277777777777778 - 2.0;
  const auto judged_row = [&](double f, double f_x) {
    Sheet sheet;
    check_grid_samples(json, fmt::format("x,y,f,f_x,f_y\n0,0,{},{},1.25\n", f, f_x), 4, sheet);
    return sheet;
  };
  EXPECT_FALSE(judged_row(0.0, slope).has("spline samples.f_x"))
      << all_false(judged_row(0.0, slope));
  EXPECT_TRUE(judged_row(0.0, slope + 1e-6).has("spline samples.f_x"));
  EXPECT_TRUE(judged_row(1e-6, slope).has("spline samples.f"));
  EXPECT_TRUE(judged_row(0.0, slope).has("spline samples"));  // one of four rows
}

std::vector<GivenPoint> heights(const std::vector<double>& y) {
  std::vector<GivenPoint> out;
  for (const double one : y) {
    out.emplace_back();
    out.back().point = {0.0, one};
  }
  return out;
}

TEST(Rounding, OfNumbersIsHalfAUnitOfTheirLastDigit) {
  EXPECT_DOUBLE_EQ(rounding_of(heights({3.25, 7.5})), 0.005);
  EXPECT_DOUBLE_EQ(rounding_of(heights({1200.0, 0.0})), 0.5);
  EXPECT_DOUBLE_EQ(rounding_of(heights({2.4654635870293123e+17, 2.465463587716912e+17})), 5.0);
  EXPECT_DOUBLE_EQ(rounding_of(heights({2.4654635870293123e+17, 12.5})), 0.05);
  EXPECT_DOUBLE_EQ(rounding_of(heights({0.0, 0.0})), 0.5);
}

}  // namespace
}  // namespace judge
