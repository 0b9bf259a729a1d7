// SPDX-License-Identifier: Apache-2.0
// Printed programs, read back by an interpreter of their own and cut out of a raster of heights.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <tuple>

#include "height_field.h"
#include "obvid/toolpath/toolpath.h"
#include "obvid/toolpath/toolpath_gcode.h"
#include "shapes.h"

namespace obvid {
namespace {

/// A wavy part, and how finely its cutting is simulated.
struct Trial {
  double side, tolerance, scallop;
  double raster;  ///< of the heights
  double step;    ///< of the interpreter: sharp corners leave stairs of step times slope
  [[nodiscard]] double steepest() const { return 2.0 / 4.5; }
  /// Nodes see cusps between rows that lie `raster` apart; steps of the interpreter leave some
  /// more.
  [[nodiscard]] double error(double corner) const {
    return corner > 0.0 ? raster * raster / (8.0 * corner) : step * steepest();
  }
};
constexpr Trial kRound{30.0, 0.01, 0.05, 0.2, 0.1};
constexpr Trial kSharp{15.0, 0.02, 0.1, 0.15, 0.02};

double wave(double x, double y) { return 2.0 * std::sin(x / 4.5) * std::cos(y / 4.5); }
/// z of the unit normal: turns heights into distances.
double wave_normal(double x, double y) {
  const double zx = 2.0 / 4.5 * std::cos(x / 4.5) * std::cos(y / 4.5);
  const double zy = -2.0 / 4.5 * std::sin(x / 4.5) * std::sin(y / 4.5);
  return 1.0 / std::sqrt(1.0 + zx * zx + zy * zy);
}

struct Found {
  double gouge = 0.0, cusp = 0.0;
};

using Case = std::tuple<CutterKind, ToolpathStrategy, double>;

class Wavy : public testing::TestWithParam<Case> {
 protected:
  static Cutter cutter() {
    switch (std::get<0>(GetParam())) {
      case CutterKind::kBall:
        return {CutterKind::kBall, 6.0, 0.0};
      case CutterKind::kFlat:
        return {CutterKind::kFlat, 4.0, 0.0};
      case CutterKind::kBullNose:
        break;
    }
    return {CutterKind::kBullNose, 6.0, 1.5};
  }
  static double corner() {
    return std::get<0>(GetParam()) == CutterKind::kBall   ? 3.0
           : std::get<0>(GetParam()) == CutterKind::kFlat ? 0.0
                                                          : 1.5;
  }
  static Trial trial() { return std::get<0>(GetParam()) == CutterKind::kFlat ? kSharp : kRound; }
  static ToolpathOptions options() {
    ToolpathOptions o;
    o.cutter = cutter();
    o.strategy = std::get<1>(GetParam());
    o.angle_deg = std::get<2>(GetParam());
    o.tolerance = trial().tolerance;
    o.scallop = trial().scallop;
    return o;
  }
};

TEST_P(Wavy, NothingIsGougedAndCuspsOfAllCuttersStayBelowTheScallop) {
  const Trial trial = Wavy::trial();
  const double side = trial.side;
  const auto model = test::model_of({test::surface_of(wave, {0, 0}, {side, side}, 61)});
  const auto path = plan(model, options());
  ASSERT_TRUE(path) << to_line(path.error());
  const auto program = toolpath_gcode(*path);
  ASSERT_TRUE(program) << to_line(program.error());
  const auto run = test::NcInterpreter(trial.step).run(program->text);
  ASSERT_TRUE(run.faults.empty()) << run.faults.front();

  const double d = cutter().diameter;
  test::HeightField part({0, 0}, {side, side}, trial.raster, 0.0), stock = part;
  part.fill(wave);
  std::fill(stock.z.begin(), stock.z.end(), 10.0);
  stock.cut(run, d, corner());
  // isoparametric passes touch the part only: none rolls over its border to reach a hollow there
  const double over = std::get<1>(GetParam()) == ToolpathStrategy::kIsoparametric ? 0.0 : 0.5 * d;
  test::HeightField lowest = test::lowest_reachable(part, d, corner(), over);
  Found found;
  found.gouge = part.depth(run, d, corner());
  int looked = 0;
  // a sharp corner leaves a wall where its rim turns back; nodes of the border stand in that wall
  const int inset = corner() > 0.0 ? 0 : 1;
  for (int j = inset; j < part.ny - inset; ++j) {
    for (int i = inset; i < part.nx - inset; ++i) {
      const Vec2 p = part.place(i, j);
      const double nz = wave_normal(p.x, p.y), f = part.at(i, j);
      if (lowest.at(i, j) > f + trial.tolerance) continue;  // narrower than the cutter
      ++looked;
      found.cusp = std::max(found.cusp, (stock.at(i, j) - f) * nz);
    }
  }
  RecordProperty("gouge", std::to_string(found.gouge));
  RecordProperty("cusp", std::to_string(found.cusp));
  RecordProperty("reported", std::to_string(path->report.scallop));
  RecordProperty("passes", std::to_string(path->report.passes));
  RecordProperty("added", std::to_string(path->report.added_passes));
  EXPECT_GT(looked, 1000);
  EXPECT_LE(found.gouge, trial.tolerance + 1e-4);  // and what 61 points interpolate differently
  const double error = trial.tolerance + trial.error(corner());
  EXPECT_LE(found.cusp, trial.scallop + error);
  EXPECT_LE(found.cusp, path->report.scallop + error) << "more than the report says";
  EXPECT_LE(path->report.scallop, trial.scallop);
  EXPECT_GT(found.cusp, 0.2 * trial.scallop) << "far more passes than the scallop asks for";
  if (std::get<1>(GetParam()) == ToolpathStrategy::kZigzag && std::get<2>(GetParam()) == 90.0) {
    EXPECT_NE(program->text.find("G19"), std::string::npos);
    EXPECT_GT(program->arc_blocks, 0U);
  }
}

constexpr auto kZigzag = ToolpathStrategy::kZigzag;
constexpr auto kIsoparametric = ToolpathStrategy::kIsoparametric;
constexpr auto kConstantScallop = ToolpathStrategy::kConstantScallop;

INSTANTIATE_TEST_SUITE_P(Balls, Wavy,
                         testing::Values(Case{CutterKind::kBall, kZigzag, 0.0},
                                         Case{CutterKind::kBall, kZigzag, 30.0},
                                         Case{CutterKind::kBall, kZigzag, 90.0},
                                         Case{CutterKind::kBall, kIsoparametric, 0.0},
                                         Case{CutterKind::kBall, kConstantScallop, 30.0}));
INSTANTIATE_TEST_SUITE_P(BullNoses, Wavy,
                         testing::Values(Case{CutterKind::kBullNose, kZigzag, 30.0},
                                         Case{CutterKind::kBullNose, kIsoparametric, 0.0},
                                         Case{CutterKind::kBullNose, kConstantScallop, 0.0}));
INSTANTIATE_TEST_SUITE_P(FlatMills, Wavy,
                         testing::Values(Case{CutterKind::kFlat, kZigzag, 0.0},
                                         Case{CutterKind::kFlat, kIsoparametric, 0.0},
                                         Case{CutterKind::kFlat, kConstantScallop, 0.0}));

}  // namespace
}  // namespace obvid
