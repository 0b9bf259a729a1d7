// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/drawn_spans.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

namespace obvid {
namespace {

constexpr double kFar = 8e6;
constexpr double kHandle = 0x1p-24;  // 64 roundings of coordinates of that size, a real length

/// Two spans of degree 2, one knot between them: there the curve halves the way between the two
/// inner control points, and turns from one leg into the other without a corner.
NurbsCurve two_spans(Vec2 first, Vec2 second) {
  return {2,
          {0, 0, 0, 1, 2, 2, 2},
          {{kFar, kFar}, first, second, {kFar + 1.0, kFar + 1.0}},
          {1, 1, 1, 1}};
}

TEST(DrawnSpans, LegsLongerThanRoundingStayFarFromTheOrigin) {
  const Vec2 first{kFar + 0.5, kFar}, second = first + Vec2{kHandle, 0.0};
  const auto pieces = drawn_spans(two_spans(first, second));
  ASSERT_EQ(pieces.size(), 2U);
  for (const Piece& piece : pieces) {
    for (const double t : {0.0, 1.0}) {
      EXPECT_FALSE(is_singular_end(piece, t));
      EXPECT_TRUE(std::isfinite(element_at(piece, t).kappa));
    }
  }
  const auto& before = std::get<RationalBezier>(pieces[0]);
  const auto& after = std::get<RationalBezier>(pieces[1]);
  EXPECT_EQ(before.origin, after.origin);  // no gap
  EXPECT_EQ(before.offset[2], after.offset[0]);
  const Vec2 middle = 0.5 * ((first - before.origin) + (second - before.origin));
  EXPECT_EQ(before.offset[2], middle);
}

TEST(DrawnSpans, ControlPointsThatRepeatAreCorners) {
  const Vec2 corner{kFar + 0.5, kFar};
  for (const double apart : {0.0, 0x1p-30}) {  // 2^-30: one rounding
    const auto pieces = drawn_spans(two_spans(corner, corner + Vec2{apart, 0.0}));
    ASSERT_EQ(pieces.size(), 2U);
    EXPECT_TRUE(is_singular_end(pieces[0], 1.0)) << apart;
    EXPECT_TRUE(is_singular_end(pieces[1], 0.0)) << apart;
  }
}

TEST(DrawnSpans, LinesFarFromTheOriginKeepTheirPlaces) {
  NurbsCurve polygon{
      1, {0, 0, 1, 2, 2}, {{kFar, kFar}, {kFar + 1.0, kFar}, {kFar + 1.0, kFar + 1.0}}, {1, 1, 1}};
  const auto pieces = drawn_spans(polygon);
  ASSERT_EQ(pieces.size(), 2U);
  EXPECT_EQ(start_point(pieces[0]), (Vec2{kFar, kFar}));
  EXPECT_EQ(end_point(pieces[1]), (Vec2{kFar + 1.0, kFar + 1.0}));
}

}  // namespace
}  // namespace obvid
