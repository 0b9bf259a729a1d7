// SPDX-License-Identifier: Apache-2.0
#include "obvid/series/internal/sections.h"

#include <gtest/gtest.h>

#include <random>

namespace obvid {
namespace {

using SectionIndices = std::vector<std::size_t>;
using Sections = std::vector<Section>;

TEST(Sections, ASeriesReturnsWhenItsEndsCoincideWithinTheirTolerances) {
  const std::vector<Vec2> loop{{0, 0}, {1, 0}, {1, 1}, {0, 0.3}};
  EXPECT_FALSE(returns_to_start(loop, 0.0, 0.0));
  EXPECT_FALSE(returns_to_start(loop, 0.1, 0.1));
  EXPECT_TRUE(returns_to_start(loop, 0.2, 0.1));
  EXPECT_TRUE(returns_to_start({{0, 0}, {1, 0}, {1, 1}, {0, 0}}, 0.0, 0.0));
  EXPECT_FALSE(returns_to_start({{0, 0}, {1, 0}, {0, 0}}, 0.0, 0.0)) << "to and fro is no loop";
}

TEST(Sections, TwoEndsBecomeOnePointThatIsTrueToBoth) {
  EXPECT_EQ(join_points({1, 2}, 0.5, {1, 2}, 0.1).point, (Vec2{1, 2}));
  EXPECT_EQ(join_points({1, 2}, 0.5, {1, 2}, 0.1).tolerance, 0.1);
  EXPECT_EQ(join_points({0, 0}, 5.0, {1, 0}, 0.5).point, (Vec2{1, 0}));
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int i = 0; i < 1000; ++i) {
    const Vec2 a{unit(random), unit(random)};
    const double ta = unit(random), tb = unit(random);
    const Vec2 b = a + (unit(random) * (ta + tb)) * unit_at(7.0 * unit(random));
    const JoinedPoint joined = join_points(a, ta, b, tb);
    EXPECT_GE(joined.tolerance, 0.0);
    EXPECT_LE(norm(joined.point - a) + joined.tolerance, ta + 1e-15);
    EXPECT_LE(norm(joined.point - b) + joined.tolerance, tb + 1e-15);
    // no larger disc lies in both
    EXPECT_GE(2.0 * joined.tolerance + 1e-15,
              std::min({2.0 * ta, 2.0 * tb, ta + tb - norm(b - a)}));
  }
}

TEST(Sections, AnOpenSeriesIsCutBetweenItsEnds) {
  const SplitSeries whole = split_sections(5, {}, false);
  EXPECT_EQ(whole.order, (SectionIndices{0, 1, 2, 3, 4}));
  EXPECT_EQ(whole.sections, (Sections{{0, 4}}));
  EXPECT_FALSE(whole.smooth_loop);
  const SplitSeries cut = split_sections(7, {2, 3}, false);
  EXPECT_EQ(cut.sections, (Sections{{0, 2}, {2, 3}, {3, 6}}));
}

TEST(Sections, AClosedSeriesWithoutCornersIsOneLoop) {
  const SplitSeries loop = split_sections(6, {}, true);
  EXPECT_TRUE(loop.smooth_loop);
  EXPECT_EQ(loop.sections, (Sections{{0, 6}}));
  EXPECT_EQ(loop.point_at(6), 0U);
}

TEST(Sections, AClosedSeriesBeginsAtItsFirstCorner) {
  const SplitSeries one = split_sections(6, {2}, true);
  EXPECT_EQ(one.order, (SectionIndices{2, 3, 4, 5, 0, 1}));
  EXPECT_EQ(one.sections, (Sections{{0, 6}}));
  EXPECT_FALSE(one.smooth_loop);
  EXPECT_EQ(one.point_at(6), 2U);
  const SplitSeries three = split_sections(8, {1, 4, 7}, true);
  EXPECT_EQ(three.order, (SectionIndices{1, 2, 3, 4, 5, 6, 7, 0}));
  EXPECT_EQ(three.sections, (Sections{{0, 3}, {3, 6}, {6, 8}}));
  EXPECT_EQ(three.point_at(8), 1U);
}

}  // namespace
}  // namespace obvid
