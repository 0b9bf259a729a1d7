// SPDX-License-Identifier: Apache-2.0
#include "obvid/toolpath/toolpath.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "obvid/exchange/internal/gcode/nc_program.h"
#include "obvid/toolpath/internal/toolpath_gcode.h"
#include "shapes.h"

namespace obvid {
namespace {

ToolpathOptions ball(double diameter) {
  ToolpathOptions o;
  o.cutter = {CutterKind::kBall, diameter, 0.0};
  o.tolerance = 0.02;
  o.scallop = 0.1;
  return o;
}

NurbsSurface bump() {
  return test::surface_of([](double x, double y) { return 5.0 - 0.05 * (x * x + y * y); },
                          {-6.0, -6.0}, {6.0, 6.0}, 13);
}

double lowest_tip(const Toolpath& path) {
  double z = 1e9;
  for (const ToolpathMove& move : path.moves) {
    for (const Vec3 p : move.points) z = std::min(z, p.z);
  }
  return z;
}

TEST(Toolpath, RestsOnBothSidesOfAValleyThatIsNarrowerThanTheBall) {
  // sides of 45 degrees meet in y = 0: a ball of radius 3 stays (sqrt 2 - 1) 3 above the bottom
  const auto path =
      plan(test::model_of({test::plate({0, -8, 8}, {20, -8, 8}, {0, 0, 0}, {20, 0, 0}),
                           test::plate({0, 0, 0}, {20, 0, 0}, {0, 8, 8}, {20, 8, 8})}),
           [] {
             ToolpathOptions o = ball(6.0);
             o.angle_deg = 90.0;
             return o;
           }());
  ASSERT_TRUE(path) << to_line(path.error());
  double at_middle = 1e9;
  for (const ToolpathMove& move : path->moves) {
    if (move.kind != ToolMove::kPass) continue;
    for (const Vec3 p : move.points) {
      if (p.x > 4.0 && p.x < 16.0) at_middle = std::min(at_middle, p.z);
    }
  }
  EXPECT_NEAR(at_middle, 3.0 * (std::sqrt(2.0) - 1.0), 0.02);
  EXPECT_GT(path->report.lifted_points, 0U);
  // it touches 3 up each side; below by d it leaves 3 - sqrt(9 - d^2) along the normal, which is
  // within the tolerance at first; cells are told by their middles, so two borders are half a cell
  // off at most
  const double within = std::sqrt(9.0 - (3.0 - 0.02) * (3.0 - 0.02));
  EXPECT_NEAR(path->report.unreached_area, 2.0 * (3.0 - within) * 20.0,
              2.0 * 20.0 * 0.5 * path->report.spacing);
}

TEST(Toolpath, AWallUnderARoofIsReportedAsHidden) {
  const auto path =
      plan(test::model_of({test::plate({0, 0, 5}, {10, 0, 5}, {0, 10, 5}, {10, 10, 5}),
                           test::plate({2, 2, 0}, {8, 2, 0}, {2, 8, 0}, {8, 8, 0})}),
           ball(4.0));
  ASSERT_TRUE(path) << to_line(path.error());
  EXPECT_NEAR(path->report.surface_area, 136.0, 1e-9);
  EXPECT_NEAR(path->report.hidden_area, 36.0, 1e-6);
  EXPECT_FALSE(path->warnings.empty());
}

TEST(Toolpath, AFlatMillGoesUpAVerticalWallWithoutCuttingIntoIt) {
  ToolpathOptions o = ball(4.0);
  o.cutter = {CutterKind::kFlat, 4.0, 0.0};
  const auto path =
      plan(test::model_of({test::plate({0, 0, 0}, {10, 0, 0}, {0, 10, 0}, {10, 10, 0}),
                           test::plate({10, 0, 0}, {10, 10, 0}, {10, 0, 6}, {10, 10, 6}),
                           test::plate({10, 0, 6}, {20, 0, 6}, {10, 10, 6}, {20, 10, 6})}),
           o);
  ASSERT_TRUE(path) << to_line(path.error());
  EXPECT_NEAR(lowest_tip(*path), 0.0, o.tolerance);
  for (const ToolpathMove& move : path->moves) {
    for (const Vec3 p : move.points) {
      if (p.x > 8.0 + o.tolerance && p.y > 0.0 && p.y < 10.0) {
        EXPECT_GE(p.z, 6.0 - o.tolerance);
      }
    }
  }
}

TEST(Toolpath, TheProgramDoesNotDependOnTheNumberOfThreads) {
  const auto wave = [](double x, double y) { return std::sin(x / 3.0) * std::cos(y / 4.0); };
  const SurfaceModel model = test::model_of({test::surface_of(wave, {0, 0}, {12, 9}, 13)});
  for (const auto strategy :
       {ToolpathStrategy::kZigzag, ToolpathStrategy::kIsoparametric,
        ToolpathStrategy::kConstantScallop, ToolpathStrategy::kZLevel, ToolpathStrategy::kRough}) {
    ToolpathOptions o = ball(3.0);
    o.strategy = strategy;
    if (strategy == ToolpathStrategy::kZLevel) o.steep_deg = 5.0;
    if (strategy == ToolpathStrategy::kRough) {
      o.scallop.reset();
      o.step_over = 1.0;
      o.entry = ToolpathEntry::kHelix;
    }
    o.threads = 1;
    const auto alone = plan(model, o);
    ASSERT_TRUE(alone) << to_line(alone.error());
    EXPECT_GT(alone->report.passes, 1U);
    o.threads = 3;
    const auto shared = plan(model, o);
    ASSERT_TRUE(shared) << to_line(shared.error());
    EXPECT_EQ(alone->program.text, shared->program.text);
    EXPECT_EQ(alone->report.scallop.most, shared->report.scallop.most);
    EXPECT_EQ(alone->report.gouge.most, shared->report.gouge.most);
  }
}

TEST(Toolpath, RefusesSizesThatMakeNoSense) {
  const auto model = test::model_of({test::plate({0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {9, 9, 0})});
  const auto code = [&](auto&& change) {
    ToolpathOptions o = ball(6.0);
    change(o);
    const auto path = plan(model, o);
    return path ? 0 : static_cast<int>(path.error().code);
  };
  EXPECT_EQ(code([](ToolpathOptions&) {}), 0);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.cutter.diameter = 0.0; }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.cutter = {CutterKind::kBullNose, 6.0, 3.0}; }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.tolerance = std::nan(""); }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.feed = -1.0; }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.scallop.reset(); }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.safe_z = -1.0; }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.spindle = 0.5; }), 203);  // would be printed as S0
  EXPECT_EQ(code([](ToolpathOptions& o) { o.spindle = 0.6; }), 0);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.allowance = -0.1; }), 203);
  EXPECT_EQ(code([](ToolpathOptions& o) { o.most_points = 10; }), 502);
  EXPECT_FALSE(plan(SurfaceModel{}, ball(6.0)));
}

/// Lengths are those of the program as it is printed: of the chords of its arcs, taken fine.
TEST(Toolpath, LengthsAreThoseOfThePrintedProgram) {
  const auto model = test::model_of({bump()});
  for (const char* unit : {"mm", "cm"}) {
    auto here = model;
    here.units = unit;
    const double scale = std::string(unit) == "cm" ? 10.0 : 1.0;
    const auto path = plan(here, ball(4.0));
    ASSERT_TRUE(path) << path.error().what;
    const auto read = exchange::read_program(path->program.text, 1e-8);
    ASSERT_TRUE(read);
    double feed = 0.0, rapid = 0.0;
    for (const exchange::NcMotion& motion : read->motions) {
      for (std::size_t i = 1; i < motion.points.size(); ++i) {
        (motion.rapid ? rapid : feed) += norm(motion.points[i] - motion.points[i - 1]) / scale;
      }
    }
    EXPECT_GT(path->program.arc_blocks, 0u);
    EXPECT_NEAR(path->report.cutting_length + path->report.plunge_length, feed, 1e-5 * feed)
        << unit;
    EXPECT_NEAR(path->report.rapid_length, rapid, 1e-6 * rapid) << unit;
  }
}

TEST(ToolpathGcode, InchesAndConvertedUnitsAndDecimalsTooFew) {
  auto model = test::model_of({test::plate({0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0})});
  ToolpathOptions o = ball(0.25);
  o.tolerance = 0.001;
  o.scallop = 0.005;
  model.units = "in";
  auto path = plan(model, o);
  ASSERT_TRUE(path);
  EXPECT_NE(toolpath_gcode(*path)->text.find("G20 "), std::string::npos);
  path->units = "mil";
  EXPECT_NE(toolpath_gcode(*path)->text.find("(converted from mil)"), std::string::npos);
  model.units = "px";
  EXPECT_EQ(plan(model, o).error().code, ErrorCode::kBadOption);
  path->units = "cm";
  EXPECT_NE(toolpath_gcode(*path)->text.find("(converted from cm)"), std::string::npos);
  ToolpathGcodeOptions few;
  few.decimals = 1;
  const auto refused = toolpath_gcode(*path, few);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kToleranceNotReached);
}

}  // namespace
}  // namespace obvid
