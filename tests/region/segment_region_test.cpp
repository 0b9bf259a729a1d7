// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/segment_region.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "../common/angles.h"
#include "known_spirals.h"
#include "obvid/region/internal/arcs_over_chord.h"

namespace obvid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
/// Rounding of sampled ordinates, relative to the chord.
constexpr double kSlack = 1e-13;

/// Clothoid pieces with headings within a right angle of their chord.
struct Clothoid {
  double k0, rate, length;
};

std::vector<Clothoid> clothoids() {
  std::vector<Clothoid> all;
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  while (all.size() < 200) {
    const double k0 = 1.2 * unit(random), change = std::exp(3.0 * unit(random) - 2.0);
    if (std::abs(k0) + std::abs(change) < 1.4) all.push_back({k0, change, 1.0});
  }
  return all;
}

ChordFrame frame_of(const Clothoid& c) {
  return chord_frame(known::clothoid(c.k0, c.rate, 0.0), known::clothoid(c.k0, c.rate, c.length));
}

TEST(SegmentRegion, CircleArcHasNoWidth) {
  for (const double turn : {0.01, 0.5, 1.5}) {
    for (const int direction : {-1, 1}) {
      const Element a{{0.0, 0.0}, -turn, 2.0}, b{{std::sin(turn), 0.0}, turn, 2.0};
      const auto region = segment_region(chord_frame(a, b), direction);
      ASSERT_TRUE(region) << turn;
      EXPECT_LE(region->width, 1e-15);
      EXPECT_NEAR(region->lower_height, 0.5 * (1.0 - std::cos(turn)), 1e-15);
    }
  }
}

TEST(SegmentRegion, StraightSegmentHasNoWidth) {
  const auto region = segment_region(chord_frame({{0, 0}, 0, 0}, {{5, 0}, 0, 0}), 1);
  ASSERT_TRUE(region);
  EXPECT_EQ(region->width, 0.0);
  EXPECT_EQ(region->lower_height, 0.0);
}

TEST(SegmentRegion, ClothoidLiesInsideAndItsNeighboursAcrossTheWidthDoNot) {
  for (const Clothoid& c : clothoids()) {
    const ChordFrame frame = frame_of(c);
    const auto region = segment_region(frame, 1);
    ASSERT_TRUE(region);
    const Element end = known::clothoid(c.k0, c.rate, c.length);
    for (int j = 1; j < 20; ++j) {
      const Vec2 p = known::clothoid(c.k0, c.rate, c.length * j / 20.0).point;
      const Vec2 local = known::in_frame(p, {}, end.point);
      EXPECT_TRUE(contains(*region, frame, local, kSlack)) << c.k0 << " " << c.rate;
      const double off = region->width + 2.0 * kSlack;
      EXPECT_FALSE(contains(*region, frame, {local.x, local.y + off}, kSlack));
      EXPECT_FALSE(contains(*region, frame, {local.x, local.y - off}, kSlack));
    }
  }
}

TEST(SegmentRegion, WidthBoundsTheDistanceOfTwoSpiralsWithTheSameData) {
  double closest = 0.0;
  for (const Clothoid& c : clothoids()) {
    const ChordFrame f = frame_of(c);
    const auto region = segment_region(f, 1);
    ASSERT_TRUE(region);
    const double alpha = heading(f.start_tangent), beta = heading(f.end_tangent);
    const Element end = known::clothoid(c.k0, c.rate, c.length);
    for (int j = 1; j < 20; ++j) {
      const Vec2 q = known::hyperbola_image(f.h, alpha, beta, f.kappa_start, f.kappa_end, j / 20.0);
      EXPECT_TRUE(contains(*region, f, q, 1e-10)) << c.k0 << " " << c.rate;
      double nearest = kInfinity;
      for (int k = 0; k <= 400; ++k) {
        const Vec2 p = known::clothoid(c.k0, c.rate, c.length * k / 400.0).point;
        const Vec2 v = known::in_frame(p, {}, end.point) - q;
        const Vec2 t = unit_at(alpha + c.k0 * k / 400.0 + 0.5 * c.rate * (k / 400.0) * (k / 400.0));
        if (std::abs(dot(v, t)) < 0.002) nearest = std::min(nearest, std::abs(cross(v, t)));
      }
      EXPECT_LE(nearest, region->width + 1e-10);
      closest = std::max(closest, nearest / region->width);
    }
  }
  EXPECT_GT(closest, 0.0);  // the two curves are not the same
}

TEST(SegmentRegion, WidthFallsByAboutEightPerHalving) {
  double before = 0.0;
  for (const double length : {0.8, 0.4, 0.2, 0.1, 0.05}) {
    const auto region = segment_region(frame_of({0.6, 1.0, length}), 1);
    ASSERT_TRUE(region);
    const double ratio = before > 0.0 ? before / region->width : 8.0;
    EXPECT_NEAR(ratio, 8.0, 0.8) << length;
    before = region->width;
  }
}

TEST(SegmentRegion, UnknownEndCurvaturesGiveAWiderRegion) {
  for (const Clothoid& c : clothoids()) {
    ChordFrame frame = frame_of(c);
    const auto known_ends = segment_region(frame, 1);
    frame.kappa_start = -kInfinity;
    const auto open_start = segment_region(frame, 1);
    ASSERT_TRUE(known_ends && open_start);
    EXPECT_GE(open_start->parallel_width, known_ends->parallel_width * (1.0 - 1e-9));
  }
}

TEST(SegmentRegion, MirrorImageAndReversalHaveTheSameSize) {
  for (const Clothoid& c : clothoids()) {
    const Element a = known::clothoid(c.k0, c.rate, 0.0), b = known::clothoid(c.k0, c.rate, 1.0);
    const auto region = segment_region(chord_frame(a, b), 1);
    const auto flip = [](Element e) {
      return Element{{e.point.x, -e.point.y}, -e.theta, -e.kappa};
    };
    const auto back = [](Element e) {
      return Element{e.point, e.theta + std::acos(-1.0), -e.kappa};
    };
    const auto mirrored = segment_region(chord_frame(flip(a), flip(b)), -1);
    // walked backwards, curvature changes its sign and its order: it still increases
    const auto reversed = segment_region(chord_frame(back(b), back(a)), 1);
    ASSERT_TRUE(region && mirrored && reversed);
    EXPECT_NEAR(mirrored->width, region->width, 1e-15);
    EXPECT_NEAR(reversed->width, region->width, 1e-14);
  }
}

TEST(SegmentRegion, BoundariesThatRunBackOverTheChordAreAsWideAsTheirArcs) {
  // headings of -65 and 109 degrees, curvatures far apart: arcs of the boundaries turn beyond the
  // opposite of the chord. Their heights by small steps along them
  const ChordFrame f = chord_frame({{0.0, 0.0}, -1.1535, -0.157}, {{65.4062, 0.0}, 1.8992, 0.2572});
  const auto region = segment_region(f, 1);
  ASSERT_TRUE(region);
  struct Reach {
    double high = 0.0, low = 0.0;
  };
  const auto walk = [&](const Boundary& b) {
    Reach reach;
    Vec2 at = {};
    double theta = -1.1535;
    const auto arc = [&](double kappa, Vec2 until) {
      const double to = std::atan2(until.y, until.x);
      double turn = std::fmod(to - theta, 2.0 * kPi);
      if (turn * kappa < 0.0) turn += std::copysign(2.0 * kPi, kappa);
      constexpr int kSteps = 20000;
      for (int k = 1; k <= kSteps; ++k) {
        const double now = theta + turn * k / kSteps;
        const double y = at.y + (std::cos(theta) - std::cos(now)) / kappa;
        reach.high = std::max(reach.high, y);
        reach.low = std::min(reach.low, y);
      }
      at = at + Vec2{(std::sin(theta + turn) - std::sin(theta)) / kappa,
                     (std::cos(theta) - std::cos(theta + turn)) / kappa};
      theta += turn;
    };
    arc(b.kappa_first, b.joint_tangent);
    arc(b.kappa_second, f.end_tangent);
    EXPECT_NEAR(at.x, f.h, 1e-3 * f.h);  // the headings are rounded
    EXPECT_NEAR(at.y, 0.0, 1e-3 * f.h);
    return reach;
  };
  const Reach a = walk(region->from_start), b = walk(region->to_end);
  const double width = std::max(std::abs(a.high - b.high), std::abs(a.low - b.low));
  EXPECT_GT(width, 20.0);
  EXPECT_NEAR(region->width, width, 1e-6 * width);
}

/// Ordinate of a boundary in long double, with cosines of its angles: each arc from its own end of
/// the chord, whose heading it leaves with the sine s and the cosine c.
long double precise(long double s, long double c, long double k, long double x) {
  const long double then = std::sqrt(std::max(0.0L, c * c - k * x * (2.0L * s + k * x)));
  return x * (2.0L * s + k * x) / (c + then);
}

TEST(SegmentRegion, BesideARightAngleAtAnEndTheWidthIsThatOfItsArcs) {
  // fit through 15 measured points, series 943,560 of seed 301; cosines of sines were off by 2e-6
  const double h = 0.22094901890617644, alpha = 1.5559517022367513;
  for (const double beside : {7.857e-10, 3e-9, 1e-8, 1e-7}) {
    const double beta = beside - kRightAngle;
    const ChordFrame f{h,
                       unit_at(alpha),
                       {std::sin(beside), -std::cos(beside)},
                       -8.906285081346827,
                       -9.177525427176613};
    const auto region = segment_region(f, -1);
    ASSERT_TRUE(region);
    const auto ordinate = [&](const Boundary& b, long double x) {
      const long double joint = joint_abscissa(f, b.kappa_first, b.kappa_second, b.joint_tangent);
      if (x <= joint)
        return precise(std::sin(static_cast<long double>(alpha)),
                       std::cos(static_cast<long double>(alpha)), b.kappa_first, x);
      return -precise(-std::cos(static_cast<long double>(beside)),
                      std::sin(static_cast<long double>(beside)), -b.kappa_second, h - x);
    };
    long double most = 0.0L;
    constexpr int kPlaces = 200000;
    for (int k = 1; k < kPlaces; ++k) {
      const long double x = h * (1.0L - std::pow(static_cast<long double>(k) / kPlaces, 4.0L));
      most =
          std::max(most, std::abs(ordinate(region->from_start, x) - ordinate(region->to_end, x)));
    }
    EXPECT_GE(region->width, static_cast<double>(most) * (1.0 - 1e-9)) << beta;
  }
}

TEST(SegmentRegion, WrongDirectionHasNoRegion) {
  for (const Clothoid& c : clothoids()) {
    EXPECT_FALSE(segment_region(frame_of(c), -1)) << c.rate;
  }
}

TEST(SegmentRegion, EndCirclesOnTheWrongSideOfTheChordCirclesHaveNoRegion) {
  // chord 2: the circle through both ends that is tangent at the start has curvature -sin(alpha)
  const double alpha = -0.2, beta = 0.4;
  const auto frame = [&](double k0, double k1) {
    return chord_frame({{0, 0}, alpha, k0}, {{2, 0}, beta, k1});
  };
  const double start = std::sin(0.2), end = std::sin(0.4);
  EXPECT_TRUE(segment_region(frame(start - 0.1, end + 0.11), 1));
  EXPECT_FALSE(segment_region(frame(start + 1e-9, end + 0.11), 1));
  EXPECT_FALSE(segment_region(frame(start - 0.1, end - 1e-9), 1));
}

TEST(SegmentRegion, OnTheBiarcBothBoundariesAgree) {
  const double alpha = -0.2, beta = 0.4, k0 = 0.1, q = std::pow(std::sin(0.1), 2);
  const double k1 = std::sin(beta) + q / -(k0 + std::sin(alpha));
  const auto region = segment_region(chord_frame({{0, 0}, alpha, k0}, {{2, 0}, beta, k1}), 1);
  ASSERT_TRUE(region);
  EXPECT_NEAR(region->width, 0.0, 1e-15);
}

TEST(SegmentRegion, BoundariesMeetTheEndsOfTheChord) {
  for (const Clothoid& c : clothoids()) {
    const ChordFrame frame = frame_of(c);
    const auto region = segment_region(frame, 1);
    ASSERT_TRUE(region);
    for (const Boundary& b : {region->from_start, region->to_end}) {
      EXPECT_NEAR(boundary_ordinate(frame, b, 0.0).value(), 0.0, 1e-15);
      EXPECT_NEAR(boundary_ordinate(frame, b, frame.h).value(), 0.0, 1e-15);
      EXPECT_GE(b.highest, 0.0);
      EXPECT_LE(b.lowest, 0.0);
    }
  }
}

TEST(SegmentRegion, KnowsArcsOfNearlyAWholeTurnFromRounding) {
  // over a chord of length 40: out backwards, around and in from behind, the curvature falling
  const double h = 40.0, alpha = -2.66, beta = 2.65, sine = std::sin(0.5 * (alpha + beta));
  const double k0 = -2.0 * std::sin(alpha) / h * 1.002, k1 = k0 * 0.9;
  const double B = -0.5 * k1 * h - std::sin(-beta);  // in the mirror image
  ASSERT_GT(B, 0.0);
  const double second = -2.0 / h * (-std::sin(-alpha) - sine * sine / B);
  const ChordFrame frame = chord_frame({{0.0, 0.0}, alpha, k0}, {{h, 0.0}, beta, k1});
  const auto region = segment_region(frame, -1);
  ASSERT_TRUE(region);
  // both first arcs turn by some 300 degrees, to where they run along the chord and on
  const double rise = 1.0 - std::cos(alpha);
  EXPECT_NEAR(region->from_start.lowest, -rise / k0, 1e-9);
  EXPECT_NEAR(region->to_end.lowest, -rise / second, 1e-9);
  EXPECT_NEAR(region->from_start.highest, 0.0, 1e-9);
  EXPECT_NEAR(region->to_end.highest, 0.0, 1e-9);
}

}  // namespace
}  // namespace obvid
