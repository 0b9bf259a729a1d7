// SPDX-License-Identifier: Apache-2.0
// What a ball leaves between its passes on planes, cylinders and spheres, and how far apart the
// passes may lie for it: triangles of centres.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "obvid/toolpath/toolpath.h"
#include "shapes.h"
#include "steps.h"

namespace obvid::toolpath {
namespace {

constexpr double kBallRadius = 3.0;
/// Parts reach so far from their highest (hollows: lowest) place.
constexpr double kReach = 50.0 * std::numbers::pi / 180.0;

/// A ball rests on a body of the radius R (less than 0: a hollow) with its centre R + r from the
/// middle. Centres that are seen from there under the angle `apart` leave, half way, what the third
/// side of the triangle with sides R + r and r says.
double left_between(double body, double apart) {
  const double away = std::abs(body + kBallRadius), half = 0.5 * apart;
  const double beside = std::sqrt(kBallRadius * kBallRadius - std::pow(away * std::sin(half), 2));
  return body > 0.0 ? away * std::cos(half) - beside - body
                    : -body - (away * std::cos(half) + beside);
}

/// Round about the x axis: a bulge below its highest line, or a hollow over its lowest one.
SurfaceModel pipe(double body, double length) {
  const double up = body > 0.0 ? 1.0 : -1.0, r = std::abs(body);
  NurbsSurface s;
  s.degree_u = 1;
  s.degree_v = 2;
  s.knots_u = {0, 0, 1, 1};
  s.knots_v = {0, 0, 0, 1, 1, 1};
  const double y = r * std::sin(kReach), z = r * std::cos(kReach), c = std::cos(kReach);
  for (const Vec2 at : {Vec2{-y, z}, Vec2{0.0, r / c}, Vec2{y, z}}) {
    for (const double x : {0.0, length}) s.points.push_back({x, at.x, up * at.y});
  }
  s.weights = {1, 1, c, c, 1, 1};
  return test::model_of({s});
}

/// A cap of a sphere around the origin, its pole at the top.
SurfaceModel cap(double radius) {
  RevolutionSurface turned;
  const double c = std::cos(0.5 * kReach), out = radius * std::tan(0.5 * kReach);
  turned.profile.degree = 2;
  turned.profile.knots = {0, 0, 0, 1, 1, 1};
  turned.profile.points = {
      {0, 0, radius}, {out, 0, radius}, {radius * std::sin(kReach), 0, radius * std::cos(kReach)}};
  turned.profile.weights = {1, c, 1};
  turned.angle = 2.0 * std::numbers::pi;
  return test::model_of({to_nurbs(turned, 1e-9)->surface});
}

ToolpathOptions with_ball(double scallop) {
  ToolpathOptions o;
  o.cutter = {CutterKind::kBall, 2.0 * kBallRadius, 0.0};
  o.tolerance = 0.01;
  o.scallop = scallop;
  return o;
}

/// Places of the tip in y of all passes, which run along x.
std::vector<double> lines_of(const Toolpath& path) {
  std::vector<double> out;
  for (const ToolpathMove& move : path.moves) {
    if (move.kind != ToolMove::kPass) continue;
    for (const Vec3 p : move.points) out.push_back(p.y);
  }
  std::sort(out.begin(), out.end());
  const auto same = [](double a, double b) { return b - a < 1e-6; };
  out.erase(std::unique(out.begin(), out.end(), same), out.end());
  return out;
}

/// The most that stays between neighbouring lines of tips on a body of the radius R about x, where
/// the ball touches it and not its border.
double most_between(const std::vector<double>& lines, double body) {
  const double away = std::abs(body + kBallRadius);
  double most = 0.0;
  std::optional<double> before;
  for (const double y : lines) {
    const double angle = std::asin(std::clamp(y / away, -1.0, 1.0));
    if (std::abs(angle) > kReach) continue;
    if (before) most = std::max(most, left_between(body, angle - *before));
    before = angle;
  }
  return most;
}

TEST(ScallopOfABall, OnAPlaneIsThatOfTheLinesOfItsPasses) {
  const SurfaceModel plane =
      test::model_of({test::plate({0, 0, 0}, {20, 0, 0}, {0, 15, 0}, {20, 15, 0})});
  for (const double scallop : {0.02, 0.2}) {
    const ToolpathOptions o = with_ball(scallop);
    const auto path = plan(plane, o);
    ASSERT_TRUE(path) << to_line(path.error());
    EXPECT_TRUE(path->not_kept.empty());
    const std::vector<double> lines = lines_of(*path);
    ASSERT_GT(lines.size(), 3U);
    double widest = 0.0;
    for (std::size_t i = 1; i < lines.size(); ++i)
      widest = std::max(widest, lines[i] - lines[i - 1]);
    const double left = kBallRadius - std::sqrt(kBallRadius * kBallRadius - 0.25 * widest * widest);
    // printing moves places by its share; the survey looks between them to 2 % of the scallop
    const double within = print_within(o) + kScallopWithin * scallop;
    EXPECT_NEAR(path->report.scallop.found, left, within);
    EXPECT_GE(path->report.scallop.most, left - within);
    EXPECT_LE(path->report.scallop.most, scallop);
    EXPECT_GT(left, 0.7 * scallop) << "more passes than are needed";
  }
}

TEST(ScallopOfABall, OnPipesIsThatOfTheAnglesBetweenItsPasses) {
  for (const double body : {8.0, 40.0, -8.0, -40.0}) {
    SCOPED_TRACE(body);
    constexpr double kLeft = 0.05;
    const ToolpathOptions o = with_ball(kLeft);
    const auto path = plan(pipe(body, 6.0), o);
    ASSERT_TRUE(path) << to_line(path.error());
    EXPECT_TRUE(path->not_kept.empty());
    const double left = most_between(lines_of(*path), body);
    const double within = print_within(o) + kScallopWithin * kLeft;
    EXPECT_LE(left, kLeft + within);
    EXPECT_NEAR(path->report.scallop.found, left, within);
    EXPECT_LE(path->report.scallop.most, kLeft);
  }
}

// Passes in planes y = const are parallels about the y axis on the sphere of the centres.
TEST(ScallopOfABall, OnASphereIsThatOfTheAnglesBetweenItsParallels) {
  constexpr double kSphere = 10.0, kLeft = 0.05;
  const ToolpathOptions o = with_ball(kLeft);
  const auto path = plan(cap(kSphere), o);
  ASSERT_TRUE(path) << to_line(path.error());
  EXPECT_TRUE(path->not_kept.empty());
  const double left = most_between(lines_of(*path), kSphere);
  const double within = print_within(o) + kScallopWithin * kLeft;
  EXPECT_LE(left, kLeft + within);
  // between the last ones and the border more may stay
  EXPECT_GE(path->report.scallop.found, left - within);
  EXPECT_LE(path->report.scallop.most, kLeft);
}

class Steps : public testing::Test {
 protected:
  static Part part_of(const SurfaceModel& model) {
    return *Part::make(model, {kBallRadius, kBallRadius}, 5e-3, 0.0, 1, {});
  }
  static constexpr double kSmall = 1e-3 * kBallRadius;  // the rule is that of parabolas
};

TEST_F(Steps, AcrossPipesLeaveWhatIsAimedAt) {
  const StepRule rule({kBallRadius, kBallRadius}, with_ball(kSmall));
  for (const double body : {5.0, 30.0, -5.0, -30.0}) {
    SCOPED_TRACE(body);
    const SurfaceModel model = pipe(body, 6.0);
    const Part part = part_of(model);
    const auto place = part.drop({3.0, 0.0});
    ASSERT_TRUE(place);
    const double step = rule.across(part, *place, {1, 0, 0});
    // in narrow hollows no step is longer than that of a level place
    if (step < rule.level()) {
      EXPECT_NEAR(left_between(body, step / std::abs(body)), kScallopAim * kSmall, 0.01 * kSmall);
    }
    EXPECT_EQ(step<rule.level(), body> 0.0);
    // along the pipe it is level
    EXPECT_NEAR(rule.across(part, *place, {0, 1, 0}), rule.level(), 1e-3 * rule.level());
  }
}

TEST_F(Steps, OnASphereAreTheSameInAllDirections) {
  constexpr double kSphere = 10.0;
  const StepRule rule({kBallRadius, kBallRadius}, with_ball(kSmall));
  const SurfaceModel model = cap(kSphere);
  const Part part = part_of(model);
  const auto place = part.drop({2.0, 1.0});
  ASSERT_TRUE(place);
  const Vec3 n = place->normal;
  const Vec3 one = unit(cross(n, {0.3, 1.0, 0.0})), other = cross(n, one);
  for (const double w : {0.0, 0.7, 2.0}) {
    const double step = rule.across(part, *place, std::cos(w) * one + std::sin(w) * other);
    EXPECT_NEAR(left_between(kSphere, step / kSphere), kScallopAim * kSmall, 0.01 * kSmall);
  }
}

// Seen from above the tip goes on by less than the contact in a hollow: chords of the circle of
// the centres. Down a slope of the angle a the step is shorter by cos a.
TEST_F(Steps, SeenFromAboveAreThoseOfTheCentres) {
  const StepRule rule({kBallRadius, kBallRadius}, with_ball(kSmall));
  constexpr double kHollow = -20.0;
  const SurfaceModel hollow = pipe(kHollow, 6.0);
  const Part part = part_of(hollow);
  const auto place = part.drop({3.0, 0.0});
  ASSERT_TRUE(place);
  const double step = rule.form(part, *place).along({0.0, 1.0});
  const double apart = 2.0 * std::asin(0.5 * step / (-kHollow - kBallRadius));
  EXPECT_NEAR(left_between(kHollow, apart), kScallopAim * kSmall, 0.01 * kSmall);

  for (const double degrees : {20.0, 50.0}) {
    const double a = degrees * std::numbers::pi / 180.0, z = 10.0 * std::tan(a);
    const SurfaceModel slope =
        test::model_of({test::plate({0, 0, 0}, {10, 0, z}, {0, 10, 0}, {10, 10, z})});
    const Part leaning = part_of(slope);
    const auto on_it = leaning.drop({5.0, 5.0});
    ASSERT_TRUE(on_it);
    const StepForm form = rule.form(leaning, *on_it);
    EXPECT_NEAR(form.along({1.0, 0.0}), rule.level() * std::cos(a), 1e-3 * rule.level());
    EXPECT_NEAR(form.along({0.0, 1.0}), rule.level(), 1e-3 * rule.level());
    // levels: the same way up the slope is so much higher
    EXPECT_NEAR(rule.down(leaning, *on_it, std::cos(a)), rule.level() * std::sin(a),
                1e-3 * rule.level());
  }
}

}  // namespace
}  // namespace obvid::toolpath
