// SPDX-License-Identifier: Apache-2.0
#include "obvid/core/internal/name_pattern.h"

#include <gtest/gtest.h>

namespace obvid {
namespace {

TEST(NamePattern, EveryPlaceGetsItsText) {
  EXPECT_EQ(filled("a/{id}/{id}-{number}.svg", {{kPlaceOfId, "wing"}, {kPlaceOfNumber, "7"}}),
            "a/wing/wing-7.svg");
  EXPECT_EQ(filled("{id", {{kPlaceOfId, "x"}}), "{id");
  EXPECT_EQ(filled("", {{kPlaceOfId, "x"}}), "");
  EXPECT_TRUE(has_place("a{id}", kPlaceOfId));
  EXPECT_FALSE(has_place("a{id}", kPlaceOfNumber));
}

TEST(NamePattern, TextsAreNotLookedInto) {
  EXPECT_EQ(filled("{id}{number}", {{kPlaceOfId, "{number}{id}"}, {kPlaceOfNumber, "1"}}),
            "{number}{id}1");
}

}  // namespace
}  // namespace obvid
