// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/bsplines/cubic_along.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <string>
#include <variant>
#include <vector>

#include "clothoid_data.h"
#include "obvid/contour/bsplines/nurbs_of.h"
#include "obvid/curve/internal/path_distance.h"
#include "obvid/curve/internal/smooth_parts.h"

namespace obvid {
namespace {

using test::uniform_between;

Contour arc_contour(double radius, double turn) {
  const ArcPiece arc = {
      {radius, 0.0}, radius * unit_at(turn), 0.5 * std::numbers::pi, 1.0 / radius, radius * turn};
  Contour c;
  c.pieces = {arc};
  c.joints.resize(2);
  c.joints[0].element = {arc.start, arc.theta0, arc.kappa};
  c.joints[1].element = {arc.end, arc.theta0 + turn, arc.kappa};
  c.runs = {{0, 0, 0}};
  return c;
}

/// Clothoids of length 1 in a row with these curvatures at their joints.
Contour clothoid_contour(const std::vector<double>& kappa) {
  Contour c;
  Element e = {{0.0, 0.0}, 0.4, kappa.front()};
  c.joints.emplace_back();
  c.joints.back().element = e;
  for (std::size_t i = 0; i + 1 < kappa.size(); ++i) {
    ClothoidPiece p = {e.point, {}, e.theta, kappa[i], kappa[i + 1], 1.0};
    p.end = p.start + test::end_by_quadrature(p.theta0, p.kappa0, p.kappa1, 1.0);
    e = {p.end, test::end_heading(p), kappa[i + 1]};
    c.pieces.emplace_back(p);
    c.joints.emplace_back();
    c.joints.back().element = e;
  }
  c.runs = {{0, c.pieces.size() - 1, 1}};
  return c;
}

TEST(CubicAlong, KeepsWithinItsToleranceOfACircle) {
  for (const double tolerance : {1e-2, 1e-4, 1e-6, 1e-8}) {
    const auto cubic = cubic_along(arc_contour(3.0, 2.5), tolerance);
    ASSERT_TRUE(cubic) << cubic.error().what;
    EXPECT_LE(cubic->deviation, tolerance);
    double worst = 0.0;
    const auto& knots = cubic->spline.knots;
    for (std::size_t i = 0; i + 1 < knots.size(); ++i) {
      for (double t = 0.0; t <= 1.0; t += 0.01) {
        const Vec2 p = evaluate(cubic->spline, knots[i] + t * (knots[i + 1] - knots[i])).point;
        worst = std::max(worst, std::abs(norm(p) - 3.0));
      }
    }
    EXPECT_LE(worst, tolerance);
    EXPECT_GT(worst, 0.2 * tolerance);  // not many more spans than needed
  }
}

TEST(CubicAlong, NeedsTheFourthRootOfTheToleranceInSpans) {
  const Contour c = clothoid_contour({0.1, 0.4, 1.5, 1.7, 3.0});
  std::vector<double> spans;
  for (const double tolerance : {1e-5, 1e-7, 1e-9}) {
    const auto cubic = cubic_along(c, tolerance);
    ASSERT_TRUE(cubic);
    spans.push_back(static_cast<double>(cubic->spline.knots.size() - 1));
  }
  const double expected = std::pow(100.0, 0.25);
  for (std::size_t i = 0; i + 1 < spans.size(); ++i) {
    EXPECT_NEAR(spans[i + 1] / spans[i], expected, 0.25 * expected) << i;
  }
}

TEST(CubicAlong, MeetsBothEndsWithTheirTangents) {
  const Contour c = clothoid_contour({-0.5, 0.2, 0.9});
  const auto cubic = cubic_along(c, 1e-4);
  ASSERT_TRUE(cubic);
  const Element a = c.joints.front().element, b = c.joints.back().element;
  EXPECT_EQ(cubic->spline.points.front(), a.point);
  EXPECT_EQ(cubic->spline.points.back(), b.point);
  constexpr double kRounding = 1e-12;
  EXPECT_NEAR(norm(cubic->spline.slopes.front() - unit_at(a.theta)), 0.0, kRounding);
  EXPECT_NEAR(norm(cubic->spline.slopes.back() - unit_at(b.theta)), 0.0, kRounding);
}

TEST(CubicAlong, HasContinuousCurvatureNearThatOfTheContour) {
  const Contour c = clothoid_contour({0.2, 0.5, 1.5});
  const auto cubic = cubic_along(c, 1e-7);
  ASSERT_TRUE(cubic);
  const auto& knots = cubic->spline.knots;
  double before = -HUGE_VAL;
  for (std::size_t i = 1; i + 1 < knots.size(); ++i) {
    const double width = knots[i] - knots[i - 1];
    const Jet left = evaluate(cubic->spline, knots[i] - 1e-9 * width);
    const Jet here = evaluate(cubic->spline, knots[i]);
    EXPECT_NEAR(curvature(left), curvature(here), 1e-6) << i;
    // curvature errs with the square of the span, which at this tolerance is below 1 % of it
    EXPECT_GT(curvature(here), before) << i;
    before = curvature(here);
  }
  EXPECT_NEAR(before, 1.5, 0.1);
}

TEST(CubicAlong, SaysWhyThereIsNone) {
  const Contour c = clothoid_contour({0.1, 0.4, 1.5});
  EXPECT_EQ(cubic_along(c, 0.0).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(cubic_along(Contour{}, 1.0).error().code, ErrorCode::kNothingThere);
  Contour corner = c;
  corner.joints[1].leaving = corner.joints[1].element;
  EXPECT_EQ(cubic_along(corner, 1e-3).error().code, ErrorCode::kUnsupported);
  const auto hopeless = cubic_along(c, 1e-30);  // below the rounding of the coordinates
  ASSERT_FALSE(hopeless);
  EXPECT_EQ(hopeless.error().code, ErrorCode::kToleranceNotReached);
}

TEST(CubicAlong, EndsItsSearchWhereMoreSpansCannotBeTold) {
  Contour far = arc_contour(300.0, 2.0);
  auto& arc = std::get<ArcPiece>(far.pieces[0]);
  const Vec2 away{459e6, 257e6};  // doubles are 6e-8 and 3e-8 apart there
  for (Vec2* p :
       {&arc.start, &arc.end, &far.joints[0].element.point, &far.joints[1].element.point}) {
    *p = *p + away;
  }
  const auto cubic = cubic_along(far, 2e-8);
  ASSERT_FALSE(cubic);
  EXPECT_EQ(cubic.error().code, ErrorCode::kToleranceNotReached);
  EXPECT_NE(cubic.error().what.find("rounding"), std::string::npos) << cubic.error().what;
  EXPECT_TRUE(cubic_along(far, 1e-5));
}

TEST(CubicAlong, ClothoidsWithCornersAreOneNurbsCurve) {
  constexpr double kTurn = 1.0, kTolerance = 1e-5;
  Contour c = clothoid_contour({0.0, 0.5, 1.0});
  Element leaving = c.joints.back().element;
  leaving.theta += kTurn;
  leaving.kappa = -0.7;
  c.joints.back().leaving = leaving;
  for (const double kappa : {-0.2, 0.3}) {
    ClothoidPiece p = {leaving.point, {}, leaving.theta, leaving.kappa, kappa, 1.0};
    p.end = p.start + test::end_by_quadrature(p.theta0, p.kappa0, p.kappa1, 1.0);
    leaving = {p.end, test::end_heading(p), kappa};
    c.pieces.emplace_back(p);
    c.joints.push_back({leaving, std::nullopt, {}});
  }
  const auto nurbs = nurbs_of(c, {.clothoid_tolerance = kTolerance});
  ASSERT_TRUE(nurbs) << nurbs.error().what;
  EXPECT_LE(nurbs->deviation, kTolerance);
  EXPECT_EQ(nurbs->curve.knots.size(), nurbs->curve.points.size() + 4);
  EXPECT_TRUE(std::is_sorted(nurbs->curve.knots.begin(), nurbs->curve.knots.end()));
  std::vector<Piece> spans;
  std::size_t corners = 0;
  for (const BezierSpan& span : bezier_spans(nurbs->curve)) {
    if (!spans.empty()) {
      const Jet before = evaluate(spans.back(), 1.0), behind = evaluate(Piece(span.piece), 0.0);
      EXPECT_LT(norm(before.point - behind.point), 1e-13);
      const double turn = std::atan2(cross(before.d1, behind.d1), dot(before.d1, behind.d1));
      if (std::abs(turn) > 0.1) {
        ++corners;
        EXPECT_NEAR(turn, kTurn, 1e-6);
        EXPECT_LT(norm(before.point - c.joints[2].element.point), 1e-13);
      }
    }
    spans.emplace_back(span.piece);
  }
  EXPECT_EQ(corners, 1U);
  EXPECT_LE(path_distance(c.pieces, spans), kTolerance);
}

TEST(CubicAlong, PartsOfAClosedContourBeginAtItsCorners) {
  Contour c;  // a square whose seam is in the middle of a side
  const std::vector<Vec2> at = {{1, 0}, {2, 0}, {2, 2}, {0, 2}, {0, 0}};
  c.closed = true;
  for (std::size_t i = 0; i < at.size(); ++i) {
    const Vec2 from = at[i], to = at[(i + 1) % at.size()];
    const double length = norm(to - from), theta = std::atan2(to.y - from.y, to.x - from.x);
    c.pieces.emplace_back(ClothoidPiece{from, to, theta, 0.0, 0.0, length});
    const double before = i == 0 ? 0.0 : theta - 0.5 * std::numbers::pi;
    Joint joint{{from, before, 0.0}, std::nullopt, {}};
    if (i > 0) joint.leaving = Element{from, theta, 0.0};
    c.joints.push_back(joint);
  }
  EXPECT_EQ(smooth_parts(c).size(), 4U);
  EXPECT_EQ(smooth_parts(c, false).size(), 5U);
  const auto nurbs = nurbs_of(c, {.clothoid_tolerance = 1e-6});
  ASSERT_TRUE(nurbs) << nurbs.error().what;
  EXPECT_EQ(nurbs->curve.points.front(), at[1]);
  EXPECT_EQ(nurbs->curve.points.back(), at[1]);
  std::vector<Piece> spans;
  for (const BezierSpan& span : bezier_spans(nurbs->curve)) spans.emplace_back(span.piece);
  EXPECT_LE(path_distance(c.pieces, spans), 1e-6);
}

}  // namespace
}  // namespace obvid
