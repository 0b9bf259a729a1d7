// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/sketch.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace obvid {
namespace {

TEST(Sketch, ArcsWithFarCentresAreBulges) {
  // over a chord of 1 with a radius of 1e9: the tangent of a quarter of the angle is 1/(4 R)
  constexpr double kRadius = 1e9;
  Sketch sketch;
  SketchLayer layer;
  layer.name = "ARCS";
  layer.pieces.emplace_back(ArcPiece{{0.0, 0.0}, {1.0, 0.0}, -0.5 / kRadius, 1.0 / kRadius, 1.0});
  sketch.layers.push_back(layer);
  const std::string dxf = sketch_dxf(sketch);
  EXPECT_EQ(dxf.find("AcDbArc"), std::string::npos);
  const std::size_t at = dxf.find("AcDbPolyline");
  ASSERT_NE(at, std::string::npos);
  const std::size_t bulge = dxf.find(" 42\n", at);
  ASSERT_NE(bulge, std::string::npos);
  EXPECT_NEAR(std::strtod(dxf.c_str() + bulge + 4, nullptr), 0.25 / kRadius, 1e-24);
}

}  // namespace
}  // namespace obvid
