// SPDX-License-Identifier: Apache-2.0
// Samples of curves of known length, and the texts made of them.
#include "obvid/exchange/internal/points/samples.h"
#include "../common/angles.h"

#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "obvid/exchange/internal/points/solidworks.h"

namespace obvid {
namespace {

/// A line of length 2, a quarter of a circle of radius 1, a line of length 3.
Contour hook() {
  Contour c;
  c.units = "mm";
  c.pieces = {LinePiece{{0, 0}, {2, 0}}, ArcPiece{{2, 0}, {3, 1}, 0.0, 1.0, 0.5 * kPi},
              LinePiece{{3, 1}, {3, 4}}};
  c.runs = {{0, 2, 0}};
  return c;
}

constexpr double kLength = 5.0 + 0.5 * kPi;

/// A parabola y = x^2/2 from 0 to 2: length by the closed form.
RationalBezier parabola() {
  RationalBezier p;
  p.degree = 2;
  p.offset = {Vec2{0, 0}, Vec2{1, 0}, Vec2{2, 2}};
  p.weight = {1, 1, 1};
  return p;
}

TEST(Samples, ByCountStandAtEqualArcLengths) {
  const Contour c = hook();
  SampleOptions options;
  options.count = 21;
  const auto samples = sample(c.pieces, options);
  ASSERT_TRUE(samples);
  ASSERT_EQ(samples->size(), 21U);
  for (std::size_t i = 0; i < 21; ++i) {
    EXPECT_NEAR((*samples)[i].s, kLength * static_cast<double>(i) / 20.0, 1e-12);
  }
  EXPECT_EQ(samples->front().point, (Vec2{0, 0}));
  EXPECT_NEAR(norm(samples->back().point - Vec2{3, 4}), 0.0, 1e-14);
  EXPECT_NEAR(samples->back().theta, 0.5 * kPi, 1e-14);
}

TEST(Samples, OnAParabolaFollowItsArcLength) {
  const std::vector<Piece> pieces = {parabola()};
  SampleOptions options;
  options.step = 0.1;
  const auto samples = sample(pieces, options);
  ASSERT_TRUE(samples);
  for (const CurveSample& one : *samples) {
    const double x = one.point.x;
    const double length = 0.5 * (x * std::sqrt(1.0 + x * x) + std::asinh(x));
    EXPECT_NEAR(one.s, length, 1e-12);
    EXPECT_NEAR(one.point.y, 0.5 * x * x, 1e-14);
    EXPECT_NEAR(one.theta, std::atan(x), 1e-13);
    EXPECT_NEAR(one.kappa, std::pow(1.0 + x * x, -1.5), 1e-12);
  }
}

TEST(Samples, ByStepEndAtTheEnd) {
  SampleOptions options;
  options.step = 1.0;
  const auto samples = sample(hook().pieces, options);
  ASSERT_TRUE(samples);
  EXPECT_EQ(samples->size(), 8U);  // 0 .. 6 and the end at 6.57
  EXPECT_NEAR(samples->back().s, kLength, 1e-12);
}

TEST(Samples, ByChordToleranceStayNearAndKeepTheJoints) {
  for (const double tolerance : {0.1, 0.001}) {
    SampleOptions options;
    options.chord_tolerance = tolerance;
    const auto samples = sample(hook().pieces, options);
    ASSERT_TRUE(samples);
    bool joint = false;
    for (std::size_t i = 1; i < samples->size(); ++i) {
      const Vec2 middle = 0.5 * ((*samples)[i - 1].point + (*samples)[i].point);
      if (middle.x > 2.0 && middle.y < 1.0) {
        EXPECT_LE(1.0 - norm(middle - Vec2{2, 1}), tolerance);
      }
      joint = joint || norm((*samples)[i].point - Vec2{2, 0}) < 1e-15;
    }
    EXPECT_TRUE(joint);
  }
}

TEST(Samples, ACornerStandsTwiceWithBothHeadings) {
  const std::vector<Piece> pieces = {LinePiece{{0, 0}, {1, 0}}, LinePiece{{1, 0}, {1, 1}}};
  const auto samples = sample(pieces, {});
  ASSERT_TRUE(samples);
  ASSERT_EQ(samples->size(), 4U);
  EXPECT_EQ((*samples)[1].point, (*samples)[2].point);
  EXPECT_NEAR((*samples)[2].theta - (*samples)[1].theta, 0.5 * kPi, 1e-15);
}

TEST(Samples, RefuseWhatIsNoNumberOfSamples) {
  const Contour c = hook();
  SampleOptions options;
  options.count = 1;
  EXPECT_EQ(sample(c.pieces, options).error().code, ErrorCode::kBadOption);
  options = {};
  options.step = 0.0;
  EXPECT_EQ(sample(c.pieces, options).error().code, ErrorCode::kBadOption);
  options.step = 1e-9;
  EXPECT_EQ(sample(c.pieces, options).error().code, ErrorCode::kBadOption);
  options = {};
  options.chord_tolerance = std::nan("");
  EXPECT_EQ(sample(c.pieces, options).error().code, ErrorCode::kBadOption);
  EXPECT_EQ(sample({}, {}).error().code, ErrorCode::kTooFewPoints);
}

TEST(Samples, CsvReadsBackToTheSameDoubles) {
  SampleOptions options;
  options.count = 7;
  const Contour c = hook();
  const auto text = samples_csv(c, options);
  const auto samples = sample(c.pieces, options);
  ASSERT_TRUE(text && samples);
  std::istringstream in(*text);
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "s_mm,x_mm,y_mm,heading_deg,curvature_1_per_mm,normal_x,normal_y");
  for (const CurveSample& one : *samples) {
    ASSERT_TRUE(std::getline(in, line));
    double s = 0, x = 0, y = 0, heading = 0, kappa = 0, nx = 0, ny = 0;
    ASSERT_EQ(std::sscanf(line.c_str(), "%lf,%lf,%lf,%lf,%lf,%lf,%lf", &s, &x, &y, &heading, &kappa,
                          &nx, &ny),
              7);
    EXPECT_EQ(s, one.s);
    EXPECT_EQ(x, one.point.x);
    EXPECT_EQ(y, one.point.y);
    EXPECT_EQ(kappa, one.kappa);
    EXPECT_NEAR(nx * std::cos(one.theta) + ny * std::sin(one.theta), 0.0, 1e-15);
  }
}

TEST(Polylines, ObjAndPlyHoldEveryVertexOnce) {
  Contour c;
  c.units = "mm";
  c.closed = true;
  c.pieces = {LinePiece{{0, 0}, {1, 0}}, LinePiece{{1, 0}, {1, 1}}, LinePiece{{1, 1}, {0, 0}}};
  const auto obj = obj_text(c, {}), ply = ply_text(c, {});
  ASSERT_TRUE(obj && ply);
  EXPECT_EQ(*obj, "# Obvid contour, lengths in mm\nv 0 0 0\nv 1 0 0\nv 1 1 0\nl 1 2 3 1\n");
  EXPECT_NE(ply->find("element vertex 3\n"), std::string::npos);
  EXPECT_NE(ply->find("element edge 3\n"), std::string::npos);
  EXPECT_NE(ply->find("\n2 0\n"), std::string::npos);
}

TEST(Solidworks, OneFilePerRunWithoutDuplicates) {
  Contour c = hook();
  c.runs = {{0, 0, 0}, {1, 2, 1}};
  const auto files = sldcrv_files(c, {});
  ASSERT_TRUE(files);
  ASSERT_EQ(files->size(), 2U);
  EXPECT_EQ((*files)[0].suffix, "-1");
  EXPECT_EQ((*files)[0].text, "0 0 0\n2 0 0\n");
  EXPECT_EQ((*files)[1].text.substr(0, 6), "2 0 0\n");
  c.runs = {{0, 2, 0}};
  EXPECT_EQ(sldcrv_files(c, {})->front().suffix, "");
}

TEST(Solidworks, MacroDrawsLinesArcsAndEllipsesInMetres) {
  Contour c = hook();
  RationalBezier conic = parabola();
  conic.origin = {3, 4};
  conic.weight = {1, 0.7, 1};
  c.pieces.emplace_back(conic);
  c.pieces.emplace_back(ClothoidPiece{{5, 6}, {5.5, 6.5}, 0.7, 0.0, 0.5, 0.7});
  c.runs = {{0, 4, 0}};
  const auto text = solidworks_macro(c, {});
  ASSERT_TRUE(text);
  EXPECT_NE(text->find("CreateLine(0, 0, 0#, 0.002, 0, 0#)"), std::string::npos);
  EXPECT_NE(text->find("CreateArc(0.002, 0.001, 0#, 0.002, 0, 0#, 0.003, 0.001, 0#, 1)"),
            std::string::npos)
      << *text;
  EXPECT_NE(text->find("CreateEllipticalArc("), std::string::npos);
  EXPECT_NE(text->find("CreateSpline2(points, True)"), std::string::npos);
}

}  // namespace
}  // namespace obvid
