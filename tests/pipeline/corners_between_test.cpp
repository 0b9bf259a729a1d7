// SPDX-License-Identifier: Apache-2.0
// Outlines of lines and arcs of which no point stands on a corner.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <variant>
#include <vector>

#include "obvid/io/contour_json.h"
#include "obvid/pipeline/fit.h"
#include "obvid/pipeline/internal/lines_and_arcs.h"

namespace obvid {
namespace {

constexpr double kScanTolerance = 0.02;

/// Corners of a regular polygon, and points on its sides: `each` a side, half a step off its ends,
/// in turns a quarter of the tolerance inside and outside.
struct Polygon {
  std::vector<Vec2> corners;
  PointSeries series;

  Polygon(int sides, int each, double scale, double turned, bool open = false) {
    for (int k = 0; k < sides; ++k) {
      const double a = turned + 2.0 * std::numbers::pi * k / sides;
      corners.push_back({scale * (10.0 * std::cos(a) + 3.0), scale * (10.0 * std::sin(a) - 40.0)});
    }
    for (int k = 0; k < (open ? sides - 1 : sides); ++k) {
      const Vec2 from = corners[static_cast<std::size_t>(k)];
      const Vec2 to = corners[static_cast<std::size_t>((k + 1) % sides)];
      const Vec2 along = to - from, left = left_normal(along) / norm(along);
      for (int i = 0; i < each; ++i) {
        const double off = scale * 0.25 * kScanTolerance * (i % 2 == 0 ? 1.0 : -1.0);
        series.points.push_back(from + ((i + 0.5) / each) * along + off * left);
      }
    }
  }
};

FitJob scan_job(double scale, Closing closing = Closing::kClosed) {
  FitJob job;
  job.closing = closing;
  job.primitives = true;
  job.noise = scale * kScanTolerance;
  return job;
}

TEST(CornersBetween, SidesOfPolygonsLeadFromCornerToCornerAtEverySize) {
  for (const double scale : {1e-3, 1.0, 1e3}) {
    for (const int sides : {3, 4, 5, 6, 8}) {
      const Polygon polygon(sides, 14, scale, 0.3 * sides);
      const auto made = fit(polygon.series, scan_job(scale));
      ASSERT_TRUE(made) << to_line(made.error());
      const Contour& contour = made->contour;
      EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
      EXPECT_EQ(made->certificate.corners, sides);
      EXPECT_EQ(made->certificate.vertices, 0);
      ASSERT_EQ(contour.pieces.size(), static_cast<std::size_t>(sides));
      EXPECT_EQ(contour.points, polygon.series.points);
      for (std::size_t k = 0; k < contour.joints.size(); ++k) {
        EXPECT_TRUE(std::holds_alternative<LinePiece>(contour.pieces[k]));
        const Joint& joint = contour.joints[k];
        ASSERT_FALSE(joint.source);
        ASSERT_TRUE(joint.after);
        // behind the last point of a side
        EXPECT_EQ(*joint.after % 14, 13U);
        const Vec2 corner = polygon.corners[(*joint.after / 14 + 1) % polygon.corners.size()];
        EXPECT_LE(norm(joint.element.point - corner), scale * kScanTolerance);
      }
    }
  }
}

TEST(CornersBetween, AnOpenRowBeginsAndEndsAtItsPoints) {
  const Polygon polygon(4, 14, 1.0, 0.5, true);
  const auto made = fit(polygon.series, scan_job(1.0, Closing::kOpen));
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
  ASSERT_EQ(made->contour.pieces.size(), 3U);
  const auto& joints = made->contour.joints;
  EXPECT_EQ(joints.front().source, std::size_t{0});
  EXPECT_EQ(joints[1].after, std::size_t{13});
  EXPECT_EQ(joints[2].after, std::size_t{27});
  EXPECT_EQ(joints.back().source, std::size_t{41});
}

TEST(CornersBetween, RowsOfTheReportEndAtCornersAndFilesKeepThem) {
  const Polygon polygon(4, 14, 1.0, 0.5);
  const auto made = fit(polygon.series, scan_job(1.0));
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->report.segments.size(), 4U);
  for (const SegmentReport& row : made->report.segments) {
    EXPECT_EQ(*row.from % 14, 0U);
    EXPECT_EQ(*row.to, *row.from + 13);
    EXPECT_NEAR(row.chord, 10.0 * std::numbers::sqrt2, 0.02);
  }
  StoredContour stored;
  stored.contour = made->contour;
  stored.report = made->report;
  stored.certificate = made->certificate;
  const auto again = contour_from_json(contour_to_json(stored), "f");
  ASSERT_TRUE(again) << to_line(again.error());
  for (std::size_t k = 0; k < made->contour.joints.size(); ++k) {
    EXPECT_EQ(again->contour.joints[k].after, made->contour.joints[k].after);
  }
  const Verification found = verify(*again);
  EXPECT_TRUE(found.certificate.proved) << found.certificate.reason;
  EXPECT_FALSE(found.false_claim) << to_line(*found.false_claim);
}

TEST(CornersBetween, CurvesAndRoundingsHaveNone) {
  for (const double ratio : {0.2, 0.5, 0.8}) {  // ellipses
    PointSeries series;
    for (int i = 0; i < 150; ++i) {
      const double a = 2.0 * std::numbers::pi * i / 150;
      const double r = 1.0 + 0.25e-3 * (i % 2);
      series.points.push_back({20.0 * r * std::cos(a), 20.0 * ratio * r * std::sin(a)});
    }
    FitJob job = scan_job(1.0);
    job.noise = 0.05;
    const auto made = fit(series, job);
    ASSERT_TRUE(made) << to_line(made.error());
    EXPECT_EQ(made->certificate.corners, 0) << ratio;
  }
}

TEST(CornersBetween, WhatIsGivenAtAPointBesideItStays) {
  const Polygon polygon(4, 14, 1.0, 0.5);
  FitJob job = scan_job(1.0);
  PointConstraint corner;
  corner.index = 13;
  corner.corner = true;
  job.constraints.push_back(corner);
  const auto made = fit(polygon.series, job);
  ASSERT_TRUE(made) << to_line(made.error());
  bool at_point = false;
  for (const Joint& joint : made->contour.joints) {
    at_point = at_point || (joint.source == std::size_t{13} && joint.leaving);
    EXPECT_NE(joint.after, std::optional<std::size_t>(13));
  }
  EXPECT_TRUE(at_point);
}

TEST(CornersBetween, WithoutLinesAndArcsNothingIsLookedFor) {
  const Polygon polygon(4, 14, 1.0, 0.5);
  FitJob job = scan_job(1.0);
  job.primitives = false;
  const auto made = fit(polygon.series, job);
  ASSERT_TRUE(made) << to_line(made.error());
  for (const Joint& joint : made->contour.joints) EXPECT_FALSE(joint.after);
}

/// A ring that bends as it likes, within so much that lines and arcs of a few points break it.
TEST(CornersBetween, NoneTurnsByLessThanACornerDoes) {
  PointSeries series;
  series.points = {
      {4.18246, 0},          {4.03055, 0.919947},
      {4.02949, 1.9405},     {3.94597, 3.14681},
      {3.4411, 4.315},       {2.42243, 5.03023},
      {1.15166, 5.04573},    {-1.13358e-19, 4.51937},
      {-0.884726, 3.87624},  {-1.65185, 3.4301},
      {-2.50435, 3.14036},   {-3.42074, 2.72795},
      {-4.1464, 1.9968},     {-4.44945, 1.01556},
      {-4.348, -2.1812e-19}, {-4.06274, -0.927294},
      {-3.76457, -1.81292},  {-3.40857, -2.71825},
      {-2.83007, -3.54879},  {-1.97162, -4.09412},
      {-0.968396, -4.24282}, {7.55922e-19, -4.11568},
      {0.900122, -3.94369},  {1.83698, -3.81452},
      {2.85038, -3.57427},   {3.76674, -3.00387},
      {4.311, -2.07607},     {4.382, -1.00016},
  };
  FitJob job = scan_job(1.0);
  job.noise = 0.06389;
  const auto made = fit(series, job);
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
  for (const Joint& joint : made->contour.joints) {
    if (!joint.after) continue;
    ASSERT_TRUE(joint.leaving);
    const double turn =
        std::remainder(joint.leaving->theta - joint.element.theta, 2.0 * std::numbers::pi);
    EXPECT_GE(std::abs(turn), std::numbers::pi / 9.0) << *joint.after;
  }
}

/// Offsets across a curve that look as errors do and are none's: the same at every run.
double error_at(std::size_t i, double size) {
  const double a = std::sin(12.9898 * static_cast<double>(i + 1)) * 43758.5453;
  const double b = std::sin(78.2330 * static_cast<double>(i + 1)) * 12543.1234;
  return size * (a - std::floor(a) + b - std::floor(b) - 1.0);
}

/// Sides of 20 with roundings of radius 3 between, points half a unit apart; nothing is said of
/// where one ends.
PointSeries rounded_polygon(int sides, double size) {
  constexpr double kSide = 20.0, kRadius = 3.0, kStep = 0.497;
  const double turn = 2.0 * std::numbers::pi / sides, arc = kRadius * turn;
  PointSeries out;
  const double all = sides * (kSide + arc);
  const auto count = static_cast<std::size_t>(all / kStep);
  for (std::size_t i = 0; i < count; ++i) {
    double s = all * (static_cast<double>(i) + 0.3) / static_cast<double>(count), theta = 0.0;
    Vec2 at{};
    const double off = error_at(i, size);
    while (s > kSide + arc) {
      at = at + kSide * unit_at(theta) +
           kRadius * (left_normal(unit_at(theta)) - left_normal(unit_at(theta + turn)));
      theta += turn;
      s -= kSide + arc;
    }
    const double round = std::max(0.0, s - kSide) / kRadius;
    at = at + std::min(s, kSide) * unit_at(theta) +
         kRadius * (left_normal(unit_at(theta)) - left_normal(unit_at(theta + round)));
    out.points.push_back(at + off * left_normal(unit_at(theta + round)));
  }
  return out;
}

TEST(TangentRows, SidesAndRoundingsOfPolygonsAreLinesAndArcs) {
  for (const int sides : {3, 4, 5, 6}) {
    const PointSeries series = rounded_polygon(sides, 0.02);
    FitJob job = scan_job(1.0);
    job.noise = 0.03;
    const auto made = fit(series, job);
    ASSERT_TRUE(made) << to_line(made.error());
    EXPECT_TRUE(made->certificate.proved) << made->certificate.reason;
    EXPECT_EQ(lines_and_arcs(made->contour).size(), static_cast<std::size_t>(2 * sides));
  }
}

/// Of the square of these the transition from an arc to the next line exists so narrowly that
/// doubles do not hold it, whatever follows the spirals.
TEST(TangentRows, ATransitionThatDoublesDoNotHoldGetsMoreRoomInEveryCarrier) {
  const PointSeries series = rounded_polygon(4, 0.02);
  for (const Closing closing : {Closing::kClosed, Closing::kOpen}) {
    for (const Carrier carrier : {Carrier::kSpiral, Carrier::kArcs, Carrier::kClothoids,
                                  Carrier::kBspline, Carrier::kCubic}) {
      FitJob job = scan_job(1.0, closing);
      job.noise = 0.03;
      job.carrier = carrier;
      const auto made = fit(series, job);
      ASSERT_TRUE(made) << to_string(carrier) << to_line(made.error());
      EXPECT_TRUE(keeps_promise(carrier, made->certificate))
          << to_string(carrier) << made->certificate.reason;
    }
  }
}

}  // namespace
}  // namespace obvid
