// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include <cmath>

#include "../common/angles.h"
#include "obvid/surface/surface.h"

namespace obvid {
namespace {

constexpr double kTolerance = 1e-7;

/// Something to go on with after a failure.
NurbsSurface line_and_line() {
  return {1, 1, {0, 0, 1, 1}, {0, 0, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {}};
}

NurbsForm form(const Surface& surface, double tolerance = kTolerance) {
  auto made = to_nurbs(surface, tolerance);
  EXPECT_TRUE(made) << (made ? "" : made.error().what);
  if (!made) return {line_and_line(), 0.0};
  EXPECT_TRUE(check(made->surface)) << check(made->surface).error().what;
  return *made;
}

template <class Check>
void for_points(const NurbsSurface& s, const Check& test) {
  for (int i = 0; i <= 24; ++i) {
    for (int j = 0; j <= 24; ++j) {
      test(evaluate(s, domain_u(s).at(i / 24.0), domain_v(s).at(j / 24.0)));
    }
  }
}

/// The definition and the NURBS form give the same points and derivatives.
void expect_same(const Surface& surface, const NurbsForm& made, double points, double slopes) {
  for (double a = 0.03; a < 1.0; a += 0.13) {
    for (double b = 0.05; b < 1.0; b += 0.11) {
      const double u = domain_u(surface).at(a), v = domain_v(surface).at(b);
      const SurfaceJet one = evaluate(surface, u, v), two = evaluate(made.surface, u, v);
      EXPECT_LT(norm(one.point - two.point), points) << u << " " << v;
      EXPECT_LT(norm(one.du - two.du), slopes);
      EXPECT_LT(norm(one.dv - two.dv), slopes);
      EXPECT_LT(norm(one.duu - two.duu), 100 * slopes);
      EXPECT_LT(norm(one.duv - two.duv), 100 * slopes);
      EXPECT_LT(norm(one.dvv - two.dvv), 100 * slopes);
    }
  }
}

RevolutionSurface sphere(double radius) {
  // half a meridian from pole to pole in the plane y = 0
  return {arc_about({0, 0, -radius}, {0, 0, 0}, {0, -1, 0}, kPi), {0, 0, 0}, {0, 0, 2}, 2 * kPi};
}

RevolutionSurface torus(double major, double minor) {
  return {arc_about({major + minor, 0, 0}, {major, 0, 0}, {0, -1, 0}, 2 * kPi),
          {0, 0, 0},
          {0, 0, 1},
          2 * kPi};
}

TEST(Revolution, OfAMeridianIsTheSphereToRounding) {
  for (const double radius : {1.0, 1e-9, 1e9}) {
    const NurbsForm made = form(sphere(radius));
    EXPECT_EQ(made.deviation, 0.0);
    for_points(made.surface, [&](const SurfaceJet& jet) {
      EXPECT_NEAR(norm(jet.point) / radius, 1.0, 1e-14);
      const SurfaceCurvature k = curvature(jet);
      if (k.normal == Vec3{}) return;  // poles
      if (std::abs(jet.point.z) > 0.999 * radius) return;
      EXPECT_NEAR(k.gaussian * radius * radius, 1.0, 1e-11);
      EXPECT_NEAR(std::abs(k.mean) * radius, 1.0, 1e-11);
    });
  }
  expect_same(sphere(1.0), form(sphere(1.0)), 1e-14, 1e-12);
}

TEST(Revolution, OfACircleIsTheTorusWithItsGaussianCurvature) {
  const NurbsForm made = form(torus(3, 1));
  for_points(made.surface, [](const SurfaceJet& jet) {
    const double rho = std::hypot(jet.point.x, jet.point.y);
    EXPECT_NEAR(std::hypot(rho - 3, jet.point.z), 1.0, 1e-13);
    // K = cos t / (r (R + r cos t))
    EXPECT_NEAR(curvature(jet).gaussian, (rho - 3) / rho, 1e-11);
    // H = (R + 2 r cos t) / (2 r (R + r cos t)), up to the side
    EXPECT_NEAR(std::abs(curvature(jet).mean), std::abs((3 + 2 * (rho - 3)) / (2 * rho)), 1e-11);
  });
}

TEST(Revolution, OfAParabolaHasTheCurvatureOfTheParaboloid) {
  // z = r^2 / 2 as one Bezier piece: r = t, 0 to 2
  const SpaceCurve parabola{2, {0, 0, 0, 1, 1, 1}, {{0, 0, 0}, {1, 0, 0}, {2, 0, 2}}, {}};
  const NurbsForm made = form(RevolutionSurface{parabola, {0, 0, 0}, {0, 0, 1}, 4.0});
  for_points(made.surface, [](const SurfaceJet& jet) {
    const double r2 = jet.point.x * jet.point.x + jet.point.y * jet.point.y;
    EXPECT_NEAR(jet.point.z, r2 / 2, 1e-13);
    if (r2 < 1e-6) return;
    EXPECT_NEAR(curvature(jet).gaussian, 1.0 / ((1 + r2) * (1 + r2)), 1e-10);
  });
}

TEST(Revolution, OfALineIsAConeOrACylinderAboutAnyAxis) {
  const Vec3 axis = unit({1, 2, -2}), foot{5, 1, 0};
  const Vec3 side = unit(cross(axis, {0, 0, 1}));
  const SpaceCurve line = line_between(foot + 2.0 * side, foot + 3.0 * axis + 1.0 * side);
  const NurbsForm made = form(RevolutionSurface{line, foot, 7.0 * axis, -5.0});
  for_points(made.surface, [&](const SurfaceJet& jet) {
    const double h = dot(jet.point - foot, axis);
    EXPECT_NEAR(norm(jet.point - foot - h * axis), 2.0 - h / 3.0, 1e-13);
    EXPECT_NEAR(curvature(jet).gaussian, 0.0, 1e-12);
  });
}

TEST(Revolution, RefusesNoAxisAndNoAngle) {
  RevolutionSurface s = sphere(1);
  s.axis_direction = {0, 0, 0};
  EXPECT_EQ(to_nurbs(s, 1).error().code, ErrorCode::kBadOption);
  s = sphere(1);
  s.angle = 0.0;
  EXPECT_EQ(to_nurbs(s, 1).error().code, ErrorCode::kBadOption);
  s.angle = 7.0;
  EXPECT_EQ(to_nurbs(s, 1).error().code, ErrorCode::kBadOption);
}

TEST(Ruled, BetweenTwoTurnedCirclesIsTheHyperboloidOfOneSheet) {
  // rulings join the circle of radius 1 at z = -1 with the one at z = 1 turned by 100 degrees; the
  // waist has radius cos(50 degrees): x^2 + y^2 = cos^2 + sin^2 z^2
  const double turn = 100.0 / 180 * kPi;
  const SpaceCurve low = arc_about({1, 0, -1}, {0, 0, -1}, {0, 0, 1}, 2 * kPi);
  const SpaceCurve high =
      arc_about({std::cos(turn), std::sin(turn), 1}, {0, 0, 1}, {0, 0, 1}, 2 * kPi);
  const NurbsForm made = form(RuledSurface{low, high});
  const double c = std::cos(turn / 2), s = std::sin(turn / 2);
  for_points(made.surface, [&](const SurfaceJet& jet) {
    const Vec3& p = jet.point;
    EXPECT_NEAR(p.x * p.x + p.y * p.y, c * c + s * s * p.z * p.z, 1e-13);
    EXPECT_LT(curvature(jet).gaussian, 0.0);
  });
  expect_same(RuledSurface{low, high}, made, 1e-13, 1e-11);
}

TEST(Ruled, BetweenRationalCurvesOfDifferentWeightsKeepsItsRulings) {
  const SpaceCurve low = arc_about({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2.0);
  const SpaceCurve high = arc_about({2, 0, 1}, {0, 0, 1}, {0, 0, 1}, 1.0);
  const NurbsForm made = form(RuledSurface{low, high});
  for (double u = 0.0; u <= 1.0; u += 0.1) {
    const Vec3 a = evaluate(low, u).point, b = evaluate(high, u).point;
    for (double v = 0.0; v <= 1.0; v += 0.25) {
      const Vec3 p = evaluate(made.surface, u, v).point;
      EXPECT_LT(norm(cross(p - a, unit(b - a))), 1e-14);
    }
  }
}

TEST(Ruled, PlaneConeAndCylinderAreExact) {
  const SpaceCurve circle = arc_about({2, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi);
  for_points(form(cylinder_over(circle, {0, 0, 5})).surface, [](const SurfaceJet& jet) {
    EXPECT_NEAR(std::hypot(jet.point.x, jet.point.y), 2.0, 1e-14);
    EXPECT_NEAR(std::abs(curvature(jet).mean), 0.25, 1e-13);
  });
  for_points(form(cone_over(circle, {0, 0, 4})).surface, [](const SurfaceJet& jet) {
    EXPECT_NEAR(std::hypot(jet.point.x, jet.point.y), 2.0 - jet.point.z / 2, 1e-14);
  });
  for_points(form(cylinder_over(line_between({0, 0, 0}, {3, 1, 0}), {0, 2, 1})).surface,
             [](const SurfaceJet& jet) {
               const Vec3 normal = unit(cross(Vec3{3, 1, 0}, Vec3{0, 2, 1}));
               EXPECT_NEAR(dot(jet.point, normal), 0.0, 1e-15);
               EXPECT_NEAR(curvature(jet).mean, 0.0, 1e-15);
             });
  const DirectedSurface cylinder = cylinder_over(circle, {0, 0, 5});
  expect_same(cylinder, form(cylinder), 1e-14, 1e-12);
}

TEST(Directed, TangentDevelopableOfACubicIsFlat) {
  // C = (t, t^2, t^3), directions C'
  const SpaceCurve cubic{3,
                         {0, 0, 0, 0, 1, 1, 1, 1},
                         {{0, 0, 0}, {1 / 3.0, 0, 0}, {2 / 3.0, 1 / 3.0, 0}, {1, 1, 1}},
                         {}};
  const SpaceCurve slope{2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {1, 2, 3}}, {}};
  const DirectedSurface s{cubic, slope, 0.5, 2.0};
  const NurbsForm made = form(s);
  EXPECT_EQ(domain_v(made.surface).from, 0.5);
  for_points(made.surface,
             [](const SurfaceJet& jet) { EXPECT_NEAR(curvature(jet).gaussian, 0.0, 1e-11); });
  expect_same(s, made, 1e-13, 1e-11);
  DirectedSurface turned = s;
  turned.to = 0.5;
  EXPECT_EQ(to_nurbs(turned, 1).error().code, ErrorCode::kBadOption);
}

/// Cubic curves that meet in the corners of a skew quadrilateral.
CoonsPatch patch() {
  const auto curve = [](Vec3 a, Vec3 b, Vec3 c, Vec3 d) {
    return SpaceCurve{3, {0, 0, 0, 0, 2, 2, 2, 2}, {a, b, c, d}, {}};
  };
  const Vec3 p00{0, 0, 0}, p10{4, 0, 1}, p01{0, 3, -1}, p11{4, 4, 2};
  return {curve(p00, {1, -1, 1}, {3, 0, 2}, p10), curve(p01, {1, 3, 1}, {2, 5, 0}, p11),
          SpaceCurve{2, {0, 0, 0, 0.3, 1, 1, 1}, {p00, {-1, 1, 1}, {0, 2, 1}, p01}, {}},
          curve(p10, {5, 1, 0}, {4, 2, 3}, p11)};
}

TEST(Coons, ReproducesItsFourBorders) {
  const CoonsPatch coons = patch();
  const NurbsForm made = form(coons);
  EXPECT_EQ(made.deviation, 0.0);
  for (double t = 0.0; t <= 1.0; t += 0.02) {
    const auto at = [](const SpaceCurve& c, double part) {
      return evaluate(c, domain(c).at(part)).point;
    };
    EXPECT_LT(norm(evaluate(made.surface, t, 0).point - at(coons.u_at_v0, t)), 1e-14);
    EXPECT_LT(norm(evaluate(made.surface, t, 1).point - at(coons.u_at_v1, t)), 1e-14);
    EXPECT_LT(norm(evaluate(made.surface, 0, t).point - at(coons.v_at_u0, t)), 1e-14);
    EXPECT_LT(norm(evaluate(made.surface, 1, t).point - at(coons.v_at_u1, t)), 1e-14);
  }
  expect_same(coons, made, 1e-13, 1e-11);
}

TEST(Coons, OfStraightBordersIsTheHyperbolicParaboloid) {
  const Vec3 a{0, 0, 0}, b{1, 0, 0}, c{0, 1, 0}, d{1, 1, 1};
  const NurbsForm made = form(
      CoonsPatch{line_between(a, b), line_between(c, d), line_between(a, c), line_between(b, d)});
  for_points(made.surface, [](const SurfaceJet& jet) {
    EXPECT_NEAR(jet.point.z, jet.point.x * jet.point.y, 1e-15);
    const double w = 1 + jet.point.x * jet.point.x + jet.point.y * jet.point.y;
    EXPECT_NEAR(curvature(jet).gaussian, -1.0 / (w * w), 1e-13);
  });
}

TEST(Coons, OfRationalBordersStaysWithinTheTolerance) {
  // an eighth of a sphere has no four corners: a patch between two arcs and two lines
  const SpaceCurve low = arc_about({1, 0, 0}, {0, 0, 0}, {0, 0, 1}, 1.5);
  const SpaceCurve high = arc_about({2, 0, 1}, {0, 0, 1}, {0, 0, 1}, 1.5);
  const CoonsPatch coons{low, high, line_between({1, 0, 0}, {2, 0, 1}),
                         line_between(low.points.back(), high.points.back())};
  const NurbsForm made = form(coons, 1e-8);
  EXPECT_GT(made.deviation, 0.0);
  EXPECT_LE(made.deviation, 1e-8);
  EXPECT_TRUE(made.surface.weights.empty());
  for_points(made.surface, [](const SurfaceJet& jet) {  // a cone
    EXPECT_NEAR(std::hypot(jet.point.x, jet.point.y), 1 + jet.point.z, 3e-8);
  });
}

TEST(Coons, RefusesBordersThatDoNotMeet) {
  CoonsPatch coons = patch();
  coons.v_at_u1.points.back().z += 0.5;
  const auto made = to_nurbs(coons, 1e-6);
  ASSERT_FALSE(made);
  EXPECT_EQ(made.error().code, ErrorCode::kBadOption);
  EXPECT_NEAR(made.error().value, 0.5, 1e-12);
}

TEST(Gordon, ContainsAllCurvesOfItsNet) {
  // curves of a known surface z = sin(2x) + x y^2: cubics through its points
  const auto f = [](double x, double y) { return Vec3{x, y, std::sin(2 * x) + x * y * y}; };
  const std::vector<double> grid = {0.0, 0.25, 0.4, 0.7, 1.0};
  std::vector<double> fine;
  for (int k = 0; k <= 20; ++k) fine.push_back(k / 20.0);
  GordonSurface s;
  for (const double y : grid) {
    std::vector<Vec3> points;
    for (const double x : fine) points.push_back(f(x, y));
    s.along_u.push_back(*interpolated(points, fine));
  }
  for (const double x : grid) {
    std::vector<Vec3> points;
    for (const double y : fine) points.push_back(f(x, y));
    s.along_v.push_back(*interpolated(points, fine));
  }
  s.u_at = s.v_at = grid;
  const NurbsForm made = form(s);
  for (std::size_t k = 0; k < grid.size(); ++k) {
    for (double t = 0.0; t <= 1.0; t += 0.037) {
      EXPECT_LT(norm(evaluate(made.surface, t, grid[k]).point - evaluate(s.along_u[k], t).point),
                2e-6);
      EXPECT_LT(norm(evaluate(made.surface, grid[k], t).point - evaluate(s.along_v[k], t).point),
                2e-6);
      EXPECT_LT(norm(evaluate(made.surface, t, 0.55).point - f(t, 0.55)), 2e-3);
    }
  }
  expect_same(s, made, 1e-12, 1e-10);
}

TEST(Gordon, RefusesNetsThatDoNotCross) {
  GordonSurface s{{line_between({0, 0, 0}, {1, 0, 0}), line_between({0, 1, 0}, {1, 1, 0})},
                  {line_between({0, 0, 0}, {0, 1, 0}), line_between({1, 0, 0.1}, {1, 1, 0})},
                  {0, 1},
                  {0, 1}};
  const auto made = to_nurbs(s, 1e-6);
  ASSERT_FALSE(made);
  EXPECT_NEAR(made.error().value, 0.1, 1e-14);
  s.v_at = {0.0};
  EXPECT_EQ(to_nurbs(s, 1e-6).error().code, ErrorCode::kBadOption);
  s.along_u.pop_back();
  EXPECT_EQ(to_nurbs(s, 1e-6).error().code, ErrorCode::kTooFewCurves);
}

TEST(Offset, OfSphereTorusAndCylinderHasTheirRadiiWithinTheTolerance) {
  const NurbsForm out = form(OffsetSurface{form(torus(3, 1)).surface, -0.4}, 1e-6);
  EXPECT_LE(out.deviation, 1e-6);
  double radius = 0.0;
  for_points(out.surface, [&](const SurfaceJet& jet) {
    const double r = std::hypot(std::hypot(jet.point.x, jet.point.y) - 3, jet.point.z);
    if (radius == 0.0) radius = r;
    EXPECT_NEAR(r, radius < 1 ? 0.6 : 1.4, 2e-6);
  });
  const SpaceCurve circle = arc_about({2, 0, 0}, {0, 0, 0}, {0, 0, 1}, 2 * kPi);
  const NurbsSurface cylinder = form(cylinder_over(circle, {0, 0, 5})).surface;
  // du runs counter-clockwise, dv up: the normal points outwards
  for_points(form(OffsetSurface{cylinder, 0.5}, 1e-6).surface, [](const SurfaceJet& jet) {
    EXPECT_NEAR(std::hypot(jet.point.x, jet.point.y), 2.5, 2e-6);
  });
}

TEST(Offset, OfAPlaneIsExact) {
  const NurbsSurface plane =
      form(cylinder_over(line_between({1, 1, 1}, {3, 1, 1}), {0, 2, 0})).surface;
  const NurbsForm made = form(OffsetSurface{plane, 0.25});
  EXPECT_EQ(made.deviation, 0.0);
  for_points(made.surface, [](const SurfaceJet& jet) { EXPECT_EQ(jet.point.z, 1.25); });
}

TEST(Offset, DerivativesAgreeWithThoseOfTheOffsetCylinder) {
  const SpaceCurve circle = arc_about({2, 0, 0}, {0, 0, 0}, {0, 0, 1}, 1.0);
  const OffsetSurface s{form(cylinder_over(circle, {0, 0, 5})).surface, 0.5};
  for (double u = 0.1; u < 1.0; u += 0.2) {
    const SurfaceJet jet = evaluate(s, u, 0.3);
    EXPECT_NEAR(norm(jet.du), norm(evaluate(s.base, u, 0.3).du) * 1.25, 1e-12);
    EXPECT_NEAR(std::abs(curvature(jet).mean), 0.5 / 2.5, 1e-6);
  }
}

TEST(IdSurface, IsTheBiquadraticOfItsSplinesExactly) {
  const std::vector<double> nodes = {0.0, 0.3, 1.0, 1.2};
  const auto spline = [&](double a, double b, bool smooth) {
    IdSpline2dData data;
    data.x = data.y = nodes;
    for (const double y : nodes) {
      for (const double x : nodes) data.values.push_back(a * x + b * y * y + std::sin(a * x * y));
    }
    return *id_spline_2d(data, smooth);
  };
  for (const bool smooth : {false, true}) {
    const IdSurface s{spline(1, 0.1, smooth), spline(0.2, 1, smooth), spline(1, 1, smooth)};
    const NurbsForm made = form(s);
    EXPECT_EQ(made.surface.degree_u, 2);
    // C1 splines need each inner knot once, others twice
    EXPECT_EQ(made.surface.knots_u.size(), smooth ? 8u : 10u);
    expect_same(s, made, 1e-14, 1e-12);
  }
}

TEST(Surface, TellsItsKind) {
  EXPECT_EQ(kind_of(sphere(1)), "surface of revolution");
  EXPECT_EQ(kind_of(patch()), "Coons patch");
}

TEST(Surface, RefusesCurvesThatAreNone) {
  RuledSurface s{line_between({0, 0, 0}, {1, 0, 0}), line_between({0, 1, 0}, {1, 1, 0})};
  s.second.points[1].x = std::nan("");
  EXPECT_EQ(to_nurbs(s, 1).error().code, ErrorCode::kNotFinite);
}

}  // namespace
}  // namespace obvid
