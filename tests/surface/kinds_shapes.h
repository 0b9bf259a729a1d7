// SPDX-License-Identifier: Apache-2.0
// What the tests of the kinds of surfaces share.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "../common/angles.h"
#include "obvid/surface/surface.h"

namespace obvid::kinds_test {

inline constexpr Vec3 kZ{0.0, 0.0, 1.0};

inline Vec3 on(const SpaceCurve& curve, double t) {
  return evaluate(curve, domain(curve).at(t)).point;
}

/// Positions inside and on the borders of the domain that are no halves or quarters of spans.
inline const std::vector<double>& parts() {
  static const std::vector<double> at = {0.0,   0.013, 0.11,  0.237, 0.371, 0.5,
                                         0.618, 0.77,  0.873, 0.991, 1.0};
  return at;
}

/// Calls `visit(u, v)` for many parameters of a surface.
template <class Kind, class Visit>
void over(const Kind& surface, const Visit& visit) {
  const Range u = domain_u(surface), v = domain_v(surface);
  for (const double a : parts()) {
    for (const double b : parts()) visit(u.at(a), v.at(b));
  }
}

inline NurbsForm form_of(const Surface& surface, double tolerance) {
  auto form = to_nurbs(surface, tolerance);
  if (!form) {
    ADD_FAILURE() << to_line(form.error());
    return {};
  }
  EXPECT_TRUE(check(form->surface)) << kind_of(surface);
  return *form;
}

/// The NURBS form over the same parameters; positions and, where it is exact, derivatives alike.
inline NurbsForm expect_agrees(const Surface& surface, double tolerance = 1e-6) {
  const NurbsForm form = form_of(surface, tolerance);
  if (form.surface.points.empty()) return form;
  EXPECT_LE(form.deviation, tolerance);
  EXPECT_EQ(domain_u(surface).from, domain_u(form.surface).from);
  EXPECT_EQ(domain_u(surface).to, domain_u(form.surface).to);
  EXPECT_EQ(domain_v(surface).from, domain_v(form.surface).from);
  EXPECT_EQ(domain_v(surface).to, domain_v(form.surface).to);
  double coordinates = 0.0;
  for (const Vec3& p : form.surface.points) coordinates = std::max(coordinates, norm(p));
  over(surface, [&](double u, double v) {
    const SurfaceJet a = evaluate(surface, u, v), b = evaluate(form.surface, u, v);
    EXPECT_LE(norm(a.point - b.point), form.deviation + 1e-13 * coordinates)
        << kind_of(surface) << " at " << u << ", " << v;
    if (form.deviation > 0.0) return;
    EXPECT_LE(norm(a.du - b.du), 1e-11 * (coordinates + norm(a.du))) << u << ", " << v;
    EXPECT_LE(norm(a.dv - b.dv), 1e-11 * (coordinates + norm(a.dv))) << u << ", " << v;
  });
  return form;
}

/// Partial derivatives of the definition against differences, at places without knots.
inline void expect_partials(const Surface& surface, double size = 1.0) {
  const double h = 1e-5;
  const Range ru = domain_u(surface), rv = domain_v(surface);
  for (const double a : {0.137, 0.571, 0.829}) {
    for (const double b : {0.171, 0.443, 0.911}) {
      const double u = ru.at(a), v = rv.at(b), hu = h * ru.length(), hv = h * rv.length();
      const SurfaceJet at = evaluate(surface, u, v);
      const SurfaceJet u1 = evaluate(surface, u + hu, v), u0 = evaluate(surface, u - hu, v);
      const SurfaceJet v1 = evaluate(surface, u, v + hv), v0 = evaluate(surface, u, v - hv);
      const double near = 1e-6 * size;
      EXPECT_LT(norm((u1.point - u0.point) / (2 * hu) - at.du), near) << kind_of(surface);
      EXPECT_LT(norm((v1.point - v0.point) / (2 * hv) - at.dv), near) << kind_of(surface);
      EXPECT_LT(norm((u1.du - u0.du) / (2 * hu) - at.duu), near) << kind_of(surface);
      EXPECT_LT(norm((v1.dv - v0.dv) / (2 * hv) - at.dvv), near) << kind_of(surface);
      EXPECT_LT(norm((v1.du - v0.du) / (2 * hv) - at.duv), near) << kind_of(surface);
      EXPECT_LT(norm((u1.dv - u0.dv) / (2 * hu) - at.duv), near) << kind_of(surface);
    }
  }
}

/// A turn, a scale and a way: what shapes do not depend on.
struct Similarity {
  double scale = 1.0;
  Vec3 way;

  [[nodiscard]] Vec3 direction(Vec3 a) const {
    // columns of an orthonormal matrix made of Pythagorean quadruples
    const Vec3 x{2.0 / 3, 2.0 / 3, 1.0 / 3}, y{-2.0 / 3, 1.0 / 3, 2.0 / 3}, z = cross(x, y);
    return a.x * x + a.y * y + a.z * z;
  }
  [[nodiscard]] Vec3 operator()(Vec3 a) const { return way + scale * direction(a); }
  [[nodiscard]] SpaceCurve operator()(SpaceCurve c) const {
    for (Vec3& p : c.points) p = (*this)(p);
    return c;
  }
};

inline const std::vector<Similarity>& similarities() {
  static const std::vector<Similarity> all = {
      {1e-9, {}}, {1e9, {}}, {1.0, {1e6, -2e6, 5e5}}, {3.5, {-7.0, 11.0, 0.5}}};
  return all;
}

/// The NURBS form of a moved surface is the moved NURBS form, relative to the coordinates.
inline void expect_moved(const Surface& original, const Surface& moved, const Similarity& by,
                         double tolerance = 1e-6) {
  const NurbsForm a = form_of(original, tolerance), b = form_of(moved, tolerance * by.scale);
  const double unit_length = by.scale + norm(by.way);
  over(a.surface, [&](double u, double v) {
    EXPECT_LE(norm(by(evaluate(a.surface, u, v).point) - evaluate(b.surface, u, v).point),
              by.scale * (a.deviation + 1e-12) + b.deviation + 1e-14 * 100.0 * unit_length);
  });
}

inline void expect_error(const Surface& surface, ErrorCode code, double tolerance = 1e-6) {
  const auto form = to_nurbs(surface, tolerance);
  ASSERT_FALSE(form) << kind_of(surface);
  EXPECT_EQ(form.error().code, code) << to_line(form.error());
  EXPECT_FALSE(form.error().what.empty());
}

/// Polynomial curve of degree 3 with an inner knot, from one point to another, waving between.
inline SpaceCurve wave(Vec3 from, Vec3 to, Vec3 swing) {
  const Vec3 way = to - from;
  return {3,
          {0, 0, 0, 0, 0.37, 1, 1, 1, 1},
          {from, from + 0.2 * way + swing, from + 0.5 * way - swing, from + 0.8 * way + 0.5 * swing,
           to},
          {}};
}

}  // namespace obvid::kinds_test
