// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "../common/shared_data.h"
#include "obvid/io/internal/read_control_net.h"

namespace obvid {
namespace {

namespace fs = std::filesystem;

TEST(ReadControlNet, TheTeapotHasThirtyTwoBicubicPatches) {
  SKIP_WITHOUT("nurbs_control_points");
  const auto model =
      read_control_net((shared_data() / "surfaces" / "utah_teapot_bezier_patches.csv").string());
  ASSERT_TRUE(model) << to_line(model.error());
  ASSERT_EQ(model->patches.size(), 32u);
  for (const SurfacePatch& patch : model->patches) {
    EXPECT_EQ(patch.surface.degree_u, 3);
    EXPECT_EQ(patch.surface.degree_v, 3);
    EXPECT_EQ(patch.surface.points.size(), 16u);
  }
  EXPECT_EQ(model->patches[0].surface.points[1], (Vec3{1.4, -0.784, 2.4}));
}

TEST(ReadControlNet, ANetOfArcsIsACylinder) {
  SKIP_WITHOUT("nurbs_control_points");
  const auto model = read_control_net(
      (shared_data() / "nurbs_control_points" / "surface_ex_cylinder.cptw").string());
  ASSERT_TRUE(model) << to_line(model.error());
  const NurbsSurface& s = model->patches.at(0).surface;
  constexpr double kPrinted = 2e-5;  // weights have four decimals: 0.7071 for sqrt(1/2)
  for (int i = 0; i <= 20; ++i) {
    const Vec3 p = evaluate(s, i / 20.0, 0.3).point;
    EXPECT_NEAR(std::hypot(p.x, p.y), 1.0, kPrinted);
    EXPECT_NEAR(p.z, 0.3, 1e-12);
  }
  EXPECT_NEAR(evaluate(s, 0.25, 0.0).point.y, 1.0, 1e-12);
}

TEST(ReadControlNet, ANetOfSixBySixHasItsCorners) {
  SKIP_WITHOUT("nurbs_control_points");
  const auto model = read_control_net(
      (shared_data() / "nurbs_control_points" / "surface_ex_surface01.cpt").string());
  ASSERT_TRUE(model) << to_line(model.error());
  const NurbsSurface& s = model->patches.at(0).surface;
  EXPECT_EQ(s.count_u(), 6u);
  EXPECT_EQ(s.count_v(), 6u);
  EXPECT_EQ(evaluate(s, 0, 0).point, (Vec3{-25, -25, -10}));
  EXPECT_EQ(evaluate(s, 1, 0).point, (Vec3{-25, 25, -10}));
  EXPECT_EQ(evaluate(s, 0, 1).point, (Vec3{25, -25, -10}));
}

TEST(ReadControlNet, WeightsDivideTheirPoints) {
  const auto model = parse_control_net("0,0,0,1;4,0,0,2\n0,1,0,1;1,1,1,1\n", "f");
  ASSERT_TRUE(model) << to_line(model.error());
  EXPECT_EQ(model->patches[0].surface.points[1], (Vec3{2, 0, 0}));
  EXPECT_EQ(model->patches[0].surface.weights, (std::vector<double>{1, 2, 1, 1}));
}

void expect_net_refused(std::string_view text, ErrorCode code, std::string_view place) {
  const auto model = parse_control_net(text, "f");
  ASSERT_FALSE(model) << text;
  EXPECT_EQ(model.error().code, code) << to_line(model.error());
  EXPECT_EQ(model.error().where, place) << to_line(model.error());
}

TEST(ReadControlNet, FaultsAreNamedWithTheirPlace) {
  expect_net_refused("", ErrorCode::kTooFewPoints, "f");
  expect_net_refused("0,0,0;1,0,0\n0,1,0\n", ErrorCode::kBadCount, "f:2");
  expect_net_refused("0,0,0;1,0,0\n0,1,0;1,1\n", ErrorCode::kTooFewColumns, "f:2");
  expect_net_refused("0,0,0;1,0,0\n0,1,0;1,{{1}},1\n", ErrorCode::kBadNumber, "f:2");
  expect_net_refused("0,0,0;1,0,inf\n0,1,0;1,1,1\n", ErrorCode::kNotFinite, "f:1");
  expect_net_refused("0,0,0,1;1,0,0,0\n0,1,0,1;1,1,1,1\n", ErrorCode::kBadNumber, "f:1");
  expect_net_refused("0,0,0;1,0,0\n", ErrorCode::kTooFewPoints, "f");
  expect_net_refused("patch,row,col,x,y,z\n0,0,0,1,1,1\n0,0,0,1,1,1\n", ErrorCode::kBadCount,
                     "f:3");
  expect_net_refused("patch,row,col,x,y,z\n0,0,0,1,1,1\n0,0,1,1,1,1\n0,1,0,1,1,1\n0,1,2,1,1,1\n",
                     ErrorCode::kBadCount, "f");
}

}  // namespace
}  // namespace obvid
