// SPDX-License-Identifier: Apache-2.0
#include "kinds_shapes.h"

namespace obvid {
namespace {

using namespace kinds_test;

/// Sphere from pole to pole; u along the meridian, the normal inwards.
NurbsSurface sphere_patch(double radius) {
  SpaceCurve half = arc_about({0, 0, -radius}, {}, {0, -1, 0}, kPi);
  return form_of(RevolutionSurface{half, {}, kZ, 2.0 * kPi}, 1e-6).surface;
}

NurbsSurface torus_patch(double large, double small) {
  const SpaceCurve tube = arc_about({large + small, 0, 0}, {large, 0, 0}, {0, -1, 0}, 2.0 * kPi);
  return form_of(RevolutionSurface{tube, {}, kZ, 2.0 * kPi}, 1e-6).surface;
}

/// Bicubic with inner knots, without poles.
NurbsSurface hills() {
  NurbsSurface s{3, 3, {0, 0, 0, 0, 0.4, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 1.7, 2, 2, 2, 2}, {}, {}};
  for (std::size_t j = 0; j < s.count_v(); ++j) {
    for (std::size_t i = 0; i < s.count_u(); ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      s.points.push_back({x, y, 0.4 * std::sin(1.3 * x + 0.5) * std::cos(y)});
      s.weights.push_back(1.0 + 0.2 * std::sin(2 * x + y));
    }
  }
  return s;
}

/// Distance of the NURBS form from the definition on a raster that has nothing to do with its
/// knots.
double measured(const OffsetSurface& s, const NurbsSurface& form) {
  double worst = 0.0;
  const Range u = domain_u(form), v = domain_v(form);
  for (int i = 0; i <= 211; ++i) {
    for (int j = 0; j <= 173; ++j) {
      const double a = u.at(i / 211.0), b = v.at(j / 173.0);
      worst = std::max(worst, norm(evaluate(s, a, b).point - evaluate(form, a, b).point));
    }
  }
  return worst;
}

TEST(KindsOffset, OfASphereIsASphereUpToItsPoles) {
  for (const double distance : {-0.5, 0.25}) {
    const OffsetSurface s{sphere_patch(2.0), distance};
    const double radius = 2.0 - distance;  // the normal points inwards
    for (const double tolerance : {1e-4, 1e-6}) {
      const NurbsForm form = form_of(s, tolerance);
      EXPECT_LE(form.deviation, tolerance);
      over(form.surface, [&](double u, double v) {
        EXPECT_NEAR(norm(evaluate(form.surface, u, v).point), radius, tolerance);
        EXPECT_NEAR(norm(evaluate(s, u, v).point), radius, 1e-12);
      });
    }
  }
}

TEST(KindsOffset, PolesStayPolesFarFromTheOriginToo) {
  NurbsSurface base = sphere_patch(1.0);
  for (Vec3& p : base.points) p = p + Vec3{1e4, -2e4, 5e3};
  const OffsetSurface s{base, -0.5};
  for (const double v : {0.0, 0.1, 0.4, 0.9, 1.0}) {
    EXPECT_LT(norm(evaluate(s, 0.0, v).point - Vec3{1e4, -2e4, 5e3 - 1.5}), 1e-9);
    EXPECT_LT(norm(evaluate(s, 1.0, v).point - Vec3{1e4, -2e4, 5e3 + 1.5}), 1e-9);
  }
  EXPECT_LE(form_of(s, 1e-6).deviation, 1e-6);
}

TEST(KindsOffset, DeviationIsWhatAnotherRasterFinds) {
  for (const OffsetSurface& s : {OffsetSurface{hills(), 0.15}, OffsetSurface{hills(), -0.1},
                                 OffsetSurface{torus_patch(3, 1), -0.7}}) {
    for (const double tolerance : {1e-3, 1e-4, 1e-6}) {
      const NurbsForm form = form_of(s, tolerance);
      const double found = measured(s, form.surface);
      EXPECT_LE(found, tolerance);
      EXPECT_LE(found, form.deviation);
    }
  }
}

TEST(KindsOffset, DerivativesToSecondOrderAgreeWithDifferences) {
  expect_partials(OffsetSurface{hills(), 0.15}, 100.0);
  expect_partials(OffsetSurface{torus_patch(3, 1), 0.3}, 1000.0);
}

TEST(KindsOffset, CurvaturesAreThoseOfParallelSurfaces) {
  // k / (1 - d k) with the signs of `SurfaceCurvature`
  const NurbsSurface base = hills();
  for (const double d : {0.15, -0.2}) {
    const OffsetSurface s{base, d};
    over(base, [&](double u, double v) {
      const SurfaceCurvature a = curvature(evaluate(base, u, v)), b = curvature(evaluate(s, u, v));
      const double one = a.k1 / (1.0 - d * a.k1), two = a.k2 / (1.0 - d * a.k2);
      EXPECT_NEAR(b.gaussian, one * two, 1e-9 * (1.0 + std::abs(one * two)));
      EXPECT_NEAR(b.mean, (one + two) / 2.0, 1e-9 * (1.0 + std::abs(b.mean)));
      EXPECT_LT(norm(a.normal - b.normal), 1e-12);
    });
  }
}

TEST(KindsOffset, OfAPlaneWithAnyParametersIsExact) {
  NurbsSurface plane = hills();
  for (Vec3& p : plane.points) p.z = 0.0;
  const NurbsForm form = expect_agrees(OffsetSurface{plane, -2.5});
  EXPECT_EQ(form.deviation, 0.0);
  EXPECT_EQ(form.surface.weights, plane.weights);
}

TEST(KindsOffset, ShapesDoNotDependOnPlaceAndSize) {
  const NurbsSurface base = hills();
  for (const Similarity& by : similarities()) {
    NurbsSurface moved = base;
    for (Vec3& p : moved.points) p = by(p);
    expect_moved(OffsetSurface{base, 0.1}, OffsetSurface{moved, 0.1 * by.scale}, by, 1e-5);
  }
}

/// A tolerance that is told to be reached is: of a roof, and of hills near their smallest radius.
TEST(KindsOffset, TheToleranceThatIsNamedIsReached) {
  const NurbsSurface roof{1,
                          1,
                          {0, 0, 0.5, 1, 1},
                          {0, 0, 1, 1},
                          {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 1, 0}},
                          {}};
  const auto refused = to_nurbs(OffsetSurface{roof, 0.1}, 1e-6);
  ASSERT_FALSE(refused);
  const std::string mark = "a tolerance of ";
  const std::size_t at = refused.error().hint.find(mark);
  ASSERT_NE(at, std::string::npos) << refused.error().hint;
  const double named = std::stod(refused.error().hint.substr(at + mark.size()));
  EXPECT_GE(named, refused.error().value);
  const auto made = to_nurbs(OffsetSurface{roof, 0.1}, named);
  ASSERT_TRUE(made) << made.error().what;
  EXPECT_LE(made->deviation, named);
}

TEST(KindsOffset, CreasesAndCollapsedSurfacesAreRefused) {
  // a roof: the offset of its ridge is torn
  const NurbsSurface roof{1,
                          1,
                          {0, 0, 0.5, 1, 1},
                          {0, 0, 1, 1},
                          {{0, 0, 0}, {1, 0, 1}, {2, 0, 0}, {0, 1, 0}, {1, 1, 1}, {2, 1, 0}},
                          {}};
  expect_error(OffsetSurface{roof, 0.1}, ErrorCode::kToleranceNotReached);
  const NurbsSurface needle{
      1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {5, 0, 0}}, {}};
  expect_error(OffsetSurface{needle, 0.1}, ErrorCode::kBadOption);
  const NurbsSurface dot{1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, std::vector<Vec3>(4, {1, 2, 3}), {}};
  expect_error(OffsetSurface{dot, 0.1}, ErrorCode::kBadOption);
  expect_error(OffsetSurface{hills(), std::nan("")}, ErrorCode::kNotFinite);
  expect_error(OffsetSurface{hills(), HUGE_VAL}, ErrorCode::kNotFinite);
  expect_error(OffsetSurface{hills(), 0.1}, ErrorCode::kToleranceNotReached, 0.0);
  expect_error(OffsetSurface{hills(), 0.1}, ErrorCode::kToleranceNotReached, std::nan(""));
  expect_error(OffsetSurface{NurbsSurface{}, 0.1}, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
