// SPDX-License-Identifier: Apache-2.0
// Ways down: angles, lengths and turns of ramps and helices by their closed forms.
#include "entry.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obvid::toolpath {
namespace {

constexpr double kFull = 2.0 * std::numbers::pi;

double length_of_way(const std::vector<Vec3>& way) {
  double sum = 0.0;
  for (std::size_t i = 1; i < way.size(); ++i) sum += norm(way[i] - way[i - 1]);
  return sum;
}

std::vector<Vec3> level_ring(double radius, double within) {
  std::vector<Vec3> out;
  for (const Vec2 p : circle_from({radius, 0.0}, {0.0, 1.0}, 1.0, radius, within))
    out.push_back({p.x, p.y, -4.0});
  return out;
}

TEST(WaysDown, HaveTheAngleThatIsAsked) {
  ToolpathOptions o;
  EXPECT_FALSE(fall_of(o)) << "finishing goes straight down";
  o.ramp_deg = 30.0;
  EXPECT_NEAR(*fall_of(o), 1.0 / std::sqrt(3.0), 1e-15);
  o.ramp_deg.reset();
  o.strategy = ToolpathStrategy::kRough;
  EXPECT_EQ(asked_deg(o), 5.0);
  EXPECT_NEAR(*fall_of(o), 0.087488663525924, 1e-14);  // tan 5 degrees
}

// A helix of the radius r that loses h in n turns is sqrt((2 pi r n)^2 + h^2) long; on the corners
// of a circle 2 pi r becomes 2 m r sin(pi / m).
TEST(Helices, HaveTheLengthAndAngleOfTheirTurns) {
  constexpr double kAround = 2.7, kHeight = 6.0;
  const std::vector<Vec3> ring = level_ring(kAround, 1e-3);
  const auto corners = static_cast<double>(ring.size() - 1);
  const double once = 2.0 * corners * kAround * std::sin(0.5 * kFull / corners);
  for (const double degrees : {1.0, 5.0, 15.0}) {
    SCOPED_TRACE(degrees);
    const double fall = std::tan(degrees * kFull / 360.0);
    const auto helix = helix_over(ring, {kHeight, fall}, 1.0);
    ASSERT_TRUE(helix);
    // the fewest whole turns that are no steeper
    EXPECT_LE(kHeight / (once * helix->turns), fall * (1.0 + 1e-12));
    EXPECT_GT(kHeight / (once * (helix->turns - 1.0)), fall);
    EXPECT_NEAR(length_of_way(helix->points), std::hypot(once * helix->turns, kHeight), 1e-9);
    EXPECT_NEAR(steepest_of(helix->points).fall, kHeight / (once * helix->turns), 1e-12);
    EXPECT_NEAR(helix->points.front().z, -4.0 + kHeight, 1e-12);
    EXPECT_EQ(helix->points.back(), ring.back());
    EXPECT_EQ(static_cast<double>(helix->points.size()), helix->turns * corners + 1.0);
  }
  EXPECT_EQ(helix_over(ring, {kHeight, 10.0}, 3.0)->turns, 3.0);
  EXPECT_FALSE(helix_over(ring, {kHeight, kHeight / (101.0 * once)}, 1.0));
  EXPECT_TRUE(helix_over(ring, {kHeight, kHeight / (99.5 * once)}, 1.0));
}

// Chords of m corners are r (1 - cos(pi / m)) inside of their circle.
TEST(Circles, LeaveAlongTheWayAndHaveNoMoreCornersThanChordsNeed) {
  const Vec2 start{3.0, -2.0}, along{0.6, 0.8};
  for (const double side : {1.0, -1.0}) {
    for (const double within : {0.05, 0.001}) {
      constexpr double kAround = 4.0;
      const auto ring = circle_from(start, along, side, kAround, within);
      const Vec2 centre = start + side * kAround * left_normal(along);
      const auto corners = static_cast<double>(ring.size() - 1);
      EXPECT_EQ(ring.front(), start);
      EXPECT_EQ(ring.back(), start);
      for (const Vec2 p : ring) EXPECT_NEAR(norm(p - centre), kAround, 1e-12);
      EXPECT_LE(kAround * (1.0 - std::cos(0.5 * kFull / corners)), within * (1.0 + 1e-9));
      EXPECT_GT(kAround * (1.0 - std::cos(0.5 * kFull / (corners - 1.0))), within);
      // it sets out to the front, and turns to its side by half a corner's angle first
      const Vec2 first = ring[1] - ring[0];
      EXPECT_NEAR(std::atan2(cross(along, first), dot(along, first)), side * 0.5 * kFull / corners,
                  1e-12);
    }
  }
}

// n ways of the length l lose n l tan a.
TEST(Ramps, HaveAsManyWaysAsTheirAngleNeeds) {
  constexpr double kDown = 3.0, kFall = 0.1;  // 30 of way
  EXPECT_EQ(legs_of_ramp(40.0, kDown, kFall), 2.0);
  EXPECT_EQ(legs_of_ramp(15.0, kDown, kFall), 2.0);
  EXPECT_EQ(legs_of_ramp(14.9, kDown, kFall), 4.0);
  EXPECT_EQ(legs_of_ramp(7.4, kDown, kFall), 6.0);
  EXPECT_FALSE(legs_of_ramp(0.7, kDown, kFall));  // 44
  for (const double length : {40.0, 9.0, 2.0}) {
    const auto ramp = ramp_over({{0, 0, 0}, {length, 0, 0}}, {kDown, kFall});
    ASSERT_TRUE(ramp);
    // 3 down at an angle a are 3 / sin a of way
    EXPECT_NEAR(length_of_way(*ramp), kDown / std::sin(std::atan(kFall)), 1e-9);
    EXPECT_NEAR(steepest_of(*ramp).fall, kFall, 1e-12);
  }
}

}  // namespace
}  // namespace obvid::toolpath
