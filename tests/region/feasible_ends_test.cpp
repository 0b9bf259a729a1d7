// SPDX-License-Identifier: Apache-2.0
// Where ranges of headings end of themselves, and where only what is looked at ends them; radii at
// given headings that turn by more than half a turn.
#include <gtest/gtest.h>

#include <cmath>

#include "../common/angles.h"
#include "obvid/region/internal/feasible_data.h"

namespace obvid {
namespace {

TEST(FeasibleEnds, BehindAGivenHeadingOneEndIsACirclesAndTheOtherIsOpen) {
  // a curve of growing curvature turns on beyond the circle that the heading before begins
  const double alpha = -0.4;
  const auto found = feasible_data({{2.0, 0.0, 1}}, {{alpha, {}, 0}, {{}, {}, 0}});
  ASSERT_EQ(found.size(), 2u);
  ASSERT_TRUE(found[1].heading);
  EXPECT_NEAR(found[1].heading->low, -alpha, 1e-7);
  EXPECT_FALSE(found[1].heading->low_is_open);
  EXPECT_NEAR(found[1].heading->high, 0.5 * kPi, 1e-12);  // told up to a right angle
  EXPECT_TRUE(found[1].heading->high_is_open);
}

TEST(FeasibleEnds, BeforeAVertexNothingButHalfATurnEndsTheHeadings) {
  const auto found =
      feasible_data({{1.0, 0.0, 1}, {1.0, 1.0, -1}}, {{0.0, {}, 0}, {{}, {}, 0}, {{}, {}, 0}});
  ASSERT_TRUE(found[1].heading);
  EXPECT_NEAR(found[1].heading->low, 0.0, 1e-7);
  EXPECT_FALSE(found[1].heading->low_is_open);
  EXPECT_NEAR(found[1].heading->high, kPi, 1e-7);
  EXPECT_TRUE(found[1].heading->high_is_open);
}

TEST(FeasibleEnds, AHeadingThatIsGivenOrHeldIsNoOpenEnd) {
  RangeNode held{{}, {}, 0};
  held.thetas = ValueRange{0.2, 0.6};
  const auto found =
      feasible_data({{1.0, 0.0, 1}, {1.0, 1.0, -1}}, {{0.0, {}, 0}, held, {{}, {}, 0}});
  ASSERT_TRUE(found[1].heading);
  EXPECT_FALSE(found[1].heading->low_is_open);
}

TEST(FeasibleEnds, GivenHeadingsMayTurnByMoreThanHalfATurn) {
  // [Kurnosenko 2013]: -A B > sin^2(sigma/2), for alpha and beta below half a turn each
  const double h = 2.0, alpha = 1.8, beta = 1.6, start = -2.5;  // sigma 3.4
  const double a = 0.5 * start * h + std::sin(alpha), half = std::sin(0.5 * (alpha + beta));
  const auto found = feasible_data({{h, 0.0, 1}}, {{alpha, start, 0}, {beta, {}, 0}});
  ASSERT_TRUE(found[1].kappa);
  EXPECT_NEAR(found[1].kappa->low, 2.0 / h * (std::sin(beta) + half * half / -a), 1e-12);
  const auto back = feasible_data({{h, 0.0, 1}}, {{alpha, {}, 0}, {beta, {}, 0}});
  ASSERT_TRUE(back[0].kappa);
  EXPECT_NEAR(back[0].kappa->high, -2.0 / h * std::sin(alpha), 1e-12);
}

}  // namespace
}  // namespace obvid
