// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface_builders/internal/lighten.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

#include "obvid/surface/internal/collocation.h"
#include "obvid/surface_builders/internal/grid.h"
#include "sampled.h"

namespace obvid {
namespace {

/// A wavy plate over [0, 1] x [0, 1], bicubic through a grid.
NurbsSurface plate(std::size_t nu, std::size_t nv, double size = 1.0) {
  const auto made = interpolated(sampled(nu, nv, [&](double u, double v) {
    return size * Vec3{u, v, 0.1 * std::sin(7.0 * u) * std::cos(3.0 * v)};
  }));
  return *made;
}

std::vector<double> inner(double from, double to, std::size_t count, int times) {
  std::vector<double> out;
  for (std::size_t k = 1; k <= count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count + 1);
    for (int i = 0; i < times; ++i) out.push_back(from + part * (to - from));
  }
  return out;
}

/// Largest distance at the same parameters, of places that stand in no row of knots.
double distance(const NurbsSurface& a, const NurbsSurface& b) {
  constexpr int kPlaces = 331;
  double most = 0.0;
  for (int i = 0; i <= kPlaces; ++i) {
    for (int j = 0; j <= kPlaces; ++j) {
      const double u = static_cast<double>(i) / kPlaces, v = static_cast<double>(j) / kPlaces;
      most = std::max(most, norm(evaluate(a, u, v).point - evaluate(b, u, v).point));
    }
  }
  return most;
}

TEST(Lighten, KnotsThatChangeNothingGoAway) {
  // one polynomial of degree 5 along and 3 across, cut into 40 x 15 spans
  NurbsSurface simple{5, 3, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}, {}, {}};
  for (int j = 0; j < 4; ++j) {
    for (int i = 0; i < 6; ++i) {
      simple.points.push_back({i * 0.2, j / 3.0, 0.1 * ((i * 7 + j * 3) % 5)});
    }
  }
  const NurbsSurface heavy =
      with_knots_v(with_knots_u(simple, inner(0, 1, 40, 3)), inner(0, 1, 15, 1));
  const auto light = lightened({heavy}, 1e-9);
  ASSERT_TRUE(light) << light.error().what;
  EXPECT_EQ(light->surfaces[0].count_u(), 6u);
  EXPECT_EQ(light->surfaces[0].count_v(), 4u);
  EXPECT_LT(distance(light->surfaces[0], simple), 1e-12);
  EXPECT_LE(light->moved, 1e-9);
}

TEST(Lighten, BoundIsAboveEveryDistanceAndNotFarAbove) {
  const NurbsSurface given = with_degrees(plate(90, 40), 5, 3);
  std::size_t before = given.points.size() + 1;
  for (const double tolerance : {1e-8, 1e-6, 1e-4, 1e-2}) {
    const auto light = lightened({given}, tolerance);
    ASSERT_TRUE(light) << light.error().what;
    const double found = distance(given, light->surfaces[0]);
    EXPECT_LE(found, light->moved) << tolerance;
    EXPECT_LE(light->moved, tolerance);
    EXPECT_GT(found, 0.25 * light->moved) << tolerance;  // two directions, each with a bound
    EXPECT_LT(light->surfaces[0].points.size(), before) << tolerance;
    before = light->surfaces[0].points.size();
  }
}

TEST(Lighten, EndsStayWithTheirDerivativesAndNeighboursTheirBorder) {
  const NurbsSurface whole = with_degrees(plate(60, 30), 5, 3);
  auto parts = split_u(whole, 0.4);
  std::vector<NurbsSurface> given(parts.begin(), parts.end());
  const auto light = lightened(given, 1e-4);
  ASSERT_TRUE(light) << light.error().what;
  for (std::size_t k = 0; k < 2; ++k) {
    EXPECT_LT(light->surfaces[k].count_u(), given[k].count_u());
    for (const double u : {domain_u(given[k]).from, domain_u(given[k]).to}) {
      // the first and the last row stay, and with them what they have along u
      for (const double v : {0.0, 1.0}) {
        const SurfaceJet a = evaluate(given[k], u, v), b = evaluate(light->surfaces[k], u, v);
        EXPECT_LT(norm(a.point - b.point), 1e-14);
        EXPECT_LT(norm(a.du - b.du), 1e-11);
        EXPECT_LT(norm(a.duu - b.duu), 1e-8);
      }
    }
  }
  for (const double v : {0.1, 0.35, 0.8}) {
    const double u = domain_u(given[0]).to;
    const SurfaceJet a = evaluate(light->surfaces[0], u, v);
    const SurfaceJet b = evaluate(light->surfaces[1], domain_u(given[1]).from, v);
    const double scale_du = norm(b.du) / norm(a.du);
    EXPECT_LT(norm(a.point - b.point), 1e-14);
    EXPECT_LT(norm(scale_du * a.du - b.du), 1e-10 * norm(b.du)) << "still smooth where they meet";
  }
}

TEST(Lighten, NumbersDoNotDependOnTheSizeOrThePlace) {
  const NurbsSurface given = with_degrees(plate(50, 20), 5, 3);
  const auto one = lightened({given}, 1e-5);
  ASSERT_TRUE(one);
  for (const double size : {1e-9, 1e9}) {
    NurbsSurface other = given;
    for (Vec3& p : other.points) p = size * p;
    const auto light = lightened({other}, 1e-5 * size);
    ASSERT_TRUE(light);
    EXPECT_EQ(light->surfaces[0].count_u(), one->surfaces[0].count_u());
    EXPECT_EQ(light->surfaces[0].count_v(), one->surfaces[0].count_v());
    EXPECT_NEAR(light->moved / size, one->moved, 1e-8);
  }
}

TEST(Lighten, WhatCannotBeLighterStays) {
  // a tolerance below the rounding of the coordinates, and strips of straight lines across
  const NurbsSurface given = with_degrees(plate(12, 6), 5, 3);
  const auto same = lightened({given}, 1e-18);
  ASSERT_TRUE(same);
  EXPECT_EQ(same->surfaces[0], given);
  EXPECT_EQ(same->moved, 0.0);
  NurbsSurface strip{5, 1, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {0, 0, 0.5, 1, 1}, {}, {}};
  for (int j = 0; j < 3; ++j) {
    for (int i = 0; i < 6; ++i) strip.points.push_back({i * 0.2, j * 1.0, 0.3 * (i % 2) * j});
  }
  const auto light = lightened({with_knots_u(strip, inner(0, 1, 30, 2))}, 1e-6);
  ASSERT_TRUE(light);
  EXPECT_EQ(light->surfaces[0].knots_v, strip.knots_v);
  EXPECT_EQ(light->surfaces[0].count_u(), 6u);
}

TEST(Lighten, RefusesWhatItCannotUse) {
  const NurbsSurface given = with_degrees(plate(12, 6), 5, 3);
  for (const double tolerance : {0.0, -1.0, std::nan(""), HUGE_VAL}) {
    EXPECT_EQ(lightened({given}, tolerance).error().code, ErrorCode::kBadOption);
  }
  NurbsSurface rational = given;
  rational.weights.assign(rational.points.size(), 1.0);
  EXPECT_EQ(lightened({rational}, 1e-3).error().code, ErrorCode::kBadOption);
  const NurbsSurface other = with_knots_v(given, {0.123});
  EXPECT_EQ(lightened({given, other}, 1e-3).error().code, ErrorCode::kBadOption);
}

TEST(Lighten, EndsWhenCancelled) {
  const NurbsSurface given = with_degrees(plate(60, 30), 5, 3);
  const RunContext run({}, [] { return true; });
  EXPECT_EQ(lightened({given}, 1e-6, run).error().code, ErrorCode::kCancelled);
}

}  // namespace
}  // namespace obvid
