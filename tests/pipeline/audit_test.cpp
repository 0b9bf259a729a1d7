// SPDX-License-Identifier: Apache-2.0
// The audit of curves that another system made: what a comb would show, named and placed.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "../common/angles.h"
#include "../common/arcs.h"
#include "obvid/contour/bsplines.h"
#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/audit.h"

namespace obvid {
namespace {

int count(const CurveAudit& a, AuditPlace::Kind kind) {
  return static_cast<int>(std::count_if(a.places.begin(), a.places.end(),
                                        [&](const AuditPlace& p) { return p.kind == kind; }));
}

TEST(Audit, LineAndArcHaveACurvatureJumpAndNoVertex) {
  DrawnCurve curve{
      "LINE, ARC", {LinePiece{{0, 0}, {2, 0}}, arc_from({2, 0}, 0.0, 0.5, kPi)}, false};
  const CurveAudit a = audit(curve, "mm");
  EXPECT_EQ(a.continuity, 1);
  ASSERT_EQ(a.places.size(), 1U);
  EXPECT_EQ(a.places[0].kind, AuditPlace::Kind::kCurvatureJump);
  EXPECT_NEAR(a.places[0].s, 2.0, 1e-12);
  EXPECT_EQ(a.places[0].kappa_before, 0.0);
  EXPECT_NEAR(a.places[0].kappa_after, 0.5, 1e-12);
  EXPECT_NEAR(a.length, 2.0 + kPi, 1e-4);
}

/// Two lines of length 4 and two half circles of radius 1: the curvature is 0 and 1 in turns.
TEST(Audit, EveryPieceOfASlotIsAVertexInItsMiddle) {
  const std::vector<Piece> slot = {LinePiece{{0, 0}, {4, 0}}, arc_from({4, 0}, 0.0, 1.0, kPi),
                                   LinePiece{{4, 2}, {0, 2}}, arc_from({0, 2}, kPi, 1.0, kPi)};
  const double half = 4.0 + kPi;
  for (std::size_t seam = 0; seam < slot.size(); ++seam) {
    DrawnCurve curve{"slot", slot, true};
    std::rotate(curve.pieces.begin(), curve.pieces.begin() + static_cast<std::ptrdiff_t>(seam),
                curve.pieces.end());
    const CurveAudit a = audit(curve, "mm");
    EXPECT_EQ(a.vertices, 4);
    EXPECT_EQ(a.visible_vertices, 4);
    std::vector<double> at;
    for (const AuditPlace& place : a.places) {
      if (place.kind == AuditPlace::Kind::kVertex) at.push_back(place.s);
    }
    const double first = seam % 2 == 0 ? 2.0 : 0.5 * kPi;
    const std::vector<double> expected{first, first + 0.5 * half, first + half, first + 1.5 * half};
    ASSERT_EQ(at.size(), expected.size());
    for (std::size_t k = 0; k < at.size(); ++k) EXPECT_NEAR(at[k], expected[k], 1e-6);
  }
}

/// As polylines of drawings have them: arcs by their bulges, curvatures of pieces a rounding apart.
TEST(Audit, AVertexOfAnArcLiesInItsMiddle) {
  constexpr double kBulge = 0.41421356237309503, kRadius = 12.0, kWide = 200.0, kHigh = 120.0;
  const double sweep = 4.0 * std::atan(kBulge);
  const std::vector<Vec2> ends = {{kRadius, 0},
                                  {kWide - kRadius, 0},
                                  {kWide, kRadius},
                                  {kWide, kHigh - kRadius},
                                  {kWide - kRadius, kHigh},
                                  {kRadius, kHigh},
                                  {0, kHigh - kRadius},
                                  {0, kRadius}};
  DrawnCurve curve{"plate", {}, true};
  for (std::size_t k = 0; k < ends.size(); ++k) {
    const Vec2 from = ends[k], to = ends[(k + 1) % ends.size()];
    if (k % 2 == 0) {
      curve.pieces.emplace_back(LinePiece{from, to});
      continue;
    }
    const double kappa = 4.0 * kBulge / (norm(to - from) * (1.0 + kBulge * kBulge));
    curve.pieces.emplace_back(
        ArcPiece{from, to, heading(to - from) - 0.5 * sweep, kappa, sweep / kappa});
  }
  const CurveAudit a = audit(curve, "mm");
  const double arc = 0.5 * kPi * kRadius, across = kWide - 2.0 * kRadius,
               up = kHigh - 2.0 * kRadius;
  std::vector<double> expected;
  double s = 0.0;
  for (const double length : {across, arc, up, arc, across, arc, up, arc}) {
    expected.push_back(s + 0.5 * length);
    s += length;
  }
  std::size_t next = 0;
  for (const AuditPlace& place : a.places) {
    if (place.kind != AuditPlace::Kind::kVertex) continue;
    ASSERT_LT(next, expected.size());
    EXPECT_NEAR(place.s, expected[next++], 1e-9);
  }
  EXPECT_EQ(next, expected.size());
}

TEST(Audit, CornersAndGapsAreNamedWithTheirSizes) {
  DrawnCurve curve{
      "polyline",
      {LinePiece{{0, 0}, {1, 0}}, LinePiece{{1, 0}, {1, 1}}, LinePiece{{1.001, 1}, {1.001, 2}}},
      false};
  const CurveAudit a = audit(curve, "mm");
  EXPECT_EQ(a.continuity, -1);
  ASSERT_EQ(a.places.size(), 2U);
  EXPECT_EQ(a.places[0].kind, AuditPlace::Kind::kCorner);
  EXPECT_NEAR(a.places[0].size, 0.5 * kPi, 1e-12);
  EXPECT_EQ(a.places[1].kind, AuditPlace::Kind::kGap);
  EXPECT_NEAR(a.places[1].size, 0.001, 1e-12);
}

/// y over x of a cubic polynomial between two whole numbers, by values and slopes at them.
Piece cubic_over(double from, double y0, double slope0, double y1, double slope1) {
  RationalBezier out;
  out.degree = 3;
  out.offset = {Vec2{from, y0}, Vec2{from + 1.0 / 3.0, y0 + slope0 / 3.0},
                Vec2{from + 2.0 / 3.0, y1 - slope1 / 3.0}, Vec2{from + 1.0, y1}};
  out.weight = {1.0, 1.0, 1.0, 1.0};
  return out;
}

// y'' is 0.1 x up to x = 1 and 0.05 (x - 2) from there: the curvature rises, changes its sign by a
// jump and rises again. Both of its extrema and the change of sign are the jump.
TEST(Audit, AJointHasOneRow) {
  const double y = 0.1 / 6.0, slope = 0.05;
  const Piece first = cubic_over(0.0, 0.0, 0.0, y, slope);
  const Piece second = cubic_over(1.0, y, slope, y + slope - 0.05 / 3.0, slope - 0.025);
  const CurveAudit a = audit(DrawnCurve{"spline", {first, second}, false}, "mm");
  EXPECT_GE(a.vertices, 1);
  ASSERT_EQ(a.places.size(), 1U);
  EXPECT_EQ(a.places[0].kind, AuditPlace::Kind::kCurvatureJump);
  EXPECT_NEAR(a.places[0].kappa_before, 0.1 / std::pow(1.0 + slope * slope, 1.5), 1e-9);
  EXPECT_NEAR(a.places[0].kappa_after, -0.05 / std::pow(1.0 + slope * slope, 1.5), 1e-9);
}

TEST(Audit, AnEllipseHasItsFourVerticesAtItsAxes) {
  // four rational quadratics
  DrawnCurve curve{"ELLIPSE", {}, true};
  const Vec2 axis[] = {{3, 0}, {0, 2}, {-3, 0}, {0, -2}};
  for (int k = 0; k < 4; ++k) {
    const Vec2 a = axis[k], b = axis[(k + 1) % 4];
    RationalBezier piece;
    piece.degree = 2;
    piece.offset = {a, a + b, b};
    piece.weight = {1.0, std::sqrt(0.5), 1.0};
    curve.pieces.emplace_back(piece);
  }
  const CurveAudit a = audit(curve, "mm");
  EXPECT_EQ(a.vertices, 4);
  EXPECT_EQ(count(a, AuditPlace::Kind::kVertex), 4) << "one of them at the seam";
  EXPECT_EQ(a.continuity, 3);  // analytic
  EXPECT_NEAR(a.largest_kappa, 3.0 / 4.0, 1e-9);
  EXPECT_NEAR(a.least_kappa, 2.0 / 9.0, 1e-9);
  EXPECT_EQ(count(a, AuditPlace::Kind::kInflection), 0);
}

TEST(Audit, TheVerticesOfAFlatEllipseAreWhereItIsFlattest) {
  // beside the largest curvature a / b^2 that of the flat sides, b / a^2, changes by rounding only
  for (const double b : {10.0, 5.0, 0.1}) {
    const double a = 1000.0;
    DrawnCurve curve{"ELLIPSE", {}, true};
    // quarters between the axes' ends: the flat vertices are inside of two pieces
    const auto at = [&](double u) { return Vec2{a * std::cos(u), b * std::sin(u)}; };
    for (int k = 0; k < 4; ++k) {
      const double from = 0.25 * kPi * (2 * k - 1), middle = from + 0.25 * kPi;
      RationalBezier piece;
      piece.degree = 2;
      piece.offset = {at(from), std::sqrt(2.0) * at(middle), at(from + 0.5 * kPi)};
      piece.weight = {1.0, std::sqrt(0.5), 1.0};
      curve.pieces.emplace_back(piece);
    }
    const CurveAudit audited = audit(curve, "mm");
    int flat = 0;
    for (const AuditPlace& place : audited.places) {
      if (place.kind != AuditPlace::Kind::kVertex || place.kappa_before > 1.0 / a) continue;
      ++flat;
      EXPECT_NEAR(place.point.x, 0.0, 1e-3) << b;
      EXPECT_NEAR(std::abs(place.point.y), b, 1e-9 * b);
      EXPECT_NEAR(place.kappa_before * a * a / b, 1.0, 1e-8);
    }
    EXPECT_EQ(flat, 2) << b;
  }
}

TEST(Audit, NothingIsCountedWhereTheCurvatureHasNoBound) {
  // the first leg of the cubic has no length: its curvature grows as 1 / t towards the start
  RationalBezier cubic;
  cubic.degree = 3;
  cubic.offset = {Vec2{0, 0}, Vec2{0, 0}, Vec2{2, 3}, Vec2{-8, 5}};
  cubic.weight = {1, 1, 1, 1};
  const CurveAudit a = audit({"path", {LinePiece{{-5, 0}, {0, 0}}, cubic}, false}, "mm");
  EXPECT_FALSE(a.counted);
  EXPECT_EQ(a.continuity, 0) << "the heading turns by 56 degrees";
  EXPECT_EQ(as_drawn(a).find("0 vertices"), std::string::npos);
}

TEST(Audit, TheSplineOfCadSystemsShowsItsVerticesAndItsInflection) {
  const std::vector<Vec2> points = {
      {0, 0},          {0.21, -5.28},  {-5.11, -10.13}, {-20.48, -7.65}, {-28.68, 16.23},
      {-13.87, 40.95}, {17.95, 55.28}, {54.24, 53.04},  {100.94, 36.19}, {230.38, -50.82}};
  const auto spline = cubic_spline(points);
  ASSERT_TRUE(spline);
  DrawnCurve curve{"SPLINE", {}, false};
  for (const RationalBezier& piece : bezier_pieces(*spline)) curve.pieces.emplace_back(piece);
  const CurveAudit a = audit(curve, "mm");
  EXPECT_EQ(a.vertices, 9);
  EXPECT_EQ(count(a, AuditPlace::Kind::kVertex), 9);
  EXPECT_EQ(a.inflections, 1);
  EXPECT_EQ(count(a, AuditPlace::Kind::kInflection), 1);
  EXPECT_LT(a.visible_vertices, 9);
  EXPECT_GT(a.visible_vertices, 0);
  for (const AuditPlace& p : a.places) {
    if (p.kind != AuditPlace::Kind::kVertex) continue;
    EXPECT_GE(p.s, 0.0);
    EXPECT_LE(p.s, a.length);
  }
}

TEST(Audit, ACircleHasNoVerticesWhateverItsRounding) {
  DrawnCurve curve{"CIRCLE", {}, true};
  for (int k = 0; k < 4; ++k) {
    curve.pieces.emplace_back(arc_from(1e5 * Vec2{1, 1} + unit_at(0.5 * kPi * k) * 1e-3,
                                       0.5 * kPi * (k + 1), 1e3, 0.5 * kPi * 1e-3));
  }
  const CurveAudit a = audit(curve, "mm");
  EXPECT_EQ(count(a, AuditPlace::Kind::kVertex), 0);
  EXPECT_EQ(a.visible_vertices, 0);
}

/// A nearly straight clothoid: x is the length, the third power of the turning is nothing.
ClothoidPiece gentle(Vec2 start, double theta, double kappa0, double kappa1, double length) {
  const double turn = theta * length + (2.0 * kappa0 + kappa1) * length * length / 6.0;
  return {start, start + Vec2{length, turn}, theta, kappa0, kappa1, length};
}

TEST(Audit, AShortPieceIsAsCurvedAsThoseThatItJoins) {
  // the middle one is so short that its height over the chord is rounding: 64 2^-53 / 1e-8 > 2e-7
  const double kappa[] = {1e-7, 2e-7, 2.01e-7, 3e-7}, length[] = {0.5, 1e-4, 0.5};
  DrawnCurve curve{"transition", {}, false};
  Vec2 at{0.5, 0.0};
  double theta = 0.0;
  for (int i = 0; i < 3; ++i) {
    const ClothoidPiece piece = gentle(at, theta, kappa[i], kappa[i + 1], length[i]);
    curve.pieces.emplace_back(piece);
    at = piece.end;
    theta += 0.5 * (kappa[i] + kappa[i + 1]) * length[i];
  }
  const CurveAudit meant = audit(curve, "mm");
  EXPECT_EQ(meant.straightened, 0U);
  EXPECT_EQ(meant.continuity, 2);
  EXPECT_EQ(meant.vertices, 0);
  // alone it says nothing
  curve.pieces = {curve.pieces[1]};
  EXPECT_EQ(audit(curve, "mm").straightened, 2U);
}

TEST(Audit, WhatRoundingLeavesOfALineBesideATransitionIsStraight) {
  const ClothoidPiece line = gentle({0, 0}, 0.0, -1e-17, 1e-17, 1.0);
  DrawnCurve curve{"transition", {line, gentle(line.end, 0.0, 1e-17, 1e-3, 1.0)}, false};
  const CurveAudit a = audit(curve, "mm");
  EXPECT_EQ(a.straightened, 3U);
  EXPECT_EQ(a.inflections, 0);
  EXPECT_EQ(a.vertices, 0);
}

/// A curve made of elements; those of other transitions are clothoids along them.
class Elements {
 public:
  Elements& add(double kappa0, double kappa1, double length,
                Transition kind = Transition::kClothoid) {
    at_.kappa = kappa0;
    const Element end = transition_at(kind, at_, kappa1, length, length);
    if (kind != Transition::kClothoid) {
      const auto pieces = clothoids_along(kind, at_, kappa1, length, 1e-6 * length);
      EXPECT_TRUE(pieces.has_value());
      curve_.transitions.push_back(
          {curve_.pieces.size(), pieces->size(), kind, kappa0, kappa1, length});
      curve_.pieces.insert(curve_.pieces.end(), pieces->begin(), pieces->end());
    } else if (kappa0 == 0.0 && kappa1 == 0.0) {
      curve_.pieces.emplace_back(LinePiece{at_.point, end.point});
    } else if (kappa0 == kappa1) {
      curve_.pieces.emplace_back(ArcPiece{at_.point, end.point, at_.theta, kappa0, length});
    } else {
      curve_.pieces.emplace_back(
          ClothoidPiece{at_.point, end.point, at_.theta, kappa0, kappa1, length});
    }
    at_ = end;
    return *this;
  }
  [[nodiscard]] CurveAudit audited() const { return audit(curve_, "m"); }

 private:
  DrawnCurve curve_{"road", {}, false};
  Element at_;
};

/// The curvatures of all these transitions are monotone by their closed forms.
TEST(Audit, TransitionsCountAsTheyAreNotAsTheClothoidsInTheirPlace) {
  for (const Transition kind : {Transition::kBloss, Transition::kSine, Transition::kCosine,
                                Transition::kHelmert, Transition::kCubic}) {
    SCOPED_TRACE(name_of(kind));
    const double kappa = 1.0 / 250.0;
    const CurveAudit road = Elements()
                                .add(0.0, 0.0, 80.0)
                                .add(0.0, kappa, 70.0, kind)
                                .add(kappa, kappa, 90.0)
                                .add(kappa, 0.0, 60.0, kind)
                                .add(0.0, 0.0, 50.0)
                                .audited();
    EXPECT_EQ(road.vertices, 1);
    EXPECT_EQ(road.visible_vertices, 1);
    EXPECT_EQ(road.inflections, 0);
    ASSERT_EQ(road.places.size(), 1U);
    EXPECT_NEAR(road.places[0].s, 195.0, 1e-3);
    EXPECT_NEAR(road.largest_kappa, kappa, 1e-15);
    EXPECT_EQ(road.least_kappa, 0.0);
    EXPECT_EQ(road.contour.runs.size(), 5U);  // line, rising, arc, falling, line
    // the slope of a cubic parabola's curvature is greatest at its inflection, that of all others
    // vanishes at both ends
    EXPECT_EQ(road.continuity, kind == Transition::kCubic ? 2 : 3);
    const DrawnFigures figures = figures_of(road);
    EXPECT_EQ(figures.pieces, 5U);
    EXPECT_EQ(figures.points, 6U);
    const CurveAudit turned = Elements().add(-kappa, 0.8 * kappa, 90.0, kind).audited();
    EXPECT_EQ(turned.vertices, 0);
    EXPECT_EQ(turned.inflections, 1);
    ASSERT_EQ(turned.places.size(), 1U);
    EXPECT_EQ(turned.places[0].kind, AuditPlace::Kind::kInflection);
    // the curvature steps where the file says so
    const CurveAudit step =
        Elements().add(0.0, kappa, 70.0, kind).add(1.2 * kappa, 1.2 * kappa, 90.0).audited();
    EXPECT_EQ(step.continuity, 1);
    ASSERT_EQ(step.places.size(), 1U);
    EXPECT_EQ(step.places[0].kind, AuditPlace::Kind::kCurvatureJump);
    EXPECT_DOUBLE_EQ(step.places[0].kappa_before, kappa);
  }
}

TEST(Audit, NothingIsNothing) {
  const CurveAudit a = audit({"empty", {}, false}, "mm");
  EXPECT_TRUE(a.places.empty());
  EXPECT_EQ(a.length, 0.0);
}

/// Where the curvature changes its sign: the middle of what is straight in between, else the place
/// itself. Lengths and places by hand.
TEST(Audit, InflectionsLieWhereTheirLengthSays) {
  const double quarter = 0.5 * kPi;
  // up an arc to the left, 6 along a line to the north, an arc to the right
  const std::vector<Piece> s_shape = {arc_from({0, 0}, 0.0, 1.0, quarter),
                                      LinePiece{{1, 1}, {1, 7}},
                                      arc_from({1, 7}, quarter, -0.5, kPi)};
  const CurveAudit a = audit({"S", s_shape, false}, "mm");
  ASSERT_EQ(count(a, AuditPlace::Kind::kInflection), 1);
  for (const AuditPlace& place : a.places) {
    if (place.kind != AuditPlace::Kind::kInflection) continue;
    EXPECT_NEAR(place.s, quarter + 3.0, 1e-9);
    EXPECT_NEAR(place.point.x, 1.0, 1e-9);
    EXPECT_NEAR(place.point.y, 4.0, 1e-9);
  }
}

TEST(Audit, InflectionsAreFoundAcrossTheSeamOfALoop) {
  // an eight of two circles of radius 1 beside each other, with lines of length 2 that cross
  const double half = std::sqrt(3.0);  // from the crossing to where a circle is touched
  const double turn = 4.0 / 3.0 * kPi;
  const Vec2 right_low{1.5, -0.5 * half}, right_high{1.5, 0.5 * half};
  const Vec2 left_low{-1.5, -0.5 * half}, left_high{-1.5, 0.5 * half};
  const double up = std::atan2(half, 3.0);
  const std::vector<Piece> eight = {
      LinePiece{left_low, right_high}, arc_from(right_high, up, -1.0, turn),
      LinePiece{right_low, left_high}, arc_from(left_high, kPi - up, 1.0, turn)};
  for (std::size_t seam = 0; seam < eight.size(); ++seam) {
    DrawnCurve curve{"eight", eight, true};
    std::rotate(curve.pieces.begin(), curve.pieces.begin() + static_cast<std::ptrdiff_t>(seam),
                curve.pieces.end());
    const CurveAudit a = audit(curve, "mm");
    EXPECT_EQ(count(a, AuditPlace::Kind::kInflection), 2);
    for (const AuditPlace& place : a.places) {
      if (place.kind != AuditPlace::Kind::kInflection) continue;
      EXPECT_NEAR(norm(place.point), 0.0, 1e-9) << "seam " << seam;
      double from_line = std::fmod(place.s, half + half + turn);
      if (seam % 2 == 1) from_line -= turn;
      EXPECT_NEAR(from_line, half, 1e-9) << "seam " << seam;
    }
  }
}

TEST(Audit, AnInflectionInsideAPieceIsItsPlace) {
  // y = x^3 over [-1, 2]: x = -1 + 3 t
  RationalBezier cubic;
  cubic.degree = 3;
  cubic.weight = {1, 1, 1, 1};
  cubic.origin = {-1, -1};
  cubic.offset = {Vec2{0, 0}, Vec2{1, 3}, Vec2{2, -3}, Vec2{3, 9}};
  const CurveAudit a = audit({"cubic", {Piece(cubic)}, false}, "mm");
  ASSERT_EQ(count(a, AuditPlace::Kind::kInflection), 1);
  for (const AuditPlace& place : a.places) {
    if (place.kind != AuditPlace::Kind::kInflection) continue;
    EXPECT_NEAR(place.point.x, 0.0, 1e-9);
    EXPECT_NEAR(place.point.y, 0.0, 1e-9);
  }
}

}  // namespace
}  // namespace obvid
