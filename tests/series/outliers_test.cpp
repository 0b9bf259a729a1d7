// SPDX-License-Identifier: Apache-2.0
// Points off the curve of their neighbours: those that were put there are found, and no others.
#include "obvid/series/internal/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

namespace obvid {
namespace {

constexpr double kSigma = 1e-3;

/// Points around three quarters of an ellipse, each moved by a normal error in both directions.
std::vector<Vec2> measured_ellipse(unsigned seed, double sigma = kSigma) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> error(0.0, sigma);
  std::vector<Vec2> out;
  constexpr int kPoints = 300;
  for (int i = 0; i < kPoints; ++i) {
    const double t = 1.5 * std::numbers::pi * i / kPoints;
    const double dx = error(random), dy = error(random);
    out.push_back({2.0 * std::cos(t) + dx, std::sin(t) + dy});
  }
  return out;
}

void push_out(std::vector<Vec2>& points, std::size_t i, double by) {
  points[i] = points[i] + (by / norm(points[i])) * points[i];
}

std::vector<std::size_t> indices(const Result<Outliers>& found) {
  std::vector<std::size_t> out;
  if (!found) return out;
  for (const Outlier& one : found->points) out.push_back(one.index);
  return out;
}

TEST(Outliers, ThoseThatWerePutThereAreFoundWithTheirDistance) {
  for (unsigned seed = 1; seed <= 10; ++seed) {
    std::vector<Vec2> points = measured_ellipse(seed);
    constexpr double kOff = 0.05;
    // at places where the way out from the centre is that across the curve
    const std::vector<std::size_t> wrong = {2, 100, 101, 200};
    push_out(points, 2, kOff);    // beside the end of the longer axis
    push_out(points, 100, kOff);  // the end of the shorter one, twice
    push_out(points, 101, -kOff);
    push_out(points, 200, kOff);  // half a turn
    const auto found = outliers_of(points);
    ASSERT_TRUE(found);
    EXPECT_EQ(indices(found), wrong) << seed;
    for (const Outlier& one : found->points) EXPECT_NEAR(one.off, kOff, 0.1 * kOff) << one.index;
    EXPECT_NEAR(found->deviation, kSigma, 0.3 * kSigma);
  }
}

TEST(Outliers, NormalErrorsHaveNone) {
  for (unsigned seed = 1; seed <= 50; ++seed) {
    const auto found = outliers_of(measured_ellipse(seed));
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->points.empty()) << seed;
  }
}

class OutliersBesideCorners : public testing::TestWithParam<double> {};

TEST_P(OutliersBesideCorners, CornersAreNone) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> error(0.0, GetParam());
  std::vector<Vec2> points;
  const Vec2 corner[] = {{0, 0}, {3, 0}, {3, 2}, {0, 2}};
  for (int side = 0; side < 3; ++side) {
    for (int i = 0; i < 40; ++i) {
      const double t = i / 40.0, dx = error(random), dy = error(random);
      points.push_back((1.0 - t) * corner[side] + t * corner[side + 1] + Vec2{dx, dy});
    }
  }
  const auto found = outliers_of(points);
  ASSERT_TRUE(found);
  for (const Outlier& one : found->points) {
    ADD_FAILURE() << "sigma " << GetParam() << ", point " << one.index << ", off " << one.off;
  }
}

INSTANTIATE_TEST_SUITE_P(Errors, OutliersBesideCorners,
                         testing::Values(1e-6, 1e-4, 3e-4, 1e-3, 2e-3, 3e-3, 4e-3, 6e-3, 1e-2));

/// The cubics miss the nose, where the curvature is large: it is none, a point beside it is one.
TEST(Outliers, ASharpBendIsNone) {
  std::vector<Vec2> points;
  for (int i = -60; i <= 60; ++i) {
    const double t = i / 30.0;
    points.push_back({t * t, 0.2 * t});
  }
  EXPECT_TRUE(indices(outliers_of(points)).empty());
  points[30].y += 0.05;
  EXPECT_EQ(indices(outliers_of(points)), std::vector<std::size_t>{30});
}

/// Around NACA 0012, y = 0.6 (0.2969 x^(1/2) - 0.126 x - 0.3516 x^2 + 0.2843 x^3 - 0.1015 x^4), at
/// places with so few at the nose that cubics over a chord miss it by more than the error.
TEST(Outliers, OneBesideASparseNoseIsFound) {
  const double places[] = {1.0, 0.95, 0.9, 0.8,   0.7,  0.6,   0.5,    0.4, 0.3,
                           0.2, 0.15, 0.1, 0.075, 0.05, 0.025, 0.0125, 0.0};
  std::vector<Vec2> points;
  const auto side = [&](double x, double sign) {
    const double y = 0.2969 * std::sqrt(x) - 0.126 * x - 0.3516 * x * x + 0.2843 * x * x * x -
                     0.1015 * x * x * x * x;
    points.push_back({x, sign * 0.6 * y});
  };
  const std::size_t nose = std::size(places) - 1;
  for (const double x : places) side(x, 1.0);
  for (std::size_t k = nose; k-- > 0;) side(places[k], -1.0);
  const auto fair = outliers_of(points);
  ASSERT_TRUE(fair);
  EXPECT_TRUE(fair->points.empty());
  for (const std::size_t wrong : {nose - 3, nose + 3}) {
    std::vector<Vec2> moved = points;
    moved[wrong].y += wrong < nose ? -0.02 : 0.02;
    EXPECT_EQ(indices(outliers_of(moved)), std::vector<std::size_t>{wrong});
  }
}

/// What stays though it is farther off than the limit is told, and what has no cubic.
TEST(Outliers, WhatStaysIsTold) {
  std::vector<Vec2> points;
  for (int i = 0; i < 30; ++i) points.push_back({i - 29.0, 0.001 * ((i * 7) % 5 - 2)});
  for (int i = 1; i < 30; ++i) points.push_back({0.001 * ((i * 7) % 5 - 2), -1.0 * i});
  const auto found = outliers_of(points);
  ASSERT_TRUE(found);
  EXPECT_TRUE(found->points.empty());
  ASSERT_FALSE(found->staying.empty());
  const auto corner = std::find_if(found->staying.begin(), found->staying.end(),
                                   [](const Outlier& one) { return one.index == 29; });
  ASSERT_NE(corner, found->staying.end());
  // over the diagonal its neighbours are at 1 / sqrt(2), and 2/3 of that twice is the cubic
  EXPECT_NEAR(corner->off, std::sqrt(2.0) - 4.0 / 3.0 / std::sqrt(2.0), 0.01);
  EXPECT_EQ(found->untold, (std::vector<std::size_t>{0, 1, 57, 58}));

  points = measured_ellipse(5);
  push_out(points, 50, 0.05);
  std::vector<bool> kept(points.size(), false);
  kept[50] = true;
  const auto with_data = outliers_of(points, kept);
  ASSERT_TRUE(with_data);
  EXPECT_TRUE(std::any_of(with_data->staying.begin(), with_data->staying.end(),
                          [](const Outlier& one) { return one.index == 50; }));
}

TEST(Outliers, SizePlaceAndWayDoNotMatter) {
  std::vector<Vec2> points = measured_ellipse(4);
  for (const std::size_t i : {20U, 150U, 151U, 152U, 280U}) push_out(points, i, 0.04);
  const std::vector<std::size_t> here = indices(outliers_of(points));
  EXPECT_EQ(here, (std::vector<std::size_t>{20, 150, 151, 152, 280}));
  std::vector<Vec2> image;
  for (const Vec2 p : points) image.push_back(1048576.0 * Vec2{-p.y, p.x});
  EXPECT_EQ(indices(outliers_of(image)), here);
  std::reverse(points.begin(), points.end());
  std::vector<std::size_t> back = indices(outliers_of(points));
  for (std::size_t& i : back) i = points.size() - 1 - i;
  std::sort(back.begin(), back.end());
  EXPECT_EQ(back, here);
}

/// Anywhere in the plane, in whatever direction.
TEST(Outliers, GrossErrorsAreFound) {
  for (const Vec2 far : {Vec2{1e6, -1e6}, Vec2{0.0, 0.0}, Vec2{-3.0, 0.2}, Vec2{1.9, 0.9}}) {
    std::vector<Vec2> points = measured_ellipse(8);
    points[77] = far;
    EXPECT_EQ(indices(outliers_of(points)), std::vector<std::size_t>{77}) << far.x;
  }
}

TEST(Outliers, PointsWithDataStay) {
  std::vector<Vec2> points = measured_ellipse(5);
  push_out(points, 50, 0.05);
  std::vector<bool> kept(points.size(), false);
  kept[50] = true;
  const auto found = indices(outliers_of(points, kept));
  EXPECT_EQ(std::count(found.begin(), found.end(), 50U), 0);
}

TEST(Outliers, TooFewPointsAndTooManyOutliersAreRefused) {
  std::vector<Vec2> points = measured_ellipse(6);
  const std::vector<Vec2> few(points.begin(), points.begin() + 12);
  EXPECT_EQ(outliers_of(few).error().code, ErrorCode::kTooFewPoints);
  for (std::size_t i = 5; i + 3 < points.size(); i += 20) {
    for (std::size_t k = i; k < i + 3; ++k) push_out(points, k, 0.05);
  }
  EXPECT_EQ(outliers_of(points).error().code, ErrorCode::kNothingThere);
}

}  // namespace
}  // namespace obvid
