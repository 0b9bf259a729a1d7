// SPDX-License-Identifier: Apache-2.0
// Where an input goes: expected places are those of the plane geometry behind each name.
#include "obvid/pipeline/placement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <variant>

#include "obvid/pipeline/analyse.h"
#include "obvid/pipeline/import.h"

namespace obvid {
namespace {

constexpr double kHalfTurn = std::numbers::pi;
constexpr double kNear = 1e-14;

void expect_at(Vec2 p, double x, double y) {
  EXPECT_NEAR(p.x, x, kNear * (1.0 + std::abs(x)));
  EXPECT_NEAR(p.y, y, kNear * (1.0 + std::abs(y)));
}

PointSeries two_points() {
  PointSeries series;
  series.points = {{1.0, 0.0}, {3.0, 4.0}};
  series.fixed.resize(2);
  series.rounding = {0.5, 0.125};
  return series;
}

TEST(Placement, MirrorsThenScalesThenTurnsThenMoves) {
  PointSeries series = two_points();
  place({Mirror::kX, 2.0, 0.5 * kHalfTurn, {10.0, 20.0, 0.0}}, series);
  // (3, 4) -> (3, -4) -> (6, -8) -> (8, 6) -> (18, 26), without a last digit of the sine
  EXPECT_EQ(series.points[1], (Vec2{18.0, 26.0}));
  EXPECT_EQ(series.points[0], (Vec2{10.0, 22.0}));
}

TEST(Placement, ChangesNothingUntilItIsAsked) {
  PointSeries series = two_points();
  EXPECT_TRUE(Placement{}.changes_nothing());
  place({}, series);
  EXPECT_EQ(series.points, two_points().points);
}

TEST(Placement, HeadingsCurvaturesRangesAndTolerancesGoAlong) {
  FixedData fixed;
  fixed.theta = 0.25;
  fixed.kappa = 0.5;
  fixed.tolerance = 0.125;
  fixed.thetas = ValueRange{0.25, 0.5};
  fixed.kappas = ValueRange{0.5, std::numeric_limits<double>::infinity()};
  place({Mirror::kX, 4.0, 1.0, {}}, fixed);
  EXPECT_DOUBLE_EQ(*fixed.theta, 0.75);
  EXPECT_DOUBLE_EQ(*fixed.kappa, -0.125);
  EXPECT_DOUBLE_EQ(*fixed.tolerance, 0.5);
  EXPECT_DOUBLE_EQ(fixed.thetas->low, 0.5);
  EXPECT_DOUBLE_EQ(fixed.thetas->high, 0.75);
  EXPECT_EQ(fixed.kappas->low, -std::numeric_limits<double>::infinity());
  EXPECT_DOUBLE_EQ(fixed.kappas->high, -0.125);
}

TEST(Placement, AMirrorAcrossTheYAxisTurnsHeadingsAbout) {
  FixedData fixed;
  fixed.theta = 0.25;
  place({Mirror::kY, 1.0, 0.0, {}}, fixed);
  EXPECT_NEAR(std::cos(*fixed.theta), -std::cos(0.25), kNear);
  EXPECT_NEAR(std::sin(*fixed.theta), std::sin(0.25), kNear);
}

TEST(Placement, ThePrintedRoundingStaysInsideItself) {
  PointSeries quarter = two_points(), skew = two_points(), half = two_points();
  place({Mirror::kNone, 2.0, 0.5 * kHalfTurn, {}}, quarter);
  EXPECT_EQ(quarter.rounding, (Vec2{0.25, 1.0}));
  place({Mirror::kNone, 1.0, kHalfTurn, {}}, half);
  EXPECT_EQ(half.rounding, (Vec2{0.5, 0.125}));
  place({Mirror::kNone, 1.0, 0.7, {}}, skew);
  EXPECT_EQ(skew.rounding, (Vec2{0.125, 0.125}));
}

TEST(Placement, HeightsAreScaledAndMoved) {
  SpaceSeries series;
  series.points = {{1.0, 2.0, 3.0}};
  place({Mirror::kNone, 2.0, kHalfTurn, {0.0, 0.0, 5.0}}, series);
  EXPECT_EQ(series.points[0], (Vec3{-2.0, -4.0, 11.0}));
}

TEST(Placement, HeightsOfProfilesAndOfFixedDataAreLiftedToo) {
  const Placement placement{Mirror::kNone, 2.0, 0.0, {1.0, 1.0, 5.0}};
  Drawing drawing;
  drawing.curves.push_back({"one", {LinePiece{{0.0, 0.0}, {10.0, 0.0}}}, false});
  VerticalProfile& heights = drawing.curves[0].profile.emplace();
  heights.elements = {{ProfileKind::kGrade, 1.0, 9.0, 3.0, 0.5, 0.5, 0.0}};
  heights.end_station = 10.0;
  heights.end_height = 7.5;
  place(placement, drawing);
  EXPECT_EQ(heights.elements[0].station, 2.0);
  EXPECT_EQ(heights.elements[0].height, 11.0);
  EXPECT_EQ(heights.elements[0].grade0, 0.5);
  EXPECT_EQ(heights.end_station, 20.0);
  EXPECT_EQ(heights.end_height, 20.0);
  FixedData fixed;
  fixed.height = 3.0;
  place(placement, fixed);
  EXPECT_EQ(fixed.height, 11.0);
}

/// Places along a piece go where the placement of points says.
void expect_along(const Piece& piece, const Placement& placement) {
  Drawing drawing;
  drawing.curves.push_back({"one", {piece}, false});
  place(placement, drawing);
  const Piece& placed = drawing.curves[0].pieces[0];
  for (const double t : {0.0, 0.25, 0.5, 1.0}) {
    PointSeries beside;
    const Jet before = evaluate(piece, t);
    beside.points = {before.point};
    place(placement, beside);
    const Jet after = evaluate(placed, t);
    expect_at(after.point, beside.points[0].x, beside.points[0].y);
    const double sign = placement.mirror == Mirror::kNone ? 1.0 : -1.0;
    EXPECT_NEAR(curvature(after), sign * curvature(before) / placement.scale, 1e-12);
  }
}

TEST(Placement, PiecesOfDrawingsKeepTheirShape) {
  const Vec2 top{std::sin(1.0), 1.0 - std::cos(1.0)};
  const ArcPiece arc{{0.0, 0.0}, top, 0.0, 1.0, 1.0};
  RationalBezier bend;
  bend.origin = {5.0, 1.0};
  bend.degree = 2;
  bend.offset[1] = {1.0, 0.0};
  bend.offset[2] = {2.0, 1.5};
  bend.weight = {1.0, 0.75, 1.0};
  for (const Placement& placement :
       {Placement{Mirror::kX, 1.0, 0.0, {}}, Placement{Mirror::kY, 1.0, 0.0, {}},
        Placement{Mirror::kNone, 2.5, 0.3, {7.0, -2.0, 0.0}},
        Placement{Mirror::kY, 0.5, -2.0, {1.0, 1.0, 0.0}}}) {
    expect_along(LinePiece{{1.0, 2.0}, {4.0, 6.0}}, placement);
    expect_along(arc, placement);
    expect_along(bend, placement);
  }
}

// The parabola through (0, 0), (2, 0) with the control point (1, 2) is highest in the middle, at 1.
TEST(DrawnFigures, ABoxHoldsTheCurveAndNotItsControlPoints) {
  RationalBezier bow;
  bow.degree = 2;
  bow.offset[1] = {1.0, 2.0};
  bow.offset[2] = {2.0, 0.0};
  bow.weight = {1.0, 1.0, 1.0};
  const DrawnFigures figures = figures_of(audit({"bow", {bow}, false}, Units{"mm"}));
  EXPECT_EQ(figures.kind, "spline");
  EXPECT_EQ(figures.points, 2u);
  expect_at(figures.low, 0.0, 0.0);
  expect_at(figures.high, 2.0, 1.0);
}

TEST(DrawnFigures, KindsAreThoseOfThePieces) {
  const LinePiece side{{0.0, 0.0}, {1.0, 0.0}}, next{{1.0, 0.0}, {1.0, 2.0}};
  EXPECT_EQ(figures_of(audit({"l", {side}, false}, Units{"mm"})).kind, "line");
  EXPECT_EQ(figures_of(audit({"l", {side, next}, false}, Units{"mm"})).kind, "2 lines");
  const ArcPiece half{{1.0, 0.0}, {-1.0, 0.0}, 0.5 * kHalfTurn, 1.0, kHalfTurn};
  const ArcPiece rest{{-1.0, 0.0}, {1.0, 0.0}, 1.5 * kHalfTurn, 1.0, kHalfTurn};
  const DrawnFigures circle = figures_of(audit({"c", {half, rest}, true}, Units{"mm"}));
  EXPECT_EQ(circle.kind, "circle");
  expect_at(circle.low, -1.0, -1.0);
  expect_at(circle.high, 1.0, 1.0);
  EXPECT_EQ(
      figures_of(audit({"b", {half, LinePiece{{-1.0, 0.0}, {1.0, 0.0}}}, true}, Units{"mm"})).kind,
      "1 line and 1 arc");
}

}  // namespace
}  // namespace obvid
