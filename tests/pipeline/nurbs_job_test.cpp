// SPDX-License-Identifier: Apache-2.0
// What the weight of a control point does, by the figures of the article; nets in any order.
#include "obvid/pipeline/nurbs_job.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace obvid {
namespace {

ControlTable controls(const std::string& text) {
  const auto table = parse_columns(text, "net");
  EXPECT_TRUE(table) << (table ? "" : to_line(table.error()));
  auto out = control_table(*table, "net");
  EXPECT_TRUE(out) << (out ? "" : to_line(out.error()));
  return std::move(*out);
}

const char* const kSix = "x,y,z,w\n0,0,0,1\n1,2,1,1\n3,3,0,0.5\n5,3,2,1\n7,2,1,3\n8,0,0,1\n";

/// N = (1 - a) B + a P, C = (1 - b) B + b P, w = ((1 - a) / a) : ((1 - b) / b), where B and N are
/// points of the curve itself with weight nearly 0 and with 1.
TEST(NurbsJobTest, RatiosOfTheArticleHold) {
  const auto made = nurbs_report(controls(kSix), {});
  ASSERT_TRUE(made) << to_line(made.error());
  const auto& curve = std::get<SpaceCurve>(made->shape);
  for (std::size_t i = 1; i + 1 < curve.points.size(); ++i) {
    const WeightRow& row = made->rows[i];
    SpaceCurve other = curve;
    other.weights[i] = 1e-14;
    EXPECT_LT(norm(evaluate(other, row.u).point - row.without), 1e-12);
    other.weights[i] = 1.0;
    EXPECT_LT(norm(evaluate(other, row.u).point - row.even), 1e-13);
    EXPECT_LT(norm(evaluate(curve, row.u).point - row.now), 1e-13);
    const Vec3 p = curve.points[i];
    EXPECT_LT(norm((1 - row.b) * row.without + row.b * p - row.now), 1e-13);
    EXPECT_NEAR((1 - row.a) / row.a / ((1 - row.b) / row.b), row.weight, 1e-12 * row.weight);
  }
}

TEST(NurbsJobTest, AMoveIsMet) {
  for (const double part : {0.05, 0.5, 0.8, 0.99}) {
    NurbsJob job;
    job.moves = {{3, part}};
    const auto made = nurbs_report(controls(kSix), job);
    ASSERT_TRUE(made) << to_line(made.error());
    const WeightRow& row = made->rows[3];
    EXPECT_NEAR(row.b, part, 1e-13);
    const Vec3 p = std::get<SpaceCurve>(made->shape).points[3];
    EXPECT_NEAR(norm(row.now - row.without), part * norm(p - row.without), 1e-12);
  }
}

/// A quarter of a circle: the classical weight, with knots of its own.
TEST(NurbsJobTest, KnotsAndWeightsMakeACircle) {
  NurbsJob job;
  job.degree = 2;
  job.knots = {0, 0, 0, 1, 1, 1};
  job.weights = {{1, std::sqrt(0.5)}};
  const auto made = nurbs_report(controls("1 0\n1 1\n0 1\n"), job);
  ASSERT_TRUE(made) << to_line(made.error());
  const auto& curve = std::get<SpaceCurve>(made->shape);
  for (const double u : {0.0, 0.3, 0.5, 0.9}) {
    EXPECT_NEAR(norm(evaluate(curve, u).point), 1.0, 1e-15);
    EXPECT_NEAR(curvature(evaluate(curve, u)), 1.0, 1e-13);
  }
}

TEST(NurbsJobTest, NetsComeInAnyOrder) {
  NurbsJob job;
  job.degree = 2;
  job.degree_v = 1;
  const auto made = nurbs_report(
      controls("row,col,x,y,z,w\n1,2,2,1,5,1\n0,0,0,0,0,1\n1,0,0,1,0,1\n0,1,1,0,1,2\n1,1,1,1,1,1\n"
               "0,2,2,0,0,1\n"),
      job);
  ASSERT_TRUE(made) << to_line(made.error());
  const auto& surface = std::get<NurbsSurface>(made->shape);
  ASSERT_EQ(surface.count_u(), 3U);
  ASSERT_EQ(surface.count_v(), 2U);
  EXPECT_EQ(surface.points[5], (Vec3{2, 1, 5}));
  EXPECT_EQ(surface.weights[1], 2.0);
}

TEST(NurbsJobTest, ACurveThatRunsThroughAPointDoesSoWhateverItsWeight) {
  NurbsJob job;
  job.degree = 1;  // a polyline: weights move nothing but the parameter
  job.knots = {-1.11472, -1.11472, 0.1, 0.3, 0.7, 1.9, 2.3, 2.3};
  job.weights = {{2, 7.0}};
  const auto made = nurbs_report(controls(kSix), job);
  ASSERT_TRUE(made) << to_line(made.error());
  for (const WeightRow& row : made->rows) {
    const Vec3 p = made->table.points[row.point];
    EXPECT_EQ(row.u, job.knots[row.point + 1]);
    EXPECT_EQ(row.a, 1.0);
    EXPECT_EQ(row.b, 1.0);
    EXPECT_EQ(row.swing, 0.0);
    for (const Vec3& place : {row.without, row.even, row.now}) EXPECT_LT(norm(place - p), 1e-14);
  }
  job.moves = {{2, 0.5}};
  const auto refused = nurbs_report(controls(kSix), job);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().what, "the curve runs through control point 3 whatever its weight");
}

TEST(NurbsJobTest, WhatCannotBeIsRefused) {
  NurbsJob job;
  job.weights = {{9, 1.0}};
  EXPECT_EQ(nurbs_report(controls(kSix), job).error().code, ErrorCode::kBadOption);
  job.weights = {{2, -1.0}};
  EXPECT_FALSE(nurbs_report(controls(kSix), job));
  job.weights.clear();
  job.moves = {{0, 0.5}};
  EXPECT_EQ(nurbs_report(controls(kSix), job).error().code, ErrorCode::kBadOption);
  job.moves.clear();
  job.knots = {0, 1};
  EXPECT_EQ(nurbs_report(controls(kSix), job).error().code, ErrorCode::kBadOption);
  const auto table = parse_columns("row,col,x,y\n0,0,0,0\n0,1,1,0\n1,0,0,1\n", "net");
  ASSERT_TRUE(table);
  EXPECT_EQ(control_table(*table, "net").error().code, ErrorCode::kBadCount);
}

}  // namespace
}  // namespace obvid
