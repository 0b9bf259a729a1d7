// SPDX-License-Identifier: Apache-2.0
#include "winding.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "mended.h"
#include "obvid/alignment/alignment.h"
#include "rounded_corners.h"

namespace obvid::alignment {
namespace {

constexpr double kStraightAngle = std::numbers::pi;

/// One arc of radius 1 that turns by `turn`, from the origin, with the points at its ends.
std::size_t windings_of_arc(double turn) {
  Chain arc;
  arc.theta = -0.5 * turn;  // its chord lies along x
  arc.length = {turn};
  arc.kappa = {1.0};
  arc.ends = {{0, 0}};
  arc.law = {Transition::kClothoid};
  const std::vector<Vec2> points = {{0.0, 0.0}, arc.joints().back().point};
  const std::vector<double> tolerance = {1e-3, 1e-3};
  return windings(arc, {points, tolerance}, {{0, 0.0}, {0, turn}}, 0, 1);
}

TEST(Winding, AnArcBetweenNeighboursTurnsByHalfATurnAtMost) {
  EXPECT_EQ(windings_of_arc(0.5 * kStraightAngle), 0U);
  EXPECT_EQ(windings_of_arc(0.99 * kStraightAngle), 0U);
  EXPECT_EQ(windings_of_arc(1.01 * kStraightAngle), 1U);
  EXPECT_EQ(windings_of_arc(303.0 / 180.0 * kStraightAngle), 1U);
}

TEST(Winding, ACircleInItsPointsIsAllowedHoweverFewTheyAre) {
  for (int n = 3; n < 40; ++n) {
    std::vector<Vec2> points;
    for (int i = 0; i < n; ++i) points.push_back(unit_at(2.0 * kStraightAngle * i / n));
    const std::vector<double> tolerance(points.size(), 1e-6);
    const PointRow row{points, tolerance, true};
    for (std::size_t i = 0; i < row.intervals(); ++i) {
      const double begin = 0.5 * kStraightAngle + 2.0 * kStraightAngle * static_cast<double>(i) / n;
      EXPECT_TRUE(allows(passage_of(row, i), {begin, begin + 2.0 * kStraightAngle / n}))
          << n << ' ' << i;
    }
  }
}

TEST(Winding, StraightPointsShowNoSwingAndNoWayBack) {
  const std::vector<Vec2> points = {{0, 0}, {10, 0}, {20, 0}, {30, 0}};
  const std::vector<double> tolerance(4, 0.5);
  const Passage middle = passage_of({points, tolerance}, 1);
  // fifteen degrees, and what three chords are turned by as their ends move by their tolerances
  const double most = kStraightAngle / 12.0 + 2.0 * std::asin(0.1);
  EXPECT_TRUE(allows(middle, {-0.99 * most, 0.99 * most}));
  EXPECT_FALSE(allows(middle, {0.0, 1.01 * most}));
  EXPECT_FALSE(allows(middle, {kStraightAngle - 0.1, kStraightAngle + 0.1}));
  EXPECT_TRUE(allows(
      middle, {2.0 * kStraightAngle, 2.0 * kStraightAngle + 0.1}));  // headings are unwrapped
}

TEST(Winding, PointsNearerThanTheirTolerancesShowNoHeading) {
  const std::vector<Vec2> points = {{0, 0}, {1, 0}};
  const std::vector<double> tolerance(2, 0.5);
  const Passage any = passage_of({points, tolerance}, 0);
  EXPECT_TRUE(allows(any, {kStraightAngle - 0.1, kStraightAngle + 0.1}));
  EXPECT_FALSE(allows(any, {0.0, 1.01 * kStraightAngle}));
}

TEST(RoundedCorners, PassTheirPointsWithinTheTolerance) {
  const std::vector<Vec2> points = {{0, 0}, {100, 0}, {100, 3}, {40, 60}, {45, 300}};
  const std::vector<double> tolerance(points.size(), 0.25);
  const std::vector<Node> nodes = rounded_corners(points, tolerance);
  ASSERT_EQ(nodes.size(), 2U + 2U * 3U);
  for (std::size_t i = 1; i < 4; ++i) {
    const Node &in = nodes[2 * i - 1], &out = nodes[2 * i];
    const double turn = out.theta - in.theta;
    const double tangent = norm(points[i] - in.point);
    EXPECT_NEAR(norm(points[i] - out.point), tangent, 1e-12);  // so an arc joins both tangents
    const double radius = tangent / std::tan(0.5 * std::abs(turn));
    EXPECT_LE(radius * (1.0 / std::cos(0.5 * turn) - 1.0), 0.25);
    EXPECT_LT(out.place, nodes[2 * i + 1].place);
  }
}

/// A line of length 100 past points each 10, one of which lies 3 beside it.
TEST(Mended, ChordsPassTheStretchAndTheRestStays) {
  Chain line;
  line.length = {100.0};
  line.ends = {{Chain::kStraight, Chain::kStraight}};
  line.law = {Transition::kClothoid};
  std::vector<Vec2> points;
  std::vector<Foot> feet;
  for (int i = 0; i <= 10; ++i) {
    points.push_back({10.0 * i, i == 5 ? 3.0 : 0.0});
    feet.push_back({0, 10.0 * i});
  }
  const std::vector<double> tolerance(points.size(), 0.5);
  auto mended = with_rounded_chords(line, feet, {points, tolerance}, {4, 6});
  ASSERT_TRUE(mended);
  const std::vector<Element> joints = mended->chain.joints();
  // cut half way between points 3 and 4, and 6 and 7
  EXPECT_NEAR(norm(joints[1].point - Vec2{35.0, 0.0}), 0.0, 1e-9);
  EXPECT_NEAR(mended->chain.length.back(), 35.0, 1e-9);
  EXPECT_NEAR(norm(joints.back().point - Vec2{100.0, 0.0}), 0.0, 1e-9);
  EXPECT_NEAR(joints.back().theta, 0.0, 1e-9);
  find_feet(mended->chain, points, mended->feet);
  for (std::size_t i = 0; i < points.size(); ++i) {
    EXPECT_LE(std::abs(mended->feet[i].offset), 0.5) << i;
    const bool beside = i < 4 || i > 6;
    if (beside) {
      EXPECT_NEAR(mended->feet[i].offset, 0.0, 1e-9) << i;
    }
  }
  EXPECT_EQ(windings(mended->chain, {points, tolerance}, mended->feet, 0, 10), 0U);
}

/// A mountain path: legs of eight chords of 15 that lead up and back, 409 points. The fit of the
/// search winds at some of its turns.
TEST(Mended, ManyPointsThatAFitWindsThroughHaveElements) {
  std::vector<Vec2> points = {{0.0, 0.0}};
  double chords = 0.0;
  for (int leg = 0; leg < 51; ++leg) {
    for (int k = 0; k < 8; ++k) {
      const double way = leg % 2 == 0 ? 0.0 : kStraightAngle - 0.12;
      points.push_back(points.back() + 15.0 * unit_at(way + 0.35 * std::sin(1.7 * (8 * leg + k))));
      chords += 15.0;
    }
  }
  const auto found = fit_alignment(points, std::vector<double>(points.size(), 3.0));
  ASSERT_TRUE(found.has_value()) << found.error().what;
  EXPECT_LE(found->largest_share, 1.0);
  EXPECT_LT(found->length, 1.1 * chords);
  EXPECT_LT(found->elements.size(), 300U);
}

}  // namespace
}  // namespace obvid::alignment
