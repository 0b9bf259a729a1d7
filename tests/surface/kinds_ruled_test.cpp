// SPDX-License-Identifier: Apache-2.0
#include "kinds_shapes.h"

namespace obvid {
namespace {

using namespace kinds_test;

SpaceCurve circle(double radius, double z, double start) {
  return arc_about({radius * std::cos(start), radius * std::sin(start), z}, {0, 0, z}, kZ,
                   2.0 * kPi);
}

TEST(KindsRuled, TwoTurnedCirclesMakeAHyperboloid) {
  const double r = std::sqrt(2.0);
  const NurbsForm form = expect_agrees(RuledSurface{circle(r, -1, 0), circle(r, 1, kPi / 2)});
  EXPECT_EQ(form.deviation, 0.0);
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    const Vec3 p = jet.point;
    EXPECT_NEAR(p.x * p.x + p.y * p.y - p.z * p.z, 1.0, 2e-13);
    EXPECT_NEAR(curvature(jet).gaussian, -std::pow(dot(p, p), -2), 1e-12);
  });
}

TEST(KindsRuled, CylindersConesAndPlanes) {
  const SpaceCurve base = circle(2.0, 0.0, 0.3);
  const NurbsForm cylinder = expect_agrees(cylinder_over(base, {0, 0, 5}));
  over(cylinder.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(cylinder.surface, u, v);
    EXPECT_NEAR(std::hypot(jet.point.x, jet.point.y), 2.0, 2e-13);
    EXPECT_NEAR(jet.point.z, 5.0 * v, 1e-14);
    EXPECT_NEAR(curvature(jet).gaussian, 0.0, 1e-14);
    EXPECT_NEAR(std::abs(curvature(jet).mean), 0.25, 1e-12);
  });
  const NurbsForm cone = expect_agrees(cone_over(base, {0, 0, 4}));
  over(cone.surface, [&](double u, double v) {
    const Vec3 p = evaluate(cone.surface, u, v).point;
    EXPECT_NEAR(std::hypot(p.x, p.y), 2.0 * (1.0 - p.z / 4.0), 4e-13);
  });
  const NurbsForm plane =
      expect_agrees(cylinder_over(line_between({1, 2, 3}, {4, 2, 3}), {0, 1, 1}));
  over(plane.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(plane.surface, u, v);
    EXPECT_NEAR(jet.point.z - jet.point.y, 1.0, 1e-14);
    EXPECT_EQ(curvature(jet).k1, 0.0);
    EXPECT_EQ(curvature(jet).k2, 0.0);
  });
}

TEST(KindsRuled, AnObliqueConeFromAPointToACurve) {
  const RuledSurface s{line_between({1, 1, 1}, {1, 1, 1}), wave({3, 0, 0}, {5, 2, 1}, {0, 1, 0})};
  expect_agrees(s);
  expect_partials(s, 10.0);
}

TEST(KindsRuled, HyperbolicParaboloidIsZEqualsXY) {
  const NurbsForm form = expect_agrees(
      RuledSurface{line_between({0, 0, 0}, {1, 0, 0}), line_between({0, 1, 0}, {1, 1, 1})});
  EXPECT_EQ(form.surface.degree_u, 1);
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    EXPECT_NEAR(jet.point.z, jet.point.x * jet.point.y, 1e-15);
    EXPECT_NEAR(curvature(jet).gaussian, -std::pow(1.0 + u * u + v * v, -2), 1e-14);
  });
}

TEST(KindsRuled, HelicoidIsMinimal) {
  const double c = 0.8;
  std::vector<Vec3> directions;
  std::vector<double> at;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    directions.push_back({std::cos(kPi * t), std::sin(kPi * t), 0.0});
    at.push_back(t);
  }
  const DirectedSurface s{line_between({}, {0, 0, c * kPi}), *interpolated(directions, at), 0.2,
                          1.7};
  const NurbsForm form = expect_agrees(s);
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    const double expected = -c * c / std::pow(v * v + c * c, 2);
    // cubic interpolation at 200 steps: first derivatives to 1e-6, second ones to 1e-4
    EXPECT_NEAR(curvature(jet).gaussian, expected, 2e-5);
    EXPECT_NEAR(curvature(jet).mean, 0.0, 2e-4);
  });
}

TEST(KindsRuled, TangentDevelopableIsFlat) {
  const SpaceCurve twisted{3,
                           {0, 0, 0, 0, 1, 1, 1, 1},
                           {{0, 0, 0}, {1. / 3, 0, 0}, {2. / 3, 1. / 3, 0}, {1, 1, 1}},
                           {}};  // t, t^2, t^3
  const SpaceCurve tangent{2, {0, 0, 0, 1, 1, 1}, {{1, 0, 0}, {1, 1, 0}, {1, 2, 3}}, {}};
  const NurbsForm form = expect_agrees(DirectedSurface{twisted, tangent, 0.5, 2.0});
  over(form.surface, [&](double u, double v) {
    const SurfaceJet jet = evaluate(form.surface, u, v);
    const Vec3 expected{u + v, u * u + 2 * u * v, u * u * u + 3 * u * u * v};
    EXPECT_LT(norm(jet.point - expected), 1e-13 * 10);
    EXPECT_NEAR(curvature(jet).gaussian, 0.0, 1e-13);
  });
}

TEST(KindsRuled, BetweenRationalCurvesOfDifferentWeightsItIsExactToo) {
  const SpaceCurve arc = arc_about({1, 0, 0}, {}, kZ, 1.9),
                   small = arc_about({1, 0, 0}, {}, kZ, 0.4);
  const SpaceCurve other{3,
                         {0, 0, 0, 0, 0.3, 0.3, 1, 1, 1, 1},
                         {{0, 0, 2}, {1, 0, 2}, {1, 1, 3}, {0, 2, 2}, {-1, 2, 1}, {-1, 0, 0}},
                         {1, 0.4, 2.5, 1, 3, 0.7}};
  const SpaceCurve line = line_between({3, 0, 4}, {2, 5, 3});
  const SpaceCurve swing = wave({3, 0, 4}, {2, 5, 3}, {0, 0, 1});
  for (const auto& [a, b] : std::vector<std::pair<SpaceCurve, SpaceCurve>>{
           {arc, line}, {line, arc}, {arc, small}, {arc, other}, {other, swing}, {swing, arc}}) {
    const NurbsForm ruled = expect_agrees(RuledSurface{a, b});
    EXPECT_EQ(ruled.deviation, 0.0);
    over(ruled.surface, [&](double u, double v) {
      const Vec3 expected =
          (1.0 - v) * evaluate(a, domain(a).at(u)).point + v * evaluate(b, domain(b).at(u)).point;
      EXPECT_LT(norm(evaluate(ruled.surface, u, v).point - expected), 5e-13);
    });
    EXPECT_EQ(expect_agrees(DirectedSurface{a, b, -1.0, 2.0}).deviation, 0.0);
  }
}

TEST(KindsRuled, BeyondTheLargestDegreeRulingsStayAndTheDeviationIsTold) {
  SpaceCurve five{5, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {}, {1, 2, 1, 0.5, 3, 1}};
  for (int i = 0; i < 6; ++i) five.points.push_back({i * 1.0, std::sin(i), 0.0});
  SpaceCurve other = five;
  other.weights = {1, 1, 0.5, 2, 1, 1};
  for (Vec3& p : other.points) p = p + Vec3{0.5, 1.0, 3.0};
  const RuledSurface s{five, other};
  const NurbsForm form = form_of(s, 1e-6);
  EXPECT_GT(form.deviation, 0.01);
  over(s, [&](double u, double v) {
    const Vec3 a = on(five, u), b = on(other, u), p = evaluate(form.surface, u, v).point;
    EXPECT_LT(norm(cross(p - a, unit(b - a))), 1e-13);
    EXPECT_LE(norm(p - evaluate(s, u, v).point), form.deviation);
  });
  expect_error(DirectedSurface{five, other, 0.0, 1.0}, ErrorCode::kBadOption);
}

TEST(KindsRuled, CurvesOfOtherDegreesKnotsAndDomains) {
  SpaceCurve first = wave({0, 0, 0}, {4, 0, 1}, {0, 0.5, 0.3});
  first = with_domain(first, {-3.0, 11.0});
  const SpaceCurve second{
      2, {5, 5, 5, 5.5, 6, 6, 6}, {{0, 3, 0}, {1, 4, 1}, {3, 3, 1}, {4, 4, 0}}, {}};
  const RuledSurface ruled{first, second};
  const NurbsForm form = expect_agrees(ruled);
  EXPECT_EQ(form.surface.degree_u, 3);
  EXPECT_EQ(form.surface.degree_v, 1);
  expect_partials(ruled, 20.0);
  const DirectedSurface directed{first, second, -2.0, 0.5};
  expect_agrees(directed);
  expect_partials(directed, 20.0);
}

TEST(KindsRuled, ShapesDoNotDependOnPlaceAndSize) {
  const RuledSurface s{arc_about({1, 0, 0}, {}, kZ, 1.9), wave({0, 0, 2}, {2, 1, 3}, {0, 1, 0})};
  for (const Similarity& by : similarities()) {
    expect_moved(s, RuledSurface{by(s.first), by(s.second)}, by);
  }
}

TEST(KindsRuled, WhatCannotBeIsRefused) {
  const SpaceCurve line = line_between({}, {1, 0, 0});
  SpaceCurve torn = line;
  torn.weights = {1.0, -1.0};
  expect_error(RuledSurface{line, torn}, ErrorCode::kBadOption);
  expect_error(RuledSurface{SpaceCurve{}, line}, ErrorCode::kBadOption);
  expect_error(RuledSurface{line, line_between({}, {std::nan(""), 0, 0})}, ErrorCode::kNotFinite);
  const SpaceCurve up = line_between({0, 0, 1}, {0, 0, 1});
  expect_error(DirectedSurface{line, up, 1.0, 1.0}, ErrorCode::kBadOption);
  expect_error(DirectedSurface{line, up, 1.0, 0.0}, ErrorCode::kBadOption);
  expect_error(DirectedSurface{line, up, 0.0, std::nan("")}, ErrorCode::kBadOption);
  expect_error(DirectedSurface{line, up, 0.0, HUGE_VAL}, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
