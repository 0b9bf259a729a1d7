// SPDX-License-Identifier: Apache-2.0
// DXF files written by hand: every kind of entity against its closed form.
#include "../common/angles.h"
#include "drawing_checks.h"
#include "obvid/exchange/internal/dxf/read.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "dxf_text.h"

namespace obvid {
namespace {

using test::arc;
using test::dxf;
using test::line;
using test::Tags;
using test::operator+;
using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;

Drawing read_dxf_text(const std::string& text) {
  auto drawing = parse_dxf(text, "test.dxf");
  EXPECT_TRUE(drawing) << (drawing ? "" : to_line(drawing.error()));
  return drawing ? *std::move(drawing) : Drawing{};
}

Error refused(const std::string& text) {
  const auto drawing = parse_dxf(text, "test.dxf");
  EXPECT_FALSE(drawing);
  return drawing ? Error{} : drawing.error();
}

/// Every piece starts where the one before ends, with its heading when `smooth`.
void expect_connected(const DrawnCurve& curve, bool smooth) {
  for (std::size_t i = 1; i < curve.pieces.size(); ++i) {
    expect_near(end_point(curve.pieces[i - 1]), start_point(curve.pieces[i]));
    const Vec2 a = evaluate(curve.pieces[i - 1], 1.0).d1, b = evaluate(curve.pieces[i], 0.0).d1;
    EXPECT_TRUE(!smooth || std::abs(turning(a, b)) < 1e-9);
  }
}

/// Largest difference of the distance of points of the curve from a centre and a radius.
double off_circle(const DrawnCurve& curve, Vec2 centre, double radius) {
  double most = 0.0;
  for (const Piece& piece : curve.pieces) {
    for (int k = 0; k <= 16; ++k) {
      most = std::max(most, std::abs(norm(evaluate(piece, k / 16.0).point - centre) - radius));
    }
  }
  return most;
}

double length_of(const DrawnCurve& curve) {
  double sum = 0.0;
  for (const Piece& piece : curve.pieces) sum += arc_length(piece, 1e-12);
  return sum;
}

Tags joined(Tags tags, const Tags& more) { return std::move(tags) + more; }

const Tags kMirrored = {{210, "0"}, {220, "0"}, {230, "-1"}};

TEST(DxfReads, ALineWithItsHandleLayerAndUnit) {
  const Drawing d = read_dxf_text(dxf(
      {{0, "LINE"}, {5, "2F"}, {8, "OUTLINE"}, {10, "1.5"}, {20, "-2"}, {11, "+3e1"}, {21, "4."}}));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_EQ(d.units, "mm");
  EXPECT_EQ(d.curves[0].label, "LINE 2F on layer OUTLINE");
  expect_near(start_point(d.curves[0].pieces[0]), {1.5, -2.0});
  expect_near(end_point(d.curves[0].pieces[0]), {30.0, 4.0});
  EXPECT_TRUE(d.warnings.empty()) << d.warnings[0];
}

TEST(DxfReads, ArcsCounterClockwiseFromAngleToAngle) {
  const Drawing d = read_dxf_text(dxf(arc("1", "2", "5", "350", "30")));
  ASSERT_EQ(d.curves.size(), 1u);
  expect_near(start_point(d.curves[0].pieces.front()),
              {1.0 + 5.0 * std::cos(-kPi / 18.0), 2.0 - 5.0 * std::sin(kPi / 18.0)});
  expect_near(end_point(d.curves[0].pieces.back()), {1.0 + 5.0 * std::sqrt(0.75), 4.5});
  EXPECT_NEAR(length_of(d.curves[0]), 5.0 * 40.0 * kPi / 180.0, 1e-12);
  EXPECT_LT(off_circle(d.curves[0], {1, 2}, 5), 1e-14 * 10);
  EXPECT_FALSE(d.curves[0].closed);
}

TEST(DxfReads, ArcsOfAPlaneSeenFromBelowMirrored) {
  const Drawing d = read_dxf_text(dxf(joined(arc("1", "2", "5", "0", "90"), kMirrored)));
  ASSERT_EQ(d.curves.size(), 1u);
  expect_near(start_point(d.curves[0].pieces.front()), {-6.0, 2.0});
  expect_near(end_point(d.curves[0].pieces.back()), {-1.0, 7.0});
  EXPECT_NEAR(curvature(evaluate(d.curves[0].pieces[0], 0.5)), -0.2, 1e-14);
  EXPECT_LT(off_circle(d.curves[0], {-1, 2}, 5), 1e-13);
}

TEST(DxfReads, CirclesAndEllipsesAsClosedCurves) {
  const Drawing d = read_dxf_text(
      dxf(Tags{{0, "CIRCLE"}, {10, "3"}, {20, "4"}, {40, "2"}} +
          Tags{{0, "ELLIPSE"}, {10, "1"}, {20, "1"}, {11, "0"}, {21, "4"}, {40, "0.5"}}));
  ASSERT_EQ(d.curves.size(), 2u);
  EXPECT_TRUE(d.curves[0].closed && d.curves[1].closed);
  EXPECT_LT(off_circle(d.curves[0], {3, 4}, 2), 1e-14);
  EXPECT_NEAR(length_of(d.curves[0]), 4.0 * kPi, 1e-12);
  EXPECT_EQ(start_point(d.curves[1].pieces.front()), end_point(d.curves[1].pieces.back()));
  expect_connected(d.curves[1], true);
  expect_near(start_point(d.curves[1].pieces.front()), {1, 5});
  for (const Piece& piece : d.curves[1].pieces) {
    for (const double t : {0.1, 0.6}) {
      const Vec2 p = evaluate(piece, t).point - Vec2{1, 1};
      EXPECT_NEAR(p.x * p.x / 4.0 + p.y * p.y / 16.0, 1.0, 1e-14);
    }
  }
}

TEST(DxfReads, EllipseArcsByTheirParameter) {
  const Drawing d = read_dxf_text(dxf({{0, "ELLIPSE"},
                                       {10, "0"},
                                       {20, "0"},
                                       {11, "2"},
                                       {21, "0"},
                                       {40, "0.5"},
                                       {41, "0.5"},
                                       {42, "2.5"}}));
  ASSERT_EQ(d.curves.size(), 1u);
  expect_near(start_point(d.curves[0].pieces.front()), {2 * std::cos(0.5), std::sin(0.5)});
  expect_near(end_point(d.curves[0].pieces.back()), {2 * std::cos(2.5), std::sin(2.5)});
  expect_connected(d.curves[0], true);
}

TEST(DxfReads, BulgesAsArcs) {
  // half a circle to the right of the chord, a line back, and three quarters of a circle
  const Drawing d = read_dxf_text(dxf({{0, "LWPOLYLINE"},
                                       {90, "4"},
                                       {70, "0"},
                                       {10, "0"},
                                       {20, "0"},
                                       {42, "1"},
                                       {10, "2"},
                                       {20, "0"},
                                       {10, "2"},
                                       {20, "1"},
                                       {42, "-2.414213562373095"},
                                       {10, "3"},
                                       {20, "1"}}));
  ASSERT_EQ(d.curves.size(), 1u);
  const auto& pieces = d.curves[0].pieces;
  EXPECT_NEAR(length_of(d.curves[0]), kPi + 1.0 + 1.5 * kPi * std::sqrt(0.5), 1e-12);
  expect_connected(d.curves[0], false);
  expect_near(start_point(pieces[1]), {1.0, -1.0});  // half circles come in two arcs
  EXPECT_NEAR(curvature(evaluate(pieces[0], 0.3)), 1.0, 1e-14);
  EXPECT_NEAR(curvature(evaluate(pieces.back(), 0.3)), -std::sqrt(2.0), 1e-13);
  expect_near(evaluate(pieces.back(), 0.0).point, {2.5, 1.5 + std::sqrt(0.5)}, 1e-12);
}

TEST(DxfReads, OldPolylinesWithTheirVertices) {
  const auto vertex = [](const char* x, const char* y, const char* bulge, const char* flags) {
    return Tags{{0, "VERTEX"}, {8, "0"}, {10, x}, {20, y}, {42, bulge}, {70, flags}};
  };
  const Drawing d = read_dxf_text(dxf(Tags{{0, "POLYLINE"}, {8, "0"}, {66, "1"}, {70, "1"}} +
                                      vertex("0", "0", "1", "0") + vertex("7", "9", "0", "16") +
                                      vertex("2", "0", "1", "0") + Tags{{0, "SEQEND"}, {8, "0"}}));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_TRUE(d.curves[0].closed);
  EXPECT_LT(off_circle(d.curves[0], {1, 0}, 1), 1e-14);
  EXPECT_NEAR(length_of(d.curves[0]), 2.0 * kPi, 1e-12);
}

TEST(DxfReads, PolylinesThatTurnLikePolygonsAsLines) {
  const Drawing d = read_dxf_text(dxf({{0, "LWPOLYLINE"},
                                       {8, "A"},
                                       {90, "3"},
                                       {70, "1"},
                                       {10, "0"},
                                       {20, "0"},
                                       {10, "2"},
                                       {20, "0"},
                                       {10, "2"},
                                       {20, "1"}}));
  EXPECT_TRUE(d.series.empty());
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_TRUE(d.curves[0].closed);
  const std::vector<Vec2> corners = {{0, 0}, {2, 0}, {2, 1}, {0, 0}};
  ASSERT_EQ(d.curves[0].pieces.size(), 3u);
  for (std::size_t i = 0; i < 3; ++i) {
    const auto& side = std::get<LinePiece>(d.curves[0].pieces[i]);
    EXPECT_EQ(side.start, corners[i]);
    EXPECT_EQ(side.end, corners[i + 1]);
  }
}

TEST(DxfReads, PolylinesOfManyChordsOfACurveAsPoints) {
  Tags tags = {{0, "LWPOLYLINE"}, {8, "A"}, {90, "60"}, {70, "1"}};
  std::vector<Vec2> points;
  for (int k = 0; k < 60; ++k) {
    const double angle = 2.0 * kPi * k / 60.0;
    char x[32], y[32];
    std::snprintf(x, sizeof x, "%.17g", 2.0 * std::cos(angle));
    std::snprintf(y, sizeof y, "%.17g", std::sin(angle));
    tags.push_back({10, x});
    tags.push_back({20, y});
    points.push_back({std::atof(x), std::atof(y)});
  }
  points.push_back(points.front());
  const Drawing d = read_dxf_text(dxf(tags));
  EXPECT_TRUE(d.curves.empty());
  ASSERT_EQ(d.series.size(), 1u);
  EXPECT_EQ(d.series[0].points, points);
  EXPECT_EQ(d.series[0].units, d.units);
}

TEST(DxfReads, AllPointsAsOneSeries) {
  const auto point = [](const char* x, const char* y) {
    return Tags{{0, "POINT"}, {8, "0"}, {10, x}, {20, y}};
  };
  const Drawing d =
      read_dxf_text(dxf(point("1", "2") + line("0", "0", "5", "0") + point("3", "4")));
  ASSERT_EQ(d.series.size(), 1u);
  EXPECT_EQ(d.series[0].points, (std::vector<Vec2>{{1, 2}, {3, 4}}));
}

TEST(DxfReads, RationalSplinesExactly) {
  // a quarter of the unit circle, and the same curve with knots that are not clamped
  const Drawing d = read_dxf_text(dxf({{0, "SPLINE"}, {70, "12"},
                                       {71, "2"},     {72, "6"},
                                       {73, "3"},     {74, "0"},
                                       {40, "0"},     {40, "0"},
                                       {40, "0"},     {40, "3"},
                                       {40, "3"},     {40, "3"},
                                       {41, "1"},     {41, "0.70710678118654757"},
                                       {41, "1"},     {10, "1"},
                                       {20, "0"},     {30, "0"},
                                       {10, "1"},     {20, "1"},
                                       {30, "0"},     {10, "0"},
                                       {20, "1"},     {30, "0"}}));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_LT(off_circle(d.curves[0], {0, 0}, 1), 1e-14);
  EXPECT_NEAR(length_of(d.curves[0]), 0.5 * kPi, 1e-11);
}

TEST(DxfReads, UniformSplinesOverTheirDomainOnly) {
  // uniform quadratic: runs from the middle of the first leg to the middle of the last one
  const Drawing d = read_dxf_text(
      dxf({{0, "SPLINE"}, {70, "8"}, {71, "2"}, {72, "7"}, {73, "4"}, {40, "0"}, {40, "1"},
           {40, "2"},     {40, "3"}, {40, "4"}, {40, "5"}, {40, "6"}, {10, "0"}, {20, "0"},
           {10, "2"},     {20, "0"}, {10, "2"}, {20, "2"}, {10, "4"}, {20, "2"}}));
  ASSERT_EQ(d.curves.size(), 1u);
  expect_near(start_point(d.curves[0].pieces.front()), {1, 0});
  expect_near(end_point(d.curves[0].pieces.back()), {3, 2});
  expect_connected(d.curves[0], true);
}

TEST(DxfReads, SplinesOfFitPointsAloneAsPoints) {
  const Drawing d = read_dxf_text(dxf({{0, "SPLINE"},
                                       {70, "8"},
                                       {71, "3"},
                                       {72, "0"},
                                       {73, "0"},
                                       {74, "3"},
                                       {11, "0"},
                                       {21, "0"},
                                       {11, "1"},
                                       {21, "1"},
                                       {11, "2"},
                                       {21, "0"}}));
  ASSERT_EQ(d.series.size(), 1u);
  EXPECT_EQ(d.series[0].points, (std::vector<Vec2>{{0, 0}, {1, 1}, {2, 0}}));
}

TEST(DxfReads, UnitsAndConvertsThoseWithoutName) {
  const auto read_unit = [](const char* code) {
    return read_dxf_text(
        test::ascii(test::file_of(line("0", "0", "10", "0"), {}, {{9, "$INSUNITS"}, {70, code}})));
  };
  EXPECT_EQ(read_unit("1").units, "in");
  EXPECT_EQ(read_unit("6").units, "m");
  const Drawing yards = read_unit("10");
  EXPECT_EQ(yards.units, "yd");
  expect_near(end_point(yards.curves[0].pieces[0]), {10, 0});
  EXPECT_TRUE(yards.warnings.empty());
  const Drawing angstroms = read_unit("11");  // of 0.1 nm
  EXPECT_EQ(angstroms.units, "nm");
  expect_near(end_point(angstroms.curves[0].pieces[0]), {1, 0});
  EXPECT_THAT(angstroms.warnings, Contains(HasSubstr("converted")));
  const Drawing none = read_unit("0");
  EXPECT_EQ(none.units, Units("mm", UnitSource::kAssumed));
  EXPECT_THAT(none.warnings, Contains(HasSubstr("the file states no known unit")));
}

// ---- blocks -----------------------------------------------------------------------------------

Tags block(const char* name, const char* x, const char* y, const Tags& entities) {
  return Tags{{0, "BLOCK"}, {8, "0"}, {2, name}, {10, x}, {20, y}} + entities +
         Tags{{0, "ENDBLK"}, {8, "0"}};
}

TEST(DxfReads, InsertsScaledTurnedAndMoved) {
  const Drawing d = read_dxf_text(dxf({{0, "INSERT"},
                                       {8, "PARTS"},
                                       {2, "B"},
                                       {10, "10"},
                                       {20, "20"},
                                       {41, "2"},
                                       {42, "2"},
                                       {50, "90"}},
                                      block("B", "1", "1", line("1", "1", "4", "2"))));
  ASSERT_EQ(d.curves.size(), 1u);
  // (0, 0) and (3, 1), twice as large, turned by 90 degrees
  expect_near(start_point(d.curves[0].pieces[0]), {10, 20});
  expect_near(end_point(d.curves[0].pieces[0]), {8, 26});
  EXPECT_EQ(d.curves[0].label, "LINE at line 25 on layer PARTS in block B");
}

TEST(DxfReads, InsertsInsideBlocksAndArrays) {
  const Tags blocks =
      block("INNER", "0", "0", line("0", "0", "1", "0")) +
      block("OUTER", "0", "0", Tags{{0, "INSERT"}, {2, "INNER"}, {10, "0"}, {20, "1"}, {50, "90"}});
  const Drawing d = read_dxf_text(dxf({{0, "INSERT"},
                                       {2, "OUTER"},
                                       {10, "0"},
                                       {20, "0"},
                                       {70, "2"},
                                       {71, "3"},
                                       {44, "10"},
                                       {45, "100"}},
                                      blocks));
  ASSERT_EQ(d.curves.size(), 6u);
  expect_near(start_point(d.curves[5].pieces[0]), {10, 201});
  expect_near(end_point(d.curves[5].pieces[0]), {10, 202});
}

TEST(DxfReads, CirclesOfUnevenScaleAsEllipses) {
  const Drawing d =
      read_dxf_text(dxf({{0, "INSERT"}, {2, "B"}, {10, "5"}, {20, "0"}, {41, "-3"}, {42, "1"}},
                        block("B", "0", "0", arc("0", "0", "1", "0", "90"))));
  ASSERT_EQ(d.curves.size(), 1u);
  expect_near(start_point(d.curves[0].pieces.front()), {2, 0});
  expect_near(end_point(d.curves[0].pieces.back()), {5, 1});
  const Vec2 p = evaluate(d.curves[0].pieces[0], 0.4).point - Vec2{5, 0};
  EXPECT_NEAR(p.x * p.x / 9.0 + p.y * p.y, 1.0, 1e-14);
  EXPECT_LT(p.x, 0.0);
}

TEST(DxfReads, BulgesOfUnevenScaleAsEllipses) {
  const Drawing d =
      read_dxf_text(dxf({{0, "INSERT"}, {2, "B"}, {10, "0"}, {20, "0"}, {41, "1"}, {42, "2"}},
                        block("B", "0", "0",
                              {{0, "LWPOLYLINE"},
                               {90, "2"},
                               {70, "0"},
                               {10, "-1"},
                               {20, "0"},
                               {42, "-1"},
                               {10, "1"},
                               {20, "0"}})));
  ASSERT_EQ(d.curves.size(), 1u);
  expect_near(start_point(d.curves[0].pieces.front()), {-1, 0});
  expect_near(end_point(d.curves[0].pieces.back()), {1, 0});
  for (const Piece& piece : d.curves[0].pieces) {
    const Vec2 p = evaluate(piece, 0.3).point;
    EXPECT_NEAR(p.x * p.x + p.y * p.y / 4.0, 1.0, 1e-14);
    EXPECT_GT(p.y, 0.0);
  }
}

TEST(DxfReads, MirroredBlocksWithTheArcsTheOtherWay) {
  const Drawing d =
      read_dxf_text(dxf({{0, "INSERT"}, {2, "B"}, {10, "0"}, {20, "0"}, {41, "-1"}, {42, "1"}},
                        block("B", "0", "0",
                              {{0, "LWPOLYLINE"},
                               {90, "2"},
                               {70, "0"},
                               {10, "1"},
                               {20, "0"},
                               {42, "0.41421356237309503"},
                               {10, "0"},
                               {20, "1"}})));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_LT(off_circle(d.curves[0], {0, 0}, 1), 1e-14);
  EXPECT_NEAR(curvature(evaluate(d.curves[0].pieces[0], 0.5)), -1.0, 1e-13);
}

// ---- chains -----------------------------------------------------------------------------------

TEST(DxfReads, EntitiesThatMeetAsOneCurveInTheDirectionOfTheFirst) {
  // a slot, its lines and arcs in no order and of no direction
  const Drawing d = read_dxf_text(dxf(line("0", "0", "4", "0") + arc("0", "1", "1", "90", "270") +
                                      line("0", "2", "4", "2") + arc("4", "1", "1", "270", "90")));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_TRUE(d.curves[0].closed);
  expect_near(start_point(d.curves[0].pieces[0]), {0, 0});
  expect_connected(d.curves[0], true);
  EXPECT_NEAR(length_of(d.curves[0]), 8.0 + 2.0 * kPi, 1e-12);
  EXPECT_EQ(d.curves[0].label, "2 ARC and 2 LINE, from LINE at line 15 on layer 0");
}

TEST(DxfReads, OpenChainsFromTheirBeginning) {
  const Drawing d = read_dxf_text(
      dxf(line("1", "0", "2", "0") + line("1", "0", "0", "0.5") + line("3", "1", "2", "0")));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_FALSE(d.curves[0].closed);
  expect_near(start_point(d.curves[0].pieces.front()), {0, 0.5});
  expect_near(end_point(d.curves[0].pieces.back()), {3, 1});
  expect_connected(d.curves[0], false);
}

TEST(DxfReads, AContourThatPassesItselfWithinTheTolerance) {
  // the waist is 2e-7 wide, the size 1.4
  const Drawing d =
      read_dxf_text(dxf(line("0", "0", "1", "0") + line("1", "0", "0.5", "0.5") +
                        line("0.5", "0.5", "1", "1") + line("1", "1", "0", "1") +
                        line("0", "1", "0.4999998", "0.5") + line("0.4999998", "0.5", "0", "0")));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_TRUE(d.curves[0].closed);
  EXPECT_EQ(d.curves[0].pieces.size(), 6u);
}

TEST(DxfReads, EntitiesShorterThanTheToleranceWhereTheyMeetOthers) {
  const Drawing d = read_dxf_text(
      dxf(line("0", "0", "1", "0") + line("1", "0", "1", "1e-7") + line("1", "1e-7", "0", "1")));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_EQ(d.curves[0].pieces.size(), 3u);
}

TEST(DxfReads, CrossingsOfLinesThatEndThereAsBranches) {
  const Drawing d = read_dxf_text(dxf(line("0", "0", "1", "1") + line("2", "2", "1", "1") +
                                      line("0", "2", "1", "1") + line("2", "0", "1", "1")));
  EXPECT_EQ(d.curves.size(), 4u);
}

TEST(DxfReads, ChainsUpToABranch) {
  const Drawing d = read_dxf_text(dxf(line("0", "0", "1", "0") + line("1", "0", "2", "1") +
                                      line("1", "0", "2", "-1") + line("2", "-1", "3", "-1")));
  EXPECT_EQ(d.curves.size(), 3u);
}

TEST(DxfReads, LayersApart) {
  EXPECT_EQ(read_dxf_text(dxf(line("0", "0", "1", "0", "A") + line("1", "0", "2", "1", "B")))
                .curves.size(),
            2u);
}

TEST(DxfReads, EndsWithinAMillionthOfTheSizeAsOne) {
  EXPECT_EQ(
      read_dxf_text(dxf(line("0", "0", "1", "0") + line("1.0000005", "0", "2", "1"))).curves.size(),
      1u);
  EXPECT_EQ(
      read_dxf_text(dxf(line("0", "0", "1", "0") + line("1.00001", "0", "2", "1"))).curves.size(),
      2u);
}

TEST(DxfReads, WhatWasDrawnTwiceOnce) {
  const Drawing d = read_dxf_text(
      dxf(line("0", "0", "1", "0") + line("1", "0", "0", "0") + line("1", "0", "2", "1")));
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_EQ(d.curves[0].pieces.size(), 2u);
  EXPECT_THAT(d.warnings, Contains(HasSubstr("1 entity lies on others")));
  // two halves of a circle share their ends and are no such case
  EXPECT_TRUE(read_dxf_text(dxf(arc("0", "0", "1", "0", "180") + arc("0", "0", "1", "180", "0")))
                  .curves[0]
                  .closed);
}

// ---- what is left out -------------------------------------------------------------------------

TEST(DxfLeavesOut, WhatCannotBeDrawnAndSaysSo) {
  const auto warned = [](const Tags& entity, const char* words) {
    const Drawing d = read_dxf_text(dxf(line("0", "0", "1", "0") + entity));
    EXPECT_EQ(d.curves.size(), 1u) << words;
    EXPECT_THAT(d.warnings, Contains(HasSubstr(words)));
  };
  warned({{0, "CIRCLE"}, {5, "AB"}, {10, "0"}, {20, "0"}, {40, "-1"}},
         "CIRCLE AB on layer 0 (line 27) was left out: its radius is not positive (-1)");
  warned({{0, "CIRCLE"}, {10, "nan"}, {20, "0"}, {40, "1"}},
         "a number of it cannot be read (group 10 is \"nan\")");
  warned({{0, "CIRCLE"}, {10, "inf"}, {20, "0"}, {40, "1"}}, "a number of it cannot be read");
  warned({{0, "CIRCLE"}, {10, "1e200"}, {20, "0"}, {40, "1"}}, "its size is out of range");
  warned({{0, "LINE"}, {10, "1"}, {20, "2"}, {30, "0"}, {11, "1"}, {21, "2"}, {31, "5"}},
         "it is a single point, seen from above");
  warned(joined(arc("0", "0", "1", "0", "90"), {{210, "1"}, {220, "0"}, {230, "0"}}),
         "tilted against xy");
  warned({{0, "ELLIPSE"}, {10, "0"}, {20, "0"}, {11, "1"}, {21, "0"}, {40, "0"}},
         "ratio of its axes");
  warned({{0, "LWPOLYLINE"}, {90, "3"}, {10, "0"}, {20, "0"}, {10, "1"}, {20, "1"}},
         "3 points stated, 2 found");
  warned({{0, "INSERT"}, {2, "NONE"}, {10, "0"}, {20, "0"}}, "there is no such block (NONE)");
  warned({{0, "TEXT"}, {10, "0"}, {20, "0"}, {1, "hello"}},
         "not drawn, being neither curves nor points: 1 TEXT: text is a curve where it is "
         "converted to paths");
  warned({{0, "LINE"}, {67, "1"}, {10, "0"}, {20, "0"}, {11, "9"}, {21, "9"}},
         "1 entity was of the paper space");
  warned({{0, "POLYLINE"}, {70, "64"}, {0, "VERTEX"}, {10, "0"}, {20, "0"}, {0, "SEQEND"}},
         "it is a mesh");
}

Tags spline(int degree, const std::vector<const char*>& knots, int points,
            const char* weight = nullptr) {
  Tags tags = {{0, "SPLINE"}, {71, std::to_string(degree)}};
  for (const char* knot : knots) tags.emplace_back(40, knot);
  for (int i = 0; i < points; ++i) {
    tags.emplace_back(10, std::to_string(i));
    tags.emplace_back(20, std::to_string(i * i));
    if (weight != nullptr) tags.emplace_back(41, weight);
  }
  return tags;
}

TEST(DxfLeavesOut, SplinesThatAreNone) {
  const auto why = [](const Tags& entity) { return refused(dxf(entity)).hint; };
  const std::vector<const char*> good = {"0", "0", "0", "1", "1", "1"};
  EXPECT_EQ(read_dxf_text(dxf(spline(2, good, 3))).curves.size(), 1u);
  EXPECT_THAT(why(spline(2, good, 4)), HasSubstr("degree 2, 4 points, 6 knots"));
  EXPECT_THAT(why(spline(0, good, 3)), HasSubstr("its degree is not from 1 to 7 (0)"));
  EXPECT_THAT(why(spline(2, {"0", "0", "1", "0", "1", "1"}, 3)), HasSubstr("do not ascend"));
  EXPECT_THAT(why(spline(2, good, 3, "0")), HasSubstr("weights is not positive"));
  EXPECT_THAT(why(spline(2, good, 3, "-1")), HasSubstr("weights is not positive"));
  EXPECT_THAT(why(spline(1, {"0", "0", "1", "1", "2", "2"}, 4)), HasSubstr("it has a gap"));
  EXPECT_THAT(why(spline(9, {"0", "0"}, 1)), HasSubstr("its degree is not from 1 to 7 (9)"));
}

TEST(DxfLeavesOut, HeightsWithAWarning) {
  const Drawing d = read_dxf_text(
      dxf({{0, "LINE"}, {10, "0"}, {20, "0"}, {30, "0"}, {11, "4"}, {21, "0"}, {31, "3"}}));
  EXPECT_NEAR(length_of(d.curves[0]), 4.0, 0.0);
  EXPECT_THAT(d.warnings,
              Contains(HasSubstr("height z is not constant, and dropped (from 0 to 3)")));
}

TEST(DxfLeavesOut, BytesOfOtherCodePagesFromLabels) {
  const Drawing d = read_dxf_text(dxf(line("0", "0", "1", "0",
                                           "Au\xDF"
                                           "en \\U+00E4 \x01")));
  EXPECT_EQ(d.curves[0].label, "LINE at line 15 on layer Au\u00DFen \u00E4 ?");
}

// ---- files ------------------------------------------------------------------------------------

TEST(DxfFiles, BinaryOnesAreTheSameAsAscii) {
  const Tags tags = test::file_of(arc("1", "2", "5", "350", "30") + Tags{{0, "LWPOLYLINE"},
                                                                         {5, "7F"},
                                                                         {90, "2"},
                                                                         {70, "0"},
                                                                         {10, "0"},
                                                                         {20, "0"},
                                                                         {42, "1"},
                                                                         {10, "2"},
                                                                         {20, "0"},
                                                                         {210, "0"},
                                                                         {220, "0"},
                                                                         {230, "-1"},
                                                                         {1001, "OBVID"},
                                                                         {1000, "a note"}},
                                  {}, {{9, "$INSUNITS"}, {70, "1"}});
  const Drawing ascii = read_dxf_text(test::ascii(tags));
  for (const bool wide : {false, true}) {
    const Drawing binary = read_dxf_text(test::binary(tags, wide));
    EXPECT_EQ(binary.units, "in");
    ASSERT_EQ(binary.curves.size(), ascii.curves.size());
    for (std::size_t i = 0; i < ascii.curves.size(); ++i) {
      ASSERT_EQ(binary.curves[i].pieces.size(), ascii.curves[i].pieces.size());
      for (std::size_t k = 0; k < ascii.curves[i].pieces.size(); ++k) {
        EXPECT_EQ(evaluate(binary.curves[i].pieces[k], 0.3).point,
                  evaluate(ascii.curves[i].pieces[k], 0.3).point);
      }
    }
  }
}

TEST(DxfFiles, LineEndsOfAllSystemsAndComments) {
  std::string text = "999\nwritten by hand\n" + dxf(line("0", "0", "1", "0"));
  for (const char* end : {"\r\n", "\r"}) {
    std::string other;
    for (const char c : text) other += c == '\n' ? std::string(end) : std::string(1, c);
    EXPECT_EQ(read_dxf_text(other).curves.size(), 1u);
  }
  EXPECT_EQ(read_dxf_text("\xEF\xBB\xBF" + text).curves.size(), 1u);
}

TEST(DxfFiles, OthersAreRefusedWithAReason) {
  EXPECT_EQ(refused("").code, ErrorCode::kDamaged);
  EXPECT_EQ(refused("0 0\n1 1\n").code, ErrorCode::kDamaged);
  EXPECT_EQ(refused(std::string("AutoCAD Binary DXF\r\n\x1a\0", 22)).code, ErrorCode::kDamaged);
  EXPECT_EQ(refused(dxf({})).code, ErrorCode::kNothingThere);
  const Error code = refused("0\nSECTION\n2\nENTITIES\n0\nLINE\nzehn\n1\n");
  EXPECT_EQ(code.code, ErrorCode::kBadNumber);
  EXPECT_EQ(code.where, "test.dxf:7");
  const Error far = refused("0\nSECTION\n2\nENTITIES\n99999\n1\n");
  EXPECT_EQ(far.where, "test.dxf:5");
}

TEST(DxfFiles, CutOnesGiveWhatIsThereWithAWarningOrAnError) {
  const std::string whole = dxf(arc("1", "2", "5", "350", "30") + line("0", "0", "1", "0") +
                                Tags{{0, "TEXT"}, {1, "end"}});
  std::size_t read_some = 0;
  for (std::size_t n = 0; n + 5 < whole.size(); ++n) {  // without the last line
    const auto drawing = parse_dxf(std::string_view(whole).substr(0, n), "cut.dxf");
    if (!drawing) {
      EXPECT_FALSE(drawing.error().what.empty());
      continue;
    }
    ++read_some;
    EXPECT_THAT(drawing->warnings, Contains(HasSubstr("may be cut off"))) << n;
  }
  EXPECT_GT(read_some, 20u);
}

TEST(DxfFiles, BlocksThatContainThemselvesEnd) {
  const Tags again = {{0, "INSERT"}, {2, "B"}, {10, "1"}, {20, "0"}};
  const Drawing d =
      read_dxf_text(dxf(again, block("B", "0", "0", line("0", "0", "0.1", "0") + again)));
  EXPECT_GT(d.curves.size(), 10u);
  EXPECT_THAT(d.warnings, Contains(HasSubstr("blocks contain each other")));
}

TEST(DxfFiles, SmallOnesThatAskForBillionsEnd) {
  Tags blocks = block("B0", "0", "0", line("0", "0", "1", "0"));
  for (int i = 1; i < 12; ++i) {
    const std::string name = "B" + std::to_string(i), inner = "B" + std::to_string(i - 1);
    blocks = blocks + block(name.c_str(), "0", "0",
                            {{0, "INSERT"},
                             {2, inner},
                             {10, "0"},
                             {20, "0"},
                             {70, "1000"},
                             {71, "1000"},
                             {44, "10"},
                             {45, "10"}});
  }
  const Drawing d = read_dxf_text(dxf({{0, "INSERT"}, {2, "B11"}, {10, "0"}, {20, "0"}}, blocks));
  EXPECT_THAT(d.warnings, Contains(HasSubstr("more than 500,000 entities")));
  // nothing at the bottom of it
  const Tags empty =
      block("B0", "0", "0", {}) +
      Tags(blocks.begin() +
               static_cast<std::ptrdiff_t>(block("B0", "0", "0", line("0", "0", "1", "0")).size()),
           blocks.end());
  EXPECT_EQ(refused(dxf({{0, "INSERT"}, {2, "B11"}, {10, "0"}, {20, "0"}}, empty)).code,
            ErrorCode::kNothingThere);
}

TEST(DxfFiles, AMillionVerticesAreReadInOneGo) {
  constexpr int kCount = 1'000'000;
  Tags head = {{0, "LWPOLYLINE"}, {90, std::to_string(kCount)}, {70, "0"}};
  std::string text = test::ascii({{0, "SECTION"}, {2, "ENTITIES"}}) + test::ascii(head);
  for (int i = 0; i < kCount; ++i) {
    text += "10\n" + std::to_string(i) + "\n20\n" + std::to_string(i % 7) + "\n";
  }
  const Drawing d = read_dxf_text(text + test::ascii({{0, "ENDSEC"}, {0, "EOF"}}));
  // its vertices lie on seven lines: no chords of a curve
  ASSERT_EQ(d.curves.size(), 1u);
  EXPECT_EQ(d.curves[0].pieces.size(), static_cast<std::size_t>(kCount) - 1);
}

TEST(DxfFiles, CrowdedEndsTakeNoLonger) {
  Tags tags;
  for (int i = 0; i < 100'000; ++i) tags = std::move(tags) + line("0", "0", "1", "1");
  tags = std::move(tags) + line("5", "5", "6", "6");
  const Drawing d = read_dxf_text(dxf(tags));
  EXPECT_EQ(d.curves.size(), 2u);
}

}  // namespace
}  // namespace obvid
