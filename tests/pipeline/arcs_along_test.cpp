// SPDX-License-Identifier: Apache-2.0
// Few arcs within a tolerance of contours of every carrier.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "../common/ten_points.h"
#include "obvid/contour/arcs/arcs_along.h"
#include "obvid/pipeline/fit.h"

namespace obvid {
namespace {

Contour contour_of(Carrier carrier) {
  PointSeries series;
  series.points = kTenPoints;
  FitJob job;
  job.carrier = carrier;
  auto f = fit(series, job);
  EXPECT_TRUE(f);
  return f ? f->contour : Contour{};
}

/// Largest distance of dense points of one curve from dense points of the other.
double farthest(const std::vector<Piece>& from, const std::vector<Piece>& to, int each) {
  std::vector<Vec2> there;
  for (const Piece& piece : to) {
    for (int k = 0; k <= 400; ++k) there.push_back(evaluate(piece, k / 400.0).point);
  }
  double most = 0.0;
  for (const Piece& piece : from) {
    for (int k = 0; k <= each; ++k) {
      const Vec2 p = evaluate(piece, static_cast<double>(k) / each).point;
      double least = HUGE_VAL;
      for (std::size_t i = 1; i < there.size(); ++i) {
        const Vec2 along = there[i] - there[i - 1], v = p - there[i - 1];
        const double t = std::clamp(dot(v, along) / std::max(dot(along, along), 1e-300), 0.0, 1.0);
        least = std::min(least, norm(v - t * along));
      }
      most = std::max(most, least);
    }
  }
  return most;
}

void expect_tangent(const std::vector<Piece>& pieces) {
  for (std::size_t i = 1; i < pieces.size(); ++i) {
    EXPECT_EQ(end_point(pieces[i - 1]), start_point(pieces[i])) << i;
    const Jet a = evaluate(pieces[i - 1], 1.0), b = evaluate(pieces[i], 0.0);
    EXPECT_LT(std::abs(turning(a.d1, b.d1)), 1e-9) << i;
  }
}

TEST(ArcsAlong, StayWithinTheToleranceAndTangentOnEveryCarrier) {
  for (const Carrier carrier : kAllCarriers) {
    if (carrier == Carrier::kArcs) continue;
    const Contour contour = contour_of(carrier);
    for (const double tolerance : {1.0, 0.05}) {
      const auto arcs = arcs_along(contour, tolerance);
      ASSERT_TRUE(arcs) << to_string(carrier) << to_line(arcs.error());
      EXPECT_LE(arcs->deviation, tolerance);
      EXPECT_LE(farthest(contour.pieces, arcs->pieces, 40), tolerance) << to_string(carrier);
      expect_tangent(arcs->pieces);
      EXPECT_EQ(start_point(arcs->pieces.front()), kTenPoints.front());
      EXPECT_LT(norm(end_point(arcs->pieces.back()) - kTenPoints.back()), 1e-12);
    }
  }
}

TEST(ArcsAlong, TheirNumberGrowsWithTheThirdRootOfTheTolerance) {
  const Contour contour = contour_of(Carrier::kSpiral);
  const auto coarse = arcs_along(contour, 0.1), fine = arcs_along(contour, 0.1 / 512.0);
  ASSERT_TRUE(coarse && fine);
  const double ratio =
      static_cast<double>(fine->pieces.size()) / static_cast<double>(coarse->pieces.size());
  EXPECT_GT(ratio, 5.0);
  EXPECT_LT(ratio, 10.0);  // 8 in the limit
}

TEST(ArcsAlong, RadiiAreMonotoneWhereTheContourIs) {
  const auto arcs = arcs_along(contour_of(Carrier::kSpiral), 0.01);
  ASSERT_TRUE(arcs);
  double before = -HUGE_VAL;
  for (const Piece& piece : arcs->pieces) {
    const double kappa = curvature(evaluate(piece, 0.5));
    EXPECT_GE(kappa, before - 1e-12);
    before = kappa;
  }
}

TEST(ArcsAlong, ExactLinesAndArcsStayWhole) {
  const Contour contour = contour_of(Carrier::kArcs);
  const auto arcs = arcs_along(contour, 1.0);
  ASSERT_TRUE(arcs);
  EXPECT_EQ(arcs->pieces.size(), contour.pieces.size());
  EXPECT_EQ(arcs->deviation, 0.0);
}

TEST(ArcsAlong, RefusesWhatCannotBe) {
  EXPECT_EQ(arcs_along(contour_of(Carrier::kSpiral), 0.0).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(arcs_along(contour_of(Carrier::kSpiral), std::nan("")).error().code,
            ErrorCode::kBadOption);
  EXPECT_EQ(arcs_along({}, 1.0).error().code, ErrorCode::kNothingThere);
}

}  // namespace
}  // namespace obvid
