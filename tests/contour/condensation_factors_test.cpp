// SPDX-License-Identifier: Apache-2.0
// k1, k2 and the shift of a condensation, from the parabolas that come out.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "obvid/contour/beziers.h"

namespace obvid {
namespace {

/// Where a line from `p` along `u` meets one through `q` along `v`, in steps of u.
double meets(Vec2 p, Vec2 u, Vec2 q, Vec2 v) { return cross(q - p, v) / cross(u, v); }

/// Radius at its corner `p` of the parabola over the triangle p, t, q: side^3 over the area.
double radius_of_triangle(Vec2 p, Vec2 t, Vec2 q) {
  const double side = norm(t - p), area = 0.5 * std::abs(cross(t - p, q - p));
  return side * side * side / area;
}

TEST(Condensation, TheFactorsAreThoseOfTheRadii) {
  // two elements of the logarithmic spirals e^(b phi), b 0.5 and 1, over different turns
  for (const double b : {0.5, 1.0}) {
    for (const double turn : {0.3, 0.6, 0.9}) {
      const auto element = [b](double phi) {
        const double r = std::exp(b * phi);
        const double theta = phi + std::atan2(1.0, b);
        return Element{
            {r * std::cos(phi), r * std::sin(phi)}, theta, 1.0 / (r * std::sqrt(1.0 + b * b))};
      };
      const Element start = element(0.0), end = element(turn);
      const auto made = condense(start, end, -1);
      ASSERT_TRUE(made) << b << " " << turn;
      const Vec2 u = unit_at(start.theta), v = unit_at(end.theta);
      const RationalBezier& second = made->parabolas[1];
      const Vec2 touch = second.origin + second.offset[2], chord = end.point - start.point;
      const Vec2 first = start.point + meets(start.point, u, touch, chord) * u;
      const Vec2 last = end.point + meets(end.point, v, touch, chord) * v;
      EXPECT_NEAR(made->k1 * radius_of_triangle(start.point, first, touch), 1.0 / start.kappa,
                  1e-9 / start.kappa);
      EXPECT_NEAR(made->k2 * radius_of_triangle(end.point, last, touch), 1.0 / end.kappa,
                  1e-9 / end.kappa);
      const Vec2 middle = 0.5 * (first + last);
      EXPECT_NEAR(made->shift, dot(touch - middle, chord) / norm(chord), 1e-12 * norm(chord));
    }
  }
}

}  // namespace
}  // namespace obvid
