// SPDX-License-Identifier: Apache-2.0
// The test polynomial and its error bound against exact rational arithmetic that follows the
// textbook formula in the power basis, T = (3 W' D + W D') g - 3/2 W D g'.
#include "curvature_form.h"

#include <gtest/gtest.h>

#include <boost/multiprecision/cpp_int.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "decide.h"
#include "scaled_piece.h"

namespace obvid {
namespace {

using Rational = boost::multiprecision::cpp_rational;
using Polynomial = std::vector<Rational>;  // power basis, lowest first

Polynomial sum(const Polynomial& a, const Polynomial& b, const Rational& factor = 1) {
  Polynomial r(std::max(a.size(), b.size()));
  for (std::size_t i = 0; i < a.size(); ++i) r[i] += a[i];
  for (std::size_t i = 0; i < b.size(); ++i) r[i] += factor * b[i];
  return r;
}

Polynomial times(const Polynomial& a, const Polynomial& b) {
  Polynomial r(a.size() + b.size() - 1);
  for (std::size_t i = 0; i < a.size(); ++i) {
    for (std::size_t j = 0; j < b.size(); ++j) r[i + j] += a[i] * b[j];
  }
  return r;
}

Polynomial slope_of(const Polynomial& a) {
  Polynomial r(a.size() > 1 ? a.size() - 1 : 1);
  for (std::size_t i = 1; i < a.size(); ++i) r[i - 1] = a[i] * static_cast<int>(i);
  return r;
}

Rational choose(int n, int k) {
  Rational r = 1;
  for (int j = 1; j <= k; ++j) r = r * (n - k + j) / j;
  return r;
}

/// sum c_j binomial(n, j) t^j (1-t)^(n-j) in powers of t.
Polynomial from_bernstein(const std::vector<Rational>& c) {
  const int n = static_cast<int>(c.size()) - 1;
  Polynomial r(c.size());
  for (int j = 0; j <= n; ++j) {
    for (int i = 0; i + j <= n; ++i) {
      r[static_cast<std::size_t>(i + j)] +=
          c[static_cast<std::size_t>(j)] * choose(n, j) * choose(n - j, i) * (i % 2 == 0 ? 1 : -1);
    }
  }
  return r;
}

/// Scaled Bernstein coefficients of degree n from powers of t: t^i = t^i (s + t)^(n-i).
std::vector<Rational> to_scaled_bernstein(const Polynomial& p, int n) {
  std::vector<Rational> r(static_cast<std::size_t>(n) + 1);
  for (int i = 0; i <= n && i < static_cast<int>(p.size()); ++i) {
    for (int k = 0; k + i <= n; ++k) {
      r[static_cast<std::size_t>(i + k)] += p[static_cast<std::size_t>(i)] * choose(n - i, k);
    }
  }
  return r;
}

struct TextbookTest {
  std::vector<Rational> coefficients;
  bool degree_is_as_derived = true;
};

/// `test` as curvature_form.h scales it: T times 4 / n^4 (docs/methods/certify.md).
TextbookTest textbook(const RationalBezier& piece) {
  const int n = piece.degree;
  std::vector<Rational> x, y, w;
  for (std::size_t j = 0; j <= static_cast<std::size_t>(n); ++j) {
    const Rational wj(piece.weight[j]);
    x.push_back(wj * (Rational(piece.offset[j].x) - Rational(piece.offset[0].x)));
    y.push_back(wj * (Rational(piece.offset[j].y) - Rational(piece.offset[0].y)));
    w.push_back(wj);
  }
  const Polynomial px = from_bernstein(x), py = from_bernstein(y), pw = from_bernstein(w);
  const Polynomial x1 = slope_of(px), y1 = slope_of(py), w1 = slope_of(pw);
  const Polynomial x2 = slope_of(x1), y2 = slope_of(y1), w2 = slope_of(w1);
  const auto minor = [](const Polynomial& a, const Polynomial& b, const Polynomial& c,
                        const Polynomial& d) { return sum(times(a, d), times(b, c), -1); };
  Polynomial det = times(px, minor(y1, w1, y2, w2));
  det = sum(det, times(py, minor(x1, w1, x2, w2)), -1);
  det = sum(det, times(pw, minor(x1, y1, x2, y2)));
  const Polynomial u = minor(pw, px, w1, x1), v = minor(pw, py, w1, y1);
  const Polynomial g = sum(times(u, u), times(v, v));
  const Polynomial e = sum(times(pw, slope_of(det)), times(w1, det), 3);
  Polynomial t = sum(times(e, g), times(times(pw, det), slope_of(g)), Rational(-3, 2));
  const Rational scale = Rational(4) / (n * n * n * n);
  for (Rational& c : t) c *= scale;
  TextbookTest result;
  const int degree = 8 * n - 12;
  for (std::size_t i = static_cast<std::size_t>(degree) + 1; i < t.size(); ++i) {
    result.degree_is_as_derived = result.degree_is_as_derived && t[i] == 0;
  }
  result.coefficients = to_scaled_bernstein(t, degree);
  return result;
}

/// A piece with a gentle or nearly circular polygon: `bend` is its turning, `noise` what spoils it.
RationalBezier random_piece(std::mt19937_64& rng, int degree, double bend, double noise) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  RationalBezier piece;
  piece.degree = degree;
  const double theta = 3.0 * unit(rng);
  for (std::size_t j = 0; j <= static_cast<std::size_t>(degree); ++j) {
    const double t = static_cast<double>(j) / degree;
    const Vec2 q{t + noise * unit(rng), 0.5 * bend * t * t + noise * bend * unit(rng)};
    piece.offset[j] = complex_product(q, unit_at(theta)) + Vec2{unit(rng), unit(rng)};
    piece.weight[j] = 1.0 + noise * unit(rng);
  }
  return piece;
}

struct WorstRatio {
  double in_doubles = 0.0;
  double in_double_doubles = 0.0;
};

template <int N>
WorstRatio worst_error_over_bound(int count, double bend, double noise, std::uint64_t seed) {
  std::mt19937_64 rng(seed);
  WorstRatio worst;
  for (int i = 0; i < count; ++i) {
    const RationalBezier piece = *scaled(random_piece(rng, N, bend, noise));
    const auto truth = textbook(piece);
    EXPECT_TRUE(truth.degree_is_as_derived);
    const auto p = differences_in_doubles<N>(piece);
    const auto f = curvature_form<false>(p);
    const auto majorant = curvature_form<true>(absolute(p));
    ControlDifferences<N, DoubleDouble> exact;
    for (std::size_t k = 0; k <= N; ++k) {
      exact.weight[k] = {piece.weight[k], 0.0};
      for (std::size_t l = k + 1; l <= N; ++l) {
        exact.x[k][l] = two_sum(piece.offset[l].x, -piece.offset[k].x);
        exact.y[k][l] = two_sum(piece.offset[l].y, -piece.offset[k].y);
      }
    }
    const auto ff = curvature_form<false>(exact);
    for (std::size_t j = 0; j < f.test.size(); ++j) {
      const Rational& c = truth.coefficients[j];
      const double e = std::abs(static_cast<double>(Rational(Rational(f.test[j]) - c)));
      const double ee = std::abs(
          static_cast<double>(Rational(Rational(ff.test[j].hi) + Rational(ff.test[j].lo) - c)));
      constexpr int k = form::Roundings<N>::kTest;
      worst.in_doubles = std::max(worst.in_doubles, e / error_bound<double>(k, majorant.test[j]));
      worst.in_double_doubles =
          std::max(worst.in_double_doubles, ee / error_bound<DoubleDouble>(k, majorant.test[j]));
    }
  }
  return worst;
}

template <int N>
void expect_errors_within_bounds() {
  for (const double bend : {1.0, 1e-3, 1e-6}) {
    for (const double noise : {0.2, 1e-3, 0.0}) {
      const WorstRatio worst = worst_error_over_bound<N>(N <= 4 ? 12 : 2, bend, noise, 7);
      EXPECT_LE(worst.in_doubles, 1.0) << "degree " << N << " bend " << bend;
      EXPECT_LE(worst.in_double_doubles, 1.0) << "degree " << N << " bend " << bend;
      EXPECT_GT(worst.in_doubles, 0.0) << "the comparison must see rounding at all";
    }
  }
}

TEST(CurvatureForm, AgreesWithTheTextbookFormulaWithinItsBoundForConics) {
  expect_errors_within_bounds<2>();
}
TEST(CurvatureForm, AgreesWithTheTextbookFormulaWithinItsBoundForCubics) {
  expect_errors_within_bounds<3>();
}
TEST(CurvatureForm, AgreesWithTheTextbookFormulaWithinItsBoundForQuartics) {
  expect_errors_within_bounds<4>();
}
TEST(CurvatureForm, AgreesWithTheTextbookFormulaWithinItsBoundForDegreeSix) {
  expect_errors_within_bounds<6>();
}
TEST(CurvatureForm, AgreesWithTheTextbookFormulaWithinItsBoundForDegreeSeven) {
  expect_errors_within_bounds<7>();
}

}  // namespace
}  // namespace obvid
