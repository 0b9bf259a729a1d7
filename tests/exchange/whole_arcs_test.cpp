// SPDX-License-Identifier: Apache-2.0
#include "obvid/exchange/internal/whole_arcs.h"

#include <gtest/gtest.h>

#include <cmath>
#include <variant>

namespace obvid {
namespace {

/// Parts of a unit circle around `centre`, ten degrees each; each begins `turned` more to the left
/// than the one before ends.
std::vector<Piece> parts_of_a_circle(Vec2 centre, int count, double turned) {
  constexpr double kPart = 3.14159265358979323846 / 18.0;
  std::vector<Piece> out;
  Vec2 at = centre + Vec2{0.0, -1.0};
  for (int i = 0; i < count; ++i) {
    const double heading = i * (kPart + turned);
    const double middle = heading + 0.5 * kPart, chord = 2.0 * std::sin(0.5 * kPart);
    const Vec2 end = at + Vec2{chord * std::cos(middle), chord * std::sin(middle)};
    out.emplace_back(ArcPiece{at, end, heading, 1.0, kPart});
    at = end;
  }
  return out;
}

TEST(WholeArcs, PartsOfACircleAreOne) {
  EXPECT_EQ(exchange::whole_arcs(parts_of_a_circle({3.0, 4.0}, 36, 0.0)).size(), 1U);
  EXPECT_EQ(exchange::whole_arcs(parts_of_a_circle({1.6e6, -0.5e6}, 36, 0.0)).size(), 1U);
}

/// Headings that creep by what rounding could explain once: the ends of what is written would leave
/// the parts by 36 times that.
TEST(WholeArcs, EndWhereTheirPartsEndHoweverFarTheOriginIs) {
  constexpr double kDistance = 1.6e6, kRounding = 1.1102230246251565e-16;
  const auto parts = parts_of_a_circle({kDistance, 0.0}, 30, 5e-9);
  for (const Piece& piece : exchange::whole_arcs(parts)) {
    const auto& arc = std::get<ArcPiece>(piece);
    const double half = 0.5 * arc.length, chord = 2.0 * std::sin(half);
    const Vec2 reached =
        arc.start + Vec2{chord * std::cos(arc.theta0 + half), chord * std::sin(arc.theta0 + half)};
    EXPECT_LE(norm(reached - arc.end), 20.0 * kRounding * kDistance);
  }
}

}  // namespace
}  // namespace obvid
