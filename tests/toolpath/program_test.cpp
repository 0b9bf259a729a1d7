// SPDX-License-Identifier: Apache-2.0
// Blocks of programs: what is printed stands for the points it was made of, and the reader sees
// what controllers see.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "biarc.h"
#include "moves.h"
#include "obvid/core/error.h"
#include "obvid/exchange/internal/gcode/nc_program.h"
#include "program_text.h"
#include "steps.h"

namespace obvid::toolpath {
namespace {

constexpr double kWithin = 1e-3;
constexpr exchange::MotionRules kMachine{3000.0, 500.0, 0.01};

exchange::NcProgram read_or_fail(const std::string& text) {
  auto program = exchange::read_program(text, kWithin);
  EXPECT_TRUE(program) << text << (program ? "" : to_line(program.error()));
  return program ? std::move(*program) : exchange::NcProgram{};
}

/// Refused as what no controller understands; the block's number is told.
void expect_refused(const std::string& text, std::size_t block) {
  const auto program = exchange::read_program(text, kWithin);
  ASSERT_FALSE(program) << text;
  EXPECT_EQ(program.error().code, ErrorCode::kInternal) << text;
  EXPECT_NE(to_line(program.error()).find("block " + std::to_string(block)), std::string::npos)
      << to_line(program.error());
}

TEST(NcReader, KnowsModalWordsCommentsAndInches) {
  const exchange::NcProgram program = read_or_fail(
      "(a part)\nG20 G90 G94\nG0 Z1.5\nG0 X1 Y2\nG1 Z-.25 F10\nX3\n\nG0 Z1.5 (up)\nM2\n");
  EXPECT_TRUE(program.inches);
  ASSERT_EQ(program.motions.size(), 4U);
  EXPECT_TRUE(program.motions[0].rapid);
  EXPECT_EQ(program.motions[0].points.back(), (Vec3{1.0, 2.0, 1.5}));
  EXPECT_FALSE(program.motions[1].rapid);
  EXPECT_EQ(program.motions[1].points.back(), (Vec3{1.0, 2.0, -0.25}));
  // a block without a G moves like the last one
  EXPECT_FALSE(program.motions[2].rapid);
  EXPECT_EQ(program.motions[2].points.front(), (Vec3{1.0, 2.0, -0.25}));
  EXPECT_EQ(program.motions[2].points.back(), (Vec3{3.0, 2.0, -0.25}));
  EXPECT_TRUE(program.motions[3].rapid);
}

TEST(NcReader, RefusesWhatControllersRefuse) {
  expect_refused("G21\nG1 X1 Y1 Z1\n", 2);                         // from nowhere
  expect_refused("G0 Z1\nG0 X0 Y0\nG7\n", 3);                      // unknown G
  expect_refused("G0 Z1\nG0 X0 Y0\nQ1\n", 3);                      // unknown word
  expect_refused("G0 Z1\nG0 X0 Y0\nG1 X\n", 3);                    // no number
  expect_refused("G0 Z1\nG0 X0 Y0\nG1 X1 (up\n", 3);               // no end
  expect_refused("G0 Z1\nG0 X0 Y0\nG17\nG2 X1 Y0\n", 4);           // no centre
  expect_refused("G0 Z1\nG0 X0 Y0\nG17\nG3 X2 Y0 I1.01 J0\n", 4);  // two radii
  expect_refused("G0 Z1\nG0 X0 Y0\nG1 X1e999\n", 3);               // no double
}

struct ArcPlane {
  const char* code;
  const char* words;  ///< a quarter, from 1 0 to 0 1 about 0 0, in axes of the plane
  std::size_t first, second;
};

// ISO 6983 and LinuxCNC's manual: G3 turns counter-clockwise as seen from the positive end of the
// axis that stands upright on the plane, so X to Y (G17), Z to X (G18), Y to Z (G19).
TEST(NcReader, TurnsArcsInAllThreePlanesTheRightWay) {
  const auto axis = [](Vec3 p, std::size_t k) { return k == 0 ? p.x : k == 1 ? p.y : p.z; };
  for (const ArcPlane& plane : {ArcPlane{"G17\nG1 X1 Y0 Z0\n", "X0 Y1 I-1 J0", 0, 1},
                                ArcPlane{"G18\nG1 Z1 X0 Y0\n", "Z0 X1 K-1 I0", 2, 0},
                                ArcPlane{"G19\nG1 Y1 Z0 X0\n", "Y0 Z1 J-1 K0", 1, 2}}) {
    for (const bool left : {true, false}) {
      const std::string text = std::string("G0 Z5\nG0 X0 Y0\n") + plane.code +
                               (left ? "G3 " : "G2 ") + plane.words + "\n";
      const exchange::NcProgram program = read_or_fail(text);
      ASSERT_FALSE(program.motions.empty());
      const exchange::NcMotion& arc = program.motions.back();
      EXPECT_TRUE(arc.arc);
      double turned = 0.0;
      for (std::size_t i = 0; i < arc.points.size(); ++i) {
        const double a = axis(arc.points[i], plane.first), b = axis(arc.points[i], plane.second);
        EXPECT_NEAR(std::hypot(a, b), 1.0, 1e-12) << text;
        if (i == 0) continue;
        const double a0 = axis(arc.points[i - 1], plane.first);
        const double b0 = axis(arc.points[i - 1], plane.second);
        const double step = std::atan2(a0 * b - b0 * a, a0 * a + b0 * b);
        turned += step;
        EXPECT_LE(1.0 - std::cos(0.5 * step), kWithin * (1.0 + 1e-9)) << text;
      }
      const double quarter = 0.5 * std::numbers::pi;
      EXPECT_NEAR(turned, left ? quarter : quarter - 2.0 * std::numbers::pi, 1e-9) << text;
    }
  }
}

TEST(NcReader, ReadsHelicesWithEvenHeights) {
  const exchange::NcProgram program =
      read_or_fail("G0 Z5\nG0 X1 Y0\nG1 Z0\nG17\nG3 X-1 Y0 Z-2 I-1 J0\n");
  const exchange::NcMotion& arc = program.motions.back();
  for (const Vec3 p : arc.points) {
    EXPECT_NEAR(p.z, -2.0 * std::atan2(p.y, p.x) / std::numbers::pi, 1e-12);
  }
}

TEST(ProgramText, RoundsPlacesOnceSoThatNothingDrifts) {
  ProgramText text(2, kWithin, false, kMachine);
  text.rapid({{0.0, 0.0, 5.0}});
  std::vector<Vec3> steps;
  for (int i = 0; i <= 1000; ++i) {
    const double x = i / 300.0;
    steps.push_back({x, x * x, 0.0});  // bent, so that points stay
  }
  text.straight(steps, 100.0);
  const exchange::NcProgram program = read_or_fail(text.text());
  EXPECT_EQ(program.motions.back().points.back(), (Vec3{3.33, 11.11, 0.0}));
  EXPECT_EQ(text.text().find("F100.000"), text.text().rfind("F100.000")) << "one feed is enough";
}

TEST(ProgramText, PutsPointsOfALineIntoOneBlock) {
  ProgramText text(3, kWithin, true, kMachine);
  text.rapid({{0.0, 0.0, 5.0}});
  const std::size_t before = text.blocks();
  std::vector<Vec3> line;
  for (int i = 0; i <= 50; ++i) line.push_back({0.1 * i, 0.0, 0.2 * i});
  text.pass(line, PassPlane::kXz, 50.0);
  EXPECT_EQ(text.blocks() - before, 2U);  // down to its start, and along
  EXPECT_EQ(text.arcs(), 0U);
}

TEST(ProgramText, PrintsArcsThatLeadAlongThePoints) {
  constexpr double kRadius = 20.0;
  for (const PassPlane plane : {PassPlane::kXz, PassPlane::kYz}) {
    for (const bool up : {true, false}) {
      ProgramText text(4, kWithin, true, kMachine);
      text.rapid({{0.0, 0.0, 30.0}});
      std::vector<Vec3> points;
      for (int i = 0; i <= 200; ++i) {
        const double w = std::numbers::pi * (0.2 + 0.6 * i / 200.0);
        const double a = -kRadius * std::cos(w), z = (up ? 1.0 : -1.0) * kRadius * std::sin(w);
        points.push_back(plane == PassPlane::kXz ? Vec3{a, 7.0, z} : Vec3{7.0, a, z});
      }
      text.pass(points, plane, 50.0);
      text.level_plane();
      EXPECT_GE(text.arcs(), 1U);
      EXPECT_LE(text.arcs(), 4U);
      EXPECT_NE(text.text().find(plane == PassPlane::kXz ? "G18" : "G19"), std::string::npos);
      const exchange::NcProgram program = read_or_fail(text.text());
      double turned = 0.0;
      for (const exchange::NcMotion& motion : program.motions) {
        if (!motion.arc) continue;
        for (std::size_t i = 0; i < motion.points.size(); ++i) {
          const Vec3 p = motion.points[i];
          const double a = plane == PassPlane::kXz ? p.x : p.y;
          EXPECT_NEAR(std::hypot(a, p.z), kRadius, 2.0 * kWithin);
          if (i == 0) continue;
          const Vec3 q = motion.points[i - 1];
          const double a0 = plane == PassPlane::kXz ? q.x : q.y;
          turned += std::abs(std::atan2(a0 * p.z - q.z * a, a0 * a + q.z * p.z));
        }
      }
      EXPECT_NEAR(turned, 0.6 * std::numbers::pi, 1e-3) << "the short way round";
    }
  }
}

TEST(Biarc, MeetsAlongBothTangents) {
  // both tangents lie on one circle: the joint does, too
  const auto on_circle = [](double w) { return Vec2{std::cos(w), std::sin(w)}; };
  const auto along = [](double w) { return Vec2{-std::sin(w), std::cos(w)}; };
  const auto joint = biarc_joint(on_circle(0.1), along(0.1), on_circle(1.3), along(1.3));
  ASSERT_TRUE(joint);
  EXPECT_NEAR(norm(*joint), 1.0, 1e-14);
  EXPECT_NEAR(std::atan2(joint->y, joint->x), 0.7, 1e-14);
  const Vec2 middle = arc_middle(on_circle(0.1), along(0.1), on_circle(1.3));
  EXPECT_NEAR(norm(middle), 1.0, 1e-14);
  // an S: point symmetric, the joint is its centre
  const auto s = biarc_joint({0, 0}, {1, 0}, {4, 2}, {1, 0});
  ASSERT_TRUE(s);
  EXPECT_NEAR(norm(*s - Vec2{2, 1}), 0.0, 1e-14);
  EXPECT_FALSE(biarc_joint({0, 0}, {1, 0}, {0, 0}, {1, 0}));
  EXPECT_FALSE(biarc_joint({0, 0}, {-1, 0}, {4, 0}, {-1, 0})) << "turns round";
}

TEST(Thinned, KeepsEndsAndStaysWithin) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 400; ++i) {
    const double w = 2.0 * std::numbers::pi * i / 400.0;
    points.push_back({10.0 * std::cos(w), 10.0 * std::sin(w), 0.0});
  }
  for (const double within : {0.5, 0.05, 0.005}) {
    const auto fewer = thinned(points, within);
    EXPECT_EQ(fewer.front(), points.front());
    EXPECT_EQ(fewer.back(), points.back());
    // chords of a circle with this sagitta: no fewer are enough, nor are twice as many needed
    const double turn = 2.0 * std::acos(1.0 - within / 10.0);
    const double least = std::ceil(2.0 * std::numbers::pi / turn - 1e-9);
    EXPECT_GE(static_cast<double>(fewer.size() - 1), least);
    EXPECT_LE(static_cast<double>(fewer.size() - 1), 2.0 * least);
  }
  EXPECT_EQ(thinned({{0, 0, 0}, {1, 0, 0}}, 1.0).size(), 2U);
  EXPECT_NEAR(off_chord({{0, 0, 0}, {1, 3, 4}, {2, 0, 0}}, 0, 2), 5.0, 1e-15);
  EXPECT_NEAR(off_chord({{0, 0, 0}, {5, 0, 0}, {2, 0, 0}}, 0, 2), 3.0, 1e-15) << "beyond the end";
  EXPECT_NEAR(off_chord({{1, 1, 1}, {1, 1, 3}, {1, 1, 1}}, 0, 2), 2.0, 1e-15) << "no chord";
}

// The cusp between two passes of a ball of radius R on a level place, s apart, is
// h = R - sqrt(R^2 - s^2 / 4) high.
TEST(StepRule, LeavesNoMoreThanTheScallopOnLevelPlaces) {
  for (const double radius : {0.5, 3.0, 25.0}) {
    for (const double scallop : {1e-4, 1e-3, 1e-2}) {
      ToolpathOptions options;
      options.cutter = {CutterKind::kBall, 2.0 * radius, 0.0};
      options.scallop = scallop * radius;
      const StepRule rule({radius, radius}, options);
      const double s = rule.level();
      const double cusp = radius - std::sqrt(radius * radius - 0.25 * s * s);
      EXPECT_NEAR(cusp, kScallopAim * *options.scallop, 1e-9 * radius);
      EXPECT_LT(rule.floor(), s);
      const StepForm form = rule.level_form();
      for (const double w : {0.0, 0.4, 2.0}) {
        EXPECT_NEAR(form.along({std::cos(w), std::sin(w)}), s, 1e-12 * s);
      }
    }
  }
}

TEST(StepRule, TakesTheSmallerOfScallopAndStep) {
  ToolpathOptions options;
  options.scallop = 0.01;
  options.step_over = 0.05;
  EXPECT_EQ(StepRule({3.0, 3.0}, options).level(), 0.05);
  options.step_over = 100.0;
  EXPECT_LT(StepRule({3.0, 3.0}, options).level(), 1.0);
  // flat mills overlap, whatever is asked for
  options.scallop.reset();
  EXPECT_LT(StepRule({3.0, 0.0}, options).level(), 6.0);
}

TEST(StepForm, MeasuresStepsAcrossASlope) {
  const StepForm form{1.0 / 4.0, 0.0, 1.0 / 9.0};
  EXPECT_EQ(form.along({1.0, 0.0}), 2.0);
  EXPECT_EQ(form.along({0.0, 1.0}), 3.0);
  const double r = std::sqrt(0.5);
  EXPECT_NEAR(form.along({r, r}), 1.0 / std::sqrt(0.5 * (0.25 + 1.0 / 9.0)), 1e-15);
}

}  // namespace
}  // namespace obvid::toolpath
