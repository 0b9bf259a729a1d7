// SPDX-License-Identifier: Apache-2.0
#include "obvid/region/internal/curvature_chains.h"

#include <cmath>
#include <limits>

namespace obvid {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// A link in the mirror image where curvature increases.
struct Link {
  double h, alpha, beta, q;  // q = sin^2(sigma/2)
};

Link link_between(const Element& a, const Element& b, double d) {
  const Vec2 chord = b.point - a.point;
  const double alpha = d * turning(chord, unit_at(a.theta));
  const double beta = d * turning(chord, unit_at(b.theta));
  const double half = std::sin(0.5 * (alpha + beta));
  return {norm(chord), alpha, beta, half * half};
}

/// Least curvature at the end of a link, from the least one at its start.
double next_low(const Link& l, double low) {
  const double A = 0.5 * low * l.h + std::sin(l.alpha);
  const double rest = std::isinf(A) ? 0.0 : l.q / -A;
  return 2.0 / l.h * (std::sin(l.beta) + rest);
}

/// Greatest curvature at the start of a link, from the greatest one at its end.
double previous_high(const Link& l, double high) {
  const double B = 0.5 * high * l.h - std::sin(l.beta);
  const double rest = std::isinf(B) ? 0.0 : l.q / B;
  return 2.0 / l.h * (-std::sin(l.alpha) - rest);
}

}  // namespace

std::vector<CurvatureRange> curvature_chains(const std::vector<Element>& elements, int direction,
                                             bool convex, int turning_sign) {
  const std::size_t n = elements.size();
  std::vector<CurvatureRange> ranges(n);
  if (n == 0) return ranges;
  const double d = direction;
  const double sign = d * turning_sign;  // of the curvature in the mirror image
  ranges.front().low = convex && sign > 0.0 ? 0.0 : -kInfinity;
  ranges.back().high = convex && sign < 0.0 ? 0.0 : kInfinity;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    ranges[i + 1].low = next_low(link_between(elements[i], elements[i + 1], d), ranges[i].low);
  }
  for (std::size_t i = n - 1; i-- > 0;) {
    ranges[i].high =
        previous_high(link_between(elements[i], elements[i + 1], d), ranges[i + 1].high);
  }
  if (d < 0.0) {
    for (CurvatureRange& r : ranges) r = {-r.high, -r.low};
  }
  return ranges;
}

}  // namespace obvid
