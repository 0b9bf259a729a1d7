// SPDX-License-Identifier: Apache-2.0
// Nearest places of points that move along a path, against all places of the path.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../common/angles.h"
#include "../common/arcs.h"
#include "obvid/curve/internal/nearest_along.h"

namespace obvid {
namespace {

/// Line, half a circle, line back: a hairpin whose legs lie 2 apart.
std::vector<Piece> hairpin() {
  return {LinePiece{{0, 0}, {10, 0}}, arc_from({10, 0}, 0.0, 1.0, kPi), LinePiece{{10, 2}, {0, 2}}};
}

double nearest_of_all(const std::vector<Piece>& path, Vec2 p) {
  double least = HUGE_VAL;
  for (const Piece& piece : path) {
    for (int k = 0; k <= 4000; ++k) {
      least = std::min(least, norm(evaluate(piece, k / 4000.0).point - p));
    }
  }
  return least;
}

TEST(NearestAlong, FollowsAPathRoundAHairpin) {
  const std::vector<Piece> path = hairpin();
  NearestAlong along(path);
  for (const Piece& piece : path) {
    for (int k = 0; k <= 50; ++k) {
      const Jet jet = evaluate(piece, k / 50.0);
      const Vec2 p = jet.point + (0.1 / norm(jet.d1)) * left_normal(jet.d1);
      const NearestAlong::Place place = along.next(p);
      EXPECT_NEAR(place.distance, nearest_of_all(path, p), 1e-3) << k;
      EXPECT_NEAR(norm(evaluate(path[place.piece], place.t).point - p), place.distance, 1e-15);
    }
  }
}

TEST(NearestAlong, TakesThePassAlongside) {
  // twice through the same place: on the way there it is the first leg, on the way back the last
  const std::vector<Piece> path = {LinePiece{{0, 0}, {10, 0}}, LinePiece{{10, 0}, {10, 5}},
                                   LinePiece{{10, 5}, {5, 5}}, LinePiece{{5, 5}, {5, -5}}};
  NearestAlong along(path);
  EXPECT_EQ(along.next({1.0, 0.02}).piece, 0U);
  EXPECT_EQ(along.next({4.99, 0.02}).piece, 0U);
  EXPECT_EQ(along.next({9.0, 0.02}).piece, 0U);
  EXPECT_EQ(along.next({9.98, 2.0}).piece, 1U);
  EXPECT_EQ(along.next({7.0, 5.02}).piece, 2U);
  EXPECT_EQ(along.next({5.02, 0.01}).piece, 3U);
}

TEST(NearestAlong, IsNeverNearerThanTheNearestPoint) {
  const std::vector<Piece> path = hairpin();
  NearestAlong along(path);
  for (int k = 0; k < 200; ++k) {  // whatever jumps about
    const Vec2 p{12.0 * std::sin(7.0 * k), 3.0 * std::cos(5.0 * k)};
    EXPECT_GE(along.next(p).distance, nearest_of_all(path, p) - 1e-3) << k;
  }
}

}  // namespace
}  // namespace obvid
