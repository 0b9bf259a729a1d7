// SPDX-License-Identifier: Apache-2.0
// What allowances and boxes of stock are on walls: by hand.
#include <gtest/gtest.h>

#include <array>
#include <utility>
#include <vector>

#include "part.h"
#include "shapes.h"
#include "simulation.h"
#include "surface_cells.h"

namespace obvid::toolpath {
namespace {

constexpr double kAllowance = 0.4, kHeight = 3.0, kHalf = 4.0, kWallTolerance = 0.01;

/// A box without a bottom, 8 x 8 x 3, with du x dv of its walls outwards or inwards.
SurfaceModel box(bool outwards) {
  const auto wall = [&](Vec2 from, Vec2 to) {
    const Vec3 a{from.x, from.y, 0.0}, b{to.x, to.y, 0.0}, up{0.0, 0.0, kHeight};
    return outwards ? test::plate(a, b, a + up, b + up) : test::plate(a, a + up, b, b + up);
  };
  const Vec2 sw{-kHalf, -kHalf}, se{kHalf, -kHalf}, ne{kHalf, kHalf}, nw{-kHalf, kHalf};
  const auto top = [](Vec2 p) { return Vec3{p.x, p.y, kHeight}; };
  return test::model_of({test::plate(top(sw), top(se), top(nw), top(ne)), wall(sw, se),
                         wall(se, ne), wall(ne, nw), wall(nw, sw)});
}

/// Of one way of a flat mill of radius 1.5, or of none.
SimulationReport report_of(const SurfaceModel& model, const std::vector<Sweep>& sweeps,
                           const std::array<Vec3, 2>& stock) {
  const CutterShape cutter{1.5, 0.0};
  const auto part = Part::make(model, cutter, kWallTolerance, kAllowance, 1, {});
  EXPECT_TRUE(part);
  const auto made = SurfaceCells::make(*part, 0.2, cutter.radius, 1);
  EXPECT_TRUE(made);
  const SurfaceCells& cells = *made;
  auto reach = large_list<Nearest>(cells.cells().size(), {}, 1);
  Simulation simulation(*part, cells, reach, 1);
  EXPECT_TRUE(simulation.cut(sweeps, {}));
  const auto report = simulation.rough_report(1.0, stock, {});
  EXPECT_TRUE(report);
  return *report;
}

class Walls : public testing::TestWithParam<bool> {};

TEST_P(Walls, AllowanceLiesOutsideWhicheverWayTheirNormalsPoint) {
  const SurfaceModel model = box(GetParam());
  const std::array<Vec3, 2> stock{Vec3{-5.0, -5.0, 0.0}, Vec3{5.0, 5.0, kHeight + kAllowance}};
  // stock of a width of 1 stands round the box, and 0.6 of it is more than the allowance
  EXPECT_NEAR(report_of(model, {}, stock).left.found, 0.6, 1e-9);
  // the mill comes within 0.15 of the wall: 0.25 of the allowance are gone
  const double x = kHalf + 1.5 + 0.15;
  const SimulationReport cut = report_of(model, {{{x, -3.0, 0.5}, {x, 3.0, 0.5}}}, stock);
  EXPECT_NEAR(cut.depth.found, 0.25, 1e-6);
  EXPECT_NEAR(cut.depth.place.x, kHalf + kAllowance, 1e-9);
}

TEST_P(Walls, NoStockStaysOverPlacesOutsideItsBox) {
  const std::array<Vec3, 2> beside{Vec3{-5.0, 6.0, 0.0}, Vec3{6.0, 7.0, 5.0}};
  EXPECT_EQ(report_of(box(GetParam()), {}, beside).left.found, 0.0);
}

INSTANTIATE_TEST_SUITE_P(BothWays, Walls, testing::Bool());

}  // namespace
}  // namespace obvid::toolpath
