// SPDX-License-Identifier: Apache-2.0
// Slopes of curvature at joints: two parts of one cubic agree, a doctored one does not; and proofs
// that know pieces already.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "contours.h"

namespace obvid {
namespace {

constexpr double kFrom = 0.0625, kSplit = 0.1875, kTo = 0.3125;

/// y = x^3 from a to b as a quartic: its curvature grows as long as 45 x^4 < 1.
RationalBezier cubic_part(double a, double b) {
  const Vec2 p0{a, a * a * a}, p1{(2 * a + b) / 3, a * a * b}, p2{(a + 2 * b) / 3, a * b * b},
      p3{b, b * b * b};
  return {{},
          4,
          {p0, 0.25 * (p0 + 3.0 * p1), 0.5 * (p1 + p2), 0.25 * (3.0 * p2 + p3), p3},
          {1, 1, 1, 1, 1}};
}

/// d kappa/ds of y = x^3.
double slope_of_cubic(double x) {
  const double q = x * x * x * x;
  return 6.0 * (1.0 - 45.0 * q) / std::pow(1.0 + 9.0 * q, 3.0);
}

/// Both parts; the fourth control point of the second one moved to the left by `by`.
Contour two_parts(double by) {
  RationalBezier second = cubic_part(kSplit, kTo);
  const Vec2 leg = second.offset[1] - second.offset[0];
  second.offset[3] = second.offset[3] + by / norm(leg) * left_normal(leg);
  Contour out = testing_data::contour_of({cubic_part(kFrom, kSplit), second}, {{0, 1, 1}});
  out.continuity = Continuity::kG3;
  return out;
}

/// What such a move changes of the slope at the joint: (n - 1)(n - 2)/n^2 v1 x v/|v1|^4
/// (docs/methods/g3.md, section 4), of the largest slope.
double expected_gap(double by) {
  const RationalBezier second = cubic_part(kSplit, kTo);
  const double leg = norm(second.offset[1] - second.offset[0]);
  return 6.0 / 16.0 * by / (leg * leg * leg) / slope_of_cubic(kFrom);
}

TEST(Slopes, OfTwoPartsOfOneCubicAgree) {
  const Certificate found = certify(two_parts(0.0));
  EXPECT_TRUE(found.proved) << found.reason;
  ASSERT_TRUE(found.gaps.slope.has_value());
  EXPECT_LT(*found.gaps.slope, 1e-11);
  EXPECT_EQ(found.slope_steps, 0);
  EXPECT_EQ(found.joints, 1);
  EXPECT_EQ(found.smooth_joints(), 1);
}

TEST(Slopes, ThatWereDoctoredAreRefused) {
  for (const double by : {3e-10, 3e-9, -3e-8}) {
    const Certificate found = certify(two_parts(by));
    ASSERT_TRUE(found.gaps.slope.has_value());
    EXPECT_NEAR(*found.gaps.slope, expected_gap(std::abs(by)), 1e-3 * expected_gap(std::abs(by)));
    const bool within = expected_gap(std::abs(by)) < 1e-6;
    EXPECT_EQ(found.proved, within) << by;
    if (!within) {
      EXPECT_NE(found.reason.find("the gap of the slope of curvature at joint 2"),
                std::string::npos)
          << found.reason;
    }
  }
  EXPECT_LT(expected_gap(3e-10), 1e-6);
  EXPECT_GT(expected_gap(3e-9), 1e-6);
}

TEST(Slopes, ThatAreSaidToStepAreCountedAndNoGap) {
  Contour contour = two_parts(-3e-8);
  contour.joints[1].slope_step = true;
  const Certificate found = certify(contour);
  EXPECT_TRUE(found.proved) << found.reason;
  EXPECT_EQ(found.slope_steps, 1);
  EXPECT_EQ(found.smooth_joints(), 0);
  EXPECT_EQ(found.gaps.slope, 0.0);
}

TEST(Slopes, AreNoClaimOfAContourThatIsG2) {
  Contour contour = two_parts(-3e-8);
  contour.continuity = Continuity::kG2;
  const Certificate found = certify(contour);
  EXPECT_TRUE(found.proved) << found.reason;
  EXPECT_FALSE(found.gaps.slope.has_value());
}

void expect_same(const Certificate& a, const Certificate& b) {
  EXPECT_EQ(a.proved, b.proved);
  EXPECT_EQ(a.reason, b.reason);
  EXPECT_EQ(a.gaps.position, b.gaps.position);
  EXPECT_EQ(a.gaps.heading, b.gaps.heading);
  EXPECT_EQ(a.gaps.curvature, b.gaps.curvature);
  EXPECT_EQ(a.gaps.slope, b.gaps.slope);
  ASSERT_EQ(a.pieces.size(), b.pieces.size());
  for (std::size_t i = 0; i < a.pieces.size(); ++i) {
    EXPECT_EQ(a.pieces[i].verdict, b.pieces[i].verdict);
  }
}

TEST(KnownPieces, LeadToTheSameCertificate) {
  Watch watch;
  PieceMemory memory;
  Contour contour = two_parts(0.0);
  expect_same(certify(contour, memory, watch), certify(contour));
  expect_same(certify(contour, memory, watch), certify(contour));
  for (const double by : {3e-9, 0.0, 2e-3, -1e-7}) {  // 2e-3 is no spiral any more
    contour = two_parts(by);
    memory.replace(1, 2, 1);
    expect_same(certify(contour, memory, watch), certify(contour));
  }
  // one piece in place of two, and two again; another continuity
  const Contour one = testing_data::contour_of({cubic_part(kFrom, kTo)}, {{0, 0, 1}});
  memory.replace(0, 2, 1);
  expect_same(certify(one, memory, watch), certify(one));
  memory.replace(0, 1, 2);
  contour = two_parts(3e-9);
  expect_same(certify(contour, memory, watch), certify(contour));
  contour.continuity = Continuity::kG2;
  expect_same(certify(contour, memory, watch), certify(contour));
}

}  // namespace
}  // namespace obvid
