// SPDX-License-Identifier: Apache-2.0
// A closed series that means one circle: it begins at a point of the series, and nothing is open.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

TEST(WholeCircle, BeginsAtThePointThatItsFirstJointNames) {
  constexpr double kRadius = 50.0, kMostMove = 0.05;
  int circles = 0;
  for (const int count : {12, 24, 37, 48, 72, 100}) {
    for (const double turned : {0.0, 0.7, 2.9}) {
      PointSeries series;
      for (int i = 0; i < count; ++i) {
        const double a = turned + 2.0 * std::numbers::pi * i / count;
        const double r = kRadius + 0.3 * kMostMove * std::sin(5.0 * i);
        series.points.push_back({r * std::cos(a), r * std::sin(a)});
      }
      FitJob job;
      job.closing = Closing::kClosed;
      job.primitives = true;
      job.noise = kMostMove;
      const auto made = fit(series, job);
      ASSERT_TRUE(made) << to_line(made.error());
      for (const Joint& joint : made->contour.joints) {
        if (!joint.source) continue;
        EXPECT_LE(norm(joint.element.point - series.points[*joint.source]), kMostMove)
            << count << " points, point " << *joint.source + 1;
      }
      if (!std::holds_alternative<ArcPiece>(made->contour.pieces.front())) continue;
      ++circles;
      EXPECT_TRUE(made->warnings.empty()) << made->warnings.front();
      EXPECT_EQ(made->certificate.vertices, 0);
    }
  }
  EXPECT_EQ(circles, 18);
}

/// Points of a circle of radius 7, or of the x-axis, ten units apart.
PointSeries of_circle(int count, double step) {
  PointSeries series;
  for (int i = 0; i < count; ++i) {
    series.points.push_back({7.0 * std::cos(step * i), 7.0 * std::sin(step * i)});
  }
  return series;
}

PointSeries of_line() {
  PointSeries series;
  series.points = {{0, 0}, {10, 0}, {20, 0}, {30, 0}};
  return series;
}

constexpr double kQuarterTurn = 0.5 * std::numbers::pi;

PointConstraint heading_at(std::size_t i, double theta) {
  PointConstraint out;
  out.index = i;
  out.theta = theta;
  return out;
}

PointConstraint curvature_beside(std::size_t i, double kappa) {
  PointConstraint out;
  out.index = i;
  out.kappa = kappa;
  return out;
}

TEST(WholeCircle, KeepsGivenDataThatItHas) {
  const PointSeries arc = of_circle(10, 0.1), around = of_circle(24, std::numbers::pi / 12.0);
  struct GivenOnCircle {
    const PointSeries& series;
    PointConstraint wish;
    Closing closing;
  };
  const PointSeries line = of_line();
  const GivenOnCircle cases[] = {{line, heading_at(0, 0.0), Closing::kOpen},
                                 {line, heading_at(1, 0.0), Closing::kOpen},
                                 {line, curvature_beside(3, 0.0), Closing::kOpen},
                                 {arc, heading_at(0, kQuarterTurn), Closing::kOpen},
                                 {arc, heading_at(4, kQuarterTurn + 0.4 + 5e-7), Closing::kOpen},
                                 {arc, curvature_beside(9, 1.0 / 7.0), Closing::kOpen},
                                 {around, heading_at(0, kQuarterTurn), Closing::kClosed},
                                 {around, curvature_beside(2, 1.0 / 7.0), Closing::kClosed}};
  for (const GivenOnCircle& one : cases) {
    for (const double noise : {0.0, 0.01}) {
      for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs, Carrier::kConics,
                                    Carrier::kClothoids, Carrier::kBspline}) {
        FitJob job;
        job.closing = one.closing;
        job.carrier = carrier;
        job.noise = noise;
        job.constraints = {one.wish};
        const auto made = fit(one.series, job);
        ASSERT_TRUE(made) << to_line(made.error());
        EXPECT_TRUE(made->certificate.proved);
        EXPECT_EQ(made->certificate.vertices, 0);
        EXPECT_EQ(made->certificate.inflections, 0);
        EXPECT_EQ(made->report.given.headings, one.wish.theta ? 1 : 0);
        EXPECT_EQ(made->report.given.curvatures, one.wish.kappa ? 1 : 0);
        EXPECT_LE(made->report.given.heading_miss, 1e-6);
        EXPECT_LE(made->report.given.curvature_miss, 1e-6);
      }
    }
  }
}

TEST(WholeCircle, RefusesOtherDataAndNamesThePoint) {
  const PointSeries arc = of_circle(10, 0.1);
  PointConstraint other_headings, other_curvatures, own;
  other_headings.index = other_curvatures.index = own.index = 3;
  other_headings.thetas = ValueRange{kQuarterTurn + 0.31, kQuarterTurn + 0.4};
  other_curvatures.kappas = ValueRange{0.15, 0.2};
  own.thetas = ValueRange{kQuarterTurn + 0.29, kQuarterTurn + 0.31};
  own.kappas = ValueRange{0.14, 0.15};
  for (const PointConstraint& wish :
       {heading_at(3, kQuarterTurn + 0.3 + 1e-5), heading_at(3, -kQuarterTurn + 0.3),
        curvature_beside(3, -1.0 / 7.0), curvature_beside(3, 1.0001 / 7.0), other_headings,
        other_curvatures}) {
    FitJob job;
    job.constraints = {wish};
    const auto made = fit(arc, job);
    ASSERT_FALSE(made);
    EXPECT_EQ(made.error().code, ErrorCode::kFixedDataContradict);
    EXPECT_EQ(made.error().where, "point 4");
  }
  FitJob job;
  job.constraints = {own};
  const auto made = fit(arc, job);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_EQ(made->report.given.heading_ranges, 1);
  EXPECT_EQ(made->report.given.curvature_ranges, 1);
}

TEST(WholeCircle, ThreePointsKeepTheirCircleWhereItHasWhatIsGiven) {
  const PointSeries arc = of_circle(3, 0.5);
  FitJob job;
  job.constraints = {heading_at(1, kQuarterTurn + 0.5)};
  const auto own = fit(arc, job);
  ASSERT_TRUE(own) << to_line(own.error());
  for (const Piece& piece : own->contour.pieces) {
    ASSERT_TRUE(std::holds_alternative<ArcPiece>(piece));
    EXPECT_NEAR(std::get<ArcPiece>(piece).kappa, 1.0 / 7.0, 1e-12);
  }
  job.constraints = {heading_at(1, kQuarterTurn + 0.49)};  // another curve has that
  const auto other = fit(arc, job);
  ASSERT_TRUE(other) << to_line(other.error());
  EXPECT_FALSE(std::holds_alternative<ArcPiece>(other->contour.pieces.front()));
}

/// A chord that spans more than half of the circle: no piece alone turns by so much with a proof.
TEST(WholeCircle, IsProvedWhereAChordSpansMoreThanHalf) {
  const std::vector<std::vector<Vec2>> all = {
      {{3, 4}, {5, 0}, {4, -3}, {3, -4}},              // open, radius 5
      {{3, 4}, {5, 0}, {4, -3}, {3, -4}, {3, 4}},      // closed by more than half of it
      {{0, 0}, {100, 0}, {80, 30}, {20, 30}, {0, 0}},  // a trapezoid has a circle, too
      {{3, -4}, {3, 4}, {5, 0}, {4, -3}}};
  for (const auto& points : all) {
    PointSeries series;
    series.points = points;
    for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs, Carrier::kClothoids}) {
      FitJob job;
      job.carrier = carrier;
      job.find_corners = false;
      const auto made = fit(series, job);
      ASSERT_TRUE(made) << to_line(made.error());
      EXPECT_TRUE(made->certificate.proved) << to_string(carrier) << made->certificate.reason;
      // the circle through the first three points
      const Vec2 a = points[1] - points[0], b = points[2] - points[0];
      const double kappa = 2.0 * cross(a, b) / (norm(a) * norm(b) * norm(b - a));
      for (const Joint& joint : made->contour.joints) {
        EXPECT_NEAR(joint.element.kappa / kappa, 1.0, 1e-12);
      }
    }
  }
}

}  // namespace
}  // namespace obvid
