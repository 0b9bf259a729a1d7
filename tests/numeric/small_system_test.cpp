// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/small_system.h"

#include <gtest/gtest.h>

#include "obvid/geom/vec2.h"
#include "obvid/numeric/internal/wide.h"

namespace obvid {
namespace {

using Three = std::array<double, 3>;

TEST(SmallSystem, IsSolvedWhateverTheOrderOfItsRows) {
  // x = 1, -2, 3; the first pivot is 0
  const std::array<Three, 3> a = {{{0, 2, 1}, {4, -1, 2}, {2, 2, -3}}};
  Three b = {-1, 12, -11};
  ASSERT_TRUE(solve_small(a, b));
  EXPECT_NEAR(b[0], 1.0, 1e-15);
  EXPECT_NEAR(b[1], -2.0, 1e-15);
  EXPECT_NEAR(b[2], 3.0, 1e-15);
}

TEST(SmallSystem, KeepsItsDigitsWhereAPivotIsSmall) {
  // without an exchange the first unknown would be 0: x = 1 / (1 - e), y = (1 - 2 e) / (1 - e)
  const double e = 1e-20;
  const std::array<std::array<double, 2>, 2> a = {{{e, 1}, {1, 1}}};
  std::array<double, 2> b = {1, 2};
  ASSERT_TRUE(solve_small(a, b));
  EXPECT_NEAR(b[0], 1.0, 1e-15);
  EXPECT_NEAR(b[1], 1.0, 1e-15);
}

TEST(SmallSystem, TakesVectorsAndOtherNumbers) {
  const std::array<std::array<double, 2>, 2> a = {{{1, 1}, {1, -1}}};
  std::array<Vec2, 2> b = {Vec2{3, 7}, Vec2{-1, 1}};
  ASSERT_TRUE(solve_small(a, b));
  EXPECT_EQ(b[0], (Vec2{1, 4}));
  EXPECT_EQ(b[1], (Vec2{2, 3}));

  using numeric::Wide;
  const std::array<std::array<Wide, 2>, 2> wide = {
      {{Wide(3.0), Wide(0.0)}, {Wide(1.0), Wide(7.0)}}};
  std::array<Wide, 2> right = {Wide(1.0), Wide(1.0)};  // 1/3, 2/21
  ASSERT_TRUE(solve_small(wide, right));
  EXPECT_LT(abs(right[0] * 3.0 - Wide(1.0)), Wide(1e-30));
  EXPECT_LT(abs(right[1] * 21.0 - Wide(2.0)), Wide(1e-29));
}

TEST(SmallSystem, RefusesEquationsThatSayTheSameOrNothing) {
  Three b = {1, 1, 1};
  EXPECT_FALSE(solve_small(std::array<Three, 3>{{{1, 2, 3}, {2, 4, 6}, {0, 0, 1}}}, b));
  EXPECT_FALSE(solve_small(std::array<Three, 3>{}, b));
  const double nan = std::nan("");
  EXPECT_FALSE(solve_small(std::array<Three, 3>{{{nan, 0, 0}, {nan, 1, 0}, {nan, 0, 1}}}, b));
}

}  // namespace
}  // namespace obvid
