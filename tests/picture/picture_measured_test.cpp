// SPDX-License-Identifier: Apache-2.0
// Pictures of closed contours, corners and points with tolerances; two contours in one picture.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "obvid/picture/picture_svg.h"
#include "picture_contours.h"
#include "plane/moves.h"
#include "plane/region.h"
#include "plane/track.h"

namespace obvid {
namespace {

using namespace picture_test;
using Kind = PictureFeature::Kind;

/// Closed contour of four arcs, an oval of half turns pi/2 each.
Contour oval() {
  Contour contour;
  contour.closed = true;
  Vec2 at;
  double theta = 0.0;
  for (const double kappa : {1.0, 0.25, 1.0, 0.25}) {
    const ArcPiece arc = arc_from(at, theta, kappa, 0.5 * kPi / kappa);
    contour.joints.push_back({{at, theta, kappa}, std::nullopt, std::nullopt});
    contour.pieces.emplace_back(arc);
    at = arc.end;
    theta += 0.5 * kPi;
  }
  return contour;
}

/// Two arcs over the chord from (-1, 0) to (1, 0) and back that meet in corners.
Contour lens(double kappa_below, double kappa_above) {
  Contour contour;
  contour.closed = true;
  const Vec2 left{-1.0, 0.0}, right{1.0, 0.0};
  const double below = std::asin(kappa_below), above = std::asin(kappa_above);
  contour.pieces = {ArcPiece{left, right, -below, kappa_below, 2.0 * below / kappa_below},
                    ArcPiece{right, left, kPi - above, kappa_above, 2.0 * above / kappa_above}};
  contour.joints = {{{left, kPi + above, kappa_above}, 0, Element{left, -below, kappa_below}},
                    {{right, below, kappa_below}, 1, Element{right, kPi - above, kappa_above}}};
  contour.points = {left, right};
  contour.runs = {{0, 1, 0}};
  return contour;
}

std::vector<PictureFeature> of_kind(const PictureTrack& track, Kind kind) {
  std::vector<PictureFeature> found;
  for (const PictureFeature& one : track.features) {
    if (one.kind == kind) found.push_back(one);
  }
  return found;
}

std::size_t moves_in(const std::string& path) {
  return static_cast<std::size_t>(std::count(path.begin(), path.end(), 'M'));
}

TEST(PictureClosed, AnOvalHasFourVerticesOneOfThemAtTheSeam) {
  Contour contour = oval();
  ASSERT_LT(norm(end_point(contour.pieces.back())), 1e-15);
  contour.runs = {{0, 0, 1}, {1, 1, -1}, {2, 2, 1}, {3, 3, -1}};
  const PictureTrack track = make_track(contour);
  EXPECT_EQ(count_features(track, Kind::kVertex), 4U);
  EXPECT_EQ(count_features(track, Kind::kInflection), 0U);
  EXPECT_NEAR(of_kind(track, Kind::kVertex).front().at.s, 0.0, 1e-12);
  contour.closed = false;
  EXPECT_EQ(count_features(make_track(contour), Kind::kVertex), 3U);
}

TEST(PictureClosed, ARunThatGoesOnThroughTheSeamHasNoVertexThere) {
  Contour contour = oval();
  contour.runs = {{0, 0, 1}, {1, 2, -1}, {3, 3, 1}};
  EXPECT_EQ(count_features(make_track(contour), Kind::kVertex), 2U);
}

TEST(PictureClosed, AnInflectionMayStandAtTheSeam) {
  Contour contour;  // a figure of eight: one full circle left, one right
  contour.closed = true;
  contour.pieces = {
      ArcPiece{{0, 0}, {0, 2}, 0.0, 1.0, kPi}, ArcPiece{{0, 2}, {0, 0}, kPi, 1.0, kPi},
      ArcPiece{{0, 0}, {0, -2}, 0.0, -1.0, kPi}, ArcPiece{{0, -2}, {0, 0}, -kPi, -1.0, kPi}};
  EXPECT_EQ(count_features(make_track(contour), Kind::kInflection), 2U);
  contour.closed = false;
  EXPECT_EQ(count_features(make_track(contour), Kind::kInflection), 1U);
}

TEST(PictureClosed, IsDrawnClosedAndSaysSo) {
  StoredContour stored{oval(), std::nullopt, std::nullopt};
  stored.contour.runs = {{0, 3, 0}};
  const std::string closed = picture_svg(stored);
  EXPECT_EQ(path_of(closed, "curve even").back(), 'Z');
  EXPECT_NE(closed.find("Closed spiral contour"), std::string::npos);
  stored.contour.closed = false;
  const std::string open = picture_svg(stored);
  EXPECT_NE(path_of(open, "curve even").back(), 'Z');
  EXPECT_EQ(open.find("Closed"), std::string::npos);
}

TEST(PictureCorners, AreMarkedAndBreakTheCurvature) {
  StoredContour stored{lens(0.5, 0.5), std::nullopt, std::nullopt};
  const PictureTrack track = make_track(stored.contour);
  const auto corners = of_kind(track, Kind::kCorner);
  ASSERT_EQ(corners.size(), 2U);
  EXPECT_EQ(corners[0].at.s, 0.0);
  EXPECT_NEAR(corners[1].at.s, 4.0 * std::asin(0.5), 1e-6);
  EXPECT_EQ(count_features(track, Kind::kVertex), 0U) << "the curvature is the same on both sides";
  const std::string svg = picture_svg(stored);
  EXPECT_EQ(moves_in(path_of(svg, "graph even")), 2U);
  EXPECT_EQ(moves_in(path_of(svg, "envelope even")), 2U);
  EXPECT_EQ(paths_of(svg, "corner").size(), 3U) << "two on the curve, one in the legend";
  EXPECT_EQ(moves_in(path_of(svg, "break")), 2U);
  EXPECT_NE(svg.find("2 corners"), std::string::npos);
  for (Joint& joint : stored.contour.joints) joint.leaving.reset();
  const std::string smooth = picture_svg(stored);
  EXPECT_EQ(moves_in(path_of(smooth, "graph even")), 1U);
  EXPECT_TRUE(paths_of(smooth, "corner").empty());
  EXPECT_TRUE(paths_of(smooth, "break").empty());
}

TEST(PictureCorners, AJumpOfTheCurvatureTakesPartInTheVertices) {
  // Up at one corner, down at the other: each arc is an extremum, marked in its middle.
  const PictureTrack track = make_track(lens(0.5, 0.8));
  const auto vertices = of_kind(track, Kind::kVertex);
  ASSERT_EQ(vertices.size(), 2U);
  const double first = 4.0 * std::asin(0.5), second = 2.5 * std::asin(0.8);
  EXPECT_NEAR(vertices[0].at.s, 0.5 * first, 0.02);
  EXPECT_NEAR(vertices[1].at.s, first + 0.5 * second, 0.02);
}

TEST(PictureCorners, EndTheRegionThatThePointsLeave) {
  StoredContour stored;
  Contour& contour = stored.contour;
  contour.points = {{0.0, 0.0}, {0.4, 0.16}, {1.0, 1.0}, {1.5, 2.25}, {2.5, 6.25}, {3.0, 9.0}};
  for (std::size_t i = 0; i < contour.points.size(); ++i) {
    contour.joints.push_back({{contour.points[i], 0.0, 0.0}, i, std::nullopt});
    if (i > 0) contour.pieces.emplace_back(LinePiece{contour.points[i - 1], contour.points[i]});
  }
  contour.runs = {{0, 4, -1}};
  const auto lenses = [&] { return points_only_region(make_track(contour), contour).size(); };
  ASSERT_EQ(lenses(), 3U);
  contour.joints[2].leaving = contour.joints[2].element;
  EXPECT_EQ(lenses(), 1U) << "only the chord from the fourth point has no corner at its ends";
  contour.joints[2].leaving.reset();
  contour.point_tolerance.assign(contour.points.size(), 0.1);
  EXPECT_EQ(lenses(), 0U) << "a curve near the points may leave it";
}

/// Half circle of radius 5 with points beside it at these angles and distances outward.
StoredContour measured(const std::vector<double>& angles, const std::vector<double>& outward,
                       double tolerance) {
  StoredContour stored = semicircle(5.0, {3.0, 2.0});
  stored.contour.points.clear();
  for (std::size_t i = 0; i < angles.size(); ++i) {
    stored.contour.points.push_back(Vec2{3.0, 2.0} + (5.0 + outward[i]) * unit_at(angles[i]));
    stored.contour.point_tolerance.push_back(tolerance);
  }
  return stored;
}

const std::vector<double> kAngles = {0.1, 0.4, 0.41, 1.5, 2.9};
const std::vector<double> kOutward = {0.03, -0.1, 0.0, 0.05, -0.07};

TEST(PictureMoves, AreDistancesAlongTheArcWithTheSideOnWhichThePointLies) {
  const StoredContour stored = measured(kAngles, kOutward, 0.1);
  const PictureMoves moves = make_moves(make_track(stored.contour), stored);
  ASSERT_EQ(moves.points.size(), kAngles.size());
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    EXPECT_NEAR(moves.points[i].s, 5.0 * kAngles[i], 0.05) << i;
    EXPECT_NEAR(moves.points[i].part, -kOutward[i] / 0.1, 2e-3) << "outward is right; " << i;
  }
  EXPECT_NEAR(moves.largest, 0.1, 2e-4);
}

TEST(PictureMoves, AreThoseOfTheReportWhereItHasThem) {
  StoredContour stored = measured(kAngles, kOutward, 0.1);
  stored.report = FitReport{};
  stored.report->moves = {0.04, 0.11, 0.0, 0.06, 0.08};
  const PictureMoves moves = make_moves(make_track(stored.contour), stored);
  ASSERT_EQ(moves.points.size(), kAngles.size());
  EXPECT_DOUBLE_EQ(moves.points[0].part, -0.04 / 0.1);
  EXPECT_DOUBLE_EQ(moves.points[1].part, 0.11 / 0.1);
  EXPECT_EQ(moves.largest, 0.11);
}

TEST(PictureMoves, AreFoundAtTheJointThatStandsForAPoint) {
  StoredContour stored = measured({0.5, 3.0}, {0.02, 0.02}, 0.1);
  // The contour ends at the last point's joint, though the point lies before its end.
  stored.contour.joints = {
      {{start_point(stored.contour.pieces[0]), 0.5 * kPi, 0.2}, 0, std::nullopt},
      {{end_point(stored.contour.pieces[0]), 1.5 * kPi, 0.2}, 1, std::nullopt}};
  const PictureMoves moves = make_moves(make_track(stored.contour), stored);
  ASSERT_EQ(moves.points.size(), 2U);
  EXPECT_EQ(moves.points[0].s, 0.0);
  EXPECT_NEAR(moves.points[1].s, 5.0 * kPi, 1e-5);
}

TEST(PictureMoves, AreFoundOnAClosedContourThatBeginsAtALaterPoint) {
  StoredContour stored = measured({0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0},
                                  {0.02, 0.04, -0.06, 0.08, 0.0, -0.03, 0.05}, 0.1);
  Contour& contour = stored.contour;  // a whole circle from the angle 4 on
  const Vec2 start = Vec2{3.0, 2.0} + 5.0 * unit_at(4.0);
  const Vec2 middle = Vec2{3.0, 2.0} - 5.0 * unit_at(4.0);
  contour.closed = true;
  contour.pieces = {arc_from(start, 4.0 + 0.5 * kPi, 0.2, 5.0 * kPi),
                    arc_from(middle, 4.0 - 0.5 * kPi, 0.2, 5.0 * kPi)};
  contour.joints = {{{start, 4.0 + 0.5 * kPi, 0.2}, 4, std::nullopt},
                    {{middle, 4.0 - 0.5 * kPi, 0.2}, std::nullopt, std::nullopt}};
  const PictureMoves moves = make_moves(make_track(contour), stored);
  ASSERT_EQ(moves.points.size(), 7U);
  const double expected[] = {2 * kPi - 4, 2 * kPi - 3, 2 * kPi - 2, 2 * kPi - 1, 0.0, 1.0, 2.0};
  const double part[] = {-0.2, -0.4, 0.6, -0.8, 0.0, 0.3, -0.5};
  for (std::size_t i = 0; i < 7; ++i) {
    EXPECT_NEAR(moves.points[i].s, 5.0 * expected[i], 0.05) << i;
    EXPECT_NEAR(moves.points[i].part, part[i], 2e-3) << i;
  }
}

TEST(PictureMoves, StandBetweenTheLinesOfTheToleranceInAStripOfTheirOwn) {
  const StoredContour stored = measured(kAngles, kOutward, 0.1);
  const std::string svg = picture_svg(stored);
  const std::vector<std::string> limits = paths_of(svg, "limit");
  ASSERT_EQ(limits.size(), 2U);
  const double lower = numbers_of(limits[0])[1], upper = numbers_of(limits[1])[1];
  ASSERT_GT(lower, upper + 20.0);
  const std::vector<double> teeth = numbers_of(path_of(svg, "move"));
  ASSERT_EQ(teeth.size(), 4 * kAngles.size());
  const double zero = 0.5 * (lower + upper), unit = 0.5 * (lower - upper);
  for (std::size_t i = 0; i < kAngles.size(); ++i) {
    const double top = teeth[4 * i + 1], bottom = teeth[4 * i + 3];
    const double part = -kOutward[i] / 0.1;
    EXPECT_NEAR(top, zero - unit * std::max(part, 0.0), 0.1) << i;
    EXPECT_NEAR(bottom, zero - unit * std::min(part, 0.0), 0.1) << i;
  }
  EXPECT_NE(svg.find("in units of their tolerance"), std::string::npos);
}

/// Of these deviations with a tolerance of 0.1 three are within half of it.
TEST(PictureMoves, AreAMapInThreeColoursOnRequest) {
  StoredContour stored = measured(kAngles, {0.03, -0.095, 0.0, 0.045, -0.07}, 0.1);
  stored.report.emplace().moves = {0.03, 0.095, 0.0, 0.045, 0.07};
  const std::string svg = picture_svg(stored, {}, {.deviations = true});
  EXPECT_TRUE(paths_of(svg, "teeth").empty());
  EXPECT_NE(svg.find("3 points within half their tolerance"), std::string::npos);
  EXPECT_NE(svg.find("2 points up to their tolerance"), std::string::npos);
  EXPECT_EQ(svg.find("beyond it"), std::string::npos);
  // the root of (0.03^2 + 0.095^2 + 0.045^2 + 0.07^2) / 5
  EXPECT_NE(svg.find("at most 0.095"), std::string::npos);
  EXPECT_NE(svg.find("RMS 0.058"), std::string::npos);
  const auto longest = [&](const std::string& css) {
    const std::vector<double> n = numbers_of(paths_of(svg, css).at(0));
    double most = 0.0;
    for (std::size_t k = 0; k + 3 < n.size(); k += 4) {
      most = std::max(most, std::hypot(n[k + 2] - n[k], n[k + 3] - n[k + 1]));
    }
    return most;
  };
  EXPECT_NEAR(longest("deviation half"), 0.45 * 12.0, 0.1);
  EXPECT_NEAR(longest("deviation within"), 0.95 * 12.0, 0.1);
}

TEST(PictureMoves, AreMissingWhereNoPointHasATolerance) {
  EXPECT_TRUE(paths_of(picture_svg(semicircle(5.0, {})), "limit").empty());
  const StoredContour zero = measured(kAngles, kOutward, 0.0);
  EXPECT_TRUE(paths_of(picture_svg(zero), "limit").empty());
  StoredContour empty;
  empty.contour.points = {{0, 0}, {1, 0}};
  empty.contour.point_tolerance = {1.0, 1.0};
  EXPECT_NE(picture_svg(empty).find("</svg>"), std::string::npos);
}

TEST(Picture, SaysThatPointsLieWithinTheirTolerancesAndWhereCornersAre) {
  StoredContour stored{lens(0.5, 0.5), std::nullopt, Certificate{}};
  stored.contour.units = "mm";
  stored.contour.point_tolerance = {0.1, 0.1};
  stored.certificate->proved = true;
  stored.certificate->joints = 3;
  stored.certificate->corners = 2;
  stored.certificate->largest_move = 0.03;
  const std::string svg = picture_svg(stored);
  EXPECT_NE(svg.find("G2 joints between 2 corners, every point within its tolerance"),
            std::string::npos);
  EXPECT_NE(svg.find("points at most 0.03 mm from the contour · 2 corners"), std::string::npos);
}

double extent_x(const std::string& path) {
  const std::vector<double> n = numbers_of(path);
  double low = HUGE_VAL, high = -HUGE_VAL;
  for (std::size_t i = 0; i + 1 < n.size(); i += 2) {
    low = std::min(low, n[i]);
    high = std::max(high, n[i]);
  }
  return high - low;
}

TEST(PictureComparison, DrawsBothContoursInTheSameScales) {
  const std::string svg = comparison_svg(semicircle(2.0, {9.0, 0.0}).contour,
                                         semicircle(1.0, {0.0, 0.0}).contour, {"Both", "a", "b"});
  const std::vector<std::string> curves = paths_of(svg, "curve even");
  ASSERT_GE(curves.size(), 2U);
  EXPECT_GT(extent_x(curves[0]), 100.0);
  EXPECT_NEAR(extent_x(curves[0]), 2.0 * extent_x(curves[1]), 0.1);
  const std::vector<std::string> graphs = paths_of(svg, "graph even");
  const std::vector<std::string> axes = paths_of(svg, "axis");
  ASSERT_EQ(graphs.size(), 2U);
  ASSERT_GE(axes.size(), 4U);
  EXPECT_NEAR(extent_x(graphs[0]), 2.0 * extent_x(graphs[1]), 0.1) << "arc length";
  // Curvatures 1/2 and 1 above axes that begin at 0.
  const double first = numbers_of(axes[0])[1] - numbers_of(graphs[0])[1];
  const double second = numbers_of(axes[2])[1] - numbers_of(graphs[1])[1];
  EXPECT_GT(first, 20.0);
  EXPECT_NEAR(second, 2.0 * first, 0.1);
}

TEST(PictureComparison, CountsTheVerticesOfBoth) {
  Contour before = oval();
  before.runs = {{0, 0, 1}, {1, 1, -1}, {2, 2, 1}, {3, 3, -1}};
  Contour after = oval();
  after.runs = {{0, 0, 1}, {1, 2, -1}, {3, 3, 1}};
  const std::string svg = comparison_svg(before, after, {"Oval & more", "raw", "fair"});
  EXPECT_NE(svg.find(">raw: 4 vertices<"), std::string::npos);
  EXPECT_NE(svg.find(">fair: 2 vertices<"), std::string::npos);
  EXPECT_NE(svg.find("Oval &amp; more"), std::string::npos);
  // Each on its shape and on its plot, one in the legend.
  EXPECT_EQ(paths_of(svg, "vertex").size(), 2U * (4U + 2U) + 1U);
}

TEST(PictureComparison, CutsAxesThatASharpBendWouldFlattenAndSaysSo) {
  Contour sharp = arc_chain({0.1, 100.0, 0.1}, 1.0).contour;
  sharp.units = "mm";
  const Contour calm = arc_chain({0.1, 0.2, 0.1}, 1.0).contour;
  const std::string svg = comparison_svg(sharp, calm, {"Edge", "a", "b"});
  EXPECT_NE(svg.find("cut off: the largest is 100 1/mm"), std::string::npos);
  EXPECT_NE(svg.find("curvature comb, cut off at 0."), std::string::npos);
  const std::string whole = comparison_svg(calm, calm, {"Edge", "a", "b"});
  EXPECT_EQ(whole.find("cut off"), std::string::npos);
}

TEST(PictureComparison, CopesWithNothingAndALine) {
  Contour line;
  line.pieces = {LinePiece{{0, 0}, {3, 0}}};
  for (const Contour& one : {Contour{}, line}) {
    for (const Contour& other : {Contour{}, line}) {
      const std::string svg = comparison_svg(one, other, {"", "", ""});
      EXPECT_NE(svg.find("</svg>"), std::string::npos);
      EXPECT_EQ(svg.find("nan"), std::string::npos);
      EXPECT_EQ(svg.find("\"inf"), std::string::npos);
    }
  }
}

}  // namespace
}  // namespace obvid
