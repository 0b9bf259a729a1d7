// SPDX-License-Identifier: Apache-2.0
#include "kinds_shapes.h"

namespace obvid {
namespace {

using namespace kinds_test;

constexpr double kBeam = 3.0, kLength = 20.0, kDraught = 1.5;

/// Half breadth of Wigley's hull: biquadratic, so splines of its values and integrals are exact.
double wigley(double x, double z) {
  return kBeam / 2 * (1 - std::pow(2 * x / kLength, 2)) * (1 - std::pow(z / kDraught, 2));
}

const std::vector<double> kXs = {-10, -6.5, -1, 2, 7.25, 10}, kZs = {-1.5, -0.6, -0.35, 0};

template <class F>
IdSpline2d spline(const F& f, bool smooth) {
  IdSpline2dData data;
  data.x = kXs;
  data.y = kZs;
  for (const double z : kZs) {
    for (const double x : kXs) data.values.push_back(f(x, z));
  }
  return *id_spline_2d(data, smooth);
}

template <class F>
IdSurface over_grid(const F& f, bool smooth) {
  return {spline([](double x, double) { return x; }, smooth), spline(f, smooth),
          spline([](double, double z) { return z; }, smooth)};
}

TEST(KindsId, WigleysHullIsExactWithItsCurvature) {
  for (const bool smooth : {false, true}) {
    const NurbsForm form = expect_agrees(over_grid(wigley, smooth));
    EXPECT_EQ(form.deviation, 0.0);
    // each inner knot once: a biquadratic over several cells is smooth
    EXPECT_EQ(form.surface.count_u(), kXs.size() + 1);
    EXPECT_EQ(form.surface.count_v(), kZs.size() + 1);
    over(form.surface, [&](double x, double z) {
      const SurfaceJet jet = evaluate(form.surface, x, z);
      EXPECT_LT(norm(jet.point - Vec3{x, wigley(x, z), z}), 1e-12);
      const double a = 1 - std::pow(2 * x / kLength, 2), b = 1 - std::pow(z / kDraught, 2);
      const double ax = -8 * x / (kLength * kLength), bz = -2 * z / (kDraught * kDraught);
      const double half = kBeam / 2;
      const double fxx = half * b * -8 / (kLength * kLength),
                   fzz = half * a * -2 / (kDraught * kDraught);
      const double fx = half * ax * b, fz = half * a * bz, fxz = half * ax * bz;
      const double expected = (fxx * fzz - fxz * fxz) / std::pow(1 + fx * fx + fz * fz, 2);
      EXPECT_NEAR(curvature(jet).gaussian, expected, 1e-11);
    });
  }
}

TEST(KindsId, RoughSplinesKeepTheirKinksAndSmoothOnesLoseThem) {
  const auto f = [](double x, double z) { return std::sin(x) * std::cos(2 * z) + 0.1 * x * z; };
  const NurbsForm rough = expect_agrees(over_grid(f, false));
  EXPECT_EQ(rough.surface.count_u(), 2 * kXs.size() - 1);
  EXPECT_EQ(rough.surface.count_v(), 2 * kZs.size() - 1);
  const NurbsForm smooth = expect_agrees(over_grid(f, true));
  EXPECT_EQ(smooth.surface.count_u(), kXs.size() + 1);
  EXPECT_EQ(smooth.surface.count_v(), kZs.size() + 1);
  for (std::size_t j = 0; j < kZs.size(); ++j) {
    for (std::size_t i = 0; i < kXs.size(); ++i) {
      const Vec3 p = evaluate(rough.surface, kXs[i], kZs[j]).point;
      EXPECT_NEAR(p.y, f(kXs[i], kZs[j]), 1e-13);
    }
  }
  expect_partials(over_grid(f, true), 100.0);
}

TEST(KindsId, SplinesThatDoNotBelongTogetherAreRefused) {
  const IdSurface good = over_grid(wigley, true);
  IdSurface s = good;
  s.y.x[1] += 0.5;
  expect_error(s, ErrorCode::kBadOption);
  s = good;
  s.z.cells.pop_back();
  expect_error(s, ErrorCode::kBadOption);
  s = good;
  s.z.values[3] = std::nan("");
  expect_error(s, ErrorCode::kNotFinite);
  s = good;
  for (IdSpline2d* part : {&s.x, &s.y, &s.z}) part->x[1] = part->x[2];
  expect_error(s, ErrorCode::kBadOption);
  expect_error(IdSurface{}, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
