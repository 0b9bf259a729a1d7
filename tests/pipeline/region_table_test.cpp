// SPDX-License-Identifier: Apache-2.0
// The region of the user's own points and tangents: one segment between two points, whatever
// elements the chain needs between them.
#include "obvid/pipeline/region_table.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <sstream>
#include <string>
#include <vector>

namespace obvid {
namespace {

/// A row of numbers from each line of a table of tests/data/paper.
std::vector<std::vector<double>> paper_rows(const std::string& name) {
  std::ifstream file(std::string(OBVID_TEST_DATA) + "/paper/" + name);
  std::vector<std::vector<double>> rows;
  for (std::string line; std::getline(file, line);) {
    if (line.empty() || line.front() == '#') continue;
    std::istringstream fields(line);
    rows.emplace_back();
    for (double x = 0.0; fields >> x;) rows.back().push_back(x);
  }
  EXPECT_FALSE(rows.empty()) << name;
  return rows;
}

/// Angle between the sides a and b of a triangle.
double angle_opposite(double c, double a, double b) {
  return std::acos((a * a + b * b - c * c) / (2.0 * a * b));
}

/// The ten points of the paper with the headings that the printed sides of its triangles say; the
/// two that meet at a point are averaged. The contour turns right.
PointSeries with_printed_tangents() {
  PointSeries series;
  for (const auto& row : paper_rows("points10.txt")) series.points.push_back({row[0], row[1]});
  const auto printed = paper_rows("region10.txt");
  const std::size_t n = series.points.size();
  std::vector<Vec2> sum(n);
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const Vec2 chord = series.points[i + 1] - series.points[i];
    const double h = norm(chord), along = std::atan2(chord.y, chord.x);
    const double to = printed[i][1], from = printed[i][2];
    const double first = along + angle_opposite(from, to, h);
    const double second = along - angle_opposite(to, from, h);
    sum[i] = sum[i] + Vec2{std::cos(first), std::sin(first)};
    sum[i + 1] = sum[i + 1] + Vec2{std::cos(second), std::sin(second)};
  }
  series.fixed.resize(n);
  for (std::size_t i = 0; i < n; ++i) series.fixed[i].theta = std::atan2(sum[i].y, sum[i].x);
  return series;
}

TEST(RegionTable, HasOneSegmentBetweenTwoPointsWithGivenTangents) {
  const PointSeries series = with_printed_tangents();
  const auto table = region_table(series);
  ASSERT_TRUE(table) << table.error().what;
  const auto printed = paper_rows("region10.txt");
  ASSERT_EQ(table->rows.size(), printed.size());
  ASSERT_EQ(table->elements.size(), series.points.size());
  // The two headings at a point differ by a few hundredths of a radian where the sides are short
  // (rounded to two digits): some hundredths of the chord in the sides, less in the heights.
  constexpr double kOfChord = 0.02, kOfHeight = 0.02;
  for (std::size_t i = 0; i < printed.size(); ++i) {
    const RegionRow& row = table->rows[i];
    EXPECT_EQ(table->elements[i].point, series.points[i]) << i;
    EXPECT_NEAR(row.to_apex, printed[i][1], kOfChord * row.chord) << i + 1;
    EXPECT_NEAR(row.from_apex, printed[i][2], kOfChord * row.chord) << i + 1;
    ASSERT_TRUE(row.lower_height && row.width && row.kappa_start && row.kappa_end) << i + 1;
    EXPECT_NEAR(*row.lower_height, printed[i][3], kOfHeight * printed[i][3]) << i + 1;
    EXPECT_LE(row.kappa_start->low, row.kappa_start->high) << i + 1;
    // the range at a point is the same from both sides
    if (i > 0) {
      EXPECT_EQ(row.kappa_start->low, table->rows[i - 1].kappa_end->low) << i + 1;
    }
  }
}

TEST(RegionTable, OverAnArcIsTheArc) {
  constexpr double kRadius = 5.0, kStep = 0.3;
  PointSeries series;
  for (int k = 0; k < 6; ++k) {
    series.points.push_back({kRadius * std::cos(kStep * k), kRadius * std::sin(kStep * k)});
  }
  const auto table = region_table(series);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_EQ(table->rows.size(), 5u);
  for (const RegionRow& row : table->rows) {
    ASSERT_TRUE(row.lower_height && row.width && row.kappa_start);
    EXPECT_NEAR(*row.lower_height, kRadius * (1.0 - std::cos(0.5 * kStep)), 1e-13);
    EXPECT_EQ(*row.width, 0.0);
    EXPECT_NEAR(row.kappa_start->low, 1.0 / kRadius, 1e-13);
    EXPECT_EQ(row.kappa_start->low, row.kappa_start->high);
  }
}

/// Parabolas, conics and clothoids through three points have any curvature there: that the circle
/// through them was taken bounds nothing.
TEST(RegionTable, TellsNoRangesOfThreePointsOnTheCircleThroughThem) {
  PointSeries three, straight, beside_corner;
  three.points = {{0.0, 0.0}, {1.0, 0.2}, {2.0, 0.0}};
  straight.points = {{0.0, 0.0}, {1.0, 0.0}, {2.0, 0.0}};
  beside_corner.points = {{0.0, 0.0}, {1.0, 0.2}, {2.0, 0.0}, {2.0, 1.0},
                          {1.8, 2.0}, {1.3, 2.9}, {0.5, 3.6}};
  RegionJob with_corner;
  beside_corner.fixed.resize(beside_corner.points.size());
  beside_corner.fixed[2].corner = true;
  for (const auto& [series, job] : {std::pair{three, RegionJob{}}, std::pair{straight, RegionJob{}},
                                    std::pair{beside_corner, with_corner}}) {
    const auto table = region_table(series, job);
    ASSERT_TRUE(table) << table.error().what;
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_FALSE(table->user.points[i].headings) << i;
      EXPECT_FALSE(table->user.points[i].curvatures) << i;
    }
    for (std::size_t i = 0; i < 2; ++i) {
      const RegionRow& row = table->rows[i];
      EXPECT_FALSE(row.kappa_start || row.kappa_end || row.width || row.lower_height) << i;
      EXPECT_FALSE(row.apex_gap || row.tangent_gap || row.tangent_bound) << i;
      EXPECT_TRUE(std::isfinite(row.theta_start));
    }
    if (series.points.size() > 3) {
      EXPECT_TRUE(table->user.points[4].headings);
    }
  }
}

TEST(RegionTable, TellsNoneOfThemWhereAWidthIsAskedForEither) {
  PointSeries series;
  series.points = {{0.0, 0.0}, {1.0, 0.2}, {2.0, 0.0}};
  RegionJob job;
  job.job.tolerance = 1e-3;
  const auto table = region_table(series, job);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_TRUE(table->refined);
  for (const RegionPoint& p : table->refined->points) EXPECT_FALSE(p.headings || p.curvatures);
  for (const RegionRow& row : table->refined->rows) EXPECT_FALSE(row.width);
}

/// A heading that is not the circle's leaves curves of one direction.
TEST(RegionTable, TellsRangesOfThreePointsWithAHeading) {
  PointSeries series;
  series.points = {{0.0, 0.0}, {1.0, 0.2}, {2.0, 0.0}};
  RegionJob job;
  job.job.start_heading = 30.0 * std::numbers::pi / 180.0;
  const auto table = region_table(series, job);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_TRUE(table->user.points[0].headings);
  // that of the circle through the three points ends it: twice the angle over half the chord
  EXPECT_NEAR(table->user.points[0].headings->low, 2.0 * std::atan(0.2), 1e-6);
  EXPECT_TRUE(table->rows[0].width);
}

TEST(RegionTable, HasNoRegionWhereAVertexLiesBetweenPoints) {
  // six points on a line, then a turn: the curvature grows and falls between points 6 and 7
  PointSeries series;
  series.points = {{0, 10},   {2, 10},  {3, 10},  {5, 10},  {6, 10}, {8, 10},
                   {9, 10.5}, {11, 15}, {12, 50}, {14, 60}, {15, 85}};
  const auto table = region_table(series);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_EQ(table->rows.size(), 10u);
  EXPECT_FALSE(table->rows[5].width);
  EXPECT_FALSE(table->rows[5].lower_height);
  EXPECT_FALSE(table->rows[5].kappa_start);
  EXPECT_TRUE(table->rows[6].width);
  EXPECT_NEAR(table->rows[5].chord, std::hypot(1.0, 0.5), 1e-15);
}

TEST(RegionTable, KeepsItsFiguresBesideASharpBend) {
  // once points are inserted neighbouring chords turn by 173 degrees at the third one of the user's
  PointSeries series;
  series.points = {{0.4427491, -0.8228107},
                   {0.9595527, -0.9884242},
                   {2.975948, 0.8124058},
                   {-3.193279, -9.118328}};
  RegionJob job;
  job.rule = TangentRule::kCentral;
  job.job.tolerance = 1.96e-4;
  const auto table = region_table(series, job);
  ASSERT_TRUE(table) << table.error().what;
  ASSERT_TRUE(table->refined);
  const std::vector<RegionPoint>& points = table->refined->points;
  ASSERT_GT(points.size(), 20u);
  double sharpest = 0.0;
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    const Vec2 a = points[i].point - points[i - 1].point, b = points[i + 1].point - points[i].point;
    const double circle = 2.0 * cross(a, b) / (norm(a) * norm(b) * norm(a + b));
    sharpest = std::max(sharpest, std::abs(turning(a, b)));
    ASSERT_TRUE(points[i].adjacent_kappa) << i;
    EXPECT_NEAR(*points[i].adjacent_kappa, circle, 1e-9 * std::abs(circle)) << i;
  }
  EXPECT_GT(sharpest, 170.0 * std::numbers::pi / 180.0);
  for (const RegionRow& row : table->refined->rows) {
    EXPECT_EQ(row.region.has_value(), row.spline_distance.has_value()) << row.from;
  }
}

}  // namespace
}  // namespace obvid
