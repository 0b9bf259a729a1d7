// SPDX-License-Identifier: Apache-2.0
#include "obvid/contour/spirals.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace obvid {
namespace {

/// Bernstein coefficients of a complex quadratic, read from the start of the piece to its end.
using ComplexQuadratic = std::array<Vec2, 3>;

constexpr Vec2 conjugate(Vec2 z) { return {z.x, -z.y}; }

/// a * conj(b) as a complex quartic in Bernstein form.
std::array<Vec2, 5> product_with_conjugate(const ComplexQuadratic& a, const ComplexQuadratic& b) {
  const auto times = [&](std::size_t i, std::size_t j) {
    return complex_product(a[i], conjugate(b[j]));
  };
  return {times(0, 0), 0.5 * (times(0, 1) + times(1, 0)),
          (times(0, 2) + 4.0 * times(1, 1) + times(2, 0)) / 6.0, 0.5 * (times(1, 2) + times(2, 1)),
          times(2, 2)};
}

}  // namespace

std::optional<RationalBezier> spiral_piece(const LinkState& link, int direction, Vec2 start,
                                           Vec2 end) {
  if (!(cone_margin(link, direction, Cone::kClosedForm) > 0.0)) return std::nullopt;
  const double d = direction;
  const double sigma = d * link.sigma, beta = d * link.beta;
  const double A = d * link.A, B = d * link.B;
  const double sine = std::sin(sigma);
  const double rho = sine * sine / (-A * B);
  const Vec2 one_minus_b = rho * unit_at(sigma);
  const Vec2 delta = (-rho * sine / B) * unit_at(beta);
  // z = N / D on the chord from -1 to 1; the offsets from the start come from N + D
  const ComplexQuadratic denominator = {-delta, 0.5 * (one_minus_b - delta), Vec2{1.0, 0.0}};
  const ComplexQuadratic from_start = {Vec2{0.0, 0.0}, one_minus_b, Vec2{2.0, 0.0}};
  const std::array<Vec2, 5> weights = product_with_conjugate(denominator, denominator);
  const std::array<Vec2, 5> numerators = product_with_conjugate(from_start, denominator);

  RationalBezier piece;
  piece.origin = start;
  piece.degree = 4;
  const Vec2 half_chord = 0.5 * (end - start);
  // a Moebius change of the parameter makes both end weights 1 and leaves the curve as it is
  const double ratio = std::sqrt(std::sqrt(weights[4].x / weights[0].x));
  double scale = 1.0 / weights[4].x;
  for (std::size_t j = 5; j-- > 0; scale *= ratio) {
    const double w = weights[j].x;
    if (!(w > 0.0)) return std::nullopt;
    const Vec2 z = numerators[j] / w;
    piece.offset[j] = complex_product({z.x, d * z.y}, half_chord);
    piece.weight[j] = w * scale;
  }
  piece.offset[0] = {0.0, 0.0};
  piece.offset[4] = end - start;
  piece.weight[0] = piece.weight[4] = 1.0;
  return piece;
}

}  // namespace obvid
