// SPDX-License-Identifier: Apache-2.0
// Roughing, levels, rest material and ways down on parts of planes and cones: where the cutter may
// go, and what it leaves, are closed forms.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include "../common/mesh_shapes.h"
#include "cutting.h"
#include "entry.h"
#include "obvid/toolpath/toolpath.h"
#include "shapes.h"

namespace obvid {
namespace {

constexpr double kLevelsTolerance = 0.02;
constexpr double kFine = 0.05;  // step of the interpreter

ToolpathOptions milling_with(CutterKind kind, double diameter, ToolpathStrategy strategy) {
  ToolpathOptions o;
  o.cutter = {kind, diameter, 0.0};
  o.tolerance = kLevelsTolerance;
  o.strategy = strategy;
  return o;
}

std::vector<Vec3> places_of_passes(const Toolpath& path) {
  std::vector<Vec3> out;
  for (const ToolpathMove& move : path.moves) {
    if (move.kind == ToolMove::kPass) out.insert(out.end(), move.points.begin(), move.points.end());
  }
  return out;
}

test::Cut cut_by(const Toolpath& path, test::Mill mill) {
  return {mill, test::tips_of(test::NcInterpreter(kFine).run(path.program.text))};
}

NurbsSurface level_plate(Vec2 low, Vec2 high, double z) {
  return test::plate({low.x, low.y, z}, {high.x, low.y, z}, {low.x, high.y, z},
                     {high.x, high.y, z});
}

/// A wall from z = 0 to `top` over the side a - b.
NurbsSurface wall_over(Vec2 a, Vec2 b, double top) {
  return test::plate({a.x, a.y, 0}, {b.x, b.y, 0}, {a.x, a.y, top}, {b.x, b.y, top});
}

// A box pocket of 30 x 20, 6 deep, in a block of 50 x 40.
TEST(Rough, ABoxPocketIsClearedOnItsLevelsUpToTheAllowance) {
  constexpr double kTop = 6.0, kAllowance = 0.2, kMillRadius = 2.0, kStepOver = 1.6;
  const SurfaceModel pocket =
      test::model_of({level_plate({10, 10}, {40, 30}, 0.0), wall_over({10, 10}, {40, 10}, kTop),
                      wall_over({10, 30}, {40, 30}, kTop), wall_over({10, 10}, {10, 30}, kTop),
                      wall_over({40, 10}, {40, 30}, kTop), level_plate({0, 0}, {50, 10}, kTop),
                      level_plate({0, 30}, {50, 40}, kTop), level_plate({0, 10}, {10, 30}, kTop),
                      level_plate({40, 10}, {50, 30}, kTop)});
  ToolpathOptions o = milling_with(CutterKind::kFlat, 2.0 * kMillRadius, ToolpathStrategy::kRough);
  o.step_over = kStepOver;
  o.step_down = 2.0;
  o.allowance = kAllowance;
  o.stock = {Vec3{0.0, 0.0, 0.25}, Vec3{50.0, 40.0, 6.25}};
  const auto path = plan(pocket, o);
  ASSERT_TRUE(path) << to_line(path.error());
  EXPECT_EQ(path->report.levels, 3U);
  EXPECT_LT(path->report.gouge.found, kLevelsTolerance);
  // the tip's field is the pocket without radius and allowance, on lines 40 / 25 apart: the 9 of
  // them from 12.8 to 25.6 and that at 27.2
  const double beside = kMillRadius + kAllowance;
  std::set<double> lines, levels;
  double length = 0.0;
  for (const ToolpathMove& move : path->moves) {
    if (move.kind != ToolMove::kPass) continue;
    const Vec3 a = move.points.front(), b = move.points.back();
    lines.insert(std::round(1e6 * a.y) / 1e6);
    levels.insert(std::round(1e6 * a.z) / 1e6);
    length += norm(b - a);
    EXPECT_EQ(a.y, b.y);
    EXPECT_NEAR(std::min(a.x, b.x), 10.0 + beside, kLevelsTolerance);
    EXPECT_NEAR(std::max(a.x, b.x), 40.0 - beside, kLevelsTolerance);
  }
  EXPECT_EQ(levels, (std::set<double>{0.25, 2.25, 4.25}));
  EXPECT_EQ(lines, (std::set<double>{12.8, 14.4, 16.0, 17.6, 19.2, 20.8, 22.4, 24.0, 25.6, 27.2}));
  EXPECT_NEAR(length, 3.0 * 10.0 * (30.0 - 2.0 * beside), 3.0 * 10.0 * kLevelsTolerance);
  // what is left: the lowest level over the floor; over the walls across the lines the allowance,
  // over those along them what the first and the last line leave
  test::Cut cut = cut_by(*path, {kMillRadius, 0.0});
  constexpr double kRasterError = 1e-3;
  for (double x = 10.5; x < 40.0; x += 1.45) {
    for (double y = 12.5; y < 27.5; y += 1.45) {
      const bool corner = x < 12.0 || x > 38.0;  // between round ends of lines something stands
      const double left = cut.left({{x, y, 0.0}, {0.0, 0.0, 1.0}}, 8.0);
      if (!corner) {
        EXPECT_NEAR(left, 0.25, kRasterError) << x << " " << y;
      }
      EXPECT_GE(left, 0.25 - kRasterError) << x << " " << y;
    }
  }
  for (const double z : {0.5, 3.0, 5.5}) {
    for (const double y : lines) {  // where a line ends the mill stands an allowance off the wall
      EXPECT_NEAR(cut.left({{10.0, y, z}, {1.0, 0.0, 0.0}}, 8.0), kAllowance, kLevelsTolerance);
      EXPECT_NEAR(cut.left({{40.0, y, z}, {-1.0, 0.0, 0.0}}, 8.0), kAllowance, kLevelsTolerance);
    }
    for (double x = 15.0; x < 36.0; x += 2.3) {
      EXPECT_NEAR(cut.left({{x, 10.0, z}, {0.0, 1.0, 0.0}}, 8.0), 0.8, kLevelsTolerance);
      EXPECT_NEAR(cut.left({{x, 30.0, z}, {0.0, -1.0, 0.0}}, 8.0), 0.8, kLevelsTolerance);
    }
  }
}

// A plane that stands up by 60 degrees, along y: levels are straight, the tip a radius beside it.
TEST(Levels, OnAPlaneTheyLieAsFarApartAsTheScallopAllows) {
  constexpr double kBall = 2.0, kLevelScallop = 0.1;
  const double slope = std::tan(std::numbers::pi / 3.0), sine = std::sin(std::numbers::pi / 3.0);
  const SurfaceModel wall =
      test::model_of({test::plate({0, 0, 0}, {0, 20, 0}, {8, 0, 8 * slope}, {8, 20, 8 * slope})});
  ToolpathOptions o = milling_with(CutterKind::kBall, 2.0 * kBall, ToolpathStrategy::kZLevel);
  o.scallop = kLevelScallop;
  const auto path = plan(wall, o);
  ASSERT_TRUE(path) << to_line(path.error());
  EXPECT_TRUE(path->not_kept.empty());
  std::set<double> levels;
  for (const Vec3 p : places_of_passes(*path)) {
    if (p.y < 0.5 || p.y > 19.5 || p.x > 5.0) continue;  // round the borders
    levels.insert(std::round(1e6 * p.z) / 1e6);
    // the ball's centre lies its radius from the plane
    const double off = (slope * p.x - (p.z + kBall)) / std::sqrt(1.0 + slope * slope);
    EXPECT_NEAR(-off, kBall, kLevelsTolerance) << p.x << " " << p.z;
  }
  ASSERT_GT(levels.size(), 5U);
  // balls a way w apart along the plane leave r - sqrt(r^2 - w^2 / 4)
  const double most =
      2.0 * std::sqrt(kBall * kBall - (kBall - kLevelScallop) * (kBall - kLevelScallop));
  double before = *levels.begin();
  for (const double z : levels) {
    EXPECT_LE((z - before) / sine, most + 1e-6);
    before = z;
  }
  const double mean = (*levels.rbegin() - *levels.begin()) / static_cast<double>(levels.size() - 1);
  EXPECT_GT(mean / sine, 0.85 * most) << "more levels than are needed";
}

TEST(Levels, SayThatThereIsNoWallWhereThereIsNone) {
  ToolpathOptions o = milling_with(CutterKind::kBall, 4.0, ToolpathStrategy::kZLevel);
  o.scallop = 0.1;
  const auto path =
      plan(test::model_of({test::plate({0, 0, 0}, {0, 20, 0}, {30, 0, 0.3}, {30, 20, 0.3})}), o);
  ASSERT_TRUE(path) << to_line(path.error());
  ASSERT_FALSE(path->not_kept.empty());
  EXPECT_EQ(path->not_kept.front().what, "no pass: nothing is a wall that levels go around");
}

// No terrace stays on a cone that is higher than what the report says, nor anywhere beside it.
TEST(Levels, OnAConeNothingStaysBeyondWhatIsTold) {
  constexpr double kBall = 2.0, kConeScallop = 0.1, kBase = 8.0;
  for (const double height : {5.0, 14.0}) {
    ToolpathOptions o = milling_with(CutterKind::kBall, 2.0 * kBall, ToolpathStrategy::kZLevel);
    o.scallop = kConeScallop;
    o.steep_deg = 20.0;
    const auto path = plan(test::model_of({shapes::cone(kBase, height)}), o);
    ASSERT_TRUE(path) << to_line(path.error());
    EXPECT_TRUE(path->not_kept.empty()) << path->not_kept.front().what;
    EXPECT_LE(path->report.scallop.found, kConeScallop);
    test::Cut cut = cut_by(*path, {kBall, kBall});
    const double side = std::hypot(kBase, height), out = height / side, up = kBase / side;
    double highest = 0.0;
    for (int k = 0; k < 4000; ++k) {  // spread by the golden ratio
      const double part = (k + 0.5) / 4000.0,
                   turn = 2.0 * std::numbers::pi * 0.6180339887498949 * k;
      const double radius = kBase * std::sqrt(part), x = std::cos(turn), y = std::sin(turn);
      const double left = cut.left(
          {{radius * x, radius * y, height * (1.0 - radius / kBase)}, {out * x, out * y, up}}, 4.0);
      highest = std::max(highest, left);
    }
    EXPECT_LE(highest, path->report.scallop.most + kFine * kFine / (8.0 * kBall) + 1e-4) << height;
    EXPECT_GT(highest, 0.5 * kConeScallop) << "it would be no test of scallops";
  }
}

// A step: level floors and an upright wall. What the larger ball left in the corner is a strip of
// its radius on both sides; the smaller one leaves no more than the scallop between the two.
TEST(Rest, InTheCornerOfAStepNoSliverStaysBetweenBothCutters) {
  constexpr double kLarge = 4.0, kSmall = 1.0, kRestScallop = 0.05, kWide = 12.0;
  const SurfaceModel step =
      test::model_of({level_plate({0, 0}, {14, kWide}, 0.0), wall_over({0, 0}, {0, kWide}, 8.0),
                      level_plate({-6, 0}, {0, kWide}, 8.0)});
  ToolpathOptions o = milling_with(CutterKind::kBall, 2.0 * kSmall, ToolpathStrategy::kZigzag);
  o.scallop = kRestScallop;
  o.angle_deg = 90.0;
  o.earlier = Cutter{CutterKind::kBall, 2.0 * kLarge, 0.0};
  const auto path = plan(step, o);
  ASSERT_TRUE(path) << to_line(path.error());
  const auto stays = [&](double x) {  // over the floor, of the larger ball in the corner
    return x < kLarge ? kLarge - std::sqrt(kLarge * kLarge - (kLarge - x) * (kLarge - x)) : 0.0;
  };
  // it comes to what it is within 1.2 tolerances of; cells are told by their middles
  double strip = kLarge;
  while (stays(strip) < 1.2 * kLevelsTolerance) strip -= 1e-4;
  EXPECT_NEAR(path->report.leftover_area, 2.0 * strip * kWide, 2.0 * kWide * path->report.spacing);
  EXPECT_LE(path->report.leftover_depth, kLarge + kLevelsTolerance);
  test::Cut cut = cut_by(*path, {kSmall, kSmall});
  double highest = 0.0;
  for (double x = kSmall; x < 14.0; x += 0.037) {
    for (const double y : {1.0, 4.7, 8.3, 11.0}) {
      const double left = cut.left({{x, y, 0.0}, {0.0, 0.0, 1.0}}, 5.0);
      highest = std::max(highest, std::min(left, stays(x)));
      // the wall at the same distance from the corner, to its edge
      if (x > 7.9) continue;
      const double beside = cut.left({{0.0, y, x}, {1.0, 0.0, 0.0}}, 5.0);
      highest = std::max(highest, std::min(beside, stays(x)));
    }
  }
  const double told = std::max(path->report.scallop.most, 1.2 * kLevelsTolerance);
  EXPECT_LE(highest, told + kFine * kFine / (8.0 * kSmall) + 1e-4);
}

TEST(Ramp, FallsEvenlyOverAPassAndIsLevelAtItsCeiling) {
  using namespace toolpath;
  const std::vector<Vec3> level{{0, 0, 1}, {3, 0, 1}, {10, 0, 1}};
  const auto ramp = ramp_over(level, {2.0, 0.1});
  ASSERT_TRUE(ramp);
  // 20 of way in at least two ways of 10 each
  EXPECT_EQ(ramp->front(), (Vec3{0, 0, 3}));
  EXPECT_EQ(ramp->back(), (Vec3{0, 0, 1}));
  double gone = 0.0;
  for (std::size_t i = 0; i < ramp->size(); ++i) {
    if (i > 0) gone += std::abs((*ramp)[i].x - (*ramp)[i - 1].x);
    EXPECT_NEAR((*ramp)[i].z, 3.0 - 0.1 * gone, 1e-12);
  }
  EXPECT_NEAR(gone, 20.0, 1e-12);
  EXPECT_NEAR(steepest_of(*ramp).fall, 0.1, 1e-12);
  // over a pass that rises by a half: back it falls by a half and a tenth
  const std::vector<Vec3> rising{{0, 0, 0}, {10, 0, 5}};
  const auto steep = ramp_over(rising, {2.0, 0.1});
  ASSERT_TRUE(steep);
  EXPECT_NEAR(steepest_of(*steep).fall, 0.6, 1e-12);
  EXPECT_EQ(steepest_of(*steep).place.x, 10.0);
  const auto held = ramp_over(rising, {2.0, 0.1, 4.0});
  ASSERT_TRUE(held);
  double highest = 0.0;
  for (const Vec3 p : *held) highest = std::max(highest, p.z);
  EXPECT_EQ(highest, 4.0);
  // 4 % of the way in each of 40 ways would be needed, and more
  EXPECT_FALSE(ramp_over({{0, 0, 0}, {1, 0, 0}}, {2.0, 0.04}));
  // 40 ways over a length of 1 lose 2: 0.05 for each length, where 0.04 would take 50 ways
  const auto flattest = flattest_ramp_over({{0, 0, 0}, {1, 0, 0}}, {2.0, 0.04});
  ASSERT_TRUE(flattest);
  EXPECT_NEAR(steepest_of(*flattest).fall, 0.05, 1e-9);
  EXPECT_EQ(flattest->size(), 41U);
}

}  // namespace
}  // namespace obvid
