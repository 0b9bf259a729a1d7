// SPDX-License-Identifier: Apache-2.0
// The papers' constructions as contours: through the points, at the given tangents, and what their
// files say is so.
#include "obvid/pipeline/construction_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "../common/ten_points.h"
#include "obvid/contour/clothoids.h"
#include "obvid/geom/angle.h"
#include "obvid/io/contour_json.h"

namespace obvid {
namespace {

constexpr Construction kAllConstructions[] = {Construction::kArcs, Construction::kEllipses,
                                              Construction::kClothoids, Construction::kSpline,
                                              Construction::kParabolas};

struct Shape {
  std::string name;
  PointSeries series;
};

PointSeries series_of_shape(std::vector<Vec2> points) {
  PointSeries out;
  out.points = std::move(points);
  return out;
}

/// The reference series, an involute, two points, a closed outline and a wave.
std::vector<Shape> shapes() {
  std::vector<Shape> out{{"reference", series_of_shape(kTenPoints)}};
  std::vector<Vec2> involute, ellipse, wave;
  for (int i = 1; i <= 8; ++i) {
    const double t = 0.25 * i;
    involute.push_back({std::cos(t) + t * std::sin(t), std::sin(t) - t * std::cos(t)});
  }
  for (int i = 0; i < 12; ++i) {
    const double t = std::numbers::pi * i / 6.0;
    ellipse.push_back({3.0 * std::cos(t), 2.0 * std::sin(t)});
  }
  for (int i = 0; i <= 10; ++i) {
    const double t = 0.3 * i - 1.5;
    wave.push_back({t, t * t * t / 6.0});
  }
  out.push_back({"involute", series_of_shape(involute)});
  out.push_back({"closed", series_of_shape(ellipse)});
  out.push_back({"wave", series_of_shape(wave)});
  PointSeries two = series_of_shape({{0.0, 0.0}, {10.0, 2.0}});
  two.fixed.resize(2);
  two.fixed[0].theta = -5.0 * kOneDegree;
  two.fixed[1].theta = 40.0 * kOneDegree;
  out.push_back({"two", two});
  return out;
}

RegionJob job_of(const Shape& shape, Construction which) {
  RegionJob job;
  job.construction = which;
  if (shape.name == "closed") job.job.closing = Closing::kClosed;
  return job;
}

TEST(ConstructionFit, WhatTheirFilesSayIsSo) {
  std::size_t made = 0, refused = 0;
  for (const Shape& shape : shapes()) {
    for (const Construction which : kAllConstructions) {
      SCOPED_TRACE(shape.name + ", construction " + std::to_string(static_cast<int>(which)));
      const auto f = fit_construction(shape.series, job_of(shape, which));
      if (!f) {
        ++refused;
        const ErrorCode code = f.error().code;
        EXPECT_TRUE(code == ErrorCode::kNoSpiral || code == ErrorCode::kToleranceNotReached ||
                    code == ErrorCode::kBadOption)
            << to_line(f.error());
        continue;
      }
      ++made;
      EXPECT_TRUE(f->certificate.through_points);
      const StoredContour stored{f->contour, f->report, f->certificate};
      const auto again = contour_from_json(contour_to_json(stored), "f");
      ASSERT_TRUE(again) << to_line(again.error());
      const Verification found = verify(*again);
      EXPECT_FALSE(found.false_claim) << to_line(*found.false_claim);
    }
  }
  EXPECT_GE(made, 15U) << refused << " refused";
}

/// Constructions that need no more than tangents are made on every shape, parabolas wherever there
/// is no inflection; the worksheet has their table, and each shape a proved contour.
TEST(ConstructionFit, MethodsWorkOnEveryShape) {
  for (const Shape& shape : shapes()) {
    SCOPED_TRACE(shape.name);
    const auto proved = fit(shape.series, job_of(shape, Construction::kArcs).job);
    ASSERT_TRUE(proved) << to_line(proved.error());
    EXPECT_TRUE(proved->certificate.proved) << proved->certificate.reason;
    for (const Construction which : {Construction::kArcs, Construction::kClothoids,
                                     Construction::kSpline, Construction::kParabolas}) {
      if (which == Construction::kParabolas && shape.name == "wave") continue;
      SCOPED_TRACE(static_cast<int>(which));
      const auto made = fit_construction(shape.series, job_of(shape, which));
      EXPECT_TRUE(made) << to_line(made.error());
      const auto table = region_table(shape.series, job_of(shape, which));
      EXPECT_TRUE(table) << to_line(table.error());
    }
  }
}

TEST(ConstructionFit, TwoArcsPerSegmentGoOneWayAndMeetTheTangents) {
  PointSeries series = series_of_shape(kTenPoints);
  series.fixed.resize(kTenPoints.size());
  series.fixed[4].theta = 79.0 * kOneDegree;
  RegionJob job;
  job.construction = Construction::kArcs;
  const auto f = fit_construction(series, job);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_EQ(f->contour.pieces.size(), 18U);
  double before = -HUGE_VAL;
  for (const Piece& piece : f->contour.pieces) {
    const auto* arc = std::get_if<ArcPiece>(&piece);
    ASSERT_NE(arc, nullptr);
    EXPECT_GE(arc->kappa, before);
    before = arc->kappa;
  }
  for (std::size_t j = 0; j < f->contour.joints.size(); ++j) {
    if (f->contour.joints[j].source != 4U) continue;
    EXPECT_NEAR(std::remainder(f->contour.joints[j].element.theta - 79.0 * kOneDegree,
                               2.0 * std::numbers::pi),
                0.0, 1e-9);
  }
  EXPECT_TRUE(f->certificate.proved) << f->certificate.reason;
}

TEST(ConstructionFit, OneClothoidPerSegmentIsTheClothoidBetweenItsTangents) {
  RegionJob job;
  job.construction = Construction::kClothoids;
  job.rule = TangentRule::kNeighbours;
  const auto f = fit_construction(series_of_shape(kTenPoints), job);
  ASSERT_TRUE(f) << to_line(f.error());
  ASSERT_EQ(f->contour.pieces.size(), 9U);
  for (std::size_t k = 1; k < 8; ++k) {  // 002: along the chord between both neighbours
    const double from = heading(kTenPoints[k + 1] - kTenPoints[k - 1]);
    const double to = heading(kTenPoints[k + 2] - kTenPoints[k]);
    const auto one = clothoid_between(kTenPoints[k], from, kTenPoints[k + 1], to);
    ASSERT_TRUE(one);
    const Jet a = evaluate(Piece{*one}, 0.5), b = evaluate(f->contour.pieces[k], 0.5);
    EXPECT_LT(norm(a.point - b.point), 1e-9);
  }
  EXPECT_GT(f->certificate.vertices, 0);
}

TEST(ConstructionFit, PointsAreInsertedUntilTheRegionIsNarrow) {
  RegionJob job;
  job.construction = Construction::kArcs;
  job.job.tolerance = 0.05;
  const auto f = fit_construction(series_of_shape(kTenPoints), job);
  ASSERT_TRUE(f) << to_line(f.error());
  EXPECT_GT(f->contour.pieces.size(), 30U);
  std::size_t sources = 0;
  for (const Joint& joint : f->contour.joints) sources += joint.source ? 1 : 0;
  EXPECT_EQ(sources, kTenPoints.size());
}

}  // namespace
}  // namespace obvid
