// SPDX-License-Identifier: Apache-2.0
#include "obvid/numeric/internal/median.h"

#include <gtest/gtest.h>

namespace obvid {
namespace {

TEST(Median, IsTheMiddleValueOrTheUpperOneOfTwo) {
  EXPECT_EQ(median_of({5.0, 1.0, 3.0}), 3.0);
  EXPECT_EQ(median_of({4.0, 1.0, 3.0, 2.0}), 3.0);
  EXPECT_EQ(median_of({7.0}), 7.0);
  std::vector<double> values = {9.0, 8.0, 1.0, 2.0, 5.0};
  EXPECT_EQ(median_within(values), 5.0);
  EXPECT_EQ(values.size(), 5U);
}

}  // namespace
}  // namespace obvid
