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

constexpr double kTolerance = 0.01, kScallop = 0.05, kRaster = 0.2;
constexpr double kSide = 30.0;
/// Points of the raster see cusps between rows of a raster of `kRaster`; and the interpreter's
/// steps.
constexpr double kRasterError = 0.003;

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
  static ToolpathOptions options() {
    ToolpathOptions o;
    o.cutter = cutter();
    o.strategy = std::get<1>(GetParam());
    o.angle_deg = std::get<2>(GetParam());
    o.tolerance = kTolerance;
    o.scallop = kScallop;
    return o;
  }
};

TEST_P(Wavy, NothingIsGougedAndCuspsStayBelowTheScallop) {
  const auto model = test::model_of({test::surface_of(wave, {0, 0}, {kSide, kSide}, 61)});
  const auto path = plan(model, options());
  ASSERT_TRUE(path) << to_line(path.error());
  const auto program = toolpath_gcode(*path);
  ASSERT_TRUE(program) << to_line(program.error());
  const auto run = test::NcInterpreter(0.5 * kRaster).run(program->text);
  ASSERT_TRUE(run.faults.empty()) << run.faults.front();

  const double d = cutter().diameter;
  test::HeightField part({0, 0}, {kSide, kSide}, kRaster, 0.0), stock = part;
  part.fill(wave);
  std::fill(stock.z.begin(), stock.z.end(), 10.0);
  stock.cut(run, d, corner());
  test::HeightField lowest = test::lowest_reachable(part, d, corner());
  Found found;
  found.gouge = part.depth(run, d, corner());
  int looked = 0;
  // a sharp corner leaves a wall where its rim turns back; nodes of the border stand in that wall
  const int inset = corner() > 0.0 ? 0 : 1;
  for (int j = inset; j < part.ny - inset; ++j) {
    for (int i = inset; i < part.nx - inset; ++i) {
      const Vec2 p = part.place(i, j);
      const double nz = wave_normal(p.x, p.y), f = part.at(i, j);
      if (lowest.at(i, j) > f + kTolerance) continue;  // narrower than the cutter
      ++looked;
      found.cusp = std::max(found.cusp, (stock.at(i, j) - f) * nz);
    }
  }
  RecordProperty("gouge", std::to_string(found.gouge));
  RecordProperty("cusp", std::to_string(found.cusp));
  EXPECT_GT(looked, 1000);
  EXPECT_LE(found.gouge, kTolerance + 1e-4);  // and what 61 points interpolate differently
  if (std::get<0>(GetParam()) != CutterKind::kBall) {
    EXPECT_FALSE(path->warnings.empty());  // flat bottoms: the scallop is an estimate
    return;
  }
  EXPECT_LE(found.cusp, kScallop + kTolerance + kRasterError);
  EXPECT_GT(found.cusp, 0.2 * kScallop) << "far more passes than the scallop asks for";
}

INSTANTIATE_TEST_SUITE_P(RoundCutters, Wavy,
                         testing::Combine(testing::Values(CutterKind::kBall, CutterKind::kBullNose),
                                          testing::Values(ToolpathStrategy::kZigzag,
                                                          ToolpathStrategy::kIsoparametric,
                                                          ToolpathStrategy::kConstantScallop),
                                          testing::Values(0.0, 30.0)));
INSTANTIATE_TEST_SUITE_P(FlatCutter, Wavy,
                         testing::Values(Case{CutterKind::kFlat, ToolpathStrategy::kZigzag, 0.0}));

}  // namespace
}  // namespace obvid
