// SPDX-License-Identifier: Apache-2.0
// Only for tests/recipes: z = x^2 - y^2 as the sum of two parabolas.
#include <gtest/gtest.h>

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

}  // namespace
}  // namespace obvid
