// SPDX-License-Identifier: Apache-2.0
// Points with tolerances are met one after the other, or they are not met.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "contours.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::contour_of;

constexpr double kPi = std::numbers::pi;

Vec2 on_ring(double angle, double radius) { return Vec2{3, -2} + radius * unit_at(angle); }

/// Circle of radius 5 from angle 0 in arcs of half a radian; no joint stands on a point.
Contour circle(int arcs, std::vector<Vec2> points, double tolerance) {
  std::vector<Piece> pieces;
  for (int k = 0; k < arcs; ++k) {
    pieces.emplace_back(arc_from(on_ring(0.5 * k, 5.0), 0.5 * k + kPi / 2, 0.2, 2.5));
  }
  Contour contour = contour_of(std::move(pieces), {{0, static_cast<std::size_t>(arcs) - 1, 0}});
  contour.carrier = Carrier::kArcs;
  for (Joint& joint : contour.joints) joint.source.reset();
  contour.points = std::move(points);
  contour.point_tolerance.assign(contour.points.size(), tolerance);
  return contour;
}

std::vector<Vec2> points_at(const std::vector<double>& angles) {
  std::vector<Vec2> points;
  for (const double a : angles) points.push_back(on_ring(a, 5.0));
  return points;
}

TEST(PointOrder, PointsAlongTheContourAreMet) {
  EXPECT_TRUE(certify(circle(6, points_at({0.1, 0.9, 1.0, 2.2, 2.9}), 0.01)).through_points);
}

TEST(PointOrder, APointThatStandsBeforeItsPredecessorIsNotMet) {
  const Certificate certificate = certify(circle(6, points_at({0.1, 1.0, 0.9, 2.2, 2.9}), 0.01));
  EXPECT_FALSE(certificate.through_points);
  EXPECT_FALSE(certificate.proved);
  EXPECT_NE(certificate.reason.find("point 3 after"), std::string::npos) << certificate.reason;
}

TEST(PointOrder, EachPointThatStandsBackIsNamedOnce) {
  Watch nobody;
  const Contour contour = circle(6, points_at({0.1, 1.0, 0.9, 2.2, 2.9, 2.7}), 0.01);
  EXPECT_EQ(points_out_of_order(contour, nobody), (std::vector<std::size_t>{2, 5}));
  EXPECT_TRUE(points_out_of_order(circle(6, points_at({0.1, 1.0, 2.2}), 0.01), nobody).empty());
  EXPECT_TRUE(points_out_of_order(circle(6, points_at({1.0, 0.1}), 6.0), nobody).empty());
}

TEST(PointOrder, ReversedPointsAreNotMet) {
  EXPECT_FALSE(certify(circle(6, points_at({2.9, 2.2, 1.0, 0.9, 0.1}), 0.01)).through_points);
}

TEST(PointOrder, PointsThatStandBackByLessThanTheirTolerancesAreMet) {
  // 1.0 comes before 0.9 along the way when the one may be met early and the other late
  EXPECT_TRUE(certify(circle(6, points_at({0.1, 1.0, 0.9, 2.2}), 0.26)).through_points);
  EXPECT_FALSE(certify(circle(6, points_at({0.1, 1.0, 0.9, 2.2}), 0.24)).through_points);
}

TEST(PointOrder, MeetingEachPointAsEarlyAsPossibleFindsAnOrderThatNearestPlacesHide) {
  // the second point lies far ahead within its wide tolerance, the third before it
  Contour contour = circle(6, points_at({0.1, 1.6, 0.9, 2.2}), 0.01);
  contour.point_tolerance[1] = 4.0;
  EXPECT_TRUE(certify(contour).through_points) << certify(contour).reason;
  contour.point_tolerance[1] = 3.0;
  EXPECT_FALSE(certify(contour).through_points);
}

TEST(PointOrder, AJointMayNameEitherOfTwoPointsThatTheirTolerancesDoNotTellApart) {
  // a joint at angle 1, 0.0665 before the point that it names and 0.0655 before another one
  Contour contour = circle(6, points_at({0.1, 1.0131, 1.0133, 2.2}), 0.066);
  contour.joints[2].source = 2;
  EXPECT_TRUE(certify(contour).through_points) << certify(contour).reason;
  contour.points[1] = on_ring(0.9, 5.0);
  EXPECT_TRUE(certify(contour).through_points) << certify(contour).reason;
  contour.joints[2].source = 3;
  EXPECT_FALSE(certify(contour).through_points);
}

TEST(PointOrder, MeasuredPointsWhoseNoiseIsLargerThanTheirSpacingAreMet) {
  std::mt19937_64 random(5);
  std::uniform_real_distribution<double> noise(-1.0, 1.0);
  constexpr double kNoise = 0.05;
  std::vector<Vec2> points;
  for (int k = 0; k < 2000; ++k) {
    const Vec2 off{noise(random), noise(random)};
    points.push_back(on_ring(0.001 + 0.00149 * k, 5.0) + (kNoise / std::sqrt(2.0)) * off);
  }
  const Certificate certificate = certify(circle(6, points, kNoise));
  EXPECT_TRUE(certificate.through_points) << certificate.reason;
}

/// The whole circle, closed, from angle 0 on.
Contour closed_circle(std::vector<Vec2> points, double tolerance) {
  constexpr int kArcs = 8;
  std::vector<Piece> pieces;
  for (int k = 0; k < kArcs; ++k) {
    const double a = 2.0 * kPi * k / kArcs;
    pieces.emplace_back(arc_from(on_ring(a, 5.0), a + kPi / 2, 0.2, 10.0 * kPi / kArcs));
  }
  Contour contour = testing_data::closed_contour(std::move(pieces), {{0, kArcs - 1, 0}});
  contour.carrier = Carrier::kArcs;
  for (Joint& joint : contour.joints) joint.source.reset();
  contour.points = std::move(points);
  contour.point_tolerance.assign(contour.points.size(), tolerance);
  return contour;
}

TEST(PointOrder, AClosedContourMayBeginAtAnyOfItsPoints) {
  std::vector<double> angles;
  for (int k = 0; k < 40; ++k) angles.push_back(0.1 + 0.155 * k);
  for (int turn = 0; turn < 40; turn += 7) {
    std::rotate(angles.begin(), angles.begin() + 7, angles.end());
    const Certificate certificate = certify(closed_circle(points_at(angles), 0.01));
    EXPECT_TRUE(certificate.through_points) << turn << ": " << certificate.reason;
  }
  std::swap(angles[10], angles[11]);
  EXPECT_FALSE(certify(closed_circle(points_at(angles), 0.01)).through_points);
  std::swap(angles[10], angles[11]);
  std::reverse(angles.begin(), angles.end());
  EXPECT_FALSE(certify(closed_circle(points_at(angles), 0.01)).through_points);
}

TEST(PointOrder, PointsAroundTheSeamMayStandBackWithinTheirTolerances) {
  // the first two points change places, right where a closed contour begins
  EXPECT_TRUE(certify(closed_circle(points_at({0.01, -0.01, 1.0, 3.0, 5.0}), 0.2)).through_points);
  EXPECT_FALSE(
      certify(closed_circle(points_at({0.01, -0.01, 1.0, 3.0, 5.0}), 0.01)).through_points);
}

TEST(PointOrder, AContourWithoutPointsPassesNone) {
  Contour contour = circle(6, {}, 0.01);
  Certificate certificate = certify(contour);
  EXPECT_FALSE(certificate.through_points);
  EXPECT_FALSE(certificate.proved);
  EXPECT_NE(certificate.reason.find("does not name the points"), std::string::npos);
  contour.points.assign(5, on_ring(1.0, 5.0));
  contour.point_tolerance.assign(5, 0.01);
  certificate = certify(contour);
  EXPECT_FALSE(certificate.through_points) << "the same point five times";
}

/// Two points change places within their tolerances, so the nearest places do not do; the others
/// stand in order, the last one beside the first.
Contour nearly_around(double first, double reach, double last) {
  Contour contour = closed_circle(points_at({first, 1.5, 1.45, 3.0, 5.0, last}), 0.3);
  contour.point_tolerance.front() = 10.0 * std::sin(0.5 * reach);  // a chord of the circle
  contour.point_tolerance.back() = 0.05;
  return contour;
}

TEST(PointOrder, OnceAroundAClosedContourEndsWhereTheFirstPointIsMet) {
  // an arc goes from 0 to 0.785: the first point in it, and the last one before it
  EXPECT_TRUE(certify(nearly_around(0.5, 0.01, 0.2)).through_points)
      << certify(nearly_around(0.5, 0.01, 0.2)).reason;
  EXPECT_FALSE(certify(nearly_around(0.5, 0.01, 0.6)).through_points);
}

TEST(PointOrder, TheFirstPointMayBeMetLateSoThatTheLastOneIsMetBeforeIt) {
  // the first one from 0.2 to 0.8, the last one at 0.6
  EXPECT_TRUE(certify(nearly_around(0.5, 0.3, 0.6)).through_points)
      << certify(nearly_around(0.5, 0.3, 0.6)).reason;
  EXPECT_FALSE(certify(nearly_around(0.5, 0.05, 0.6)).through_points);
}

}  // namespace
}  // namespace obvid
