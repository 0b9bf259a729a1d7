// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/offset.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "obvid/surface_builders/internal/grid.h"

namespace obvid {
namespace {

constexpr double kInfinite = std::numeric_limits<double>::infinity();

/// z = p x^2 + q y^2 over [-1, 1] x [-1, 1], exactly; the normal points up. x^2 has the Bezier
/// coefficients 1, -1, 1 there.
NurbsSurface quadric(double p, double q) {
  NurbsSurface surface{2, 2, {0, 0, 0, 1, 1, 1}, {0, 0, 0, 1, 1, 1}, {}, {}};
  const std::array<double, 3> square{1.0, -1.0, 1.0}, linear{-1.0, 0.0, 1.0};
  for (std::size_t j = 0; j < 3; ++j) {
    for (std::size_t i = 0; i < 3; ++i) {
      surface.points.push_back({linear[i], linear[j], p * square[i] + q * square[j]});
    }
  }
  return surface;
}

/// A curve turned about the z axis: u along the curve, v around.
NurbsSurface revolved(const SpaceCurve& profile) {
  NurbsSurface surface{profile.degree, 2, profile.knots, {}, {}, {}};
  const std::size_t n = profile.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 axis{0, 0, 1};
    const SpaceCurve circle = arc_about(profile.points[i], {0, 0, 0}, axis, 2 * std::numbers::pi);
    surface.knots_v = circle.knots;
    surface.points.resize(n * circle.points.size());
    surface.weights.resize(n * circle.points.size());
    for (std::size_t j = 0; j < circle.points.size(); ++j) {
      surface.points[j * n + i] = circle.points[j];
      surface.weights[j * n + i] =
          circle.weights[j] * (profile.weights.empty() ? 1.0 : profile.weights[i]);
    }
  }
  return surface;
}

/// Half of the largest radius: no folds either way. Beyond: folds on the side that bends.
void expect_radii(const NurbsSurface& surface, double inwards, double outwards) {
  ASSERT_TRUE(check(surface)) << check(surface).error().what;
  const OffsetCheck checked = check_offset(surface, 0.0);
  EXPECT_TRUE(checked.folds.empty());
  for (const auto& [found, wanted, side] : {std::tuple{checked.largest_inwards, inwards, -1.0},
                                            std::tuple{checked.largest_outwards, outwards, 1.0}}) {
    if (std::isinf(wanted)) {
      EXPECT_EQ(found, wanted);
      EXPECT_TRUE(check_offset(surface, side * 1e6).folds.empty());
    } else {
      EXPECT_NEAR(found, wanted, 1e-9 * wanted);
      EXPECT_TRUE(check_offset(surface, side * 0.999 * wanted).folds.empty());
      EXPECT_FALSE(check_offset(surface, side * 1.001 * wanted).folds.empty());
    }
  }
}

TEST(OffsetCheck, OfAParaboloidEndsAtTheRadiusOfItsVertex) {
  for (const double a : {0.3, 1.0, 7.0}) {
    expect_radii(quadric(0.5 / a, 0.5 / a), kInfinite, a);
    expect_radii(quadric(-0.5 / a, -0.5 / a), a, kInfinite);
  }
}

TEST(OffsetCheck, OfAParaboloidFoldsWhereItsParallelsAreSmallerThanTheDistance) {
  // principal radii of z = r^2 / 2a: sqrt(a^2 + r^2) and its third power over a^2; the first one is
  // the smaller, so that a distance d folds within r = sqrt(d^2 - a^2)
  const double a = 0.5, d = 0.8, r = std::sqrt(d * d - a * a);
  const OffsetCheck checked = check_offset(quadric(0.5 / a, 0.5 / a), d);
  ASSERT_EQ(checked.folds.size(), 1u);
  const FoldedRegion& fold = checked.folds[0];
  for (const Range& range : {fold.u, fold.v}) {  // x = 2 u - 1
    EXPECT_LE(2 * range.from - 1, -r);
    EXPECT_GE(2 * range.to - 1, r);
    EXPECT_NEAR(range.length(), r, 0.07);  // two steps of 1/32
  }
  EXPECT_NEAR(fold.worst_u, 0.5, 1e-4);
  EXPECT_NEAR(fold.worst_v, 0.5, 1e-4);
  EXPECT_NEAR(fold.curvature, 1 / a, 1e-8);
  EXPECT_TRUE(check_offset(quadric(0.5 / a, 0.5 / a), -d).folds.empty());
}

TEST(OffsetCheck, OfASaddleEndsOnBothSidesAtTheSameDistance) {
  const double a = 0.7;
  expect_radii(quadric(0.5 / a, -0.5 / a), a, a);
  const OffsetCheck checked = check_offset(quadric(0.5 / a, -0.5 / a), -0.8);
  ASSERT_EQ(checked.folds.size(), 1u);
  EXPECT_NEAR(checked.folds[0].curvature, -1 / a, 1e-8);
}

TEST(OffsetCheck, OfATorusKnowsTubeAndHole) {
  const double R = 3.0, r = 1.0;
  const SpaceCurve tube = arc_about({R + r, 0, 0}, {R, 0, 0}, {0, -1, 0}, 2 * std::numbers::pi);
  // du runs up outside, dv around: their product points inwards into the tube
  const NurbsSurface torus = revolved(tube);
  const SurfaceJet outside = evaluate(torus, 0.0, 0.0);
  ASSERT_LT(cross(outside.du, outside.dv).x, 0.0);
  expect_radii(torus, R - r, r);
  expect_radii(reversed_u(torus), r, R - r);
}

TEST(OffsetCheck, OfATorusWithASmallHoleFoldsThereOnly) {
  const double R = 1.5, r = 1.0;
  const NurbsSurface torus =
      revolved(arc_about({R + r, 0, 0}, {R, 0, 0}, {0, -1, 0}, 2 * std::numbers::pi));
  const OffsetCheck checked = check_offset(torus, -0.6);  // hole of radius 1/2
  ASSERT_EQ(checked.folds.size(), 1u);
  EXPECT_NEAR(checked.folds[0].worst_u, 0.5, 1e-4);
  EXPECT_NEAR(checked.folds[0].curvature, -2.0, 1e-8);
  EXPECT_EQ(checked.folds[0].v.from, 0.0);
  EXPECT_EQ(checked.folds[0].v.to, 1.0);
  // inside, cos t / (R + r cos t) <= -1/0.6
  const double half = std::acos(0.6 * 0.0 + 1.5 / 1.6) / (2 * std::numbers::pi);
  EXPECT_LT(checked.folds[0].u.from, 0.5 - 0.9 * half);
  EXPECT_GT(checked.folds[0].u.to, 0.5 + 0.9 * half);
  EXPECT_LT(checked.folds[0].u.length(), 2 * half + 0.1);
}

TEST(OffsetCheck, OfACylinderAPlaneAndASphere) {
  const NurbsSurface cylinder = revolved(line_between({2, 0, 0}, {2, 0, 5}));
  const SurfaceJet jet = evaluate(cylinder, 0.3, 0.0);
  ASSERT_LT(cross(jet.du, jet.dv).x, 0.0);
  expect_radii(cylinder, kInfinite, 2.0);
  expect_radii(quadric(0.0, 0.0), kInfinite, kInfinite);
  // a plane that is skew, far away and has uneven knots
  PointGrid far{7, 5, {}, "plane"};
  for (std::size_t j = 0; j < 5; ++j) {
    for (std::size_t i = 0; i < 7; ++i) {
      const double x = std::sqrt(static_cast<double>(i)), y = static_cast<double>(j * j);
      far.points.push_back(Vec3{100, -50, 70} + x * Vec3{0.6, 0.8, 0.1} + y * Vec3{-1, 0.3, 2.7});
    }
  }
  expect_radii(*interpolated(far), kInfinite, kInfinite);
  // poles: half a circle from pole to pole
  const NurbsSurface sphere =
      revolved(arc_about({0, 0, -3}, {0, 0, 0}, {0, -1, 0}, std::numbers::pi));
  expect_radii(sphere, kInfinite, 3.0);
  EXPECT_EQ(check_offset(sphere, 3.5).folds.size(), 1u);
}

TEST(OffsetCheck, SeesCurvatureThatJumpsAtAKnot) {
  // z = max(0, 1/2 - x)^2: curvature 2 just before the knot, 0 behind it
  NurbsSurface surface{2, 1, {0, 0, 0, 0.5, 1, 1, 1}, {0, 0, 1, 1}, {}, {}};
  const std::array<double, 4> x{0.0, 0.25, 0.75, 1.0}, z{0.25, 0.0, 0.0, 0.0};
  for (const double y : {0.0, 1.0}) {
    for (std::size_t i = 0; i < 4; ++i) surface.points.push_back({x[i], y, z[i]});
  }
  const OffsetCheck checked = check_offset(surface, 0.51);
  EXPECT_NEAR(checked.largest_outwards, 0.5, 1e-5);
  ASSERT_EQ(checked.folds.size(), 1u);
  EXPECT_NEAR(checked.folds[0].worst_u, 0.5, 1e-5);
}

TEST(OffsetCheck, FindsANarrowRidgeBetweenTheLinesOfTheFirstRaster) {
  // Gaussian ridge along x = 0.37 of width 0.02: greatest curvature height / width^2
  PointGrid grid{401, 5, {}, "ridge"};
  for (std::size_t j = 0; j < 5; ++j) {
    for (std::size_t i = 0; i < 401; ++i) {
      const double x = static_cast<double>(i) / 400.0, s = (x - 0.37) / 0.02;
      grid.points.push_back({x, static_cast<double>(j), 1e-3 * std::exp(-s * s / 2)});
    }
  }
  const OffsetCheck checked = check_offset(*interpolated(grid, Spread::kUniform), -0.45);
  // 0.02^2 / 1e-3; second derivatives of a spline through points h = 1/8 width apart are off by
  // h^2 / 12 of the fourth one: 3/64/12 = 0.4 %
  EXPECT_NEAR(checked.largest_inwards, 0.4 * (1 - 0.0039), 0.0005);
  ASSERT_EQ(checked.folds.size(), 1u);
  EXPECT_NEAR(checked.folds[0].worst_u, 0.37, 1e-3);
}

TEST(OffsetCheck, SeparatesRegionsAndScalesWithTheSurface) {
  // two bowls of different depth; points are a quarter of their width apart, so that the splines'
  // second derivatives are off by 3/16/12 = 1.6 % (see above)
  const auto bowls = [](double scale) {
    PointGrid grid{81, 41, {}, "bowls"};
    for (std::size_t j = 0; j < 41; ++j) {
      for (std::size_t i = 0; i < 81; ++i) {
        const double x = static_cast<double>(i) / 40.0, y = static_cast<double>(j) / 40.0;
        const auto bowl = [&](double at, double depth) {
          return -depth * std::exp(-(std::pow(x - at, 2) + std::pow(y - 0.5, 2)) / 0.02);
        };
        grid.points.push_back(scale * Vec3{x, y, bowl(0.5, 0.02) + bowl(1.5, 0.04)});
      }
    }
    return *interpolated(grid, Spread::kUniform);
  };
  for (const double scale : {1.0, 1e-6, 1e6}) {
    // curvature at the bottoms: depth / 0.01 = 2 and 4
    EXPECT_EQ(check_offset(bowls(scale), 0.2 * scale).folds.size(), 0u);
    EXPECT_EQ(check_offset(bowls(scale), 0.4 * scale).folds.size(), 1u);
    const OffsetCheck both = check_offset(bowls(scale), 0.6 * scale);
    ASSERT_EQ(both.folds.size(), 2u);
    EXPECT_NEAR(both.folds[0].worst_u + both.folds[1].worst_u, 1.0, 1e-3);
    EXPECT_NEAR(both.folds[0].curvature + both.folds[1].curvature, 1.016 * 6.0 / scale,
                0.01 / scale);
    EXPECT_NEAR(both.largest_outwards, 0.25 / 1.016 * scale, 1e-3 * scale);
  }
}

TEST(OffsetCheck, EndsInTimeWhereCurvatureHasNoBound) {
  // the cusp x = t^3, z = t^2: curvature about 3/4 / |t| without bound, on one side only
  NurbsSurface surface{3, 1, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 1, 1}, {}, {}};
  const std::array<double, 4> x{-1.0, 1.0, -1.0, 1.0}, z{1.0, -1.0 / 3, -1.0 / 3, 1.0};
  for (const double y : {0.0, 1.0}) {
    for (std::size_t i = 0; i < 4; ++i) surface.points.push_back({x[i], y, z[i]});
  }
  const auto start = std::chrono::steady_clock::now();
  int folding_sides = 0;
  for (const double distance : {-0.1, 0.1}) {
    const OffsetCheck checked = check_offset(surface, distance);
    EXPECT_LT(std::min(checked.largest_inwards, checked.largest_outwards), 1e-3);
    EXPECT_EQ(std::max(checked.largest_inwards, checked.largest_outwards), kInfinite);
    folding_sides += checked.folds.empty() ? 0 : 1;
    for (const FoldedRegion& fold : checked.folds) {
      EXPECT_LE(fold.u.from, fold.worst_u);
      EXPECT_LE(fold.worst_u, fold.u.to);
      EXPECT_GE(distance * fold.curvature, 1.0);
    }
  }
  EXPECT_EQ(folding_sides, 1);
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(60));
}

TEST(OffsetCheck, OfNoSurfaceAndOfAnyDistanceIsCalm) {
  NurbsSurface point = quadric(0.0, 0.0);
  for (Vec3& p : point.points) p = {1, 1, 1};
  EXPECT_TRUE(check_offset(point, 1.0).folds.empty());
  for (const double distance : {1e300, -1e300, kInfinite, -kInfinite, std::nan("")}) {
    EXPECT_TRUE(check_offset(quadric(0.0, 0.0), distance).folds.empty());
  }
}

}  // namespace
}  // namespace obvid
