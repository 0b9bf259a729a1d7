// SPDX-License-Identifier: Apache-2.0
// Only for tests/recipes: z = x^2 - y^2 as the sum of two parabolas, a quarter of a circle along
// another.
#include <gtest/gtest.h>

#include <cmath>

#include "obvid/surface/surface.h"

namespace obvid {
namespace {

TEST(TranslationSurface, OfTwoParabolasIsASaddle) {
  const TranslationSurface saddle = {
      {2, {0, 0, 0, 2, 2, 2}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 4}}, {}},
      {2, {0, 0, 0, 1, 1, 1}, {{0, 0, 0}, {0, 0.5, 0}, {0, 1, -1}}, {}}};
  const auto form = to_nurbs(Surface{saddle}, 1e-6);
  ASSERT_TRUE(form);
  for (double x = 0.0; x <= 2.0; x += 0.25) {
    for (double y = 0.0; y <= 1.0; y += 0.25) {
      const Vec3 there{x, y, x * x - y * y};
      EXPECT_LT(norm(evaluate(Surface{saddle}, x, y).point - there), 1e-14);
      EXPECT_LT(norm(evaluate(form->surface, x, y).point - there), 1e-14);
    }
  }
}

TEST(TranslationSurface, OfTwoCirclesIsTheirSumToo) {
  const double half = std::sqrt(0.5);
  const TranslationSurface sum = {
      {2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {1, half, 1}},
      {2, {0, 0, 0, 1, 1, 1}, {{0, 0, 0}, {0, 0, 3}, {0, -3, 3}}, {1, half, 1}}};
  const auto form = to_nurbs(Surface{sum}, 1e-6);
  ASSERT_TRUE(form);
  for (double u = 0.0; u <= 1.0; u += 0.125) {
    for (double v = 0.0; v <= 1.0; v += 0.125) {
      const Vec3 p = evaluate(form->surface, u, v).point;
      // about (0, -3) of radius 3 in the plane of y and z, moved along the unit circle
      const double moved = std::sqrt(1.0 - p.x * p.x);
      EXPECT_NEAR(std::hypot(p.y - moved + 3.0, p.z), 3.0, 1e-14);
      EXPECT_LT(norm(evaluate(Surface{sum}, u, v).point - p), 1e-14);
    }
  }
}

}  // namespace
}  // namespace obvid
