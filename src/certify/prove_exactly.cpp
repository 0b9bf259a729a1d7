// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "decide.h"
#include "piece_facts.h"
#include "scaled_piece.h"

namespace obvid {
namespace {

using Integer = boost::multiprecision::cpp_int;

/// Doubles are whole multiples of a power of two, so the proof's polynomials have whole
/// coefficients: no rounding at all.
template <>
struct Arithmetic<Integer> {
  static constexpr double kRoundoff = 0.0;
  static constexpr int kDepth = 64;   // beyond any end that rounding moved by an ulp; a double zero
                                      // inside stays open
  static constexpr int kParts = 160;  // enough for two such ends
  static constexpr bool kExact = true;
  static int sign(const Integer& value, double) { return value.sign(); }
  static double magnitude(const Integer&) { return 0.0; }
  static Integer middle(const Integer& a, const Integer& b) { return a + b; }
  static Integer doubled(const Integer& value, std::size_t times) {
    return value << static_cast<unsigned>(times);
  }
  /// Bernstein coefficient from the scaled one, times the least common multiple of all binomials.
  static Integer unscaled(const Integer& value, int degree, int j) {
    std::int64_t multiple = 1;
    for (int k = 0; k <= degree; ++k) {
      multiple = std::lcm(multiple, static_cast<std::int64_t>(binomial(degree, k)));
    }
    return value * (multiple / static_cast<std::int64_t>(binomial(degree, j)));
  }
};

constexpr int kMantissaBits = 53;
constexpr int kNoBit = 4096;  // above every exponent of a double

/// Exponent of the last bit that any of the numbers may use.
int last_bit(int so_far, double value) {
  if (value == 0.0) return so_far;
  return std::min(so_far, std::ilogb(value) - (kMantissaBits - 1));
}

/// value / 2^exponent as an integer; `exponent` is at most that of its last bit.
Integer whole(double value, int exponent) {
  if (value == 0.0) return 0;
  int e = 0;
  const double mantissa = std::frexp(value, &e);  // value == mantissa * 2^e
  const Integer bits = static_cast<std::int64_t>(std::ldexp(mantissa, kMantissaBits));
  return bits << static_cast<unsigned>(e - kMantissaBits - exponent);
}

template <int N>
ControlDifferences<N, Integer> whole_differences(const RationalBezier& piece) {
  int place = kNoBit;
  int weight_place = kNoBit;
  for (std::size_t j = 0; j <= N; ++j) {
    place = last_bit(last_bit(place, piece.offset[j].x), piece.offset[j].y);
    weight_place = last_bit(weight_place, piece.weight[j]);
  }
  ControlDifferences<N, Integer> p;
  for (std::size_t k = 0; k <= N; ++k) {
    p.weight[k] = whole(piece.weight[k], weight_place);
    for (std::size_t l = k + 1; l <= N; ++l) {
      p.x[k][l] = whole(piece.offset[l].x, place) - whole(piece.offset[k].x, place);
      p.y[k][l] = whole(piece.offset[l].y, place) - whole(piece.offset[k].y, place);
    }
  }
  return p;
}

}  // namespace

PieceFacts examine_exactly(const RationalBezier& piece) {
  const auto unit = scaled(piece);
  if (!unit) return {};
  return with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    // Nothing is rounded, so the majorant is not looked at.
    return decide(whole_differences<N>(piece), CurvatureForm<N, double>{}, test_directions(*unit));
  });
}

std::vector<SignFrom> curvature_changes_exactly(const RationalBezier& piece) {
  std::vector<SignFrom> signs;
  static_cast<void>(with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    static_cast<void>(change_signs(whole_differences<N>(piece), CurvatureForm<N, double>{}, signs));
    return {};
  }));
  return signs;
}

std::vector<SignFrom> curvature_signs_exactly(const RationalBezier& piece) {
  std::vector<SignFrom> signs;
  static_cast<void>(with_degree(piece.degree, [&]<int N>() -> PieceFacts {
    static_cast<void>(bend_signs(whole_differences<N>(piece), {}, signs));
    return {};
  }));
  return signs;
}

bool collinear_exactly(const RationalBezier& piece, std::size_t a, std::size_t b, std::size_t c) {
  int place = kNoBit;
  for (const std::size_t j : {a, b, c}) {
    place = last_bit(last_bit(place, piece.offset[j].x), piece.offset[j].y);
  }
  const auto x = [&](std::size_t j) { return whole(piece.offset[j].x, place); };
  const auto y = [&](std::size_t j) { return whole(piece.offset[j].y, place); };
  return (x(b) - x(a)) * (y(c) - y(a)) == (y(b) - y(a)) * (x(c) - x(a));
}

}  // namespace obvid
