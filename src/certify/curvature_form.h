// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cmath>
#include <cstddef>

#include "double_double.h"
#include "obvid/numeric/internal/bernstein.h"

// The polynomials that decide how the curvature of a rational Bezier piece of degree N changes,
// in scaled Bernstein form. Derivation and error bounds: docs/methods/certify.md.

namespace obvid {
namespace {  // see strict_arithmetic.h

/// Control polygon as the proof needs it: differences of control points, and weights. The
/// curvature does not see the position, so no coordinate enters but through a difference.
template <int N, class S>
struct ControlDifferences {
  static constexpr std::size_t kPoints = N + 1;
  std::array<std::array<S, kPoints>, kPoints> x{};  ///< x[k][l] = point l - point k, k < l
  std::array<std::array<S, kPoints>, kPoints> y{};
  std::array<S, kPoints> weight{};
};

namespace form {

/// Factor of w_k w_l (P_l - P_k) in coefficient k + l - 1 of the hodograph.
[[nodiscard]] constexpr int hodograph_factor(int n, int k, int l) {
  const int m = n - 1;
  return static_cast<int>(binomial(m, k) * binomial(m, l - 1) -
                          binomial(m, l) * binomial(m, k - 1));
}

/// Factor of w_k w_l w_m area(P_k, P_l, P_m) in coefficient k + l + m - 3 of det(C, C', C'').
[[nodiscard]] constexpr int area_factor(int n, int k, int l, int m) {
  const auto b = [n](int i, int shift) { return binomial(n - 2, i - shift); };
  const double value = b(k, 0) * (b(l, 1) * b(m, 2) - b(l, 2) * b(m, 1)) -
                       b(k, 1) * (b(l, 0) * b(m, 2) - b(l, 2) * b(m, 0)) +
                       b(k, 2) * (b(l, 0) * b(m, 1) - b(l, 1) * b(m, 0));
  return static_cast<int>(value);
}

template <int N>
struct Factors {
  std::array<std::array<int, N + 1>, N + 1> pair{};
  std::array<std::array<std::array<int, N + 1>, N + 1>, N + 1> triple{};
  std::array<int, N + 1> weight{};
  int most_pairs = 0;    ///< terms of one coefficient of the hodograph
  int most_triples = 0;  ///< terms of one coefficient of the determinant
};

template <int N>
[[nodiscard]] constexpr Factors<N> make_factors() {
  Factors<N> f;
  std::array<int, 2 * N> pairs{};
  std::array<int, 3 * N> triples{};
  for (std::size_t k = 0; k <= N; ++k) {
    f.weight[k] = static_cast<int>(binomial(N, static_cast<int>(k)));
    for (std::size_t l = k + 1; l <= N; ++l) {
      f.pair[k][l] = hodograph_factor(N, static_cast<int>(k), static_cast<int>(l));
      ++pairs[k + l];
      for (std::size_t m = l + 1; m <= N; ++m) {
        f.triple[k][l][m] =
            area_factor(N, static_cast<int>(k), static_cast<int>(l), static_cast<int>(m));
        ++triples[k + l + m];
      }
    }
  }
  for (const int count : pairs) f.most_pairs = count > f.most_pairs ? count : f.most_pairs;
  for (const int count : triples) f.most_triples = count > f.most_triples ? count : f.most_triples;
  return f;
}

template <int N>
inline constexpr Factors<N> kFactors = make_factors<N>();

[[nodiscard]] constexpr int smaller(int a, int b) { return a < b ? a : b; }

/// Most roundings that any product in a coefficient passes through, counted along the evaluation
/// below (docs/methods/certify.md, table of roundings).
template <int N>
struct Roundings {
  static constexpr int kHodograph = 4 + kFactors<N>.most_pairs - 1;
  static constexpr int kDeterminant = 8 + kFactors<N>.most_triples - 1;
  static constexpr int kSlope =
      kDeterminant + 4 + smaller(N, 3 * N - 5) + smaller(N + 1, 3 * N - 6) - 1;
  static constexpr int kSpeed = 2 * kHodograph + 1 + 2 * (2 * N - 1) - 1;
  static constexpr int kTest = kSlope + (kSpeed + 1) + 1 + 2 * smaller(4 * N - 6, 4 * N - 4) - 1;
};

}  // namespace form

/// Hodograph (u, v) = W^2 r' / N, squared speed u^2 + v^2, and the test polynomial, a positive
/// multiple of W^p (u^2+v^2)^q d kappa / dt.
template <int N, class S>
struct CurvatureForm {
  std::array<S, 2 * N - 1> u{};
  std::array<S, 2 * N - 1> v{};
  std::array<S, 4 * N - 3> speed{};
  std::array<S, 8 * N - 11> test{};
};

template <int N, class S>
void add_hodograph(const ControlDifferences<N, S>& p, CurvatureForm<N, S>& f) {
  for (std::size_t k = 0; k <= N; ++k) {
    for (std::size_t l = k + 1; l <= N; ++l) {
      const S w = p.weight[k] * p.weight[l] * form::kFactors<N>.pair[k][l];
      f.u[k + l - 1] = f.u[k + l - 1] + w * p.x[k][l];
      f.v[k + l - 1] = f.v[k + l - 1] + w * p.y[k][l];
    }
  }
}

/// det(C, C', C''). With `Magnitude` all terms count positive (the inputs are then absolute).
template <bool Magnitude, int N, class S>
[[nodiscard]] std::array<S, 3 * N - 5> determinant(const ControlDifferences<N, S>& p) {
  std::array<S, 3 * N - 5> d{};
  for (std::size_t k = 0; k <= N; ++k) {
    for (std::size_t l = k + 1; l <= N; ++l) {
      const S w = p.weight[k] * p.weight[l];
      for (std::size_t m = l + 1; m <= N; ++m) {
        const S first = p.x[k][l] * p.y[l][m];
        const S second = p.y[k][l] * p.x[l][m];
        S area = first;
        if constexpr (Magnitude) {
          area = area + second;
        } else {
          area = area - second;
        }
        const S term = w * p.weight[m] * form::kFactors<N>.triple[k][l][m] * area;
        d[k + l + m - 3] = d[k + l + m - 3] + term;
      }
    }
  }
  return d;
}

/// 3 W_x D + W D_x, the slope of W^3 D by x over W^2.
template <std::size_t W, std::size_t D, class S>
[[nodiscard]] std::array<S, W + D - 2> slope(const std::array<S, W>& w, const std::array<S, D>& d,
                                             const std::array<S, W - 1>& w_slope_times_three,
                                             const std::array<S, D - 1>& d_slope) {
  std::array<S, W + D - 2> e{};
  add_product(e, w_slope_times_three, d);
  if constexpr (D > 1) add_product(e, w, d_slope);
  return e;
}

/// target += a * a
template <std::size_t A, class S>
void add_square(std::array<S, 2 * A - 1>& target, const std::array<S, A>& a) {
  for (std::size_t i = 0; i < A; ++i) {
    target[2 * i] = target[2 * i] + a[i] * a[i];
    const S twice = a[i] + a[i];
    for (std::size_t j = i + 1; j < A; ++j) target[i + j] = target[i + j] + twice * a[j];
  }
}

/// Evaluates all polynomials; with `Magnitude`, their majorants: every rounding error of the plain
/// evaluation is at most (number of roundings) * (unit roundoff) * majorant.
template <bool Magnitude, int N, class S>
[[nodiscard]] CurvatureForm<N, S> curvature_form(const ControlDifferences<N, S>& p,
                                                 const std::array<S, 3 * N - 5>& d) {
  CurvatureForm<N, S> f;
  add_hodograph(p, f);
  add_square(f.speed, f.u);
  add_square(f.speed, f.v);

  std::array<S, N + 1> w{};
  for (std::size_t j = 0; j <= N; ++j) w[j] = p.weight[j] * form::kFactors<N>.weight[j];
  const auto e_t = slope(w, d, partial_t(w, 3), partial_t(d));
  const auto e_s = slope(w, d, partial_s(w, 3), partial_s(d));
  add_product(f.test, e_t, partial_s(f.speed));
  if constexpr (Magnitude) {
    add_product(f.test, e_s, partial_t(f.speed));
  } else {
    subtract_product(f.test, e_s, partial_t(f.speed));
  }
  return f;
}

template <bool Magnitude, int N, class S>
[[nodiscard]] CurvatureForm<N, S> curvature_form(const ControlDifferences<N, S>& p) {
  return curvature_form<Magnitude>(p, determinant<Magnitude>(p));
}

/// 1 / binomial(Count - 1, j), rounded up or down by half an ulp.
template <std::size_t Count>
[[nodiscard]] constexpr std::array<double, Count> inverse_binomials() {
  std::array<double, Count> result{};
  for (std::size_t j = 0; j < Count; ++j) {
    result[j] = 1.0 / binomial(static_cast<int>(Count) - 1, static_cast<int>(j));
  }
  return result;
}

/// Largest coefficient of a majorant in plain (not scaled) Bernstein form. Plain coefficients of a
/// product are averages of products, so these norms multiply.
template <std::size_t Count>
[[nodiscard]] double largest(const std::array<double, Count>& scaled_majorant) {
  static constexpr auto kInverse = inverse_binomials<Count>();
  double result = 0.0;
  for (std::size_t j = 0; j < Count; ++j) {
    const double c = scaled_majorant[j] * kInverse[j];
    result = c > result ? c : result;
  }
  return result;
}

/// Absolute values, for the majorants.
template <int N>
[[nodiscard]] ControlDifferences<N, double> absolute(const ControlDifferences<N, double>& p) {
  ControlDifferences<N, double> a;
  for (std::size_t k = 0; k <= N; ++k) {
    a.weight[k] = std::abs(p.weight[k]);
    for (std::size_t l = k + 1; l <= N; ++l) {
      a.x[k][l] = std::abs(p.x[k][l]);
      a.y[k][l] = std::abs(p.y[k][l]);
    }
  }
  return a;
}

}  // namespace
}  // namespace obvid
