// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/curvature_chains.h"

#include <gtest/gtest.h>

#include <cmath>

#include "known_spirals.h"

namespace obvid {
namespace {

std::vector<Element> log_spiral_samples() {
  std::vector<Element> e;
  for (int i = 0; i < 12; ++i) e.push_back(known::log_spiral(0.3, 0.45 * i + 0.02 * (i % 3)));
  return e;
}

std::vector<Element> involute_samples() {
  std::vector<Element> e;
  for (int i = 0; i < 10; ++i) e.push_back(known::involute(0.5 + 0.4 * i));
  return e;
}

/// Clothoid through its inflection, curvature rising.
std::vector<Element> clothoid_samples() {
  std::vector<Element> e;
  for (int i = 0; i < 9; ++i) e.push_back(known::clothoid(-1.0, 0.8, 0.3 * i));
  return e;
}

void expect_inside(const std::vector<Element>& e, const std::vector<CurvatureRange>& ranges) {
  ASSERT_EQ(ranges.size(), e.size());
  for (std::size_t i = 0; i < e.size(); ++i) {
    EXPECT_LT(ranges[i].low, e[i].kappa) << i;
    EXPECT_GT(ranges[i].high, e[i].kappa) << i;
  }
}

TEST(CurvatureChains, TrueCurvaturesOfKnownSpiralsLieInside) {
  for (const bool convex : {false, true}) {
    expect_inside(log_spiral_samples(), curvature_chains(log_spiral_samples(), -1, convex, 1));
    expect_inside(involute_samples(), curvature_chains(involute_samples(), -1, convex, 1));
  }
  expect_inside(clothoid_samples(), curvature_chains(clothoid_samples(), 1, false, 1));
}

TEST(CurvatureChains, ConvexityNarrowsTheFlatEndOnly) {
  const auto e = log_spiral_samples();
  const auto open = curvature_chains(e, -1, false, 1), convex = curvature_chains(e, -1, true, 1);
  EXPECT_TRUE(std::isinf(open.back().low));
  EXPECT_EQ(convex.back().low, 0.0);
  EXPECT_TRUE(std::isinf(convex.front().high));
  for (std::size_t i = 0; i < e.size(); ++i) {
    EXPECT_GE(convex[i].low, open[i].low) << i;
    EXPECT_EQ(convex[i].high, open[i].high) << i;
  }
}

TEST(CurvatureChains, EqualityIsTheBiarc) {
  // one link, closed form: chord 2, alpha = -0.3, beta = 0.5
  const std::vector<Element> e = {{{0, 0}, -0.3, 0}, {{2, 0}, 0.5, 0}};
  const auto r = curvature_chains(e, 1, false, 1);
  EXPECT_NEAR(r[1].low, std::sin(0.5), 1e-15);   // circle through the start
  EXPECT_NEAR(r[0].high, std::sin(0.3), 1e-15);  // circle through the end
  const auto c = curvature_chains(e, 1, true, 1);
  EXPECT_EQ(c[0].low, 0.0);
  const double q = std::sin(0.1) * std::sin(0.1);
  EXPECT_NEAR(c[1].low, std::sin(0.5) + q / std::sin(0.3), 1e-15);
}

TEST(CurvatureChains, MirrorImageHasTheMirroredRanges) {
  auto e = clothoid_samples();
  const auto ranges = curvature_chains(e, 1, false, 1);
  for (Element& x : e) x = {{x.point.x, -x.point.y}, -x.theta, -x.kappa};
  const auto mirrored = curvature_chains(e, -1, false, -1);
  for (std::size_t i = 0; i < e.size(); ++i) {
    EXPECT_EQ(mirrored[i].low, -ranges[i].high) << i;
    EXPECT_EQ(mirrored[i].high, -ranges[i].low) << i;
  }
}

TEST(CurvatureChains, DenserSamplesNarrowTheRanges) {
  double before = HUGE_VAL;
  for (const int n : {5, 9, 17, 33}) {
    std::vector<Element> e;
    for (int i = 0; i <= n; ++i) e.push_back(known::log_spiral(0.2, 4.0 * i / n));
    const auto r = curvature_chains(e, -1, true, 1);
    const auto middle = static_cast<std::size_t>(n / 2);
    const double width = r[middle].high - r[middle].low;
    EXPECT_LT(width, before) << n;
    before = width;
  }
}

TEST(CurvatureChains, NoElementsGiveNoRanges) {
  EXPECT_TRUE(curvature_chains({}, 1, true, 1).empty());
}

}  // namespace
}  // namespace obvid
