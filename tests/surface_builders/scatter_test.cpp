// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/scatter.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numbers>
#include <random>

#include "bounding_rectangle.h"
#include "franke.h"
#include "obvid/geom/internal/angle.h"
#include "obvid/numeric/internal/banded_cholesky.h"
#include "plane_neighbours.h"

namespace obvid {
namespace {

using Height = std::function<double(double, double)>;

/// Points at random in [0, 1] x [0, 1].
std::vector<Vec3> cloud(std::size_t count, const Height& height, unsigned seed = 1) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> at(0.0, 1.0);
  std::vector<Vec3> out;
  for (std::size_t k = 0; k < count; ++k) {
    const double x = at(random), y = at(random);
    out.push_back({x, y, height(x, y)});
  }
  return out;
}

ScatterOptions within(double tolerance) {
  ScatterOptions options;
  options.tolerance = tolerance;
  options.steepest = 85.0 * kOneDegree;
  return options;
}

/// Height of the surface over a place: its coordinates in the plane are linear in u and v.
double height_at(const ScatteredSurface& made, Vec3 place) {
  const Vec2 p = made.plane.in_plane(place);
  return made.plane.height(evaluate(made.surface, p.x / made.width, p.y / made.depth).point);
}

TEST(Scattered, PlaneComesBackWithinRounding) {
  const auto points = cloud(200, [](double x, double y) { return 3.0 - 2.0 * x + 0.5 * y; });
  const auto made = scattered(points, within(1e-3));
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_EQ(made->surface.points.size(), 16U);
  EXPECT_LT(made->deviation, 1e-14);
  EXPECT_EQ(made->bending, 0.0);
}

TEST(Scattered, QuadraticIsReproducedByOneSpan) {
  const auto points =
      cloud(300, [](double x, double y) { return x * x - 0.7 * x * y + 2 * y * y; });
  const auto made = scattered(points, within(1e-10));
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_EQ(made->surface.points.size(), 16U);
  EXPECT_LE(made->deviation, 1e-10);
  // f_xx = 2, f_xy = -0.7, f_yy = 4 everywhere
  EXPECT_NEAR(made->bending, (4.0 + 2.0 * 0.49 + 16.0) * made->width * made->depth, 1e-6);
}

TEST(Scattered, FrankesFunctionBetweenThePoints) {
  const auto points = cloud(2000, franke);
  const auto made = scattered(points, within(1e-4));
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_LE(made->deviation, 1e-4);
  double worst = 0.0;
  for (const Vec3& p : cloud(2000, franke, 7)) {
    const bool inside = std::min({p.x, p.y, 1.0 - p.x, 1.0 - p.y}) > 0.03;
    if (!inside) continue;
    const double up = made->plane.height(p), there = height_at(*made, p);
    worst = std::max(worst, std::abs(up - there));
  }
  EXPECT_LT(worst, 2e-3);
  EXPECT_LT(made->surface.points.size(), 2000U);
}

TEST(Scattered, SizeAndPlaceDoNotMatter) {
  const auto points = cloud(500, franke);
  const auto first = scattered(points, within(1e-3));
  ASSERT_TRUE(first);
  for (const double scale : {1e-9, 1e9}) {
    std::vector<Vec3> moved;
    for (const Vec3& p : points) moved.push_back(scale * Vec3{-p.y + 3.0, p.z - 2.0, p.x + 5.0});
    // a turn that takes x to z, y to -x and z to y
    ScatterOptions options = within(1e-3 * scale);
    options.up = {0.0, scale, 0.0};
    const auto made = scattered(moved, options);
    ASSERT_TRUE(made) << to_line(made.error());
    EXPECT_EQ(made->surface.points.size(), first->surface.points.size());
    EXPECT_NEAR(made->deviation / scale, first->deviation, 1e-9);
    EXPECT_NEAR(made->bending, first->bending, 1e-6 * first->bending);
  }
}

TEST(Scattered, OutliersAreNamedAndLeftOut) {
  auto points = cloud(1000, franke);
  for (const std::size_t k : {100, 400, 777}) points[k].z += k == 400 ? -3.0 : 2.0;
  ScatterOptions options = within(1e-3);
  const auto refused = scattered(points, options);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().code, ErrorCode::kSurfaceFolds);
  options.drop_outliers = true;
  const auto made = scattered(points, options);
  ASSERT_TRUE(made) << to_line(made.error());
  ASSERT_EQ(made->outliers.size(), 3U);
  const std::vector<std::size_t> known = {100, 400, 777};
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(made->outliers[k].point, known[k]);
    EXPECT_NEAR(made->outliers[k].off, k == 1 ? -3.0 : 2.0, 0.1);
  }
  EXPECT_EQ(made->used, 997U);
  EXPECT_LE(made->deviation, 1e-3);
}

TEST(Scattered, NoFalseOutliersInNoiseAndCurvature) {
  std::mt19937_64 random(5);
  std::normal_distribution<double> noise(0.0, 0.01);
  auto points = cloud(3000, franke);
  for (Vec3& p : points) p.z += noise(random);
  const auto made = scattered(points, within(0.05));
  ASSERT_TRUE(made) << to_line(made.error());
  EXPECT_TRUE(made->outliers.empty());
  const auto smooth = scattered(
      cloud(2000, [](double x, double y) { return 0.1 * std::exp(2 * x + y); }), within(1e-6));
  ASSERT_TRUE(smooth) << to_line(smooth.error());
  EXPECT_TRUE(smooth->outliers.empty());
}

TEST(Scattered, WallsAndFoldsAreRefusedWithTheirPoints) {
  auto points = cloud(300, [](double x, double) { return x; });
  points.push_back({points[7].x, points[7].y, points[7].z + 0.5});
  const auto made = scattered(points, within(1e-3));
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kSurfaceFolds);
  EXPECT_EQ(made.error().index, 7);
  EXPECT_NEAR(made.error().value, 90.0, 1e-9);
  // two halves of a sphere
  std::vector<Vec3> sphere;
  for (const Vec3& p : cloud(2000, [](double, double) { return 0.0; })) {
    const double z = 2.0 * p.x - 1.0, turn = 2.0 * std::numbers::pi * p.y, r = std::sqrt(1 - z * z);
    sphere.push_back({r * std::cos(turn), r * std::sin(turn), z});
  }
  const auto folded = scattered(sphere, within(1e-3));
  ASSERT_FALSE(folded);
  EXPECT_EQ(folded.error().code, ErrorCode::kSurfaceFolds);
}

TEST(Scattered, PartsWithoutPointsAreTold) {
  std::vector<Vec3> points;
  for (const Vec3& p : cloud(4000, franke)) {
    if (std::hypot(p.x - 0.6, p.y - 0.4) > 0.2) points.push_back(p);
  }
  const auto made = scattered(points, within(1e-2));
  ASSERT_TRUE(made) << to_line(made.error());
  const double reach = made->empty.reach;
  EXPECT_NEAR(made->empty.farthest, 0.2, 0.02);
  EXPECT_NEAR(made->empty.where.x, 0.6, 0.03);
  EXPECT_NEAR(made->empty.where.y, 0.4, 0.03);
  EXPECT_NEAR(made->empty.share, std::numbers::pi * (0.2 - reach) * (0.2 - reach), 0.01);
  const auto whole = scattered(cloud(4000, franke), within(1e-2));
  ASSERT_TRUE(whole);
  EXPECT_EQ(whole->empty.share, 0.0);
}

TEST(Scattered, RefusesWhatSpansNothing) {
  const auto code = [](const std::vector<Vec3>& points, ScatterOptions options) {
    const auto made = scattered(points, options);
    return made ? ErrorCode::kInternal : made.error().code;
  };
  EXPECT_EQ(code({{0, 0, 0}, {1, 0, 0}}, within(1)), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code({{0, 0, 0}, {1, 1, 0}, {3, 3, 1}}, within(1)), ErrorCode::kTooFewPoints);
  EXPECT_EQ(code({{0, 0, 0}, {1, 0, 0}, {0, NAN, 0}}, within(1)), ErrorCode::kNotFinite);
  EXPECT_EQ(code(cloud(9, franke), within(0)), ErrorCode::kBadOption);
  ScatterOptions flat = within(1);
  flat.up = {};
  EXPECT_EQ(code(cloud(9, franke), flat), ErrorCode::kBadOption);
  EXPECT_TRUE(scattered({{0, 0, 0}, {1, 0, 2}, {0, 1, 1}}, within(1e-9)));
}

TEST(Scattered, CanBeCancelled) {
  RunContext run;
  int asked = 0;
  run.cancelled = [&] { return ++asked > 3; };
  const auto made = scattered(cloud(500, franke), within(1e-4), run);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kCancelled);
}

TEST(BandedCholesky, SolvesWhatItWasGiven) {
  std::mt19937_64 random(3);
  std::uniform_real_distribution<double> any(-1.0, 1.0);
  for (const std::size_t n : {1U, 2U, 5U, 17U, 40U}) {
    for (const std::size_t band : {0U, 1U, 3U, 6U, 11U}) {
      BandedCholesky matrix(n, band);
      std::vector<std::vector<double>> full(n, std::vector<double>(n, 0.0));
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = i; j < std::min(n, i + band + 1); ++j) {
          const double value = i == j ? 3.0 + 2.0 * static_cast<double>(band) : any(random);
          matrix.at(i, j) = full[i][j] = full[j][i] = value;
        }
      }
      std::vector<double> x(n), right(n, 0.0);
      for (double& one : x) one = any(random);
      for (std::size_t i = 0; i < n; ++i) {
        for (std::size_t j = 0; j < n; ++j) right[i] += full[i][j] * x[j];
      }
      ASSERT_TRUE(matrix.factor([] { return true; }));
      const std::vector<double> found = matrix.solve(right);
      for (std::size_t i = 0; i < n; ++i) EXPECT_NEAR(found[i], x[i], 1e-13) << n << " " << band;
    }
  }
  BandedCholesky indefinite(2, 1);
  indefinite.at(0, 0) = indefinite.at(1, 1) = 1.0;
  indefinite.at(0, 1) = 2.0;
  EXPECT_FALSE(indefinite.factor([] { return true; }));
}

TEST(SmallestRectangle, OfATurnedOne) {
  const double turn = 0.3;
  const Vec2 along = unit_at(turn), up = left_normal(along);
  std::vector<Vec2> points;
  for (int i = 0; i <= 10; ++i) {
    for (int j = 0; j <= 4; ++j) points.push_back(Vec2{7, -2} + 0.5 * i * along + 0.25 * j * up);
  }
  const TurnedRectangle found = smallest_rectangle(points);
  EXPECT_NEAR(found.width, 5.0, 1e-12);
  EXPECT_NEAR(found.depth, 1.0, 1e-12);
  EXPECT_NEAR(norm(found.along - along), 0.0, 1e-12);
  EXPECT_NEAR(norm(found.corner - Vec2{7, -2}), 0.0, 1e-12);
}

TEST(PlaneNeighbours, AreThoseOfASearchOfAll) {
  std::mt19937_64 random(11);
  std::uniform_int_distribution<int> step(0, 12);  // many equal places and distances
  std::vector<Vec2> points;
  for (int k = 0; k < 400; ++k) points.push_back({0.5 * step(random), 1.0 * step(random)});
  const PlaneNeighbours tree(points);
  std::vector<PlaneNeighbour> found;
  for (int k = 0; k < 50; ++k) {
    const Vec2 place{0.3 * step(random), 0.7 * step(random)};
    std::vector<PlaneNeighbour> all;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const Vec2 gap = place - points[i];
      all.push_back({i, dot(gap, gap)});
    }
    std::sort(all.begin(), all.end());
    tree.nearest(place, 9, found);
    ASSERT_EQ(found.size(), 9U);
    for (std::size_t i = 0; i < 9; ++i) EXPECT_EQ(found[i].point, all[i].point);
  }
}

}  // namespace
}  // namespace obvid
