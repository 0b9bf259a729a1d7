// SPDX-License-Identifier: Apache-2.0
#include "obvid/curve/internal/clothoid.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "clothoid_tail_table.h"
#include "obvid/numeric/internal/strict_arithmetic.h"

namespace obvid {
namespace {

/// The series takes over where both phases, seen from the middle, are below these (rad): the tails
/// would be up to twice as long as the clothoid, and their difference lose a digit before long.
constexpr double kLinearPhase = 0.5;
constexpr double kSquarePhase = 0.25;

constexpr std::size_t kSquareTerms = 12;  // kSquarePhase^12 / (12! 25) < 2^-57
constexpr std::size_t kLinearTerms = 8;   // kLinearPhase^16 / 16! < 2^-60

/// moment[k][j] = (-1)^j / (k! (2j)! (2j + 2k + 1)): coefficients of B^2j in the moments of
/// cos(B t) t^2k / k! over [0, 1].
using Moments = std::array<std::array<double, kLinearTerms>, kSquareTerms>;

constexpr Moments moments() {
  Moments table{};
  double k_factorial = 1.0;
  for (std::size_t k = 0; k < kSquareTerms; ++k) {
    if (k > 0) k_factorial *= static_cast<double>(k);
    double factorial = 1.0;
    for (std::size_t j = 0; j < kLinearTerms; ++j) {
      if (j > 0) factorial *= -static_cast<double>((2 * j) * (2 * j - 1));
      table[k][j] = 1.0 / (k_factorial * factorial * static_cast<double>(2 * j + 2 * k + 1));
    }
  }
  return table;
}

constexpr Moments kMoments = moments();

/// Powers of B^2 that moment k needs until the rest is below rounding: 8, 7, 6, ... 2, 1.
constexpr std::size_t terms_of(std::size_t k) {
  constexpr double kNegligible = 0x1p-57;
  double power = 1.0;
  for (std::size_t j = 0; j < k; ++j) power *= kSquarePhase;
  for (std::size_t n = 0; n < kLinearTerms; ++n, power *= kLinearPhase * kLinearPhase) {
    const double term = power * kMoments[k][n];
    if (n > 0 && (term < 0.0 ? -term : term) < kNegligible) return n;
  }
  return kLinearTerms;
}

template <std::size_t k>
double moment(double b2) {
  constexpr std::size_t n = terms_of(k);
  double sum = kMoments[k][n - 1];
  for (std::size_t j = n - 1; j-- > 0;) sum = sum * b2 + kMoments[k][j];
  return sum;
}

/// Integral over t from 0 to 1 of cos(B t) exp(i C t^2), both phases small.
Vec2 small_phases(double linear, double square) {
  const double b2 = linear * linear, c2 = -square * square;
  const double even =
      moment<0>(b2) +
      c2 * (moment<2>(b2) +
            c2 * (moment<4>(b2) +
                  c2 * (moment<6>(b2) + c2 * (moment<8>(b2) + c2 * moment<10>(b2)))));
  const double odd =
      moment<1>(b2) +
      c2 * (moment<3>(b2) +
            c2 * (moment<5>(b2) +
                  c2 * (moment<7>(b2) + c2 * (moment<9>(b2) + c2 * moment<11>(b2)))));
  return {even, square * odd};
}

/// Integral over u from 0 to infinity of exp(i (kappa u + root^2 u^2/2)), kappa and root not
/// negative: what is left of a clothoid of curvature `kappa` up to its centre.
Vec2 tail(double kappa, double root) {
  using namespace clothoid_tail;
  const double stretched = kStretch * root;
  const double inverse = 1.0 / (stretched + kappa);
  const double place = kIntervals * (stretched * inverse);
  // the last interval takes its end too, and what is no number
  const int interval = place < kIntervals ? static_cast<int>(place) : kIntervals - 1;
  const double u = 2.0 * (place - interval) - 1.0, u2 = u * u;
  const auto& c = kTable[interval];
  const auto part = [&](std::size_t p) {
    const double even = c[0][p] + u2 * (c[2][p] + u2 * (c[4][p] + u2 * (c[6][p] + u2 * c[8][p])));
    const double odd = c[1][p] + u2 * (c[3][p] + u2 * (c[5][p] + u2 * c[7][p]));
    return inverse * (even + u * odd);
  };
  return {part(0), part(1)};
}

/// Length of the vector from centre to centre, for sharpness 1: sqrt(2 pi).
constexpr double kWhole = 2.506628274631000502415765;

/// Unit clothoid between curvatures `b0` and `b1`, the start's heading given: the difference of
/// the tails from both ends to the centre; across an inflection, from centre to centre less both.
Vec2 between_centres(double theta, double b0, double b1) {
  const double side = b1 < b0 ? -1.0 : 1.0;  // as if curvature increased: mirrored where it falls
  const double root = std::sqrt(std::abs(b1 - b0));
  Vec2 first = tail(std::abs(b0), root), last = tail(std::abs(b1), root);
  first.y *= side;
  last.y *= side;
  const bool first_left = side * b0 >= 0.0, last_left = side * b1 >= 0.0;
  Vec2 sum = complex_product(first_left ? first : -first, unit_at(theta)) -
             complex_product(last_left ? last : -last, unit_at(theta + 0.5 * (b0 + b1)));
  if (first_left != last_left) {
    const double inverse = 1.0 / root, scaled = b0 * inverse;
    const double turn_to_inflection = 0.25 * std::numbers::pi - 0.5 * scaled * scaled;
    sum = sum + (kWhole * inverse) * unit_at(theta + side * turn_to_inflection);
  }
  return sum;
}

}  // namespace

Vec2 clothoid_step(double theta, double kappa0, double kappa1, double s) {
  const double b0 = kappa0 * s, b1 = kappa1 * s;
  const double linear = 0.25 * (b0 + b1), square = 0.125 * (b1 - b0);
  if (std::abs(linear) <= kLinearPhase && std::abs(square) <= kSquarePhase) {
    return s * complex_product(small_phases(linear, square), unit_at(theta + linear - square));
  }
  return s * between_centres(theta, b0, b1);
}

Element clothoid_at(const Element& start, double sharpness, double s) {
  const double kappa = start.kappa + sharpness * s;
  return {start.point + clothoid_step(start.theta, start.kappa, kappa, s),
          start.theta + 0.5 * (start.kappa + kappa) * s, kappa};
}

}  // namespace obvid
