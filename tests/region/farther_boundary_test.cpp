// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/farther_boundary.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "known_spirals.h"
#include "obvid/curve/internal/clothoid.h"

namespace obvid {
namespace {

/// Distance from an arc of a circle, sampled densely: independent of how feet are found.
double from_boundary(const ChordFrame& f, const Boundary& b, Vec2 p) {
  constexpr int kSteps = 1600;
  double least = HUGE_VAL;
  Vec2 at = {};
  Vec2 tangent = f.start_tangent;
  const auto arc = [&](double kappa, Vec2 until) {
    const double turn = std::atan2(cross(tangent, until), dot(tangent, until));
    const double theta = std::atan2(tangent.y, tangent.x);
    const auto place = [&](double t) {
      return at + Vec2{(std::sin(theta + t * turn) - std::sin(theta)) / kappa,
                       (std::cos(theta) - std::cos(theta + t * turn)) / kappa};
    };
    Vec2 before = at;
    for (int k = 1; k <= kSteps; ++k) {  // from the chord: its sagitta is some 2e-7
      const Vec2 here = place(static_cast<double>(k) / kSteps), chord = here - before;
      const double part = std::clamp(dot(p - before, chord) / dot(chord, chord), 0.0, 1.0);
      least = std::min(least, norm(before + part * chord - p));
      before = here;
    }
    at = before;
    tangent = until;
  };
  arc(b.kappa_first, b.joint_tangent);
  arc(b.kappa_second, f.end_tangent);
  return least;
}

TEST(FartherBoundary, BoundsEveryPlaceOfSeveralArcsAndIsAttained) {
  // arcs of growing curvature: the distance has a peak of its own on each of them
  std::mt19937 random(11);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  for (int trial = 0; trial < 12; ++trial) {
    std::vector<Piece> arcs;
    Vec2 at = {};
    double theta = 0.0, kappa = 0.2;
    const int count = 2 + trial % 4;
    for (int k = 0; k < count; ++k) {
      const double length = 0.2 + unit(random), turn = kappa * length;
      const Vec2 end = at + (2.0 * std::sin(0.5 * turn) / kappa) * unit_at(theta + 0.5 * turn);
      arcs.emplace_back(ArcPiece{at, end, theta, kappa, length});
      at = end;
      theta += turn;
      kappa += 0.02 + 0.2 * unit(random);
    }
    const Element start = {{}, 0.0, 0.19}, end = {at, theta, kappa};
    const ChordFrame f = chord_frame(start, end);
    const auto region = segment_region(f, 1);
    ASSERT_TRUE(region);
    const Vec2 along = at / norm(at);
    const FartherBoundary found = farther_boundary({arcs, 0.0, 1.0}, {f, *region, {}, along});
    double most = 0.0;
    for (const Piece& arc : arcs) {
      for (int k = 0; k <= 40; ++k) {
        const Vec2 p = evaluate(arc, k / 40.0).point;
        const Vec2 local = {dot(along, p), cross(along, p)};
        most = std::max({most, std::min(from_boundary(f, region->from_start, local), HUGE_VAL),
                         from_boundary(f, region->to_end, local)});
      }
    }
    EXPECT_GE(found.distance, most * (1.0 - 1e-5)) << trial;
    EXPECT_LE(found.distance, most * 1.01) << trial;  // of a fortieth of an arc
  }
}

/// Pieces of one clothoid between these lengths.
std::vector<Piece> clothoid_cut_at(double kappa0, double slope,
                                   const std::vector<double>& lengths) {
  std::vector<Piece> pieces;
  Vec2 at = {};
  for (std::size_t k = 0; k + 1 < lengths.size(); ++k) {
    const double s = lengths[k];
    const double length = lengths[k + 1] - s, theta = kappa0 * s + 0.5 * slope * s * s;
    const double first = kappa0 + slope * s, last = kappa0 + slope * lengths[k + 1];
    const Vec2 end = at + clothoid_step(theta, first, last, length);
    pieces.emplace_back(ClothoidPiece{at, end, theta, first, last, length});
    at = end;
  }
  return pieces;
}

TEST(FartherBoundary, DoesNotDependOnHowThePathIsCut) {
  constexpr double kKappa = -0.3, kSlope = 1.1, kLength = 1.4;
  const auto whole = clothoid_cut_at(kKappa, kSlope, {0.0, kLength});
  const Vec2 last = end_point(whole.front());
  const Element start = {{}, 0.0, kKappa};
  const Element end = {last, kKappa * kLength + 0.5 * kSlope * kLength * kLength,
                       kKappa + kSlope * kLength};
  const ChordFrame f = chord_frame(start, end);
  const auto region = segment_region(f, 1);
  ASSERT_TRUE(region);
  const Vec2 along = last / norm(last);
  const double alone = farther_boundary({whole, 0.0, 1.0}, {f, *region, {}, along}).distance;
  for (const std::vector<double>& cuts : {std::vector<double>{0.0, 1e-6, 2e-6, 0.7, kLength},
                                          {0.0, 0.3, 0.3 + 1e-7, kLength},
                                          {0.0, 0.69, 0.7, 0.7001, 0.71, kLength},
                                          {0.0, 1.0, 1.1, 1.2, 1.3, kLength}}) {
    const auto pieces = clothoid_cut_at(kKappa, kSlope, cuts);
    const double cut = farther_boundary({pieces, 0.0, 1.0}, {f, *region, {}, along}).distance;
    EXPECT_NEAR(cut / alone, 1.0, 1e-5);
  }
}

}  // namespace
}  // namespace obvid
