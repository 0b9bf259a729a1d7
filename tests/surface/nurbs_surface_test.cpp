// SPDX-License-Identifier: Apache-2.0
#include "obvid/surface/nurbs_surface.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace obvid {
namespace {

/// Rational, degrees 3 and 2, uneven knots.
NurbsSurface uneven(bool rational = true) {
  NurbsSurface s{3, 2, {0, 0, 0, 0, 0.2, 0.9, 1, 1, 1, 1}, {-1, -1, -1, 0, 2, 2, 2}, {}, {}};
  for (std::size_t j = 0; j < s.count_v(); ++j) {
    for (std::size_t i = 0; i < s.count_u(); ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      s.points.push_back({x + 0.2 * y, y - 0.1 * x * x, std::sin(x) * std::cos(2 * y)});
      if (rational) s.weights.push_back(1.0 + 0.3 * std::cos(3 * x + y));
    }
  }
  return s;
}

/// A part of a sphere of radius 2 about the origin, u longitude, v latitude, normal outwards.
SurfaceJet sphere_jet(double u, double v) {
  const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v);
  return {2 * Vec3{cu * cv, su * cv, sv},   2 * Vec3{-su * cv, cu * cv, 0},
          2 * Vec3{-cu * sv, -su * sv, cv}, 2 * Vec3{-cu * cv, -su * cv, 0},
          2 * Vec3{su * sv, -cu * sv, 0},   2 * Vec3{-cu * cv, -su * cv, -sv}};
}

void expect_same_surface(const NurbsSurface& a, const NurbsSurface& b) {
  ASSERT_TRUE(check(b)) << check(b).error().what;
  for (int i = 0; i <= 20; ++i) {
    for (int j = 0; j <= 20; ++j) {
      const double u = domain_u(a).at(i / 20.0), v = domain_v(a).at(j / 20.0);
      const SurfaceJet one = evaluate(a, u, v), two = evaluate(b, u, v);
      EXPECT_LT(norm(one.point - two.point), 1e-13);
      EXPECT_LT(norm(one.du - two.du), 1e-11);
      EXPECT_LT(norm(one.dv - two.dv), 1e-11);
    }
  }
}

TEST(NurbsSurface, PartialDerivativesAgreeWithDifferences) {
  for (const bool rational : {true, false}) {
    const NurbsSurface s = uneven(rational);
    const double h = 1e-5;
    for (const double u : {0.1, 0.5, 0.95}) {
      for (const double v : {-0.5, 0.7, 1.5}) {
        const SurfaceJet at = evaluate(s, u, v);
        const SurfaceJet u1 = evaluate(s, u + h, v), u0 = evaluate(s, u - h, v);
        const SurfaceJet v1 = evaluate(s, u, v + h), v0 = evaluate(s, u, v - h);
        EXPECT_LT(norm((u1.point - u0.point) / (2 * h) - at.du), 1e-6);
        EXPECT_LT(norm((v1.point - v0.point) / (2 * h) - at.dv), 1e-6);
        EXPECT_LT(norm((u1.du - u0.du) / (2 * h) - at.duu), 1e-4);
        EXPECT_LT(norm((v1.dv - v0.dv) / (2 * h) - at.dvv), 1e-4);
        EXPECT_LT(norm((v1.du - v0.du) / (2 * h) - at.duv), 1e-4);
        EXPECT_LT(norm((u1.dv - u0.dv) / (2 * h) - at.duv), 1e-4);
      }
    }
  }
}

TEST(NurbsSurface, RasterIsEvaluationPointByPoint) {
  for (const bool rational : {true, false}) {
    const NurbsSurface along = uneven(rational);
    for (const NurbsSurface& s : {along, transposed(along)}) {
      const std::vector<double> us = {domain_u(s).to, domain_u(s).at(0.3), domain_u(s).from,
                                      domain_u(s).at(0.31)};
      const std::vector<double> vs = {domain_v(s).from, domain_v(s).at(0.77), domain_v(s).to};
      const std::vector<SurfacePoint> raster = evaluate_raster(s, us, vs);
      ASSERT_EQ(raster.size(), us.size() * vs.size());
      for (std::size_t j = 0; j < vs.size(); ++j) {
        for (std::size_t i = 0; i < us.size(); ++i) {
          const SurfaceJet jet = evaluate(s, us[i], vs[j]);
          const SurfacePoint& p = raster[j * us.size() + i];
          EXPECT_LT(norm(p.point - jet.point), 1e-14);
          EXPECT_LT(norm(p.du - jet.du), 1e-12);
          EXPECT_LT(norm(p.dv - jet.dv), 1e-12);
        }
      }
    }
  }
}

TEST(NurbsSurface, KnotsDegreesAndSplitsLeaveTheShape) {
  const NurbsSurface s = uneven();
  expect_same_surface(s, with_knots_u(s, {0.1, 0.2, 0.5, 0.5}));
  expect_same_surface(s, with_knots_v(s, {-0.5, 0.0, 1.0}));
  expect_same_surface(s, with_degrees(s, 5, 4));
  expect_same_surface(s, transposed(transposed(s)));
  const auto [left, right] = split_u(s, 0.37);
  const auto [low, high] = split_v(s, 0.0);
  for (const auto& part : {left, right, low, high}) {
    ASSERT_TRUE(check(part)) << check(part).error().what;
    for (int i = 0; i < 10; ++i) {
      for (int j = 0; j < 10; ++j) {
        const double u = domain_u(part).at(i / 10.0), v = domain_v(part).at(j / 10.0);
        EXPECT_LT(norm(evaluate(part, u, v).point - evaluate(s, u, v).point), 1e-13);
      }
    }
  }
}

TEST(NurbsSurface, IsoparametricCurvesLieOnIt) {
  const NurbsSurface s = uneven();
  const SpaceCurve along_v = isocurve_at_u(s, 0.6), along_u = isocurve_at_v(s, 1.1);
  ASSERT_TRUE(check(along_v));
  ASSERT_TRUE(check(along_u));
  for (int k = 0; k <= 20; ++k) {
    const double v = domain_v(s).at(k / 20.0), u = domain_u(s).at(k / 20.0);
    EXPECT_LT(norm(evaluate(along_v, v).point - evaluate(s, 0.6, v).point), 1e-13);
    EXPECT_LT(norm(evaluate(along_u, u).point - evaluate(s, u, 1.1).point), 1e-13);
  }
}

TEST(NurbsSurface, ReversingTurnsTheNormalRound) {
  const NurbsSurface s = uneven(), back = reversed_u(s);
  ASSERT_TRUE(check(back));
  const SurfaceCurvature a = curvature(evaluate(s, 0.3, 1.0)),
                         b = curvature(evaluate(back, 0.7, 1.0));
  EXPECT_LT(norm(a.normal + b.normal), 1e-12);
  EXPECT_NEAR(a.gaussian, b.gaussian, 1e-10);
  EXPECT_NEAR(a.mean, -b.mean, 1e-10);
}

TEST(SurfaceCurvature, OfASphereIsThatOfItsRadiusInAnyParameters) {
  for (const double v : {0.0, 0.5, 1.4, -1.5}) {
    SurfaceJet jet = sphere_jet(0.8, v);
    SurfaceCurvature c = curvature(jet);
    EXPECT_NEAR(c.k1, -0.5, 1e-12);
    EXPECT_NEAR(c.k2, -0.5, 1e-12);
    EXPECT_NEAR(c.gaussian, 0.25, 1e-12);
    EXPECT_LT(norm(c.normal - jet.point / 2.0), 1e-14);
    // parameters sheared: u = a + 3 b, v = b
    jet.dvv = jet.dvv + 6.0 * jet.duv + 9.0 * jet.duu;
    jet.duv = jet.duv + 3.0 * jet.duu;
    jet.dv = jet.dv + 3.0 * jet.du;
    c = curvature(jet);
    EXPECT_NEAR(c.gaussian, 0.25, 1e-11);
    EXPECT_NEAR(c.mean, -0.5, 1e-11);
  }
}

TEST(SurfaceCurvature, FindsPrincipalDirectionsOfASkewCylinderPatch) {
  // z = x^2 / 2 seen along coordinates turned by 30 degrees: k = 1 along x, 0 along y, normal up
  const double c = std::cos(std::numbers::pi / 6), s = std::sin(std::numbers::pi / 6);
  const SurfaceJet jet{{0, 0, 0},     {c, s, 0},      {-s, c, 0},
                       {0, 0, c * c}, {0, 0, -c * s}, {0, 0, s * s}};
  const SurfaceCurvature k = curvature(jet);
  EXPECT_NEAR(k.k1, 1.0, 1e-15);
  EXPECT_NEAR(k.k2, 0.0, 1e-15);
  EXPECT_NEAR(std::abs(k.direction1.x), 1.0, 1e-15);
}

TEST(SurfaceCurvature, IsNothingWhereTheSurfaceHasNoTangentPlane) {
  const SurfaceJet pole{{0, 0, 1}, {0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {0, 1, 0}, {0, 0, -1}};
  const SurfaceCurvature c = curvature(pole);
  EXPECT_EQ(c.normal, Vec3{});
  EXPECT_EQ(c.k1, 0.0);
}

TEST(NurbsSurface, RefusesWhatIsNoSurface) {
  NurbsSurface s = uneven();
  s.points.pop_back();
  EXPECT_FALSE(check(s));
  s = uneven();
  s.knots_v[3] = 5.0;
  EXPECT_FALSE(check(s));
  s = uneven();
  s.degree_u = 12;
  EXPECT_FALSE(check(s));
}

}  // namespace
}  // namespace obvid
