// SPDX-License-Identifier: Apache-2.0
// Contours that pass their points within tolerances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <random>

#include "../common/angles.h"
#include "contours.h"
#include "spiral_table.h"

namespace obvid {
namespace {

using testing_data::arc_from;
using testing_data::contour_of;
using testing_data::expect_refused;
using testing_data::kSpirals;
using testing_data::SpiralRow;

/// What the coordinates of these circles and the bounds of their roundings leave open.
constexpr double kRounding = 1e-13;

Vec2 on_circle(double angle, double radius) { return Vec2{3, -2} + radius * unit_at(angle); }

/// Circle of radius 5 from angle 0 in six arcs of half a radian, joints standing on no points.
Contour arc_chain(std::vector<Vec2> points, std::vector<double> tolerance) {
  std::vector<Piece> pieces;
  for (int k = 0; k < 6; ++k) {
    pieces.emplace_back(arc_from(on_circle(0.5 * k, 5.0), 0.5 * k + kPi / 2, 0.2, 2.5));
  }
  Contour contour = contour_of(std::move(pieces), {{0, 5, 0}});
  contour.carrier = Carrier::kArcs;
  for (Joint& joint : contour.joints) joint.source.reset();
  contour.points = std::move(points);
  contour.point_tolerance = std::move(tolerance);
  return contour;
}

/// Points at known distances from that circle, in and out, two thirds of a degree apart.
std::vector<double> distances() {
  std::vector<double> d;
  for (int k = 0; k < 250; ++k) d.push_back(0.02 * std::sin(1.0 + 2.3 * k));
  return d;
}

std::vector<Vec2> points_beside(const std::vector<double>& d) {
  std::vector<Vec2> points;
  for (std::size_t k = 0; k < d.size(); ++k) {
    points.push_back(on_circle(0.01 + 0.0119 * static_cast<double>(k), 5.0 + d[k]));
  }
  return points;
}

/// Just enough for every point.
std::vector<double> tight(std::vector<double> d) {
  for (double& x : d) x = std::abs(x) + kRounding;
  return d;
}

TEST(PointDistances, AreThoseFromTheCircleBesideWhichThePointsLie) {
  const std::vector<double> d = distances();
  const Contour contour = arc_chain(points_beside(d), std::vector<double>(d.size(), 0.02));
  const std::vector<double> found = point_distances(contour);
  ASSERT_EQ(found.size(), d.size());
  for (std::size_t k = 0; k < d.size(); ++k) EXPECT_NEAR(found[k], std::abs(d[k]), kRounding) << k;
}

TEST(PointDistances, OfAPointWithItsOwnJointAreThoseFromThatJointWhereThisIsNearEnough) {
  const std::vector<double> d = distances();
  Contour contour = arc_chain(points_beside(d), std::vector<double>(d.size(), 0.02));
  contour.joints[2].source = 83;
  const double from_joint = norm(contour.points[83] - contour.joints[2].element.point);
  ASSERT_LT(from_joint, 0.02);
  EXPECT_NEAR(point_distances(contour)[83], from_joint, kRounding);
  contour.point_tolerance[83] = 0.9 * from_joint;
  EXPECT_NEAR(point_distances(contour)[83], std::abs(d[83]), kRounding);
}

TEST(PointDistances, OfAPointAboveAParabolaAreTheClosedForm) {
  // y = x^2 from -1 to 1: the nearest point of (0, a) is the vertex up to a = 1/2, then two feet
  const Contour parabola =
      contour_of({RationalBezier{{}, 2, {Vec2{-1, 1}, {0, -1}, {1, 1}}, {1, 1, 1}}}, {{0, 0, 0}});
  for (const double a : {-2.0, -0.1, 0.0, 0.2, 0.45, 0.6, 0.9, 1.3}) {
    Contour contour = parabola;
    contour.points = {{0.0, a}};
    const double expected = a <= 0.5 ? std::abs(a) : std::sqrt(a - 0.25);
    EXPECT_NEAR(point_distances(contour)[0], expected, kRounding) << a;
  }
}

/// Distance in 64 bits of mantissa from the piece as its doubles stand: three searches, each around
/// the best place of the one before.
long double true_distance(const RationalBezier& b, Vec2 p) {
  long double low = 0.0L, high = 1.0L, best = 0.0L;
  long double least = std::numeric_limits<long double>::max();
  for (int round = 0; round < 8; ++round) {
    constexpr int kParts = 200;
    for (int k = 0; k <= kParts; ++k) {
      const long double t = low + (high - low) * k / kParts;
      long double x[8], y[8], w[8];
      for (std::size_t j = 0; j <= static_cast<std::size_t>(b.degree); ++j) {
        w[j] = b.weight[j];
        x[j] = w[j] * ((static_cast<long double>(b.origin.x) - p.x) + b.offset[j].x);
        y[j] = w[j] * ((static_cast<long double>(b.origin.y) - p.y) + b.offset[j].y);
      }
      for (int n = b.degree; n > 0; --n) {
        for (int j = 0; j < n; ++j) {
          x[j] += t * (x[j + 1] - x[j]);
          y[j] += t * (y[j + 1] - y[j]);
          w[j] += t * (w[j + 1] - w[j]);
        }
      }
      const long double d = std::hypot(x[0] / w[0], y[0] / w[0]);
      if (d < least) {
        least = d;
        best = t;
      }
    }
    const long double step = (high - low) / kParts;
    low = std::max(0.0L, best - 2 * step);
    high = std::min(1.0L, best + 2 * step);
  }
  return least;
}

TEST(PointDistances, AreNeverBelowTheTruthAndHardlyAboveIt) {
  std::mt19937_64 rng(11);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  for (int i = 0; i < 200; ++i) {
    const SpiralRow& row = kSpirals[static_cast<std::size_t>(i) % std::size(kSpirals)];
    RationalBezier piece;
    piece.degree = 4;
    std::copy(row.points.begin(), row.points.end(), piece.offset.begin());
    std::copy(row.weights.begin(), row.weights.end(), piece.weight.begin());
    piece.origin = std::ldexp(1.0, i % 21) * Vec2{uniform(rng), uniform(rng)};
    Contour contour = contour_of({piece}, {{0, 0, 1}});
    const Jet jet = evaluate(piece, 0.5 + 0.4 * uniform(rng));
    const double away = std::ldexp(uniform(rng), -(i % 40));
    contour.points = {jet.point + away * left_normal(jet.d1 / norm(jet.d1))};
    const double size = 1.0 + std::abs(piece.origin.x) + std::abs(piece.origin.y);
    const auto truth = static_cast<double>(true_distance(piece, contour.points[0]));
    const double found = point_distances(contour)[0];
    EXPECT_GE(found, truth) << i;
    EXPECT_LE(found, truth + 1e-13 * size) << i;
  }
}

TEST(PointDistances, PointListedAtTheWrongPlaceIsFoundOnAnotherPiece) {
  std::vector<Vec2> points = points_beside(std::vector<double>(250, 0.0));
  Contour contour = arc_chain(points, std::vector<double>(points.size(), 1e-9));
  contour.joints[1].source = 41;
  contour.joints[2].source = 83;
  std::swap(contour.points[60], contour.points[240]);
  for (const double d : point_distances(contour)) EXPECT_LT(d, 1e-12);
}

TEST(PointDistances, AreInfiniteWithoutPiecesAndNeverNaN) {
  Contour contour;
  contour.points = {{0, 0}};
  EXPECT_EQ(point_distances(contour)[0], std::numeric_limits<double>::infinity());
  contour = arc_chain({{NAN, 0.0}, {0.0, 1e308}}, {1.0, 1.0});
  for (const double d : point_distances(contour)) EXPECT_GT(d, 1.0);
}

TEST(PointDistances, ArcCountsFromWhereItsNumbersLeadToo) {
  // The stored end is off by 1e-6: a point on it is that far from the arc that the numbers
  // describe.
  ArcPiece arc = arc_from({0, 0}, 0.0, 0.5, 2.0);
  Contour contour = contour_of({arc, arc_from(arc.end, 1.0, 0.5, 2.0)}, {{0, 1, 0}});
  contour.pieces.pop_back();
  contour.joints.clear();
  contour.points = {arc.end + Vec2{1e-6, 0}};
  std::get<ArcPiece>(contour.pieces[0]).end = contour.points[0];
  EXPECT_GE(point_distances(contour)[0], 1e-6 * std::abs(std::sin(1.0)));
}

TEST(Tolerance, ContourIsProvedWithinItAndItsLargestMoveIsStated) {
  const std::vector<double> d = distances();
  const Certificate certificate = certify(arc_chain(points_beside(d), tight(d)));
  EXPECT_TRUE(certificate.proved) << certificate.reason;
  EXPECT_TRUE(certificate.through_points);
  const std::vector<double> sizes = tight(d);
  EXPECT_NEAR(certificate.largest_move, *std::max_element(sizes.begin(), sizes.end()),
              2 * kRounding);
}

TEST(Tolerance, OnePointBeyondItIsRefusedAndNamed) {
  const std::vector<double> d = distances();
  for (const std::size_t k : {0U, 17U, 130U, 249U}) {
    std::vector<double> tolerance = tight(d);
    tolerance[k] -= 1e-11;
    const Certificate certificate = certify(arc_chain(points_beside(d), tolerance));
    EXPECT_FALSE(certificate.proved) << k;
    EXPECT_FALSE(certificate.through_points) << k;
    EXPECT_NE(certificate.reason.find("point " + std::to_string(k + 1) + " at"), std::string::npos)
        << certificate.reason;
  }
}

TEST(Tolerance, NothingOfItIsTakenForGranted) {
  const std::vector<Vec2> points = points_beside(distances());
  const auto with = [&](double tolerance) {
    return arc_chain(points, std::vector<double>(points.size(), tolerance));
  };
  EXPECT_TRUE(certify(with(0.02)).proved);
  expect_refused(with(0.0), "no tolerance at all");
  expect_refused(with(-0.02), "negative");
  expect_refused(with(NAN), "not a number");
  Contour contour = with(0.02);
  contour.point_tolerance.pop_back();
  expect_refused(contour, "a tolerance missing");
  contour.point_tolerance = {};
  expect_refused(contour, "no tolerances, no joints on the points");
}

TEST(Tolerance, PointWithoutAnyIsMetWithinRounding) {
  Contour contour = arc_chain(points_beside(distances()), std::vector<double>(250, 0.02));
  contour.joints[1].source = 41;
  contour.points[41] = contour.joints[1].element.point;
  contour.point_tolerance[41] = 0.0;
  EXPECT_TRUE(certify(contour).proved) << certify(contour).reason;
  contour.points[41].x += 1e-12;  // the contour is 10 wide
  expect_refused(contour, "beside its joint");
}

TEST(Tolerance, JointsStandOnTheirPointsInOrder) {
  Contour contour = arc_chain(points_beside(distances()), std::vector<double>(250, 0.02));
  const auto beside = [&](std::size_t joint) {
    const auto farther = [&](Vec2 a, Vec2 b) {
      return norm(a - contour.joints[joint].element.point) <
             norm(b - contour.joints[joint].element.point);
    };
    const auto& points = contour.points;
    return static_cast<std::size_t>(std::min_element(points.begin(), points.end(), farther) -
                                    points.begin());
  };
  contour.joints[1].source = beside(1);
  contour.joints[3].source = beside(3);
  EXPECT_TRUE(certify(contour).proved) << certify(contour).reason;
  ++*contour.joints[3].source;
  expect_refused(contour, "beside its point");
  --*contour.joints[3].source;
  std::swap(contour.joints[1].source, contour.joints[3].source);
  expect_refused(contour, "out of order");
  contour.joints[1].source = contour.joints[3].source;
  expect_refused(contour, "the same twice");
  contour.joints[1].source = 250;
  expect_refused(contour, "no such point");
}

}  // namespace
}  // namespace obvid
