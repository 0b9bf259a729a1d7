// SPDX-License-Identifier: Apache-2.0
// Open borders, closed bodies and trims: what passes do there, and what the report says of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "../common/angles.h"
#include "obvid/toolpath/toolpath.h"
#include "shapes.h"

namespace obvid {
namespace {

ToolpathOptions ball_of(double diameter) {
  ToolpathOptions o;
  o.cutter = {CutterKind::kBall, diameter, 0.0};
  o.tolerance = 0.02;
  o.scallop = 0.1;
  return o;
}

template <class Look>
void for_passes(const Toolpath& path, const Look& look) {
  std::size_t count = 0;
  for (const ToolpathMove& move : path.moves) {
    if (move.kind != ToolMove::kPass && move.kind != ToolMove::kLink) continue;
    for (const Vec3 p : move.points) look(p);
    count += move.points.size();
  }
  EXPECT_GT(count, 20U);
}

/// z = x over 10 x 10: a ball of radius 3 touches it from an axis 3 / sqrt 2 farther down, its tip
/// 3 (1 - 1 / sqrt 2) below the contact.
TEST(ToolpathBorders, PassesDoNotRollDownOverThem) {
  const double root = std::sqrt(0.5), aside = 3.0 * root, below = 3.0 * (1.0 - root);
  for (const auto strategy : {ToolpathStrategy::kZigzag, ToolpathStrategy::kConstantScallop}) {
    for (const double angle : {0.0, 90.0, 30.0}) {
      ToolpathOptions o = ball_of(6.0);
      o.strategy = strategy;
      o.angle_deg = angle;
      const auto path =
          plan(test::model_of({test::plate({0, 0, 0}, {10, 0, 10}, {0, 10, 0}, {10, 10, 10})}), o);
      ASSERT_TRUE(path) << to_line(path.error());
      const double step = std::sqrt(8.0 * 0.1 * 3.0);
      for_passes(*path, [&](Vec3 p) {
        EXPECT_GE(p.z, -below - o.tolerance) << angle;  // the lower border is at z = 0
        EXPECT_LE(p.x, 10.0 + step + o.tolerance);
        EXPECT_GE(p.x, -aside - step - o.tolerance);
        // beside the plate no lower than on it: on the plane itself the tip is at x + aside - below
        const double contact = std::min(p.x + aside, 10.0);
        EXPECT_GE(p.z, std::max(0.0, contact) - below - 2.0 * o.tolerance) << p.x << " " << p.y;
      });
      if (angle == 0.0) {  // across two of the borders: passes end there
        for_passes(*path, [&](Vec3 p) {
          if (strategy != ToolpathStrategy::kZigzag || p.y < 1.0 || p.y > 9.0) return;
          EXPECT_LE(p.x, 10.0 + 2.0 * o.tolerance);
          EXPECT_GE(p.x, -aside - 2.0 * o.tolerance);
        });
      }
      EXPECT_LE(path->report.gouge.found, o.tolerance);
      EXPECT_LE(path->report.scallop.found, 0.1) << angle;
      EXPECT_EQ(path->report.unreached_area, 0.0);
    }
  }
}

/// A ring of radius 20 with a tube of radius 6, standing: about x.
double in_ring(Vec3 p) {
  const double from_axis = std::hypot(p.y, p.z) - 20.0;
  return from_axis * from_axis + p.x * p.x - 36.0;
}

/// By rays, in steps that nothing of the ring hides between; areas of places from the closed form.
double hidden_of_ring() {
  constexpr int kRound = 240, kTube = 120, kSteps = 600;
  double hidden = 0.0;
  for (int i = 0; i < kRound; ++i) {
    for (int j = 0; j < kTube; ++j) {
      const double a = 2 * kPi * (i + 0.5) / kRound, b = 2 * kPi * (j + 0.5) / kTube;
      const double r = 20.0 + 6.0 * std::cos(b);
      const Vec3 p{6.0 * std::sin(b), r * std::cos(a), r * std::sin(a)};
      bool under = false;
      for (int k = 1; k < kSteps && !under; ++k) under = in_ring(p + Vec3{0, 0, 0.1 * k}) < -1e-9;
      if (under) hidden += r * 6.0 * (2 * kPi / kRound) * (2 * kPi / kTube);
    }
  }
  return hidden;
}

TEST(ToolpathClosed, WhatIsUnderTheBodyItselfIsHiddenAndNotTooNarrow) {
  const Vec3 outermost{6.0, 20.0, 0.0};
  const RevolutionSurface turned{
      arc_about(outermost, {0, 20, 0}, {0, 0, 1}, 2 * kPi), {0, 0, 0}, {1, 0, 0}, 2 * kPi};
  const auto ring = to_nurbs(turned, 1e-9);
  ASSERT_TRUE(ring);
  ToolpathOptions o = ball_of(6.0);
  o.scallop = 0.2;
  const auto path = plan(test::model_of({ring->surface}), o);
  ASSERT_TRUE(path) << to_line(path.error());
  const ToolpathReport& r = path->report;
  EXPECT_NEAR(r.surface_area, 4 * kPi * kPi * 20.0 * 6.0, 0.01 * r.surface_area);
  EXPECT_NEAR(r.hidden_area, hidden_of_ring(), 0.015 * r.surface_area);
  EXPECT_GT(r.hidden_places, 0U);
  EXPECT_LT(r.hidden_place.z, -25.0);  // the lowest is at the bottom
  EXPECT_FALSE(path->hidden_strokes.empty());
  // the hole is wide, and the tube bulges: the ball comes everywhere that is seen from above
  EXPECT_EQ(r.unreached_area, 0.0);
  EXPECT_EQ(r.unreached_places, 0U);
}

/// A plate 20 wide with a round hole of radius 6, and a floor 4 under it.
SurfaceModel holed() {
  SurfaceModel model =
      test::model_of({test::plate({0, 0, 0}, {20, 0, 0}, {0, 20, 0}, {20, 20, 0}),
                      test::plate({0, 0, -4}, {20, 0, -4}, {0, 20, -4}, {20, 20, -4})});
  const double w = std::sqrt(0.5), r = 0.3;  // of the parameters
  NurbsCurve circle{2,
                    {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
                    {{r, 0}, {r, -r}, {0, -r}, {-r, -r}, {-r, 0}, {-r, r}, {0, r}, {r, r}, {r, 0}},
                    {1, w, 1, w, 1, w, 1, w, 1}};
  for (Vec2& p : circle.points) p = p + Vec2{0.5, 0.5};
  const auto line = [](Vec2 a, Vec2 b) { return NurbsCurve{1, {0, 0, 1, 1}, {a, b}, {}}; };
  model.patches[0].trims = {
      {{line({0, 0}, {1, 0}), line({1, 0}, {1, 1}), line({1, 1}, {0, 1}), line({0, 1}, {0, 0})}},
      {{circle}}};
  return model;
}

TEST(ToolpathTrims, WhatIsTrimmedAwayIsNotThere) {
  const SurfaceModel model = holed();
  ASSERT_TRUE(check(model.patches[0]));
  const double hole = 36.0 * kPi;
  for (const auto strategy : {ToolpathStrategy::kZigzag, ToolpathStrategy::kIsoparametric}) {
    ToolpathOptions o = ball_of(4.0);
    o.strategy = strategy;
    const auto path = plan(model, o);
    ASSERT_TRUE(path) << to_line(path.error());
    double lowest = 0.0;
    for_passes(*path, [&](Vec3 p) {
      lowest = std::min(lowest, p.z);
      // through the hole, clear of its border by the ball's radius
      const double aside = std::hypot(p.x - 10.0, p.y - 10.0);
      EXPECT_TRUE(p.z >= -2.1 || aside <= 4.0 + 2.0 * o.tolerance) << p.z << " " << aside;
    });
    EXPECT_NEAR(lowest, -4.0, o.tolerance);
    const double cell = path->report.spacing;
    const double round_border = 2.0 * kPi * 6.0 * cell;
    EXPECT_NEAR(path->report.surface_area, 800.0 - hole, round_border);
    EXPECT_NEAR(path->report.hidden_area, 400.0 - hole, round_border);
    EXPECT_LE(path->report.gouge.found, o.tolerance);
  }
}

/// A plate over a part of a floor: the ball goes up beside it from floor to plate, straight.
TEST(ToolpathBorders, ArcsDoNotBulgeWhereThePassGoesStraightUp) {
  const auto path =
      plan(test::model_of({test::plate({0, 0, 0}, {10, 0, 0}, {0, 20, 0}, {10, 20, 0}),
                           test::plate({0, 0, -4}, {20, 0, -4}, {0, 20, -4}, {20, 20, -4})}),
           ball_of(4.0));
  ASSERT_TRUE(path) << to_line(path.error());
  EXPECT_LE(path->report.gouge.found, 0.02);
  EXPECT_NE(path->program.text.find("G3"), std::string::npos);  // around the edge
}

}  // namespace
}  // namespace obvid
