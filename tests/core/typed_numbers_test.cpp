// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/typed_numbers.h"

#include <gtest/gtest.h>

namespace obvid {
namespace {

using Numbers = std::vector<double>;

TEST(TypedNumbers, AreAllOfTheText) {
  EXPECT_EQ(typed_numbers("1,2.5,-3e2"), (Numbers{1.0, 2.5, -300.0}));
  EXPECT_EQ(typed_numbers("+1,-2"), (Numbers{1.0, -2.0}));
  EXPECT_EQ(typed_numbers("0:0.5:100", ':'), (Numbers{0.0, 0.5, 100.0}));
  EXPECT_EQ(typed_numbers<long>("2,3"), (std::vector<long>{2, 3}));
}

TEST(TypedNumbers, AreNoneWhereOneIsNone) {
  for (const char* text : {"", ",", "1,", ",1", "1,,2", "1 ,2", "1;2", "inf", "1,nan", "0x10",
                           "1e999", "++1", "+-1", "+", "1,2mm"}) {
    EXPECT_FALSE(typed_numbers(text)) << text;
  }
  for (const char* text : {"2.5", "1e1", "99999999999999999999"}) {
    EXPECT_FALSE(typed_numbers<long>(text)) << text;
  }
}

}  // namespace
}  // namespace obvid
