// SPDX-License-Identifier: Apache-2.0
// The papers' tables from the files of examples/ that hold the papers' points and tangents, by the
// job that `obvid region` runs.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

#include "obvid/io/read_points.h"
#include "obvid/pipeline/internal/region_files.h"
#include "obvid/pipeline/region_table.h"

namespace obvid {
namespace {

constexpr double kTwoDecimals = 0.005, kFourDecimals = 0.00005;  // half a unit, mm

PointSeries example(const std::string& name) {
  const auto series = read_points(std::string(OBVID_TEST_DATA) + "/../../examples/" + name);
  EXPECT_TRUE(series) << name;
  return series ? *series : PointSeries{};
}

/// A row of numbers from each line of a table of tests/data/paper; "nan" where nothing is printed.
std::vector<std::vector<double>> printed(const std::string& name) {
  std::ifstream file(std::string(OBVID_TEST_DATA) + "/paper/" + name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    rows.emplace_back();
    for (std::string field; fields >> field;) rows.back().push_back(std::stod(field));
  }
  EXPECT_FALSE(rows.empty()) << name;
  return rows;
}

RegionPart worksheet(const std::string& name) {
  const auto table = region_table(example(name));
  EXPECT_TRUE(table) << (table ? "" : table.error().what);
  return table ? table->user : RegionPart{};
}

TEST(PaperWorksheet, GivesChordsRadiiAndErrorsOfTableOne) {
  const RegionPart part = worksheet("paper_series10.csv");
  const auto rows = printed("adjacent_circles.txt");
  ASSERT_EQ(part.rows.size(), 9u);
  for (std::size_t i = 0; i < part.rows.size(); ++i) {
    const double chord = i == 6 ? 36.36 : rows[i][0];  // 36.29 is a misprint
    EXPECT_NEAR(part.rows[i].chord, chord, kTwoDecimals) << i + 1;
    if (i == 0) continue;
    ASSERT_TRUE(part.points[i].adjacent_kappa);
    // coordinates rounded to 0.01 move radii and errors by more than their last digit: within 0.1 %
    EXPECT_NEAR(-1.0 / *part.points[i].adjacent_kappa, rows[i][1], 1e-3 * rows[i][1]) << i + 1;
    if (i == 8) continue;
    ASSERT_TRUE(part.rows[i].points_only_error);
    const double error = i == 1 ? 0.436 : rows[i][2];  // 0.4966 is a misprint
    EXPECT_NEAR(*part.rows[i].points_only_error, error, 3e-3 * error) << i + 1;
  }
  EXPECT_FALSE(part.rows.front().points_only_error);
}

TEST(PaperWorksheet, GivesEveryFigureOfTableTwo) {
  const RegionPart part = worksheet("paper_series10.csv");
  const auto rows = printed("region10.txt");
  ASSERT_EQ(part.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RegionRow& row = part.rows[i];
    EXPECT_NEAR(row.to_apex, rows[i][1], kTwoDecimals) << i + 1;
    EXPECT_NEAR(row.from_apex, rows[i][2], kTwoDecimals) << i + 1;
    ASSERT_TRUE(row.lower_height && row.width) << i + 1;
    EXPECT_NEAR(*row.lower_height, rows[i][3], kFourDecimals) << i + 1;
    const double width = i == 7 ? 0.2857 : rows[i][4];  // 0.2257 is a misprint, Table 3 is right
    EXPECT_NEAR(*row.width, width, kFourDecimals) << i + 1;
  }
}

TEST(PaperWorksheet, GivesTrianglesAndHeightsOfTableThree) {
  const RegionPart part = worksheet("paper_series11.csv");
  const auto rows = printed("region11.txt");
  ASSERT_EQ(part.rows.size(), rows.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const RegionRow& row = part.rows[i];
    EXPECT_NEAR(row.chord, i == 6 ? 36.36 : rows[i][0], kTwoDecimals) << i + 1;
    EXPECT_NEAR(row.to_apex, rows[i][1], kTwoDecimals) << i + 1;
    EXPECT_NEAR(row.from_apex, rows[i][2], kTwoDecimals) << i + 1;
    ASSERT_TRUE(row.lower_height) << i + 1;
    EXPECT_NEAR(*row.lower_height, rows[i][3], kFourDecimals) << i + 1;
  }
}

TEST(PaperWorksheet, GivesTrianglesAndErrorsOfConvexContours) {
  const RegionPart part = worksheet("paper_series10.csv");
  const auto rows = printed("convex10.txt");
  for (std::size_t i = 1; i < rows.size(); ++i) {  // row 1 belongs to another first tangent
    const RegionRow& row = part.rows[i];
    ASSERT_TRUE(row.apex_height && row.tangent_height && row.apex_gap && row.tangent_gap) << i + 1;
    EXPECT_NEAR(*row.tangent_height, rows[i][2], kFourDecimals) << i + 1;
    if (i == 8) continue;  // H of the last segment: what stands for the missing chord is not said
    // coordinates rounded to 0.01 move H by up to 0.1 %
    EXPECT_NEAR(*row.apex_height, rows[i][1], 1e-3 * rows[i][1]) << i + 1;
    EXPECT_NEAR(*row.apex_gap, rows[i][3], 1e-3 * rows[i][3]) << i + 1;
    // row 8 prints 1.4320, 0.0110 less than its own Ht and h give
    if (i == 7) continue;
    EXPECT_NEAR(*row.tangent_gap, rows[i][4], 4.0 * kFourDecimals) << i + 1;
  }
}

TEST(PaperWorksheet, GivesTheInvoluteToEveryPrintedDigit) {
  const RegionPart part = worksheet("paper_involute.csv");
  const auto rows = printed("involute.txt");
  for (std::size_t i = 1; i <= rows.size(); ++i) {
    const double chord = i == 7 ? 8.00 : rows[i - 1][0];  // 7.97 is a misprint
    EXPECT_NEAR(100.0 * part.rows[i].chord, chord, kTwoDecimals * 1.0001) << i;
    ASSERT_TRUE(part.rows[i].apex_height) << i;
    const double half = 0.5 * std::pow(10.0, -rows[i - 1][2]);
    EXPECT_NEAR(1e4 * *part.rows[i].apex_height, rows[i - 1][1], half * 1.0001) << i;
  }
}

TEST(PaperWorksheet, InsertedPointsStandOnTheBisectorInTheMiddleOfTheRegion) {
  RegionJob job;
  job.insert = {8};
  const auto table = region_table(example("paper_series10.csv"), job);
  ASSERT_TRUE(table);
  ASSERT_TRUE(table->refined);
  const RegionPart& part = *table->refined;
  ASSERT_EQ(part.points.size(), 11u);
  const RegionPoint& p = part.points[9];
  EXPECT_EQ(p.inserted, 1u);
  EXPECT_EQ(region_point_name(p), "9.1");
  const Vec2 a = part.points[8].point, b = part.points[10].point;
  EXPECT_NEAR(norm(p.point - a), norm(b - p.point), 1e-12 * norm(b - a));
  // [000] puts it within the same region: 0.1 mm from ours on the same line
  const Vec2 u = (b - a) / norm(b - a), printed_point{168.62, -2.92};
  EXPECT_LT(std::abs(dot(u, p.point - printed_point)), 0.01);
  EXPECT_LT(norm(p.point - printed_point), 0.5 * *table->rows[8].width);
  for (const std::size_t i : {8u, 9u}) {
    EXPECT_LT(*part.rows[i].width, 0.2 * *table->rows[8].width) << i;
  }
  // the two new regions lie inside the old one: no other segment becomes wider
  for (std::size_t i = 0; i < 8; ++i) {
    EXPECT_LE(*part.rows[i].width, *table->rows[i].width * (1.0 + 1e-9)) << i;
  }
}

TEST(PaperWorksheet, PointsAreInsertedUntilNoRegionIsWiderThanAsked) {
  for (const double tolerance : {0.05, 0.001}) {
    RegionJob job;
    job.job.tolerance = tolerance;
    const auto table = region_table(example("paper_series10.csv"), job);
    ASSERT_TRUE(table) << table.error().what;
    ASSERT_TRUE(table->refined);
    EXPECT_GT(table->refined->points.size(), 11u);
    for (const RegionRow& row : table->refined->rows) {
      ASSERT_TRUE(row.width);
      EXPECT_LE(*row.width, tolerance);
    }
  }
}

TEST(PaperWorksheet, CentralTangentsLeaveAllRangesOpen) {
  PointSeries series = example("series10.csv");
  RegionJob job;
  job.rule = TangentRule::kCentral;
  const auto table = region_table(series, job);
  ASSERT_TRUE(table) << table.error().what;
  for (std::size_t i = 0; i < table->user.points.size(); ++i) {
    const RegionPoint& p = table->user.points[i];
    ASSERT_TRUE(p.headings && p.curvatures) << i + 1;
    EXPECT_GT(p.theta, p.headings->low) << i + 1;
    EXPECT_LT(p.theta, p.headings->high) << i + 1;
    EXPECT_GT(p.kappa, p.curvatures->low) << i + 1;
    EXPECT_LT(p.kappa, p.curvatures->high) << i + 1;
  }
  for (const RegionRow& row : table->rows) EXPECT_TRUE(row.width);
}

TEST(PaperWorksheet, OfAClosedOutlineHasNoSeam) {
  PointSeries series;
  constexpr int kPoints = 16;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 2.0 * std::numbers::pi * i / kPoints + 0.1;
    series.points.push_back({50.0 * std::cos(t), 30.0 * std::sin(t)});
  }
  RegionJob job;
  job.job.closing = Closing::kClosed;
  const auto table = region_table(series, job);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_EQ(table->rows.size(), static_cast<std::size_t>(kPoints));
  for (std::size_t i = 0; i < table->rows.size(); ++i) {
    const RegionPoint& p = table->user.points[i];
    ASSERT_TRUE(p.headings && p.curvatures && p.adjacent_kappa) << i + 1;
    EXPECT_LT(p.headings->low, p.theta) << i + 1;
    EXPECT_GT(p.headings->high, p.theta) << i + 1;
    // half a turn further the outline is the same
    const RegionPoint& q = table->user.points[(i + kPoints / 2) % kPoints];
    EXPECT_NEAR(p.headings->high - p.headings->low, q.headings->high - q.headings->low, 1e-6);
    EXPECT_NEAR(*p.adjacent_kappa, *q.adjacent_kappa, 1e-12) << i + 1;
    ASSERT_TRUE(table->rows[i].width) << i + 1;
  }
}

TEST(PaperWorksheet, OfAWaveHasARegionOnEverySegment) {
  PointSeries series;
  for (int i = 0; i <= 12; ++i) {
    const double x = std::numbers::pi / 6.0 * i;
    series.points.push_back({x, std::sin(x)});
  }
  for (const TangentRule rule : {TangentRule::kFair, TangentRule::kCentral}) {
    RegionJob job;
    job.rule = rule;
    job.construction = Construction::kArcs;
    const auto table = region_table(series, job);
    ASSERT_TRUE(table) << table.error().what;
    for (std::size_t i = 0; i < table->user.points.size(); ++i) {
      const RegionPoint& p = table->user.points[i];
      ASSERT_TRUE(p.headings) << i + 1;
      EXPECT_LT(p.headings->low, std::atan(std::cos(p.point.x))) << i + 1;
      EXPECT_GT(p.headings->high, std::atan(std::cos(p.point.x))) << i + 1;
    }
    for (const RegionRow& row : table->rows) EXPECT_TRUE(row.width);
    EXPECT_EQ(table->construction->remarks.front(), "the radii go one way along every run");
  }
}

RegionTable constructed(const std::string& name, Construction which,
                        TangentRule rule = TangentRule::kFair) {
  RegionJob job;
  job.construction = which;
  job.rule = rule;
  auto table = region_table(example(name), job);
  EXPECT_TRUE(table) << (table ? "" : table.error().what);
  return table ? std::move(*table) : RegionTable{};
}

TEST(PaperConstructions, RadiiOfTwoArcsGrowAlongTheContourAsInTableFour) {
  const RegionTable table = constructed("paper_series11.csv", Construction::kArcs);
  ASSERT_TRUE(table.construction);
  const auto rows = printed("arcs11.txt");
  ASSERT_EQ(table.construction->rows.size(), rows.size());
  double before = 0.0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto& v = table.construction->rows[i].values;
    EXPECT_GT(-v[0], before) << i + 1;
    EXPECT_GT(-v[1], -v[0]) << i + 1;
    before = -v[1];
    const RegionRow& row = table.rows[i];
    // between the boundaries, like the printed ones
    EXPECT_GE(v[2], *row.lower_height * (1.0 - 1e-9)) << i + 1;
    EXPECT_LE(v[2], *row.lower_height + *row.width * (1.0 + 1e-9)) << i + 1;
    // the arcs go from point to point
    const Piece& first = table.construction->pieces[2 * i];
    EXPECT_EQ(start_point(first), table.user.points[i].point) << i + 1;
    EXPECT_LT(
        norm(end_point(table.construction->pieces[2 * i + 1]) - table.user.points[i + 1].point),
        1e-9);
  }
}

/// Weight with which the conic over a segment begins with a curvature: S/(w^2 a^3).
double weight_for_start(const RegionTable& table, std::size_t i, double kappa) {
  const RegionRow& row = table.user.rows[i];
  const double area = 0.5 * row.chord * *row.tangent_height;
  return std::sqrt(area / (std::pow(row.to_apex, 3.0) * std::abs(kappa)));
}

/// But where no ellipse has the curvature of the one before.
TEST(PaperConstructions, EllipsesHaveOneCurvatureAtEachPointAndTellTheirVertices) {
  const RegionTable table = constructed("paper_series10.csv", Construction::kEllipses);
  ASSERT_TRUE(table.construction);
  const auto& made = *table.construction;
  ASSERT_EQ(made.pieces.size(), 9u);
  for (std::size_t i = 0; i < made.pieces.size(); ++i) {
    const auto curvature_at = [&](double t) { return curvature(evaluate(made.pieces[i], t)); };
    if (i > 0) {
      const double before = curvature(evaluate(made.pieces[i - 1], 1.0));
      const bool carries_on = weight_for_start(table, i, before) < 1.0;
      EXPECT_EQ(carries_on, i != 7) << i + 1;
      if (carries_on) {
        EXPECT_NEAR(curvature_at(0.0), before, 1e-9 * std::abs(before)) << i + 1;
      }
    }
    const double heading_here = heading(evaluate(made.pieces[i], 0.0).d1);
    EXPECT_LT(
        std::abs(std::remainder(heading_here - table.user.points[i].theta, 2.0 * std::numbers::pi)),
        1e-9);
    // sampled: one way, or a turning point inside
    int turns = 0;
    constexpr int kSamples = 400;
    double last_change = 0.0;
    for (int k = 0; k < kSamples; ++k) {
      const double change = curvature_at((k + 1.0) / kSamples) - curvature_at(1.0 * k / kSamples);
      if (change * last_change < 0.0) ++turns;
      if (change != 0.0) last_change = change;
    }
    const bool monotone = made.rows[i].remark.find("monotone") != std::string::npos;
    EXPECT_EQ(monotone, turns == 0) << i + 1 << made.rows[i].remark;
  }
}

TEST(PaperConstructions, ClothoidsFollowTheNeighboursRule) {
  const RegionTable table =
      constructed("series10.csv", Construction::kClothoids, TangentRule::kNeighbours);
  ASSERT_TRUE(table.construction);
  const auto& points = table.user.points;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec2 chord = points[i + 1].point - points[i - 1].point;
    EXPECT_LT(std::abs(cross(unit_at(points[i].theta), chord)), 1e-12 * norm(chord)) << i + 1;
    const Piece &before = table.construction->pieces[i - 1], &after = table.construction->pieces[i];
    EXPECT_LT(norm(end_point(before) - points[i].point), 1e-9);
    EXPECT_EQ(start_point(after), points[i].point);
    const double step = curvature(evaluate(after, 0.0)) - curvature(evaluate(before, 1.0));
    EXPECT_NEAR(step, table.construction->rows[i - 1].values[3], 1e-12);
  }
}

TEST(PaperWorksheet, TwoPointsWithHeadingsHaveARegion) {
  PointSeries series;
  series.points = {{0.0, 0.0}, {2.0, 0.0}};
  series.fixed = {{0.3, {}, {}, false}, {-0.5, {}, {}, false}};
  const auto table = region_table(series);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_EQ(table->rows.size(), 1u);
  const RegionRow& row = table->rows.front();
  // (9) and (10) of [000] for radii that fall: the line at the first point and the arc that
  // touches it and the second tangent; the circle through the second point that touches the first
  // tangent
  ASSERT_TRUE(row.kappa_start && row.kappa_end && row.width);
  EXPECT_EQ(row.direction, -1);
  constexpr double kInterpolated = 1e-8;
  EXPECT_NEAR(row.kappa_start->low, -std::sin(0.3), kInterpolated);
  EXPECT_EQ(row.kappa_start->high, 0.0);
  EXPECT_EQ(row.kappa_end->low, -std::numeric_limits<double>::infinity());
  EXPECT_NEAR(row.kappa_end->high, -(std::sin(0.5) + std::pow(std::sin(0.1), 2) / std::sin(0.3)),
              kInterpolated);
}

TEST(PaperWorksheet, ThreePointsWithHeadingsHaveARegionAndASpiral) {
  PointSeries series;
  series.points = {{0.0, 0.0}, {2.0, 0.5}, {5.0, 0.0}};
  const double degree = std::numbers::pi / 180.0;
  for (const double heading : {40.0, 3.0, -20.0}) {
    series.fixed.push_back({heading * degree, {}, {}, false});
  }
  const auto table = region_table(series);
  ASSERT_TRUE(table) << table.error().what;
  for (const RegionRow& row : table->rows) EXPECT_TRUE(row.width);
  const auto made = fit(series, {});
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_TRUE(made->certificate.proved);
  EXPECT_EQ(made->certificate.vertices, 0);
  EXPECT_EQ(made->certificate.inflections, 0);
}

TEST(PaperWorksheet, TwoPointsWithHeadingsAndRadiiHaveASpiral) {
  PointSeries series;
  series.points = {{0.0, 0.0}, {2.0, 0.0}};
  for (const bool radii : {false, true}) {
    series.fixed = {{0.3, {}, {}, false}, {-0.5, {}, {}, false}};
    if (radii) {
      series.fixed[0].kappa = -0.1;
      series.fixed[1].kappa = -0.8;
    }
    for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs, Carrier::kConics,
                                  Carrier::kClothoids, Carrier::kBeziers}) {
      FitJob job;
      job.carrier = carrier;
      const auto made = fit(series, job);
      // one conic has one number to choose: both radii are more than it can keep
      if (radii && carrier == Carrier::kConics) continue;
      ASSERT_TRUE(made) << to_string(carrier) << radii << made.error().what;
      EXPECT_TRUE(made->certificate.proved) << to_string(carrier);
      EXPECT_EQ(made->certificate.vertices, 0) << to_string(carrier);
      EXPECT_LT(made->report.given.heading_miss, 1e-9) << to_string(carrier);
    }
  }
}

}  // namespace
}  // namespace obvid
