// SPDX-License-Identifier: Apache-2.0
#include "kinds_shapes.h"

namespace obvid {
namespace {

using namespace kinds_test;

constexpr double kTurn = 2.0 * kPi;

/// Half circle in the plane of x and z from the south to the north, stretched along z.
SpaceCurve half_ellipse(double a, double c) {
  SpaceCurve arc = arc_about({0, 0, -1}, {}, {0, -1, 0}, kPi);
  for (Vec3& p : arc.points) p = {a * p.x, 0.0, c * p.z};
  return arc;
}

RevolutionSurface about_z(const SpaceCurve& profile, double angle = kTurn) {
  return {profile, {}, kZ, angle};
}

SpaceCurve tube_circle(double large, double small) {
  return arc_about({large + small, 0, 0}, {large, 0, 0}, {0, -1, 0}, kTurn);
}

double radius_of(Vec3 p) { return std::hypot(p.x, p.y); }

TEST(KindsRevolution, SphereIsASphereWithItsCurvatures) {
  for (const double r : {1.0, 2.5, 1e-9, 1e9}) {
    const NurbsForm form = expect_agrees(about_z(half_ellipse(r, r)));
    EXPECT_EQ(form.deviation, 0.0);
    over(form.surface, [&](double u, double v) {
      const SurfaceJet jet = evaluate(form.surface, u, v);
      EXPECT_NEAR(norm(jet.point) / r, 1.0, 1e-13);
      if (radius_of(jet.point) < 1e-2 * r) return;  // poles have no normal
      const SurfaceCurvature k = curvature(jet);
      EXPECT_NEAR(k.gaussian * r * r, 1.0, 1e-9);
      EXPECT_NEAR(k.mean * dot(k.normal, jet.point), -1.0, 1e-9);
    });
  }
}

TEST(KindsRevolution, TorusHasTheCurvaturesOfItsClosedForm) {
  const double large = 3.0, small = 1.25;
  const NurbsForm form = expect_agrees(about_z(tube_circle(large, small)));
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    const double rho = radius_of(jet.point), c = (rho - large) / small;
    EXPECT_NEAR(std::hypot(rho - large, jet.point.z), small, 1e-13 * large);
    const SurfaceCurvature k = curvature(jet);
    EXPECT_NEAR(k.gaussian, c / (small * rho), 1e-11);
    const Vec3 outwards = jet.point - (large / rho) * Vec3{jet.point.x, jet.point.y, 0.0};
    const double side = dot(k.normal, outwards) > 0.0 ? -1.0 : 1.0;
    EXPECT_NEAR(k.mean, side * (large + 2.0 * small * c) / (2.0 * small * rho), 1e-11);
  });
}

TEST(KindsRevolution, ConeIsFlatAcrossItsRulings) {
  const double slope = 0.75;  // radius for each unit of height; the apex in the origin
  const NurbsForm form =
      expect_agrees(about_z(line_between({slope * 0.5, 0, 0.5}, {slope * 4, 0, 4})));
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    const double rho = radius_of(jet.point);
    EXPECT_NEAR(rho, slope * jet.point.z, 1e-13 * 4);
    const SurfaceCurvature k = curvature(jet);
    EXPECT_NEAR(k.gaussian, 0.0, 1e-13);
    const double cosine = 1.0 / std::hypot(1.0, slope);  // of half the angle at the apex
    EXPECT_NEAR(std::abs(k.mean), cosine / (2.0 * rho), 1e-12 / rho);
  });
}

TEST(KindsRevolution, CylinderOfOneSpanAndAQuarter) {
  const NurbsForm form = expect_agrees(about_z(line_between({2, 0, 0}, {2, 0, 5}), kPi / 2));
  EXPECT_EQ(form.surface.count_v(), 3u);
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    EXPECT_NEAR(radius_of(jet.point), 2.0, 2e-13);
    EXPECT_NEAR(jet.point.z, 5.0 * u, 5e-13);
    EXPECT_NEAR(std::abs(curvature(jet).mean), 0.25, 1e-12);
  });
}

TEST(KindsRevolution, EllipsoidHasTheGaussianCurvatureOfItsClosedForm) {
  const double a = 2.0, c = 0.7;
  const NurbsForm form = expect_agrees(about_z(half_ellipse(a, c)));
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    const double rho = radius_of(jet.point), z = jet.point.z;
    EXPECT_NEAR(rho * rho / (a * a) + z * z / (c * c), 1.0, 1e-13);
    if (rho < 1e-2) return;
    const double s = rho * rho / std::pow(a, 4) + z * z / std::pow(c, 4);
    const double expected = 1.0 / (std::pow(a, 4) * c * c * s * s);
    EXPECT_NEAR(curvature(jet).gaussian, expected, 1e-9 * expected);
  });
}

TEST(KindsRevolution, CatenoidIsMinimal) {
  std::vector<Vec3> points;
  std::vector<double> at;
  for (int i = 0; i <= 400; ++i) {
    const double t = -1.0 + i / 200.0;
    points.push_back({std::cosh(t), 0.0, t});
    at.push_back(i / 400.0);
  }
  const NurbsForm form = expect_agrees(about_z(*interpolated(points, at)));
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    // the spline's second derivative errs by step^2: 2.5e-5 of the fourth one
    EXPECT_NEAR(curvature(jet).mean, 0.0, 2e-5);
    EXPECT_NEAR(curvature(jet).gaussian, -std::pow(std::cosh(jet.point.z), -4), 4e-5);
  });
}

TEST(KindsRevolution, PartialTurnsGoTheWayOfTheRightHand) {
  for (const double angle : {0.3, -0.3, 2.0, -4.0, kTurn, -kTurn}) {
    const RevolutionSurface s = about_z(wave({1, 0, 0}, {2, 0, 3}, {0.4, 0, 0}), angle);
    expect_agrees(s);
    expect_partials(s, 10.0);
    const Vec3 end = evaluate(s, 0.0, 1.0).point;
    EXPECT_NEAR(end.x, std::cos(angle), 1e-14);
    EXPECT_NEAR(end.y, std::sin(angle), 1e-14);
  }
}

TEST(KindsRevolution, AFullTurnClosesWithoutAGapAndPolesAreOnePoint) {
  const NurbsSurface s = form_of(about_z(half_ellipse(1.0, 2.0)), 1e-6).surface;
  const std::size_t n = s.count_u(), last = s.count_v() - 1;
  for (std::size_t i = 0; i < n; ++i) EXPECT_EQ(s.points[i], s.points[last * n + i]);
  for (std::size_t j = 0; j <= last; ++j) {
    EXPECT_LE(norm(s.points[j * n] - s.points[0]), 1e-15);
    EXPECT_LE(norm(s.points[j * n + n - 1] - s.points[n - 1]), 1e-15);
  }
}

TEST(KindsRevolution, AxisOfAnyLengthAndPlace) {
  const RevolutionSurface s = about_z(wave({1, 0, 0}, {2, 0, 3}, {0.4, 0.2, 0}), 4.0);
  for (const Similarity& by : similarities()) {
    const RevolutionSurface moved{by(s.profile), by(s.axis_point), 17.0 * by.direction(kZ), 4.0};
    expect_moved(s, moved, by);
  }
}

TEST(KindsRevolution, WrongAnglesAndAxesAreRefused) {
  const SpaceCurve profile = line_between({1, 0, 0}, {1, 0, 1});
  for (const double angle : {0.0, 7.0, -7.0, std::nan(""), HUGE_VAL}) {
    expect_error(about_z(profile, angle), ErrorCode::kBadOption);
  }
  expect_error(RevolutionSurface{profile, {}, {}, 1.0}, ErrorCode::kBadOption);
  expect_error(RevolutionSurface{profile, {std::nan(""), 0, 0}, kZ, 1.0}, ErrorCode::kNotFinite);
  expect_error(RevolutionSurface{profile, {}, {0, std::nan(""), 1}, 1.0}, ErrorCode::kNotFinite);
  expect_error(about_z(line_between({1, 0, HUGE_VAL}, {1, 0, 1})), ErrorCode::kNotFinite);
  SpaceCurve torn = profile;
  torn.points.pop_back();
  expect_error(about_z(torn), ErrorCode::kBadOption);
  expect_error(about_z(SpaceCurve{}), ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
