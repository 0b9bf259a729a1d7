// SPDX-License-Identifier: Apache-2.0
// Contours whose joints are continuous in position only.
#include <gtest/gtest.h>

#include <cmath>
#include <functional>

#include "../common/angles.h"
#include "contours.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::closed_contour;
using testing_data::contour_of;
using testing_data::expect_refused;

/// Every joint where two pieces meet becomes a corner with the heading and curvature of both.
Contour with_corners(Contour contour) {
  const std::size_t n = contour.pieces.size();
  for (std::size_t j = contour.closed ? 0 : 1; j < n; ++j) {
    Joint& joint = contour.joints[j];
    joint.leaving = joint.element;
    const Jet before = evaluate(contour.pieces[(j + n - 1) % n], 1.0);
    joint.element.theta = heading(before.d1);
    joint.element.kappa = curvature(before);
  }
  return contour;
}

Contour rectangle() {
  return with_corners(closed_contour({LinePiece{{0, 0}, {3, 0}}, LinePiece{{3, 0}, {3, 1}},
                                      LinePiece{{3, 1}, {0, 1}}, LinePiece{{0, 1}, {0, 0}}},
                                     {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}, {3, 3, 0}}));
}

/// Two arcs over the chord from (-1, 0) to (1, 0); the upper one's curvature is `ratio` times as
/// large.
Contour lens(double ratio) {
  const auto over_chord = [](Vec2 from, double theta, double kappa) {
    const double half = std::asin(kappa);  // of a chord of length 2
    return arc_from(from, theta - half, kappa, 2.0 * half / kappa);
  };
  return with_corners(
      closed_contour({over_chord({-1, 0}, 0.0, 0.5), over_chord({1, 0}, kPi, 0.5 * ratio)},
                     {{0, 0, 0}, {1, 1, 0}}));
}

/// Half of y = x^2 up to its vertex, a corner, the same half again: curvature falls at the corner.
Contour two_branches() {
  const RationalBezier rise{{}, 2, {Vec2{-1, 1}, {-0.5, 0}, {0, 0}}, {1, 1, 1}};
  const RationalBezier again{{}, 2, {Vec2{0, 0}, {0.5, -1}, {1, -1}}, {1, 1, 1}};
  return with_corners(contour_of({rise, again}, {{0, 0, 1}, {1, 1, 1}}));
}

TEST(Corners, RectangleHasFourCornersAndNoVertex) {
  const Certificate certificate = certify(rectangle());
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.corners, 4);
  EXPECT_EQ(certificate.vertices, 0);
  EXPECT_EQ(certificate.inflections, 0);
  EXPECT_EQ(certificate.self_intersections, 0);
}

TEST(Corners, GapsAreThoseOfTheSmoothJointsOnly) {
  const Certificate certificate = certify(rectangle());
  EXPECT_EQ(certificate.gaps.heading, 0.0) << "its corners turn by pi / 2";
  EXPECT_EQ(certify(two_branches()).gaps.curvature, 0.0) << "2 before the corner, less after it";
}

TEST(Corners, LensOfEqualArcsHasNoVertex) {
  const Certificate certificate = certify(lens(1.0));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.corners, 2);
  EXPECT_EQ(certificate.vertices, 0);
}

TEST(Corners, LensOfUnequalArcsHasTheVerticesOfItsTwoLeaps) {
  EXPECT_EQ(certify(lens(1.5)).vertices, 2);
  EXPECT_EQ(certify(lens(1.00001)).vertices, 2);
}

TEST(Corners, WhatIterationsLeaveOfEqualCurvaturesIsNoLeap) {
  const Certificate certificate = certify(lens(1.0 + 1e-9));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.vertices, 0);
}

TEST(Corners, FallBetweenTwoRisesIsTwoVertices) {
  const Certificate certificate = certify(two_branches());
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.corners, 1);
  EXPECT_EQ(certificate.vertices, 2);
}

TEST(Corners, RunOverACornerIsRefused) {
  // both lines have the same curvature, but nested circles end at a corner
  Contour contour =
      with_corners(contour_of({LinePiece{{0, 0}, {3, 0}}, LinePiece{{3, 0}, {1, 2}}}, {{0, 1, 0}}));
  expect_refused(contour, "one run over a corner");
  contour.runs = {{0, 0, 0}, {1, 1, 0}};
  EXPECT_TRUE(certify(contour).proved);
}

TEST(Corners, CornerThatIsNotDeclaredIsRefused) {
  const Contour good = two_branches();
  for (const bool keep_leaving : {false, true}) {
    Contour contour = good;
    if (keep_leaving) contour.joints[1].element = *contour.joints[1].leaving;
    contour.joints[1].leaving.reset();
    expect_refused(contour, "a corner without its flag");
  }
}

TEST(Corners, EachSideMustAgreeWithItsPiece) {
  for (const Contour& good : {two_branches(), lens(1.5)}) {
    ASSERT_TRUE(certify(good).proved);
    const std::function<void(Joint&)> changes[] = {
        [](Joint& j) { j.element.theta += 1e-7; },
        [](Joint& j) { j.leaving->theta += 1e-7; },
        [](Joint& j) { j.element.kappa *= 1 + 1e-7; },
        [](Joint& j) { j.leaving->kappa *= 1 + 1e-7; },
        [](Joint& j) { j.element.point.x += 1e-7; },
        [](Joint& j) { j.leaving->point.x += 1e-7; },
        [](Joint& j) { j.leaving->theta = NAN; },
        [](Joint& j) { j.leaving->kappa = NAN; },
        [](Joint& j) { std::swap(j.element.theta, j.leaving->theta); },
    };
    for (std::size_t k = 0; k < std::size(changes); ++k) {
      Contour contour = good;
      changes[k](contour.joints[1]);
      expect_refused(contour, "change " + std::to_string(k));
    }
  }
}

TEST(Corners, PiecesMustMeet) {
  Contour contour = rectangle();
  std::get<LinePiece>(contour.pieces[1]).start.y += 1e-7;
  expect_refused(contour, "a gap at a corner");
}

TEST(Corners, EndOfAnOpenContourIsNoCorner) {
  const Contour good = two_branches();
  for (const std::size_t end : {std::size_t{0}, good.joints.size() - 1}) {
    Contour contour = good;
    contour.joints[end].leaving = contour.joints[end].element;
    expect_refused(contour, "a corner at an end");
  }
}

TEST(Corners, WhatIsPartedOnASmoothJointIsNoCornerAndOnlyWeakensTheClaim) {
  const RationalBezier whole{{}, 2, {Vec2{0, 0}, {0.5, 0}, {1, 1}}, {1, 1, 1}};
  const auto [a, b] = split(whole, 0.5);
  const Certificate certificate =
      certify(with_corners(contour_of({a, b}, {{0, 0, -1}, {1, 1, -1}})));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.corners, 0);  // the heading goes on
  EXPECT_EQ(certificate.curvature_steps, 1);
  EXPECT_EQ(certificate.vertices, 0);
}

TEST(Corners, LinesThatCrossAfterCornersAreCounted) {
  const Certificate certificate = certify(with_corners(
      contour_of({LinePiece{{0, 0}, {4, 0}}, LinePiece{{4, 0}, {2, 3}}, LinePiece{{2, 3}, {2, -3}}},
                 {{0, 0, 0}, {1, 1, 0}, {2, 2, 0}})));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_EQ(certificate.self_intersections, 1);
}

}  // namespace
}  // namespace obvid
