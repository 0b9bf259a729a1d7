// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace obvid::paper {

/// A printed number: true value within half a unit of its last digit.
struct Figure {
  std::string name;
  double printed = 0.0;
  double half_unit = 0.0;
};

/// Unknown data behind the printed figures, and what they give.
using Unknowns = std::vector<double>;
using Model = std::function<std::vector<double>(const Unknowns&)>;

/// The data that come nearest to all figures at once.
struct RoundingFit {
  double roundings = 0.0;  ///< largest miss in half units: at most 1 explains every figure
  Unknowns data;
  std::string worst;
};

namespace fit_detail {

using Matrix = std::vector<std::vector<double>>;

/// Gaussian elimination with partial pivoting.
inline std::vector<double> solve(Matrix a, std::vector<double> b) {
  const std::size_t n = b.size();
  for (std::size_t c = 0; c < n; ++c) {
    std::size_t p = c;
    for (std::size_t r = c + 1; r < n; ++r) {
      if (std::abs(a[r][c]) > std::abs(a[p][c])) p = r;
    }
    std::swap(a[c], a[p]);
    std::swap(b[c], b[p]);
    for (std::size_t r = c + 1; r < n; ++r) {
      const double f = a[r][c] / a[c][c];
      if (f == 0.0) continue;
      for (std::size_t k = c; k < n; ++k) a[r][k] -= f * a[c][k];
      b[r] -= f * b[c];
    }
  }
  for (std::size_t c = n; c-- > 0;) {
    for (std::size_t k = c + 1; k < n; ++k) b[c] -= a[c][k] * b[k];
    b[c] /= a[c][c];
  }
  return b;
}

inline std::vector<double> misses(const std::vector<double>& values,
                                  const std::vector<Figure>& figures) {
  std::vector<double> r(figures.size());
  for (std::size_t i = 0; i < r.size(); ++i) {
    r[i] = (values[i] - figures[i].printed) / figures[i].half_unit;
  }
  return r;
}

inline double largest(const std::vector<double>& r) {
  double worst = 0.0;
  for (const double v : r) worst = std::isfinite(v) ? std::max(worst, std::abs(v)) : HUGE_VAL;
  return worst;
}

inline double sum_of_squares(const std::vector<double>& r) {
  double sum = 0.0;
  for (const double v : r) sum = std::isfinite(v) ? sum + v * v : HUGE_VAL;
  return sum;
}

/// Columns: change of the misses per step of each unknown (central differences).
inline Matrix slopes(const Model& model, const std::vector<Figure>& figures, const Unknowns& x,
                     const Unknowns& step) {
  constexpr double kDifference = 1e-3;  // of the step: far above rounding, far below curvature
  Matrix columns(x.size());
  for (std::size_t j = 0; j < x.size(); ++j) {
    Unknowns up = x, down = x;
    up[j] += kDifference * step[j];
    down[j] -= kDifference * step[j];
    const auto a = misses(model(up), figures), b = misses(model(down), figures);
    columns[j].resize(a.size());
    for (std::size_t m = 0; m < a.size(); ++m) columns[j][m] = (a[m] - b[m]) / (2.0 * kDifference);
  }
  return columns;
}

/// Step of weighted least squares.
inline std::vector<double> weighted_step(const Matrix& columns, const std::vector<double>& r,
                                         const std::vector<double>& weight) {
  constexpr double kRidge = 1e-9;  // relative; for unknowns that no figure depends on
  const std::size_t n = columns.size();
  Matrix normal(n, std::vector<double>(n));
  std::vector<double> right(n);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t m = 0; m < r.size(); ++m) {
      const double w = weight[m] * columns[i][m];
      if (w == 0.0) continue;
      right[i] -= w * r[m];
      for (std::size_t j = 0; j <= i; ++j) normal[i][j] += w * columns[j][m];
    }
    for (std::size_t j = 0; j < i; ++j) normal[j][i] = normal[i][j];
  }
  for (std::size_t i = 0; i < n; ++i) normal[i][i] += kRidge * (normal[i][i] + kRidge);
  return solve(normal, right);
}

/// Lawson's iteration: weights grow where the linearised miss is large, towards the least maximum.
inline std::vector<double> minimax_step(const Matrix& columns, const std::vector<double>& r,
                                        int rounds) {
  std::vector<double> weight(r.size(), 1.0 / static_cast<double>(r.size())), best;
  double least = HUGE_VAL;
  for (int k = 0; k < rounds; ++k) {
    const auto d = weighted_step(columns, r, weight);
    std::vector<double> left = r;
    for (std::size_t i = 0; i < d.size(); ++i) {
      for (std::size_t m = 0; m < r.size(); ++m) left[m] += columns[i][m] * d[i];
    }
    if (largest(left) < least) {
      least = largest(left);
      best = d;
    }
    double sum = 0.0;
    for (std::size_t m = 0; m < r.size(); ++m) sum += weight[m] * std::abs(left[m]);
    for (std::size_t m = 0; m < r.size(); ++m) {
      weight[m] = weight[m] * std::abs(left[m]) / sum + 1e-12;
    }
  }
  return best;
}

}  // namespace fit_detail

/// Searches the data with the smallest largest miss. Every value found is a witness: the data are
/// returned and give these misses. A large value is the search's word, not a proof.
/// `start` and `step` (typical change) per unknown.
inline RoundingFit fewest_roundings(const Model& model, const std::vector<Figure>& figures,
                                    const Unknowns& start, const Unknowns& step) {
  using namespace fit_detail;
  constexpr int kApproach = 6;  // steps of plain least squares: they only have to come near
  constexpr int kLinearisations = 12;
  constexpr int kLawsonRounds = 60;
  constexpr int kHalvings = 6;
  Unknowns x = start;
  for (int k = 0; k < kLinearisations; ++k) {
    const auto r = misses(model(x), figures);
    const Matrix columns = slopes(model, figures, x, step);
    const bool approach = k < kApproach;
    const auto measure = approach ? sum_of_squares : largest;
    const auto d = minimax_step(columns, r, approach ? 1 : kLawsonRounds);
    double part = 1.0;
    for (int h = 0; h < kHalvings; ++h, part *= 0.5) {
      Unknowns next = x;
      for (std::size_t j = 0; j < x.size(); ++j) next[j] += part * d[j] * step[j];
      if (!(measure(misses(model(next), figures)) < measure(r))) continue;
      x = next;
      break;
    }
  }
  const auto r = misses(model(x), figures);
  RoundingFit fit{largest(r), x, ""};
  for (std::size_t m = 0; m < r.size(); ++m) {
    if (std::abs(r[m]) == fit.roundings) fit.worst = figures[m].name;
  }
  return fit;
}

}  // namespace obvid::paper
