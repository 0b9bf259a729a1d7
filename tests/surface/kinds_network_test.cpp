// SPDX-License-Identifier: Apache-2.0
#include "kinds_shapes.h"

namespace obvid {
namespace {

using namespace kinds_test;

const Vec3 kA{0, 0, 0}, kB{4, 0, 1}, kC{0, 3, -1}, kD{4, 4, 2};

CoonsPatch waves() {
  const SpaceCurve parabola{2, {1, 1, 1, 1.3, 2, 2, 2}, {kA, {-1, 1, 1}, {0, 2, 1}, kC}, {}};
  return {wave(kA, kB, {0, 0.4, 1}), with_domain(wave(kC, kD, {0.2, 0, -0.5}), {-5.0, 3.0}),
          parabola, line_between(kB, kD)};
}

/// Quarter arcs as borders: of different radii, so that weights and parameters are rational.
CoonsPatch arcs() {
  const double h = std::sqrt(0.5);
  return {arc_about({1, 0, 0}, {}, kZ, kPi / 2), arc_about({2, 0, 1}, {0, 0, 1}, kZ, kPi / 2),
          arc_about({1, 0, 0}, {1, 0, 1}, {0, -1, 0}, kPi / 2),
          arc_about({0, 1, 0}, {0, 1, 1}, unit({h, 0, 0}), kPi / 2)};
}

void expect_borders(const CoonsPatch& patch, const NurbsSurface& s, double near) {
  for (const double t : parts()) {
    EXPECT_LE(norm(evaluate(s, t, 0).point - on(patch.u_at_v0, t)), near);
    EXPECT_LE(norm(evaluate(s, t, 1).point - on(patch.u_at_v1, t)), near);
    EXPECT_LE(norm(evaluate(s, 0, t).point - on(patch.v_at_u0, t)), near);
    EXPECT_LE(norm(evaluate(s, 1, t).point - on(patch.v_at_u1, t)), near);
  }
}

TEST(KindsCoons, BordersOfOtherDegreesKnotsAndDomains) {
  const NurbsForm form = expect_agrees(waves());
  EXPECT_EQ(form.deviation, 0.0);
  expect_borders(waves(), form.surface, 1e-13);
  expect_partials(waves(), 100.0);
}

TEST(KindsCoons, RationalBordersWithinAnyTolerance) {
  for (const double tolerance : {1e-2, 1e-5, 1e-9}) {
    const NurbsForm form = expect_agrees(arcs(), tolerance);
    EXPECT_GT(form.deviation, 0.0);
    expect_borders(arcs(), form.surface, tolerance);
  }
  expect_error(arcs(), ErrorCode::kToleranceNotReached, 0.0);
  expect_error(arcs(), ErrorCode::kToleranceNotReached, std::nan(""));
}

TEST(KindsCoons, StraightBordersGiveTheBilinearPatch) {
  const NurbsForm form = expect_agrees(CoonsPatch{line_between(kA, kB), line_between(kC, kD),
                                                  line_between(kA, kC), line_between(kB, kD)});
  EXPECT_EQ(form.surface.degree_u, 1);
  EXPECT_EQ(form.surface.degree_v, 1);
  over(form.surface, [&](double u, double v) {
    const Vec3 expected = (1 - v) * ((1 - u) * kA + u * kB) + v * ((1 - u) * kC + u * kD);
    EXPECT_LT(norm(evaluate(form.surface, u, v).point - expected), 1e-14);
  });
}

TEST(KindsCoons, ShapesDoNotDependOnPlaceAndSize) {
  const CoonsPatch p = waves();
  for (const Similarity& by : similarities()) {
    expect_moved(p, CoonsPatch{by(p.u_at_v0), by(p.u_at_v1), by(p.v_at_u0), by(p.v_at_u1)}, by);
  }
}

/// Curves of a surface that is no product: a net that meets exactly.
NurbsSurface model() {
  NurbsSurface s{5,  4, {0, 0, 0, 0, 0, 0, 1, 1, 1, 1, 1, 1}, {0, 0, 0, 0, 0, 0.6, 1, 1, 1, 1, 1},
                 {}, {}};
  for (std::size_t j = 0; j < s.count_v(); ++j) {
    for (std::size_t i = 0; i < s.count_u(); ++i) {
      const double x = static_cast<double>(i), y = static_cast<double>(j);
      s.points.push_back({x + 0.3 * std::sin(y), y + 0.1 * x * x, std::cos(x * y) + std::sin(x)});
    }
  }
  return s;
}

GordonSurface net_of(const NurbsSurface& s, std::vector<double> us, std::vector<double> vs) {
  GordonSurface net;
  for (const double v : vs) net.along_u.push_back(isocurve_at_v(s, v));
  for (const double u : us) net.along_v.push_back(isocurve_at_u(s, u));
  net.u_at = std::move(us);
  net.v_at = std::move(vs);
  return net;
}

TEST(KindsGordon, ContainsTheCurvesOfUnevenNets) {
  const NurbsSurface s = model();
  for (const std::vector<double>& us :
       {std::vector<double>{0, 1}, {0, 0.7, 1}, {0, 0.1, 0.15, 0.8, 0.95, 1}}) {
    const GordonSurface net = net_of(s, us, {0, 0.31, 0.42, 0.9, 1});
    const NurbsForm form = expect_agrees(net);
    EXPECT_EQ(form.deviation, 0.0);
    for (const double t : parts()) {
      for (std::size_t j = 0; j < net.along_u.size(); ++j) {
        EXPECT_LT(norm(evaluate(form.surface, t, net.v_at[j]).point - on(net.along_u[j], t)),
                  1e-12);
      }
      for (std::size_t i = 0; i < net.along_v.size(); ++i) {
        EXPECT_LT(norm(evaluate(form.surface, net.u_at[i], t).point - on(net.along_v[i], t)),
                  1e-12);
      }
    }
    expect_partials(net, 2000.0);
  }
}

TEST(KindsGordon, ABicubicIsFoundAgainFromFourCurvesEachWay) {
  NurbsSurface s{3, 3, {0, 0, 0, 0, 1, 1, 1, 1}, {0, 0, 0, 0, 1, 1, 1, 1}, {}, {}};
  for (int k = 0; k < 16; ++k) {
    s.points.push_back({static_cast<double>(k % 4), k / 4 + 0.2 * std::sin(k), std::cos(2.0 * k)});
  }
  const NurbsForm form = form_of(net_of(s, {0, 0.2, 0.5, 1}, {0, 0.6, 0.7, 1}), 1e-6);
  over(s, [&](double u, double v) {
    EXPECT_LT(norm(evaluate(s, u, v).point - evaluate(form.surface, u, v).point), 1e-13);
  });
}

TEST(KindsGordon, RationalNetsWithinTheTolerance) {
  // a net on a quarter of a torus: all curves are arcs
  const SpaceCurve tube = arc_about({4, 0, 0}, {3, 0, 0}, {0, -1, 0}, 2.0);
  const NurbsSurface torus = form_of(RevolutionSurface{tube, {}, kZ, kPi / 2}, 1e-6).surface;
  const GordonSurface net = net_of(torus, {0, 0.3, 0.35, 1}, {0, 0.1, 0.8, 1});
  for (const double tolerance : {1e-3, 1e-6}) {
    const NurbsForm form = expect_agrees(net, tolerance);
    EXPECT_GT(form.deviation, 0.0);
    over(net, [&](double u, double) {
      for (std::size_t j = 0; j < net.v_at.size(); ++j) {
        EXPECT_LE(norm(evaluate(form.surface, u, net.v_at[j]).point - on(net.along_u[j], u)),
                  tolerance);
      }
    });
  }
}

TEST(KindsGordon, WrongNetsAreRefused) {
  const GordonSurface good = net_of(model(), {0, 0.4, 1}, {0, 0.5, 1});
  GordonSurface s = good;
  std::swap(s.u_at[0], s.u_at[2]);
  expect_error(s, ErrorCode::kBadOption);
  s = good;
  s.u_at = {0, std::nan(""), 1};
  expect_error(s, ErrorCode::kBadOption);
  s = good;
  s.u_at = {0, 1, 1};
  expect_error(s, ErrorCode::kBadOption);
  s = good;
  s.along_u[1].points[2].z += 0.5;
  expect_error(s, ErrorCode::kBadOption);
  s = good;
  s.along_u[1].points[2].z = std::nan("");
  expect_error(s, ErrorCode::kNotFinite);
  expect_error(GordonSurface{}, ErrorCode::kTooFewCurves);
  CoonsPatch patch = waves();
  patch.v_at_u1 = SpaceCurve{};
  expect_error(patch, ErrorCode::kBadOption);
}

}  // namespace
}  // namespace obvid
