// SPDX-License-Identifier: Apache-2.0
// Printed programs for six surfaces, three mills and three strategies, read back by an interpreter
// of the tests' own and simulated by formulas of their own: what the report says has to be so.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <tuple>

#include "cutting.h"
#include "obvid/toolpath/toolpath.h"
#include "shapes.h"

namespace obvid {
namespace {

/// A height over a square, and its slopes by x and y.
struct Part {
  const char* name;
  double side;
  double (*height)(double, double);
};

double waves(double x, double y) { return 1.2 * std::sin(x / 2.5) * std::cos(y / 2.5); }
double dome(double x, double y) {
  return std::sqrt(100.0 - (x - 5.0) * (x - 5.0) - (y - 4.0) * (y - 4.0)) - 10.0;
}
double bowl(double x, double y) { return -0.7 * dome(x, y); }
double saddle(double x, double y) { return 0.06 * ((x - 5.0) * (x - 5.0) - (y - 5.0) * (y - 5.0)); }
/// From level through a slope of 60 degrees to level.
double bank(double x, double y) { return 2.2 * std::tanh(0.8 * (x + 0.3 * y - 6.5)); }
/// A hull's bottom: long and gentle, with a turn at the side.
double bottom(double x, double y) {
  return 0.0006 * x * x + 2.5 / (1.0 + std::exp(-1.6 * (y - 7.0)));
}

constexpr Part kParts[] = {{"waves", 10.0, waves}, {"dome", 9.0, dome},
                           {"bowl", 9.0, bowl},    {"saddle", 10.0, saddle},
                           {"bank", 10.0, bank},   {"bottom", 10.0, bottom}};

struct Tool {
  const char* name;
  Cutter cutter;
  test::Mill mill;
};
constexpr Tool kTools[] = {{"ball", {CutterKind::kBall, 4.0, 0.0}, {2.0, 2.0}},
                           {"bull", {CutterKind::kBullNose, 4.0, 1.0}, {2.0, 1.0}},
                           {"flat", {CutterKind::kFlat, 3.0, 0.0}, {1.5, 0.0}}};

constexpr double kTolerance = 0.02, kScallop = 0.1;
constexpr double kRaster = 0.1;    // of points of the part, and of axes that rest on them
constexpr double kStep = 0.02;     // of the interpreter
constexpr double kMostLeft = 4.0;  // higher than any of the parts

test::Sample sample_at(const Part& part, double x, double y) {
  constexpr double e = 1e-5;  // for slopes by differences
  const double zx = (part.height(x + e, y) - part.height(x - e, y)) / (2.0 * e);
  const double zy = (part.height(x, y + e) - part.height(x, y - e)) / (2.0 * e);
  return {{x, y, part.height(x, y)}, unit(Vec3{-zx, -zy, 1.0})};
}

std::vector<test::Sample> samples_of(const Part& part) {
  std::vector<test::Sample> out;
  const int n = static_cast<int>(std::lround(part.side / kRaster));
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i <= n; ++i)
      out.push_back(sample_at(part, part.side * i / n, part.side * j / n));
  }
  return out;
}

/// Height of a mill with this axis that rests on the part, on rings so close to each other that
/// what stands between them does not count, and along the part's borders; no more than `enough`.
double resting_at(const Part& part, test::Mill mill, Vec2 axis, double enough) {
  constexpr int kRings = 24, kAround = 2000;
  double z = -1e9;
  const auto under = [&](Vec2 p) {  // the part ends at its borders: the nearest place of it
    p = {std::clamp(p.x, 0.0, part.side), std::clamp(p.y, 0.0, part.side)};
    const double level = std::hypot(p.x - axis.x, p.y - axis.y);
    if (level <= mill.radius) z = std::max(z, part.height(p.x, p.y) - mill.rise(level));
  };
  for (int k = 0; k < kAround && z < enough; ++k) {
    const double angle = 2.0 * std::numbers::pi * k / kAround;
    const Vec2 out = mill.radius * Vec2{std::cos(angle), std::sin(angle)};
    for (int ring = 0; ring <= kRings; ++ring) under(axis + (1.0 * ring / kRings) * out);
  }
  return std::min(z, enough);
}

/// What a mill leaves over a place when it comes down where it would touch that place, at least
/// where that is no more than the tolerance.
double left_where_it_touches(const Part& part, test::Mill mill, const test::Sample& s) {
  const double level = std::hypot(s.normal.x, s.normal.y);
  Vec3 tip = s.point + mill.corner * (s.normal - Vec3{0.0, 0.0, 1.0});
  if (level > 0.0) {
    const double out = (mill.radius - mill.corner) / level;
    tip = tip + out * Vec3{s.normal.x, s.normal.y, 0.0};
  }
  const double enough = tip.z + 2.0 * kTolerance;  // along the normal that is no less
  tip.z = std::max(tip.z, resting_at(part, mill, {tip.x, tip.y}, enough));
  return test::Cut(mill, {tip}).left(s, kMostLeft);
}

/// What stays over a place: mostly little, so that few tips need to be looked at.
double left_over(test::Cut& cut, const test::Sample& s) {
  const double left = cut.left(s, 1.0);
  return left < 1.0 ? left : cut.left(s, kMostLeft);
}

using Case = std::tuple<int, int, ToolpathStrategy>;

class Printed : public testing::TestWithParam<Case> {
 protected:
  static const Part& part() { return kParts[std::get<0>(GetParam())]; }
  static const Tool& tool() { return kTools[std::get<1>(GetParam())]; }
  static ToolpathOptions options() {
    ToolpathOptions o;
    o.cutter = tool().cutter;
    o.strategy = std::get<2>(GetParam());
    o.angle_deg =
        o.strategy == ToolpathStrategy::kZigzag ? 90.0 * (std::get<0>(GetParam()) % 2) : 30.0;
    o.tolerance = kTolerance;
    o.scallop = kScallop;
    return o;
  }
  /// Steps of the interpreter leave cusps of their own, sharp corners stairs; coarse samples and
  /// the surface's difference from the formula add to gouges.
  static double step_error() {
    const double corner = tool().mill.corner;
    return 2e-4 + (corner > 0.0 ? kStep * kStep / (8.0 * corner) : 0.5 * kStep);
  }
};

TEST_P(Printed, ProgramsDoWhatTheirReportsSay) {
  const auto model =
      test::model_of({test::surface_of(part().height, {0, 0}, {part().side, part().side}, 81)});
  const auto path = plan(model, options());
  ASSERT_TRUE(path) << to_line(path.error());
  const ToolpathReport& r = path->report;
  const auto run = test::NcInterpreter(kStep).run(path->program.text);
  ASSERT_TRUE(run.faults.empty()) << run.faults.front();

  const auto samples = samples_of(part());
  test::Cut cut(tool().mill, test::tips_of(run));
  test::Cut best(tool().mill, test::resting(samples, tool().mill, kRaster));
  // the resting tips know the part at samples only: sharp corners stand lower than they can, and
  // say nothing of a tolerance; what these reach is told by the place where they touch alone, whose
  // rings miss the part's corners by no more than half their points' distance up the steepest slope
  const bool sharp = tool().mill.corner == 0.0;
  const double low = sharp ? 0.5 * kRaster : 0.002, unsure = sharp ? 0.005 : low;
  double gouge = 0.0, cusp = 0.0, held = 0.0;
  int reached = 0;
  Vec3 at;
  for (const test::Sample& s : samples) {
    gouge = std::max(gouge, cut.depth(s.point));
    const double left = left_over(cut, s);
    if (left <= cusp) continue;
    const double least = left_over(best, s);
    const double touching = sharp ? left_where_it_touches(part(), tool().mill, s) : least;
    if (touching > kTolerance - unsure) {  // narrower than the mill, or nearly so
      held = std::max(held, std::min(left, least));
      continue;
    }
    ++reached;
    cusp = left;
    at = s.point;
  }
  RecordProperty("gouge", std::to_string(gouge));
  RecordProperty("gouge_reported", std::to_string(r.gouge.most));
  RecordProperty("cusp", std::to_string(cusp));
  RecordProperty("cusp_reported", std::to_string(r.scallop.found));
  RecordProperty("reached", reached);
  RecordProperty("passes", std::to_string(r.passes));
  EXPECT_GT(reached, 0);
  EXPECT_LE(gouge, r.gouge.most + 2e-4);
  EXPECT_LE(r.gouge.most, kTolerance);
  EXPECT_LE(cusp, r.scallop.most + step_error()) << at.x << ' ' << at.y << ' ' << at.z;
  // the place that the report names has what it says: the figure is no mere bound
  const test::Sample named = sample_at(part(), r.scallop.place.x, r.scallop.place.y);
  EXPECT_NEAR(left_over(cut, named), r.scallop.found, step_error());
  EXPECT_LE(r.scallop.found, r.scallop.most);
  // and what is not as asked for is said
  const bool kept = r.scallop.found <= kScallop && r.unreached_area == 0.0;
  EXPECT_EQ(kept, path->not_kept.empty());
  EXPECT_LE(held, std::max(r.unreached_depth, kTolerance) + low + step_error());
}

/// Bends of larger radius than the arcs that controllers are told (10 m): what may stand for them
/// is decided by the height of the arc, 0.04 over half the length here, not by the radius.
TEST(PrintedArcs, AreNoLinesWhereTheirHeightIsMoreThanTheTolerance) {
  constexpr double kRadius = 10'500.0, kLength = 120.0, kWidth = 3.0, kAllowed = 0.01;
  const auto ridge = [](double x, double) {
    return -(x - 0.5 * kLength) * (x - 0.5 * kLength) / (2.0 * kRadius);
  };
  for (const bool arcs : {true, false}) {
    ToolpathOptions o;
    o.cutter = kTools[0].cutter;
    o.tolerance = kAllowed;
    o.scallop = kScallop;
    o.gcode.arcs = arcs;
    const auto path =
        plan(test::model_of({test::surface_of(ridge, {0, 0}, {kLength, kWidth}, 31)}), o);
    ASSERT_TRUE(path) << to_line(path.error());
    const auto run = test::NcInterpreter(kStep).run(path->program.text);
    ASSERT_TRUE(run.faults.empty()) << run.faults.front();
    test::Cut cut(kTools[0].mill, test::tips_of(run));
    double gouge = 0.0;
    for (double x = 0.0; x <= kLength; x += 0.25) {
      for (double y = 0.0; y <= kWidth; y += 0.25) {
        gouge = std::max(gouge, cut.depth({x, y, ridge(x, y)}));
      }
    }
    EXPECT_LE(gouge, kAllowed);
    EXPECT_LE(gouge, path->report.gouge.most + 1e-6);
    EXPECT_LE(path->report.gouge.most, kAllowed);
    EXPECT_TRUE(path->not_kept.empty());
  }
}

std::string title(const testing::TestParamInfo<Printed::ParamType>& info) {
  constexpr std::array kStrategies = {"zigzag", "isoparametric", "scallop"};
  return std::string(kParts[std::get<0>(info.param)].name) + "_" +
         kTools[std::get<1>(info.param)].name + "_" +
         kStrategies[static_cast<std::size_t>(std::get<2>(info.param))];
}

/// Every part with every mill, each with one strategy so that all nine pairs of those occur twice.
std::vector<Printed::ParamType> square() {
  constexpr std::array kStrategies = {ToolpathStrategy::kZigzag, ToolpathStrategy::kIsoparametric,
                                      ToolpathStrategy::kConstantScallop};
  std::vector<Printed::ParamType> out;
  for (int part = 0; part < 6; ++part) {
    for (int mill = 0; mill < 3; ++mill) {
      out.emplace_back(part, mill, kStrategies[static_cast<std::size_t>(part + mill) % 3]);
    }
  }
  return out;
}

INSTANTIATE_TEST_SUITE_P(All, Printed, testing::ValuesIn(square()), title);

}  // namespace
}  // namespace obvid
