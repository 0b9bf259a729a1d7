// SPDX-License-Identifier: Apache-2.0
// Directions of exact points that no curve keeps are mended, those that one keeps stay.
#include "obvid/fairing/internal/exact_runs.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "measured_curves.h"

namespace obvid {
namespace {

using namespace test;

ExactRuns mended(const ExactSeries& series) {
  Watch nobody;
  return exact_runs(series, nobody);
}

ExactSeries exact(std::vector<Vec2> points, std::vector<std::int8_t> direction) {
  ExactSeries series;
  series.nodes.resize(points.size());
  series.points = std::move(points);
  series.direction = std::move(direction);
  return series;
}

/// What is promised of a feasible result, whatever was given.
void expect_exact(const ExactSeries& series, const ExactRuns& runs) {
  ASSERT_TRUE(runs.feasible);
  ASSERT_EQ(runs.elements.size(), runs.source.size());
  ASSERT_EQ(runs.direction.size() + 1, runs.elements.size());
  std::size_t next = 0;
  for (std::size_t i = 0; i < runs.elements.size(); ++i) {
    if (!runs.source[i]) continue;
    EXPECT_EQ(*runs.source[i], next);  // all points, in their order
    EXPECT_EQ(runs.elements[i].point, series.points[next]);
    ++next;
  }
  EXPECT_EQ(next, series.points.size());
  for (std::size_t i = 0; i < runs.direction.size(); ++i) {
    EXPECT_TRUE(spiral_exists(runs.elements[i], runs.elements[i + 1], runs.direction[i]))
        << "link " << i;
  }
}

int vertices(const ExactRuns& runs) {
  int n = 0;
  for (std::size_t i = 1; i < runs.direction.size(); ++i) {
    n += runs.direction[i] != runs.direction[i - 1] ? 1 : 0;
  }
  return n;
}

std::vector<Vec2> on_spiral(std::size_t n, double size) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = 0.15 * static_cast<double>(i), r = size * std::exp(0.3 * t);
    out.push_back({r * std::cos(t), r * std::sin(t)});
  }
  return out;
}

/// Around the end of the longer axis, where the curvature is largest: one vertex.
std::vector<Vec2> on_ellipse(std::size_t n) {
  std::vector<Vec2> out;
  for (std::size_t i = 0; i < n; ++i) {
    const double t = -1.1 + 2.3 * static_cast<double>(i) / static_cast<double>(n - 1);
    out.push_back({2.0 * std::cos(t), std::sin(t)});
  }
  return out;
}

TEST(ExactRuns, DirectionsOfASpiralStayAndAreMetExactly) {
  for (const double size : {1e-6, 1.0, 1e6}) {
    // the radius grows with the angle: the curvature falls
    const ExactSeries series =
        exact(on_spiral(20, size), std::vector<std::int8_t>(19, std::int8_t{-1}));
    const ExactRuns runs = mended(series);
    expect_exact(series, runs);
    EXPECT_EQ(runs.direction, series.direction) << size;
    EXPECT_EQ(runs.elements.size(), series.points.size()) << size;
  }
}

TEST(ExactRuns, OneDirectionOverAVertexIsMendedWithVerticesThatBelongThere) {
  const ExactSeries series = exact(on_ellipse(15), std::vector<std::int8_t>(14, std::int8_t{1}));
  const ExactRuns runs = mended(series);
  expect_exact(series, runs);
  EXPECT_GE(vertices(runs), 1);  // how many is not promised: half of the links were wrong
  EXPECT_EQ(runs.direction.front(), 1);
}

/// On a grid that is not symmetric the adjacent circles show the vertex to a link.
TEST(ExactRuns, AVertexALinkAsideIsMovedNotMultiplied) {
  const std::vector<Vec2> points = on_ellipse(15);
  std::size_t tip = 0;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (points[i].x > points[tip].x) tip = i;
  }
  for (const std::size_t vertex : {tip - 1, tip, tip + 1}) {
    std::vector<std::int8_t> direction(14, std::int8_t{-1});
    std::fill_n(direction.begin(), vertex, std::int8_t{1});
    const ExactSeries series = exact(points, direction);
    const ExactRuns runs = mended(series);
    expect_exact(series, runs);
    EXPECT_EQ(vertices(runs), 1) << vertex;
  }
}

TEST(ExactRuns, MirroredPointsHaveTheMirroredCurve) {
  const ExactSeries series = exact(on_ellipse(15), std::vector<std::int8_t>(14, std::int8_t{1}));
  ExactSeries image = series;
  for (Vec2& p : image.points) p.y = -p.y;
  for (std::int8_t& d : image.direction) d = static_cast<std::int8_t>(-d);
  const ExactRuns one = mended(series), two = mended(image);
  ASSERT_EQ(one.direction.size(), two.direction.size());
  for (std::size_t i = 0; i < one.direction.size(); ++i) {
    EXPECT_EQ(one.direction[i], -two.direction[i]);
  }
  for (std::size_t i = 0; i < one.elements.size(); ++i) {
    EXPECT_NEAR(one.elements[i].kappa, -two.elements[i].kappa, 1e-6);
  }
}

TEST(ExactRuns, WhatIsGivenIsKept) {
  ExactSeries series = exact(on_spiral(12, 1.0), std::vector<std::int8_t>(11, std::int8_t{-1}));
  // of the logarithmic spiral: the heading is the angle, a right angle and what the growth takes
  const double heading = 0.15 * 5 + std::atan2(1.0, 0.3);
  series.nodes[5].theta = heading;
  const ExactRuns runs = mended(series);
  expect_exact(series, runs);
  EXPECT_NEAR(std::remainder(runs.elements[5].theta - heading, kTurn), 0.0, 1e-14);
}

TEST(ExactRuns, ContradictionsAreToldWithTheirPlace) {
  ExactSeries series = exact(on_spiral(12, 1.0), std::vector<std::int8_t>(11, std::int8_t{-1}));
  series.nodes[6].theta = 0.15 * 6 + std::atan2(1.0, 0.3) + 1.0;  // 57 degrees off
  series.nodes[6].kappa = 50.0;
  const ExactRuns runs = mended(series);
  if (runs.feasible) {  // with more vertices there may be such a curve: then it must keep both
    expect_exact(series, runs);
    EXPECT_GT(vertices(runs), 0);
  } else {
    EXPECT_LE(runs.trouble, 11U);
    EXPECT_GE(runs.trouble + 2, 6U);
    EXPECT_LE(runs.trouble, 8U);
  }
}

}  // namespace
}  // namespace obvid
